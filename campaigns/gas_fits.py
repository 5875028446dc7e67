"""Do error bars hold the truth where a gas is weighed? Counted over made-up films.

    python campaigns/gas_fits.py [N] [--only NAME] [--rows FILE]

N gases (100) a kind. "tracks" are 150 frames of 60 discs with spins, "spheres" of 60 spheres, whose collisions are fitted;
"viscoelastic" is a restitution that depends on the speed.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from campaign import campaign, deviations, say_shares
from reference.gas_films import film, scene

import carom

TRUTH = {"restitution": 0.85, "friction": 0.3, "tangential_restitution": 0.4}
KINDS: dict[str, dict[str, float]] = {
    "tracks": TRUTH,
    "spheres": TRUTH,
    "viscoelastic tracks": {"restitution_c": 0.2, "friction": 0.3, "tangential_restitution": 0.4},
}


def one_gas(kind: str, seed: int) -> dict[str, Any]:
    """Deviations of the numbers in error bars."""
    e: Any = {"form": "viscoelastic", "c": 0.2} if kind.startswith("visc") else 0.85
    first: Any = {"form": "viscoelastic", "c": 0.4} if kind.startswith("visc") else 0.5
    sides, how = ((12.0, 12.0, 12.0), (300, 0.05)) if kind == "spheres" else ((40.0, 40.0), (150, 0.15))
    tracks = film(scene(e, seed=seed, sides=sides), *how, seed=seed)
    fit = carom.fit_gas(tracks, scene(first, 0.5, 0.0, sides=sides))
    return {"rows": fit.rows} | deviations(KINDS[kind], fit.values, fit.errors)


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
