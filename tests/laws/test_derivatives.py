"""Derivatives of laws that integrate or search: dual numbers through them, against differences of several steps."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest
from reference.exploring import tried

from carom.laws.stronge import stronge_slip_ratio
from carom.laws.two_step import first_impact
from carom.laws.wall_and_floor.solver import pressed_down
from carom.simulation.contact_kinds import compiled_joint_impact
from carom.simulation.sensitivity.follow import lifted
from carom.simulation.sensitivity.passages import Dual, derivative

RADIUS, KAPPA, COLUMNS = 0.03, 0.4, 3
# f'(0) = sum of c_k (f(k h) - f(-k h)) / h, of order 8
CENTRAL = ((1, 4 / 5), (2, -1 / 5), (3, 4 / 105), (4, -1 / 280))


# Largest error of a pressed impact, of the speeds (docs/design.md): what differences over a step h are blurred by.
NOISE = 6.6e-9


def differences(function: Any, z: Any, d: Any, scale: float, noise: float) -> tuple[Any, float]:
    """Return the derivative along d from the step with the least doubt, and that doubt (over the largest)."""
    steps = [reach * scale for reach in (1e-2, 2e-3, 5e-4, 1e-4, 2e-5, 5e-6)]
    found = [sum(c / h * (function(z + k * h * d) - function(z - k * h * d)) for k, c in CENTRAL) for h in steps]
    doubts = [
        float(np.abs(one - two).max()) + noise / h
        for h, (one, two) in zip(steps, itertools.pairwise(found), strict=False)
    ]
    best = int(np.argmin(doubts))
    return found[best], doubts[best] / float(np.abs(found[best]).max())


def pressed(z: Any) -> Any:
    # (compiled, which has the bits of Python's: differences ask for hundreds of impacts)
    v, w, n = (tuple(z[k : k + 3].tolist()) for k in (0, 3, 6))
    e, mu, floor_e, floor_mu = z[9:13].tolist()
    v1, w1, j, jf, *_rest = compiled_joint_impact()(v, w, n, RADIUS, KAPPA, e, mu, 0.0, floor_e, floor_mu, 0.0, True)
    return np.concatenate([v1, np.multiply(w1, RADIUS), j, jf])


def case(seed: int) -> tuple[Any, Any] | None:
    """Return a pressed ball before a wall (numbers of ``pressed``), and directions (13, COLUMNS); None if it is not pressed."""
    rng = np.random.default_rng(seed)
    tilt, turn = rng.choice([0.0, rng.uniform(0, 0.5)]), rng.uniform(0, 2 * math.pi)
    size = math.hypot(1, tilt)
    n = np.array([math.cos(turn) / size, math.sin(turn) / size, -tilt / size])
    along = np.array([-math.sin(turn), math.cos(turn), 0.0])
    v = -np.array([math.cos(turn), math.sin(turn), 0.0]) + rng.uniform(-2, 2) * along
    w = rng.normal(size=3) * rng.choice([0.3, 1, 3]) / RADIUS
    d = np.zeros((13, COLUMNS))
    d[:2], d[3:6] = rng.normal(size=(2, COLUMNS)), rng.normal(size=(3, COLUMNS)) / RADIUS
    d[9:13] = 0.1 * rng.normal(size=(4, COLUMNS))
    if rng.random() < 0.3:  # it rolls, and goes on rolling (else its slip has no derivative)
        w[:2], d[3], d[4] = (-v[1] / RADIUS, v[0] / RADIUS), -d[1] / RADIUS, d[0] / RADIUS
    z = np.array([*v, *w, *n, rng.uniform(0.3, 1), rng.uniform(0, 0.6), rng.uniform(0, 0.8), rng.uniform(0, 0.6)])
    if not pressed_down(tuple(v), tuple(w), tuple(n), RADIUS, z[10], 0.0):
        return None
    return z, d


def test_wall_and_floor_at_once() -> None:
    impact, errors = lifted(first_impact), []
    for seed in range(tried(40, 150)):
        found = case(seed)
        if found is None:
            continue
        z, d = found
        dual = [Dual(x, g) for x, g in zip(z.tolist(), d, strict=True)]
        v, w, n = tuple(dual[:3]), tuple(dual[3:6]), tuple(z[6:9].tolist())
        v1, w1, j, jf, *_rest = impact(
            v, w, n, RADIUS, KAPPA, dual[9], dual[10], 0.0, dual[11], dual[12], 0.0, 0.0, True
        )
        told = np.array([derivative(x, COLUMNS) for x in (*v1, *(RADIUS * x for x in w1), *j, *jf)])
        for k in range(COLUMNS):
            sizes = np.abs(d[:, k]) * np.array([1.0] * 3 + [RADIUS] * 3 + [1.0] * 7)
            expected, doubt = differences(pressed, z, d[:, k], 1 / sizes.max(), NOISE)
            error = float(np.abs(told[:, k] - expected).max() / np.abs(expected).max())
            assert error <= 3 * doubt, (seed, k, error, doubt)
            errors.append(error)
    assert len(errors) > tried(50, 200)
    assert np.median(errors) < 1e-9


def nose(seed: int) -> tuple[Any, Any]:
    """Return a ball that rolls without sidespin to the nose of a cushion, and changes with which it goes on rolling (13, 2)."""
    rng = np.random.default_rng([2, seed])
    v = np.array([-1.0, rng.uniform(-0.6, 0.6), 0.0])
    w = np.array([-v[1], v[0], 0.0]) / RADIUS
    d = np.zeros((13, 2))
    d[0, 0] = d[1, 1] = 1.0
    d[3], d[4] = -d[1] / RADIUS, d[0] / RADIUS
    lean = rng.uniform(0.2, 0.4)
    n = [math.sqrt(1 - lean * lean), 0.0, -lean]
    z = np.array([*v, *w, *n, rng.uniform(0.6, 1), rng.uniform(0.14, 0.25), 0.5, rng.uniform(0.05, 0.6)])
    return z, d


def told_and_expected(z: Any, d: Any) -> Iterator[tuple[Any, Any, float]]:
    """Yield for each direction the derivatives of an impact, those of differences, and the doubt of these."""
    p = d.shape[1]
    dual = [Dual(x, g) for x, g in zip(z.tolist(), d, strict=True)]
    v, w, n = tuple(dual[:3]), tuple(dual[3:6]), tuple(dual[6:9])
    with np.errstate(invalid="ignore"):
        v1, w1, j, jf, *_rest = lifted(first_impact)(
            v, w, n, RADIUS, KAPPA, dual[9], dual[10], 0.0, dual[11], dual[12], 0.0, 0.0, True
        )
    told = np.array([derivative(x, p) for x in (*v1, *(RADIUS * x for x in w1), *j, *jf)])
    for k in range(p):
        yield told[:, k], *differences(pressed, z, d[:, k], 1.0, NOISE)


def worst_error(z: Any, d: Any) -> float:
    """Return the largest error of an impact's derivatives, over the largest, beyond three times the doubt of the differences."""
    cases = list(told_and_expected(z, d))
    assert all(doubt < 1e-3 for _told, _expected, doubt in cases)
    return max(float(np.abs(told - one).max() / np.abs(one).max()) - 3 * doubt for told, one, doubt in cases)


# (values follow such a slip exactly in steps of any length; its derivatives across it were magnified at each, by up to 1e56)
@pytest.mark.parametrize("seed", [0, 5, 17, 24])
def test_a_slip_that_ends_straight(seed: int) -> None:
    assert worst_error(*nose(seed)) < 1e-9


# Numbers: v, a w, n_z, e, mu, floor's mu; the wall's normal is along x.
ENDS = {
    "the approach ends with the slip": ((-1.0, 0.22), (-0.22, -1.0, 0.0), -0.434, 0.62, 0.45, 0.16),
    "a slip that turns to its end": ((-1.0, 0.3), (0.5, -0.6, 0.9), -0.239, 0.92, 0.43, 0.37),
}


@pytest.mark.parametrize("name", list(ENDS))
def test_other_ends_of_a_slip(name: str) -> None:
    v, w, lean, e, mu, cloth = ENDS[name]
    z = np.array([*v, 0.0, *np.divide(w, RADIUS), math.sqrt(1 - lean * lean), 0.0, lean, e, mu, 0.5, cloth])
    d = np.zeros((13, 3))
    d[0, 0] = d[1, 1] = 1.0
    d[3], d[4] = -d[1] / RADIUS, d[0] / RADIUS
    d[10, 2] = 0.1
    assert worst_error(z, d) < 1e-8


def test_a_contact_that_does_not_slip_and_would_has_no_derivative() -> None:
    z, d = nose(0)
    d[3:6] = 0.0  # (with another velocity and the same spin the ball slides)
    assert all(np.isnan(told).any() for told, _expected, _doubt in told_and_expected(z, d))


@pytest.mark.parametrize(
    ("u", "e", "k"), [(0.3, 1.0, 0.8), (1.1, 0.7, 1.2), (2.5, 0.9, 0.6), (4.0, 0.5, 3.0), (1.7, 0.8, 30.0)]
)
def test_two_springs(u: float, e: float, k: float) -> None:
    z = np.array([u, KAPPA, e, k])
    for column, direction in enumerate(np.eye(4)):
        dual = [Dual(x, np.array([g])) for x, g in zip(z.tolist(), direction, strict=True)]
        told = derivative(lifted(stronge_slip_ratio)(*dual), 1)[0]
        expected, doubt = differences(
            lambda x: np.array([stronge_slip_ratio(*x.tolist())]), z, direction, abs(z[column]), 1e-15
        )
        assert told == pytest.approx(expected[0], rel=1e-7 + 30 * doubt, abs=1e-9), column
