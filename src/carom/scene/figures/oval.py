"""Berry's and Benettin and Strelcyn's ovals."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

from pydantic import BeforeValidator

from carom.core.jets import call
from carom.scene.figures.curve import PolarPiece
from carom.scene.figures.figure import Loop, PlaneFigure
from carom.scene.schema import Number, Size

__all__ = ["OvalFigure"]


class OvalFigure(PlaneFigure):
    """An oval r = radius (1 + eps cos 2 theta): convex up to eps = 1/5, and with a neck beyond.

    Below 1/5 orbits along the wall stay there: there are rotational invariant curves. Beyond there are none.
    Source: M. V. Berry, Eur. J. Phys. 2, 91 (1981), https://doi.org/10.1088/0143-0807/2/2/006.

    Parameters
    ----------
    eps : from 0 to below 1
    radius : m
    """

    usual: ClassVar = {"eps": 0.1, "radius": 1.0}
    shape: Literal["oval"] = "oval"
    eps: Annotated[float, BeforeValidator(Number("a number from 0 to below 1", least=0, most=0.999))]
    radius: Size

    def outline(self) -> list[Loop]:
        """Return the whole curve."""
        a, eps = self.radius, self.eps
        return [[PolarPiece(lambda t: a * (1.0 + eps * call("cos", 2.0 * t)))]]
