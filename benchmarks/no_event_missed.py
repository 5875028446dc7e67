"""Random scenes against brute force: no event missed, none made up, never deeper than 1e-9 of a radius in anything.

    python benchmarks/no_event_missed.py [N] [first]

N scenes (100,000) from the seed ``first`` (0) on, judged by tests/brute_scene.py, which knows nothing of the engine's
features, roots and motion. Ends with 1 if a scene is at fault, whose seed it prints.
"""

import sys
from collections import Counter
from concurrent.futures import ProcessPoolExecutor
from itertools import islice
from pathlib import Path

from rich.progress import Progress

import carom

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))
from brute_scene import judge, random_scene

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


def main(count: int = 100_000, first: int = 0) -> int:
    """Judge so many scenes on all cores."""
    chunks = iter([range(k, min(k + CHUNK, first + count)) for k in range(first, first + count, CHUNK)])
    verdicts, kinds, steps = Counter[str](), Counter[str](), 0
    look(range(first, first + 1))  # compiled before there are many processes
    with Progress() as bar, ProcessPoolExecutor() as pool:
        task = bar.add_task("scenes", total=count)
        while some := list(islice(chunks, 64)):
            for seeds, found in zip(some, pool.map(look, some), strict=True):
                verdicts += found[0]
                kinds += found[1]
                steps += found[2]
                for seed, fault, row, size in found[3]:
                    bar.console.print(f"scene {seed}: {fault}, row {row}, {size:.3g}")
                bar.advance(task, len(seeds))
    print(f"{sum(verdicts.values()):,} scenes, {sum(kinds.values()):,} events, {steps:,} steps of brute force")
    print("events:", ", ".join(f"{n:,} {kind}" for kind, n in kinds.most_common()))
    faults = {fault: n for fault, n in verdicts.items() if fault and not fault.startswith("no law")}
    print("faults:", faults or "none")
    for why, n in verdicts.items():
        if why.startswith("no law"):
            print(f"{n:,} {why}")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(*map(int, sys.argv[1:3])))
