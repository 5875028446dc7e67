"""Squash: the drive-belt stadium."""

from __future__ import annotations

import math
from typing import ClassVar, Literal

from pydantic import model_validator

from carom.errors import Fault
from carom.scene.figures.figure import Loop, PlaneFigure, Sizes2
from carom.scene.figures.pieces import ArcPiece, SegmentPiece
from carom.scene.schema import Size, raise_faults

__all__ = ["SquashFigure"]


class SquashFigure(PlaneFigure):
    """A squash: two circles of different radii with their common tangents, the belt of a drive; of equal radii it is a stadium.

    Source: L. A. Bunimovich, Commun. Math. Phys. 65, 295 (1979), https://doi.org/10.1007/BF01197884.

    Parameters
    ----------
    radii : 2 lengths, m: of the left circle, of the right one
    distance : m: of their centres on the x axis, above the difference of the radii
    """

    usual: ClassVar = {"radii": (1.0, 0.5), "distance": 1.5}
    shape: Literal["squash"] = "squash"
    radii: Sizes2
    distance: Size

    @model_validator(mode="after")
    def _apart(self) -> SquashFigure:
        least = abs(self.radii[0] - self.radii[1])
        if self.distance <= least:
            raise_faults(
                [Fault("", "distance", f"a length above the difference of the radii, {least:g}", f"{self.distance:g}")]
            )
        return self

    def outline(self) -> list[Loop]:
        """Return the lower side, the right end, the upper side, the left end."""
        (a, b), half = self.radii, self.distance / 2
        angle = math.acos((a - b) / self.distance)
        cos, sin, turn = math.cos(angle), math.sin(angle), math.degrees(angle)
        return [
            [
                SegmentPiece((-half + a * cos, -a * sin), (half + b * cos, -b * sin)),
                ArcPiece((half, 0.0), b, -turn, turn),
                SegmentPiece((half + b * cos, b * sin), (-half + a * cos, a * sin)),
                ArcPiece((-half, 0.0), a, turn, 360.0 - turn),
            ]
        ]
