"""Prepare tracks for fits: the camera's clock, rounding and noise, wrong positions, the view, confused balls.

The camera's clock behind the times of a file: the interval from frame to frame, and number and time of the frame of each row.

Times are rounded, to decimals or to significant digits, rows are missing, a program puts rows between the frames, and a slow-motion
film has the times of its playback. All readers ask here which clock the times show (:func:`camera_clock` gives each row the time of
its frame, and says which rows are none), and when the frames were taken where a frame rate is given (:func:`at_rate`,
:func:`file_interval`). A clock explains times if every row has a frame of its own, within the rounding of its time
(:func:`rounding_of_times`).
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.errors import CaromError, shortened_list
from carom.tracks.contact import View
from carom.tracks.flights import MIN_FALLING_SHARE, constant_acceleration, falling_share, falls_freely, in_a_plane
from carom.tracks.track import SAMPLED, Track, position_noise

Array = NDArray[np.float64]
MIN_INTERVAL_S = 1e-9  # between two frames: no camera is faster
SAME_RATE = 2e-4  # relative difference of two frame rates that is not reported
MIN_ROWS = 20  # fewer do not show a clock behind times that repeat
MIN_REPEATED = 0.02  # share of rows with the time of the row before, by which rounding is recognised
EXACT_TIMES = 1e-9  # in frames: times so near an even clock are its own
ROUNDED_TIMES = 2e-3  # in frames: a note says that times were rounded more coarsely
MOST_DECIMALS = 7
MOST_ROUNDED = 0.8  # share of the times that a rounding explains; the others lie between frames
FINEST = 0.99e-4  # s: finer rounding of single times is left to the scatter about the clock
COARSE = 0.5  # in frames: rounding that leaves open which steps between rows are even
MOST_LISTED = 20  # times in a note
NEIGHBOURS = 8  # rows to each side that are rounded alike
OFF_CLOCK = 0.1  # in frames: largest deviation of a time from its clock, if it is not rounded more coarsely
# Rows with so few missing ones may be even by chance, within the rounding of their times: a clock that is known is preferred.
MOST_BY_CHANCE = 3
SAME_CLOCK = 1.2e-3  # relative difference of two intervals: rates such as 120 and 119.88 are named for each other
ON_CLOCK = 0.01  # in frames: times so near the clock of a rate that is given are this clock's
MIN_NEXT = 0.3  # share of rows that are the next frame, or the film is played back at another rate
FINE_ROUNDING = 0.8  # in frames: times that are rounded so far still show their clock
PHASES = 9  # of the clock within the rounding of the first time that are tried
FIRST_ROWS = 64  # with which the search for a clock begins
MOST_NUMBERS = 4_000_000  # intervals, phases and rows at once; more intervals than that are not searched further
MOST_TRIED = 10_000_000  # intervals at once
MOST_CHECKED = 40  # of the intervals that are found, from the longest on
SHORTEST = 0.5  # share of the upper bound down to which a clock is searched


@dataclass(frozen=True, eq=False)
class CameraClock:
    """The times at which a camera took its frames."""

    interval: float
    """From frame to frame, s."""
    time: Array
    """(n,) s: on the clock if the file's times were rounded, else as they are in the file."""
    frame: NDArray[np.bool_]
    """(n,): rows that are frames; the others lie between frames, interpolated by a program."""
    rounded: float
    """Step to which the file's times were rounded, s; 0 if they are exact enough."""
    steady: bool
    """Whether the frames are evenly spaced."""


def camera_clock(time: Array) -> CameraClock:
    """Find the clock behind sorted times (n,), s, which may have gaps, duplicates, rounding, and rows between the frames.

    Returns
    -------
    CameraClock
        ``steady`` where at least 70 % of the rows are on an even clock: then ``time`` has the times of the frames, without the
        rounding of the file, and ``frame`` is False for rows between frames, and for all but one of the rows of one frame. Where no
        clock is found, the times are those of the file, and ``frame`` is True throughout.

    Examples
    --------
    >>> import numpy as np
    >>> from carom.tracks.preprocess import camera_clock
    >>> clock = camera_clock(np.round(np.delete(np.arange(60), [7, 20, 21]) / 119.88, 3))
    >>> round(1 / clock.interval, 1), clock.rounded, bool(clock.frame.all())
    (119.9, 0.001, True)
    """
    steps = np.diff(time)
    steps = steps[steps > MIN_INTERVAL_S]
    if len(steps) < 3:
        interval = float(steps.min()) if len(steps) else np.nan
        return CameraClock(interval, time, np.ones(len(time), bool), 0.0, False)
    step = rounding_of_times(time)
    missing, interval = _missing_steps(time)
    if 0 < missing <= len(time) / 2 and float(step.max()) >= COARSE * interval:
        # (rows of an exact clock that are missing regularly are as even as those of a slower one whose times are rounded)
        return CameraClock(interval, time, np.ones(len(time), bool), 0.0, True)
    if (even := _behind_rounding(time, step, np.arange(len(time), dtype=float))) is not None:
        return even
    clock, count = _commonest_clock(time, _commonest(steps))
    if clock.steady and not clock.frame.all():
        count = frame_count(time, step, clock.interval, float(time[0]))[0]
    elif not clock.steady:
        missing, interval = _slowest_clock(time, step)
        count = frame_count(time, step, interval, float(time[0]))[0] if missing < np.inf else None
        count = None if count is None or _next_share(count) < MIN_NEXT else count
    even = None if count is None else _behind_rounding(time, step, count)
    return clock if even is None else even


def _commonest_clock(time: Array, interval: float) -> tuple[CameraClock, Array | None]:
    """Return the clock on which most times (n,) are, and the frame (n,) of each; ``interval`` is about its own.

    It is followed from the longest run of even steps on, to twice as many rows each time.
    """
    every = np.ones(len(time), bool)
    step, gridded = _rounding(time)
    start = _start(time, interval, step)
    if start is None:
        return CameraClock(interval, time, every, 0.0, False), None
    zero, reach, near = float(time[start]), 2, np.zeros(len(time), bool)
    while True:
        rows = slice(max(start - reach, 0), start + reach)
        count = np.round((time[rows] - zero) / interval)
        off = time[rows] - zero - count * interval
        near = np.abs(off) < 0.08 * interval + step[rows]
        if near.sum() < 3:
            return CameraClock(interval, time, every, 0.0, False), None
        interval, zero = (float(x) for x in np.polyfit(count[near], time[rows][near], 1))
        if reach >= len(time):
            break
        reach *= 2
    count = np.round((time - zero) / interval)
    off = time - zero - count * interval
    near = np.abs(off) < 0.08 * interval + step
    if near.mean() < 0.7:
        return CameraClock(interval, time, every, 0.0, False), None
    spread = float(np.median(np.abs(off[near])))
    frame = gridded & (np.abs(off) < np.maximum(max(4 * spread, 1e-3 * interval), step))
    # of two rows in one frame the nearer to the clock
    order = np.lexsort((np.abs(off), count))
    doubled = np.zeros(len(time), bool)
    doubled[order[1:]] = count[order][1:] == count[order][:-1]
    frame &= ~doubled
    coarse = float(np.quantile(np.abs(off[near]), 0.95)) > 2 * ROUNDED_TIMES * interval
    rounded = max(float(step.max()), 4 * spread) if coarse or spread > ROUNDED_TIMES * interval else 0.0
    clock = np.where(frame, zero + count * interval, time) if rounded else time
    return CameraClock(interval, clock, frame, rounded, True), count


def _rounding(time: Array) -> tuple[Array, NDArray[np.bool_]]:
    """Return the step (n,) to which most times are rounded, s, and which (n,) are: to decimals, or to significant digits.

    Programs write a number of decimals, or of significant digits, and rows that a program put between frames have more. The step
    is 0 where it is finer than any that matters.
    """
    decimals = _decimals(time)
    size = np.floor(np.log10(np.maximum(np.abs(time), 1e-300)))
    digits = np.where(np.abs(time) > 0, np.maximum(size + 1 + decimals, 1), 1)
    usual, figures = (int(np.quantile(one, MOST_ROUNDED, method="higher")) for one in (decimals, digits))
    step = np.maximum(10.0**-usual, 10.0 ** (np.maximum(size, -MOST_DECIMALS) + 1 - figures))
    step = np.where(step < FINEST, 0.0, step)
    return step, (step == 0) | (decimals <= usual) | (digits <= figures)


def _behind_rounding(time: Array, step: Array, frame: Array) -> CameraClock | None:
    """Return the even clock whose times, rounded to ``step`` (n,), are these, if there is one; ``frame``: (n,) of each row."""
    interval = even_interval(time, step, frame, off=0.0)
    if interval is None:
        return None
    even = time.mean() + interval * (frame - frame.mean())
    off = np.abs(even - time)
    exact = off.max() < EXACT_TIMES * interval
    rounded = float(step.max()) if np.median(off) > ROUNDED_TIMES * interval else 0.0
    return CameraClock(interval, time if exact else even, np.ones(len(time), bool), rounded, True)


def times_behind_rounding(times: Sequence[Array], notes: list[str]) -> list[Array]:
    """Return the sorted times (n,), s, of each ball in a film or run, without their rounding if an even clock explains it.

    Times that are uneven by more than their rounding may be a program's own, and stay as they are; a note says so.
    """
    tracks = without_rounding([Track("", t, np.zeros((len(t), 2))) for t in times], notes)
    every = np.unique(np.concatenate([track.time for track in tracks]))
    clock = camera_clock(every)
    if clock.steady and (np.abs(clock.time - every) < rounding_of_times(every)).all():
        return [clock.time[np.searchsorted(every, track.time)] for track in tracks]
    notes.append("times are not evenly spaced: used as given")
    return [track.time for track in tracks]


def on_camera_clock(tracks: Sequence[Track], notes: list[str]) -> tuple[list[Track], float]:
    """Return the tracks with only the frames in which balls were found, on the clock of their group, and the interval, s."""
    seen = []
    intervals = []
    groups: dict[str, list[Track]] = {}
    for track in in_a_plane(tracks, notes):
        groups.setdefault(track.group, []).append(track.select(track.seen))
    off: list[str] = []
    rounded = unsteady = 0
    for members in groups.values():
        times = np.unique(np.concatenate([track.time for track in members]))
        clock = camera_clock(times)
        if all(track.stamped for track in members):  # (uneven ones are no program's)
            step = np.concatenate([np.diff(track.time) for track in members] or [np.zeros(0)])
            usual = float(np.median(step)) if len(step) else np.nan
            clock = CameraClock(usual, times, np.ones(len(times), bool), 0.0, True)
        off += [f"{t:.6g}" for t in times[~clock.frame]]
        rounded += clock.rounded > 0
        unsteady += not clock.steady
        if np.isfinite(clock.interval):
            intervals.append(clock.interval)
        seen += [_on_clock(track, times, clock) for track in members]
    interval = float(np.median(intervals)) if intervals else np.nan
    if off:
        notes.append(
            f"{len(off):,} rows lie between the camera's frames: interpolated by a program, and omitted, at"
            f" t = {shortened_list(off, MOST_LISTED)} s"
        )
    if rounded:
        notes.append(
            f"times were rounded: replaced by the times of the camera's clock, one frame every {1e3 * interval:.4g} ms"
        )
    if unsteady:
        notes.append(
            f"frames are not evenly spaced in {unsteady} of {len(groups)} files or shots: times are used as given"
        )
    return [track for track in seen if len(track)], interval


def _on_clock(track: Track, times: Array, clock: CameraClock) -> Track:
    rows = np.searchsorted(times, track.time)
    return replace(track, time=clock.time[rows]).select(clock.frame[rows])


def _commonest(steps: Array) -> float:
    """Return the smallest common step: a slow ball may have rows in every second frame only."""
    steps = np.sort(steps)
    count = np.searchsorted(steps, 1.04 * steps) - np.searchsorted(steps, 0.96 * steps)
    least = float(steps[np.flatnonzero(count >= 0.25 * count.max())[0]])
    return float(np.median(steps[np.abs(steps / least - 1) < 0.08]))


def _start(time: Array, interval: float, step: Array) -> int | None:
    """Return the middle of the longest run of steps that are even, but for a rounding that is finer than half a frame."""
    even = np.abs(np.diff(time) - interval) < 0.1 * interval + np.where(step < COARSE * interval, step, 0.0)[1:]
    edges = np.flatnonzero(np.diff(np.concatenate([[False], even, [False]]).astype(int)))
    runs = edges.reshape(-1, 2)
    if not len(runs):
        return None
    low, high = runs[np.argmax(runs[:, 1] - runs[:, 0])]
    return int(low + high) // 2 if high - low >= 3 else None


def rounding_of_times(time: Array) -> Array:
    """Return the step (n,), s, to which the times near each row were rounded: a power of ten, at least 1e-7.

    Of fewer than nine rows none is recognised.

    Examples
    --------
    >>> import numpy as np
    >>> rounding_of_times(np.round(np.arange(20) / 119.88, 2))[:3]
    array([0.01, 0.01, 0.01])
    """
    padded = np.pad(_decimals(time), NEIGHBOURS, constant_values=MOST_DECIMALS)
    finest = np.lib.stride_tricks.sliding_window_view(padded, NEIGHBOURS + 1).max(axis=1)
    # significant digits end at another decimal from 1 s on: the coarser of the rows before and after
    coarser = np.minimum(finest[: len(time)], finest[NEIGHBOURS:])
    return np.asarray(10.0 ** -coarser.astype(float))


def _decimals(time: Array) -> NDArray[np.intp]:
    """Return how many decimals (n,) times have, at most 7."""
    decimals = np.full(len(time), MOST_DECIMALS)
    for d in range(MOST_DECIMALS - 1, -1, -1):
        scaled = time * 10.0**d
        decimals[np.abs(scaled - np.round(scaled)) < 1e-3] = d
    return decimals


def repeated_rows(time: Array, step: Array) -> NDArray[np.bool_]:
    """Return which rows (n,) are of the same frame as the row before: the same time, where rounding is finer than a frame."""
    jump = np.diff(time)
    if not (jump > 0).any():
        return np.concatenate([[False], jump == 0])
    return np.concatenate([[False], (jump == 0) & (step[1:] < 0.99 * float(np.median(jump[jump > 0])))])


def file_interval(time: Array, rate: float) -> float | None:
    """Return the time from frame to frame, s, as the times (n,) of a file have it; None if they are on no clock.

    Whole numbers are frame numbers (1). Where the rate, 1/s, is not that of the times, and these show a clock of which rows
    are missing (:func:`camera_clock`), it is this one. Else rows are successive frames where their times are even within
    their rounding. Otherwise frames are missing: of the clocks that explain the times, that of ``rate`` and the slowest of
    all, the one with fewer missing frames is taken.
    """
    if len(time) < 2 or not time[-1] - time[0] > MIN_INTERVAL_S:
        return 1 / rate
    if (time == np.round(time)).all():
        return 1.0
    step = rounding_of_times(time)
    kept = ~repeated_rows(time, step)
    time, step = time[kept], step[kept]
    count = (time - time[0]) * rate
    if np.abs(count - np.round(count)).max() < ON_CLOCK and _next_share(np.round(count)) >= MIN_NEXT:
        return 1 / rate
    known, whole = _missing_frames(time, step, 1 / rate), _missing_steps(time)
    if known[0] > 0 and 0 < whole[0] < np.inf:
        clock = camera_clock(time)
        if clock.steady and clock.frame.all() and abs(clock.interval / whole[1] - 1) < SAME_CLOCK:
            return whole[1]
    even = even_interval(time, step)
    if even is None:
        return _interval_with_gaps(time, step, known, whole)
    chances = [one for one in (whole, known if abs(even * rate - 1) > SAME_CLOCK else whole) if one[0] > 0]
    fewest, interval = min(chances, default=(np.inf, 0.0))
    return interval if whole[0] > 0 and fewest <= MOST_BY_CHANCE else even


def _interval_with_gaps(
    time: Array, step: Array, known: tuple[float, float], whole: tuple[float, float]
) -> float | None:
    """Return the interval of the clock with the fewest missing frames: of the rate, of whole steps, or the slowest of all.

    ``known``, ``whole``: the number of missing frames and the interval, s, of the first two.
    """
    most = len(time) / 4
    if whole[0] <= min(most, known[0]):
        return whole[1]
    if known[0] < most and float(step.max()) < FINE_ROUNDING * known[1]:
        return known[1]
    found = _slowest_clock(time, step)
    if float(step.max()) > FINE_ROUNDING * found[1] and whole[0] < np.inf:  # (which fits many clocks)
        found = whole
    best = min(known, (found[0] + MOST_BY_CHANCE, found[1]))
    if best[0] < np.inf:
        return best[1]
    clock = camera_clock(time)
    return clock.interval if clock.steady else None


def even_interval(time: Array, step: Array, frame: Array | None = None, off: float = OFF_CLOCK) -> float | None:
    """Return the time from frame to frame, s, if rows (n,) are on an even clock, within the rounding ``step`` (n,) of their times.

    ``frame``: the frame (n,) of each row; by default each row is the next frame. ``off``: share of a frame by which times may
    deviate however finely they are rounded.
    """
    row = np.arange(len(time), dtype=float) if frame is None else frame
    row = row - row.mean()
    square = float(row @ row)
    interval = float(row @ time) / square if square > 0 else 0.0  # (one row, or rows of one frame, have no interval)
    if not interval > MIN_INTERVAL_S:
        return None
    half = np.maximum(step / 2, off * interval) * (1 + 1e-6)
    low, high = (interval + sign * 4 * half.max() / np.ptp(row) for sign in (-1, 1))
    # the strip of least height that holds all times: convex in its slope
    for _ in range(60):
        slope = (low + high) / 2
        above, below = time - half - slope * row, time + half - slope * row
        i, j = int(np.argmax(above)), int(np.argmin(below))
        if above[i] <= below[j]:
            return interval
        low, high = (slope, high) if row[i] > row[j] else (low, slope)
    return None


def frame_count(time: Array, step: Array, interval: float, zero: float) -> tuple[Array | None, int]:
    """Return the frames (n,) of rows, counted from ``zero`` on, None if the times do not allow any; and how many are missing.

    Each row is the next frame unless its time, less its rounding, is later. If times are rounded to more than half a frame, a
    missing frame shows only a row or two later.
    """
    kept = ~repeated_rows(time, step)
    half = np.maximum(step[kept] / (2 * interval), OFF_CLOCK)
    at = (time[kept] - zero) / interval
    first = half[0] * np.linspace(-1, 1, PHASES)
    for allowance in (1.0, 1.25):  # (an interval that was fitted is not exact)
        number = _earliest(at[:, None] - np.round(at[0]) - first, allowance * half[:, None] + half[0] / PHASES)
        missing = np.where(np.isfinite(number[0]), number[-1] - number[0], np.inf)
        if missing.min() < np.inf:
            break
    else:
        return None, 0
    # of the phases with the fewest missing frames the middle one
    best = np.flatnonzero(missing == missing.min())
    found = number[:, best[len(best) // 2]] + np.round(at[0])
    return found[np.cumsum(kept) - 1], int(found[-1] - found[0]) + 1 - len(found)


def _earliest(at: Array, half: Array) -> Array:
    """Return the lowest increasing whole numbers (n, m) within ``half`` of ``at`` (n, m), column by column; NaN if none are."""
    rows = np.arange(len(at))[:, None]
    number = np.maximum.accumulate(np.ceil(at - half) - rows, axis=0) + rows
    return np.where((number <= at + half).all(axis=0), number, np.nan)


def _missing_frames(time: Array, step: Array, interval: float) -> tuple[float, float]:
    """Return the number of frames without a row, and the interval, s; infinitely many if the times are not on this clock.

    Nor are they if hardly any row is the next frame: then the film is played back at another rate.
    """
    number, missing = frame_count(time, step, interval, float(time[0]))
    if number is None or _next_share(number) < MIN_NEXT:
        return np.inf, interval
    return missing, interval


def _missing_steps(time: Array) -> tuple[float, float]:
    """Return the number of rows missing between rows that are whole numbers of smallest steps apart, and that step, s."""
    smallest = float(np.diff(time).min())
    if not smallest > MIN_INTERVAL_S:
        return np.inf, smallest
    number = np.concatenate([[0.0], np.cumsum(np.round(np.diff(time) / smallest))])
    if np.abs(np.diff(time) / smallest - np.diff(number)).max() > 0.02 or _next_share(number) < MIN_NEXT:
        return np.inf, smallest
    return number[-1] - len(time) + 1, float(time[-1] - time[0]) / float(number[-1])


def _next_share(number: Array) -> float:
    """Return the share of rows (n,) that are the frame after the previous row's; 0 if a row is no later frame."""
    step = np.diff(number)
    return float((step == 1).mean()) if (step > 0).all() else 0.0


def _slowest_clock(time: Array, step: Array) -> tuple[float, float]:
    """Return the number of frames without a row, and the interval, s, of the slowest clock that explains the times."""
    jump = np.diff(time)
    smallest = float(jump[jump > 0].min())
    if not smallest > MIN_INTERVAL_S:
        return np.inf, 0.0
    half = np.maximum(step / 2, OFF_CLOCK * smallest)
    # so many rows are at least so many frames
    high = min(
        float((time[k:] - time[:-k] + half[k:] + half[:-k]).min()) / k for k in range(1, min(len(time), FIRST_ROWS))
    )
    low = max(SHORTEST * high, smallest - 2 * float(half.max()))
    if not MIN_INTERVAL_S < low < high:
        return np.inf, 0.0
    tried, count, spacing = np.array([(low + high) / 2]), 0, high - low
    while count < len(time):
        count = min(max(2 * count, FIRST_ROWS), len(time))
        some, wide = time[:count] - time[0], half[:count]
        # intervals so near each other that the last of these rows moves by an eighth of its rounding at most
        finer = max(int(np.ceil(2 * spacing * (some[-1] / low) / float(wide.min()))), 1)
        if len(tried) * finer > MOST_TRIED:
            return np.inf, 0.0
        within = spacing * ((np.arange(finer) + 0.5) / finer - 0.5)
        spacing /= finer
        tried = _fitting(some, wide, (tried[:, None] - within).ravel())[: max(MOST_NUMBERS // (PHASES * count), 4)]
        if not len(tried):
            return np.inf, 0.0
    for interval in tried[:MOST_CHECKED]:
        number, missing = frame_count(time, step, interval, float(time[0]))
        exact = None if number is None else even_interval(time, step, number)
        if exact is not None:
            return missing, exact
    return np.inf, 0.0


def _fitting(time: Array, half: Array, intervals: Array) -> Array:
    """Return the intervals with which each row (n,) may have a frame of its own, allowing for the spacing of those tried."""
    found = []
    for some in np.array_split(intervals, max(len(intervals) * len(time) * PHASES // MOST_NUMBERS, 1)):
        wide = half[:, None, None] / some[:, None]
        first = wide[0] * np.linspace(-1, 1, PHASES)
        at = time[:, None, None] / some[:, None] - first
        number = _earliest(at.reshape(len(time), -1), (1.25 * wide + wide[0] / PHASES + 0 * at).reshape(len(time), -1))
        found.append(some[np.isfinite(number[0]).reshape(len(some), -1).any(axis=1)])
    return np.concatenate(found)


# --- frame numbers, and a rate that is given ----------------------------------------------------------------------


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


# ----------------------------------------------------------------------------------------------------
# Preparation of tracks for fits: rounding and noise of positions, wrong positions, and the camera's view.


# Smallest share of the series (and at least two) that has to show the same rounding step: fast and resting balls show none.
MIN_AGREEING_SHARE = 0.1
MAX_OFF_STEP = 0.2  # of a step, by which differences of rounded positions may miss a multiple
# A position is wrong that lies so many times farther from a parabola through its six neighbours than any of them. Beside a contact
# between these frames it lies 5.3 times as far at most, beside two contacts 11 times.
OUTLYING = 12.0
AROUND = np.array([-3.0, -2.0, -1.0, 1.0, 2.0, 3.0])  # frames


def rounding_step(series: Sequence[Array]) -> float:
    """Return the step to which coordinates were rounded (a pixel, say), m: the commonest among the series; 0 if there is none.

    One camera rounds all series to the same step. A few series may show a step by chance, such as an even motion with missing
    frames; their steps differ.
    """
    steps = np.array([step for step in map(_step_of_one, series) if np.isfinite(step)])
    same = [np.abs(steps - step) < 0.05 * step for step in steps]
    most = max(same, key=np.count_nonzero, default=np.zeros(0, bool))
    return (
        float(np.median(steps[most]))
        if most.sum() >= max(MIN_AGREEING_SHARE * len(steps), min(2, len(steps)), 1)
        else 0.0
    )


def _step_of_one(x: Array) -> float:
    """Return the step of which differences of neighbouring values are multiples: the largest at which their phases agree.

    0 if there is none, NaN if there are too few values.
    """
    values = np.unique(x[np.isfinite(x)])[:20000]
    gaps = np.diff(values)
    gaps = gaps[gaps > 1e-6 * (values[-1] - values[0])] if len(values) else gaps
    if len(gaps) < 20:
        return np.nan
    # rounding to decimal places leaves gaps of 1 next to gaps of 10: steps far below the usual gap are not pixels
    whole = np.sort(gaps)
    gaps = whole[: max(len(gaps) // 2, 20)][:1000]
    most = float(gaps[-1])
    least = max(float(gaps[len(gaps) // 20]) / 1.5, most / 60)
    per = np.arange(1 / (1.1 * most), 1 / least, 1 / (12 * most))
    agree = np.array([np.cos(2 * np.pi * gaps * f).mean() for f in per])
    best = float(agree.max())
    if best < 0.6:
        return 0.0
    first = int(np.flatnonzero(agree > 0.85 * best)[0])
    peak = first + int(np.argmax(agree[first : first + 8]))
    step = float(1 / per[peak])
    count = np.round(gaps / step)
    good = (count > 0) & (np.abs(gaps / step - count) < 0.2)
    # an even motion has even gaps too: if no position repeats, many gaps of several sizes have to fit
    again = len(values) < 0.8 * len(x)
    kinds = np.unique(np.round(whole / step), return_counts=True)[1]
    if not again and ((kinds > 0.03 * len(whole)).sum() < 3 or best < (0.6 if len(x) > 250 else 0.95)):
        return 0.0
    # the steps of a ball with two even motions, or with frames missing, fit for one of them only; rounding holds for all gaps
    if not again and np.quantile(np.abs(whole / step - np.round(whole / step)), 0.9) > MAX_OFF_STEP:
        return 0.0
    return float((gaps[good] * count[good]).sum() / (count[good] ** 2).sum()) if good.any() else step


def without_outliers(tracks: Sequence[Track], interval: float, gravity: float, notes: list[str]) -> list[Track]:
    """Return the tracks without single positions that are not the ball's: they fit no motion, nor a contact."""
    found: list[Track] = []
    off: list[tuple[float, str]] = []
    for track in tracks:
        away = _distance_from_neighbours(track, interval, gravity)
        off += [(float(away[k]), f"track {track.name!r} at t = {track.time[k]:.4g} s") for k in np.flatnonzero(away)]
        found.append(track.select(away == 0) if away.any() else track)
    if off:
        most, where = max(off)
        count = "1 position lies" if len(off) == 1 else f"{len(off)} positions lie up to"
        notes.append(
            f"{count} {1e3 * most:.3g} mm off the path through the frames around ({where}): not the ball, and omitted"
        )
    return found


def _distance_from_neighbours(track: Track, interval: float, gravity: float) -> Array:
    """Return how far each position (n,) lies from the path through its neighbours, m, if that is a wrong position; else 0."""
    away = np.zeros(len(track))
    if len(track) < 7 or not np.isfinite(interval):
        return away
    powers = np.stack([AROUND**0, AROUND, AROUND**2], axis=1)
    windows = np.lib.stride_tricks.sliding_window_view(track.position, 7, axis=0)  # (n - 6, 2, 7)
    beside, here = windows[..., [0, 1, 2, 4, 5, 6]], windows[..., 3]
    parabola = beside @ np.linalg.pinv(powers).T
    misfit = np.abs(beside - parabola @ powers.T).max(axis=(1, 2))
    distance = np.linalg.norm(here - parabola[..., 0], axis=1)
    noise = position_noise(track.time, track.position, interval)
    # (a ball that hops between two frames is as far from them as it falls in that time)
    least = np.maximum(OUTLYING * np.maximum(misfit, noise), gravity * interval**2)
    in_a_row = track.time[6:] - track.time[:-6] < 6.5 * interval
    away[3:-3] = np.where(in_a_row & (distance > least), distance, 0.0)
    return away


def initial_noise(tracks: Sequence[Track], interval: float, step: tuple[float, float]) -> float:
    """Estimate the noise of a coordinate, m, before anything is fitted; at least the noise of rounding."""
    found = [position_noise(track.time, track.position, interval) for track in tracks]
    found = [x for x in found if x > 0]
    least = max(step) / np.sqrt(12.0)
    size = max(float(np.ptp(track.position, axis=0).max()) for track in tracks)
    return float(max(np.median(found) if found else 0.0, least, 1e-6 * size))


def prepared(
    tracks: Sequence[Track], gravity: float, notes: list[str]
) -> tuple[list[Track], dict[str, list[Track]], float, tuple[float, float], float]:
    """Return tracks without wrong positions, on the camera's clock, and those of each group.

    And the interval between frames, s, the step to which positions were rounded along each axis, and the noise of a coordinate, m.
    """
    seen, interval = on_camera_clock(tracks, notes)
    seen = without_outliers(seen, interval, gravity, notes)
    step = (rounding_step([t.position[:, 0] for t in seen]), rounding_step([t.position[:, 1] for t in seen]))
    groups: dict[str, list[Track]] = {}
    for track in seen:
        groups.setdefault(track.group, []).append(track)
    return seen, groups, interval, step, initial_noise(seen, interval, step)


def guess_view(tracks: Sequence[Track], gravity: float) -> tuple[View, str]:
    """Return ``side`` if most pieces of the tracks fall with gravity, or with another constant acceleration; and the reason."""
    share = falling_share(tracks, gravity)
    if share > MIN_FALLING_SHARE:
        return "side", f"in {100 * share:.0f} % of the track the ball falls with gravity"
    seconds = falls_freely(tracks, gravity)
    if seconds:
        return "side", f"for {seconds:.2g} s the ball falls freely with gravity"
    fall = constant_acceleration(tracks)
    if fall < 0:
        return "side", (
            f"the ball falls with a constant acceleration, up and down; but it is {-fall:.3g} m/s^2: is the scale or the frame"
            " rate wrong?"
        )
    return "above", "the ball does not fall with gravity"


# ----------------------------------------------------------------------------------------------------
# Balls that a tracking program has confused: two of a film take each other's places, or one goes on under another name.


JUMP = 0.06  # m that both balls are off their paths, more than a ball's diameter
ON_THE_WAY = 0.03  # m that they are off the other's, after the exchange: a contact leaves them a diameter apart
LONGEST_GAP = 3.5  # frames, over which a path is continued
NEAR_SHARE = 0.02  # of the size of what the film shows: a ball that goes on is no farther off, also where all is small
SAME_FRAME = 0.25  # of the interval of frames


def with_own_names(tracks: Sequence[Track], notes: list[str]) -> list[Track]:
    """Return the tracks of films in which no two balls have exchanged their names; a note says when they did.

    The frames are followed in time. Where two balls leave the continuation of their paths at once, by more than a ball's diameter,
    and each is on that of the other, their names are exchanged from there on. Two balls that collide are a diameter apart: they are
    left.
    """
    found = list(tracks)
    for group in dict.fromkeys(track.group for track in tracks):
        members = [k for k, track in enumerate(found) if track.group == group and len(track) > 2]
        if sum(_jumps(found[k]) for k in members) < 2:
            continue
        mine, when = _own_names([found[k] for k in members])
        if when:
            pairs = sorted({name for _t, *names in when for name in names})
            notes.append(
                f"{group or 'film'}: {', '.join(pairs)} exchange their names in the file {times_in_words(len(when))}, first at"
                f" t = {when[0][0]:.6g} s: exchanged back"
            )
            for k, one in zip(members, mine, strict=True):
                found[k] = one
    return found


def with_one_name(tracks: Sequence[Track], notes: list[str]) -> list[Track]:
    """Return the tracks of films in which no ball goes on under another name; a note says which did.

    One track ends before the film does, and within a few frames another one begins on the continuation of its path, or where the
    ball lay: nearer than any other ball could be.
    """
    found = list(tracks)
    for group in dict.fromkeys(track.group for track in tracks):
        while pair := _goes_on([track for track in found if track.group == group]):
            one, two = pair
            first, second = one.seen.nonzero()[0], two.seen.nonzero()[0]
            joined = _joined([one, two], 0, [*((0, int(i)) for i in first), *((1, int(i)) for i in second)])
            notes.append(
                f"{group or 'film'}: {two.name} begins at t = {two.time[second[0]]:.6g} s where {one.name} ends: taken as one ball,"
                f" {one.name}"
            )
            found = [joined if track is one else track for track in found if track is not two]
    return found


def _goes_on(tracks: list[Track]) -> tuple[Track, Track] | None:
    """Return the two tracks of a film of which the second goes on nearest to where the first ends; None if no two do."""
    seen = [(track, track.time[track.seen], track.position[track.seen][:, :2]) for track in tracks if track.seen.any()]
    if len(seen) < 2:
        return None
    steps = np.concatenate([np.diff(t) for _track, t, _x in seen])
    longest = LONGEST_GAP * float(np.median(steps[steps > 0])) if (steps > 0).any() else 0.0
    near = min(ON_THE_WAY, NEAR_SHARE * float(np.hypot(*np.ptp(np.concatenate([x for _track, _t, x in seen]), axis=0))))
    off = []
    for (one, t, x), (two, u, y) in itertools.permutations(seen, 2):
        if 0 < u[0] - t[-1] <= longest:
            ahead = _continued(list(zip(t[-2:], x[-2:], strict=True)), float(u[0]), longest)
            away = [np.hypot(*(y[0] - place)) for place in (x[-1], ahead) if place is not None]
            off.append((min(away), one, two))
    nearest = min(off, key=lambda each: each[0], default=None)
    return nearest[1:] if nearest and nearest[0] < near else None


def _jumps(track: Track) -> bool:
    """Return whether a ball is anywhere farther from the continuation of its path than two balls that exchange their names."""
    time, x = track.time[track.seen], track.position[track.seen][:, :2]
    step, way = np.diff(time), np.diff(x, axis=0)
    ahead = np.divide(way, step[:, None], out=np.zeros_like(way), where=step[:, None] > 0)[:-1] * step[1:, None]
    return bool((np.hypot(*(way[1:] - ahead).T) > JUMP).any() or (len(way) > 0 and np.hypot(*way[0]) > JUMP))


def times_in_words(count: int) -> str:
    """Return how often something happens."""
    return "once" if count == 1 else f"{count} times"


def _own_names(tracks: list[Track]) -> tuple[list[Track], list[tuple[float, str, str]]]:
    """Return tracks with their names exchanged back, and when which two were."""
    steps = np.concatenate([np.diff(track.time) for track in tracks])
    interval = float(np.median(steps[steps > 0])) if (steps > 0).any() else 0.0
    rows = sorted((float(t), k, i) for k, track in enumerate(tracks) for i, t in enumerate(track.time))
    owner, when = (
        list(range(len(tracks))),
        list[tuple[float, str, str]](),
    )  # owner[k]: the ball that the file's track k shows
    paths: list[list[tuple[float, Array]]] = [[] for _ in tracks]
    taken: list[list[tuple[int, int]]] = [[] for _ in tracks]
    for frame in _rows_by_frame(rows, SAME_FRAME * interval):
        t, places = frame[0][0], {k: tracks[k].position[i, :2] for _t, k, i in frame}
        expected = {k: _continued(paths[owner[k]], t, LONGEST_GAP * interval) for k in places}
        for one, two in itertools.combinations(places, 2):
            mine, yours = expected[one], expected[two]
            if mine is None or yours is None:
                continue
            off = min(np.hypot(*(places[one] - mine)), np.hypot(*(places[two] - yours)))
            if off > JUMP and max(np.hypot(*(places[two] - mine)), np.hypot(*(places[one] - yours))) < ON_THE_WAY:
                owner[one], owner[two] = owner[two], owner[one]
                expected[one], expected[two] = yours, mine
                when.append((t, tracks[one].name, tracks[two].name))
        for _t, k, i in frame:
            ball = owner[k]
            if np.isfinite(places[k]).all():
                paths[ball] = [*paths[ball][-1:], (t, places[k])]
            taken[ball].append((k, i))
    if not when:
        return tracks, when
    return [_joined(tracks, k, rows) for k, rows in enumerate(taken)], when


def _rows_by_frame(rows: list[tuple[float, int, int]], apart: float) -> list[list[tuple[float, int, int]]]:
    """Return the rows, in the order of time, of each frame."""
    frames: list[list[tuple[float, int, int]]] = []
    for row in rows:
        if frames and row[0] - frames[-1][0][0] <= apart and all(row[1] != other[1] for other in frames[-1]):
            frames[-1].append(row)
        else:
            frames.append([row])
    return frames


def _continued(path: list[tuple[float, Array]], t: float, longest: float) -> Array | None:
    """Return where a ball is expected, from its last two frames; None after a gap."""
    if not path or t - path[-1][0] > longest:
        return None
    since, x = path[-1]
    v = np.zeros(2)
    if len(path) > 1 and since - path[0][0] <= longest:
        v = (x - path[0][1]) / (since - path[0][0])
    return np.asarray(x + v * (t - since))


def _joined(tracks: list[Track], ball: int, rows: list[tuple[int, int]]) -> Track:
    """Return the track of a ball whose rows stand in several tracks of the file."""

    def of(name: str) -> Any:
        parts = [getattr(track, name) for track in tracks]
        return None if any(part is None for part in parts) else np.array([parts[k][i] for k, i in rows])

    return replace(tracks[ball], **{name: of(name) for name in SAMPLED})
