"""Follow one ball from bounce to bounce: fly to the nearest piece of the boundary, apply the law, record the state.

The impact is the contact kernel of :mod:`carom.core.contact`, as everywhere in carom.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Callable
from typing import Any

import numpy as np

from carom.billiards.intersections import (
    ARC,
    BILLIARD,
    CORNER,
    DONE,
    ENDING,
    ESCAPED,
    FREE,
    FULL_CIRCLE,
    GRAZED,
    MAX_EMPTY_CELLS,
    PIECES,
    arc_duration,
    arcs_joined,
    circle_exit,
    next_hit,
    on_arc,
    wall_normal,
)
from carom.core.contact import wall_contact
from carom.core.jit.compile import array_of, njit, signature
from carom.core.jit.kernel import Vec, dot, hot_kernel, kernel, prange
from carom.laws.callbacks import call_user, register_calls
from carom.laws.conventional import conventional_reflection
from carom.laws.law import CONTACT_WALL, NO_SLIP_WALL, ROLLING_WALL
from carom.laws.no_slip import no_slip_bounce

LANES = 16  # (with 8 the compiler unrolls the loop over faces before it could be vectorised)
CHUNK = 64  # bounces between two times at which ``iterate`` restores the energy
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
    """Make CHUNK bounces of LANES orbits; False if one of them came to what only ``iterate`` decides."""
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
        n0, n1, c, number = pieces[i].n[0], pieces[i].n[1], pieces[i].offset, float(i)
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
    r, cx, cy, inverse = p.radius, p.center[0], p.center[1], p.curvature
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


# ----------------------------------------------------------------------------------------------------
# Follow one ball from bounce to bounce: fly to the nearest piece of the boundary, apply the law, record the state.


# What an orbit goes on from: time, displacement of its periodic cell (2), bounces, energy, position in the cell, velocity, spin.
MEMORY = 14
ROUNDING = 2.0**-52


@hot_kernel
def after_impact(world: Any, law: int, a: float, kappa: float, v: Vec, w: Vec, n: Vec) -> tuple[Vec, Vec]:
    """Return velocity and spin after the impact. (Law and ball are arguments so that a loop can hoist what depends on them.)"""
    if law == NO_SLIP_WALL:
        return no_slip_bounce(v, w, n, a, kappa)
    if law == CONTACT_WALL:
        v1, w1, _j, _required, _regime = wall_contact(v, w, n, a, kappa, world.e, world.mu, world.beta)
        return v1, w1
    if law == ROLLING_WALL:
        return conventional_reflection(v, w, n, a, kappa)
    return call_user(world.user, v, w, n, a, kappa, world.e, world.mu, world.beta)


@hot_kernel
def after_flight(world: Any, x: Vec, v: Vec, t: float) -> tuple[Vec, Vec]:
    """Return position and velocity after a flight up to t, as :func:`next_hit` returns it."""
    if world.flight == ARC:
        return on_arc(world.magnetic_field, x, v, t)
    g = world.acceleration
    if g[0] == 0.0 and g[1] == 0.0 and g[2] == 0.0:  # (the next bounce waits for fewer operations)
        return (x[0] + v[0] * t, x[1] + v[1] * t, x[2] + v[2] * t), v
    h = 0.5 * t * t
    return (
        (x[0] + v[0] * t + g[0] * h, x[1] + v[1] * t + g[1] * h, x[2] + v[2] * t + g[2] * h),
        (v[0] + g[0] * t, v[1] + g[1] * t, v[2] + g[2] * t),
    )


@hot_kernel
def duration(world: Any, t: float) -> float:
    """Return the duration of a flight up to t, as :func:`next_hit` returns it."""
    if world.flight == ARC:
        return arc_duration(world.magnetic_field, t)
    return t


@hot_kernel
def twice_kinetic_energy(v: Vec, w: Vec, a: float, kappa: float) -> float:
    """Return twice the kinetic energy per mass."""
    return dot(v, v) + kappa * (a * a) * dot(w, w)


@hot_kernel
def twice_work(world: Any, x: Vec, ax: float, ay: float) -> float:
    """Return twice the work of the force per mass, up to a constant; ax, ay: displacement of the current periodic cell."""
    g = world.acceleration
    twice: float = 2.0 * (g[0] * (x[0] + ax) + g[1] * (x[1] + ay) + g[2] * x[2])
    return twice


@kernel
def energy_restored(v: Vec, w: Vec, should: float, has: float) -> tuple[Vec, Vec]:
    """Return velocity and spin scaled to the exact energy: rounding changes it by some 1e-16 per bounce, often with one sign."""
    if not (has > 0.0 and abs(should - has) < 1e-6 * has):
        return v, w
    f = 1.0 + 0.5 * (should - has) / has
    return (f * v[0], f * v[1], f * v[2]), (f * w[0], f * w[1], f * w[2])


@kernel
def at_arc_end(panels: Any, p: Any, x: Vec, near: float) -> bool:
    """Return whether a ball is at an end of an arc of a smooth curve that is a corner."""
    first, last = panels[p.first], panels[p.last]
    begins: bool = p.begins_in_corner != 0 and abs(x[0] - first[0]) < near and abs(x[1] - first[1]) < near
    ends: bool = p.ends_in_corner != 0 and abs(x[0] - last[0]) < near and abs(x[1] - last[1]) < near
    return begins or ends


@hot_kernel
def at_corner(world: Any, pieces: Any, panels: Any, i: int, x: Vec) -> bool:
    """Return whether a ball that meets face i, or an arc of a smooth curve, is at a corner."""
    p = pieces[i]
    if i >= world.ellipses:
        return at_arc_end(panels, p, x, world.corner_tolerance)
    if i >= world.faces:
        return False
    s = p.n[1] * x[0] - p.n[0] * x[1]
    at: bool = s < p.low + world.corner_tolerance or s > p.high - world.corner_tolerance
    return at


@hot_kernel
def fly_to_wall(
    world: Any, pieces: Any, panels: Any, x: Vec, v: Vec, t: float, ax: float, ay: float
) -> tuple[int, int, Vec, Vec, float, float, float, float]:
    """Fly through the windows of a periodic cell to a wall.

    Return why it meets none (an index into ENDS; DONE where it does), the piece, position and velocity there, the time, the place
    on the flight (:func:`next_hit`), and the displacement of the cell.
    """
    cells, along = 0, 0.0
    while True:
        dt, i = next_hit(world, pieces, panels, x, v)
        if i < 0 or not dt < math.inf:
            return (FREE if world.flight == ARC else ESCAPED), i, x, v, t, along, ax, ay
        x, v = after_flight(world, x, v, dt)
        t += duration(world, dt)
        along = arcs_joined(along, dt) if world.flight == ARC else along + dt
        if i < world.faces or i >= world.windows:
            break
        # leave the cell through one side, enter through the opposite one
        p = pieces[i]
        x = (x[0] + p.separation * p.n[0], x[1] + p.separation * p.n[1], x[2])
        ax -= p.separation * p.n[0]
        ay -= p.separation * p.n[1]
        cells += 1
        if cells > MAX_EMPTY_CELLS or (world.flight == ARC and along > FULL_CIRCLE):
            return FREE, -1, x, v, t, along, ax, ay
    ended = DONE
    if (i < world.faces or world.arc_corners != 0) and world.corners and at_corner(world, pieces, panels, i, x):
        ended = CORNER
    return ended, i, x, v, t, along, ax, ay


def iterate(
    world: Any,
    pieces: Any,
    panels: Any,
    x: Vec,
    v: Vec,
    w: Vec,
    bounces: int,
    share: int,
    rows: Any,
    met: Any,
    last: Any,
    memory: Any,
) -> tuple[int, int]:
    """Follow one ball for a number of bounces; return why the orbit ended (an index into ENDS) and the bounces made.

    After ``share`` of them it returns (DONE, and fewer than ``bounces``); called again with the same ``memory`` (MEMORY) it goes on
    with the same bits. A new orbit begins with zeros in there.

    ``rows`` (bounces, 6) of t, x, y, vx, vy, spin in the plane, or (bounces, 10) of t, position, velocity, spin in space,
    receives the state just after each bounce, not folded into the periodic cell (length 0: nothing is kept). ``met`` (of the same
    length) receives the pieces, ``last`` (10) time, position, velocity and spin at the end.
    """
    t, ax, ay, k = memory[0], memory[1], memory[2], int(memory[3])
    if k > 0:
        x, v = (memory[5], memory[6], memory[7]), (memory[8], memory[9], memory[10])
        w = (memory[11], memory[12], memory[13])
    keep = len(rows) > 0
    planar = world.planar == 1
    law, a, kappa = world.law, world.a, world.kappa
    energy = memory[4] if k > 0 else twice_kinetic_energy(v, w, a, kappa) - twice_work(world, x, ax, ay)
    ended = DONE
    until = min(bounces, k + share)
    while k < until:
        ended, i, x, v, t, _along, ax, ay = fly_to_wall(world, pieces, panels, x, v, t, ax, ay)
        if ended != DONE:
            break
        n = wall_normal(world, pieces, panels, i, x)
        if planar and law == NO_SLIP_WALL:  # (the same bits; zeros that the compiler sees)
            v, w = no_slip_bounce((v[0], v[1], 0.0), (0.0, 0.0, w[2]), (n[0], n[1], 0.0), a, kappa)
        else:
            v, w = after_impact(world, law, a, kappa, v, w, n)
        out = dot(v, n)
        # (of a law that loses energy the bounces become ever lower, until the normal's rounding decides)
        if not out > 0.0 or (not world.conservative and not out > ROUNDING * math.sqrt(dot(v, v))):
            ended = GRAZED
            break
        if keep:
            row = rows[k]
            row[0], row[1], row[2] = t, x[0] + ax, x[1] + ay
            if planar:
                row[3], row[4], row[5] = v[0], v[1], w[2]
            else:
                row[3], row[4], row[5], row[6], row[7], row[8], row[9] = x[2], v[0], v[1], v[2], w[0], w[1], w[2]
            met[k] = i
        k += 1
        if k % CHUNK == 0 and world.conservative:
            v, w = energy_restored(v, w, energy + twice_work(world, x, ax, ay), twice_kinetic_energy(v, w, a, kappa))
    last[0], last[1], last[2], last[3] = t, x[0] + ax, x[1] + ay, x[2]
    last[4], last[5], last[6] = v[0], v[1], v[2]
    last[7], last[8], last[9] = w[0], w[1], w[2]
    memory[0], memory[1], memory[2], memory[3], memory[4] = t, ax, ay, k, energy
    for j in range(3):
        memory[5 + j], memory[8 + j], memory[11 + j] = x[j], v[j], w[j]
    return ended, k


@kernel
def _iterate_in_step(world: Any, pieces: Any, memory: Any, until: int, s: Any) -> int:
    """Follow LANES orbits in step from their memories on, up to a doubt; return how many bounces each has made then."""
    a, kappa = world.a, world.kappa
    count = int(memory[0, 3])
    while count + CHUNK <= until:
        for k in range(LANES):
            m = memory[k]
            s[X + k], s[Y + k], s[U + k], s[V + k], s[W + k], s[T + k] = m[5], m[6], m[8], m[9], m[13], m[0]
        if not chunk_in_step(world, pieces, s):
            break
        count += CHUNK
        for k in range(LANES):
            m = memory[k]
            v, w = (s[U + k], s[V + k], m[10]), (m[11], m[12], s[W + k])
            x = (s[X + k], s[Y + k], m[7])
            v, w = energy_restored(v, w, m[4] + twice_work(world, x, m[1], m[2]), twice_kinetic_energy(v, w, a, kappa))
            m[0], m[3], m[5], m[6] = s[T + k], count, x[0], x[1]
            m[8], m[9], m[13] = v[0], v[1], w[2]
    return count


# What ``iterate_many`` calls: replaced by the compiled function (a closure over it would not be cached).
_iterate: Any = iterate


@kernel
def _iterate_row(
    world: Any,
    pieces: Any,
    panels: Any,
    s: Any,
    bounces: int,
    share: int,
    rows: Any,
    met: Any,
    last: Any,
    end: Any,
    memory: Any,
) -> None:
    """Follow one row of the starts further."""
    end.reason, end.bounces = _iterate(
        world,
        pieces,
        panels,
        (s[0], s[1], s[2]),
        (s[3], s[4], s[5]),
        (s[6], s[7], s[8]),
        bounces,
        share,
        rows,
        met,
        last,
        memory,
    )


@kernel
def _all_have_bounced(ends: Any, count: int) -> bool:
    """Return whether all orbits go on, and have made so many bounces."""
    others = 0
    for k in range(ends.shape[0]):
        others += 0 if ends[k].reason == DONE and ends[k].bounces == count else 1
    return others == 0


def iterate_many(
    worlds: Any,
    pieces: Any,
    panels: Any,
    starts: Any,
    bounces: int,
    share: int,
    rows: Any,
    met: Any,
    last: Any,
    ends: Any,
    memory: Any,
    work: Any,
) -> None:
    """Follow every row of ``starts`` (N, 9) independently, if it has not ended, for at most ``share`` more bounces.

    LANES of them in step where that is possible and no bounces are kept (:mod:`carom.billiards.loop`). The one BILLIARD is in an
    array: a parallel loop takes no record. ``work`` (N / LANES, STATE), rounded up, is room for those in step.
    """
    in_step = rows.shape[1] == 0 and goes_in_step(worlds[0], pieces)
    blocks = (len(starts) + LANES - 1) // LANES
    for block in prange(blocks):
        these = slice(block * LANES, min((block + 1) * LANES, len(starts)))
        first, own = these.start, ends[these]
        begin = own[0].bounces
        # a first part one by one: until the balls are on the wall, and a multiple of CHUNK, where the energy has just been restored
        few = CHUNK if begin == 0 else -begin % CHUNK
        together = (
            in_step
            and len(own) == LANES
            and _all_have_bounced(own, begin)
            and few + CHUNK <= min(share, bounces - begin)
        )
        if together:
            for m in range(first, first + LANES):
                _iterate_row(
                    worlds[0], pieces, panels, starts[m], bounces, few, rows[m], met[m], last[m], ends[m], memory[m]
                )
            if _all_have_bounced(own, begin + few):
                count = _iterate_in_step(worlds[0], pieces, memory[these], min(bounces, begin + share), work[block])
                for k in range(LANES):
                    own[k].bounces = count
        for m in range(first, first + len(own)):
            if ends[m].reason == DONE and (together or ends[m].bounces < bounces):
                rest = begin + share - ends[m].bounces if together else share
                _iterate_row(
                    worlds[0], pieces, panels, starts[m], bounces, rest, rows[m], met[m], last[m], ends[m], memory[m]
                )


@functools.cache
def compiled_iterate() -> Callable[..., Any]:
    """Return :func:`iterate`, compiled or loaded from the cache."""
    global _iterate  # noqa: PLW0603
    pieces, table, vec, row = array_of(PIECES), array_of(float, 2), (float, float, float), array_of(float)
    one = signature(
        (int, int), BILLIARD, pieces, table, vec, vec, vec, int, int, table, array_of(np.dtype("i4")), row, row
    )
    _iterate = njit(iterate, one, (register_calls,), _nrt=False)
    return _iterate  # type: ignore[no-any-return]


@functools.cache
def compiled_many() -> Callable[..., Any]:
    """Return :func:`iterate_many` on all cores, compiled or loaded from the cache."""
    compiled_iterate()
    pieces, table, met = array_of(PIECES), array_of(float, 2), array_of(np.dtype("i4"), 2)
    many = signature(
        None,
        array_of(BILLIARD),
        pieces,
        table,
        table,
        int,
        int,
        array_of(float, 3),
        met,
        table,
        array_of(ENDING),
        table,
        table,
    )
    return njit(iterate_many, many, (register_calls,), parallel=True)


def iterate_one(worlds: Any, pieces: Any, panels: Any, starts: Any, bounces: int, share: int, *of_each: Any) -> None:
    """Do what :func:`iterate_many` does, for one row of starts: its loop, which takes as long to compile, is not needed."""
    compiled_iterate()
    rows, met, last, ends, memory, _work = of_each
    _iterate_row(
        worlds[0],
        pieces,
        panels,
        starts[0],
        bounces,
        share,
        rows[0],
        met[0],
        last[0],
        ends.view(np.recarray)[0],
        memory[0],
    )
