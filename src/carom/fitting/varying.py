"""A law whose parameters are smooth functions of the impact, with scatter that may grow with the speed and have heavy tails.

On top of a law with its forms (:mod:`carom.fitting.model`) a parameter may be a penalised B-spline of v_n, slip, slip/v_n or speed
(Eilers & Marx, Statist. Sci. 11, 89 (1996); SciPy's basis): its second differences are normal with a width that held-out rows
choose. The error of a rebound has the covariance S = error bars + J var(x) J' + scatter^2 (speed/v0)^(2 h), and is normal,
Student's t, or exponential on two sides (Montaine et al., arXiv 1104.0049). All numbers are fitted together, by maximum likelihood
with the penalty: the deviance is log det S + rho(c), c = r' S^-1 r. Spins before the wall have to be measured.
"""

from __future__ import annotations

import functools
import math
from dataclasses import dataclass, replace
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from carom.errors import CaromError
from carom.fitting.data import Problem
from carom.fitting.evidence import akaike
from carom.fitting.laws import FittedLaw
from carom.fitting.likelihood import predictions
from carom.fitting.model import FitModel, model_of
from carom.fitting.noise import NORMAL, Noise
from carom.fitting.optimizer import minimize
from carom.fitting.parameters import PARAMETERS, PLACES
from carom.fitting.smooth import Smooth, impact_variable, parameter_at, spline_basis

__all__ = ["VaryingFit", "VaryingModel", "fit_varying", "varying_model"]

Array = NDArray[np.float64]
STEP = 1e-4  # of a number: of numerical derivatives
STEPS, TOLERANCE = 60, 1e-6
STUDENT = (math.log(2.0), math.log(200.0))  # bounds of log nu


class FittedLawNumbers(Protocol):
    """A law fitted to rows (:class:`carom.fitting.Fit`)."""

    @property
    def law(self) -> FittedLaw:
        """The law."""

    @property
    def problem(self) -> Problem:
        """The rows."""

    @property
    def numbers(self) -> Array:
        """All numbers of the law."""


@dataclass(frozen=True, eq=False)
class VaryingModel:
    """Rows, a law, smooth parameters and noise. Fitted are q: numbers of the law and splines, log scatter, its power, the shape."""

    base: FitModel
    numbers: Array
    """(NUMBERS,) where the law's fitted numbers begin, and the values of the others."""
    smooth: tuple[Smooth, ...] = ()
    noise: Noise = NORMAL
    prior: tuple[Array, Array] | None = None
    """Mean and precisions (k,) of all numbers, where they are known before."""

    @property
    def problem(self) -> Problem:
        """The rows."""
        return self.base.problem

    @functools.cached_property
    def free(self) -> NDArray[np.int64]:
        """Places of the law's fitted numbers: without those in whose place there is a spline."""
        gone = {place for one in self.smooth for place in PLACES[one.parameter]}
        own = [self.base.places[name] for name in self.base.parameters]
        return np.array([place for place in own if place not in gone], dtype=np.int64)

    @functools.cached_property
    def scattered(self) -> NDArray[np.bool_]:
        """(S, 3) outputs of each fitted scatter: each without error bars; or all, beyond their error bars."""
        if self.problem.estimated.any():
            seen = np.isfinite(self.problem.y).any(axis=0) & self.problem.estimated
            return np.eye(3, dtype=bool)[seen]
        return np.ones((int(bool(self.problem.setting.scatter)), 3), dtype=bool)

    @functools.cached_property
    def parts(self) -> dict[str, slice]:
        """The parts of q."""
        s = len(self.scattered)
        sizes = {"law": len(self.free), "smooth": sum(one.count for one in self.smooth), "scatter": s,
                 "power": int(self.noise.grows and s > 0), "shape": self.noise.shapes}  # fmt: skip
        ends = np.cumsum([0, *sizes.values()]).tolist()
        return {name: slice(ends[i], ends[i + 1]) for i, name in enumerate(sizes)}

    @functools.cached_property
    def bounds(self) -> tuple[Array, Array]:
        """Lower and upper bounds of q."""
        low, high = (np.full(self.parts["shape"].stop, end) for end in (-np.inf, np.inf))
        low[self.parts["law"]], high[self.parts["law"]] = self.base.low[self.free], self.base.high[self.free]
        low[self.parts["scatter"]], high[self.parts["scatter"]] = math.log(1e-5), math.log(1e5)
        low[self.parts["power"]], high[self.parts["power"]] = -4.0, 4.0
        ends = STUDENT if self.noise.errors == "student" else (-2.0, 2.0)
        low[self.parts["shape"]], high[self.parts["shape"]] = ends
        return low, high

    @functools.cached_property
    def precision(self) -> Array:
        """(k, k) of the penalty."""
        p, at = np.zeros((self.parts["shape"].stop,) * 2), self.parts["smooth"].start
        for one in self.smooth:
            p[at : at + one.count, at : at + one.count] = one.penalty
            at += one.count
        return p if self.prior is None else p + np.diag(self.prior[1])

    def penalty(self, q: Array) -> tuple[float, Array]:
        """Return the penalty of splines and prior, and -1/2 of its gradient."""
        off = q if self.prior is None else q - self.prior[0] * (self.prior[1] > 0)
        return float(off @ self.precision @ off), -self.precision @ off

    def start(self, like: FitModel | None = None, numbers: Array | None = None) -> Array:
        """Return q at the law's own numbers, or at those of the same law with other forms, which the splines follow."""
        like, numbers = like or self.base, self.numbers if numbers is None else numbers
        x, q = self.problem.x, np.zeros(self.parts["shape"].stop)
        q[self.parts["law"]] = numbers[self.free]
        at = self.parts["smooth"].start
        for one in self.smooth:
            basis = self.basis(one, x)
            values = parameter_at(one.parameter, like, numbers, x)
            # (a little of the penalty: few rows do not determine all coefficients)
            precision = basis.T @ basis + 1e-9 * np.eye(one.count) + 1e-4 * one.width**2 * one.penalty
            q[at : at + one.count] = np.linalg.solve(precision, basis.T @ values)
            at += one.count
        r = np.nan_to_num(self.problem.y - self.predict(q))
        sizes = [max(float(np.sqrt(np.square(r[:, which]).mean())), 1e-4) for which in self.scattered]
        q[self.parts["scatter"]] = np.log(sizes if self.problem.estimated.any() else np.full(len(sizes), 0.02))
        q[self.parts["power"]] = float(self.problem.setting.scatter == "share")
        q[self.parts["shape"]] = math.log(6.0) if self.noise.errors == "student" else 0.0
        return np.clip(q, *self.bounds)

    def records(self, q: Array, x: Array) -> Array:
        """Return all numbers (B, N, NUMBERS) of the law at impacts x, with each of q (B, k)."""
        p = np.tile(self.numbers, (len(q), len(x), 1))
        p[:, :, self.free] = q[:, None, self.parts["law"]]
        at = self.parts["smooth"].start
        for one in self.smooth:
            place, basis = PLACES[one.parameter][0], self.basis(one, x)
            own = PARAMETERS[place]
            for b, coefficients in enumerate(q[:, at : at + one.count]):
                p[b, :, place] = np.clip(basis @ coefficients, own.low, own.high)
            at += one.count
        return p

    def basis(self, one: Smooth, x: Array) -> Array:
        """Return the splines (N, K) of a parameter at impacts x; the splines at the rows are kept."""
        known = self._bases
        key = (one.parameter, len(x))
        if x is not self.problem.x or key not in known:
            found = spline_basis(impact_variable(one.variable, x, self.problem.setting.radius), one.ends, one.count)
            if x is not self.problem.x:
                return found
            known[key] = found
        return known[key]

    @functools.cached_property
    def _bases(self) -> dict[tuple[str, int], Array]:
        return {}

    def predict(self, q: Array, x: Array | None = None) -> Array:
        """Return the law's prediction (N, 3)."""
        return np.asarray(self.predict_many(q[None], self.problem.x if x is None else x)[0])

    def predict_many(self, q: Array, x: Array) -> Array:
        """Return the predictions (B, N, 3) with each of q (B, k)."""
        rows = self.base.likelihood(derivatives=False).rows
        stages = rows.stages if len(x) == len(rows.stages) else np.full(len(x), rows.stages[0])
        records = self.records(q, x).reshape(-1, len(self.numbers))
        rows = rows._replace(stages=np.tile(stages, len(q)))
        told = predictions(self.base.law.kind, rows, np.tile(x, (len(q), 1)), records)
        return np.asarray(told.reshape(len(q), len(x), 3))

    def by_inputs(self, q: Array, x: Array, wide: Array) -> Array:
        """Return J (N, 3, 3), its last index the input, where an input has a variance."""
        j, here = np.zeros((len(x), 3, 3)), None
        for o in range(3):
            if wide[:, o].any():
                here = self.predict(q, x) if here is None else here
                step = STEP * (
                    np.hypot(x[:, 0], x[:, 1]) if o < 2 else np.hypot(x[:, 0], x[:, 1]) / self.problem.setting.radius
                )
                moved = x.copy()
                moved[:, o] += step
                j[:, :, o] = (self.predict(q, moved) - here) / step[:, None]
        return j

    def by_numbers(self, q: Array, x: Array | None = None) -> Array:
        """Return the derivatives (N, 3, m) of the prediction in the numbers of law and splines."""
        x = self.problem.x if x is None else x
        m, high = self.parts["smooth"].stop, self.bounds[1]
        sizes = STEP * np.maximum(np.abs(q[:m]), 0.1)
        sizes = np.where(q[:m] + sizes > high[:m], -sizes, sizes)
        moved = np.tile(q, (m + 1, 1))
        moved[np.arange(m), np.arange(m)] += sizes
        told = self.predict_many(moved, x)
        return np.asarray(np.moveaxis((told[:m] - told[m]) / sizes[:, None, None], 0, -1))

    def scatter(self, q: Array, x: Array) -> Array:
        """Return the variances (S, N, 3) of each fitted scatter."""
        speed, setting = np.hypot(x[:, 0], x[:, 1]), self.problem.setting
        if self.problem.estimated.any():
            power, unit, size = 0.0, np.ones(3), float(np.median(np.hypot(*self.problem.x[:, :2].T)))
        else:
            power, size = float(setting.scatter == "share"), 1.0
            unit = np.array([1.0, 1.0, 1 / setting.radius])
        if self.noise.grows and len(self.scattered):
            power = float(q[self.parts["power"]][0])
        sizes = np.exp(2 * q[self.parts["scatter"]])[:, None] * (speed / size) ** (2 * power)
        return np.asarray(sizes[:, :, None] * np.square(unit) * self.scattered[:, None, :])

    def covariance(self, q: Array) -> tuple[Array, Array]:
        """Return S (N, 3, 3) of the rows, with the unit matrix for outputs that were not measured; and the same without scatter,
        with 1 for an estimated one."""
        problem = self.problem
        x, vx, vy, seen = problem.x, problem.vx, problem.vy, np.isfinite(problem.y)
        j, cross = self.by_inputs(q, x, vx), problem.covariance
        through = np.einsum("nio,no,njo->nij", j, vx, j)
        for o in range(2):
            through[:, :, o] -= j[:, :, o] * cross[:, o, None]
            through[:, o, :] -= j[:, :, o] * cross[:, o, None]
        plain = through + np.einsum("ni,ij->nij", np.where(problem.estimated, 1.0, vy), np.eye(3))
        own = np.where(problem.estimated, 0.0, vy) + self.scatter(q, x).sum(axis=0)
        s = through + np.einsum("ni,ij->nij", own, np.eye(3))
        pair = seen[:, :, None] & seen[:, None, :]
        return np.where(pair, s, np.eye(3)), np.where(pair, plain, np.eye(3))

    def look(self, q: Array) -> tuple[Array, dict[str, Any]]:
        """Return the deviance (N,) of the rows, relative to S without scatter, and what its derivatives need."""
        s, plain = self.covariance(q)
        inverse = np.linalg.inv(s)
        y = self.problem.y
        seen = np.isfinite(y)
        inverse *= seen[:, :, None] & seen[:, None, :]
        r = np.where(seen, y - self.predict(q), 0.0)
        qr = np.einsum("nij,nj->ni", inverse, r)
        c, d = (r * qr).sum(axis=1), seen.sum(axis=1)
        some = d > 0
        shape = q[self.parts["shape"]]
        rho, weight = self.noise.rho(c, r[:, 0], np.maximum(d, 1), shape)
        value = np.where(some, np.linalg.slogdet(s)[1] - np.linalg.slogdet(plain)[1] + rho, 0.0)
        moved = np.zeros((len(y), len(shape)))
        for i in range(len(shape)):
            up = shape.copy()
            up[i] += STEP
            moved[:, i] = np.where(some, (self.noise.rho(c, r[:, 0], np.maximum(d, 1), up)[0] - rho) / STEP, 0.0)
        bad = ~np.isfinite(value)
        value[bad], qr[bad] = 1e8, 0.0
        return value, {"q": inverse, "qr": qr, "weight": weight, "shape": moved, "plain": plain}

    def evaluate(self, q: Array, weights: Array, derivatives: bool) -> tuple[float, Array, Array]:
        """Return the penalised deviance, -1/2 of its gradient and 1/2 of its curvature, of weighted rows (N,)."""
        value, found = self.look(q)
        cost, pull = self.penalty(q)
        total = float((weights * value).sum()) + cost
        u, h = np.zeros(len(q)), np.zeros((len(q), len(q)))
        if not derivatives:
            return total, u, h
        wt, qr, inverse = weights * found["weight"], found["qr"], found["q"]
        some, g = slice(0, self.parts["smooth"].stop), self.by_numbers(q)
        u[some] = np.einsum("n,nim,ni->m", wt, g, qr)
        h[some, some] = np.einsum("n,nim,nij,njl->ml", wt, g, inverse, g, optimize=True)
        spread, x = self.scatter(q, self.problem.x), self.problem.x
        if len(spread):
            # of log scatter: dS = 2 scatter^2; of the power: dS = 2 log(speed / v0) scatter^2
            size = 1.0 if not self.problem.estimated.any() else float(np.median(np.hypot(*x[:, :2].T)))
            changes = [2 * one for one in spread]
            if self.noise.grows:
                changes.append(2 * np.log(np.hypot(x[:, 0], x[:, 1]) / size)[:, None] * spread.sum(axis=0))
            at = self.parts["scatter"].start
            diagonal = np.einsum("nii->ni", inverse)
            for i, one in enumerate(changes):
                u[at + i] = (
                    -0.5 * (weights[:, None] * diagonal * one).sum() + 0.5 * (wt[:, None] * np.square(qr) * one).sum()
                )
                for m, other in enumerate(changes):
                    h[at + i, at + m] = 0.5 * np.einsum("n,ni,nij,nj->", weights, one, np.square(inverse), other)
        shape = self.parts["shape"]
        u[shape] = -0.5 * (weights[:, None] * found["shape"]).sum(axis=0)
        h[shape, shape] = 0.25 * np.einsum("n,ni,nj->ij", weights, found["shape"], found["shape"]) + 1e-9
        return total, u + pull, h + self.precision

    def minimize(self, q: Array, weights: Array | None = None) -> tuple[Array, Array, Array]:
        """Return the best numbers (B, k) from q (B, k) with weights (B, N), their deviances and information."""
        w = np.ones((len(q), len(self.problem.x))) if weights is None else weights

        def ask(which: NDArray[np.int64], at: Array, derivatives: bool) -> tuple[Array, Array, Array]:
            every = [self.evaluate(one, w[b], derivatives) for b, one in zip(which.tolist(), at, strict=True)]
            return tuple(np.array(part) for part in zip(*every, strict=True))  # type: ignore[return-value]

        found = minimize(ask, q, *self.bounds, steps=STEPS, tolerance=TOLERANCE)
        return found.p, found.value, found.information


@dataclass(frozen=True, eq=False)
class VaryingFit:
    """The fit of a :class:`VaryingModel`; made by :func:`fit_varying`."""

    model: VaryingModel
    q: Array
    deviance: float
    """Without the penalty; up to a constant that is the same for all models of the same rows."""
    information: Array
    """(k, k) with the penalty's."""

    @property
    def k(self) -> float:
        """Effective number of fitted numbers: a penalised one counts for less than 1."""
        h = self.information
        return float(len(self.q) - np.trace(np.linalg.pinv(h, hermitian=True) @ self.model.precision))

    @property
    def aicc(self) -> float:
        """As of :class:`carom.fitting.Fit`, with the effective number."""
        return akaike(self.deviance, self.k, self.model.problem.count, corrected=len(self.model.scattered) > 0)

    @property
    def dof(self) -> float:
        """Measured numbers less fitted ones."""
        return self.model.problem.count - self.k

    @property
    def covariance(self) -> Array:
        """(m, m) of the numbers of law and splines."""
        m = self.model.parts["smooth"].stop
        # (a number that the rows do not determine is as wide as its bounds, or as 2)
        low, high = (end[: len(self.model.free)] for end in self.model.bounds)
        weak = np.append(12 / np.square(np.minimum(high - low, 2.0)), np.zeros(m - len(low)))
        return np.asarray(np.linalg.pinv(self.information[:m, :m] + np.diag(weak), hermitian=True, rcond=1e-10))


def varying_model(fit: FittedLawNumbers, smooth: tuple[Smooth, ...] = (), noise: Noise = NORMAL) -> VaryingModel:
    """Return a model that begins at a fit to the same rows."""
    problem = fit.problem
    if problem.spins is not None:
        raise CaromError(
            "spins before the wall: expected measured ones for smooth parameters and predictions, got none"
        )
    base = model_of(fit.law, replace(problem, shared=()))
    return VaryingModel(base, fit.numbers[: len(PARAMETERS)].copy(), smooth, noise)


def fit_varying(
    fit: FittedLawNumbers, smooth: tuple[Smooth, ...] = (), noise: Noise = NORMAL, start: Array | None = None
) -> VaryingFit:
    """Fit smooth parameters and noise on top of a law that was fitted to the same rows.

    Parameters
    ----------
    fit : Fit
        Of the law and its forms.
    smooth : tuple of Smooth
        From :func:`smooth_parameter`.
    noise : Noise
    start : array (k,), optional

    Returns
    -------
    VaryingFit
    """
    model = varying_model(fit, smooth, noise)
    q, value, information = model.minimize((model.start() if start is None else start)[None])
    return VaryingFit(model, q[0], float(value[0]) - model.penalty(q[0])[0], information[0])
