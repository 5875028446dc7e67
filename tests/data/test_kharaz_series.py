"""The script of the docs page: which of Kharaz's series tells restitution and friction, and what shifted series do."""

from __future__ import annotations

from types import ModuleType

import numpy as np
import pytest
from reference.commands import script


@pytest.fixture(scope="module")
def series() -> ModuleType:
    return script("kharaz_series")


ALL = ("kept", "spin", "rebound", "patch")


def test_what_a_series_shows_is_its_geometry(series):
    at = np.array([5.0, 20.0, 40.0])
    numbers = {"restitution": 0.9, "friction": 0.1, "stiffness_ratio": 0.85}
    kept, spin, rebound, patch = (series.said(name, at, numbers, False) for name in ALL)
    i = np.radians(at)
    assert spin == pytest.approx((1 - kept) * 3.9 * np.sin(i) / (0.4 * 0.0025), rel=1e-9)
    assert np.tan(np.radians(rebound)) == pytest.approx(kept * np.tan(i) / 0.9, rel=1e-9)
    assert np.tan(np.radians(patch)) == pytest.approx((3.5 * kept - 2.5) * np.tan(i) / 0.9, rel=1e-9)
    # where all slide, v_t loses mu (1 + e) v_n
    assert series.said("kept", at[2:], numbers, True) == pytest.approx(1 - 0.1 * 1.9 / np.tan(i[2:]))


@pytest.mark.parametrize("name", ["kept", "spin"])
def test_speed_and_spin_know_only_the_product(series, name):
    at = np.array([5.0, 20.0, 40.0])
    one = series.said(name, at, {"restitution": 0.98, "friction": 0.09, "stiffness_ratio": 0.85}, False)
    other = series.said(name, at, {"restitution": 0.8, "friction": 0.09 * 1.98 / 1.8, "stiffness_ratio": 0.85}, False)
    assert one == pytest.approx(other, rel=1e-12)


def test_the_published_pair_within_the_error_bars(series):
    alone = series.fit_series(("rebound",))
    assert abs(alone.values["restitution"] - 0.98) < alone.errors["restitution"]
    for slides in (False, True):
        both = series.fit_series(ALL, slides=slides, shared=series.SHARED)
        assert both.values["friction"] == pytest.approx(0.0925, abs=0.0015)
        assert both.errors["friction"] < 0.002
        assert abs(both.values["restitution"] - 0.98) < 1.1 * both.errors["restitution"]
        assert 0.008 < both.errors["restitution"] < 0.018


def test_0_98_costs_nothing_but_a_shift_as_large_as_the_series_differ_by(series):
    for shared, low, high in ((0.0, 5.0, 12.0), (series.SHARED, 0.0, 2.0)):
        free = series.fit_series(ALL, shared=shared)
        held = series.fit_series(ALL, shared=shared, fixed={"restitution": 0.98}, scatter=free.scatter)
        assert low < held.chi2 - free.chi2 < high
        assert held.values["friction"] == pytest.approx(0.094, abs=0.0015)
    where = ("rebound", "angle")
    one = series.fit_series(("kept", "rebound"), shared=10.0, only=where, fixed={"restitution": 0.98})
    assert -one.shifts[where] == pytest.approx(0.26, abs=0.02)
    assert -one.shifts[where] < series.SHARED * 1.2
