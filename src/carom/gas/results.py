"""Results of a gas: its balls at one time, and what was measured in a run."""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass, field, fields
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.gas.endings import EarlyEnd
from carom.gas.time_averages import TimeAverages

__all__ = ["TOTALS", "GasBalls", "GasRun", "Mark", "ShearRun"]

Array = NDArray[np.float64]
# Of a mark: totals by pair of species, by face and species, by face; integrals over time of the gas, by species, by layer.
TOTALS = ("pairs", "contacts", "faces", "whole", "flows", "layers")


@dataclass(frozen=True, eq=False)
class GasBalls:
    """All N balls of a gas at one time.

    Attributes
    ----------
    time : float
    position, velocity, spin : (N, 3) arrays
        Positions (m) are in the box; velocities in m/s (of a sheared gas with the flow), spins in rad/s.
    species : (N,) integers
        In the order in which the species were given.
    images : (N, 3) integers
        Net number of periods that a ball has crossed: ``position + images * side`` is its unwrapped position.

    Examples
    --------
    >>> from carom import Ball, Surface
    >>> from carom.gas import Gas, Species
    >>> gas = Gas([Species(Ball(0.5, 1.0), 8)], (6.0, 6.0, 6.0), contacts=Surface(1, 0, -1))
    >>> gas.balls().position.shape
    (8, 3)
    """

    time: float
    position: Array
    velocity: Array
    spin: Array
    species: NDArray[np.uint32]
    images: NDArray[np.int32]


@dataclass(frozen=True)
class ShearRun:
    """Results of a sheared gas: from the mean stress P over the run, relative to the flow."""

    rate: float
    """Shear rate (1/s)."""
    viscosity: float
    """-P_xy / rate (Pa s; discs: N s/m), of the symmetric part of P."""
    normal_difference: float
    """(P_xx - P_yy) / p."""
    energy: float
    """Energy that the shear gave to the gas (J), -rate V t P_xy."""

    @classmethod
    def of(cls, rate: float, means: TimeAverages, volume_time: float) -> ShearRun:
        """Return the results for a shear rate, means over the run, and the volume times the time."""
        p = means.stress
        # (of rough balls: the force along x over a distance along y does the work)
        work = -rate * volume_time * float(p[1, 0]) if volume_time > 0 else 0.0
        difference = float(p[0, 0] - p[1, 1]) / means.pressure if means.pressure else math.nan  # (of balls at rest)
        return cls(rate, -float(p[0, 1] + p[1, 0]) / (2 * rate), difference, work)


class Mark(NamedTuple):
    """Where a measurement begins: all totals, and the energies, until then."""

    system: Any
    pairs: Any
    contacts: Any
    faces: Any
    whole: Any
    flows: Any
    layers: Any
    energy: tuple[float, float, float]
    time: float
    cpu: float


@dataclass(frozen=True)
class GasRun:
    """Measurements from a run of a gas.

    Examples
    --------
    >>> from carom import Ball, Surface
    >>> from carom.gas import Gas, Species
    >>> gas = Gas([Species(Ball(0.5, 1.0), 64)], (6.0, 6.0, 6.0), contacts=Surface(1, 0, -1), seed=1)
    >>> run = gas.run(500)
    >>> run.pair_collisions, abs(run.energy_drift) < 1e-12, round(run.temperature_translational, 6)
    (500, True, 1.0)
    """

    pair_collisions: int
    wall_collisions: int
    simulated_time: float
    cpu_seconds: float
    """Processor time of the event loop alone."""
    mean_free_time: float
    """Of a ball, between collisions with others: N t / (2 pair collisions), those of an inelastic collapse left out (nan where they
    cannot be told from the others)."""
    pressure: float
    """Mean of the normal stresses: (2 K + sum of impulse times distance / t) / (dimensions volume)."""
    wall_pressure: dict[str, float]
    """Impulse on each wall, by its name, per area and time."""
    energy_from_walls: dict[str, float]
    """Energy given by oscillating or heated walls, by name."""
    energy_from_thermostat: float
    energy_drift: float
    """Relative change of the energy (with potential energy under gravity), less what walls and thermostat gave: rounding where
    contacts conserve energy, else minus the fraction that they dissipated."""
    temperature_translational: float
    """Mean over the time of the run of m v^2 along an axis."""
    temperature_rotational: float
    """Mean over the time of the run of I w^2 about an axis of spin."""
    max_overlap: float
    """Largest overlap at a contact by rounding, relative to the distance of the centres."""
    averages: TimeAverages = field(repr=False, compare=False)
    """Exact means over the time of the run: of each species, of the stress, and between walls in layers."""
    crossings: int = field(repr=False)
    """Events in which a ball only crossed the border of a cell."""
    ended_early: EarlyEnd | None = None
    """Why the run ended before the collisions or the time asked for: in an inelastic collapse (which balls, when), at rest, or too
    slow; None if it did not."""
    shear: ShearRun | None = None
    """Of a sheared gas."""

    def to_dict(self) -> dict[str, Any]:
        """Return the results as plain numbers."""
        end, averages = self.ended_early, self.averages
        found = {one.name: getattr(self, one.name) for one in fields(self) if one.name not in {"averages", "shear"}}
        found |= {} if self.shear is None else {"shear": asdict(self.shear)}
        return found | {"ended_early": None if end is None else end.to_dict(), "time_averages": averages.to_dict()}
