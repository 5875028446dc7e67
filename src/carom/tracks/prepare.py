"""Tracks made ready for fits: seen frames on the camera's clock, first noise, from where they are seen."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from carom.errors import CaromError
from carom.tracks.clock import Clock, camera_clock, noise_of
from carom.tracks.contact import View
from carom.tracks.track import Track

__all__ = ["first_noise", "prepared", "view_of"]

Array = NDArray[np.float64]


def prepared(tracks: Sequence[Track], notes: list[str]) -> tuple[list[Track], float]:
    """Tracks of seen frames only, on the clock of their group, and the interval between frames (s)."""
    seen = []
    intervals = []
    groups: dict[str, list[Track]] = {}
    for track in tracks:
        if track.position.shape[1] != 2:
            raise CaromError(
                f"track {track.name!r}: expected places in a plane, got three coordinates; name two with --columns"
            )
        groups.setdefault(track.group, []).append(track.pick(track.seen))
    off = rounded = unsteady = 0
    for members in groups.values():
        times = np.unique(np.concatenate([track.time for track in members]))
        clock = camera_clock(times)
        off += int((~clock.frame).sum())
        rounded += clock.rounded > 0
        unsteady += not clock.steady
        if np.isfinite(clock.interval):
            intervals.append(clock.interval)
        seen += [_on_clock(track, times, clock) for track in members]
    interval = float(np.median(intervals)) if intervals else np.nan
    if off:
        notes.append(f"{off:,} rows stand between the camera's frames: interpolated by a program, left out")
    if rounded:
        notes.append(f"times were rounded: put back on the camera's clock, a frame every {1e3 * interval:.4g} ms")
    if unsteady:
        notes.append(f"no steady clock in {unsteady} of {len(groups)} files or shots: times are taken as they are")
    return [track for track in seen if len(track)], interval


def _on_clock(track: Track, times: Array, clock: Clock) -> Track:
    rows = np.searchsorted(times, track.time)
    return replace(track, time=clock.time[rows]).pick(clock.frame[rows])


def first_noise(tracks: Sequence[Track], interval: float, step: tuple[float, float]) -> float:
    """Noise of a coordinate (m) before anything is fitted; never less than rounding makes."""
    found = [noise_of(track.time, track.position, interval) for track in tracks]
    found = [x for x in found if x > 0]
    least = max(step) / np.sqrt(12.0)
    size = max(float(np.ptp(track.position, axis=0).max()) for track in tracks)
    return float(max(np.median(found) if found else 0.0, least, 1e-6 * size))


def view_of(tracks: Sequence[Track], gravity: float, notes: list[str]) -> View:
    """From the side, if most of the tracks fall as a ball falls."""
    falls = []
    for track in tracks:
        t, y = track.time, track.position[:, 1]
        size = max(8, int(0.12 / max(float(np.median(np.diff(t))), 1e-9))) if len(t) > 8 else len(t)
        for low in range(0, max(len(t) - size, 1), max(size // 2, 1)):
            rows = slice(low, low + size)
            if len(t[rows]) >= 6:
                falls.append(2 * np.polyfit(t[rows] - t[rows][0], y[rows], 2)[0])
    side = len(falls) > 0 and float((np.abs(np.array(falls) + gravity) < 0.3 * gravity).mean()) > 0.4
    notes.append(
        "the balls fall as they do in flight: taken as seen from the side (--view above overrules)" if side
        else "taken as seen from above, a ball on a table (--view side: in flight)"
    )  # fmt: skip
    return "side" if side else "above"
