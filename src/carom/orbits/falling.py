"""The next piece that a ball meets which a force pulls across walls: on a parabola.

Roots of degree 2 (faces) or 4 (what is round) are those of :mod:`carom.motion.roots`, which never miss the first; the curve at
a distance from an ellipse has :mod:`carom.engine.swarm_oval`. A crossing where the piece is not there is passed over, and the next
one looked at.
"""

from __future__ import annotations

import math
from typing import Any

from carom.engine.swarm_oval import oval_hit
from carom.kernel import Vec, hot_kernel, kernel
from carom.motion.roots import hit2, hit4, next_hit4
from carom.orbits.flight import meeting

__all__ = ["next_meeting"]

NEVER = math.inf
SLOW = 1e-14  # of the speed: an approach to an ellipse that is rounding


@kernel
def _face(d: float, u: float, h: float, near: float) -> float:
    """When d + u t + h t^2 comes down through zero; from further behind only once it has been before the wall."""
    if d >= -near:
        return hit2(d, u, h, NEVER, 0.0)
    inside = u * u - 4.0 * h * d
    if u <= 0.0 or h >= 0.0 or inside <= 0.0:
        return NEVER
    return (u + math.sqrt(inside)) / (-2.0 * h)


@kernel
def _round(
    x: float, y: float, u: float, v: float, g: float, h: float, r: float
) -> tuple[float, float, float, float, float]:
    """How far within a circle about the origin a point is, squared, as a polynomial of time."""
    return (
        r * r - (x * x + y * y),
        -2.0 * (x * u + y * v),
        -(u * u + v * v + x * g + y * h),
        -(u * g + v * h),
        -(g * g + h * h) / 4.0,
    )


@kernel
def _exit(p: Any, near: float, x: float, y: float, u: float, v: float, g: float, h: float) -> float:
    """When a point within a circle, or a half of one, leaves it."""
    dx, dy = x - p.n[0], y - p.n[1]
    c = _round(dx, dy, u, v, g, h, p.r)
    t = hit4(c[0], c[1], c[2], c[3], c[4], NEVER, 0.0)
    if p.begin != 0.0:
        while t < NEVER and p.begin * (dx + (u + 0.5 * g * t) * t) < -near:
            t = next_hit4(c[0], c[1], c[2], c[3], c[4], t, NEVER)
    return t


@kernel
def _below(p: Any, near: float, x: Vec, v: Vec, g: Any, t: float) -> bool:
    """Whether it is the second of an ellipse's two arcs that is met; in their corner, the one to which the ball flies."""
    k = 1 if p.c > p.r else 0
    side, rate = x[k] + (v[k] + 0.5 * g[k] * t) * t, v[k] + g[k] * t
    second: bool = (side if abs(side) > near else rate) < 0.0
    return second


@kernel
def falling(world: Any, pieces: Any, x: Vec, v: Vec) -> tuple[float, int]:
    """The time to the next piece and which it is, under a force; infinity and -1 where none lies ahead."""
    best = NEVER
    which = -1
    g = world.pull
    g0, g1, g2 = g[0], g[1], g[2]
    for i in range(world.windows):
        p = pieces[i]
        n0, n1, n2 = p.n[0], p.n[1], p.n[2]
        d = n0 * x[0] + n1 * x[1] + n2 * x[2] - p.c
        u = n0 * v[0] + n1 * v[1] + n2 * v[2]
        part = world.limited and i < world.faces
        t = _face(d, u, 0.5 * (n0 * g0 + n1 * g1 + n2 * g2), world.near if part else NEVER)
        if t < best:
            if part:
                s = n1 * (x[0] + (v[0] + 0.5 * g0 * t) * t) - n0 * (x[1] + (v[1] + 0.5 * g1 * t) * t)
                if s < p.begin - world.near or s > p.end + world.near:
                    continue
            best, which = t, i
    for i in range(world.windows, world.inside):
        t = _exit(pieces[i], world.near, x[0], x[1], v[0], v[1], g0, g1)
        if t < best:
            best, which = t, i
    for i in range(world.inside, world.outside):
        p = pieces[i]
        c = _round(x[0] - p.n[0], x[1] - p.n[1], v[0], v[1], g0, g1, p.r)
        t = hit4(-c[0], -c[1], -c[2], -c[3], -c[4], NEVER, 0.0)
        if t < best:
            best, which = t, i
    if world.outside < world.ellipses:
        p, i = pieces[world.outside], world.outside
        if world.inset > 0.0:
            slow = SLOW * math.sqrt(v[0] * v[0] + v[1] * v[1])
            a = world.inset
            t = oval_hit(p.c, p.r, a, 0.0, a, x[0], x[1], v[0], v[1], g0, g1, NEVER, slow)
            if world.arcs != 0 and t < NEVER and _below(p, world.near, x, v, g, t):
                i += 1
        else:
            c = _round(x[0] / p.c, x[1] / p.r, v[0] / p.c, v[1] / p.r, g0 / p.c, g1 / p.r, 1.0)
            t = hit4(c[0], c[1], c[2], c[3], c[4], NEVER, 0.0)
        if t < best:
            best, which = t, i
    for i in range(world.ellipses, world.spheres):
        r = pieces[i].r
        t = hit4(
            r * r - (x[0] * x[0] + x[1] * x[1] + x[2] * x[2]),
            -2.0 * (x[0] * v[0] + x[1] * v[1] + x[2] * v[2]),
            -(v[0] * v[0] + v[1] * v[1] + v[2] * v[2] + x[0] * g0 + x[1] * g1 + x[2] * g2),
            -(v[0] * g0 + v[1] * g1 + v[2] * g2), -(g0 * g0 + g1 * g1 + g2 * g2) / 4.0, NEVER, 0.0,
        )  # fmt: skip
        if t < best:
            best, which = t, i
    return best, which


@hot_kernel
def next_meeting(world: Any, pieces: Any, x: Vec, v: Vec) -> tuple[float, int]:
    """The time to the next piece and which it is; infinity and -1 where none lies ahead."""
    if world.falls != 0:
        return falling(world, pieces, x, v)
    return meeting(world, pieces, x, v)
