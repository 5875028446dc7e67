"""Round walls: cylinder, sphere, arc, stadium."""

from __future__ import annotations

import math
from typing import Literal

import numpy as np
from pydantic import model_validator

from carom.kernel import dot
from carom.scene.faults import Fault, Words, refuse
from carom.scene.features import FACE, LINE, OVER, POINT
from carom.scene.flat import FAR, LEVEL
from carom.scene.parts import UP, Feature, Flat, across, circle, corner, disc, line, minus, post, rim, unit
from carom.scene.quantities import Angle, Direction, Extent, Flag, Place, Point, Size, Vector
from carom.scene.standing import Standing
from carom.scene.wall import Outline, Wall, spelled
from carom.units import length

__all__ = ["Arc", "Cylinder", "Sphere", "Stadium"]


class Cylinder(Wall):
    """A round pillar of any tilt; or, ``inside``, a tube.

    Without a ``length`` it has no ends. With one it goes so far along its axis from ``point``, the middle of its first end: a
    pillar is closed by two discs, a tube is open and thin, and met from outside as well.
    """

    shape: Literal["cylinder"] = "cylinder"
    point: Point
    axis: Direction = UP
    radius: Size
    inside: Flag = False
    length: Extent = math.inf

    @model_validator(mode="after")
    def _has_length(self) -> Cylinder:
        refuse([] if self.length > 0 else [Fault("a length greater than 0 m", self.length, at=("length",))])
        return self

    @property
    def _ends(self) -> bool:
        return self.length < math.inf

    @property
    def bounded(self) -> bool:
        """As seen from above, an upright one is a circle, and one that ends has an end."""
        return self._ends or self._upright

    @property
    def room(self) -> float:
        """Inside, its radius; where it is open, there is room outside."""
        return self.radius if self.inside and not self._ends else math.inf

    def _far_end(self) -> Vector:
        p, d = self.point, unit(self.axis)
        return (p[0] + self.length * d[0], p[1] + self.length * d[1], p[2] + self.length * d[2])

    def features(self) -> list[Feature]:
        """A line with a radius; where it ends two discs, or its other side, and two rims."""
        p, d, R = self.point, unit(self.axis), self.radius
        if not self._ends:
            return [line(p, d, R=R, side=-1.0 if self.inside else 1.0)]
        found = [line(p, d, 0.0, self.length, R, side) for side in ((-1.0, 1.0) if self.inside else (1.0,))]
        if not self.inside:
            found += [disc(p, (-d[0], -d[1], -d[2]), R), disc(self._far_end(), d, R)]
        return [*found, rim(p, d, R), rim(self._far_end(), d, R)]

    def outline(self) -> Outline:
        """A circle; of a tilted one its two sides, or all around."""
        if self._upright:
            return [circle(self.point, self.radius)]
        x, y, _z = unit((*self.axis[:2], 0.0))
        off = self.radius * np.array([-y, x])
        if self._ends:
            one, two = np.array(self.point[:2]), np.array(self._far_end()[:2])
            return [np.array([one + off, two + off, two - off, one - off, one + off])]
        at, along = np.array(self.point[:2]), np.array([x, y])
        return [np.array([at + s * off - FAR * along, at + s * off + FAR * along]) for s in (1.0, -1.0)]

    def describe(self) -> str:
        """One phrase."""
        long = f", {length(self.length)} long" if self._ends else ""
        kind = "tube" if self.inside else "cylinder"
        return f"a {kind} of radius {length(self.radius)}{long} at {spelled(self.point)}"

    def blocked(self, x: Vector) -> bool:
        """In the pillar, or out of a tube without ends."""
        r, d = minus(x, self.point), unit(self.axis)
        off = across(r, d)
        far = math.sqrt(dot(off, off))
        if self._ends:
            return not self.inside and far < self.radius and 0 < dot(r, d) < self.length
        return far > self.radius if self.inside else far < self.radius

    @property
    def _upright(self) -> bool:
        return abs(unit(self.axis)[2]) > 1 - LEVEL

    def vertical(self, z: float) -> bool:
        """A vertical axis, and it reaches below and above the balls' centres."""
        ends = (self.point[2], self._far_end()[2]) if self._ends else (-math.inf, math.inf)
        return self._upright and min(ends) <= z <= max(ends)


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


class Arc(Standing):
    """A thin upright wall along a part of a circle, counterclockwise from one angle to the other; met from both sides."""

    shape: Literal["arc"] = "arc"
    center: Place
    radius: Size
    from_angle: Angle
    to_angle: Angle

    @model_validator(mode="after")
    def _opens(self) -> Arc:
        found = self._levels()
        if not 0 < self.span <= 360:
            got = Words(f"{self.from_angle:g} to {self.to_angle:g}")
            found.append(Fault("an arc of more than 0 and at most 360 degrees", got, "to_angle is the greater one"))
        refuse(found)
        return self

    @property
    def encloses(self) -> bool:
        """A whole circle does."""
        return self.span >= 360

    @property
    def span(self) -> float:
        """Its angle, degrees."""
        return self.to_angle - self.from_angle

    def _at(self, degrees: float) -> Flat:
        angle = math.radians(degrees)
        return (self.center[0] + self.radius * math.cos(angle), self.center[1] + self.radius * math.sin(angle))

    def features(self) -> list[Feature]:
        """The hollow and the bulging side; rims; end posts, corners; gates."""
        middle = math.radians(self.from_angle + self.span / 2)
        u = (math.cos(middle), math.sin(middle), 0.0)
        cosine = -1.0 if self.encloses else math.cos(math.radians(self.span / 2))
        at, low, high = (*self.center, 0.0), self.low, self.height
        levels = [z for z in sorted({low, high}) if math.isfinite(z)]

        def side(kind: int, which: float, below: float, above: float) -> Feature:
            return Feature(kind, at, UP, self.radius, which, u, cosine, 1.0, below, above)

        found = [side(LINE, which, low, high) for which in (-1.0, 1.0)] if low < high else []
        found += [rim((*self.center, z), UP, self.radius, u, cosine) for z in levels]
        if not self.encloses:
            for end in (self._at(self.from_angle), self._at(self.to_angle)):
                found += [post(end, low, high)] if low < high else []
                found += [corner((*end, z)) for z in levels]
        if math.isfinite(high):
            found += [side(OVER, which, high, math.inf) for which in ((-1.0,) if self.encloses else (-1.0, 1.0))]
        return found

    def outline(self) -> Outline:
        """A part of a circle."""
        return [circle(self.center, self.radius, math.radians(self.from_angle), math.radians(self.to_angle))]

    def describe(self) -> str:
        """One phrase."""
        return f"an arc of {self.span:g} degrees, radius {length(self.radius)}, around {spelled(self.center)}{self._tall()}"


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
