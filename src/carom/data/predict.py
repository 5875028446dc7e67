"""Predicted rebounds for a table of incoming states, one per row: the outgoing state is added as new columns.

The table is processed in chunks of rows, so that ten million rows need no more memory than a hundred thousand. Names of columns
are in :mod:`carom.data.headers` and in the guide, "Predict a table".
"""

from __future__ import annotations

import math
import os
import tempfile
import time
from collections.abc import Callable, Sequence
from contextlib import nullcontext
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.bodies import Ball, Disc, State, Surface, inertia_number
from carom.data.columns import Columns, ColumnTable, as_columns, is_columns, read_columns
from carom.data.headers import STATE_NAMES
from carom.data.plan import (
    BOUNCE,
    CHECKS,
    FINITE,
    PARAMETERS,
    PredictSettings,
    TablePlan,
    bad_numbers,
    make_plan,
    unread,
)
from carom.data.table_files import PARQUET, CsvTable, ParquetTable, add_note
from carom.errors import CaromError, FaultList, suggestion
from carom.files import as_path, atomic_file, open_regular
from carom.formatting import counted
from carom.laws.arrays import unit_normal
from carom.laws.law import MIRROR_WALL, Answer, Law, Meeting
from carom.laws.registry import find_law, laws
from carom.public.defaults import CONTACT_HEIGHT, FLOOR_CONTACT, GRAVITY
from carom.public.progress import Progress

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
    unknown = _fill_spins(plan, values, notes, good)
    good[list(notes)] = False
    for name, column in values.items():
        holds, expected = CHECKS.get(name, FINITE)
        for i in np.flatnonzero(good & ~holds(column)).tolist():
            add_note(notes, i, f"{plan.sources[name].header}: expected {expected}, got {float(columns[name][i])!r}")
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
            add_note(notes, i, f"expected {expected}")
        # one line per row is enough: only the first condition that fails is reported
        allowed &= full
    if not allowed.all():
        rows = rows[allowed]
        if not len(rows):
            return out
        meeting = _meeting(plan, values, rows)
    for column, result in zip(out, _columns(plan, _apply_law(plan, meeting), rows, notes), strict=True):
        column[rows] = result
    out[2][unknown & plan.air] = math.nan  # (the spin after is as little known)
    return out


def _fill_spins(plan: TablePlan, values: dict[str, Array], notes: Notes, good: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Set spins before that are not in the table to 0, but of later bounces in flight: return where these are, which is unknown.

    They get a note, unless the law's velocities depend on no spin.
    """
    bounce = values.pop(BOUNCE, np.zeros(len(good)))
    name = next((name for name in ("spin_in", "spin_z_in") if name in values), None)
    empty = np.ones(len(good), bool) if name is None else np.isnan(values[name])
    unknown: NDArray[np.bool_] = empty & (bounce > 1)
    for i in np.flatnonzero(good & unknown & (plan.settings.law.response != MIRROR_WALL)).tolist():
        add_note(notes, i, f"spin before bounce {bounce[i]:g}: expected a number after an earlier bounce, got none")
    if name is not None:
        values[name] = np.where(empty, 0.0, values[name])
    return unknown


def _require_on_floor(values: dict[str, Array], plan: TablePlan, notes: Notes, good: NDArray[np.bool_]) -> None:
    """Add notes to rows off the floor, if balls without spin in the table are taken to roll."""
    for name in ("velocity_z", "height"):
        bad = good & (values.get(name, np.zeros(1) + plan.constants.get(name, 0.0)) != 0)
        for i in np.flatnonzero(bad).tolist():
            fault = f"{name}: expected 0 for a ball that is taken to roll; give its spin, or predict with spin none"
            add_note(notes, i, fault)
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
        add_note(notes, int(rows[i]), str(answer.why[i]))
    lost = ~np.isfinite(answer.after_wall.velocity).all(axis=-1) | ~np.isfinite(answer.after_wall.spin).all(axis=-1)
    for i in np.flatnonzero(lost).tolist():
        notes.setdefault(int(rows[i]), "the law gives no finite answer")
    found: list[Array] = []
    for state in (answer.after_wall, answer.final)[: 1 + plan.rolls]:
        v, w = state.velocity, state.spin
        x, y = v[:, 0], v[:, 1]
        in_space = plan.form == "vector" or (state is answer.after_wall and not plan.air)
        found += [*v.T, *w.T] if in_space else [x, y, w[:, 2]]
        if plan.form == "angle":
            found += [np.sqrt((v * v).sum(axis=-1)), np.arctan2(y, x)]
    return [added.unit.from_si(column) for added, column in zip(plan.added, found, strict=True)]


# ----------------------------------------------------------------------------------------------------
# Predicted rebounds for a table of incoming states, one per row: the outgoing state is added as new columns.


# So many rows without an answer are listed; the note column has them all.
TEXT = (".csv", ".tsv", ".txt")  # endings of names of tables
MAX_LISTED_ROWS = 20
STANDARD_OUTPUT = "-"


@dataclass
class PredictSummary:
    """Summary of a predicted table.

    Examples
    --------
    >>> from carom.data import PredictSummary
    >>> PredictSummary("in.csv", "out.csv", "two-step", rows=10, answered=8).without_answer
    2
    """

    table: str
    out: str | None
    law: str
    rows: int = 0
    answered: int = 0
    """Rows with a state after the wall and no note."""
    added: list[str] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    """How the table was read, and what was assumed."""
    faults: list[dict[str, Any]] = field(default_factory=list)
    """The first rows without an answer: {"row": "line 7", "what": ...}."""
    seconds: float = 0.0
    columns: Columns = field(default_factory=dict, repr=False)
    """The columns (N,) of the table and those that were added, by name; empty where they were written to a file."""

    def __getitem__(self, name: str) -> NDArray[Any]:
        """Return a column (N,)."""
        if name not in self.columns:
            raise CaromError(
                f"predict: {name!r}: expected a column of the result; {suggestion(name, list(self.columns))}"
            )
        return self.columns[name]

    def as_dict(self) -> dict[str, Any]:
        """Return all but the columns, for JSON."""
        return {name: x for name, x in vars(self).items() if name != "columns"} | {
            "without_answer": self.without_answer
        }

    @property
    def without_answer(self) -> int:
        """Number of rows with a note."""
        return self.rows - self.answered


def predict_table(
    table: str | Path,
    out: str | Path | None,
    settings: PredictSettings,
    *,
    strict: bool = False,
    progress: Progress | None = None,
    say: Callable[[str], None] | None = None,
) -> PredictSummary:
    """Write a table of incoming states (CSV or Parquet) with the outgoing states added.

    Parameters
    ----------
    table : path
        Columns, units and defaults: see the guide, "Predict a table".
    out : path or None
        A new file of the same kind, written completely or not at all; None: standard output (CSV only).
    settings : PredictSettings
        The law, and numbers that the table lacks.
    strict : bool
        A row without an answer is an error, and nothing is written. Otherwise its new cells are empty, and the ``note``
        column says why.
    progress : callable(done, total, text), optional
        Called after every chunk of rows.
    say : callable(text), optional
        Called with each note on how the table was read, before the first row.

    Returns
    -------
    PredictSummary

    Raises
    ------
    CaromError
        For a table that cannot be read, and with ``strict`` for rows without an answer.

    Examples
    --------
    >>> import pathlib, tempfile
    >>> import carom
    >>> from carom.data import PredictSettings, predict_table
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     table, out = pathlib.Path(folder) / "in.csv", pathlib.Path(folder) / "out.csv"
    ...     _ = table.write_text("v_n_in,v_t_in\\n1.5,0.5\\n")
    ...     settings = PredictSettings(carom.LAWS["mirror"], given={"restitution": 0.5})
    ...     summary = predict_table(table, out, settings)
    ...     lines = out.read_text().splitlines()
    >>> summary.answered, summary.added[:2]
    (1, ['v_n_out', 'v_t_out'])
    >>> lines[1].split(",")[:4]
    ['1.5', '0.5', '0.75', '0.5']
    """
    source = as_path("predict_table", table)
    target = None if out is None else as_path("predict_table", out)
    with _open(source, target) as rows:
        return _add_predictions(rows, source, target, settings, strict, progress, say)


def _add_predictions(
    rows: Any,
    source: Path | None,
    target: Path | None,
    settings: PredictSettings,
    strict: bool,
    progress: Progress | None,
    say: Callable[[str], None] | None,
) -> PredictSummary:
    """Add predictions to the rows of an open table, chunk by chunk; without a ``source`` they are kept in memory."""
    started = time.perf_counter()
    plan = make_plan(rows.headers, settings)
    name = "columns" if source is None else str(source)
    summary = PredictSummary(name, None if target is None else str(target), settings.law.name, notes=plan.notes)
    summary.added = [*(added.header for added in plan.added), plan.note]
    for note in plan.notes if say else ():
        say(note)  # type: ignore[misc]
    empty, spins = 0, [name for name in plan.may_be_empty if name != BOUNCE]
    with nullcontext() if source is None else atomic_file(target, source=source) as file:
        try:
            rows.write_head(file, plan)
            for chunk in rows.chunks(plan):
                empty += sum(int(np.isnan(chunk.columns[name]).sum()) for name in spins)
                added = predict_rows(plan, chunk.columns, chunk.notes)
                if chunk.notes:
                    _list_faults(summary, chunk.notes, chunk.label)
                    if strict:
                        raise CaromError(*_strict(name, summary, len(chunk.notes)))
                rows.write(file, chunk, added)
                count = len(added[0])
                summary.rows += count
                summary.answered += count - len(chunk.notes)
                if progress:
                    progress(rows.done, rows.size, "predict")
            rows.finish()
            if empty:
                later = ", but for later bounces, whose spin is unknown" if BOUNCE in plan.sources else ""
                summary.notes.append(f"{' '.join(spins)}: {counted(empty, 'empty cell')} taken as 0{later}")
                if say:
                    say(summary.notes[-1])
        except BaseException:
            rows.abort()
            raise
    summary.seconds = time.perf_counter() - started
    return summary


def _list_faults(summary: PredictSummary, notes: dict[int, str], label: Callable[[int], str]) -> None:
    for i in sorted(notes)[: MAX_LISTED_ROWS - len(summary.faults)]:
        summary.faults.append({"row": label(i), "what": notes[i]})


def _strict(source: str, summary: PredictSummary, count: int) -> list[str]:
    faults = [f"{source}: {fault['row']}: {fault['what']}" for fault in summary.faults]
    if count > len(faults):
        faults.append(f"{source}: {count - len(faults)} more rows like these; the rows after them were not read")
    return faults


def _first_bytes(source: Path) -> bytes:
    """Return the first four bytes of a table. Raises CaromError for a file that cannot be read."""
    from carom.data import datasets

    hint = f"carom datasets {source} `out` {source}.csv writes it" if str(source) in datasets.names() else ""
    with open_regular(source, "a CSV or Parquet file", advice=hint) as file:
        return file.read(4)


def _open(source: Path, target: Path | None) -> Any:
    is_text = _first_bytes(source) != b"PAR1" and source.suffix.lower() not in PARQUET
    if target is None and not is_text:
        raise CaromError(f"`out`: expected a file to write Parquet to, got none, and {source} is Parquet")
    endings = {*(TEXT if is_text else PARQUET), source.suffix.lower(), ""}
    if target is not None and (ending := target.suffix.lower()) not in endings:
        wanted = f"a {'CSV' if is_text else 'Parquet'} file, as the table is one ({' or '.join(TEXT if is_text else PARQUET)})"
        raise CaromError(f"`out` {target}: expected {wanted}, got the ending {ending}")
    if is_text:
        return CsvTable(source, (STATE_NAMES,))
    return ParquetTable(source)


def _one_of(name: str, text: str | None, known: dict[str | None, str]) -> Any:
    """Return a text that is one of some; CaromError, with what they mean, for another."""
    if text in known:
        return text
    expected = " or ".join(f"{one!r}{meant}" for one, meant in known.items() if one)
    raise CaromError(f"`{name}`: expected {expected}, got {text!r}; {suggestion(text, list(filter(None, known)))}")


def predict(
    table: str | Path | Any,
    law: str | Law = "two-step",
    *,
    out: str | Path | None = None,
    strict: bool = False,
    spin: str | None = None,
    suffix: str | None = None,
    speed: float | None = None,
    radius: float | None = None,
    mass: float | None = None,
    inertia: str | float | None = None,
    height: float | None = None,
    restitution: float | None = None,
    friction: float | None = None,
    tangential_restitution: float | None = None,
    stiffness_ratio: float | None = None,
    normal: Sequence[float] | None = None,
    contact_height: float = CONTACT_HEIGHT,
    floor_restitution: float | None = None,
    floor_friction: float | None = None,
    floor_tangential_restitution: float | None = None,
    floor_contact: str = FLOOR_CONTACT,
    gravity: float = GRAVITY,
    progress: Progress | None = None,
    say: Callable[[str], None] | None = None,
) -> PredictSummary:
    """Predict the outgoing state for each incoming state of a table: ``carom predict``, for files and for arrays.

    Parameters
    ----------
    table : path, or columns
        A CSV or Parquet file; or a mapping of names to arrays (N,), a DataFrame, a structured array, an Arrow table, or Rebounds.
        The names of the columns say what they are, and in which unit if it is not the SI one: see the guide, "Predict a table".
    law : str or Law
        Name of a law (:data:`carom.LAWS`), or a custom one, my_law.py:law.
    out : path, optional
        A new file of the same kind as the table, written completely or not at all; "-": standard output. Default: the columns
        are in the result.
    strict : bool
        Fail, and write nothing, if there is no prediction for a row. Otherwise its new cells are empty (NaN), and the note column
        says why.
    spin : str, optional
        Spin of rows without one: rolling or none. Default: rolling; none for laws of a ball in flight.
    suffix : str, optional
        Suffix of the names of added columns. Default: _predicted where a name is taken.
    speed : float, optional
        Speed of every row, m/s, for tables with incidence_deg.
    radius : float, optional
        Radius, m. Default: 0.02625.
    mass : float, optional
        Mass, kg. Default: 0.1406.
    inertia : str or float, optional
        "solid", "hollow" or I/(m a^2). Default: solid.
    height : float, optional
        Height of the ball above the floor when it meets the wall, m. Default: 0.
    restitution : float, optional
        Coefficient of restitution, 0 to 1. Default: 1.
    friction : float, optional
        Friction coefficient; inf: never slips. Default: inf.
    tangential_restitution : float, optional
        Tangential restitution, -1 to 1: 0 stops the slip, 1 reverses it. Default: 0.
    stiffness_ratio : float, optional
        Tangential over normal stiffness, for laws with tangential compliance. Default: 14/17, the same material.
    normal : 3 numbers, optional
        Normal from wall to ball, for states as vectors. Default: 1,0,0.
    contact_height : float
        Height of the contact above the floor, in ball radii; billiard cushions: 1.25 to 1.4.
    floor_restitution : float, optional
        Coefficient of restitution, 0 to 1. Default: 0.
    floor_friction : float, optional
        Friction coefficient; inf: never slips. Default: inf.
    floor_tangential_restitution : float, optional
        Tangential restitution, -1 to 1: 0 stops the slip, 1 reverses it. Default: 0.
    floor_contact : "with" or "after"
        Whether a ball that the wall presses down meets the floor with the wall or after it.
    gravity : float
        Gravity, m/s^2.
    progress : callable(done, total, text), optional
        Called after every chunk of rows.
    say : callable(text), optional
        Called with each note on how the table was read, before the first row.

    Returns
    -------
    PredictSummary
        ``found["v_n_out"]`` is a column (N,), ``found.columns`` all of them, unless they were written to a file.

    Raises
    ------
    CaromError
        One line per problem: a table that cannot be read, numbers that are out of range or that the law does not read, and with
        ``strict`` rows without a prediction.

    Examples
    --------
    >>> import carom
    >>> found = carom.predict({"v_n_in": [1.5, 3.0], "v_t_in": [0.5, 0.0]}, "mirror", restitution=0.5)
    >>> found["v_n_out"], found["v_t_out"], found.answered
    (array([0.75, 1.5 ]), array([0.5, 0. ]), 2)
    """
    settings = predict_settings(
        law, spin=spin, suffix=suffix, speed=speed, radius=radius, mass=mass, inertia=inertia, height=height,
        restitution=restitution, friction=friction, tangential_restitution=tangential_restitution,
        stiffness_ratio=stiffness_ratio, normal=normal, contact_height=contact_height, floor_restitution=floor_restitution,
        floor_friction=floor_friction, floor_tangential_restitution=floor_tangential_restitution,
        floor_contact=floor_contact, gravity=gravity,
    )  # fmt: skip
    if is_columns(table) or not isinstance(table, str | os.PathLike):
        if out is not None:
            raise CaromError(f"predict: out: expected none with columns in memory, got {str(out)!r}; save the result")
        memory = ColumnTable(as_columns(table, "predict: table"))
        summary = _add_predictions(memory, None, None, settings, strict, progress, say)
        summary.columns = memory.made()
        return summary
    path = as_path("predict", table)
    if out is not None:
        target = None if str(out) == STANDARD_OUTPUT else out
        return predict_table(path, target, settings, strict=strict, progress=progress, say=say)
    with tempfile.TemporaryDirectory() as folder:  # (what the command writes, read back)
        made = Path(folder) / f"predicted{path.suffix}"
        summary = predict_table(path, made, settings, strict=strict, progress=progress, say=say)
        summary.out, summary.columns = None, read_columns(made)[0]
    said = summary.columns[summary.added[-1]].tolist()
    summary.columns[summary.added[-1]] = np.array([one if isinstance(one, str) else "" for one in said], str)
    return summary


def predict_settings(
    law: str | Law = "two-step",
    *,
    spin: str | None = None,
    suffix: str | None = None,
    normal: Sequence[float] | None = None,
    contact_height: float = CONTACT_HEIGHT,
    floor_contact: str = FLOOR_CONTACT,
    gravity: float = GRAVITY,
    inertia: str | float | None = None,
    **numbers: float | None,
) -> PredictSettings:
    """Return the settings of arguments of :func:`predict`; CaromError, one line per problem, with all of them."""
    faults = FaultList()
    given = {name: value for name, value in numbers.items() if value is not None}
    if inertia is not None and (kappa := faults.attempt(inertia_number, inertia)) is not None:
        given["kappa"] = kappa
    chosen = law if isinstance(law, Law) else faults.attempt(find_law, law)
    rule = faults.attempt(_one_of, "spin", spin, {"rolling": "", "none": "", None: ""})
    ways = {"with": " (at once)", "after": " (first the wall, then the floor)"}
    contact = faults.attempt(_one_of, "floor_contact", floor_contact, ways)
    idle = [] if chosen is None else [name for name in given if name in unread(chosen)]
    for name in idle:
        reads = ", ".join(chosen.reads or ())
        faults.add(f"`{name}`", "a law that reads it", f"{chosen.name}, which reads {reads}", "omit it")
    way = None if normal is None else faults.attempt(_wall_normal, normal)
    faults += bad_numbers({k: x for k, x in given.items() if k not in idle}, way, contact_height, gravity)
    faults.raise_if_any()
    return PredictSettings(chosen, given, way, contact_height, rule, gravity, contact, suffix)


def _wall_normal(normal: Sequence[float]) -> tuple[float, float, float]:
    try:
        x, y, z = (float(part) for part in normal)
    except (TypeError, ValueError):
        raise CaromError(f"`normal`: expected three numbers, such as (1, 0, 0), got {normal!r}") from None
    return x, y, z
