"""Fits of several laws to the same shots, each searched again from the optimum of the others."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from carom.fitting.shots.joint import deviance_of, fit_shared, frames_of_events, mean_squares
from carom.fitting.shots.result import ShotsFit
from carom.fitting.shots.search import ShotStart
from carom.fitting.shots.table import TableModel

Array = NDArray[np.float64]
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
