"""The hard instants: contact that lasts, contact at time zero, bounces without number, many contacts at once."""

import math
from typing import Any

import numpy as np
import pytest

import carom

A = 0.03
BALL = {"radius": A, "mass": 0.2}
FLOOR = {"friction": 0.2, "restitution": 0.5}
TILT = np.array([0.3, 0.0, 1.0]) / math.hypot(0.3, 1.0)
SURFACE = {"restitution": 0.5, "friction": 0.2}


def ball(*position: float, **more: Any) -> dict[str, Any]:
    return {**BALL, "position": list(position), **more}


def plane(*normal: float, at: tuple[float, ...] = (0.0, 0.0, 0.0), **more: Any) -> dict[str, Any]:
    return {"shape": "plane", "point": list(at), "normal": list(normal), **SURFACE, **more}


def run(*balls: dict[str, Any], **scene: Any) -> carom.Trajectory:
    scene.setdefault("run", {"duration": 10.0, "max_events": 20_000})
    return carom.simulate(carom.Scene(balls=list(balls), **scene))


def gaps(run: carom.Trajectory, times: Any) -> Any:
    """Least distance between two balls, over their radii's sum, at each time."""
    x = run.at(times).position
    assert x is not None
    a = np.array([one.radius for one in run.scene.balls])
    apart = np.sqrt(((x[..., :, None, :] - x[..., None, :, :]) ** 2).sum(-1)) - a[:, None] - a
    apart[..., np.arange(len(a)), np.arange(len(a))] = np.inf
    return np.nanmin(apart, axis=(-1, -2))


# --- contact that lasts, from the first instant on -------------------------------------------------------------------

LYING = {
    "on a tilted plane": ([plane(0.3, 0, 1)], TILT * A),
    "on a tilted plane that returns everything": ([plane(0.3, 0, 1, restitution=1.0)], TILT * A),
    "on a sphere": ([{"shape": "sphere", "center": [0, 0, 0], "radius": 0.1, **SURFACE}], (0, 0, 0.13)),
    "on an edge": ([{"shape": "box", "center": [0, 0, -0.05], "size": [0.1] * 3, **SURFACE}], (0.05, 0, A)),
    "on a corner": ([{"shape": "box", "center": [0, 0, -0.05], "size": [0.1] * 3, **SURFACE}], (0.05, 0.05, A)),
    "on a bar": ([{"shape": "segment", "start": [-1, 0], "end": [1, 0], "height": 0.1, **SURFACE}], (0, 0, 0.1 + A)),
}


@pytest.mark.parametrize(("walls", "place"), LYING.values(), ids=LYING.keys())
def test_a_ball_that_lies_there_is_held_at_once(walls: Any, place: Any) -> None:
    found = run(ball(*map(float, place)), walls=walls)
    assert found.events.kinds == ["wall", "held"]
    assert found.events.t.tolist() == [0.0, 0.0]
    assert found.final_phase == ["held"]


@pytest.mark.parametrize("e", [0.0, 0.5, 1.0])
def test_a_ball_that_lies_on_a_ball_is_held(e: float) -> None:
    found = run(ball(0, 0), ball(0, 0, 3 * A), floor=FLOOR, ball_contact={"restitution": e})
    assert found.events.kinds == ["ball", "ball", "held", "held"]
    assert found.final_phase == ["held", "held"]


@pytest.mark.parametrize("e", [0.0, 0.3, 0.5, 0.9])
@pytest.mark.parametrize("floor", [0.0, 0.5, 0.9])
def test_a_ball_that_drops_on_a_ball_comes_to_lie_on_it(e: float, floor: float) -> None:
    # under the other's hops the lower one is struck, and struck again by the floor
    found = run(ball(0, 0), ball(0, 0, 4 * A), floor={**FLOOR, "restitution": floor}, ball_contact={"restitution": e})
    assert found.final_phase == ["held", "held"]
    x = found.final.position
    assert x is not None
    assert x[1, 2] == pytest.approx(3 * A, abs=1e-8 * A)
    assert gaps(found, np.linspace(0, found.end, 5000)).min() >= -1e-9 * A


# --- along a wall ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("approach", [0.0, 1e-16, 1e-15, 1e-14, 1e-12, 1e-10])
@pytest.mark.parametrize("e", [0.0, 0.5, 1.0])
def test_a_ball_that_rolls_along_a_wall_for_100_m(approach: float, e: float) -> None:
    n = np.array([1.0, 0.7]) / math.hypot(1.0, 0.7)
    v = [2.1 - approach, -3.0]
    found = run(
        ball(*(A * n), velocity=v, rolling=True),
        floor=FLOOR,
        walls=[plane(*n, 0.0, restitution=e)],
        run={"duration": 40.0},
    )
    assert len(found.events) <= 3
    assert found.final_phase == ["rolling"]
    x = found.at(np.linspace(0, 40, 1000)).position
    assert x is not None
    assert np.abs(x[-1, 0, :2] - A * n) @ np.abs([n[1], -n[0]]) > 100
    assert (x[:, 0, :2] @ n - A).min() >= -1e-9 * A


def test_a_ball_that_slides_along_a_side_does_not_meet_its_end() -> None:
    # the post at the end touches the ball's path in one point; rounding must not make a blow of it
    rng = np.random.default_rng(5)
    for _ in range(200):
        p, t = rng.normal(size=2), rng.normal(size=2)
        t /= np.linalg.norm(t)
        n = np.array([-t[1], t[0]])
        wall = {
            "shape": "segment",
            "start": p.tolist(),
            "end": (p + t).tolist(),
            "restitution": 0.0,
            "friction": math.inf,
        }
        start = [*(p + 0.3 * t + 2 * A * n), 0.0]
        found = run(
            ball(*start, velocity=[*(rng.uniform(1, 3) * t - n), 0.0]), gravity=0.0, walls=[wall], run={"duration": 5.0}
        )
        assert found.events.kinds == ["wall"]


# --- bounces without number ------------------------------------------------------------------------------------------


def test_hops_are_summed_behind_a_wall_as_they_are_anywhere() -> None:
    segment = {"shape": "segment", "start": [-1, -1], "end": [1, -1], **SURFACE}
    drop = ball(0, 0, 3 * A, velocity=[0.1, 0.2, 0.0])
    alone, behind = (run(drop, floor={**FLOOR, "restitution": 0.9}, walls=walls) for walls in ([], [segment]))
    assert "settled" in alone.events.kinds
    assert behind.events.rows.tobytes() == alone.events.rows.tobytes()


def test_a_bouncing_ball_is_struck_where_it_is() -> None:
    # it is free of all others when its hops are summed; then a light ball beside it is struck, and comes
    found = run(
        ball(0, 0, A + 0.9e-8, velocity=[0.001, 0.002, 0.0]),
        ball(0.21, 0, mass=0.002),
        ball(0.97, 0, velocity=[-10.0, 0.0]),
        floor={**FLOOR, "restitution": 0.999},
        run={"duration": 0.084, "max_events": 20_000},
    )
    assert "bouncing" in [phase for _from, _to, phase in found.phases(0)]
    struck = found.events.of("ball", ball=0)
    assert len(struck) >= 2
    for event in struck:
        assert abs(gaps(found, event.t)) <= 1e-9 * A
    assert gaps(found, np.linspace(0, found.end, 20_001)).min() >= -1e-9 * A


# --- many contacts at once -------------------------------------------------------------------------------------------


@pytest.mark.parametrize("count", [2, 3, 5, 10])
def test_a_row_of_soft_balls_goes_on_together(count: int) -> None:
    # e = 0: infinitely many blows in one instant, which end when all have the same speed
    row = [ball(2 * A * k, 0, 0) for k in range(count)]
    found = run(
        ball(-0.5, 0, 0, velocity=[1.0, 0.0, 0.0]),
        *row,
        gravity=0.0,
        ball_contact={"restitution": 0.0},
        run={"duration": 5.0},
    )
    assert set(found.events.kinds) == {"ball"}
    assert found.final.velocity[:, 0] == pytest.approx(1 / (count + 1), abs=1e-12)


@pytest.mark.parametrize("gap", [0.0, 1e-9, 1e-6])
def test_newtons_cradle(gap: float) -> None:
    row = [ball((2 * A + gap) * k, 0, 0) for k in range(5)]
    found = run(ball(-0.5, 0, 0, velocity=[1.0, 0.0, 0.0]), *row, gravity=0.0, run={"duration": 5.0})
    assert found.events.kinds == ["ball"] * 10
    assert found.final.velocity[:, 0] == pytest.approx([0, 0, 0, 0, 0, 1], abs=1e-15)
