"""Sweeps over gases: one run a point, with random numbers of its own."""

from __future__ import annotations

from typing import Any

from carom.core.random import threefry
from carom.gas.report import report
from carom.gas.scene import GasScene
from carom.gas.session import Session
from carom.scene.paths import replaced
from carom.sweeps.outcomes import Outcome, require_outcomes
from carom.sweeps.points import PointByPoint

__all__ = ["Gases"]

WORD = 0xFFFFFFFF
TOTALS = (
    "pair_collisions", "wall_collisions", "simulated_time", "mean_free_time", "pressure", "energy_from_thermostat",
    "energy_drift", "temperature_translational", "temperature_rotational", "temperature_ratio", "max_overlap", "events", "time",
    "packing_fraction", "energy_start", "energy_end", "energy_imbalance", "diffusion",
)  # fmt: skip
OF_SPECIES = (
    "temperature_translational",
    "temperature_rotational",
    "temperature_ratio",
    "a2_translational",
    "a2_rotational",
)


class Gases(PointByPoint):
    """A sweep's subject: the gas of a scene, what ``carom gas`` reports of it."""

    kind = "gas"
    model: GasScene

    def outcomes(self, names: tuple[str, ...]) -> list[Outcome]:
        """Return the outcomes of some names. CaromError with the nearest name."""
        known = [*TOTALS, *(f"species.{one.name}.{part}" for one in self.model.species for part in OF_SPECIES)]
        require_outcomes(names, known)
        return [Outcome(name) for name in names]

    def compute(self, model: GasScene, seed: int, index: int) -> dict[str, Any]:
        """Return the report of a run whose seed follows from the sweep's, the scene's, and the point's index."""
        number = threefry(seed, model.run.seed & WORD, index & WORD, index >> 32)[0]
        session = Session(replaced(model, {"run.seed": number}))
        session.run()
        found = report(session)
        own = {
            f"species.{name}.{part}": value for name, parts in found["species"].items() for part, value in parts.items()
        }
        return {**{name: found[name] for name in TOTALS if name in found}, **own}
