"""Transport coefficients by Helfand's relations and by shear, against Enskog's theory."""

from __future__ import annotations

import pytest

from carom import Ball, CaromError, Surface
from carom.gas import Gas, Species, container, enskog, sheared_viscosity, transport_coefficients, viscosity


def test_coefficients_of_hard_spheres_are_enskogs():
    density, count = 0.2, 100
    side = (count / density) ** (1 / 3)
    gas = Gas([Species(Ball(0.5, 1.0), count)], (side,) * 3, contacts=Surface(1, 0, -1), seed=2)
    gas.advance(4000)
    found, theory = transport_coefficients(gas, 1500), enskog(density)
    for name, share in (("viscosity", 0.1), ("bulk_viscosity", 0.15), ("conductivity", 0.15)):
        one, expected = getattr(found, name), getattr(theory, name)
        assert one.error < share * one.value, name
        assert one.value == pytest.approx(expected, abs=3 * one.error), name


def test_a_sheared_gas_has_the_viscosity_of_one_in_equilibrium():
    """Little sheared, and while it has heated up little: viscosity goes with the root of the temperature."""
    density, count = 0.2, 800
    side = (count / density) ** (1 / 3)
    gas = Gas([Species(Ball(0.5, 1.0), count)], (side,) * 3, contacts=Surface(1, 0, -1), shear_rate=0.1, seed=3)
    gas.advance(20 * count)
    begin = gas.mark()
    found = sheared_viscosity(gas, 100_000)
    warm = gas.measured_since(begin).temperature_translational
    assert found.value == pytest.approx(enskog(density, temperature=warm).viscosity, abs=3 * found.error)
    assert found.error < 0.08 * found.value


def test_what_has_no_viscosity_here():
    ball = [Species(Ball(0.5, 1.0), 20)]
    walled = Gas(ball, container("box", (6, 6, 6)), contacts=Surface(1, 0, -1))
    with pytest.raises(CaromError, match="a gas without walls, got walls left"):
        viscosity(walled)
    with pytest.raises(CaromError, match="windows: expected a whole number >= 200, got 5"):
        viscosity(Gas(ball, (6, 6, 6), contacts=Surface(1, 0, -1)), 5)
    with pytest.raises(CaromError, match="contacts that conserve energy"):
        viscosity(Gas(ball, (6, 6, 6), contacts=Surface(0.99, 0, -1)), 200)
    with pytest.raises(CaromError, match=r"a gas in equilibrium, got a shear rate of 0.1; use sheared_viscosity"):
        viscosity(Gas(ball, (6, 6, 6), contacts=Surface(1, 0, -1), shear_rate=0.1))
    with pytest.raises(CaromError, match="a gas with a shear_rate, got one without"):
        sheared_viscosity(Gas(ball, (6, 6, 6), contacts=Surface(1, 0, -1)), 100)
    with pytest.raises(CaromError, match=r"density: expected fewer than 1.91 spheres per volume"):
        enskog(2.0)
