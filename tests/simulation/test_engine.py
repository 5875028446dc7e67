"""The event engine against brute force, against conservation, against the paper, and against itself."""

import hashlib
import math
import os
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from reference.brute_force_scene import judge, random_scene
from reference.exploring import tried
from reference.forking import forking

import carom
from carom.core.motion.phases import HELD

A = 0.03
G = 9.80665


def scene(*balls: dict[str, Any], **more: Any) -> carom.Scene:
    return carom.Scene(balls=[{"radius": A, "mass": 0.2, **one} for one in balls], **more)


def total(scene: carom.Scene, v: Any, w: Any, x: Any) -> Any:
    """Energy (...) of all balls, from velocities, spins, positions (..., B, 3)."""
    m = np.array([one.mass for one in scene.balls])
    moment = np.array([one.mass * one.ball.kappa * one.radius**2 for one in scene.balls])
    kinetic = m * (v**2).sum(-1) / 2 + moment * (w**2).sum(-1) / 2
    return (kinetic - m * (x @ np.array(scene.gravity))).sum(-1)


# --- brute force -------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("first", range(0, 400, 50))
@pytest.mark.slow(keep=1)
def test_no_event_is_missed_and_none_is_made_up(first: int) -> None:
    # campaigns/no_event_missed.py does a hundred thousand
    for seed in range(first, first + tried(15, 50)):
        fault, row, size, _steps = judge(carom.simulate(random_scene(seed)))
        assert not fault, f"scene {seed}, row {row}: {fault} ({size:.3g})"


# a ball pushed on a leaning wall at the very instant at which it is about to strike the floor
@pytest.mark.parametrize("seed", [1038080, 1062619])
def test_scenes_that_were_once_wrong(seed: int) -> None:
    fault, row, size, _steps = judge(carom.simulate(random_scene(seed)))
    assert not fault, f"row {row}: {fault} ({size:.3g})"


def test_a_ball_is_led_round_an_arc_that_returns_nothing() -> None:
    # in hops of up to a thousandth of its speed, which the judge once took for another outcome
    arc = {"shape": "arc", "center": [0, 0], "radius": 0.24, "from_angle": -90, "to_angle": 180, "restitution": 0}
    ball = {"position": (0.1, -0.15, 0), "velocity": (1.2, 1.9, 0.0)}
    world = scene(ball, walls=[arc], gravity=0, floor=None, run={"law": "mirror", "duration": 1, "max_events": 60})
    run = carom.simulate(world)
    fault, row, size, _steps = judge(run)
    assert not fault, f"row {row}: {fault} ({size:.3g})"
    assert len(run.events.of("wall")) > 10


def test_brute_force_finds_what_is_wrong() -> None:
    # a run with one event taken out, put in twice, late, or with another outcome
    found = set()
    for seed in range(60):
        run = carom.simulate(random_scene(seed))
        hard = (run.log["kind"] == 1) & (np.abs(run.log["impulse"]).sum(-1) > 0.05)
        walls = np.flatnonzero(hard & (run.log["phase"] < HELD))
        if len(walls) < 2:
            continue
        log, k = run.log, walls[0]
        late, other = log.copy(), log.copy()
        late["t"][k] += 1e-7
        other["v"][k] *= 1.01
        for name, wrong in (
            ("missed", np.delete(log, k)),
            ("doubled", np.insert(log, k, log[k])),
            ("late", late),
            ("other", other),
        ):
            if judge(carom.Trajectory(run.scene, wrong, run.end, run.ended))[0]:
                found.add((name, seed))
            else:
                found.add((name, None))
    assert {name for name, seed in found if seed is not None} == {"missed", "doubled", "late", "other"}
    assert ("missed", None) not in found
    assert ("late", None) not in found


@pytest.mark.parametrize("seed", range(0, 200, tried(8, 4)))
def test_a_run_is_where_it_says_at_every_event(seed: int) -> None:
    run = carom.simulate(random_scene(seed))
    t = np.unique(run.events.t)
    last = {(float(row["t"]), int(row["ball"])): row for row in run.log}
    state = run.at(t)
    for (when, i), row in last.items():
        if row["phase"] < 6:
            k = np.searchsorted(t, when) if when > 0 else 0
            if len(t) and t[k] == when:
                assert state.position is not None
                assert np.array_equal(state.position[k, i], row["x"])
                assert np.array_equal(state.velocity[k, i], row["v"])
    assert (np.diff(run.log["t"]) >= 0).all()


# --- energy ------------------------------------------------------------------------------------------------------------

ROOM = {"shape": "box", "center": [0, 0, 0], "size": [1, 1, 1], "inside": True}
DISCS = [{"shape": "cylinder", "point": [x, y, 0], "radius": 0.1} for x, y in ((0.2, 0.2), (-0.25, 0.1), (0.05, -0.3))]
SPHERES = [{"shape": "sphere", "center": [x, y, z], "radius": 0.12} for x, y, z in ((0.2, 0.2, 0.1), (-0.2, 0.1, -0.2))]
GAP = {"shape": "polygon", "points": [[-0.5, -0.4], [0.4, -0.5], [0.1, 0.0], [0.6, 0.5], [-0.4, 0.45]]}
MOVES = {"position": [-0.3, -0.3, 0.0], "velocity": [0.8, 0.55, 0.31], "spin": [3.0, -8.0, 5.0]}
CONSERVING = {
    "polygon, no-slip": ([GAP], "no-slip", 0.0),
    "polygon, mirror": ([GAP], "mirror", 0.0),
    "box with spheres, no-slip": ([ROOM, *SPHERES], "no-slip", 0.0),
    "box with spheres, mirror": ([ROOM, *SPHERES], "mirror", 0.0),
    "box with discs, two-step of a superball": ([ROOM, *DISCS], "two-step", 0.0),
    "box with gravity, no-slip": ([ROOM], "no-slip", G),
    "box with gravity and spheres, mirror": ([ROOM, *SPHERES], "mirror", G),
}


@pytest.mark.parametrize(("walls", "law", "g"), CONSERVING.values(), ids=CONSERVING.keys())
@pytest.mark.slow(keep=1)
def test_energy_does_not_drift_over_a_million_events(walls: Any, law: str, g: float) -> None:
    surface = {"restitution": 1.0, "friction": math.inf, "tangential_restitution": 1.0}
    world = scene(
        MOVES, walls=[{**wall, **surface} for wall in walls], gravity=g, run={"law": law, "max_events": 1_000_000}
    )
    many = carom.simulate_many(world)
    assert many.count.tolist() == [1_000_000]
    start = world.balls[0].state
    assert start.position is not None
    assert many.final.position is not None
    before = total(world, start.velocity[None], start.spin[None], start.position[None])
    after = total(world, many.final.velocity[0], many.final.spin[0], many.final.position[0])
    # (from the floor of the box up, so that the potential energy has the size of the other)
    floor = 0.2 * g * 0.5
    assert after + floor == pytest.approx(before + floor, rel=1e-12)


@pytest.mark.parametrize("seed", range(1, 400, tried(12, 4)))
def test_energy_never_grows(seed: int) -> None:
    run = carom.simulate(random_scene(seed))
    if len(run.scene.balls) == 1:  # event by event, and from event to event
        t = np.unique(run.events.t)
        t = t[t < run.end] if {"held", "left"} & set(run.final_phase) else t
        energy = np.array([run.energy(0.0), *np.atleast_1d(run.energy(t))]) if len(t) else np.array([run.energy(0.0)])
        scale = np.abs(energy).max() + run.scene.balls[0].mass * abs(run.scene.gravity[2])
        assert (np.diff(energy) <= 1e-12 * scale).all()
    for event in run.events.of("wall", "floor"):
        assert event.energy_lost >= -1e-12 * carom.kinetic_energy(run.scene.balls[event.ball].ball, event.before)


# --- back to the start ---------------------------------------------------------------------------------------------------


def there_and_back(world: carom.Scene, count: int) -> float:
    """How far from its start a ball is that is sent back after so many events (m)."""
    out = carom.simulate(world.model_copy(update={"run": world.run.model_copy(update={"max_events": count})}))
    assert len(out.events) == count
    event = out.events[-1]
    assert event.before.position is not None
    # from just before the last event, so that it is not met again
    one = world.balls[0].model_copy(
        update={
            "position": tuple(event.before.position.tolist()),
            "velocity": tuple((-event.before.velocity).tolist()),
            "spin": tuple((-event.before.spin).tolist()),
        }
    )
    back = carom.simulate(
        world.model_copy(
            update={"balls": (one,), "run": world.run.model_copy(update={"duration": event.t, "max_events": None})}
        )
    )
    assert len(back.events) >= count - 1
    start = world.balls[0].state
    assert back.final.position is not None
    assert start.position is not None
    return float(
        max(
            np.abs(back.final.position[0] - start.position).max(),
            np.abs(back.final.velocity[0] + start.velocity).max() / 1.0,
            A * np.abs(back.final.spin[0] + start.spin).max(),
        )
    )


@pytest.mark.parametrize("law", ["mirror", "no-slip"])
@pytest.mark.parametrize("kappa", [0.4, 0.5, 2 / 3])
def test_thirty_events_among_discs_run_backwards(law: str, kappa: float) -> None:
    # four large discs, whose bulging sides are the walls of a small room: every blow disperses, none so much that an error
    # of 1e-16 at the start could grow past 1e-9 in thirty
    discs = [
        {"shape": "cylinder", "point": [10.5 * x, 10.5 * y, 0], "radius": 10.0}
        for x, y in ((1, 0), (0, 1), (-1, 0), (0, -1))
    ]
    square = {"shape": "polygon", "points": [[-0.9, -0.9], [0.9, -0.9], [0.9, 0.9], [-0.9, 0.9]]}
    start = {
        **MOVES,
        "position": [-0.1, 0.2, 0.0],
        "velocity": [0.8, 0.55, 0.0],
        "spin": [0.0, 0.0, 5.0],
        "inertia": kappa,
    }
    world = scene(start, walls=[square, *discs], gravity=0.0, run={"law": law})
    run = carom.simulate(world.model_copy(update={"run": world.run.model_copy(update={"max_events": 30})}))
    assert (run.events.rows["other"] > 0).sum() >= 25
    assert there_and_back(world, 30) <= 1e-9


@pytest.mark.parametrize("angle", [0.0, 30.0, math.sqrt(2) * 20])
@pytest.mark.parametrize("law", ["mirror", "no-slip"])
def test_ten_thousand_events_of_a_polygon_run_backwards(law: str, angle: float) -> None:
    c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
    sides = {"shape": "polygon", "points": [[-0.5, -0.5], [0.5, -0.5], [0.5 + 0.3 * s, 0.2 * c + 0.3], [-0.5, 0.5]]}
    start = {**MOVES, "velocity": [0.8, 0.55, 0.0], "spin": [0.0, 0.0, 5.0]}
    world = scene(start, walls=[sides], gravity=0.0, run={"law": law})
    assert there_and_back(world, 10_000) <= 1e-9


# --- the paper -----------------------------------------------------------------------------------------------------------


def paper(floor: dict[str, Any], speed: float = 1.0) -> carom.Trajectory:
    v = speed / math.sqrt(2)
    wall = {"shape": "plane", "point": [0, 0, 0], "normal": [1, 0, 0], "restitution": 1.0, "friction": math.inf}
    start = {"position": [0.5, 0.0], "velocity": [-v, v], "rolling": True}
    return carom.simulate(scene(start, floor=floor, walls=[wall], gravity=G, run={"duration": 30.0}))


def test_the_papers_example() -> None:
    run = paper({"restitution": 0.0, "friction": math.inf})
    wall, landed = run.events[0], run.events[1]
    assert run.events.kinds[:2] == ["wall", "floor"]
    v = 1 / math.sqrt(2)
    # (40): away from the wall with all the speed, 5/7 along it, 2/7 up
    assert wall.after.velocity == pytest.approx([v, 5 / 7 * v, 2 / 7 * v], abs=1e-14)
    assert wall.t == pytest.approx((0.5 - A) / v, rel=1e-14)
    # the landing point is the flight's
    time = 2 * (2 / 7 * v) / G
    assert landed.t - wall.t == pytest.approx(time, rel=1e-13)
    assert landed.after.position == pytest.approx(
        [A + v * time, wall.before.position[1] + 5 / 7 * v * time, A], abs=1e-14
    )
    # (41), with 31/49 (docs/theory/errata.md)
    assert run.final.velocity[0] == pytest.approx([31 / 49 * v, 39 / 49 * v, 0], abs=1e-14)
    one = run.scene.balls[0].ball
    two = carom.two_step(one, carom.rolling(one, velocity=(-v, v)), gravity=G)
    assert run.final.velocity[0] == pytest.approx(two.rolling.velocity, abs=1e-14)
    assert run.final.spin[0] == pytest.approx(two.rolling.spin, abs=1e-12)


@pytest.mark.parametrize("mu", [0.05, 0.2, 1.0, math.inf])
@pytest.mark.parametrize("e", [0.0, 0.5, 0.9])
@pytest.mark.parametrize("beta", [0.0, -0.5])
def test_whatever_the_floor_the_ball_ends_rolling_as_two_step_says(mu: float, e: float, beta: float) -> None:
    run = paper({"restitution": e, "friction": mu, "tangential_restitution": beta})
    one = run.scene.balls[0].ball
    v = 1 / math.sqrt(2)
    two = carom.two_step(
        one,
        carom.rolling(one, velocity=(-v, v)),
        wall=carom.Surface(1.0, math.inf),
        floor=carom.Surface(e, mu, beta),
        gravity=G,
    )
    assert two.rolls
    assert run.final_phase == ["rolling"]
    assert run.final.velocity[0] == pytest.approx(two.rolling.velocity, abs=1e-12)
    assert A * run.final.spin[0] == pytest.approx(A * two.rolling.spin, abs=1e-12)


# --- the same bits -------------------------------------------------------------------------------------------------------

THREADS = """
import hashlib, os, sys
sys.path.insert(0, {tests!r})
import numpy as np, carom
from carom.core.jit.threads import thread_count
from reference.brute_force_scene import random_scene
assert thread_count() == int(os.environ["NUMBA_NUM_THREADS"])
digest = hashlib.sha256()
for seed in range({scenes}):
    digest.update(carom.simulate(random_scene(seed)).log.tobytes())
scene = random_scene({seed})
shape = (200, len(scene.balls), 3)
many = carom.simulate_many(scene, velocity=np.random.default_rng(1).normal(size=shape), events=5)
for array in (many.final.velocity, many.final.spin, many.final.position, many.code, many.count, many.events):
    digest.update(np.ascontiguousarray(array).tobytes())
print(digest.hexdigest())
"""


@pytest.mark.slow
def test_the_same_bits_with_one_thread_and_with_two(tmp_path: Path) -> None:
    code = THREADS.format(tests=os.path.dirname(os.path.dirname(__file__)), seed=5, scenes=tried(10, 40))
    said = []
    with forking() as forked:
        for n in tried(("1", "2"), ("1", "2", "2")):
            exit_code, out, err = forked(tmp_path, "-c", code, NUMBA_NUM_THREADS=n)
            assert exit_code == 0, err
            said.append(out)
    assert len(said[0]) == 2 * hashlib.sha256().digest_size + 1
    assert len(set(said)) == 1


@pytest.mark.parametrize("seed", range(0, 60, tried(6, 3)))
def test_many_runs_are_each_that_run(seed: int) -> None:
    world = random_scene(seed)
    v = np.random.default_rng(seed).normal(size=(4, len(world.balls), 3))
    if world.run.law == "conventional":
        pytest.skip("its balls roll")
    many = carom.simulate_many(world, velocity=v, events=100)
    for n in range(len(v)):
        balls = tuple(
            one.model_copy(
                update={
                    "velocity": tuple(v[n, i].tolist()),
                    "rolling": False,
                    "spin_z": None,
                    "spin": tuple(one.state.spin.tolist()),
                }
            )
            for i, one in enumerate(world.balls)
        )
        one = carom.simulate(world.model_copy(update={"balls": balls}))
        count = len(one.events)
        assert many.events[n][:count].tobytes() == one.events.rows.tobytes()[: 100 * one.log.dtype.itemsize]
        assert np.array_equal(many.final.velocity[n], one.final.velocity)
        assert np.array_equal(many.final.spin[n], one.final.spin)
        assert np.array_equal(many.final.position[n], one.final.position)
