"""Tokarsky's room, in which a candle leaves a point dark."""

from __future__ import annotations

from typing import ClassVar, Literal

from carom.scene.figures.figure import Loop, PlaneFigure
from carom.scene.figures.polygons import sides_through
from carom.scene.schema import Place, Size

__all__ = ["TokarskyFigure"]

# In squares of a grid, from the left; the interior on the left. As N. Berglund draws the room
# (https://github.com/nilsberglund-orleans/YouTube-simulations).
CORNERS = (
    (0, 2), (1, 2), (1, 1), (2, 1), (2, 0), (3, 1), (4, 1), (4, 0), (5, 1), (6, 1), (6, 0), (7, 1), (7, 2), (8, 2), (8, 3), (7, 3),
    (6, 4), (6, 3), (5, 3), (5, 2), (3, 2), (3, 3), (2, 3), (2, 4), (1, 4), (1, 3),
)  # fmt: skip


class TokarskyFigure(PlaneFigure):
    """Tokarsky's room of 26 sides: no flight with mirror reflections leads from one of two places in it to the other.

    All walls lie on mirrors of the tiling of the plane by triangles of 45, 45 and 90 degrees: x, y, x + y or x - y is a
    whole number of squares, of the latter two an even one. So reflections take places with two even coordinates to such places.
    A straight line from one of them to another passes a grid point with an odd coordinate first, half-way or before; and
    all grid points of the room with an odd coordinate are corners of it, where a flight ends.

    Source: G. W. Tokarsky, Am. Math. Monthly 102, 867 (1995), https://doi.org/10.2307/2975263.

    Parameters
    ----------
    side : m: of the squares of the grid on which its corners lie; the room is 8 of them long
    """

    usual: ClassVar = {"side": 0.25}
    shape: Literal["tokarsky"] = "tokarsky"
    side: Size

    def outline(self) -> list[Loop]:
        """Return its sides."""
        return sides_through([self._place(*one) for one in CORNERS])

    @property
    def dark_pair(self) -> tuple[Place, Place]:
        """The two places, m, of which one is dark when a candle is in the other."""
        return self._place(2, 2), self._place(6, 2)

    def _place(self, x: float, y: float) -> Place:
        return self.side * (x - 4), self.side * (y - 2)
