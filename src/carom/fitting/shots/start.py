"""The start of a shot as a vector of numbers, its priors, and the states that it leads to, with derivatives."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.core.jit.dual.dual_records import float_count, float_places
from carom.core.jit.dual.numbers import LANES
from carom.fitting.shots.film import FilmedShot
from carom.fitting.shots.table import TableNumbers
from carom.simulation.records import BALLS
from carom.simulation.sensitivity.at_times import Limits, states_and_slopes, states_at

__all__ = ["FIRST_PLACE", "SPIN", "Residuals", "StartPrior", "distances", "residuals", "start_size"]

Array = NDArray[np.float64]
TIME, VELOCITY, SPIN, FIRST_PLACE = 0, slice(1, 3), slice(3, 6), 6
LIMITS = Limits(rows=768, events=400)
UNKNOWN = 0.3  # m between frame and ball, where the model has no state
# Widths of priors: spin in v/a (about the horizontal axis of rolling and about the way of the ball, sideways), places in m
FOLLOW, FOLLOW_WIDTH, SWERVE_WIDTH, SIDE_WIDTH = 0.4, 0.7, 0.2, 0.7
CUE_PLACE, OBJECT_PLACE = 1e-3, 5e-4


def start_size(balls: int) -> int:
    """Return how many numbers a start has: the time (s), velocity (m/s), spin times radius (m/s), places (m)."""
    return FIRST_PLACE + 2 * balls


class StartPrior(NamedTuple):
    """A normal prior of a start: rows times (start - centre) are of unit width."""

    center: Array
    rows: Array

    @classmethod
    def of(cls, shot: FilmedShot, velocity: Array, noise: float) -> StartPrior:
        """Return the prior for a ball that leaves about with a velocity (2,)."""
        n = start_size(len(shot.balls))
        center, rows = np.zeros(n), np.zeros((n, n))
        speed = max(float(np.hypot(*velocity)), 0.05)
        along = np.asarray(velocity) / speed
        low, high = shot.set_off
        center[TIME], rows[TIME, TIME] = (low + high) / 2, 1 / max((high - low) / 2, 1e-3)
        # rolling: w = z x v / a, so that a w = (-v_y, v_x) for it
        rolling = np.array([-along[1], along[0]])
        center[3:5] = FOLLOW * speed * rolling
        rows[3, 3:5] = rolling / (FOLLOW_WIDTH * speed)
        rows[4, 3:5] = along / (SWERVE_WIDTH * speed)
        rows[5, 5] = 1 / (SIDE_WIDTH * speed)
        center[FIRST_PLACE:] = shot.first.ravel()
        for k in range(len(shot.balls)):
            for j in range(2):
                at = FIRST_PLACE + 2 * k + j
                rows[at, at] = 1 / max(CUE_PLACE if k == 0 else OBJECT_PLACE, noise)
        return cls(center, rows)


class Residuals(NamedTuple):
    """Model less film at the known frames of a shot up to a horizon."""

    gap: Array
    """(M,) m, two for each frame and ball."""
    by_start: Array
    """(M, K) derivatives by the start."""
    by_shared: Array
    """(M, P) derivatives by the shared numbers."""


def _balls(table: TableNumbers, starts: Array) -> NDArray[np.void]:
    """Return the balls (N, B) of starts (N, K)."""
    n, b = len(starts), len(table.arrays.balls)
    balls = np.tile(table.arrays.balls, (n, 1))
    a = float(balls["radius"][0, 0])
    balls["x"][:, :, 2] = a
    balls["x"][:, :, :2] = starts[:, FIRST_PLACE:].reshape(n, b, 2)
    balls["v"][:], balls["w"][:] = 0.0, 0.0
    balls["v"][:, 0, :2] = starts[:, VELOCITY]
    balls["w"][:, 0] = starts[:, SPIN] / a
    return balls


def _gap(shot: FilmedShot, states: Array, frames: int) -> tuple[Array, NDArray[np.bool_]]:
    """Return model less film (N, frames, B, 2), and where the film is known (frames, B)."""
    known = shot.known[:frames]
    gap = states[..., :2] - np.where(known[:, :, None], shot.position[:frames], 0.0)
    return np.where(np.isnan(gap), UNKNOWN, gap), known


def distances(table: TableNumbers, shot: FilmedShot, starts: Array, frames: int) -> Array:
    """Return squared distances (N, M) of the known frames up to a horizon, m^2, for starts (N, K)."""
    time = np.maximum(shot.time[None, :frames] - starts[:, :1], 0.0)
    states = states_at(table.arrays, _balls(table, starts), time, np.full(len(starts), frames), 2, LIMITS)
    gap, known = _gap(shot, states, frames)
    return np.asarray(np.square(gap).sum(axis=-1)[:, known])


def residuals(table: TableNumbers, shot: FilmedShot, start: Array, frames: int, shared: bool = False) -> Residuals:
    """Return model less film up to a horizon, with exact derivatives by the start, and on request by the shared numbers."""
    k, b = len(start), len(shot.balls)
    parts = {name: table.slopes[name] for name in ("world", "features")} if shared and table.slopes else {}
    mine = -(-(k - 1) // LANES)
    own = len(parts["world"]) if parts else 0
    a = float(table.arrays.balls["radius"][0])
    places = float_places(BALLS)
    by_start = np.zeros((1, mine + own, b, float_count(BALLS), LANES))
    at = [(0, places["v"].start, 1.0), (0, places["v"].start + 1, 1.0)]
    at += [(0, places["w"].start + j, 1 / a) for j in range(3)]
    at += [(ball, places["x"].start + j, 1.0) for ball in range(b) for j in range(2)]
    for column, (ball, place, slope) in enumerate(at):
        by_start[0, column // LANES, ball, place, column % LANES] = slope
    by_scene = {
        name: np.concatenate(
            [np.zeros((mine, len(rows), float_count(rows.dtype), LANES)), *([parts[name]] if parts else [])]
        )
        for name, rows in (("world", table.arrays.world), ("features", table.arrays.features))
    }
    time = np.maximum(shot.time[None, :frames] - start[TIME], 0.0)
    balls = _balls(table, start[None])
    states, slopes = states_and_slopes(
        table.arrays, table.duals, balls, time, np.array([frames]), by_scene, by_start, 2, limits=LIMITS
    )
    gap, known = _gap(shot, states[0], frames)
    d = np.moveaxis(slopes[0], 0, 3).reshape(frames, b, 2, -1)[known]
    moving = np.where(time[0] > 0, 1.0, 0.0)[:, None, None]
    by_time = -np.nan_to_num(states[0, :, :, 3:5] * moving)[known]
    found = np.concatenate([by_time[..., None], d[..., : k - 1]], axis=-1).reshape(-1, k)
    count = d.shape[-1] - mine * LANES
    by_shared = d[..., mine * LANES :].reshape(-1, count) if parts else np.zeros((len(found), 0))
    good = np.isfinite(found).all(axis=1) & np.isfinite(by_shared).all(axis=1)
    found[~good], by_shared[~good] = 0.0, 0.0
    return Residuals(gap[known].ravel(), found, by_shared)
