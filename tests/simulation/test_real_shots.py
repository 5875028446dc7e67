"""The script of real shots on made-up tracks: it finds the legs and the sidespin, and the wrong law shows."""

from __future__ import annotations

import csv
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest
from reference.commands import script

import carom

GRAIN = np.array([2.84, 1.42]) / 10018  # what the tracks are rounded to
LEFT, RIGHT = ((0.1, 1.3), (0.2, 1.3)), ((2.5, 1.3), (2.6, 1.3))


@pytest.fixture(scope="module")
def real_shots() -> ModuleType:
    return script("real_shots")


@pytest.fixture(scope="module")
def constants(real_shots: ModuleType):
    return real_shots.Constants("made up", 0.2, 0.01, 0.85, 0.15)


def shot(script: ModuleType, constants, places, velocity, spin_z: float, seconds: float):
    """A run of three balls, the first struck by the cue, without roll; smooth where balls meet."""
    scene = script.table(constants, script.WITH)
    balls = [
        carom.SceneBall(
            radius=script.RADIUS,
            mass=script.MASS,
            position=place,
            velocity=(0, 0) if i else velocity,
            spin=(0, 0, 0 if i else spin_z),
        )
        for i, place in enumerate(places)
    ]
    contact = carom.BallContact(restitution=0.95, friction=0.0)
    run = carom.Run(duration=seconds)
    return carom.simulate(
        carom.Scene(
            gravity=scene.gravity, floor=scene.floor, walls=scene.walls, balls=balls, ball_contact=contact, run=run
        )
    )


def write(script: ModuleType, file: Path, runs) -> Path:
    """As a camera sees it: frames, rows at contacts, rounded and clamped, only where a ball moves."""
    with file.open("w", newline="") as out:
        rows = csv.writer(out)
        rows.writerow(["shot", "ball", "t_s", "x_long_m", "y_short_m"])
        for name, run in runs.items():
            clock = script.FRAME * np.arange(int(run.end / script.FRAME))
            contacts = np.array([event.t for event in run.events.of("wall", "ball")])
            t = np.concatenate([clock, contacts])
            told = np.concatenate([np.floor(clock / script.CUT + 1e-9) * script.CUT, np.round(contacts, 4) + 1e-4])
            order = np.argsort(t)
            t, told = t[order], told[order]
            x = np.asarray(run.at(t).position)[:, :, :2]
            x = np.clip(np.round(x / GRAIN) * GRAIN, script.LOW, script.HIGH)
            for ball in range(3):
                step = np.hypot(*np.diff(x[:, ball], axis=0).T)
                keep = np.concatenate([[True], step > 0])
                keep[-1] = True
                for at, place in zip(told[keep], x[keep, ball], strict=True):
                    rows.writerow([name, ball + 1, f"{at:.4f}", f"{place[0]:.5f}", f"{place[1]:.5f}"])
    return file


@pytest.fixture(scope="module")
def legs(real_shots: ModuleType, constants, tmp_path_factory: pytest.TempPathFactory):
    runs = {
        "side": shot(real_shots, constants, ((0.5, 0.4), *LEFT), (2.4, 0.9), 50.0, 5.0),
        "back": shot(real_shots, constants, ((0.9, 0.9), *RIGHT), (-1.2, -1.4), -35.0, 2.5),
        "struck": shot(real_shots, constants, ((0.6, 0.7), (1.2, 0.72), (0.1, 1.3)), (3.0, 0.0), 0.0, 2.5),
    }
    file = write(real_shots, tmp_path_factory.mktemp("tracks") / "tracks.csv", runs)
    return real_shots.find_legs(real_shots.read_tracks(file), constants)


def test_legs_begin_and_end_where_balls_meet(legs) -> None:
    assert [(leg.shot, leg.ball, leg.struck) for leg in legs] == [
        ("side", "1", False), ("back", "1", False), ("struck", "2", True)
    ]  # fmt: skip
    assert all(len(leg.cushions) >= 1 for leg in legs)


def test_rows_at_contacts_are_left_out(real_shots: ModuleType, legs) -> None:
    for leg in legs:
        n = leg.t / real_shots.FRAME
        assert np.abs(n - np.round(n)).max() < 1e-6


@pytest.mark.parametrize(("number", "spin_z"), [(0, 50.0), (1, -35.0), (2, 0.0)])
def test_sidespin_and_path_come_back(real_shots: ModuleType, constants, legs, number: int, spin_z: float) -> None:
    found = real_shots.fit(legs[number].until(), constants)
    assert found.sliding
    assert found.spin_z == pytest.approx(spin_z, abs=1.0)
    assert real_shots.rms(found.distance) < 1.5 * np.hypot(*GRAIN)
    first = real_shots.first_cushion(found)
    assert first.track == pytest.approx(first.run, abs=0.01)
    if spin_z:
        assert real_shots.rms(found.plain) > 0.05
        assert np.isinf(found.passes())


@pytest.mark.slow
def test_a_wrong_law_shows(real_shots: ModuleType, constants, legs) -> None:
    right = [real_shots.rms(real_shots.fit(leg.until(), constants).distance) for leg in legs]
    for law in real_shots.LAWS[1:]:
        wrong = [real_shots.rms(real_shots.fit(leg.until(), constants, law).distance) for leg in legs]
        assert np.median(wrong) > 10 * np.median(right), law.name


def test_losses_of_the_cloth(real_shots: ModuleType, constants, legs) -> None:
    assert np.median(real_shots.sliding_loss(legs)) == pytest.approx(constants.cloth, abs=0.01)
    assert np.median(real_shots.rolling_loss(legs)) == pytest.approx(constants.rolling, rel=0.1)


def test_published_sets_are_read(real_shots: ModuleType, tmp_path: Path) -> None:
    rows = [
        ("pooltool BILLIARD", "m R u_s u_r e_c f_c", "0.210 0.03075 0.2 0.01 0.85 0.15"),
        ("tailuge 3C", "mu muS rho m R ee mu_s mu_w", "0.0055 0.126 0.045 0.23 0.03275 0.85 0.2 0.2"),
        ("Alciatore TP7.3", "e / mu / contact offset", "0.7 / 0.17 / 0.08R"),
        ("Mathavan2009", "rolling_deceleration", "0.124-0.126"),
        ("Mathavan2010", "mu_table (assumed mean)", "0.212"),
        ("Mathavan2010", "e_e (energetic; fitted v<1.5 m/s)", "0.98"),
        ("Mathavan2010", "mu_cushion (fitted)", "0.14"),
    ]
    file = tmp_path / "parameters.csv"
    with file.open("w", newline="") as out:
        csv.writer(out).writerows([("set", "quantity", "value"), *rows])
    billiard, tailuge, alciatore, mathavan = real_shots.read_constants(file)
    assert (billiard.cloth, billiard.rolling, billiard.restitution, billiard.friction) == (0.2, 0.01, 0.85, 0.15)
    assert (tailuge.cloth, tailuge.rolling) == (0.126, 0.0055)
    assert alciatore.nose == pytest.approx(1.08 * real_shots.RADIUS)
    assert mathavan.rolling == pytest.approx(0.125 / real_shots.GRAVITY)


def test_the_picture_is_drawn(real_shots: ModuleType, constants, legs, tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    fits = [real_shots.fit(leg.until(), constants) for leg in legs]
    real_shots.draw(legs, fits, constants, tmp_path / "shots.svg")
    assert (tmp_path / "shots.svg").stat().st_size > 10_000
