"""Uncertainty beyond curvature: bootstrap, systematic errors, and the friction where spins are not measured."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from carom.data.rebounds import Rebounds
from carom.fitting.data import make_problem
from carom.fitting.model import model_of
from carom.fitting.parameters import INDEX
from carom.fitting.profile_likelihood import half_width, profile_rises, with_estimate
from carom.fitting.result import Fit, refit, scaled, working_model

__all__ = ["with_bootstrap", "with_marginal_errors", "with_profiled_friction", "with_shared"]

Array = NDArray[np.float64]
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
