"""TrackMate (Fiji): a table of spots as CSV, with up to three more header rows and units in the last; the second axis down."""

from __future__ import annotations

import re

import numpy as np
from numpy.typing import NDArray

from carom.core.units import parse_quantity
from carom.errors import CaromError
from carom.tracks.formats.tables import Calibration, TextTable, first_rows, require_calibration, split_rows
from carom.tracks.track import Track

PROGRAM = "TrackMate"
TRACK, TIME, FRAME, X, Y = "TRACK_ID", "POSITION_T", "FRAME", "POSITION_X", "POSITION_Y"
UNIT = re.compile(r"^\((.*)\)$")


def matches(text: str) -> bool:
    """Return whether there are columns TRACK_ID, POSITION_X and POSITION_Y."""
    return {TRACK, X, Y} <= {cell.strip().upper() for row in first_rows(text, 1) for cell in row}


def read(name: str, text: str, calibration: Calibration) -> list[Track]:
    """Read one track per TRACK_ID, in order of time; spots that belong to no track are left out."""
    table = split_rows(name, text)
    header = [cell.strip().upper() for cell in table.rows[0]]
    column = {title: header.index(title) for title in reversed(header)}
    missing = [title for title in (TRACK, X, Y) if title not in column]
    if TIME not in column and FRAME not in column:
        missing.append(f"{TIME} or {FRAME}")
    if missing:
        raise CaromError(
            f"{name}: {PROGRAM}: expected columns {', '.join(missing)}, got none; export all columns of the spots"
        )
    first = _first_row(table, column[X])
    track_id = table.cells(column[TRACK], first)
    spots = np.array([cell.isdecimal() for cell in track_id], bool)
    if not spots.any():
        raise CaromError(
            f"{name}: {PROGRAM}: expected spots with a TRACK_ID, got none; link the spots to tracks, and export again"
        )
    size, second = (_unit(table, column.get(title), first, si) for title, si in ((X, "m"), (TIME, "s")))
    rate_needed = TIME not in column or second is None
    require_calibration(
        name, PROGRAM, calibration, scale="since its positions are in pixels" if size is None else None,
        rate="since it has frame numbers but no times in seconds" if rate_needed else None,
    )  # fmt: skip
    x, y = (table.column(column[title], first, title) for title in (X, Y))
    frame = table.column(column[FRAME], first, FRAME) if FRAME in column else None
    time = table.column(column[TIME], first, TIME) * (second or 1.0) if not rate_needed else None
    table.raise_faults()
    if time is None:
        frame = table.column(column[TIME], first, TIME) if frame is None else frame
        time = frame / (calibration.rate or 1.0)
    scale = calibration.scale if calibration.scale is not None else size or 1.0
    place = scale * np.stack([x, y if calibration.down is False else -y], axis=-1)
    lost = int((~spots).sum())
    notes: tuple[str, ...] = (f"{lost:,} spots that belong to no track were left out",) if lost else ()
    notes += tuple(table.unused(table.rows[0], first))
    return [
        _one(number, np.flatnonzero(spots & (np.array(track_id) == number)), time, place, frame, notes)
        for number in sorted({cell for cell, good in zip(track_id, spots, strict=True) if good}, key=int)
    ]


def _one(
    number: str, rows: NDArray[np.intp], time: NDArray[np.float64], place: NDArray[np.float64],
    frame: NDArray[np.float64] | None, notes: tuple[str, ...],
) -> Track:  # fmt: skip
    rows = rows[np.argsort(time[rows], kind="stable")]
    return Track(f"track {number}", time[rows], place[rows], frame=None if frame is None else frame[rows], notes=notes)


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
