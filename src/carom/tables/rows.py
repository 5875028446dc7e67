"""Many rows at once: numbers in, the law's answer out, and a note for every row that has none."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.ball import Ball, Disc
from carom.checks import LARGEST
from carom.errors import CaromError
from carom.law import LAWS, Answer, Meeting
from carom.rows import unit_normal
from carom.state import State
from carom.surface import Surface
from carom.tables.plan import PARAMETERS, Plan

__all__ = ["CHECKS", "answer_rows"]

Array = NDArray[np.float64]
Notes = dict[int, str]


def _within(low: float, high: float) -> Callable[[Any], Any]:
    return lambda x: (x >= low) & (x <= high)


def _positive(x: Any) -> Any:
    return (x > 0) & (x <= LARGEST)


def _friction(x: Any) -> Any:
    return (x >= 0) & ((x <= LARGEST) | (x == math.inf))


FINITE = (_within(-LARGEST, LARGEST), "a finite number")
# In SI; a column that is not here holds any finite number.
CHECKS: dict[str, tuple[Callable[[Any], Any], str]] = {
    "radius": (_positive, "a length above 0"),
    "mass": (_positive, "a mass above 0"),
    "kappa": (lambda x: (x > 0) & (x <= 2 / 3 * (1 + 1e-12)), "kappa = I/(m a^2) in (0, 2/3]"),
    "restitution": (_within(0, 1), "a number from 0 to 1"),
    "friction": (_friction, "a number >= 0, or inf"),
    "tangential_restitution": (_within(-1, 1), "a number from -1 to 1"),
    "floor_restitution": (_within(0, 1), "a number from 0 to 1"),
    "floor_friction": (_friction, "a number >= 0, or inf"),
    "floor_tangential_restitution": (_within(-1, 1), "a number from -1 to 1"),
    "height": (_within(0, LARGEST), "a length >= 0"),
    "stiffness_ratio": (_positive, "a number above 0"),
    "speed": (_within(0, LARGEST), "a speed >= 0"),
    "incidence": (_within(-math.pi / 2, math.pi / 2), "an angle from the normal, -90 to 90 degrees"),
}


def answer_rows(plan: Plan, columns: dict[str, Array], notes: Notes) -> list[Array]:
    """The added columns (N,) of N rows, NaN where there is no answer; ``notes`` takes why, by row.

    ``columns`` holds the plan's sources in the table's units; rows that are in ``notes`` already are left out.
    """
    count = len(next(iter(columns.values())))
    values = {name: plan.sources[name].unit.to_si(column) for name, column in columns.items()}
    good = np.ones(count, dtype=bool)
    good[list(notes)] = False
    for name, column in values.items():
        holds, expected = CHECKS.get(name, FINITE)
        for i in np.flatnonzero(good & ~holds(column)).tolist():
            _note(notes, i, f"{plan.sources[name].header}: expected {expected}, got {float(columns[name][i])!r}")
    good[list(notes)] = False
    if "normal_x" in values:
        size = sum(np.abs(values.get(k, np.zeros(1))) for k in ("normal_x", "normal_y", "normal_z"))
        for i in np.flatnonzero(good & ~(size > 0)).tolist():
            notes[i] = "normal: expected a vector from the wall to the ball, got length 0"
            good[i] = False
    if plan.spin == "rolling" and plan.form == "vector":
        _refuse_hops(values, plan, notes, good)
    out = [np.full(count, math.nan) for _ in plan.added]
    if not good.any():
        return out
    rows = np.flatnonzero(good)
    meeting = _meeting(plan, values, rows if len(rows) < count else slice(None))
    allowed = np.ones(len(rows), dtype=bool)
    for mask, expected in plan.settings.law.conditions(meeting):
        full = np.broadcast_to(mask, allowed.shape)
        for i in rows[allowed & ~full].tolist():
            _note(notes, i, f"expected {expected}")
        # one line a row is enough: what the next condition says of a row that failed this one is noise
        allowed &= full
    if not allowed.all():
        rows = rows[allowed]
        if not len(rows):
            return out
        meeting = _meeting(plan, values, rows)
    for column, result in zip(out, _columns(plan, _ask(plan, meeting), rows, notes), strict=True):
        column[rows] = result
    return out


def _note(notes: Notes, i: int, text: str) -> None:
    notes[i] = f"{notes[i]}; {text}" if i in notes else text


def _refuse_hops(values: dict[str, Array], plan: Plan, notes: Notes, good: NDArray[np.bool_]) -> None:
    """A ball without spin in the table is taken to roll: only if it is on the floor."""
    for name in ("velocity_z", "height"):
        if name in values:
            bad = good & (values[name] != 0)
        elif plan.constants.get(name, 0.0) != 0:
            bad = good.copy()
        else:
            continue
        for i in np.flatnonzero(bad).tolist():
            _note(notes, i, f"{name}: expected 0 of a ball that is taken to roll; give its spin, or --spin none")
        good &= ~bad


def _ask(plan: Plan, meeting: Meeting) -> Answer:
    law = plan.settings.law
    try:
        with np.errstate(all="ignore"):
            return law.answer(meeting)
    except Exception as error:
        if isinstance(error, CaromError) or LAWS.get(law.name) is law:
            raise
        # a law of the user's own may go wrong in any way
        what = f"{type(error).__name__}: {(str(error).splitlines() or [''])[0]}"
        raise CaromError(f"law {law.name!r}: expected (v, w) for every row, got {what}") from error


def _meeting(plan: Plan, values: dict[str, Array], rows: Any) -> Meeting:
    """The rows' states in SI. Bounce and angle form: normal along x, tangent along y, z up; slip is v_t - a spin."""

    def get(name: str) -> Any:
        return values[name][rows] if name in values else plan.constants.get(name, 0.0)

    count = len(next(iter(values.values()))[rows])
    settings = plan.settings
    p = {name: get(name) for name in PARAMETERS}
    v, w = np.zeros((count, 3)), np.zeros((count, 3))
    if plan.form == "vector":
        v[:, 0], v[:, 1], v[:, 2] = get("velocity_x"), get("velocity_y"), get("velocity_z")
        w[:, 2] = get("spin_z")
    else:
        if plan.form == "bounce":
            normal_speed, along = get("v_n_in"), get("v_t_in")
        else:
            speed, angle = get("speed"), get("incidence")
            normal_speed, along = speed * np.cos(angle), speed * np.sin(angle)
        v[:, 0], v[:, 1] = -normal_speed, along
        w[:, 2] = get("spin_in") if plan.air else get("spin_z_in")
    if plan.spin == "rolling":
        # (27)
        w[:, 0], w[:, 1] = -v[:, 1] / p["radius"], v[:, 0] / p["radius"]
    elif plan.spin == "given" and not plan.air:
        w[:, 0], w[:, 1] = get("spin_x"), get("spin_y")
    make = Disc if plan.air else Ball
    return Meeting(
        ball=make(p["radius"], p["mass"], p["kappa"]),
        state=State.of(v, w),
        normal=_normal(plan, values, rows),
        wall=Surface(p["restitution"], p["friction"], p["tangential_restitution"]),
        floor=Surface(p["floor_restitution"], p["floor_friction"], p["floor_tangential_restitution"]),
        gravity=settings.gravity,
        height=p["height"],
        floor_contact=settings.floor_contact,
        stiffness_ratio=p["stiffness_ratio"],
    )


def _normal(plan: Plan, values: dict[str, Array], rows: Any) -> Array:
    if "normal_x" in values:
        zero = np.zeros_like(values["normal_x"])
        n = unit_normal(np.stack([values.get(f"normal_{k}", zero) for k in "xyz"], axis=-1)[rows])
    else:
        n = unit_normal(plan.settings.normal or (1.0, 0.0, 0.0))
    sine = plan.settings.contact_height - 1
    if sine == 0:
        return n
    # The wall touches a sin above the centre: its normal there looks down by that much.
    return n * math.sqrt(1 - sine * sine) - sine * np.array([0.0, 0.0, 1.0])


def _columns(plan: Plan, answer: Answer, rows: NDArray[np.intp], notes: Notes) -> list[Array]:
    """The added columns in the table's units, and notes on what is not finite."""
    for i in np.flatnonzero(answer.why != "").tolist():
        _note(notes, int(rows[i]), str(answer.why[i]))
    lost = ~np.isfinite(answer.after_wall.velocity).all(axis=-1) | ~np.isfinite(answer.after_wall.spin).all(axis=-1)
    for i in np.flatnonzero(lost).tolist():
        if int(rows[i]) not in notes:
            notes[int(rows[i])] = "the law gives no finite answer"
    found: list[Array] = []
    for state in (answer.after_wall, answer.final)[: 1 + plan.rolls]:
        v, w = state.velocity, state.spin
        x, y = v[:, 0], v[:, 1]
        if plan.form == "vector":
            found += [*v.T, *w.T]
        elif plan.air:
            found += [x, y, w[:, 2]]
        elif state is answer.after_wall:
            found += [*v.T, *w.T]
        else:
            found += [x, y, w[:, 2]]
        if plan.form == "angle":
            found += [np.sqrt((v * v).sum(axis=-1)), np.arctan2(y, x)]
    return [added.unit.from_si(column) for added, column in zip(plan.added, found, strict=True)]
