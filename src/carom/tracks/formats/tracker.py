"""Tracker (Open Source Physics): one track, or several side by side; lengths as calibrated (m), the second axis up."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np

from carom.core.units import UNITS, unit_named
from carom.data.headers import BRACKETS
from carom.errors import CaromError
from carom.tracks.formats.tables import Calibration, TextTable, first_rows, require_calibration, split_rows
from carom.tracks.track import Track

PROGRAM = "Tracker"


def matches(text: str) -> bool:
    """Return whether the text has a ``#multi:`` line, or a line with only names of tracks before the header t, x, y."""
    if text.lstrip().lower().startswith("#multi"):
        return True
    rows = first_rows(text, 2)
    if len(rows) < 2:
        return False
    names = [_name_and_unit(cell)[0] for cell in rows[1]]
    titles = [cell.strip() for cell in rows[0] if cell.strip()]
    balls = max(names.count("x"), names.count("pixelx"))
    return (
        "t" in names
        and 1 <= len(titles) <= balls
        and not any(_name_and_unit(cell)[0] in ("t", "x", "y") for cell in titles)
    )


def read(name: str, text: str, calibration: Calibration) -> list[Track]:
    """Read the tracks of a file: the columns t, x, y (or pixelx, pixely, with a scale), and frame."""
    first, _end, rest = text.lstrip().partition("\n")
    multi = first.lower().startswith("#multi")
    table = split_rows(name, rest if multi else text.lstrip())
    above = text[: len(text) - len(text.lstrip())].count("\n") + multi
    table.lines = [n + above for n in table.lines]
    if len(table.rows) < 3:
        raise CaromError(f"{name}: {PROGRAM}: expected a row of names, a header and rows, got {len(table.rows)} rows")
    titles, (header, units) = table.rows[0], zip(*map(_name_and_unit, table.rows[1]), strict=True)
    if "t" not in header:
        raise CaromError(
            f"{name}: {PROGRAM}: expected a column t, got {', '.join(filter(None, header))}; export it with the time"
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
        tracks.append(_one(table, title, time, columns, units, calibration))
    frame = _frames(table, header)
    table.raise_faults()
    table.used |= {i for i, cell in enumerate(header) if cell == "t"}  # (each of several tracks may have it)
    notes = tuple(table.unused(table.rows[1], 2))
    return [replace(track, frame=frame, notes=(*track.notes, *notes)) for track in tracks]


def _name_and_unit(cell: str) -> tuple[str, str]:
    """Return the name of a column, in lower case, and its unit if the header has one in brackets, as in ``x (cm)``."""
    found = BRACKETS.match(cell.strip())
    return (found[1].strip().lower(), found[2].strip()) if found else (cell.strip().lower(), "")


def _in_si(table: TextTable, i: int, label: str, units: Sequence[str], dimension: str) -> np.ndarray:
    """Return a column as numbers (n,) in SI units; a unit that is not known is a fault."""
    values = table.column(i, 2, label)
    unit = unit_named(units[i], dimension) if units[i] else None
    if unit is None and units[i]:
        table.faults.add(f"column {label}", f"a unit, one of {', '.join(UNITS[dimension])}", repr(units[i]))
    return values if unit is None else np.asarray(unit.to_si(values))


def _frames(table: TextTable, header: Sequence[str]) -> np.ndarray | None:
    """Return the frame numbers (n,): each track has them for its own rows; None without such a column."""
    columns = [table.column(i, 2, "frame") for i, cell in enumerate(header) if cell == "frame"]
    return np.fmax.reduce(columns) if columns else None


def _one(
    table: TextTable, title: str, time: np.ndarray, columns: dict[str, int], units: Sequence[str], calibration: Calibration
) -> Track:  # fmt: skip
    pixels = not {"x", "y"} <= set(columns)
    names = ("pixelx", "pixely") if pixels else ("x", "y")
    if not set(names) <= set(columns):
        raise CaromError(
            f"{table.name}: {PROGRAM}: track {title!r}: expected columns x and y, got"
            f" {', '.join(filter(None, columns)) or 'none'}"
        )
    if pixels:
        require_calibration(table.name, PROGRAM, calibration, scale="since the track is in pixels")
    known = calibration.scale is None and not pixels
    x, y = (
        _in_si(table, columns[one], one, units, "length") if known else table.column(columns[one], 2, one)
        for one in names
    )
    scale = calibration.scale if calibration.scale is not None else 1.0
    down = calibration.down if calibration.down is not None else pixels
    position = scale * np.stack([x, -y if down else y], axis=-1)
    said = known and all(units[columns[one]] for one in names)
    notes = () if calibration.scale or said else ("lengths in the units of Tracker: assumed to be m",)
    return Track(title, time, position, notes=notes)
