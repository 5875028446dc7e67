"""What is counted over all balls at one time: sums, histograms, pairs. Compiled loops over the gas's own records."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.kernel import hot_kernel

__all__ = ["SUMS", "count_pairs", "count_spread", "count_sums"]

Array = NDArray[np.float64]
# Of each species: balls, and the sums over them of v^2, v^4, w^2, w^4, and of the components of v.
SUMS = ("count", "v2", "v4", "w2", "w4", "vx", "vy", "vz")


class _Compiled(NamedTuple):
    sums: Callable[..., Any]
    spread: Callable[..., Any]
    pairs: Callable[..., Any]


@functools.cache
def _compiled() -> _Compiled:
    from carom.compiled import njit

    return _Compiled(njit(_sums), njit(_spread), njit(_pairs))


def count_sums(motions: Any, bodies: Any, kinds: int) -> Array:
    """Sums over the balls of each species, (species, 8) as SUMS has them."""
    sums = np.zeros((kinds, len(SUMS)))
    _compiled().sums(motions, bodies, sums)
    return sums


def count_spread(motions: Any, bodies: Any, axes: int, scale: Array, velocities: Any, spins: Any) -> None:
    """Add the components of velocity and spin, times ``scale`` (species, 2), to histograms (species, bins) around zero.

    In bins of width 1; a species whose scale is zero is left out. Discs have two components of velocity and one of spin.
    """
    _compiled().spread(motions, bodies, axes, scale, velocities, spins)


def count_pairs(
    x: Array, kind: Any, chosen: Any, radius: Array, side: Array, around: Any, reach: float, width: float, pairs: Any
) -> None:
    """Add to histograms (species, species, bins) the pairs of a ball in ``chosen`` and any other, by the gap between them.

    ``x`` is (N, 3), ``kind`` the species, ``chosen`` numbers of balls, ``around`` which axes are periodic. In bins of
    ``width``; ``reach`` is the largest distance of centres that is looked at, at most half of a periodic side.
    """
    # cells of at least reach; of fewer than 3 around a period all are looked at, once
    n = np.maximum((side / reach).astype(np.int64), 1)
    place = np.clip((x / (side / n)).astype(np.int64), 0, n - 1)
    cell = (place[:, 2] * n[1] + place[:, 1]) * n[0] + place[:, 0]
    order = np.argsort(cell, kind="stable")
    first = np.concatenate([[0], np.cumsum(np.bincount(cell, minlength=int(n.prod())))])
    # side by side as they lie in the cells
    rows, kinds, here = np.ascontiguousarray(x[order].T), kind[order].astype(np.int64), np.argsort(order)[chosen]
    _compiled().pairs(
        rows, kinds, here, place[chosen], radius, side, around, n, first, reach * reach, width, pairs
    )  # fmt: skip


def _sums(motions: Any, bodies: Any, sums: Any) -> None:
    for i in range(motions.shape[0]):
        ball, body = motions[i], bodies[i]
        k = ball.kind
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
def _put(histogram: Any, k: int, x: float) -> None:
    place = x + histogram.shape[1] / 2
    if 0 <= place < histogram.shape[1]:
        histogram[k, int(place)] += 1


def _spread(motions: Any, bodies: Any, axes: int, scale: Any, velocities: Any, spins: Any) -> None:
    for i in range(motions.shape[0]):
        ball, body = motions[i], bodies[i]
        k = ball.kind
        s = scale[k, 0]
        if s > 0:
            _put(velocities, k, ball.vx * s)
            _put(velocities, k, ball.vy * s)
            if axes == 3:
                _put(velocities, k, ball.vz * s)
        s = scale[k, 1]
        if s > 0:
            if axes == 3:
                _put(spins, k, body.wx * s)
                _put(spins, k, body.wy * s)
            _put(spins, k, body.wz * s)


@hot_kernel
def _least(r: float, side: float, periodic: bool) -> float:
    if not periodic:
        return r
    if r > side / 2:
        return r - side
    return r + side if r < -side / 2 else r


def _pairs(
    x: Any, kind: Any, chosen: Any, place: Any, radius: Any, side: Any, around: Any, n: Any, first: Any, reach2: float,
    width: float, pairs: Any,
) -> None:  # fmt: skip
    bins = pairs.shape[2]
    low, high = np.zeros(3, np.int64), np.zeros(3, np.int64)
    for k in range(chosen.shape[0]):
        i = chosen[k]
        for axis in range(3):
            low[axis], high[axis] = place[k, axis] - 1, place[k, axis] + 1
            if around[axis] and n[axis] < 3:
                low[axis], high[axis] = 0, n[axis] - 1
            elif not around[axis]:
                low[axis], high[axis] = max(low[axis], 0), min(high[axis], n[axis] - 1)
        for cz in range(low[2], high[2] + 1):
            for cy in range(low[1], high[1] + 1):
                for cx in range(low[0], high[0] + 1):
                    cell = ((cz % n[2]) * n[1] + cy % n[1]) * n[0] + cx % n[0]
                    for j in range(first[cell], first[cell + 1]):
                        rx = _least(x[0, i] - x[0, j], side[0], around[0])
                        ry = _least(x[1, i] - x[1, j], side[1], around[1])
                        rz = _least(x[2, i] - x[2, j], side[2], around[2])
                        r2 = rx * rx + ry * ry + rz * rz
                        if r2 < reach2 and j != i:
                            gap = math.sqrt(r2) - (radius[kind[i]] + radius[kind[j]])
                            bin_ = max(int(gap / width), 0)
                            if bin_ < bins:
                                pairs[kind[i], kind[j], bin_] += 1
