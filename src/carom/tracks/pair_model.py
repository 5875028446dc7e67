"""Model of a ball that strikes one at rest on a table: one impulse between them, and the motions that follow from it.

The striking ball slides or rolls before, both slide and then roll after it (:mod:`carom.tracks.table_motion`). The contact of two
equal balls is one impulse, which acts on both at the point where they touch: its three components, along the line of centres, along
the table and up, give both velocities and both slips on the cloth after it. So momentum is kept, and nothing else is assumed of
the contact: neither restitution nor friction nor a law. The frames determine the upward part, which no picture shows, by the
slide: what turns the balls makes them slide longer or shorter.

Friction between the balls lifts one of them and presses the other onto the floor. The lifted one flies and lands, the pressed one
lands at once: each loses some of its slip there.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.tracks.least_squares import Prior, central_differences, solve
from carom.tracks.table_motion import hop_slide_roll, landed, slide_then_roll

__all__ = ["PAIR_OUTPUTS", "BallFrames", "PairFit", "fit_pair"]

Array = NDArray[np.float64]

# The quantities of a contact, of vectors first the component n, from the struck ball to the striking one, then t, along the table,
# counter-clockwise from n: time, place of the struck ball, direction of n; velocity and slip of the striking ball before; the
# impulse on it, over its mass, also upwards; velocities and slips after, of the striking ball (1) and the struck one (2); floor.
PAIR_OUTPUTS = (
    "t", "x", "y", "angle", "vn_in", "vt_in", "un_in", "ut_in", "jn", "jt", "jz",
    "v1n_out", "v1t_out", "u1n_out", "u1t_out", "v2n_out", "v2t_out", "u2n_out", "u2t_out", "mu_g", "c_g",
)  # fmt: skip

# The parameters: ROLL is the velocity of the striking ball once it would roll, U_IN its slip at the first frame.
TIME, ANGLE, PLACE, ROLL, U_IN, IMPULSE, UP = 0, 1, slice(2, 4), slice(4, 6), slice(6, 8), slice(8, 10), 10
MU_G, C_G, DISTANCE, COUNT = 11, 12, 13, 14
SCALE = np.array([1e-3, 0.01, 1e-3, 1e-3, 0.05, 0.05, 0.3, 0.3, 0.05, 0.05, 0.05, 0.2, 0.03, 1e-3])
LINE_S, LINE_FRAMES = 0.08, 4  # before and after the contact: frames from which starting values come, at least so many
SLIDES = (0.9, 0.4, 1.4, -0.4)  # slips at the first frame, of the velocity, from which a fit of a sliding ball begins
# A slide before the contact is accepted where it lowers chi2 by more than chance does in 1 % of fits, with two parameters more
CHI2_SLIDING = 9.21
MOST_TRIES = 5
DISTANCE_ERROR = 0.01  # of the distance of two centres that touch: of the scale, and of the radius


class BallFrames(NamedTuple):
    """Frames of one ball, m and s."""

    time: Array
    """(n,)"""
    position: Array
    """(n, 2)"""
    whiten: Array
    """(n, n): makes their errors independent, each of the standard deviation of one frame."""


@dataclass(frozen=True, eq=False)
class PairFit:
    """A fitted contact of two balls: ``fit["jn"]`` is a value by its name in PAIR_OUTPUTS."""

    value: Array
    """(21,): the quantities of PAIR_OUTPUTS."""
    covariance: Array
    """(21, 21), for the noise that was assumed."""
    chi2: float
    dof: float
    slid_before: bool
    """Whether the track shows that the striking ball slid at its first frame."""
    residuals: tuple[Array, Array]
    """(n, 2) and (m, 2) m: measured less fitted, of the striking ball and of the struck one."""

    def __getitem__(self, name: str) -> float:
        """Return a value by its name in PAIR_OUTPUTS."""
        return float(self.value[PAIR_OUTPUTS.index(name)])

    def error(self, name: str) -> float:
        """Return the standard deviation of a value."""
        i = PAIR_OUTPUTS.index(name)
        return float(np.sqrt(max(self.covariance[i, i], 0.0)))


def _after(v: Array, u: Array, up: float, t: Array, theta: Array, k: float, gravity: float) -> Array:
    """Return the displacements (n, 2) of a ball that has the velocity v, the slip u, and an upward velocity, or a downward one."""
    hop, mu_g, c_g = 2 * abs(up) / gravity, float(theta[MU_G]), float(theta[C_G])
    if up > 0:
        return hop_slide_roll(v, u, hop, t, mu_g, c_g, k)
    return slide_then_roll(*landed(v, u, hop, mu_g, k), t, mu_g, c_g, k).displacement


class _PairProblem:
    """The least-squares problem of one contact."""

    def __init__(
        self, one: BallFrames, two: BallFrames, near: float, diameter: float, noise: float, prior: Prior, gravity: float
    ) -> None:
        self.one, self.two, self.noise, self.gravity = one, two, noise, gravity
        self.since, self.k = float(one.time[0]), prior.k
        self.kappa = prior.k / (1 - prior.k)
        before, after = one.time < near, two.time > near
        far_v, far_x = _line(near - one.time[before][::-1], one.position[before][::-1])
        far_v = -far_v
        v2, start2 = _line(two.time[after] - near, two.position[after])
        rest = two.position[~after].mean(axis=0) if (~after).any() else start2
        speed = float(np.hypot(*v2))
        line = -v2 / max(speed, 1e-9)
        self.start = np.zeros(COUNT)
        self.start[TIME] = near + _time_apart(far_x - rest, far_v, diameter)
        self.start[ANGLE], self.start[PLACE], self.start[ROLL] = np.arctan2(line[1], line[0]), rest, far_v
        self.start[IMPULSE.start], self.start[UP] = speed, 0.03 * speed
        self.start[MU_G], self.start[C_G], self.start[DISTANCE] = prior.mu_g, prior.c_g, diameter
        # what is known: the floor, the distance of the centres; and no cue gives a ball more slip than some times its speed
        far = 0.2 + 2 * float(np.hypot(*far_v))
        self.known = np.array([
            (MU_G, prior.mu_g, prior.mu_g_error), (C_G, prior.c_g, prior.c_g_error),
            (DISTANCE, diameter, np.hypot(DISTANCE_ERROR * diameter, noise)), (U_IN.start, 0.0, far), (U_IN.start + 1, 0.0, far),
            (UP, 0.0, far),
        ])  # fmt: skip
        self.low, self.high = np.full(COUNT, -np.inf), np.full(COUNT, np.inf)
        self.low[MU_G], self.high[MU_G], self.low[C_G], self.low[IMPULSE.start] = (
            prior.mu_g / 20,
            prior.mu_g * 20,
            0.0,
            0.0,
        )

    def states(self, theta: Array) -> tuple[Array, list[Array], Array]:
        """Return n and t (2, 2), velocities and slips (2,) in, of ball 1, of ball 2, and the way (m, 2) before the contact."""
        n = np.array([np.cos(theta[ANGLE]), np.sin(theta[ANGLE])])
        axes = np.stack([n, [-n[1], n[0]]])
        span, u0 = max(float(theta[TIME]) - self.since, 0.0), theta[U_IN]
        t = np.append(np.clip(self.one.time[self.one.time < theta[TIME]] - self.since, 0.0, span), span)
        way = slide_then_roll(theta[ROLL] + self.k * u0, u0, t, float(theta[MU_G]), float(theta[C_G]), self.k)
        v, u = way.velocity[-1], way.slip[-1]
        # the impulse (jn, jt) turns both balls alike: by -jt/(kappa m a) about the vertical, which the floor does not feel, and
        # by jz/(kappa m a) about t, which changes the slips by -jz/kappa along n
        kick, turn = theta[IMPULSE] @ axes, -theta[UP] / self.kappa * n
        return axes, [v, u, v + kick, u + kick + turn, -kick, turn - kick], way.displacement[:-1] - way.displacement[-1]

    def places(self, theta: Array) -> tuple[Array, Array]:
        """Return the positions (n, 2) and (m, 2) of the striking ball and the struck one."""
        axes, (_v, _u, v1, u1, v2, u2), before = self.states(theta)
        x2, up = theta[PLACE], float(theta[UP])
        x1 = x2 + theta[DISTANCE] * axes[0]
        late1, late2 = (one.time >= theta[TIME] for one in (self.one, self.two))
        t1, t2 = self.one.time[late1] - theta[TIME], self.two.time[late2] - theta[TIME]
        first, second = np.empty((len(late1), 2)), np.empty((len(late2), 2))
        first[~late1], second[~late2] = x1 + before, x2
        first[late1] = x1 + _after(v1, u1, up, t1, theta, self.k, self.gravity)
        second[late2] = x2 + _after(v2, u2, -up, t2, theta, self.k, self.gravity)
        return first, second

    def residual(self, theta: Array) -> Array:
        """Return the residuals in standard deviations: frames of both balls, then prior knowledge."""
        first, second = self.places(theta)
        rows = self.known[:, 0].astype(int)
        return np.concatenate(
            [
                (self.one.whiten @ (self.one.position - first)).ravel() / self.noise,
                (self.two.whiten @ (self.two.position - second)).ravel() / self.noise,
                (theta[rows] - self.known[:, 1]) / self.known[:, 2],
            ]
        )

    def solve(self, start: Array, free: NDArray[np.bool_]) -> tuple[float, Array]:
        """Minimise over the free parameters from a start: return the sum of squares, and the parameters."""

        def filled(part: Array) -> Array:
            theta = start.copy()
            theta[free] = part
            return theta

        def slope(part: Array) -> Array:
            return central_differences(lambda some: self.residual(filled(some)), part, 1e-4 * SCALE[free])

        found, cost, before = start[free], math.inf, math.inf
        for _ in range(MOST_TRIES):  # (each has a limited number of steps)
            found, cost = solve(
                lambda part: self.residual(filled(part)),
                slope,
                found,
                SCALE[free],
                (self.low[free], self.high[free]),
                1e-7,
            )
            if not cost < 0.99 * before:
                break
            before = cost
        return cost, filled(found)

    def outputs(self, theta: Array) -> Array:
        """Return the quantities of PAIR_OUTPUTS."""
        axes, vectors, _way = self.states(theta)
        v, u, v1, u1, v2, u2 = (axes @ one for one in vectors)
        return np.array([
            theta[TIME], *theta[PLACE], theta[ANGLE], *v, *u, *theta[IMPULSE], theta[UP], *v1, *u1, *v2, *u2,
            theta[MU_G], theta[C_G],
        ])  # fmt: skip


def _line(t: Array, x: Array) -> tuple[Array, Array]:
    """Return the velocity and the place at t = 0 of a straight line through the frames that are nearest to it."""
    count = max(LINE_FRAMES, int(np.searchsorted(t, LINE_S)))
    velocity, place = np.polyfit(t[:count], x[:count], 1)
    return velocity, place


def _time_apart(x: Array, v: Array, distance: float) -> float:
    """Return when a ball at x, of velocity v, is at a distance from the origin, or nearest to it."""
    a, b, c = (float(one) for one in (v @ v, x @ v, x @ x - distance * distance))
    return (-b - math.sqrt(max(b * b - a * c, 0.0))) / max(a, 1e-12)


def fit_pair(
    one: BallFrames, two: BallFrames, near: float, diameter: float, noise: float, prior: Prior, gravity: float
) -> PairFit:
    """Fit a ball that strikes one at rest.

    Parameters
    ----------
    one, two : BallFrames
        Of the striking ball and of the struck one, before the contact and after it.
    near : float
        Approximate time of the contact, s.
    diameter : float
        Distance of the centres of two balls that touch, m.
    noise : float
        Standard deviation of one coordinate of one frame, m.
    prior : Prior
        Prior knowledge of the floor.
    gravity : float
        m/s^2.
    """
    job = _PairProblem(one, two, near, diameter, noise, prior, gravity)
    # (with the floor held at first: free at once, a wrong floor would be found in place of a slide)
    every, held = np.ones(COUNT, bool), np.arange(COUNT) < MU_G
    rolls = every.copy()
    rolls[U_IN] = False
    best, free = job.solve(job.solve(job.start, rolls & held)[1], rolls), rolls
    starts = []
    for share in SLIDES:
        start = job.start.copy()
        start[U_IN] = share * job.start[ROLL]
        start[ROLL] = job.start[ROLL] - job.k * start[U_IN]
        starts.append(job.solve(start, held))
    sliding = job.solve(min(starts, key=lambda found: found[0])[1], every)
    slid = sliding[0] < best[0] - CHI2_SLIDING
    if slid:
        best, free = sliding, every
    theta = best[1]
    slope = central_differences(job.residual, theta, 1e-4 * SCALE)[:, free]
    inverse = np.linalg.pinv(slope.T @ slope, rcond=1e-14, hermitian=True)
    rate = central_differences(job.outputs, theta, 1e-4 * SCALE)[:, free]
    rows: int = 2 * (len(one.time) + len(two.time))
    r = job.residual(theta)[:rows]
    spent = float(np.einsum("ij,jk,ik->", slope[:rows], inverse, slope[:rows]))
    first, second = job.places(theta)
    return PairFit(
        job.outputs(theta),
        rate @ inverse @ rate.T,
        float(r @ r),
        rows - spent,
        slid,
        (one.position - first, two.position - second),
    )
