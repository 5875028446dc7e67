"""Restitution at known speeds, and a ball that bounces until it stays: against hops one by one."""

from __future__ import annotations

import math

import pytest

from carom.core.motion.phases import (
    CONSTANT,
    EXPONENTIAL,
    POLYNOMIAL,
    POWER,
    VISCOELASTIC,
    bounces,
    restitution,
    series_lasts,
)

G = 9.8
FORMS = {
    "constant": (CONSTANT, (0.6, 0.0, 0.0)),
    "a carom cushion (Han 2005)": (POLYNOMIAL, (0.39, 0.257, -0.044)),
    "plastic": (POWER, (0.8, 0.5, 0.25)),
    "viscoelastic": (VISCOELASTIC, (0.3, 0.0, 0.0)),
    "exponential": (EXPONENTIAL, (0.9, 0.5, 2.0)),
}


@pytest.mark.parametrize(
    ("form", "p", "speed", "e"),
    [
        (POLYNOMIAL, (0.39, 0.257, -0.044), 0.0, 0.39),
        (POLYNOMIAL, (0.39, 0.257, -0.044), 1.0, 0.603),
        (POLYNOMIAL, (0.39, 0.257, -0.044), 9.0, 0.39 + 0.257**2 / (4 * 0.044)),
        (POLYNOMIAL, (0.9, -0.1, 0.0), 2.0, 0.7),
        (POLYNOMIAL, (0.9, -0.1, 0.0), 20.0, 0.0),
        (POWER, (0.8, 2.0, 0.25), 1.0, 0.8),
        (POWER, (0.8, 2.0, 0.25), 32.0, 0.4),
        (VISCOELASTIC, (0.1, 0.0, 0.0), 0.0, 1.0),
        (VISCOELASTIC, (0.1, 0.0, 0.0), 32.0, 1 / 1.216),
        (EXPONENTIAL, (0.9, 0.5, 2.0), 0.0, 0.9),
        (EXPONENTIAL, (0.9, 0.5, 2.0), 2.0, 0.5 + 0.4 / math.e),
    ],
)
def test_restitution_at_known_speeds(form: int, p: tuple[float, float, float], speed: float, e: float) -> None:
    assert restitution(form, p, speed) == pytest.approx(e, rel=1e-14)


def hops(form: int, p: tuple[float, float, float], vz: float, until: float) -> tuple[float, float, float]:
    """Height, upward velocity and time, hop by hop on a smooth floor, until a time or until hops take a nanosecond."""
    t = 0.0
    while vz > 1e-9:
        hop = 2 * vz / G
        if t + hop > until:
            s = until - t
            return vz * s - G * s * s / 2, vz - G * s, until
        t, vz = t + hop, vz * restitution(form, p, vz)
    return 0.0, 0.0, t


@pytest.mark.parametrize("name", FORMS)
@pytest.mark.parametrize("until", [0.1, 0.5, 0.8])
def test_a_bouncing_ball_is_where_hops_one_by_one_bring_it(name: str, until: float) -> None:
    form, p = FORMS[name]
    z, vz, t = hops(form, p, 2.0, until)
    start, spin = (0.5, -0.2, 0.03), (1.0, 2.0, 3.0)
    x, v, w, passed = bounces(start, (0.7, 0.3, 2.0), spin, 0.03, 0.4, G, form, p, 0.0, 0.0, until)
    assert passed == pytest.approx(t, rel=1e-9)
    assert x == pytest.approx((0.5 + 0.7 * t, -0.2 + 0.3 * t, 0.03 + z), abs=1e-9)
    assert v == pytest.approx((0.7, 0.3, vz), abs=1e-8)
    assert w == spin


@pytest.mark.parametrize("name", FORMS)
def test_it_stays_on_the_floor_once_all_hops_are_over_and_before_the_bound(name: str) -> None:
    form, p = FORMS[name]
    *_, t = hops(form, p, 2.0, math.inf)
    x, v, _w, passed = bounces((0.0, 0.0, 0.03), (0.7, 0.3, 2.0), (0, 0, 0), 0.03, 0.4, G, form, p, 0.0, 0.0, 1e6)
    assert passed == pytest.approx(t, rel=1e-6)
    assert x == pytest.approx((0.7 * t, 0.3 * t, 0.03), rel=1e-6)
    assert v == (0.7, 0.3, 0.0)
    lasts = series_lasts(2.0, G, form, p)
    assert t * (1 - 1e-9) <= lasts < 4 * t
    if form == CONSTANT:
        assert lasts == pytest.approx(2 * 2.0 / (G * (1 - 0.6)))


def test_a_floor_that_returns_everything_has_no_last_bounce() -> None:
    assert series_lasts(2.0, G, CONSTANT, (1.0, 0.0, 0.0)) == math.inf
    assert series_lasts(2.0, G, VISCOELASTIC, (0.0, 0.0, 0.0)) == math.inf
    assert series_lasts(2.0, G, EXPONENTIAL, (1.0, 0.5, 1.0)) == math.inf
