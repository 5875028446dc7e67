"""MTrack2 (ImageJ): Frame, then X, Y and Flag of each object; pixels, the second axis down, frame numbers and no time."""

from __future__ import annotations

import re

import numpy as np

from carom.errors import CaromError
from carom.tracks.formats.text_table import IN_PIXELS, Calibration, first_rows, require_calibration, split_rows
from carom.tracks.track import Track

__all__ = ["matches", "read"]

PROGRAM = "MTrack2"
COLUMN = re.compile(r"^(X|Y|Flag)(\d+)$")
BLOCK = re.compile(r"^Tracks \d+ to \d+")
SUMMARY = re.compile(r"^Track\b")


def matches(text: str) -> bool:
    """Return whether the first row, or the one below "Tracks 1 to 75", begins with Frame, X1, Y1."""
    return any([cell.strip() for cell in row[:3]] == ["Frame", "X1", "Y1"] for row in first_rows(text, 2))


def read(name: str, text: str, calibration: Calibration) -> list[Track]:
    """Read one track per object; objects beyond the 75th are in blocks of their own, one below the other."""
    require_calibration(name, PROGRAM, calibration, **IN_PIXELS)
    table = split_rows(name, text, "\t" if "\t" in text else None)
    starts = [i for i, row in enumerate(table.rows) if row[0].strip() == "Frame"]
    tracks: list[Track] = []
    scale, rate = calibration.scale or 1.0, calibration.rate or 1.0
    sign = 1.0 if calibration.down is False else -1.0
    for start in starts:
        header = [cell.strip() for cell in table.rows[start]]
        end = next((i for i in range(start + 1, len(table.rows)) if _ends(table.rows[i][0])), len(table.rows))
        block = table.between(start + 1, end)
        frame = block.column(0, 0, "Frame")
        objects = {found[2]: i for i, cell in enumerate(header) if (found := COLUMN.match(cell)) and found[1] == "X"}
        for number, i in objects.items():
            if header[i + 1 : i + 2] != [f"Y{number}"]:
                raise CaromError(f"{name}: {PROGRAM}: expected a column Y{number} beside X{number}, got none")
            x, y = block.column(i, 0, f"X{number}"), block.column(i + 1, 0, f"Y{number}")
            tracks.append(
                Track(f"object {number}", frame / rate, scale * np.stack([x, sign * y], axis=-1), frame=frame)
            )
        table.faults += block.faults
    table.raise_faults()
    return tracks


def _ends(cell: str) -> bool:
    """Return whether a block of rows ends at the row that begins with this cell."""
    return cell.strip() == "Frame" or bool(BLOCK.match(cell.strip()) or SUMMARY.match(cell.strip()))
