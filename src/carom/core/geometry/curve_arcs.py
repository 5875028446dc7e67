"""Arcs of a smooth curve, which a ball of any radius touches: the distance, the normal, the curvature.

The curve is cut where its curvature has a greatest or least value or changes its sign. An *arc* between two such places, which
turns by no more than pi/2, touches a ball at one point at most. Continued by its tangents it bounds a convex set. The distance D
from that, positive on the ball's side, is the least of all distances h_t from tangents where the curve bends round the ball, and
the greatest of them where it bends away.

A ball larger than a radius of curvature does not touch the arc there: that part of the arc is left out, so that the tangent which
continues the rest is beyond the ball's reach.

A table has one row of numbers about the arc (COUNT ... SHARP_END), then its panels (:mod:`carom.core.geometry.panels`), then its
last node. The ball is on the left.
"""

from __future__ import annotations

import math
from typing import Any

from carom.core.geometry.curve import CX, HALF, OX, TX, X, curve_graph
from carom.core.jit.kernel import hot_kernel, kernel

__all__ = [
    "COUNT", "SEAM", "SENSE", "SHARPEST", "SHARP_END", "SIZE", "Ends", "arc_contact", "arc_depth", "arc_gap", "node_of",
    "touchable_part",
]  # fmt: skip

NEVER = math.inf
# Columns of the first row: number of panels; 1 where the arc bends round the ball, -1 where it bends away; the size of the curve,
# m, with the distance of its farthest place from the origin; the largest curvature, 1/m, and whether it is at the end (1) or at the
# beginning (0) of the arc.
COUNT, SENSE, SIZE, SHARPEST, SHARP_END = range(5)
Y, TY, OY, CY = X + 1, TX + 1, OX + 1, CX + 1
SEAM = 1e-9  # of the ball's radius: a contact so far beyond an end is still on the arc
CLOSE = 1e-9  # Newton's step in w after which the distance is exact: what is left out is of second order

Ends = tuple[int, float, int, float, int]
"""Panel and w at the beginning, panel and w at the end, the first row of the table."""
Flat4 = tuple[float, float, float, float]
Depth = tuple[float, float, float, float, float]


@hot_kernel
def node_of(table: Any, j: int, w: float) -> Flat4:
    """Return the place and the unit tangent at w of panel j."""
    if w == -1.0:
        return table[j, X], table[j, Y], table[j, TX], table[j, TY]
    if w == 1.0:
        return table[j + 1, X], table[j + 1, Y], table[j + 1, TX], table[j + 1, TY]
    f, f1, _f2 = curve_graph(table, j, w)
    ex, ey, xi = table[j, CX], table[j, CY], table[j, HALF] * (1.0 + w)
    q = 1.0 / math.sqrt(1.0 + f1 * f1)
    return table[j, OX] + ex * xi - ey * f, table[j, OY] + ey * xi + ex * f, q * (ex - ey * f1), q * (ey + ex * f1)


@kernel
def _bend(table: Any, j: int, w: float) -> float:
    """Return the size of the curvature at w of panel j."""
    _f, f1, f2 = curve_graph(table, j, w)
    q = 1.0 / math.sqrt(1.0 + f1 * f1)
    return abs(f2) * (q * q * q)


@kernel
def touchable_part(table: Any, base: int, d: float) -> Ends:
    """Return the ends of the part that a ball of radius d can touch; the last panel is before the first one where there is none."""
    count = int(table[base, COUNT])
    if table[base, SENSE] < 0.0 or table[base, SHARPEST] * d <= 1.0:
        return base + 1, -1.0, base + count, 1.0, base
    at_end = table[base, SHARP_END] > 0.0
    # from the flat end on
    for k in range(count):
        j, far = (base + k + 1, 1.0) if at_end else (base + count - k, -1.0)
        if k == 0 and _bend(table, j, -far) * d >= 1.0:
            return base + 1, -1.0, base, 1.0, base
        if _bend(table, j, far) * d > 1.0:
            flat, sharp = -far, far
            for _ in range(40):
                w = 0.5 * (flat + sharp)
                if _bend(table, j, w) * d > 1.0:
                    sharp = w
                else:
                    flat = w
            return (base + 1, -1.0, j, flat, base) if at_end else (j, flat, base + count, 1.0, base)
    return base + 1, -1.0, base + count, 1.0, base


@kernel
def _along(table: Any, k: int, x: float, y: float) -> float:
    """Return how far a point is ahead of a node, along the tangent there."""
    return (x - table[k, X]) * table[k, TX] + (y - table[k, Y]) * table[k, TY]  # type: ignore[no-any-return]


@kernel
def _foot(table: Any, j: int, x: float, y: float, low: float, high: float) -> tuple[float, float, float, float, float]:
    """Return the distance from the foot of the normal between low and high, the normal, the curvature, w."""
    h, ex, ey = table[j, HALF], table[j, CX], table[j, CY]
    px, py = x - table[j, OX], y - table[j, OY]
    xi, eta = ex * px + ey * py, ex * py - ey * px
    w = min(max(xi / h - 1.0, low), high)
    for _ in range(100):
        f, f1, f2 = curve_graph(table, j, w)
        dx, dy = xi - h * (1.0 + w), eta - f
        ahead, rate = dx + f1 * dy, h * (1.0 + f1 * f1 - f2 * dy)
        if ahead > 0.0:
            low = w
        else:
            high = w
        new = w + ahead / rate if rate > 0.0 else 0.5 * (low + high)
        if not low <= new <= high:
            new = 0.5 * (low + high)
        step = abs(new - w)
        w = new
        if step <= CLOSE:
            break
    f, f1, f2 = curve_graph(table, j, w)
    q = 1.0 / math.sqrt(1.0 + f1 * f1)
    depth = q * (eta - f - f1 * (xi - h * (1.0 + w)))
    return depth, -q * (f1 * ex + ey), q * (ex - f1 * ey), f2 * (q * q * q), w


@kernel
def arc_depth(table: Any, ends: Ends, x: float, y: float) -> Depth:
    """Return D, its gradient (the normal towards the ball), the curvature, and how far beyond an end of the arc the foot lies."""
    j0, w0, j1, w1, base = ends
    ax, ay, au, av = node_of(table, j0, w0)
    bx, by, bu, bv = node_of(table, j1, w1)
    ahead_a, ahead_b = (x - ax) * au + (y - ay) * av, (x - bx) * bu + (y - by) * bv
    depth_a, depth_b = (y - ay) * au - (x - ax) * av, (y - by) * bu - (x - bx) * bv
    sense = table[base, SENSE]
    left, right = 0, -1
    if ahead_a > 0.0 and ahead_b < 0.0:
        left, right = j0, j1
    elif sense > 0.0 and ahead_a > 0.0:
        for k in range(j0 + 1, j1 + 1):
            if _along(table, k, x, y) < 0.0:
                left, right = j0, k - 1
                break
    elif sense > 0.0 and ahead_b < 0.0:
        for k in range(j1, j0, -1):
            if _along(table, k, x, y) > 0.0:
                left, right = k, j1
                break
    # of the ends (D is the least of all h, or the greatest one)
    first = sense * depth_a <= sense * depth_b
    depth, nx, ny, kappa, beyond = depth_b, -bv, bu, 0.0, ahead_b
    if first:
        depth, nx, ny, beyond = depth_a, -av, au, -ahead_a
    if beyond < 0.0:  # both distances are the same but for rounding, as on a straight arc: the other end is nearer
        beyond = max(-ahead_a, ahead_b)
    if left <= right:
        count = right - left + 1
        while count > 1:
            half = count // 2
            left = left + (half if _along(table, left + half, x, y) > 0.0 else 0)
            count = count - half
        found = _foot(table, left, x, y, w0 if left == j0 else -1.0, w1 if left == j1 else 1.0)
        if (ahead_a > 0.0 and ahead_b < 0.0) or found[0] <= depth:
            return found[0], found[1], found[2], found[3], 0.0
    return depth, nx, ny, kappa, beyond


@kernel
def arc_contact(table: Any, base: int, x: float, y: float) -> tuple[float, float, float, float]:
    """Return the normal towards a ball in touch with an arc, the curvature there, and the distance of its centre."""
    count = int(table[base, COUNT])
    best, least = base + 1, NEVER
    for k in range(base + 1, base + count + 2):
        dx, dy = x - table[k, X], y - table[k, Y]
        if dx * dx + dy * dy < least:
            best, least = k, dx * dx + dy * dy
    j = best if best == base + 1 or (best <= base + count and _along(table, best, x, y) > 0.0) else best - 1
    depth, nx, ny, kappa, _w = _foot(table, j, x, y, -1.0, 1.0)
    return nx, ny, kappa, depth


@kernel
def arc_gap(table: Any, base: int, d: float, x: float, y: float) -> tuple[float, float, float, float]:
    """Return the gap between an arc and a ball of radius d, how far beyond an end the nearest point would be, and the normal."""
    ends = touchable_part(table, base, d)
    if ends[2] < ends[0]:
        return NEVER, NEVER, 1.0, 0.0
    depth, nx, ny, _kappa, beyond = arc_depth(table, ends, x, y)
    return depth - d, beyond, nx, ny
