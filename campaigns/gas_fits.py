"""Do error bars hold the truth where a gas is weighed? Counted over made-up films.

    python campaigns/gas_fits.py [N] [--only NAME] [--rows FILE]

N gases (100) a kind. "tracks" are 150 frames of 60 discs with spins, "spheres" of 60 spheres, whose collisions are fitted;
"viscoelastic" is a restitution that depends on the speed. "rates" are 12 s of 30 discs by an event search of its own: drawn
contacts, 10 to 240 frames a second, noise of 0.1 to 2 % of the radius, in a box or a periodic one, times exact or rounded.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from campaign import campaign, deviations, say_shares
from reference import gas_events
from reference.gas_films import film, scene

import carom
from carom.errors import CaromError

TRUTH = {"restitution": 0.85, "friction": 0.3, "tangential_restitution": 0.4}
KINDS: dict[str, dict[str, float]] = {
    "tracks": TRUTH,
    "spheres": TRUTH,
    "viscoelastic tracks": {"restitution_c": 0.2, "friction": 0.3, "tangential_restitution": 0.4},
    "rates": TRUTH,
}
RATES = (10, 15, 20, 30, 60, 120, 240)


def one_gas(kind: str, seed: int) -> dict[str, Any]:
    """Deviations of the numbers in error bars."""
    if kind == "rates":
        return one_rate(seed)
    e: Any = {"form": "viscoelastic", "c": 0.2} if kind.startswith("visc") else 0.85
    first: Any = {"form": "viscoelastic", "c": 0.4} if kind.startswith("visc") else 0.5
    sides, how = ((12.0, 12.0, 12.0), (300, 0.05)) if kind == "spheres" else ((40.0, 40.0), (150, 0.15))
    tracks = film(scene(e, seed=seed, sides=sides), *how, seed=seed)
    fit = carom.fit_gas(tracks, scene(first, 0.5, 0.0, sides=sides))
    return {"rows": fit.rows} | deviations(KINDS[kind], fit.values, fit.errors)


def one_rate(seed: int) -> dict[str, Any]:
    """The same of a gas with drawn contacts, frame rate and noise; none of these where the fit refuses."""
    rng = np.random.default_rng(1000 + seed)
    contact = (rng.uniform(0.5, 0.98), float(rng.choice([0.1, 0.2, 0.4, 0.6])), rng.uniform(-0.3, 0.8))
    truth = dict(zip(TRUTH, contact, strict=True))
    rate, around = int(rng.choice(RATES)), bool(rng.random() < 0.5)
    noise, decimals = gas_events.RADIUS * 10 ** rng.uniform(-3, np.log10(0.02)), [None, 3, 4, 6][rng.integers(4)]
    columns, hits = gas_events.film(contact, rate, 12, noise, around=around, decimals=decimals, seed=seed)
    try:
        fit = carom.fit_gas(columns, gas_events.scene(around))
    except CaromError:
        return {"rate": rate, "hits": hits, "rows": 0} | deviations(truth, {}, {})
    return {"rate": rate, "hits": hits, "rows": fit.rows} | deviations(truth, fit.values, fit.errors)


def main(words: Sequence[str] | None = None) -> None:
    """A line a kind and number."""
    with campaign("gas_fits", __doc__, words, count=100, small=1) as run:
        for kind, truth in KINDS.items():
            if not run.wants(kind, KINDS):
                continue
            rows = run.rows.fill(kind, range(run.count), lambda seed, kind=kind: one_gas(kind, seed))
            say_shares(run, kind, rows, truth)
            for rate in RATES if kind == "rates" else ():
                of = [row for row in rows if row["rate"] == rate]
                if of:
                    run.say(
                        f"{kind:7} {rate:4} frames a second: {sum(row['rows'] for row in of):,} collisions fitted of "
                        f"{sum(row['hits'] for row in of):,} in {len(of)} gases"
                    )


if __name__ == "__main__":
    main()
