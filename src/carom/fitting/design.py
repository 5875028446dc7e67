"""Which shots to film next: those that separate two laws best, and how many.

Atkinson & Fedorov, Biometrika 62, 57 (1975): let one law be true; fit the other to the shots planned so far; the next shot is
the one that the fitted other law misses by most error bars. What is missed in all, the noncentrality lambda of the other
law's chi^2, is what 2 log odds are expected to be, but for the price of each law's own numbers:

    E(AIC of the other - AIC of the true) = lambda + k_other - k_true.

What was filmed already counts as it was measured. A shot with a spin that nobody will know counts as the mean over such spins.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from carom.checks import real
from carom.errors import CaromError
from carom.fitting.data import Problem, Setting, make_problem, require_settings
from carom.fitting.fit import Fit, fit_law, parameters_of, refit, rows_of_fit
from carom.fitting.laws import FittedLaw, laws_named, unknown_laws
from carom.fitting.parameters import FORMS, INDEX, NUMBERS, PARAMETERS
from carom.fitting.shot_rows import Candidates, candidates
from carom.rebounds import COLUMNS, STAGES, Kind, Rebounds

__all__ = ["Plan", "Shot", "Shots", "design", "numbers_of", "require_plan"]

Array = NDArray[np.float64]
MOST = 400  # shots
AGAIN, FEW = 8, 20  # of shots of many rows only the best so far are looked at, and all of them now and then
SAME = 1e-3  # a shot that tells laws apart by less of an error bar squared tells nothing
UNSURE = 0.02  # nor does one whose spin nobody will know by less than is known of its worth (shot_rows.py)


@dataclass(frozen=True)
class Shots:
    """Which shots can be made, and how well they are measured."""

    angles: tuple[float, float] = (5.0, 75.0)
    """Incidence from the wall's normal, degrees."""
    speeds: tuple[float, float] = (1.0, 3.0)
    """m/s."""
    spins: tuple[float, float] | None = (0.0, 0.0)
    """rad/s before the wall; None: nobody will know them, as of a film without marks on the ball."""
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
    spin: float | None
    """None: nobody will know it."""
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
    """Shots for the odds, beside what was filmed; None where no number of them is enough."""
    odds: float
    expected: float
    """2 log odds that the plan is expected to give, with what was filmed."""
    axes: tuple[Array, Array, Array]
    """Angles (degrees), speeds and spins of the map; one spin, NaN, where nobody will know it."""
    gain: Array
    """(angles, speeds, spins): what one more shot there is expected to add to 2 log odds."""
    sentence: str
    notes: tuple[str, ...] = ()
    """What was taken of the table."""
    filmed: float | None = None
    """2 log odds of what was filmed already."""

    def as_dict(self) -> dict[str, object]:
        """For JSON."""
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
) -> Plan:
    """Plan shots that separate two laws, the first taken for true with the numbers ``truth``.

    ``filmed``: rebounds that there are already; what they tell is not asked again, and where ``truth`` is left out the first
    law is fitted to them. Raises CaromError for ranges that hold no shot and laws that are unknown.
    """
    require_plan(setting, laws, shots, truth, odds)
    chosen, _notes = laws_named(list(laws), kind, setting.contact_height == 1.0)
    if len(chosen) != 2:
        raise CaromError(f"laws: expected two that differ for a {kind} rebound, got {laws[0]} and {laws[1]}")
    true, other = chosen
    already: Problem | None = None
    remarks: list[str] = []
    if filmed is not None:
        _require_error_bars(filmed)
        already, remarks = make_problem(filmed, setting)
        setting = already.setting  # what the film says of the floor is so of the next shots

    fitted = None
    if already is not None:  # (numbers that are given are held)
        numbers_of(true, already, truth or {})
        fitted = fit_law(true, replace(already, setting=replace(setting, fixed={**setting.fixed, **(truth or {})})))
        if fitted.untold:
            remarks.append(
                f"{true.name}: the film does not tell {' and '.join(fitted.untold)}; taken where they fit best, as one of many"
                " values: say what they are (--truth)"
            )

    known = fitted.numbers if fitted is not None else None
    rows = candidates(kind, setting, shots, true, (truth or {}) if known is None else lambda _problem: known, already)
    problem, p, have = rows.problem, rows.truth, rows.have
    # (of laws that are fitted to what was filmed, Akaike's own price)
    price = (len(parameters_of(other, problem)[0]) - len(parameters_of(true, problem)[0])) * (2 if have else 1)
    target = 2 * math.log(odds) - price
    fit = fit_law(other, rows.some if already is None else already)
    # what the true law itself leaves of each row: nothing, but where a row was measured or its spin is unknown
    plain = rows_of_fit(replace(fit, law=true), problem, p)[0]
    order, best, gain, so_far, total, over = _search(fit, rows, plain, float(np.square(p[NUMBERS:]).sum()), target)
    count = len(order) if total >= target else None
    if count is None and not over and total - so_far > SAME * len(order):
        count = math.ceil(len(order) * (target - so_far) / (total - so_far))
    planned = [rows.shot(cell, order.count(cell), float(gain[cell])) for cell in sorted(set(order), key=order.index)]
    plan = Plan(
        (true.name, other.name),
        _named(true, problem, p),
        _named(other, problem, best[0]),
        tuple(sorted(planned, key=lambda shot: -shot.gain * shot.repeat)),
        count,
        odds,
        total + price,
        rows.axes,
        gain.reshape([len(x) for x in rows.axes]),
        "",
        tuple(note for note in remarks if note.startswith(("floor_friction", "rows: only", f"{true.name}: the film"))),
        so_far + price if have else None,
    )
    return replace(plan, sentence=_sentence(plan, true, other))


def _search(
    fit: Fit, rows: Candidates, plain: Array, owed: float, target: float
) -> tuple[list[int], Array, Array, float, float, bool]:
    """Shots in the order in which they are best added; the other law's numbers then, what one more of each would add, what was
    filmed tells, and all; whether no shot tells more.

    ``plain``, ``owed``: what the true law leaves of each row, and of what rows share.
    """
    problem, start = rows.problem, fit.numbers[None]
    weights = np.zeros(len(problem.x))
    weights[: rows.have] = 1

    def lost(best: Array) -> tuple[Array, float]:
        """The other law fitted to what is planned so far: its numbers, and how much worse than the true one it is."""
        some = np.flatnonzero(weights)
        # from where it stood, and from where it began: its way down may have two ends
        found, deviances = refit(
            fit, problem.select(some), np.tile(weights[some], (2, 1)), np.concatenate([best, start])
        )
        return found[[int(np.argmin(deviances))]], float(deviances.min() - (weights * plain).sum() - owed)

    def worth(cells: NDArray[np.int64], best: Array) -> Array:
        """What one more of these shots is expected to add."""
        some = rows.of(cells)
        left = rows_of_fit(fit, problem.select(some.ravel()), best[0])[0] - plain[some.ravel()]
        return left.reshape(some.shape).mean(axis=1)  # type: ignore[no-any-return]

    best, so_far = lost(start) if rows.have else (start, 0.0)
    order: list[int] = []
    total, cells, least = so_far, rows.cells, SAME if rows.each == 1 else UNSURE
    while total < (target if rows.have else max(target, 1e-9)) and len(order) < MOST:
        if rows.each == 1 or len(order) % AGAIN == 0:
            cells = rows.cells
        gain = worth(cells, best)
        if gain.max() < least and len(cells) < len(rows.cells):
            cells, gain = rows.cells, worth(rows.cells, best)
        new = int(np.argmax(gain))
        if gain[new] < least:
            return order, best, worth(rows.cells, best), so_far, total, True
        order.append(int(cells[new]))
        weights[rows.of(cells[[new]])] += 1 / rows.each
        best, total = lost(best)
        if len(order) > 60 and total - so_far < len(order) * (target - so_far) / MOST:
            break
        cells = cells[np.argsort(-gain, kind="stable")[:FEW]]
    return order, best, worth(rows.cells, best), so_far, total, False


def require_plan(
    setting: Setting, laws: tuple[str, ...], shots: Shots, truth: Mapping[str, float] | None = None, odds: float = 20.0
) -> None:
    """CaromError where no shots can be planned, with all that can be known before a table is read."""
    faults: list[str] = []
    try:
        require_settings(setting)
    except CaromError as error:
        faults += error.faults
    for name, ends, least, most in (
        ("angles", shots.angles, 0.0, 89.0), ("speeds", shots.speeds, 1e-6, 1e4), ("spins", shots.spins or (0.0, 0.0), -1e6, 1e6),
    ):  # fmt: skip
        pair = tuple(map(real, ends)) if isinstance(ends, tuple | list) else ()
        if len(pair) != 2 or not least <= pair[0] <= pair[1] <= most:
            got = ":".join(f"{end:g}" for end in pair) if len(pair) == 2 else repr(ends)
            faults.append(f"{name}: expected LOW:HIGH within {least:g} and {most:g}, LOW not above HIGH, got {got}")
    for name, value in (("sigma_v", shots.sigma_v), ("sigma_spin", shots.sigma_spin)):
        if not (real(value) > 0 or (value is None and name == "sigma_spin")):
            faults.append(f"{name}: expected an error bar above 0, got {value!r}; nothing is measured exactly")
    if shots.stage not in STAGES:
        faults.append(f"stage: expected {' or '.join(STAGES)}, got {shots.stage!r}")
    if not real(odds) > 1:
        faults.append(f"odds: expected a number above 1, such as 20, got {odds!r}")
    named = isinstance(laws, tuple | list) and all(isinstance(law, str) for law in laws)
    if not named or len(laws) != 2:
        got = repr(",".join(laws) if named else laws)
        faults.append(f"laws: expected two laws, the one taken for true first, such as maw,contact, got {got}")
    faults += unknown_laws(laws) if named else []
    for name, value in (truth or {}).items():
        its = [p for p in (*PARAMETERS, *(p for form in FORMS.values() for p in form.parameters)) if p.name == name]
        low, high = min((p.low for p in its), default=0.0), max((p.high for p in its), default=0.0)
        if its and not low <= real(value) <= high:  # (names that the law has not: once it is known which it has)
            faults.append(f"truth: {name}: expected {low:g} to {high:g}, got {value!r}")
    if faults:
        raise CaromError(*faults)


def _require_error_bars(filmed: Rebounds) -> None:
    """CaromError where what was filmed has not all error bars after the wall. (Those of ``shots`` are of shots to come.)"""
    lacks = [
        f"sigma_{name}"
        for name in COLUMNS[filmed.kind][3:]
        if name not in filmed.sigma and np.isfinite(filmed[name]).any()
    ]
    if not filmed["v_t_in"].any() and not filmed["v_t_out"].any():  # square on: v_t tells nothing
        lacks = [name for name in lacks if name != "sigma_v_t_out"]
    if lacks:
        raise CaromError(
            f"{filmed.source}: {', '.join(lacks)}: expected error bars of what was filmed, to say what it tells; got none; add"
            " the columns (--sigma-v and --sigma-spin are of shots to come), or leave the file out"
        )


def numbers_of(law: FittedLaw, problem: Problem, truth: Mapping[str, float]) -> Array:
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


def _named(law: FittedLaw, problem: Problem, p: Array) -> dict[str, float]:
    return {name: float(p[place]) for name, (place, _) in parameters_of(law, problem)[0].items()}


def _sentence(plan: Plan, true: FittedLaw, other: FittedLaw) -> str:
    """The plan in words."""
    film = ""
    if plan.filmed is not None:
        size = math.exp(min(abs(plan.filmed) / 2, 700))
        speaks = f"{size:.3g} to 1 for {true.name if plan.filmed > 0 else other.name}"
        film = f"The film says {speaks}. " if size >= 1.05 else "The film alone says nothing. "
    if plan.count == 0:
        return f"{film}That is enough for odds of {plan.odds:g} to 1; no more shots are needed."
    if plan.count is None:
        why = "the other law, refitted, does the same; try other angles, speeds or spins"
        if other.name in true.within:
            why = f"{other.name} contains {true.name}; ask the other way round, --laws {other.name},{true.name}"
        return f"{film}No number of such shots tells {true.name} from {other.name}: {why}."
    where = ", ".join(
        f"{shot.repeat} at {shot.angle_deg:.3g}°, {shot.speed:.3g} m/s"
        + (f", {shot.spin:.3g} rad/s" if shot.spin else "")
        for shot in plan.shots[:6]
    )
    many = f"{plan.count} {'more ' if film else ''}shot{'s' if plan.count != 1 else ''}"
    others = " and others" if len(plan.shots) > 6 else ""
    others += ", with spins that nobody will know" if plan.shots and plan.shots[0].spin is None else ""
    return f"{film}If {true.name} is true, {many} for odds of {plan.odds:g} to 1 against {other.name}: {where}{others}."
