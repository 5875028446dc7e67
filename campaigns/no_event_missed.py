"""Random scenes against brute force: no event missed, none made up, never deeper than 1e-9 of a radius in anything.

    python campaigns/no_event_missed.py [N] [--first 0]

N scenes (100,000) from the seed ``first`` on, judged by tests/reference/brute_force_scene.py, which uses none of the engine's
features, roots and motion. Ends with 1 if a scene is at fault, whose seed it prints.
"""

import sys
from collections import Counter
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from itertools import islice

from campaign import Campaign, campaign
from reference.brute_force_scene import judge, random_scene
from rich.console import Console
from rich.progress import Progress

import carom

CHUNK = 200


def look(seeds: range) -> tuple[Counter[str], Counter[str], int, list[tuple[int, str, int, float]]]:
    """Faults, kinds of events and steps of some scenes."""
    verdicts, kinds, steps, bad = Counter[str](), Counter[str](), 0, []
    for seed in seeds:
        try:
            run = carom.simulate(random_scene(seed))
        except carom.CaromError as error:
            verdicts["no law: " + str(error).partition(": ")[2][:60]] += 1
            continue
        fault, row, size, walked = judge(run)
        verdicts[fault] += 1
        kinds.update(run.events.kinds)
        steps += walked
        if fault:
            bad.append((seed, fault, row, size))
    return verdicts, kinds, steps, bad


def main(words: Sequence[str] | None = None) -> int:
    """Judge so many scenes on all cores; 1 if one is at fault."""
    with campaign("no_event_missed", __doc__, words, count=100_000, small=10, first={"type": int, "default": 0}) as run:
        return judge_scenes(run, run.given.first)


def judge_scenes(run: Campaign, first: int) -> int:
    """Judge the scenes of ``run.count`` seeds."""
    end = first + run.count
    chunks = iter([range(k, min(k + CHUNK, end)) for k in range(first, end, CHUNK)])
    verdicts, kinds, steps = Counter[str](), Counter[str](), 0
    look(range(first, first + 1))  # compiled before there are many processes
    with Progress(console=Console(stderr=True), transient=True) as bar, ProcessPoolExecutor() as pool:
        task = bar.add_task("scenes", total=run.count)
        while some := list(islice(chunks, 64)):
            for seeds, found in zip(some, map(look, some) if run.small else pool.map(look, some), strict=True):
                verdicts += found[0]
                kinds += found[1]
                steps += found[2]
                for seed, fault, row, size in found[3]:
                    run.say(f"scene {seed}: {fault}, row {row}, {size:.3g}")
                bar.advance(task, len(seeds))
    run.say(f"{sum(verdicts.values()):,} scenes, {sum(kinds.values()):,} events, {steps:,} steps of brute force")
    run.say("events:", ", ".join(f"{n:,} {kind}" for kind, n in kinds.most_common()))
    faults = {fault: n for fault, n in verdicts.items() if fault and not fault.startswith("no law")}
    run.say("faults:", faults or "none")
    for why, n in verdicts.items():
        if why.startswith("no law"):
            run.say(f"{n:,} {why}")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
