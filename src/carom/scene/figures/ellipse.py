"""Ellipse."""

from __future__ import annotations

import math
from typing import ClassVar, Literal

from carom.scene.figures.figure import Loop, PlaneFigure, Sizes2
from carom.scene.figures.pieces import EllipsePiece

__all__ = ["EllipseFigure"]


class EllipseFigure(PlaneFigure):
    """An ellipse about the origin.

    Parameters
    ----------
    half_axes : 2 lengths, m: half its width in x, half its width in y
    """

    usual: ClassVar = {"half_axes": (1.0, 0.8)}
    shape: Literal["ellipse"] = "ellipse"
    half_axes: Sizes2

    def outline(self) -> list[Loop]:
        """Return the whole ellipse."""
        return [[EllipsePiece(self.half_axes)]]

    def piece_names(self) -> list[str]:
        """Return the names of the pieces."""
        return ["side"]

    @property
    def area(self) -> float:
        """Its area, m^2."""
        return math.pi * self.half_axes[0] * self.half_axes[1]
