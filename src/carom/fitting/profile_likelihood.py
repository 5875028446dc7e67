"""Profile likelihood: the deviance above its minimum against one parameter, with all others fitted, and the intervals from it."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from carom.fitting.model import FitModel, model_of, predict_law
from carom.fitting.result import Estimate, Fit, scaled, without_estimate

__all__ = ["LEVELS", "half_width", "profile_ends", "profile_rises", "with_estimate", "with_profiles"]

Array = NDArray[np.float64]
Indices = NDArray[np.int64]
Rises = Callable[[Array, Indices], Array]
LEVELS = (1.0, 3.8415)  # of the deviance: 68.3 % and 95 % of one parameter
ROUNDS, HALF_WIDTH_ROUNDS = 36, 8
CLOSE, HALF_WIDTH_CLOSE = 1e-3, 0.04  # of a level: an end whose deviance is this close is accepted
TIGHT = 1e-9  # of the parameter: a bracket of this width is closed
LEAST_SHARE = 0.1  # of a bracket: no step is shorter, so that both of its ends converge
GROWTH = 2.5  # of a distance in one step, if no bracket is known
WIDE = 1.1  # error bars: a half-interval, over its number of them, that is larger replaces the error bar
SLOPE_STEP = 0.1  # of an error bar: the step of a numerical derivative
PROFILE_START = 6.0  # error bars from the minimum, where a profile begins


def profile_ends(
    rises: Rises, best: float, far: Array, edge: Array, goals: Array, *, jump: bool, rounds: int = ROUNDS,
    close: float = CLOSE,
) -> tuple[Array, Array]:  # fmt: skip
    """Find where a profile, the deviance above its minimum with all else fitted, has risen to its goals. Returns ends and rises.

    ``rises(values, which)`` evaluates some of the ends. From ``far`` on the search goes outwards, by a parabola, or at once to the
    ``edge`` (``jump``), until the goal is bracketed; then the square root of the rise, which is nearly linear, is interpolated, and
    every third step halves the bracket, because of kinks. If the rise at the edge is below its goal, the profile is open.
    """
    far, edge = np.where((far - best) * (edge - best) < 0, edge, far), np.asarray(edge, float)
    end, rise = far.copy(), np.zeros(len(far))
    inner, low = np.full(len(far), best), np.zeros(len(far))
    outer, high = np.full(len(far), np.nan), np.full(len(far), np.nan)
    left = np.arange(len(far))
    for turn in range(rounds):
        rise[left] = now = rises(end[left], left)
        under = now < goals[left]
        at, root = end[left], np.sqrt(np.maximum(now, 0.0))
        inner[left[under]], low[left[under]] = at[under], root[under]
        outer[left[~under]], high[left[~under]] = at[~under], root[~under]
        bracket = np.abs(outer[left] - inner[left])
        left = left[
            (np.abs(now - goals[left]) > close * goals[left])
            & ~(under & (at == edge[left]))
            & ~(bracket <= TIGHT * max(abs(best), 1e-12))
        ]
        if not len(left):
            break
        known = ~np.isnan(outer[left])
        share = (np.sqrt(goals[left]) - low[left]) / (high[left] - low[left])
        share = np.clip(share, LEAST_SHARE, 1 - LEAST_SHARE) if turn % 3 < 2 else np.full(len(left), 0.5)
        within = inner[left] + share * (outer[left] - inner[left])
        by = np.clip(np.sqrt(goals[left]) / np.maximum(low[left], 1e-3), 1.05, GROWTH)
        beyond = best + (inner[left] - best) * by
        beyond = np.where(np.abs(beyond - best) > np.abs(edge[left] - best), edge[left], beyond)
        end[left] = np.where(known, within, edge[left] if jump else beyond)
    return end, rise


def half_width(rises: Rises, best: float, step: float, low: float, high: float) -> tuple[float, Array]:
    """Return half the width within which a profile rises by less than 1, searched for from a step away, and the rises at its ends,
    which are 1 except at a bound."""
    far = np.clip(best + step * np.array([-1.0, 1.0]), low, high)
    end, rise = profile_ends(
        rises, best, far, np.array([low, high]), np.ones(2), jump=False, rounds=HALF_WIDTH_ROUNDS, close=HALF_WIDTH_CLOSE,
    )  # fmt: skip
    return float(end[1] - end[0]) / 2, rise


def with_profiles(fit: Fit, names: Sequence[str] | None = None) -> Fit:
    """Add the intervals of 68 % and 95 % of each identified parameter, or of those named, by profile likelihood.

    The curvature is that of the minimum found. Where the interval of 95 % is far wider, since it holds another minimum or a slope
    beyond a kink, half its width is 1.96 error bars.

    Parameters
    ----------
    fit : Fit
        Of one law.
    names : sequence of str, optional
        Parameters. Default: all identified ones.

    Returns
    -------
    Fit
        With ``interval_68`` and ``interval_95`` in its estimates.

    Examples
    --------
    >>> from carom.data.rebounds import make_rebounds
    >>> from carom.fitting import Setting, fit_law, make_problem, with_profiles
    >>> from carom.fitting.laws import laws_named
    >>> v = [1.0, 2.0, 3.0, 4.0]
    >>> columns = {"v_n_in": v, "v_t_in": v, "spin_in": [0.0] * 4, "v_n_out": [0.81, 1.59, 2.42, 3.18], "v_t_out": v,
    ...            "sigma_v_n_out": 0.02, "sigma_v_t_out": 0.02}
    >>> problem, notes = make_problem(make_rebounds("planar", columns), Setting(radius=0.02))
    >>> mirror = laws_named(["mirror"], "planar", True)[0][0]
    >>> fit = with_profiles(fit_law(mirror, problem))
    >>> low, high = fit.estimates["restitution"].interval_95
    >>> low < 0.8 < high
    True
    """
    problem = fit.problem
    # (scatter of residuals follows along the profile; error bars before the wall need it held)
    model = replace(model_of(fit.law, problem), profiled=bool(problem.estimated.any()) and not problem.vx.any())
    base = float(model.minimize(fit.numbers[None]).value[0])
    for name, estimate in fit.estimates.items():
        if estimate.value is None or not (names is None or name in names):
            continue
        place, parameter = model.places[name], model.parameters[name]
        best = float(fit.numbers[place])
        levels, bars_out = _levels(fit, name, model.profiled)
        goals, up = np.repeat(levels, 2), np.tile([False, True], 2)
        edge = np.where(up, parameter.high, parameter.low)
        reach = PROFILE_START * estimate.stderr if estimate.stderr else np.inf
        far = np.where(up, np.minimum(best + reach, edge), np.maximum(best - reach, edge))
        end, rise = profile_ends(profile_rises(fit, name, place, base, model=model), best, far, edge, goals, jump=True)
        open_ = (rise < goals * (1 - CLOSE)) & (end == edge)
        one, two = (float(end[0]), float(end[1])), (float(end[2]), float(end[3]))
        fit = with_estimate(fit, name, replace(estimate, interval_68=one, interval_95=two))
        # an end at a bound, many standard errors away: the parabola at the best place is only the bottom of the profile
        far_off = np.abs(end[2:] - best) > PROFILE_START * (estimate.stderr or np.inf)
        if (open_[2:] & far_off).any():
            least = f"{end[2]:.3g} or more" if open_[3] and far_off[1] else f"{end[3]:.3g} or less"
            said = f"{fit.law.name}: {name}: only a limit is identifiable, {least} (95 %); values beyond fit as well"
            fit = without_estimate(fit, name, Estimate(None, None, f"{least} (95 %)", one, two), said)
        elif estimate.stderr:
            bar = max((high - low) / 2 / out for (low, high), out in zip((one, two), bars_out, strict=True))
            if bar > WIDE * estimate.stderr:
                fit = scaled(fit, name, bar / estimate.stderr)
    return fit


def _levels(fit: Fit, name: str, profiled: bool) -> tuple[tuple[float, float], tuple[float, float]]:
    """Return the rises of the deviance at the ends of the intervals of 68.3 and 95 %, and the error bars from the minimum to there.

    Where scatter is estimated from n_j numbers of an output, the intervals are those of Student's t: with n_j - p_j degrees of
    freedom, p_j the parameters that the output determines (its leverage); of several outputs by Satterthwaite's sum, each with its
    part of the parameter's information (Biometrics Bull. 2, 110 (1946)). Outputs that are weighted by their own estimated scatter
    seem to agree too well: Meier's factor widens for it (Biometrics 9, 59 (1953)). ``profiled``: the deviance is that with
    the scatter of the residuals at each place, n_j log of their mean square.
    """
    from scipy.special import stdtrit

    problem = fit.problem
    inside = [i for i in range(len(fit.names)) if np.isfinite(fit.covariance[i, i]) and fit.covariance[i, i] > 0]
    if not problem.estimated.any() or problem.spins is not None or fit.names.index(name) not in inside:
        return LEVELS, (1.0, math.sqrt(LEVELS[1]))
    model, slopes = model_of(fit.law, problem), []
    for i in inside:
        step = np.zeros(len(fit.numbers))
        step[model.places[fit.names[i]]] = SLOPE_STEP * math.sqrt(fit.covariance[i, i])
        ends = [predict_law(fit.law, problem, fit.numbers + sign * step) for sign in (1, -1)]
        slopes.append((ends[0] - ends[1]) / (2 * step.max()))
    slope = np.where(np.isfinite(problem.y), np.stack(slopes), 0.0)
    information = np.einsum("anj,bnj,nj->jab", slope, slope, 1 / np.where(problem.vy > 0, problem.vy, np.inf))
    inverse = np.linalg.pinv(information.sum(axis=0), hermitian=True)
    along = inverse[:, inside.index(fit.names.index(name))]
    part = np.einsum("a,jab,b->j", along, information, along)
    part = part / part.sum() if part.sum() > 0 else np.full(3, 1 / 3)
    count = np.isfinite(problem.y).sum(axis=0)
    free = np.maximum(count - np.einsum("ab,jba->j", inverse, information), 1.0)
    share = np.where(problem.estimated, part * count / free, part)
    degrees = share.sum() ** 2 / max(float((np.square(share) / free)[problem.estimated].sum()), 1e-12)
    meier = 1 + 4 * float((part * (1 - part) / free)[problem.estimated].sum())
    one, two = (float(stdtrit(degrees, (1 + p) / 2)) for p in (0.6827, 0.95))
    rises = np.multiply.outer(np.square([one, two]) * share.sum() * meier, part)
    if profiled:
        rises = np.where(problem.estimated, count * np.log1p(rises / np.maximum(count, 1)), rises)
    low, high = rises.sum(axis=1).tolist()
    return (low, high), (one, two)


def profile_rises(
    fit: Fit, name: str, place: int, base: float, steps: int | None = None, model: FitModel | None = None
) -> Rises:
    """Return the profile of a parameter above ``base``; with ``steps`` each end goes on from where it was left."""
    model = (model or model_of(fit.law, fit.problem)).holding(name)
    seeds: dict[int, Array] = {}

    def rises(values: Array, which: Indices) -> Array:
        p = np.array([fit.numbers if steps is None else seeds.get(i, fit.numbers) for i in which.tolist()])
        p[:, place] = values
        found = model.minimize(p) if steps is None else model.minimize(p, steps)
        seeds.update(zip(which.tolist(), found.p, strict=True))
        return found.value - base

    return rises


def with_estimate(fit: Fit, name: str, estimate: Estimate) -> Fit:
    """Return the fit with another estimate of a parameter."""
    return replace(fit, estimates=fit.estimates | {name: estimate})
