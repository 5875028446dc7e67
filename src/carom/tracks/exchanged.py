"""Balls that a tracking program has confused: two of a film take each other's places, or one goes on under another name."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from carom.tracks.track import Track

__all__ = ["with_one_name", "with_own_names"]

Array = NDArray[np.float64]
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

    def of(name: str) -> Array | None:
        parts = [getattr(track, name) for track in tracks]
        return None if any(part is None for part in parts) else np.array([parts[k][i] for k, i in rows])

    time, position = of("time"), of("position")
    assert time is not None
    assert position is not None
    return replace(tracks[ball], time=time, position=position, angle=of("angle"), spin=of("spin"), frame=of("frame"))
