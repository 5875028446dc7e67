"""The energy budget of a run: each loss is where physics says, potential energy counts, nothing is left over."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import carom
from carom.simulation.records import IN_CLUSTER
from carom.simulation.trajectory import budget

MASS, RADIUS, G = 0.2, 0.03, 9.8


def scene(ball: dict[str, Any], **fields: Any) -> carom.Scene:
    one = carom.SceneBall(**{"radius": RADIUS, "mass": MASS} | ball)
    return carom.Scene(gravity=G, balls=[one], **fields)


def test_a_falling_ball_keeps_its_energy() -> None:
    found = budget(carom.simulate(scene({"position": (0, 0, 1.0), "velocity": (1, 0, 2)}, run=carom.Run(duration=0.3))))
    assert found.start == pytest.approx(MASS * (5 / 2 + G * 1.0))
    assert found.end == pytest.approx(found.start)
    assert (found.walls, found.floor, found.balls) == (0, 0, 0)
    assert found.way == pytest.approx(0, abs=1e-12)


def test_a_landing_loses_what_restitution_takes() -> None:
    floor = carom.Floor(restitution=0.6, friction=0.0)
    fall = {"position": (0, 0, RADIUS + 0.5), "velocity": (0, 0, 0)}
    found = budget(carom.simulate(scene(fall, floor=floor, run=carom.Run(max_events=1))))
    # (counted from where a ball lies on the floor)
    assert found.start == pytest.approx(MASS * G * 0.5)
    assert found.floor == pytest.approx(found.start * (1 - 0.6**2))
    assert found.way == pytest.approx(0, abs=1e-12)
    assert found.end == pytest.approx(found.start - found.floor)


def test_a_ball_that_rolls_out_loses_all_on_its_way() -> None:
    floor = carom.Floor(restitution=0.5, friction=0.2, rolling_resistance=0.01)
    ball = {"position": (0, 0), "velocity": (1, 0, 0), "rolling": True}
    found = budget(carom.simulate(scene(ball, floor=floor)))
    assert found.start == pytest.approx(0.7 * MASS)  # 1/2 m v^2 (1 + 2/5)
    assert found.way == pytest.approx(found.start)
    assert found.end == pytest.approx(0, abs=1e-12)


def test_walls_and_balls_lose_what_their_restitution_takes() -> None:
    wall = carom.scene.Plane(point=(0, 0, 0), normal=(1, 0, 0), restitution=0.8, friction=0.0)
    balls = [
        carom.SceneBall(radius=RADIUS, mass=MASS, position=(0.5, 0, 0), velocity=(-1, 0, 0)),
        carom.SceneBall(radius=RADIUS, mass=MASS, position=(1.0, 0, 0), velocity=(0, 0, 0)),
    ]
    meet = carom.BallContact(restitution=0.5)
    found = budget(carom.simulate(carom.Scene(gravity=0, walls=[wall], balls=balls, ball_contact=meet)))
    assert found.walls == pytest.approx(MASS / 2 * (1 - 0.8**2))
    # of the relative motion, with the reduced mass
    assert found.balls == pytest.approx(MASS / 4 * 0.8**2 * (1 - 0.5**2))
    assert found.end == pytest.approx(found.start - found.walls - found.balls)


def test_balls_whose_contacts_overlap_lose_energy_between_balls() -> None:
    """In a break the balls met counted the breaker's loss alone, and "sliding, rolling and small bounces" gained the rest."""
    balls = [
        carom.SceneBall(radius=RADIUS, mass=MASS, position=(2 * RADIUS * k, 0, 0), velocity=(0, 0, 0))
        for k in range(1, 5)
    ]
    first = carom.SceneBall(radius=RADIUS, mass=MASS, position=(-0.1, 0, 0), velocity=(1, 0, 0))
    meet = carom.BallContact(restitution=0.9, young=5.5e9, poisson=0.3)
    run = carom.simulate(carom.Scene(gravity=0, balls=[first, *balls], ball_contact=meet))
    assert np.isin(IN_CLUSTER, run.log["kind"])
    found = budget(run)
    assert found.balls == pytest.approx(found.start - found.end, rel=1e-12)
    assert 0 < found.balls < found.start
    assert found.way == pytest.approx(0, abs=1e-12 * found.start)
