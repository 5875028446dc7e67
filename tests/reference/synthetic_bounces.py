"""Bounces in the plane whose truth is known, with noise on everything, as columns of a table of rebounds."""

from __future__ import annotations

import numpy as np

import carom
from carom.fitting import Setting

A, KAPPA = 0.02, 2 / 3
BALL = carom.Ball(radius=A, mass=0.0027, inertia="hollow")
SETTING = Setting(radius=A, kappa=KAPPA)
TRUTH = {"restitution": 0.8, "friction": 0.2, "tangential_restitution": 0.3, "spin_mean": 0.4, "spin_width": 0.35}
NAMES = ("v_n_in", "v_t_in", "spin_in", "v_n_out", "v_t_out", "spin_out")


def bounces(
    seed: int, n: int, sigma_v: float, sigma_spin: float, unknown: bool, spin_seen: bool = False
) -> dict[str, np.ndarray]:
    """Columns of n bounces in the plane with :data:`TRUTH`, and with noise; ``unknown`` spins are not measured, or only after."""
    rng = np.random.default_rng(seed)
    vn, vt = rng.uniform(1, 4, n), rng.uniform(-3, 3, n)
    mean = TRUTH["spin_mean"] if unknown else 0.0
    spin = mean * vt / A + TRUTH["spin_width"] * np.hypot(vn, vt) / A * rng.normal(size=n)
    zero = np.zeros(n)
    state = carom.State(np.stack([-vn, vt, zero], -1), np.stack([zero, zero, spin], -1))
    beta = 0.0 if unknown else TRUTH["tangential_restitution"]
    after = carom.impact(BALL, state, surface=carom.Surface(TRUTH["restitution"], TRUTH["friction"], beta)).after
    columns = {}
    true = (vn, vt, spin, after.velocity[:, 0], after.velocity[:, 1], after.spin[:, 2])
    for name, values in zip(NAMES, true, strict=True):
        sigma = sigma_spin if "spin" in name else sigma_v
        columns[name] = values + sigma * rng.normal(size=n)
        columns[f"sigma_{name}"] = np.full(n, sigma)
    for name in ("spin_in", "spin_out") if not spin_seen else ("spin_in",):
        if unknown:
            columns[name] = np.full(n, np.nan)
    return columns


SIGMA = {"v": 0.02, "spin": 2.0}


def measured_bounces(
    seed: int,
    n: int,
    e: float = 0.8,
    mu: float = 0.2,
    beta: float = 0.3,
    slip: float = 3.0,
    noise: float = 1.0,
    spins: float = 60.0,
):
    """Planar bounces by `carom.impact` itself, in the frame of the wall (1, 0, 0), with noise on everything."""
    rng = np.random.default_rng(seed)
    vn, spin = rng.uniform(1, 4, n), rng.uniform(-spins, spins, n)
    vt = rng.uniform(-slip, slip, n)
    zero = np.zeros(n)
    ball = carom.Ball(radius=A, mass=0.0027, inertia="hollow")
    state = carom.State(np.stack([-vn, vt, zero], axis=-1), np.stack([zero, zero, spin], axis=-1))
    after = carom.impact(ball, state, surface=carom.Surface(e, mu, beta)).after
    true = [vn, vt, spin, after.velocity[:, 0], after.velocity[:, 1], after.spin[:, 2]]
    names = ("v_n_in", "v_t_in", "spin_in", "v_n_out", "v_t_out", "spin_out")
    columns = {}
    for name, values in zip(names, true, strict=True):
        sigma = SIGMA["spin" if "spin" in name else "v"]
        columns[name] = values + noise * sigma * rng.normal(size=n)
        columns[f"sigma_{name}"] = np.full(n, sigma)
    return columns
