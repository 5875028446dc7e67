"""Bounces of a ball filmed from the side that are at none of the walls: on a stair, a hand, a stone."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

import numpy as np

from carom.errors import shortened_list
from carom.tracks.events import TrackEvent, WallLine, frames_per_side, turning_points
from carom.tracks.track import Track

__all__ = ["BEYOND_WALL_M", "elsewhere_note", "facing_up", "with_turns"]

NEAR_WALL_M, BEYOND_WALL_M = 0.01, 0.03  # a wall that gives way, or a line that was given a little off
LEVEL = 0.5  # component of a normal that points down, from which a wall is a ceiling, or a floor seen from below


def with_turns(
    events: list[TrackEvent], track: Track, walls: Sequence[WallLine], noise: float, down: tuple[float, float]
) -> list[TrackEvent]:
    """Return the events of a ball in flight with its bounces away from all walls, as on a stair or a hand: each ends a flight.

    Contacts far beyond the line of their wall are left out: they are bounces on a lower stair, below the line of a higher one.
    """
    if not walls:
        return events
    t, x, height = track.time, track.position, -track.position @ np.array(down)
    rows = turning_points(height, noise, frames_per_side(t))
    # it may have turned as far below as the longer of the steps beside (the shorter one may bridge the contact)
    step = np.abs(np.diff(height, prepend=height[:1], append=height[-1:]))
    reach = np.maximum(NEAR_WALL_M, 6 * noise + np.maximum(step[:-1], step[1:]))
    places = {wall.name: wall.frame(x)[:, 0] for wall in walls}
    away = np.all([np.abs(d[rows]) > reach[rows] for d in places.values()], axis=0)
    turns = [
        TrackEvent("turn", float(t[i - 1]), float(t[i + 1]), f"({x[i, 0]:.3f}, {x[i, 1]:.3f})")
        for i in rows[away].tolist()
    ]

    def at_its_wall(event: TrackEvent) -> bool:
        i = min(int(np.searchsorted(t, (event.low + event.high) / 2)), len(t) - 1)
        return bool(places[event.what][i] > -reach[i] - BEYOND_WALL_M)

    kept = [event for event in events if event.kind != "wall" or at_its_wall(event)]
    return sorted([*kept, *turns], key=lambda event: (event.low, event.high))


def facing_up(wall: WallLine, tracks: Sequence[Track], noise: float, down: tuple[float, float]) -> WallLine:
    """Return a wall with its normal turned up, if balls bounce on it: most of a track may lie below, as of a stair."""
    if np.array(wall.normal) @ np.array(down) < LEVEL:
        return wall
    for track in tracks:
        x = track.position
        rows = turning_points(-x @ np.array(down), noise, frames_per_side(track.time))
        if (np.abs(wall.frame(x[rows])[:, 0]) < NEAR_WALL_M + 6 * noise).any():
            return replace(wall, normal=(0.0 - wall.normal[0], 0.0 - wall.normal[1]))
    return wall


def elsewhere_note(events: Iterable[TrackEvent], several: bool) -> list[str]:
    """Return a note on bounces away from the wall, or from all ``several`` walls."""
    found = [event.what for event in events if event.kind == "turn"]
    if not found:
        return []
    count, are = ("1 bounce", "is") if len(found) == 1 else (f"{len(found)} bounces", "are")
    return [
        f"{count} away from the wall{'s' * several}, at (x, y) = {shortened_list(found, 4)} m, {are} not measured: `wall` y=0.1 or"
        " `wall` x1,y1,x2,y2 names the line at which the ball's centre turns there"
    ]
