"""What is no scene, or one that cannot be run, is refused in the page as by Python: the same fields, in sentences."""

from __future__ import annotations

import contextlib
import copy
import random
import re
from collections.abc import Iterator
from typing import Any

import pytest
from reference.scenes_of_all_laws import with_infinities

import carom
from carom.scene.scene import scene_dict
from carom.scene.shapes import PAGE_SHAPES, SHAPES

WALL = {"restitution": 0.9, "friction": 0.2}
POCKETS = {"mouth": 0.12, "jaw_angle": 140.5, "jaw_radius": 0.01, "shelf": 0.04, "radius": 0.06}


def good() -> dict[str, Any]:
    """A scene of several shapes, far from the ball, as JSON."""
    far = 5.0
    walls = [
        {"shape": "table", "length": 2.84, "width": 1.42, "nose_height": 0.037, **WALL},
        {"shape": "plane", "point": [-far, 0, 0], "normal": [1, 0, 0], **WALL},
        {"shape": "cylinder", "point": [far, far, 0], "radius": 0.2, **WALL},
        {"shape": "arc", "center": [far, 0], "radius": 0.5, "from_angle": 0, "to_angle": 90, "height": 0.2, **WALL},
        {"shape": "polygon", "points": [[far, 1], [far + 1, 1], [far, 2]], **WALL},
        {"shape": "wedge", "apex": [-9, 0, 0], "from_angle": -60, "to_angle": 60, **WALL},
        {"shape": "segment", "start": [far, -1], "end": [far, -2], **WALL},
        {"shape": "box", "center": [far, 9, 0], "size": [1, 1, 1], **WALL},
        {"shape": "sphere", "center": [far, 19, 0], "radius": 1.0, **WALL},
        {"shape": "sphere", "center": [0, 0, 0], "radius": 18, "inside": True, **WALL},
        {"shape": "strip", "point": [-9, 0, 0], "normal": [1, 0, 0], "width": 50, **WALL},
    ]
    balls = [
        {"radius": 0.03, "mass": 0.2, "position": [0.5, 0.1], "velocity": [-1, 0.2], "rolling": True},
        {"radius": 0.03, "mass": 0.2, "position": [0.2, 0.2], "spin": [1, 2, 3]},
    ]
    return scene_dict(carom.Scene(floor={"friction": 0.2}, walls=walls, balls=balls))


# Where, what is put there, and whether Python names the very field.
CHANGES: list[tuple[str, Any]] = [
    ("balls[0].radius", -1), ("balls[0].radius", "x"), ("balls[0].radius", None), ("balls[0].mass", 0), ("balls[0].mass", 1e200),
    ("balls[0].inertia", 0.7), ("balls[0].inertia", "soft"), ("balls[0].position", [1]), ("balls[0].velocity[1]", "fast"),
    ("balls[0].velocity[2]", 1.0), ("balls[0].rolling", 1), ("balls[0].spin", [1, 1, 1]), ("balls[0].name", 3),
    ("balls[0].position", [0.5, 0.1, 0.02]), ("balls[0].position", [0.5, 0.1, 0.4]), ("balls[0].position", [1.40, 0.1, 0.03]),
    ("balls[1].position", [0.52, 0.1, 0.03]), ("balls[1].position", [3.0, 0.1, 0.03]), ("balls", []), ("balls", 3),
    ("gravity", [0, 0]), ("gravity", [0, 1, -9.8]), ("gravity", [0, 0, 9.8]), ("floor.friction", -0.1), ("floor.friction", "often"),
    ("floor.restitution", {"form": "cubic"}), ("floor.restitution", {"form": "constant", "value": 1.2}),
    ("floor.tangential_restitution", 2), ("floor.rolling_resistance", -1), ("floor.spin_friction", "inf"),
    ("ball_contact.friction", -1), ("ball_contact.restitution", {"form": "power", "at_rest": 1, "speed": 0, "exponent": 1}),
    ("run.law", "newton"), ("run.duration", 0), ("run.max_events", 0), ("run.max_events", 1.5), ("run.floor_contact", "before"),
    ("walls", {}), ("walls[0].shape", "torus"), ("walls[0].length", 0), ("walls[0].nose_height", 0.07), ("walls[0].height", 0.01),
    ("walls[0].width", 0.05),
    ("walls[0].sides", {"right": {"restitution": 2}}), ("walls[0].sides", {"nroth": {}}),
    ("walls[0].stiffness_ratio", 0), ("walls[0].friction", None), ("walls[0].restitution", None),
    ("walls[0].law", "maw!"), ("walls[1].normal", [0, 0, 0]), ("walls[1].point", [0.49, 0, 0]), ("walls[1].point", [9, 0, 0]),
    ("walls[2].radius", -1), ("walls[2].height", 0), ("walls[2].axis", [0, 0]), ("walls[2].inside", "yes"),
    ("walls[3].to_angle", -1), ("walls[3].to_angle", 361), ("walls[3].low", 0.3), ("walls[4].points", [[0, 0], [1, 1]]),
    ("walls[4].points", [[5, 1], [6, 2], [6, 1], [5, 2]]), ("walls[4].points", [[5, 1], [5, 1], [6, 1], [5, 2]]),
    ("walls[5].from_angle", 90), ("walls[6].end", [5.0, -1.0]), ("walls[7].center", None), ("walls[7].size", [1, 1, 0]),
    ("walls[7].corner", [1, 1, 1]), ("walls[8].radius", 25.0), ("walls[9].radius", 0.01), ("walls[10].width", 9.0),
    ("walls[0].corner_pockets", 3), ("walls[0].corner_pockets", POCKETS | {"depth": 1}), ("walls[0].side_pockets", {"mouth": 0.1}),
    ("walls[0].corner_pockets", POCKETS | {"jaw_angle": 80}), ("walls[0].corner_pockets", POCKETS | {"mouth": 1.4}),
    ("walls[0].corner_pockets", POCKETS | {"shelf": 0.2}), ("walls[0].corner_pockets", POCKETS | {"radius": 0.03}),
    ("walls[0].corner_pockets", POCKETS | {"shelf": -0.12, "radius": 2.2}),
]  # fmt: skip


def changed(path: str, value: Any, scene: dict[str, Any] | None = None) -> dict[str, Any]:
    """The good scene, or another one, with a value at a path that it has."""
    table = copy.deepcopy(scene or good())
    place: Any = table
    *steps, last = path.replace("[", ".[").split(".")
    with contextlib.suppress(KeyError, TypeError, IndexError):  # (another change may have taken the place away)
        for step in steps:
            place = place[int(step[1:-1])] if step.startswith("[") else place[step]
        if last.startswith("[") == isinstance(place, list):
            place[int(last[1:-1]) if last.startswith("[") else last] = value
    return table


# Python also guesses a name, or explains units, which the page does not take.
GUESS = re.compile(
    r"; (carom.wall_law|did you mean|known are|units are written|is '|expected a number and a unit|write \[\[).*$"
)


def said_by_python(scene: dict[str, Any]) -> list[str]:
    """The faults that Python finds in a scene, in the page's words: the shapes of the page, and no guesses."""
    try:
        carom.Scene(**with_infinities(scene))
    except carom.CaromError as error:
        said = [
            fault.removeprefix("Scene: ").replace(", ".join(SHAPES), ", ".join(PAGE_SHAPES)) for fault in error.faults
        ]
        return [GUESS.sub("", fault) for fault in said]
    return []


def leaves(part: Any, path: str = "") -> list[str]:
    """The paths of all values of a scene, parts and lists too."""
    inside = list(part.items()) if isinstance(part, dict) else list(enumerate(part)) if isinstance(part, list) else []
    own = [f"{path}.{name}".strip(".") if isinstance(part, dict) else f"{path}[{name}]" for name, _value in inside]
    return [*own, *(one for at, (_name, value) in zip(own, inside, strict=True) for one in leaves(value, at))]


VALUES: tuple[Any, ...] = (
    -1, 0, 0.5, 7, -0.25, 350, 1e-5, 2.5e20, 1e200, 1e-200, "x", "it's", "inf", None, True, False, [1], [0, 0], [0, 0, 0],
    [0.5, 0.1, 0.02], [1, 2, 3, 4], {"form": "power", "at_rest": 1, "speed": 0, "exponent": 0.5}, POCKETS,
    {"at_rest": 0.1, "at_speed": 0.25, "speed": 0.5}, "maw", "conventional", "two-step",
)  # fmt: skip
# The page's scenes have a form for every restitution, and all that a preset fills.
NOT_ASKED = ("shape", "preset", "restitution", "gravity")


def wrong_scenes(seed: int, count: int) -> Iterator[dict[str, Any]]:
    """Yield the good scene with some other values, most of them wrong."""
    draw, known = random.Random(seed), leaves(good())
    paths = [path for path in known if not path.endswith(NOT_ASKED)]
    parts = {path.rpartition(".")[0] for path in known}
    for _ in range(count):
        scene = good()
        for path in draw.sample(paths, draw.choice((1, 1, 2, 4))):
            value = draw.choice(VALUES)
            if value == "inf" and path.endswith("name"):
                value = "Inf"
            if not (isinstance(value, dict) and path in parts):
                scene = changed(path, value, scene)
        yield scene


@pytest.mark.parametrize("seed", [40])
def test_wrong_scenes_are_refused_in_the_words_of_python(evaluate: Any, seed: int) -> None:
    scenes = list(wrong_scenes(seed, 300))
    answers = evaluate("(all) => all.map((scene) => engine.faults(scene))", scenes)
    for scene, found in zip(scenes, answers, strict=True):
        assert found == said_by_python(scene)
    told = {re.sub(r"[-\d.e+]+", "0", fault) for found in answers for fault in found}
    assert len(told) > 100


def test_a_good_scene_has_no_faults(evaluate: Any) -> None:
    assert evaluate("(scene) => engine.faults(scene)", good()) == []


@pytest.mark.parametrize(("path", "value"), CHANGES)
def test_what_python_refuses_is_refused_at_the_same_places(evaluate: Any, path: str, value: Any) -> None:
    table = changed(path, value)
    found = evaluate("(scene) => engine.faults(scene)", table)
    assert found
    assert found == said_by_python(table)
    said = evaluate("(scene) => { try { engine.run(scene); } catch (error) { return error.message; } }", table)
    assert said == "\n".join(found)


@pytest.mark.parametrize("value", [None, 3, "scene", [], {}, {"walls": [3], "balls": [None]}, {"walls": None}])
def test_what_is_no_scene_at_all_is_refused(evaluate: Any, value: Any) -> None:
    found = evaluate("(scene) => engine.faults(scene)", value)
    assert found
    assert all(": expected " in fault for fault in found)


@pytest.mark.parametrize("law", ["conventional", "maw", "stronge", "contact"])
def test_a_law_put_at_all_walls_is_checked(evaluate: Any, law: str) -> None:
    table = good()
    table["run"]["law"] = law
    table["walls"][0] |= {"tangential_restitution": 0.5, "stiffness_ratio": 50.0}
    faults: tuple[str, ...] = ()
    try:
        carom.Scene(**with_infinities(table))
    except carom.CaromError as error:
        faults = error.faults
    expected = {fault.removeprefix("Scene: ").split(": expected ")[0] for fault in faults}
    found = evaluate("(scene) => engine.faults(scene)", table)
    walls = {place.split(".")[0] for place in expected}
    assert {fault.split(": expected ")[0].split(".")[0] for fault in found} == walls


def test_a_scene_too_large_and_a_run_too_long_are_said(evaluate: Any) -> None:
    table = good()
    ball = table["balls"][1]
    table["balls"] = [{**ball, "position": [x / 20 - 1, y / 10 - 0.5, 0.03]} for x in range(20) for y in range(6)]
    found = evaluate("(scene) => engine.faults(scene)", table)
    assert len(found) == 1
    assert found[0] == ("balls: expected at most 100, got 120; carom simulate takes more")
    table["walls"][0]["nose_height"] = None
    for ball in table["balls"]:
        ball["radius"] = 0.01
    table["balls"] = table["balls"][:90]
    for i, ball in enumerate(table["balls"]):
        ball["velocity"] = [1.0, 0.1 * i, 0.0]
    run = evaluate("(scene) => engine.run(scene, 'mirror', { events: 1e6, milliseconds: 50 })", table)
    assert run["status"] == "time"
    assert 0 < len(run["events"]) < 1e6
