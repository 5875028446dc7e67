"""Ellipse."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

from pydantic import BeforeValidator

from carom.scene.figures.figure import Loop, PlaneFigure
from carom.scene.figures.pieces import EllipsePiece
from carom.scene.schema import Components, Size

__all__ = ["EllipseFigure"]


class EllipseFigure(PlaneFigure):
    """An ellipse about the origin.

    Parameters
    ----------
    half_axes : 2 lengths, m: half its width in x, half its width in y
    """

    usual: ClassVar = {"half_axes": (1.0, 0.8)}
    shape: Literal["ellipse"] = "ellipse"
    half_axes: Annotated[tuple[Size, Size], BeforeValidator(Components("2 lengths in m, > 0: along x, y", (2,)))]

    def outline(self) -> list[Loop]:
        """Return the whole ellipse."""
        return [[EllipsePiece(self.half_axes)]]
