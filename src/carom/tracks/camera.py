"""The direction of the walls in a film from above: the lines at which balls turn, if they are not parallel to the axes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.errors import shortened_list
from carom.tracks.contact import TrackContact
from carom.tracks.events import SIDES, TrackEvent, frames_per_side
from carom.tracks.least_squares import ContactFit
from carom.tracks.track import Track

Array = NDArray[np.float64]
SHARP, SLOWEST, NEAR_WALL_M = (
    np.radians(30.0),
    0.15,
    0.01,
)  # a turn by this angle, at this speed, m/s; and where a wall yields
MIN_AWAY, SHARE_AWAY = 3, 0.25  # turns away from all walls, from which another direction is sought
STEP = np.radians(0.5)
TURNED = "the camera was turned, and no wall is parallel to the picture's axes; give the wall's line by two points"


class Turns(NamedTuple):
    """Sharp turns of balls, away from other balls: places (n, 2), m; changes of velocity (n, 2), m/s; steps of a frame (n,), m."""

    place: Array
    change: Array
    reach: Array
    time: Array
    """(n,) s."""


def without_turned(
    contacts: Sequence[TrackContact],
    tracks: Sequence[Track],
    events: dict[tuple[str, str], list[TrackEvent]],
    noise: float,
    interval: float,
) -> tuple[list[TrackContact], list[str]]:
    """Return the contacts, none of them measured if the walls that were found are turned, and a note with the walls' lines."""
    roll = camera_roll(tracks, sharp_turns(tracks, events, interval), noise)
    if roll is None:
        return list(contacts), []
    lines = "; ".join(
        f"{name} ({first[0]:.3f}, {first[1]:.3f}) to ({second[0]:.3f}, {second[1]:.3f})"
        for name, (first, second) in turned_walls(tracks, roll)
    )
    note = (
        f"the camera was turned: balls turn at lines that lie at {np.degrees(roll):.1f} degrees to the picture's axes, so no"
        " contact at a wall parallel to the axes is used. Give the walls' lines by two points each, estimated as (m):"
        f" {lines}"
    )
    return [replace(one, fit=None, why=TURNED) if one.wall.found else one for one in contacts], [note]


def sharp_turns(tracks: Sequence[Track], events: dict[tuple[str, str], list[TrackEvent]], interval: float) -> Turns:
    """Return where balls turn by more than 30 degrees, far in time from other balls, gaps and the track's ends.

    The velocities before and after are slopes of straight lines through the frames of 60 ms, and through three at least.

    Examples
    --------
    >>> import numpy as np
    >>> from carom.tracks import Track
    >>> from carom.tracks.camera import sharp_turns
    >>> t = np.arange(40) / 100
    >>> ball = Track("ball", t, np.stack([np.abs(0.2 - t), 0.5 * t], axis=-1))
    >>> turns = sharp_turns([ball], {("", "ball"): []}, 0.01)
    >>> turns.place.round(2).tolist(), turns.change.round(2).tolist()
    ([[0.01, 0.1]], [[2.0, 0.0]])
    """
    found = []
    for track in tracks:
        t, x = track.time, track.position[:, :2]
        side = frames_per_side(t)
        if len(t) < 2 * side + 1:
            continue
        slopes = _slopes(t, x, side)
        before, after = slopes[: -side - 1], slopes[side + 1 :]  # of frames i - side to i - 1, and of i + 1 to i + side
        i = np.arange(side, len(t) - side)
        speeds = np.stack([np.hypot(*before.T), np.hypot(*after.T)])
        cosine = (before * after).sum(axis=1) / np.maximum(speeds[0] * speeds[1], 1e-12)
        turning = (cosine < np.cos(SHARP)) & (speeds.min(axis=0) > SLOWEST)
        turning &= t[i + side] - t[i - side] < 3 * side * interval
        margin = side * interval
        for event in events[track.group, track.name]:
            if event.kind != "wall":
                turning &= (t[i] < event.low - margin) | (t[i] > event.high + margin)
        change = after - before
        for low, high in np.flatnonzero(np.diff(np.concatenate([[0], turning, [0]]))).reshape(-1, 2).tolist():
            most = low + int(np.argmax(np.hypot(*change[low:high].T)))
            found.append([*x[i[most]], *change[most], interval * speeds[:, most].max(), t[i[most]]])
    rows = np.array(found).reshape(-1, 6)
    return Turns(rows[:, :2], rows[:, 2:4], rows[:, 4], rows[:, 5])


def unlisted_turns(
    tracks: Sequence[Track], events: dict[tuple[str, str], list[TrackEvent]], interval: float
) -> list[TrackEvent]:
    """Return the sharp turns of balls on a table that are at no wall and no other ball."""
    found = []
    for track in tracks:
        margin = frames_per_side(track.time) * interval
        met = [one for one in events[track.group, track.name] if one.kind == "wall"]
        turns = sharp_turns([track], events, interval)
        for (x, y), t in zip(turns.place.tolist(), turns.time.tolist(), strict=True):
            if not any(one.low - margin < t < one.high + margin for one in met):
                found.append(TrackEvent("turn", t, t, f"({x:.3f}, {y:.3f})"))
    return found


def camera_roll(tracks: Sequence[Track], turns: Turns, noise: float) -> float | None:
    """Return by what angle the walls are turned against the picture's axes, radians from -pi/4 to pi/4, counter-clockwise.

    None where the turns do not show it: where most of them are at walls parallel to the axes, or at no four lines.

    Examples
    --------
    A ball in a box whose sides are turned by 10 degrees:

    >>> import numpy as np
    >>> from carom.tracks import Track
    >>> from carom.tracks.camera import camera_roll, sharp_turns
    >>> t = np.arange(2000) / 100
    >>> x = np.stack([np.abs((0.31 * t) % 2 - 1), np.abs((0.47 * t) % 2 - 1)], axis=-1)
    >>> turn = np.radians(10.0)
    >>> x = x @ np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])
    >>> ball = Track("ball", t, x)
    >>> roll = camera_roll([ball], sharp_turns([ball], {("", "ball"): []}, 0.01), 1e-4)
    >>> round(float(np.degrees(roll)), 1)
    10.0
    """
    count = len(turns.reach)
    x = np.concatenate([track.position[:, :2] for track in tracks])
    straight = _at_walls(0.0, x, turns, noise)
    away = count - len(straight)
    if away < max(MIN_AWAY, SHARE_AWAY * count):
        return None
    angles = np.arange(-np.pi / 4, np.pi / 4, STEP)
    met = [_at_walls(angle, x, turns, noise) for angle in angles.tolist()]
    # the most turns at walls, and among equals the ones nearest to their lines
    best = max(range(len(angles)), key=lambda k: (len(met[k]), -float(np.abs(met[k]).sum())))
    if count - len(met[best]) > away / 2:
        return None
    near = [angles[best] + STEP * k / 10 for k in range(-10, 11)]
    spread = [(len(rows), -float(np.abs(rows).sum())) for rows in (_at_walls(float(a), x, turns, noise) for a in near)]
    return float(near[max(range(len(near)), key=lambda k: spread[k])])


def turned_walls(tracks: Sequence[Track], roll: float) -> list[tuple[str, Array]]:
    """Return names of four walls turned by ``roll``, radians, and two points (2, 2), m, of the line of each."""
    x = np.concatenate([track.position[:, :2] for track in tracks])
    found = []
    for name, axis, sign in SIDES:
        n, along = sign * _axes(roll)[axis], _axes(roll)[1 - axis]
        ends = np.array([(x @ along).min(), (x @ along).max()])
        found.append((name, (x @ n).min() * n + ends[:, None] * along))
    return found


def _axes(roll: float) -> Array:
    return np.array([[np.cos(roll), np.sin(roll)], [-np.sin(roll), np.cos(roll)]])


def _at_walls(roll: float, x: Array, turns: Turns, noise: float) -> Array:
    """Return the distances from their walls, m, of the turns at the extremes of all positions along axes turned by ``roll``."""
    found = []
    for axis in _axes(roll):
        for n in (axis, -axis):
            distance = turns.place @ n - float((x @ n).min())
            across = turns.change @ n
            facing = across > np.abs(turns.change @ np.array([-n[1], n[0]]))
            found.append(distance[facing & (distance < turns.reach + max(NEAR_WALL_M, 6 * noise))])
    return np.concatenate(found)


def _slopes(t: Array, x: Array, side: int) -> Array:
    """Return slopes (n - side + 1, 2) of straight lines through every ``side`` rows in turn."""
    windows, places = (np.lib.stride_tricks.sliding_window_view(a, side, axis=0) for a in (t - t[0], x))
    u = windows - windows.mean(axis=1, keepdims=True)
    return np.asarray((places * u[:, None, :]).sum(axis=-1) / np.maximum((u * u).sum(axis=1), 1e-300)[:, None])


# ----------------------------------------------------------------------------------------------------
# Walls that are none: corners of a path in the picture of a camera that was turned, where no wall parallel to its axes stands.


OBLIQUE = (
    "a corner of the path, not a wall: velocities change more along walls parallel to the picture's axes than friction can change"
    " them; give the wall's line by two points"
)
# Of the change of the velocity across the wall: friction changes the velocity along it by less. Cushions have 0.1 to 0.3. A ball
# that grips the wall loses at most k (1 + beta) of its slip; one with running spin becomes faster along the wall, which is rare.
MAX_FRICTION, MAX_FASTER, ERRORS = 0.5, 0.35, 3.0
DOUBTFUL = 0.3  # a friction that few cushions have, from which a note is given


def is_oblique(fit: ContactFit, k: float) -> bool:
    """Return whether the velocity changes more along a wall than friction can change it; k = kappa / (1 + kappa)."""
    along, across = fit["vt_out"] - fit["vt_in"], fit["vn_out"] - fit["vn_in"]
    error = ERRORS * float(np.hypot(fit.error("vt_out"), fit.error("vt_in")))
    if along * fit["vt_in"] > 0:
        return abs(along) - error > MAX_FASTER * across
    return abs(along) - error > max(MAX_FRICTION * across, 2 * k * abs(fit["vt_in"]))


def without_oblique(contacts: Sequence[TrackContact], k: float) -> list[TrackContact]:
    """Return the contacts without those at walls that were found, and are none; without all of these if half of them are none."""
    at_found = [one for one in contacts if one.fit is not None and one.wall.found]
    none = [one for one in at_found if one.fit is not None and is_oblique(one.fit, k)]
    gone = at_found if 2 * len(none) >= len(at_found) and none else none
    return [replace(one, fit=None, why=OBLIQUE) if any(one is other for other in gone) else one for one in contacts]


def oblique_note(contacts: Sequence[TrackContact]) -> list[str]:
    """Return a note on walls that are none, and on what is left of the others: the camera was turned."""
    names = list(dict.fromkeys(one.wall.name for one in contacts if one.why == OBLIQUE))
    if names:
        walls = f"wall {names[0]} is none" if len(names) == 1 else f"walls {shortened_list(names)} are none"
        return [
            f"{walls}: the ball's path has corners there, but what turned it was not parallel to the picture's axes. The camera was"
            " turned: give the walls' lines by two points each, or turn the positions"
        ]
    steep = [
        ratio for one in contacts if one.fit is not None and one.wall.found if (ratio := _needed(one.fit)) > DOUBTFUL
    ]
    if not steep:
        return []
    return [
        f"the velocity changes along the walls as with a friction of {max(steep):.2f}, or as with a camera turned by up to"
        f" {np.degrees(np.arctan(max(steep))):.0f} degrees: the walls found are taken to be parallel to the picture's axes;"
        " give their lines by two points each if they are not"
    ]


def needs_lines(contacts: Sequence[TrackContact]) -> bool:
    """Return whether the lines of the walls should be given: the camera was turned, or may have been."""
    return any(one.why == TURNED for one in contacts) or bool(oblique_note(contacts))


def _needed(fit: ContactFit) -> float:
    """Return the friction that the change of the velocity along the wall needs, beyond its error; a gain of speed counts twice."""
    along, across = fit["vt_out"] - fit["vt_in"], fit["vn_out"] - fit["vn_in"]
    error = ERRORS * float(np.hypot(fit.error("vt_out"), fit.error("vt_in")))
    return (abs(along) - error) / max(across, 1e-12) * (2.0 if along * fit["vt_in"] > 0 else 1.0)
