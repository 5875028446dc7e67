"""Predict many rows of a table at once, with a note for every row that has no answer."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.bodies import Ball, Disc, State, Surface
from carom.data.limits import CHECKS, FINITE
from carom.data.plan import BOUNCE, PARAMETERS, TablePlan
from carom.errors import CaromError
from carom.laws.arrays import unit_normal
from carom.laws.law import Answer, Meeting
from carom.laws.registry import laws

__all__ = ["predict_rows"]

Array = NDArray[np.float64]
Notes = dict[int, str]


def predict_rows(plan: TablePlan, columns: dict[str, Array], notes: Notes) -> list[Array]:
    """Return the added columns (N,) of N rows, NaN in rows without an answer; ``notes`` gets the reasons, by row.

    ``columns`` holds the columns that the plan reads, in the units of the table; rows that are in ``notes`` already are left out.
    """
    count = len(next(iter(columns.values())))
    values = {name: plan.sources[name].unit.to_si(column) for name, column in columns.items()}
    good = np.ones(count, dtype=bool)
    good[list(notes)] = False
    _fill_spins(plan, values, notes, good)
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
        _require_on_floor(values, plan, notes, good)
    out = [np.full(count, math.nan) for _ in plan.added]
    if not good.any():
        return out
    rows = np.flatnonzero(good)
    meeting = _meeting(plan, values, rows if len(rows) < count else slice(None))
    allowed = np.ones(len(rows), dtype=bool)
    for mask, expected, *_field in plan.settings.law.conditions(meeting):
        full = np.broadcast_to(mask, allowed.shape)
        for i in rows[allowed & ~full].tolist():
            _note(notes, i, f"expected {expected}")
        # one line per row is enough: only the first condition that fails is reported
        allowed &= full
    if not allowed.all():
        rows = rows[allowed]
        if not len(rows):
            return out
        meeting = _meeting(plan, values, rows)
    for column, result in zip(out, _columns(plan, _apply_law(plan, meeting), rows, notes), strict=True):
        column[rows] = result
    return out


def _fill_spins(plan: TablePlan, values: dict[str, Array], notes: Notes, good: NDArray[np.bool_]) -> None:
    """Set spins before that are not in the table to 0, but of later bounces in flight, which get a note."""
    bounce = values.pop(BOUNCE, None)
    name = next((name for name in ("spin_in", "spin_z_in") if name in values), None)
    empty = np.ones(len(good), bool) if name is None else np.isnan(values[name])
    if bounce is not None:
        for i in np.flatnonzero(good & empty & (bounce > 1)).tolist():
            _note(
                notes,
                i,
                f"spin before bounce {bounce[i]:g}: expected a number, as the ball has bounced before, got none",
            )
    if name is not None:
        values[name] = np.where(empty, 0.0, values[name])


def _note(notes: Notes, i: int, text: str) -> None:
    notes[i] = f"{notes[i]}; {text}" if i in notes else text


def _require_on_floor(values: dict[str, Array], plan: TablePlan, notes: Notes, good: NDArray[np.bool_]) -> None:
    """Add notes to rows off the floor, if balls without spin in the table are taken to roll."""
    for name in ("velocity_z", "height"):
        if name in values:
            bad = good & (values[name] != 0)
        elif plan.constants.get(name, 0.0) != 0:
            bad = good.copy()
        else:
            continue
        for i in np.flatnonzero(bad).tolist():
            _note(
                notes,
                i,
                f"{name}: expected 0 for a ball that is taken to roll; give its spin, or predict with spin none",
            )
        good &= ~bad


def _apply_law(plan: TablePlan, meeting: Meeting) -> Answer:
    law = plan.settings.law
    try:
        with np.errstate(all="ignore"):
            return law.answer(meeting)
    except Exception as error:
        if isinstance(error, CaromError) or laws().get(law.name) is law:
            raise
        # a law of the user's own may go wrong in any way
        what = f"{type(error).__name__}: {(str(error).splitlines() or [''])[0]}"
        raise CaromError(f"law {law.name!r}: expected (v, w) for every row, got {what}") from error


def _meeting(plan: TablePlan, values: dict[str, Array], rows: Any) -> Meeting:
    """Return the rows' states in SI. Bounce and angle form: normal along x, tangent along y, z up; slip is v_t - a spin."""

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


def _normal(plan: TablePlan, values: dict[str, Array], rows: Any) -> Array:
    if "normal_x" in values:
        zero = np.zeros_like(values["normal_x"])
        n = unit_normal(np.stack([values.get(f"normal_{k}", zero) for k in "xyz"], axis=-1)[rows])
    else:
        n = unit_normal(plan.settings.normal or (1.0, 0.0, 0.0))
    sine = plan.settings.contact_height - 1
    if sine == 0:
        return n
    # the wall touches the ball at a * sine above its centre, so its normal there points down by that much
    return n * math.sqrt(1 - sine * sine) - sine * np.array([0.0, 0.0, 1.0])


def _columns(plan: TablePlan, answer: Answer, rows: NDArray[np.intp], notes: Notes) -> list[Array]:
    """Return the added columns in the units of the table; notes for rows that are not finite."""
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
