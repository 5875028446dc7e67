"""Figures: regions in the plane or in space by name and sizes; scenes, gases and billiards make their records from them."""

from __future__ import annotations

import inspect
import math
from abc import abstractmethod
from collections.abc import Mapping
from typing import Annotated, Any, ClassVar

import numpy as np
from numpy.typing import NDArray
from pydantic import BeforeValidator

from carom.scene.figures.pieces import Piece
from carom.scene.schema import Components, Model, Place, Size

__all__ = ["FIGURES", "CellFigure", "Circle", "Figure", "Loop", "PlaneFigure", "Sizes2"]

Array = NDArray[np.float64]
Loop = list[Piece]
Sizes2 = Annotated[tuple[Size, Size], BeforeValidator(Components("2 lengths in m, > 0: along x, y", (2,)))]
Circle = tuple[float, float, float]

FIGURES: dict[str, type[Figure]] = {}
"""All figures by name; a class enters it when it is made."""


class Figure(Model):
    """A figure: its fields are its sizes, with units. Each kind is one class, in a file of :mod:`carom.scene.figures`.

    Raises CaromError, one line per problem.

    Examples
    --------
    >>> from carom.scene.figures import figure
    >>> figure("stadium:straight=2,radius=50 cm").describe()
    'stadium (straight 2.0, radius 0.5)'
    """

    tag: ClassVar[str] = "shape"
    dimension: ClassVar[int] = 2
    """2: in the plane, 3: in space."""
    usual: ClassVar[dict[str, Any]] = {}
    """Sizes of about 1 m, for who gives none."""

    @classmethod
    def __pydantic_init_subclass__(cls, **_options: Any) -> None:
        """Enter it among all figures."""
        # (a wall of a scene derives from its figure, and is none itself)
        if "shape" in inspect.get_annotations(cls):  # (its own; from Python 3.14 on they are made when asked for)
            FIGURES[cls.kind()] = cls

    @classmethod
    def kind(cls) -> str:
        """Return its name."""
        return str(cls.model_fields["shape"].default)

    @property
    def sizes(self) -> dict[str, Any]:
        """Its fields but its name, as plain data; what is not given is left out."""
        return {name: plain for name, value in self if name != "shape" and (plain := _plain(value)) is not None}

    def describe(self) -> str:
        """Return its name and its sizes in one line."""
        return f"{self.kind()} ({', '.join(self.phrases())})"

    def phrases(self) -> list[str]:
        """Return its sizes in words; a figure among them by its own."""
        found = []
        for name, value in self:
            plain = _plain(value)
            if isinstance(value, Figure):
                found += [f"{name} {value.kind()}", *value.phrases()]
            elif name != "shape" and plain is not None:
                found.append(f"{name} {plain}")
        return found


def _plain(value: Any) -> Any:
    if isinstance(value, Figure):
        return {"shape": value.kind(), **value.sizes}
    if isinstance(value, Mapping):
        return {name: _plain(one) for name, one in value.items()}
    if callable(value):
        return str(getattr(value, "__name__", value))
    return [_plain(one) for one in value] if isinstance(value, tuple) else value


class PlaneFigure(Figure):
    """A figure in the plane, about the origin: closed loops of pieces, with the open side on their left.

    To make your own, derive a class with a ``shape``, its sizes and :meth:`outline`, in a file of this package.
    """

    @abstractmethod
    def outline(self) -> list[Loop]:
        """Return the loops of its boundary: the first is the outside, counterclockwise; others are obstacles in it, clockwise."""

    def piece_names(self) -> list[str]:
        """Return the names of the pieces of its outer loop, as of a gas's walls: edge1, edge2, ... unless it has its own."""
        return [f"edge{k + 1}" for k in range(len(self.outline()[0]))]

    @property
    def area(self) -> float:
        """Its area, m^2."""
        return math.fsum(_area_of(piece) for loop in self.outline() for piece in loop)

    @property
    def length(self) -> float:
        """The length of its boundary, m."""
        return math.fsum(piece.length for loop in self.outline() for piece in loop)


def _area_of(piece: Piece) -> float:
    """Return half the integral of x dy - y dx along a piece."""
    nodes, weights = np.polynomial.legendre.leggauss(16)
    t = np.linspace(*piece.span(), 65)
    half = (t[1] - t[0]) / 2
    x, d, _dd = piece.at(((t[:-1] + half)[:, None] + half * nodes).ravel())
    rate = (x[:, 0] * d[:, 1] - x[:, 1] * d[:, 0]).reshape(-1, len(nodes))
    return math.fsum((rate @ weights * half / 2).tolist())


class CellFigure(Figure):
    """A rectangle about the origin that is periodic in x, and in y or between two walls, with round obstacles."""

    @property
    @abstractmethod
    def sides(self) -> Place:
        """Its lengths along x and y, m."""

    @property
    @abstractmethod
    def circles(self) -> tuple[Circle, ...]:
        """Its obstacles: x, y, radius, m."""

    @property
    def along(self) -> tuple[bool, bool]:
        """Whether it is periodic in x, and in y."""
        return True, True
