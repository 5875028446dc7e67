"""Model of a ball that strikes one at rest on a table: one impulse between them, and the motions that follow from it.

The striking ball slides or rolls before, both slide and then roll after it (:mod:`carom.tracks.contact_models`). The contact of two
equal balls is one impulse, which acts on both at the point where they touch: its three components, along the line of centres, along
the table and up, give both velocities and both slips on the cloth after it. So momentum is kept, and nothing else is assumed of
the contact: neither restitution nor friction nor a law. The frames determine the upward part, which no picture shows, by the
slide: what turns the balls makes them slide longer or shorter.

Friction between the balls lifts one of them and presses the other onto the floor. The lifted one flies and lands, the pressed one
lands at once: each loses some of its slip there.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.data.rebounds import Rebounds, make_rebounds
from carom.errors import CaromError
from carom.formatting import counted
from carom.tracks.contact import WithError
from carom.tracks.contact_models import hop_slide_roll, landed, slide_then_roll
from carom.tracks.events import TrackEvent
from carom.tracks.least_squares import (
    WHITE,
    FrameGroups,
    NamedValues,
    Prior,
    averaged_frames,
    central_differences,
    propagated,
    solve_free,
    whitening,
)
from carom.tracks.measurement import MIN_FRAMES_AFTER, MIN_FRAMES_BEFORE, Measured
from carom.tracks.track import Track

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
class PairFit(NamedValues):
    """A fitted contact of two balls: ``fit["jn"]`` is a value by its name in PAIR_OUTPUTS."""

    NAMES = PAIR_OUTPUTS
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

        def slope(theta: Array, columns: NDArray[np.bool_]) -> Array:
            return central_differences(self.residual, theta, 1e-4 * SCALE, columns)

        theta, cost, before = start, math.inf, math.inf
        for _ in range(MOST_TRIES):  # (each has a limited number of steps)
            theta, cost = solve_free(self.residual, slope, theta, free, SCALE, (self.low, self.high), 1e-7)
            if not cost < 0.99 * before:
                break
            before = cost
        return cost, theta

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
    rows = 2 * (len(one.time) + len(two.time))
    known = propagated(
        theta, free, job.residual, central_differences(job.residual, theta, 1e-4 * SCALE), job.outputs, SCALE, rows
    )
    del known["rate"]
    first, second = job.places(theta)
    return PairFit(**known, slid_before=slid, residuals=(one.position - first, two.position - second))


# ----------------------------------------------------------------------------------------------------
# Contacts of balls with each other in tracks: a ball strikes one at rest. Measured, or the reason why not.
#
# Velocities and slips just before and just after come from :mod:`carom.tracks.pairs`. As rebounds the contacts are those of one
# ball at a wall: the relative velocity of two equal balls, and the sum of their spins, are changed by a contact as velocity and
# spin of one of them are by a wall. Friction acts in the plane of the line of centres and of the slip, so that a contact is a
# bounce in this plane. The film shows the plane by the direction of the friction, and the rolling of the striking ball by its
# path; of its sidespin it shows nothing, except as far as friction turns away from the vertical.


RESTS_M, REST_NOISE = 0.003, 6.0  # a ball that moves by less, or by so many times the noise, rests
APART_FRAMES = 4  # between two meetings of the same balls, at least
REST_S = 0.25  # before the contact
MOST_REST_FRAMES = 10
LEAST_DECELERATION = 1e-4  # m/s^2
FLOOR_BETWEEN = 0.05  # by which share of itself the friction of a floor differs from place to place
SIDESPIN = 1.0  # of its speed: the standard deviation of the speed with which sidespin turns the striking ball, if nothing shows it
MAX_EXCESS_SCATTER = 2.0  # of the frames, as a multiple of all contacts'
SLIP_ERROR = 0.3  # of the slip: with a larger error the film does not tell which way the balls slide over each other
SPEEDS = ("v_n_in", "v_t_in", "spin_in", "v_n_out", "v_t_out")


@dataclass(frozen=True, eq=False)
class PairContact:
    """A ball strikes one at rest: measured, or the reason why not. :func:`carom.tracks.measure_pairs` makes them."""

    striking: str
    struck: str
    """Names of their tracks."""
    group: str
    time: float
    """s; of the frame nearest to it if it was not measured."""
    fit: PairFit | None = None
    why: str = ""
    """Why it was not measured; empty if it was."""

    @property
    def scatter(self) -> float:
        """Scatter of the frames about the fitted motion, in units of the noise; NaN without a fit."""
        return float(np.sqrt(self.fit.chi2 / max(self.fit.dof, 1.0))) if self.fit is not None else np.nan

    @property
    def restitution(self) -> WithError:
        """Speed at which the balls part along the line of centres, over that at which they meet."""
        return self._ratio(lambda it: np.array([-(it["v1n_out"] - it["v2n_out"]) / it["vn_in"]]))

    @property
    def friction(self) -> WithError:
        """Impulse across the line of centres over that along it: the coefficient of friction, where the balls slip throughout."""
        return self._ratio(lambda it: np.array([np.hypot(it["jt"], it["jz"]) / it["jn"]]))

    def _ratio(self, of: Callable[[dict[str, float]], Array]) -> WithError:
        if self.fit is None:
            return WithError(np.nan, np.nan)

        def ratio(value: Array) -> Array:
            return of(dict(zip(PAIR_OUTPUTS, value.tolist(), strict=True)))

        rate = central_differences(ratio, self.fit.value, np.full(len(PAIR_OUTPUTS), 1e-5))
        return WithError(float(ratio(self.fit.value)[0]), float(np.sqrt((rate @ self.fit.covariance @ rate.T)[0, 0])))


def measure_pairs(measured: Measured) -> tuple[PairContact, ...]:
    """Measure the contacts of balls with each other in a film from above.

    Parameters
    ----------
    measured : Measured
        From :func:`carom.tracks.measure`, with the balls' radius: noise, floor and events are taken from it.

    Returns
    -------
    tuple of PairContact
        One for each time at which two balls come so close that they may touch, and one of them then moves otherwise; in order of
        shots and times.

    Raises
    ------
    CaromError
        For a film from the side, or without the radius.

    Examples
    --------
    >>> import carom, numpy as np
    >>> from carom.tracks import Settings, Track, measure, measure_pairs
    >>> cue = {"radius": 0.03, "mass": 0.2, "position": (0.0, 0.0), "velocity": (1.0, 0.0), "rolling": True}
    >>> balls = [cue, {"radius": 0.03, "mass": 0.2, "position": (0.3, 0.02)}]
    >>> between = {"restitution": 0.95, "friction": 0.06}
    >>> run = carom.simulate(carom.Scene(balls=balls, walls=[], floor={"friction": 0.2}, ball_contact=between), duration=0.8)
    >>> t = np.arange(0, 0.8, 0.02)
    >>> film = [Track(name, t, run.at(t).position[:, k, :2]) for k, name in enumerate("AB")]
    >>> found = measure_pairs(measure(film, Settings(radius=0.03, view="above", noise=1e-4, floor_friction=0.2)))
    >>> [(one.striking, one.struck, round(one.restitution.value, 2), round(one.friction.value, 2)) for one in found]
    [('A', 'B', 0.95, 0.06)]
    """
    if measured.view != "above":
        raise CaromError("tracks: contacts of balls: expected a film from above (`view` above), got one from the side")
    if not measured.radius:
        raise CaromError("tracks: contacts of balls: expected the balls' radius, got none; `radius` 30.75mm")
    tracks = {(track.group, track.name): track for track in measured.tracks}
    found = [_contact(measured, tracks, group, meeting) for group, meeting in _meetings(measured)]
    return tuple(_checked(found, 1.0 if measured.noise_given else 1e-3))


class _Approach(NamedTuple):
    """The times at which two balls may touch."""

    low: float
    high: float
    names: tuple[str, str]
    before: tuple[list[TrackEvent], list[TrackEvent]]
    """Of each ball, its events before these times,"""
    after: tuple[list[TrackEvent], list[TrackEvent]]
    """and after them."""

    @property
    def turned(self) -> _Approach:
        """The same with the balls in the other order."""
        low, high, names, before, after = self
        return _Approach(low, high, names[::-1], before[::-1], after[::-1])


def _meetings(measured: Measured) -> Iterator[tuple[str, _Approach]]:
    """Find the times at which two balls may touch, each with its group. Times few frames apart are of one contact."""
    for (group, name), events in measured.events.items():
        times: dict[str, list[list[float]]] = {}
        for event in events:
            if event.kind == "ball" and name < event.what:
                of_pair = times.setdefault(event.what, [])
                if of_pair and event.low - of_pair[-1][1] < APART_FRAMES * measured.interval:
                    of_pair[-1][1] = max(of_pair[-1][1], event.high)
                else:
                    of_pair.append([event.low, event.high])
        for other, several in times.items():
            for low, high in several:
                rest = [
                    [
                        one
                        for one in measured.events.get((group, ball), [])
                        if one.what != against or not _within(one, low, high)
                    ]
                    for ball, against in ((name, other), (other, name))
                ]
                before = [[one for one in some if one.low < low] for some in rest]
                after = [[one for one in some if one.low >= low] for some in rest]
                yield group, _Approach(low, high, (name, other), (before[0], before[1]), (after[0], after[1]))


def _within(event: TrackEvent, low: float, high: float) -> bool:
    return event.kind == "ball" and event.low <= high and event.high >= low


def _contact(
    measured: Measured, tracks: dict[tuple[str, str], Track], group: str, event: _Approach
) -> PairContact | None:
    """Measure a contact; None where the balls passed each other, or rested side by side."""
    still = max(RESTS_M, REST_NOISE * measured.noise)
    before = [_way(tracks[group, name], event.low - REST_S, event.low) for name in event.names]
    after = [_way(tracks[group, name], event.high, event.high + REST_S) for name in event.names]
    if min(before) < still and (after[int(np.argmin(before))] < still or (max(before) < still and min(after) < still)):
        return None
    if before[0] < before[1]:
        event = event.turned
    one, two = event.names
    bare = PairContact(one, two, group, (event.low + event.high) / 2)
    if max(before) < still:
        return replace(bare, why="no frames before it show which ball strikes the other")
    if min(before) >= still:
        return replace(bare, why="both balls move before it: only a ball that strikes one at rest is measured")
    parts = [_rows(tracks[group, name], event, k, measured) for k, name in enumerate(event.names)]
    near = _start_of(tracks[group, two], parts[1][0], event, still)
    (t1, x1), (t2, x2) = parts
    rests = t2 < near
    drop = max(int(rests.sum()) - MOST_REST_FRAMES, 0)
    t2, x2, rests = t2[drop:], x2[drop:], rests[drop:]
    bare = replace(bare, time=near)
    for count, who, least in (
        (int((t1 < near).sum()), f"of ball {one} before it", MIN_FRAMES_BEFORE),
        (int((t1 > near).sum()), f"of ball {one} after it", MIN_FRAMES_AFTER),
        (int(rests.sum()), f"of ball {two} at rest before it", 1),
        (int((~rests).sum()), f"of ball {two} after it", MIN_FRAMES_AFTER),
    ):
        if count < least:
            return replace(bare, why=f"{counted(count, 'frame')} {who}, expected {least} or more")
    fit = fit_pair(
        _frames(t1, x1, near, measured), _frames(t2, x2, near, measured), near, 2 * float(measured.radius or 0), measured.noise,
        _prior(measured), measured.gravity,
    )  # fmt: skip
    if not (np.isfinite(fit.value).all() and np.isfinite(fit.covariance).all()):
        return replace(bare, why="the fit did not converge for these frames")
    return replace(bare, fit=fit, time=fit["t"])


def _way(track: Track, low: float, high: float) -> float:
    """Return how far a ball moves between two times, m; without frames there it rests."""
    rows = np.flatnonzero((track.time >= low) & (track.time <= high))
    if len(rows) == 0:
        return 0.0
    some = track.position[max(rows[0] - 1, 0) : rows[-1] + 1] if low < track.time[rows[0]] else track.position[rows]
    return float(np.ptp(some, axis=0).max())


def _rows(track: Track, event: _Approach, ball: int, measured: Measured) -> tuple[Array, Array]:
    """Return the frames about a contact that no other event separates from it: of free motion, or of rest before it."""
    window, striking = measured.window, ball == 0
    apart = ("wall", "ball", "turn", "start") if striking else ("wall", "ball", "turn")
    low = max([one.high for one in event.before[ball] if one.kind in apart] + [event.low - window])
    ends = [one.low for one in event.after[ball] if one.kind in ("wall", "ball", "turn", "gap", "end")]
    high = min([*ends, event.high + window])
    if striking and low <= track.time[0]:
        low = float(track.time[1])  # the cue may have struck it between the first two frames
    use = (track.time >= low) & (track.time <= high)
    if not striking and not (use & (track.time <= event.high)).any():
        # a program that writes moving balls only has its place at rest in the last row before
        last = int(np.searchsorted(track.time, event.high, "right")) - 1
        use[max(last, 0)] = True
    for wall in measured.walls:
        if wall.clamped:
            use &= wall.frame(track.position)[:, 0] > 1e-6
    return track.time[use], track.position[use]


def _start_of(track: Track, time: Array, event: _Approach, still: float) -> float:
    """Return about when the struck ball begins to move."""
    rows = np.searchsorted(track.time, time)
    middle = (event.low + event.high) / 2
    if len(rows) == 0:
        return middle
    away = np.flatnonzero(np.hypot(*(track.position[rows] - track.position[rows[0]]).T) > still)
    if len(away) == 0 or away[0] == 0:
        return middle
    first = float(time[away[0]])
    return max(float(time[away[0] - 1] + first) / 2, first - 1.5 * (event.high - event.low))


def _frames(t: Array, x: Array, near: float, measured: Measured) -> BallFrames:
    if (t < near).any() and (t >= near).any():
        t, x, groups = averaged_frames(t, x, near)
    else:
        groups = FrameGroups(t, t, np.ones(len(t)))
    white = measured.frame_correlation
    whiten = np.diag(np.sqrt(groups.number)) if white == WHITE else whitening(groups, white, measured.interval)
    return BallFrames(t, x, whiten)


def _prior(measured: Measured) -> Prior:
    """Return the floor as the contacts with walls show it; without them, as in the literature."""
    prior = Prior(k=measured.kappa / (1 + measured.kappa))
    for name, label in (("mu_g", "floor friction"), ("c_g", "rolling resistance")):
        if label in measured.floor:
            value, error = (measured.gravity * number for number in measured.floor[label])
            value = max(value, LEAST_DECELERATION)  # (a slide has to end some time)
            error = float(np.hypot(error, FLOOR_BETWEEN * value))
            prior = replace(prior, **{name: value, f"{name}_error": error})
    return prior


def _checked(found: Sequence[PairContact | None], least: float) -> list[PairContact]:
    """Scale the errors to the scatter of all contacts, or of their own if that is more; reject contacts that scatter far more."""
    fitted = np.array([one.scatter for one in found if one is not None and one.fit is not None])
    usual = 1.0
    if len(fitted):
        good = fitted[fitted <= 2 * np.median(fitted)]
        usual = max(float(np.sqrt(np.mean(np.square(good)))), least)
    done = []
    for one in found:
        if one is None or one.fit is None:
            done += [] if one is None else [one]
            continue
        excess = one.scatter / usual
        if excess > MAX_EXCESS_SCATTER:
            why = f"the frames scatter {excess:.1f} times as much as at other contacts: another contact, or a ball that hops?"
            done.append(replace(one, fit=None, why=why))
            continue
        noise = max(one.scatter, usual)
        done.append(replace(one, fit=replace(one.fit, covariance=one.fit.covariance * noise**2)))
    return [
        one if one.fit is None or not (why := _unusable(one.fit)) else replace(one, fit=None, why=why) for one in done
    ]


def _unusable(fit: PairFit) -> str:
    if -fit["vn_in"] < 3 * fit.error("vn_in"):
        return "the speed at which the balls meet does not exceed its error"
    if fit.error("jn") > 0.1 * fit["jn"] or fit.error("vn_in") > -0.2 * fit["vn_in"]:
        return "the speeds at which the balls meet and part are uncertain by more than 20 %"
    return ""


def _bounce(value: Array, radius: float, plane: float, sidespin: float) -> Array:
    """Return a contact as a bounce of one ball in the plane at an angle from the horizontal: SPEEDS.

    ``value``: the quantities of PAIR_OUTPUTS; ``sidespin``: the speed at which the striking ball turns about the vertical, m/s.
    """
    it = dict(zip(PAIR_OUTPUTS, value.tolist(), strict=True))
    # (the way in which the point of the striking ball slides over the other, and how much)
    level, up = np.cos(plane), np.sin(plane)
    slip = (it["vt_in"] - sidespin) * level + (it["vn_in"] - it["un_in"]) * up
    along = it["vt_in"] * level
    return np.array([
        -it["vn_in"], along, (along - slip) / radius,
        it["vn_in"] + 2 * it["jn"], along + 2 * (it["jt"] * level + it["jz"] * up),
    ])  # fmt: skip


class _Slide(NamedTuple):
    """How one ball slides over the other."""

    plane: float
    """Angle of the slip from the horizontal, rad."""
    sidespin: float
    """Speed at which the striking ball turns about the vertical, m/s."""
    sidespin_error: float
    shown: float
    """How much of the sidespin the direction of the friction shows: 0 to 1."""


def _slide(fit: PairFit) -> _Slide:
    """Return how the striking ball slides over the struck one.

    The slip up the ball is that of its rolling. Along the table sidespin counts as well, of which the path shows nothing; but
    friction acts against the slip, so that its direction shows the slip, and with that the sidespin, which is drawn towards none.
    """
    rises, along = fit["vn_in"] - fit["un_in"], fit["vt_in"]
    width = SIDESPIN * float(np.hypot(fit["vn_in"], along))
    side, error, shown = 0.0, width, 0.0
    if rises * fit["jz"] < 0:
        share = fit["jt"] / fit["jz"]
        spread = float(np.hypot(fit.error("jt"), share * fit.error("jz")) / abs(fit["jz"]))
        apart = float(np.hypot(rises * spread, share * np.hypot(fit.error("vn_in"), fit.error("un_in"))))
        shown = 1 / (1 + (apart / width) ** 2)
        side, error = shown * (along - rises * share), width * (1 - shown) ** 0.5
    return _Slide(float(np.arctan2(rises, along - side)), side, error, shown)


def _row(one: PairContact, number: int, radius: float) -> dict[str, Any]:
    fit = one.fit
    assert fit is not None
    slide = _slide(fit)
    plane, level = slide.plane, float(np.cos(slide.plane))
    step = 1e-5 * np.ones(len(PAIR_OUTPUTS))
    rate = central_differences(lambda value: _bounce(value, radius, plane, slide.sidespin), fit.value, step)
    covariance = rate @ fit.covariance @ rate.T
    values = dict(zip(SPEEDS, _bounce(fit.value, radius, plane, slide.sidespin).tolist(), strict=True))
    errors = dict(zip(SPEEDS, np.sqrt(np.diag(covariance)).tolist(), strict=True))
    errors["spin_in"] = float(np.hypot(errors["spin_in"], level * slide.sidespin_error / radius))
    slip = values["v_t_in"] - radius * values["spin_in"]
    if not np.hypot(radius * errors["spin_in"], errors["v_t_in"]) < SLIP_ERROR * slip:
        values["v_t_out"] = errors["v_t_out"] = np.nan
    # (friction is measured against the slip as it shows itself, so that it is too large by its error across that)
    j = PAIR_OUTPUTS.index("jt")
    across = np.array([-np.sin(plane), level])
    size = abs(values["v_t_out"] - values["v_t_in"])
    values["v_t_out"] += (
        slide.shown * float(across @ fit.covariance[j : j + 2, j : j + 2] @ across) / max(size / 2, 1e-9)
    )
    return {
        "shot": one.group, "striking": one.striking, "struck": one.struck, "contact": number, "t": fit["t"],
        "sigma_t": fit.error("t"), **values, **{f"sigma_{name}": error for name, error in errors.items()},
        "covariance_v_n": float(covariance[0, 3]),
        "covariance_v_t": float(covariance[1, 4]) if np.isfinite(values["v_t_out"]) else np.nan, "plane": float(np.degrees(plane)),
    }  # fmt: skip


def pair_rebounds(contacts: Sequence[PairContact], radius: float) -> Rebounds:
    """Return measured contacts of balls with each other as rebounds, from which a fit has restitution and friction between balls.

    Parameters
    ----------
    contacts : sequence of PairContact
        From :func:`measure_pairs`.
    radius : float
        Of the balls, m.

    Returns
    -------
    Rebounds
        Of the kind "planar": relative velocity of the two balls, and the sum of their spins, in the plane of friction.
        Extra columns: shot, striking, struck, contact, t (s), covariance_v_n, covariance_v_t, and plane, the angle (degrees) of
        the slip from the horizontal.

    Raises
    ------
    CaromError
        If none could be measured, with the most frequent reason.

    Examples
    --------
    >>> from carom.tracks import PairContact, pair_rebounds
    >>> pair_rebounds([PairContact("A", "B", "", 0.2, why="2 frames of ball A before it, expected 4 or more")], 0.03)
    Traceback (most recent call last):
    carom.errors.CaromError: tracks: expected a ball that strikes one at rest, and frames of both, got 1 contact of balls, none of
    which can be measured; 1 of them: 2 frames of ball A before it, expected 4 or more
    """
    rows = [_row(one, number + 1, radius) for number, one in enumerate(contacts) if one.fit is not None]
    if not rows:
        whys = [one.why for one in contacts]
        most = f"; {whys.count(max(whys, key=whys.count))} of them: {max(whys, key=whys.count)}" if whys else ""
        got = (
            f"{counted(len(whys), 'contact')} of balls, none of which can be measured"
            if whys
            else "no contact of balls"
        )
        raise CaromError(f"tracks: expected a ball that strikes one at rest, and frames of both, got {got}{most}")
    columns = {
        name: np.array([row.pop(name) for row in rows]) for name in (*SPEEDS, *(f"sigma_{name}" for name in SPEEDS))
    }
    extra = {name: np.array([row[name] for row in rows]) for name in rows[0]}
    table = make_rebounds("planar", columns, extra=extra, source="tracks")
    return replace(table, notes=(*table.notes, *_notes(table)))


def _notes(table: Rebounds) -> list[str]:
    """Return notes on what the rows are, and on what the film does not show."""
    unseen = int(np.isnan(table["v_t_out"]).sum())
    notes = [
        "contacts of two equal balls, of which one rested: relative velocities, and the sum of the spins, in the plane of"
        " friction"
    ]
    if unseen:
        notes.append(
            f"v_t_out: left out in {unseen} of {len(table)} rows: no path shows sidespin, and the friction is too small beside"
            " its error to show which way the balls slid over each other; these rows tell the restitution alone"
        )
    return notes
