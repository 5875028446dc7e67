"""Initial states of a gas: where the balls are, and how they move."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

__all__ = ["lattice", "thermal"]

Array = NDArray[np.float64]


def lattice(count: int, side: tuple[float, ...], margin: float = 0.0) -> Array:
    """Centres (count, 3) on a face-centred cubic lattice, or in 2-D (``side`` of two numbers) on a centred square one.

    The lattice is stretched to fill the box, less a margin at each side, and of its places ``count`` are taken, spread evenly.
    """
    inner = np.array(side, dtype=float) - 2 * margin
    basis = [(0, 0, 0), (1, 1, 0), (1, 0, 1), (0, 1, 1)] if len(inner) == 3 else [(0, 0), (1, 1)]
    # as many steps an axis as make the cells nearly cubic and the places enough
    step = (inner.prod() * len(basis) / count) ** (1 / len(inner))
    steps = np.maximum(np.round(inner / step), 1).astype(int)
    while steps.prod() * len(basis) < count:
        steps[np.argmax(inner / steps)] += 1
    corners = np.stack(np.meshgrid(*(np.arange(n) for n in steps), indexing="ij"), axis=-1).reshape(-1, 1, len(inner))
    places = ((corners + (np.array(basis) + 0.5) / 2) / steps).reshape(-1, len(inner))
    taken = places[(np.arange(count) * len(places)) // count]
    centres = np.zeros((count, 3))
    centres[:, : len(inner)] = margin + taken * inner
    return centres


def thermal(mass: Array, axes: tuple[int, ...], temperature: float, rng: np.random.Generator) -> Array:
    """Vectors (N, 3) with normal components along ``axes``, no sum of mass times vector, and mean m v^2 / 2 of T / 2 an axis."""
    found = np.zeros((len(mass), 3))
    if temperature == 0 or len(mass) == 0:
        return found
    v = rng.normal(size=(len(mass), len(axes))) / np.sqrt(mass)[:, None]
    if len(mass) > 1:
        v -= (mass[:, None] * v).sum(axis=0) / mass.sum()
    found[:, axes] = v * math.sqrt(temperature * len(mass) * len(axes) / (mass[:, None] * v * v).sum())
    return found
