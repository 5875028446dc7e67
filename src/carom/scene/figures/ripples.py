"""Circles with ripples, r = radius (1 + eps cos(leaves theta)): limacon, oval, flower."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

from pydantic import BeforeValidator, Field

from carom.core.jets import call
from carom.scene.figures.curve import PolarPiece
from carom.scene.figures.figure import Loop, PlaneFigure
from carom.scene.schema import Number, Size, Whole

__all__ = ["FlowerFigure", "LimaconFigure", "OvalFigure"]

Eps = Annotated[float, BeforeValidator(Number("a number from 0 to below 1", least=0, most=0.999))]


def _ripples(radius: float, eps: float, leaves: float) -> list[Loop]:
    """Return the whole curve."""
    return [[PolarPiece(lambda t: radius * (1.0 + eps * call("cos", leaves * t)))]]


class LimaconFigure(PlaneFigure):
    """A limacon r = radius (1 + eps cos theta): a circle for eps = 0, convex up to 1/2, a cardioid with its cusp for 1.

    Pascal's curve, Robnik's billiard. Source: M. Robnik, J. Phys. A 16, 3971 (1983), https://doi.org/10.1088/0305-4470/16/17/014.

    Parameters
    ----------
    eps : from 0 to below 1
    radius : m
    """

    usual: ClassVar = {"eps": 0.3, "radius": 1.0}
    shape: Literal["limacon"] = "limacon"
    eps: Eps
    radius: Size

    def outline(self) -> list[Loop]:
        """Return the whole curve."""
        return _ripples(self.radius, self.eps, 1.0)


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
    eps: Eps
    radius: Size

    def outline(self) -> list[Loop]:
        """Return the whole curve."""
        return _ripples(self.radius, self.eps, 2.0)


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
    eps: Eps
    radius: Size

    def outline(self) -> list[Loop]:
        """Return the whole curve."""
        return _ripples(self.radius, self.eps, float(self.leaves))
