"""Lemon billiards."""

from __future__ import annotations

import math
from typing import ClassVar, Literal

from pydantic import model_validator

from carom.errors import Fault
from carom.scene.figures.figure import Loop, PlaneFigure
from carom.scene.figures.pieces import ArcPiece
from carom.scene.schema import Size, raise_faults

__all__ = ["LemonFigure"]


class LemonFigure(PlaneFigure):
    """A lemon: what two discs have in common; its corners lie on the y axis.

    Source: E. J. Heller and S. Tomsovic, Phys. Today 46 (7), 38 (1993), https://doi.org/10.1063/1.881358.

    Parameters
    ----------
    radius : m: of both circles
    distance : m: of their centres, below 2 radii
    """

    usual: ClassVar = {"radius": 1.0, "distance": 1.0}
    shape: Literal["lemon"] = "lemon"
    radius: Size
    distance: Size

    @model_validator(mode="after")
    def _meet(self) -> LemonFigure:
        if self.distance >= 2 * self.radius:
            raise_faults([Fault("", "distance", f"a length below 2 radii, {2 * self.radius:g}", f"{self.distance:g}")])
        return self

    def outline(self) -> list[Loop]:
        """Return the right arc and the left one."""
        half, angle = self.distance / 2, math.degrees(math.acos(self.distance / 2 / self.radius))
        return [
            [
                ArcPiece((-half, 0.0), self.radius, -angle, angle),
                ArcPiece((half, 0.0), self.radius, 180.0 - angle, 180.0 + angle),
            ]
        ]
