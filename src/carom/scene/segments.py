"""Upright walls along straight lines: segment, polygon."""

from __future__ import annotations

import math
from typing import Annotated, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import BeforeValidator, model_validator

from carom.errors import Fault, shown
from carom.formatting import format_length
from carom.scene.feature_builders import Feature, upright
from carom.scene.schema import Components, Extent, Flag, Place, raise_faults
from carom.scene.wall import Outline, WallShape, format_vector

__all__ = ["Polygon", "Segment", "Standing"]

Array = NDArray[np.float64]


class Standing(WallShape):
    """A vertical wall between two heights, ``low`` and ``height``; default: infinitely low and high."""

    low: Extent = -math.inf
    height: Extent = math.inf

    def _levels(self) -> list[Fault]:
        if self.low <= self.height and self.low < math.inf and self.height > -math.inf:
            return []
        return [Fault("", "height", f"a height above low = {self.low:g} m", shown(self.height))]

    def vertical(self, z: float) -> bool:
        """Return whether it extends below and above the balls' centres."""
        return self.low <= z <= self.height

    def _tall(self) -> str:
        return f", {format_length(self.height)} high" if math.isfinite(self.height) else ""


class Segment(Standing):
    """A thin vertical wall between two points, which balls meet from both sides and at its ends.

    Parameters
    ----------
    start, end : 2 lengths, m, as seen from above
    low, height : m: the heights between which it stands; default: infinitely low and high
    restitution, friction, tangential_restitution, stiffness_ratio, law, name : fields of every wall, as of :class:`Plane`

    Raises CaromError, one line per problem.

    Examples
    --------
    >>> import carom
    >>> carom.scene.Segment(start=(0, 0), end=(1, 0), height="40 mm").height
    0.04
    """

    shape: Literal["segment"] = "segment"
    start: Place
    end: Place

    @model_validator(mode="after")
    def _has_length(self) -> Segment:
        same = self.start == self.end
        raise_faults(
            [*([Fault("", "end", "another point than start", shown(list(self.end)))] if same else []), *self._levels()]
        )
        return self

    def features(self) -> list[Feature]:
        """Return two faces, ends, edges, corners, and gates."""
        return upright([self.start, self.end], closed=False, low=self.low, high=self.height)

    def outline(self) -> Outline:
        """Return a line."""
        return [np.array([self.start, self.end])]

    def describe(self) -> str:
        """Return a description of a few words."""
        return f"a segment from {format_vector(self.start)} to {format_vector(self.end)}{self._tall()}"


class Polygon(Standing):
    """Thin vertical walls from point to point, which balls meet from both sides.

    Parameters
    ----------
    points : at least 3 times 2 lengths, m, as seen from above
    closed : whether a wall leads from the last point to the first; default: yes
    low, height : m: the heights between which they stand; default: infinitely low and high
    restitution, friction, tangential_restitution, stiffness_ratio, law, name : fields of every wall, as of :class:`Plane`

    Raises CaromError, one line per problem: sides that cross, too.

    Examples
    --------
    >>> import carom
    >>> triangle = carom.scene.Polygon(points=[(0, 0), (1, 0), (0, 1)])
    >>> triangle.encloses
    True
    """

    shape: Literal["polygon"] = "polygon"
    points: Annotated[tuple[Place, ...], BeforeValidator(Components("at least 3 points [x, y]", range(3, 1_000_000)))]
    closed: Flag = True

    @model_validator(mode="after")
    def _simple(self) -> Polygon:
        raise_faults([*_crossings(np.array(self.points), self.closed), *self._levels()])
        return self

    @property
    def encloses(self) -> bool:
        """Return whether it is closed."""
        return self.closed

    def features(self) -> list[Feature]:
        """Return two faces, edges and gates for each side; a vertical edge and corners for each point."""
        x, y = np.array(self.points).T
        clockwise = self.closed and float(x @ np.roll(y, -1) - y @ np.roll(x, -1)) < 0
        points = self.points[::-1] if clockwise else self.points
        return upright(points, closed=self.closed, low=self.low, high=self.height)

    def outline(self) -> Outline:
        """Return its sides."""
        return [np.array([*self.points, self.points[0]] if self.closed else self.points)]

    def describe(self) -> str:
        """Return a description of a few words."""
        return f"a polygon of {len(self.points)} points{'' if self.closed else ', open'}{self._tall()}"


def _turn(p: Array, q: Array, r: Array) -> Array:
    """Return the orientation of triangles p, q, r: 1 counterclockwise, -1 clockwise, 0 collinear."""
    (ax, ay), (bx, by) = np.moveaxis(q - p, -1, 0), np.moveaxis(r - p, -1, 0)
    return np.asarray(np.sign(ax * by - ay * bx))


def _on(p: Array, q: Array, r: Array) -> NDArray[np.bool_]:
    """Return whether r is on the side from p to q."""
    between = (np.minimum(p, q) <= r) & (r <= np.maximum(p, q))
    return np.asarray((_turn(p, q, r) == 0) & between.all(axis=-1))


def _crossings(points: Array, closed: bool) -> list[Fault]:
    """Report where a polyline (n, 2) repeats a point, or intersects itself."""
    start = points if closed else points[:-1]
    end = np.roll(points, -1, axis=0) if closed else points[1:]
    same = np.flatnonzero((start == end).all(axis=1))
    if same.size:
        after = [int(i + 1) % len(points) for i in same]
        return [
            Fault("", f"points[{i}]", "another point than the one before", shown(points[i].tolist())) for i in after
        ]
    n = len(start)
    for i in range(n - 1):
        p, q, r, s = start[i], end[i], start[i + 1 :], end[i + 1 :]
        crossed = (_turn(p, q, r) * _turn(p, q, s) < 0) & (_turn(r, s, p) * _turn(r, s, q) < 0)
        # each side is asked for its start and its end; where the last one ends, the first one starts
        joined = closed & (i == 0) & (np.arange(i + 1, n) == n - 1)
        meets = crossed | ((_on(p, q, s) | _on(r, s, p)) & ~joined)
        if meets.any():
            got = f"sides {i} and {i + 1 + int(np.argmax(meets))} that meet"
            return [Fault("", "points", "an outline that does not meet itself", got, "give the points in order")]
    return []
