"""Cosines and sines of angles in degrees."""

from __future__ import annotations

import math
from fractions import Fraction

import numpy as np
import pytest

from carom.core.geometry.circles import direction, directions

PI = Fraction(314159265358979323846264338327950288419716939937510582097494459, 10**62)


def exact(degrees: float) -> tuple[Fraction, Fraction]:
    """Cosine and sine to 40 digits, by their series."""
    x = Fraction(math.fmod(degrees, 360.0)) * PI / 180
    x = Fraction(round(x * 10**50), 10**50)
    term, sums = Fraction(1), [Fraction(0), Fraction(0)]
    for n in range(80):
        sums[n % 2] += term * (-1) ** (n // 2)
        term = Fraction(round(term * x / (n + 1) * 10**50), 10**50)
    return sums[0], sums[1]


@pytest.mark.parametrize(
    "degrees", [*np.random.default_rng(5).uniform(-720, 720, 60).tolist(), 1e-9, 44.9999, 45.0, 1e6 + 0.3]
)
def test_an_angle_is_right_to_the_last_digit(degrees: float) -> None:
    for found, expected in zip(direction(degrees), exact(degrees), strict=True):
        assert abs(Fraction(found) - expected) <= Fraction(math.ulp(found)) * Fraction(8, 10)


def test_right_angles_are_exact() -> None:
    for turns in (-4, 0, 4, 400):
        assert [direction(90.0 * (k + turns)) for k in range(4)] == [(1, 0), (0, 1), (-1, 0), (0, -1)]
    assert all(math.copysign(1, x) == 1 for k in range(4) for x in direction(90.0 * k) if x == 0)


def test_an_angle_beyond_all_measure_is_some_direction() -> None:
    for degrees in (1e22, -1e100, 1e16 + 2):
        c, s = direction(degrees)
        assert c * c + s * s == pytest.approx(1, abs=1e-15)


def test_angles_of_an_array_have_the_same_bits() -> None:
    random = np.random.default_rng(1)
    angles = np.concatenate([random.uniform(-720, 720, 20_000), np.arange(-720.0, 721.0, 15.0), [1e300, -0.0, 5e-324]])
    assert directions(angles).tobytes() == np.array([direction(float(one)) for one in angles]).tobytes()
