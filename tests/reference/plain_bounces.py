"""Bounces in the plane from the impulse's closed form, with nothing of carom: what fits say of them can be counted.

The wall pushes with P_n = (1 + e) v_n along its normal and takes P_t = min(kappa/(1 + kappa) (1 + beta) |u|, mu P_n) of the slip
u = v_t - a w, per unit of mass; the spin gains P_t / (kappa a).
"""

from __future__ import annotations

import numpy as np

A, KAPPA = 0.02, 0.4
Columns = dict[str, np.ndarray]


def after(vn, vt, spin, e, mu, beta=0.0):
    """Return v_n, v_t, spin after the wall, and the friction below which the row would slide to its end."""
    u, pn = vt - A * spin, (1 + e) * vn
    grip = KAPPA / (1 + KAPPA) * (1 + beta) * np.abs(u)
    pt = np.sign(u) * np.minimum(grip, mu * pn)
    return e * vn, vt - pt, spin + pt / (KAPPA * A), grip / pn


def before(rng, n: int, mean: float, width: float):
    """Return v_n, v_t and spin of n balls; the spin about ``mean`` v_t/a with a ``width`` in v/a."""
    vn, vt = rng.uniform(2, 6, n), rng.uniform(-3, 3, n)
    return vn, vt, (mean * vt + width * np.hypot(vn, vt) * rng.normal(size=n)) / A


def holding(seed: int, n: int, sigma: float = 0.003) -> tuple[Columns, float]:
    """Return a table of n bounces of which none slides and no spin is measured, and the friction that all hold at."""
    rng = np.random.default_rng([seed, n, 91])
    e, mu = rng.uniform(0.6, 0.9), rng.uniform(0.4, 1.0)
    mean, width = rng.uniform(-0.2, 0.6), rng.uniform(0.1, 0.4)
    needed = np.array([np.inf])
    while needed.max() >= mu:
        vn, vt, spin = before(rng, n, mean, width)
        needed = after(vn, vt, spin, e, mu)[3]
    columns = measured(rng, (vn, vt, spin), e, mu, 0.0, sigma)
    return columns, float(needed.max())


def measured(rng, state, e: float, mu: float, beta: float, sigma: float, spins: bool = False) -> Columns:
    """Return a table of bounces of balls with a state before the wall, with error bars after it; spins measured or not at all."""
    out = after(*state, e, mu, beta)
    columns = dict(zip(("v_n_in", "v_t_in", "spin_in")[: 2 + spins], state, strict=False))
    sizes = {"v_n_out": sigma, "v_t_out": sigma} | ({"spin_out": sigma / A} if spins else {})
    for (name, size), true in zip(sizes.items(), out, strict=False):
        columns |= {name: true + size * rng.normal(size=len(true)), f"sigma_{name}": np.full(len(true), size)}
    return columns


def mixed(seed: int, n: int, friction: float | None = None, sigma: float = 0.01) -> tuple[Columns, dict[str, float]]:
    """Return a table of n bounces with unmeasured spins that are not normal: half of the balls run along the wall, the others have
    little or any spin; and the truth, which slides."""
    rng = np.random.default_rng([seed, n, 87])
    truth = {"restitution": rng.uniform(0.7, 0.9), "friction": rng.uniform(0.1, 0.25), "tangential_restitution": 0.0}
    truth["friction"] = friction or truth["friction"]
    kind, state = rng.random(n), before(rng, n, 0.0, 0.02)
    spin = np.where(kind < 0.5, 0.98 * state[1] / A, np.where(kind < 0.8, 0.0, rng.uniform(-2, 2, n) * state[1] / A))
    return measured(rng, (*state[:2], state[2] + spin), *truth.values(), sigma), truth


def of_walls(seed: int, walls: int = 4, n: int = 60, bars: bool = False) -> tuple[Columns, float, float]:
    """Return a table of n measured bounces at some walls of one friction, whose restitutions differ by 0.05; and both."""
    rng = np.random.default_rng([seed, walls, 84])
    state, wall = before(rng, n, 0.0, 0.6), rng.permutation(np.arange(n) % walls)
    e, mu = rng.uniform(0.75, 0.85), rng.uniform(0.1, 0.3)
    each = e + 0.05 * rng.normal(size=walls)
    columns = measured(rng, state, each[wall], mu, 0.0, 0.01, spins=True)
    if not bars:
        columns = {name: column for name, column in columns.items() if not name.startswith("sigma_")}
    return columns | {"wall": np.array(list("abcdefgh"))[wall]}, e, mu


def racket(seed: int, n: int = 80) -> Columns:
    """Return a table of n measured bounces that grip, with a restitution that falls with the speed and a tangential one with the
    slip."""
    rng = np.random.default_rng([seed, 62])
    vn, vt, spin = before(rng, n, 0.0, 0.6)
    beta = np.clip(0.5 - 0.25 * np.abs(vt - A * spin) / vn, 0.0, 1.0)
    return measured(rng, (vn, vt, spin), 0.9 - 0.03 * vn, 5.0, beta, 0.02, spins=True)


def two_rows(seed: int, n: int = 205) -> Columns:
    """Return a table of n measured bounces of which two slip at the wall, and tell its laws apart."""
    rng = np.random.default_rng([seed, 605])
    vn, vt, _spin = before(rng, n, 0.0, 0.2)
    spin = vt / A
    spin[[17, 40]] += np.sign(vt[[17, 40]]) / A
    return measured(rng, (vn, vt, spin), 0.8, 5.0, 0.0, 0.05, spins=True)


def drifting(seed: int, n: int = 80, share: float = 0.8) -> Columns:
    """Return a table of n measured bounces whose errors follow each other in its order: share of an error is in the next."""
    rng = np.random.default_rng([seed, 4])
    columns = measured(rng, before(rng, n, 0.0, 0.5), 0.8, 0.2, 0.0, 0.02, spins=True)
    error = rng.normal(size=n)
    for i in range(1, n):
        error[i] = share * error[i - 1] + (1 - share**2) ** 0.5 * error[i]
    return columns | {"v_n_out": 0.8 * columns["v_n_in"] + 0.02 * error}


def strayed(seed: int, n: int = 100, few: int = 3, spins: bool = True) -> Columns:
    """Return a table of n measured bounces with friction 0.2, error bars of four fifths, and a few rows that are far off."""
    rng = np.random.default_rng([seed, 7])
    state = before(rng, n, 0.0, 0.5)
    columns, slips = (
        measured(rng, state, 0.8, 0.2, 0.0, 0.02, spins=spins),
        np.argsort(-after(*state, 0.8, 0.2)[3])[:few],
    )
    columns["v_t_out"][slips] += np.sign(state[1] - A * state[2])[slips]
    return {name: 0.8 * column if name.startswith("sigma") else column for name, column in columns.items()}
