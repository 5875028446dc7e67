"""When a ball of any radius touches an arc of a smooth curve, on a straight line or a parabola.

**Straight lines**, as in :mod:`carom.core.geometry.curve`: the centre's way leaves the curve P = E + a n, parallel to the arc at
the ball's radius a, where c = v x (P - x) rises through zero along the arc, which it does once at most. Nodes and a panel find it.

**Parabolas.** Continued by its tangents the arc bounds a convex set, and the distance D from it, positive on the ball's side,
follows from the tangents alone. With the distance h_t from the tangent at the parameter t

    D = min h_t  (the curve bends round the ball: D is concave),     D = max h_t  (it bends away: D is convex).

On the path each h_t is a polynomial of degree 2 in the time, which bounds the gap G = D - a on one side, and at the foot t of the
normal it has the gap's value and its rate. So Newton's method with these polynomials in place of tangents never passes the first
contact with an arc that bends away. Of one that bends round, G'' is at most the size of the acceleration: where the chord less
that bound stays positive, nothing is met; where G falls throughout, it has one root; every other stretch is halved (as in
:mod:`carom.core.geometry.ellipse`).
"""

from __future__ import annotations

import math
from typing import Any

from carom.core.geometry.curve import CX, OX, TX, X, offset_point, panel_crossing, panel_where_slope_is
from carom.core.geometry.curve_arcs import SEAM, SENSE, SIZE, Ends, arc_depth, node_of, touchable_part
from carom.core.jit.kernel import kernel
from carom.core.roots.bracketed import least_of_chord, newton_or_half
from carom.core.roots.first_root import hit2

__all__ = ["arc_hit"]

NEVER = math.inf
Y, TY, OY, CY = X + 1, TX + 1, OX + 1, CX + 1
BEHIND = 1e-3  # of the ball's radius: a ball that is deeper in the wall is behind it, or before another part of it
NOISE = 4e-16  # of the size: so much of a gap is rounding
SMALL = 1e-16  # of the size: so short a way is none
OVERLAP = 1e-9  # of w: so much beyond its ends still belongs to a panel
POINT = 1e-6  # of the size: tolerances of a smaller ball, or of a point, are those of a ball of this radius
ROUNDS = 8  # so often may a parabola enter and leave an arc's convex set
MOST_STEPS = 200
FEW = 4  # nodes whose tangents are asked first


@kernel
def _nodes_time(
    table: Any,
    ends: Ends,
    d: float,
    dd: float,
    x: float,
    y: float,
    vx: float,
    vy: float,
    gx: float,
    gy: float,
    way: float,
) -> float:
    """Return of the tangents at some nodes, and at the ends, how soon one is passed.

    ``way`` 1: the earliest fall of a gap, from which on D = min h_t is not above it. -1: of those in front of which the ball is,
    the latest fall, before which D = max h_t is above it; infinity where one of them is never passed. 2: the earliest rise.
    """
    j0, w0, j1, w1, _base = ends
    best = 0.0 if way < 0.0 else NEVER
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
        elif way > 0.0:
            s = NEVER
            if c2 != 0.0:
                s = hit2(c0, c1, c2, NEVER, 0.0)
            elif c1 < 0.0:
                s = -c0 / c1
            best = min(best, s)
        elif c0 > 0.0:
            s = hit2(c0, c1, c2, NEVER, 0.0)
            if s == NEVER:
                return NEVER
            best = max(best, s)
        if k > j1:
            break
    return best


@kernel
def _gap(
    table: Any,
    ends: Ends,
    d: float,
    dd: float,
    x: float,
    y: float,
    vx: float,
    vy: float,
    gx: float,
    gy: float,
    s: float,
) -> tuple[float, float, float, float, float]:
    """Return the gap at a time s, its rate, half the tangent's second derivative, the whole one, how far beyond an end."""
    h = 0.5 * s
    depth, nx, ny, kappa, beyond = arc_depth(table, ends, x + (vx + gx * h) * s, y + (vy + gy * h) * s)
    ux, uy = vx + gx * s, vy + gy * s
    across, pull = ux * ny - uy * nx, nx * gx + ny * gy
    bend = pull - across * across * (kappa / max(1.0 - kappa * depth, 1e-9))
    return depth - (d + dd * s), nx * ux + ny * uy - dd, 0.5 * pull, bend, beyond


@kernel
def _side(table: Any, k: int, a: float, x: float, y: float, u: float, v: float) -> float:
    """Return c at a node."""
    c: float = u * (table[k, Y] + a * table[k, TX] - y) - v * (table[k, X] - a * table[k, TY] - x)
    return c


@kernel
def _rising_part(
    table: Any, ends: Ends, a: float, x: float, y: float, u: float, v: float, sign: float, first: float, last: float
) -> tuple[int, int, int]:
    """Return the panels between which c rises through zero, from (``sign`` -1) or to (1) that in which v x T changes its sign.

    Last, 0, or 1 or -1 where it does so after or before its extreme value within that panel. first, last: c at the ends.
    """
    j0, _w0, j1, _w1, _base = ends
    turn, count = j0, j1 - j0 + 1
    while count > 1:
        half = count // 2
        k = turn + half
        turn = turn + (half if sign * (u * table[k, TY] - v * table[k, TX]) > 0.0 else 0)
        count = count - half
    if sign < 0.0:
        if turn < j1 and _side(table, turn + 1, a, x, y, u, v) < 0.0:
            return turn + 1, j1, 0
        before = first if turn == j0 else _side(table, turn, a, x, y, u, v)
        return turn, turn, 0 if before < 0.0 else 1
    if turn > j0 and _side(table, turn, a, x, y, u, v) >= 0.0:
        return j0, turn - 1, 0
    after = last if turn == j1 else _side(table, turn + 1, a, x, y, u, v)
    return turn, turn, 0 if after >= 0.0 else -1


@kernel
def _line_time(  # noqa: PLR0911  (one return per outcome)
    table: Any, ends: Ends, a: float, near: float, x: float, y: float, u: float, v: float
) -> float:
    """Return the time at which a straight way leaves the parallel curve of an arc, possibly negative; or infinity.

    A graze whose depth is below ``near`` (m) counts where the curve bends towards the line from both sides.
    """
    j0, w0, j1, w1, _base = ends
    ax, ay, au, av = node_of(table, j0, w0)
    bx, by, bu, bv = node_of(table, j1, w1)
    begins, ends_so = u * av - v * au > 0.0, u * bv - v * bu > 0.0
    if not begins and not ends_so:
        return NEVER
    first = u * (ay + a * au - y) - v * (ax - a * av - x)
    last = u * (by + a * bu - y) - v * (bx - a * bv - x)
    # c rises between two places; where it does not rise throughout, from or to the panel in which v x T changes its sign
    low, high, part, sign = j0, j1, 0, 0.0
    if begins and ends_so:
        if not first < 0.0 <= last:
            return NEVER
    elif ends_so:
        if last < 0.0:
            return NEVER
        sign = -1.0
    else:
        if first >= 0.0:
            return NEVER
        sign = 1.0
    if sign != 0.0:
        low, high, part = _rising_part(table, ends, a, x, y, u, v, sign, first, last)
    count = high - low + 1
    while count > 1:
        half = count // 2
        low = low + (half if _side(table, low + half, a, x, y, u, v) < 0.0 else 0)
        count = count - half
    j = low
    # in the chord's frame
    ex, ey = table[j, CX], table[j, CY]
    dx, dy = x - table[j, OX], y - table[j, OY]
    x1, y1, u1, v1 = ex * dx + ey * dy, ex * dy - ey * dx, ex * u + ey * v, ex * v - ey * u
    squared = u * u + v * v
    left, right = w0 if j == j0 else -1.0, w1 if j == j1 else 1.0
    if part != 0:
        m = panel_where_slope_is(table, j, u1, v1)
        m = min(max(m, left), right)
        px, py, _slope, _rate = offset_point(table, j, a, m)
        c = u1 * (py - y1) - v1 * (px - x1)
        if part < 0:
            if c < 0.0:
                return NEVER
            right = m
            w = 0.5 * (left + right)
        else:
            if c >= 0.0:
                if c > near * math.sqrt(squared):
                    return NEVER
                along: float = u1 * (px - x1) + v1 * (py - y1)
                return along / squared
            left = m
            w = right
    else:
        c0 = first if j == j0 else _side(table, j, a, x, y, u, v)
        c1 = last if j == j1 else _side(table, j + 1, a, x, y, u, v)
        w = left + (right - left) * (-c0 / (c1 - c0)) if c0 < 0.0 < c1 else 0.5 * (left + right)
    # (a root at a node may lie beyond it by rounding)
    time: float = panel_crossing(table, j, a, x1, y1, u1, v1, left - OVERLAP, right + OVERLAP, w) / squared
    return time


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
    g, u, _half, bend, beyond = _gap(table, ends, d, 0.0, x, y, vx, vy, 0.0, 0.0, 0.0)
    if not -BEHIND * large <= g <= max(near, SEAM * large) or beyond > SEAM * large:
        return s if 0.0 <= s <= until else NEVER
    if u < -slow or (u <= 0.0 and bend < 0.0):
        return max(s, 0.0)
    if not bend < 0.0:
        return NEVER
    return s if s > 0.0 else 2.0 * u / -bend


@kernel
def _fall_in(
    table: Any, ends: Ends, d: float, dd: float, x: float, y: float, vx: float, vy: float, gx: float, gy: float,
    low: float, high: float, g: float, u: float,
) -> float:  # fmt: skip
    """Return the one root between low, where the gap is not negative, and high, where it is g and falls with u."""
    s = high
    for _ in range(MOST_STEPS):
        new = newton_or_half(s, g, u, low, high)
        if abs(new - s) <= 4e-16 * high or not low < new < high:
            return new
        s = new
        g, u, _half, _whole, _beyond = _gap(table, ends, d, dd, x, y, vx, vy, gx, gy, s)
        if g > 0.0:
            low = s
        else:
            high = s
    return s


@kernel
def _first_fall(
    table: Any, ends: Ends, d: float, dd: float, x: float, y: float, vx: float, vy: float, gx: float, gy: float,
    s0: float, g0: float, u0: float, end: float, pull: float, tiny: float,
) -> float:  # fmt: skip
    """Return when the gap, g0 > 0 at s0 with the rate u0, falls to zero before the end, or infinity; G'' is at most ``pull``."""
    right = end
    while s0 < end:
        g1, u1, _half, _whole, _beyond = _gap(table, ends, d, dd, x, y, vx, vy, gx, gy, right)
        length = right - s0
        short = length <= max(tiny, 4e-16 * right)
        if g1 > 0.0:
            if short or least_of_chord(g0, g1, length, pull) >= 0.0:
                s0, g0, u0 = right, g1, u1
                right = min(right + 2.0 * max(length, tiny, 4e-16 * right), end)
                continue
        elif u0 + pull * length < 0.0 or pull == 0.0:
            return _fall_in(table, ends, d, dd, x, y, vx, vy, gx, gy, s0, right, g1, u1)
        elif short:
            return right
        right = s0 + length / 2.0
    return NEVER


@kernel
def _approach(
    table: Any, ends: Ends, d: float, dd: float, x: float, y: float, vx: float, vy: float, gx: float, gy: float,
    s: float, until: float, tiny: float, near: float, sign: float,
) -> float:  # fmt: skip
    """Return when the gap, times ``sign`` positive at s, falls to zero, or infinity; tangents at the feet bound it on the way."""
    for _ in range(MOST_STEPS):
        g, u, half, _whole, _beyond = _gap(table, ends, d, dd, x, y, vx, vy, gx, gy, s)
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
def _leave(
    table: Any, ends: Ends, d: float, dd: float, x: float, y: float, vx: float, vy: float, gx: float, gy: float,
    s: float, until: float, tiny: float, near: float, sign: float,
) -> tuple[float, bool]:  # fmt: skip
    """Return when the gap of a ball that touches, times ``sign``, is more than rounding, and True; or False when it falls before.

    The rate is known better than the gap, which at first is nothing but rounding.
    """
    begin, step = s, tiny
    while s < until:
        s = min(begin + step, until)
        g, u, _half, _whole, _beyond = _gap(table, ends, d, dd, x, y, vx, vy, gx, gy, s)
        if sign * g > near:
            return s, True
        if sign * u < 0.0:
            return s, False
        step = step + step
    return NEVER, True


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

    As in :mod:`carom.core.roots.first_root`, a ball in touch hits now if it approaches faster than ``slow``, and not while it
    recedes.
    """
    ends = touchable_part(table, base, d)
    if ends[2] < ends[0]:
        return NEVER
    pull, speed = math.sqrt(gx * gx + gy * gy), math.sqrt(vx * vx + vy * vy)
    if speed == 0.0 and pull == 0.0 and dd == 0.0:
        return NEVER
    if pull == 0.0 and dd == 0.0:
        return _line_hit(table, ends, d, x, y, vx, vy, until, slow)
    near, large = NOISE * table[ends[4], SIZE], max(d, POINT * table[ends[4], SIZE])
    g, u, _half, bend, beyond = _gap(table, ends, d, dd, x, y, vx, vy, gx, gy, 0.0)
    touches = -BEHIND * large <= g <= near and beyond <= SEAM * large
    if touches and (u < -slow or (u <= 0.0 and bend < 0.0)):
        return 0.0
    return _parabola_hit(table, ends, d, dd, x, y, vx, vy, gx, gy, until, touches, g)


@kernel
def _parabola_hit(
    table: Any, ends: Ends, d: float, dd: float, x: float, y: float, vx: float, vy: float, gx: float, gy: float, until: float,
    touches: bool, g: float,
) -> float:  # fmt: skip
    """:func:`arc_hit` on a parabola, of a ball that does not hit now."""
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
                if _gap(table, ends, d, dd, x, y, vx, vy, gx, gy, s)[0] >= -near:
                    s, behind = _leave(table, ends, d, dd, x, y, vx, vy, gx, gy, s, last, tiny, near, -1.0)
                if behind and s < last and sense > 0.0:
                    s = _approach(table, ends, d, dd, x, y, vx, vy, gx, gy, s, last, tiny, near, -1.0)
                elif behind and s < last:
                    h = 0.5 * s
                    x1, y1, ux, uy = x + (vx + gx * h) * s, y + (vy + gy * h) * s, vx + gx * s, vy + gy * s
                    s = s + _nodes_time(table, ends, d + dd * s, dd, x1, y1, ux, uy, gx, gy, 2.0)
                if not s < last:
                    return NEVER
            s, out = _leave(table, ends, d, dd, x, y, vx, vy, gx, gy, s, last, tiny, near, 1.0)
            if not out and s <= last:
                if _gap(table, ends, d, dd, x, y, vx, vy, gx, gy, s)[4] <= seam:
                    return s
                touches = False
                continue
        if not s < last:
            return NEVER
        if sense > 0.0:
            g, u, _half, _whole, _beyond = _gap(table, ends, d, dd, x, y, vx, vy, gx, gy, s)
            h = 0.5 * s
            x1, y1, ux, uy = x + (vx + gx * h) * s, y + (vy + gy * h) * s, vx + gx * s, vy + gy * s
            end = s + _nodes_time(table, ends, d + dd * s, dd, x1, y1, ux, uy, gx, gy, 1.0)
            s = _first_fall(
                table, ends, d, dd, x, y, vx, vy, gx, gy, s, g, u, min(end * (1.0 + 1e-9) + tiny, last), pull, tiny
            )
        else:
            s = _approach(table, ends, d, dd, x, y, vx, vy, gx, gy, s, last, tiny, near, 1.0)
        if not s <= last:
            return NEVER
        if _gap(table, ends, d, dd, x, y, vx, vy, gx, gy, s)[4] <= seam:
            return s
        out, touches = False, False
    return NEVER
