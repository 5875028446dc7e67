"""Balls that hop off a wall: fits with and without a hop, and the verdict of all contacts."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

import carom
from carom.fitting import Setting, fit_laws
from carom.scene.shapes import Plane, Table
from carom.tracks import Measured, Settings, Track, measure, to_rebounds
from carom.tracks.contact import averaged
from carom.tracks.contact_models import hop_slide_roll, hopped_slopes, slide_then_roll
from carom.tracks.films import hops_together

RADIUS, FLOOR = 0.025, 0.25
ABOVE = Settings(view="above", radius=RADIUS)
NAMES = ("vn_in", "vt_in", "vn_out", "vt_out", "hop")
SHOTS = [(speed, angle) for speed in (0.8, 1.6) for angle in (5, 15, 25, 35, 45, 55, 62, 67)]


@cache
def films(friction: float, height: float) -> tuple[tuple[Track, ...], list[dict[str, float]]]:
    """Sixteen films of a ball that rolls into a wall, and of each the true velocities and the duration of the hop."""
    rng = np.random.default_rng(5)
    tracks, told = [], []
    wall = {"restitution": 0.72, "friction": friction}
    shape = (
        Plane(point=(0, 0, 0), normal=(1, 0, 0), **wall)
        if height == 1
        else Table(length=6, width=6, center=(3, 0), nose_height=height * RADIUS, **wall)
    )
    for number, (speed, degrees) in enumerate(SHOTS):
        angle = np.radians(degrees)
        v = (-speed * np.cos(angle), speed * np.sin(angle), 0.0)
        ball = carom.SceneBall(
            radius=RADIUS, mass=0.15, position=(RADIUS + 0.3 * np.cos(angle) + 0.02, 0.05), velocity=v, rolling=True
        )
        floor = carom.Floor(friction=FLOOR, restitution=0.0, rolling_resistance=0.012)
        run = carom.simulate(carom.Scene(floor=floor, walls=[shape], balls=[ball], run=carom.Run(duration=1.3)))
        time = np.arange(rng.uniform(0, 1 / 120), run.end, 1 / 120)
        place = np.asarray(run.at(time).position)[:, 0, :2] + rng.normal(0, 5e-4, (len(time), 2))
        tracks.append(Track("ball", time, place, group=f"shot {number}"))
        event = run.events.of("wall")[0]
        before, after = event.before.velocity, event.after.velocity
        told.append(dict(zip(NAMES, (*before[:2], *after[:2], 2 * max(after[2], 0.0) / 9.80665), strict=True)))
    return tuple(tracks), told


@cache
def found(friction: float, height: float) -> Measured:
    return measure(films(friction, height)[0], ABOVE)


@pytest.mark.parametrize(
    ("friction", "height", "verdict", "stage"),
    [(0.18, 1.0, "seen", "rolling"), (0.05, 1.0, "possible", "rolling"), (0.18, 1.25, "none", "after_wall")],
)
@pytest.mark.slow(keep=1)
def test_hops_off_a_plain_wall_do_not_bias(friction: float, height: float, verdict: str, stage: str) -> None:
    """Without hops in the model the velocities after plain walls were 28 and 9 error bars off, the restitutions 54 and 17."""
    measured = found(friction, height)
    assert {one.hop for one in measured.contacts} == {verdict}
    told = films(friction, height)[1]
    for name in NAMES[2:4]:
        pulls = [
            (one.fit[name] - t[name]) / one.fit.error(name) for one, t in zip(measured.measured, told, strict=True)
        ]
        assert np.sqrt(np.mean(np.square(pulls))) < 1.5
    rebounds = to_rebounds(measured)
    assert set(rebounds.stage) == {stage}
    sure = replace(rebounds, columns=rebounds.columns | {"spin_z_in": np.zeros(len(rebounds))})
    best = fit_laws(sure, Setting(RADIUS, contact_height=height), ["two-step"], bootstrap=0, profiles=False).best
    for name, true in (("restitution", 0.72), ("friction", friction)):
        assert abs(best.estimates[name].value - true) < 2 * best.estimates[name].stderr


def test_long_hops_are_measured_and_the_cloth_with_them() -> None:
    measured = found(0.18, 1.0)
    told = films(0.18, 1.0)[1]
    assert max(t["hop"] for t in told) > 0.08
    for one, t in zip(measured.measured, told, strict=True):
        assert abs(one.fit["hop"] - t["hop"]) < 3.5 * one.fit.error("hop")
    cloth = measured.floor["floor friction"]
    assert abs(cloth.value - FLOOR) < 3 * cloth.error


def test_notes_say_what_is_known_of_hops() -> None:
    assert any(
        "the ball hops off it; the rebounds are of balls that roll again" in note for note in found(0.18, 1.0).notes
    )
    assert any("do not show whether the ball hops off it" in note for note in found(0.05, 1.0).notes)
    assert not any("hops" in note for note in found(0.18, 1.25).notes)


def test_films_measured_apart_decide_together() -> None:
    tracks = films(0.18, 1.0)[0]
    apart = [measure([track], ABOVE) for track in tracks[6:12]]
    assert {one.contacts[0].hop for one in apart} == {"seen", "possible"}
    asked = []

    def again(i: int, hops: bool) -> Measured:
        asked.append(i)
        return measure([tracks[6 + i]], replace(ABOVE, hops=hops))

    together = hops_together(apart, again)
    assert {one.contacts[0].hop for one in together} == {"seen"}
    assert asked == [i for i, one in enumerate(apart) if one.contacts[0].hop == "possible"]


def test_what_is_known_of_hops_can_be_told() -> None:
    track = films(0.05, 1.0)[0][8]
    hops, stays = (measure([track], replace(ABOVE, hops=known)).contacts[0] for known in (True, False))
    assert (hops.hop, stays.hop) == ("seen", "none")
    assert hops.fit["hop"] > 0 == stays.fit["hop"]
    assert hops.fit["vn_out"] < stays.fit["vn_out"]
    mean = averaged(stays.fit, hops.fit, 0.25)
    assert mean["vn_out"] == pytest.approx(0.75 * stays.fit["vn_out"] + 0.25 * hops.fit["vn_out"])
    spread = 0.1875 * (stays.fit["vn_out"] - hops.fit["vn_out"]) ** 2
    variance = 0.75 * stays.fit.error("vn_out") ** 2 + 0.25 * hops.fit.error("vn_out") ** 2
    assert mean.error("vn_out") ** 2 == pytest.approx(variance + spread)


@pytest.mark.parametrize(("slip", "hop"), [((0.7, -0.4), 0.06), ((0.7, -0.4), 0.0), ((0.01, 0.02), 0.09)])
def test_derivatives_of_a_hop(slip: tuple[float, float], hop: float) -> None:
    k, t = 2 / 7, np.linspace(0.005, 0.6, 31)
    start = np.array([1.1, 0.4, *slip, 2.4, 0.1, hop])

    def way(p: np.ndarray) -> np.ndarray:
        return hop_slide_roll(p[:2], p[2:4], p[6], t, p[4], p[5], k)

    slope = np.empty((len(t), 2, 7))
    for one, rows in zip(t.tolist(), slope, strict=True):
        hopped_slopes(one, *start[:4].tolist(), hop, 2.4, 0.1, k, rows)
    for j in range(7 if hop else 6):
        step = 1e-6 * np.eye(7)[j]
        np.testing.assert_allclose(slope[:, :, j], (way(start + step) - way(start - step)) / 2e-6, atol=2e-6)


def test_a_ball_that_hops_slides_half_of_the_hop_later() -> None:
    k, hop, late = 2 / 7, 0.08, np.array([0.3, 0.5])
    v, u = np.array([1.1, 0.4]), np.array([1.3, -0.4])
    e = u / np.hypot(*u)
    wanted = slide_then_roll(v, u, late - hop / 2, 2.4, 0.1, k).displacement + v * hop / 2 + e * 2.4 * hop**2 / 8
    np.testing.assert_allclose(hop_slide_roll(v, u, hop, late, 2.4, 0.1, k), wanted)
    np.testing.assert_allclose(
        hop_slide_roll(v, u, 0.0, late, 2.4, 0.1, k), slide_then_roll(v, u, late, 2.4, 0.1, k)[0]
    )
