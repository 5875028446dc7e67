"""Balls that a force keeps in contact: impulses in the log, balls that stay on the floor, balls that lean on walls of a slope."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest
from reference.judged_runs import R, scene_of
from reference.leaning_balls import Leaning

import carom
from carom.core.jit.kernel import as_objects
from carom.scene.toml import replaced
from carom.simulation import loop, predict, resting_contact
from carom.simulation.records import BALL, FLOOR, WALL, set_up

TOP = 150.0  # rad/s, more than any of these balls spins


def pressed_into_a_wall() -> carom.Trajectory:
    """A ball with topspin, which drives it into a wall again and again."""
    wall = {"shape": "plane", "point": (0.0, 0.0, 0.0), "normal": (1.0, 0.0, 0.0), "restitution": 0.6, "friction": 0.1}
    ball = {"radius": 0.03, "mass": 0.2, "position": (0.03, 0.0), "velocity": (0.0, 0.4), "spin": (0.0, -60.0, 0.0)}
    cloth = {"friction": 0.2, "rolling_resistance": 0.01}
    return carom.simulate(carom.Scene(floor=cloth, walls=[wall], balls=[ball], run={"duration": 0.3}))


@pytest.fixture(scope="module")
def pressed_balls() -> carom.Trajectory:
    """Two balls that touch and slide: the floor's friction drives them against each other, and their own lifts one."""
    ball = {"radius": 0.03, "mass": 0.2}
    balls = [
        {**ball, "position": (side * 0.03, 0.0), "velocity": (0.0, 0.4 + 0.05 * side), "spin": (0.0, top, 5.0)}
        for side, top in ((-1, 20.0), (1, -15.0))
    ]
    cloth = {"friction": 0.2, "rolling_resistance": 0.01, "restitution": 0.5}
    contact = {"restitution": 0.95, "friction": 0.06}
    return carom.simulate(carom.Scene(floor=cloth, balls=balls, ball_contact=contact, run={"duration": 2.0}))


def off_by(run: carom.Trajectory, kind: int) -> Iterator[float]:
    """By how much impulses differ from the changes of momentum along the table, as a share of the ball's own, in low bounces."""
    for row in run.log[run.log["kind"] == kind]:
        ball: Any = run.scene.balls[row["ball"]]
        change = ball.mass * (row["v"] - row["v_before"])
        if max(np.linalg.norm(change), np.linalg.norm(row["impulse"])) < 1e-3 * ball.mass:
            away = (change - row["impulse"] - row["floor_impulse"])[:2]
            yield float(np.linalg.norm(away)) / (ball.mass * (np.linalg.norm(row["v_before"]) + ball.radius * TOP))


def test_the_impulses_of_low_bounces_change_the_velocities(pressed_balls: carom.Trajectory) -> None:
    # (a bounce that begins takes its energy from the motion, which it scales by less than 1e-6)
    for run, kind in ((pressed_into_a_wall(), WALL), (pressed_balls, BALL)):
        off = [*off_by(run, kind)]
        assert len(off) > 20
        assert max(off) < 1e-6


def test_balls_that_slide_pressed_against_each_other_stay_on_the_floor(pressed_balls: carom.Trajectory) -> None:
    # (else most rows are hops of 1e-18 m between the low bounces, with the ends of the slides that follow)
    kinds = pressed_balls.log["kind"]
    meetings = (kinds == BALL).sum()
    assert (kinds == FLOOR).sum() < 5
    assert meetings < len(kinds) < 1.05 * meetings < 2100


# --- a ball that leans on a wall of a tilted floor --------------------------------------------------------------------

A, G = 0.03, 9.80665
TABLE = {"shape": "table", "length": 1.2, "width": 0.7, "restitution": 0.8, "friction": 0.2}


def leaning(velocity: tuple[float, ...], spin: tuple[float, ...], lift: float = 0.0, **floor: float) -> carom.Scene:
    """A ball in touch with a plane on which a slope presses it; ``lift`` is the normal's part upwards."""
    normal = np.array([0.0, -np.sqrt(1 - lift * lift), lift])
    plane = {"shape": "plane", "point": tuple(A * (np.array([0, 0, 1]) - normal)), "normal": tuple(normal)}
    return carom.Scene(
        floor={"restitution": 0.5, "friction": 0.2, "slope": (0.02, 0.06), **floor},
        walls=[{**plane, "restitution": 0.5, "friction": 0.15}],
        balls=[{"radius": A, "mass": 0.17, "position": (0.0, 0.0), "velocity": velocity, "spin": spin}],
        run={"duration": 0.6, "max_events": 1000},
    )


@pytest.mark.parametrize(
    "scene",
    [
        leaning((0.5, 0.0), (0.0, -10.0, -30.0)),  # slides at both
        leaning((0.3, 0.0), (0.0, 10.0, 20.0), lift=-0.2, rolling_resistance=0.01),  # a nose above its centre
        leaning((0.0, 0.0), (0.0, 0.0, 60.0), rolling_resistance=0.03, spin_friction=0.012),
    ],
)
def test_a_ball_that_leans_on_a_wall_moves_along_it_as_in_small_steps(scene: carom.Scene) -> None:
    run, times = carom.simulate(scene), np.linspace(0, 0.6, 7)
    ball, floor = scene.balls[0], scene.floor
    assert floor is not None
    normal = np.array(scene.walls[0].model_dump()["normal"])
    steps = Leaning(
        A, 0.4, np.array([0.02, 0.06, -np.sqrt(1 - 0.02**2 - 0.06**2)]) * G, (0.5, 0.2), (0.5, 0.15),
        A * (np.array([0, 0, 1]) - normal), normal, floor.rolling_resistance, floor.spin_friction,
    )  # fmt: skip
    start = np.array([0, 0, A, *ball.velocity[:2], 0, *ball.spin])
    found, at = steps.states(start, times), run.at(times)
    assert 0 < (run.log["kind"] > 0).sum() < 10
    assert np.abs(at.position[:, 0] - found[:, :3]).max() < 2e-5
    assert np.abs(at.velocity[:, 0] - found[:, 3:6]).max() < 5e-5
    assert A * np.abs(at.spin[:, 0] - found[:, 6:]).max() < 5e-5


def on_a_slope(*balls: dict[str, Any], slope: tuple[float, float] = (-0.0235, 0.0467), **floor: float) -> carom.Scene:
    """Balls on a tilted table."""
    cloth = {"restitution": 0.3, "friction": 0.2, "rolling_resistance": 0.01, "slope": slope, **floor}
    return carom.Scene(
        floor=cloth, walls=[TABLE], balls=[{"radius": A, "mass": 0.17, **ball} for ball in balls],
        run={"duration": 60.0, "max_events": 20_000},
    )  # fmt: skip


STRUCK = on_a_slope(
    {"position": (0.0, 0.35 - A), "velocity": (-0.2, 0.0), "spin": (0.0, -7.0, 40.0)},
    {"position": (-0.25, 0.1), "velocity": (0.9, 1.0)},
)


@pytest.mark.parametrize(
    "scene",
    [
        on_a_slope({"position": (-0.3, 0.35 - A), "velocity": (0.3, 0.02), "spin": (0.0, 0.0, 60.0)}),  # to a corner
        on_a_slope({"position": (0.0, 0.32)}, {"position": (0.01, 0.2)}),  # one leans on the other
        STRUCK,
    ],
)
def test_on_a_slope_all_comes_to_rest_at_the_lower_cushions(scene: carom.Scene) -> None:
    run = carom.simulate(scene)
    assert run.ended == "nothing more happens"
    assert run.final_phase == ["rest"] * len(scene.balls)
    times = np.linspace(0, run.end, 2001)
    x, energy = run.at(times).position, run.energy(times)
    assert (np.array([0.6, 0.35]) - A - np.abs(x[..., :2])).min() > -1e-9
    assert np.diff(energy).max() < 1e-12 * energy[0]
    if len(scene.balls) > 1:
        assert np.linalg.norm(x[:, 0] - x[:, 1], axis=-1).min() > 2 * A * (1 - 1e-8)


@pytest.mark.parametrize("seed", [3, 24, 41])
def test_drawn_balls_at_the_foot_of_a_slope_neither_jump_nor_overlap_nor_gain_energy(seed: int) -> None:
    scene = scene_of("leaning", seed)
    contact = scene.ball_contact.model_copy(update={"overlap": False})
    limits = scene.run.model_copy(update={"duration": 8.0, "max_events": 4000})
    run = carom.simulate(scene.model_copy(update={"ball_contact": contact, "run": limits}))
    times, count = np.linspace(0, run.end, 2001), len(scene.balls)
    x, energy = run.at(times).position, run.energy(times)
    for k in range(1, count):
        assert np.linalg.norm(x[:, :k] - x[:, k : k + 1], axis=-1).min() > 2 * R - 1e-9
    assert np.diff(energy).max() < 1e-12 * np.ptp(energy)
    rows = run.log[count:]
    before = run.at(np.maximum(rows["t"] - 1e-7, 0.0)).position[np.arange(len(rows)), rows["ball"]]
    assert np.linalg.norm(before - rows["x"], axis=-1).max() < 1e-6


def test_balls_that_lie_on_a_ball_that_is_struck_away_are_let_go() -> None:
    row = [{"position": (-0.57 + 2 * A * k, 0.32)} for k in range(3)]
    scene = on_a_slope(*row, {"position": (-0.5, 0.1), "velocity": (0.0, 1.0)}, slope=(-0.03, 0.04))
    scene = replaced(scene, {"run.max_events": 100_000})
    before = carom.simulate(scene.model_copy(update={"balls": scene.balls[:3]}))
    assert before.final_phase == ["rest"] * 3
    assert np.abs(before.final.position - [(*one["position"], A) for one in row]).max() < 1e-7
    run = carom.simulate(scene)
    assert run.final_phase == ["rest"] * 4
    x = run.final.position
    gaps = [np.linalg.norm(x[i] - x[k]) - 2 * A for i in range(4) for k in range(i)]
    # (some bounces of 1e-6 radii apart, which are too low to see)
    assert sum(abs(gap) < 1e-5 * A for gap in gaps) >= 3
    # (the one that struck lies on the first of the row, at the other wall)
    assert np.abs(x[:3, 1] - 0.32).max() < 1e-7
    assert x[3, :2] == pytest.approx((-0.57, 0.32 - 2 * A), abs=1e-6)


@pytest.mark.parametrize("time", [0.25, 0.5])
def test_derivatives_of_a_ball_that_leans_on_a_wall_are_those_of_differences(time: float) -> None:
    scene = leaning((0.5, 0.0), (0.0, -10.0, -30.0), rolling_resistance=0.01)
    paths = ["walls.0.friction", "floor.friction", "balls.0.velocity.x", "balls.0.spin.z", "floor.rolling_resistance"]
    run = carom.simulate(scene)
    found = run.sensitivity(
        ["walls.0.friction", "floor.friction", "balls.0.velocity", "balls.0.spin", "floor.rolling_resistance"]
    )
    told = found.at(time)
    for path in paths:
        c = found.columns.index(path)
        x, ends = float(found.values[c]), []
        for h in (1e-5, -1e-5):
            at = carom.simulate(_with_number(scene, path, x + h)).at(time)
            ends.append(np.concatenate([at.position[0], at.velocity[0], A * at.spin[0]]))
        expected = (ends[0] - ends[1]) / 2e-5
        slopes = np.concatenate([told.position[0, :, c], told.velocity[0, :, c], A * told.spin[0, :, c]])
        assert slopes == pytest.approx(expected, abs=1e-6 * max(1.0, np.abs(expected).max())), path


def _with_number(scene: carom.Scene, path: str, x: float) -> carom.Scene:
    *place, last = path.split(".")
    if last in "xyz":
        old = list(getattr(scene.balls[0], place[-1]))
        old["xyz".index(last)] = x
        return replaced(scene, {".".join(place): tuple(old)})
    return replaced(scene, {path: x})


def test_a_ball_at_rest_at_a_cushion_can_be_struck() -> None:
    run = carom.simulate(STRUCK)
    met = run.log[(run.log["kind"] == BALL) & (run.log["ball"] == 0)]
    assert len(met) > 0
    assert np.linalg.norm(met["v"][0] - met["v_before"][0]) > 0.1


def test_a_search_for_a_wall_behind_a_ball_that_rolls_down_ends(monkeypatch: pytest.MonkeyPatch) -> None:
    # (it went on by steps of 1e6 s, ten thousand of them)
    scene = on_a_slope({"position": (-0.5, 0.1), "velocity": (0.1, 0.03), "rolling": True})
    arrays = set_up(scene, compiled=False)
    balls, features = as_objects(arrays.balls_to_move()), as_objects(arrays.features)
    steps: list[float] = []
    state_at = predict.state_at
    monkeypatch.setattr(predict, "state_at", lambda ball, s: (steps.append(s), state_at(ball, s))[1])
    loop._start(as_objects(arrays.world)[0], features, balls)
    assert 0 < len(steps) < 200


def test_a_low_bounce_of_two_balls_takes_its_energy_from_the_motion_of_both() -> None:
    ball = {"radius": 0.03, "mass": 0.2}
    balls = [
        {**ball, "position": (-0.03, 0.0), "velocity": (0.0, 0.3), "spin": (1.0, 2.0, 5.0)},
        {**ball, "mass": 0.3, "position": (0.03, 0.0), "velocity": (0.0, -0.5), "spin": (-3.0, 0.0, 1.0)},
    ]
    arrays = set_up(carom.Scene(floor={"friction": 0.0, "slope": (0.05, 0.0)}, balls=balls), compiled=False)
    world, (one, other) = as_objects(arrays.world)[0], as_objects(arrays.balls_to_move())

    def energy() -> float:
        return sum(m.mass * (np.dot(m.v, m.v) + m.kappa * m.radius**2 * np.dot(m.w, m.w)) / 2 for m in (one, other))

    before = energy()
    impulse = resting_contact.continue_ball_contact(world, one, other, (-1.0, 0.0, 0.0), 0.0, -1.0)
    apart = other.v[0] - one.v[0]
    assert impulse > 0
    assert apart == pytest.approx(impulse * (1 / 0.2 + 1 / 0.3))
    assert apart > 0
    assert energy() == pytest.approx(before, rel=1e-14)
