"""Time of a run's sensitivity beside a plain run, in one process: ``python benchmarks/sensitivity.py``."""

from __future__ import annotations

import time
from pathlib import Path

import carom

SCENE = Path(__file__).parents[1] / "docs" / "scenes" / "three_balls.toml"
WRT = ["balls.0.velocity", "balls.0.position", "floor.friction", "walls.*.friction"]


def best(work: object, repeats: int) -> float:
    times = []
    for _ in range(repeats):
        start = time.perf_counter()
        work()  # type: ignore[operator]
        times.append(time.perf_counter() - start)
    return min(times)


def main() -> None:
    scene = carom.load_scene(SCENE)
    run = carom.simulate(scene)
    found = run.sensitivity(WRT)
    plain = best(lambda: carom.simulate(scene), 200)
    tangents = best(lambda: run.sensitivity(WRT), 5)
    p = len(found.columns)
    print(
        f"three balls, {len(run.events)} events, p = {p}: plain run {1e6 * plain:.0f} us, sensitivity {1e3 * tangents:.1f} ms"
    )
    print(f"gradients per second and core: {1 / tangents:.1f}; ratio to a plain run {tangents / plain:.0f}")


if __name__ == "__main__":
    main()
