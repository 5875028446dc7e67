"""The next piece that a flying ball meets, and the wall's normal and curvature there.

One ball needs no queue: its next event is the nearest of the table's pieces. All pieces bound the ball's centre. Where no force
acts across them, what is met is met on a straight line: linear for a face, quadratic for a circle, a sphere, an ellipse (else see
:mod:`carom.orbits.falling`). The curve at a distance from an ellipse, of degree eight, has :mod:`carom.orbits.oval`.
"""

from __future__ import annotations

import math
from typing import Any

from carom.kernel import Vec, hot_kernel
from carom.orbits.oval import arc_exit, arc_wall

__all__ = ["meeting", "wall_at"]

NEVER = math.inf


@hot_kernel
def circle_exit(x: float, y: float, u: float, v: float, r: float) -> float:
    """When a point within a circle about the origin leaves it (x, y: where it is; u, v: its velocity)."""
    b = x * u + y * v
    speed = u * u + v * v
    # the half chord, from the line's distance to the centre: without the cancellation of b^2 - |v|^2 (|x|^2 - r^2)
    across = x * v - y * u
    inside = speed * (r * r) - across * across
    depth = r * r - (x * x + y * y)
    if depth < -1e-12 * r * r and (inside <= 0.0 or b >= 0.0):
        return NEVER  # outside it, where a table has more than this circle, and not on a way through it
    root = math.sqrt(inside) if inside > 0.0 else 0.0
    if b < 0.0:
        # on the circle and nearly along it the root is lost in rounding, but there both ends of the chord are alike
        if b * b < 1e-8 * speed * (r * r) and abs(depth) < 1e-14 * (r * r):
            return -2.0 * b / speed
        return (root - b) / speed
    # (nearer to the way out: the other form of the same root)
    return depth / (root + b) if root + b > 0.0 else NEVER


@hot_kernel
def circle_entry(x: float, y: float, u: float, v: float, r: float) -> float:
    """When a point outside a circle about the origin enters it; infinity where it does not."""
    b = x * u + y * v
    across = x * v - y * u
    inside = (u * u + v * v) * r * r - across * across
    if b >= 0.0 or inside <= 0.0:
        return NEVER
    return (x * x + y * y - r * r) / (math.sqrt(inside) - b)


@hot_kernel
def sphere_exit(x: Vec, v: Vec, r: float) -> float:
    """When a point within a sphere about the origin leaves it."""
    b = x[0] * v[0] + x[1] * v[1] + x[2] * v[2]
    speed = v[0] * v[0] + v[1] * v[1] + v[2] * v[2]
    p, q, s = x[1] * v[2] - x[2] * v[1], x[2] * v[0] - x[0] * v[2], x[0] * v[1] - x[1] * v[0]
    inside = speed * r * r - (p * p + q * q + s * s)
    root = math.sqrt(inside) if inside > 0.0 else 0.0
    depth = r * r - (x[0] * x[0] + x[1] * x[1] + x[2] * x[2])
    if b < 0.0:
        if b * b < 1e-8 * speed * (r * r) and abs(depth) < 1e-14 * (r * r):
            return -2.0 * b / speed
        return (root - b) / speed
    return depth / (root + b) if root + b > 0.0 else NEVER


@hot_kernel
def meeting(world: Any, pieces: Any, x: Vec, v: Vec) -> tuple[float, int]:
    """The time to the next piece and which it is; infinity and -1 where none lies ahead."""
    best = NEVER
    which = -1
    for i in range(world.faces):
        p = pieces[i]
        u = p.n[0] * v[0] + p.n[1] * v[1] + p.n[2] * v[2]
        if u < 0.0:
            d = p.n[0] * x[0] + p.n[1] * x[1] + p.n[2] * x[2] - p.c
            t = -d / u
            if t < best:
                if world.limited:
                    # behind it, or past its ends
                    s = p.n[1] * (x[0] + t * v[0]) - p.n[0] * (x[1] + t * v[1])
                    if d < -world.near or s < p.begin - world.near or s > p.end + world.near:
                        continue
                best = t
                which = i
    for i in range(world.faces, world.windows):
        p = pieces[i]
        u = p.n[0] * v[0] + p.n[1] * v[1]
        if u < 0.0:
            t = (p.c - p.n[0] * x[0] - p.n[1] * x[1]) / u
            if t < best:
                best = t
                which = i
    for i in range(world.windows, world.inside):
        p = pieces[i]
        t = circle_exit(x[0] - p.n[0], x[1] - p.n[1], v[0], v[1], p.r)
        if t < best and (p.begin == 0.0 or p.begin * (x[0] + t * v[0] - p.n[0]) >= -world.near):
            best = t
            which = i
    for i in range(world.inside, world.outside):
        p = pieces[i]
        t = circle_entry(x[0] - p.n[0], x[1] - p.n[1], v[0], v[1], p.r)
        if t < best:
            best = t
            which = i
    for i in range(world.outside, world.ellipses):
        p = pieces[i]
        if world.inset > 0.0:
            t = arc_exit(x[0], x[1], v[0], v[1], p, world.inset)
        else:
            t = circle_exit(x[0] / p.c, x[1] / p.r, v[0] / p.c, v[1] / p.r, 1.0)
        if t < best:
            best = t
            which = i
    for i in range(world.ellipses, world.spheres):
        t = sphere_exit(x, v, pieces[i].r)
        if t < best:
            best = t
            which = i
    # what rounding put a hair behind a wall is on it
    return (best if best > 0.0 else 0.0), which


@hot_kernel
def wall_at(world: Any, pieces: Any, i: int, x: Vec) -> Vec:
    """The normal of piece i, towards the ball, where the centre is at x."""
    p = pieces[i]
    if i < world.windows:
        return (p.n[0], p.n[1], p.n[2])
    if i < world.outside:
        dx, dy = x[0] - p.n[0], x[1] - p.n[1]
        w = p.c
        if i < world.inside:
            return (-dx * w, -dy * w, 0.0)
        return (dx * w, dy * w, 0.0)
    if i < world.ellipses:
        return arc_wall(p, world.inset, x[0], x[1])[0]
    w = (1.5 - (x[0] * x[0] + x[1] * x[1] + x[2] * x[2]) * (0.5 * p.c * p.c)) * p.c
    return (-x[0] * w, -x[1] * w, -x[2] * w)
