"""Data frames of trackpy, saved as CSV: pixels, the second axis down, frame numbers and no time."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from carom.tracks.formats.sheet import Given, ask, sheet
from carom.tracks.track import Track

__all__ = ["matches", "read"]

PROGRAM = "trackpy"


def matches(text: str) -> bool:
    """Columns x, y and frame, and one that only trackpy has."""
    rows = sheet("", text[:4000]).rows[:1]
    names = {cell.strip() for cell in rows[0]} if rows else set()
    return {"x", "y", "frame"} <= names and bool({"particle", "mass", "ecc", "raw_mass", "signal"} & names)


def read(name: str, text: str, given: Given) -> list[Track]:
    """One track a particle."""
    ask(name, PROGRAM, given, scale="since its places are pixels", rate="since it has frames and no time")
    table = sheet(name, text)
    header = [cell.strip() for cell in table.rows[0]]
    x, y, frame = (table.column(header.index(one), 1, one) for one in ("x", "y", "frame"))
    particle = table.column(header.index("particle"), 1, "particle") if "particle" in header else np.zeros(len(x))
    table.done()
    order = np.lexsort((frame, particle))
    edges = np.flatnonzero(np.diff(particle[order], prepend=np.nan, append=np.nan) != 0)
    sign = -1.0 if given.down in (None, True) else 1.0
    scale, rate = given.scale or 1.0, given.rate or 1.0
    tracks = []
    for low, high in pairwise(edges.tolist()):
        rows = order[low:high]
        place = scale * np.stack([x[rows], sign * y[rows]], axis=-1)
        tracks.append(Track(f"particle {particle[rows[0]]:.0f}", frame[rows] / rate, place))
    return tracks
