"""Fit of a contact of a ball in flight: two parabolas, or paths with air drag, that meet at the wall."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from carom.tracks.flights import STILL_AIR, Air, flight_path
from carom.tracks.least_squares import (
    START_IN,
    START_OUT,
    ContactFit,
    central_differences,
    contact_fit,
    solve,
    starting_values,
)

__all__ = ["fit_flight"]

Array = NDArray[np.float64]
# The parameters: the starting values, and gravity
TIME, PLACE, DISTANCE, V_IN, V_OUT, GRAVITY = 0, slice(1, 3), 1, START_IN, START_OUT, slice(7, 9)
DRAG_STEP = 1e-3  # 1/m, by which the derivative by the drag is taken


def _position(theta: Array, t: Array, drag: float) -> Array:
    s = t - theta[TIME]
    if drag == 0:
        velocity = np.where(s[:, None] < 0, theta[V_IN], theta[V_OUT])
        return np.asarray(theta[PLACE] + velocity * s[:, None] + theta[GRAVITY] * (s * s / 2)[:, None])
    sides = [flight_path(theta[side], theta[GRAVITY], drag, s[rows]) for side, rows in ((V_IN, s < 0), (V_OUT, s >= 0))]
    found = np.empty((len(s), 2))
    found[s < 0], found[s >= 0] = sides
    return found + theta[PLACE]


def _outputs(theta: Array) -> Array:
    """Return the quantities of OUTPUTS, with the components of gravity for mu_g and c_g."""
    return np.array([*theta[: V_OUT.stop], *[np.nan] * 6, *theta[GRAVITY], np.nan, np.nan])


def fit_flight(
    time: Array, position: Array, near: float, noise: float, gravity: Array, error: float, wall: float | None = None,
    air: Air = STILL_AIR,
) -> ContactFit:  # fmt: skip
    """Fit a contact of a ball in flight.

    Parameters as in :func:`carom.tracks.contact_models.fit_table`; ``gravity`` (2,), m/s^2, is a prior in the frame of the wall
    with the standard deviation ``error``; of ``air`` the drag counts, and its error is part of those of the result. In the
    result the fitted gravity takes the place of mu_g (away from the wall) and c_g (along it).
    """
    theta = np.concatenate([starting_values(time, position, time < near, time >= near, near), gravity])
    scale = np.array([1e-3, 1e-3, 1e-3, *[0.05] * 4, *[0.2] * 2])

    def residual(theta: Array, drag: float = air.drag) -> Array:
        gap = (position - _position(theta, time, drag)) / noise
        known = list((theta[GRAVITY] - gravity) / error)
        if wall is not None:
            known.append((theta[DISTANCE] - wall) / noise)
        return np.concatenate([gap.ravel(), known])

    def slope(theta: Array) -> Array:
        return central_differences(residual, theta, 1e-4 * scale)

    best, _chi2 = solve(residual, slope, theta, scale)
    rates = slope(best)
    fit = contact_fit(
        best, np.ones(len(theta), bool), residual, rates, _outputs, partial(_position, best, drag=air.drag),
        scale=scale, time=time, noise=noise,
    )  # fmt: skip
    if not air.drag_error:
        return fit
    change = (residual(best, air.drag + DRAG_STEP) - residual(best, air.drag - DRAG_STEP)) * (
        air.drag_error / DRAG_STEP / 2
    )
    shift = np.nan_to_num(_outputs(best - np.linalg.lstsq(rates, change, rcond=None)[0]) - _outputs(best))
    return replace(fit, covariance=fit.covariance + np.outer(shift, shift), drag_shift=shift)
