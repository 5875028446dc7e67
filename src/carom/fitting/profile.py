"""Error bars that do not lean on a parabola: profile likelihood, and rows drawn anew."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from carom.fitting.fit import Estimate, Fit, parameters_of, refit

__all__ = ["with_bootstrap", "with_profiles"]

LEVELS = (1.0, 3.8415)  # of the deviance: 68.3 % and 95 % of one number
HALVINGS = 22


def with_profiles(fit: Fit) -> Fit:
    """Intervals of 68 % and 95 % of each number that the data tell: where the deviance, all else fitted, has risen by 1 and
    3.84. All ends are sought at once, by halving."""
    free, _start, _form = parameters_of(fit.law, fit.problem)
    estimates = dict(fit.estimates)
    base = float(refit(fit, fit.problem)[1][0])
    for name, estimate in fit.estimates.items():
        if estimate.value is None:
            continue
        place, parameter = free[name]
        best = fit.numbers[place]
        goals = np.repeat(LEVELS, 2)
        up = np.tile([False, True], 2)
        edge = np.where(up, parameter.high, parameter.low)
        # brackets: some standard errors away, or the bound
        reach = 6 * estimate.stderr if estimate.stderr else np.inf
        far = np.where(up, np.minimum(best + reach, edge), np.maximum(best - reach, edge))
        near = np.full(4, best)
        p = np.tile(fit.numbers, (4, 1))
        p[:, place] = far
        rise = refit(fit, fit.problem, p=p.copy(), hold=name)[1] - base
        inside = rise < goals  # the bracket's far end is not far enough: a bound, or a flat profile
        p[inside, place] = edge[inside]
        rise = refit(fit, fit.problem, p=p.copy(), hold=name)[1] - base
        far, open_ = p[:, place].copy(), rise < goals
        for _ in range(HALVINGS):
            middle = (near + far) / 2
            p = np.tile(fit.numbers, (4, 1))
            p[:, place] = middle
            rise = refit(fit, fit.problem, p=p, hold=name)[1] - base
            near, far = np.where(rise < goals, middle, near), np.where(rise < goals, far, middle)
        end = np.where(open_, edge, (near + far) / 2)
        one, two = (float(end[0]), float(end[1])), (float(end[2]), float(end[3]))
        estimates[name] = replace(estimate, interval_68=one, interval_95=two)
        # an end that lies at a bound, many standard errors away: the parabola at the best place is only its bottom
        far_off = np.abs(end[2:] - best) > 6 * (estimate.stderr or np.inf)
        if (open_[2:] & far_off).any():
            least = f"{end[2]:.3g} or more" if open_[3] and far_off[1] else f"{end[3]:.3g} or less"
            said = f"{fit.law.name}: {name}: only that it is {least} (95 %) can be told; what lies beyond fits as well"
            estimates[name] = Estimate(None, None, f"{least} (95 %)", one, two)
            fit = replace(fit, degenerate=(*fit.degenerate, said), untold=(*fit.untold, name))
    return replace(fit, estimates=estimates)


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
