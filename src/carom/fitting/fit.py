"""One law fitted to rebounds: where to start, the way down, scatter that came without error bars.

Error bars that came with the data are used as given: the deviance is chi^2, AIC is chi^2 + 2 k. Where there are none, the
scatter of each measured quantity is one more number of the law, and the deviance is n log(scatter^2) + n.
"""

from __future__ import annotations

import itertools
import math
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from carom.fitting.averaged import with_averaged, with_profile
from carom.fitting.data import Problem
from carom.fitting.kernels import TOGETHER, TURN
from carom.fitting.laws import FittedLaw
from carom.fitting.parameters import INDEX, NUMBERS, Parameter
from carom.fitting.told import with_errors
from carom.fitting.ways import (
    STEPS,
    Estimate,
    Fit,
    Ways,
    feels_spins,
    go,
    parameters_of,
    predict_law,
    refit,
    rows_of_fit,
    ways_of,
)

__all__ = ["Estimate", "Fit", "fit_law", "parameters_of", "predict_law", "refit", "rows_of_fit"]

Array = NDArray[np.float64]
FEW_STEPS = 40
SEARCHED, SEARCHED_AVERAGED = 150, 40  # rows, of many, in which starts are tried
FEW, MANY = 8, 12  # starts from which it goes down
NEAR = (0.7, 0.82, 0.91, 0.96, 1.04, 1.1, 1.2, 1.4)  # times a friction: others to try
ALL = (0.07, 0.1, 0.14, 0.18, 0.23, 0.3, 0.4)  # and, the first time, all kinds of them
ACROSS = 4  # times at most
CLOSE = 30.0  # a start that ends so much higher has lost


def _search(ways: Ways, problem: Problem, start: Array, parameters: list[Parameter]) -> Array:
    """Places (B, K) from which to go down: the best of a grid, gone down a little way in few rows."""
    n = len(problem.x)
    if ways.law.code == TOGETHER and parameters:  # wall and floor in turn are near, and a hundred times as quick
        quick = replace(ways, law=replace(ways.law, code=TURN))
        p, cost, _u, _h = go(quick, problem, _search(quick, problem, start, parameters), FEW_STEPS)
        return p[_apart(p[:, ways.free], cost, CLOSE, 2)]
    averaged = problem.spins is not None
    few = min(n, SEARCHED_AVERAGED if averaged else SEARCHED)
    some = problem if n <= few else problem.select(np.linspace(0, n - 1, few).astype(int))
    grid = np.array(list(itertools.product(*(parameter.tried for parameter in parameters))))
    p = np.tile(start, (max(len(grid), 1), 1))
    if not parameters:
        return p
    p[:, ways.free] = grid
    _p, cost, _u, _h = go(ways, some, p.copy(), 1)
    # the best of the grid; of places that the rows cannot tell apart, one
    _cost, first = np.unique(np.round(cost, 6), return_index=True)
    if averaged and INDEX["friction"] in ways.free:
        # unknown spins and unknown friction do the same to an angle: from each friction one way down
        _friction, best = np.unique(p[first, INDEX["friction"]], return_index=True)
        first = first[np.sort(best)]
    p, cost, _u, _h = go(ways, some, p[first[: MANY if averaged else FEW]], FEW_STEPS)
    return p[_apart(p[:, ways.free], cost, CLOSE * len(problem.x) / few, 4 if averaged else 3)]


def _apart(p: Array, cost: Array, close: float, most: int) -> list[int]:
    """The best place, and others that lie elsewhere and are not much worse."""
    order = np.argsort(cost, kind="stable").tolist()
    chosen: list[int] = order[:1]
    for i in order[1:]:
        apart = min(float(np.abs(p[i] - p[j]).max()) for j in chosen)
        if apart > 0.02 and cost[i] < cost[order[0]] + close and len(chosen) < most:
            chosen.append(i)
    return chosen


def fit_law(law: FittedLaw, problem: Problem) -> Fit:
    """Fit one law.

    Raises CaromError where the law has no answer to any row.
    """
    ways, names, start, parameters = ways_of(law, problem)
    scatter: dict[str, float] = {}
    n_by = np.isfinite(problem.y).sum(axis=0)
    own = ways.own
    if problem.estimated.any():
        p, problem, extra = _with_scatter(ways, problem, start, parameters)
        where = {0: "v_n_out", 1: "v_t_out", 2: "spin_out" if law.kind == "planar" else "spin_z_out"}
        scatter = {where[int(j)]: math.sqrt(problem.vy[0, j]) for j in np.flatnonzero(problem.estimated)}
    else:
        p, extra = _search(own, problem, start, parameters), 0.0
    p, cost, _u, h = go(own, problem, p, STEPS)
    if problem.spins is not None and INDEX["friction"] in ways.free:
        p, cost, h = _across(own, problem, p, cost, h)
    best = int(np.argmin(cost))
    if problem.shared:  # a crease may be in the way: from either side too
        z = np.eye(len(problem.shared))
        p = np.tile(p[best], (1 + 2 * len(z), 1))
        p[1:, NUMBERS:] = np.concatenate([z, -z])
        p, cost, _u, h = go(ways, problem, p, STEPS)
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
    # a spin that was not measured is one more number, and its prior one more datum; a uniform prior is none
    dof = problem.count - k
    if problem.spins is not None and problem.spins.uniform and feels_spins(law, problem):
        dof -= int(problem.unknown.sum())
    # Student's errors widen the error bars: their information is (nu + d)/(nu + d + 2) of the curvature
    d = np.isfinite(problem.y).sum(axis=1).mean()
    info = _told(h[best], len(names)) * ((4 + d) / (6 + d) if problem.nu else 1.0)
    if scatter:
        info = info * max(problem.count - k, 1) / max(int(n_by[problem.estimated].sum()), 1)
    # an error that all rows share is one more number, and what the film says of it one more datum
    chi2 = float(least.sum() + np.square(fit.numbers[NUMBERS:]).sum())
    fit = replace(fit, chi2=chi2, dof=dof, by_row=least)
    told = with_errors(fit, own, parameters, info)
    if problem.spins is not None and "friction" in told.untold:
        told = with_errors(fit, own, parameters, with_profile(fit, info, extra))
    fit = told
    return fit if problem.spins is None else with_averaged(fit, extra)


def _told(h: Array, k: int) -> Array:
    """Information of the law's k numbers, whatever the errors are that all rows share."""
    if len(h) == k:
        return h
    plain, cross = h[:k, :k], h[:k, k:]
    through = cross.T @ np.linalg.pinv(plain, hermitian=True) @ cross
    # what rows say of a shared error, beside what the film says, 1: less than nothing only where creases are in the way
    strength, direction = np.linalg.eigh(h[k:, k:] - through)
    left = direction @ np.diag(np.maximum(strength, 1.0)) @ direction.T
    return plain - cross @ np.linalg.solve(left + through, cross.T)


def _across(ways: Ways, problem: Problem, p: Array, cost: Array, h: Array) -> tuple[Array, Array, Array]:
    """The best of p, or what lies beyond the creases about it: where rows change between sticking and sliding, at the wall or at
    the floor, the deviance has some, at whose bottom a way down can end. So other frictions are held, and left to go on."""
    place = INDEX["friction"]
    without = replace(ways, free=ways.free[ways.free != place])
    best = int(np.argmin(cost))
    p, cost, h = p[[best]], cost[[best]], h[[best]]
    for turn in range(ACROSS):
        frictions = np.append(p[0, place] * np.array(NEAR), ALL if turn == 0 else ())
        others = np.tile(p, (len(frictions), 1))
        others[:, place] = np.clip(frictions, ways.low[place], ways.high[place])
        others, held, _u, _h = go(without, problem, others, 12)
        found, deviances, _u, curved = go(ways, problem, others[np.argsort(held, kind="stable")[:3]], STEPS)
        first = int(np.argmin(deviances))
        gained = float(cost[0] - deviances[first])
        if gained > 0:
            p, cost, h = found[[first]], deviances[[first]], curved[[first]]
        if gained < 0.5:
            break
    return p, cost, h


def _with_scatter(
    ways: Ways, problem: Problem, start: Array, parameters: list[Parameter]
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
        p, cost, _u, _h = go(ways, problem, p, STEPS)
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
