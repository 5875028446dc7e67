"""Down to the least distance between tracks and simulations.

Shared numbers p (of the law, the floor, the walls) and, for each stretch, a start q of its own. A start touches only its own
stretch, so for given p each is found by itself (Levenberg and Marquardt's way, all stretches in one call of the engine), and
lmfit seeks p over what is left: variable projection, after Golub & Pereyra, SIAM J. Numer. Anal. 10, 413 (1973), with Kaufman's
derivative, BIT 15, 49 (1975). That derivative's normal matrix is the information on p with all starts free.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from carom.fitting.whole_follow import START
from carom.fitting.whole_follow import follow as follow_starts
from carom.fitting.whole_laws import WholeLaw
from carom.fitting.whole_runs import Stretch
from carom.scene.model import Scene

__all__ = [
    "Frames",
    "Numbers",
    "Settled",
    "Starts",
    "descend",
    "projected",
    "scan",
    "settle",
    "shared_slope",
    "spin_loss",
    "used_numbers",
]

Array = NDArray[np.float64]
Numbers = dict[str, float]
STEP = 1e-6  # of the scales, for differences: the simulation is exact, so its rounding is 1e-9 of that
LOST = 0.5  # m: how far a ball is taken to be where its law has no answer
DAMPING, MOST_DAMPING = 1e-3, 1e5
ENOUGH = 1e-3  # of chi^2, or of what a frame leaves over where the law does not follow
NEXT = 8  # rounds from starts that were the best for numbers a little different
K = len(START)


@dataclass(frozen=True, eq=False)
class Frames:
    """Stretches as arrays, padded to the longest."""

    stretches: tuple[Stretch, ...]
    time: Array
    """(N, T) s."""
    position: Array
    """(N, T, 2) m."""
    count: NDArray[np.int64]
    """(N,) frames that count."""
    sigma: Array
    """(N,) m, of one coordinate of one frame."""

    @classmethod
    def of(cls, stretches: Sequence[Stretch], sigma: float) -> Frames:
        """All frames."""
        each = np.full(len(stretches), sigma)
        longest = max(len(one.time) for one in stretches)
        time, position = np.zeros((len(stretches), longest)), np.zeros((len(stretches), longest, 2))
        for n, one in enumerate(stretches):
            time[n, : len(one.time)], position[n, : len(one.time)] = one.time, one.position
        return cls(
            tuple(stretches), time, position, np.array([len(one.time) for one in stretches], dtype=np.int64), each
        )

    def until(self, contacts: int) -> Frames:
        """Only those before the contact after so many."""
        count = np.array([one.frames_until(contacts) for one in self.stretches], dtype=np.int64)
        longest = int(count.max())
        return Frames(
            self.stretches, self.time[:, :longest].copy(), self.position[:, :longest].copy(), count, self.sigma
        )

    def pick(self, which: NDArray[np.intp]) -> Frames:
        """Only those stretches."""
        return Frames(
            tuple(self.stretches[i] for i in which.tolist()), self.time[which], self.position[which], self.count[which],
            self.sigma[which],
        )  # fmt: skip

    def gap(self, places: Array) -> Array:
        """(N, 2 T): simulated less tracked, in standard deviations; 0 where there is no frame."""
        inside = (np.arange(self.time.shape[1]) < self.count[:, None])[:, :, None]
        gap = np.where(np.isnan(places), LOST, places - self.position) * inside / self.sigma[:, None, None]
        return np.asarray(gap.reshape(len(gap), -1))


@dataclass(frozen=True, eq=False)
class Starts:
    """What is known of the starts: which of their numbers are free, what is known of them, their scales. (N, 7) each."""

    free: NDArray[np.bool_]
    weight: Array
    """1 / variance about zero; 0 where nothing is known."""
    scale: Array

    def pick(self, which: NDArray[np.intp]) -> Starts:
        """Only those stretches."""
        return Starts(self.free[which], self.weight[which], self.scale[which])


@dataclass(frozen=True, eq=False)
class Settled:
    """The best starts for given numbers."""

    q: Array
    """(N, 7)"""
    gap: Array
    """(N, 2 T)"""
    slope: Array
    """(N, 2 T, 7) of the gaps by the starts, scaled."""
    cost: Array
    """(N,) sum of squares, with what is known of the starts."""


def follow(scenes: Sequence[Scene], which: NDArray[np.int64], frames: Frames, q: Array) -> Array:
    """Gaps (N, 2 T) of runs from q (N, 7), whose last number is the sidespin at the first contact.

    At the start it is more, by what the cloth takes on the way: a ball that had less than that comes without, so the start's own
    spin has a range in which nothing depends on it, and a search would be stuck there.
    """
    loss = np.array([spin_loss(scene) for scene in scenes])[which]
    first = np.array([one.contacts[0] for one in frames.stretches])
    start = q.copy()
    start[:, 6] += np.sign(q[:, 6]) * loss * first
    return frames.gap(follow_starts(scenes, which, start, frames.time, frames.count))


def spin_loss(scene: Scene) -> float:
    """How fast the cloth takes the spin about the vertical, rad/s^2."""
    assert scene.floor is not None
    ball = scene.balls[0]
    return float(scene.floor.spin_friction * -scene.gravity[2] / (ball.ball.kappa * ball.radius))


def _many(scene: Scene, frames: Frames, tried: Array) -> Array:
    """Gaps (N, M, 2 T) of M starts (N, M, 7) for each stretch."""
    n, m, _k = tried.shape
    which = np.repeat(np.arange(n), m)
    spread = frames.pick(which)
    return follow([scene], np.zeros(n * m, np.int64), spread, tried.reshape(n * m, K)).reshape(n, m, -1)


def _slope(scene: Scene, frames: Frames, starts: Starts, q: Array, gap: Array) -> Array:
    """(N, 2 T, 7): of the gaps by q / scale, one step forward."""
    columns = np.flatnonzero(starts.free.any(axis=0))
    tried = np.repeat(q[:, None], len(columns), axis=1)
    tried[:, np.arange(len(columns)), columns] += STEP * starts.scale[:, columns]
    slope = np.zeros((*gap.shape, K))
    slope[:, :, columns] = np.moveaxis(_many(scene, frames, tried) - gap[:, None], 1, 2) / STEP
    return slope * starts.free[:, None, :]


def _cost(gap: Array, q: Array, starts: Starts) -> Array:
    return np.asarray((gap * gap).sum(axis=-1) + (starts.weight * q * q).sum(axis=-1))


def information(slope: Array, starts: Starts) -> Array:
    """(N, 7, 7): of the scaled starts; 1 where a number is held."""
    matrix = np.swapaxes(slope, 1, 2) @ slope
    diagonal = starts.weight * starts.scale**2 + ~starts.free
    matrix[:, np.arange(K), np.arange(K)] += diagonal
    return np.asarray(matrix)


def _solved(matrix: Array, right: Array) -> Array:
    """Solutions of (N, 7, 7) times (N, 7, M), by scaled rows and columns."""
    size = 1 / np.sqrt(np.maximum(np.einsum("nii->ni", matrix), 1e-300))
    scaled = matrix * size[:, :, None] * size[:, None, :]
    scaled[:, np.arange(K), np.arange(K)] += 1e-13
    return np.asarray(size[:, :, None] * np.linalg.solve(scaled, size[:, :, None] * right))


def settle(scene: Scene, frames: Frames, starts: Starts, q: Array, rounds: int = 30) -> Settled:
    """The starts that bring the simulation nearest to the frames, going down from q (N, 7)."""
    q = q.copy()
    gap = _many(scene, frames, q[:, None])[:, 0]
    cost = _cost(gap, q, starts)
    slope = _slope(scene, frames, starts, q, gap)
    damping = np.full(len(q), DAMPING)
    active = np.arange(len(q))
    for _ in range(rounds):
        some, part = frames.pick(active), starts.pick(active)
        matrix = information(slope[active], part)
        right = np.einsum("ntk,nt->nk", slope[active], gap[active]) + part.weight * part.scale * q[active]
        right *= part.free
        diagonal = np.einsum("nii->ni", matrix)
        damped = matrix.copy()
        damped[:, np.arange(K), np.arange(K)] += damping[active, None] * diagonal
        step = _solved(damped, right[:, :, None])[:, :, 0]
        tried = q[active] - step * part.scale
        new_gap = _many(scene, some, tried[:, None])[:, 0]
        new_cost = _cost(new_gap, tried, part)
        better = new_cost < cost[active]
        gain = cost[active] - new_cost
        done = (better & (gain < ENOUGH * np.maximum(1.0, cost[active] / (2 * some.count)))) | (
            (right * step).sum(axis=1) < 1e-4
        )
        taken = active[better]
        q[taken], gap[taken], cost[taken] = tried[better], new_gap[better], new_cost[better]
        damping[active] = np.where(better, damping[active] / 10, damping[active] * 10)
        if len(taken):
            slope[taken] = _slope(scene, frames.pick(taken), starts.pick(taken), q[taken], gap[taken])
        active = active[~done & (damping[active] < MOST_DAMPING)]
        if not len(active):
            break
    return Settled(q, gap, slope, cost)


def scan(scene: Scene, frames: Frames, q: Array, tried: Array) -> Array:
    """(N, M): sums of squares with M sidespins (N, M) in place of the starts' own."""
    starts = np.repeat(q[:, None], tried.shape[1], axis=1)
    starts[:, :, 6] = tried
    gaps = _many(scene, frames, starts)
    return np.asarray((gaps * gaps).sum(axis=-1))


def shared_slope(law: WholeLaw, frames: Frames, q: Array, numbers: Mapping[str, float]) -> Array:
    """(N, 2 T, P): by the shared numbers, the starts where they are."""
    names = list(law.free)
    n, p = len(q), len(names)
    if not names:
        return np.zeros((n, 2 * frames.time.shape[1], 0))
    scenes, steps = [law.scene(numbers)], []
    for name in names:
        parameter = law.free[name]
        h = STEP * min(parameter.high - parameter.low, 1.0)
        if numbers[name] + h > parameter.high:
            h = -h
        scenes.append(law.scene({**numbers, name: numbers[name] + h}))
        steps.append(h)
    rows = np.tile(np.arange(n), p + 1)
    gaps = follow(scenes, np.repeat(np.arange(p + 1), n), frames.pick(rows), q[rows]).reshape(p + 1, n, -1)
    return np.asarray(np.moveaxis((gaps[1:] - gaps[0]) / np.array(steps)[:, None, None], 0, 2))


def projected(settled: Settled, starts: Starts, by_shared: Array) -> tuple[Array, Array]:
    """Slopes by the shared numbers with the starts following: of the gaps (N, 2 T, P), of what is known of starts (N, 7, P)."""
    matrix = information(settled.slope, starts)
    follows = _solved(matrix, np.swapaxes(settled.slope, 1, 2) @ by_shared)
    root = np.sqrt(starts.weight) * starts.scale
    return by_shared - settled.slope @ follows, -root[:, :, None] * follows


def used_numbers(settled: Settled, starts: Starts) -> float:
    """How many numbers of the starts the frames tell: the trace of their share in the information."""
    told = np.swapaxes(settled.slope, 1, 2) @ settled.slope
    return float(np.einsum("nii->", _solved(information(settled.slope, starts), told)))


class _Problem:
    """What lmfit asks: gaps and their slopes at some numbers; the best starts so far are where the next search begins."""

    def __init__(self, law: WholeLaw, frames: Frames, starts: Starts, q: Array, tell: Callable[[], None]) -> None:
        self.law, self.frames, self.starts, self.tell = law, frames, starts, tell
        self.q, self.least = q, np.inf
        self.known: tuple[tuple[float, ...], Settled] | None = None

    def at(self, numbers: Numbers) -> Settled:
        key = tuple(numbers.values())
        if self.known is None or self.known[0] != key:
            self.known = key, settle(self.law.scene(numbers), self.frames, self.starts, self.q, NEXT)
            cost = float(self.known[1].cost.sum())
            if cost < self.least:
                self.least, self.q = cost, self.known[1].q
            self.tell()
        return self.known[1]

    def residual(self, params: object) -> Array:
        settled = self.at(dict(params.valuesdict()))  # type: ignore[attr-defined]
        known = np.sqrt(self.starts.weight) * settled.q
        return np.concatenate([settled.gap.ravel(), known.ravel()])

    def slope(self, params: object) -> Array:
        numbers = dict(params.valuesdict())  # type: ignore[attr-defined]
        settled = self.at(numbers)
        by_shared = shared_slope(self.law, self.frames, settled.q, numbers)
        gaps, known = projected(settled, self.starts, by_shared)
        p = by_shared.shape[2]
        return np.concatenate([gaps.reshape(-1, p), known.reshape(-1, p)])


def descend(
    law: WholeLaw, frames: Frames, starts: Starts, q: Array, numbers: Numbers, tell: Callable[[], None],
    exact: bool = True,
) -> tuple[Numbers, Settled]:  # fmt: skip
    """The best shared numbers, by lmfit, and the starts that go with them."""
    import lmfit

    if not law.free:
        return numbers, settle(law.scene(numbers), frames, starts, q)
    params = lmfit.Parameters()
    for name, parameter in law.free.items():
        reach = 1e-6 * (parameter.high - parameter.low)  # at a bound itself lmfit's change of variables has no slope
        value = float(np.clip(numbers[name], parameter.low + reach, parameter.high - reach))
        params.add(name, value=value, min=parameter.low, max=parameter.high)
    problem = _Problem(law, frames, starts, q, tell)
    tolerance = 1e-2 / (2 * float(frames.count.sum())) if exact else 1e-3
    found = lmfit.Minimizer(problem.residual, params, scale_covar=False, calc_covar=False).leastsq(
        Dfun=problem.slope, ftol=tolerance, xtol=tolerance, factor=1.0, max_nfev=60 if exact else 12
    )
    best = {name: float(found.params[name].value) for name in law.free}
    return best, settle(law.scene(best), frames, starts, problem.q)
