"""Shots that could be filmed, as rows of a fit: what would be measured of each if a law were true, without noise.

A shot whose spin nobody will know is many rows without spin, of spins that it may have had and errors of what will be measured,
Sobol's points, each error there and back; together they count as one. (Without errors its worth is off by as much as it is.)
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from carom.fitting.data import Problem, Setting, make_problem
from carom.fitting.fit import predict_law
from carom.fitting.laws import FittedLaw
from carom.fitting.parameters import INDEX
from carom.rebounds import COLUMNS, Kind, Rebounds, make_rebounds

if TYPE_CHECKING:
    from carom.fitting.design import Shot, Shots

__all__ = ["Candidates", "candidates"]

Array = NDArray[np.float64]
POINTS = 5  # 2^5 of Sobol's for a shot whose spin nobody will know: its worth in 2 log odds is told to 0.02 then


@dataclass(frozen=True, eq=False)
class Candidates:
    """M shots that can be made, so many rows each, behind the rows that were filmed."""

    problem: Problem
    truth: Array
    """All numbers of the law that is taken for true."""
    have: int
    """Rows that were filmed."""
    each: int
    """Rows of a shot."""
    axes: tuple[Array, Array, Array]
    """Angles (degrees), speeds and spins, M in all; one spin, NaN, where nobody will know it."""

    @property
    def cells(self) -> NDArray[np.int64]:
        """(M,) the shots' numbers."""
        return np.arange((len(self.problem.x) - self.have) // self.each)

    @property
    def some(self) -> Problem:
        """Few enough rows to begin a fit with."""
        return self.problem.select(self.of(self.cells[:: max(self.each // 4, 1)]).ravel())

    def of(self, cells: NDArray[np.int64]) -> NDArray[np.int64]:
        """(m, K) the rows of some shots."""
        return self.have + cells[:, None] * self.each + np.arange(self.each)

    def shot(self, cell: int, repeat: int, gain: float) -> Shot:
        """A shot as people plan it."""
        from carom.fitting.design import Shot

        places = np.unravel_index(cell, [len(axis) for axis in self.axes])
        angle, speed, spin = (float(axis[place]) for axis, place in zip(self.axes, places, strict=True))
        return Shot(round(angle, 6), round(speed, 9), None if np.isnan(spin) else spin, repeat, gain)


def candidates(
    kind: Kind,
    setting: Setting,
    shots: Shots,
    law: FittedLaw,
    truth: Mapping[str, float] | Callable[[Problem], Array],
    filmed: Problem | None,
) -> Candidates:
    """The rows; ``truth``: numbers of the law by name, or all of them, as a function of the problem with all rows says."""
    from carom.fitting.design import numbers_of

    axes = tuple(
        np.array([np.nan]) if ends is None else np.linspace(*ends, count) if ends[1] > ends[0] else np.array([ends[0]])
        for ends, count in zip((shots.angles, shots.speeds, shots.spins), shots.counts, strict=True)
    )
    nodes = _points(setting) if shots.spins is None else np.zeros((1, 6))
    grid, _notes = make_problem(_rows(kind, shots, axes, len(nodes)), setting)
    problem, have = grid, 0
    if filmed is not None:
        problem, have = _joined(filmed, grid), len(filmed.x)
    p = truth(problem) if callable(truth) else numbers_of(law, problem, truth)
    spin, before, after = (np.tile(part, (len(grid.x) // len(nodes), 1)) for part in np.split(nodes, [1, 3], axis=1))
    x, y = problem.x.copy(), problem.y.copy()
    v_n, v_t = x[have:, 0], x[have:, 1]
    if shots.spins is None:
        off = spin[:, 0] * p[INDEX["spin_width"]] * np.hypot(v_n, v_t)
        x[have:, 2] = (p[INDEX["spin_mean"]] * v_t + off) / setting.radius
    there = predict_law(law, replace(problem, x=x, spins=None), p)[have:]
    y[have:] = np.where(np.isnan(y[have:]), np.nan, there + after * np.sqrt(grid.vy))
    x[have:, :2] += before * np.sqrt(grid.vx[:, :2])
    x[have:, 2] = grid.x[:, 2]
    return Candidates(replace(problem, x=x, y=y), p, have, len(nodes), axes)  # type: ignore[arg-type]


def _points(setting: Setting) -> Array:
    """A spin, in widths of the prior about its mean, errors of v_n and v_t before and of all after the wall, in error bars."""
    from scipy.stats import norm, qmc

    shares = qmc.Sobol(6, seed=0).random_base2(POINTS)
    found = norm.ppf(shares)
    if setting.spin_prior == "uniform":
        found[:, 0] = 2 * shares[:, 0] - 1
    return np.concatenate([found, found * [1, -1, -1, -1, -1, -1]])


def _rows(kind: Kind, shots: Shots, axes: tuple[Array, ...], each: int) -> Rebounds:
    """A table of all shots, each as so many rows; what is measured after the wall is still to come."""
    angle, speed, spin = (np.repeat(x.ravel(), each) for x in np.meshgrid(*axes, indexing="ij"))
    names = COLUMNS[kind]
    v_n, v_t = speed * np.cos(np.radians(angle)), speed * np.sin(np.radians(angle))
    columns = dict(zip(names, (v_n, v_t, spin, v_n, v_t, np.zeros(len(spin))), strict=True))
    for name in names:
        if name.startswith("v"):
            columns[f"sigma_{name}"] = np.full(len(spin), shots.sigma_v)
        elif shots.sigma_spin is not None:
            columns[f"sigma_{name}"] = np.where(np.isnan(columns[name]), np.nan, shots.sigma_spin)
    if shots.sigma_spin is None:
        columns[names[5]] = np.full(len(spin), np.nan)
    return make_rebounds(kind, columns, stage=shots.stage if kind == "table" else None, source="shots")


def _joined(first: Problem, second: Problem) -> Problem:
    """The rows of both. What rows of the first have wrong together is none of the second's errors."""
    x, vx, y, vy = (
        np.concatenate(pair)
        for pair in ((first.x, second.x), (first.vx, second.vx), (first.y, second.y), (first.vy, second.vy))
    )
    stages = None if first.stages is None or second.stages is None else np.concatenate([first.stages, second.stages])
    shared = tuple(replace(one, rows=np.pad(one.rows, ((0, len(second.x)), (0, 0)))) for one in first.shared)
    measured = {
        name: np.concatenate([first.rebounds[name], second.rebounds[name]]) for name in COLUMNS[first.rebounds.kind]
    }
    names = None if first.rebounds.stage is None else np.concatenate([first.rebounds.stage, second.rebounds.stage])
    rebounds = replace(second.rebounds, columns=measured, sigma={}, stage=names, extra={}, rows=())
    return replace(
        second,
        rebounds=rebounds,
        x=x,
        vx=vx,
        y=y,
        vy=vy,
        stages=stages,
        shared=shared,
        spins=first.spins or second.spins,
    )
