"""What free flights say of a film from the side: the drag of the air, and a camera that was not level."""

from __future__ import annotations

import math
import re
from pathlib import Path

import numpy as np
import pytest
from reference.commands import command
from reference.thrown_ball import film, thrown

from carom.fitting.shared_errors import shared_errors
from carom.tracks import Measured, Settings, Track, measure, to_rebounds
from carom.tracks.events import wall_through
from carom.tracks.flights import fit_flight, flight_path

GRAVITY = 9.81
TENNIS, TABLE_TENNIS = 0.0195, 0.126  # 1/m: half of 1.2 kg/m^3, drag coefficient and area, by the mass


def dropped(drag: float, restitution: float, height: float = 1.5, rate: float = 120.0, seed: int = 2) -> Track:
    """A ball that falls and bounces straight up in air, in closed form (tanh as it falls, tan as it rises)."""
    t, y = np.arange(0, 2.4, 1 / rate), np.zeros(0)
    end = (1 / (drag * GRAVITY)) ** 0.5  # of the speed, over gravity
    length, begin, rises = 1 / drag, 0.0, 0.0
    while begin < t[-1]:
        top = begin + rises
        falls = end * float(np.arccosh(np.exp(height / length)))
        part = t[(t >= begin) & (t < top + falls)] - top
        way = np.where(part < 0, np.log(np.cos(np.minimum(part, 0) / end)), -np.log(np.cosh(part / end)))
        y = np.concatenate([y, height + length * way])
        up = restitution * GRAVITY * end * float(np.tanh(falls / end))
        begin, rises = top + falls, end * float(np.arctan(up / (GRAVITY * end)))
        height = length / 2 * float(np.log1p((up / (GRAVITY * end)) ** 2))
    place = np.stack([np.full(len(t), 0.3), y], axis=-1)
    return Track("ball", t, place + np.random.default_rng(seed).normal(0, 5e-4, place.shape))


def turned(track: Track, degrees: float) -> Track:
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    return Track(track.name, track.time, track.position @ np.array([[c, s], [-s, c]]))


def restitutions(found: Measured) -> tuple[np.ndarray, np.ndarray]:
    fits = [one.fit for one in found.measured]
    each = np.array([fit["vn_out"] / -fit["vn_in"] for fit in fits if fit is not None])
    error = np.array(
        [fit["vn_out"] / -fit["vn_in"] * np.hypot(fit.error("vn_in") / fit["vn_in"], fit.error("vn_out") / fit["vn_out"])
         for fit in fits if fit is not None]
    )  # fmt: skip
    return each, error


def test_a_path_with_drag() -> None:
    s = np.linspace(0, 0.4, 9)
    end = (GRAVITY / TABLE_TENNIS) ** 0.5
    path = flight_path(np.zeros(2), np.array([0.0, -GRAVITY]), TABLE_TENNIS, s)
    assert path[:, 1] == pytest.approx(-(end**2) / GRAVITY * np.log(np.cosh(GRAVITY * s / end)), abs=1e-7)
    still = flight_path(np.array([1.0, 2.0]), np.array([0.0, -GRAVITY]), 0.0, -s)
    assert still == pytest.approx(np.stack([-s, -2 * s - GRAVITY / 2 * s**2], axis=-1), abs=1e-12)


@pytest.mark.parametrize(("drag", "restitution"), [(TENNIS, 0.75), (TABLE_TENNIS, 0.9)])
@pytest.mark.slow
def test_drag_is_found_and_the_restitution_right(drag: float, restitution: float) -> None:
    track = dropped(drag, restitution)
    found = measure([track], Settings(view="side"))
    value, error = found.floor["air drag"]
    assert abs(value - drag) < 4 * error < 0.2 * drag
    (note,) = [note for note in found.notes if "drag" in note]
    assert note.startswith(f"air drag: at the speed v the air slows the ball down by k v^2, k = {value:.3g} ± ")
    each, errors = restitutions(found)
    assert len(each) >= 3
    assert (np.abs(each - restitution) < 4 * errors).all()
    assert errors[:3].max() < 2e-3
    known = measure([track], Settings(view="side", drag_per_metre=drag))
    assert (np.abs(restitutions(known)[0] - restitution) < 4 * restitutions(known)[1]).all()
    ignored = measure([track], Settings(view="side", drag_per_metre=0.0))
    assert restitutions(ignored)[0][0] < restitution - 0.01
    assert "drag" not in " ".join((*known.notes, *ignored.notes))


def test_rows_of_a_film_share_the_errors_of_the_drag_and_of_the_camera() -> None:
    table = to_rebounds(measure([dropped(TENNIS, 0.75)], Settings(view="side")))
    names = ("v_n_in", "v_t_in", "spin_in", "v_n_out", "v_t_out", "spin_out")
    shared, roll = shared_errors(table, names, 0.0)
    assert (shared.name, roll.name) == ("air drag", "camera roll")
    assert (shared.rows[:, 0] * shared.rows[:, 3] < 0).all()  # more drag: it came slower, and leaves faster
    assert (np.abs(shared.rows[:, 0]) < table.sigma["v_n_in"]).all()
    # the floor turns with the camera: v_t gains what is then no v_n
    angle = roll.rows[:, 4] / -table["v_n_out"]
    assert angle == pytest.approx(angle[0])
    assert angle[0] > 1e-4
    assert roll.rows[:, 1] == pytest.approx(angle * table["v_n_in"], rel=1e-3)
    assert roll.rows[:, 3] == pytest.approx(angle * table["v_t_out"], abs=1e-6)


def test_a_given_floor_stands_however_the_camera_was_rolled() -> None:
    track = turned(film(thrown(1.5, 1.2), rate=120), 0.15)
    floor = wall_through("floor", (0.0, 0.02), (1.0, 0.02), [track])
    found, given = (measure([track], Settings(view="side", walls=walls)) for walls in (None, (floor,)))
    assert ["roll" in one.fit.shifts for one in (found.measured[0], given.measured[0]) if one.fit] == [True, False]
    # too little to turn the floor, and yet part of the velocities
    before = [one.fit["vt_in"] for one in (found.measured[0], given.measured[0]) if one.fit]
    assert before[0] != pytest.approx(before[1], abs=1e-3)
    assert found.walls[0].normal == (0.0, 1.0)


@pytest.mark.parametrize("speed", [0.0, 1.0, 2.5])
def test_still_air_and_a_level_camera_are_left_alone(speed: float) -> None:
    found = measure([film(thrown(speed, 1.2), rate=120)], Settings(view="side"))
    assert "air drag" not in found.floor
    assert not [note for note in found.notes if "slows the ball down by" in note or "rolled" in note]
    assert found.walls[0].normal == (0.0, 1.0)


@pytest.mark.parametrize("angle", [-5.0, -1.0, 2.0])
def test_a_rolled_camera_is_found_and_the_floor_turned(angle: float) -> None:
    found = measure([turned(film(thrown(1.5, 1.2), rate=120), angle)], Settings(view="side"))
    each, errors = restitutions(found)
    assert len(each) == 3
    assert (np.abs(each - 0.78) < 4 * errors).all()
    (note,) = [note for note in found.notes if "rolled" in note]
    said = float(note.split("points ")[1].split(" ±")[0])
    assert said == pytest.approx(abs(angle), abs=0.1)
    assert f"to the {'right' if angle > 0 else 'left'} of straight down" in note
    assert "`wall`" in note


def test_a_board_that_leans_is_no_rolled_camera() -> None:
    """Gravity is upright in the picture; the wall that is given is not."""
    t, hit, n = np.arange(0, 0.75, 1 / 240), 0.35, np.array([np.sin(0.2), np.cos(0.2)])
    before = np.array([0.0, -GRAVITY * hit])
    after = before - 1.8 * (before @ n) * n
    s = (t - hit)[:, None]
    x = np.where(s < 0, before, after) * s + np.array([0.0, -GRAVITY / 2]) * s**2
    track = Track("ball", t, x + np.random.default_rng(3).normal(0, 3e-4, x.shape))
    wall = wall_through("board", (0.0, 0.0), (n[1], -n[0]), [track])
    found = measure([track], Settings(view="side", walls=(wall,)))
    assert "rolled" not in " ".join(found.notes)
    each, errors = restitutions(found)
    assert abs(each[0] - 0.8) < 4 * errors[0] < 0.01


def test_what_the_command_says(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    track = turned(film(thrown(1.5, 1.2), rate=120), 3.0)
    file = tmp_path / "rolled.csv"
    np.savetxt(
        file, np.column_stack([track.time, track.position]), delimiter=",", header="t,x,y", comments="", fmt="%.6f"
    )
    code, out, err = command(capsys, "tracks", "show", str(file), "--drag-per-metre", "0")
    assert code == 0
    assert "3 contacts, 3 measured" in out
    assert re.search(r"wall bottom +through \(", out)
    assert re.search(r"\b(2.9\d|3|3.0\d)° from the x axis", out)
    assert re.search(r"the camera is rolled: gravity points (2.9|3.0)\d ± 0.0\d° to the right of straight down", err)


def test_bounces_on_stairs_are_counted() -> None:
    """Four steps, each 0.15 m below the one before; the lowest is the floor that is found."""
    t, up, hits, y, x = np.arange(0, 1.85, 1 / 120), 0.0, 0.0, np.zeros(0), 0.05
    steps = [0.0225 - 0.15 * i for i in range(4)]
    height = 0.3
    for level in [*steps, steps[-1]]:
        down = float(np.sqrt(up**2 + 2 * GRAVITY * (height - level)))
        end = hits + (up + down) / GRAVITY
        s = t[(t >= hits) & (t < end)] - hits
        y = np.concatenate([y, height + up * s - GRAVITY / 2 * s**2])
        height, up, hits = level, 0.7 * down, end
    t = t[: len(y)]
    place = np.stack([x + 0.55 * t, y], axis=-1)
    track = Track("ball", t, place + np.random.default_rng(1).normal(0, 5e-4, place.shape))
    found = measure([track], Settings(view="side"))
    (note,) = [note for note in found.notes if "away from the wall" in note]
    assert note.startswith("3 bounces away from the wall, at (x, y) = (0.1")
    assert "`wall` y=0.1" in note
    named = [wall_through(f"step {i}", (0.0, level), (1.0, level), [track]) for i, level in enumerate(steps)]
    for some, rest in ((named[1:2], "3 bounces away"), (named[:1], "3 bounces away"), (named, "")):
        found = measure([track], Settings(view="side", walls=tuple(some)))
        assert rest in " ".join(found.notes)
        assert ("away" in " ".join(found.notes)) is bool(rest)
        each, errors = restitutions(found)
        assert len(each) == len(found.contacts) == len(some)
        assert (np.abs(each - 0.7) < 4 * errors).all()
        assert errors.max() < 0.01


@pytest.mark.parametrize("height", [0.982, 1.1316])
def test_a_contact_between_two_frames_is_no_bounce_elsewhere(height: float) -> None:
    """The first contact is at frame 26.4 (28.4): the lowest frame is nearly a whole step above the floor, and the next as high; the
    second is at a frame, which shows where the floor is."""
    t, fall = np.arange(0, 1.5, 1 / 60), float(np.sqrt(2 * (height - 0.033) / GRAVITY))
    y = height - GRAVITY / 2 * t**2
    for hit, up in ((fall, 0.75 * GRAVITY * fall), (2.5 * fall, 0.75**2 * GRAVITY * fall)):
        y = np.where(t >= hit, 0.033 + up * (t - hit) - GRAVITY / 2 * (t - hit) ** 2, y)
    place = np.stack([0.3 + t, y], axis=-1) + np.random.default_rng(1).normal(0, 5e-4, (len(t), 2))
    found = measure([Track("ball", t, place)], Settings(radius=0.033, view="side"))
    assert not [note for note in found.notes if "away from the wall" in note]
    assert len(found.measured) == 2


def test_frames_of_heights_alone_have_as_many_degrees_of_freedom_as_they_scatter_by() -> None:
    random, time, noise = np.random.default_rng(3), np.arange(12) / 120.0, 2e-4
    found = []
    for near in random.uniform(0.045, 0.055, 150):
        s = time - near
        height = np.where(s < 0, -2.0, 1.6) * s - 9.80665 * s**2 / 2 + noise * random.normal(size=len(time))
        places = np.stack([height, np.zeros_like(height)], axis=1)
        fit = fit_flight(time, places, near, noise, np.array([-9.80665, 0.0]), 0.5, 0.0)
        found.append((fit.chi2, fit.dof))
    chi2, dof = np.array(found).sum(axis=0)
    assert chi2 == pytest.approx(dof, abs=3 * math.sqrt(2 * dof))
