"""Data frames of trackpy, saved as CSV: pixels, the second axis down, frame numbers and no time."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from carom.tracks.formats.tables import (
    IN_PIXELS,
    ROW_NUMBERS,
    Calibration,
    first_rows,
    numbers_rows,
    require_calibration,
    split_rows,
)
from carom.tracks.track import Track

PROGRAM = "trackpy"


def matches(text: str) -> bool:
    """Return whether there are columns x, y, frame, and one that only trackpy has."""
    names = {cell.strip() for row in first_rows(text, 1) for cell in row}
    return {"x", "y", "frame"} <= names and bool({"particle", "mass", "ecc", "raw_mass", "signal"} & names)


def read(name: str, text: str, calibration: Calibration) -> list[Track]:
    """Read one track per particle."""
    require_calibration(name, PROGRAM, calibration, **IN_PIXELS)
    table = split_rows(name, text)
    header = [cell.strip() for cell in table.rows[0]]
    x, y, frame = (table.column(header.index(one), 1, one) for one in ("x", "y", "frame"))
    particle = table.column(header.index("particle"), 1, "particle") if "particle" in header else np.zeros(len(x))
    table.raise_faults()
    notes: tuple[str, ...] = ()
    if numbers_rows([f"{one:g}" for one in particle.tolist()]):
        particle, notes = np.zeros(len(x)), (ROW_NUMBERS.format("particle"),)
    notes += tuple(table.unused(header, 1))
    order = np.lexsort((frame, particle))
    edges = np.flatnonzero(np.diff(particle[order], prepend=np.nan, append=np.nan) != 0)
    sign = -1.0 if calibration.down in (None, True) else 1.0
    scale, rate = calibration.scale or 1.0, calibration.rate or 1.0
    tracks = []
    for low, high in pairwise(edges.tolist()):
        rows = order[low:high]
        place = scale * np.stack([x[rows], sign * y[rows]], axis=-1)
        tracks.append(
            Track(f"particle {particle[rows[0]]:.0f}", frame[rows] / rate, place, frame=frame[rows], notes=notes)
        )
    return tracks
