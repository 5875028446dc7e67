"""Results of a gas: its balls at one time, and what was measured in a run."""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass, field, fields
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.core.random import uniform
from carom.errors import CaromError, Fault, FaultList
from carom.formatting import counted, format_number
from carom.gas.edmd.collisions import QUICK
from carom.gas.edmd.driver import GasArrays
from carom.gas.profiles import TimeAverages

COLLAPSE, AT_REST, TOO_SLOW = "inelastic collapse", "at rest", "too slow"
MOST_NAMED = 8  # balls in a message
CONTACT_TIME_SHARE = 1e-3  # of the mean free time: a contact time that is suggested


@dataclass(frozen=True)
class EarlyEnd:
    """When and why a gas ended before the collisions or the time asked for."""

    kind: str
    """``"inelastic collapse"``, ``"at rest"`` or ``"too slow"`` (speeds that double precision cannot square)."""
    time: float
    balls: tuple[int, ...] = ()
    """Of a collapse: the balls that collide ever faster, by their numbers in :meth:`carom.gas.Gas.balls`."""
    collisions: int | None = None
    """Of a collapse of several balls: about how many collisions they had with each other beyond the median of the others of their
    species; None where these are no majority."""

    def to_dict(self) -> dict[str, Any]:
        """Return the fields as plain data, ``balls`` as a list."""
        return asdict(self) | {"balls": list(self.balls)}


class EndedEarlyError(CaromError):
    """Raised where a gas ends before the collisions or the time asked for, with what was measured until then.

    Attributes
    ----------
    end : EarlyEnd
        When and why; of a collapse, which balls.
    result : GasRun, Ensemble or None
        What was measured until then: of :meth:`carom.gas.Gas.run` and :func:`carom.gas.simulate_gas` a GasRun, of
        :func:`carom.gas.simulate_ensemble` the Ensemble, whose gases count up to where each of them ended.

    Examples
    --------
    Of discs that keep a tenth of their speed of approach, a few soon collide infinitely often in a finite time:

    >>> from carom import Disc, Surface
    >>> from carom.gas import EndedEarlyError, Gas, Species
    >>> gas = Gas([Species(Disc(0.5, 1.0), 400)], (60.0, 60.0), contacts=Surface(0.1, 0, -1), seed=1)
    >>> try:
    ...     gas.run(100_000)
    ... except EndedEarlyError as error:
    ...     end, run = error.end, error.result
    >>> end.kind, len(end.balls) >= 3, run.pair_collisions < 10_000
    ('inelastic collapse', True, True)
    """

    def __init__(self, end: EarlyEnd, *faults: Fault | str, result: Any = None) -> None:
        super().__init__(*faults)
        self.end, self.result = end, result

    @classmethod
    def of(cls, end: EarlyEnd, mean_free_time: float = math.inf) -> EndedEarlyError:
        """Return the error for an end; the mean free time says what contact time prevents a collapse."""
        faults, at = FaultList("Gas.run"), f"at t = {end.time!r}"
        if end.kind == COLLAPSE:
            got = f"an inelastic collapse {at}: {_colliding(end)} ever faster, infinitely often in a finite time"
            share = CONTACT_TIME_SHARE * mean_free_time
            such = f", such as {format_number(share, 1)}" if 0 < share < math.inf else ""
            faults.add(
                "contact_time",
                "a finite number of collisions",
                got,
                f"give a contact_time > 0, a small part of the mean free time{such}",
            )
        elif end.kind == TOO_SLOW:
            got = f"slower balls {at}, whose squared speeds double precision cannot hold"
            faults.add("collisions", "speeds above 1e-140", got, "end the run earlier, or start with larger speeds")
        else:
            advice = "run to a time, not to a number of collisions; or supply energy"
            faults.add("collisions", "a gas with collisions to come", f"a gas at rest {at}", advice)
        return cls(end, *faults)


def _colliding(end: EarlyEnd) -> str:
    """Return the balls of a collapse with their verb."""
    if not end.balls:
        return "balls collide"
    if len(end.balls) == 1:
        return f"ball {end.balls[0]} hits a wall"
    if len(end.balls) > MOST_NAMED:
        more = counted(len(end.balls) - MOST_NAMED, "other")
        return f"balls {', '.join(map(str, end.balls[:MOST_NAMED]))} and {more} collide"
    return f"balls {', '.join(map(str, end.balls[:-1]))} and {end.balls[-1]} collide"


def collapse_of(arrays: GasArrays, time: float) -> EarlyEnd:
    """Return the collapse in which the engine has just ended: the balls that are ahead of the clock, or meet at its time."""
    one, balls = arrays.system[0], arrays.balls
    ahead = balls.bodies["last_contact"] - one["now"]
    pause = QUICK * one["bin_width"] * one["balls"]
    # (with the TC model, the time of the last contact itself)
    involved = np.flatnonzero(ahead > (1.5 * pause if one["contact_time"] == 0 else -pause))
    extra = _extra_collisions(balls.motions["collisions"], balls.motions["species"], involved)
    return EarlyEnd(COLLAPSE, time, tuple(sorted(balls.numbers[involved].tolist())), extra)


def _extra_collisions(collisions: NDArray[Any], species: NDArray[Any], involved: NDArray[Any]) -> int | None:
    """Return about how many collisions some balls had with each other beyond the median of the others of their species."""
    if len(involved) < 2:  # (one ball alone hits a wall)
        return 0
    others = np.ones(len(collisions), bool)
    others[involved] = False
    extra = 0.0
    for kind in np.unique(species[involved]):
        usual = collisions[others & (species == kind)]
        own = collisions[involved[species[involved] == kind]]
        if len(usual) <= len(own):
            return None
        extra += float(np.maximum(own - float(np.median(usual)), 0.0).sum())
    return int(extra / 2)


# ----------------------------------------------------------------------------------------------------
# Results of a gas: its balls at one time, and what was measured in a run.


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


# ----------------------------------------------------------------------------------------------------
# When samples of a gas and its snapshots are taken: where walls oscillate, samples at all phases of their oscillations.
#
# Equally spaced samples of a wall with 50 Hz, 0.04 s apart, would all be of one phase, and so would all that is averaged over
# them.


SAME = 1e-9  # of an interval: times that differ by less are the same, but for rounding


@dataclass(frozen=True)
class LogTimes:
    """Times at equal ratios, such as snapshots of a gas that cools: ``first``, then so many for each factor of ten.

    Examples
    --------
    >>> from carom.gas.results import LogTimes
    >>> [round(LogTimes(0.5, 2).after(t), 3) for t in (0.0, 0.5, 1.0, 2.0)]
    [0.5, 1.581, 1.581, 5.0]
    """

    first: float
    per_decade: float

    def after(self, passed: float) -> float:
        """Return the next time after one that has passed."""
        if passed < self.first * (1 - SAME):
            return self.first
        k = math.floor(self.per_decade * math.log10(passed / self.first) + SAME) + 1
        return float(self.first * 10 ** (k / self.per_decade))

    def count(self, duration: float) -> float:
        """Return how many of them are within a duration."""
        return self.per_decade * math.log10(duration / self.first) + 1 if duration >= self.first else 0.0


Every = int | float | LogTimes
"""Between two snapshots: a number of collisions (an int), a time (a float), or equal ratios of time."""


def next_due(every: Every, passed: float) -> float:
    """Return the collisions, or the time, since the measurement began after which the next snapshot is due."""
    if isinstance(every, LogTimes):
        return every.after(passed)
    return (math.floor(passed / every + SAME) + 1) * every


# Shares of an interval at which a sample may be taken. Equal steps could fall on one phase of a fast wall, irregular ones cannot.
SHARES = np.array([uniform(0, 0, n) for n in range(256)])


def spread_time(end: float, width: float, frequencies: ArrayLike, earlier: ArrayLike, stride: int = 1) -> float:
    """Return the time within the interval before ``end`` whose phases of all oscillations are farthest from those at earlier times.

    Every ``stride``-th of the samples counts more for each other: they are to be spread by themselves, too.

    What is least is the sum of x^2 - x over the differences x of phases, in periods, on which the mean square of the discrepancy
    depends; so the phases are filled as evenly as by van der Corput's sequence. Without oscillations, or an interval: ``end``.

    Examples
    --------
    >>> from carom.gas.results import spread_time
    >>> times = [0.04]
    >>> for k in range(2, 9):
    ...     times.append(spread_time(0.04 * k, 0.04, [50.0], times))
    >>> sorted(round(t * 50 % 1 * 8) % 8 for t in times)
    [0, 1, 2, 3, 4, 5, 6, 7]
    """
    rates, before = np.asarray(frequencies, dtype=float), np.asarray(earlier, dtype=float)
    if len(rates) == 0 or len(before) == 0 or not width > 0:
        return end
    times: NDArray[np.float64] = end - width * SHARES
    weight = np.ones(len(before))
    weight[len(before) % stride :: stride] = stride
    apart = np.mod((times[:, None, None] - before[:, None]) * rates, 1.0)
    return float(times[np.argmin((apart * (apart - 1)).sum(axis=2) @ weight)])
