"""Tracks as the programs write them: recognised, read in SI, what is missing asked for by name, every fault told."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from carom.errors import CaromError
from carom.tracks import Calibration
from carom.tracks.read import FORMATS, TrackFile, read_tracks

HERE = Path(__file__).parent / "files"
PIXELS = Calibration(scale=1 / 2000, rate=120)
IMAGES = ("trackpy.csv", "deeplabcut.csv", "deeplabcut_multi.csv", "trackmate.csv", "mtrack2.txt", "idtracker.txt")
CENTIMETRES = Calibration(scale=0.01)


def way(k: np.ndarray) -> np.ndarray:
    """The places that all the example files hold, by frame."""
    t = k / 120
    before = np.stack([0.30 - 1.2 * t, 0.10 + 0.5 * t], axis=-1)
    after = np.stack([0.9 * (t - 0.25), 0.225 + 0.45 * (t - 0.25)], axis=-1)
    return np.where((t < 0.25)[:, None], before, after)


def put(folder: Path, text: str | bytes, name: str = "track.csv") -> Path:
    file = folder / name
    file.write_bytes(text if isinstance(text, bytes) else text.encode())
    return file


def faults(path: Path, given: Calibration | None = None, **options: str) -> tuple[str, ...]:
    with pytest.raises(CaromError) as error:
        read_tracks(path, calibration=given, **options)
    return error.value.faults


@pytest.mark.parametrize(
    ("name", "format_", "given", "tracks"),
    [
        ("tracker_single.txt", "tracker", None, ["ball A"]),
        ("tracker_single_comma.txt", "tracker", None, ["ball A"]),
        ("tracker_single_spaces.txt", "tracker", None, ["ballA"]),
        ("tracker_multi.csv", "tracker", None, ["A", "B"]),
        ("kinovea_2026.csv", "kinovea", CENTIMETRES, ["Ball", "Mark"]),
        ("kinovea_trajectory.txt", "kinovea", CENTIMETRES, ["Ball", "Mark"]),
        ("trackpy.csv", "trackpy", PIXELS, ["particle 0", "particle 1"]),
        ("deeplabcut.csv", "deeplabcut", PIXELS, ["ball", "mark"]),
        ("deeplabcut_multi.csv", "deeplabcut", PIXELS, ["white centre", "red centre"]),
        ("trackmate.csv", "trackmate", None, ["track 0", "track 1"]),
        ("mtrack2.txt", "mtrack2", PIXELS, ["object 1", "object 2"]),
        ("idtracker.txt", "idtracker", PIXELS, ["1", "2"]),
        ("columns.csv", "columns", None, ["white", "red"]),
    ],
)
def test_every_program(name: str, format_: str, given: Calibration | None, tracks: list[str]) -> None:
    found = read_tracks(HERE / name, calibration=given)
    assert found.format == format_
    assert [track.name for track in found.tracks] == tracks
    first = found.tracks[0]
    frames = np.round(first.time * 120) - (1 if name == "mtrack2.txt" else 0)  # (its frames count from 1)
    np.testing.assert_allclose(first.time - first.time[0], (frames - frames[0]) / 120, atol=1e-6)
    assert len(first) == 60
    expected = way(frames)
    if name in IMAGES:  # pictures count from their upper edge
        expected = expected - [0, 0.45]
    missing = ~first.seen
    assert missing.sum() == (1 if name in ("tracker_multi.csv", "deeplabcut.csv") else 0)
    np.testing.assert_allclose(first.position[~missing], expected[~missing], atol=2e-6)


def test_trackmate_in_pixels_and_without_units(tmp_path: Path) -> None:
    text = (HERE / "trackmate.csv").read_text()
    first, _names, _short, _units, *rows = text.splitlines()
    spots = put(tmp_path, "\n".join([first, *rows]))  # as older versions write them
    assert ["`scale`" in one or "`rate`" in one for one in faults(spots)] == [True, True]
    (one, _other) = read_tracks(spots, calibration=Calibration(scale=1e-6, rate=120)).tracks
    np.testing.assert_allclose(one.position, way(np.arange(60)) - [0, 0.45], atol=2e-6)
    pixels = put(tmp_path, text.replace("(micron)", "(pixel)"), "pixels.csv")
    (fault,) = faults(pixels)
    assert "TrackMate: expected the scale, since its positions are in pixels" in fault
    found = read_tracks(HERE / "trackmate.csv")
    assert "2 spots that belong to no track were left out" in found.notes


def test_more_than_75_objects_of_mtrack2(tmp_path: Path) -> None:
    text = "Tracks 1 to 1\nFrame\tX1\tY1\tFlag1\n1\t10\t20\t \n2\t11\t21\t*\nTracks 2 to 2\nFrame\tX2\tY2\tFlag2\n1\t5\t6\t \n"
    one, other = read_tracks(put(tmp_path, text, "more.txt"), calibration=Calibration(1.0, 10)).tracks
    assert (one.name, other.name) == ("object 1", "object 2")
    assert one.position.tolist() == [[10, -20], [11, -21]]
    assert other.position.tolist() == [[5, -6]]


def test_idtracker_ai_has_times(tmp_path: Path) -> None:
    file = put(tmp_path, "time,x1,y1,x2,y2\n0.0,10,20,1,2\n0.02,11,21,1,\n")
    one, other = read_tracks(file, calibration=Calibration(scale=0.001)).tracks
    assert one.time.tolist() == [0, 0.02]
    assert other.seen.tolist() == [True, False]


@pytest.mark.parametrize("index", ["labeled-data/film/img0012.png", "labeled-data,film,img0012.png"])
def test_labels_of_single_images_are_refused_by_name(tmp_path: Path, index: str) -> None:
    more = "," * index.count(",")
    text = f"scorer{more},net,net\nbodyparts{more},ball,ball\ncoords{more},x,y\n{index},10,20\n"
    (fault,) = faults(put(tmp_path, text, "machinelabels.csv"), PIXELS)
    assert "got labels of single images ('labeled-data" in fault
    assert "machinelabels" in fault


def test_carom_table() -> None:
    found = read_tracks(HERE / "pathtracking_carom.json")
    assert found.format == "carom-table"
    ball, other = found.tracks
    assert (ball.name, len(ball), len(other)) == ("ball 1", 30, 1)
    np.testing.assert_allclose(ball.time, np.arange(30) / 50.2, atol=3e-4)
    np.testing.assert_allclose(ball.position, way(np.round(np.arange(30) / 50.2 * 120)), atol=2e-4)
    assert other.position[0].tolist() == [1.42, 0.71]


def test_carom_table_that_counts_from_the_start(tmp_path: Path) -> None:
    told = json.loads((HERE / "pathtracking_carom.json").read_text())
    coords = told["PathTracking"]["DataSets"][0]["Coords"]
    for row, tick in zip(coords, np.cumsum([row["DeltaT_500us"] for row in coords]).tolist(), strict=True):
        row["DeltaT_500us"] = tick
    ball = read_tracks(put(tmp_path, json.dumps(told), "game.json")).tracks[0]
    np.testing.assert_allclose(ball.time, np.arange(30) / 50.2, atol=3e-4)


def test_own_layout_of_the_carom_shots(tmp_path: Path) -> None:
    text = "shot,ball,t_s,x_long_m,y_short_m\nshot_00,1,0.0000,2.13540,0.52725\nshot_00,2,0.0000,1.1,0.5\nshot_01,1,0.0195,2,0.5\n"
    found = read_tracks(put(tmp_path, text))
    assert [(track.group, track.name) for track in found.tracks] == [
        ("shot_00", "1"),
        ("shot_00", "2"),
        ("shot_01", "1"),
    ]
    assert found.tracks[0].position[0].tolist() == [2.1354, 0.52725]


@pytest.mark.parametrize("change", ["bom", "crlf", "utf-16", "trailing"])
def test_spreadsheets(tmp_path: Path, change: str) -> None:
    text = "t [s],x [mm],y [mm]\n0,0,10\n0.1,,20\n0.2,200,30\n"
    raw = {
        "bom": b"\xef\xbb\xbf" + text.encode(),
        "crlf": text.replace("\n", "\r\n").encode(),
        "utf-16": text.encode("utf-16"),
        "trailing": text.replace("\n", ",\n").encode() + b"\n\n,,,\n",
    }[change]
    (track,) = read_tracks(put(tmp_path, raw)).tracks
    np.testing.assert_array_equal(track.position, [[0, 0.01], [np.nan, 0.02], [0.2, 0.03]])


def test_decimal_commas(tmp_path: Path) -> None:
    (track,) = read_tracks(put(tmp_path, "t;x [cm];y [cm]\n0,5;1,25;2\n0,6;1,5;3\n")).tracks
    assert track.time.tolist() == [0.5, 0.6]
    assert track.position.tolist() == [[0.0125, 0.02], [0.015, 0.03]]


def test_what_is_missing_is_asked_for() -> None:
    for name in ("trackpy.csv", "deeplabcut.csv", "mtrack2.txt", "idtracker.txt"):
        found = faults(HERE / name)
        assert len(found) == 2
        assert "`scale`" in found[0]
        assert "`rate`" in found[1]
    assert "`scale`" in faults(HERE / "kinovea_2026.csv")[0]
    (fault,) = faults(HERE / "trackpy.csv", Calibration(scale=0.001))
    assert "`rate`" in fault


def test_a_guess_can_be_overruled() -> None:
    found = read_tracks(HERE / "trackpy.csv", "columns", Calibration(scale=1 / 2000, rate=120, down=True))
    assert found.format == "columns"
    assert "expected the frame rate" in faults(HERE / "trackpy.csv", format="columns")[0]
    assert "did you mean 'tracker'" in faults(HERE / "tracker_multi.csv", format="traker")[0]
    assert set(FORMATS) == {
        "tracker", "kinovea", "deeplabcut", "carom-table", "trackpy", "trackmate", "mtrack2", "idtracker", "sleap", "columns",
        "tailuge", "pooltool",
    }  # fmt: skip


def test_up_and_down(tmp_path: Path) -> None:
    file = put(tmp_path, "frame,x [px],y [px]\n0,10,20\n1,11,30\n")
    assert read_tracks(file, calibration=Calibration(0.001, 10)).tracks[0].position[:, 1].tolist() == [-0.02, -0.03]
    assert read_tracks(file, calibration=Calibration(0.001, 10, down=False)).tracks[0].position[:, 1].tolist() == [
        0.02,
        0.03,
    ]


def test_angle_and_spin(tmp_path: Path) -> None:
    (track,) = read_tracks(put(tmp_path, "t,x,y,angle_deg,spin [rpm]\n0,0,0,180,60\n1,1,1,90,\n")).tracks
    assert track.angle is not None
    assert track.spin is not None
    np.testing.assert_allclose(track.angle, [np.pi, np.pi / 2])
    np.testing.assert_allclose(track.spin, [2 * np.pi, np.nan])


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("", "empty file"),
        (
            "hello\nworld\n",
            "got a file that begins 'hello'; a table can always be read if its header is like 't [s],x [cm],y",
        ),
        (
            "when,sideways,up\n0,1,2\n",
            "got the columns when, sideways, up; a table can always be read if its header is like",
        ),
        ("t,x [furlong],y [mm]\n0,1,2\n", "'x [furlong]': expected a unit"),
        ("t,x,y\n0,1 mm,2\n", "got '1 mm' at line 2; write units in the header"),
        ("t,x,y\n0,0,0\n0.2,1,1\n0.1,2,2\n", "expected increasing times, got 0.1 s after 0.2 s, at its row 3"),
        ("t,x,y\n,,\n", "expected positions of a ball, got none"),
        (
            "x,y\n0,0\n",
            "expected a column t (as in 't [s]') or frame, got columns x, y; `rate` 60 counts the rows as frames",
        ),
    ],
)
def test_faults(tmp_path: Path, text: str, expected: str) -> None:
    assert any(expected in fault for fault in faults(put(tmp_path, text)))


def test_all_faults_at_once(tmp_path: Path) -> None:
    found = faults(put(tmp_path, "t,x,y\n0,a,1\n1,b,2\nc,1,1\n"))
    assert len(found) == 2
    assert "'a' at line 2 (2 in all)" in found[0]
    assert "'c' at line 4" in found[1]


def test_odd_units_and_doubled_times_are_said(tmp_path: Path) -> None:
    found = read_tracks(put(tmp_path, "t,x,y\n0,0,0\n8,1200,3\n8,1201,3\n16,2400,5\n"))
    said = " ".join(found.notes)
    assert "is the unit right?" in said
    assert "one frame every 8 s" in said
    assert "the first is used" in said
    assert found.tracks[0].position[1].tolist() == [1200, 3]


@pytest.mark.parametrize(
    "header",
    [
        "t [s];x [cm];y [cm]", "time (s);x_cm;y_cm", "t/s;x/cm;y/cm", "t in s;x in cm;y in cm", "Time, sec;X, cm;Y, cm",
        "Zeit (s);Position x (cm);Höhe (cm)", "Temps [s];distance [cm];hauteur [cm]", "time;pos_x/centimetres;height / cm",
        "height [mm];t/s;x/cm;y/cm;distance [furlong]",
    ],
)  # fmt: skip
def test_usual_names_and_units(tmp_path: Path, header: str) -> None:
    before = "7;" if header.startswith("height") else ""
    rows = "".join(f"{before}{k / 10};{k};{100 - k}\n" for k in range(4))
    (track,) = read_tracks(put(tmp_path, f"{header}\n{rows}")).tracks
    np.testing.assert_allclose(track.time, np.arange(4) / 10)
    np.testing.assert_allclose(track.position, np.stack([np.arange(4), 100 - np.arange(4)], axis=-1) / 100)


def test_a_column_of_trials(tmp_path: Path) -> None:
    file = put(tmp_path, "Versuch;Zeit (s);X (cm);Y (cm)\n1;0;1;2\n1;0,1;2;4\n2;0;1;2\n2;0,1;3;4\n")
    assert [(track.group, len(track)) for track in read_tracks(file).tracks] == [("1", 2), ("2", 2)]


def test_tracker_with_units_in_its_header(tmp_path: Path) -> None:
    text = "mass A\t\t\nt (ms)\tx (cm)\ty (cm)\n0\t1\t2\n100\t2\t4\n"
    found = read_tracks(put(tmp_path, text, "film.txt"))
    assert found.format == "tracker"
    assert not any("assumed to be m" in note for note in found.notes)
    np.testing.assert_allclose(found.tracks[0].time, [0.0, 0.1])
    np.testing.assert_allclose(found.tracks[0].position, [[0.01, 0.02], [0.02, 0.04]])
    (fault,) = faults(put(tmp_path, text.replace("y (cm)", "y (ell)"), "film.txt"))
    assert "column y: expected a unit, one of m, cm, mm, in, got 'ell'" in fault


@pytest.mark.parametrize("header", ["frame,x/px,y/px", "frame,x in pixels,y in pixels", "frame,x [px],y (pixel)"])
def test_pixels(tmp_path: Path, header: str) -> None:
    file = put(tmp_path, f"{header}\n0,1,2\n1,2,4\n")
    (track,) = read_tracks(file, calibration=Calibration(scale=0.01, rate=10)).tracks
    np.testing.assert_allclose(track.position, [[0.01, -0.02], [0.02, -0.04]])


def test_rows_without_times_are_the_frames_of_a_camera(tmp_path: Path) -> None:
    track = read_tracks(put(tmp_path, "x,y\n0,0\n1,2\n2,4\n"), calibration=Calibration(rate=120)).tracks[0]
    np.testing.assert_array_equal(track.time, np.arange(3) / 120)
    with pytest.raises(CaromError, match="expected a column t"):  # (of several balls: which row is which frame?)
        read_tracks(put(tmp_path, "ball,x,y\na,0,0\nb,1,2\n"), calibration=Calibration(rate=120))


def test_a_film_in_centimetres_is_asked_about(tmp_path: Path) -> None:
    rows = "".join(f"{k / 60},{200 * k / 60},{100}\n" for k in range(20))
    for scale, asked in ((None, True), (0.01, False)):
        said = " ".join(read_tracks(put(tmp_path, f"t,x,y\n{rows}"), calibration=Calibration(scale=scale)).notes)
        assert ("the ball moves at 200 m/s: is the unit right? `scale` 1mm (or 1cm" in said) is asked


def test_not_a_file(tmp_path: Path) -> None:
    assert "a folder" in faults(tmp_path)[0]
    assert "No such file" in faults(tmp_path / "none.csv")[0]
    assert "got a picture (PNG)" in faults(put(tmp_path, b"\x89PNG\0\0\0\0"))[0]
    assert "binary" in faults(put(tmp_path, b"\x01PNG\0\0\0\0"))[0]


def test_many_rows(tmp_path: Path) -> None:
    n = 200_000
    rows = np.stack([np.arange(n) / 1000, np.sin(np.arange(n) / 100), np.cos(np.arange(n) / 100)], axis=-1)
    file = tmp_path / "long.csv"
    np.savetxt(file, rows, fmt="%.6f", delimiter=",", header="t,x,y", comments="")
    found: TrackFile = read_tracks(file)
    np.testing.assert_array_equal(found.tracks[0].position, np.round(rows[:, 1:], 6))


def test_pixels_of_tracker_count_downwards(tmp_path: Path) -> None:
    text = (HERE / "tracker_single.txt").read_text().replace("\tx\ty", "\tpixelx\tpixely")
    (track,) = read_tracks(put(tmp_path, text, "pixels.txt"), calibration=Calibration(scale=1e-3)).tracks
    (up,) = read_tracks(put(tmp_path, text, "pixels.txt"), calibration=Calibration(scale=1e-3, down=False)).tracks
    (metres,) = read_tracks(HERE / "tracker_single.txt").tracks
    np.testing.assert_allclose(track.position, 1e-3 * metres.position * [1, -1], rtol=1e-12)
    np.testing.assert_allclose(up.position, 1e-3 * metres.position, rtol=1e-12)


def test_commas_within_numbers_and_between_them_are_refused(tmp_path: Path) -> None:
    """Most rows were taken for one instant, and the film for one from above without a contact."""
    rows = [f"0,{83 * k:04d},10,187,{99 - k},710" for k in range(8)]
    (said,) = faults(put(tmp_path, "\n".join(["t,x,y", *rows])), CENTIMETRES)
    assert said.endswith(
        "line 2: expected 3 cells, as the header has, got 6, and as many in most lines; write decimal points,"
        " or semicolons between numbers"
    )
    spare = put(tmp_path, "t,x,y\n" + "\n".join(f"{k / 100},{k},{2 * k}," for k in range(8)))
    assert len(read_tracks(spare).tracks[0]) == 8  # (empty cells at the end are none)


def test_a_scale_by_gravity_is_for_films(tmp_path: Path) -> None:
    path = put(tmp_path, "t,x,y\n" + "\n".join(f"{k / 100},{k},{2 * k}" for k in range(8)))
    (said,) = faults(path, Calibration(film={"scale": "gravity"}))
    assert "`scale`: expected the length of a unit of its positions" in said
