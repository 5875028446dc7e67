"""Text tables of tracking programs: delimiter, decimal sign, rows of cells; and the calibration of a film."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from carom.data.cells import parse_numbers
from carom.errors import CaromError

__all__ = ["Calibration", "TextTable", "numbers", "require_calibration", "split_rows"]

Array = NDArray[np.float64]
DELIMITERS = "\t;,"


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
    """Whether the second axis of the file points down, as in images; None: as is usual for the program."""
    likelihood: float = 0.6
    """Positions with a lower likelihood (of a neural network) are left out."""


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

    def raise_faults(self) -> None:
        """Raise CaromError with all faults, if there are any."""
        if self.faults:
            raise CaromError(*self.faults)


def split_rows(name: str, text: str, delimiter: str | None = None) -> TextTable:
    """Split a text into rows of cells, at tabs, semicolons or commas, whichever occurs first in this list, else at spaces."""
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
    return TextTable(name, [row for _n, row in kept], [n for n, _row in kept], delimiter)


def _spaced(head: Sequence[str]) -> bool:
    """Return whether rows look like "0,0083 12,9 40,1"."""
    rows = [line for line in head if re.match(r"^\s*[-+\d]", line)]
    return bool(rows) and all(re.fullmatch(r"\s*[-+\d,.eE]+(\s+[-+\d,.eE]+)+\s*", line) for line in rows)


def numbers(
    cells: Sequence[str], decimal_comma: bool, line: Callable[[int], int], label: str, faults: list[str]
) -> Array:
    """Return cells as numbers (n,), NaN where one is missing; add a fault for those that are none.

    ``line``: from the index of a cell to the number of its line in the file.
    """
    values, bad = parse_numbers(cells, decimal_comma=decimal_comma)
    if bad:
        more = f" ({len(bad)} in all)" if len(bad) > 1 else ""
        faults.append(
            f"{label}: expected a number, got {cells[bad[0]].strip()!r} at line {line(bad[0])}{more}; write units in the header"
        )
    return values


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
