"""Polygons: by their points, regular ones, rectangles."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Annotated, ClassVar, Literal

import numpy as np
from pydantic import BeforeValidator, model_validator

from carom.core.geometry.polygon import outline_faults
from carom.errors import Fault
from carom.scene.figures.figure import Loop, PlaneFigure, Sizes2
from carom.scene.figures.pieces import SegmentPiece
from carom.scene.schema import Components, Place, Size, Whole, raise_faults

__all__ = ["PolygonFigure", "RectangleFigure", "RegularFigure", "sides_through"]

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
