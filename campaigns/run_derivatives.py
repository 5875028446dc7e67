"""Derivatives of random runs against extrapolated central differences of whole runs, and those of shots at noses.

    python campaigns/run_derivatives.py [N] [--first 0]

N scenes (10,000) from the seed ``first`` on, of all shapes and laws, with up to 50 events each, by velocities, frictions and two
other numbers (tests/reference/sensitivity_differences.py); and N / 10 drawn scenes of every shape, option and form of the schema
(tests/reference/drawn_options.py), by four of all of their numbers. A column agrees if it is within 1e-7 of the largest
derivative, or within ten times what the differences themselves may be wrong by (Ridders' doubt). Columns that do not are printed,
and judged by hand.

Shots at noses: 2 N shots up to the first cushion and N / 5 whole shots at all tables that carom knows, with cloths of friction
0.05 to 0.6: balls that roll, slide with spin, or are struck, pressed down by the cushion (tests/reference/pressed_shots.py).
A derivative agrees if it is off by no more than 1e-4 of the larger of 0.1 and the difference, of four steps that agree.
"""

from __future__ import annotations

import warnings
from collections import Counter
from collections.abc import Callable, Sequence
from concurrent.futures import ProcessPoolExecutor
from typing import Any

import numpy as np
from campaign import campaign
from reference.pressed_shots import LIMIT, ShotCase, compare_shot
from reference.sensitivity_differences import Case, compare
from rich.console import Console
from rich.progress import Progress

CHUNK = 50


def look(seeds: range) -> list[Case]:
    """Return the cases of some scenes."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return [case for seed in seeds for case in compare(seed)]


def look_at_drawn(seeds: range) -> list[Case]:
    """Return the cases of some scenes of every shape and option."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return [case for seed in seeds for case in compare(seed, drawn=True)]


def look_at_noses(seeds: range, whole: bool = False) -> list[ShotCase]:
    """Return the cases of some shots at noses."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return [case for seed in seeds for case in compare_shot(seed, whole)]


def look_at_whole_shots(seeds: range) -> list[ShotCase]:
    """Return the cases of some shots, up to their end."""
    return look_at_noses(seeds, True)


def main(words: Sequence[str] | None = None) -> int:
    """Print how many columns agree, and those that do not."""
    with campaign("run_derivatives", __doc__, words, count=10_000, small=3, first={"type": int, "default": 0}) as run:
        first, count = run.given.first, run.count
        look(range(first, first + 1))  # (compiled before there are many processes)
        with Progress(console=Console(stderr=True), transient=True) as bar, ProcessPoolExecutor() as pool:

            def all_of(work: Callable[[range], list[Any]], name: str, begin: int, end: int) -> list[Any]:
                task = bar.add_task(name, total=end - begin)
                chunks = [range(k, min(k + CHUNK, end)) for k in range(begin, end, CHUNK)]
                cases = []
                for seeds, found in zip(
                    chunks, map(work, chunks) if run.small else pool.map(work, chunks), strict=True
                ):
                    cases += found
                    bar.advance(task, len(seeds))
                return cases

            cases = all_of(look, "scenes", first, first + count)
            drawn = all_of(look_at_drawn, "drawn scenes", first, first + max(count // 10, 1))
            noses = all_of(look_at_noses, "first cushions", 2 * first, 2 * (first + count))
            shots = all_of(look_at_whole_shots, "whole shots", first // 5, first // 5 + max(count // 5, 1))
        _say_columns(run, "scenes", cases)
        _say_columns(run, "drawn scenes", drawn)
        _say_shots(run, "shots up to the first cushion", noses)
        _say_shots(run, "whole shots", shots)
    return 0


def _say_columns(run: Any, name: str, cases: list[Case]) -> None:
    compared = [case for case in cases if case.verdict == "compared"]
    agree = [case for case in compared if case.error <= max(1e-7, 10 * case.doubt)]
    errors = np.array([case.error for case in compared])
    scenes = len({case.seed for case in cases})
    run.say(f"{scenes:,} {name}, {len(compared):,} columns compared, {len(agree):,} agree")
    if len(errors):
        at = (np.quantile(errors, q) for q in (0.5, 0.9, 0.95))
        run.say("errors: median {:.1e}, 90 % below {:.1e}, 95 % below {:.1e} of the largest derivative".format(*at))
    verdicts = Counter(_short(case.verdict) for case in cases if case.verdict != "compared")
    run.say("not compared:", ", ".join(f"{n:,} {why}" for why, n in verdicts.most_common()) or "none")
    for case in compared:
        if case not in agree:
            run.say(f"{name}: {case.seed}, {case.column}: {case.error:.1e}, the differences' doubt {case.doubt:.1e}")


def _say_shots(run: Any, name: str, cases: list[ShotCase]) -> None:
    compared = [case for case in cases if case.verdict == "compared"]
    wrong = [case for case in compared if not case.worst <= LIMIT]
    shots = len({case.seed for case in compared})
    run.say(f"{shots:,} {name}, {len(compared):,} columns compared, {len(wrong):,} off by more than {LIMIT:g}")
    if compared:
        errors = np.array([case.worst for case in compared])
        run.say("errors: median {:.1e}, 99 % below {:.1e}, largest {:.1e}".format(*np.quantile(errors, (0.5, 0.99, 1))))
    verdicts = Counter(case.verdict.partition(":")[0] for case in cases if case.verdict != "compared")
    run.say("not compared:", ", ".join(f"{n:,} {why}" for why, n in verdicts.most_common()) or "none")
    for case in wrong:
        run.say(f"shot {case.seed}, {case.column}: {case.worst:.1e}")


def _short(verdict: str) -> str:
    if verdict.startswith("refused"):
        return "refused at a graze" if "graze" in verdict else "refused: a number that the scene fixes"
    return verdict.partition(":")[0]


if __name__ == "__main__":
    raise SystemExit(main())
