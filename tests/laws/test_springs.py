"""Walls with springs along their surface (maw, stronge) in the event loop: the law's own answer, wall by wall."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from reference.commands import command

import carom
from carom.laws.law import LIKE_SOLIDS, Meeting
from carom.laws.maw import maw_contact
from carom.laws.registry import LAWS
from carom.laws.stronge import stronge_contact
from carom.scene.shapes import Plane

A, KAPPA = 0.03, 0.4
CONTACTS: dict[str, Callable[..., Any]] = {"maw": maw_contact, "stronge": stronge_contact}
NORMALS = {"plane 0": (1.0, 0.0, 0.0), "plane 1": (-0.6, 0.0, 0.8)}


def scene(laws: tuple[Any, Any], ratios: tuple[float, float], **run: Any) -> carom.Scene:
    """A ball in the air over an upright wall and a slope, each with a law and a stiffness of its own."""
    one = Plane(
        point=(0, 0, 0), normal=(1, 0, 0), restitution=0.8, friction=0.3, law=laws[0], stiffness_ratio=ratios[0]
    )
    two = Plane(
        point=(0.2, 0, 0), normal=(-0.6, 0, 0.8), friction=0.2, law=laws[1], stiffness_ratio=ratios[1],
        restitution={"form": "viscoelastic", "c": 0.1},
    )  # fmt: skip
    ball = carom.SceneBall(
        radius=A, mass=0.2, position=(0.2, 0, 0.3), velocity=(-1.5, 0.8, 0.7), spin=(10.0, -20.0, 35.0)
    )
    return carom.Scene(walls=[one, two], balls=[ball], run=carom.Run(**({"max_events": 40} | run)))


@pytest.mark.parametrize("laws", [("maw", "stronge"), ("stronge", "maw"), ("maw", "maw"), ("two-step", "stronge")])
def test_the_engine_s_answer_is_the_law_s(laws: tuple[str, str]) -> None:
    ratios = (0.6, 1.3)
    events = carom.simulate(scene(laws, ratios)).events.of("wall")
    assert {event.name for event in events} == set(NORMALS)
    met = 0
    for event in events:
        wall = list(NORMALS).index(event.name)
        if laws[wall] not in CONTACTS:
            continue
        n = NORMALS[event.name]
        v, w = tuple(event.before.velocity.tolist()), tuple(event.before.spin.tolist())
        approach = -float(np.dot(v, n))
        e = 0.8 if wall == 0 else scene(laws, ratios).walls[1].restitution.at(approach)
        v1, w1 = CONTACTS[laws[wall]](v, w, n, A, KAPPA, e, (0.3, 0.2)[wall], ratios[wall])
        assert event.after.velocity == pytest.approx(v1, abs=1e-14 * np.abs(v).max())
        assert A * event.after.spin == pytest.approx(np.multiply(A, w1), abs=1e-14 * np.abs(v).max())
        met += 1
    assert met >= 3


@pytest.mark.parametrize("name", CONTACTS)
def test_one_wall_says_what_the_law_says_of_a_meeting(name: str) -> None:
    """Against the law as compare and predict ask it, on a floor: what leaves the wall, and what rolls at last."""
    wall = Plane(point=(0, 0, 0), normal=(1, 0, 0), restitution=0.85, friction=0.25, stiffness_ratio=1.1)
    ball = carom.SceneBall(radius=A, mass=0.2, position=(0.2, 0), velocity=(-1.5, 1.0), rolling=True, spin_z=12.0)
    floor = carom.Floor(friction=0.2, restitution=0.5)
    run = carom.simulate(carom.Scene(floor=floor, walls=[wall], balls=[ball], run=carom.Run(law=name, duration=9)))
    hit = run.events.of("wall")[0]
    meeting = Meeting(
        carom.Ball(A, 0.2),
        hit.before,
        wall=carom.Surface(0.85, 0.25),
        floor=carom.Surface(0.5, 0.2),
        stiffness_ratio=1.1,
    )
    answer = LAWS[name].answer(meeting)
    assert hit.after.velocity == pytest.approx(answer.after_wall.velocity, rel=1e-14)
    assert run.final.velocity[0] == pytest.approx(answer.final.velocity, rel=1e-12)
    # and the stiffness matters
    other = LAWS[name].answer(Meeting(meeting.ball, hit.before, wall=meeting.wall, floor=meeting.floor))
    assert np.abs(other.final.velocity - answer.final.velocity).max() > 1e-3


def test_many_runs_are_single_runs() -> None:
    table = scene(("maw", "stronge"), (0.6, 1.3), max_events=12)
    v = np.random.default_rng(4).normal(size=(30, 3))
    many = carom.simulate_many(table, velocity=v)
    for n in (0, 11, 29):
        one = table.balls[0].model_copy(update={"velocity": tuple(v[n].tolist())})
        single = carom.simulate(table.model_copy(update={"balls": (one,)})).final
        assert np.array_equal(many.final.velocity[n], single.velocity)
        assert np.array_equal(many.final.spin[n], single.spin)


def test_a_law_object_reads_the_stiffness_too() -> None:
    by_name = carom.simulate(scene(("maw", "stronge"), (0.6, 1.3))).final
    by_object = carom.simulate(scene((LAWS["maw"], LAWS["stronge"]), (0.6, 1.3))).final
    assert np.array_equal(by_name.velocity, by_object.velocity)
    other = carom.simulate(scene(("maw", "stronge"), (0.6, 1.0))).final
    assert not np.array_equal(by_name.velocity, other.velocity)


def test_energy_is_never_gained() -> None:
    for law in CONTACTS:
        plain = scene((law, law), (0.6, 2.5))
        walls = [wall.model_copy(update={"restitution": None, "friction": 0.4}) for wall in plain.walls]
        with pytest.raises(carom.CaromError, match="restitution: expected a number from 0 to 1"):
            carom.Scene(gravity=0, walls=walls, balls=plain.balls)
        walls = [Plane(**{**wall.model_dump(), "restitution": 1.0, "law": law}) for wall in walls]
        run = carom.simulate(carom.Scene(gravity=0, walls=walls, balls=plain.balls, run=plain.run))
        energy = run.energy(np.linspace(0, run.end, 50))
        assert (np.diff(energy) <= 1e-12 * energy[0]).all()
        assert energy[-1] < energy[0]


TOML = """
[floor]
friction = 0.2
[[walls]]
shape = "table"
length = 2.0
width = 1.0
restitution = 0.85
friction = 0.3
law = "maw"
stiffness_ratio = 0.7
[[walls]]
shape = "cylinder"
point = [0.5, 0.25, 0.0]
radius = 0.1
restitution = 0.9
friction = 0.8
[[balls]]
radius = 0.03
mass = 0.2
position = [-0.5, 0.2]
velocity = [1.2, 0.02]
rolling = true
[run]
law = "stronge"
duration = 5.0
"""


def test_a_scene_file(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "springs.toml"
    file.write_text(TOML)
    loaded = carom.load_scene(file)
    assert [wall.stiffness_ratio for wall in loaded.walls] == [0.7, LIKE_SOLIDS]
    assert loaded.describe().endswith("laws maw and stronge, 5 s")
    assert carom.Scene.model_validate_json(loaded.model_dump_json()) == loaded
    code, out, _err = command(capsys, "simulate", str(file), "--json")
    assert code == 0
    final = json.loads(out)["final"][0]
    run = carom.simulate(loaded)
    assert final["velocity"] == run.final.velocity[0].tolist()
    assert {event.name for event in run.events.of("wall")} == {"table 0", "cylinder 1"}
    # another law for all that have none of their own
    code, out, _err = command(capsys, "simulate", str(file), "--json", "--law", "two-step")
    assert code == 0
    assert json.loads(out)["final"][0]["position"] != final["position"]
    assert carom.load_trajectory(run.save(tmp_path / "run.parquet")).scene == loaded


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("stiffness_ratio = 0.7", "stiffness_ratio = 7", "walls[0].stiffness_ratio: expected a stiffness ratio from"
         " 0.171 to 3.43, for which the law is tabulated, for the law maw, got 7.0"),
        ("stiffness_ratio = 0.7", "stiffness_ratio = 0", "walls[0].stiffness_ratio: expected a number > 0, got 0"),
        ("stiffness_ratio = 0.7", "tangential_restitution = 0.5", "walls[0].tangential_restitution: expected 0 for the law maw,"
         " got 0.5; that law computes the tangential rebound from springs; omit it, and give stiffness_ratio"),
        ("friction = 0.8\n", "", "walls[1].friction: expected a number >= 0 (inf: never slips), got nothing; the law stronge reads"
         " it; mirror, conventional, no-slip do not need it"),
        ("radius = 0.1\n", "radius = 0.1\nstiffness_ratio = 1e5\n", "walls[1].stiffness_ratio: expected a"
         " stiffness ratio from 0.001 to 1000, for the law stronge, got 100000.0"),
        ('law = "maw"', 'law = "mav"', f"walls[0].law: expected one of {', '.join(carom.LAWS)}, or"
         " file.py:name, got 'mav'; did you mean 'maw'?"),
    ],
)  # fmt: skip
def test_bad_springs_are_one_line(
    old: str, new: str, said: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "springs.toml"
    assert old in TOML
    file.write_text(TOML.replace(old, new))
    assert command(capsys, "simulate", str(file)) == (2, "", f"carom: {file}: {said}\n")
