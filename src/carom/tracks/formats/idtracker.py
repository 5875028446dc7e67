"""idTracker and idtracker.ai: X1, Y1, X2, Y2 ... side by side, a row per frame; pixels, the second axis down."""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np

from carom.errors import CaromError
from carom.tracks.formats.tables import Calibration, first_rows, require_calibration, split_rows
from carom.tracks.track import Track

PROGRAM = "idTracker"
COLUMN = re.compile(r"^(X|Y)(\d+)$", re.IGNORECASE)
CLOCK = ("time", "seconds")


def matches(text: str) -> bool:
    """Return whether the first row begins with X1, Y1 (idTracker), or with time, x1, y1 (idtracker.ai)."""
    header = [cell.strip().lower() for row in first_rows(text, 1) for cell in row]
    return header[:2] == ["x1", "y1"] or (header[1:3] == ["x1", "y1"] and header[0] in CLOCK)


def read(name: str, text: str, calibration: Calibration) -> list[Track]:
    """Read one track per animal, without the probabilities. Rows are numbered from 0."""
    table = split_rows(name, text)
    header = [cell.strip() for cell in table.rows[0]]
    clock = next((i for i, cell in enumerate(header) if cell.lower() in CLOCK), None)
    require_calibration(
        name,
        PROGRAM,
        calibration,
        scale="since its positions are in pixels",
        rate="since it has no times" if clock is None else None,
    )
    frame = np.arange(len(table.rows) - 1, dtype=float)
    time = frame / (calibration.rate or 1.0) if clock is None else table.column(clock, 1, header[clock])
    columns: dict[str, dict[str, int]] = {}
    for i, cell in enumerate(header):
        if found := COLUMN.match(cell):
            columns.setdefault(found[2], {})[found[1].upper()] = i
    scale, sign = calibration.scale or 1.0, 1.0 if calibration.down is False else -1.0
    tracks = []
    for number, places in columns.items():
        if set(places) != {"X", "Y"}:
            raise CaromError(
                f"{name}: {PROGRAM}: {number}: expected columns X{number} and Y{number}, got {', '.join(places)} only"
            )
        x, y = (table.column(places[axis], 1, f"{axis}{number}") for axis in "XY")
        tracks.append(Track(number, time, scale * np.stack([x, sign * y], axis=-1), frame=frame))
    table.raise_faults()
    return [replace(track, notes=tuple(table.unused(header, 1))) for track in tracks]
