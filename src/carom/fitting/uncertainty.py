"""Uncertainty beyond curvature: profile likelihood, bootstrap, systematic errors, and unmeasured spins."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from carom.data.rebounds import Rebounds
from carom.fitting.data import make_problem
from carom.fitting.model import FitModel, model_of
from carom.fitting.parameters import INDEX
from carom.fitting.result import Estimate, Fit, refit, scaled, working_model

__all__ = [
    "half_width", "profile_ends", "with_bootstrap", "with_marginal_errors", "with_profiled_friction", "with_profiles", "with_shared"
]  # fmt: skip

Array = NDArray[np.float64]
Indices = NDArray[np.int64]
Rises = Callable[[Array, Indices], Array]
LEVELS = (1.0, 3.8415)  # of the deviance: 68.3 % and 95 % of one parameter
ROUNDS, HALF_WIDTH_ROUNDS = 36, 8
CLOSE, HALF_WIDTH_CLOSE = 1e-3, 0.04  # of a level: an end whose deviance is this close is accepted
TIGHT = 1e-9  # of the parameter: a bracket of this width is closed
LEAST_SHARE = 0.1  # of a bracket: no step is shorter, so that both of its ends converge
GROWTH = 2.5  # of a distance in one step, if no bracket is known
WIDE = 1.5  # error bars: a half-interval of 95 %, over 1.96, that is larger replaces the error bar
NO_ROOT = 0.3  # deviation of the root of a rise from 1, above which a profile has no end there
PROFILE_START = 6.0  # error bars from the minimum, where a profile begins
MIN_STEP = 0.02  # of a friction, where the search for an unknown half-width begins
MARGINAL_STEPS, BOOTSTRAP_BATCH = 40, 250


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
        rises,
        best,
        far,
        np.array([low, high]),
        np.ones(2),
        jump=False,
        rounds=HALF_WIDTH_ROUNDS,
        close=HALF_WIDTH_CLOSE,
    )
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
    model = model_of(fit.law, fit.problem)
    base = float(refit(replace(fit, tabulated=None), fit.problem)[1][0])
    for name, estimate in fit.estimates.items():
        if estimate.value is None or not (names is None or name in names):
            continue
        place, parameter = model.places[name], model.parameters[name]
        best = float(fit.numbers[place])
        goals, up = np.repeat(LEVELS, 2), np.tile([False, True], 2)
        edge = np.where(up, parameter.high, parameter.low)
        reach = PROFILE_START * estimate.stderr if estimate.stderr else np.inf
        far = np.where(up, np.minimum(best + reach, edge), np.maximum(best - reach, edge))
        end, rise = profile_ends(_rises(fit, name, place, base), best, far, edge, goals, jump=True)
        open_ = (rise < goals * (1 - CLOSE)) & (end == edge)
        one, two = (float(end[0]), float(end[1])), (float(end[2]), float(end[3]))
        fit = _with(fit, name, replace(estimate, interval_68=one, interval_95=two))
        # an end at a bound, many standard errors away: the parabola at the best place is only the bottom of the profile
        far_off = np.abs(end[2:] - best) > PROFILE_START * (estimate.stderr or np.inf)
        if (open_[2:] & far_off).any():
            least = f"{end[2]:.3g} or more" if open_[3] and far_off[1] else f"{end[3]:.3g} or less"
            said = f"{fit.law.name}: {name}: only a limit is identifiable, {least} (95 %); values beyond fit as well"
            fit = _with(fit, name, Estimate(None, None, f"{least} (95 %)", one, two))
            covariance, i = fit.covariance.copy(), fit.names.index(name)
            covariance[i, :] = covariance[:, i] = math.nan
            fit = replace(fit, covariance=covariance, degenerate=(*fit.degenerate, said), untold=(*fit.untold, name))
        elif estimate.stderr:
            bar = (two[1] - two[0]) / 2 / math.sqrt(LEVELS[1])
            if bar > WIDE * estimate.stderr:
                fit = scaled(fit, name, bar / estimate.stderr)
    return fit


def _rises(
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


def _with(fit: Fit, name: str, estimate: Estimate) -> Fit:
    return replace(fit, estimates=fit.estimates | {name: estimate})


def with_bootstrap(fit: Fit, draws: int, seed: int = 0) -> Fit:
    """Add standard errors from fits to rows drawn with replacement (Efron 1979), with shared errors drawn at random.

    Parameters
    ----------
    fit : Fit
        Of one law.
    draws : int
        Number of fits, 2 or more.
    seed : int
        Of the random numbers.

    Returns
    -------
    Fit
        With ``bootstrap`` in its estimates.

    Examples
    --------
    >>> from carom.data.rebounds import make_rebounds
    >>> from carom.fitting import FITTED, Setting, fit_law, make_problem, with_bootstrap
    >>> v = [1.0, 2.0, 3.0, 4.0]
    >>> columns = {"v_n_in": v, "v_t_in": v, "spin_in": [0.0] * 4, "v_n_out": [0.81, 1.59, 2.42, 3.18], "v_t_out": v,
    ...            "sigma_v_n_out": 0.02, "sigma_v_t_out": 0.02}
    >>> problem, _notes = make_problem(make_rebounds("planar", columns), Setting(radius=0.02))
    >>> fit = with_bootstrap(fit_law(FITTED[0], problem), 20)
    >>> 0 < fit.estimates["restitution"].bootstrap < 0.02
    True
    """
    places = model_of(fit.law, fit.problem).places
    n = len(fit.problem.x)
    rng = np.random.default_rng(seed)
    found = []
    for first in range(0, draws, BOOTSTRAP_BATCH):
        weights = rng.multinomial(n, np.full(n, 1 / n), size=min(BOOTSTRAP_BATCH, draws - first)).astype(float)
        centers = rng.normal(size=(len(weights), len(fit.problem.shared)))
        found.append(refit(fit, fit.problem, weights, centers=centers)[0])
    spread = np.nan_to_num(np.concatenate(found), posinf=0.0).std(axis=0, ddof=1)
    estimates = {
        name: one if one.value is None else replace(one, bootstrap=float(spread[places[name]]))
        for name, one in fit.estimates.items()
    }
    return replace(fit, estimates=estimates)


def with_shared(fit: Fit, shifted: Sequence[tuple[str, Rebounds]]) -> Fit:
    """Add standard errors from systematic errors common to all rows: an axis misaligned, a scale, a tilted camera.

    They do not cause scatter between rows, so chi^2 does not show them, and they do not average out. ``shifted``: the rows with one
    standard error of each applied. The fit is repeated with each; the shifts of the parameters are added in quadrature.
    """
    places = list(model_of(fit.law, fit.problem).places.values())
    moves = np.zeros((len(shifted), len(places)))
    for move, (_words, rebounds) in zip(moves, shifted, strict=True):
        made = make_problem(rebounds, fit.problem.setting)[0]
        problem = replace(made, vx=fit.problem.vx, covariance=fit.problem.covariance, vy=fit.problem.vy)
        move[:] = refit(fit, problem)[0][0, places] - fit.numbers[places]
    sizes = np.sqrt((moves * moves).sum(axis=0))
    estimates = {
        name: estimate if estimate.value is None else replace(estimate, shared=float(size))
        for (name, estimate), size in zip(fit.estimates.items(), sizes, strict=True)
    }
    return replace(fit, estimates=estimates)


def with_marginal_errors(fit: Fit, extra: float = 0.0) -> Fit:
    """Correct estimates if unmeasured spins are integrated over: an unbiased prior width, and the friction's error by its profile.

    The prior's width is the scatter of few spins, and its maximum-likelihood value is too small on average: for n normal numbers
    about a fitted mean, with sum of squares S, it is the root of S/n, whereas that of S/(n - 3/2) is unbiased (about a given mean,
    n - 1/2). The friction is the edge of a scatter, and the deviance has a kink for each row at that edge, so its curvature
    between two kinks does not represent its rise across them. ``fit.numbers`` are not changed; ``extra``: the part of the
    deviance that does not depend on the rows.
    """
    fit = _with_unbiased_width(fit)
    estimate = fit.estimates.get("friction")
    if estimate is None or not estimate.stderr:
        return fit
    half, _rise = _friction_profile(fit, extra, estimate.stderr)
    found: Fit = scaled(fit, "friction", half / estimate.stderr)
    return found


def _with_unbiased_width(fit: Fit) -> Fit:
    """Scale the prior's width: its relative error 1/sqrt(2n) gives the effective number of rows n, and 3/2 times the square of this
    error is the bias. The mean's error bar is the width over the root of n, and is scaled by the same factor."""
    estimate = fit.estimates.get("spin_width")
    if estimate is None or not estimate.stderr:
        return fit
    width = float(fit.numbers[INDEX["spin_width"]])
    by = 1 + (1.5 if "spin_mean" in fit.names else 0.5) * (estimate.stderr / width) ** 2
    fit = scaled(fit, "spin_width", by)
    if "spin_mean" in fit.estimates and fit.estimates["spin_mean"].stderr:
        fit = scaled(fit, "spin_mean", by)
    return _with(fit, "spin_width", replace(fit.estimates["spin_width"], value=by * width))


def with_profiled_friction(fit: Fit, information: Array, extra: float = 0.0) -> Array:
    """Return the information with that on the friction from its profile, if the deviance rises by 1 on both sides; else unchanged.

    If a row is at a kink exactly at the minimum, the curvature there may suggest that the friction is not identifiable.
    """
    i = fit.names.index("friction")
    best = float(fit.numbers[INDEX["friction"]])
    half, rise = _friction_profile(fit, extra, MIN_STEP * max(best, MIN_STEP))
    if (np.abs(np.sqrt(np.maximum(rise, 0.0)) - 1) > NO_ROOT).any():
        return information
    rest = np.delete(np.arange(len(information)), i)
    inverse = np.linalg.pinv(information[np.ix_(rest, rest)], hermitian=True)
    information = information.copy()
    information[i, i] = information[i, rest] @ inverse @ information[rest, i] + half**-2
    return information


def _friction_profile(fit: Fit, extra: float, step: float) -> tuple[float, Array]:
    """Return the half-width of the friction's profile and the rises at its ends; of a tabulated law from its table."""
    model, base = working_model(fit, fit.problem), fit.deviance - extra
    if model.tabulated is not None:
        base = float(model.minimize(fit.numbers[None], MARGINAL_STEPS).value[0])
    parameter = model.parameters["friction"]
    rises = _rises(fit, "friction", INDEX["friction"], base, MARGINAL_STEPS, model)
    return half_width(rises, float(fit.numbers[INDEX["friction"]]), step, parameter.low, parameter.high)
