"""Starts of filmed balls: many runs of one ball as one run of many, the nearest start, and starts projected out."""

from __future__ import annotations

from typing import ClassVar

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.optimize import lsq_linear

import carom
from carom.fitting.spin_chains import minimize
from carom.fitting.table_numbers import (
    Projection,
    SharedNumber,
    TableNumbers,
    affine_table,
    balls_by,
    balls_of,
    descend_shared,
    nearest_starts,
    states_by,
)
from carom.scene.shapes import Table

Array = NDArray[np.float64]
RADIUS = 0.03
PLACE_AND_VELOCITY = (("x", 0), ("x", 1), ("v", 0), ("v", 1))


def table_of(balls: int) -> TableNumbers:
    """A table with balls, as a function of the restitution and the floor's friction."""

    def scene(at: dict[str, float]) -> carom.Scene:
        wall = Table(length=2.8, width=1.4, center=(1.4, 0.7), restitution=at["restitution"], friction=0.2)
        each = [carom.SceneBall(radius=RADIUS, mass=1, position=(0.5 + k, 0.7)) for k in range(balls)]
        return carom.Scene(floor=carom.Floor(friction=at["floor"]), walls=[wall], balls=each, run=carom.Run(duration=3))

    return affine_table(
        scene, (SharedNumber("restitution", 0.8, 0.0, 1.0, 0.1), SharedNumber("floor", 0.2, 0.0, 1.0, 0.1))
    )


def test_runs_of_one_ball_are_those_of_balls_that_do_not_meet() -> None:
    """States and derivatives of two starts of one ball each, and of one start of both."""
    time = np.linspace(0, 1.2, 25)
    one, both = table_of(1), table_of(2)
    starts = np.array([[0.5, 0.4, -1.0, 1.2], [2.0, 1.0, 1.5, 0.5]])
    count = np.array([25, 25])
    own = balls_by(1, [[(0, name, j, 1.0)] for name, j in PLACE_AND_VELOCITY])
    each = states_by(one, balls_of(one.arrays, own, starts), own, np.tile(time, (2, 1)), count, shared=True)
    by = balls_by(2, [[(k, name, j, 1.0)] for k in range(2) for name, j in PLACE_AND_VELOCITY])
    found = states_by(both, balls_of(both.arrays, by, starts.reshape(1, -1)), by, time[None], count[:1], shared=True)
    for k in range(2):
        assert np.array_equal(found.states[0, :, k], each.states[k, :, 0])
        assert found.by_start[0, :, k, :, 4 * k : 4 * k + 4] == pytest.approx(each.by_start[k, :, 0], abs=1e-14)
        assert found.by_shared[0, :, k] == pytest.approx(each.by_shared[k, :, 0], abs=1e-14)
        assert not found.by_start[0, :, k, :, 4 * (1 - k) : 4 * (1 - k) + 4].any()
    # both balls meet a cushion
    assert np.abs(found.by_shared[0, -1, :, :, 0]).max(axis=-1).min() > 0.01


def test_a_table_at_other_numbers_and_one_that_deviates_are_the_same() -> None:
    table, by = table_of(1), balls_by(1, [[(0, name, j, 1.0)] for name, j in PLACE_AND_VELOCITY])
    values, time, count = np.array([0.7, 0.25]), np.linspace(0, 1, 9)[None], np.array([9])
    balls = balls_of(table.arrays, by, np.array([[0.5, 0.4, -1.0, 1.2]]))
    moved = states_by(table.at(values), balls, by, time, count)
    deviates = states_by(table, balls, by, time, count, deviations=values - table.values)
    assert np.array_equal(moved.states, deviates.states)
    assert np.abs(moved.states - states_by(table, balls, by, time, count).states).max() > 0.01
    # two runs, each with numbers of its own
    each = np.array([values - table.values, [0.05, -0.03]])
    both = states_by(table, balls.repeat(2, axis=0), by, time, count.repeat(2), shared=True, deviations=each)
    for n, one in enumerate(each):
        alone = states_by(table, balls, by, time, count, shared=True, deviations=one)
        assert both.states[n] == pytest.approx(alone.states[0], abs=1e-14)
        assert both.by_shared[n] == pytest.approx(alone.by_shared[0], abs=1e-13)
    assert np.abs(both.states[0] - both.states[1]).max() > 0.01
    # numbers stay within their bounds
    assert table.at_deviations(np.array([0.5, 0.1])) == pytest.approx([1.0, 0.3])


def test_the_nearest_start_of_a_linear_problem_is_that_of_least_squares() -> None:
    """With a prior, and with a number that is held."""
    rng = np.random.default_rng(2)
    slope, seen = rng.normal(size=(3, 12, 4)), rng.normal(size=(3, 12))
    center, rows = rng.normal(size=(3, 4)), np.tile(0.5 * np.eye(4), (3, 1, 1))
    scale, begin = rng.uniform(0.1, 10, (3, 4)), rng.normal(size=(3, 4))
    scale[1, 2] = 0.0

    def residual(which: np.ndarray, at: np.ndarray, derivatives: bool) -> tuple[np.ndarray, np.ndarray | None]:
        gap = np.einsum("nmk,nk->nm", slope[which], at) - seen[which]
        return gap, slope[which] if derivatives else None

    found, minimum = nearest_starts(
        residual, begin, scale, center, rows, steps=30, tolerance=1e-12, dof=np.full(3, 12.0), joint=False
    )
    for n in range(3):
        free = scale[n] > 0
        matrix = np.concatenate([slope[n], rows[n]])
        right = np.concatenate([seen[n], rows[n] @ center[n]]) - matrix[:, ~free] @ begin[n, ~free]
        best = np.linalg.lstsq(matrix[:, free], right, rcond=None)[0]
        assert found[n, free] == pytest.approx(best, abs=1e-5)
        assert np.array_equal(found[n, ~free], begin[n, ~free])
        assert minimum.value[n] == pytest.approx(np.square(matrix[:, free] @ best - right).sum(), rel=1e-8)


def test_a_held_number_disturbs_no_descent() -> None:
    """An information of 0 beside large ones is lost in their rounding: a step of all numbers would be wrong by up to its size."""
    rng, n = np.random.default_rng(4), 400
    size = np.array([1e3, 1e3, 1e4, 1e4, 0.0, 0.0, 1e1])
    slope, seen = rng.normal(size=(n, 40, 7)) * size, rng.normal(size=(n, 40))
    free, begin = size > 0, rng.normal(size=(n, 7)) / np.where(size > 0, size, 1.0)

    def residual(which: np.ndarray, at: np.ndarray, derivatives: bool) -> tuple[np.ndarray, np.ndarray | None]:
        gap = np.einsum("nmk,nk->nm", slope[which], at) - seen[which]
        return gap, slope[which] if derivatives else None

    scale, none = np.tile(1.0 * free, (n, 1)), np.zeros((n, 7))
    _found, minimum = nearest_starts(
        residual, begin, scale, none, np.zeros((n, 7, 7)), steps=4, tolerance=1e-9, dof=np.full(n, 40.0), joint=False
    )
    best = [np.linalg.lstsq(x[:, free], y, rcond=None)[1][0] for x, y in zip(slope, seen, strict=True)]
    assert minimum.value == pytest.approx(np.array(best), rel=1e-6)


def test_starts_are_projected_out() -> None:
    rng = np.random.default_rng(3)
    size = np.array([1.0, 1e-4, 1e3, 1.0])
    by_start, by_shared = rng.normal(size=(2, 20, 4)) * size, rng.normal(size=(2, 20, 3))
    # a number that is held: nothing but its own prior depends on it
    by_start[:, :, 3], by_start[:, 19], by_shared[:, 19] = 0.0, [0.0, 0.0, 0.0, 1.0], 0.0
    left = Projection.of(by_start)
    rest, follows = left.rest(by_shared), left.follows(by_shared)
    assert by_shared + by_start @ follows == pytest.approx(rest, abs=1e-12)
    assert np.swapaxes(left.basis, 1, 2) @ rest == pytest.approx(np.zeros((2, 4, 3)), abs=1e-12)
    assert not follows[:, 3].any()
    for n in range(2):
        expected = -np.linalg.lstsq(by_start[n] / size, by_shared[n], rcond=None)[0] / size[:, None]
        assert follows[n] == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize("joint", [True, False])
def test_a_start_whose_derivatives_are_too_large_to_square_stays_where_it_is(joint: bool) -> None:
    sizes = np.array([1.0, 1e200])

    def residual(which: np.ndarray, at: np.ndarray, derivatives: bool) -> tuple[np.ndarray, np.ndarray | None]:
        slope = np.array([[1.0, 0.0], [0.5, 0.0], [2.0, 0.0]]) * sizes[which][:, None, None]
        return (at[:, :1] - 1.0) * np.array([1.0, 0.5, 2.0]), slope if derivatives else None

    zeros, ones = np.zeros((2, 2)), np.ones((2, 2))
    found, _ends = nearest_starts(
        residual, zeros, ones, zeros, np.zeros((2, 1, 2)), steps=10, tolerance=1e-9, dof=np.ones(2), joint=joint
    )
    np.testing.assert_allclose(found, [[1.0, 0.0], [0.0, 0.0]], atol=1e-6)


@pytest.mark.parametrize("related", [False, True])
def test_a_descent_within_bounds_ends_where_bounded_least_squares_do(related: bool) -> None:
    rng = np.random.default_rng(7)
    for _ in range(100):
        k = int(rng.integers(2, 9))
        a = rng.normal(size=(k + 5, k)) * 10 ** rng.uniform(-1, 1, k) + (
            3 * rng.normal(size=(k + 5, 1)) if related else 0
        )
        b = a @ rng.normal(0, 2, k) + 0.1 * rng.normal(size=k + 5)
        low, high = -rng.uniform(0.2, 2, k), rng.uniform(0.2, 2, k)

        def evaluate(_which: object, at: Array, _derivatives: bool, a: Array = a, b: Array = b) -> tuple[Array, ...]:
            off = a @ at[0] - b
            return np.array([off @ off]), -(a.T @ off)[None], (a.T @ a)[None]

        start = np.clip(rng.normal(size=(1, k)), low, high)
        found = minimize(evaluate, start, low, high, steps=60, tolerance=1e-9)
        assert found.value[0] == pytest.approx(2 * lsq_linear(a, b, (low, high), tol=1e-14).cost, rel=1e-6)


def test_no_step_of_a_descent_is_longer_than_it_may_be() -> None:
    def evaluate(_which: object, at: Array, _derivatives: bool) -> tuple[Array, Array, Array]:
        return np.square(at).sum(axis=1), -at, np.eye(2)[None]

    ends = np.full(2, 10.0)
    found = minimize(evaluate, np.array([[9.0, 9.0]]), -ends, ends, steps=6, tolerance=1e-9, most=0.5)
    assert found.p[0] == pytest.approx([6.5, 6.5], abs=1e-9)


def test_shared_numbers_descend_with_the_starts_that_follow() -> None:
    """Lines a t + b_i through points with offsets of their own: the common slope is that of all, without the offsets."""
    rng = np.random.default_rng(0)
    t, offset = np.linspace(0, 1, 7), np.array([3.0, -1.0, 2.0])
    y = 1.7 * t + offset[:, None] + 0.1 * rng.normal(size=(3, 7))

    class Lines:
        taken_at: ClassVar[list[float]] = []

        def tried(self, values: Array) -> tuple[float, Array]:
            if values[0] > 5:
                return np.inf, np.empty(0)
            rest = y - values[0] * t
            rest = rest - rest.mean(axis=1, keepdims=True)
            return float(np.square(rest).sum()), rest

        def taken(self, values: Array, tried: Array) -> tuple[float, Array, Array]:
            self.taken_at.append(values[0])
            d = np.tile(t.mean() - t, 3)
            return float(np.square(tried).sum()), -np.array([d @ tried.ravel()]), np.array([[d @ d]])

    lines, ends = Lines(), np.array([-10.0, 10.0])
    slope = descend_shared(lines, np.array([-9.0]), ends[:1], ends[1:], steps=20, tolerance=1e-12)
    design = np.column_stack([np.tile(t, 3), np.repeat(np.eye(3), 7, axis=0)])
    assert slope[0] == pytest.approx(np.linalg.lstsq(design, y.ravel())[0][0], abs=1e-7)
    assert lines.taken_at[0] == -9.0
