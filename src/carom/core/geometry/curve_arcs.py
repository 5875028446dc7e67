"""Arcs of a smooth curve, which a ball of any radius touches: the distance, the normal, the curvature.

The curve is cut where its curvature has a greatest or least value or changes its sign. An *arc* between two such places, which
turns by no more than pi/2, touches a ball at one point at most. Continued by its tangents it bounds a convex set. The distance D
from that, positive on the ball's side, is the least of all distances h_t from tangents where the curve bends round the ball, and
the greatest of them where it bends away.

A ball larger than a radius of curvature does not touch the arc there: that part of the arc is left out, so that the tangent which
continues the rest is beyond the ball's reach.

A table has one row of numbers about the arc (COUNT ... SHARP_END), then its panels (:mod:`carom.core.geometry.curve`), then its
last node. The ball is on the left.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Sequence
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.core.geometry.curve import (
    COEFFICIENTS,
    CX,
    HALF,
    OX,
    ROW,
    TX,
    At,
    X,
    curvature,
    curve_graph,
    cut_into_panels,
    line_times,
)
from carom.core.jit.calls import Answer, address_of, answer_at, python_address, register_tables, table_at
from carom.core.jit.kernel import Vec, hot_kernel, kernel, vector, without_slopes
from carom.core.roots import MOST_STEPS, hit2, searches

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
Path = tuple[Any, Ends, float, float, float, float, float, float, float, float]
"""Table and ends of an arc, the ball's radius and its rate, the centre's place, velocity and acceleration."""


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


# ----------------------------------------------------------------------------------------------------
# When a ball of any radius touches an arc of a smooth curve, on a straight line or a parabola.
#
# **Straight lines**, as in :mod:`carom.core.geometry.curve`: the centre's way leaves the curve P = E + a n, parallel to the arc
# at
# the ball's radius a, where c = v x (P - x) rises through zero along the arc, which it does once at most. Nodes and a panel find
# it.
#
# **Parabolas.** Continued by its tangents the arc bounds a convex set, and the distance D from it, positive on the ball's side,
# follows from the tangents alone. With the distance h_t from the tangent at the parameter t
#
# D = min h_t  (the curve bends round the ball: D is concave),     D = max h_t  (it bends away: D is convex).
#
# On the path each h_t is a polynomial of degree 2 in the time, which bounds the gap G = D - a on one side, and at the foot t of
# the normal it has the gap's value and its rate. So Newton's method with these polynomials in place of tangents never passes the
# first contact with an arc that bends away. Of one that bends round, G'' is at most the size of the acceleration: where the chord
# less that bound stays positive, nothing is met; where G falls throughout, it has one root; every other stretch is halved (as in
# :mod:`carom.scene.figures.polygons`).


BEHIND = 1e-3  # of the ball's radius: a ball that is deeper in the wall is behind it, or before another part of it
NOISE = 4e-16  # of the size: so much of a gap is rounding
SMALL = 1e-16  # of the size: so short a way is none
POINT = 1e-6  # of the size: tolerances of a smaller ball, or of a point, are those of a ball of this radius
ROUNDS = 8  # so often may a parabola enter and leave an arc's convex set
FEW = 4  # nodes whose tangents are asked first


@kernel
def _tangents_time(path: Path, s: float, way: float) -> float:
    """Return of the tangents at some nodes, and at the ends, when from s on one is passed first.

    ``way`` 1: the earliest fall of a gap, from which on D = min h_t is not above it; 2: the earliest rise.
    """
    table, ends, d, dd, x, y, vx, vy, gx, gy = path
    j0, w0, j1, w1, _base = ends
    h = 0.5 * s
    x, y, d = x + (vx + gx * h) * s, y + (vy + gy * h) * s, d + dd * s
    vx, vy = vx + gx * s, vy + gy * s
    best = NEVER
    stride = 1 + (j1 - j0) // FEW
    for m in range(FEW + 2):
        k = min(j0 + m * stride, j1 + 1)
        if k == j0:
            px, py, tx, ty = node_of(table, j0, w0)
        elif k == j1 + 1:
            px, py, tx, ty = node_of(table, j1, w1)
        else:
            px, py, tx, ty = table[k, X], table[k, Y], table[k, TX], table[k, TY]
        c0 = (y - py) * tx - (x - px) * ty - d
        c1, c2 = vy * tx - vx * ty - dd, 0.5 * (gy * tx - gx * ty)
        if way == 2.0:
            best = min(best, hit2(-c0, -c1, -c2, NEVER, 0.0))
        elif c2 != 0.0:
            best = min(best, hit2(c0, c1, c2, NEVER, 0.0))
        elif c1 < 0.0:
            best = min(best, -c0 / c1)
        if k > j1:
            break
    return s + best


@kernel
def _gap_and_bend(path: Path, s: float) -> tuple[float, float, float, float, float]:
    """Return the gap at a time s, its rate, half the tangent's second derivative, the whole one, how far beyond an end."""
    table, ends, d, dd, x, y, vx, vy, gx, gy = path
    h = 0.5 * s
    depth, nx, ny, kappa, beyond = arc_depth(table, ends, x + (vx + gx * h) * s, y + (vy + gy * h) * s)
    ux, uy = vx + gx * s, vy + gy * s
    across, pull = ux * ny - uy * nx, nx * gx + ny * gy
    bend = pull - across * across * (kappa / max(1.0 - kappa * depth, 1e-9))
    return depth - (d + dd * s), nx * ux + ny * uy - dd, 0.5 * pull, bend, beyond


@kernel
def _gap(path: Path, s: float) -> tuple[float, float]:
    """Return the gap at a time s, and its rate."""
    g, u, _half, _whole, _beyond = _gap_and_bend(path, s)
    return g, u


@kernel
def _beyond_end(path: Path, s: float) -> float:
    """Return how far beyond an end of the arc the foot lies at a time s."""
    return _gap_and_bend(path, s)[4]


_first_fall, _leave = searches(_gap)


@kernel
def _side(table: Any, k: int, a: float, x: float, y: float, u: float, v: float) -> float:
    """Return c at a node."""
    c: float = u * (table[k, Y] + a * table[k, TX] - y) - v * (table[k, X] - a * table[k, TY] - x)
    return c


@kernel
def _guess(_table: Any, _j: int, low: float, high: float, c0: float, c1: float, _u: float, _v: float) -> float:
    """Return roughly w of the root of c in a panel."""
    return low + (high - low) * (-c0 / (c1 - c0)) if c0 < 0.0 < c1 else 0.5 * (low + high)


_leaving_time = line_times(_side, _guess, 1e-9)


@kernel
def _line_time(table: Any, ends: Ends, a: float, near: float, x: float, y: float, u: float, v: float) -> float:
    """Return when a point on a line leaves the parallel curve of an arc: :func:`carom.core.geometry.curve.line_times`."""
    j0, w0, j1, w1, _base = ends
    ax, ay, au, av = node_of(table, j0, w0)
    bx, by, bu, bv = node_of(table, j1, w1)
    begins, ends_so = u * av - v * au > 0.0, u * bv - v * bu > 0.0
    if not begins and not ends_so:
        return NEVER
    first = u * (ay + a * au - y) - v * (ax - a * av - x)
    last = u * (by + a * bu - y) - v * (bx - a * bv - x)
    return _leaving_time(table, j0, w0, j1, w1, begins, ends_so, first, last, a, near, x, y, u, v)


@kernel
def _line_hit(
    table: Any, ends: Ends, d: float, x: float, y: float, vx: float, vy: float, until: float, slow: float
) -> float:
    """:func:`arc_hit` on a straight line."""
    speed, near = math.sqrt(vx * vx + vy * vy), NOISE * table[ends[4], SIZE]
    large = max(d, POINT * table[ends[4], SIZE])
    s = _line_time(table, ends, d, near, x, y, vx, vy)
    if s == NEVER or s * speed > SEAM * large:
        return s if s <= until else NEVER
    if s * speed < -2.0 * BEHIND * large:
        return NEVER
    # in touch, or just behind the wall
    g, u, _half, bend, beyond = _gap_and_bend((table, ends, d, 0.0, x, y, vx, vy, 0.0, 0.0), 0.0)
    if not -BEHIND * large <= g <= max(near, SEAM * large) or beyond > SEAM * large:
        return s if 0.0 <= s <= until else NEVER
    if u < -slow or (u <= 0.0 and bend < 0.0):
        return max(s, 0.0)
    if not bend < 0.0:
        return NEVER
    return s if s > 0.0 else 2.0 * u / -bend


@kernel
def _approach(path: Path, s: float, until: float, tiny: float, near: float, sign: float) -> float:
    """Return when the gap, times ``sign`` positive at s, falls to zero, or infinity; tangents at the feet bound it on the way."""
    for _ in range(MOST_STEPS):
        g, u, half, _whole, _beyond = _gap_and_bend(path, s)
        g, u, half = sign * g, sign * u, sign * half
        if g <= 0.0:
            return s
        step = hit2(g, u, half, NEVER, 0.0)
        if s + step > until:
            return NEVER
        s = s + step
        if step <= max(tiny, 2e-16 * s):
            return s
    # (a graze, where the steps halve: it is met where less is left than rounding)
    return s if g <= near else NEVER


@kernel
def arc_hit(
    table: Any,
    base: int,
    d: float,
    dd: float,
    x: float,
    y: float,
    vx: float,
    vy: float,
    gx: float,
    gy: float,
    until: float,
    slow: float,
) -> float:
    """Return the time within ``until`` at which a ball's centre comes nearer to an arc than d + dd s, or infinity.

    As in :mod:`carom.core.roots`, a ball in touch hits now if it approaches faster than ``slow``, and not while it
    recedes.
    """
    ends = touchable_part(table, base, d)
    if ends[2] < ends[0]:
        return NEVER
    pull, speed = math.sqrt(gx * gx + gy * gy), math.sqrt(vx * vx + vy * vy)
    if speed == 0.0 and pull == 0.0 and dd == 0.0:
        return NEVER
    near, large = NOISE * table[ends[4], SIZE], max(d, POINT * table[ends[4], SIZE])
    path = (table, ends, d, dd, x, y, vx, vy, gx, gy)
    straight = pull == 0.0 and dd == 0.0
    if straight:
        s = _line_hit(table, ends, d, x, y, vx, vy, until, slow)
        if s < NEVER or table[ends[4], SENSE] < 0.0:
            return s
    g, u, _half, bend, beyond = _gap_and_bend(path, 0.0)
    # (on a line that rounding put behind a wall that bends round it, a ball comes back to that, or to the next arc)
    if straight and not -BEHIND * large <= g <= BEHIND * large:
        return NEVER
    touches = -BEHIND * large <= g <= near and beyond <= SEAM * large
    if touches and (u < -slow or (u <= 0.0 and bend < 0.0)):
        return 0.0
    return _parabola_hit(path, until, touches or (straight and g <= near), g)


@kernel
def _parabola_hit(path: Path, until: float, touches: bool, g: float) -> float:
    """:func:`arc_hit` on a parabola, of a ball that does not hit now."""
    table, ends, d, dd, x, y, vx, vy, gx, gy = path
    sense, size = table[ends[4], SENSE], table[ends[4], SIZE]
    pull, speed = math.sqrt(gx * gx + gy * gy), math.sqrt(vx * vx + vy * vy)
    near, seam = NOISE * size, SEAM * max(d, POINT * size)
    # after the last of these times its centre is outside all of the curve, or it has grown to be larger
    far = math.sqrt(x * x + y * y) + table[ends[4], SIZE] + d
    if pull > 0.0:
        last = min(until, (2.0 * speed + math.sqrt(4.0 * speed * speed + 2.0 * pull * far)) / pull)
    else:
        last = min(until, 4.0 * far / max(speed, abs(dd)))
    tiny = SMALL * size / (speed + pull * last + abs(dd))
    s, out = 0.0, g > near
    for _ in range(ROUNDS):
        if not out:
            if not touches:
                # it is behind the arc, or over a tangent that continues it: first to where it is so by more than rounding
                behind = True
                if _gap(path, s)[0] >= -near:
                    s, _g, _u, behind = _leave(path, s, last, tiny, near, -1.0)
                if behind and s < last and sense > 0.0:
                    s = _approach(path, s, last, tiny, near, -1.0)
                elif behind and s < last:
                    s = _tangents_time(path, s, 2.0)
                if not s < last:
                    return NEVER
            s, _g, _u, out = _leave(path, s, last, tiny, near, 1.0)
            if not out and s <= last:
                if _beyond_end(path, s) <= seam:
                    return s  # type: ignore[no-any-return]
                touches = False
                continue
        if not s < last:
            return NEVER
        if sense > 0.0:
            g, u = _gap(path, s)
            end = min(_tangents_time(path, s, 1.0) * (1.0 + 1e-9) + tiny, last)
            s = _first_fall(path, s, g, u, end, end, pull, NEVER, tiny)
        else:
            s = _approach(path, s, last, tiny, near, 1.0)
        if not s <= last:
            return NEVER
        if _beyond_end(path, s) <= seam:
            return s
        out, touches = False, False
    return NEVER


# ----------------------------------------------------------------------------------------------------
# An arc of a smooth curve as a feature of a vertical wall: its hits, gap, normal and bend, in the curve's own frame.
#
# Few scenes have curves, so that the engine calls :mod:`carom.core.geometry.curve_arcs` through an address, as it does for rims.
# The feature has the place p and the direction u of the curve's x axis, and in ``lo1`` the address of the arc's table. From
# places with derivatives the distance and the normal follow to first order, which is exact for derivatives: n' = -kappa t along
# the curve.


NUMBERS = 11
HIT, GAP, CONTACT = 0.0, 1.0, 2.0
LARGE = 1 << 20  # rows: more than a table has


@kernel
def call_arc(
    address: int, what: float, table: float, d: float, x: float, y: float, vx: float, vy: float, gx: float, gy: float,
    until: float, slow: float,
) -> Answer:  # fmt: skip
    """Call the kernels of an arc through their address: a hit, a gap, or a contact."""
    return answer_at(address, (what, table, d, x, y, vx, vy, gx, gy, until, slow))


def arc_entry(
    what: float, table: float, d: float, x: float, y: float, vx: float, vy: float, gx: float, gy: float, until: float,
    slow: float, out: Any,
) -> None:  # fmt: skip
    """Write what is asked of an arc: as it is called by its address, :data:`NUMBERS` numbers, and a place to write to."""
    rows = table_at(int(table), LARGE, ROW)
    if what == HIT:
        out[0] = arc_hit(rows, 0, d, 0.0, x, y, vx, vy, gx, gy, until, slow)
    elif what == GAP:
        out[0], out[1], out[2], out[3] = arc_gap(rows, 0, d, x, y)
    else:
        out[0], out[1], out[2], out[3] = arc_contact(rows, 0, x, y)


@functools.cache
def arc_address(compiled: bool = True) -> int:
    """Return the address of :func:`arc_entry`, compiled once or loaded; or one that only Python knows."""
    return (
        address_of(arc_entry, NUMBERS, keep=True, needs=(register_tables,)) if compiled else python_address(arc_entry)
    )


@kernel
def _in_frame(u: Vec, x: float, y: float) -> tuple[float, float]:
    """Return the components along the direction u and to its left."""
    return u[0] * x + u[1] * y, u[0] * y - u[1] * x


@kernel
def curve_hit(f: Any, a: float, x: Vec, v: Vec, acc: Vec, until: float, slow: float) -> float:
    """Return the time in [0, until] at which a ball of radius a touches an arc, or infinity."""
    u = vector(f.u)
    (px, py), (vx, vy), (gx, gy) = (
        _in_frame(u, x[0] - f.p[0], x[1] - f.p[1]),
        _in_frame(u, v[0], v[1]),
        _in_frame(u, acc[0], acc[1]),
    )
    return call_arc(f.at, HIT, f.lo1, a, px, py, vx, vy, gx, gy, until, slow)[0]


@kernel
def curve_gap(f: Any, a: float, x: Vec) -> float:
    """Return the gap between an arc and a ball, infinite where its nearest point is beyond an end."""
    px, py = _in_frame(vector(f.u), x[0] - f.p[0], x[1] - f.p[1])
    b, qx, qy = without_slopes(a), without_slopes(px), without_slopes(py)
    r = call_arc(f.at, GAP, without_slopes(f.lo1), b, qx, qy, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    gap = r[0] if r[1] <= SEAM * b else math.inf
    return gap + (r[2] * (px - qx) + r[3] * (py - qy) - (a - b))  # type: ignore[no-any-return]


@kernel
def _contact(f: Any, x: Vec) -> tuple[float, float, float, float, float, float]:
    """Return the normal of an arc at a ball, its curvature and the distance of the centre; the centre's change from its value."""
    px, py = _in_frame(vector(f.u), x[0] - f.p[0], x[1] - f.p[1])
    qx, qy = without_slopes(px), without_slopes(py)
    r = call_arc(f.at, CONTACT, without_slopes(f.lo1), 0.0, qx, qy, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    return r[0], r[1], r[2], r[3], px - qx, py - qy


@kernel
def curve_depth(f: Any, x: Vec) -> float:
    """Return the distance between a ball's centre and an arc."""
    nx, ny, _kappa, depth, dx, dy = _contact(f, x)
    return depth + (nx * dx + ny * dy)


@kernel
def curve_normal(f: Any, x: Vec) -> Vec:
    """Return the unit normal of an arc towards a ball."""
    nx, ny, kappa, depth, dx, dy = _contact(f, x)
    turn = (ny * dx - nx * dy) * (kappa / max(1.0 - kappa * depth, 1e-9))
    mx, my, u = nx - turn * ny, ny + turn * nx, vector(f.u)
    return (u[0] * mx - u[1] * my, u[1] * mx + u[0] * my, 0 * x[2])


@kernel
def curve_bend(f: Any, x: Vec, v: Vec) -> float:
    """Return the second derivative of the gap of a ball that moves with v, by the curvature alone."""
    nx, ny, kappa, depth, _dx, _dy = _contact(f, x)
    vx, vy = _in_frame(vector(f.u), v[0], v[1])
    along = vx * ny - vy * nx
    return -along * along * (kappa / max(1.0 - kappa * depth, 1e-9))


@kernel
def curve_is_far(f: Any, a: float, x: Vec, way: float) -> bool:
    """Return whether a ball that comes no further than ``way`` stays outside the circle in which the arc lies."""
    px, py = _in_frame(vector(f.u), x[0] - f.p[0], x[1] - f.p[1])
    px, py = px - f.d[0], py - f.d[1]
    return bool(math.sqrt(px * px + py * py) - f.R - a > way)


# ----------------------------------------------------------------------------------------------------
# Tables of the arcs of a smooth curve, on which :mod:`carom.core.geometry.curve_arcs` works, and their addresses.


Array = NDArray[np.float64]
SAMPLES = 4096  # parameters at which the curvature is looked at
REVERSAL = 1e-6  # of the largest curvature: a change of its slope that is no rounding
JOINT = 1e-11  # of the size: ends that are nearer are one place
WIDEST = math.pi / 2 + 1e-6  # rad: an arc that turns by more is divided


def _vertices(at: At, t0: float, t1: float) -> Array:
    """Return the parameters at which the curvature has a greatest or least value."""
    t = np.linspace(t0, t1, SAMPLES + 1)
    k = curvature(at, t)
    least = REVERSAL * float(np.abs(k).max())
    found, best, way = [], 0, 0
    for i in range(1, len(k)):
        rise = k[i] - k[best]
        if way == 0:
            way = int(np.sign(rise)) if abs(rise) > least else 0
            best = i if way else best
        elif rise * way > 0:
            best = i
        elif abs(rise) > least:
            found.append((best, way))
            best, way = i, -way
    vertices = []
    for i, way in found:
        low, high = t[max(i - 1, 0)], t[min(i + 1, SAMPLES)]
        for _ in range(4):
            fine = np.linspace(low, high, 33)
            here = int(np.argmax(way * curvature(at, fine)))
            low, high = fine[max(here - 1, 0)], fine[min(here + 1, 32)]
        vertices.append((low + high) / 2)
    return np.array(vertices)


def arc_tables(at: At, t0: float, t1: float, cuts: Array | None = None) -> list[Array]:
    """Return the table (P + 2, ROW) of each arc of a curve from a parameter to a larger one, in order; the ball is on the left.

    ``cuts``: parameters at which the third derivative may jump. Raises ValueError, with the parameter, where it is not smooth.
    """
    x = at(np.linspace(t0, t1, 257))[0]
    if not np.isfinite(x).all():
        raise ValueError(t0)
    size = max(float(np.linalg.norm(np.ptp(x, axis=0)) / 2), float(np.abs(x).max()))
    vertices = _vertices(at, t0, t1)
    panels = cut_into_panels(at, t0, t1, size, np.concatenate([vertices, [] if cuts is None else cuts]))
    begins = [0]
    turned = 0.0
    for k in range(1, len(panels.rows)):
        turned += float(panels.turn[k - 1])
        at_vertex = len(vertices) > 0 and bool((np.abs(vertices - panels.t[k, 0]) <= 1e-9 * (t1 - t0)).any())
        if at_vertex or panels.sign[k] != panels.sign[k - 1] or abs(turned + float(panels.turn[k])) > WIDEST:
            begins.append(k)
            turned = 0.0
    parts = [slice(*one) for one in zip(begins, [*begins[1:], len(panels.rows)], strict=True)]
    tables = [_table(at, panels.rows[k], panels.t[k], int(panels.sign[k.start]), size) for k in parts]
    join_ends([*tables, tables[0]])
    return tables


def join_ends(tables: Sequence[Array]) -> None:
    """Give an arc that ends where the next one begins, but for rounding, the very same node."""
    for one, two in pairwise(tables):
        near = np.abs(one[-1, X : X + 2] - two[1, X : X + 2]).max() <= JOINT * one[0, SIZE]
        if near and np.abs(one[-1, TX : TX + 2] - two[1, TX : TX + 2]).max() <= JOINT:
            one[-1] = 0.0
            one[-1, [X, X + 1, TX, TX + 1]] = two[1, [X, X + 1, TX, TX + 1]]


def arc_length(table: Array) -> float:
    """Return the length of an arc, m."""
    w, weights = np.polynomial.legendre.leggauss(16)
    powers = np.arange(1, ROW - COEFFICIENTS)
    half, c = table[1:-1, HALF], table[1:-1, COEFFICIENTS + 1 :]
    slope = (c * powers) @ w ** (powers[:, None] - 1) / half[:, None]
    return float((np.sqrt(1 + slope * slope) @ weights * half).sum())


def arc_circle(table: Array) -> tuple[float, float, float]:
    """Return a circle in which an arc lies: its centre and its radius."""
    nodes, half = table[1:, X : X + 2], table[1:-1, HALF]
    x, y = (nodes.min(axis=0) + nodes.max(axis=0)) / 2
    # (between two nodes it is within the length of the chord from them)
    return float(x), float(y), float(np.hypot(*(nodes - (x, y)).T).max() + 2 * half.max())


def _table(at: At, rows: Array, t: Array, sign: int, size: float) -> Array:
    count = len(rows)
    table = np.zeros((count + 2, ROW))
    table[1:-1] = rows
    nodes = np.append(t[:, 0], t[-1, 1])
    x, d, _dd = at(nodes)
    table[1:, X : X + 2], table[1:, TX : TX + 2] = x, d / np.linalg.norm(d, axis=-1, keepdims=True)
    bend = np.abs(curvature(at, nodes[[0, -1]]))
    table[0, COUNT], table[0, SENSE], table[0, SIZE] = count, -1.0 if sign < 0 else 1.0, size
    table[0, SHARPEST], table[0, SHARP_END] = 0.0 if sign == 0 else bend.max(), float(bend[1] > bend[0])
    return table
