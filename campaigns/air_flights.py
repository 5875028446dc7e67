"""Flights in air beside DOP853: the states at all events of drawn scenes, the gaps there, and that no contact is passed.

    python campaigns/air_flights.py [N]

N rooms (2,000) of three balls with drag, lift and wind. An error is a place that is off by 1e-11 m, or a ball so deep in another.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from campaign import campaign
from reference.air_events import drawn_room, room_distances, worst_of_flights

import carom


def main(words: Sequence[str] | None = None) -> int:
    """The worst of all; 1 if it is too large."""
    with campaign("air_flights", __doc__, words, count=2_000, small=3) as run:
        events, worst = 0, dict.fromkeys(("place", "velocity", "spin", "at", "depth", "pairs"), 0.0)
        for seed in range(run.count):
            found: Any = carom.simulate(drawn_room(seed))
            events += len(found.events)
            x = found.at(np.linspace(0, found.end, 500)).position
            apart = min(np.linalg.norm(x[:, i] - x[:, j], axis=1).min() for i in range(3) for j in range(i))
            here = worst_of_flights(found, room_distances, 12) | {"pairs": 0.04 - float(apart)}
            worst = {name: max(size, here[name]) for name, size in worst.items()}
        units = {"velocity": "m/s", "spin": "rad/s"}
        run.say(f"{run.count} rooms, {events} events; worst")
        run.say(", ".join(f"{name} {size:.1e} {units.get(name, 'm')}" for name, size in worst.items()))
    return int(max(worst["place"], worst["at"], worst["depth"], worst["pairs"]) > 1e-11)


if __name__ == "__main__":
    raise SystemExit(main())
