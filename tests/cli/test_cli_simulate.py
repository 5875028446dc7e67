"""carom simulate: the describe_run, the tables, JSON that is the library's answer, files that are whole or not there."""

from __future__ import annotations

import csv
import json
import os
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from reference.forking import Forked
from reference.scene_file import EXAMPLE
from typer.testing import CliRunner

import carom
from carom.cli import app, main
from carom.formatting import format_number
from carom.simulation.loop import compiled_engine
from carom.simulation.narrate import FIRST, LAST, describe_run
from carom.simulation.trajectory import budget

runner = CliRunner()

BOX = """
gravity = 0
[[walls]]
shape = "box"
corner = [0, 0, 0]
size = [1, 1, 1]
inside = true
[[balls]]
radius = 0.05
mass = 0.1
position = [0.3, 0.4, 0.5]
velocity = [1.0, 0.7, 0.3]
[run]
law = "mirror"
"""
PAIR = """
[floor]
friction = 0.2
rolling_resistance = 0.01
[[balls]]
name = "white"
radius = 0.03
mass = 0.2
position = [0, 0]
velocity = [1, 0]
rolling = true
[[balls]]
name = "red"
radius = 0.03
mass = 0.2
position = [0.5, 0.01]
[[balls]]
radius = 0.03
mass = 0.2
position = [0, 1]
"""


@pytest.fixture(autouse=True, scope="module")
def _compiled() -> None:
    """So that no test waits for the compiler, or says that it does."""
    compiled_engine()


@pytest.fixture
def scenes(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with scenes, in which the commands run."""
    for name, text in (("design", EXAMPLE), ("box", BOX), ("pair", PAIR)):
        (tmp_path / f"{name}.toml").write_text(text)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def command(*arguments: str) -> tuple[str, str]:
    """What a command that succeeds writes."""
    result = runner.invoke(app, ["simulate", *arguments], env={"COLUMNS": "120"})
    assert result.exit_code == 0, result.output
    return result.stdout, result.stderr


def fails(capsys: pytest.CaptureFixture[str], *arguments: str) -> list[str]:
    """Run a command that fails: code 2, nothing on standard output, nothing written."""
    here = sorted(Path.cwd().rglob("*"))
    before, sys.argv = sys.argv, ["carom", "simulate", *arguments]
    try:
        with pytest.raises(SystemExit) as end:
            main()
    finally:
        sys.argv = before
    out, err = capsys.readouterr()
    assert end.value.code == 2
    assert out == ""
    assert sorted(Path.cwd().rglob("*")) == here
    return err.splitlines()


# --- other values --------------------------------------------------------------------------------------------------


def test_set_replaces_numbers_of_the_scene(scenes: Path, capsys: pytest.CaptureFixture[str]) -> None:
    out, _err = command("pair.toml", "--set", "balls.0.velocity=[0, 0]", "--set", "balls.*.mass=200 g", "--json")
    assert json.loads(out)["events"] == []
    found = fails(capsys, "pair.toml", "--set", "balls.0.mas=1", "--set", "balls", "--law", "twostep")
    assert any("--set: balls.0.mas: expected" in line and "did you mean 'balls.0.mass'" in line for line in found)
    assert any("--set: expected PATH=VALUE, such as walls.*.restitution=0.8, got 'balls'" in line for line in found)
    assert any(
        "--set: balls[0].mass: expected" in line for line in fails(capsys, "pair.toml", "--set", "balls.0.mass=-1")
    )


def test_words_of_a_struck_ball_on_a_table(scenes: Path) -> None:
    table = {
        "shape": "table",
        "name": "rail",
        "length": 2,
        "width": 1,
        "nose_height": 0.037,
        "restitution": 0.8,
        "friction": 0.2,
    }

    def words(strike: dict[str, object]) -> str:
        cue = {"radius": 0.029, "mass": 0.17, "position": (0, 0), "name": "cue", "strike": strike}
        scene = carom.Scene(floor={"friction": 0.2, "rolling_resistance": 0.01}, walls=[table], balls=[cue])
        return " ".join(describe_run(carom.simulate(scene, duration=4)))

    for azimuth, side in ((0, "right"), (90, "top"), (180, "left"), (270, "bottom")):
        assert f"it meets rail ({side})" in words({"speed": 2, "azimuth": azimuth})
    assert "cue is struck and " in words({"speed": 2, "azimuth": 0}).replace("Cue", "cue")
    assert "is struck, a miscue, and " in words({"speed": 2, "azimuth": 0, "offset": [0.7, 0]})
    # draw: the ball rolls back, which the words say
    far = {"radius": 0.029, "mass": 0.17, "position": (0.3, 0), "name": "far"}
    scene = carom.Scene(
        floor={"friction": 0.2},
        balls=[
            {**far, "position": (0, 0), "name": "cue", "strike": {"speed": 3, "azimuth": 0, "offset": [0, -0.4]}},
            far,
        ],
    )
    assert "rolls at 0.72 m/s, 180° from the x axis" in describe_run(carom.simulate(scene, duration=2))[0]


def test_words_of_a_ball_that_a_wall_stops() -> None:
    """It spins without moving: no speed and no angle is said of it."""
    wall = {"shape": "plane", "point": (0, 0, 0), "normal": (1, 0, 0), "restitution": 0, "law": "mirror"}
    ball = {"radius": 0.03, "mass": 0.2, "position": (0.5, 0), "velocity": (-1, 0), "spin": (3, 0, 0)}
    scene = carom.Scene(gravity=0, walls=[wall], balls=[ball])
    said = describe_run(carom.simulate(scene, duration=0.6))[0]
    assert "it meets plane 0, 0° from its normal" in said
    assert "leaves" not in said


# --- words ---------------------------------------------------------------------------------------------------------


def test_the_scene_of_the_design_word_for_word(scenes: Path) -> None:
    out, err = command("design.toml")
    assert err == ""
    words = " ".join(out.split())
    assert words.startswith("Scene: a floor, a plane")
    assert "Ball 0 rolls at 2.24 m/s, 153° from the x axis." in words
    assert "it rolls at" in words
    assert "−" not in words.split("At the end")[1].split("from the x axis")[0]  # directions are 0 to 359°
    assert "At 0.49 s it meets plane 0, 27° from its normal, sticks, and leaves at" in words
    assert "it is lifted 15.9 mm, flies 206 mm, bounces" in words
    assert "the last time in" not in words  # (less than a millisecond of bounces is not worth the words)
    assert (
        "slides for 155 ms and rolls at 1.29 m/s, 37° from the x axis. At the end, after 10 s and 1 wall, it rolls at"
        in words
    )
    assert "The run ends after its duration, 10 s, and 13 events." in words
    assert "wall plane 0" in words
    assert "end: 10.0000" in words
    assert "Energy: 0.735 J at the start; 0.255 J lost at walls, 0.149 J lost in landings" in words


def told(text: str, tmp_path: Path, **run: Any) -> tuple[carom.Trajectory, list[str]]:
    """A scene's run and its story."""
    path = tmp_path / "scene.toml"
    path.write_text(text)
    scene = carom.load_scene(path)
    found = carom.simulate(carom.Scene(**{name: getattr(scene, name) for name in carom.Scene.model_fields} | run))
    return found, describe_run(found)


def test_the_numbers_told_are_those_of_the_run(tmp_path: Path) -> None:
    run, words = told(EXAMPLE, tmp_path)
    wall = run.events.of("wall")[0]
    first = run.events.of("floor")[0]
    assert wall.after.velocity[2] ** 2 / (2 * 9.80665) * 1e3 == pytest.approx(15.9, abs=0.05)
    assert wall.after.position is not None
    assert first.after.position is not None
    assert np.hypot(*(first.after.position - wall.after.position)[:2]) * 1e3 == pytest.approx(206, abs=0.5)
    bounces = len([event for event in run.events.of("floor") if event.phase in ("flight", "bouncing")])
    assert f"bounces {bounces} times" in words[0]


def test_balls_that_meet_and_one_that_does_not(tmp_path: Path) -> None:
    run, words = told(PAIR, tmp_path)
    assert len(words) == 3
    white, red, other = words
    t = run.events.of("ball")[0].t
    assert f"At {t:.3f} s it meets red at" in white
    assert f"At {t:.3f} s it is struck by white and goes off at" in red
    assert white.endswith("s and 1 ball.")
    assert red.startswith("red is at rest. At")
    assert red.count("comes to rest") == 1
    assert other == "ball 2 stays at rest."


def test_a_long_run_is_abridged_and_its_meetings_counted(tmp_path: Path) -> None:
    run, words = told(BOX, tmp_path, run=carom.Run(law="mirror", max_events=1000))
    assert run.ended == "max_events"
    paragraph, end = words
    assert paragraph.count(" it meets box 0") == FIRST - 1 + LAST
    assert f"Then come {1000 - FIRST + 1 - LAST} more walls, up to" in paragraph
    assert "and 1,000 walls, it flies at 1.26 m/s at" in paragraph
    assert "sticks" not in paragraph  # a mirror asks no friction
    assert end.startswith("The run ends at its greatest number of events, 1,000, after")


def test_one_and_many(tmp_path: Path) -> None:
    _run, words = told(BOX, tmp_path, run=carom.Run(law="mirror", max_events=1))
    assert "and 1 wall, it flies" in words[0]
    _run, words = told(BOX, tmp_path, run=carom.Run(law="mirror", max_events=2))
    assert "and 2 walls, it flies" in words[0]
    many = PAIR + "".join(
        f"[[balls]]\nradius = 0.03\nmass = 0.2\nposition = [{i}, 3]\nvelocity = [0, 1]\nrolling = true\n"
        for i in range(5)
    )
    _run, words = told(many, tmp_path)
    assert words[3] == "4 more balls meet nothing; at the end 4 are at rest."
    assert words[4] == "ball 2 stays at rest."
    _run, words = told(PAIR.replace("velocity = [1, 0]\nrolling = true", ""), tmp_path)
    assert words == ["white, red and ball 2 stay at rest."]


def test_left_and_held(tmp_path: Path) -> None:
    over = PAIR.replace(
        "[[balls]]", '[[walls]]\nshape = "table"\nlength = 3\nwidth = 3\nheight = 0.05\nlaw = "mirror"\n[[balls]]', 1
    )
    _run, words = told(over.replace("velocity = [1, 0]\nrolling = true", "velocity = [5, 0, 3]"), tmp_path)
    assert "it clears table 0 and has left: it is followed no further." in words[0]
    edge = """
[[walls]]
shape = "plane"
point = [0, 0, 0]
normal = [0, 0, 1]
restitution = 0
friction = 0.5
[[balls]]
radius = 0.03
mass = 0.2
position = [0, 0, 0.1]
"""
    run, words = told(edge, tmp_path)
    assert run.final_phase == ["held"]
    assert words[0].startswith("ball 0 is let go. At")
    assert "is held there, pressed on it: it is followed no further." in words[0]


def test_the_energy_adds_up(tmp_path: Path) -> None:
    for text in (EXAMPLE, PAIR, BOX):
        run, _words = told(text, tmp_path, run=carom.Run(law="mirror", duration=2.0))
        found = budget(run)
        assert found.start == pytest.approx(run.energy(0.0), rel=1e-12)
        assert found.end == pytest.approx(run.energy(run.end), rel=1e-12, abs=1e-15)
        assert found.walls == pytest.approx(sum(event.energy_lost for event in run.events.of("wall")), abs=1e-15)
        spent = found.walls + found.floor + found.balls + found.way
        assert found.start - found.end == pytest.approx(spent, abs=1e-15)


# --- tables --------------------------------------------------------------------------------------------------------


def test_the_table_is_abridged_and_says_so(scenes: Path) -> None:
    out, _err = command("box.toml", "--max-events", "50")
    assert out.count("wall box 0") == 40
    assert "10 events not shown: --events all shows all" in out
    out, _err = command("box.toml", "--max-events", "50", "--events", "all")
    assert out.count("wall box 0") == 50
    assert "not shown" not in out
    out, _err = command("box.toml", "--max-events", "50", "--events", "49")
    assert out.count("wall box 0") == 49
    assert "1 event not shown" in out
    out, _err = command("box.toml", "--max-events", "50", "--events", "0")
    assert out.count("wall box 0") == 0


def test_bounces_on_the_floor_are_one_row_and_complete_in_files(scenes: Path) -> None:
    """The hops after one contact took eleven rows; `--events all`, JSON and CSV have every event."""
    out, _err = command("design.toml")
    (line,) = [line for line in out.splitlines() if " lands, " in line]
    run = carom.simulate(carom.load_scene("design.toml"))
    lands = run.events.of("floor")
    rising = sum(event.phase in ("flight", "bouncing") for event in lands)
    assert rising > 5
    assert f"lands, {rising} bounces since {lands[0].t:.4f} s" in line
    assert line.split()[0] == f"{lands[-1].t:.4f}"  # (place and velocity are those after the last)
    assert format_number(sum(event.energy_lost for event in lands)) in line.split()
    assert "not shown" not in out
    every, _err = command("design.toml", "--events", "all")
    assert "lands," not in every
    assert sum(" floor " in line for line in every.splitlines()) == len(lands)
    out, _err = command("design.toml", "--json", "--save-events", "events.csv")
    assert len(json.loads(out)["events"]) == len(run.events)
    assert len(Path("events.csv").read_text().splitlines()) == len(run.events) + 1
    # hops of two balls at the same time are not mixed
    text = PAIR.replace("position = [0, 0]", "position = [0, 0, 0.2]").replace("rolling = true", "")
    text = text.replace("position = [0, 1]", "position = [0, 1, 0.3]").replace(
        "friction = 0.2", "friction = 0.2\nrestitution = 0.5", 1
    )
    (scenes / "two.toml").write_text(text)
    out, _err = command("two.toml", "--duration", "1")
    rows = [line.split() for line in out.splitlines() if " lands, " in line]
    assert {"white", "ball"} <= {row[1] for row in rows}  # (ball 2)
    assert [float(row[0]) for row in rows] == sorted(float(row[0]) for row in rows)


def test_states_at_times(scenes: Path) -> None:
    out, _err = command("box.toml", "--duration", "2", "--at", "0.1", "--at", "1,1.5")
    rows = [line.split() for line in out.splitlines() if "ball 0" in line and "flight" in line]
    assert [row[0] for row in rows] == ["0.1000", "1.0000", "1.5000", "end:"]
    assert " ".join(rows[0]).startswith("0.1000 ball 0 flight 0.4, 0.47, 0.53")


# --- JSON ----------------------------------------------------------------------------------------------------------


def no_constants(name: str) -> None:
    raise AssertionError(name)


@pytest.mark.parametrize("name", ["design", "pair", "box"])
def test_json_is_the_librarys_answer_in_full(scenes: Path, name: str) -> None:
    limits = ("--max-events", "30") if name == "box" else ()
    out, err = command(f"{name}.toml", "--json", *limits)
    assert err == ""
    found = json.loads(out, parse_constant=no_constants)
    scene = carom.load_scene(f"{name}.toml")
    if limits:
        scene = scene.model_copy(update={"run": carom.Run(law="mirror", max_events=30)})
    run = carom.simulate(scene)
    assert list(found) == ["events", "final", "end", "ended"]
    assert len(found["events"]) == len(run.events) > 0
    for row, event in zip(found["events"], run.events, strict=True):
        assert event.after.position is not None
        assert row["position"] == event.after.position.tolist()
        assert row["velocity"] == event.after.velocity.tolist()
        assert row["spin"] == event.after.spin.tolist()
        assert row["impulse"] == event.impulse.tolist()
        for field in ("t", "kind", "ball", "other", "name", "phase"):
            assert row[field] == getattr(event, field)
        assert row["energy_lost"] == pytest.approx(event.energy_lost, abs=1e-15)
        assert row["required_friction"] == (event.required_friction if np.isfinite(event.required_friction) else None)
    position = run.final.position
    assert position is not None
    assert [row["position"] for row in found["final"]] == position.tolist()
    assert [row["velocity"] for row in found["final"]] == run.final.velocity.tolist()
    assert [row["spin"] for row in found["final"]] == run.final.spin.tolist()
    assert [row["phase"] for row in found["final"]] == run.final_phase
    assert (found["end"], found["ended"]) == (run.end, run.ended)


def test_json_with_states_and_files(scenes: Path) -> None:
    out, err = command("design.toml", "--json", "--at", "1", "--save-events", "events.csv")
    found = json.loads(out)
    run = carom.simulate(carom.load_scene("design.toml"))
    assert [one["t"] for one in found["at"]] == [1.0]
    assert found["at"][0]["states"][0]["velocity"] == run.at(1.0).velocity[0].tolist()
    assert err == "written: events.csv\n"


# --- files ---------------------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_files_are_written_and_named(scenes: Path) -> None:
    pytest.importorskip("pyarrow")
    out, err = command("design.toml", "--save", "run.parquet", "--save-events", "events.csv", "--quiet")
    assert (out, err) == ("", "")
    out, err = command("design.toml", "--save", "run.parquet", "--save-events", "events.parquet")
    assert err.splitlines() == ["written: run.parquet", "written: events.parquet"]
    run = carom.simulate(carom.load_scene("design.toml"))
    assert carom.load_trajectory("run.parquet").log.tobytes() == run.log.tobytes()
    with open("events.csv", encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    assert [float(row["t"]) for row in rows] == run.events.t.tolist()
    assert [float(row["vx"]) for row in rows] == [float(event.after.velocity[0]) for event in run.events]
    import pyarrow.parquet as pq

    assert pq.read_table("events.parquet").column("t").to_pylist() == run.events.t.tolist()
    assert sorted(path.name for path in scenes.iterdir()) == [
        "box.toml", "design.toml", "events.csv", "events.parquet", "pair.toml", "run.parquet",
    ]  # fmt: skip


def test_a_picture(scenes: Path) -> None:
    pytest.importorskip("matplotlib")
    command("design.toml", "--plot", "run.svg", "--quiet")
    assert (scenes / "run.svg").read_text().count("<svg") == 1


def test_all_files_or_none(scenes: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    def fail(self: carom.Trajectory, file: Path, **_options: Any) -> None:
        Path(file).write_text("half")
        raise carom.CaromError(f"animate: {file}: expected ffmpeg, got none")

    monkeypatch.setattr(carom.Trajectory, "animate", fail)
    lines = fails(capsys, "design.toml", "--save-events", "events.csv", "--animate", "run.gif")
    assert lines == ["carom: animate: run.gif: expected ffmpeg, got none"]


WRONG = {
    "missing": (["none.toml"], "none.toml: expected a scene file"),
    "toml": (["bad.toml"], "bad.toml: line 1: expected TOML"),
    "overlap": (["overlap.toml"], "overlaps the floor by 20 mm"),
    "plot": (["design.toml", "--plot", "run.bmp"], "'.bmp'"),
    "animate": (["design.toml", "--animate", "run.avi"], "--animate run.avi: expected a name that ends with .mp4, .gif or .html"),
    "save": (["design.toml", "--save", "run.csv"], "--save run.csv: expected a name that ends with .parquet"),
    "rows": (["design.toml", "--save-events", "r"], "--save-events r: expected a name that ends with .csv or .parquet, got none"),
    "folder": (["design.toml", "--save", "no/run.parquet"], "--save no/run.parquet: expected a folder that exists"),
    "is a folder": (["design.toml", "--save-events", "folder.csv"], "got a folder"),
    "twice": (["design.toml", "--save", "run.parquet", "--save-events", "run.parquet"], "expected another file than --save's"),
    "late": (["design.toml", "--at", "10.5"], "--at: expected times from 0 to 10 s, the end of the run, got 10.5"),
    "late, with a file": (["design.toml", "--at", "11", "--save-events", "run.csv"], "--at: expected times from 0 to 10 s"),
    "early": (["design.toml", "--at", "-1"], "--at: expected times >= 0"),
    "no time": (["design.toml", "--at", "soon"], "--at: expected times >= 0"),
    "events": (["design.toml", "--events", "some"], "--events: expected 'all' or a whole number"),
    "law": (["design.toml", "--law", "no-slp"], "--law: expected one of mirror"),
    "law of the walls": (
        ["design.toml", "--law", "conventional"],
        "design.toml: walls[0].restitution: expected hypothesis 3: a wall of restitution 1",
    ),
    "law lacks": (["box.toml", "--law", "two-step"], "box.toml: walls[0].restitution"),
    "duration": (["design.toml", "--duration", "-1"], "--duration: expected a time in s, > 0, got -1.0"),
    "duration's unit": (["design.toml", "--duration", "3 m"], "--duration: expected a time in s"),
    "max events": (["design.toml", "--max-events", "0"], "--max-events: expected a whole number >= 1, got 0"),
    "option": (["design.toml", "--durations", "1"], "--durations"),
}  # fmt: skip


@pytest.mark.parametrize("case", WRONG)
def test_what_is_wrong_is_one_line(scenes: Path, case: str, capsys: pytest.CaptureFixture[str]) -> None:
    (scenes / "bad.toml").write_text("[floor\n")
    (scenes / "overlap.toml").write_text(EXAMPLE.replace("position = [1.0, 0.5]", "position = [1.0, 0.5, 0.01075]"))
    (scenes / "folder.csv").mkdir()
    arguments, expected = WRONG[case]
    lines = fails(capsys, *arguments)
    # a box has two things that the law lacks
    assert len(lines) == (2 if case == "law lacks" else 1)
    assert lines[0].startswith("carom: ")
    assert expected in lines[0]


def test_several_faults_at_once(scenes: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert len(fails(capsys, "none.toml", "--at", "x", "--save", "run.csv", "--save-events", "no/a.csv")) == 4
    lines = fails(capsys, "none.toml", "--law", "no-slp", "--duration", "-1")
    assert [line.split(": ")[1] for line in lines] == ["none.toml", "--law", "--duration"]


@pytest.mark.skipif(os.name != "posix" or os.geteuid() == 0, reason="anybody may write anywhere")
def test_a_folder_without_leave(scenes: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (scenes / "closed").mkdir(mode=0o500)
    assert "permission to write" in fails(capsys, "design.toml", "--save-events", "closed/a.csv")[0]


@pytest.mark.slow
def test_options_take_the_place_of_the_scenes(scenes: Path) -> None:
    found = json.loads(command("design.toml", "--json", "--duration", "600 ms", "--law", "mirror")[0])
    assert (found["end"], found["ended"]) == (0.6, "duration")
    assert [event["kind"] for event in found["events"]] == ["wall", "rolling"][: len(found["events"])]
    assert found["events"][0]["velocity"][0] > 0
    (scenes / "law.py").write_text(
        "def law(v, w, n, a, kappa, e, mu, beta):\n    return (-v[0], -v[1], -v[2]), (-w[0], -w[1], -w[2])\n"
    )
    back = json.loads(command("box.toml", "--json", "--max-events", "1", "--law", "law.py:law")[0])
    assert back["events"][0]["velocity"] == [-1.0, -0.7, -0.3]


def test_the_compiled_loop_is_found_in_the_package_or_in_the_cache(
    scenes: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from carom.simulation.loop import compiled_before

    monkeypatch.setattr("carom.core.jit.compile.cache_folder", lambda: scenes / "empty")
    for shipped in (True, False):
        monkeypatch.setattr("carom.core.jit.compile.is_shipped", lambda _loop, shipped=shipped: shipped)
        assert compiled_before() is shipped
    (scenes / "empty" / "simulation").mkdir(parents=True)
    (scenes / "empty" / "simulation" / "loop._one_run-1.py311.nbi").touch()
    assert compiled_before()


CHILD = """
import os, signal, sys
import carom.simulation.simulate
from carom.cli import main

follow, swallowed, said = carom.simulation.simulate.simulate, HOW == "swallowed", []
sys.argv = ["carom", "simulate", "box.toml", "--max-events", "3000000", "--save-events", "events.csv"]


def told(scene, progress):
    def first(*done):
        if not said:
            said.append(True)
            try:
                os.kill(os.getpid(), signal.SIGINT)
            except KeyboardInterrupt:
                if not swallowed:
                    raise
        progress(*done)

    return follow(scene, first)


carom.simulation.simulate.simulate = told
main()
"""


# swallowed: as Python does with what is raised while it clears away what the compiling has left
@pytest.mark.parametrize("how", ["raised", "swallowed"])
def test_ctrl_c_ends_with_130_and_leaves_nothing(scenes: Path, how: str, forked: Forked) -> None:
    code, out, err = forked(scenes, "-c", CHILD.replace("HOW", repr(how)))
    assert (code, out) == (130, "")
    assert err.endswith("carom: interrupted; nothing was written\n")
    assert sorted(path.name for path in scenes.iterdir()) == ["box.toml", "design.toml", "pair.toml"]


def test_laws_that_create_energy_or_pass_the_ball_through_are_noted(tmp_path: Path) -> None:
    (tmp_path / "laws.py").write_text(
        "def along(v, w, n, a, kappa, e, mu, beta):\n"
        "    return (2 * v[0], v[1], v[2]), w\n"
        "def back(v, w, n, a, kappa, e, mu, beta):\n"
        "    u = v[0] * n[0] + v[1] * n[1] + v[2] * n[2]\n"
        "    return (v[0] - 3 * u * n[0], v[1] - 3 * u * n[1], v[2] - 3 * u * n[2]), w\n"
        "def through(v, w, n, a, kappa, e, mu, beta):\n"
        "    return v, w\n"
    )
    file = tmp_path / "box.toml"
    file.write_text(BOX)

    def noted(law: str) -> list[str]:
        done = runner.invoke(app, ["simulate", str(file), "--law", law, "--max-events", "1"])
        return [
            line.replace(str(tmp_path / "laws.py"), "laws.py") for line in done.stderr.splitlines() if "note:" in line
        ]

    # 0.05 kg (4 - 1) of 1 m/s along x
    (created,) = noted(f"{tmp_path / 'laws.py'}:back")
    assert created == (
        "note: law laws.py:back creates energy: first at t = 0.65 s, ball 0 at box 0, 0.15 J; 1 contact, 0.15 J in all"
    )
    passes = "leaves the ball moving into the wall: first at t = 0.65 s, ball 0 at box 0; expected n . v >= 0 after it"
    assert noted(f"{tmp_path / 'laws.py'}:through") == [f"note: law laws.py:through {passes}"]
    assert len(noted(f"{tmp_path / 'laws.py'}:along")) == 2
    assert noted("mirror") == []


def test_bounces_that_last_and_a_spot_are_said() -> None:
    """Infinitely many bounces from a millisecond on; a ball that spins for ever, where and from when on."""
    ball = carom.SceneBall(radius=0.03, mass=0.2, position=(0, 0, 0.13), velocity=(0, 0, 0), spin=(0, 0, 9))
    floor = carom.Floor(restitution=0.99, friction=0.2)
    run = carom.simulate(carom.Scene(floor=floor, balls=[ball], run=carom.Run(duration=100)))
    assert "the last time in infinitely many bounces within" in run.describe()[0]
    spot = carom.SceneBall(radius=0.03, mass=0.2, position=(0.5, 0.2), velocity=(1, 0, 0), spin=(0, 0, 9))
    floor = carom.Floor(friction=0.2, rolling_resistance=0.1)
    run = carom.simulate(carom.Scene(floor=floor, balls=[spot]))
    x, t = format_number(run.final.position[0, 0]), format_number(run.end)
    assert f"goes on spinning on the spot at ({x}, 0.2) m from {t} s on" in run.describe()[0]


def test_what_a_strike_decides_is_named(tmp_path: Path) -> None:
    ball = "[[balls]]\nname = 'cue'\nradius = 0.03\nmass = 0.2\nposition = [0, 0]\nstrike = "
    file = tmp_path / "struck.toml"
    file.write_text("[floor]\nfriction = 0.2\n" + ball + "{speed = 1.0, azimuth = 3.0}\n[run]\nduration = 0.1\n")
    done = runner.invoke(app, ["simulate", str(file), "--sensitivity", "balls.cue.velocity"])
    assert isinstance(done.exception, carom.CaromError)
    assert str(done.exception).endswith("which the cue's strike fixes; take balls.cue.strike.speed, balls.cue.strike.azimuth,"
                                        " balls.cue.strike.offset")  # fmt: skip
    file.write_text("[floor]\nfriction = 0.2\n" + ball + '{speed = 1.0, offset = ["5 mm", 0]}\n')
    with pytest.raises(carom.CaromError, match=r"expected a number in radii of the ball, such as 0\.3, got '5 mm'"):
        carom.load_scene(file)


def test_two_balls_that_meet_lose_energy_together(tmp_path: Path) -> None:
    file = tmp_path / "pair.toml"
    file.write_text(PAIR + "[ball_contact]\nrestitution = 0.9\n[run]\nduration = 1\n")
    run = carom.simulate(carom.load_scene(file))
    first, second = run.events.of("ball")
    assert second.energy_lost < 0 < first.energy_lost + second.energy_lost
    lines = [line.split() for line in runner.invoke(app, ["simulate", str(file)]).stdout.splitlines()]
    rows = [words for words in lines if words[2:3] == ["ball"] and words[1] in ("white", "red")]
    assert [words[-2] for words in rows] == [format_number(first.energy_lost + second.energy_lost), "–"]
