"""Likelihood of a rebound, and of all in a table, under a law: deviances, scores and information; compiled, on all cores.

The laws are compiled separately and called by their addresses, so that one loop serves balls in the air and on tables. Rows
are split into the same parts whatever the number of cores, and summed in order: results are bitwise identical.
"""

from __future__ import annotations

import functools
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from carom.core.jit.calls import call_at, compiled_address
from carom.core.jit.compile import array_of, named_tuple_type, njit, signature
from carom.core.jit.kernel import kernel
from carom.core.jit.threads import block_slices, call_in_threads
from carom.fitting.deviance import (
    RELATIVE_STEP,
    SPIN_MEAN,
    SPIN_WIDTH,
    RowData,
    Trial,
    Workspace,
    call_law,
    row_deviance,
)
from carom.fitting.laws import LAW_NUMBERS, NUMBERS
from carom.fitting.spins import INTERVAL, SpinGrid, row_deviance_over_spins
from carom.laws.callbacks import register_calls

if TYPE_CHECKING:
    from carom.data.rebounds import Kind

Array = NDArray[np.float64]
PARTS = 8
SHARED_STEP = 0.03  # of an error bar: the step of a derivative in a shared error
MOST_TABLES = 16  # of a tabulated law, kept at once: each takes a megabyte
SERIAL_WORK = 4000  # law evaluations up to which one core is faster


class TabulatedLaw(Protocol):
    """A table in place of a law (:mod:`carom.fitting.model`)."""

    def at(self, p: Array, moves: Array, free: NDArray[np.int64]) -> Array:
        """Return the table at a trial point, with derivatives in the free numbers, as compiled code reads it."""

    def covers(self, problem: Any) -> bool:
        """Return whether all rows lie within it."""


@dataclass(frozen=True, eq=False)
class LikelihoodModel:
    """Rows, a law and its fitted parameters."""

    kind: Kind
    rows: RowData
    free: NDArray[np.int64]
    """(k,) indices of the fitted numbers: the law's parameters, then shared errors, from NUMBERS on."""
    low: Array
    """(NUMBERS + S,) bounds."""
    high: Array
    moved: Array
    """(S, N, 6) shift of inputs and outputs by one unit of each shared error."""
    moves: Array
    """(S, NUMBERS) shift of the law's parameters by the same."""
    tabulated: TabulatedLaw | None = None
    """In place of the law."""


@dataclass(frozen=True, eq=False)
class Evaluation:
    """The likelihood at B sets of parameters."""

    deviance: Array
    """(B, N), not weighted."""
    chi2: Array
    """(B, N) c, at the most likely spin if that was not measured."""
    scores: Array
    """(B, k), weighted; (B, N, k) where asked for by row."""
    information: Array
    """(B, k, k), or (B, N, k, k), weighted."""


@kernel
def _set_steps(trial: Any, low: Any, high: Any) -> None:
    """Set the step of each derivative, relative to the parameter: away from zero, where forms have kinks, and inwards at a bound;
    for a shared error a small fraction of its error bar."""
    for m in range(trial.free.shape[0]):
        j = trial.free[m]
        if j >= NUMBERS:
            trial.steps[j] = SHARED_STEP
            continue
        p = trial.values[j]
        size = RELATIVE_STEP * max(min(high[j] - low[j], 1.0), abs(p) / 10)
        trial.steps[j] = size if (p >= 0 and p + size <= high[j]) or p - size < low[j] else -size


def _evaluate_rows(
    law: Any, rows: Any, spins: Any, measured: Any, weights: Any, p: Any, trial: Any, bounds: Any, moves: Any, part: Any, out: Any,
    work: Any,
) -> None:  # fmt: skip
    """Evaluate rows part[0] to part[1] at each of p (B, K). ``spins``: rows.spins (an argument: Numba drops the branch where
    it is None); ``measured``: x and y without shared errors; ``bounds``: low and high; ``out``: deviance and chi2 (B, N), scores
    (B, R, k) and information (B, R, k, k) of these rows, summed if R is 1, and else of each."""
    plain_x, plain_y = measured
    low, high = bounds
    first, last = part
    deviance, chi2, u, h = out
    k, one, shared = trial.free.shape[0], min(weights.shape[0] - 1, 1), moves.shape[0]
    each = min(u.shape[1] - 1, 1)
    ui, hi = work.u, work.h
    for b in range(p.shape[0]):
        for j in range(p.shape[1]):
            trial.values[j] = p[b, j]
        for s in range(shared):
            for j in range(NUMBERS):
                trial.values[j] += p[b, NUMBERS + s] * moves[s, j]
        _set_steps(trial, low, high)
        for s in range(shared):
            for j in range(NUMBERS):
                trial.stepped[s, j] = trial.values[j] + SHARED_STEP * moves[s, j]
        for i in range(first, last):
            weight = weights[b * one, i]
            if weight == 0:
                deviance[b, i] = chi2[b, i] = 0
                continue
            if shared > 0:
                for m in range(3):
                    rows.x[i, m], rows.y[i, m] = plain_x[i, m], plain_y[i, m]
                    for s in range(shared):
                        rows.x[i, m] += p[b, NUMBERS + s] * trial.moved[s, i, m]
                        rows.y[i, m] += p[b, NUMBERS + s] * trial.moved[s, i, 3 + m]
            if spins is not None and rows.x[i, 2] != rows.x[i, 2]:
                deviance[b, i], chi2[b, i] = row_deviance_over_spins(law, rows, trial, i, ui, hi, work)
            else:
                deviance[b, i], chi2[b, i] = row_deviance(law, rows, trial, i, ui, hi, work)
            for j in range(k):
                u[b, i * each, j] += weight * ui[j]
                for m in range(k):
                    h[b, i * each, j, m] += weight * hi[j, m]


def _predict_rows(law: Any, rows: Any, x: Any, numbers: Any, out: Any) -> None:
    """Compute the law's prediction for each row: x (N, 3), numbers (N or 1,) records, out (N, 3)."""
    one = min(numbers.shape[0] - 1, 1)
    for i in range(x.shape[0]):
        f = call_law(
            law,
            (
                rows.code,
                rows.form,
                rows.stages[i],
                (x[i, 0], x[i, 1], x[i, 2]),
                rows.radius,
                numbers[i * one],
                rows.known,
            ),
        )
        out[i, 0], out[i, 1], out[i, 2] = f[0], f[1], f[2]


@functools.cache
def _declare_calls() -> None:
    """Tell the compiler how the laws are called."""
    call_at(call_law, *_types()["law"])


@functools.cache
def _compiled_law(kind: Kind) -> Callable[..., Any]:
    """Return the laws of a kind, compiled."""
    from carom.fitting.laws import planar_law, table_law

    law = planar_law if kind == "planar" else table_law
    return njit(law, signature(*_types()["law"]), (register_calls,), nogil=True)


@functools.cache
def _law(kind: Kind) -> int:
    """Return the address of the laws of a kind, valid while the process lives."""
    return compiled_address(_compiled_law(kind))


@functools.cache
def _types() -> Any:
    """Return the types of the compiled loops' arguments."""
    one, two, three, four, indices, numbers = (
        array_of(*x) for x in ((float, 1), (float, 2), (float, 3), (float, 4), (int, 1), (LAW_NUMBERS, 1))
    )
    vector = (float, float, float)
    law = (vector, int, int, int, vector, float, LAW_NUMBERS, one)
    grid = named_tuple_type(SpinGrid, one, bool)

    def rows(spins: Any) -> Any:
        return named_tuple_type(RowData, int, int, indices, float, spins, two, two, two, two, two, float, one)

    trial = named_tuple_type(Trial, one, numbers, indices, one, three, two, numbers)
    work = named_tuple_type(
        Workspace, one, two, two, two, two, two, two, one, two, one, two, array_of(INTERVAL), two, two, two, two, one, two, two,
    )  # fmt: skip
    bounds, part, out = (one, one), (int, int), (two, two, three, four)
    looks = {
        averaged: signature(None, int, rows(kind), kind, (two, two), two, two, trial, bounds, two, part, out, work)
        for averaged, kind in ((False, None), (True, grid))
    }
    says = signature(None, int, rows(None), two, numbers, two)
    return {"law": law, "evaluate": looks, "predict": says}


@functools.cache
def _evaluating(averaged: bool) -> Callable[..., None]:
    """Return :func:`_evaluate_rows`, compiled, for rows with or without unmeasured spins."""
    return njit(_evaluate_rows, _types()["evaluate"][averaged], (_declare_calls,), nogil=True)


@functools.cache
def _predicting() -> Callable[..., None]:
    return njit(_predict_rows, _types()["predict"], (_declare_calls,), nogil=True)


def compile_likelihood() -> None:
    """Compile the laws and the loops, or load them from the cache."""
    for averaged in (False, True):
        _evaluating(averaged)
    _predicting()
    _law("planar")
    _law("table")


def make_trial(free: NDArray[np.int64], moved: Array) -> Trial:
    """Return the trial point of one thread; its records share their memory with the arrays."""
    values, stepped = np.zeros(NUMBERS + len(moved)), np.zeros((len(moved), NUMBERS))
    return Trial(
        values, values[:NUMBERS].view(LAW_NUMBERS), free, np.zeros(len(values)), moved, stepped,
        stepped.view(LAW_NUMBERS)[:, 0],
    )  # fmt: skip


def make_workspace(k: int, points: int) -> Workspace:
    """Return the scratch arrays of one thread, for k fitted numbers and ``points`` points of the grid of spins (0: none)."""

    def zeros(*shape: int) -> Array:
        return np.zeros(shape)

    return Workspace(
        zeros(k), zeros(k, k), zeros(4 + 3 * k, 3), zeros(3, 3), zeros(3, 3), zeros(3, 3), zeros(2, 3), zeros(3),
        zeros(2, 3), zeros(4 * points), zeros(4 * points, 3), np.zeros(5 * points, INTERVAL), zeros(k, 3), zeros(k, 3),
        zeros(k, 3), zeros(k, 3), zeros(k), zeros(k, k), zeros(k, k),
    )  # fmt: skip


def evaluate(
    model: LikelihoodModel, p: Array, weights: Array | None = None, *, by_row: bool = False
) -> Evaluation:  # fmt: skip
    """Evaluate the likelihood at B sets of numbers p (B, K), with weights (B or 1, N) of the rows."""
    p, rows = np.ascontiguousarray(p, float), model.rows
    (n, count), k = (len(rows.x), len(p)), len(model.free)
    weights = np.ones((1, n)) if weights is None else np.ascontiguousarray(weights, float)
    points = 0 if rows.spins is None else len(rows.spins.sigma)
    loop, law = _evaluating(points > 0), _law(model.kind)
    deviance, chi2 = np.empty((count, n)), np.empty((count, n))
    if model.tabulated is not None and count > MOST_TABLES:
        parts_of = [
            evaluate(model, p[some], weights if len(weights) == 1 else weights[some], by_row=by_row)
            for some in block_slices(count, MOST_TABLES)
        ]
        return Evaluation(*map(np.concatenate, zip(*(vars(seen).values() for seen in parts_of), strict=True)))
    # many sets: a part has some sets and all rows; few sets: a part has some rows; of a tabulated law each set has a table
    tables = None if model.tabulated is None else [model.tabulated.at(one, model.moves, model.free) for one in p]
    quick = n * max(points, 1) * (count if tables is None else 1) < SERIAL_WORK
    sets, parts = (1, 1) if quick else (PARTS, 1) if count >= PARTS else (1, PARTS)
    sets, parts = (sets, parts) if tables is None else (count, 1 if quick else PARTS)
    sums, each = (1, n) if by_row else (parts, 1)
    u, h = np.zeros((sums, count, each, k)), np.zeros((sums, count, each, k, k))

    def part(some: slice, m: int, own_rows: slice) -> None:
        own = rows._replace(x=rows.x.copy(), y=rows.y.copy()) if len(model.moved) else rows
        own = own if tables is None else own._replace(known=tables[some.start])
        loop(
            law, own, rows.spins, (rows.x, rows.y), weights if len(weights) == 1 else weights[some], p[some],
            make_trial(model.free, model.moved), (model.low, model.high), model.moves, (own_rows.start, own_rows.stop),
            (deviance[some], chi2[some], u[m % sums, some], h[m % sums, some]), make_workspace(k, points),
        )  # fmt: skip

    tasks = [(some, m, one) for some in _equal_slices(count, sets) for m, one in enumerate(_equal_slices(n, parts))]
    call_in_threads(lambda task: part(*task), tasks)
    u, h = u.sum(axis=0), h.sum(axis=0)
    return Evaluation(deviance, chi2, u, h) if by_row else Evaluation(deviance, chi2, u[:, 0], h[:, 0])


def _equal_slices(count: int, parts: int) -> list[slice]:
    """Return so many slices, as long as each other but for one, that cover ``count`` rows."""
    return [slice(i * count // parts, (i + 1) * count // parts) for i in range(parts)]


def predictions(kind: Kind, rows: RowData, x: Array, p: Array) -> Array:
    """Return the law's predictions (N, 3) for x (N, 3) with numbers p (K,) or (N, K); on all cores where there are many."""
    out, x = np.empty((len(x), 3)), np.ascontiguousarray(x, float)
    numbers = np.ascontiguousarray(np.atleast_2d(p)[:, :NUMBERS], float).view(LAW_NUMBERS)[:, 0]

    loop, law = _predicting(), _law(kind)

    def part(some: slice) -> None:
        own = rows._replace(stages=rows.stages[some], spins=None)
        loop(law, own, x[some], numbers if len(numbers) == 1 else numbers[some], out[some])

    call_in_threads(part, _equal_slices(len(x), PARTS if len(x) > SERIAL_WORK else 1))
    return out


# ----------------------------------------------------------------------------------------------------
# Likelihood with a prior of flexible shape for spins that were not measured: a mixture of normal distributions.
#
# The likelihood of a row under a mixture is the sum of its likelihoods under the components, each weighted with the component's
# share. Scores are those of the components, weighted with the row's probability of having come from each (Fisher's identity); so
# is the information, which is that of the rows with known component, an upper bound (Dempster, Laird & Rubin, J. R. Stat. Soc. B
# 39, 1 (1977)).


class SpinMixture(NamedTuple):
    """A prior of spins: normal distributions with shares (C,), means (C,) in v_t/a and widths (C,) in v/a."""

    share: Array
    mean: Array
    width: Array

    @property
    def parameters(self) -> int:
        """Number of adjusted parameters: the shares add up to 1."""
        return 3 * len(self.share) - 1

    @property
    def in_words(self) -> str:
        """The components, largest first."""
        order = np.argsort(-self.share)
        return ", ".join(f"{self.share[i]:.0%} at {self.mean[i]:.2f} ± {self.width[i]:.2f}" for i in order)

    def given(self, p: Array) -> Array:
        """Return numbers (B C, K) of all components for p (B, K)."""
        every = np.repeat(p, len(self.share), axis=0)
        every[:, SPIN_MEAN], every[:, SPIN_WIDTH] = np.tile(self.mean, len(p)), np.tile(self.width, len(p))
        return every


def evaluate_components(likelihood: LikelihoodModel, every: Array, components: int) -> Evaluation:
    """Evaluate the rows under each component, for numbers (B C, K): all results have (B, C, N) in place of (B, N)."""
    seen = vars(evaluate(likelihood, every, by_row=True))
    return Evaluation(**{name: x.reshape(len(x) // components, components, *x.shape[1:]) for name, x in seen.items()})


def mixture_deviances(deviance: Array, log_share: Array) -> tuple[Array, Array]:
    """Return the rows' deviances (B, N), and their probabilities (B, C, N) of each component, from the components' likelihoods."""
    logs = log_share[:, :, None] - deviance / 2
    top = logs.max(axis=1, keepdims=True)
    total = top[:, 0] + np.log(np.exp(logs - top).sum(axis=1))
    return -2 * total, np.exp(logs - total[:, None])


def evaluate_mixture(
    likelihood: LikelihoodModel, mixture: SpinMixture, p: Array, weights: Array | None
) -> Evaluation:  # fmt: skip
    """Evaluate the likelihood under a mixture at B sets of numbers p (B, K), with weights (B or 1, N) of the rows."""
    seen = evaluate_components(likelihood, mixture.given(p), len(mixture.share))
    deviance, belongs = mixture_deviances(seen.deviance, np.log(mixture.share)[None])
    chi2 = np.take_along_axis(seen.chi2, np.argmax(belongs, axis=1)[:, None], axis=1)[:, 0]
    weighted = belongs if weights is None else belongs * weights[:, None]
    scores, information = (np.einsum("bcn,bcn...->b...", weighted, x) for x in (seen.scores, seen.information))
    return Evaluation(deviance, chi2, scores, information)
