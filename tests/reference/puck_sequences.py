"""Air hockey: a disc slides without friction between the walls of a rectangle; its spin is never seen. And its likelihood, by sums.

The disc meets a wall with restitution e and friction mu, in the plane: the slip of its rim is v_t - a w, t = z x n with n away from
the wall, and w changes by (v_t - v_t') / (kappa a). Between walls nothing changes. Speeds are measured with errors.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
RADIUS, KAPPA = 0.0316, 0.5
WIDTH, LENGTH = 1.0, 2.0
WALLS = {(1, 0): 0.0, (-1, 0): -WIDTH, (0, 1): 0.0, (0, -1): -LENGTH}  # inward normals, and place along them
SPIN = 0.5  # v/a: standard deviation of the spins with which discs are struck


def contact(v_n: float, v_t: float, spin: float, e: float, mu: float, beta: float) -> tuple[float, float, float]:
    """v_n, v_t and spin after a wall."""
    slip = v_t - RADIUS * spin
    impulse = math.copysign(min(mu * (1 + e) * v_n, (1 + beta) * abs(slip) * KAPPA / (1 + KAPPA)), slip)
    return e * v_n, v_t - impulse, spin + impulse / (KAPPA * RADIUS)


def struck(rng: np.random.Generator, e: float, mu: float, beta: float, bounces: int) -> list[list[float]]:
    """One disc's bounces: v_n, v_t, spin before; v_n, v_t, spin after."""
    place = np.array([rng.uniform(0.2, WIDTH - 0.2), rng.uniform(0.3, LENGTH - 0.3)])
    angle, speed = rng.uniform(0, 2 * math.pi), rng.uniform(1.5, 4.0)
    v = speed * np.array([math.cos(angle), math.sin(angle)])
    spin, found = rng.normal(0, SPIN) * speed / RADIUS, []
    while len(found) < bounces:
        times = {}
        for n, at in WALLS.items():
            toward = -float(v @ n)
            if toward > 0:
                times[n] = (float(place @ n) - at - RADIUS) / toward
        n = min(times, key=times.__getitem__)
        place = place + max(times[n], 0.0) * v
        normal, along = np.array(n, float), np.array([-n[1], n[0]], float)
        before = (-float(v @ normal), float(v @ along), spin)
        after = contact(*before, e, mu, beta)
        v, spin = after[0] * normal + after[1] * along, after[2]
        found.append([*before, *after])
    return found


def table(
    seed: int,
    e: float = 0.75,
    mu: float = 0.15,
    beta: float = 0.0,
    shots: int = 5,
    bounces: int = 5,
    sigma: float = 0.02,
    spins: bool = False,
) -> dict[str, Array]:
    """Columns of a table of rebounds: spins are left out, or (``spins``) known."""
    rng = np.random.default_rng(seed)
    rows = [(shot, k + 1, *row) for shot in range(shots) for k, row in enumerate(struck(rng, e, mu, beta, bounces))]
    made = np.array(rows)
    columns: dict[str, Array] = {"shot": made[:, 0].astype(int), "bounce": made[:, 1].astype(int)}
    for i, name in ((2, "v_n_in"), (3, "v_t_in"), (5, "v_n_out"), (6, "v_t_out")):
        columns |= {name: made[:, i] + sigma * rng.normal(size=len(made)), f"sigma_{name}": np.full(len(made), sigma)}
    columns["spin_in"] = made[:, 4] if spins else np.full(len(made), np.nan)
    # (contacts that graze the wall are not measured; the next one of the disc is then no known bounce's successor)
    return {name: column[made[:, 2] > 5 * sigma] for name, column in columns.items()}


def deviance(
    rows: Array, sigma: float, e: float, mu: float, beta: float, mean: float, width: float, points: int = 20001
) -> float:
    """-2 log of the density of one disc's speeds after its walls, those before being exact: the sum over its first spin.

    ``rows`` (n, 4): v_n, v_t before, v_n, v_t after. The spin before the first wall is normal about mean v_t/a with width v/a. In
    units of the error bar: a factor 1/(sigma (2 pi)^1/2) for each measured number is left out.
    """
    v = math.hypot(rows[0, 0], rows[0, 1])
    z = np.linspace(-8, 8, points)
    total = np.empty(points)
    for i, one in enumerate(z.tolist()):
        spin, c = (mean * rows[0, 1] + one * width * v) / RADIUS, 0.0
        for v_n, v_t, y_n, y_t in rows.tolist():
            u_n, u_t, spin = contact(v_n, v_t, spin, e, mu, beta)
            c += ((y_n - u_n) ** 2 + (y_t - u_t) ** 2) / sigma**2
        total[i] = -0.5 * c - 0.5 * one * one
    top = total.max()
    return -2 * (top + math.log(np.exp(total - top).sum() * (z[1] - z[0]) / math.sqrt(2 * math.pi)))
