"""Gases of rough or smooth balls or discs, by event-driven molecular dynamics."""

from __future__ import annotations

import math
import time as clocks
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.core.random import added
from carom.errors import CaromError, FaultList, float_or_nan, require_count
from carom.formatting import counted, format_number
from carom.gas.containers import Container, as_container
from carom.gas.drives import Drive, Thermostat, WallMotion, motion_of_walls
from carom.gas.edmd import driver as engine
from carom.gas.edmd.driver import GasArrays, SystemRecords
from carom.gas.edmd.gas_records import COLLAPSED, DONE, HEAT, UNDERFLOW, Averages
from carom.gas.initial import dense, first_overlap, lattice, thermal
from carom.gas.results import (
    AT_REST,
    COLLAPSE,
    TOO_SLOW,
    EarlyEnd,
    EndedEarlyError,
    GasBalls,
    GasRun,
    Mark,
    ShearRun,
    averages_between,
    collapse_of,
)
from carom.gas.scene import GasScene, scene_of_parts
from carom.gas.species import Contacts, Kind, SizeClasses, Species, system_records
from carom.public.progress import Progress, loop_callback

Array = NDArray[np.float64]
TOUCH = 1e-9  # of a radius: balls that overlap by less count as touching


def vectors(faults: FaultList, name: str, given: Any, count: int, axes: int) -> Array:
    """Return given vectors as (count, 3): two components are along x and y, one is about z. Zeros if nothing was given."""
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
        faults.add(name, "vectors in the plane of the discs (spins: normal to it)", "other components")
    return rows


def start_positions(container: Container, records: SystemRecords, radius: Array, seed: int) -> Array:
    """Return positions on a lattice if the balls fit, else a dense random packing."""
    try:
        x = lattice(len(radius), container, float(radius.max()))
    except CaromError:
        return dense(radius, container, seed=seed)
    # (the margin of a box may be more than it has)
    bad = (container.clearance(radius, x) < 0).any() or first_overlap(records.system[0], radius, x, TOUCH) is not None
    return dense(radius, container, seed=seed) if bad else x


def require_no_overlap(container: Container, records: SystemRecords, radius: Array, x: Array, touch: float) -> None:
    """Raise CaromError where balls overlap each other, or a wall, by more than rounding."""
    faults = FaultList("Gas")
    out = container.clearance(radius, x) < -touch * radius
    if out.any():
        i = int(np.argmax(out))
        faults.add(
            "position", "balls inside the container", f"ball {i} at {x[i]} overlaps a wall ({out.sum()} of {len(x)} do)"
        )
    faults.raise_if_any()
    pair = first_overlap(records.system[0], radius, x, touch)
    if pair is not None:
        i, j = pair
        faults.add("position", "balls that do not overlap", f"balls {i} and {j}, at {x[i]} and {x[j]}")
    faults.raise_if_any()


def draw_thermal(
    memory: Mapping[str, NDArray[Any]],
    kinds: Sequence[Kind],
    which: Any,
    axes: int,
    rng: Any,
    velocities: bool,
    spins: bool,
) -> None:
    """Draw what is asked for, velocities or spins or both, kind by kind, into the records of a gas."""
    about = (0, 1, 2) if axes == 3 else (2,)
    for number, one in enumerate(kinds):
        those: Any = slice(None) if len(kinds) == 1 else which == number
        moment = one.kappa * one.mass * one.radius**2
        drawn = [("motions", "v", one.mass, tuple(range(axes)), one.temperature)] * velocities
        drawn += [("bodies", "w", moment, about, one.temperature_rotational)] * spins
        for records, letter, inertia, along, temperature in drawn:
            rows = thermal(np.full(one.count, inertia), along, temperature, rng)
            for k in range(3):
                memory[records][f"{letter}{'xyz'[k]}"][those] = rows[:, k]
            del rows  # (of many balls they are large)


def records_of(scene: GasScene) -> tuple[SystemRecords, SizeClasses]:
    """Return the records of the gas of a scene without its balls, and its kinds of balls."""
    container = scene.container.geometry
    sizes, drives = SizeClasses.of(scene.species, len(container.size)), {one.wall: one for one in scene.drives}
    return system_records(
        sizes.kinds, container, scene.contacts, scene.gravity_vector, scene.contact_time, drives, scene.thermostat,
        scene.run.seed, scene.shear_rate,
    ), sizes  # fmt: skip


# ----------------------------------------------------------------------------------------------------
# Gases of rough or smooth balls or discs, by event-driven molecular dynamics.


CHUNK = 200_000  # collisions between two checks for progress and interrupts: some tenths of a second


class Gas:
    """A gas of balls or discs in a periodic box or another container.

    Parameters
    ----------
    species : sequence of Species
    side : two (discs) or three lengths, or a Container
        The box [0, side], whose walls bound the balls' surfaces; or any :func:`carom.gas.container`.
    periodic : bool, or one for each axis
        Of a box given by its lengths.
    contacts : Surface, or a mapping of pairs of names to Surfaces
        Needed; a gas takes no custom laws. Names of species; ``"wall"`` for all walls, or a wall's own name.
    gravity : vector
        Acceleration (m/s^2).
    contact_time : float
        Of the TC model (s): a contact within this time after a ball's last one is elastic along the normal, which prevents
        inelastic collapse (Luding & McNamara, Granular Matter 1, 113 (1998)); from a wall on which gravity or the wall's
        curvature presses it, a ball leaves at least so fast that it returns after that time. 0: off.
    drives : mapping of walls' names to Drives
        Walls that oscillate or are heated.
    thermostat : Thermostat, optional
    shear_rate : float
        Of a periodic box (1/s): Lees-Edwards boundaries keep the mean flow ``shear_rate (y - side[1] / 2)`` along x. Given
        velocities include the flow; to drawn ones it is added. Temperatures, stresses and the energy are relative to it.
    position, velocity, spin : (N, 3) or (N, 2) arrays, spin of discs (N,)
        Default: positions on a lattice, or where balls do not fit on one, of :func:`carom.gas.dense`; random velocities and
        spins with the species' temperatures and no total momentum.
    seed : int
        Of the start, and of heated walls and the thermostat.
    touch : float
        Balls that overlap by less than this share of a radius count as touching. Positions in single precision need 1e-5.

    Raises CaromError, one line per problem.

    The method is event-driven molecular dynamics with a cell list and a calendar queue (:mod:`carom.gas.edmd.loop`): the motion
    between events and the instants of collision are exact, up to rounding.

    Examples
    --------
    >>> from carom import Ball, Surface
    >>> from carom.gas import Gas, Species
    >>> gas = Gas([Species(Ball(0.5, 1.0), 64)], (6.0, 6.0, 6.0), contacts=Surface(0.9, 0.3, 0.5), seed=1)
    >>> run = gas.run(1000)
    >>> gas.collisions, run.pair_collisions
    (1000, 1000)
    >>> sum(gas.energy()) < 64 * 3  # the contacts dissipate energy
    True
    """

    def __init__(
        self,
        species: Sequence[Species],
        side: Sequence[float] | Container,
        *,
        periodic: bool | Sequence[bool] = True,
        contacts: Contacts | None = None,
        gravity: Sequence[float] = (0.0, 0.0, 0.0),
        contact_time: float = 0.0,
        drives: Mapping[str, Drive] | None = None,
        thermostat: Thermostat | None = None,
        shear_rate: float = 0.0,
        position: ArrayLike | None = None,
        velocity: ArrayLike | None = None,
        spin: ArrayLike | None = None,
        seed: int = 0,
        touch: float = TOUCH,
    ) -> None:
        parts = {
            "container": as_container(side, periodic), "species": species, "contacts": contacts, "gravity": gravity,
            "contact_time": contact_time, "drives": drives or {}, "thermostat": thermostat, "shear_rate": shear_rate,
        }  # fmt: skip
        self._start(scene_of_parts("Gas", parts, {"seed": seed}), position, velocity, spin, touch)

    @classmethod
    def of_scene(cls, scene: GasScene, **start: Any) -> Gas:
        """Return the gas of a scene at its start, from the positions, velocities and spins that are given, if there are any."""
        gas = object.__new__(cls)
        gas._start(scene, **start)
        return gas

    def _start(
        self, scene: GasScene, position: Any = None, velocity: Any = None, spin: Any = None, touch: float = TOUCH
    ) -> None:
        container, seed, shear_rate = scene.container.geometry, scene.run.seed, scene.shear_rate
        records, sizes = records_of(scene)
        kinds, axes, which = records.species, len(container.size), sizes.which
        faults = FaultList("Gas")
        rng = np.random.default_rng(seed)
        if position is None:
            which = rng.permutation(which)
            x = start_positions(container, records, kinds["radius"][which], seed)
        else:
            x = vectors(faults, "position", position, len(which), axes)
        v = None if velocity is None else vectors(faults, "velocity", velocity, len(which), axes)
        w = None if spin is None else vectors(faults, "spin", spin, len(which), 3 if axes == 3 else 1)
        faults.raise_if_any()
        require_no_overlap(container, records, kinds["radius"][which], x, touch)
        memory = engine.put_in_place(records, which, x)
        del x
        draw_thermal(memory, sizes.kinds, which, axes, rng, velocity is None, spin is None)
        if shear_rate != 0 and velocity is None:
            memory["motions"]["vx"] += shear_rate * (memory["motions"]["y"] - container.size[1] / 2)
        self._names = tuple(face.name for face in container.faces)
        self.groups = sizes.groups  # the species of each of the engine's, of which one has several if its radii differ
        self._begin(engine.arrays_at_start(records, memory, v, w))

    def __repr__(self) -> str:
        """Return one line: number of balls, container, simulated time, collisions.

        >>> from carom import Ball, Surface
        >>> from carom.gas import Gas, Species
        >>> Gas([Species(Ball(0.5, 1.0), 64)], (6.0, 6.0, 6.0), contacts=Surface(1, 0, -1))
        <Gas: 64 balls in 6 x 6 x 6, periodic x, y and z; t = 0, 0 collisions>
        """
        one = self.arrays.system[0]
        axes = int(one["dimensions"])
        size = " x ".join(format_number(float(length), 4) for length in one["side"][:axes])
        around = [name for name, k in zip("xyz", one["periodic"][:axes], strict=False) if k == 1]
        borders = [f"periodic {', '.join(around[:-1])}{' and ' if around[1:] else ''}{around[-1]}"] if around else []
        borders += [f"walls {', '.join(self.walls)}"] if self.walls else []
        balls = counted(int(one["balls"]), "disc" if axes == 2 else "ball")
        done = counted(self.collisions, "collision")
        return f"<Gas: {balls} in {', '.join([size, *borders])}; t = {format_number(self._time, 6)}, {done}>"

    @classmethod
    def restore(cls, state: Mapping[str, NDArray[Any]]) -> Gas:
        """Return the gas with a :meth:`state`; it continues with the same bits."""
        gas = object.__new__(cls)
        gas._begin(engine.restore(state))
        gas._names = tuple(str(name) for name in state["names"])
        gas.groups = state["groups"].copy()
        gas._time = max(gas._time, float(state["time"][0]))
        return gas

    def state(self) -> dict[str, NDArray[Any]]:
        """Return all that a later run needs to continue with the same bits, as copies of a few arrays."""
        return {name: np.concatenate(list(blocks)) for name, (_length, blocks) in self.saved().items()}

    def saved(self) -> dict[str, tuple[int, Iterator[NDArray[Any]]]]:
        """Return the arrays of the :meth:`state`: of each its length, and copies block by block."""
        own = {"time": np.array([self._time]), "names": np.array(self._names, dtype="U32"), "groups": self.groups}
        return {name: engine.saved_blocks(self.arrays, name) for name in engine.STATE} | {
            name: (len(array), iter([array])) for name, array in own.items()
        }

    def _begin(self, arrays: GasArrays) -> None:
        self.arrays = arrays  # of the engine; not to be changed from outside
        self._time = engine.time_of_last_event(self.arrays)
        self.cpu_seconds, self._compiled = 0.0, False  # of the event loop
        self.ended_early: EarlyEnd | None = None  # why the last run ended before the collisions or the time asked for

    @property
    def walls(self) -> tuple[str, ...]:
        """Names of the walls, each once."""
        return tuple(dict.fromkeys(self._names))

    @property
    def faces(self) -> tuple[str, ...]:
        """For each face the name of its wall; several may have the same."""
        return self._names

    def _sum_by_wall(self, numbers: Any) -> dict[str, float]:
        """Return sums over the faces of each wall."""
        return {
            one: float(sum(n for n, name in zip(numbers, self._names, strict=True) if name == one))
            for one in self.walls
        }

    @property
    def shear_rate(self) -> float:
        """The shear rate (1/s), 0 without one."""
        return float(self.arrays.shear["rate"].sum())

    @property
    def time(self) -> float:
        """The simulated time so far."""
        return self._time

    def balls(self) -> GasBalls:
        """Return all balls at the current time."""
        count = len(self.arrays.balls.motions)
        position, velocity, spin = (np.empty((count, 3)) for _ in range(3))
        species, images = np.empty(count, np.uint32), np.empty((count, 3), np.int32)
        for rows, part in self.blocks():
            position[rows], velocity[rows], spin[rows] = part.position, part.velocity, part.spin
            species[rows], images[rows] = part.species, part.images
        return GasBalls(self._time, position, velocity, spin, species, images)

    def blocks(self) -> Iterator[tuple[slice, GasBalls]]:
        """Yield the balls at the current time block by block: which, and these. Of large gases no second copy is in memory."""
        one = self.arrays.system[0]
        for rows, motions, bodies, turned in engine.synchronized_blocks(self.arrays, self._time):
            images = turned
            x, v = (
                np.stack([motions[name] for name in names], axis=1) for names in (("x", "y", "z"), ("vx", "vy", "vz"))
            )
            if one["frame"].any():
                x, v = x + one["frame"] * self._time, v + one["frame"]
                turns = np.floor(x / one["side"])
                x = np.where(one["free"] == 1, np.mod(x, one["side"]), x)
                # (modulo 2^32, as they are counted)
                images = turned + np.where(one["free"] == 1, np.mod(turns, 2**32), 0).astype(np.uint32).view(np.int32)
            spin = np.stack([bodies[name] for name in ("wx", "wy", "wz")], axis=1)
            yield rows, GasBalls(self._time, x, v, spin, motions["species"].copy(), images)

    def energy(self) -> tuple[float, float, float]:
        """Return the translational, rotational and potential energy at the current time (J), of a sheared gas without the flow."""
        one, found = self.arrays.system[0], np.zeros(3)
        for _, balls in self.blocks():
            balls.velocity[:, 0] -= self.shear_rate * (balls.position[:, 1] - one["side"][1] / 2)
            kinds = self.arrays.materials.species[balls.species]
            moment = kinds["kappa"] * kinds["mass"] * kinds["radius"] ** 2
            found += (
                (kinds["mass"] * (balls.velocity**2).sum(axis=1)).sum() / 2,
                (moment * (balls.spin**2).sum(axis=1)).sum() / 2,
                -(kinds["mass"] * ((balls.position + balls.images * one["side"]) @ one["gravity"])).sum(),
            )
        return float(found[0]), float(found[1]), float(found[2])

    def wall_motion(self, *, oscillating: bool = False) -> dict[str, WallMotion]:
        """Return place and speed of each wall that moves, or the spins of its obstacles, at the current time, by its name.

        With ``oscillating`` also of walls that do so.
        """
        one, faces = self.arrays.system[0], self.arrays.walls.faces
        now = (self._time - one["base"]) - one["rest"]
        return motion_of_walls(faces, self._names, now, oscillating)

    @property
    def bytes_per_ball(self) -> float:
        """Memory of all arrays, per ball."""
        return engine.total_bytes(self.arrays) / len(self.arrays.balls.motions)

    def run(
        self,
        collisions: int | None = None,
        until: float = math.inf,
        *,
        progress: Progress | None = None,
        chunk: int = CHUNK,
    ) -> GasRun:
        """Advance by so many collisions (with walls included) or to a time, whichever comes first, and measure meanwhile.

        ``progress`` is called after every ``chunk`` collisions with their number and the one asked for, or NaN. An interrupt ends
        the run between chunks; the gas can continue from there. Raises :class:`carom.gas.EndedEarlyError`, a CaromError that holds
        what was measured until then, for an inelastic collapse (a few balls collide infinitely often in a finite time), and where
        all balls are at rest, or too slow for double precision.
        """
        mark = self.mark()
        try:
            self.advance(collisions, until, progress=progress, chunk=chunk)
        except EndedEarlyError as error:
            error.result = self.measured_since(mark)
            raise
        return self.measured_since(mark)

    def integrals(self) -> Averages:
        """Return the integrals over time, until now, of what :class:`carom.gas.results.TimeAverages` are made of."""
        return engine.averages_until(self.arrays, self._time)

    def measure_heat(self) -> None:
        """Measure the heat current, and by which angles balls turn, from now on, until the gas is restored from a state."""
        if len(self.arrays.heat) == 0:
            heat = np.zeros(1, HEAT)
            heat["spins"] = not self.arrays.materials.pairs["smooth"].all()
            turned = np.zeros((len(self.arrays.balls.motions), 3))
            self.arrays, self._compiled = self.arrays._replace(heat=heat, turned=turned), False

    def heat_passed(self) -> Array:
        """Return the integral over time of the heat current (J m), (dimensions,), from :meth:`measure_heat` on."""
        return engine.heat_until(self.arrays, self._time)

    def turned(self) -> Array:
        """Return the integral over time of each ball's spin (rad), (N, 3), from :meth:`measure_heat` on."""
        return engine.turned_until(self.arrays, self._time)

    def mark(self) -> Mark:
        """Begin a measurement: return what :meth:`measured_since` needs, in this process or in another one."""
        self.arrays.system[0]["overlap"] = -math.inf
        one, averages = self.arrays, self.integrals()
        totals = (one.materials.pairs.copy(), one.walls.contacts.copy(), one.walls.faces.copy())
        return Mark(one.system.copy()[0], *totals, *averages, self.energy(), self._time, self.cpu_seconds)

    def advance(
        self,
        collisions: int | None = None,
        until: float = math.inf,
        *,
        progress: Progress | None = None,
        chunk: int = CHUNK,
        stop: Callable[[], bool] = lambda: False,
    ) -> None:
        """Advance as :meth:`run` does, without measuring, or until ``stop``, asked some times a second, returns True.

        The result does not depend on how a run is divided into pieces.
        """
        total = math.nan if collisions is None else float_or_nan(collisions)
        tell = loop_callback(progress, lambda now: lambda done: now(done, total, "collisions"))
        for done in self.pieces(collisions, until, chunk=chunk, stop=stop):
            if tell is not None:
                tell(done)

    def pieces(
        self,
        collisions: int | None = None,
        until: float = math.inf,
        *,
        chunk: int = CHUNK,
        stop: Callable[[], bool] = lambda: False,
    ) -> Iterator[int]:
        """Advance as :meth:`advance` does, piece by piece of so many collisions; yield after each how many there have been."""
        faults = FaultList("Gas.run")
        if isinstance(until, bool) or math.isnan(end := float_or_nan(until)):
            faults.add("until", "a time, or inf", f"{until!r}")
        elif collisions is None and end == math.inf:
            faults.add("until", "a number of collisions or a time", "neither")
        faults.attempt(require_count, "Gas.run", "collisions", 0 if collisions is None else collisions, 0)
        faults.attempt(require_count, "Gas.run", "chunk", chunk)
        faults.raise_if_any()
        most = 1 << 62 if collisions is None else int(collisions)
        before, done, self.ended_early = self.collisions, 0, None
        if not self._compiled:  # (nothing happens before that time: this compiles the loop, whose time is not measured)
            engine.advance(self.arrays, -1.0, 1, stop)
            self._compiled = True
        while done < most:
            begin = clocks.thread_time()
            # (a number of the type float: a whole one would have the loop compiled again)
            engine.advance(self.arrays, end, min(chunk, most - done), stop)
            self.cpu_seconds += clocks.thread_time() - begin
            self._time = max(self._time, engine.time_of_last_event(self.arrays))
            done = self.collisions - before
            yield done
            status = int(self.arrays.system[0]["status"])
            self._raise_if_ended(status, until)
            if status == DONE:
                self._time = max(self._time, until if until < math.inf else self._time)
            if status == DONE or stop():
                break

    def _raise_if_ended(self, status: int, until: float) -> None:
        """Raise EndedEarlyError where the engine cannot continue, or will never have the collisions asked for."""
        if status == COLLAPSED:
            self.raise_early(collapse_of(self.arrays, self._time))
        elif status == UNDERFLOW:
            self.raise_early(EarlyEnd(TOO_SLOW, self._time))
        elif status == DONE and until == math.inf:
            self.raise_early(EarlyEnd(AT_REST, self._time))

    def raise_early(self, end: EarlyEnd) -> None:
        """Note why the run ends early, and raise EndedEarlyError."""
        self.ended_early = end
        one = self.arrays.system[0]
        pairs = int(one["pair_collisions"]) - (end.collisions or 0)
        raise EndedEarlyError.of(end, float(one["balls"]) * self._time / (2 * pairs) if pairs > 0 else math.inf)

    @property
    def at_rest(self) -> bool:
        """Whether nothing will ever happen: no ball will collide or leave its cell."""
        one = self.arrays.system[0]
        return bool(one["planned"] == one["balls"] and (self.arrays.balls.plans["event_time"] == math.inf).all())

    @property
    def collisions(self) -> int:
        """Number of collisions so far, with walls included."""
        return int(self.arrays.system[0]["pair_collisions"] + self.arrays.system[0]["wall_collisions"])

    def measured_since(self, since: Mark) -> GasRun:
        """Return the measurements since a :meth:`mark`."""
        one, before, energy0, t = self.arrays.system[0], since.system, since.energy, self._time - since.time
        count, energy = int(one["balls"]), self.energy()
        pairs = int(one["pair_collisions"] - before["pair_collisions"])
        means = averages_between(self.arrays, since, self.integrals(), t, self.groups)
        faces = self.arrays.walls.faces
        areas, pushes, feeds = (
            self._sum_by_wall(part)
            for part in (faces["area"], *(faces[k] - since.faces[k] for k in ("impulse", "energy")))
        )
        fed = float(one["thermostat_energy"] - before["thermostat_energy"])
        sheared = None if self.shear_rate == 0 else ShearRun.of(self.shear_rate, means, float(one["volume"]) * t)
        worked = 0.0 if sheared is None else sheared.energy
        return GasRun(
            pair_collisions=pairs,
            wall_collisions=int(one["wall_collisions"] - before["wall_collisions"]),
            simulated_time=t,
            cpu_seconds=self.cpu_seconds - since.cpu,
            mean_free_time=_mean_free_time(count, t, pairs, self.ended_early),
            pressure=means.pressure,
            wall_pressure={k: pushes[k] / (areas[k] * t) if t > 0 else math.nan for k in areas},
            energy_from_walls=feeds,
            energy_from_thermostat=fed,
            energy_drift=(added(energy) - fed - worked - added(feeds.values())) / added(energy0) - 1
            if added(energy0) != 0
            else 0.0,
            temperature_translational=means.temperature,
            temperature_rotational=means.temperature_rotational,
            averages=means,
            max_overlap=max(float(one["overlap"]), 0.0),
            crossings=int(one["crossings"] - before["crossings"]),
            ended_early=self.ended_early,
            shear=sheared,
        )


def _mean_free_time(count: int, t: float, pairs: int, end: EarlyEnd | None) -> float:
    """Return the mean free time of a ball, without the collisions of a collapse; nan where these cannot be told from the others."""
    if end is not None and end.kind == COLLAPSE:
        if end.collisions is None or end.collisions >= pairs > 0:
            return math.nan
        pairs -= end.collisions
    return count * t / (2 * pairs) if pairs > 0 else math.inf
