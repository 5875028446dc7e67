"""The numbers that many shots share: their fit, their covariance, and fits of several laws to the same shots.

Shared numbers of the table from many shots: the starts follow, and each shot counts by the logarithm of its distance.

For given numbers every shot has its own best start, and the numbers minimise the rest: variable projection, with Kaufman's
derivative (BIT 15, 49 (1975)). What is minimised is the sum over shots of log(mean square distance), the likelihood if each shot
has an unknown scatter of its own: one shot that changes to another sequence of events costs little, and blocks no step.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.errors import CaromError
from carom.fitting.identify import NOT_IDENTIFIABLE, Identified, identified_covariance, identify
from carom.fitting.laws import Parameter
from carom.fitting.result import Estimate, with_error_bar
from carom.fitting.shots.result import ShotsFit, TableModel
from carom.fitting.shots.search import (
    FAILED,
    FilmedShot,
    Refined,
    ShotStart,
    StartPrior,
    correlation,
    error_of_frames,
    horizons,
    refined,
    residuals,
    rms,
    soft,
    start_size,
)
from carom.fitting.spin_chains import bounded_step
from carom.fitting.table_numbers import Projection, TableNumbers, descend_shared

Array = NDArray[np.float64]
FLOOR = 5e-4  # m, of a distance: less has no more weight
EVALUATIONS, STEPS = 6, 20
GAIN = 1e-5  # of the mean logarithm, below which the search ends
HALVINGS = 5  # of a step to an impossible table
LARGEST_STEP = 4.0  # usual changes of a number
SCATTER_ROUNDS, LOOSE_ROUNDS = 5, 3
WIDTH_ROUNDS = 4  # of 300, after which widths stand still, some are 0 that later frames contradict (docs, whole shots)
WIDTH = 0.5  # of usual changes: the scatter between shots with which its search begins
SETTLED = 0.2  # error bars of the means, and shares of the widths, below which a round ends the search
PRIOR_WIDTH = 4.0  # usual changes: of the prior of few shots about the numbers of the table that is given
FEWEST = 5  # shots for errors from their scatter
LEAST_WIDTH, MOST_WIDTH = 0.02, 20.0  # of a scatter between shots, in usual changes of a number
WINSOR = 3.0  # widths, beyond which the deviation of a shot counts no more


@dataclass(eq=False)
class JointFit:
    """Values of the shared numbers, with the starts that go with them."""

    values: Array
    frames: list[int]
    """Of each shot: how many are fitted; 0 for a shot that is left out."""
    found: list[Refined]
    objective: float


def frames_of_events(shot: FilmedShot, events: int) -> int:
    """Return the horizon before the event after so many, at least that of the first ball."""
    every = horizons(shot)
    lows = sorted(one.low for one in shot.events)
    wanted = shot.frames_until(lows[events]) if len(lows) > events else len(shot.time)
    return max((n for n in every if n <= wanted), default=every[0])


def _all_refined(
    table: TableNumbers, starts: Sequence[ShotStart], frames: Sequence[int], sigmas: Sequence[float | None],
    firsts: Sequence[Array | None], others: int = 2,
) -> list[Refined]:  # fmt: skip
    return [
        refined(table, one, n, EVALUATIONS, others, sigma, first)
        for one, n, sigma, first in zip(starts, frames, sigmas, firsts, strict=True)
    ]


def _objective(starts: Sequence[ShotStart], frames: Sequence[int], found: Sequence[Refined]) -> float:
    return float(sum(np.log(_mean_square(one, n, got)) for one, n, got in zip(starts, frames, found, strict=True)))


class TablePrior(NamedTuple):
    """Prior of the shared numbers (P,) of few shots: normal about the numbers of the table that is given."""

    middle: Array
    scale: Array
    """Usual changes; the widths are :data:`PRIOR_WIDTH` of them."""
    weight: float
    """Of a squared width, where each shot counts by the logarithm of its mean square."""

    def cost(self, values: Array) -> float:
        """Return what is added to the objective of :func:`fit_shared`."""
        return float(self.weight * np.square((values - self.middle) / self.scale / PRIOR_WIDTH).sum())

    def information(self, values: Array) -> tuple[Array, Array]:
        """Return -1/2 of the gradient (P,) of the cost, and 1/2 of its curvature (P, P), by changes in units of the scale."""
        each = self.weight / PRIOR_WIDTH**2
        return each * (self.middle - values) / self.scale, each * np.eye(len(values))

    @classmethod
    def of(
        cls, table: TableNumbers, starts: Sequence[ShotStart], frames: Sequence[int], found: Sequence[Refined]
    ) -> TablePrior:
        """Return the prior for some shots."""
        middle, scale = (np.array([getattr(one, name) for one in table.shared]) for name in ("value", "scale"))
        return cls(middle, scale, len(starts) / float(independent_residuals(table, starts, frames, found).sum()))


def independent_residuals(
    table: TableNumbers, starts: Sequence[ShotStart], frames: Sequence[int], found: Sequence[Refined]
) -> Array:
    """Return how many independent residuals each shot has (N,): those that are correlated with their neighbours count as one."""
    counts = []
    for one, n, got in zip(starts, frames, found, strict=True):
        gap = residuals(table, one.shot, got.start[None], n).gap[0]
        counts.append(len(gap) / correlation(gap, one.shot, n))
    return np.array(counts)


def _mean_square(start: ShotStart, frames: int, found: Refined) -> float:
    return found.cost * found.sigma**2 / int(start.shot.known[:frames].sum()) + FLOOR**2


def mean_squares(table: TableNumbers, starts: Sequence[ShotStart], frames: Sequence[int]) -> Array:
    """Return the mean square distances (N,) of shots up to a horizon on one table, m^2, with their best starts."""
    each = zip(starts, frames, strict=True)
    return np.array([rms(table, one.shot, refined(table, one, n, 9, 2).start, n) ** 2 for one, n in each])


def deviance_of(squares: Array, starts: Sequence[ShotStart], frames: Sequence[int], noise: float) -> tuple[float, int]:
    """Return the deviance of shots with such mean square distances (N,), and how many numbers it counts."""
    counts = np.array([_independent(one.shot, n) for one, n in zip(starts, frames, strict=True)])
    return float((counts * np.log(squares + noise**2)).sum()), int(counts.sum())


def _independent(shot: FilmedShot, frames: int) -> int:
    """Return how many independent numbers the frames up to a horizon are: two for each ball that moves and each stretch."""
    until = shot.time[frames - 1]
    met = sum(1 + (one.kind == "ball") for one in shot.events if one.high <= until)
    return 2 * (1 + met)


class Information(NamedTuple):
    """What each of N shots says of the P shared numbers, with its start free, in units of the error of a frame."""

    scores: Array
    """(N, P)"""
    matrices: Array
    """(N, P, P)"""
    follows: list[Array]
    """N of (K, P): how each start follows the numbers."""
    spreads: Array
    """(N, R): errors of the deviations of the table's numbers of each shot."""

    def weighted(self, weights: Array) -> tuple[Array, Array]:
        """Return scores and matrices with weights (N,) of the shots."""
        return self.scores * weights[:, None], self.matrices * weights[:, None, None]


def weights_of_shots(starts: Sequence[ShotStart], frames: Sequence[int], found: Sequence[Refined]) -> Array:
    """Return weights (N,), with which each shot counts by the logarithm of its mean square distance."""
    each = zip(starts, frames, found, strict=True)
    return np.array(
        [got.sigma**2 / (_mean_square(one, n, got) * int(one.shot.known[:n].sum())) for one, n, got in each]
    )


def information_of_shots(
    table: TableNumbers, starts: Sequence[ShotStart], frames: Sequence[int], found: Sequence[Refined]
) -> Information:
    """Return what each shot says of the shared numbers."""
    count = len(table.values)
    scores, matrices, follows = np.zeros((len(starts), count)), np.zeros((len(starts), count, count)), []
    spreads = []
    for i, (one, n, got) in enumerate(zip(starts, frames, found, strict=True)):
        at = residuals(table, one.shot, got.start[None], n, shared=True)
        gap, (by_start, by_shared) = soft(at.gap[0], [at.by_start[0], at.by_shared[0]], got.sigma)
        rows = np.concatenate([by_start, one.prior.rows])
        r = np.concatenate([gap, one.prior.rows @ (got.start - one.prior.center)])
        d = np.concatenate([by_shared, np.zeros((len(one.prior.rows), count))])
        left = Projection.of(rows)
        follows.append(left.follows(d))
        spreads.append(np.sqrt(np.square(left.inverse[start_size(len(one.shot.balls)) :]).sum(axis=1)))
        d = left.rest(d)
        with np.errstate(over="ignore", invalid="ignore"):
            score, matrix = -d.T @ r, d.T @ d
        # (a shot whose derivatives are too large to be squared says nothing)
        if np.isfinite(matrix).all() and np.isfinite(score).all():
            scores[i], matrices[i] = score, matrix
    return Information(scores, matrices, follows, np.array(spreads))


@dataclass(eq=False)
class ScatterFit:
    """Numbers of the table that scatter from shot to shot: their means and widths."""

    values: Array
    """(P,)"""
    widths: Array
    """(P,) standard deviations between shots."""
    starts: list[ShotStart]
    used: list[int]
    found: list[Refined]
    """Of the shots that are used, in errors of independent frames."""
    information: Information


def fit_scatter(
    model: TableModel, values: Array, starts: Sequence[ShotStart], frames: Sequence[int], widths: Array,
    noise: float, tell: Callable[[float], None], rounds: int = SCATTER_ROUNDS, width_rounds: int = WIDTH_ROUNDS,
) -> ScatterFit:  # fmt: skip
    """Fit means and widths of the table's numbers, and the deviations of each shot.

    Each shot has numbers of its own, normal about the means. A step moves the means by what all shots say with their starts and
    deviations free; the widths follow from the deviations and their errors (expectation and maximisation). Frames count by how far
    their residuals are correlated: with all frames independent, deviations would take up whatever the laws lack.
    """
    shared = model.shared
    low, high, scale = (np.array([getattr(one, name) for one in shared]) for name in ("low", "high", "scale"))
    starts = [one.with_scatter(widths) for one in starts]
    settled = False
    errors: list[float | None] = [None] * len(starts)
    for turn in range(rounds):
        tell(turn / rounds)
        table = model.at(values)
        found = _all_refined(table, starts, frames, errors, [None] * len(starts))
        errors = [
            error_of_frames(table, one, got.start, n, math.sqrt(2) * noise)
            for one, n, got in zip(starts, frames, found, strict=True)
        ]
        used = [i for i, one in enumerate(starts) if rms(table, one.shot, found[i].start, frames[i]) < FAILED]
        used = used or list(range(len(starts)))
        for one, n, best in zip(starts, frames, found, strict=True):
            one.best[n] = best.start
            one.pool.append(best.start)
        some, ends, got = [starts[i] for i in used], [frames[i] for i in used], [found[i] for i in used]
        said = information_of_shots(table, some, ends, got)
        matrix = said.matrices.sum(axis=0) * scale[:, None] * scale
        bars = scale * np.sqrt(np.maximum(np.diag(np.linalg.pinv(matrix, hermitian=True)), 0.0))
        deviations = np.array([one.start[-len(widths) :] for one in got])
        if settled or turn == rounds - 1:
            break
        score = said.scores.sum(axis=0) * scale
        least, most = (
            np.maximum((low - values) / scale, -LARGEST_STEP),
            np.minimum((high - values) / scale, LARGEST_STEP),
        )
        found_step, _damping = bounded_step(matrix[None], score[None], least[None], most[None], np.zeros(1))
        step = _possible(model, values, np.clip(values + found_step[0] * scale, low, high) - values)
        values = values + step
        inside = np.clip(deviations, -WINSOR * widths, WINSOR * widths)
        new = likely_widths(inside, said.spreads, widths, width_rounds)
        before, widths = widths, np.clip(new, LEAST_WIDTH * scale, MOST_WIDTH * scale)
        settled = bool((np.abs(step) < SETTLED * bars).all()) and bool(
            (np.abs(widths - before) < SETTLED * before).all()
        )
        moved = dict(zip(used, said.follows, strict=True))
        again = []
        for i, one in enumerate(starts):
            other = one.with_scatter(widths)
            if i in moved:
                other.best[frames[i]] = found[i].start + moved[i] @ step
                other.pool.append(other.best[frames[i]])
            again.append(other)
        starts = again
    return ScatterFit(values, widths, starts, used, got, said)


def likely_widths(deviations: Array, spreads: Array, widths: Array, rounds: int) -> Array:
    """Return widths (P,) of a scatter, from deviations (N, P) and their errors, which shots have at other ``widths``.

    Expectation and maximisation, for each number by itself, on what each shot would say without these widths: one round for all
    shots each time that they are fitted would take hundreds where there is hardly any scatter.
    """
    square, count = np.square(widths), len(deviations)
    known = np.maximum(1 / np.square(spreads) - 1 / square, 1e-9 / square)
    own = np.square(deviations * (1 + 1 / (known * square))) * (count / max(count - 1, 1))
    for _ in range(rounds):
        told = square * known
        square = np.mean(np.square(told / (1 + told)) * own + square / (1 + told), axis=0)
    return np.asarray(np.sqrt(square))


def _possible(model: TableModel, values: Array, step: Array) -> Array:
    """Return a step (P,), or the part of it to a possible table: a friction must not rise with the slip, for example."""
    for _ in range(HALVINGS):
        try:
            model.at(values + step)
        except CaromError:
            step = step / 2
        else:
            return step
    return np.zeros_like(step)


def _loosened(
    model: TableModel, values: Array, starts: Sequence[ShotStart], frames: Sequence[int], noise: float,
    tell: Callable[[float], None],
) -> Array:  # fmt: skip
    """Return the values (P,) to which shots lead that may each have a table of their own; their starts come into the pools.

    On one table for all shots the objective has many minima: each shot can be followed by a wrong start that suits the wrong table,
    and holds it there. Shots whose tables may differ each come near the true one, and so does their mean.
    """
    widths = WIDTH * np.array([one.scale for one in model.shared])
    found = fit_scatter(model, values, starts, frames, widths, noise, tell, LOOSE_ROUNDS, 1)
    for one, n, other in zip(starts, frames, found.starts, strict=True):
        one.pool.append(other.best[n][: start_size(len(one.shot.balls))])
    return found.values


def one_table(model: TableModel, values: Array, starts: Sequence[ShotStart]) -> tuple[Array, list[ShotStart]]:
    """Return the mean (P,) of the tables on which shots start, each on its own, and the starts without them."""
    low, high = (np.array([getattr(one, name) for one in model.shared]) for name in ("low", "high"))
    by = np.mean([one.best[max(one.best)][-len(values) :] for one in starts], axis=0)
    found = list[ShotStart]()
    for one in starts:
        k = start_size(len(one.shot.balls))
        prior = StartPrior(one.prior.center[:k], one.prior.rows[:k, :k])
        best = {n: start[:k] for n, start in one.best.items()}
        found.append(ShotStart(one.shot, prior, best, [start[:k] for start in one.pool]))
    return values + _possible(model, values, np.clip(values + by, low, high) - values), found


@dataclass(eq=False)
class _Shots:
    """Shots whose starts follow the shared numbers, given in usual changes of these."""

    model: TableModel
    starts: Sequence[ShotStart]
    frames: Sequence[int]
    tell: Callable[[float], None]
    table: TableNumbers
    found: list[Refined]
    """The starts on this table."""
    follows: list[Array]
    known: TablePrior
    done: int = 0

    def values(self, changes: Array) -> Array:
        return np.asarray(np.clip(changes * self.known.scale, *self.table.ends))

    def objective(self, values: Array, found: Sequence[Refined]) -> float:
        return _objective(self.starts, self.frames, found) + self.known.cost(values)

    def refined(self, table: TableNumbers) -> list[Refined]:
        none = [None] * len(self.starts)
        return _all_refined(table, self.starts, self.frames, none, none)

    def tried(self, changes: Array) -> tuple[float, tuple[TableNumbers, list[Refined]]]:
        values, table, found = self.values(changes), self.table, self.found
        if self.follows:
            try:
                table = self.model.at(values)
            except CaromError:  # (a friction that would rise with the slip, for example)
                return math.inf, (table, found)
            each = zip(self.found, self.follows, strict=True)
            firsts = [one.start + along @ (values - self.table.values) for one, along in each]
            found = _all_refined(table, self.starts, self.frames, [one.sigma for one in self.found], firsts, 0)
        return self.objective(values, found), (table, found)

    def taken(self, changes: Array, tried: tuple[TableNumbers, list[Refined]]) -> tuple[float, Array, Array]:
        self.tell(self.done / STEPS)
        self.done += 1
        if tried[1] is not self.found:
            self.table = tried[0]
            for one, n, start in zip(self.starts, self.frames, tried[1], strict=True):
                one.best[n] = start.start
                one.pool.append(start.start)
            pairs = zip(self.starts, self.frames, tried[1], self.refined(self.table), strict=True)
            self.found = [min(old, new, key=lambda got: _mean_square(one, n, got)) for one, n, old, new in pairs]
        values, scale, given = self.table.values, self.known.scale, (self.starts, self.frames, self.found)
        if len(self.starts) < FEWEST:
            self.known = TablePrior.of(self.table, *given)
        said = information_of_shots(self.table, *given)
        self.follows, (scores, matrices) = said.follows, said.weighted(weights_of_shots(*given))
        score, matrix = self.known.information(values)
        score, matrix = score + scores.sum(axis=0) * scale, matrix + matrices.sum(axis=0) * scale[:, None] * scale
        return self.objective(values, self.found), score, matrix


def fit_shared(
    model: TableModel, values: Array, starts: Sequence[ShotStart], frames: Sequence[int], noise: float,
    tell: Callable[[float], None], loosened: bool = True,
) -> JointFit:  # fmt: skip
    """Find the values of the shared numbers; the starts' best and pools are brought up to date.

    Of few shots the numbers are normal about those of the table that is given, weighed against residuals that count as one where
    they are correlated: numbers that a shot does not tell would run off with whatever the laws lack.

    ``loosened``: whether the shots may first have tables of their own; else the search descends from ``values``.
    """
    if loosened and len(starts) > 1:
        values = _loosened(model, values, starts, frames, noise, lambda done: tell(done / 2))
    table, none = model.at(values), [None] * len(starts)
    found = _all_refined(table, starts, frames, none, none)
    used = [i for i, one in enumerate(starts) if rms(table, one.shot, found[i].start, frames[i]) < FAILED]
    used = used or list(range(len(starts)))
    scale = np.array([one.scale for one in model.shared])
    shots = _Shots(
        model, [starts[i] for i in used], [frames[i] for i in used], lambda done: tell((1 + done) / 2), table,
        [found[i] for i in used], [], TablePrior(values, scale, 0.0),
    )  # fmt: skip
    low, high = (end / scale for end in table.ends)
    descend_shared(
        shots, np.clip(values / scale, low, high), low, high, steps=STEPS, tolerance=GAIN * len(used), most=LARGEST_STEP
    )
    every = _all_refined(shots.table, starts, frames, none, none)
    for one, n, start in zip(starts, frames, every, strict=True):
        one.best[n] = start.start
    followed = [n if i in used else 0 for i, n in enumerate(frames)]
    return JointFit(shots.table.values, followed, every, _objective(shots.starts, shots.frames, shots.found))


# ----------------------------------------------------------------------------------------------------
# Covariance of the shared numbers of whole shots, and which of them the shots do not identify.


FOLLOWING_STEPS = 3  # of the starts after a number has been changed
PROFILE_STEPS, PROFILE_TOLERANCE = 6, 0.05  # of a profile's other numbers; of the deviance
TOLD_APART = 0.866  # least correlation of the errors of two numbers that are one: with the other known its bar were half as large
OF_LINES = ("length", "width", "center")
Followed = tuple[TableNumbers | None, list[Refined]]


@dataclass(frozen=True, eq=False)
class Optimum:
    """N shots at the optimum of the P shared numbers. Their deviance is a sum of squares, in errors of independent frames."""

    model: TableModel
    values: Array
    """(P,)"""
    starts: Sequence[ShotStart]
    frames: Sequence[int]
    found: Sequence[Refined]
    weights: Array
    """(N,) of the squares of each shot."""
    said: Information
    """Without these weights."""

    @classmethod
    def of_few(cls, model: TableModel, fitted: JointFit, starts: Sequence[ShotStart]) -> Optimum:
        """Return the optimum on one table for all shots; each counts by its independent residuals over its mean square."""
        table, used = model.at(fitted.values), [i for i, n in enumerate(fitted.frames) if n]
        some, ends = [starts[i] for i in used], [fitted.frames[i] for i in used]
        got = [refined(table, one, n, 9, 2) for one, n in zip(some, ends, strict=True)]
        weights = weights_of_shots(some, ends, got) * independent_residuals(table, some, ends, got)
        said = information_of_shots(table, some, ends, got)
        return cls(model, fitted.values, some, ends, got, weights, said)

    @classmethod
    def of_scatter(cls, model: TableModel, fitted: ScatterFit, frames: Sequence[int]) -> Optimum:
        """Return the optimum with numbers that scatter from shot to shot."""
        some, ends = [fitted.starts[i] for i in fitted.used], [frames[i] for i in fitted.used]
        return cls(model, fitted.values, some, ends, fitted.found, np.ones(len(some)), fitted.information)

    @property
    def information(self) -> Array:
        """(P, P) of the numbers, with all starts free."""
        return np.asarray(self.said.weighted(self.weights)[1].sum(axis=0))

    def deviance(self, found: Sequence[Refined]) -> float:
        """Return the deviance of starts."""
        return float(sum(weight * one.cost for weight, one in zip(self.weights.tolist(), found, strict=True)))

    def followed(self, values: Array) -> tuple[float, Followed]:
        """Return the deviance at other numbers (P,), the starts projected along and fitted again; inf where no table has these."""
        try:
            table = self.model.at(values)
        except CaromError:
            return math.inf, (None, [])
        each = zip(self.starts, self.frames, self.found, self.said.follows, strict=True)
        found = [
            refined(table, one, n, FOLLOWING_STEPS, 0, got.sigma, got.start + along @ (values - self.values))
            for one, n, got, along in each
        ]
        return self.deviance(found), (table, found)

    def scores(self, at: Followed) -> tuple[Array, Array]:
        """Return -1/2 of the gradient of the deviance (P,), and 1/2 of its curvature (P, P)."""
        assert at[0] is not None
        scores, matrices = information_of_shots(at[0], self.starts, self.frames, at[1]).weighted(self.weights)
        return scores.sum(axis=0), matrices.sum(axis=0)


@dataclass(frozen=True, eq=False)
class _Profile:
    """Shots whose starts follow the shared numbers, one of which is held; the others are given in usual changes."""

    at: Optimum
    scale: Array
    low: Array
    high: Array
    i: int
    held: float

    def values(self, changes: Array) -> Array:
        values = np.insert(changes * np.delete(self.scale, self.i), self.i, self.held)
        return np.asarray(np.clip(values, self.low, self.high))

    def tried(self, changes: Array) -> tuple[float, Followed]:
        return self.at.followed(self.values(changes))

    def taken(self, _changes: Array, tried: Followed) -> tuple[float, Array, Array]:
        score, matrix = self.at.scores(tried)
        score, matrix = score * self.scale, matrix * self.scale[:, None] * self.scale
        rest = np.delete(np.arange(len(score)), self.i)
        return self.at.deviance(tried[1]), score[rest], matrix[np.ix_(rest, rest)]


class _Subject:
    """Whole shots, for :func:`carom.fitting.identify.identify`."""

    def __init__(self, at: Optimum, label: str) -> None:
        shared = at.model.shared
        self.at, self.label, self.trade_offs, self.values = at, label, False, at.values
        self.names = tuple(one.name for one in shared)
        self.parameters = tuple(Parameter(one.name, one.low, one.high, (one.value,), one.value) for one in shared)
        self.scale = np.array([one.scale for one in shared])
        self.ranges = np.array([one.high - one.low for one in shared])
        self.information = at.information
        self.least = at.deviance(at.found)

    def covariance(self, inside: NDArray[np.int64]) -> Array:
        """Return the covariance of some numbers, with all others free in the directions that are identified."""
        return identified_covariance(self.information, self.ranges)[np.ix_(inside, inside)]

    def rise(self, i: int, value: float) -> float:
        """Return the deviance above its minimum with one number changed and the starts fitted again."""
        values = self.values.copy()
        values[i] = value
        return self.at.followed(values)[0] - self.least

    def refit_rises(self, i: int, values: Array, start: Array | None = None) -> tuple[Array, Array]:
        """Return the profile above its minimum, and the numbers there; from the minimum, or from numbers ``start`` (m, P)."""
        low, high = (np.array([getattr(one, end) for one in self.parameters]) for end in ("low", "high"))
        rest = np.delete(np.arange(len(low)), i)
        # where the information says that the others go
        along = -np.linalg.pinv(self.information[np.ix_(rest, rest)], hermitian=True) @ self.information[rest, i]
        rises, found = [], []
        for j, value in enumerate(values.tolist()):
            begin = self.values[rest] + along * (value - self.values[i]) if start is None else start[j, rest]
            profile = _Profile(self.at, self.scale, low, high, i, value)
            ends = (np.clip(one, low[rest], high[rest]) / self.scale[rest] for one in (begin, low[rest], high[rest]))
            best = descend_shared(profile, *ends, steps=PROFILE_STEPS, tolerance=PROFILE_TOLERANCE)
            found.append(profile.values(best))
            rises.append(profile.tried(best)[0] - self.least)
        return np.array(rises), np.array(found)


def identified(at: Optimum, label: str, enlarge: float = 1.0) -> Identified:
    """Return covariance and estimates of the shared numbers, and those that the shots do not identify; ``enlarge``: error bars."""
    found = identify(_Subject(at, label))
    wider = {name: replace(one, stderr=one.stderr and enlarge * one.stderr) for name, one in found.estimates.items()}
    return in_combination(replace(found, covariance=enlarge**2 * found.covariance, estimates=wider), at.values, label)


def in_combination(found: Identified, values: Array, label: str) -> Identified:
    """Return the numbers with those that are not told apart named with what is known of them: a combination.

    The yield of cushions moves the place where a ball turns by its speed times a time, as their lines do at one speed: two error
    bars of one measurement, between which an error of the law is divided.
    """
    bars, names = np.sqrt(np.diag(found.covariance)), list(found.estimates)
    with np.errstate(all="ignore"):
        rho = found.covariance / np.outer(bars, bars)
    pairs = [(i, j) for i, j in np.argwhere(np.abs(rho) > TOLD_APART).tolist()
             if any(one in OF_LINES for one in names[i].split(".")) and names[j].endswith("yield_time")]  # fmt: skip
    sentences = []
    for i, j in pairs:
        by = -found.covariance[i, j] / found.covariance[j, j]
        sum_of_both = Estimate(float(values[i] + by * values[j]), float(bars[i] * math.sqrt(1 - rho[i, j] ** 2)))
        sentences.append(
            f"{label}: {names[i]} and {names[j]}: only {names[i]} {'-' if by < 0 else '+'} {abs(by):.3g} {names[j]} ="
            f" {with_error_bar(sum_of_both)} is identifiable, not each value; fix one"
        )
    lost = [name for k, name in enumerate(names) if any(k in pair for pair in pairs)]
    covariance = found.covariance.copy()
    for k in (names.index(name) for name in lost):
        covariance[k, :] = covariance[:, k] = np.nan
    estimates = found.estimates | {name: Estimate(None, None, NOT_IDENTIFIABLE) for name in lost}
    untold = tuple(name for name in names if name in lost or name in found.untold)
    return Identified(covariance, estimates, (*found.degenerate, *sentences), untold)


# ----------------------------------------------------------------------------------------------------
# Fits of several laws to the same shots, each searched again from the optimum of the others.


ROUNDS = 2  # in which laws are searched from each other's optimum; in the first also with tables of the shots' own
BOTH = (False, True)  # ways to descend: from the optimum that is given, and with tables of the shots' own before
ENOUGH = 1.0  # of the deviance: less than this in a round ends the search


@dataclass(frozen=True, eq=False)
class _Tried:
    """A law, and the best that has been found for it."""

    model: TableModel
    values: Array
    starts: list[ShotStart]
    deviance: float


@dataclass(frozen=True)
class _Search:
    """The shots to which laws are fitted."""

    frames: Sequence[int]
    noise: float

    def at(self, model: TableModel, values: Array, starts: Sequence[ShotStart]) -> _Tried:
        """Return a law at values (P,), with copies of starts."""
        mine = [_copied(start) for start in starts]
        squares = mean_squares(model.at(values), mine, self.frames)
        return _Tried(model, values, mine, deviance_of(squares, mine, self.frames, self.noise)[0])

    def within(self, one: _Tried, other: _Tried) -> _Tried:
        """Return a law at the optimum of another, if that is better: a law that contains another is never farther."""
        if one.deviance <= other.deviance:
            return one
        here = self.at(one.model, _values_of(one, other)[0], other.starts)
        return here if here.deviance < one.deviance else one

    def searched(self, one: _Tried, other: _Tried, ways: Sequence[bool]) -> _Tried:
        """Return a law searched again from the optimum of another, with the starts of both, if that is better."""
        one, (_same, begin) = self.within(one, other), _values_of(one, other)
        starts = [_copied(mine) for mine in one.starts]
        for mine, more, n in zip(starts, other.starts, self.frames, strict=True):
            mine.pool.append(more.best[n])
        found = [one]
        for loosened in ways:
            copies = [_copied(start) for start in starts]
            fit = fit_shared(one.model, begin, copies, self.frames, self.noise, lambda _done: None, loosened)
            found.append(self.at(one.model, fit.values, copies))
        return min(found, key=lambda tried: tried.deviance)


def _copied(one: ShotStart) -> ShotStart:
    return ShotStart(one.shot, one.prior, dict(one.best), list(one.pool))


def _values_of(one: _Tried, other: _Tried) -> tuple[Array, Array]:
    """Return the numbers (P,) of a law at the optimum of another, and those from which its search begins: numbers that the other
    does not have are a usual change away, where some have no derivative."""
    there = one.model.values_in(other.model.scene_at(other.values))
    values = np.where(np.isnan(there), one.values, there)
    begin, known = values.copy(), {number.name for number in other.model.shared}
    for k, number in enumerate(one.model.shared):
        if number.name not in known:
            away = -number.scale if number.name.endswith("at_speed") else number.scale
            begin[k] = np.clip(values[k] + away, number.low, number.high)
    return values, begin


def searched_together(fits: Sequence[ShotsFit], tell: Callable[[float, str], None]) -> list[ShotsFit]:
    """Return fits of several laws to the same shots, each searched again from the optimum of the best, and the best from theirs.

    Where each was searched for by itself, the place at which a search ends would decide between laws.
    """
    order = sorted(fits, key=lambda one: -one.aicc)
    search = _Search([frames_of_events(one.shot, order[-1].events) for one in order[-1].starts], order[-1].noise)
    tried = []
    for one in order:
        values, starts = one.one_table
        model = replace(one.model, scene=one.model.scene_at(values))
        tried.append(search.at(model, values, starts))
    _search_all(search, tried, lambda done, k: tell(done, f"{order[k].law.name}: from the other's optimum"))
    return [replace(one, deviance=min(one.deviance, found.deviance)) for one, found in zip(order, tried, strict=True)]


def _search_all(search: _Search, tried: list[_Tried], tell: Callable[[float, int], None]) -> None:
    """Search for each law, and the best, the last, from each other's optimum; and from those of laws with fewer numbers."""
    own = len(tried) - 1
    smaller = [(k, j) for k in range(own) for j in range(own) if set(tried[j].model.paths) < set(tried[k].model.paths)]
    pairs = [pair for k in range(own) for pair in ((k, own), (own, k))] + smaller
    for turn in range(ROUNDS):
        before = [one.deviance for one in tried]
        for i, (k, j) in enumerate(pairs):
            tell((turn + i / len(pairs)) / ROUNDS, min(k, j))
            tried[k] = search.searched(tried[k], tried[j], BOTH if turn == 0 else BOTH[:1])
        if all(old - one.deviance < ENOUGH for old, one in zip(before, tried, strict=True)):
            break
    old: list[_Tried] = []
    while old != tried:
        old = list(tried)
        for k, j in pairs:
            tried[k] = search.within(tried[k], tried[j])
