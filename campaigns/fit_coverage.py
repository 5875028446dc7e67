"""Do error bars keep what they promise? 1,000 made-up tables; how often the truth lies within one and two (1.96) of them.

    python campaigns/fit_coverage.py [runs] [--first SEED] [--only NAME] [--rows FILE]

Prints, for each kind of table, the share of 68.3 % and 95 % beside the counting error of so many runs; how far off the numbers are
on average, and how far they scatter, both in error bars; then how long fits take. With --rows every table is written down as it is
done, and a run goes on from what is there.
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from campaign import campaign, shares
from reference.synthetic_bounces import SETTING, TRUTH, bounces

from carom.data import make_rebounds
from carom.fitting import fit_law, fit_laws, make_problem, with_profiles
from carom.fitting.laws import laws_named


@dataclass(frozen=True)
class Kind:
    """How made-up tables are made, and fitted."""

    law: str
    rows: int
    sigma_v: float
    sigma_spin: float
    unknown: bool = False
    """Whether spins before the wall were not measured."""
    spin_seen: bool = False
    """Whether those after it were, then."""
    profiles: bool = False
    bars: bool = True
    """Whether error bars are given."""
    outliers: float = 0.0
    """Share of rows whose velocity along the wall is off by ten error bars; then laws are ranked, as carom fit does."""


KINDS = {
    "40 bounces, all measured": Kind("contact", 40, 0.02, 2.0),
    "40 bounces, spin after measured only": Kind("sliding", 40, 0.03, 2.0, unknown=True, spin_seen=True),
    "60 bounces, no spin measured": Kind("sliding", 60, 0.03, 2.0, unknown=True),
    "40 bounces, ten times the noise": Kind("contact", 40, 0.2, 20.0),
    "40 bounces, ten times the noise, by profiles": Kind("contact", 40, 0.2, 20.0, profiles=True),
}
KINDS |= {
    f"{rows} bounces without error bars, by profiles": Kind("contact", rows, 0.02, 2.0, profiles=True, bars=False)
    for rows in (8, 12, 20)
}
KINDS |= {
    "40 bounces, 5 % outliers": Kind("contact", 40, 0.02, 2.0, outliers=0.05),
}
KINDS |= {
    f"{name}, by profiles": replace(KINDS[name], profiles=True)
    for name in ("40 bounces, spin after measured only", "60 bounces, no spin measured")
}


def one(kind: Kind, seed: int) -> dict[str, Any]:
    """A table, fitted: of each number (fitted - true) / error, or whether profiles hold it; None where it got no error bar."""
    law = laws_named([kind.law], "planar", True)[0][0]
    made = bounces(seed, kind.rows, kind.sigma_v, kind.sigma_spin, kind.unknown, kind.spin_seen)
    if not kind.bars:
        made = {name: column for name, column in made.items() if not name.startswith("sigma_")}
    if kind.outliers:
        rng = np.random.default_rng(seed + 10_000)
        off = rng.random(kind.rows) < kind.outliers
        made["v_t_out"] = made["v_t_out"] + np.where(off, 10 * kind.sigma_v * rng.choice([-1.0, 1.0], kind.rows), 0.0)
    took = time.process_time()
    rows = make_rebounds("planar", made)
    if kind.outliers:
        fit = fit_laws(rows, SETTING, [kind.law], bootstrap=0, profiles=False).best
    else:
        fit = fit_law(law, make_problem(rows, SETTING)[0])
    fit = with_profiles(fit) if kind.profiles else fit
    found: dict[str, Any] = {"seconds": time.process_time() - took}
    for name, estimate in fit.estimates.items():
        found[name] = None
        if kind.profiles and estimate.interval_68 and estimate.interval_95:
            found[name] = [low <= TRUTH[name] <= high for low, high in (estimate.interval_68, estimate.interval_95)]
        elif not kind.profiles and estimate.value is not None and estimate.stderr:
            found[name] = (estimate.value - TRUTH[name]) / estimate.stderr
    return found


def main(words: Sequence[str] | None = None) -> None:
    """A line a number."""
    with campaign("fit_coverage", __doc__, words, count=1000, small=20, first={"type": int, "default": 0}) as run:
        for name, kind in KINDS.items():
            if run.wants(name, KINDS):
                count = max(run.count // 3, 20) if kind.profiles else run.count
                seeds = range(run.given.first, run.given.first + count)
                rows = run.rows.fill(name, seeds, lambda seed, kind=kind: one(kind, seed))
                took = np.mean([row["seconds"] for row in rows])
                for number in [number for number in rows[0] if number in TRUTH]:
                    run.say(f"{name:50} {number:24} {shares([row[number] for row in rows])}; {took:.2f} s a table")


if __name__ == "__main__":
    main()
