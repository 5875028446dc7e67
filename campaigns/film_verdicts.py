"""From film to verdict: does the true law win when it can, and does "cannot decide" come when it should?

    python campaigns/film_verdicts.py [N] [--only NAME] [--shots 20] [--rows FILE]

The tables of ``film_coverage.py``: balls rolled against cushions with noses by the engine, filmed, with sidespins that nobody
measured. N of them (100) a law and camera, and all laws are fitted. A verdict decides at odds of 20 to 1 over the best law that
does not contain the winner; a winner that contains the true law is not wrong: it says the same with a number more.

And verdicts on what is filmed, of films without any option (`tests/reference/plain_films.py`, closed forms): five times N each of
pucks on a floor without friction, dead balls, bounces whose frames are lost, balls that bounce toward the camera. The view, how
often the error bars of the restitution hold the truth, and bounces that appear in no count.
"""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Sequence
from typing import Any

import numpy as np
from campaign import Campaign, film_campaign, shares
from film_coverage import KINDS, LAWS, SETTING
from reference.plain_films import KINDS as PLAIN
from reference.plain_films import measured
from reference.synthetic_tracks import Camera, filmed

from carom.errors import CaromError
from carom.fitting import fit_laws
from carom.fitting.evidence import DECIDED
from carom.fitting.laws import FITTED

WITHIN = {law.name: law.within for law in FITTED if law.kind == "table"}


def one(law: str, camera: Camera, seed: int, shots: int) -> dict[str, Any]:
    """A verdict: ``true``, ``cannot``, ``wrong`` or ``none``; and where the data say that no law fits."""
    took = time.process_time()
    try:
        ranking = fit_laws(filmed(LAWS[law], camera, seed, shots)[2], SETTING, profiles=False, bootstrap=0)
    except CaromError as error:
        return {"verdict": "none", "best": error.faults[0], "right": False, "odds": 1.0, "fits": True, "seconds": 0.0}
    best = ranking.best.law.name
    right = best == law or best in WITHIN[law]
    decided = ranking.odds >= DECIDED
    return {
        "verdict": ("true" if right else "wrong") if decided else "cannot", "best": best, "right": right,
        "odds": min(ranking.odds, 1e12), "against": ranking.against, "fits": ranking.fits, "seconds": time.process_time() - took,
    }  # fmt: skip


def main(words: Sequence[str] | None = None) -> None:
    """A line a law and camera."""
    film_campaign("film_verdicts", __doc__, words, [*KINDS, *PLAIN], report, count=100)


def report(run: Campaign, name: str) -> None:
    """Rank the laws on the tables of a law and camera, and print the verdicts."""
    if name in PLAIN:
        report_plain(run, name)
        return
    law, camera = KINDS[name]
    shots: int = run.given.shots
    kind = f"{name}, {shots} shots"
    rows = run.rows.fill(kind, range(run.count), lambda seed: one(law, camera, seed, shots))
    share = {
        what: sum(row["verdict"] == what for row in rows) / len(rows) for what in ("true", "cannot", "wrong", "none")
    }
    said = ", ".join(
        f"{what} {100 * p:.1f} ± {100 * np.sqrt(p * (1 - p) / len(rows)):.1f} %" for what, p in share.items()
    )
    wrong = Counter(row["best"] for row in rows if row["verdict"] == "wrong")
    against = Counter(row.get("against", "") for row in rows if row["verdict"] == "cannot")
    run.say(
        f"{kind}: {said} of {len(rows)}; ahead in {100 * np.mean([row['right'] for row in rows]):.1f} %; median odds"
        f" {np.median([row['odds'] for row in rows]):.3g}; no law fits in {sum(not row['fits'] for row in rows)};"
        f" {np.mean([row['seconds'] for row in rows]):.1f} s; wrong: {dict(wrong)};"
        f" cannot, against: {dict(against)}"
    )


def report_plain(run: Campaign, name: str) -> None:
    """Measure films of a kind, and print what is wrong with their views, contacts and counts."""

    def one(seed: int) -> dict[str, Any]:
        try:
            return measured(PLAIN[name](np.random.default_rng([seed, len(name)])))._asdict()
        except CaromError as error:
            return {"refused": error.faults[0]}

    rows = run.rows.fill(name, range(1 if run.small else 5 * run.count), one)
    good = [row for row in rows if "refused" not in row]
    wrong = [row for row in good if not row["view"]]
    pulls = [pull for row in good if row["view"] for pull in row["pulls"]]
    run.say(
        f"{name}: restitutions {shares(pulls)}; {len(wrong)} of {len(good)}"
        f" views wrong, {sum(row['said'] for row in wrong)} of them with the other's numbers; bounces in no count:"
        f" {sum(row['unlisted'] for row in good)}; refused {len(rows) - len(good)}"
    )


if __name__ == "__main__":
    main()
