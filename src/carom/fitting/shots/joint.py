"""Shared numbers of the table from many shots: the starts follow, and each shot counts by the logarithm of its distance.

For given numbers every shot has its own best start, and the numbers minimise the rest: variable projection, with Kaufman's
derivative (BIT 15, 49 (1975)). What is minimised is the sum over shots of log(mean square distance), the likelihood if each shot
has an unknown scatter of its own: one shot that changes to another sequence of events costs little, and blocks no step.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from carom.fitting.shots.film import FilmedShot
from carom.fitting.shots.search import FAILED, Refined, ShotStart, horizons, refined, rms, soft
from carom.fitting.shots.start import residuals
from carom.fitting.shots.table import TableModel, TableNumbers

__all__ = ["JointFit", "fit_shared", "frames_of_events", "information_of_shots"]

Array = NDArray[np.float64]
FLOOR = 5e-4  # m, of a distance: less has no more weight
EVALUATIONS, STEPS = 6, 20
GAIN = 1e-3  # of the mean logarithm, below which the search ends
LARGEST_STEP = 4.0  # usual changes of a number


@dataclass(eq=False)
class JointFit:
    """Values of the shared numbers, with the starts that go with them."""

    values: Array
    frames: list[int]
    """Of each shot: how many are fitted; 0 for a shot that is left out."""
    found: list[Refined]
    objective: float


def frames_of_events(shot: FilmedShot, events: int) -> int:
    """Return the horizon before the event after so many, at least that of the first ball."""
    every = horizons(shot)
    lows = sorted(one.low for one in shot.events)
    wanted = shot.frames_until(lows[events]) if len(lows) > events else len(shot.time)
    return max((n for n in every if n <= wanted), default=every[0])


def _all_refined(
    table: TableNumbers, starts: Sequence[ShotStart], frames: Sequence[int], sigmas: Sequence[float | None],
    firsts: Sequence[Array | None],
) -> list[Refined]:  # fmt: skip
    return [
        refined(table, one, n, EVALUATIONS, 2, sigma, first)
        for one, n, sigma, first in zip(starts, frames, sigmas, firsts, strict=True)
    ]


def _objective(starts: Sequence[ShotStart], frames: Sequence[int], found: Sequence[Refined]) -> float:
    return float(sum(np.log(_mean_square(one, n, got)) for one, n, got in zip(starts, frames, found, strict=True)))


def _mean_square(start: ShotStart, frames: int, found: Refined) -> float:
    return found.cost * found.sigma**2 / int(start.shot.known[:frames].sum()) + FLOOR**2


def information_of_shots(
    table: TableNumbers, starts: Sequence[ShotStart], frames: Sequence[int], found: Sequence[Refined], count: int
) -> tuple[Array, Array, list[Array]]:
    """Return scores (N, P) and information (N, P, P) of each shot on the shared numbers, with its start free, and how each start
    follows these: N of (K, P)."""
    scores, matrices, follows = np.zeros((len(starts), count)), np.zeros((len(starts), count, count)), []
    for i, (one, n, got) in enumerate(zip(starts, frames, found, strict=True)):
        at = residuals(table, one.shot, got.start, n, shared=True)
        gap, (by_start, by_shared) = soft(at.gap, [at.by_start, at.by_shared[:, :count]], got.sigma)
        rows = np.concatenate([by_start, one.prior.rows])
        r = np.concatenate([gap, one.prior.rows @ (got.start - one.prior.center)])
        d = np.concatenate([by_shared, np.zeros((len(one.prior.rows), count))])
        size = 1 / np.maximum(np.sqrt(np.square(rows).sum(axis=0)), 1e-300)
        q, triangle = np.linalg.qr(rows * size)
        follows.append(-size[:, None] * np.linalg.lstsq(triangle, q.T @ d, rcond=1e-12)[0])
        d = d - q @ (q.T @ d)
        weight = got.sigma**2 / (_mean_square(one, n, got) * int(one.shot.known[:n].sum()))
        scores[i], matrices[i] = -weight * (d.T @ r), weight * (d.T @ d)
    return scores, matrices, follows


def fit_shared(
    model: TableModel, values: Array, starts: Sequence[ShotStart], frames: Sequence[int], tell: Callable[[float], None]
) -> JointFit:
    """Find the values of the shared numbers; the starts' best and pools are brought up to date."""
    shared = model.shared
    low, high, scale = (np.array([getattr(one, name) for one in shared]) for name in ("low", "high", "scale"))
    table = model.at(values)
    none = [None] * len(starts)
    found = _all_refined(table, starts, frames, none, none)
    used = [i for i, one in enumerate(starts) if rms(table, one.shot, found[i].start, frames[i]) < FAILED]
    if not used:
        used = list(range(len(starts)))
    mine, ends = [starts[i] for i in used], [frames[i] for i in used]
    got = [found[i] for i in used]
    damping = 1e-2
    for step in range(STEPS):
        tell(step / STEPS)
        here = _objective(mine, ends, got)
        scores, matrices, follows = information_of_shots(table, mine, ends, got, len(values))
        score, matrix = (scores.sum(axis=0) * scale), matrices.sum(axis=0) * scale[:, None] * scale
        better = None
        for _ in range(4):
            free = ~(((values <= low) & (score < 0)) | ((values >= high) & (score > 0)))
            change = np.zeros(len(values))
            damped = matrix + damping * (np.diag(np.diag(matrix)) + 1e-3 * np.eye(len(values)))
            change[free] = np.linalg.solve(damped[np.ix_(free, free)], score[free])
            change *= min(1.0, LARGEST_STEP / max(np.abs(change).max(), 1e-12))
            tried = np.clip(values + scale * change, low, high)
            other = model.at(tried)
            moved = [one.start + along @ (tried - values) for one, along in zip(got, follows, strict=True)]
            again = _all_refined(other, mine, ends, [one.sigma for one in got], moved)
            if _objective(mine, ends, again) < here:
                better = again
                break
            damping *= 10
        if better is None:
            break
        gain = here - _objective(mine, ends, better)
        values, table, damping = tried, other, damping / 5
        for one, n, start in zip(mine, ends, better, strict=True):
            one.best[n] = start.start
            one.pool.append(start.start)
        got = _all_refined(table, mine, ends, none[: len(mine)], none[: len(mine)])
        if gain < GAIN * len(mine):
            break
    every = _all_refined(table, starts, frames, none, none)
    for one, n, start in zip(starts, frames, every, strict=True):
        one.best[n] = start.start
    return JointFit(values, [n if i in used else 0 for i, n in enumerate(frames)], every, _objective(mine, ends, got))
