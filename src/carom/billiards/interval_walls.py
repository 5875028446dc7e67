"""Pieces of a boundary in interval arithmetic: places, tangents and normals for a stretch of the piece's parameter.

The arithmetic is mpmath's (``mpmath.iv``). The centre's curve is P(u) = E(u) + a n(u), with E the wall, n its normal to the left of
the tangent and a the distance that the centre keeps; P' = (1 - a kappa) E', n' = -kappa E'.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np

from carom.billiards.boundary import Boundary
from carom.billiards.curved_wall import left_of
from carom.core.jets import Jet
from carom.errors import CaromError
from carom.files import import_optional
from carom.scene.figures import Piece
from carom.scene.figures.curve import FunctionPiece

__all__ = ["Interval", "Spot", "WallPiece", "intervals", "low", "wall_pieces"]

Interval = Any  # mpmath's iv.mpf
BITS = 113
SAMPLES = 2048  # of a curve, among which the parameter of a place on it is looked for
LARGEST_POWER = 64  # that is multiplied out
CONVEX_PARTS = 96  # of a curve, on each of which the sign of its curvature is shown


def intervals() -> Any:
    """Return mpmath's interval arithmetic, in quadruple precision."""
    iv = import_optional("mpmath", "verified orbits").iv
    iv.prec = BITS
    return iv


def low(x: Interval) -> float:
    """Return a number below all of an interval."""
    return math.nextafter(float(x.a), -math.inf)


class Spot(NamedTuple):
    """A place of the centre on a wall, for a stretch of its parameter: pairs of intervals."""

    place: tuple[Interval, Interval]
    rate: tuple[Interval, Interval]
    """dP/du."""
    normal: tuple[Interval, Interval]
    """Unit, towards the ball."""
    turn: Interval
    """Rate of the normal's angle, by u."""


@dataclass(frozen=True, eq=False)
class WallPiece:
    """A piece of the boundary: its parameter's range, and its wall E with two derivatives there."""

    wall: Callable[[Interval], tuple[Any, Any, Any]]
    """E, E' and E'' (pairs) for a stretch of u."""
    first: float
    last: float
    periodic: bool = False
    """Whether the parameter is an angle of a closed curve."""
    offset: float = 0.0

    def spot(self, u: Interval) -> Spot:
        """Return the places of the centre for a stretch of u."""
        (x, y), (dx, dy), (ddx, ddy) = self.wall(u)
        speed2 = dx * dx + dy * dy
        speed = speed2.ctx.sqrt(speed2)
        normal = (-dy / speed, dx / speed)
        bend = (dx * ddy - dy * ddx) / (speed2 * speed)
        rate = 1 - self.offset * bend
        return Spot(
            (x + self.offset * normal[0], y + self.offset * normal[1]), (rate * dx, rate * dy), normal, bend * speed
        )

    def holds(self, u: Interval) -> bool:
        """Return whether a stretch lies within the piece, apart from its ends."""
        return self.periodic or bool(u > self.first and u < self.last)


def wall_pieces(shape: Boundary) -> _Pieces:
    """Return the pieces of a boundary by the index that a bounce gives; CaromError, with the reason, where one has no intervals."""
    return _Pieces(shape)


class _Pieces:
    def __init__(self, shape: Boundary) -> None:
        self.shape, self.iv = shape, intervals()
        if shape.ellipse is not None and len(shape.arcs) > 1:
            raise CaromError("the ball is larger than the ellipse's radius of curvature at its ends")
        if shape.curve is not None and any(arc.corner_before or arc.corner_after for arc in shape.curve.arcs):
            raise CaromError("the curve of the centre has corners")

    def of(self, piece: int, x: Any) -> tuple[WallPiece, float]:
        """Return the piece that a bounce met at a place (2), in the first periodic cell, and the parameter there."""
        shape, iv = self.shape, self.iv
        k = int(shape._number(np.array(piece)))
        if k < len(shape.faces):
            return self._face(k, x)
        k -= len(shape.faces)
        circles = [*shape.inside, *shape.outside]
        if k < len(circles):
            cx, cy, r = (float(c) for c in circles[k][:3])
            inward = k < len(shape.inside)
            sign = 1 if inward else -1  # the ball on the left: counterclockwise inside, clockwise around an obstacle

            def circle(u: Interval) -> tuple[Any, Any, Any]:
                c, s = iv.cos(u) * r, iv.sin(u) * r
                return (cx + c, cy + sign * s), (-s, sign * c), (-c, -sign * s)

            d = shape.folded(np.asarray(x, float) - (cx, cy))
            angle = sign * math.atan2(d[1], d[0])
            half, whole = (shape.inside[k].half if inward else 0.0), not inward
            if half:
                middle = 0.0 if half > 0 else math.copysign(math.pi, angle)
                return WallPiece(circle, middle - math.pi / 2, middle + math.pi / 2), angle
            if whole and shape.outside[k - len(shape.inside)].span < math.tau - 1e-9:
                arc = shape.outside[k - len(shape.inside)]
                begin = -arc.first
                angle = begin + (angle - begin) % math.tau
                return WallPiece(circle, begin, begin + arc.span), angle
            return WallPiece(circle, -math.inf, math.inf, True), angle
        if shape.ellipse is not None:
            p, q, inset = (float(one) for one in shape.ellipse)

            def ellipse(u: Interval) -> tuple[Any, Any, Any]:
                c, s = iv.cos(u), iv.sin(u)
                return (p * c, q * s), (-p * s, q * c), (-p * c, -q * s)

            n = shape.normals(np.array(piece), np.asarray(x, float))[:2]
            return WallPiece(ellipse, -math.inf, math.inf, True, inset), math.atan2(-n[1] * q, -n[0] * p)
        assert shape.curve is not None
        return self._curve(x)

    def _face(self, k: int, x: Any) -> tuple[WallPiece, float]:
        (nx, ny, _nz), c, _r, begin, end, *_ends = self.shape.faces[k]
        iv = self.iv
        size = iv.sqrt(iv.mpf(nx) ** 2 + iv.mpf(ny) ** 2)
        n = (nx / size, ny / size)
        d = iv.mpf(c) / size

        def line(u: Interval) -> tuple[Any, Any, Any]:
            return (n[0] * d + n[1] * u, n[1] * d - n[0] * u), (n[1], -n[0]), (iv.mpf(0), iv.mpf(0))

        along = ny * float(x[0]) - nx * float(x[1])
        return WallPiece(line, begin, end), along

    @cached_property
    def curves(self) -> list[Piece]:
        """Pieces of a curved wall."""
        assert self.shape.curve is not None
        found = [piece for loop in self.shape.curve.wall.outline for piece in loop]
        if not all(isinstance(one, FunctionPiece) for one in found):
            raise CaromError("the curve is not given by functions alone")
        return found

    def _curve(self, x: Any) -> tuple[WallPiece, float]:
        assert self.shape.curve is not None
        a = self.shape.curve.inset
        best: tuple[float, Piece | None, float] = (math.inf, None, 0.0)
        for one in self.curves:
            t = np.linspace(*one.span(), SAMPLES)
            for _ in range(8):
                e, d, dd = one.at(t)
                speed = np.linalg.norm(d, axis=1)
                gap = e + a * left_of(d) / speed[:, None] - x
                bend = (d[:, 0] * dd[:, 1] - d[:, 1] * dd[:, 0]) / speed**3
                t = (
                    t[np.argsort(np.linalg.norm(gap, axis=1))[:4]]
                    if len(t) > 4
                    else t - (gap * d).sum(1) / (speed**2 * (1 - a * bend))
                )
            e, d, _dd = one.at(t)
            gap = np.linalg.norm(e + a * left_of(d) / np.linalg.norm(d, axis=1)[:, None] - x, axis=1)
            if gap.min() < best[0]:
                best = (float(gap.min()), one, float(t[gap.argmin()]))
        found = best[1]
        assert isinstance(found, FunctionPiece)
        first, last = found.span()
        # (where the functions go on with their period beyond the ends, a stretch may pass these)
        beyond = np.array([[first - 0.1, first + 0.1], [last - 0.1, last + 0.1]])
        before, after = found.at(beyond[0])[0], found.at(beyond[1])[0]
        whole = not found.cuts and bool(np.abs(before - after).max() < 1e-12 * self.shape.size)
        return WallPiece(lambda u: self._functions(found, u), first, last, whole, a), best[2]

    def _functions(self, piece: FunctionPiece, u: Interval) -> tuple[Any, Any, Any]:
        variable = IntervalJet(self.iv, u, self.iv.mpf(1), self.iv.mpf(0))
        try:
            parts = [variable.like(one(variable)) for one in (piece.x, piece.y)]
        except (TypeError, ValueError, AttributeError) as error:
            raise CaromError("the curve's function takes no intervals") from error
        return tuple(tuple(getattr(part, name) for part in parts) for name in ("x", "d", "dd"))  # type: ignore[return-value]

    @cached_property
    def convex(self) -> bool:
        """Whether a curved wall is one closed curve of positive curvature, as is shown here: chords meet it at their ends."""
        if self.shape.curve is None:
            return True
        if len(self.curves) != 1:
            return False
        one, iv = self.curves[0], self.iv
        assert isinstance(one, FunctionPiece)
        t = np.linspace(*one.span(), CONVEX_PARTS + 1)
        for begin, end in pairwise(t):
            _e, (dx, dy), (ddx, ddy) = self._functions(one, iv.mpf([begin, end]))
            if not dx * ddy - dy * ddx > 0:
                return False
        return True


class IntervalJet(Jet):
    """A jet of intervals."""

    def __init__(self, iv: Any, x: Interval, d: Interval, dd: Interval) -> None:
        self.iv, self.x, self.d, self.dd = iv, x, d, dd

    def made(self, x: Any, d: Any, dd: Any) -> IntervalJet:
        """Return a jet of intervals; a number is one of no width."""
        return IntervalJet(
            self.iv, *(one if isinstance(one, type(self.x)) else self.iv.mpf(float(one)) for one in (x, d, dd))
        )

    def function(self, name: str) -> Jet:
        """Return one of the functions that have intervals."""
        iv, x = self.iv, self.x
        if name in ("sin", "cos", "tan"):
            c, s = iv.cos(x), iv.sin(x)
            found = {"sin": (s, c, -s), "cos": (c, -s, -c)}
            return self.of(*found[name]) if name in found else self.of(s / c, 1 / (c * c), 2 * s / (c * c * c))
        if name == "exp":
            return self.of(*(iv.exp(x),) * 3)
        if name == "log":
            return self.of(iv.log(x), 1 / x, -1 / (x * x))
        if name == "sqrt":
            r = iv.sqrt(x)
            return self.of(r, 0.5 / r, -0.25 / (x * r))
        raise CaromError(f"the curve's function has {name}, which is not known for intervals")

    def __pow__(self, other: Any) -> Jet:
        """Return a power with an exponent that does not vary; one that is no integer is of a positive number."""
        n = float(other)
        if n == int(n) and 0 <= n <= LARGEST_POWER:
            found = self.like(1.0)
            for _ in range(int(n)):
                found = found * self
            return found
        return (self.function("log") * n).function("exp")
