"""Preparation of tracks for fits: rounding and noise of positions, wrong positions, and the camera's view."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from carom.tracks.contact import View
from carom.tracks.free_fall import MIN_FALLING_SHARE, constant_acceleration, falling_share, falls_freely
from carom.tracks.track import Track, position_noise

Array = NDArray[np.float64]
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
