"""Profiles across a container: density and temperature along gravity or between walls, and the pairs that they let one expect."""

from __future__ import annotations

import math
from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.gas.containers import Container
from carom.gas.edmd.driver import GasArrays
from carom.gas.edmd.gas_records import PLANE, Averages

Array = NDArray[np.float64]
MIN_SLICES, MAX_SLICES = 16, 120
LATTICE_POINTS = 61  # across a slice whose volume is found by counting (a prime: slanted walls pass through few points)
DIRECTIONS = 32  # in which balls around another one are looked for


@dataclass(frozen=True, eq=False)
class Profile:
    """Density and temperature of a species in slices across the container, means over the samples."""

    axis: str
    """Across which the slices lie: "x", "y" or "z"."""
    edges: Array
    """Edges of the slices (m), (B + 1,)."""
    density: Array
    """Number of balls per volume of the container, of discs per area, (B,); nan in a slice outside the walls. Between side walls,
    which centres do not reach, it is lower than far from them."""
    temperature: Array
    """Mean of m v^2 along an axis (J), (B,); nan in a slice without balls."""

    @property
    def middle(self) -> Array:
        """Return the middles of the slices (m), (B,)."""
        middle: Array = (self.edges[1:] + self.edges[:-1]) / 2
        return middle


def layers(container: Container, gravity: Sequence[float], driven: Collection[str]) -> tuple[int, bool]:
    """Return the axis across which density varies most, by its number, and whether it is known to vary.

    It is the axis of gravity, else of the plane walls that are driven (by their names), else the first one with walls.
    """
    push = [abs(x) for x in gravity]
    if not any(push):
        planes = [face.vector for face in container.faces if face.form == PLANE and face.name in driven]
        push = [sum(abs(vector[k]) for vector in planes) for k in range(3)]
    closed = [k for k, around in enumerate(container.periodic) if not around] or [0]
    return max(closed, key=lambda k: push[k]), any(push)


def layer_axis(container: Container, gravity: Sequence[float], driven: Collection[str], sheared: bool = False) -> int:
    """Return the axis across which a gas is averaged in layers, by its number; -1 without walls and flow."""
    if sheared:
        return 1
    return layers(container, gravity, driven)[0] if container.faces else -1


class Profiles:
    """Counts of balls in slices across a container: along gravity, else from driven walls, else along the first axis with walls.

    Parameters
    ----------
    container : Container
        One with walls.
    gravity : vector
    driven : names of walls that oscillate or are heated
    mass : (species,) array
    count : int
        Number of balls, on which the number of slices depends.
    depth : float
        Of the balls around which pairs are counted: they are at least so far from the walls.
    """

    def __init__(
        self,
        container: Container,
        gravity: Sequence[float],
        driven: Collection[str],
        mass: Array,
        count: int,
        depth: float,
    ) -> None:
        self.axis, self.layered = layers(container, gravity, driven)
        self.container, self.mass, self.dimensions, self.depth = container, mass, len(container.size), depth
        across = [face for face in container.faces if face.form == PLANE and abs(face.vector[self.axis]) == 1]
        # (what stands along the axis)
        self.sides = replace(container, faces=tuple(face for face in container.faces if face not in across))
        self.bins = int(np.clip(4 * math.sqrt(count), MIN_SLICES, MAX_SLICES))
        self.edges: Array = np.linspace(0, container.size[self.axis], self.bins + 1)
        shape = (len(mass), self.bins)
        self.profile_counts, self.profile_centers = np.zeros(shape, np.int64), np.zeros(shape, np.int64)
        self.profile_inner = np.zeros(shape, np.int64)  # of the balls far from the sides, for g(r) in layers
        self.profile_heat = np.zeros(shape)  # sums of m v^2 along an axis
        self.profile_samples = self.profile_pair_samples = 0

    def add(self, motions: Any, unit: float) -> None:
        """Add a sample; velocities are in multiples of ``unit``."""
        place = self._places(motions)
        square = sum(motions[name] ** 2 for name in ("vx", "vy", "vz")) * unit**2
        heat = self.mass[motions["species"]] * square / self.dimensions
        self.profile_counts += self._sums(place).astype(np.int64)
        self.profile_heat += self._sums(place, heat)
        if self.layered and self.sides.faces:
            x = np.stack([motions[name] for name in "xyz"], axis=1)
            place = place[self.sides.clearance(np.zeros(len(x)), x) >= self.depth]
        self.profile_inner += self._sums(place).astype(np.int64)
        self.profile_samples += 1

    def add_centers(self, motions: Any) -> None:
        """Count the balls around which pairs are counted."""
        self.profile_centers += self._sums(self._places(motions)).astype(np.int64)
        self.profile_pair_samples += 1

    def _places(self, motions: Any) -> NDArray[np.int64]:
        """Return the slice of each ball, counted through the species."""
        height = motions["xyz"[self.axis]] / self.edges[-1] * self.bins
        place: NDArray[np.int64] = np.clip(height.astype(np.int64), 0, self.bins - 1)
        place += motions["species"].astype(np.int64) * self.bins
        return place

    def _sums(self, place: NDArray[np.int64], weights: Array | None = None) -> Array:
        size = len(self.mass) * self.bins
        found: Array = np.bincount(place, weights, size).astype(float)
        return found.reshape(-1, self.bins)

    def of(self, kind: int) -> Profile:
        """Return the profile of a species, by its number."""
        counts = self.profile_counts[kind]
        with np.errstate(invalid="ignore", divide="ignore"):
            density = counts / (self._volumes_within(0.0) * self.profile_samples)
            return Profile("xyz"[self.axis], self.edges, density, self.profile_heat[kind] / counts)

    def _volumes_within(self, depth: float) -> Array:
        return slice_volumes(self.container, self.axis, self.bins, self.sides, depth)

    def _density_around(self, kind: int) -> Array:
        """Return the density of a species far from the sides, (B,), as it is around the balls around which pairs are counted.

        Centres do not reach the sides, and are layered there, so that the mean over a whole slice is another one. It stands only
        for slices that nowhere are so far from them (at the ends of round containers).
        """
        whole, volumes = self.of(kind).density, self._volumes_within(self.depth)
        inner = np.divide(self.profile_inner[kind], volumes * self.profile_samples, out=whole.copy(), where=volumes > 0)
        found: Array = np.nan_to_num(inner, posinf=0.0)
        return found

    def expected_density(self, one: int, two: int, distance: Array) -> Array:
        """Return the sum over the central balls of a species of another one's mean density at some distances from each, (B,)."""
        density, centers = self._density_around(two), self.profile_centers[one]
        middle = (self.edges[1:] + self.edges[:-1]) / 2
        share = (np.arange(DIRECTIONS) + 0.5) / DIRECTIONS
        # directions at equal shares of the sphere, or of the circle
        cosine = 2 * share - 1 if self.dimensions == 3 else np.cos(math.pi * share)
        places = middle[None, :, None] + distance[:, None, None] * cosine
        found: Array = np.interp(places, middle, density).mean(axis=2) @ centers
        return found


def slice_volumes(
    container: Container, axis: int, bins: int, sides: Container | None = None, depth: float = 0.0
) -> Array:
    """Return the volume of each of so many slices across an axis, (bins,), or what of it is so deep within some sides.

    Of boxes it is exact, of others from a lattice of points.
    """
    size, dimensions = container.size, len(container.size)
    if container.shape == "box" and all(face.form == PLANE for face in container.faces):
        inner = [
            length if k == axis or container.periodic[k] else max(length - 2 * depth, 0.0)
            for k, length in enumerate(size)
        ]
        return np.full(bins, math.prod(inner) / bins)
    shape = [LATTICE_POINTS] * dimensions
    shape[axis] = 4 * bins
    middles = [(np.arange(n) + 0.5) * (length / n) for n, length in zip(shape, size, strict=True)]
    x = np.zeros((math.prod(shape), 3))
    for k, grid in enumerate(np.meshgrid(*middles, indexing="ij")):
        x[:, k] = grid.ravel()
    within = container.clearance(0.0, x) > 0
    if sides is not None:
        within &= sides.clearance(0.0, x) >= depth
    share = np.moveaxis(within.reshape(shape), axis, 0).reshape(bins, -1).mean(axis=1)
    volumes: Array = share * (math.prod(size) / bins)
    return volumes


def volume_within(container: Container, depth: float) -> float:
    """Return the volume at least so deep within a container: of boxes exactly, of others by a grid of a million points."""
    axes, size = len(container.size), np.array(container.size)
    if not container.faces:
        return float(size.prod())
    if container.shape == "box" and all(face.form == PLANE for face in container.faces):
        return float(np.maximum(np.where(container.periodic, size, size - 2 * depth), 0).prod())
    n = round(1e6 ** (1 / axes))
    steps = [(np.arange(n) + 0.5) / n] * axes
    x = np.zeros((n**axes, 3))
    x[:, :axes] = np.stack(np.meshgrid(*steps, indexing="ij"), axis=-1).reshape(-1, axes) * size
    return float(size.prod() * (container.clearance(np.zeros(len(x)), x) >= depth).mean())


# ----------------------------------------------------------------------------------------------------
# Exact means over time: temperatures, potential energy, stress, and profiles in layers (:mod:`carom.gas.edmd.averages`).


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
