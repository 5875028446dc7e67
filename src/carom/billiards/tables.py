"""Billiard tables in the plane: strip, wedge, polygons, circle, ellipse, stadium."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.billiards.boundary import Boundary, Face, InsetEllipse, Obstacle, RoundWall, face
from carom.billiards.checks import Bounds, checked_acceleration, positive_number, require_bounds, require_room
from carom.core.geometry.polygon import outline_faults
from carom.errors import FaultList, float_array

__all__ = [
    "Table",
    "circle",
    "ellipse",
    "polygon",
    "rectangle",
    "regular",
    "stadium",
    "strip",
    "under",
    "wedge",
]  # fmt: skip

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Table:
    """A billiard table, made by one of the functions of this package.

    ``bounds`` says what the given curve bounds: the ball's "centre", as in mathematics, or its "surface". With "surface" the
    centre keeps to the parallel curve, one radius inside.

    Examples
    --------
    >>> from carom import billiards
    >>> table = billiards.circle(2.0, bounds="surface")
    >>> print(table)
    circle (radius 2.0; bounds the surface)
    >>> table.shape(0.5).lengths / (2 * 3.141592653589793)
    array([1.5])
    """

    name: str
    bounds: str
    dimension: int
    """2: a disc in the plane, whose spin is a number. 3: a ball in space."""
    make: Callable[[float], Boundary]
    """Returns the boundary of the centre's region, given the distance that the centre keeps from the wall."""
    sizes: dict[str, Any]
    """The arguments that it was made from."""
    acceleration: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """Constant acceleration of the ball, m/s^2."""

    def shape(self, radius: float) -> Boundary:
        """Return the boundary of the region open to the centre of a ball of that radius."""
        return self.make(radius if self.bounds == "surface" else 0.0)

    def wall(self) -> Boundary:
        """Return the wall itself."""
        return self.make(0.0)

    def __str__(self) -> str:
        """Return its name and sizes in one line."""
        sizes = ", ".join(f"{key} {value}" for key, value in self.sizes.items())
        return f"{self.name} ({sizes}; bounds the {self.bounds})"


def under(table: Table, acceleration: Sequence[float]) -> Table:
    """Return the table with a constant acceleration (x, y), in space (x, y, z), m/s^2, that may point across walls.

    The ball then moves on parabolas: gravity in a wedge or a circle, for example.

    Parameters
    ----------
    table : Table
    acceleration : (x, y) or (x, y, z), m/s^2; replaces the table's

    Returns
    -------
    Table

    Examples
    --------
    >>> from carom import billiards
    >>> print(billiards.under(billiards.circle(), (0.0, -9.81)))
    circle (radius 1.0, acceleration [0.0, -9.81]; bounds the centre)
    """
    faults = FaultList("under")
    if not isinstance(table, Table):
        faults.add("table", "a table such as carom.billiards.circle()", f"{table!r:.60}")
        faults.raise_if_any()
    g = checked_acceleration(faults, acceleration, table.dimension)
    faults.raise_if_any()
    sizes = {key: value for key, value in table.sizes.items() if key != "acceleration"} | {"acceleration": list(g)}
    return replace(table, sizes=sizes, acceleration=(g[0], g[1], g[2] if table.dimension == 3 else 0.0))


def _strip_boundary(width: float, inset: float) -> Boundary:
    """Return the boundary of a strip for a centre that stays ``inset`` away from the wall."""
    require_room("strip", width / 2 - inset, "between the walls", inset)
    c = inset - width / 2
    return Boundary(faces=[face(0, 1, c), face(0, -1, c)], size=width)


def strip(width: float = 1.0, *, bounds: Bounds = "centre", acceleration: float = 0.0) -> Table:
    """Return a strip: two parallel walls y = -width/2 and y = width/2.

    Parameters
    ----------
    width : float, m
    bounds : "centre" or "surface" of the ball
    acceleration : float, along the walls, in x, m/s^2

    Returns
    -------
    Table. Raises CaromError, one line per problem.

    Examples
    --------
    >>> from carom import billiards
    >>> print(billiards.strip(2.0))
    strip (width 2.0; bounds the centre)
    """
    faults = FaultList("strip")
    width = positive_number(faults, "width", width)
    require_bounds(faults, bounds)
    (g,) = checked_acceleration(faults, acceleration)
    faults.raise_if_any()

    sizes = {"width": width} | ({"acceleration": g} if g else {})
    return Table("strip", bounds, 2, partial(_strip_boundary, width), sizes, (g, 0.0, 0.0))


def _wedge_boundary(angle: float, inset: float) -> Boundary:
    """Return the boundary of a wedge for a centre that stays ``inset`` away from the wall."""
    cos, sin = math.cos(angle / 2), math.sin(angle / 2)
    # the wedge of the centre has its vertex at (inset/sin, 0)
    tip = cos * inset / sin
    # arc length, with the ball on the left: inwards along the upper wall, outwards along the lower
    return Boundary(faces=[face(sin, cos, inset, tip), face(sin, -cos, inset, end=-tip)], size=1.0 + inset)


def wedge(angle: float, *, bounds: Bounds = "centre") -> Table:
    """Return a wedge: two walls from the origin, symmetric about the x axis.

    Parameters
    ----------
    angle : float, between the walls, 0 to pi, rad
    bounds : "centre" or "surface" of the ball

    Returns
    -------
    Table. Raises CaromError, one line per problem.

    Examples
    --------
    >>> from carom import billiards
    >>> print(billiards.wedge(1.0))
    wedge (angle 1.0; bounds the centre)
    """
    faults = FaultList("wedge")
    angle = positive_number(faults, "angle", angle, math.pi)
    require_bounds(faults, bounds)
    faults.raise_if_any()
    return Table("wedge", bounds, 2, partial(_wedge_boundary, angle), {"angle": angle})


def _polygon_boundary(name: str, corners: Array, inset: float) -> Boundary:
    """Return the boundary of a polygon (corners counterclockwise) for a centre that stays ``inset`` away from the wall."""
    sides = np.roll(corners, -1, axis=0) - corners
    lengths = np.hypot(sides[:, 0], sides[:, 1])
    t = sides / lengths[:, None]
    turn = t[:, 0] * np.roll(t[:, 1], -1) - t[:, 1] * np.roll(t[:, 0], -1)  # at the end of each side
    reflex = turn < -1e-12
    smooth = np.abs(turn) <= 1e-12
    # a convex corner shortens both its sides by inset/tan(half the inner angle)
    cos = (t * np.roll(t, -1, axis=0)).sum(-1)
    cut = np.where(reflex | smooth, 0.0, inset * turn / (1 + cos))
    faces: list[Face] = []
    outside: list[Obstacle] = []
    order: list[int] = []
    for k in range(len(corners)):
        (tx, ty), before = t[k], k - 1
        x0 = tx * corners[k, 0] + ty * corners[k, 1]
        begin, end = float(x0 + cut[before]), float(x0 + lengths[k] - cut[k])
        require_room(name, end - begin, f"to touch side {k + 1}", inset)
        # around a reflex vertex the centre moves on a circle
        low = -math.inf if smooth[before] or (reflex[before] and inset) else begin
        high = math.inf if smooth[k] or (reflex[k] and inset) else end
        c = -ty * corners[k, 0] + tx * corners[k, 1] + inset
        faces.append(face(-float(ty), float(tx), float(c), begin, end, low=low, high=high))
        order.append(k)
        if reflex[k] and inset:
            x, y = corners[(k + 1) % len(corners)]
            span = math.acos(max(-1.0, min(1.0, float(cos[k]))))
            order.append(len(corners) + len(outside))
            outside.append(Obstacle(float(x), float(y), inset, math.atan2(tx, -ty), span))
    return Boundary(
        faces=faces, outside=outside, order=order, finite_faces=bool(reflex.any()), size=float(lengths.max()),
        vertices=corners if reflex.any() else None, clearance=inset,
    )  # fmt: skip


def polygon(vertices: ArrayLike, *, bounds: Bounds = "centre", name: str = "polygon") -> Table:
    """Return the polygon with the vertices in order; it need not be convex, but must not intersect itself.

    Parameters
    ----------
    vertices : array (N, 2), m
    bounds : "centre" or "surface" of the ball
    name : str, for messages

    Returns
    -------
    Table. Raises CaromError for coincident vertices and for sides that cross, overlap or run back, with their numbers from 1.

    Examples
    --------
    >>> from carom import billiards
    >>> table = billiards.polygon([(0, 0), (2, 0), (0, 1)])
    >>> table.wall().lengths
    array([2.        , 2.23606798, 1.        ])
    """
    faults = FaultList(name)
    require_bounds(faults, bounds)
    try:
        corners = float_array(vertices)
    except (TypeError, ValueError):
        corners = np.empty(0)
    if corners.ndim != 2 or corners.shape[1:] != (2,) or len(corners) < 3 or not np.isfinite(corners).all():
        faults.add("vertices", "three or more points (x, y)", f"{vertices!r:.60}")
        faults.raise_if_any()
    for expected, got in outline_faults(corners):
        faults.add("vertices", expected, got)
    faults.raise_if_any()
    x, y = (corners - corners[0]).T
    if np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)) < 0:
        corners = corners[::-1].copy()
    make = partial(_polygon_boundary, name, corners)
    return Table(name, bounds, 2, make, {"vertices": [[float(x), float(y)] for x, y in corners]})


def regular(sides: int, radius: float = 1.0, *, bounds: Bounds = "centre") -> Table:
    """Return the regular polygon about the origin whose lowest side is horizontal.

    Parameters
    ----------
    sides : int
    radius : float, of the circumscribed circle, m
    bounds : "centre" or "surface" of the ball

    Returns
    -------
    Table. Raises CaromError, one line per problem.

    Examples
    --------
    >>> from carom import billiards
    >>> print(billiards.regular(5))
    polygon (sides 5, radius 1.0; bounds the centre)
    """
    faults = FaultList("polygon")
    if not (isinstance(sides, int | np.integer) and 3 <= sides <= 10_000):
        faults.add("sides", "an integer from 3 to 10000", repr(sides))
        sides = 3
    radius = positive_number(faults, "radius", radius)
    faults.raise_if_any()
    angle = -math.pi / 2 + math.pi / sides * (2 * np.arange(sides) - 1)
    made = polygon(radius * np.stack([np.cos(angle), np.sin(angle)], axis=-1), bounds=bounds)
    return replace(made, sizes={"sides": int(sides), "radius": radius})


def rectangle(width: float = 2.0, height: float = 1.0, *, bounds: Bounds = "centre") -> Table:
    """Return a rectangle about the origin.

    Parameters
    ----------
    width, height : float, m
    bounds : "centre" or "surface" of the ball

    Returns
    -------
    Table. Raises CaromError, one line per problem.

    Examples
    --------
    >>> from carom import billiards
    >>> print(billiards.rectangle(2.0, 1.0))
    rectangle (width 2.0, height 1.0; bounds the centre)
    """
    faults = FaultList("rectangle")
    x, y = positive_number(faults, "width", width) / 2, positive_number(faults, "height", height) / 2
    faults.raise_if_any()
    made = polygon([(-x, -y), (x, -y), (x, y), (-x, y)], bounds=bounds, name="rectangle")
    return replace(made, sizes={"width": 2 * x, "height": 2 * y})


def _circle_boundary(radius: float, inset: float) -> Boundary:
    """Return the boundary of a circle for a centre that stays ``inset`` away from the wall."""
    require_room("circle", radius - inset, "in the circle", inset)
    return Boundary(inside=[RoundWall(0.0, 0.0, radius - inset, 0)], size=radius)


def circle(radius: float = 1.0, *, bounds: Bounds = "centre") -> Table:
    """Return a circle about the origin.

    Parameters
    ----------
    radius : float, m
    bounds : "centre" or "surface" of the ball

    Returns
    -------
    Table. Raises CaromError, one line per problem.

    Examples
    --------
    >>> from carom import billiards
    >>> print(billiards.circle(1.5))
    circle (radius 1.5; bounds the centre)
    """
    faults = FaultList("circle")
    radius = positive_number(faults, "radius", radius)
    require_bounds(faults, bounds)
    faults.raise_if_any()

    return Table("circle", bounds, 2, partial(_circle_boundary, radius), {"radius": radius})


def _ellipse_boundary(p: float, q: float, inset: float) -> Boundary:
    """Return the boundary of an ellipse for a centre that stays ``inset`` away from the wall."""
    require_room("ellipse", min(p, q) - inset, "in the ellipse", inset)
    return Boundary(ellipse=InsetEllipse(p, q, inset), size=max(p, q))


def ellipse(major: float = 1.0, minor: float = 0.8, *, bounds: Bounds = "centre") -> Table:
    """Return the ellipse (x/major)^2 + (y/minor)^2 = 1.

    With bounds="surface" the centre moves within the parallel curve, which is not an ellipse; it is treated exactly (flights that
    leave the wall at less than 1e-8 rad end as "grazed"). A ball larger than the smallest radius of curvature does not reach the
    ends of the long axis: its centre's curve has two arcs, with corners where the ball touches both sides at once. A ball as large
    as the smaller half axis does not fit.

    Parameters
    ----------
    major, minor : float, half axes in x and y, m
    bounds : "centre" or "surface" of the ball

    Returns
    -------
    Table. Raises CaromError, one line per problem.

    Examples
    --------
    >>> from carom import billiards
    >>> billiards.ellipse(1.2, 0.5).wall().lengths
    array([5.56...])
    """
    faults = FaultList("ellipse")
    p, q = positive_number(faults, "major", major), positive_number(faults, "minor", minor)
    require_bounds(faults, bounds)
    faults.raise_if_any()

    return Table("ellipse", bounds, 2, partial(_ellipse_boundary, p, q), {"major": p, "minor": q})


def _stadium_boundary(straight: float, radius: float, inset: float) -> Boundary:
    """Return the boundary of a stadium for a centre that stays ``inset`` away from the wall."""
    r, x = radius - inset, straight / 2
    require_room("stadium", r, "in the stadium", inset)
    sides = [
        face(0, 1, -r, -x, x, low=-math.inf, high=math.inf),
        face(0, -1, -r, -x, x, low=-math.inf, high=math.inf),
    ]
    # the parallel curve of a stadium is a stadium
    return Boundary(
        faces=sides, inside=[RoundWall(x, 0.0, r, 1), RoundWall(-x, 0.0, r, -1)], order=[0, 2, 1, 3], finite_faces=True,
        size=radius + x,
    )  # fmt: skip


def stadium(straight: float = 2.0, radius: float = 1.0, *, bounds: Bounds = "centre") -> Table:
    """Return Bunimovich's stadium: two straight sides along x, and two half circles.

    Parameters
    ----------
    straight, radius : float, length of the straight sides and radius of the half circles, m
    bounds : "centre" or "surface" of the ball

    Returns
    -------
    Table. Raises CaromError, one line per problem.

    Examples
    --------
    >>> from carom import billiards
    >>> billiards.stadium(2.0, 1.0).wall().lengths
    array([2.        , 2.        , 3.14159265, 3.14159265])
    """
    faults = FaultList("stadium")
    straight, radius = positive_number(faults, "straight", straight), positive_number(faults, "radius", radius)
    require_bounds(faults, bounds)
    faults.raise_if_any()

    return Table(
        "stadium", bounds, 2, partial(_stadium_boundary, straight, radius), {"straight": straight, "radius": radius}
    )
