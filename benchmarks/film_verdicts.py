"""From film to verdict: does the true law win when it can, and does "cannot decide" come when it should?

    python benchmarks/film_verdicts.py [N] [--only NAME] [--shots 20] [--rows FILE]

The tables of ``film_coverage.py``: balls rolled against cushions with noses by the engine, filmed, with sidespins that nobody
measured. N of them (100) a law and camera, and all laws are fitted. A verdict decides at odds of 20 to 1 over the best law that
does not contain the winner; a winner that contains the true law is not wrong: it says the same with a number more.
"""

from __future__ import annotations

import argparse
import time
from collections import Counter
from pathlib import Path
from typing import Any

import numpy as np
from coverage_rows import Kept
from film_coverage import KINDS, LAWS, SETTING
from track_truth import Camera, filmed

from carom.errors import CaromError
from carom.fitting import fit_laws
from carom.fitting.laws import FITTED
from carom.fitting.rank import DECIDED

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


def main() -> None:
    """A line a law and camera on standard output."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("count", nargs="?", type=int, default=100)
    parser.add_argument("--only", default="", help="kinds whose names begin so, or are this: LAW, CAMERA")
    parser.add_argument("--shots", type=int, default=20)
    parser.add_argument("--rows", type=Path, help="keep every table here, a line each; go on from what is there")
    given = parser.parse_args()
    kept = Kept(given.rows)
    for name, (law, camera) in KINDS.items():
        if not (name == given.only or (given.only not in KINDS and name.startswith(given.only))):
            continue
        kind = f"{name}, {given.shots} shots"
        rows = kept.fill(
            kind, range(given.count), lambda seed, law=law, camera=camera: one(law, camera, seed, given.shots)
        )
        share = Counter(row["verdict"] for row in rows)
        said = ", ".join(
            f"{what} {100 * share[what] / len(rows):.1f} %" for what in ("true", "cannot", "wrong", "none")
        )
        wrong = Counter(row["best"] for row in rows if row["verdict"] == "wrong")
        against = Counter(row.get("against", "") for row in rows if row["verdict"] == "cannot")
        print(f"{kind}: {said} of {len(rows)}; ahead in {100 * np.mean([row['right'] for row in rows]):.1f} %; median odds"
              f" {np.median([row['odds'] for row in rows]):.3g}; no law fits in {sum(not row['fits'] for row in rows)};"
              f" {np.mean([row['seconds'] for row in rows]):.1f} s; wrong: {dict(wrong)}; cannot, against: {dict(against)}",
              flush=True)  # fmt: skip


if __name__ == "__main__":
    main()
