"""A gas of rough or smooth balls, run event by event."""

from __future__ import annotations

import math
import time as clocks
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass, field
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.checks import Faults
from carom.engine.swarm_arrays import DONE
from carom.engine.swarm_run import STATE, Arrays, advance, balls_at, make, restore, saved
from carom.errors import CaromError
from carom.gas.container import Container, room_of
from carom.gas.drive import Drive, Thermostat
from carom.gas.ends import refuse_end
from carom.gas.setup import Contacts, Records, Species, world_records
from carom.gas.start import lattice, thermal

__all__ = ["Gas", "GasBalls", "GasRun", "Mark", "simulate_gas"]

Array = NDArray[np.float64]
CHUNK = 200_000  # collisions between two looks at the outside world: some tenths of a second
TOUCH = 1e-9  # of a radius: what overlaps by less touches


@dataclass(frozen=True, eq=False)
class GasBalls:
    """All balls at one time. Shapes (N, 3); positions are in the box, ``images`` says how often a ball went round it."""

    time: float
    position: Array
    velocity: Array
    spin: Array
    species: NDArray[np.uint32]
    images: NDArray[np.int32]


class Mark(NamedTuple):
    """Where a measurement begins: what was counted, and the energies, until then."""

    swarm: Any
    pairs: Any
    walls: Any
    faces: Any
    energy: tuple[float, float, float]
    time: float
    cpu: float


@dataclass(frozen=True)
class GasRun:
    """What was measured in a run."""

    pair_collisions: int
    wall_collisions: int
    simulated_time: float
    cpu_seconds: float
    """Of the event loop alone."""
    mean_free_time: float
    """Of a ball, between collisions with others: N t / (2 pair collisions)."""
    pressure: float
    """By the virial: (2 K + sum of impulse times distance / t) / (axes volume)."""
    wall_pressure: dict[str, float]
    """Impulse on each wall, by its name, per area and time."""
    energy_from_walls: dict[str, float]
    """What walls that swing or are warm gave."""
    energy_from_thermostat: float
    energy_drift: float
    """Relative change of the energy, with its height if there is gravity, but for what walls and thermostat gave."""
    temperature_translational: float
    """Mean over the run of m v^2 along an axis."""
    temperature_rotational: float
    """Mean over the run of I w^2 about an axis of spin."""
    max_overlap: float
    """Largest overlap at a contact by rounding, in units of the distance of the centres."""
    crossings: int = field(repr=False)
    """Events in which a ball only went to the next cell."""

    def to_dict(self) -> dict[str, Any]:
        """As plain numbers."""
        return asdict(self)


class Gas:
    """Many balls or discs that fly, in a periodic box or whatever else holds them.

    Parameters
    ----------
    species : sequence of Species
    side : two (discs) or three lengths, or a Container
        The box [0, side], whose walls bound the balls' surfaces; or any :func:`carom.gas.container`.
    periodic : bool, or one for each axis
        Of a box given by its lengths.
    contacts : Surface, or a mapping of pairs of names to Surfaces
        Names of species; ``"wall"`` for all walls, or a wall's own name.
    gravity : vector
    contact_time : float
        The TC model: a contact that follows a ball's last one within this time gives all normal velocity back, which ends
        inelastic collapse (Luding & McNamara, Granular Matter 1, 113 (1998)); from a wall that a force or the wall's curvature
        presses it on, at least so much that it comes back after that time. 0: off.
    drives : mapping of walls' names to Drives
        Walls that swing or are warm.
    thermostat : Thermostat
    position, velocity, spin : (N, 3) or (N, 2) arrays, spin of discs (N,)
        Left out: a lattice, or where that has no room :func:`carom.gas.dense`; and random velocities of the species' temperatures
        without momentum.
    seed : int
        Of the start, and of warm walls and the thermostat.
    touch : float
        What overlaps by less than this share of a radius touches: rounding. Positions of single precision need 1e-5.

    Raises CaromError with one line a fault.
    """

    def __init__(
        self,
        species: Sequence[Species],
        side: Sequence[float] | Container,
        *,
        periodic: bool | Sequence[bool] = True,
        contacts: Contacts,
        gravity: Sequence[float] = (0.0, 0.0, 0.0),
        contact_time: float = 0.0,
        drives: Mapping[str, Drive] | None = None,
        thermostat: Thermostat | None = None,
        position: ArrayLike | None = None,
        velocity: ArrayLike | None = None,
        spin: ArrayLike | None = None,
        seed: int = 0,
        touch: float = TOUCH,
    ) -> None:
        room = room_of(side, periodic)
        records = world_records(species, room, contacts, gravity, contact_time, drives or {}, thermostat, seed)
        kinds, axes = records.kinds, len(room.size)
        which = np.repeat(np.arange(len(species)), [one.count for one in species])
        faults = Faults("Gas")
        rng = np.random.default_rng(seed)
        if position is None:
            which = rng.permutation(which)
            x = _places(room, records, kinds["radius"][which], seed)
        else:
            x = _rows(faults, "position", position, len(which), axes)
        mass, moment = kinds["mass"][which], (kinds["kappa"] * kinds["mass"] * kinds["radius"] ** 2)[which]
        v = _rows(faults, "velocity", velocity, len(which), axes)
        w = _rows(faults, "spin", spin, len(which), 3 if axes == 3 else 1)
        faults.done()
        for k, one in enumerate(species):
            those = which == k
            rotational = one.temperature if one.temperature_rotational is None else one.temperature_rotational
            if velocity is None:
                v[those] = thermal(mass[those], tuple(range(axes)), one.temperature, rng)
            if spin is None:
                about = (0, 1, 2) if axes == 3 else (2,)
                w[those] = thermal(moment[those], about, rotational, rng)
        _refuse_overlap(room, records, kinds["radius"][which], x, touch)
        self._names = tuple(wall.name for wall in room.walls)
        self._begin(make(*records, which, x, v, w))

    @classmethod
    def restore(cls, state: dict[str, NDArray[Any]]) -> Gas:
        """The gas of :meth:`state`: it goes on with the same bits."""
        gas = object.__new__(cls)
        gas._begin(restore(tuple(state[name] for name in STATE)))
        gas._names = tuple(str(name) for name in state["names"])
        gas._time = max(gas._time, float(state["time"][0]))
        return gas

    def state(self) -> dict[str, NDArray[Any]]:
        """Everything that a later run needs to go on with the same bits: a few arrays, copied."""
        return saved(self._arrays) | {"time": np.array([self._time]), "names": np.array(self._names, dtype="U32")}

    def _begin(self, arrays: Arrays) -> None:
        self._arrays = arrays
        self._time = self._last_event()
        self._cpu = 0.0

    def _last_event(self) -> float:
        one = self._arrays.swarm[0]
        return float(one["base"] + (one["rest"] + one["now"]))

    @property
    def walls(self) -> tuple[str, ...]:
        """Names of the walls, each once."""
        return tuple(dict.fromkeys(self._names))

    @property
    def faces(self) -> tuple[str, ...]:
        """Of each face the name of its wall: several may have one."""
        return self._names

    def _by_name(self, numbers: Any) -> dict[str, float]:
        """Sums over the faces of each name."""
        return {
            one: float(sum(n for n, name in zip(numbers, self._names, strict=True) if name == one))
            for one in self.walls
        }

    @property
    def time(self) -> float:
        """Time so far."""
        return self._time

    def balls(self) -> GasBalls:
        """All balls now."""
        motions, bodies, images = balls_at(self._arrays, self._time)
        x, v = (np.stack([motions[name] for name in names], axis=1) for names in (("x", "y", "z"), ("vx", "vy", "vz")))
        one = self._arrays.swarm[0]
        if one["frame"].any():
            x, v = x + one["frame"] * self._time, v + one["frame"]
            turns = np.floor(x / one["side"])
            x = np.where(one["free"] == 1, np.mod(x, one["side"]), x)
            # (modulo 2^32, as they are counted)
            images = images + np.where(one["free"] == 1, np.mod(turns, 2**32), 0).astype(np.uint32).view(np.int32)
        return GasBalls(
            time=self._time,
            position=x,
            velocity=v,
            spin=np.stack([bodies[name] for name in ("wx", "wy", "wz")], axis=1),
            species=motions["kind"].copy(),
            images=images,
        )

    def energy(self) -> tuple[float, float, float]:
        """Translational, rotational, and of height, now (J)."""
        balls = self.balls()
        kinds, one = self._arrays.species[balls.species], self._arrays.swarm[0]
        moment = kinds["kappa"] * kinds["mass"] * kinds["radius"] ** 2
        return (
            float((kinds["mass"] * (balls.velocity**2).sum(axis=1)).sum() / 2),
            float((moment * (balls.spin**2).sum(axis=1)).sum() / 2),
            -float((kinds["mass"] * ((balls.position + balls.images * one["side"]) @ one["pull"])).sum()),
        )

    @property
    def bytes_per_ball(self) -> float:
        """Memory of all arrays, a ball."""
        return sum(array.nbytes for array in self._arrays if isinstance(array, np.ndarray)) / len(self._arrays.motions)

    def run(
        self,
        collisions: int | None = None,
        until: float = math.inf,
        *,
        progress: Callable[[Gas, int], None] | None = None,
        chunk: int = CHUNK,
    ) -> GasRun:
        """Go on, by so many collisions (walls' included) or to a time, whichever comes first; what was measured meanwhile.

        ``progress`` is called after every ``chunk`` collisions with the gas and the collisions so far. An interrupt ends
        the run between chunks; the gas can go on from there. Raises CaromError where the contacts have no end (collapse), and
        where the gas has: all is at rest, or too slow for its numbers.
        """
        mark = self.mark()
        self.go_on(collisions, until, progress=progress, chunk=chunk)
        return self.measured(mark)

    def mark(self) -> Mark:
        """Begin to measure: what :meth:`measured` needs later, in this process or in another one."""
        self._arrays.swarm[0]["overlap"] = -math.inf
        one = self._arrays
        return Mark(
            one.swarm.copy()[0],
            one.pairs.copy(),
            one.walls.copy(),
            one.faces.copy(),
            self.energy(),
            self._time,
            self._cpu,
        )

    def go_on(
        self,
        collisions: int | None = None,
        until: float = math.inf,
        *,
        progress: Callable[[Gas, int], None] | None = None,
        chunk: int = CHUNK,
    ) -> None:
        """As :meth:`run`, without measuring: in how many pieces a gas goes on leaves no trace in it."""
        if collisions is None and until == math.inf:
            Faults.add(faults := Faults("Gas.run"), "until", "a number of collisions or a time", "neither")
            faults.done()
        most = 1 << 62 if collisions is None else int(collisions)
        before, done = self.collisions, 0
        while done < most:
            begin = clocks.process_time()
            advance(self._arrays, until, min(chunk, most - done))
            self._cpu += clocks.process_time() - begin
            self._time = max(self._time, self._last_event())
            done = self.collisions - before
            if progress is not None:
                progress(self, done)
            status = int(self._arrays.swarm[0]["status"])
            refuse_end(status, self._time, until)
            if status == DONE:
                self._time = max(self._time, until if until < math.inf else self._time)
                break

    @property
    def over(self) -> bool:
        """Whether nothing will ever happen any more: no ball will meet another one or a wall, or leave its cell."""
        one = self._arrays.swarm[0]
        return bool(one["planned"] == one["count"] and (self._arrays.plans["at"] == math.inf).all())

    @property
    def collisions(self) -> int:
        """Collisions so far, walls' included."""
        return int(self._arrays.swarm[0]["pair_hits"] + self._arrays.swarm[0]["wall_hits"])

    def measured(self, since: Mark) -> GasRun:
        """What was measured since then."""
        one, before, energy0, time0 = self._arrays.swarm[0], since.swarm, since.energy, since.time
        count, axes, t = int(one["count"]), int(one["axes"]), self._time - time0
        about = 3 if axes == 3 else 1
        volume = float(one["volume"])
        energy = self.energy()
        pairs, samples = int(one["pair_hits"] - before["pair_hits"]), float(one["sampled"] - before["sampled"])
        # (temperatures and pressure are those of the motion relative to the centre of mass, along free axes)
        drift = float((one["frame"] ** 2).sum() * self._arrays.species["mass"][self._arrays.motions["kind"]].sum())
        means = [
            float(one[name] - before[name]) / samples if samples > 0 else energy0[k] + energy[k] - (drift, 0.0)[k]
            for k, name in enumerate(("translational", "rotational"))
        ]
        faces = self._arrays.faces
        areas, pushes, feeds = (
            self._by_name(part) for part in (faces["area"], *(faces[k] - since.faces[k] for k in ("push", "fed")))
        )
        fed = float(one["fed"] - before["fed"])
        return GasRun(
            pair_collisions=pairs,
            wall_collisions=int(one["wall_hits"] - before["wall_hits"]),
            simulated_time=t,
            cpu_seconds=self._cpu - since.cpu,
            mean_free_time=count * t / (2 * pairs) if pairs else math.inf,
            pressure=(means[0] + float(one["virial"] - before["virial"]) / t) / (axes * volume) if t > 0 else math.nan,
            wall_pressure={k: pushes[k] / (areas[k] * t) if t > 0 else math.nan for k in areas},
            energy_from_walls=feeds,
            energy_from_thermostat=fed,
            energy_drift=(sum(energy) - fed - sum(feeds.values())) / sum(energy0) - 1 if sum(energy0) != 0 else 0.0,
            temperature_translational=means[0] / (axes * count),
            temperature_rotational=means[1] / (about * count),
            max_overlap=max(float(one["overlap"]), 0.0),
            crossings=int(one["crossings"] - before["crossings"]),
        )


def _rows(faults: Faults, name: str, given: Any, count: int, axes: int) -> Array:
    """Rows of three numbers of what was given; two are along x and y, one is about z. Zeros if nothing was."""
    rows = np.zeros((count, 3))
    if given is None:
        return rows
    array = np.array(given, dtype=float)
    if axes == 1 and array.shape == (count,):
        array = np.column_stack((np.zeros((count, 2)), array))
    if array.shape not in {(count, 3), (count, axes)} or not np.isfinite(array).all():
        faults.add(name, f"finite numbers of shape ({count}, {axes})", f"shape {array.shape}")
        return rows
    rows[:, : array.shape[1]] = array
    if (axes == 2 and rows[:, 2].any()) or (axes == 1 and rows[:, :2].any()):
        faults.add(name, "discs that stay in their plane", "numbers out of it")
    return rows


def _places(room: Container, records: Records, radius: Array, seed: int) -> Array:
    """A lattice, if the balls fit; else a dense packing of them."""
    from carom.gas.dense import dense
    from carom.gas.overlap import first_overlap

    try:
        x = lattice(len(radius), room, float(radius.max()))
    except CaromError:
        return dense(radius, room, seed=seed)
    # (the margin of a box may be more than it has)
    bad = (room.clearance(radius, x) < 0).any() or first_overlap(records.world[0], radius, x, TOUCH) is not None
    return dense(radius, room, seed=seed) if bad else x


def _refuse_overlap(room: Container, records: Records, radius: Array, x: Array, touch: float) -> None:
    """CaromError where balls overlap each other, or a wall, by more than rounding."""
    from carom.gas.overlap import first_overlap

    faults = Faults("Gas")
    out = room.clearance(radius, x) < -touch * radius
    if out.any():
        i = int(np.argmax(out))
        faults.add("position", "balls inside the container", f"ball {i} at {x[i]} overlaps a wall ({out.sum()} do)")
    faults.done()
    pair = first_overlap(records.world[0], radius, x, touch)
    if pair is not None:
        i, j = pair
        faults.add("position", "balls that do not overlap", f"balls {i} and {j}, at {x[i]} and {x[j]}")
    faults.done()


def simulate_gas(
    species: Sequence[Species],
    side: Sequence[float] | Container,
    *,
    collisions: int,
    equilibrate: int | None = None,
    **options: Any,
) -> tuple[Gas, GasRun]:
    """Make a gas (:class:`Gas` has the options), let ``equilibrate`` collisions pass (left out: 40 a ball), measure the next.

    Returns the gas at its end, and what was measured.
    """
    gas = Gas(species, side, **options)
    gas.run(40 * sum(one.count for one in species) if equilibrate is None else equilibrate)
    return gas, gas.run(collisions)
