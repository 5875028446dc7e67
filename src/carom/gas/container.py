"""What holds a gas: a periodic box, one with walls, or anything that planes and round walls enclose."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.checks import Faults, nearest
from carom.engine.swarm_arrays import INSIDE, OUTSIDE, PLANE
from carom.gas.section import section
from carom.gas.wall import Numbers, Wall
from carom.outlines import polygon_depth

__all__ = ["SHAPES", "WALLS", "Container", "Wall", "container", "room_of"]

Array = NDArray[np.float64]
# The walls of a box, the lower and the upper one along each axis.
WALLS = ("left", "right", "front", "back", "bottom", "top")
SHAPES = ("periodic", "box", "circle", "sphere", "cylinder", "ellipse", "stadium", "wedge", "polygon")


@dataclass(frozen=True)
class Container:
    """A room in the box [0, size], of two numbers or three; made by :func:`container`."""

    shape: str
    size: Numbers
    periodic: tuple[bool, ...]
    walls: tuple[Wall, ...]
    volume: float
    """Area, in the plane. Of the room that the walls bound."""
    outline: Array | None = None
    """The corners of a polygon that is not convex, (N, 2): what lies behind one of its sides may be within."""

    @property
    def names(self) -> tuple[str, ...]:
        """The walls' names, each once: several faces may have one name."""
        return tuple(dict.fromkeys(wall.name for wall in self.walls))

    def clearance(self, radius: Any, x: Array) -> Array:
        """How far balls (N,) at x (N, 3) are from touching the walls (N,)."""
        least = np.full(len(x), math.inf)
        if self.outline is not None:
            thick = next(wall.thick for wall in self.walls if wall.part)
            least = polygon_depth(self.outline, x) - radius * thick
        for wall in self.walls:
            if not wall.part:
                least = np.minimum(least, wall.clearance(radius, x))
        return least


def _plane(name: str, axis: int, up: bool, size: Numbers, area: float) -> Wall:
    n, m = [0.0] * 3, [0.0] * 3
    n[axis] = -1.0 if up else 1.0
    m[axis] = size[axis] if up else 0.0
    return Wall(name, PLANE, tuple(n), tuple(m), area)


def _planes(size: Numbers, periodic: Sequence[bool], area: float | None = None) -> list[Wall]:
    """The walls of a box where it is not periodic; or only those across the last axis, of an area."""
    return [
        _plane(WALLS[2 * axis + up], axis, bool(up), size, math.prod(size) / size[axis] if area is None else area)
        for axis in range(len(size))
        if not periodic[axis] and (area is None or axis == 2)
        for up in (0, 1)
    ]


def _scatterers(faults: Faults, given: Any, size: Numbers, periodic: Sequence[bool]) -> tuple[list[Wall], float]:
    """Round obstacles, with the images that reach into the box; the volume that they take."""
    walls, taken = [], 0.0
    for k, row in enumerate(given):
        numbers = [float(v) for v in row]
        axes = len(numbers) - 1
        if axes not in {2, len(size)} or not numbers[-1] > 0 or not np.isfinite(numbers).all():
            faults.add(f"scatterers[{k}]", "x, y, radius; or x, y, z, radius", f"{row!r}")
            continue
        r = numbers[-1]
        across, centre = [0.0] * 3, [0.0] * 3
        across[:axes], centre[:axes] = [1.0] * axes, numbers[:-1]
        height = size[2] if axes < len(size) else 1.0
        taken += math.pi * r * r * height if axes == 2 else 4 / 3 * math.pi * r**3
        area = 2 * math.pi * r * height if axes == 2 else 4 * math.pi * r * r
        shifts = [(-1, 0, 1) if a < axes and periodic[a] else (0,) for a in range(3)]
        for step in np.stack(np.meshgrid(*shifts, indexing="ij"), axis=-1).reshape(-1, 3):
            at = [
                c + s * (size[a] if a < len(size) else 0.0) for a, (c, s) in enumerate(zip(centre, step, strict=True))
            ]
            # (a ball that touches it has its centre further away; one more radius than its own is enough)
            if all(-2 * r - size[a] / 2 < at[a] < size[a] * 1.5 + 2 * r for a in range(axes)):
                walls.append(Wall("scatterer", OUTSIDE, tuple(across), tuple(at), 0.0 if step.any() else area, r))
    return walls, taken


def container(
    shape: str,
    size: Sequence[float] | None = None,
    *,
    periodic: bool | Sequence[bool] | None = None,
    points: Any = None,
    scatterers: Sequence[Sequence[float]] = (),
    bounds: str = "surface",
) -> Container:
    """A room for a gas, in the box [0, size].

    Parameters
    ----------
    shape : str
        One of :data:`SHAPES`. ``size`` has two numbers for discs or three for balls, and is that of the box around it: a
        circle has (d, d), a sphere (d, d, d). Given three numbers, circle (or cylinder), ellipse, stadium, wedge and polygon
        stand upright along z, between flat ends. A wedge is a sector with its tip in the middle of y = 0, which opens along y up
        to an arc about the tip: of an angle A and a radius R it has the size (2 R sin(A/2), R).
    periodic : bool, or one for each axis
        A "box" may be periodic along some axes, what stands upright along z. Left out: False.
    points : rows of x, y
        The corners of a "polygon", in order, which need no size in the plane: (height,) is enough, or nothing. It need not be
        convex: balls meet its re-entrant corners as they are.
    scatterers : rows of x, y, radius, or x, y, z, radius
        Round obstacles: with "periodic", a Lorentz gas or Sinai billiard.
    bounds : "surface" or "centre"
        What the walls bound: the balls' surfaces, or their centres.

    The walls of a box are called left, right, front, back, bottom, top; round ones side; ends bottom and top; those of a
    stadium front, back, left, right; of a wedge left, right, and its arc side; of a polygon edge1, edge2, ..., of which edge1 goes
    from the first corner to the second, and a re-entrant corner belongs to the side that ends there; obstacles scatterer. Raises
    CaromError.
    """
    faults = Faults("container")
    if shape not in SHAPES:
        faults.add("shape", "a known shape", f"{shape!r}; {nearest(shape, list(SHAPES))}")
    if bounds not in {"surface", "centre"}:
        faults.add("bounds", "'surface' or 'centre'", f"{bounds!r}")
    faults.done()
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
            faults.done()
        given = (*corners.max(axis=0).tolist(), *(given[-1:] if len(given) in {1, 3} else ()))
    if len(given) not in {2, 3} or not all(0 < v < math.inf for v in given):
        faults.add("size", "two lengths > 0 for discs, or three for balls", f"{size!r}")
    elif shape in {"sphere", "cylinder"} and len(given) != 3:
        faults.add("size", f"three lengths > 0 for a {shape}", f"{size!r}")
    faults.done()
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
        faults.add("periodic", "a box without walls, or shape 'box'", f"{periodic!r}")
    elif not straight and (any(closed[:2]) or (shape == "sphere" and any(closed))):
        faults.add("periodic", "a round room that ends, but for the axis of an upright one", f"{periodic!r}")
    volume, walls, outline = math.prod(given), [], None
    if straight:
        walls = _planes(given, closed)
    elif shape == "sphere":
        r = given[0] / 2
        if len(set(given)) > 1:
            faults.add("size", "three times the same diameter", f"{given}")
        volume = 4 / 3 * math.pi * r**3
        walls = [Wall("side", INSIDE, (1.0, 1.0, 1.0), (r, r, r), 4 * math.pi * r * r, r)]
    else:
        walls, area, outline = section(faults, shape, given, points, bounds)
        height = given[2] if axes == 3 else 1.0
        volume = area * height
        walls = [replace(wall, area=wall.area * height) for wall in walls]
        walls += _planes(given, closed, area) if axes == 3 else []
    obstacles, taken = _scatterers(faults, scatterers, given, closed)
    faults.done()
    every = tuple(replace(wall, thick=bounds == "surface") for wall in (*walls, *obstacles))
    return Container(shape, given, closed, every, volume - taken, outline)


def room_of(side: Sequence[float] | Container, periodic: bool | Sequence[bool]) -> Container:
    """The room, of a box by its lengths."""
    if isinstance(side, Container):
        return side
    return container("box", side, periodic=periodic)
