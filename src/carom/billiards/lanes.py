"""Several no-slip orbits in step, in vector registers: in polygons without reflex corners, and in a circle.

One orbit waits for the division that finds its next bounce. LANES orbits that make a bounce each at the same time, in loops
without branches, have four or eight of these divisions done at once. The operations are those of
:func:`carom.billiards.loop.follow`, in the same order, with the same bits (where a component is zero in the plane, so is what is
added for it). Whatever is rare (a corner, a graze, a ball that leaves) ends the chunk without a result: ``follow`` then makes these
bounces, one orbit after the other.
"""

from __future__ import annotations

import math
from typing import Any

from carom.billiards.intersections import circle_exit
from carom.core.jit.kernel import kernel
from carom.laws.law import NO_SLIP_WALL
from carom.laws.no_slip import no_slip_bounce

__all__ = ["CHUNK", "LANES", "STATE", "T", "U", "V", "W", "X", "Y", "chunk_in_step", "goes_in_step"]

LANES = 16  # (with 8 the compiler unrolls the loop over faces before it could be vectorised)
CHUNK = 64  # bounces between two times at which ``follow`` restores the energy
# Rows of LANES numbers in one array, whose strides show the compiler that they do not overlap: position, velocity, spin, time;
# then the flight's duration, the piece that is met, its normal, its ends.
X, Y, U, V, W, T, DT, PIECE, N0, N1, LOW, HIGH = (k * LANES for k in range(12))
STATE = 12 * LANES


@kernel
def goes_in_step(world: Any, pieces: Any) -> bool:
    """Return whether orbits of a table may be followed in step."""
    g = world.acceleration
    free = g[0] == 0.0 and g[1] == 0.0 and world.magnetic_field == 0.0
    plain = world.windows == world.faces and world.spheres == world.inside and world.finite_faces == 0
    circle = world.faces == 0 and world.inside == 1 and pieces[0].begin == 0.0
    polygon = world.faces > 0 and world.inside == world.faces
    return bool(world.law == NO_SLIP_WALL and world.planar == 1 and free and plain and (circle or polygon))


@kernel
def chunk_in_step(world: Any, pieces: Any, s: Any) -> bool:
    """Make CHUNK bounces of LANES orbits; False if one of them came to what only ``follow`` decides."""
    doubtful = 0
    for _ in range(CHUNK):
        if world.faces > 0:
            doubtful += _fly_to_face(world, pieces, s)
        else:
            doubtful += _fly_to_circle(pieces[0], s)
        doubtful += _reflect(world.a, world.kappa, s)
        if doubtful > 0:
            return False
    return True


@kernel
def _fly_to_face(world: Any, pieces: Any, s: Any) -> int:
    """Fly to the nearest face; return how many balls are at a corner, or meet nothing."""
    for k in range(LANES):
        s[DT + k], s[PIECE + k] = math.inf, 0.0
    for i in range(world.faces):
        n0, n1, c, number = pieces[i].n[0], pieces[i].n[1], pieces[i].c, float(i)
        for k in range(LANES):
            u = n0 * s[U + k] + n1 * s[V + k]
            d = n0 * s[X + k] + n1 * s[Y + k] - c
            t, best, which = -d / u, s[DT + k], s[PIECE + k]
            nearer = (u < 0.0) & (t < best)
            s[DT + k] = t if nearer else best
            s[PIECE + k] = number if nearer else which
    for k in range(LANES):
        p = pieces[int(s[PIECE + k])]
        s[N0 + k], s[N1 + k], s[LOW + k], s[HIGH + k] = p.n[0], p.n[1], p.low, p.high
    near = world.corner_tolerance if world.corners else -math.inf
    doubtful = 0
    for k in range(LANES):
        t = s[DT + k]
        t = t if t > 0.0 else 0.0
        x, y = s[X + k] + s[U + k] * t, s[Y + k] + s[V + k] * t
        s[X + k], s[Y + k] = x, y
        s[T + k] += t
        along = s[N1 + k] * x - s[N0 + k] * y
        good = (t < math.inf) & (along >= s[LOW + k] + near) & (along <= s[HIGH + k] - near)
        doubtful += 0 if good else 1
    return doubtful


@kernel
def _fly_to_circle(p: Any, s: Any) -> int:
    """Fly to the circle; return how many balls do not come from it."""
    r, cx, cy, inverse = p.r, p.n[0], p.n[1], p.c
    doubtful = 0
    for k in range(LANES):
        x, y, u, v = s[X + k] - cx, s[Y + k] - cy, s[U + k], s[V + k]
        t = circle_exit(x, y, u, v, r)
        good = (x * u + y * v < 0.0) & (t < math.inf)  # (past the chord's middle the other form of the root is at work)
        t = t if t > 0.0 else 0.0
        x, y = s[X + k] + u * t, s[Y + k] + v * t
        s[X + k], s[Y + k] = x, y
        s[T + k] += t
        s[N0 + k], s[N1 + k] = -(x - cx) * inverse, -(y - cy) * inverse
        doubtful += 0 if good else 1
    return doubtful


@kernel
def _reflect(a: float, kappa: float, s: Any) -> int:
    """Let the wall act; return how many balls do not leave it."""
    doubtful = 0
    for k in range(LANES):
        n0, n1 = s[N0 + k], s[N1 + k]
        v, w = no_slip_bounce((s[U + k], s[V + k], 0.0), (0.0, 0.0, s[W + k]), (n0, n1, 0.0), a, kappa)
        s[U + k], s[V + k], s[W + k] = v[0], v[1], w[2]
        doubtful += 0 if v[0] * n0 + v[1] * n1 > 0.0 else 1
    return doubtful
