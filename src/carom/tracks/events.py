"""Events of a track, which separate its pieces of free motion: contacts with walls and balls, gaps, start and end."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from carom.errors import CaromError
from carom.tracks.track import Track

__all__ = [
    "TrackEvent",
    "WallLine",
    "find_events",
    "find_walls",
    "position_at",
    "turning_points",
    "wall_of_text",
    "wall_through",
]

Array = NDArray[np.float64]
TURN_TIME_S = 0.06  # within which a ball has to turn visibly
TOUCH_DISTANCE_M = (
    0.010  # between surfaces: a closer pass counts as a contact of two balls, since the frames cannot exclude it
)
BEYOND_WALL_M = 0.03  # below a wall's line: a lower stair, not the wall
SIDES = (("left", 0, 1), ("right", 0, -1), ("bottom", 1, 1), ("top", 1, -1))


@dataclass(frozen=True)
class WallLine:
    """The straight line at which the centre of a ball is reflected by a wall.

    Examples
    --------
    >>> import numpy as np
    >>> wall = WallLine("left", point=(0.03, 0.0), normal=(1.0, 0.0))
    >>> wall.frame(np.array([[0.53, 0.2]]))
    array([[0.5, 0.2]])
    """

    name: str
    point: tuple[float, float]
    """A point of the line, m."""
    normal: tuple[float, float]
    """Unit vector toward the ball."""
    clamped: bool = False
    """Whether a program moved positions beyond the line onto it, so that rows on it are not measurements."""
    found: bool = True
    """Whether the line was found in the data rather than given."""

    def frame(self, x: Array) -> Array:
        """Transform positions (n, 2), m, to distance from the wall and coordinate along it, counter-clockwise from the normal."""
        n = np.array(self.normal)
        return np.stack([(x - self.point) @ n, x @ np.array([-n[1], n[0]])], axis=-1)

    def back(self, x: Array) -> Array:
        """Transform coordinates (n, 2) in the wall's frame to positions."""
        n = np.array(self.normal)
        origin = np.array(self.point) - (np.array(self.point) @ np.array([-n[1], n[0]])) * np.array([-n[1], n[0]])
        return np.asarray(origin + x[:, :1] * n + x[:, 1:] * np.array([-n[1], n[0]]))

    def turned(self, v: Array) -> Array:
        """Transform a vector (2,) to the wall's frame."""
        n = np.array(self.normal)
        return np.array([v @ n, v @ np.array([-n[1], n[0]])])


@dataclass(frozen=True)
class TrackEvent:
    """An event of a ball between two of its frames.

    Examples
    --------
    >>> import numpy as np
    >>> from carom.tracks import Settings, Track, measure
    >>> t = np.arange(40) / 100
    >>> ball = Track("ball", t, np.stack([np.abs(0.2 - t), 0.1 * t], axis=-1))
    >>> found = measure([ball], Settings(view="above", noise=1e-4)).events["", "ball"]
    >>> [(event.kind, event.what) for event in found]
    [('start', ''), ('wall', 'left'), ('end', '')]
    """

    kind: str
    """wall, ball, gap, onset, start, end; turn: a bounce away from all walls."""
    low: float
    high: float
    """The event lies between these times, s."""
    what: str = ""
    """Name of the wall or of the other ball; place of a turn."""
    place: tuple[float, float] | None = None
    """Where the ball met the wall, m, if that is away from its line: on a stair, or where a floor is seen from above."""


def frames_per_side(time: Array) -> int:
    """Return how many frames to each side show whether a ball turns: three, or as many as there are in 60 ms.

    At a high frame rate a ball moves less than the noise in three frames.
    """
    interval = float(np.median(np.diff(time))) if len(time) > 1 else np.inf
    return max(3, round(min(TURN_TIME_S / max(interval, 1e-12), len(time)))) if interval > 0 else 3


def turning_points(d: Array, noise: float, reach: int = 3) -> NDArray[np.intp]:
    """Return the indices of sharp minima of a distance (n,): it falls before and rises after by more than 6 times the noise.

    ``reach``: within so many frames.
    """
    if len(d) < 4:
        return np.zeros(0, np.intp)
    inner = np.flatnonzero((d[1:-1] <= d[:-2]) & (d[1:-1] <= d[2:])) + 1
    before, after = d[np.maximum(inner - reach, 0)] - d[inner], d[np.minimum(inner + reach, len(d) - 1)] - d[inner]
    return inner[(before > 6 * noise) & (after > 6 * noise)]


def find_walls(
    tracks: Sequence[Track],
    noise: float,
    sides: Sequence[str] = ("left", "right", "bottom", "top"),
    down: tuple[float, float] = (0.0, -1.0),
) -> list[WallLine]:
    """Find walls parallel to the axes: extremes of all positions near which balls turn sharply.

    ``down``: the direction of gravity in the picture, to which the floor is perpendicular; the other walls turn with it.
    A wall is ``clamped`` if several rows have exactly the extreme value. The line is the extreme itself; the fits may later
    find that the ball turned beyond it.
    """
    x = np.concatenate([track.position[track.seen][:, :2] for track in tracks])
    walls = []
    axes = np.array([[-down[1], down[0]], [-down[0], -down[1]]])  # of the room: to the right, and up
    for name, axis, sign in SIDES:
        if name not in sides or not len(x):
            continue
        height = x @ (sign * axes[axis])
        edge = float(height.min())
        size = float(np.ptp(height))
        turned = False
        for track in tracks:
            d = track.position[track.seen][:, :2] @ (sign * axes[axis]) - edge
            for i in turning_points(d, noise, frames_per_side(track.time[track.seen])).tolist():
                step = max(abs(d[i] - d[i - 1]), abs(d[i + 1] - d[i]))
                turned |= bool(d[i] < 0.75 * step + max(0.03 * size, 6 * noise))
        if not turned:
            continue
        # no two measured positions agree to the last digit, except for coarse pixels, where leaving them out costs little
        clamped = int((height - edge < 1e-9 * (1 + abs(edge))).sum()) >= 2
        normal = (sign * axes[axis] + 0.0).tolist()
        point = (edge * np.array(normal) + 0.0).tolist()
        walls.append(WallLine(name, (point[0], point[1]), (normal[0], normal[1]), clamped=clamped))
    return walls


def wall_through(
    name: str, first: tuple[float, float], second: tuple[float, float], tracks: Sequence[Track]
) -> WallLine:
    """Return the wall through two points (m); the balls are on the side where most of their positions are."""
    along = np.array(second) - np.array(first)
    n = np.array([-along[1], along[0]]) / np.hypot(*along)
    x = np.concatenate([track.position[track.seen][:, :2] for track in tracks])
    if np.median((x - first) @ n) < 0:
        n = -n
    return WallLine(name, first, (float(n[0]) + 0.0, float(n[1]) + 0.0), found=False)


def wall_of_text(text: str, tracks: Sequence[Track]) -> WallLine:
    """Return the wall that ``x=0.03``, ``y=1.4`` or ``x1,y1,x2,y2`` (two points, m) names. Raises CaromError for another text."""
    name, _sign, value = text.partition("=")
    try:
        if name.strip() in ("x", "y") and value:
            at = float(value)
            points = ((at, 0.0), (at, 1.0)) if name.strip() == "x" else ((0.0, at), (1.0, at))
        else:
            x1, y1, x2, y2 = (float(part) for part in text.replace(",", " ").split())
            points = ((x1, y1), (x2, y2))
        if points[0] == points[1] or not np.isfinite(points).all():
            raise ValueError
    except ValueError:
        raise CaromError(f"`wall`: expected x=0.03, y=1.4 or x1,y1,x2,y2 with two points (m), got {text!r}") from None
    return wall_through(text, *points, tracks)


def find_events(
    track: Track, others: Sequence[Track], walls: Sequence[WallLine], noise: float, radii: float | None, interval: float
) -> list[TrackEvent]:
    """Find all events of a ball, in order of time.

    ``radii``: distance between the centres of two balls that touch, m; None: contacts between balls are not looked for.
    """
    time, x = track.time, track.position
    if len(time) < 2:
        return []
    events = [TrackEvent("start", time[0], time[0]), TrackEvent("end", time[-1], time[-1])]
    for wall in walls:
        events += _at_wall(time, wall.frame(x)[:, 0], wall, noise)
    if radii is not None:
        for other in others:
            events += _ball_meetings(track, other, radii, interval)
    away = np.flatnonzero(np.hypot(*(x - x[0]).T) > max(0.003, 6 * noise))
    if len(away) and away[0] > 1:
        events.append(TrackEvent("onset", time[away[0] - 1], time[away[0]]))
    step = np.diff(time)
    moved = np.hypot(*np.diff(x, axis=0).T)
    for i in np.flatnonzero((step > max(0.1, 4 * interval)) & (moved > 0.01)).tolist():
        events.append(TrackEvent("gap", time[i], time[i + 1]))
    return sorted(events, key=lambda event: (event.low, event.high))


def _at_wall(time: Array, d: Array, wall: WallLine, noise: float) -> list[TrackEvent]:
    """Find contacts with a wall: runs of frames near it in which the ball turns."""
    step = np.abs(np.diff(d, prepend=d[0]))
    step = np.maximum(step, np.append(step[1:], 0.0))
    near = d < 0.75 * step + max(0.002, 6 * noise)
    runs = np.flatnonzero(np.diff(np.concatenate([[False], near, [False]]).astype(int))).reshape(-1, 2).tolist()
    joined: list[list[int]] = []
    reach = frames_per_side(time)
    for low, high in runs:
        if joined and low - joined[-1][1] < max(4, reach):  # noise at a high rate: no ball returns so soon
            joined[-1][1] = high
        else:
            joined.append([low, high])
    found = []
    for low, high in joined:
        i = low + int(np.argmin(d[low:high]))
        before, after = d[max(low - reach, 0) : i + 1].max() - d[i], d[i : high + reach].max() - d[i]
        if 0 < i < len(d) - 1 and min(before, after) > 6 * noise:
            found.append(TrackEvent("wall", float(time[i - 1]), float(time[i + 1]), wall.name))
    return found


def position_at(track: Track, t: Array) -> Array:
    """Interpolate positions of a ball linearly between rows; it rests during a gap in which it did not move."""
    time, x = track.time, track.position
    found = np.stack([np.interp(t, time, x[:, k]) for k in (0, 1)], axis=-1)
    step = np.diff(time)
    way = np.hypot(*np.diff(x[:, :2], axis=0).T)
    speed = way / np.maximum(step, 1e-6)
    for i in np.flatnonzero(step > max(0.05, 2.5 * float(np.median(step)))).tolist():
        after = speed[i + 1 : i + 4].max(initial=0.0)
        if way[i] < after * step[i] / 2 or after == 0:
            found[(t > time[i]) & (t < time[i + 1])] = x[i, :2]
    return found


def _ball_meetings(track: Track, other: Track, radii: float, interval: float) -> list[TrackEvent]:
    """Find when two balls touch, or pass so close that the frames cannot exclude it."""
    if len(other.time) < 2:
        return []
    t = np.union1d(track.time, other.time)
    gap = position_at(track, t) - position_at(other, t)
    step = np.diff(gap, axis=0)
    share = np.clip(-(gap[:-1] * step).sum(axis=1) / np.maximum((step * step).sum(axis=1), 1e-12), 0, 1)
    closest = np.hypot(*(gap[:-1] + share[:, None] * step).T)
    # a ball that turns back between two frames may have been closer than both by half its step
    slack = TOUCH_DISTANCE_M + 0.5 * np.hypot(*step.T) * _bends(gap, t)
    near = closest < radii + slack
    edges = np.flatnonzero(np.diff(np.concatenate([[False], near, [False]]).astype(int))).reshape(-1, 2)
    return [
        TrackEvent("ball", float(t[low]) - interval / 4, float(t[high]) + interval / 4, other.name)
        for low, high in edges.tolist()
    ]


def _bends(gap: Array, t: Array) -> Array:
    """Return (n - 1,): 1 for steps beside which the balls' relative velocity changes by more than a third, else 0."""
    step = np.diff(gap, axis=0) / np.maximum(np.diff(t), 1e-6)[:, None]
    change = np.hypot(*np.diff(step, axis=0).T)
    size = np.maximum(np.hypot(*step[:-1].T), np.hypot(*step[1:].T))
    bend = (change > 0.35 * size) & (change > 0.05)
    found = np.zeros(len(step))
    found[1:] += bend
    found[:-1] += bend
    return np.asarray(np.minimum(found, 1.0))
