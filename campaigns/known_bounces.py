"""Bounces by the impulse's closed form: frictions claimed where no row slides; error bars beside spins that are not normal.

    python campaigns/known_bounces.py [runs] [--only NAME] [--rows FILE]

The tables are made without carom (tests/reference/plain_bounces.py). Where no row slides and spins are not measured, a friction
with an error bar is wrong. Beside a mixture of spins: how often error bars hold the truth, and how far contact, which contains
sliding, ends above it. Where walls differ: how often their means hold the truth.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from campaign import campaign, shares
from reference.plain_bounces import A, holding, mixed, of_walls

import carom
from carom.data import make_rebounds
from carom.fitting import Setting, fit_law, fit_laws, make_problem
from carom.fitting.laws import laws_named

HOLDING = {f"no row of {n} slides": n for n in (12, 25, 60)}
MIXED = {"80 bounces, a mixture of spins": 80}

WALLS = {f"60 bounces at {n} walls": n for n in (2, 4)}


def at_walls(n: int, seed: int) -> dict[str, Any]:
    """How far the mean restitution and the friction of walls that differ are off, in error bars."""
    columns, e, mu = of_walls(seed, n)
    found = carom.fit(columns, radius=A, laws=["sliding"], bootstrap=0, profiles=False).best.estimates
    return {name: _off(found[name], true) for name, true in (("restitution", e), ("friction", mu))}


def _off(one: Any, true: float) -> Any:
    """Return how far a number is off in error bars, or whether its intervals hold the truth where it has them."""
    if one.interval_95 is not None and one.interval_68 is not None:
        return [low <= true <= high for low, high in (one.interval_68, one.interval_95)]
    return (one.value - true) / one.stderr if one.stderr else None


def claimed(n: int, seed: int) -> dict[str, Any]:
    """Whether a friction is claimed in a table of which no row slides."""
    problem = make_problem(make_rebounds("planar", holding(seed, n)[0]), Setting(radius=A))[0]
    return {
        "claimed": fit_law(laws_named(["sliding"], "planar", True)[0][0], problem).estimates["friction"].value
        is not None
    }


def held(n: int, seed: int) -> dict[str, Any]:
    """How far numbers are off in error bars, by law and name; how far contact ends above sliding."""
    columns, truth = mixed(seed, n)
    ranking = fit_laws(
        make_rebounds("planar", columns), Setting(radius=A), ["sliding", "contact"], profiles=False, bootstrap=0
    )
    fits = {one.fit.law.name: one.fit for one in ranking.ranked}
    found: dict[str, Any] = {"above": fits["contact"].deviance - fits["sliding"].deviance}
    for law, fit in fits.items():
        for name, one in fit.estimates.items():
            if name in truth:
                off = (one.value - truth[name]) / one.stderr if one.value is not None and one.stderr else None
                found[f"{law} {name}"] = off
    return found


def main(words: Sequence[str] | None = None) -> None:
    """A line a kind, or a number."""
    with campaign("known_bounces", __doc__, words, count=1000, small=2) as run:
        for name, n in HOLDING.items():
            if run.wants(name, HOLDING | MIXED | WALLS):
                rows = run.rows.fill(name, range(run.count), lambda seed, n=n: claimed(n, seed))
                run.say(f"{name}: a friction is claimed in {sum(row['claimed'] for row in rows)} of {len(rows)}")
        for name, n in WALLS.items():
            if run.wants(name, HOLDING | MIXED | WALLS):
                rows = run.rows.fill(name, range(run.count), lambda seed, n=n: at_walls(n, seed))
                for number in ("restitution", "friction"):
                    run.say(f"{name}: {number:12} {shares([row[number] for row in rows])}")
        for name, n in MIXED.items():
            if run.wants(name, HOLDING | MIXED | WALLS):
                rows = run.rows.fill(name, range(run.count // 5), lambda seed, n=n: held(n, seed))
                above = sum(row["above"] > 0.05 for row in rows)
                run.say(f"{name}: contact ends above sliding in {above} of {len(rows)}")
                for number in [number for number in rows[0] if number.startswith(("sliding", "contact"))]:
                    run.say(f"{number:35} {shares([row.get(number) for row in rows])}")


if __name__ == "__main__":
    main()
