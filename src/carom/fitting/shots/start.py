"""The start of a shot as a vector of numbers, its priors, and the states that it leads to, with derivatives."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.fitting.shots.film import FilmedShot
from carom.fitting.starts import balls_by, balls_of, states_by
from carom.fitting.table_numbers import TableNumbers
from carom.simulation.sensitivity.at_times import Limits, states_at

__all__ = [
    "FIRST_PLACE", "LIMITS", "SPIN", "TIME", "VELOCITY", "Residuals", "StartPrior", "distances", "residuals", "start_size",
    "starting_balls",
]  # fmt: skip

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
    """A normal prior of a start: rows times (start - centre) are of unit width.

    After its own numbers a start may have those by which the table differs for this shot, normal about zero.
    """

    center: Array
    rows: Array

    def with_scatter(self, balls: int, widths: Array) -> StartPrior:
        """Return the prior with deviations of the table's numbers, of such widths (R,), after the start's own numbers."""
        k = start_size(balls)
        center, rows = np.zeros(k + len(widths)), np.zeros((k + len(widths),) * 2)
        center[:k], rows[:k, :k] = self.center[:k], self.rows[:k, :k]
        rows[range(k, len(rows)), range(k, len(rows))] = 1 / widths
        return StartPrior(center, rows)

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
    """(N, M) m, two for each frame and ball."""
    by_start: Array
    """(N, M, K) derivatives by the starts."""
    by_shared: Array
    """(N, M, P) derivatives by the shared numbers."""


def _by_start(balls: int, radius: float) -> Array:
    """Return the derivatives of balls by the numbers of a start, in their order (:func:`carom.fitting.starts.balls_by`)."""
    velocity = [[(0, "v", j, 1.0)] for j in range(2)]
    spin = [[(0, "w", j, 1 / radius)] for j in range(3)]
    return balls_by(balls, [[], *velocity, *spin, *([(k, "x", j, 1.0)] for k in range(balls) for j in range(2))])


def starting_balls(table: TableNumbers, starts: Array, b: int) -> NDArray[np.void]:
    """Return the B balls (N, B) of starts (N, K): a shot may have fewer than others."""
    by = _by_start(b, float(table.arrays.balls["radius"][0]))
    return balls_of(table.arrays, by, starts[:, : start_size(b)])


def _gap(shot: FilmedShot, states: Array, frames: int) -> tuple[Array, NDArray[np.bool_]]:
    """Return model less film (N, frames, B, 2), and where the film is known (frames, B)."""
    known = shot.known[:frames]
    gap = states[..., :2] - np.where(known[:, :, None], shot.position[:frames], 0.0)
    return np.where(np.isnan(gap), UNKNOWN, gap), known


def _places_of(table: TableNumbers, shot: FilmedShot, starts: Array, frames: int | None = None) -> Array:
    """Return the places (N, T, B, 2) at the times of frames for starts (N, K), which may end with deviations of the table's
    numbers; NaN where the model has no state."""
    many, b = len(shot.time) if frames is None else frames, len(shot.balls)
    time = np.maximum(shot.time[None, :many] - starts[:, :1], 0.0)
    arrays = table.moved(starts[:, start_size(b) :])
    return states_at(arrays, starting_balls(table, starts, b), time, np.full(len(starts), many), 2, LIMITS)


def distances(table: TableNumbers, shot: FilmedShot, starts: Array, frames: int) -> Array:
    """Return squared distances (N, M) of the known frames up to a horizon, m^2, for starts (N, K)."""
    gap, known = _gap(shot, _places_of(table, shot, starts, frames), frames)
    return np.asarray(np.square(gap).sum(axis=-1)[:, known])


def residuals(table: TableNumbers, shot: FilmedShot, starts: Array, frames: int, shared: bool = False) -> Residuals:
    """Return model less film up to a horizon for starts (N, K), with exact derivatives by them, and on request by the shared
    numbers."""
    b, radius = len(shot.balls), float(table.arrays.balls["radius"][0])
    k, by = start_size(b), _by_start(b, radius)
    time = np.maximum(shot.time[:frames] - starts[:, TIME, None], 0.0)
    balls, own = balls_of(table.arrays, by, starts[:, :k]), starts.shape[1] > k
    known, n = shot.known[:frames], len(starts)
    at = states_by(
        table, balls, by, time, np.full(n, frames), shared=shared or own, deviations=starts[:, k:], limits=LIMITS
    )
    gap = _gap(shot, at.states, frames)[0][:, known].reshape(n, -1)
    moving = np.where(time > 0, 1.0, 0.0)[:, :, None, None]
    at.by_start[..., TIME] = -np.nan_to_num(at.states[..., 3:5] * moving)
    found = np.concatenate([at.by_start[:, known], at.by_shared[:, known]], axis=-1).reshape(*gap.shape, -1)
    found[~np.isfinite(found).all(axis=-1)] = 0.0
    return Residuals(gap, found if own else found[..., :k], found[..., k:])
