"""Text tables of tracking programs: delimiter, decimal sign, rows of cells; and the calibration of a film."""

from __future__ import annotations

import contextlib
import csv
import io
import itertools
import re
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from datetime import UTC, datetime
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.data.headers import ColumnNames, Heading, missing_unit
from carom.data.rebounds import not_used
from carom.data.table_cells import SIGNS, SPREADSHEET, decimal_commas, number_advice, parse_numbers, plain_number
from carom.errors import MAX_MAGNITUDE, CaromError, Fault, FaultList, suggestion
from carom.tracks.formats.missing import without_invisible, without_markers
from carom.tracks.preprocess import camera_clock
from carom.tracks.track import Track

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
    view: str | None = field(default=None, repr=False)
    """From where it was filmed: of a single coordinate, ``"above"`` says that it is no height."""
    film: Mapping[str, Any] = field(default_factory=dict, repr=False)
    """Of films that carom reads itself: further arguments of :func:`carom.track_film`."""


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


# ----------------------------------------------------------------------------------------------------
# Headers of plain tables of positions: where they are, which column holds which quantity of which ball, and rows of units.


# Used only in a table without a column x or y: a table with them may have a height, or a distance, besides.
X_WORDS = ("horizontal", "distance", "weite", "strecke", "abscisse", "abszisse")
Y_WORDS = (
    "vertical", "height", "höhe", "hoehe", "hauteur", "altura", "altezza", "ordonnée", "ordinate", "altitude", "elevation",
    "position", "h",
)  # fmt: skip
NAMED = ColumnNames({
    "time": ("time", ("t", "seconds", "sec", "secs", "second", "elapsed", "elapsed_time", "zeit", "temps", "tiempo", "tempo",
                      "tijd", "tid", "czas", "timestamp", "time_stamp")),
    "time_step": ("time", ("dt", "δt", "delta_t", "timestep", "delta_time", "frame_interval")),
    "x": ("length", ("x_long", "pos_x", "position_x", "x_pos", "x_position", "x_coordinate", "x_coord", "x-coordinate", *X_WORDS)),
    "y": ("length", ("y_short", "pos_y", "position_y", "y_pos", "y_position", "y_coordinate", "y_coord", "y-coordinate", *Y_WORDS)),
    "z": ("length", ("pos_z", "position_z")),
    "angle": ("angle", ("theta", "orientation")),
    "spin": ("spin", ("omega", "spin_z")),
    "sigma_spin": ("spin", ("sigma_omega", "sigma_spin_z", "spin_error")),
    "sigma_time": ("time", ("sigma_t",)),
    "frame": ("number", ("frame_number", "frame_idx", "frame_index", "frame_id", "frame_no", "frame_num", "image", "slice")),
    "visible": ("number", ("visibility", "vis", "is_visible", "detected", "in_view")),
    "likelihood": ("number", ("confidence",)),
})  # fmt: skip
# Names of a column of frame numbers begin or end so, in the languages of programs; the numbers themselves tell it as well.
FRAME_WORD = re.compile(
    r"(frame|image|img|bild|slice|photo|foto|trame|vue|cuadro|quadro|kader|ruta|kader|klatka|index|idx|step|count|num|nummer|"
    r"n[°ºo]|no\.?|nr\.?|#)", re.IGNORECASE,
)  # fmt: skip
NUMBER_OF = re.compile(r"_?(?:n[°ºo]|no\.|nr\.?|#|number|num)$")  # "Track n°"
MILLISECONDS = ("ms", "msec", "millis", "milliseconds")
GROUPS, NAMES = (
    ("shot", "group", "game", "run", "trial", "film", "versuch", "wurf", "essai"),
    ("ball", "track", "particle", "name", "id", "object", "track_id", "trackid", "ball_id", "object_id", "particle_id"),
)
PIXELS = re.compile(r"^(x|y)\s*(?:[\[(_ /,]|in\s)?\s*(px|pix|pixels?)\s*[\])]?$", re.IGNORECASE)
PIXEL_UNIT = re.compile(r"^[\[(]?\s*(px|pix|pixels?)\s*[\])]?$", re.IGNORECASE)
COMMENT = re.compile(r"^\s*(#|%|//)+\s*")
RUN = re.compile(r"^\s*([^:()\[\]]{1,60}?)\s*:\s*(\S.*)$")  # "Latest: X (m)"
RUN_BEHIND = re.compile(r"^\s*(\S.*?)[\s,]+((?:run|set)\s*#?\s*\d+)\s*$", re.IGNORECASE)  # "X (m) Run #1"
NUMBERED = re.compile(r"^\s*([a-z](?:[a-z ]*[a-z])?)[ _.]?(\d{1,3})\s*([\[(].*[\])])?\s*$", re.IGNORECASE)  # "x1 [mm]"
SEPARATORS = re.compile(r"[ _./-]+")
CLOCKS = {"time", "frame", "time_step"}
# of a ball's motion, or of its picture, but no place
NO_PLACE = re.compile(
    r"^(v|vel|velocity|speed|a|acc|accel|acceleration|force|f|d|delta|std|sigma|err|error|size|width|w|p|momentum|flow|grad)$"
)
# So many numbers at least, and none in more rows (of several shots): the column numbers the rows. No ball is measured in so few.
MIN_NUMBERED, MOST_ROWS = 9, 3
ROW_NUMBERS = "column {!r} numbers the rows: not taken for names of shots or balls"
LONGEST_NAME = 200  # characters of a header
MOST_ABOVE, MOST_BELOW = 30, 3  # rows above a header that are no table yet, and rows of names and units below it


@dataclass
class Series:
    """The columns of one ball: quantity -> column and heading (None: pixels)."""

    run: str
    """The run of an experiment, if the header names one; empty: none."""
    name: str
    columns: dict[str, tuple[int, Heading | None]] = field(default_factory=dict)
    pixels: dict[str, tuple[int, Heading | None]] = field(default_factory=dict)
    """Its places in pixels, where it has others besides."""

    def put(self, quantity: str, i: int, heading: Heading | None) -> None:
        """Take a column, unless there is one of this quantity."""
        (self.pixels if heading is None else self.columns).setdefault(quantity, (i, heading))


@dataclass
class Header:
    """The header of a table: its row, with the units of rows below it, and the row from which on there are numbers."""

    cells: list[str]
    above: int
    first: int

    def name(self, i: int) -> str:
        """Return the name of a column; its number, where it has none."""
        return self.cells[i].strip() or f"column {i + 1}"


def header_of(rows: Sequence[Sequence[str]]) -> Header | None:
    """Return the first row with columns x and y among the first rows; None if there is none."""
    for at, row in enumerate(rows[:MOST_ABOVE]):
        cells = [COMMENT.sub("", row[0]) if row else "", *row[1:]]
        if row and not cells[0].strip() and COMMENT.match(row[0]) and len(rows[min(at + 1, len(rows) - 1)]) < len(row):
            cells = cells[1:]  # "# t x y" between spaces
        found = series_of(cells)[0]
        if not found:
            continue
        used = sorted({i for one in found for i, _heading in one.columns.values()})
        first = at + 1
        while first < min(len(rows), at + 1 + MOST_BELOW) and _names_or_units(rows[first], used):
            cells = _with_units(cells, rows[first], used)
            first += 1
        return Header(list(cells), at, first)
    return None


def numbers_rows(cells: Sequence[str], groups: Sequence[str] | None = None) -> bool:
    """Return whether a column (n,) numbers the rows, as a table of some length shows: it names no balls, nor shots.

    ``groups``: the shot of each row, in each of which the numbers may begin anew.
    """
    rows = Counter(zip(cells, groups or cells, strict=True))
    most = max(rows.values(), default=0)
    return len(rows) >= MIN_NUMBERED and most <= min(MOST_ROWS, len(rows) / 4) and all(map(is_number, cells))


def _names_or_units(row: Sequence[str], used: Sequence[int]) -> bool:
    """Return whether a row below the header has words in all columns of the table that are used, no numbers and no gaps."""
    cells = [row[i].strip() if i < len(row) else "" for i in used]
    words = [cell for cell in cells if cell]
    return bool(words) and not any(is_number(cell) or ":" in cell for cell in words) and 2 * len(words) > len(cells)


def _with_units(cells: Sequence[str], row: Sequence[str], used: Sequence[int]) -> list[str]:
    """Return the header with the units of a row below it, in brackets; as it is for a row of short names."""
    found = list(cells)
    for i in used:
        unit = row[i].strip().strip("()[]").strip() if i < len(row) else ""
        heading = NAMED.parse(f"{cells[i].strip()} [{unit}]") if unit else None
        if PIXEL_UNIT.match(unit) or (heading is not None and heading.unit is not None):
            found[i] = f"{cells[i].strip()} [{unit}]"
    return found


def series_of(header: Sequence[str]) -> tuple[list[Series], dict[str, list[int]], list[Fault]]:
    """Return the balls whose x and y are side by side, columns of names by kind, and faults of headers with unknown units.

    Balls are told apart by the run (``Run 2: X``), a number (``x2``), a name (``red x``), or by headers that repeat.
    """
    found: dict[tuple[str, str], Series] = {}
    spare: dict[tuple[str, str], Series] = {}
    named: dict[str, Series] = {}
    who: dict[str, list[int]] = {"group": [], "name": []}
    seen: dict[str, int] = {}
    for i, cell in enumerate(header):
        text = re.sub(r"(?<=[a-zA-Z)\]])\.(\d+)$", "", cell.strip())  # (as pandas numbers headers that repeat)
        seen[text] = seen.get(text, 0) + 1
        key = NUMBER_OF.sub("", re.sub(r"\s+", "_", text.lower())) or text.lower()
        if key in GROUPS or key in NAMES:
            who["group" if key in GROUPS else "name"].append(i)
            continue
        run, name, quantity, heading = _meaning(text)
        if not quantity:
            name, quantity, heading = _behind(text)
            if quantity:
                named.setdefault(name, Series("", name)).put(quantity, i, heading)
            continue
        if seen[text] > 1:
            name = f"{name}#{seen[text]}"
        other = spare if heading is not None and heading.alias in (*X_WORDS, *Y_WORDS) else found
        other.setdefault((run, name), Series(run, name)).put(quantity, i, heading)
    for which, one in spare.items():
        mine = found.setdefault(which, one)
        mine.columns = one.columns | mine.pixels | mine.columns
    clocks = [*found.values()]
    balls = _in_planes(clocks) or _in_planes([*named.values()]) or _heights([*clocks, *named.values()], clocks)
    if not balls:  # what there is, for a message
        return [], who, _unknown(header, clocks)
    return _completed(balls, clocks), who, _unknown(header, balls)


def _in_planes(series: list[Series]) -> list[Series]:
    """Return the balls with two or three coordinates, called x and y, and z where there are three."""
    balls = []
    for one in series:
        one.columns = one.pixels | one.columns
        axes = [axis for axis in "xyz" if axis in one.columns]
        if len(axes) > 1:
            one.columns = {k: v for k, v in one.columns.items() if k not in axes} | {
                new: one.columns[old] for new, old in zip("xyz", axes, strict=False)
            }
            balls.append(one)
    return balls


def _heights(series: list[Series], clocks: list[Series]) -> list[Series]:
    """Return the balls of which one coordinate is known against time, the height, called y: one of each run."""
    balls = [one for one in series if {"x", "y", "z"} & set(one.columns)]
    if len({one.run for one in balls}) < len(balls) or not any(CLOCKS & set(one.columns) for one in clocks):
        return []
    for one in balls:
        one.columns, one.pixels = (
            {"y" if k in "xyz" else k: column for k, column in some.items()} for some in (one.columns, one.pixels)
        )
    return balls


def _meaning(text: str) -> tuple[str, str, str, Heading | None]:
    """Return run, number, quantity and heading of a cell of a header; an empty quantity if it is none that is known."""
    text = "t [ms]" if text.lower() in MILLISECONDS else text[:LONGEST_NAME]
    if pixels := PIXELS.match(text):
        return "", "", pixels[1].lower(), None
    if (
        (heading := NAMED.parse(text))
        and heading.quantity == "time"
        and heading.unit is None
        and FRAME_WORD.search(text)
    ):
        heading = NAMED.parse("frame")  # "time [frames]"
    if heading:
        return "", "", heading.quantity, heading
    if (run := RUN.match(text)) and (inner := _meaning(run[2]))[2]:
        return run[1], *inner[1:]
    if (behind := RUN_BEHIND.match(text)) and (inner := _meaning(behind[1]))[2]:
        return behind[2], *inner[1:]
    if (number := NUMBERED.match(text)) and (inner := _meaning(number[1] + (number[3] or "")))[2] in ("x", "y", "time"):
        return "", number[2], *inner[2:]
    return "", "", "", None


def _behind(text: str) -> tuple[str, str, Heading | None]:
    """Return ball, axis and heading of a cell such as "white ball x (cm)", "ball_x_m" or "pixel_x"; empty if it is none."""
    for sign in SEPARATORS.finditer(text[:LONGEST_NAME]):
        name, (run, number, axis, heading) = text[: sign.start()], _meaning(text[sign.end() :])
        if (
            not name
            or run
            or number
            or axis not in ("x", "y", "z")
            or (heading and heading.alias in (*X_WORDS, *Y_WORDS))
        ):
            continue
        if PIXEL_UNIT.match(name):
            return "ball", axis, None
        if sign[0] == "." or not NO_PLACE.match(SEPARATORS.split(name.lower())[-1]):
            return name, axis, heading
    return "", "", None


def _completed(balls: list[Series], clocks: list[Series]) -> list[Series]:
    """Return the balls with the clock of their run, where they have none of their own; and with names."""
    for one in balls:
        if not CLOCKS & set(one.columns):
            for quantity in CLOCKS:
                shared = [other.columns[quantity] for other in clocks
                          if quantity in other.columns and other.run in (one.run, "")]  # fmt: skip
                if shared:
                    one.columns[quantity] = shared[0]
        if one.name.startswith("#") or not one.name:
            one.name = "ball" if len(balls) == 1 or one.run else f"ball {balls.index(one) + 1}"
    return balls


def _unknown(header: Sequence[str], balls: Sequence[Series]) -> list[Fault]:
    columns = dict.fromkeys(column for one in balls for column in one.columns.values())
    return [
        missing_unit("", header[i].strip(), meaning)
        for i, meaning in columns
        if meaning is not None and meaning.unit is None
    ]


# ----------------------------------------------------------------------------------------------------
# Plain tables with named columns and units: t, x, y, and identifiers (shot, ball); one row per frame and ball.


PROGRAM = "columns"
HEADER_EXAMPLE = "t [s],x [cm],y [cm]"
Labels = dict[str, list[str]]
AS_FRAMES = "column {!r} taken as the numbers of the frames: whole numbers that rise from row to row"
MIN_LEAST_STEPS = 0.1  # share of the rows that are the next frame
MOSTLY = 0.8  # share of the steps of a clock that have one sign
MIN_FILLED = 0.9  # share of the cells of a clock that are filled, at least
PICTURE = re.compile(r"^(.*?)(\d+)\.(?:png|jpe?g|bmp|tiff?|gif)$", re.IGNORECASE)


def matches(text: str) -> bool:
    """Return whether one of the first rows has columns x and y."""
    return header_of(first_rows(text, MOST_ABOVE + 1)) is not None


def read(name: str, text: str, calibration: Calibration) -> list[Track]:
    """Read tracks by group and name, or side by side; with a z column they have three coordinates."""
    table = split_rows(name, text)
    if not table.rows:
        table.faults.add("", "a header and rows", "an empty file")
    table.raise_faults()
    header = header_of(table.rows) or Header(table.rows[0], 0, 1)
    _require_width(table, header)
    balls, who, unknown = series_of(header.cells)
    table.faults += [fault.within(name) for fault in unknown]
    if not balls:
        _require_axes(table, header.cells)
        table.raise_faults()
    notes: list[str] = []
    if header.above:
        notes.append(f"{header.above} line{'s' if header.above > 1 else ''} above the header skipped")
    labels = _labels(table, header, who, notes)
    if calibration.scale is not None:  # (of places in pixels and in metres beside them)
        for one in balls:
            one.columns |= one.pixels
    table.used |= {i for one in balls for i, _meaning in one.columns.values()}
    for one in balls:
        i, _meaning = one.columns.get("time_step", (-1, None))
        number = None if i < 0 else _rising(table, header, i, labels)
        if number is not None and (number == np.round(number)).all():  # (steps of a program, not lengths of time)
            one.columns["frame"] = i, NAMED.parse("frame")
            del one.columns["time_step"]
            notes.append(AS_FRAMES.format(header.name(i)))
    without = [one for one in balls if not CLOCKS & set(one.columns)]
    if without and (clock := _column_of_frames(table, header, labels)) is not None:
        notes.append(AS_FRAMES.format(header.name(clock)))
        for one in without:
            one.columns["frame"] = clock, NAMED.parse("frame")
    for one in balls:
        _require_clock(table, header, one, len(set(zip(*labels.values(), strict=True))) > 1, calibration)
    table.raise_faults()
    columns = [column for one in balls for column in one.columns.items()]
    pixels = any(meaning is None for _quantity, (_i, meaning) in columns)
    clocked = all({"time", "time_step"} & set(one.columns) for one in balls)
    require_calibration(
        name, PROGRAM, calibration, scale="since its positions are in pixels" if pixels else None,
        rate=None if clocked else "since it has frame numbers but no times",
    )  # fmt: skip
    notes += _notes(header.cells, [column for _quantity, column in columns], calibration)
    runs = len({one.run for one in balls})
    tracks = []
    for one in balls:
        whole = _track(table, header, one, len(balls) > 1, calibration, notes)
        group = one.run if runs > 1 else ""
        for track in _split(whole, labels):
            parts = [track.name, one.name if len(balls) > 1 or not track.name else ""]
            tracks.append(
                replace(track, name=" ".join(filter(None, parts)), group=" ".join(filter(None, (group, track.group))))
            )
    table.raise_faults()
    notes += table.unused(header.cells, header.first)
    return [replace(track, notes=tuple(notes)) for track in tracks]


def _require_width(table: TextTable, header: Header) -> None:
    """Raise CaromError where most rows have more cells than the header: commas within numbers and between them."""
    rows, width = table.rows[header.first :], len(header.cells)
    if np.median([len(row) for row in rows] or [0]) > width and any(any(row[width:]) for row in rows):
        advice = "write decimal points, or semicolons between numbers" if table.delimiter == "," else ""
        where, got = f"line {table.lines[header.first]}", f"{len(rows[0])}, and as many in most lines"
        table.faults.add(where, f"{width} cells, as the header has", got, advice)
        table.raise_faults()


def _require_axes(table: TextTable, header: Sequence[str]) -> None:
    """Add a fault for each of x and y that no column holds."""
    there = {heading.quantity for cell in header if (heading := NAMED.parse(cell))}
    for axis in "xy":
        if axis not in there:
            near = suggestion(axis, [cell.strip() for cell in header if cell.strip()])
            advice = f"{near}; a header that is understood: {HEADER_EXAMPLE!r}"
            table.faults.add("", f"a column {axis} (with its unit, as in '{axis} [mm]')", "none", advice)


def _require_clock(table: TextTable, header: Header, one: Series, named: bool, calibration: Calibration) -> None:
    """Add a fault if a ball has neither times nor frame numbers, unless its rows are counted at a rate that is given."""
    if CLOCKS & set(one.columns):
        return
    for i in range(len(header.cells)):
        # (a clock under a name that is not known: rows may be missing, and are not counted)
        if i not in table.used and _ticks(table, header, i):
            got = f"column {header.name(i)!r}, which rises from row to row as times do"
            advice = "name it t, with its unit, as in 't [ms]', or frame; if it is neither, leave it out"
            table.faults.add("", "a column t (as in 't [s]') or frame", got, advice)
            return
    if calibration.rate is None or named:
        columns = ", ".join(map(header.name, range(len(header.cells))))
        hint = "" if named else "`rate` 60 counts the rows as frames, which is right where none is missing"
        table.faults.add("", "a column t (as in 't [s]') or frame", f"columns {columns:.80}", hint)


def _column_of_frames(table: TextTable, header: Header, labels: Labels) -> int | None:
    """Return the column of whole numbers that rise from row to row with jumps, in each ball's rows: numbers of frames.

    A column that counts the rows says no more than these. Where every step is longer than 1, as of every fifth frame, or of
    milliseconds, its name has to say that it has frames.
    """
    found = []
    for i in set(range(len(header.cells))) - table.used:
        word = bool(FRAME_WORD.search(header.cells[i]))
        number = _rising(table, header, i, labels)
        if number is None and word and _counts(table, header, i):
            found.append((not word, i))  # (of several balls, or from the last to the first: refused as times would be)
        if number is None or not (number == np.round(number)).all():
            continue
        step = np.diff(number)
        least = step[step > 0].min()
        jumps = (step > 1).any() and (step % least == 0).all() and (step == least).mean() >= MIN_LEAST_STEPS
        if jumps and (least == 1 or word):
            found.append((not word, i))
    return min(found)[1] if found else None


def _rising(table: TextTable, header: Header, i: int, labels: Labels) -> Array | None:
    """Return a column as numbers that rise within each track's rows, one track after the other (m,); None if it is no such."""
    cells = [row[i].strip() if i < len(row) else "" for row in table.rows[header.first :]]
    values = frames_of_files(cells)
    if values is None:
        values, bad = parse_numbers(cells, decimal_comma=table.decimal_comma)
        if bad:
            return None
    keys = list(zip(*labels.values(), strict=True)) or [()] * len(cells)
    parts = []
    for key in dict.fromkeys(keys):
        own = values[[one == key for one in keys]]
        parts.append(own[np.isfinite(own)])
    steps = np.concatenate([np.empty(0), *map(np.diff, parts)])  # (a table may have no rows)
    if len(steps) < MIN_NUMBERED - 1 or sum(map(len, parts)) < MIN_FILLED * len(cells) or not (steps > 0).all():
        return None
    return np.cumsum(np.concatenate([[0.0], steps]))


def _counts(table: TextTable, header: Header, i: int) -> bool:
    """Return whether a column holds whole numbers of which most rise from row to row, or most fall, or come once for each ball."""
    values, bad = parse_numbers([row[i].strip() if i < len(row) else "" for row in table.rows[header.first :]])
    values = values[np.isfinite(values)]
    if bad or len(np.unique(values)) < MIN_NUMBERED or not (values == np.round(values)).all():
        return False
    step = np.diff(values)
    return bool(max((step > 0).mean(), (step < 0).mean()) > MOSTLY or ((step >= 0).all() and step.max() <= MOST_ROWS))


def _ticks(table: TextTable, header: Header, i: int) -> bool:
    """Return whether a column rises evenly, as a clock does, but for missing rows, and does more than count the rows."""
    number = _rising(table, header, i, {})
    if number is None or (np.diff(number) == 1).all():
        return False
    size = np.floor(np.log10(np.median(np.diff(number))))
    return camera_clock(number / 10 ** (size + 2)).steady


def _track(
    table: TextTable, header: Header, one: Series, several: bool, calibration: Calibration, notes: list[str]
) -> Track:
    """Return the track of a ball in all rows, without a name."""
    label = f"{' '.join(filter(None, (one.run, one.name)))}: " if several else ""
    columns, first = one.columns, header.first
    axes = [axis for axis in "xyz" if axis in columns]
    raw = np.stack([table.column(columns[k][0], first, header.name(columns[k][0])) for k in axes], axis=-1)
    raw = without_markers(raw, label, notes)
    if "visible" in columns:
        raw = without_invisible(raw, _flags(table, columns["visible"][0], first), label, notes)
    if "likelihood" in columns:
        sure = table.column(columns["likelihood"][0], first, header.name(columns["likelihood"][0]))
        doubtful = (sure < calibration.likelihood) & (np.nanmax(sure, initial=0.0) <= 1) & np.isfinite(raw).all(axis=1)
        if doubtful.any():
            notes.append(
                f"{label}{doubtful.sum():,} positions with a likelihood below {calibration.likelihood:g} were omitted"
            )
        raw[doubtful] = np.nan
    place = np.stack([_in_si(raw[:, k], columns[axis][1], calibration) for k, axis in enumerate(axes)], axis=-1)
    if axes == ["y"]:
        above = calibration.view == "above"
        other = np.where(np.isfinite(place[:, 0]), 0.0, np.nan)
        place = np.stack([place[:, 0], other][:: 1 if above else -1], axis=-1)
        taken, normal = ("x, with y = 0", "wall") if above else ("the height, with x = 0", "floor")
        notes.append(
            f"{label}one coordinate against time, {header.name(columns['y'][0])!r}: taken as {taken}; it holds the velocities"
            f" normal to the {normal}"
        )
    down = calibration.down if calibration.down is not None else any(columns[axis][1] is None for axis in axes[:2])
    if down:
        place[:, 1] *= -1
    more = {
        key: _in_si(table.column(columns[key][0], first, header.name(columns[key][0])), columns[key][1], calibration)
        for key in ("angle", "spin", "sigma_spin", "sigma_time", "time_step") if key in columns
    }  # fmt: skip
    frame = _frames(table, columns["frame"][0], header) if "frame" in columns else None
    steps = more.get("time_step")
    if "time" in columns:
        i, heading = columns["time"]
        time = _in_si(time_column(table, i, first, header.name(i), notes), heading, calibration)
    elif steps is not None and frame is None:
        known = steps[np.isfinite(steps)]
        time = steps if (np.diff(known) > 0).all() else np.cumsum(np.nan_to_num(steps))
    else:
        time = np.arange(float(len(place))) if frame is None else frame
        time = time / (calibration.rate or 1.0)
    return Track(
        "",
        time,
        place,
        more.get("angle"),
        more.get("spin"),
        more.get("sigma_spin"),
        frame=frame,
        sigma_time=more.get("sigma_time"),
        stamped="sigma_time" in more,  # (times that have an error of their own are no rounded ones)
    )


def _frames(table: TextTable, i: int, header: Header) -> Array:
    """Return the frame numbers (n,) in a column, of numbers or of names of pictures such as "IMG_0034.png"."""
    values = frames_of_files(table.cells(i, header.first))
    return table.column(i, header.first, header.name(i)) if values is None else values


def frames_of_files(cells: Sequence[str]) -> Array | None:
    """Return the numbers at the ends of the names of pictures (n,), NaN where a cell is empty; None if the cells are none.

    Examples
    --------
    >>> frames_of_files(["shot2_007.png", "shot2_009.png"]), frames_of_files(["7", "9"])
    (array([7., 9.]), None)
    """
    found = [PICTURE.match(cell) for cell in cells]
    if len({one[1] for one in found if one}) != 1 or any(
        one is None and cell for one, cell in zip(found, cells, strict=True)
    ):
        return None
    return np.array([float(one[2]) if one else np.nan for one in found])


def _flags(table: TextTable, i: int, first: int) -> Array:
    """Return a column of visibility (n,): 0 where the ball is not visible."""
    no = {"0", "0.0", "false", "no", "n", "f"}
    return np.array([0.0 if cell.lower() in no else 1.0 for cell in table.cells(i, first)])


def _in_si(values: Array, meaning: Heading | None, calibration: Calibration) -> Array:
    if meaning is None or (meaning.dimension == "length" and calibration.scale is not None):
        return values * (calibration.scale or 1.0)
    to_si: Callable[[Array], Array] = meaning.unit.to_si if meaning.unit else (lambda x: x)
    return np.asarray(to_si(values))


def _labels(table: TextTable, header: Header, who: dict[str, list[int]], notes: list[str]) -> Labels:
    """Return the names of shots and of balls by kind, each (n,); a column that numbers the rows is none, and noted."""
    found: Labels = {}
    for kind, columns in who.items():
        for i in columns:
            cells = table.cells(i, header.first)
            if numbers_rows(cells, found.get("group")):
                notes.append(ROW_NUMBERS.format(header.name(i)))
            elif kind not in found:
                found[kind] = cells
                continue
            table.used.discard(i)
    return found


def _notes(header: list[str], columns: list[tuple[int, Heading | None]], calibration: Calibration) -> list[str]:
    assumed = {"length": "m", "time": "s"} if calibration.scale is None else {"time": "s"}
    bare = {
        header[i].strip(): assumed[meaning.dimension]
        for i, meaning in columns
        if meaning is not None and meaning.style == "plain" and meaning.dimension in assumed
    }
    notes = []
    if calibration.scale is not None:
        said = [
            header[i].strip()
            for i, meaning in columns
            if meaning is not None and meaning.style != "plain" and meaning.dimension == "length"
        ]
        if said:
            notes.append(f"`scale` overrides the unit in {', '.join(map(repr, said))}")
    if bare:
        notes.append(
            f"no unit in {', '.join(map(repr, bare))}: assumed to be {' and '.join(sorted(set(bare.values())))}"
        )
    return notes


def _split(whole: Track, labels: Labels) -> list[Track]:
    """Split rows into tracks by group and name, in the order of their first rows."""
    groups, names = labels.get("group"), labels.get("name")
    keys = list(zip(groups or [""] * len(whole), names or [""] * len(whole), strict=True))
    order = {key: k for k, key in enumerate(dict.fromkeys(keys))}
    number = np.fromiter((order[key] for key in keys), np.intp, len(keys))
    rows = np.argsort(number, kind="stable")
    edges = np.searchsorted(number[rows], np.arange(len(order) + 1))
    tracks = []
    for (group, label), (low, high) in zip(order, pairwise(edges.tolist()), strict=True):
        tracks.append(replace(whole.select(rows[low:high]), name=label, group=group))
    return tracks
