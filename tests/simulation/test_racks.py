"""A rack: one pair at a time, as the engine takes them, beside elastic contacts that overlap in time (docs/theory/pairs.md).

The reference integrates Hertz's contacts F = (4/3) E* sqrt(R/2) d^1.5 (1 + c v) of smooth balls in small steps, and uses nothing of
carom. It is there to keep the figures of a stated limit: that fewer balls leave a tight rack than on a real table.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import carom

RADIUS, MASS, SPEED = 0.028575, 0.163, 9.5
MODULUS, POISSON, DAMPING = 3e9, 0.3, 0.0092  # Pa, -, s/m: a restitution of 0.97 at 5 m/s
STEP, FOLLOWED = 5e-7, 0.008  # s
Array = Any


def rack(gap: float, shaken: float = 0.0, seed: int = 1) -> Array:
    """Centres of fifteen balls (15, 2), with gaps between them, each moved by at most ``shaken``, m."""
    pitch = 2 * RADIUS + gap
    centres = np.array(
        [(row * pitch * np.sqrt(0.75), (k - row / 2) * pitch) for row in range(5) for k in range(row + 1)]
    )
    return centres + np.random.default_rng(seed).uniform(-shaken, shaken, centres.shape)


def overlapping(x: Array, v: Array, until: float = FOLLOWED) -> Array:
    """Velocities (N, 2) after elastic contacts."""
    i, j = np.triu_indices(len(x), 1)
    stiffness = 4 / 3 * MODULUS / (2 * (1 - POISSON**2)) * np.sqrt(RADIUS / 2)
    x, v = x.copy(), v.copy()
    for _ in range(round(until / STEP)):
        apart = x[j] - x[i]
        length = np.hypot(apart[:, 0], apart[:, 1])
        depth = 2 * RADIUS - length
        touch = np.flatnonzero(depth > 0)
        if len(touch):
            n = apart[touch] / length[touch, None]
            opening = ((v[j[touch]] - v[i[touch]]) * n).sum(axis=1)
            push = np.maximum(stiffness * depth[touch] ** 1.5 * (1 - DAMPING * opening), 0.0)[:, None] * n
            np.add.at(v, i[touch], -push * STEP / MASS)
            np.add.at(v, j[touch], push * STEP / MASS)
        x += v * STEP
    return v


def speeds_of_both(gap: float, shaken: float = 0.0) -> tuple[Array, Array]:
    """Speeds (16,) after the break, one pair at a time and with overlapping contacts; smooth balls in the plane."""
    centres = np.vstack([[-2.002 * RADIUS, 0.0], rack(gap, shaken)])
    moving = np.zeros_like(centres)
    moving[0] = SPEED, 0.02
    balls = [
        carom.SceneBall(radius=RADIUS, mass=MASS, position=(*x, 0.0), velocity=(*v, 0.0))
        for x, v in zip(centres.tolist(), moving.tolist(), strict=True)
    ]
    scene = carom.Scene(gravity=0, balls=balls, ball_contact={"restitution": 0.97}, run={"duration": FOLLOWED})
    one_at_a_time = np.linalg.norm(carom.simulate(scene).final.velocity, axis=1)
    return one_at_a_time, np.linalg.norm(overlapping(centres, moving), axis=1)


def test_two_elastic_balls_have_the_restitution_that_is_stated() -> None:
    v = overlapping(np.array([[0.0, 0.0], [2.001 * RADIUS, 0.0]]), np.array([[5.0, 0.0], [0.0, 0.0]]), 0.001)
    assert v.sum(axis=0) == pytest.approx([5.0, 0.0], abs=1e-12)
    assert (v[1, 0] - v[0, 0]) / 5 == pytest.approx(0.97, abs=0.002)


def test_more_balls_leave_a_tight_rack_when_contacts_overlap() -> None:
    one_at_a_time, together = speeds_of_both(1e-4)
    assert ((one_at_a_time > 1).sum(), (together > 1).sum()) == (4, 12)
    assert np.median(one_at_a_time) == pytest.approx(0.36, abs=0.02)
    assert np.median(together) == pytest.approx(1.2, abs=0.1)


def test_with_wider_gaps_the_two_agree_better() -> None:
    one_at_a_time, together = speeds_of_both(1e-3, shaken=4e-4)
    assert ((one_at_a_time > 1).sum(), (together > 1).sum()) == (3, 5)
