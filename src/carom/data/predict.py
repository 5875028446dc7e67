"""Predicted rebounds for a table of incoming states, one per row: the outgoing state is added as new columns.

The table is processed in chunks of rows, so that ten million rows need no more memory than a hundred thousand. Names of columns
are in :mod:`carom.data.headers` and in the guide, "Predict a table".
"""

from __future__ import annotations

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

from carom.bodies import inertia_number
from carom.data.columns import Columns, ColumnTable, as_columns, is_columns, read_columns
from carom.data.csv import CsvTable
from carom.data.evaluate import predict_rows
from carom.data.headers import STATE_NAMES
from carom.data.limits import bad_numbers
from carom.data.plan import BOUNCE, PredictSettings, SpinRule, make_plan, unread
from carom.errors import CaromError, FaultList, suggestion
from carom.files import as_path, atomic_file, open_regular
from carom.formatting import counted
from carom.laws.law import Law
from carom.laws.results import FloorContact
from carom.laws.user import find_law
from carom.public.defaults import CONTACT_HEIGHT, FLOOR_CONTACT, GRAVITY
from carom.public.progress import Progress

__all__ = ["PredictSettings", "PredictSummary", "predict", "predict_settings", "predict_table"]

# So many rows without an answer are listed; the note column has them all.
TEXT, PARQUET = (".csv", ".tsv", ".txt"), (".parquet", ".pq")  # endings of names of tables
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
    from carom.data.parquet import ParquetTable

    return ParquetTable(source)


def _spin_rule(text: str | None) -> SpinRule | None:
    if text is None or text in ("rolling", "none"):
        return text  # type: ignore[return-value]
    raise CaromError(f"`spin`: expected 'rolling' or 'none', got {text!r}; {suggestion(text, ['rolling', 'none'])}")


def _floor_contact(text: str) -> FloorContact:
    if text in ("with", "after"):
        return text  # type: ignore[return-value]
    raise CaromError(
        f"`floor_contact`: expected 'with' (at once) or 'after' (first the wall, then the floor), got {text!r}"
    )


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
        A name of :data:`carom.LAWS`, "my_law.py:law", or a Law.
    out : path, optional
        A new file of the same kind as the table, written completely or not at all; "-": standard output. Default: the columns
        are in the result.
    strict : bool
        Whether a row without a prediction is an error. Otherwise its new cells are empty (NaN), and the note column says why.
    spin : "rolling" or "none", optional
        The spin of rows without one. Default: rolling, for laws of a ball in flight none.
    suffix : str, optional
        Of the names of the added columns. Default: ``_predicted`` where a name is taken.
    speed : float, optional
        Of all rows, m/s, for tables with ``incidence_deg``.
    radius, mass, inertia, height : optional
        The ball: m, kg, "solid", "hollow" or I/(m a^2); height above the floor when it meets the wall, m. Like all numbers that
        follow, they have precedence over columns of the same name. Default: 0.02625, 0.1406, "solid", 0.
    restitution, friction, tangential_restitution, stiffness_ratio : float, optional
        The wall. Default: 1, inf, 0, and 14/17 (the same material).
    normal : 3 numbers, optional
        From the wall to the ball, for states as vectors. Default: (1, 0, 0).
    contact_height : float
        Height of the contact above the floor, in radii of the ball.
    floor_restitution, floor_friction, floor_tangential_restitution : float, optional
        The floor. Default: 0, inf, 0.
    floor_contact : "with" or "after"
        Whether a ball that the wall presses down meets the floor with the wall or after it.
    gravity : float
        m/s^2.
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
    note = summary.added[-1]
    summary.columns[note] = np.array(
        [said if isinstance(said, str) else "" for said in summary.columns[note].tolist()], str
    )
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
    rule, contact = faults.attempt(_spin_rule, spin), faults.attempt(_floor_contact, floor_contact)
    idle = [] if chosen is None else [name for name in given if name in unread(chosen)]
    for name in idle:
        reads = ", ".join(chosen.reads or ())
        faults.add(f"`{name}`", "a law that reads it", f"{chosen.name}, which reads {reads}", "omit it")
    way = None if normal is None else faults.attempt(_normal, normal)
    faults += bad_numbers({k: x for k, x in given.items() if k not in idle}, way, contact_height, gravity)
    faults.raise_if_any()
    return PredictSettings(chosen, given, way, contact_height, rule, gravity, contact, suffix)


def _normal(normal: Sequence[float]) -> tuple[float, float, float]:
    try:
        x, y, z = (float(part) for part in normal)
    except (TypeError, ValueError):
        raise CaromError(f"`normal`: expected three numbers, such as (1, 0, 0), got {normal!r}") from None
    return x, y, z
