"""Free fall in tracks filmed from the side: its acceleration, and the unit, frame rate or axis that would make it gravity's."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from carom.errors import CaromError
from carom.laws.results import GRAVITY
from carom.tracks.track import Track, position_noise

__all__ = [
    "MIN_FALLING_SHARE",
    "axis_points_down",
    "constant_acceleration",
    "falling_share",
    "falls_freely",
    "likely_unit",
    "moves_on_a_table",
    "what_would_give",
]

Array = NDArray[np.float64]
# Pieces of a track that fall alike, if it was filmed from the side: most others hold a contact.
MIN_FALLING_SHARE, MIN_ALIKE_SHARE, MIN_PIECES = 0.4, 0.6, 5
PIECE_S, PIECE_FRAMES = 0.12, 8
# Frames of a piece; longer ones, where noise hides the acceleration in a short one (a film that runs slower than the ball did)
MORE_FRAMES = (12, 16, 24, 32)
MIN_SIDE_SHARE = 0.2  # of these pieces, in which the ball rises, and in which it falls
FLAT = 0.05  # of the next larger extent, at most, that of a coordinate which a ball on a table does not change
MAX_PIECES = 400  # of a track
# Stretches that show a free fall, s, and how many of them: by how much their acceleration may differ from gravity (air), the least
# cosine of its angle to the vertical, its error bars within that, and their scatter in units of the noise
FALLS, FALL_FRAMES = ((0.3, 1), (0.2, 1), (0.15, 1), (0.1, 2)), 6
FALL_SHARE, UPRIGHT, FALL_ERRORS, FALL_SCATTER = 0.15, 0.966, 3.0, 1.8
CORNERS, NO_CORNER = (
    (-0.5, -0.25, 0.0, 0.25, 0.5),
    9.0,
)  # where a bounce in its place is tried, and by how much chi2 excludes it
# Of gravity, the largest deceleration on a table; a speed, m/s, that counts as motion; slope of a path that is level
MAX_SLIDING, MOVING, LEVEL = 0.7, 0.15, 0.1
GRAVITY_SHARE = 0.3  # of gravity, by which an acceleration may differ from it
UNIT_SHARE = 0.15
UNITS = {"mm": 1e3, "cm": 1e2, "in": 1 / 0.0254}
USUAL_RATES = (24, 25, 30, 48, 50, 60, 90, 100, 120, 200, 240, 300, 400, 480, 500, 600, 960, 1000)
RATE_SHARE = 0.02


def pieces(tracks: Sequence[Track], frames: int | None = None) -> tuple[Array, NDArray[np.bool_]]:
    """Return the acceleration along the second axis (n,), m/s^2, of pieces of tracks, and whether the ball rises in them (n,).

    Each piece is fitted by a parabola. ``frames``: length of a piece; by default 0.12 s, but at least 8 frames.
    """
    found: list[Array] = []
    rises: list[NDArray[np.bool_]] = []
    for track in tracks:
        t, y = track.time, track.position[:, 1]
        if len(t) < 6:
            continue
        step = max(float(np.median(np.diff(t))), 1e-9)
        size = min(frames or max(PIECE_FRAMES, int(PIECE_S / step)), len(t))
        start = np.arange(0, max(len(t) - size, 1), max(size // 2, 1))
        start = start[:: len(start) // MAX_PIECES + 1]
        rows = start[:, None] + np.arange(size)
        middle, half = t[rows].mean(axis=1, keepdims=True), np.ptp(t[rows], axis=1)[:, None] / 2
        u = (t[rows] - middle) / half
        powers = np.stack([u**0, u, u**2], axis=-1)
        across = powers.transpose(0, 2, 1)
        fit = np.linalg.solve(across @ powers, across @ (y[rows] - y[rows].mean(axis=1, keepdims=True))[..., None])
        found.append(2 * fit[:, 2, 0] / half[:, 0] ** 2)
        rises.append(y[rows[:, -1]] > y[rows[:, 0]])
    if not found:
        return np.zeros(0), np.zeros(0, bool)
    return np.concatenate(found), np.concatenate(rises)


def constant_acceleration(tracks: Sequence[Track]) -> float:
    """Return the acceleration along the second axis that most pieces of the tracks share, rising and falling; NaN if there is none.

    Friction slows a ball down whichever way it goes, so on a table the two differ in sign.

    Parameters
    ----------
    tracks : sequence of Track
        Frames in which the ball was found.

    Returns
    -------
    float
        m/s^2; negative where the second axis points up.

    Examples
    --------
    >>> import numpy as np
    >>> from carom.tracks import Track
    >>> from carom.tracks.free_fall import constant_acceleration
    >>> t = np.arange(80) / 200
    >>> ball = Track("ball", t, np.stack([t, 1.0 + 2 * t - 9.81 / 2 * t**2], axis=-1))
    >>> round(constant_acceleration([ball]), 3)
    -9.81
    """
    for frames in (None, *MORE_FRAMES):
        found, rises = pieces(tracks, frames)
        if len(found) < MIN_PIECES:
            break
        middle = float(np.median(found))
        alike = np.abs(found - middle) < 0.2 * abs(middle)
        if alike.mean() > MIN_ALIKE_SHARE and 0 < (alike & rises).sum() < alike.sum():
            return middle
    return float("nan")


def falling_share(tracks: Sequence[Track], gravity: float) -> float:
    """Return the share of the pieces of some tracks that fall with gravity, m/s^2 (negative: upward)."""
    found, _rises = pieces(tracks)
    return float((np.abs(found + gravity) < GRAVITY_SHARE * abs(gravity)).mean()) if len(found) else 0.0


def in_a_plane(tracks: Sequence[Track], notes: list[str]) -> list[Track]:
    """Return tracks with two coordinates in the place of three: the height, and the place along the motion; a note says which.

    The height is the coordinate that falls; along the floor the places are measured in the direction in which the balls move most.
    Where none falls, one that stays the same is left out. Raises CaromError where there is neither.

    Examples
    --------
    >>> import numpy as np
    >>> from carom.tracks import Track
    >>> from carom.tracks.free_fall import in_a_plane
    >>> t = np.arange(80) / 200
    >>> place = np.stack([3 * t, 1 + 2 * t - 9.81 / 2 * t**2, 4 * t], axis=-1)
    >>> (ball,) = in_a_plane([Track("ball", t, place)], [])
    >>> ball.position[-1].round(3)  # 5 m/s along the floor
    array([ 0.988,  1.025])
    """
    if all(track.position.shape[1] == 2 for track in tracks):
        return list(tracks)
    seen = [track.select(track.seen) for track in tracks]
    alone = [[replace(one, position=one.position[:, [axis, axis]]) for one in seen] for axis in range(3)]
    fall = np.array([constant_acceleration(one) for one in alone])
    share = np.array([max(falling_share(one, GRAVITY), falling_share(one, -GRAVITY)) for one in alone])
    axes = ["x", "y", "z"]
    from_mean = [one.position - one.position.mean(axis=0) for one in seen if len(one)]
    moves = np.concatenate(from_mean or [np.zeros((1, 3))])
    if np.isfinite(fall).any() or share.max() > MIN_FALLING_SHARE:
        known = np.where(np.isfinite(fall), np.abs(fall), 0.0)
        up = int(np.argmax(known)) if known.any() else int(np.argmax(share))
        along = [axis for axis in range(3) if axis != up]
        down = fall[up] > 0 or (not known[up] and falling_share(alone[up], GRAVITY) < MIN_FALLING_SHARE)
        direction = np.linalg.eigh(moves[:, along].T @ moves[:, along])[1][:, 1]
        direction *= np.sign(direction[np.argmax(np.abs(direction))])
        off = float(np.abs(moves[:, along] @ np.array([-direction[1], direction[0]])).max())
        turned = " and ".join(f"{part:.3g} {axes[axis]}" for part, axis in zip(direction, along, strict=True))
        notes.append(
            f"three coordinates: {axes[up]} falls, and is taken as the height{' (downward)' if down else ''}; along the floor the"
            f" places are {turned}, from which the balls are up to {off:.2g} m off"
        )
        rows = np.zeros((3, 2))
        rows[along, 0], rows[up, 1] = direction, -1.0 if down else 1.0
    else:
        size = np.ptp(moves, axis=0)
        least = int(np.argmin(size))
        if size[least] > FLAT * np.sort(size)[1]:
            raise CaromError(
                "tracks: expected positions in a plane, or a height that falls, got three coordinates of which none falls; keep two"
                " columns, the height and the place along the motion (t, x, z), or the two on the table (t, x, y)"
            )
        notes.append(f"three coordinates: {axes[least]} stays the same within {size[least]:.2g} m, and is left out")
        rows = np.delete(np.eye(3), least, axis=1)
    return [replace(one, position=one.position @ rows) if one.position.shape[1] == 3 else one for one in tracks]


def falls_freely(tracks: Sequence[Track], gravity: float) -> float:
    """Return for how long a ball certainly falls freely with gravity, m/s^2 (negative: upward), s; 0 where no stretch shows it.

    On a table nothing accelerates a ball so much for so long. One stretch of 0.15 s (0.3 s where there is
    much noise) suffices, or two of 0.1 s.

    Upward a ball has to move mostly up or down: at its lowest point a pendulum is accelerated upward, too.
    """
    for span, least in FALLS:
        found = 0
        for track in tracks:
            windows = _windows(track, span)
            if windows is None:
                continue
            first, a, error, scatter, v, corner = windows
            size = np.hypot(*a.T)
            falls = (np.abs(size / abs(gravity) - 1) < FALL_SHARE) & (-np.sign(gravity) * a[:, 1] > UPRIGHT * size)
            falls &= (FALL_ERRORS * error < FALL_SHARE * abs(gravity)) & (scatter < FALL_SCATTER)
            falls &= corner > NO_CORNER
            falls &= (gravity > 0) | (np.abs(v[:, 1]) > np.abs(v[:, 0]))
            last = -np.inf
            for t in first[falls].tolist():
                if t >= last:
                    found, last = found + 1, t + span
        if found >= least:
            return span * found
    return 0.0


def moves_on_a_table(tracks: Sequence[Track], gravity: float) -> bool:
    """Return whether a ball certainly moves with less acceleration, for some time, than one in flight; not level, as on a floor."""
    for windows in (_windows(track, FALLS[1][0]) for track in tracks):
        if windows is not None:
            _first, a, error, scatter, v, _corner = windows
            size = np.hypot(*a.T) + FALL_ERRORS * error
            if (
                (size < MAX_SLIDING * gravity)
                & (scatter < FALL_SCATTER)
                & (np.abs(v[:, 1]) > np.maximum(LEVEL * np.abs(v[:, 0]), MOVING))
            ).any():
                return True
    return False


def _windows(track: Track, span: float) -> tuple[Array, Array, Array, Array, Array, Array] | None:
    """Return of stretches of a track, each ``span`` s long, their beginnings (n,), accelerations (n, 2) and errors (n,), m/s^2.

    And their scatter about parabolas in units of the noise (n,), their mean velocities (n, 2), m/s, and by
    how much chi2 is higher for straight lines with a corner (n,). None of a short track.
    """
    t, x = track.time, track.position
    interval = float(np.median(np.diff(t))) if len(t) > 1 else np.inf
    size = max(round(span / max(interval, 1e-9)) + 1, FALL_FRAMES)
    if len(t) < size or interval <= 0:
        return None
    noise = max(position_noise(t, x, interval), 1e-6 * float(np.ptp(x, axis=0).max()))
    rows = np.arange(0, len(t) - size + 1, max(size // 8, 1))[:, None] + np.arange(size)
    rows = rows[np.ptp(t[rows], axis=1) < 1.3 * (size - 1) * interval]
    if not len(rows) or not noise > 0:
        return None
    half = np.ptp(t[rows], axis=1)[:, None] / 2
    u = (t[rows] - t[rows].mean(axis=1, keepdims=True)) / half
    powers = np.stack([u**0, u, u**2], axis=-1)
    inverse = np.linalg.inv(powers.transpose(0, 2, 1) @ powers)
    y = x[rows] - x[rows].mean(axis=1, keepdims=True)
    fit = inverse @ (powers.transpose(0, 2, 1) @ y)
    squares = np.square(y - powers @ fit).sum(axis=(1, 2))
    scatter = np.sqrt(squares / (2 * size - 6))
    bent = np.full(len(rows), np.inf)
    for at in CORNERS:
        q = np.linalg.qr(np.stack([u**0, u, np.abs(u - at)], axis=-1))[0]
        bent = np.minimum(bent, np.square(y - q @ (q.transpose(0, 2, 1) @ y)).sum(axis=(1, 2)))
    corner = (bent - squares) / noise**2
    error = 2 * np.sqrt(inverse[:, 2, 2]) / half[:, 0] ** 2 * np.maximum(scatter, noise)
    return t[rows[:, 0]], 2 * fit[:, 2] / half**2, error, scatter / noise, fit[:, 1] / half, corner


def axis_points_down(tracks: Sequence[Track], gravity: float) -> float:
    """Return the acceleration with which the ball falls upward, m/s^2, as it does if the second axis points down; else 0."""
    if falling_share(tracks, -gravity) > MIN_FALLING_SHARE or falls_freely(tracks, -gravity):
        return gravity
    return max(float(np.nan_to_num(constant_acceleration(tracks))), 0.0)


def likely_unit(tracks: Sequence[Track]) -> tuple[str, float]:
    """Return the unit in which lengths read as m probably are (cm, mm, in; empty: m), and the acceleration of the fall, m/s^2.

    Examples
    --------
    >>> import numpy as np
    >>> from carom.tracks import Track
    >>> from carom.tracks.free_fall import likely_unit
    >>> t = np.arange(80) / 200
    >>> ball = Track("ball", t, 100 * np.stack([t, 1.0 + 2 * t - 9.80665 / 2 * t**2], axis=-1))
    >>> likely_unit([ball])[0]
    'cm'
    """
    fall = abs(constant_acceleration(tracks))
    found, rises = pieces(tracks)
    for unit, ratio in UNITS.items():
        if abs(fall / (ratio * GRAVITY) - 1) < UNIT_SHARE:
            return unit, fall
        for sign in (-1, 1):
            alike = np.abs(sign * found / (ratio * GRAVITY) - 1) < GRAVITY_SHARE
            up = (alike & rises).sum() / max(alike.sum(), 1)
            if len(found) and alike.mean() > MIN_FALLING_SHARE and MIN_SIDE_SHARE < up < 1 - MIN_SIDE_SHARE:
                return unit, float(np.median(np.abs(found[alike])))
    return "", fall


def what_would_give(fall: float, gravity: float, interval: float) -> str:
    """Return which frame rate, or which scale, would make the acceleration of a fall equal to gravity; both m/s^2, interval in s.

    Examples
    --------
    >>> what_would_give(2.45, 9.80665, 1 / 60)
    'at 120 frames per second instead of 60 (`rate`), or with lengths 4 times as large (`scale`), it would be 9.81 m/s^2'
    """
    ratio = gravity / fall
    rate = ratio**0.5 / interval
    rate = next((float(usual) for usual in USUAL_RATES if abs(rate / usual - 1) < RATE_SHARE), rate)
    return (
        f"at {rate:.3g} frames per second instead of {1 / interval:.4g} (`rate`), or with lengths {ratio:.2g} times as large"
        f" (`scale`), it would be {gravity:.3g} m/s^2"
    )
