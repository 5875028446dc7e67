"""Do error bars hold the truth where a gas is weighed? Counted over made-up films and cooling curves of discs.

    python campaigns/gas_fits.py [N] [--only NAME] [--rows FILE]

N gases (100) a kind. "tracks" are 150 frames of 60 discs with spins, "spheres" of 60 spheres, whose collisions are fitted; the
others are the cooling of 60 discs, compared with simulated gases: "curve" with both temperatures, "friction" with three numbers
sought, "smooth" with the translational temperature alone, and "ratio" with the ratio of the temperatures alone. "viscoelastic"
kinds have a restitution that depends on the speed.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from campaign import campaign, deviations, say_shares
from reference.gas_films import cooling, film, scene

import carom

TRUTH = {"restitution": 0.85, "friction": 0.3, "tangential_restitution": 0.4}
ROUGH = 1e9  # friction of contacts that never slide
TIMES = np.linspace(0, 80, 9)
KINDS: dict[str, dict[str, float]] = {
    "tracks": TRUTH,
    "spheres": TRUTH,
    "curve": {"restitution": 0.85, "tangential_restitution": 0.4},
    "friction": TRUTH,
    "smooth": {"restitution": 0.85},
    "ratio": {"restitution": 0.85, "tangential_restitution": 0.4},
    "viscoelastic tracks": {"restitution_c": 0.2, "friction": 0.3, "tangential_restitution": 0.4},
    "viscoelastic curve": {"restitution_c": 0.2},
}


def one_gas(kind: str, seed: int) -> dict[str, Any]:
    """Deviations of the numbers in error bars; of curves, whether the intervals of 68 and 95 % hold them."""
    truth, smooth = KINDS[kind], kind in {"smooth", "viscoelastic curve"}
    e: Any = {"form": "viscoelastic", "c": 0.2} if kind.startswith("visc") else 0.85
    first: Any = {"form": "viscoelastic", "c": 0.4} if kind.startswith("visc") else 0.5
    if kind.endswith(("tracks", "spheres")):
        sides, how = ((12.0, 12.0, 12.0), (300, 0.05)) if kind == "spheres" else ((40.0, 40.0), (150, 0.15))
        tracks = film(scene(e, seed=seed, sides=sides), *how, seed=seed)
        fit = carom.fit_gas(tracks, scene(first, 0.5, 0.0, sides=sides))
    else:
        rubs = 0.0 if smooth else TRUTH["friction"] if kind == "friction" else ROUGH
        curve = cooling(scene(e, rubs, TRUTH["tangential_restitution"], seed=seed), TIMES)
        if smooth:
            del curve["temperature_rotational"]
        if kind == "ratio":
            warm = curve.pop("temperature")
            curve["ratio"] = curve.pop("temperature_rotational") / warm
        fit = carom.fit_gas(curve, scene(first, rubs, 0.0), names=list(truth), simulations=60, seed=seed)
    found = deviations(truth, fit.values, fit.errors)
    for name, (low, high) in fit.intervals_95.items():
        found[name] = [abs(found[name]) <= 1, low <= truth[name] <= high]
    return {"rows": fit.rows} | found


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
