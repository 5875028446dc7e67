"""Text tables of tracking programs: delimiter, decimal sign, rows of cells; and the calibration of a film."""

from __future__ import annotations

import contextlib
import csv
import io
import itertools
import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from carom.data.cells import parse_numbers
from carom.errors import MAX_MAGNITUDE, CaromError

__all__ = ["Calibration", "TextTable", "first_rows", "numbers", "require_calibration", "require_sizes", "split_rows"]

Array = NDArray[np.float64]
DELIMITERS = "\t;,"
DELIMITER_NAMES = {"\t": "tabs", ";": "semicolons", ",": "commas"}
HEAD_CHARACTERS = 4000  # in which the format and the delimiter show


@dataclass(frozen=True)
class Calibration:
    """Calibration of a film, for files that lack it; None: not given.

    Examples
    --------
    >>> from carom.tracks import Calibration
    >>> Calibration(scale=5e-4, rate=120)
    Calibration(scale=0.0005, rate=120, down=None, likelihood=0.6)
    """

    scale: float | None = None
    """Length of one unit of the file (a pixel, say), m."""
    rate: float | None = None
    """Frame rate, 1/s."""
    down: bool | None = None
    """Whether the second axis of the file points down, as in images; None: the program's convention."""
    likelihood: float = 0.6
    """Positions with a lower likelihood (of a neural network) are omitted."""


@dataclass
class TextTable:
    """Rows of cells of a text table."""

    name: str
    rows: list[list[str]]
    lines: list[int]
    """Line number of each row."""
    delimiter: str
    notes: list[str] = field(default_factory=list)
    faults: list[str] = field(default_factory=list)

    def column(self, i: int, first: int, label: str) -> Array:
        """Return column ``i`` from row ``first`` on as numbers (n,); missing ones are NaN, other texts are faults."""
        cells = [row[i] if i < len(row) else "" for row in self.rows[first:]]
        return numbers(
            cells, self.delimiter != ",", lambda k: self.lines[first + k], f"{self.name}: {label}", self.faults
        )

    def between(self, low: int, high: int) -> TextTable:
        """Return some of the rows as a table of their own, without faults."""
        return TextTable(self.name, self.rows[low:high], self.lines[low:high], self.delimiter)

    def raise_faults(self) -> None:
        """Raise CaromError with all faults, if there are any."""
        if self.faults:
            raise CaromError(*self.faults)


def split_rows(name: str, text: str, delimiter: str | None = None) -> TextTable:
    """Split a text into rows of cells, at tabs, semicolons or commas, whichever occurs first in this list, else at spaces.

    Raises CaromError for a quote that is not closed, and for a cell that is too long for any table.
    """
    delimiter = delimiter or _delimiter(text)
    table = TextTable(name, [], [], delimiter)
    for number, row in _rows(name, text, delimiter):
        table.rows.append(row)
        table.lines.append(number)
    return table


def first_rows(text: str, count: int, delimiter: str | None = None) -> list[list[str]]:
    """Return the first rows of a text table, at most ``count``, from which its format is recognised; fewer if it is no table."""
    head = text[:HEAD_CHARACTERS]
    rows = _rows("", head, delimiter or _delimiter(head))
    found: list[list[str]] = []
    with contextlib.suppress(CaromError):
        found += (row for _number, row in itertools.islice(rows, count))
    return found


def _delimiter(text: str) -> str:
    head = text[:HEAD_CHARACTERS].splitlines()[:20]
    delimiter = next((sign for sign in DELIMITERS if any(sign in line for line in head)), " ")
    return " " if delimiter == "," and _spaced(head) else delimiter  # decimal commas between spaces


def _rows(name: str, text: str, delimiter: str) -> Iterator[tuple[int, list[str]]]:
    """Iterate over the rows that are not empty, with the numbers of their lines; a lone carriage return ends a line too."""
    lines = io.StringIO(text, newline=None)
    if delimiter == " ":
        yield from ((n, row) for n, row in enumerate((line.split() for line in lines), 1) if row)
        return
    # strict: text after a closing quote is the sign of a quote that was never closed
    reader = csv.reader(lines, delimiter=delimiter, strict=True)
    try:
        yield from ((reader.line_num, row) for row in reader if any(cell.strip() for cell in row))
    except csv.Error as error:
        raise CaromError(
            f"{name}: line {reader.line_num}: expected cells between {DELIMITER_NAMES.get(delimiter, delimiter)}, got: {error};"
            " is a quote missing?"
        ) from None


def _spaced(head: Sequence[str]) -> bool:
    """Return whether rows look like "0,0083 12,9 40,1"."""
    rows = [line for line in head if re.match(r"^\s*[-+\d]", line)]
    return bool(rows) and all(re.fullmatch(r"\s*[-+\d,.eE]+(\s+[-+\d,.eE]+)+\s*", line) for line in rows)


def numbers(
    cells: Sequence[str], decimal_comma: bool, line: Callable[[int], int], label: str, faults: list[str]
) -> Array:
    """Return cells as numbers (n,), NaN where one is missing; add a fault for cells that are not numbers, or far too large.

    ``line``: from the index of a cell to the number of its line in the file.
    """
    values, bad = parse_numbers(cells, decimal_comma=decimal_comma)
    if bad:
        faults.append(
            f"{label}: expected a number, got {cells[bad[0]].strip()[:40]!r}{_at_line(bad, line)}; write units in the header"
        )
    require_sizes(values, label, faults, lambda where: _at_line(where, line))
    return values


def _at_line(bad: Sequence[int], line: Callable[[int], int]) -> str:
    return f" at line {line(bad[0])}" + (f" ({len(bad)} in all)" if len(bad) > 1 else "")


def require_sizes(
    values: Array, label: str, faults: list[str], where: Callable[[Sequence[int]], str] = lambda _bad: ""
) -> None:
    """Add a fault for numbers (n,) that are infinite, or so large that their squares may be."""
    far = np.flatnonzero(np.abs(values) > MAX_MAGNITUDE).tolist()
    if far:
        faults.append(
            f"{label}: expected numbers of at most {MAX_MAGNITUDE:g} in size, got {values[far[0]]:g}{where(far)};"
            " leave the cell empty where there is none"
        )


def require_calibration(
    name: str, program: str, calibration: Calibration, scale: str | None = None, rate: str | None = None
) -> None:
    """Raise CaromError for a missing scale or frame rate; ``scale`` and ``rate``: why they are needed, if they are."""
    faults = []
    if scale and calibration.scale is None:
        faults.append(
            f"{name}: {program}: expected the scale, {scale}; give --scale, the length of one unit of the file (0.5mm)"
        )
    if rate and calibration.rate is None:
        faults.append(f"{name}: {program}: expected the frame rate, {rate}; give --rate, frames per second")
    if faults:
        raise CaromError(*faults)
