"""Predictions of a fitted law: mean and covariance of the state after the wall, regions, and the score of rows held out.

The covariance of a prediction is S + G C G': the scatter of rebounds (and their error bars), and the covariance C of the fitted
numbers through the derivatives G. Where the scatter was estimated from few rows, S is enlarged by n/(n - k), and the prediction is
Student's t with n - k degrees of freedom for each output.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.bodies import State
from carom.data.rebounds import COLUMNS, Rebounds
from carom.errors import CaromError, Fault
from carom.fitting.data import Problem
from carom.fitting.noise import Noise
from carom.fitting.varying import VaryingFit, VaryingModel, varying_model

__all__ = ["Prediction", "Predictive", "held_out_score", "predictive_of"]

Array = NDArray[np.float64]
FOLDS = 5
CLOSE = 1e-6  # of a deviance
HALVINGS, MOST_RISE = 8, 3.0  # of a step; of the deviance at its end


@dataclass(frozen=True, eq=False)
class Prediction:
    """Predicted states after the wall: v_n, v_t and spin (of a ball on a table about the vertical), in SI units.

    Examples
    --------
    >>> import numpy as np
    >>> from carom.fitting import Prediction
    >>> one = Prediction(np.array([[1.0, 2.0, 0.0]]), np.eye(3)[None] * 0.01)
    >>> one.inside(np.array([[1.1, 2.0, np.nan]]), 0.68)
    array([ True])
    """

    mean: Array
    """(..., 3)"""
    covariance: Array
    """(..., 3, 3)"""
    nu: float = 0.0
    """Degrees of freedom of Student's t; 0: normal."""
    errors: str = "normal"
    bars: Array | None = None
    """Error bars (..., 3) of measured states beyond the covariance: those given beside the state (sigma_v_n_out, ...), else the
    median of the table's; NaN where it has none. None: the covariance has all."""

    @property
    def stderr(self) -> Array:
        """Standard errors (..., 3) of the state, without those of a measurement of it."""
        return np.asarray(np.sqrt(np.einsum("...ii->...i", self.covariance)))

    def distance(self, measured: Array) -> tuple[Array, NDArray[np.int64]]:
        """Return r' S^-1 r (...), S the covariance with the error bars, and the count of measured outputs; NaN: not measured.

        Raises CaromError for an output that has neither error bar nor scatter.
        """
        seen = np.isfinite(measured)
        pair = seen[..., :, None] & seen[..., None, :]
        r = np.where(seen, measured - self.mean, 0.0)
        bars = np.zeros(3) if self.bars is None else self.bars
        s = self.covariance + np.square(bars)[..., None] * np.eye(3)
        if (without := seen & ~(np.einsum("...ii->...i", s) > 0)).any():
            name = ("v_n_out", "v_t_out", "the spin after")[int(np.argwhere(without)[0, -1])]
            raise CaromError(Fault("inside", "measured", f"an error bar of {name}", "none",
                                   "give it beside the state (column sigma_...), or leave that output out (NaN)"))  # fmt: skip
        q = np.linalg.inv(np.where(pair, s, np.eye(3)))
        return np.einsum("...i,...ij,...j->...", r, q, r), seen.sum(axis=-1)

    def inside(self, measured: Array, share: float) -> NDArray[np.bool_]:
        """Return whether measured states (..., 3) lie within the ellipsoid that has this share of the probability."""
        from scipy.stats import chi2, f, gamma

        if not 0 < share < 1:
            raise CaromError(Fault("inside", "share", "a share above 0 and below 1", repr(share)))
        c, d = self.distance(measured)
        if self.errors == "two-sided":
            return np.asarray(c <= gamma.ppf(share, d) ** 2 / (d + 1))
        return np.asarray(c <= (d * f.ppf(share, d, self.nu) if self.nu else chi2.ppf(share, d)))


@dataclass(frozen=True, eq=False)
class Predictive:
    """A fitted model with the covariance of its numbers."""

    model: VaryingModel
    q: Array
    covariance: Array
    """(m, m) of the numbers of law and splines."""
    dof: float
    weights: Array | None = None
    """(N,) of the fitted rows; None: their likelihood is not asked."""

    @functools.cached_property
    def sides(self) -> Array:
        """The numbers (B, k) one standard deviation to both sides along each axis of their covariance; nearer where there the rows
        are far less likely than that, beyond a kink."""
        found, m = [], len(self.covariance)
        strength, axes = np.linalg.eigh(self.covariance)
        here = 0.0 if self.weights is None else self.model.evaluate(self.q, self.weights, False)[0]
        for step in (np.sqrt(np.maximum(strength, 0.0)) * axes).T:
            for side in (step, -step):
                moved = self.q.copy()
                for part in 0.5 ** np.arange(HALVINGS):
                    moved[:m] = np.clip(self.q[:m] + part * side, *(end[:m] for end in self.model.bounds))
                    if self.weights is None or self.model.evaluate(moved, self.weights, False)[0] - here < MOST_RISE:
                        break
                found.append(moved)
        return np.array(found).reshape(-1, len(self.q))

    @property
    def nu(self) -> float:
        """Degrees of freedom of Student's t; 0: normal."""
        if self.model.noise.errors == "student":
            return math.exp(float(self.q[self.model.parts["shape"]][0]))
        estimated = self.model.problem.estimated.any() and self.model.noise.errors == "normal"
        return max(self.dof / len(self.model.scattered), 1.0) if estimated else 0.0

    @property
    def enlarged(self) -> float:
        """Factor of an estimated scatter's variance: numbers over degrees of freedom."""
        problem = self.model.problem
        return problem.count / max(self.dof, 1.0) if problem.estimated.any() else 1.0

    def at(self, x: Array, errors: Array | None = None) -> Prediction:
        """Return the prediction for impacts x (N, 3), with error bars (N, 3, 3), if given, of their measurement."""
        here, s = self.model.predict(self.q, x), self.enlarged * self.model.scatter(self.q, x).sum(axis=0)
        spread = np.einsum("ni,ij->nij", s, np.eye(3))
        off = self.model.predict_many(self.sides, x) - here if len(self.sides) else np.zeros((0, *here.shape))
        spread += np.einsum("bni,bnj->nij", off, off) / 2  # (a slope does not see kinks)
        spread = spread if errors is None else spread + errors
        return Prediction(here, spread, self.nu, self.model.noise.errors)

    def of_states(self, before: Any) -> Prediction:
        """Return the prediction for states as :meth:`carom.fitting.Fit.predict` takes them, with the error bars beside them."""
        problem = self.model.problem
        names, x = COLUMNS[problem.rebounds.kind], impacts(problem, before)
        sigma = np.array([np.broadcast_to(_bar_of(before, name), len(x)) for name in names], float).T
        wide = np.square(np.nan_to_num(sigma[:, :3]))
        j = self.model.by_inputs(self.q, x, wide)
        every = [problem.rebounds.sigma.get(name, np.empty(0)) for name in names[3:]]
        table = [np.median(one[np.isfinite(one)]) if np.isfinite(one).any() else np.nan for one in every]
        bars = np.where(problem.estimated, 0.0, np.where(np.isnan(sigma[:, 3:]), table, sigma[:, 3:]))
        return replace(self.at(x, np.einsum("nio,no,njo->nij", j, wide, j)), bars=bars)

    def of_rows(self, problem: Problem) -> Prediction:
        """Return the predictions for other rows, with their error bars."""
        model = replace(self.model, base=replace(self.model.base, problem=problem))
        unknown = np.where(problem.estimated, 1.0, np.zeros_like(problem.y))
        bars = model.covariance(self.q)[1] - np.einsum("ni,ij->nij", unknown, np.eye(3))
        seen = np.isfinite(problem.y)
        pair = seen[:, :, None] & seen[:, None, :]
        return self.at(problem.x, np.where(pair, bars, 0.0))

    def log_density(self, problem: Problem) -> Array:
        """Return the log density (N,) of other rows, per (m/s)^d: spins count as a times their size."""
        one, a = self.of_rows(problem), problem.setting.radius
        c, d = one.distance(problem.y)
        seen = np.isfinite(problem.y)
        pair = seen[:, :, None] & seen[:, None, :]
        logs = np.linalg.slogdet(np.where(pair, one.covariance, np.eye(3)))[1]
        shape = np.array([math.log(one.nu)]) if one.nu else self.q[self.model.parts["shape"]]
        kind = Noise("student") if one.nu else self.model.noise
        r = np.nan_to_num(problem.y - one.mean)
        rho = kind.rho(c, r[:, 0], np.maximum(d, 1), shape)[0]
        return np.where(d > 0, -0.5 * (logs + rho + d * math.log(2 * math.pi)) - seen[:, 2] * math.log(a), 0.0)


def predictive_of(fit: Any, weights: Array | None = None) -> Predictive:
    """Return what predictions need of a :class:`carom.fitting.Fit` or :class:`VaryingFit`: numbers, covariance, scatter."""
    if isinstance(fit, VaryingFit):
        weights = np.ones(len(fit.model.problem.x)) if weights is None else weights
        return Predictive(fit.model, fit.q, fit.covariance, fit.dof, weights)
    problem = fit.problem
    marginal = problem.spins is not None
    if (
        marginal
    ):  # (rows without spin give no derivatives; what a spin does to a prediction is in the state before the wall)
        problem = replace(problem, spins=None, x=np.nan_to_num(problem.x))
    model = varying_model(replace(fit, problem=problem))
    q = model.start()
    sizes = [fit.scatter[name] for name in fit.scatter]
    q[model.parts["scatter"]] = np.log(np.maximum(sizes, 1e-5)) if sizes else q[model.parts["scatter"]]
    dof = float(problem.count - fit.k)
    if not marginal:
        information = model.evaluate(q, np.ones(len(problem.x)), True)[2]
        return predictive_of(VaryingFit(model, q, fit.deviance, information))
    inside = [list(fit.names).index(name) for name in model.base.parameters if name in fit.names]
    return Predictive(model, q, np.nan_to_num(fit.covariance[np.ix_(inside, inside)]), dof)


def held_out_score(fit: VaryingFit, folds: int = FOLDS) -> tuple[float, Array]:
    """Return the mean log density of a row that was left out, per (m/s)^3, and the density of each row (N,).

    Every fifth row (film, sheet, shot, or chain of contacts) is left out in turn, and all numbers and the scatter are fitted
    to the others, from the fit to all.
    """
    model, n = fit.model, len(fit.model.problem.x)
    fold = fit.model.problem.units % folds
    weights = np.array([fold != one for one in range(fold.max() + 1)], float)
    q, value, information = model.minimize(np.tile(fit.q, (len(weights), 1)), weights)
    # a search may end at a kink: where the end of another is better, it is continued from there
    for one, ours in enumerate(weights):
        ends = [float(model.evaluate(end, ours, False)[0]) for end in q]
        if min(ends) < value[one] - CLOSE:
            again = model.minimize(q[[int(np.argmin(ends))]], ours[None])
            q[one], value[one], information[one] = (part[0] for part in again)
    scores = np.zeros(n)
    for one in range(len(weights)):
        out = fold == one
        seen = float(np.isfinite(model.problem.y[~out]).sum())
        part = VaryingFit(model, q[one], float(value[one]), information[one])
        scores[out] = replace(predictive_of(part, weights[one]), dof=max(seen - part.k, 1.0)).log_density(
            model.problem.select(out)
        )
    return float(scores.mean()), scores


def impacts(problem: Problem, before: State | Mapping[str, Any] | Rebounds | Any) -> Array:
    """Return impacts (N, 3) of a table's columns, or of states that meet a wall whose normal is (1, 0, 0)."""
    names = COLUMNS[problem.rebounds.kind]
    x = _impacts(names, before)
    if (wrong := np.argwhere(~np.isfinite(x))).size:
        i, j = wrong[0].tolist()
        raise CaromError(Fault("predict", "state", "finite numbers", f"{names[j]} {x[i, j]} in row {i + 1}"))
    return x


def _bar_of(before: Any, name: str) -> Any:
    """Return the error bars of a column beside states, NaN where there are none."""
    if isinstance(before, Rebounds):
        return before.sigma.get(name, np.nan)
    return before.get(f"sigma_{name}", np.nan) if isinstance(before, Mapping) else np.nan


def _impacts(names: tuple[str, ...], before: Any) -> Array:
    if isinstance(before, State):
        v, w = before.velocity, before.spin
        return np.stack([-v[..., 0], v[..., 1], w[..., 2]], axis=-1).reshape(-1, 3)
    if not isinstance(before, Mapping | Rebounds):
        try:
            return np.asarray(before, float).reshape(-1, 3)
        except (TypeError, ValueError):
            raise CaromError(f"predict: state: expected {', '.join(names[:3])}, or an array (N, 3) of them") from None
    try:
        columns = [np.atleast_1d(np.asarray(before[name], float)) for name in names[:3]]
    except KeyError as error:
        raise CaromError(f"predict: state: expected columns {', '.join(names[:3])}, got none called {error}") from None
    return np.stack(np.broadcast_arrays(*columns), axis=-1)
