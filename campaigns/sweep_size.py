"""A sweep that is bigger than memory: 10^8 points in a store, and the memory that it takes.

    python campaigns/sweep_size.py [MILLIONS]

Every point is a ball that meets a wall; its final velocity and the number of its impacts are kept: 25 bytes a point.
"""

from __future__ import annotations

import math
import resource
import tempfile
import time
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from campaign import campaign

import carom


def main(words: Sequence[str] | None = None) -> int:
    """Three lines; 1 if the memory passed 1 GB."""
    with campaign("sweep_size", __doc__, words, count=100, small=1) as run, tempfile.TemporaryDirectory() as folder:
        side = math.isqrt(run.count * 1_000_000 // (100 if run.small else 1))
        wall = carom.scene.Plane(point=(0, 0, 0), normal=(1, 0, 0), restitution=0.85, friction=0.2)
        ball = carom.SceneBall(radius=0.03, mass=0.2, position=(1, 0, 0))
        scene = carom.Scene(gravity=0, walls=[wall], balls=[ball], run=carom.Run(duration=2))
        velocity = carom.polar(np.linspace(0.5, 5, side), np.linspace(91, 269, side))
        store = Path(folder) / "s.zarr"
        made = carom.sweep(
            carom.Space(scene, {"balls.0.velocity": velocity}), ["final.velocity", "final.phase"], store=store
        )
        begin = time.monotonic()
        found = made.run()
        took = time.monotonic() - begin
        peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e6
        size = sum(path.stat().st_size for path in store.rglob("*") if path.is_file())
        rows = found["final.velocity"].isel(speed=[0, side // 2, side - 1]).values
        run.say(f"{made.space.size:,} points in {made.blocks.number:,} blocks, {size / 1e9:.2f} GB in the store")
        run.say(f"peak memory {peak:.2f} GB")
        run.say(f"{made.space.size / took / 1e6:.2f} million points per second")
        # (the velocity towards the wall comes back with 0.85 of its size where it reached the wall)
        v = made.space.columns(made.space.size - side, made.space.size)["balls.0.velocity"]
        reached = rows[2, :, 0, 0] > 0
        same = np.allclose(rows[2, reached, 0, 0], -0.85 * v[reached, 0], rtol=1e-12)
    # (a small run is one of many tests of a process, whose peak is theirs)
    return int((peak > 1 and not run.small) or not same)


if __name__ == "__main__":
    raise SystemExit(main())
