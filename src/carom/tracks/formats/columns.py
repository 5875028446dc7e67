"""Plain tables with named columns and units: t, x, y, and identifiers (shot, ball); one row per frame and ball."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from carom.data.headers import Heading
from carom.data.table_cells import parse_numbers
from carom.errors import suggestion
from carom.tracks.formats.headers import (
    CLOCKS,
    FRAME_WORD,
    MIN_NUMBERED,
    MOST_ABOVE,
    MOST_ROWS,
    NAMED,
    ROW_NUMBERS,
    Header,
    Series,
    header_of,
    numbers_rows,
    series_of,
)
from carom.tracks.formats.missing import without_invisible, without_markers
from carom.tracks.formats.text_table import (
    Calibration,
    TextTable,
    first_rows,
    require_calibration,
    split_rows,
    time_column,
)
from carom.tracks.frame_clock import camera_clock
from carom.tracks.track import Track

__all__ = ["HEADER_EXAMPLE", "matches", "read"]

PROGRAM = "columns"
HEADER_EXAMPLE = "t [s],x [cm],y [cm]"
Array = NDArray[np.float64]
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
        _require_clock(table, header, one, bool(labels), calibration)
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
    steps = np.concatenate([np.diff(part) for part in parts])
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
        place = np.stack([0 * place[:, 0], place[:, 0]], axis=-1)
        notes.append(
            f"{label}one coordinate against time, {header.name(columns['y'][0])!r}: taken as the height, with x = 0; it holds the"
            " velocities normal to the floor"
        )
    down = calibration.down if calibration.down is not None else any(columns[axis][1] is None for axis in axes[:2])
    if down:
        place[:, 1] *= -1
    more = {
        key: _in_si(table.column(columns[key][0], first, header.name(columns[key][0])), columns[key][1], calibration)
        for key in ("angle", "spin", "time_step") if key in columns
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
    return Track("", time, place, more.get("angle"), more.get("spin"), frame=frame)


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
