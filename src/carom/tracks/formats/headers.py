"""Headers of plain tables of positions: where they are, which column holds which quantity of which ball, and rows of units."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field

from carom.data.headers import ColumnNames, Heading, missing_unit
from carom.errors import Fault
from carom.tracks.formats.text_table import is_number

__all__ = ["GROUPS", "NAMES", "Header", "Series", "header_of", "numbers_rows", "series_of"]

# Used only in a table without a column x or y: a table with them may have a height, or a distance, besides.
X_WORDS = ("horizontal", "distance", "weite", "strecke", "abscisse", "abszisse")
Y_WORDS = (
    "vertical",
    "height",
    "höhe",
    "hoehe",
    "hauteur",
    "altura",
    "altezza",
    "ordonnée",
    "ordinate",
    "altitude",
    "elevation",
    "position",
    "h",
)
NAMED = ColumnNames({
    "time": ("time", ("t", "seconds", "sec", "secs", "second", "elapsed", "elapsed_time", "zeit", "temps", "tiempo", "tempo",
                      "tijd", "tid", "czas", "timestamp", "time_stamp")),
    "time_step": ("time", ("dt", "δt", "delta_t", "timestep", "delta_time", "frame_interval")),
    "x": ("length", ("x_long", "pos_x", "position_x", "x_pos", "x_position", "x_coordinate", "x_coord", "x-coordinate", *X_WORDS)),
    "y": ("length", ("y_short", "pos_y", "position_y", "y_pos", "y_position", "y_coordinate", "y_coord", "y-coordinate", *Y_WORDS)),
    "z": ("length", ("pos_z", "position_z")),
    "angle": ("angle", ("theta", "orientation")),
    "spin": ("spin", ("omega", "spin_z")),
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
        one.columns = {"y" if k in "xyz" else k: column for k, column in one.columns.items()}
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
