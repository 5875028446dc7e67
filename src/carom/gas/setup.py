"""What a gas is made of, checked, and as the records that the loop works on."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.ball import Ball
from carom.checks import Faults, expect, nearest
from carom.engine.swarm_arrays import FACE, MOST_BALLS, OVAL, PAIR, SPECIES, SWARM, WALL
from carom.gas.container import WALLS, Container
from carom.gas.drive import Drive, Thermostat
from carom.gas.section import JOIN
from carom.surface import Surface

__all__ = ["WALLS", "Contacts", "Records", "Species", "world_records"]

Contacts = Surface | Mapping[tuple[str, str], Surface]
NONE = (0, 0.0, 0.0, 0.0)  # what a channel has counted at first
# Cells hold about this many balls where the balls are small against their distances.
FILLING = 0.5
# Of the largest radius: centres so far behind a wall that bounds centres overlap it (snapshots are in single precision).
DEEP = 1e-4


class Records(NamedTuple):
    """What the engine is told of a gas, but for its balls."""

    world: NDArray[np.void]
    kinds: NDArray[np.void]
    pairs: NDArray[np.void]
    walls: NDArray[np.void]
    faces: NDArray[np.void]


@dataclass(frozen=True)
class Species:
    """Balls of one kind: their number, what each is, and how warm they start.

    ``temperature`` is k_B T: the mean of m v^2 along each axis; ``temperature_rotational``, of I w^2 about each axis of spin,
    is the same unless given; 0 starts without spin.
    """

    ball: Ball
    count: int
    name: str = "a"
    temperature: float = 1.0
    temperature_rotational: float | None = None


def _surface(faults: Faults, contacts: Contacts, one: str, others: Sequence[str]) -> Surface:
    """The surface between a species and the first of others that has one."""
    if isinstance(contacts, Surface):
        return contacts
    for other in others:
        for key in ((one, other), (other, one)):
            if key in contacts:
                return contacts[key]
    faults.add("contacts", f"a Surface for ({one!r}, {others[-1]!r})", f"keys {sorted(contacts)}")
    return Surface()


def _numbers(surface: Surface) -> tuple[float, float, float]:
    return float(surface.restitution), float(surface.friction), float(surface.tangential_restitution)


def _cells(faults: Faults, one: Any, room: Container, widest: float, count: int) -> None:
    """Cells of at least a diameter, and not many more of them than balls."""
    size, axes = np.array(room.size), len(room.size)
    width = max(widest, (FILLING * size.prod() / count) ** (1 / axes))
    for axis in range(axes):
        n = max(int(size[axis] / width), min(3, int(size[axis] / widest)))
        if n < (3 if room.periodic[axis] else 1):
            least = "three diameters" if room.periodic[axis] else "one diameter"
            faults.add(
                "side", f"at least {least} of the largest ball ({widest:g})", f"{size[axis]:g} along axis {axis}"
            )
        one["cells"][axis], one["size"][axis] = n, size[axis] / max(n, 1)


def _faces(faults: Faults, room: Container, drives: Mapping[str, Drive], widest: float) -> NDArray[np.void]:
    """Records of the walls, with what drives them."""
    faces = np.zeros(len(room.walls), FACE)
    for name in sorted(set(drives) - set(room.names)):
        faults.add("drives", "names of walls", f"{name!r}; {nearest(name, list(room.names))}")
    for face, wall in zip(faces, room.walls, strict=True):
        face["form"], face["area"], face["warm"] = wall.form, wall.area, -1.0
        for part, numbers in (("n", wall.across), ("m", wall.centre), ("a", wall.along)):
            for axis, number in zip("xyz", numbers, strict=True):
                face[part + axis] = number
        face["bounded"], face["low"], face["high"] = wall.ends, wall.low, wall.high
        if not wall.thick:
            face["deep"] = DEEP * widest
        drive = drives.get(wall.name)
        if drive is None:
            continue
        if drive.amplitude > 0:
            if wall.still:
                faults.add("drives", "an amplitude for plane walls only", f"one for {wall.name!r}, {wall.still}")
            face["swing"], face["half"] = drive.amplitude, 0.5 / drive.frequency
            face["start"] = -drive.phase / drive.frequency
        if drive.temperature is not None:
            face["warm"] = drive.temperature
            face["warm_spin"] = (
                drive.temperature if drive.temperature_rotational is None else drive.temperature_rotational
            )
    return faces


def world_records(
    species: Sequence[Species],
    room: Container,
    contacts: Contacts,
    gravity: Any,
    contact_time: float,
    drives: Mapping[str, Drive],
    thermostat: Thermostat | None,
    seed: int,
) -> Records:
    """Records of the swarm, of species, pairs, walls with species, and walls; CaromError with every fault."""
    faults = Faults("Gas")
    for one in species:
        expect("Gas", "species", one, Species)
    names = [one.name for one in species]
    count = sum(one.count for one in species)
    if not names or min(one.count for one in species) < 0 or not 0 < count <= MOST_BALLS:
        faults.add("species", f"1 to {MOST_BALLS} balls in all", f"{[one.count for one in species]}")
    if len(set(names)) < len(names):
        faults.add("species", "a name of its own for each", f"{names}")
    axes = len(room.size)
    pull = np.array(gravity, dtype=float)
    if pull.shape not in {(3,), (axes,)} or not np.isfinite(pull).all():
        faults.add("gravity", f"{axes} numbers", f"{gravity!r}")
    elif axes == 2 and pull[2:].any():
        faults.add("gravity", "nothing along z for discs", f"{gravity!r}")
    if not 0 <= contact_time < math.inf:
        faults.add("contact_time", "a time >= 0", f"{contact_time!r}")
    if not isinstance(contacts, Surface):
        known = [*names, "wall", *dict.fromkeys((*WALLS, *room.names))]
        for name in sorted({name for key in contacts for name in key} - set(known)):
            faults.add("contacts", "names of species or walls", f"{name!r}; {nearest(name, known)}")
    faults.done()
    world = np.zeros(1, SWARM)
    one = world[0]
    one["axes"], one["side"], one["periodic"], one["cells"], one["size"] = axes, 1.0, 1, 1, 1.0
    one["side"][:axes], one["periodic"][:axes], one["volume"] = room.size, room.periodic, room.volume
    one["pull"][: len(pull)] = pull
    one["soft"], one["scale"] = contact_time, 1.0
    # the engine's random numbers are its own stream: seeds that follow each other have nothing in common
    one["key"] = np.random.SeedSequence(seed).generate_state(2).astype(np.int64)
    if thermostat is not None:
        one["rate"], one["warm"] = thermostat.rate * count, thermostat.temperature
        rotational = thermostat.temperature_rotational
        one["warm_spin"] = thermostat.temperature if rotational is None else rotational
    widest = max(float(one.ball.radius) for one in species)
    _cells(faults, one, room, 2 * widest, count)
    for wall in room.walls:
        if wall.form == OVAL and not widest < min(wall.across[:2]) * (1 - JOIN):
            faults.add(
                "species", f"radii below {min(wall.across[:2]):g}, the ellipse's smaller half axis", f"{widest:g}"
            )
    faces = _faces(faults, room, drives, widest)
    kinds = np.zeros(len(species), SPECIES)
    pairs, walls = np.zeros(len(species) ** 2, PAIR), np.zeros(len(faces) * len(species), WALL)
    for i, first in enumerate(species):
        ball = first.ball
        kinds[i] = (ball.radius, ball.mass, ball.kappa)
        for j, second in enumerate(species):
            surface = _surface(faults, contacts, first.name, [second.name])
            e, mu, beta = _numbers(surface)
            reach = ball.radius + second.ball.radius
            pairs[i * len(species) + j] = (reach, reach * reach, e, mu, beta, mu == 0 or beta == -1, *NONE)
        for k, wall in enumerate(room.walls):
            surface = _surface(faults, contacts, first.name, [wall.name, "wall"])
            walls[k * len(species) + i] = (*wall.keep(float(ball.radius)), *_numbers(surface), *NONE)
    faults.done()
    return Records(world, kinds, pairs, walls, faces)
