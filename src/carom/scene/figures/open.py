"""Figures without an end: strip and wedge in the plane, plates in space."""

from __future__ import annotations

from typing import ClassVar, Literal

from pydantic import model_validator

from carom.errors import Fault
from carom.scene.figures.figure import Figure
from carom.scene.schema import Angle, Size, raise_faults

__all__ = ["PlatesFigure", "StripFigure", "WedgeFigure"]


class StripFigure(Figure):
    """A strip: two parallel walls y = -width/2 and y = width/2.

    Parameters
    ----------
    width : m
    """

    usual: ClassVar = {"width": 1.0}
    shape: Literal["strip"] = "strip"
    width: Size


class WedgeFigure(Figure):
    """A wedge: two walls from the origin, symmetric about the x axis.

    Parameters
    ----------
    angle : degrees, above 0 and below 180: between the walls
    """

    usual: ClassVar = {"angle": 40.0}
    shape: Literal["wedge"] = "wedge"
    angle: Angle

    @model_validator(mode="after")
    def _opens(self) -> WedgeFigure:
        if not 0 < self.angle < 180:
            raise_faults([Fault("", "angle", "degrees > 0 and < 180", f"{self.angle:g}")])
        return self


class PlatesFigure(Figure):
    """Two parallel plates in space, y = -distance/2 and y = distance/2.

    Parameters
    ----------
    distance : m
    """

    dimension: ClassVar[int] = 3
    usual: ClassVar = {"distance": 1.0}
    shape: Literal["plates"] = "plates"
    distance: Size
