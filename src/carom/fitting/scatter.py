"""Fitted scatter: of outputs without error bars, or of contacts in addition to given error bars.

Outputs without error bars have one scatter each, estimated from the law's residuals. The scatter between contacts is one number s
that adds in quadrature to the error bars after the wall: s times the speed before it ("share"), or s itself ("absolute"); of a spin
over the radius. It is fitted in turn with the law's parameters, as the minimum of the deviance plus log det S(s) - log det S(0).
Without error bars before the wall, this is the likelihood; with them, only the change of log det S with s may be included
(:mod:`carom.fitting.deviance`).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.data.rebounds import Rebounds
from carom.fitting.identify import half_width, profile_rises, with_estimate
from carom.fitting.laws import INDEX
from carom.fitting.model import FitModel, feels_spins, model_of, predict_law
from carom.fitting.result import Estimate, Fit, refit, scaled, working_model
from carom.fitting.rows import Problem, make_problem

Array = NDArray[np.float64]
Search = Callable[[FitModel], Array]
Descend = Callable[[FitModel, Array], Array]
ROUNDS, CONTACT_ROUNDS = 40, 12
FIRST_SHARE = 0.05  # of the speed: the scatter with which the search begins
SETTLED, ROUGHLY = 2e-3, 0.1  # of the scatter: a smaller change ends the search
LEAST_SHARE, MOST_SHARE = 1e-5, 1.0
REACH = 0.5  # of log s, within which it is sought near where it was
CURVATURE_STEP = 0.1  # of log s
JACOBIAN_STEP = 0.1  # of an error bar before the wall
CONTACT_SCATTER = "contacts"


class Scattered(NamedTuple):
    """Starting points of the descent, the model with its scatter, and the contribution of the scatter to the deviance."""

    p: Array
    model: FitModel
    extra: float
    scatter: dict[str, float]
    estimate: Estimate | None


def with_estimated_scatter(model: FitModel, search: Search, descend: Descend) -> Scattered:
    """Fit parameters with the scatter of outputs without error bars, which at each place is that of the residuals there.

    Error bars before the wall, beside outputs without any, enter with the scatter held, in turn.
    """
    problem = model.problem
    at = replace(model, profiled=True)
    p = descend(at, search(at))
    at = at.with_scatter_of(p)
    for _ in range(ROUNDS if problem.vx.any() else 0):
        p, was = descend(at, p[None]), at.problem.vy
        at = replace(at, problem=problem).with_scatter_of(p)
        if np.allclose(at.problem.vy, was, rtol=1e-6, atol=0.0):
            break
    outputs = ("v_n_out", "v_t_out", "spin_out" if model.law.kind == "planar" else "spin_z_out")
    n, variance = np.isfinite(problem.y).sum(axis=0), at.problem.vy[0]
    scatter = {outputs[j]: math.sqrt(variance[j]) for j in np.flatnonzero(problem.estimated).tolist()}
    estimated = problem.estimated & (n > 0)
    return Scattered(p[None], at, float((n[estimated] * np.log(variance[estimated])).sum()), scatter, None)


def with_contact_scatter(model: FitModel, search: Search, descend: Descend, near: float | None = None) -> Scattered:
    """Fit parameters and the scatter between contacts in turn until neither changes; ``near``: a scatter to begin with, else it is
    settled roughly."""
    from scipy.optimize import minimize_scalar

    plain, unit = model.problem, _unit(model.problem)
    size = float(np.median(np.hypot(plain.x[:, 0], plain.x[:, 1]))) if plain.setting.scatter == "absolute" else 1.0
    low, high = math.log(LEAST_SHARE * size), math.log(MOST_SHARE * size)

    def having(s: float) -> FitModel:
        return replace(model, problem=replace(plain, vy=plain.vy + np.square(s * unit)))

    def deviance(p: Array) -> Callable[[float], float]:
        """Return the deviance with numbers p as a function of log s: derivatives of the law are with respect to p alone."""
        moved = _moved_by_errors(model, p)
        without = log_determinants(model, moved).sum()

        def of_scatter(log_s: float) -> float:
            at = having(math.exp(log_s))
            rows = replace(at, free=at.free[:0]).row_deviances(p)[0]
            return float(rows.sum() + log_determinants(at, moved).sum() - without)

        return of_scatter

    log_s = math.log(near or FIRST_SHARE * size)
    p = search(having(math.exp(log_s)).without_shared())
    for turn in range(CONTACT_ROUNDS):
        at = having(math.exp(log_s))
        p = descend(at if turn or near else at.without_shared(), p)[None]
        was = log_s
        # later the scatter is near where it was
        reach, close = (REACH, SETTLED / 4) if turn or near else (math.inf, 0.05)
        ends = (max(low, was - reach), min(high, was + reach))
        log_s = float(minimize_scalar(deviance(p[0]), bounds=ends, method="bounded", options={"xatol": close}).x)
        if abs(log_s - was) < (SETTLED if near else ROUGHLY) or log_s < low + 0.1:
            break
    if log_s < low + 0.1:
        return Scattered(p, model, 0.0, {CONTACT_SCATTER: 0.0}, Estimate(0.0, None, "none beyond the error bars"))
    s, at = math.exp(log_s), having(math.exp(log_s))
    around = [*map(deviance(p[0]), (log_s - CURVATURE_STEP, log_s, log_s + CURVATURE_STEP))]
    curvature = (around[0] + around[2] - 2 * around[1]) / CURVATURE_STEP**2
    stderr = s * math.sqrt(2 / curvature) if curvature > 0 else None
    moved = _moved_by_errors(model, p[0])
    extra = float(log_determinants(at, moved).sum() - log_determinants(model, moved).sum())
    return Scattered(p, at, extra, {CONTACT_SCATTER: s}, Estimate(s, stderr))


def _unit(problem: Problem) -> Array:
    """Return the change (N, 3) of the measurements after the wall by a scatter of 1."""
    speed = np.hypot(problem.x[:, 0], problem.x[:, 1])
    velocity = np.ones(len(speed)) if problem.setting.scatter == "absolute" else speed
    return np.stack([velocity, velocity, velocity / problem.setting.radius], axis=-1)


def _moved_by_errors(model: FitModel, p: Array) -> dict[int, Array]:
    """Return the changes (N, 3) of the prediction by an error bar of v_n, v_t and spin before the wall, where there is one."""
    law, problem, found = model.law, model.problem, {}
    here = predict_law(law, problem, p)
    for o in range(3):
        size = np.sqrt(problem.vx[:, o])
        if size.any():
            step = size[:, None] * np.eye(3)[o] * JACOBIAN_STEP
            then = predict_law(law, replace(problem, x=problem.x + step), p)
            found[o] = np.nan_to_num(then - here) / JACOBIAN_STEP
    return found


def log_determinants(model: FitModel, moved: dict[int, Array]) -> Array:
    """Return log det S of each row (N,), ``moved`` by errors before the wall; for a row whose spin was not measured, of the normal
    part and of the variances along the wall under a mirror law, to which its deviance is relative."""
    law, problem = model.law, model.problem
    seen = np.isfinite(problem.y)
    s = np.einsum("im,mn->imn", problem.vy, np.eye(3))
    for o, change in moved.items():
        s += change[:, :, None] * change[:, None, :]
        if o < 2:  # errors before and after that go together
            size = np.sqrt(problem.vx[:, o])
            slope = change / np.where(size > 0, size, 1.0)[:, None]
            s[:, :, o] -= slope * problem.covariance[:, o, None]
            s[:, o, :] -= slope * problem.covariance[:, o, None]
    pair = seen[:, :, None] & seen[:, None, :]
    s = np.where(pair, s, np.eye(3))
    found = np.linalg.slogdet(s)[1]
    if feels_spins(law, problem):
        side = np.where(seen, problem.vy + problem.vx, 1.0)[:, 1:].prod(axis=1)
        found = np.where(problem.unknown, np.log(s[:, 0, 0] * side), found)
    return np.asarray(found)


# ----------------------------------------------------------------------------------------------------
# Uncertainty beyond curvature: bootstrap, systematic errors, and the friction where spins are not measured.


NO_ROOT = 0.3  # deviation of the root of a rise from 1, above which a profile has no end there
MIN_STEP = 0.02  # of a friction, where the search for an unknown half-width begins
MARGINAL_STEPS, BOOTSTRAP_BATCH = 40, 250


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
    about a fitted mean, with sum of squares S, it is sqrt(S/n), whereas sqrt(S/(n - 3/2)) is unbiased (about a given mean,
    n - 1/2). The friction is the edge of a scatter, and the deviance has a kink for each row at that edge, so its curvature
    between two kinks does not represent its rise across them. ``fit.numbers`` are not changed; ``extra``: the part of the
    deviance that does not depend on the rows.
    """
    fit = _with_unbiased_width(fit)
    estimate = fit.estimates.get("friction")
    if (
        estimate is None or not estimate.stderr or fit.problem.carried
    ):  # (there the curvature is that between distant points)
        return fit
    half, _rise = _friction_profile(fit, extra, estimate.stderr)
    by = half / estimate.stderr
    # (the profile holds a mixture of spins, with which the friction is correlated)
    found: Fit = scaled(fit, "friction", max(by, 1.0) if fit.problem.mixture is not None else by)
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
    return with_estimate(fit, "spin_width", replace(fit.estimates["spin_width"], value=by * width))


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
    rises = profile_rises(fit, "friction", INDEX["friction"], base, MARGINAL_STEPS, model)
    return half_width(rises, float(fit.numbers[INDEX["friction"]]), step, parameter.low, parameter.high)
