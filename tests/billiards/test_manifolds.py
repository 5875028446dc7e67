"""Stable and unstable manifolds: orbits through the foci of an ellipse, invariance, the growth by the multiplier."""

from __future__ import annotations

import math

import numpy as np
import pytest

import carom
from carom import billiards
from carom.scene.figures.polygons import ellipse_depth


@pytest.fixture(scope="module")
def long_axis():
    return billiards.periodic_orbits(billiards.ellipse(1.25, 1.0), 2, law="mirror", starts=60)[-1]


@pytest.mark.parametrize("kind", ["unstable", "stable"])
def test_manifolds_of_an_ellipse_are_the_orbits_through_its_foci(long_axis, kind):
    curve = billiards.manifold(long_axis, kind)
    momenta = [
        (curve.position[:, 0] - focus) * curve.velocity[:, 1] - curve.position[:, 1] * curve.velocity[:, 0]
        for focus in (0.75, -0.75)
    ]
    assert np.abs(momenta[0] * momenta[1]).max() < 1e-13
    assert curve.apart <= 0.02
    assert {0, 1} == set(curve.branch.tolist())
    assert np.ptp(curve.phase[:, 1]) > 1  # they are followed far from the orbit


def start_at(curve, k):
    inwards = curve.position[k] * (1 - 1e-15)
    return tuple(inwards), tuple(curve.velocity[k]), float(curve.spin[k])


def test_a_stable_manifold_leads_to_its_orbit_at_the_rate_of_its_multiplier():
    ball = carom.Disc(1.0, 1.0, 0.5)
    table = billiards.stadium(2.0, 1.0)
    orbits = billiards.periodic_orbits(table, 4, ball=ball, starts=150, seed=1)
    orbit = next(one for one in orbits if 13 < one.multipliers[0].real < 15)  # (not at a seam)
    curve = billiards.manifold(orbit, "stable", length=0.1)
    value = abs(orbit.multipliers[0])
    each = orbit.period * (1 if orbit.multipliers[0].real > 0 else 2)
    places = orbit.orbit.position[:, :2]

    def distance(x):
        return np.linalg.norm(places - x, axis=1).min()

    far = [distance(x) for x in curve.position]
    some = [k for k in range(len(far)) if 1e-4 < far[k] < 2e-3][::40]
    assert len(some) >= 2
    for k in some:
        run = billiards.orbit(table, start_at(curve, k), each, ball=ball)
        assert distance(run.position[-1, :2]) / far[k] == pytest.approx(value ** (-each / orbit.period), rel=0.05)


def test_what_has_no_manifold_is_refused(long_axis):
    short = billiards.periodic_orbits(billiards.ellipse(1.25, 1.0), 2, law="mirror", starts=60)[0]
    with pytest.raises(
        carom.CaromError, match="manifold: found: expected a hyperbolic periodic orbit, got one that is elliptic"
    ):
        billiards.manifold(short)
    with pytest.raises(carom.CaromError, match="manifold: kind: expected 'unstable' or 'stable', got 'both'"):
        billiards.manifold(long_axis, "both")


@pytest.mark.parametrize(("p", "q"), [(1.25, 1.0), (1.0, 1.25), (1.0, 1.0), (3.0, 0.2)])
def test_distances_to_an_ellipse_are_the_least_of_all(p, q):
    # (1e-7 beside the vertex the distance was wrong by 2e-9, and a start there refused)
    x = np.random.default_rng(0).normal(size=(300, 2)) * (p, q)
    special = [(0, 0), (p, 0), (0, q), (p * (1 - 1e-14), 1e-7), (0.1, 0), (0, 0.1), (p - q * q / p, 0), (2 * p, 0)]
    x = np.concatenate([x, special])
    u = np.linspace(0, math.tau, 20_000)
    far = np.hypot(x[:, :1] - p * np.cos(u), x[:, 1:] - q * np.sin(u))
    u = u[far.argmin(axis=1)]
    for _ in range(9):  # (from near the least distance, whose error is of second order)
        (c, s), (dx, dy) = (np.cos(u), np.sin(u)), (x[:, 0] - p * np.cos(u), x[:, 1] - q * np.sin(u))
        slope, bend = p * s * dx - q * c * dy, (p * s) ** 2 + (q * c) ** 2 + p * c * dx + q * s * dy
        u = u - np.where(bend > 0, slope / np.where(bend > 0, bend, 1.0), 0.0)
    least = np.hypot(x[:, 0] - p * np.cos(u), x[:, 1] - q * np.sin(u))
    inside = (x**2 / (p * p, q * q)).sum(axis=1) < 1
    assert np.abs(ellipse_depth(p, q, x) - np.where(inside, least, -least)).max() < 4e-15
