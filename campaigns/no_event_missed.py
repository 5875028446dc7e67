"""Random scenes against brute force: no event missed, none made up, never deeper than 1e-9 of a radius in anything.

    python campaigns/no_event_missed.py [N] [--first 0] [--processes ALL] [--rows FILE]

N scenes (100,000) from the seed ``first`` on, judged by tests/reference/brute_force_scene.py, which uses none of the engine's
features, roots and motion. Ends with 1 if a scene is at fault, whose seed it prints.
"""

from __future__ import annotations

import functools
import sys
from collections import Counter
from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager

from campaign import Mapping, Row, campaign, left_to_the_parent
from reference.brute_force_scene import judge, random_scene

import carom

CHUNK = 50
NO_LAW = "no law: "


def look(_kind: str, seed: int) -> Row:
    """Fault, kinds of events, and steps of a scene."""
    try:
        run = carom.simulate(random_scene(seed))
    except carom.CaromError as error:
        return {"fault": NO_LAW + str(error).partition(": ")[2][:60], "row": -1, "size": 0.0, "events": {}, "steps": 0}
    fault, row, size, steps = judge(run)
    return {
        "fault": fault,
        "row": int(row),
        "size": float(size),
        "events": Counter(run.events.kinds),
        "steps": int(steps),
    }


@contextmanager
def processes(count: int | None) -> Iterator[Mapping]:
    """Yield a mapping by so many processes; by this one alone where it is one."""
    if count == 1:
        yield map
        return
    look("", 0)  # compiled before there are many processes
    with ProcessPoolExecutor(count, initializer=left_to_the_parent) as pool:
        try:
            yield functools.partial(pool.map, chunksize=CHUNK)
        finally:
            pool.shutdown(wait=False, cancel_futures=True)


def main(words: Sequence[str] | None = None) -> int:
    """Judge so many scenes on all cores; 1 if one is at fault."""
    options = {
        "first": {"type": int, "default": 0},
        "processes": {"type": int, "help": "default: one for each core"},
    }
    with campaign("no_event_missed", __doc__, words, count=100_000, small=3, **options) as run:
        seeds = range(run.given.first, run.given.first + run.count)
        with processes(1 if run.small else run.given.processes) as many:
            rows = run.go_through([("scene", seed) for seed in seeds], look, many=many)
        no_law = Counter(row["fault"] for row in rows if row["fault"].startswith(NO_LAW))
        bad = [row for row in rows if row["fault"] and row["fault"] not in no_law]
        for row in bad:
            run.say(f"scene {row['seed']}: {row['fault']}, row {row['row']}, {row['size']:.3g}")
        kinds = Counter[str]()
        for row in rows:
            kinds.update(row["events"])
        steps = sum(row["steps"] for row in rows)
        run.say(f"{len(rows):,} scenes, {sum(kinds.values()):,} events, {steps:,} steps of brute force")
        run.say("events:", ", ".join(f"{n:,} {kind}" for kind, n in kinds.most_common()))
        run.say("faults:", dict(Counter(row["fault"] for row in bad)) or "none")
        for why, n in no_law.items():
            run.say(f"{n:,} {why}")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
