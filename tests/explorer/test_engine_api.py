"""The engine's functions for the page, against Python: runs, comparisons of laws, curves; and what it refuses."""

from __future__ import annotations

import itertools
import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from reference.scenes_of_all_laws import may_call_libm, scene_of_all_laws

import carom
from carom.cli.trajectory_output import as_json
from carom.core.motion.phases import PHASES
from carom.explorer.module import version
from carom.explorer.page import with_outlines
from carom.laws.landing import REGIME_NAMES as NAMES
from carom.laws.registry import laws_of_pairs
from carom.scene.scene import scene_dict
from carom.simulation.records import BALL, SEEN, WALL, kind_names

SCENES_OF_DOCS = Path(__file__).parents[2] / "docs" / "scenes"
SCENES = 60
EVENTS = 60
PAPER = """
[floor]
restitution = 0
friction = inf
[[walls]]
shape = "plane"
point = [0, 0, 0]
normal = [1, 0, 0]
restitution = 1.0
friction = inf
[[balls]]
radius = 0.02625
mass = 0.1406
position = [1.02625, 0]
velocity = [-0.7071067811865476, 0.7071067811865475]
rolling = true
[run]
duration = 3
"""


def plain(value: Any) -> Any:
    """A number as JSON in the page has it: infinity is null there."""
    return None if isinstance(value, float) and not math.isfinite(value) else value


def test_a_run_is_that_of_python_event_by_event(evaluate: Any) -> None:
    scenes = [one for seed in range(SCENES) if not may_call_libm(one := with_outlines(scene_of_all_laws(seed)))]
    asked = [scene_dict(scene) for scene in scenes]
    answers = evaluate(f"(all) => all.map((scene) => engine.run(scene, undefined, {{ events: {EVENTS} }}))", asked)
    assert len(scenes) > 10
    for scene, answer in zip(scenes, answers, strict=True):
        run = carom.simulate(scene.model_copy(update={"run": scene.run.model_copy(update={"max_events": EVENTS})}))
        rows = run.events.rows
        assert len(answer["events"]) == len(rows)
        for row, event in zip(rows, answer["events"], strict=True):
            assert event["kind"] == kind_names(row)
            assert event["met"] == {WALL: "wall", BALL: "ball"}.get(int(row["met"]))
            assert event["regime"] == (None if row["regime"] < 0 else NAMES[row["regime"]])
            for name in ("phase", "phase_before"):
                assert event[name] == PHASES[row[name]]
            for name in ("t", "ball", "other", "x", "v_before", "w_before", "v", "w", "impulse", "floor_impulse"):
                assert event[name] == row[name].tolist(), name
            assert event["required"] == plain(float(row["required"]))
        assert answer["until"] == run.end
        assert (
            answer["status"] == {"max_events": "limit", "duration": "done", "nothing more happens": "quiet"}[run.ended]
        )
        for i, ball in enumerate(answer["final"]):
            assert ball["phase"] == run.final_phase[i]
            assert ball["x"] == run.final.position[i].tolist()
            assert ball["v"] == run.final.velocity[i].tolist()
            assert ball["w"] == run.final.spin[i].tolist()


def test_two_balls_meet_by_the_laws_of_pairs_as_in_python(evaluate: Any) -> None:
    falling = {"at_rest": 0.2, "at_speed": 0.02, "speed": 0.5}
    pairs = [{"law": law, "friction": mu} for law in laws_of_pairs() for mu in (0.06, falling)]
    balls = [
        {"radius": 0.03, "mass": 0.2, "position": (x, y, 0), "velocity": (1 - 5 * x, 0, 0)}
        for x, y in ((0, 0), (0.2, 0.03))
    ]
    scenes = [
        carom.Scene(gravity=0, balls=balls, ball_contact={"restitution": 0.9, **one}, run={"duration": 1})
        for one in pairs
    ]
    asked = [scene_dict(scene) for scene in scenes]
    answers = evaluate("(all) => all.map((scene) => [engine.faults(scene), engine.run(scene).final])", asked)
    for scene, (faults, final) in zip(scenes, answers, strict=True):
        right = carom.simulate(scene).final
        assert faults == []
        for i, ball in enumerate(final):
            assert ball["v"] == pytest.approx(right.velocity[i], abs=1e-14)
            assert ball["w"] == pytest.approx(right.spin[i], abs=1e-12)
    bad = [
        asked[0] | {"ball_contact": asked[0]["ball_contact"] | one}
        for one in ({"law": "mirror"}, {"friction": {"at_rest": 1}})
    ]
    for faults, told in zip(
        evaluate("(all) => all.map((scene) => engine.faults(scene))", bad), ("law", "friction"), strict=True
    ):
        assert faults[0].startswith(f"ball_contact.{told}")


def test_shots_are_the_impacts_of_runs_of_python(evaluate: Any) -> None:
    table = carom.load_scene(SCENES_OF_DOCS / "three_balls.toml")
    scene = carom.replaced(table, {"run.law": "mirror", "run.duration": 8.0})
    random = np.random.default_rng(5)
    speed, angle = random.uniform(0.5, 6, 200), random.uniform(0, 2 * np.pi, 200)
    v, radius = np.stack([speed * np.cos(angle), speed * np.sin(angle), 0 * angle], axis=1), scene.balls[0].radius
    starts = [{"velocity": x.tolist(), "spin": [-x[1] / radius, x[0] / radius, 5.0]} for x in v]
    answers = evaluate("([scene, starts]) => engine.shots(scene, starts)", [scene_dict(scene), starts])
    for start, found in zip(starts, answers, strict=True):
        changed = {"balls.0.velocity": start["velocity"], "balls.0.spin_z": 5.0}
        rows = carom.simulate(carom.replaced(scene, changed)).events.rows
        rows = rows[np.isin(rows["met"], (WALL, BALL))]
        assert [(one["t"], one["ball"], one["other"]) for one in found] == rows[["t", "ball", "other"]].tolist()
        assert [one["met"] for one in found] == [{WALL: "wall", BALL: "ball"}[met] for met in rows["met"].tolist()]
    (rolls,) = evaluate(
        "(scene) => engine.shots(scene, [{ velocity: [0, 2, 0] }], { ball: 1, events: 4 })", scene_dict(scene)
    )
    assert any(one["ball"] == 1 for one in rolls)
    assert len(rolls) <= 4
    for asked, said in (
        ("engine.shots(scene, [], { ball: 3 })", "ball: expected a whole number from 0 to 2, got 3"),
        ("engine.shots(scene, 3)", "starts: expected a list such as [{ velocity: [1, 0, 0] }], got 3"),
        ("engine.shots(scene, [{ velocity: [1, 0] }])", "starts[0]: expected a velocity and maybe a spin"),
    ):
        caught = f"(scene) => {{ try {{ {asked}; }} catch (error) {{ return error.message; }} return ''; }}"
        assert evaluate(caught, scene_dict(scene)).startswith(said)


def test_a_report_is_what_carom_simulate_prints(evaluate: Any) -> None:
    scenes = [one for seed in range(SCENES) if not may_call_libm(one := with_outlines(scene_of_all_laws(seed)))]
    asked = [scene_dict(scene) for scene in scenes]
    answers = evaluate(f"(all) => all.map((scene) => engine.report(scene, undefined, {{ events: {EVENTS} }}))", asked)
    for scene, answer in zip(scenes, answers, strict=True):
        run = carom.simulate(scene.model_copy(update={"run": scene.run.model_copy(update={"max_events": EVENTS})}))
        printed = json.loads(as_json(run, []))
        assert list(answer) == list(printed)
        assert answer["final"] == printed["final"]
        assert (answer["end"], answer["ended"]) == (printed["end"], printed["ended"])
        assert answer["events"] == printed["events"]


def test_pieces_of_motion_are_the_exact_motion(evaluate: Any) -> None:
    scenes = [with_outlines(scene_of_all_laws(seed)) for seed in range(SCENES)]
    asked = [scene_dict(scene) for scene in scenes]
    answers = evaluate(f"(all) => all.map((scene) => engine.run(scene, undefined, {{ events: {EVENTS} }}))", asked)
    looked = 0
    for scene, answer in zip(scenes, answers, strict=True):
        if answer["status"] == "refused":
            continue
        run = carom.simulate(scene.model_copy(update={"run": scene.run.model_copy(update={"max_events": EVENTS})}))
        for i, ball in enumerate(answer["balls"]):
            pieces = ball["pieces"]
            assert pieces[0]["t"] == 0
            for one, after in itertools.pairwise(pieces):
                assert one["t"] + one["lasts"] == pytest.approx(after["t"], abs=1e-12)
            for one in pieces:
                if one["phase"] in ("held", "left") or not one["lasts"]:
                    continue
                s = 0.4 * one["lasts"]
                state = run.at(one["t"] + s)
                x, v, acc = (np.array(one[name]) for name in ("x", "v", "acc"))
                # (bounces too low to see are drawn as a straight line)
                low = one["phase"] == "bouncing"
                place = x + v * s + acc * s * s / 2
                np.testing.assert_allclose(place, state.position[i], atol=2e-6 * scene.balls[i].radius if low else 1e-9)
                if not low:
                    spin = np.array(one["w"]) + np.array(one["turn"]) * s
                    np.testing.assert_allclose(spin, state.spin[i], atol=1e-7)
                looked += 1
    assert looked > 500


def test_a_spin_that_fades_stays_at_zero(evaluate: Any) -> None:
    fields = scene_fields()
    fields["floor"]["spin_friction"] = 0.05
    fields["balls"][0]["spin_z"] = 50.0
    fields["balls"][0]["velocity"] = [0.0, 0.2]
    scene = carom.Scene(**fields)
    pieces = evaluate("(scene) => engine.run(scene)", scene_dict(scene))["balls"][0]["pieces"]
    one, two = pieces[:2]
    assert one["phase"] == two["phase"] == "rolling"
    assert one["w"][2] + one["turn"][2] * one["lasts"] == pytest.approx(0, abs=1e-12)
    assert (two["w"][2], two["turn"][2]) == (0, 0)
    state = carom.simulate(scene).at(two["t"])
    np.testing.assert_allclose(two["x"], state.position[0], atol=1e-14)


def test_a_law_is_put_at_all_walls(evaluate: Any) -> None:
    scene = carom.Scene(**scene_fields())
    for law in ("two-step", "maw", "stronge", "no-slip", "mirror", "contact"):
        run = carom.simulate(scene.model_copy(update={"run": scene.run.model_copy(update={"law": law})}))
        answer = evaluate(f"(scene) => engine.run(scene, {json.dumps(law)})", scene_dict(scene))
        assert [event["kind"] for event in answer["events"]] == run.events.kinds
        np.testing.assert_allclose(answer["final"][0]["x"], run.final.position[0], rtol=1e-12)


def scene_fields() -> dict[str, Any]:
    return {
        "floor": {"restitution": 0.5, "friction": 0.2, "rolling_resistance": 0.01},
        "walls": [{"shape": "table", "length": 2.84, "width": 1.42, "nose_height": 0.037, "restitution": 0.85, "friction": 0.2}],
        "balls": [{"radius": 0.03075, "mass": 0.21, "position": [0.5, 0.2], "velocity": [-3, 1], "rolling": True}],
        "run": {"duration": 5.0},
    }  # fmt: skip


def test_a_law_without_an_answer_says_why_as_python_does(evaluate: Any) -> None:
    fields = scene_fields()
    fields["walls"][0] |= {"restitution": 1.0, "nose_height": None}
    fields["balls"][0] |= {"rolling": False, "position": [-1.3, 0.2]}
    fields["run"] |= {"law": "conventional"}
    scene = carom.Scene(**fields)
    with pytest.raises(carom.CaromError) as error:
        carom.simulate(scene)
    answer = evaluate("(scene) => engine.run(scene)", scene_dict(scene))
    assert answer["status"] == "refused"
    assert f"simulate: {answer['why']}" == str(error.value)


# --- comparisons ------------------------------------------------------------------------------------------------------


def python_meeting(found: dict[str, Any]) -> carom.Meeting:
    """The meeting that the page found, for Python's laws."""
    number = lambda x: math.inf if x is None else x  # noqa: E731
    floor = found["floor"]
    return carom.Meeting(
        carom.Ball(found["radius"], found["mass"], found["kappa"]),
        carom.State(found["v"], found["w"]),
        np.array(found["n"]),
        carom.Surface(found["e"], number(found["mu"]), found["beta"]),
        carom.Surface(floor["e"], number(floor["mu"]), floor["beta"]),
        found["g"],
        found["height"],
        "with" if found["together"] else "after",
        found["stiffness"],
    )


def test_a_comparison_is_that_of_python_with_its_sentences(evaluate: Any) -> None:
    scenes = [
        one
        for seed in range(400)
        if (one := with_outlines(scene_of_all_laws(seed))).floor is not None and one.gravity[2] < 0
    ]
    code = """(all) => all.map((scene) => {
        try { return { meeting: engine.meeting(scene), verdicts: engine.compare(scene) }; }
        catch (error) { return { error: error.message }; }
    })"""
    answers = evaluate(code, [scene_dict(scene) for scene in scenes])
    seen: set[str] = set()
    compared = 0
    for answer in answers:
        if "error" in answer:
            assert answer["error"].startswith("The laws are compared at the first wall")
            continue
        meeting = python_meeting(answer["meeting"])
        if math.hypot(*meeting.normal[:2]) == 0:  # a wall above or below has no angles
            assert all(one["angle"] is None for one in answer["verdicts"])
            continue
        verdicts = carom.compare(meeting).verdicts
        assert [one["law"] for one in answer["verdicts"]] == [one.law for one in verdicts]
        compared += 1
        for found, verdict in zip(answer["verdicts"], verdicts, strict=True):
            assert found["admissible"] == verdict.admissible
            assert found["reasons"] == list(verdict.why)
            seen |= {*found["reasons"]}
            flight = verdict.answer.steps.flight if verdict.answer and verdict.answer.steps else None
            numbers = {
                "angle": verdict.reflection_angle_deg, "angle_after_wall": verdict.angle_after_wall_deg,
                "energy_kept": verdict.energy_ratio, "required": verdict.required_wall,
                "required_floor": verdict.required_floor, "hop": flight and float(flight.height),
                "flight": flight and float(flight.distance),
            }  # fmt: skip
            for name, expected in numbers.items():
                wanted = None if expected is None or not math.isfinite(expected) else expected
                assert found[name] == (None if wanted is None else pytest.approx(wanted, rel=1e-11, abs=1e-14)), name
            for name, state in (("velocity", verdict.final), ("spin", verdict.final)):
                if state is None:
                    assert found[name] is None
                else:
                    np.testing.assert_allclose(found[name], getattr(state, name), rtol=1e-10, atol=1e-12)
    assert compared > 100
    assert len(seen) > 100


def test_laws_of_cushions_are_compared_by_name_at_any_wall(evaluate: Any, tmp_path: Any) -> None:
    file = tmp_path / "paper.toml"
    file.write_text(PAPER)
    names = ["mathavan2010", "han2005", "stronge-cushion"]
    found = evaluate(f"(scene) => engine.compare(scene, {json.dumps(names)})", scene_dict(carom.load_scene(file)))
    by_name = {one["law"]: one for one in found}
    for verdict in carom.compare(laws=names).verdicts:
        assert by_name[verdict.law]["angle"] == pytest.approx(verdict.reflection_angle_deg, rel=1e-9)
        assert by_name[verdict.law]["reasons"] == list(verdict.why)


def test_a_curve_of_reflection_is_that_of_python(evaluate: Any, tmp_path: Any) -> None:
    file = tmp_path / "paper.toml"
    file.write_text(PAPER)
    scene = scene_dict(carom.load_scene(file))
    angles = [0.0, 10.0, 30.0, 45.0, 60.0, 85.0]
    for law in ("mirror", "conventional", "no-slip", "two-step", "maw", "stronge"):
        found = evaluate(f"(scene) => engine.curve({json.dumps(law)}, scene, {angles})", scene)
        verdicts = [carom.compare(carom.incoming(angle_deg=angle), [law]).verdicts[0] for angle in angles]
        np.testing.assert_allclose(found, [one.reflection_angle_deg for one in verdicts], atol=1e-9)
        found = evaluate(f"(scene) => engine.curve({json.dumps(law)}, scene, {angles}, 'wall')", scene)
        np.testing.assert_allclose(found, [one.angle_after_wall_deg for one in verdicts], atol=1e-9)


# --- the module -------------------------------------------------------------------------------------------------------


def test_the_module_needs_nothing_and_is_known_by_its_version(evaluate: Any) -> None:
    assert evaluate("async () => WebAssembly.Module.imports(await WebAssembly.compile(wasm))") == []
    assert evaluate("() => engine.version") == version()
    refused = "async (layout) => { try { await loadEngine(wasm, layout); } catch (error) { return error.message; } }"
    layout = evaluate("() => layout")
    said = evaluate(refused, {**layout, "version": "other"})
    assert said == (
        f"engine.wasm: expected the module of version other, got version {version()}; build both anew with make wasm"
    )
    said = evaluate(
        "async () => { try { await loadEngine(wasm.slice(0, 999), layout); } catch (error) { return error.message; } }"
    )
    assert said.startswith("engine.wasm: expected carom's module, got one that the browser refuses: ")


def test_laws_are_described_as_in_python(evaluate: Any) -> None:
    laws = evaluate("() => engine.laws")
    assert [law["name"] for law in laws] == [law.name for law in carom.LAWS.values() if law.kernel is not None]
    for law in laws:
        card = carom.LAWS[law["name"]]
        assert law["title"] == card.card.summary
        assert law["parameters"] == (None if card.reads is None else list(card.reads))


def test_kinds_are_named(evaluate: Any) -> None:
    # (balls and walls of a cluster have met as any others, for people)
    assert evaluate("() => layout.kinds") == list(SEEN)
