"""Viscosity by Helfand's relation, against Enskog's theory."""

from __future__ import annotations

import math

import pytest

from carom import Ball, CaromError, Surface
from carom.gas import Gas, Species, container, viscosity


def test_viscosity_of_hard_spheres_is_enskogs():
    density, count = 0.2, 100
    side = (count / density) ** (1 / 3)
    gas = Gas([Species(Ball(0.5, 1.0), count)], (side,) * 3, contacts=Surface(1, 0, -1), seed=2)
    gas.advance(4000)
    found = viscosity(gas, 1500)
    filled, pushed = density * math.pi / 6, 2 * math.pi / 3 * density
    contact = (1 - filled / 2) / (1 - filled) ** 3
    dilute = 1.016 * 5 / 16 / math.sqrt(math.pi)
    enskog = dilute * (1 / contact + 0.8 * pushed + 0.7614 * pushed**2 * contact)
    assert found.error < 0.1 * found.value
    assert found.value == pytest.approx(enskog, abs=3 * found.error)


def test_what_has_no_viscosity_here():
    ball = [Species(Ball(0.5, 1.0), 20)]
    walled = Gas(ball, container("box", (6, 6, 6)), contacts=Surface(1, 0, -1))
    with pytest.raises(CaromError, match="a gas without walls, got walls left"):
        viscosity(walled)
    with pytest.raises(CaromError, match="windows: expected a whole number >= 200, got 5"):
        viscosity(Gas(ball, (6, 6, 6), contacts=Surface(1, 0, -1)), 5)
    with pytest.raises(CaromError, match="contacts that conserve energy"):
        viscosity(Gas(ball, (6, 6, 6), contacts=Surface(0.99, 0, -1)), 200)
