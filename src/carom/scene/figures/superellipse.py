"""Lame's superellipse."""

from __future__ import annotations

import math
from typing import Annotated, Any, ClassVar, Literal

from pydantic import BeforeValidator, Field

from carom.core.jets import call
from carom.scene.figures.curve import PolarPiece
from carom.scene.figures.figure import Loop, PlaneFigure, Sizes2
from carom.scene.schema import Whole

__all__ = ["SuperellipseFigure"]


class SuperellipseFigure(PlaneFigure):
    """A superellipse |x/p|^n + |y/q|^n = 1: an ellipse for n = 2, nearly a rectangle for large n.

    Parameters
    ----------
    half_axes : 2 lengths, m: p, q
    power : n, a whole number from 2 to 20
    """

    usual: ClassVar = {"half_axes": (1.0, 0.8), "power": 4}
    shape: Literal["superellipse"] = "superellipse"
    half_axes: Sizes2
    power: Annotated[int, BeforeValidator(Whole("a whole number from 2 to 20", 2)), Field(le=20)]

    def outline(self) -> list[Loop]:
        """Return the whole curve, by the angle; for odd n its third derivative or a higher one jumps on the axes."""
        (p, q), n = self.half_axes, float(self.power)

        def r(t: Any) -> Any:
            x, y = call("absolute", call("cos", t) / p), call("absolute", call("sin", t) / q)
            return (x**n + y**n) ** (-1.0 / n)

        return [[PolarPiece(r, tuple(math.pi / 2 * k for k in range(1, 4)))]]
