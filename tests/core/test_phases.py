"""The phases of a ball on the floor: what each lasts and how the ball moves in it, at the limits of floor and gravity."""

from __future__ import annotations

import math

import pytest

from carom.core.motion.phases import FLIGHT, PIVOTING, ROLLING, SLIDING, accelerations

STATE = ((1.0, 0.2, 0.0), (3.0, 5.0, 2.0), 0.03, 0.4)
FORCE = (0.0, 0.0, -9.8)


@pytest.mark.parametrize("phase", [ROLLING, SLIDING, PIVOTING])
def test_nothing_brakes_a_ball_that_nothing_presses_on_the_floor(phase: int) -> None:
    assert accelerations(phase, *STATE, FORCE, 0.0, 0.2, 0.01, 0.01) == ((0, 0, 0), (0, 0, 0), math.inf)


def test_each_phase_brakes_what_it_must() -> None:
    fall, turn, lasts = accelerations(FLIGHT, *STATE, FORCE, 9.8, 0.2, 0.01, 0.01)
    assert (fall, turn, lasts) == (FORCE, (0, 0, 0), math.inf)
    slide, turn, lasts = accelerations(SLIDING, *STATE, FORCE, 9.8, 0.2, 0.01, 0.0)
    assert math.hypot(*slide) == pytest.approx(0.2 * 9.8)
    assert lasts == pytest.approx(math.hypot(1.0 - 0.03 * 5.0, 0.2 + 0.03 * 3.0) / (0.2 * 9.8 * 3.5))
    assert turn[2] == 0
    roll, turn, lasts = accelerations(
        ROLLING, (1.0, 0.0, 0.0), (0.0, 1 / 0.03, 0.0), 0.03, 0.4, FORCE, 9.8, 0.2, 0.01, 0.0
    )
    assert roll == pytest.approx((-0.098, 0, 0))
    assert lasts == pytest.approx(1 / 0.098)
    still, turn, lasts = accelerations(
        PIVOTING, (0.0, 0.0, 0.0), (0.0, 0.0, 2.0), 0.03, 0.4, FORCE, 9.8, 0.2, 0.01, 0.01
    )
    assert still == (0, 0, 0)
    assert turn == pytest.approx((0, 0, -0.01 * 9.8 / (0.4 * 0.03)))
    assert lasts == pytest.approx(2 * 0.4 * 0.03 / (0.01 * 9.8))
