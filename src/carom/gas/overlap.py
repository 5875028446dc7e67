"""Which balls of a start overlap: by cells, in NumPy, so that a million balls take a second and nothing is compiled."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = ["first_overlap"]

Array = NDArray[np.float64]


def first_overlap(one: Any, radius: Array, x: Array, touch: float) -> tuple[int, int] | None:
    """The first pair (i < j) whose centres are nearer than their radii by more than ``touch`` of the smaller; None: none."""
    n, side, periodic = one["cells"], one["side"], one["periodic"] == 1
    place = np.clip((np.where(periodic, x % side, x) / one["size"]).astype(np.int64), 0, n - 1)
    key = place @ np.array([1, n[0], n[0] * n[1]])
    order = np.argsort(key, kind="stable")
    keys = key[order]
    worst: tuple[int, int] | None = None
    steps = [(a, b, c) for a in (-1, 0, 1) for b in (-1, 0, 1) for c in ((-1, 0, 1) if one["axes"] == 3 else (0,))]
    for step in steps:
        there = place + step
        inside = (periodic | ((there >= 0) & (there < n))).all(axis=1)
        rows = np.flatnonzero(inside)
        wanted = (there[rows] % n) @ np.array([1, n[0], n[0] * n[1]])
        first, last = np.searchsorted(keys, wanted), np.searchsorted(keys, wanted, side="right")
        for k in range(int((last - first).max(initial=0))):
            here = first + k < last
            i, j = rows[here], order[(first + k)[here]]
            r = x[i] - x[j]
            r -= np.where(periodic, side * np.round(r / side), 0)
            reach = radius[i] + radius[j] - touch * np.minimum(radius[i], radius[j])
            bad = (i < j) & ((r * r).sum(axis=1) < reach * reach)
            if bad.any():
                at = np.flatnonzero(bad)
                found = min(zip(i[at].tolist(), j[at].tolist(), strict=True))
                worst = found if worst is None else min(worst, found)
    return worst
