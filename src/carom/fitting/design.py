"""Which shots to film next: those that separate two laws best, and how many.

Atkinson & Fedorov, Biometrika 62, 57 (1975): let one law be true; fit the other to the shots planned so far; the next shot is
the one that the fitted other law misses by most error bars. What is missed in all, the noncentrality lambda of the other
law's chi^2, is what 2 log odds are expected to be, but for the price of each law's own numbers:

    E(AIC of the other - AIC of the true) = lambda + k_other - k_true.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from carom.errors import CaromError
from carom.fitting.data import Problem, Setting, make_problem, require_settings
from carom.fitting.fit import Fit, fit_law, parameters_of, refit, rows_of_fit
from carom.fitting.laws import FittedLaw, laws_named
from carom.fitting.parameters import INDEX
from carom.rebounds import COLUMNS, Kind, Rebounds, make_rebounds

__all__ = ["Plan", "Shot", "Shots", "design"]

Array = NDArray[np.float64]
MOST = 400  # shots
SAME = 1e-3  # a shot that tells laws apart by less of an error bar squared tells nothing


@dataclass(frozen=True)
class Shots:
    """Which shots can be made, and how well they are measured."""

    angles: tuple[float, float] = (5.0, 75.0)
    """Incidence from the wall's normal, degrees."""
    speeds: tuple[float, float] = (1.0, 3.0)
    """m/s."""
    spins: tuple[float, float] = (0.0, 0.0)
    """rad/s before the wall."""
    sigma_v: float = 0.02
    """Error bar of each speed, before and after, m/s."""
    sigma_spin: float | None = None
    """Of each spin, rad/s; None: spin is set before the wall and not measured after it."""
    stage: str = "after_wall"
    """Table rebounds: after_wall or rolling."""
    counts: tuple[int, int, int] = (29, 5, 9)
    """Angles, speeds and spins that are looked at."""


@dataclass(frozen=True)
class Shot:
    """A shot to film, ``repeat`` times."""

    angle_deg: float
    speed: float
    spin: float
    repeat: int
    gain: float
    """What each is expected to add to 2 log odds."""


@dataclass(frozen=True, eq=False)
class Plan:
    """What to film."""

    laws: tuple[str, str]
    """The law that is taken for true, and the other."""
    truth: dict[str, float]
    """Numbers of the first."""
    other: dict[str, float]
    """With these the other law comes closest."""
    shots: tuple[Shot, ...]
    count: int | None
    """Shots for the odds; None where no number of them is enough."""
    odds: float
    expected: float
    """2 log odds that the plan is expected to give."""
    axes: tuple[Array, Array, Array]
    """Angles (degrees), speeds and spins of the map."""
    gain: Array
    """(angles, speeds, spins): what one more shot there is expected to add to 2 log odds."""
    sentence: str
    notes: tuple[str, ...] = ()
    """What was taken of the table."""

    def as_dict(self) -> dict[str, object]:
        """For JSON."""
        return {
            "laws": list(self.laws),
            "truth": self.truth,
            "other": self.other,
            "odds": self.odds,
            "shots_needed": self.count,
            "expected_2_log_odds": self.expected,
            "shots": [vars(shot) for shot in self.shots],
            "map": {
                "angle_deg": self.axes[0].tolist(),
                "speed": self.axes[1].tolist(),
                "spin": self.axes[2].tolist(),
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
    truth: dict[str, float] | None = None,
    *,
    odds: float = 20.0,
    filmed: Rebounds | None = None,
) -> Plan:
    """Plan shots that separate two laws, the first taken for true with the numbers ``truth``.

    ``filmed``: rebounds that there are already; what they tell is not asked again, and where ``truth`` is left out the first
    law is fitted to them. Raises CaromError for ranges that hold no shot and laws that are unknown.
    """
    require_settings(setting)
    _require(shots, odds, laws)
    chosen, _notes = laws_named(list(laws), kind, setting.contact_height == 1.0)
    if len(chosen) != 2:
        raise CaromError(f"laws: expected two that differ for a {kind} rebound, got {laws[0]} and {laws[1]}")
    true, other = chosen
    grid, axes = _grid(kind, shots)
    have, already = 0, None
    remarks: list[str] = []
    if filmed is not None:
        already, remarks = make_problem(filmed, setting)
        setting = already.setting  # what the film says of the floor is so of the next shots
    problem, _ = make_problem(grid, setting)
    if already is not None:
        if already.estimated.any() or already.unknown.any():
            raise CaromError(
                "filmed: expected error bars and spins in every row, to say what they tell; leave the file out"
            )
        truth = truth or {
            name: float(e.value) for name, e in fit_law(true, already).estimates.items() if e.value is not None
        }
        problem, have = _joined(already, problem), len(already.x)
    p = _numbers(true, problem, truth or {})
    problem = replace(problem, y=_seen(true, problem, p))
    names = parameters_of(true, problem)[0]
    price = len(parameters_of(other, problem)[0]) - len(names)
    target = 2 * math.log(odds) - price
    weights = np.zeros(len(problem.x))
    weights[:have] = 1
    fit = fit_law(other, problem)
    best = fit.numbers[None].copy()
    start = best.copy()
    order: list[int] = []
    told = np.zeros(len(problem.x))
    total, first = 0.0, 0.0
    while total < max(target, 1e-9) and len(order) < MOST:
        told = rows_of_fit(fit, problem, best[0])[0]
        new = have + int(np.argmax(told[have:]))
        if told[new] < SAME:
            break
        weights[new] += 1
        order.append(new)
        # from where it stood, and from where it began: the other law's way down may have two ends
        found, deviances = refit(fit, problem, np.stack([weights, weights]), np.concatenate([best, start]))
        best, total = found[[int(np.argmin(deviances))]], float(deviances.min())
        first = first or total
        if len(order) > 60 and total < len(order) * target / MOST:
            break
    told = rows_of_fit(fit, problem, best[0])[0]
    count = len(order) if total >= target else None
    if count is None and total > SAME * len(order) and order:
        count = math.ceil(len(order) * target / total)
    plan = _plan(fit, true, problem, p, best[0], order, told, have, axes, count, total, odds, price, grid)
    return replace(plan, notes=tuple(note for note in remarks if note.startswith("floor_friction")))


def _require(shots: Shots, odds: float, laws: tuple[str, str]) -> None:
    faults = []
    for name, (low, high), least, most in (
        ("angles", shots.angles, 0.0, 89.0), ("speeds", shots.speeds, 1e-6, 1e4), ("spins", shots.spins, -1e6, 1e6),
    ):  # fmt: skip
        if not least <= low <= high <= most:
            faults.append(
                f"{name}: expected LOW:HIGH within {least:g} and {most:g}, LOW not above HIGH, got {low:g}:{high:g}"
            )
    if not shots.sigma_v > 0 or (shots.sigma_spin is not None and not shots.sigma_spin > 0):
        faults.append("sigma: expected error bars above 0, got one that is not; nothing is measured exactly")
    if not odds > 1:
        faults.append(f"odds: expected a number above 1, such as 20, got {odds:g}")
    if len(laws) != 2:
        faults.append(f"laws: expected two, got {len(laws)}")
    if faults:
        raise CaromError(*faults)


def _grid(kind: Kind, shots: Shots) -> tuple[Rebounds, tuple[Array, Array, Array]]:
    axes = tuple(
        np.linspace(low, high, count) if high > low else np.array([low])
        for (low, high), count in zip((shots.angles, shots.speeds, shots.spins), shots.counts, strict=True)
    )
    angle, speed, spin = (x.ravel() for x in np.meshgrid(*axes, indexing="ij"))
    names = COLUMNS[kind]
    v_n, v_t = speed * np.cos(np.radians(angle)), speed * np.sin(np.radians(angle))
    columns = dict(zip(names, (v_n, v_t, spin, v_n, v_t, spin), strict=True))
    for name in names:
        if name.startswith("v"):
            columns[f"sigma_{name}"] = np.full(len(spin), shots.sigma_v)
        elif shots.sigma_spin is not None:
            columns[f"sigma_{name}"] = np.full(len(spin), shots.sigma_spin)
    if shots.sigma_spin is None:
        columns[names[5]] = np.full(len(spin), np.nan)
    return make_rebounds(kind, columns, stage=shots.stage if kind == "table" else None, source="shots"), axes  # type: ignore[return-value]


def _joined(first: Problem, second: Problem) -> Problem:
    x, vx, y, vy = (
        np.concatenate(pair)
        for pair in ((first.x, second.x), (first.vx, second.vx), (first.y, second.y), (first.vy, second.vy))
    )
    stages = None if first.stages is None or second.stages is None else np.concatenate([first.stages, second.stages])
    return replace(second, stages=stages, x=x, vx=vx, y=y, vy=vy)


def _numbers(law: FittedLaw, problem: Problem, truth: dict[str, float]) -> Array:
    """All numbers of a law, with those that are given; CaromError where one is unknown."""
    free, p, _form = parameters_of(law, problem)
    plain = {
        "restitution": 0.8,
        "friction": 0.2,
        "tangential_restitution": 0.4,
        "stiffness_ratio": p[INDEX["stiffness_ratio"]],
    }
    faults = [
        f"truth: expected a number of {law.name}, one of {', '.join(free) or 'none'}, got {name!r}"
        for name in truth
        if name not in free
    ]
    if faults:
        raise CaromError(*faults)
    for name, (place, parameter) in free.items():
        value = truth.get(name, plain.get(name, parameter.tried[0]))
        if not parameter.low <= value <= parameter.high:
            raise CaromError(f"truth: {name}: expected {parameter.low:g} to {parameter.high:g}, got {value:g}")
        p[place] = value
    return p


def _seen(law: FittedLaw, problem: Problem, p: Array) -> Array:
    """What would be measured if a law were true, without noise."""
    from carom.fitting.fit import predict_law

    return np.where(np.isnan(problem.y), np.nan, predict_law(law, problem, p))


def _plan(
    fit: Fit, true: FittedLaw, problem: Problem, p: Array, best: Array, order: list[int], told: Array, have: int,
    axes: tuple[Array, Array, Array], count: int | None, total: float, odds: float, price: int, grid: Rebounds,
) -> Plan:  # fmt: skip
    shots = []
    for row in sorted(set(order), key=order.index):
        i = row - have
        v_n, v_t = grid["v_n_in"][i], grid["v_t_in"][i]
        angle = round(float(np.degrees(np.arctan2(v_t, v_n))), 6)
        spin = float(grid[COLUMNS[grid.kind][2]][i])
        shots.append(Shot(angle, round(float(np.hypot(v_n, v_t)), 9), spin, order.count(row), float(told[row])))
    shots.sort(key=lambda shot: -shot.gain * shot.repeat)
    mine = {name: float(p[place]) for name, (place, _) in parameters_of(true, problem)[0].items()}
    theirs = {name: float(best[place]) for name, (place, _) in parameters_of(fit.law, problem)[0].items()}
    if count is None:
        contains = fit.law.name in true.within
        said = (
            f"no number of such shots tells {true.name} from {fit.law.name}: "
            + (f"{fit.law.name} contains {true.name}; ask the other way round, --laws {fit.law.name},{true.name}"
               if contains else "the other law, refitted, does the same; try other angles, speeds or spins")
        )  # fmt: skip
    else:
        where = ", ".join(
            f"{shot.repeat} at {shot.angle_deg:.3g}°, {shot.speed:.3g} m/s"
            + (f", {shot.spin:.3g} rad/s" if shot.spin else "")
            for shot in shots[:6]
        )
        many = f"{count} shot{'s' if count != 1 else ''}"
        said = f"if {true.name} is true, {many} for odds of {odds:g} to 1 against {fit.law.name}: {where}"
        said += " and others" if len(shots) > 6 else ""
    gain = told[have:].reshape([len(x) for x in axes])
    return Plan(
        (true.name, fit.law.name),
        mine,
        theirs,
        tuple(shots),
        count,
        odds,
        total + price,
        axes,
        gain,
        said[0].upper() + said[1:] + ".",
    )
