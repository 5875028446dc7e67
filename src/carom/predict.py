"""`carom predict`: a table of incoming states, one a row, to the same table with the outgoing state added.

The table streams through: some rows are read, answered and written, then the next, so that ten million rows need no
more memory than a hundred thousand. What the columns may be called is in :mod:`carom.tables.units` and in the guide.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from carom.checks import nearest
from carom.errors import CaromError
from carom.files import path_of
from carom.tables.output import whole_file
from carom.tables.plan import Settings, SpinRule, make_plan
from carom.tables.rows import answer_rows
from carom.tables.text import CsvTable

__all__ = ["Settings", "Summary", "predict_table"]

# As many faults are told one by one; the note column has them all.
TOLD = 20


@dataclass
class Summary:
    """What became of a table."""

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
        """Rows with a note."""
        return self.rows - self.answered


def predict_table(
    table: str | Path,
    out: str | Path | None,
    settings: Settings,
    *,
    strict: bool = False,
    progress: Callable[[float, float], None] | None = None,
    say: Callable[[str], None] | None = None,
) -> Summary:
    """Write the table (CSV or Parquet) with the outgoing state added.

    Parameters
    ----------
    table : path
        The columns, their units and what may be left out: see the guide, "Predict a table".
    out : path or None
        A new file of the same kind; None: standard output (CSV only). It is whole or not there.
    settings : Settings
        The law, and what the table does not say.
    strict : bool
        A row without an answer is an error, and nothing is written. Otherwise it keeps its place, its new cells are
        empty and the ``note`` column says why.
    progress : callable(done, all), optional
        Called after every piece.
    say : callable(text), optional
        Called with each note on how the table was read, before the first row.

    Returns
    -------
    Summary

    Raises
    ------
    CaromError where the table cannot be read at all, and with ``strict`` for rows without an answer.
    """
    source = path_of("predict_table", table)
    target = None if out is None else path_of("predict_table", out)
    started = time.perf_counter()
    with _open(source, target) as rows:
        plan = make_plan(rows.headers, settings)
        summary = Summary(str(table), None if out is None else str(out), settings.law.name, notes=plan.notes)
        summary.added = [*(added.header for added in plan.added), plan.note]
        for note in plan.notes if say else ():
            say(note)  # type: ignore[misc]
        with whole_file(target, source) as file:
            try:
                rows.write_head(file, plan)
                for piece in rows.pieces(plan):
                    added = answer_rows(plan, piece.columns, piece.notes)
                    if piece.notes:
                        _tell(summary, piece.notes, piece.name)
                        if strict:
                            raise CaromError(*_strict(source, summary, len(piece.notes)))
                    rows.write(file, piece, added)
                    count = len(added[0])
                    summary.rows += count
                    summary.answered += count - len(piece.notes)
                    if progress:
                        progress(rows.done, rows.size)
                rows.finish()
            except BaseException:
                rows.give_up()
                raise
    summary.seconds = time.perf_counter() - started
    return summary


def _tell(summary: Summary, notes: dict[int, str], name: Callable[[int], str]) -> None:
    for i in sorted(notes)[: TOLD - len(summary.faults)]:
        summary.faults.append({"row": name(i), "what": notes[i]})


def _strict(source: Path, summary: Summary, count: int) -> list[str]:
    faults = [f"{source}: {fault['row']}: {fault['what']}" for fault in summary.faults]
    if count > len(faults):
        faults.append(f"{source}: {count - len(faults)} more rows like these, and what comes after them was not read")
    return faults


def _open(source: Path, target: Path | None) -> Any:
    try:
        with source.open("rb") as file:
            start = file.read(4)
    except OSError as error:
        from carom import datasets

        hint = (
            f"; carom datasets {source} --out {source}.csv writes that one" if str(source) in datasets.names() else ""
        )
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
    from carom.tables.parquet import ParquetTable

    return ParquetTable(source)


def spin_rule(text: str | None) -> SpinRule | None:
    """``--spin``; CaromError where it is neither."""
    if text is None or text in ("rolling", "none"):
        return text  # type: ignore[return-value]
    raise CaromError(f"--spin: expected 'rolling' or 'none', got {text!r}; {nearest(text, ['rolling', 'none'])}")
