"""A contact in flight: two parabolas that meet at the wall."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from carom.tracks.fitted import Fitted, differences, guess, solve, told

__all__ = ["fit_flight"]

Array = NDArray[np.float64]

# theta: t_c, x_c (2), v_in (2), v_out (2), gravity (2) in the wall's frame.


def _flight_places(theta: Array, t: Array) -> Array:
    s = (t - theta[0])[:, None]
    return np.asarray(theta[1:3] + np.where(s < 0, theta[3:5], theta[5:7]) * s + theta[7:9] * (s * s / 2))


def _flight_outputs(theta: Array) -> Array:
    nothing = np.nan
    return np.array([*theta[:7], nothing, nothing, nothing, nothing, nothing, nothing, *theta[7:9], nothing])


def fit_flight(
    time: Array, position: Array, near: float, noise: float, gravity: Array, error: float, wall: float | None = None
) -> Fitted:
    """A contact of a ball in flight: two parabolas that meet. ``gravity`` (2,) m/s^2 in the wall's frame, within ``error``.

    In ``Fitted`` the gravity found stands in the place of mu_g and c_g (away from the wall, along it). Newton's parabola.
    """
    theta = np.concatenate([guess(time, position, time < near, time >= near, near), gravity])
    scale = np.array([1e-3, 1e-3, 1e-3, *[0.05] * 4, *[0.2] * 2])

    def residual(theta: Array) -> Array:
        gap = (position - _flight_places(theta, time)) / noise
        known = list((theta[7:9] - gravity) / error)
        if wall is not None:
            known.append((theta[1] - wall) / noise)
        return np.concatenate([gap.ravel(), known])

    def slope(theta: Array) -> Array:
        return differences(residual, theta, 1e-4 * scale)

    best, _cost = solve(residual, slope, theta, scale)
    return told(
        best,
        np.ones(9, bool),
        residual,
        slope(best),
        _flight_outputs,
        lambda t: _flight_places(best, t),
        scale,
        time,
        noise,
        False,
    )
