"""Periodic orbits of a point particle among discs by their codes, apart from carom: the shortest closed polygon, and its stability.

The monodromy is the product of flights and reflections: (1, l; 0, 1) and (1, 0; 2/(a cos phi), 1) up to a sign.
"""

from __future__ import annotations

import math

import numpy as np
from scipy.optimize import minimize

__all__ = ["codes", "shortest"]


def codes(letters: str, period: int) -> list[str]:
    """Return the prime codes of a length in which no letter follows itself, each once up to where it begins."""
    found = set()

    def longer(word: str) -> None:
        if len(word) == period:
            turns = [word[k:] + word[:k] for k in range(period)]
            if word[0] != word[-1] and len(set(turns)) == period:
                found.add(min(turns))
            return
        for one in letters:
            if not word or one != word[-1]:
                longer(word + one)

    longer("")
    return sorted(found)


def shortest(centres: np.ndarray, a: float, code: list[int]) -> tuple[float, float]:
    """Return the length of the shortest closed polygon that touches discs of radius a in turn, and its multiplier."""
    c = centres[code]
    near = np.roll(c, 1, 0) + np.roll(c, -1, 0) - 2 * c

    def points(angle: np.ndarray) -> np.ndarray:
        return c + a * np.stack([np.cos(angle), np.sin(angle)], -1)

    def length(angle: np.ndarray) -> float:
        x = points(angle)
        return float(np.linalg.norm(np.roll(x, -1, 0) - x, axis=1).sum())

    def slope(angle: np.ndarray) -> np.ndarray:
        x = points(angle)
        u = np.roll(x, -1, 0) - x
        u /= np.linalg.norm(u, axis=1, keepdims=True)
        along = a * np.stack([-np.sin(angle), np.cos(angle)], -1)
        return np.asarray(((np.roll(u, 1, 0) - u) * along).sum(1))

    found = minimize(length, np.arctan2(near[:, 1], near[:, 0]), jac=slope, method="BFGS", options={"gtol": 1e-13})
    x = points(found.x)
    step = np.roll(x, -1, 0) - x
    flights = np.linalg.norm(step, axis=1)
    cos = (step / flights[:, None] * (x - c) / a).sum(1)
    matrix = np.eye(2)
    for k in range(len(code)):
        after = (k + 1) % len(code)
        turn = np.array([[1.0, 0.0], [2.0 / (a * cos[after]), 1.0]])
        matrix = -turn @ np.array([[1.0, flights[k]], [0.0, 1.0]]) @ matrix
    half = matrix.trace() / 2
    return float(flights.sum()), float(half + math.copysign(math.sqrt(half * half - 1), half))
