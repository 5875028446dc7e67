"""Does the true law win when it can, and does "cannot decide" come when it should? Verdicts counted over made-up tables.

    python benchmarks/verdict_coverage.py [N] [--only NAME] [--rows FILE]

N tables (300) a law and noise: bounces in the plane, every spin measured, played by one law and fitted by all. A verdict decides at
odds of 20 to 1 over the best law that does not contain the winner. A winner that contains the true law is not wrong: it says the
same with a number more. Where it is a hair ahead, the true law is its rival, and the verdict is that they cannot be told apart.
"""

from __future__ import annotations

import argparse
import sys
from collections import Counter
from pathlib import Path

import numpy as np
from coverage_rows import Kept

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))
from verdict_truth import TRUTHS, verdict

NOISES = {"small": 1.0, "ten times": 10.0}


def main() -> None:
    """A line a law and noise on standard output."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("count", nargs="?", type=int, default=300)
    parser.add_argument("--only", default="", help="laws whose names begin so")
    parser.add_argument("--rows", type=Path, help="keep every table here, a line each; go on from what is there")
    given = parser.parse_args()
    kept = Kept(given.rows)
    for name, truth in TRUTHS.items():
        for words, noise in NOISES.items():
            if not name.startswith(given.only):
                continue
            rows = kept.fill(
                f"{name}, {words}",
                range(given.count),
                lambda seed, truth=truth, noise=noise: verdict(truth, noise, seed),
            )
            share = Counter(row["verdict"] for row in rows)
            said = ", ".join(f"{what} {100 * share[what] / len(rows):.1f} %" for what in ("true", "cannot", "wrong"))
            wrong = Counter(row["best"] for row in rows if row["verdict"] == "wrong")
            ahead = np.mean([row["right"] for row in rows])
            odds = np.median([row["odds"] for row in rows])
            print(f"{name}, {words}: {said} of {len(rows)}; ahead in {100 * ahead:.1f} %; median odds {odds:.3g}"
                  f"{'; wrong: ' + str(dict(wrong)) if wrong else ''}", flush=True)  # fmt: skip


if __name__ == "__main__":
    main()
