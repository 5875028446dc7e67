"""CSV tables, a piece at a time: every row's own text is kept, and the new cells are put after it."""

from __future__ import annotations

import csv
import io
import itertools
import math
from collections import deque
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np
from numpy.typing import NDArray

from carom.errors import CaromError
from carom.tables.plan import Plan

__all__ = ["ROWS_AT_ONCE", "CsvTable", "Piece"]

Array = NDArray[np.float64]
ROWS_AT_ONCE = 1 << 14
DELIMITERS = ",;\t|"
BOM = b"\xef\xbb\xbf"


@dataclass
class Piece:
    """Some rows of a table."""

    columns: dict[str, Array]
    """The plan's sources, in the table's units; NaN where a row is at fault."""
    notes: dict[int, str]
    """What is wrong, by row of the piece."""
    name: Callable[[int], str]
    """What people call a row: "line 7"."""
    rows: Any
    """The rows as they came, to be written again."""


class Lines:
    """Lines of a file, numbered, some of which may be put back."""

    def __init__(self, file: io.TextIOBase) -> None:
        """Take the lines of a file."""
        self.file = iter(file)
        self.back: deque[str] = deque()
        self.taken: list[str] = []
        self.number = 0

    def __iter__(self) -> Iterator[str]:
        """Itself."""
        return self

    def __next__(self) -> str:
        """The next line: one that was put back, or of the file."""
        line = self.back.popleft() if self.back else next(self.file)
        self.taken.append(line)
        self.number += 1
        return line

    def take(self) -> list[str]:
        """The lines handed out since the last call."""
        lines, self.taken = self.taken, []
        return lines

    def give_back(self, lines: list[str]) -> None:
        """Lines to hand out again."""
        self.back.extendleft(reversed(lines))
        self.number -= len(lines)


class CsvTable:
    """A CSV file: header, delimiter, decimal sign and line ends as they are found; UTF-8, with or without a BOM."""

    def __init__(self, path: Path) -> None:
        """Open a file and read its headers; CaromError where it is none of this kind."""
        self.path = path
        self.raw = path.open("rb")
        try:
            self._begin()
        except BaseException:
            self.raw.close()
            raise

    def _begin(self) -> None:
        path = self.path
        start = self.raw.read(4)
        if start.startswith((b"\xff\xfe", b"\xfe\xff")):
            raise CaromError(f"{path}: expected a CSV file in UTF-8, got UTF-16; save it as 'CSV UTF-8'")
        self.bom = start.startswith(BOM)
        self.raw.seek(len(BOM) if self.bom else 0)
        # bytes that are not UTF-8, in a name say, go through as they are
        text = io.TextIOWrapper(self.raw, encoding="utf-8", errors="surrogateescape", newline="")
        self.lines = Lines(text)
        self.size = path.stat().st_size
        first = next((line for line in self.lines if line.strip()), "")
        if not first:
            raise CaromError(f"{path}: expected a header line and rows, got an empty file")
        if any(sign < " " and sign not in "\t\r\n" for sign in first):
            raise CaromError(
                f"{path}: expected a CSV file, a line of text with names first, got bytes that are no text"
            )
        self.end = first[len(first.rstrip("\r\n")) :] or "\n"
        self.delimiter = max(DELIMITERS, key=first.count)
        self.lines.give_back([first])
        self.lines.take()
        # strict: text after a closing quote is the sign of a quote that was never closed
        self.reader = csv.reader(self.lines, delimiter=self.delimiter, strict=True)
        try:
            self.headers = next(self.reader)
        except csv.Error as error:
            raise CaromError(f"{path}: line {self.lines.number}: expected a header line, got: {error}") from None
        self.head = self._text(self.lines.take())
        self.decimal = "."

    def __enter__(self) -> CsvTable:
        """Use in a with block: the file is closed at its end."""
        return self

    def __exit__(self, *_: object) -> None:
        """Close the file."""
        self.raw.close()

    @property
    def done(self) -> float:
        """Bytes read."""
        return self.raw.tell()

    @staticmethod
    def _text(lines: list[str]) -> str:
        return "".join(lines).rstrip("\r\n")

    def records(self) -> Iterator[tuple[int, str, list[str]]]:
        """Line number, text and fields of every row; blank lines are left out.

        A quote that is opened and never closed would swallow the lines after it: such a row ends at its line's end.
        """
        width = len(self.headers)
        lines, reader = self.lines, self.reader
        while True:
            number = lines.number + 1
            try:
                fields, whole = next(reader), True
            except StopIteration:
                return
            except csv.Error:
                fields, whole = [], False
            taken = lines.take()
            if not whole or (len(taken) > 1 and len(fields) != width):
                lines.give_back(taken[1:])
                taken = taken[:1]
                fields = self._text(taken).split(self.delimiter)
                # with its quotes doubled the row is one row for whoever reads the answer
                yield number, self.delimiter.join(map(self.quoted, fields)), fields
            elif fields:
                yield number, self._text(taken), fields

    def _batch(self, records: Iterator[tuple[int, str, list[str]]]) -> tuple[list[int], list[str], list[list[str]]]:
        """Line numbers, texts and fields of the next rows: all at once where no cell is in quotes, else one by one."""
        lines = self.lines
        if not lines.back:
            first = lines.number + 1
            taken = list(itertools.islice(lines.file, ROWS_AT_ONCE))
            lines.number += len(taken)
            if '"' not in "".join(taken):
                # without quotes a line is a row
                rows = [line.rstrip("\r\n").split(self.delimiter) for line in taken]
                texts = [line.rstrip("\r\n") for line in taken]
                numbers = list(range(first, first + len(taken)))
                if "" in texts:
                    full = [i for i, text in enumerate(texts) if text]
                    return [numbers[i] for i in full], [texts[i] for i in full], [rows[i] for i in full]
                return numbers, texts, rows
            lines.give_back(taken)
        batch = list(itertools.islice(records, ROWS_AT_ONCE))
        return [row[0] for row in batch], [row[1] for row in batch], [row[2] for row in batch]

    def pieces(self, plan: Plan) -> Iterator[Piece]:
        """The rows, some at a time."""
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
            if first and self.delimiter != ",":
                self.decimal = self._decimal_sign(plan, rows)
            first = False
            columns = {
                name: self._numbers([row[source.index] for row in rows], source.header, notes)
                for name, source in plan.sources.items()
            }
            yield Piece(columns, notes, _namer(numbers), texts)

    def _over(self) -> bool:
        line = next(self.lines, None)
        self.lines.take()
        if line is not None:
            self.lines.give_back([line])
        return line is None

    def _repaired(self, i: int, row: list[str], text: str, notes: dict[int, str]) -> str:
        """A row with too few or too many fields, made as wide as the table; what is too much goes into the note."""
        width = len(self.headers)
        notes[i] = f"expected {width} fields, got {len(row)}"
        if len(row) < width:
            text += self.delimiter * (width - len(row))
            row += [""] * (width - len(row))
            return text
        notes[i] += f", of which left out: {self.delimiter.join(row[width:])}"
        del row[width:]
        return self.delimiter.join(map(self.quoted, row))

    def _decimal_sign(self, plan: Plan, rows: list[list[str]]) -> str:
        """A comma where the numbers that are read have commas and no points."""
        cells = [row[source.index] for source in plan.sources.values() for row in rows[:1000]]
        return "," if any("," in cell for cell in cells) and not any("." in cell for cell in cells) else "."

    def _numbers(self, cells: list[str], header: str, notes: dict[int, str]) -> Array:
        if self.decimal == ",":
            cells = [cell.replace(",", ".") for cell in cells]
        try:
            return np.fromiter(map(float, cells), float, len(cells))
        except ValueError:
            pass
        values = np.full(len(cells), math.nan)
        for i, cell in enumerate(cells):
            try:
                values[i] = float(cell)
            except ValueError:
                got = repr(cell) if cell.strip() else "an empty cell"
                fault = f"{header}: expected a number, got {got}"
                notes[i] = f"{notes[i]}; {fault}" if i in notes else fault
        return values

    def quoted(self, cell: str) -> str:
        """A cell in quotes, where it needs them."""
        if not any(sign in cell for sign in (self.delimiter, '"', "\r", "\n")):
            return cell
        return '"' + cell.replace('"', '""') + '"'

    def write_head(self, file: BinaryIO, plan: Plan) -> None:
        """The header line, with the new headers."""
        cells = [self.head, *(self.quoted(added.header) for added in plan.added), plan.note]
        file.write((BOM if self.bom else b"") + self._bytes(self.delimiter.join(cells) + self.end))

    def write(self, file: BinaryIO, piece: Piece, added: list[Array]) -> None:
        """The rows of a piece with the answer; every number so that it reads back as itself."""
        notes = [""] * len(piece.rows)
        for i, note in piece.notes.items():
            notes[i] = self.quoted(note)
        columns = [self._cells(column) for column in added]
        lines = map(self.delimiter.join, zip(piece.rows, *columns, notes, strict=True))
        file.write(self._bytes(self.end.join(lines) + self.end))

    def finish(self) -> None:
        """Nothing more to write."""

    def give_up(self) -> None:
        """Nothing to tidy up."""

    def _cells(self, column: Array) -> list[str]:
        cells = list(map(repr, column.tolist()))
        if self.decimal == ",":
            cells = [cell.replace(".", ",") for cell in cells]
        for i in np.flatnonzero(np.isnan(column)).tolist():
            cells[i] = ""
        return cells

    @staticmethod
    def _bytes(text: str) -> bytes:
        return text.encode("utf-8", errors="surrogateescape")


def _namer(numbers: list[int]) -> Callable[[int], str]:
    return lambda i: f"line {numbers[i]}"
