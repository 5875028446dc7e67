"""Parameters are called not identifiable where the profile is flat, and not where only the curvature at a kink is weak."""

from __future__ import annotations

import numpy as np
import pytest

from carom.fitting.identifiability import NOT_IDENTIFIABLE, identify
from carom.fitting.parameters import Parameter

BEST = 0.4


class Profile:
    """A fit of two parameters whose second one has a deviance of a given form."""

    label = "a law"

    def __init__(self, name: str, curvature: float, rise, trade_offs: bool) -> None:
        self.names, self.trade_offs, self.form = ("restitution", name), trade_offs, rise
        self.parameters = tuple(Parameter(name, 0.0, 1.0, (0.5,), 0.5) for name in self.names)
        self.values, self.information = np.array([0.8, BEST]), np.diag([1e4, curvature])
        self.refits = 0

    def covariance(self, inside):
        return np.linalg.inv(self.information[np.ix_(inside, inside)])

    def rise(self, i, value):
        return float(self.form(abs(value - BEST))) if i == 1 else 1e4 * (value - 0.8) ** 2

    def refit_rises(self, i, values):
        self.refits += 1
        return np.array([self.rise(i, one) for one in values]), np.stack([0.8 + 0.1 * (values - BEST), values], axis=1)


def test_a_steep_kink_is_identified_although_its_curvature_is_nothing() -> None:
    subject = Profile("friction", 1e-6, lambda far: 80 * far, trade_offs=False)
    found = identify(subject)
    assert found.untold == found.degenerate == ()
    assert found.estimates["friction"].value == BEST
    assert found.estimates["friction"].stderr == pytest.approx(1 / 80, rel=0.3)  # where the deviance has risen by 1
    assert found.estimates["restitution"].stderr == pytest.approx(0.01, rel=1e-6)


def test_a_flat_profile_is_not_identified_and_costs_no_refit() -> None:
    subject = Profile("friction", 1e-6, lambda far: 0.5 * far, trade_offs=False)
    found = identify(subject)
    assert found.untold == ("friction",)
    assert found.estimates["friction"].note == NOT_IDENTIFIABLE
    assert subject.refits == 0


@pytest.mark.parametrize("flat", [False, True])
def test_a_level_bottom_with_steep_sides_is_identified(flat: bool) -> None:
    """Level for two error bars, a parameter was called not identifiable, however steep the profile was beyond."""

    def rise(far: float) -> float:
        return 0.0 if flat or far < 0.025 else (far / 0.01) ** 2

    found = identify(Profile("tangential_restitution", 1e4, rise, trade_offs=True))
    assert found.untold == (("restitution", "tangential_restitution") if flat else ())


def test_a_bound_of_zero_is_said_as_zero() -> None:
    """Friction was "2.077e-18 (at its lower bound, 2.07717e-18)"."""
    subject = Profile("friction", 1e4, lambda far: 1e4 * far**2, trade_offs=False)
    subject.values = np.array([0.8, 2.07717e-18])
    friction = identify(subject).estimates["friction"]
    assert (friction.value, friction.note) == (0.0, "at its lower bound, 0")
