"""A wall of smooth pieces: its panels, its corners, the distance of points from it.

Loops of pieces with the open side on the left; a corner is where the tangent jumps by more than CORNER_TURN.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.core.geometry.curve import (
    BEND,
    COEFFICIENTS,
    CX,
    DEGREE,
    FIRST_XI,
    HALF,
    HIGH,
    LAST_XI,
    LOW,
    OX,
    ROW,
    SLOPE,
    TX,
    W0,
    W1,
    X,
    cut_into_panels,
)
from carom.errors import CaromError, Fault
from carom.scene.figures import EllipsePiece, Piece
from carom.scene.figures.polygons import outline_faults

Array = NDArray[np.float64]
CORNER_TURN = 1e-7  # rad
OPEN = 1e-9  # of the size: so far may the end of a piece be from the beginning of the next one
SAMPLES = 4  # of each panel, from which the nearest one is found
ROWS_AT_ONCE = 2_000  # (what they need fits into the processor's cache)
NEWTON = 16
RESTS = 1e-12  # a step in w that leaves less than rounding of a distance


class WallLoop(NamedTuple):
    """The panels of one closed loop, in order; all arrays have one entry per panel."""

    rows: Array
    """(P, ROW)."""
    piece: NDArray[np.int64]
    """Index of the piece of the wall."""
    t: Array
    """(P, 2): parameters of the piece at its ends."""
    sign: NDArray[np.int64]
    """Of the curvature."""
    turn: Array
    """Angle by which the tangent turns, rad."""
    begin: Array
    """(P, 2): unit tangent at the beginning."""
    jump: Array
    """Angle by which the tangent jumps at the beginning, rad; 0 where it does not."""


def left_of(t: Array) -> Array:
    """Return vectors (..., 2) turned by a right angle to the left."""
    return np.stack([-t[..., 1], t[..., 0]], axis=-1)


def graphs(rows: Array, w: Array) -> tuple[Array, Array, Array]:
    """Return f, f' and f'' (N) of panels, rows (N, ROW), at w (N)."""
    f, f1, f2 = (np.zeros(len(rows)) for _ in range(3))
    for k in range(DEGREE, -1, -1):
        c = rows[:, COEFFICIENTS + k]
        f = f * w + c
        f1 = f1 * w + k * c if k > 0 else f1
        f2 = f2 * w + k * (k - 1) * c if k > 1 else f2
    return f, f1 / rows[:, HALF], f2 / rows[:, HALF] ** 2


def slopes(rows: Array, w: Array) -> Array:
    """Return f' (..., N) of panels, rows (N, ROW), at w (..., N), with the bits of :func:`graphs`."""
    f1 = np.zeros_like(w)
    for k in range(DEGREE, 0, -1):
        f1 = f1 * w + k * rows[:, COEFFICIENTS + k]
    found: Array = f1 / rows[:, HALF]
    return found


def chord_frame(rows: Array, x: Array) -> tuple[Array, Array]:
    """Return xi and eta (N) of points (N, 2) over the chords of panels."""
    d, e = x - rows[:, OX : OX + 2], rows[:, CX : CX + 2]
    return (d * e).sum(-1), e[:, 0] * d[:, 1] - e[:, 1] * d[:, 0]


def plane_of(rows: Array, xi: Array, eta: Array) -> Array:
    """Return vectors (N, 2) of the plane from their components along the chords of panels and across them."""
    e = rows[:, CX : CX + 2]
    return xi[:, None] * e + eta[:, None] * left_of(e)


@dataclass(frozen=True, eq=False)
class CurvedWall:
    """Closed loops of pieces; the first is the outside. CaromError where they are no boundary."""

    name: str
    outline: tuple[tuple[Piece, ...], ...]
    is_whole: bool = True
    """Whether each piece ends where the next one begins: not where it is what a ball touches of a wall."""

    @functools.cached_property
    def size(self) -> float:
        """Half the diagonal of its box, or its largest coordinate, m."""
        x = np.concatenate([piece.at(np.linspace(*piece.span(), 257))[0] for loop in self.outline for piece in loop])
        if not np.isfinite(x).all():
            raise CaromError(Fault(self.name, "outline", "finite places", "some that are none"))
        size = float(np.linalg.norm(np.ptp(x, axis=0)) / 2)
        if not size > 0:
            raise CaromError(Fault(self.name, "outline", "a curve of a length above 0", "one point"))
        return max(size, float(np.abs(x).max()))

    @functools.cached_property
    def loops(self) -> tuple[WallLoop, ...]:
        """Its loops, cut into panels."""
        found, first = [], 0
        for pieces in self.outline:
            found.append(self._loop(pieces, first))
            first += len(pieces)
        return tuple(found)

    @functools.cached_property
    def pieces(self) -> tuple[Piece, ...]:
        """Its pieces, of all loops."""
        return tuple(piece for loop in self.outline for piece in loop)

    def _loop(self, pieces: Sequence[Piece], first: int) -> WallLoop:
        size, parts, ends = self.size, [], []
        for number, piece in enumerate(pieces):
            t0, t1 = piece.span()
            try:
                panels = cut_into_panels(piece.at, t0, t1, size, getattr(piece, "cuts", None))
            except ValueError as error:
                at = piece.at(np.array([error.args[0]]))[0][0]
                raise CaromError(
                    Fault(
                        self.name,
                        "curve",
                        "a curve with a continuous tangent and curvature between its corners",
                        f"one that has none near ({at[0]:.6g}, {at[1]:.6g})",
                        "divide it into pieces there",
                    )
                ) from None
            parts.append((panels, np.full(len(panels.rows), first + number)))
            ends.append(piece.at(np.array([t0, t1])))
        for (x, _d, _dd), (y, _e, _ee) in zip(ends, ends[1:] + ends[:1], strict=True):
            if self.is_whole and np.abs(x[1] - y[0]).max() > OPEN * size:
                raise CaromError(
                    Fault(
                        self.name, "outline", "a closed curve", f"one from ({y[0, 0]:.6g}, {y[0, 1]:.6g}) that ends at"
                        f" ({x[1, 0]:.6g}, {x[1, 1]:.6g})", "its last place is its first one",
                    )
                )  # fmt: skip
        rows, t, sign, turn = (
            np.concatenate([getattr(one, name) for one, _k in parts]) for name in ("rows", "t", "sign", "turn")
        )
        owner = np.concatenate([k for _one, k in parts])
        begin = self._tangents(owner, t[:, 0], pieces, first)
        end = np.roll(self._tangents(owner, t[:, 1], pieces, first), 1, axis=0)
        jump = np.arctan2(end[:, 0] * begin[:, 1] - end[:, 1] * begin[:, 0], (end * begin).sum(-1))
        jump[np.abs(jump) < CORNER_TURN] = 0.0
        if self.is_whole and (np.abs(jump) > math.pi - 1e-6).any():
            at = rows[np.argmax(np.abs(jump)), OX : OX + 2]
            raise CaromError(Fault(self.name, "outline", "no cusp", f"one at ({at[0]:.6g}, {at[1]:.6g})"))
        return WallLoop(rows, owner, t, sign, turn, begin, jump)

    @staticmethod
    def _tangents(number: NDArray[np.int64], t: Array, pieces: Sequence[Piece], first: int) -> Array:
        found = np.empty((len(t), 2))
        for k, piece in enumerate(pieces, start=first):
            here = number == k
            found[here] = piece.at(t[here])[1]
        found /= np.linalg.norm(found, axis=-1, keepdims=True)
        return found

    @functools.cached_property
    def _samples(self) -> tuple[Array, Array, NDArray[np.int64], NDArray[np.int64], Array]:
        """Return places along the wall and their w; panels before and after each one; and at nodes the sum of both normals."""
        rows = np.concatenate([loop.rows for loop in self.loops])
        before, after, sums, base = [], [], [], 0
        for loop in self.loops:
            k = np.arange(len(loop.rows))
            before.append(base + np.roll(k, 1))
            after.append(base + np.roll(k, -1))
            tip = np.stack([np.cos(loop.jump / 2), -np.sin(loop.jump / 2)], axis=-1)
            n = left_of(loop.begin)
            sums.append(
                np.stack(
                    [n[:, 0] * tip[:, 0] - n[:, 1] * tip[:, 1], n[:, 1] * tip[:, 0] + n[:, 0] * tip[:, 1]], axis=-1
                )
            )
            base += len(k)
        w = np.tile((2 * np.arange(SAMPLES) + 1) / SAMPLES - 1, len(rows))
        many = np.repeat(rows, SAMPLES, axis=0)
        x = many[:, OX : OX + 2] + plane_of(many, many[:, HALF] * (1 + w), graphs(many, w)[0])
        return x, w, np.concatenate(before), np.concatenate(after), np.concatenate(sums)

    def depth(self, x: Array) -> Array:
        """Return the distances (N) of points (N, 2) from the wall: positive on the open side, else negative."""
        found = np.empty(len(x))
        for k in range(0, len(x), ROWS_AT_ONCE):
            found[k : k + ROWS_AT_ONCE] = self._depth(x[k : k + ROWS_AT_ONCE])
        return found

    def _depth(self, x: Array) -> Array:
        places, ws, before, after, normals = self._samples
        rows = np.concatenate([loop.rows for loop in self.loops])
        squared = (x[:, None, 0] - places[:, 0]) ** 2 + (x[:, None, 1] - places[:, 1]) ** 2
        best, found = np.full(len(x), np.inf), np.empty(len(x))
        candidates = []
        for _ in range(2):  # (half-way between two parts of the wall the samples do not say which is nearer)
            nearest = squared.argmin(axis=1)
            middle = nearest // SAMPLES
            candidates += [(middle, ws[nearest]), (before[middle], np.ones(len(x))), (after[middle], -np.ones(len(x)))]
            for k in range(-2 * SAMPLES, 2 * SAMPLES + 1):
                squared[np.arange(len(x)), (nearest + k) % len(places)] = np.inf
        for panel, begin in candidates:
            here = rows[panel]
            w, h, (xi, eta) = begin.copy(), here[:, HALF], chord_frame(here, x)
            on = np.arange(len(x))  # those that have not come to rest
            for _ in range(NEWTON):
                rows_on, w_on = here[on], w[on]
                f, f1, f2 = graphs(rows_on, w_on)
                dx, dy = xi[on] - h[on] * (1 + w_on), eta[on] - f
                rate = np.maximum(np.abs(1 + f1 * f1 - f2 * dy), 0.01)
                w[on] = np.clip(w_on + (dx + f1 * dy) / (h[on] * rate), -1.0, 1.0)
                on = on[np.abs(w[on] - w_on) > RESTS]
                if not len(on):
                    break
            f, f1, _f2 = graphs(here, w)
            dx, dy = xi - h * (1 + w), eta - f
            distance = np.hypot(dx, dy)
            side = dy - f1 * dx
            end = np.where(w == 1.0, after[panel], panel)
            at_end = np.abs(w) == 1.0
            side[at_end] = (plane_of(here[at_end], dx[at_end], dy[at_end]) * normals[end[at_end]]).sum(-1)
            better = distance < best
            best[better], found[better] = distance[better], np.copysign(distance, side)[better]
        return found

    def require_simple(self) -> None:
        """Raise CaromError where a loop crosses or touches itself, or runs clockwise around the table."""
        for number, loop in enumerate(self.loops):
            x = loop.rows[:, OX : OX + 2]
            turn = float(loop.turn.sum() + loop.jump.sum())
            if outline_faults(x) or abs(abs(turn) - math.tau) > 1e-6:
                raise CaromError(
                    Fault(self.name, "outline", "a closed curve that does not meet itself", "one that does")
                )
            if (turn > 0) != (number == 0):
                raise CaromError(Fault(self.name, "outline", "the table on the left of the curve", "one on its right"))


# ----------------------------------------------------------------------------------------------------
# The boundary of the region open to the centre of a ball within a curved wall: arcs of parallel curves, and their corners.


LONGEST_ARC = 2.8  # rad: by so much an arc turns at most, below pi
SAME_NODE = (
    1e-9  # of the size: so near are a node and its tangent to those of the next arc where these are joined smoothly
)
NODES, WEIGHTS = np.polynomial.legendre.leggauss(12)


# A ball touches the whole ellipse if its radius is smaller than the smallest radius of curvature by this fraction.
CURVATURE_MARGIN = 1e-9
TOUCHES = 1e-9  # of the size: so much nearer to another part of the wall is rounding
REGION_SAMPLES = np.linspace(-1, 1, 25)  # of each panel and circle, at which the distance from the wall is asked


class Stretch(NamedTuple):
    """Panels of the wall, one after the other, without a corner in between."""

    loop: int
    panels: list[int]


class Bend(NamedTuple):
    """The circle on which the centre passes a corner of the wall with the interior all around."""

    x: float
    y: float
    first: float
    """Angle at which it begins, rad; it goes clockwise."""
    span: float


class CurveArc(NamedTuple):
    """An arc of the parallel curve."""

    first: int
    """Row of the table with its first node."""
    last: int
    """Row of its last node."""
    direction: tuple[float, float]
    """A unit vector with which all its tangents make an angle below pi/2."""
    corner_before: bool
    corner_after: bool


@dataclass(frozen=True, eq=False)
class CurvedRegion:
    """Arcs in the order of the boundary, and their table (:mod:`carom.core.geometry.curve`) for a ball of radius ``inset``."""

    wall: CurvedWall
    inset: float
    table: Array
    arcs: tuple[CurveArc, ...]
    reflex: tuple[Bend, ...]
    """Circles on which the centre passes reflex corners of the wall."""
    order: tuple[int, ...] | None
    """Order of the arcs and, after them, of these circles; None: by number."""
    rounds: tuple[int, ...]
    """Number of the first arc of each closed curve of the boundary."""

    @functools.cached_property
    def ways(self) -> Array:
        """Return the arc length of each node from the beginning of its arc."""
        inner = self.length_to(np.arange(len(self.table)), self.table[:, W1])
        found = np.concatenate([[0.0], np.cumsum(inner)[:-1]])
        for arc in self.arcs:
            found[arc.first : arc.last + 1] -= found[arc.first]
        return found

    def length_to(self, row: NDArray[np.int64], w: Array) -> Array:
        """Return the arc lengths (N) from the beginning of panels to w (N)."""
        rows = self.table[row]
        low, h = rows[:, W0], rows[:, HALF]
        half = (w - low) / 2
        total = np.zeros(len(row))
        rates = np.sqrt(1 + slopes(rows, low + half * (1 + NODES[:, None])) ** 2)
        for weight, rate in zip(WEIGHTS, rates, strict=True):
            total += weight * rate
        turned = np.arctan(slopes(rows, w)) - np.arctan(slopes(rows, low))
        found: Array = total * half * h - self.inset * turned
        return found

    @functools.cached_property
    def walls(self) -> list[ArcWall]:
        """Its arcs as walls of a boundary."""
        return [ArcWall(self, arc) for arc in self.arcs]

    @functools.cached_property
    def parts(self) -> NDArray[np.int64]:
        """The smooth part that each arc belongs to, by number."""
        nodes, near = self.table[:, X : TX + 2], SAME_NODE * max(self.wall.size, 1.0)
        found = np.zeros(len(self.arcs), np.int64)
        number = 0
        for here in _each_round(self.rounds, len(self.arcs)):
            ends = [nodes[self.arcs[k].last] for k in here]
            joined = [
                bool(np.abs(ends[k - 1] - nodes[self.arcs[one].first]).max() < near) for k, one in enumerate(here)
            ]
            found[here] = number + np.cumsum([0, *(not one for one in joined[1:])])
            if joined[0]:
                found[here] = np.where(found[here] == found[here[-1]], number, found[here])
            number = int(found[here].max()) + 1
        return found


class ArcWall(NamedTuple):
    """An arc of a region as a wall of its boundary (:mod:`carom.billiards.boundary`)."""

    region: CurvedRegion
    arc: CurveArc

    @property
    def centre(self) -> tuple[float, float]:
        """The origin."""
        return 0.0, 0.0

    @property
    def length(self) -> float:
        """Its length, m."""
        return float(self.region.ways[self.arc.last])

    @property
    def record(self) -> dict[str, Any]:
        """Its fields of PIECES (:mod:`carom.billiards.intersections`)."""
        first, last, (x, y), begins, ends = self.arc
        return {"n": (x, y, 0), "first": first, "last": last, "begins_in_corner": begins, "ends_in_corner": ends}

    def _feet(self, x: Array) -> tuple[NDArray[np.int64], Array]:
        """Return the rows and w of points (N, 2)."""
        (first, last, direction, *_), table, inset = self.arc, self.region.table, self.region.inset
        nodes = table[first:last, X : X + 2] @ np.array(direction)
        row = first + np.clip(np.searchsorted(nodes, x @ np.array(direction), side="right") - 1, 0, len(nodes) - 1)
        rows = table[row]
        xi, eta = chord_frame(rows, x)
        w = np.clip(xi / rows[:, HALF] - 1, -1, 1)
        for _ in range(8 if inset else 1):
            f, f1, f2 = graphs(rows, w)
            dx, dy = xi - rows[:, HALF] * (1 + w), eta - f
            w = np.clip(w + (dx + f1 * dy) / (rows[:, HALF] * (1 + f1 * f1 - f2 * dy)), rows[:, W0], rows[:, W1])
        return row, w

    def along(self, x: Array) -> Array:
        """Return arc lengths."""
        row, w = self._feet(x)
        found: Array = self.region.ways[row] + self.region.length_to(row, w)
        return found

    def place(self, s: Array) -> tuple[Array, Array]:
        """Return points and normals."""
        (first, last, *_), region = self.arc, self.region
        ways = region.ways[first : last + 1]
        row = first + np.clip(np.searchsorted(ways, s, side="right") - 1, 0, len(ways) - 2)
        rows, rest = region.table[row], s - region.ways[row]
        low, high = rows[:, W0], rows[:, W1]
        w = low + (high - low) * rest / (region.ways[row + 1] - region.ways[row])
        for _ in range(8):
            _f, f1, f2 = graphs(rows, w)
            q = np.sqrt(1 + f1 * f1)
            rate = rows[:, HALF] * q * np.maximum(1 - region.inset * f2 / q**3, 1e-6)
            before, w = w, np.clip(w - (region.length_to(row, w) - rest) / rate, low, high)
            if (w == before).all():
                break
        x, t = _nodes(rows, w, region.inset)
        return x, left_of(t)

    def normals(self, x: Array) -> Array:
        """Return normals."""
        row, w = self._feet(x)
        return left_of(_nodes(self.region.table[row], w, 0.0)[1])

    def curvatures(self, x: Array) -> Array:
        """Return curvatures."""
        row, w = self._feet(x)
        _f, f1, f2 = graphs(self.region.table[row], w)
        kappa = f2 / (1 + f1 * f1) ** 1.5
        found: Array = kappa / (1 - self.region.inset * kappa)
        return found


def require_room(name: str, left: float, what: str, inset: float) -> None:
    """Raise CaromError where a ball does not fit."""
    if not left > 0:
        raise CaromError(
            Fault(f"{name}", "radius of the ball", f"one that fits {what}", repr(inset), "take a smaller ball")
        )


def ball_too_large(name: str, inset: float) -> CaromError:
    """Return the refusal of a ball that does not touch all of a wall."""
    expected = (
        "one that touches all of the wall, smaller than its necks and radii of curvature, and without corners in curves"
    )
    return CaromError(
        Fault(name, "radius of the ball", expected, repr(inset), "take a smaller ball, or bounds = 'centre'")
    )


@functools.lru_cache(maxsize=64)
def curved_region(wall: CurvedWall, a: float, touched: CurvedWall | None = None) -> CurvedRegion:
    """Return the region open to the centre of a ball of radius a; ``touched``: what of the wall it touches, where that is known.

    Else CaromError for a ball that does not touch all of the wall: it is larger than a radius of curvature, or than a neck, or the
    wall has a corner that bends towards it.
    """
    wall.require_simple()
    if touched is None:
        touched = wall
        if a > 0 and any(_hides(wall, loop, a) for loop in wall.loops):
            raise ball_too_large(wall.name, a)
    tables, arcs, order, rounds = list[Array](), list[CurveArc](), list[tuple[bool, int]](), list[int]()
    circles: list[Bend] = []
    row = 0
    for number, loop in enumerate(touched.loops):
        rounds.append(len(arcs))
        for one in _parts(number, loop, a):
            if isinstance(one, Bend):
                order.append((True, len(circles)))
                circles.append(one)
                continue
            part, own = _table_of(touched, one, a, row)
            order += [(False, len(arcs) + k) for k in range(len(own))]
            tables.append(part)
            arcs += own
            row += len(part)
    rows = np.concatenate(tables)
    for here in _each_round(rounds, len(arcs)):
        for arc, after in zip(here, here[1:] + here[:1], strict=True):
            # arcs that meet in a corner share it to the last bit, so that nothing passes between them
            end, begin = arcs[arc].last, arcs[after].first
            if np.abs(rows[end, X : X + 2] - rows[begin, X : X + 2]).max() < 1e-11 * wall.size:
                rows[end, X : X + 2] = rows[begin, X : X + 2]
    shown = tuple(len(arcs) * circle + k for circle, k in order) if circles else None
    return CurvedRegion(wall, a, rows, tuple(arcs), tuple(circles), shown, tuple(rounds))


def ellipse_touched(p: float, q: float, a: float) -> tuple[Piece, ...]:
    """Return what a ball of radius a touches of the ellipse (x/p)^2 + (y/q)^2 = 1: all, or an arc on each long side."""
    long, short = max(p, q), min(p, q)
    if a < (1 - CURVATURE_MARGIN) * short**2 / long:
        return (EllipsePiece((p, q)),)
    e = (long - short) * (long + short)
    across = math.sqrt(max((long - short**2 / a) * (long + short**2 / a), 0.0) / e)
    # on the long axis it touches both sides, with the normal (along, across); there (p cos u, q sin u) = (p^2 Nx, q^2 Ny)/h
    u = math.degrees(math.atan2(short * across, long * math.sqrt((1 - across) * (1 + across))))
    turn = 0.0 if p > q else -90.0
    return tuple(EllipsePiece((p, q), turn + side + u, turn + side + 180 - u) for side in (0.0, 180.0))


def _bends(loop: WallLoop) -> dict[int, Bend]:
    """Return the circles around the reflex corners of a loop, by the panels before which they stand."""
    found = {}
    for k in np.flatnonzero(loop.jump < 0).tolist():
        (x, y), (tx, ty), jump = loop.rows[k, OX : OX + 2], loop.begin[k], float(loop.jump[k])
        found[k] = Bend(x, y, math.atan2(tx, -ty) - jump, -jump)
    return found


def _parts(number: int, loop: WallLoop, a: float) -> list[Stretch | Bend]:
    """Return all of a loop, divided at its corners, from the first one on; a ball goes around them on circles."""
    bends, corners = _bends(loop) if a > 0 else {}, np.flatnonzero(loop.jump != 0).tolist()
    first, count = corners[0] if corners else 0, len(loop.rows)
    found: list[Stretch | Bend] = []
    for k in ((first + m) % count for m in range(count)):
        if k in corners or not found:
            # (the circle before the first panel comes last)
            found += [bends[k]] if k in bends and found else []
            found.append(Stretch(number, []))
        stretch = found[-1]
        assert isinstance(stretch, Stretch)
        stretch.panels.append(k)
    return found + ([bends[first]] if first in bends else [])


def _hides(wall: CurvedWall, loop: WallLoop, a: float) -> bool:
    """Return whether a ball of radius a cannot touch all of a loop."""
    rows, w = np.repeat(loop.rows, len(REGION_SAMPLES), axis=0), np.tile(REGION_SAMPLES, len(loop.rows))
    f, f1, f2 = graphs(rows, w)
    q = 1 / np.sqrt(1 + f1 * f1)
    if (loop.jump > 0).any() or a * float((f2 * q**3).max()) >= 1 - TOUCHES:
        return True
    x = rows[:, OX : OX + 2] + plane_of(rows, rows[:, HALF] * (1 + w) - a * f1 * q, f + a * q)
    for one in _bends(loop).values():
        angle = one.first - one.span * (1 + REGION_SAMPLES) / 2
        x = np.concatenate([x, (one.x, one.y) + a * np.stack([np.cos(angle), np.sin(angle)], axis=-1)])
    return bool((wall.depth(x) < a - TOUCHES * wall.size).any())


def _each_round(rounds: Sequence[int], count: int) -> list[list[int]]:
    """Return the numbers of the arcs of each closed curve, given its first one."""
    return [list(range(first, last)) for first, last in pairwise([*rounds, count]) if last > first]


def _table_of(wall: CurvedWall, one: Stretch, a: float, base: int) -> tuple[Array, list[CurveArc]]:
    """Return the rows of a stretch, divided into arcs, and these; ``base``: the number of its first row in the table."""
    loop = wall.loops[one.loop]
    rows = loop.rows[one.panels].copy()
    low, high = rows[:, W0], rows[:, W1]
    begins, tangents = _nodes(rows, low, a)
    last, last_tangent = _nodes(rows[-1:], high[-1:], a)
    # the last node of a closed curve without a corner is its first one
    count = len(loop.rows)
    closed = (one.panels[-1] + 1) % count == one.panels[0] and loop.jump[one.panels[0]] == 0
    if closed:
        last, last_tangent = begins[:1], tangents[:1]
    rows[:, X : X + 2], rows[:, TX : TX + 2] = begins, tangents
    _bounds(rows, a)
    turn, sign = np.arctan(graphs(rows, high)[1]) - np.arctan(graphs(rows, low)[1]), loop.sign[one.panels]
    cuts, way, turned = [0], 0, 0.0
    for k in range(len(rows)):
        if (sign[k] * way < 0) or abs(turned + turn[k]) > LONGEST_ARC:
            cuts.append(k)
            way, turned = 0, 0.0
        way, turned = int(sign[k]) or way, turned + float(turn[k])
    cuts.append(len(rows))
    parts, arcs = [], list[CurveArc]()
    for first, stop in pairwise(cuts):
        node = np.zeros((1, ROW))
        node[:, X : X + 2] = rows[stop, X : X + 2] if stop < len(rows) else last
        node[:, TX : TX + 2] = rows[stop, TX : TX + 2] if stop < len(rows) else last_tangent
        node[:, HALF], node[:, CX] = 1.0, 1.0
        parts += [rows[first:stop], node]
        middle = rows[first, TX : TX + 2] + node[0, TX : TX + 2]
        middle = middle / np.linalg.norm(middle)
        begin = base + first + len(arcs)
        arcs.append(
            CurveArc(
                begin, begin + stop - first, (float(middle[0]), float(middle[1])),
                first == 0 and not closed and not _smooth(loop, one, a, before=True),
                stop == len(rows) and not closed and not _smooth(loop, one, a, before=False),
            )
        )  # fmt: skip
    return np.concatenate(parts), arcs


def _smooth(loop: Any, one: Stretch, a: float, *, before: bool) -> bool:
    """Return whether the centre's curve goes on smoothly beyond an end of a stretch: around a reflex corner."""
    node = one.panels[0] if before else (one.panels[-1] + 1) % len(loop.rows)
    return bool(a > 0 and loop.jump[node] < 0)


def _nodes(rows: Array, w: Array, a: float) -> tuple[Array, Array]:
    """Return places and unit tangents (N, 2) of the parallel curve at w (N)."""
    f, f1, _f2 = graphs(rows, w)
    q = 1 / np.sqrt(1 + f1 * f1)
    t = plane_of(rows, q, f1 * q)
    return rows[:, OX : OX + 2] + plane_of(rows, rows[:, HALF] * (1 + w), f) + a * left_of(t), t


def _bounds(rows: Array, a: float) -> None:
    """Write the ends of the parallel curve in the chord's frame, and bounds of its graph, slope and second derivative."""
    low, high = rows[:, W0], rows[:, W1]
    values = []
    for share in np.linspace(0.0, 1.0, 33):
        w = low + (high - low) * share
        f, f1, f2 = graphs(rows, w)
        q = 1 / np.sqrt(1 + f1 * f1)
        bend = f2 / np.maximum(1 - a * f2 * q**3, 1e-14)
        values.append((rows[:, HALF] * (1 + w) - a * f1 * q, f + a * q, np.abs(f1), np.abs(bend)))
    xi, eta, slope, bend = (np.array(one) for one in zip(*values, strict=True))
    rows[:, FIRST_XI], rows[:, LAST_XI] = xi[0], xi[-1]
    # f is smooth on the scale of a panel: between 33 places it exceeds them by less than a thousandth of its range
    margin = 2e-3 * np.ptp(eta, axis=0) + 1e-15
    rows[:, LOW], rows[:, HIGH] = eta.min(0) - margin, eta.max(0) + margin
    rows[:, SLOPE], rows[:, BEND] = 1.01 * slope.max(0), 1.1 * bend.max(0)
