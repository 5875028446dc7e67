"""From a file to tracks: which program wrote it, what it says, what is wrong with it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from carom.checks import nearest
from carom.errors import CaromError
from carom.files import path_of
from carom.tracks.formats import carom_table, columns, deeplabcut, kinovea, tracker, trackpy
from carom.tracks.formats.sheet import Given, decoded
from carom.tracks.track import Track

__all__ = ["FORMATS", "Format", "TrackFile", "read_tracks"]

SHORT = 9  # places: fewer hold no contact
JUMP = 30.0  # usual steps: no ball goes so far at once


@dataclass(frozen=True)
class Format:
    """A program's files: whether a text is one, and its tracks."""

    title: str
    matches: Callable[[str], bool]
    read: Callable[[str, str, Given], list[Track]]


# Asked in this order; the last takes what has columns x and y.
FORMATS = {
    "tracker": Format("Tracker (Open Source Physics)", tracker.matches, tracker.read),
    "kinovea": Format("Kinovea", kinovea.matches, kinovea.read),
    "deeplabcut": Format("DeepLabCut", deeplabcut.matches, deeplabcut.read),
    "carom-table": Format("carom table (JSON)", carom_table.matches, carom_table.read),
    "trackpy": Format("trackpy data frame", trackpy.matches, trackpy.read),
    "columns": Format("named columns", columns.matches, columns.read),
}


@dataclass(frozen=True, eq=False)
class TrackFile:
    """The tracks of a file, and what was understood."""

    path: Path
    format: str
    tracks: tuple[Track, ...]
    notes: tuple[str, ...]


def read_tracks(path: str | Path, format: str | None = None, given: Given | None = None) -> TrackFile:  # noqa: A002
    """Tracks of a file that a tracking program wrote, SI.

    The format shows in the content; ``format`` (a key of FORMATS) overrules. ``given`` has what the file lacks: a scale, a
    frame rate. Raises CaromError, a line a fault: a file of no known format, cells that are no numbers, a time that runs
    backwards, and by name what is missing.
    """
    path, given = path_of("read_tracks", path), given or Given()
    _check(given)
    if path.is_dir():
        raise CaromError(f"{path}: expected a track file, got a folder")
    if format is not None and format not in FORMATS:
        raise CaromError(
            f"--format: expected one of {', '.join(FORMATS)}, got {format!r}; {nearest(format, list(FORMATS))}"
        )
    text = decoded(path)
    if not text.strip():
        raise CaromError(f"{path}: expected a track, got an empty file")
    name = format or next((name for name, one in FORMATS.items() if one.matches(text)), None)
    if name is None:
        first = text.strip().splitlines()[0][:60]
        raise CaromError(
            f"{path}: expected a track of {', '.join(FORMATS)}, got a file that begins {first!r}; a table with columns t, x"
            " and y can always be read, or name the format with --format"
        )
    tracks = FORMATS[name].read(str(path), text, given)
    if not tracks or not any(track.seen.any() for track in tracks):
        raise CaromError(f"{path}: {FORMATS[name].title}: expected places of a ball, got none")
    notes: list[str] = []
    faults: list[str] = []
    checked = [_in_order(track, str(path), notes, faults) for track in tracks]
    if faults:
        raise CaromError(*faults)
    checked = [track for track in checked if track.seen.any()]
    for track in checked:
        notes += [note for note in track.notes if note not in notes]
    _look(checked, notes)
    return TrackFile(path, name, tuple(checked), tuple(notes))


def _check(given: Given) -> None:
    faults = [
        f"--{name}: expected a number above 0, got {value!r}"
        for name, value in (("scale", given.scale), ("rate", given.rate))
        if value is not None and not 0 < value < np.inf
    ]
    if faults:
        raise CaromError(*faults)


def _in_order(track: Track, path: str, notes: list[str], faults: list[str]) -> Track:
    """A track whose time grows: rows of one time are one row, a time that runs backwards is a fault."""
    label = " ".join(filter(None, (track.group, track.name)))
    known: NDArray[np.bool_] = np.isfinite(track.time)
    if (~known & np.isfinite(track.position).any(axis=1)).any():
        notes.append(f"{label}: {(~known).sum():,} rows without a time left out")
    track = track.pick(known)
    step = np.diff(track.time)
    if (step < 0).any():
        i = int(np.flatnonzero(step < 0)[0])
        faults.append(
            f"{path}: {label}: time: expected one that grows, got {track.time[i + 1]:g} s after {track.time[i]:g} s, at its row"
            f" {i + 2} ({(step < 0).sum()} in all); sort the rows, or give each ball and shot a name in columns 'ball', 'shot'"
        )
        return track
    if (step == 0).any():
        again = np.concatenate([[False], step == 0])
        moved = np.abs(np.diff(track.position, axis=0)).max(axis=1) > 0
        if (moved & (step == 0)).any():
            notes.append(
                f"{label}: {again.sum()} rows have the time of the row before, in another place: the first is taken"
            )
        track = track.pick(~again)
    return replace(track, position=np.ascontiguousarray(track.position))


def _look(tracks: list[Track], notes: list[str]) -> None:
    """What looks like a wrong unit, several units in one file, or a ball that was lost and found elsewhere."""
    size = max(float(np.ptp(track.position[track.seen], axis=0).max()) for track in tracks)
    if size == 0:
        notes.append("the ball does not move: all its places are the same")
    elif not 5e-3 < size < 100:
        notes.append(f"the tracks span {size:.3g} m: is that the unit? --scale sets it, m to one unit of the file")
        spans = np.array([np.ptp(track.position[track.seen], axis=0) for track in tracks]).max(axis=0)
        if spans.max() > 100 * spans.min() > 0:
            notes.append(
                f"the axes span {' and '.join(f'{x:.3g}' for x in spans)} m: are both columns in the same unit?"
            )
    steps = np.concatenate([np.diff(track.time) for track in tracks])
    if len(steps) and not 1e-5 < float(np.median(steps)) < 0.5:
        notes.append(
            f"a frame every {np.median(steps):.3g} s: is that the unit? write it in the header, as in 't [ms]'"
        )
    most = max(int(track.seen.sum()) for track in tracks)
    if most < SHORT:
        notes.append(f"{most} places: too few for a contact, which takes 4 before and 5 after; film longer")
    for track in tracks:
        notes += _jumps(track)


def _jumps(track: Track) -> list[str]:
    """Rows in which the ball is suddenly elsewhere, farther off than it goes in all its usual steps together."""
    seen = track.pick(track.seen)
    if len(seen) < SHORT:
        return []
    step = np.hypot(*np.diff(seen.position[:, :2], axis=0).T)
    usual = float(np.median(step))
    label = " ".join(filter(None, (track.group, track.name)))
    if float(np.median(np.hypot(*(seen.position[2:, :2] - seen.position[:-2, :2]).T))) < 0.1 * usual:
        return [f"{label}: the places go to and fro from row to row: are there rows in two units, or of two balls?"]
    far = np.flatnonzero(
        (step > JUMP * usual) & (step > 0.05) & (np.diff(seen.time) < 3 * np.median(np.diff(seen.time)))
    )
    if not len(far) or usual == 0:
        return []
    at = seen.time[far[0] + 1]
    return [
        f"{label}: {len(far)} times the ball is suddenly {step[far].max():.3g} m away, first at t = {at:.6g} s; its usual step"
        f" is {usual:.2g} m: are there rows in another unit, or was another thing tracked? mend or delete these rows"
    ]
