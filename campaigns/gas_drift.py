"""Exactness over long runs: what rounding does to the energy of a conserving gas, and to its balls, event after event.

    python campaigns/gas_drift.py [EVENTS, 1000000000] [--balls 1000] [--only rough]

Events are collisions, with walls too, and passages from cell to cell. Printed after each tenth of a run: relative drift of the
energy since the start, momentum where it is kept, and the largest overlap at a contact, in units of the distance.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from campaign import campaign

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
        "sphere": Gas(mixed, container("sphere", radius=0.65 * side), contacts=ROUGH),
    }


def main(words: Sequence[str] | None = None) -> None:
    """Ten lines a gas."""
    with campaign("gas_drift", __doc__, words, count=10**9, small=10**5, balls={"type": int, "default": 1000}) as run:
        every = gases(run.given.balls)
        for name, gas in every.items():
            if not run.wants(name, every):
                continue
            mark, start = gas.mark(), sum(gas.energy())
            for tenth in range(1, 11):
                events = 0
                while events < run.count * tenth / 10:
                    gas.advance(min(500_000, max(run.count // 20, 1)))
                    found = gas.measured_since(mark)
                    events = found.pair_collisions + found.wall_collisions + found.crossings
                momentum = np.abs(gas.balls().velocity.sum(axis=0)).max()
                kept = f"  momentum {momentum:.1e}" if name in {"smooth", "rough"} else ""
                run.say(
                    f"{name:7} {events:14,} events, {found.pair_collisions:13,} pair collisions, {found.cpu_seconds:6.0f} s of CPU"
                    f" time: drift {sum(gas.energy()) / start - 1:+.1e}  overlap {found.max_overlap:.1e}{kept}"
                )


if __name__ == "__main__":
    main()
