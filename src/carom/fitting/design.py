"""Design of experiments: which shots discriminate between two laws best, and how many are needed.

Atkinson & Fedorov, Biometrika 62, 57 (1975): assume that one law is true and fit the other to the shots planned so far; the next
shot is the one for which the fitted law is off by most error bars. The sum of these squares, the noncentrality lambda of the
other law's chi^2, is the expected value of 2 log odds, apart from the penalty for the number of parameters:

    E(AIC of the other - AIC of the true) = lambda + k_other - k_true.

Shots already filmed count as measured. For a shot whose spin will not be measured, the mean over possible spins is used.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from carom.data.rebounds import COLUMNS, STAGES, Kind, Rebounds
from carom.errors import CaromError, FaultList, float_or_nan
from carom.fitting.adequacy import nothing_along_the_wall
from carom.fitting.candidate_shots import Candidates, Shot, Shots, candidates, numbers_of
from carom.fitting.data import Problem, make_problem
from carom.fitting.fit import fit_law
from carom.fitting.laws import FittedLaw, laws_named, unknown_laws
from carom.fitting.model import model_of
from carom.fitting.parameters import NUMBERS, PARAMETERS
from carom.fitting.setting import FORM_PARAMETERS, Setting, require_settings
from carom.fitting.shot_search import LEAST_GAIN, ShotSearch, deviances, gains
from carom.fitting.usable_rows import usable_rows

__all__ = ["Plan", "Shot", "Shots", "design", "require_plan"]

Array = NDArray[np.float64]
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
    """The same gain there."""

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
    their unmeasured spins, as for :func:`carom.fitting.usable_rows`, which says which of them are used. ``fine``: compute the gain
    on a finer grid, too, for a picture. Raises CaromError for empty ranges and unknown laws.
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
        gain = gains(fit, finer, deviances(truly, finer), finer.cells, done.best)
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
