"""Contacts of balls of any size and mass, and of walls, that overlap in time, followed by small steps until nothing will touch.

The forces are those of tests/reference/hertz_contacts.py (Hertz with Tsuji's damping, walls as linear springs with a dashpot,
Coulomb's friction), in steps of velocity Verlet that Numba compiles, so that hundreds of layouts can be followed by steps of
0.05 us. Nothing of carom is used.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numba
import numpy as np
from reference.hertz_contacts import POISSON, YOUNG, Wall, damping_of

Array = Any

SLOW = 1e-9  # m/s: what moves no faster is at rest, but for its last digits


class Layout(NamedTuple):
    """Balls at the beginning: radii and masses (N,), places, velocities and spins (N, 3); walls."""

    radius: Array
    mass: Array
    position: Array
    velocity: Array
    spin: Array
    restitution: float = 1.0
    friction: float = 0.0
    walls: tuple[Wall, ...] = ()


def follow(
    layout: Layout, step: float = 5e-8, ahead: float = 0.05, longest: float = 0.05
) -> tuple[float, Array, Array, Array]:
    """Return the time at which nothing touches or will touch within the time ``ahead`` on straight ways, and places, velocities and
    spins (N, 3) then.
    """
    walls = np.array(
        [
            [*w.point, *w.normal, w.contact_time, damping_of(w.restitution) / math.sqrt(5), w.friction]
            for w in layout.walls
        ]
    ).reshape(-1, 9)
    x, v, w = (np.array(one, dtype=float) for one in layout[2:5])
    modulus = YOUNG / (2 * (1 - POISSON**2))
    a, m = np.array(layout.radius, dtype=float), np.array(layout.mass, dtype=float)
    t = _follow(x, v, w, a, m, walls, modulus, damping_of(layout.restitution), layout.friction, step, ahead, longest)
    return t, x, v, w


@numba.njit
def _rub(n: Array, u: Array, turn: Array, push: float, mu: float, mt: float, step: float, f: Array) -> None:
    """Write the force of a contact: along its normal, and of friction against the slip u - turn x n, which must not turn round."""
    un = u[0] * n[0] + u[1] * n[1] + u[2] * n[2]
    t0 = u[0] - un * n[0] - (turn[1] * n[2] - turn[2] * n[1])
    t1 = u[1] - un * n[1] - (turn[2] * n[0] - turn[0] * n[2])
    t2 = u[2] - un * n[2] - (turn[0] * n[1] - turn[1] * n[0])
    slip = math.sqrt(t0 * t0 + t1 * t1 + t2 * t2)
    c = min(mu * push / max(slip, 1e-300), mt / (4 * step))
    f[0], f[1], f[2] = push * n[0] - c * t0, push * n[1] - c * t1, push * n[2] - c * t2


@numba.njit
def _twist(turn: Array, n: Array, f: Array, inertia: float) -> None:
    turn[0] -= (n[1] * f[2] - n[2] * f[1]) / inertia
    turn[1] -= (n[2] * f[0] - n[0] * f[2]) / inertia
    turn[2] -= (n[0] * f[1] - n[1] * f[0]) / inertia


@numba.njit
def _rates(x: Array, v: Array, w: Array, a: Array, m: Array, walls: Array, modulus: float, alpha: float, mu: float,
           step: float, acc: Array, turn: Array) -> bool:  # fmt: skip
    """Write accelerations and angular ones; return whether anything touches."""
    acc[:], turn[:] = 0, 0
    f, n, closed = np.zeros(3), np.zeros(3), False
    for i in range(len(a)):
        for j in range(i):
            n[:] = x[i] - x[j]
            far = math.sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2])
            depth = a[i] + a[j] - far
            if depth > 0:
                closed = closed or depth > 1e-12  # (what touches but for its last digits is not pressed)
                n /= far
                u = v[i] - v[j]
                mn = m[i] * m[j] / (m[i] + m[j])
                k = 4 / 3 * modulus * math.sqrt(a[i] * a[j] / (a[i] + a[j]))
                opening = u[0] * n[0] + u[1] * n[1] + u[2] * n[2]
                push = max(k * depth**1.5 - alpha * math.sqrt(mn * k) * depth**0.25 * opening, 0.0)
                _rub(n, u, a[i] * w[i] + a[j] * w[j], push, mu, mn / 3.5, step, f)
                acc[i] += f / m[i]
                acc[j] -= f / m[j]
                _twist(turn[i], n, f, 0.4 * m[i] * a[i])
                _twist(turn[j], n, f, 0.4 * m[j] * a[j])
        for s in range(len(walls)):
            n[:] = walls[s, 3:6]
            depth = a[i] - (
                (x[i, 0] - walls[s, 0]) * n[0] + (x[i, 1] - walls[s, 1]) * n[1] + (x[i, 2] - walls[s, 2]) * n[2]
            )
            if depth > 0:
                closed = closed or depth > 1e-12  # (what touches but for its last digits is not pressed)
                rate = math.pi / walls[s, 6]
                opening = v[i, 0] * n[0] + v[i, 1] * n[1] + v[i, 2] * n[2]
                push = m[i] * rate * max(rate * depth - 2 * walls[s, 7] * opening, 0.0)
                _rub(n, v[i], a[i] * w[i], push, walls[s, 8], m[i] / 3.5, step, f)
                acc[i] += f / m[i]
                _twist(turn[i], n, f, 0.4 * m[i] * a[i])
    return closed


@numba.njit
def _will_touch(x: Array, v: Array, a: Array, walls: Array, ahead: float) -> bool:
    """Return whether two balls, or a ball and a wall, touch within a time on straight ways."""
    for i in range(len(a)):
        for j in range(i):
            r, u, reach = x[i] - x[j], v[i] - v[j], a[i] + a[j]
            b, c, d = (r * u).sum(), (r * r).sum() - reach * reach, (u * u).sum()
            if b < -SLOW * reach and b * b >= c * d and c <= ahead * (-b + math.sqrt(b * b - c * d)):
                return True
        for s in range(len(walls)):
            gap, rate = ((x[i] - walls[s, 0:3]) * walls[s, 3:6]).sum() - a[i], (v[i] * walls[s, 3:6]).sum()
            if rate < -SLOW and gap < -rate * ahead:
                return True
    return False


@numba.njit
def _follow(x: Array, v: Array, w: Array, a: Array, m: Array, walls: Array, modulus: float, alpha: float, mu: float,
            step: float, ahead: float, longest: float) -> float:  # fmt: skip
    acc, turn, t, count = np.zeros_like(x), np.zeros_like(x), 0.0, 0
    closed = _rates(x, v, w, a, m, walls, modulus, alpha, mu, step, acc, turn)
    while closed or (_will_touch(x, v, a, walls, ahead) and t < longest):
        for _ in range(200):
            half, spin = v + acc * (step / 2), w + turn * (step / 2)
            x += half * step
            for _again in range(2):
                v[:], w[:] = half + acc * (step / 2), spin + turn * (step / 2)
                closed = _rates(x, v, w, a, m, walls, modulus, alpha, mu, step, acc, turn)
            v[:], w[:] = half + acc * (step / 2), spin + turn * (step / 2)
        count += 200
        t = count * step
    return t
