"""Least-squares objective of whole tracks: parameters that all segments share, and a separate start for each segment.

A start affects only its own segment, so for given shared parameters the starts are fitted separately, all segments in one call of
the engine with its exact derivatives, and the shared parameters minimise the remainder (:mod:`carom.fitting.starts`).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from carom.fitting.starts import Projection, StatesBy, balls_by, balls_of, descend_shared, nearest_starts, states_by
from carom.fitting.table_numbers import TableNumbers
from carom.fitting.tracks.model import TrackModel
from carom.fitting.tracks.segments import TrackSegment
from carom.simulation.sensitivity.at_times import states_at
from carom.simulation.setup import SceneArrays

__all__ = [
    "SIDESPIN", "SLIP", "START", "VELOCITY", "BestStarts", "Numbers", "SegmentArrays", "Starts", "balls_by_start", "descend",
    "effective_numbers", "gaps",
    "projected", "scan", "settle", "shared_slope", "spin_loss",
]  # fmt: skip

Array = NDArray[np.float64]
Numbers = dict[str, float]
UNDEFINED_DISTANCE = 0.5  # m between frame and ball where the law is undefined
START_TOLERANCE, START_STEPS, NEXT_STEPS = 1e-3, 30, 9  # of chi^2; steps from anywhere, and from nearby parameters
SHARED_TOLERANCE, ROUGH_TOLERANCE = 1e-2, 1e-3  # of chi^2; of its value
SHARED_STEPS, ROUGH_STEPS = 60, 12
START = ("x", "y", "v_x", "v_y", "u_x", "u_y", "spin_z")
"""The numbers of a start: position (m), velocity (m/s), slip on the floor (m/s), sidespin (rad/s)."""
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

    @property
    def prior(self) -> Array:
        """(N, 7, 7): times a start, a normal prior of unit width."""
        return np.asarray(np.sqrt(self.weight)[:, :, None] * np.eye(K))


@dataclass(frozen=True, eq=False)
class BestStarts:
    """The best starts for given parameters."""

    q: Array
    """(N, 7)"""
    gap: Array
    """(N, 2 T)"""
    slope: Array
    """(N, 2 T, 7) derivative of the gaps in the starts; 0 in a number that is held."""
    cost: Array
    """(N,) sum of squares, with the prior."""

    def residual(self, starts: Starts) -> Array:
        """Return gaps and prior (N, 2 T + 7)."""
        return np.concatenate([self.gap, np.sqrt(starts.weight) * self.q], axis=1)

    def projection(self, starts: Starts) -> Projection:
        """Return the projection of derivatives of these residuals. (A held number follows nothing: its prior is its own.)"""
        own = starts.prior + ~starts.free[:, :, None] * np.eye(K)
        return Projection.of(np.concatenate([self.slope, own], axis=1))


def _on_table(setup: SceneArrays, frames: SegmentArrays, q: Array) -> tuple[NDArray[np.void], Array]:
    """Return the balls (N, 1) of q (N, 7), whose sidespin is that at the first contact, and their derivatives.

    The spin at the start is larger, by the loss on the cloth until then: a ball that had less than this loss arrives without
    sidespin, so within a range no residual depends on the spin at the start, and a search would not converge.
    """
    start, by = q.copy(), balls_by_start(float(setup.balls["radius"][0]))
    start[:, SIDESPIN] += np.sign(q[:, SIDESPIN]) * spin_loss(setup) * _first_contacts(frames)
    return balls_of(setup, by, start), by


def balls_by_start(radius: float) -> Array:
    """Return the derivatives of a ball by START. (The slip is u = v + w x (-a z) = (v_x - a w_y, v_y + a w_x).)"""
    place = [[(0, "x", 0, 1.0)], [(0, "x", 1, 1.0)]]
    velocity = [[(0, "v", 0, 1.0), (0, "w", 1, 1 / radius)], [(0, "v", 1, 1.0), (0, "w", 0, -1 / radius)]]
    slip = [[(0, "w", 1, -1 / radius)], [(0, "w", 0, 1 / radius)]]
    return balls_by(1, [*place, *velocity, *slip, [(0, "w", 2, 1.0)]])


def _first_contacts(frames: SegmentArrays) -> Array:
    return np.array([one.contacts[0] for one in frames.segments])


def spin_loss(setup: SceneArrays) -> float:
    """Return the rate at which the cloth reduces the spin about the vertical, rad/s^2."""
    world, ball = setup.world[0], setup.balls[0]
    return float(world["spin_friction"] * world["g"] / (ball["kappa"] * ball["radius"]))


def gaps(table: TableNumbers, frames: SegmentArrays, q: Array) -> Array:
    """Return the gaps (N, 2 T) of starts (N, 7)."""
    balls, _by = _on_table(table.arrays, frames, q)
    return frames.gap(states_at(table.arrays, balls, frames.time, frames.count, 2)[:, :, 0])


def _states(table: TableNumbers, frames: SegmentArrays, q: Array, shared: bool = False) -> StatesBy:
    """Return the states of starts (N, 7) at the frames, and the derivatives of their places."""
    balls, by = _on_table(table.arrays, frames, q)
    return states_by(table, balls, by, frames.time, frames.count, shared=shared)


def _by_frame(slope: Array, frames: SegmentArrays) -> Array:
    """Return derivatives (N, T, 1, 2, P) of places as those of gaps (N, 2 T, P)."""
    return np.asarray(slope.reshape(len(slope), -1, slope.shape[-1]) / frames.sigma[:, None, None])


def settle(
    table: TableNumbers, frames: SegmentArrays, starts: Starts, q: Array, steps: int = START_STEPS
) -> BestStarts:
    """Find the starts whose simulations are nearest to the frames, descending from q (N, 7). ``steps`` 1: evaluate only at q."""
    width = 2 * frames.time.shape[1]
    gap, slope = np.zeros((len(q), width)), np.zeros((len(q), width, K))

    def residual(which: NDArray[np.int64], at: Array, derivatives: bool) -> tuple[Array, Array | None]:
        some = frames.pick(which)
        if not derivatives:
            return gaps(table, some, at), None
        found = _states(table, some, at)
        gap[which] = some.gap(found.states[:, :, 0, :2])
        slope[which] = _by_frame(found.by_start, some) * starts.free[which][:, None]
        return gap[which], slope[which]

    best, found = nearest_starts(
        residual, q, np.where(starts.free, starts.scale, 0.0), np.zeros_like(q), starts.prior, steps=steps,
        tolerance=START_TOLERANCE, dof=np.asarray(2.0 * frames.count, dtype=np.float64), joint=False,
    )  # fmt: skip
    return BestStarts(best, gap, slope, found.value)


def scan(table: TableNumbers, frames: SegmentArrays, q: Array, tried: Array) -> Array:
    """Return sums of squares (N, M) with M sidespins (N, M) instead of the starts' own."""
    n, m = tried.shape
    every = np.repeat(np.arange(n), m)
    starts = q[every]
    starts[:, SIDESPIN] = tried.ravel()
    return np.asarray(np.square(gaps(table, frames.pick(every), starts)).sum(axis=-1).reshape(n, m))


def shared_slope(model: TrackModel, frames: SegmentArrays, q: Array, numbers: Mapping[str, float]) -> Array:
    """Return the derivative (N, 2 T, P) of the gaps in the shared parameters, with the starts held."""
    table = model.table(numbers)
    names, found = [one.name for one in table.shared], _states(table, frames, q, shared=True)
    slope = _by_frame(found.by_shared, frames)
    if "spin_loss" in names:  # (which the sidespin at the start follows)
        turned = np.sign(q[:, SIDESPIN]) * _first_contacts(frames)
        slope[..., names.index("spin_loss")] += _by_frame(found.by_start, frames)[..., SIDESPIN] * turned[:, None]
    return slope[..., [names.index(name) for name in model.free]]


def projected(settled: BestStarts, starts: Starts, by_shared: Array) -> Array:
    """Return the derivatives (N, 2 T + 7, P) of gaps and prior in the shared parameters with the starts refitted."""
    prior = np.zeros((len(by_shared), K, by_shared.shape[-1]))
    return settled.projection(starts).rest(np.concatenate([by_shared, prior], axis=1))


def effective_numbers(settled: BestStarts, starts: Starts) -> float:
    """Return the effective number of parameters of the starts: the share of the frames in their information."""
    return float(np.square(settled.projection(starts).basis[:, :-K]).sum())


@dataclass(eq=False)
class _Segments:
    """Segments whose starts follow the shared parameters."""

    model: TrackModel
    frames: SegmentArrays
    starts: Starts
    q: Array
    """(N, 7): the best so far."""
    tell: Callable[[], None]
    steps: int = START_STEPS

    def numbers(self, values: Array) -> Numbers:
        return dict(zip(self.model.free, values.tolist(), strict=True))

    def tried(self, values: Array) -> tuple[float, BestStarts]:
        settled = settle(self.model.table(self.numbers(values)), self.frames, self.starts, self.q, self.steps)
        self.tell()
        return float(settled.cost.sum()), settled

    def taken(self, values: Array, tried: BestStarts) -> tuple[float, Array, Array]:
        self.q, self.steps = tried.q, NEXT_STEPS
        by_shared = shared_slope(self.model, self.frames, tried.q, self.numbers(values))
        rest = projected(tried, self.starts, by_shared)
        score = -np.einsum("ntp,nt->p", rest, tried.residual(self.starts))
        return float(tried.cost.sum()), score, np.einsum("ntp,ntr->pr", rest, rest)


def descend(
    model: TrackModel, frames: SegmentArrays, starts: Starts, q: Array, numbers: Mapping[str, float], tell: Callable[[], None],
    exact: bool = True,
) -> tuple[Numbers, BestStarts]:  # fmt: skip
    """Find the best shared parameters, and the starts that go with them."""
    if not model.free:
        return {}, settle(model.table(numbers), frames, starts, q)
    segments, dof = _Segments(model, frames, starts, q, tell), 2.0 * float(frames.count.sum())
    low, high = (np.array([getattr(one, end) for one in model.free.values()]) for end in ("low", "high"))
    values = descend_shared(
        segments, np.clip([numbers[name] for name in model.free], low, high), low, high, dof=dof,
        steps=SHARED_STEPS if exact else ROUGH_STEPS, tolerance=SHARED_TOLERANCE if exact else ROUGH_TOLERANCE * dof,
    )  # fmt: skip
    best = segments.numbers(values)
    return best, settle(model.table(best), frames, starts, segments.q)
