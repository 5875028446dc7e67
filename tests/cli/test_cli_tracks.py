"""``carom tracks show``: what people see, what programs get, what is written, and what happens where it cannot be."""

from __future__ import annotations

import csv
import json
import math
from pathlib import Path

import numpy as np
import pytest
from reference.synthetic_tracks import Camera, bounce, seen, shot

from carom.cli import main
from carom.cli.tracks import grouped_reasons
from carom.data import read_rebounds
from carom.tracks import Settings
from carom.tracks.films import measure_films

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
        "floor friction",
        "bottom",
        "right",
        "2 contacts, 2 measured",
    ):
        assert word in told
    assert "assumed to be filmed from above" in notes
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
    assert "assumed to be filmed from the side" in notes
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
         ["--inertia", "--view: expected one of above, side", "--scale: expected a length"]),
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
    assert "--scale overrides the unit in" in notes
    assert "floor friction" not in told  # nothing was measured: the literature's is no finding
    _code, _told, notes = run(capsys, monkeypatch, str(shot_file), "--view", "side")
    assert "is the scale (--scale)" in notes


@pytest.mark.parametrize(
    ("rows", "expected"),
    [
        ([(k, 1e3 if k >= 20 else 1.0) for k in range(40)], "the ball jumps once, by up to 984 m, first at t = 0.4 s"),
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


def films(folder: Path) -> list[Path]:
    """Two films of a ball that bounces, seen from the side, and one without a contact."""
    files = []
    for seed in (2, 5):
        rng = np.random.default_rng(seed)
        track = seen(bounce(rng), Camera(120, 4e-4), rng, (0, 2))
        files.append(folder / f"film{seed}.csv")
        rows = np.column_stack([track.time, track.position])
        np.savetxt(files[-1], rows, fmt="%.6f", delimiter=",", header="t [s],x [m],y [m]", comments="")
    files.append(folder / "straight.csv")
    files[-1].write_text("t,x,y\n" + "".join(f"{k / 50},{0.02 * k},{0.01 * k}\n" for k in range(40)))
    return files


def test_many_films_make_one_table(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    files, out = films(tmp_path), tmp_path / "rebounds.csv"
    names = list(map(str, files))
    words = (
        "--out",
        str(out),
        "--view",
        "side",
        "--drag-per-metre",
        "0",
    )  # (else films that are read together share the drag)
    code, told, notes = run(capsys, monkeypatch, *names, *words)
    assert code == 0
    table = read_rebounds(out)
    assert set(table.extra["film"]) == {"film2", "film5"}
    alone = []
    for file in files[:2]:
        run(capsys, monkeypatch, str(file), *words)
        alone.append(read_rebounds(out))
    np.testing.assert_array_equal(table["v_n_out"], np.concatenate([one["v_n_out"] for one in alone]))
    np.testing.assert_array_equal(table["sigma_v_n_in"], np.concatenate([one["sigma_v_n_in"] for one in alone]))
    named = [line.split()[0] for line in told.partition("Velocities")[0].splitlines() if "positions," in line]
    assert named == ["film2", "film5", "straight"]
    assert "filmed from  the side" in told  # (which they have in common is said once)
    assert told.count("the side") == 1
    assert "straight: no wall found" in notes
    code, told, _notes = run(capsys, monkeypatch, *names, "--json", "--view", "side")
    assert [Path(film["file"]).name for film in json.loads(told)["films"]] == ["film2.csv", "film5.csv", "straight.csv"]


def test_a_note_of_many_films_stands_once(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    first, second, straight = map(str, films(tmp_path))
    overridden = "the file's times say 120 frames per second; --rate 60 overrides them (leave it out if they are right)"
    _code, _told, notes = run(capsys, monkeypatch, first, "--rate", "60")
    assert notes.splitlines()[0] == overridden
    _code, _told, notes = run(capsys, monkeypatch, first, second, "--rate", "60")
    assert notes.splitlines()[0] == f"all 2 films: {overridden}"
    _code, _told, notes = run(capsys, monkeypatch, first, second, straight, "--rate", "60")
    assert notes.count(overridden) == 1
    assert f"film2, film5: {overridden}" in notes.splitlines()
    assert notes.count("straight: no unit in") == 1
    assert "straight: no contact measured" in notes.splitlines()
    assert all(note.split(":")[0] in ("film2, film5", "film2", "film5", "straight") for note in notes.splitlines())


def test_faults_of_many_films(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    first, second, straight = map(str, films(tmp_path))
    code, _told, notes = run(capsys, monkeypatch, first, second, "--plot", str(tmp_path / "a.svg"))
    assert (code, notes) == (2, "carom: --plot: expected one film, got 2; name one file\n")
    code, _told, notes = run(capsys, monkeypatch, first, "none.csv", str(HERE / "trackpy.csv"))
    assert code == 2
    assert [("none.csv" in line, "trackpy.csv" in line) for line in notes.splitlines()] == [
        (True, False),
        (False, True),
        (False, True),
    ]
    out = tmp_path / "out.csv"
    code, _told, notes = run(capsys, monkeypatch, straight, straight, "--out", str(out))
    assert code == 2
    assert "expected a contact with a wall, got none" in notes
    assert not out.exists()


def test_reasons_that_differ_in_numbers_are_one() -> None:
    whys = [f"{k} frames between the start of the track and the wall, expected 4 or more" for k in (0, 3, 2)]
    whys += [
        f"the frames scatter by {x} mm about flight, {y} times as much as elsewhere"
        for x, y in ((1.2, 3.5), (40, 90.1))
    ]
    assert grouped_reasons([*whys, "no frames"]) == [
        (3, "0 to 3 frames between the start of the track and the wall, expected 4 or more"),
        (2, "the frames scatter by 1.2 to 40 mm about flight, 3.5 to 90.1 times as much as elsewhere"),
        (1, "no frames"),
    ]


def test_a_film_of_many_short_tracks_has_few_reasons(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    rows = []
    for number in range(60):  # too short on one side or the other
        before, after = 1 + number % 3, 3 + number % 7
        rows += [f"{number},ball {number % 5},{(k + before) / 50},{0.03 * abs(k) + 0.001},{0.5 + 0.01 * k}\n"
                 for k in range(-before, after)]  # fmt: skip
    file = tmp_path / "many.csv"
    file.write_text("shot,ball,t [s],x [m],y [m]\n" + "".join(rows))
    code, told, _notes = run(capsys, monkeypatch, str(file), "--view", "above")
    assert code == 0
    reasons = told.splitlines()[
        told.splitlines().index(next(x for x in told.splitlines() if "not measured:" in x)) + 1 :
    ]
    assert 1 <= len(reasons) <= 4
    assert sum(int(line.split("×")[0]) for line in reasons) >= 40


def test_no_number_is_cut_off_without_noise(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    t = np.arange(60) / 100
    y = np.where(t < 0.3, 2 * (0.3 - t), 1.6 * (t - 0.3)) - 9.80665 / 2 * (t - 0.3) ** 2
    file = tmp_path / "exact.csv"
    rows = zip(t.tolist(), (0.5 * t).tolist(), y.tolist(), strict=True)
    file.write_text(
        "ball,t [s],x [m],y [m]\n" + "".join(f"a ball with a long name,{a!r},{b!r},{c!r}\n" for a, b, c in rows)
    )
    # (the only ball is named in its row of the summary; beside its contacts too where there is room)
    for width, row in (
        ("120", "a ball with a long name bottom 0.3000 2.000000(0)"),
        ("80", "\nbottom 0.3000 2.000000(0)"),
    ):
        monkeypatch.setenv("COLUMNS", width)
        code, told, _notes = run(capsys, monkeypatch, str(file), "--view", "side", "--noise", "1e-12")
        assert code == 0
        assert "…" not in told
        assert "a ball with a long name  60 positions" in told
        assert row in told
        assert "1.600000(0)" in told
        assert "0.800000(0)" in told


def test_carom_fit_reads_many_films(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    files = films(tmp_path)
    table = measure_films(files, settings=Settings(radius=0.02, view="side")).rebounds()
    assert set(table.extra["film"]) == {"film2", "film5"}
    assert "1 of 3 films have no contact that can be measured" in table.notes
    assert any(note.startswith("straight: no wall found") for note in table.notes)
    rebounds = table.save(tmp_path / "rebounds.csv")
    for words, expected in (
        ((str(rebounds), str(files[0])), "rebounds.csv: expected a track, as several files are given"),
        ((str(files[0]), "none.csv"), "none.csv: expected a file, got none"),
        ((str(files[0]), str(rebounds), "--whole"), "rebounds.csv: expected a track with --whole, got a table"),
    ):
        monkeypatch.setattr("sys.argv", ["carom", "fit", *words, "--radius", "0.02"])
        with pytest.raises(SystemExit):
            main()
        assert expected in capsys.readouterr().err


def test_example_films_are_there_to_try(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = tmp_path / "films"
    for code, said in (
        (0, f"written: {folder}/shot01.txt to shot16.txt"),
        (2, "expected no file of that name, got one"),
    ):
        monkeypatch.setattr("sys.argv", ["carom", "tracks", "example", str(folder)])
        with pytest.raises(SystemExit) as end:
            main()
        assert (end.value.code or 0) == code
        assert said in capsys.readouterr().err
    assert len(list(folder.iterdir())) == 16
    shown = run(capsys, monkeypatch, str(folder / "shot12.txt"), "--radius", "28.6mm", "--json")
    (contact,) = json.loads(shown[1])["contacts"]
    assert contact["t"] == pytest.approx(0.2956, abs=1e-3)


def test_a_length_may_have_a_unit_on_every_command(
    shot_file: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    for words in (
        ("compare", "--laws", "maw,no-slip", "--speed", "150cm/s", "--spin-z", "60rpm"),
        ("tracks", "show", str(shot_file)),
    ):
        said = []
        for radius in ("28.6mm", "0.0286"):
            monkeypatch.setattr("sys.argv", ["carom", *words, "--radius", radius])
            with pytest.raises(SystemExit):
                main()
            said.append(capsys.readouterr())
        assert said[0] == said[1]
        monkeypatch.setattr("sys.argv", ["carom", *words, "--radius", "28.6kg"])
        with pytest.raises(SystemExit):
            main()
        assert "--radius: expected a length, such as" in (err := capsys.readouterr().err)
        assert "got '28.6kg'" in err


def test_what_is_said_of_a_film_in_centimetres_that_ends_early(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """One frame after the second bounce."""
    g, t = 981.0, np.arange(140) / 120
    first = np.sqrt(2 * 80 / g)
    second = first + 2 * 300 / g
    y = np.select(
        [t < first, t < second],
        [80 - g / 2 * t**2, 300 * (t - first) - g / 2 * (t - first) ** 2],
        240 * (t - second) - g / 2 * (t - second) ** 2,
    )
    t, y = t[: np.searchsorted(t, second) + 2], 2 + y
    rows = [f"{a:.6f},{10 + 30 * a:.4f},{b:.4f}" for a, b in zip(t, y, strict=False)]
    (tmp_path / "film.csv").write_text("\n".join(["t,x,y", *rows]), encoding="utf-8")
    code, told, notes = run(capsys, monkeypatch, str(tmp_path / "film.csv"), "--scale", "1cm", "--radius", "2cm")
    assert code == 0
    assert "1 frame between the wall and the end of the track" in told
    assert "no unit in 't': assumed to be s\n" in notes


def test_a_table_of_rebounds_is_said_as_one(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("bounces.csv").write_text("v_n_in,v_t_in,v_n_out,v_t_out,spin_in\n1,1,0.8,1,0\n")
    code, out, err = run(capsys, monkeypatch, "bounces.csv")
    assert (code, out) == (2, "")
    assert err == (
        "carom: bounces.csv: expected a track, got a table of rebounds; carom fit and carom predict take it as it is\n"
    )


def test_restitution_and_height_of_each_bounce_are_columns_and_json(capsys, monkeypatch, tmp_path):
    """A ball falls from 1 m and returns 0.8 of its speed: it rises to 0.64 m, 0.41 m, ..."""
    pull, rng, rows, start, speed, height = 9.80665, np.random.default_rng(3), [], 0.0, 0.0, 1.0
    for t in np.arange(200) / 100:
        while t > start + (fall := (speed + math.sqrt(speed**2 + 2 * pull * height)) / pull):
            start, speed, height = start + fall, 0.8 * (pull * fall - speed), 0.0
        y = height + speed * (t - start) - pull / 2 * (t - start) ** 2
        rows.append(f"{t},{0.01 * t + 1e-4 * rng.normal()},{y + 2e-4 * rng.normal()}\n")
    (tmp_path / "b.csv").write_text("t,x,y\n" + "".join(rows))
    out = tmp_path / "rebounds.csv"
    assert run(capsys, monkeypatch, str(tmp_path / "b.csv"), "--out", str(out))[0] == 0
    with out.open() as file:
        found = list(csv.DictReader(file))
    for k, row in enumerate(found, 1):
        assert abs(float(row["e_n"]) - 0.8) < 4 * float(row["sigma_e_n"]) < 4e-3
        assert abs(float(row["rebound_height"]) - 0.64**k) < 4 * float(row["sigma_rebound_height"]) < 4e-3
    _code, told, _notes = run(capsys, monkeypatch, str(tmp_path / "b.csv"), "--json")
    contacts = json.loads(told)["contacts"]
    assert [one["fit"]["restitution"][0] for one in contacts] == [float(row["e_n"]) for row in found] != []
    assert [one["fit"]["rebound_height"][1] for one in contacts] == [
        float(row["sigma_rebound_height"]) for row in found
    ]
    notes = read_rebounds(out).notes
    assert not [note for note in notes if "e_n" in note or "rebound_height" in note]
