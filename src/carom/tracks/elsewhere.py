"""Bounces of a ball filmed from the side that are at none of the walls: on a stair, a hand, a stone."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.errors import shortened_list
from carom.formatting import counted
from carom.tracks.camera import is_oblique
from carom.tracks.contact import TrackContact
from carom.tracks.events import BEYOND_WALL_M, TrackEvent, WallLine, frames_per_side, turning_points
from carom.tracks.plausibility import impossible
from carom.tracks.track import Track

Array = NDArray[np.float64]

NOT_LEVEL = "a bounce away from the wall, on a surface that moves or is not level; give its line by two points (`wall` x1,y1,x2,y2)"
# A turn within this time of another event is that event; more than so many frames apart, frames are missing; in a longer gap the
# ball may have bounced twice; frames of flights that are to meet, their scatter in units of the noise, and how near they come
SAME_FRAMES, SAME_S, LOST_FRAMES, MAX_LOST_S, MAX_LOST_FRAMES = 2.5, 0.03, 1.6, 0.1, 6.5
MEETING_FRAMES, MIN_MEETING, MAX_SCATTER, MAX_APART_M = 16, 3, 4.0, 0.01
MOST_DRAG = 0.15  # 1/m, of a table-tennis ball
MIN_BACK_M = 0.005  # by which a ball turns back from an upright wall
NEAR_WALL_M = 0.01  # a wall that gives way, or a line that was given a little off
LEVEL = 0.5  # component of a normal that points down, from which a wall is a ceiling, or a floor seen from below


class Turn(NamedTuple):
    """A place where a ball in flight turns upward."""

    row: int
    """Number of the lowest frame."""
    low: float
    high: float
    """It lies between these times, s."""
    place: tuple[float, float]
    """Where the flights before and after it meet, m; where they do not, or are not seen, the lowest place seen."""
    lost: bool
    """Whether frames are missing there."""
    meets: bool
    """Whether the flights meet."""

    @property
    def time(self) -> float:
        """Between both times, s."""
        return (self.low + self.high) / 2


def find_turns(track: Track, noise: float, down: tuple[float, float], gravity: float, interval: float) -> list[Turn]:
    """Find where a ball turns upward, also where the frames at the turn are missing."""
    t, x = track.time, track.position
    reach = frames_per_side(t)
    height = -x @ np.array(down)
    gap = np.flatnonzero(np.diff(t) > LOST_FRAMES * interval)
    edges = np.where(
        height[gap] < height[gap + 1], gap, gap + 1
    )  # (where no minimum is seen the flights may meet all the same)
    edges = edges[(edges > 0) & (edges < len(t) - 1)]
    turned = set(turning_points(height, noise, reach).tolist())
    rows: list[int] = []
    for i in np.union1d([*turned], edges).astype(int).tolist():
        if rows and i - rows[-1] < max(3, reach // 2) and not {i, rows[-1]} <= set(edges.tolist()):
            both = {i, rows[-1]}
            rows[-1] = min(rows[-1], i, key=height.__getitem__)  # noise at a high rate: one turn
            turned |= {rows[-1]} if turned & both else set()
        else:
            rows.append(i)
    # the frame before which the ball turns, where frames are missing on a side of the lowest one; else the lowest is left out
    before = [i - 1 if t[i] - t[i - 1] > t[i + 1] - t[i] else i for i in rows]
    lost = [bool(t[k + 1] - t[k] > LOST_FRAMES * interval) for k in before]
    found = []
    for n, (i, k) in enumerate(zip(rows, before, strict=True)):
        first, last = (k + 1, k + 1) if lost[n] else (i, i + 1)
        since = before[n - 1] + 1 if n else 0
        until = before[n + 1] + lost[n + 1] if n + 1 < len(rows) else len(t)
        sides = np.arange(since, first)[-MEETING_FRAMES:], np.arange(last, until)[:MEETING_FRAMES]
        pull = np.array(down) * gravity
        place = None
        if not lost[n] or t[k + 1] - t[k] < max(MAX_LOST_S, MAX_LOST_FRAMES * interval):
            place = _meeting(t, x, sides, pull, noise, interval)
        if place is None and i not in turned and not _gains(t, height, sides, gravity, noise):
            continue
        low, high = (float(t[k]), float(t[k + 1])) if lost[n] else (float(t[i - 1]), float(t[i + 1]))
        where = (float(x[i, 0]), float(x[i, 1]))
        if place is not None and lost[n]:  # (frames missing are no time during which something else could happen)
            low, high = max(low, place[0] - interval / 2), min(high, place[0] + interval / 2)
        found.append(Turn(i, low, high, place[1] if place is not None else where, lost[n], place is not None))
    return found


def _gains(
    t: Array, height: Array, sides: tuple[NDArray[np.intp], NDArray[np.intp]], gravity: float, noise: float
) -> bool:
    """Return whether a ball moves upward after a gap more than before it, beyond its fall: it has been hit meanwhile.

    After what is a flight for certain, the fall is known, up to what the air may hold back; else, as where a ball lay still or was
    held, none is taken off.
    """
    if min(map(len, sides)) < 2:
        return False
    zero, gap = float(t[sides[1][0]]), float(t[sides[1][-1]] - t[sides[0][0]])
    fits, certain = [], []
    for rows in (sides[0][::-1], sides[1]):
        for count in (MEETING_FRAMES, MEETING_FRAMES // 2, MEETING_FRAMES // 4):  # (of them other contacts may follow)
            s, y = t[rows[:count]] - zero, height[rows[:count]]
            straight, falls = _line(s, y), _line(s, y + gravity / 2 * s * s)
            scatter = falls[2] / max(len(s) - 2, 1)
            if scatter < (MAX_SCATTER * noise) ** 2:
                break
        fits.append((straight, falls))
        certain.append(len(s) > 3 and straight[2] - falls[2] > 25 * min(scatter, noise**2))
    (before, per, _), (after, and_per, _) = (fit[certain[0]] for fit in fits)
    held = gap * min(gravity, MOST_DRAG * before[1] ** 2) if certain[0] else 0.0
    return bool(after[1] - before[1] > held + 5 * noise * np.sqrt(per[1, 1] + and_per[1, 1]))


def _line(s: Array, y: Array) -> tuple[Array, Array, float]:
    """Return value at 0 and slope of a straight line through y(s), their covariance by that of y, and the sum of squares left."""
    columns = np.stack([np.ones_like(s), s], axis=-1)
    inverse = np.linalg.inv(columns.T @ columns)
    line = inverse @ columns.T @ y
    return line, inverse, float(np.square(y - columns @ line).sum())


def _meeting(
    t: Array, x: Array, sides: tuple[NDArray[np.intp], NDArray[np.intp]], pull: Array, noise: float, interval: float
) -> tuple[float, tuple[float, float]] | None:
    """Return when and where two flights meet; None if they are too short, are none, or do not meet between them."""
    if min(map(len, sides)) < MIN_MEETING:
        return None
    zero = float(t[sides[1][0]])
    lines, errors = [], []
    for rows in sides:  # without the fall a flight is a straight line
        s = t[rows] - zero
        line, inverse, left = _line(s, x[rows] - pull * (s * s / 2)[:, None])
        scatter = float(np.sqrt(left / max(2 * len(s) - 4, 1)))
        if scatter > MAX_SCATTER * noise:
            return None
        lines.append(line)
        errors.append(inverse * max(scatter, noise) ** 2)
    up = -pull / np.hypot(*pull)
    gain = float((lines[1][1] - lines[0][1]) @ up)
    if gain < 5 * float(np.sqrt(errors[0][1, 1] + errors[1][1, 1])):
        return None
    since = float((lines[0][0] - lines[1][0]) @ up) / gain
    both = [line[0] + line[1] * since + pull * (since * since / 2) for line in lines]
    spread = sum(e[0, 0] + 2 * e[0, 1] * since + e[1, 1] * since * since for e in errors)
    if not float(t[sides[0][-1]]) - interval < zero + since < zero + interval:
        return None
    if np.hypot(*(both[1] - both[0])) > MAX_APART_M + 5 * float(np.sqrt(spread)):
        return None
    middle = (both[0] + both[1]) / 2
    return zero + since, (float(middle[0]), float(middle[1]))


def floor_of_turns(walls: Sequence[WallLine], turns: Sequence[Turn], down: tuple[float, float]) -> tuple[WallLine, ...]:
    """Return the walls with the floor where flights meet, if frames are missing there, or if the lowest place is no bounce."""
    known = {wall.name: wall for wall in walls}
    up, met = -np.array(down), [turn for turn in turns if turn.meets and (turn.lost or "bottom" not in known)]
    if not met:
        return tuple(walls)
    lowest = min(met, key=lambda turn: float(up @ turn.place))
    if "bottom" in known and known["bottom"].frame(np.array([lowest.place]))[0, 0] > 0:
        return tuple(walls)
    known["bottom"] = WallLine("bottom", lowest.place, (float(up[0]) + 0.0, float(up[1]) + 0.0))
    return tuple(known.values())


def with_turns(
    events: list[TrackEvent], track: Track, walls: Sequence[WallLine], noise: float, down: tuple[float, float],
    turns: Sequence[Turn], interval: float,
) -> list[TrackEvent]:  # fmt: skip
    """Return the events of a ball in flight with all its turns: each is a contact with a wall, or ends a flight (``turn``).

    A turn away from the walls is a bounce on level ground where the floor was found, not given: on a stair, or on a floor that is
    seen from above, so that bounces nearer to the camera lie lower. Contacts far beyond the line of their wall are left out: they
    are bounces on a lower stair, below the line of a higher one.
    """
    t, x = track.time, track.position
    # it may have turned as far below as the longer of the steps beside (the shorter one may bridge the contact)
    height = -x @ np.array(down)
    step = np.abs(np.diff(height, prepend=height[:1], append=height[-1:]))
    reach = np.maximum(NEAR_WALL_M, 6 * noise + np.maximum(step[:-1], step[1:]))
    places = {wall.name: wall.frame(x)[:, 0] for wall in walls}

    def at_its_wall(event: TrackEvent) -> bool:
        i = min(int(np.searchsorted(t, (event.low + event.high) / 2)), len(t) - 1)
        return bool(places[event.what][i] > -reach[i] - BEYOND_WALL_M)

    kept = [event for event in events if event.kind != "wall" or at_its_wall(event)]
    near = max(SAME_FRAMES * interval, SAME_S)
    level = next((wall for wall in walls if wall.found and wall.name == "bottom"), None)
    for turn in turns:
        i = turn.row
        away = all(abs(d[i]) > reach[i] for d in places.values())
        if turn.lost and turn.meets:  # nothing else can have happened meanwhile
            kept = [one for one in kept if one.kind != "gap" or one.high <= turn.low or one.low >= turn.high]
        if (turn.lost or not away) and _has(kept, turn.time, near):
            continue
        at = [
            wall.name for wall in walls
            if (turn.meets or not away) and abs(wall.frame(np.array([turn.place]))[0, 0]) < NEAR_WALL_M + 6 * noise
        ]  # fmt: skip
        if at:
            kept.append(TrackEvent("wall", turn.low, turn.high, at[0]))
        elif level is not None and turn.meets:
            kept.append(TrackEvent("wall", turn.low, turn.high, level.name, turn.place))
        else:
            kept.append(TrackEvent("turn", turn.low, turn.high, _in_words(turn.place)))
    across = x @ np.array([-down[1], down[0]])
    for d in (across, -across):  # in flight nothing but an upright wall turns a ball back
        for i in turning_points(d, max(noise, MIN_BACK_M / 6), frames_per_side(t)).tolist():
            if not _has(kept, float(t[i]), near):
                kept.append(TrackEvent("turn", float(t[i - 1]), float(t[i + 1]), _in_words((x[i, 0], x[i, 1]))))
    return sorted(kept, key=lambda event: (event.low, event.high))


def _has(events: Sequence[TrackEvent], time: float, near: float) -> bool:
    """Return whether a contact or a turn is so near to a time, s."""
    return any(
        event.kind in ("wall", "turn", "ball") and event.low - near < time < event.high + near for event in events
    )


def _in_words(place: tuple[float, float]) -> str:
    return f"({place[0]:.3f}, {place[1]:.3f})"


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


def elsewhere_notes(events: Iterable[TrackEvent], several: bool, lost: int) -> list[str]:
    """Return notes on bounces away from the wall, or from all ``several`` walls, and on ``lost`` ones whose frames are missing."""
    some = list(events)
    notes = []
    for found, how in (
        ([event.what for event in some if event.kind == "turn"], "not measured"),
        ([_in_words(event.place) for event in some if event.place is not None], "taken to be on level ground"),
    ):
        if found:
            count, are = ("1 bounce", "is") if len(found) == 1 else (f"{len(found)} bounces", "are")
            notes.append(
                f"{count} away from the wall{'s' * several}, at (x, y) = {shortened_list(found, 4)} m, {are} {how}: `wall` y=0.1"
                " or `wall` x1,y1,x2,y2 names the line at which the ball's centre turns there"
            )
    if lost:
        notes.append(
            f"frames are missing at {counted(lost, 'bounce')}: they are where the flights before and after them meet"
        )
    return notes


def only_level(contacts: Sequence[TrackContact], walls: Sequence[WallLine], k: float) -> list[TrackContact]:
    """Return the contacts without those away from the walls that no level ground at rest explains."""
    return [
        replace(one, fit=None, why=NOT_LEVEL)
        if one.fit is not None and one.wall not in walls and (impossible(one) or is_oblique(one.fit, k))
        else one
        for one in contacts
    ]
