"""Tables in space: sphere, box, parallel plates, and a cylinder over any table of the plane."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from carom.checks import Faults, float_array
from carom.orbits.shape import Shape, face
from carom.orbits.tables import (
    Bounds,
    Table,
    acceleration_of,
    check_bounds,
    circle,
    need_room,
    positive,
    rectangle,
    strip,
)

__all__ = ["box", "cylinder", "plates", "sphere"]


def sphere(radius: float = 1.0, *, bounds: Bounds = "centre") -> Table:
    """The inside of a sphere about the origin."""
    faults = Faults("sphere")
    radius = positive(faults, "radius", radius)
    check_bounds(faults, bounds)
    faults.done()

    def make(inset: float) -> Shape:
        need_room("sphere", radius - inset, "in the sphere", inset)
        return Shape(sphere=radius - inset, size=radius)

    return Table("sphere", bounds, 3, make, {"radius": radius})


def plates(distance: float = 1.0, *, bounds: Bounds = "centre", acceleration: Sequence[float] = (0.0, 0.0)) -> Table:
    """Two parallel plates y = -distance/2 and y = distance/2; ``acceleration`` (x, z) along them."""
    faults = Faults("plates")
    distance = positive(faults, "distance", distance)
    check_bounds(faults, bounds)
    g = acceleration_of(faults, acceleration, 2)
    faults.done()
    sizes = {"distance": distance} | ({"acceleration": list(g)} if any(g) else {})
    return Table("plates", bounds, 3, strip(distance).make, sizes, (g[0], 0.0, g[1]))


def cylinder(section: Table | float = 1.0, height: float | None = None, *, acceleration: float = 0.0) -> Table:
    """A cylinder along z over a table of the plane (a number: over a circle of that radius), open or with two lids.

    ``acceleration`` along the axis: gravity is -9.81. What the section bounds, the cylinder bounds, and what pulls there pulls
    here too.
    """
    faults = Faults("cylinder")
    if isinstance(section, int | float):
        section = circle(section)
    if not isinstance(section, Table) or section.dimension != 2:
        faults.add("section", "a table of the plane, or a radius", f"{section!r:.60}")
        faults.done()
    if height is not None:
        height = positive(faults, "height", height)
    (g,) = acceleration_of(faults, acceleration)
    faults.done()

    def make(inset: float) -> Shape:
        shape = section.make(inset)
        if height is not None:
            need_room("cylinder", height / 2 - inset, "between the lids", inset)
            c = inset - height / 2
            shape.faces = [*shape.faces, face(0, 0, c, nz=1.0), face(0, 0, c, nz=-1.0)]
            shape.order = None
        return shape

    sizes = {"section": section.name, **section.sizes}
    sizes |= ({} if height is None else {"height": height}) | ({"acceleration": g} if g else {})
    if any(section.pull):
        sizes["acceleration"] = [section.pull[0], section.pull[1], g]
    return Table("cylinder", section.bounds, 3, make, sizes, (section.pull[0], section.pull[1], g))


def box(size: Sequence[float] = (1.0, 1.0, 1.0), *, bounds: Bounds = "centre") -> Table:
    """A box (x, y, z) about the origin. An edge between lid and side is met as lid and side, one after the other."""
    faults = Faults("box")
    check_bounds(faults, bounds)
    try:
        sides = float_array(size)
    except (TypeError, ValueError):
        sides = np.empty(0)
    if sides.shape != (3,) or not (np.isfinite(sides) & (sides > 0)).all():
        faults.add("size", "three lengths > 0", repr(size))
    faults.done()
    x, y, z = (float(s) for s in sides)
    made = cylinder(rectangle(x, y, bounds=bounds), z)
    return replace(made, name="box", sizes={"size": [x, y, z]})
