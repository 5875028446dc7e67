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
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.bodies import State
from carom.data.rebounds import COLUMNS, Rebounds
from carom.errors import CaromError, Fault
from carom.fitting.evidence import akaike
from carom.fitting.laws import (
    ALONG_FORMS,
    PARAMETERS,
    PLACES,
    RESTITUTION_FORMS,
    of_impact,
    speed_restitution,
)
from carom.fitting.likelihood import predictions
from carom.fitting.model import FitModel, model_of
from carom.fitting.rows import Problem
from carom.fitting.spin_chains import minimize

Array = NDArray[np.float64]
ERRORS = ("normal", "student", "two-sided")
LEAST_C = 1e-6  # of c where the two-sided exponential has its peak


@dataclass(frozen=True)
class Noise:
    """The distribution of errors and scatter.

    Examples
    --------
    >>> Noise("student", grows=True).shapes
    1
    """

    errors: str = "normal"
    """One of ERRORS. "two-sided": exponential on both sides, with sizes of v_n's that may differ."""
    grows: bool = False
    """Whether the scatter grows with a fitted power of the speed."""

    @property
    def shapes(self) -> int:
        """Number of fitted numbers of the distribution's shape."""
        return int(self.errors != "normal")

    def rho(self, c: Array, first: Array, d: Array, shape: Array) -> tuple[Array, Array]:
        """Return the deviance (N,) of d numbers beside log det S, and its slope in c = r' S^-1 r; ``first``: v_n's residual."""
        if self.errors == "normal":
            return c, np.ones(len(c))
        if self.errors == "student":
            nu = math.exp(float(shape[0]))
            lgamma = np.vectorize(math.lgamma)
            constant = -2 * (lgamma((nu + d) / 2) - math.lgamma(nu / 2)) + d * math.log(nu / 2)
            return (nu + d) * np.log1p(c / nu) + constant, (nu + d) / (nu + c)
        # a multivariate exponential, exp(-sqrt((d + 1) c)); on the two sides of v_n = 0 its sizes are exp(+-a)
        a = float(shape[0])
        side = np.exp(-2 * a * np.sign(first))
        lgamma = np.vectorize(math.lgamma)
        constant = 2 * (lgamma(d + 1.0) + (1 + d) * math.log(2) - np.log(d) - lgamma(d / 2.0)) - d * np.log(
            4.0 * (d + 1)
        )
        constant = constant - d * math.log(2) + 2 * np.log(np.cosh(a * d))
        root = np.sqrt((d + 1) * np.maximum(c * side, LEAST_C))
        return 2 * root + constant, (d + 1) * side / root


NORMAL = Noise()


# ----------------------------------------------------------------------------------------------------
# Parameters of a law as penalised B-splines of v_n, slip, slip/v_n or speed.


SPLINES, ROWS_PER_SPLINE, DEGREE = 8, 6, 3


def impact_variable(name: str, x: Array, radius: float) -> Array:
    """Return v_n, slip, slip/v_n or speed (N,) of rebounds x (N, 3); of balls on a table the slip by sidespin along the wall."""
    slip = np.abs(x[:, 1] - radius * x[:, 2])
    found = {"v_n": x[:, 0], "slip": slip, "slip/v_n": slip / x[:, 0], "speed": np.hypot(x[:, 0], x[:, 1])}
    return np.asarray(found[name])


def parameter_at(parameter: str, model: FitModel, numbers: Array, x: Array) -> Array:
    """Return restitution, friction, tangential restitution or stiffness ratio (N,) at impacts x, by their forms."""
    p, a, along = (
        [float(numbers[i]) for i in PLACES[parameter]],
        model.problem.setting.radius,
        model.form // RESTITUTION_FORMS,
    )
    triple = (p[0], p[1], p[2])
    if parameter == "restitution":
        return np.array([speed_restitution(model.form % RESTITUTION_FORMS, triple, v) for v in x[:, 0].tolist()])
    code = along % ALONG_FORMS if parameter == "friction" else along // ALONG_FORMS
    balls = [((-v, u, 0.0), (0.0, 0.0, w)) for v, u, w in x.tolist()]
    return np.array([of_impact(code, triple, v, w, (1.0, 0.0, 0.0), a) for v, w in balls])


def spline_basis(s: Array, ends: tuple[float, float], count: int) -> Array:
    """Return B-splines (N, count) at s, which is held within its ends."""
    from scipy.interpolate import BSpline

    inner = np.linspace(*ends, count - DEGREE + 1)
    width = inner[1] - inner[0]
    knots = np.concatenate(
        [inner[0] - width * np.arange(DEGREE, 0, -1), inner, inner[-1] + width * np.arange(1, DEGREE + 1)]
    )
    return np.asarray(BSpline.design_matrix(np.clip(s, *ends), knots, DEGREE).toarray())


@dataclass(frozen=True)
class Smooth:
    """One parameter as a spline of one variable: its place in the record, the ends and number of splines, the penalty."""

    parameter: str
    variable: str
    ends: tuple[float, float]
    count: int
    width: float
    """Of the second differences of the coefficients, under the penalty."""

    @property
    def penalty(self) -> Array:
        """The precision (K, K) of the coefficients."""
        differences = np.diff(np.eye(self.count), 2, axis=0)
        return np.asarray(differences.T @ differences / self.width**2)


def smooth_parameter(fit: Any, parameter: str, variable: str, width: float) -> Smooth:
    """Return a spline of one parameter, with ends and number as the rows allow."""
    s = impact_variable(variable, fit.problem.x, fit.problem.setting.radius)
    count = int(np.clip(len(s) // ROWS_PER_SPLINE, DEGREE + 1, SPLINES))
    return Smooth(parameter, variable, (float(s.min()), float(s.max())), count, width)


# ----------------------------------------------------------------------------------------------------
# A law whose parameters are smooth functions of the impact, with scatter that may grow with the speed and have heavy tails.


STEP = 1e-4  # of a number: of numerical derivatives
STEPS, TOLERANCE = 60, 1e-6
STUDENT = (math.log(2.0), math.log(200.0))  # bounds of log nu


@dataclass(frozen=True, eq=False)
class VaryingModel:
    """Rows, a law, smooth parameters and noise. Fitted are q: numbers of the law and splines, log scatter, its power, the shape."""

    base: FitModel
    numbers: Array
    """(NUMBERS,) where the law's fitted numbers begin, and the values of the others."""
    smooth: tuple[Smooth, ...] = ()
    noise: Noise = NORMAL

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
        return p

    def penalty(self, q: Array) -> tuple[float, Array]:
        """Return the penalty of splines, and -1/2 of its gradient."""
        return float(q @ self.precision @ q), -self.precision @ q

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

    def by_numbers(self, q: Array) -> Array:
        """Return the derivatives (N, 3, m) of the prediction in the numbers of law and splines."""
        m, high = self.parts["smooth"].stop, self.bounds[1]
        sizes = STEP * np.maximum(np.abs(q[:m]), 0.1)
        sizes = np.where(q[:m] + sizes > high[:m], -sizes, sizes)
        moved = np.tile(q, (m + 1, 1))
        moved[np.arange(m), np.arange(m)] += sizes
        told = self.predict_many(moved, self.problem.x)
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


def varying_model(fit: Any, smooth: tuple[Smooth, ...] = (), noise: Noise = NORMAL) -> VaryingModel:
    """Return a model that begins at a fit to the same rows."""
    problem = fit.problem
    if problem.spins is not None:
        raise CaromError(
            "spins before the wall: expected measured ones for smooth parameters and predictions, got none"
        )
    base = model_of(fit.law, replace(problem, shared=()))
    return VaryingModel(base, fit.numbers[: len(PARAMETERS)].copy(), smooth, noise)


def fit_varying(
    fit: Any, smooth: tuple[Smooth, ...] = (), noise: Noise = NORMAL, start: Array | None = None
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


# ----------------------------------------------------------------------------------------------------
# Predictions of a fitted law: mean and covariance of the state after the wall, regions, and the score of rows held out.
#
# The covariance of a prediction is S + G C G': the scatter of rebounds (and their error bars), and the covariance C of the fitted
# numbers through the derivatives G. Where the scatter was estimated from few rows, S is enlarged by n/(n - k), and the prediction
# is Student's t with n - k degrees of freedom for each output.


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
