"""The loop over many runs of which states are kept, against single runs: same bits, at the end and at given times."""

from __future__ import annotations

import math

import numpy as np
import pytest
from reference.drawn_options import random_scene

import carom
from carom.core.jit.threads import limit_threads, thread_count
from carom.core.motion.phases import REST, SLIDING
from carom.scene.toml import replaced
from carom.simulation.loop import FULL
from carom.simulation.records import set_up, starts_of
from carom.simulation.sensitivity.follow import ARRAYS, dual_users, parameters_of
from carom.simulation.sensitivity.sensitivity import Limits, RunSlopes, kept_states

RADIUS = 0.03
WRT = ["balls.0.velocity", "walls.0.restitution", "floor.friction"]
TIMES = np.linspace(0.0, 1.4, 29)


def two_balls() -> carom.Scene:
    """Return a scene in which a ball meets another one, and both meet the cushions."""
    walls = [carom.Table(length=1.2, width=0.6, restitution=0.8, friction=0.2)]
    floor = carom.Floor(friction=0.2, rolling_resistance=0.01)
    balls = [
        carom.SceneBall(radius=RADIUS, mass=0.2, position=(-0.3, 0), velocity=(1.5, 0.03)),
        carom.SceneBall(radius=RADIUS, mass=0.17, position=(0.1, 0)),
    ]
    return carom.Scene(floor=floor, walls=walls, balls=balls, run=carom.Run(duration=1.5))


@pytest.fixture(scope="module")
def speeds() -> np.ndarray:
    rng = np.random.default_rng(5)
    found = np.zeros((6, 2, 3))
    found[:, 0, :2] = rng.uniform(0.5, 2, (6, 2)) * [1, 0.05]
    return found


def kept(
    scene: carom.Scene, speeds: np.ndarray, wrt: list[str], rows: int = 256, most_rows: int = 0, **options: object
) -> object:
    arrays = set_up(scene)
    starts, slopes = starts_of("test", scene, arrays, speeds, None, None), None
    if wrt:
        parameters = parameters_of(scene, arrays, wrt, [SLIDING, REST])
        world, features, balls = (parameters.packed[name] for name in ARRAYS)
        slopes = RunSlopes(world, features, balls[None], dual_users(scene.called_laws))
    limits = Limits(rows, 10_000, 1.5, most_rows)
    return kept_states(arrays, starts, slopes, to_end="time" not in options, limits=limits, **options)


def test_states_at_times_of_several_balls_are_those_of_single_runs(speeds: np.ndarray) -> None:
    scene, n = two_balls(), len(speeds)
    times = {"time": np.tile(TIMES, (n, 1)), "count": np.full(n, len(TIMES))}
    plain, found = kept(scene, speeds, [], **times), kept(scene, speeds, WRT, **times)
    assert np.array_equal(plain.states, found.states, equal_nan=True)
    for i in range(n):
        run = carom.simulate(replaced(scene, {"balls.0.velocity": speeds[i, 0].tolist()}))
        at = run.at(TIMES)
        for j, name in enumerate(("position", "velocity", "spin")):
            assert np.array_equal(found.states[i, :, :, 3 * j : 3 * j + 3], np.asarray(getattr(at, name)))
        matters = run.sensitivity(WRT)
        for t in (3, 17, 28):
            exact = matters.at(float(TIMES[t]))
            got = np.moveaxis(found.slopes[i, :, t], 0, 2).reshape(2, 9, -1)[..., : len(matters.columns)]
            assert got[:, 0:3] == pytest.approx(exact.position, rel=1e-11, abs=1e-11)
            assert got[:, 3:6] == pytest.approx(exact.velocity, rel=1e-11, abs=1e-11)
    assert (found.states[:, -1, 1, 0] > 0.15).sum() > 3  # (the other ball was struck)


def test_the_end_is_that_of_simulate_many_and_no_thread_changes_it(speeds: np.ndarray) -> None:
    scene, before = two_balls(), thread_count()
    many, found = carom.simulate_many(scene, velocity=speeds), kept(scene, speeds, WRT)
    assert np.array_equal(found.finals["x"], many.final.position)
    assert np.array_equal(found.finals["w"], many.final.spin)
    assert found.ends.tolist() == [1.5] * len(speeds)
    try:
        limit_threads(1)
        again = kept(scene, speeds, WRT)
    finally:
        limit_threads(before)
    assert np.array_equal(found.finals_d, again.finals_d)


def test_states_after_the_end_and_of_balls_in_pockets_are_nan() -> None:
    ball = carom.SceneBall(radius=0.0286, mass=0.17, position=(1.0, 0.365), velocity=(2, 2))
    scene = carom.Scene(floor=carom.Floor(friction=0.2), walls=[carom.Table(preset="pool-9ft")], balls=[ball])
    time = np.array([[0.0, 0.02, 1.0, 1.4], [0.0, 0.02, 1.0, math.inf]])
    found = kept(scene, np.array([[[2.0, 2.0, 0.0]]] * 2), [], time=time, count=np.array([4, 2]))
    assert np.isfinite(found.states[:, :2]).all()
    assert np.isnan(found.states[:, 2:]).all()


def test_a_log_that_is_full_is_run_again_with_more_rows(speeds: np.ndarray) -> None:
    short = kept(two_balls(), speeds, WRT, rows=4)
    assert set(short.ended[:, 0]) == {FULL}
    again, whole = kept(two_balls(), speeds, WRT, rows=4, most_rows=256), kept(two_balls(), speeds, WRT)
    assert np.array_equal(again.finals_d, whole.finals_d)
    assert np.array_equal(again.ended, whole.ended)


@pytest.mark.parametrize("seed", [465, 525])
def test_at_the_time_of_an_event_a_state_on_a_slope_is_that_of_the_log(seed: int) -> None:
    """Sweeps keep that of the log: bit for bit the same as a run's."""
    run = carom.simulate(random_scene(seed))
    for ball in range(len(run.scene.balls)):
        rows = run.log[run.log["ball"] == ball]
        rows = rows[np.append(np.diff(rows["t"]) > 0, True)]
        found = run.at(rows["t"])
        assert found.velocity[:, ball].tobytes() == rows["v"].tobytes()
        assert found.spin[:, ball].tobytes() == rows["w"].tobytes()
