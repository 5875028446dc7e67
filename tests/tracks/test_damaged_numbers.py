"""What only damaged files have: tiny intervals, places beyond all lengths, units of thousands of letters, brackets without end."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import carom
from carom.core.units import parse_quantity
from carom.errors import CaromError
from carom.tracks import judge, read_tracks
from carom.tracks.contact import shared_fraction
from carom.tracks.formats.missing import without_marked_places
from carom.tracks.preprocess import file_interval
from carom.tracks.track import Track


def test_a_tiny_step_of_time_does_not_make_a_clock():
    time = np.round(np.arange(40) / 120, 8)
    time[1] = 1e-320  # one damaged cell: clocks with intervals of 1e-320 s were tried, for hours
    assert file_interval(time, 120.0) in (None, pytest.approx(1 / 120, rel=1e-3))


def test_a_row_of_another_age_does_not_make_a_clock():
    time = np.round(np.arange(80) / 120, 5)
    time[58] = 1e23
    assert file_interval(time, 120.0) in (None, pytest.approx(1 / 120, rel=1e-3))


@pytest.mark.filterwarnings("error")
def test_a_height_that_is_infinite_is_refused_in_one_line(tmp_path):
    rows = "".join(f"{k / 120:.5f}\t{0.1 + 0.5 * k / 120 - 4.9 * (k / 120) ** 2:.5f}\n" for k in range(30))
    (tmp_path / "a.csv").write_text("t\ty\n" + rows.replace("0.10000", "inf", 1))
    with pytest.raises(CaromError):
        judge(tmp_path / "a.csv")


def test_a_fit_without_an_error_has_the_prior_s_fraction():
    assert shared_fraction(0.0, 1.0, 0.0) == 0.0
    assert shared_fraction(0.1, 0.2, 0.0) == pytest.approx(1.0)


def test_places_beyond_all_lengths_are_left_to_their_check():
    place = np.full((5, 2), 1e308)
    assert without_marked_places(Track("a", np.arange(5.0), place), 1e-3).position.tolist() == place.tolist()


def test_a_long_unit_is_refused_at_once():
    with pytest.raises(ValueError, match="is not a known unit"):
        parse_quantity("30" + 50_000 * "A", "m")


@pytest.mark.parametrize(
    "read", [read_tracks, judge, carom.load_scene, carom.fit, carom.data.read_rebounds, carom.billiards.table]
)
@pytest.mark.parametrize(
    ("name", "begin", "end"),
    [
        ("a.json", "[", "]"), ("a.json", '{"a":', "}"), ("a.json", "[", ""), ("a.csv", "[", "]"), ("a.toml", "a = [", "]"),
        ("a.toml", "[[a]]\nb = [", "]"), ("a.toml", "a.", "a = 1"), ("a.toml", "a = {b = ", "}"),
    ],
)  # fmt: skip
@pytest.mark.slow(keep=24)
def test_nested_brackets_are_refused_at_once(
    tmp_path: Path, read: Callable[[Path], object], name: str, begin: str, end: str
) -> None:
    """The time grew as the square of their number: minutes, or an error of Python's own."""
    file = tmp_path / name
    head, deep = begin[:-1], begin[-1]
    text = head + deep * 200_000 + end * 200_000 if deep in "[" else begin * 200_000 + "1" + end * 200_000
    file.write_text(text)
    with pytest.raises(CaromError) as error:
        read(file)
    assert "Recursion" not in str(error.value)


@pytest.mark.parametrize("text", ['{"PathTracking":', '[{"balls":{"a":{"t":', '{"balls": 1, "ball_history_cts": '])
def test_programs_files_with_nested_brackets(tmp_path: Path, text: str) -> None:
    file = tmp_path / "a.json"
    file.write_text(text + "[" * 200_000)
    for read in (read_tracks, judge):
        with pytest.raises(CaromError, match=r"nested too deep|expected a track"):
            read(file)


@pytest.mark.parametrize("head", ["frame,x,y", "a,x,y,b\n", "X1\tY1\tFlag1\r", "ball,t [s],x [m],y [m]"])
def test_headings_without_rows_are_refused(tmp_path: Path, head: str) -> None:
    (tmp_path / "a.csv").write_text(head, newline="")
    for read in (read_tracks, judge, carom.fit):
        with pytest.raises(CaromError) as error:
            read(tmp_path / "a.csv")
        assert error.value.__cause__ is None or isinstance(error.value.__cause__, CaromError)
