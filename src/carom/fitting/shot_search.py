"""Search for a plan of shots: greedy, improved by exchange, and checked from all starting points of the fit.

Atkinson & Fedorov, Biometrika 62, 57 (1975): the next shot is the one for which the other law, fitted to the shots so far, is off
by most error bars; in the best plan all shots have the same gain, the largest. Those that were added first seldom have, so shots
are moved at the end, as long as the odds grow.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from carom.fitting.candidate_shots import Candidates
from carom.fitting.fit import fit_law
from carom.fitting.result import Fit, refit, rows_of_fit

__all__ = ["LEAST_GAIN", "ShotSearch", "deviances", "gains"]

Array = NDArray[np.float64]
MAX_SHOTS = 400
MOST_OMITTED = 12  # places of a plan for which the odds with one shot less are computed
REVIEW_EVERY, SHORT_LIST = (
    8,
    20,
)  # of shots with many rows only the best so far are evaluated, and all of them occasionally
LEAST_GAIN = 1e-3  # of 2 log odds: with a smaller gain a shot does not discriminate
LEAST_MARGINAL_GAIN = 0.02  # the same for a shot whose spin is not measured: the precision of its gain


def deviances(fit: Fit, rows: Candidates) -> Array:
    """Return the deviance of each row under the law of a fit: zero under the true one, unless measured or its spin is unknown."""
    return rows_of_fit(fit, rows.problem, rows.truth)[0]


def gains(fit: Fit, rows: Candidates, plain: Array, cells: NDArray[np.int64], best: Array) -> Array:
    """Return the expected gain of one more of each of these shots."""
    some = rows.of(cells)
    left = rows_of_fit(fit, rows.problem.select(some.ravel()), best[0])[0] - plain[some.ravel()]
    return left.reshape(some.shape).mean(axis=1)  # type: ignore[no-any-return]


class ShotSearch:
    """A plan as it grows.

    ``plain``, ``owed``: deviance under the true law of each row, and of shared errors. Afterwards: ``order``, shots as they were
    added; ``best``, parameters of the other law; ``so_far`` and ``total``, 2 log odds of the filmed shots and of all; ``over``,
    whether no shot has a gain; ``fewer``, 2 log odds of the plan with one shot less, by shot.
    """

    def __init__(self, fit: Fit, rows: Candidates, plain: Array, owed: float, target: float) -> None:
        self.fit, self.rows, self.plain, self.owed, self.target = fit, rows, plain, owed, target
        self.start = fit.numbers[None]
        self.weights = np.zeros(len(rows.problem.x))
        self.weights[: rows.have] = 1
        self.order: list[int] = []
        self.over = False
        self.fewer: dict[int, float] = {}
        self.best, self.so_far = self.start, 0.0
        if rows.have:
            self.best, self.so_far = self.lost()
        self.total = self.so_far
        self._add_shots()
        if not self.over and self.total >= target:
            if len(self.order) > 1:
                self._exchange()
                self._omit()
            if len(self.order) > 1 and len(set(self.order)) <= MOST_OMITTED:
                self.fewer = {cell: self.without(cell)[1] for cell in sorted(set(self.order))}

    def gain(self, cells: NDArray[np.int64] | None = None) -> Array:
        """Return the expected gain of one more of these shots, of all by default."""
        return gains(self.fit, self.rows, self.plain, self.rows.cells if cells is None else cells, self.best)

    def lost(self, whole: bool = False) -> tuple[Array, float]:
        """Fit the other law to the shots so far; return its parameters, and its deviance above the true law's.

        It begins at the last minimum and at the first starting point: there may be two minima; ``whole``: and at the end of a
        search from all starting points.
        """
        some = np.flatnonzero(self.weights)
        weights, begin = self.weights[some], [self.best, self.start]
        if whole and self.rows.each == 1:
            repeated = np.repeat(some, np.rint(weights).astype(int))
            begin.append(fit_law(self.fit.law, self.rows.problem.select(repeated)).numbers[None])
        found, all_deviances = refit(
            self.fit, self.rows.problem.select(some), np.tile(weights, (len(begin), 1)), np.concatenate(begin)
        )
        above = float(all_deviances.min() - (self.weights * self.plain).sum() - self.owed)
        return found[[int(np.argmin(all_deviances))]], above

    def without(self, cell: int) -> tuple[Array, float]:
        """Return the other law's parameters, and 2 log odds, with one shot less of those at a place."""
        self._change(cell, -1)
        found = self.lost(whole=True)
        self._change(cell, 1)
        return found

    def _change(self, cell: int, by: int) -> None:
        self.weights[self.rows.of(np.array([cell]))] += by / self.rows.each

    def _add_shots(self) -> None:
        """Add the shot with the largest gain, until the odds are reached."""
        rows, target = self.rows, self.target
        cells, least = rows.cells, LEAST_GAIN if rows.each == 1 else LEAST_MARGINAL_GAIN
        while self.total < (target if rows.have else max(target, 1e-9)) and len(self.order) < MAX_SHOTS:
            if rows.each == 1 or len(self.order) % REVIEW_EVERY == 0:
                cells = rows.cells
            gain = self.gain(cells)
            if gain.max() < least and len(cells) < len(rows.cells):
                cells, gain = rows.cells, self.gain()
            new = int(np.argmax(gain))
            if gain[new] < least:
                self.over = True
                return
            self.order.append(int(cells[new]))
            self._change(int(cells[new]), 1)
            self.best, self.total = self.lost()
            if self.total >= target:  # in another minimum the other law may follow them
                self.best, self.total = self.lost(whole=True)
            if len(self.order) > 60 and self.total - self.so_far < len(self.order) * (target - self.so_far) / MAX_SHOTS:
                return
            cells = cells[np.argsort(-gain, kind="stable")[:SHORT_LIST]]

    def _exchange(self) -> None:
        """Move shots that have little gain left to where it is largest, as long as the odds grow."""
        cells = self.rows.cells
        for _ in range(2 * len(self.order)):
            gain = self.gain(cells)
            new = int(cells[np.argmax(gain)])
            left = dict(zip(cells.tolist(), gain.tolist(), strict=True))
            old = min(self.order, key=left.__getitem__)
            if left[new] <= left[old]:
                return
            self._change(old, -1)
            self._change(new, 1)
            best, total = self.lost(whole=True)
            if total <= self.total:
                self._change(new, -1)
                self._change(old, 1)
                return
            self.order[self.order.index(old)] = new
            self.best, self.total = best, total
            if self.rows.each > 1:
                cells = np.union1d(self.order, cells[np.argsort(-gain, kind="stable")[:SHORT_LIST]])

    def _omit(self) -> None:
        """Omit shots without which the odds are reached as well."""
        while len(self.order) > 1 and len(set(self.order)) <= MOST_OMITTED:
            fewer = {cell: self.without(cell) for cell in sorted(set(self.order))}
            old = max(fewer, key=lambda cell: fewer[cell][1])
            if fewer[old][1] < self.target:
                return
            self.order.remove(old)
            self._change(old, -1)
            self.best, self.total = fewer[old]
