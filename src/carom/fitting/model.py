"""A law, its fitted parameters and the rebounds, prepared for the compiled likelihood."""

from __future__ import annotations

import functools
import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.fitting.deviance import RowData
from carom.fitting.laws import ALONG, INDEX, NUMBERS, PARAMETERS, PLACES, TABULATED, FittedLaw, Parameter, viscous_loss
from carom.fitting.likelihood import Evaluation, LikelihoodModel, TabulatedLaw, evaluate, evaluate_mixture, predictions
from carom.fitting.rows import Problem, Setting, code_of, decided, forms_of
from carom.fitting.spin_chains import Minimum, evaluate_chains, minimize

Array = NDArray[np.float64]
STEPS = 200
MAX_SHARED = 5.0  # error bars: bound of shared errors
TOLERANCE = 1e-7  # of the deviance: an expected gain below this ends the descent
LEAST_SCATTER = 1e-9  # of the largest measured number and 1
NO_PREDICTION = 1e4  # m/s or rad/s: the residual where a law has none
MARGINAL_TOLERANCE = 1e-4  # the same where a spin is integrated over, to the precision of the quadrature
CARRIED_TOLERANCE, CARRIED_STEPS = 1e-2, 25  # and where it is carried along chains of contacts
# Taken from the setting if they are not fitted
SETTING_NUMBERS = ("kappa", "contact_height", "floor_friction", "floor_restitution", "roll")


@dataclass(frozen=True, eq=False)
class FitModel:
    """A law with some parameters free, and the rebounds."""

    law: FittedLaw
    problem: Problem
    form: int
    parameters: dict[str, Parameter]
    """The law's free parameters, with bounds."""
    places: dict[str, int]
    """Their indices among all numbers; parameters of the restitution's form have different names."""
    start: Array
    """(NUMBERS + S,) all numbers, and the shared errors, at the start."""
    free: NDArray[np.int64]
    """Indices of the free numbers: of the law, then shared errors."""
    low: Array
    high: Array
    moves: Array
    """(S, NUMBERS) change of the law's parameters by shared errors."""
    tabulated: TabulatedLaw | None = None
    """A table that stands in for the law (:mod:`carom.fitting.law_table`)."""
    profiled: bool = False
    """Whether the scatter of outputs without error bars is that of the residuals at each place, and enters the deviance; else it is
    the problem's."""

    def using(self, tabulated: TabulatedLaw | None) -> FitModel:
        """Return the model with a table in place of the law, or none."""
        return replace(self, tabulated=tabulated)

    def holding(self, name: str) -> FitModel:
        """Return the model with one of the law's free parameters held fixed."""
        return replace(self, free=self.free[self.free != self.places[name]])

    def without_shared(self) -> FitModel:
        """Return the model with shared errors held fixed."""
        return replace(self, free=self.free[self.free < NUMBERS])

    def steady(self) -> FitModel:
        """Return the model of constants for the same rows."""
        constant: dict[str, Any] = dict.fromkeys(("restitution", *ALONG), "constant")
        setting = replace(self.problem.setting, **constant)
        return model_of(self.law, replace(self.problem, setting=setting))

    def like(self, p: Array) -> Array:
        """Return numbers (1, K) with which the forms are nearly the constants of p (K,)."""
        out, v_n = p.copy(), float(np.median(self.problem.x[:, 0]))
        for name, form in forms_of(self.law, self.problem.setting).items():
            places = list(PLACES[name])
            out[places] = form.like(float(p[places[0]]), v_n)
        out[self.free] = np.clip(out[self.free], self.low[self.free], self.high[self.free])
        return out[None]

    def near(self, p: Array) -> Array:
        """Return numbers (1, K) with the free ones of another law's p (K,), within bounds."""
        out = self.start.copy()
        out[self.free] = np.clip(p[self.free], self.low[self.free], self.high[self.free])
        return out[None]

    def likelihood(self, derivatives: bool = True) -> LikelihoodModel:
        """Return rows and law for the compiled loops; unmeasured spins are omitted if the law does not depend on them."""
        return self._likelihood if derivatives else self._likelihood_alone

    @functools.cached_property
    def _likelihood_alone(self) -> LikelihoodModel:
        return replace(self._likelihood, free=self.free[:0])

    @functools.cached_property
    def _likelihood(self) -> LikelihoodModel:
        problem, x, spins = self.problem, self.problem.x, self.problem.spins
        if spins is not None and not feels_spins(self.law, problem):
            x, spins = np.nan_to_num(x), None
        stages = np.zeros(len(x), np.int64) if problem.stages is None else problem.stages
        code = self.law.contact_code if self.tabulated is None else TABULATED
        arrays = (x, problem.vx, problem.covariance, problem.y, problem.vy, _moved(problem), self.moves)
        x, vx, covariance, y, vy, moved, moves = (np.ascontiguousarray(array, float) for array in arrays)
        stages, a, nu = np.ascontiguousarray(stages, np.int64), problem.setting.radius, problem.nu
        rows = RowData(code, self.form, stages, a, spins, x, vx, covariance, y, vy, nu, np.empty(0))
        free = np.ascontiguousarray(self.free)
        return LikelihoodModel(self.law.kind, rows, free, self.low, self.high, moved, moves, self.tabulated)

    def minimize(
        self,
        p: Array,
        steps: int = STEPS,
        weights: Array | None = None,
        centers: Array | None = None,
        close: float = 0.0,
    ) -> Minimum:
        """Minimise the deviance from each of p (B, K); ``p`` of the result holds all numbers.

        ``weights`` (B or 1, N) of the rows. A shared error is normal, with width 1, about 0 or ``centers`` (B, S). A descent ends
        when it is expected to gain less than ``close``, or than usual if that is more.
        """
        p = np.array(p, dtype=float)
        centers = np.zeros((len(p), len(self.moves))) if centers is None else centers
        shared = self.free >= NUMBERS
        prior = np.diag(shared.astype(float))

        def deviance(which: NDArray[np.int64], at: Array, derivatives: bool) -> tuple[Array, Array, Array]:
            some = weights if weights is None or len(weights) == 1 else weights[which]
            every = p[which]
            every[:, self.free] = at
            seen = self.evaluate(every, some, derivatives)
            rows = seen.deviance if some is None else seen.deviance * some
            off = every[:, NUMBERS:] - centers[which]
            if derivatives:
                seen.scores[:, shared] -= off[:, self.free[shared] - NUMBERS]
            return (
                rows.sum(axis=1) + np.square(off).sum(axis=1),
                seen.scores,
                seen.information + prior if derivatives else prior,
            )

        tolerance = TOLERANCE if self._likelihood.rows.spins is None else MARGINAL_TOLERANCE
        if self.problem.carried:
            tolerance, steps = CARRIED_TOLERANCE, min(steps, CARRIED_STEPS)
        found = minimize(
            deviance, p[:, self.free], self.low[self.free], self.high[self.free], steps=steps,
            tolerance=max(tolerance, close),
        )  # fmt: skip
        p[:, self.free] = found.p
        return replace(found, p=p)

    def evaluate(self, p: Array, weights: Array | None = None, derivatives: bool = True) -> Evaluation:
        """Evaluate the likelihood at B sets of numbers p (B, K), with weights (B or 1, N) of the rows."""
        if self.profiled:
            each = [self._profile(one, derivatives) for one in p]
            if len(each) == 1:
                return each[0]
            return Evaluation(*map(np.concatenate, zip(*(vars(seen).values() for seen in each), strict=True)))
        mixture = self.problem.mixture
        if not feels_spins(self.law, self.problem) or (mixture is None and not self.problem.carried):
            return evaluate(self.likelihood(derivatives), p, weights)
        if mixture is None:
            return evaluate_chains(self, p, weights, derivatives)
        return evaluate_mixture(self.likelihood(derivatives), mixture, p, weights)

    def _profile(self, p: Array, derivatives: bool) -> Evaluation:
        """Evaluate the likelihood at p (K,) with the scatter of the residuals there. (The scores are those with that scatter held:
        it is the best one for p.)"""
        (gap, vy), (seen, without_bars, *_) = self._residuals(p), self._measured
        logs = np.log(np.where(without_bars, vy, 1.0)).sum(axis=1)
        if derivatives or self._incoming_errors:
            model = self.likelihood(derivatives)
            found = evaluate(replace(model, rows=model.rows._replace(vy=vy)), p[None])
            return replace(found, deviance=found.deviance + logs)
        chi2 = (np.square(gap) / np.where(seen, vy, 1.0)).sum(axis=1)[None]
        return Evaluation(chi2 + logs, chi2, np.zeros((1, 0)), np.zeros((1, 0, 0)))

    def _residuals(self, p: Array) -> tuple[Array, Array]:
        """Return the residuals (N, 3) at p (K,), 0 where nothing was measured, and the variances after the wall: of outputs without
        error bars the mean square of the residuals."""
        problem, (seen, _, counts, fitted, least) = self.problem, self._measured
        gap = problem.y - predictions(self.law.kind, self._likelihood_alone.rows, problem.x, p)
        gap = np.where(seen, np.where(np.isnan(gap), NO_PREDICTION, gap), 0.0)
        mean = np.square(gap).sum(axis=0) / counts
        return gap, np.where(fitted, np.maximum(mean, least), problem.vy)

    @functools.cached_property
    def _measured(self) -> tuple[NDArray[np.bool_], NDArray[np.bool_], NDArray[np.int64], NDArray[np.bool_], Array]:
        """What was measured (N, 3), and of this what has no error bars (N, 3); for each output the number of measured rows, at
        least 1, whether its scatter is that of the residuals, and the least variance."""
        seen, estimated = np.isfinite(self.problem.y), self.problem.estimated
        least = np.square(LEAST_SCATTER * (1 + np.where(seen, np.abs(self.problem.y), 0.0).max(axis=0)))
        return seen, seen & estimated, np.maximum(seen.sum(axis=0), 1), estimated & seen.any(axis=0), least

    @functools.cached_property
    def _incoming_errors(self) -> bool:
        return bool(self.problem.vx.any())

    def with_scatter_of(self, p: Array) -> FitModel:
        """Return the model with the scatter of the residuals at p (K,), held."""
        return replace(self, problem=replace(self.problem, vy=self._residuals(p)[1]), profiled=False)

    def deviances(self, p: Array) -> Array:
        """Return the deviance (B,) at each of p (B, K), shared errors included."""
        rows = self.evaluate(p, derivatives=False).deviance
        return np.asarray(rows.sum(axis=1) + np.square(p[:, NUMBERS:]).sum(axis=1))

    def row_deviances(self, p: Array) -> tuple[Array, Array]:
        """Return deviance and chi^2 (N,) of each row at p."""
        seen = self.evaluate(p[None], derivatives=False)
        return seen.deviance[0], seen.chi2[0]


def feels_spins(law: FittedLaw, problem: Problem) -> bool:
    """Return whether the unmeasured spins before the wall affect what was measured after it."""
    if problem.spins is None:
        return False
    return not law.frictionless or bool(np.isfinite(problem.y[problem.unknown, 2]).any())


def _matters(name: str, law: FittedLaw) -> bool:
    """Return whether a law depends on a requested parameter."""
    return law.feels_floor if name == "floor_friction" else law.kind == "table" or name == "kappa"


def model_of(law: FittedLaw, problem: Problem) -> FitModel:
    """Return the law with its free parameters, prepared for the compiled loops."""
    setting, forms, floor = problem.setting, forms_of(law, problem.setting), INDEX["floor_friction"]
    at = dict(enumerate(PARAMETERS))  # by the place in the record
    for name, form in forms.items():
        at.update(zip(PLACES[name], form.parameters))  # noqa: B905 (a form has one to three)
    known = [_given(one, setting) for one in at.values()]
    also = [name for name in setting.fit if name in INDEX and _matters(name, law)]
    if feels_spins(law, problem) and problem.mixture is None and problem.drawn.any():
        also += ["spin_mean"] if setting.spin_mean is None and setting.spin_prior == "normal" else []
        also += ["spin_width"] if setting.spin_width is None else []
    every = decided(law, setting, known, also)
    places = {one.name: i for i, one in enumerate(known)}
    free = {name: one for name, one in every.items() if one.free}
    start = np.array([*(every[one.name].value for one in known), *(0.0 for _ in problem.shared)])
    low, high = np.full(len(start), -MAX_SHARED), np.full(len(start), MAX_SHARED)
    low[:NUMBERS], high[:NUMBERS] = -math.inf, math.inf
    for name, one in free.items():
        low[places[name]], high[places[name]] = one.low, one.high
    moves = np.zeros((len(problem.shared), NUMBERS))
    if "floor_friction" not in free and "floor_friction" not in law.pinned:
        moves[:, floor] = [one.floor for one in problem.shared]
        moved = moves[:, floor] != 0
        low[NUMBERS:][moved] = np.maximum(-MAX_SHARED, 0.01 - start[floor] / moves[moved, floor])
    fitted = np.array([*(places[name] for name in free), *range(NUMBERS, len(start))], dtype=np.int64)
    return FitModel(
        law, problem, code_of(forms), free, {name: places[name] for name in free}, start, fitted, low, high, moves
    )


def _given(one: Parameter, setting: Setting) -> Parameter:
    """Return a parameter of the ball or the table, or of the spins before the wall, with the setting's value, if it has one."""
    value = getattr(setting, one.name) if one.name in (*SETTING_NUMBERS, "spin_width", "spin_mean") else None
    return one if value is None else replace(one, value=value, origin="setting")


def _moved(problem: Problem) -> Array:
    """Return the changes (S, N, 6) of the rows by shared errors."""
    return np.stack([one.rows for one in problem.shared]) if problem.shared else np.empty((0, len(problem.x), 6))


def predict_law(law: FittedLaw, problem: Problem, p: Array) -> Array:
    """Return the measurements (N, 3) that a law predicts with numbers p; an unmeasured spin is set to its mean.

    The numbers may come from a fit to other rows, whose shared errors then do not apply.
    """
    model, shared = model_of(law, problem), p[NUMBERS : NUMBERS + len(problem.shared)]
    moved = np.tensordot(shared, _moved(problem), 1)
    p = np.append(p[:NUMBERS] + shared @ model.moves, 0 * shared)
    x = problem.x + moved[:, :3]
    mean = p[INDEX["spin_mean"]] * x[:, 1] / problem.setting.radius
    x[:, 2] = np.where(np.isnan(x[:, 2]), mean, x[:, 2])
    return predictions(law.kind, model.likelihood().rows, x, p) - moved[:, 3:]


# ----------------------------------------------------------------------------------------------------
# Starting values of a restitution that depends on the speed, from the measured ratios of normal speeds.
#
# A form of three numbers has several valleys, and a grid of starting values may miss the one of the data: a polynomial whose
# vertex lies below the least measured speed is constant over the table, and the deviance there does not depend on two of its
# coefficients.


SPEED_SHARES = (0.3, 1.0, 3.0)  # of the median speed: over which an exponential is tried
LEAST_SPEEDS = 3
MOST_RATIO = 1.2  # of normal speeds: larger ones are errors of measurement


def form_starts(form: str, speed: Array, ratio: Array) -> list[tuple[float, ...]]:
    """Return starting values of a form's parameters, by least squares.

    Parameters
    ----------
    form : str
        One of :data:`carom.fitting.laws.FORMS`.
    speed, ratio : (N,)
        Normal speed of the approach, m/s, and the ratio of the normal speeds after and before; NaN: not measured.

    Returns
    -------
    list of tuples, empty for a constant, and where fewer than three different speeds were measured.

    Examples
    --------
    >>> import numpy as np
    >>> speed = np.array([4.0, 8.0, 12.0])
    >>> [[round(x, 4) for x in one] for one in form_starts("polynomial", speed, 0.95 - 0.03 * speed + 0.001 * speed**2)]
    [[0.95, -0.03, 0.001]]
    """
    good = np.isfinite(speed) & np.isfinite(ratio) & (speed > 0)
    v, e = speed[good], np.clip(ratio[good], 1e-3, MOST_RATIO)
    if len(np.unique(v)) < LEAST_SPEEDS:
        return []
    if form in ("polynomial", "line"):
        coefficients = np.polyfit(v, e, 2)[::-1] if form == "polynomial" else np.polyfit(v, e * v, 1)
        return [tuple(coefficients.tolist())]
    if form == "power":
        slope, height = np.polyfit(np.log(v / v.min()), np.log(e), 1)
        return [(float(np.exp(height)), float(v.min()), -float(slope))]
    if form == "viscoelastic":
        return [(float(np.median(viscous_loss(e) / v**0.2)),)]
    if form == "exponential":
        found: list[tuple[float, ...]] = []
        for share in SPEED_SHARES:
            over = share * float(np.median(v))
            fall = np.exp(-v / over)
            (far, rise), *_ = np.linalg.lstsq(np.stack([np.ones_like(v), fall], axis=-1), e, rcond=None)
            found.append((float(far + rise), float(far), over))
        return found
    return []
