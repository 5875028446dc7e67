"""Frame numbers of the rows of a track, and times from a frame rate that is given: it overrides the times of the file."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from carom.errors import CaromError
from carom.tracks.frame_clock import (
    OFF_CLOCK,
    even_interval,
    file_interval,
    frame_count,
    repeated_rows,
    rounding_of_times,
)
from carom.tracks.preprocess import MIN_INTERVAL_S
from carom.tracks.track import Track

__all__ = ["at_rate", "without_rounding"]

Array = NDArray[np.float64]
SAME_RATE = 2e-4  # relative difference of two frame rates that is not reported
MIN_ROWS = 20  # fewer do not show a clock behind times that repeat
MIN_REPEATED = 0.02  # share of rows with the time of the row before, by which rounding is recognised


def at_rate(tracks: Sequence[Track], rate: float, name: str, notes: list[str]) -> list[Track]:
    """Return the tracks with the times of frames taken at ``rate``; add a note where the times of the file differ.

    The frame of a row is its frame number, if the file has one; else its time over the interval of the file's own clock, so that
    frames without a row stay missing. Times have to be sorted.

    Raises CaromError if the times are on no clock, so that the frames cannot be counted.
    """
    return _by_group(tracks, lambda group: _group_at_rate(group, rate, name, notes))


def without_rounding(tracks: Sequence[Track], notes: list[str]) -> list[Track]:
    """Return the tracks with even times where the file's times are rounded so far that rows share one; add a note.

    The rows are taken for successive frames if the times, with the rounding that they show, allow it: one clock per group.
    """

    def even(group: list[Track]) -> list[Track]:
        longest = max(group, key=len)
        interval = _interval_behind_rounding(longest.time)
        if interval is None:
            return group
        notes.append(
            f"times are rounded to {1e3 * rounding_of_times(longest.time).max():g} ms, so that rows share one: taken as successive"
            f" frames, one every {1e3 * interval:.4g} ms (`rate` gives the true frame rate)"
        )
        return _group_at_rate(group, 1 / interval, "", [])

    return _by_group(tracks, even)


def _by_group(tracks: Sequence[Track], change: Callable[[list[Track]], list[Track]]) -> list[Track]:
    found = list(tracks)
    for name in dict.fromkeys(track.group for track in tracks):
        members = [i for i, track in enumerate(tracks) if track.group == name and len(track)]
        for i, track in zip(members, change([tracks[i] for i in members]) if members else [], strict=True):
            found[i] = track
    return found


def _group_at_rate(tracks: Sequence[Track], rate: float, name: str, notes: list[str]) -> list[Track]:
    """Return tracks that were filmed together, none of them empty, with the times of frames taken at ``rate``."""
    longest = max(tracks, key=len)
    zero = min(float(track.time[0]) for track in tracks)
    written = [track.frame for track in tracks if _frames_increase(track)]
    if len(written) == len(tracks):
        first = min(float(frame[0]) for frame in written if frame is not None)
        numbers = [np.asarray(frame) - first for frame in written]
        interval = _interval_by_frames(longest)
    else:
        known = file_interval(longest.time, rate)
        if known is None:
            raise CaromError(
                f"{name}: `rate`: expected times of evenly spaced frames, or none, got times on no clock (first"
                f" {', '.join(f'{t:g}' for t in longest.time[:4])} s); leave `rate` out, or the column of times"
            )
        interval = known
        counted = [_frames(track.time, interval, zero) for track in tracks]
        # (None: rows between the frames of an even clock)
        numbers = [(track.time - zero) / interval if number is None else number
                   for track, number in zip(tracks, counted, strict=True)]  # fmt: skip
    begin = zero / (interval * rate)
    found = [replace(track, time=begin + number / rate) for track, number in zip(tracks, numbers, strict=True)]
    moved = max(float(np.abs(new.time - old.time).max()) for new, old in zip(found, tracks, strict=True))
    _compare(interval, longest, rate, moved * rate > OFF_CLOCK / 2, notes)
    return found


def _frames_increase(track: Track) -> bool:
    """Return whether the file has a frame number for each row, and they increase with the time."""
    if track.frame is None or not np.isfinite(track.frame).all():
        return False
    return bool((np.diff(track.frame)[np.diff(track.time) > 0] > 0).all() and (np.diff(track.frame) >= 0).all())


def _frames(time: Array, interval: float, zero: float) -> Array | None:
    """Return the frames (n,) of rows from ``zero`` on: successive ones if the times are even, and of this interval."""
    step = rounding_of_times(time)
    kept = ~repeated_rows(time, step)
    even = even_interval(time[kept], step[kept]) if len(time) >= MIN_ROWS else None
    if even == interval:
        return np.asarray(np.cumsum(kept) - 1.0 + np.round((time[0] - zero) / interval))
    return frame_count(time, step, interval, zero)[0]


def _interval_behind_rounding(time: Array) -> float | None:
    """Return the time between frames, s, if rows share times and can be successive frames; else None."""
    if len(time) < MIN_ROWS or (np.diff(time) == 0).mean() < MIN_REPEATED:
        return None
    step = rounding_of_times(time)
    interval = None if repeated_rows(time, step).any() else even_interval(time, step)
    # where rounding makes rows share a time, no time of its grid is skipped
    if interval is None or (np.diff(time)[step[1:] <= interval] == 0).any():
        return None
    coarse = step[1:] > interval
    return None if (np.diff(time)[coarse] > 1.5 * step[1:][coarse]).any() else interval


def _interval_by_frames(track: Track) -> float:
    """Return the time of the file from frame to frame, s; the time of one frame if there is only one."""
    frame = np.asarray(track.frame)
    span = float(track.time[-1] - track.time[0])
    return span / float(frame[-1] - frame[0]) if frame[-1] > frame[0] and span > MIN_INTERVAL_S else np.inf


def _compare(interval: float, track: Track, rate: float, moved: bool, notes: list[str]) -> None:
    """Add a note if the file's times differ from the times of the rate, or are rounded to much of a frame and so ``moved``."""
    step = float(rounding_of_times(track.time).max())
    span = float(track.time[-1] - track.time[0])
    note = ""
    error = 4 * step / (span * np.sqrt(len(track))) if span > MIN_INTERVAL_S else np.inf
    whole = interval == 1 and track.frame is None and (track.time == np.round(track.time)).all()
    if whole and rate != 1:
        note = f"the times are whole numbers: taken as the numbers of frames, {rate:g} per second"
    elif np.isfinite(interval) and abs(interval * rate - 1) > max(SAME_RATE, error):
        note = (
            f"the file's times say {1 / interval:.5g} frames per second; `rate` {rate:g} overrides them (leave it out if they are"
            " right)"
        )
    elif moved and step * rate > OFF_CLOCK and track.frame is None:
        note = f"the file's times are rounded to {1e3 * step:g} ms; `rate` {rate:g} replaces them, one row per frame"
    if note and note not in notes:
        notes.append(note)
