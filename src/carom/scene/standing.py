"""Upright walls along straight lines: segment, polygon, table."""

from __future__ import annotations

import math
from typing import Annotated, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import BeforeValidator, model_validator

from carom.scene.faults import Fault, Words, refuse
from carom.scene.parts import Feature, Flat, upright
from carom.scene.quantities import Components, Extent, Flag, Place, Size, Vector
from carom.scene.wall import Outline, Wall, spelled
from carom.units import length

__all__ = ["Polygon", "Segment", "Standing", "Table"]

Array = NDArray[np.float64]


class Standing(Wall):
    """Between two heights: ``low`` (where it begins; left out: below everything) and ``height`` (where it ends)."""

    low: Extent = -math.inf
    height: Extent = math.inf

    def _levels(self) -> list[Fault]:
        if self.low <= self.height and self.low < math.inf and self.height > -math.inf:
            return []
        return [Fault(f"a height above low = {self.low:g} m", self.height, at=("height",))]

    def vertical(self, z: float) -> bool:
        """It reaches below and above the balls' centres."""
        return self.low <= z <= self.height

    def _tall(self) -> str:
        return f", {length(self.height)} high" if math.isfinite(self.height) else ""


class Segment(Standing):
    """A thin upright wall from start to end (x, y), met from both sides and at its end posts."""

    shape: Literal["segment"] = "segment"
    start: Place
    end: Place

    @model_validator(mode="after")
    def _has_length(self) -> Segment:
        same = self.start == self.end
        refuse([*([Fault("another point than start", list(self.end), at=("end",))] if same else []), *self._levels()])
        return self

    def features(self) -> list[Feature]:
        """Two faces, end posts, edges, corners, gates."""
        return upright([self.start, self.end], closed=False, low=self.low, high=self.height)

    def outline(self) -> Outline:
        """A line."""
        return [np.array([self.start, self.end])]

    def describe(self) -> str:
        """One phrase."""
        return f"a segment from {spelled(self.start)} to {spelled(self.end)}{self._tall()}"


class Polygon(Standing):
    """Thin upright walls from point to point (x, y) and, ``closed``, back to the first; met from both sides."""

    shape: Literal["polygon"] = "polygon"
    points: Annotated[tuple[Place, ...], BeforeValidator(Components("at least 3 points [x, y]", range(3, 1_000_000)))]
    closed: Flag = True

    @model_validator(mode="after")
    def _simple(self) -> Polygon:
        refuse([*_crossings(np.array(self.points), self.closed), *self._levels()])
        return self

    @property
    def encloses(self) -> bool:
        """A closed one does."""
        return self.closed

    def features(self) -> list[Feature]:
        """Of each side two faces, edges and gates; of each point a post and corners."""
        x, y = np.array(self.points).T
        clockwise = self.closed and float(x @ np.roll(y, -1) - y @ np.roll(x, -1)) < 0
        points = self.points[::-1] if clockwise else self.points
        return upright(points, closed=self.closed, low=self.low, high=self.height)

    def outline(self) -> Outline:
        """Its sides."""
        return [np.array([*self.points, self.points[0]] if self.closed else self.points)]

    def describe(self) -> str:
        """One phrase."""
        return f"a polygon of {len(self.points)} points{'' if self.closed else ', open'}{self._tall()}"


class Table(Wall):
    """A rectangular table: four cushions around a center (x, y), length along x and width along y, nose to nose.

    Its cushions are upright walls up to ``height``; left out, nothing leaves the table. With ``nose_height`` each begins
    with an edge at that height: a ball whose radius is less meets it above its centre, one that hops may meet the wall
    above it.
    """

    shape: Literal["table"] = "table"
    length: Size
    width: Size
    center: Place = (0.0, 0.0)
    nose_height: Size | None = None
    height: Extent = math.inf

    @model_validator(mode="after")
    def _upwards(self) -> Table:
        low = self.nose_height or 0.0
        if not (self.height >= low and self.height > 0):
            expected = f"at least nose_height = {low:g} m" if low else "a height above the floor"
            refuse([Fault(expected, self.height, at=("height",))])
        return self

    @property
    def encloses(self) -> bool:
        """It stands all around."""
        return True

    @property
    def room(self) -> float:
        """Half of the lesser side."""
        return min(self.length, self.width) / 2

    def _corners(self) -> list[Flat]:
        (x, y), dx, dy = self.center, self.length / 2, self.width / 2
        return [(x - dx, y - dy), (x + dx, y - dy), (x + dx, y + dy), (x - dx, y + dy)]

    def features(self) -> list[Feature]:
        """Four faces; noses, upper edges and gates."""
        low = -math.inf if self.nose_height is None else self.nose_height
        return upright(self._corners(), closed=True, low=low, high=self.height, inside=True)

    def outline(self) -> Outline:
        """A rectangle."""
        return [np.array([*self._corners(), self._corners()[0]])]

    def describe(self) -> str:
        """One phrase."""
        nose = "" if self.nose_height is None else f", cushion noses at {length(self.nose_height)}"
        return f"a table of {length(self.length)} by {length(self.width)}{nose}"

    def blocked(self, x: Vector) -> bool:
        """Beyond a cushion."""
        return abs(x[0] - self.center[0]) > self.length / 2 or abs(x[1] - self.center[1]) > self.width / 2

    def vertical(self, z: float) -> bool:
        """Without a nose above the balls' centres, and not lower than they are."""
        return (self.nose_height is None or self.nose_height <= z) and z <= self.height


def _turn(p: Array, q: Array, r: Array) -> Array:
    """Which way the triangles p, q, r turn: 1 counterclockwise, -1 clockwise, 0 in a line."""
    (ax, ay), (bx, by) = np.moveaxis(q - p, -1, 0), np.moveaxis(r - p, -1, 0)
    return np.asarray(np.sign(ax * by - ay * bx))


def _on(p: Array, q: Array, r: Array) -> NDArray[np.bool_]:
    """Whether r lies on the side from p to q."""
    between = (np.minimum(p, q) <= r) & (r <= np.maximum(p, q))
    return np.asarray((_turn(p, q, r) == 0) & between.all(axis=-1))


def _crossings(points: Array, closed: bool) -> list[Fault]:
    """Where a polyline (n, 2) repeats a point, or meets itself."""
    start = points if closed else points[:-1]
    end = np.roll(points, -1, axis=0) if closed else points[1:]
    same = np.flatnonzero((start == end).all(axis=1))
    if same.size:
        after = [int(i + 1) % len(points) for i in same]
        return [Fault("another point than the one before", points[i].tolist(), at=("points", i)) for i in after]
    n = len(start)
    for i in range(n - 1):
        p, q, r, s = start[i], end[i], start[i + 1 :], end[i + 1 :]
        crossed = (_turn(p, q, r) * _turn(p, q, s) < 0) & (_turn(r, s, p) * _turn(r, s, q) < 0)
        # each side is asked for its start and its end; where the last one ends, the first one starts
        joined = closed & (i == 0) & (np.arange(i + 1, n) == n - 1)
        meets = crossed | ((_on(p, q, s) | _on(r, s, p)) & ~joined)
        if meets.any():
            got = Words(f"sides {i} and {i + 1 + int(np.argmax(meets))} that meet")
            return [Fault("an outline that does not meet itself", got, "give the points in order", ("points",))]
    return []
