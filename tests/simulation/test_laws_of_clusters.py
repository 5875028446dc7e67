"""The laws of a cluster that stand side by side on the page "Which law of a rack?", against known values."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from examples.clusters import LAWS, at_once, combination, hertz, impulse_space, one_pair_at_a_time, rack, row, vee

# Integrations of contacts with the same loss (bistiff), places that move: tests/reference/hertz_contacts.json has the viscous ones.
CRADLE_3 = [-0.07095, 0.0764003, 0.9945497]
BISTIFF_CRADLE_5 = [-0.039606, -0.002413, 0.010422, 0.124783, 0.906814]
BISTIFF_COMBINATION = [[-0.016035, 0], [0.314973, -0.406368], [0.701062, 0.406348]]
# J. Belk, Mathematics Stack Exchange: speeds of white, 1, 2, 4, 5, 7, 8, 11, 12, 13, where white has 10
BELK = [1.79, 1.20, 1.57, 1.42, 0.12, 1.31, 0.25, 5.60, 2.57, 2.63]


@pytest.mark.parametrize("law", LAWS)
def test_every_law_conserves_momentum_and_elastic_energy(law: str) -> None:
    for case in (row(3), vee(), combination()):
        found = LAWS[law](*case, 1.0)
        assert (found - case[1]).sum(axis=0) == pytest.approx(0, abs=1e-12)
        assert (found**2).sum() == pytest.approx((case[1] ** 2).sum(), abs=1e-6)


def test_two_balls_have_the_restitution_of_a_pair_by_every_law() -> None:
    for law in LAWS.values():
        assert law(*row(2), 0.8)[:, 0] == pytest.approx([0.1, 0.9], abs=2e-4)


def test_cradles_are_what_each_law_is_known_for() -> None:
    assert at_once(*row(3), 1.0)[:, 0] == pytest.approx([-1 / 3, 2 / 3, 2 / 3], abs=1e-12)
    assert at_once(*row(5), 1.0)[:, 0] == pytest.approx([-0.6, 0.4, 0.4, 0.4, 0.4], abs=1e-12)
    assert one_pair_at_a_time(*row(5), 1.0)[:, 0] == pytest.approx([0, 0, 0, 0, 1], abs=1e-12)
    assert impulse_space(*row(3), 1.0)[:, 0] == pytest.approx(CRADLE_3, abs=2e-5)
    assert hertz(*row(3), 1.0)[:, 0] == pytest.approx(CRADLE_3, abs=1e-4)
    assert impulse_space(*row(5), 0.95)[:, 0] == pytest.approx(BISTIFF_CRADLE_5, abs=1e-4)


def test_a_combination_in_impulse_space() -> None:
    # (the integration lets the line of centres turn meanwhile, by some thousandths)
    assert impulse_space(*combination(), 0.95)[:, :2] == pytest.approx(np.array(BISTIFF_COMBINATION), abs=2e-3)


def test_belks_rack() -> None:
    def speeds(after: Any) -> Any:
        return np.linalg.norm(after, axis=1)[[0, 1, 2, 4, 5, 7, 8, 11, 12, 13]]

    assert speeds(impulse_space(*rack(10.0), 1.0, 2e-3)) == pytest.approx(BELK, abs=0.006)
    assert speeds(hertz(*rack(10.0), 1.0, young=7.6e14)) == pytest.approx(BELK, abs=0.012)
    assert speeds(hertz(*rack(10.0), 1.0)) == pytest.approx(BELK, abs=0.07)  # (softer balls: the normals turn)


def test_a_striker_comes_back_from_two_that_touch_and_goes_on_where_a_gap_parts_them() -> None:
    touching, apart = (hertz(*row(3, gap=gap), 0.95)[0, 0] for gap in (0.0, 1e-4))
    assert touching < -0.05
    assert 0.02 < apart < 0.025
    assert one_pair_at_a_time(*row(3), 0.95)[0, 0] > 0.02
