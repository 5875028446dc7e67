"""Figures in space: sphere, box, and a cylinder over any figure in the plane."""

from __future__ import annotations

from typing import Annotated, Any, ClassVar, Literal

from pydantic import PlainValidator, model_validator

from carom.errors import Fault, shown
from carom.scene.figures.figure import FIGURES, Figure
from carom.scene.figures.rounds import CircleFigure
from carom.scene.schema import Size, Sizes, checked_part, raise_faults, refused


class SphereFigure(Figure):
    """A sphere about the origin.

    Parameters
    ----------
    radius : m
    """

    dimension: ClassVar[int] = 3
    usual: ClassVar = {"radius": 1.0}
    shape: Literal["sphere"] = "sphere"
    radius: Size


class BoxFigure(Figure):
    """A box about the origin.

    Parameters
    ----------
    size : 3 lengths, m: along x, y and z
    """

    dimension: ClassVar[int] = 3
    usual: ClassVar = {"size": (1.0, 1.0, 1.0)}
    shape: Literal["box"] = "box"
    size: Sizes


def _section(value: Any) -> Figure:
    if isinstance(value, dict) and FIGURES.get(str(value.get("shape")), SphereFigure).dimension == 2:
        return checked_part(FIGURES[value["shape"]], value)
    if isinstance(value, Figure) and value.dimension == 2:
        return value
    flat = [name for name, one in FIGURES.items() if one.dimension == 2]
    raise refused(f"a figure in the plane, with a shape of {', '.join(flat)}", shown(value))


class CylinderFigure(Figure):
    """A cylinder along z over a figure in the plane, open or with two lids.

    Parameters
    ----------
    radius : m: of a circle; or
    section : any figure in the plane: a table of its fields
    height : m: distance of the lids, half of it above z = 0; default: open
    """

    dimension: ClassVar[int] = 3
    usual: ClassVar = {"radius": 1.0}
    shape: Literal["cylinder"] = "cylinder"
    radius: Size | None = None
    section: Annotated[Figure, PlainValidator(_section)] | None = None
    height: Size | None = None

    @model_validator(mode="after")
    def _one_section(self) -> CylinderFigure:
        if (self.radius is None) == (self.section is None):
            got = "neither" if self.radius is None else "both"
            raise_faults([Fault("", "", "either radius or section", got)])
        return self

    @property
    def over(self) -> Figure:
        """The figure in the plane."""
        return self.section or CircleFigure(radius=self.radius or 0.0)
