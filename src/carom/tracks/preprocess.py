"""Preparation of tracks for fits: rounding and noise of positions, wrong positions, and the camera's view."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.tracks.contact import View
from carom.tracks.flights import MIN_FALLING_SHARE, constant_acceleration, falling_share, falls_freely
from carom.tracks.track import SAMPLED, Track, position_noise

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


# ----------------------------------------------------------------------------------------------------
# Balls that a tracking program has confused: two of a film take each other's places, or one goes on under another name.


JUMP = 0.06  # m that both balls are off their paths, more than a ball's diameter
ON_THE_WAY = 0.03  # m that they are off the other's, after the exchange: a contact leaves them a diameter apart
LONGEST_GAP = 3.5  # frames, over which a path is continued
NEAR_SHARE = 0.02  # of the size of what the film shows: a ball that goes on is no farther off, also where all is small
SAME_FRAME = 0.25  # of the interval of frames


def with_own_names(tracks: Sequence[Track], notes: list[str]) -> list[Track]:
    """Return the tracks of films in which no two balls have exchanged their names; a note says when they did.

    The frames are followed in time. Where two balls leave the continuation of their paths at once, by more than a ball's diameter,
    and each is on that of the other, their names are exchanged from there on. Two balls that collide are a diameter apart: they are
    left.
    """
    found = list(tracks)
    for group in dict.fromkeys(track.group for track in tracks):
        members = [k for k, track in enumerate(found) if track.group == group and len(track) > 2]
        if sum(_jumps(found[k]) for k in members) < 2:
            continue
        mine, when = _own_names([found[k] for k in members])
        if when:
            pairs = sorted({name for _t, *names in when for name in names})
            notes.append(
                f"{group or 'film'}: {', '.join(pairs)} exchange their names in the file {_times(len(when))}, first at"
                f" t = {when[0][0]:.6g} s: exchanged back"
            )
            for k, one in zip(members, mine, strict=True):
                found[k] = one
    return found


def with_one_name(tracks: Sequence[Track], notes: list[str]) -> list[Track]:
    """Return the tracks of films in which no ball goes on under another name; a note says which did.

    One track ends before the film does, and within a few frames another one begins on the continuation of its path, or where the
    ball lay: nearer than any other ball could be.
    """
    found = list(tracks)
    for group in dict.fromkeys(track.group for track in tracks):
        while pair := _goes_on([track for track in found if track.group == group]):
            one, two = pair
            first, second = one.seen.nonzero()[0], two.seen.nonzero()[0]
            joined = _joined([one, two], 0, [*((0, int(i)) for i in first), *((1, int(i)) for i in second)])
            notes.append(
                f"{group or 'film'}: {two.name} begins at t = {two.time[second[0]]:.6g} s where {one.name} ends: taken as one ball,"
                f" {one.name}"
            )
            found = [joined if track is one else track for track in found if track is not two]
    return found


def _goes_on(tracks: list[Track]) -> tuple[Track, Track] | None:
    """Return the two tracks of a film of which the second goes on nearest to where the first ends; None if no two do."""
    seen = [(track, track.time[track.seen], track.position[track.seen][:, :2]) for track in tracks if track.seen.any()]
    if len(seen) < 2:
        return None
    steps = np.concatenate([np.diff(t) for _track, t, _x in seen])
    longest = LONGEST_GAP * float(np.median(steps[steps > 0])) if (steps > 0).any() else 0.0
    near = min(ON_THE_WAY, NEAR_SHARE * float(np.hypot(*np.ptp(np.concatenate([x for _track, _t, x in seen]), axis=0))))
    off = []
    for (one, t, x), (two, u, y) in itertools.permutations(seen, 2):
        if 0 < u[0] - t[-1] <= longest:
            ahead = _continued(list(zip(t[-2:], x[-2:], strict=True)), float(u[0]), longest)
            away = [np.hypot(*(y[0] - place)) for place in (x[-1], ahead) if place is not None]
            off.append((min(away), one, two))
    nearest = min(off, key=lambda each: each[0], default=None)
    return nearest[1:] if nearest and nearest[0] < near else None


def _jumps(track: Track) -> bool:
    """Return whether a ball is anywhere farther from the continuation of its path than two balls that exchange their names."""
    time, x = track.time[track.seen], track.position[track.seen][:, :2]
    step, way = np.diff(time), np.diff(x, axis=0)
    ahead = np.divide(way, step[:, None], out=np.zeros_like(way), where=step[:, None] > 0)[:-1] * step[1:, None]
    return bool((np.hypot(*(way[1:] - ahead).T) > JUMP).any() or (len(way) > 0 and np.hypot(*way[0]) > JUMP))


def _times(count: int) -> str:
    return "once" if count == 1 else f"{count} times"


def _own_names(tracks: list[Track]) -> tuple[list[Track], list[tuple[float, str, str]]]:
    """Return tracks with their names exchanged back, and when which two were."""
    steps = np.concatenate([np.diff(track.time) for track in tracks])
    interval = float(np.median(steps[steps > 0])) if (steps > 0).any() else 0.0
    rows = sorted((float(t), k, i) for k, track in enumerate(tracks) for i, t in enumerate(track.time))
    owner, when = (
        list(range(len(tracks))),
        list[tuple[float, str, str]](),
    )  # owner[k]: the ball that the file's track k shows
    paths: list[list[tuple[float, Array]]] = [[] for _ in tracks]
    taken: list[list[tuple[int, int]]] = [[] for _ in tracks]
    for frame in _frames(rows, SAME_FRAME * interval):
        t, places = frame[0][0], {k: tracks[k].position[i, :2] for _t, k, i in frame}
        expected = {k: _continued(paths[owner[k]], t, LONGEST_GAP * interval) for k in places}
        for one, two in itertools.combinations(places, 2):
            mine, yours = expected[one], expected[two]
            if mine is None or yours is None:
                continue
            off = min(np.hypot(*(places[one] - mine)), np.hypot(*(places[two] - yours)))
            if off > JUMP and max(np.hypot(*(places[two] - mine)), np.hypot(*(places[one] - yours))) < ON_THE_WAY:
                owner[one], owner[two] = owner[two], owner[one]
                expected[one], expected[two] = yours, mine
                when.append((t, tracks[one].name, tracks[two].name))
        for _t, k, i in frame:
            ball = owner[k]
            if np.isfinite(places[k]).all():
                paths[ball] = [*paths[ball][-1:], (t, places[k])]
            taken[ball].append((k, i))
    if not when:
        return tracks, when
    return [_joined(tracks, k, rows) for k, rows in enumerate(taken)], when


def _frames(rows: list[tuple[float, int, int]], apart: float) -> list[list[tuple[float, int, int]]]:
    """Return the rows, in the order of time, of each frame."""
    frames: list[list[tuple[float, int, int]]] = []
    for row in rows:
        if frames and row[0] - frames[-1][0][0] <= apart and all(row[1] != other[1] for other in frames[-1]):
            frames[-1].append(row)
        else:
            frames.append([row])
    return frames


def _continued(path: list[tuple[float, Array]], t: float, longest: float) -> Array | None:
    """Return where a ball is expected, from its last two frames; None after a gap."""
    if not path or t - path[-1][0] > longest:
        return None
    since, x = path[-1]
    v = np.zeros(2)
    if len(path) > 1 and since - path[0][0] <= longest:
        v = (x - path[0][1]) / (since - path[0][0])
    return np.asarray(x + v * (t - since))


def _joined(tracks: list[Track], ball: int, rows: list[tuple[int, int]]) -> Track:
    """Return the track of a ball whose rows stand in several tracks of the file."""

    def of(name: str) -> Any:
        parts = [getattr(track, name) for track in tracks]
        return None if any(part is None for part in parts) else np.array([parts[k][i] for k, i in rows])

    return replace(tracks[ball], **{name: of(name) for name in SAMPLED})
