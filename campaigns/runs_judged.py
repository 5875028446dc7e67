"""Does `carom judge` blame carom's own runs? Drawn runs on slopes, among cushions, frozen to one, in the air and from racks.

    python campaigns/runs_judged.py [N] [--only NAME] [--rows FILE]

N runs (100) a kind, by tests/reference/judged_runs.py, at 60 to 480 frames a second: no violation is right.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from campaign import Row, campaign
from reference.judged_runs import KINDS, judged


def look(kind: str, seed: int) -> Row:
    """How often laws were checked, and the laws of violations."""
    found = judged(kind, seed)
    return {"checked": found.checked, "violated": Counter(one.law for one in found.violations)}


def main(words: Sequence[str] | None = None) -> int:
    """A line a kind; 1 if a run is blamed."""
    blamed = 0
    with campaign("runs_judged", __doc__, words, count=100, small=1) as run:
        for kind in KINDS:
            if not run.wants(kind, KINDS):
                continue
            rows = run.rows.fill(kind, range(run.count), lambda seed, kind=kind: look(kind, seed))
            bad = [(seed, row["violated"]) for seed, row in enumerate(rows) if row["violated"]]
            blamed += len(bad)
            count = sum(sum(row["checked"].values()) for row in rows)
            run.say(f"{kind:7} {len(rows)} runs, {count:,} checks, {len(bad)} runs blamed {bad[:9] or ''}")
    return int(blamed > 0)


if __name__ == "__main__":
    raise SystemExit(main())
