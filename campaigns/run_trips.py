"""Scenes, gases and subjects of sweeps of every shape, option and form through all that carom writes, and back.

    python campaigns/run_trips.py [N] [--first 0]

N scenes (1,000), N / 4 gases, N / 10 impacts and N / 10 billiards (tests/reference/drawn_options.py) through files, dumps, pickles,
copies, changes of their own numbers, and one in four through checkpoints and stores of sweeps; sweeps over two numbers of one scene
in four against the runs of its scenes, bit for bit. What is lost is printed, and the fields of the schema that were never drawn.
"""

from __future__ import annotations

import tempfile
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from campaign import campaign
from reference.drawn_options import fields_of, random_gas, random_impact, random_orbit_case, random_scene
from reference.trips import fields_given, leaves, lost_trips, swept_otherwise

import carom
from carom.gas import GasScene
from carom.sweeps import ImpactCase, OrbitCase

VALUES = 12  # of a swept number


def swept(scene: carom.Scene, seed: int) -> tuple[int, list[str]]:
    """Return at how many points sweeps over two numbers of a scene were compared with its runs, and where they differ."""
    rng = np.random.default_rng([seed, 64])
    found = [(at, x) for at, x in leaves(scene) if isinstance(x, float) and x and np.isfinite(x) and "rack" not in at]
    count, lost = 0, []
    for k in rng.choice(len(found), 2, replace=False):
        at, x = found[int(k)]
        try:
            differ = swept_otherwise(scene, at, [x * (1 - 0.003 * i) for i in range(VALUES)])
        except carom.CaromError:  # (a number that cannot be smaller)
            continue
        count += VALUES
        lost += [f"sweep over {at}: {differ} of {VALUES} points differ"] if differ else []
    return count, lost


def main(words: Sequence[str] | None = None) -> int:
    """Print what does not come back as it was."""
    with campaign("run_trips", __doc__, words, count=1000, small=2, first={"type": int, "default": 0}) as run:
        count, seen, points = run.count, set(), 0
        makers = {
            random_scene: count,
            random_gas: count // 4,
            random_impact: count // 10,
            random_orbit_case: count // 10,
        }
        for make, share in makers.items():
            many = max(share, 1)
            lost = 0
            for seed in range(run.given.first, run.given.first + many):
                model = make(seed)
                seen |= fields_given(model)
                with tempfile.TemporaryDirectory() as folder:
                    found = lost_trips(model, Path(folder), stores=seed % 4 == 0)
                if make is random_scene and seed % 4 == 1:
                    more, differ = swept(model, seed)
                    points, found = points + more, found + differ
                lost += bool(found)
                for one in found:
                    run.say(f"{make.__name__}({seed}): {one}")
            run.say(f"{many:,} of {make.__name__}, {lost:,} with a trip that is lost")
        run.say(f"{points:,} points of sweeps compared with runs")
        known = fields_of(carom.Scene, GasScene, ImpactCase, OrbitCase)
        never = [f"{model.__name__}.{name}" for model, name in known if (model, name) not in seen and name != model.tag]
        run.say(f"{len(known) - len(never):,} of {len(known):,} fields drawn; never:", ", ".join(never[:40]) or "none")
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
