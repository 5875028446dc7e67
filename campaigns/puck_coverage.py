"""Do error bars hold the truth where discs bounce on and on and nobody sees their spin? Counted over made-up air-hockey tables.

    python campaigns/puck_coverage.py [N] [--only NAME] [--rows FILE]

N tables (100) a kind: five discs are struck with spins that are not measured, and bounce five times each between the walls of a
rectangle; speeds have errors of 0.02 m/s. Spins are carried from one contact to the next.
"""

from __future__ import annotations

import functools
from collections.abc import Sequence
from typing import Any

from campaign import campaign, deviations, say_shares, shares
from reference.puck_sequences import KAPPA, RADIUS, SPIN, table

from carom.data import make_rebounds
from carom.fitting import Setting, fit_laws, with_profiles

KINDS = {
    "slides": {"restitution": 0.75, "friction": 0.15, "tangential_restitution": 0.0},
    "grips": {"restitution": 0.75, "friction": 0.4, "tangential_restitution": 0.3},
}


def one_table(truth: dict[str, float], shots: int, seed: int) -> dict[str, Any]:
    """Deviations of the fitted numbers in error bars."""
    columns = table(seed, *truth.values(), shots)
    numbers = {name: columns.pop(name) for name in ("shot", "bounce")}
    rows = make_rebounds("planar", columns, extra=numbers)
    fit = fit_laws(rows, Setting(RADIUS, KAPPA), ["contact"], profiles=False, bootstrap=0).best
    profiled = with_profiles(fit, ["spin_width"]).estimates["spin_width"]
    values, errors = ({name: getattr(one, key) for name, one in fit.estimates.items()} for key in ("value", "stderr"))
    found: dict[str, Any] = {"rows": len(fit.problem.x), "chi2": fit.chi2 / fit.dof}
    found |= deviations(truth | {"spin_width": SPIN}, values, errors)
    ends = profiled.interval_68, profiled.interval_95
    found["spin_width (profile)"] = None if None in ends else [end[0] <= SPIN <= end[1] for end in ends if end]
    return found


def main(words: Sequence[str] | None = None) -> None:
    """A line a kind and number."""
    with campaign("puck_coverage", __doc__, words, count=100, small=1) as run:
        for kind, truth in KINDS.items():
            if not run.wants(kind, KINDS):
                continue
            one = functools.partial(one_table, truth, 2 if run.small else 5)
            rows = run.rows.fill(kind, range(run.count), one)
            say_shares(run, kind, rows, (*truth, "spin_width"))
            run.say(f"{kind:7} {'spin_width (profile)':24} {shares([row['spin_width (profile)'] for row in rows])}")


if __name__ == "__main__":
    main()
