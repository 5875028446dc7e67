"""Files of programs that follow balls: a table per ball (side by side, or one below the other), or a row per ball and frame."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.core.units import UNITS, parse_quantity, unit_named
from carom.data.headers import BRACKETS
from carom.errors import CaromError, FaultList
from carom.files import parse_json
from carom.tracks.formats import tables
from carom.tracks.formats.tables import (
    IN_PIXELS,
    Calibration,
    TextTable,
    first_rows,
    numbers,
    require_calibration,
    require_sizes,
    split_rows,
    time_codes,
)
from carom.tracks.track import Track

Array = NDArray[np.float64]
CLOCK = ("time", "seconds")
UNREADABLE = (KeyError, TypeError, ValueError, AttributeError, OverflowError)


def _placed(x: Array, y: Array, calibration: Calibration, down: bool, unit: float = 1.0) -> Array:
    """Return places (n, 2), m. ``down``, ``unit``: how the program writes them, where the calibration does not say."""
    scale = unit if calibration.scale is None else calibration.scale
    turned = down if calibration.down is None else calibration.down
    return np.asarray(scale * np.stack([x, -y if turned else y], axis=-1))


def _titles(text: str, row: int = 0) -> list[str]:
    """Return the cells of one of the first rows of a text; none if it has no such row."""
    rows = first_rows(text, row + 1)
    return [cell.strip() for cell in rows[row]] if len(rows) > row else []


# ----------------------------------------------------------------------------------------------------
# A table per ball, side by side: columns x and y of each ball, and one clock.


def _side_by_side(
    table: TextTable, program: str, header: Sequence[str], balls: Mapping[str, Mapping[str, int]], first: int,
    clock: tuple[Array, Array | None], calibration: Calibration, down: bool, notes: Sequence[str] = (),
) -> list[Track]:  # fmt: skip
    """Return one track per ball; a ball without both axes is a fault. ``clock``: times, s, and the numbers of the frames."""
    tracks = []
    for ball, columns in balls.items():
        if not {"X", "Y"} <= set(columns):
            got = f"{', '.join(header[i] for i in columns.values())} only"
            table.faults.add(f"{program}: {ball}", "columns of x and y", got)
            continue
        x, y = (table.column(columns[axis], first, header[columns[axis]]) for axis in "XY")
        place, said, least = _placed(x, y, calibration, down), list(notes), calibration.likelihood
        if "LIKELIHOOD" in columns:
            doubtful = ~(table.column(columns["LIKELIHOOD"], first, header[columns["LIKELIHOOD"]]) >= least)
            place[doubtful] = np.nan
            if doubtful.any():
                said.append(f"{ball}: {doubtful.sum():,} positions with a likelihood below {least:g} were omitted")
        tracks.append(Track(ball, clock[0], place, frame=clock[1], notes=tuple(said)))
    return tracks


def _with_unused(tracks: Iterable[Track], table: TextTable, header: Sequence[str], first: int) -> list[Track]:
    """Return tracks with a note on the columns that were not read; CaromError for faults of the table."""
    table.raise_faults()
    more = tuple(table.unused(header, first))
    return [replace(track, notes=(*track.notes, *more)) for track in tracks]


# DeepLabCut: three header rows (scorer, bodyparts, coords; four with individuals), pixels, a likelihood for each position.
IMAGE = re.compile(r"^labeled-data|\.(png|jpe?g|bmp|tiff?)$", re.IGNORECASE)
TITLES = ("scorer", "individuals", "bodyparts", "coords")


def is_deeplabcut(text: str) -> bool:
    """Return whether the first cell is ``scorer``."""
    return text.lstrip()[:7].lower() == "scorer,"


def deeplabcut(name: str, text: str, calibration: Calibration) -> list[Track]:
    """Read one track per body part; positions with a low likelihood are missing."""
    require_calibration(name, "DeepLabCut", calibration, **IN_PIXELS)
    table = split_rows(name, text, ",")
    titles: dict[str, list[str]] = {}
    first = 0
    while first < len(table.rows) and table.rows[first][0].strip() in TITLES:
        titles[table.rows[first][0].strip()] = [cell.strip() for cell in table.rows[first]]
        first += 1
    if "bodyparts" not in titles or "coords" not in titles:
        raise CaromError(
            f"{name}: DeepLabCut: expected rows bodyparts and coords under scorer, got {', '.join(titles) or 'none'}"
        )
    if first < len(table.rows) and any(IMAGE.search(cell.strip()) for cell in table.rows[first][:3]):
        raise CaromError(
            f"{name}: DeepLabCut: expected the positions in all frames of a film, which analyze_videos writes, got labels of single"
            f" images ({table.rows[first][0].strip()[:40]!r} ...), as in machinelabels and CollectedData files; export the analysed"
            " film as CSV"
        )
    balls: dict[str, dict[str, int]] = {}
    for i in range(1, min(map(len, titles.values()))):
        ball = " ".join(titles[row][i] for row in ("individuals", "bodyparts") if row in titles)
        balls.setdefault(ball, {})[titles["coords"][i].upper()] = i
    frame = table.column(0, first, "frame")
    clock = frame / (calibration.rate or 1.0), frame
    header = [" ".join(filter(None, cells)) for cells in zip(*titles.values(), strict=False)]
    tracks = _side_by_side(table, "DeepLabCut", header, balls, first, clock, calibration, True)
    return _with_unused(tracks, table, header, first)


# idTracker and idtracker.ai: X1, Y1, X2, Y2 ... side by side, a row per frame; pixels, the second axis down.


def is_idtracker(text: str) -> bool:
    """Return whether the first row begins with X1, Y1 (idTracker), or with time, x1, y1 (idtracker.ai)."""
    header = [cell.lower() for cell in _titles(text)]
    return header[:2] == ["x1", "y1"] or (header[1:3] == ["x1", "y1"] and header[0] in CLOCK)


def idtracker(name: str, text: str, calibration: Calibration) -> list[Track]:
    """Read one track per animal, without the probabilities. Rows are numbered from 0."""
    timed = any(cell.lower() in CLOCK for cell in _titles(text))
    require_calibration(
        name, "idTracker", calibration, scale=IN_PIXELS["scale"], rate=None if timed else "since it has no times"
    )
    found = tables.read(name, text, replace(calibration, down=calibration.down is not False))
    notes = tuple(note for note in found[0].notes if not note.startswith("no unit"))  # (seconds, as the program has it)
    return [replace(one, frame=np.arange(len(one.time), dtype=float), notes=notes) for one in found]


# Kinovea: a CSV file of several points, or the older text export of trajectories; neither states the unit of length.
OF_POINTS = re.compile(r"^.*/[XY]$", re.IGNORECASE)


def is_kinovea(text: str) -> bool:
    """Return whether the text begins with #Kinovea, or has columns such as Name/0/X."""
    return text.lstrip().startswith("#Kinovea") or any(map(OF_POINTS.match, _titles(text)))


def kinovea(name: str, text: str, calibration: Calibration) -> list[Track]:
    """Read the tracks of a file; times are in seconds."""
    why = "since Kinovea does not write the unit in which it was calibrated (or pixels)"
    require_calibration(name, "Kinovea", calibration, scale=why)
    if text.lstrip().startswith("#Kinovea"):
        return _trajectories(name, text, calibration)
    return [replace(one, name=one.name.removesuffix("/0")) for one in tables.read(name, text, calibration)]


def _trajectories(name: str, text: str, calibration: Calibration) -> list[Track]:
    """Read blocks of rows "T X Y", each after a line with its label, or after an empty line."""
    faults = FaultList(name)
    blocks: list[tuple[str, list[tuple[int, list[str]]]]] = []
    begins = True
    for number, line in enumerate(text.splitlines(), 1):
        words = line.split()
        if not words or line.startswith(("#Kinovea", "#T")):
            begins = True
        elif line.startswith("#"):
            blocks.append((line.lstrip("# ").strip(), []))
            begins = False
        else:
            if begins and (not blocks or blocks[-1][1]):
                blocks.append(("", []))
            begins = False
            blocks[-1][1].append((number, words))
    blocks = [(label, part) for label, rows in blocks for part in _where_times_begin_anew(rows)]
    tracks = []
    for index, (label, rows) in enumerate(blocks, 1):
        title = label or (f"track {index}" if len(blocks) > 1 else "Kinovea")
        lines = [number for number, _words in rows]
        cells = [[words[i] if i < len(words) else "" for _n, words in rows] for i in range(3)]
        notes: list[str] = []
        time = time_codes(cells[0], notes)
        columns = [
            numbers(some, True, lines.__getitem__, f"{title}: {axis}", faults)
            for axis, some in zip("TXY", cells, strict=True)
            if time is None or axis != "T"
        ]
        time, (x, y) = (columns[0], columns[1:]) if time is None else (time, columns)
        tracks.append(Track(title, time, _placed(x, y, calibration, False), notes=tuple(notes)))
    faults.raise_if_any()
    return tracks


def _where_times_begin_anew(rows: list[tuple[int, list[str]]]) -> list[list[tuple[int, list[str]]]]:
    """Return the rows of a block in parts: a time that comes again begins the first row of another track."""
    starts = [k for k, (_n, words) in enumerate(rows) if k == 0 or words[0] == rows[0][1][0]]
    spaced = len(starts) > 1 and min(np.diff(starts)) > 1
    edges = [*(starts if spaced else starts[:1]), len(rows)]
    return [rows[low:high] for low, high in pairwise(edges)]


# MTrack2 (ImageJ): Frame, then X, Y and Flag of each object; pixels, the second axis down, frame numbers and no time.
OF_OBJECTS = re.compile(r"^(X|Y|Flag)\d+$")
BLOCK = re.compile(r"^Tracks (\d+) to \d+")
SUMMARY = re.compile(r"^Track\b")


def is_mtrack2(text: str) -> bool:
    """Return whether the first row, or the one below "Tracks 1 to 75", begins with Frame, X1, Y1."""
    return any(_titles(text, row)[:3] == ["Frame", "X1", "Y1"] for row in (0, 1))


def mtrack2(name: str, text: str, calibration: Calibration) -> list[Track]:
    """Read one track per object; objects beyond the 75th are in blocks of their own, one below the other.

    The row of names stands above the first block, or in each one; a block without it has the columns of the block before, as far
    as they go. A table of the lengths of tracks may follow the last one.
    """
    require_calibration(name, "MTrack2", calibration, **IN_PIXELS)
    table = split_rows(name, text, "\t" if "\t" in text else None)
    tracks: list[Track] = []
    header: list[str] = []
    first = low = 0
    for high, row in enumerate([*table.rows, ["Track"]]):
        cell = row[0].strip()
        block, named = BLOCK.match(cell), cell == "Frame"
        if not (block or named or SUMMARY.match(cell)):
            continue
        if high > low and header:
            some = table.between(low, high)
            frame, width = some.column(0, 0, "Frame"), max(map(len, some.rows))
            places = [i for i, title in enumerate(header[: width - 1]) if title.startswith("X")]
            balls = {f"object {number}": {"X": i, "Y": i + 1} for number, i in enumerate(places, first)}
            clock = frame / (calibration.rate or 1.0), frame
            tracks += _side_by_side(some, "MTrack2", header, balls, 0, clock, calibration, True)
            table.faults += some.faults
        if not (block or named):
            break
        low = high + 1
        if block:
            first = int(block[1])
        else:
            header = [title.strip() for title in row]
            first = first or 1
            for title, beside in zip(header, [*header[1:], ""], strict=True):
                other = f"Y{title[1:]}"
                if OF_OBJECTS.match(title) and title[0] == "X" and beside != other:
                    table.faults.add("MTrack2", f"a column {other} beside {title}", "none")
    return _with_unused(tracks, table, header, 0)


# Tracker (Open Source Physics): one track, or several side by side; lengths as calibrated (m), the second axis up.


def is_tracker(text: str) -> bool:
    """Return whether the text has a ``#multi:`` line, or a line with only names of tracks before the header t, x, y."""
    if text.lstrip().lower().startswith("#multi"):
        return True
    names = [_name_and_unit(cell)[0] for cell in _titles(text, 1)]
    titles = [cell for cell in _titles(text) if cell]
    balls = max(names.count("x"), names.count("pixelx"))
    headed = any(_name_and_unit(cell)[0] in ("t", "x", "y") for cell in titles)
    return "t" in names and 1 <= len(titles) <= balls and not headed


def tracker(name: str, text: str, calibration: Calibration) -> list[Track]:
    """Read the tracks of a file: the columns t, x, y (or pixelx, pixely, with a scale), and frame."""
    first, _end, rest = text.lstrip().partition("\n")
    multi = first.lower().startswith("#multi")
    table = split_rows(name, rest if multi else text.lstrip())
    above = text[: len(text) - len(text.lstrip())].count("\n") + multi
    table.lines = [n + above for n in table.lines]
    if len(table.rows) < 3:
        raise CaromError(f"{name}: Tracker: expected a row of names, a header and rows, got {len(table.rows)} rows")
    titles, (header, units) = table.rows[0], zip(*map(_name_and_unit, table.rows[1]), strict=True)
    if "t" not in header:
        raise CaromError(
            f"{name}: Tracker: expected a column t, got {', '.join(filter(None, header))}; export it with the time"
        )
    time = _in_si(table, header.index("t"), "t", units, "time")
    starts = [i for i, cell in enumerate(titles) if cell.strip()]
    names = [titles[i].strip() for i in starts]
    last = "y" if "y" in header else "pixely"
    if (
        not multi and header.count(last) > 1
    ):  # side by side without that mark: each begins after the y of the one before
        starts = [0, *(i + 1 for i, cell in enumerate(header) if cell == last)][:-1]
        names += [f"track {k + 1}" for k in range(len(names), len(starts))]
        multi = True
    parts = list(pairwise([*starts, len(header)])) if multi else [(0, len(header))]
    tracks = []
    for title, (start, end) in zip(names, parts, strict=False):
        columns = {header[i]: i for i in reversed(range(start, min(end, len(header))))}
        tracks.append(_of_tracker(table, title, time, columns, units, calibration))
    numbered = [table.column(i, 2, "frame") for i, cell in enumerate(header) if cell == "frame"]
    frame = np.fmax.reduce(numbered) if numbered else None  # (each track has them for its own rows)
    table.used |= {i for i, cell in enumerate(header) if cell == "t"}  # (each of several tracks may have it)
    return _with_unused([replace(track, frame=frame) for track in tracks], table, table.rows[1], 2)


def _name_and_unit(cell: str) -> tuple[str, str]:
    """Return the name of a column, in lower case, and its unit if the header has one in brackets, as in ``x (cm)``."""
    found = BRACKETS.match(cell.strip())
    return (found[1].strip().lower(), found[2].strip()) if found else (cell.strip().lower(), "")


def _in_si(table: TextTable, i: int, label: str, units: Sequence[str], dimension: str) -> Array:
    """Return a column as numbers (n,) in SI units; a unit that is not known is a fault."""
    values = table.column(i, 2, label)
    unit = unit_named(units[i], dimension) if units[i] else None
    if unit is None and units[i]:
        table.faults.add(f"column {label}", f"a unit, one of {', '.join(UNITS[dimension])}", repr(units[i]))
    return values if unit is None else np.asarray(unit.to_si(values))


def _of_tracker(
    table: TextTable, title: str, time: Array, columns: dict[str, int], units: Sequence[str], calibration: Calibration
) -> Track:
    pixels = not {"x", "y"} <= set(columns)
    names = ("pixelx", "pixely") if pixels else ("x", "y")
    if not set(names) <= set(columns):
        got = ", ".join(filter(None, columns)) or "none"
        raise CaromError(f"{table.name}: Tracker: track {title!r}: expected columns x and y, got {got}")
    if pixels:
        require_calibration(table.name, "Tracker", calibration, scale="since the track is in pixels")
    known = calibration.scale is None and not pixels
    x, y = (
        _in_si(table, columns[one], one, units, "length") if known else table.column(columns[one], 2, one)
        for one in names
    )
    said = known and all(units[columns[one]] for one in names)
    notes = () if calibration.scale or said else ("lengths in the units of Tracker: assumed to be m",)
    return Track(title, time, _placed(x, y, calibration, pixels), notes=notes)


# ----------------------------------------------------------------------------------------------------
# A row per ball and frame.


# SLEAP: the analysis as CSV, with node.x, node.y; pixels, the second axis down, frame numbers.


def is_sleap(text: str) -> bool:
    """Return whether there are columns frame_idx and instance.score."""
    return {"frame_idx", "instance.score"} <= set(_titles(text))


def sleap(name: str, text: str, calibration: Calibration) -> list[Track]:
    """Read one track per node and track."""
    require_calibration(name, "SLEAP", calibration, **IN_PIXELS)
    return tables.read(name, text, replace(calibration, down=calibration.down is not False))


# Data frames of trackpy, saved as CSV: pixels, the second axis down, frame numbers and no time.


def is_trackpy(text: str) -> bool:
    """Return whether there are columns x, y, frame, and one that only trackpy has."""
    names = set(_titles(text))
    return {"x", "y", "frame"} <= names and bool({"particle", "mass", "ecc", "raw_mass", "signal"} & names)


def trackpy(name: str, text: str, calibration: Calibration) -> list[Track]:
    """Read one track per particle."""
    require_calibration(name, "trackpy", calibration, **IN_PIXELS)
    found = tables.read(name, text, replace(calibration, down=calibration.down is not False))
    names = [track.name.removesuffix(".0") for track in found]
    return [replace(one, name=f"particle {n if n.isdecimal() else 0}") for one, n in zip(found, names, strict=True)]


# TrackMate (Fiji): a table of spots as CSV, with up to three more header rows and units in the last; the second axis down.
TRACK, TIME, FRAME, X, Y = "TRACK_ID", "POSITION_T", "FRAME", "POSITION_X", "POSITION_Y"
UNIT = re.compile(r"^\((.*)\)$")


def is_trackmate(text: str) -> bool:
    """Return whether there are columns TRACK_ID, POSITION_X and POSITION_Y."""
    return {TRACK, X, Y} <= {cell.upper() for cell in _titles(text)}


def trackmate(name: str, text: str, calibration: Calibration) -> list[Track]:
    """Read one track per TRACK_ID, in order of time; spots that belong to no track are left out."""
    table = split_rows(name, text)
    header = [cell.strip().upper() for cell in table.rows[0]]
    column = {title: header.index(title) for title in reversed(header)}
    missing = [title for title in (TRACK, X, Y) if title not in column]
    if TIME not in column and FRAME not in column:
        missing.append(f"{TIME} or {FRAME}")
    if missing:
        raise CaromError(
            f"{name}: TrackMate: expected columns {', '.join(missing)}, got none; export all columns of the spots"
        )
    first = _first_row(table, column[X])
    track_id = table.cells(column[TRACK], first)
    spots = np.array([cell.isdecimal() for cell in track_id], bool)
    if not spots.any():
        raise CaromError(
            f"{name}: TrackMate: expected spots with a TRACK_ID, got none; link the spots to tracks, and export again"
        )
    size, second = (_unit(table, column.get(title), first, si) for title, si in ((X, "m"), (TIME, "s")))
    require_calibration(
        name, "TrackMate", calibration, scale=IN_PIXELS["scale"] if size is None else None,
        rate="since it has frame numbers but no times in seconds" if second is None else None,
    )  # fmt: skip
    x, y = (table.column(column[title], first, title) for title in (X, Y))
    frame = table.column(column[FRAME], first, FRAME) if FRAME in column else None
    timed = TIME in column and (frame is None or second is not None)
    time = table.column(column[TIME], first, TIME) if timed else None
    table.raise_faults()
    if second is None:
        frame = time if frame is None else frame
        time = None if frame is None else frame / (calibration.rate or 1.0)
    elif time is not None:
        time = time * second
    assert time is not None
    place = _placed(x, y, calibration, True, size or 1.0)
    lost = int((~spots).sum())
    notes: tuple[str, ...] = (f"{lost:,} spots that belong to no track were left out",) if lost else ()
    notes += tuple(table.unused(table.rows[0], first))
    number = np.where(spots, track_id, "-1").astype(int)
    order = np.argsort(time, kind="stable")
    parts = [order[number[order] == one] for one in np.unique(number[spots])]
    return [
        Track(f"track {number[rows[0]]}", time[rows], place[rows], frame=None if frame is None else frame[rows], notes=notes)
        for rows in parts
    ]  # fmt: skip


def _first_row(table: TextTable, x: int) -> int:
    """Return the first row with a number as its position: up to three header rows follow the first."""
    for i in range(1, min(len(table.rows), 4)):
        cell = table.rows[i][x].strip() if x < len(table.rows[i]) else ""
        if cell[:1].isdigit() or cell[:1] in ("-", "+", "."):
            return i
    return min(len(table.rows), 4)


def _unit(table: TextTable, column: int | None, first: int, si: str) -> float | None:
    """Return the unit of a column, in SI, from the header rows; None for pixels, frames, and where none is written."""
    if column is None:
        return None
    for row in table.rows[1:first]:
        if column < len(row) and (found := UNIT.match(row[column].strip())):
            try:
                return parse_quantity(f"1 {found[1]}", si)
            except ValueError:
                return None
    return None


# Carom tables that record their games: JSON, positions as fractions of the table's sides, times in steps of 0.5 ms.
TICK = 5e-4
KEYS = ("DeltaT_500us", "X", "Y")


def is_carom_table(text: str) -> bool:
    """Return whether the text is JSON with the key PathTracking."""
    return text.lstrip()[:1] == "{" and '"PathTracking"' in text[:2000]


def carom_table(name: str, text: str, calibration: Calibration) -> list[Track]:
    """Read one track per ball. Times count from the start, or from row to row if they do not increase throughout."""
    whole = parse_json(f"{name}: carom table", text)
    try:
        found = whole["PathTracking"]
        size = np.array([float(found["TableWidth"]), float(found["TableHeight"])]) / 1000
        sets = list(found["DataSets"])
    except UNREADABLE as error:
        wanted = "PathTracking with DataSets, TableWidth and TableHeight (mm)"
        raise CaromError(f"{name}: carom table: expected {wanted}; missing: {error}") from None
    tracks, faults = [], FaultList(name)
    for number, one in enumerate(sets):
        where = f"carom table: DataSets[{number}]"
        try:
            rows = _rows([[row[key] for key in KEYS] for row in one["Coords"]], KEYS, where, faults)
        except UNREADABLE as error:
            faults.add(where, f"Coords with DeltaT_500us, X and Y, missing or no number: {error}")
            continue
        tracks.append((one.get("BallColor", number + 1), rows))
    require_sizes(size, "carom table: TableWidth, TableHeight", faults)
    faults.raise_if_any()
    read = []
    for colour, rows in tracks:
        ticks, (x, y) = rows[:, 0], (rows[:, 1:] * size).T
        time = TICK * (ticks if (np.diff(ticks) > 0).all() else np.cumsum(ticks))
        place = _placed(x, y, replace(calibration, scale=None), False)
        read.append(Track(f"ball {colour}", time, place, moving_only=True))
    return read


def _rows(rows: Any, names: Sequence[str], where: str, faults: FaultList) -> Array:
    """Return rows (n, 3) of a time and a place as numbers; a fault for numbers that are far too large."""
    found = np.array([[float(x) for x in row] for row in rows]).reshape(-1, 3)
    for axis, values in zip(names, found.T, strict=True):
        require_sizes(values, f"{where}: {axis}", faults)
    return found


# tailuge/billiards: filmed shots as JSON, a list of shots with t, x, y of each ball, or one with the samples that it is fitted to.
# Lengths are in units of that game's table, 92.36 by 46.18 ball radii of 0.03275, from its centre; here it is 2.84 m long.
TAILUGE = 2.84 / (92.36 * 0.03275)  # m
BEGINNING = 4000  # characters in which the names of the first shot stand
NOTE = "lengths of tailuge's table, with balls of radius 0.03275, are read as those of a table of 2.84 m; `scale` overrides it"


def is_tailuge(text: str) -> bool:
    """Return whether the text is JSON of shots with ``balls`` that have ``t``, or of one with ``truth`` beside ``sim``."""
    start = text.lstrip()[:BEGINNING]
    if start[:1] not in ("[", "{"):
        return False
    packed = "".join(start[:400].split())
    return ('"balls":{' in packed and '"t":[' in packed) or ('"sim"' in start and '"truth"' in text)


def tailuge(name: str, text: str, calibration: Calibration) -> list[Track]:
    """Read one track per ball; each shot of a list is a group. Frames in which a ball rests are missing."""
    found = parse_json(f"{name}: tailuge/billiards", text)
    faults, tracks = FaultList(name), []
    notes = () if calibration.scale else (NOTE,)
    shots = found if isinstance(found, list) else [found]
    for number, shot in enumerate(shots):
        where = f"tailuge/billiards: shot {number}"
        try:
            balls = [(f"ball {key}", _rows(rows, "txy", f"{where}: ball {key}", faults))
                     for key, rows in _samples(shot).items()]  # fmt: skip
        except UNREADABLE as error:
            wanted = f"balls, each with t, x and y, or truth with ball, t, x and y; missing or no number: {error}"
            faults.add(where, wanted)
            continue
        group = f"shot {shot.get('id', number)}" if len(shots) > 1 else ""
        for ball, rows in balls:
            place = _placed(rows[:, 1], rows[:, 2], calibration, False, TAILUGE)
            tracks.append(Track(ball, rows[:, 0], place, group=group, moving_only=True, notes=notes))
    faults.raise_if_any()
    return tracks


def _samples(shot: Any) -> dict[str, list[tuple[Any, Any, Any]]]:
    """Return the rows t, x, y of each ball of a shot."""
    if "truth" in shot:
        found: dict[str, list[tuple[Any, Any, Any]]] = {}
        for row in shot["truth"]:
            found.setdefault(str(row["ball"]), []).append((row["t"], row["x"], row["y"]))
        return found
    return {
        str(key): list(zip(one["t"], one["x"], one["y"], strict=True)) for key, one in shot["balls"].items()
    }  # fmt: skip
