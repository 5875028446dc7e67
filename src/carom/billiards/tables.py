"""Billiard tables: a figure, whether it bounds the centre or the surface of the ball, and a force."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from os import PathLike
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike

from carom.billiards.boundary import Boundary, boundary_of
from carom.errors import MAX_MAGNITUDE, CaromError, Fault, FaultList, checked_number, float_array, suggestion
from carom.scene.figures import Figure, figure
from carom.scene.figures.rounds import CircleFigure

Bounds = Literal["centre", "surface"]
BOUNDS = ("centre", "surface")
WEAKEST_FIELD = 1e-50  # rad/s: powers of the Larmor radius overflow in a weaker one, which bends nothing


@dataclass(frozen=True)
class Table:
    """A billiard table: a figure, made by :func:`table` or one of the functions of this package.

    ``bounds`` says what the given curve bounds: the ball's "centre", as in mathematics, or its "surface". With "surface" the
    centre keeps to the parallel curve, one radius inside.

    Examples
    --------
    >>> from carom import billiards
    >>> table = billiards.circle(2.0, bounds="surface")
    >>> print(table)
    circle (radius 2.0; boundary of the ball's surface)
    >>> table.shape(0.5).lengths / (2 * 3.141592653589793)
    array([1.5])
    """

    figure: Figure
    bounds: str = "centre"
    acceleration: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """Constant acceleration of the ball, m/s^2."""
    magnetic_field: float = 0.0
    """Cyclotron frequency in a field perpendicular to the plane, rad/s (:func:`in_magnetic_field`)."""
    name: str = ""
    """Its name in messages; default: its figure's."""

    def __post_init__(self) -> None:
        """Take the name of the figure where none is given."""
        object.__setattr__(self, "name", self.name or self.figure.kind())

    @property
    def dimension(self) -> int:
        """2: a disc in the plane, whose spin is a number. 3: a ball in space."""
        return self.figure.dimension

    @property
    def sizes(self) -> dict[str, Any]:
        """The sizes of its figure, an acceleration and a magnetic field."""
        g = self.acceleration[: self.dimension]
        field = {"magnetic_field": self.magnetic_field} if self.magnetic_field else {}
        return self.figure.sizes | ({"acceleration": list(g)} if any(g) else {}) | field

    @property
    def has_force(self) -> bool:
        """Whether a force acts on the ball between bounces."""
        return any(self.acceleration) or self.magnetic_field != 0.0

    @property
    def bends_flights(self) -> bool:
        """Whether flights are curved, seen along z."""
        return any(self.acceleration[:2]) or self.magnetic_field != 0.0

    def make(self, inset: float) -> Boundary:
        """Return the boundary of the centre's region, given the distance that the centre keeps from the wall, m."""
        return boundary_of(self.figure, inset, self.name)

    def shape(self, radius: float) -> Boundary:
        """Return the boundary of the region open to the centre of a ball of that radius."""
        return self.make(radius if self.bounds == "surface" else 0.0)

    def wall(self) -> Boundary:
        """Return the wall itself."""
        return self.make(0.0)

    def __str__(self) -> str:
        """Return its name and sizes in one line."""
        g = self.acceleration[: self.dimension]
        forces = [f"acceleration {list(g)}"] if any(g) else []
        forces += [f"magnetic field {self.magnetic_field:g}/s"] if self.magnetic_field else []
        sizes = ", ".join([*self.figure.phrases(), *forces])
        return f"{self.name} ({sizes}; boundary of the ball's {self.bounds})"


def table(
    what: str | Mapping[str, Any] | Figure | PathLike[str] | Table,
    *,
    bounds: Bounds | None = None,
    acceleration: Sequence[float] | None = None,
    magnetic_field: float | None = None,
    **sizes: Any,
) -> Table:
    """Return the table of any figure.

    Parameters
    ----------
    what : str, dict, Path, Figure or Table
        The figure, as :func:`carom.scene.figures.figure` takes it: a name, a text such as "stadium:straight=2,radius=1", a table of
        its fields, or a Path of a file.
    bounds : "centre" or "surface" of the ball; default: the centre
    acceleration : (x, y), in space (x, y, z), m/s^2, optional
        A constant acceleration, as of :func:`under`.
    magnetic_field : float, rad/s, optional
        A magnetic field, as of :func:`in_magnetic_field`.
    **sizes : optional
        Sizes of the figure, by their names.

    Returns
    -------
    Table. Raises CaromError, one line per problem.

    Examples
    --------
    >>> from carom import billiards
    >>> print(billiards.table("stadium:straight=3,radius=1", bounds="surface"))
    stadium (straight 3.0, radius 1.0; boundary of the ball's surface)
    """
    faults = FaultList()
    if isinstance(what, Table) and not sizes:
        made: Table | None = what if bounds is None else replace(what, bounds=bounds)
    else:
        region = faults.attempt(figure, what.figure if isinstance(what, Table) else what, **sizes)
        made = None if region is None else Table(region, bounds or "centre")
    faults.where = made.name if made is not None else "table"
    require_bounds(faults, bounds or "centre")
    faults.raise_if_any()
    assert made is not None
    made = made if acceleration is None else under(made, acceleration)
    return made if magnetic_field is None else in_magnetic_field(made, magnetic_field)


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
    circle (radius 1.0, acceleration [0.0, -9.81]; boundary of the ball's centre)
    """
    faults = FaultList("under")
    _require_table(faults, table)
    g = checked_acceleration(faults, acceleration, table.dimension)
    if any(g):
        _require_one_force(faults, "acceleration", replace(table, acceleration=(1.0, 0.0, 0.0)))
    faults.raise_if_any()
    return replace(table, acceleration=(g[0], g[1], g[2] if table.dimension == 3 else 0.0))


def in_magnetic_field(table: Table, magnetic_field: float) -> Table:
    """Return the table in a magnetic field perpendicular to its plane: a charged ball flies on arcs of circles.

    Parameters
    ----------
    table : Table
        In the plane, without an acceleration.
    magnetic_field : float
        The cyclotron frequency, rad/s: the angular velocity at which the velocity turns, counterclockwise where it is positive.
        The centre moves on circles of the Larmor radius, the speed over the frequency's size. It replaces the table's; 0: none,
        as is a field below 1e-50. The field does not change the spin.

    Returns
    -------
    Table

    Raises
    ------
    CaromError
        A table in space, one with an acceleration, a field that is not a finite number.

    Examples
    --------
    >>> from carom import billiards
    >>> table = billiards.in_magnetic_field(billiards.circle(), 2.0)
    >>> print(table)
    circle (radius 1.0, magnetic field 2/s; boundary of the ball's centre)
    >>> found = billiards.orbit(table, ((1.0, 0.0), (-1.0, 0.0), 0.0), bounces=1, law="mirror")
    >>> found.position.round(9)
    array([[ 0.6, -0.8]])
    """
    faults = FaultList("in_magnetic_field")
    _require_table(faults, table)
    field = checked_number(faults, "magnetic_field", magnetic_field, "a number", lambda x: abs(x) < MAX_MAGNITUDE)
    if np.ndim(field):
        faults.add("magnetic_field", "one number", f"{magnetic_field!r:.60}")
        faults.raise_if_any()
    if field:
        _require_one_force(faults, "magnetic_field", replace(table, magnetic_field=1.0))
    faults.raise_if_any()
    return replace(table, magnetic_field=float(field) if abs(field) > WEAKEST_FIELD else 0.0)


def checked_acceleration(faults: FaultList, value: Any, count: int = 1) -> tuple[float, ...]:
    """Return ``count`` components of an acceleration; add a fault for anything else."""
    try:
        array = np.atleast_1d(float_array(value))
    except (TypeError, ValueError):
        array = np.full(1, np.nan)
    if array.shape != (count,) or not np.isfinite(array).all():
        faults.add("acceleration", "a number" if count == 1 else f"{count} numbers", repr(value))
        return (0.0,) * count
    return tuple(float(x) for x in array)


def require_bounds(faults: FaultList, bounds: str) -> None:
    """Add a fault where ``bounds`` is neither "centre" nor "surface"."""
    if bounds not in BOUNDS:
        faults.add("bounds", "'centre' or 'surface'", f"{bounds!r}; {suggestion(str(bounds), list(BOUNDS))}")


def _require_table(faults: FaultList, table: Any) -> None:
    if not isinstance(table, Table):
        faults.add("table", "a table such as carom.billiards.circle()", f"{table!r:.60}")
        faults.raise_if_any()


def _require_one_force(faults: FaultList, field: str, table: Table) -> None:
    """Add a fault where a table has two forces, or a magnetic field in space."""
    if table.magnetic_field and table.dimension != 2:
        faults.add(field, "a magnetic field in a table in the plane only", f"{table.name}, in space")
    elif table.magnetic_field and any(table.acceleration):
        faults.add(field, "an acceleration or a magnetic field", "both")


# ----------------------------------------------------------------------------------------------------
# Tables of the package's figures by their sizes, one function each.


Circles = Sequence[Sequence[float]]

# --- in the plane --------------------------------------------------------------------------------------------------


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
    strip (width 2.0; boundary of the ball's centre)
    """
    return _along((1, 0, 0), acceleration, "strip", bounds, width=width)


def wedge(angle_deg: float, *, bounds: Bounds = "centre") -> Table:
    """Return a wedge: two walls from the origin, symmetric about the x axis.

    Parameters
    ----------
    angle_deg : float, between the walls, above 0 and below 180 degrees
    bounds : "centre" or "surface" of the ball

    Returns
    -------
    Table. Raises CaromError, one line per problem.

    Examples
    --------
    >>> from carom import billiards
    >>> print(billiards.wedge(60))
    wedge (angle 60.0; boundary of the ball's centre)
    """
    return table("wedge", bounds=bounds, angle=angle_deg)


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
    return replace(table("polygon", bounds=bounds, points=vertices), name=name)


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
    regular (sides 5, radius 1.0; boundary of the ball's centre)
    """
    return table("regular", bounds=bounds, sides=sides, radius=radius)


def rectangle(width: float = 2.0, height: float = 1.0, *, bounds: Bounds = "centre") -> Table:
    """Return a rectangle about the origin.

    Parameters
    ----------
    width, height : float, along x and along y, m
    bounds : "centre" or "surface" of the ball

    Returns
    -------
    Table. Raises CaromError, one line per problem.

    Examples
    --------
    >>> from carom import billiards
    >>> print(billiards.rectangle(2.0, 1.0))
    rectangle (size [2.0, 1.0]; boundary of the ball's centre)
    """
    return table("rectangle", bounds=bounds, size=(width, height))


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
    circle (radius 1.5; boundary of the ball's centre)
    """
    return table("circle", bounds=bounds, radius=radius)


def ellipse(major: float = 1.0, minor: float = 0.8, *, bounds: Bounds = "centre") -> Table:
    """Return the ellipse (x/major)^2 + (y/minor)^2 = 1.

    With bounds="surface" the centre moves within the parallel curve, not an ellipse but a smooth curve, in
    several pieces. A ball larger than the smallest radius of curvature does not reach the
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
    return table("ellipse", bounds=bounds, half_axes=(major, minor))


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
    return table("stadium", bounds=bounds, straight=straight, radius=radius)


# --- with round obstacles: in the open plane, and periodic ------------------------------------------------------------


def discs(obstacles: Circles | None = None, *, bounds: Bounds = "centre") -> Table:
    """Return round obstacles in the open plane: a ball that meets none flies away.

    Parameters
    ----------
    obstacles : sequence of (x, y, radius), m
        Default: three of radius 1/4 in a triangle with sides of 3/2.
    bounds : "centre" or "surface" of the ball

    Returns
    -------
    Table. Raises CaromError, one line per problem.

    Examples
    --------
    >>> from carom import billiards
    >>> print(billiards.discs([(0.0, 0.0, 1.0), (3.0, 0.0, 1.0)]))
    discs (obstacles [[0.0, 0.0, 1.0], [3.0, 0.0, 1.0]]; boundary of the ball's centre)
    """
    sizes: dict[str, Any] = {} if obstacles is None else {"obstacles": obstacles}
    return table("discs", bounds=bounds, **sizes)


# --- periodic, with round obstacles -----------------------------------------------------------------------------------


def torus(
    cell: Sequence[float] = (1.0, 1.0), scatterers: Circles = ((0.0, 0.0, 0.3),), *, bounds: Bounds = "centre"
) -> Table:
    """Return a periodic cell about the origin with circular obstacles.

    Parameters
    ----------
    cell : (width, height), m
    scatterers : sequence of (x, y, radius), m
    bounds : "centre" or "surface" of the ball

    Returns
    -------
    Table. Raises CaromError, one line per problem.

    Examples
    --------
    >>> from carom import billiards
    >>> print(billiards.torus((1.0, 1.0), [(0.0, 0.0, 0.4)]))
    torus (size [1.0, 1.0], obstacles [[0.0, 0.0, 0.4]], periodic ['x', 'y']; boundary of the ball's centre)
    """
    return replace(table("cell", bounds=bounds, size=cell, obstacles=scatterers), name="torus")


def sinai(radius: float = 0.3, side: float = 1.0, *, bounds: Bounds = "centre") -> Table:
    """Return Sinai's billiard: one circular obstacle in a square torus.

    Parameters
    ----------
    radius, side : float, of the obstacle and of the torus, m
    bounds : "centre" or "surface" of the ball

    Returns
    -------
    Table. Raises CaromError, one line per problem.

    Examples
    --------
    >>> from carom import billiards
    >>> print(billiards.sinai(0.3))
    sinai (radius 0.3, side 1.0; boundary of the ball's centre)
    """
    return table("sinai", bounds=bounds, radius=radius, side=side)


def periodic_strip(
    period: float = 1.0, width: float = 1.0, scatterers: Circles = ((0.0, 0.0, 0.2),), *, bounds: Bounds = "centre"
) -> Table:
    """Return a strip, periodic in x, with walls y = -width/2 and y = width/2 and circular obstacles in each period.

    Parameters
    ----------
    period, width : float, m
    scatterers : sequence of (x, y, radius), m
    bounds : "centre" or "surface" of the ball

    Returns
    -------
    Table. Raises CaromError, one line per problem.

    Examples
    --------
    >>> from carom import billiards
    >>> billiards.periodic_strip(2.0, 1.0).wall().cell
    (2.0, inf)
    """
    made = table("cell", bounds=bounds, size=(period, width), obstacles=scatterers, periodic=("x",))
    return replace(made, name="periodic strip")


# --- in space ------------------------------------------------------------------------------------------------------


def sphere(radius: float = 1.0, *, bounds: Bounds = "centre") -> Table:
    """Return a sphere about the origin.

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
    >>> print(billiards.sphere(2.0))
    sphere (radius 2.0; boundary of the ball's centre)
    """
    return table("sphere", bounds=bounds, radius=radius)


def plates(distance: float = 1.0, *, bounds: Bounds = "centre", acceleration: Sequence[float] = (0.0, 0.0)) -> Table:
    """Return two parallel plates y = -distance/2 and y = distance/2.

    Parameters
    ----------
    distance : float, m
    bounds : "centre" or "surface" of the ball
    acceleration : (x, z), along the plates, m/s^2

    Returns
    -------
    Table. Raises CaromError, one line per problem.

    Examples
    --------
    >>> from carom import billiards
    >>> print(billiards.plates(1.0, acceleration=(0.0, -9.81)))
    plates (distance 1.0, acceleration [0.0, 0.0, -9.81]; boundary of the ball's centre)
    """
    faults = FaultList("plates")
    g = checked_acceleration(faults, acceleration, 2)
    made: Table = faults.attempt(table, "plates", bounds=bounds, distance=distance)
    faults.raise_if_any()
    return replace(made, acceleration=(g[0], 0.0, g[1]))


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
    Table. Raises CaromError, one line per problem.

    Examples
    --------
    >>> from carom import billiards
    >>> print(billiards.cylinder(1.0, height=2.0, acceleration=-9.81))
    cylinder (radius 1.0, height 2.0, acceleration [0.0, 0.0, -9.81]; boundary of the ball's centre)
    """
    if isinstance(section, Table):
        over: dict[str, Any] = {"section": section.figure}
        if isinstance(section.figure, CircleFigure):
            over = {"radius": section.figure.radius}
        if section.magnetic_field:
            raise CaromError(Fault("cylinder", "section", "a table without a magnetic field", f"{section}"))
        x, y, _z = section.acceleration
        made = _along((0, 0, 1), acceleration, "cylinder", section.bounds, **over, height=height)
        return replace(made, acceleration=(x, y, made.acceleration[2]))
    return _along((0, 0, 1), acceleration, "cylinder", "centre", radius=section, height=height)


def box(size: Sequence[float] = (1.0, 1.0, 1.0), *, bounds: Bounds = "centre") -> Table:
    """Return a box about the origin.

    At an edge between a lid and a side, lid and side act one after the other.

    Parameters
    ----------
    size : (x, y, z), m
    bounds : "centre" or "surface" of the ball

    Returns
    -------
    Table. Raises CaromError, one line per problem.

    Examples
    --------
    >>> from carom import billiards
    >>> print(billiards.box((1.0, 2.0, 3.0)))
    box (size [1.0, 2.0, 3.0]; boundary of the ball's centre)
    """
    return table("box", bounds=bounds, size=size)


def _along(axis: tuple[int, int, int], acceleration: float, kind: str, bounds: Any, **sizes: Any) -> Table:
    """Return the table of a figure with an acceleration along an axis."""
    faults = FaultList(kind)
    (g,) = checked_acceleration(faults, acceleration)
    made: Table = faults.attempt(table, kind, bounds=bounds, **sizes)
    faults.raise_if_any()
    x, y, z = (g if one else 0.0 for one in axis)
    return replace(made, acceleration=(x, y, z))
