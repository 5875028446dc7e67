"""One film in the layouts of all programs: the places and times are the film's, and what is taken for granted is said."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from reference.film_layouts import (
    CLOCK_NAMES,
    HEIGHT,
    LAYOUTS,
    PIXEL,
    RATE,
    RESTITUTION,
    cells,
    clock_of_frames,
    film,
    pixels,
    table,
)

import carom
from carom.data import read_rebounds
from carom.errors import CaromError
from carom.tracks import Calibration, Settings, judge, measure, read_tracks
from carom.tracks.films import measure_films, measure_tracks, tracks_of_films


@pytest.mark.parametrize("name", LAYOUTS)
def test_the_film_comes_back(tmp_path: Path, name: str) -> None:
    layout, one = LAYOUTS[name], film()
    path = tmp_path / "film.txt"
    path.write_bytes(layout.write(one).encode(layout.encoding))
    found = read_tracks(path, calibration=Calibration(layout.scale, layout.rate, layout.down))
    assert len(found.tracks) == layout.tracks
    shift = np.array([300 * PIXEL, -(HEIGHT - 100) * PIXEL]) if layout.scale == PIXEL else np.zeros(2)
    for k, track in enumerate(found.tracks):
        np.testing.assert_allclose(track.time - track.time[0], one.time, atol=6e-4)
        seen = ~one.gone if layout.missing else np.ones(len(one.time), bool)
        np.testing.assert_array_equal(track.seen, seen)
        aside = [0.5 * k, 0.0] if layout.scale is None else [40 * PIXEL * k, 0.0]
        np.testing.assert_allclose(track.position[seen], one.place[seen] + shift + aside, atol=2e-5)
    assert any(layout.note in note for note in found.notes) or not layout.note


@pytest.mark.parametrize("name", CLOCK_NAMES)
def test_whole_numbers_that_rise_with_jumps_are_the_clock(tmp_path: Path, name: str) -> None:
    one, path = film(), tmp_path / "film.csv"
    kept = np.flatnonzero(np.arange(len(one.time)) % 7 != 3)
    for order in ("cxysmt", "tmxcys", "xyc"):
        path.write_text(clock_of_frames(name, order, kept)(one), encoding="utf-8")
        found = read_tracks(path, calibration=Calibration(PIXEL, RATE, down=True))
        (track,) = found.tracks
        np.testing.assert_allclose(track.time - track.time[0], one.time[kept], atol=1e-9, err_msg=order)
        assert all(any(f"'{other}'" in note for note in found.notes) for other in ("Area", "Mean") if order != "xyc")


@pytest.mark.parametrize("blocks", [True, False])
@pytest.mark.parametrize("head", ["Track n\u00b0,Slice n\u00b0,X,Y", "Ball #,Image,x,y", "id,Bild,x,y"])
def test_a_clock_of_several_balls(tmp_path: Path, head: str, blocks: bool) -> None:
    one, path = film(), tmp_path / "film.csv"
    kept = np.flatnonzero(np.arange(len(one.time)) % 7 != 3)
    rows = [(ball, k + 1, x + 40 * ball, y) for k in kept for x, y in [pixels(one)[k]] for ball in (1, 2)]
    path.write_text(table(head, list(zip(*(sorted(rows) if blocks else rows), strict=True))), encoding="utf-8")
    tracks = read_tracks(path, calibration=Calibration(PIXEL, RATE, down=True)).tracks
    assert len(tracks) == 2
    for track in tracks:
        np.testing.assert_allclose(track.time - track.time[0], one.time[kept], atol=1e-9)
    path.write_text(
        table("Slice n\u00b0,X,Y", [list(column) for column in zip(*(row[1:] for row in sorted(rows)), strict=True)]),
        encoding="utf-8",
    )
    with pytest.raises(CaromError, match="expected increasing times"):  # (no column tells the balls apart)
        read_tracks(path, calibration=Calibration(PIXEL, RATE, down=True))


def test_columns_that_rise_but_are_no_frames_are_not_counted_as_such(tmp_path: Path) -> None:
    one, path = film(), tmp_path / "film.csv"
    path.write_text(
        table("counts,x,y", [range(len(one.time)), *map(cells, one.place.T)])
    )  # no more than the rows themselves
    (track,) = read_tracks(path, calibration=Calibration(rate=RATE)).tracks
    np.testing.assert_allclose(track.time, one.time, atol=1e-12)
    kept = np.arange(len(one.time)) % 7 != 3
    for clock in (
        one.time,
        np.round(1000 * one.time),
        one.time + 0.5,
    ):  # of a unit that nobody knows: the rows are not counted
        path.write_text(table("clock,x,y", [cells(a[kept]) for a in (clock, *one.place.T)]))
        with pytest.raises(CaromError, match="'clock', which rises"):
            read_tracks(path, calibration=Calibration(rate=RATE))


@pytest.mark.parametrize(
    "written",
    [
        lambda t: f"{1617472415.25 + t:.6f}",
        lambda t: f"{1000 * (1617472415.25 + t):.3f}",
        lambda t: f"{1617472415250000 + round(1e6 * t)}",
        lambda t: f"{1617472415250000000 + round(1e9 * t)}",
        lambda t: f"2021-04-03T17:53:{35.25 + t:.6f}+00:00",
    ],
)
@pytest.mark.parametrize("rate", [None, 240.0])
def test_times_of_another_day_count_from_the_first(
    tmp_path: Path, written: Callable[[float], str], rate: float | None
) -> None:
    one, path = film(), tmp_path / "film.csv"
    path.write_text(table("timestamp,x,y", [list(map(written, one.time)), *map(cells, one.place.T)]))
    (track,) = read_tracks(path, calibration=Calibration(rate=rate)).tracks
    np.testing.assert_allclose(track.time * (rate or RATE) / RATE, one.time, atol=2e-6 if rate is None else 1e-9)


def test_a_height_alone(tmp_path: Path) -> None:
    one, path = film(), tmp_path / "film.csv"
    for head in ("t,y", "t [s],height [m]", '"Latest: Time (s)","Latest: Position (m)"', "time_s,ball_y_m"):
        path.write_text(table(head, [cells(one.time), cells(one.place[:, 1])]))
        (track,) = read_tracks(path).tracks
        np.testing.assert_allclose(track.position, one.place * [0, 1], atol=1e-6)


@pytest.mark.parametrize("head", ["x [m],Track n°,y [m]", "Track n°,x [m],y [m]"])
def test_rows_of_one_ball_are_counted_beside_its_number(tmp_path: Path, head: str) -> None:
    one = film()
    columns = {"x": cells(one.place[:, 0]), "y": cells(one.place[:, 1]), "T": ["1"] * len(one.time)}
    (tmp_path / "film.csv").write_text(table(head, [columns[name[0]] for name in head.split(",")]))
    (track,) = read_tracks(tmp_path / "film.csv", calibration=Calibration(rate=RATE)).tracks
    np.testing.assert_allclose(track.position, one.place, atol=1e-6)


def test_a_single_coordinate_from_above_is_no_height(tmp_path: Path) -> None:
    """The view that is given decides: the wall is the one that the same film with both coordinates has."""
    t, rng = np.arange(0, 1.0, 1 / 120), np.random.default_rng(3)
    x = np.where(t < 0.5, 0.9 * (0.5 - t), 0.72 * (t - 0.5)) + rng.normal(0, 2e-4, len(t))
    (tmp_path / "film.csv").write_text(table("t [s],x [px]", [cells(t), cells(1e3 * x)]))
    for view, name in (("above", "left"), ("side", None)):
        found = measure_tracks(tmp_path / "film.csv", view=view, scale=1e-3, radius=0.03, noise=2e-4)
        assert [one.wall.name for one in found.measured[0].measured] == ([name] if name else [])
        if name:
            (one,) = found.measured[0].measured
            assert one.fit["vn_out"] == pytest.approx(0.72, abs=4 * one.fit.error("vn_out"))
    films = measure_films([tmp_path / "film.csv"], Calibration(1e-3), Settings(view="above", radius=0.03))
    assert len(films.rebounds()) == 1


def test_the_restitution_of_a_film_with_marks(tmp_path: Path) -> None:
    path = tmp_path / "film.csv"
    path.write_text(LAYOUTS["minus one"].write(film()))
    found = read_tracks(path, calibration=Calibration(PIXEL, RATE, down=True))
    (contact,) = measure(found.tracks, Settings(view="side")).measured
    assert contact.fit is not None
    assert contact.fit["vn_out"] / -contact.fit["vn_in"] == pytest.approx(RESTITUTION, abs=1e-3)


@pytest.mark.parametrize(
    ("name", "content", "what", "menu"),
    [
        (
            "a.trk",
            b'<?xml version="1.0"?><object class="org.opensourcephysics.cabrillo.tracker">',
            "Tracker",
            "File > Export > Data",
        ),
        (
            "a.xml",
            b'<?xml version="1.0"?><object class="org.opensourcephysics.cabrillo.tracker">',
            "Tracker",
            "File > Export > Data",
        ),
        ("a.kva", b"\xef\xbb\xbf<?xml version='1.0'?><KinoveaVideoAnalysis>", "Kinovea", "Export to spreadsheet"),
        ("a.xml", b'<?xml version="1.0"?>\n<TrackMate version="7.6.1">', "TrackMate", "Export to CSV"),
        ("a.slp", b"\x89HDF\r\n\x1a\n\0\0", "SLEAP", "Export Analysis CSV"),
        ("a.h5", b"\x89HDF\r\n\x1a\n\0\0df_with_missing", "DeepLabCut", "analyze_videos_converth5_to_csv"),
        ("a.h5", b"\x89HDF\r\n\x1a\n\0\0", "HDF5", "as a table of text"),
        ("a.mat", b"MATLAB 5.0 MAT-file\0\0", "MATLAB", "writetable"),
        ("a.pkl", b"\x80\x04\x95", "pickle", "to_csv"),
        ("a.cmbl", b"<?xml version='1.0'?><Document>", "Logger Pro", "File > Export As > CSV"),
        ("a.xlsx", b"PK\x03\x04", "a spreadsheet", "save the sheet as CSV"),
    ],
)
def test_projects_are_refused_with_the_menu_that_exports(
    tmp_path: Path, name: str, content: bytes, what: str, menu: str
) -> None:
    path = tmp_path / name
    path.write_bytes(content)
    with pytest.raises(CaromError) as error:
        read_tracks(path)
    (fault,) = error.value.faults
    assert what in fault
    assert menu in fault


@pytest.mark.parametrize("text", ['"t","x","y"\n"0,001","1,234","2,345"\n', "t,x,y\n0,1.5,2\n1,2.2.2,3\n"])
def test_numbers_that_may_be_two_are_refused(tmp_path: Path, text: str) -> None:
    path = tmp_path / "film.csv"
    path.write_text(text.replace('"0,001"', '"1,001"'))
    with pytest.raises(CaromError, match="expected a number"):
        read_tracks(path)


def test_a_ball_that_lies_at_the_origin_is_no_missing_frame(tmp_path: Path) -> None:
    path = tmp_path / "film.csv"
    place = np.maximum(np.arange(40) - 10, 0) * 2
    path.write_text("frame,x,y\n" + "".join(f"{k},{x},{x}\n" for k, x in enumerate(place)))
    (track,) = read_tracks(path, calibration=Calibration(1.0, 100)).tracks
    assert track.seen.all()


def test_rebounds_with_the_minus_of_another_language(tmp_path: Path) -> None:
    from carom.data import read_rebounds

    path = tmp_path / "rebounds.csv"
    path.write_text("v_n_in,v_t_in,spin_in,v_n_out\n3.0,\u22121.0,0,2.4\n", encoding="utf-8")
    assert read_rebounds(path)["v_t_in"].tolist() == [-1.0]
    path.write_text('v_n_in,v_t_in,spin_in,v_n_out\n"3,0","\u20131,5","0","2,4"\n', encoding="utf-8")
    assert read_rebounds(path)["v_t_in"].tolist() == [-1.5]


def test_particles_of_trackpy_that_number_the_rows(tmp_path: Path) -> None:
    path = tmp_path / "film.csv"
    path.write_text("frame,x,y,particle\n" + "".join(f"{k},{10 + k},{20 + k},{k}\n" for k in range(30)))
    found = read_tracks(path, calibration=Calibration(1.0, 100))
    assert [len(track) for track in found.tracks] == [30]
    assert "column 'particle' numbers the rows: not taken for names of shots or balls" in found.notes


def test_one_ball_among_many_false_finds_keeps_its_name(tmp_path: Path) -> None:
    path = tmp_path / "film.csv"
    rows = [f"{k},{10 + k},{20 + k},0\n{k},5,{k},{k + 1}\n" for k in range(60)]
    path.write_text("frame,x,y,particle\n" + "".join(rows))
    found = read_tracks(path, calibration=Calibration(1.0, 100))
    assert max(len(track) for track in found.tracks) == 60


@pytest.mark.parametrize("mark", ["-1", "0"])
def test_marks_of_missing_frames_in_files_of_programs(tmp_path: Path, mark: str) -> None:
    path = tmp_path / "film.txt"
    rows = [(f"{k}", mark, mark) if k % 7 == 3 else (f"{k}", f"{300 + 2 * k}", f"{200 + k}") for k in range(60)]
    path.write_text("Frame\tX1\tY1\tFlag1\n" + "".join("\t".join(row) + "\t \n" for row in rows))
    found = read_tracks(path, calibration=Calibration(0.001, 100))
    assert (~found.tracks[0].seen).sum() == 9
    assert f"object 1: {mark}, {mark} in 9 frames: taken as missing" in found.notes


def test_tracks_of_kinovea_begin_where_the_times_begin_anew(tmp_path: Path) -> None:
    path = tmp_path / "film.txt"
    rows = "".join(f"{k / 50:.2f} {k} {2 * k}\n" for k in range(20))
    path.write_text(f"#Kinovea Trajectory data export\n#T X Y\n{rows}{rows}")
    found = read_tracks(path, calibration=Calibration(0.01))
    assert [(track.name, len(track)) for track in found.tracks] == [("track 1", 20), ("track 2", 20)]


def test_columns_that_are_not_used_are_named_by_every_reader(tmp_path: Path) -> None:
    one, path = film(), tmp_path / "film.csv"
    path.write_text(table("t,x,y,humidity", [cells(a) for a in (one.time, *one.place.T, one.time)]))
    tracker, rows = tmp_path / "tracker.txt", tmp_path / "rows.csv"
    tracker.write_text(table(["mass A,,,", "t,x,y,humidity"], [cells(a) for a in (one.time, *one.place.T, one.time)]))
    rows.write_text("v_n_in,v_t_in,v_n_out,v_t_out,spin_in,humidity\n1,0.5,0.8,0.4,0,40\n")
    said = [
        read_tracks(path).notes, read_tracks(tracker).notes, measure_tracks(path, view="side").notes,
        judge(path, radius=0.02).notes, read_rebounds(rows).notes, carom.predict(rows, law="no-slip").notes,
        measure_films([path], settings=Settings(view="side")).rebounds().notes, tracks_of_films(path)[1],
    ]  # fmt: skip
    for notes in said:
        assert any("humidity" in note for note in notes), notes
