"""Sector of a circle."""

from __future__ import annotations

import math
from typing import ClassVar, Literal

from pydantic import model_validator

from carom.errors import Fault
from carom.scene.figures.figure import Loop, PlaneFigure
from carom.scene.figures.pieces import ArcPiece, SegmentPiece
from carom.scene.schema import Angle, Size, raise_faults

__all__ = ["SectorFigure"]


class SectorFigure(PlaneFigure):
    """A sector of a circle: two sides from the origin, symmetric about the y axis, up to an arc about the origin.

    Parameters
    ----------
    opening : degrees, above 0 and below 180: the angle between the sides
    radius : m
    """

    usual: ClassVar = {"opening": 60.0, "radius": 1.0}
    shape: Literal["sector"] = "sector"
    opening: Angle
    radius: Size

    @model_validator(mode="after")
    def _opens(self) -> SectorFigure:
        if not 0 < self.opening < 180:
            raise_faults([Fault("", "opening", "degrees > 0 and < 180", f"{self.opening:g}")])
        return self

    def outline(self) -> list[Loop]:
        """Return the left side, the right side, the arc."""
        half = math.radians(self.opening) / 2
        x, y = self.radius * math.sin(half), self.radius * math.cos(half)
        arc = ArcPiece((0.0, 0.0), self.radius, 90 - self.opening / 2, 90 + self.opening / 2)
        return [[SegmentPiece((-x, y), (0.0, 0.0)), SegmentPiece((0.0, 0.0), (x, y)), arc]]

    def piece_names(self) -> list[str]:
        """Return the names of the pieces."""
        return ["left", "right", "side"]

    @property
    def area(self) -> float:
        """Its area, m^2."""
        return math.radians(self.opening) * self.radius * self.radius / 2
