"""Starts of filmed balls: the states that they lead to, with derivatives, the start whose run is nearest to the frames, and the
descent of the numbers that all share, which the starts follow.

A start is a vector of numbers in which the places, velocities and spins of the balls are linear. One call serves N starts of one
ball each (segments of tracks) as well as one start of many balls (a shot).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple, Protocol, TypeVar

import numpy as np
from numpy.typing import NDArray

from carom.core.jit.dual.dual_records import float_count, float_places
from carom.core.jit.dual.numbers import LANES
from carom.fitting.optimizer import Minimum, minimize
from carom.fitting.table_numbers import TableNumbers
from carom.simulation.records import BALLS
from carom.simulation.sensitivity.at_times import SEGMENT, Limits, states_and_slopes
from carom.simulation.setup import SceneArrays

__all__ = [
    "Followers",
    "Projection",
    "StatesBy",
    "balls_by",
    "balls_of",
    "descend_shared",
    "nearest_starts",
    "states_by",
]

Array = NDArray[np.float64]
Residual = Callable[[NDArray[np.int64], Array, bool], tuple[Array, Array | None]]
"""Of some starts: gaps (n, M) in standard deviations, and on request their derivatives (n, M, K)."""
Tried = TypeVar("Tried")


def balls_by(balls: int, numbers: Sequence[Sequence[tuple[int, str, int, float]]]) -> Array:
    """Return the derivatives (B, numbers of a ball, K) of balls by the K numbers of a start.

    Of each number of the start what it moves: ball, x, v or w, the component, and by how much.
    """
    found, places = np.zeros((balls, float_count(BALLS), len(numbers))), float_places(BALLS)
    for k, moved in enumerate(numbers):
        for ball, name, component, slope in moved:
            found[ball, places[name].start + component, k] = slope
    return found


def balls_of(arrays: SceneArrays, by: Array, starts: Array) -> NDArray[np.void]:
    """Return the balls (N, B), which lie on the floor, of starts (N, K); ``by`` (B, numbers, K): :func:`balls_by`."""
    balls, places = np.tile(arrays.balls[: len(by)], (len(starts), 1)), float_places(BALLS)
    for name in "xvw":
        balls[name] = np.einsum("bfk,nk->nbf", by[:, places[name]], starts)
    balls["x"][..., 2] = balls["radius"]
    return balls


class StatesBy(NamedTuple):
    """States of N runs of B balls at T times, with exact derivatives."""

    states: Array
    """(N, T, B, 9): position, velocity, spin; NaN where the model has none."""
    by_start: Array
    """(N, T, B, n, K): of their first n numbers, by the numbers of the start; 0 from a graze on."""
    by_shared: Array
    """(N, T, B, n, P): by the numbers of the table."""


def states_by(
    table: TableNumbers, balls: NDArray[np.void], by: Array, time: Array, count: NDArray[np.int64], numbers: int = 2, *,
    shared: bool = False, deviations: Array | None = None, limits: Limits = SEGMENT,
) -> StatesBy:  # fmt: skip
    """Return states of runs of balls (N, B) at times (N, T) since their starts, of which ``count`` (N,) are evaluated, s.

    ``by``: :func:`balls_by`; ``numbers``: of a state, whose derivatives are wanted; ``shared``: whether those by the table's
    numbers are; ``deviations`` (P,) or (N, P): by which these differ for these runs, or for each.
    """
    b, floats, k = by.shape
    parts = table.slopes if shared else {}
    mine = -(-k // LANES)
    by_start = np.zeros((1, mine + (len(parts["world"]) if parts else 0), b, floats, LANES))
    for column in range(k):
        by_start[0, column // LANES, :, :, column % LANES] = by[:, :, column]
    by_scene = {
        name: np.concatenate(
            [np.zeros((mine, len(rows), float_count(rows.dtype), LANES)), *([parts[name]] if parts else [])]
        )
        for name, rows in (("world", table.arrays.world), ("features", table.arrays.features))
    }
    arrays = table.arrays if deviations is None else table.moved(deviations)
    states, slopes = states_and_slopes(
        arrays, table.duals, balls, time, count, by_scene, by_start, numbers, limits=limits
    )
    d = np.moveaxis(slopes, 1, 4).reshape(*slopes.shape[:1], *slopes.shape[2:5], -1)
    first = mine * LANES
    return StatesBy(states, d[..., :k], d[..., first : first + (len(table.values) if parts else 0)])


def nearest_starts(
    residual: Residual, begin: Array, scale: Array, center: Array, rows: Array, *, steps: int, tolerance: float, dof: Array,
    joint: bool,
) -> tuple[Array, Minimum]:  # fmt: skip
    """Find the nearest minima of N sums of squares: gaps and prior. Return the starts (N, K), and the minima in units of ``scale``.

    From ``begin`` (N, K), with ``scale`` (N, K), 0 of a number that is held. Priors are normal: ``rows`` (N, R, K) times (start -
    ``center`` (N, K)) are of unit width. The rest: :func:`carom.fitting.optimizer.minimize`.
    """

    def evaluate(which: NDArray[np.int64], u: Array, derivatives: bool) -> tuple[Array, Array, Array]:
        at = begin[which] + scale[which] * u
        gap, slope = residual(which, at, derivatives)
        off = np.einsum("nrk,nk->nr", rows[which], at - center[which])
        value = np.square(gap).sum(axis=1) + np.square(off).sum(axis=1)
        if slope is None:
            return value, u, u
        slope, prior = slope * scale[which][:, None], rows[which] * scale[which][:, None]
        # (1 for a held number: a 0 is lost in the rounding of the others, and the matrix taken for an indefinite one)
        held = (scale[which] == 0)[:, :, None] * np.eye(begin.shape[1])
        with np.errstate(over="ignore", invalid="ignore"):
            score = -np.einsum("nmk,nm->nk", slope, gap) - np.einsum("nrk,nr->nk", prior, off)
            information = np.swapaxes(slope, 1, 2) @ slope + np.swapaxes(prior, 1, 2) @ prior + held
        # (derivatives through many contacts may be so large that their squares are infinite: such a start stays where it is)
        lost = ~np.isfinite(information).all(axis=(1, 2))
        score[lost], information[lost] = 0.0, np.eye(begin.shape[1])
        return value, score, information

    far = np.full(begin.shape[1], np.inf)
    found = minimize(evaluate, np.zeros_like(begin), -far, far, steps=steps, tolerance=tolerance, dof=dof, joint=joint)
    return begin + scale * found.p, found


class Projection(NamedTuple):
    """The starts' part of the derivatives of residuals: variable projection (Golub & Pereyra, SIAM J. Numer. Anal. 10, 413 (1973))
    with Kaufman's derivative, BIT 15, 49 (1975)."""

    basis: Array
    """(..., M, K) orthonormal."""
    inverse: Array
    """(..., K, K): basis and inverse make the pseudoinverse of the derivatives by the starts."""

    @classmethod
    def of(cls, by_start: Array) -> Projection:
        """Return the projection for residuals (..., M), prior included, with such derivatives (..., M, K) by the starts."""
        with np.errstate(over="ignore"):  # (derivatives too large to be squared have no part in the fit)
            unit = 1 / np.maximum(np.sqrt(np.square(by_start).sum(axis=-2)), 1e-300)
        basis, triangle = np.linalg.qr(by_start * unit[..., None, :])
        return cls(basis, unit[..., :, None] * np.linalg.pinv(triangle, rcond=1e-12))

    def rest(self, by_shared: Array) -> Array:
        """Return the derivatives (..., M, P) with the starts refitted; the squares of these are the information."""
        return np.asarray(by_shared - self.basis @ (np.swapaxes(self.basis, -1, -2) @ by_shared))

    def follows(self, by_shared: Array) -> Array:
        """Return how the starts follow the shared numbers (..., K, P)."""
        return np.asarray(-self.inverse @ (np.swapaxes(self.basis, -1, -2) @ by_shared))


class Followers(Protocol[Tried]):
    """Filmed balls whose starts follow the numbers that all share: segments of tracks, or shots."""

    def tried(self, values: Array) -> tuple[float, Tried]:
        """Return the deviance at shared numbers (P,) with the starts fitted again, from the best so far, and these starts; inf
        where no table has such numbers."""

    def taken(self, values: Array, tried: Tried) -> tuple[float, Array, Array]:
        """Take these starts for the best so far. Return the deviance, -1/2 of its gradient (P,) and 1/2 of its curvature (P, P),
        with the starts projected out. (They may be fitted once more, which makes the deviance smaller.)"""


def descend_shared(
    followers: Followers[Tried], begin: Array, low: Array, high: Array, *, steps: int, tolerance: float, dof: float | None = None,
    most: float = np.inf,
) -> Array:  # fmt: skip
    """Return the numbers (P,) that all share, at the nearest minimum: variable projection within bounds.

    The rest: :func:`carom.fitting.optimizer.minimize`.
    """
    last: tuple[float, Tried]

    def evaluate(_which: NDArray[np.int64], at: Array, derivatives: bool) -> tuple[Array, Array, Array]:
        nonlocal last
        if not derivatives:
            last = followers.tried(at[0])
            return np.array([last[0]]), at, at
        value, score, information = followers.taken(at[0], last[1])
        return np.array([value]), score[None], information[None]

    each = None if dof is None else np.array([dof])
    found = minimize(
        evaluate, begin[None], low, high, steps=steps, tolerance=tolerance, dof=each, joint=False, most=most
    )
    return np.asarray(found.p[0])
