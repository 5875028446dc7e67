"""Rebounds as arrays for the likelihood: measurements, variances, shared errors, the grid of unmeasured spins."""

from __future__ import annotations

import functools
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.data.energy import energy_remarks
from carom.data.headers import DIRECTION_COLUMN, DIRECTION_UNIT
from carom.data.rebounds import COLUMNS, STAGES, Rebounds
from carom.errors import CaromError
from carom.fitting.kernels import AFTER_WALL, DIRECTION
from carom.fitting.setting import Setting
from carom.fitting.shared_errors import SHARED, Shared, film_says, numbers_of, shared_errors, shared_in_words
from carom.fitting.spin_chains import chains_of
from carom.fitting.spin_mixture import SpinMixture
from carom.fitting.spin_quadrature import SpinGrid, sigma_grid

__all__ = ["Problem", "make_problem", "prior_in_words"]

Array = NDArray[np.float64]
MAX_SHARED_VARIANCE = 0.95  # of a variance: the rest is a row's own
MAX_CORRELATION = 0.95  # of errors before and after: a row with fully correlated errors would carry no information
FLOOR_FRICTION = 0.2  # of a billiard table, by default
CARRIED_WORK = 10  # in that of a spin that is integrated over by itself
LEAST_UNITS = 3  # films, shots or chains that rows are divided into
FEW_DRAWN = 4  # spins from which the width of their prior is hardly known
FEW_ROWS, SAME_ANGLE, SAME_SPEED = 12, 3.0, 1.3  # rows; degrees; ratio of the fastest to the slowest


@dataclass(frozen=True)
class Problem:
    """N rebounds as arrays, with variances and the assumptions of the fit; made by :func:`make_problem`.

    Examples
    --------
    >>> from carom.data.rebounds import make_rebounds
    >>> from carom.fitting import Setting, make_problem
    >>> columns = {"v_n_in": [1.0, 2.0, 3.0], "v_t_in": [1.0] * 3, "spin_in": [0.0] * 3, "v_n_out": [0.8, 1.6, 2.4]}
    >>> columns |= {"v_t_out": [0.7, 0.8, 0.9], "sigma_v_n_out": 0.02, "sigma_v_t_out": 0.02}
    >>> problem, _notes = make_problem(make_rebounds("planar", columns), Setting(radius=0.02))
    >>> problem.select([0, 2]).x[:, 0], problem.count
    (array([1., 3.]), 6)
    """

    rebounds: Rebounds
    setting: Setting
    x: Array
    """(N, 3) before: v_n, v_t, spin (NaN: not measured)."""
    vx: Array
    """(N, 3) their variances."""
    covariance: Array
    """(N, 2) covariances of the errors of v_n before and after, and of v_t before and after."""
    y: Array
    """(N, 3) after; NaN: not measured."""
    vy: Array
    stages: NDArray[np.int64] | None
    spins: SpinGrid | None
    """Assumptions about unmeasured spins; None: all were measured."""
    estimated: NDArray[np.bool_]
    """(3,) whether an output has no error bars, so that its scatter is estimated."""
    shared: tuple[Shared, ...] = ()
    """Errors common to the rows of a film."""
    carried: bool = False
    """Whether unmeasured spins follow from those before the ball's last contact (:mod:`carom.fitting.spin_chains`)."""
    mixture: SpinMixture | None = None
    """The prior of unmeasured spins, where it is a mixture; None: normal or uniform."""

    @property
    def count(self) -> int:
        """Number of measurements after the wall."""
        return int(np.isfinite(self.y).sum())

    @property
    def unknown(self) -> NDArray[np.bool_]:
        """(N,) mask of rows whose spin before the wall was not measured."""
        return np.isnan(self.x[:, 2])

    @functools.cached_property
    def chains(self) -> NDArray[np.int64]:
        """(M, L) rows of contacts that follow each other (:func:`carom.fitting.spin_chains.chains_of`)."""
        return chains_of(self.rebounds)

    @functools.cached_property
    def units(self) -> NDArray[np.int64]:
        """(N,) number of the film, sheet, shot or chain of contacts of each row: rows of one are held out together.

        The largest of which there are enough; films not where their errors in common are fitted.
        """
        chain = np.empty(len(self.x), np.int64)
        for k, rows in enumerate(self.chains):
            chain[rows[rows >= 0]] = k
        levels = [*(() if self.shared else (("film",), ("sheet",))), ("film", "sheet", "shot")]
        for level in levels:
            labels = [self.rebounds.extra[name].astype(str).tolist() for name in level if name in self.rebounds.extra]
            numbers = _numbered(list(zip(*labels, strict=True)))
            if labels and numbers.max() >= LEAST_UNITS - 1:
                return numbers
        return _numbered(chain.tolist()) if self.carried or np.ptp(chain) >= LEAST_UNITS - 1 else np.arange(len(chain))

    def some(self, count: int) -> Problem:
        """Return the problem with about so many of its rows, of units that are far from each other."""
        if count >= len(self.x):
            return self
        kinds = int(self.units.max()) + 1
        chosen = np.linspace(0, kinds - 1, max(round(count * kinds / len(self.x)), 1)).astype(int)
        return self.select(np.isin(self.units, chosen))

    @property
    def drawn(self) -> NDArray[np.bool_]:
        """(N,) mask of rows whose spin before the wall is a draw of the prior."""
        if not self.carried:
            return self.unknown
        first = np.zeros(len(self.x), bool)
        first[self.chains[:, 0]] = True
        return self.unknown & first

    @property
    def nu(self) -> float:
        """Degrees of freedom of the errors; 0: normal."""
        return 4.0 if self.setting.robust else 0.0

    def select(self, rows: Any) -> Problem:
        """Return the problem with only some rows, from indices or a mask."""
        stages = None if self.stages is None else np.ascontiguousarray(self.stages[rows])
        names = ("x", "vx", "covariance", "y", "vy")
        arrays: dict[str, Any] = {name: np.ascontiguousarray(getattr(self, name)[rows]) for name in names}
        shared = tuple(replace(one, rows=np.ascontiguousarray(one.rows[rows])) for one in self.shared)
        return replace(self, rebounds=self.rebounds.select(rows), stages=stages, shared=shared, **arrays)

    def work(self, heavy: bool) -> float:
        """Return the number of law evaluations per evaluation of the likelihood; ``heavy``: of a costly law."""
        each = 0 if self.spins is None else len(self.spins.sigma) * (CARRIED_WORK if self.carried else 1)
        return float(len(self.x) + self.unknown.sum() * each) * (100.0 if heavy else 1.0)


def _numbered(labels: list[Any]) -> NDArray[np.int64]:
    """Return numbers of labels (N,), from 0 in the order in which they come."""
    numbers: dict[Any, int] = {}
    return np.array([numbers.setdefault(label, len(numbers)) for label in labels], np.int64)


def make_problem(rebounds: Rebounds, setting: Setting) -> tuple[Problem, list[str]]:
    """Return rebounds as arrays for a fit, and notes.

    Parameters
    ----------
    rebounds : Rebounds
    setting : Setting

    Returns
    -------
    Problem, and notes on assumptions and on properties of the data that limit any fit. Raises CaromError if a fit is impossible:
    too few rows, or no error bars where spins were not measured.

    Examples
    --------
    >>> from carom.data.rebounds import make_rebounds
    >>> from carom.fitting import Setting, make_problem
    >>> columns = {"v_n_in": [1.0, 2.0, 3.0], "v_t_in": [1.0] * 3, "spin_in": [0.0] * 3, "v_n_out": [0.8, 1.6, 2.4]}
    >>> columns |= {"v_t_out": [0.7, 0.8, 0.9], "sigma_v_n_out": 0.02, "sigma_v_t_out": 0.02}
    >>> problem, notes = make_problem(make_rebounds("planar", columns), Setting(radius=0.02))
    >>> problem.count
    6
    """
    names = COLUMNS[rebounds.kind]
    x = np.stack([rebounds[name] for name in names[:3]], axis=-1)
    y = np.stack([rebounds[name] for name in names[3:]], axis=-1)
    notes = _without_tangential(rebounds, x, y) or _without_spins(rebounds, setting, x, y)
    spins = names[5]
    seen = np.isfinite(y)

    def variance(name: str) -> Array:
        return np.square(np.nan_to_num(rebounds.sigma.get(name, np.zeros(len(rebounds)))))

    vx = np.stack([variance(name) for name in names[:3]], axis=-1)
    vy = np.stack([variance(name) for name in names[3:]], axis=-1)
    estimated = np.array([bool(seen[:, j].any()) and names[3 + j] not in rebounds.sigma for j in range(3)])
    unknown = np.isnan(x[:, 2])
    faults = _no_numbers(rebounds)
    covariance, wrong = _covariances(rebounds, np.where(estimated[:2], np.inf, np.sqrt(vx[:, :2] * vy[:, :2])))
    faults += wrong
    if estimated.any():
        lacks = ", ".join(f"sigma_{names[3 + j]}" for j in np.flatnonzero(estimated))
        if unknown.any() or setting.robust:
            why = (
                f"{names[2]} was not measured in {unknown.sum()} rows"
                if unknown.any()
                else "the robust fit is requested"
            )
            faults.append(
                f"{rebounds.source}: {lacks}: expected error bars, because {why} and its effect cannot be distinguished from"
                " scatter; got none; add the columns, or give `sigma_v` and `sigma_spin`"
            )
        else:
            notes.append(
                f"{lacks}: not given; the scatter is estimated for each law separately, so chi^2 cannot test any of them"
            )
        faults += _no_scatter(rebounds, setting, lacks)
        vy[:, estimated] = 1.0
    if len(rebounds) < 3:
        faults.append(f"{rebounds.source}: rows: expected at least 3 rebounds to fit, got {len(rebounds)}; film more")
    if faults:
        raise CaromError(*faults)
    exact = [name for name in names[:3] if name not in rebounds.sigma and np.nan_to_num(rebounds[name]).any()]
    if exact and rebounds.sigma:
        bars = ", ".join(f"sigma_{name}" for name in exact)
        notes.append(f"the table has no error bars {bars}: these are assumed to be exact before the wall")
    stages = _stages(rebounds)
    setting, floor, error = _with_floor(rebounds, setting.with_height())
    setting, held = _with_least_speed(setting, x[:, 0])
    notes += [*floor, *held]
    shared = () if estimated.any() else shared_errors(rebounds, names, error)
    if shared:  # each row keeps the rest of its variance
        square = np.sum([np.square(one.rows) for one in shared], axis=0)
        vx, vy = (v - np.minimum(s, MAX_SHARED_VARIANCE * v) for v, s in ((vx, square[:, :3]), (vy, square[:, 3:])))
        covariance = covariance - np.sum([one.rows[:, :2] * one.rows[:, 3:5] for one in shared], axis=0)
        notes.append(shared_in_words(shared))
    most = np.where(estimated[:2], 0.0, MAX_CORRELATION * np.sqrt(vx[:, :2] * vy[:, :2]))
    problem = Problem(
        rebounds, setting, x, vx, np.clip(covariance, -most, most), y, vy, stages, None, estimated, shared
    )
    if unknown.any():
        problem = replace(problem, spins=SpinGrid(sigma_grid(), setting.spin_prior == "uniform"))
        carried = rebounds.kind == "planar" and setting.chained and stages is None
        problem = replace(problem, carried=carried and not (replace(problem, carried=True).drawn == unknown).all())
        notes.append(_spins_in_words(problem, names[2]))
    notes += _warnings(problem, spins)
    return problem, notes


def _without_tangential(rebounds: Rebounds, x: Array, y: Array) -> list[str]:
    """Leave out of x and y (N, 3) what tells nothing where all balls come straight at the wall, and return a note on it."""
    if rebounds["v_t_in"].any() or rebounds["v_t_out"].any():
        return []
    y[:, 1] = np.nan
    if rebounds.kind == "table" or not np.isnan(x[:, 2]).any() or not np.isnan(y[:, 2]).all():
        return []
    x[:, 2] = np.nan_to_num(x[:, 2])
    return ["spin_in: not measured; taken as 0, since nothing along the wall was measured either"]


def _without_spins(rebounds: Rebounds, setting: Setting, x: Array, y: Array) -> list[str]:
    """Leave out of x and y (N, 3) what lies along the wall where no spin before it was measured and no error bar is known, and
    return a note on it: an unknown spin cannot be distinguished from scatter there. Not where spins after it were measured."""
    names = COLUMNS[rebounds.kind]
    bare = not rebounds.sigma and np.isnan(x[:, 2]).all() and np.isfinite(y[:, 0]).any() and not setting.robust
    if rebounds.kind != "planar" or not bare or np.isnan(y[:, 1]).all() or np.isfinite(y[:, 2]).any():
        return []
    x[:, 1], x[:, 2], y[:, 1:] = 0.0, 0.0, np.nan
    return [
        f"{names[2]} was not measured, and there are no error bars: what lies along the wall is left out, since a spin cannot be"
        " distinguished from scatter there; the restitution remains. Give `spin` (0: thrown without spin), or `sigma_v` and"
        " `sigma_spin`, to fit friction"
    ]


def _no_scatter(rebounds: Rebounds, setting: Setting, lacks: str) -> list[str]:
    """Return an error line where a scatter beyond error bars is asked for, and there are no error bars."""
    said = f"{rebounds.source}: scatter: expected error bars, beyond which contacts scatter, got no {lacks}"
    return [f"{said}; leave it out, all scatter is estimated then"] if setting.scatter else []


def _covariances(rebounds: Rebounds, most: Array) -> tuple[Array, list[str]]:
    """Return the covariances (N, 2) of the errors of v_n before and after and of v_t, 0 where not given, and their problems.
    ``most``: the products of the error bars.

    In a film the paths before and after a wall meet at one place and time, so the errors of their slopes are correlated.
    """
    found, faults = np.zeros((len(rebounds), 2)), []
    for o, name in enumerate(("v_n", "v_t")):
        found[:, o] = np.nan_to_num(numbers_of(rebounds, f"covariance_{name}"))
        wrong = np.flatnonzero(~(np.abs(found[:, o]) <= most[:, o] * (1 + 1e-6)))
        if len(wrong):
            label = rebounds.rows[wrong[0]] if rebounds.rows else f"row {wrong[0] + 1}"
            faults.append(
                f"{rebounds.source}: {label}: covariance_{name}: expected at most sigma_{name}_in times sigma_{name}_out,"
                f" {most[wrong[0], o]:.3g} m^2/s^2, got {found[wrong[0], o]:.3g}; omit the column if error bars were changed"
            )
    return found, faults


def _no_numbers(rebounds: Rebounds) -> list[str]:
    """Return one line per cell that is not a number in the columns of shared errors and covariances."""
    faults = []
    for name, column in rebounds.extra.items():
        prefixes = (*(f"{prefix}_" for prefix in SHARED), "covariance_", "floor_friction")
        if not name.removeprefix("sigma_").startswith(prefixes):
            continue
        for i, cell in enumerate(column.tolist()):
            try:
                float(cell or "nan")
            except ValueError:
                label = rebounds.rows[i] if rebounds.rows else f"row {i + 1}"
                faults.append(f"{rebounds.source}: {label}: {name}: expected a number, or an empty cell, got {cell!r}")
    return faults


def _stages(rebounds: Rebounds) -> NDArray[np.int64] | None:
    """Return at which stage, or in which unit, each row (N,) was measured after the wall, as kernels number it; None: all alike."""
    if rebounds.stage is not None:
        return np.array([STAGES.index(str(s)) for s in rebounds.stage])
    alone = directions_of(rebounds)
    return np.where(alone, DIRECTION, AFTER_WALL) if alone.any() else None


def directions_of(rebounds: Rebounds) -> NDArray[np.bool_]:
    """Return the rows (N,) of which only the direction after the wall was measured, whose v_t_out is in units of the speed."""
    column = rebounds.extra.get(DIRECTION_COLUMN)
    if column is None or rebounds.kind != "planar":
        return np.zeros(len(rebounds), bool)
    return np.array([str(cell) == DIRECTION_UNIT for cell in column.tolist()], bool)


def _with_floor(rebounds: Rebounds, setting: Setting) -> tuple[Setting, list[str], float]:
    """Return the setting with a floor friction, a note on its origin, and its error bar if it is from a film."""
    if setting.floor_friction is not None:
        return setting, [], 0.0
    if rebounds.kind == "planar":
        return replace(setting, floor_friction=FLOOR_FRICTION), [], 0.0
    found = film_says(rebounds, "floor_friction")
    fitted = "floor_friction" in setting.fit or "floor_friction" in setting.fixed
    if found is None:
        said = f"`floor_friction` is not given: assumed to be {FLOOR_FRICTION:g}; give it, or `fit` floor_friction"
        return replace(setting, floor_friction=FLOOR_FRICTION), [] if fitted else [said], 0.0
    value, error, films = found
    bar = f" ± {error:.2g}" if error else ""
    of = "from the film" if films == 1 else f"mean of {films} films"
    said = f"`floor_friction` is {value:.4g}{bar}, {of} (column floor_friction)"
    return replace(setting, floor_friction=value), [] if fitted else [said], 0.0 if fitted else error


def _with_least_speed(setting: Setting, v_n: Array) -> tuple[Setting, list[str]]:
    """Return the setting with the speed of a power law held at the least one measured, and a note: above it only the product
    at_rest speed^exponent enters, and a wall that is elastic below some speed has to be seen there."""
    name = "restitution_speed"
    if setting.restitution != "power" or name in setting.fixed or name in setting.bounds:
        return setting, []
    up = 1 - (setting.contact_height or 1.0)
    least = float(v_n.min() * np.sqrt(1 - up * up))
    said = (
        f"{name} is held at {least:.4g} m/s, the least normal speed, so that restitution_at_rest is the value there; to fit it as"
        " well, give it bounds (`bound`)"
    )
    return replace(setting, fixed=setting.fixed | {name: least}), [said]


def _spins_in_words(problem: Problem, name: str) -> str:
    """Return a note on unmeasured spins: how many rows have none, and from where they are taken."""
    unknown, drawn = problem.unknown.sum(), problem.drawn.sum()
    said = f"{name}: not measured in {unknown} of {len(problem.x)} rows"
    if not problem.carried:
        return f"{said}; integrated over its prior ({prior_in_words(problem.setting)})"
    said += f"; in {unknown - drawn} later contacts carried on from the ball's contact before"
    if drawn:
        said += f", in {drawn} others integrated over its prior ({prior_in_words(problem.setting)})"
    few = 0 < drawn < FEW_DRAWN
    return f"{said}; film more throws before relying on a verdict (`spin` 0 if they had none)" if few else said


def prior_in_words(setting: Setting) -> str:
    """Return the prior of unmeasured spins in words."""
    uniform = setting.spin_prior == "uniform"
    mean = 0.0 if uniform and setting.spin_mean is None else setting.spin_mean
    about = "with a fitted mean along v_t" if mean is None else f"about {mean:g} v_t/a" if mean else "about 0"
    width = "fitted width" if setting.spin_width is None else f"width {setting.spin_width:g} v/a"
    return f"uniform {about}, within {setting.spin_width:g} v/a" if uniform else f"normal {about}, {width}"


def _warnings(problem: Problem, spin: str) -> list[str]:
    """Return notes on data that limit any fit: few rows, copies, one angle, one speed, no spin."""
    notes = []
    n = len(problem.x)
    if n < FEW_ROWS:
        notes.append(
            f"rows: only {n} rebounds, but error bars are valid for many; film more before drawing conclusions"
        )
    both = np.nan_to_num(np.concatenate([problem.x, problem.y], axis=1), nan=np.inf)
    different, first = np.unique(both, axis=0, return_index=True)
    if len(different) < n:
        label = problem.rebounds.rows or tuple(f"row {i + 1}" for i in range(n))
        copies = [label[i] for i in range(n) if i not in set(first.tolist())]
        notes.append(
            f"rows: {len(copies)} of {n} are copies of others ({', '.join(copies[:3])}{', ...' if len(copies) > 3 else ''}); each"
            " counts as an independent measurement, so error bars are too small; remove the copies"
        )
    angle = np.degrees(np.arctan2(problem.x[:, 1], problem.x[:, 0]))
    spun = problem.x[:, 2] * problem.setting.radius / np.hypot(problem.x[:, 0], problem.x[:, 1])
    spinless = not np.nanmax(np.abs(spun), initial=0.0) > 0.05
    if np.isfinite(problem.y[:, 1]).any() and np.ptp(angle) < SAME_ANGLE and spinless:
        notes.append(
            f"angles: all rows have the same angle, {np.median(angle):.1f} degrees within {np.ptp(angle):.1g}: one angle"
            " determines one parameter along the wall, not two; film other angles (carom design proposes them)"
        )
    speed = problem.x[:, 0]
    if speed.max() < SAME_SPEED * speed.min() and problem.setting.restitution != "constant":
        notes.append(
            f"speeds: v_n_in only from {speed.min():.3g} to {speed.max():.3g} m/s: too few for a restitution that depends on it"
        )
    notes += energy_remarks(problem.rebounds, problem.setting.radius, problem.setting.kappa, problem.setting.roll)
    return [*notes, *_unmeasured(problem, spin)]


def _unmeasured(problem: Problem, spin: str) -> list[str]:
    """Return notes on what was not measured after the wall, and what then depends on nothing that was."""
    n, after = len(problem.x), np.isfinite(problem.y)
    seen = dict(zip(("v_n_out", "v_t_out", spin), after.sum(axis=0).tolist(), strict=True))
    notes = [
        f"{name}: not measured in {n - count} of {n} rows; it does not enter the likelihood there"
        for name, count in seen.items()
        if 0 < count < n
    ]
    if (alone := directions_of(problem.rebounds)).any():
        notes.append(
            f"only the angle after the wall is known in {alone.sum()} of {n} rows: balls that slide show restitution and friction"
            " over a range of angles, balls that grip only (1 + tangential restitution)/restitution"
        )
    elif not seen["v_n_out"]:
        notes.append(
            "v_n_out: not measured; the restitution enters only through its product with the friction, where balls slide"
        )
    if not seen[spin]:
        notes.append(f"{spin}: not measured; only v_t depends on friction")
    elif not seen["v_t_out"] and problem.rebounds["v_t_in"].any():
        notes.append(f"v_t_out: not measured; only {spin} depends on friction")
    if (empty := int((~after.any(axis=1)).sum())) > 0:
        notes.append(f"rows: nothing was measured after the wall in {empty} of {n}: they have no say")
    return notes
