"""Containers of gases: periodic boxes, boxes with walls, and whatever planes and round walls enclose.

A container has faces, each of a named wall: several faces may be one wall. A plane figure holds discs or, upright between flat
ends, balls; its faces have lengths in place of areas until they are given a height.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.core.geometry.polygon import ellipse_depth, outline_faults, polygon_depth
from carom.errors import FaultList, suggestion
from carom.gas.edmd.gas_records import ELLIPSE, INSIDE, OUTSIDE, PLANE

__all__ = ["JOINT_OVERLAP", "SHAPES", "WALLS", "Container", "ContainerFace", "Floats", "as_container", "container"]

Array = NDArray[np.float64]
Floats = tuple[float, ...]

# The walls of a box, the lower and the upper one along each axis.
WALLS = ("left", "right", "front", "back", "bottom", "top")
SHAPES = ("periodic", "box", "circle", "sphere", "cylinder", "ellipse", "stadium", "wedge", "polygon")
JOINT_OVERLAP = 1e-9  # of the size: by so much bounded faces that continue each other overlap
STRAIGHT = 1e-12  # sine of the angle between two sides of a polygon that count as one line


@dataclass(frozen=True)
class ContainerFace:
    """A face of a wall: a plane, a round surface, or an ellipse, of which it may be a part.

    Parameters
    ----------
    name : of the wall
    form : PLANE, INSIDE, OUTSIDE or ELLIPSE, of :mod:`carom.gas.edmd.gas_records`
    vector : a plane's normal n into the gas; the q of a round surface |q (x - centre)| = radius, which holds the gas INSIDE or (a
        scatterer) OUTSIDE; the half axes of an ELLIPSE
    centre : a point of a plane, or the centre
    area : length, of discs
    radius : of a round surface
    bounds_surfaces : whether it bounds the balls' surfaces, not their centres
    along, low, high : it exists only where low <= along . x <= high
    part : of an outline of which one face alone does not tell what is inside (:attr:`carom.gas.Container.outline`)
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

    @property
    def bounded(self) -> bool:
        """Whether it ends somewhere."""
        return any(self.along)

    @property
    def fixed_because(self) -> str:
        """Why it cannot oscillate, or an empty string."""
        if self.form != PLANE and self.radius == 0 and self.form != ELLIPSE:
            return "which ends at a re-entrant corner"
        if self.form != PLANE:
            return "which is round"
        return "which ends where the container continues behind it" if self.bounded else ""

    def offset(self, radius: Any) -> tuple[Any, Any]:
        """Return the engine's d for balls of a radius, and the part of it that grows with the radius."""
        part = radius * (float(self.bounds_surfaces) * (-1.0 if self.form == INSIDE else 1.0))
        return self.radius + part, part

    def clearance(self, radius: Any, x: Array) -> Array:
        """Return the gap (N,) between the face and balls at x (N, 3): below 0 if they overlap, infinite where it does not exist."""
        d = self.offset(radius)[0]
        if self.form == ELLIPSE:
            gap: Array = ellipse_depth(self.vector[0], self.vector[1], x - self.centre) - d
            return gap
        r = np.asarray(self.vector) * (x - self.centre)
        if self.form == PLANE:
            gap = r.sum(axis=1) - d
        else:
            distance = np.sqrt((r * r).sum(axis=1))
            gap = (d - distance if self.form == INSIDE else distance - d) / max(self.vector)
        along = x @ np.asarray(self.along)
        return np.where((along >= self.low) & (along <= self.high), gap, math.inf)


@dataclass(frozen=True)
class Container:
    """A container in the box [0, size], of two lengths (discs) or three; made by :func:`container`.

    Examples
    --------
    >>> from carom.gas import container
    >>> cylinder = container("cylinder", (4.0, 4.0, 10.0))
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
    """The corners (N, 2) of a polygon that is not convex: a point behind one of its sides may be inside."""

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the walls, each once."""
        return tuple(dict.fromkeys(face.name for face in self.faces))

    def clearance(self, radius: Any, x: Array) -> Array:
        """Return the gap (N,) between balls at x (N, 3), of one radius or of radii (N,), and the nearest wall."""
        least = np.full(len(x), math.inf)
        if self.outline is not None:
            bounds_surfaces = next(face.bounds_surfaces for face in self.faces if face.part)
            least = polygon_depth(self.outline, x) - radius * bounds_surfaces
        for face in self.faces:
            if not face.part:
                least = np.minimum(least, face.clearance(radius, x))
        return least


# --- plane figures -------------------------------------------------------------------------------------------------


# Faces, area, and the outline of a polygon that is not convex.
PlaneFigure = tuple[list[ContainerFace], float, Array | None]


def _plane_figure(faults: FaultList, shape: str, size: Floats, points: Any, bounds: str) -> PlaneFigure:
    """Return the figure of a shape with a size, or of a polygon with these corners."""
    (width, depth), (x, y) = size[:2], (size[0] / 2, size[1] / 2)
    if shape in {"circle", "cylinder"}:
        if width != depth:
            faults.add("size", "the same width and depth for a circle", f"{size}; shape = 'ellipse' has two")
        r = width / 2
        return [_arc("side", (x, y), 2 * math.pi * r, r)], math.pi * r * r, None
    if shape == "ellipse":
        a, b = width / 2, depth / 2
        length = _ellipse_length(a, b)
        if bounds == "centre" or a == b:
            vector, form, radius = (1 / a, 1 / b, 0.0), INSIDE, 1.0
            if a == b:
                vector, radius = (1.0, 1.0, 0.0), a
        else:  # (the curve at a ball's radius from an ellipse is none)
            vector, form, radius = (a, b, 0.0), ELLIPSE, 0.0
        return [ContainerFace("side", form, vector, (x, y, 0.0), length, radius)], math.pi * a * b, None
    if shape == "stadium":
        return _stadium(faults, size)
    return _wedge(faults, size) if shape == "wedge" else _polygon(faults, points, bounds)


def _arc(name: str, centre: Floats, length: float, r: float, along: float = 0.0, *span: float) -> ContainerFace:
    """Return a face round a centre; with ``along`` = 1, only where x is within a span."""
    low, high = span or (-math.inf, math.inf)
    return ContainerFace(name, INSIDE, (1.0, 1.0, 0.0), (*centre, 0.0), length, r, True, (along, 0.0, 0.0), low, high)


def _ellipse_length(a: float, b: float) -> float:
    """Return the circumference of an ellipse, by the midpoint rule, which converges fast: the integrand is periodic."""
    t = (np.arange(256) + 0.5) * (2 * math.pi / 256)
    return float(np.hypot(a * np.sin(t), b * np.cos(t)).mean() * 2 * math.pi)


def _stadium(faults: FaultList, size: Floats) -> PlaneFigure:
    """Return a stadium with its straight sides along x."""
    width, depth = size[:2]
    if width < depth:
        faults.add("size", "a stadium with its long side along x: a width of at least the depth", f"{size}")
    r, straight = depth / 2, width - depth
    overlap, end = JOINT_OVERLAP * depth, math.pi * r
    faces = [
        ContainerFace("front", PLANE, (0.0, 1.0, 0.0), (0.0, 0.0, 0.0), straight),
        ContainerFace("back", PLANE, (0.0, -1.0, 0.0), (0.0, depth, 0.0), straight),
        _arc("left", (r, r), end, r, 1.0, -math.inf, r + overlap),
        _arc("right", (width - r, r), end, r, 1.0, width - r - overlap, math.inf),
    ]
    return faces, straight * depth + math.pi * r * r, None


def _wedge(faults: FaultList, size: Floats) -> PlaneFigure:
    """Return a sector with its tip in the middle of y = 0, which opens along y up to an arc about the tip, of radius ``depth``."""
    width, depth = size[:2]
    half = width / 2 / depth
    if half >= 1:
        found = f"{size}; it is 2 R sin(angle/2) and R, for an angle below 180 degrees"
        faults.add("size", "a wedge less than twice as wide as deep", found)
        return [], 1.0, None
    cos = math.sqrt((1 - half) * (1 + half))
    tip, angle = (width / 2, 0.0), 2 * math.asin(half)
    faces = [
        ContainerFace("left", PLANE, (cos, half, 0.0), (*tip, 0.0), depth),
        ContainerFace("right", PLANE, (-cos, half, 0.0), (*tip, 0.0), depth),
        _arc("side", tip, angle * depth, depth),
    ]
    return faces, angle * depth * depth / 2, None


def _polygon(faults: FaultList, points: Any, bounds: str) -> PlaneFigure:
    """Return the sides, and the points at re-entrant corners that balls touch; side k goes from corner k to the next."""
    corners = np.array(points, dtype=float)
    for expected, got in outline_faults(corners):
        faults.add("points", expected, got)
    faults.raise_if_any()
    edges = np.roll(corners, -1, axis=0) - corners
    length = np.hypot(edges[:, 0], edges[:, 1])
    area = float((corners[:, 0] * np.roll(corners[:, 1], -1) - corners[:, 1] * np.roll(corners[:, 0], -1)).sum() / 2)
    sign = 1.0 if area > 0 else -1.0
    along = edges / length[:, None]
    inward = sign * np.stack([-along[:, 1], along[:, 0]], axis=1)
    after = np.roll(along, -1, axis=0)
    turn = sign * (along[:, 0] * after[:, 1] - along[:, 1] * after[:, 0])  # at the end of each side
    convex = bool((turn > STRAIGHT).all())
    overlap = JOINT_OVERLAP * float(length.max())
    faces = []
    for k, (corner, n, t, s) in enumerate(zip(corners, inward, along, length.tolist(), strict=True)):
        name, at = f"edge{k + 1}", (*corner.tolist(), 0.0)
        face = ContainerFace(name, PLANE, (*n.tolist(), 0.0), at, s, part=not convex)
        begin = float(corner @ t)
        others = np.delete(corners, [k, (k + 1) % len(corners)], axis=0)
        if convex or ((others - corner) @ n > overlap).all():
            faces.append(face)  # (nothing of the container lies behind it)
        else:
            faces.append(
                ContainerFace(
                    name, PLANE, face.vector, at, s, along=(*t.tolist(), 0.0), low=begin - overlap, high=begin + s + overlap,
                    part=True
                )
            )  # fmt: skip
        if turn[k] < -STRAIGHT and bounds == "surface":
            # a ball's surface touches the corner itself, which belongs to the side that ends there
            tip = (*corners[(k + 1) % len(corners)].tolist(), 0.0)
            faces.append(ContainerFace(name, OUTSIDE, (1.0, 1.0, 0.0), tip, 0.0, 0.0, part=True))
    return faces, abs(area), None if convex else corners


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


def _scatterers(
    faults: FaultList, given: Any, size: Floats, periodic: Sequence[bool]
) -> tuple[list[ContainerFace], float]:
    """Return round obstacles, with the images that reach into the box, and the volume that they take."""
    faces, taken = [], 0.0
    for k, row in enumerate(given):
        numbers = [float(v) for v in row]
        axes = len(numbers) - 1
        if axes not in {2, len(size)} or not numbers[-1] > 0 or not np.isfinite(numbers).all():
            faults.add(f"scatterers[{k}]", "x, y, radius; or x, y, z, radius", f"{row!r}")
            continue
        r = numbers[-1]
        q, centre = [0.0] * 3, [0.0] * 3
        q[:axes], centre[:axes] = [1.0] * axes, numbers[:-1]
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


def container(
    shape: str,
    size: Sequence[float] | None = None,
    *,
    periodic: bool | Sequence[bool] | None = None,
    points: Any = None,
    scatterers: Sequence[Sequence[float]] = (),
    bounds: str = "surface",
) -> Container:
    """Return a container for a gas, in the box [0, size].

    Parameters
    ----------
    shape : str
        One of :data:`SHAPES`. ``size`` has two lengths for discs or three for balls, and is the size of the box around the shape: a
        circle has (d, d), a sphere (d, d, d). With three lengths, circle (or cylinder), ellipse, stadium, wedge and polygon
        stand upright along z, between flat ends. A wedge is a sector with its tip in the middle of y = 0, which opens along y up
        to an arc about the tip: with an angle A and a radius R it has the size (2 R sin(A/2), R).
    size : lengths, two or three
    periodic : bool, or one for each axis
        A "box" may be periodic along some axes, an upright shape along z. Default: not periodic.
    points : (N, 2) array
        The corners of a "polygon", in order. It needs no size in the plane: (height,) is enough, or nothing. It need not be
        convex: balls collide with its re-entrant corners.
    scatterers : rows of x, y, radius, or x, y, z, radius
        Round obstacles: with "periodic", a Lorentz gas or Sinai billiard.
    bounds : "surface" or "centre"
        What the walls bound: the balls' surfaces, or their centres.

    Returns
    -------
    Container
        Its walls are called left, right, front, back, bottom, top in a box; side where round; bottom and top at flat ends; front,
        back, left, right in a stadium; left, right, and side for the arc, in a wedge; edge1, edge2, ... in a polygon, of which
        edge1 goes from the first corner to the second, and a re-entrant corner belongs to the side that ends there; and
        scatterer.

    Raises CaromError, one line per problem.

    Examples
    --------
    >>> from carom.gas import container
    >>> strip = container("box", (30.0, 10.0), periodic=(True, False))
    >>> strip.names, strip.volume
    (('front', 'back'), 300.0)
    >>> lorentz = container("periodic", (1.0, 1.0), scatterers=[(0.5, 0.5, 0.25)])
    >>> round(lorentz.volume, 6)
    0.80365
    """
    faults = FaultList("container")
    if shape not in SHAPES:
        faults.add("shape", "a known shape", f"{shape!r}; {suggestion(shape, list(SHAPES))}")
    if bounds not in {"surface", "centre"}:
        faults.add("bounds", "'surface' or 'centre'", f"{bounds!r}")
    faults.raise_if_any()
    given = tuple(float(v) for v in size) if size is not None else ()
    if shape == "polygon":
        corners = np.array(points, dtype=float) if points is not None else np.zeros((0, 2))
        if (
            corners.ndim != 2
            or len(corners) < 3
            or corners.shape[1] != 2
            or not (np.isfinite(corners) & (corners >= 0)).all()
        ):
            faults.add("points", "three or more rows of two numbers >= 0", f"{points!r:.60}")
            faults.raise_if_any()
        given = (*corners.max(axis=0).tolist(), *(given[-1:] if len(given) in {1, 3} else ()))
    if len(given) not in {2, 3} or not all(0 < v < math.inf for v in given):
        faults.add("size", "two lengths > 0 for discs, or three for balls", f"{size!r}")
    elif shape in {"sphere", "cylinder"} and len(given) != 3:
        faults.add("size", f"three lengths > 0 for a {shape}", f"{size!r}")
    faults.raise_if_any()
    axes = len(given)
    try:
        closed = tuple(
            bool(v) for v in np.broadcast_to(np.array(shape == "periodic" if periodic is None else periodic), (axes,))
        )
    except ValueError:
        closed = (False,) * axes
        faults.add("periodic", f"one of true and false, or {axes}", f"{periodic!r}")
    straight = shape in {"periodic", "box"}
    if shape == "periodic" and not all(closed):
        faults.add("periodic", "true for shape 'periodic', or shape 'box'", f"{periodic!r}")
    elif not straight and (any(closed[:2]) or (shape == "sphere" and any(closed))):
        faults.add("periodic", "false, except along z for an upright shape", f"{periodic!r}")
    volume, faces, outline = math.prod(given), [], None
    if straight:
        faces = _planes(given, closed)
    elif shape == "sphere":
        r = given[0] / 2
        if len(set(given)) > 1:
            faults.add("size", "three times the same diameter", f"{given}")
        volume = 4 / 3 * math.pi * r**3
        faces = [ContainerFace("side", INSIDE, (1.0, 1.0, 1.0), (r, r, r), 4 * math.pi * r * r, r)]
    else:
        faces, area, outline = _plane_figure(faults, shape, given, points, bounds)
        height = given[2] if axes == 3 else 1.0
        volume = area * height
        faces = [replace(face, area=face.area * height) for face in faces]
        faces += _planes(given, closed, area) if axes == 3 else []
    obstacles, taken = _scatterers(faults, scatterers, given, closed)
    faults.raise_if_any()
    every = tuple(replace(face, bounds_surfaces=bounds == "surface") for face in (*faces, *obstacles))
    return Container(shape, given, closed, every, volume - taken, outline)


def as_container(side: Sequence[float] | Container, periodic: bool | Sequence[bool]) -> Container:
    """Return a container as it is, or the box with these lengths."""
    if isinstance(side, Container):
        return side
    return container("box", side, periodic=periodic)
