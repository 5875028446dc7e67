"""Text tables of tracking programs: delimiter, decimal sign, rows of cells; and the calibration of a film."""

from __future__ import annotations

import contextlib
import csv
import io
import itertools
import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from datetime import UTC, datetime

import numpy as np
from numpy.typing import NDArray

from carom.data.remarks import not_used
from carom.data.table_cells import SIGNS, SPREADSHEET, decimal_commas, number_advice, parse_numbers, plain_number
from carom.errors import MAX_MAGNITUDE, CaromError, FaultList

__all__ = [
    "Calibration", "TextTable", "first_rows", "is_number", "numbers", "require_calibration", "require_sizes", "split_rows",
    "time_codes", "time_column",
]  # fmt: skip

Array = NDArray[np.float64]
DELIMITERS = "\t;,|"
DELIMITER_NAMES = {"\t": "tabs", ";": "semicolons", ",": "commas", "|": "bars"}
# h:mm:ss:cc, h:mm:ss.ccc, mm:ss:cc; the last number counts hundredths, thousandths or frames
TIME_CODE = re.compile(
    r"^(?:(?P<clock>\d+:(?:\d{2}:)?\d{2})[.,](?P<decimals>\d+)|(?P<whole>\d+:(?:\d{2}:)?\d{2})[:;](?P<last>\d{2,3}))$"
)
DATE = re.compile(r"^\d{4}-\d{2}-\d{2}[T ]\d{2}:")
FRAME_RATES = (24, 25, 30, 48, 50, 60, 100, 120, 240)
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
    decimal_comma: bool = False
    """Whether a lone comma is a decimal sign."""
    notes: list[str] = field(default_factory=list)
    faults: FaultList = field(default_factory=FaultList)
    used: set[int] = field(default_factory=set)
    """Columns that were read."""

    def __post_init__(self) -> None:
        """Say in all faults which file it is."""
        self.faults.where = self.name

    def column(self, i: int, first: int, label: str) -> Array:
        """Return column ``i`` from row ``first`` on as numbers (n,); missing ones are NaN, other texts are faults."""
        cells = self.cells(i, first)
        return numbers(cells, self.decimal_comma, lambda k: self.lines[first + k], label, self.faults)

    def cells(self, i: int, first: int) -> list[str]:
        """Return the cells of column ``i`` from row ``first`` on, without the blanks around them."""
        self.used.add(i)
        return [row[i].strip() if i < len(row) else "" for row in self.rows[first:]]

    def unused(self, header: Sequence[str], first: int) -> list[str]:
        """Return a note on the columns with a header and cells from row ``first`` on that were not read; none if there are none."""
        return not_used(
            cell
            for i, cell in enumerate(header)
            if i not in self.used and any(i < len(row) and row[i].strip() for row in self.rows[first:])
        )

    def between(self, low: int, high: int) -> TextTable:
        """Return some of the rows as a table of their own, without faults."""
        return replace(self, rows=self.rows[low:high], lines=self.lines[low:high], faults=FaultList())

    def raise_faults(self) -> None:
        """Raise CaromError with all faults, if there are any."""
        self.faults.raise_if_any()


def split_rows(name: str, text: str, delimiter: str | None = None) -> TextTable:
    """Split a text into rows of cells, at tabs, semicolons, commas or bars, whichever occurs first in this list, else at spaces.

    Raises CaromError for a quote that is not closed, and for a cell that is too long for any table.
    """
    delimiter = delimiter or _delimiter(text)
    table = TextTable(name, [], [], delimiter)
    for number, row in _rows(name, text, delimiter):
        table.rows.append(row)
        table.lines.append(number)
    table.decimal_comma = delimiter != "," or decimal_commas([cell for row in table.rows[:1000] for cell in row])
    return table


def first_rows(text: str, count: int, delimiter: str | None = None) -> list[list[str]]:
    """Return the first rows of a text table, at most ``count``, from which its format is recognised; fewer if it is no table."""
    head = text[:HEAD_CHARACTERS]
    rows = _rows("", head, delimiter or _delimiter(head))
    found: list[list[str]] = []
    with contextlib.suppress(CaromError):
        found += (row for _number, row in itertools.islice(rows, count))
    return found


def is_number(cell: str) -> bool:
    """Return whether a cell is a number, as any language writes it."""
    return not parse_numbers([plain_number(cell, decimal_comma=True)], missing=()).bad


def _delimiter(text: str) -> str:
    if named := SPREADSHEET.match(text):
        return named[1]
    head = text[:HEAD_CHARACTERS].splitlines()[:20]
    delimiter = next((sign for sign in DELIMITERS if any(sign in line for line in head)), " ")
    return " " if delimiter == "," and _spaced(head) else delimiter  # decimal commas between spaces


def _rows(name: str, text: str, delimiter: str) -> Iterator[tuple[int, list[str]]]:
    """Iterate over the rows that are not empty, with the numbers of their lines; a lone carriage return ends a line too."""
    lines: Iterator[str] = io.StringIO(text, newline=None)
    skipped = 0
    if SPREADSHEET.match(text):
        next(lines)
        skipped = 1
    if delimiter == " ":
        yield from ((n, row) for n, row in enumerate((line.split() for line in lines), 1 + skipped) if row)
        return
    if delimiter != "\t":  # (a quote that blanks precede or follow is one all the same)
        after = re.compile(rf'"[ \t]+(?={re.escape(delimiter)})')
        lines = (after.sub('"', line) if '"' in line else line for line in lines)
    # strict: text after a closing quote is the sign of a quote that was never closed
    reader = csv.reader(lines, delimiter=delimiter, strict=True, skipinitialspace=delimiter != "\t")
    try:
        yield from ((reader.line_num + skipped, row) for row in reader if any(cell.strip() for cell in row))
    except csv.Error as error:
        raise CaromError(
            f"{name}: line {reader.line_num + skipped}: expected cells between {DELIMITER_NAMES.get(delimiter, delimiter)},"
            f" got: {error}; is a quote missing?"
        ) from None


def _spaced(head: Sequence[str]) -> bool:
    """Return whether rows look like "0,0083 12,9 40,1"."""
    rows = [line.split() for line in head if re.match(r"^\s*[-+\u2212\d]", line)]
    return bool(rows) and all(len(row) > 1 and all(map(_number_alone, row)) for row in rows)


def _number_alone(word: str) -> bool:
    """Return whether a word is one number, with a decimal comma perhaps: no list of numbers, and no comma at its end."""
    return word[-1:].isdigit() and word.count(",") <= 1 and word[:1] != "," and is_number(word)


def time_column(table: TextTable, i: int, first: int, label: str, notes: list[str]) -> Array:
    """Return a column of times as numbers (n,), time codes such as ``0:00:01:25`` in seconds; add a note on these."""
    coded = time_codes(table.cells(i, first), notes)
    return table.column(i, first, label) if coded is None else coded


def time_codes(cells: Sequence[str], notes: list[str]) -> Array | None:
    """Return time codes (n,), s, NaN where a cell is empty; None if the cells are no time codes. Add a note on the last field.

    It counts frames where it runs through all numbers up to a usual frame rate; else hundredths, or thousandths with three digits.

    Examples
    --------
    >>> time_codes(["0:00:01:25", "0:00:01:26"], []), time_codes(["00:01:02.5"], []), time_codes(["1.5"], [])
    (array([1.25, 1.26]), array([62.5]), None)
    """
    if dates := _dates(cells):
        return np.array(dates)
    found = [TIME_CODE.match(cell.translate(SIGNS).strip()) for cell in cells]
    if not any(found) or any(one is None and cell.strip() for one, cell in zip(found, cells, strict=True)):
        return None
    last = np.array([float(one["last"]) if one and one["last"] else np.nan for one in found])
    share, of = _last_field(last, [one["last"] for one in found if one and one["last"]])
    if of:
        notes.append(
            f"times are codes such as {next(cell.strip() for cell in cells if cell.strip())}: their last number is taken as {of}"
        )
    values = []
    for one, part in zip(found, last, strict=True):
        if one is None:
            values.append(np.nan)
            continue
        whole = [float(x) for x in (one["clock"] or one["whole"]).split(":")]
        seconds = sum(x * 60**k for k, x in enumerate(reversed(whole))) + float(f"0.{one['decimals'] or 0}")
        values.append(seconds + (share * part if one["last"] else 0.0))
    return np.array(values)


def _dates(cells: Sequence[str]) -> list[float]:
    """Return dates with times of day (``2026-03-01T12:00:00.258``), s since 1970, NaN where a cell is empty; [] if one is none."""
    if not all(DATE.match(cell) for cell in cells if cell):
        return []
    try:
        dates = [datetime.fromisoformat(cell.replace(",", ".")) if cell else None for cell in cells]
    except ValueError:
        return []
    utc = [one if one is None or one.tzinfo else one.replace(tzinfo=UTC) for one in dates]
    return [np.nan if one is None else one.timestamp() for one in utc] if any(utc) else []


def _last_field(last: Array, texts: Sequence[str]) -> tuple[float, str]:
    """Return the length of one unit of the last numbers (n,) of time codes, s, and how it is called."""
    if not texts:
        return 0.0, ""
    most = int(np.nanmax(last)) + 1
    steps = np.diff(last)
    if most in FRAME_RATES and (steps < 0).sum() > 1 and np.nanmedian(steps) == 1:
        return 1 / most, f"frames, {most} per second"
    digits = max(map(len, texts))
    return (1e-3, "thousandths of a second") if digits == 3 else (1e-2, "hundredths of a second")


def numbers(
    cells: Sequence[str], decimal_comma: bool, line: Callable[[int], int], label: str, faults: FaultList
) -> Array:
    """Return cells as numbers (n,), NaN where one is missing; add a fault for cells that are not numbers, or far too large.

    ``line``: from the index of a cell to the number of its line in the file.
    """
    values, bad = parse_numbers(cells, decimal_comma=decimal_comma)
    if bad:
        got = f"{cells[bad[0]].strip()[:40]!r}{_at_line(bad, line)}"
        faults.add(label, "a number", got, number_advice(cells[bad[0]]))
    require_sizes(values, label, faults, lambda where: _at_line(where, line))
    return values


def _at_line(bad: Sequence[int], line: Callable[[int], int]) -> str:
    return f" at line {line(bad[0])}" + (f" ({len(bad)} in all)" if len(bad) > 1 else "")


def require_sizes(
    values: Array, label: str, faults: FaultList, where: Callable[[Sequence[int]], str] = lambda _bad: ""
) -> None:
    """Add a fault for numbers (n,) that are infinite, or so large that their squares may be."""
    far = np.flatnonzero(np.abs(values) > MAX_MAGNITUDE).tolist()
    if far:
        wanted, got = f"numbers of at most {MAX_MAGNITUDE:g} in size", f"{values[far[0]]:g}{where(far)}"
        faults.add(label, wanted, got, "leave the cell empty where there is none")


# Why a program's files need a scale and a frame rate, where they have pixels and frame numbers.
IN_PIXELS = {"scale": "since its positions are in pixels", "rate": "since it has frame numbers but no times"}


def require_calibration(
    name: str, program: str, calibration: Calibration, scale: str | None = None, rate: str | None = None
) -> None:
    """Raise CaromError for a missing scale or frame rate; ``scale`` and ``rate``: why they are needed, if they are."""
    faults = FaultList(name)
    if scale and calibration.scale is None:
        advice = "give `scale`, the length of one unit of the file (0.5mm)"
        faults.add(program, f"the scale, {scale}", advice=advice)
    if rate and calibration.rate is None:
        faults.add(program, f"the frame rate, {rate}", advice="give `rate`, frames per second")
    faults.raise_if_any()
