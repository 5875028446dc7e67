"""First contacts of a ball with a curve by brute force: small steps of its path, distances by Newton's method.

Independent of carom: curves of :mod:`reference.curves`, and any curve with places and two derivatives.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from reference.curves import depth

__all__ = ["Backwards", "drawn_flights", "first_contact", "is_inside"]

Array = Any


@dataclass(frozen=True)
class Backwards:
    """A curve the other way round: the ball is on its other side."""

    of: Any

    def span(self) -> tuple[float, float]:
        first, last = self.of.span()
        return -last, -first

    def at(self, t: Array) -> tuple[Array, Array, Array]:
        x, d, dd = self.of.at(-np.asarray(t))
        return x, -d, dd


def is_inside(curve: Any, x: Array, nodes: int = 2000) -> Array:
    """Return whether points (N, 2) are inside a closed curve: the sides of a polygon to their right are odd in number."""
    p = curve.at(np.linspace(0, 2 * np.pi, nodes + 1))[0]
    (x0, y0), (x1, y1) = p[:-1].T, p[1:].T
    px, py = x[:, :1], x[:, 1:]
    crossed = (y0 > py) != (y1 > py)
    with np.errstate(all="ignore"):
        right = px < x0 + (py - y0) * (x1 - x0) / (y1 - y0)
    return (crossed & right).sum(axis=1) % 2 == 1


def first_contact(curve: Any, a: float, x: Array, v: Array, g: Array, end: float, steps: int = 250) -> float:
    """Return when the centre of a ball of radius a first comes so near to the curve, to 1e-9 of the end, or infinity."""

    def gap(t: Array) -> Array:
        return depth(curve, x + np.outer(t, v) + np.outer(t * t / 2, g)) - a

    low, high = 0.0, end
    for _ in range(5):
        t = np.linspace(low, high, steps)
        below = np.flatnonzero(gap(t)[1:] < 0)
        if not len(below):
            return math.inf
        low, high = t[below[0]], t[below[0] + 1]
    return (low + high) / 2


def drawn_flights(curve: Any, rng: Any, count: int, inside: bool) -> list[tuple[float, Array, Array, Array]]:
    """Draw balls that touch nothing, from a hundredth of a curve of size 1 to its size: radius, place, velocity, acceleration."""
    found = []
    while len(found) < count:
        a, x, v = float(10 ** rng.uniform(-2, 0)), rng.uniform(-2, 2, size=2), rng.normal(size=2)
        if is_inside(curve, x[None])[0] != inside or depth(curve, x[None])[0] < 1.0001 * a:
            continue
        g = rng.normal(size=2) * rng.choice([0.0, 0.1, 1.0])
        if not inside and rng.random() < 0.8:
            v = -x + 0.4 * rng.normal(size=2)
        found.append((a, x, v, g))
    return found
