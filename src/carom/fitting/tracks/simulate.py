"""Positions of thousands of short runs of one ball at the times of frames, and their derivatives."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from carom.core.jit.dual.dual_records import float_count, float_places
from carom.core.jit.dual.numbers import LANES
from carom.simulation.records import BALLS
from carom.simulation.sensitivity.at_times import Slopes, states_and_slopes, states_at
from carom.simulation.setup import SceneArrays

__all__ = ["START", "positions_and_slopes", "positions_at", "start_slopes"]

Array = NDArray[np.float64]
START = ("x", "y", "v_x", "v_y", "u_x", "u_y", "spin_z")
"""The numbers of a start: position (m), velocity (m/s), slip on the floor (m/s), sidespin (rad/s)."""


def _balls(arrays: SceneArrays, start: Array) -> NDArray[np.void]:
    """Return the balls (N, 1) of starts (N, 7)."""
    n = len(start)
    balls = np.repeat(arrays.balls[:1], n)
    a = balls["radius"]
    x, v, u = start[:, :2], start[:, 2:4], start[:, 4:6]
    balls["x"] = np.column_stack([x, a])
    balls["v"] = np.column_stack([v, np.zeros(n)])
    # the slip is u = v + w x (-a z) = (v_x - a w_y, v_y + a w_x)
    balls["w"] = np.column_stack([(u[:, 1] - v[:, 1]) / a, (v[:, 0] - u[:, 0]) / a, start[:, 6]])
    return np.asarray(balls[:, None])


def start_slopes(radius: float) -> Array:
    """Return the derivatives (numbers of a ball, 7) of a ball with respect to its start."""
    found, x, v, w = np.zeros((float_count(BALLS), len(START))), *(float_places(BALLS)[name].start for name in "xvw")
    for k, name in enumerate(START):
        place = {"x": x, "y": x + 1, "v_x": v, "v_y": v + 1, "spin_z": w + 2}.get(name)
        if place is not None:
            found[place, k] = 1.0
    found[w, START.index("u_y")] = found[w + 1, START.index("v_x")] = 1 / radius
    found[w, START.index("v_y")] = found[w + 1, START.index("u_x")] = -1 / radius
    return found


def positions_at(arrays: SceneArrays, start: Array, time: Array, count: NDArray[np.int64]) -> Array:
    """Return positions (N, T, 2) of N runs of one ball each, m; NaN beyond a run's frames, and where its law is undefined.

    ``start`` (N, 7) as START says, ``time`` (N, T) are s since the start, of which ``count`` (N,) are evaluated.
    """
    return states_at(arrays, _balls(arrays, start), time, count, 2)[:, :, 0]


def positions_and_slopes(
    arrays: SceneArrays, duals: NDArray[np.int64], start: Array, time: Array, count: NDArray[np.int64], by_scene: Slopes,
    by_start: Array,
) -> tuple[Array, Array]:  # fmt: skip
    """Return positions as :func:`positions_at`, and their exact derivatives (N, T, 2, C LANES); 0 from a graze on.

    ``duals``, ``by_scene``, ``by_start``: as for :func:`carom.simulation.sensitivity.at_times.states_and_slopes`.
    """
    states, slopes = states_and_slopes(arrays, duals, _balls(arrays, start), time, count, by_scene, by_start, 2)
    n, chunks, frames = slopes.shape[:3]
    return states[:, :, 0, :2], np.moveaxis(slopes[:, :, :, 0], 1, 3).reshape(n, frames, 2, chunks * LANES)
