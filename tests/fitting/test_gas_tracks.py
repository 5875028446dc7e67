"""Restitution and friction of gases from tracks, made by an event search that is not carom's: at any frame rate, with any times."""

from __future__ import annotations

import math

import numpy as np
import pytest
from reference.gas_events import RADIUS, film, scene

import carom
from carom.errors import CaromError
from carom.fitting.free_balls import collisions_of_tracks

TRUTH = {"restitution": 0.8, "friction": 0.3, "tangential_restitution": 0.4}
LAW = tuple(TRUTH.values())


def pulls(found: carom.fitting.GasFit) -> dict[str, float]:
    return {name: (found.values[name] - TRUTH[name]) / found.errors[name] for name in found.values}


@pytest.mark.parametrize("around", [False, True])
def test_more_frames_tell_more(around: bool) -> None:
    """The same gas at 10 and 40 frames a second: numbers within their error bars, which shrink, and no fewer collisions."""
    rows, errors = [], []
    for rate in (10, 40):
        columns, hits = film(LAW, rate, 8, 0.002, around=around, seed=3)
        found = carom.fit_gas(columns, scene(around))
        assert set(found.values) == set(TRUTH)
        assert max(map(abs, pulls(found).values())) < 4
        assert all(found.errors[name] < 0.03 for name in TRUTH)
        rows.append(found.rows)
        errors.append(found.errors["restitution"])
    assert rows == sorted(rows)
    assert 0.8 * hits < rows[-1] <= hits
    assert errors == sorted(errors, reverse=True)


@pytest.mark.parametrize("decimals", [3, 4])
def test_collisions_are_those_of_exact_times(decimals: int) -> None:
    columns, _hits = film(LAW, 60, 6, 0.002, seed=5)
    exact, _notes = collisions_of_tracks(columns, RADIUS)
    rounded, _notes = collisions_of_tracks(columns | {"t": np.round(columns["t"], decimals)}, RADIUS)
    assert len(rounded) == len(exact) > 10
    np.testing.assert_allclose(np.sort(rounded["v_n_in"]), np.sort(exact["v_n_in"]), rtol=2e-3)


def test_numbers_without_noise_and_falling_balls() -> None:
    columns, hits = film(LAW, 60, 8, 0.0, seed=2)
    found = carom.fit_gas(columns, scene())
    for name, value in TRUTH.items():
        assert found.values[name] == pytest.approx(value, abs=1e-6)
    assert 0.8 * hits < found.rows <= hits
    # (seen from a frame that falls, the same gas falls)
    columns["y"] = columns["y"] - columns["t"] ** 2 / 2
    fell = carom.fit_gas(columns, scene(gravity=1.0))
    assert fell.rows == found.rows
    assert fell.values["friction"] == pytest.approx(0.3, abs=1e-6)


def test_masses_and_missing_frames() -> None:
    """Frames without a ball are no bends; of balls with other masses only those with the same keep their momentum."""
    columns, _hits = film(LAW, 30, 6, 0.002, seed=4)
    every, _notes = collisions_of_tracks(columns, RADIUS)
    kept = np.random.default_rng(1).random(len(columns["t"])) > 0.2
    some, _notes = collisions_of_tracks({name: values[kept] for name, values in columns.items()}, RADIUS)
    assert 0.8 * len(every) <= len(some) <= len(every)
    heavy, notes = collisions_of_tracks(columns | {"mass": 10.0 ** (columns["ball"] % 7)}, RADIUS)
    assert len(heavy) < 0.3 * len(every)
    assert any("not used" in note for note in notes)


def test_what_cannot_be_told_is_no_number() -> None:
    """Rough balls that hardly ever slide tell no friction; a film that ends before balls meet tells nothing, and says so."""
    columns, _hits = film((0.8, 5.0, 0.4), 30, 8, 0.002, seed=6)
    found = carom.fit_gas(columns, scene())
    assert "friction" not in found.values
    assert abs(found.values["restitution"] - 0.8) < 4 * found.errors["restitution"] < 0.01
    columns, hits = film(LAW, 60, 0.2, 0.002, seed=1)
    assert hits <= 1
    with pytest.raises(CaromError) as caught:
        carom.fit_gas(columns, scene())
    assert "film longer" in str(caught.value)
    assert math.isfinite(found.errors["tangential_restitution"])
