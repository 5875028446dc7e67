"""Spins that were not measured, carried from one contact of a ball to its next: the likelihood along chains of contacts.

Between walls nothing changes the spin of a disc that slides without friction, or of a ball in flight, so the spin before a contact
is that after the one before. The spin before the first has a prior, a sum of C narrow normal components; each of them follows the
chain as in an extended Kalman filter (Alspach & Sorenson, IEEE Trans. Autom. Control 17, 439 (1972)). Its derivatives J are
differences over an error bar to both sides, so that the deviance has no steps where a contact changes from sliding to sticking; and
the components are narrow beside what a measurement says of a spin, so that it has no ripples. With the law f, inputs x that
have variances V, the component's spin among them, and r = y - f,

    S = var(y) + J V J' - J C - C' J',   c = r' S^-1 r,

the component's weight is multiplied by exp(-c/2) (det S)^(-1/2), and the spin after the contact is normal with mean and variance as
the measurement leaves them. The row's deviance is -2 log of the sum of the weights, given all rows before it in its chain.

As in :mod:`carom.fitting.spins` the factor of det S is only for a spin that is not known: its normal part is divided out,
and as far as all components predict the same, so is the rest, which would bias the estimates.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from carom.data.rebounds import Rebounds
from carom.data.table_cells import parse_numbers
from carom.fitting.deviance import RELATIVE_STEP, SPIN_MEAN, SPIN_WIDTH
from carom.fitting.laws import NUMBERS
from carom.fitting.likelihood import SHARED_STEP, Evaluation, predictions

Array = NDArray[np.float64]
Indices = NDArray[np.int64]
Evaluate = Callable[[Indices, Array, bool], tuple[Array, Array, Array]]
Best = TypeVar("Best")
MAX_FAILURES = 12  # successive steps without a decrease
NEARBY = (0.7, 0.82, 0.9, 0.94, 0.96, 0.98, 1.02, 1.04, 1.06, 1.1, 1.2, 1.4)  # multiples of a friction, to be held
EVERYWHERE = (0.07, 0.1, 0.14, 0.18, 0.23, 0.3, 0.4)  # frictions
ROUNDS = 4
WITHIN, LEAST_PART = 0.3, 0.05  # error bars of a difference of scores; the least part of the information that is kept
TINY = 1e-12


@dataclass(frozen=True, eq=False)
class Minimum:
    """End points of B problems."""

    p: Array
    """(B, k)"""
    value: Array
    """(B,)"""
    score: Array
    """(B, k) -1/2 of the gradient."""
    information: Array
    """(B, k, k) 1/2 of the curvature."""


def minimize(
    evaluate: Evaluate, start: Array, low: Array, high: Array, *, steps: int, tolerance: float, dof: Array | None = None,
    joint: bool = True, most: float = np.inf,
) -> Minimum:  # fmt: skip
    """Minimise B functions of k numbers within bounds, from ``start`` (B, k).

    ``evaluate(which, p, derivatives)`` returns values, scores and information of some problems; without derivatives the last two
    are not used. ``joint``: derivatives cost little more than values, and are evaluated with them unless the last step failed; else
    only if a step succeeded. A problem ends when a step gains less than ``tolerance``, or than that fraction of its value per
    degree of freedom (``dof``) if the fit is poor. ``steps``: evaluations; 1: only the values at the start. ``most``: the largest
    change of a number in a step.
    """
    p = np.array(start, dtype=float)
    count, k = p.shape
    tried, alive = p.copy(), np.arange(count)
    now, gained = np.full(count, np.inf), np.full(count, np.inf)
    damping, failures = np.full(count, 1e-3), np.zeros(count, int)
    u, h = np.zeros((count, k)), np.zeros((count, k, k))

    def enough(which: Indices) -> Array | float:
        return tolerance if dof is None else tolerance * np.maximum(1.0, now[which] / dof[which])

    for _ in range(steps):
        # after a failed step the next one may fail as well: only values are evaluated until one succeeds
        wary = alive[(failures[alive] > 0) | (not joint)]
        worth = alive[(failures[alive] == 0) & joint]
        if len(wary):
            worth = np.sort(np.append(worth, wary[evaluate(wary, tried[wary], False)[0] < now[wary]]))
        down = worth
        if len(worth):
            then, score, information = evaluate(worth, tried[worth], True)
            better = then < now[worth]
            down = worth[better]
            gained[down], now[down], failures[down] = now[down] - then[better], then[better], 0
            p[down], u[down], h[down] = tried[down], score[better], information[better]
            damping[down] = np.maximum(damping[down] / 10, 1e-9)
        gained_nothing = np.ones(count, bool)
        gained_nothing[down] = False
        up = alive[gained_nothing[alive]]
        failures[up] += 1
        damping[up] = np.maximum(damping[up] * 8, 1e-4)
        alive = alive[(gained[alive] >= enough(alive)) & (failures[alive] <= MAX_FAILURES) & np.isfinite(now[alive])]
        if not len(alive) or k == 0:
            break
        here = p[alive]
        step, damping[alive] = bounded_step(
            h[alive], u[alive], np.maximum(low - here, -most), np.minimum(high - here, most), damping[alive]
        )
        tried[alive] = np.clip(here + step, low, high)
        promise = ((tried[alive] - here) * u[alive]).sum(axis=1)
        alive = alive[promise > enough(alive)]
        if not len(alive):
            break
    return Minimum(p, now, u, h)


def bounded_step(h: Array, u: Array, low: Array, high: Array, damping: Array) -> tuple[Array, Array]:
    """Return the step (B, k) between ``low`` and ``high`` (B, k) with the least s (h + damping diag h) s / 2 - u s, and a damping
    that is enough to make the matrices positive definite.

    Numbers are held at their bounds until none is beyond them and none would gain by leaving. All that have to change do so at
    once; where that goes in circles, one after the other, which ends (block principal pivoting: Judice & Pires, Comput. Oper.
    Res. 21, 587 (1994), https://doi.org/10.1016/0305-0548(94)90106-6).
    """
    k = u.shape[1]
    diagonal, damping, eye = np.abs(np.einsum("bjj->bj", h)), damping.copy(), np.eye(k)
    step = np.clip(np.zeros_like(u), low, high)
    held = ((step <= low) & (u < 0)) | ((step >= high) & (u > 0))
    for turn in range(10 * k):
        free = ~held
        rest = np.where(free, u - np.einsum("bjm,bm->bj", h, np.where(held, step, 0.0)), 0.0)
        plain = np.where(free[:, :, None] & free[:, None, :], h, 0.0)
        for _ in range(40):
            matrix = plain + np.where(free, damping[:, None] * diagonal + 1e-9, 1.0)[:, :, None] * eye
            strength, direction = np.linalg.eigh(matrix)
            bad = ~(strength.min(axis=1) > 0)
            if not bad.any():
                break
            damping[bad] = np.maximum(10 * damping[bad], 1e-3)
        along = np.einsum("bjm,bj->bm", direction, rest) / np.where(strength > 0, strength, np.inf)
        step = np.where(held, step, np.einsum("bjm,bm->bj", direction, along))
        slope = u - np.einsum("bjm,bm->bj", h, step) - (damping[:, None] * diagonal + 1e-9) * step
        down, up = (held & (slope < 0)) | (step < low), (held & (slope > 0)) | (step > high)
        step = np.clip(step, low, high)
        now = (down & (step <= low)) | (up & (step >= high))
        change = now != held
        if not change.any():
            break
        if turn >= k:
            change &= np.cumsum(change[:, ::-1], axis=1)[:, ::-1] == 1
        held ^= change
    return step, damping


def observed_information(
    scores: Callable[[Array], Array], at: Array, complete: Array, most: Array, low: Array, high: Array
) -> Array:
    """Return the information (k, k) at a place (k,), from differences of the scores over a third of an error bar to both sides.

    Kinks of single rows average out over that. ``scores``: (B, k) of places (B, k); ``complete``: the information (k, k) by which
    error bars are judged, a part of which is kept in directions in which the differences have less; ``most``: the largest steps.
    """
    scale = np.sqrt(np.maximum(np.diag(complete), TINY))
    step = np.diag(np.minimum(WITHIN / scale, most))
    up, down = (np.clip(at + sign * step, low, high) for sign in (1, -1))
    less, more = np.split(scores(np.concatenate([up, down])), 2)
    h = (more - less) / np.maximum((up - down).diagonal(), TINY)[:, None]
    strength, direction = np.linalg.eigh((h + h.T) / 2 / np.outer(scale, scale))
    return np.asarray((direction * np.maximum(strength, LEAST_PART)) @ direction.T * np.outer(scale, scale))


def cross_kinks(
    best: Best, friction: Callable[[Best], float], deviance: Callable[[Best], float],
    explore: Callable[[Best, list[float], list[float]], Best], astray: Callable[[Best], bool] = lambda _best: False,
    chi2: Callable[[Best], float] | None = None,
) -> Best:  # fmt: skip
    """Continue a search beyond kinks of the deviance, where contacts change between sliding and sticking.

    A descent can end at the bottom of one. So the friction is held at other values, near ones and, first and for a fit that is
    ``astray``, widely spread ones, while all else is fitted, and the most promising are freed (``explore``), until there is no
    further gain. ``chi2``: what the gain is measured by, where the deviance contains the logarithms of scatters.
    """
    for turn in range(ROUNDS):
        here = friction(best)
        found = explore(best, [share * here for share in NEARBY], list(EVERYWHERE) if turn == 0 or astray(best) else [])
        gained = deviance(best) - deviance(found)
        best = found if gained > 0 else best
        if gained < max(0.5, 1e-3 * abs((chi2 or deviance)(best))):
            break
    return best


OF_BALL = ("film", "shot", "drop", "ball")
COMPONENTS, REACH, NARROW = 101, 3.2, 0.064  # of the prior: number, ends of the centres and own width, in its widths
LEAST = 1e-300  # weight of a component that has none left
LEAST_SPIN, LEAST_VARIANCE = 1e-6, 1e-12  # of v/a, for a derivative at a known spin; of a spin, (rad/s)^2
STEP = 1e-4  # of a speed before the wall, for its derivative where it has a smaller error bar


def chains_of(rebounds: Rebounds) -> NDArray[np.int64]:
    """Return the rows (M, L) of chains of contacts that follow each other, in order; -1: the chain is shorter.

    A contact follows another of the same ball, drop, shot and film if its number in the column ``bounce`` (else ``contact``) is the
    next.
    """
    n, name = len(rebounds), next((one for one in ("bounce", "contact") if one in rebounds.extra), None)
    if name is None:
        return np.arange(n)[:, None]
    number = parse_numbers([str(cell) for cell in rebounds.extra[name].tolist()]).values
    labels = [rebounds.extra[one].astype(str).tolist() for one in OF_BALL if one in rebounds.extra]
    key = list(zip(*labels, strict=True)) if labels else [()] * n
    order = sorted(range(n), key=lambda i: (key[i], number[i]))
    chains: list[list[int]] = []
    for i in order:
        last = chains[-1][-1] if chains else -1
        if chains and key[i] == key[last] and number[i] == number[last] + 1:
            chains[-1].append(i)
        else:
            chains.append([i])
    found = np.full((len(chains), max(map(len, chains))), -1)
    for one, rows in zip(found, chains, strict=True):
        one[: len(rows)] = rows
    return found


class _Spins(NamedTuple):
    """Components of the spins of chains: weights, means and variances (Q, M, C)."""

    weight: Array
    mean: Array
    variance: Array


class _Seen(NamedTuple):
    """Rows at Q sets of numbers."""

    deviance: Array
    """(Q, N)"""
    chi2: Array
    mean: Array
    """(Q, N, 3) of what the components predict, 0 where nothing was measured; and its covariance."""
    covariance: Array


def evaluate_chains(model: Any, p: Array, weights: Array | None, derivatives: bool) -> Evaluation:
    """Evaluate the likelihood of a FitModel at B sets of numbers p (B, K), with weights (B or 1, N) of the rows.

    Derivatives are differences. The information is that of normal distributions with mean and covariance of all components.
    """
    free = model.free if derivatives else model.free[:0]
    here, low, high = p[:, free], model.low[free], model.high[free]
    step = RELATIVE_STEP * np.maximum(np.minimum(high - low, 1.0), np.abs(here) / 10)
    step = np.where(free >= NUMBERS, SHARED_STEP, step)
    step = np.where((here >= 0) & (here + step <= high) | (here - step < low), step, -step)
    every = np.repeat(p[:, None], 1 + len(free), axis=1)
    every[:, np.arange(1, 1 + len(free)), free] += step
    seen = _filtered(model, every.reshape(-1, p.shape[1]))
    deviance, chi2, mean, covariance = (one.reshape(len(p), 1 + len(free), *one.shape[1:]) for one in seen)
    w = np.broadcast_to(1.0 if weights is None else weights, deviance[:, 0].shape)
    slope, g, s = (
        (one[:, 1:] - one[:, :1]) / step.reshape(*step.shape, *(1,) * (one.ndim - 2))
        for one in (deviance, mean, covariance)
    )
    precision = np.linalg.inv(covariance[:, 0])
    s = precision[:, None] @ s
    information = np.einsum("bkni,bnij,blnj,bn->bkl", g, precision, g, w, optimize=True)
    information += 0.5 * np.einsum("bknij,blnji,bn->bkl", s, s, w, optimize=True)
    return Evaluation(deviance[:, 0], chi2[:, 0], -0.5 * np.einsum("bkn,bn->bk", slope, w), information)


def _filtered(model: Any, p: Array) -> _Seen:
    """Return the rows' deviances at p (Q, K), each given the rows before it in its chain."""
    problem, q, n = model.problem, len(p), len(model.problem.x)
    shared, chains, moved = p[:, NUMBERS:], problem.chains, np.zeros((1, n, 6))
    if shared.shape[1]:
        moved = np.tensordot(shared, np.stack([one.rows for one in problem.shared]), 1)
    numbers = p[:, :NUMBERS] + shared @ model.moves
    x, y = problem.x + moved[:, :, :3], problem.y + moved[:, :, 3:]
    x, y = (np.broadcast_to(one, (q, n, 3)) for one in (x, y))
    out = _Seen(np.zeros((q, n)), np.zeros((q, n)), np.zeros((q, n, 3)), np.tile(np.eye(3), (q, n, 1, 1)))
    spins = _prior(model, numbers, x[:, chains[:, 0]])
    for column in range(chains.shape[1]):
        some = chains[:, column] >= 0
        chains, spins = chains[some], _Spins(*(one[:, some] for one in spins))
        rows = chains[:, column]
        known = np.isfinite(problem.x[rows, 2])[None, :, None]
        if known.any():  # (measured, or given for a first contact)
            given = (one[None, :, None] for one in (x[0, rows, 2], problem.vx[rows, 2]))
            spins = _Spins(
                spins.weight, *(np.where(known, one, two) for one, two in zip(given, spins[1:], strict=True))
            )
        spins = _after(model, numbers, rows, x[:, rows], y[:, rows], spins, out)
    return out


def _prior(model: Any, numbers: Array, x: Array) -> _Spins:
    """Return the spins before the first contacts, at x (Q, M, 3)."""
    unit = np.hypot(x[..., 0], x[..., 1]) / model.problem.setting.radius
    mean = numbers[:, SPIN_MEAN, None] * x[..., 1] / model.problem.setting.radius
    width = (numbers[:, SPIN_WIDTH, None] * unit)[..., None]
    if model.problem.spins is not None and model.problem.spins.uniform:
        z = (2 * np.arange(COMPONENTS) + 1) / COMPONENTS - 1
        weight, narrow = np.full(COMPONENTS, 1 / COMPONENTS), 1 / COMPONENTS
    else:
        z, narrow = np.linspace(-REACH, REACH, COMPONENTS), NARROW
        weight = np.exp(-0.5 * z**2 / (1 - narrow**2))
    weight = np.broadcast_to(weight / weight.sum(), (*unit.shape, COMPONENTS))
    return _Spins(weight, mean[..., None] + z * width, np.square(narrow * width) + 0 * z)


def _linear(model: Any, numbers: Array, x: Array, v_x: Array, spins: _Spins) -> tuple[Array, Array]:
    """Return the law's predictions (Q, M, C, 3) at x (Q, M, 3) with the spins' means, and their derivatives (Q, M, C, 3, 3)."""
    tried = np.empty((7, *spins.mean.shape, 3))
    tried[..., :2], tried[..., 2] = x[:, :, None, :2], spins.mean
    speed = np.hypot(x[..., 0], x[..., 1])[..., None]
    bars = (
        *(np.maximum(np.sqrt(v), STEP * speed[..., 0])[..., None] for v in v_x[:, :2].T),
        np.sqrt(spins.variance) + LEAST_SPIN * speed / model.problem.setting.radius,
    )
    for i, bar in enumerate(bars):
        tried[1 + 2 * i, ..., i] += bar
        tried[2 + 2 * i, ..., i] -= bar
    p = np.broadcast_to(numbers[None, :, None, None], (*tried.shape[:-1], numbers.shape[1])).reshape(
        -1, numbers.shape[1]
    )
    data = model.likelihood(False).rows._replace(stages=np.zeros(len(p), np.int64), spins=None)
    f = predictions(model.law.kind, data, tried.reshape(-1, 3), p).reshape(tried.shape)
    steps = [(f[1 + 2 * i] - f[2 + 2 * i]) / (2 * bar[..., None]) for i, bar in enumerate(bars)]
    return f[0], np.stack(steps, axis=-1)


def _after(model: Any, numbers: Array, rows: Any, x: Array, y: Array, spins: _Spins, out: _Seen) -> _Spins:
    """Write what a contact of each chain, at x (Q, M, 3), says of the numbers into ``out``, and return the spins after it."""
    problem = model.problem
    v_x, v_y, (n, t) = problem.vx[rows] * (1, 1, 0), problem.vy[rows], problem.covariance[rows].T
    here, jacobian = _linear(model, numbers, x, v_x, spins)
    cross = np.zeros((len(rows), 3, 3))
    cross[:, 0, 0], cross[:, 1, 1] = n, t
    both = jacobian @ cross[:, None]
    # S with the spin as if it were known, and with its variance
    known = (jacobian * v_x[:, None, None]) @ np.swapaxes(jacobian, -1, -2) - both - np.swapaxes(both, -1, -2)
    slope = jacobian[..., 2]
    whole = known + slope[..., :, None] * slope[..., None, :] * spins.variance[..., None, None]
    seen = np.isfinite(y[0])
    pair = (seen[:, :, None] & seen[:, None, :])[:, None]
    bars = np.einsum("mi,ij->mij", v_y, np.eye(3))[:, None]
    s0, s = (np.where(pair, one + bars, np.eye(3)) for one in (known, whole))
    r, inverse = np.where(seen[:, None], y[:, :, None] - here, 0.0), np.linalg.inv(s)
    chi2 = np.einsum("qmci,qmcij,qmcj->qmc", r, inverse, r)
    rho = (problem.nu + seen.sum(axis=1)[:, None]) * np.log1p(chi2 / problem.nu) if problem.nu else chi2
    mean = np.einsum("qmc,qmci->qmi", spins.weight, here)
    off = here - mean[:, :, None]
    spread = np.einsum("qmc,qmci,qmcj->qmij", spins.weight, off, off) + np.einsum("qmc,qmcij->qmij", spins.weight, s)
    spread = np.where(pair[:, 0], spread, np.eye(3))
    # the part of det S beyond the normal one, in error bars, and how much of its scatter is that of the spins
    bar = np.log(np.where(seen, v_y + v_x, 1.0)[:, 1:].prod(axis=1))[:, None]
    tail0, tail, total = (
        np.log(np.linalg.det(one) / one[..., 0, 0]) - bar for one in (s0, s, np.expand_dims(spread, 2))
    )
    unknown = 1 - np.exp(np.minimum(tail0 - total, 0.0))
    share = np.maximum(spins.weight, LEAST)
    logs = np.log(share) - 0.5 * (rho + tail - (1 - unknown) * tail0)
    top = logs.max(axis=2, keepdims=True)
    likely = np.exp(logs - top)
    out.deviance[:, rows] = -2 * (top[..., 0] + np.log(likely.sum(axis=2)))
    out.chi2[:, rows] = (chi2 - 2 * np.log(share / share.max(axis=2, keepdims=True))).min(axis=2)
    out.mean[:, rows], out.covariance[:, rows] = np.where(seen, mean, 0.0), spread
    # (the spin after the contact has the errors before it, and what was measured after it corrects these)
    together = np.where(seen[:, None], whole[..., 2, :], 0.0)
    gain = np.einsum("qmci,qmcij->qmcj", together, inverse)
    variance = np.maximum(whole[..., 2, 2] - (gain * together).sum(axis=-1), LEAST_VARIANCE)
    return _Spins(likely / likely.sum(axis=2, keepdims=True), here[..., 2] + (gain * r).sum(axis=-1), variance)


def chain_information(model: Any, p: Array, complete: Array) -> Array:
    """Return the information (k, k) at p (K,) from differences of the scores; ``complete``: of :func:`evaluate_chains`."""
    free = model.free
    low, high = model.low[free], model.high[free]

    def scores(at: Array) -> Array:
        every = np.tile(p, (len(at), 1))
        every[:, free] = at
        return evaluate_chains(model, every, None, True).scores

    return observed_information(scores, p[free], complete, np.minimum(high - low, 1.0) / 20, low, high)
