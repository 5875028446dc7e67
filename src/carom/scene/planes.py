"""Walls made of planes: plane, strip, wedge, box."""

from __future__ import annotations

import math
from itertools import product
from typing import Literal

import numpy as np
from pydantic import model_validator

from carom.core.geometry.angles import direction
from carom.core.geometry.features import FACE
from carom.core.jit.kernel import cross, dot
from carom.errors import Fault
from carom.formatting import format_length
from carom.public.renamed import renamed_attribute
from carom.scene.feature_builders import UP, Feature, corner, frame, line, minus, plane, unit
from carom.scene.schema import Angle, Direction, Flag, Point, Size, Sizes, Vector, raise_faults
from carom.scene.wall import Outline, WallShape, format_vector

__all__ = ["FAR", "Box", "Plane", "Strip", "Wedge", "track"]

FAR = 1e3  # m: how far to each side a line without end is drawn
LEVEL = 1e-12


def track(p: Vector, d: Vector) -> Outline:
    """Return the line in which a plane through p with unit normal d intersects z = 0; none if it is horizontal."""
    flat = math.hypot(d[0], d[1])
    if flat < LEVEL:
        return []
    shift = p[2] * d[2] / (flat * flat)
    at, along = np.array([p[0] + shift * d[0], p[1] + shift * d[1]]), np.array([-d[1], d[0]]) / flat
    return [np.array([at - FAR * along, at + FAR * along])]


class Plane(WallShape):
    """An infinite plane of any tilt; balls are on the side to which its normal points.

    Parameters
    ----------
    point : 3 lengths, m: a point of the plane
    normal : 3 numbers, of any length: its normal, towards the balls
    restitution, friction, tangential_restitution, stiffness_ratio, law, name : see the guide on scenes; fields of every wall

    Raises CaromError, one line per problem.

    Examples
    --------
    >>> import carom
    >>> carom.scene.Plane(point=(0, 0, 0), normal=(2, 0, 0), restitution=0.85, friction=0.2).describe()
    'a plane through (0, 0, 0) with normal (1, 0, 0)'
    """

    shape: Literal["plane"] = "plane"
    point: Point
    normal: Direction

    @property
    def bounded(self) -> bool:
        """Return False: it is infinite."""
        return False

    def features(self) -> list[Feature]:
        """Return one face."""
        return [plane(self.point, unit(self.normal))]

    def outline(self) -> Outline:
        """Return its intersection with the floor."""
        return track(self.point, unit(self.normal))

    def describe(self) -> str:
        """Return a description of a few words."""
        return f"a plane through {format_vector(self.point)} with normal {format_vector(unit(self.normal))}"

    def blocked(self, x: Vector) -> bool:
        """Return whether a point is behind it."""
        return dot(minus(x, self.point), self.normal) < 0

    def vertical(self, z: float) -> bool:
        """Return whether its normal is horizontal."""
        return abs(unit(self.normal)[2]) < LEVEL


class Strip(WallShape):
    """Two parallel planes with the balls between them.

    Parameters
    ----------
    point : 3 lengths, m: a point of the first plane
    normal : 3 numbers: its normal, towards the second plane
    width : m: distance of the planes
    restitution, friction, tangential_restitution, stiffness_ratio, law, name : fields of every wall, as of :class:`Plane`

    Raises CaromError, one line per problem.

    Examples
    --------
    >>> import carom
    >>> carom.scene.Strip(point=(0, 0, 0), normal=(1, 0, 0), width="40 cm").describe()
    'a strip of width 400 mm'
    """

    shape: Literal["strip"] = "strip"
    point: Point
    normal: Direction
    width: Size

    @property
    def bounded(self) -> bool:
        """Return False: it is infinite."""
        return False

    def features(self) -> list[Feature]:
        """Return two faces."""
        near = unit(self.normal)
        far: Vector = (-near[0], -near[1], -near[2])
        return [plane(self.point, near), plane(self._beyond, far)]

    @property
    def _beyond(self) -> Vector:
        p, d = self.point, unit(self.normal)
        return (p[0] + self.width * d[0], p[1] + self.width * d[1], p[2] + self.width * d[2])

    def outline(self) -> Outline:
        """Return the intersections of the planes with the floor."""
        d = unit(self.normal)
        return track(self.point, d) + track(self._beyond, d)

    def describe(self) -> str:
        """Return a description of a few words."""
        return f"a strip of width {format_length(self.width)}"

    def blocked(self, x: Vector) -> bool:
        """Return whether a point is not between the planes."""
        d = unit(self.normal)
        return dot(minus(x, self.point), d) < 0 or dot(minus(x, self._beyond), d) > 0

    def vertical(self, z: float) -> bool:
        """Return whether its normal is horizontal."""
        return abs(unit(self.normal)[2]) < LEVEL


class Wedge(WallShape):
    """Two half-planes that meet in a line, with the balls in the opening between them.

    Parameters
    ----------
    apex : 3 lengths, m: a point of the line
    axis : 3 numbers: direction of the line; default: vertical
    from_angle, to_angle : degrees: the opening, counterclockwise from one to the other as seen against the axis, from x (from y, if
        the axis is along x). An opening of more than 180 degrees has an edge; one of 360 is a half-plane that begins at the line
    restitution, friction, tangential_restitution, stiffness_ratio, law, name : fields of every wall, as of :class:`Plane`

    Raises CaromError, one line per problem.

    Examples
    --------
    >>> import carom
    >>> carom.scene.Wedge(apex=(0, 0, 0), from_angle=0, to_angle=60).describe()
    'a wedge of 60 degrees at (0, 0, 0)'
    """

    shape: Literal["wedge"] = "wedge"
    apex: Point
    axis: Direction = UP
    from_angle: Angle
    to_angle: Angle

    @model_validator(mode="after")
    def _opens(self) -> Wedge:
        if not 0 < self.opening_deg <= 360:
            got = f"{self.from_angle:g} to {self.to_angle:g}"
            raise_faults(
                [Fault("", "", "an opening of more than 0 and at most 360 degrees", got, "to_angle is the greater one")]
            )
        return self

    @property
    def opening_deg(self) -> float:
        """Return its opening angle, degrees."""
        return self.to_angle - self.from_angle

    opening = renamed_attribute("opening", "opening_deg")

    @property
    def bounded(self) -> bool:
        """Return False: it is infinite."""
        return False

    def _along(self, degrees: float) -> Vector:
        u, v = frame(unit(self.axis))
        c, s = direction(degrees)
        return (c * u[0] + s * v[0], c * u[1] + s * v[1], c * u[2] + s * v[2])

    def features(self) -> list[Feature]:
        """Return two faces, with an edge if the opening is wide."""
        axis = unit(self.axis)
        first, last = self._along(self.from_angle), self._along(self.to_angle)
        if self.opening_deg <= 180:
            return [plane(self.apex, cross(axis, first)), plane(self.apex, cross(last, axis))]
        return [
            Feature(FACE, self.apex, cross(axis, first), u=first, lo1=0.0),
            Feature(FACE, self.apex, cross(last, axis), u=last, lo1=0.0),
            line(self.apex, axis),
        ]

    def outline(self) -> Outline:
        """Return two rays from the apex; if the axis is not vertical, the intersections of the planes with the floor."""
        if not self.vertical(0.0):
            axis = unit(self.axis)
            return [
                one for a in (self.from_angle, self.to_angle) for one in track(self.apex, cross(axis, self._along(a)))
            ]
        ends = [self._along(angle) for angle in (self.from_angle, self.to_angle)]
        at = np.array(self.apex[:2])
        return [np.array([at + FAR * np.array(ends[0][:2]), at, at + FAR * np.array(ends[1][:2])])]

    def describe(self) -> str:
        """Return a description of a few words."""
        return f"a wedge of {self.opening_deg:g} degrees at {format_vector(self.apex)}"

    def blocked(self, x: Vector) -> bool:
        """Return whether a point is outside the opening."""
        r = minus(x, self.apex)
        u, v = frame(unit(self.axis))
        angle = math.degrees(math.atan2(dot(r, v), dot(r, u)))
        return (angle - self.from_angle) % 360 > self.opening_deg

    def vertical(self, z: float) -> bool:
        """Return whether its axis is vertical."""
        return abs(unit(self.axis)[2]) > 1 - LEVEL


class Box(WallShape):
    """A block along the axes, which balls meet from outside; or, ``inside``, a container.

    Parameters
    ----------
    center : 3 lengths, m; or
    corner : 3 lengths, m: the lowest corner in x, y and z
    size : 3 lengths, m: along x, y and z
    inside : whether the balls are inside; default: outside
    restitution, friction, tangential_restitution, stiffness_ratio, law, name : fields of every wall, as of :class:`Plane`

    Raises CaromError, one line per problem.

    Examples
    --------
    >>> import carom
    >>> box = carom.scene.Box(corner=(0, 0, 0), size=(2, 1, 1), inside=True)
    >>> box.describe(), box.high
    ('a container of 2 m by 1 m by 1 m', (2.0, 1.0, 1.0))
    """

    shape: Literal["box"] = "box"
    center: Point | None = None
    corner: Point | None = None
    size: Sizes
    inside: Flag = False

    @model_validator(mode="after")
    def _placed(self) -> Box:
        if (self.center is None) == (self.corner is None):
            got = "nothing" if self.center is None else "both"
            raise_faults([Fault("", "", "either center or corner (the lowest in x, y and z)", got)])
        return self

    @property
    def low(self) -> Vector:
        """Return its lowest corner (3,), m."""
        if self.corner is not None:
            return self.corner
        assert self.center is not None
        c, s = self.center, self.size
        return (c[0] - s[0] / 2, c[1] - s[1] / 2, c[2] - s[2] / 2)

    @property
    def high(self) -> Vector:
        """Return its highest corner (3,), m."""
        p, s = self.low, self.size
        return (p[0] + s[0], p[1] + s[1], p[2] + s[2])

    def features(self) -> list[Feature]:
        """Return six faces; from outside twelve edges and eight corners as well."""
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
        """Return a rectangle."""
        (x, y, _), (u, v, _) = self.low, self.high
        return [np.array([(x, y), (u, y), (u, v), (x, v), (x, y)])]

    def describe(self) -> str:
        """Return a description of a few words."""
        size = " by ".join(format_length(s) for s in self.size)
        return f"a {'container' if self.inside else 'box'} of {size}"

    def blocked(self, x: Vector) -> bool:
        """Return whether a point is in the block, or outside the container."""
        within = all(p < c < q for p, c, q in zip(self.low, x, self.high, strict=True))
        return within != self.inside

    def vertical(self, z: float) -> bool:
        """Return whether it extends below and above the balls' centres."""
        return self.low[2] <= z <= self.high[2]
