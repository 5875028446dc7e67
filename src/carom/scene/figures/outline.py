"""A figure by its pieces, for programs."""

from __future__ import annotations

from typing import Annotated, Any, ClassVar

from pydantic import BeforeValidator

from carom.scene.figures.figure import Loop, PlaneFigure
from carom.scene.figures.pieces import Piece
from carom.scene.schema import refused

__all__ = ["OutlineFigure"]


def _loops(value: Any) -> tuple[tuple[Piece, ...], ...]:
    try:
        found = tuple(tuple(loop) for loop in value)
    except TypeError:
        found = ()
    if not found or not all(loop and all(isinstance(piece, Piece) for piece in loop) for loop in found):
        raise refused("loops of pieces, each a list of Piece", f"{value!r:.60}")
    return found


class OutlineFigure(PlaneFigure):
    """A figure by its pieces: closed loops, each piece with the open side on its left.

    Parameters
    ----------
    loops : lists of Piece: the outside, counterclockwise, and obstacles in it, clockwise

    Examples
    --------
    >>> from carom import billiards
    >>> from carom.scene.figures import ArcPiece, OutlineFigure, SegmentPiece
    >>> half = OutlineFigure(loops=[[ArcPiece((0, 0), 1.0, 0.0, 180.0), SegmentPiece((-1, 0), (1, 0))]])
    >>> round(half.area, 6), round(float(billiards.table(half).wall().lengths.sum()), 6)
    (1.570796, 5.141593)
    """

    tag: ClassVar[str] = ""
    loops: Annotated[tuple[tuple[Any, ...], ...], BeforeValidator(_loops)]

    @classmethod
    def kind(cls) -> str:
        """Return its name in messages."""
        return "outline"

    def phrases(self) -> list[str]:
        """Return the number of its pieces."""
        return [f"{sum(map(len, self.loops))} pieces"]

    def outline(self) -> list[Loop]:
        """Return its pieces."""
        return [list(loop) for loop in self.loops]
