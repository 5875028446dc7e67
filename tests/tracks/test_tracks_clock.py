"""The frame of a row, counted from its time: for every number of rows, clock, rounding, missing rows and rate."""

from __future__ import annotations

import numpy as np
import pytest

from carom.errors import CaromError
from carom.tracks import Track
from carom.tracks.preprocess import at_rate, on_camera_clock, without_rounding

CLOCKS = [
    (0.01, 5), (0.02, 5), (0.1, 5), (1.0, 5),
    *((1 / 30, decimals) for decimals in (2, 3, 4, 5)), *((1 / 119.88, decimals) for decimals in (2, 3, 4, 5)),
]  # fmt: skip


def frames(time: np.ndarray, rate: float) -> np.ndarray:
    """The frames from the first row on, as the rate gives them."""
    (found,) = at_rate([Track("ball", time, np.stack([time, time], axis=-1))], rate, "film", [])
    return (found.time - found.time[0]) * rate


@pytest.mark.parametrize(("interval", "decimals"), CLOCKS)
@pytest.mark.slow(keep=2)
def test_no_number_of_rows_makes_the_rate_ineffective(interval: float, decimals: int) -> None:
    for rows in range(40, 400):
        number = np.arange(rows)
        found = frames(np.round(number * interval, decimals), 240.0)
        np.testing.assert_allclose(found, number, atol=1e-6, err_msg=f"{rows} rows")


@pytest.mark.parametrize(("interval", "decimals"), CLOCKS)
@pytest.mark.parametrize("share", [0.01, 0.05, 0.25])
def test_missing_rows_stay_missing_at_any_rate(interval: float, decimals: int, share: float) -> None:
    rng = np.random.default_rng(int(1e6 * interval) + decimals)
    coarse = 0.5 * 10.0**-decimals / interval > 0.4  # rounded to more than a frame: which one it was is lost
    for rows, rate, start in zip(
        rng.integers(40, 400, 6),
        [240.0, 1 / interval, 30.0, 120.0, 60.0, 100.0],
        rng.choice([0, 17, 1234], 6),
        strict=True,
    ):
        number = np.flatnonzero(rng.random(rows) >= share)
        found = frames(np.round((start + number) * interval, decimals), rate)
        message = f"{rows} rows from {start} at {rate:g}"
        np.testing.assert_allclose(found, number - number[0], atol=2.01 if coarse else 1e-6, err_msg=message)


def test_rows_that_are_missing_regularly_stay_missing_at_the_rate_of_the_file() -> None:
    number = np.flatnonzero(np.arange(107) % 9 != 4)
    np.testing.assert_allclose(frames(np.round(number / 100, 5), 100.0), number, atol=1e-6)


@pytest.mark.parametrize("rate", [25.0, 50.0, 100.0, 119.88])
@pytest.mark.parametrize("every", [3, 4, 6, 10])
@pytest.mark.parametrize("decimals", [2, 3, 6])
def test_rows_that_are_missing_regularly_stay_missing_with_a_rate_and_without(
    rate: float, every: int, decimals: int
) -> None:
    """Every sixth frame of 100 a second, to 10 ms, is as even as 83.3 frames a second: the clock is that of the exact times."""
    if 10.0**-decimals * rate > 1:
        return  # (rows share a time)
    number = np.flatnonzero(np.arange(200) % every != every - 1)
    time = np.round(number / rate, decimals)
    for given in (240.0, 1000.0):
        np.testing.assert_allclose(frames(time, given), number, atol=1e-6)
    (found,), interval = on_camera_clock([Track("ball", time, np.stack([time, time], axis=-1))], [])
    assert interval == pytest.approx(1 / rate, rel=1e-3)
    np.testing.assert_allclose((found.time - found.time[0]) * rate, number, atol=0.1)


@pytest.mark.parametrize("digits", [3, 4, 5, 6])
@pytest.mark.parametrize(
    ("rate", "start", "rows"), [(120, 0.0, 278), (120, 0.4, 150), (60, 3.0, 600), (240, 0.0, 500), (30, 8.0, 300)]
)
def test_times_of_significant_digits_are_rounded_row_by_row(digits: int, rate: float, start: float, rows: int) -> None:
    """As programs write 1.0167E+00 below 8.3333E-03: each row is a frame, whatever its rounding; no row is left out."""
    number = np.arange(rows)
    exact = start + number / rate
    time = np.array([float(f"{t:.{digits - 1}E}") for t in exact])
    for kept in (number, np.flatnonzero(number % 11 != 5)):
        if 10.0 ** (np.ceil(np.log10(exact[-1])) - digits) * rate > 0.5 and len(kept) < rows:
            continue  # (rounded to more than a frame: which one is missing is lost)
        notes: list[str] = []
        (ball,) = without_rounding([Track("ball", time[kept], np.stack([exact, exact], axis=-1)[kept])], notes)
        (found,), _interval = on_camera_clock([ball], notes)
        assert len(found) == len(kept), notes
        np.testing.assert_allclose((found.time - found.time[0]) * rate, kept - kept[0], atol=0.12)
        np.testing.assert_allclose(frames(time[kept], 1.7 * rate), kept - kept[0], atol=1e-6)


def test_rows_between_the_frames_are_listed() -> None:
    time = np.sort(np.append(np.round(np.arange(90) / 120, 4), [0.2212, 0.5131]))
    notes: list[str] = []
    (found,), _interval = on_camera_clock([Track("ball", time, np.stack([time, time], axis=-1))], notes)
    assert len(found) == 90
    assert any("t = 0.2212, 0.5131 s" in note for note in notes)


def test_whole_numbers_are_frame_numbers() -> None:
    number = np.array([0.0, 2, 4, 6, 10, 12, 14, 16, 18, 20, 22, 24])
    notes: list[str] = []
    (found,) = at_rate([Track("ball", number, np.stack([number, number], axis=-1))], 120.0, "film", notes)
    np.testing.assert_allclose(found.time, number / 120, rtol=1e-12)
    assert notes == ["the times are whole numbers: taken as the numbers of frames, 120 per second"]


def test_times_on_no_clock_are_refused() -> None:
    time = np.cumsum(np.random.default_rng(4).uniform(0.004, 0.02, 80))
    with pytest.raises(CaromError, match="expected times of evenly spaced frames"):
        frames(time, 240.0)
