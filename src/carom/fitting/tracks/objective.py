"""Least-squares objective of whole tracks: parameters that all segments share, and a separate start for each segment.

A start affects only its own segment, so for given shared parameters the starts are fitted separately, all segments in one call of
the engine with its exact derivatives, and the shared parameters minimise the remainder: variable projection, after Golub & Pereyra,
SIAM J. Numer. Anal. 10, 413 (1973), with Kaufman's derivative, BIT 15, 49 (1975), whose normal matrix is the information on the
shared parameters with all starts free. Both descents are :func:`carom.fitting.optimizer.minimize`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from carom.core.jit.dual.dual_records import float_count, float_places
from carom.core.jit.dual.numbers import LANES
from carom.fitting.optimizer import minimize
from carom.fitting.tracks.arrays import Table
from carom.fitting.tracks.model import TrackModel
from carom.fitting.tracks.segments import TrackSegment
from carom.fitting.tracks.simulate import START, positions_and_slopes, positions_at, start_slopes
from carom.simulation.records import BALLS
from carom.simulation.sensitivity.at_times import Slopes
from carom.simulation.setup import SceneArrays

__all__ = [
    "SIDESPIN", "SLIP", "VELOCITY", "BestStarts", "Numbers", "SegmentArrays", "Starts", "descend", "effective_numbers",
    "projected", "scan", "settle", "shared_slope", "spin_loss",
]  # fmt: skip

Array = NDArray[np.float64]
Numbers = dict[str, float]
UNDEFINED_DISTANCE = 0.5  # m between frame and ball where the law is undefined
START_TOLERANCE, START_STEPS, NEXT_STEPS = 1e-3, 30, 9  # of chi^2; steps from anywhere, and from nearby parameters
SHARED_TOLERANCE, ROUGH_TOLERANCE = 1e-2, 1e-3  # of chi^2; of its value
SHARED_STEPS, ROUGH_STEPS = 60, 12
K = len(START)
VELOCITY, SLIP, SIDESPIN = slice(2, 4), slice(4, 6), START.index("spin_z")  # parts of a start


@dataclass(frozen=True, eq=False)
class SegmentArrays:
    """Segments as arrays, padded to the longest."""

    segments: tuple[TrackSegment, ...]
    time: Array
    """(N, T) s."""
    position: Array
    """(N, T, 2) m."""
    count: NDArray[np.int64]
    """(N,) frames that count."""
    sigma: Array
    """(N,) m, of one coordinate of one frame."""

    @classmethod
    def of(cls, segments: Sequence[TrackSegment], sigma: float) -> SegmentArrays:
        """Return all frames."""
        count = np.array([len(one.time) for one in segments], dtype=np.int64)
        time, position = np.zeros((len(count), count.max())), np.zeros((len(count), count.max(), 2))
        for n, one in enumerate(segments):
            time[n, : count[n]], position[n, : count[n]] = one.time, one.position
        return cls(tuple(segments), time, position, count, np.full(len(count), sigma))

    def until(self, contacts: int) -> SegmentArrays:
        """Return only those before the contact after so many."""
        count = np.array([one.frames_until(contacts) for one in self.segments], dtype=np.int64)
        time, position = self.time[:, : count.max()].copy(), self.position[:, : count.max()].copy()
        return replace(self, time=time, position=position, count=count)

    def pick(self, which: NDArray[np.int64]) -> SegmentArrays:
        """Return only those segments."""
        arrays = {name: getattr(self, name)[which] for name in ("time", "position", "count", "sigma")}
        return SegmentArrays(tuple(self.segments[i] for i in which.tolist()), **arrays)

    def gap(self, places: Array) -> Array:
        """Return simulated less tracked positions (N, 2 T), in standard deviations; 0 where there is no frame."""
        inside = (np.arange(self.time.shape[1]) < self.count[:, None])[:, :, None]
        gap = (
            np.where(np.isnan(places), UNDEFINED_DISTANCE, places - self.position) * inside / self.sigma[:, None, None]
        )
        return np.asarray(gap.reshape(len(gap), -1))

    @property
    def groups(self) -> list[NDArray[np.int64]]:
        """Segments of each shot."""
        names = np.array([one.group or one.name for one in self.segments])
        return [np.flatnonzero(names == name) for name in dict.fromkeys(names.tolist())]


@dataclass(frozen=True, eq=False)
class Starts:
    """The numbers of the starts: which are free, their prior, their scales. (N, 7) each."""

    free: NDArray[np.bool_]
    weight: Array
    """1 / variance of a normal prior about zero; 0: none."""
    scale: Array

    def pick(self, which: NDArray[np.int64]) -> Starts:
        """Return only those segments."""
        return Starts(self.free[which], self.weight[which], self.scale[which])


@dataclass(frozen=True, eq=False)
class BestStarts:
    """The best starts for given parameters."""

    q: Array
    """(N, 7)"""
    gap: Array
    """(N, 2 T)"""
    slope: Array
    """(N, 2 T, 7) derivative of the gaps in the scaled starts."""
    cost: Array
    """(N,) sum of squares, with the prior."""


def _on_table(setup: SceneArrays, frames: SegmentArrays, q: Array) -> Array:
    """Return the starts (N, 7) of q (N, 7), whose sidespin is that at the first contact.

    The spin at the start is larger, by the loss on the cloth until then: a ball that had less than this loss arrives without
    sidespin, so within a range no residual depends on the spin at the start, and a search would not converge.
    """
    start = q.copy()
    start[:, SIDESPIN] += np.sign(q[:, SIDESPIN]) * spin_loss(setup) * _first_contacts(frames)
    return start


def _first_contacts(frames: SegmentArrays) -> Array:
    return np.array([one.contacts[0] for one in frames.segments])


def spin_loss(setup: SceneArrays) -> float:
    """Return the rate at which the cloth reduces the spin about the vertical, rad/s^2."""
    world, ball = setup.world[0], setup.balls[0]
    return float(world["spin_friction"] * world["g"] / (ball["kappa"] * ball["radius"]))


def _many(setup: SceneArrays, frames: SegmentArrays, tried: Array) -> Array:
    """Return the gaps (N, M, 2 T) of M starts (N, M, 7) for each segment."""
    n, m, _k = tried.shape
    spread = frames.pick(np.repeat(np.arange(n), m))
    start = _on_table(setup, spread, tried.reshape(n * m, K))
    return spread.gap(positions_at(setup, start, spread.time, spread.count)).reshape(n, m, -1)


def _slope(table: Table, frames: SegmentArrays, q: Array, by_scene: Slopes, by_start: Array) -> Array:
    """Return the derivatives (N, 2 T, C LANES) of the simulated positions."""
    start = _on_table(table.setup, frames, q)
    _places, slopes = positions_and_slopes(
        table.setup, table.family.duals, start, frames.time, frames.count, by_scene, by_start
    )
    return slopes.reshape(len(q), -1, slopes.shape[-1])


def _start_slope(table: Table, frames: SegmentArrays, starts: Starts, q: Array) -> Array:
    """Return the derivative (N, 2 T, 7) of the gaps in q / scale."""
    by_start = np.zeros((len(q), 1, 1, float_count(BALLS), LANES))
    unit = starts.free * starts.scale / frames.sigma[:, None]
    by_start[:, 0, 0, :, :K] = start_slopes(float(table.setup.balls["radius"][0])) * unit[:, None]
    return _slope(table, frames, q, table.family.packed([]), by_start)[..., :K]


def _information(slope: Array, starts: Starts) -> Array:
    """Return the information (N, 7, 7) on the scaled starts; 1 where a number is held."""
    matrix = np.swapaxes(slope, 1, 2) @ slope
    matrix[:, np.arange(K), np.arange(K)] += starts.weight * starts.scale**2 + ~starts.free
    return np.asarray(matrix)


def _solved(matrix: Array, right: Array) -> Array:
    """Return solutions of (N, 7, 7) times (N, 7, M), with rows and columns scaled."""
    size = 1 / np.sqrt(np.maximum(np.einsum("nii->ni", matrix), 1e-300))
    scaled = matrix * size[:, :, None] * size[:, None, :]
    scaled[:, np.arange(K), np.arange(K)] += 1e-13
    return np.asarray(size[:, :, None] * np.linalg.solve(scaled, size[:, :, None] * right))


def settle(table: Table, frames: SegmentArrays, starts: Starts, q: Array, steps: int = START_STEPS) -> BestStarts:
    """Find the starts whose simulations are nearest to the frames, descending from q (N, 7). ``steps`` 1: evaluate only at q."""
    width = 2 * frames.time.shape[1]
    tried, gap, slope = np.zeros((len(q), width)), np.zeros((len(q), width)), np.zeros((len(q), width, K))

    def evaluate(which: NDArray[np.int64], at: Array, derivatives: bool) -> tuple[Array, Array, Array]:
        some, part = frames.pick(which), starts.pick(which)
        here = at * part.scale
        if not derivatives:
            tried[which] = _many(table.setup, some, here[:, None])[:, 0]
        value = np.square(tried[which]).sum(axis=-1) + (part.weight * here * here).sum(axis=-1)
        if not derivatives:
            return value, at, at
        gap[which] = tried[which]
        slope[which] = _start_slope(table, some, part, here)
        score = -(np.einsum("ntk,nt->nk", slope[which], gap[which]) + part.weight * part.scale * here) * part.free
        return value, score, _information(slope[which], part)

    far = np.full(K, np.inf)
    dof = np.asarray(2.0 * frames.count, dtype=np.float64)
    begin = q / starts.scale
    found = minimize(evaluate, begin, -far, far, steps=steps, tolerance=START_TOLERANCE, dof=dof, joint=False)
    return BestStarts(found.p * starts.scale, gap, slope, found.value)


def scan(table: Table, frames: SegmentArrays, q: Array, tried: Array) -> Array:
    """Return sums of squares (N, M) with M sidespins (N, M) instead of the starts' own."""
    starts = np.repeat(q[:, None], tried.shape[1], axis=1)
    starts[:, :, SIDESPIN] = tried
    return np.asarray(np.square(_many(table.setup, frames, starts)).sum(axis=-1))


def shared_slope(model: TrackModel, frames: SegmentArrays, q: Array, numbers: Mapping[str, float]) -> Array:
    """Return the derivative (N, 2 T, P) of the gaps in the shared parameters, with the starts held."""
    names = list(model.free)
    if not names:
        return np.zeros((len(q), 2 * frames.time.shape[1], 0))
    table = model.table(numbers)
    by_scene = table.family.packed(names)
    by_start = np.zeros((len(q), len(by_scene["world"]), 1, float_count(BALLS), LANES))
    if "spin_loss" in names:
        chunk, lane = divmod(names.index("spin_loss"), LANES)
        turned = np.sign(q[:, SIDESPIN]) * _first_contacts(frames)
        by_start[:, chunk, 0, float_places(BALLS)["w"].stop - 1, lane] = turned
    return _slope(table, frames, q, by_scene, by_start)[..., : len(names)] / frames.sigma[:, None, None]


def projected(settled: BestStarts, starts: Starts, by_shared: Array) -> tuple[Array, Array]:
    """Return the derivatives in the shared parameters with the starts refitted: of gaps (N, 2 T, P) and prior (N, 7, P)."""
    follows = _solved(_information(settled.slope, starts), np.swapaxes(settled.slope, 1, 2) @ by_shared)
    root = np.sqrt(starts.weight) * starts.scale
    return by_shared - settled.slope @ follows, -root[:, :, None] * follows


def effective_numbers(settled: BestStarts, starts: Starts) -> float:
    """Return the effective number of parameters of the starts: the share of the frames in their information."""
    known = np.swapaxes(settled.slope, 1, 2) @ settled.slope
    return float(np.einsum("nii->", _solved(_information(settled.slope, starts), known)))


def descend(
    model: TrackModel, frames: SegmentArrays, starts: Starts, q: Array, numbers: Mapping[str, float], tell: Callable[[], None],
    exact: bool = True,
) -> tuple[Numbers, BestStarts]:  # fmt: skip
    """Find the best shared parameters, and the starts that go with them."""
    names, nearest, least = list(model.free), q, np.inf
    settled = None

    def evaluate(_which: NDArray[np.int64], at: Array, derivatives: bool) -> tuple[Array, Array, Array]:
        nonlocal nearest, least, settled
        here = dict(zip(names, at[0].tolist(), strict=True))
        if settled is None or not derivatives:
            steps = NEXT_STEPS if np.isfinite(least) else START_STEPS
            settled = settle(model.table(here), frames, starts, nearest, steps)
            tell()
        value = float(settled.cost.sum())
        if value < least:
            nearest, least = settled.q, value
        if not derivatives:
            return np.array([value]), at, at
        gaps, prior = projected(settled, starts, shared_slope(model, frames, settled.q, here))
        known = np.sqrt(starts.weight) * settled.q
        score = -np.einsum("ntp,nt->p", gaps, settled.gap) - np.einsum("nkp,nk->p", prior, known)
        information = np.einsum("ntp,ntr->pr", gaps, gaps) + np.einsum("nkp,nkr->pr", prior, prior)
        return np.array([value]), score[None], information[None]

    if not names:
        return {}, settle(model.table(numbers), frames, starts, q)
    low, high = (np.array([getattr(one, end) for one in model.free.values()]) for end in ("low", "high"))
    dof = 2.0 * float(frames.count.sum())
    begin = np.clip([[numbers[name] for name in names]], low, high)
    tolerance = SHARED_TOLERANCE if exact else ROUGH_TOLERANCE * dof
    found = minimize(
        evaluate, begin, low, high, steps=SHARED_STEPS if exact else ROUGH_STEPS, tolerance=tolerance, dof=np.array([dof]),
        joint=False,
    )  # fmt: skip
    best = dict(zip(names, found.p[0].tolist(), strict=True))
    return best, settle(model.table(best), frames, starts, nearest)
