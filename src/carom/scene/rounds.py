"""Round walls: cylinder, sphere, arc, stadium."""

from __future__ import annotations

import math
from typing import Literal

import numpy as np
from pydantic import model_validator

from carom.core.geometry.angles import direction
from carom.core.geometry.features import FACE, LINE, OVER, POINT
from carom.core.jit.kernel import dot
from carom.errors import Fault, FaultList, shown
from carom.formatting import format_length
from carom.public.renamed import renamed_attribute
from carom.scene.feature_builders import (
    UP,
    Feature,
    Flat,
    across,
    circle,
    corner,
    disc,
    line,
    minus,
    post,
    rim,
    unit,
)
from carom.scene.planes import FAR, LEVEL
from carom.scene.schema import Angle, Direction, Extent, Flag, Place, Point, Size, Vector, raise_faults
from carom.scene.segments import Standing
from carom.scene.wall import Outline, WallShape, format_vector

__all__ = ["Arc", "Cylinder", "Sphere", "Stadium"]


class Cylinder(WallShape):
    """A round pillar of any tilt, which balls meet from outside; or, ``inside``, a tube.

    Parameters
    ----------
    point : 3 lengths, m: a point of the axis; with a length, the centre of the first end
    axis : 3 numbers: direction of the axis; default: vertical
    radius : m
    inside : whether it is a tube with the balls inside; default: a pillar
    length : m; default: infinite. A pillar is closed by two discs; a tube is open and thin, and is met from outside as well
    restitution, friction, tangential_restitution, stiffness_ratio, law, name : fields of every wall, as of :class:`Plane`

    Raises CaromError, one line per problem.

    Examples
    --------
    >>> import carom
    >>> carom.scene.Cylinder(point=(0, 0, 0), radius=0.5, inside=True).room
    0.5
    """

    shape: Literal["cylinder"] = "cylinder"
    point: Point
    axis: Direction = UP
    radius: Size
    inside: Flag = False
    length: Extent = math.inf

    @model_validator(mode="after")
    def _has_length(self) -> Cylinder:
        raise_faults([] if self.length > 0 else [Fault("", "length", "a length greater than 0 m", shown(self.length))])
        return self

    @property
    def _ends(self) -> bool:
        return self.length < math.inf

    @property
    def bounded(self) -> bool:
        """Return whether it is vertical, or finite."""
        return self._ends or self._upright

    @property
    def room(self) -> float:
        """Return its radius if balls are inside; infinity if it is open, as there is room outside."""
        return self.radius if self.inside and not self._ends else math.inf

    def _far_end(self) -> Vector:
        p, d = self.point, unit(self.axis)
        return (p[0] + self.length * d[0], p[1] + self.length * d[1], p[2] + self.length * d[2])

    def features(self) -> list[Feature]:
        """Return a line with a radius; of a finite one also two discs, or its outer side, and two rims."""
        p, d, R = self.point, unit(self.axis), self.radius
        if not self._ends:
            return [line(p, d, R=R, side=-1.0 if self.inside else 1.0)]
        found = [line(p, d, 0.0, self.length, R, side) for side in ((-1.0, 1.0) if self.inside else (1.0,))]
        if not self.inside:
            found += [disc(p, (-d[0], -d[1], -d[2]), R), disc(self._far_end(), d, R)]
        return [*found, rim(p, d, R), rim(self._far_end(), d, R)]

    def outline(self) -> Outline:
        """Return a circle; of a tilted one its two sides, or its outline."""
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
        """Return a description of a few words."""
        long = f", {format_length(self.length)} long" if self._ends else ""
        kind = "tube" if self.inside else "cylinder"
        return f"a {kind} of radius {format_length(self.radius)}{long} at {format_vector(self.point)}"

    def blocked(self, x: Vector) -> bool:
        """Return whether a point is in the pillar, or outside an infinite tube."""
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
        """Return whether its axis is vertical, and it extends below and above the balls' centres."""
        ends = (self.point[2], self._far_end()[2]) if self._ends else (-math.inf, math.inf)
        return self._upright and min(ends) <= z <= max(ends)


class Sphere(WallShape):
    """A fixed sphere, which balls meet from outside or, ``inside``, from inside.

    Parameters
    ----------
    center : 3 lengths, m
    radius : m
    inside : whether the balls are inside; default: outside
    restitution, friction, tangential_restitution, stiffness_ratio, law, name : fields of every wall, as of :class:`Plane`

    Raises CaromError, one line per problem.

    Examples
    --------
    >>> import carom
    >>> carom.scene.Sphere(center=(0, 0, 0), radius=1, inside=True).describe()
    'a sphere of radius 1 m at (0, 0, 0), balls inside'
    """

    shape: Literal["sphere"] = "sphere"
    center: Point
    radius: Size
    inside: Flag = False

    @property
    def room(self) -> float:
        """Return its radius if balls are inside, else infinity."""
        return self.radius if self.inside else math.inf

    def features(self) -> list[Feature]:
        """Return a point with a radius."""
        return [Feature(POINT, self.center, R=self.radius, side=-1.0 if self.inside else 1.0)]

    def outline(self) -> Outline:
        """Return a circle."""
        return [circle(self.center, self.radius)]

    def describe(self) -> str:
        """Return a description of a few words."""
        where = ", balls inside" if self.inside else ""
        return f"a sphere of radius {format_length(self.radius)} at {format_vector(self.center)}{where}"

    def blocked(self, x: Vector) -> bool:
        """Return whether a point is in the sphere, or, with the balls inside, outside it."""
        far = math.dist(x, self.center)
        return far > self.radius if self.inside else far < self.radius

    def vertical(self, z: float) -> bool:
        """Return whether its centre and the balls' have the same height."""
        return abs(z - self.center[2]) < LEVEL * self.radius


class Arc(Standing):
    """A thin vertical wall along an arc of a circle, which balls meet from both sides.

    Parameters
    ----------
    center : 2 lengths, m: centre of the circle, as seen from above
    radius : m
    from_angle, to_angle : degrees from x: the arc, counterclockwise from one to the other
    low, height : m: the heights between which it stands; default: infinitely low and high
    restitution, friction, tangential_restitution, stiffness_ratio, law, name : fields of every wall, as of :class:`Plane`

    Raises CaromError, one line per problem.

    Examples
    --------
    >>> import carom
    >>> carom.scene.Arc(center=(0, 0), radius=1, from_angle=30, to_angle=120).span_deg
    90.0
    """

    shape: Literal["arc"] = "arc"
    center: Place
    radius: Size
    from_angle: Angle
    to_angle: Angle

    @model_validator(mode="after")
    def _opens(self) -> Arc:
        found = FaultList()
        found += self._levels()
        if not 0 < self.span_deg <= 360:
            got = f"{self.from_angle:g} to {self.to_angle:g}"
            found.add("", "an arc of more than 0 and at most 360 degrees", got, "to_angle is the greater one")
        raise_faults(found)
        return self

    @property
    def encloses(self) -> bool:
        """Return whether it is a full circle."""
        return self.span_deg >= 360

    @property
    def span_deg(self) -> float:
        """Return its angle, degrees."""
        return self.to_angle - self.from_angle

    span = renamed_attribute("span", "span_deg")

    def _at(self, degrees: float) -> Flat:
        c, s = direction(degrees)
        return (self.center[0] + self.radius * c, self.center[1] + self.radius * s)

    def features(self) -> list[Feature]:
        """Return its concave and convex sides, rims, ends, corners, and gates."""
        u = (*direction(self.from_angle + self.span_deg / 2), 0.0)
        cosine = -1.0 if self.encloses else direction(self.span_deg / 2)[0]
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
        """Return an arc."""
        return [circle(self.center, self.radius, math.radians(self.from_angle), math.radians(self.to_angle))]

    def describe(self) -> str:
        """Return a description of a few words."""
        radius, center = format_length(self.radius), format_vector(self.center)
        return f"an arc of {self.span_deg:g} degrees, radius {radius}, around {center}{self._tall()}"


class Stadium(WallShape):
    """Two parallel walls joined by half circles, with the balls inside: Bunimovich's stadium.

    Source: L. A. Bunimovich, Commun. Math. Phys. 65, 295 (1979), https://doi.org/10.1007/BF01197884.

    Parameters
    ----------
    length : m: of the straight walls
    radius : m: of the half circles
    center : 2 lengths, m, as seen from above; default: the origin
    angle : degrees from x: direction of the straight walls; default: 0
    restitution, friction, tangential_restitution, stiffness_ratio, law, name : fields of every wall, as of :class:`Plane`

    Raises CaromError, one line per problem.

    Examples
    --------
    >>> import carom
    >>> carom.scene.Stadium(length=1, radius=0.5).room
    0.5
    """

    shape: Literal["stadium"] = "stadium"
    length: Size
    radius: Size
    center: Place = (0.0, 0.0)
    angle: Angle = 0.0

    @property
    def room(self) -> float:
        """Return its radius."""
        return self.radius

    def _frame(self) -> tuple[Flat, Flat]:
        c, s = direction(self.angle)
        return (c, s), (-s, c)

    def _point(self, along: float, off: float) -> Flat:
        t, n = self._frame()
        return (self.center[0] + along * t[0] + off * n[0], self.center[1] + along * t[1] + off * n[1])

    def features(self) -> list[Feature]:
        """Return two faces and two half cylinders."""
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
        """Return its closed outline."""
        turn, half = math.radians(self.angle), self.length / 2
        right = circle(self._point(half, 0.0), self.radius, turn - math.pi / 2, turn + math.pi / 2)
        left = circle(self._point(-half, 0.0), self.radius, turn + math.pi / 2, turn + 3 * math.pi / 2)
        return [np.concatenate((right, left, right[:1]))]

    def describe(self) -> str:
        """Return a description of a few words."""
        return f"a stadium of {format_length(self.length)} between half circles of radius {format_length(self.radius)}"

    def blocked(self, x: Vector) -> bool:
        """Return whether a point is outside."""
        (tx, ty), (dx, dy) = self._frame()[0], (x[0] - self.center[0], x[1] - self.center[1])
        along, off = dx * tx + dy * ty, dy * tx - dx * ty
        return math.hypot(max(abs(along) - self.length / 2, 0.0), off) > self.radius
