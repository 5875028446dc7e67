"""Round walls: cylinder, sphere, arc."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, ClassVar, Literal

import numpy as np

from carom.core.geometry.circles import direction
from carom.core.geometry.features import LINE, OVER
from carom.core.jit.kernel import dot, kernel
from carom.formatting import format_length
from carom.scene.feature_builders import (
    UP,
    across,
    circle,
    frame,
    minus,
    point_along,
    put_corner,
    put_disc,
    put_ends,
    put_line,
    put_rim,
    put_rims,
    put_round,
    unit,
)
from carom.scene.ruled import FaultText, format_vector, put_fault
from carom.scene.schema import Angle, Direction, Extent, Flag, Place, Point, Size, Vector
from carom.scene.shapes.planes import FAR, LEVEL, LEVELS, Standing, level_faults, stands
from carom.scene.wall import Outline, ShapeKernels, WallShape

Numbers = Sequence[float]


@kernel
def _cylinder_features(p: Numbers, out: Any) -> int:
    """Write a line with a radius; of a finite one also two discs, or its outer side, and two rims."""
    at, d, R, inside, length = (p[0], p[1], p[2]), unit((p[3], p[4], p[5])), p[6], p[7] != 0, p[8]
    if not length < math.inf:
        return put_line(at, d, -math.inf, math.inf, R, -1.0 if inside else 1.0, 0, out)
    i = put_line(at, d, 0.0, length, R, -1.0, 0, out) if inside else 0
    i = put_line(at, d, 0.0, length, R, 1.0, i, out)
    if not inside:
        i = put_disc(at, (-d[0], -d[1], -d[2]), R, i, out)
        i = put_disc(point_along(p, p[8]), d, R, i, out)
    i = put_rim(at, d, R, frame(d)[0], -1.0, i, out)
    return put_rim(point_along(p, p[8]), d, R, frame(d)[0], -1.0, i, out)


@kernel
def _blocked_by_cylinder(p: Numbers, x: Vector) -> bool:
    """Return whether a point is in the pillar, or outside an infinite tube."""
    r, d, R, inside = minus(x, (p[0], p[1], p[2])), unit((p[3], p[4], p[5])), p[6], p[7] != 0
    off = across(r, d)
    far = math.sqrt(dot(off, off))
    if p[8] < math.inf:
        return not inside and far < R and 0 < dot(r, d) < p[8]
    return far > R if inside else far < R


@kernel
def _vertical_cylinder(p: Numbers, z: float) -> bool:
    """Return whether its axis is vertical, and it extends below and above the balls' centres."""
    one, two = (p[2], point_along(p, p[8])[2]) if p[8] < math.inf else (-math.inf, math.inf)
    return abs(unit((p[3], p[4], p[5]))[2]) > 1 - LEVEL and min(one, two) <= z <= max(one, two)


@kernel
def _room_in_tube(p: Numbers) -> float:
    """Return its radius if balls are inside; infinity if it is open, as there is room outside."""
    return p[6] if p[7] != 0 and not p[8] < math.inf else math.inf


@kernel
def _cylinder_faults(p: Numbers, out: Any) -> int:
    return 0 if p[8] > 0 else put_fault(0, 0.0, 0.0, 0.0, 0, out)


class Cylinder(WallShape):
    """A round pillar of any tilt, which balls meet from outside; or, ``inside``, a tube.

    Parameters
    ----------
    point : 3 lengths, m: a point of the axis; with a height, the centre of the first end
    axis : 3 numbers: direction of the axis; default: vertical
    radius : m
    inside : whether it is a tube with the balls inside; default: a pillar
    height : m, along the axis; default: infinite. A pillar is closed by two discs; a tube is open and thin, and is met from outside
        as well
    restitution, friction, ..., law, name : the fields of every wall, as of :class:`Plane`

    Raises CaromError, one line per problem.

    Examples
    --------
    >>> import carom
    >>> carom.scene.Cylinder(point=(0, 0, 0), radius=0.5, inside=True).room
    0.5
    """

    kernels: ClassVar = ShapeKernels(
        _cylinder_features, _blocked_by_cylinder, _vertical_cylinder, room=_room_in_tube, faults=_cylinder_faults
    )
    fault_texts: ClassVar = (FaultText("height", "a length greater than 0 m", "{height}"),)
    shape: Literal["cylinder"] = "cylinder"
    point: Point
    axis: Direction = UP
    radius: Size
    inside: Flag = False
    height: Extent = math.inf

    @property
    def _ends(self) -> bool:
        return self.height < math.inf

    @property
    def bounded(self) -> bool:
        """Return whether it is vertical, or finite."""
        return self._ends or self._upright

    def outline(self) -> Outline:
        """Return a circle; of a tilted one its two sides, or its outline."""
        if self._upright:
            return [circle(self.point, self.radius)]
        x, y, _z = unit((*self.axis[:2], 0.0))
        off = self.radius * np.array([-y, x])
        if self._ends:
            one, two = np.array(self.point[:2]), np.array(point_along(self.numbers, self.numbers[8])[:2])
            return [np.array([one + off, two + off, two - off, one - off, one + off])]
        at, along = np.array(self.point[:2]), np.array([x, y])
        return [np.array([at + s * off - FAR * along, at + s * off + FAR * along]) for s in (1.0, -1.0)]

    def describe(self) -> str:
        """Return a description of a few words."""
        long = f", {format_length(self.height)} long" if self._ends else ""
        kind = "tube" if self.inside else "cylinder"
        return f"a {kind} of radius {format_length(self.radius)}{long} at {format_vector(self.point)}"

    @property
    def _upright(self) -> bool:
        return abs(unit(self.axis)[2]) > 1 - LEVEL


@kernel
def _sphere_features(p: Numbers, out: Any) -> int:
    """Write a point with a radius."""
    return put_corner((p[0], p[1], p[2]), p[3], -1.0 if p[4] != 0 else 1.0, 0, out)


@kernel
def _blocked_by_sphere(p: Numbers, x: Vector) -> bool:
    """Return whether a point is in the sphere, or, with the balls inside, outside it."""
    r = minus(x, (p[0], p[1], p[2]))
    far = math.sqrt(dot(r, r))
    return far > p[3] if p[4] != 0 else far < p[3]


@kernel
def _at_equator(p: Numbers, z: float) -> bool:
    """Return whether its centre and the balls' have the same height."""
    return abs(z - p[2]) < LEVEL * p[3]


@kernel
def _room_in_sphere(p: Numbers) -> float:
    """Return its radius if balls are inside, else infinity."""
    return p[3] if p[4] != 0 else math.inf


class Sphere(WallShape):
    """A fixed sphere, which balls meet from outside or, ``inside``, from inside.

    Parameters
    ----------
    center : 3 lengths, m
    radius : m
    inside : whether the balls are inside; default: outside
    restitution, friction, tangential_restitution, stiffness_ratio, contact_time, yield_time, law, name : fields of every wall, as
        of :class:`Plane`

    Raises CaromError, one line per problem.

    Examples
    --------
    >>> import carom
    >>> carom.scene.Sphere(center=(0, 0, 0), radius=1, inside=True).describe()
    'a sphere of radius 1 m at (0, 0, 0), balls inside'
    """

    kernels: ClassVar = ShapeKernels(_sphere_features, _blocked_by_sphere, _at_equator, room=_room_in_sphere)
    shape: Literal["sphere"] = "sphere"
    center: Point
    radius: Size
    inside: Flag = False

    def outline(self) -> Outline:
        """Return a circle."""
        return [circle(self.center, self.radius)]

    def describe(self) -> str:
        """Return a description of a few words."""
        where = ", balls inside" if self.inside else ""
        return f"a sphere of radius {format_length(self.radius)} at {format_vector(self.center)}{where}"


@kernel
def _full(p: Numbers) -> bool:
    """Return whether it is a full circle."""
    return p[6] - p[5] >= 360


@kernel
def _arc_features(p: Numbers, out: Any) -> int:
    """Write its concave and convex sides, rims, ends, corners, and gates."""
    low, high, x, y, R, start, end = p[0], p[1], p[2], p[3], p[4], p[5], p[6]
    span, full = end - start, _full(p)
    middle = direction(start + span / 2)
    u = (middle[0], middle[1], 0.0)
    cosine = -1.0 if full else direction(span / 2)[0]
    i = 0
    if low < high:
        i = put_round(LINE, x, y, R, -1.0, u, cosine, low, high, i, out)
        i = put_round(LINE, x, y, R, 1.0, u, cosine, low, high, i, out)
    i = put_rims(x, y, R, u, cosine, low, high, i, out)
    if not full:
        for degrees in (start, end):
            c, s = direction(degrees)
            i = put_ends(x + R * c, y + R * s, low, high, i, out)
    if high < math.inf:
        i = put_round(OVER, x, y, R, -1.0, u, cosine, high, math.inf, i, out)
        if not full:
            i = put_round(OVER, x, y, R, 1.0, u, cosine, high, math.inf, i, out)
    return i


@kernel
def _arc_faults(p: Numbers, out: Any) -> int:
    """Report heights in the wrong order, and an arc of no angle, or of more than a turn."""
    i = level_faults(p, out)
    return i if 0 < p[6] - p[5] <= 360 else put_fault(1, 0.0, 0.0, 0.0, i, out)


class Arc(Standing):
    """A thin vertical wall along an arc of a circle, which balls meet from both sides.

    Parameters
    ----------
    center : 2 lengths, m: centre of the circle, as seen from above
    radius : m
    from_angle, to_angle : degrees from x: the arc, counterclockwise from one to the other
    low, height : m: the heights between which it stands; default: infinitely low and high
    restitution, friction, ..., law, name : the fields of every wall, as of :class:`Plane`

    Raises CaromError, one line per problem.

    Examples
    --------
    >>> import carom
    >>> carom.scene.Arc(center=(0, 0), radius=1, from_angle=30, to_angle=120).span_deg
    90.0
    """

    kernels: ClassVar = ShapeKernels(_arc_features, vertical=stands, encloses=_full, faults=_arc_faults)
    fault_texts: ClassVar = (
        LEVELS,
        FaultText(
            "",
            "an arc of more than 0 and at most 360 degrees",
            "{from_angle:g} to {to_angle:g}",
            "to_angle is the greater one",
        ),
    )
    shape: Literal["arc"] = "arc"
    center: Place
    radius: Size
    from_angle: Angle
    to_angle: Angle

    @property
    def span_deg(self) -> float:
        """Return its angle, degrees."""
        return self.to_angle - self.from_angle

    def outline(self) -> Outline:
        """Return an arc."""
        return [circle(self.center, self.radius, math.radians(self.from_angle), math.radians(self.to_angle))]

    def describe(self) -> str:
        """Return a description of a few words."""
        radius, center = format_length(self.radius), format_vector(self.center)
        return f"an arc of {self.span_deg:g} degrees, radius {radius}, around {center}{self._tall()}"
