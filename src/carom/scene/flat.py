"""Walls made of planes: plane, strip, wedge, box."""

from __future__ import annotations

import math
from itertools import product
from typing import Literal

import numpy as np
from pydantic import model_validator

from carom.kernel import cross, dot
from carom.scene.faults import Fault, Words, refuse
from carom.scene.features import FACE
from carom.scene.parts import UP, Feature, corner, frame, line, minus, plane, unit
from carom.scene.quantities import Angle, Direction, Flag, Point, Size, Sizes, Vector
from carom.scene.wall import Outline, Wall, spelled
from carom.units import length

__all__ = ["FAR", "Box", "Plane", "Strip", "Wedge", "track"]

FAR = 1e3  # m: how far to each side a line without end is drawn
LEVEL = 1e-12


def track(p: Vector, d: Vector) -> Outline:
    """The line in which a plane through p with unit normal d cuts z = 0; none where it is level."""
    flat = math.hypot(d[0], d[1])
    if flat < LEVEL:
        return []
    shift = p[2] * d[2] / (flat * flat)
    at, along = np.array([p[0] + shift * d[0], p[1] + shift * d[1]]), np.array([-d[1], d[0]]) / flat
    return [np.array([at - FAR * along, at + FAR * along])]


class Plane(Wall):
    """A plane without end, of any tilt. Balls are on the side of its normal."""

    shape: Literal["plane"] = "plane"
    point: Point
    normal: Direction

    @property
    def bounded(self) -> bool:
        """It goes on for ever."""
        return False

    def features(self) -> list[Feature]:
        """One face."""
        return [plane(self.point, unit(self.normal))]

    def outline(self) -> Outline:
        """Where it cuts the floor."""
        return track(self.point, unit(self.normal))

    def describe(self) -> str:
        """One phrase."""
        return f"a plane through {spelled(self.point)} with normal {spelled(unit(self.normal))}"

    def blocked(self, x: Vector) -> bool:
        """Behind it."""
        return dot(minus(x, self.point), self.normal) < 0

    def vertical(self, z: float) -> bool:
        """A level normal."""
        return abs(unit(self.normal)[2]) < LEVEL


class Strip(Wall):
    """Two parallel planes, balls between: one through the point, one a width further along the normal."""

    shape: Literal["strip"] = "strip"
    point: Point
    normal: Direction
    width: Size

    @property
    def bounded(self) -> bool:
        """It goes on for ever."""
        return False

    def features(self) -> list[Feature]:
        """Two faces."""
        near = unit(self.normal)
        far: Vector = (-near[0], -near[1], -near[2])
        return [plane(self.point, near), plane(self._beyond, far)]

    @property
    def _beyond(self) -> Vector:
        p, d = self.point, unit(self.normal)
        return (p[0] + self.width * d[0], p[1] + self.width * d[1], p[2] + self.width * d[2])

    def outline(self) -> Outline:
        """Where the two cut the floor."""
        d = unit(self.normal)
        return track(self.point, d) + track(self._beyond, d)

    def describe(self) -> str:
        """One phrase."""
        return f"a strip of width {length(self.width)}"

    def blocked(self, x: Vector) -> bool:
        """Not between the two."""
        d = unit(self.normal)
        return dot(minus(x, self.point), d) < 0 or dot(minus(x, self._beyond), d) > 0

    def vertical(self, z: float) -> bool:
        """A level normal."""
        return abs(unit(self.normal)[2]) < LEVEL


class Wedge(Wall):
    """Two half-planes that meet in a line; balls in the opening, from one angle up to the other, counterclockwise.

    Angles are seen along the axis, counted from x (from y, where the axis is along x). An opening of more than 180
    degrees has an edge, and one of 360 is a screen that begins at the line.
    """

    shape: Literal["wedge"] = "wedge"
    apex: Point
    axis: Direction = UP
    from_angle: Angle
    to_angle: Angle

    @model_validator(mode="after")
    def _opens(self) -> Wedge:
        if not 0 < self.opening <= 360:
            got = Words(f"{self.from_angle:g} to {self.to_angle:g}")
            refuse([Fault("an opening of more than 0 and at most 360 degrees", got, "to_angle is the greater one")])
        return self

    @property
    def opening(self) -> float:
        """Its angle, degrees."""
        return self.to_angle - self.from_angle

    @property
    def bounded(self) -> bool:
        """It goes on for ever."""
        return False

    def _along(self, degrees: float) -> Vector:
        u, v = frame(unit(self.axis))
        c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
        return (c * u[0] + s * v[0], c * u[1] + s * v[1], c * u[2] + s * v[2])

    def features(self) -> list[Feature]:
        """Two faces; where the opening is wide they end at an edge."""
        axis = unit(self.axis)
        first, last = self._along(self.from_angle), self._along(self.to_angle)
        if self.opening <= 180:
            return [plane(self.apex, cross(axis, first)), plane(self.apex, cross(last, axis))]
        return [
            Feature(FACE, self.apex, cross(axis, first), u=first, lo1=0.0),
            Feature(FACE, self.apex, cross(last, axis), u=last, lo1=0.0),
            line(self.apex, axis),
        ]

    def outline(self) -> Outline:
        """Two rays from the apex; where the axis is not vertical, where the two planes cut the floor."""
        if not self.vertical(0.0):
            axis = unit(self.axis)
            return [
                one for a in (self.from_angle, self.to_angle) for one in track(self.apex, cross(axis, self._along(a)))
            ]
        ends = [self._along(angle) for angle in (self.from_angle, self.to_angle)]
        at = np.array(self.apex[:2])
        return [np.array([at + FAR * np.array(ends[0][:2]), at, at + FAR * np.array(ends[1][:2])])]

    def describe(self) -> str:
        """One phrase."""
        return f"a wedge of {self.opening:g} degrees at {spelled(self.apex)}"

    def blocked(self, x: Vector) -> bool:
        """Not in the opening."""
        r = minus(x, self.apex)
        u, v = frame(unit(self.axis))
        angle = math.degrees(math.atan2(dot(r, v), dot(r, u)))
        return (angle - self.from_angle) % 360 > self.opening

    def vertical(self, z: float) -> bool:
        """A vertical axis."""
        return abs(unit(self.axis)[2]) > 1 - LEVEL


class Box(Wall):
    """A block along the axes, met from outside; or, ``inside``, a container. Give its center, or its lowest corner."""

    shape: Literal["box"] = "box"
    center: Point | None = None
    corner: Point | None = None
    size: Sizes
    inside: Flag = False

    @model_validator(mode="after")
    def _placed(self) -> Box:
        if (self.center is None) == (self.corner is None):
            got = "nothing" if self.center is None else "both"
            refuse([Fault("either center or corner (the lowest in x, y and z)", Words(got))])
        return self

    @property
    def low(self) -> Vector:
        """Its lowest corner."""
        if self.corner is not None:
            return self.corner
        assert self.center is not None
        c, s = self.center, self.size
        return (c[0] - s[0] / 2, c[1] - s[1] / 2, c[2] - s[2] / 2)

    @property
    def high(self) -> Vector:
        """Its highest corner."""
        p, s = self.low, self.size
        return (p[0] + s[0], p[1] + s[1], p[2] + s[2])

    def features(self) -> list[Feature]:
        """Six faces; from outside twelve edges and eight corners as well."""
        ends = (self.low, self.high)
        units: tuple[Vector, ...] = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
        found: list[Feature] = []
        for k, side in product(range(3), (0, 1)):
            i, j = (k + 1) % 3, (k + 2) % 3
            way = 1.0 if side != self.inside else -1.0
            d: Vector = (way * units[k][0], way * units[k][1], way * units[k][2])
            if self.inside:
                found.append(plane(ends[side], d))
                continue
            # u is the next axis, so that d x u is the one after it, or its opposite
            second = (0.0, self.size[j]) if way > 0 else (-self.size[j], 0.0)
            p = [*self.low]
            p[k] = ends[side][k]
            found.append(Feature(FACE, (p[0], p[1], p[2]), d, 0.0, 1.0, units[i], 0.0, self.size[i], *second))
        if not self.inside:
            for k in range(3):
                i, j = (k + 1) % 3, (k + 2) % 3
                for one, two in product((0, 1), repeat=2):
                    p = [*self.low]
                    p[i], p[j] = ends[one][i], ends[two][j]
                    found.append(line((p[0], p[1], p[2]), units[k], 0.0, self.size[k]))
            found += [corner((ends[i][0], ends[j][1], ends[k][2])) for i, j, k in product((0, 1), repeat=3)]
        return found

    def outline(self) -> Outline:
        """A rectangle."""
        (x, y, _), (u, v, _) = self.low, self.high
        return [np.array([(x, y), (u, y), (u, v), (x, v), (x, y)])]

    def describe(self) -> str:
        """One phrase."""
        size = " by ".join(length(s) for s in self.size)
        return f"a {'container' if self.inside else 'box'} of {size}"

    def blocked(self, x: Vector) -> bool:
        """In the block, or out of the container."""
        within = all(p < c < q for p, c, q in zip(self.low, x, self.high, strict=True))
        return within != self.inside

    def vertical(self, z: float) -> bool:
        """It reaches below and above the balls' centres."""
        return self.low[2] <= z <= self.high[2]
