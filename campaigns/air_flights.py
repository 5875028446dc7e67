"""Balls in air beside DOP853: the states at all events of drawn scenes, the gaps there, and that no contact is passed.

    python campaigns/air_flights.py [N] [--rows FILE]

N scenes (2,000) of three balls with drag, lift and wind: rooms in which they fly, tables on which they roll and hop.
An error is a place that is off by 1e-11 m, or a ball so deep in a wall, the floor or another ball.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from campaign import Row, campaign
from reference.air_events import drawn_room, drawn_table, room_distances, table_distances, worst_of_flights

import carom

UNITS = {"place": "m", "velocity": "m/s", "spin": "rad/s", "at": "m", "depth": "m", "time": "s", "pairs": "m"}


def look(seed: int) -> Row:
    """The events of a scene, and its worst."""
    table = seed % 2 == 1
    found: Any = carom.simulate(drawn_table(seed) if table else drawn_room(seed))
    x = found.at(np.linspace(0, found.end, 500)).position
    apart = min(np.nanmin(np.linalg.norm(x[:, i] - x[:, j], axis=1)) for i in range(3) for j in range(i))
    worst = worst_of_flights(found, table_distances if table else room_distances, 12)
    return {"events": len(found.events), "pairs": 0.04 - float(apart)} | worst


def main(words: Sequence[str] | None = None) -> int:
    """The worst of all; 1 if it is too large."""
    with campaign("air_flights", __doc__, words, count=2_000, small=2) as run:
        rows = run.rows.fill("scene", range(run.count), look)
        bad = [
            seed
            for seed, one in enumerate(rows)
            if max(one[name] for name in ("place", "at", "depth", "pairs")) > 1e-11
        ]
        for seed in bad[:20]:
            run.say(f"seed {seed}: " + ", ".join(f"{name} {rows[seed][name]:.1e}" for name in UNITS))
        run.say(
            f"{len(rows)} scenes, {sum(one['events'] for one in rows):,} events, {len(bad)} worse than 1e-11 m; worst"
        )
        run.say(", ".join(f"{name} {max(one[name] for one in rows):.1e} {unit}" for name, unit in UNITS.items()))
    return int(bool(bad))


if __name__ == "__main__":
    raise SystemExit(main())
