"""Billiard tables: a figure, whether it bounds the centre or the surface of the ball, and a force."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from os import PathLike
from typing import Any

import numpy as np

from carom.billiards.boundary import Boundary
from carom.billiards.checks import Bounds, checked_acceleration, require_bounds
from carom.billiards.figure_boundaries import boundary_of
from carom.errors import MAX_MAGNITUDE, FaultList, checked_number
from carom.scene.figures import Figure, figure

__all__ = ["Table", "in_magnetic_field", "table", "under"]

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
    circle (radius 2.0; bounds the surface)
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
        return f"{self.name} ({sizes}; bounds the {self.bounds})"


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
    stadium (straight 3.0, radius 1.0; bounds the surface)
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
    circle (radius 1.0, acceleration [0.0, -9.81]; bounds the centre)
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
    circle (radius 1.0, magnetic field 2/s; bounds the centre)
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
