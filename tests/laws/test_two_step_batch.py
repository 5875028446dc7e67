"""Pressed balls in lockstep: as the same law followed ball by ball, the same bits as Python, whatever the threads."""

from __future__ import annotations

import math
from typing import Any

import numba
import numpy as np
import pytest

import carom
from carom.laws import arrays
from carom.laws.arrays import FEW_AT_FIRST
from carom.laws.two_step import first_rows, two_step_plain
from carom.laws.two_step_batch import LANES, two_step_final_rows

BALL = carom.Ball(1.0, 1.0, "solid")


def balls(rng: Any, count: int) -> tuple[Any, Any]:
    """Velocities and spins: sliding, rolling, in the plane of the wall's normal, with little slip and with much."""
    v, w = rng.normal(size=(count, 3)), rng.normal(size=(count, 3)) * np.exp(rng.uniform(-2, 2, count))[:, None]
    v[:, 0], v[:, 2] = -np.abs(v[:, 0]) - 1e-3, np.where(rng.random(count) < 0.9, 0.0, -np.abs(v[:, 2]))
    some = rng.random(count)
    rolls = some < 0.4
    w[rolls, 0], w[rolls, 1] = -v[rolls, 1], v[rolls, 0]
    flat = (some > 0.4) & (some < 0.5)
    v[flat, 1] = w[flat, 0] = w[flat, 2] = 0
    return v, w


def walls(rng: Any) -> tuple[Any, ...]:
    """A wall, a floor, a normal: smooth ones, the usual, frictions that stick."""
    frictions = [0.0, 1e-3, float(rng.uniform(0, 1)), 1.0, 2.5, 10.0, math.inf]
    mu, muf = (frictions[i] for i in rng.choice(7, 2, p=[0.08, 0.05, 0.6, 0.1, 0.09, 0.04, 0.04]))
    nz = float(rng.choice([0.0, rng.uniform(-0.9, 0.4), -0.4]))
    e = float(rng.choice([0.0, 1.0, rng.uniform(0, 1)]))
    return carom.Surface(e, mu), carom.Surface(float(rng.uniform(0, 0.9)), muf), (math.sqrt(1 - nz * nz), 0.0, nz)


def into(v: Any, w: Any, wall: Any, floor: Any, normal: Any) -> tuple[Any, Any, Any]:
    out, why = carom.State(np.zeros_like(v), np.zeros_like(v)), np.zeros(len(v), dtype=np.int8)
    carom.two_step_into(out, why, BALL, carom.State(v, w), wall, floor, normal)
    return out.velocity, out.spin, why


def test_as_ball_by_ball() -> None:
    """120 walls, 500 balls each: the rolling state to 1e-7 of the speeds, but for balls on an edge between two ways."""
    rng = np.random.default_rng(70)
    off, pressed = [], 0
    for _ in range(120):
        wall, floor, normal = walls(rng)
        v, w = balls(rng, 500)
        toward = v @ np.array(normal) < -1e-6
        v, w = (np.ascontiguousarray(x[toward]) for x in (v, w))
        one = carom.two_step(BALL, carom.State(v, w), wall, floor, normal)
        v3, w3, why = into(v, w, wall, floor, normal)
        size = np.sqrt((v * v).sum(axis=-1)) + np.sqrt((w * w).sum(axis=-1))
        same = (why == 0) == one.rolls
        assert same.mean() > 0.99
        gap = np.maximum(np.abs(v3 - one.rolling.velocity), np.abs(w3 - one.rolling.spin)).max(axis=-1) / size
        off.append(gap[same & (why == 0)])
        had, has = ((x * x).sum(axis=-1) + 0.4 * (y * y).sum(axis=-1) for x, y in ((v, w), (v3, w3)))
        assert (has[why == 0] <= had[why == 0] * (1 + 1e-12)).all()
        pressed += int((one.floor_impulse[:, 2] > 0).sum())
    gaps = np.concatenate(off)
    assert pressed > 30_000
    assert np.quantile(gaps, 0.9) < 2e-9
    assert np.quantile(gaps, 0.99) < 2e-8
    assert (gaps > 1e-7).mean() < 1e-3


@pytest.mark.parametrize(("count", "ready"), [(1, False), (1, True), (LANES - 1, False), (300, False), (300, True)])
def test_same_bits_as_python(count: int, ready: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    """Few balls in Python, and in the compiled loop where that is machine code: a lane does not know its neighbours."""
    monkeypatch.setitem(arrays._ready, two_step_final_rows, ready)
    rng = np.random.default_rng(71)
    wall, floor, normal = carom.Surface(0.85, 0.2), carom.Surface(0.5, 0.2), (math.sqrt(0.84), 0.0, -0.4)
    v, w = balls(rng, 2000)
    v, w = (np.ascontiguousarray(x[v[:, 2] == 0]) for x in (v, w))
    assert len(v) > FEW_AT_FIRST > count
    many = into(v, w, wall, floor, normal)
    few = into(v[:count].copy(), w[:count].copy(), wall, floor, normal)
    for x, y in zip(many, few, strict=True):
        np.testing.assert_array_equal(x[:count], y)


def test_a_single_state_that_is_integrated_takes_the_loop(monkeypatch: pytest.MonkeyPatch) -> None:
    """Where that is machine code, from the first call, with the bits of Python; another state is left to Python."""
    wall, floor, normal = carom.Surface(0.85, 0.2), carom.Surface(0.5, 0.2), (math.sqrt(0.84), 0.0, -0.4)
    v, w = balls(np.random.default_rng(74), 40)
    v, w = v[v[:, 2] == 0], w[v[:, 2] == 0]
    found: list[list[Any]] = []
    compiled, taken = arrays._compiled, []
    monkeypatch.setattr(arrays, "_compiled", lambda loop: taken.append(loop) or compiled(loop))
    for ready in (False, True):
        monkeypatch.setitem(arrays._ready, first_rows, ready)
        answers = [carom.two_step(BALL, carom.State(x, y), wall, floor, normal) for x, y in zip(v, w, strict=True)]
        found.append([(one.floor_impulse, one.wall.impulse, one.rolling.velocity, one.why) for one in answers])
        assert taken == [first_rows] * (len(v) if ready else 0)  # (under a nose)
    for python, loop in zip(*found, strict=True):
        for x, y in zip(python, loop, strict=True):
            np.testing.assert_array_equal(x, y)
    carom.two_step(BALL, carom.rolling(BALL, (-1.0, 1.0)), wall, floor)  # (friction lifts it)
    assert len(taken) == len(v)


def test_same_bits_for_any_number_of_threads() -> None:
    v, w = balls(np.random.default_rng(72), 5000)
    v, w = (np.ascontiguousarray(x[v[:, 2] == 0]) for x in (v, w))
    scene = (carom.Surface(0.85, 0.14), carom.Surface(0.5, 0.2), (math.sqrt(0.84), 0.0, -0.4))
    threads = numba.get_num_threads()
    try:
        found = []
        for some in (1, threads):
            numba.set_num_threads(some)
            found.append(into(v, w, *scene))
    finally:
        numba.set_num_threads(threads)
    for x, y in zip(*found, strict=True):
        np.testing.assert_array_equal(x, y)


def test_a_ball_through_a_slip_that_dies() -> None:
    """Backspin that the wall's friction ends on the way: out of its lane, back into it, or not; as ball by ball."""
    rng = np.random.default_rng(73)
    v = np.stack([-np.ones(600), rng.uniform(-0.6, 0.6, 600), np.zeros(600)], axis=-1)
    w = np.stack([-v[:, 1], np.full(600, -0.4), rng.uniform(-1, 1, 600)], axis=-1)
    for mu in (0.05, 0.3, 1.0):
        wall, floor, normal = carom.Surface(0.9, mu), carom.Surface(0.0, 0.3), (math.sqrt(0.91), 0.0, -0.3)
        one = carom.two_step(BALL, carom.State(v, w), wall, floor, normal)
        v3, w3, why = into(v, w, wall, floor, normal)
        assert (why == 0).all()
        np.testing.assert_allclose(v3, one.rolling.velocity, atol=1e-7)
        np.testing.assert_allclose(w3, one.rolling.spin, atol=1e-7)


def test_a_ball_that_leaves_the_wall_is_plain_whatever_the_direction_of_the_wall() -> None:
    """Else it would be computed in full: the same result, later."""
    rng = np.random.default_rng(5)
    for _ in range(300):
        turn = rng.uniform(0, 2 * math.pi)
        n = (math.cos(turn), math.sin(turn), 0.0)
        along, v = (-n[1], n[0]), rng.uniform(-1, 1)
        velocity = (-n[0] + v * along[0], -n[1] + v * along[1], 0.0)
        rolls = (-velocity[1], velocity[0], 0.0)
        _v, _w, plain = two_step_plain(velocity, rolls, n, 1.0, 0.4, 0.9, 0.2, 0.0, 0.0, 0.2, 0.0, 9.81, False)
        assert plain
