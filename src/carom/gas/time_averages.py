"""Exact means over time: temperatures, potential energy, stress, and profiles in layers (:mod:`carom.gas.edmd.averages`)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.gas.edmd.driver import GasArrays
from carom.gas.edmd.gas_records import Averages

__all__ = ["LayerAverages", "TimeAverages", "averages_between"]

Array = NDArray[np.float64]
ROUNDING = 1e-12  # of the number of balls in a layer
# Places of the components in a symmetric tensor.
SYMMETRIC = (("xx", "xy", "xz"), ("xy", "yy", "yz"), ("xz", "yz", "zz"))


@dataclass(frozen=True, eq=False)
class LayerAverages:
    """Means over time of each of S species in L layers across a container: the layers of the engine's cells."""

    axis: str
    """Across which the layers lie: "x", "y" or "z"."""
    edges: Array
    """(L + 1,), in m."""
    number: Array
    """Number of balls, (S, L)."""
    velocity: Array
    """Mean velocity of the balls (m/s), (S, L, dimensions); nan in a layer without balls."""
    temperature: Array
    """Of the motion relative to the mean velocity: mean of m v^2 along an axis (J), (S, L)."""
    temperature_rotational: Array
    """Mean of I w^2 about an axis of spin (J), (S, L)."""
    energy_flux: Array
    """Energy of all species that goes towards larger coordinates at each edge, over the time and the area of the enclosing box
    (W/m^2; discs: W/m), (L + 1,): carried by balls that cross the edge, and passed on in collisions of balls on either side. Spins
    count where contacts change them. Nan at the first and the last edge."""
    heat_flux: Array
    """The same less the work of the stress on the mean flow, (L + 1,), for a gas that does not flow across the layers."""


@dataclass(frozen=True, eq=False)
class TimeAverages:
    """Exact means over a time of a gas: integrals over every flight, not samples.

    Velocities are relative to the centre of mass along axes on which momentum is conserved, in a sheared gas to the flow.
    """

    time: float
    """Over which the means go (s)."""
    temperatures: Array
    """Translational and rotational temperature (J) of each species, (S, 2): means of m v^2 along an axis, of I w^2 about one."""
    final: Array
    """The same at the end of the time, (S, 2)."""
    shares: Array
    """Of each species among the balls, (S,)."""
    potential_energy: float
    """Of all balls in the field of gravity (J)."""
    kinetic_stress: Array
    """Momentum that the balls carry: sum of m v v over the volume, (dimensions, dimensions), in Pa (N/m for discs)."""
    collisional_stress: Array
    """Momentum that collisions transfer: sum of r J over volume and time, r from the centre of the second ball to that of the
    first, J the impulse on the first; friction of rough balls makes it asymmetric."""
    layers: LayerAverages | None
    """Profiles; None without walls and shear."""

    @property
    def temperature(self) -> float:
        """Translational temperature of the whole gas (J)."""
        return float(self.shares @ self.temperatures[:, 0])

    @property
    def temperature_rotational(self) -> float:
        """Rotational temperature of the whole gas (J)."""
        return float(self.shares @ self.temperatures[:, 1])

    @property
    def stress(self) -> Array:
        """Flux of momentum along each axis through areas across each axis (the pressure tensor), (dimensions, dimensions)."""
        return self.kinetic_stress + self.collisional_stress

    @property
    def pressure(self) -> float:
        """A third (discs: half) of the trace of the :attr:`stress`."""
        return float(np.trace(self.stress)) / len(self.stress)

    def to_dict(self) -> dict[str, Any]:
        """Return the means of the whole gas as plain numbers and lists."""
        return {
            "time": self.time,
            "temperature": self.temperature,
            "temperature_rotational": self.temperature_rotational,
            "potential_energy": self.potential_energy,
            "pressure": self.pressure,
            "stress": self.stress.tolist(),
            "kinetic_stress": self.kinetic_stress.tolist(),
            "collisional_stress": self.collisional_stress.tolist(),
        }


def averages_between(arrays: GasArrays, before: Any, after: Averages, time: float, groups: Any = None) -> TimeAverages:
    """Return the means over a time, from the integrals until its begin (a mark) and its end; over no time, the values then.

    ``groups`` numbers the species of which the engine's are classes of radii; default: each is one of its own.
    """
    one, flows = arrays.system[0], after.flows
    # sums over the classes of each species
    groups = np.arange(len(flows)) if groups is None else groups
    member = (groups == np.arange(groups.max() + 1)[:, None]).astype(float)
    number = member @ flows["n"]
    axes, count, volume = int(one["dimensions"]), np.maximum(number, 1.0), float(one["volume"])
    about = 3 if axes == 3 else 1

    def mean(name: str) -> Array:
        last = flows["ht" if name == "h" else f"{name}t"]
        found: Array = (flows[f"time_{name}"] - before.flows[f"time_{name}"]) / time if time > 0 else last
        joined: Array = member @ found
        return joined

    def temperatures(of: Any) -> Array:
        moves = sum(of(name) for name in ("xx", "yy", "zz")) / (axes * count)
        return np.stack([moves, of("ww") / (about * count)], axis=1)

    kinetic = np.array([[mean(name).sum() / volume for name in row[:axes]] for row in SYMMETRIC[:axes]])
    whole = [[after.whole[0][a + b] - before.whole[0][a + b] for b in "xyz"[:axes]] for a in "xyz"[:axes]]
    collisional = np.array(whole) / (volume * time) if time > 0 else np.full((axes, axes), math.nan)
    layers = None
    if len(after.layers):
        layers = _in_layers(arrays, before.layers, after, time, about, member)
    return TimeAverages(
        time, temperatures(mean), temperatures(lambda name: member @ flows[f"{name}t"]), number / number.sum(),
        float(mean("h").sum()), kinetic, collisional, layers,
    )  # fmt: skip


def _in_layers(
    arrays: GasArrays, before: Any, after: Averages, time: float, about: int, member: Array
) -> LayerAverages:
    one, species = arrays.system[0], arrays.materials.species
    axis, axes, kinds = int(after.whole[0]["axis"]), int(one["dimensions"]), len(species)

    def mean(name: str) -> Array:
        found: Array = after.layers[f"time_{name}"] - before[f"time_{name}"]
        found = found / time if time > 0 else after.layers["n" if name == "n" else f"{name}t"]
        return found.reshape(-1, kinds).T

    of_class, mass = mean("n"), species["mass"][:, None]
    number = member @ of_class
    # (of a layer that a ball has just left, rounding is left)
    number = np.where(number > ROUNDING * number.max(), number, 0.0)
    with np.errstate(invalid="ignore", divide="ignore"):
        if len(member) < kinds:  # (the mean mass of the balls in a layer)
            mass = member @ (mass * of_class) / number
        v = np.stack([member @ mean(f"p{name}") / (mass * number) for name in "xyz"[:axes]], axis=2)
        moves = member @ mean("vv") / number - mass * (v * v).sum(axis=2)
        for shear in arrays.shear:  # (across a layer the flow itself varies)
            moves -= mass * (shear["rate"] * one["cell_size"][axis]) ** 2 / 12
        spins = member @ mean("ww") / (about * number)
    empty = number == 0
    v[empty], moves[empty], spins[empty] = math.nan, math.nan, math.nan
    edges = float(one["cell_size"][axis]) * np.arange(number.shape[1] + 1)
    fluxes = _through_edges(arrays, before, after, time, axis, of_class)
    return LayerAverages("xyz"[axis], edges, number, v + one["frame"][:axes], moves / axes, spins, *fluxes)


def _through_edges(
    arrays: GasArrays, before: Any, after: Averages, time: float, axis: int, of_class: Array
) -> tuple[Array, Array]:
    """Return the fluxes of energy and of heat through the edges between layers, nan at the outer ones, (L + 1,) each."""
    # (of each kind of balls: a species whose radii are drawn has many)
    one, mass = arrays.system[0], arrays.materials.species["mass"][:, None]
    kinds, axes = len(mass), int(one["dimensions"])
    area = math.prod(float(one["side"][k]) for k in range(axes) if k != axis)
    energy = np.full(of_class.shape[1] + 1, math.nan)
    heat = energy.copy()
    if time == 0:
        return energy, heat

    def through(name: str) -> Array:
        passed: Array = (after.layers[name] - before[name]).reshape(-1, kinds).sum(axis=1)[:-1] / (area * time)
        return passed

    # (spins that nothing sets, nor gives to another ball, carry what they had at the start to and fro)
    turns = int(not arrays.materials.pairs["smooth"].all() or (arrays.walls.faces["temperature"] >= 0).any())
    energy[1:-1] = (through("up_e") + turns * through("up_w")) / 2
    # the mean velocity on both sides of an edge
    whole = (mass * of_class).sum(axis=0)
    work = np.zeros(len(energy) - 2)
    for name in "xyz"[:axes]:
        p = (after.layers[f"time_p{name}"] - before[f"time_p{name}"]).reshape(-1, kinds).sum(axis=1) / time
        with np.errstate(invalid="ignore", divide="ignore"):
            u = np.where(whole > 0, p / whole, 0.0)
        work += (u[1:] + u[:-1]) / 2 * through(f"up_{name}")
    heat[1:-1] = energy[1:-1] - work
    return energy, heat
