"""What only the whole scene of a gas can tell: pairs without a contact, densities that cannot exist."""

from __future__ import annotations

import itertools
import math
from typing import TYPE_CHECKING

import numpy as np

from carom.checks import nearest
from carom.engine.swarm_arrays import MOST_BALLS, OVAL
from carom.gas.container import WALLS
from carom.gas.dense import CLOSEST
from carom.gas.section import JOIN
from carom.scene.faults import Fault, Words
from carom.units import number

if TYPE_CHECKING:
    from carom.gas.model import GasScene

__all__ = ["gas_faults"]


def gas_faults(scene: GasScene) -> list[Fault]:
    """All faults of a gas whose parts are sound."""
    if not scene.species:
        advice = "a file has a table [[species]] for each"
        return [Fault("at least one species", Words("none"), advice, ("species",))]
    parts = (_species_faults, _contact_faults, _drive_faults, _gravity_faults, _room_faults)
    return [fault for part in parts for fault in part(scene)]


def _species_faults(scene: GasScene) -> list[Fault]:
    found = []
    axes, names = scene.container.axes, [one.name for one in scene.species]
    for i, one in enumerate(scene.species):
        if one.name in names[:i]:
            found.append(Fault("a name of its own for each species", one.name, at=("species", i, "name")))
        if axes == 3 and one.kappa(3) > 2 / 3 * (1 + 1e-12):
            advice = "a disc has a container of two lengths" if one.kappa(3) <= 1 else ""
            got = number(one.kappa(3), 6) if not isinstance(one.inertia, str) else one.inertia
            found.append(
                Fault("kappa of at most 2/3, a thin shell's, for balls", Words(got), advice, ("species", i, "inertia"))
            )
    if scene.count > MOST_BALLS:
        found.append(Fault(f"at most {MOST_BALLS:,} balls", Words(f"{scene.count:,}"), at=("species",)))
    return found


def _contact_faults(scene: GasScene) -> list[Fault]:
    found = []
    names = [one.name for one in scene.species]
    walls = scene.container.room.names
    known = [*names, "wall", *dict.fromkeys((*WALLS[: 2 * scene.container.axes], *walls))]
    given: set[frozenset[str]] = set()
    sound = True
    for i, contact in enumerate(scene.contacts):
        at: tuple[int | str, ...] = ("contacts", i, "between")
        strange = [name for name in contact.between if name not in known]
        if strange:
            sound = False
            found.append(Fault("names of species, or of walls", strange[0], nearest(strange[0], known), at))
        elif not any(name in names for name in contact.between):
            found.append(Fault("at least one species", Words(_quoted(*contact.between)), at=at))
        elif frozenset(contact.between) in given:
            found.append(
                Fault("one contact for each pair", Words(f"another one for {_quoted(*contact.between)}"), at=at)
            )
        given.add(frozenset(contact.between))
    if not sound:  # what seems to be missing may be a name that is not spelled right
        return found
    for one, two in itertools.combinations_with_replacement(names, 2):
        if frozenset((one, two)) not in given:
            found.append(_missing(one, two))
    for one in names:
        if frozenset((one, "wall")) not in given:
            bare = [wall for wall in walls if frozenset((one, wall)) not in given]
            if bare:
                found.append(_missing(one, "wall" if len(bare) == len(walls) else bare[0]))
    return found


def _quoted(one: str, two: str) -> str:
    return f'["{one}", "{two}"]'


def _missing(one: str, two: str) -> Fault:
    advice = f"add a table [[contacts]] with between = {_quoted(one, two)}, restitution and friction"
    return Fault(f"a contact between {_quoted(one, two)}", Words("none"), advice, ("contacts",))


def _drive_faults(scene: GasScene) -> list[Fault]:
    found = []
    room = scene.container.room
    for i, drive in enumerate(scene.drives):
        at: tuple[int | str, ...] = ("drives", i, "wall")
        if not room.names:
            found.append(Fault("walls to drive", Words(f"none in a container of shape {room.shape!r}"), at=at))
        elif drive.wall not in room.names:
            found.append(Fault("the name of a wall", drive.wall, nearest(drive.wall, list(room.names)), at))
        elif drive.wall in [one.wall for one in scene.drives[:i]]:
            found.append(Fault("one drive for each wall", Words(f"another one for {drive.wall!r}"), at=at))
        elif drive.amplitude > 0 and (why := [w.still for w in room.walls if w.name == drive.wall and w.still]):
            at = ("drives", i, "amplitude")
            found.append(Fault("a plane wall to swing", Words(f"{drive.wall!r}, {why[0]}"), at=at))
    return found


def _gravity_faults(scene: GasScene) -> list[Fault]:
    axes = scene.container.axes
    if any(scene.pull) and not scene.container.room.walls:
        advice = 'give it walls, such as shape = "box" with periodic = ["x"]'
        return [
            Fault(
                "none where no wall holds the balls, for all would fall for ever", scene.gravity, advice, ("gravity",)
            )
        ]
    if len(scene.pull) == axes or (axes == 2 and scene.pull[2] == 0):
        return []
    return [Fault(f"one number, or {axes}", Words(f"{len(scene.pull)} numbers"), at=("gravity",))]


def _room_faults(scene: GasScene) -> list[Fault]:
    """Sides too short, and more balls than can be packed in."""
    found = []
    axes, room = scene.container.axes, scene.container.room
    widest = 2 * max(one.radius for one in scene.species)
    for axis, (length, around) in enumerate(zip(room.size, room.periodic, strict=True)):
        if length < (3 if around else 1) * widest:
            least = "3 diameters of the largest ball" if around else "the diameter of the largest ball"
            why = "in a shorter periodic box a ball could meet another and its image" if around else ""
            expected = f"at least {least}, {number(3 * widest if around else widest, 6)}"
            found.append(Fault(expected, length, why, ("container", "size", axis)))
    narrow = min((min(wall.across[:2]) for wall in room.walls if wall.form == OVAL), default=math.inf)
    if not found and widest / 2 > narrow * (1 - JOIN):
        i = int(np.argmax([one.radius for one in scene.species]))
        expected = f"a radius below the ellipse's smaller half axis, {number(narrow, 6)}"
        found.append(Fault(expected, scene.species[i].radius, at=("species", i, "radius")))
    if found or scene.container.bounds == "centre":  # (balls may then stand out)
        return found
    several = len({one.radius for one in scene.species}) > 1
    # of mixed sizes there is no bound but that balls do not fill everything
    most, share = (1.0 if several else CLOSEST[axes]), scene.fraction
    if share > most * (1 + 1e-12):
        what, name = ("area", "discs") if axes == 2 else ("volume", "balls")
        packing = f"at most {most:.4f} of the {what}, " + (
            "all of it" if several else f"the densest packing of equal {name}"
        )
        longer = (share / most) ** (1 / axes)
        advice = f"fewer {name}, smaller ones, or sides {math.ceil(longer * 1000) / 1000:g} times as long"
        found.append(Fault(f"{name} that fill {packing}", Words(f"{share:.4f}"), advice, ("species",)))
    return found
