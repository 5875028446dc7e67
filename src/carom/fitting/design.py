"""Design of experiments: which shots discriminate between two laws best, and how many are needed.

Atkinson & Fedorov, Biometrika 62, 57 (1975): assume that one law is true and fit the other to the shots planned so far; the next
shot is the one for which the fitted law is off by most error bars. The sum of these squares, the noncentrality lambda of the
other law's chi^2, is the expected value of 2 log odds, apart from the penalty for the number of parameters:

    E(AIC of the other - AIC of the true) = lambda + k_other - k_true.

Shots already filmed count as measured. For a shot whose spin will not be measured, the mean over possible spins is used.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.data.rebounds import COLUMNS, STAGES, Kind, Rebounds, make_rebounds
from carom.errors import CaromError, FaultList, float_or_nan
from carom.fitting.fit import fit_law
from carom.fitting.laws import INDEX, NUMBERS, PARAMETERS, FittedLaw, laws_named, unknown_laws
from carom.fitting.model import model_of, predict_law
from carom.fitting.result import Fit, refit, rows_of_fit
from carom.fitting.rows import FORM_PARAMETERS, Problem, Setting, make_problem, require_settings, usable_rows
from carom.fitting.verdict import nothing_along_the_wall

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


# ----------------------------------------------------------------------------------------------------
# Search for a plan of shots: greedy, improved by exchange, and checked from all starting points of the fit.
#
# Atkinson & Fedorov, Biometrika 62, 57 (1975): the next shot is the one for which the other law, fitted to the shots so far, is
# off by most error bars; in the best plan all shots have the same gain, the largest. Those that were added first seldom have, so
# shots are moved at the end, as long as the odds grow.


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
    added; ``best``, parameters of the other law, and ``first``, before the plan; ``so_far`` and ``total``, 2 log odds of the filmed
    shots and of all; ``over``, whether no shot has a gain; ``fewer``, 2 log odds of the plan with one shot less, by shot.
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
        self.total, self.first = self.so_far, self.best
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


# ----------------------------------------------------------------------------------------------------
# Design of experiments: which shots discriminate between two laws best, and how many are needed.


FINER = 4  # steps of the picture's map per step of the grid of shots


@dataclass(frozen=True, eq=False)
class Plan:
    """A plan of shots to film."""

    laws: tuple[str, str]
    """The law that is assumed to be true, and the other."""
    truth: dict[str, float]
    """Parameters of the first law."""
    other: dict[str, float]
    """Parameters of the other law with which its predictions are closest."""
    shots: tuple[Shot, ...]
    count: int | None
    """Number of shots needed for the odds, in addition to those filmed; None if no number suffices."""
    odds: float
    expected: float
    """Expected 2 log odds of the plan, together with the shots filmed."""
    axes: tuple[Array, Array, Array]
    """Angles (degrees), speeds and spins of the map; a single spin, NaN, if it is not measured."""
    gain: Array
    """(angles, speeds, spins): expected increase of 2 log odds by one more shot there."""
    sentence: str
    notes: tuple[str, ...] = ()
    """Notes on the table."""
    filmed: float | None = None
    """2 log odds of the shots filmed."""
    fine_axes: tuple[Array, Array, Array] | None = None
    """Axes of a finer map, for a picture; None unless it was asked for."""
    fine_gain: Array | None = None
    """2 log odds of one shot there before the plan: the misfit of the other law, fitted to the filmed shots or else all over
    the ranges."""

    def as_dict(self) -> dict[str, object]:
        """Return the plan for JSON."""
        return {
            "laws": list(self.laws),
            "truth": self.truth,
            "other": self.other,
            "odds": self.odds,
            "filmed_2_log_odds": self.filmed,
            "shots_needed": self.count,
            "expected_2_log_odds": self.expected,
            "shots": [vars(shot) for shot in self.shots],
            "map": {
                "angle_deg": self.axes[0].tolist(),
                "speed": self.axes[1].tolist(),
                "spin": [None if math.isnan(spin) else spin for spin in self.axes[2].tolist()],
                "gain": self.gain.tolist(),
            },
            "sentence": self.sentence,
            "notes": list(self.notes),
        }


def design(
    kind: Kind,
    setting: Setting,
    laws: tuple[str, str],
    shots: Shots,
    truth: Mapping[str, float] | None = None,
    *,
    odds: float = 20.0,
    filmed: Rebounds | None = None,
    spin: float | str | None = None,
    fine: bool = False,
) -> Plan:
    """Plan shots that discriminate between two laws, the first assumed to be true with the parameters ``truth``.

    ``filmed``: rebounds already measured; their evidence counts, and without ``truth`` the first law is fitted to them. ``spin``:
    their unmeasured spins, as for :func:`carom.fitting.rows`, which says which of them are used. ``fine``: compute what one shot
    gains before the plan, on a finer grid, for a picture. Raises CaromError for empty ranges and unknown laws.
    """
    require_plan(setting, laws, shots, truth, odds)
    said: list[str] = []
    if filmed is not None:
        own = filmed.notes
        filmed, setting = usable_rows(filmed, setting, spin=spin)
        said = [note for note in filmed.notes if note not in own]
    setting = setting.with_height()
    chosen, _notes = laws_named(list(laws), kind, setting.contact_height == 1.0)
    if len(chosen) != 2:
        raise CaromError(f"laws: expected two that differ for a {kind} rebound, got {laws[0]} and {laws[1]}")
    true, other = chosen
    already: Problem | None = None
    remarks: list[str] = []
    if filmed is not None:
        _require_error_bars(filmed)
        already, remarks = make_problem(filmed, setting)
        if not truth and nothing_along_the_wall(already):
            raise CaromError(
                f"{filmed.source}: expected rebounds from which the friction of {true.name} can be fitted, got balls without"
                " velocity along the wall or spin beyond the error bars; give the parameters (`truth` friction=0.2), or plan"
                " without this file"
            )
        setting = already.setting  # the floor of the film is assumed for the next shots

    fitted = None
    if already is not None:  # (given parameters are held fixed)
        numbers_of(true, already, truth or {})
        fitted = fit_law(true, replace(already, setting=replace(setting, fixed={**setting.fixed, **(truth or {})})))
        if fitted.untold:
            remarks.append(
                f"{true.name}: {' and '.join(fitted.untold)}: not identifiable from the film; the values that fit best are used,"
                " although others fit as well; give them (`truth`)"
            )

    known = fitted.numbers if fitted is not None else None

    def grid(shots: Shots) -> Candidates:
        return candidates(
            kind, setting, shots, true, (truth or {}) if known is None else lambda _problem: known, already
        )

    rows = grid(shots)
    problem, p, have = rows.problem, rows.truth, rows.have
    # (for laws that are fitted to filmed shots, Akaike's penalty)
    price = (len(model_of(other, problem).parameters) - len(model_of(true, problem).parameters)) * (2 if have else 1)
    target = 2 * math.log(odds) - price
    fit = fit_law(other, rows.some if already is None else already)
    truly = replace(fit, law=true)
    done = ShotSearch(fit, rows, deviances(truly, rows), float(np.square(p[NUMBERS:]).sum()), target)
    order, total, so_far, gain = done.order, done.total, done.so_far, done.gain()
    count = len(order) if total >= target else None
    if count is None and not done.over and total - so_far > LEAST_GAIN * len(order):
        count = math.ceil(len(order) * (target - so_far) / (total - so_far))
    planned = [
        replace(
            rows.shot(cell, order.count(cell), float(gain[cell])),
            without=done.fewer[cell] + price if done.fewer else None,
        )
        for cell in sorted(set(order), key=order.index)
    ]
    plan = Plan(
        (true.name, other.name), _named(true, problem, p), _named(other, problem, done.best[0]),
        tuple(sorted(planned, key=lambda shot: -shot.gain * shot.repeat)), count, odds, total + price, rows.axes,
        gain.reshape([len(x) for x in rows.axes]), "",
        (*said, *(note for note in remarks if note.startswith(("`floor_friction`", "rows: only", f"{true.name}: ")))),
        so_far + price if have else None,
    )  # fmt: skip
    if fine:
        # (a shot whose spin is not measured has many rows)
        steps = FINER if rows.each == 1 else FINER // 2
        angles, speeds, spins = shots.counts
        counts = tuple((count - 1) * steps + 1 for count in (angles, speeds, spins))
        finer = grid(replace(shots, counts=counts))  # type: ignore[arg-type]
        gain = gains(fit, finer, deviances(truly, finer), finer.cells, done.first)
        plan = replace(plan, fine_axes=finer.axes, fine_gain=gain.reshape([len(x) for x in finer.axes]))
    return replace(plan, sentence=_sentence(plan, true, other))


def require_plan(
    setting: Setting, laws: tuple[str, ...], shots: Shots, truth: Mapping[str, float] | None = None, odds: float = 20.0
) -> None:
    """Raise CaromError if no shots can be planned, with all problems that can be found before a table is read."""
    faults = FaultList()
    faults.attempt(require_settings, setting)
    for name, ends, least, most in (
        ("angles_deg", shots.angles_deg, 0.0, 89.0), ("speeds", shots.speeds, 1e-6, 1e4),
        ("spins", shots.spins or (0.0, 0.0), -1e6, 1e6),
    ):  # fmt: skip
        pair = tuple(map(float_or_nan, ends)) if isinstance(ends, tuple | list) else ()
        if len(pair) != 2 or not least <= pair[0] <= pair[1] <= most:
            got = ":".join(f"{end:g}" for end in pair) if len(pair) == 2 else repr(ends)
            faults.add(name, f"LOW:HIGH within {least:g} and {most:g}, LOW not above HIGH", got)
    for name, value in (("sigma_v", shots.sigma_v), ("sigma_spin", shots.sigma_spin)):
        if not (float_or_nan(value) > 0 or (value is None and name == "sigma_spin")):
            faults.add(name, "an error bar above 0", f"{value!r}", "no measurement is exact")
    if shots.stage not in STAGES:
        faults.add("stage", " or ".join(STAGES), f"{shots.stage!r}")
    if not float_or_nan(odds) > 1:
        faults.add("odds", "a number above 1, such as 20", f"{odds!r}")
    named = isinstance(laws, tuple | list) and all(isinstance(law, str) for law in laws)
    if not named or len(laws) != 2:
        got = repr(",".join(laws) if named else laws)
        faults.add("laws", "two laws, first the one assumed to be true, such as maw,contact", got)
    faults += [replace(fault, where="laws") for fault in (unknown_laws(laws) if named else ())]
    for name, value in (truth or {}).items():
        its = [p for p in (*PARAMETERS, *FORM_PARAMETERS) if p.name == name]
        low, high = min((p.low for p in its), default=0.0), max((p.high for p in its), default=0.0)
        if (
            its and not low <= float_or_nan(value) <= high
        ):  # (parameters that the law does not have are reported once the law is known)
            faults.add(f"truth: {name}", f"{low:g} to {high:g}", f"{value!r}")
    faults.raise_if_any()


def _require_error_bars(filmed: Rebounds) -> None:
    """Raise CaromError if error bars after the wall are missing. (Those of ``shots`` apply to future shots.)"""
    lacks = [
        f"sigma_{name}"
        for name in COLUMNS[filmed.kind][3:]
        if name not in filmed.sigma and np.isfinite(filmed[name]).any()
    ]
    if not filmed["v_t_in"].any() and not filmed["v_t_out"].any():  # normal incidence: v_t carries no information
        lacks = [name for name in lacks if name != "sigma_v_t_out"]
    if lacks:
        raise CaromError(
            f"{filmed.source}: {', '.join(lacks)}: expected error bars of the measurements, to weigh their evidence, got none; add"
            " the columns (`sigma_v` and `sigma_spin` apply to future shots), or omit the file"
        )


def _named(law: FittedLaw, problem: Problem, p: Array) -> dict[str, float]:
    return {name: float(p[place]) for name, place in model_of(law, problem).places.items()}


def _sentence(plan: Plan, true: FittedLaw, other: FittedLaw) -> str:
    """Return the plan in words."""
    film = ""
    if plan.filmed is not None:
        size = math.exp(min(abs(plan.filmed) / 2, 700))
        speaks = f"{size:.3g} to 1 for {true.name if plan.filmed > 0 else other.name}"
        film = f"The film gives odds of {speaks}. " if size >= 1.05 else "The film alone does not discriminate. "
    if plan.count == 0:
        return f"{film}This suffices for odds of {plan.odds:g} to 1; no more shots are needed."
    if plan.count is None:
        why = "the other law, fitted to them, makes the same predictions; try other angles, speeds or spins"
        if other.name in true.within:
            why = f"{other.name} contains {true.name}; exchange the two laws, `laws` {other.name},{true.name}"
        return f"{film}No number of such shots discriminates between {true.name} and {other.name}: {why}."
    where = ", ".join(
        f"{shot.repeat} at {shot.angle_deg:.3g}°, {shot.speed:.3g} m/s"
        + (f", {shot.spin:.3g} rad/s" if shot.spin else "")
        for shot in plan.shots[:6]
    )
    many = f"{plan.count} {'more ' if film else ''}shot{'s are' if plan.count != 1 else ' is'} needed"
    others = " and others" if len(plan.shots) > 6 else ""
    others += ", with spins that are not measured" if plan.shots and plan.shots[0].spin is None else ""
    return f"{film}If {true.name} is true, {many} for odds of {plan.odds:g} to 1 against {other.name}: {where}{others}."
