"""The camera's clock: which rows are frames, when they were taken, and how finely places were rounded."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

__all__ = ["Clock", "camera_clock", "noise_of", "step_of"]

Array = NDArray[np.float64]
# Of the series, how many show the step to which all were rounded, at least, and two: fast balls and resting ones show none.
AGREE = 0.1


@dataclass(frozen=True, eq=False)
class Clock:
    """Times (n,) as the camera had them."""

    interval: float
    """s from frame to frame."""
    time: Array
    """(n,) s: on the clock where the file's times were rounded, else as they came."""
    frame: NDArray[np.bool_]
    """(n,): rows that are frames; the others stand between them, put there by a program."""
    rounded: float
    """s to which the file's times were rounded; 0 where they are as exact as they need be."""
    steady: bool
    """Whether there is a clock at all: False where the intervals vary."""


def camera_clock(time: Array) -> Clock:
    """The clock behind sorted times (n,), which may have gaps, duplicates, rounding, and rows between the frames."""
    n = len(time)
    every = np.ones(n, bool)
    steps = np.diff(time)
    steps = steps[steps > 0]
    if len(steps) < 3:
        return Clock(float(steps.min()) if len(steps) else np.nan, time, every, 0.0, False)
    interval = _commonest(steps)
    grid = _grid(time)
    start = _start(time, interval)
    if start is None:
        return Clock(interval, time, every, 0.0, False)
    first, size = start
    zero = float(time[first])
    reach, near = size, np.zeros(n, bool)
    while True:
        rows = slice(max(first - reach, 0), first + reach)
        count = np.round((time[rows] - zero) / interval)
        off = time[rows] - zero - count * interval
        near = np.abs(off) < 0.08 * interval + grid
        if near.sum() < 3:
            return Clock(interval, time, every, 0.0, False)
        interval, zero = (float(x) for x in np.polyfit(count[near], time[rows][near], 1))
        if reach >= n:
            break
        reach *= 2
    count = np.round((time - zero) / interval)
    off = time - zero - count * interval
    near = np.abs(off) < 0.08 * interval + grid
    if near.mean() < 0.7:
        return Clock(interval, time, every, 0.0, False)
    spread = float(np.median(np.abs(off[near])))
    frame = np.abs(off) < max(4 * spread, 1e-3 * interval)
    if grid > 0:
        frame &= np.abs(time / grid - np.round(time / grid)) < 0.02
    # of two rows in one frame the nearer to the clock
    order = np.lexsort((np.abs(off), count))
    doubled = np.zeros(n, bool)
    doubled[order[1:]] = count[order][1:] == count[order][:-1]
    frame &= ~doubled
    rounded = max(grid, 4 * spread) if spread > 2e-3 * interval else 0.0
    told = np.where(frame, zero + count * interval, time) if rounded else time
    return Clock(interval, told, frame, rounded, True)


def _commonest(steps: Array) -> float:
    """The least of the common steps: where a slow ball has rows in every second frame only, that is the camera's."""
    steps = np.sort(steps)
    count = np.searchsorted(steps, 1.04 * steps) - np.searchsorted(steps, 0.96 * steps)
    least = float(steps[np.flatnonzero(count >= 0.25 * count.max())[0]])
    return float(np.median(steps[np.abs(steps / least - 1) < 0.08]))


def _start(time: Array, interval: float) -> tuple[int, int] | None:
    """The middle and half the length of the longest run of even steps."""
    even = np.abs(np.diff(time) - interval) < 0.1 * interval
    edges = np.flatnonzero(np.diff(np.concatenate([[False], even, [False]]).astype(int)))
    runs = edges.reshape(-1, 2)
    if not len(runs):
        return None
    low, high = runs[np.argmax(runs[:, 1] - runs[:, 0])]
    return (int(low + high) // 2, max((int(high - low) + 1) // 2, 2)) if high - low >= 3 else None


def _grid(time: Array) -> float:
    """The step of which nearly all times are multiples, if it is a round one: 1 ms, 0.5 ms...; 0 if there is none."""
    for grid in (1e-2, 1e-3, 5e-4, 1e-4):
        if (np.abs(time / grid - np.round(time / grid)) < 0.02).mean() > 0.8:
            return grid
    return 0.0


def step_of(series: Sequence[Array]) -> float:
    """The step to which coordinates were rounded, pixels say (m): the commonest of the series that show one; 0 if none does.

    One camera rounds all series to one step: some that show one by chance, as an even motion does of which frames are missing,
    are of different steps and few.
    """
    told = np.array([step for step in map(_step, series) if np.isfinite(step)])
    same = [np.abs(told - step) < 0.05 * step for step in told]
    most = max(same, key=np.count_nonzero, default=np.zeros(0, bool))
    return float(np.median(told[most])) if most.sum() >= max(AGREE * len(told), min(2, len(told)), 1) else 0.0


def _step(x: Array) -> float:
    """Differences of neighbouring values are multiples of it: the largest step at which their phases agree; 0 if there is none, NaN
    where there are too few values to tell."""
    values = np.unique(x[np.isfinite(x)])[:20000]
    gaps = np.diff(values)
    gaps = gaps[gaps > 1e-6 * (values[-1] - values[0])] if len(values) else gaps
    if len(gaps) < 20:
        return np.nan
    # rounding to decimal places leaves gaps of 1 beside gaps of 10: steps far below the usual gap are no pixels
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
    # an even motion has even gaps too: where no place comes again, there must be many, or gaps of many sizes that fit well
    again = len(values) < 0.8 * len(x)
    kinds = np.unique(np.round(whole / step), return_counts=True)[1]
    if not again and ((kinds > 0.03 * len(whole)).sum() < 3 or best < (0.6 if len(x) > 250 else 0.95)):
        return 0.0
    return float((gaps[good] * count[good]).sum() / (count[good] ** 2).sum()) if good.any() else step


def noise_of(time: Array, position: Array, interval: float) -> float:
    """Noise of one coordinate of one frame (m): what places scatter about a smooth way, by fourth differences.

    A contact bends few of them, so their median size tells; a resting ball tells nothing and is left out.
    """
    parts = []
    span = 4.5 * interval if np.isfinite(interval) else np.inf
    for k in range(position.shape[1]):
        x = position[:, k]
        difference = x[4:] - 4 * x[3:-1] + 6 * x[2:-2] - 4 * x[1:-3] + x[:-4]
        moves = np.abs(position[4:] - position[:-4]).max(axis=1) > 0
        good = moves & (time[4:] - time[:-4] < span) & np.isfinite(difference)
        parts.append(np.abs(difference[good]))
    sizes = np.concatenate(parts)
    if len(sizes) < 4:
        return 0.0
    # the median of |N(0, 1)| is 0.6745; 1 + 16 + 36 + 16 + 1 = 70
    return float(np.median(sizes) / 0.6745 / np.sqrt(70.0))
