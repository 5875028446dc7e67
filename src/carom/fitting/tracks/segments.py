"""Segments of tracks that are simulated: one ball, from where it runs freely until it meets another ball."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from carom.tracks.events import TrackEvent, WallLine
from carom.tracks.measurement import Measured
from carom.tracks.track import Track

__all__ = ["TrackSegment", "find_segments"]

Array = NDArray[np.float64]
FRAMES_BEFORE, FRAMES_AFTER = 4, 5  # at least
CLEARANCE = 0.004  # m from every wall, where a simulation starts
MIN_SPEED = 0.1  # m/s at the start
# Events after which a ball may slide; after others this is determined from the frames
SLIDING_STARTS = ("onset", "ball", "wall")


@dataclass(frozen=True, eq=False)
class TrackSegment:
    """A ball's path through some contacts with walls, without other events."""

    group: str
    name: str
    time: Array
    """(n,) s since its first frame."""
    since: float
    """s: the first frame's time in the track."""
    position: Array
    """(n, 2) m."""
    contacts: Array
    """(c,) s since the first frame, as :mod:`carom.tracks` measured them."""
    walls: tuple[str, ...]
    """(c,) their names."""
    slides: bool
    """Whether it has just been set in motion, so that it may slide."""
    ends: str
    """Cause of its end: ball, gap, end, another contact."""

    @property
    def label(self) -> str:
        """Shot and ball."""
        return " ".join(filter(None, (self.group, self.name)))

    def frames_until(self, contacts: int) -> int:
        """Return the number of frames before the contact that follows the first ``contacts`` ones."""
        every = contacts >= len(self.contacts)
        return len(self.time) if every else int(np.searchsorted(self.time, self.contacts[contacts]))


def find_segments(measured: Measured, cushions: int, after: float = np.inf) -> tuple[list[TrackSegment], list[str]]:
    """Return all segments with a contact, and notes on those omitted."""
    found: list[TrackSegment] = []
    lost: dict[str, int] = {}
    times = _contact_times(measured)
    for track in measured.tracks:
        events = measured.events[track.group, track.name]
        edges = [event for event in events if event.kind != "wall"]
        edges.sort(key=lambda event: (event.low, event.high))
        for first, last in pairwise(edges):
            inner = [
                event for event in events if event.kind == "wall" and first.high <= event.low and event.high <= last.low
            ]
            inner.sort(key=lambda event: event.low)
            one, why = _segment(track, first, last, inner, measured, times, cushions, after)
            if one is not None:
                found.append(one)
            elif why:
                lost[why] = lost.get(why, 0) + 1
    return found, [f"{count} segment{'s' if count > 1 else ''} omitted: {why}" for why, count in lost.items()]


def _contact_times(measured: Measured) -> dict[tuple[str, str, float], float]:
    """Return the measured times of contacts, by the beginning of their event."""
    found = {}
    for one in measured.contacts:
        for event in measured.events[one.group, one.track]:
            if event.kind == "wall" and event.what == one.wall.name and event.low <= one.time <= event.high:
                found[one.group, one.track, event.low] = one.time
    return found


def _segment(
    track: Track, first: TrackEvent, last: TrackEvent, inner: list[TrackEvent], measured: Measured,
    times: dict[tuple[str, str, float], float], cushions: int, seconds: float,
) -> tuple[TrackSegment | None, str]:  # fmt: skip
    """Return the frames from one event to another, through the walls between them; or why they cannot be used."""
    low, kind, ends = first.high, first.kind, last.kind
    high = last.low
    while inner:
        before = int(((track.time >= low) & (track.time < inner[0].low - measured.blind[0])).sum())
        if before >= FRAMES_BEFORE:
            break
        low, kind = inner[0].high + measured.blind[1], "wall"  # too few for its velocity: it starts after that wall
        inner = inner[1:]
    if not inner:
        return None, ""
    if len(inner) > cushions:
        high, ends = inner[cushions].low, "another contact"
        inner = inner[:cushions]
    middles = np.array([times.get((track.group, track.name, e.low), (e.low + e.high) / 2) for e in inner])
    use = (track.time >= low) & (track.time <= min(high, middles[-1] + seconds))
    for t in middles:
        use &= (track.time < t - measured.blind[0]) | (track.time > t + measured.blind[1])
    for wall in measured.walls:
        d = wall.frame(track.position)[:, 0]
        if wall.clamped:
            use &= d > 1e-6
    rows = _clear(track, np.flatnonzero(use), measured.walls, measured.noise)
    after = int((track.time[rows] > middles[0]).sum())
    if len(rows) - after < FRAMES_BEFORE or after < FRAMES_AFTER:
        return None, f"fewer than {FRAMES_BEFORE} frames before or {FRAMES_AFTER} after the first contact"
    t, x = track.time[rows], track.position[rows]
    speed = np.hypot(*(x[3] - x[0])) / (t[3] - t[0])
    if speed < MIN_SPEED:
        return None, f"slower than {MIN_SPEED} m/s at the start"
    met = tuple(e.what for e in inner)
    return (
        TrackSegment(
            track.group, track.name, t - t[0], float(t[0]), x, middles - t[0], met, kind in SLIDING_STARTS, ends
        ),
        "",
    )


def _clear(track: Track, rows: NDArray[np.intp], walls: Sequence[WallLine], noise: float) -> NDArray[np.intp]:
    """Drop first frames that are so near a wall that the start might lie behind it."""
    for k, row in enumerate(rows.tolist()):
        if all(wall.frame(track.position[row : row + 1])[0, 0] > CLEARANCE + 6 * noise for wall in walls):
            return rows[k:]
    return rows[:0]
