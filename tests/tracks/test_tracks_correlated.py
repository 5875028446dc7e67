"""Noise that is correlated from frame to frame, drag that the flights do not show, and cameras that are turned."""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np
import pytest
from reference.exploring import tried
from reference.known_films import Fall, drawn_fall, fallen, noise, rotated
from reference.synthetic_tracks import RADIUS, Camera, seen, shot, truth

from carom.fitting import Setting, make_problem
from carom.tracks import Measured, Settings, Track, TrackContact, measure, to_rebounds, usable_stages
from carom.tracks.events import wall_through
from carom.tracks.films import air_together, combined_rebounds
from carom.tracks.flights import fit_flights, flight_path, joint_air
from carom.tracks.least_squares import (
    GRID,
    WHITE,
    Correlation,
    FittedFrames,
    FrameGroups,
    averaging_error,
    weigh_correlations,
    whitening,
)


def filmed(seed: int, correlation: float, rate: float = 240.0) -> tuple[Measured, list[dict[str, float]]]:
    rng = np.random.default_rng(seed)
    run = shot(rng)
    track = seen(run, Camera(rate, 0.0), rng)
    x = track.position + noise(rng, track.position.shape, 3e-4, correlation)
    return measure([replace(track, position=x)], Settings(view="above")), truth(run)


def restitution(one: TrackContact) -> tuple[float, float]:
    """The restitution of a measured contact, and its standard deviation."""
    fit = one.fit
    assert fit is not None
    before, after = -fit["vn_in"], fit["vn_out"]
    shared = 2 * fit.covariance_of("vn_in", "vn_out") / (before * after)
    error = (fit.error("vn_in") / before) ** 2 + (fit.error("vn_out") / after) ** 2 + shared
    return after / before, after / before * float(np.sqrt(error))


def test_means_of_frames_have_the_covariance_of_their_frames() -> None:
    t, one = np.arange(12) / 100, Correlation(0.8, 0.7)
    mean = np.zeros((5, 12))
    mean[0, 0] = mean[1, 1] = mean[4, 11] = 1.0
    mean[2, 2:6], mean[3, 6:11] = 1 / 4, 1 / 5
    single = np.eye(12) * 0.3 + 0.7 * 0.8 ** np.abs(np.subtract.outer(np.arange(12), np.arange(12)))
    first, last = t[[0, 1, 2, 6, 11]], t[[0, 1, 5, 10, 11]]
    white = whitening(FrameGroups(first, last, np.array([1.0, 1, 4, 5, 1])), one, 0.01)
    np.testing.assert_allclose(white @ (mean @ single @ mean.T) @ white.T, np.eye(5), atol=1e-9)


def test_the_weights_of_correlations_are_those_of_their_covariances() -> None:
    """The filter that follows the noise from frame to frame, against determinants and inverses of whole matrices."""
    rng = np.random.default_rng(4)
    t = np.sort(rng.choice(40, 24, replace=False)) / 50
    slope, known, r = rng.normal(size=(24, 2, 3)), rng.normal(size=(2, 3)), rng.normal(size=(24, 2))
    likely = weigh_correlations([("ball", FittedFrames(t, r, slope, known, 0.5))], 0.02)
    x = np.concatenate([slope.transpose(1, 0, 2).reshape(48, 3) / 0.5, known])
    y = np.concatenate([r.T.ravel() / 0.5, np.zeros(2)])
    logs = []
    for one, (fades, share) in zip(likely, GRID, strict=True):
        frames = (1 - share) * np.eye(24) + share * fades ** np.abs(np.subtract.outer(t, t) / 0.02)
        inverse = np.eye(50)
        inverse[:24, :24] = inverse[24:48, 24:48] = np.linalg.inv(frames)
        normal = x.T @ inverse @ x
        gap = y - x @ np.linalg.solve(normal, x.T @ inverse @ y)
        variance = float(gap @ inverse @ gap) / 47
        assert one.variance == pytest.approx(variance, rel=1e-9)
        size = 2 * np.linalg.slogdet(frames)[1] + np.linalg.slogdet(normal)[1] + 47 * np.log(variance)
        logs.append(-size / 2 + np.log(0.5 if one.correlation == WHITE else 0.5 / 40))
    weight = np.exp(np.array(logs) - max(logs))
    np.testing.assert_allclose([one.probability for one in likely], weight / weight.sum(), atol=2e-3)


def test_the_error_of_averaging_is_the_mean_of_the_covariances() -> None:
    """A mean position of independent frames: its variance is the mean of the correlation matrix."""
    t, n = np.arange(12) / 50, 12
    fit = FittedFrames(t, np.zeros((n, 2)), np.stack([np.ones((n, 2))], axis=-1), np.zeros((0, 1)), 1.0)
    noise = np.random.default_rng(2).normal(size=(n, 2))
    likely = weigh_correlations([("ball", fit._replace(residuals=noise - noise.mean()))], 0.02)
    apart = np.abs(np.subtract.outer(np.arange(n), np.arange(n)))
    whole = sum(
        one.probability * one.variance / likely[0].variance
        * np.where(apart == 0, 1.0, one.correlation.share * one.correlation.fades**apart).mean() / 2
        for one in likely
    )  # fmt: skip
    assert averaging_error(fit, WHITE, likely, 0.02)[0, 0] == pytest.approx(whole - 1 / (2 * n), rel=1e-9)
    assert whole > 1.2 / (2 * n)


@pytest.mark.parametrize("seed", [112, 164, 65])
@pytest.mark.slow(keep=1)
def test_correlated_noise_of_a_ball_at_rest_is_no_bounce(seed: int) -> None:
    fall = drawn_fall(np.random.default_rng(seed), correlation=0.5)
    track, bounces = fallen(fall, seed)
    found = [
        one
        for one in measure([track], Settings(view="side", drag_per_metre=0.0)).measured
        if usable_stages(one, "both")[0]
    ]
    assert len(found) >= 2
    for one in found:  # a ball that had come to rest bounced with a restitution of 1
        near = min(bounces, key=lambda bounce: abs(bounce.t - one.time))
        assert near.v_n_out**2 / 2 / 9.81 > 4 * fall.noise


def test_few_frames_with_correlated_noise_have_wider_error_bars() -> None:
    pulls = []
    for seed in range(16):
        given = {"rate": 30.0, "first": 0.0, "last": 1.2, "restitution": 0.8, "height": 0.6, "noise": 1e-3}
        track, _bounces = fallen(drawn_fall(np.random.default_rng(seed), correlation=0.5, **given), seed)
        for one in measure([track], Settings(view="side", drag_per_metre=0.0)).measured:
            e, error = restitution(one)
            pulls.append((e - 0.8) / error)
    assert len(pulls) > 20
    assert np.sqrt(np.mean(np.square(pulls))) < 1.3  # 1.58 with independent noise where no correlation is certain


@pytest.mark.slow
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
            assert one.fit is not None
            assert "drag" in one.fit.shifts
            e, error = restitution(one)
            pulls.append((e - 0.78) / error)
    assert len(pulls) == 8
    assert np.abs(pulls).max() < 3.5
    known = measure([fallen(Fall(rate=60.0), 1)[0]], Settings(view="side", drag_per_metre=0.0))
    assert "drag" not in known.measured[0].fit.shifts  # type: ignore[union-attr]


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


def test_films_of_one_ball_share_the_drag_of_the_air() -> None:
    falls = [Fall(0.78, 1.2 + 0.3 * i, 0.3, drag=0.035, last=1.6, rate=60.0, noise=1e-3) for i in range(2)]
    alone = [measure([fallen(fall, i)[0]], Settings(view="side")) for i, fall in enumerate(falls)]
    together, (note,) = air_together(alone)
    air, second = (one.air for one in together)
    assert air[1:3] == second[1:3]
    assert abs(air.drag_per_metre - 0.035) < 3 * air.drag_error
    assert air.drag_error < min(one.air.drag_error for one in alone)
    assert "from the flights of all films together" in note
    # the velocities are those that a fit with this drag gives
    known = measure([fallen(falls[0], 0)[0]], Settings(view="side", drag_per_metre=air.drag_per_metre))
    for one, other, before in zip(together[0].measured, known.measured, alone[0].measured, strict=True):
        for name in ("vn_in", "vt_in", "vn_out", "vt_out"):
            assert abs(one.fit[name] - other.fit[name]) < 0.1 * before.fit.error(name)
        assert one.fit.error("vn_out") <= before.fit.error("vn_out")
    # and its error is one for the rows of all films
    rows = combined_rebounds({str(i): to_rebounds(one) for i, one in enumerate(together)})
    (shared,) = [one for one in make_problem(rows, Setting(0.1))[0].shared if one.name.startswith("air drag")]
    assert shared.rows.any(axis=1).all()
    # films whose flights contradict each other have air of their own
    other = [one._replace(seen=(0.1, 0.002)) for one in (alone[0].air,)]
    assert joint_air([*other, *(one.air for one in alone[1:])]) is None
