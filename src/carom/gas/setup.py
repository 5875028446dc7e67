"""What a gas is made of, checked, and as the records that the loop works on."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.ball import Ball
from carom.checks import Faults, expect, nearest
from carom.engine.swarm_arrays import MOST_BALLS, PAIR, SPECIES, SWARM, WALL
from carom.surface import Surface

__all__ = ["WALLS", "Contacts", "Species", "world_records"]

# The walls of a box, in the order of their records; "wall" stands for all of them.
WALLS = ("left", "right", "front", "back", "bottom", "top")
Contacts = Surface | Mapping[tuple[str, str], Surface]
NONE = (0, 0.0, 0.0, 0.0)  # what a channel has counted at first
# Cells hold about this many balls where the balls are small against their distances.
FILLING = 0.5


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


def world_records(
    species: Sequence[Species],
    side: Sequence[float],
    periodic: Any,
    contacts: Contacts,
    gravity: Any,
    contact_time: float,
) -> tuple[NDArray[np.void], ...]:
    """Records of the swarm, of species, pairs and walls; CaromError with every fault."""
    faults = Faults("Gas")
    for one in species:
        expect("Gas", "species", one, Species)
    names = [one.name for one in species]
    count = sum(one.count for one in species)
    if not names or min(one.count for one in species) < 0 or not 0 < count <= MOST_BALLS:
        faults.add("species", f"1 to {MOST_BALLS} balls in all", f"{[one.count for one in species]}")
    if len(set(names)) < len(names):
        faults.add("species", "a name of its own for each", f"{names}")
    size = np.array(side, dtype=float)
    if size.shape not in {(2,), (3,)} or not (np.isfinite(size) & (size > 0)).all():
        faults.add("side", "two or three lengths > 0", f"{side!r}")
    pull = np.array(gravity, dtype=float)
    if pull.shape not in {(3,), size.shape} or not np.isfinite(pull).all():
        faults.add("gravity", f"{len(size)} numbers", f"{gravity!r}")
    if not 0 <= contact_time < math.inf:
        faults.add("contact_time", "a time >= 0", f"{contact_time!r}")
    if not isinstance(contacts, Surface):
        known = [*names, "wall", *WALLS]
        for name in sorted({name for key in contacts for name in key} - set(known)):
            faults.add("contacts", "names of species or walls", f"{name!r}; {nearest(name, known)}")
    faults.done()
    axes = len(size)
    closed = np.broadcast_to(np.array(periodic, dtype=bool), (axes,))
    world = np.zeros(1, SWARM)
    one = world[0]
    one["axes"], one["side"], one["periodic"], one["cells"], one["size"] = axes, 1.0, 1, 1, 1.0
    one["side"][:axes], one["periodic"][:axes] = size, closed
    one["pull"][: len(pull)] = pull
    one["soft"] = contact_time
    if axes == 2 and one["pull"][2] != 0:
        faults.add("gravity", "nothing along z for discs", f"{gravity!r}")
    widest = 2 * max(float(one.ball.radius) for one in species)
    # cells of at least a diameter, and not many more of them than balls
    width = max(widest, (FILLING * size.prod() / count) ** (1 / axes))
    for axis in range(axes):
        n = max(int(size[axis] / width), min(3, int(size[axis] / widest)))
        if n < (3 if closed[axis] else 1):
            least = "three diameters" if closed[axis] else "one diameter"
            faults.add(
                "side", f"at least {least} of the largest ball ({widest:g})", f"{size[axis]:g} along axis {axis}"
            )
        one["cells"][axis], one["size"][axis] = n, size[axis] / max(n, 1)
    kinds = np.zeros(len(species), SPECIES)
    pairs, walls = np.zeros(len(species) ** 2, PAIR), np.zeros(6 * len(species), WALL)
    for i, first in enumerate(species):
        ball = first.ball
        kinds[i] = (ball.radius, ball.mass, ball.kappa)
        for j, second in enumerate(species):
            surface = _surface(faults, contacts, first.name, [second.name])
            e, mu, beta = _numbers(surface)
            reach = ball.radius + second.ball.radius
            pairs[i * len(species) + j] = (reach, reach * reach, e, mu, beta, mu == 0 or beta == -1, *NONE)
        for k, wall in enumerate(WALLS[: 2 * axes]):
            if not closed[k // 2]:
                surface = _surface(faults, contacts, first.name, [wall, "wall"])
                walls[k * len(species) + i] = (*_numbers(surface), *NONE)
    faults.done()
    return world, kinds, pairs, walls
