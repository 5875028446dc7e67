"""A filmed shot for a fit: all balls at the times of the frames, what was measured, and the events that the film shows."""

from __future__ import annotations

import functools
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.errors import Fault, FaultList
from carom.fitting.table_numbers import reach_of
from carom.formatting import counted
from carom.scene.shapes import Table
from carom.tracks.clock import on_camera_clock
from carom.tracks.events import (
    TOUCH_DISTANCE_M,
    TrackEvent,
    WallLine,
    find_events,
    find_walls,
    frames_per_side,
    position_at,
    turning_points,
)
from carom.tracks.preprocess import initial_noise, rounding_step, without_outliers
from carom.tracks.track import Track

Array = NDArray[np.float64]
LEAST_WAY = 0.003  # m from its first place, from which on a ball counts as moving
REST_FRAMES = 2.5  # frames without a row, in which a ball that has not moved was at rest
REST_WAY = 0.002  # m
OFF_TABLE = 0.05  # m beyond the line of a cushion: no ball of this table
GRAVITY = 9.80665
SIDES = (("left", 0, -1), ("right", 0, 1), ("bottom", 1, -1), ("top", 1, 1))


class FilmedEvent(NamedTuple):
    """An event that the film shows: it lies between two times, s."""

    low: float
    high: float
    kind: str
    """ball, or wall."""
    ball: int
    other: str
    """Name of the other ball, or of the wall."""


@dataclass(frozen=True, eq=False)
class FilmedShot:
    """All balls of a shot at the times of the frames."""

    name: str
    balls: tuple[str, ...]
    """The ball that the cue strikes first."""
    time: Array
    """(T,) s"""
    position: Array
    """(T, B, 2) m; NaN where a ball has no row."""
    measured: NDArray[np.bool_]
    """(T, B): rows of the film; the others are of a ball at rest between two rows, or missing."""
    first: Array
    """(B, 2) m: where the balls lie before the stroke."""
    set_off: tuple[float, float]
    """s: between these times the cue ball sets off."""
    events: tuple[FilmedEvent, ...]
    """In the order of time."""

    @functools.cached_property
    def known(self) -> NDArray[np.bool_]:
        """(T, B): where the place of a ball is known."""
        return np.asarray(np.isfinite(self.position[:, :, 0]))

    def frames_until(self, t: float) -> int:
        """Return how many frames there are before a time."""
        return int(np.searchsorted(self.time, t))

    @property
    def horizons(self) -> dict[str, int]:
        """Numbers of frames by name: to the first event after the first ball (``ball``), before the cue ball's cushions after that
        one by one (``cushion 1``: until its second), and ``whole``."""
        met = [one for one in self.events if one.kind == "ball"]
        found: dict[str, int] = {}
        if met:
            later = [one.low for one in self.events if one.low > met[0].high]
            found["ball"] = self.frames_until(later[0]) if later else len(self.time)
            mine = [one.low for one in self.events if one.kind == "wall" and one.ball == 0 and one.low > met[0].low]
            for k, t in enumerate(mine[1:4], 1):
                found[f"cushion {k}"] = self.frames_until(t)
        return found | {"whole": len(self.time)}


class Films(NamedTuple):
    """All shots of a table."""

    shots: list[FilmedShot]
    walls: tuple[WallLine, ...]
    """Lines at which centres turn."""
    noise: float
    """m, of one coordinate of one frame."""
    notes: list[str]


def filmed_shots(tracks: Sequence[Track], radius: float) -> Films:
    """Return the shots of films of one table; CaromError, one line per problem, for films that show no shot."""
    notes: list[str] = []
    seen, interval = on_camera_clock(tracks, notes)
    seen = without_outliers(seen, interval, GRAVITY, notes)
    step = (rounding_step([t.position[:, 0] for t in seen]), rounding_step([t.position[:, 1] for t in seen]))
    noise = initial_noise(seen, interval, step)
    groups: dict[str, list[Track]] = {}
    for track in seen:
        groups.setdefault(track.group, []).append(track)
    faults = FaultList()
    _require_one_table(groups, noise, 2 * radius, faults)
    walls = tuple(find_walls(seen, noise))
    shots = []
    for name, members in groups.items():
        shot = _shot(name, members, walls, noise, radius, interval, notes, faults)
        if shot is not None:
            shots.append(shot)
    faults.raise_if_any()
    return Films(shots, walls, noise, notes)


def _require_one_table(groups: dict[str, list[Track]], noise: float, radii: float, faults: FaultList) -> None:
    """Report films that go on where the balls of all other films turn back: they are of another table, or scale.

    The other films have a cushion where a ball turns, away from other balls, at the farthest place that any reaches.
    """
    for name, members in groups.items():
        others = [one for group, some in groups.items() if group != name for one in some]
        for side, axis, sign in SIDES:
            if not others:
                continue
            edge = max(float((sign * one.position[:, axis]).max()) for one in others)
            far = max(float((sign * one.position[:, axis]).max()) for one in members) - edge
            if far > OFF_TABLE and any(_turns_at(one, others, axis, sign, edge, noise, radii) for one in others):
                faults.append(Fault(name or "film", "", "balls on the table of the other films", _beyond(far, side)))
                break


def _beyond(far: float, side: str) -> str:
    return f"places {far:.2f} m beyond its {side} cushion: is it another table, scale or origin?"


def require_on_table(shots: Sequence[FilmedShot], wall: Table, radius: float) -> None:
    """Raise CaromError, one line per shot, for films that reach beyond the cushions of the table that is given."""
    faults, reach = FaultList(), reach_of(radius, wall.nose_height)
    half, middle = np.array([wall.length, wall.width]) / 2 - reach, np.array(wall.center)
    for shot in shots:
        away = (shot.position - middle)[shot.known]
        for side, axis, sign in SIDES:
            far = float((sign * away[:, axis]).max() - half[axis])
            if far > OFF_TABLE:
                faults.append(Fault(shot.name or "film", "", "balls on the table that is given", _beyond(far, side)))
                break
    faults.raise_if_any()


def _turns_at(
    track: Track, others: Sequence[Track], axis: int, sign: int, edge: float, noise: float, radii: float
) -> bool:
    """Return whether a ball turns back within a ball's width of a line, away from the other balls of its film."""
    d = edge - sign * track.position[:, axis]
    for i in turning_points(d, noise, frames_per_side(track.time)).tolist():
        if d[i] < OFF_TABLE:
            step = float(np.hypot(*np.diff(track.position[i - 1 : i + 1], axis=0)[0]))
            near = [
                np.hypot(*(position_at(one, track.time[i : i + 1])[0] - track.position[i]))
                for one in others
                if one is not track and one.group == track.group
            ]
            if min(near, default=np.inf) > radii + TOUCH_DISTANCE_M + step:
                return True
    return False


def _shot(
    name: str, members: list[Track], walls: Sequence[WallLine], noise: float, radius: float, interval: float, notes: list[str],
    faults: FaultList,
) -> FilmedShot | None:  # fmt: skip
    label = name or "film"
    onset = {one.name: _onset(one, noise) for one in members}
    moving = [one for one in members if onset[one.name] is not None]
    if not moving:
        faults.append(Fault(label, "", "a stroke", f"{counted(len(members), 'ball')} at rest in all frames"))
        return None
    order = sorted(moving, key=lambda one: (one.time[onset[one.name]], -_first_way(one, onset[one.name])))
    cue = order[0]
    begins = float(cue.time[onset[cue.name] or 0])
    for other in order[1:]:
        if other.time[onset[other.name]] < begins + 0.5 * interval and not _touches(cue, other, radius):
            apart = f"{np.hypot(*(cue.position[0] - other.position[0])):.2f} m apart"
            moving_both = f"{cue.name} and {other.name} in motion from the first frame on, {apart}"
            got = f"{moving_both}: the film begins in the middle of a shot"
            faults.append(Fault(label, "", "one ball that sets off first", got, "begin it before the stroke"))
            return None
    still = [one for one in members if onset[one.name] is None]
    notes += [f"{label}: {one.name} is never seen to move: taken to lie at rest" for one in still]
    balls = [cue, *(one for one in members if one is not cue)]
    time = np.unique(np.concatenate([one.time for one in balls]))
    time = time[np.diff(time, prepend=-np.inf) > 0.25 * interval]
    position, measured = np.full((len(time), len(balls), 2), np.nan), np.zeros((len(time), len(balls)), bool)
    for k, one in enumerate(balls):
        _fill(one, k, time, position, measured, interval, walls)
    i = onset[cue.name] or 0
    since = float(cue.time[i - 1]) if i > 0 else begins - interval
    events = _events(balls, walls, noise, radius, interval)
    return FilmedShot(
        name, tuple(one.name for one in balls), time, position, measured, np.array([one.position[0] for one in balls]),
        (since, begins), tuple(events),
    )  # fmt: skip


def _onset(track: Track, noise: float) -> int | None:
    """Return the first row in which a ball has left its first place; None if it never does."""
    away = np.flatnonzero(np.hypot(*(track.position - track.position[0]).T) > max(LEAST_WAY, 6 * noise))
    return int(away[0]) if len(away) else None


def _first_way(track: Track, row: int | None) -> float:
    return float(np.hypot(*(track.position[row or 0] - track.position[0])))


def _touches(one: Track, other: Track, radius: float) -> bool:
    """Return whether the first ball can have hit the second within its first two steps."""
    reach = np.hypot(*np.diff(one.position[:3], axis=0).T).sum() + 2 * radius + TOUCH_DISTANCE_M
    return bool(np.hypot(*(one.position[0] - other.position[0])) < reach)


def _fill(
    track: Track,
    k: int,
    time: Array,
    position: Array,
    measured: NDArray[np.bool_],
    interval: float,
    walls: Sequence[WallLine],
) -> None:
    """Write a ball's rows at the frames next to them, and its place while it was at rest."""
    rows = np.clip(np.searchsorted(time, track.time - 0.25 * interval), 0, len(time) - 1)
    good = np.ones(len(track), bool)
    for wall in walls:
        if wall.clamped:  # (the program moved them there)
            good &= np.abs(wall.frame(track.position)[:, 0]) > 1e-9
    position[rows[good], k] = track.position[good]
    measured[rows[good], k] = True
    if np.hypot(*(track.position - track.position[0]).T).max() < REST_WAY:
        position[~measured[:, k], k] = track.position[0]
        return
    steps, way = np.diff(track.time), np.hypot(*np.diff(track.position, axis=0).T)
    speed = way / np.maximum(steps, 1e-9)
    for i in np.flatnonzero(steps > REST_FRAMES * interval).tolist():
        after = float(speed[i + 1 : i + 4].max(initial=0.0))
        if way[i] < max(REST_WAY, min(after * interval * 1.5, after * steps[i] / 2)):
            inside = (time > track.time[i]) & (time < track.time[i + 1] - 1.5 * interval) & ~measured[:, k]
            position[inside, k] = track.position[i]


def _events(
    balls: Sequence[Track], walls: Sequence[WallLine], noise: float, radius: float, interval: float
) -> list[FilmedEvent]:
    found = []
    for k, one in enumerate(balls):
        others = [other for other in balls if other is not one]
        for event in find_events(one, others, walls, noise, 2 * radius, interval):
            pair = event.kind == "ball" and [other.name for other in balls].index(event.what) > k
            if pair and _velocity_changes(
                event, one, next(other for other in balls if other.name == event.what), noise
            ):
                found.append(FilmedEvent(event.low, event.high, "ball", k, event.what))
            elif event.kind == "wall":
                found.append(FilmedEvent(event.low, event.high, "wall", k, event.what))
    return sorted([*found, *_struck_between_frames(balls, found, noise, interval)])


def _struck_between_frames(
    balls: Sequence[Track], found: Sequence[FilmedEvent], noise: float, interval: float
) -> list[FilmedEvent]:
    """Return contacts of which the film shows only that a ball at rest sets off: the nearest ball that moves has met it then."""
    more, since = [], [_onset(one, noise) for one in balls]
    for k, (one, row) in enumerate(zip(balls, since, strict=True)):
        if k == 0 or not row or row + 1 == len(one):
            continue
        way, step = (
            np.hypot(*(one.position[row] - one.position[0])),
            np.hypot(*(one.position[row + 1] - one.position[row])),
        )
        # (with the speed that it has afterwards)
        t = float(one.time[row] - way / max(step, 1e-9) * (one.time[row + 1] - one.time[row]))
        low, high = max(t - interval, float(one.time[row - 1])), min(t + interval, float(one.time[row]))
        moves = [i for i, at in enumerate(since) if i != k and at is not None and balls[i].time[at] < high]
        met = [event for event in found if event.kind == "ball" and one.name in (balls[event.ball].name, event.other)]
        if low < high and moves and not any(event.low <= float(one.time[row]) for event in met):
            near = min(
                moves, key=lambda i: float(np.hypot(*(position_at(balls[i], np.array([t]))[0] - one.position[0])))
            )
            first, second = sorted((k, near))
            more.append(FilmedEvent(low, high, "ball", first, balls[second].name))
    return more


def _velocity_changes(event: TrackEvent, one: Track, other: Track, noise: float) -> bool:
    """Return whether a pass is a contact: the velocity of a ball changes by more than cloth and noise explain."""
    for track in (one, other):
        before = np.flatnonzero(track.time <= event.low)[-4:]
        after = np.flatnonzero(track.time >= event.high)[:4]
        if len(after) < 2:
            continue
        v = (track.position[after[-1]] - track.position[after[0]]) / (track.time[after[-1]] - track.time[after[0]])
        rested = len(before) < 2 or track.time[before[-1]] - track.time[before[-2]] > 0.2
        u = np.zeros(2)
        if not rested:
            u = (track.position[before[-1]] - track.position[before[0]]) / (
                track.time[before[-1]] - track.time[before[0]]
            )
        if np.hypot(*(v - u)) > 0.1 + 0.15 * max(np.hypot(*u), np.hypot(*v)):
            return True
    return False
