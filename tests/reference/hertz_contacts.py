"""Contacts of balls that overlap in time, integrated in full: an independent checker of the event of a cluster.

Every pair that overlaps by d pushes with Hertz's force k d^(3/2), k = (4/3) E* sqrt(R*), and Tsuji's damping
alpha sqrt(m k) d^(1/4) d', never below 0; friction is Coulomb's. Small steps of velocity Verlet, places that move, all pairs, plain
NumPy: nothing of carom is used. With s = d^(5/4) the collision of one pair is a linear spring with a dashpot, zeta =
alpha / sqrt(5), that must not pull, whose restitution is known in closed form (Schwager & Poschel, Granular Matter 9, 465 (2007));
alpha is its root, found by bisection.

Walls are planes that push a ball of mass m as a linear spring with a dashpot, k = m (pi / T)^2, T the time for which a ball alone
touches the wall without loss: F = k d + 2 zeta sqrt(m k) d', never below 0, whose restitution is that same function of zeta.
"""

from __future__ import annotations

import json
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

Array = Any
RADIUS, MASS, YOUNG, POISSON = 0.028575, 0.17, 5.84e9, 0.34


def restitution_of(alpha: float) -> float:
    """Return e of one pair with Tsuji's damping alpha."""
    z = alpha / math.sqrt(5)
    if z == 1:
        return math.exp(-2)
    w = math.sqrt(abs(1 - z * z))
    if z < 1:
        return math.exp(-z / w * (math.pi - math.atan2(2 * z * w, 1 - 2 * z * z)))
    return math.exp(-z / w * math.log((z + w) / (z - w)))


def damping_of(restitution: float) -> float:
    """Return Tsuji's alpha of one pair's restitution, 0 < e <= 1."""
    low, high = 0.0, 1e3
    for _ in range(100):
        alpha = (low + high) / 2
        low, high = (alpha, high) if restitution_of(alpha) > restitution else (low, alpha)
    return (low + high) / 2


class Wall(NamedTuple):
    """A plane through a point, with its unit normal towards the balls."""

    point: Array
    normal: Array
    contact_time: float
    restitution: float = 0.85
    friction: float = 0.0


class Case(NamedTuple):
    """Balls at the beginning: places, velocities and spins (N, 3)."""

    position: Array
    velocity: Array
    spin: Array
    restitution: float = 0.95
    friction: float | Callable[[Array], Array] = 0.0
    """A coefficient, or one as a function of the slip, m/s."""
    radius: float = RADIUS
    mass: float = MASS
    young: float = YOUNG
    poisson: float = POISSON
    walls: tuple[Wall, ...] = ()


def contact_time(case: Case, speed: float) -> float:
    """Return how long two elastic balls touch, s (Hertz)."""
    k = 4 / 3 * case.young / (2 * (1 - case.poisson**2)) * math.sqrt(case.radius / 2)
    return 2.9432750577 * (5 * case.mass / 2 / (4 * k)) ** 0.4 * speed**-0.2


def integrate(case: Case, duration: float, step: float = 1e-6) -> tuple[Array, Array, Array]:
    """Return places, velocities and spins (N, 3) after a duration; nothing acts on the balls but their contacts."""
    x, v, w = (np.array(one, dtype=float) for one in (case.position, case.velocity, case.spin))
    i, j = np.triu_indices(len(x), 1)
    near = np.linalg.norm(x[j] - x[i], axis=1) < 2 * case.radius + 2 * duration * np.abs(v).max()
    i, j = i[near], j[near]
    k = 4 / 3 * case.young / (2 * (1 - case.poisson**2)) * math.sqrt(case.radius / 2)
    c = damping_of(case.restitution) * math.sqrt(case.mass / 2 * k)
    walls = [(one, np.array(one.normal), damping_of(one.restitution) / math.sqrt(5)) for one in case.walls]

    def rates(x: Array, v: Array, w: Array) -> tuple[Array, Array]:
        """Return the accelerations, and the angular ones."""
        apart = x[j] - x[i]
        length = np.sqrt((apart * apart).sum(axis=1))
        touch = np.flatnonzero(length < 2 * case.radius)
        acc, turn = np.zeros_like(v), np.zeros_like(w)
        if len(touch):
            one, two = i[touch], j[touch]
            n, depth = apart[touch] / length[touch, None], 2 * case.radius - length[touch]
            u = v[two] - v[one]
            opening = (u * n).sum(axis=1)
            push = np.maximum(k * depth**1.5 - c * depth**0.25 * opening, 0.0)
            slip = u - opening[:, None] * n - case.radius * np.cross(w[one] + w[two], n)
            speed = np.sqrt((slip * slip).sum(axis=1))
            # (no more than ends the slip in some steps: it must not turn round)
            mu = case.friction(speed) if callable(case.friction) else case.friction
            rub = np.minimum(mu * push, case.mass / 7 * speed / (4 * step))
            f = push[:, None] * n - (rub / np.maximum(speed, 1e-300))[:, None] * slip
            np.add.at(acc, two, f / case.mass)
            np.add.at(acc, one, -f / case.mass)
            twist = np.cross(n, f) / (0.4 * case.mass * case.radius)
            np.add.at(turn, two, -twist)
            np.add.at(turn, one, -twist)
        for wall, normal, zeta in walls:
            depth = case.radius - (x - wall.point) @ normal
            opening, rate = v @ normal, math.pi / wall.contact_time
            push = case.mass * rate * np.maximum(rate * depth - 2 * zeta * opening, 0.0) * (depth > 0)
            slip = v - opening[:, None] * normal - case.radius * np.cross(w, normal)
            speed = np.sqrt((slip * slip).sum(axis=1))
            rub = np.minimum(wall.friction * push, case.mass * 2 / 7 * speed / (4 * step)) * (push > 0)
            f = push[:, None] * normal - (rub / np.maximum(speed, 1e-300))[:, None] * slip
            acc += f / case.mass
            turn -= np.cross(normal, f) / (0.4 * case.mass * case.radius)
        return acc, turn

    acc, turn = rates(x, v, w)
    for _ in range(round(duration / step)):
        half, spin = v + acc * (step / 2), w + turn * (step / 2)
        x = x + half * step
        # (forces depend on velocities too: once with those of the half step, once with the ones that follow)
        acc, turn = rates(x, half + acc * (step / 2), spin + turn * (step / 2))
        acc, turn = rates(x, half + acc * (step / 2), spin + turn * (step / 2))
        v, w = half + acc * (step / 2), spin + turn * (step / 2)
    return x, v, w


def known() -> dict[str, Any]:
    """Return the reference of tests/reference/hertz_contacts.json."""
    return json.loads(Path(__file__).with_suffix(".json").read_text(encoding="utf-8"))  # type: ignore[no-any-return]


def known_case(one: dict[str, Any]) -> Case:
    """Return a case of the reference."""
    return Case(
        *(one[name] for name in (
            "position", "velocity", "spin", "restitution", "friction", "radius", "mass", "young", "poisson"
        )),
        tuple(Wall(**wall) for wall in one.get("walls", ())),
    )  # fmt: skip


def rack(gap: float, spread: float = 0.0, seed: int = 0, radius: float = RADIUS, rows: int = 5) -> Array:
    """Centres (N, 3) of a triangle of balls with gaps between them, each moved at random within the spread, the first at 0."""
    pitch = 2 * radius + gap
    centres = [
        (row * pitch * math.sqrt(0.75), (k - row / 2) * pitch, radius) for row in range(rows) for k in range(row + 1)
    ]
    moved = np.random.default_rng(seed).uniform(-spread / 2, spread / 2, (len(centres), 2))
    return np.array(centres) + np.column_stack([moved, np.zeros(len(centres))])
