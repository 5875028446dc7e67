"""Plain tables with named columns and units: t, x, y, and identifiers (shot, ball); one row per frame and ball."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from carom.data.headers import Heading
from carom.errors import suggestion
from carom.tracks.formats.headers import MOST_ABOVE, ROW_NUMBERS, Header, Series, header_of, numbers_rows, series_of
from carom.tracks.formats.missing import without_invisible, without_markers
from carom.tracks.formats.text_table import (
    Calibration,
    TextTable,
    first_rows,
    require_calibration,
    split_rows,
    time_column,
)
from carom.tracks.track import Track

__all__ = ["HEADER_EXAMPLE", "matches", "read"]

PROGRAM = "columns"
HEADER_EXAMPLE = "t [s],x [cm],y [cm]"


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
    balls, who, unknown = series_of(header.cells)
    table.faults += [fault.within(name) for fault in unknown]
    if not balls:
        _require_axes(table, header.cells)
        table.raise_faults()
    notes: list[str] = []
    if header.above:
        notes.append(f"{header.above} line{'s' if header.above > 1 else ''} above the header skipped")
    labels = _labels(table, header, who, notes)
    for one in balls:
        _require_clock(table, header, one, bool(labels), calibration)
    table.raise_faults()
    columns = [column for one in balls for column in one.columns.items()]
    pixels = any(meaning is None for _quantity, (_i, meaning) in columns)
    clocked = all("time" in one.columns for one in balls)
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
    return [replace(track, notes=tuple(notes)) for track in tracks]


def _require_axes(table: TextTable, header: Sequence[str]) -> None:
    """Add a fault for each of x and y that no column holds."""
    from carom.tracks.formats.headers import NAMED

    there = {heading.quantity for cell in header if (heading := NAMED.parse(cell))}
    for axis in "xy":
        if axis not in there:
            near = suggestion(axis, [cell.strip() for cell in header if cell.strip()])
            advice = f"{near}; a header that is understood: {HEADER_EXAMPLE!r}"
            table.faults.add("", f"a column {axis} (with its unit, as in '{axis} [mm]')", "none", advice)


def _require_clock(table: TextTable, header: Header, one: Series, named: bool, calibration: Calibration) -> None:
    """Add a fault if a ball has neither times nor frame numbers, unless its rows are counted at a rate that is given."""
    if {"time", "frame"} & set(one.columns) or (calibration.rate is not None and not named):
        return
    columns = ", ".join(cell.strip() for cell in header.cells)
    hint = "" if named else "`rate` 60 counts the rows as frames"
    table.faults.add("", "a column t (as in 't [s]') or frame", f"columns {columns:.80}", hint)


def _track(
    table: TextTable, header: Header, one: Series, several: bool, calibration: Calibration, notes: list[str]
) -> Track:
    """Return the track of a ball in all rows, without a name."""
    label = f"{' '.join(filter(None, (one.run, one.name)))}: " if several else ""
    columns, first = one.columns, header.first
    raw = np.stack(
        [table.column(columns[k][0], first, header.cells[columns[k][0]].strip()) for k in "xyz" if k in columns],
        axis=-1,
    )
    raw = without_markers(raw, label, notes)
    if "visible" in columns:
        raw = without_invisible(raw, _flags(table, columns["visible"][0], first), label, notes)
    if "likelihood" in columns:
        sure = table.column(columns["likelihood"][0], first, header.cells[columns["likelihood"][0]])
        doubtful = (sure < calibration.likelihood) & (np.nanmax(sure, initial=0.0) <= 1) & np.isfinite(raw).all(axis=1)
        if doubtful.any():
            notes.append(
                f"{label}{doubtful.sum():,} positions with a likelihood below {calibration.likelihood:g} were omitted"
            )
        raw[doubtful] = np.nan
    place = np.stack(
        [_in_si(raw[:, k], columns[axis][1], calibration) for k, axis in enumerate(k for k in "xyz" if k in columns)],
        axis=-1,
    )
    down = calibration.down if calibration.down is not None else columns["x"][1] is None or columns["y"][1] is None
    if down:
        place[:, 1] *= -1
    more: dict[str, NDArray[np.float64]] = {
        key: _in_si(table.column(columns[key][0], first, header.cells[columns[key][0]].strip()), columns[key][1], calibration)
        for key in ("angle", "spin", "frame") if key in columns
    }  # fmt: skip
    if "time" in columns:
        i, heading = columns["time"]
        time = _in_si(time_column(table, i, first, header.cells[i].strip(), notes), heading, calibration)
    else:
        time = more.get("frame", np.arange(float(len(place)))) / (calibration.rate or 1.0)
    return Track("", time, place, more.get("angle"), more.get("spin"), frame=more.get("frame"))


def _flags(table: TextTable, i: int, first: int) -> NDArray[np.float64]:
    """Return a column of visibility (n,): 0 where the ball is not visible."""
    no = {"0", "0.0", "false", "no", "n", "f"}
    cells = [row[i].strip().lower() if i < len(row) else "" for row in table.rows[first:]]
    return np.array([0.0 if cell in no else 1.0 for cell in cells])


def _in_si(values: NDArray[np.float64], meaning: Heading | None, calibration: Calibration) -> NDArray[np.float64]:
    if meaning is None or (meaning.dimension == "length" and calibration.scale is not None):
        return values * (calibration.scale or 1.0)
    to_si: Callable[[NDArray[np.float64]], NDArray[np.float64]] = meaning.unit.to_si if meaning.unit else (lambda x: x)
    return np.asarray(to_si(values))


def _labels(table: TextTable, header: Header, who: dict[str, list[int]], notes: list[str]) -> dict[str, list[str]]:
    """Return the names of shots and of balls by kind, each (n,); a column that numbers the rows is none, and noted."""
    rows = table.rows[header.first :]
    found: dict[str, list[str]] = {}
    for kind, columns in who.items():
        for i in columns:
            cells = [row[i].strip() if i < len(row) else "" for row in rows]
            if numbers_rows(cells, found.get("group")):
                notes.append(ROW_NUMBERS.format(header.cells[i].strip()))
            elif kind not in found:
                found[kind] = cells
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


def _split(whole: Track, labels: dict[str, list[str]]) -> list[Track]:
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
