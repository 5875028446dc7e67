"""A contact on a table: the ball slides or rolls before it, and slides, then rolls after it.

Coulomb's friction while it slides, constant resistance while it rolls (carom.motion.phases).
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from carom.tracks.fitted import OUTPUTS, Fitted, Prior, guess, solve, told, unseen
from carom.tracks.legs import leg, slopes

__all__ = ["fit_table", "tells_rolling"]

Array = NDArray[np.float64]
Free = NDArray[np.bool_]

# Chance of chi2 with two degrees of freedom above this: 1 %. A slide before the contact has to earn its two parameters.
EARNED = 9.21
# With one: a ball that slides until the contact.
EARNED_ON = 6.63
# chi2 that a slide all the way to the contact has to be worth, so that one that is there is seen with near certainty.
SEEN = 20.0
FEW_AFTER = 15  # frames
SHORT = 3.0  # frames: a slide that may be another's, found before the cloth was known
FEWEST_SLIDING = 6  # frames before the contact, to tell a slide from noise
SLACK = 0.02  # s that a contact may be from where the frames turn, at most
_NUMBERS = np.arange(13)
# Which parameters are free: of a ball that rolls, that slides on until the contact, that slides and then rolls.
ROLLING, SLIDING_ON, SLIDING = (_NUMBERS != 5) & (_NUMBERS != 6), _NUMBERS != 5, _NUMBERS >= 0
FLOOR_HELD = _NUMBERS < 11

# theta: t_c, x_c (2), V (2), s0, phi0, v1 (2), u1 (2), mu_g, c_g. Before the contact the ball has, at the first frame, a slip
# u0 of size s0 in the direction phi0, and the velocity V + k u0: V is what it rolls with, which late frames tell even where
# they tell nothing of u0.


def _slip(theta: Array) -> Array:
    return np.asarray(theta[5] * np.array([np.cos(theta[6]), np.sin(theta[6])]))


def _table_before(theta: Array, since: float, t: Array, k: float) -> tuple[Array, Array, Array]:
    """Places at t, and velocity and slip at the contact."""
    u0 = _slip(theta)
    span = max(theta[0] - since, 0.0)
    way = leg(theta[3:5] + k * u0, u0, np.append(np.clip(t - since, 0.0, span), span), theta[11], theta[12], k)
    return theta[1:3] + way.way[:-1] - way.way[-1], way.velocity[-1], way.slip[-1]


def _table_places(theta: Array, since: float, t: Array, k: float) -> Array:
    before = t < theta[0]
    places = np.empty((len(t), 2))
    places[before] = _table_before(theta, since, t[before], k)[0]
    after = leg(theta[7:9], theta[9:11], t[~before] - theta[0], theta[11], theta[12], k)
    places[~before] = theta[1:3] + after.way
    return places


def _table_slope(theta: Array, since: float, t: Array, k: float) -> Array:
    """Derivatives (n, 2, 13) of the places by theta."""
    found = np.zeros((len(t), 2, 13))
    found[:, 0, 1] = found[:, 1, 2] = 1.0
    before = t < theta[0]
    u0 = _slip(theta)
    span = max(theta[0] - since, 0.0)
    s = np.append(np.clip(t[before] - since, 0.0, span), span)
    _way, v, by = slopes(theta[3:5] + k * u0, u0, s, theta[11], theta[12], k)
    by = by[:-1] - by[-1]
    by_slip = by[:, :, 2:4] + k * by[:, :, 0:2]
    found[before, :, 0] = -v[-1]
    found[before, :, 3:5] = by[:, :, 0:2]
    found[before, :, 5] = by_slip @ np.array([np.cos(theta[6]), np.sin(theta[6])])
    found[before, :, 6] = by_slip @ np.array([-u0[1], u0[0]])
    found[before, :, 11:] = by[:, :, 4:]
    _way, v, by = slopes(theta[7:9], theta[9:11], t[~before] - theta[0], theta[11], theta[12], k)
    found[~before, :, 0] = -v
    found[~before, :, 7:] = by
    return found


def _table_outputs(theta: Array, since: float, k: float) -> Array:
    _places, v, u = _table_before(theta, since, np.zeros(0), k)
    v1, u1 = theta[7:9], theta[9:11]
    slides = k * np.sqrt(u1 @ u1) / theta[11]
    return np.array([*theta[:3], *v, *v1, *(v1 - k * u1), *u, *u1, theta[11], theta[12], slides])


class _Table:
    """The least-squares problem of one contact."""

    def __init__(
        self, time: Array, position: Array, near: float, noise: float, prior: Prior, wall: float | None, weight: Array
    ) -> None:
        self.weight = np.repeat(weight, 2)
        self.time, self.position, self.noise, self.prior, self.wall = time, position, noise, prior, wall
        self.k, self.since = prior.k, float(time[0])
        before, after = time < near, time >= near
        self.after, self.interval = int(after.sum()), float(np.median(np.diff(time)))
        start = guess(time, position, before, after, near)
        self.start = np.concatenate([start[:5], [0.0, 0.0], start[5:], [0.0, 0.0], [prior.mu_g, prior.c_g]])
        self.scale = np.array([1e-3, 1e-3, 1e-3, *[0.05] * 2, 0.3, 0.3, *[0.05] * 2, *[0.3] * 2, 0.2, 0.03])
        # no wall gives a ball more slip than its speed accounts for
        far = 0.2 + 2.0 * float(np.hypot(*start[3:5]))
        self.low, self.high = np.full(13, -np.inf), np.full(13, np.inf)
        # the frame nearest to the wall is that of the contact, but for its noise
        hole = max(time[after][0] - time[before][-1], self.interval)
        hole += min(4 * noise / max(min(abs(start[3]), abs(start[5])), 1e-9), SLACK)
        self.low[0], self.high[0] = time[before][-1] - hole, time[after][0] + hole
        self.low[5], self.low[11], self.low[12] = 0.0, prior.mu_g / 20, 0.0
        self.high[11] = prior.mu_g * 20
        # what is known besides the frames, one row each: the floor, the slip after, the wall's place
        known = [(11, prior.mu_g, prior.mu_g_error), (12, prior.c_g, prior.c_g_error), (9, 0.0, far), (10, 0.0, far)]
        if wall is not None:
            known.append((1, wall, noise))
        self.known = known
        self.known_slope = np.zeros((len(known), 13))
        for row, (i, _value, error) in enumerate(known):
            self.known_slope[row, i] = 1 / error

    def residual(self, theta: Array) -> Array:
        """In standard deviations: frames, then what is known besides."""
        gap = (self.position - _table_places(theta, self.since, self.time, self.k)) / self.noise
        return np.concatenate(
            [gap.ravel() * self.weight, [(theta[i] - value) / error for i, value, error in self.known]]
        )

    def slope(self, theta: Array) -> Array:
        """Its derivatives."""
        places = _table_slope(theta, self.since, self.time, self.k)
        return np.concatenate([places.reshape(-1, 13) * (self.weight / -self.noise)[:, None], self.known_slope])

    def solve(self, start: Array, free: Free) -> tuple[Array, float]:
        """The best parameters from a start, of which only the free ones move, and the sum of squares."""

        def whole(part: Array) -> Array:
            filled = start.copy()
            filled[free] = part
            return filled

        found, cost = solve(
            lambda part: self.residual(whole(part)), lambda part: self.slope(whole(part))[:, free],
            start[free], self.scale[free], (self.low[free], self.high[free]),
            1e-4 if not free[11] else 1e-9,  # on the way there is no need to be exact
        )  # fmt: skip
        return whole(found), cost

    def rolling(self, old: Fitted | None) -> tuple[Array, tuple[Array, float]]:
        """A ball that rolls before the contact: with the floor as it is known, and with the floor free.

        Freed at once, a wrong floor would be found for what is a slide before the contact. ``old``: where an earlier fit ended.
        """
        tries = []
        if old is not None and not old.slid:
            start = old.theta.copy()
            start[11:] = self.start[11:]
            tries.append(self.solve(start, ROLLING & FLOOR_HELD))
        # few frames after can be had by a slide of some ms as well as by one that lasts, before the cloth is known
        if not tries or self.after < FEW_AFTER or (old is not None and old["slides"] < SHORT * self.interval):
            for spin_kept in (0.8, 0.2):
                start = self.start.copy()
                start[9:11] = start[7:9] - spin_kept * start[3:5]
                tries.append(self.solve(start, ROLLING & FLOOR_HELD))
        first = min(tries, key=lambda one: one[1])[0]
        return first, self.solve(first, ROLLING)

    def again(self, old: Fitted) -> tuple[Array, float, float, Free, bool]:
        """A ball that slides before the contact as an earlier fit found it: from other starts the slide after may be missed."""
        start, free, penalty = old.theta.copy(), SLIDING_ON if old.on else SLIDING, EARNED_ON if old.on else EARNED
        start[11:] = self.start[11:]
        return (*self.solve(self.solve(start, free & FLOOR_HELD)[0], free), penalty, free, old.on)

    def sliding(self, start: Array) -> list[tuple[Array, float, float, Free, bool]]:
        """A ball that slides before the contact, all the way or not: parameters, sum of squares, penalty, what was free."""
        on = self.solve(start, SLIDING_ON & FLOOR_HELD)[0]
        found = [(*self.solve(on, SLIDING_ON), EARNED_ON, SLIDING_ON, True)]
        frames = self.time[self.time < on[0]]
        v0 = on[3:5] + self.k * _slip(on)
        tries = []
        for end in (0.9, 0.6, 0.3):
            start = on.copy()
            start[5] = on[11] * end * (on[0] - self.since) / self.k
            start[3:5] = v0 - self.k * _slip(start)
            tries.append(start)
        for start in tries:
            other, cost = self.solve(self.solve(start, SLIDING & FLOOR_HELD)[0], SLIDING)
            # where it ends with the last frames, none tells how much slip was left: sliding on says the same with less
            if self.k * other[5] / other[11] < frames[-1] - self.since - 1.5 * self.interval:
                found.append((other, cost, EARNED, SLIDING, False))
                if cost < 1.3 * (2 * len(self.time) - len(_NUMBERS)):
                    break  # as good as it can be: other starts would end here too
        return found


def fit_table(
    time: Array, position: Array, near: float, noise: float, prior: Prior, wall: float | None = None,
    weight: Array | None = None, old: Fitted | None = None,
) -> Fitted:  # fmt: skip
    """A contact on a table, near the time ``near`` (s), from frames (n,) and places (n, 2) in the wall's frame (m).

    ``weight`` (n,): a row that is the mean of m frames has sqrt(m), and its residual is told times that. ``old``: an earlier fit,
    with another floor or noise, from which the search goes on.

    ``noise`` is that of one coordinate (m). With ``wall`` the motions meet at that distance, within the noise; else where
    they meet is free, which is right for a cushion that gives way.
    """
    weight = np.ones(len(time)) if weight is None else weight
    job = _Table(time, position, near, noise, prior, wall, weight)
    k, since = job.k, job.since
    first, (best, cost) = job.rolling(old)
    found = [(best, cost, 0.0, ROLLING, False)]
    gap = (position - _table_places(first, since, time, k)) * weight[:, None]
    start = _slide_before(time, gap, weight, first, noise, k)
    if start is not None:
        found += job.sliding(start)
    if old is not None and old.slid:
        found.append(job.again(old))
    best, _cost, _penalty, free, on = min(found, key=lambda one: one[1] + one[2])
    fitted = told(
        best, free, job.residual, job.slope(best), lambda theta: _table_outputs(theta, since, k),
        lambda t: _table_places(best, since, t, k), job.scale, time, noise, bool(free[6]), on,
    )  # fmt: skip
    fitted = replace(fitted, theta=best)
    if on:
        # it may have come to roll so short a time before the wall that no frame shows it
        late = best[11] * unseen(best[11], noise, time)
        e = np.zeros(len(OUTPUTS))
        e[3:5] = late / np.sqrt(3.0) * np.array([np.cos(best[6]), np.sin(best[6])])
        fitted = replace(fitted, covariance=fitted.covariance + np.outer(e, e))
    return fitted


def _slide_before(time: Array, gap: Array, weight: Array, rolling: Array, noise: float, k: float) -> Array | None:
    """Where to start from if the ball slides until the contact; None if the frames before it show no sign of sliding.

    Beside the line on which it rolls later, a ball that slides until T is -e mu g (T - t)^2 / 2 away: tried for some T.
    """
    rows = time < rolling[0]
    s, gap, weight = time[rows] - time[0], gap[rows] / noise, weight[rows, None]
    if len(s) < FEWEST_SLIDING:
        return None
    span = rolling[0] - time[0]
    most, direction = EARNED_ON, np.nan
    for end in span * np.array([0.1, 0.2, 0.35, 0.5, 0.75, 1.0, 1.5]):
        columns = np.stack([np.ones_like(s), s, np.maximum(end - s, 0.0) ** 2], axis=-1) * weight
        if (columns[:, 2] > 0).sum() < 2:
            continue
        solved = np.linalg.lstsq(columns, gap, rcond=None)[0]
        gain = float((gap**2).sum() - ((gap - columns @ solved) ** 2).sum())
        if gain > most:
            most, direction = gain, float(np.arctan2(-solved[2, 1], -solved[2, 0]))
    if not np.isfinite(direction):
        return None
    # no frame tells how much slip is left, and any size that lasts is as good
    start = rolling.copy()
    start[5], start[6] = 3 * rolling[11] * span / k, direction
    e = np.array([np.cos(direction), np.sin(direction)])
    start[3:5] += e * (rolling[11] * span / 2) - k * start[5] * e
    return start


def tells_rolling(frames: int, span: float, noise: float, mu_g: float) -> bool:
    """Whether so many frames over ``span`` s show that a ball slides, if it does: its way bends by mu g / 2 t^2.

    Off the straight line through them such a parabola is (mu g / 2) span^2 / (6 sqrt(5)) in the mean square.
    """
    bend = mu_g / 2 * span * span / (6 * np.sqrt(5.0))
    return frames >= FEWEST_SLIDING and bool(frames * (bend / noise) ** 2 > SEEN)
