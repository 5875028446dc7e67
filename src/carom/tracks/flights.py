"""Free flights of a ball filmed from the side: where gravity points in the picture, and how much the air slows the ball down.

Between two contacts the ball moves with the acceleration g - k |v| v, k the drag per mass (1/m): it loses more speed as it rises
than it gains as it falls. All flights of a film are fitted together, each with its own start, with one g and one k.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.core.jit.kernel import kernel
from carom.tracks.events import find_events, frames_per_side, turning_points
from carom.tracks.track import Track

__all__ = [
    "STILL_AIR",
    "Air",
    "Flights",
    "air_and_notes",
    "fit_flights",
    "flight_path",
]

Array = NDArray[np.float64]
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
    drag: float = 0.0
    """1/m: the air slows a ball of speed v down by drag v^2."""
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
        tilt = self.tilt + self.tilt_by_drag * (drag - self.drag)
        return self._replace(drag=drag, drag_error=drag_error, tilt=tilt)

    @property
    def drag_shown(self) -> bool:
        """Whether the drag was given, or is significant."""
        return self.drag > SIGNIFICANT * self.drag_error


STILL_AIR = Air()


class Flights(NamedTuple):
    """Gravity and drag from all flights of a film."""

    gravity: Array
    """(2,) m/s^2."""
    drag: float
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
    _compiled()(v, g, k, np.ascontiguousarray(s, dtype=float), count, places)
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


@functools.cache
def _compiled() -> Callable[..., None]:
    from carom.core.jit.compile import njit

    return njit(_fill_flights)


def air_and_notes(
    tracks: Sequence[Track], noise: float, interval: float, gravity: float, drag: float | None, walls_given: bool
) -> tuple[Air, list[str]]:
    """Return the direction of gravity and the drag as far as the flights show them, and notes on both.

    ``drag``: 1/m, if it is known. Where no tilt is significant, the walls are found in an upright picture. A tilt and a drag that
    are not significant are the estimates all the same, drawn toward 0 by what is usual, and have errors: left out, the drag would
    make restitutions too low, and the tilt, which turns part of v_n into v_t, friction too high or too low.
    """
    found = fit_flights(tracks, noise, interval, gravity, drag)
    air = STILL_AIR._replace(drag=drag or 0.0, tilt_error=0.0 if walls_given else USUAL_ROLL)
    if drag is None:
        weights = USUAL_DRAG**-2, found.drag_error**-2 if found is not None and found.drag_error > 0 else 0.0
        middle = found.drag * weights[1] / sum(weights) if found is not None else 0.0
        seen = (found.drag, found.drag_error) if found is not None and found.drag_error > 0 else None
        air = air._replace(drag=max(middle, 0.0), drag_error=sum(weights) ** -0.5, seen=seen)
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
    shown = drag is None and found.drag > SIGNIFICANT * found.drag_error
    to = (found.drag, found.drag_error) if shown else (air.drag, air.drag_error)
    air = air._replace(drag=found.drag).with_drag(*to)
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
            f"{drag_in_words(air)}, as its flights show; the velocities at contacts allow for it (`drag` gives k, 0 for none)"
        )
    return air, notes


def drag_in_words(air: Air) -> str:
    """Return the drag with its error."""
    return (
        f"air drag: at the speed v the air slows the ball down by k v^2, k = {air.drag:.3g} ± {air.drag_error:.1g} 1/m"
    )


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
    return Air(drag=max(mean * float(weight.sum()) / total, 0.0), drag_error=total**-0.5)


def fit_flights(
    tracks: Sequence[Track], noise: float, interval: float, gravity: float, drag: float | None = None
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
    drag : float, optional
        1/m, if it is known.

    Examples
    --------
    >>> import numpy as np
    >>> from carom.tracks import Track
    >>> from carom.tracks.flights import fit_flights, flight_path
    >>> times = np.arange(80) / 200
    >>> place = flight_path(np.array([1.0, 2.0]), np.array([0.0, -9.81]), 0.02, times)
    >>> found = fit_flights([Track("ball", times, place)], 1e-4, 1 / 200, 9.8)
    >>> found.gravity.round(3) + 0.0, round(found.drag, 5)
    (array([ 0.  , -9.81]), 0.02)
    """
    flights = [one for track in tracks for one in _flights(track, noise, interval, gravity)]
    shared = np.array([0.0, -gravity, drag or 0.0])
    free = np.array([True, True, drag is None])
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
