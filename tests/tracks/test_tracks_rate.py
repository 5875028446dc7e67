"""A frame rate that is given overrides the times of a file: rounded, slow-motion, with gaps, or right."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from carom.errors import CaromError
from carom.tracks import Calibration, Settings, Track, TrackFile, measure, read_tracks
from carom.tracks.films import measure_films
from carom.tracks.preprocess import at_rate, even_interval, on_camera_clock, rounding_of_times, without_rounding

RATE = 119.88


def bouncing(t: np.ndarray, restitution: float = 0.8) -> np.ndarray:
    """Where a ball dropped from 1 m is at times t, s: x along, y up."""
    y, begin, up, height = np.zeros_like(t), -np.sqrt(2 / 9.80665), np.sqrt(2 * 9.80665), 1.0
    while height > 1e-3:
        since = t - begin
        y = np.where((since >= 0) & (since < 2 * up / 9.80665), up * since - 9.80665 / 2 * since**2, y)
        begin += 2 * up / 9.80665
        up *= restitution
        height *= restitution**2
    return np.stack([0.1 * t, y], axis=-1)


@pytest.fixture(scope="module")
def film(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """What Tracker writes with three significant digits: 69 of 539 rows share their time with the row before."""
    t = np.arange(539) / RATE
    place = bouncing(t) + np.random.default_rng(1).normal(0, 5e-4, (len(t), 2))
    file = tmp_path_factory.mktemp("tracks") / "film.txt"
    rows = "".join(f"{time:.2E}\t{x:.6f}\t{y:.6f}\n" for time, (x, y) in zip(t, place, strict=True))
    file.write_text(f"mass_A\nt\tx\ty\n{rows}")
    return file


def speeds(found: TrackFile) -> list[float]:
    contacts = measure(found.tracks, Settings(view="side")).contacts
    return [-one.fit["vn_in"] for one in contacts if one.fit is not None]


@pytest.mark.parametrize("gaps", [False, True])
@pytest.mark.parametrize(("rate", "decimals"), [(15, 2), (29.97, 2), (60, 2), (60, 3), (240, 3), (300, 4)])
def test_rounded_times_are_on_the_camera_s_clock(rate: float, decimals: int, gaps: bool) -> None:
    t = 0.3 + np.arange(200) / rate
    if gaps:
        t = t[np.random.default_rng(1).random(200) > 0.1]
    (found,), interval = on_camera_clock([Track("ball", np.round(t, decimals), np.stack([t, t], axis=-1))], [])
    assert interval == pytest.approx(1 / rate, rel=3e-4)
    np.testing.assert_allclose(found.time, t, atol=0.5 * 10.0**-decimals)
    assert len(found) == len(t)


def test_rounded_times_give_way_to_the_rate(film: Path) -> None:
    found = read_tracks(film, calibration=Calibration(rate=RATE))
    (track,) = found.tracks
    np.testing.assert_allclose(track.time, np.arange(539) / RATE, atol=2e-4)
    np.testing.assert_allclose(np.diff(track.time), 1 / RATE, rtol=1e-9)
    assert any("rounded to 10 ms; `rate` 119.88 replaces them" in note for note in found.notes)
    # the hardest bounce is among them
    assert max(speeds(found)) == pytest.approx(np.sqrt(2 * 9.80665), rel=2e-3)


def test_rounded_times_are_evened_out_without_a_rate(film: Path) -> None:
    found = read_tracks(film)
    (track,) = found.tracks
    assert len(track) == 539
    assert 1 / np.diff(track.time).mean() == pytest.approx(RATE, rel=2e-4)
    assert any("rows share one: taken as successive frames" in note for note in found.notes)
    assert max(speeds(found)) == pytest.approx(np.sqrt(2 * 9.80665), rel=3e-3)


@pytest.mark.parametrize("rate", [120.0, 240.0, 30.0])
def test_the_rate_wins_where_the_times_say_another(film: Path, rate: float) -> None:
    found = read_tracks(film, calibration=Calibration(rate=rate))
    np.testing.assert_allclose(np.diff(found.tracks[0].time), 1 / rate, rtol=1e-9)
    assert any(
        f"the file's times say 119.88 frames per second; `rate` {rate:g} overrides" in one for one in found.notes
    )


def ball(time: np.ndarray, frame: np.ndarray | None = None, name: str = "ball") -> Track:
    return Track(name, time, np.stack([time, time], axis=-1), frame=frame)


def test_exact_times_at_their_own_rate_stay() -> None:
    notes: list[str] = []
    time = 3.0 + np.arange(200) / 60
    (same,) = at_rate([ball(time)], 60.0, "film", notes)
    np.testing.assert_allclose(same.time, time, rtol=1e-12)
    assert notes == []


@pytest.mark.parametrize("decimals", [2, 3, 6])
def test_missing_frames_stay_missing(decimals: int) -> None:
    rng = np.random.default_rng(2)
    number = np.flatnonzero(rng.random(600) < 0.8)
    number = number[(number < 250) | (number > 330)]
    (found,) = at_rate([ball(np.round(number / 120, decimals))], 120.0, "film", [])
    assert len(found) == len(number)
    # times rounded to 10 ms do not say which frame of 8.3 ms it is, but to one
    assert np.abs(np.round(found.time * 120) - number).max() <= (1 if decimals == 2 else 0)


def test_frame_numbers_are_the_clock_where_the_file_has_them() -> None:
    notes: list[str] = []
    frame = np.array([10.0, 12.0, 14.0, 20.0])
    (found,) = at_rate([ball(frame / 30, frame)], 240.0, "film", notes)
    np.testing.assert_allclose(np.diff(found.time), np.diff(frame) / 240, rtol=1e-12)
    assert notes == [
        "the file's times say 30 frames per second; `rate` 240 overrides them (leave it out if they are right)"
    ]


def test_balls_of_one_film_stay_in_step() -> None:
    time = np.round(np.arange(300) / RATE, 2)
    one, other = at_rate([ball(time), ball(time[40:], name="other")], RATE, "film", [])
    assert abs((other.time[0] - one.time[40]) * RATE) < 1.01  # to the frame that rounding hides
    one, other = without_rounding([ball(time), ball(time[40:], name="other")], [])
    assert np.unique(np.round(np.diff(np.union1d(one.time, other.time)), 9)).size == 1


def test_times_on_no_clock_are_refused_with_a_rate() -> None:
    time = np.cumsum(np.random.default_rng(3).uniform(0.01, 0.05, 60))
    with pytest.raises(
        CaromError, match=r"film: `rate`: expected times of evenly spaced frames, or none, got times on no"
    ):
        at_rate([ball(time)], 30.0, "film", [])


def test_times_that_repeat_for_another_reason_are_left_alone() -> None:
    time = np.repeat(np.arange(40) / 50, 2)  # two rows for each frame
    (same,) = without_rounding([ball(time)], [])
    np.testing.assert_array_equal(same.time, time)


def test_rounding() -> None:
    assert set(rounding_of_times(np.arange(40) / 30)) == {1e-7}
    time = np.array([float(f"{t:.2E}") for t in np.arange(400) / 100.7])
    step = rounding_of_times(time)
    assert step[time > 1.1].max() == pytest.approx(0.01)
    assert step[(time > 0.2) & (time < 0.9)].max() == pytest.approx(1e-3)


def test_columns_with_times_and_frames(tmp_path: Path) -> None:
    file = tmp_path / "slow.csv"
    file.write_text("frame,t [s],x [m],y [m]\n" + "".join(f"{k},{k / 30:.4f},{k / 100},0\n" for k in range(40)))
    found = read_tracks(file, calibration=Calibration(rate=300.0))
    np.testing.assert_allclose(np.diff(found.tracks[0].time), 1 / 300, rtol=1e-9)
    assert any("say 30 frames per second; `rate` 300 overrides" in note for note in found.notes)


def test_carom_fit_takes_the_rate_as_well(film: Path) -> None:
    rows = measure_films([film], Calibration(rate=RATE), Settings(radius=0.02, view="side")).rebounds()
    assert rows["v_n_in"].max() == pytest.approx(np.sqrt(2 * 9.80665), rel=2e-3)
    assert any("`rate` 119.88 replaces them" in note for note in rows.notes)


def test_one_row_and_rows_of_one_frame_have_no_interval() -> None:
    assert even_interval(np.array([0.3]), np.zeros(1)) is None
    assert even_interval(np.array([0.3, 0.4]), np.zeros(2), np.array([7.0, 7.0])) is None
