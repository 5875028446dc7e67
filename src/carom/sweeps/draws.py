"""Random numbers by counting: the number at a point of a sweep follows from the seed, the parameter and the point's index alone."""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.core.geometry.circles import directions
from carom.core.random import normals, uniform

Array = NDArray[np.float64]
# Marsaglia's polar method takes 1.27 tries on average; with 64 counts for each point the chance that they do not suffice is 1e-43.
TRIES = 64


def _uniform(seed: int, key: int, first: int, low: float, high: float, out: Any) -> None:
    for k in range(out.shape[0]):
        out[k] = low + (high - low) * uniform(seed, key, first + k)


def _normal(seed: int, key: int, first: int, mean: float, deviation: float, out: Any) -> None:
    for k in range(out.shape[0]):
        x, _y, _n = normals(seed, key, (first + k) * TRIES)
        out[k] = mean + deviation * x


@functools.cache
def _compiled(loop: Callable[..., None]) -> Callable[..., None]:
    from carom.core.jit.compile import njit

    return njit(loop)


def uniform_draws(seed: int, key: int, first: int, count: int, low: float, high: float) -> Array:
    """Return (count,) uniform numbers in [low, high] of the points first, first + 1, ..."""
    out = np.empty(count)
    _compiled(_uniform)(seed, key, first, low, high, out)
    return out


def normal_draws(seed: int, key: int, first: int, count: int, mean: float, deviation: float) -> Array:
    """Return (count,) normal numbers of the points first, first + 1, ..."""
    out = np.empty(count)
    _compiled(_normal)(seed, key, first, mean, deviation, out)
    return out


def polar_rows(speed: Array, angle: Array) -> Array:
    """Return (count, 3) vectors in the plane z = 0, of a length and an angle in degrees, the same bits on every machine."""
    x, y = directions(angle).T
    return np.stack([speed * x, speed * y, np.zeros(len(speed))], axis=1)
