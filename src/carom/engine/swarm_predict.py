"""Many balls: when a ball reaches the next face of its cell or a wall, and when it meets a neighbour."""

from __future__ import annotations

import math
from typing import Any

from carom.engine.queue import S, U
from carom.engine.swarm_arrays import CODES, NOBODY
from carom.kernel import hot_kernel
from carom.motion.roots import hit2

__all__ = ["drift", "next_turn", "soonest"]

# A pair in touch whose approach is slower than this share of its speeds (squared) is not coming in: it is the rounding of
# two balls that move along each other or, after an impact without rebound, together.
SLOW2 = 1e-28
NUMBERS = (1 << CODES) - 1


@hot_kernel
def drift(swarm: Any, ball: Any, now: float) -> None:
    """Bring a ball forward to the time now."""
    s = now - ball.clock
    if swarm.pulled:
        h = s * s / 2
        gx, gy, gz = swarm.pull[0], swarm.pull[1], swarm.pull[2]
        ball.x += ball.vx * s + gx * h
        ball.y += ball.vy * s + gy * h
        ball.z += ball.vz * s + gz * h
        ball.vx += gx * s
        ball.vy += gy * s
        ball.vz += gz * s
    else:
        ball.x += ball.vx * s
        ball.y += ball.vy * s
        ball.z += ball.vz * s
    ball.clock = now


@hot_kernel
def _axis_turn(swarm: Any, axis: int, place: int, radius: float, x: float, v: float) -> tuple[float, bool]:
    """Time until a ball leaves its cell along an axis, or meets the wall there; whether at the upper face."""
    low, high = place * swarm.size[axis], (place + 1) * swarm.size[axis]
    if not swarm.periodic[axis]:
        # the wall stands at the cell's face, the ball's centre keeps its radius from it
        if place == 0:
            low = radius
        if place + 1 == swarm.cells[axis]:
            high = swarm.side[axis] - radius
    g = swarm.pull[axis]
    if g != 0:
        up, down = hit2(high - x, -v, -g / 2, math.inf, 0.0), hit2(x - low, v, g / 2, math.inf, 0.0)
        return (up, True) if up < down else (down, False)
    upwards = v > 0
    gap = high - x if upwards else low - x
    s = gap / v if v != 0 else math.inf
    return max(s, 0.0), upwards


@hot_kernel
def next_turn(swarm: Any, ball: Any, body: Any, radius: float, now: float) -> tuple[float, int]:
    """When a ball, brought forward to now, reaches a face of its cell or a wall there, and which: 2 axis + (1 upwards)."""
    cell = body.cell
    s, up = _axis_turn(swarm, 0, cell[0], radius, ball.x, ball.vx)
    which = 1 if up else 0
    t, up = _axis_turn(swarm, 1, cell[1], radius, ball.y, ball.vy)
    if t < s:
        s, which = t, 3 if up else 2
    if swarm.axes == 3:
        t, up = _axis_turn(swarm, 2, cell[2], radius, ball.z, ball.vz)
        if t < s:
            s, which = t, 5 if up else 4
    return now + s, which


@hot_kernel
def soonest(
    swarm: Any, motions: Any, pairs: Any, found: Any, times: Any, near: Any, n: int, i: int, kinds: int, now: float
) -> tuple[float, int]:
    """The earliest collision of ball i, brought forward to now, with one of the n balls found: its time, and with whom.

    All of them fall together, so what lies between two of them is a straight line; but each has its own clock.
    """
    ball = motions[U(i)]
    vx, vy, vz = ball.vx, ball.vy, ball.vz
    row = S(ball.kind) * kinds
    speed2 = vx * vx + vy * vy + vz * vz
    gx, gy, gz = swarm.pull[0], swarm.pull[1], swarm.pull[2]
    for k in range(n):
        entry = found[U(k)]
        other = motions[U(entry & NUMBERS)]
        code = entry >> CODES
        s = now - other.clock
        h = s / 2
        ox, oy, oz = other.vx, other.vy, other.vz
        rx = near[U(code & 3)] - (other.x + (ox + gx * h) * s)
        ry = near[U(4 + ((code >> 2) & 3))] - (other.y + (oy + gy * h) * s)
        rz = near[U(8 + (code >> 4))] - (other.z + (oz + gz * h) * s)
        ux, uy, uz = vx - (ox + gx * s), vy - (oy + gy * s), vz - (oz + gz * s)
        reach2 = pairs[U(row + other.kind)].reach2
        b = rx * ux + ry * uy + rz * uz
        u2 = ux * ux + uy * uy + uz * uz
        c = rx * rx + ry * ry + rz * rz - reach2
        inside = b * b - u2 * c
        root = math.sqrt(max(inside, 0.0))
        t = max(c, 0.0) / (root - b)
        slow = SLOW2 * (u2 + speed2) * reach2 if c <= 0 else 0.0
        times[U(k)] = t if (b < 0) & (inside > 0) & (b * b > slow) else math.inf
    best, who = math.inf, NOBODY
    for k in range(n):
        t, j = times[U(k)], found[U(k)] & NUMBERS
        if t < best or (t == best and j < who):
            best, who = t, j
    return now + best, who
