"""The way down: Levenberg and Marquardt's, within bounds, compiled; many fits of the same rows at once.

lmfit's way down takes some 5 ms a fit to set out, and a bootstrap is a thousand fits; and the deviance of a row whose spin
nobody measured is no sum of squares. So this one is carom's own; tests hold it against lmfit's.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Callable
from typing import Any

import numpy as np

from carom.fitting.kernels import rebound
from carom.fitting.terms import ROOM, STEP, row_terms
from carom.kernel import kernel

__all__ = ["by_row", "compiled", "descend_many", "predict_rows"]

ENOUGH = 1e-7  # of the deviance: a step that promises less is none
MOST_FAILS = 12  # steps in a row that lead up

prange: Any = range


@kernel
def set_steps(p: Any, free: Any, low: Any, high: Any, steps: Any) -> None:
    """The step of each parameter's derivative, of its own size, inwards where its upper bound is near."""
    for m in range(free.shape[0]):
        j = free[m]
        size = STEP * max(min(high[j] - low[j], 1.0), abs(p[j]) / 10)
        steps[j] = size if p[j] + size <= high[j] else -size


@kernel
def _total(
    code: int, form: int, stages: Any, a: float, nodes: Any,
    x: Any, vx: Any, y: Any, vy: Any, nu: float, weights: Any, p: Any, free: Any, low: Any, high: Any,
    steps: Any, u: Any, h: Any, ui: Any, hi: Any, room: Any,
) -> float:  # fmt: skip
    """The deviance of all rows, weighted, their scores in u and information in h."""
    k = free.shape[0]
    set_steps(p, free, low, high, steps)
    u[:] = 0
    h[:] = 0
    total = 0 * a
    for i in range(x.shape[0]):
        weight = weights[i]
        if weight == 0:
            continue
        c, _best = row_terms(code, form, stages, i, a, nodes, x, vx, y, vy, nu, p, free, steps, ui, hi, room)
        total += weight * c
        for j in range(k):
            u[j] += weight * ui[j]
            for m in range(k):
                h[j, m] += weight * hi[j, m]
    return total


@kernel
def _solve(h: Any, u: Any, active: Any, damp: float, delta: Any, work: Any) -> bool:
    """delta = (h + damp diag h)^-1 u over the active ones, by Cholesky; False where that is not positive."""
    k = u.shape[0]
    for j in range(k):
        for m in range(j + 1):
            t = h[j, m] if active[j] > 0 and active[m] > 0 else 0.0
            if j == m:
                t = t + damp * abs(t) + 1e-9 if active[j] > 0 else 1.0
            for n in range(m):
                t -= work[j, n] * work[m, n]
            if j == m:
                if not t > 0:
                    return False
                work[j, j] = math.sqrt(t)
            else:
                work[j, m] = t / work[m, m]
    for j in range(k):
        t = u[j] if active[j] > 0 else 0.0
        for n in range(j):
            t -= work[j, n] * delta[n]
        delta[j] = t / work[j, j]
    for j in range(k - 1, -1, -1):
        t = delta[j]
        for n in range(j + 1, k):
            t -= work[n, j] * delta[n]
        delta[j] = t / work[j, j]
    return True


@kernel
def _descend(
    code: int, form: int, stages: Any, a: float, nodes: Any,
    x: Any, vx: Any, y: Any, vy: Any, nu: float, weights: Any, p: Any, free: Any, low: Any, high: Any,
    u: Any, h: Any, steps: Any, tried: Any, ui: Any, active: Any, delta: Any, us: Any, hs: Any, hi: Any, work: Any,
    room: Any, most: int,
) -> float:  # fmt: skip
    """From p, in place; the deviance there, with u and h as of it."""
    k = free.shape[0]
    damp, now, gained, fails = 1e-3, math.inf, math.inf, 0
    for j in range(p.shape[0]):
        tried[j] = p[j]
    for _ in range(most):
        then = _total(
            code, form, stages, a, nodes, x, vx, y, vy, nu, weights, tried, free, low, high, steps, us, hs, ui, hi, room
        )
        if then < now:
            gained, now, fails = now - then, then, 0
            for j in range(p.shape[0]):
                p[j] = tried[j]
            for m in range(k):
                u[m] = us[m]
                for n in range(k):
                    h[m, n] = hs[m, n]
            damp = max(damp / 10, 1e-9)
        else:
            fails += 1
            damp = max(damp * 8, 1e-4)
        if gained < ENOUGH or fails > MOST_FAILS:
            break
        for m in range(k):
            j = free[m]
            stuck = (p[j] <= low[j] and u[m] < 0) or (p[j] >= high[j] and u[m] > 0)
            active[m] = 0.0 if stuck else 1.0
        while not _solve(h, u, active, damp, delta, work):
            damp = max(10 * damp, 1e-3)
        promise = 0.0
        for m in range(k):
            j = free[m]
            tried[j] = min(max(p[j] + delta[m], low[j]), high[j])
            promise += (tried[j] - p[j]) * u[m]
        if not promise > ENOUGH:
            break
    return now


def descend_many(
    code: int, form: int, stages: Any, a: float, nodes: Any, x: Any, vx: Any, y: Any, vy: Any, nu: float,
    weights: Any, p: Any, free: Any, low: Any, high: Any, u: Any, h: Any, out: Any, most: int,
) -> None:  # fmt: skip
    """Fits of the same rows from p (B, K), in place: weights (B or 1, N); u (B, k) and h (B, k, k) at the end, out (B,)."""
    one, k = min(weights.shape[0] - 1, 1), free.shape[0]
    for b in prange(p.shape[0]):
        w = max(k, 3)
        steps, tried, ui, active, delta, us = np.zeros((6, max(p.shape[1], w)))
        hs, hi, work = np.zeros((3, w, w))
        out[b] = _descend(
            code, form, stages, a, nodes, x, vx, y, vy, nu, weights[b * one], p[b], free, low, high, u[b], h[b],
            steps, tried, ui, active, delta, us, hs, hi, work, np.zeros((ROOM, w, w)), most,
        )  # fmt: skip


def by_row(
    code: int, form: int, stages: Any, a: float, nodes: Any, x: Any, vx: Any, y: Any, vy: Any, nu: float,
    p: Any, free: Any, low: Any, high: Any, u: Any, h: Any, c: Any, best: Any,
) -> None:  # fmt: skip
    """Each row's deviance (N,) and least c (N,), scores (N, k) and information (N, k, k)."""
    for i in prange(x.shape[0]):
        w = max(free.shape[0], 3)
        pi, steps = p.copy(), np.zeros(p.shape[0])
        set_steps(pi, free, low, high, steps)
        c[i], best[i] = row_terms(
            code, form, stages, i, a, nodes, x, vx, y, vy, nu, pi, free, steps, u[i], h[i], np.zeros((ROOM, w, w))
        )


def predict_rows(code: int, form: int, stages: Any, a: float, x: Any, p: Any, out: Any) -> None:
    """What the law says of each row: x (N, 3), p (N or 1, K), out (N, 3)."""
    one = min(p.shape[0] - 1, 1)
    for i in prange(x.shape[0]):
        f = rebound(code, form, stages, i, (x[i, 0], x[i, 1], x[i, 2]), a, p[i * one])
        out[i, 0], out[i, 1], out[i, 2] = f[0], f[1], f[2]


@functools.cache
def compiled(loop: Callable[..., None]) -> Callable[..., None]:
    """A loop of this module, compiled for both cores."""
    global prange  # noqa: PLW0603
    import numba

    from carom.compiled import njit

    prange = numba.prange
    return njit(loop, parallel=True)
