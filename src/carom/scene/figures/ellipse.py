"""Ellipse."""

from __future__ import annotations

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
