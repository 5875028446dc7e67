"""Damaged track files are refused with one line, or read where what is left suffices."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from carom.errors import CaromError
from carom.tracks import Calibration, Settings, Track, measure, read_tracks

HERE = Path(__file__).parent / "files"
GIVEN = Calibration(scale=1e-3, rate=100)
HEAD = "#multi:\n,A,,,,,B,,,,,\nt,frame,x,y,pixelx,pixely,frame,x,y,pixelx,pixely,\n"


@pytest.mark.parametrize(
    ("raw", "expected"),
    [
        ("t,x,y\n0,1,2\n".encode("utf-16") + b"\n", "expected text in UTF-16, as its first two bytes say, got truncated data"),
        ("t,x,y\n0,1,2\n".encode("utf-16")[:-3] + b"\xd8", "expected text in UTF-16"),
        (b"t,x,y\n0,1," + b"A" * 200_000, "line 2: expected cells between commas, got: field larger than field limit (131072)"),
        (b't,x,y\n0,"1,2\n3,4,5\n', "line 3: expected cells between commas, got: unexpected end of data; is a quote missing?"),
        (b"#multi:\n,A,,,,,B,,,,,\nt,frpixely,\n0,1,2,3\n1,2,3,4\n", "track 'A': expected columns x and y, got frpixely"),
        (b"#multi:\n,,\nt,x,y\n0,1,2\n1,2,3\n", "Tracker: expected a column t, got 0, 1, 2"),
        (b"scorer,a,a\nbodyparts,ball\ncoords,x,y\n0,1,2\n", "DeepLabCut: ball: expected columns of x and y, got a ball x only"),
        (b"a figure within +- 0.069., or none\n1,2\n", "got the columns a figure"),
        (b"scorer,a,a\n", "expected rows bodyparts and coords under scorer, got scorer"),
        (b"t,x,y\n0,1,2\n1,1e308,2\n", "expected numbers of at most 1e+100 in size, got 1e+308 at line 3"),
        (b"t,x,y\n0,1,2\n1,inf,2\n", "expected numbers of at most 1e+100 in size, got inf at line 3"),
        (b"t,x,y\n0,1,2\n1,1e30,2\n", "ball: position: expected at most 1e+09 m, got 1e+27 m (1 in all)"),
        (b'{"PathTracking":{"DataSets":[{"Coords":[{"DeltaT_500us":0,"X":1e308,"Y":0.9}]}],"TableHeight":1,"TableWidth":9999}}',
         "DataSets[0]: X: expected numbers of at most 1e+100"),
        (b'{"PathTracking":{"DataSets":[5],"TableHeight":1,"TableWidth":2}}', "DataSets[0]: expected Coords"),
        (b'{"PathTracking":' + b"[" * 100_000, "brackets nested too deep to read"),
    ],
)  # fmt: skip
def test_refused(raw: bytes, expected: str, tmp_path: Path) -> None:
    file = tmp_path / "case"
    file.write_bytes(raw)
    with pytest.raises(CaromError) as error:
        read_tracks(file, calibration=GIVEN)
    assert any(expected in fault for fault in error.value.faults), error.value.faults
    assert all("\n" not in fault and len(fault) < 400 for fault in error.value.faults)


def test_lone_carriage_returns_end_lines(tmp_path: Path) -> None:
    text = (HERE / "pathtracking_carom.json").read_text()
    file = tmp_path / "game.json"
    file.write_text(text.replace('"X":', '"X":\r'), newline="")
    np.testing.assert_array_equal(
        read_tracks(file).tracks[0].position, read_tracks(HERE / "pathtracking_carom.json").tracks[0].position
    )
    (tmp_path / "old.csv").write_bytes(b"t,x,y\r0,1,2\r1,2,3\r")
    assert read_tracks(tmp_path / "old.csv").tracks[0].time.tolist() == [0, 1]


@pytest.mark.parametrize("given", [None, Calibration(rate=120)])
def test_times_closer_than_any_camera_takes_frames(tmp_path: Path, given: Calibration | None) -> None:
    file = tmp_path / "track.csv"
    file.write_text(HEAD + "0.0,300,0.1,0.2,5,6,300,0.4,0.2,20,10\n1e-320,,,,,,302,0.41,0.2,203,100.5\n")
    found = read_tracks(file, calibration=given)
    measured = measure(found.tracks, Settings(radius=0.0))
    assert not measured.contacts


def test_steps_that_vanish_do_not_break_the_search_for_contacts() -> None:
    t = np.array([0.0, 1e-320, 2e-320, 3e-320, 0.1, 0.2])
    measured = measure([Track("ball", t, np.stack([np.abs(t - 0.1), t], axis=-1))], Settings(view="above", noise=1e-4))
    assert all(one.fit is None for one in measured.contacts)


def test_control_characters_of_a_file_do_not_reach_the_terminal(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    from carom.cli import main

    file = tmp_path / "case.csv"
    file.write_text("scorer,a,a\nbodyparts,ball,ball\ncoords,x,\x1b[31my\n0,1,2\n")
    monkeypatch.setattr("sys.argv", ["carom", "tracks", "show", str(file), "--scale", "1mm", "--rate", "50"])
    with pytest.raises(SystemExit):
        main()
    said = capsys.readouterr().err
    assert "\x1b" not in said
    assert r"\x1b[31my" in said


def test_a_resting_ball_with_one_wrong_row_leaves_no_residuals() -> None:
    t = np.arange(60) / 120
    place = np.tile([8e-4, 2e-4], (60, 1))
    place[29, 1] = 1e-12
    measured = measure([Track("ball", t, place)], Settings(view="above"))
    assert 0 < measured.noise < 1e-6
    assert not [one for one in measured.contacts if one.fit is not None and not one.why_not("after_wall")]
