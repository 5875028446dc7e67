"""Plain tables with named columns and units: t, x, y, and identifiers (shot, ball); one row per frame and ball."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from carom.data.headers import ColumnNames, Heading
from carom.errors import CaromError, suggestion
from carom.tracks.formats.text_table import Calibration, TextTable, first_rows, require_calibration, split_rows
from carom.tracks.track import Track

__all__ = ["HEADER_EXAMPLE", "matches", "read"]

PROGRAM = "columns"
# Used only in a table without a column x or y: a table with them may have a height, or a distance, besides.
X_WORDS = ("horizontal", "distance", "weite", "strecke", "abscisse", "abszisse")
Y_WORDS = ("vertical", "height", "höhe", "hoehe", "hauteur", "altura", "altezza", "ordonnée", "ordinate")
HEADER_EXAMPLE = "t [s],x [cm],y [cm]"
NAMED = ColumnNames({
    "time": ("time", ("t", "seconds", "zeit", "temps", "tiempo", "tempo")),
    "x": ("length", ("x_long", "pos_x", "position_x", "x_pos", "x_position", "x_coordinate", *X_WORDS)),
    "y": ("length", ("y_short", "pos_y", "position_y", "y_pos", "y_position", "y_coordinate", *Y_WORDS)),
    "z": ("length", ("pos_z", "position_z")),
    "angle": ("angle", ("theta", "orientation")),
    "spin": ("spin", ("omega", "spin_z")),
    "frame": ("number", ("frame_number", "image")),
})  # fmt: skip
GROUPS, NAMES = (
    ("shot", "group", "game", "run", "trial", "film", "versuch", "wurf", "essai"),
    ("ball", "track", "particle", "name", "id", "object"),
)
PIXELS = re.compile(r"^(x|y)\s*(?:[\[(_ /,]|in\s)?\s*(px|pix|pixels?)\s*[\])]?$", re.IGNORECASE)


def matches(text: str) -> bool:
    """Return whether the first row has columns x and y."""
    rows = first_rows(text, 1)
    return bool(rows) and {"x", "y"} <= set(_meanings(rows[0])[0])


def _meanings(header: list[str]) -> tuple[dict[str, tuple[int, Heading | None]], dict[str, int], list[str]]:
    """Return quantity -> column and heading (None: pixels), identifier -> column, and faults of headers with unknown units."""
    found: dict[str, tuple[int, Heading | None]] = {}
    spare: dict[str, tuple[int, Heading | None]] = {}
    who: dict[str, int] = {}
    for i, cell in enumerate(header):
        text = cell.strip().lower()
        pixels = PIXELS.match(text)
        meaning = None if pixels else NAMED.parse(cell)
        if pixels:
            found.setdefault(pixels[1], (i, None))
        elif text in GROUPS:
            who.setdefault("group", i)
        elif text in NAMES:
            who.setdefault("name", i)
        elif meaning is not None:
            other = spare if meaning.alias in (*X_WORDS, *Y_WORDS) else found
            other.setdefault(meaning.quantity, (i, meaning))
    found = spare | found
    unknown = [
        f"column {header[i].strip()!r}: expected a unit, one of {meaning.units}"
        for i, meaning in found.values()
        if meaning is not None and meaning.unit is None
    ]
    return found, who, unknown


def read(name: str, text: str, calibration: Calibration) -> list[Track]:
    """Read tracks by group and name; with a z column they have three coordinates."""
    table = split_rows(name, text)
    if not table.rows:
        raise CaromError(f"{name}: expected a header and rows, got an empty file")
    header = table.rows[0]
    found, who, unknown = _meanings(header)
    table.faults += [f"{name}: {fault}" for fault in unknown]
    for axis in "xy":
        if axis not in found:
            near = suggestion(axis, [cell.strip() for cell in header if cell.strip()])
            table.faults.append(
                f"{name}: expected a column {axis} (with its unit, as in '{axis} [mm]'), got none; {near};"
                f" a header that is understood: {HEADER_EXAMPLE!r}"
            )
    counted = "time" not in found and "frame" not in found  # by the rows of a single ball
    if counted and (calibration.rate is None or who):
        columns = ", ".join(cell.strip() for cell in header)
        hint = "" if who else "; --rate 60 counts the rows as frames"
        table.faults.append(f"{name}: expected a column t (as in 't [s]') or frame, got columns {columns:.80}{hint}")
    table.raise_faults()
    pixels = found["x"][1] is None or found["y"][1] is None
    require_calibration(
        name, PROGRAM, calibration, scale="since its positions are in pixels" if pixels else None,
        rate="since it has frame numbers but no times" if "time" not in found else None,
    )  # fmt: skip
    sizes = {axis: _units(table, found[axis], calibration) for axis in "xyz" if axis in found}
    place = np.stack(list(sizes.values()), axis=-1)
    down = calibration.down if calibration.down is not None else pixels
    if down:
        place[:, 1] *= -1
    if "time" in found:
        time = _units(table, found["time"], calibration)
    else:
        frames = np.arange(float(len(place))) if counted else _units(table, found["frame"], calibration)
        time = frames / (calibration.rate or 1.0)
    more: dict[str, NDArray[np.float64]] = {
        key: _units(table, found[key], calibration) for key in ("angle", "spin", "frame") if key in found
    }
    table.raise_faults()
    notes = _notes(header, found, calibration)
    labels = {key: [row[i].strip() if i < len(row) else "" for row in table.rows[1:]] for key, i in who.items()}
    return _split(time, place, more, labels, notes)


def _units(table: TextTable, column: tuple[int, Heading | None], calibration: Calibration) -> NDArray[np.float64]:
    i, meaning = column
    values = table.column(i, 1, table.rows[0][i].strip())
    if meaning is None or (meaning.dimension == "length" and calibration.scale is not None):
        return values * (calibration.scale or 1.0)
    to_si: Callable[[NDArray[np.float64]], NDArray[np.float64]] = meaning.unit.to_si if meaning.unit else (lambda x: x)
    return np.asarray(to_si(values))


def _notes(
    header: list[str], found: dict[str, tuple[int, Heading | None]], calibration: Calibration
) -> tuple[str, ...]:
    assumed = {"length": "m", "time": "s"} if calibration.scale is None else {"time": "s"}
    bare = [
        (header[i].strip(), assumed[meaning.dimension])
        for i, meaning in found.values()
        if meaning is not None and meaning.style == "plain" and meaning.dimension in assumed
    ]
    notes = []
    if calibration.scale is not None:
        said = [
            header[i].strip()
            for i, meaning in found.values()
            if meaning is not None and meaning.style != "plain" and meaning.dimension == "length"
        ]
        if said:
            notes.append(f"--scale overrides the unit in {', '.join(map(repr, said))}")
    if bare:
        cells, units = (
            ", ".join(repr(cell) for cell, _unit in bare),
            " and ".join(sorted({unit for _cell, unit in bare})),
        )
        notes.append(f"no unit in {cells}: assumed to be {units}")
    return tuple(notes)


def _split(
    time: NDArray[np.float64], place: NDArray[np.float64], more: dict[str, NDArray[np.float64]],
    labels: dict[str, list[str]], notes: tuple[str, ...],
) -> list[Track]:  # fmt: skip
    """Split rows into tracks by group and name, in the order of their first rows."""
    whole = Track("", time, place, more.get("angle"), more.get("spin"), notes=notes, frame=more.get("frame"))
    groups, names = labels.get("group"), labels.get("name")
    if groups is None and names is None:
        return [replace(whole, name="ball")]
    keys = list(zip(groups or [""] * len(time), names or ["ball"] * len(time), strict=True))
    order = {key: k for k, key in enumerate(dict.fromkeys(keys))}
    number = np.fromiter((order[key] for key in keys), np.intp, len(keys))
    rows = np.argsort(number, kind="stable")
    edges = np.searchsorted(number[rows], np.arange(len(order) + 1))
    tracks = []
    for (group, label), (low, high) in zip(order, pairwise(edges.tolist()), strict=True):
        tracks.append(replace(whole.select(rows[low:high]), name=label, group=group))
    return tracks
