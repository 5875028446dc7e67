"""A law and rebounds as the compiled loops take them, and what comes back: numbers, error bars, deviances."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from carom.fitting.data import Problem
from carom.fitting.descent import descend
from carom.fitting.kernels import MAW, SMOOTH, TOGETHER, TURN
from carom.fitting.laws import FittedLaw
from carom.fitting.looks import Rows, look, said
from carom.fitting.parameters import FORMS, INDEX, NUMBERS, PARAMETERS, Parameter

__all__ = [
    "GIVEN",
    "Estimate",
    "Fit",
    "Ways",
    "feels_spins",
    "go",
    "parameters_of",
    "predict_law",
    "refit",
    "rows_of_fit",
    "scaled",
    "ways_of",
]

Array = NDArray[np.float64]
STEPS = 200
FURTHEST = 5.0  # error bars of what rows share
GIVEN = (
    "kappa",
    "contact_height",
    "floor_friction",
    "floor_restitution",
    "roll",
)  # by the setting, where they are not fitted


@dataclass(frozen=True)
class Estimate:
    """A number of a law."""

    value: float | None
    """None where the data do not tell it."""
    stderr: float | None
    """None where the data do not tell it, or it is at a bound. By the curvature at the best place; by the interval of 95 % where
    that was asked for and is far wider."""
    note: str = ""
    interval_68: tuple[float, float] | None = None
    """By profile likelihood; an end at a bound is the bound."""
    interval_95: tuple[float, float] | None = None
    bootstrap: float | None = None
    """Standard error from rows drawn anew."""
    shared: float | None = None
    """Standard error from what all rows may have wrong together (:mod:`carom.fitting.shared`), beside ``stderr``."""


@dataclass(frozen=True, eq=False)
class Fit:
    """A law and rebounds. ``aicc`` is infinite where there are too few measured numbers for it."""

    law: FittedLaw
    problem: Problem
    names: tuple[str, ...]
    """Of the free numbers."""
    estimates: dict[str, Estimate]
    numbers: Array
    """(K,) all numbers, in carom's order, at the best place; then the errors that all rows share, in their error bars."""
    deviance: float
    """-2 log likelihood, but for a constant that is the same for all laws."""
    chi2: float
    dof: int
    covariance: Array
    """(k, k) of the free numbers; NaN where the data do not tell them."""
    by_row: Array
    """(N,) chi^2 of each row; where the spin was not measured, with the best spin, whose distance from the mean of its prior, in
    widths, counts too."""
    degenerate: tuple[str, ...] = ()
    """What the data cannot tell, in sentences."""
    untold: tuple[str, ...] = ()
    """The numbers that are concerned."""
    scatter: dict[str, float] = field(default_factory=dict)
    """Of the outputs that came without error bars."""

    @property
    def k(self) -> int:
        """Numbers that were adjusted."""
        return len(self.names) + len(self.scatter)

    @property
    def aicc(self) -> float:
        """Akaike's criterion: chi^2 + 2 k where errors are known, which needs no correction for few data; where the scatter is
        estimated, that of Hurvich & Tsai (Biometrika 76, 297 (1989)). Infinite where there are too few data."""
        n, k = self.problem.count, self.k
        if n <= k + 1:
            return math.inf
        return self.deviance + 2 * k + (2 * k * (k + 1) / (n - k - 1) if self.scatter else 0.0)

    @property
    def bic(self) -> float:
        """Schwarz's criterion."""
        return self.deviance + self.k * math.log(self.problem.count)

    def predicted(self) -> Array:
        """(N, 3): what the law says of each row; rows without spin at the middle of what it may be."""
        return predict_law(self.law, self.problem, self.numbers)


def scaled(fit: Fit, name: str, by: float) -> Fit:
    """With an error bar so many times as large, correlations as they are."""
    i, covariance = fit.names.index(name), fit.covariance.copy()
    covariance[i, :] *= by
    covariance[:, i] *= by
    wider = replace(fit.estimates[name], stderr=by * (fit.estimates[name].stderr or 0.0))
    return replace(fit, covariance=covariance, estimates=fit.estimates | {name: wider})


def parameters_of(law: FittedLaw, problem: Problem) -> tuple[dict[str, tuple[int, Parameter]], Array, int]:
    """The law's free numbers (place and bounds by name), all numbers as they start, and the form of restitution."""
    setting = problem.setting
    start = np.array([p.start for p in PARAMETERS] + [0.0] * len(problem.shared))
    for name in GIVEN:
        start[INDEX[name]] = getattr(setting, name)
    for name in ("spin_width", "spin_mean"):
        if getattr(setting, name) is not None:
            start[INDEX[name]] = getattr(setting, name)
    free: dict[str, tuple[int, Parameter]] = {}
    form = FORMS[setting.restitution] if "restitution" in law.free else FORMS["constant"]
    for name in law.free:
        if name == "restitution":
            free |= {parameter.name: (i, parameter) for i, parameter in enumerate(form.parameters)}
        else:
            free[name] = (INDEX[name], PARAMETERS[INDEX[name]])
    for name in setting.fit:
        if name in INDEX and _matters(name, law):
            free.setdefault(name, (INDEX[name], PARAMETERS[INDEX[name]]))
    if feels_spins(law, problem):
        if setting.spin_mean is None and setting.spin_prior == "normal":
            free["spin_mean"] = (INDEX["spin_mean"], PARAMETERS[INDEX["spin_mean"]])
        if setting.spin_width is None:
            free["spin_width"] = (INDEX["spin_width"], PARAMETERS[INDEX["spin_width"]])
    for name, (low, high) in setting.bounds.items():
        if name in free:
            place, parameter = free[name]
            tried = tuple(t for t in parameter.tried if low <= t <= high) or ((low + high) / 2,)
            free[name] = (place, replace(parameter, low=low, high=high, tried=tried))
    for name, value in law.pinned.items():
        start[INDEX[name]] = value
    for name, value in setting.fixed.items():
        if name in free:
            start[free.pop(name)[0]] = value
        elif name in GIVEN and name not in law.pinned:
            start[INDEX[name]] = value
    if law.upright:
        start[INDEX["contact_height"]] = 1.0
    return free, start, form.code


def feels_spins(law: FittedLaw, problem: Problem) -> bool:
    """Whether spins before the wall that nobody measured show in what was measured after it, under a law."""
    if problem.spins is None:
        return False
    frictionless = law.code == SMOOTH or law.pinned.get("friction") == 0
    return not frictionless or bool(np.isfinite(problem.y[problem.unknown, 2]).any())


def _matters(name: str, law: FittedLaw) -> bool:
    """Whether a number that was asked for plays a part in a law."""
    if name in law.pinned or (name == "contact_height" and (law.upright or law.kind == "planar")):
        return False
    if name in ("floor_friction", "floor_restitution"):
        return law.code in (TOGETHER, TURN, MAW)
    return not (name == "roll" and law.kind == "planar")


@dataclass(frozen=True, eq=False)
class Ways:
    """What the compiled loops need beside the rows."""

    law: FittedLaw
    form: int
    free: NDArray[np.int64]
    """Places of the law's free numbers, then those of the errors that all rows share."""
    low: Array
    high: Array
    moves: Array
    """(S, NUMBERS) by how much shared errors move numbers."""

    @property
    def own(self) -> Ways:
        """With shared errors where they are."""
        return replace(self, free=self.free[self.free < NUMBERS])


def ways_of(law: FittedLaw, problem: Problem) -> tuple[Ways, tuple[str, ...], Array, list[Parameter]]:
    """What the loops need, the free numbers' names, all numbers as they start, and the free ones' bounds."""
    free, start, form = parameters_of(law, problem)
    low, high = np.full(NUMBERS, -math.inf), np.full(NUMBERS, math.inf)
    for place, parameter in free.values():
        low[place], high[place] = parameter.low, parameter.high
    moves = _moves(law, problem, free)
    floor = INDEX["floor_friction"]
    least = [max(-FURTHEST, 0.01 - start[floor] / move[floor]) if move[floor] else -FURTHEST for move in moves]
    low, high = np.append(low, least), np.append(high, np.full(len(moves), FURTHEST))
    places = np.array([*(place for place, _ in free.values()), *range(NUMBERS, len(start))], dtype=np.int64)
    return Ways(law, form, places, low, high, moves), tuple(free), start, [parameter for _, parameter in free.values()]


def _moves(law: FittedLaw, problem: Problem, free: dict[str, tuple[int, Parameter]]) -> Array:
    """(S, NUMBERS): by how much shared errors move a law's numbers."""
    moves = np.zeros((len(problem.shared), NUMBERS))
    if "floor_friction" not in free and "floor_friction" not in law.pinned:
        moves[:, INDEX["floor_friction"]] = [one.floor for one in problem.shared]
    return moves


def _rows(ways: Ways, problem: Problem) -> Rows:
    """Rows and a law for the loops; a law that does not feel spins need not be asked about them."""
    x, spins = problem.x, problem.spins
    if spins is not None and not feels_spins(ways.law, problem):
        x, spins = np.nan_to_num(x), None
    return Rows(
        ways.law.kind, ways.law.code, ways.form, problem.stages, problem.setting.radius, spins, x, problem.vx, problem.y,
        problem.vy, problem.nu, ways.free, ways.low, ways.high, _moved(problem), ways.moves,
    )  # fmt: skip


def _moved(problem: Problem) -> Array:
    """(S, N, 6): by how much shared errors move the rows."""
    return np.stack([one.rows for one in problem.shared]) if problem.shared else np.empty((0, len(problem.x), 6))


def go(
    ways: Ways, problem: Problem, p: Array, most: int, weights: Array | None = None, middles: Array | None = None
) -> tuple[Array, Array, Array, Array]:
    """Down from each of p (B, K): places, deviances, scores, information."""
    return descend(_rows(ways, problem), p, most, weights, middles)


def predict_law(law: FittedLaw, problem: Problem, p: Array) -> Array:
    """What a law with numbers p says is measured of each row, (N, 3); a spin that was not measured is taken at its mean.

    The numbers may be of a fit to other rows: what those have wrong together is none of these ones' errors.
    """
    ways, shared = ways_of(law, problem)[0], p[NUMBERS : NUMBERS + len(problem.shared)]
    moved = np.tensordot(shared, _moved(problem), 1)
    p = np.append(p[:NUMBERS] + shared @ ways.moves, 0 * shared)
    x = problem.x + moved[:, :3]
    mean = np.atleast_2d(p)[:, INDEX["spin_mean"]] * x[:, 1] / problem.setting.radius
    x[:, 2] = np.where(np.isnan(x[:, 2]), mean, x[:, 2])
    return said(_rows(ways, problem), x, p) - moved[:, 3:]


def rows_of_fit(fit: Fit, problem: Problem, p: Array) -> tuple[Array, Array]:
    """Deviance and least chi^2 (N,) of each row of a problem under a law with numbers p."""
    ways = replace(ways_of(fit.law, problem)[0], free=np.empty(0, np.int64))  # without slopes
    seen = look(_rows(ways, problem), p[None])
    return seen.deviance[0], seen.least[0]


def refit(
    fit: Fit,
    problem: Problem,
    weights: Array | None = None,
    p: Array | None = None,
    *,
    hold: str = "",
    most: int = STEPS,
    middles: Array | None = None,
) -> tuple[Array, Array]:
    """Fits of the law to (weighted) rows from numbers p (B, K): numbers and deviances; ``hold`` one number where it is.
    ``most`` looks; ``middles`` (B, S) of shared errors."""
    ways, names, _start, _parameters = ways_of(fit.law, problem)
    if hold:
        ways = replace(ways, free=np.delete(ways.free, names.index(hold)))
    count = 1 if weights is None else len(weights)
    p = np.tile(fit.numbers, (count, 1)) if p is None else p
    found, deviances, _u, _h = go(ways, problem, p, most, weights, middles)
    return found, deviances
