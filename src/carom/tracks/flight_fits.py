"""Fit of a contact of a ball in flight: two parabolas, or paths with air drag, that meet at the wall."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from carom.tracks.correlation import FittedFrames, nearest_frames
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


def _slope_in_vacuum(theta: Array, t: Array) -> Array:
    """Return the derivatives (n, 2, 9) of the positions with respect to theta, without drag."""
    s = t - theta[TIME]
    found = np.zeros((len(t), 2, len(theta)))
    for component in (0, 1):
        for part, rows in ((V_IN, s < 0), (V_OUT, s >= 0)):
            found[rows, component, TIME] = -theta[part][component] - theta[GRAVITY][component] * s[rows]
            found[rows, component, part.start + component] = s[rows]
        found[:, component, PLACE.start + component] = 1.0
        found[:, component, GRAVITY.start + component] = s * s / 2
    return found


def _outputs(theta: Array) -> Array:
    """Return the quantities of OUTPUTS, with the components of gravity for mu_g and c_g."""
    return np.array([*theta[: V_OUT.stop], *[np.nan] * 6, *theta[GRAVITY], np.nan, np.nan])


def fit_flight(
    time: Array, position: Array, near: float, noise: float, gravity: Array, error: float, wall: float | None = None,
    air: Air = STILL_AIR, whiten: Array | None = None,
) -> ContactFit:  # fmt: skip
    """Fit a contact of a ball in flight.

    Parameters as in :func:`carom.tracks.contact_models.fit_table`; ``gravity`` (2,), m/s^2, is a prior in the frame of the wall
    with the standard deviation ``error``; ``whiten`` (n, n) makes the errors of the frames independent; of ``air`` the drag
    and the tilt count, and their errors are part of those of the result. In the result the fitted gravity takes the place of mu_g
    (away from the wall) and c_g (along it).
    """
    theta = np.concatenate([starting_values(time, position, time < near, time >= near, near), gravity])
    scale = np.array([1e-3, 1e-3, 1e-3, *[0.05] * 4, *[0.2] * 2])

    # a drag that the flights do not show changes the velocities little: by the derivatives, after a fit without it
    used = air.drag if air.drag_shown else 0.0

    known_slope = np.zeros((2 if wall is None else 3, len(theta)))
    known_slope[0, GRAVITY.start] = known_slope[1, GRAVITY.start + 1] = 1 / error
    if wall is not None:
        known_slope[2, DISTANCE] = 1 / noise

    def residual(theta: Array, drag: float = used) -> Array:
        gap = (position - _position(theta, time, drag)) / noise
        gap = gap if whiten is None else whiten @ gap
        known = list((theta[GRAVITY] - gravity) / error)
        if wall is not None:
            known.append((theta[DISTANCE] - wall) / noise)
        return np.concatenate([gap.ravel(), known])

    def slope(theta: Array) -> Array:
        if used:
            return central_differences(residual, theta, 1e-4 * scale)
        places = _slope_in_vacuum(theta, time) / -noise
        frames = places if whiten is None else np.tensordot(whiten, places, 1)
        return np.concatenate([frames.reshape(-1, len(theta)), known_slope])

    best, _chi2 = solve(residual, slope, theta, scale)
    early, late = time[time < near][-1], time[time >= near][0]
    if not 2 * early - late < best[TIME] < 2 * late - early:  # straight lines through bent flights met elsewhere
        fall = gravity * (np.square(time - near) / 2)[:, None]
        theta = np.concatenate([starting_values(time, position - fall, time < near, time >= near, near), gravity])
        best, _chi2 = solve(residual, slope, theta, scale)
    rates = slope(best)
    fit = contact_fit(
        best, np.ones(len(theta), bool), residual, rates, _outputs, partial(_position, best, drag=used),
        scale=scale, time=time, noise=noise,
    )  # fmt: skip
    rows = nearest_frames(time, best[TIME])
    t = time[rows]
    slopes = central_differences(lambda one: _position(one, t, used).ravel(), best, 1e-4 * scale)
    measured = np.ptp(position, axis=0) > 0  # (of a height alone, the other coordinate is 0 throughout)
    slopes = slopes.reshape(-1, 2, len(best))[:, measured]
    gaps = position - _position(best, time, used)
    fitted = FittedFrames(t, gaps[rows][:, measured], slopes, rates[2 * len(time) :], noise)
    dof = fit.dof - (~measured).sum() * (len(time) - (PLACE.stop - PLACE.start) - 1)
    fit = replace(fit, residuals=gaps, fitted=fitted, dof=float(dof))
    # velocities in the frame of a wall that is turned counter-clockwise, per radian
    turn = np.nan_to_num(_outputs(np.concatenate([np.zeros(3), *(_turned(best[of]) for of in (V_IN, V_OUT, GRAVITY))])))
    shifts = {"roll": turn * air.tilt_error} if air.tilt_error else {}
    value = fit.value + turn * air.tilt
    if air.drag_error:
        change = (residual(best, used + DRAG_STEP) - residual(best, used - DRAG_STEP)) / (2 * DRAG_STEP)
        by_drag = np.nan_to_num(_outputs(best - np.linalg.lstsq(rates, change, rcond=None)[0]) - _outputs(best))
        value = value + by_drag * (air.drag - used)
        shifts["drag"] = (by_drag + turn * air.tilt_by_drag) * air.drag_error
    covariance = fit.covariance + sum(np.outer(shift, shift) for shift in shifts.values())
    return replace(fit, value=value, covariance=covariance, shifts=shifts)


def _turned(v: Array) -> Array:
    """Return by how much the components (away, along) of a vector change per radian by which the wall turns."""
    return np.array([v[1], -v[0]])


def with_other_drag(fit: ContactFit, was: Air, now: Air) -> ContactFit:
    """Return a fit with another drag and error: the outputs are linear in the drag as far as these go."""
    if "drag" not in fit.shifts or not was.drag_error:
        return fit
    old = fit.shifts["drag"]
    shift = old * (now.drag_error / was.drag_error)
    covariance = fit.covariance - np.outer(old, old) + np.outer(shift, shift)
    value = fit.value + old * ((now.drag - was.drag) / was.drag_error)
    return replace(fit, value=value, covariance=covariance, shifts={**fit.shifts, "drag": shift})
