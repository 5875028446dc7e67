"""The recipe for the thirty filmed shots, on made-up files of the same layout, and the rebounds measured on the true ones."""

from __future__ import annotations

import json
import pickle
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from reference.commands import command

from carom.data import read_rebounds
from carom.data.datasets.carom_tracks import BEGIN, FILE, HEADER, write_carom_tracks
from carom.errors import CaromError
from carom.fitting import Setting, fit_law, make_problem
from carom.fitting.laws import laws_named
from carom.fitting.parameters import INDEX

ROOT = Path(__file__).parents[2]


class Harmful:
    """Writes a file when it is unpickled."""

    def __init__(self, mark: Path) -> None:
        self.mark = mark

    def __reduce__(self) -> Any:
        return Path.touch, (self.mark,)


def shots(count: int = 33) -> list[list[np.ndarray]]:
    """(N, 3) of each ball: t, x along, y across, m; the first shot begins where the true one does."""
    rng = np.random.default_rng(8)
    found = []
    for number in range(count):
        balls = []
        for ball in range(3):
            time = 0.02 * np.arange(9)
            place = np.array([0.1, 0.1]) + np.array([2.6, 1.2]) * rng.random((9, 2))
            place[0] = BEGIN[ball] if number == 0 else place[0]
            place[4:6] = place[3]  # it rests for two frames
            balls.append(np.column_stack([time, place]))
        found.append(balls)
    return found


def source(
    folder: Path, *, unit: float = 1.0, turned: bool = True, key: str = "Ball", protocol: int = 4, **more: Any
) -> Path:
    """Write the shots as the program does, with the axes of pooltool or of the table."""
    entries = []
    for balls in shots():
        columns = []
        for t, x, y in (ball.T for ball in balls):
            short, long = (unit * y, unit * (2.84 - x)) if turned else (unit * x, unit * y)
            columns.append({"t": t, "x": short, "y": long.tolist()})
        entries.append({key: columns, "hit": np.float64(1.0)})
    path = folder / FILE
    path.write_bytes(pickle.dumps({"Shot": entries, **more}, protocol))
    return path


@pytest.mark.parametrize(
    "given", [{}, {"unit": 1000.0}, {"turned": False, "unit": 1000.0, "key": "Route"}, {"protocol": 5}, {"protocol": 2}]
)
def test_thirty_shots_and_no_others_on_the_axes_of_the_table(given: dict[str, Any], tmp_path: Path) -> None:
    path = source(tmp_path, **given)
    written = write_carom_tracks(path, tmp_path / "tracks.csv")
    lines = (tmp_path / "tracks.csv").read_text().splitlines()
    assert lines[0] == ",".join(HEADER)
    rows = [line.split(",") for line in lines[1:]]
    kept = [0, 1, 2, 3, 6, 7, 8]  # two rows repeat the place
    expected = [
        (f"shot_{number:02d}", str(ball), *row)
        for number, balls in enumerate(shots()[:30])
        for ball, columns in enumerate(balls, 1)
        for row in columns[kept]
    ]
    assert [tuple(row[:2]) for row in rows] == [row[:2] for row in expected]
    numbers = np.array([row[2:] for row in rows], float)
    np.testing.assert_allclose(numbers, np.array([row[2:] for row in expected]), rtol=0, atol=6e-6)
    assert written.rows == len(rows) == 30 * 3 * 7


def test_a_ball_at_rest_keeps_its_first_row_and_its_last(tmp_path: Path) -> None:
    path = source(tmp_path)
    found = pickle.loads(path.read_bytes())
    for name in ("x", "y"):
        found["Shot"][1]["Ball"][2][name] = np.full(9, 0.5)
    path.write_bytes(pickle.dumps(found))
    write_carom_tracks(path, tmp_path / "tracks.csv")
    rows = [line.split(",") for line in (tmp_path / "tracks.csv").read_text().splitlines()]
    assert [row[2] for row in rows if row[:2] == ["shot_01", "3"]] == ["0.0000", "0.1600"]


def test_nothing_in_the_file_is_run(tmp_path: Path) -> None:
    pandas = pytest.importorskip("pandas")
    mark = tmp_path / "mark"
    frame = pandas.DataFrame({"B1B2B3": ["WYR", "YWR"], "n": [1, 2]})
    path = source(tmp_path, Data=frame, Harm=Harmful(mark), Where=[Path("a")], Kinds={"a", "b"})
    write_carom_tracks(path, tmp_path / "tracks.csv")
    assert not mark.exists()
    pickle.loads(path.read_bytes())
    assert mark.exists()  # what an ordinary reader would have done


@pytest.mark.parametrize(
    ("content", "expected"),
    [
        (b"", "expected a file of Shot Analyzer (a pickle)"),
        (b"shot,ball,t_s", "expected a file of Shot Analyzer (a pickle)"),
        (pickle.dumps({"Shot": [{}] * 29}), "expected a dictionary with a list 'Shot' of 30 shots or more"),
        (pickle.dumps([1, 2]), "expected a dictionary with a list 'Shot'"),
        (pickle.dumps({"Shot": [{"Ball": [1, 2]}] * 30}), "shot 1: expected three balls"),
        (pickle.dumps({"Shot": [{"Ball": [{"t": [0], "x": [1]}] * 3}] * 30}), "shot 1: expected columns t, x, y"),
        (pickle.dumps({"Shot": [{"Ball": [{"t": [0], "x": [1], "y": [np.nan]}] * 3}] * 30}), "expected finite numbers"),
        (pickle.dumps({"Shot": [{"Ball": [{"t": [0], "x": [1], "y": [1]}] * 3}] * 30}), "expected the balls of the first shot at"),
    ],
)  # fmt: skip
def test_another_file_is_refused_and_nothing_is_written(content: bytes, expected: str, tmp_path: Path) -> None:
    path, out = tmp_path / "a.sapy", tmp_path / "tracks.csv"
    path.write_bytes(content)
    with pytest.raises(CaromError) as error:
        write_carom_tracks(path, out)
    assert expected in str(error.value)
    assert not out.exists()


def test_the_command(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path, out = source(tmp_path), tmp_path / "tracks.csv"
    code, told, notes = command(capsys, "datasets", "carom-tracks", "--from", str(path), "--out", str(out))
    assert (code, told) == (0, "")
    assert "erdo100/pooltool" in notes
    assert "630 rows; the table behind the validation pages has 17187" in notes
    assert notes.splitlines()[-1] == f"written: {out}"
    code, told, _notes = command(capsys, "datasets", "carom-tracks", "--from", str(path), "--out", str(out), "--json")
    assert (code, json.loads(told)["rows"]) == (0, 630)
    code, told, notes = command(capsys, "datasets", "carom-tracks")
    assert (code, told, len(notes.splitlines())) == (2, "", 1)
    assert f"--from {FILE} --out TABLE.csv" in notes
    code, _told, notes = command(capsys, "datasets", "kharaz2001", "--from", str(path))
    assert (code, len(notes.splitlines())) == (2, 1)
    assert "expected carom-tracks before it, got kharaz2001" in notes
    code, told, _notes = command(capsys, "datasets")
    assert "30 filmed three-cushion shots" in told


def test_the_statement_of_readme_and_page_follows_from_the_table_of_rebounds() -> None:
    table = read_rebounds(ROOT / "docs" / "data" / "carom_tracks_rebounds.csv")
    use = table.extra["use"]
    assert {name: int((use == name).sum()) for name in set(use)} == {"yes": 89, "slow": 13, "reversed": 1}
    np.testing.assert_array_equal(use == "slow", table["v_n_in"] <= 0.3)
    rebounds = table.select(use == "yes")
    assert len(set(rebounds.extra["shot"])) == 30
    setting = Setting(radius=0.03075, contact_height=1.2033, scatter="share")
    # (the fits alone, sought near the minimum: that searches come there from afar, and who is an outlier, is asked elsewhere)
    near = replace(setting, bounds={"restitution": (0.8, 0.88), "friction": (0.15, 0.3)})
    best, *others = (
        fit_law(laws_named([name], "table", False)[0][0], make_problem(rebounds, one)[0])
        for name, one in (("two-step", near), ("two-step-paper", setting), ("conventional", setting))
    )
    numbers = (
        best.numbers
    )  # (the minimum is at a kink: whether an error bar can be given may depend on the last digits)
    assert numbers[INDEX["restitution"]] == pytest.approx(0.840, abs=0.003)
    assert numbers[INDEX["friction"]] == pytest.approx(0.221, abs=0.003)
    assert [other.aicc - best.aicc for other in others] == pytest.approx([267, 594], abs=1)
    for page in ("README.md", "docs/validation/which_law.md"):
        words = " ".join((ROOT / page).read_text(encoding="utf-8").replace("*", "").split())
        assert "Fitted to 89 rebounds with a constant restitution, the two-step law has the lowest AICc" in words
        assert "with the paper's own surfaces it is rejected too, by 267" in words
        assert "by 594" in words
