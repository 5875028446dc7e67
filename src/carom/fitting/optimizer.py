"""Bounded Levenberg-Marquardt minimisation of many problems at once, and searches that continue beyond kinks.

One optimiser serves all fits: rebounds (where a bootstrap is a thousand fits, and the deviance of a row with unmeasured spin is not
a sum of squares), the initial state of each track segment, and the parameters that all segments share.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

__all__ = ["EVERYWHERE", "Minimum", "bounded_step", "cross_kinks", "minimize", "observed_information"]

Array = NDArray[np.float64]
Indices = NDArray[np.int64]
Evaluate = Callable[[Indices, Array, bool], tuple[Array, Array, Array]]
Best = TypeVar("Best")
MAX_FAILURES = 12  # successive steps without a decrease
NEARBY = (0.7, 0.82, 0.9, 0.94, 0.96, 0.98, 1.02, 1.04, 1.06, 1.1, 1.2, 1.4)  # multiples of a friction, to be held
EVERYWHERE = (0.07, 0.1, 0.14, 0.18, 0.23, 0.3, 0.4)  # frictions
ROUNDS = 4
WITHIN, LEAST_PART = 0.3, 0.05  # error bars of a difference of scores; the least part of the information that is kept
TINY = 1e-12


@dataclass(frozen=True, eq=False)
class Minimum:
    """End points of B problems."""

    p: Array
    """(B, k)"""
    value: Array
    """(B,)"""
    score: Array
    """(B, k) -1/2 of the gradient."""
    information: Array
    """(B, k, k) 1/2 of the curvature."""


def minimize(
    evaluate: Evaluate, start: Array, low: Array, high: Array, *, steps: int, tolerance: float, dof: Array | None = None,
    joint: bool = True, most: float = np.inf,
) -> Minimum:  # fmt: skip
    """Minimise B functions of k numbers within bounds, from ``start`` (B, k).

    ``evaluate(which, p, derivatives)`` returns values, scores and information of some problems; without derivatives the last two
    are not used. ``joint``: derivatives cost little more than values, and are evaluated with them unless the last step failed; else
    only if a step succeeded. A problem ends when a step gains less than ``tolerance``, or than that fraction of its value per
    degree of freedom (``dof``) if the fit is poor. ``steps``: evaluations; 1: only the values at the start. ``most``: the largest
    change of a number in a step.
    """
    p = np.array(start, dtype=float)
    count, k = p.shape
    tried, alive = p.copy(), np.arange(count)
    now, gained = np.full(count, np.inf), np.full(count, np.inf)
    damping, failures = np.full(count, 1e-3), np.zeros(count, int)
    u, h = np.zeros((count, k)), np.zeros((count, k, k))

    def enough(which: Indices) -> Array | float:
        return tolerance if dof is None else tolerance * np.maximum(1.0, now[which] / dof[which])

    for _ in range(steps):
        # after a failed step the next one may fail as well: only values are evaluated until one succeeds
        wary = alive[(failures[alive] > 0) | (not joint)]
        worth = alive[(failures[alive] == 0) & joint]
        if len(wary):
            worth = np.sort(np.append(worth, wary[evaluate(wary, tried[wary], False)[0] < now[wary]]))
        down = worth
        if len(worth):
            then, score, information = evaluate(worth, tried[worth], True)
            better = then < now[worth]
            down = worth[better]
            gained[down], now[down], failures[down] = now[down] - then[better], then[better], 0
            p[down], u[down], h[down] = tried[down], score[better], information[better]
            damping[down] = np.maximum(damping[down] / 10, 1e-9)
        gained_nothing = np.ones(count, bool)
        gained_nothing[down] = False
        up = alive[gained_nothing[alive]]
        failures[up] += 1
        damping[up] = np.maximum(damping[up] * 8, 1e-4)
        alive = alive[(gained[alive] >= enough(alive)) & (failures[alive] <= MAX_FAILURES) & np.isfinite(now[alive])]
        if not len(alive) or k == 0:
            break
        here = p[alive]
        step, damping[alive] = bounded_step(
            h[alive], u[alive], np.maximum(low - here, -most), np.minimum(high - here, most), damping[alive]
        )
        tried[alive] = np.clip(here + step, low, high)
        promise = ((tried[alive] - here) * u[alive]).sum(axis=1)
        alive = alive[promise > enough(alive)]
        if not len(alive):
            break
    return Minimum(p, now, u, h)


def bounded_step(h: Array, u: Array, low: Array, high: Array, damping: Array) -> tuple[Array, Array]:
    """Return the step (B, k) between ``low`` and ``high`` (B, k) with the least s (h + damping diag h) s / 2 - u s, and a damping
    that is enough to make the matrices positive definite.

    Numbers are held at their bounds until none is beyond them and none would gain by leaving. All that have to change do so at
    once; where that goes in circles, one after the other, which ends (block principal pivoting: Judice & Pires, Comput. Oper.
    Res. 21, 587 (1994), https://doi.org/10.1016/0305-0548(94)90106-6).
    """
    k = u.shape[1]
    diagonal, damping, eye = np.abs(np.einsum("bjj->bj", h)), damping.copy(), np.eye(k)
    step = np.clip(np.zeros_like(u), low, high)
    held = ((step <= low) & (u < 0)) | ((step >= high) & (u > 0))
    for turn in range(10 * k):
        free = ~held
        rest = np.where(free, u - np.einsum("bjm,bm->bj", h, np.where(held, step, 0.0)), 0.0)
        plain = np.where(free[:, :, None] & free[:, None, :], h, 0.0)
        for _ in range(40):
            matrix = plain + np.where(free, damping[:, None] * diagonal + 1e-9, 1.0)[:, :, None] * eye
            strength, direction = np.linalg.eigh(matrix)
            bad = ~(strength.min(axis=1) > 0)
            if not bad.any():
                break
            damping[bad] = np.maximum(10 * damping[bad], 1e-3)
        along = np.einsum("bjm,bj->bm", direction, rest) / np.where(strength > 0, strength, np.inf)
        step = np.where(held, step, np.einsum("bjm,bm->bj", direction, along))
        slope = u - np.einsum("bjm,bm->bj", h, step) - (damping[:, None] * diagonal + 1e-9) * step
        down, up = (held & (slope < 0)) | (step < low), (held & (slope > 0)) | (step > high)
        step = np.clip(step, low, high)
        now = (down & (step <= low)) | (up & (step >= high))
        change = now != held
        if not change.any():
            break
        if turn >= k:
            change &= np.cumsum(change[:, ::-1], axis=1)[:, ::-1] == 1
        held ^= change
    return step, damping


def observed_information(
    scores: Callable[[Array], Array], at: Array, complete: Array, most: Array, low: Array, high: Array
) -> Array:
    """Return the information (k, k) at a place (k,), from differences of the scores over a third of an error bar to both sides.

    Kinks of single rows average out over that. ``scores``: (B, k) of places (B, k); ``complete``: the information (k, k) by which
    error bars are judged, a part of which is kept in directions in which the differences have less; ``most``: the largest steps.
    """
    scale = np.sqrt(np.maximum(np.diag(complete), TINY))
    step = np.diag(np.minimum(WITHIN / scale, most))
    up, down = (np.clip(at + sign * step, low, high) for sign in (1, -1))
    less, more = np.split(scores(np.concatenate([up, down])), 2)
    h = (more - less) / np.maximum((up - down).diagonal(), TINY)[:, None]
    strength, direction = np.linalg.eigh((h + h.T) / 2 / np.outer(scale, scale))
    return np.asarray((direction * np.maximum(strength, LEAST_PART)) @ direction.T * np.outer(scale, scale))


def cross_kinks(
    best: Best, friction: Callable[[Best], float], deviance: Callable[[Best], float],
    explore: Callable[[Best, list[float], list[float]], Best], astray: Callable[[Best], bool] = lambda _best: False,
) -> Best:  # fmt: skip
    """Continue a search beyond kinks of the deviance, where contacts change between sliding and sticking.

    A descent can end at the bottom of one. So the friction is held at other values, near ones and, first and for a fit that is
    ``astray``, widely spread ones, while all else is fitted, and the most promising are freed (``explore``), until there is no
    further gain.
    """
    for turn in range(ROUNDS):
        here = friction(best)
        found = explore(best, [share * here for share in NEARBY], list(EVERYWHERE) if turn == 0 or astray(best) else [])
        gained = deviance(best) - deviance(found)
        best = found if gained > 0 else best
        if gained < max(0.5, 1e-3 * abs(deviance(best))):
            break
    return best
