"""The room of figures: regions by their names and sizes, each declared once, in one file; scenes, gases and billiards use them.

A file added to this package, with a class of :class:`PlaneFigure` that has a ``shape``, is found here.
"""

from __future__ import annotations

from carom.scene.by_file import models_by_shape
from carom.scene.figures.figure import Cell, Figure, PlaneFigure, Solid
from carom.scene.figures.pieces import ArcPiece, EllipsePiece, ParallelPiece, Piece, SegmentPiece

__all__ = [
    "FIGURES", "ArcPiece", "Cell", "EllipsePiece", "Figure", "ParallelPiece", "Piece", "PlaneFigure", "SegmentPiece", "Solid",
]  # fmt: skip

FIGURES = models_by_shape(__name__, __path__, Figure)
