"""Billiard tables: a figure, whether it bounds the centre or the surface of the ball, and an acceleration."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from os import PathLike
from typing import Any

from carom.billiards.boundary import Boundary
from carom.billiards.checks import Bounds, checked_acceleration, require_bounds
from carom.billiards.figure_boundaries import boundary_of
from carom.errors import FaultList
from carom.scene.figures import Figure, figure

__all__ = ["Table", "table", "under"]


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
        """The sizes of its figure, and an acceleration."""
        g = self.acceleration[: self.dimension]
        return self.figure.sizes | ({"acceleration": list(g)} if any(g) else {})

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
        sizes = ", ".join([*self.figure.phrases(), *([f"acceleration {list(g)}"] if any(g) else [])])
        return f"{self.name} ({sizes}; bounds the {self.bounds})"


def table(
    what: str | Mapping[str, Any] | Figure | PathLike[str] | Table,
    *,
    bounds: Bounds | None = None,
    acceleration: Sequence[float] | None = None,
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
    return made if acceleration is None else under(made, acceleration)


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
    return replace(table, acceleration=(g[0], g[1], g[2] if table.dimension == 3 else 0.0))
