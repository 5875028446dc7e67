"""The engine in a browser against the engine in Python: random scenes of all shapes, laws and forms of restitution (or 300).

Where no function of libm is called, the records of the scene and of its log have the same bytes. Where one is, the browser's
(musl's) and Python's (the platform's) may differ in the last digit: then every number is within 1e-12 times what a change of the
start by one unit in the last place grows to.
"""

from __future__ import annotations

import base64
import math
from typing import Any

import numpy as np
import pytest
from reference.air_events import drawn_room
from reference.exploring import tried
from reference.scenes_of_all_laws import may_call_libm, scene_of_all_laws
from reference.table_shots import shot

import carom
from carom.core.geometry.features import CURVE, FEATURES, RIM
from carom.explorer.page import with_outlines
from carom.scene.presets import presets
from carom.scene.scene import scene_dict
from carom.simulation.loop import ALL, LIMIT, compiled_engine
from carom.simulation.records import BALLS, KINDS, LOG, WORLD, set_up

SCENES, EVENTS, SHOTS = tried(150, 300), 200, 12
TOLERANCE = 1e-12
# Numbers of a log that share a scale.
SCALES = (("t",), ("x",), ("v_before", "v"), ("w_before", "w"), ("impulse", "floor_impulse"))


def followed(scene: carom.Scene, nudge: bool = False) -> tuple[int, np.ndarray]:
    """Return how a run of a scene ends in Python, and its log; with ``nudge``, from a start that is one last digit away."""
    setup = set_up(scene)
    balls = setup.balls_to_move()
    if nudge:
        for field in ("v", "w"):
            away = np.nextafter(balls[field], np.copysign(math.inf, balls[field]))
            balls[field] = np.where(balls[field] == 0, 0.0, away)
    log = np.zeros(2 * EVENTS + 4 * len(balls), LOG)
    most = min(EVENTS, scene.run.max_events or EVENTS)
    until = math.inf if scene.run.duration is None else scene.run.duration
    run = compiled_engine()
    status, _events, rows, *_rest = run(setup.world, setup.features, balls, log, -1.0, until, most, setup.users, ALL)
    return status, log[:rows]


def same_events(one: np.ndarray, two: np.ndarray) -> int:
    """Return how many events two logs have in common, from the first on."""
    n = min(len(one), len(two))
    equal = np.all([one[name][:n] == two[name][:n] for name in ("kind", "ball", "met", "other", "phase")], axis=0)
    return n if equal.all() else int(np.argmin(equal))


def excess(python: np.ndarray, browser: np.ndarray, nudged: np.ndarray) -> float:
    """Return the largest difference between two logs over what is allowed, as far as a nudged start changes no event."""
    rows = same_events(python, nudged)
    assert same_events(python[:rows], browser) == rows
    largest = 0.0
    for names in SCALES:
        scale = max(float(np.abs(python[name][np.isfinite(python[name])]).max(initial=0.0)) for name in names)
        if scale == 0:
            continue
        for name in names:
            values = [log[name][:rows].reshape(rows, -1) for log in (python, browser, nudged)]
            change, grown = (np.abs(values[k] - values[0]).max(axis=1) / scale for k in (1, 2))
            growth = np.maximum.accumulate(np.maximum(grown / np.finfo(float).eps, 1.0))
            largest = max(largest, float((change / (TOLERANCE * growth)).max(initial=0.0)))
    return largest


def records(text: str, kind: np.dtype[Any]) -> np.ndarray:
    return np.frombuffer(base64.b64decode(text), kind)


@pytest.fixture(scope="module")
def scenes() -> list[carom.Scene]:
    found = [with_outlines(scene_of_all_laws(seed)) for seed in range(SCENES)]
    found += [*map(in_air, range(4)), *(table for seed in range(SHOTS) for table in tables(seed))]
    return found + [with_outlines(one) for one in curves()]


def curves() -> list[carom.Scene]:
    """Return rooms, a post and an open line that are smooth curves: a flower, an ellipse, a parabola; on a floor and in the air."""
    flower = {
        "shape": "curve",
        "r": "1 + 0.1*cos(5*theta)",
        "restitution": 0.9,
        "friction": 0.2,
        "center": [0.1, 0.2],
        "angle": 12,
    }
    post = {"shape": "curve", "r": "0.1 + 0.02*cos(3*theta)", "inside": False, "law": "mirror"}
    line = {
        "shape": "curve",
        "x": "0.6*s - 0.3",
        "y": "0.6 - 0.4*(s - 0.5)**2",
        "closed": False,
        "restitution": 0.8,
        "friction": 0.1,
    }
    oval = {"shape": "ellipse", "half_axes": [1.0, 0.6], "restitution": 0.95, "friction": 0.1}
    ball = {"radius": 0.03, "mass": 0.2, "position": [0.3, 0.1], "velocity": [1.5, 0.7], "rolling": True}
    other = {**ball, "position": [-0.3, -0.2], "velocity": [0.4, -2.0]}
    thrown = {
        "radius": 0.04,
        "mass": 0.1,
        "position": [0.3, 0.0, 0.5],
        "velocity": [1.0, 2.0, 1.0],
        "spin": [1.0, 2.0, 3.0],
    }
    floor = {"restitution": 0.5, "friction": 0.2, "rolling_resistance": 0.01}
    run = {"law": "two-step", "duration": 6, "max_events": EVENTS}
    return [
        carom.Scene(floor=floor, walls=[flower, post, line], balls=[ball, other], run=run),
        carom.Scene(floor=floor, walls=[oval], balls=[ball, thrown], run=run),
        carom.Scene(
            gravity=[0, -1, 0], walls=[{**flower, "friction": 0.0}], balls=[{**thrown, "position": [0, 0, 0]}], run=run
        ),
    ]


def in_air(seed: int) -> carom.Scene:
    """Return a scene with flights in air, under laws by name and numbers."""
    room = drawn_room(seed)
    drag = ("table-tennis", "smooth-sphere", 0.5, 0.3)[seed]
    return carom.Scene(**{
        **{name: getattr(room, name) for name in ("air", "floor", "walls", "run")},
        "balls": [ball.model_copy(update={"drag": drag, "lift": "tennis" if seed < 3 else 0.2}) for ball in room.balls],
    })  # fmt: skip


def tables(seed: int) -> list[carom.Scene]:
    """Return a shot on each real table, and one on low cushions, with a limit of time."""
    run = {"duration": 6, "max_events": EVENTS}
    low = shot("pool-8ft", seed, 3, wall={"height": 0.04, "center": (0.1, -0.2)}, run=run)
    sides = {"right": {"restitution": 0.7, "friction": 0.1}, "top": {"restitution": {"form": "han-2005"}}}
    own = [shot(name, seed, 3, wall={"sides": sides}, run=run) for name in ("carom", "pool-9ft")]
    return [low, *own, *(shot(name, seed, 3, run=run) for name in presets())]


@pytest.fixture(scope="module")
def answers(scenes: list[carom.Scene], engine_page: Any) -> list[dict[str, Any]]:
    asked = [scene_dict(scene) for scene in scenes]
    code = f"(all) => all.map((scene) => recordsOf(engine, scene, {{ events: {EVENTS}, milliseconds: 1e9 }}))"
    found: list[dict[str, Any]] = engine_page.evaluate(code, asked)
    return found


def test_a_scene_becomes_the_same_records(scenes: list[carom.Scene], answers: list[dict[str, Any]]) -> None:
    for scene, answer in zip(scenes, answers, strict=True):
        setup = set_up(scene)
        features = setup.features.copy()
        curved, found = features["kind"] == CURVE, records(answer["features"], FEATURES).copy()
        for one in (features, found):  # (without addresses)
            one["at"][curved | (one["kind"] == RIM)] = 0
            one["lo1"][curved] = 0
        assert records(answer["world"], WORLD).tobytes() == setup.world.tobytes()
        assert records(answer["balls"], BALLS).tobytes() == setup.balls.tobytes()
        assert found.tobytes() == features.tobytes(), scene


def test_a_run_has_the_same_bits_where_no_function_of_libm_is_called(
    scenes: list[carom.Scene], answers: list[dict[str, Any]]
) -> None:
    plain = equal = events = 0
    kinds: set[str] = set()
    for scene, answer in zip(scenes, answers, strict=True):
        status, log = followed(scene)
        found = np.concatenate([records(part, LOG) for part in answer["log"]])
        events += len(log)
        kinds |= {KINDS[kind] for kind in log["kind"]}
        plain += not may_call_libm(scene)
        if found.tobytes() == log.tobytes():
            equal += 1
            assert (answer["status"] == "limit") == (status == LIMIT)
            continue
        assert may_call_libm(scene), scene
        assert excess(log, found, followed(scene, nudge=True)[1]) < 1, scene
    # (what the comparison covers)
    assert plain > 0.25 * SCENES
    assert equal > 0.9 * SCENES
    assert events > 20 * SCENES
    assert {"start", "wall", "floor", "ball", "phase", "settled", "left", "held", "pocketed"} <= kinds


def test_the_random_scenes_cover_all_shapes_laws_and_forms(scenes: list[carom.Scene]) -> None:
    assert len({wall.kind for scene in scenes for wall in scene.walls}) == 11
    names = {law.name for scene in scenes for law in scene.laws}
    assert names == {law.name for law in carom.LAWS.values() if law.kernel is not None}
    forms = {getattr(wall.restitution, "form", "constant") for scene in scenes for wall in scene.walls}
    assert forms == {"constant", "polynomial", "han-2005", "power", "viscoelastic", "exponential"}
