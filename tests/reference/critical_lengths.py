"""Periodic orbits of a mirror billiard as critical points of the length of a polygon inscribed in its boundary.

Independent of carom: points on the boundary are given by one number each, and the gradient of the length is set to zero by a
library's root finder from many starts.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from scipy.optimize import root

__all__ = ["critical_lengths"]


def critical_lengths(curve: Callable[[Any], tuple[Any, Any]], period: int, starts: int, seed: int = 0) -> list[float]:
    """Return the lengths of the polygons with p corners whose length is stationary, each once, in ascending order.

    ``curve(u)``: point (2, ...) and derivative (2, ...) of a smooth closed convex curve with period 2 pi.
    """
    rng = np.random.default_rng(seed)

    def gradient(u: Any) -> Any:
        x, dx = curve(u)
        chord = np.roll(x, -1, axis=1) - x
        unit = chord / np.maximum(np.linalg.norm(chord, axis=0), 1e-300)
        return ((np.roll(unit, 1, axis=1) - unit) * dx).sum(0)

    found: list[float] = []
    for k in range(starts):
        guess = rng.uniform(0, 2 * np.pi, period)
        solved = root(gradient, np.sort(guess) if k % 2 else guess, tol=1e-13)
        if not solved.success or np.abs(solved.fun).max() > 1e-11:
            continue
        x, _dx = curve(solved.x)
        chords = np.linalg.norm(np.roll(x, -1, axis=1) - x, axis=0)
        divisors = [d for d in range(1, period) if period % d == 0]
        repeats = any(np.abs(np.roll(x, -d, axis=1) - x).max() < 1e-6 for d in divisors)
        length = float(chords.sum())
        if chords.min() > 1e-3 and not repeats and all(abs(length - one) > 1e-7 for one in found):
            found.append(length)
    return sorted(found)
