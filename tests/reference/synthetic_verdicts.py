"""Tables of bounces whose law is known, and what fits of all laws say of them."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

import carom
from carom.data import Rebounds, make_rebounds
from carom.fitting import Setting, fit_laws
from carom.fitting.evidence import DECIDED
from carom.fitting.laws import FITTED
from carom.laws.maw import maw_contact

A, KAPPA = 0.02, 2 / 3
BALL = carom.Ball(radius=A, mass=0.0027, inertia="hollow")
SETTING = Setting(radius=A, kappa=KAPPA)
NAMES = ("v_n_in", "v_t_in", "spin_in", "v_n_out", "v_t_out", "spin_out")
WITHIN = {law.name: law.within for law in FITTED if law.kind == "planar"}


@dataclass(frozen=True)
class Truth:
    """A law with numbers."""

    law: str
    friction: float
    tangential_restitution: float
    stiffness_ratio: float = math.nan


TRUTHS = {
    "sliding": Truth("sliding", 0.2, 0.0),
    "no-slip": Truth("no-slip", math.inf, 1.0),
    "tangential restitution 0.3": Truth("contact", 0.25, 0.3),
    "tangential compliance": Truth("maw", 0.25, 0.0, 14 / 17),
    "sliding, no row that holds": Truth("sliding", 0.02, 0.0),
}
ROWS, SIGMA_V, SIGMA_SPIN = 30, 0.02, 1.0


def table(truth: Truth, noise: float, seed: int, count: int = ROWS) -> Rebounds:
    """Bounces by a law, with noise."""
    rng = np.random.default_rng(seed)
    vn, vt = rng.uniform(1, 4, count), rng.uniform(-3, 3, count)
    spin = rng.normal(0, 0.35, count) * np.hypot(vn, vt) / A
    if truth.law == "maw":
        said = [
            maw_contact(
                (-n, t, 0.0), (0.0, 0.0, s), (1.0, 0.0, 0.0), A, KAPPA, 0.8, truth.friction, truth.stiffness_ratio
            )
            for n, t, s in zip(vn.tolist(), vt.tolist(), spin.tolist(), strict=True)
        ]
        after = np.array([[v[0], v[1], w[2]] for v, w in said])
    else:
        zero = np.zeros(count)
        state = carom.State(np.stack([-vn, vt, zero], -1), np.stack([zero, zero, spin], -1))
        hit = carom.impact(BALL, state, surface=carom.Surface(0.8, truth.friction, truth.tangential_restitution)).after
        after = np.stack([hit.velocity[:, 0], hit.velocity[:, 1], hit.spin[:, 2]], -1)
    columns = {}
    for name, values in zip(NAMES, (vn, vt, spin, *after.T), strict=True):
        sigma = noise * (SIGMA_SPIN if "spin" in name else SIGMA_V)
        columns |= {name: values + sigma * rng.normal(size=count), f"sigma_{name}": np.full(count, sigma)}
    return make_rebounds("planar", columns)


def verdict(truth: Truth, noise: float, seed: int, count: int = ROWS) -> dict[str, Any]:
    """The verdict on a table: ``true`` (or a law that contains the true one and is no worse), ``cannot``, ``wrong``."""
    ranking = fit_laws(table(truth, noise, seed, count), SETTING, profiles=False, bootstrap=0)
    best = ranking.best.law.name
    # a winner that contains the true law is not wrong: it says the same with a number more
    right = best == truth.law or best in WITHIN[truth.law]
    decided = ranking.odds >= DECIDED
    return {
        "verdict": ("true" if right else "wrong") if decided else "cannot", "best": best, "right": right,
        "odds": min(ranking.odds, 1e12), "against": ranking.against, "warned": any("error bars before" in n for n in ranking.notes),
    }  # fmt: skip
