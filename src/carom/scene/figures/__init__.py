"""The room of figures: regions by their names and sizes, each declared once, in one file; scenes, gases and billiards use them.

A file added to this package, with a class of :class:`PlaneFigure` that has a ``shape``, is found here.
"""

from __future__ import annotations

from carom.scene.figures.figure import (
    FIGURES,
    AnyFigure,
    ArcPiece,
    CellFigure,
    EllipsePiece,
    Figure,
    ParallelPiece,
    Piece,
    PlaneFigure,
    SegmentPiece,
    figure,
)
from carom.scene.figures.polygons import OutlineFigure
from carom.scene.presets import modules_of

__all__ = [
    "FIGURES",
    "AnyFigure",
    "ArcPiece",
    "CellFigure",
    "EllipsePiece",
    "Figure",
    "OutlineFigure",
    "ParallelPiece",
    "Piece",
    "PlaneFigure",
    "SegmentPiece",
    "figure",
]

modules_of(__name__, __path__)
