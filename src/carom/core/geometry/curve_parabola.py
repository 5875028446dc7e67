"""When a point on a parabola meets a smooth curve: the panels of :mod:`carom.core.geometry.curve` one by one.

Over a panel's chord the parallel curve is a graph eta = F(xi). The times at which the point is above or below the panel follow from
quadratics; in each such stretch the gap G(s) = eta(s) - F(xi(s)) has |G''| <= pull = |eta''| + |F'| |xi''| + |F''| xi'^2.
"""

from __future__ import annotations

import math
from typing import Any

from carom.core.geometry.curve import (
    BEND,
    CLOSE,
    CX,
    FIRST_XI,
    HALF,
    HIGH,
    LAST_XI,
    LOW,
    OX,
    SLOPE,
    W0,
    W1,
    X,
    offset_point,
)  # fmt: skip
from carom.core.jit.kernel import hot_kernel, kernel
from carom.core.roots.bracketed import least_of_chord, newton_or_half

__all__ = ["curve_parabola", "flight_end", "graph_at"]

NEVER = math.inf
OVERLAP = 1e-13  # of a panel's length: so much beyond its ends still belongs to it
ROUNDING = 32.0  # times a gap that is rounding: by so much may the nodes' function be wrong
SLOW = 1e-14  # approach that counts as rounding, relative to the speed


@kernel
def graph_at(panels: Any, j: int, a: float, xi: float) -> tuple[float, float]:
    """Return F and F' of a panel's parallel curve at xi."""
    h = panels[j, HALF]
    w = xi / h - 1.0
    if a == 0.0:
        _xi, eta, slope, _rate = offset_point(panels, j, a, w)
        return eta, slope
    low, high = panels[j, W0], panels[j, W1]
    x0, x1 = panels[j, FIRST_XI], panels[j, LAST_XI]
    w = low + (high - low) * ((xi - x0) / (x1 - x0))
    margin = 1e-9 * (high - low)
    low, high = low - margin, high + margin
    px, eta, slope, rate = xi, 0.0, 0.0, 1.0
    for _ in range(100):
        px, eta, slope, rate = offset_point(panels, j, a, w)
        off = px - xi
        if off > 0.0:
            high = w
        else:
            low = w
        new = w - off / rate if rate > 0.0 else NEVER
        if not low <= new <= high:
            new = 0.5 * (low + high)
        if abs(new - w) <= CLOSE:
            return eta - off * slope, slope
        w = new
    return eta, slope


@kernel
def _gap(
    panels: Any, j: int, a: float, x: float, y: float, u: float, v: float, g: float, h: float, s: float
) -> tuple[float, float]:
    """Return the gap at a time s, and its rate, in the chord's frame; (g, h): the acceleration."""
    eta, slope = graph_at(panels, j, a, x + (u + 0.5 * g * s) * s)
    return y + (v + 0.5 * h * s) * s - eta, v + h * s - slope * (u + g * s)


@kernel
def _root(
    panels: Any, j: int, a: float, x: float, y: float, u: float, v: float, g: float, h: float, low: float, high: float,
    gap: float, rate: float, pull: float,
) -> float:  # fmt: skip
    """Return the root between low, where the gap is positive, and high, where it is not and falls with the rate."""
    s = high
    for _ in range(200):
        if rate < 0.0:
            new = s - gap / rate
            # Newton's step is wrong by pull step^2/(2 |rate|) at most
            if low <= new <= high and pull * ((new - s) * (new - s)) <= 4e-16 * high * -rate:
                return new
        new = newton_or_half(s, gap, rate, low, high)
        if not low < new < high:
            return new
        s = new
        gap, rate = _gap(panels, j, a, x, y, u, v, g, h, s)
        if gap > 0.0:
            low = s
        else:
            high = s
    return s


@kernel
def _first_fall(  # noqa: PLR0911  (one return per outcome)
    panels: Any, j: int, a: float, near: float, tiny: float, slow: float,
    x: float, y: float, u: float, v: float, g: float, h: float, s0: float, end: float,
) -> float:  # fmt: skip
    """Return the first time between s0 and the end at which the gap falls through zero, or infinity."""
    g0, u0 = _gap(panels, j, a, x, y, u, v, g, h, s0)
    if g0 < -near:
        return NEVER  # behind the wall: it has left the interior before, or is in another part of it
    if g0 <= near and u0 < -slow:
        return s0
    fast = max(abs(u + g * s0), abs(u + g * end))
    pull = abs(h) + panels[j, SLOPE] * abs(g) + panels[j, BEND] * fast * fast
    # G >= g0 + u0 t - pull t^2/2, which is least at one of the ends
    rest = end - s0
    if g0 + (u0 - 0.5 * pull * rest) * rest > near:
        return NEVER
    if g0 <= near:
        # it touches: on to where the gap is more than rounding. (The rate is known better than the gap.)
        step, left = max(tiny, u0 / pull) if pull > 0.0 else tiny, s0
        while g0 <= near:
            if s0 >= end:
                return NEVER
            s0 = min(left + step, end)
            g0, u0 = _gap(panels, j, a, x, y, u, v, g, h, s0)
            if u0 < 0.0 and g0 <= near:
                return s0
            step = step + step
    right = end
    while s0 < end:
        g1, u1 = _gap(panels, j, a, x, y, u, v, g, h, right)
        length = right - s0
        short = length <= max(tiny, 4e-16 * right)
        if g1 > 0.0:
            if short or least_of_chord(g0, g1, length, pull) >= 0.0:
                s0, g0, u0 = right, g1, u1
                right = min(right + 2.0 * max(length, tiny, 4e-16 * right), end)
                continue
        elif u0 + pull * length < 0.0 or pull == 0.0:
            return _root(panels, j, a, x, y, u, v, g, h, s0, right, g1, u1, pull)
        elif short:
            return right
        right = s0 + length / 2.0
    return NEVER


@hot_kernel
def _reaches(d: float, u: float, h: float, after_turn: bool) -> float:
    """Return when d + u s + h s^2 is zero before its turn (or where it has none ahead), or after it; infinity where it is not."""
    inside = u * u - 4.0 * h * d
    if inside < 0.0:
        return NEVER
    root = math.sqrt(inside)
    q = -0.5 * (u + root) if u > 0.0 or (u == 0.0 and h > 0.0) else -0.5 * (u - root)
    if after_turn:
        return q / h
    return d / q if q != 0.0 else NEVER


@kernel
def _in_panel(
    panels: Any, j: int, a: float, near: float, tiny: float, slow: float,
    x: float, y: float, u: float, v: float, g: float, h: float, most: float,
) -> float:  # fmt: skip
    """Return the first time within ``most`` at which a point, in the chord's frame, meets a panel from above; or infinity."""
    high, low = panels[j, HIGH] + near, panels[j, LOW] - near
    if y > high and v >= 0.0 and h >= 0.0:
        return NEVER
    first, last = panels[j, FIRST_XI], panels[j, LAST_XI]
    margin = OVERLAP * (last - first)
    first, last = first - margin, last + margin
    g2, h2 = 0.5 * g, 0.5 * h
    turns = u * g < 0.0
    way = u if u != 0.0 else g
    begin, stop = 0.0, -u / g if turns else NEVER
    for part in range(2):
        if part == 1:
            if not turns:
                return NEVER
            begin, stop, way = stop, NEVER, -way
        if begin >= most:
            return NEVER
        xi = x + (u + g2 * begin) * begin
        far, close = (last, first) if way > 0.0 else (first, last)
        into = begin
        if (xi < first and way > 0.0) or (xi > last and way < 0.0):
            into = max(_reaches(x - close, u, g2, part == 1), begin)
        elif not first <= xi <= last:
            continue
        out = min(stop, most)
        if way != 0.0:
            out = min(out, max(_reaches(x - far, u, g2, part == 1), begin))
        if into >= out:
            continue
        # the heights in between
        eta, eta1 = y + (v + h2 * into) * into, y + (v + h2 * out) * out
        least = min(eta, eta1)
        rate = v + h * into
        if h > 0.0 and rate < 0.0 and v + h * out > 0.0:
            least = y - v * v / (2.0 * h)
        if eta < low or least > high:
            continue
        # below all of the panel it has met it
        if h < 0.0 or v < 0.0:
            down = _reaches(y - low, v, h2, v > 0.0)
            if into < down < out:
                out = down
        t = _first_fall(panels, j, a, near, tiny, slow, x, y, u, v, g, h, into, out)
        if t < NEVER:
            return t
    return NEVER


@kernel
def _leaves(size: float, x: float, u: float, g: float) -> float:
    """Return a time after which x + u s + g s^2/2 stays beyond -size and size, or beyond one of them for the first time."""
    g2, far = 0.5 * g, 1.001 * size
    up = u > 0.0 or (u == 0.0 and g > 0.0)
    if u == 0.0 and g == 0.0:
        return NEVER
    side = far if up else -far
    time = _reaches(x - side, u, g2, False)
    if time < NEVER or u * g >= 0.0:
        return max(time, 0.0)
    # it turns before, and leaves on the other side
    return max(_reaches(x + side, u, g2, True), 0.0)


@kernel
def flight_end(size: float, x: float, y: float, u: float, v: float, gx: float, gy: float) -> float:
    """Return a time after which a point on a parabola is outside a table of that size; infinity where it stays at rest."""
    return min(_leaves(size, x, u, gx), _leaves(size, y, v, gy))


@kernel
def curve_parabola(
    panels: Any, first: int, last: int, a: float, size: float, near: float,
    x: float, y: float, u: float, v: float, gx: float, gy: float, most: float,
) -> float:  # fmt: skip
    """Return the time within ``most`` at which a point on a parabola leaves through an arc; infinity where it does not.

    ``size``: of the table, m; ``near``: a gap that is rounding, m.

    A point d = v s + g s^2/2 from the start has v x g s = d x g, so that on the whole parabola, before the start and after it,
    F = 2 (v x g) (v x d) - (d x g)^2 is zero. Along the chord of two nodes F is concave; a panel lies as near to it as its bounds
    say. Where F has one sign at both nodes and is further from zero than that, the parabola does not meet the panel.
    """
    speed, pull = math.sqrt(u * u + v * v), math.sqrt(gx * gx + gy * gy)
    if most == NEVER:
        return NEVER
    tiny = near / (speed + pull * most)
    # without an acceleration F = v x d
    side = 2.0 * (u * gy - v * gx) if pull > 0.0 else 1.0
    turn = abs(side) * speed
    noise = ROUNDING * near * (pull * (speed * speed + pull * size) if pull > 0.0 else speed)
    best = NEVER
    dx, dy = panels[first, X] - x, panels[first, X + 1] - y
    across = dx * gy - dy * gx
    before = side * (u * dy - v * dx) - across * across
    for j in range(first, last):
        dx, dy = panels[j + 1, X] - x, panels[j + 1, X + 1] - y
        passed = pull * abs(across)
        across = dx * gy - dy * gx
        after = side * (u * dy - v * dx) - across * across
        f0, f1 = before, after
        before = after
        if f0 * f1 > 0.0:
            deep = panels[j, HIGH] - panels[j, LOW]
            width = pull * (panels[j, LAST_XI] - panels[j, FIRST_XI] + deep)
            if min(abs(f0), abs(f1)) > deep * (turn + 2.0 * (passed + pull * width)) + 0.25 * width * width + noise:
                continue
        ex, ey = panels[j, CX], panels[j, CX + 1]
        dx, dy = x - panels[j, OX], y - panels[j, OX + 1]
        t = _in_panel(
            panels, j, a, near, tiny, SLOW * speed, ex * dx + ey * dy, ex * dy - ey * dx, ex * u + ey * v, ex * v - ey * u,
            ex * gx + ey * gy, ex * gy - ey * gx, min(best, most),
        )  # fmt: skip
        best = min(best, t)
    return best
