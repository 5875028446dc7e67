"""A law, its fitted parameters and the rebounds, prepared for the compiled likelihood."""

from __future__ import annotations

import functools
import itertools
import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.bodies import Ball, State, Surface
from carom.core.jit.threads import block_slices
from carom.fitting.deviance import RowData
from carom.fitting.laws import (
    ALONG,
    DENSE,
    INDEX,
    NUMBERS,
    PARAMETERS,
    PLACES,
    PLANES,
    ROLLING,
    TABULATED,
    TOGETHER,
    FittedLaw,
    Parameter,
    viscous_loss,
)
from carom.fitting.likelihood import Evaluation, LikelihoodModel, TabulatedLaw, evaluate, evaluate_mixture, predictions
from carom.fitting.rows import Problem, Setting, code_of, decided, forms_of
from carom.fitting.spin_chains import Minimum, evaluate_chains, minimize
from carom.laws.two_step_batch import two_step_into

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
    """A table that stands in for the law (:mod:`carom.fitting.model`)."""
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


def prior_parameters(law: FittedLaw, problem: Problem) -> int:
    """Return the number of adjusted parameters of a mixture of spins, where the law depends on unmeasured ones."""
    return problem.mixture.parameters if problem.mixture is not None and feels_spins(law, problem) else 0


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


def predictions_beside(law: FittedLaw, problem: Problem, p: Array, size: Array) -> list[tuple[Array, Array]]:
    """Return the predictions (N, 3) with v_n, v_t and spin before the wall larger and smaller by ``size`` (N, 3)."""
    steps = [size[:, o, None] * np.eye(3)[o] for o in range(3)]
    up, down = (
        [predict_law(law, replace(problem, x=problem.x + sign * step), p) for step in steps] for sign in (1, -1)
    )
    return list(zip(up, down, strict=True))


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


# ----------------------------------------------------------------------------------------------------
# A law tabulated in its own parameters, for fits of many rows to a law that is costly to solve.
#
# Wall and floor at once takes 8 us a contact, and a fit to a row whose spin was not measured asks for some 20,000. But the answer
# depends on few numbers: scaled by the speed, on the direction and the spin of the ball before the wall, on the wall's
# restitution and friction, and, where the film's error of it is fitted, on the friction of the floor. So it is solved on a grid
# of directions and spins for each node of a lattice in restitution and log friction, when a trial point first needs that node. At
# a trial point sixteen nodes are combined into one grid, with its derivatives (:func:`carom.fitting.laws.look_up`); interpolation
# is cubic, and in the floor's friction, which the film knows well, linear.
#
# Where a contact changes from sliding to sticking the answer has a kink, across which a table is off by a share of its spacing:
# by 1.3e-3 of the speed (rms; 4e-3 at most) on the coarse lattice, which serves the search, and by 3e-5 (3e-4) on a fine one for
# narrow error bars, which space its nodes about the place that was found (tests keep that). With six error bars between nodes the
# deviance of 89 rebounds was off by 12 beside the best friction, with one by 0.05; in the restitution it is smooth, and eight are
# as good as one. The fine one serves what asks how much the deviance rises: what is identifiable, the bootstrap, where folds begin,
# and the profiles of single numbers. The estimates, chi^2 and AICc are from the law itself, by a descent that starts there, and are
# those of a fit without a table to a hundredth of an error bar; so are the numbers of folds, and the deviances of profiles: error
# bars are those of the law to 1 % (a test says so).


LEAST_ROWS = 60  # without spin: from here on a table is quicker than the law
COARSE, NEAR, FINE = (28, 120), (40, 170), (56, 240)  # directions and spins
NARROW = 2e-3  # error bar of restitution or log friction: with a smaller one a fine table has a fine grid, too
SPACING = (2.0**-4, 2.0**-3)  # of the coarse lattice, in restitution and log(friction + OFFSET)
OFFSET = 0.02
FURTHEST_SPIN = 12.5  # v/a
STEEPEST = 0.97  # direction, v_t / (v_n + v_t), up to which there are tables
FLOOR_STEP = 1.0  # error bars of the floor's friction between the nodes in it
FINE_STEP = (8.0, 1.0)  # error bars of restitution, in which the law is smooth, and of friction between fine nodes
FINEST = -12  # power of 2
MOST_NODES = 400  # kept in memory
# Of a product of matrices: for more, BLAS starts threads, which cost ten times the product on a busy machine
COLUMNS = 2048
E, MU, FLOOR = INDEX["restitution"], INDEX["friction"], INDEX["floor_friction"]


@dataclass(frozen=True)
class _Grid:
    """Directions and spins, and what does not change."""

    shape: tuple[int, int]
    stages: tuple[int, ...]
    radius: float
    steepest: float
    others: tuple[float, ...]
    """All parameters; the lattice's are replaced."""
    floor_step: float
    """Between nodes in the floor's friction; 0: it does not move."""

    @property
    def directions(self) -> Array:
        """v_t / (v_n + v_t), from a little below 0."""
        step = self.steepest / (self.shape[0] - 5)
        return np.asarray((np.arange(self.shape[0]) - 2) * step, dtype=float)

    @property
    def spins(self) -> Array:
        """asinh of the spin over DENSE v/a."""
        far = math.asinh(FURTHEST_SPIN / DENSE)
        return np.linspace(-far, far, self.shape[1])

    def head(self) -> Array:
        """Return the head of a table, without the parameters."""
        one, two = self.directions, self.spins
        return np.array(
            [one[0], 1 / (one[1] - one[0]), len(one), two[0], 1 / (two[1] - two[0]), len(two), len(self.stages)]
        )


@functools.lru_cache(maxsize=MOST_NODES)
def _node(grid: _Grid, restitution: float, friction: float, floor: float) -> Array:
    """Return the law's predictions on the grid, flat: (stages, directions, spins, 3)."""
    one, two = np.meshgrid(grid.directions, grid.spins, indexing="ij")
    v_n, v_t = 1 - np.abs(one), one
    speed = np.hypot(v_n, v_t)
    ball = np.stack([v_n / speed, v_t / speed, DENSE * np.sinh(two) / grid.radius], axis=-1).reshape(-1, 3)
    p = np.array(grid.others)
    p[[E, MU, FLOOR]] = restitution, friction, floor
    x, empty = np.tile(ball, (len(grid.stages), 1)), np.empty((0, 3))
    stages = np.repeat(np.array(grid.stages, np.int64), len(ball))
    out = np.full(x.shape, math.nan)
    if grid.stages == (ROLLING,):
        out = _rolling(x, p, grid.radius)
    left = np.isnan(out[:, 0])
    rows = RowData(
        TOGETHER, 0, stages[left], grid.radius, None, x[left], empty, empty[:, :2], empty, empty, 0.0, np.empty(0)
    )
    out[left] = predictions("table", rows, x[left], p)
    out[:, 2] *= grid.radius
    return out.ravel()


def _rolling(x: Array, p: Array, a: float) -> Array:
    """Return the law's predictions (N, 3) for balls that roll again, many at once; NaN for one that does not roll away."""
    names = "restitution friction floor_restitution floor_friction roll contact_height kappa"
    e, mu, ef, muf, roll, height, kappa = (float(p[INDEX[name]]) for name in names.split())
    up, (v_n, v_t, spin) = 1 - height, x.T
    before = State(np.stack([-v_n, v_t, 0 * v_n], axis=1), np.stack([-roll / a * v_t, -roll / a * v_n, spin], axis=1))
    after, ball = State(np.zeros_like(x), np.zeros_like(x)), Ball(radius=a, mass=1.0, inertia=kappa)
    normal, why = (math.sqrt(1 - up * up), 0.0, up), np.zeros(len(x), np.int8)
    two_step_into(after, why, ball, before, Surface(e, mu), Surface(ef, muf), normal)
    return np.stack([*after.velocity.T[:2], after.spin[:, 2]], axis=1)


@dataclass(frozen=True, eq=False)
class LawTable:
    """A lattice of nodes, which are solved when they are first needed."""

    grid: _Grid
    spacing: tuple[float, float]

    def at(self, p: Array, moves: Array, free: NDArray[np.int64]) -> Array:
        """Return the table at a trial point p (NUMBERS + S,), with derivatives in the free numbers, as compiled code reads it."""
        floor = float(p[FLOOR] + p[NUMBERS:] @ moves[:, FLOOR])
        asked = (True, E in free, MU in free, bool((free >= NUMBERS).any()))
        planes = tuple(plane for plane in range(PLANES) if asked[plane])
        return _combined(self.grid, self.spacing, float(p[E]), float(p[MU]), floor, planes)

    def covers(self, problem: Problem) -> bool:
        """Return whether all rows lie within the grid."""
        return _steepest(problem) <= self.grid.steepest


@functools.lru_cache(maxsize=24)
def _combined(
    grid: _Grid, spacing: tuple[float, float], e: float, mu: float, floor: float, planes: tuple[int, ...]
) -> Array:
    """Return the predictions between nodes, plane 0, and those of their derivatives in restitution, friction or the floor's
    friction (1 to 3) that are asked for; zeros for the others."""
    one, w, dw = _stencil(e / spacing[0], 0, round(1 / spacing[0]))
    least = math.ceil(math.log(OFFSET) / spacing[1])
    two, u, du = _stencil(math.log(mu + OFFSET) / spacing[1], least, least + 1_000_000)
    t, df = 0.0, np.zeros(2)
    if grid.floor_step:  # (a straight line: the film knows the floor well)
        t, df = (floor - grid.others[FLOOR]) / grid.floor_step, np.array([-1, 1]) / grid.floor_step
    f = np.array([1 - t, t])
    each = ((w, u, f), (dw / spacing[0], u, f), (w, du / spacing[1] / (mu + OFFSET), f), (w, u, df))
    shares = np.stack([np.einsum("i,j,k->ijk", *each[plane]).ravel() for plane in planes])
    places = np.array(list(itertools.product(one, two, (0, 1))))
    used = shares.any(axis=0)  # (a floor as it is given, of which no derivative is asked, needs half of the nodes)
    nodes = _nodes(grid, spacing, tuple(map(tuple, places[used].tolist())))
    body, shares = np.zeros((PLANES, nodes.shape[1])), shares[:, used]
    for some in block_slices(nodes.shape[1], COLUMNS):
        body[list(planes), some] = shares @ nodes[:, some]
    return np.concatenate([[e, mu, floor], grid.head(), body.ravel()])


@functools.lru_cache(maxsize=6)
def _nodes(grid: _Grid, spacing: tuple[float, float], places: tuple[tuple[int, int, int], ...]) -> Array:
    """Return the predictions at some nodes of the lattice, one a row."""
    return np.stack(
        [
            _node(
                grid,
                i * spacing[0],
                max(math.exp(j * spacing[1]) - OFFSET, 0.0),
                grid.others[FLOOR] + k * grid.floor_step,
            )
            for i, j, k in places
        ]
    )


def _stencil(x: float, low: int, high: int) -> tuple[list[int], Array, Array]:
    """Return the four nodes about x, with Lagrange's weights and their derivatives in x; all nodes within low and high."""
    first = min(max(math.floor(x) - 1, low), high - 3)
    t = x - first
    nodes = np.arange(4.0)
    w, dw = np.ones(4), np.zeros(4)
    for i in range(4):
        others = [m for m in range(4) if m != i]
        bottom = math.prod(i - m for m in others)
        w[i] = math.prod(t - nodes[m] for m in others) / bottom
        dw[i] = sum(math.prod(t - nodes[m] for m in others if m != n) for n in others) / bottom
    return [first + m for m in range(4)], w, dw


def _steepest(problem: Problem) -> float:
    """Return the largest direction of a row, with five error bars of room."""
    v_n, v_t = problem.x[:, 0], np.abs(problem.x[:, 1])
    room = 5 * np.sqrt(problem.vx[:, :2].max(axis=1)) / (v_n + v_t)
    return float((v_t / (v_n + v_t) + room).max())


def coarse_table(model: FitModel) -> LawTable | None:
    """Return a table for the search; None where the law is as quick, or depends on more than a table has."""
    problem, law = model.problem, model.law
    free = set(model.free[model.free < NUMBERS].tolist()) - {INDEX["spin_mean"], INDEX["spin_width"]}
    moved = set(np.flatnonzero(model.moves.any(axis=0)).tolist())
    if law.code != TOGETHER or law.search_code is None or problem.spins is None or problem.unknown.sum() < LEAST_ROWS:
        return None
    if (
        not (free <= {E, MU} and moved <= {FLOOR} and model.form == 0)
        or problem.stages is None
        or problem.rebounds.kind != "table"
    ):
        return None
    steepest = math.ceil(_steepest(problem) * 32) / 32
    others = model.start[:NUMBERS]
    if steepest > STEEPEST or others[INDEX["tangential_restitution"]] != 0 or others[MU] > PARAMETERS[MU].high:
        return None
    step = FLOOR_STEP * float(np.linalg.norm(model.moves[:, FLOOR])) if moved else 0.0
    if step >= others[FLOOR]:
        return None
    grid = _Grid(
        COARSE, tuple(sorted(set(problem.stages.tolist()))), problem.setting.radius, steepest, tuple(others.tolist()), step,
    )  # fmt: skip
    return LawTable(grid, SPACING)


def fine_table(coarse: LawTable, stderr: tuple[float, float], friction: float) -> LawTable:
    """Return a finer table, whose nodes are some error bars of restitution and friction apart."""

    def power(step: float, most: float) -> float:
        return float(2.0 ** max(FINEST, math.floor(math.log2(step)))) if 0 < step < most else most

    along = stderr[1] / (friction + OFFSET)
    narrow = any(0 < bar < NARROW for bar in (stderr[0], along))
    grid = replace(coarse.grid, shape=FINE if narrow else NEAR)
    return LawTable(grid, (power(FINE_STEP[0] * stderr[0], SPACING[0]), power(FINE_STEP[1] * along, SPACING[1])))
