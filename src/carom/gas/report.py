"""Report of a session as plain numbers, as ``carom gas`` prints them: series and curves, and the totals of each contact."""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.core.random import added
from carom.gas.gas import Gas
from carom.gas.results import LayerAverages, Mark, slice_volumes
from carom.gas.scene import GasScene
from carom.gas.session import Session

Array = NDArray[np.float64]
# A scene's numbers are in SI units, or in any consistent others; tables and pictures name the SI units.
UNITS_NOTE = "Units of the scene, shown as SI."


def pressure_unit(scene: GasScene) -> str:
    """Return the SI unit of a pressure: in two dimensions it is a force per length."""
    return "N/m" if scene.container.dimensions == 2 else "Pa"


@dataclass(frozen=True)
class Channel:
    """The contacts between two species, or between a species and a wall, during a measurement."""

    between: tuple[str, str]
    collisions: int
    rate: float
    """Collisions per ball of the first species per unit time."""
    lost_normal: float
    """Energy lost by the normal restitution."""
    lost_tangential: float
    """Energy lost by friction and tangential restitution."""
    to_spin: float
    """Energy transferred from translation to spin."""


def channels(gas: Gas, since: Mark, names: tuple[str, ...]) -> list[Channel]:
    """Return numbers and energies of the contacts of each pair of species, and of each species and wall, since a mark.

    Parameters
    ----------
    gas : Gas
        After the mark it has been advanced.
    since : Mark
        From :meth:`carom.gas.Gas.mark`.
    names : tuple of str
        Names of the species.

    Returns
    -------
    list of Channel
        One per pair of species, and per species and wall.

    Examples
    --------
    >>> from carom import Ball, Surface
    >>> from carom.gas import Gas, Species, channels
    >>> gas = Gas([Species(Ball(0.5, 1.0), 64)], (6.0, 6.0, 6.0), contacts=Surface(0.9, 0.3, 0.5), seed=1)
    >>> mark = gas.mark()
    >>> gas.advance(500)
    >>> (channel,) = channels(gas, mark, ("a",))
    >>> channel.between, channel.collisions, channel.lost_normal > 0
    (('a', 'a'), 500, True)
    """
    arrays, kinds, t = gas.arrays, len(names), gas.time - since.time
    classes = [np.flatnonzero(gas.groups == k).tolist() for k in range(kinds)]
    every = len(gas.groups)
    count = [int(np.isin(arrays.balls.motions["species"], classes[k]).sum()) for k in range(kinds)]

    def channel(between: tuple[str, str], table: Any, before: Any, rows: set[int], share: float) -> Channel:
        sums = {
            name: added((table[row][name] - before[row][name]).item() for row in rows)
            for name in ("collisions", "lost_normal", "lost_tangential", "to_spin")
        }
        rate = share * sums["collisions"] / t if t > 0 else float("nan")
        return Channel(between, sums["collisions"], rate, sums["lost_normal"], sums["lost_tangential"], sums["to_spin"])

    found = []
    for i in range(kinds):
        for j in range(i, kinds):
            # a collision within a species involves two of its balls
            share = (2 if i == j else 1) / count[i]
            rows = {row for a in classes[i] for b in classes[j] for row in (a * every + b, b * every + a)}
            found.append(channel((names[i], names[j]), arrays.materials.pairs, since.pairs, rows, share))
    for wall in gas.walls:
        faces = [k for k, name in enumerate(gas.faces) if name == wall]
        for i in range(kinds):
            rows = {face * every + a for face in faces for a in classes[i]}
            found.append(channel((names[i], wall), arrays.walls.contacts, since.contacts, rows, 1 / count[i]))
    return found


def report(session: Session) -> dict[str, Any]:
    """Return the results after equilibration: the totals of the run, then each species, each kind of contact, and diffusion.

    Temperatures, pressures and ``time_averages`` are exact means over the time of the measurement; ``final`` is the state at its
    end. The ratio of the temperatures is that of the means or, of a gas whose temperature changed by more than a factor of
    two, the one at the end: the mean of a cooling gas is that of its beginning.
    """
    mark, measures, run = session.mark, session.measures, session.result
    assert mark is not None
    assert measures is not None
    turns, stationary = session.scene.spins_change, measures.is_stationary
    found = {name: value for name, value in run.to_dict().items() if name != "crossings"}
    energy, means = session.gas.energy(), run.averages

    def of(table: Array) -> dict[str, float]:
        return _temperatures(means.shares @ table, turns)

    found |= {
        "events": session.done,
        "time": session.gas.time,
        "balls": session.scene.count,
        "packing_fraction": session.scene.packing_fraction,
        "energy_start": added(mark.energy),
        "energy_end": added(energy),
        "stationary": stationary,
        "temperature_ratio": of(means.temperatures if stationary else means.final)["temperature_ratio"],
        "samples": measures.samples,
        "diffusion": measures.displacement().diffusion if measures.has_diffusion and stationary else math.nan,
        "walls": {name: one.to_dict() for name, one in session.gas.wall_motion().items()},
        "outflow": {} if (flow := measures.outflow) is None else flow.to_dict(),
        "species": {},
        "channels": [asdict(one) for one in channels(session.gas, mark, session.names)],
    }
    found["energy_imbalance"] = _imbalance(found)
    sampled = measures.samples > 0
    finals = {name: _temperatures(one, turns) for name, one in zip(session.names, means.final, strict=True)}
    found["final"] = of(means.final) | {"species": finals}
    for name, one in zip(session.names, means.temperatures, strict=True):
        mean = _temperatures(one, turns)
        found["species"][name] = mean | {
            "temperature_ratio": (mean if stationary else finals[name])["temperature_ratio"],
            "a2_translational": measures.velocity(name).a2 if sampled else math.nan,
            "a2_rotational": measures.spin(name).a2 if sampled and turns else math.nan,
        }
    if means.layers is not None:
        found["time_averages"]["profile"] = _layers(session, means.layers)
    return found


def _temperatures(one: Array, turns: bool) -> dict[str, float]:
    """Return a translational and a rotational temperature and their ratio: nan for spins that nothing changes, and at rest."""
    moves, spins = map(float, one)
    ratio = spins / moves if turns and moves > 0 else math.nan
    return {"temperature_translational": moves, "temperature_rotational": spins, "temperature_ratio": ratio}


def _layers(session: Session, found: LayerAverages) -> dict[str, Any]:
    """Return the exact profile as lists, by the names of the species."""
    volumes = slice_volumes(session.scene.container.geometry, "xyz".index(found.axis), len(found.edges) - 1)
    with np.errstate(invalid="ignore", divide="ignore"):
        density = found.number / volumes
    columns = {
        "density": density, "velocity": found.velocity, "temperature_translational": found.temperature,
        "temperature_rotational": found.temperature_rotational,
    }  # fmt: skip
    rows = {
        part: {name: one.tolist() for name, one in zip(session.names, values, strict=True)}
        for part, values in columns.items()
    }
    fluxes = {"energy_flux": found.energy_flux.tolist(), "heat_flux": found.heat_flux.tolist()}
    return {"axis": found.axis, "edges": found.edges.tolist(), **rows, **fluxes}


def _imbalance(found: dict[str, Any]) -> float:
    """Return the change of energy that collisions, walls, thermostat and shear do not account for, relative to the energies."""
    start, end = found["energy_start"], found["energy_end"]
    lost = added(row["lost_normal"] + row["lost_tangential"] for row in found["channels"])
    given = [added(found["energy_from_walls"].values()), found["energy_from_thermostat"]]
    given += [found["shear"]["energy"]] if "shear" in found else []
    left, scale = end - start - added(given) + lost, abs(start) + abs(end) + abs(lost)
    return float(left / scale) if scale > 0 else 0.0


def series(session: Session) -> dict[str, Any]:
    """Return the plotted curves, as lists: series over time, distributions, pair correlations, mean square displacement."""
    measures = session.measures
    assert measures is not None
    found: dict[str, Any] = {"series": {name: values.tolist() for name, values in measures.series.items()}}
    found["species_series"] = {
        name: {part: values.tolist() for part, values in parts.items()}
        for name, parts in measures.species_series.items()
    }
    for what, of in (("velocity", measures.velocity), ("spin", measures.spin)):
        found[f"{what}_distribution"] = {
            name: {
                "component": (one := of(name)).center.tolist(),
                "density": one.density.tolist(),
                "error": one.error.tolist(),
                "maxwell": one.maxwell.tolist(),
            }
            for name in session.names
        }
    pairs = []
    for i, first in enumerate(session.names):
        for second in session.names[i:]:
            g = measures.pair_correlation(first, second)
            pairs.append(
                {
                    "between": [first, second],
                    "distance": g.distance.tolist(),
                    "g": g.g.tolist(),
                    "error": g.error.tolist(),
                    "contact": g.contact,
                    "contact_error": g.contact_error,
                }
            )
    found["pair_correlation"] = pairs
    if measures.profiles is not None:
        slices = {name: measures.profile(name) for name in session.names}
        found["profile"] = {
            "axis": measures.profile(session.names[0]).axis,
            "edges": measures.profiles.edges.tolist(),
            "density": {name: part.density.tolist() for name, part in slices.items()},
            "temperature_translational": {name: part.temperature.tolist() for name, part in slices.items()},
        }
    if measures.has_diffusion:
        moved = measures.displacement()
        found["displacement"] = {"lag": moved.lag.tolist(), "square": moved.square.tolist()}
    return found
