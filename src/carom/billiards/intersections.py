"""Find the next piece of the boundary that a flying ball meets, and the wall's normal there.

A single ball needs no event queue: its next event is the nearest of the table's pieces. All pieces bound the ball's centre.

Where no force acts across the walls, the flight is met as a straight line: linear for a face, quadratic for a circle, a sphere, an
ellipse. Under a force across walls it is a parabola; its roots, of degree 2 (faces) or 4 (curved pieces), are those of
:mod:`carom.core.roots.first_root`, which find the first of them, and a crossing outside the ends of a piece is skipped for the next
one. The curve at a distance from an ellipse, of degree eight, is in :mod:`carom.billiards.elliptic_boundary` and
:mod:`carom.core.geometry.ellipse`; smooth curves, with a table of ``panels``, are in :mod:`carom.core.geometry.curve`. Arcs of
circles, in a magnetic field, are in :mod:`carom.billiards.circling`.
"""

from __future__ import annotations

import math
from typing import Any

from carom.billiards.circling import arc_hit
from carom.billiards.elliptic_boundary import arc_exit, arc_wall
from carom.billiards.table_records import ARC, STRAIGHT
from carom.core.geometry.curve import curve_line, curve_wall
from carom.core.geometry.curve_parabola import curve_parabola, flight_end
from carom.core.geometry.ellipse import oval_hit
from carom.core.jit.kernel import Vec, hot_kernel, kernel
from carom.core.roots.first_root import hit2, hit4, next_hit4

__all__ = ["next_hit", "straight_hit", "wall_normal"]

NEVER = math.inf
NOISE = 4e-16  # of the table's size: so much of a distance from a smooth curve is rounding


@hot_kernel
def circle_exit(x: float, y: float, u: float, v: float, r: float) -> float:
    """Return the time at which a point (x, y) with velocity (u, v) leaves a circle of radius r about the origin."""
    b = x * u + y * v
    speed = u * u + v * v
    # the half chord from the line's distance to the centre, which avoids the cancellation in b^2 - |v|^2 (|x|^2 - r^2)
    across = x * v - y * u
    inside = speed * (r * r) - across * across
    depth = r * r - (x * x + y * y)
    if depth < -1e-12 * r * r and (inside <= 0.0 or b >= 0.0):
        return NEVER  # outside it (of a table with other pieces), on a line that does not cross it
    return _chord_end(b, inside, depth, speed, r)


@hot_kernel
def _chord_end(b: float, inside: float, depth: float, speed: float, r: float) -> float:
    """Return the time to the end of a chord of a circle or sphere: b = x.v, speed = v.v, inside = the half chord's square times
    speed, depth = r^2 - x.x."""
    root = math.sqrt(inside) if inside > 0.0 else 0.0
    if b < 0.0:
        # on the circle and nearly tangent to it the root is lost in rounding; by symmetry the chord has equal halves
        if b * b < 1e-8 * speed * (r * r) and abs(depth) < 1e-14 * (r * r):
            return -2.0 * b / speed
        return (root - b) / speed
    # past the middle of the chord: the other form of the same root
    return depth / (root + b) if root + b > 0.0 else NEVER


@hot_kernel
def circle_entry(x: float, y: float, u: float, v: float, r: float) -> float:
    """Return the time at which a point outside a circle about the origin enters it; infinity where it does not."""
    b = x * u + y * v
    across = x * v - y * u
    inside = (u * u + v * v) * r * r - across * across
    if b >= 0.0 or inside <= 0.0:
        return NEVER
    return (x * x + y * y - r * r) / (math.sqrt(inside) - b)


@hot_kernel
def sphere_exit(x: Vec, v: Vec, r: float) -> float:
    """Return the time at which a point within a sphere about the origin leaves it."""
    b = x[0] * v[0] + x[1] * v[1] + x[2] * v[2]
    speed = v[0] * v[0] + v[1] * v[1] + v[2] * v[2]
    p, q, s = x[1] * v[2] - x[2] * v[1], x[2] * v[0] - x[0] * v[2], x[0] * v[1] - x[1] * v[0]
    inside = speed * r * r - (p * p + q * q + s * s)
    return _chord_end(b, inside, r * r - (x[0] * x[0] + x[1] * x[1] + x[2] * x[2]), speed, r)


@hot_kernel
def straight_hit(  # noqa: PLR0915  (one loop per kind of piece)
    world: Any, pieces: Any, panels: Any, x: Vec, v: Vec
) -> tuple[float, int]:
    """Return the time to the next piece on a straight flight, and its index; infinity and -1 where none lies ahead."""
    best = NEVER
    which = -1
    for i in range(world.faces):
        p = pieces[i]
        u = p.n[0] * v[0] + p.n[1] * v[1] + p.n[2] * v[2]
        if u < 0.0:
            d = p.n[0] * x[0] + p.n[1] * x[1] + p.n[2] * x[2] - p.c
            t = -d / u
            if t < best:
                if world.finite_faces:
                    # behind the face, or beyond its ends
                    s = p.n[1] * (x[0] + t * v[0]) - p.n[0] * (x[1] + t * v[1])
                    if (
                        d < -world.corner_tolerance
                        or s < p.begin - world.corner_tolerance
                        or s > p.end + world.corner_tolerance
                    ):
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
        if t < best and (p.begin == 0.0 or p.begin * (x[0] + t * v[0] - p.n[0]) >= -world.corner_tolerance):
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
    if world.ellipses < world.curves:
        near, squared = world.corner_tolerance * world.corner_tolerance, v[0] * v[0] + v[1] * v[1]
        for i in range(world.ellipses, world.curves):
            p = pieces[i]
            t = curve_line(panels, int(p.c), int(p.r), world.inset, NOISE * world.extent, x[0], x[1], v[0], v[1])
            if t < best and (t >= 0.0 or t * t * squared < near):
                best = t
                which = i
    for i in range(world.curves, world.spheres):
        t = sphere_exit(x, v, pieces[i].r)
        if t < best:
            best = t
            which = i
    # a ball that rounding put just behind a wall is on it
    return (best if best > 0.0 else 0.0), which


@hot_kernel
def wall_normal(world: Any, pieces: Any, panels: Any, i: int, x: Vec) -> Vec:
    """Return the normal of piece i, towards the ball, for a centre at x."""
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
    if i < world.curves:
        nx, ny, _kappa = curve_wall(panels, int(p.c), int(p.r), world.inset, p.n[0], p.n[1], x[0], x[1])
        return (nx, ny, 0.0)
    w = (1.5 - (x[0] * x[0] + x[1] * x[1] + x[2] * x[2]) * (0.5 * p.c * p.c)) * p.c
    return (-x[0] * w, -x[1] * w, -x[2] * w)


# Approach to an ellipse that counts as rounding, relative to the speed.
RELATIVE_ROUNDING_SPEED = 1e-14


@kernel
def _face_hit(d: float, u: float, h: float, near: float) -> float:
    """Return when d + u t + h t^2 falls through zero; from behind the wall, only after it has come in front of it."""
    if d >= -near:
        return hit2(d, u, h, NEVER, 0.0)
    inside = u * u - 4.0 * h * d
    if u <= 0.0 or h >= 0.0 or inside <= 0.0:
        return NEVER
    return (u + math.sqrt(inside)) / (-2.0 * h)


@kernel
def _depth_polynomial(
    x: float, y: float, u: float, v: float, g: float, h: float, r: float
) -> tuple[float, float, float, float, float]:
    """Return r^2 - |x(t)|^2 of a point that falls near a circle about the origin, as coefficients of a polynomial in t."""
    return (
        r * r - (x * x + y * y),
        -2.0 * (x * u + y * v),
        -(u * u + v * v + x * g + y * h),
        -(u * g + v * h),
        -(g * g + h * h) / 4.0,
    )


@kernel
def _parabolic_circle_exit(p: Any, near: float, x: float, y: float, u: float, v: float, g: float, h: float) -> float:
    """Return the time at which a falling point leaves a circle, or a half of one."""
    dx, dy = x - p.n[0], y - p.n[1]
    c = _depth_polynomial(dx, dy, u, v, g, h, p.r)
    t = hit4(c[0], c[1], c[2], c[3], c[4], NEVER, 0.0)
    if p.begin != 0.0:
        while t < NEVER and p.begin * (dx + (u + 0.5 * g * t) * t) < -near:
            t = next_hit4(c[0], c[1], c[2], c[3], c[4], t, NEVER)
    return t


@kernel
def _on_second_arc(p: Any, near: float, x: Vec, v: Vec, g: Any, t: float) -> bool:
    """Return whether the second of an ellipse's two arcs is met; in their corner, the one towards which the ball flies."""
    k = 1 if p.c > p.r else 0
    side, rate = x[k] + (v[k] + 0.5 * g[k] * t) * t, v[k] + g[k] * t
    second: bool = (side if abs(side) > near else rate) < 0.0
    return second


@kernel
def parabolic_hit(world: Any, pieces: Any, panels: Any, x: Vec, v: Vec) -> tuple[float, int]:
    """Return the time to the next piece on a parabolic flight, and its index; infinity and -1 where none lies ahead."""
    best = NEVER
    which = -1
    g = world.acceleration
    g0, g1, g2 = g[0], g[1], g[2]
    for i in range(world.windows):
        p = pieces[i]
        n0, n1, n2 = p.n[0], p.n[1], p.n[2]
        d = n0 * x[0] + n1 * x[1] + n2 * x[2] - p.c
        u = n0 * v[0] + n1 * v[1] + n2 * v[2]
        part = world.finite_faces and i < world.faces
        t = _face_hit(d, u, 0.5 * (n0 * g0 + n1 * g1 + n2 * g2), world.corner_tolerance if part else NEVER)
        if t < best:
            if part:
                s = n1 * (x[0] + (v[0] + 0.5 * g0 * t) * t) - n0 * (x[1] + (v[1] + 0.5 * g1 * t) * t)
                if s < p.begin - world.corner_tolerance or s > p.end + world.corner_tolerance:
                    continue
            best, which = t, i
    for i in range(world.windows, world.inside):
        t = _parabolic_circle_exit(pieces[i], world.corner_tolerance, x[0], x[1], v[0], v[1], g0, g1)
        if t < best:
            best, which = t, i
    for i in range(world.inside, world.outside):
        p = pieces[i]
        c = _depth_polynomial(x[0] - p.n[0], x[1] - p.n[1], v[0], v[1], g0, g1, p.r)
        t = hit4(-c[0], -c[1], -c[2], -c[3], -c[4], NEVER, 0.0)
        if t < best:
            best, which = t, i
    if world.outside < world.ellipses:
        p, i = pieces[world.outside], world.outside
        if world.inset > 0.0:
            slow = RELATIVE_ROUNDING_SPEED * math.sqrt(v[0] * v[0] + v[1] * v[1])
            a = world.inset
            t = oval_hit(p.c, p.r, a, 0.0, a, x[0], x[1], v[0], v[1], g0, g1, NEVER, slow)
            if world.arc_corners != 0 and t < NEVER and _on_second_arc(p, world.corner_tolerance, x, v, g, t):
                i += 1
        else:
            c = _depth_polynomial(x[0] / p.c, x[1] / p.r, v[0] / p.c, v[1] / p.r, g0 / p.c, g1 / p.r, 1.0)
            t = hit4(c[0], c[1], c[2], c[3], c[4], NEVER, 0.0)
        if t < best:
            best, which = t, i
    if world.ellipses < world.curves:
        size, near = world.extent, NOISE * world.extent
        end = flight_end(size, x[0], x[1], v[0], v[1], g0, g1)
        for i in range(world.ellipses, world.curves):
            p = pieces[i]
            most = min(best, end)
            t = curve_parabola(
                panels, int(p.c), int(p.r), world.inset, size, near, x[0], x[1], v[0], v[1], g0, g1, most
            )
            if t < best:
                best, which = t, i
    for i in range(world.curves, world.spheres):
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
def next_hit(world: Any, pieces: Any, panels: Any, x: Vec, v: Vec) -> tuple[float, int]:
    """Return how far the next piece is and its index; infinity and -1 where none lies ahead.

    The distance along the flight is its time, or on an arc the number of :mod:`carom.billiards.circling`.
    """
    if world.flight != STRAIGHT:
        if world.flight == ARC:
            return arc_hit(world, pieces, panels, x, v)
        return parabolic_hit(world, pieces, panels, x, v)
    return straight_hit(world, pieces, panels, x, v)
