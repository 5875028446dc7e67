"""Bunimovich's stadium."""

from __future__ import annotations

import math
from typing import ClassVar, Literal

from carom.scene.figures.figure import Loop, PlaneFigure
from carom.scene.figures.pieces import ArcPiece, SegmentPiece
from carom.scene.schema import Model, Size

__all__ = ["StadiumFigure", "StadiumSizes"]


class StadiumSizes(Model):
    """The sizes of a stadium, as a figure and as a wall."""

    shape: Literal["stadium"] = "stadium"
    straight: Size
    radius: Size


class StadiumFigure(StadiumSizes, PlaneFigure):
    """A stadium: two straight sides along x, joined by half circles.

    Source: L. A. Bunimovich, Commun. Math. Phys. 65, 295 (1979), https://doi.org/10.1007/BF01197884.

    Parameters
    ----------
    straight : m: length of the straight sides
    radius : m: of the half circles
    """

    usual: ClassVar = {"straight": 2.0, "radius": 1.0}
    shape: Literal["stadium"] = "stadium"

    def outline(self) -> list[Loop]:
        """Return the lower side, the right end, the upper side, the left end."""
        x, r = self.straight / 2, self.radius
        return [
            [
                SegmentPiece((-x, -r), (x, -r)),
                ArcPiece((x, 0.0), r, -90.0, 90.0),
                SegmentPiece((x, r), (-x, r)),
                ArcPiece((-x, 0.0), r, 90.0, 270.0),
            ]
        ]

    def piece_names(self) -> list[str]:
        """Return the names of the pieces."""
        return ["front", "right", "back", "left"]

    @property
    def area(self) -> float:
        """Its area, m^2."""
        return self.straight * (2 * self.radius) + math.pi * self.radius * self.radius
