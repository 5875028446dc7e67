"""A law and rebounds as the compiled loops take them, and what comes back: numbers, error bars, deviances."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from carom.fitting.data import Problem
from carom.fitting.descent import by_row, compiled, descend_many, predict_rows
from carom.fitting.kernels import SMOOTH, TOGETHER
from carom.fitting.laws import FittedLaw
from carom.fitting.parameters import FORMS, INDEX, NUMBERS, PARAMETERS, Parameter

__all__ = ["Estimate", "Fit", "Ways", "go", "parameters_of", "predict_law", "refit", "rows_of_fit", "ways_of"]

Array = NDArray[np.float64]
STEPS = 200


@dataclass(frozen=True)
class Estimate:
    """A number of a law."""

    value: float | None
    """None where the data do not tell it."""
    stderr: float | None
    """None where the data do not tell it, or it is at a bound."""
    note: str = ""
    interval_68: tuple[float, float] | None = None
    """By profile likelihood; an end at a bound is the bound."""
    interval_95: tuple[float, float] | None = None
    bootstrap: float | None = None
    """Standard error from rows drawn anew."""


@dataclass(frozen=True, eq=False)
class Fit:
    """A law and rebounds. ``aicc`` is infinite where there are too few measured numbers for it."""

    law: FittedLaw
    problem: Problem
    names: tuple[str, ...]
    """Of the free numbers."""
    estimates: dict[str, Estimate]
    numbers: Array
    """(K,) all numbers, in carom's order, at the best place."""
    deviance: float
    """-2 log likelihood, but for a constant that is the same for all laws."""
    chi2: float
    dof: int
    covariance: Array
    """(k, k) of the free numbers; NaN where the data do not tell them."""
    by_row: Array
    """(N,) chi^2 of each row, with the best spin where it was not measured."""
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
        """Akaike's criterion for few data (Hurvich & Tsai, Biometrika 76, 297 (1989)); chi^2 + 2 k where errors are known."""
        n = self.problem.count
        return self.deviance + 2 * self.k + 2 * self.k * (self.k + 1) / (n - self.k - 1) if n > self.k + 1 else math.inf

    @property
    def bic(self) -> float:
        """Schwarz's criterion."""
        return self.deviance + self.k * math.log(self.problem.count)

    def predicted(self) -> Array:
        """(N, 3): what the law says of each row; rows without spin at the middle of what it may be."""
        return predict_law(self.law, self.problem, self.numbers)


def parameters_of(law: FittedLaw, problem: Problem) -> tuple[dict[str, tuple[int, Parameter]], Array, int]:
    """The law's free numbers (place and bounds by name), all numbers as they start, and the form of restitution."""
    setting, unknown = problem.setting, bool(problem.unknown.any())
    start = np.array([p.start for p in PARAMETERS])
    for name in ("kappa", "contact_height", "floor_friction", "floor_restitution", "roll"):
        start[INDEX[name]] = getattr(setting, name)
    if setting.spin_width is not None:
        start[INDEX["spin_width"]] = setting.spin_width
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
    if unknown and setting.spin_width is None and law.code != SMOOTH and law.pinned.get("friction") != 0:
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
    if law.upright:
        start[INDEX["contact_height"]] = 1.0
    return free, start, form.code


def _matters(name: str, law: FittedLaw) -> bool:
    """Whether a number that was asked for plays a part in a law."""
    if name in law.pinned or (name == "contact_height" and (law.upright or law.kind == "planar")):
        return False
    if name in ("floor_friction", "floor_restitution"):
        return law.code == TOGETHER
    return not (name == "roll" and law.kind == "planar")


@dataclass(frozen=True, eq=False)
class Ways:
    """What the compiled loops need beside the rows."""

    law: FittedLaw
    form: int
    free: NDArray[np.int64]
    low: Array
    high: Array


def ways_of(law: FittedLaw, problem: Problem) -> tuple[Ways, tuple[str, ...], Array, list[Parameter]]:
    """What the loops need, the free numbers' names, all numbers as they start, and the free ones' bounds."""
    free, start, form = parameters_of(law, problem)
    low, high = np.full(NUMBERS, -math.inf), np.full(NUMBERS, math.inf)
    for place, parameter in free.values():
        low[place], high[place] = parameter.low, parameter.high
    places = np.array([place for place, _ in free.values()], dtype=np.int64)
    return Ways(law, form, places, low, high), tuple(free), start, [parameter for _, parameter in free.values()]


def go(
    ways: Ways, problem: Problem, p: Array, most: int, weights: Array | None = None
) -> tuple[Array, Array, Array, Array]:
    """Down from each of p (B, K): places, deviances, scores, information."""
    p = np.array(p, dtype=float)
    k = len(ways.free)
    u, h, out = np.zeros((len(p), k)), np.zeros((len(p), k, k)), np.zeros(len(p))
    weights = np.ones((1, len(problem.x))) if weights is None else weights
    compiled(descend_many)(
        ways.law.code, ways.form, problem.stages, problem.setting.radius, problem.nodes,
        problem.x, problem.vx, problem.y, problem.vy, problem.nu, weights, p, ways.free, ways.low, ways.high, u, h, out, most,
    )  # fmt: skip
    return p, out, u, h


def predict_law(law: FittedLaw, problem: Problem, p: Array) -> Array:
    """What a law with numbers p says of each row, (N, 3); a spin that was not measured is taken as none."""
    out = np.empty((len(problem.x), 3))
    x = np.where(np.isnan(problem.x), 0.0, problem.x)
    form = parameters_of(law, problem)[2]
    compiled(predict_rows)(law.code, form, problem.stages, problem.setting.radius, x, np.atleast_2d(p), out)
    return out


def rows_of_fit(fit: Fit, problem: Problem, p: Array) -> tuple[Array, Array]:
    """Deviance and least chi^2 (N,) of each row of a problem under a law with numbers p."""
    ways, _names, _start, _parameters = ways_of(fit.law, problem)
    n, k = len(problem.x), len(ways.free)
    u, h, c, best = np.zeros((n, k)), np.zeros((n, k, k)), np.zeros(n), np.zeros(n)
    compiled(by_row)(
        ways.law.code, ways.form, problem.stages, problem.setting.radius, problem.nodes,
        problem.x, problem.vx, problem.y, problem.vy, problem.nu, p.copy(), ways.free, ways.low, ways.high, u, h, c, best,
    )  # fmt: skip
    return c, best


def refit(
    fit: Fit, problem: Problem, weights: Array | None = None, p: Array | None = None, *, hold: str = ""
) -> tuple[Array, Array]:
    """Fits of the law to (weighted) rows from numbers p (B, K): numbers and deviances; ``hold`` one number where it is."""
    ways, names, _start, _parameters = ways_of(fit.law, problem)
    if hold:
        ways = replace(ways, free=np.delete(ways.free, names.index(hold)))
    count = 1 if weights is None else len(weights)
    p = np.tile(fit.numbers, (count, 1)) if p is None else p
    found, deviances, _u, _h = go(ways, problem, p, STEPS, weights)
    return found, deviances
