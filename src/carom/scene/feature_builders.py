"""Features, the elements of walls that :mod:`carom.core.geometry.features` works on, and functions that build them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.core.geometry.features import FACE, LINE, OVER, POINT, RIM
from carom.core.jit.kernel import cross, dot
from carom.core.roots.polynomial import two_prod
from carom.scene.schema import Vector

__all__ = [
    "Feature", "Flat", "across", "circle", "corner", "cushion", "disc", "frame", "line", "minus", "plane", "post", "rim",
    "round_cushion", "unit", "upright",
]  # fmt: skip

Array = NDArray[np.float64]
Flat = tuple[float, float]
UP: Vector = (0.0, 0.0, 1.0)
# How far a unit vector is moved to make its length 1: its least number above COARSE by no more than NEAR.
FEW_DIGITS, NEAR, COARSE = 8, 4e-15, 0.01


class Feature(NamedTuple):
    """A feature of a wall; lengths in m. :mod:`carom.core.geometry.features` documents its fields."""

    kind: int
    p: Vector
    d: Vector = UP
    R: float = 0.0
    side: float = 1.0
    u: Vector = (1.0, 0.0, 0.0)
    lo1: float = -math.inf
    hi1: float = math.inf
    lo2: float = -math.inf
    hi2: float = math.inf
    pocket: int = -1
    """Number of the pocket whose edge it is, among its wall's pockets; -1 for none."""


# --- vectors ------------------------------------------------------------------------------------------------------


def _scaled(v: Sequence[float]) -> Vector:
    most = max(abs(x) for x in v)
    x, y, z = (c / most for c in v)
    size = math.sqrt(x * x + y * y + z * z)
    return (x / size, y / size, z / size)


def unit(v: Sequence[float]) -> Vector:
    """A vector of length 1 along v; no number of v is too large or too small for it.

    Of those within a few last digits it is one whose length is nearest to 1: a reflection at a normal that is too long by
    1e-16 bends the path, always the same way, and ten thousand of them bend it by 1e-12.
    """
    return _nearest(tuple(map(float, v)))


@lru_cache(4096)  # a scene asks for the same few normals again and again, and the search takes half a millisecond
def _nearest(v: tuple[float, ...]) -> Vector:
    best = n = _scaled(v)
    if _too_long(n) == 0:
        return n
    k = min((abs(c), i) for i, c in enumerate(n) if abs(c) > COARSE)[1]  # the finer its last digit, the better
    for i in range(3):
        for digits in range(-FEW_DIGITS, FEW_DIGITS + 1):
            if i != k and n[i] != 0:
                tried = [*n]
                tried[i] += digits * math.ulp(n[i])
                tried[k] -= _too_long(tried) / (2 * n[k])
                if abs(tried[k] - n[k]) <= NEAR and abs(_too_long(tried)) < abs(_too_long(best)):
                    best = (tried[0], tried[1], tried[2])
    return best


def _too_long(n: Sequence[float]) -> float:
    """|n|^2 - 1, without rounding."""
    return math.fsum((-1.0, *(part for c in n for part in two_prod(c, c))))


def minus(p: Sequence[float], q: Sequence[float]) -> Vector:
    """P - q."""
    return (p[0] - q[0], p[1] - q[1], p[2] - q[2])


def across(p: Vector, d: Vector) -> Vector:
    """Return the part of p perpendicular to the unit vector d."""
    c = dot(p, d)
    return (p[0] - c * d[0], p[1] - c * d[1], p[2] - c * d[2])


def frame(axis: Vector) -> tuple[Vector, Vector]:
    """Two unit vectors u, v that make a right-handed frame (u, v, axis): u is the x axis, seen along the unit axis.

    For an axis along x, the y axis takes its place.
    """
    u = _scaled(across((0.0, 1.0, 0.0) if abs(axis[0]) > 1 - 1e-9 else (1.0, 0.0, 0.0), axis))
    return u, cross(axis, u)


# --- features -----------------------------------------------------------------------------------------------------


def plane(p: Vector, normal: Vector) -> Feature:
    """Return an infinite plane; balls are on the side of its unit normal."""
    return Feature(FACE, p, normal, u=frame(normal)[0])


def line(
    p: Vector, d: Vector, low: float = -math.inf, high: float = math.inf, R: float = 0.0, side: float = 1.0
) -> Feature:
    """Return a line along the unit vector d, or the surface at a distance R from it: an edge, a cylinder."""
    return Feature(LINE, p, d, R, side, frame(d)[0], -1.0, 1.0, low, high)


def post(at: Flat, low: float = -math.inf, high: float = math.inf) -> Feature:
    """Return a vertical edge."""
    return line((*at, 0.0), UP, low, high)


def corner(p: Vector) -> Feature:
    """Return a point."""
    return Feature(POINT, p)


def disc(p: Vector, normal: Vector, R: float) -> Feature:
    """Return a circular face; balls are on the side of its unit normal."""
    return Feature(FACE, p, normal, R, u=frame(normal)[0])


def rim(p: Vector, d: Vector, R: float, u: Vector | None = None, cosine: float = -1.0) -> Feature:
    """A circle around p, in the plane of unit normal d; or of it an arc on both sides of u, by the cosine of half its angle."""
    return Feature(RIM, p, d, R, 1.0, frame(d)[0] if u is None else u, cosine)


def _standing(kind: int, start: Flat, end: Flat, low: float, high: float) -> Feature:
    """Return a vertical face, or a gate, from start to end; balls are on its right."""
    (tx, ty, _z), size = unit((end[0] - start[0], end[1] - start[1], 0.0)), math.dist(start, end)
    return Feature(kind, (*start, 0.0), (ty, -tx, 0.0), u=(tx, ty, 0.0), lo1=0.0, hi1=size, lo2=low, hi2=high)


def upright(points: Sequence[Flat], *, closed: bool, low: float, high: float, inside: bool = False) -> list[Feature]:
    """An upright wall without thickness along a polyline, from z = low to high: faces, edges, corners, gates.

    ``closed``: back to the first point, counterclockwise; what passes over it from the inside has left. ``inside``: the
    outline is convex and its balls are all inside, so that its back and its posts are never met.
    """
    pairs = list(zip(points, [*points[1:], points[0]] if closed else points[1:], strict=False))
    levels = [z for z in sorted({low, high}) if math.isfinite(z)]
    found = []
    for start, end in pairs:
        if low < high:
            found.append(_standing(FACE, end, start, low, high))
            if not inside:
                found.append(_standing(FACE, start, end, low, high))
        t = unit((end[0] - start[0], end[1] - start[1], 0.0))
        found += [line((*start, z), t, 0.0, math.dist(start, end)) for z in levels]
    if not inside:
        for at in points:
            if low < high:
                found.append(post(at, low, high))
            found += [corner((*at, z)) for z in levels]
    if math.isfinite(high):
        for start, end in pairs:
            found.append(_standing(OVER, end, start, high, math.inf))
            if not closed:
                found.append(_standing(OVER, start, end, high, math.inf))
    return found


def cushion(start: Flat, end: Flat, low: float, high: float) -> list[Feature]:
    """One side of an outline that is gone round counterclockwise, with the balls inside: a face, edges, and the gate above."""
    found = [_standing(FACE, end, start, low, high)] if low < high else []
    t = unit((end[0] - start[0], end[1] - start[1], 0.0))
    found += [line((*start, z), t, 0.0, math.dist(start, end)) for z in (low, high) if math.isfinite(z)]
    return found + ([_standing(OVER, end, start, high, math.inf)] if math.isfinite(high) else [])


def round_cushion(center: Flat, radius: float, middle: Flat, cosine: float, low: float, high: float) -> list[Feature]:
    """The same along an arc that is convex towards the balls, on both sides of ``middle`` by the cosine of half its angle."""
    at, u = (*center, 0.0), (*middle, 0.0)
    found = [Feature(LINE, at, UP, radius, 1.0, u, cosine, 1.0, low, high)] if low < high else []
    found += [rim((*center, z), UP, radius, u, cosine) for z in (low, high) if math.isfinite(z)]
    return found + ([Feature(OVER, at, UP, radius, 1.0, u, cosine, 1.0, high, math.inf)] if math.isfinite(high) else [])


def circle(center: Sequence[float], radius: float, first: float = 0.0, last: float = 2 * math.pi) -> Array:
    """Return a circle, or an arc, as a polyline (n, 2); angles in radians."""
    angles = np.linspace(first, last, max(2, 1 + round(abs(last - first) / (2 * math.pi) * 96)))
    return np.column_stack((center[0] + radius * np.cos(angles), center[1] + radius * np.sin(angles)))
