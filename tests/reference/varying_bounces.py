"""Bounces of a ball in the air whose parameters depend on the impact, by formulas of their own.

Walton's three regimes are written out here from the momentum balance along and across the wall; nothing is taken from carom.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

RADIUS, KAPPA = 0.02, 2 / 3
Of = Callable[[Any], Any]


def bounce(v_n: Any, v_t: Any, spin: Any, e: Any, mu: Any, beta: Any) -> tuple[Any, Any, Any]:
    """Return v_n, v_t and spin after the wall: the tangential impulse that reverses a share beta of the slip, within friction."""
    slip = v_t - RADIUS * spin
    wanted = (1 + beta) * KAPPA / (1 + KAPPA) * np.abs(slip)
    impulse = np.minimum(wanted, mu * (1 + e) * v_n) * np.sign(slip)
    return e * v_n, v_t - impulse, spin + impulse / (KAPPA * RADIUS)


def drawn_table(
    rows: int, seed: int, e: Of, mu: Of, beta: Of, sigma: float = 0.05, bars: bool = True, noise: str = "normal"
) -> dict[str, Any]:
    """Return columns of a table of rebounds: e of v_n, mu of the slip, beta of slip/v_n, with errors of size sigma (m/s)."""
    rng = np.random.default_rng(seed)
    v_n, v_t, spin = rng.uniform(3, 10, rows), rng.uniform(-3, 3, rows), rng.uniform(-400, 400, rows)
    slip = np.abs(v_t - RADIUS * spin)
    after = bounce(v_n, v_t, spin, e(v_n), mu(slip), beta(slip / v_n))
    size = sigma * np.ones(rows)
    if noise == "grows":
        size = sigma * (v_n / 6) ** 1.5
    draw = {
        "normal": rng.normal, "grows": rng.normal, "student": lambda size: rng.standard_t(3, size) / np.sqrt(3),
        "laplace": lambda size: rng.laplace(size=size) / np.sqrt(2),
    }[noise]  # fmt: skip
    errors = draw(size=(3, rows)) * size
    columns = {"v_n_in": v_n, "v_t_in": v_t, "spin_in": spin, "v_n_out": after[0] + errors[0], "v_t_out": after[1] + errors[1],
               "spin_out": after[2] + errors[2] / RADIUS}  # fmt: skip
    if bars:
        columns |= {"sigma_v_n_out": sigma, "sigma_v_t_out": sigma, "sigma_spin_out": sigma / RADIUS}
    return columns
