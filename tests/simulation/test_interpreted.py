"""The event loop as plain Python: the bits of the compiled loop, and runs that begin in one and end in the other."""

from __future__ import annotations

import functools
import math
from typing import Any

import numpy as np
import pytest
from reference.brute_force_scene import random_scene

import carom
from carom.simulation import loop as engine_loop
from carom.simulation.loop import ALL, compiled_engine, run_limits
from carom.simulation.records import LOG, set_up

SCENES = 40


def one_run(scene: carom.Scene, loop: Any, compiled: bool) -> tuple[Any, bytes, bytes]:
    arrays = set_up(scene, compiled)
    balls = arrays.balls_to_move()
    until, most = run_limits(scene)
    log = np.zeros(400, LOG)
    answer = loop(arrays.world, arrays.features, balls, log, -1.0, until, most, arrays.users, ALL)
    return answer, balls.tobytes(), log.tobytes()


def with_law(scene: carom.Scene, law: Any) -> carom.Scene:
    fields = {name: getattr(scene, name) for name in carom.Scene.model_fields}
    walls = [wall.model_copy(update={"tangential_restitution": 0.0}) for wall in scene.walls]
    return carom.Scene(**fields | {"walls": walls, "run": scene.run.model_copy(update={"law": law})})


@pytest.mark.parametrize("seed", range(SCENES))
def test_same_bits_as_compiled(seed: int) -> None:
    scene = random_scene(seed)
    expected = one_run(scene, compiled_engine(), True)
    assert one_run(scene, engine_loop.run_interpreted, False) == expected


@pytest.mark.parametrize("law", ["maw", "stronge"])
def test_same_bits_with_laws_that_are_called_by_address(law: str) -> None:
    for seed in range(10):
        scene = with_law(random_scene(seed), law)
        expected = one_run(scene, compiled_engine(), True)
        assert one_run(scene, engine_loop.run_interpreted, False) == expected


def test_the_loop_is_at_hand_once_it_has_been_asked_for(monkeypatch: pytest.MonkeyPatch) -> None:
    """A short run is interpreted only where it is not: were it always said to be, every first run would wait for the compiler."""
    loaded = functools.cache(lambda: None)
    monkeypatch.setattr(engine_loop, "compiled_engine", loaded)
    assert not engine_loop.is_loaded()
    loaded()
    assert engine_loop.is_loaded()


def test_a_users_law_is_compiled_for_python_too() -> None:
    def root(v: Any, w: Any, n: Any, a: float, kappa: float, e: float, mu: float, beta: float) -> Any:
        u = (v[0] * n[0] + v[1] * n[1] + v[2] * n[2]) * (1 + e**0.3)  # whose last bit depends on who computes it
        return (v[0] - u * n[0], v[1] - u * n[1], v[2] - u * n[2]), w

    card = carom.Card("root", "a law for this test", (), "", "", "")
    wall = carom.scene.Box(center=(0, 0, 0), size=(2, 1.5, 1), inside=True, restitution=0.9)
    ball = carom.SceneBall(radius=0.03, mass=0.2, position=(0.1, 0.2, 0.1), velocity=(1.0, 0.7, 0.3))
    run = carom.Run(law=carom.wall_law(card, root), max_events=50)
    scene = carom.Scene(gravity=0, walls=[wall], balls=[ball], run=run)
    expected = one_run(scene, compiled_engine(), True)
    assert one_run(scene, engine_loop.run_interpreted, False) == expected


def table(**changes: Any) -> carom.Scene:
    balls = [
        {"radius": 0.03, "mass": 0.2, "position": [0.3 * k, 0.1 * k], "velocity": [2.0 - k, 1.3]} for k in range(3)
    ]
    cushion = {"shape": "table", "length": 3.0, "width": 1.5, "restitution": 0.95, "friction": 0.1}
    fields = {"floor": {"restitution": 0.5, "friction": 0.2}, "walls": [cushion], "balls": balls}
    return carom.Scene(**fields | {"run": {"duration": 30.0, "max_events": 1000}} | changes)


@pytest.fixture
def called(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """The loops that are called, in a process that has none compiled at its beginning."""
    engine, interpreted, calls = compiled_engine(), engine_loop.run_interpreted, []

    def compiled() -> Any:
        return lambda *numbers: calls.append("compiled") or engine(*numbers)

    def python(*numbers: Any) -> Any:
        calls.append("Python")
        return interpreted(*numbers)

    monkeypatch.setattr(engine_loop, "compiled_engine", compiled)
    monkeypatch.setattr(engine_loop, "run_interpreted", python)
    monkeypatch.setattr(engine_loop, "is_loaded", lambda: False)
    monkeypatch.setattr(engine_loop, "compiled_before", lambda _scene: False)
    monkeypatch.setattr(engine_loop, "is_at_hand", lambda _loop: False)
    monkeypatch.setattr(engine_loop, "_written", 0)
    return calls


def test_a_short_run_needs_nothing_compiled(called: list[str]) -> None:
    run = carom.simulate(table())
    assert set(called) == {"Python"}
    assert run.ended == "duration"


def test_a_long_run_goes_on_in_the_compiled_loop(called: list[str], monkeypatch: pytest.MonkeyPatch) -> None:
    elastic = {
        "shape": "box",
        "size": [3, 2, 1],
        "center": [0, 0, 0],
        "inside": True,
        "restitution": 1,
        "friction": 0,
    }
    scene = table(walls=[elastic], floor=None, gravity=0.0, run={"max_events": 1000})
    monkeypatch.setattr(engine_loop, "BEFORE_COMPILING", 1)
    run = carom.simulate(scene)
    assert called[:2] == ["Python", "compiled"]
    assert "Python" not in called[1:]
    monkeypatch.setattr(engine_loop, "is_loaded", lambda: True)
    expected = carom.simulate(scene)
    assert run.log.tobytes() == expected.log.tobytes()
    assert (run.end, run.ended) == (expected.end, expected.ended)


def test_what_python_refuses_is_run_compiled(called: list[str], monkeypatch: pytest.MonkeyPatch) -> None:
    def divide(*_numbers: Any) -> Any:
        return 1 / 0

    scene = table()
    expected = carom.simulate(scene)
    monkeypatch.setattr(engine_loop, "run", divide)
    called.clear()
    assert carom.simulate(scene).log.tobytes() == expected.log.tobytes()
    assert called == ["Python", "compiled"]


@pytest.mark.parametrize(
    "restitution", [0.5, 0.999, 1.0, {"form": "exponential", "at_rest": 0.9, "at_speed": 0.5, "speed": 1.0}]
)
def test_floors_on_which_a_ball_bounces_without_end_are_left_to_compiled_code(
    called: list[str], restitution: Any
) -> None:
    scene = table(floor={"restitution": restitution, "friction": 0.2})
    assert engine_loop.worth_interpreting(scene) == (restitution in (0.5, 1.0))


def test_large_scenes_are_left_to_compiled_code(called: list[str]) -> None:
    balls = [
        {"radius": 0.03, "mass": 0.2, "position": [0.1 * (k % 10), 0.1 * (k // 10)]}
        for k in range(engine_loop.MOST_BALLS + 1)
    ]
    ring = {"shape": "polygon", "points": [[2 * math.cos(0.02 * k), 2 * math.sin(0.02 * k)] for k in range(300)]}
    ring |= {"restitution": 0.9, "friction": 0.1}
    assert engine_loop.worth_interpreting(table(balls=balls[:-1]))
    assert not engine_loop.worth_interpreting(table(balls=balls))
    assert called == []
    carom.simulate(table(walls=[ring]))
    assert set(called) == {"compiled"}
