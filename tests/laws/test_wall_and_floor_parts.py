"""Parts of the simultaneous contact: the direction in which a wall starts to slip, and the order of the integrator."""

import math

import numpy as np
import pytest

from carom.core.contact import SLIDE, STICK
from carom.laws.wall_and_floor.integrators import _changes, _dormand_prince_step
from carom.laws.wall_and_floor.rates import FLOOR_SLIP, _start_at_wall, gap_growth, pressed_rates, touch_down_impulse


def couplings(rng, nz):
    """Of a random ball at a wall of a normal (sqrt(1 - nz^2), 0, nz): see wall_and_floor.frame."""
    c, i = math.sqrt(1 - nz * nz), 1 / rng.uniform(0.1, 1)
    return (c, nz, nz * nz + i, 1 + i, 1 + nz * i, nz + i, 1.0, rng.uniform(0, 1), rng.uniform(0, 1), 1.0)


def test_a_wall_that_starts_to_slip_does_so_along_its_friction() -> None:
    rng, found = np.random.default_rng(6), 0
    for _ in range(3000):
        q, turn = couplings(rng, -rng.uniform(0.05, 0.9)), rng.uniform(0, 2 * math.pi)
        df = (math.cos(turn), math.sin(turn))
        y = (0.0, 0.0, *df, 0.0)
        _rates, sticks = pressed_rates(y, q, STICK, FLOOR_SLIP, (1.0, 0.0), df, 1e-12)
        if sticks >= -1e-3:
            continue
        dw = _start_at_wall(q, df)
        (ut, uy, _fx, _fy, _energy), _spare = pressed_rates(y, q, SLIDE, FLOOR_SLIP, dw, df, 1e-12)
        size = math.hypot(ut, uy)
        found += 1
        assert math.hypot(*dw) == pytest.approx(1)
        assert ut * dw[1] - uy * dw[0] == pytest.approx(0, abs=1e-9 * size)  # the slip grows along its own direction
        assert ut * dw[0] + uy * dw[1] > 0
    assert found > 500


def test_the_integrator_of_two_slips_is_of_order_eight() -> None:
    rng, orders = np.random.default_rng(7), []
    for _ in range(20):
        q = couplings(rng, -rng.uniform(0.05, 0.5))
        start = (*rng.uniform(0.5, 1, 4), 0.0, 0.0)
        by = (0.3, 0.2, 1.0, 0.0, 0.0)

        def after(steps, y=start, q=q, by=by):
            h = 0.3 / steps
            for _ in range(steps):
                y, _error, _wrong = _dormand_prince_step(
                    y, _changes(y, h, q, by, False), h, 1.0, 0.0, q, by, 1.0, False
                )
            return np.array(y)

        exact = after(32)
        once, twice = (np.abs(after(n) - exact).max() for n in (1, 2))
        orders.append(math.log2(once / twice))
    assert np.median(orders) > 7.5


def test_a_gap_closes_where_bisection_alone_says_to_the_last_bit():
    rng, tried = np.random.default_rng(4), 0
    for _ in range(3000):
        un, vz, c, stored, e = (
            -rng.random(),
            rng.normal() * 10 ** rng.uniform(-6, 0),
            -rng.random(),
            rng.random(),
            rng.random(),
        )
        gap, compressing = rng.choice([0.0, 10 ** rng.uniform(-12, -1)]), bool(rng.random() < 0.5)
        p = rng.uniform(0.1, 1) * (-un if compressing else un + math.sqrt(un * un + 2 * stored))
        low = -vz / c if vz > 0 else 0.0
        if not (low < p and (vz > 0 or gap > 0) and gap + gap_growth(un, vz, c, stored, p, e, compressing) < 0):
            continue
        tried, high = tried + 1, p
        while (middle := (low + high) / 2) not in (low, high):
            if gap + gap_growth(un, vz, c, stored, middle, e, compressing) > 0:
                low = middle
            else:
                high = middle
        assert touch_down_impulse(un, vz, c, stored, p, e, compressing, gap) == high
    assert tried > 500
