"""Containers of gases: periodic boxes, boxes with walls, and whatever planes and round walls enclose.

A container has faces, each of a named wall: several faces may be one wall. A plane figure holds discs or, upright between flat
ends, balls; its faces have lengths in place of areas until they are given a height. :class:`GasContainer` declares one, and
:class:`Container` is what it declares.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Literal, NamedTuple, Union, cast

import numpy as np
from numpy.typing import NDArray
from pydantic import BeforeValidator, Field, model_validator

from carom.bodies import holds_arrays
from carom.core.geometry.curve import ROW
from carom.core.geometry.curve_arcs import arc_gap, arc_length, arc_tables, join_ends
from carom.errors import CaromError, Fault, FaultList, did_you_mean, shown
from carom.formatting import counted, format_number
from carom.gas.edmd.gas_records import CURVE, INSIDE, OUTSIDE, PLANE
from carom.scene.figures import FIGURES, ArcPiece, EllipsePiece, Figure, PlaneFigure, SegmentPiece
from carom.scene.figures.figure import Loop, figure_table, joints
from carom.scene.figures.polygons import outline_faults, polygon_depth
from carom.scene.figures.rounds import CylinderFigure, SectorFigure, SphereFigure
from carom.scene.schema import Components, Length, Model, Size, from_file, refused, with_faults_of_part

Array = NDArray[np.float64]
Floats = tuple[float, ...]
JOINT_OVERLAP = 1e-9  # of the size: by so much bounded faces that continue each other overlap
QUARTERS = ((1, 0), (0, 1), (-1, 0), (0, -1))
STRAIGHT = 1e-12  # sine of the angle between two sides that count as one line


@dataclass(frozen=True)
class ContainerFace:
    """A face of a wall: a plane, a round surface, or an arc of a curve, of which it may be a part.

    Parameters
    ----------
    name : of the wall
    form : PLANE, INSIDE, OUTSIDE or CURVE, of :mod:`carom.gas.edmd.gas_records`
    vector : a plane's normal n into the gas; the q of a round surface |q (x - centre)| = radius, which holds the gas INSIDE or (a
        scatterer) OUTSIDE
    centre : a point of a plane, or the centre
    area : length, of discs
    radius : of a round surface
    bounds_surfaces : whether it bounds the balls' surfaces, not their centres
    along, low, high : it exists only where low <= along . x <= high
    part : of an outline of which one face alone does not tell what is inside (:attr:`carom.gas.Container.outline`)
    thin : a side of a plate, which has gas on both
    table : rows of an arc of a CURVE (:mod:`carom.core.geometry.curve_arcs`)
    """

    name: str
    form: int
    vector: Floats
    centre: Floats
    area: float
    radius: float = 0.0
    bounds_surfaces: bool = True
    along: Floats = (0.0, 0.0, 0.0)
    low: float = -math.inf
    high: float = math.inf
    part: bool = False
    thin: bool = False
    table: Array = field(default_factory=lambda: np.empty((0, ROW)), repr=False, compare=False)

    @property
    def bounded(self) -> bool:
        """Whether it ends somewhere."""
        return any(self.along)

    @property
    def fixed_because(self) -> str:
        """Why it cannot oscillate, or an empty string."""
        if self.form != PLANE and self.radius == 0 and self.form != CURVE:
            return "which ends at a re-entrant corner"
        if self.form != PLANE:
            return "which is round"
        return (
            ("a plate" if self.thin else "which ends where the container continues behind it") if self.bounded else ""
        )

    def offset(self, radius: Any) -> tuple[Any, Any]:
        """Return the engine's d for balls of a radius, and the part of it that grows with the radius."""
        part = radius * (float(self.bounds_surfaces) * (-1.0 if self.form == INSIDE else 1.0))
        return self.radius + part, part

    def clearance(self, radius: Any, x: Array) -> Array:
        """Return the gap (N,) between the face and balls at x (N, 3): below 0 if they overlap, infinite where it does not exist."""
        d = self.offset(radius)[0]
        if self.form == CURVE:
            y = (x - self.centre)[:, :2].tolist()
            found = [
                arc_gap(self.table, 0, float(d), *one) for d, one in zip(np.broadcast_to(d, len(x)), y, strict=True)
            ]
            return np.array([gap if beyond <= 0 else math.inf for gap, beyond, _nx, _ny in found])
        r = np.asarray(self.vector) * (x - self.centre)
        if self.form == PLANE:
            gap = (np.abs(r.sum(axis=1)) if self.thin else r.sum(axis=1)) - d
        else:
            distance = np.sqrt((r * r).sum(axis=1))
            gap = (d - distance if self.form == INSIDE else distance - d) / max(self.vector)
        along = x @ np.asarray(self.along)
        return np.where((along >= self.low) & (along <= self.high), gap, math.inf)


class FigureFaces(NamedTuple):
    """The faces of a plane figure in the box [0, size]."""

    faces: list[ContainerFace]
    """Their areas are lengths, until they are given a height."""
    size: Floats
    corners: Array | None
    """Of a polygon that is not convex, or along a curve."""


@functools.lru_cache(16)  # (a scene is made again with another number, and its container stays as it is)
def faces_of(figure: PlaneFigure, bounds: str) -> FigureFaces:
    """Return the faces of a figure, which is moved to x, y >= 0 where a part of it lies beyond.

    Straight sides, with half circles, or parts of a circle around all of the figure, where it is convex; a whole ellipse. All other
    figures are arcs of smooth curves. CaromError, one line, for a figure that gases do not have.
    """
    loops = figure.outline()
    if len(loops) > 1:
        raise CaromError(Fault("container", "", "a figure without obstacles of its own", figure.kind()))
    (loop,), names = loops, figure.piece_names()
    first = loop[0]
    ellipses = [isinstance(piece, EllipsePiece) for piece in loop]
    simple = [isinstance(piece, SegmentPiece | ArcPiece) for piece in loop]
    if not all(simple) and (len(loop) > 1 or not all(ellipses)):
        return _curved(figure, loop, names, bounds)
    low, high = (np.array([_ends(piece)[k] for piece in loop]) for k in (0, 1))
    shift = np.maximum(-low.min(axis=0), 0.0)
    x, y = shift.tolist()
    size = tuple((high.max(axis=0) + shift).tolist())
    if len(loop) == 1 and isinstance(first, EllipsePiece) and first.half_axes[0] != first.half_axes[1]:
        (a, b), length = first.half_axes, first.length
        if bounds == "surface":  # (the curve at a ball's radius from an ellipse is none)
            return _curved(figure, loop, names, bounds)
        face = ContainerFace(names[0], INSIDE, (1 / a, 1 / b, 0.0), (a, b, 0.0), length, 1.0)
        return FigureFaces([face], (2 * a, 2 * b), None)
    if len(loop) == 1:
        r = first.half_axes[0] if isinstance(first, EllipsePiece) else getattr(first, "radius", 0.0)
        if r:
            face = ContainerFace(names[0], INSIDE, (1.0, 1.0, 0.0), (r, r, 0.0), 2 * math.pi * r, r)
            return FigureFaces([face], (2 * r, 2 * r), None)
    return _chain(figure, loop, names, (x, y), size, bounds)


SAMPLES = 1000  # places of a piece of a curved outline


def _curved(figure: PlaneFigure, loop: Loop, names: Sequence[str], bounds: str) -> FigureFaces:
    """Return the faces of a loop of which a piece is smooth: an arc of a curve each, and points at re-entrant corners."""
    tables: list[Array] = []
    owner: list[str] = []
    for piece, name in zip(loop, names, strict=True):
        try:
            found = arc_tables(piece.at, *piece.span(), getattr(piece, "cuts", None))
        except ValueError:
            expected = "a curve with a continuous tangent and curvature between its corners"
            raise CaromError(Fault("container", "", expected, f"{figure.kind()}, which has none somewhere")) from None
        tables += found
        owner += [name] * len(found)
    join_ends([*tables, tables[0]])
    ends, turn = (joints(loop)[k] for k in (0, 3))
    apart = float(np.abs(ends[:, 1] - np.roll(ends[:, 0], -1, axis=0)).max())
    places = [piece.at(np.linspace(*piece.span(), SAMPLES + 1))[0] for piece in loop]
    outline = np.concatenate([one[:-1] for one in places])
    if apart > JOINT_OVERLAP * float(np.abs(outline).max()):
        raise CaromError(
            Fault("container", "", "a closed curve", f"{figure.kind()}, whose ends are {apart:.6g} m apart")
        )
    if outline_faults(outline[:: len(loop)]):
        raise CaromError(Fault("container", "", "a curve that does not meet itself", figure.kind()))
    low, high = outline.min(axis=0), outline.max(axis=0)
    # (between two places the curve is as near to them as their distance; an ellipse's places have its axes among them)
    margin = 0.0 if len(loop) == 1 and isinstance(loop[0], EllipsePiece) else _longest_step(outline)
    shift = np.where(low < margin, margin - low, 0.0)
    x, y = shift.tolist()
    faces = [
        ContainerFace(name, CURVE, (1.0, 1.0, 0.0), (x, y, 0.0), arc_length(table), part=True, table=table)
        for name, table in zip(owner, tables, strict=True)
    ]
    for k in np.flatnonzero((turn < -STRAIGHT) & (bounds == "surface")).tolist():
        tip = (*(ends[k, 1] + shift).tolist(), 0.0)
        faces.append(ContainerFace(names[k], OUTSIDE, (1.0, 1.0, 0.0), tip, 0.0, part=True))
    return FigureFaces(faces, tuple((high + shift + margin).tolist()), outline + shift)


def _longest_step(outline: Array) -> float:
    return float(np.linalg.norm(np.diff(outline, axis=0), axis=1).max())


def _deviation(outline: Array) -> float:
    """Return the largest distance of a curve from the chords of places on it, some thirty times too large.

    A place is four times as far from the chord of its neighbours as the curve is from the chords to them. Where the curve has a
    corner, the chord's other end counts.
    """
    back, on = (np.roll(outline, k, axis=0) for k in (1, -1))
    (x, y), (dx, dy) = (outline - back).T, (on - back).T
    apart = np.abs(x * dy - y * dx) / np.hypot(dx, dy)
    return 8 * float(np.minimum(apart, np.roll(apart, -1)).max())


def _ends(piece: Any) -> tuple[list[float], list[float]]:
    """Return the lowest and the highest coordinates of a piece."""
    if isinstance(piece, EllipsePiece):
        (x, y), (p, q) = piece.center, piece.half_axes
        return [x - p, y - q], [x + p, y + q]
    x = piece.at(np.array(piece.span()))[0].tolist()
    if isinstance(piece, ArcPiece):  # (and where it is level or upright)
        first, last = sorted((piece.from_angle_deg, piece.to_angle_deg))
        (u, v), r = piece.center, piece.radius
        x += [(u + r * c, v + r * s) for k in range(-8, 9) if first <= 90 * k <= last for c, s in [QUARTERS[k % 4]]]
    return np.min(x, axis=0).tolist(), np.max(x, axis=0).tolist()


def _chain(
    figure: PlaneFigure, loop: Loop, names: Sequence[str], shift: tuple[float, float], size: Floats, bounds: str
) -> FigureFaces:
    """Return the faces of a loop of segments and arcs, and the points at re-entrant corners that balls touch."""
    ends, _tangents, _speed, turn, _cosine = joints(loop)
    places = ends + shift
    round_ = [isinstance(piece, ArcPiece) for piece in loop]
    convex = bool((turn > (-STRAIGHT if any(round_) else STRAIGHT)).all())
    if any(round_) and not (convex and all(_has_a_face(piece, places.reshape(-1, 2), shift) for piece in loop)):
        return _curved(figure, loop, names, bounds)
    longest = max(piece.length for piece in loop)
    planes, arcs, count = [], [], len(loop)
    back = bool(getattr(figure, "clockwise", False))  # (the walls keep the order of the points)
    for k in [(count - 2 - j) % count for j in range(count)] if back else range(count):
        piece, name = loop[k], names[k]
        if isinstance(piece, ArcPiece):
            arcs.append(_arc(name, piece, np.add(piece.center, shift), places.reshape(-1, 2)))
            continue
        planes += _side(name, k, places, piece.tangent(np.zeros(1))[0], piece.length, JOINT_OVERLAP * longest, convex)
        if turn[k - back] < -STRAIGHT and bounds == "surface":
            # a ball's surface touches the corner itself, which belongs to the side that ends there
            tip = (*places[k, 0 if back else 1].tolist(), 0.0)
            planes.append(ContainerFace(name, OUTSIDE, (1.0, 1.0, 0.0), tip, 0.0, part=True))
    # (in the order of the release before: a stadium's left end before its right one)
    corners = None if convex else places[:, 0]
    return FigureFaces([*planes, *reversed(arcs)], size, corners)


def _side(
    name: str, k: int, places: Array, t: Array, length: float, overlap: float, convex: bool
) -> list[ContainerFace]:
    """Return the face of a straight side; one behind which a part of the container lies ends where the side ends."""
    corner, n = places[k, 0], np.array([-t[1], t[0]])
    face = ContainerFace(name, PLANE, (*n.tolist(), 0.0), (*corner.tolist(), 0.0), length, part=not convex)
    others = np.delete(places[:, 0], [k, (k + 1) % len(places)], axis=0)
    if convex or ((others - corner) @ n > overlap).all():
        return [face]
    begin = float(corner @ t)
    return [replace(face, along=(*t.tolist(), 0.0), low=begin - overlap, high=begin + length + overlap)]


def _is_around(piece: ArcPiece, places: Array, centre: Array) -> bool:
    return bool((np.hypot(*(places - centre).T) <= piece.radius * (1 + JOINT_OVERLAP)).all())


def _has_a_face(piece: Any, places: Array, shift: tuple[float, float]) -> bool:
    """Return whether a piece is a straight side, a half circle, or a part of a circle around all places, seen from inside."""
    if not isinstance(piece, ArcPiece):
        return True
    is_half = abs(piece.to_angle_deg - piece.from_angle_deg) == 180
    return piece.way > 0 and (is_half or _is_around(piece, places, np.add(piece.center, shift)))


def _arc(name: str, piece: ArcPiece, centre: Array, places: Array) -> ContainerFace:
    """Return the face of an arc: of the whole circle where that is around all of the figure, else of a half."""
    r, at = piece.radius, (*centre.tolist(), 0.0)
    face = ContainerFace(name, INSIDE, (1.0, 1.0, 0.0), at, piece.length, r, True)
    if _is_around(piece, places, centre):
        return face
    middle = math.radians((piece.from_angle_deg + piece.to_angle_deg) / 2)
    u = np.round((math.cos(middle), math.sin(middle)), 15) + 0.0
    edge = float(u @ centre) - 2 * r * JOINT_OVERLAP
    if u[u != 0][0] < 0:
        return replace(face, along=(*(0.0 - u).tolist(), 0.0), high=-edge)
    return replace(face, along=(*u.tolist(), 0.0), low=edge)


# ----------------------------------------------------------------------------------------------------
# Containers of gases: periodic boxes, boxes with walls, and whatever planes and round walls enclose.
#
# A container has faces, each of a named wall: several faces may be one wall. A plane figure holds discs or, upright between flat
# ends, balls; its faces have lengths in place of areas until they are given a height.


# The walls of a box, the lower and the upper one along each axis.
WALLS = ("left", "right", "front", "back", "bottom", "top")
BOXES = ("periodic", "box")
FLAT = {"front": "bottom", "back": "top"}  # of discs, for which y points upwards


def wall_name(name: str, dimensions: int) -> str:
    """Return the name of a wall of a box: of discs, the lower and the upper one along y are bottom and top."""
    return FLAT.get(name, name) if dimensions == 2 else name


@holds_arrays
@dataclass(frozen=True)
class Container:
    """A container in the box [0, size], of two lengths (discs) or three; made by :func:`container`.

    Examples
    --------
    >>> from carom.gas import container
    >>> cylinder = container("cylinder", radius=2.0, height=10.0)
    >>> cylinder.names
    ('side', 'bottom', 'top')
    >>> round(cylinder.volume, 3)
    125.664
    """

    shape: str
    size: Floats
    periodic: tuple[bool, ...]
    faces: tuple[ContainerFace, ...]
    volume: float
    """Volume of the space that the walls bound; for discs the area."""
    outline: Array | None = None
    """The corners (N, 2) of a polygon that is not convex, or of one along a curve: a point behind a side may be inside."""
    declared: GasContainer | None = field(default=None, repr=False, compare=False)
    """The :class:`GasContainer` that it is made of."""

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the walls, each once."""
        return tuple(dict.fromkeys(face.name for face in self.faces))

    def clearance(self, radius: Any, x: Array) -> Array:
        """Return the gap (N,) between balls at x (N, 3), of one radius or of radii (N,), and the nearest wall."""
        least = np.full(len(x), math.inf)
        if self.outline is not None:
            bounds_surfaces = next(face.bounds_surfaces for face in self.faces if face.part)
            depth = polygon_depth(self.outline, x)
            least = depth - radius * bounds_surfaces
            if any(face.form == CURVE for face in self.faces):
                least = self._clearance_of_curves(depth, least, np.broadcast_to(radius, len(x)), x)
        for face in self.faces:
            if not face.part:
                least = np.minimum(least, face.clearance(radius, x))
        return least

    @property
    def widest_radius(self) -> float:
        """Below this a ball fits into an ellipse that bounds its surface: the smaller half axis, m; infinity for others."""
        return min(self.size[:2]) / 2 if self.shape == "ellipse" and self.faces[0].form == CURVE else math.inf

    @property
    def curves(self) -> Array:
        """The tables of all arcs of smooth curves, one after the other."""
        return np.concatenate([np.empty((0, ROW)), *(face.table for face in self.faces)])

    def _clearance_of_curves(self, depth: Array, gap: Array, radius: Array, x: Array) -> Array:
        """Return the gaps where a polygon that is almost the curve does not tell them to rounding: near it, by the arcs."""
        outline = cast(Array, self.outline)
        error = _deviation(outline)
        near = (np.abs(depth) < error) | (np.abs(gap) < error)
        faces = [face for face in self.faces if face.part]
        found = gap.copy()
        found[near] = np.min([face.clearance(radius[near], x[near]) for face in faces], axis=0)
        return found


# --- boxes and obstacles -------------------------------------------------------------------------------------------


def _plane(name: str, axis: int, up: bool, size: Floats, area: float) -> ContainerFace:
    """Return a wall of the box across an axis, the upper or the lower one."""
    n, m = [0.0] * 3, [0.0] * 3
    n[axis] = -1.0 if up else 1.0
    m[axis] = size[axis] if up else 0.0
    return ContainerFace(name, PLANE, tuple(n), tuple(m), area)


def _planes(size: Floats, periodic: Sequence[bool], area: float | None = None) -> list[ContainerFace]:
    """Return the walls of a box where it is not periodic; with an area, only those across the last axis."""
    return [
        _plane(WALLS[2 * axis + up], axis, bool(up), size, math.prod(size) / size[axis] if area is None else area)
        for axis in range(len(size))
        if not periodic[axis] and (area is None or axis == 2)
        for up in (0, 1)
    ]


def _obstacles(
    faults: FaultList, given: Sequence[Floats], size: Floats, periodic: Sequence[bool]
) -> tuple[list[ContainerFace], float]:
    """Return round obstacles, with the images that reach into the box, and the volume that they take."""
    faces, taken = [], 0.0
    for k, row in enumerate(given):
        axes, r = len(row) - 1, row[-1]
        if axes not in {2, len(size)} or r <= 0:
            faults.add(f"obstacles[{k}]", "x, y, radius; or x, y, z, radius", f"{row!r}")
            continue
        q, centre = [0.0] * 3, [0.0] * 3
        q[:axes], centre[:axes] = [1.0] * axes, row[:-1]
        height = size[2] if axes < len(size) else 1.0
        taken += math.pi * r * r * height if axes == 2 else 4 / 3 * math.pi * r**3
        area = 2 * math.pi * r * height if axes == 2 else 4 * math.pi * r * r
        shifts = [(-1, 0, 1) if a < axes and periodic[a] else (0,) for a in range(3)]
        for step in np.stack(np.meshgrid(*shifts, indexing="ij"), axis=-1).reshape(-1, 3):
            at = [
                c + s * (size[a] if a < len(size) else 0.0) for a, (c, s) in enumerate(zip(centre, step, strict=True))
            ]
            # (a ball that touches it has its centre further away; a margin of another radius is enough)
            if all(-2 * r - size[a] / 2 < at[a] < size[a] * 1.5 + 2 * r for a in range(axes)):
                faces.append(ContainerFace("scatterer", OUTSIDE, tuple(q), tuple(at), 0.0 if step.any() else area, r))
    return faces, taken


def _plates(faults: FaultList, given: Sequence[Floats], size: Floats, bounds: str) -> list[ContainerFace]:
    """Return both sides and both edges of thin straight walls."""
    faces: list[ContainerFace] = []
    for k, row in enumerate(given):
        if row[:2] == row[2:]:
            faults.add(f"plates[{k}]", "x1, y1, x2, y2 of two places", f"{row!r}")
            continue
        if bounds != "surface":
            faults.add(
                f"plates[{k}]", "none where walls bound the centres", f"{row!r}", "plates need bounds = 'surface'"
            )
            continue
        (x, y), end, name = row[:2], row[2:], f"plate{k + 1}"
        length = math.dist((x, y), end)
        u, v = (end[0] - x) / length, (end[1] - y) / length
        low = u * x + v * y
        area = length * (size[2] if len(size) == 3 else 1.0)
        for n in ((-v, u, 0.0), (v, -u, 0.0)):
            side = ContainerFace(
                name, PLANE, n, (x, y, 0.0), area, along=(u, v, 0.0), low=low, high=low + length, thin=True
            )
            faces.append(side)
        faces += [ContainerFace(name, OUTSIDE, (1.0, 1.0, 0.0), (*tip, 0.0), 0.0) for tip in ((x, y), end)]
    return faces


def container_figures() -> list[str]:
    """Return the names of the figures in which a gas can be."""
    return [name for name, kind in FIGURES.items() if issubclass(kind, PlaneFigure | SphereFigure | CylinderFigure)]


# --- as they are declared ------------------------------------------------------------------------------------------


_OBSTACLE = Components("x, y, radius; or x, y, z, radius", (3, 4))
_PLATE = Components("x1, y1, x2, y2 of two places", (4,))
_SIZE = Components("2 or 3 lengths > 0: along x, y (discs), and z (balls)", (2, 3))


def _axes(value: Any) -> Any:
    if not isinstance(value, list | tuple):
        raise refused("a list of the axes without walls, such as ['x']", shown(value))
    return value


class GasContainer(Model):
    """The container, with the parameters of :func:`carom.gas.container`: a class for each shape, chosen by ``shape``.

    Parameters
    ----------
    shape : one of carom.gas.SHAPES: "box" or "periodic", or a figure
    size : of a box, along x, y and z; two lengths: discs in a plane
    straight, radius, half_axes, points, ... : sizes of the figure
    height : of a plane figure that stands upright along z, with balls
    periodic : axes without walls, such as ["x", "y"]; default: none, or all for "periodic"
    obstacles : round obstacles, rows of x, y, radius or x, y, z, radius
    plates : thin straight walls with gas on both sides, rows of x1, y1, x2, y2
    bounds : "surface" or "centre" of the balls: which of them the walls bound
    """

    tag: ClassVar[str] = "shape"
    periodic: Annotated[tuple[Literal["x", "y", "z"], ...], BeforeValidator(_axes)] = ()
    obstacles: tuple[Annotated[tuple[Length, ...], BeforeValidator(_OBSTACLE)], ...] = ()
    plates: tuple[Annotated[tuple[Length, ...], BeforeValidator(_PLATE)], ...] = ()
    bounds: Literal["surface", "centre"] = "surface"

    def __new__(cls, *_unnamed: Any, **fields: Any) -> Any:
        """Return a container of the class of its shape."""
        kind = CONTAINERS.get(str(fields.get("shape"))) if cls is GasContainer else cls
        return super().__new__(kind or cls)

    @model_validator(mode="after")
    def _check(self) -> GasContainer:
        with_faults_of_part(lambda: self.geometry)
        return self

    @functools.cached_property
    def geometry(self) -> Container:
        """The container of :class:`carom.gas.Gas`: its walls, with round obstacles and plates."""
        faults, made = FaultList("container"), self._room()
        walls, taken = _obstacles(faults, self.obstacles, made.size, made.periodic)
        walls += _plates(faults, self.plates, made.size, self.bounds)
        faults.raise_if_any()
        every = tuple(
            replace(face, name=wall_name(face.name, len(made.size)), bounds_surfaces=self.bounds == "surface")
            for face in (*made.faces, *walls)
        )
        return replace(made, faces=every, volume=made.volume - taken, declared=self)

    def _room(self) -> Container:
        """Return the walls without obstacles and plates."""
        raise refused(f"one of {', '.join(CONTAINERS)}", "nothing", field="shape")

    def _open(self, count: int) -> tuple[bool, ...]:
        return tuple(axis in self.periodic for axis in "xyz"[:count])

    @property
    def dimensions(self) -> int:
        """3, or 2: discs."""
        return len(self.geometry.size)

    def describe(self) -> str:
        """Return one phrase."""
        made = self.geometry
        sides = " x ".join(format_number(x, 6) for x in made.size)
        what = {"periodic": "periodic"}.get(made.shape, f"{'an' if made.shape == 'ellipse' else 'a'} {made.shape}")
        if isinstance(self, SectorFigure):
            what += f" of {format_number(self.opening, 4)}°,"
        along = f", periodic along {' and '.join(self.periodic)}" if self.periodic else ""
        count = len(self.obstacles)
        around = f" with {count} obstacle{'s' if count > 1 else ''}" if count else ""
        plates = f" and {counted(len(self.plates), 'plate')}" if self.plates else ""
        return f"{what} {sides}{along}{around}{plates}"


class BoxContainer(GasContainer):
    """A box, with walls where it is not periodic."""

    shape: Literal["box"] = "box"
    size: Annotated[tuple[Size, ...], BeforeValidator(_SIZE)]

    def _room(self) -> Container:
        around = self._open(len(self.size))
        return Container("box", self.size, around, tuple(_planes(self.size, around)), math.prod(self.size))


class PeriodicContainer(GasContainer):
    """A box without walls."""

    shape: Literal["periodic"] = "periodic"
    size: Annotated[tuple[Size, ...], BeforeValidator(_SIZE)]

    def _room(self) -> Container:
        return Container("periodic", self.size, (True,) * len(self.size), (), math.prod(self.size))


class FigureContainer(GasContainer):
    """A container in a figure, whose class is the other base."""

    def _room(self) -> Container:
        """Return the walls of a sphere, a cylinder, or a plane figure, upright where it has a height."""
        own: Any = self
        faults, shape = FaultList("container"), own.kind()
        height: float | None = getattr(self, "height", None)
        corners, size = None, cast(Floats, ())
        if isinstance(own, CylinderFigure):
            own = own.over
            if height is None:
                faults.add("height", "a length > 0 for a cylinder", "none")
                faults.raise_if_any()
        if isinstance(own, SphereFigure):
            r = own.radius
            walls = [ContainerFace("side", INSIDE, (1.0, 1.0, 1.0), (r, r, r), 4 * math.pi * r * r, r)]
            volume, size = 4 / 3 * math.pi * r**3, (2 * r, 2 * r, 2 * r)
        else:
            walls, size, corners = faces_of(own, self.bounds)
            volume = own.area
        if height is not None:
            size = (*size, height)
        around = self._open(len(size))
        if any(around[:2]) or (isinstance(own, SphereFigure) and any(around)):
            faults.add("periodic", "false, except along z for an upright shape", f"{self.periodic!r}")
            faults.raise_if_any()
        if height is not None:
            walls = [replace(face, area=face.area * height) for face in walls] + _planes(size, around, volume)
            volume *= height
        return Container(shape, size, around, tuple(walls), volume, corners)


class UprightContainer(FigureContainer):
    """A plane figure, for discs; with a height, for balls."""

    height: Size | None = None


def _container_of(kind: type[Figure]) -> type[GasContainer]:
    """Return the class of containers in a figure: it has the fields of the figure and of a container."""
    base = UprightContainer if issubclass(kind, PlaneFigure) else FigureContainer
    name = f"{kind.__name__.removesuffix('Figure')}Container"
    metaclass: Any = type(base)
    made = metaclass(name, (base, kind), {"__module__": __name__, "__doc__": kind.__doc__})
    globals()[name] = made  # (where a pickle looks for it)
    return made  # type: ignore[no-any-return]


CONTAINERS: dict[str, type[GasContainer]] = {"periodic": PeriodicContainer, "box": BoxContainer}
CONTAINERS |= {name: _container_of(FIGURES[name]) for name in container_figures()}
SHAPES = tuple(CONTAINERS)


def _declared(value: Any) -> Any:
    """Return a container that is made already as it was declared, and lengths as a periodic box."""
    if isinstance(value, Container):
        return value.declared
    return {"shape": "periodic", "size": value} if isinstance(value, list | tuple | np.ndarray) else value


if TYPE_CHECKING:
    AnyContainer = GasContainer
else:
    # (made at run time)
    AnyContainer = Annotated[
        Annotated[Union[tuple(CONTAINERS.values())], Field(discriminator="shape")],  # noqa: UP007
        BeforeValidator(_declared),
    ]


def container(
    shape: str | Mapping[str, Any] | Figure,
    size: Sequence[float] | None = None,
    *,
    periodic: bool | Sequence[bool] | None = None,
    height: float | None = None,
    obstacles: Sequence[Sequence[float]] = (),
    plates: Sequence[Sequence[float]] = (),
    bounds: str = "surface",
    **sizes: Any,
) -> Container:
    """Return a container for a gas, in the box [0, size].

    Parameters
    ----------
    shape : str, dict or Figure
        "box" or "periodic", with a ``size``; or any figure, as :func:`carom.scene.figures.figure` takes it: a name with its sizes,
        a text such as "stadium:straight=20,radius=5", or a Figure. A plane figure holds discs or, with a ``height``, balls: it
        stands upright along z, between flat ends. It is moved to x, y >= 0.
    size : two lengths (discs) or three (balls), of a box
    periodic : bool, or one for each axis
        A "box" may be periodic along some axes, an upright figure along z. Default: not periodic.
    height : float, optional
        Of an upright figure.
    obstacles : rows of x, y, radius, or x, y, z, radius
        Round obstacles: with "periodic", a Lorentz gas or Sinai billiard.
    plates : rows of x1, y1, x2, y2
        Thin straight walls between two places (upright in space) with gas on both sides: hoppers, slits, baffles. They lie within
        the box, also where it is periodic.
    bounds : "surface" or "centre"
        Whether the walls bound the balls' surfaces, or their centres.
    **sizes : of the figure, by their names

    Returns
    -------
    Container
        Its walls are called left, right, bottom and top for discs in a box, a rectangle or a stadium; left, right, front, back,
        bottom, top in a box of three lengths; side where round; bottom and top at flat ends; front, back, left, right in an upright
        stadium or rectangle; left, right, and side for the arc, in a sector; edge1, edge2, ... in a polygon, of which edge1 goes
        from the first corner to the second, and a re-entrant corner belongs to the side that ends there; scatterer (an obstacle);
        and plate1, plate2, ...

    Raises CaromError, one line per problem.

    Examples
    --------
    >>> from carom.gas import container
    >>> strip = container("box", (30.0, 10.0), periodic=(True, False))
    >>> strip.names, strip.volume
    (('bottom', 'top'), 300.0)
    >>> container("stadium", straight=20.0, radius=5.0).size
    (30.0, 10.0)
    >>> lorentz = container("periodic", (1.0, 1.0), obstacles=[(0.5, 0.5, 0.25)])
    >>> round(lorentz.volume, 6)
    0.80365
    """
    given = {"size": size, "height": height, "obstacles": tuple(obstacles), "plates": tuple(plates), "bounds": bounds}
    # (sizes that are left out are about 1 m for a billiard; a gas is asked for all)
    named = isinstance(shape, str) and ":" not in shape
    table = {"shape": shape, **sizes} if named else figure_table(cast(Any, shape), sizes)
    table |= {name: value for name, value in given.items() if value is not None}
    if (name := table.get("shape")) not in CONTAINERS:
        advice = did_you_mean(str(name), SHAPES)
        raise CaromError(Fault("container", "shape", f"one of {', '.join(SHAPES)}", repr(name), advice))
    if periodic is not None:
        around = [bool(one) for one in np.ravel(periodic)] * (1 if np.ndim(periodic) else 3)
        table["periodic"] = [axis for axis, yes in zip("xyz", around, strict=False) if yes]
        if name == "periodic" and not np.all(periodic):
            raise CaromError(
                Fault("container", "periodic", "true for shape 'periodic', or shape 'box'", repr(periodic))
            )
    made = from_file("container", CONTAINERS[name], table).geometry
    if periodic is not None and np.ndim(periodic) and np.shape(periodic) != (len(made.size),):
        raise CaromError(Fault("container", "periodic", f"one of true and false, or {len(made.size)}", repr(periodic)))
    return made


def as_container(side: Sequence[float] | Container, periodic: bool | Sequence[bool]) -> Container:
    """Return a container as it is, or the box with these lengths."""
    return side if isinstance(side, Container) else container("box", side, periodic=periodic)
