"""MTrack2 (ImageJ): Frame, then X, Y and Flag of each object; pixels, the second axis down, frame numbers and no time."""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np

from carom.tracks.formats.tables import IN_PIXELS, Calibration, first_rows, require_calibration, split_rows
from carom.tracks.track import Track

PROGRAM = "MTrack2"
COLUMN = re.compile(r"^(X|Y|Flag)\d+$")
BLOCK = re.compile(r"^Tracks (\d+) to \d+")
SUMMARY = re.compile(r"^Track\b")


def matches(text: str) -> bool:
    """Return whether the first row, or the one below "Tracks 1 to 75", begins with Frame, X1, Y1."""
    return any([cell.strip() for cell in row[:3]] == ["Frame", "X1", "Y1"] for row in first_rows(text, 2))


def read(name: str, text: str, calibration: Calibration) -> list[Track]:
    """Read one track per object; objects beyond the 75th are in blocks of their own, one below the other.

    The row of names stands above the first block, or in each one; a block without it has the columns of the block before, as far
    as they go. A table of the lengths of tracks may follow the last one.
    """
    require_calibration(name, PROGRAM, calibration, **IN_PIXELS)
    table = split_rows(name, text, "\t" if "\t" in text else None)
    scale, rate = calibration.scale or 1.0, calibration.rate or 1.0
    sign = 1.0 if calibration.down is False else -1.0
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
            frame = some.column(0, 0, "Frame")
            width = max(map(len, some.rows))
            places = [i for i, title in enumerate(header[: width - 1]) if title.startswith("X")]
            for number, i in enumerate(places, first):
                x, y = some.column(i, 0, f"X{number}"), some.column(i + 1, 0, f"Y{number}")
                place = scale * np.stack([x, sign * y], axis=-1)
                tracks.append(Track(f"object {number}", frame / rate, place, frame=frame))
            table.faults += some.faults
        if not (block or named):
            break
        low = high + 1
        if block:
            first = int(block[1])
        else:
            header = [title.strip() for title in row]
            first = first or 1
            wrong = [(title, f"Y{title[1:]}") for title, beside in zip(header, [*header[1:], ""], strict=True)
                     if COLUMN.match(title) and title[0] == "X" and beside != f"Y{title[1:]}"]  # fmt: skip
            for title, other in wrong:
                table.faults.add(PROGRAM, f"a column {other} beside {title}", "none")
    table.raise_faults()
    return [replace(track, notes=tuple(table.unused(header, 0))) for track in tracks]
