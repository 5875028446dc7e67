"""Looks at all rows: what a law says, deviances, scores, information; compiled, on all cores.

The laws are compiled by themselves and handed to the loops as functions, so that one loop serves balls in the air and on
tables. Rows are looked at in so many parts whatever the number of cores, and summed in order: the same bits everywhere.
"""

from __future__ import annotations

import functools
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from carom.fitting.bells import COLUMNS
from carom.fitting.scores import SMALL
from carom.fitting.stretches import Spins
from carom.fitting.terms import ROOM, STEP, known_row
from carom.fitting.unmeasured import unmeasured_row
from carom.kernel import kernel

if TYPE_CHECKING:
    from carom.rebounds import Kind

__all__ = ["Look", "Rows", "look", "said"]

Array = NDArray[np.float64]
PARTS = 8
NEAR = 0.03  # of an error bar: the step of a slope in a shared error
WORTH = 4000  # rows, or so many looks at a place of a spin: fewer are looked at on one core


@dataclass(frozen=True, eq=False)
class Rows:
    """Rows and a law, as the compiled loops take them."""

    kind: Kind
    code: int
    form: int
    stages: NDArray[np.int64] | None
    radius: float
    spins: Spins | None
    x: Array
    vx: Array
    y: Array
    vy: Array
    nu: float
    free: NDArray[np.int64]
    """Places of the numbers that are fitted: the law's, then those of shared errors, from NUMBERS on."""
    low: Array
    high: Array
    moved: Array
    """(S, N, 6) by how much shared errors move the rows."""
    moves: Array
    """(S, NUMBERS) and the numbers."""


@dataclass(frozen=True, eq=False)
class Look:
    """What B sets of numbers are worth."""

    deviance: Array
    """(B, N), not weighted."""
    least: Array
    """(B, N) c."""
    scores: Array
    """(B, k), weighted."""
    information: Array
    """(B, k, k), weighted."""


@kernel
def set_steps(p: Any, free: Any, low: Any, high: Any, own: int, steps: Any) -> None:
    """The step of each parameter's derivative, of its own size: away from zero, where forms have kinks, inwards at a bound; of an
    error that all rows share a part of its error bar, which is little."""
    for m in range(free.shape[0]):
        j = free[m]
        if j >= own:
            steps[j] = NEAR
            continue
        size = STEP * max(min(high[j] - low[j], 1.0), abs(p[j]) / 10)
        steps[j] = size if (p[j] >= 0 and p[j] + size <= high[j]) or p[j] - size < low[j] else -size


def _look(
    law: Any, code: int, form: int, stages: Any, a: float, spins: Any, x: Any, vx: Any, y: Any, vy: Any, nu: float,
    weights: Any, p: Any, free: Any, low: Any, high: Any, moved: Any, moves: Any, first: int, last: int, c: Any, best: Any, u: Any,
    h: Any,
) -> None:  # fmt: skip
    """Rows first to last under each of p (B, K): c and best (B, N); u (B, k) and h (B, k, k) of these rows."""
    k, one, count = free.shape[0], min(weights.shape[0] - 1, 1), 0
    shared, told = moves.shape
    at_x, at_y = x, y
    if shared > 0:
        at_x, at_y = x.copy(), y.copy()
    if spins is not None:
        count = spins.places.shape[0]
    w = max(k, 3)
    numbers, steps, further = np.zeros(p.shape[1]), np.zeros(p.shape[1]), np.zeros(moves.shape)
    fitted = (free, steps, moved, further)
    ui, hi, room = np.zeros(k), np.zeros((k, k)), np.zeros((ROOM, 4 + k, w))
    desk = (
        np.zeros(4 * count), np.zeros((4 * count, 3)), np.zeros((5 * count, COLUMNS)), np.zeros((SMALL, w, w)),
        np.zeros((3 + 3 * k, 3)),
    )  # fmt: skip
    for b in range(p.shape[0]):
        for j in range(p.shape[1]):
            numbers[j] = p[b, j]
        for s in range(shared):
            for j in range(told):
                numbers[j] += p[b, told + s] * moves[s, j]
        set_steps(numbers, free, low, high, told, steps)
        for s in range(shared):
            for j in range(told):
                further[s, j] = numbers[j] + NEAR * moves[s, j]
        for i in range(first, last):
            weight = weights[b * one, i]
            if weight == 0:
                c[b, i] = best[b, i] = 0
                continue
            stage = stages[i]
            if shared > 0:
                for m in range(3):
                    at_x[i, m], at_y[i, m] = x[i, m], y[i, m]
                    for s in range(shared):
                        at_x[i, m] += p[b, told + s] * moved[s, i, m]
                        at_y[i, m] += p[b, told + s] * moved[s, i, 3 + m]
            if spins is not None and x[i, 2] != x[i, 2]:
                c[b, i], best[b, i] = unmeasured_row(
                    law, code, form, stage, i, a, spins, at_x, vx, at_y, vy, nu, numbers, fitted, ui, hi, desk
                )
            else:
                c[b, i], best[b, i] = known_row(
                    law, code, form, stage, i, a, at_x, vx, at_y, vy, nu, numbers, fitted, ui, hi, room
                )
            for j in range(k):
                u[b, j] += weight * ui[j]
                for m in range(k):
                    h[b, j, m] += weight * hi[j, m]


def _say(law: Any, code: int, form: int, stages: Any, a: float, x: Any, p: Any, out: Any) -> None:
    """What the law says of each row: x (N, 3), p (N or 1, K), out (N, 3)."""
    one = min(p.shape[0] - 1, 1)
    for i in range(x.shape[0]):
        f = law(code, form, stages[i], (x[i, 0], x[i, 1], x[i, 2]), a, p[i * one])
        out[i, 0], out[i, 1], out[i, 2] = f[0], f[1], f[2]


@functools.cache
def _law(kind: Kind) -> Any:
    """The laws of a kind, compiled."""
    from carom.compiled import njit
    from carom.fitting.kernels import planar, table

    return njit(planar if kind == "planar" else table, _types()["law"].signature, nogil=True)


@functools.cache
def _types() -> Any:
    from numba import types

    def array(n: int) -> Any:
        return types.Array(types.float64, n, "C")

    vector = types.UniTuple(types.float64, 3)
    law = types.FunctionType(vector(types.int64, types.int64, types.int64, vector, types.float64, array(1)))
    return {"law": law, "array": array, "whole": types.int64, "real": types.float64, "wholes": types.Array(types.int64, 1, "C"),
            "spins": types.NamedTuple((array(1), types.boolean), Spins), "none": types.none, "void": types.void}  # fmt: skip


@functools.cache
def _looking(averaged: bool) -> Callable[..., None]:
    """:func:`_look`, compiled, for rows of which some lack a spin, or none."""
    from carom.compiled import njit

    t = _types()
    one, two, three = (t["array"](n) for n in (1, 2, 3))
    head = (t["law"], t["whole"], t["whole"], t["wholes"], t["real"], t["spins"] if averaged else t["none"])
    rows = (two, two, two, two, t["real"], two, two, t["wholes"], one, one, three, two, t["whole"], t["whole"])
    return njit(_look, t["void"](*head, *rows, two, two, two, three), nogil=True)


@functools.cache
def _saying() -> Callable[..., None]:
    from carom.compiled import njit

    t = _types()
    two = t["array"](2)
    return njit(_say, t["void"](t["law"], t["whole"], t["whole"], t["wholes"], t["real"], two, two, two), nogil=True)


@functools.cache
def _pool() -> ThreadPoolExecutor:
    import numba

    return ThreadPoolExecutor(numba.get_num_threads(), thread_name_prefix="carom-fit")


def _whole(rows: NDArray[np.int64] | None, n: int) -> NDArray[np.int64]:
    return np.zeros(n, np.int64) if rows is None else np.ascontiguousarray(rows, np.int64)


def look(rows: Rows, p: Array, weights: Array | None = None) -> Look:
    """Deviances, scores and information of B sets of numbers p (B, K), with weights (B or 1, N) of the rows."""
    p = np.ascontiguousarray(p, float)
    (n, count), k = (len(rows.x), len(p)), len(rows.free)
    weights = np.ones((1, n)) if weights is None else np.ascontiguousarray(weights, float)
    stages = _whole(rows.stages, n)
    moved, moves = np.ascontiguousarray(rows.moved, float), np.ascontiguousarray(rows.moves, float)
    fixed = [np.ascontiguousarray(array, float) for array in (rows.x, rows.vx, rows.y, rows.vy)]
    loop, law = _looking(rows.spins is not None), _law(rows.kind)
    c, best = np.empty((count, n)), np.empty((count, n))
    work = n * count * (1 if rows.spins is None else len(rows.spins.places))
    # many sets: some sets a part, all rows; few: some rows a part
    sets, parts = (1, 1) if work < WORTH else (PARTS, 1) if count >= PARTS else (1, PARTS)
    edges = np.linspace(0, n, parts + 1).astype(int).tolist()
    blocks = np.linspace(0, count, sets + 1).astype(int).tolist()
    u, h = np.zeros((parts, count, k)), np.zeros((parts, count, k, k))

    def part(some: slice, m: int) -> None:
        w = weights if len(weights) == 1 else weights[some]
        loop(
            law, rows.code, rows.form, stages, rows.radius, rows.spins, *fixed, rows.nu, w, p[some], rows.free, rows.low,
            rows.high, moved, moves, edges[m], edges[m + 1], c[some], best[some], u[m, some], h[m, some],
        )  # fmt: skip

    tasks = [(slice(blocks[i], blocks[i + 1]), m) for i in range(sets) for m in range(parts)]
    if len(tasks) == 1:
        part(*tasks[0])
    else:
        list(_pool().map(lambda task: part(*task), tasks))
    return Look(c, best, u.sum(axis=0), h.sum(axis=0))


def said(rows: Rows, x: Array, p: Array) -> Array:
    """What the law says of x (N, 3) with numbers p (N or 1, K): (N, 3)."""
    out = np.empty((len(x), 3))
    _saying()(
        _law(rows.kind), rows.code, rows.form, _whole(rows.stages, len(x)), rows.radius, np.ascontiguousarray(x, float),
        np.ascontiguousarray(np.atleast_2d(p), float), out,
    )  # fmt: skip
    return out
