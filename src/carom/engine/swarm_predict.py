"""Many balls: when a ball reaches the next face of its cell or a wall, and when it meets a neighbour."""

from __future__ import annotations

import math
from typing import Any

from carom.engine.cells import NUMBERS
from carom.engine.queue import S, U
from carom.engine.swarm_arrays import CODES, NOBODY, PERIODIC, PULL, SIZE
from carom.kernel import hot_kernel, kernel
from carom.motion.roots import hit2

__all__ = ["BLOCK", "drift", "next_turn", "soonest"]

BLOCK = 4  # so many times are computed at once
FOREVER = 0x7FF0000000000000  # the bits of infinity


@hot_kernel
def drift(box: Any, ball: Any, now: float) -> None:
    """Bring a ball forward to the time now."""
    s = now - ball.clock
    h = s / 2
    gx, gy, gz = box[U(PULL)], box[U(PULL + 1)], box[U(PULL + 2)]
    vx, vy, vz = ball.vx, ball.vy, ball.vz
    ball.x += (vx + gx * h) * s
    ball.y += (vy + gy * h) * s
    ball.z += (vz + gz * h) * s
    ball.vx, ball.vy, ball.vz = vx + gx * s, vy + gy * s, vz + gz * s
    ball.clock = now


@hot_kernel
def _axis_turn(box: Any, grid: Any, axis: int, place: int, x: float, v: float) -> tuple[float, bool]:
    """Time until a ball leaves its cell along an axis; whether at the upper face. Outermost cells have no outer face."""
    size = box[U(SIZE + axis)]
    low, high = place * size, (place + 1) * size
    if grid[U(PERIODIC + axis)] == 0:
        if place == 0:
            low = -math.inf
        if place + 1 == grid[U(axis)]:
            high = math.inf
    g = box[U(PULL + axis)]
    if g != 0:
        up, down = hit2(high - x, -v, -g / 2, math.inf, 0.0), hit2(x - low, v, g / 2, math.inf, 0.0)
        return (up, True) if up < down else (down, False)
    upwards = v > 0
    gap = high - x if upwards else low - x
    s = gap / v if v != 0 else math.inf
    return max(s, 0.0), upwards


@hot_kernel
def next_turn(box: Any, grid: Any, flat: bool, ball: Any, plan: Any, now: float) -> tuple[float, int]:
    """When a ball, brought forward to now, reaches a face of its cell, and which: 2 axis + (1 upwards)."""
    s, up = _axis_turn(box, grid, 0, plan.cx, ball.x, ball.vx)
    which = 1 if up else 0
    t, up = _axis_turn(box, grid, 1, plan.cy, ball.y, ball.vy)
    if t < s:
        s, which = t, 3 if up else 2
    if not flat:
        t, up = _axis_turn(box, grid, 2, plan.cz, ball.z, ball.vz)
        if t < s:
            s, which = t, 5 if up else 4
    return now + s, which


@kernel
def _growing(
    motions: Any, pairs: Any, found: Any, rb: Any, ru: Any, rc: Any, times: Any, row: int, slow: float, n: int, whole: int, i: int,
    scale: float, growth: float,
) -> None:  # fmt: skip
    """The times of collisions of balls that grow: their distance of contact is scale + growth s times what it will be."""
    for k in range(whole):
        times[U(k)] = math.inf
    for k in range(n):
        if S(found[U(k)]) & NUMBERS == i:
            continue  # (a ball does not grow into itself)
        reach2 = pairs[U(row + motions[U(found[U(k)] & NUMBERS)].kind)].reach2
        b, u2, c = rb[U(k)] - reach2 * scale * growth, ru[U(k)] - reach2 * growth * growth, rc[U(k)]
        c += reach2 * (1.0 - scale * scale)
        inside = b * b - u2 * c
        if b < -slow:
            if inside > 0.0:
                times[U(k)] = max(c, 0.0) / (math.sqrt(inside) - b)
        elif u2 < 0.0:
            # they part, more slowly than they grow
            times[U(k)] = max((b + math.sqrt(max(inside, 0.0))) / -u2, 0.0)


@hot_kernel
def soonest(
    box: Any,
    kinds: int,
    slow: float,
    motions: Any,
    pairs: Any,
    found: Any,
    near: Any,
    rb: Any,
    ru: Any,
    rc: Any,
    times: Any,
    bits: Any,
    n: int,
    i: int,
    now: float,
    scale: float,
    growth: float,
    more: Any,
) -> tuple[float, int]:
    """The earliest collision of ball i, brought forward to now, with one of the n balls found: its time, and with whom.

    What is needed of every ball, then all times, then the least of them, without branches and, where the processor can,
    eight at once. ``bits`` is ``work`` seen as whole
    numbers, which stand in the same order as positive floats and whose least is found without asking what NaN would do.
    """
    ball = motions[U(i)]
    vx, vy, vz = ball.vx, ball.vy, ball.vz
    row = S(ball.kind) * kinds
    gx, gy, gz = box[U(PULL)], box[U(PULL + 1)], box[U(PULL + 2)]
    falls = (gx != 0.0) | (gy != 0.0) | (gz != 0.0)
    for k in range(n):
        entry = found[U(k)]
        other = motions[U(entry & NUMBERS)]
        code = entry >> CODES
        s = now - other.clock
        ox, oy, oz = other.vx, other.vy, other.vz
        dx, dy, dz = ox * s, oy * s, oz * s
        if falls:
            # all fall together: what lies between two of them goes straight, but each has its own clock
            dx, dy, dz = dx + gx * (s * s / 2), dy + gy * (s * s / 2), dz + gz * (s * s / 2)
            ox, oy, oz = ox + gx * s, oy + gy * s, oz + gz * s
        rx = near[U(code & 3)] - (other.x + dx)
        ry = near[U(4 + ((code >> 2) & 3))] - (other.y + dy)
        rz = near[U(8 + (code >> 4))] - (other.z + dz)
        ux, uy, uz = vx - ox, vy - oy, vz - oz
        rb[U(k)] = rx * ux + ry * uy + rz * uz
        ru[U(k)] = ux * ux + uy * uy + uz * uz
        rc[U(k)] = rx * rx + ry * ry + rz * rz - pairs[U(row + other.kind)].reach2
    whole = (n + BLOCK - 1) & -BLOCK
    for k in range(n, whole):
        rb[U(k)] = 0.0
        found[U(k)] = NOBODY
    steady = whole
    if more is not None and growth != 0.0:  # (see swarm_walls)
        _growing(motions, pairs, found, rb, ru, rc, times, row, slow, n, whole, i, scale, growth)
        steady = 0
    for k in range(steady):
        b, u2, c = rb[U(k)], ru[U(k)], rc[U(k)]
        # c + 2 b s + u2 s^2 = 0, for b < 0; overlapping and coming in is now (Bannerman, Strobl, Formella & Poeschel)
        inside = b * b - u2 * c
        t = (c if c > 0.0 else 0.0) / (math.sqrt(inside if inside > 0.0 else 0.0) - b)
        times[U(k)] = t if (b < -slow) & (inside > 0.0) else math.inf
    best = FOREVER
    for k in range(whole):
        best = min(best, bits[U(k)])
    who = NOBODY
    if best >= FOREVER:
        return math.inf, who
    for k in range(whole):
        who = min(who, S(found[U(k)]) & NUMBERS if bits[U(k)] == best else NOBODY)
    bits[U(0)] = best
    return now + times[U(0)], who
