"""Events of a track, which separate its pieces of free motion: contacts with walls and balls, gaps, start and end."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.errors import CaromError
from carom.tracks.least_squares import ContactFit
from carom.tracks.track import Track

Array = NDArray[np.float64]
TURN_TIME_S = 0.06  # within which a ball has to turn visibly
# Between surfaces: a closer pass counts as a contact of two balls, since the frames cannot exclude it
TOUCH_DISTANCE_M = 0.010
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


# ----------------------------------------------------------------------------------------------------
# Frames beside a contact that belong to it: the frames of one flight, and a turn within a frame.
#
# A bounce that is too low, too short or cut off by the end of the film is not found as an event. A ball in flight that leaves
# the wall with v_n is back after 2 v_n/g_n, g_n the acceleration toward the wall: whatever the film shows later is another
# flight.
#
# At a wall the velocity jumps. On a curved rail, or at the end of a string, it turns in a smooth curve, and a fit of two free
# motions finds a contact where there is none. The jump that the frames near it show, beside a smooth curve, is then far less than
# the one of the fit.


MIN_FRAMES = 3  # that determine a flight under a known gravity
ERRORS = 3.0  # standard deviations by which the ball has to be late
# The jump of the velocity is sought within this time on each side: a soft ball is in contact for up to 20 ms, a table's cloth and
# the air bend the paths little in it. With noise, or few frames, within a longer one, until its share has this error.
JUMP_S, JUMP_FRAMES, GROWTH, SHARE_ERROR = 0.06, 6, 1.4, 0.07
SMOOTH, CERTAIN = 0.5, 3.0  # share of the jump up to which there is none, if it is so many error bars below


def flight_ends(s: Array, d: Array, pull: float, noise: float, interval: float) -> float:
    """Return how long after a contact the ball is back at the wall, s, if frames show it later than that; else infinity.

    Parameters
    ----------
    s, d : (n,) s and m
        Times since the contact, growing from 0, and distances from the wall.
    pull : float
        Acceleration toward the wall, m/s^2.
    noise, interval : float
        Of a coordinate, m; between frames, s.

    Examples
    --------
    A ball that rises at 1 m/s is back after 0.2 s, and bounces once more:

    >>> import numpy as np
    >>> from carom.tracks.events import flight_ends
    >>> s = np.arange(60) / 200
    >>> d = np.where(s < 0.2, s - 5 * s**2, 0.4 * (s - 0.2) - 5 * (s - 0.2) ** 2)
    >>> round(flight_ends(s, d, 10.0, 1e-4, 1 / 200), 2)
    0.2
    >>> flight_ends(s[:40], d[:40], 10.0, 1e-4, 1 / 200)
    inf
    """
    sure = s > 0.99 * interval  # (the frame nearest to the contact may lie before it)
    s, d = s[sure], d[sure]
    if not pull > 0 or len(s) <= MIN_FRAMES:
        return np.inf
    # d + pull/2 s^2 is a straight line in one flight: its slope from the first k frames, for every k
    y, k = d + pull / 2 * s * s, np.arange(1, len(s) + 1)
    s1, s2, y1, sy = np.cumsum(s), np.cumsum(s * s), np.cumsum(y), np.cumsum(s * y)
    spread = np.maximum(s2 - s1 * s1 / k, 1e-300)
    back = 2 * (sy - s1 * y1 / k) / spread / pull
    error = 2 * noise / np.sqrt(spread) / pull
    latest = np.where((k >= MIN_FRAMES) & (s < back), back + ERRORS * error + interval, np.inf)
    best = int(np.argmin(latest))
    # below its line, as below a higher stair, there is no wall
    passes = d[s > back[best]].min(initial=np.inf) < min(d[0], 0.0) - BEYOND_WALL_M
    return np.inf if passes or not s[-1] > latest[best] else float(back[best])


class VelocityJump(NamedTuple):
    """The jump of the velocity that frames near a contact show, as a share of the jump of its fit."""

    share: float
    error: float

    @property
    def smooth(self) -> bool:
        """Whether the path turns smoothly there."""
        return self.share + CERTAIN * self.error < SMOOTH

    @property
    def sharp(self) -> bool:
        """Whether the velocity jumps there."""
        return self.share - CERTAIN * self.error > SMOOTH


def velocity_jump(time: Array, position: Array, fit: ContactFit, noise: float, interval: float) -> VelocityJump:
    """Return how much of the jump of the velocity at a contact the frames near it show beside a smooth curve.

    The curve is a cubic; across the contact its slope and its curvature may jump. The jump of its slope in the measured positions
    is compared with the one in the fitted positions at the same times: a ball that slides for two frames after the wall has, over
    twelve frames, another jump than at the wall. ``time``, ``position``: (n,) s and (n, 2) m, frames of the fit, in the frame of
    the wall; ``noise``: from frame to frame, m.
    """
    change = np.array([fit["vn_out"] - fit["vn_in"], fit["vt_out"] - fit["vt_in"]])
    along = change / max(float(np.hypot(*change)), 1e-12)
    t, y = time - fit["t"], np.stack([position, fit.position(time)], axis=-1).transpose(0, 2, 1) @ along
    most = max(-float(t[0]), float(t[-1]))
    span, found = max(JUMP_S, JUMP_FRAMES * interval), VelocityJump(np.nan, np.inf)
    while True:
        rows = np.abs(t) <= span
        u = t[rows] / span
        after = np.maximum(u, 0.0)
        columns = np.stack([u**0, u, u**2, u**3, after**2, after], axis=-1)
        if min((u < 0).sum(), (u >= 0).sum()) >= JUMP_FRAMES - 1 and len(u) > columns.shape[1]:
            solved = np.linalg.lstsq(columns, y[rows], rcond=None)[0]
            gap = y[rows, 0] - columns @ solved[:, 0]
            scatter = max(noise, float(np.sqrt(gap @ gap / (len(u) - columns.shape[1]))))
            inverse = np.linalg.pinv(columns.T @ columns, hermitian=True)
            seen, fitted = solved[-1].tolist()
            size = abs(fitted) + 1e-300
            found = VelocityJump(float(seen * np.sign(fitted) / size), scatter * float(np.sqrt(inverse[-1, -1])) / size)
        if found.error < SHARE_ERROR or span >= most:
            return found
        span *= GROWTH
