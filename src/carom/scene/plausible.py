"""Numbers of a scene that are more likely meant in another unit: no fault, but said."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from carom.core.units import unlikely_density

if TYPE_CHECKING:
    from carom.scene.scene import Scene

__all__ = ["FAST", "ball_notes", "unit_notes"]

EARTH = (9.7, 9.9)  # m/s^2: with another gravity, or none, the numbers need not be in SI units
FAST = 100.0  # m/s: faster than any struck ball but one of golf, squash or badminton


def ball_notes(at: str, radius: float, mass: float, speed: float, gravity: float) -> list[str]:
    """Return one line for each number of a ball that is hardly one in m, kg and m/s; ``at``: what the lines begin with."""
    if not EARTH[0] <= gravity <= EARTH[1]:
        return []
    found = [f"{at}: {said}"] if (said := unlikely_density(radius, mass)) else []
    if speed > FAST:
        found.append(f"{at}: a speed of {speed:g} m/s; are the velocities in mm/s or cm/s?")
    return found


def unit_notes(scene: Scene) -> list[str]:
    """Return these lines for all balls of a scene.

    Examples
    --------
    >>> import carom
    >>> ball = carom.SceneBall(radius=28.6, mass=0.17, position=(0, 0, 30))
    >>> unit_notes(carom.Scene(balls=[ball]))
    ['balls.0: 0.17 kg with a radius of 28.6 m: lighter than air; is the radius in mm? write "28.6 mm"']
    """
    gravity = math.hypot(*scene.gravity)
    return [
        line
        for i, ball in enumerate(scene.balls)
        for line in ball_notes(
            f"balls.{ball.name or i}", ball.radius, ball.mass, math.hypot(*ball.state.velocity), gravity
        )
    ]
