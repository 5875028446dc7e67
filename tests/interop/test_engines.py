"""Restitutions of springs with dampers against integrated contacts; and what engines gave for what they were asked."""

from __future__ import annotations

import math

import numpy as np
import pytest
from engines_asked import got
from scipy.integrate import solve_ivp

from carom.errors import CaromError
from carom.interop import engines


def speed_after(force, speed: float) -> float:
    """Integrate a contact of a ball of mass 1 until its force would pull, or it has left."""
    leaves = lambda _t, y: min(force(y[0], y[1]), 1.0) if y[1] < 0 else 1.0  # noqa: E731
    leaves.terminal = True
    done = solve_ivp(
        lambda _t, y: (y[1], -force(y[0], y[1])),
        (0, 1e3),
        (1e-9, speed),
        events=leaves,
        rtol=1e-9,
        atol=1e-12,
        max_step=0.05,
    )
    return -float(done.y[1, -1])


@pytest.mark.parametrize("e", [0.05, 0.1353, 0.4, 0.8, 0.99])
def test_the_spring_and_damper_of_solref_give_the_restitution(e: float) -> None:
    stiffness, damping = -engines.solref(e, math.pi)  # (a frequency of 1)
    assert stiffness == pytest.approx(1)
    assert speed_after(lambda x, v: stiffness * x + damping * v, 1.0) == pytest.approx(e, rel=2e-6)
    assert engines.restitution_of_solref([2 / damping, damping / 2]) == pytest.approx(e)  # time constant, damping ratio


@pytest.mark.parametrize(("d", "power"), [(0.1, 1.5), (0.7, 1.0), (4.0, 1.5)])
def test_hunt_and_crossleys_restitution_depends_on_dissipation_and_speed_alone(d: float, power: float) -> None:
    for stiffness, speed in ((1.0, 1.0), (5.0, 0.4)):
        e = speed_after(lambda x, v, k=stiffness: k * max(x, 0.0) ** power * (1 + d * v), speed) / speed
        assert engines.hunt_crossley_restitution(d, speed) == pytest.approx(e, rel=1e-4)


def test_conversions_go_back_in_any_shape() -> None:
    e = np.array([[1e-9, 1e-3, 0.2], [0.5, 0.999999, 1.0]])
    assert engines.restitution_of_solref(engines.solref(e, 0.01)) == pytest.approx(e, rel=1e-12)
    d = engines.hunt_crossley_dissipation(e[1:], [[2.0], [1e-3]])
    assert d.shape == (2, 3)
    assert engines.hunt_crossley_restitution(d, [[2.0], [1e-3]]) == pytest.approx(np.tile(e[1], (2, 1)), rel=1e-12)
    # of a small u: 1 - 2 u / 3 + 4 u^2 / 9
    assert 1 - engines.hunt_crossley_restitution(1e-6, 1.0) == pytest.approx(2e-6 / 3 - 4e-12 / 9, rel=1e-9)
    for wrong in (lambda: engines.solref([0.5, 0.0], 0.01), lambda: engines.hunt_crossley_dissipation(0.5, 0.0)):
        with pytest.raises(CaromError):
            wrong()


def test_what_an_engine_gave_is_measured_at_the_floor() -> None:
    """A ball with steps of its own: 0.25 m above the floor at 3 m/s, thrown up again at 2 m/s with 0.5 m/s less along the floor."""
    t = np.arange(12) / 100
    down, up = 0.2 + 0.25 - 3 * t - 9.81 / 2 * t**2, 0.2 + 2 * t - 9.81 / 2 * t**2
    z, vz = np.append(down[:8], up[1:8]), np.append(-3 - 9.81 * t[:8], 2 - 9.81 * t[1:8])
    e, friction = got(z, np.repeat([20.0, 19.5], [8, 7]), vz, 0.01)
    assert e == pytest.approx(2 / math.sqrt(9 + 2 * 9.81 * 0.25))
    assert friction == pytest.approx(0.5 / (vz[8] - vz[7] + 0.0981))
