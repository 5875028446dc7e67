"""Kernels that build the features of walls, on which :mod:`carom.core.geometry.features` works.

A kernel of a shape takes the wall's numbers (:attr:`carom.scene.wall.WallShape.numbers`) and rows of :class:`Feature` to write
to, and returns how many features there are; a feature that finds no row is counted and not written. Python runs the kernel as it
is, and the explorer's module holds it compiled: the same operations, and so the same bits.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.core.geometry.curve_arcs import arc_address
from carom.core.geometry.features import FACE, LINE, OVER, POINT, RIM
from carom.core.jit.kernel import cross, dot, kept_kernel, kernel
from carom.core.roots import two_prod, two_sum
from carom.scene.schema import Vector

Array = NDArray[np.float64]
Flat = tuple[float, float]
UP: Vector = (0.0, 0.0, 1.0)
X: Vector = (1.0, 0.0, 0.0)
# How far a unit vector is moved to make its length 1: its least number above COARSE by no more than NEAR.
FEW_DIGITS, NEAR, COARSE = 8, 4e-15, 0.01
COLUMNS = 17  # of a feature as a row of numbers
ROOM = 64  # rows for the features of a wall, at first
POCKET, FIRST_CUSHION = 16, -2  # the column of pockets; what stands there of cushion 0


class Feature(NamedTuple):
    """A feature of a wall; lengths in m. :mod:`carom.core.geometry.features` documents its fields."""

    kind: int
    p: Vector
    d: Vector
    R: float
    side: float
    u: Vector
    lo1: float
    hi1: float
    lo2: float
    hi2: float
    pocket: int
    """Place of the pocket whose edge it is, of ``pocket_places`` of its shape; -1 for none, -2 - k for a part of cushion k."""

    @property
    def cushion(self) -> int:
        """Return the number of the cushion that it is a part of; -1 for none."""
        return max(-1, FIRST_CUSHION - self.pocket)

    @property
    def at(self) -> int:
        """Return the address by which Python finds the kernels of a curve."""
        return arc_address(compiled=False)


def built(build: Callable[..., int], *given: Any) -> list[Feature]:
    """Return the features that a kernel writes, run by Python; ``given``: its arguments before the rows."""
    rows = np.empty((ROOM, COLUMNS))
    count = build(*given, rows)
    if count > len(rows):
        rows = np.empty((count, COLUMNS))
        build(*given, rows)
    return [
        Feature(int(kind), (x, y, z), (dx, dy, dz), R, side, (ux, uy, uz), lo1, hi1, lo2, hi2, int(pocket))
        for kind, x, y, z, dx, dy, dz, R, side, ux, uy, uz, lo1, hi1, lo2, hi2, pocket in rows[:count].tolist()
    ]


# --- vectors ------------------------------------------------------------------------------------------------------


@kernel
def _scaled(v: Vector) -> Vector:
    most = max(abs(v[0]), abs(v[1]), abs(v[2]))
    x, y, z = v[0] / most, v[1] / most, v[2] / most
    size = math.sqrt(x * x + y * y + z * z)
    return (x / size, y / size, z / size)


@kept_kernel  # (half a millisecond in Python)
def unit(v: Vector) -> Vector:
    """A vector of length 1 along v; no number of v is too large or too small for it.

    Of those within a few last digits it is one whose length is nearest to 1: a reflection at a normal that is too long by
    1e-16 bends the path, always the same way, and ten thousand of them bend it by 1e-12.
    """
    n = _scaled(v)
    best, error = n, abs(_too_long(n))
    k = -1  # the finer its last digit, the better
    for i in range(3):
        if abs(n[i]) > COARSE and (k < 0 or abs(n[i]) < abs(n[k])):
            k = i
    for i in range(3):
        step = _last_digit(n[i])
        for digits in range(-FEW_DIGITS, FEW_DIGITS + 1):
            if error > 0 and i != k and n[i] != 0:
                tried = _with(n, i, n[i] + digits * step)
                tried = _with(tried, k, tried[k] - _too_long(tried) / (2 * n[k]))
                size = abs(_too_long(tried))
                if abs(tried[k] - n[k]) <= NEAR and size < error:
                    best, error = tried, size
    return best


@kernel
def _with(v: Vector, k: int, x: float) -> Vector:
    """V with x in place of component k."""
    return (x if k == 0 else v[0], x if k == 1 else v[1], x if k == 2 else v[2])


@kernel
def _last_digit(x: float) -> float:
    """Return the unit in the last place of a number from 0 to 1, as ``math.ulp``."""
    power = 1.0
    while power > abs(x) and power > 5e-324:
        power = power / 2
    return max(power * 2.220446049250313e-16, 5e-324)


Seven = tuple[float, float, float, float, float, float, float]


@kernel
def _too_long(n: Vector) -> float:
    """|n|^2 - 1, rounded once: three passes of exact sums leave parts whose last digits do not overlap."""
    (x, dx), (y, dy), (z, dz) = two_prod(n[0], n[0]), two_prod(n[1], n[1]), two_prod(n[2], n[2])
    p = _distilled(_distilled(_distilled((-1.0, x, dx, y, dy, z, dz))))
    return ((((((p[0] + p[1]) + p[2]) + p[3]) + p[4]) + p[5]) + p[6]) + 0.0


@kernel
def _distilled(p: Seven) -> Seven:
    """Return numbers of the same sum: the last is the rounded sum, the others what rounding took from its parts."""
    s, a = two_sum(p[1], p[0])
    s, b = two_sum(p[2], s)
    s, c = two_sum(p[3], s)
    s, d = two_sum(p[4], s)
    s, e = two_sum(p[5], s)
    s, f = two_sum(p[6], s)
    return (a, b, c, d, e, f, s)


@kernel
def length_2d(x: float, y: float) -> float:
    """Return the length of (x, y), rounded once, as ``math.dist`` has it."""
    (xx, dx), (yy, dy) = two_prod(x, x), two_prod(y, y)
    total, lost = two_sum(max(xx, yy), min(xx, yy))
    lost = lost + dx + dy
    root = math.sqrt(total)
    if not root > 0:
        return root
    square, error = two_prod(root, root)
    return root + (total - square - error + lost) / (2 * root)


@kernel
def point_along(p: Sequence[float], length: float) -> Vector:
    """Return the point at a distance from a wall's first point (numbers 0 to 2), along its direction (numbers 3 to 5)."""
    d = unit((p[3], p[4], p[5]))
    return (p[0] + length * d[0], p[1] + length * d[1], p[2] + length * d[2])


@kernel
def minus(p: Vector, q: Vector) -> Vector:
    """P - q."""
    return (p[0] - q[0], p[1] - q[1], p[2] - q[2])


@kernel
def across(p: Vector, d: Vector) -> Vector:
    """Return the part of p perpendicular to the unit vector d."""
    c = dot(p, d)
    return (p[0] - c * d[0], p[1] - c * d[1], p[2] - c * d[2])


@kernel
def frame(axis: Vector) -> tuple[Vector, Vector]:
    """Two unit vectors u, v that make a right-handed frame (u, v, axis): u is the x axis, seen along the unit axis.

    For an axis along x, the y axis takes its place.
    """
    first = (0.0, 1.0, 0.0) if abs(axis[0]) > 1 - 1e-9 else (1.0, 0.0, 0.0)
    u = _scaled(across(first, axis))
    return u, cross(axis, u)


# --- features: each kernel writes to rows from row i on, and returns the row after them ---------------------------


@kernel
def put(
    out: Array, i: int, kind: int, p: Vector, d: Vector, R: float, side: float, u: Vector, lo1: float, hi1: float, lo2: float,
    hi2: float, pocket: int,
) -> int:  # fmt: skip
    """Write a feature."""
    if i < out.shape[0]:
        out[i, 0] = kind
        out[i, 1], out[i, 2], out[i, 3] = p
        out[i, 4], out[i, 5], out[i, 6] = d
        out[i, 7], out[i, 8] = R, side
        out[i, 9], out[i, 10], out[i, 11] = u
        out[i, 12], out[i, 13], out[i, 14], out[i, 15] = lo1, hi1, lo2, hi2
        out[i, 16] = pocket
    return i + 1


@kernel
def put_plane(p: Vector, normal: Vector, i: int, out: Array) -> int:
    """Write an infinite plane; balls are on the side of its unit normal."""
    return put_disc(p, normal, 0.0, i, out)


@kernel
def put_disc(p: Vector, normal: Vector, R: float, i: int, out: Array) -> int:
    """Write a circular face; balls are on the side of its unit normal."""
    return put(out, i, FACE, p, normal, R, 1.0, frame(normal)[0], -math.inf, math.inf, -math.inf, math.inf, -1)


@kernel
def put_line(p: Vector, d: Vector, low: float, high: float, R: float, side: float, i: int, out: Array) -> int:
    """Write a line along the unit vector d, or the surface at a distance R from it: an edge, a cylinder."""
    return put(out, i, LINE, p, d, R, side, frame(d)[0], -1.0, 1.0, low, high, -1)


@kernel
def put_post(x: float, y: float, low: float, high: float, i: int, out: Array) -> int:
    """Write a vertical edge."""
    return put_line((x, y, 0.0), UP, low, high, 0.0, 1.0, i, out)


@kernel
def put_corner(p: Vector, R: float, side: float, i: int, out: Array) -> int:
    """Write a point, or the sphere at a distance R from it."""
    return put(out, i, POINT, p, UP, R, side, X, -math.inf, math.inf, -math.inf, math.inf, -1)


@kernel
def put_rim(p: Vector, d: Vector, R: float, u: Vector, cosine: float, i: int, out: Array) -> int:
    """Write a circle around p, in the plane of unit normal d; or an arc of it around u, by the cosine of half the arc's angle."""
    return put(out, i, RIM, p, d, R, 1.0, u, cosine, math.inf, -math.inf, math.inf, -1)


@kernel
def put_standing(
    kind: int, x: float, y: float, x2: float, y2: float, low: float, high: float, i: int, out: Array
) -> int:
    """Write a vertical face, or a gate, from (x, y) to (x2, y2); balls are on its right."""
    t = unit((x2 - x, y2 - y, 0.0))
    size = length_2d(x2 - x, y2 - y)
    return put(out, i, kind, (x, y, 0.0), (t[1], -t[0], 0.0), 0.0, 1.0, (t[0], t[1], 0.0), 0.0, size, low, high, -1)


@kernel
def put_edges(x: float, y: float, x2: float, y2: float, low: float, high: float, i: int, out: Array) -> int:
    """Write the horizontal edges of a vertical face, at its finite heights."""
    t = unit((x2 - x, y2 - y, 0.0))
    size = length_2d(x2 - x, y2 - y)
    if abs(low) < math.inf:
        i = put_line((x, y, low), t, 0.0, size, 0.0, 1.0, i, out)
    if abs(high) < math.inf and high != low:
        i = put_line((x, y, high), t, 0.0, size, 0.0, 1.0, i, out)
    return i


@kernel
def put_ends(x: float, y: float, low: float, high: float, i: int, out: Array) -> int:
    """Write what ends an upright wall at a point: a vertical edge, and corners at its finite heights."""
    if low < high:
        i = put_post(x, y, low, high, i, out)
    if abs(low) < math.inf:
        i = put_corner((x, y, low), 0.0, 1.0, i, out)
    if abs(high) < math.inf and high != low:
        i = put_corner((x, y, high), 0.0, 1.0, i, out)
    return i


@kernel
def put_upright(
    p: Sequence[float],
    first: int,
    count: int,
    backwards: bool,
    closed: bool,
    low: float,
    high: float,
    i: int,
    out: Array,
) -> int:
    """Write an upright wall without thickness along a polyline, from z = low to high: faces, edges, corners, gates.

    Its points are pairs of numbers of p, from ``first`` on. ``closed``: back to the first point, counterclockwise; what passes over
    it from the inside has left.
    """
    sides = count if closed else count - 1
    for k in range(sides):
        x, y, x2, y2 = side_of(p, first, count, backwards, k)
        if low < high:
            i = put_standing(FACE, x2, y2, x, y, low, high, i, out)
            i = put_standing(FACE, x, y, x2, y2, low, high, i, out)
        i = put_edges(x, y, x2, y2, low, high, i, out)
    for k in range(count):
        x, y, x2, y2 = side_of(p, first, count, backwards, k)
        i = put_ends(x, y, low, high, i, out)
    if high < math.inf:
        for k in range(sides):
            x, y, x2, y2 = side_of(p, first, count, backwards, k)
            i = put_standing(OVER, x2, y2, x, y, high, math.inf, i, out)
            if not closed:
                i = put_standing(OVER, x, y, x2, y2, high, math.inf, i, out)
    return i


@kernel
def side_of(p: Sequence[float], first: int, count: int, backwards: bool, k: int) -> tuple[float, float, float, float]:
    """Return both ends of side k of a polyline; ``backwards``: of its points in the opposite order."""
    m = (k + 1) % count
    one, two = (count - 1 - k, count - 1 - m) if backwards else (k, m)
    return (p[first + 2 * one], p[first + 2 * one + 1], p[first + 2 * two], p[first + 2 * two + 1])


@kernel
def put_cushion(x: float, y: float, x2: float, y2: float, low: float, high: float, i: int, out: Array) -> int:
    """Write a side of an outline, counterclockwise, with the balls inside: a face, edges, and the gate above."""
    if low < high:
        i = put_standing(FACE, x2, y2, x, y, low, high, i, out)
    i = put_edges(x, y, x2, y2, low, high, i, out)
    return put_standing(OVER, x2, y2, x, y, high, math.inf, i, out) if high < math.inf else i


@kernel
def put_number(cushion: int, first: int, i: int, out: Array) -> int:
    """Write which cushion the features from row ``first`` on are parts of."""
    for row in range(first, min(i, out.shape[0])):
        out[row, POCKET] = FIRST_CUSHION - cushion
    return i


@kernel
def put_rims(
    x: float, y: float, R: float, u: Vector, cosine: float, low: float, high: float, i: int, out: Array
) -> int:
    """Write the edges of an upright round wall, at its finite heights."""
    if abs(low) < math.inf:
        i = put_rim((x, y, low), UP, R, u, cosine, i, out)
    if abs(high) < math.inf and high != low:
        i = put_rim((x, y, high), UP, R, u, cosine, i, out)
    return i


@kernel
def put_round(
    kind: int,
    x: float,
    y: float,
    R: float,
    side: float,
    u: Vector,
    cosine: float,
    low: float,
    high: float,
    i: int,
    out: Array,
) -> int:
    """Write an upright round face, or a gate."""
    return put(out, i, kind, (x, y, 0.0), UP, R, side, u, cosine, 1.0, low, high, -1)


@kernel
def put_round_cushion(
    x: float, y: float, R: float, u: Vector, cosine: float, low: float, high: float, i: int, out: Array
) -> int:
    """Write a cushion along an arc that is convex towards the balls; u and cosine as of a rim."""
    if low < high:
        i = put_round(LINE, x, y, R, 1.0, u, cosine, low, high, i, out)
    i = put_rims(x, y, R, u, cosine, low, high, i, out)
    return put_round(OVER, x, y, R, 1.0, u, cosine, high, math.inf, i, out) if high < math.inf else i


def circle(center: Sequence[float], radius: float, first: float = 0.0, last: float = 2 * math.pi) -> Array:
    """Return a circle, or an arc, as a polyline (n, 2); angles in radians."""
    angles = np.linspace(first, last, max(2, 1 + round(abs(last - first) / (2 * math.pi) * 96)))
    return np.column_stack((center[0] + radius * np.cos(angles), center[1] + radius * np.sin(angles)))
