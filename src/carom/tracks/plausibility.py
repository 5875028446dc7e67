"""Whether measured contacts are possible; walls that are none or elsewhere; whether the floor has friction.

Whether measured contacts are possible: restitutions of at most 1, free motion between them, a floor or a gravity that exists.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.errors import shortened_list
from carom.formatting import counted
from carom.tracks.contact import DECISIVE, SMOOTH_TURN, TrackContact, View, WithError, averaged
from carom.tracks.events import BEYOND_WALL_M, SIDES, TrackEvent, WallLine, frames_per_side, turning_points
from carom.tracks.flights import Air, constant_acceleration
from carom.tracks.least_squares import OUTPUTS, ContactFit
from carom.tracks.track import Track

BEYOND = 3.0  # error bars by which a restitution has to exceed 1
MAX_SHARE_IMPOSSIBLE, MAX_SHARE_SCATTERED = 0.2, 0.5
MOSTLY = 0.75  # of a variance
MIN_JUDGED = 2  # contacts; a single one does not tell a view
MAX_CLOTH_FRICTION = 0.6  # of gravity a ball in flight would show 1
GRAVITY_TOLERANCE = 0.3


def restitutions_in_words(contacts: Sequence[TrackContact]) -> str:
    """Return the restitutions of the contacts that were measured, with their errors, for a note."""
    fits = [one.fit for one in contacts if one.fit is not None]
    each = [f"{ratio:.3f} ± {error:.1g}" for ratio, error in (fit.restitution for fit in fits if fit["vn_in"] < 0)]
    return shortened_list(each, 4) if each else "not measured"


def impossible(one: TrackContact) -> bool:
    """Return whether the ball leaves the wall faster than it came, beyond the error bar: no wall at rest does that."""
    return one.fit is not None and _gains(one.fit)


def _gains(fit: ContactFit) -> bool:
    if -fit["vn_in"] <= BEYOND * fit.error("vn_in"):  # it does not come towards the wall
        return False
    variance = fit.error("vn_in") ** 2 + fit.error("vn_out") ** 2 + 2 * fit.covariance_of("vn_in", "vn_out")
    return fit["vn_out"] + fit["vn_in"] > BEYOND * float(np.sqrt(max(variance, 0.0)))


def restitution_note(contacts: Sequence[TrackContact]) -> list[str]:
    """Return a note on contacts whose restitution exceeds 1 beyond the error bar."""
    fits = [one.fit for one in contacts if one.fit is not None]
    worst = [fit for fit in fits if _gains(fit)]
    if not worst:
        return []
    most = max(worst, key=lambda fit: -fit["vn_out"] / fit["vn_in"])
    count = f"{len(worst)} of {len(fits)} contacts have" if len(fits) > 1 else "the contact has"
    return [
        f"{count} a restitution above 1 beyond the error bar, up to {-most['vn_out'] / most['vn_in']:.3g} at t ="
        f" {most['t']:.4g} s: no wall at rest gives back more than it gets; is the view (`view`), scale or frame rate wrong?"
    ]


def shared_error_notes(contacts: Sequence[TrackContact], air: Air) -> list[str]:
    """Return notes on what all contacts of a film share and its flights do not show, if it makes most of the errors of results."""
    told = []
    drag = _share(contacts, "drag", ("vn_in", "vn_out"), lambda before, after: (-1 / before, 1 / after))
    if drag > MOSTLY and not air.drag_shown:
        told.append(
            "air drag: the flights do not show whether the air slows the ball down"
            f" (k = {air.drag_per_metre:.2g} ± {air.drag_error:.1g} 1/m is taken); this makes the error bars of the restitution"
            f" {(1 - drag) ** -0.5:.1f} times as large as with a drag that is known"
        )
    roll = _share(contacts, "roll", ("vt_in", "vt_out"), lambda _before, _after: (-1.0, 1.0))
    if roll > MOSTLY:
        told.append(
            f"camera roll: the flights show to {np.degrees(air.tilt_error):.1g}° only where down is; this makes the error bars of"
            f" the change of v_t, and so of friction, {(1 - roll) ** -0.5:.1f} times as large as with a floor whose line is known"
            " (`wall` gives it)"
        )
    return told


def _share(
    contacts: Sequence[TrackContact],
    cause: str,
    names: tuple[str, str],
    rates: Callable[[float, float], tuple[float, float]],
) -> float:
    """Return the median share of a cause in the variances of a result; ``rates``: its derivatives by two velocities."""
    shares = []
    both = [OUTPUTS.index(name) for name in names]
    for one in contacts:
        fit = one.fit
        if fit is None or cause not in fit.shifts or not (fit["vn_out"] > 0 > fit["vn_in"]):
            continue
        rate = np.array(rates(fit["vn_in"], fit["vn_out"]))
        variance = float(rate @ fit.covariance[np.ix_(both, both)] @ rate)
        shares.append(min(float(rate @ fit.shifts[cause][both]) ** 2 / max(variance, 1e-300), 0.9999))
    return float(np.median(shares)) if shares else 0.0


def why_implausible(
    contacts: Sequence[TrackContact], view: View, floor: Mapping[str, WithError], gravity: float
) -> str:
    """Return objections to the view in which contacts were measured; empty if nothing does, or too few were measured."""
    judged = [one for one in contacts if np.isfinite(one.scatter)]
    if len(judged) < MIN_JUDGED:
        return ""
    fits = [one.fit for one in judged if one.fit is not None]
    if len(judged) - len(fits) > MAX_SHARE_SCATTERED * len(judged):
        return _why_not_free(judged)
    bad = sum(map(_gains, fits))
    if bad >= max(MIN_JUDGED, MAX_SHARE_IMPOSSIBLE * len(judged)):
        return f"{bad} of {len(fits)} restitutions are above 1 beyond their error bars"
    friction = floor.get("floor friction")
    if view == "above" and friction is not None and friction.value - BEYOND * friction.error > MAX_CLOTH_FRICTION:
        return f"the floor's friction comes out as {friction.value:.2g}"
    found = floor.get("gravity")
    if view == "side" and found is not None and abs(found.value / gravity - 1) > GRAVITY_TOLERANCE:
        return f"gravity comes out as {found.value:.3g} m/s^2"
    return ""


def _why_not_free(judged: Sequence[TrackContact]) -> str:
    """Return why most contacts are none: the ball turns smoothly in most places, or scatters."""
    smooth = sum(one.why == SMOOTH_TURN for one in judged)
    if smooth > MAX_SHARE_SCATTERED * len(judged):
        return f"the ball turns in a smooth curve in {smooth} of {len(judged)} places: no contacts"
    lost = sum(one.fit is None for one in judged)
    return f"{lost} of {len(judged)} contacts scatter far more than free motion beside a wall"


# ----------------------------------------------------------------------------------------------------
# The direction of the walls in a film from above: the lines at which balls turn, if they are not parallel to the axes.


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
    >>> from carom.tracks.plausibility import sharp_turns
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
    >>> from carom.tracks.plausibility import camera_roll, sharp_turns
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


# ----------------------------------------------------------------------------------------------------
# Bounces of a ball filmed from the side that are at none of the walls: on a stair, a hand, a stone.


NOT_LEVEL = "a bounce away from the wall, on a surface that moves or is not level; give its line by two points (`wall` x1,y1,x2,y2)"
# A turn within this time of another event is that event; more than so many frames apart, frames are missing; in a longer gap the
# ball may have bounced twice; frames of flights that are to meet, their scatter in units of the noise, and how near they come
SAME_FRAMES, SAME_S, LOST_FRAMES, MAX_LOST_S, MAX_LOST_FRAMES = 2.5, 0.03, 1.6, 0.1, 6.5
MEETING_FRAMES, MIN_MEETING, MAX_SCATTER, MAX_APART_M = 16, 3, 4.0, 0.01
MOST_DRAG = 0.15  # 1/m, of a table-tennis ball
MIN_BACK_M = 0.005  # by which a ball turns back from an upright wall
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
        if place is None and i not in turned and not _is_hit(t, height, sides, gravity, noise):
            continue
        low, high = (float(t[k]), float(t[k + 1])) if lost[n] else (float(t[i - 1]), float(t[i + 1]))
        where = (float(x[i, 0]), float(x[i, 1]))
        if place is not None and lost[n]:  # (frames missing are no time during which something else could happen)
            low, high = max(low, place[0] - interval / 2), min(high, place[0] + interval / 2)
        found.append(Turn(i, low, high, place[1] if place is not None else where, lost[n], place is not None))
    return found


def _is_hit(
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


# ----------------------------------------------------------------------------------------------------
# Whether the floor of a film from above has friction: decided from all contacts, as hops are.
#
# A ball that rolls into a wall leaves it sliding, and the friction of the floor slows it down and turns it. On an air table, ice or
# wet glass it goes straight on at constant speed. Each contact is fitted in both ways (:mod:`carom.tracks.contact_models`), and the
# differences of chi2 add up to a verdict; in doubt the velocities are means of both, and their error bars contain the difference.


def on_either_floor(
    sliding: Sequence[TrackContact], straight: Sequence[TrackContact], excess: float
) -> tuple[list[TrackContact], list[str]]:
    """Return contacts that are fitted with and without friction of the floor, as its verdict has them, and a note on it.

    ``excess``: by how much all of them together are fitted worse with friction, which is not certain.
    """
    straight = [replace(one, friction_excess=its.friction_excess) for one, its in zip(straight, sliding, strict=True)]
    if excess >= DECISIVE:
        return straight, [
            "the floor has no friction, as of an air table: the ball goes straight on at constant speed where friction would"
            " slow it down after a wall; its spin is unknown (`floor_friction` gives one)"
        ]
    likelier, other = (straight, sliding) if excess > 0 else (sliding, straight)
    share = 1 / (1 + float(np.exp(abs(excess) / 2)))
    mixed = [
        replace(one, fit=averaged(one.fit, its.fit, share)) if one.fit is not None and its.fit is not None else one
        for one, its in zip(likelier, other, strict=True)
    ]
    told = [f"{restitutions_in_words(some)} {how} friction" for some, how in ((sliding, "with"), (straight, "without"))]
    return mixed, [
        f"the frames do not show whether the floor has friction: out/in is {told[0]}, {told[1]}; the velocities after the contacts"
        " are means of both, and their error bars contain the difference (`floor_friction` 0, as of an air table, or 0.2 decides)"
    ]


def flight_gravity(tracks: Sequence[Track], gravity: float) -> float:
    """Return the acceleration with which flights are fitted, m/s^2: gravity, or another if the ball falls with that throughout."""
    fall = -constant_acceleration(tracks)
    return fall if fall > 0 and abs(fall / gravity - 1) > GRAVITY_TOLERANCE else gravity
