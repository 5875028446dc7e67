"""Kinovea: a CSV file of several points, or the older text export of trajectories; neither states the unit of length."""

from __future__ import annotations

import re
from dataclasses import replace
from itertools import pairwise

import numpy as np

from carom.errors import CaromError, FaultList
from carom.tracks.formats.tables import (
    Calibration,
    first_rows,
    numbers,
    require_calibration,
    split_rows,
    time_codes,
    time_column,
)
from carom.tracks.track import Track

PROGRAM = "Kinovea"
WHY = "since Kinovea does not write the unit in which it was calibrated (or pixels)"
COLUMN = re.compile(r"^(.*)/([XY])$", re.IGNORECASE)


def matches(text: str) -> bool:
    """Return whether the text begins with #Kinovea, or has columns such as Name/0/X."""
    if text.lstrip().startswith("#Kinovea"):
        return True
    return any(COLUMN.match(cell.strip()) for row in first_rows(text, 1) for cell in row)


def read(name: str, text: str, calibration: Calibration) -> list[Track]:
    """Read the tracks of a file; times are in seconds."""
    require_calibration(name, PROGRAM, calibration, scale=WHY)
    scale = calibration.scale or 1.0
    flip = np.array([1.0, -1.0 if calibration.down else 1.0])
    if text.lstrip().startswith("#Kinovea"):
        return _trajectories(name, text, scale * flip)
    table = split_rows(name, text)
    header = [cell.strip() for cell in table.rows[0]]
    clock = next((i for i, cell in enumerate(header) if cell.lower().startswith("time")), None)
    if clock is None:
        raise CaromError(f"{name}: {PROGRAM}: expected a column Time, got {', '.join(header)}")
    notes: list[str] = []
    time = time_column(table, clock, 1, "Time", notes)
    points: dict[str, dict[str, int]] = {}
    for i, cell in enumerate(header):
        if found := COLUMN.match(cell.strip()):
            points.setdefault(found[1], {})[found[2].upper()] = i
    tracks = []
    for point, columns in points.items():
        if set(columns) != {"X", "Y"}:
            table.faults.add(f"{PROGRAM}: {point}", "columns X and Y", f"{', '.join(columns)} only")
            continue
        position = np.stack([table.column(columns[axis], 1, f"{point}/{axis}") for axis in "XY"], axis=-1)
        tracks.append(Track(point.removesuffix("/0"), time, position * scale * flip, notes=tuple(notes)))
    table.raise_faults()
    return [replace(track, notes=(*track.notes, *table.unused(header, 1))) for track in tracks]


def _trajectories(name: str, text: str, scale: np.ndarray) -> list[Track]:
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
        title = label or (f"track {index}" if len(blocks) > 1 else PROGRAM)
        lines = [number for number, _words in rows]
        cells = [[words[i] if i < len(words) else "" for _n, words in rows] for i in range(3)]
        notes: list[str] = []
        time = time_codes(cells[0], notes)
        columns = [
            numbers(some, True, lines.__getitem__, f"{title}: {axis}", faults)
            for axis, some in zip("TXY", cells, strict=True)
            if time is None or axis != "T"
        ]
        time, places = (columns[0], columns[1:]) if time is None else (time, columns)
        tracks.append(Track(title, time, np.stack(places, axis=-1) * scale, notes=tuple(notes)))
    faults.raise_if_any()
    return tracks


def _where_times_begin_anew(rows: list[tuple[int, list[str]]]) -> list[list[tuple[int, list[str]]]]:
    """Return the rows of a block in parts: a time that comes again begins the first row of another track."""
    starts = [k for k, (_n, words) in enumerate(rows) if k == 0 or words[0] == rows[0][1][0]]
    spaced = len(starts) > 1 and min(np.diff(starts)) > 1
    edges = [*(starts if spaced else starts[:1]), len(rows)]
    return [rows[low:high] for low, high in pairwise(edges)]
