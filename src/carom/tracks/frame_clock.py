"""The clock behind the times of a file: the interval from frame to frame, and the number of the frame of each row.

Times are rounded, rows are missing, and a slow-motion film has the times of its playback. A clock explains times if every row has
a frame of its own, within the rounding of its time.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from carom.tracks.preprocess import MIN_INTERVAL_S, camera_clock

__all__ = ["OFF_CLOCK", "even_interval", "file_interval", "frame_count", "repeated_rows", "rounding_of_times"]

Array = NDArray[np.float64]
MOST_DECIMALS = 7
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


def repeated_rows(time: Array, step: Array) -> NDArray[np.bool_]:
    """Return which rows (n,) are of the same frame as the row before: the same time, where rounding is finer than a frame."""
    jump = np.diff(time)
    if not (jump > 0).any():
        return np.concatenate([[False], jump == 0])
    return np.concatenate([[False], (jump == 0) & (step[1:] < 0.99 * float(np.median(jump[jump > 0])))])


def file_interval(time: Array, rate: float) -> float | None:
    """Return the time from frame to frame, s, as the times (n,) of a file have it; None if they are on no clock.

    Whole numbers are frame numbers (1). Rows are successive frames where their times are even within their rounding. Otherwise
    frames are missing: of the clocks that explain the times, that of ``rate``, 1/s, and the slowest of all, the one with fewer
    missing frames is taken.
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


def even_interval(time: Array, step: Array, frame: Array | None = None) -> float | None:
    """Return the time from frame to frame, s, if rows (n,) are on an even clock, within the rounding ``step`` (n,) of their times.

    ``frame``: the frame (n,) of each row; by default each row is the next frame.
    """
    row = np.arange(len(time), dtype=float) if frame is None else frame
    row = row - row.mean()
    square = float(row @ row)
    interval = float(row @ time) / square if square > 0 else 0.0  # (one row, or rows of one frame, have no interval)
    if not interval > MIN_INTERVAL_S:
        return None
    half = np.maximum(step / 2, OFF_CLOCK * interval) * (1 + 1e-6)
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
        within = spacing * ((np.arange(finer) + 0.5) / finer - 0.5)
        if len(tried) * finer > MOST_TRIED:
            return np.inf, 0.0
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
