"""Free flights of a ball filmed from the side: where gravity points in the picture, and how much the air slows the ball down.

Between two contacts the ball moves with the acceleration g - k |v| v, k the drag per mass (1/m): it loses more speed as it rises
than it gains as it falls. All flights of a film are fitted together, each with its own start, with one g and one k.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.core.jit.compile import njit
from carom.core.jit.kernel import kernel
from carom.errors import CaromError
from carom.public.defaults import GRAVITY
from carom.tracks.events import find_events, frames_per_side, turning_points
from carom.tracks.least_squares import (
    START_IN,
    START_OUT,
    ContactFit,
    FittedFrames,
    central_differences,
    nearest_frames,
    propagated,
    solve,
    starting_values,
)
from carom.tracks.track import Track, position_noise

Array = NDArray[np.float64]
_compiled = functools.cache(njit)
STEP_S = 0.05  # of the integration; a ball that turns at the top within one is off by some micrometres
# Beside a contact the ball is compressed, and the frame nearest to it may lie on either side.
NEAR_FRAMES, NEAR_S = 1.5, 0.012
MIN_FRAMES, MIN_FLIGHT_S = 6, 0.1
GAP_FRAMES = 4.5  # in a gap of so many frames the ball may have met something
# Of gravity, by which a flight's own acceleration may differ from it: else the ball is held or rolls.
GRAVITY_SHARE = 0.3
MAX_SCATTER = 3.0  # times the noise; more is no free flight
EXACT = 1e-9  # in error bars: so small a residual is none
MAX_PATH_M = 1e6  # beyond this the steps of a fit have left all paths of balls
SIGNIFICANT = 4.0  # error bars
# 1/m: what is known of a ball's drag before its flights are seen. Golf, baseball 0.005; tennis, football, basketball, volleyball
# 0.015 to 0.025 (half of 1.2 kg/m^3, drag coefficient and cross-section, by the mass)
USUAL_DRAG = 0.03
DIFFERENT = 3.0  # standard deviations of a chi^2, beyond which films have air of their own
MIN_TILT = np.radians(0.2)
USUAL_ROLL = np.radians(1.0)  # what is known of a camera on a stand before the flights are seen
ROUNDS = 6
CORRELATED = 4.0  # standard deviations of the correlation of independent residuals
MIN_FLIGHTS_APART = 3  # from which their differences show errors beyond the noise: spin, the lens


class Air(NamedTuple):
    """Accelerations of a ball in flight besides the size of gravity."""

    down: tuple[float, float] = (0.0, -1.0)
    """The direction of gravity in the picture."""
    drag_per_metre: float = 0.0
    """1/m: the air slows a ball of speed v down by drag_per_metre v^2."""
    drag_error: float = 0.0
    seen: tuple[float, float] | None = None
    """The drag as the flights alone show it, with its error; None: it was given, or there is no flight."""
    tilt: float = 0.0
    """By how much gravity probably points to the right of ``down``, rad: too little to turn the walls that were found."""
    tilt_error: float = 0.0
    """Standard deviation of the tilt if the drag were known, rad."""
    tilt_by_drag: float = 0.0
    """By how much the tilt changes with the drag, rad m: drag along the floor looks like a rolled camera."""

    def with_drag(self, drag: float, drag_error: float) -> Air:
        """Return the same with another drag."""
        tilt = self.tilt + self.tilt_by_drag * (drag - self.drag_per_metre)
        return self._replace(drag_per_metre=drag, drag_error=drag_error, tilt=tilt)

    @property
    def drag_shown(self) -> bool:
        """Whether the drag was given, or is significant."""
        return self.drag_per_metre > SIGNIFICANT * self.drag_error


STILL_AIR = Air()


class Flights(NamedTuple):
    """Gravity and drag from all flights of a film."""

    gravity: Array
    """(2,) m/s^2."""
    drag_per_metre: float
    """1/m."""
    covariance: Array
    """(3, 3), of gravity and drag."""

    @property
    def tilt(self) -> tuple[float, float]:
        """By how much gravity points to the right of straight down, and its standard deviation, rad."""
        x, y = self.gravity
        across = np.array([-y, x]) / (x * x + y * y)
        return float(np.arctan2(x, -y)), float(np.sqrt(across @ self.covariance[:2, :2] @ across))

    @property
    def tilt_by_drag(self) -> float:
        """By how much the tilt changes where the drag is another, rad m."""
        x, y = self.gravity
        across = np.array([-y, x]) / (x * x + y * y)
        return float(across @ self.covariance[:2, 2] / self.covariance[2, 2]) if self.covariance[2, 2] > 0 else 0.0

    @property
    def drag_error(self) -> float:
        """Standard deviation of the drag, 1/m."""
        return float(np.sqrt(self.covariance[2, 2]))


def flight_path(velocity: Array, gravity: Array, drag: Array | float, s: Array) -> Array:
    """Return how far a ball with a velocity (..., 2), m/s, has moved after the times s (n,), s, some of them negative: (..., n, 2).

    ``gravity`` (..., 2), m/s^2; ``drag`` (...), 1/m.
    """
    shape = velocity.shape[:-1]
    v, g = (np.array(np.broadcast_to(one, (*shape, 2)), dtype=float).reshape(-1, 2) for one in (velocity, gravity))
    k = np.array(np.broadcast_to(drag, shape), dtype=float).ravel()
    count = max(int(np.ceil(np.abs(s).max(initial=0.0) / STEP_S)), 1)
    places = np.empty((len(v), len(s), 2))
    _compiled(_fill_flights)(v, g, k, np.ascontiguousarray(s, dtype=float), count, places)
    return places.reshape(*shape, len(s), 2)


@kernel
def _acceleration(vx: float, vy: float, gx: float, gy: float, k: float) -> tuple[float, float]:
    speed = math.sqrt(vx * vx + vy * vy)
    return gx - k * speed * vx, gy - k * speed * vy


def _fill_flights(velocity: Any, gravity: Any, drag: Any, s: Any, count: int, places: Any) -> None:
    """Fill the displacements (B, n, 2) of B flights after the times s (n,), in ``count`` steps of each."""
    for b in range(velocity.shape[0]):
        gx, gy, k = gravity[b, 0], gravity[b, 1], drag[b]
        for i in range(s.shape[0]):
            x, y, vx, vy, h = 0.0, 0.0, velocity[b, 0], velocity[b, 1], s[i] / count
            for _ in range(count):  # Runge and Kutta, fourth order: exact for a parabola
                ax, ay = _acceleration(vx, vy, gx, gy, k)
                bx, by = _acceleration(vx + h / 2 * ax, vy + h / 2 * ay, gx, gy, k)
                cx, cy = _acceleration(vx + h / 2 * bx, vy + h / 2 * by, gx, gy, k)
                dx, dy = _acceleration(vx + h * cx, vy + h * cy, gx, gy, k)
                x = x + h * vx + h * h / 6 * (ax + bx + cx)
                y = y + h * vy + h * h / 6 * (ay + by + cy)
                vx, vy = vx + h / 6 * (ax + 2 * bx + 2 * cx + dx), vy + h / 6 * (ay + 2 * by + 2 * cy + dy)
            places[b, i, 0], places[b, i, 1] = x, y


def air_and_notes(
    tracks: Sequence[Track],
    noise: float,
    interval: float,
    gravity: float,
    drag_per_metre: float | None,
    walls_given: bool,
) -> tuple[Air, list[str]]:
    """Return the direction of gravity and the drag as far as the flights show them, and notes on both.

    ``drag_per_metre``: if it is known. Where no tilt is significant, the walls are found in an upright picture. A tilt and a
    drag that are not significant are the estimates all the same, drawn toward 0 by what is usual, and have errors: left out, the
    drag would make restitutions too low, and the tilt, which turns part of v_n into v_t, friction too high or too low.
    """
    found = fit_flights(tracks, noise, interval, gravity, drag_per_metre)
    air = STILL_AIR._replace(drag_per_metre=drag_per_metre or 0.0, tilt_error=0.0 if walls_given else USUAL_ROLL)
    if drag_per_metre is None:
        weights = USUAL_DRAG**-2, found.drag_error**-2 if found is not None and found.drag_error > 0 else 0.0
        middle = found.drag_per_metre * weights[1] / sum(weights) if found is not None else 0.0
        seen = (found.drag_per_metre, found.drag_error) if found is not None and found.drag_error > 0 else None
        air = air._replace(drag_per_metre=max(middle, 0.0), drag_error=sum(weights) ** -0.5, seen=seen)
    notes: list[str] = []
    if found is None:
        return air, notes
    angle, error = found.tilt
    turned = abs(angle) > max(MIN_TILT, SIGNIFICANT * error)
    own = max(error**2 - (found.tilt_by_drag * found.drag_error) ** 2, 0.0)
    # of the flights' own tilt, as drawn to 0; given walls stand, however the camera was rolled
    weight = 0.0 if walls_given else 1.0 if turned else USUAL_ROLL**2 / (USUAL_ROLL**2 + own)
    air = air._replace(
        tilt=0.0 if turned else weight * angle, tilt_error=(weight * own) ** 0.5, tilt_by_drag=weight * found.tilt_by_drag,
    )  # fmt: skip
    shown = drag_per_metre is None and found.drag_per_metre > SIGNIFICANT * found.drag_error
    to = (found.drag_per_metre, found.drag_error) if shown else (air.drag_per_metre, air.drag_error)
    air = air._replace(drag_per_metre=found.drag_per_metre).with_drag(*to)
    if turned:
        air = air._replace(down=(float(np.sin(angle)), float(-np.cos(angle))))
        side = "right" if angle > 0 else "left"
        floor = (
            "the walls are taken as they were given"
            if walls_given
            else "the floor is taken to be perpendicular to it (`wall` x1,y1,x2,y2 gives another)"
        )
        notes.append(
            f"the camera is rolled: gravity points {np.degrees(abs(angle)):.2f} ± {np.degrees(error):.1g}° to the {side} of"
            f" straight down; {floor}"
        )
    if shown:
        notes.append(
            f"{drag_in_words(air)}, as its flights show; the velocities at contacts allow for it (`drag_per_metre` gives k, 0 for"
            " none)"
        )
    return air, notes


def drag_in_words(air: Air) -> str:
    """Return the drag with its error."""
    return f"air drag: at the speed v the air slows the ball down by k v^2, k = {air.drag_per_metre:.3g} ± {air.drag_error:.1g} 1/m"


def joint_air(airs: Sequence[Air]) -> Air | None:
    """Return the drag that films of one ball show together; None where they differ by more than their errors, or one is given.

    Each film's own estimate is drawn toward 0 by what is usual; taken one by one that would bias all of them to the same side.
    """
    seen = np.array([air.seen for air in airs if air.seen is not None])
    if len(seen) < 2:
        return None
    weight = seen[:, 1] ** -2
    mean = float((weight * seen[:, 0]).sum() / weight.sum())
    apart, dof = float((weight * np.square(seen[:, 0] - mean)).sum()), len(seen) - 1
    if apart > dof + DIFFERENT * (2 * dof) ** 0.5:
        return None
    total = float(weight.sum()) + USUAL_DRAG**-2
    return Air(drag_per_metre=max(mean * float(weight.sum()) / total, 0.0), drag_error=total**-0.5)


def fit_flights(
    tracks: Sequence[Track], noise: float, interval: float, gravity: float, drag_per_metre: float | None = None
) -> Flights | None:
    """Fit gravity and drag to all free flights of a film; None if there is none.

    Parameters
    ----------
    tracks : sequence of Track
        Frames in which the balls were found, filmed from the side.
    noise : float
        Standard deviation of one coordinate, m.
    interval : float
        Between frames, s.
    gravity : float
        Its approximate size, m/s^2, by which flights are told from other motion.
    drag_per_metre : float, optional
        1/m, if it is known.

    Examples
    --------
    >>> import numpy as np
    >>> from carom.tracks import Track
    >>> from carom.tracks.flights import fit_flights, flight_path
    >>> times = np.arange(80) / 200
    >>> place = flight_path(np.array([1.0, 2.0]), np.array([0.0, -9.81]), 0.02, times)
    >>> found = fit_flights([Track("ball", times, place)], 1e-4, 1 / 200, 9.8)
    >>> found.gravity.round(3) + 0.0, round(found.drag_per_metre, 5)
    (array([ 0.  , -9.81]), 0.02)
    """
    flights = [one for track in tracks for one in _flights(track, noise, interval, gravity)]
    shared = np.array([0.0, -gravity, drag_per_metre or 0.0])
    free = np.array([True, True, drag_per_metre is None])
    for _ in range(2):  # the second time without flights that turn out to be something else
        if not flights:
            return None
        starts = [np.zeros(4) for _ in flights]
        shared, parts = _fit_together(flights, starts, shared, free, noise)
        good = [float(r @ r) < MAX_SCATTER**2 * max(len(r) - 4, 1) for _b, r in parts]
        if all(good):
            break
        flights = [one for one, fits in zip(flights, good, strict=True) if fits]
    else:
        return None
    return Flights(shared[:2], float(shared[2]), _covariance(parts, free))


def _fit_together(
    flights: list[tuple[Array, Array]], starts: list[Array], shared: Array, free: NDArray[np.bool_], noise: float
) -> tuple[Array, list[tuple[Array, Array]]]:
    """Return gravity and drag (3,), and of each flight the derivatives and residuals, without what its own start can fit.

    Residuals are infinite where Gauss and Newton's steps leave all paths that a ball can take.
    ``starts``: place and velocity (4,) in the middle of each flight, relative to the mean of its positions.
    """
    parts: list[tuple[Array, Array]] = []
    lost = [(np.zeros((1, int(free.sum()))), np.full(1, np.inf)) for _ in flights]
    for _ in range(ROUNDS):
        parts, own = [], []
        for (s, x), start in zip(flights, starts, strict=True):
            theta = np.concatenate([start, shared])
            step = np.array([1e-4, 1e-4, 1e-3, 1e-3, 1e-3, 1e-3, 1e-4])
            several = np.concatenate([[theta], theta + np.diag(step), theta - np.diag(step)])
            path = several[:, None, :2] + flight_path(several[:, 2:4], several[:, 4:6], several[:, 6], s)
            if not np.abs(path).max() < MAX_PATH_M:
                return shared, lost
            r = ((x - path[0]) / noise).ravel()
            slope = ((path[1:8] - path[8:]) / (2 * step[:, None, None] * noise)).reshape(7, -1).T
            q, upper = np.linalg.qr(slope[:, :4])
            parts.append((slope[:, 4:][:, free] - q @ (q.T @ slope[:, 4:][:, free]), r - q @ (q.T @ r)))
            own.append((q, upper, r, slope[:, 4:][:, free]))
        change = np.linalg.lstsq(
            np.concatenate([b for b, _r in parts]), np.concatenate([r for _b, r in parts]), rcond=None
        )[0]
        shared = shared.copy()
        shared[free] += change
        try:
            starts = [
                start + np.linalg.solve(upper, q.T @ (r - b @ change))
                for start, (q, upper, r, b) in zip(starts, own, strict=True)
            ]
        except np.linalg.LinAlgError:  # (a path that no longer depends on its start)
            return shared, lost
    return shared, parts


def _covariance(parts: list[tuple[Array, Array]], free: NDArray[np.bool_]) -> Array:
    """Return the covariance (3, 3) of gravity and drag: from the residuals, or from how flights differ, if that is more."""
    slope, r = np.concatenate([b for b, _r in parts]), np.concatenate([r for _b, r in parts])
    inverse = np.linalg.pinv(slope.T @ slope, hermitian=True)
    measured = (np.abs(r) > EXACT).mean()  # (of a height alone, the other coordinate leaves no residuals)
    dof = measured * (len(r) - 4 * len(parts) - int(free.sum()))
    covariance = inverse * max(float(r @ r) / max(dof, 1), 1e-12)
    neighbours = sum(float((one[2:] * one[:-2]).sum()) for _b, one in parts) / max(float(r @ r), 1e-300)
    if neighbours > CORRELATED / np.sqrt(len(r)):  # noise that fades by this factor from frame to frame
        covariance = covariance * ((1 + neighbours) / (1 - neighbours))
    if len(parts) >= MIN_FLIGHTS_APART:
        pull = np.array([b.T @ r for b, r in parts])
        apart = inverse @ (pull.T @ pull) @ inverse * len(parts) / (len(parts) - 1)
        covariance = covariance * max(1.0, float((np.diag(apart) / np.maximum(np.diag(covariance), 1e-300)).max()))
    found = np.zeros((3, 3))
    found[np.ix_(free, free)] = covariance
    return found


def _flights(track: Track, noise: float, interval: float, gravity: float) -> list[tuple[Array, Array]]:
    """Return the flights of a ball: times (n,) from the middle of each, and positions (n, 2) from their mean."""
    t, x = track.time, track.position
    if len(t) < MIN_FRAMES:
        return []
    reach = frames_per_side(t)
    turns = np.concatenate([turning_points(d, noise, reach) for d in (x[:, 1], x[:, 0], -x[:, 0])])
    onset = [event.high for event in find_events(track, (), (), noise, None, interval) if event.kind == "onset"]
    cuts = [*t[turns].tolist(), *onset]
    use = np.ones(len(t), bool)
    for cut in cuts:
        use &= np.abs(t - cut) > max(NEAR_FRAMES * interval, NEAR_S)
    rows = np.flatnonzero(use)
    breaks = np.flatnonzero(
        (np.diff(t[rows]) > GAP_FRAMES * interval) | (np.diff(np.searchsorted(np.sort(cuts), t[rows])) > 0)
    )
    found = []
    for some in np.split(rows, breaks + 1):
        if len(some) < MIN_FRAMES or t[some[-1]] - t[some[0]] < MIN_FLIGHT_S:
            continue
        s = t[some] - (t[some[0]] + t[some[-1]]) / 2
        y = x[some] - x[some].mean(axis=0)
        curve = np.polynomial.polynomial.polyfit(s, y, 3)  # drag bends a parabola nearly as a cubic
        scatter = y - np.stack([s**0, s, s**2, s**3], axis=-1) @ curve
        fall = -2 * np.polynomial.polynomial.polyfit(s, y[:, 1], 2)[2]
        if abs(fall / gravity - 1) < GRAVITY_SHARE and (scatter**2).mean() < (MAX_SCATTER * noise) ** 2:
            found.append((s, y))
    return found


# ----------------------------------------------------------------------------------------------------
# Free fall in tracks filmed from the side: its acceleration, and the unit, frame rate or axis that would make it gravity's.


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
# Where a bounce in its place is tried, and by how much chi2 excludes it
CORNERS, NO_CORNER = (-0.5, -0.25, 0.0, 0.25, 0.5), 9.0
# Of gravity, the largest deceleration on a table; a speed, m/s, that counts as motion; slope of a path that is level
MAX_SLIDING, MOVING, LEVEL = 0.7, 0.15, 0.1
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
    >>> from carom.tracks.flights import constant_acceleration
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
    >>> from carom.tracks.flights import in_a_plane
    >>> t = np.arange(80) / 200
    >>> place = np.stack([3 * t, 1 + 2 * t - 9.81 / 2 * t**2, 4 * t], axis=-1)
    >>> (ball,) = in_a_plane([Track("ball", t, place)], [])
    >>> ball.position[-1].round(3)  # 5 m/s along the floor
    array([1.975, 1.025])
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
    down, up = (falls_freely(tracks, sign * gravity) for sign in (1, -1))
    if down > up:  # (pieces of few frames with a bounce in them look like a fall upward)
        return 0.0
    if up or falling_share(tracks, -gravity) > MIN_FALLING_SHARE:
        return gravity
    return max(float(np.nan_to_num(constant_acceleration(tracks))), 0.0)


def likely_unit(tracks: Sequence[Track]) -> tuple[str, float]:
    """Return the unit in which lengths read as m probably are (cm, mm, in; empty: m), and the acceleration of the fall, m/s^2.

    Examples
    --------
    >>> import numpy as np
    >>> from carom.tracks import Track
    >>> from carom.tracks.flights import likely_unit
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


# ----------------------------------------------------------------------------------------------------
# Fit of a contact of a ball in flight: two parabolas, or paths with air drag, that meet at the wall.


# The parameters: the starting values, and gravity
TIME, PLACE, DISTANCE, V_IN, V_OUT, PULL = 0, slice(1, 3), 1, START_IN, START_OUT, slice(7, 9)
DRAG_STEP = 1e-3  # 1/m, by which the derivative by the drag is taken


def _position(theta: Array, t: Array, drag: float) -> Array:
    s = t - theta[TIME]
    if drag == 0:
        velocity = np.where(s[:, None] < 0, theta[V_IN], theta[V_OUT])
        return np.asarray(theta[PLACE] + velocity * s[:, None] + theta[PULL] * (s * s / 2)[:, None])
    sides = [flight_path(theta[side], theta[PULL], drag, s[rows]) for side, rows in ((V_IN, s < 0), (V_OUT, s >= 0))]
    found = np.empty((len(s), 2))
    found[s < 0], found[s >= 0] = sides
    return found + theta[PLACE]


def _slope_in_vacuum(theta: Array, t: Array) -> Array:
    """Return the derivatives (n, 2, 9) of the positions with respect to theta, without drag."""
    s = t - theta[TIME]
    found = np.zeros((len(t), 2, len(theta)))
    for component in (0, 1):
        for part, rows in ((V_IN, s < 0), (V_OUT, s >= 0)):
            found[rows, component, TIME] = -theta[part][component] - theta[PULL][component] * s[rows]
            found[rows, component, part.start + component] = s[rows]
        found[:, component, PLACE.start + component] = 1.0
        found[:, component, PULL.start + component] = s * s / 2
    return found


def _outputs(theta: Array) -> Array:
    """Return the quantities of OUTPUTS, with the components of gravity for mu_g and c_g."""
    return np.array([*theta[: V_OUT.stop], *[np.nan] * 6, *theta[PULL], np.nan, np.nan])


def fit_flight(
    time: Array, position: Array, near: float, noise: float, gravity: Array, error: float, wall: float | None = None,
    air: Air = STILL_AIR, whiten: Array | None = None,
) -> ContactFit:  # fmt: skip
    """Fit a contact of a ball in flight.

    Parameters as in :func:`carom.tracks.contact_models.fit_table`; ``gravity`` (2,), m/s^2, is a prior in the frame of the wall
    with the standard deviation ``error``; ``whiten`` (n, n) makes the errors of the frames independent; of ``air`` the drag
    and the tilt count, and their errors are part of those of the result. In the result the fitted gravity takes the place of mu_g
    (away from the wall) and c_g (along it).
    """
    theta = np.concatenate([starting_values(time, position, time < near, time >= near, near), gravity])
    scale = np.array([1e-3, 1e-3, 1e-3, *[0.05] * 4, *[0.2] * 2])

    # a drag that the flights do not show changes the velocities little: by the derivatives, after a fit without it
    used = air.drag_per_metre if air.drag_shown else 0.0

    known_slope = np.zeros((2 if wall is None else 3, len(theta)))
    known_slope[0, PULL.start] = known_slope[1, PULL.start + 1] = 1 / error
    if wall is not None:
        known_slope[2, DISTANCE] = 1 / noise

    def residual(theta: Array, drag: float = used) -> Array:
        gap = (position - _position(theta, time, drag)) / noise
        gap = gap if whiten is None else whiten @ gap
        known = list((theta[PULL] - gravity) / error)
        if wall is not None:
            known.append((theta[DISTANCE] - wall) / noise)
        return np.concatenate([gap.ravel(), known])

    def slope(theta: Array) -> Array:
        if used:
            return central_differences(residual, theta, 1e-4 * scale)
        places = _slope_in_vacuum(theta, time) / -noise
        frames = places if whiten is None else np.tensordot(whiten, places, 1)
        return np.concatenate([frames.reshape(-1, len(theta)), known_slope])

    best, _chi2 = solve(residual, slope, theta, scale)
    early, late = time[time < near][-1], time[time >= near][0]
    if not 2 * early - late < best[TIME] < 2 * late - early:  # straight lines through bent flights met elsewhere
        fall = gravity * (np.square(time - near) / 2)[:, None]
        theta = np.concatenate([starting_values(time, position - fall, time < near, time >= near, near), gravity])
        best, _chi2 = solve(residual, slope, theta, scale)
    rates = slope(best)
    if used and not np.isfinite(rates.T @ rates).all():  # (it carries the paths beyond all numbers)
        return fit_flight(time, position, near, noise, gravity, error, wall, air._replace(drag_per_metre=0.0), whiten)
    found = propagated(best, np.ones(len(theta), bool), residual, rates, _outputs, scale, 2 * len(time))
    rows = nearest_frames(time, best[TIME])
    t = time[rows]
    slopes = central_differences(lambda one: _position(one, t, used).ravel(), best, 1e-4 * scale)
    measured = np.ptp(position, axis=0) > 0  # (of a height alone, the other coordinate is 0 throughout)
    slopes = slopes.reshape(-1, 2, len(best))[:, measured]
    gaps = position - _position(best, time, used)
    fitted = FittedFrames(t, gaps[rows][:, measured], slopes, rates[2 * len(time) :], noise)
    found["dof"] -= float((~measured).sum() * (len(time) - (PLACE.stop - PLACE.start) - 1))
    # velocities in the frame of a wall that is turned counter-clockwise, per radian
    turn = np.nan_to_num(_outputs(np.concatenate([np.zeros(3), *(_turned(best[of]) for of in (V_IN, V_OUT, PULL))])))
    shifts = {"roll": turn * air.tilt_error} if air.tilt_error else {}
    found["value"] = found["value"] + turn * air.tilt
    if air.drag_error:
        change = (residual(best, used + DRAG_STEP) - residual(best, used - DRAG_STEP)) / (2 * DRAG_STEP)
        by_drag = np.nan_to_num(_outputs(best - np.linalg.lstsq(rates, change, rcond=None)[0]) - _outputs(best))
        found["value"] = found["value"] + by_drag * (air.drag_per_metre - used)
        shifts["drag"] = (by_drag + turn * air.tilt_by_drag) * air.drag_error
    found["covariance"] = found["covariance"] + sum(np.outer(shift, shift) for shift in shifts.values())
    return ContactFit(
        **found, noise=noise, time=time, residuals=gaps, fitted=fitted, shifts=shifts, slid_before=False,
        position=partial(_position, best, drag=used),
    )  # fmt: skip


def _turned(v: Array) -> Array:
    """Return by how much the components (away, along) of a vector change per radian by which the wall turns."""
    return np.array([v[1], -v[0]])


def with_other_drag(fit: ContactFit, was: Air, now: Air) -> ContactFit:
    """Return a fit with another drag and error: the outputs are linear in the drag as far as these go."""
    if "drag" not in fit.shifts or not was.drag_error:
        return fit
    old = fit.shifts["drag"]
    shift = old * (now.drag_error / was.drag_error)
    covariance = fit.covariance - np.outer(old, old) + np.outer(shift, shift)
    value = fit.value + old * ((now.drag_per_metre - was.drag_per_metre) / was.drag_error)
    return replace(fit, value=value, covariance=covariance, shifts={**fit.shifts, "drag": shift})
