"""One law fitted to rebounds: its numbers, their error bars, and which of them the data do not tell.

Error bars that came with the data are used as given: the deviance is chi^2, AIC is chi^2 + 2 k. Where there are none, the
scatter of each measured quantity is one more number of the law, and the deviance is n log(scatter^2) + n.
"""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.errors import CaromError
from carom.fitting.data import Problem, Setting
from carom.fitting.descent import by_row, compiled, descend_many, predict_rows
from carom.fitting.kernels import SMOOTH, TOGETHER, TURN
from carom.fitting.laws import FittedLaw
from carom.fitting.parameters import FORMS, INDEX, NUMBERS, PARAMETERS, Parameter

__all__ = ["Estimate", "Fit", "fit_law", "parameters_of", "refit", "rows_of_fit"]

Array = NDArray[np.float64]
STEPS, FEW_STEPS = 200, 40
POLISHED = 4  # times
SEARCHED = 150  # rows, of many, in which starts are tried
BLIND = 0.5  # a standard error of so much of a parameter's range, or of 1, tells nothing
SHARE = 0.3  # of a direction that the data do not tell: a parameter with more of it is concerned


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
class _Ways:
    """What the compiled loops need beside the rows."""

    law: FittedLaw
    form: int
    free: NDArray[np.int64]
    low: Array
    high: Array


def _ways(law: FittedLaw, problem: Problem) -> tuple[_Ways, tuple[str, ...], Array, list[Parameter]]:
    free, start, form = parameters_of(law, problem)
    low, high = np.full(NUMBERS, -math.inf), np.full(NUMBERS, math.inf)
    for place, parameter in free.values():
        low[place], high[place] = parameter.low, parameter.high
    places = np.array([place for place, _ in free.values()], dtype=np.int64)
    return _Ways(law, form, places, low, high), tuple(free), start, [parameter for _, parameter in free.values()]


def _go(
    ways: _Ways, problem: Problem, p: Array, most: int, weights: Array | None = None
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
    out = np.empty((len(problem.x), 3))
    x = np.where(np.isnan(problem.x), 0.0, problem.x)
    form = parameters_of(law, problem)[2]
    compiled(predict_rows)(law.code, form, problem.stages, problem.setting.radius, x, np.atleast_2d(p), out)
    return out


def rows_of_fit(fit: Fit, problem: Problem, p: Array) -> tuple[Array, Array]:
    """Deviance and least chi^2 (N,) of each row of a problem under a law with numbers p."""
    ways, _names, _start, _parameters = _ways(fit.law, problem)
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
    ways, names, _start, _parameters = _ways(fit.law, problem)
    if hold:
        ways = replace(ways, free=np.delete(ways.free, names.index(hold)))
    count = 1 if weights is None else len(weights)
    p = np.tile(fit.numbers, (count, 1)) if p is None else p
    found, deviances, _u, _h = _go(ways, problem, p, STEPS, weights)
    return found, deviances


def _search(ways: _Ways, problem: Problem, start: Array, parameters: list[Parameter]) -> Array:
    """Places (B, K) from which to go down: the best of a grid, gone down a little way in few rows."""
    n = len(problem.x)
    if ways.law.code == TOGETHER and parameters:  # wall and floor in turn are near, and a hundred times as quick
        near = _search(replace(ways, law=replace(ways.law, code=TURN)), problem, start, parameters)
        return _go(replace(ways, law=replace(ways.law, code=TURN)), problem, near[:1], FEW_STEPS)[0]
    some = problem if n <= SEARCHED else problem.select(np.linspace(0, n - 1, SEARCHED).astype(int))
    if len(some.nodes) > 1:
        some = some.select(np.linspace(0, len(some.x) - 1, min(len(some.x), 40)).astype(int))
    grid = np.array(list(itertools.product(*(parameter.tried for parameter in parameters))))
    p = np.tile(start, (max(len(grid), 1), 1))
    if not parameters:
        return p
    p[:, ways.free] = grid
    _p, cost, _u, _h = _go(ways, some, p.copy(), 1)
    p, cost, _u, _h = _go(ways, some, p[np.argsort(cost, kind="stable")[:6]], FEW_STEPS)
    order = np.argsort(cost, kind="stable")
    best = [p[order[0]]]
    for i in order[1:]:  # another only if it lies elsewhere
        apart = max(float(np.abs(p[i, ways.free] - q[ways.free]).max()) for q in best)
        if apart > 0.02 and cost[i] < cost[order[0]] + 30 and len(best) < 3:
            best.append(p[i])
    return np.array(best)


def fit_law(law: FittedLaw, problem: Problem) -> Fit:
    """Fit one law.

    Raises CaromError where the law has no answer to any row.
    """
    ways, names, start, parameters = _ways(law, problem)
    scatter: dict[str, float] = {}
    n_by = np.isfinite(problem.y).sum(axis=0)
    if problem.estimated.any():
        p, problem, extra = _with_scatter(ways, problem, start, parameters)
        where = {0: "v_n_out", 1: "v_t_out", 2: "spin_out" if law.kind == "planar" else "spin_z_out"}
        scatter = {where[int(j)]: math.sqrt(problem.vy[0, j]) for j in np.flatnonzero(problem.estimated)}
    else:
        p, extra = _search(ways, problem, start, parameters), 0.0
    p, cost, _u, h = _go(ways, problem, p, STEPS)
    if problem.unknown.any() and len(names):
        p, cost, h = _polished(ways, problem, p[int(np.argmin(cost))], float(cost.min()), parameters)
    best = int(np.argmin(cost))
    k = len(names) + len(scatter)
    fit = Fit(
        law,
        problem,
        names,
        {},
        p[best],
        float(cost[best]) + extra,
        0.0,
        0,
        np.zeros((0, 0)),
        np.zeros(0),
        scatter=scatter,
    )
    _c, least = rows_of_fit(fit, problem, fit.numbers)
    dof = problem.count - k - int(problem.unknown.sum())
    # Student's errors widen the error bars: their information is (nu + d)/(nu + d + 2) of the curvature
    d = np.isfinite(problem.y).sum(axis=1).mean()
    info = h[best] * ((4 + d) / (6 + d) if problem.nu else 1.0)
    if scatter:
        info = info * max(problem.count - k, 1) / max(int(n_by[problem.estimated].sum()), 1)
    fit = replace(fit, chi2=float(least.sum()), dof=dof, by_row=least)
    return _with_errors(fit, ways, parameters, info)


def _polished(
    ways: _Ways, problem: Problem, p: Array, cost: float, parameters: list[Parameter]
) -> tuple[Array, Array, Array]:
    """Nelder and Mead's way and the steep one by turns, until neither gains.

    Averaged over a spin, the deviance has creases, where rows change between sticking and sliding; on one of them the steep
    way can end too early.
    """
    from scipy.optimize import minimize

    blind = replace(ways, free=ways.free[:0])  # the deviance without its slopes: a quarter of the work
    ranges = np.array([min(parameter.high - parameter.low, 1.0) for parameter in parameters])
    low, high = np.array([q.low for q in parameters]), np.array([q.high for q in parameters])

    def deviance(x: Array) -> float:
        q = p.copy()
        q[ways.free] = np.clip(x, low, high)
        return float(_go(blind, problem, q[None], 1)[1][0]) + 1e3 * float(np.abs(x - q[ways.free]).sum())

    for _ in range(POLISHED):
        x = p[ways.free]
        simplex = np.vstack([x, x + np.diag(np.where(x + 0.04 * ranges < high, 0.04, -0.04) * ranges)])
        options = {"initial_simplex": simplex, "maxfev": 40 * len(x), "xatol": 1e-4, "fatol": 1e-3}
        found = minimize(deviance, x, method="Nelder-Mead", options=options)
        q = p.copy()
        q[ways.free] = np.clip(found.x, low, high)
        down, costs, _u, _h = _go(ways, problem, q[None], STEPS)
        gained = cost - float(costs[0])
        if gained > 0:
            p, cost = down[0], float(costs[0])
        if gained < 0.5:
            break
    places, costs, _u, h = _go(ways, problem, p[None], 1)
    return places, costs, h


def _with_scatter(
    ways: _Ways, problem: Problem, start: Array, parameters: list[Parameter]
) -> tuple[Array, Problem, float]:
    """Numbers and scatter by turns until neither moves; the part of the deviance that is the scatter's logarithm."""
    size = (
        np.array([column[np.isfinite(column)].std() if np.isfinite(column).any() else 1.0 for column in problem.y.T])
        / 3
        + 1e-9
    )
    vy = problem.vy.copy()
    vy[:, problem.estimated] = np.square(size)[problem.estimated]
    problem = replace(problem, vy=vy)
    p = _search(ways, problem, start, parameters)
    n = np.isfinite(problem.y).sum(axis=0)
    columns = problem.estimated & (n > 0)
    for _ in range(40):
        p, cost, _u, _h = _go(ways, problem, p, STEPS)
        p = p[[int(np.argmin(cost))]]
        gap = np.nan_to_num(problem.y - predict_law(ways.law, problem, p[0]))
        new = np.square(gap).sum(axis=0) / np.maximum(n, 1)
        new = np.maximum(new, np.square(1e-9 * (size + 1)))
        old = problem.vy[0].copy()
        vy = problem.vy.copy()
        vy[:, columns] = new[columns]
        problem = replace(problem, vy=vy)
        if np.all(np.abs(new - old)[columns] < 1e-6 * old[columns]):
            break
    return p, problem, float((n[columns] * np.log(problem.vy[0, columns])).sum())


def _with_errors(fit: Fit, ways: _Ways, parameters: list[Parameter], info: Array) -> Fit:
    """Covariance, and what the data do not tell."""
    k = len(fit.names)
    values = fit.numbers[ways.free]
    ranges = np.array([min(parameter.high - parameter.low, 1.0) for parameter in parameters])
    close = 1e-9 * ranges
    bound = np.array(
        [v <= p.low + c or v >= p.high - c for v, p, c in zip(values, parameters, close, strict=True)], dtype=bool
    )
    inside = np.flatnonzero(~bound)
    covariance = np.full((k, k), np.nan)
    untold: list[str] = []
    sentences: list[str] = []
    if k:
        strength, direction, inner = _directions(info, ranges)
        bars = np.sqrt(np.diag(inner)) / ranges
        concerned = np.zeros(k, bool)
        for column in direction[:, ~(strength > 1 / BLIND**2)].T:
            # it goes along by its share, or by more than its own error bars
            which = (np.abs(column) > SHARE) | (np.abs(column) * BLIND > np.maximum(3 * bars, 1e-3))
            concerned |= which
            sentences.append(_sentence(fit, [fit.names[i] for i in np.flatnonzero(which)]))
        untold = [fit.names[i] for i in np.flatnonzero(concerned)]
        inside = inside[~concerned[inside]]
    if len(inside):
        _strength, _direction, inner = _directions(info[np.ix_(inside, inside)], ranges[inside])
        covariance[np.ix_(inside, inside)] = inner
        for i in inside.tolist():
            flat = _flat(fit, int(ways.free[i]), parameters[i], math.sqrt(covariance[i, i]))
            if flat:
                untold.append(fit.names[i])
                sentences.append(f"{fit.law.name}: {fit.names[i]}: {flat}")
                covariance[i, :] = covariance[:, i] = np.nan
    estimates = {}
    for i, (name, parameter) in enumerate(zip(fit.names, parameters, strict=True)):
        if name in untold:
            estimates[name] = Estimate(None, None, "the data do not tell it")
        elif bound[i]:
            what = "least" if values[i] <= parameter.low + close[i] else "most"
            estimates[name] = Estimate(float(values[i]), None, f"at the {what} that it may be, {values[i]:g}")
        else:
            estimates[name] = Estimate(float(values[i]), float(math.sqrt(covariance[i, i])))
    return replace(
        fit,
        covariance=covariance,
        estimates=estimates,
        degenerate=tuple(dict.fromkeys(sentences)),
        untold=tuple(untold),
    )


def _directions(info: Array, ranges: Array) -> tuple[Array, Array, Array]:
    """Information in directions of the scaled numbers, the directions, and the covariance of those that are told."""
    strength, direction = np.linalg.eigh(info * np.outer(ranges, ranges))
    told = strength > 1 / BLIND**2
    good = direction[:, told] / np.sqrt(strength[told])
    return strength, direction, good @ good.T * np.outer(ranges, ranges)


def _flat(fit: Fit, place: int, parameter: Parameter, stderr: float) -> str:
    """What to say where the deviance does not rise on one side, though the curvature at the best place says that it should.

    So it is where the last row that tells a number stands just at the edge between sticking and sliding.
    """
    base = float(rows_of_fit(fit, fit.problem, fit.numbers)[0].sum())
    for sign, word in ((1, "more"), (-1, "less")):
        p = fit.numbers.copy()
        p[place] = min(max(p[place] + sign * 5 * stderr, parameter.low), parameter.high)
        if abs(p[place] - fit.numbers[place]) > 4 * stderr and rows_of_fit(fit, fit.problem, p)[0].sum() < base + 1:
            return f"{fit.numbers[place]:.3g} or {word} is all that can be told; what lies beyond fits as well"
    return ""


def _sentence(fit: Fit, names: list[str]) -> str:
    """What there is to say of numbers that the data do not tell."""
    said = f"{fit.law.name}: {' and '.join(names)}: "
    values = {name: float(fit.numbers[parameters_of(fit.law, fit.problem)[0][name][0]]) for name in fit.names}
    if names == ["friction"]:
        return said + "no row slides all the way, so only a least friction can be told" + _least_friction(fit)
    if names in (["tangential_restitution"], ["stiffness_ratio"]):
        return said + "every row slides all the way through the contact, so nothing depends on it; film steeper hits"
    if names in (["restitution", "friction"], ["friction", "restitution"]):
        product = values["friction"] * (1 + values["restitution"])
        return said + f"sliding contacts tell only friction (1 + restitution) = {product:.4g}, not each by itself"
    if len(names) > 1:
        return (
            said
            + "the data tell only a combination of them, no single value; measure more (spin, other angles) or fix one"
        )
    return said + "nothing in these rows depends on it"


def _least_friction(fit: Fit) -> str:
    """The friction below which the law is worse by 2.7 (95 %, one side), with the rest where it is."""
    place = INDEX["friction"]
    high = float(fit.numbers[place])
    low = 0.0
    base = float(rows_of_fit(fit, fit.problem, fit.numbers)[0].sum())
    for _ in range(30):
        p = fit.numbers.copy()
        p[place] = middle = (low + high) / 2
        deviance = float(rows_of_fit(fit, fit.problem, p)[0].sum())
        low, high = (low, middle) if deviance < base + 2.706 else (middle, high)
    return f": {high:.3g} or more (95 %)"


def require_settings(setting: Setting) -> None:
    """CaromError where the setting cannot be, with all its faults."""
    faults = []
    if not 0 < setting.radius < 10:
        faults.append(f"radius: expected the ball's radius in m, above 0, got {setting.radius!r}")
    if not 0 < setting.kappa <= 1:
        faults.append(f"inertia: expected solid, hollow or kappa = I/(m a^2) above 0, up to 1, got {setting.kappa!r}")
    if setting.restitution not in FORMS:
        faults.append(f"restitution: expected one of {', '.join(FORMS)}, got {setting.restitution!r}")
    if not 1 <= setting.contact_height < 2:
        faults.append(
            f"contact_height: expected 1 (level with the centre) to 2, in radii, got {setting.contact_height!r}"
        )
    for name, value in (("floor_friction", setting.floor_friction), ("roll", setting.roll)):
        if not 0 <= value < math.inf:
            faults.append(f"{name}: expected a number of at least 0, got {value!r}")
    if not 0 <= setting.floor_restitution <= 1:
        faults.append(f"floor_restitution: expected 0 to 1, got {setting.floor_restitution!r}")
    limits = {p.name: p for p in (*PARAMETERS, *(p for form in FORMS.values() for p in form.parameters))}
    for name, value in setting.fixed.items():
        if name in limits and not limits[name].low <= value <= limits[name].high:
            faults.append(f"fix: {name}: expected {limits[name].low:g} to {limits[name].high:g}, got {value:g}")
    if setting.spin_prior not in ("uniform", "normal"):
        faults.append(f"spin_prior: expected uniform or normal, got {setting.spin_prior!r}")
    extra = ("kappa", "contact_height", "floor_friction", "roll", "spin_width")
    faults += [f"fit: expected one of {', '.join(extra)}, got {name!r}" for name in setting.fit if name not in extra]
    if faults:
        raise CaromError(*faults)


def as_numbers(value: Any) -> Any:
    """A value for JSON: no NaN, no infinity."""
    return value if value is None or math.isfinite(value) else None
