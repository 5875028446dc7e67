"""Scenes of gases: all parts put together, and the checks that need more than one of them."""

from __future__ import annotations

import itertools
import math
from dataclasses import replace
from importlib.resources import files
from pathlib import Path
from typing import Annotated, Any, ClassVar

import numpy as np
from numpy.typing import NDArray
from pydantic import BeforeValidator, model_validator
from pydantic_core import PydanticCustomError

from carom.core.random import added
from carom.errors import CaromError, Fault, FaultList, require_type, shown, suggestion
from carom.files import as_path, require_memory
from carom.formatting import counted, format_bytes, format_number
from carom.gas.containers import JOINT_OVERLAP, WALLS, AnyContainer, wall_name
from carom.gas.drives import AnyDrives, Thermostat, drive_faults
from carom.gas.edmd.gas_records import MAX_BALLS
from carom.gas.initial import DENSEST
from carom.gas.species import (
    ANY,
    BYTES_PER_BALL,
    DENSITIES,
    AnyContacts,
    SizeClasses,
    Species,
    best_contact,
    shear_faults,
    side_faults,
    thermostat_faults,
    volume_of_balls,
)
from carom.scene.openings import FAST
from carom.scene.presets import parse_toml, read_toml
from carom.scene.schema import (
    Components,
    Count,
    CountOrZero,
    Model,
    Number,
    Time,
    from_file,
    raise_faults,
    refused,
)
from carom.scene.toml import toml_text

MOST_EVENTS = 1 << 62  # of a gas that is run by hand
_ENDINGS = (".csv", ".npz", ".gsd")


# --- run settings --------------------------------------------------------------------------------------------------


def _start(value: Any) -> str:
    known = ["lattice", "random"]
    if isinstance(value, str) and (value in known or value.lower().endswith(_ENDINGS)):
        return value
    advice = suggestion(value, known) if isinstance(value, str) else ""
    raise refused(f"'lattice', 'random', or a file ({', '.join(_ENDINGS)})", shown(value), advice)


class GasSettings(Model):
    """Run settings.

    Parameters
    ----------
    start : "lattice", "random", or a file with positions (and velocities, spins): .csv, .npz, .gsd
    equilibrate : collisions before the measurement; default: 40 per ball, none of a gas that cools
    from_time : simulated time before which nothing is measured; default: as soon as the gas is equilibrated
    max_events : collisions to measure, with walls included
    duration : simulated time to measure; one of the two, or both
    seed : of all random numbers
    """

    start: Annotated[str, BeforeValidator(_start)] = "lattice"
    equilibrate: CountOrZero | None = None
    from_time: Time | None = None
    max_events: Count | None = None
    duration: Time | None = None
    seed: CountOrZero = 0

    @model_validator(mode="after")
    def _ends(self) -> GasSettings:
        if self.max_events is None and self.duration is None:
            raise_faults([Fault("", "", "max_events or duration", "neither", "give one of them, or both")])
        return self


# ----------------------------------------------------------------------------------------------------
# Scenes of gases: all parts put together, and the checks that need more than one of them.


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
    container : a :func:`carom.gas.container`, or its fields, with two lengths for discs in a plane; lengths alone: a periodic box
    species : Species, one or several
    contacts : a Surface for all pairs, or one for each pair of names of species or walls, ``{("a", "wall"): Surface(...)}``
    drives : Drives by the names of walls that move or are heated
    thermostat : Thermostat, optional
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
    500 balls, periodic 10 x 10 x 10, packing fraction 0.2618, 100,000 events from the start
    >>> round(scene.packing_fraction, 6)
    0.261799
    """

    where: ClassVar[str] = "gas"
    """Where errors are found; a scene of a file has the file's name."""
    gravity: Annotated[float | tuple[float, ...], BeforeValidator(_gravity)] = 0.0
    contact_time: Annotated[float, BeforeValidator(_CONTACT_TIME)] = 0.0
    shear_rate: Annotated[float, BeforeValidator(_SHEAR_RATE)] = 0.0
    container: AnyContainer
    species: Annotated[tuple[Species, ...], BeforeValidator(lambda one: (one,) if isinstance(one, Species) else one)]
    contacts: AnyContacts = ()
    drives: AnyDrives = ()
    thermostat: Thermostat | None = None
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
            one.count * (math.pi if axes == 2 else 4 / 3 * math.pi) * one.radius**axes
            if one.radii is None and isinstance(one.radius, float)
            else float(volume_of_balls(one.all_radii, axes).sum())
            for one in self.species
        )
        return balls / self.container.geometry.volume

    @property
    def spins_change(self) -> bool:
        """Whether anything can change a spin: a contact that is not smooth, a heated wall, a thermostat."""
        rough = not all(one.is_smooth for one in self.contacts)
        return rough or self.thermostat is not None or any(one.temperature is not None for one in self.drives)

    @property
    def cools(self) -> bool:
        """Whether contacts take energy, and nothing supplies any: such a gas has no equilibrium."""
        fed = self.thermostat is not None or self.drives or any(self.gravity_vector) or self.shear_rate
        return not fed and not all(one.is_elastic for one in self.contacts)

    @property
    def equilibrate(self) -> int:
        """Number of collisions before the measurement; by default none of a gas that cools, which is measured from its start."""
        usual = 0 if self.cools else 40 * self.count
        return usual if self.run.equilibrate is None else self.run.equilibrate

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
        return np.repeat(np.arange(len(self.species)), [len(one.sizes[0]) for one in self.species])

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
        before = (
            f"after {counted(self.equilibrate, 'event')} of equilibration" if self.equilibrate else "from the start"
        )
        if self.run.from_time is not None:
            before += f", from t = {format_number(self.run.from_time)}"
        if self.shear_rate:
            density += f", shear rate {format_number(self.shear_rate)}"
        return f"{what}, {self.container.describe()}, {density}, {' or '.join(run)} {before}"


def scene_of_parts(where: str, parts: dict[str, Any], run: dict[str, Any]) -> GasScene:
    """Return the scene of a gas of parts as its class takes them; without an end in ``run`` it has none of its own."""
    return from_file(where, GasScene, parts | {"run": {"max_events": MOST_EVENTS} | run})


def gas_faults(scene: GasScene) -> list[Fault]:
    """Return all faults of a gas whose parts are valid."""
    if not scene.species:
        return [Fault("", "species", "at least one species", "none", "a file has a table [[species]] for each")]
    if found := [*_count_faults(scene), *_mass_faults(scene)]:  # (the others look at the radii and masses of all balls)
        return found
    parts = (_species_faults, _contact_faults, _drive_faults, _gravity_faults, _density_faults, _thermostat_faults)
    return [fault for part in parts for fault in part(scene)]


def _species_faults(scene: GasScene) -> list[Fault]:
    found = FaultList()
    axes, names = scene.container.dimensions, [one.name for one in scene.species]
    for i, one in enumerate(scene.species):
        if one.name in names[:i]:
            found.add(f"species[{i}].name", "a different name for each species", shown(one.name))
        if axes == 3 and one.planar:
            got = f"a Disc, which spins about z only: {one.name}"
            found.add(f"species[{i}]", "carom.Ball in three dimensions", got)
        if axes == 3 and one.kappa(3) > 2 / 3 * (1 + 1e-12):
            advice = "for discs give the container two lengths" if one.kappa(3) <= 1 else ""
            got = format_number(one.kappa(3), 6) if not isinstance(one.inertia, str) else one.inertia
            found.add(f"species[{i}].inertia", "kappa of at most 2/3 for balls, that of a thin shell", got, advice)
    return found


def _count_faults(scene: GasScene) -> list[Fault]:
    if scene.count > MAX_BALLS:
        return [Fault("", "species", f"at most {MAX_BALLS:,} balls", f"{scene.count:,}")]
    found = FaultList()
    found.attempt(require_memory, "", "species", scene.count, BYTES_PER_BALL, "take fewer balls, or a larger machine")
    return found


def _mass_faults(scene: GasScene) -> list[Fault]:
    found = []
    for i, one in enumerate(scene.species):
        try:
            DENSITIES[scene.container.dimensions](one.density if one.mass is None else 1.0)
        except PydanticCustomError as error:
            found.append(replace((error.context or {})["fault"], field=f"species[{i}].density"))
    return found


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
        if strange := [name for name in contact.between if name not in known]:
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
        if bare := [wall for wall in walls if best_contact(pairs, one, [wall, "wall"]) is None]:
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
            for field, expected, got in drive_faults(drive, drive.wall, container):
                found.add(f"drives[{i}].{field}", expected, got)
    return found


def _gravity_faults(scene: GasScene) -> list[Fault]:
    axes = scene.container.dimensions
    if scene.shear_rate != 0:
        fastest = max(math.sqrt(one.temperature / one.nominal_mass(axes)) for one in scene.species)
        if found := shear_faults(scene.container.geometry, scene.gravity_vector, scene.shear_rate, fastest):
            return found
    if any(scene.gravity_vector) and not scene.container.geometry.faces:
        advice = 'add walls, such as shape = "box" with periodic = ["x"]'
        return [Fault("", "gravity", "no gravity without walls to fall on", shown(scene.gravity), advice)]
    if len(scene.gravity_vector) == axes or (axes == 2 and scene.gravity_vector[2] == 0):
        return []
    return [Fault("", "gravity", f"one number, or {axes}", f"{len(scene.gravity_vector)} numbers")]


def _density_faults(scene: GasScene) -> list[Fault]:
    """Return faults of sides that are too short, and of more balls than can be packed in."""
    axes, container = scene.container.dimensions, scene.container.geometry
    widest = max(float(one.sizes[0].max()) for one in scene.species)
    smallest = min(float(one.sizes[0].min()) for one in scene.species)
    found = FaultList()
    found += side_faults(container, widest, smallest)
    narrow = container.widest_radius
    if not found and widest > narrow * (1 - JOINT_OVERLAP):
        i = int(np.argmax([one.sizes[0].max() for one in scene.species]))
        expected = f"a radius below the ellipse's smaller half axis, {format_number(narrow, 6)}"
        found.add(f"species[{i}].radius", expected, shown(widest))
    if found or scene.container.bounds == "centre":  # (balls may then overlap the walls)
        return found
    # for mixed sizes the only bound is 1
    several = smallest < widest
    most, fraction = (1.0 if several else DENSEST[axes]), scene.packing_fraction
    if fraction > most * (1 + 1e-12):
        name = "discs" if axes == 2 else "balls"
        bound = "at most 1" if several else f"at most {most:.4f}, the densest packing of equal {name}"
        longer = math.ceil((fraction / most) ** (1 / axes) * 1000) / 1000
        advice = f"use fewer or smaller {name}, or sides {longer:g} times as long"
        found.add("species", f"a packing fraction of {bound}", f"{fraction:.4f}", advice)
    return found


def _thermostat_faults(scene: GasScene) -> list[Fault]:
    if scene.thermostat is None:
        return []
    kinds = SizeClasses.of(scene.species, scene.container.dimensions).kinds
    return thermostat_faults(scene.thermostat, min(one.mass for one in kinds), min(one.radius for one in kinds))


# ----------------------------------------------------------------------------------------------------
# Scenes of gases in TOML files.


def load_gas(path: str | Path) -> GasScene:
    """Read the scene of a gas from a TOML file.

    Parameters
    ----------
    path : str or Path
        The file, in whose folder a start from a file is looked for; or the text of such a file, with its line breaks.

    Returns
    -------
    GasScene. Raises CaromError, one line per problem: where, what was expected, what was found, what to do.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> from carom.gas import gas_text, load_gas
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = Path(folder) / "gas.toml"
    ...     _ = path.write_text(gas_text(), encoding="utf-8")
    ...     scene = load_gas(path)
    >>> scene.count, scene.container.shape
    (1000, 'periodic')
    """
    if isinstance(path, str) and "\n" in path:
        name, folder, table = "gas", Path(), parse_toml("gas", path)
    else:
        path = as_path("load_gas", path)
        name, folder = str(path), path.parent
        table = read_toml(path, "carom scene new with `gas` or carom.gas.gas_text makes one", "the scene file of a gas")
    if strange := sorted({"balls", "walls", "floor"} & set(table)):
        got = " and ".join(strange)
        raise CaromError(f"{name}: expected a gas, got a scene of single balls, with {got}; run carom simulate {name}")
    run = table.get("run")
    if isinstance(run, dict) and isinstance(start := run.get("start"), str) and Path(start).suffix:
        run["start"] = str(folder / start)
    scene = from_file(name, GasScene, table)
    object.__setattr__(scene, "where", name)
    return scene


def is_gas(path: str | Path) -> bool:
    """Return whether a file looks like the scene of a gas: TOML with a container or species."""
    table = FaultList().attempt(read_toml, Path(path), "")
    return bool({"container", "species"} & set(table or ()))


def new_gas() -> GasScene:
    """Return a gas that can be run as it is: rough spheres in a periodic box.

    Returns
    -------
    GasScene
        :func:`gas_text` returns the commented text of its file.

    Examples
    --------
    >>> from carom.gas import new_gas
    >>> new_gas().count
    1000
    """
    return load_gas(gas_text())


def gas_text(scene: GasScene | None = None) -> str:
    """Return the text of the scene file of a gas.

    Parameters
    ----------
    scene : GasScene, optional
        Default: a commented first gas, :func:`new_gas`.

    Returns
    -------
    str
        TOML, from which :func:`load_gas` makes a scene.

    Examples
    --------
    >>> from carom.gas import gas_text, load_gas, new_gas
    >>> print(gas_text().splitlines()[0])
    # A gas for carom: `carom gas FILE` runs it, `carom scene check FILE` validates it.
    >>> load_gas(gas_text(new_gas())) == new_gas()
    True
    """
    if scene is None:
        return files("carom.gas").joinpath("new.toml").read_text(encoding="utf-8")
    require_type("gas_text", "scene", scene, GasScene)
    return toml_text("gas_text", scene)
