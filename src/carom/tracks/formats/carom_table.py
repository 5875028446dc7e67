"""Carom tables that record their games: JSON, positions as fractions of the table's sides, times in steps of 0.5 ms."""

from __future__ import annotations

from typing import Any

import numpy as np

from carom.errors import CaromError, FaultList
from carom.files import parse_json
from carom.tracks.formats.tables import Calibration, require_sizes
from carom.tracks.track import Track

PROGRAM = "carom table"
TICK = 5e-4
KEYS = ("DeltaT_500us", "X", "Y")
UNREADABLE = (KeyError, TypeError, ValueError, AttributeError, OverflowError)


def matches(text: str) -> bool:
    """Return whether the text is JSON with the key PathTracking."""
    return text.lstrip()[:1] == "{" and '"PathTracking"' in text[:2000]


def read(name: str, text: str, calibration: Calibration) -> list[Track]:
    """Read one track per ball. Times count from the start, or from row to row if they do not increase throughout."""
    whole = parse_json(f"{name}: {PROGRAM}", text)
    try:
        found = whole["PathTracking"]
        size = np.array([float(found["TableWidth"]), float(found["TableHeight"])]) / 1000
        sets = list(found["DataSets"])
    except UNREADABLE as error:
        message = (
            f"{name}: {PROGRAM}: expected PathTracking with DataSets, TableWidth and TableHeight (mm); missing: {error}"
        )
        raise CaromError(message) from None
    tracks, faults = [], FaultList(name)
    for number, one in enumerate(sets):
        try:
            rows = np.array([[float(row[key]) for key in KEYS] for row in one["Coords"]]).reshape(-1, 3)
        except UNREADABLE as error:
            wanted = f"Coords with DeltaT_500us, X and Y, missing or no number: {error}"
            faults.add(f"{PROGRAM}: DataSets[{number}]", wanted)
            continue
        for axis, values in enumerate(rows.T):
            require_sizes(values, f"{PROGRAM}: DataSets[{number}]: {KEYS[axis]}", faults)
        tracks.append((one.get("BallColor", number + 1), rows))
    require_sizes(size, f"{PROGRAM}: TableWidth, TableHeight", faults)
    faults.raise_if_any()
    return [_track(color, rows, size, calibration) for color, rows in tracks]


def _track(color: Any, rows: np.ndarray, size: np.ndarray, calibration: Calibration) -> Track:
    ticks = rows[:, 0]
    time = TICK * (ticks if (np.diff(ticks) > 0).all() else np.cumsum(ticks))
    place = rows[:, 1:] * size
    if calibration.down:
        place[:, 1] *= -1
    return Track(f"ball {color}", time, place, moving_only=True)
