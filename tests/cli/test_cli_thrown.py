"""Films of a ball that is thrown or dropped, from the side: what is known of its spin, and what such rebounds cannot say."""

from __future__ import annotations

import json
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from reference.commands import command, fails
from reference.thrown_ball import KAPPA, RADIUS, as_csv, film, table, thrown

from carom.data import make_rebounds, read_rebounds
from carom.fitting import Setting, fit_laws, make_problem, usable_rows
from carom.plot.tracks import plot_tracks
from carom.tracks import Settings, measure, to_rebounds
from carom.tracks.films import first_contacts

BALL = ("--radius", str(RADIUS), "--inertia", "hollow")
SETTING = Setting(radius=RADIUS, kappa=KAPPA)
FILMS = [
    thrown(speed, height) for speed, height in ((2.0, 0.5), (2.5, 0.4), (3.0, 0.6), (3.5, 0.5), (4.0, 0.7), (4.5, 0.4))
]


@pytest.fixture
def rebounds(tmp_path: Path) -> Path:
    file = tmp_path / "rebounds.csv"
    file.write_text(as_csv(table(FILMS)))
    return file


# --- a ball thrown without spin ---------------------------------------------------------------------------------------


def test_spin_0_holds_for_the_first_bounce_only(rebounds: Path, capsys: pytest.CaptureFixture[str]) -> None:
    words = ("--spin", "0", "--laws", "sliding", "--no-profiles", "--bootstrap", "0", "--json")
    code, out, err = command(capsys, "fit", str(rebounds), *BALL, *words)
    assert code == 0, err
    found = json.loads(out)
    assert found["fits"], found["verdict"]
    code, out, err = command(capsys, "fit", str(rebounds), *BALL, *words[:-1], "--short")
    assert (code, out) == (0, f"{found['sentence']}\n")
    code, out, _err = command(capsys, "fit", str(rebounds), *BALL, *words[:-1])
    assert out.splitlines()[0] == found["sentence"] == found["verdict"][: len(found["sentence"])]
    for name, true in (("restitution", 0.78), ("friction", 0.15)):
        estimate = found["ranking"][0]["parameters"][name]
        assert abs(estimate["value"] - true) < 4 * estimate["stderr"]
        assert estimate["stderr"] < 1e-3
    (note,) = [note for note in found["notes"] if "--spin" in note]
    assert note == (
        "spin_in: --spin 0 holds for the first contact of a ball (6 of 18 rows); a ball that has bounced spins, so in the later"
        " contacts (12) it follows from those before"
    )


def test_the_first_contact_of_each_ball(rebounds: Path) -> None:
    read = read_rebounds(rebounds, kind="planar")
    assert first_contacts(read).tolist() == [True, False, False] * 6
    # without a column of its own, by the numbers of all contacts of a film
    numbers = {"film": np.array(["a", "a", "b", "b"]), "contact": np.array([2, 3, 1, 2])}
    speeds = {"v_n_in": [1.0] * 4, "v_t_in": 0.5, "v_n_out": 0.8}
    assert first_contacts(make_rebounds("planar", speeds, extra=numbers)).tolist() == [True, False, True, False]
    # single bounces
    assert first_contacts(make_rebounds("planar", speeds)).tolist() == [True] * 4
    known, _setting = usable_rows(make_rebounds("planar", speeds), SETTING, spin=3.0)
    assert known["spin_in"].tolist() == [3.0] * 4


def test_a_table_without_a_first_contact_has_no_given_spin(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "later.csv"
    file.write_text(as_csv(table([bounces[1:] for bounces in FILMS])).replace(",ball,1,", ",ball,3,"))
    (line,) = [line for line in fails(capsys, "fit", str(file), *BALL, "--spin", "0") if "--spin" in line]
    assert "expected rows that are the first contact of a ball (column bounce = 1), got 12 later ones" in line


def test_tracks_number_the_bounces_of_each_ball() -> None:
    measured = measure(
        [film(FILMS[0]), replace(film(FILMS[1], seed=2), group="second")], Settings(view="side", radius=0.0)
    )
    found = to_rebounds(measured)
    assert found.extra["bounce"].tolist() == [1, 2, 3, 1, 2, 3]
    assert found.extra["contact"].tolist() == [1, 2, 3, 4, 5, 6]


@pytest.mark.slow
def test_without_a_spin_later_contacts_follow_from_the_first(
    rebounds: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ("--no-profiles", "--bootstrap", "0", "--json")
    code, out, err = command(capsys, "fit", str(rebounds), *BALL, "--laws", "sliding,mirror", *words)
    assert code == 0, err
    found = json.loads(out)
    assert found["rows"] == 18
    assert found["ranking"][0]["law"] == "sliding"
    said = "spin_in: not measured in 18 of 18 rows; in 12 later contacts carried on from the ball's contact before, in 6 others"
    assert any(note.startswith(said) for note in found["notes"])
    for name, true in (("restitution", 0.78), ("friction", 0.15)):
        estimate = found["ranking"][0]["parameters"][name]
        assert abs(estimate["value"] - true) < 3 * estimate["stderr"] < 0.006
    few, setting = usable_rows(read_rebounds(rebounds, kind="planar").select(np.arange(9)), SETTING)
    assert "film more throws before relying on a verdict" in make_problem(few, setting)[1][0]
    apart, setting = usable_rows(few, SETTING, every_contact=True)
    assert not make_problem(apart, setting)[0].carried


def test_later_contacts_of_very_many_rows_are_left_out(rebounds: Path) -> None:
    read = read_rebounds(rebounds, kind="planar")
    rows, _setting = usable_rows(read.select(np.tile(np.arange(18), 60)), SETTING)
    assert len(rows) == 360
    assert "the 720 later contacts of 1080 rows are left out (spins are carried on in up to 1000 rows" in rows.notes[-1]


# --- a ball dropped straight down -------------------------------------------------------------------------------------


@pytest.mark.slow
def test_a_drop_says_nothing_about_friction(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "drop.csv"
    file.write_text(as_csv(table([thrown(0.0, 1.2)])))
    code, out, err = command(capsys, "fit", str(file), *BALL)
    assert code == 0, err
    told = " ".join(out.split())
    assert told.startswith("Only the restitution is measured: restitution 0.7")
    assert "The rebounds say nothing about friction or which law holds" in told
    assert "lean to" not in told
    assert "do not rely on the verdict" not in err


def test_a_drop_decides_nothing_with_or_without_error_bars() -> None:
    columns = {name: [float(cell) for cell in cells] for name, cells in table([thrown(0.0, 1.2, count=6)]).items()
               if "v_" in name}  # fmt: skip
    ranking = fit_laws(make_rebounds("planar", columns), SETTING, ["mirror", "sticking"], bootstrap=0, profiles=False)
    bare = {"v_n_in": columns["v_n_in"], "v_n_out": columns["v_n_out"], "spin_in": [0.0] * 6}
    without = fit_laws(make_rebounds("planar", bare), SETTING, ["mirror", "sticking"], bootstrap=0, profiles=False)
    for one in (ranking, without):
        assert "say nothing about friction" in one.verdict
        assert not one.decisive
        assert np.isnan(one.odds)


def test_a_drop_is_no_basis_of_a_plan(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "drop.csv"
    file.write_text(as_csv(table([thrown(0.0, 1.2)])))
    (line,) = fails(capsys, "design", str(file), *BALL)
    assert "expected rebounds from which the friction of contact can be fitted" in line
    assert "(--truth friction=0.2)" in line


def test_a_plan_takes_the_spin_that_is_known(rebounds: Path, capsys: pytest.CaptureFixture[str]) -> None:
    words = ("--laws", "sliding,mirror", "--json", "--spin", "0")
    code, out, err = command(capsys, "design", str(rebounds), *BALL, *words)
    assert code == 0, err
    assert json.loads(out)["truth"]["friction"] == pytest.approx(0.15, abs=0.002)
    (line,) = fails(capsys, "design", "--spin", "0")
    assert "--spin: expected a file of rebounds with it, got none" in line


def test_speeds_before_and_after_are_enough_for_the_restitution(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "speeds.csv"
    file.write_text("v_n_in [m/s];v_n_out [m/s]\n" + "".join(f"{v};{0.78 * v + e}\n".replace(".", ",") for v, e in
                    ((1.0, 0.01), (1.5, -0.01), (2.0, 0.0), (2.5, 0.01), (3.0, -0.01))))  # fmt: skip
    code, out, err = command(capsys, "fit", str(file), *BALL, "--kind", "planar")
    assert code == 0, err
    told = " ".join(out.split())
    assert "Only the restitution is measured: restitution 0.77" in told
    assert "lean to" not in told
    assert "spin_in: not measured; taken as 0" in " ".join(err.split())


def test_a_ball_that_slips_decides() -> None:
    columns = table(FILMS)
    numbers = {name: [float(cell) for cell in cells] for name, cells in columns.items() if "v_" in name}
    rows = make_rebounds("planar", numbers | {"spin_in": [bounce[3] for one in FILMS for bounce in one]})
    ranking = fit_laws(rows, SETTING, ["mirror", "sliding"], bootstrap=0, profiles=False)
    assert ranking.best.law.name == "sliding"
    assert "say nothing" not in ranking.verdict
    # a ball that is dropped with a spin slips too
    spun = make_rebounds("planar", {"v_n_in": [2.0, 3.0, 4.0], "v_t_in": 0.0, "spin_in": 50.0, "v_n_out": [1.6, 2.4, 3.2],
                                    "v_t_out": [0.3, 0.31, 0.32], "sigma_v_n_out": 0.02, "sigma_v_t_out": 0.02})  # fmt: skip
    ranking = fit_laws(spun, SETTING, ["mirror", "sliding"], bootstrap=0, profiles=False)
    assert "say nothing" not in ranking.verdict


# --- what is shown of such a film -------------------------------------------------------------------------------------


def test_the_restitution_of_each_contact_is_shown(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    track = film(thrown(1.0, 1.2), noise=4e-4)
    file = tmp_path / "film.csv"
    cells = np.column_stack([track.time, track.position[:, 0], np.round(track.position[:, 1], 3)])
    np.savetxt(file, cells, delimiter=",", header="t [s],x [m],y [m]", comments="", fmt="%.5f")
    for width, shown in (("90", True), ("75", True), ("65", False)):
        monkeypatch.setenv("COLUMNS", width)
        code, out, _err = command(capsys, "tracks", "show", str(file))
        assert code == 0
        assert ("out/in" in out) is shown
        rows = [line for line in out.splitlines() if line.startswith(("ball bottom ", "bottom "))]
        assert len(rows) == 3
        assert rows[0].startswith("bottom" if width == "75" else "ball bottom")
        assert max(len(row.rstrip()) for row in rows) <= int(width)
        if shown:
            for row in rows:
                value, _, error = row.split()[-1].rstrip(")").partition("(")
                places = len(value.split(".")[1])
                assert abs(float(value) - 0.78) < 4 * int(error) * 10**-places
                assert int(error) * 10**-places < 0.01
        assert "; the file rounds y to 1" in out


def test_a_narrow_track_has_room_for_its_ticks() -> None:
    figure = plot_tracks(measure([film(thrown(0.0, 1.2))], Settings(view="side")))
    figure.draw_without_rendering()
    paths = figure.axes[0]
    boxes = [label.get_window_extent() for label in paths.get_xticklabels() if label.get_visible() and label.get_text()]
    low, high = paths.get_window_extent().x0, paths.get_window_extent().x1
    boxes = [box for box in boxes if low <= (box.x0 + box.x1) / 2 <= high]
    assert len(boxes) >= 2
    assert all(one.x1 < other.x0 for one, other in pairwise(boxes))
    assert paths.get_window_extent().width > 0.3 * paths.get_window_extent().height
