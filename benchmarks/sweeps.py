"""Sweeps beside ``simulate_many``: 10^6 shots with storage, and what a point costs in time, bytes and memory.

    python benchmarks/sweeps.py [SHOTS]

The ratio of times is of one run each, taken in turns and repeated: the median, and the spread in brackets.
"""

from __future__ import annotations

import resource
import shutil
import statistics
import sys
import tempfile
from pathlib import Path

import numpy as np
from rows import REPEATS, clock, paired, report, run_script, usually

import carom
from carom.core.jit.threads import thread_count

SHOTS = int(sys.argv[1]) if len(sys.argv) > 1 else usually(1_000_000, 100)
KEEP = ["final.position", "final.phase", "events.wall.count"]


def table() -> carom.Scene:
    """One ball on a carom table with real noses."""
    ball = carom.SceneBall(radius=0.03075, mass=0.21, position=(-0.7, -0.3), velocity=(1, 0), rolling=True)
    floor = carom.Floor(restitution=0.5, friction=0.2, rolling_resistance=0.01, spin_friction=0.0127)
    return carom.Scene(
        floor=floor, walls=[{"shape": "table", "preset": "carom"}], balls=[ball], run=carom.Run(duration=20)
    )


def main() -> None:
    """Print the ratios."""
    scene = table()
    side = max(int(np.sqrt(SHOTS)), 1)
    velocity = carom.polar(np.linspace(0.5, 5, side), np.linspace(0, 90, side))
    space = carom.Space(scene, {"balls.0.velocity": velocity})
    v = space.columns(0, space.size)["balls.0.velocity"]
    w = np.stack([-v[:, 1], v[:, 0], np.zeros(len(v))], axis=1) / scene.balls[0].radius
    carom.simulate_many(scene, velocity=v[:100], spin=w[:100])
    carom.sweep(carom.Space(scene, {"balls.0.velocity": carom.polar(1.0, [10.0])}), KEEP).run()
    pairs, rates = [], []
    with tempfile.TemporaryDirectory() as folder:
        store = Path(folder) / "s.zarr"
        for _repeat in range(REPEATS):
            begin = clock()
            many = carom.simulate_many(scene, velocity=v, spin=w)
            plain = clock() - begin
            shutil.rmtree(store, ignore_errors=True)
            begin = clock()
            found = carom.sweep(space, KEEP, store=store).run()
            swept = clock() - begin
            pairs.append((swept, plain))
            rates.append(space.size / swept)
        assert np.array_equal(found["final.position"].values.reshape(-1, 1, 3), many.final.position)
        stored = sum(path.stat().st_size for path in store.rglob("*") if path.is_file())
    ratios = [swept / plain for swept, plain in pairs]
    report(
        paired(
            f"a sweep of {space.size:,} shots, stored",
            pairs,
            "simulate_many, kept in memory",
            count=space.size,
            unit="shot",
        )
    )
    print(f"{space.size:,} shots on {thread_count()} threads, the same bits as simulate_many")
    print(
        f"  sweep with storage, over simulate_many   {statistics.median(ratios):.2f}  [{min(ratios):.2f}, {max(ratios):.2f}]"
    )
    print(f"  points per second                        {statistics.median(rates):,.0f}")
    print(f"  bytes per point in the store             {stored / space.size:.1f}")
    print(
        f"  peak memory                              {resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e6:.2f} GB"
    )


if __name__ == "__main__":
    run_script(main)
