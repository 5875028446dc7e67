"""A point particle among round discs on a triangular lattice, apart from carom: mean squares of displacements in NumPy.

Discs have radius 1 and gaps w: the lattice spacing is 2 + w. Below w = 4/sqrt(3) - 2 = 0.3094 every flight is bounded.
"""

from __future__ import annotations

import math

import numpy as np

__all__ = ["machta_zwanzig", "measured_diffusion"]

NEAREST = 4  # lattice steps in which a flight ends


def machta_zwanzig(w: float) -> float:
    """Return the diffusion coefficient of hops that forget all (Machta & Zwanzig, Phys. Rev. Lett. 50, 1959 (1983))."""
    spacing = 2.0 + w
    return w * spacing**2 / (math.pi * (math.sqrt(3.0) * spacing**2 - 2.0 * math.pi))


def measured_diffusion(w: float, particles: int, windows: int, window: float, seed: int = 0) -> tuple[float, float]:
    """Return the diffusion coefficient from the growth of mean squares between one window of time and two, and its error."""
    rng = np.random.default_rng(seed)
    spacing = 2.0 + w
    a, b = np.array([spacing, 0.0]), np.array([spacing / 2, spacing * math.sqrt(3.0) / 2])
    steps = [i * a + j * b for i in range(-NEAREST, NEAREST + 1) for j in range(-NEAREST, NEAREST + 1) if i or j]
    others = np.array([one for one in steps if np.hypot(*one) < NEAREST * spacing])
    angle, out = rng.uniform(0, 2 * math.pi, particles), np.arcsin(rng.uniform(-1, 1, particles))
    centre = np.zeros((particles, 2))  # of the disc that was met last
    x = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    v = np.stack([np.cos(angle + out), np.sin(angle + out)], axis=-1)
    clock, total = np.zeros(particles), 2 * window * windows
    marks = np.arange(2 * windows + 1) * window
    seen = np.full((particles, len(marks), 2), np.nan)
    seen[:, 0] = x
    row = np.arange(particles)
    while clock.min() < total:
        # from the place x to each disc of the neighbourhood: |x + v t - c| = 1
        d = x[:, None] - centre[:, None] - others
        along = np.einsum("nkj,nj->nk", d, v)
        under = along**2 - ((d**2).sum(-1) - 1.0)
        t = np.where((under > 0) & (along < 0), -along - np.sqrt(np.maximum(under, 0.0)), np.inf)
        which = t.argmin(1)
        t = t[row, which]
        for k in range(int(clock.min() // window), len(marks)):
            here = (clock < marks[k]) & (marks[k] <= clock + t)
            seen[here, k] = x[here] + v[here] * (marks[k] - clock[here])[:, None]
            if marks[k] > (clock + t).max():
                break
        x = x + v * t[:, None]
        clock = clock + t
        centre = centre + others[which]
        n = x - centre
        n /= np.linalg.norm(n, axis=1, keepdims=True)
        x = centre + n
        v = v - 2 * (v * n).sum(1, keepdims=True) * n
    step = np.diff(seen, axis=1)
    one = (step**2).sum(-1).reshape(particles, windows, 2).mean(-1)
    two = ((step[:, 0::2] + step[:, 1::2]) ** 2).sum(-1)
    each = ((two - one) / (4 * window)).mean(1)
    return float(each.mean()), float(each.std(ddof=1) / math.sqrt(particles))
