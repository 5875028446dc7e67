"""Motion of a ball between contacts, for fits: closed forms over many times at once.

On a table: a ball with the slip u slides, slowed by mu g against the slip, until k |u| / (mu g), k = kappa / (1 + kappa);
then it rolls with v - k u, slowed by c g along its path. Same physics and sources as carom.motion.phases, whose kernels go
from one state to the next; a fit wants whole arrays of times and parameters without a spin, since a track shows only places.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

__all__ = ["Leg", "leg", "slopes"]

Array = NDArray[np.float64]
TINY = 1e-12


class Leg(NamedTuple):
    """A leg at n times since its start."""

    way: Array
    """(n, 2) m from the start."""
    velocity: Array
    """(n, 2) m/s."""
    slip: Array
    """(n, 2) m/s."""


def leg(v: Array, u: Array, t: Array, mu_g: float, c_g: float, k: float) -> Leg:
    """Where a ball is, n times t >= 0 (s) after it had the velocity v (2,) and the slip u (2,) on the floor.

    ``mu_g`` and ``c_g`` are the decelerations while it slides and rolls, m/s^2; k = kappa / (1 + kappa), 2/7 if solid.
    """
    slip = np.sqrt(u[0] * u[0] + u[1] * u[1]) + TINY
    e = u / slip
    slides = k * slip / mu_g
    first = np.minimum(t, slides)[:, None]
    rolls = v - k * u
    speed = np.sqrt(rolls[0] * rolls[0] + rolls[1] * rolls[1]) + TINY
    then = np.minimum(np.maximum(t - slides, 0.0), speed / max(c_g, TINY))[:, None]
    way = v * first - e * (mu_g / 2 * first * first) + rolls / speed * (speed * then - c_g / 2 * then * then)
    left = np.maximum(slip - mu_g / k * t, 0.0)[:, None]
    # the slip is k's share of what the ball still has to lose
    velocity = rolls / speed * (speed - c_g * then) + k * left * e
    return Leg(way, velocity, left * e)


def slopes(v: Array, u: Array, t: Array, mu_g: float, c_g: float, k: float) -> tuple[Array, Array, Array]:
    """Of :func:`leg`, the way (n, 2), the velocity (n, 2), and the way's derivatives (n, 2, 6) by v, u, mu_g and c_g."""
    slip = np.sqrt(u[0] * u[0] + u[1] * u[1]) + TINY
    e = u / slip
    slides = k * slip / mu_g
    f = np.minimum(t, slides)[:, None]
    r = v - k * u
    speed = np.sqrt(r[0] * r[0] + r[1] * r[1]) + TINY
    rho = r / speed
    h = np.minimum(np.maximum(t - slides, 0.0), speed / max(c_g, TINY))[:, None]
    way = v * f - e * (mu_g / 2 * f * f) + rho * (speed * h - c_g / 2 * h * h)
    left = np.maximum(slip - mu_g / k * t, 0.0)[:, None]
    velocity = rho * (speed - c_g * h) + k * left * e
    slope = np.empty((len(t), 2, 6))
    one = np.eye(2)
    # what rolling adds, by the velocity r with which it begins
    by_r = one * h[:, :, None] - (one - np.outer(rho, rho)) * (c_g / (2 * speed) * h * h)[:, :, None]
    by_end = rho * (c_g * h)  # by the time at which the slide ends
    slope[:, :, 0:2] = one * f[:, :, None] + by_r
    slope[:, :, 2:4] = (
        -(one - np.outer(e, e)) * (mu_g / (2 * slip) * f * f)[:, :, None]
        - k * by_r
        + by_end[:, :, None] * (k / mu_g * e)
    )
    slope[:, :, 4] = -e * (f * f / 2) - by_end * (slides / mu_g)
    slope[:, :, 5] = -rho * (h * h / 2)
    return way, velocity, slope
