"""Predicted rebounds for a table of incoming states, one per row: the outgoing state is added as new columns.

The table is processed in chunks of rows, so that ten million rows need no more memory than a hundred thousand. Names of columns
are in :mod:`carom.data.headers` and in the guide, "Predict a table".
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from carom.data.csv import CsvTable
from carom.data.evaluate import predict_rows
from carom.data.plan import BOUNCE, PredictSettings, SpinRule, make_plan
from carom.errors import CaromError, suggestion
from carom.files import as_path, atomic_file
from carom.formatting import counted

__all__ = ["PredictSettings", "PredictSummary", "predict_table"]

# So many rows without an answer are listed; the note column has them all.
MAX_LISTED_ROWS = 20


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
    progress: Callable[[float, float], None] | None = None,
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
    progress : callable(done, all), optional
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
    started = time.perf_counter()
    with _open(source, target) as rows:
        plan = make_plan(rows.headers, settings)
        summary = PredictSummary(str(table), None if out is None else str(out), settings.law.name, notes=plan.notes)
        summary.added = [*(added.header for added in plan.added), plan.note]
        for note in plan.notes if say else ():
            say(note)  # type: ignore[misc]
        empty, spins = 0, [name for name in plan.may_be_empty if name != BOUNCE]
        with atomic_file(target, source=source) as file:
            try:
                rows.write_head(file, plan)
                for chunk in rows.chunks(plan):
                    empty += sum(int(np.isnan(chunk.columns[name]).sum()) for name in spins)
                    added = predict_rows(plan, chunk.columns, chunk.notes)
                    if chunk.notes:
                        _list_faults(summary, chunk.notes, chunk.label)
                        if strict:
                            raise CaromError(*_strict(source, summary, len(chunk.notes)))
                    rows.write(file, chunk, added)
                    count = len(added[0])
                    summary.rows += count
                    summary.answered += count - len(chunk.notes)
                    if progress:
                        progress(rows.done, rows.size)
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


def _strict(source: Path, summary: PredictSummary, count: int) -> list[str]:
    faults = [f"{source}: {fault['row']}: {fault['what']}" for fault in summary.faults]
    if count > len(faults):
        faults.append(f"{source}: {count - len(faults)} more rows like these; the rows after them were not read")
    return faults


def _open(source: Path, target: Path | None) -> Any:
    try:
        with source.open("rb") as file:
            start = file.read(4)
    except OSError as error:
        from carom.data import datasets

        hint = f"; carom datasets {source} --out {source}.csv writes it" if str(source) in datasets.names() else ""
        raise CaromError(
            f"table {str(source)!r}: expected a CSV or Parquet file, got: {error.strerror}{hint}"
        ) from None
    if start != b"PAR1" and source.suffix.lower() not in (".parquet", ".pq"):
        if target is not None and target.suffix.lower() in (".parquet", ".pq"):
            raise CaromError(
                f"--out {target}: expected a CSV file, as the table is one, got the name of a Parquet file"
            )
        return CsvTable(source)
    if target is None:
        raise CaromError(f"--out: expected a file to write Parquet to, got none, and {source} is Parquet")
    if target.suffix.lower() in (".csv", ".tsv", ".txt"):
        raise CaromError(f"--out {target}: expected a Parquet file, as the table is one, got the name of a text file")
    from carom.data.parquet import ParquetTable

    return ParquetTable(source)


def spin_rule(text: str | None) -> SpinRule | None:
    """Return the value of ``--spin``. Raises CaromError if it is neither ``rolling`` nor ``none``."""
    if text is None or text in ("rolling", "none"):
        return text  # type: ignore[return-value]
    raise CaromError(f"--spin: expected 'rolling' or 'none', got {text!r}; {suggestion(text, ['rolling', 'none'])}")
