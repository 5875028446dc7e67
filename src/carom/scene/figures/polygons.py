"""Polygons: by their points, regular ones, rectangles."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Annotated, Any, ClassVar, Literal

import numpy as np
from pydantic import BeforeValidator, model_validator

from carom.core.geometry.outlines import outline_faults
from carom.errors import Fault
from carom.scene.figures.figure import Loop, Piece, PlaneFigure, SegmentPiece, Sizes2
from carom.scene.schema import Components, Place, Size, Whole, raise_faults, refused

Sides = Annotated[int, BeforeValidator(Whole("a whole number from 3 to 10000", 3))]


def sides_through(points: Sequence[tuple[float, float]]) -> list[Loop]:
    """Return the loop of straight sides through points, and back to the first one."""
    return [[SegmentPiece(one, two) for one, two in zip(points, (*points[1:], points[0]), strict=True)]]


class PolygonFigure(PlaneFigure):
    """A polygon; it need not be convex, but must not meet itself.

    Parameters
    ----------
    points : 3 or more times 2 lengths, m: its corners in order
    """

    shape: Literal["polygon"] = "polygon"
    points: Annotated[tuple[Place, ...], BeforeValidator(Components("3 or more points (x, y)", range(3, 1_000_000)))]

    @model_validator(mode="after")
    def _simple(self) -> PolygonFigure:
        raise_faults(Fault("", "points", expected, got) for expected, got in outline_faults(np.array(self.points)))
        return self

    @property
    def clockwise(self) -> bool:
        """Whether the points go clockwise."""
        x, y = np.transpose(np.subtract(self.points, self.points[0]))
        return bool(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)) < 0)

    def outline(self) -> list[Loop]:
        """Return its sides, counterclockwise, in the order of the points; backwards where these go clockwise."""
        return sides_through(self.points[::-1] if self.clockwise else self.points)

    def piece_names(self) -> list[str]:
        """Return the names of the sides: edge1 goes from the first point to the second, whichever way round they are given."""
        count, back = len(self.points), self.clockwise
        return [f"edge{(count - 2 - k) % count + 1 if back else k + 1}" for k in range(count)]


class RegularFigure(PlaneFigure):
    """A regular polygon about the origin; its lowest side is horizontal.

    Parameters
    ----------
    sides : number of sides, at most 10,000
    radius : m: of the circle through its corners
    """

    usual: ClassVar = {"sides": 3, "radius": 1.0}
    shape: Literal["regular"] = "regular"
    sides: Sides
    radius: Size

    @model_validator(mode="after")
    def _few(self) -> RegularFigure:
        if self.sides > 10_000:
            raise_faults([Fault("", "sides", "a whole number from 3 to 10000", str(self.sides))])
        return self

    def outline(self) -> list[Loop]:
        """Return its sides."""
        angle = -math.pi / 2 + math.pi / self.sides * (2 * np.arange(self.sides) - 1)
        corners = self.radius * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
        return sides_through([(float(x), float(y)) for x, y in corners])


class RectangleFigure(PlaneFigure):
    """A rectangle about the origin.

    Parameters
    ----------
    size : 2 lengths, m: along x, along y
    """

    usual: ClassVar = {"size": (2.0, 1.0)}
    shape: Literal["rectangle"] = "rectangle"
    size: Sizes2

    def outline(self) -> list[Loop]:
        """Return its sides, the lower one first."""
        x, y = self.size[0] / 2, self.size[1] / 2
        return sides_through([(-x, -y), (x, -y), (x, y), (-x, y)])

    def piece_names(self) -> list[str]:
        """Return the names of the sides."""
        return ["front", "right", "back", "left"]


# ----------------------------------------------------------------------------------------------------
# Tokarsky's room, in which a candle leaves a point dark.


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


# ----------------------------------------------------------------------------------------------------
# A figure by its pieces, for programs.


def _loops(value: Any) -> tuple[tuple[Piece, ...], ...]:
    try:
        found = tuple(tuple(loop) for loop in value)
    except TypeError:
        found = ()
    if not found or not all(loop and all(isinstance(piece, Piece) for piece in loop) for loop in found):
        raise refused("loops of pieces, each a list of Piece", f"{value!r:.60}")
    return found


class OutlineFigure(PlaneFigure):
    """A figure by its pieces: closed loops, each piece with the open side on its left.

    Parameters
    ----------
    loops : lists of Piece: the outside, counterclockwise, and obstacles in it, clockwise

    Examples
    --------
    >>> from carom import billiards
    >>> from carom.scene.figures import ArcPiece, OutlineFigure, SegmentPiece
    >>> half = OutlineFigure(loops=[[ArcPiece((0, 0), 1.0, 0.0, 180.0), SegmentPiece((-1, 0), (1, 0))]])
    >>> round(half.area, 6), round(float(billiards.table(half).wall().lengths.sum()), 6)
    (1.570796, 5.141593)
    """

    tag: ClassVar[str] = ""
    loops: Annotated[tuple[tuple[Any, ...], ...], BeforeValidator(_loops)]

    @classmethod
    def kind(cls) -> str:
        """Return its name in messages."""
        return "outline"

    def phrases(self) -> list[str]:
        """Return the number of its pieces."""
        return [f"{sum(map(len, self.loops))} pieces"]

    def outline(self) -> list[Loop]:
        """Return its pieces."""
        return [list(loop) for loop in self.loops]
