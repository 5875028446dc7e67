"""Error bars that do not lean on a parabola: profile likelihood, and rows drawn anew."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from carom.fitting.fit import Estimate, Fit, parameters_of, refit
from carom.fitting.ways import scaled

__all__ = ["with_bootstrap", "with_profiles"]

Array = NDArray[np.float64]

LEVELS = (1.0, 3.8415)  # of the deviance: 68.3 % and 95 % of one number
ROUNDS = 36
CLOSE = 1e-3  # of a level: an end whose deviance is so near it is found
TIGHT = 1e-9  # of the number: a bracket is closed
WIDE = 1.5  # of the error bar: half an interval of 95 %, over 1.96, that is more takes its place
LEAST = 0.1  # of a bracket: no step is shorter, so that both of its sides come nearer


def with_profiles(fit: Fit, names: Sequence[str] | None = None) -> Fit:
    """Intervals of 68 % and 95 % of each number that the data tell, or of those named: where the deviance, all else fitted, has
    risen by 1 and 3.84. All ends of a number are sought at once.

    The curvature is that of the valley in which the best place lies. Where the interval of 95 % is far wider, since it holds
    another or a slope beyond a crease, half its width is 1.96 error bars.
    """
    free, _start, _form = parameters_of(fit.law, fit.problem)
    base = float(refit(fit, fit.problem)[1][0])
    for name, estimate in fit.estimates.items():
        if estimate.value is None or not (names is None or name in names):
            continue
        place, parameter = free[name]
        best = fit.numbers[place]
        goals = np.repeat(LEVELS, 2)
        up = np.tile([False, True], 2)
        edge = np.where(up, parameter.high, parameter.low)
        # brackets: some standard errors away, or the bound
        reach = 6 * estimate.stderr if estimate.stderr else np.inf
        far = np.where(up, np.minimum(best + reach, edge), np.maximum(best - reach, edge))
        p = np.tile(fit.numbers, (4, 1))
        p[:, place] = far
        _p, deviance = refit(fit, fit.problem, p=p.copy(), hold=name)
        inside = deviance - base < goals  # the bracket's far end is not far enough: a bound, or a flat profile
        p[inside, place] = edge[inside]
        far = p[:, place].copy()
        if inside.any():
            deviance[inside] = refit(fit, fit.problem, p=p[inside], hold=name)[1]
        end, open_ = _ends(fit, name, place, base, np.where(deviance - base < goals, edge, far), deviance - base, goals)
        one, two = (float(end[0]), float(end[1])), (float(end[2]), float(end[3]))
        fit = _with(fit, name, replace(estimate, interval_68=one, interval_95=two))
        # an end that lies at a bound, many standard errors away: the parabola at the best place is only its bottom
        far_off = np.abs(end[2:] - best) > 6 * (estimate.stderr or np.inf)
        if (open_[2:] & far_off).any():
            least = f"{end[2]:.3g} or more" if open_[3] and far_off[1] else f"{end[3]:.3g} or less"
            said = f"{fit.law.name}: {name}: only that it is {least} (95 %) can be told; what lies beyond fits as well"
            fit = _with(fit, name, Estimate(None, None, f"{least} (95 %)", one, two))
            covariance, i = fit.covariance.copy(), fit.names.index(name)
            covariance[i, :] = covariance[:, i] = math.nan
            fit = replace(fit, covariance=covariance, degenerate=(*fit.degenerate, said), untold=(*fit.untold, name))
        elif estimate.stderr:
            bar = (two[1] - two[0]) / 2 / math.sqrt(LEVELS[1])
            if bar > WIDE * estimate.stderr:
                fit = scaled(fit, name, bar / estimate.stderr)
    return fit


def _with(fit: Fit, name: str, estimate: Estimate) -> Fit:
    return replace(fit, estimates=fit.estimates | {name: estimate})


def _ends(
    fit: Fit, name: str, place: int, base: float, far: Array, rise: Array, goals: Array
) -> tuple[Array, NDArray[np.bool_]]:
    """Between the best place and ``far``, where the deviance has risen by ``rise``: where it has risen by ``goals``; and which ends
    are open, since it has not.

    The root of the rise is nearly straight; where it is, two steps find the end. Every third step halves, for creases.
    """
    best = float(fit.numbers[place])
    open_ = rise < goals
    near, low, high = np.full(len(far), best), np.zeros(len(far)), np.sqrt(np.maximum(rise, 0.0))
    end, left = far.copy(), np.flatnonzero(~open_)
    for turn in range(ROUNDS):
        if not len(left):
            break
        share = (np.sqrt(goals[left]) - low[left]) / (high[left] - low[left])
        share = np.clip(share, LEAST, 1 - LEAST) if turn % 3 < 2 else np.full(len(left), 0.5)
        end[left] = near[left] + share * (far[left] - near[left])
        p = np.tile(fit.numbers, (len(left), 1))
        p[:, place] = end[left]
        now = refit(fit, fit.problem, p=p, hold=name)[1] - base
        under = now < goals[left]
        in_, out = left[under], left[~under]
        near[in_], low[in_] = end[in_], np.sqrt(np.maximum(now[under], 0.0))
        far[out], high[out] = end[out], np.sqrt(now[~under])
        left = left[
            (np.abs(now - goals[left]) > CLOSE * goals[left]) & (np.abs(far[left] - near[left]) > TIGHT * abs(best))
        ]
    return end, open_


def with_bootstrap(fit: Fit, draws: int, seed: int = 0) -> Fit:
    """Standard errors from fits to rows drawn with replacement (Efron 1979), and errors that all rows share drawn anew."""
    free, _start, _form = parameters_of(fit.law, fit.problem)
    n = len(fit.problem.x)
    rng = np.random.default_rng(seed)
    found = []
    for first in range(0, draws, 250):
        weights = rng.multinomial(n, np.full(n, 1 / n), size=min(250, draws - first)).astype(float)
        middles = rng.normal(size=(len(weights), len(fit.problem.shared)))
        found.append(refit(fit, fit.problem, weights, middles=middles)[0])
    spread = np.nan_to_num(np.concatenate(found), posinf=0.0).std(axis=0, ddof=1)
    estimates = {
        name: one if one.value is None else replace(one, bootstrap=float(spread[free[name][0]]))
        for name, one in fit.estimates.items()
    }
    return replace(fit, estimates=estimates)
