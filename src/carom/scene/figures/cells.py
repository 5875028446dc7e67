"""Round obstacles in the open plane and in periodic cells: discs, Sinai's billiard, a periodic strip, any cell."""

from __future__ import annotations

import math
from itertools import combinations
from typing import Annotated, ClassVar, Literal

from pydantic import BeforeValidator, model_validator

from carom.errors import Fault
from carom.scene.figures.figure import CellFigure, Circle, Figure, Sizes2
from carom.scene.schema import Components, Length, Place, Size, raise_faults

Obstacles = tuple[
    Annotated[tuple[Length, Length, Size], BeforeValidator(Components("x, y, radius: 3 lengths in m", (3,)))], ...
]


class DiscsFigure(Figure):
    """Round obstacles in the open plane, apart from each other: a ball that meets none flies away.

    Parameters
    ----------
    obstacles : one or more times x, y, radius, m
    """

    usual: ClassVar = {"obstacles": ((0.0, 0.866, 0.25), (-0.75, -0.433, 0.25), (0.75, -0.433, 0.25))}
    shape: Literal["discs"] = "discs"
    obstacles: Obstacles

    @model_validator(mode="after")
    def _apart(self) -> DiscsFigure:
        faults = [] if self.obstacles else [Fault("", "obstacles", "one or more of x, y, radius", "none")]
        for (i, (x, y, r)), (k, (u, v, q)) in combinations(enumerate(self.obstacles), 2):
            if math.hypot(x - u, y - v) <= r + q:
                faults.append(
                    Fault("", "obstacles", "obstacles apart from each other", f"{i + 1} and {k + 1} that touch")
                )
        raise_faults(faults)
        return self


class SinaiFigure(CellFigure):
    """Sinai's billiard: a round obstacle in the middle of a square that is periodic in x and y.

    Parameters
    ----------
    radius : m: of the obstacle
    side : m: of the square
    """

    usual: ClassVar = {"radius": 0.3, "side": 1.0}
    shape: Literal["sinai"] = "sinai"
    radius: Size
    side: Size

    @property
    def sides(self) -> Place:
        """Its lengths along x and y, m."""
        return self.side, self.side

    @property
    def circles(self) -> tuple[Circle, ...]:
        """Its obstacle: x, y, radius, m."""
        return ((0.0, 0.0, self.radius),)


class PeriodicStripFigure(CellFigure):
    """A strip that is periodic in x, with walls y = -width/2 and y = width/2 and a round obstacle in the middle of each period.

    Parameters
    ----------
    period, width : m
    radius : m: of the obstacle
    """

    usual: ClassVar = {"period": 1.0, "width": 1.0, "radius": 0.2}
    shape: Literal["periodic-strip"] = "periodic-strip"
    period: Size
    width: Size
    radius: Size

    @property
    def sides(self) -> Place:
        """Its lengths along x and y, m."""
        return self.period, self.width

    @property
    def circles(self) -> tuple[Circle, ...]:
        """Its obstacle: x, y, radius, m."""
        return ((0.0, 0.0, self.radius),)

    @property
    def along(self) -> tuple[bool, bool]:
        """It is periodic in x, with walls in y."""
        return True, False


class PeriodicCellFigure(CellFigure):
    """A rectangle about the origin that is periodic in x, and in y or between two walls, with round obstacles.

    Parameters
    ----------
    size : 2 lengths, m: along x, along y
    obstacles : one or more times x, y, radius, m; the centres lie in the rectangle
    periodic : the axes, ("x", "y") or ("x",); default: both
    """

    usual: ClassVar = {"size": (1.0, 1.0), "obstacles": ((0.0, 0.0, 0.3),)}
    shape: Literal["cell"] = "cell"
    size: Sizes2
    obstacles: Obstacles
    periodic: tuple[Literal["x", "y"], ...] = ("x", "y")

    @model_validator(mode="after")
    def _sound(self) -> PeriodicCellFigure:
        faults = []
        (w, h) = (self.size[0] / 2, self.size[1] / 2)
        if not self.obstacles:
            faults.append(Fault("", "obstacles", "one or more of x, y, radius", "none"))
        if any(abs(x) > w or abs(y) > h for x, y, _r in self.obstacles):
            expected = f"centres within the cell, |x| <= {w:.6g} and |y| <= {h:.6g}"
            faults.append(Fault("", "obstacles", expected, repr([list(one) for one in self.obstacles])))
        if set(self.periodic) not in ({"x"}, {"x", "y"}):
            faults.append(Fault("", "periodic", '["x", "y"] or ["x"]', repr(list(self.periodic))))
        raise_faults(faults)
        return self

    @property
    def sides(self) -> Place:
        """Its lengths along x and y, m."""
        return self.size

    @property
    def circles(self) -> tuple[Circle, ...]:
        """Its obstacles: x, y, radius, m."""
        return self.obstacles

    @property
    def along(self) -> tuple[bool, bool]:
        """Whether it is periodic in x, and in y."""
        return True, "y" in self.periodic
