"""Circle."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Annotated, Any, ClassVar, Literal

from pydantic import PlainValidator, model_validator

from carom.errors import Fault, shown
from carom.scene.figures.figure import FIGURES, ArcPiece, EllipsePiece, Figure, Loop, PlaneFigure, SegmentPiece, Sizes2
from carom.scene.schema import Angle, Size, Sizes, checked_part, raise_faults, refused


class CircleFigure(PlaneFigure):
    """A circle about the origin.

    Parameters
    ----------
    radius : m
    """

    usual: ClassVar = {"radius": 1.0}
    shape: Literal["circle"] = "circle"
    radius: Size

    def outline(self) -> list[Loop]:
        """Return one arc."""
        return [[ArcPiece((0.0, 0.0), self.radius, 0.0, 360.0)]]

    def piece_names(self) -> list[str]:
        """Return the names of the pieces."""
        return ["side"]

    @property
    def area(self) -> float:
        """Its area, m^2."""
        return math.pi * self.radius * self.radius


# ----------------------------------------------------------------------------------------------------
# Ellipse.


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


# ----------------------------------------------------------------------------------------------------
# Sector of a circle.


class SectorFigure(PlaneFigure):
    """A sector of a circle: two sides from the origin, symmetric about the y axis, up to an arc about the origin.

    Parameters
    ----------
    opening : degrees, above 0 and below 180: the angle between the sides
    radius : m
    """

    usual: ClassVar = {"opening": 60.0, "radius": 1.0}
    shape: Literal["sector"] = "sector"
    opening: Angle
    radius: Size

    @model_validator(mode="after")
    def _opens(self) -> SectorFigure:
        if not 0 < self.opening < 180:
            raise_faults([Fault("", "opening", "degrees > 0 and < 180", f"{self.opening:g}")])
        return self

    def outline(self) -> list[Loop]:
        """Return the left side, the right side, the arc."""
        half = math.radians(self.opening) / 2
        x, y = self.radius * math.sin(half), self.radius * math.cos(half)
        arc = ArcPiece((0.0, 0.0), self.radius, 90 - self.opening / 2, 90 + self.opening / 2)
        return [[SegmentPiece((-x, y), (0.0, 0.0)), SegmentPiece((0.0, 0.0), (x, y)), arc]]

    def piece_names(self) -> list[str]:
        """Return the names of the pieces."""
        return ["left", "right", "side"]

    @property
    def area(self) -> float:
        """Its area, m^2."""
        return math.radians(self.opening) * self.radius * self.radius / 2


# ----------------------------------------------------------------------------------------------------
# Bunimovich's stadium.


class StadiumFigure(PlaneFigure):
    """A stadium: two straight sides along x, joined by half circles.

    Source: L. A. Bunimovich, Commun. Math. Phys. 65, 295 (1979), https://doi.org/10.1007/BF01197884.

    Parameters
    ----------
    straight : m: length of the straight sides
    radius : m: of the half circles
    """

    usual: ClassVar = {"straight": 2.0, "radius": 1.0}
    shape: Literal["stadium"] = "stadium"
    straight: Size
    radius: Size

    def outline(self) -> list[Loop]:
        """Return the lower side, the right end, the upper side, the left end."""
        x, r = self.straight / 2, self.radius
        return [
            [
                SegmentPiece((-x, -r), (x, -r)),
                ArcPiece((x, 0.0), r, -90.0, 90.0),
                SegmentPiece((x, r), (-x, r)),
                ArcPiece((-x, 0.0), r, 90.0, 270.0),
            ]
        ]

    def piece_names(self) -> list[str]:
        """Return the names of the pieces."""
        return ["front", "right", "back", "left"]

    @property
    def area(self) -> float:
        """Its area, m^2."""
        return self.straight * (2 * self.radius) + math.pi * self.radius * self.radius


# ----------------------------------------------------------------------------------------------------
# Squash: the drive-belt stadium.


class SquashFigure(PlaneFigure):
    """A squash: two circles of different radii with their common tangents, the belt of a drive; of equal radii it is a stadium.

    Source: L. A. Bunimovich, Commun. Math. Phys. 65, 295 (1979), https://doi.org/10.1007/BF01197884.

    Parameters
    ----------
    radii : 2 lengths, m: of the left circle, of the right one
    distance : m: of their centres on the x axis, above the difference of the radii
    """

    usual: ClassVar = {"radii": (1.0, 0.5), "distance": 1.5}
    shape: Literal["squash"] = "squash"
    radii: Sizes2
    distance: Size

    @model_validator(mode="after")
    def _apart(self) -> SquashFigure:
        least = abs(self.radii[0] - self.radii[1])
        if self.distance <= least:
            raise_faults(
                [Fault("", "distance", f"a length above the difference of the radii, {least:g}", f"{self.distance:g}")]
            )
        return self

    def outline(self) -> list[Loop]:
        """Return the lower side, the right end, the upper side, the left end."""
        (a, b), half = self.radii, self.distance / 2
        angle = math.acos((a - b) / self.distance)
        cos, sin, turn = math.cos(angle), math.sin(angle), math.degrees(angle)
        return [
            [
                SegmentPiece((-half + a * cos, -a * sin), (half + b * cos, -b * sin)),
                ArcPiece((half, 0.0), b, -turn, turn),
                SegmentPiece((half + b * cos, b * sin), (-half + a * cos, a * sin)),
                ArcPiece((-half, 0.0), a, turn, 360.0 - turn),
            ]
        ]


# ----------------------------------------------------------------------------------------------------
# Lemon billiards.


class LemonFigure(PlaneFigure):
    """A lemon: what two discs have in common; its corners lie on the y axis.

    Source: E. J. Heller and S. Tomsovic, Phys. Today 46 (7), 38 (1993), https://doi.org/10.1063/1.881358.

    Parameters
    ----------
    radius : m: of both circles
    distance : m: of their centres, below 2 radii
    """

    usual: ClassVar = {"radius": 1.0, "distance": 1.0}
    shape: Literal["lemon"] = "lemon"
    radius: Size
    distance: Size

    @model_validator(mode="after")
    def _meet(self) -> LemonFigure:
        if self.distance >= 2 * self.radius:
            raise_faults([Fault("", "distance", f"a length below 2 radii, {2 * self.radius:g}", f"{self.distance:g}")])
        return self

    def outline(self) -> list[Loop]:
        """Return the right arc and the left one."""
        half, angle = self.distance / 2, math.degrees(math.acos(self.distance / 2 / self.radius))
        return [
            [
                ArcPiece((-half, 0.0), self.radius, -angle, angle),
                ArcPiece((half, 0.0), self.radius, 180.0 - angle, 180.0 + angle),
            ]
        ]


# ----------------------------------------------------------------------------------------------------
# Bunimovich's mushroom.


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


# ----------------------------------------------------------------------------------------------------
# Figures in space: sphere, box, and a cylinder over any figure in the plane.


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
