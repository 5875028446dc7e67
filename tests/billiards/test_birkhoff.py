"""Rotation numbers by weighted Birkhoff averages against closed forms; regular and chaotic orbits against Lyapunov exponents."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.special import ellipkinc, ellipkm1

import carom
from carom import billiards


def test_rotation_number_of_an_ellipse_is_that_of_elliptic_integrals():
    # Chang & Friedberg, J. Math. Phys. 29, 1537 (1988): orbits that touch the confocal ellipse a^2 - l, b^2 - l
    a, b, caustic = 1.3, 1.0, 0.4
    m = (a * a - b * b) / (a * a - caustic)
    expected = ellipkinc(math.asin(math.sqrt(caustic) / b), m) / (2 * ellipkm1(1 - m))
    x, y = math.sqrt(a * a - caustic), 0.0  # a point of the caustic, and the tangent there
    found = billiards.orbit(billiards.ellipse(a, b), ((x, y), (0.0, 1.0), 0.0), 10_000, law="mirror")
    rotation = billiards.rotation_number(found)
    assert rotation.number == pytest.approx(expected, abs=1e-10)
    assert rotation.digits > 9


@pytest.mark.parametrize("angle", [0.3, 1.0, 2.0])
def test_rotation_number_of_a_circle(angle):
    start = ((1.0, 0.0), (-math.sin(angle), math.cos(angle)), 0.0)
    found = billiards.orbit(billiards.circle(), start, 500, law="mirror")
    assert billiards.rotation_number(found).number == pytest.approx(angle / math.pi, abs=1e-13)


def test_regular_orbits_are_those_without_an_exponent():
    table = billiards.under(billiards.wedge(100), (-1.0, 0.0))
    angle = np.linspace(0, math.tau, 60, endpoint=False) + 0.1
    begin = (np.tile([0.3, 0.0], (60, 1)), math.sqrt(1.4) * np.stack([np.cos(angle), np.sin(angle)], axis=1), 0.0)
    regular = billiards.is_regular(billiards.orbit(table, begin, 3000))
    exponents = billiards.lyapunov(table, begin, 3000).per_bounce[:, 0]
    assert (regular == (exponents < 0.01)).mean() >= 0.98
    assert 5 < regular.sum() < 30


def test_what_has_no_rotation_number_is_refused():
    wedge = billiards.under(billiards.wedge(60), (-1.0, 0.0))
    with pytest.raises(carom.CaromError, match="rotation_number: table: expected a boundary of finite length"):
        billiards.rotation_number(billiards.orbit(wedge, ((0.3, 0.0), (0.5, 0.1), 0.0), 60))
    short = billiards.orbit(billiards.circle(), ((0.2, 0.1), (0.8, 0.3), 0.5), 20)
    with pytest.raises(carom.CaromError, match="found: expected orbits of at least 50 bounces, got 20"):
        billiards.is_regular(short)


def test_exponents_of_regular_orbits_are_zero_within_their_error():
    starts = billiards.starts(billiards.circle(), 40, seed=2)
    found = billiards.lyapunov(billiards.circle(), starts, 2000)
    assert (found.per_bounce[:, 0] > 1e-4).all()  # a finite run is biased
    assert (np.abs(found.per_bounce) < 2 * found.error + 1e-12).mean() > 0.95


def test_few_bounces_do_not_decide():
    """In an ellipse all orbits are regular, in a stadium none; 200 bounces had told so of one in three and of all but some."""
    for table, regular in ((billiards.ellipse(1.5, 1.0), True), (billiards.stadium(), False)):
        found = billiards.orbit(table, billiards.starts(table, 40, seed=1), 200, law="mirror")
        assert (billiards.is_regular(found) == regular).all()
    # an orbit that turns slowly around an island: 94 % of its points are on a ring after 200 bounces, its exponents are 0.002
    table = billiards.table("curve", r="1 + 0.1*cos(3*theta)")
    start = billiards.starts(table, 200, seed=0)
    slow = billiards.orbit(table, (start.position[167], start.velocity[167], start.spin[167]), 200)
    assert billiards.digits_of_averages(slow) < 2
    assert billiards.is_regular(slow)
