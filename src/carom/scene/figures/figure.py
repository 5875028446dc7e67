"""Figures: regions in the plane or in space by name and sizes; scenes, gases and billiards make their records from them."""

from __future__ import annotations

import math
from abc import abstractmethod
from collections.abc import Mapping
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from carom.scene.figures.pieces import Piece
from carom.scene.schema import Model

__all__ = ["Cell", "Figure", "PlaneFigure", "Solid"]

Array = NDArray[np.float64]
Loop = list[Piece]


class Figure(Model):
    """A figure: its fields are its sizes, with units. Each kind is one class, in a file of :mod:`carom.scene.figures`.

    Raises CaromError, one line per problem.

    Examples
    --------
    >>> from carom.scene.figures import FIGURES
    >>> FIGURES["stadium"](straight=2, radius="50 cm").describe()
    'stadium (straight 2.0, radius 0.5)'
    """

    tag: ClassVar[str] = "shape"
    dimension: ClassVar[int] = 2
    """2: in the plane, 3: in space."""
    usual: ClassVar[dict[str, Any]] = {}
    """Sizes of about 1 m, for who names it alone."""

    @classmethod
    def kind(cls) -> str:
        """Return its name."""
        return str(cls.model_fields["shape"].default)

    @property
    def sizes(self) -> dict[str, Any]:
        """Its fields but its name, as plain data; what is not given is left out."""
        found = self.model_dump(exclude_none=True, exclude={"shape"})
        return {name: _plain(value) for name, value in found.items()}

    def describe(self) -> str:
        """Return its name and its sizes in one line."""
        sizes = ", ".join(f"{name} {value}" for name, value in self.sizes.items())
        return f"{self.kind()} ({sizes})"


def _plain(value: Any) -> Any:
    if isinstance(value, Mapping):
        return {name: _plain(one) for name, one in value.items()}
    return [_plain(one) for one in value] if isinstance(value, tuple) else value


class PlaneFigure(Figure):
    """A figure in the plane, about the origin: closed loops of pieces, with the open side on their left.

    To make your own, derive a class with a ``shape``, its sizes and :meth:`outline`, in a file of this package.
    """

    @abstractmethod
    def outline(self) -> list[Loop]:
        """Return the loops of its boundary: the first is the outside, counterclockwise; others are obstacles in it, clockwise."""

    @property
    def area(self) -> float:
        """Its area, m^2."""
        return sum(_area_of(piece) for loop in self.outline() for piece in loop)

    @property
    def length(self) -> float:
        """The length of its boundary, m."""
        return sum(piece.length for loop in self.outline() for piece in loop)


def _area_of(piece: Piece) -> float:
    """Return half the integral of x dy - y dx along a piece."""
    nodes, weights = np.polynomial.legendre.leggauss(16)
    t = np.linspace(*piece.span(), 65)
    half = (t[1] - t[0]) / 2
    x, d, _dd = piece.at(((t[:-1] + half)[:, None] + half * nodes).ravel())
    rate = (x[:, 0] * d[:, 1] - x[:, 1] * d[:, 0]).reshape(-1, len(nodes))
    return math.fsum((rate @ weights * half / 2).tolist())


class Cell(Figure):
    """A rectangle about the origin that is periodic along some axes, with round obstacles."""


class Solid(Figure):
    """A figure in space."""

    dimension: ClassVar[int] = 3
