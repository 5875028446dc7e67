"""What derivatives of a run cost beside the run, in one process: ``python benchmarks/sensitivity.py``.

Three balls between upright walls (docs/scenes/three_balls.toml): a plain run, its sensitivity with p = 1, 6, 12 parameters beside
central differences of whole runs for the same p (2 p runs), and many starts at once. Every figure is the best of several, and
every ratio is of figures of this run.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
from rows import compare, report, run_script, seconds, usually

import carom
from carom.core.jit.threads import limit_threads, thread_count
from carom.scene.toml import replaced

SCENE = Path(__file__).parents[1] / "docs" / "scenes" / "three_balls.toml"
WRT = {
    1: ["balls.0.velocity.x"],
    6: ["balls.0.velocity", "balls.0.position", "floor.friction", "walls.*.friction"],
    12: ["balls.*.position.x", "balls.0.velocity", "balls.0.position", "balls.1.position", "floor.friction", "walls.*.friction",
         "floor.restitution", "ball_contact.restitution", "ball_contact.friction"],
}  # fmt: skip
STARTS = usually(4000, 4)
COSTS = 3.0  # plain runs: wanted of a run with six derivatives


def best(work: Callable[[], object], repeats: int) -> float:
    return min(seconds(work) for _ in range(usually(repeats, 1)))


def once(work: Callable[[], object]) -> float:
    return best(work, 1)


def starts(scene: carom.Scene) -> tuple[np.ndarray, np.ndarray]:
    """The scene's shot in STARTS directions, 0.1 rad wide."""
    ball = scene.balls[0]
    turn = np.random.default_rng(0).uniform(-0.05, 0.05, STARTS)
    x, y = ball.velocity[:2]
    v, w = (np.tile([getattr(one.state, name) for one in scene.balls], (STARTS, 1, 1)) for name in ("velocity", "spin"))
    v[:, 0, 0], v[:, 0, 1] = x * np.cos(turn) - y * np.sin(turn), x * np.sin(turn) + y * np.cos(turn)
    w[:, 0, 0], w[:, 0, 1] = -v[:, 0, 1] / ball.radius, v[:, 0, 0] / ball.radius
    return v, w


def main() -> None:
    scene = carom.load_scene(SCENE)
    run = carom.simulate(scene)
    print(f"three balls, {len(run.events)} events")
    print(f"first sensitivity of a process, as Python: {1e3 * once(lambda: run.sensitivity(WRT[6])):.0f} ms")
    v, w = starts(scene)
    loading = once(lambda: carom.sensitivities(scene, WRT[6], v[:2], w[:2]))
    print(f"compiled pass and loop, compiled or loaded: {loading:.1f} s")
    carom.simulate_many(scene, v[:2], w[:2])
    plain = best(lambda: carom.simulate(scene), 300)
    print(f"plain run {1e6 * plain:.0f} us\n")
    report(
        compare(
            "derivatives of a run of three balls, p = 6", lambda: run.sensitivity(WRT[6]).final, lambda: carom.simulate(scene),
            "the run", unit="run", calls=50, wanted=COSTS,
        )
    )  # fmt: skip
    print("  p   sensitivity   in plain runs   central differences   another scene's first")
    for p, wrt in WRT.items():
        found = best(lambda wrt=wrt: run.sensitivity(wrt).final, 100)  # type: ignore[misc]
        assert len(run.sensitivity(wrt).columns) == p
        other = carom.simulate(replaced(scene, {"floor.restitution": 0.5}))
        first = once(lambda wrt=wrt, other=other: other.sensitivity(wrt).final)  # type: ignore[misc]
        print(f"{p:3d}   {1e6 * found:8.0f} us   {found / plain:13.1f}   {2 * p:19d}   {1e3 * first:18.1f} ms")
    threads = thread_count()
    limit_threads(1)
    print(f"\n{STARTS:,} starts at once, one thread:")
    alone = best(lambda: carom.simulate_many(scene, v, w), 3)
    print(f"  runs alone {STARTS / alone:,.0f} a second")
    for p, wrt in WRT.items():
        many = best(lambda wrt=wrt: carom.sensitivities(scene, wrt, v, w), 3)  # type: ignore[misc]
        print(
            f"  runs with {p:2d} derivatives {STARTS / many:,.0f} a second: {many / alone:.1f} runs each, with the run itself"
        )
    limit_threads(threads)


if __name__ == "__main__":
    run_script(main)
