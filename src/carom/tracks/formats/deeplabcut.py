"""DeepLabCut: three header rows (scorer, bodyparts, coords; four with individuals), pixels, a likelihood for each position."""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np

from carom.errors import CaromError
from carom.tracks.formats.tables import IN_PIXELS, Calibration, require_calibration, split_rows
from carom.tracks.track import Track

PROGRAM = "DeepLabCut"
IMAGE = re.compile(r"^labeled-data|\.(png|jpe?g|bmp|tiff?)$", re.IGNORECASE)


def matches(text: str) -> bool:
    """Return whether the first cell is ``scorer``."""
    return text.lstrip()[:7].lower() == "scorer,"


def read(name: str, text: str, calibration: Calibration) -> list[Track]:
    """Read one track per body part; positions with a low likelihood are missing."""
    require_calibration(name, PROGRAM, calibration, **IN_PIXELS)
    table = split_rows(name, text, ",")
    titles: dict[str, list[str]] = {}
    first = 0
    while first < len(table.rows) and table.rows[first][0].strip() in ("scorer", "individuals", "bodyparts", "coords"):
        titles[table.rows[first][0].strip()] = [cell.strip() for cell in table.rows[first]]
        first += 1
    if "bodyparts" not in titles or "coords" not in titles:
        raise CaromError(
            f"{name}: {PROGRAM}: expected rows bodyparts and coords under scorer, got {', '.join(titles) or 'none'}"
        )
    if first < len(table.rows) and any(IMAGE.search(cell.strip()) for cell in table.rows[first][:3]):
        raise CaromError(
            f"{name}: {PROGRAM}: expected the positions in all frames of a film, which analyze_videos writes, got labels of single"
            f" images ({table.rows[first][0].strip()[:40]!r} ...), as in machinelabels and CollectedData files; export the analysed"
            " film as CSV"
        )
    parts: dict[str, dict[str, int]] = {}
    for i in range(1, min(map(len, titles.values()))):
        label = " ".join(titles[row][i] for row in ("individuals", "bodyparts") if row in titles)
        parts.setdefault(label, {})[titles["coords"][i]] = i
    frame = table.column(0, first, "frame")
    sign = np.array([1.0, -1.0 if calibration.down in (None, True) else 1.0])
    tracks = []
    for label, columns in parts.items():
        if not {"x", "y"} <= set(columns):
            table.faults.add(f"{PROGRAM}: {label}", "coords x and y", ", ".join(columns))
            continue
        place = np.stack([table.column(columns[axis], first, f"{label} {axis}") for axis in "xy"], axis=-1)
        notes: tuple[str, ...] = ()
        if "likelihood" in columns:
            doubtful = ~(table.column(columns["likelihood"], first, f"{label} likelihood") >= calibration.likelihood)
            place[doubtful] = np.nan
            notes = (
                (
                    f"{label}: {doubtful.sum():,} positions with a likelihood below {calibration.likelihood:g} were omitted",
                )
                if doubtful.any()
                else ()
            )
        tracks.append(
            Track(
                label,
                frame / (calibration.rate or 1.0),
                place * sign * (calibration.scale or 1.0),
                frame=frame,
                notes=notes,
            )
        )
    table.raise_faults()
    headed = [" ".join(filter(None, cells)) for cells in zip(*titles.values(), strict=False)]
    return [replace(track, notes=(*track.notes, *table.unused(headed, first))) for track in tracks]
