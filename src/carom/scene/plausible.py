"""Numbers of a scene that are more likely meant otherwise, in another unit or at rest: no fault, but said."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from carom.core.units import unlikely_density
from carom.formatting import format_length, format_time
from carom.scene.restitution import Constant

if TYPE_CHECKING:
    from carom.scene.scene import Scene

__all__ = ["FAST", "ball_notes", "scene_notes"]

EARTH = (9.7, 9.9)  # m/s^2: with another gravity, or none, the numbers need not be in SI units
LOW = 1e-4  # of the radius: so low a ball hardly was to be let go
FAST = 100.0  # m/s: faster than any struck ball but one of golf, squash or badminton


def ball_notes(at: str, radius: float, mass: float, speed: float, gravity: float) -> list[str]:
    """Return one line for each number of a ball that is hardly one in m, kg and m/s; ``at``: what the lines begin with."""
    if not EARTH[0] <= gravity <= EARTH[1]:
        return []
    found = [f"{at}: {said}"] if (said := unlikely_density(radius, mass)) else []
    if speed > FAST:
        found.append(f"{at}: a speed of {speed:g} m/s; are the velocities in mm/s or cm/s?")
    return found


def bounce_notes(scene: Scene) -> list[str]:
    """Return a line for each ball that begins a little above a floor that returns all its speed: it bounces for ever, unseen."""
    floor, g = scene.floor, -scene.pull[2]
    if floor is None or not g > 0 or not (isinstance(floor.restitution, Constant) and floor.restitution.value == 1):
        return []
    found = []
    for i, ball in enumerate(scene.balls):
        height = ball.center[2] - ball.radius + float(ball.state.velocity[2]) ** 2 / (2 * g)
        if 1e-9 < height / ball.radius < LOW:
            found.append(
                f"balls.{ball.name or i}: bounces {format_length(height)} high on a floor of restitution 1, which never ends: an"
                f" event every {format_time(2 * math.sqrt(2 * height / g))}; leave out z to lay it on the floor"
            )
    return found


def scene_notes(scene: Scene) -> list[str]:
    """Return these lines for all balls of a scene.

    Examples
    --------
    >>> import carom
    >>> ball = carom.SceneBall(radius=28.6, mass=0.17, position=(0, 0, 30))
    >>> scene_notes(carom.Scene(balls=[ball]))
    ['balls.0: 0.17 kg with a radius of 28.6 m: lighter than air; is the radius in mm? write "28.6 mm"']
    """
    gravity = math.hypot(*scene.gravity)
    units = [
        line
        for i, ball in enumerate(scene.balls)
        for line in ball_notes(
            f"balls.{ball.name or i}", ball.radius, ball.mass, math.hypot(*ball.state.velocity), gravity
        )
    ]
    return units + bounce_notes(scene)
