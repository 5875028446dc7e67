"""Frames without a ball, as programs mark them: places such as -1, -1, a column of visibility, or a low likelihood."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from carom.formatting import counted
from carom.tracks.track import Track

Array = NDArray[np.float64]
MARKERS = (-1.0, 0.0, -999.0, -9999.0, 9999.0, -99.0)  # in both columns
FAR = 8.0  # usual steps, by which a marker lies off the places before and after it


def without_markers(place: Array, label: str, notes: list[str]) -> Array:
    """Return places (n, 2), in the file's numbers, with NaN where both are a marker far from the ball; add a note.

    A ball may lie at 0, 0: such a row counts as a place if the ball comes from there, or goes there.
    """
    found = place.copy()
    for marker in MARKERS:
        marked = (found[:, :2] == marker).all(axis=1)
        seen = np.flatnonzero(np.isfinite(found[:, :2]).all(axis=1) & ~marked)
        if not marked.any() or len(seen) < 2:
            continue
        steps = np.linalg.norm(np.diff(found[seen, :2], axis=0), axis=1) / np.diff(seen)
        least = FAR * float(np.median(steps)) if steps.any() else 0.0
        rows = np.flatnonzero(marked)
        at = np.searchsorted(seen, rows)
        away = [
            np.linalg.norm(found[seen[np.clip(side, 0, len(seen) - 1)], :2] - marker, axis=1) for side in (at - 1, at)
        ]
        far = np.asarray(np.minimum(*away)) > least
        gone = rows if far.mean() > 0.5 else rows[far]  # (a ball may pass by the place of a marker)
        if len(gone):
            found[gone] = np.nan
            notes.append(f"{label}{marker:g}, {marker:g} in {counted(len(gone), 'frame')}: taken as missing")
    return found


def without_marked_places(track: Track, scale: float) -> Track:
    """Return a track without places that were markers in the file, whose unit is ``scale``, m, and with a note on them."""
    notes: list[str] = []
    with np.errstate(over="ignore"):  # (a place beyond all lengths is refused later, with its row)
        raw = np.round(track.position / scale, 9)
    for sign in (1.0, -1.0):  # (the second axis may have been turned over)
        raw[:, 1] *= sign
        raw = without_markers(raw, f"{track.name}: ", notes)
        raw[:, 1] *= sign
    if not notes:
        return track
    seen = np.asarray(np.isfinite(raw).all(axis=1))
    place = np.where(seen[:, None], track.position, np.nan)
    return replace(track, position=place, notes=(*track.notes, *notes))


def without_invisible(place: Array, visible: Array, label: str, notes: list[str]) -> Array:
    """Return places (n, 2) with NaN where a column of visibility (n,) is 0; add a note."""
    gone = (visible == 0) & np.isfinite(place).any(axis=1)
    if gone.any():
        notes.append(f"{label}not visible in {counted(int(gone.sum()), 'frame')}: taken as missing")
    return np.where(gone[:, None], np.nan, place)
