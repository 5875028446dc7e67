"""Surfaces on which a ball rolls: pipe, cylinder of any section, bowl, dome, torus, ellipsoid, plate, hole; by distance and normal.

A surface is one smooth piece or several that join with a common normal. A piece of your own is a class with three methods:

    distance(x)        from the surface to the place x of the ball's centre, positive on the ball's side
    normal(x)          the gradient of the distance: from the contact point to the centre
    turn(x, n, v)      the rate of change of the normal while the centre moves with v: the Hessian of the distance times v
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import partial
from typing import Any, Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.bodies import holds_arrays
from carom.errors import CaromError, Fault, FaultList, checked_number
from carom.scene.figures import Piece, PlaneFigure, figure

Array = NDArray[np.float64]
SAMPLES = 256  # of each piece, at which the search for the nearest point begins
SECTION_STEPS, SECTION_CLOSE = 30, 4e-16
SMOOTH = 1e-9  # sine of the angle between two pieces that continue each other


@dataclass(frozen=True, eq=False)
class SectionPiece:
    """A cylinder along z over a closed curve of pieces that continue each other smoothly, with their open side on the left."""

    pieces: tuple[Piece, ...]
    side: float
    """1 for a ball on the open side of the curve, -1 for a ball on the other."""
    places: Array
    """(N, 2): points of the curve."""
    parameters: Array
    """(N)."""
    owners: NDArray[np.int64]
    """(N): the piece of each."""
    last: dict[bytes, tuple[Array, Array, float]] = field(default_factory=dict)
    """The foot that was asked for last: distance, normal and turn ask for the same one."""

    def distance(self, x: Array) -> float:
        """From the surface to the centre's place x, positive on the ball's side."""
        foot, left, _bend = self._foot(x)
        return self.side * float((x[:2] - foot) @ left)

    def normal(self, x: Array) -> Array:
        """Return the gradient of the distance."""
        left = self._foot(x)[1]
        return np.array([self.side * left[0], self.side * left[1], 0.0])

    def turn(self, x: Array, n: Array, v: Array) -> Array:
        """Return the rate of change of the normal n while the centre moves with v."""
        # x = y + d n, and the normal turns by -k t along the curve, so that dn/dt = -k/(1 - d k) (v.t) t with k towards the ball
        foot, left, bend = self._foot(x)
        t = np.array([left[1], -left[0]])
        along = float((x[:2] - foot) @ left)
        rate = -self.side * bend / (1.0 - along * bend) * float(v[:2] @ t)
        return np.array([rate * t[0], rate * t[1], 0.0])

    def _foot(self, x: Array) -> tuple[Array, Array, float]:
        """Return the nearest point of the curve (2), the normal to its open side there (2), and its curvature towards that side."""
        asked = x[:2].tobytes()
        if asked in self.last:
            return self.last[asked]
        squares = ((self.places - x[:2]) ** 2).sum(1)
        k = int(squares.argmin())
        number = int(self.owners[k])
        t = float(self.parameters[k])
        for _ in range(3):  # (the nearest point may lie on the next piece)
            piece = self.pieces[number]
            first, last = piece.span()
            t = self._nearest(piece, x, min(max(t, first), last))
            if first < t < last:
                break
            number, step = (number + 1, 0) if t >= last else (number - 1, 1)
            number %= len(self.pieces)
            t = self.pieces[number].span()[step]
        y, d, dd = (one[0] for one in self.pieces[number].at(np.array([t])))
        rate = math.hypot(*d)
        found = y, np.array([-d[1], d[0]]) / rate, float(d[0] * dd[1] - d[1] * dd[0]) / rate**3
        self.last.clear()
        self.last[asked] = found
        return found

    @staticmethod
    def _nearest(piece: Piece, x: Array, t: float) -> float:
        """Return the parameter of the point of a piece that is nearest to x, or its first one beyond an end."""
        first, last = piece.span()
        for _ in range(SECTION_STEPS):
            y, d, dd = (one[0] for one in piece.at(np.array([t])))
            away = x[:2] - y
            slope = float(d @ d - away @ dd)
            step = float(away @ d) / (slope if slope > 0 else float(d @ d))
            new = min(max(t + step, first), last)
            if abs(new - t) <= SECTION_CLOSE * (abs(t) + last - first):
                return new
            t = new
        return t


def section_piece(name: str, loop: list[Piece], inside: bool, ball: float) -> SectionPiece:
    """Return the cylinder over a closed loop, counterclockwise, for a ball of some radius.

    CaromError for a loop with corners, and for a ball that is larger than the radius of curvature somewhere.
    """
    ends = [piece.at(np.array(piece.span()))[1] for piece in loop]
    tangents = [one / np.linalg.norm(one, axis=1, keepdims=True) for one in ends]
    for before, after in zip(tangents, tangents[1:] + tangents[:1], strict=True):
        if abs(before[1, 0] * after[0, 1] - before[1, 1] * after[0, 0]) > SMOOTH or before[1] @ after[0] < 0:
            raise CaromError(Fault("cylinder", "section", "a smooth closed curve", f"the {name}, which has corners"))
    places, parameters, owners, least = [], [], [], math.inf
    for k, piece in enumerate(loop):
        t = np.linspace(*piece.span(), SAMPLES)
        x, d, dd = piece.at(t)
        bend = (d[:, 0] * dd[:, 1] - d[:, 1] * dd[:, 0]) / np.linalg.norm(d, axis=1) ** 3
        sharpest = float((bend if inside else -bend).max())
        least = min(least, 1 / sharpest if sharpest > 0 else math.inf)
        places.append(x)
        parameters.append(t)
        owners.append(np.full(SAMPLES, k))
    if not ball < least:
        raise CaromError(
            Fault("cylinder", "ball", f"a radius below the least one of curvature, {least:.6g} m", f"{ball:g}")
        )
    side = 1.0 if inside else -1.0
    return SectionPiece(tuple(loop), side, np.concatenate(places), np.concatenate(parameters), np.concatenate(owners))


# ----------------------------------------------------------------------------------------------------
# Surfaces on which a ball rolls: pipe, cylinder of any section, bowl, dome, torus, ellipsoid, plate, hole; by distance and normal.


NEWTON, CLOSE = 60, 4e-16
UP = np.array([0.0, 0.0, 1.0])


class SmoothPiece(Protocol):
    """A smooth piece of a surface; places are places of the ball's centre."""

    def distance(self, x: Array) -> float:
        """From the surface to the centre's place x, positive on the ball's side."""

    def normal(self, x: Array) -> Array:
        """Return the gradient of the distance."""

    def turn(self, x: Array, n: Array, v: Array) -> Array:
        """Return the rate of change of the normal n while the centre moves with v."""


@holds_arrays
@dataclass(frozen=True)
class FlatPiece:
    """A plane at ``offset`` from the origin, against its direction for a negative one."""

    direction: Array
    offset: float = 0.0

    def distance(self, x: Array) -> float:
        """Return how far the place x is from the surface, positive on the ball's side."""
        return float(self.direction @ x) - self.offset

    def normal(self, x: Array) -> Array:
        """Return the unit normal at the foot of x, toward the ball."""
        return self.direction

    def turn(self, x: Array, n: Array, v: Array) -> Array:
        """Return the rate at which the normal n at x turns where x moves with v."""
        return np.zeros(x.size)


@holds_arrays
@dataclass(frozen=True)
class RoundPiece:
    """Places at a distance from a point or a line: sphere, cylinder. ``across`` is 0 along its axes."""

    radius: float
    across: Array
    side: float
    """1 for a ball outside, -1 for a ball inside."""

    def distance(self, x: Array) -> float:
        """Return how far the place x is from the surface, positive on the ball's side."""
        return self.side * (_length(self.across * x) - self.radius)

    def normal(self, x: Array) -> Array:
        """Return the unit normal at the foot of x, toward the ball."""
        away = self.across * x
        return (self.side / _length(away)) * away

    def turn(self, x: Array, n: Array, v: Array) -> Array:
        """Return the rate at which the normal n at x turns where x moves with v."""
        across = self.across * v
        return (self.side / _length(self.across * x)) * (across - n * (n @ across))


@dataclass(frozen=True)
class RingPiece:
    """Places at a distance ``tube`` from a circle about the last axis; tube 0 is a circular edge."""

    ring: float
    tube: float
    side: float

    def distance(self, x: Array) -> float:
        """Return how far the place x is from the surface, positive on the ball's side."""
        return self.side * (_length(self._from_circle(x)[0]) - self.tube)

    def normal(self, x: Array) -> Array:
        """Return the unit normal at the foot of x, toward the ball."""
        away = self._from_circle(x)[0]
        return (self.side / _length(away)) * away

    def turn(self, x: Array, n: Array, v: Array) -> Array:
        """Return the rate at which the normal n at x turns where x moves with v."""
        away, outwards, far = self._from_circle(x)
        level = v.copy()
        level[-1] = 0.0
        rate = v - (self.ring / far) * (level - outwards * (outwards @ level))
        return (self.side / _length(away)) * (rate - n * (n @ rate))

    def _from_circle(self, x: Array) -> tuple[Array, Array, float]:
        """From the nearest point of the circle to x, the direction away from the axis, and the distance from it."""
        outwards = x.copy()
        outwards[-1] = 0.0
        far = _length(outwards)
        outwards /= far
        return x - self.ring * outwards, outwards, far


@holds_arrays
@dataclass(frozen=True)
class EllipsoidPiece:
    """An ellipsoid about the origin; an infinite half axis makes a cylinder with an elliptical section."""

    half_axes: Array
    side: float

    def distance(self, x: Array) -> float:
        """Return how far the place x is from the surface, positive on the ball's side."""
        foot, n = self._foot(x)
        return float((x - foot) @ n)

    def normal(self, x: Array) -> Array:
        """Return the unit normal at the foot of x, toward the ball."""
        return self._foot(x)[1]

    def turn(self, x: Array, n: Array, v: Array) -> Array:
        """Return the rate at which the normal n at x turns where x moves with v."""
        # y is the foot, x = y + d n, and dn/dy = W = side P (1/a^2) P / |y/a^2|, so that dn/dt = W (1 + d W)^-1 v.
        foot, _ = self._foot(x)
        project = np.eye(x.size) - np.outer(n, n)
        shape = self.side * project @ np.diag(self.half_axes**-2) @ project / _length(foot / self.half_axes**2)
        return shape @ np.linalg.solve(np.eye(x.size) + float((x - foot) @ n) * shape, v)

    def _foot(self, x: Array) -> tuple[Array, Array]:
        """The nearest point of the surface by Newton's method in its multiplier t, foot = x a^2/(a^2 + t), and the normal there."""
        squares = self.half_axes**2
        finite = np.isfinite(squares)
        a, p = squares[finite], x[finite]
        t = float(
            np.max(np.sqrt(a) * np.abs(p) - a)
        )  # there one term of the sum is 1: Newton's method goes up to the root
        for _ in range(NEWTON):
            scaled = a * p * p / (a + t) ** 2
            step = (float(scaled.sum()) - 1.0) / (2.0 * float((scaled / (a + t)).sum()))
            t += step
            if abs(step) <= CLOSE * (abs(t) + float(a.min())):
                break
        foot = x.copy()
        foot[finite] = p * a / (a + t)
        gradient = np.zeros(x.size)
        gradient[finite] = foot[finite] / a
        return foot, (self.side / _length(gradient)) * gradient


def _length(x: Array) -> float:
    return math.sqrt(float(x @ x))


def _only(_: Array) -> int:
    return 0


@dataclass(frozen=True)
class RollingSurface:
    """A surface on which a ball rolls: smooth pieces, the borders at which one joins another, and places that end a run."""

    name: str
    pieces: tuple[SmoothPiece, ...]
    borders: tuple[tuple[tuple[Callable[[Array], float], int], ...], ...] = ()
    """For each piece: functions of the centre's place that are positive on it, and the piece that follows where one is zero."""
    at: Callable[[Array], int] = _only
    """The piece that is nearest to a place."""
    ends: tuple[tuple[str, Callable[[Array], float]], ...] = ()
    """Names with functions of the centre's place: where one becomes negative, the run ends."""

    def distance(self, x: ArrayLike) -> float:
        """Distance (m) from the surface to a place, positive on the side of the ball."""
        place = np.asarray(x, dtype=float)
        return self.pieces[self.at(place)].distance(place)

    def normal(self, x: ArrayLike) -> Array:
        """Direction from the surface to a place."""
        place = np.asarray(x, dtype=float)
        return self.pieces[self.at(place)].normal(place)


def plane() -> RollingSurface:
    """Make the plane z = 0, with the ball above it."""
    return RollingSurface("plane", (FlatPiece(UP),))


def pipe(radius: float, inside: bool = True) -> RollingSurface:
    """Make a circular cylinder about the z axis."""
    (size,) = _sizes("pipe", radius=radius)
    return RollingSurface("pipe", (RoundPiece(size, 1.0 - UP, -1.0 if inside else 1.0),))


def cylinder(section: Any, ball: float, inside: bool = True, **sizes: Any) -> RollingSurface:
    """Make a cylinder along z over a smooth closed figure in x and y: an oval, a stadium, a curve by a formula or a spline.

    Parameters
    ----------
    section : str, dict, Figure
        As :func:`carom.scene.figures.figure` takes it: "stadium:straight=0.2,radius=0.1", "curve:r=0.1+0.01*cos(3*theta)".
    ball : float
        The ball's radius (m); it is smaller than each radius of curvature that bends towards it.
    inside : bool
        Whether the ball rolls on the inner side.
    **sizes : optional
        Sizes of the figure, by their names.

    Returns
    -------
    RollingSurface

    Raises
    ------
    CaromError
        A figure with corners, or not of one closed curve in the plane; a ball that does not reach each point of it.

    Examples
    --------
    A ball in a vertical pipe with an oval section does not fall either:

    >>> import carom
    >>> from carom import billiards
    >>> oval = billiards.surfaces.cylinder("ellipse", 0.02, half_axes=(0.12, 0.1))
    >>> run = billiards.roll(oval, (0.1, 0, 0), (0, 3, 0), ball=carom.Ball(0.02, 0.1), duration=1.0, accuracy=1e-9)
    >>> bool((run.at([0.3, 0.6, 0.9]).place[:, 2] > -0.06).all())
    True
    """
    made = figure(section, **sizes)
    (small,) = _sizes("cylinder", ball=ball)
    if not isinstance(made, PlaneFigure) or len(made.outline()) != 1:
        raise CaromError(Fault("cylinder", "section", "a figure in the plane with one closed curve", made.describe()))
    return RollingSurface("cylinder", (section_piece(made.kind(), made.outline()[0], inside, small),))


def bowl(radius: float) -> RollingSurface:
    """Make a sphere about the origin with the ball inside."""
    (size,) = _sizes("bowl", radius=radius)
    return RollingSurface("bowl", (RoundPiece(size, np.ones(3), -1.0),))


def dome(radius: float) -> RollingSurface:
    """Make a sphere about the origin with the ball outside."""
    (size,) = _sizes("dome", radius=radius)
    return RollingSurface("dome", (RoundPiece(size, np.ones(3), 1.0),))


def torus(ring: float, tube: float, inside: bool = False) -> RollingSurface:
    """Make a torus about the z axis: a tube about a circle of radius ``ring``; the ball outside it, or inside."""
    around, size = _sizes("torus", ring=ring, tube=tube)
    if size >= around:
        raise CaromError(Fault("torus", "tube", f"a radius below that of the ring, {around:g} m", f"{size:g}"))
    return RollingSurface("torus", (RingPiece(around, size, -1.0 if inside else 1.0),))


def ellipsoid(half_axes: Sequence[float], inside: bool = True) -> RollingSurface:
    """Make an ellipsoid about the origin; ``math.inf`` as a half axis makes a cylinder with an elliptical section."""
    finite = {f"half_axes[{i}]": one for i, one in enumerate(half_axes) if one != math.inf}
    _sizes("ellipsoid", **finite)
    axes = np.array(half_axes, dtype=float)
    if axes.shape != (3,):
        raise CaromError(Fault("ellipsoid", "half_axes", "three lengths", repr(half_axes)))
    return RollingSurface("ellipsoid", (EllipsoidPiece(axes, -1.0 if inside else 1.0),))


def plate(radius: float) -> RollingSurface:
    """Make a thin round plate in z = 0: the ball rolls on one face, around the sharp edge, and on the other face.

    As the ball's radius goes to 0, rolling around the edge becomes the bounce of a no-slip billiard (Cox, Feres & Zhao, *Rolling
    systems and their billiard limits*, arXiv 2009.05890). Without gravity only a ball that is held stays on the edge.
    """
    (size,) = _sizes("plate", radius=radius)
    return _two_faces("plate", size, 0.0, 1.0)


def sheets(radius: float, gap: float, ball: float) -> RollingSurface:
    """Make two round sheets that join in a rounded edge, with the ball between them: a gap wider than the ball by ``2 gap``.

    As the gap goes to 0, rolling around the edge becomes the bounce of a no-slip billiard (Borisov, Kilin & Mamaev, Regul. Chaotic
    Dyn. 16, 653 (2011)). ``ball`` is the ball's radius.
    """
    size, free, small = _sizes("sheets", radius=radius, gap=gap, ball=ball)
    return _two_faces("sheets", size, free + small, -1.0)


def _two_faces(name: str, ring: float, tube: float, side: float) -> RollingSurface:
    """Two faces at the distance ``tube`` from a disc, joined around its edge; ``side`` is 1 for a ball outside."""

    up, edge = side * UP, RingPiece(ring, tube, side)
    pieces = (
        FlatPiece(up, side * tube),
        FlatPiece(-up, side * tube),
        edge,
        edge,
    )  # (the edge's upper and its lower half)
    before, beyond = partial(_inside, ring), partial(_outside, ring)
    borders = (((before, 2),), ((before, 3),), ((beyond, 0), (_above, 3)), ((beyond, 1), (_below, 2)))
    return RollingSurface(name, pieces, borders, partial(_face, ring))


def _face(ring: float, x: Array) -> int:
    return int(x[-1] < 0) + 2 * int(_outside(ring, x) > 0)


def hole(radius: float = 0.054, depth: float = 0.1, ball: float = 0.02135) -> RollingSurface:
    """Make a hole in a green, by default golf's: a plane, a sharp circular rim, the cylinder below it.

    A run ends with "bottom" when the ball touches the bottom, and with "away" when its centre is two radii from the axis.
    """
    size, bottom, small = _sizes("hole", radius=radius, depth=depth, ball=ball)
    if small >= size:
        raise CaromError(Fault("hole", "ball", f"a radius below that of the hole, {size:g} m", f"{small:g}"))

    green, rim, wall = FlatPiece(UP), RingPiece(size, 0.0, 1.0), RoundPiece(size, 1.0 - UP, -1.0)
    outside, inside = partial(_outside, size), partial(_inside, size)
    borders = (((outside, 1),), ((inside, 0), (_above, 2)), ((_below, 1),))
    ends = (("bottom", partial(_above, low=small - bottom)), ("away", partial(_inside, 2.0 * size)))
    return RollingSurface("hole", (green, rim, wall), borders, partial(_part_of_hole, size), ends)


def _part_of_hole(size: float, x: Array) -> int:
    return 0 if _outside(size, x) >= 0 else 1 if x[-1] >= 0 else 2


# Functions of a place that are positive on one side of a border.
def _outside(radius: float, x: Array) -> float:
    return _from_axis(x) - radius


def _inside(radius: float, x: Array) -> float:
    return radius - _from_axis(x)


def _above(x: Array, low: float = 0.0) -> float:
    return float(x[-1]) - low


def _below(x: Array) -> float:
    return -float(x[-1])


def _from_axis(x: Array) -> float:
    return _length(x[:-1])


def _positive_number(faults: FaultList, field: str, value: Any) -> float:
    """Return a length > 0; add a fault for anything else."""
    found = checked_number(faults, field, value, "a length > 0", lambda x: (x > 0) & (x < math.inf))
    if isinstance(found, float):
        return found
    faults.add(field, "one number", repr(value))
    return 1.0


def _sizes(where: str, **sizes: float) -> list[float]:
    """Return lengths in m, each more than 0; CaromError with all faults."""
    faults = FaultList(where)
    found = [_positive_number(faults, name, value) for name, value in sizes.items()]
    faults.raise_if_any()
    return found
