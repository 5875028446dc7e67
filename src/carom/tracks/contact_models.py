"""Models of a contact on a table: the ball slides or rolls before it, and slides, then rolls after it.

There is Coulomb friction while the ball slides and constant resistance while it rolls (:mod:`carom.tracks.contact_models`). Each
model is fitted to the frames on both sides of the contact, in the frame of the wall (:mod:`carom.tracks.least_squares`).

A ball that rolls into a wall and touches it at its centre is lifted by the wall's friction, and hops before it slides. Seen from
above, a hop of duration T is hardly distinguishable from a start that is faster by mu g T / 2: frames show long hops, not short
ones. So each contact is fitted without a hop and with one, and all contacts with a wall decide (:mod:`carom.tracks.contact`).
"""

from __future__ import annotations

import functools
import math
from dataclasses import replace
from functools import partial
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.core.jit.compile import njit
from carom.core.jit.kernel import kernel
from carom.public.defaults import GRAVITY
from carom.tracks.least_squares import (
    OUTPUTS,
    START_IN,
    START_OUT,
    ContactFit,
    FittedFrames,
    Prior,
    nearest_frames,
    propagated,
    solve_free,
    starting_values,
    unresolved_time,
)

Array = NDArray[np.float64]
TINY = 1e-12
compiled = functools.cache(njit)  # (at the first call, and kept)


class TableMotion(NamedTuple):
    """Motion of a ball at n times since its start."""

    displacement: Array
    """(n, 2) from the start, m."""
    velocity: Array
    """(n, 2) m/s."""
    slip: Array
    """(n, 2) m/s."""


def slide_then_roll(v: Array, u: Array, t: Array, mu_g: float, c_g: float, k: float) -> TableMotion:
    """Compute the motion of a ball at times t (n,), s >= 0, after it had the velocity v (2,) and the slip u (2,), m/s.

    ``mu_g`` and ``c_g`` are the decelerations while it slides and rolls, m/s^2; k = kappa / (1 + kappa), 2/7 for a solid ball.
    """
    found = TableMotion(np.empty((len(t), 2)), np.empty((len(t), 2)), np.empty((len(t), 2)))
    compiled(_fill)(*_two(v), *_two(u), float(mu_g), float(c_g), float(k), np.ascontiguousarray(t), *found)
    return found


def hop_slide_roll(v: Array, u: Array, hop: float, t: Array, mu_g: float, c_g: float, k: float) -> Array:
    """Compute the displacement (n, 2) of a ball that hops for the time ``hop``, s, and then slides and rolls."""
    way = np.empty((len(t), 2))
    compiled(_fill_hop)(*_two(v), *_two(u), float(hop), float(mu_g), float(c_g), float(k), np.ascontiguousarray(t), way)
    return way


def landed(v: Array, u: Array, hop: float, mu_g: float, k: float) -> tuple[Array, Array]:
    """Return velocity and slip (2,) of a ball that has landed from a hop of the time ``hop``, s."""
    lost = u * _lost_at_landing(*_two(u), hop, mu_g, k)
    return v - lost, u - lost / k


def _two(vector: Array) -> tuple[float, float]:
    return float(vector[0]), float(vector[1])


# --- kernels ------------------------------------------------------------------------------------------------------------


@kernel
def _phases(
    t: float, vx: float, vy: float, ux: float, uy: float, mu_g: float, c_g: float, k: float
) -> tuple[float, float, float, float, float, float, float, float, float]:
    """Return slip, its direction and duration; speed and direction of rolling; how long the ball has slid and rolled at t."""
    slip = math.sqrt(ux * ux + uy * uy) + TINY
    slides = k * slip / mu_g
    rx, ry = vx - k * ux, vy - k * uy
    speed = math.sqrt(rx * rx + ry * ry) + TINY
    rolls = min(max(t - slides, 0.0), speed / max(c_g, TINY))
    return slip, ux / slip, uy / slip, slides, speed, rx / speed, ry / speed, min(t, slides), rolls


@kernel
def moved_after(
    t: float, vx: float, vy: float, ux: float, uy: float, mu_g: float, c_g: float, k: float
) -> tuple[float, float, float, float, float, float]:
    """Return displacement, velocity and slip, of x and y each, at the time t after the velocity v and the slip u."""
    slip, ex, ey, _slides, speed, px, py, f, h = _phases(t, vx, vy, ux, uy, mu_g, c_g, k)
    far, size = speed * h - c_g / 2 * h * h, max(slip - mu_g / k * t, 0.0)
    left_x, left_y = size * ex, size * ey
    # the slip times k is the velocity that the ball still loses
    return (
        vx * f - ex * (mu_g / 2 * f * f) + px * far,
        vy * f - ey * (mu_g / 2 * f * f) + py * far,
        px * (speed - c_g * h) + k * left_x,
        py * (speed - c_g * h) + k * left_y,
        left_x,
        left_y,
    )


@kernel
def moved_slopes(
    t: float, vx: float, vy: float, ux: float, uy: float, mu_g: float, c_g: float, k: float, row: Any
) -> None:
    """Fill the derivatives of the displacement at the time t by v, u, mu_g and c_g: the first six columns of ``row`` (2, 6)."""
    slip, ex, ey, slides, speed, px, py, f, h = _phases(t, vx, vy, ux, uy, mu_g, c_g, k)
    # contributions of rolling, through its initial velocity r, and of the end of the slide, through its time
    bent, turned = c_g / (2 * speed) * h * h, mu_g / (2 * slip) * f * f
    xx, xy, yy = h - (1 - px * px) * bent, px * py * bent, h - (1 - py * py) * bent
    endx, endy = px * c_g * h, py * c_g * h
    row[0, 0], row[0, 1], row[1, 0], row[1, 1] = f + xx, xy, xy, f + yy
    row[0, 2] = -(1 - ex * ex) * turned - k * xx + endx * (k / mu_g) * ex
    row[0, 3] = ex * ey * turned - k * xy + endx * (k / mu_g) * ey
    row[1, 2] = ex * ey * turned - k * xy + endy * (k / mu_g) * ex
    row[1, 3] = -(1 - ey * ey) * turned - k * yy + endy * (k / mu_g) * ey
    row[0, 4], row[1, 4] = -ex * (f * f / 2) - endx * (slides / mu_g), -ey * (f * f / 2) - endy * (slides / mu_g)
    row[0, 5], row[1, 5] = -px * (h * h / 2), -py * (h * h / 2)


@kernel
def _lost_at_landing(ux: float, uy: float, hop: float, mu_g: float, k: float) -> float:
    """Return the velocity that the floor's friction takes from a ball of slip u as it lands, as a share of u."""
    size = math.sqrt(ux * ux + uy * uy) + TINY
    return min(mu_g * hop / 2, k * size) / size


@kernel
def hopped_after(
    t: float, vx: float, vy: float, ux: float, uy: float, hop: float, mu_g: float, c_g: float, k: float
) -> tuple[float, float, float, float]:
    """Return displacement and velocity at the time t of a ball that hops for the time ``hop`` before it slides and rolls."""
    flown, lost = min(t, hop), _lost_at_landing(ux, uy, hop, mu_g, k)
    after = moved_after(t - flown, vx - lost * ux, vy - lost * uy, ux - lost * ux / k, uy - lost * uy / k, mu_g, c_g, k)
    x, y = flown * vx + after[0], flown * vy + after[1]
    return (x, y, after[2], after[3]) if t >= hop else (x, y, vx, vy)


@kernel
def hopped_slopes(
    t: float, vx: float, vy: float, ux: float, uy: float, hop: float, mu_g: float, c_g: float, k: float, row: Any
) -> None:
    """Fill the derivatives of the displacement of a ball that hops first: ``row`` (2, 7), by v, u, mu_g, c_g and hop."""
    flown, lost = min(t, hop), _lost_at_landing(ux, uy, hop, mu_g, k)
    sx, sy = ux - lost * ux / k, uy - lost * uy / k
    moved_slopes(t - flown, vx - lost * ux, vy - lost * uy, sx, sy, mu_g, c_g, k, row)
    size = math.sqrt(ux * ux + uy * uy) + TINY
    ex, ey = ux / size, uy / size
    sticks = mu_g * hop / 2 >= k * size
    # the velocity lost at landing is k u where the slip stops, else mu_g hop / 2 along u: its derivatives by u
    bent = mu_g * hop / 2 / size
    xx, xy, yy = (k, 0.0, k) if sticks else (bent * (1 - ex * ex), -bent * ex * ey, bent * (1 - ey * ey))
    after = hopped_after(t, vx, vy, ux, uy, hop, mu_g, c_g, k)
    gap = vx - after[2], vy - after[3]  # by a longer hop, the ball keeps its velocity for longer
    for c in range(2):
        lost_x, lost_y = -row[c, 0] - row[c, 2] / k, -row[c, 1] - row[c, 3] / k
        rate = 0.0 if sticks else (lost_x * ex + lost_y * ey) / 2
        row[c, 2] += lost_x * xx + lost_y * xy
        row[c, 3] += lost_x * xy + lost_y * yy
        row[c, 4] += rate * hop
        row[c, 6] = gap[c] + rate * mu_g
        row[c, c] += flown


def _fill(
    vx: float, vy: float, ux: float, uy: float, mu_g: float, c_g: float, k: float, t: Any, way: Any, velocity: Any, left: Any,
) -> None:  # fmt: skip
    """Fill displacements, velocities and slips (n, 2)."""
    for i in range(t.shape[0]):
        found = moved_after(t[i], vx, vy, ux, uy, mu_g, c_g, k)
        way[i, 0], way[i, 1], velocity[i, 0], velocity[i, 1], left[i, 0], left[i, 1] = found


def _fill_hop(
    vx: float, vy: float, ux: float, uy: float, hop: float, mu_g: float, c_g: float, k: float, t: Any, way: Any
) -> None:
    """Fill displacements (n, 2) of a ball that hops first."""
    for i in range(t.shape[0]):
        way[i, 0], way[i, 1], _vx, _vy = hopped_after(t[i], vx, vy, ux, uy, hop, mu_g, c_g, k)


# ----------------------------------------------------------------------------------------------------
# Path of a ball on a table before and after a contact, by the parameters of a fit, with its derivatives.
#
# Before the contact the ball slides or rolls from the first frame on, after it the ball may hop, then slides and rolls
# (:mod:`carom.tracks.contact_models`). Both paths meet at the place of the contact.


# The parameters of a contact on a table. Before the contact the ball has, at the first frame, a slip u0 of magnitude SLIP in the
# direction ANGLE, and the velocity ROLL + k u0: ROLL is its velocity once it rolls, which late frames determine even if they
# determine nothing of u0.
TIME, PLACE, DISTANCE, ROLL, SLIP, ANGLE = 0, slice(1, 3), 1, slice(3, 5), 5, 6
V_OUT, U_OUT, MU_G, C_G, HOP = slice(7, 9), slice(9, 11), 11, 12, 13
COUNT = 14


def first_slip(theta: Array) -> Array:
    """Return the slip u0 (2,) at the first frame, m/s."""
    return np.array(_first_slip(float(theta[SLIP]), float(theta[ANGLE])))


def at_contact(theta: Array, since: float, k: float) -> tuple[Array, Array]:
    """Return the velocity and the slip (2,) with which the ball meets the wall, m/s; ``since``: the time of the first frame, s."""
    span = max(float(theta[TIME]) - since, 0.0)
    roll_x, roll_y, size, angle = theta[ROLL.start : ANGLE + 1].tolist()
    found = _before(span, roll_x, roll_y, size, angle, float(theta[MU_G]), float(theta[C_G]), k)
    return np.array(found[2:4]), np.array(found[4:])


def contact_path(theta: Array, since: float, t: Array, k: float) -> Array:
    """Return the positions (n, 2) at times t (n,), m."""
    places = np.empty((len(t), 2))
    compiled(_fill_contact)(theta, since, k, t, places, NO_SLOPES, NO_WORK)
    return places


def contact_slopes(theta: Array, since: float, t: Array, k: float) -> Array:
    """Return the derivatives (n, 2, COUNT) of the positions with respect to theta."""
    slope = np.zeros((len(t), 2, COUNT))
    compiled(_fill_contact)(theta, since, k, t, np.empty((len(t), 2)), slope, np.empty((2, 2, 7)))
    return slope


NO_SLOPES, NO_WORK = np.empty((0, 2, COUNT)), np.empty((0, 2, 7))  # (for positions alone)


# --- kernels ------------------------------------------------------------------------------------------------------------


@kernel
def _first_slip(size: float, angle: float) -> tuple[float, float]:
    return size * math.cos(angle), size * math.sin(angle)


@kernel
def _before(
    s: float, roll_x: float, roll_y: float, size: float, angle: float, mu_g: float, c_g: float, k: float
) -> tuple[float, float, float, float, float, float]:
    """Return displacement, velocity and slip a time s after the first frame."""
    ux, uy = _first_slip(size, angle)
    return moved_after(s, roll_x + k * ux, roll_y + k * uy, ux, uy, mu_g, c_g, k)


@kernel
def _slopes_before(
    s: float, roll_x: float, roll_y: float, size: float, angle: float, mu_g: float, c_g: float, k: float, rows: Any
) -> None:
    """Fill the derivatives of that displacement by the velocity and the slip at the first frame, mu_g and c_g (2, 6)."""
    ux, uy = _first_slip(size, angle)
    moved_slopes(s, roll_x + k * ux, roll_y + k * uy, ux, uy, mu_g, c_g, k, rows)


def _fill_contact(theta: Any, since: float, k: float, t: Any, places: Any, slope: Any, work: Any) -> None:
    """Fill positions (n, 2), and derivatives (n, 2, COUNT), or (0, 2, COUNT) for none; ``work`` (2, 2, 7) is written to."""
    time, x, y, roll_x, roll_y, size, angle = theta[0], theta[1], theta[2], theta[3], theta[4], theta[5], theta[6]
    vx, vy, ux, uy, mu_g, c_g, hop = theta[7], theta[8], theta[9], theta[10], theta[11], theta[12], theta[13]
    with_slopes = slope.shape[0] > 0
    span = max(time - since, 0.0)
    end = _before(span, roll_x, roll_y, size, angle, mu_g, c_g, k)
    cos, sin = _first_slip(1.0, angle)
    if with_slopes:
        _slopes_before(span, roll_x, roll_y, size, angle, mu_g, c_g, k, work[0])
    for i in range(t.shape[0]):
        if t[i] < time:
            s = min(max(t[i] - since, 0.0), span)
            now = _before(s, roll_x, roll_y, size, angle, mu_g, c_g, k)
            places[i, 0], places[i, 1] = x + now[0] - end[0], y + now[1] - end[1]
            if with_slopes:
                _slopes_before(s, roll_x, roll_y, size, angle, mu_g, c_g, k, work[1])
                for c in range(2):
                    by, row = work[1, c], slope[i, c]
                    for j in range(6):
                        by[j] -= work[0, c, j]
                    # the slip at the first frame is part of the velocity there
                    by_x, by_y = by[2] + k * by[0], by[3] + k * by[1]
                    row[TIME], row[DISTANCE + c], row[3], row[4] = -end[2 + c], 1.0, by[0], by[1]
                    row[SLIP], row[ANGLE] = by_x * cos + by_y * sin, size * (by_y * cos - by_x * sin)
                    row[MU_G], row[C_G] = by[4], by[5]
        else:
            s = t[i] - time
            after = hopped_after(s, vx, vy, ux, uy, hop, mu_g, c_g, k)
            places[i, 0], places[i, 1] = x + after[0], y + after[1]
            if with_slopes:
                hopped_slopes(s, vx, vy, ux, uy, hop, mu_g, c_g, k, work[1])
                for c in range(2):
                    row = slope[i, c]
                    row[TIME], row[DISTANCE + c] = -after[2 + c], 1.0
                    for j in range(7):
                        row[7 + j] = work[1, c, j]


# ----------------------------------------------------------------------------------------------------
# Models of a contact on a table: the ball slides or rolls before it, and slides, then rolls after it.


Free = NDArray[np.bool_]

# A slide before the contact is accepted if it lowers chi2 by more than chance does in 1 % of fits: two parameters more, or one
# for a ball that slides until the contact.
CHI2_SLIDING = 9.21
CHI2_SLIDING_UNTIL_CONTACT = 6.63
# By how much a slide all the way to the contact has to raise the chi2 of rolling, so that it is detected almost certainly.
CHI2_DETECTABLE = 20.0
FEW_FRAMES_AFTER = 15
SHORT_SLIDE_FRAMES = 3.0  # a slide as short as this may be spurious, found before the cloth's friction was known
MIN_FRAMES_SLIDING = 6  # before the contact, to distinguish a slide from noise
MAX_TIME_SLACK_S = 0.02  # longest time between the contact and the frames next to it
# By how much a hop may differ from the expected one, as a share of the longest that a wall causes by stopping the slip: TIED to
# test what is expected, LOOSE for any wall, also one that does not lift the ball at all.
TIED, LOOSE, MAX_SHARE = 0.1, 0.5, 2.0

# Which parameters are free: for a ball that rolls before the contact, that slides until the contact, that slides and then rolls.
_NUMBERS = np.arange(COUNT)
SLIDING = _NUMBERS != HOP
ROLLING, SLIDING_UNTIL_CONTACT = SLIDING & (_NUMBERS != SLIP) & (_NUMBERS != ANGLE), SLIDING & (_NUMBERS != SLIP)
FLOOR_HELD = _NUMBERS < MU_G
# Without friction of the floor the spin does nothing: the ball moves as one that rolls all the time.
STRAIGHT = ROLLING & (U_OUT.start != _NUMBERS) & (U_OUT.start + 1 != _NUMBERS) & (_NUMBERS != MU_G)
# The slip with which a ball that rolled into a wall leaves it: v_n, and this share of the spin that it brought along
# (as a cushion or an upright wall leaves it), and the width of that share; the rise of chi2 beyond which no slide need be tried,
# and the share of one contact in the sum of all.
USUAL_SPIN, SPIN_WIDTH, CERTAIN_FRICTION, MOST_OF_ONE = 0.3, 0.25, 40.0, 12.0


class _Candidate(NamedTuple):
    """A minimum of one kind of motion before the contact."""

    theta: Array
    chi2: float
    penalty: float
    """Difference by which chi2 has to be lower than for rolling."""
    free: Free
    slid_until_contact: bool = False


# --- on a table --------------------------------------------------------------------------------------------------------


def _table_outputs(theta: Array, since: float, k: float) -> Array:
    """Return the quantities of OUTPUTS."""
    v, u = at_contact(theta, since, k)
    v1, u1 = theta[V_OUT], theta[U_OUT]
    hop = theta[HOP]
    slides = max(k * np.sqrt(u1 @ u1) / theta[MU_G] + hop / 2, hop)
    return np.array(
        [theta[TIME], *theta[PLACE], *v, *v1, *(v1 - k * u1), *u, *u1, theta[MU_G], theta[C_G], slides, hop]
    )


class _TableContact:
    """The least-squares problem of one contact."""

    def __init__(
        self, time: Array, position: Array, near: float, noise: float, prior: Prior, wall: float | None, weight: Array,
        whiten: Array | None = None,
    ) -> None:  # fmt: skip
        self.weight, self.whiten = np.repeat(weight, 2), whiten
        self.time, self.position, self.noise = time, position, noise
        self.single = time, position
        self.k, self.since = prior.k, float(time[0])
        before, after = time < near, time >= near
        self.after, self.interval = int(after.sum()), float(np.median(np.diff(time)))
        start = starting_values(time, position, before, after, near)
        v_in, v_out = start[START_IN], start[START_OUT]
        self.start = np.concatenate(
            [start[TIME : ROLL.stop], [0.0, 0.0], v_out, [0.0, 0.0], [prior.mu_g, prior.c_g, 0.0]]
        )
        self.scale = np.array([1e-3, 1e-3, 1e-3, *[0.05] * 2, 0.3, 0.3, *[0.05] * 2, *[0.3] * 2, 0.2, 0.03, 0.01])
        # a wall cannot give a ball more slip than is compatible with its speed
        far = 0.2 + 2.0 * float(np.hypot(*v_in))
        self.low, self.high = np.full(COUNT, -np.inf), np.full(COUNT, np.inf)
        # the contact is next to the frame nearest to the wall, apart from the noise of that frame
        gap = max(time[after][0] - time[before][-1], self.interval)
        gap += min(4 * noise / max(min(abs(v_in[0]), abs(v_out[0])), 1e-9), MAX_TIME_SLACK_S)
        self.low[TIME], self.high[TIME] = time[before][-1] - gap, time[after][0] + gap
        self.low[SLIP], self.low[MU_G], self.low[C_G] = 0.0, prior.mu_g / 20, 0.0
        self.high[MU_G] = prior.mu_g * 20
        # prior knowledge, one row each: the floor, the slip after the contact, the position of the wall
        known = [
            (MU_G, prior.mu_g, prior.mu_g_error), (C_G, prior.c_g, prior.c_g_error),
            (U_OUT.start, 0.0, far), (U_OUT.start + 1, 0.0, far),
        ]  # fmt: skip
        if wall is not None:
            known.append((DISTANCE, wall, noise))
        self.known = known
        self.known_slope = np.zeros((len(known), COUNT))
        for row, (i, _value, error) in enumerate(known):
            self.known_slope[row, i] = 1 / error
        self.lift = np.zeros((0, COUNT)), 0.0

    def residual(self, theta: Array) -> Array:
        """Return the residuals in standard deviations: frames first, then prior knowledge."""
        gap = (self.position - contact_path(theta, self.since, self.time, self.k)) / self.noise
        return np.concatenate(
            [
                gap.ravel() * self.weight if self.whiten is None else (self.whiten @ gap).ravel(),
                [(theta[i] - value) / error for i, value, error in self.known],
                self.lift[0] @ theta - self.lift[1],
            ]
        )

    def slope(self, theta: Array) -> Array:
        """Return the derivatives of the residuals (rows, COUNT)."""
        places = contact_slopes(theta, self.since, self.time, self.k)
        if self.whiten is None:
            frames = places.reshape(-1, COUNT) * (self.weight / -self.noise)[:, None]
        else:
            frames = np.tensordot(self.whiten, places, 1).reshape(-1, COUNT) / -self.noise
        return np.concatenate([frames, self.known_slope, self.lift[0]])

    def solve(self, start: Array, free: Free) -> tuple[Array, float]:
        """Minimise over the free parameters from a start: the parameters, and the sum of squares."""
        # (a first approximation need not be exact)
        return solve_free(
            self.residual, lambda theta, columns: self.slope(theta)[:, columns], start, free, self.scale, (self.low, self.high),
            1e-4 if not free[MU_G] else 1e-9,
        )  # fmt: skip

    def rolling(self, old: ContactFit | None) -> tuple[Array, _Candidate]:
        """Fit a ball that rolls before the contact: the parameters with the floor as known, and the fit with the floor free.

        If the floor were free at once, a wrong floor would be found instead of a slide before the contact. ``old``: earlier fit.
        """
        tries = []
        if old is not None and not old.slid_before:
            start = old.theta.copy()
            start[MU_G:] = self.start[MU_G:]
            tries.append(self.solve(start, ROLLING & FLOOR_HELD))
        # few frames after the contact are fitted by a slide of some ms as well as by a long one, before the cloth is known
        short = old is not None and old["slides"] < SHORT_SLIDE_FRAMES * self.interval
        if not tries or self.after < FEW_FRAMES_AFTER or short:
            for spin_kept in (0.8, 0.2):
                start = self.start.copy()
                start[U_OUT] = start[V_OUT] - spin_kept * start[ROLL]
                tries.append(self.solve(start, ROLLING & FLOOR_HELD))
        first = min(tries, key=lambda one: one[1])[0]
        return first, _Candidate(*self.solve(first, ROLLING), 0.0, ROLLING)

    def sliding_again(self, old: ContactFit) -> _Candidate:
        """Fit a ball that slides before the contact, from an earlier such fit: other starts may miss the slide after it."""
        start, until_contact = old.theta.copy(), old.slid_until_contact
        free = SLIDING_UNTIL_CONTACT if until_contact else SLIDING
        start[MU_G:] = self.start[MU_G:]
        found = self.solve(self.solve(start, free & FLOOR_HELD)[0], free)
        return _Candidate(*found, CHI2_SLIDING_UNTIL_CONTACT if until_contact else CHI2_SLIDING, free, until_contact)

    def sliding(self, start: Array) -> list[_Candidate]:
        """Fit a ball that slides before the contact: all the way, and until some time before it."""
        on = self.solve(start, SLIDING_UNTIL_CONTACT & FLOOR_HELD)[0]
        found = [
            _Candidate(*self.solve(on, SLIDING_UNTIL_CONTACT), CHI2_SLIDING_UNTIL_CONTACT, SLIDING_UNTIL_CONTACT, True)
        ]
        frames = self.time[self.time < on[TIME]]
        v0 = on[ROLL] + self.k * first_slip(on)
        for end in (0.9, 0.6, 0.3):
            start = on.copy()
            start[SLIP] = on[MU_G] * end * (on[TIME] - self.since) / self.k
            start[ROLL] = v0 - self.k * first_slip(start)
            other, chi2 = self.solve(self.solve(start, SLIDING & FLOOR_HELD)[0], SLIDING)
            # a slide that ends with the last frames leaves the slip undetermined: sliding until the contact fits as well with less
            if self.k * other[SLIP] / other[MU_G] < frames[-1] - self.since - 1.5 * self.interval:
                found.append(_Candidate(other, chi2, CHI2_SLIDING, SLIDING))
                if chi2 < 1.3 * (2 * len(self.time) - COUNT):
                    break  # no better minimum is possible: other starts would end here too
        return found

    def hopping(self, grounded: _Candidate, gravity: float, error: float) -> _Candidate | None:
        """Fit a ball that hops after the contact, from the fit without a hop; None if it comes with backspin.

        At its centre the impulses J of the wall turn a ball by dw_y = J_z / (kappa m a), so that it leaves with
        v_z = kappa (v_n - u_n + roll), roll the velocity at which its front goes down, and with k roll if its slip stops.
        """
        k, start = self.k, grounded.theta.copy()
        v, u = at_contact(start, self.since, k)
        roll = float(u[0] - v[0])
        if not roll > 0:
            return None
        longest, rate = 2 * k * roll / gravity, 1 / (1 - k)
        lift = np.zeros((1, COUNT))
        lift[0, [HOP, V_OUT.start, U_OUT.start]] = 1 / longest, -rate / roll, rate / roll
        self.lift = lift / error, rate / error
        self.high[HOP] = MAX_SHARE * longest
        start[HOP] = longest * np.clip(rate - lift[0] @ start, 0.05, 1.0)
        lost = start[MU_G] * start[HOP] / 2 * start[U_OUT] / max(float(np.hypot(*start[U_OUT])), 1e-9)
        start[V_OUT] -= lost
        start[U_OUT] -= lost / k
        free = grounded.free | (_NUMBERS == HOP)
        theta, chi2 = self.solve(start, free)
        return grounded._replace(theta=theta, chi2=chi2, free=free)


def fit_table(
    time: Array, position: Array, near: float, noise: float, prior: Prior, wall: float | None = None,
    weight: Array | None = None, old: ContactFit | None = None, gravity: float = GRAVITY,
    whiten: Array | None = None, single: tuple[Array, Array] | None = None,
) -> ContactFit:  # fmt: skip
    """Fit a contact of a ball on a table.

    Parameters
    ----------
    time, position : (n,) s and (n, 2) m
        Frames, in the frame of the wall.
    near : float
        Approximate time of the contact, s.
    noise : float
        Standard deviation of one coordinate, m.
    prior : Prior
        Prior knowledge of the floor.
    wall : float, optional
        Distance from the wall's line at which the motions meet, m, within the noise. None: where they meet is free, which is
        right for a cushion that gives way.
    weight : (n,), optional
        sqrt(m) for a row that is the mean of m frames; its residual is multiplied by it.
    old : ContactFit, optional
        An earlier fit, with another floor or noise, to start from.
    gravity : float
        m/s^2, which a hop depends on.
    whiten : (n, n), optional
        Makes the errors of the rows independent, where they are correlated; it takes the place of ``weight``.
    single : (m,) s and (m, 2) m, optional
        The frames themselves, where rows are means.
    """
    weight = np.ones(len(time)) if weight is None else weight
    if prior.mu_g == 0:
        return _straight(
            _TableContact(time, position, near, noise, replace(prior, mu_g=1.0, mu_g_error=1.0), wall, weight, whiten),
            single,
        )
    job = _TableContact(time, position, near, noise, prior, wall, weight, whiten)
    job.single = single or job.single
    k, since = job.k, job.since
    first, rolling = job.rolling(old)
    candidates = [rolling]
    gap = (position - contact_path(first, since, time, k)) * weight[:, None]
    start = _start_of_slide(time, gap, weight, first, noise, k)
    if start is not None:
        candidates += job.sliding(start)
    if old is not None and old.slid_before:
        candidates.append(job.sliding_again(old))
    chosen = min(candidates, key=lambda one: one.chi2 + one.penalty)
    fitted = _fitted(job, chosen)
    tied, loose = (job.hopping(chosen, gravity, error) for error in (TIED, LOOSE))
    if tied is None or loose is None:
        return fitted
    return replace(fitted, hopping=_fitted(job, loose), hop_chi2=tied.chi2 - chosen.chi2)


def _straight(job: _TableContact, single: tuple[Array, Array] | None) -> ContactFit:
    """Fit a contact on a floor without friction: straight paths, slowed down (or, on a slope, made faster) along them."""
    job.single = single or job.single
    job.low[C_G] = -np.inf
    fit = _fitted(job, _Candidate(*job.solve(job.start, STRAIGHT), 0.0, STRAIGHT))
    value = fit.value.copy()
    value[[OUTPUTS.index(name) for name in ("un_in", "ut_in", "un_out", "ut_out")]] = np.nan
    value[[OUTPUTS.index(name) for name in ("mu_g", "slides", "hop")]] = 0.0
    return replace(fit, value=value)


def friction_excess(
    time: Array, position: Array, near: float, noise: float, prior: Prior, wall: float | None, weight: Array,
    whiten: Array | None, fit: ContactFit,
) -> float:  # fmt: skip
    """Return by how much chi2 is higher for a ball that slides off the wall, as one that rolled into it, than for straight paths.

    Parameters as in :func:`fit_table`, whose fit is ``fit``. Within MOST_OF_ONE: a contact may be mistracked.
    """
    job = _TableContact(time, position, near, noise, replace(prior, c_g=0.0), wall, weight, whiten)
    job.low[C_G] = -np.inf
    theta, straight = job.solve(job.start, STRAIGHT)
    frames = job.residual(theta)[: 2 * len(time)]
    if frames @ frames - fit.chi2 > CERTAIN_FRICTION:
        return -MOST_OF_ONE
    job = _TableContact(time, position, near, noise, prior, wall, weight, whiten)
    lift = np.zeros((1, COUNT))
    lift[0, [U_OUT.start, V_OUT.start, ROLL.start]] = 1.0, -1.0, USUAL_SPIN
    job.lift = lift / (SPIN_WIDTH * abs(job.start[ROLL.start])), 0.0
    slides = job.rolling(None)[1].chi2
    return float(np.clip(slides - straight, -MOST_OF_ONE, MOST_OF_ONE))


def _fitted(job: _TableContact, chosen: _Candidate) -> ContactFit:
    """Return a minimum with its covariances."""
    best, k, since, noise, time = chosen.theta, job.k, job.since, job.noise, job.time
    slopes = job.slope(best)
    rows = nearest_frames(job.single[0], best[TIME])
    t, x = job.single[0][rows], job.single[1][rows]
    slope, known = contact_slopes(best, since, t, k)[:, :, chosen.free], slopes[2 * len(time) :, chosen.free]
    fitted = ContactFit(
        **propagated(
            best, chosen.free, job.residual, slopes, lambda theta: _table_outputs(theta, since, k), job.scale, 2 * len(time)
        ),
        noise=noise, time=time, slid_before=bool(chosen.free[ANGLE]), slid_until_contact=chosen.slid_until_contact, theta=best,
        position=partial(contact_path, best, since, k=k),
        residuals=(job.position - contact_path(best, since, time, k)) * job.weight.reshape(-1, 2),
        fitted=FittedFrames(t, x - contact_path(best, since, t, k), slope, known, noise),
    )  # fmt: skip
    if chosen.slid_until_contact:
        # it may have begun to roll so shortly before the wall that no frame shows it
        late = best[MU_G] * unresolved_time(best[MU_G], noise, time)
        e = np.zeros(len(OUTPUTS))
        v_in = OUTPUTS.index("vn_in")
        e[v_in : v_in + 2] = late / np.sqrt(3.0) * np.array([np.cos(best[ANGLE]), np.sin(best[ANGLE])])
        fitted = replace(fitted, covariance=fitted.covariance + np.outer(e, e))
    return fitted


def _start_of_slide(time: Array, gap: Array, weight: Array, rolling: Array, noise: float, k: float) -> Array | None:
    """Return starting values for a ball that slides until the contact; None if the frames before it show no sliding.

    Relative to the line on which it rolls later, a ball that slides until T is displaced by -e mu g (T - t)^2 / 2:
    some T are tried. ``gap`` (n, 2): measured less fitted positions, times the weights, of the fit ``rolling`` (COUNT,).
    """
    rows = time < rolling[TIME]
    s, gap, weight = time[rows] - time[0], gap[rows] / noise, weight[rows, None]
    if len(s) < MIN_FRAMES_SLIDING:
        return None
    span = rolling[TIME] - time[0]
    most, direction = CHI2_SLIDING_UNTIL_CONTACT, np.nan
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
    # no frame shows the remaining slip: any size that lasts until the contact is a valid start
    start = rolling.copy()
    start[SLIP], start[ANGLE] = 3 * rolling[MU_G] * span / k, direction
    e = np.array([np.cos(direction), np.sin(direction)])
    start[ROLL] += e * (rolling[MU_G] * span / 2) - k * start[SLIP] * e
    return start


def slide_would_show(frames: int, span: float, noise: float, mu_g: float) -> bool:
    """Return whether so many frames over ``span`` s would show that a ball slides: its path bends by mu g / 2 t^2.

    Relative to the straight line through the frames such a parabola has the RMS (mu g / 2) span^2 / (6 sqrt(5)).
    """
    bend = mu_g / 2 * span * span / (6 * np.sqrt(5.0))
    return frames >= MIN_FRAMES_SLIDING and bool(frames * (bend / noise) ** 2 > CHI2_DETECTABLE)
