"""Rims: the circles in which round walls end, against sampling, brute force, and by symmetry."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from reference.brute_force_scene import judge, random_scene
from reference.exploring import tried

import carom
from carom.core.geometry.circles import rim_gap, rim_gap_derivatives, rim_hit, rim_normal
from carom.scene.feature_builders import frame, unit
from carom.scene.shapes import Arc, Box, Cylinder
from carom.simulation.records import HELD_EVENT, LEFT_EVENT, WALL

TUBE = {"point": (0, 0, 0), "radius": 0.03, "height": 0.3, "inside": True, "friction": 0.2}


def thrown(walls: list[Any], x: Any, v: Any = (0, 0, 0), **limits: Any) -> carom.Trajectory:
    ball = carom.SceneBall(radius=0.05, mass=0.2, position=x, velocity=v)
    return carom.simulate(carom.Scene(gravity=9.8, walls=walls, balls=[ball], run=carom.Run(**limits)))


def from_arc(d: Any, u: Any, radius: float, half: float, x: Any) -> tuple[Any, Any]:
    """Distances of places (N, 3) from an arc around the origin, by its nearest point; and whether that is one of its ends."""
    w = np.cross(d, u)
    angle = np.arctan2(x @ w, x @ u)
    end = np.abs(angle) > half
    ends = np.stack([radius * (math.cos(half) * np.array(u) + side * math.sin(half) * w) for side in (1, -1)])
    to_end = np.sqrt(((x[:, None] - ends) ** 2).sum(axis=-1)).min(axis=1)
    to_arc = np.hypot(np.hypot(x @ w, x @ u) - radius, x @ np.array(d))
    return np.where(end, to_end, to_arc), end


def test_against_small_steps() -> None:
    """A ball's flight looked at in small steps: the same first touch, or none."""
    rng = np.random.default_rng(7)
    origin, touched, missed = (0.0, 0.0, 0.0), 0, 0
    times = np.arange(0, 2, 2e-4)
    for _ in range(600):
        d = unit(tuple(rng.normal(size=3).tolist()))
        u, w = frame(d)
        radius, a = float(rng.uniform(0.1, 1)), float(rng.uniform(0.05, 0.6))
        half = math.pi if rng.random() < 0.5 else float(rng.uniform(0.3, 3))
        x, b = rng.normal(size=3) * 1.2, rng.normal(size=3) * rng.choice([0, 2])
        aim = rng.uniform(-math.pi, math.pi)
        v = radius * (math.cos(aim) * np.array(u) + math.sin(aim) * np.array(w)) - x + rng.normal(size=3) * 0.3
        way = x + np.outer(times, v) + np.outer(times**2 / 2, b)
        gaps, end = from_arc(d, u, radius, half, way)
        gaps -= a
        if gaps[0] < 1e-3:
            continue
        cosine = -1.0 if half == math.pi else math.cos(half)
        s = rim_hit(origin, d, radius, u, cosine, a, tuple(x), tuple(v), tuple(b), 2.0, 0.0)
        below = np.flatnonzero(gaps < 0)
        if below.size == 0:
            missed += 1
            assert s == math.inf or np.interp(s, times, gaps) < 1e-6  # a graze between two steps
        elif not end[max(below[0] - 5, 0) : below[0] + 5].any():  # (the ends are corners, not of the rim)
            touched += 1
            assert s <= times[below[0]]
            assert np.interp(s, times, gaps) < 1e-6
            y = x + v * s + b * s * s / 2
            assert rim_gap(origin, d, radius, tuple(y)) == pytest.approx(a, rel=1e-11)
    assert touched > 200
    assert missed > 20


def test_a_ball_that_rolls_along_the_inside_of_a_rim_does_not_pass_through_it() -> None:
    """It leaves the rim by ever less, at last by less than rounding, and the rim turns towards it: it comes back at once."""
    rng = np.random.default_rng(4)
    a, z = 0.05, -0.02  # below the rim, which presses it outwards and down
    for _ in range(400):
        radius, speed, leaving = (
            float(rng.uniform(0.2, 1)),
            float(rng.uniform(0.1, 2)),
            float(10 ** rng.uniform(-13, -6)),
        )
        rho = radius - math.sqrt(a * a - z * z)
        angle = float(rng.uniform(-math.pi, math.pi))
        out, along = np.array([math.cos(angle), math.sin(angle), 0]), np.array([-math.sin(angle), math.cos(angle), 0])
        x, v = rho * out + [0, 0, z], speed * (along - leaving * out)
        slow = 1e-14 * speed
        s = rim_hit((0, 0, 0), (0, 0, 1), radius, (1, 0, 0), -1.0, a, tuple(x), tuple(v), (0, 0, 0), 10.0, slow)
        back = 2 * leaving * rho / speed  # when the chord ends
        assert 0 <= s <= 1.001 * back + 1e-7 * rho / speed  # (a gap of rounding)


def test_a_run_along_the_inside_of_a_rim_that_gives_nothing_back() -> None:
    scene = random_scene(533_443)
    run = carom.simulate(scene)
    fault, *_where = judge(run)
    assert fault == ""


def test_normal_and_way_in_are_the_slopes_of_the_gap() -> None:
    rng = np.random.default_rng(2)
    p = (0.0, 0.0, 0.0)
    for _ in range(50):
        d, x, v, b = unit(tuple(rng.normal(size=3).tolist())), *(tuple(rng.normal(size=3)) for _ in range(3))
        gap = lambda s, d=d, x=x, v=v, b=b: rim_gap(  # noqa: E731
            p, d, 0.7, tuple(np.array(x) + np.array(v) * s + np.array(b) * s * s / 2)
        )
        rate, bend = rim_gap_derivatives(p, d, 0.7, x, v, b)
        h = 1e-4
        assert rate == pytest.approx((gap(h) - gap(-h)) / (2 * h), abs=1e-5, rel=1e-4)
        assert bend == pytest.approx((gap(h) - 2 * gap(0.0) + gap(-h)) / (h * h), abs=1e-3, rel=1e-3)
        assert np.dot(rim_normal(p, d, 0.7, x, v), v) == pytest.approx(rate)


@pytest.mark.parametrize("height", [0.003, 0.3, 30.0])
@pytest.mark.parametrize("along", [-3.0, 1e-3, 3.0])
@pytest.mark.parametrize("across", [1e-3, 1.0])
def test_on_the_axis_the_normal_comes_from_the_point_that_the_ball_moves_towards(
    height: float, along: float, across: float
) -> None:
    radius, v = 0.7, (0.0, across, along)
    rate = (height * along - radius * across) / np.hypot(radius, height)
    n = rim_normal((0.0, 0.0, 0.0), (0.0, 0.0, 1.0), radius, (0.0, 0.0, height), v)
    assert np.linalg.norm(n) == pytest.approx(1)
    assert np.dot(n, v) == pytest.approx(rate, rel=1e-12)


def test_no_event_is_missed() -> None:
    met = 0
    for k in range(tried(80, 250)):
        scene = random_scene(k)
        ends = [
            i
            for i, wall in enumerate(scene.walls)
            if (wall.kind == "cylinder" and wall.height < math.inf) or (wall.kind == "arc" and wall.height < math.inf)
        ]
        if not ends:
            continue
        try:
            run = carom.simulate(scene)
        except carom.CaromError:
            continue
        fault, row, size, _steps = judge(run)
        assert not fault, f"scene {k}: {fault}, row {row}, {size:.3g}"
        met += int((np.isin(run.log["other"], ends) & (run.log["kind"] == WALL)).sum())
    assert met > tried(12, 40)


@pytest.mark.parametrize("off", [0.0, 1e-17, 1e-12])
def test_a_ball_in_the_middle_of_a_hole_bounces_straight_and_comes_to_lie(off: float) -> None:
    run = thrown([Cylinder(**TUBE, restitution=0.8)], (off, 0, 1))
    assert np.allclose(run.log["v"][:, :2], 0, atol=1e-13)
    # |z - 0.3| = sqrt(a^2 - R^2)
    assert np.allclose(run.log["x"][1:, 2], 0.34, rtol=0, atol=1e-14 + off)
    assert run.log["v"][1, 2] == pytest.approx(0.8 * math.sqrt(2 * 9.8 * 0.66), rel=1e-12)
    assert run.log["kind"][-1] == HELD_EVENT


@pytest.mark.parametrize("off", [1e-9, 1e-7, 1e-5, 1e-3, 1e-2])
@pytest.mark.parametrize("e", [0.0, 0.5, 1.0])
def test_beside_the_middle_it_meets_one_side_and_then_the_other(off: float, e: float) -> None:
    cage = Box(center=(0, 0, 0.6), size=(0.3, 0.3, 1.0), inside=True, restitution=1.0, friction=0.0)
    run = thrown([Cylinder(**TUBE, restitution=e), cage], (off, 0, 0.7), max_events=40)
    rim = (run.log["kind"] == WALL) & (run.log["other"] == 0) & (run.log["x"][:, 2] > 0.3)
    x = run.log["x"][rim]
    gap = np.hypot(np.hypot(x[:, 0], x[:, 1]) - 0.03, x[:, 2] - 0.3) - 0.05
    assert np.abs(gap).max() < 1e-12
    assert (run.log["v"][:, 1] == 0).all()
    # the first on the side it is on, the next on the other
    assert run.log["v"][1, 0] < 0
    assert run.log["v"][2, 0] >= run.log["v"][1, 0]
    place = run.at(np.linspace(0, run.end, 2000)).position[:, 0]
    place = place[np.isfinite(place).all(axis=-1)]
    assert len(place) > 100
    outside = np.hypot(np.hypot(place[:, 0], place[:, 1]) - 0.03, np.maximum(place[:, 2] - 0.3, 0.0))
    assert (outside > 0.05 * (1 - 1e-9)).all()


def test_a_mirrored_scene_runs_mirrored() -> None:
    walls = [Cylinder(point=(0.1, 0.2, 0), axis=(0.2, 0.1, 1), radius=0.2, height=0.4, restitution=0.9, friction=0.1)]
    other = [Cylinder(point=(-0.1, 0.2, 0), axis=(-0.2, 0.1, 1), radius=0.2, height=0.4, restitution=0.9, friction=0.1)]
    one, two = thrown(walls, (0.35, 0.21, 1), max_events=3), thrown(other, (-0.35, 0.21, 1), max_events=3)
    assert len(one.events) > 0
    assert np.allclose(one.log["v"] * (-1, 1, 1), two.log["v"], rtol=1e-9)


def test_over_a_low_arc_and_against_its_edge() -> None:
    wall = {"center": (0, 0), "radius": 0.5, "restitution": 0.9, "friction": 0.1, "height": 0.2}
    over = thrown([Arc(**wall, from_angle=0, to_angle=360)], (0, 0, 0.6), (2, 0, 1))
    assert over.log["kind"][-1] == LEFT_EVENT
    assert math.hypot(*over.log["x"][-1, :2]) == pytest.approx(0.5, rel=1e-12)
    # an open one is passed over, both ways, and the ball goes on
    passed = thrown([Arc(**wall, from_angle=90, to_angle=270)], (-1, 0, 0.6), (2, 0, 1), duration=0.4)
    assert passed.log["kind"].tolist().count(LEFT_EVENT) == 1
    struck = thrown([Arc(**wall, from_angle=-90, to_angle=90)], (0.2, 0.1, 0.3), (2, 0, 0), max_events=1)
    x = struck.log["x"][1]
    assert math.hypot(math.hypot(x[0], x[1]) - 0.5, x[2] - 0.2) == pytest.approx(0.05, rel=1e-12)
    assert struck.log["v"][1, 2] > struck.log["v_before"][1, 2]


def test_a_pillar_has_a_top_to_bounce_on_and_a_tube_two_sides() -> None:
    pillar = Cylinder(point=(0, 0, 0), radius=0.2, height=0.3, restitution=1.0, friction=0.0)
    run = thrown([pillar], (0.1, 0.1, 0.5), max_events=5)
    assert np.allclose(run.log["x"][1:, 2], 0.35, rtol=0, atol=1e-12)
    tube = Cylinder(point=(0, 0, 0), radius=0.2, height=0.3, inside=True, restitution=1.0, friction=0.0)
    within = thrown([tube], (0, 0, 0.2), (3, 0, 1), max_events=2)
    assert math.hypot(*within.log["x"][1, :2]) == pytest.approx(0.15)
    outside = thrown([tube], (0.5, 0, 0.2), (-3, 0, 1), max_events=1)
    assert math.hypot(*outside.log["x"][1, :2]) == pytest.approx(0.25)
