"""Files that pooltool, 0.6.0 and main, wrote, read without it; and files that are no such thing."""

from __future__ import annotations

import copy
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import carom
from carom.interop.pooltool import PooltoolShot, read

FILES = Path(__file__).parent / "files"
pytest.importorskip("msgpack")


def text(name: str) -> Any:
    return json.loads((FILES / name).read_text(encoding="utf-8"))


def test_a_struck_ball_starts_as_the_cue_left_it() -> None:
    system, (shot,) = text("bank.json"), read(FILES / "bank.json")
    # the state under `balls` is the end of the shot; the start is that after the event stick_ball
    stick = next(event for event in system["events"] if event["event_type"] == "stick_ball")
    r, v, w = stick["agents"][1]["final"]["state"]["rvw"]
    white, red = shot.scene.balls
    assert (white.name, list(white.position), list(white.velocity), list(white.spin or ())) == ("white", r, v, w)
    assert v != [0, 0, 0]
    assert (list(red.position[:2]), red.velocity) == ([1.0, 2.0], (0, 0, 0))
    assert (white.radius, white.mass) == (0.03075, 0.2125)


def test_cloth_cushions_and_balls_have_the_files_numbers() -> None:
    scene = read(FILES / "break.json")[0].scene
    assert scene.gravity == (0, 0, -9.81)
    assert scene.floor == carom.Floor(friction=0.2, rolling_resistance=0.01, spin_friction=4 / 9 * 0.028575)
    assert scene.ball_contact == carom.BallContact(restitution=0.95, friction=0.05)
    (table,) = scene.walls
    assert (table.restitution.value, table.friction) == (0.85, 0.2)  # type: ignore[union-attr]


def test_a_pool_table_has_pooltools_noses_jaws_and_pockets() -> None:
    (table,) = read(FILES / "break.json")[0].scene.walls
    assert isinstance(table, carom.scene.Table)
    assert (table.length, table.width, table.nose_height) == (0.9906, 1.9812, 0.036576)
    assert table.corner_pockets is not None
    assert table.side_pockets is not None
    # the numbers of pooltool's seven-foot table, from which it makes the places in the file
    corner, side = table.corner_pockets, table.side_pockets
    assert [corner.mouth, corner.jaw_angle, corner.jaw_radius, corner.radius] == pytest.approx(
        [0.118, 135 + 5.3, 0.02095, 0.062], abs=1e-12
    )
    assert [side.mouth, side.jaw_angle, side.jaw_radius, side.radius] == pytest.approx(
        [0.137, 90 + 7.14, 0.00795, 0.0645], abs=1e-12
    )
    holes = {tuple(pocket["center"][:2]) for pocket in text("break.json")["table"]["pockets"].values()}
    assert np.array(sorted(pocket.center for pocket in table.pockets)) == pytest.approx(np.array(sorted(holes)))


def test_json_and_messagepack_hold_the_same_shot() -> None:
    (one,), (two,) = read(FILES / "bank.json"), read(FILES / "bank.msgpack")
    assert one.scene == two.scene
    assert one.paths["white"].shape == (15, 4)  # the events
    assert two.paths["white"].shape[0] > 400  # every 0.02 s
    assert one.paths["white"][0].tolist() == [0.0, 0.4, 0.5, 0.03075]
    assert one.paths["white"][-1].tolist() == two.paths["white"][-1].tolist()
    for before, after in zip(
        read(FILES / "break.json")[0].scene.balls, read(FILES / "break.msgpack")[0].scene.balls, strict=True
    ):
        assert before.position == after.position


def test_a_multisystem_is_a_list_of_shots_struck_or_simulated() -> None:
    planned, played = read(FILES / "two_shots.json")
    strike = planned.scene.balls[0].strike
    assert strike is not None
    assert (strike.speed, strike.azimuth, strike.offset, strike.cue.mass) == (3.0, 80.0, (0.0, 0.25), 0.567)
    assert planned.paths == {}
    assert any("carom.strike plays its cue" in note for note in planned.notes)
    # an elastic tip in both; pooltool's impulse is along the cue, carom's follows from sticking, and presses the ball down a little
    ours, theirs = planned.scene.balls[0].state, played.scene.balls[0].state
    assert ours.velocity[:2] == pytest.approx(theirs.velocity[:2], rel=0.02)
    assert np.arctan2(ours.velocity[1], ours.velocity[0]) == pytest.approx(np.radians(80), abs=1e-9)
    assert ours.spin == pytest.approx(theirs.spin, rel=0.1)


def test_until_the_first_impact_carom_plays_pooltools_break() -> None:
    (shot,) = read(FILES / "break.msgpack")
    scene = shot.scene.model_copy(update={"run": carom.Run(max_events=1)})
    run = carom.simulate(scene)
    first = run.events[0]
    path = shot.paths["cue"]
    hit = path[(path[:, 1:3] != path[0, 1:3]).any(axis=1)][0]  # the first event at another place
    assert first.kind == "ball"
    # (pooltool leaves 1e-6 m between the balls)
    assert first.t == pytest.approx(hit[0], abs=1e-6)
    cue = [ball.name for ball in scene.balls].index("cue")
    # (just before: after it the balls are on the ways on which they leave)
    assert run.at(np.nextafter(first.t, 0)).position[cue] == pytest.approx(hit[1:], abs=3e-6)


@pytest.mark.parametrize("name", ["bank.json", "break.msgpack"])
def test_a_scene_from_pooltool_runs_to_rest(name: str) -> None:
    run = carom.simulate(read(FILES / name)[0].scene)
    assert set(run.final_phase) <= {"rest", "pocketed"}
    assert len(run.events.of("wall")) > 0


def changed(name: str, change: Callable[[Any], Any], folder: Path) -> Path:
    system = copy.deepcopy(text(name))
    change(system)
    path = folder / name
    path.write_text(json.dumps(system), encoding="utf-8")
    return path


def test_another_layout_becomes_segments_and_arcs(tmp_path: Path) -> None:
    def narrow(system: Any) -> None:
        for end in ("p1", "p2"):
            system["table"]["cushion_segments"]["linear"]["6"][end][0] -= 0.01

    (shot,) = read(changed("break.json", narrow, tmp_path))
    kinds = [wall.kind for wall in shot.scene.walls]
    assert (kinds.count("segment"), kinds.count("arc")) == (18, 12)
    assert any(note.startswith("pockets lb") for note in shot.notes)
    jaw = next(wall for wall in shot.scene.walls if wall.name == "jaw 1t")
    # a quarter less what the facing turns: from the nose (90 degrees) to the facing's normal
    assert (jaw.from_angle, jaw.to_angle) == pytest.approx((90, 90 + 39.7))  # type: ignore[attr-defined]
    assert jaw.low == 0.036576  # type: ignore[attr-defined]


def test_balls_in_pockets_and_numbers_of_other_balls_are_notes(tmp_path: Path) -> None:
    def change(system: Any) -> None:
        system["balls"]["3"]["state"]["s"] = 4
        system["balls"]["4"]["params"]["u_s"] = 0.3

    (shot,) = read(changed("break.json", change, tmp_path))
    assert "3" not in [ball.name for ball in shot.scene.balls]
    assert "ball 3: in a pocket at the start" in shot.notes
    assert any(note.startswith("ball 4: its u_s, 0.3, as the scene has the cue ball's, 0.2") for note in shot.notes)


def drop(*keys: str) -> Callable[[Any], None]:
    def change(system: Any) -> None:
        for key in keys[:-1]:
            system = system[key]
        del system[keys[-1]]

    return change


def put(value: Any, *keys: str) -> Callable[[Any], None]:
    def change(system: Any) -> None:
        for key in keys[:-1]:
            system = system[key]
        system[keys[-1]] = value

    return change


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (drop("balls"), r"expected a System .* got a table with cue, table, t, events; save the shot with"),
        (drop("table", "cushion_segments"), r"table\.cushion_segments: expected a field of this name, .*, got none"),
        (drop("balls", "3", "params", "u_sp_proportionality"), r"balls\.3\.params\.u_sp_proportionality: expected a field"),
        (put("fast", "cue", "V0"), r"cue\.V0: expected a finite number, got 'fast'; save the shot again with pooltool 0\.6"),
        (put(float("nan"), "balls", "3", "params", "m"), r"balls\.3\.params\.m: expected a finite number, got nan"),
        (put([[0, 0, 0], [0, 0]], "balls", "3", "state", "rvw"), r"balls\.3\.state\.rvw: expected 3 by 3 finite numbers"),
        (put([], "balls"), r"balls: expected a table of fields, got \[\]"),
        (put("none", "events"), r"events: expected a list, got 'none'"),
        (put("10", "cue", "cue_ball_id"), r"cue\.cue_ball_id: expected one of the balls .*, got '10'"),
        (put([0, 1, 2], "table", "cushion_segments", "linear", "3", "p1"), r"linear\.3: expected p1 and p2 of one height"),
        (put(-1.0, "balls", "cue", "params", "e_c"), r"as a .*restitution.* got -1"),
    ],
)  # fmt: skip
def test_a_wrong_field_is_one_line_with_its_place(change: Callable[[Any], None], said: str, tmp_path: Path) -> None:
    path = changed("break.json", change, tmp_path)
    with pytest.raises(carom.CaromError, match=said) as caught:
        read(path)
    assert all(fault.startswith(f"{path}: ") and "\n" not in fault for fault in caught.value.faults)


def test_a_wrong_shot_of_several_is_named(tmp_path: Path) -> None:
    path = changed("two_shots.json", lambda system: put("x", "cue", "V0")(system["multisystem"][0]), tmp_path)
    with pytest.raises(carom.CaromError, match=r"multisystem\.0\.cue\.V0: expected a finite number, got 'x'"):
        read(path)


@pytest.mark.parametrize(
    ("name", "data", "said"),
    [
        ("shot.txt", b"{}", r"expected a file of pooltool's, with a name that ends with \.json or \.msgpack, got '\.txt'"),
        ("shot.json", b'{"cue": ', r"expected JSON, got text that is no JSON in line 1"),
        ("shot.json", b"\xff\xfe", r"expected JSON, text in UTF-8, got byte 0xff; a binary file ends with \.msgpack"),
        ("shot.json", b"[1, 2]", r"expected a table of fields, got \[1, 2\]"),
        ("shot.json", b'{"type": "FeatureCollection"}', r"expected a System .* got a table with type; save"),
        ("shot.json", b"[" * 100_000, r"expected JSON, got brackets nested too deep to read"),
        ("shot.msgpack", b"\xc1", r"expected a whole MessagePack file, got one that ends or errs"),
        ("shot.msgpack", (FILES / "bank.msgpack").read_bytes()[:5000], r"expected a whole MessagePack file"),
        ("shot.msgpack", (FILES / "bank.json").read_bytes(), r"expected a whole MessagePack file"),
        # msgpack-numpy's form of an array of Python objects, which it would unpickle
        ("shot.msgpack", b"\x84\xc4\x02nd\xc3\xc4\x04type\xa2|O\xc4\x05shape\x91\x01\xc4\x04data\xc4\x01.", r"an array of '\|O'"),
    ],
)  # fmt: skip
def test_other_and_damaged_files_are_one_line(name: str, data: bytes, said: str, tmp_path: Path) -> None:
    path = tmp_path / name
    path.write_bytes(data)
    with pytest.raises(carom.CaromError, match=said) as caught:
        read(path)
    assert len(caught.value.faults) == 1
    assert "\n" not in str(caught.value)


def test_a_file_that_is_not_there_is_one_line(tmp_path: Path) -> None:
    with pytest.raises(carom.CaromError, match=r"nothing\.json: expected a file of pooltool's, got: No such file"):
        read(tmp_path / "nothing.json")


def test_what_is_read_says_what_it_is() -> None:
    shot = read(FILES / "bank.json")[0]
    assert isinstance(shot, PooltoolShot)
    assert (
        shot.scene.describe() == "a floor, a table of 1.42 m by 2.84 m, cushion noses at 37 mm, 2 balls, law two-step"
    )


def test_a_shot_stored_by_pooltool_with_two_step_has_its_states_after_every_cushion() -> None:
    from carom.interop.pooltool.physics import nose_normal
    from carom.tracks.formats.pooltool import open_file

    ball, wall, floor = carom.Ball(0.03075, 0.2125), carom.Surface(0.85, 0.2), carom.Surface(0.0, 0.2)
    found = 0
    for event in open_file(FILES / "bank_two_step.msgpack")["events"].each():
        if event["event_type"].text() != "ball_linear_cushion":
            continue
        one, cushion = (agent for agent in event["agents"].each())
        before, after = (np.array(one[when]["state"]["rvw"].array(3, 3)) for when in ("initial", "final"))
        p1, p2 = (cushion["initial"][end].array(3) for end in ("p1", "p2"))
        level = np.array([p2[1] - p1[1], p1[0] - p2[0]]) / np.linalg.norm(p2 - p1)
        n = nose_normal(level, before[1], p1[2], 0.03075)
        two = carom.two_step(ball, carom.State(before[1], before[2]), wall, floor, n, 9.81)
        assert after[1] == pytest.approx(two.after_floor.velocity, rel=1e-12, abs=1e-14)
        assert after[2] == pytest.approx(two.after_floor.spin, rel=1e-12, abs=1e-12)
        found += 1
    assert found == 5


# --- files of the main branch, and of versions nobody knows -----------------------------------------------------------


@pytest.mark.parametrize("name", ["main_bank.json", "main_hop.msgpack", "main_jump.json"])
def test_a_file_of_the_main_branch_has_its_floors_restitution(name: str) -> None:
    (shot,) = read(FILES / name)
    assert shot.scene.floor is not None
    assert shot.scene.floor.restitution.value == 0.5  # type: ignore[union-attr]
    assert not any("no restitution" in note for note in shot.notes)
    assert carom.simulate(shot.scene).final_phase[0] == "rest"


def test_a_hop_that_main_flew_is_caroms() -> None:
    from carom.tracks.formats.pooltool import open_file

    (shot,) = read(FILES / "main_hop.msgpack")
    events = open_file(FILES / "main_hop.msgpack")["events"].each()
    kinds = [event["event_type"].text() for event in events]
    landings = [event["time"].number() for event in events if event["event_type"].text() == "ball_table"]
    run = carom.simulate(shot.scene)
    own = run.events.of("floor").t[: len(landings)]
    assert kinds.count("ball_linear_cushion") == len(run.events.of("wall"))
    # (pooltool turns the ball a micrometre before the cushion, and leaves out bounces below a nanometre)
    assert own[:3] == pytest.approx(landings[:3], abs=1e-5)
    assert run.final.position[0] == pytest.approx(shot.paths["white"][-1, 1:], abs=5e-5)


def test_a_cue_that_is_raised_lifts_the_ball_of_an_unsimulated_file() -> None:
    (shot,) = read(FILES / "main_jump.json")
    strike = shot.scene.balls[0].strike
    assert strike is not None
    assert strike.elevation == 30.0


SECOND = "the file is of another version or damaged: save the shot again with pooltool 0.6.0"


@pytest.mark.parametrize(
    ("name", "change", "said"),
    [
        ("break.json", put(0.1, "balls", "3", "params", "u_air"),
         r"balls\.3\.params\.u_air: expected no field of this name, as in files of pooltool 0\.6\.0, got one; "),
        ("main_bank.json", put(0.1, "balls", "white", "params", "u_air"),
         r"balls\.white\.params\.u_air: expected no field of this name, as in files of pooltool's main branch of June 2026, got"),
        ("break.json", put(2, "format"), r": format: expected no field of this name"),
        ("break.json", put(0.01, "table", "cushion_segments", "linear", "3", "nose_radius"),
         r"linear\.3\.nose_radius: expected no field of this name, as in files of pooltool 0\.6\.0"),
        ("break.json", put(0.5, "balls", "3", "params", "e_t"),
         r"cue\.model_name: expected a field of this name, as in files of pooltool's main branch of June 2026, got none; "),
        ("main_bank.json", drop("table", "cushion_segments", "linear", "3", "nose_radius"),
         r"linear\.3\.nose_radius: expected a field of this name, as in files of pooltool's main branch of June 2026, got none; "),
        ("bank.json", lambda system: put("ball_table", "event_type")(system["events"][1]),
         r"events\.1\.event_type: expected an event of pooltool 0\.6\.0, got 'ball_table'; "),
        ("main_bank.json", lambda system: put("ball_wind", "event_type")(system["events"][1]),
         r"events\.1\.event_type: expected an event of pooltool's main branch of June 2026, got 'ball_wind'; "),
    ],
)  # fmt: skip
def test_a_file_of_another_version_is_one_line_that_names_it(
    name: str, change: Callable[[Any], None], said: str, tmp_path: Path
) -> None:
    path = changed(name, change, tmp_path)
    with pytest.raises(carom.CaromError, match=said) as caught:
        read(path)
    (fault,) = caught.value.faults
    assert fault.startswith(f"{path}: ")
    assert fault.endswith(SECOND)
    assert "\n" not in fault


def test_a_file_of_the_main_branch_has_a_table_that_bounces() -> None:
    (shot,) = read(FILES / "main_hop.json")
    params = text("main_hop.json")["balls"]["white"]["params"]
    assert shot.scene.floor is not None
    assert shot.scene.floor.contact.p[0] == params["e_t"] == 0.5
    assert not any("restitution" in note for note in shot.notes)
    # pooltool in three dimensions with carom's laws, and carom: hops, bounces and contacts, until it follows no more bounces
    run = carom.simulate(shot.scene)
    theirs = [
        event
        for event in text("main_hop.json")["events"]
        if event["event_type"] in ("ball_linear_cushion", "ball_table")
    ]
    ours = [event for event in run.events if event.kind in ("wall", "floor")]
    for event, own in list(zip(theirs, ours, strict=False))[:4]:
        (state,) = (agent["final"]["state"] for agent in event["agents"] if agent["agent_type"] == "ball")
        assert event["time"] == pytest.approx(own.t, abs=1e-5)
        assert state["rvw"][0] == pytest.approx(own.after.position, abs=2e-5)
        assert state["rvw"][1] == pytest.approx(own.after.velocity, abs=1e-5)
    path = shot.paths["white"]
    assert float(np.linalg.norm(path[-1, 1:3] - run.final.position[0, :2])) < 0.005
