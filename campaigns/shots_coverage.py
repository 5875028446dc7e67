"""How often the error bars of fits to whole shots hold the truth: shots that carom draws, filmed, and fitted with all numbers free.

    python campaigns/shots_coverage.py [N] [--shots N] [--only KIND] [--rows FILE]

Of N tables (5) of each kind with numbers drawn at random, each with ten shots of three balls at 50 frames a second and 1.5 mm of
noise: the share of the table's numbers whose truth lies within 1 and 1.96 standard errors. Kinds are laws of the cushions; those
with scatter have other cushions, cloth and balls for each shot. Fits begin from carom's own numbers of a carom table.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from campaign import campaign, counting_errors, held

import carom
from carom.errors import CaromError
from carom.fitting.shots import drawn_films
from carom.scene.toml import path_match

KINDS = ("two-step", "two-step-after", "two-step, scatter", "two-step-after, scatter")
NOISE, RADIUS = 1.5e-3, 0.03075
RANGES = {
    "walls.0.restitution": (0.78, 0.88), "walls.0.friction": (0.18, 0.26), "floor.friction": (0.16, 0.22),
    "floor.rolling_resistance": (0.003, 0.006), "floor.spin_friction": (0.001, 0.004), "ball_contact.restitution": (0.92, 0.97),
    "ball_contact.friction": (0.05, 0.08), "walls.0.yield_time": (0.001, 0.004), "floor.rolling_drag": (0.001, 0.003),
    "floor.spin_drag": (2.0, 4.0),
}  # fmt: skip
SCATTER = {"walls.0.restitution": 0.01, "walls.0.friction": 0.03, "floor.friction": 0.03, "ball_contact.friction": 0.1}
PLACES = {"walls.0.length": 2.84, "walls.0.width": 1.42, "walls.0.center.x": 1.42, "walls.0.center.y": 0.71}


def one(kind: str, seed: int, shots: int, until: float) -> dict[str, Any]:
    """(Fitted less true) / error of each number."""
    law, _, scatter = kind.partition(", ")
    rng = np.random.default_rng([seed, 42])
    truth = {path: float(rng.uniform(low, high)) for path, (low, high) in RANGES.items()}
    tracks, scenes = drawn_films(
        shots, seed=seed, noise=NOISE, until=until, law=law, numbers=truth, scatter=SCATTER if scatter else None
    )
    begin = {path: sum(ends) / 2 for path, ends in RANGES.items()}
    table = carom.replaced(scenes[0], begin)
    few = {"free": ["walls.0.restitution", "walls.0.friction"]} if shots < 5 else {}
    table = carom.replaced(table, {path: x for path, x in truth.items() if few and path not in few["free"]})
    try:
        best = carom.fit_shots(tracks, table, laws=law, **few).best
    except CaromError as error:
        return {"why": error.faults[0]}
    true = {name: PLACES.get(name, truth.get(name, 0.0)) for name in best.names}
    assert all(path_match(scenes[0], name.removesuffix(".x").removesuffix(".y")) for name in true)
    known = {name: one for name, one in best.estimates.items() if one.stderr}
    pulls = {name: (one.value - true[name]) / one.stderr for name, one in known.items()}
    errors = {name: one.stderr / abs(true[name]) for name, one in known.items()}
    return {"pulls": pulls, "errors": errors, "far": best.median(), "scatter": best.scatter}


def main(words: Sequence[str] | None = None) -> None:
    """A line a number, of all kinds together, and one a kind."""
    options = {"shots": {"type": int, "default": 10}, "until": {"type": float, "default": 4.0}}
    with campaign("shots_coverage", __doc__, words, count=5, small=1, **options) as run:
        shots, until = (2, 1.5) if run.small else (run.given.shots, run.given.until)
        wanted = [(kind, seed) for seed in range(run.count) for kind in KINDS if run.wants(kind, KINDS)]
        rows = run.go_through(wanted, lambda kind, seed: one(kind, seed, shots, until))
        good = [row for row in rows if "pulls" in row]
        run.say(f"{len(rows)} tables of {shots} shots, {len(good)} fitted; median distance {_far(good):.1f} mm")
        each = [
            (kind, [row for row in good if row["kind"] == kind], None)
            for kind in dict.fromkeys(key[0] for key in wanted)
        ]
        each += [(name, good, name) for name in dict.fromkeys(name for row in good for name in row["pulls"])]
        for label, some, name in each:
            z = [x for row in some for key, x in row["pulls"].items() if name in (None, key)]
            if not z:
                continue
            within, errors = held(z), counting_errors(len(z))
            size = np.median([x for row in some for key, x in row["errors"].items() if name in (None, key)] or [0.0])
            run.say(
                f"{label:26} {within[0]:5.1f} / {within[1]:5.1f} % of {len(z)} (68.3 / 95.0 ± {errors[0]:.1f});"
                f" median error {100 * size:.2g} %; {sum(abs(x) > 4 for x in z)} beyond 4"
            )


def _far(rows: list[dict[str, Any]]) -> float:
    return 1e3 * float(np.median([row["far"] for row in rows] or [0.0]))


if __name__ == "__main__":
    main()
