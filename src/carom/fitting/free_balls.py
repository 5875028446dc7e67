"""Fits to balls in free motion: collisions in their tracks, the contacts of a gas, and drag and lift of flights.

Collisions of free balls or discs found in their tracks, as rebounds: two balls meet as one with the reduced mass meets a wall.

With the velocity u = v1 - v2, the normal n from the second ball to the first, and S = a1 w1 + a2 w2, the slip is u - S x n. An
impulse J changes u by J/M and S by -n x J/(kappa M), where M is the reduced mass. So a pair with one kappa is a ball of velocity u
and spin S/a at a wall.

The path of each ball is cut into straight flights: the cut with the least sum of squares over all frames, and a cost for each bend
(optimal partitioning: Jackson et al. 2005, DOI 10.1109/LSP.2001.838216). Bends of two balls are one collision if there is a time
at which both paths are continuous, the balls touch, and their momentum is kept, within the errors of the four flights.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from itertools import pairwise
from pathlib import Path
from typing import Any, ClassVar, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.data.columns import as_columns, is_columns, read_columns
from carom.data.rebounds import Rebounds, make_rebounds
from carom.errors import CaromError, Fault, FaultList
from carom.files import as_path
from carom.fitting.files import fit
from carom.fitting.ranking import Ranking
from carom.fitting.result import Estimate, estimate_dict
from carom.formatting import counted
from carom.gas.scene import GasScene, load_gas
from carom.gas.species import ANY
from carom.scene.restitution import Exponential, Polynomial, Power, Viscoelastic
from carom.scene.scene import Run, Scene
from carom.scene.schema import Model
from carom.scene.toml import load_scene, path_match, replaced
from carom.simulation.sensitivity.sensitivity import sensitivities
from carom.tracks.judgement import read_rows
from carom.tracks.least_squares import central_differences
from carom.tracks.track import BallRows

Array = NDArray[np.float64]
LEAST_NOISE = 1e-9  # of the radius: simulated places have none
LEAST_SIGMA = 1e-5  # of the speeds, as a fit needs error bars
LEAST_APPROACH = 6.0  # error bars of the approach speed: slower collisions tell nothing
BEND = 17.0  # cost of a bend in the sum of squares over the noise squared, per axis: by chance in one of 10^5 flights
UNLIKELY = 5.0  # chi^2 of a collision beyond its expectation, in its standard deviations
ALL_FRAMES = 64  # so many frames ago any may have been a flight's first
FRAMES_OF_SPIN = 4  # of a flight with more, the first and the last are not used for its spin
STEPS = 4  # of the search for a collision's numbers
ROUNDS = 3  # the noise is that about the flights, which are found with the noise


@dataclass
class StraightFlight:
    """A straight piece of a ball's path: place at its mean time, velocity, and their variances over that of the noise."""

    first: int
    last: int
    begin: float
    end: float
    middle: float
    place: Array
    velocity: Array
    spread: float
    """Sum of the squares of the times about the middle, s^2; 0 of a single frame."""
    spin: Array

    @property
    def count(self) -> int:
        """How many frames it has."""
        return self.last - self.first + 1

    def at(self, t: float) -> tuple[Array, float]:
        """Return the place at a time, and its variance over the noise's."""
        s = t - self.middle
        return self.place + s * self.velocity, 1 / self.count + s * s / self.spread


class _Bend(NamedTuple):
    """A ball's path just before and after its velocity changes."""

    ball: int
    before: StraightFlight
    after: StraightFlight


def collisions_of_tracks(
    columns: dict[str, Any], radius: float, sides: Array | None = None, gravity: Array | None = None
) -> tuple[Rebounds, list[str]]:
    """Return the collisions of two balls that free tracks show, as planar rebounds along their slip, and notes.

    Parameters
    ----------
    columns : dict of arrays
        ``t`` (s), ``ball``, ``x``, ``y`` and maybe ``z`` (m), spins ``wz`` and, of spheres, ``wx``, ``wy`` (rad/s); maybe
        ``radius`` and ``mass`` of each ball.
    radius : float
        Of balls without one, m.
    sides : (3,) array, optional
        Of a periodic box, m, in which balls meet each other's images; inf along an axis that is not periodic. Places may be wrapped
        into the box, or not.
    gravity : (3,) array, optional
        With which the balls fall, m/s^2; none by default.

    Returns
    -------
    Rebounds, list of str
        ``spin`` columns are those of a ball with ``radius`` (the first one's). Raises CaromError where no collision is resolved.
    """
    rows = len(np.asarray(columns["t"]))
    filled = {name: np.asarray(values) for name, values in columns.items()}
    axes = 3 if "z" in filled else 2
    for name in ("wx", "wy") if "wz" in filled else ():
        filled.setdefault(name, np.zeros(rows))
    filled.setdefault("z", np.zeros(rows))
    filled.setdefault("radius", np.full(rows, radius))
    balls, sigma, _notes, _view = read_rows(filled, radius, 1.0, None)
    around = np.full(3, math.inf) if sides is None else sides
    paths = [_unwrapped(ball, around, np.zeros(3) if gravity is None else gravity, axes) for ball in balls]
    flights: list[list[StraightFlight]] = []
    for _ in range(ROUNDS):
        flights = _flights(balls, paths, sigma)
        found = _noise_about(balls, paths, flights)
        if abs(found / sigma - 1) < 0.05:
            break
        sigma = found
    return _rebounds(balls, flights, sigma, radius, around[:axes], "wz" in columns)


# --- flights --------------------------------------------------------------------------------------------------------------


def _unwrapped(ball: BallRows, sides: Array, gravity: Array, axes: int) -> Array:
    """Return the places (n, axes) without jumps to the other side of the box, and less the fall, so that flights are straight."""
    x = ball.x.copy()
    for k in np.flatnonzero(np.isfinite(sides)):
        steps = np.diff(x[:, k])
        x[1:, k] = x[0, k] + np.cumsum(steps - sides[k] * np.round(steps / sides[k]))
    fall: Array = x[:, :axes] - np.multiply.outer(np.square(ball.t - ball.t[0]) / 2, gravity[:axes])
    return fall


def _flights(balls: Sequence[BallRows], paths: Sequence[Array], sigma: float) -> list[list[StraightFlight]]:
    """Return the straight flights of each ball: the cut of its frames with the least sum of squares and cost of bends.

    The line from each possible start is kept, and each frame added to all of them, of all balls at once; what a start cannot win
    back is left out, and of starts long ago some are enough to find a bend, whose frame is then sought beside.
    """
    axes = paths[0].shape[1]
    counts = np.array([len(x) for x in paths])
    n, bend = int(counts.max()), BEND * axes
    t, x = np.zeros((len(balls), n)), np.zeros((len(balls), n, axes))
    for k, (ball, path) in enumerate(zip(balls, paths, strict=True)):
        t[k, : counts[k]], x[k, : counts[k]] = ball.t, path
    best, origin = np.zeros((len(balls), n + 1)), np.zeros((len(balls), n), dtype=int)
    best[:, 0] = -bend
    # of each start: its ball and index, frames, mean time and place, velocity, sum of squares of times and of what is left
    of, start, number = np.zeros(0, int), np.zeros(0, int), np.zeros(0)
    tm, xm, v, spread, left = np.zeros(0), np.zeros((0, axes)), np.zeros((0, axes)), np.zeros(0), np.zeros(0)
    total = np.zeros(0)
    for k in range(n):
        own = np.flatnonzero(counts > k)
        zero, flat = np.zeros(len(own)), np.zeros((len(own), axes))
        kept = counts[of] > k
        if k % 8 == 0:  # (what is left out later does no harm)
            kept &= (total <= best[of, k]) & (_enough(k - start, start) | (start == origin[of, k - 1]))
        fresh = (own, np.full(len(own), k), zero, t[own, k], x[own, k], flat, zero, zero)
        of, start, number, tm, xm, v, spread, left = (
            np.concatenate([old[kept], new])
            for old, new in zip((of, start, number, tm, xm, v, spread, left), fresh, strict=True)
        )
        after, s = t[of, k] - tm, number / (number + 1)
        here = x[of, k]
        off = here - xm - v * after[:, None]
        grown = spread + s * after**2
        with np.errstate(divide="ignore", invalid="ignore"):
            share = np.where(spread > 0, 1 / (1 + 1 / number + after**2 / spread), 0.0)
            v = v + np.where(grown > 0, s * after / grown, 0.0)[:, None] * off
        left = left + share * np.square(off).sum(axis=1)
        number, spread = number + 1, grown
        tm, xm = tm + after / number, xm + (here - xm) / number[:, None]
        total = best[of, start] + left / sigma**2
        least = np.full(len(balls), math.inf)
        np.minimum.at(least, of, total)
        best[:, k + 1] = least + bend
        first = total == least[of]
        origin[of[first], k] = start[first]
    return [
        [_flight(ball.t, path, ball.w, a, b - 1) for a, b in pairwise(_cuts(ball.t, path, own, count))]
        for ball, path, own, count in zip(balls, paths, origin, counts.tolist(), strict=True)
    ]


def _enough(age: NDArray[np.int64], start: NDArray[np.int64]) -> NDArray[np.bool_]:
    """Return which starts are kept: all of the last frames, then one in four, one in sixteen..."""
    level = np.maximum(np.ceil(np.log2(np.maximum(age, 1) / ALL_FRAMES) / 2), 0).astype(int)
    kept: NDArray[np.bool_] = start % 4**level == 0
    return kept


def _cuts(t: Array, x: Array, origin: NDArray[np.int64], count: int) -> list[int]:
    """Return the first frame of each flight, and the number of frames."""
    cuts = [count]
    while cuts[-1] > 0:
        cuts.append(int(origin[cuts[-1] - 1]))
    cuts.reverse()
    for k in range(1, len(cuts) - 1):
        low, at, high = cuts[k - 1 : k + 2]
        step = 1
        while high - at > ALL_FRAMES * step and at % (4 * step) == 0:  # (a start that may stand for others)
            step *= 4
        if step > 1:
            tried = range(max(low + 2, at - step), min(high - 2, at + step) + 1)
            cuts[k] = min(tried, key=lambda one: _left(t[low:one], x[low:one]) + _left(t[one:high], x[one:high]))
    return cuts


def _left(t: Array, x: Array) -> float:
    """Return the sum of squares about the line through places (n, axes)."""
    after, off = t - t.mean(), x - x.mean(axis=0)
    return float(np.square(off - np.multiply.outer(after, after @ off / max(float(after @ after), 1e-300))).sum())


def _flight(t: Array, x: Array, w: Array | None, first: int, last: int) -> StraightFlight:
    rows = slice(first, last + 1)
    middle = float(t[rows].mean())
    after = t[rows] - middle
    spread = float(after @ after)
    velocity = after @ x[rows] / spread if spread > 0 else np.zeros(x.shape[1])
    # (the frames beside a bend may be on its other side, within the noise)
    within = slice(first + 1, last) if last - first >= FRAMES_OF_SPIN else rows
    spin = np.zeros(3) if w is None else w[within].mean(axis=0)
    return StraightFlight(
        first, last, float(t[first]), float(t[last]), middle, x[rows].mean(axis=0), velocity, spread, spin
    )


def _noise_about(
    balls: Sequence[BallRows], paths: Sequence[Array], flights: Sequence[Sequence[StraightFlight]]
) -> float:
    """Return the standard deviation of a coordinate about the flights, m."""
    squares, free = 0.0, 0
    for ball, x, own in zip(balls, paths, flights, strict=True):
        for one in own:
            rows = slice(one.first, one.last + 1)
            line = one.place + np.multiply.outer(ball.t[rows] - one.middle, one.velocity)
            if one.count > 2:
                squares, free = squares + float(np.square(x[rows] - line).sum()), free + x.shape[1] * (one.count - 2)
    return max(math.sqrt(squares / max(free, 1)), LEAST_NOISE * balls[0].radius)


def _spin_noise(balls: Sequence[BallRows], flights: Sequence[Sequence[StraightFlight]]) -> float:
    """Return the standard deviation of a component of a spin about its mean in each flight, rad/s."""
    squares, free = 0.0, 0
    for ball, own in zip(balls, flights, strict=True):
        for one in own:
            if ball.w is not None and one.count > FRAMES_OF_SPIN:
                w = ball.w[one.first + 1 : one.last]
                squares += float(np.square(w - one.spin).sum())
                free += (len(w) - 1) * max(int(ball.w.any(axis=0).sum()), 1)  # (discs turn about one axis)
    return math.sqrt(squares / max(free, 1))


# --- collisions -----------------------------------------------------------------------------------------------------------


class _Collision(NamedTuple):
    """Two bends as one collision: their numbers (places and velocities of four flights, then the time), and covariance of these
    over the noise's."""

    chi2: float
    numbers: Array
    covariance: Array


class _Pair:
    """What two bends of two balls have to fulfil to be one collision; flights in the order before, after, before, after."""

    def __init__(self, flights: Sequence[StraightFlight], masses: Sequence[float], touch: float, sides: Array) -> None:
        self.flights, self.masses, self.touch, self.sides = flights, masses, touch, sides
        self.axes = len(sides)
        self.middles = np.array([one.middle for one in flights])

    def states(self, numbers: Array) -> tuple[Array, Array, float]:
        """Return places at the collision and velocities (4, axes) of the four flights, and its time."""
        place, velocity = numbers[:-1].reshape(2, 4, self.axes)
        return place + (numbers[-1] - self.middles)[:, None] * velocity, velocity, float(numbers[-1])

    def apart(self, places: Array) -> Array:
        """Return the vector (axes,) from the second ball to the first."""
        r = (places[0] + places[1] - places[2] - places[3]) / 2
        around = np.isfinite(self.sides)
        nearest: Array = r - np.where(around, np.round(r / self.sides), 0.0) * np.where(around, self.sides, 0.0)
        return nearest

    def misfit(self, numbers: Array) -> Array:
        """Return what is to be zero: jumps of both paths, momentum that appears, and how far the balls are from touching."""
        x, v, _t = self.states(numbers)
        m = self.masses
        gap = float(np.linalg.norm(self.apart(x))) - self.touch
        momentum = (m[0] * (v[1] - v[0]) + m[1] * (v[3] - v[2])) / sum(m)
        return np.concatenate([x[1] - x[0], x[3] - x[2], momentum, [gap]])

    def slopes(self, numbers: Array) -> Array:
        """Return the derivatives (3 axes + 1, 8 axes + 1) of the misfit."""
        d, m, one = self.axes, self.masses, np.eye(self.axes)
        x, v, t = self.states(numbers)
        after = t - self.middles
        found = np.zeros((3 * d + 1, 8 * d + 1))
        r = self.apart(x)
        n = r / np.linalg.norm(r)
        for k, (row, sign, weight) in enumerate(((0, -1, m[0]), (0, 1, m[0]), (1, -1, m[1]), (1, 1, m[1]))):
            place, velocity = slice(k * d, (k + 1) * d), slice((4 + k) * d, (5 + k) * d)
            rows = slice(row * d, (row + 1) * d)
            found[rows, place], found[rows, velocity] = sign * one, sign * after[k] * one
            found[rows, -1] += sign * v[k]
            found[2 * d : 3 * d, velocity] = sign * weight / sum(m) * one
            side = 0.5 if row == 0 else -0.5
            found[-1, place], found[-1, velocity] = side * n, side * after[k] * n
            found[-1, -1] += side * float(n @ v[k])
        return found

    def collision(self) -> _Collision:
        """Return the numbers nearest to those of the flights, in their errors, with which all is fulfilled."""
        d, f = self.axes, self.flights
        precision = np.repeat([*(one.count for one in f), *(one.spread for one in f)], d)
        given = np.concatenate([*(one.place for one in f), *(one.velocity for one in f)])
        bend = np.concatenate([f[1].velocity - f[0].velocity, f[3].velocity - f[2].velocity])
        jump = np.concatenate([f[1].at(0.0)[0] - f[0].at(0.0)[0], f[3].at(0.0)[0] - f[2].at(0.0)[0]])
        low, high = max(f[0].end, f[2].end), min(f[1].begin, f[3].begin)
        low, high = min(low, high), max(low, high)
        t = float(np.clip(-(jump @ bend) / max(float(bend @ bend), 1e-300), low - (high - low), high + (high - low)))
        numbers = np.append(given, t)
        rows = 3 * d + 1
        for _ in range(STEPS):
            slopes = self.slopes(numbers)
            u, size, vh = np.linalg.svd(slopes)
            free = vh[rows:].T
            moved = numbers - vh[:rows].T @ ((u.T @ self.misfit(numbers)) / size)
            weighed = free[:-1] * precision[:, None]
            inside = np.linalg.inv(free[:-1].T @ weighed)
            numbers = moved + free @ (inside @ (weighed.T @ (given - moved[:-1])))
        off = numbers[:-1] - given
        return _Collision(float(off @ (precision * off)), numbers, free @ inside @ free.T)


def _rebounds(
    balls: Sequence[BallRows],
    flights: Sequence[Sequence[StraightFlight]],
    sigma: float,
    radius: float,
    sides: Array,
    spins: bool,
) -> tuple[Rebounds, list[str]]:
    """Return the rebounds of all pairs of bends that are a collision, and notes on the others."""
    bends = [_Bend(k, a, b) for k, own in enumerate(flights) for a, b in pairwise(own)]
    bends.sort(key=lambda one: one.before.end)
    pairs, beside = _pairs(bends, balls, flights, sigma, sides)
    used: set[int] = set()
    rows: list[tuple[float, tuple[float, ...]]] = []  # with the times, by which they are sorted
    slow, spin_noise = 0, _spin_noise(balls, flights)
    for i, j, pair, one in sorted(pairs, key=lambda one: one[3].chi2):
        if used & {i, j}:
            continue
        used |= {i, j}
        row = _row(pair, one, sigma, spin_noise, [balls[bends[k].ball].radius for k in (i, j)], radius)
        slow += row is None
        rows += [] if row is None else [(float(one.numbers[-1]), row)]
    missed = math.ceil(sum(i not in used and not near <= used for i, near in beside.items()) / 2)
    lost = (
        f"{counted(missed, 'collision')} of two balls, about, not used: other collisions are too near in time for straight"
        " flights of two frames or more on either side, or the balls' radius or masses are others"
    )
    if not rows:
        raise CaromError(
            "fit_gas: tracks: expected collisions of two balls with straight flights before and after, got none; "
            + (
                lost + "; film at a higher rate"
                if missed
                else "no two balls change their velocities where they touch: film longer"
            )
        )
    names = [name + side for side in ("_in", "_out") for name in ("v_n", "v_t", "spin")]
    table = np.array([row for _time, row in sorted(rows)])
    given = dict(zip(names, table[:, :6].T, strict=True))
    given |= {f"sigma_{name}": column for name, column in zip(names, table[:, 6:12].T, strict=True)}
    extra = {f"covariance_{name}": column for name, column in zip(("v_n", "v_t"), table[:, 12:].T, strict=True)}
    notes = [f"{counted(len(rows), 'collision')} of two balls; noise of a coordinate {sigma:.3g} m"]
    notes += [lost] if missed else []
    notes += [f"{counted(slow, 'collision')} not used: too slow for the noise"] if slow else []
    if not spins:  # (unknown spins are integrated out)
        given = {name: column for name, column in given.items() if "spin" not in name}
    found = make_rebounds("planar", given, source="tracks")
    return replace(found, extra={**found.extra, **extra}), notes


def _pairs(
    bends: Sequence[_Bend],
    balls: Sequence[BallRows],
    flights: Sequence[Sequence[StraightFlight]],
    sigma: float,
    sides: Array,
) -> tuple[list[tuple[int, int, _Pair, _Collision]], dict[int, set[int]]]:
    """Return all pairs of bends that may be a collision, and for each bend those of other balls that are in its reach."""
    d = len(sides)
    interval = float(np.median(np.concatenate([np.diff(ball.t) for ball in balls if len(ball.t) > 1])))
    limit = (3 * d + UNLIKELY * math.sqrt(6 * d)) * sigma**2
    radius = np.array([balls[one.ball].radius for one in bends])
    jump = np.array([np.linalg.norm(one.after.velocity - one.before.velocity) for one in bends])
    early = np.array([one.before.end for one in bends]) - interval - 3 * sigma / np.maximum(jump, 1e-300)
    late = np.array([one.after.begin for one in bends]) + interval + 3 * sigma / np.maximum(jump, 1e-300)
    at = np.array([(x + y) / 2 for x, y in ((one.before.place + (one.before.end - one.before.middle) * one.before.velocity,
                    one.after.place + (one.after.begin - one.after.middle) * one.after.velocity) for one in bends)])  # fmt: skip
    speed = np.array([max(np.linalg.norm(one.before.velocity), np.linalg.norm(one.after.velocity)) for one in bends])
    ball = np.array([one.ball for one in bends])
    found, beside = [], dict[int, set[int]]()
    around = np.isfinite(sides)
    for i in range(len(bends)):
        others = np.flatnonzero((early <= late[i]) & (late >= early[i]) & (ball != ball[i]))
        r = at[others] - at[i]
        r -= np.where(around, np.round(r / sides), 0.0) * np.where(around, sides, 0.0)
        wide = np.maximum(late[i] - early[i], late[others] - early[others])
        reach = radius[i] + radius[others] + 5 * sigma + (speed[i] + speed[others]) * wide
        near = others[np.linalg.norm(r, axis=1) < reach]
        beside[i] = set(near.tolist())
        for j in near[near > i].tolist():
            four = [bends[i].before, bends[i].after, bends[j].before, bends[j].after]
            if all(one.count > 1 for one in four):
                two = [balls[bends[k].ball] for k in (i, j)]
                pair = _Pair(four, [one.mass for one in two], sum(one.radius for one in two), sides)
                one = pair.collision()
                if one.chi2 < limit and np.isfinite(one.numbers).all():
                    found.append((i, j, pair, one))
    return found, beside


def _row(
    pair: _Pair, found: _Collision, sigma: float, spin_noise: float, arms: Sequence[float], radius: float
) -> tuple[float, ...] | None:
    """Return velocities and spins of a pair before and after, their error bars, and covariances; None for a slow approach."""
    turns = []
    for a, b in ((0, 2), (1, 3)):
        one, two = pair.flights[a], pair.flights[b]
        error = spin_noise * math.hypot(
            *(arm / math.sqrt(max(f.count - 2, 1)) for arm, f in zip(arms, (one, two), strict=True))
        )
        turns.append((arms[0] * one.spin + arms[1] * two.spin, error / radius))
    along: Array | None = None

    def seen(numbers: Array) -> Array:
        """Return v_n and v_t, before and after."""
        x, v, _t = pair.states(numbers)
        n, t = _frame(pair.apart(x), along)
        values: list[float] = []
        for sign, u in ((-1.0, v[0] - v[2]), (1.0, v[1] - v[3])):
            values += [sign * float(u @ n[: pair.axes]), float(u @ t[: pair.axes])]
        return np.array(values)

    x, v, _t = pair.states(found.numbers)
    n, _ = _frame(pair.apart(x), None)
    u = np.append(v[0] - v[2], np.zeros(3 - pair.axes))
    slip = u - float(u @ n) * n - np.cross(turns[0][0], n)
    along = slip if np.linalg.norm(slip) > 0 else np.cross(n, [0.0, 0.0, 1.0])
    values = seen(found.numbers)
    steps = np.sqrt(np.maximum(np.diag(found.covariance), 0.0)) * sigma / 10
    slopes = central_differences(seen, found.numbers, steps, steps > 0)
    covariance = sigma**2 * slopes @ found.covariance[np.ix_(steps > 0, steps > 0)] @ slopes.T
    least = LEAST_SIGMA * float(np.linalg.norm(u))
    errors = np.maximum(np.sqrt(np.diag(covariance)), least)
    if values[0] < LEAST_APPROACH * errors[0]:
        return None
    n, t = _frame(pair.apart(x), along)
    spin = [float(np.cross(turn, n) @ t) / radius for turn, _error in turns]
    spin_errors = [max(error, least / radius) for _turn, error in turns]
    return (
        values[0], values[1], spin[0], values[2], values[3], spin[1],
        errors[0], errors[1], spin_errors[0], errors[2], errors[3], spin_errors[1],
        covariance[0, 2], covariance[1, 3],
    )  # fmt: skip


def _frame(r: Array, along: Array | None) -> tuple[Array, Array]:
    """Return the unit vectors (3,) along r (2 or 3,), and along another as far as it is normal to it."""
    n = np.append(r, np.zeros(3 - len(r))) / np.linalg.norm(r)
    if along is None:
        return n, n
    t = along - float(along @ n) * n
    return n, t / np.linalg.norm(t)


# ----------------------------------------------------------------------------------------------------
# Restitution, friction and tangential restitution of a gas, from tracks of its balls: ``carom fit gas``.


TRACKS = ("t", "ball", "x", "y")
MIN_SLIDING = 4  # collisions, by which friction is told: of fewer one with a wrong error bar may decide


@dataclass(frozen=True, eq=False)
class FittedValues:
    """Numbers that tracks of free balls show, with standard errors."""

    OWN: ClassVar[tuple[str, ...]] = ()
    values: dict[str, float]
    errors: dict[str, float]
    notes: tuple[str, ...] = field(default=(), kw_only=True)

    def estimates(self) -> dict[str, Estimate]:
        """Return value and error bar of each number."""
        return {name: Estimate(x, self.errors[name], "") for name, x in self.values.items()}

    def to_dict(self) -> dict[str, Any]:
        """Return the results as plain numbers."""
        parameters = {name: estimate_dict(one) for name, one in self.estimates().items()}
        return {"parameters": parameters, **{name: getattr(self, name) for name in self.OWN}, "notes": list(self.notes)}


@dataclass(frozen=True, eq=False)
class GasFit(FittedValues):
    """Numbers of the contacts of a gas's balls, with standard errors."""

    OWN = ("rows",)
    rows: int
    """Collisions found in the tracks."""
    ranking: Ranking
    """The fit of the contact to them as rebounds, in the order of time."""


def fit_gas(file: str | Path | Any, scene: str | Path | GasScene) -> GasFit:
    """Infer restitution, friction and tangential restitution of the balls of a gas, with error bars.

    Parameters
    ----------
    file : path, or columns
        Tracks of free balls: columns ``t``, ``ball``, ``x``, ``y``, maybe ``z`` and spins ``wz`` (``wx``, ``wy``), a row per ball
        and frame. Each collision of two balls in them is a rebound, to which the contact law is fitted.
    scene : path or GasScene
        The gas: container, radius and inertia of the balls. Where its restitution has a form of the speed, the numbers of the form
        are inferred: ``restitution_c`` of a viscoelastic contact, ``restitution_at_rest`` and so on.

    Returns
    -------
    GasFit
        Raises CaromError, one line per problem.

    Examples
    --------
    >>> from carom.fitting import fit_gas
    >>> fit_gas({"t": [0.0, 1.0]}, "gas.toml")
    Traceback (most recent call last):
    carom.errors.CaromError: fit_gas: expected tracks of balls (columns t, ball, x, y), got t
    """
    where = "fit_gas"
    if is_columns(file):
        columns = as_columns(file, where)
    else:
        path = as_path(where, file)
        where, columns = str(path), read_columns(path)[0]
    faults = FaultList(where)
    if not set(TRACKS) <= set(columns):
        faults.add("", f"tracks of balls (columns {', '.join(TRACKS)})", f"{', '.join(columns)}")
    if isinstance(scene, GasScene) or not faults:
        gas = scene if isinstance(scene, GasScene) else load_gas(scene)
        names = {ANY, *(one.name for one in gas.species)}
        # (with wildcards also of a ball and a wall)
        of_balls = [one for one in gas.contacts if set(one.between) <= names]
        if not of_balls:
            faults.add("contacts", "a contact of the balls in the scene", "none")
    faults.raise_if_any()
    first = of_balls[0].restitution
    form = first.form if isinstance(first, (Exponential, Polynomial, Power, Viscoelastic)) else "constant"
    return _of_tracks(columns, gas, form)


def _of_tracks(columns: Any, scene: GasScene, form: str) -> GasFit:
    species = scene.species[0]
    box, sides, gravity = scene.container.geometry, np.full(3, math.inf), np.zeros(3)
    gravity[: len(scene.gravity_vector)] = scene.gravity_vector
    for axis, (length, around) in enumerate(zip(box.size, box.periodic, strict=True)):
        sides[axis] = length if around else math.inf
    table, notes = collisions_of_tracks(dict(columns), species.nominal, sides, gravity)
    kappa = species.kappa(scene.container.dimensions)
    how: Any = {"bootstrap": 0, "profiles": False, "robust": True}
    ranking = fit(table, species.nominal, inertia=kappa, laws=["contact"], restitution=form, **how)
    assert isinstance(ranking, Ranking)
    estimates = dict(ranking.ranked[0].fit.estimates)
    if "friction" in estimates and (sliding := _sliding(table, estimates, species.nominal, kappa)) < MIN_SLIDING:
        least = estimates.pop("friction").value
        notes.append(
            f"friction is not told by these data: {counted(sliding, 'collision')} in {len(table)} slide"
            + ("" if least is None else f"; it is some {least:.2g} or more")
        )
    values, errors = {}, {}
    for name, one in estimates.items():
        if one.value is None:
            notes.append(f"{name} is not told by these data")
        elif one.stderr is None or not one.stderr > 0:
            notes.append(f"{name}: {one.value:.4g}, at the end of its range, has no error bar")
        else:
            values[name], errors[name] = float(one.value), float(one.stderr)
    return GasFit(values, errors, len(table["v_n_in"]), ranking, notes=tuple(notes))


def _sliding(table: Rebounds, estimates: Any, radius: float, kappa: float) -> int:
    """Return how many collisions slide to their end: more friction would change them. (All, if spins are not known.)"""
    beta, mu = (estimates[name].value if name in estimates else None for name in ("tangential_restitution", "friction"))
    if beta is None or mu is None or not np.isfinite(table["spin_in"]).all():
        return len(table)
    slip = np.abs(table["v_t_in"] - radius * table["spin_in"])
    needed = (1 + beta) * kappa / (1 + kappa) * slip / (table["v_n_in"] + table["v_n_out"])
    return int((needed > mu).sum())


# ----------------------------------------------------------------------------------------------------
# Drag and lift of a ball from flights with known spins: each with a start of its own, along carom's own paths and derivatives.


STARTS = ["balls.0.position", "balls.0.velocity"]
AIR_ROUNDS, CLOSE = 20, 1e-9  # of steps; a change of the coefficients that is none
ASTRAY = 4.0  # times the median: a flight that is so far from its path is left out
FEWEST = 5  # frames of a flight
BOUNCES = 10.0  # times the noise: a flight that is so far from its path is not one flight


@dataclass(frozen=True, eq=False)
class AirFit(FittedValues):
    """Coefficients of drag and lift that flights show, by path, such as ``balls.0.drag``."""

    OWN = ("flights", "residual", "spin_ratios")
    flights: int
    residual: float
    """Root mean square distance of the frames from the paths, m."""
    spin_ratios: tuple[float, float]
    """The least and the largest of the flights, as they begin."""
    scene: Scene
    """The ball with these numbers."""
    distances: Array
    """(N,) of each flight, m, root mean square; and the quantities (N,) against which they may be plotted, by label."""
    against: dict[str, Array]


def fit_air(file: str | Path | Any, scene: str | Path | Scene) -> AirFit:
    """Fit the numbers of a ball's drag and lift to flights, each with a start of its own.

    Parameters
    ----------
    file : path or columns
        Columns t (s), x, y, z (m), wx, wy, wz (rad/s), and ``ball``, which names the flight: a row per frame.
    scene : path or Scene
        Its air, its gravity, and its first ball: radius, mass, and the numbers or forms of ``drag`` and ``lift``, whose numbers are
        fitted, from there on.

    Returns
    -------
    AirFit. Error bars are from how the flights differ. Raises CaromError, one line, for columns that are missing, flights of fewer
    than 5 frames, and for a ball without a number to fit.

    Examples
    --------
    >>> import carom, numpy as np
    >>> ball = {"radius": 0.02, "mass": 0.0027, "position": (0, 0, 1), "drag": 0.5, "lift": 0.2}
    >>> ball |= {"velocity": (6, 0, 2), "spin": (0, 200, 0)}
    >>> scene = carom.Scene(air={"density": 1.2}, balls=[ball], run=carom.Run(duration=0.3))
    >>> table = carom.simulate(scene).table(np.linspace(0, 0.3, 31))
    >>> found = carom.fit_air(table, carom.replaced(scene, {"balls.0.drag": 0.4, "balls.0.lift": 0.1}))
    >>> {name: round(x, 6) for name, x in found.values.items()}
    {'balls.0.drag': 0.5, 'balls.0.lift': 0.2}
    """
    where = "fit_air"
    given = scene if isinstance(scene, Scene) else load_scene(scene)
    if given.air is None:
        raise CaromError(Fault(where, "scene", "a scene with a table [air]", "one without"))
    ball = given.balls[0]
    paths = [path for name in ("drag", "lift") for path in _numbers(name, getattr(ball, name))]
    if not paths:
        advice = "a number to begin with, such as drag = 0.5"
        raise CaromError(
            Fault(where, "scene", "numbers or forms for drag or lift of its first ball", "names of laws", advice)
        )
    rows, noise, notes, _view = read_rows(file, ball.radius, ball.mass, None)
    flights = [one for one in rows if len(one.t) >= FEWEST]
    if not flights or any(one.w is None for one in flights):
        got = f"flights of fewer than {FEWEST}" if not flights else "no spins"
        raise CaromError(Fault(where, "file", f"flights of {FEWEST} frames or more, and columns wx, wy, wz", got))
    longest = 1.001 * max(float(np.ptp(one.t)) for one in flights)
    still = {"position": (0.0, 0.0, 0.0), "rolling": False, "strike": None, "spin": (0.0, 0.0, 0.0), "spin_z": None}
    one_ball = (ball.model_copy(update=still),)
    alone = Scene(air=given.air, gravity=given.gravity, balls=one_ball, run=Run(law="mirror", duration=longest))
    values = np.array([path_match(alone, path).values[0] for path in paths])
    values, covariance, far, good = _fit(alone, paths, values, flights)
    if not good.all():
        out = f"{int((~good).sum())} of {len(flights)} flights left out"
        notes.append(f"{out}: farther from their paths than {ASTRAY:g} times the median")
    flights = [one for one, use in zip(flights, good, strict=True) if use]
    far = far[good]
    if (worst := float(far.max())) > max(BOUNCES * noise, 1e-6):
        notes.append(f"frames are {1e3 * worst:.3g} mm off: a flight with a bounce in it, or a law that does not hold")
    starts = [_start(one) for one in flights]
    ratios = [ball.radius * float(np.linalg.norm(w) / np.linalg.norm(v)) for _x, v, w in starts]
    speeds = np.array([np.linalg.norm(v) for _x, v, _w in starts])
    return AirFit(
        dict(zip(paths, values.tolist(), strict=True)),
        dict(zip(paths, np.sqrt(np.diag(covariance)).tolist(), strict=True)),
        len(flights), float(np.sqrt(np.mean(np.square(far)))), (min(ratios), max(ratios)),
        replaced(given, dict(zip(paths, values.tolist(), strict=True))), far,
        {"spin ratio": np.array(ratios), "speed, m/s": speeds, "flight": np.flatnonzero(good).astype(float) + 1},
        notes=tuple(notes),
    )  # fmt: skip


def _numbers(name: str, law: Any) -> list[str]:
    """Return the paths of the numbers of a ball's law of drag or lift."""
    if isinstance(law, float):
        return [f"balls.0.{name}"]
    fields = type(law).model_fields if isinstance(law, Model) else ()
    found = [(field, getattr(law, field)) for field in fields if field not in ("reynolds", "spin_ratio")]
    own = [f"balls.0.{name}.{field}" for field, value in found if isinstance(value, float)]
    return own + [
        f"balls.0.{name}.{field}.{k}" for field, value in found if isinstance(value, tuple) for k in range(len(value))
    ]


def _start(one: BallRows) -> tuple[Array, Array, Array]:
    """Return about where a flight begins, how fast, and its spin."""
    numbers = np.polynomial.polynomial.polyfit(one.t - one.t[0], one.x, 2)
    return numbers[0], numbers[1], np.zeros(3) if one.w is None else one.w[0]


def _fit(
    scene: Scene, paths: list[str], values: Array, flights: list[BallRows]
) -> tuple[Array, Array, Array, NDArray[np.bool_]]:
    """Return the numbers, their covariance, the distance of each flight's frames from its path (root mean square, m), and which
    flights were used.
    """
    most = max(len(one.t) for one in flights)
    times = np.array([np.pad(one.t - one.t[0], (0, most - len(one.t)), mode="edge") for one in flights])
    seen = np.array([np.arange(most) < len(one.t) for one in flights])
    measured = np.array([np.pad(one.x, ((0, most - len(one.t)), (0, 0)), mode="edge") for one in flights])
    starts, spin = np.split(np.array([np.concatenate(_start(one)) for one in flights]), [6], axis=1)
    bends: Any = None
    for _ in range(AIR_ROUNDS):
        here = replaced(scene, dict(zip(paths, values.tolist(), strict=True)))
        many = sensitivities(
            here, [*STARTS, *paths], starts[:, None, 3:], spin[:, None], starts[:, None, :3], times=times
        )
        if (bad := np.flatnonzero(many.why != "")).size:
            raise CaromError(
                f"fit_air: expected flights that can be followed, got at flight {bad[0]}: {many.why[bad[0]]}"
            )
        apart = (measured - many.states.position[:, :, 0]) * seen[..., None]  # type: ignore[union-attr, index]
        slopes = many.slopes.position[:, :, 0] * seen[..., None, None]  # type: ignore[union-attr]
        own, shared = np.zeros((len(flights), 6, len(paths) + 1)), []
        for n, (r, j) in enumerate(
            zip(apart.reshape(len(flights), -1), slopes.reshape(len(flights), 3 * most, -1), strict=True)
        ):
            q, upper = np.linalg.qr(j[:, :6])
            rest = np.column_stack([j[:, 6:], r])
            own[n] = np.linalg.solve(upper, q.T @ rest)
            shared.append(rest - q @ (q.T @ rest))
        far = np.sqrt(np.square(apart).sum(axis=(1, 2)) / seen.sum(axis=1))
        good = far <= ASTRAY * np.median(far)
        bends = np.array(shared)[good]
        flat = bends.reshape(-1, len(paths) + 1)
        step = np.linalg.lstsq(flat[:, :-1], flat[:, -1], rcond=None)[0]
        step *= _share(scene, paths, values, step)
        values, starts = values + step, starts + own[..., -1] - own[..., :-1] @ step
        if np.abs(step).max() <= CLOSE:
            break
    slope, r = bends[..., :-1], bends[..., -1]
    inverse, used = np.linalg.pinv(np.einsum("nij,nik->jk", slope, slope), hermitian=True), len(bends)
    free = max(3 * int(seen[good].sum()) - 6 * used - len(paths), 1)
    covariance = inverse * float(np.square(r).sum()) / free
    if used >= FEWEST:
        pull = np.einsum("nij,ni->nj", slope, r - slope @ step)
        covariance = inverse @ (pull.T @ pull) @ inverse * used / (used - 1)
    return values, covariance, far, good


def _share(scene: Scene, paths: list[str], values: Array, step: Array) -> float:
    """Return the share of a step that leads to numbers which a scene takes."""
    for halvings in range(20):
        try:
            replaced(scene, dict(zip(paths, (values + step * 0.5**halvings).tolist(), strict=True)))
        except CaromError:
            continue
        return float(0.5**halvings)
    return 0.0
