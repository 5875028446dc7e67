"""Derivatives of runs against the tangent maps of orbits, which are written by hand, and single bounces that engines got wrong."""

from __future__ import annotations

import math

import numpy as np
import pytest

import carom
from carom import billiards

RADIUS, MASS = 0.1, 0.2
START = ((0.1, 0.2), (0.8, 0.6), 0.7)


def scene_of(law: str, duration: float) -> carom.Scene:
    """The ball of the orbit among real walls: its centre stays within the unit circle."""
    wall = carom.scene.Cylinder(point=(0, 0, 0), axis=(0, 0, 1), radius=1 + RADIUS, inside=True, law=law)
    (x, y), (vx, vy), spin = START
    ball = carom.SceneBall(radius=RADIUS, mass=MASS, position=(x, y, 0), velocity=(vx, vy, 0), spin=(0, 0, spin))
    return carom.Scene(gravity=0, walls=[wall], balls=[ball], run=carom.Run(duration=duration))


@pytest.mark.parametrize("law", ["mirror", "no-slip"])
@pytest.mark.parametrize("bounces", [1, 5])
def test_derivatives_are_those_of_the_orbits_tangent_map(law: str, bounces: int) -> None:
    ball = carom.Ball(radius=RADIUS, mass=MASS)
    exact = billiards.tangent_map(billiards.circle(), START, bounces=bounces, ball=ball, law=law).matrix
    run = carom.simulate(scene_of(law, 12.0))
    s = run.sensitivity(["balls.0.position", "balls.0.velocity", "balls.0.spin"])
    columns = [
        s.columns.index(f"balls.0.{name}")
        for name in ("position.x", "position.y", "velocity.x", "velocity.y", "spin.z")
    ]
    ends = []
    for k in (0, bounces):
        event, x = s.events[k], run.events.rows["x"][k]
        n = -x / np.linalg.norm(x)
        t = np.array([n[1], -n[0], 0.0])
        weight = math.sqrt(ball.kappa) * RADIUS
        # along the wall, velocity along it and across, spin as a velocity
        rows = [t @ event.position, t @ event.velocity, n @ event.velocity, weight * event.spin[2]]
        ends.append(np.array(rows)[:, columns])
    expected = exact @ ends[0]
    assert ends[1] == pytest.approx(expected, abs=1e-12 * np.abs(expected).max())


@pytest.mark.parametrize("height", [0.3, 1.0, 2.7])
def test_one_bounce_of_an_elastic_ball(height: float) -> None:
    # google/brax#317, a bounce whose derivative time steps get wrong; here dropped from h, with w = sqrt(2 g h) at the floor
    g, end = 9.81, 1.2
    w = math.sqrt(2 * g * height)
    ball = carom.SceneBall(radius=RADIUS, mass=1.0, position=(0, 0, RADIUS + height))
    floor = carom.Floor(restitution=1.0, friction=0.0)
    run = carom.simulate(carom.Scene(gravity=g, floor=floor, balls=[ball], run=carom.Run(duration=end)))
    found = run.sensitivity(["balls.0.position.z"]).final
    bounces = len(run.events)
    # the n-th bounce turns the velocity round: it has gained 2 w each time
    assert found.velocity[0, 2, 0] == pytest.approx(2 * bounces * g / w, rel=1e-11)
    falls = (2 * bounces - 1) * w / g  # time of the last bounce
    # z = w s - g s^2 / 2 after it, s = T - (2 n - 1) w / g
    s = end - falls
    expected = (g / w) * s - (w - g * s) * (2 * bounces - 1) / w
    assert found.position[0, 2, 0] == pytest.approx(expected, rel=1e-11)
