"""``carom scene new --table``, and a run with pockets on the command line."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from reference.commands import fails
from typer.testing import CliRunner

from carom.cli import app
from carom.errors import CaromError
from carom.scene.presets import presets

runner = CliRunner()


def test_a_new_scene_of_a_table_is_run_and_says_which_balls_fall(tmp_path: Path) -> None:
    file = tmp_path / "pool.toml"
    assert runner.invoke(app, ["scene", "new", "--table", "pool-9ft", str(file)]).exit_code == 0
    done = runner.invoke(app, ["simulate", str(file), "--json"])
    assert done.exit_code == 0
    found = json.loads(done.stdout)
    fallen = {event["ball"] for event in found["events"] if event["kind"] == "pocketed"}
    assert fallen
    assert {i for i, ball in enumerate(found["final"]) if ball["phase"] == "pocketed"} == fallen
    checked = json.loads(runner.invoke(app, ["scene", "check", str(file), "--json"]).stdout)
    wall = checked["walls"][0]
    assert (wall["preset"], wall["length"], wall["corner_pockets"]["mouth"]) == ("pool-9ft", 2.54, 0.1159)


def test_the_list_of_tables() -> None:
    done = runner.invoke(app, ["scene", "new", "--table", "list"])
    assert done.exit_code == 0
    assert [line.split()[0] for line in done.stdout.splitlines()] == list(presets())


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (
            ["--table", "snoker"],
            f"table: expected one of {', '.join(presets())}, got 'snoker'; did you mean 'snooker'?",
        ),
        (
            ["--table", "snooker", "--gas"],
            "--table: expected a scene of single balls, got --gas as well; give one of the two",
        ),
    ],
)
def test_what_is_no_table(words: list[str], said: str, tmp_path: Path) -> None:
    file = tmp_path / "new.toml"
    done = runner.invoke(app, ["scene", "new", *words, str(file)])
    assert isinstance(done.exception, CaromError)
    assert str(done.exception).splitlines() == [said]
    assert not file.exists()


def test_overlapping_pockets_in_a_file(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "scene.toml"
    file.write_text(
        '[[walls]]\nshape = "table"\npreset = "pool-9ft"\nlength = 0.42\nwidth = 0.3\nside_pockets = { radius = 0.4 }\n'
        "[[balls]]\nradius = 0.03\nmass = 0.2\nposition = [0, 0]\n",
        encoding="utf-8",
    )
    (line,) = fails(capsys, "scene", "check", str(file))
    expected = (
        f"{file}: walls[0].side_pockets: expected pockets that lie apart, got bottom left pocket and bottom middle"
    )
    assert expected in line
