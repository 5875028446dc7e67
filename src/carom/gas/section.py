"""Plane figures that hold a gas of discs or, upright, one of balls: their walls, with lengths in place of areas."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.checks import Faults
from carom.engine.swarm_arrays import INSIDE, OUTSIDE, OVAL, PLANE
from carom.gas.wall import Numbers, Wall
from carom.outlines import outline_faults

__all__ = ["Section", "section"]

Array = NDArray[np.float64]
# Walls, area, and, of what is not convex, the outline.
Section = tuple[list[Wall], float, Array | None]
JOIN = 1e-9  # of the size: so far bounded walls that go over into each other overlap
STRAIGHT = 1e-12  # sine of the angle by which two sides of a polygon that are one may turn


def section(faults: Faults, shape: str, size: Numbers, points: Any, bounds: str) -> Section:
    """The figure of a shape with a size, or of a polygon with these corners."""
    (width, depth), (x, y) = size[:2], (size[0] / 2, size[1] / 2)
    if shape in {"circle", "cylinder"}:
        if width != depth:
            faults.add("size", "the same width and depth for a circle", f"{size}; shape = 'ellipse' has two")
        r = width / 2
        return [_round("side", (x, y), 2 * math.pi * r, r)], math.pi * r * r, None
    if shape == "ellipse":
        a, b = width / 2, depth / 2
        length = _ellipse_length(a, b)
        if bounds == "centre" or a == b:
            across, form, reach = (1 / a, 1 / b, 0.0), INSIDE, 1.0
            if a == b:
                across, reach = (1.0, 1.0, 0.0), a
        else:  # (the curve at a ball's radius from an ellipse is none)
            across, form, reach = (a, b, 0.0), OVAL, 0.0
        return [Wall("side", form, across, (x, y, 0.0), length, reach)], math.pi * a * b, None
    if shape == "stadium":
        return _stadium(faults, size)
    return _wedge(faults, size) if shape == "wedge" else _polygon(faults, points, bounds)


def _round(name: str, centre: Numbers, length: float, r: float, along: float = 0.0, *span: float) -> Wall:
    """A wall round a centre; with ``along``, only where x is within a span."""
    low, high = span or (-math.inf, math.inf)
    return Wall(name, INSIDE, (1.0, 1.0, 0.0), (*centre, 0.0), length, r, True, (along, 0.0, 0.0), low, high)


def _ellipse_length(a: float, b: float) -> float:
    """Circumference of an ellipse, by the midpoint rule: it converges at once, the integrand being periodic."""
    t = (np.arange(256) + 0.5) * (2 * math.pi / 256)
    return float(np.hypot(a * np.sin(t), b * np.cos(t)).mean() * 2 * math.pi)


def _stadium(faults: Faults, size: Numbers) -> Section:
    width, depth = size[:2]
    if width < depth:
        faults.add("size", "a stadium along x: no shorter than it is wide", f"{size}")
    r, straight = depth / 2, width - depth
    join, end = JOIN * depth, math.pi * r
    walls = [
        Wall("front", PLANE, (0.0, 1.0, 0.0), (0.0, 0.0, 0.0), straight),
        Wall("back", PLANE, (0.0, -1.0, 0.0), (0.0, depth, 0.0), straight),
        _round("left", (r, r), end, r, 1.0, -math.inf, r + join),
        _round("right", (width - r, r), end, r, 1.0, width - r - join, math.inf),
    ]
    return walls, straight * depth + math.pi * r * r, None


def _wedge(faults: Faults, size: Numbers) -> Section:
    """A sector: its tip in the middle of y = 0, opening along y up to an arc about the tip, which is as far away as it is high."""
    width, depth = size[:2]
    half = width / 2 / depth
    if half >= 1:
        found = f"{size}; it is 2 R sin(angle/2) and R, for an angle below 180 degrees"
        faults.add("size", "a wedge less than twice as wide as deep", found)
        return [], 1.0, None
    cos = math.sqrt((1 - half) * (1 + half))
    tip, angle = (width / 2, 0.0), 2 * math.asin(half)
    walls = [
        Wall("left", PLANE, (cos, half, 0.0), (*tip, 0.0), depth),
        Wall("right", PLANE, (-cos, half, 0.0), (*tip, 0.0), depth),
        _round("side", tip, angle * depth, depth),
    ]
    return walls, angle * depth * depth / 2, None


def _polygon(faults: Faults, points: Any, bounds: str) -> Section:
    """Sides, and at re-entrant corners the points that a ball meets there; side k goes from corner k to the next."""
    corners = np.array(points, dtype=float)
    for expected, got in outline_faults(corners):
        faults.also("points", expected, got)
    faults.done()
    edges = np.roll(corners, -1, axis=0) - corners
    length = np.hypot(edges[:, 0], edges[:, 1])
    area = float((corners[:, 0] * np.roll(corners[:, 1], -1) - corners[:, 1] * np.roll(corners[:, 0], -1)).sum() / 2)
    way = 1.0 if area > 0 else -1.0
    along = edges / length[:, None]
    inward = way * np.stack([-along[:, 1], along[:, 0]], axis=1)
    after = np.roll(along, -1, axis=0)
    turn = way * (along[:, 0] * after[:, 1] - along[:, 1] * after[:, 0])  # at the end of each side
    convex = bool((turn > STRAIGHT).all())
    join = JOIN * float(length.max())
    walls = []
    for k, (corner, n, t, s) in enumerate(zip(corners, inward, along, length.tolist(), strict=True)):
        name, at = f"edge{k + 1}", (*corner.tolist(), 0.0)
        wall = Wall(name, PLANE, (*n.tolist(), 0.0), at, s, part=not convex)
        begin = float(corner @ t)
        others = np.delete(corners, [k, (k + 1) % len(corners)], axis=0)
        if convex or ((others - corner) @ n > join).all():
            walls.append(wall)  # (nothing of the room lies behind it)
        else:
            walls.append(
                Wall(
                    name, PLANE, wall.across, at, s, along=(*t.tolist(), 0.0), low=begin - join, high=begin + s + join, part=True
                )
            )  # fmt: skip
        if turn[k] < -STRAIGHT and bounds == "surface":
            # a ball's surface meets the corner itself, which counts as the end of the side before it
            tip = (*corners[(k + 1) % len(corners)].tolist(), 0.0)
            walls.append(Wall(name, OUTSIDE, (1.0, 1.0, 0.0), tip, 0.0, 0.0, part=True))
    return walls, abs(area), None if convex else corners
