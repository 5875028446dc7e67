"""Gases against kinetic theory: rates of collisions and of cooling, diffusion."""

import math

import numpy as np
import pytest

from carom import Ball, Disc, Surface
from carom.gas import Gas, Species, Thermostat, scattered

SPHERE, DISC = Ball(0.5, 1.0, 0.4), Disc(0.5, 1.0, 0.5)


def enskog(axes, density):
    """Collisions a ball and time at k T = 1, diameter and mass 1: Carnahan & Starling's, Henderson's contact value."""
    if axes == 3:
        y = density * math.pi / 6
        return 4 * density * (1 - y / 2) / (1 - y) ** 3 * math.sqrt(math.pi)
    y = density * math.pi / 4
    return 2 * density * (1 - 7 * y / 16) / (1 - y) ** 2 * math.sqrt(math.pi)


def start(ball, balls, density, seed=0, **options):
    axes = 2 if ball is DISC else 3
    side = ((balls / density) ** (1 / axes),) * axes
    x = scattered(np.full(balls, 0.5), side, rng=np.random.default_rng(seed))
    return Gas([Species(ball, balls)], side, position=x, seed=seed, **options)


@pytest.mark.parametrize(
    ("ball", "density", "e", "beta", "spinning"),
    [(SPHERE, 0.05, 0.9, 0.3, 0.5), (SPHERE, 0.05, 0.8, -0.6, 2.0), (DISC, 0.05, 0.9, 0.0, 0.4)],
)
def test_energies_that_a_contact_changes(ball, density, e, beta, spinning):
    # A thermostat keeps velocities and spins near Maxwellians with nothing in common, for which these hold (the rates of Huthmann
    # & Zippelius 1997 and Luding, Huthmann, McNamara & Zippelius 1998). A stronger one would move balls that have just met
    # into each other again before they are apart.
    flat = ball is DISC
    q = 0.5 if flat else 0.4
    eta, slips = (1 + beta) * q / (1 + q), 1 if flat else 2
    gas = start(
        ball,
        400,
        density,
        contacts=Surface(e, math.inf, beta),
        thermostat=Thermostat(temperature=1.0, rate=1.0, temperature_rotational=spinning),
    )
    gas.run(2_000)
    mark = gas.mark()
    gas.advance(40_000)
    run, pairs = gas.measured_since(mark), gas.arrays.materials.pairs[0]
    normal, tangential, spun = (
        float(pairs[k] - mark.pairs[0][k]) / 40_000 for k in ("lost_normal", "lost_tangential", "to_spin")
    )
    tr, rot = run.temperature_translational, run.temperature_rotational
    both = tr + rot / q
    assert normal == pytest.approx((1 - e * e) * tr, rel=0.03)
    assert tangential == pytest.approx(slips / 2 * (2 * eta - eta**2 * (1 + q) / q) * both, rel=0.03)
    assert spun == pytest.approx(slips / 2 / q * (eta**2 * both - 2 * eta * rot), rel=0.06)


def test_haffs_law_at_enskogs_rate():
    e, density, balls = 0.9, 0.1, 1500
    found = []
    for seed in range(4):
        gas = start(SPHERE, balls, density, seed, contacts=Surface(e, 0, 0))
        # T = T0 (1 + t/tau)^-2, with 1/tau = (1 - e^2)/6 of the rate at T0
        tau = 6 / ((1 - e * e) * enskog(3, density))
        gas.run(until=3 * tau)
        found.append(math.sqrt(1.5 * balls / gas.energy()[0]) - 1)
    # the velocities are no Maxwellian: a2 (van Noije & Ernst, Granular Matter 1, 57 (1998))
    a2 = 16 * (1 - e) * (1 - 2 * e * e) / (81 - 17 * e + 30 * e * e * (1 - e))
    assert np.mean(found) == pytest.approx(3 * (1 + 3 * a2 / 16), rel=0.03)


@pytest.mark.slow
def test_diffusion_of_spheres():
    balls, density, step = 500, 0.5, 4.0
    side = (balls / density) ** (1 / 3)
    gas = Gas([Species(SPHERE, balls)], (side,) * 3, contacts=Surface(1, 0, -1))
    gas.run(20_000)
    path = []
    for _ in range(250):
        gas.advance(until=gas.time + step)
        now = gas.balls()
        path.append(now.position + now.images * side)
    lags = np.array([2, 3, 4, 5])
    squares = [((np.array(path[lag:]) - path[:-lag]) ** 2).sum(axis=2).mean() for lag in lags]
    # 0.243 in a box of 500 (1 to 2 % above Speedy's fit, Mol. Phys. 62, 509 (1987)); larger ones give more, see the theory page
    assert np.polyfit(lags * step, squares, 1)[0] / 6 == pytest.approx(0.2405, rel=0.035)
