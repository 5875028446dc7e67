"""Does the true law win when it can, and does "cannot decide" come when it should? Verdicts counted over made-up tables.

    python campaigns/verdict_coverage.py [N] [--only NAME] [--rows FILE]

N tables (300) a law and noise: bounces in the plane, every spin measured, played by one law and fitted by all. A verdict decides at
odds of 20 to 1 over the best law that does not contain the winner. A winner that contains the true law is not wrong: it says the
same with a number more. Where it is a hair ahead, the true law is its rival, and the verdict is that they cannot be told apart.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

import numpy as np
from campaign import campaign
from reference.synthetic_verdicts import ROWS, TRUTHS, verdict

SIZES = (8, 200)  # rows, beside the 30 of most counts
NOISES = {"small": 1.0, "ten times": 10.0}


def main(words: Sequence[str] | None = None) -> None:
    """A line a law and noise; and for the small noise of other numbers of rows."""
    kinds = {
        f"{name}, {size}": (truth, noise, ROWS) for name, truth in TRUTHS.items() for size, noise in NOISES.items()
    }
    kinds |= {f"{name}, {count} rows": (truth, 1.0, count) for count in SIZES for name, truth in TRUTHS.items()}
    with campaign("verdict_coverage", __doc__, words, count=300, small=2) as run:
        for name, (truth, noise, count) in kinds.items():
            if run.wants(name, kinds):
                rows = run.rows.fill(
                    name,
                    range(run.count),
                    lambda seed, truth=truth, noise=noise, count=count: verdict(truth, noise, seed, count),
                )
                share = {
                    what: sum(row["verdict"] == what for row in rows) / len(rows)
                    for what in ("true", "cannot", "wrong")
                }
                said = ", ".join(
                    f"{what} {100 * p:.1f} ± {100 * np.sqrt(p * (1 - p) / len(rows)):.1f} %"
                    for what, p in share.items()
                )
                wrong = Counter(row["best"] for row in rows if row["verdict"] == "wrong")
                ahead = np.mean([row["right"] for row in rows])
                odds = np.median([row["odds"] for row in rows])
                run.say(f"{name}: {said} of {len(rows)}; ahead in {100 * ahead:.1f} %; median odds {odds:.3g}"
                        f"{'; wrong: ' + str(dict(wrong)) if wrong else ''}")  # fmt: skip


if __name__ == "__main__":
    main()
