"""Billiard tables in space: sphere, box, parallel plates, and a cylinder over any table in the plane."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from carom.billiards.boundary import Boundary, face
from carom.billiards.checks import Bounds, checked_acceleration, positive_number, require_bounds, require_room
from carom.billiards.tables import Table, circle, rectangle, strip
from carom.errors import FaultList, float_array

__all__ = ["box", "cylinder", "plates", "sphere"]


def _sphere_boundary(radius: float, inset: float) -> Boundary:
    """Return the boundary of a sphere for a centre that stays ``inset`` away from the wall."""
    require_room("sphere", radius - inset, "in the sphere", inset)
    return Boundary(sphere=radius - inset, size=radius)


def sphere(radius: float = 1.0, *, bounds: Bounds = "centre") -> Table:
    """Return a sphere about the origin.

    Parameters
    ----------
    radius : float
        m.
    bounds : "centre" or "surface"
        Whether the wall bounds the ball's centre or its surface.

    Returns
    -------
    Table

    Raises
    ------
    CaromError
        One line per problem.

    Examples
    --------
    >>> from carom import billiards
    >>> print(billiards.sphere(2.0))
    sphere (radius 2.0; bounds the centre)
    """
    faults = FaultList("sphere")
    radius = positive_number(faults, "radius", radius)
    require_bounds(faults, bounds)
    faults.raise_if_any()

    return Table("sphere", bounds, 3, partial(_sphere_boundary, radius), {"radius": radius})


def plates(distance: float = 1.0, *, bounds: Bounds = "centre", acceleration: Sequence[float] = (0.0, 0.0)) -> Table:
    """Return two parallel plates y = -distance/2 and y = distance/2.

    Parameters
    ----------
    distance : float
        m.
    bounds : "centre" or "surface"
        Whether the wall bounds the ball's centre or its surface.
    acceleration : (x, z)
        Constant acceleration along the plates, m/s^2.

    Returns
    -------
    Table

    Raises
    ------
    CaromError
        One line per problem.

    Examples
    --------
    >>> from carom import billiards
    >>> print(billiards.plates(1.0, acceleration=(0.0, -9.81)))
    plates (distance 1.0, acceleration [0.0, -9.81]; bounds the centre)
    """
    faults = FaultList("plates")
    distance = positive_number(faults, "distance", distance)
    require_bounds(faults, bounds)
    g = checked_acceleration(faults, acceleration, 2)
    faults.raise_if_any()
    sizes = {"distance": distance} | ({"acceleration": list(g)} if any(g) else {})
    return Table("plates", bounds, 3, strip(distance).make, sizes, (g[0], 0.0, g[1]))


def _cylinder_boundary(section: Table, height: float | None, inset: float) -> Boundary:
    """Return the boundary of a cylinder for a centre that stays ``inset`` away from the wall."""
    shape = section.make(inset)
    if height is not None:
        require_room("cylinder", height / 2 - inset, "between the lids", inset)
        c = inset - height / 2
        if shape.order is not None:  # (the lids come after the other faces, and last along the wall)
            shape.order = [k + 2 * (k >= len(shape.faces)) for k in shape.order]
            shape.order += [len(shape.faces), len(shape.faces) + 1]
        shape.faces = [*shape.faces, face(0, 0, c, nz=1.0), face(0, 0, c, nz=-1.0)]
    return shape


def cylinder(section: Table | float = 1.0, height: float | None = None, *, acceleration: float = 0.0) -> Table:
    """Return a cylinder along z over a table in the plane, open or with two lids.

    Parameters
    ----------
    section : Table or float
        A table in the plane, or the radius of a circle, m. The cylinder bounds the same ("centre" or "surface") as the
        section, and an acceleration of the section is kept.
    height : float, optional
        Distance of the lids, m. Default: open.
    acceleration : float
        Along the axis, m/s^2 (gravity: -9.81).

    Returns
    -------
    Table

    Raises
    ------
    CaromError
        One line per problem.

    Examples
    --------
    >>> from carom import billiards
    >>> print(billiards.cylinder(1.0, height=2.0, acceleration=-9.81))
    cylinder (section circle, radius 1.0, height 2.0, acceleration -9.81; bounds the centre)
    """
    faults = FaultList("cylinder")
    if isinstance(section, int | float):
        section = circle(section)
    if not isinstance(section, Table) or section.dimension != 2:
        faults.add("section", "a table in the plane, or a radius", f"{section!r:.60}")
        faults.raise_if_any()
    if height is not None:
        height = positive_number(faults, "height", height)
    (g,) = checked_acceleration(faults, acceleration)
    faults.raise_if_any()

    sizes = {"section": section.name, **section.sizes}
    sizes |= ({} if height is None else {"height": height}) | ({"acceleration": g} if g else {})
    if any(section.acceleration):
        sizes["acceleration"] = [section.acceleration[0], section.acceleration[1], g]
    make = partial(_cylinder_boundary, section, height)
    return Table("cylinder", section.bounds, 3, make, sizes, (section.acceleration[0], section.acceleration[1], g))


def box(size: Sequence[float] = (1.0, 1.0, 1.0), *, bounds: Bounds = "centre") -> Table:
    """Return a box about the origin.

    At an edge between a lid and a side, lid and side act one after the other.

    Parameters
    ----------
    size : (x, y, z)
        m.
    bounds : "centre" or "surface"
        Whether the wall bounds the ball's centre or its surface.

    Returns
    -------
    Table

    Raises
    ------
    CaromError
        One line per problem.

    Examples
    --------
    >>> from carom import billiards
    >>> print(billiards.box((1.0, 2.0, 3.0)))
    box (size [1.0, 2.0, 3.0]; bounds the centre)
    """
    faults = FaultList("box")
    require_bounds(faults, bounds)
    try:
        sides = float_array(size)
    except (TypeError, ValueError):
        sides = np.empty(0)
    if sides.shape != (3,) or not (np.isfinite(sides) & (sides > 0)).all():
        faults.add("size", "three lengths > 0", repr(size))
    faults.raise_if_any()
    x, y, z = (float(s) for s in sides)
    made = cylinder(rectangle(x, y, bounds=bounds), z)
    return replace(made, name="box", sizes={"size": [x, y, z]})
