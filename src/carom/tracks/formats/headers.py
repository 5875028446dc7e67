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
Y_WORDS = ("vertical", "height", "höhe", "hoehe", "hauteur", "altura", "altezza", "ordonnée", "ordinate")
NAMED = ColumnNames({
    "time": ("time", ("t", "seconds", "zeit", "temps", "tiempo", "tempo", "timestamp")),
    "x": ("length", ("x_long", "pos_x", "position_x", "x_pos", "x_position", "x_coordinate", "x_coord", "x-coordinate", *X_WORDS)),
    "y": ("length", ("y_short", "pos_y", "position_y", "y_pos", "y_position", "y_coordinate", "y_coord", "y-coordinate", *Y_WORDS)),
    "z": ("length", ("pos_z", "position_z")),
    "angle": ("angle", ("theta", "orientation")),
    "spin": ("spin", ("omega", "spin_z")),
    "frame": ("number", ("frame_number", "frame_idx", "frame_index", "frame_id", "frame_no", "frame_num", "image", "slice")),
    "visible": ("number", ("visibility", "vis", "is_visible", "detected", "in_view")),
    "likelihood": ("number", ("confidence",)),
})  # fmt: skip
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
BEHIND = re.compile(r"^\s*(.+?)[ _./-]+([xy])\s*([\[(].*[\])])?\s*$", re.IGNORECASE)  # "white ball x (cm)"
# of a ball's motion, or of its picture, but no place
NO_PLACE = re.compile(
    r"^(v|vel|velocity|speed|a|acc|accel|acceleration|force|f|d|delta|std|sigma|err|error|size|width|w|p|momentum|flow|grad)$"
)
# So many numbers at least, and none in more rows (of several shots): the column numbers the rows. No ball is measured in so few.
MIN_NUMBERED, MOST_ROWS = 9, 3
ROW_NUMBERS = "column {!r} numbers the rows: not taken for names of shots or balls"
MOST_ABOVE, MOST_BELOW = 30, 3  # rows above a header that are no table yet, and rows of names and units below it


@dataclass
class Series:
    """The columns of one ball: quantity -> column and heading (None: pixels)."""

    run: str
    """The run of an experiment, if the header names one; empty: none."""
    name: str
    columns: dict[str, tuple[int, Heading | None]] = field(default_factory=dict)


@dataclass
class Header:
    """The header of a table: its row, with the units of rows below it, and the row from which on there are numbers."""

    cells: list[str]
    above: int
    first: int


def header_of(rows: Sequence[Sequence[str]]) -> Header | None:
    """Return the first row with columns x and y among the first rows; None if there is none."""
    for at, row in enumerate(rows[:MOST_ABOVE]):
        cells = [COMMENT.sub("", row[0]) if row else "", *row[1:]]
        if row and not cells[0].strip() and COMMENT.match(row[0]):
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
        key = re.sub(r"\s+", "_", text.lower())
        if key in GROUPS or key in NAMES:
            who["group" if key in GROUPS else "name"].append(i)
            continue
        run, name, quantity, heading = _meaning(text)
        if not quantity:
            behind = BEHIND.match(text)
            if behind and (
                f"{behind[1]}.{behind[2]}" in text or not NO_PLACE.match(re.split(r"[ _./-]", behind[1].lower())[-1])
            ):
                _run, _name, axis, heading = _meaning(behind[2] + (behind[3] or ""))
                named.setdefault(behind[1], Series("", behind[1])).columns.setdefault(axis, (i, heading))
            continue
        if seen[text] > 1:
            name = f"{name}#{seen[text]}"
        other = spare if heading is not None and heading.alias in (*X_WORDS, *Y_WORDS) else found
        other.setdefault((run, name), Series(run, name)).columns.setdefault(quantity, (i, heading))
    for which, one in spare.items():
        mine = found.setdefault(which, one)
        mine.columns = one.columns | mine.columns
    balls = [one for one in found.values() if {"x", "y"} <= set(one.columns)]
    if not balls:
        balls = [one for one in named.values() if {"x", "y"} <= set(one.columns)]
    if not balls:  # what there is, for a message
        return [], who, _unknown(header, [*found.values()])
    return _completed(balls, found), who, _unknown(header, balls)


def _meaning(text: str) -> tuple[str, str, str, Heading | None]:
    """Return run, number, quantity and heading of a cell of a header; an empty quantity if it is none that is known."""
    if pixels := PIXELS.match(text):
        return "", "", pixels[1].lower(), None
    if heading := NAMED.parse(text):
        return "", "", heading.quantity, heading
    if (run := RUN.match(text)) and (inner := _meaning(run[2]))[2]:
        return run[1], *inner[1:]
    if (behind := RUN_BEHIND.match(text)) and (inner := _meaning(behind[1]))[2]:
        return behind[2], *inner[1:]
    if (number := NUMBERED.match(text)) and (inner := _meaning(number[1] + (number[3] or "")))[2] in ("x", "y", "time"):
        return "", number[2], *inner[2:]
    return "", "", "", None


def _completed(balls: list[Series], found: dict[tuple[str, str], Series]) -> list[Series]:
    """Return the balls with the time and the frame of their run, where they have none of their own; and with names."""
    for one in balls:
        own = bool({"time", "frame"} & set(one.columns))
        for quantity in ("time", "frame"):
            shared = [other.columns[quantity] for other in found.values()
                      if quantity in other.columns and other.run in (one.run, "")]  # fmt: skip
            if shared and not own:
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
