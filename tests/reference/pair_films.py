"""Films of balls that strike balls at rest, with a known truth: small steps in time, and in the impulse of the contact.

Independent of carom: no closed form of sliding or rolling, no law of impact. N shots are followed at once.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
G, KAPPA, STEP, IMPULSES = 9.80665, 0.4, 1e-4, 400
UP = np.array([0.0, 0.0, 1.0])


class Shots(NamedTuple):
    """N shots: frames, and the truth."""

    time: Array
    """(n,) s"""
    striking: Array
    """(n, N, 2) m"""
    struck: Array
    contact: Array
    """(N,) s; NaN where the balls miss."""
    speed: Array
    """(N,) at which they meet, m/s."""
    normal: Array
    """(N,) impulse along the line of centres over the mass, m/s."""
    across: Array
    """(N, 3) impulse across it over the mass."""
    slip: Array
    """(N,) m/s, before."""


def _slide_and_roll(x: Array, v: Array, w: Array, a: float, mu: float, c: float) -> None:
    """Move balls (N, 3) for a step: friction mu or rolling resistance c on the floor, gravity above it."""
    down = x[:, 2] <= a + 1e-12
    # a ball that comes down is stopped by the floor, whose friction acts with that impulse
    stop = np.where(down, np.maximum(-v[:, 2], 0.0), 0.0)
    slip = v + np.cross(w, -a * UP)
    slip[:, 2] = 0
    size = np.linalg.norm(slip, axis=1)
    press = np.where(down, stop + G * STEP * (v[:, 2] <= 1e-9), 0.0)
    kick = -slip / np.maximum(size, 1e-300)[:, None] * np.minimum(mu * press, size * KAPPA / (1 + KAPPA))[:, None]
    v[:, 2] += stop
    v += kick
    w += np.cross(-a * UP, kick) / (KAPPA * a * a)
    speed = np.linalg.norm(v[:, :2], axis=1)
    rolls = down & (size < 1e-9 + mu * G * STEP * (1 + KAPPA) / KAPPA) & (speed > 0)
    share = np.where(rolls, np.maximum(1 - c * G * STEP / np.maximum(speed, 1e-12), 0.0), 1.0)[:, None]
    v[:, :2] *= share
    w[:, :2] *= share
    v[:, 2] -= np.where(v[:, 2] > 1e-9, G * STEP, 0.0) + np.where(~down & (v[:, 2] <= 1e-9), G * STEP, 0.0)
    x += v * STEP
    x[:, 2] = np.maximum(x[:, 2], a)


def _collide(v: Array, w: Array, u: Array, s: Array, n: Array, a: float, e: float, mu: float) -> tuple[Array, Array]:
    """Change velocities v, u and spins w, s (N, 3) of two balls that touch, n from the second to the first; return impulses."""
    total = -(1 + e) / 2 * ((v - u) * n).sum(axis=1)
    across = np.zeros_like(v)
    for _ in range(IMPULSES):
        j = total / IMPULSES
        slip = v + np.cross(w, -a * n) - u - np.cross(s, a * n)
        slip -= (slip * n).sum(axis=1)[:, None] * n
        size = np.linalg.norm(slip, axis=1)
        # (what would stop the slip: twice (1 + 1/kappa) of it for each unit)
        f = -slip / np.maximum(size, 1e-300)[:, None] * np.minimum(mu * j, size / (2 * (1 + 1 / KAPPA)))[:, None]
        push = j[:, None] * n + f
        v += push
        u -= push
        w += np.cross(-a * n, push) / (KAPPA * a * a)
        s += np.cross(a * n, -push) / (KAPPA * a * a)
        across += f
    return total, across


def drawn_shots(
    rng: np.random.Generator, count: int, e: float = 0.93, mu: float = 0.06, floor: float = 0.2, rolling: float = 0.008,
    radius: float = 0.03075, seconds: float = 1.0, rate: float = 50.0,
) -> Shots:  # fmt: skip
    """Draw shots at cut angles up to 65 degrees, from 0.7 to 3.5 m/s, of balls that roll, slide, draw or follow, with sidespin."""
    a = radius
    speed, cut, head = (
        rng.uniform(0.7, 3.5, count),
        np.radians(rng.uniform(-65, 65, count)),
        rng.uniform(0, 2 * np.pi, count),
    )
    d = np.stack([np.cos(head), np.sin(head), 0 * head], axis=-1)
    t = np.cross(UP, d)
    n = -(np.cos(cut)[:, None] * d + np.sin(cut)[:, None] * t)
    u = np.zeros((count, 3))
    y = np.tile([1.4, 0.7, a], (count, 1))
    # (so far that at least six frames of 50 a second show the way to it)
    x = y + 2 * a * n - d * (np.maximum(rng.uniform(0.15, 0.5, count), 0.16 * speed))[:, None]
    v = speed[:, None] * d
    roll = np.choose(rng.integers(3, size=count), [np.ones(count), rng.uniform(-0.5, 1.2, count), np.zeros(count)])
    w = np.cross(UP, v) / a * roll[:, None]
    w[:, 2] = rng.uniform(-0.7, 0.7, count) * speed / a
    s = np.zeros((count, 3))
    every, frames = round(1 / rate / STEP), round(seconds * rate)
    one, two = np.empty((frames, count, 2)), np.empty((frames, count, 2))
    contact, met = np.full(count, np.nan), np.full(count, np.nan)
    normal, slips, across = np.full(count, np.nan), np.full(count, np.nan), np.full((count, 3), np.nan)
    for k in range(frames * every):
        if k % every == 0:
            one[k // every], two[k // every] = x[:, :2], y[:, :2]
        r = x - y
        hit = np.flatnonzero(np.isnan(contact) & (np.linalg.norm(r, axis=1) <= 2 * a))
        if len(hit):
            line = r[hit] / np.linalg.norm(r[hit], axis=1)[:, None]
            slip = v[hit] + np.cross(w[hit], -a * line)
            met[hit], contact[hit] = -(v[hit] * line).sum(axis=1), k * STEP
            slips[hit] = np.linalg.norm(slip - (slip * line).sum(axis=1)[:, None] * line, axis=1)
            parts = [part[hit] for part in (v, w, u, s)]
            normal[hit], across[hit] = _collide(*parts, line, a, e, mu)
            for whole, part in zip((v, w, u, s), parts, strict=True):
                whole[hit] = part
        _slide_and_roll(x, v, w, a, floor, rolling)
        _slide_and_roll(y, u, s, a, floor, rolling)
    return Shots(np.arange(frames) / rate, one, two, contact, met, normal, across, slips)
