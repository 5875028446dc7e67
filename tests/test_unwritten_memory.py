"""What memory holds before it is written is in no result: ``np.empty`` filled with anything gives the same bits."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from reference.synthetic_bounces import SETTING, measured_bounces

import carom
from carom import billiards, gas
from carom.data import make_rebounds
from carom.fitting import fit_law, make_problem
from carom.fitting.laws import laws_named
from carom.tracks.contact_models import contact_path, contact_slopes

BALL, WALL, FLOOR = carom.Ball(0.03, 0.2), carom.Surface(0.85, 0.2), carom.Surface(0.5, 0.2)
FILLS = (0x00, 0x3F, 0xC0, 0xFF)  # as numbers: zeros, 4.8e-4, -8577.5, NaN


def states(count: int) -> carom.State:
    """Balls that move towards the wall, some pressed onto the floor, some in flight."""
    rng = np.random.default_rng(count)
    v, w = rng.normal(size=(count, 3)), 30 * rng.normal(size=(count, 3))
    v[:, 0], v[:, 2] = -1 - np.abs(v[:, 0]), np.where(np.arange(count) % 3 == 2, -np.abs(v[:, 2]), 0.0)
    return carom.State(v, w)


def written_into(count: int) -> Any:
    found, why = carom.State(np.zeros((count, 3)), np.zeros((count, 3))), np.zeros(count, np.int8)
    carom.two_step_into(found, why, BALL, states(count), WALL, FLOOR, (math.sqrt(0.96), 0.0, -0.2))
    after = carom.State(np.zeros((count, 3)), np.zeros((count, 3)))
    carom.impact_into(after, BALL, states(count), surface=WALL)
    return found, why, after


def all_laws() -> Any:
    found = []
    for law in carom.LAWS.values():
        answer = law.answer(carom.Meeting(BALL, states(9), wall=WALL, floor=FLOOR))
        found += [answer.after_wall, answer.final, answer.required_wall, answer.required_floor]
    other = carom.State(-states(9).velocity, states(9).spin)
    hit = carom.collide(BALL, states(9), BALL, other, (1.0, 0.0, 0.0), WALL)
    cue = carom.strike(BALL, carom.Cue(), np.linspace(1, 2, 9), offset=(0.1, 0.2))
    return found, hit.after, hit.impulse, cue.state, cue.impulse


def table() -> carom.Scene:
    ball = carom.SceneBall(radius=0.03, mass=0.2, position=(0.4, 0.1), velocity=(-2.0, 0.3), spin=(3.0, 40.0, 5.0))
    return carom.Scene(
        floor=carom.Floor(friction=0.2, rolling_resistance=0.01),
        walls=[carom.scene.Table(length=1.2, width=1.0, nose_height=0.037, restitution=0.85, friction=0.2)],
        balls=[ball, carom.SceneBall(radius=0.03, mass=0.2, position=(0.1, 0.05))],
        run=carom.Run(duration=3.0),
    )


def runs() -> Any:
    found = []
    for limit in ({"max_events": 6}, {}):  # (as Python, and compiled)
        run = carom.simulate(table(), **limit)
        slopes = run.sensitivity(["balls.0.velocity", "walls.0.friction"])
        found += [run.log, run.at(np.linspace(0, run.end, 40)), run.final, slopes.final, slopes.at(0.4)]
    many = carom.simulate_many(table(), velocity=[[[-2, 0.3, 0], [0, 0, 0]], [[-1, 0.2, 0], [0, 0, 0]]], events=10)
    few = carom.sensitivities(table(), ["balls.0.spin"], velocity=[[[-2, 0.3, 0], [0, 0, 0]]])
    return found, many, few


def orbits() -> Any:
    found = []
    for shape in (billiards.polygon([(0, 0), (2, 0), (1, 1.5)]), billiards.stadium(), billiards.sinai()):
        place = billiards.starts(shape, 17, seed=3)
        found += [billiards.final(shape, place, 200), billiards.orbit(shape, place, 20)]
        found += [billiards.tangent_map(shape, place, 3), billiards.lyapunov(shape, place, 50)]
        found.append(shape.make(0.0).place(np.linspace(0, 3, 7)))
    return found


def gases() -> Any:
    rough = carom.Surface(0.9, 0.3, 0.5)
    one = gas.Gas([gas.Species(carom.Ball(0.5, 1.0), 60)], (9.0, 9.0, 9.0), contacts=rough, seed=4)
    one.run(500)
    measures = gas.Measures(one)
    measures.sample(one)
    return one.balls(), one.energy(), measures


def tracks() -> Any:
    t = np.linspace(0, 1, 30)
    theta = np.array([0.4, 0.0, 0.1, -1.2, 0.3, 0.5, 2.2, 1.0, 0.2, 0.3, -0.1, 2.0, 0.1, 0.1])
    return contact_path(theta, 0.0, t, 2 / 7), contact_slopes(theta, 0.0, t, 2 / 7)


def fits() -> Any:
    law = laws_named(["contact"], "planar", True)[0][0]
    problem = make_problem(make_rebounds("planar", measured_bounces(1, 40)), SETTING)[0]
    found = fit_law(law, problem)
    return found


def sweeps() -> Any:
    space = carom.Space(table(), {"balls.0.velocity": carom.polar([1.0, 2.0], np.linspace(100, 170, 8))}, seed=5)
    found = carom.sweep(space, ["final.position", "events.wall.count", "events.wall.0.position"]).run()
    return [found[name].values for name in found.data_vars]


JOBS: dict[str, Callable[[], Any]] = {
    "written into": lambda: [written_into(count) for count in (1, 3, 9)],
    "laws": all_laws, "runs": runs, "orbits": orbits, "gases": gases, "tracks": tracks, "fits": fits,
    "sweeps": sweeps,
}  # fmt: skip


def numbers(found: Any, depth: int = 6) -> list[bytes]:
    """The bytes of all numbers and arrays in a result, whatever holds them."""
    if isinstance(found, np.ndarray) and not found.dtype.hasobject:
        return [np.ascontiguousarray(found).tobytes()]
    if isinstance(found, float | int | complex | str | bool | np.generic) or found is None or depth == 0:
        return [repr(found).encode()]
    if isinstance(found, dict):
        parts = list(found.values())
    elif isinstance(found, list | tuple):
        parts = list(found)
    else:
        parts = list(vars(found).values()) if hasattr(found, "__dict__") else []
    return [one for part in parts for one in numbers(part, depth - 1)]


@pytest.mark.parametrize("job", JOBS)
@pytest.mark.slow(keep=4)
def test_what_was_in_memory_is_in_no_result(job: str, monkeypatch: pytest.MonkeyPatch) -> None:
    expected = numbers(JOBS[job]())  # (which compiles, too: the compiler knows NumPy's own functions only)
    plain = {"empty": np.empty, "empty_like": np.empty_like}
    for fill in FILLS:
        for name, allocate in plain.items():

            def filled(*args: Any, allocate: Any = allocate, fill: int = fill, **options: Any) -> Any:
                array = allocate(*args, **options)
                if not array.dtype.hasobject:
                    array.reshape(-1).view(np.uint8)[:] = fill
                return array

            monkeypatch.setattr(np, name, filled)
        got = numbers(JOBS[job]())
        monkeypatch.undo()
        assert got == expected, f"{job}: memory that holds {fill:#x} changes what comes out"
