"""What the first part of a filmed shot predicts of the rest, with the region in which the balls are expected.

Follow a filmed shot in short steps, with errors of the laws in each: what is known of the balls at a time, and what comes next.

A run from one start has no error after it, so that a start bends to whatever the laws lack. Here places, velocities and spins are
normal, and carried from step to step by an extended Kalman filter with exact derivatives through contacts (iterated in each step:
Bell & Cathey, IEEE Trans. Autom. Control 38, 294 (1993)). The frames of a step narrow what is known, and each change of a velocity,
by a contact or by the cloth, widens it.
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.errors import CaromError
from carom.fitting.shots.result import ShotsFit, table_of
from carom.fitting.shots.search import (
    FIRST_PLACE,
    LIMITS,
    SPIN,
    TIME,
    VELOCITY,
    FilmedShot,
    SearchSettings,
    ShotStart,
    error_of_frames,
    horizons,
    refined,
    residuals,
    search_start,
    soft,
    start_size,
    starting_balls,
)
from carom.fitting.table_numbers import TableNumbers, balls_by, balls_of, states_by
from carom.simulation.sensitivity.sensitivity import states_at

Array = NDArray[np.float64]

STEP = 0.1  # s
OWN = 7  # numbers of a ball: place (m), velocity (m/s), spin times radius (m/s)
PLACE, MOTION, TURN = slice(0, 2), slice(2, 4), slice(4, 7)
ROUNDS = 3  # of a step's descent
SOFT = 3.0  # errors of a frame, beyond which it counts in proportion
TAIL = 4.0  # degrees of freedom of Student's t: the laws' errors have heavy tails
MET = 0.25  # m/s in a step: a larger change of velocity is a contact's, whose moment within the step is not known
DIFFERENCE = 1e-3  # s


class LawErrors(NamedTuple):
    """Errors of the laws in each step, and of a frame: standard deviations."""

    share: float = 0.03
    """Of a change of velocity, along it and across."""
    spin: float = 0.1
    """Of the spin times radius after it, over the change of velocity."""
    late: float = 2e-3
    """s by which a change comes too early or too late."""
    drift: float = 5e-3
    """m/s in one second, of a ball that moves: a cloth that slopes or drags aside."""
    frame: float = 1e-3
    """m, of one coordinate of one frame."""

    def times(self, factor: float) -> LawErrors:
        """Return the errors of the laws times a factor, with the same error of a frame."""
        return LawErrors(*(factor * one for one in self))._replace(frame=self.frame)


@dataclass(frozen=True, eq=False)
class Belief:
    """What is known of a shot at a time: normal."""

    time: float
    """s of the film."""
    mean: Array
    """(S,): of each ball its place, velocity, and spin times radius; then by how much the table differs for this shot."""
    covariance: Array
    """(S, S)"""


class Followed(NamedTuple):
    """A shot that was followed through its frames."""

    belief: Belief
    """At its last frame."""
    distance: float
    """m (rms), from the frames to what is known with them."""


def _numbers(states: Array, radius: float) -> Array:
    """Return the numbers (..., OWN) of states (..., 9)."""
    return np.concatenate([states[..., :2], states[..., 3:5], radius * states[..., 6:9]], axis=-1)


def _by_numbers(balls: int, radius: float) -> Array:
    """Return the derivatives of balls by their numbers, OWN of each."""
    each = [("x", 0, 1.0), ("x", 1, 1.0), ("v", 0, 1.0), ("v", 1, 1.0), *(("w", j, 1 / radius) for j in range(3))]
    return balls_by(balls, [[(k, *one)] for k in range(balls) for one in each])


def _balls(table: TableNumbers, numbers: Array) -> NDArray[np.void]:
    """Return the balls (N, B) of numbers (N, B, OWN)."""
    n, b, _own = numbers.shape
    return balls_of(table.arrays, _by_numbers(b, float(table.arrays.balls["radius"][0])), numbers.reshape(n, -1))


def _moved(table: TableNumbers, mean: Array, time: Array, b: int) -> tuple[Array, Array]:
    """Return the numbers (T, B, OWN) of B balls at times since now, and their derivatives (T, B, OWN, S)."""
    a = float(table.arrays.balls["radius"][0])
    own, deviations = mean[: OWN * b].reshape(1, b, OWN), mean[OWN * b :]
    at = states_by(
        table, _balls(table, own), _by_numbers(b, a), time[None], np.array([len(time)]), 9, shared=bool(len(deviations)),
        deviations=deviations, limits=LIMITS,
    )  # fmt: skip
    d = np.concatenate([at.by_start[0], at.by_shared[0]], axis=-1)
    d = np.concatenate([d[:, :, :2], d[:, :, 3:5], a * d[:, :, 6:9]], axis=2)
    return _numbers(at.states[0], a), np.nan_to_num(d)


def _carried(now: Array, slopes: Array) -> Array:
    """Return the derivative (S, S) of all numbers after a step by those before it."""
    found = np.eye(slopes.shape[-1])
    found[: now.size] = slopes.reshape(now.size, -1)
    return found


def _widened(before: Array, after: Array, errors: LawErrors, seconds: float) -> Array:
    """Return the variances (B, OWN) that changes of velocity between numbers (B, OWN) bring."""
    size = np.hypot(*(after - before)[:, MOTION].T)[:, None]
    found = np.zeros_like(after)
    found[:, PLACE] = (errors.late * size) ** 2
    goes = np.hypot(*after[:, MOTION].T)[:, None] > 0
    found[:, MOTION] = ((errors.share * size) ** 2 + errors.drift**2 * seconds) * goes
    found[:, TURN] = (errors.spin * size) ** 2 * goes
    return found


def belief_of_start(table: TableNumbers, start: ShotStart, best: Array, frames: int, errors: LawErrors) -> Belief:
    """Return what the first frames of a shot say of it at the last of them, by its best start."""
    shot, own = start.shot, start_size(len(start.shot.balls))
    b, a = len(shot.balls), float(table.arrays.balls["radius"][0])
    at = residuals(table, shot, best[None], frames)
    _gap, (jac,) = soft(at.gap[0], [at.by_start[0]], error_of_frames(table, start, best, frames, errors.frame))
    rows = start.prior.rows
    covariance = np.linalg.inv(jac.T @ jac + rows.T @ rows)
    first = starting_balls(table, best[None], b)[0]
    begin = np.concatenate([first["x"][:, :2], first["v"][:, :2], a * first["w"]], axis=1)
    mean = np.concatenate([begin.ravel(), best[own:]])
    by_start = np.zeros((len(mean), len(best)))
    by_start[range(2, OWN), range(VELOCITY.start, SPIN.stop)] = 1.0
    for k in range(b):
        by_start[range(OWN * k, OWN * k + 2), range(FIRST_PLACE + 2 * k, FIRST_PLACE + 2 * k + 2)] = 1.0
    by_start[range(OWN * b, len(mean)), range(own, len(best))] = 1.0
    seconds = max(float(shot.time[frames - 1] - best[TIME]), 2 * DIFFERENCE)
    states, slopes = _moved(table, mean, np.array([seconds - DIFFERENCE, seconds]), b)
    slope = _carried(states[1], slopes[1]) @ by_start
    slope[: OWN * b, TIME] = -(states[1] - states[0]).ravel() / DIFFERENCE
    wide = np.zeros(len(mean))
    wide[: OWN * b] = _widened(begin, states[1], errors, seconds).ravel()
    mean[: OWN * b] = states[1].ravel()
    return Belief(float(shot.time[frames - 1]), mean, slope @ covariance @ slope.T + np.diag(wide))


def followed(table: TableNumbers, shot: FilmedShot, belief: Belief, errors: LawErrors) -> Followed | None:
    """Follow a shot through its frames after a belief; None where the model has no state."""
    frames, last = int(np.searchsorted(shot.time, belief.time + 1e-9)), float(shot.time[-1])
    squares, count = 0.0, 0
    while frames < len(shot.time):
        end = belief.time + STEP if last - belief.time > 1.5 * STEP else last
        until = int(np.searchsorted(shot.time, end + 1e-9))
        found = _step(table, shot, belief, slice(frames, until), end, errors)
        if found is None:
            return None
        belief, gaps = found
        squares, count, frames = squares + float(np.square(gaps).sum()), count + len(gaps), until
    return Followed(belief, float(np.sqrt(2 * squares / max(count, 1))))


def _step(
    table: TableNumbers, shot: FilmedShot, belief: Belief, rows: slice, end: float, errors: LawErrors
) -> tuple[Belief, Array] | None:
    """Take in the frames of a step; return what is known at its end, and the gaps that are left, m."""
    b = len(shot.balls)
    film, known = shot.position[rows], shot.known[rows]
    time = np.append(shot.time[rows], end) - belief.time
    mean, covariance, before = belief.mean, belief.covariance, belief.covariance
    for turn in range(ROUNDS if known.any() else 0):
        at, slopes = _moved(table, mean, time, b)
        if not np.isfinite(at).all():
            return None
        gap, by = (film - at[:-1, :, PLACE])[known].ravel(), slopes[:-1, :, PLACE][known].reshape(-1, len(mean))
        change = np.hypot(*(at[-1] - mean[: OWN * b].reshape(b, OWN))[:, MOTION].T)
        variance = errors.frame**2 + np.where(change > MET, (errors.share * change * STEP / 2) ** 2, 0.0)
        noise = np.broadcast_to(variance[None, :, None], (*known.shape, 2))[known].ravel()
        if turn:
            far = np.sqrt(np.square(gap.reshape(-1, 2)).sum(axis=1) / noise[::2])
            noise = noise * np.maximum(far / SOFT, 1.0).repeat(2) ** 2
        surprise, gain = gap - by @ (belief.mean - mean), before @ by.T
        spread = by @ gain + np.diag(noise)
        solved = np.linalg.solve(spread, np.column_stack([surprise, gain.T]))
        mean = belief.mean + gain @ solved[:, 0]
        covariance = before - gain @ solved[:, 1:]
    at, slopes = _moved(table, mean, time, b)
    if not np.isfinite(at).all():
        return None
    carry = _carried(at[-1], slopes[-1])
    covariance = carry @ covariance @ carry.T
    own = np.arange(OWN * b)
    covariance[own, own] += _widened(mean[own].reshape(b, OWN), at[-1], errors, end - belief.time).ravel()
    gaps = (film - at[:-1, :, PLACE])[known].ravel()
    return Belief(end, np.append(at[-1], mean[OWN * b :]), (covariance + covariance.T) / 2), gaps


def drawn_rests(
    table: TableNumbers, belief: Belief, b: int, time: Array, errors: LawErrors, draws: int, rng: np.random.Generator
) -> Array:
    """Return places (N, T, B, 2) of B balls at times of the film after a belief, by draws of it and of the laws' errors; NaN where
    the model has no state."""
    a, size = float(table.arrays.balls["radius"][0]), len(belief.mean)
    value, vector = np.linalg.eigh(belief.covariance)
    own, root = OWN * b, vector * np.sqrt(np.maximum(value, 0.0))
    tried = belief.mean + rng.normal(size=(draws, size)) @ root.T
    heavy = np.sqrt(TAIL / rng.chisquare(TAIL, (draws, 1, 1)))
    arrays, now = table.moved(tried[:, own:]), tried[:, :own].reshape(draws, b, OWN)
    now[..., MOTION.start :] *= np.any(belief.mean[:own].reshape(b, OWN)[:, MOTION.start :] != 0, axis=1)[:, None]
    places, begin, frames = np.full((draws, len(time), b, 2), np.nan), belief.time, 0
    while frames < len(time):
        until = int(np.searchsorted(time, begin + STEP + 1e-9))
        since = np.append(time[frames:until] - begin, STEP)
        states = states_at(
            arrays, _balls(table, now), since[None], np.full(draws, len(since)), numbers=9, limits=LIMITS
        )
        at = _numbers(states, a)
        places[:, frames:until] = at[:, :-1, :, PLACE]
        wide = np.array([_widened(*both, errors, STEP) for both in zip(now, at[:, -1], strict=True)])
        wide[..., PLACE] = 0.0  # (a ball behind a cushion would not come back)
        now = at[:, -1] + heavy * np.sqrt(wide) * rng.normal(size=now.shape)
        begin, frames = begin + STEP, until
    return places


def until_time(shot: FilmedShot, share: float) -> FilmedShot:
    """Return the first part of a shot: a share of its time."""
    frames = max(shot.frames_until(shot.time[0] + share * (shot.time[-1] - shot.time[0])), 4)
    return replace(
        shot, time=shot.time[:frames], position=shot.position[:frames], measured=shot.measured[:frames],
        events=tuple(one for one in shot.events if one.high < shot.time[frames - 1]),
    )  # fmt: skip


LEVELS = (0.68, 0.95)
FEWEST_DRAWS = 20
FEWEST = 6  # frames of a shot, before it is followed in steps
SHOTS, DRAWS = 12, 40  # of a fit, and of each: for the errors of the laws
FACTORS, HALVINGS = (0.1, 6.0), 4  # on the errors of the laws: where a search looks, and for how long


@dataclass(frozen=True, eq=False)
class PredictedShot:
    """The rest of a shot as its first part predicts it."""

    name: str
    time: Array
    """(T,) s since the end of the part that was fitted."""
    place: Array
    """(T, B, 2) m: median of the draws."""
    distance: Array
    """(T, B) m: from there to the film; NaN where the film has no row."""
    expected: Array
    """(T, B) m: the distance that is expected (root mean square of the draws)."""
    inside: NDArray[np.bool_]
    """(2, T, B): whether the film lies within the regions of 68 and 95 %."""
    fitted: float
    """m: distance (rms) in the part that was fitted."""

    @property
    def rms(self) -> float:
        """Root mean square distance over the rest, m."""
        return float(np.sqrt(np.nanmean(np.square(self.distance))))


class HeldOut(NamedTuple):
    """What first parts of shots predict of the rest; made by :func:`predict_rest`."""

    share: float
    """Of a shot's time: the part that was fitted."""
    shots: tuple[PredictedShot, ...]

    @property
    def median(self) -> float:
        """Median over the shots of the distance (rms) over the rest, m."""
        return float(np.median([one.rms for one in self.shots]))

    @property
    def coverage(self) -> tuple[float, float]:
        """Shares of the film's rows within the regions of 68 and 95 %: means over the shots, which count alike."""
        found = [one.inside[:, np.isfinite(one.distance)].mean(axis=1) for one in self.shots]
        return float(np.mean([x[0] for x in found])), float(np.mean([x[1] for x in found]))

    def against_time(self, edges: Sequence[float] = (0, 0.5, 1, 2, 3, 4, 6)) -> list[tuple[float, float, float, int]]:
        """Return rows (until so many s after the first part, median distance in m, expected one, number of shots)."""
        rows = []
        for low, high in itertools.pairwise(edges):
            far, thought = [], []
            for one in self.shots:
                which = (one.time > low) & (one.time <= high)
                if np.isfinite(one.distance[which]).any():
                    seen = np.isfinite(one.distance[which])
                    far.append(np.sqrt(np.mean(np.square(one.distance[which][seen]))))
                    thought.append(np.sqrt(np.mean(np.square(one.expected[which][seen]))))
            if far:
                rows.append((float(high), float(np.median(far)), float(np.median(thought)), len(far)))
        return rows


def predict_rest(
    fit: ShotsFit, share: float = 1 / 3, films: Sequence[FilmedShot] | None = None, *, draws: int = 200, seed: int = 0,
    errors: LawErrors | None = None,
) -> HeldOut:  # fmt: skip
    """Predict the rest of shots from their first parts, with the numbers of the table of a fit.

    The start of each shot is fitted up to its second event. From there the shot is followed in steps, in which
    the laws have errors at each change of a velocity, to the end of the first part. The rest is drawn from what is known then,
    with such errors in each later step; its middle is the median of the draws.

    Parameters
    ----------
    fit : ShotsFit
    share : float
        Of a shot's time, 0 to 1: the part that is fitted.
    films : sequence of FilmedShot, optional
        Shots of the same table; default: those of the fit. Others, that were not fitted, test the table's numbers as well.
    draws, seed : int
    errors : LawErrors, optional
        Default: :func:`errors_of_laws` of the fit.
    """
    if not 0 < share < 1:
        raise CaromError(f"predict_rest: share: expected a number between 0 and 1, got {share!r:.60}")
    begun = _begun(fit, films or [one.film for one in fit.shots], share, seed)
    if errors is None:
        errors = errors_of_laws(fit, share, seed=seed) if films else _errors(fit, begun, seed)
    return _held_out(fit, share, begun, errors, draws, seed)


def errors_of_laws(fit: ShotsFit, share: float = 1 / 3, *, seed: int = 0) -> LawErrors:
    """Return the errors of the laws with which the regions of 68 % hold so many of the film's rows, counted on a fit's own shots:
    those of :class:`LawErrors` times a factor."""
    return _errors(fit, _begun(fit, [one.film for one in fit.shots], share, seed), seed)


def _errors(fit: ShotsFit, begun: Sequence[_Begun], seed: int) -> LawErrors:
    """Return the errors of the laws by bisection of their factor, on some of the shots."""
    some = begun[:: max(len(begun) // SHOTS, 1)]
    low, high = np.log(FACTORS)
    for _ in range(HALVINGS if some else 0):
        middle = (low + high) / 2
        errors = LawErrors().times(float(np.exp(middle)))
        held = _held_out(fit, 0.0, some, errors, DRAWS, seed).coverage[0]
        low, high = (middle, high) if held < LEVELS[0] else (low, middle)
    return LawErrors().times(float(np.exp((low + high) / 2)))


def _held_out(
    fit: ShotsFit, share: float, begun: Sequence[_Begun], errors: LawErrors, draws: int, seed: int
) -> HeldOut:
    """Return all predictions with given errors of the laws."""
    table = fit.table
    return HeldOut(share, tuple(_predicted(fit, table, one, errors, draws, seed) for one in begun))


def _first_frames(shot: FilmedShot) -> int:
    """Return how many frames there are up to the second event: those from which a start is known."""
    later = [shot.frames_until(one.low) for one in shot.events[1:]]
    return min(max(later[0], FEWEST) if later else horizons(shot)[0], len(shot.time))


class _Begun(NamedTuple):
    """A shot whose first part is to be followed."""

    shot: FilmedShot
    first: FilmedShot
    start: ShotStart
    best: Array
    frames: int
    """Up to which the start is the best."""


def _begun(fit: ShotsFit, films: Sequence[FilmedShot], share: float, seed: int) -> list[_Begun]:
    """Return the shots that go on after their first part, with the start that fits the frames up to the first ball."""
    table, found = fit.table, []
    for i, shot in enumerate(films):
        first = until_time(shot, share)
        if len(first.time) < len(shot.time):
            rng, frames = np.random.default_rng([seed, i]), _first_frames(first)
            start = search_start(table, first, fit.noise, rng, SearchSettings(), widths=fit.widths)
            found.append(_Begun(shot, first, start, refined(table, start, frames, 9, 3).start, frames))
    return found


def _predicted(
    fit: ShotsFit, table: TableNumbers, begun: _Begun, errors: LawErrors, draws: int, seed: int
) -> PredictedShot:
    """Return the rest of a shot by draws of what its first part tells, and of the laws' errors after it."""
    shot, first, n, rng = begun.shot, begun.first, len(begun.first.time), np.random.default_rng([seed, 1])
    belief, distance = belief_of_start(table, begun.start, begun.best, begun.frames, errors), float("nan")
    until = followed(table, first, belief, errors)
    if until is not None:
        belief, distance = until.belief, until.distance
    rest = slice(n, None)
    x = shot.position[rest]
    places = drawn_rests(table, belief, len(shot.balls), shot.time[rest], errors, draws, rng)
    wall = table_of(fit.scene)
    inside = np.abs(places - np.array(wall.center)) < np.array([wall.length, wall.width]) / 2
    on_table = inside.all(axis=(1, 2, 3))  # (a ball that is drawn behind a cushion leaves it; NaN: no state)
    places = places[on_table] if on_table.sum() >= FEWEST_DRAWS else np.nan_to_num(places)
    middle = np.median(places, axis=0)
    # (a place of the film has the error with which the laws follow the frames up to the first ball, at least that of a frame)
    near = fit.median("ball") / np.sqrt(2)
    noise = max(fit.noise, near if np.isfinite(near) else 0.0)
    away = places - middle + rng.normal(0.0, noise, places.shape)
    cover = np.einsum("ntbi,ntbj->tbij", away, away) / len(away)
    inverse = np.linalg.inv(cover)
    film = x - middle
    of_draws = np.einsum("ntbi,tbij,ntbj->ntb", away, inverse, away)
    of_film = np.einsum("tbi,tbij,tbj->tb", film, inverse, film)
    with np.errstate(invalid="ignore"):
        inside = np.array([of_film <= np.quantile(of_draws, level, axis=0) for level in LEVELS])
    far = np.where(shot.measured[rest], np.sqrt(np.square(film).sum(axis=-1)), np.nan)
    expected = np.sqrt(np.trace(cover, axis1=2, axis2=3))
    name, time = shot.name or "film", shot.time[rest] - shot.time[n - 1]
    return PredictedShot(name, time, middle, far, expected, inside, distance)
