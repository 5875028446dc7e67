"""Upright walls along straight lines: segment, polygon."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Annotated, Any, ClassVar, Literal

import numpy as np
from pydantic import BeforeValidator

from carom.core.jit.kernel import kernel
from carom.formatting import format_length
from carom.scene.feature_builders import put_upright, side_of
from carom.scene.ruled import FaultText, format_vector, put_fault
from carom.scene.schema import Components, Extent, Flag, Place
from carom.scene.wall import Outline, ShapeKernels, WallShape

__all__ = ["LEVELS", "Polygon", "Segment", "Standing", "level_faults", "stands"]

Numbers = Sequence[float]
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
