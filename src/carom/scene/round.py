"""Round walls: cylinder, sphere, arc, stadium."""

from __future__ import annotations

import math
from typing import Annotated, Literal

import numpy as np
from pydantic import AfterValidator, model_validator

from carom.kernel import dot
from carom.scene.faults import Fault, Words, refuse
from carom.scene.features import FACE, LINE, POINT
from carom.scene.flat import FAR, LEVEL
from carom.scene.parts import UP, Feature, Flat, across, circle, line, minus, post, unit
from carom.scene.quantities import Angle, Direction, Extent, Flag, Place, Point, Size, Vector
from carom.scene.wall import Outline, Wall, spelled
from carom.units import length

__all__ = ["Arc", "Cylinder", "Sphere", "Stadium"]


def _endless(value: float) -> float:
    if value != math.inf:
        advice = (
            "a cylinder has no ends, as rims are not among the things a ball can touch; planes close one from inside"
        )
        raise Fault("inf, or nothing", value, advice).error()
    return value


class Cylinder(Wall):
    """A round pillar without ends, of any tilt; or, ``inside``, a tube."""

    shape: Literal["cylinder"] = "cylinder"
    point: Point
    axis: Direction = UP
    radius: Size
    inside: Flag = False
    length: Annotated[Extent, AfterValidator(_endless)] = math.inf

    @property
    def bounded(self) -> bool:
        """As seen from above, an upright one is a circle."""
        return self.vertical(0.0)

    @property
    def room(self) -> float:
        """Inside, its radius."""
        return self.radius if self.inside else math.inf

    def features(self) -> list[Feature]:
        """A line with a radius."""
        return [line(self.point, unit(self.axis), R=self.radius, side=-1.0 if self.inside else 1.0)]

    def outline(self) -> Outline:
        """A circle; of a tilted one its two sides."""
        if self.vertical(0.0):
            return [circle(self.point, self.radius)]
        x, y, _z = unit((*self.axis[:2], 0.0))
        at, along, off = np.array(self.point[:2]), np.array([x, y]), self.radius * np.array([-y, x])
        return [np.array([at + s * off - FAR * along, at + s * off + FAR * along]) for s in (1.0, -1.0)]

    def describe(self) -> str:
        """One phrase."""
        return f"a {'tube' if self.inside else 'cylinder'} of radius {length(self.radius)} at {spelled(self.point)}"

    def blocked(self, x: Vector) -> bool:
        """In the pillar, or out of the tube."""
        r = across(minus(x, self.point), unit(self.axis))
        far = math.sqrt(dot(r, r))
        return far > self.radius if self.inside else far < self.radius

    def vertical(self, z: float) -> bool:
        """A vertical axis."""
        return abs(unit(self.axis)[2]) > 1 - LEVEL


class Sphere(Wall):
    """A fixed sphere, met from outside or, ``inside``, from within."""

    shape: Literal["sphere"] = "sphere"
    center: Point
    radius: Size
    inside: Flag = False

    @property
    def room(self) -> float:
        """Inside, its radius."""
        return self.radius if self.inside else math.inf

    def features(self) -> list[Feature]:
        """A point with a radius."""
        return [Feature(POINT, self.center, R=self.radius, side=-1.0 if self.inside else 1.0)]

    def outline(self) -> Outline:
        """A circle."""
        return [circle(self.center, self.radius)]

    def describe(self) -> str:
        """One phrase."""
        where = ", balls inside" if self.inside else ""
        return f"a sphere of radius {length(self.radius)} at {spelled(self.center)}{where}"

    def blocked(self, x: Vector) -> bool:
        """In the sphere, or out of it."""
        far = math.dist(x, self.center)
        return far > self.radius if self.inside else far < self.radius

    def vertical(self, z: float) -> bool:
        """Only where its centre and the balls' are level."""
        return abs(z - self.center[2]) < LEVEL * self.radius


class Arc(Wall):
    """A thin upright wall along a part of a circle, counterclockwise from one angle to the other; met from both sides."""

    shape: Literal["arc"] = "arc"
    center: Place
    radius: Size
    from_angle: Angle
    to_angle: Angle

    @model_validator(mode="after")
    def _opens(self) -> Arc:
        if not 0 < self.span <= 360:
            got = Words(f"{self.from_angle:g} to {self.to_angle:g}")
            refuse([Fault("an arc of more than 0 and at most 360 degrees", got, "to_angle is the greater one")])
        return self

    @property
    def span(self) -> float:
        """Its angle, degrees."""
        return self.to_angle - self.from_angle

    def _at(self, degrees: float) -> Flat:
        angle = math.radians(degrees)
        return (self.center[0] + self.radius * math.cos(angle), self.center[1] + self.radius * math.sin(angle))

    def features(self) -> list[Feature]:
        """The hollow and the bulging side; two end posts."""
        middle = math.radians(self.from_angle + self.span / 2)
        u = (math.cos(middle), math.sin(middle), 0.0)
        whole = self.span >= 360
        cosine = -1.0 if whole else math.cos(math.radians(self.span / 2))
        sides = [Feature(LINE, (*self.center, 0.0), UP, self.radius, side, u, cosine, 1.0) for side in (-1.0, 1.0)]
        return sides if whole else [*sides, post(self._at(self.from_angle)), post(self._at(self.to_angle))]

    def outline(self) -> Outline:
        """A part of a circle."""
        return [circle(self.center, self.radius, math.radians(self.from_angle), math.radians(self.to_angle))]

    def describe(self) -> str:
        """One phrase."""
        return f"an arc of {self.span:g} degrees, radius {length(self.radius)}, around {spelled(self.center)}"


class Stadium(Wall):
    """Two straight walls of a length, a diameter apart, joined by half circles; balls inside (Bunimovich's billiard)."""

    shape: Literal["stadium"] = "stadium"
    length: Size
    radius: Size
    center: Place = (0.0, 0.0)
    angle: Angle = 0.0

    @property
    def room(self) -> float:
        """Its radius."""
        return self.radius

    def _frame(self) -> tuple[Flat, Flat]:
        c, s = math.cos(math.radians(self.angle)), math.sin(math.radians(self.angle))
        return (c, s), (-s, c)

    def _point(self, along: float, off: float) -> Flat:
        t, n = self._frame()
        return (self.center[0] + along * t[0] + off * n[0], self.center[1] + along * t[1] + off * n[1])

    def features(self) -> list[Feature]:
        """Two faces, two half cylinders."""
        t, half = self._frame()[0], self.length / 2
        found = []
        for s in (1.0, -1.0):
            u = (s * t[0], s * t[1], 0.0)
            # the wall on the right of one who walks along u looks back at the middle
            p = (*self._point(0.0, -s * self.radius), 0.0)
            found.append(Feature(FACE, p, (-u[1], u[0], 0.0), u=u, lo1=-half, hi1=half))
            found.append(Feature(LINE, (*self._point(s * half, 0.0), 0.0), UP, self.radius, -1.0, u, 0.0, 1.0))
        return found

    def outline(self) -> Outline:
        """All around."""
        turn, half = math.radians(self.angle), self.length / 2
        right = circle(self._point(half, 0.0), self.radius, turn - math.pi / 2, turn + math.pi / 2)
        left = circle(self._point(-half, 0.0), self.radius, turn + math.pi / 2, turn + 3 * math.pi / 2)
        return [np.concatenate((right, left, right[:1]))]

    def describe(self) -> str:
        """One phrase."""
        return f"a stadium of {length(self.length)} between half circles of radius {length(self.radius)}"

    def blocked(self, x: Vector) -> bool:
        """Out of it."""
        (tx, ty), (dx, dy) = self._frame()[0], (x[0] - self.center[0], x[1] - self.center[1])
        along, off = dx * tx + dy * ty, dy * tx - dx * ty
        return math.hypot(max(abs(along) - self.length / 2, 0.0), off) > self.radius
