"""Walls made of planes: plane, strip, wedge, box."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Annotated, Any, ClassVar, Literal

import numpy as np
from pydantic import BeforeValidator, TypeAdapter, ValidationError, model_validator

from carom.core.geometry.circles import direction
from carom.core.geometry.features import FACE
from carom.core.jit.kernel import cross, dot, kernel
from carom.errors import shown
from carom.formatting import format_length
from carom.scene.feature_builders import (
    UP,
    frame,
    minus,
    point_along,
    put,
    put_corner,
    put_line,
    put_plane,
    put_upright,
    side_of,
    unit,
)
from carom.scene.ruled import FaultText, format_vector, put_fault
from carom.scene.schema import Angle, Components, Direction, Extent, Flag, Place, Point, Size, Sizes, Vector, refused
from carom.scene.wall import Outline, ShapeKernels, WallShape

FAR = 1e3  # m: how far to each side a line without end is drawn
LEVEL = 1e-12
Numbers = Sequence[float]


def track(p: Vector, d: Vector) -> Outline:
    """Return the line in which a plane through p with unit normal d intersects z = 0; none if it is horizontal."""
    flat = math.hypot(d[0], d[1])
    if flat < LEVEL:
        return []
    shift = p[2] * d[2] / (flat * flat)
    at, along = np.array([p[0] + shift * d[0], p[1] + shift * d[1]]), np.array([-d[1], d[0]]) / flat
    return [np.array([at - FAR * along, at + FAR * along])]


@kernel
def _plane_features(p: Numbers, out: Any) -> int:
    """Write one face."""
    return put_plane((p[0], p[1], p[2]), unit((p[3], p[4], p[5])), 0, out)


@kernel
def _behind_plane(p: Numbers, x: Vector) -> bool:
    """Return whether a point is behind it."""
    return dot(minus(x, (p[0], p[1], p[2])), (p[3], p[4], p[5])) < 0


@kernel
def _level_normal(p: Numbers, z: float) -> bool:
    """Return whether its normal is horizontal."""
    return abs(unit((p[3], p[4], p[5]))[2]) < LEVEL


class Plane(WallShape):
    """An infinite plane of any tilt; balls are on the side to which its normal points.

    Parameters
    ----------
    point : 3 lengths, m: a point of the plane
    normal : 3 numbers, of any length: its normal, towards the balls
    restitution, friction, tangential_restitution, stiffness_ratio, contact_time, yield_time, law, name : see the guide on scenes;
        fields of every wall

    Raises CaromError, one line per problem.

    Examples
    --------
    >>> import carom
    >>> carom.scene.Plane(point=(0, 0, 0), normal=(2, 0, 0), restitution=0.85, friction=0.2).describe()
    'a plane through (0, 0, 0) with normal (1, 0, 0)'
    """

    kernels: ClassVar = ShapeKernels(_plane_features, _behind_plane, _level_normal)
    shape: Literal["plane"] = "plane"
    point: Point
    normal: Direction

    @property
    def bounded(self) -> bool:
        """Return False: it is infinite."""
        return False

    def outline(self) -> Outline:
        """Return its intersection with the floor."""
        return track(self.point, unit(self.normal))

    def describe(self) -> str:
        """Return a description of a few words."""
        return f"a plane through {format_vector(self.point)} with normal {format_vector(unit(self.normal))}"


@kernel
def _strip_features(p: Numbers, out: Any) -> int:
    """Write two faces."""
    n = unit((p[3], p[4], p[5]))
    i = put_plane((p[0], p[1], p[2]), n, 0, out)
    return put_plane(point_along(p, p[6]), (-n[0], -n[1], -n[2]), i, out)


@kernel
def _beside_strip(p: Numbers, x: Vector) -> bool:
    """Return whether a point is not between the planes."""
    n = unit((p[3], p[4], p[5]))
    return dot(minus(x, (p[0], p[1], p[2])), n) < 0 or dot(minus(x, point_along(p, p[6])), n) > 0


class Strip(WallShape):
    """Two parallel planes with the balls between them.

    Parameters
    ----------
    point : 3 lengths, m: a point of the first plane
    normal : 3 numbers: its normal, towards the second plane
    width : m: distance of the planes
    restitution, friction, ..., law, name : the fields of every wall, as of :class:`Plane`

    Raises CaromError, one line per problem.

    Examples
    --------
    >>> import carom
    >>> carom.scene.Strip(point=(0, 0, 0), normal=(1, 0, 0), width="40 cm").describe()
    'a strip of width 400 mm'
    """

    kernels: ClassVar = ShapeKernels(_strip_features, _beside_strip, _level_normal)
    shape: Literal["strip"] = "strip"
    point: Point
    normal: Direction
    width: Size

    @property
    def bounded(self) -> bool:
        """Return False: it is infinite."""
        return False

    def outline(self) -> Outline:
        """Return the intersections of the planes with the floor."""
        d = unit(self.normal)
        return track(self.point, d) + track(point_along(self.numbers, self.numbers[6]), d)

    def describe(self) -> str:
        """Return a description of a few words."""
        return f"a strip of width {format_length(self.width)}"


@kernel
def _along(p: Numbers, degrees: float) -> Vector:
    """Return the unit vector at an angle from the first direction across the axis."""
    u, v = frame(unit((p[3], p[4], p[5])))
    c, s = direction(degrees)
    return (c * u[0] + s * v[0], c * u[1] + s * v[1], c * u[2] + s * v[2])


@kernel
def _wedge_features(p: Numbers, out: Any) -> int:
    """Write two faces, with an edge if the opening is wide."""
    apex, axis = (p[0], p[1], p[2]), unit((p[3], p[4], p[5]))
    first, last = _along(p, p[6]), _along(p, p[7])
    one, two = cross(axis, first), cross(last, axis)
    if p[7] - p[6] <= 180:
        return put_plane(apex, two, put_plane(apex, one, 0, out), out)
    i = put(out, 0, FACE, apex, one, 0.0, 1.0, first, 0.0, math.inf, -math.inf, math.inf, -1)
    i = put(out, i, FACE, apex, two, 0.0, 1.0, last, 0.0, math.inf, -math.inf, math.inf, -1)
    return put_line(apex, axis, -math.inf, math.inf, 0.0, 1.0, i, out)


@kernel
def _outside_wedge(p: Numbers, x: Vector) -> bool:
    """Return whether a point is outside the opening: behind one of the faces; of a wide one, behind both."""
    r, axis = minus(x, (p[0], p[1], p[2])), unit((p[3], p[4], p[5]))
    one, two = dot(r, cross(axis, _along(p, p[6]))) < 0, dot(r, cross(_along(p, p[7]), axis)) < 0
    return one or two if p[7] - p[6] <= 180 else one and two


@kernel
def _upright_axis(p: Numbers, z: float) -> bool:
    """Return whether its axis is vertical."""
    return abs(unit((p[3], p[4], p[5]))[2]) > 1 - LEVEL


@kernel
def _wedge_faults(p: Numbers, out: Any) -> int:
    """Report an opening of no angle, or of more than a turn."""
    return 0 if 0 < p[7] - p[6] <= 360 else put_fault(0, 0.0, 0.0, 0.0, 0, out)


def _degrees(field: str, value: Any) -> float:
    """Return an angle in degrees, as a field of a wall takes it."""
    try:
        return TypeAdapter(Angle).validate_python(value)
    except ValidationError:
        raise refused("an angle in degrees", shown(value), field=field) from None


class Wedge(WallShape):
    """Two half-planes that meet in a line, with the balls in the opening between them.

    Parameters
    ----------
    apex : 3 lengths, m: a point of the line
    axis : 3 numbers: direction of the line; default: vertical
    from_angle, to_angle : degrees: the opening, counterclockwise from one to the other as seen against the axis, from x (from y, if
        the axis is along x). An opening of more than 180 degrees has an edge; one of 360 is a half-plane that begins at the line
    angle : degrees, in place of to_angle: the opening; without from_angle as much on both sides, as of the figure of this name
    restitution, friction, ..., law, name : the fields of every wall, as of :class:`Plane`

    Raises CaromError, one line per problem.

    Examples
    --------
    >>> import carom
    >>> carom.scene.Wedge(apex=(0, 0, 0), from_angle=0, to_angle=60).describe()
    'a wedge of 60 degrees at (0, 0, 0)'
    """

    kernels: ClassVar = ShapeKernels(_wedge_features, _outside_wedge, _upright_axis, faults=_wedge_faults)
    fault_texts: ClassVar = (
        FaultText(
            "",
            "an opening of more than 0 and at most 360 degrees",
            "{from_angle:g} to {to_angle:g}",
            "to_angle is the greater one",
        ),
    )
    shape: Literal["wedge"] = "wedge"
    apex: Point
    axis: Direction = UP
    from_angle: Angle
    to_angle: Angle

    @model_validator(mode="before")
    @classmethod
    def _with_opening(cls, given: Any) -> Any:
        if not isinstance(given, dict) or "angle" not in given:
            return given
        if "to_angle" in given:
            raise refused("either angle or to_angle", "both", field="angle")
        rest = {name: value for name, value in given.items() if name != "angle"}
        opening = _degrees("angle", given["angle"])
        begin = _degrees("from_angle", given.get("from_angle", -opening / 2))
        return {**rest, "from_angle": begin, "to_angle": begin + opening}

    @property
    def opening_deg(self) -> float:
        """Return its opening angle, degrees."""
        return self.to_angle - self.from_angle

    @property
    def bounded(self) -> bool:
        """Return False: it is infinite."""
        return False

    def outline(self) -> Outline:
        """Return two rays from the apex; if the axis is not vertical, the intersections of the planes with the floor."""
        ends = [_along(self.numbers, angle) for angle in (self.from_angle, self.to_angle)]
        if not self.vertical(0.0):
            axis = unit(self.axis)
            return [one for end in ends for one in track(self.apex, cross(axis, end))]
        at = np.array(self.apex[:2])
        return [np.array([at + FAR * np.array(ends[0][:2]), at, at + FAR * np.array(ends[1][:2])])]

    def describe(self) -> str:
        """Return a description of a few words."""
        return f"a wedge of {self.opening_deg:g} degrees at {format_vector(self.apex)}"


AXES: tuple[Vector, Vector, Vector] = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


@kernel
def _low(p: Numbers) -> Vector:
    """Return its lowest corner: as it is given, or from its centre and its size."""
    if p[3] == p[3]:
        return (p[3], p[4], p[5])
    return (p[0] - p[6] / 2, p[1] - p[7] / 2, p[2] - p[8] / 2)


@kernel
def _high(p: Numbers) -> Vector:
    low = _low(p)
    return (low[0] + p[6], low[1] + p[7], low[2] + p[8])


@kernel
def _box_features(p: Numbers, out: Any) -> int:
    """Write six faces; from outside twelve edges and eight corners as well."""
    low, high, inside = _low(p), _high(p), p[9] != 0
    i = 0
    for k in range(3):
        a, b, e = (k + 1) % 3, (k + 2) % 3, AXES[k]
        for far in (False, True):
            way = 1.0 if far != inside else -1.0
            d = (way * e[0], way * e[1], way * e[2])
            if inside:
                i = put_plane(high if far else low, d, i, out)
                continue
            # u is the next axis, so that d x u is the one after it, or its opposite
            at = (
                high[0] if far and k == 0 else low[0], high[1] if far and k == 1 else low[1], high[2] if far and k == 2 else low[2]
            )  # fmt: skip
            below, above = (0.0, p[6 + b]) if way > 0 else (-p[6 + b], 0.0)
            i = put(out, i, FACE, at, d, 0.0, 1.0, AXES[a], 0.0, p[6 + a], below, above, -1)
    if inside:
        return i
    for k in range(3):
        a, b = (k + 1) % 3, (k + 2) % 3
        for one in (False, True):
            for two in (False, True):
                at = (
                    high[0] if (one and a == 0) or (two and b == 0) else low[0],
                    high[1] if (one and a == 1) or (two and b == 1) else low[1],
                    high[2] if (one and a == 2) or (two and b == 2) else low[2],
                )
                i = put_line(at, AXES[k], 0.0, p[6 + k], 0.0, 1.0, i, out)
    for x in (low[0], high[0]):
        for y in (low[1], high[1]):
            for z in (low[2], high[2]):
                i = put_corner((x, y, z), 0.0, 1.0, i, out)
    return i


@kernel
def _blocked_by_box(p: Numbers, x: Vector) -> bool:
    """Return whether a point is in the block, or outside the container."""
    q, r = _low(p), _high(p)
    return (q[0] < x[0] < r[0] and q[1] < x[1] < r[1] and q[2] < x[2] < r[2]) != (p[9] != 0)


@kernel
def _beside_box(p: Numbers, z: float) -> bool:
    """Return whether it extends below and above the balls' centres."""
    return _low(p)[2] <= z <= _high(p)[2]


@kernel
def _box_faults(p: Numbers, out: Any) -> int:
    """Report a box without a place, and one with two."""
    centre, corner = p[0] == p[0], p[3] == p[3]
    return 0 if centre != corner else put_fault(1 if centre else 0, 0.0, 0.0, 0.0, 0, out)


class Box(WallShape):
    """A block along the axes, which balls meet from outside; or, ``inside``, a container.

    Parameters
    ----------
    center : 3 lengths, m; or
    corner : 3 lengths, m: the lowest corner in x, y and z
    size : 3 lengths, m: along x, y and z
    inside : whether the balls are inside; default: outside
    restitution, friction, ..., law, name : the fields of every wall, as of :class:`Plane`

    Raises CaromError, one line per problem.

    Examples
    --------
    >>> import carom
    >>> box = carom.scene.Box(corner=(0, 0, 0), size=(2, 1, 1), inside=True)
    >>> box.describe(), box.high
    ('a container of 2 m by 1 m by 1 m', (2.0, 1.0, 1.0))
    """

    kernels: ClassVar = ShapeKernels(_box_features, _blocked_by_box, _beside_box, faults=_box_faults)
    fault_texts: ClassVar = tuple(
        FaultText("", "either center or corner (the lowest in x, y and z)", got) for got in ("nothing", "both")
    )
    shape: Literal["box"] = "box"
    center: Point | None = None
    corner: Point | None = None
    size: Sizes
    inside: Flag = False

    @property
    def low(self) -> Vector:
        """Return its lowest corner (3,), m."""
        return _low(self.numbers)

    @property
    def high(self) -> Vector:
        """Return its highest corner (3,), m."""
        return _high(self.numbers)

    def outline(self) -> Outline:
        """Return a rectangle."""
        (x, y, _), (u, v, _) = self.low, self.high
        return [np.array([(x, y), (u, y), (u, v), (x, v), (x, y)])]

    def describe(self) -> str:
        """Return a description of a few words."""
        size = " by ".join(format_length(s) for s in self.size)
        return f"a {'container' if self.inside else 'box'} of {size}"


# ----------------------------------------------------------------------------------------------------
# Upright walls along straight lines: segment, polygon.


LEVELS = FaultText("height", "a height above low = {low:g} m", "{height}")


@kernel
def stands(p: Numbers, z: float) -> bool:
    """Return whether an upright wall extends below and above the balls' centres; its first numbers are ``low`` and ``height``."""
    return p[0] <= z <= p[1]


@kernel
def level_faults(p: Numbers, out: Any) -> int:
    """Report heights in the wrong order, as the first fault of an upright wall."""
    sound = p[0] <= p[1] and p[0] < math.inf and p[1] > -math.inf
    return 0 if sound else put_fault(0, 0.0, 0.0, 0.0, 0, out)


class Standing(WallShape):
    """A vertical wall between two heights, ``low`` and ``height``; default: infinitely low and high."""

    low: Extent = -math.inf
    height: Extent = math.inf

    def _tall(self) -> str:
        return f", {format_length(self.height)} high" if math.isfinite(self.height) else ""


@kernel
def _segment_features(p: Numbers, out: Any) -> int:
    """Write two faces, ends, edges, corners, and gates."""
    return put_upright(p, 2, 2, False, False, p[0], p[1], 0, out)


@kernel
def _segment_faults(p: Numbers, out: Any) -> int:
    """Report heights in the wrong order, and a segment of no length."""
    i = level_faults(p, out)
    return put_fault(1, 0.0, 0.0, 0.0, i, out) if p[2] == p[4] and p[3] == p[5] else i


class Segment(Standing):
    """A thin vertical wall between two points, which balls meet from both sides and at its ends.

    Parameters
    ----------
    start, end : 2 lengths, m, as seen from above
    low, height : m: the heights between which it stands; default: infinitely low and high
    restitution, friction, tangential_restitution, stiffness_ratio, contact_time, yield_time, law, name : fields of every wall, as
        of :class:`Plane`

    Raises CaromError, one line per problem.

    Examples
    --------
    >>> import carom
    >>> carom.scene.Segment(start=(0, 0), end=(1, 0), height="40 mm").height
    0.04
    """

    kernels: ClassVar = ShapeKernels(_segment_features, vertical=stands, faults=_segment_faults)
    fault_texts: ClassVar = (LEVELS, FaultText("end", "another point than start", "{end}"))
    shape: Literal["segment"] = "segment"
    start: Place
    end: Place

    def outline(self) -> Outline:
        """Return a line."""
        return [np.array([self.start, self.end])]

    def describe(self) -> str:
        """Return a description of a few words."""
        return f"a segment from {format_vector(self.start)} to {format_vector(self.end)}{self._tall()}"


@kernel
def _clockwise(p: Numbers, count: int) -> bool:
    """Return whether a closed outline is gone round clockwise."""
    area = 0.0
    for k in range(count):
        x, y, x2, y2 = side_of(p, 3, count, False, k)
        area = area + (x * y2 - y * x2)
    return area < 0


@kernel
def _polygon_features(p: Numbers, out: Any) -> int:
    """Write two faces, edges and gates for each side; a vertical edge and corners for each point."""
    count = int(p[2])
    closed = p[3 + 2 * count] != 0
    return put_upright(p, 3, count, closed and _clockwise(p, count), closed, p[0], p[1], 0, out)


@kernel
def _closed(p: Numbers) -> bool:
    return p[3 + 2 * int(p[2])] != 0


@kernel
def _turn(x: float, y: float, x2: float, y2: float, x3: float, y3: float) -> float:
    """Return the orientation of a triangle: above 0 counterclockwise, below 0 clockwise, 0 collinear."""
    return (x2 - x) * (y3 - y) - (y2 - y) * (x3 - x)


@kernel
def _on(x: float, y: float, x2: float, y2: float, x3: float, y3: float) -> bool:
    """Return whether the third point is on the side between the others."""
    within = min(x, x2) <= x3 <= max(x, x2) and min(y, y2) <= y3 <= max(y, y2)
    return within and _turn(x, y, x2, y2, x3, y3) == 0


@kernel
def _first_crossing(p: Numbers, count: int, sides: int, i: int) -> int:
    """Return the first later side that side i meets other than end to end; 0 for none."""
    x, y, x2, y2 = side_of(p, 3, count, False, i)
    left, right, below, above = min(x, x2), max(x, x2), min(y, y2), max(y, y2)
    for j in range(i + 1, sides):
        u, v, u2, v2 = side_of(p, 3, count, False, j)
        if (
            (u > right and u2 > right)
            or (u < left and u2 < left)
            or (v > above and v2 > above)
            or (v < below and v2 < below)
        ):
            continue
        one, two = _turn(x, y, x2, y2, u, v), _turn(x, y, x2, y2, u2, v2)
        three, four = _turn(u, v, u2, v2, x, y), _turn(u, v, u2, v2, x2, y2)
        if ((one < 0 < two) or (two < 0 < one)) and ((three < 0 < four) or (four < 0 < three)):
            return j
        # each side is asked for its start and its end; where the last one ends, the first one starts
        joined = sides == count and i == 0 and j == sides - 1
        if not joined and (_on(x, y, x2, y2, u2, v2) or _on(u, v, u2, v2, x, y)):
            return j
    return 0


@kernel
def _polygon_faults(p: Numbers, out: Any) -> int:
    """Report heights in the wrong order, and where an outline repeats a point, or meets itself."""
    found = first = level_faults(p, out)
    count = int(p[2])
    sides = count if _closed(p) else count - 1
    for k in range(sides):
        x, y, x2, y2 = side_of(p, 3, count, False, k)
        if x == x2 and y == y2:
            found = put_fault(1, (k + 1) % count, x, y, found, out)
    if found > first:
        return found
    for i in range(sides - 1):
        j = _first_crossing(p, count, sides, i)
        if j > 0:
            return put_fault(2, i, j, 0.0, found, out)
    return found


class Polygon(Standing):
    """Thin vertical walls from point to point, which balls meet from both sides.

    Parameters
    ----------
    points : at least 3 times 2 lengths, m, as seen from above
    closed : whether a wall leads from the last point to the first; default: yes
    low, height : m: the heights between which they stand; default: infinitely low and high
    restitution, friction, ..., law, name : the fields of every wall, as of :class:`Plane`

    Raises CaromError, one line per problem: sides that cross, too.

    Examples
    --------
    >>> import carom
    >>> triangle = carom.scene.Polygon(points=[(0, 0), (1, 0), (0, 1)])
    >>> triangle.encloses
    True
    """

    kernels: ClassVar = ShapeKernels(_polygon_features, vertical=stands, encloses=_closed, faults=_polygon_faults)
    fault_texts: ClassVar = (
        LEVELS,
        FaultText("points[{a:g}]", "another point than the one before", "[{b}, {c}]"),
        FaultText(
            "points",
            "an outline that does not meet itself",
            "sides {a:g} and {b:g} that meet",
            "give the points in order",
        ),
    )
    shape: Literal["polygon"] = "polygon"
    points: Annotated[tuple[Place, ...], BeforeValidator(Components("at least 3 points [x, y]", range(3, 1_000_000)))]
    closed: Flag = True

    def outline(self) -> Outline:
        """Return its sides."""
        return [np.array([*self.points, self.points[0]] if self.closed else self.points)]

    def describe(self) -> str:
        """Return a description of a few words."""
        return f"a polygon of {len(self.points)} points{'' if self.closed else ', open'}{self._tall()}"
