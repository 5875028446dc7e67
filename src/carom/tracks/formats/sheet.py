"""Text of a table: encoding, delimiter, decimal sign, cells to numbers; what the user says beside the file."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from carom.errors import CaromError

__all__ = ["Given", "Sheet", "ask", "decoded", "numbers", "sheet"]

Array = NDArray[np.float64]
DELIMITERS = "\t;,"


@dataclass(frozen=True)
class Given:
    """What a file may lack; None: not said."""

    scale: float | None = None
    """m to one unit of the file's lengths: to a pixel, say."""
    rate: float | None = None
    """Frames a second."""
    down: bool | None = None
    """Whether the file's second axis points down, as in pictures; None: as the program has it."""
    likelihood: float = 0.6
    """Places that a network gives less than this are not taken."""


@dataclass
class Sheet:
    """Rows of cells, as they stand."""

    name: str
    rows: list[list[str]]
    lines: list[int]
    """Line number of each row."""
    delimiter: str
    notes: list[str] = field(default_factory=list)
    faults: list[str] = field(default_factory=list)

    def column(self, i: int, first: int, label: str) -> Array:
        """Cells (n,) from row ``first`` on as numbers; empty ones are NaN, others that are none are faults."""
        cells = [row[i] if i < len(row) else "" for row in self.rows[first:]]
        return numbers(
            cells, self.delimiter != ",", lambda k: self.lines[first + k], f"{self.name}: {label}", self.faults
        )

    def done(self) -> None:
        """CaromError with all faults, if there are any."""
        if self.faults:
            raise CaromError(*self.faults)


def decoded(path: Path) -> str:
    """A file's text: UTF-8 or UTF-16 with or without a byte-order mark, else Latin-1 (a degree sign of an old program)."""
    try:
        raw = path.read_bytes()
    except OSError as error:
        raise CaromError(f"{path}: expected a file that can be read, got: {error.strerror}") from None
    if raw.startswith((b"\xff\xfe", b"\xfe\xff")):
        return raw.decode("utf-16").lstrip("\ufeff")
    try:
        text = raw.decode("utf-8-sig")
    except UnicodeDecodeError:
        text = raw.decode("latin-1")
    if "\0" in text[:1000]:
        raise CaromError(f"{path}: expected a text file, got a binary one; export the track as CSV")
    return text


def sheet(name: str, text: str, delimiter: str | None = None) -> Sheet:
    """Rows of a table. Tabs before semicolons before commas, where they are; else runs of spaces."""
    head = text[:4000].splitlines()[:20]
    if delimiter is None:
        delimiter = next((sign for sign in DELIMITERS if any(sign in line for line in head)), " ")
        if delimiter == "," and _spaced(head):  # decimal commas between spaces
            delimiter = " "
    if delimiter == " ":
        split = [(n, line.split()) for n, line in enumerate(text.splitlines(), 1)]
        kept = [(n, row) for n, row in split if row]
    else:
        reader = csv.reader(io.StringIO(text), delimiter=delimiter)
        kept = [(reader.line_num, row) for row in reader if any(cell.strip() for cell in row)]
    return Sheet(name, [row for _n, row in kept], [n for n, _row in kept], delimiter)


def _spaced(head: Sequence[str]) -> bool:
    """Whether rows look like "0,0083 12,9 40,1"."""
    rows = [line for line in head if re.match(r"^\s*[-+\d]", line)]
    return bool(rows) and all(re.fullmatch(r"\s*[-+\d,.eE]+(\s+[-+\d,.eE]+)+\s*", line) for line in rows)


def numbers(cells: Sequence[str], comma: bool, line: object, label: str, faults: list[str]) -> Array:
    """Cells as numbers. ``comma``: a comma may be the decimal sign; ``line``: from a cell's number to its line's."""
    if comma and any("," in cell for cell in cells[:1000]):
        cells = [cell.replace(",", ".") for cell in cells]
    try:
        return np.fromiter(map(float, cells), float, len(cells))
    except ValueError:
        pass
    values = np.full(len(cells), np.nan)
    bad = []
    for k, cell in enumerate(cells):
        try:
            values[k] = float(cell)
        except ValueError:
            if cell.strip().lower() not in ("", "nan", "na", "null", "-", "none"):
                bad.append(k)
    if bad:
        at = line(bad[0]) if callable(line) else bad[0] + 1
        more = f" ({len(bad)} in all)" if len(bad) > 1 else ""
        faults.append(
            f"{label}: expected a number, got {cells[bad[0]].strip()!r} at line {at}{more}; units belong in the header"
        )
    return values


def ask(name: str, program: str, given: Given, scale: str | None = None, rate: str | None = None) -> None:
    """CaromError that names what is missing; ``scale`` and ``rate`` say why it is needed."""
    faults = []
    if scale and given.scale is None:
        faults.append(
            f"{name}: {program}: expected the scale, {scale}; give --scale, m to one unit of the file (0.5mm)"
        )
    if rate and given.rate is None:
        faults.append(f"{name}: {program}: expected the frame rate, {rate}; give --rate, frames a second")
    if faults:
        raise CaromError(*faults)
