"""CSV tables, read and written in chunks: the text of every row is kept, and new cells are appended to it."""

from __future__ import annotations

import contextlib
import csv
import io
import itertools
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np
from numpy.typing import NDArray

from carom.data.headers import ColumnNames, with_units_below
from carom.data.plan import BOUNCE, TablePlan
from carom.data.table_cells import COMMENT, EMPTY, SPREADSHEET, decimal_commas, parse_numbers
from carom.errors import CaromError
from carom.files import import_optional, open_regular, require_unpacked_size, text_encoding

Array = NDArray[np.float64]
CHUNK_ROWS = 1 << 14
START_BYTES = 512  # in which a file that is not text shows its zeros
DELIMITERS = ",;\t|"
PARQUET = (".parquet", ".pq")  # endings of names
LEADING_LINES = 12  # among which the header is sought, below a title or comments


@dataclass
class TableChunk:
    """Some rows of a table."""

    columns: dict[str, Array]
    """The columns that are read, in the units of the table; NaN if a cell is not a number."""
    notes: dict[int, str]
    """Problems, by index of the row in the chunk."""
    label: Callable[[int], str]
    """Index of a row to its label, such as "line 7"."""
    rows: Any
    """The rows as they were read, to be written again."""


def add_note(notes: dict[int, str], i: int, text: str) -> None:
    """Add a problem of a row to those that it has."""
    notes[i] = f"{notes[i]}; {text}" if i in notes else text


class NumberedLines:
    """Iterator of the lines of a file that counts them, and to which lines can be pushed back."""

    def __init__(self, file: io.TextIOBase) -> None:
        """Iterate over a file."""
        self.file = iter(file)
        self.pushed: deque[str] = deque()
        self.read: list[str] = []
        self.number = 0

    def __iter__(self) -> Iterator[str]:
        """Return itself."""
        return self

    def __next__(self) -> str:
        """Return the next line: one that was pushed back, or the next of the file."""
        line = self.pushed.popleft() if self.pushed else next(self.file)
        self.read.append(line)
        self.number += 1
        return line

    def take(self, count: int) -> list[str]:
        """Return up to so many lines at once: first the lines that were pushed back, then the lines of the file."""
        taken = [self.pushed.popleft() for _ in range(min(count, len(self.pushed)))]
        taken += itertools.islice(self.file, count - len(taken))
        self.number += len(taken)
        return taken

    def consumed(self) -> list[str]:
        """Return the lines read since the last call."""
        lines, self.read = self.read, []
        return lines

    def push_back(self, lines: list[str]) -> None:
        """Put lines back, to be read again."""
        self.pushed.extendleft(reversed(lines))
        self.number -= len(lines)


class CsvTable:
    """A CSV file. Delimiter, decimal sign, line ends and encoding (UTF-8 or UTF-16) are detected, and kept in the output."""

    def __init__(self, path: Path, names: Sequence[ColumnNames] = ()) -> None:
        """Open a file and read its headers. Raises CaromError for a file that is not a CSV table.

        Comments, lines that begin with #, may stand above the header; where ``names`` say which columns there may be, a title as
        well, and a row of units below it.
        """
        self.path, self.names = path, names
        self.raw = open_regular(path)
        try:
            self._begin()
        except BaseException:
            self.raw.close()
            raise

    def _begin(self) -> None:
        path = self.path
        start = self.raw.read(START_BYTES)
        self.encoding = text_encoding(start[:4])
        self.raw.seek(len(self.encoding.mark))
        # bytes that are not UTF-8, in a name say, go through as they are
        self.on_error = "surrogateescape" if self.encoding.codec == "utf-8" else "replace"
        text = io.TextIOWrapper(self.raw, encoding=self.encoding.codec, errors=self.on_error, newline="")
        self.lines = NumberedLines(text)
        self.size = path.stat().st_size
        zeros = b"\0" in start and self.encoding.codec == "utf-8"
        first = "" if zeros else next((line for line in self.lines if line.strip()), "")
        if not first and not zeros:
            raise CaromError(f"{path}: expected a header line and rows, got an empty file")
        named = SPREADSHEET.match(first)
        if named:
            first = next((line for line in self.lines if line.strip()), "")
        if zeros or any(sign < " " and sign not in "\t\r\n" for sign in first):
            raise CaromError(f"{path}: expected a CSV file, a line of text with names first, got a binary file")
        first = self._without_lines_above(first)
        self.end = first[len(first.rstrip("\r\n")) :] or "\n"
        self.delimiter = named[1] if named else max(DELIMITERS, key=first.count)
        self.lines.push_back([first])
        self.lines.consumed()
        # strict: text after a closing quote is the sign of a quote that was never closed
        self.reader = csv.reader(self.lines, delimiter=self.delimiter, strict=True, skipinitialspace=True)
        try:
            self.headers = next(self.reader)
        except csv.Error as error:
            raise CaromError(f"{path}: line {self.lines.number}: expected a header line, got: {error}") from None
        self.head = self._text(self.lines.consumed())
        self._take_units_below()
        self.decimal = "."

    def _without_lines_above(self, first: str) -> str:
        """Return the line of the header, and keep the lines above it: a title and comments, one of which may be the header."""
        seen = [first, *self.lines.take(LEADING_LINES)]
        plain = [COMMENT.sub("", line, count=1) for line in seen]
        rows = [line.split(max(DELIMITERS, key=line.count)) for line in plain]
        known = [sum(any(names.parse(cell.strip(' "')) for names in self.names) for cell in row) > 1 for row in rows]
        uncommented = (k for k, line in enumerate(seen) if line.strip() and not COMMENT.match(line))
        head = known.index(True) if any(known) else next(uncommented, 0)
        self.above = seen[:head]
        self.lines.push_back(seen[head + 1 :])
        return plain[head] if known[head] else seen[head]

    def _take_units_below(self) -> None:
        """Put the units of a row below the header into its brackets."""
        row = next(self.lines, None)
        if row is None:
            return
        cells = [cell.strip(' "') for cell in self._text([row]).split(self.delimiter)]
        units = with_units_below(self.names, self.headers, cells)
        if units is None:
            self.lines.push_back([row])
        else:
            self.headers, self.head = units, self.delimiter.join(map(self.quoted, units))
        self.lines.consumed()

    def __enter__(self) -> CsvTable:
        """Return itself; the file is closed at the end of the with block."""
        return self

    def __exit__(self, *_: object) -> None:
        """Close the file."""
        self.raw.close()

    @property
    def done(self) -> float:
        """Number of bytes read."""
        return self.raw.tell()

    @staticmethod
    def _text(lines: list[str]) -> str:
        return "".join(lines).rstrip("\r\n")

    def records(self) -> Iterator[tuple[int, str, list[str]]]:
        """Iterate over line number, text and fields of the rows, without blank lines.

        A quote that is opened and never closed would absorb the lines after it: such a row ends at the end of its line.
        """
        width = len(self.headers)
        lines, reader = self.lines, self.reader
        while True:
            number = lines.number + 1
            try:
                fields, complete = next(reader), True
            except StopIteration:
                return
            except csv.Error:
                fields, complete = [], False
            taken = lines.consumed()
            if not complete or (len(taken) > 1 and len(fields) != width):
                lines.push_back(taken[1:])
                taken = taken[:1]
                fields = self._text(taken).split(self.delimiter)
                # with its quotes doubled this is one row for any reader of the output
                yield number, self.delimiter.join(map(self.quoted, fields)), fields
            elif fields:
                yield number, self._text(taken), fields

    def _batch(self, records: Iterator[tuple[int, str, list[str]]]) -> tuple[list[int], list[str], list[list[str]]]:
        """Return line numbers, texts and fields of the next rows: split at once if no cell is in quotes, else one by one."""
        lines = self.lines
        first = lines.number + 1
        taken = lines.take(CHUNK_ROWS)
        if '"' not in "".join(taken):
            # without quotes a line is a row
            plain = [line.rstrip("\r\n") for line in taken]
            numbers = [first + i for i, text in enumerate(plain) if text]
            texts = [text for text in plain if text]
            return numbers, texts, [text.split(self.delimiter) for text in texts]
        lines.push_back(taken)
        batch = list(itertools.islice(records, CHUNK_ROWS))
        return [row[0] for row in batch], [row[1] for row in batch], [row[2] for row in batch]

    def chunks(self, plan: TablePlan) -> Iterator[TableChunk]:
        """Iterate over the rows in chunks."""
        width = len(self.headers)
        records = self.records()
        first = True
        while True:
            numbers, texts, rows = self._batch(records)
            if not rows:
                if self._over():
                    return
                continue  # blank lines, as many as are read at once
            notes: dict[int, str] = {}
            for i, row in enumerate(rows):
                if len(row) != width:
                    texts[i] = self._repaired(i, row, texts[i], notes)
            if first:
                self.decimal = self._decimal_sign(plan, rows)
            first = False
            columns = {
                name: self._numbers(
                    [row[source.index] for row in rows], source.header, notes, name in plan.may_be_empty
                )
                for name, source in plan.sources.items()
            }
            yield TableChunk(columns, notes, _line_label(numbers), texts)

    def _over(self) -> bool:
        line = next(self.lines, None)
        self.lines.consumed()
        if line is not None:
            self.lines.push_back([line])
        return line is None

    def _repaired(self, i: int, row: list[str], text: str, notes: dict[int, str]) -> str:
        """Make a row with too few or too many fields as wide as the table; surplus fields go into its note."""
        width = len(self.headers)
        notes[i] = f"expected {width} fields, got {len(row)}"
        if len(row) < width:
            text += self.delimiter * (width - len(row))
            row += [""] * (width - len(row))
            return text
        notes[i] += f", of which left out: {self.delimiter.join(row[width:])}"
        del row[width:]
        return self.delimiter.join(map(self.quoted, row))

    def _decimal_sign(self, plan: TablePlan, rows: list[list[str]]) -> str:
        """Return the decimal sign: a comma if the columns that are read have commas and no points.

        Between commas a cell with a comma is in quotes, and may also be a number with a separator of thousands.
        """
        cells = [row[source.index] for source in plan.sources.values() for row in rows[:1000]]
        if self.delimiter == ",":
            return "," if decimal_commas(cells) else "."
        return "," if any("," in cell for cell in cells) and not any("." in cell for cell in cells) else "."

    def _numbers(self, cells: list[str], header: str, notes: dict[int, str], may_be_empty: bool) -> Array:
        values, bad = parse_numbers(cells, decimal_comma=self.decimal == ",", missing=EMPTY if may_be_empty else ())
        for i in bad if header != BOUNCE else ():  # (words number no bounce)
            got = repr(cells[i]) if cells[i].strip() else "an empty cell"
            add_note(notes, i, f"{header}: expected a number, got {got}")
        return values

    def quoted(self, cell: str) -> str:
        """Return a cell in quotes, if it needs them."""
        if not any(sign in cell for sign in (self.delimiter, '"', "\r", "\n")):
            return cell
        return '"' + cell.replace('"', '""') + '"'

    def write_head(self, file: BinaryIO, plan: TablePlan) -> None:
        """Write the header line with the new headers, below the lines that stood above it."""
        cells = [self.head, *(self.quoted(added.header) for added in plan.added), plan.note]
        file.write(self.encoding.mark + self._bytes("".join(self.above) + self.delimiter.join(cells) + self.end))

    def write(self, file: BinaryIO, chunk: TableChunk, added: list[Array]) -> None:
        """Write the rows of a chunk with the new cells; numbers with all digits, so that they read back exactly."""
        notes = [""] * len(chunk.rows)
        for i, note in chunk.notes.items():
            notes[i] = self.quoted(note)
        columns = [self._cells(column) for column in added]
        lines = map(self.delimiter.join, zip(chunk.rows, *columns, notes, strict=True))
        file.write(self._bytes(self.end.join(lines) + self.end))

    def finish(self) -> None:
        """Do nothing: a CSV file has no footer."""

    def abort(self) -> None:
        """Do nothing: an incomplete CSV file needs no closing."""

    def _cells(self, column: Array) -> list[str]:
        cells = list(map(repr, column.tolist()))
        if self.decimal == ",":
            cells = [self.quoted(cell.replace(".", ",")) for cell in cells]
        for i in np.flatnonzero(np.isnan(column)).tolist():
            cells[i] = ""
        return cells

    def _bytes(self, text: str) -> bytes:
        return text.encode(self.encoding.codec, errors=self.on_error)


def _line_label(numbers: Sequence[int]) -> Callable[[int], str]:
    return lambda i: f"line {numbers[i]}"


def row_label(start: int) -> Callable[[int], str]:
    """Return the labels of rows of a chunk that begins so far into a table without lines."""
    return lambda i: f"row {start + i + 1}"


# ----------------------------------------------------------------------------------------------------
# Parquet tables, read and written in chunks with pyarrow (the extra ``carom[parquet]``).


PARQUET_CHUNK_ROWS = 1 << 17
CELL_BYTES = 8  # of a number in memory


class ParquetTable:
    """A Parquet file; columns of any type are copied; columns that are read must hold numbers."""

    def __init__(self, path: Path) -> None:
        """Open a file and read its headers. Raises CaromError for a file that is not Parquet."""
        pa, pq = (import_optional(name, str(path)) for name in ("pyarrow", "pyarrow.parquet"))
        self.path = path
        open_regular(path, "a Parquet file").close()
        self.pa, self.pq = pa, pq
        try:
            # no read-ahead: a file that is one large row group is still read a page at a time
            self.file = pq.ParquetFile(path, buffer_size=1 << 20, pre_buffer=False)
        except (pa.ArrowException, OSError, ValueError) as error:
            raise CaromError(f"{path}: expected a Parquet file, got: {str(error).splitlines()[0]}") from None
        self.schema = self.file.schema_arrow
        self.headers: list[str] = list(self.schema.names)
        self.size = max(self.file.metadata.num_rows, 1)
        self.done = 0.0
        self.writer: Any = None

    def __enter__(self) -> ParquetTable:
        """Return itself; the file is closed at the end of the with block."""
        return self

    def __exit__(self, *_: object) -> None:
        """Close the file."""
        self.file.close()

    def whole(self) -> Any:
        """Return the table in memory. Raises CaromError for a damaged file, and one that would fill the memory."""
        require_unpacked_size(self.path, CELL_BYTES * self.file.metadata.num_rows * len(self.headers))
        with self._complete():
            return self.file.read()

    @contextlib.contextmanager
    def _complete(self) -> Iterator[None]:
        try:
            yield
        except (self.pa.ArrowException, OSError) as error:
            got = str(error).splitlines()[0]
            raise CaromError(f"{self.path}: expected a complete Parquet file, got: {got}") from None

    def chunks(self, plan: TablePlan) -> Iterator[TableChunk]:
        """Iterate over the rows in chunks."""
        types = self.pa.types
        faults = []
        for source in plan.sources.values():
            kind = self.schema.field(source.index).type
            if not (types.is_floating(kind) or types.is_integer(kind) or types.is_decimal(kind)):
                faults.append(f"column {source.header!r}: expected numbers, got {kind}; write it as a float column")
        if faults:
            raise CaromError(*faults)
        start = 0
        with self._complete():
            for batch in self.file.iter_batches(PARQUET_CHUNK_ROWS):
                if not batch.num_rows:
                    continue
                notes: dict[int, str] = {}
                columns = {
                    name: self._numbers(batch.column(s.index), s.header, notes, name in plan.may_be_empty)
                    for name, s in plan.sources.items()
                }
                yield TableChunk(columns, notes, row_label(start), batch)
                start += batch.num_rows
                self.done = start

    def _numbers(self, column: Any, header: str, notes: dict[int, str], may_be_empty: bool) -> Array:
        values: Array = column.cast(self.pa.float64(), safe=False).to_numpy(zero_copy_only=False)
        if column.null_count and not may_be_empty:
            for i in np.flatnonzero(np.asarray(column.is_null())).tolist():
                add_note(notes, i, f"{header}: expected a number, got an empty cell")
        return values

    def write_head(self, file: BinaryIO, plan: TablePlan) -> None:
        """Begin the output: the columns of the table, then the new ones."""
        pa = self.pa
        fields = [
            *self.schema,
            *(pa.field(added.header, pa.float64()) for added in plan.added),
            pa.field(plan.note, pa.string()),
        ]
        self.out_schema = pa.schema(fields, metadata=self.schema.metadata)
        # (a dictionary of numbers that are all different takes longer to make than the rest of the file, and is thrown away)
        repeated = [field.name for field in self.out_schema if not pa.types.is_floating(field.type)]
        self.writer = self.pq.ParquetWriter(file, self.out_schema, use_dictionary=repeated)

    def write(self, file: BinaryIO, chunk: TableChunk, added: list[Array]) -> None:
        """Write the rows of a chunk with the new columns; null for a row without an answer."""
        pa = self.pa
        notes = pa.nulls(chunk.rows.num_rows, pa.string())
        if chunk.notes:
            notes = pa.array([chunk.notes.get(i) for i in range(chunk.rows.num_rows)], pa.string())
        columns = [*chunk.rows.columns, *(pa.array(column, from_pandas=True) for column in added), notes]
        self.writer.write_batch(pa.record_batch(columns, schema=self.out_schema))

    def finish(self) -> None:
        """Write the footer."""
        self.writer.close()

    def abort(self) -> None:
        """Close an output that will not be kept."""
        if self.writer is not None:
            with contextlib.suppress(self.pa.ArrowException, OSError, ValueError):
                self.writer.close()
