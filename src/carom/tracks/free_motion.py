"""Frames beside a contact that belong to it: the frames of one flight, and a turn within a frame.

A bounce that is too low, too short or cut off by the end of the film is not found as an event. A ball in flight that leaves
the wall with v_n is back after 2 v_n/g_n, g_n the acceleration toward the wall: whatever the film shows later is another flight.

At a wall the velocity jumps. On a curved rail, or at the end of a string, it turns in a smooth curve, and a fit of two free motions
finds a contact where there is none. The jump that the frames near it show, beside a smooth curve, is then far less than the one of
the fit.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.tracks.events import BEYOND_WALL_M
from carom.tracks.least_squares import ContactFit

__all__ = ["VelocityJump", "flight_ends", "velocity_jump"]

Array = NDArray[np.float64]
MIN_FRAMES = 3  # that determine a flight under a known gravity
ERRORS = 3.0  # standard deviations by which the ball has to be late
# The jump of the velocity is sought within this time on each side: a soft ball is in contact for up to 20 ms, a table's cloth and
# the air bend the paths little in it. With noise, or few frames, within a longer one, until its share has this error.
JUMP_S, JUMP_FRAMES, GROWTH, SHARE_ERROR = 0.06, 6, 1.4, 0.07
SMOOTH, CERTAIN = 0.5, 3.0  # share of the jump up to which there is none, if it is so many error bars below


def flight_ends(s: Array, d: Array, pull: float, noise: float, interval: float) -> float:
    """Return how long after a contact the ball is back at the wall, s, if frames show it later than that; else infinity.

    Parameters
    ----------
    s, d : (n,) s and m
        Times since the contact, growing from 0, and distances from the wall.
    pull : float
        Acceleration toward the wall, m/s^2.
    noise, interval : float
        Of a coordinate, m; between frames, s.

    Examples
    --------
    A ball that rises at 1 m/s is back after 0.2 s, and bounces once more:

    >>> import numpy as np
    >>> from carom.tracks.free_motion import flight_ends
    >>> s = np.arange(60) / 200
    >>> d = np.where(s < 0.2, s - 5 * s**2, 0.4 * (s - 0.2) - 5 * (s - 0.2) ** 2)
    >>> round(flight_ends(s, d, 10.0, 1e-4, 1 / 200), 2)
    0.2
    >>> flight_ends(s[:40], d[:40], 10.0, 1e-4, 1 / 200)
    inf
    """
    sure = s > 0.99 * interval  # (the frame nearest to the contact may lie before it)
    s, d = s[sure], d[sure]
    if not pull > 0 or len(s) <= MIN_FRAMES:
        return np.inf
    # d + pull/2 s^2 is a straight line in one flight: its slope from the first k frames, for every k
    y, k = d + pull / 2 * s * s, np.arange(1, len(s) + 1)
    s1, s2, y1, sy = np.cumsum(s), np.cumsum(s * s), np.cumsum(y), np.cumsum(s * y)
    spread = np.maximum(s2 - s1 * s1 / k, 1e-300)
    back = 2 * (sy - s1 * y1 / k) / spread / pull
    error = 2 * noise / np.sqrt(spread) / pull
    latest = np.where((k >= MIN_FRAMES) & (s < back), back + ERRORS * error + interval, np.inf)
    best = int(np.argmin(latest))
    # below its line, as below a higher stair, there is no wall
    passes = d[s > back[best]].min(initial=np.inf) < min(d[0], 0.0) - BEYOND_WALL_M
    return np.inf if passes or not s[-1] > latest[best] else float(back[best])


class VelocityJump(NamedTuple):
    """The jump of the velocity that frames near a contact show, as a share of the jump of its fit."""

    share: float
    error: float

    @property
    def smooth(self) -> bool:
        """Whether the path turns smoothly there."""
        return self.share + CERTAIN * self.error < SMOOTH

    @property
    def sharp(self) -> bool:
        """Whether the velocity jumps there."""
        return self.share - CERTAIN * self.error > SMOOTH


def velocity_jump(time: Array, position: Array, fit: ContactFit, noise: float, interval: float) -> VelocityJump:
    """Return how much of the jump of the velocity at a contact the frames near it show beside a smooth curve.

    The curve is a cubic; across the contact its slope and its curvature may jump. The jump of its slope in the measured positions
    is compared with the one in the fitted positions at the same times: a ball that slides for two frames after the wall has, over
    twelve frames, another jump than at the wall. ``time``, ``position``: (n,) s and (n, 2) m, frames of the fit, in the frame of
    the wall; ``noise``: from frame to frame, m.
    """
    change = np.array([fit["vn_out"] - fit["vn_in"], fit["vt_out"] - fit["vt_in"]])
    along = change / max(float(np.hypot(*change)), 1e-12)
    t, y = time - fit["t"], np.stack([position, fit.position(time)], axis=-1).transpose(0, 2, 1) @ along
    most = max(-float(t[0]), float(t[-1]))
    span, found = max(JUMP_S, JUMP_FRAMES * interval), VelocityJump(np.nan, np.inf)
    while True:
        rows = np.abs(t) <= span
        u = t[rows] / span
        after = np.maximum(u, 0.0)
        columns = np.stack([u**0, u, u**2, u**3, after**2, after], axis=-1)
        if min((u < 0).sum(), (u >= 0).sum()) >= JUMP_FRAMES - 1 and len(u) > columns.shape[1]:
            solved = np.linalg.lstsq(columns, y[rows], rcond=None)[0]
            gap = y[rows, 0] - columns @ solved[:, 0]
            scatter = max(noise, float(np.sqrt(gap @ gap / (len(u) - columns.shape[1]))))
            inverse = np.linalg.pinv(columns.T @ columns, hermitian=True)
            seen, fitted = solved[-1].tolist()
            size = abs(fitted) + 1e-300
            found = VelocityJump(float(seen * np.sign(fitted) / size), scatter * float(np.sqrt(inverse[-1, -1])) / size)
        if found.error < SHARE_ERROR or span >= most:
            return found
        span *= GROWTH
