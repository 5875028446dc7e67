"""Circle."""

from __future__ import annotations

import math
from typing import ClassVar, Literal

from carom.scene.figures.figure import Loop, PlaneFigure
from carom.scene.figures.pieces import ArcPiece
from carom.scene.schema import Size

__all__ = ["CircleFigure"]


class CircleFigure(PlaneFigure):
    """A circle about the origin.

    Parameters
    ----------
    radius : m
    """

    usual: ClassVar = {"radius": 1.0}
    shape: Literal["circle"] = "circle"
    radius: Size

    def outline(self) -> list[Loop]:
        """Return one arc."""
        return [[ArcPiece((0.0, 0.0), self.radius, 0.0, 360.0)]]

    def piece_names(self) -> list[str]:
        """Return the names of the pieces."""
        return ["side"]

    @property
    def area(self) -> float:
        """Its area, m^2."""
        return math.pi * self.radius * self.radius
