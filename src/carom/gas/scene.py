"""Scenes of gases: all parts put together, and the checks that need more than one of them."""

from __future__ import annotations

import itertools
import math
from typing import Annotated, Any, ClassVar

import numpy as np
from numpy.typing import NDArray
from pydantic import BeforeValidator, model_validator

from carom.bodies import Surface
from carom.core.sums import added
from carom.errors import CaromError, Fault, FaultList, shown, suggestion
from carom.files import require_memory
from carom.formatting import counted, format_bytes, format_number
from carom.gas.contact_forms import ANY, GasSurface, best_contact
from carom.gas.containers import BOXES, WALLS, wall_name
from carom.gas.drives import drive_faults
from carom.gas.edmd.gas_records import ELLIPSE, MAX_BALLS
from carom.gas.faces import JOINT_OVERLAP
from carom.gas.initial import DENSEST
from carom.gas.schema import AnyContainer, GasContact, GasDrive, GasSettings, GasSpecies, GasThermostat, volume_of_balls
from carom.gas.size_distributions import LognormalRadii
from carom.gas.sizes import BYTES_PER_BALL, LONGEST_SIDE
from carom.gas.species import shear_faults
from carom.scene.plausible import FAST
from carom.scene.schema import Components, Model, Number, raise_faults

__all__ = ["GasScene", "gas_faults"]

SMALL = 0.1  # m: balls of a smaller radius are likely given in SI units
_CONTACT_TIME = Number("a time >= 0", "s", least=0)
_SHEAR_RATE = Number("a rate", "1/s")
_GRAVITY = Number("an acceleration downwards, or one number per axis", "m/s^2")


def _gravity(value: Any) -> Any:
    several = isinstance(value, (list, tuple)) or (isinstance(value, np.ndarray) and value.ndim > 0)
    return tuple(map(_GRAVITY, Components(_GRAVITY.what, (2, 3))(value))) if several else _GRAVITY(value)


class GasScene(Model):
    """A gas of balls or discs: container, species, contacts, and how it is run.

    Parameters
    ----------
    gravity : a number, downwards (balls: along -z, discs: along -y), or a vector; default: none
    shear_rate : of a periodic box: Lees-Edwards boundaries keep a mean flow along x that grows along y; default: 0
    contact_time : of the TC model: a contact within this time after a ball's last one is elastic; default: 0, off
    container : GasContainer: shape and size; two lengths: discs in a plane
    species : GasSpecies, at least one
    contacts : GasContact for every pair of species, and for every species and the walls
    drives : GasDrive, walls that move or are heated
    thermostat : GasThermostat, optional
    run : GasSettings

    Each part may be given as a dict. Numbers are in SI units, or in any consistent others. Raises CaromError, one line per
    problem, all at once.

    Examples
    --------
    >>> from carom.gas import GasScene
    >>> contact = {"between": ("a", "a"), "restitution": 0.9, "friction": 0.3}
    >>> scene = GasScene(
    ...     container={"shape": "periodic", "size": (10, 10, 10)}, species=[{"count": 500, "radius": 0.5}], contacts=[contact],
    ...     run={"max_events": 100_000},
    ... )
    >>> print(scene.describe())
    500 balls, periodic 10 x 10 x 10, packing fraction 0.2618, 100,000 events after 20,000 events of equilibration
    >>> round(scene.packing_fraction, 6)
    0.261799
    """

    where: ClassVar[str] = "gas"
    """Where errors are found; a scene of a file has the file's name."""
    gravity: Annotated[float | tuple[float, ...], BeforeValidator(_gravity)] = 0.0
    contact_time: Annotated[float, BeforeValidator(_CONTACT_TIME)] = 0.0
    shear_rate: Annotated[float, BeforeValidator(_SHEAR_RATE)] = 0.0
    container: AnyContainer
    species: tuple[GasSpecies, ...]
    contacts: tuple[GasContact, ...] = ()
    drives: tuple[GasDrive, ...] = ()
    thermostat: GasThermostat | None = None
    run: GasSettings

    @model_validator(mode="after")
    def _check(self) -> GasScene:
        raise_faults(gas_faults(self))
        return self

    @property
    def gravity_vector(self) -> tuple[float, ...]:
        """Gravity as a vector."""
        if isinstance(self.gravity, tuple):
            return self.gravity
        return (*(0.0,) * (self.container.dimensions - 1), -self.gravity)

    @property
    def count(self) -> int:
        """Total number of balls."""
        return sum(one.count for one in self.species)

    @property
    def packing_fraction(self) -> float:
        """Fraction of the volume (discs: of the area) that the balls fill."""
        axes = self.container.dimensions
        balls: float = added(
            float(volume_of_balls(one.radii, axes).sum())
            if isinstance(one.radius, LognormalRadii)
            else one.count * (math.pi if axes == 2 else 4 / 3 * math.pi) * one.radius**axes
            for one in self.species
        )
        return balls / self.container.geometry.volume

    @property
    def surfaces(self) -> dict[tuple[str, str], Surface | GasSurface]:
        """The contacts of :class:`carom.gas.Gas`."""
        return {contact.between: contact.surface for contact in self.contacts}

    @property
    def spins_change(self) -> bool:
        """Whether anything can change a spin: a contact that is not smooth, a heated wall, a thermostat."""
        rough = not all(one.is_smooth for one in self.contacts)
        return rough or self.thermostat is not None or any(one.temperature is not None for one in self.drives)

    @property
    def equilibrate(self) -> int:
        """Number of collisions before the measurement."""
        return 40 * self.count if self.run.equilibrate is None else self.run.equilibrate

    def temperature_notes(self) -> list[str]:
        """Return one line for each species that the default temperature makes fast: k_B T = 1 J is much for balls of a gram."""
        found = []
        for one in self.species:
            mass = one.nominal_mass(self.container.dimensions)
            speed = math.sqrt(one.temperature / mass)
            if "temperature" not in one.model_fields_set and speed > FAST and one.nominal < SMALL:
                found.append(
                    f"species {one.name!r}: no temperature, so k_B T = 1 J: {speed:.3g} m/s along each axis for {mass:g} kg;"
                    f" temperature = {mass:g} would be 1 m/s"
                )
        return found

    @property
    def groups(self) -> NDArray[np.int64]:
        """The species, by its number, of each class of radii: of each species of the engine."""
        return np.repeat(np.arange(len(self.species)), [len(np.unique(one.radii)) for one in self.species])

    def notes(self) -> list[str]:
        """Return one line for each species with a distribution of radii, and for each that the default temperature makes fast."""
        return [one.size_note for one in self.species if one.size_note] + self.temperature_notes()

    def describe(self) -> str:
        """Return one line: balls, container, packing fraction, length of the run."""
        kind = "disc" if self.container.dimensions == 2 else "ball"
        what = counted(self.count, kind)
        what += f" of {len(self.species)} species" if len(self.species) > 1 else ""
        density = f"packing fraction {self.packing_fraction:.4g}"
        run = [] if self.run.max_events is None else [counted(self.run.max_events, "event")]
        run += [] if self.run.duration is None else [f"a duration of {format_number(self.run.duration)}"]
        if self.count * BYTES_PER_BALL >= 1e9:
            what += f" (about {format_bytes(self.count * BYTES_PER_BALL)} of memory)"
        before = f"after {counted(self.equilibrate, 'event')} of equilibration"
        if self.run.from_time is not None:
            before += f", from t = {format_number(self.run.from_time)}"
        if self.shear_rate:
            density += f", shear rate {format_number(self.shear_rate)}"
        return f"{what}, {self.container.describe()}, {density}, {' or '.join(run)} {before}"


def gas_faults(scene: GasScene) -> list[Fault]:
    """Return all faults of a gas whose parts are valid."""
    if not scene.species:
        advice = "a file has a table [[species]] for each"
        return [Fault("", "species", "at least one species", "none", advice)]
    if found := _count_faults(scene):  # (the others look at the radii of all balls)
        return found
    parts = (_species_faults, _contact_faults, _drive_faults, _gravity_faults, _density_faults)
    return [fault for part in parts for fault in part(scene)]


def _species_faults(scene: GasScene) -> list[Fault]:
    found = FaultList()
    axes, names = scene.container.dimensions, [one.name for one in scene.species]
    for i, one in enumerate(scene.species):
        if one.name in names[:i]:
            found.add(f"species[{i}].name", "a different name for each species", shown(one.name))
        if axes == 3 and one.kappa(3) > 2 / 3 * (1 + 1e-12):
            advice = "for discs give the container two lengths" if one.kappa(3) <= 1 else ""
            got = format_number(one.kappa(3), 6) if not isinstance(one.inertia, str) else one.inertia
            found.add(f"species[{i}].inertia", "kappa of at most 2/3 for balls, that of a thin shell", got, advice)
    return found


def _count_faults(scene: GasScene) -> list[Fault]:
    if scene.count > MAX_BALLS:
        return [Fault("", "species", f"at most {MAX_BALLS:,} balls", f"{scene.count:,}")]
    try:
        require_memory("", "species", scene.count, BYTES_PER_BALL, "take fewer balls, or a larger machine")
    except CaromError as error:
        return list(error.records)
    return []


def _contact_faults(scene: GasScene) -> list[Fault]:
    found = FaultList()
    names = [one.name for one in scene.species]
    walls = scene.container.geometry.names
    axes = scene.container.dimensions
    sides = dict.fromkeys(wall_name(name, axes) for name in WALLS[: 2 * axes])
    known = [ANY, *names, "wall", *dict.fromkeys((*sides, *walls))]
    given: set[frozenset[str]] = set()
    pairs = [contact.between for contact in scene.contacts]
    names_known = True
    for i, contact in enumerate(scene.contacts):
        at = f"contacts[{i}].between"
        strange = [name for name in contact.between if name not in known]
        if strange:
            names_known = False
            found.add(at, "names of species, or of walls", shown(strange[0]), suggestion(strange[0], known))
        elif not any(name in {ANY, *names} for name in contact.between):
            found.add(at, "at least one species", _quoted(*contact.between))
        elif frozenset(contact.between) in given:
            found.add(at, "one contact for each pair", f"a second one for {_quoted(*contact.between)}")
        given.add(frozenset(contact.between))
    if not names_known:  # what seems to be missing may be a misspelled name
        return found
    for one, two in itertools.combinations_with_replacement(names, 2):
        if best_contact(pairs, one, [two]) is None:
            found.append(_missing(one, two))
    for one in names:
        bare = [wall for wall in walls if best_contact(pairs, one, [wall, "wall"]) is None]
        if bare:
            found.append(_missing(one, "wall" if len(bare) == len(walls) else bare[0]))
    return found


def _quoted(one: str, two: str) -> str:
    return f'["{one}", "{two}"]'


def _missing(one: str, two: str) -> Fault:
    advice = f"add a table [[contacts]] with between = {_quoted(one, two)}, restitution and friction"
    return Fault("", "contacts", f"a contact between {_quoted(one, two)}", "none", advice)


def _drive_faults(scene: GasScene) -> list[Fault]:
    found = FaultList()
    container = scene.container.geometry
    for i, drive in enumerate(scene.drives):
        at = f"drives[{i}].wall"
        if not container.names:
            found.add(at, "walls to drive", f"none in a container of shape {container.shape!r}")
        elif drive.wall not in container.names:
            found.add(at, "the name of a wall", shown(drive.wall), suggestion(drive.wall, list(container.names)))
        elif drive.wall in [one.wall for one in scene.drives[:i]]:
            found.add(at, "one drive for each wall", f"a second one for {drive.wall!r}")
        else:
            for field, expected, got in drive_faults(drive.drive, drive.wall, container):
                found.add(f"drives[{i}].{field}", expected, got)
    return found


def _gravity_faults(scene: GasScene) -> list[Fault]:
    axes = scene.container.dimensions
    if scene.shear_rate != 0:
        fastest = max(math.sqrt(one.temperature / one.nominal_mass(axes)) for one in scene.species)
        found = shear_faults(scene.container.geometry, scene.gravity_vector, scene.shear_rate, fastest)
        if found:
            return found
    if any(scene.gravity_vector) and not scene.container.geometry.faces:
        advice = 'add walls, such as shape = "box" with periodic = ["x"]'
        return [Fault("", "gravity", "no gravity without walls to fall on", shown(scene.gravity), advice)]
    if len(scene.gravity_vector) == axes or (axes == 2 and scene.gravity_vector[2] == 0):
        return []
    return [Fault("", "gravity", f"one number, or {axes}", f"{len(scene.gravity_vector)} numbers")]


def _density_faults(scene: GasScene) -> list[Fault]:
    """Return faults of sides that are too short, and of more balls than can be packed in."""
    found = FaultList()
    axes, container = scene.container.dimensions, scene.container.geometry
    widest = 2 * max(float(one.radii.max()) for one in scene.species)
    longest = LONGEST_SIDE * min(float(one.radii.min()) for one in scene.species)
    for axis, (length, around) in enumerate(zip(container.size, container.periodic, strict=True)):
        where, width = f"container.size[{axis}]", ""
        if container.shape not in BOXES:  # (a figure has sizes of its own)
            where, width = ("container.height", "") if axis == 2 else ("container", f"a width along {'xy'[axis]} of ")
            if found and where == "container":  # (one width is enough)
                continue
        if length < (3 if around else 1) * widest:
            least = "3 diameters of the largest ball" if around else "the diameter of the largest ball"
            why = "in a shorter periodic box a ball could meet another and its image" if around else ""
            expected = f"{width}at least {least}, {format_number(3 * widest if around else widest, 6)}"
            found.add(where, expected, shown(length), why)
        elif length > longest:
            expected = f"{width}at most {LONGEST_SIDE:g} radii of the smallest ball, {format_number(longest, 6)}"
            why = "positions would be rounded by more than such a ball can be off"
            found.add(where, expected, shown(length), why)
    narrow = min((min(wall.vector[:2]) for wall in container.faces if wall.form == ELLIPSE), default=math.inf)
    if not found and widest / 2 > narrow * (1 - JOINT_OVERLAP):
        i = int(np.argmax([one.radii.max() for one in scene.species]))
        expected = f"a radius below the ellipse's smaller half axis, {format_number(narrow, 6)}"
        found.add(f"species[{i}].radius", expected, shown(float(scene.species[i].radii.max())))
    if found or scene.container.bounds == "centre":  # (balls may then overlap the walls)
        return found
    several = len({radius for one in scene.species for radius in (one.radii.min(), one.radii.max())}) > 1
    # for mixed sizes the only bound is 1
    most, fraction = (1.0 if several else DENSEST[axes]), scene.packing_fraction
    if fraction > most * (1 + 1e-12):
        name = "discs" if axes == 2 else "balls"
        bound = "at most 1" if several else f"at most {most:.4f}, the densest packing of equal {name}"
        longer = math.ceil((fraction / most) ** (1 / axes) * 1000) / 1000
        advice = f"use fewer or smaller {name}, or sides {longer:g} times as long"
        found.add("species", f"a packing fraction of {bound}", f"{fraction:.4f}", advice)
    return found
