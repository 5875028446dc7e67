"""Transport coefficients by Helfand's relations and by shear, against Enskog's theory."""

from __future__ import annotations

import math

import numpy as np
import pytest

from carom import Ball, CaromError, Surface
from carom.gas import (
    Drive,
    Gas,
    Species,
    container,
    diffusion_coefficients,
    enskog,
    layer_profiles,
    sheared_viscosity,
    transport_coefficients,
    viscosity,
)


@pytest.mark.slow
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


@pytest.mark.parametrize("density", [0.02, 0.2])
@pytest.mark.slow(keep=1)
def test_diffusion_by_einstein_is_that_by_green_and_kubo_and_of_rough_spheres(density):
    """Spins forget (1 + beta) / (3 (1 + kappa)) of themselves in a collision, whatever the density."""
    count, kappa = 100, 0.4
    side = (count / density) ** (1 / 3)
    gas = Gas([Species(Ball(0.5, 1.0, kappa), count)], (side,) * 3, contacts=Surface(1, math.inf, 1), seed=2)
    gas.advance(2000)
    begin = gas.mark()
    found = diffusion_coefficients(gas, 2000)
    state = gas.measured_since(begin)
    rate = 2 / (3 * (1 + kappa)) / state.mean_free_time
    spins = state.temperature_rotational / (kappa * 0.25) / rate
    balls = enskog(density, temperature=state.temperature_translational).self_diffusion * (1 + kappa) / (1 + 2 * kappa)
    for one, known, share in ((found.spin_diffusion, spins, 0.06), (found.self_diffusion, balls, 0.08)):
        assert one.error < share * one.value
        assert one.green_kubo_error < share * one.value
        assert one.value == pytest.approx(one.green_kubo, abs=3 * one.error)
        # (a first approximation: fast balls collide more often)
        assert one.value == pytest.approx(known, abs=3 * one.error + 0.05 * known)


def test_spins_that_nothing_changes_do_not_diffuse():
    gas = Gas([Species(Ball(0.5, 1.0), 20)], (6, 6, 6), contacts=Surface(1, 0, -1), seed=1)
    found = diffusion_coefficients(gas, 2000)
    assert math.isnan(found.spin_diffusion.value)
    assert found.self_diffusion.value > 0
    with pytest.raises(CaromError, match=r"samples: expected a whole number >= 2000, got 5"):
        diffusion_coefficients(gas, 5)


def test_heat_between_walls_is_the_same_through_every_plane_and_has_the_errors_that_its_scatter_shows():
    side, surfaces = (5.0, 5.0, 20.0), {("a", "a"): Surface(1, 0, -1), ("a", "wall"): Surface(1, 0, -1)}
    drives = {name: Drive(temperature=t, temperature_rotational=0.0) for name, t in (("bottom", 1.5), ("top", 0.75))}
    species = Species(Ball(0.5, 1.0), 100, "a", 1.0, 0.0)
    gas = Gas([species], side, periodic=(True, True, False), contacts=surfaces, drives=drives, seed=1)
    gas.advance(20_000)
    begin = gas.mark()
    mean, error = layer_profiles(gas, 100_000)
    given = gas.measured_since(begin)
    flux = (given.energy_from_walls["bottom"] - given.energy_from_walls["top"]) / (2 * 25 * given.simulated_time)
    inner = slice(1, -1)
    np.testing.assert_allclose(mean.heat_flux[inner], flux, atol=0.1 * flux)  # (energy goes in and out by fluctuation)
    assert np.all(mean.heat_flux[inner] > 5 * error.heat_flux[inner])
    assert np.all(np.abs(mean.velocity[0, :, 2]) < 5 * error.velocity[0, :, 2] + 1e-3)
    assert mean.temperature[0, 0] - mean.temperature[0, -1] > 5 * math.hypot(
        error.temperature[0, 0], error.temperature[0, -1]
    )
    with pytest.raises(
        CaromError, match="layer_profiles: gas: expected a gas with walls or a shear rate, got one without"
    ):
        layer_profiles(Gas([species], (6, 6, 6), contacts=Surface(1, 0, -1)), 100)


@pytest.mark.parametrize(
    ("contact", "spins"), [(Surface(1, 0, -1), None), (Surface(1, 0, -1), 1.0), (Surface(1, math.inf, 1), None)]
)
def test_the_flux_through_a_gas_is_what_its_heated_walls_give(contact, spins):
    """Spins that walls gave to smooth balls were in what the walls gave, 27 % of it, and not in the flux through the layers."""
    surfaces = {("a", "a"): contact, ("a", "wall"): Surface(1, 0, -1)}
    drives = {name: Drive(temperature=t, temperature_rotational=spins) for name, t in (("bottom", 1.5), ("top", 0.75))}
    gas = Gas(
        [Species(Ball(0.5, 1.0), 100)],
        (5.0, 5.0, 20.0),
        periodic=(True, True, False),
        contacts=surfaces,
        drives=drives,
        seed=1,
    )
    gas.advance(10_000)
    begin = gas.mark()
    gas.advance(60_000)
    run = gas.measured_since(begin)
    layers, area = run.averages.layers, 25 * run.simulated_time
    given = (run.energy_from_walls["bottom"] - run.energy_from_walls["top"]) / (2 * area)
    np.testing.assert_allclose(layers.energy_flux[1:-1].mean(), given, rtol=0.01)
    if contact.friction == 0 and spins is None:
        assert run.temperature_rotational < 0.05  # (of balls that no wall has met yet)
