"""A gas of 10^7 balls: the memory that it takes, and its cost per event beside that of 10^3 balls.

    python campaigns/gas_size.py [MILLIONS]

Rough spheres at number density 0.5. Both gases are advanced in turn, so that other work on the machine slows both; the cost of the
large one is that of its last stretches, five collisions per ball after the start. Then a snapshot and a checkpoint are
written, and the checkpoint is read again: the gas goes on with the same bits.
"""

from __future__ import annotations

import math
import resource
import statistics
import tempfile
import time
from collections.abc import Sequence
from pathlib import Path

from campaign import campaign

from carom.gas import GasScene, Session, Snapshots, load_checkpoint, save_checkpoint

STRETCHES, REPEATS = 10, 5  # of one collision per two balls; the last ones count
FEW_COLLISIONS = 300_000  # of the small gas in each stretch


def session(balls: int) -> Session:
    """A gas in equilibration for ever, so that nothing is sampled."""
    return Session(
        GasScene(
            container={"shape": "periodic", "size": ((balls / 0.5) ** (1 / 3),) * 3},
            species=[{"count": balls, "radius": 0.5}],
            contacts=[{"between": ("a", "a"), "restitution": 1, "friction": math.inf, "tangential_restitution": 1}],
            run={"equilibrate": 1 << 60, "max_events": 1},
        )
    )


def cost(one: Session, collisions: int) -> float:
    """Nanoseconds of processor time per collision."""
    before = one.gas.cpu_seconds
    one.gas.advance(collisions)
    return (one.gas.cpu_seconds - before) / collisions * 1e9


def main(words: Sequence[str] | None = None) -> int:
    """Five lines; 1 if the memory passed 2.5 GB, or a checkpoint continues with other bits."""
    with campaign("gas_size", __doc__, words, count=10, small=1) as run, tempfile.TemporaryDirectory() as folder:

        def peak() -> str:
            return f"peak memory {resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e6:.2f} GB"

        balls = run.count * (20_000 if run.small else 1_000_000)
        few, begin = session(1000), time.monotonic()
        cost(few, 20_000)
        large = session(balls)
        run.say(
            f"{balls:,} balls made in {time.monotonic() - begin:.0f} s, {large.gas.bytes_per_ball:.0f} bytes a ball; {peak()}"
        )
        costs = [(cost(few, FEW_COLLISIONS), cost(large, balls // 2)) for _ in range(2 if run.small else STRETCHES)]
        ratios = sorted(two / one for one, two in costs[-REPEATS:])
        run.say(
            f"{min(one for one, _ in costs):.0f} ns a collision with 1,000 balls, {min(two for _, two in costs):.0f} ns with"
            f" {balls:,}: x {statistics.median(ratios):.2f} ({ratios[0]:.2f} to {ratios[-1]:.2f}); {peak()}"
        )
        begin = time.monotonic()
        file = Snapshots(Path(folder) / "gas.gsd", large.names)
        file.write(large.gas)
        file.close()
        run.say(f"snapshot in {time.monotonic() - begin:.1f} s; {peak()}")
        begin, path = time.monotonic(), Path(folder) / "gas.npz"
        save_checkpoint(large, path)
        run.say(f"checkpoint of {path.stat().st_size / 1e9:.2f} GB in {time.monotonic() - begin:.1f} s; {peak()}")
        large.gas.advance(balls // 100)
        there = [large.gas.time, *large.gas.energy()]
        del large
        begin = time.monotonic()
        again = load_checkpoint(path)
        run.say(f"read again in {time.monotonic() - begin:.1f} s; {peak()}")
        again.gas.advance(balls // 100)
        same = there == [again.gas.time, *again.gas.energy()]
        most = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e6
    # (a small run is one of many tests of a process, whose peak is theirs)
    return int((most > 2.5 and not run.small) or not same)


if __name__ == "__main__":
    raise SystemExit(main())
