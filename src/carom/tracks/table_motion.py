"""Sliding and rolling of a ball on a table, in closed form at many times at once, with derivatives for fits.

A ball with the slip u slides, decelerated by mu g against the slip, for the time k |u| / (mu g), k = kappa / (1 + kappa); then it
rolls with the velocity v - k u, decelerated by c g along its path. A ball that hops first flies for some time with constant
velocity and slip, and lands: the floor takes up m g T / 2, T the time of the flight, and its friction reduces the slip as half of
that time of sliding would. (Further bounces change neither the later path nor the later velocity.) Physics and sources are those
of :mod:`carom.core.motion.phases`, whose kernels go from one state to the next; a fit needs arrays of times, and parameters
without a spin, since a track shows positions only.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

__all__ = [
    "TableMotion",
    "hop_slide_roll",
    "hop_slide_roll_derivatives",
    "landed",
    "slide_then_roll",
    "slide_then_roll_derivatives",
]

Array = NDArray[np.float64]
TINY = 1e-12


class TableMotion(NamedTuple):
    """Motion of a ball at n times since its start."""

    displacement: Array
    """(n, 2) from the start, m."""
    velocity: Array
    """(n, 2) m/s."""
    slip: Array
    """(n, 2) m/s."""


def slide_then_roll(v: Array, u: Array, t: Array, mu_g: float, c_g: float, k: float) -> TableMotion:
    """Compute the motion of a ball at times t (n,), s >= 0, after it had the velocity v (2,) and the slip u (2,), m/s.

    ``mu_g`` and ``c_g`` are the decelerations while it slides and rolls, m/s^2; k = kappa / (1 + kappa), 2/7 for a solid ball.
    """
    return _filled(v, u, t, mu_g, c_g, k, np.empty((0, 2, 6)))


def slide_then_roll_derivatives(
    v: Array, u: Array, t: Array, mu_g: float, c_g: float, k: float
) -> tuple[Array, Array, Array]:
    """Compute displacement (n, 2), velocity (n, 2), and the derivatives of the displacement (n, 2, 6).

    The derivatives are with respect to v (2), u (2), mu_g and c_g. Parameters as in :func:`slide_then_roll`.
    """
    slope = np.empty((len(t), 2, 6))
    found = _filled(v, u, t, mu_g, c_g, k, slope)
    return found.displacement, found.velocity, slope


def hop_slide_roll(v: Array, u: Array, hop: float, t: Array, mu_g: float, c_g: float, k: float) -> Array:
    """Compute the displacement (n, 2) of a ball that hops for the time ``hop``, s, and then slides and rolls."""
    flown = np.minimum(t, hop)
    way = slide_then_roll(*landed(v, u, hop, mu_g, k), t - flown, mu_g, c_g, k)
    return np.asarray(flown[:, None] * v + way.displacement)


def landed(v: Array, u: Array, hop: float, mu_g: float, k: float) -> tuple[Array, Array]:
    """Return velocity and slip (2,) of a ball that has landed from a hop of the time ``hop``, s."""
    lost = _lost_at_landing(u, hop, mu_g, k)
    return v - lost, u - lost / k


def hop_slide_roll_derivatives(
    v: Array, u: Array, hop: float, t: Array, mu_g: float, c_g: float, k: float
) -> tuple[Array, Array]:
    """Compute the velocity (n, 2), and the derivatives of the displacement (n, 2, 7): v (2), u (2), mu_g, c_g and hop."""
    flown, lands = np.minimum(t, hop)[:, None], t >= hop
    size = float(np.hypot(*u)) + TINY
    e, across = u / size, np.eye(2) - np.outer(u, u) / size**2
    _way, after, by = slide_then_roll_derivatives(*landed(v, u, hop, mu_g, k), t - flown[:, 0], mu_g, c_g, k)
    by_v, by_u = by[:, :, 0:2], by[:, :, 2:4]
    by_lost = -by_v - by_u / k
    sticks = mu_g * hop / 2 >= k * size
    turned = k * np.eye(2) if sticks else mu_g * hop / 2 / size * across
    rate = np.zeros((len(t), 2)) if sticks else by_lost @ e / 2
    velocity = np.where(lands[:, None], after, v)
    slope = np.empty((len(t), 2, 7))
    slope[:, :, 0:2] = by_v + flown[:, :, None] * np.eye(2)
    slope[:, :, 2:4] = by_u + by_lost @ turned
    slope[:, :, 4], slope[:, :, 5] = by[:, :, 4] + rate * hop, by[:, :, 5]
    slope[:, :, 6] = np.where(lands[:, None], v - after, 0.0) + rate * mu_g
    return velocity, slope


def _lost_at_landing(u: Array, hop: float, mu_g: float, k: float) -> Array:
    """Return the velocity (2,) that the floor's friction takes from a ball of slip u as it lands."""
    size = float(np.hypot(*u)) + TINY
    return np.asarray(u * (min(mu_g * hop / 2, k * size) / size))


def _filled(v: Array, u: Array, t: Array, mu_g: float, c_g: float, k: float, slope: Array) -> TableMotion:
    found = TableMotion(np.empty((len(t), 2)), np.empty((len(t), 2)), np.empty((len(t), 2)))
    numbers = (float(v[0]), float(v[1]), float(u[0]), float(u[1]), float(mu_g), float(c_g), float(k))
    _compiled()(*numbers, np.ascontiguousarray(t), *found, slope)
    return found


def _fill(
    vx: float, vy: float, ux: float, uy: float, mu_g: float, c_g: float, k: float, t: Any,
    way: Any, velocity: Any, left: Any, slope: Any,
) -> None:  # fmt: skip
    """Fill displacements, velocities and slips (n, 2), and derivatives (n, 2, 6), or (0, 2, 6) for none."""
    slip = math.sqrt(ux * ux + uy * uy) + TINY
    ex, ey = ux / slip, uy / slip
    slides = k * slip / mu_g
    rx, ry = vx - k * ux, vy - k * uy
    speed = math.sqrt(rx * rx + ry * ry) + TINY
    px, py = rx / speed, ry / speed
    least = c_g if c_g > TINY else TINY
    for i in range(t.shape[0]):
        f = min(t[i], slides)
        h = min(max(t[i] - slides, 0.0), speed / least)
        far, size = speed * h - c_g / 2 * h * h, max(slip - mu_g / k * t[i], 0.0)
        way[i, 0] = vx * f - ex * (mu_g / 2 * f * f) + px * far
        way[i, 1] = vy * f - ey * (mu_g / 2 * f * f) + py * far
        left[i, 0], left[i, 1] = size * ex, size * ey
        # the slip times k is the velocity that the ball still loses
        velocity[i, 0] = px * (speed - c_g * h) + k * left[i, 0]
        velocity[i, 1] = py * (speed - c_g * h) + k * left[i, 1]
        if slope.shape[0] == 0:
            continue
        # contributions of rolling, through its initial velocity r, and of the end of the slide, through its time
        bent, turned = c_g / (2 * speed) * h * h, mu_g / (2 * slip) * f * f
        xx, xy, yy = h - (1 - px * px) * bent, px * py * bent, h - (1 - py * py) * bent
        endx, endy = px * c_g * h, py * c_g * h
        row = slope[i]
        row[0, 0], row[0, 1], row[1, 0], row[1, 1] = f + xx, xy, xy, f + yy
        row[0, 2] = -(1 - ex * ex) * turned - k * xx + endx * (k / mu_g) * ex
        row[0, 3] = ex * ey * turned - k * xy + endx * (k / mu_g) * ey
        row[1, 2] = ex * ey * turned - k * xy + endy * (k / mu_g) * ex
        row[1, 3] = -(1 - ey * ey) * turned - k * yy + endy * (k / mu_g) * ey
        row[0, 4], row[1, 4] = -ex * (f * f / 2) - endx * (slides / mu_g), -ey * (f * f / 2) - endy * (slides / mu_g)
        row[0, 5], row[1, 5] = -px * (h * h / 2), -py * (h * h / 2)


@functools.cache
def _compiled() -> Callable[..., None]:
    from carom.core.jit.compile import njit

    return njit(_fill)
