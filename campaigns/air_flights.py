"""Balls in air beside DOP853: the states at all events of drawn scenes, the gaps there, and that no contact is passed.

    python campaigns/air_flights.py [N]

N scenes (2,000) of three balls with drag, lift and wind: rooms in which they fly, tables on which they roll and hop.
An error is a place that is off by 1e-11 m, or a ball so deep in a wall, the floor or another ball.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from campaign import campaign
from reference.air_events import drawn_room, drawn_table, room_distances, table_distances, worst_of_flights

import carom


def main(words: Sequence[str] | None = None) -> int:
    """The worst of all; 1 if it is too large."""
    with campaign("air_flights", __doc__, words, count=2_000, small=2) as run:
        events, names = 0, ("place", "velocity", "spin", "at", "depth", "time", "pairs")
        worst = dict.fromkeys(names, 0.0)
        for seed in range(run.count):
            table = seed % 2 == 1
            found: Any = carom.simulate(drawn_table(seed) if table else drawn_room(seed))
            events += len(found.events)
            x = found.at(np.linspace(0, found.end, 500)).position
            apart = min(np.linalg.norm(x[:, i] - x[:, j], axis=1).min() for i in range(3) for j in range(i))
            here = worst_of_flights(found, table_distances if table else room_distances, 12) | {
                "pairs": 0.04 - float(apart)
            }
            worst = {name: max(size, here[name]) for name, size in worst.items()}
            if max(here[name] for name in ("place", "at", "depth", "pairs")) > 1e-11:
                run.say(f"seed {seed}: " + ", ".join(f"{name} {size:.1e}" for name, size in here.items()))
        units = {"velocity": "m/s", "spin": "rad/s", "time": "s"}
        run.say(f"{run.count} scenes, {events} events; worst")
        run.say(", ".join(f"{name} {size:.1e} {units.get(name, 'm')}" for name, size in worst.items()))
    return int(max(worst["place"], worst["at"], worst["depth"], worst["pairs"]) > 1e-11)


if __name__ == "__main__":
    raise SystemExit(main())
