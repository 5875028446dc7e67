"""Exactness over long runs: what rounding does to the energy of a conserving gas, and to its balls, event after event.

    python benchmarks/gas_drift.py [--events 1000000000] [--balls 1000] [--only rough,walls]

Events are collisions, with walls too, and passages from cell to cell. Printed after each tenth of a run: relative drift of the
energy since the start, momentum where it is kept, and the largest overlap at a contact, in units of the distance.
"""

from __future__ import annotations

import argparse
import math

import numpy as np

import carom
from carom.gas import Gas, Species, container

SMOOTH, ROUGH = carom.Surface(1, 0, -1), carom.Surface(1, math.inf, 1)


def gases(balls: int) -> dict[str, Gas]:
    ball = carom.Ball(0.5, 1.0, 0.4)
    side = (balls / 0.5) ** (1 / 3)
    mixed = [Species(ball, balls // 2, "a"), Species(carom.Ball(0.3, 0.3, 0.3), balls - balls // 2, "b")]
    return {
        "smooth": Gas([Species(ball, balls)], (side,) * 3, contacts=SMOOTH),
        "rough": Gas([Species(ball, balls)], (side,) * 3, contacts=ROUGH),
        "walls": Gas(mixed, (side,) * 3, periodic=False, contacts=ROUGH, gravity=(0, 0, -0.2)),
        "sphere": Gas(mixed, container("sphere", (1.3 * side,) * 3), contacts=ROUGH),
    }


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--events", type=float, default=1e9)
    parser.add_argument("--balls", type=int, default=1000)
    parser.add_argument("--only", default="smooth,rough,walls,sphere")
    given = parser.parse_args()
    for name, gas in gases(given.balls).items():
        if name not in given.only.split(","):
            continue
        mark, start = gas.mark(), sum(gas.energy())
        for tenth in range(1, 11):
            events = 0
            while events < given.events * tenth / 10:
                gas.go_on(500_000)
                run = gas.measured(mark)
                events = run.pair_collisions + run.wall_collisions + run.crossings
            momentum = np.abs(gas.balls().velocity.sum(axis=0)).max()
            kept = f"  momentum {momentum:.1e}" if name in {"smooth", "rough"} else ""
            print(
                f"{name:7} {events:14,} events, {run.pair_collisions:13,} pair collisions, {run.cpu_seconds:6.0f} s of CPU time:"
                f" drift {sum(gas.energy()) / start - 1:+.1e}  overlap {run.max_overlap:.1e}{kept}",
                flush=True,
            )


if __name__ == "__main__":
    main()
