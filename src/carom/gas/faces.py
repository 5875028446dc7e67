"""Faces of containers, and those of a plane figure: planes and round surfaces, of which it may have parts."""

from __future__ import annotations

import functools
import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.core.geometry.arc_tables import arc_length, arc_tables, join_ends
from carom.core.geometry.curve import ROW
from carom.core.geometry.curve_arcs import arc_gap
from carom.core.geometry.polygon import ellipse_depth, outline_faults
from carom.errors import CaromError, Fault
from carom.gas.edmd.gas_records import CURVE, ELLIPSE, INSIDE, OUTSIDE, PLANE
from carom.scene.figures import ArcPiece, EllipsePiece, PlaneFigure, SegmentPiece
from carom.scene.figures.figure import Loop

__all__ = ["JOINT_OVERLAP", "ContainerFace", "FigureFaces", "Floats", "faces_of"]

Array = NDArray[np.float64]
Floats = tuple[float, ...]
JOINT_OVERLAP = 1e-9  # of the size: by so much bounded faces that continue each other overlap
QUARTERS = ((1, 0), (0, 1), (-1, 0), (0, -1))
STRAIGHT = 1e-12  # sine of the angle between two sides that count as one line


@dataclass(frozen=True)
class ContainerFace:
    """A face of a wall: a plane, a round surface, or an ellipse, of which it may be a part.

    Parameters
    ----------
    name : of the wall
    form : PLANE, INSIDE, OUTSIDE, ELLIPSE or CURVE, of :mod:`carom.gas.edmd.gas_records`
    vector : a plane's normal n into the gas; the q of a round surface |q (x - centre)| = radius, which holds the gas INSIDE or (a
        scatterer) OUTSIDE; the half axes of an ELLIPSE
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
        if self.form != PLANE and self.radius == 0 and self.form not in {ELLIPSE, CURVE}:
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
        if self.form == ELLIPSE:
            gap: Array = ellipse_depth(self.vector[0], self.vector[1], x - self.centre) - d
            return gap
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
        # (the curve at a ball's radius from an ellipse is none)
        form, vector, radius = (INSIDE, (1 / a, 1 / b, 0.0), 1.0) if bounds == "centre" else (ELLIPSE, (a, b, 0.0), 0.0)
        return FigureFaces([ContainerFace(names[0], form, vector, (a, b, 0.0), length, radius)], (2 * a, 2 * b), None)
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
    ends = np.array([piece.at(np.array(piece.span()))[0] for piece in loop])
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
    # (between two places the curve is as near to them as their distance)
    margin = float(np.linalg.norm(np.diff(outline, axis=0), axis=1).max())
    shift = np.where(low < margin, margin - low, 0.0)
    x, y = shift.tolist()
    faces = [
        ContainerFace(name, CURVE, (1.0, 1.0, 0.0), (x, y, 0.0), arc_length(table), part=True, table=table)
        for name, table in zip(owner, tables, strict=True)
    ]
    for k, (one, two) in enumerate(zip(loop, [*loop[1:], loop[0]], strict=True)):
        (u,), (v,) = one.tangent(np.array([one.length])), two.tangent(np.zeros(1))
        if u[0] * v[1] - u[1] * v[0] < -STRAIGHT and bounds == "surface":
            tip = (*(ends[k, 1] + shift).tolist(), 0.0)
            faces.append(ContainerFace(names[k], OUTSIDE, (1.0, 1.0, 0.0), tip, 0.0, part=True))
    return FigureFaces(faces, tuple((high + shift + margin).tolist()), outline + shift)


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
    tangents = np.array([piece.tangent(np.array([0.0, piece.length])) for piece in loop])
    after = np.roll(tangents[:, 0], -1, axis=0)
    turn = tangents[:, 1, 0] * after[:, 1] - tangents[:, 1, 1] * after[:, 0]  # at the end of each piece
    places = np.array([piece.at(np.array(piece.span()))[0] for piece in loop]) + shift
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
        planes += _side(name, k, places, tangents[k, 0], piece.length, JOINT_OVERLAP * longest, convex)
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
