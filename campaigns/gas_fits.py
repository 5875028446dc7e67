"""Do error bars hold the truth where a gas is weighed? Counted over made-up films and cooling curves of discs.

    python campaigns/gas_fits.py [N] [--only NAME] [--rows FILE]

N gases (100) a kind: "tracks" are 150 frames of 60 discs with spins, whose collisions are fitted; "curve" is the cooling of 60
discs, compared with simulated gases.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from campaign import campaign, deviations, say_shares
from reference.gas_films import cooling, film, scene

import carom

KINDS: dict[str, dict[str, float]] = {
    "tracks": {"restitution": 0.85, "friction": 0.3, "tangential_restitution": 0.4},
    "curve": {"restitution": 0.85, "tangential_restitution": 0.4},
}


def one_gas(kind: str, seed: int) -> dict[str, Any]:
    """Deviations of the numbers in error bars."""
    truth = KINDS[kind]
    if kind == "tracks":
        fit = carom.fit_gas(film(scene(seed=seed), seed=seed), scene(0.5, 0.5, 0.0))
    else:
        curve = cooling(
            scene(truth["restitution"], 1e9, truth["tangential_restitution"], seed=seed), np.linspace(0, 80, 9)
        )
        fit = carom.fit_gas(curve, scene(0.5, 1e9, 0.0), simulations=60, seed=seed)
    return {"rows": fit.rows} | deviations(truth, fit.values, fit.errors)


def main(words: Sequence[str] | None = None) -> None:
    """A line a kind and number."""
    with campaign("gas_fits", __doc__, words, count=100, small=1) as run:
        for kind, truth in KINDS.items():
            if not run.wants(kind, KINDS):
                continue
            rows = run.rows.fill(kind, range(run.count), lambda seed, kind=kind: one_gas(kind, seed))
            say_shares(run, kind, rows, truth)


if __name__ == "__main__":
    main()
