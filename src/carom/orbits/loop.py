"""The loop over one ball's bounces: fly to the nearest piece, let the law say what happens, write it down.

What happens is the one contact kernel of :mod:`carom.laws.contact`, as for every ball of carom's.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Callable
from typing import Any, NamedTuple

from carom.engine.users import call_user, register_calls
from carom.kernel import Vec, dot, hot_kernel, kernel
from carom.laws.contact import wall_contact
from carom.laws.conventional import conventional_reflection
from carom.laws.no_slip import no_slip_bounce
from carom.orbits.arrays import CELLS, CONTACT, CORNER, DONE, ESCAPED, FREE, GRAZED, NO_SLIP, ROLLING
from carom.orbits.falling import next_meeting
from carom.orbits.flight import wall_at

__all__ = ["compiled", "follow", "follow_many"]


@hot_kernel
def bounce(world: Any, law: int, a: float, kappa: float, v: Vec, w: Vec, n: Vec) -> tuple[Vec, Vec]:
    """Velocity and spin after the wall. (Law and ball are handed over, so that a loop can keep what follows from them.)"""
    if law == NO_SLIP:
        return no_slip_bounce(v, w, n, a, kappa)
    if law == CONTACT:
        v1, w1, _j, _required, _regime = wall_contact(v, w, n, a, kappa, world.e, world.mu, world.beta)
        return v1, w1
    if law == ROLLING:
        return conventional_reflection(v, w, n, a, kappa)
    return call_user(world.user, v, w, n, a, kappa, world.e, world.mu, world.beta)


@hot_kernel
def fly(world: Any, x: Vec, v: Vec, t: float) -> tuple[Vec, Vec]:
    """Position and velocity after a flight."""
    g = world.pull
    h = 0.5 * t * t
    return (
        (x[0] + v[0] * t + g[0] * h, x[1] + v[1] * t + g[1] * h, x[2] + v[2] * t + g[2] * h),
        (v[0] + g[0] * t, v[1] + g[1] * t, v[2] + g[2] * t),
    )


@hot_kernel
def kinetic(v: Vec, w: Vec, a: float, kappa: float) -> float:
    """Twice the kinetic energy, per mass."""
    return dot(v, v) + kappa * (a * a) * dot(w, w)


@hot_kernel
def rise(world: Any, x: Vec, ax: float, ay: float) -> float:
    """What the force has done, twice, per mass: up to a constant."""
    g = world.pull
    twice: float = 2.0 * (g[0] * (x[0] + ax) + g[1] * (x[1] + ay) + g[2] * x[2])
    return twice


@kernel
def restored(v: Vec, w: Vec, should: float, has: float) -> tuple[Vec, Vec]:
    """Velocity and spin with the energy that rounding took: it takes some 1e-16 a bounce, often with the same sign."""
    if not (has > 0.0 and abs(should - has) < 1e-6 * has):
        return v, w
    f = 1.0 + 0.5 * (should - has) / has
    return (f * v[0], f * v[1], f * v[2]), (f * w[0], f * w[1], f * w[2])


@hot_kernel
def at_corner(world: Any, pieces: Any, i: int, x: Vec) -> bool:
    """Whether a ball that meets face i, or an arc of a curve in an ellipse, is at its end."""
    p = pieces[i]
    if i >= world.faces:
        # (the arc's corners lie on the long axis)
        across: bool = abs(x[1] if p.c > p.r else x[0]) < world.near
        return across
    s = p.n[1] * x[0] - p.n[0] * x[1]
    at: bool = s < p.low + world.near or s > p.high - world.near
    return at


def follow(  # noqa: PLR0915  (one ball's way, from the first line to the last)
    world: Any, pieces: Any, x: Vec, v: Vec, w: Vec, bounces: int, rows: Any, met: Any, last: Any
) -> tuple[int, int]:
    """Follow one ball for so many bounces: how it ended, and how many there were.

    ``rows`` (bounces or 0, 6 or 10) gets t, position, velocity and spin just after each bounce, the position not folded back
    into a periodic cell; ``met`` (the same length) the pieces. ``last`` (10) gets t and the state at the end.
    """
    t = 0.0
    k = 0
    cells = 0
    ax, ay = 0.0, 0.0
    keep = len(rows) > 0
    planar = world.planar == 1
    law, a, kappa = world.law, world.a, world.kappa
    energy = kinetic(v, w, a, kappa) - rise(world, x, ax, ay)
    ended = DONE
    while k < bounces:
        dt, i = next_meeting(world, pieces, x, v)
        if i < 0 or not dt < math.inf:
            ended = ESCAPED
            break
        x, v = fly(world, x, v, dt)
        t += dt
        if i < world.faces or world.arcs != 0:
            if world.corners and at_corner(world, pieces, i, x):
                ended = CORNER
                break
        elif i < world.windows:
            # out of one side of the cell, into the other: r is as far as they lie apart
            p = pieces[i]
            x = (x[0] + p.r * p.n[0], x[1] + p.r * p.n[1], x[2])
            ax -= p.r * p.n[0]
            ay -= p.r * p.n[1]
            cells += 1
            if cells > CELLS:
                ended = FREE
                break
            continue
        cells = 0
        n = wall_at(world, pieces, i, x)
        v, w = bounce(world, law, a, kappa, v, w, n)
        if not dot(v, n) > 0.0:
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
        if k & 63 == 0 and world.keeps:
            v, w = restored(v, w, energy + rise(world, x, ax, ay), kinetic(v, w, a, kappa))
    last[0], last[1], last[2], last[3] = t, x[0] + ax, x[1] + ay, x[2]
    last[4], last[5], last[6] = v[0], v[1], v[2]
    last[7], last[8], last[9] = w[0], w[1], w[2]
    return ended, k


# What ``follow_many`` calls: the compiled function, once there is one (a closure over it would not be cached).
_follow: Any = follow
_prange: Any = range


def follow_many(worlds: Any, pieces: Any, starts: Any, bounces: int, rows: Any, met: Any, last: Any, ends: Any) -> None:
    """Follow every row of ``starts`` (N, 9) by itself; one world, in an array: a parallel loop takes no single record."""
    for m in _prange(len(starts)):
        s = starts[m]
        ended, count = _follow(
            worlds[0], pieces, (s[0], s[1], s[2]), (s[3], s[4], s[5]), (s[6], s[7], s[8]), bounces,
            rows[m], met[m], last[m],
        )  # fmt: skip
        ends[m, 0], ends[m, 1] = ended, count


class Compiled(NamedTuple):
    """The compiled loops."""

    follow: Callable[..., Any]
    many: Callable[..., Any]


@functools.cache
def compiled() -> Compiled:
    """The loops compiled; from the second time on, loaded."""
    import numba
    from numba import from_dtype, types

    from carom.compiled import njit
    from carom.orbits.arrays import PIECES, WORLD

    global _follow, _prange  # noqa: PLW0603
    register_calls()
    world, piece, number, whole = from_dtype(WORLD), from_dtype(PIECES), types.float64, types.int64
    pieces, vec, table = types.Array(piece, 1, "C"), types.UniTuple(number, 3), types.Array(number, 2, "C")
    met, last = types.Array(types.int32, 1, "C"), types.Array(number, 1, "C")
    one = types.UniTuple(whole, 2)(world, pieces, vec, vec, vec, whole, table, met, last)
    _follow = njit(follow, signature=one, _nrt=False)
    _prange = numba.prange
    many = types.none(
        types.Array(world, 1, "C"), pieces, table, whole, types.Array(number, 3, "C"), types.Array(types.int32, 2, "C"),
        table, types.Array(whole, 2, "C"),
    )  # fmt: skip
    return Compiled(_follow, njit(follow_many, signature=many, parallel=True))
