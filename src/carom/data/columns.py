"""Tables in memory: a mapping of columns, a data frame, a structured array, an Arrow table, and results that hold columns."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np
from numpy.typing import NDArray

from carom.data.plan import TablePlan
from carom.data.rebound_files import reader_of_columns, rebounds_of_columns
from carom.data.rebounds import Kind, Rebounds
from carom.data.table_cells import decimal_commas, parse_numbers
from carom.data.table_files import PARQUET, CsvTable, ParquetTable, TableChunk, add_note, row_label
from carom.errors import CaromError, FaultList
from carom.files import MOST_TABLE, open_regular

Array = NDArray[np.float64]
Columns = dict[str, NDArray[Any]]
CHUNK_ROWS = 1 << 16


def is_columns(table: Any) -> bool:
    """Return whether something is a table in memory (not a path, nor the name of a data set)."""
    return (
        isinstance(table, Mapping)
        or (isinstance(table, np.ndarray) and table.dtype.names is not None)
        or any(hasattr(table, name) for name in ("column_names", "columns", "flat"))
    )


def as_columns(table: Any, where: str = "table") -> Columns:
    """Return the columns (N,) of a table in memory by name; a single number stands for all rows.

    Parameters
    ----------
    table : mapping of names to arrays, structured array, DataFrame (pandas, polars), Arrow table, or Rebounds
    where : str, optional
        What a message begins with.

    Raises CaromError for something else, and for columns of different lengths.

    Examples
    --------
    >>> import numpy as np
    >>> as_columns({"v_n_in": [1.0, 2.0], "speed": 3})["speed"]
    array([3, 3])
    >>> list(as_columns(np.array([(1.0, 2.0)], dtype=[("v_n_in", float), ("v_t_in", float)])))
    ['v_n_in', 'v_t_in']
    """
    given = _columns_by_name(table)
    if given is None:
        raise CaromError(
            f"{where}: expected a path, or columns (a dict of arrays, a DataFrame, a structured array), got"
            f" {type(table).__name__} {table!r:.60}"
        )
    found = {str(name): np.atleast_1d(np.asarray(column)) for name, column in given.items()}
    flat = [name for name, column in found.items() if column.ndim != 1]
    if flat:
        raise CaromError(
            f"{where}: {flat[0]}: expected a column (N,), got an array of shape {found[flat[0]].shape}; give each component"
            " a column of its own"
        )
    lengths = {len(column) for name, column in found.items() if np.ndim(given[name])}
    if len(lengths) > 1:
        got = ", ".join(f"{name} {len(column)}" for name, column in found.items())
        raise CaromError(f"{where}: columns: expected one length for all, got {got}")
    count = lengths.pop() if lengths else 1
    return {name: np.broadcast_to(column, count) if len(column) != count else column for name, column in found.items()}


def _columns_by_name(table: Any) -> Mapping[Any, Any] | None:
    if isinstance(table, Mapping):
        return table
    if isinstance(table, np.ndarray):
        return None if table.dtype.names is None else {name: table[name] for name in table.dtype.names}
    if callable(flat := getattr(table, "flat", None)):  # Rebounds
        return flat()  # type: ignore[no-any-return]
    names = getattr(table, "column_names", None)  # Arrow
    names = getattr(table, "columns", None) if names is None else names
    if isinstance(names, Mapping):
        return names
    return None if names is None else {name: table[name] for name in names}


def read_columns(path: Path) -> tuple[Columns, list[str]]:
    """Return all columns of a CSV or Parquet file by name, and the labels of its rows, such as "line 7".

    A column of which every cell is a number or empty is one of floats, NaN where empty; another one is text. Raises CaromError, one
    line, for a file that cannot be opened.
    """
    with open_regular(path, most=MOST_TABLE) as file:
        start = file.read(4)
    if start == b"PAR1" or path.suffix.lower() in PARQUET:
        with ParquetTable(path) as table:
            arrow = table.whole()
        columns = {name: arrow.column(i).to_numpy() for i, name in enumerate(table.headers)}
        return columns, [f"row {i + 1}" for i in range(arrow.num_rows)]
    with CsvTable(path) as text:
        records = list(text.records())
        commas = text.delimiter != ","
    width = len(text.headers)
    rows = [[*fields[:width], *[""] * (width - len(fields))] for _number, _text, fields in records]
    commas = commas or decimal_commas([cell for row in rows for cell in row])
    found: Columns = {}
    for i, header in enumerate(text.headers):
        cells = [row[i] for row in rows]
        values, bad = parse_numbers(cells, decimal_comma=commas)
        found[header] = np.array(cells, dtype=str) if bad else values
    return found, [f"line {number}" for number, _text, _fields in records]


class ColumnTable:
    """Columns in memory, read in chunks as a file is; what is added is gathered in ``made``."""

    def __init__(self, columns: Columns) -> None:
        """Take columns (N,) by name."""
        self.columns = columns
        self.headers = list(columns)
        self.size = max(len(next(iter(columns.values()), ())), 1)
        self.done = 0
        self.parts: list[tuple[list[Array], dict[int, str], int]] = []
        self.names: list[str] = []

    def chunks(self, plan: TablePlan) -> Iterator[TableChunk]:
        """Iterate over the rows in chunks."""
        numbers: dict[str, Array] = {}
        faults = []
        for name, source in plan.sources.items():
            column = self.columns[source.header]
            try:
                numbers[name] = np.asarray(column, dtype=float)
            except (TypeError, ValueError):
                faults.append(f"column {source.header!r}: expected numbers, got {column.tolist()[0]!r:.40}")
        if faults:
            raise CaromError(*faults)
        count = len(next(iter(self.columns.values()), ()))
        for start in range(0, count, CHUNK_ROWS):
            stop = min(start + CHUNK_ROWS, count)
            notes: dict[int, str] = {}
            for name, source in plan.sources.items():
                empty = np.isnan(numbers[name][start:stop]) if name not in plan.may_be_empty else np.zeros(0, bool)
                for i in np.flatnonzero(empty).tolist():
                    add_note(notes, i, f"{source.header}: expected a number, got an empty cell")
            chunk = {name: column[start:stop].copy() for name, column in numbers.items()}
            self.done = stop
            yield TableChunk(chunk, notes, row_label(start), None)

    def write_head(self, _file: BinaryIO | None, plan: TablePlan) -> None:
        """Note the names of the added columns."""
        self.names = [*(added.header for added in plan.added), plan.note]

    def write(self, _file: BinaryIO | None, chunk: TableChunk, added: list[Array]) -> None:
        """Keep the new columns of a chunk."""
        self.parts.append((added, dict(chunk.notes), len(added[0])))

    def finish(self) -> None:
        """Do nothing: all is in memory."""

    def abort(self) -> None:
        """Do nothing."""

    def made(self) -> Columns:
        """Return the columns, the added ones, and the notes (N,), a text for each row, empty where there is an answer."""
        found = dict(self.columns)
        for k, name in enumerate(self.names[:-1]):
            found[name] = np.concatenate([added[k] for added, _notes, _count in self.parts] or [np.empty(0)])
        notes = [said.get(i, "") for _added, said, count in self.parts for i in range(count)]
        found[self.names[-1]] = np.array(notes, dtype=str) if notes else np.empty(0, dtype=str)
        return found


# ----------------------------------------------------------------------------------------------------
# Measured rebounds from a table in memory: a dict of arrays, a data frame, a structured array.


def as_rebounds(
    table: Any, kind: Kind | None = None, stage: str | None = None, ball: tuple[float, float] | None = None
) -> Rebounds:
    """Return measured rebounds of columns in memory, with names and units as in a file (:func:`carom.data.read_rebounds`).

    Raises CaromError with all problems of the columns.

    Examples
    --------
    >>> as_rebounds({"v_n_in_mm_s": [1500.0], "v_t_in": [0.5], "v_n_out": [1.2], "spin_in": [0.0]})["v_n_in"]
    array([1.5])
    """
    if isinstance(table, Rebounds):
        return table
    faults = FaultList("rebounds")
    columns = as_columns(table, "rebounds")
    headers, cells, rows, number = reader_of_columns(list(columns), list(columns.values()), faults)
    return rebounds_of_columns(headers, cells, number, rows, kind, stage, faults, "rebounds", ball)
