"""Bunimovich's mushroom."""

from __future__ import annotations

from itertools import pairwise
from typing import ClassVar, Literal

from pydantic import model_validator

from carom.errors import Fault
from carom.scene.figures.figure import Loop, PlaneFigure, Sizes2
from carom.scene.figures.pieces import ArcPiece, SegmentPiece
from carom.scene.schema import Size, raise_faults

__all__ = ["MushroomFigure"]


class MushroomFigure(PlaneFigure):
    """A mushroom: a half disc as its cap, a rectangle below as its stem. It has regular and chaotic orbits, in one region each.

    Source: L. A. Bunimovich, Chaos 11, 802 (2001), https://doi.org/10.1063/1.1418763.

    Parameters
    ----------
    radius : m: of the cap
    stem : 2 lengths, m: width, below 2 radii, and height
    """

    usual: ClassVar = {"radius": 1.0, "stem": (1.0, 1.0)}
    shape: Literal["mushroom"] = "mushroom"
    radius: Size
    stem: Sizes2

    @model_validator(mode="after")
    def _narrow(self) -> MushroomFigure:
        if self.stem[0] >= 2 * self.radius:
            got = f"{self.stem[0]:g}"
            raise_faults([Fault("", "stem", f"a width below 2 radii, {2 * self.radius:g}", got)])
        return self

    def outline(self) -> list[Loop]:
        """Return the stem from its lower left corner, and the cap."""
        (w, h), r = self.stem, self.radius
        corners = [(-r, 0.0), (-w / 2, 0.0), (-w / 2, -h), (w / 2, -h), (w / 2, 0.0), (r, 0.0)]
        sides: Loop = [SegmentPiece(one, two) for one, two in pairwise(corners)]
        return [[*sides, ArcPiece((0.0, 0.0), r, 0.0, 180.0)]]
