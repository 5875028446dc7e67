"""Flowers."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

from pydantic import BeforeValidator, Field

from carom.core.jets import call
from carom.scene.figures.curve import PolarPiece
from carom.scene.figures.figure import Loop, PlaneFigure
from carom.scene.schema import Number, Size, Whole

__all__ = ["FlowerFigure"]


class FlowerFigure(PlaneFigure):
    """A flower r = radius (1 + eps cos(leaves theta)); with inflections beyond eps = 1/(1 + leaves^2).

    Parameters
    ----------
    leaves : number of leaves, from 1 to 50
    eps : from 0 to below 1
    radius : m
    """

    usual: ClassVar = {"leaves": 5, "eps": 0.2, "radius": 1.0}
    shape: Literal["flower"] = "flower"
    leaves: Annotated[int, BeforeValidator(Whole("a whole number from 1 to 50", 1)), Field(le=50)]
    eps: Annotated[float, BeforeValidator(Number("a number from 0 to below 1", least=0, most=0.999))]
    radius: Size

    def outline(self) -> list[Loop]:
        """Return the whole curve."""
        a, eps, n = self.radius, self.eps, float(self.leaves)
        return [[PolarPiece(lambda t: a * (1.0 + eps * call("cos", n * t)))]]
