"""Derivatives of random runs against extrapolated central differences of whole runs.

    python campaigns/run_derivatives.py [N] [--first 0]

N scenes (10,000) from the seed ``first`` on, of all shapes and laws, with up to 50 events each, by velocities, frictions and two
other numbers (tests/reference/sensitivity_differences.py). A column agrees if it is within 1e-7 of the largest derivative, or
within ten times what the differences themselves may be wrong by (Ridders' doubt). Columns that do not are printed, and judged by
hand.
"""

from __future__ import annotations

import warnings
from collections import Counter
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor

import numpy as np
from campaign import campaign
from reference.sensitivity_differences import Case, compare
from rich.console import Console
from rich.progress import Progress

CHUNK = 50


def look(seeds: range) -> list[Case]:
    """Return the cases of some scenes."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return [case for seed in seeds for case in compare(seed)]


def main(words: Sequence[str] | None = None) -> int:
    """Print how many columns agree, and those that do not."""
    with campaign("run_derivatives", __doc__, words, count=10_000, small=3, first={"type": int, "default": 0}) as run:
        end = run.given.first + run.count
        chunks = [range(k, min(k + CHUNK, end)) for k in range(run.given.first, end, CHUNK)]
        cases = look(range(end, end + 1))[:0]  # (compiled before there are many processes)
        with Progress(console=Console(stderr=True), transient=True) as bar, ProcessPoolExecutor() as pool:
            task = bar.add_task("scenes", total=run.count)
            for seeds, found in zip(chunks, map(look, chunks) if run.small else pool.map(look, chunks), strict=True):
                cases += found
                bar.advance(task, len(seeds))
        compared = [case for case in cases if case.verdict == "compared"]
        agree = [case for case in compared if case.error <= max(1e-7, 10 * case.doubt)]
        errors = np.array([case.error for case in compared])
        run.say(f"{run.count:,} scenes, {len(compared):,} columns compared, {len(agree):,} agree")
        if len(errors):
            at = (np.quantile(errors, q) for q in (0.5, 0.9, 0.95))
            run.say("errors: median {:.1e}, 90 % below {:.1e}, 95 % below {:.1e} of the largest derivative".format(*at))
        verdicts = Counter(_short(case.verdict) for case in cases if case.verdict != "compared")
        run.say("not compared:", ", ".join(f"{n:,} {why}" for why, n in verdicts.most_common()) or "none")
        for case in compared:
            if case not in agree:
                run.say(f"scene {case.seed}, {case.column}: {case.error:.1e}, the differences' doubt {case.doubt:.1e}")
    return 0


def _short(verdict: str) -> str:
    if verdict.startswith("refused"):
        return "refused at a graze" if "graze" in verdict else "refused: a number that the scene fixes"
    return verdict.partition(":")[0]


if __name__ == "__main__":
    raise SystemExit(main())
