"""Pascal's limacon, Robnik's billiard."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

from pydantic import BeforeValidator

from carom.core.jets import call
from carom.scene.figures.curve import PolarPiece
from carom.scene.figures.figure import Loop, PlaneFigure
from carom.scene.schema import Number, Size

__all__ = ["LimaconFigure"]


class LimaconFigure(PlaneFigure):
    """A limacon r = radius (1 + eps cos theta): a circle for eps = 0, convex up to 1/2, a cardioid with its cusp for 1.

    Source: M. Robnik, J. Phys. A 16, 3971 (1983), https://doi.org/10.1088/0305-4470/16/17/014.

    Parameters
    ----------
    eps : from 0 to below 1
    radius : m
    """

    usual: ClassVar = {"eps": 0.3, "radius": 1.0}
    shape: Literal["limacon"] = "limacon"
    eps: Annotated[float, BeforeValidator(Number("a number from 0 to below 1", least=0, most=0.999))]
    radius: Size

    def outline(self) -> list[Loop]:
        """Return the whole curve."""
        a, eps = self.radius, self.eps
        return [[PolarPiece(lambda t: a * (1.0 + eps * call("cos", t)))]]
