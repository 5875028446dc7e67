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

from carom.fitting.data import Problem
from carom.fitting.kernels import TOGETHER, TURN
from carom.fitting.laws import FittedLaw
from carom.fitting.parameters import Parameter
from carom.fitting.told import with_errors
from carom.fitting.ways import STEPS, Estimate, Fit, Ways, go, parameters_of, predict_law, refit, rows_of_fit, ways_of

__all__ = ["Estimate", "Fit", "fit_law", "parameters_of", "predict_law", "refit", "rows_of_fit"]

Array = NDArray[np.float64]
FEW_STEPS = 40
POLISHED = 4  # times
SEARCHED = 150  # rows, of many, in which starts are tried


def _search(ways: Ways, problem: Problem, start: Array, parameters: list[Parameter]) -> Array:
    """Places (B, K) from which to go down: the best of a grid, gone down a little way in few rows."""
    n = len(problem.x)
    if ways.law.code == TOGETHER and parameters:  # wall and floor in turn are near, and a hundred times as quick
        near = _search(replace(ways, law=replace(ways.law, code=TURN)), problem, start, parameters)
        return go(replace(ways, law=replace(ways.law, code=TURN)), problem, near[:1], FEW_STEPS)[0]
    some = problem if n <= SEARCHED else problem.select(np.linspace(0, n - 1, SEARCHED).astype(int))
    if len(some.nodes) > 1:
        some = some.select(np.linspace(0, len(some.x) - 1, min(len(some.x), 40)).astype(int))
    grid = np.array(list(itertools.product(*(parameter.tried for parameter in parameters))))
    p = np.tile(start, (max(len(grid), 1), 1))
    if not parameters:
        return p
    p[:, ways.free] = grid
    _p, cost, _u, _h = go(ways, some, p.copy(), 1)
    p, cost, _u, _h = go(ways, some, p[np.argsort(cost, kind="stable")[:6]], FEW_STEPS)
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
    ways, names, start, parameters = ways_of(law, problem)
    scatter: dict[str, float] = {}
    n_by = np.isfinite(problem.y).sum(axis=0)
    if problem.estimated.any():
        p, problem, extra = _with_scatter(ways, problem, start, parameters)
        where = {0: "v_n_out", 1: "v_t_out", 2: "spin_out" if law.kind == "planar" else "spin_z_out"}
        scatter = {where[int(j)]: math.sqrt(problem.vy[0, j]) for j in np.flatnonzero(problem.estimated)}
    else:
        p, extra = _search(ways, problem, start, parameters), 0.0
    p, cost, _u, h = go(ways, problem, p, STEPS)
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
    return with_errors(fit, ways, parameters, info)


def _polished(
    ways: Ways, problem: Problem, p: Array, cost: float, parameters: list[Parameter]
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
        return float(go(blind, problem, q[None], 1)[1][0]) + 1e3 * float(np.abs(x - q[ways.free]).sum())

    for _ in range(POLISHED):
        x = p[ways.free]
        simplex = np.vstack([x, x + np.diag(np.where(x + 0.04 * ranges < high, 0.04, -0.04) * ranges)])
        options = {"initial_simplex": simplex, "maxfev": 40 * len(x), "xatol": 1e-4, "fatol": 1e-3}
        found = minimize(deviance, x, method="Nelder-Mead", options=options)
        q = p.copy()
        q[ways.free] = np.clip(found.x, low, high)
        down, costs, _u, _h = go(ways, problem, q[None], STEPS)
        gained = cost - float(costs[0])
        if gained > 0:
            p, cost = down[0], float(costs[0])
        if gained < 0.5:
            break
    places, costs, _u, h = go(ways, problem, p[None], 1)
    return places, costs, h


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
