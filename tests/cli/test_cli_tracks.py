"""``carom tracks show``: what people see, what programs get, what is written, and what happens where it cannot be."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from reference.synthetic_tracks import Camera, bounce, seen, shot

from carom.cli import main
from carom.data import read_rebounds

HERE = Path(__file__).parents[1] / "tracks" / "files"


@pytest.fixture(scope="module")
def shot_file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    rng = np.random.default_rng(43)
    track = seen(shot(rng), Camera(60, 4e-4), rng)
    file = tmp_path_factory.mktemp("tracks") / "shot.csv"
    rows = np.column_stack([track.time, 1e3 * track.position])
    np.savetxt(file, rows, fmt="%.6f", delimiter=",", header="t [s],x [mm],y [mm]", comments="")
    return file


def run(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, *words: str) -> tuple[int, str, str]:
    monkeypatch.setattr("sys.argv", ["carom", "tracks", "show", *words])
    with pytest.raises(SystemExit) as end:
        main()
    told = capsys.readouterr()
    return int(end.value.code or 0), told.out, told.err


def test_what_people_see(
    shot_file: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    out, picture = tmp_path / "rebounds.csv", tmp_path / "shot.png"
    code, told, notes = run(
        capsys, monkeypatch, str(shot_file), "--out", str(out), "--plot", str(picture), "--stage", "both"
    )
    assert code == 0
    for word in (
        "named columns",
        "60 frames per second",
        "cloth friction",
        "bottom",
        "right",
        "2 contacts, 2 measured",
    ):
        assert word in told
    assert "taken as filmed from above" in notes
    assert notes.splitlines()[-3:] == ["3 rebounds in the table", f"written: {out}", f"written: {picture}"]
    table = read_rebounds(out)
    assert table.kind == "table"
    assert set(table.extra["wall"]) == {"bottom", "right"}
    assert picture.stat().st_size > 20_000


def test_what_programs_get(
    shot_file: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    code, told, _notes = run(capsys, monkeypatch, str(shot_file), "--json", "--cloth", "0.2", "--noise", "0.4mm")
    assert code == 0
    facts = json.loads(told)
    assert facts["format"] == "columns"
    assert facts["noise"] == 4e-4
    assert facts["noise_given"] is True
    assert facts["frame_interval"] == pytest.approx(1 / 60, abs=1e-6)
    assert [one["name"] for one in facts["walls"]] == ["right", "bottom"]
    contact = facts["contacts"][0]
    values = dict(zip(contact["fit"]["names"], contact["fit"]["values"], strict=True))
    assert values["mu_g"] == pytest.approx(0.2 * 9.80665, rel=1e-3)
    assert len(contact["fit"]["covariance"]) == len(values)
    assert contact["stages"] == ["after_wall"]


def test_a_bounce_from_the_side(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    rng = np.random.default_rng(2)
    track = seen(bounce(rng), Camera(120, 4e-4), rng, (0, 2))
    file, picture = tmp_path / "bounce.txt", tmp_path / "bounce.svg"
    np.savetxt(
        file, np.column_stack([track.time, track.position]), fmt="%.6E", delimiter="\t", header="mass A\t\t\nt\tx\ty\t",
        comments="",
    )  # fmt: skip
    code, told, notes = run(capsys, monkeypatch, str(file), "--plot", str(picture))
    assert code == 0
    assert "Tracker (Open Source Physics)" in told
    assert "gravity" in told
    assert "taken as filmed from the side" in notes
    assert picture.read_text().count("<path") > 50


def test_walls_that_are_given(
    shot_file: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    code, told, _notes = run(
        capsys, monkeypatch, str(shot_file), "--wall", "y=0.031", "--wall", "2.8095,0,2.8095,1", "--json"
    )
    assert code == 0
    walls = json.loads(told)["walls"]
    assert [one["normal"] for one in walls] == [[0.0, 1.0], [-1.0, 0.0]]
    assert not any(one["found"] for one in walls)


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        ((str(HERE / "trackpy.csv"),), ["expected the scale", "expected the frame rate"]),
        (("--scale", "big", "--view", "below", "--inertia", "soft", str(HERE / "trackpy.csv")),
         ["--scale: expected a length", "--inertia", "--view: expected one of above, side"]),
        ((str(HERE / "columns.csv"),), ["expected the balls' radius"]),
        ((str(HERE / "tracker_single.txt"), "--wall", "here"), ["--wall: expected x=0.03"]),
        ((str(HERE / "tracker_single.txt"), "--plot", "picture.gif"), ["expected a name that ends with"]),
        ((str(HERE / "tracker_single.txt"), "--wall", "x=nan"), ["--wall: expected x=0.03"]),
        ((str(HERE / "tracker_single.txt"), "--inertia", "5"), ["--inertia: expected solid"]),
        ((str(HERE / "trackpy.csv"), "--out", "none/rebounds.json"), ["--out none/rebounds.json: expected a name that ends"]),
        ((str(HERE / "trackpy.csv"), "--out", "none/rebounds.csv"), ["--out none/rebounds.csv: expected a folder that exists"]),
        ((str(HERE / "trackpy.csv"), "--out", str(HERE / "trackpy.csv")), ["expected another file than the one that is read"]),
        (("nowhere.csv",), ["No such file"]),
    ],
)  # fmt: skip
def test_faults_are_told(
    words: tuple[str, ...], expected: list[str], capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    code, told, notes = run(capsys, monkeypatch, *words)
    assert (code, told) == (2, "")
    assert len(notes.strip().splitlines()) == len(expected)
    for line, word in zip(notes.splitlines(), expected, strict=True):
        assert word in line


def test_nothing_to_measure_writes_nothing(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    file, out = tmp_path / "straight.csv", tmp_path / "out.csv"
    file.write_text("t,x,y\n" + "".join(f"{k / 50},{0.02 * k},{0.01 * k}\n" for k in range(40)))
    code, _told, notes = run(capsys, monkeypatch, str(file), "--out", str(out))
    assert code == 2
    assert "expected a contact with a wall, got none" in notes
    assert not out.exists()


def test_options_that_do_not_fit_the_file_are_told(
    shot_file: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    code, told, notes = run(capsys, monkeypatch, str(shot_file), "--wall", "x=99", "--rate", "100", "--scale", "2mm")
    assert code == 0
    assert "wall x=99: no ball reaches it" in notes
    assert "the file's times say 60 frames per second; --rate 100 overrides them" in notes
    assert "100 frames per second" in told
    assert "--scale overrules the unit in" in notes
    assert "cloth friction" not in told  # nothing was measured: the literature's is no finding
    _code, _told, notes = run(capsys, monkeypatch, str(shot_file), "--view", "side")
    assert "is the scale (--scale)" in notes


@pytest.mark.parametrize(
    ("rows", "expected"),
    [
        ([(k, 1e3 if k >= 20 else 1.0) for k in range(40)], "the ball jumps once, by up to"),
        ([(k, 1e3 if k % 2 else 1.0) for k in range(40)], "alternate from row to row"),
        ([(k, 0.0) for k in range(40)], "does not move"),
        ([(k, 1.0) for k in range(5)], "5 positions: too few for a contact"),
    ],
)
def test_what_looks_like_another_unit_or_ball_is_told(
    rows: list[tuple[int, float]], expected: str, tmp_path: Path, capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:  # fmt: skip
    file = tmp_path / "odd.csv"
    file.write_text(
        "t,x,y\n" + "".join(f"{k / 50},{(0.5 + 0.02 * k) * unit},{(0.2 + 0.01 * k) * unit}\n" for k, unit in rows)
    )
    code, _told, notes = run(capsys, monkeypatch, str(file))
    assert code == 0
    assert expected in notes


def test_no_line_of_a_contact_runs_through_a_legend(shot_file: Path) -> None:
    from carom.plot.tracks import plot_tracks
    from carom.tracks import Settings, measure, read_tracks

    figure = plot_tracks(measure(read_tracks(str(shot_file)).tracks, Settings(view="above")))
    figure.canvas.draw()
    panels = [axes for axes in figure.axes if axes.get_title(loc="left").startswith(("Speed", "Residuals"))]
    assert len(panels) == 2
    for axes in panels:
        low = axes.get_legend().get_window_extent().y0
        upright = [line for line in axes.lines if len(line.get_xdata()) == 2 and len(set(line.get_xdata())) == 1]
        assert upright
        assert all(line.get_window_extent().y1 < low for line in upright)
