"""A three-cushion position solved, against the runs that a search without gradients takes.

    python benchmarks/aim.py

The time of ``carom.aim`` (sweep, refinement, the player's errors) on all cores, compiled before; beside it 18,000 of carom's runs
of the same position. What a shot takes in pooltool: benchmarks/trajectories.py.
"""

from __future__ import annotations

import statistics

import numpy as np
from rows import REPEATS, clock, repeated, report, run_script, usually

import carom
from carom.core.jit.threads import thread_count

BRUTE = usually(18_000, 100)
REACH = {"hit": ("yellow", "red"), "cushions": 3}
PLACES = {"white": (-0.7, -0.3), "yellow": (0.3, 0.2), "red": (0.71, 0.0)}


def position() -> carom.Scene:
    """Three balls on a carom table with real noses."""
    balls = [carom.SceneBall(radius=0.03075, mass=0.21, position=place, name=name) for name, place in PLACES.items()]
    balls[0] = balls[0].model_copy(update={"rolling": True, "velocity": (1.0, 0.0, 0.0)})
    return carom.Scene(
        floor=carom.Floor(restitution=0.5, friction=0.2, rolling_resistance=0.01, spin_friction=0.0127),
        walls=[{"shape": "table", "preset": "carom"}], balls=balls,
        ball_contact=carom.BallContact(restitution=0.95, friction=0.06), run=carom.Run(duration=20),
    )  # fmt: skip


def main() -> None:
    """Print the times."""
    scene = position()
    starts = usually(1 << 14, 512)
    best = carom.aim(scene, ["balls.0.velocity"], REACH, starts=starts)
    random = np.random.default_rng(1)
    angle, speed = random.uniform(0, 2 * np.pi, BRUTE), random.uniform(0.5, 6, BRUTE)
    v, w = np.zeros((BRUTE, 3, 3)), np.zeros((BRUTE, 3, 3))
    v[:, 0] = np.stack([speed * np.cos(angle), speed * np.sin(angle), 0 * angle], axis=1)
    w[:, 0] = np.stack([-v[:, 0, 1], v[:, 0, 0], 0 * angle], axis=1) / 0.03075
    carom.simulate_many(scene, v[:100], w[:100])
    solved, brute = [], []
    for _repeat in range(REPEATS):
        begin = clock()
        best = carom.aim(scene, ["balls.0.velocity"], REACH, starts=starts)
        solved.append(clock() - begin)
        begin = clock()
        carom.simulate_many(scene, v, w)
        brute.append(clock() - begin)
    print(best)
    report(repeated("a three-cushion shot found by carom aim", solved, unit="position", wanted=2e9))
    for name, times in (("aim", solved), (f"{BRUTE:,} runs", brute)):
        print(
            f"{name}: {statistics.median(times):.2f} s [{min(times):.2f}, {max(times):.2f}] on {thread_count()} cores"
        )


if __name__ == "__main__":
    run_script(main)
