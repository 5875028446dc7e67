"""Which stretches of a track are followed whole: one ball, from when it is seen to run freely until it meets another."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from carom.tracks.contacts import Event, Wall
from carom.tracks.measure import Measured
from carom.tracks.track import Track

__all__ = ["Stretch", "stretches"]

Array = NDArray[np.float64]
FEWEST_BEFORE, FEWEST_AFTER = 4, 5
CLEAR = 0.004  # m: how far from every wall a run starts
SLOWEST = 0.1  # m/s: a ball that starts slower is not followed
# What a ball does before the stretch: after these it slides, else that is asked of its frames.
SLIDES = ("onset", "ball", "wall")


@dataclass(frozen=True, eq=False)
class Stretch:
    """A ball's way through some contacts with walls, with nothing else on it."""

    group: str
    name: str
    time: Array
    """(n,) s since its first frame."""
    since: float
    """s: the first frame's time in the track."""
    position: Array
    """(n, 2) m."""
    contacts: Array
    """(c,) s since the first frame, as the tracks room has them."""
    walls: tuple[str, ...]
    """(c,) their names."""
    slides: bool
    """Whether it has just been set in motion, so that it need not roll."""
    ends: str
    """What ends it: ball, gap, end, another contact."""

    @property
    def label(self) -> str:
        """Shot and ball."""
        return " ".join(filter(None, (self.group, self.name)))

    def frames_until(self, contacts: int) -> int:
        """How many frames lie before the contact after so many."""
        return (
            len(self.time)
            if contacts >= len(self.contacts)
            else int(np.searchsorted(self.time, self.contacts[contacts]))
        )


def stretches(measured: Measured, cushions: int, after: float = np.inf) -> tuple[list[Stretch], list[str]]:
    """All stretches with a contact, and why others were left out."""
    found: list[Stretch] = []
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
            one, why = _stretch(track, first, last, inner, measured, times, cushions, after)
            if one is not None:
                found.append(one)
            elif why:
                lost[why] = lost.get(why, 0) + 1
    return found, [f"{count} stretches left out: {why}" for why, count in lost.items()]


def _contact_times(measured: Measured) -> dict[tuple[str, str, float], float]:
    """The measured times of contacts, by the middle of their event."""
    found = {}
    for one in measured.contacts:
        for event in measured.events[one.group, one.track]:
            if event.kind == "wall" and event.what == one.wall.name and event.low <= one.time <= event.high:
                found[one.group, one.track, event.low] = one.time
    return found


def _stretch(
    track: Track, first: Event, last: Event, inner: list[Event], measured: Measured,
    times: dict[tuple[str, str, float], float], cushions: int, seconds: float,
) -> tuple[Stretch | None, str]:  # fmt: skip
    """The frames from one event to another, through the walls between them; or why they are of no use."""
    low, kind, ends = first.high, first.kind, last.kind
    high = last.low
    while inner:
        before = int(((track.time >= low) & (track.time < inner[0].low - measured.blind[0])).sum())
        if before >= FEWEST_BEFORE:
            break
        low, kind = inner[0].high + measured.blind[1], "wall"  # too few to tell how it comes: it starts after that wall
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
    if len(rows) - after < FEWEST_BEFORE or after < FEWEST_AFTER:
        return None, f"fewer than {FEWEST_BEFORE} frames before or {FEWEST_AFTER} after the first contact"
    t, x = track.time[rows], track.position[rows]
    speed = np.hypot(*(x[3] - x[0])) / (t[3] - t[0])
    if speed < SLOWEST:
        return None, f"slower than {SLOWEST} m/s at the start"
    met = tuple(e.what for e in inner)
    return (
        Stretch(track.group, track.name, t - t[0], float(t[0]), x, middles - t[0], met, kind in SLIDES, ends),
        "",
    )


def _clear(track: Track, rows: NDArray[np.intp], walls: Sequence[Wall], noise: float) -> NDArray[np.intp]:
    """Without first frames that are so near a wall that the start might lie behind it."""
    for k, row in enumerate(rows.tolist()):
        if all(wall.frame(track.position[row : row + 1])[0, 0] > CLEAR + 6 * noise for wall in walls):
            return rows[k:]
    return rows[:0]
