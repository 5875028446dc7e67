"""Hertz contacts that overlap in time: the independent integration that clusters are checked by, against known answers."""

from __future__ import annotations

import numpy as np
import pytest
from reference.hertz_contacts import contact_time, damping_of, integrate, known, known_case, restitution_of

CASES = known()["cases"]


@pytest.mark.parametrize("name", CASES)
def test_the_integration_has_the_answers_of_the_reference(name: str) -> None:
    one = CASES[name]
    case = known_case(one)
    _x, v, _w = integrate(case, one["contacts_until"] + 3e-5)
    assert np.abs(v - one["out_velocity"]).max() < 2e-5 * np.abs(case.velocity).max()
    assert (case.mass * (v - case.velocity)).sum(axis=0) == pytest.approx(np.zeros(3), abs=1e-13)


def test_the_integration_ends_when_the_reference_does() -> None:
    one = CASES["two balls head-on, 1 m/s, e .95"]
    assert contact_time(known_case(one)._replace(restitution=1.0), 1.0) == pytest.approx(3.9e-4, rel=0.01)
    # (damping makes it last longer, by less than 2 percent at e = 0.95)
    assert one["contacts_until"] == pytest.approx(contact_time(known_case(one), 1.0), rel=0.02)


def test_a_restitution_has_one_damping() -> None:
    assert [round(damping_of(e), 5) for e in (1.0, 0.95, 0.5)] == [0.0, 0.03689, 0.57081]
    assert [restitution_of(damping_of(e)) for e in (0.9, 0.3, 0.02)] == pytest.approx([0.9, 0.3, 0.02], abs=1e-12)
