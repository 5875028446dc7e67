"""Path of a ball on a table before and after a contact, by the parameters of a fit, with its derivatives.

Before the contact the ball slides or rolls from the first frame on, after it the ball may hop, then slides and rolls
(:mod:`carom.tracks.table_motion`). Both paths meet at the place of the contact.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.core.jit.kernel import kernel
from carom.tracks.table_motion import hopped_after, hopped_slopes, moved_after, moved_slopes

__all__ = [
    "ANGLE", "COUNT", "C_G", "DISTANCE", "HOP", "MU_G", "PLACE", "ROLL", "SLIP", "TIME", "U_OUT", "V_OUT", "at_contact",
    "contact_path", "contact_slopes", "first_slip",
]  # fmt: skip

Array = NDArray[np.float64]

# The parameters of a contact on a table. Before the contact the ball has, at the first frame, a slip u0 of magnitude SLIP in the
# direction ANGLE, and the velocity ROLL + k u0: ROLL is its velocity once it rolls, which late frames determine even if they
# determine nothing of u0.
TIME, PLACE, DISTANCE, ROLL, SLIP, ANGLE = 0, slice(1, 3), 1, slice(3, 5), 5, 6
V_OUT, U_OUT, MU_G, C_G, HOP = slice(7, 9), slice(9, 11), 11, 12, 13
COUNT = 14


def first_slip(theta: Array) -> Array:
    """Return the slip u0 (2,) at the first frame, m/s."""
    return np.array(_first_slip(float(theta[SLIP]), float(theta[ANGLE])))


def at_contact(theta: Array, since: float, k: float) -> tuple[Array, Array]:
    """Return the velocity and the slip (2,) with which the ball meets the wall, m/s; ``since``: the time of the first frame, s."""
    span = max(float(theta[TIME]) - since, 0.0)
    roll_x, roll_y, size, angle = theta[ROLL.start : ANGLE + 1].tolist()
    found = _before(span, roll_x, roll_y, size, angle, float(theta[MU_G]), float(theta[C_G]), k)
    return np.array(found[2:4]), np.array(found[4:])


def contact_path(theta: Array, since: float, t: Array, k: float) -> Array:
    """Return the positions (n, 2) at times t (n,), m."""
    places = np.empty((len(t), 2))
    _compiled()(theta, since, k, t, places, NO_SLOPES, NO_WORK)
    return places


def contact_slopes(theta: Array, since: float, t: Array, k: float) -> Array:
    """Return the derivatives (n, 2, COUNT) of the positions with respect to theta."""
    slope = np.zeros((len(t), 2, COUNT))
    _compiled()(theta, since, k, t, np.empty((len(t), 2)), slope, np.empty((2, 2, 7)))
    return slope


NO_SLOPES, NO_WORK = np.empty((0, 2, COUNT)), np.empty((0, 2, 7))  # (for positions alone)


# --- kernels ------------------------------------------------------------------------------------------------------------


@kernel
def _first_slip(size: float, angle: float) -> tuple[float, float]:
    return size * math.cos(angle), size * math.sin(angle)


@kernel
def _before(
    s: float, roll_x: float, roll_y: float, size: float, angle: float, mu_g: float, c_g: float, k: float
) -> tuple[float, float, float, float, float, float]:
    """Return displacement, velocity and slip a time s after the first frame."""
    ux, uy = _first_slip(size, angle)
    return moved_after(s, roll_x + k * ux, roll_y + k * uy, ux, uy, mu_g, c_g, k)


@kernel
def _slopes_before(
    s: float, roll_x: float, roll_y: float, size: float, angle: float, mu_g: float, c_g: float, k: float, rows: Any
) -> None:
    """Fill the derivatives of that displacement by the velocity and the slip at the first frame, mu_g and c_g (2, 6)."""
    ux, uy = _first_slip(size, angle)
    moved_slopes(s, roll_x + k * ux, roll_y + k * uy, ux, uy, mu_g, c_g, k, rows)


def _fill_contact(theta: Any, since: float, k: float, t: Any, places: Any, slope: Any, work: Any) -> None:
    """Fill positions (n, 2), and derivatives (n, 2, COUNT), or (0, 2, COUNT) for none; ``work`` (2, 2, 7) is written to."""
    time, x, y, roll_x, roll_y, size, angle = theta[0], theta[1], theta[2], theta[3], theta[4], theta[5], theta[6]
    vx, vy, ux, uy, mu_g, c_g, hop = theta[7], theta[8], theta[9], theta[10], theta[11], theta[12], theta[13]
    with_slopes = slope.shape[0] > 0
    span = max(time - since, 0.0)
    end = _before(span, roll_x, roll_y, size, angle, mu_g, c_g, k)
    cos, sin = _first_slip(1.0, angle)
    if with_slopes:
        _slopes_before(span, roll_x, roll_y, size, angle, mu_g, c_g, k, work[0])
    for i in range(t.shape[0]):
        if t[i] < time:
            s = min(max(t[i] - since, 0.0), span)
            now = _before(s, roll_x, roll_y, size, angle, mu_g, c_g, k)
            places[i, 0], places[i, 1] = x + now[0] - end[0], y + now[1] - end[1]
            if with_slopes:
                _slopes_before(s, roll_x, roll_y, size, angle, mu_g, c_g, k, work[1])
                for c in range(2):
                    by, row = work[1, c], slope[i, c]
                    for j in range(6):
                        by[j] -= work[0, c, j]
                    # the slip at the first frame is part of the velocity there
                    by_x, by_y = by[2] + k * by[0], by[3] + k * by[1]
                    row[TIME], row[DISTANCE + c], row[3], row[4] = -end[2 + c], 1.0, by[0], by[1]
                    row[SLIP], row[ANGLE] = by_x * cos + by_y * sin, size * (by_y * cos - by_x * sin)
                    row[MU_G], row[C_G] = by[4], by[5]
        else:
            s = t[i] - time
            after = hopped_after(s, vx, vy, ux, uy, hop, mu_g, c_g, k)
            places[i, 0], places[i, 1] = x + after[0], y + after[1]
            if with_slopes:
                hopped_slopes(s, vx, vy, ux, uy, hop, mu_g, c_g, k, work[1])
                for c in range(2):
                    row = slope[i, c]
                    row[TIME], row[DISTANCE + c] = -after[2 + c], 1.0
                    for j in range(7):
                        row[7 + j] = work[1, c, j]


@functools.cache
def _compiled() -> Callable[..., None]:
    from carom.core.jit.compile import njit

    return njit(_fill_contact)
