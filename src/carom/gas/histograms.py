"""Sums, component histograms and pair histograms over the balls of a gas: compiled loops over the engine's records."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.core.jit.kernel import hot_kernel
from carom.gas.sizes import cells_at_most

__all__ = ["SUMS", "add_component_histograms", "add_pair_histograms", "compiled_loops", "species_sums"]

Array = NDArray[np.float64]
# Of each species: the number of balls, and the sums of v^2, v^4, w^2, w^4, and of the components of v.
SUMS = ("count", "v2", "v4", "w2", "w4", "vx", "vy", "vz")


class _CompiledCounts(NamedTuple):
    sums: Callable[..., Any]
    spread: Callable[..., Any]
    pairs: Callable[..., Any]


@functools.cache
def compiled_loops() -> _CompiledCounts:
    """Return the compiled sums and histograms."""
    from carom.core.jit.compile import njit

    return _CompiledCounts(
        *(njit(loop, nogil=True) for loop in (_species_sums, _component_histograms, _pair_histogram))
    )


def species_sums(motions: Any, bodies: Any, kinds: int) -> Array:
    """Return sums over the balls of each species, (species, 8), in the order of SUMS."""
    sums = np.zeros((kinds, len(SUMS)))
    compiled_loops().sums(motions, bodies, sums)
    return sums


def add_component_histograms(motions: Any, bodies: Any, axes: int, scale: Array, velocities: Any, spins: Any) -> None:
    """Add the components of velocity and spin, times ``scale`` (species, 2), to histograms (species, bins) centred on zero.

    The bins have width 1; a species with scale zero is skipped. Discs have two components of velocity and one of spin.
    """
    compiled_loops().spread(motions, bodies, axes, scale, velocities, spins)


def add_pair_histograms(
    x: Array, kind: Any, chosen: Any, radius: Array, side: Array, periodic: Any, reach: float, width: float, pairs: Any
) -> None:
    """Add the pairs of a ball in ``chosen`` and any other to histograms (species, species, bins) of the gap between them.

    ``x`` is (N, 3), ``kind`` the species, ``chosen`` indices of balls, ``periodic`` by axis. The bins have a ``width``; ``reach``
    is the largest distance of centres that is counted, at most half of a periodic side.
    """
    # cells of at least reach; of fewer than 3 along a periodic axis all are searched, once
    n = np.array(cells_at_most((side / reach).tolist(), len(x)), np.int64)
    place = np.clip((x / (side / n)).astype(np.int64), 0, n - 1)
    cell = (place[:, 2] * n[1] + place[:, 1]) * n[0] + place[:, 0]
    order = np.argsort(cell, kind="stable")
    first = np.concatenate([[0], np.cumsum(np.bincount(cell, minlength=int(n.prod())))])
    # sorted by cell
    rows, kinds, here = np.ascontiguousarray(x[order].T), kind[order].astype(np.int64), np.argsort(order)[chosen]
    compiled_loops().pairs(
        rows, kinds, here, place[chosen], radius, side, periodic, n, first, reach * reach, width, pairs,
        np.zeros(3, np.int64), np.zeros(3, np.int64),
    )  # fmt: skip


def _species_sums(motions: Any, bodies: Any, sums: Any) -> None:
    for i in range(motions.shape[0]):
        ball, body = motions[i], bodies[i]
        k = ball.species
        v = ball.vx * ball.vx + ball.vy * ball.vy + ball.vz * ball.vz
        w = body.wx * body.wx + body.wy * body.wy + body.wz * body.wz
        sums[k, 0] += 1
        sums[k, 1] += v
        sums[k, 2] += v * v
        sums[k, 3] += w
        sums[k, 4] += w * w
        sums[k, 5] += ball.vx
        sums[k, 6] += ball.vy
        sums[k, 7] += ball.vz


@hot_kernel
def _count_value(histogram: Any, k: int, x: float) -> None:
    """Count x in row k of a histogram with bins of width 1 centred on zero."""
    place = x + histogram.shape[1] / 2
    if 0 <= place < histogram.shape[1]:
        histogram[k, int(place)] += 1


def _component_histograms(motions: Any, bodies: Any, axes: int, scale: Any, velocities: Any, spins: Any) -> None:
    for i in range(motions.shape[0]):
        ball, body = motions[i], bodies[i]
        k = ball.species
        s = scale[k, 0]
        if s > 0:
            _count_value(velocities, k, ball.vx * s)
            _count_value(velocities, k, ball.vy * s)
            if axes == 3:
                _count_value(velocities, k, ball.vz * s)
        s = scale[k, 1]
        if s > 0:
            if axes == 3:
                _count_value(spins, k, body.wx * s)
                _count_value(spins, k, body.wy * s)
            _count_value(spins, k, body.wz * s)


@hot_kernel
def _nearest_image(r: float, side: float, periodic: bool) -> float:
    """Return a coordinate difference, between nearest images if the axis is periodic."""
    if not periodic:
        return r
    if r > side / 2:
        return r - side
    return r + side if r < -side / 2 else r


def _pair_histogram(
    x: Any, kind: Any, chosen: Any, place: Any, radius: Any, side: Any, periodic: Any, n: Any, first: Any, reach2: float,
    width: float, pairs: Any, low: Any, high: Any,
) -> None:  # fmt: skip
    """Count pairs; ``low`` and ``high`` (3,) are room for the cells around one."""
    bins = pairs.shape[2]
    for k in range(chosen.shape[0]):
        i = chosen[k]
        for axis in range(3):
            low[axis], high[axis] = place[k, axis] - 1, place[k, axis] + 1
            if periodic[axis] and n[axis] < 3:
                low[axis], high[axis] = 0, n[axis] - 1
            elif not periodic[axis]:
                low[axis], high[axis] = max(low[axis], 0), min(high[axis], n[axis] - 1)
        for cz in range(low[2], high[2] + 1):
            for cy in range(low[1], high[1] + 1):
                for cx in range(low[0], high[0] + 1):
                    cell = ((cz % n[2]) * n[1] + cy % n[1]) * n[0] + cx % n[0]
                    for j in range(first[cell], first[cell + 1]):
                        rx = _nearest_image(x[0, i] - x[0, j], side[0], periodic[0])
                        ry = _nearest_image(x[1, i] - x[1, j], side[1], periodic[1])
                        rz = _nearest_image(x[2, i] - x[2, j], side[2], periodic[2])
                        r2 = rx * rx + ry * ry + rz * rz
                        if r2 < reach2 and j != i:
                            gap = math.sqrt(r2) - (radius[kind[i]] + radius[kind[j]])
                            bin_ = max(int(gap / width), 0)
                            if bin_ < bins:
                                pairs[kind[i], kind[j], bin_] += 1
