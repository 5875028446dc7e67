"""Covariance of the shared numbers of whole shots, and which of them the shots do not identify."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from carom.errors import CaromError
from carom.fitting.identifiability import NOT_IDENTIFIABLE, Identified, identified_covariance, identify
from carom.fitting.parameters import Parameter
from carom.fitting.result import Estimate, with_error_bar
from carom.fitting.shots.joint import (
    Information,
    JointFit,
    ScatterFit,
    independent_residuals,
    information_of_shots,
    weights_of_shots,
)
from carom.fitting.shots.search import Refined, ShotStart, refined
from carom.fitting.shots.table import TableModel
from carom.fitting.starts import descend_shared
from carom.fitting.table_numbers import TableNumbers

__all__ = ["Optimum", "identified", "in_combination"]

Array = NDArray[np.float64]
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
    """Whole shots, for :func:`carom.fitting.identifiability.identify`."""

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


def identified(at: Optimum, label: str) -> Identified:
    """Return covariance and estimates of the shared numbers, and those that the shots do not identify."""
    return in_combination(identify(_Subject(at, label)), at.values, label)


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
