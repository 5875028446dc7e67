"""Fit of one law to rebounds: starting points, descent, continuation beyond kinks, scatter where no error bars are given.

Error bars given with the data are used as given: the deviance is chi^2, AIC is chi^2 + 2 k. Without them, the scatter of each
measured quantity is an additional parameter of the law, and the deviance is n log(scatter^2) + n. Scatter between contacts beyond
given error bars is fitted as one more parameter on request (:mod:`carom.fitting.identify`).
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.fitting.identify import (
    Scattered,
    half_width,
    identified_covariance,
    identify,
    parameter_ranges,
    with_contact_scatter,
    with_estimated_scatter,
    with_marginal_errors,
    with_profiled_friction,
)
from carom.fitting.laws import FORMS, INDEX, NUMBERS, FittedLaw
from carom.fitting.likelihood import TabulatedLaw
from carom.fitting.model import (
    STEPS,
    TOLERANCE,
    FitModel,
    LawTable,
    coarse_table,
    feels_spins,
    fine_table,
    form_starts,
    model_of,
)
from carom.fitting.result import Estimate, Fit, refit, scaled, working_model
from carom.fitting.rows import Problem
from carom.fitting.spin_chains import EVERYWHERE, Minimum, chain_information, cross_kinks

Array = NDArray[np.float64]
FEW_STEPS, HELD_STEPS = 40, 12
SEARCH_ROWS, MARGINAL_SEARCH_ROWS = 150, 40  # rows, of many, in which starts are tried
STARTS, MARGINAL_STARTS = 8, 12  # from which the search descends
MANY_STARTS = 100  # of a grid: more are first tried with fewer rows
OWN_STARTS = 4  # from which a law descends itself whose search is that of a similar one
ANNEALED_ROWS = 120  # of many, in which the search with shrinking error bars is made
KINK_ROWS = 250  # among which, of many, frictions beyond kinks are sought
FRICTIONS = tuple(np.geomspace(0.01, 1.0, 41).tolist())  # at which it is held where it is hardly known
HARDLY_KNOWN, KINKED = 0.2, 1e-5  # error bar over the friction; rise of the deviance that a descent should still gain
SIMPLICES, MOST_SIMPLICES = (1e-2, 2.5e-3, 6e-4), 40  # of the ranges, or of 1
COMPARED = 0.02  # of the deviance: to that descents are followed whose ends are compared, or only begin others
FREED = 3  # number of held frictions that are then freed
MAX_EXCESS = 30.0  # of the deviance above the best: a start that ends higher is dropped
HEATS = (16.0, 8.0, 4.0, 2.0)  # by which error bars are multiplied, in turn, in the search with a table
WARM = 0.01  # of the speed: error bars above which the valley of the friction is wide
AROUND = (-4.0, -2.0, -1.0, 1.0, 2.0, 4.0)  # error bars of the friction, at which it is held with the fine table
BESIDE = (0.99, 0.996, 1.004, 1.01)  # of the friction: a descent that ends in a kink is as near as this
NEAR_BOUND = 0.01  # of a parameter's range
DISTINCT = 0.02  # least distance between two points regarded as different
STUDENT_NU = 4
# Of the friction; of the deviance: more is no chance; beside the range it is sought in
BEYOND, MOST_OF_EDGE, EDGE = 2.0, 50.0, 4.0


class Place(NamedTuple):
    """End point of a descent."""

    p: Array
    deviance: float
    information: Array
    score: Array = np.empty(0)


def _descend(model: FitModel, p: Array, close: float = 0.0) -> Place:
    """Descend from each of p (B, K), and return the best end point."""
    found = model.minimize(p, STEPS, close=close)
    best = int(np.argmin(found.value))
    return Place(found.p[best], float(found.value[best]), found.information[best], found.score[best])


def _descend_exactly(model: FitModel, p: Array) -> Array:
    """Return the end point (K,) of descents, continued where rounding would decide it: at a kink, or where the friction is hardly
    known. There the friction is held at other values, and a search without derivatives ends at the bottom of the kink."""
    best = _descend(model, p)
    if len(model.problem.x) > KINK_ROWS or not len(model.free):
        return best.p
    inside = (best.p[model.free] > model.low[model.free]) & (best.p[model.free] < model.high[model.free])
    covariance = np.linalg.pinv(best.information[np.ix_(inside, inside)], hermitian=True)
    promised = best.score[inside] @ covariance @ best.score[inside]
    own = model.free[inside] == INDEX["friction"]
    hardly = np.sqrt(np.diag(covariance))[own] > HARDLY_KNOWN * best.p[INDEX["friction"]]
    if promised < KINKED and not hardly.any():
        return best.p
    starts = [best.p]
    if "friction" in model.parameters:
        held = _held(model, best.p, FRICTIONS, FEW_STEPS)
        sides = np.pad(held.value, 1, constant_values=np.inf)
        valleys = np.flatnonzero((held.value <= sides[:-2]) & (held.value <= sides[2:]))
        starts += [held.p[i] for i in valleys[np.argsort(held.value[valleys], kind="stable")[:FREED]]]
    ends = [_bottom_of_kink(model, start, 1) for start in starts]
    return _bottom_of_kink(model, min(ends, key=lambda end: end[1])[0], MOST_SIMPLICES)[0]


def _held(model: FitModel, p: Array, frictions: Sequence[float] | Array, steps: int = HELD_STEPS) -> Minimum:
    """Return the end points of descents from p (K,) with the friction held at some values, within its bounds."""
    i, start = INDEX["friction"], np.tile(p, (len(frictions), 1))
    start[:, i] = np.clip(frictions, model.low[i], model.high[i])
    return model.holding("friction").minimize(start, steps, close=COMPARED if model.problem.spins is not None else 0.0)


def _freed(model: FitModel, best: Place, frictions: Sequence[float] | Array) -> Place:
    """Return the best place: with the friction held at some values and, from the best of these, freed."""
    held = _held(model, best.p, frictions)
    freed = _descend(model, held.p[np.argsort(held.value, kind="stable")[:FREED]], COMPARED)
    if freed.deviance < best.deviance + COMPARED:
        freed = _descend(model, freed.p[None])
    return freed if freed.deviance < best.deviance else best


def _bottom_of_kink(model: FitModel, p: Array, most: int) -> tuple[Array, float]:
    """Return where up to ``most`` searches by SciPy's Nelder-Mead end, with simplices of several sizes until none gains, and the
    deviance there."""
    from scipy.optimize import minimize

    free, p = model.free, p.copy()
    low, high = model.low[free], model.high[free]

    def deviance(q: Array) -> float:
        p[free] = q
        return float(model.evaluate(p[None], derivatives=False).deviance.sum())

    here, value, idle = p[free], deviance(p[free]), 0
    for turn, size in enumerate(itertools.islice(itertools.cycle(SIMPLICES), most)):
        step = size * np.minimum(high - low, 1.0) * (-1) ** turn
        step = np.where((here + step > high) | (here + step < low), -step, step)
        options = {"initial_simplex": np.vstack([here, here + np.diag(step)]), "xatol": 1e-6, "fatol": 1e-9}
        found = minimize(deviance, here, method="Nelder-Mead", bounds=np.stack([low, high], axis=-1), options=options)
        idle = 0 if found.fun < value - TOLERANCE else idle + 1
        if found.fun < value:
            here, value = found.x, float(found.fun)
        if idle == 2 * len(SIMPLICES):
            break
    p[free] = here
    return p, value


def _search(model: FitModel) -> Array:
    """Return starting points (B, K): a grid, and the results of a fit of constants where parameters depend on the impact.

    Where spins are carried along chains of contacts, the search takes them as independent, which is quick.
    """
    if model.problem.carried:
        return _search(replace(model, problem=replace(model.problem, carried=False)))
    if model.form:  # what constants reach is a start, too: a form contains them, or nearly so
        steady = model.steady()
        found = steady.minimize(_search(steady), FEW_STEPS, close=COMPARED)
        return np.vstack([_search_grid(model), model.like(found.p[np.argmin(found.value)])])
    return _search_grid(model)


def _search_grid(model: FitModel) -> Array:
    """Return starting points (B, K): the best of a grid, after a short descent with few rows."""
    problem, law = model.problem, model.law
    n, parameters = len(problem.x), model.parameters
    marginal = problem.spins is not None
    few = min(n, MARGINAL_SEARCH_ROWS if marginal else SEARCH_ROWS)
    some = model if n <= few else replace(model, problem=problem.select(np.linspace(0, n - 1, few).astype(int)))
    if law.search_code is not None and parameters:  # a similar law that is a hundred times as fast
        quick = replace(model.using(None), law=replace(law, code=law.search_code, search_code=None))
        found = quick.minimize(_search_grid(quick), FEW_STEPS, close=COMPARED)
        starts = found.p[_distinct(found.p[:, model.free], found.value, MAX_EXCESS, 2)]
        if marginal:
            return starts
        # where the similar law saturates (no restitution above 1) its best point is one that this law cannot leave
        p = _grid(model)
        found = some.minimize(p[np.argsort(some.deviances(p))[:OWN_STARTS]], FEW_STEPS)
        return np.vstack([starts, found.p[np.argmin(found.value)]])
    p = _grid(model)
    if not parameters:
        return p
    if marginal and len(p) > MANY_STARTS:  # of each friction those that suit a quarter of the rows
        rough = replace(some, problem=some.problem.select(np.arange(0, few, 4))).deviances(p)
        of_friction = p[:, INDEX["friction"]]
        p = np.concatenate(
            [p[i[np.argsort(rough[i], kind="stable")[: max(len(i) // 5, 4)]]]
             for i in (np.flatnonzero(of_friction == mu) for mu in np.unique(of_friction))]
        )  # fmt: skip
    cost = some.deviances(p)
    # the best of the grid; only one of points that the rows do not distinguish
    _cost, first = np.unique(np.round(cost, 6), return_index=True)
    if marginal and "friction" in parameters:
        # unknown spins and unknown friction have the same effect on an angle: one descent from each friction
        _friction, best = np.unique(p[first, INDEX["friction"]], return_index=True)
        first = first[np.sort(best)]
    found = some.minimize(p[first[: MARGINAL_STARTS if marginal else STARTS]], FEW_STEPS, close=COMPARED)
    return found.p[_distinct(found.p[:, model.free], found.value, MAX_EXCESS * n / few, 4 if marginal else 3)]


def _grid(model: FitModel) -> Array:
    """Return all combinations (B, K) of the values that the parameters try, and those of a restitution's form from the data."""
    tried = [one.starts for one in model.parameters.values()]
    grid = np.array(list(itertools.product(*tried)))
    problem = model.problem
    name = problem.setting.restitution if "restitution" in model.law.free else "constant"
    x = problem.x[:, 0]
    held = np.sqrt(1 - (1 - (problem.setting.contact_height or 1.0)) ** 2)  # (the normal's component along v_n)
    for start in form_starts(name, x * held, problem.y[:, 0] / x):
        values = dict(zip((one.name for one in FORMS[name].parameters), start, strict=True))
        own = [
            (min(max(values[one.name], one.low), one.high),) if one.name in values else choice
            for one, choice in zip(model.parameters.values(), tried, strict=True)
        ]
        grid = np.concatenate([grid, np.array(list(itertools.product(*own)))])
    p = np.tile(model.start, (max(len(grid), 1), 1))
    if model.parameters:
        p[:, model.without_shared().free] = grid
    return p


def _distinct(p: Array, cost: Array, excess: float, most: int) -> list[int]:
    """Return the index of the best point, and of distinct ones that are not much worse."""
    order = np.argsort(cost, kind="stable").tolist()
    chosen: list[int] = order[:1]
    for i in order[1:]:
        apart = min(float(np.abs(p[i] - p[j]).max()) for j in chosen)
        if apart > DISTINCT and cost[i] < cost[order[0]] + excess and len(chosen) < most:
            chosen.append(i)
    return chosen


def fit_law(law: FittedLaw, problem: Problem, near: Sequence[Fit] = ()) -> Fit:
    """Fit one law to rebounds by maximum likelihood.

    Parameters
    ----------
    law : FittedLaw
        One of :data:`FITTED`.
    problem : Problem
        From :func:`make_problem`.
    near : sequence of Fit
        Of laws that it contains, to the same rows: the search begins there, too.

    Returns
    -------
    Fit
        Estimates with standard errors, covariance, deviance, and parameters that are not identifiable.

    Examples
    --------
    >>> from carom.data.rebounds import make_rebounds
    >>> from carom.fitting import FITTED, Setting, fit_law, make_problem
    >>> v = [1.0, 2.0, 3.0, 4.0]
    >>> columns = {"v_n_in": v, "v_t_in": v, "spin_in": [0.0] * 4, "v_n_out": [0.81, 1.59, 2.42, 3.18], "v_t_out": v,
    ...            "sigma_v_n_out": 0.02, "sigma_v_t_out": 0.02}
    >>> problem, notes = make_problem(make_rebounds("planar", columns), Setting(radius=0.02))
    >>> fit = fit_law(FITTED[0], problem)
    >>> f"{fit.law.name}: e = {fit.estimates['restitution'].value:.3f}"
    'mirror: e = 0.799'
    """
    model = itself = model_of(law, problem)

    def search(at: FitModel) -> Array:
        return np.vstack([_search(at), *(model.near(fit.numbers) for fit in near)])

    coarse = None if problem.carried else coarse_table(model)
    model = model.using(coarse)
    if problem.estimated.any():
        found = with_estimated_scatter(model, search, _descend_exactly)
    elif problem.setting.scatter:
        found = with_contact_scatter(model, search, lambda at, p: _descend(at, p, COMPARED).p)
    else:
        found = Scattered(search(model.without_shared()), model, 0.0, {}, None)
    p, own = found.p, found.model.without_shared()
    if coarse is not None and np.median(own.problem.vy[:, 0] / np.square(problem.x[:, :2]).sum(axis=1)) < WARM**2:
        p = np.concatenate([p, _annealed(own, p)])
    best = _across_kinks(own, _descend(own, p))
    found, best = _with_scatter_near(model, found, best)  # (beyond kinks it may be another)
    model, own = found.model, found.model.without_shared()
    if problem.shared:  # there may be a kink: searched from both sides, and from a bound that is near
        z, free = np.eye(len(problem.shared)), model.free
        p = np.tile(best.p, (2 + 2 * len(z), 1))
        p[1:-1, NUMBERS:] = np.concatenate([z, -z])
        here, low, high = p[-1, free], model.low[free], model.high[free]
        close = NEAR_BOUND * (high - low)
        p[-1, free] = np.where(high - here < close, high, np.where(here - low < close, low, here))
        best = _descend(model, p)
    if problem.spins is not None and not problem.carried and "friction" in model.parameters:
        best = _freed(model, best, best.p[INDEX["friction"]] * np.array(BESIDE))
    if problem.carried and feels_spins(law, problem) and not problem.shared:
        best = best._replace(information=chain_information(own, best.p, best.information))
    table = None
    if coarse is not None:
        own = model if problem.shared else own
        best, table = _refined(own, best, coarse)
        if found.estimate is None or not found.estimate.value:
            best = _descend(own.using(None), best.p[None])
        found, best = _with_scatter_near(itself, found, best)  # (until here it is that beside the table)
        model = found.model
    return fit_at(model, best, found.scatter, found.extra, found.estimate, table)


def _with_scatter_near(model: FitModel, found: Scattered, best: Place) -> tuple[Scattered, Place]:
    """Return the scatter between contacts and the place, fitted again from there; unchanged where there is no scatter."""
    if found.estimate is None or not found.estimate.value:
        return found, best
    place, share = best.p[None], found.estimate.value
    found = with_contact_scatter(model, lambda _model: place, lambda at, p: _descend(at, p).p, share)
    return found, _descend(found.model, found.p)


def none_above(found: dict[str, Any], fit_of: Callable[[Any], Fit], again: Callable[[Any, Any], Any]) -> dict[str, Any]:
    """Return ends of searches by their law, of which none is above that of a law that it contains: else it is sought from there.

    ``again(end, inner)`` searches again from another law's end; of both ends the better one is kept.
    """
    for name in sorted(found, key=lambda name: len(fit_of(found[name]).law.free)):
        inner = [one for one in found.values() if name in fit_of(one).law.within]
        best = min(inner, key=lambda one: fit_of(one).deviance, default=None)
        if best is not None and fit_of(best).deviance < fit_of(found[name]).deviance - COMPARED:
            found[name] = min(again(found[name], best), found[name], key=lambda one: fit_of(one).deviance)
    return found


def place_near(law: FittedLaw, problem: Problem, p: Array) -> Array:
    """Return numbers (K,) where descents end, from p (K,) and from starts of a search; of a tabulated law by its coarse table."""
    model = model_of(law, problem)
    model = model.using(None if problem.carried else coarse_table(model))
    own, starts = model.without_shared(), np.vstack([_search(model.without_shared()), p])
    starts[:, NUMBERS:] = p[NUMBERS:]
    return _descend(model, _across_kinks(own, _descend(own, starts, COMPARED)).p[None], COMPARED).p


def fit_at(
    model: FitModel, best: Place, scatter: dict[str, float], extra: float, contacts: Estimate | None, table: TabulatedLaw | None,
) -> Fit:  # fmt: skip
    """Return the fit that ends at a place: estimates, their covariance, and the parameters that are not identifiable.

    ``extra``: the contribution of the scatter to the deviance; ``contacts``: the estimated scatter between contacts; ``table``: it
    stands in for the law near the place.
    """
    edge, i = best, INDEX["friction"]
    best = _beyond_edge(model.using(table), best)
    law, problem, names, own = model.law, model.problem, tuple(model.parameters), model.without_shared().using(None)
    _deviance, chi2_by_row = replace(own, free=own.free[:0]).row_deviances(best.p)
    # an error shared by all rows is an additional parameter, and its value from the film an additional datum
    chi2 = float(chi2_by_row.sum() + np.square(best.p[NUMBERS:]).sum())
    fit = Fit(
        law, problem, names, {}, best.p, best.deviance + extra, chi2, 0, np.zeros((0, 0)), chi2_by_row, scatter=scatter,
        contact_scatter=contacts, determinants=0.0 if contacts is None else extra, tabulated=table,
        edge=None if best is edge else float(edge.p[i]),
    )  # fmt: skip
    # an unmeasured spin is an additional parameter, and its prior an additional datum, unless it is uniform
    dof = problem.count - fit.k
    if problem.spins is not None and problem.spins.uniform and feels_spins(law, problem):
        dof -= int(problem.drawn.sum())
    fit = replace(fit, dof=dof)
    # Student's errors widen the error bars: their information is (nu + d)/(nu + d + 2) of the curvature
    d = np.isfinite(problem.y).sum(axis=1).mean()
    information = own_information(best.information, len(names))
    information = information * ((STUDENT_NU + d) / (STUDENT_NU + d + 2) if problem.nu else 1.0)
    if scatter:
        information = information * max(problem.count - fit.k, 1) / problem.count
    done = _identified(fit, information)
    if problem.spins is not None and "friction" in done.untold:
        done = _identified(fit, with_profiled_friction(done, information, extra))
    done = done if problem.spins is None else with_marginal_errors(done, extra)
    for name in () if best is edge else [name for name, one in done.estimates.items() if one.stderr]:
        # (the data hardly say whether a row slides: the others' error bars reach to where they are if one does)
        moved = float((edge.p - best.p)[model.places[name]])
        done = scaled(done, name, math.hypot(1.0, moved / (done.estimates[name].stderr or math.inf)))
    return done


def _beyond_edge(model: FitModel, best: Place) -> Place:
    """Return the place where no row slides, if the edge that the friction is, where spins are not measured, gains too little.

    It fits any one row better, by some 2 log(friction / error bar), although no row slides: it is sought among all rows
    (look-elsewhere effect: Gross & Vitells, Eur. Phys. J. C 70, 525 (2010)).
    """
    problem, i = model.problem, INDEX["friction"]
    if problem.spins is None or problem.carried or "friction" not in model.parameters or not best.p[i] > 0:
        return best
    base = best.deviance if model.tabulated is None else float(model.minimize(best.p[None]).value[0])
    beyond = _held(model, best.p, [BEYOND * best.p[i]], STEPS)
    gain = float(beyond.value[0]) - base
    if not 0 < gain < MOST_OF_EDGE:
        return best

    def rises(values: Array, _which: NDArray[np.int64]) -> Array:
        return _held(model, best.p, values, STEPS).value - base

    mu = float(best.p[i])
    bar, _rise = half_width(rises, mu, DISTINCT * mu, float(model.low[i]), float(model.high[i]))
    return best if gain > EDGE + 2 * math.log(mu / bar) else _descend(model, beyond.p)


def own_information(h: Array, k: int) -> Array:
    """Return the information on the law's k parameters, with the shared errors profiled out."""
    if len(h) == k:
        return h
    plain, cross = h[:k, :k], h[:k, k:]
    through = cross.T @ np.linalg.pinv(plain, hermitian=True) @ cross
    # information of the rows on a shared error, in addition to that of the film, 1; negative only because of kinks
    strength, direction = np.linalg.eigh(h[k:, k:] - through)
    left = direction @ np.diag(np.maximum(strength, 1.0)) @ direction.T
    return np.asarray(plain - cross @ np.linalg.solve(left + through, cross.T))


def _across_kinks(model: FitModel, best: Place) -> Place:
    """Continue the search with the friction held at other values, and then freed; where spins are integrated over."""
    problem = model.problem
    if (
        problem.spins is None
        or "friction" not in model.parameters
        or (problem.carried and feels_spins(model.law, problem))
    ):
        return best
    # in many rows the search is among some of them
    few = np.linspace(0, len(problem.x) - 1, min(len(problem.x), KINK_ROWS)).astype(int)
    some = model if len(few) == len(problem.x) else replace(model, problem=problem.select(few))
    found = cross_kinks(
        best if some is model else _descend(some, best.p[None]), lambda place: float(place.p[INDEX["friction"]]),
        lambda place: place.deviance, lambda place, nearby, everywhere: _freed(some, place, nearby + everywhere),
    )  # fmt: skip
    if some is model:
        return found
    freed = _descend(model, found.p[None])
    return freed if freed.deviance < best.deviance else best


def _annealed(model: FitModel, p: Array) -> Array:
    """Return places (B, K) to which the best one, and others with any friction, move as the error bars shrink to their own size.

    Small ones make the valley of the true friction narrower than the frictions that are tried are apart.
    """
    few = np.linspace(0, len(model.problem.x) - 1, min(len(model.problem.x), ANNEALED_ROWS)).astype(int)
    problem = model.problem.select(few)

    def warm(heat: float) -> FitModel:
        hot = {name: getattr(problem, name) * heat**2 for name in ("vx", "vy", "covariance")}
        return replace(model, problem=replace(problem, **hot))

    p = np.tile(_descend(warm(HEATS[0]), p, COMPARED).p, (1 + len(EVERYWHERE), 1))
    if "friction" in model.parameters:
        p[1:, INDEX["friction"]] = np.clip(EVERYWHERE, model.low[INDEX["friction"]], model.high[INDEX["friction"]])
    for heat in HEATS:
        found = warm(heat).minimize(p, HELD_STEPS, close=COMPARED)
        p = found.p
    return p[_distinct(p[:, model.free], found.value, math.inf, FREED)]


def _refined(model: FitModel, best: Place, coarse: LawTable) -> tuple[Place, LawTable]:
    """Descend with a fine table, across the kinks nearby. Return the place and the table."""
    bars = np.sqrt(np.abs(np.diag(np.linalg.pinv(best.information, hermitian=True))))
    e, mu = (float(bars[model.free == INDEX[name]].sum()) for name in ("restitution", "friction"))
    here = float(best.p[INDEX["friction"]])
    table = fine_table(coarse, (e, mu), here)
    fine = model.using(table)
    best = _descend(fine, best.p[None])
    if "friction" in model.parameters:
        best = _freed(fine, best, best.p[INDEX["friction"]] + np.array(AROUND) * mu)
    return best, table


class _Subject:
    """A fit to rebounds, for :func:`carom.fitting.identify.identify`."""

    def __init__(self, fit: Fit, information: Array) -> None:
        model = model_of(fit.law, fit.problem)
        self.fit, self.information, self.label, self.names = fit, information, fit.law.name, fit.names
        self.parameters = tuple(model.parameters.values())
        self.places = list(model.places.values())
        self.values = fit.numbers[self.places]
        self.ranges = parameter_ranges(self.parameters, self.values)
        self.trade_offs = fit.problem.spins is not None and not fit.problem.carried
        self.model = working_model(fit, fit.problem)
        self.base = float(self.model.row_deviances(fit.numbers)[0].sum())
        self.shared = float(np.square(fit.numbers[NUMBERS:]).sum())

    def covariance(self, inside: NDArray[np.int64]) -> Array:
        """Return the inverse information of some parameters."""
        return identified_covariance(self.information[np.ix_(inside, inside)], self.ranges[inside])

    def rise(self, i: int, value: float) -> float:
        """Return the deviance above its minimum with one parameter changed."""
        p = self.fit.numbers.copy()
        p[self.places[i]] = value
        return float(self.model.row_deviances(p)[0].sum()) - self.base

    def refit_rises(self, i: int, values: Array, start: Array | None = None) -> tuple[Array, Array]:
        """Return the profile above its minimum, and the parameters there."""
        p = np.tile(self.fit.numbers, (len(values), 1))
        if start is not None:
            p[:, self.places] = start
        p[:, self.places[i]] = values
        found, deviance = refit(self.fit, self.fit.problem, p=p, hold=self.names[i])
        return deviance - self.base - self.shared, found[:, self.places]


def _identified(fit: Fit, information: Array) -> Fit:
    """Return the fit with covariance, estimates, and sentences on parameters that are not identifiable."""
    return replace(fit, **vars(identify(_Subject(fit, information))))
