"""Containers of gases: periodic boxes, boxes with walls, and whatever planes and round walls enclose.

A container has faces, each of a named wall: several faces may be one wall. A plane figure holds discs or, upright between flat
ends, balls; its faces have lengths in place of areas until they are given a height.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from carom.bodies import holds_arrays
from carom.core.geometry.curve import ROW
from carom.core.geometry.polygon import polygon_depth
from carom.errors import FaultList, did_you_mean
from carom.gas.edmd.gas_records import CURVE, INSIDE, OUTSIDE, PLANE
from carom.gas.faces import ContainerFace, Floats, faces_of
from carom.scene.figures import FIGURES, Figure, PlaneFigure, figure
from carom.scene.figures.solids import CylinderFigure, SphereFigure

__all__ = [
    "BOXES",
    "SHAPES",
    "WALLS",
    "Container",
    "as_container",
    "container",
    "container_figures",
    "in_figure",
    "wall_name",
]

Array = NDArray[np.float64]

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
    def curves(self) -> Array:
        """The tables of all arcs of smooth curves, one after the other."""
        return np.concatenate([np.empty((0, ROW)), *(face.table for face in self.faces)])

    def _clearance_of_curves(self, depth: Array, gap: Array, radius: Array, x: Array) -> Array:
        """Return the gaps where a polygon that is almost the curve does not tell them to rounding: near it, by the arcs."""
        outline = cast(Array, self.outline)
        error = float(np.linalg.norm(np.diff(outline, axis=0), axis=1).max())
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
    faults: FaultList, given: Any, size: Floats, periodic: Sequence[bool]
) -> tuple[list[ContainerFace], float]:
    """Return round obstacles, with the images that reach into the box, and the volume that they take."""
    faces, taken = [], 0.0
    for k, row in enumerate(given):
        numbers = [float(v) for v in row]
        axes = len(numbers) - 1
        if axes not in {2, len(size)} or not numbers[-1] > 0 or not np.isfinite(numbers).all():
            faults.add(f"obstacles[{k}]", "x, y, radius; or x, y, z, radius", f"{row!r}")
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


def _plates(faults: FaultList, given: Any, size: Floats, bounds: str) -> list[ContainerFace]:
    """Return both sides and both edges of thin straight walls."""
    faces: list[ContainerFace] = []
    for k, row in enumerate(given):
        numbers = [float(v) for v in row]
        if len(numbers) != 4 or not np.isfinite(numbers).all() or numbers[:2] == numbers[2:]:
            faults.add(f"plates[{k}]", "x1, y1, x2, y2 of two places", f"{row!r}")
            continue
        if bounds != "surface":
            faults.add(
                f"plates[{k}]", "none where walls bound the centres", f"{row!r}", "plates need bounds = 'surface'"
            )
            continue
        (x, y), end, name = numbers[:2], numbers[2:], f"plate{k + 1}"
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
    faults = FaultList("container")
    if bounds not in {"surface", "centre"}:
        faults.add("bounds", "'surface' or 'centre'", f"{bounds!r}")
    faults.raise_if_any()
    if shape in BOXES:
        return _box(faults, str(shape), size, periodic, obstacles, plates, bounds, sizes)
    if isinstance(shape, str) and shape.partition(":")[0] not in container_figures():
        known = [*BOXES, *container_figures()]
        faults.add("shape", f"one of {', '.join(known)}", f"{shape!r}", did_you_mean(shape, known))
        faults.raise_if_any()
    if size is not None:
        sizes["size"] = size
    # (sizes that are left out are about 1 m for a billiard; a gas is asked for all)
    named = {"shape": shape, **sizes} if isinstance(shape, str) and ":" not in shape else None
    if shape == "cylinder" and height is not None:
        named = {**(named or {}), "height": height}
    made = figure(named) if named else figure(shape, **sizes)
    return in_figure(made, height, periodic, obstacles, bounds, plates)


def container_figures() -> list[str]:
    """Return the names of the figures in which a gas can be."""
    return [name for name, kind in FIGURES.items() if issubclass(kind, PlaneFigure | SphereFigure | CylinderFigure)]


def in_figure(
    made: Figure, height: float | None, periodic: Any, obstacles: Sequence[Sequence[float]], bounds: str,
    plates: Sequence[Sequence[float]] = (),
) -> Container:  # fmt: skip
    """Return the container in a figure: a sphere, a cylinder, or a plane figure, upright where it has a height."""
    faults, shape = FaultList("container"), made.kind()
    corners, walls, size = None, [], cast(Floats, ())
    volume = 0.0
    if isinstance(made, CylinderFigure):
        height = made.height if height is None else height
        made = made.over
        if height is None:
            faults.add("height", "a length > 0 for a cylinder", "none")
            faults.raise_if_any()
    if isinstance(made, SphereFigure):
        r = made.radius
        walls = [ContainerFace("side", INSIDE, (1.0, 1.0, 1.0), (r, r, r), 4 * math.pi * r * r, r)]
        volume, size = 4 / 3 * math.pi * r**3, (2 * r, 2 * r, 2 * r)
    elif isinstance(made, PlaneFigure):
        walls, size, corners = faces_of(made, bounds)
        volume = made.area
    else:
        faults.add("shape", f"one of {', '.join((*BOXES, *container_figures()))}", f"{shape!r}")
        faults.raise_if_any()
    if height is not None:
        size = (*size, height)
    closed = _periodic(faults, periodic, len(size))
    if any(closed[:2]) or (isinstance(made, SphereFigure) and any(closed)):
        faults.add("periodic", "false, except along z for an upright shape", f"{periodic!r}")
    if height is not None:
        walls = [replace(face, area=face.area * height) for face in walls] + _planes(size, closed, volume)
        volume *= height
    made_of = Container(shape, size, closed, tuple(walls), volume, corners)
    return _with_obstacles(faults, made_of, obstacles, plates, bounds)


def _periodic(faults: FaultList, periodic: Any, axes: int) -> tuple[bool, ...]:
    """Return along which axes a container is periodic."""
    try:
        return tuple(
            bool(v) for v in np.broadcast_to(np.array(bool(periodic) if periodic is None else periodic), (axes,))
        )
    except ValueError:
        faults.add("periodic", f"one of true and false, or {axes}", f"{periodic!r}")
        return (False,) * axes


def _box(
    faults: FaultList,
    shape: str,
    size: Any,
    periodic: Any,
    obstacles: Any,
    plates: Any,
    bounds: str,
    sizes: Mapping[str, Any],
) -> Container:
    """Return a box, or a periodic one."""
    for name, value in sizes.items():
        faults.add(name, "a field that is known here", f"{value!r:.60}", f"a {shape} has a size")
    given = tuple(float(v) for v in size) if size is not None else ()
    if len(given) not in {2, 3} or not all(0 < v < math.inf for v in given):
        faults.add("size", "two lengths > 0 for discs, or three for balls", f"{size!r}")
    faults.raise_if_any()
    closed = _periodic(faults, shape == "periodic" if periodic is None else periodic, len(given))
    if shape == "periodic" and not all(closed):
        faults.add("periodic", "true for shape 'periodic', or shape 'box'", f"{periodic!r}")
    made = Container(shape, given, closed, tuple(_planes(given, closed)), math.prod(given))
    return _with_obstacles(faults, made, obstacles, plates, bounds)


def _with_obstacles(faults: FaultList, made: Container, obstacles: Any, plates: Any, bounds: str) -> Container:
    """Return a container with round obstacles and plates, whose faces know whether they bound surfaces; raise its faults."""
    walls, taken = _obstacles(faults, obstacles, made.size, made.periodic)
    walls += _plates(faults, plates, made.size, bounds)
    faults.raise_if_any()
    every = tuple(
        replace(face, name=wall_name(face.name, len(made.size)), bounds_surfaces=bounds == "surface")
        for face in (*made.faces, *walls)
    )
    return replace(made, faces=every, volume=made.volume - taken)


def as_container(side: Sequence[float] | Container, periodic: bool | Sequence[bool]) -> Container:
    """Return a container as it is, or the box with these lengths."""
    if isinstance(side, Container):
        return side
    return container("box", side, periodic=periodic)


SHAPES = (*BOXES, *container_figures())
