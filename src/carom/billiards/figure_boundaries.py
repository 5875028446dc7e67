"""The boundary of the region open to a ball's centre in a figure: its pieces, one ball's radius inside."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable
from dataclasses import replace
from itertools import combinations
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.billiards.boundary import Boundary, Circle, Face, WholeEllipse, face
from carom.billiards.curved_wall import CurvedWall, ball_too_large, curved_region, ellipse_touched, require_room
from carom.errors import CaromError, Fault
from carom.scene.figures import CellFigure, Figure, PlaneFigure
from carom.scene.figures.cells import DiscsFigure
from carom.scene.figures.curve import PlatesFigure, StripFigure, WedgeFigure
from carom.scene.figures.figure import ArcPiece, EllipsePiece, Loop, SegmentPiece, joints
from carom.scene.figures.polygons import RectangleFigure
from carom.scene.figures.solids import BoxFigure, CylinderFigure, SphereFigure

Array = NDArray[np.float64]
INF = math.inf
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
