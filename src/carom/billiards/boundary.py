"""The boundary of the region open to a ball's centre, as walls: their records, arc length, normals, distance to it."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from itertools import combinations
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.billiards.curved_wall import (
    CurvedRegion,
    CurvedWall,
    ball_too_large,
    curved_region,
    ellipse_touched,
    require_room,
)
from carom.billiards.intersections import BILLIARD, PIECES
from carom.bodies import holds_arrays
from carom.errors import CaromError, Fault
from carom.scene.figures import CellFigure, Figure, PlaneFigure
from carom.scene.figures.cells import DiscsFigure
from carom.scene.figures.curve import PlatesFigure, StripFigure, WedgeFigure
from carom.scene.figures.figure import ArcPiece, EllipsePiece, Loop, SegmentPiece, joints
from carom.scene.figures.polygons import RectangleFigure, ellipse_depth, polygon_depth
from carom.scene.figures.rounds import BoxFigure, CylinderFigure, SphereFigure

Array = NDArray[np.float64]
INF = math.inf

# Every wall has a length; ``along`` gives the arc lengths (N) of points x (N, 2) on it, ``place`` points and normals (N, 2) at arc
# lengths, ``normals`` (N, 2 or 3) towards the ball and ``curvatures`` (N) at points; points are relative to its ``centre``.


class Face(NamedTuple):
    """A straight wall, or a plane one in space; its fields are named as in :data:`carom.billiards.intersections.PIECES`."""

    normal: tuple[float, float, float]
    """Towards the ball."""
    offset: float
    """The face is n.x = offset, the ball at n.x > offset."""
    separation: float
    """Distance of a window of a periodic cell from the opposite one."""
    begin: float
    """Where it begins, along the tangent (ny, -nx)."""
    end: float
    low: float
    """Its beginning if that is a corner, else -infinity."""
    high: float
    """Its end if that is a corner, else infinity."""

    @property
    def centre(self) -> tuple[float, float]:
        """The origin."""
        return 0.0, 0.0

    @property
    def is_lid(self) -> bool:
        """Whether it closes a cylinder: its normal lies along z."""
        return self.normal[2] != 0

    @property
    def length(self) -> float:
        """Its length, m."""
        return self.end - self.begin

    @property
    def record(self) -> dict[str, Any]:
        """Its fields of PIECES."""
        return {"n": self.normal} | {name: getattr(self, name) for name in self._fields[1:]}

    def along(self, x: Array) -> Array:
        """Return arc lengths."""
        n = self.normal
        found: Array = n[1] * x[:, 0] - n[0] * x[:, 1] - (self.begin if math.isfinite(self.begin) else 0.0)
        return found

    def place(self, s: Array) -> tuple[Array, Array]:
        """Return points and normals."""
        n = np.array(self.normal[:2])
        return n * self.offset + np.multiply.outer(s + self.begin, [n[1], -n[0]]), np.tile(n, (len(s), 1))

    def normals(self, x: Array) -> Array:
        """Return normals."""
        return np.tile(self.normal, (len(x), 1))

    def curvatures(self, x: Array) -> Array:
        """Return curvatures."""
        return np.zeros(len(x))


class Circle(NamedTuple):
    """A circle seen from inside or from outside, and the arc of it that a ball can meet."""

    x: float
    y: float
    radius: float
    first: float = 0.0
    """Angle at which the arc begins, rad."""
    span: float = math.tau
    """Angle of the arc."""
    way: float = -1.0
    """1: seen from inside, the arc runs counterclockwise; -1: from outside, it runs clockwise."""
    half: float = 0.0
    """-1 or 1: only the half to the left or to the right of the centre; 0: the whole circle."""
    image_of: int | None = None
    """Number of the obstacle of which it is an image in a neighbouring periodic cell."""

    @property
    def centre(self) -> tuple[float, float]:
        """Its centre."""
        return self.x, self.y

    @property
    def length(self) -> float:
        """Its length, m."""
        return self.span * self.radius

    @property
    def record(self) -> dict[str, Any]:
        """Its fields of PIECES."""
        return {"center": (self.x, self.y), "radius": self.radius, "curvature": 1 / self.radius, "half": self.half}

    def along(self, x: Array) -> Array:
        """Return arc lengths."""
        found: Array = self.radius * (self.way * (np.arctan2(x[:, 1], x[:, 0]) - self.first) % math.tau)
        return found

    def place(self, s: Array) -> tuple[Array, Array]:
        """Return points and normals."""
        angle = self.first + self.way * (s / self.radius)
        out = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
        return np.array(self.centre) + self.radius * out, -self.way * out

    def normals(self, x: Array) -> Array:
        """Return normals."""
        return -self.way * x / self.radius

    def curvatures(self, x: Array) -> Array:
        """Return curvatures."""
        return np.full(len(x), self.way / self.radius)


class WholeEllipse(NamedTuple):
    """An ellipse about the origin, which bounds the ball's centre."""

    p: float
    """Half axis in x."""
    q: float
    """Half axis in y."""

    @property
    def centre(self) -> tuple[float, float]:
        """The origin."""
        return 0.0, 0.0

    @property
    def piece(self) -> EllipsePiece:
        """The same, as a figure has it."""
        return EllipsePiece((self.p, self.q))

    @property
    def length(self) -> float:
        """Its length, m."""
        return self.piece.length

    @property
    def record(self) -> dict[str, Any]:
        """Its fields of PIECES."""
        return {"half_axes": (self.p, self.q)}

    def along(self, x: Array) -> Array:
        """Return arc lengths."""
        return self.piece.arc_length(np.arctan2(x[:, 1] / self.q, x[:, 0] / self.p) % math.tau)

    def place(self, s: Array) -> tuple[Array, Array]:
        """Return points and normals."""
        x = self.piece.place(s)
        return x, self.normals(x)

    def normals(self, x: Array) -> Array:
        """Return normals."""
        n = -x / (self.p**2, self.q**2)
        found: Array = n / np.linalg.norm(n, axis=-1, keepdims=True)
        return found

    def curvatures(self, x: Array) -> Array:
        """Return curvatures."""
        n = self.normals(x)
        found: Array = np.hypot(self.p * n[:, 0], self.q * n[:, 1]) ** 3 / (self.p * self.q) ** 2
        return found


class ConnectedWall(NamedTuple):
    """Pieces of a boundary that follow each other without a gap."""

    pieces: tuple[int, ...]
    """Their indices, without windows."""
    first: float
    """Arc length at its beginning, m; -infinity for a wall without an end."""
    last: float
    """Arc length at its end, m."""
    closed: bool
    """Whether its end is its beginning."""


def face(
    nx: float,
    ny: float,
    c: float,
    begin: float = -INF,
    end: float = INF,
    *,
    low: float | None = None,
    high: float | None = None,
    nz: float = 0.0,
) -> Face:
    """Return the face n.x = c with the ball at n.x > c; its ends are corners unless ``low`` or ``high`` is infinite."""
    return Face((nx, ny, nz), c, 0.0, begin, end, begin if low is None else low, end if high is None else high)


@holds_arrays
@dataclass
class Boundary:
    """The pieces of the boundary by kind, and how they follow each other; once it is measured it is not changed."""

    faces: list[Face] = field(default_factory=list)
    windows: list[Face] = field(default_factory=list)
    """Sides of a periodic cell, through which a ball passes to the opposite one."""
    inside: list[Circle] = field(default_factory=list)
    """Circles seen from inside."""
    outside: list[Circle] = field(default_factory=list)
    images: list[Circle] = field(default_factory=list)
    order: list[int] | None = None
    """Indices of the pieces in the order in which they follow each other along the boundary; None: by index."""
    ellipse: WholeEllipse | None = None
    curve: CurvedRegion | None = None
    """Arcs of a smooth curve."""
    sphere: float | None = None
    """Radius of a sphere about the origin."""
    finite_faces: bool = False
    """Whether hits beyond the ends of a face are ignored (a stadium, a table that is not convex)."""
    size: float = 1.0
    """Length that sets the tolerances, m."""
    vertices: Array | None = None
    """Vertices of the wall, of a polygon that is not convex: they decide what lies within."""
    clearance: float = 0.0
    """Distance that the centre keeps from that polygon."""
    cell: tuple[float, float] | None = None
    """Sides of the periodic cell about the origin; infinite where it is not periodic."""

    @functools.cached_property
    def walls(self) -> list[Any]:
        """Its pieces but windows, images and a sphere: what has an arc length, by number."""
        arcs = [] if self.curve is None else self.curve.walls
        return [*self.faces, *self.inside, *self.outside, *([self.ellipse] if self.ellipse else []), *arcs]

    def arrays(self) -> tuple[Any, NDArray[np.void]]:
        """Return the BILLIARD record, still without ball and law, and the array of PIECES."""
        kinds: dict[str, Sequence[Any]] = {
            "faces": self.faces, "windows": self.windows, "inside": self.inside, "outside": [*self.outside, *self.images],
            "ellipses": [self.ellipse] if self.ellipse else [], "curves": [] if self.curve is None else self.curve.walls,
        }  # fmt: skip
        rows: list[dict[str, Any]] = []
        world = np.zeros(1, BILLIARD)
        for name, some in kinds.items():
            rows += [one.record for one in some]
            world[name] = len(rows)
        if self.curve is not None:
            world["inset"], world["arc_corners"] = self.curve.inset, any(max(arc[3:]) for arc in self.curve.arcs)
        if self.sphere is not None:
            rows.append({"radius": self.sphere, "curvature": 1 / self.sphere})
        world["spheres"] = len(rows)
        world["finite_faces"], world["corner_tolerance"] = self.finite_faces, 1e-12 * self.size
        world["extent"] = self.size
        pieces = np.zeros(len(rows), PIECES)
        for piece, row in zip(pieces, rows, strict=True):
            for name, value in row.items():
                piece[name] = value
        return world, pieces

    def crossed_by(self, acceleration: Sequence[float]) -> bool:
        """Return whether an acceleration has a component across a wall or a window."""
        flat = bool(acceleration[0] or acceleration[1])
        if any(
            n[0] * acceleration[0] + n[1] * acceleration[1] + n[2] * acceleration[2]
            for n, *_ in [*self.faces, *self.windows]
        ):
            return True
        round_in_plane = self.inside or self.outside or self.ellipse or self.curve
        return flat if round_in_plane else self.sphere is not None and any(acceleration)

    @property
    def parts(self) -> NDArray[np.int64]:
        """Number of the smooth part of each piece, without windows and images: arcs of a smooth curve between corners are one."""
        pieces = np.arange(len(self.walls))
        if self.curve is not None:
            first = len(pieces) - len(self.curve.arcs)
            pieces[first:] = first + self.curve.parts
        return pieces

    def wall_parts(self, met: Any) -> NDArray[np.int64]:
        """Return the smooth parts of pieces (...) that are met, without windows and with images as their obstacles; -1 for none."""
        found: NDArray[np.int64] = np.append(self.parts, -1)[self._number(met)]
        return found

    def without_lids(self) -> Boundary:
        """Return the boundary of the section of a prism: its pieces but the lids, which follow the other faces."""
        sides, faces = sum(not f.is_lid for f in self.faces), len(self.faces)
        order = self.order and [k - (faces - sides) * (k >= faces) for k in self.order if not sides <= k < faces]
        return replace(self, faces=self.faces[:sides], order=order)

    # --- arc length ---------------------------------------------------------------------------------------------------

    @functools.cached_property
    def lengths(self) -> Array:
        """Length of each piece, without windows and images; infinite for a strip and a wedge."""
        return np.array([wall.length for wall in self.walls])

    @functools.cached_property
    def starts(self) -> Array:
        """Arc length at which each piece begins."""
        lengths = np.where(np.isfinite(self.lengths), self.lengths, 0.0)
        order = list(range(len(lengths))) if self.order is None else self.order
        starts = np.empty(len(lengths))
        starts[order] = np.concatenate([[0.0], np.cumsum(lengths[order])[:-1]])
        return starts

    @functools.cached_property
    def _numbers(self) -> NDArray[np.int64]:
        """The number among the walls of each piece, an image as its obstacle, and of none at last; a sphere comes after them."""
        numbers, flat = list(range(len(self.walls) + 1)), len(self.faces)
        round_ = flat + len(self.inside) + len(self.outside)
        images = [flat + len(self.inside) + (one.image_of or 0) for one in self.images]
        return np.array(
            [*numbers[:flat], *[-1] * len(self.windows), *numbers[flat:round_], *images, *numbers[round_:], -1]
        )

    def _number(self, met: Any) -> NDArray[np.int64]:
        """Return the numbers of the walls of pieces (...) that are met; -1 for none."""
        found: NDArray[np.int64] = self._numbers[np.asarray(met, np.int64)]
        return found

    def _relative(self, wall: Any, x: Array) -> Array:
        """Return points (N, 2) relative to a wall's centre, in a periodic cell to the nearest one."""
        return self.folded(x[:, :2] - wall.centre)

    def coordinate(self, met: Any, x: Any) -> Array:
        """Return the arc length s (...) of points (..., 2 or 3) on pieces (...); it grows with the ball on the left."""
        number, x = self._number(met), self.folded(np.asarray(x, float))
        s = np.full(number.shape, np.nan)
        for k, wall in enumerate(self.walls):
            here = number == k
            s[here] = self.starts[k] + wall.along(self._relative(wall, x[here]))
        return s

    def place(self, s: Any) -> tuple[NDArray[np.int64], Array, Array]:
        """Return the piece, the point (..., 2) and the normal (..., 2) at an arc length (...) of a closed boundary."""
        lengths, starts = self.lengths, self.starts
        order = np.argsort(starts, kind="stable")
        s = np.asarray(s, float) % lengths.sum()
        k = order[np.clip(np.searchsorted(starts[order], s, side="right") - 1, 0, len(order) - 1)]
        along = s - starts[k]
        x, n = np.empty((*s.shape, 2)), np.empty((*s.shape, 2))
        for m, wall in enumerate(self.walls):
            here = k == m
            x[here], n[here] = wall.place(along[here])
        (pieces,) = np.nonzero(self._numbers[:-1] >= 0)
        first = np.unique(self._numbers[pieces], return_index=True)[1]
        return pieces[first][k], x, n

    @functools.cached_property
    def connected(self) -> list[ConnectedWall]:
        """Return the walls whose pieces follow each other without a gap, in the order of their arc lengths; no lids.

        Walls without an end share one coordinate, and are one.
        """
        lengths, starts = self.lengths, self.starts
        endless = [k for k, one in enumerate(self.faces) if math.isinf(one.length) and not one.is_lid]
        found = [ConnectedWall(tuple(endless), -INF, INF, False)] if endless else []
        order = range(len(lengths)) if self.order is None else self.order
        pieces: list[int] = []
        ends: dict[int, Array] = {}
        for k in [k for k in order if math.isfinite(lengths[k])]:
            ends[k] = self.walls[k].place(np.array([0.0, lengths[k]]))[0]
            if pieces and not self._together(ends[pieces[-1]][1], ends[k][0]):
                found.append(self._wall_of(pieces, ends, starts, lengths))
                pieces = []
            pieces.append(k)
        return [*found, self._wall_of(pieces, ends, starts, lengths)] if pieces else found

    def _wall_of(self, pieces: list[int], ends: dict[int, Array], starts: Array, lengths: Array) -> ConnectedWall:
        first, last = pieces[0], pieces[-1]
        closed = self._together(ends[last][1], ends[first][0])
        return ConnectedWall(tuple(pieces), float(starts[first]), float(starts[last] + lengths[last]), closed)

    def _together(self, x: Array, y: Array) -> bool:
        """Return whether two points (2,) are the same one, or images of it."""
        return bool(np.abs(self.folded(x - y)).max() < 1e-9 * self.size)

    def wall_numbers(self, met: Any) -> NDArray[np.int64]:
        """Return which of the connected walls pieces (...) belong to; -1 for lids, spheres and none."""
        pieces = np.full(len(self.lengths) + 2, -1)  # (beyond them a sphere; the last entry is for piece -1, none)
        for number, wall in enumerate(self.connected):
            pieces[list(wall.pieces)] = number
        found: NDArray[np.int64] = pieces[self._number(met)]
        return found

    def normals(self, met: Any, x: Any) -> Array:
        """Return normals (..., 3) towards the ball at points (..., 2 or 3) on pieces (...); NaN where the piece is -1."""
        number, x = self._number(met), np.asarray(x, float)
        n = np.full((*number.shape, 3), np.nan)
        for k, wall in enumerate(self.walls):
            here = number == k
            found = wall.normals(self._relative(wall, x[here]))
            n[here] = 0.0
            n[here, : found.shape[1]] = found
        if self.sphere is not None:
            here = number == len(self.walls)
            n[here] = -x[here] / self.sphere
        return n

    def curvatures(self, met: Any, x: Any) -> Array:
        """Return curvatures (N) of the centre's curve at points (N, 2 or more) on pieces (N): 1/r in a circle, -1/r around one."""
        number, x = self._number(met), np.asarray(x, float)
        found = np.zeros(number.shape)
        for k, wall in enumerate(self.walls):
            here = number == k
            found[here] = wall.curvatures(self._relative(wall, x[here]))
        return found

    def folded(self, x: Array) -> Array:
        """Return points translated into the periodic cell, whose centre is the origin."""
        if self.cell is None:
            return x
        x = x.copy()
        for j, side in enumerate(self.cell):
            if math.isfinite(side):
                x[..., j] -= side * np.round(x[..., j] / side)
        return x

    # --- distance to the boundary ---------------------------------------------------------------------------------------------

    def gap(self, x: Any) -> Array:
        """Return a lower bound (...) of the distance of centres (..., 2 or 3) to the boundary; negative outside."""
        x = self.folded(np.asarray(x, float))
        x = np.concatenate([x, np.zeros((*x.shape[:-1], 3 - x.shape[-1]))], axis=-1)
        gap: Array = np.full(x.shape[:-1], INF)
        if self.vertices is not None:
            gap = polygon_depth(self.vertices, x) - self.clearance
        elif self.faces:
            for n, c, *_ in self.faces:
                gap = np.minimum(gap, x @ np.array(n) - c)
        if any(one.half for one in self.inside):
            right, _y, r, *_ = max(self.inside)
            gap = np.minimum(gap, r - np.hypot(np.maximum(np.abs(x[..., 0]) - right, 0), x[..., 1]))
        else:
            for cx, cy, r, *_ in self.inside:
                gap = np.minimum(gap, r - np.hypot(x[..., 0] - cx, x[..., 1] - cy))
        for cx, cy, r, *_ in [*self.outside, *self.images]:
            gap = np.minimum(gap, np.hypot(x[..., 0] - cx, x[..., 1] - cy) - r)
        if self.ellipse is not None:
            gap = np.minimum(gap, ellipse_depth(*self.ellipse, x))
        if self.curve is not None:
            depth = self.curve.wall.depth(x[..., :2].reshape(-1, 2)).reshape(gap.shape)
            gap = np.minimum(gap, depth - self.curve.inset)
        if self.sphere is not None:
            gap = np.minimum(gap, self.sphere - np.linalg.norm(x, axis=-1))
        return gap


# ----------------------------------------------------------------------------------------------------
# The boundary of the region open to a ball's centre in a figure: its pieces, one ball's radius inside.


MANY = 2000  # sides of a polygon, beyond which its necks are not sought
NECK = 1e-9  # of the size: so much nearer to another side is more than rounding
SMOOTH = 1e-12  # sine of the angle between two pieces that continue each other
WHOLE, RIGHT, LEFT = (0.0, 360.0), (-90.0, 90.0), (90.0, 270.0)  # the arcs that a billiard's loops follow
HALVES = {WHOLE: 0.0, RIGHT: 1.0, LEFT: -1.0}


@functools.lru_cache(maxsize=64)
def boundary_of(figure: Figure, inset: float, name: str = "") -> Boundary:
    """Return the boundary of a figure for a centre that stays ``inset``, m, away from its wall.

    CaromError, one line, where the ball does not fit, and for a figure with a piece that billiards do not have.
    """
    name = name or figure.kind()
    for kind, make in BY_KIND.items():
        if isinstance(figure, kind):
            return make(name, figure, inset)
    if not isinstance(figure, PlaneFigure):
        raise CaromError(Fault(name, "", "a figure that billiards have", type(figure).__name__))
    return _outline(name, figure, inset)


def _outline(name: str, figure: PlaneFigure, inset: float) -> Boundary:
    """Return the boundary of a figure by the pieces of its outline."""
    outside, *inner = figure.outline()
    if not (_has_closed_form(outside) and all(_is_circle(loop, -1.0) for loop in inner)):
        return _curved(name, figure, inset)
    first = outside[0]
    if len(outside) == 1 and isinstance(first, EllipsePiece):
        p, q = first.half_axes
        require_room(name, min(p, q) - inset, f"in the {name}", inset)
        found = _ellipse(name, first, inset)
    elif len(outside) == 1 and isinstance(first, ArcPiece):
        require_room(name, first.radius - inset, f"in the {name}", inset)
        found = Boundary(inside=[Circle(*first.center, first.radius - inset, way=1.0)], size=first.radius)
    else:
        found = _chain(name, outside, inset)
        if inset > 0 and found.vertices is not None and _closes_a_neck(name, figure, inset):
            raise ball_too_large(name, inset)
    for loop in inner:
        one: Any = loop[0]
        found.outside.append(Circle(one.center[0], one.center[1], one.radius + inset))
    return found


def _ellipse(name: str, piece: EllipsePiece, inset: float) -> Boundary:
    """Return the boundary within an ellipse: itself for a centre, for a ball the parallel curve of what it touches."""
    p, q = piece.half_axes
    if not inset:
        return Boundary(ellipse=WholeEllipse(p, q), size=max(p, q))
    wall, touched = CurvedWall(name, ((piece,),)), ellipse_touched(p, q, inset)
    region = curved_region(wall, inset, wall if len(touched) == 1 else CurvedWall(name, (touched,), is_whole=False))
    return Boundary(curve=region, size=max(p, q))


def _is_circle(loop: Loop, way: float) -> bool:
    """Return whether a loop is a whole circle, counterclockwise for a way of 1."""
    one = loop[0]
    return len(loop) == 1 and isinstance(one, ArcPiece) and one.to_angle_deg - one.from_angle_deg == 360.0 * way


def _has_closed_form(loop: Loop) -> bool:
    """Return whether a loop is a circle, an ellipse, or segments that half circles may continue without a corner."""
    first = loop[0]
    if len(loop) == 1:
        return _is_circle(loop, 1.0) or (isinstance(first, EllipsePiece) and first.is_whole)
    if all(isinstance(piece, SegmentPiece) for piece in loop):
        return True
    halves = [isinstance(piece, ArcPiece) and (piece.from_angle_deg, piece.to_angle_deg) in HALVES for piece in loop]
    if not all(half or isinstance(piece, SegmentPiece) for half, piece in zip(halves, loop, strict=True)):
        return False
    smooth = np.abs(joints(loop).turn) <= SMOOTH
    return all(smooth[k - 1] and smooth[k] for k, half in enumerate(halves) if half)


@functools.lru_cache(maxsize=64)
def _wall_of(name: str, figure: PlaneFigure) -> CurvedWall:
    """Return the wall of a figure, cut into panels once for all balls."""
    return CurvedWall(name, tuple(tuple(loop) for loop in figure.outline()))


def _curved(name: str, figure: PlaneFigure, inset: float) -> Boundary:
    """Return the boundary of a figure whose wall has a smooth curve."""
    wall = _wall_of(name, figure)
    region = curved_region(wall, inset)
    outside = [Circle(x, y, inset, first, span) for x, y, first, span in region.reflex]
    # (circles come before arcs among the pieces)
    arcs, circles = len(region.arcs), len(outside)
    order = None if region.order is None else [k + circles if k < arcs else k - arcs for k in region.order]
    return Boundary(outside=outside, curve=region, order=order, size=wall.size)


def _chain(name: str, loop: Loop, inset: float) -> Boundary:
    """Return the boundary of a loop of segments, of which half circles may continue some without a corner."""
    ends, tangents, speed, turn, cos = joints(loop)
    lengths = np.array(
        [s if isinstance(piece, SegmentPiece) else piece.length for piece, s in zip(loop, speed, strict=True)]
    )
    reflex, smooth = turn < -SMOOTH, np.abs(turn) <= SMOOTH
    # a convex corner shortens both its sides by inset/tan(half the inner angle)
    cut = np.where(reflex | smooth, 0.0, inset * turn / (1 + cos))
    faces: list[Face] = []
    arcs: list[Circle] = []
    outside: list[Circle] = []
    order: list[tuple[str, int]] = []
    for k, piece in enumerate(loop):
        before = k - 1
        if isinstance(piece, ArcPiece):
            half = HALVES[piece.from_angle_deg, piece.to_angle_deg]
            require_room(name, piece.radius - inset, f"in the {name}", inset)
            order.append(("inside", len(arcs)))
            arcs.append(Circle(*piece.center, piece.radius - inset, -half * math.pi / 2, math.pi, 1.0, half))
            continue
        side: Any = piece
        (tx, ty), (x, y) = tangents[k, 0].tolist(), side.start
        x0 = tx * x + ty * y
        begin, end = float(x0 + cut[before]), float(x0 + lengths[k] - cut[k])
        require_room(name, end - begin, f"to touch side {k + 1}", inset)
        # around a reflex vertex the centre moves on a circle
        low = -INF if smooth[before] or (reflex[before] and inset) else begin
        high = INF if smooth[k] or (reflex[k] and inset) else end
        order.append(("face", len(faces)))
        faces.append(face(0.0 - ty, tx, -ty * x + tx * y + inset, begin, end, low=low, high=high))
        if reflex[k] and inset:
            span = math.acos(max(-1.0, min(1.0, float(cos[k]))))
            order.append(("outside", len(outside)))
            outside.append(Circle(side.end[0], side.end[1], inset, math.atan2(tx, -ty), span))
    number = {"face": 0, "inside": len(faces), "outside": len(faces) + len(arcs)}
    found = Boundary(
        faces=faces, inside=arcs, outside=outside, order=[number[kind] + k for kind, k in order],
        finite_faces=bool(arcs) or bool(reflex.any()), size=_extent(loop) if arcs else float(lengths.max()),
    )  # fmt: skip
    if reflex.any():
        found.vertices, found.clearance = ends[:, 0], inset
    return found


@functools.lru_cache(maxsize=64)
def _closes_a_neck(name: str, figure: PlaneFigure, inset: float) -> bool:
    """Return whether parts of a polygon's boundary lie nearer to other sides: the ball is larger than a neck."""
    shape = _chain(name, figure.outline()[0], inset)
    if len(shape.lengths) > MANY:
        return False
    share = (np.arange(4) + 0.5) / 4
    x = shape.place((shape.starts[:, None] + shape.lengths[:, None] * share).ravel())[1]
    return bool((shape.gap(x) < -NECK * shape.size).any())


def _extent(loop: Loop) -> float:
    """Return the greatest distance of a loop of segments and arcs from the origin along x or y."""
    reach = [abs(x) + piece.radius for piece in loop if isinstance(piece, ArcPiece) for x in piece.center]
    return max([*reach, *(abs(x) for piece in loop if isinstance(piece, SegmentPiece) for x in piece.start)])


def _strip(name: str, figure: StripFigure, inset: float) -> Boundary:
    return _between(name, figure.width, inset)


def _plates(name: str, figure: PlatesFigure, inset: float) -> Boundary:
    return _between(name, figure.distance, inset)


def _between(name: str, width: float, inset: float) -> Boundary:
    require_room(name, width / 2 - inset, "between the walls", inset)
    c = inset - width / 2
    return Boundary(faces=[face(0, 1, c), face(0, -1, c)], size=width)


def _wedge(_name: str, figure: WedgeFigure, inset: float) -> Boundary:
    angle = math.radians(figure.angle)
    cos, sin = math.cos(angle / 2), math.sin(angle / 2)
    # the wedge of the centre has its vertex at (inset/sin, 0)
    tip = cos * inset / sin
    # arc length, with the ball on the left: inwards along the upper wall, outwards along the lower
    return Boundary(faces=[face(sin, cos, inset, tip), face(sin, -cos, inset, end=-tip)], size=1.0 + inset)


def _discs(name: str, figure: DiscsFigure, inset: float) -> Boundary:
    circles = [(x, y, radius + inset) for x, y, radius in figure.obstacles]
    for (x, y, r), (u, v, q) in combinations(circles, 2):
        require_room(name, math.hypot(x - u, y - v) - r - q, "between obstacles", inset)
    low, high = (
        [f(one[axis] + side * one[2] for one in circles) for axis in (0, 1)] for f, side in ((min, -1), (max, 1))
    )
    size = max(high[0] - low[0], high[1] - low[1])
    return Boundary(outside=[Circle(*one) for one in circles], size=size)


def _cell(name: str, figure: CellFigure, inset: float) -> Boundary:
    (w, h), periodic = (side / 2 for side in figure.sides), figure.along
    found = Boundary(size=2 * max(w, h), cell=(2 * w, 2 * h if periodic[1] else INF))
    along = [(2 * w, 0.0)]
    if periodic[1]:
        along += [(0.0, 2 * h), (2 * w, 2 * h), (2 * w, -2 * h)]
    else:
        c = inset - h
        require_room(name, -c, "between the walls", inset)
        # their length is one period; there are no corners at the windows
        found.faces = [face(0, 1, c, -w, w, low=-INF, high=INF), face(0, -1, c, -w, w, low=-INF, high=INF)]
    found.windows = [face(1, 0, -w), face(-1, 0, -w)] + ([face(0, 1, -h), face(0, -1, -h)] if periodic[1] else [])
    found.windows = [one._replace(separation=2 * (w if one.normal[0] else h)) for one in found.windows]
    for k, (x, y, radius) in enumerate(figure.circles):
        r = radius + inset
        if r >= math.hypot(w, h if periodic[1] else h - inset + abs(y)):
            ball = f", with a ball of radius {inset:g}," if inset else ""
            got, advice = f"one that{ball} covers the cell", "take a smaller one"
            raise CaromError(Fault(name, "obstacles", "room between them", got, advice))
        found.outside.append(Circle(x, y, r))
        for dx, dy in along + [(-dx, -dy) for dx, dy in along]:
            if abs(x + dx) < w + r and abs(y + dy) < h + r:
                found.images.append(Circle(x + dx, y + dy, r, image_of=k))
    return found


def _sphere(name: str, figure: SphereFigure, inset: float) -> Boundary:
    require_room(name, figure.radius - inset, "in the sphere", inset)
    return Boundary(sphere=figure.radius - inset, size=figure.radius)


def _cylinder(name: str, figure: CylinderFigure, inset: float) -> Boundary:
    return _with_lids(name, boundary_of(figure.over, inset), figure.height, inset)


def _box(name: str, figure: BoxFigure, inset: float) -> Boundary:
    x, y, z = figure.size
    return _with_lids(name, boundary_of(RectangleFigure(size=(x, y)), inset), z, inset)


def _with_lids(name: str, shape: Boundary, height: float | None, inset: float) -> Boundary:
    """Return the boundary of a cylinder over a section, with two lids where it has a height."""
    if height is None:
        return shape
    require_room(name, height / 2 - inset, "between the lids", inset)
    c = inset - height / 2
    order, sides = shape.order, len(shape.faces)
    if order is not None:  # (the lids come after the other faces, and last along the wall)
        order = [*(k + 2 * (k >= sides) for k in order), sides, sides + 1]
    return replace(shape, faces=[*shape.faces, face(0, 0, c, nz=1.0), face(0, 0, c, nz=-1.0)], order=order)


BY_KIND: dict[type[Figure], Callable[[str, Any, float], Boundary]] = {
    StripFigure: _strip, PlatesFigure: _plates, WedgeFigure: _wedge, CellFigure: _cell, DiscsFigure: _discs,
    SphereFigure: _sphere, CylinderFigure: _cylinder, BoxFigure: _box,
}  # fmt: skip
