"""Sliding and rolling of a ball on a table, in closed form, with derivatives for fits.

A ball with the slip u slides, decelerated by mu g against the slip, for the time k |u| / (mu g), k = kappa / (1 + kappa); then it
rolls with the velocity v - k u, decelerated by c g along its path. A ball that hops first flies for some time with constant
velocity and slip, and lands: the floor takes up m g T / 2, T the time of the flight, and its friction reduces the slip as half of
that time of sliding would. (Further bounces change neither the later path nor the later velocity.) Physics and sources are those
of :mod:`carom.core.motion.phases`, whose kernels go from one state to the next; a fit needs arrays of times, and parameters
without a spin, since a track shows positions only. The kernels of one time are also those of a contact's two sides
(:mod:`carom.tracks.table_contact`).
"""

from __future__ import annotations

import functools
import math
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.core.jit.kernel import kernel

__all__ = [
    "TableMotion",
    "hop_slide_roll",
    "hopped_after",
    "hopped_slopes",
    "landed",
    "moved_after",
    "moved_slopes",
    "slide_then_roll",
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
    found = TableMotion(np.empty((len(t), 2)), np.empty((len(t), 2)), np.empty((len(t), 2)))
    _compiled()(*_two(v), *_two(u), float(mu_g), float(c_g), float(k), np.ascontiguousarray(t), *found)
    return found


def hop_slide_roll(v: Array, u: Array, hop: float, t: Array, mu_g: float, c_g: float, k: float) -> Array:
    """Compute the displacement (n, 2) of a ball that hops for the time ``hop``, s, and then slides and rolls."""
    way = np.empty((len(t), 2))
    _compiled_hop()(*_two(v), *_two(u), float(hop), float(mu_g), float(c_g), float(k), np.ascontiguousarray(t), way)
    return way


def landed(v: Array, u: Array, hop: float, mu_g: float, k: float) -> tuple[Array, Array]:
    """Return velocity and slip (2,) of a ball that has landed from a hop of the time ``hop``, s."""
    lost = u * _lost_at_landing(*_two(u), hop, mu_g, k)
    return v - lost, u - lost / k


def _two(vector: Array) -> tuple[float, float]:
    return float(vector[0]), float(vector[1])


# --- kernels ------------------------------------------------------------------------------------------------------------


@kernel
def _phases(
    t: float, vx: float, vy: float, ux: float, uy: float, mu_g: float, c_g: float, k: float
) -> tuple[float, float, float, float, float, float, float, float, float]:
    """Return slip, its direction and duration; speed and direction of rolling; how long the ball has slid and rolled at t."""
    slip = math.sqrt(ux * ux + uy * uy) + TINY
    slides = k * slip / mu_g
    rx, ry = vx - k * ux, vy - k * uy
    speed = math.sqrt(rx * rx + ry * ry) + TINY
    rolls = min(max(t - slides, 0.0), speed / max(c_g, TINY))
    return slip, ux / slip, uy / slip, slides, speed, rx / speed, ry / speed, min(t, slides), rolls


@kernel
def moved_after(
    t: float, vx: float, vy: float, ux: float, uy: float, mu_g: float, c_g: float, k: float
) -> tuple[float, float, float, float, float, float]:
    """Return displacement, velocity and slip, of x and y each, at the time t after the velocity v and the slip u."""
    slip, ex, ey, _slides, speed, px, py, f, h = _phases(t, vx, vy, ux, uy, mu_g, c_g, k)
    far, size = speed * h - c_g / 2 * h * h, max(slip - mu_g / k * t, 0.0)
    left_x, left_y = size * ex, size * ey
    # the slip times k is the velocity that the ball still loses
    return (
        vx * f - ex * (mu_g / 2 * f * f) + px * far,
        vy * f - ey * (mu_g / 2 * f * f) + py * far,
        px * (speed - c_g * h) + k * left_x,
        py * (speed - c_g * h) + k * left_y,
        left_x,
        left_y,
    )


@kernel
def moved_slopes(
    t: float, vx: float, vy: float, ux: float, uy: float, mu_g: float, c_g: float, k: float, row: Any
) -> None:
    """Fill the derivatives of the displacement at the time t by v, u, mu_g and c_g: the first six columns of ``row`` (2, 6)."""
    slip, ex, ey, slides, speed, px, py, f, h = _phases(t, vx, vy, ux, uy, mu_g, c_g, k)
    # contributions of rolling, through its initial velocity r, and of the end of the slide, through its time
    bent, turned = c_g / (2 * speed) * h * h, mu_g / (2 * slip) * f * f
    xx, xy, yy = h - (1 - px * px) * bent, px * py * bent, h - (1 - py * py) * bent
    endx, endy = px * c_g * h, py * c_g * h
    row[0, 0], row[0, 1], row[1, 0], row[1, 1] = f + xx, xy, xy, f + yy
    row[0, 2] = -(1 - ex * ex) * turned - k * xx + endx * (k / mu_g) * ex
    row[0, 3] = ex * ey * turned - k * xy + endx * (k / mu_g) * ey
    row[1, 2] = ex * ey * turned - k * xy + endy * (k / mu_g) * ex
    row[1, 3] = -(1 - ey * ey) * turned - k * yy + endy * (k / mu_g) * ey
    row[0, 4], row[1, 4] = -ex * (f * f / 2) - endx * (slides / mu_g), -ey * (f * f / 2) - endy * (slides / mu_g)
    row[0, 5], row[1, 5] = -px * (h * h / 2), -py * (h * h / 2)


@kernel
def _lost_at_landing(ux: float, uy: float, hop: float, mu_g: float, k: float) -> float:
    """Return the velocity that the floor's friction takes from a ball of slip u as it lands, as a share of u."""
    size = math.sqrt(ux * ux + uy * uy) + TINY
    return min(mu_g * hop / 2, k * size) / size


@kernel
def hopped_after(
    t: float, vx: float, vy: float, ux: float, uy: float, hop: float, mu_g: float, c_g: float, k: float
) -> tuple[float, float, float, float]:
    """Return displacement and velocity at the time t of a ball that hops for the time ``hop`` before it slides and rolls."""
    flown, lost = min(t, hop), _lost_at_landing(ux, uy, hop, mu_g, k)
    after = moved_after(t - flown, vx - lost * ux, vy - lost * uy, ux - lost * ux / k, uy - lost * uy / k, mu_g, c_g, k)
    x, y = flown * vx + after[0], flown * vy + after[1]
    return (x, y, after[2], after[3]) if t >= hop else (x, y, vx, vy)


@kernel
def hopped_slopes(
    t: float, vx: float, vy: float, ux: float, uy: float, hop: float, mu_g: float, c_g: float, k: float, row: Any
) -> None:
    """Fill the derivatives of the displacement of a ball that hops first: ``row`` (2, 7), by v, u, mu_g, c_g and hop."""
    flown, lost = min(t, hop), _lost_at_landing(ux, uy, hop, mu_g, k)
    sx, sy = ux - lost * ux / k, uy - lost * uy / k
    moved_slopes(t - flown, vx - lost * ux, vy - lost * uy, sx, sy, mu_g, c_g, k, row)
    size = math.sqrt(ux * ux + uy * uy) + TINY
    ex, ey = ux / size, uy / size
    sticks = mu_g * hop / 2 >= k * size
    # the velocity lost at landing is k u where the slip stops, else mu_g hop / 2 along u: its derivatives by u
    bent = mu_g * hop / 2 / size
    xx, xy, yy = (k, 0.0, k) if sticks else (bent * (1 - ex * ex), -bent * ex * ey, bent * (1 - ey * ey))
    after = hopped_after(t, vx, vy, ux, uy, hop, mu_g, c_g, k)
    gap = vx - after[2], vy - after[3]  # by a longer hop, the ball keeps its velocity for longer
    for c in range(2):
        lost_x, lost_y = -row[c, 0] - row[c, 2] / k, -row[c, 1] - row[c, 3] / k
        rate = 0.0 if sticks else (lost_x * ex + lost_y * ey) / 2
        row[c, 2] += lost_x * xx + lost_y * xy
        row[c, 3] += lost_x * xy + lost_y * yy
        row[c, 4] += rate * hop
        row[c, 6] = gap[c] + rate * mu_g
        row[c, c] += flown


def _fill(
    vx: float, vy: float, ux: float, uy: float, mu_g: float, c_g: float, k: float, t: Any, way: Any, velocity: Any, left: Any,
) -> None:  # fmt: skip
    """Fill displacements, velocities and slips (n, 2)."""
    for i in range(t.shape[0]):
        found = moved_after(t[i], vx, vy, ux, uy, mu_g, c_g, k)
        way[i, 0], way[i, 1], velocity[i, 0], velocity[i, 1], left[i, 0], left[i, 1] = found


def _fill_hop(
    vx: float, vy: float, ux: float, uy: float, hop: float, mu_g: float, c_g: float, k: float, t: Any, way: Any
) -> None:
    """Fill displacements (n, 2) of a ball that hops first."""
    for i in range(t.shape[0]):
        way[i, 0], way[i, 1], _vx, _vy = hopped_after(t[i], vx, vy, ux, uy, hop, mu_g, c_g, k)


@functools.cache
def _compiled() -> Callable[..., None]:
    from carom.core.jit.compile import njit

    return njit(_fill)


@functools.cache
def _compiled_hop() -> Callable[..., None]:
    from carom.core.jit.compile import njit

    return njit(_fill_hop)
