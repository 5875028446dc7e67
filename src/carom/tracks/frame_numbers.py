"""Frame numbers of the rows of a track, and times from a frame rate that is given: it overrides the times of the file."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from carom.errors import CaromError
from carom.tracks.preprocess import MIN_INTERVAL_S, camera_clock
from carom.tracks.track import Track

__all__ = ["at_rate", "rounding_of_times", "without_rounding"]

Array = NDArray[np.float64]
MOST_DECIMALS = 7
NEIGHBOURS = 8  # rows to each side that are rounded alike
OFF_CLOCK = 0.1  # in frames: largest deviation of a time from its clock, in addition to its rounding
SAME_RATE = 2e-4  # relative difference of two frame rates that is not reported
MIN_ROWS = 20  # fewer do not show a clock behind times that repeat
MIN_REPEATED = 0.02  # share of rows with the time of the row before, by which rounding is recognised


def rounding_of_times(time: Array) -> Array:
    """Return the step (n,), s, to which the times near each row were rounded: a power of ten, at least 1e-7.

    Of fewer than nine rows none is recognised.

    Examples
    --------
    >>> import numpy as np
    >>> rounding_of_times(np.round(np.arange(20) / 119.88, 2))[:3]
    array([0.01, 0.01, 0.01])
    """
    decimals = np.full(len(time), MOST_DECIMALS)
    for d in range(MOST_DECIMALS - 1, -1, -1):
        scaled = time * 10.0**d
        decimals[np.abs(scaled - np.round(scaled)) < 1e-3] = d
    padded = np.pad(decimals, NEIGHBOURS, constant_values=MOST_DECIMALS)
    finest = np.lib.stride_tricks.sliding_window_view(padded, NEIGHBOURS + 1).max(axis=1)
    # significant digits end at another decimal from 1 s on: the coarser of the rows before and after
    coarser = np.minimum(finest[: len(time)], finest[NEIGHBOURS:])
    return np.asarray(10.0 ** -coarser.astype(float))


def at_rate(tracks: Sequence[Track], rate: float, name: str, notes: list[str]) -> list[Track]:
    """Return the tracks with the times of frames taken at ``rate``; add a note where the times of the file differ.

    The frame of a row is its frame number, if the file has one; else it is counted: rows are successive frames, with the fewest
    missing ones that the times, as they are rounded, allow. Times have to be sorted.

    Raises CaromError if the times are on no clock, so that the frames cannot be counted.
    """
    return _by_group(tracks, lambda group: _group_at_rate(group, rate, name, notes))


def without_rounding(tracks: Sequence[Track], notes: list[str]) -> list[Track]:
    """Return the tracks with even times where those of the file are rounded so far that rows share one; add a note.

    The rows are taken for successive frames if the times, with the rounding that they show, allow it: one clock per group.
    """

    def even(group: list[Track]) -> list[Track]:
        longest = max(group, key=len)
        interval = _interval_behind_rounding(longest.time)
        if interval is None:
            return group
        notes.append(
            f"times are rounded to {1e3 * rounding_of_times(longest.time).max():g} ms, so that rows share one: taken as successive"
            f" frames, one every {1e3 * interval:.4g} ms (--rate gives the true frame rate)"
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
        known = _interval_of_file(longest.time, rate, zero)
        if known is None:
            raise CaromError(
                f"{name}: --rate: expected times of evenly spaced frames, or none, got times on no clock (first"
                f" {', '.join(f'{t:g}' for t in longest.time[:4])} s); leave --rate out, or the column of times"
            )
        interval = known
        counted = [_numbers(track.time, interval, zero)[0] for track in tracks]
        # (None: rows between the frames of an even clock)
        numbers = [(track.time - zero) / interval if number is None else number
                   for track, number in zip(tracks, counted, strict=True)]  # fmt: skip
    _compare(interval, longest, rate, notes)
    begin = zero / (interval * rate)
    return [replace(track, time=begin + number / rate) for track, number in zip(tracks, numbers, strict=True)]


def _frames_increase(track: Track) -> bool:
    """Return whether the file has a frame number for each row, and they increase with the time."""
    if track.frame is None or not np.isfinite(track.frame).all():
        return False
    return bool((np.diff(track.frame)[np.diff(track.time) > 0] > 0).all() and (np.diff(track.frame) >= 0).all())


def _interval_behind_rounding(time: Array) -> float | None:
    """Return the time between frames, s, if rows share times and can be successive frames; else None."""
    if len(time) < MIN_ROWS or (np.diff(time) == 0).mean() < MIN_REPEATED:
        return None
    interval = _interval_by_rows(time)
    if not interval > MIN_INTERVAL_S:
        return None
    # where rounding makes rows share a time, no time of its grid is skipped
    step, jump = rounding_of_times(time)[1:], np.diff(time)
    coarse = step > interval
    if (jump[~coarse] == 0).any() or (jump[coarse] > 1.5 * step[coarse]).any():
        return None
    number, missing = _numbers(time, interval, float(time[0]))
    return None if number is None or missing else interval


def _interval_by_rows(time: Array) -> float:
    """Return the time from row to row, s, if each row is a frame."""
    row = np.arange(len(time)) - (len(time) - 1) / 2
    return float(row @ time / (row @ row))


def _interval_of_file(time: Array, rate: float, zero: float) -> float | None:
    """Return the time between frames, s, as the file has it: of the clock that explains its times with the fewest missing frames.

    Tried are rows in successive frames, the clock of ``rate`` and that of :func:`camera_clock`. None if there is no clock.
    """
    if len(time) < 2 or not time[-1] - time[0] > MIN_INTERVAL_S:
        return 1 / rate
    clock = camera_clock(np.unique(time))
    best: tuple[int, float] | None = None
    step = float(rounding_of_times(time).max())
    for interval in (_interval_by_rows(time), 1 / rate, clock.interval):
        # (a clock with the rounding step as interval would explain any times)
        if not MIN_INTERVAL_S < interval < np.inf or (interval == clock.interval and step > 0.5 * interval):
            continue
        number, missing = _numbers(time, interval, zero)
        if number is not None and (best is None or missing < best[0]):
            best = missing, interval
    if best is not None:
        return best[1]
    return clock.interval if clock.steady else None


def _numbers(time: Array, interval: float, zero: float) -> tuple[Array | None, int]:
    """Count frames from ``zero`` on: the numbers (n,), None if the times do not allow any; and how many frames are missing.

    Each row is the next frame unless its time, less its rounding, is later. Rows with the same time are one frame where the
    rounding is finer than a frame. If times are rounded to more than half a frame, a missing frame shows only a row or two later.
    """
    count = (time - zero) / interval
    slack = rounding_of_times(time) / (2 * interval)
    repeated = np.concatenate([[False], np.diff(time) == 0]) & (slack < 0.5)
    best = _earliest(count, slack + slack[0] + OFF_CLOCK, repeated)
    if best is None:
        return None, 0
    # once more without the rounding of the first row, which all others were counted from
    better = _earliest(count - np.median(count - best), slack + OFF_CLOCK, repeated)
    number = best if better is None else better
    return number, int(number[-1] - number[0]) + 1 - int((~repeated).sum())


def _earliest(count: Array, slack: Array, repeated: NDArray[np.bool_]) -> Array | None:
    """Return the lowest whole numbers (n,) within ``slack`` of ``count`` that increase, except where repeated; None if none do."""
    number = np.zeros(len(count))
    at = -np.inf
    for i, (least, again) in enumerate(zip(np.ceil(count - slack).tolist(), repeated.tolist(), strict=True)):
        at = at if again else max(at + 1, least)
        number[i] = at
    return None if (number > count + slack).any() else number


def _interval_by_frames(track: Track) -> float:
    """Return the time of the file from frame to frame, s; that of one frame if there is only one."""
    frame = np.asarray(track.frame)
    span = float(track.time[-1] - track.time[0])
    return span / float(frame[-1] - frame[0]) if frame[-1] > frame[0] and span > MIN_INTERVAL_S else np.inf


def _compare(interval: float, track: Track, rate: float, notes: list[str]) -> None:
    """Add a note if the file's times differ from those of the rate, or are rounded to much of a frame."""
    step = float(rounding_of_times(track.time).max())
    span = float(track.time[-1] - track.time[0])
    note = ""
    error = 4 * step / (span * np.sqrt(len(track))) if span > MIN_INTERVAL_S else np.inf
    if np.isfinite(interval) and abs(interval * rate - 1) > max(SAME_RATE, error):
        note = (
            f"the file's times say {1 / interval:.5g} frames per second; --rate {rate:g} overrides them (leave it out if they are"
            " right)"
        )
    elif step * rate > OFF_CLOCK and track.frame is None:
        note = f"the file's times are rounded to {1e3 * step:g} ms; --rate {rate:g} replaces them, one row per frame"
    if note and note not in notes:
        notes.append(note)
