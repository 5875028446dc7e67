"""Candidate shots as rows of a fit: the measurements of each if a law were true, without noise.

A shot whose spin will not be measured is represented by many rows without spin, with sampled spins and measurement errors (Sobol
points, each error with both signs), which together count as one. (Without the errors its gain would be wrong by its own size.)
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.data.rebounds import COLUMNS, Kind, Rebounds, make_rebounds
from carom.errors import CaromError
from carom.fitting.data import Problem, make_problem
from carom.fitting.laws import FittedLaw
from carom.fitting.model import model_of, predict_law
from carom.fitting.parameters import INDEX
from carom.fitting.setting import Setting

__all__ = ["Candidates", "Shot", "Shots", "candidates", "numbers_of"]

Array = NDArray[np.float64]
LOG2_POINTS = 5  # Sobol points of a shot whose spin will not be measured: they give its gain in 2 log odds to 0.02
PLAIN_VALUES = {"restitution": 0.8, "friction": 0.2, "tangential_restitution": 0.4}


@dataclass(frozen=True)
class Shots:
    """Ranges of shots that can be made, and the precision of their measurement."""

    angles_deg: tuple[float, float] = (5.0, 75.0)
    """Incidence from the wall's normal."""
    speeds: tuple[float, float] = (1.0, 3.0)
    """m/s."""
    spins: tuple[float, float] | None = (0.0, 0.0)
    """rad/s before the wall; None: not measured, as in a film without marks on the ball."""
    sigma_v: float = 0.02
    """Error bar of each speed, before and after, m/s."""
    sigma_spin: float | None = None
    """Error bar of each spin, rad/s; None: spin is known before the wall and not measured after it."""
    stage: str = "after_wall"
    """Stage at which a ball on a table is measured: after_wall or rolling."""
    counts: tuple[int, int, int] = (29, 5, 9)
    """Numbers of angles, speeds and spins of the grid."""


@dataclass(frozen=True)
class Shot:
    """A shot to film, ``repeat`` times."""

    angle_deg: float
    speed: float
    spin: float | None
    """None: not measured."""
    repeat: int
    gain: float
    """Expected increase of 2 log odds by one more such shot: misfit of the other law there, once it is fitted to the whole plan."""
    without: float | None = None
    """Expected 2 log odds of the plan with one such shot less, None if not computed. A shot with little gain can be indispensable:
    it determines parameters of the other law, which then cannot follow the other shots."""


@dataclass(frozen=True, eq=False)
class Candidates:
    """M candidate shots of several rows each, after the rows that were filmed."""

    problem: Problem
    truth: Array
    """All parameters of the law that is assumed to be true."""
    have: int
    """Number of rows that were filmed."""
    each: int
    """Rows per shot."""
    axes: tuple[Array, Array, Array]
    """Angles (degrees), speeds and spins, M in all; one spin, NaN, where it is not measured."""

    @property
    def cells(self) -> NDArray[np.int64]:
        """(M,) indices of the shots."""
        return np.arange((len(self.problem.x) - self.have) // self.each)

    @property
    def some(self) -> Problem:
        """The problem with a number of rows small enough to begin a fit."""
        return self.problem.select(self.of(self.cells[:: max(self.each // 4, 1)]).ravel())

    def of(self, cells: NDArray[np.int64]) -> NDArray[np.int64]:
        """Return the rows (m, K) of some shots."""
        return self.have + cells[:, None] * self.each + np.arange(self.each)

    def shot(self, cell: int, repeat: int, gain: float) -> Shot:
        """Return a shot of the plan."""
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
    """Return the rows; ``truth``: parameters of the law by name, or a function of the problem that gives all of them."""
    axes = tuple(
        np.array([np.nan]) if ends is None else np.linspace(*ends, count) if ends[1] > ends[0] else np.array([ends[0]])
        for ends, count in zip((shots.angles_deg, shots.speeds, shots.spins), shots.counts, strict=True)
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


def numbers_of(law: FittedLaw, problem: Problem, truth: Mapping[str, float]) -> Array:
    """Return all parameters of a law, with the given values; CaromError for an unknown one."""
    model = model_of(law, problem)
    free, p = model.parameters, model.start.copy()
    plain = PLAIN_VALUES | {"stiffness_ratio": p[INDEX["stiffness_ratio"]]}
    faults = [
        f"truth: expected a parameter of {law.name}, one of {', '.join(free) or 'none'}, got {name!r}"
        for name in truth
        if name not in free
    ]
    if faults:
        raise CaromError(*faults)
    for name, parameter in free.items():
        value = truth.get(name, plain.get(name, parameter.starts[0]))
        if not parameter.low <= value <= parameter.high:
            raise CaromError(f"truth: {name}: expected {parameter.low:g} to {parameter.high:g}, got {value:g}")
        p[model.places[name]] = value
    return p


def _points(setting: Setting) -> Array:
    """Return nodes: a spin, in widths of the prior about its mean, errors of v_n and v_t before and of all after the wall."""
    from scipy.stats import norm, qmc

    shares = qmc.Sobol(6, seed=0).random_base2(LOG2_POINTS)
    found = norm.ppf(shares)
    if setting.spin_prior == "uniform":
        found[:, 0] = 2 * shares[:, 0] - 1
    return np.concatenate([found, found * [1, -1, -1, -1, -1, -1]])


def _rows(kind: Kind, shots: Shots, axes: tuple[Array, ...], each: int) -> Rebounds:
    """Return a table of all shots, each as several rows; the measurements after the wall are filled in later."""
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
    """Return the rows of both problems; shared errors of the first do not apply to the second."""
    names = ("x", "vx", "covariance", "y", "vy")
    arrays: dict[str, Any] = {name: np.concatenate([getattr(first, name), getattr(second, name)]) for name in names}
    stages = None if first.stages is None or second.stages is None else np.concatenate([first.stages, second.stages])
    shared = tuple(replace(one, rows=np.pad(one.rows, ((0, len(second.x)), (0, 0)))) for one in first.shared)
    measured = {
        name: np.concatenate([first.rebounds[name], second.rebounds[name]]) for name in COLUMNS[first.rebounds.kind]
    }
    stage = None if first.rebounds.stage is None else np.concatenate([first.rebounds.stage, second.rebounds.stage])
    rebounds = replace(second.rebounds, columns=measured, sigma={}, stage=stage, extra={}, rows=())
    spins = first.spins or second.spins
    return replace(second, rebounds=rebounds, stages=stages, shared=shared, spins=spins, **arrays)
