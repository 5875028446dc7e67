"""A filmed shot, and the search for its start."""

from __future__ import annotations

import functools
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.errors import Fault, FaultList
from carom.fitting.table_numbers import TableNumbers, balls_by, balls_of, nearest_starts, reach_of, states_by
from carom.formatting import counted
from carom.scene.shapes import Table
from carom.simulation.sensitivity.sensitivity import Limits, states_at
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
from carom.tracks.preprocess import prepared
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
    seen, groups, interval, _step, noise = prepared(tracks, GRAVITY, notes)
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


# ----------------------------------------------------------------------------------------------------
# The start of a shot: its numbers, its prior, and the residuals of a film from there.


TIME, VELOCITY, SPIN, FIRST_PLACE = 0, slice(1, 3), slice(3, 6), 6
LIMITS = Limits(rows=768, events=400)
UNKNOWN = 0.3  # m between frame and ball, where the model has no state
# Widths of priors: spin in v/a (about the horizontal axis of rolling and about the way of the ball, sideways), places in m
FOLLOW, FOLLOW_WIDTH, SWERVE_WIDTH, SIDE_WIDTH = 0.4, 0.7, 0.2, 0.7
CUE_PLACE, OBJECT_PLACE = 1e-3, 5e-4


def start_size(balls: int) -> int:
    """Return how many numbers a start has: the time (s), velocity (m/s), spin times radius (m/s), places (m)."""
    return FIRST_PLACE + 2 * balls


class StartPrior(NamedTuple):
    """A normal prior of a start: rows times (start - centre) are of unit width.

    After its own numbers a start may have those by which the table differs for this shot, normal about zero.
    """

    center: Array
    rows: Array

    def with_scatter(self, balls: int, widths: Array) -> StartPrior:
        """Return the prior with deviations of the table's numbers, of such widths (R,), after the start's own numbers."""
        k = start_size(balls)
        center, rows = np.zeros(k + len(widths)), np.zeros((k + len(widths),) * 2)
        center[:k], rows[:k, :k] = self.center[:k], self.rows[:k, :k]
        rows[range(k, len(rows)), range(k, len(rows))] = 1 / widths
        return StartPrior(center, rows)

    @classmethod
    def of(cls, shot: FilmedShot, velocity: Array, noise: float) -> StartPrior:
        """Return the prior for a ball that leaves about with a velocity (2,)."""
        n = start_size(len(shot.balls))
        center, rows = np.zeros(n), np.zeros((n, n))
        speed = max(float(np.hypot(*velocity)), 0.05)
        along = np.asarray(velocity) / speed
        low, high = shot.set_off
        center[TIME], rows[TIME, TIME] = (low + high) / 2, 1 / max((high - low) / 2, 1e-3)
        # rolling: w = z x v / a, so that a w = (-v_y, v_x) for it
        rolling = np.array([-along[1], along[0]])
        center[3:5] = FOLLOW * speed * rolling
        rows[3, 3:5] = rolling / (FOLLOW_WIDTH * speed)
        rows[4, 3:5] = along / (SWERVE_WIDTH * speed)
        rows[5, 5] = 1 / (SIDE_WIDTH * speed)
        center[FIRST_PLACE:] = shot.first.ravel()
        for k in range(len(shot.balls)):
            for j in range(2):
                at = FIRST_PLACE + 2 * k + j
                rows[at, at] = 1 / max(CUE_PLACE if k == 0 else OBJECT_PLACE, noise)
        return cls(center, rows)


class Residuals(NamedTuple):
    """Model less film at the known frames of a shot up to a horizon."""

    gap: Array
    """(N, M) m, two for each frame and ball."""
    by_start: Array
    """(N, M, K) derivatives by the starts."""
    by_shared: Array
    """(N, M, P) derivatives by the shared numbers."""


def _by_start(balls: int, radius: float) -> Array:
    """Return the derivatives of balls by the numbers of a start, in their order (:func:`carom.fitting.table_numbers.balls_by`)."""
    velocity = [[(0, "v", j, 1.0)] for j in range(2)]
    spin = [[(0, "w", j, 1 / radius)] for j in range(3)]
    return balls_by(balls, [[], *velocity, *spin, *([(k, "x", j, 1.0)] for k in range(balls) for j in range(2))])


def starting_balls(table: TableNumbers, starts: Array, b: int) -> NDArray[np.void]:
    """Return the B balls (N, B) of starts (N, K): a shot may have fewer than others."""
    by = _by_start(b, float(table.arrays.balls["radius"][0]))
    return balls_of(table.arrays, by, starts[:, : start_size(b)])


def _gap(shot: FilmedShot, states: Array, frames: int) -> tuple[Array, NDArray[np.bool_]]:
    """Return model less film (N, frames, B, 2), and where the film is known (frames, B)."""
    known = shot.known[:frames]
    gap = states[..., :2] - np.where(known[:, :, None], shot.position[:frames], 0.0)
    return np.where(np.isnan(gap), UNKNOWN, gap), known


def _places_of(table: TableNumbers, shot: FilmedShot, starts: Array, frames: int | None = None) -> Array:
    """Return the places (N, T, B, 2) at the times of frames for starts (N, K), which may end with deviations of the table's
    numbers; NaN where the model has no state."""
    many, b = len(shot.time) if frames is None else frames, len(shot.balls)
    time = np.maximum(shot.time[None, :many] - starts[:, :1], 0.0)
    arrays = table.moved(starts[:, start_size(b) :])
    return states_at(arrays, starting_balls(table, starts, b), time, np.full(len(starts), many), 2, LIMITS)


def distances(table: TableNumbers, shot: FilmedShot, starts: Array, frames: int) -> Array:
    """Return squared distances (N, M) of the known frames up to a horizon, m^2, for starts (N, K)."""
    gap, known = _gap(shot, _places_of(table, shot, starts, frames), frames)
    return np.asarray(np.square(gap).sum(axis=-1)[:, known])


def residuals(table: TableNumbers, shot: FilmedShot, starts: Array, frames: int, shared: bool = False) -> Residuals:
    """Return model less film up to a horizon for starts (N, K), with exact derivatives by them, and on request by the shared
    numbers."""
    b, radius = len(shot.balls), float(table.arrays.balls["radius"][0])
    k, by = start_size(b), _by_start(b, radius)
    time = np.maximum(shot.time[:frames] - starts[:, TIME, None], 0.0)
    balls, own = balls_of(table.arrays, by, starts[:, :k]), starts.shape[1] > k
    known, n = shot.known[:frames], len(starts)
    at = states_by(
        table, balls, by, time, np.full(n, frames), shared=shared or own, deviations=starts[:, k:], limits=LIMITS
    )
    gap = _gap(shot, at.states, frames)[0][:, known].reshape(n, -1)
    moving = np.where(time > 0, 1.0, 0.0)[:, :, None, None]
    at.by_start[..., TIME] = -np.nan_to_num(at.states[..., 3:5] * moving)
    found = np.concatenate([at.by_start[:, known], at.by_shared[:, known]], axis=-1).reshape(*gap.shape, -1)
    found[~np.isfinite(found).all(axis=-1)] = 0.0
    return Residuals(gap, found if own else found[..., :k], found[..., k:])


# ----------------------------------------------------------------------------------------------------
# Search for the start of one shot: the horizon grows from event to event, with a few starts kept and others drawn at each.
#
# A small error of a start is a hundred times as large after three cushions, and a wrong start has local minima everywhere. So the
# frames up to the first ball come first, then those up to the next event, and so on. At each event the starts that are kept
# descend (soft-L1 loss, exact derivatives), together with the best of others, drawn about them from the region that the frames
# leave open.


FIRST_FRAMES = 6  # of the cue ball, from which its velocity is guessed
LEAST_SIGMA = 1e-3  # m: residuals below this count as noise
SIGMA_SHARE = 0.5  # of the distance so far: the error that a frame is taken to have
SIDE = 0.5  # of the speed: width of the side spin (times radius) that is drawn
LAGS, CORRELATED = 40, 0.05  # frames over which residuals are correlated, and the least correlation that counts
SOFT = 3.0  # of these, beyond which a residual counts in proportion
ALIKE = 1e-3  # m between the places of two starts, below which they are one
RECENT = 12  # starts of a pool that are tried again, where each has a table of its own
NEAR = 0.02  # m of distance (rms) at a horizon, from which on more starts are drawn, once the best have descended
AGAIN = 4  # descents with a smaller error of a frame, after the distance has become smaller
GAIN = 1e-4  # of the cost, below which a descent ends
WIDER = 3  # times, of a search for a shot that was not followed
FAILED = 0.06  # m of distance (rms) at a horizon, from which on more starts are drawn


@dataclass(frozen=True)
class SearchSettings:
    """How wide a search is."""

    beam: int = 3
    """Starts that are kept at each horizon."""
    draws: int = 120
    descents: int = 4
    evaluations: int = 9
    """Of a descent."""
    anew: float = 0.3
    """Share of the draws at an event whose side spin is any, not one near that of a start so far."""


@dataclass(eq=False)
class ShotStart:
    """The starts of a shot that fit it up to its horizons."""

    shot: FilmedShot
    prior: StartPrior
    best: dict[int, Array] = field(default_factory=dict)
    """The best start (K,) by the number of frames of a horizon."""
    pool: list[Array] = field(default_factory=list)
    """Other starts that are worth a try."""

    def with_scatter(self, widths: Array) -> ShotStart:
        """Return the starts with deviations of the table's numbers, of such widths (P,)."""
        prior = self.prior.with_scatter(len(self.shot.balls), widths)
        k = len(prior.center)
        return ShotStart(
            self.shot, prior, {n: padded([one], k)[0] for n, one in self.best.items()}, [*padded(self.pool, k)]
        )


def padded(starts: Sequence[Array], size: int) -> Array:
    """Return starts (N, size) with no deviations of the table's numbers where they have none."""
    found = np.zeros((len(starts), size))
    for row, one in zip(found, starts, strict=True):
        row[: len(one)] = one[:size]
    return found


def _guess(shot: FilmedShot) -> Array:
    """Return the velocity (2,) with which the cue ball leaves, by a line through its first frames."""
    begin = shot.frames_until(shot.set_off[1] - 1e-9)
    met = [one.low for one in shot.events]
    rows = np.flatnonzero(shot.known[:, 0] & (np.arange(len(shot.time)) >= begin))
    if met:
        before = rows[shot.time[rows] < met[0] + 1e-9]
        rows = before if len(before) >= 2 else rows[:2]
    rows = rows[:FIRST_FRAMES]
    x = shot.position[rows, 0]
    if len(rows) < 2 or np.hypot(*(x[-1] - x[0])) < 1e-3:
        step = shot.position[rows[0], 0] - shot.first[0]
        return np.asarray(step / max(shot.time[rows[0]] - shot.set_off[0], 1e-3))
    return np.asarray(np.polyfit(shot.time[rows], x, 1)[0])


def horizons(shot: FilmedShot) -> list[int]:
    """Return the numbers of frames at which a search stops: before each event, beginning with the first after the first ball."""
    named = shot.horizons
    first = named.get("ball") or next(iter(named.values()))
    found = {*(n for n in named.values()), *(shot.frames_until(one.low) for one in shot.events)}
    inside = sorted(n for n in found if n >= first)
    kept: list[int] = []
    for n in inside:
        if not kept or n >= kept[-1] + 3 or n in named.values():
            kept.append(n)
    return kept


def _first_draws(shot: FilmedShot, prior: StartPrior, velocity: Array, count: int, rng: np.random.Generator) -> Array:
    """Return starts (N, K) about the guess."""
    k, speed = start_size(len(shot.balls)), float(np.hypot(*velocity))
    found = np.tile(prior.center, (count, 1))
    turn, size = rng.normal(0, 0.012, count), rng.normal(1, 0.03, count)
    c, s = np.cos(turn) * size, np.sin(turn) * size
    found[:, 1], found[:, 2] = c * velocity[0] - s * velocity[1], s * velocity[0] + c * velocity[1]
    along = velocity / max(speed, 1e-9)
    follow, swerve = rng.normal(0.4, 0.8, count), rng.normal(0, 0.1, count)
    rolling = np.array([-along[1], along[0]])
    found[:, 3:5] = speed * (follow[:, None] * rolling + swerve[:, None] * along)
    found[:, 5] = speed * rng.normal(0, SIDE, count)
    low, high = shot.set_off
    found[:, TIME] = rng.uniform(low, high, count)
    found[:, FIRST_PLACE:k] += rng.normal(0, 3e-4, (count, k - FIRST_PLACE))
    return found


def _cost(table: TableNumbers, shot: FilmedShot, starts: Array, frames: int, prior: StartPrior, sigma: float) -> Array:
    """Return the soft-L1 costs (N,) of starts (N, K)."""
    unlikely = np.square((starts - prior.center) @ prior.rows.T).sum(axis=1)
    return np.asarray(_loss(distances(table, shot, starts, frames), sigma).sum(axis=1) + unlikely)


def _loss(squares: Array, sigma: float) -> Array:
    """Return the soft-L1 losses of squared distances, m^2."""
    return np.asarray(2 * SOFT**2 * (np.sqrt(1 + squares / (SOFT * sigma) ** 2) - 1))


def rms(table: TableNumbers, shot: FilmedShot, start: Array, frames: int) -> float:
    """Return the root mean square distance over the frames that the film has (not those of balls at rest), m."""
    known = shot.known[:frames]
    far = np.zeros(known.shape)
    far[known] = distances(table, shot, start[None], frames)[0]
    return float(np.sqrt(far[shot.measured[:frames]].mean()))


def descend(
    table: TableNumbers, shot: FilmedShot, starts: Array, frames: int, prior: StartPrior, sigma: float, evaluations: int
) -> list[tuple[Array, float, Array]]:
    """Return the nearest minima of the soft-L1 cost from starts (N, K): the start, its cost, and the information (K, K) on it."""
    own, n = start_size(len(shot.balls)), len(starts)
    scale = np.array([_scales(start, prior, own) for start in starts])

    def residual(_which: object, at: Array, derivatives: bool) -> tuple[Array, Array | None]:
        if not derivatives:
            return np.sqrt(_loss(distances(table, shot, at, frames), sigma)), None
        found = residuals(table, shot, at, frames)
        gap, (jac,) = soft(found.gap, [found.by_start], sigma)
        return gap, jac

    dof = np.full(n, 2.0 * shot.known[:frames].sum())
    center, rows = np.tile(prior.center, (n, 1)), np.tile(prior.rows, (n, 1, 1))
    best, found = nearest_starts(
        residual, starts, scale, center, rows, steps=evaluations, tolerance=GAIN * float(dof[0]), dof=dof, joint=True
    )
    information = found.information / scale[:, :, None] / scale[:, None]
    return list(zip(best, found.value.tolist(), information, strict=True))


def _scales(start: Array, prior: StartPrior, own: int) -> Array:
    scale = np.full(len(start), 1e-3)
    scale[own:] = 1 / np.diag(prior.rows)[own:]
    speed = max(float(np.hypot(*start[VELOCITY])), 0.1)
    scale[VELOCITY], scale[SPIN], scale[TIME] = 0.01 * speed, 0.1 * speed, 2e-3
    return scale


def _drawn(
    start: Array, information: Array, count: int, rng: np.random.Generator, wide: float, own: int, anew: float
) -> Array:
    """Return starts (N, K) from the region that the frames so far leave open, and wider, on the table as it is for this start."""
    information = information[:own, :own]
    size = 1 / np.sqrt(np.maximum(np.diag(information), 1e-300))
    matrix = information * size[:, None] * size
    value, vector = np.linalg.eigh(matrix)
    root = (size[:, None] * vector) / np.sqrt(np.maximum(value, 1e-9))
    width = wide * rng.choice([1.0, 3.0, 10.0], (count, 1))
    found = np.tile(start, (count, 1))
    found[:, :own] += width * (rng.normal(size=(count, own)) @ root.T)
    speed = float(np.hypot(*start[VELOCITY]))
    some = rng.random(count) < 0.3
    found[some, 5] = start[5] + speed * rng.normal(0, 0.3, int(some.sum()))
    # (before a cushion the frames hardly tell the side spin, and a start of the other sign is no minimum of theirs nearby)
    if anew:
        some = rng.random(count) < anew
        found[some, 5] = speed * rng.normal(0, SIDE, int(some.sum()))
    return np.asarray(found)


def _distinct(
    found: list[tuple[Array, float, Array]], most: int, shot: FilmedShot, table: TableNumbers, frames: int
) -> list[int]:
    """Return the numbers of the best starts whose places differ."""
    order = sorted(range(len(found)), key=lambda i: found[i][1])
    far = np.sqrt(distances(table, shot, np.array([one[0] for one in found]), frames))
    kept: list[int] = []
    for i in order:
        if all(np.sqrt(np.square(far[i] - far[j]).mean()) > ALIKE for j in kept):
            kept.append(i)
        if len(kept) == most:
            break
    return kept


def search_start(
    table: TableNumbers, shot: FilmedShot, noise: float, rng: np.random.Generator, settings: SearchSettings,
    before: Sequence[Array] = (), last: int | None = None, widths: Array | None = None, wider: bool = True,
) -> ShotStart:  # fmt: skip
    """Search for the starts of a shot, from horizon to horizon, up to the ``last`` number of frames.

    ``before``: starts found at other numbers of the table. ``widths`` (P,): by how much the numbers scatter from shot to shot, or
    are unknown for one alone: they descend with the start. ``wider``: whether a shot that is not followed is searched once more,
    wider, as it may have gone astray some contacts earlier.
    """
    search = _Search(table, shot, noise, rng, last, widths)
    found = search.found(settings, before)
    far = _farthest(table, found)
    if far < FAILED or not wider:
        return found
    wide = replace(
        settings, beam=WIDER * settings.beam, draws=WIDER * settings.draws, descents=WIDER * settings.descents
    )
    other = search.found(wide, [*before, *found.pool])
    return min((found, far), (other, _farthest(table, other)), key=lambda one: one[1])[0]


def _farthest(table: TableNumbers, found: ShotStart) -> float:
    """Return the distance (rms) at the last horizon, m."""
    frames = max(found.best)
    return rms(table, found.shot, found.best[frames], frames)


@dataclass(frozen=True, eq=False)
class _Search:
    """The search for the starts of a shot."""

    table: TableNumbers
    shot: FilmedShot
    noise: float
    rng: np.random.Generator
    last: int | None
    widths: Array | None

    @functools.cached_property
    def velocity(self) -> Array:
        return _guess(self.shot)

    @functools.cached_property
    def prior(self) -> StartPrior:
        prior = StartPrior.of(self.shot, self.velocity, self.noise)
        return prior if self.widths is None else prior.with_scatter(len(self.shot.balls), self.widths)

    def found(self, settings: SearchSettings, more: Sequence[Array]) -> ShotStart:
        """Search once, with ``more`` starts that are tried at each horizon."""
        every, kept = horizons(self.shot), list[tuple[Array, float, Array]]()
        result = ShotStart(self.shot, self.prior)
        old = padded(more, len(self.prior.center))
        for frames in (n for n in every if self.last is None or n <= max(self.last, every[0])):
            kept = self._stage(settings, frames, kept, old)
            result.best[frames] = kept[0][0]
            result.pool += [one[0] for one in kept]
        return result

    def _stage(
        self, settings: SearchSettings, frames: int, kept: list[tuple[Array, float, Array]], old: Array
    ) -> list[tuple[Array, float, Array]]:
        """Return the best starts at a horizon, from those at the one before."""
        table, shot, rng = self.table, self.shot, self.rng
        if not kept:
            first = _first_draws(shot, self.prior, self.velocity, 4 * settings.draws, rng)
            return self._descended(settings, frames, [], np.concatenate([first, old]), 2 * settings.descents)
        for turn in range(2):
            many = turn > 0 or rms(table, shot, kept[0][0], frames) >= FAILED
            count, descents = (
                (4 * settings.draws, 2 * settings.descents) if many else (settings.draws, settings.descents)
            )
            each, own, wide = -(-count // len(kept)), start_size(len(shot.balls)), 2.0 if many else 1.0
            tries = [
                np.array([one[0] for one in kept]),
                *(_drawn(one[0], one[2], each, rng, wide, own, settings.anew) for one in kept),
                old,
            ]
            found = self._descended(settings, frames, kept, np.concatenate(tries), descents)
            if many or rms(table, shot, found[0][0], frames) < NEAR:
                break
        return found

    def _descended(
        self, settings: SearchSettings, frames: int, kept: list[tuple[Array, float, Array]], tries: Array, descents: int
    ) -> list[tuple[Array, float, Array]]:
        """Return the best starts at a horizon, of those that were kept, and the nearest ones of all tries (N, K)."""
        far = rms(self.table, self.shot, kept[0][0], frames) if kept else 0.0
        sigma = error_of_a_frame(far)
        cost = _cost(self.table, self.shot, tries, frames, self.prior, sigma)
        order = np.argsort(cost, kind="stable")[:descents].tolist()
        order = list(dict.fromkeys([*range(len(kept)), *order]))[: descents + len(kept)]
        found = descend(self.table, self.shot, tries[order], frames, self.prior, sigma, settings.evaluations)
        return [found[i] for i in _distinct(found, settings.beam, self.shot, self.table, frames)]


class Refined(NamedTuple):
    """A start that fits up to a horizon."""

    start: Array
    cost: float
    """Soft-L1, in units of sigma."""
    sigma: float
    """m: the error that a frame is taken to have."""


def refined(
    table: TableNumbers, start: ShotStart, frames: int, evaluations: int, others: int = 3, sigma: float | None = None,
    first: Array | None = None,
) -> Refined:  # fmt: skip
    """Return the best start up to a horizon at other numbers of the table, from ``first``, the best so far, and so many ``others``
    of the pool."""
    shot = start.shot
    own = [one for one in (first, start.best.get(frames)) if one is not None]
    # (on a table of its own each start is a call of the engine)
    pool = start.pool[-RECENT:] if len(start.prior.center) > start_size(len(shot.balls)) else start.pool
    tries = np.array([*own, *pool] if others else own)
    nearest = np.argsort(
        _cost(table, shot, tries, frames, start.prior, sigma or 3 * LEAST_SIGMA), kind="stable"
    ).tolist()
    order = list(dict.fromkeys([0, *nearest[:others]])) if others else nearest[:1]
    given = sigma is not None
    if sigma is None:
        sigma = error_of_a_frame(min(rms(table, shot, tries[i], frames) for i in order))
    best = min(descend(table, shot, tries[order], frames, start.prior, sigma, evaluations), key=lambda one: one[1])
    for _ in range(0 if given else AGAIN):  # (with a larger error than there is, the prior would weigh too much)
        nearer = error_of_a_frame(rms(table, shot, best[0], frames))
        if not nearer < 0.8 * sigma:
            break
        sigma = nearer
        (best,) = descend(table, shot, best[0][None], frames, start.prior, sigma, evaluations)
    return Refined(best[0], best[1], sigma)


def error_of_a_frame(far: float) -> float:
    """Return the error that a frame is taken to have where the distance (rms) is ``far``, m."""
    return max(LEAST_SIGMA, SIGMA_SHARE * min(far, FAILED))


def error_of_frames(table: TableNumbers, start: ShotStart, best: Array, frames: int, least: float) -> float:
    """Return the error of a frame as if all were independent, m: residuals are correlated with their neighbours, and so many of
    them count as one. ``least``: of a distance, m."""
    gap = residuals(table, start.shot, best[None], frames).gap[0]
    size = max(float(np.sqrt(np.square(gap).mean())), least / np.sqrt(2), LEAST_SIGMA)
    return float(size * np.sqrt(correlation(gap, start.shot, frames)))


def correlation(gap: Array, shot: FilmedShot, frames: int) -> float:
    """Return how many residuals are correlated with one, itself included: 1 for white noise."""
    full = np.zeros((*shot.known[:frames].shape, 2))
    full[shot.known[:frames]] = gap.reshape(-1, 2)
    moves = full[shot.known[:frames]].std() > 0
    variance, total = float(np.square(full).sum()), 1.0
    for lag in range(1, min(LAGS, frames - 1)):
        r = float((full[lag:] * full[:-lag]).sum()) / variance if moves and variance else 0.0
        if r < CORRELATED:
            break
        total += 2 * r
    return total


def soft(gap: Array, by: Sequence[Array], sigma: float) -> tuple[Array, list[Array]]:
    """Return gaps (..., M) and their derivatives (..., M, K) such that the sum of squares is the soft-L1 loss of each frame
    and ball.

    f(z) = 2 SOFT^2 (sqrt(1 + z) - 1) with z = |gap|^2 / (SOFT sigma)^2 is |h gap|^2 / sigma^2 with h^2 = 2 / (sqrt(1 + z) + 1).
    """
    flat = gap.reshape(*gap.shape[:-1], -1, 2) / sigma
    root = np.sqrt(1 + np.square(flat).sum(axis=-1) / SOFT**2)
    h = np.sqrt(2 / (root + 1))
    turned = ((-0.5 / SOFT**2) * h**3 / root)[..., None] * flat
    found = []
    for one in by:
        d = one.reshape(*flat.shape, one.shape[-1]) / sigma
        inner = flat[..., 0, None] * d[..., 0, :] + flat[..., 1, None] * d[..., 1, :]
        d *= h[..., None, None]
        d += turned[..., None] * inner[..., None, :]
        found.append(d.reshape(one.shape))
    return (h[..., None] * flat).reshape(gap.shape), found
