"""Balls that a force keeps in contact: impulses in the log, and balls pressed against each other that stay on the floor."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

import carom
from carom.simulation.records import BALL, FLOOR, WALL

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
