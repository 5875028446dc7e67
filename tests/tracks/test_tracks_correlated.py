"""Noise that is correlated from frame to frame, drag that the flights do not show, and cameras that are turned."""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np
import pytest
from reference.exploring import tried
from reference.known_films import Fall, drawn_fall, fallen, noise, rotated
from reference.synthetic_tracks import RADIUS, Camera, seen, shot, truth

from carom.tracks import Measured, Settings, Track, measure, usable_stages
from carom.tracks.correlation import Correlation, FrameGroups, whitening
from carom.tracks.events import wall_through
from carom.tracks.flights import fit_flights, flight_path


def filmed(seed: int, correlation: float, rate: float = 240.0) -> tuple[Measured, list[dict[str, float]]]:
    rng = np.random.default_rng(seed)
    run = shot(rng)
    track = seen(run, Camera(rate, 0.0), rng)
    x = track.position + noise(rng, track.position.shape, 3e-4, correlation)
    return measure([replace(track, position=x)], Settings(view="above")), truth(run)


def test_means_of_frames_have_the_covariance_of_their_frames() -> None:
    t, one = np.arange(12) / 100, Correlation(0.8, 0.7)
    mean = np.zeros((5, 12))
    mean[0, 0] = mean[1, 1] = mean[4, 11] = 1.0
    mean[2, 2:6], mean[3, 6:11] = 1 / 4, 1 / 5
    single = np.eye(12) * 0.3 + 0.7 * 0.8 ** np.abs(np.subtract.outer(np.arange(12), np.arange(12)))
    first, last = t[[0, 1, 2, 6, 11]], t[[0, 1, 5, 10, 11]]
    white = whitening(FrameGroups(first, last, np.array([1.0, 1, 4, 5, 1])), one, 0.01)
    np.testing.assert_allclose(white @ (mean @ single @ mean.T) @ white.T, np.eye(5), atol=1e-9)


def test_correlated_noise_is_found_and_said_and_the_error_bars_hold() -> None:
    pulls = []
    for seed in range(tried(1, 2)):
        found, told = filmed(seed, 0.9)
        assert found.correlation == pytest.approx(0.9, abs=0.1)
        assert "the noise is correlated from frame to frame, by 0." in " ".join(found.notes)
        for one in found.contacts:
            near = min(told, key=lambda row: abs(row["t"] - one.time))
            if one.fit is not None and "after_wall" in usable_stages(one, "both")[0]:
                pulls += [
                    (one.fit[name] - near[name]) / one.fit.error(name)
                    for name in ("vn_in", "vt_in", "vn_out", "vt_out")
                ]
    assert len(pulls) >= 4
    assert np.abs(pulls).max() < 4  # 8.8 error bars without the correlation
    assert np.sqrt(np.mean(np.square(pulls))) < 1.6


@pytest.mark.parametrize("seed", [5, 6])
def test_white_noise_is_left_alone(seed: int) -> None:
    found, _told = filmed(seed, 0.0)
    assert found.correlation == 0.0
    assert "correlated" not in " ".join(found.notes)


def test_a_drag_that_is_not_significant_is_part_of_the_error_bars() -> None:
    pulls = []
    for seed in range(8):
        rng = np.random.default_rng(seed)
        fall = drawn_fall(rng, drag=0.022, restitution=0.78, height=1.3, last=1.6, first=0.0, rate=60.0, noise=2e-3)
        found = measure([fallen(fall, seed)[0]], Settings(view="side"))
        for one in found.measured[:1]:
            fit = one.fit
            assert fit is not None
            assert fit.drag_shift is not None
            before, after = -fit["vn_in"], fit["vn_out"]
            shared = 2 * fit.covariance_of("vn_in", "vn_out") / (before * after)
            error = (fit.error("vn_in") / before) ** 2 + (fit.error("vn_out") / after) ** 2 + shared
            pulls.append((after / before - 0.78) / (0.78 * np.sqrt(error)))
    assert len(pulls) == 8
    assert np.abs(pulls).max() < 3.5
    known = measure([fallen(Fall(rate=60.0), 1)[0]], Settings(view="side", drag=0.0))
    assert known.measured[0].fit.drag_shift is None  # type: ignore[union-attr]


@pytest.mark.parametrize("degrees", [30.0, 45.0, 60.0])
def test_corners_of_a_path_are_no_walls(degrees: float) -> None:
    said = 0
    for seed in range(4):
        rng = np.random.default_rng(seed)
        track = seen(shot(rng), Camera(100, 3e-4), rng)
        found = measure([replace(track, position=rotated(track.position, degrees))], Settings(view="above"))
        assert not [one for one in found.contacts if usable_stages(one, "both")[0]]
        said += "give the walls' lines by two points each" in " ".join(found.notes)
    assert said or degrees == 45.0  # there two corners are met within two frames, and no contact is measured at all


def film_of_many_shots(degrees: float, count: int = 8) -> Measured:
    """Shots on one table, filmed by a camera that is turned."""
    rng = np.random.default_rng(3)
    tracks = [replace(seen(shot(rng), Camera(100, 3e-4), rng), group=f"{i}") for i in range(count)]
    turned = [replace(track, position=rotated(track.position, degrees)) for track in tracks]
    return measure(turned, Settings(view="above", radius=RADIUS))


def test_turns_of_many_shots_show_the_direction_of_the_walls() -> None:
    straight, turned = film_of_many_shots(0.0), film_of_many_shots(10.0)
    assert len(straight.measured) >= 8
    assert not [note for note in straight.notes if "the camera was turned" in note]
    assert not turned.measured
    (note,) = [note for note in turned.notes if "the camera was turned: balls turn at lines" in note]
    assert float(note.split("lie at ")[1].split()[0]) == pytest.approx(10.0, abs=0.5)
    lines = re.findall(r"(\w+) \((\S+), (\S+)\) to \((\S+), (\S+)\)", note)
    walls = [
        wall_through(name, (float(a), float(b)), (float(c), float(d)), turned.tracks) for name, a, b, c, d in lines
    ]
    again = measure(turned.tracks, Settings(view="above", radius=RADIUS, walls=tuple(walls)))
    pairs = [
        (one.fit["vn_out"] / -one.fit["vn_in"], other.fit["vn_out"] / -other.fit["vn_in"])
        for one, other in zip(straight.contacts, again.contacts, strict=True)
        if one.fit is not None and other.fit is not None and usable_stages(one, "both")[0]
    ]
    assert len(pairs) >= 5
    assert np.median(np.abs(np.diff(pairs))) < 0.02


@pytest.mark.parametrize("seed", [126, 146, 231, 249, 289])
def test_fits_of_flights_that_diverge_give_no_result(seed: int) -> None:
    rng = np.random.default_rng(seed)
    count = rng.integers(6, 40)
    t = np.arange(count) / rng.choice([30.0, 60.0, 240.0])
    x = flight_path(rng.normal(0, 3, 2), np.array([0.0, -9.8]), rng.uniform(0, 1.5), t)
    x = x + rng.normal(0, rng.choice([1e-3, 1e-2, 5e-2]), x.shape)
    assert fit_flights([Track("ball", t, x)], 1e-3, float(t[1]), 9.8) is None
