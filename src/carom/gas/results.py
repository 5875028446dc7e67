"""Results of a gas: its balls at one time, exact means over time, and what was measured in a run."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Sequence
from dataclasses import asdict, dataclass, field, fields, replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.core.random import uniform
from carom.errors import CaromError, Fault, FaultList
from carom.formatting import counted, format_number
from carom.gas.containers import Container
from carom.gas.edmd.collisions import QUICK
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

    def gap(x: Array) -> Array:
        least = container.clearance(0.0, x)
        return least if sides is None else np.minimum(least, sides.clearance(0.0, x) - depth)

    within = _inside(gap, shape, np.array(size))
    share = np.moveaxis(within, axis, 0).reshape(bins, -1).mean(axis=1)
    volumes: Array = share * (math.prod(size) / bins)
    return volumes


def volume_within(container: Container, depth: float) -> float:
    """Return the volume at least so deep within a container: of boxes exactly, of others by a grid of a million points."""
    axes, size = len(container.size), np.array(container.size)
    if not container.faces:
        return float(size.prod())
    if container.shape == "box" and all(face.form == PLANE for face in container.faces):
        return float(np.maximum(np.where(container.periodic, size, size - 2 * depth), 0).prod())
    points = [round(1e6 ** (1 / axes))] * axes
    return float(size.prod() * _inside(lambda x: container.clearance(0.0, x) - depth, points, size).mean())


def _inside(gap: Callable[[Array], Array], points: Sequence[int], size: Array) -> NDArray[np.bool_]:
    """Return where a gap is not below 0 on a lattice of so many points along each axis, in the middles of equal cells.

    A gap changes by at most the distance: a block of points is inside or outside as its middle is, if the gap there is larger than
    the distance of its corners. Other blocks are halved along each axis.
    """
    found = np.zeros(points, bool)
    low, high = np.zeros((1, len(points)), int), np.array([points])
    while len(low):
        x = np.zeros((len(low), 3))
        x[:, : len(points)] = (low + high) / 2 / points * size
        gaps, reach = gap(x), np.linalg.norm((high - low - 1) / points * size / 2, axis=1)
        inside, one = gaps >= reach, reach == 0
        found[tuple(low[inside & one].T)] = True
        for first, end in zip(low[inside & ~one].tolist(), high[inside & ~one].tolist(), strict=True):
            found[tuple(map(slice, first, end))] = True
        low, high = low[np.abs(gaps) < reach], high[np.abs(gaps) < reach]
        ends, upper = np.stack([low, (low + high) // 2, high]), np.indices([2] * len(points)).reshape(len(points), -1).T
        low, high = (np.concatenate([np.choose(k + half, ends) for half in upper]) for k in (0, 1))
        low, high = low[(low < high).all(axis=1)], high[(low < high).all(axis=1)]
    return found


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


# ----------------------------------------------------------------------------------------------------
# Results of a gas: its balls at one time, and what was measured in a run.


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
        What was measured until then: of :meth:`carom.gas.Gas.run` and :func:`carom.simulate_gas` a GasRun, of
        :func:`carom.sweeps.gas_ensemble` the Ensemble, whose gases count up to where each of them ended.

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
