"""Scenes of gases: all parts put together, and the checks that need more than one of them."""

from __future__ import annotations

import functools
import itertools
import math
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Literal, Union, cast

import numpy as np
from numpy.typing import NDArray
from pydantic import BeforeValidator, Field, model_validator

from carom.bodies import DISC_INERTIAS, INERTIAS, Ball, Disc, Surface
from carom.core.sums import added
from carom.errors import CaromError, Fault, FaultList, shown, suggestion
from carom.files import require_memory
from carom.formatting import counted, format_bytes, format_number
from carom.gas.containers import (
    BOXES,
    JOINT_OVERLAP,
    WALLS,
    Container,
    container,
    container_figures,
    in_figure,
    wall_name,
)
from carom.gas.drives import Drive, Thermostat, drive_faults
from carom.gas.edmd.gas_records import MAX_BALLS
from carom.gas.initial import DENSEST
from carom.gas.species import (
    ANY,
    BYTES_PER_BALL,
    LONGEST_SIDE,
    GasSurface,
    LognormalRadii,
    Species,
    SpeciesRadius,
    best_contact,
    in_classes,
    shear_faults,
    size_moments,
)
from carom.scene.figures import FIGURES, Figure, PlaneFigure
from carom.scene.figures.rounds import SectorFigure
from carom.scene.figures.solids import CylinderFigure, SphereFigure
from carom.scene.openings import FAST
from carom.scene.schema import (
    Components,
    Count,
    CountOrZero,
    Length,
    Mass,
    Model,
    Number,
    Size,
    Time,
    raise_faults,
    refused,
    with_faults_of_part,
)

_OBSTACLE = Components("x, y, radius; or x, y, z, radius", (3, 4))
_PLATE = Components("x1, y1, x2, y2 of two places", (4,))
_SIZE = Components("2 or 3 lengths > 0: along x, y (discs), and z (balls)", (2, 3))
_KAPPA = Number("kappa = I/(m a^2) in (0, 1], or one of 'solid', 'hollow', 'disc', 'ring'", least=0, most=1, above=True)
_TEMPERATURE = Number("a temperature k_B T >= 0", "J", least=0)
_DENSITY = Number("a density > 0 in kg/m^3 (discs: kg/m^2)", "", least=0, above=True)
_ENDINGS = (".csv", ".npz", ".gsd")


# --- the container -------------------------------------------------------------------------------------------------


def _axes(value: Any) -> Any:
    if not isinstance(value, list | tuple):
        raise refused("a list of the axes without walls, such as ['x']", shown(value))
    return value


class GasContainer(Model):
    """The container, with the parameters of :func:`carom.gas.container`: a class for each shape, chosen by ``shape``.

    Parameters
    ----------
    shape : one of carom.gas.SHAPES: "box" or "periodic", or a figure
    size : of a box, along x, y and z; two lengths: discs in a plane
    straight, radius, half_axes, points, ... : sizes of the figure
    height : of a plane figure that stands upright along z, with balls
    periodic : axes without walls, such as ["x", "y"]; default: none, or all for "periodic"
    obstacles : round obstacles, rows of x, y, radius or x, y, z, radius
    plates : thin straight walls with gas on both sides, rows of x1, y1, x2, y2
    bounds : "surface" or "centre" of the balls: which of them the walls bound
    """

    tag: ClassVar[str] = "shape"
    periodic: Annotated[tuple[Literal["x", "y", "z"], ...], BeforeValidator(_axes)] = ()
    obstacles: tuple[Annotated[tuple[Length, ...], BeforeValidator(_OBSTACLE)], ...] = ()
    plates: tuple[Annotated[tuple[Length, ...], BeforeValidator(_PLATE)], ...] = ()
    bounds: Literal["surface", "centre"] = "surface"

    def __new__(cls, *_unnamed: Any, **fields: Any) -> Any:
        """Return a container of the class of its shape."""
        kind = CONTAINERS.get(str(fields.get("shape"))) if cls is GasContainer and fields else cls
        return super().__new__(kind or cls)

    @model_validator(mode="after")
    def _check(self) -> GasContainer:
        with_faults_of_part(lambda: self.geometry)
        return self

    @functools.cached_property
    def geometry(self) -> Container:
        """The container of :class:`carom.gas.Gas`."""
        raise refused(f"one of {', '.join(CONTAINERS)}", "nothing", field="shape")

    @property
    def dimensions(self) -> int:
        """3, or 2: discs."""
        return len(self.geometry.size)

    def describe(self) -> str:
        """Return one phrase."""
        made = self.geometry
        sides = " x ".join(format_number(x, 6) for x in made.size)
        what = {"periodic": "periodic"}.get(made.shape, f"{'an' if made.shape == 'ellipse' else 'a'} {made.shape}")
        if isinstance(self, SectorFigure):
            what += f" of {format_number(self.opening, 4)}°,"
        along = f", periodic along {' and '.join(self.periodic)}" if self.periodic else ""
        count = len(self.obstacles)
        around = f" with {count} obstacle{'s' if count > 1 else ''}" if count else ""
        plates = f" and {counted(len(self.plates), 'plate')}" if self.plates else ""
        return f"{what} {sides}{along}{around}{plates}"


class BoxContainer(GasContainer):
    """A box, with walls where it is not periodic."""

    shape: Literal["box"] = "box"
    size: Annotated[tuple[Size, ...], BeforeValidator(_SIZE)]

    @functools.cached_property
    def geometry(self) -> Container:
        """The container of :class:`carom.gas.Gas`."""
        closed = [axis in self.periodic for axis in "xyz"[: len(self.size)]]
        return container(
            "box", self.size, periodic=closed, obstacles=self.obstacles, plates=self.plates, bounds=self.bounds
        )


class PeriodicContainer(GasContainer):
    """A box without walls."""

    shape: Literal["periodic"] = "periodic"
    size: Annotated[tuple[Size, ...], BeforeValidator(_SIZE)]

    @functools.cached_property
    def geometry(self) -> Container:
        """The container of :class:`carom.gas.Gas`."""
        return container("periodic", self.size, obstacles=self.obstacles, plates=self.plates, bounds=self.bounds)


class FigureContainer(GasContainer):
    """A container in a figure, whose class is the other base."""

    @functools.cached_property
    def geometry(self) -> Container:
        """The container of :class:`carom.gas.Gas`."""
        height = getattr(self, "height", None)
        upright = height is not None or isinstance(self, SphereFigure | CylinderFigure)
        closed = [axis in self.periodic for axis in "xyz"[: 3 if upright else 2]]
        own: Any = self
        return in_figure(own, height, closed, self.obstacles, self.bounds, self.plates)


class UprightContainer(FigureContainer):
    """A plane figure, for discs; with a height, for balls."""

    height: Size | None = None


def _container_of(kind: type[Figure]) -> type[GasContainer]:
    """Return the class of containers in a figure: it has the fields of the figure and of a container."""
    base = UprightContainer if issubclass(kind, PlaneFigure) else FigureContainer
    name = f"{kind.__name__.removesuffix('Figure')}Container"
    metaclass: Any = type(base)
    made = metaclass(name, (base, kind), {"__module__": __name__, "__doc__": kind.__doc__})
    globals()[name] = made  # (where a pickle looks for it)
    return made  # type: ignore[no-any-return]


CONTAINERS: dict[str, type[GasContainer]] = {"periodic": PeriodicContainer, "box": BoxContainer}
CONTAINERS |= {name: _container_of(FIGURES[name]) for name in container_figures()}


if TYPE_CHECKING:
    AnyContainer = GasContainer
else:
    # (made at run time)
    AnyContainer = Annotated[Union[tuple(CONTAINERS.values())], Field(discriminator="shape")]  # noqa: UP007


# --- species and contacts ------------------------------------------------------------------------------------------


def _inertia(value: Any) -> str | float:
    if not isinstance(value, str):
        return _KAPPA(value)
    names = {**INERTIAS, **DISC_INERTIAS}
    if value not in names:
        raise refused(_KAPPA.what, shown(value), suggestion(value, list(names)))
    return value


def volume_of_balls(radius: Any, dimensions: int) -> Any:
    """Return the volume of balls of a radius; in two dimensions the area of discs."""
    return math.pi * radius**2 if dimensions == 2 else 4 / 3 * math.pi * radius**3


def _name(value: Any) -> str:
    reserved = ("wall", *WALLS, ANY)
    if not isinstance(value, str) or not value or value in reserved:
        raise refused(f"a name other than {', '.join(reserved)}", shown(value))
    return value


class GasSpecies(Model):
    """Balls of one kind.

    Parameters
    ----------
    name : what contacts and tables call it
    count : number of balls
    radius : of all balls; or a distribution: a table of ``distribution`` ("lognormal"), ``median``, ``sigma``, and the ``seed`` of
        the drawn radii
    mass : of a ball, default: 1; of radii by distribution, of one with the median, and the others have the same density
    density : instead of a mass (kg/m^3; of discs kg/m^2)
    inertia : kappa = I/(m a^2), or "solid", "hollow" (balls), "disc", "ring" (discs); default: solid, disc
    temperature : k_B T at the start, the mean of m v^2 along an axis; default: 1
    temperature_rotational : mean of I w^2 about an axis; default: the same
    """

    name: Annotated[str, BeforeValidator(_name)] = "a"
    count: Count
    radius: SpeciesRadius
    mass: Mass | None = None
    density: Annotated[float, BeforeValidator(_DENSITY)] | None = None
    inertia: Annotated[str | float, BeforeValidator(_inertia)] | None = None
    temperature: Annotated[float, BeforeValidator(_TEMPERATURE)] = 1.0
    temperature_rotational: Annotated[float, BeforeValidator(_TEMPERATURE)] | None = None

    def kappa(self, dimensions: int) -> float:
        """Return I/(m a^2)."""
        if self.inertia is None:
            return DISC_INERTIAS["disc"] if dimensions == 2 else INERTIAS["solid"]
        return {**INERTIAS, **DISC_INERTIAS}[self.inertia] if isinstance(self.inertia, str) else self.inertia

    def species(self, dimensions: int) -> Species:
        """Return the species of :class:`carom.gas.Gas`."""
        kind: Any = Disc if dimensions == 2 else Ball
        ball = kind(self.nominal, self.nominal_mass(dimensions), self.kappa(dimensions))
        radii = self.radii if isinstance(self.radius, LognormalRadii) else None
        return Species(ball, self.count, self.name, self.temperature, self.temperature_rotational, radii)

    @property
    def nominal(self) -> float:
        """The radius of a ball with the mass."""
        return self.radius.median if isinstance(self.radius, LognormalRadii) else self.radius

    def nominal_mass(self, dimensions: int) -> float:
        """Return the mass of a ball with the nominal radius."""
        if self.mass is not None:
            return self.mass
        return float(cast(float, self.density) * volume_of_balls(self.nominal, dimensions))

    @property
    def radii(self) -> Any:
        """The radii of all balls (m), (count,)."""
        one = self.radius
        return in_classes(one, self.count) if isinstance(one, LognormalRadii) else np.full(self.count, one)

    def total_mass(self, dimensions: int) -> float:
        """Return the mass of all balls."""
        if not isinstance(self.radius, LognormalRadii):
            return self.count * self.nominal_mass(dimensions)
        return self.nominal_mass(dimensions) * float(((self.radii / self.nominal) ** dimensions).sum())

    @property
    def size_note(self) -> str:
        """One line on radii by distribution: mean, standard deviation, skewness, classes; empty for balls of one radius."""
        if not isinstance(self.radius, LognormalRadii):
            return ""
        drawn, kept = self.radius.radii(self.count), self.radii
        mean, deviation, skewness = size_moments(kept)
        of = f"mean {mean:.5g}, standard deviation {deviation:.4g} ({100 * deviation / mean:.3g} %), skewness {skewness:.3g}"
        said = f"species {self.name!r}: radii {drawn.min():.4g} to {drawn.max():.4g}, {of}"
        classes = len(np.unique(kept))
        if classes < len(np.unique(drawn)):
            said += f"; in {classes} classes, with {deviation / size_moments(drawn)[1]:.4f} of the drawn deviation"
        return said

    @model_validator(mode="after")
    def _one_of_mass_and_density(self) -> GasSpecies:
        if self.density is not None and self.mass is not None:
            raise refused("a mass or a density", "both", "omit one of them", field="density")
        if self.density is None and self.mass is None:
            object.__setattr__(self, "mass", 1.0)
        return self


class GasContact(GasSurface):
    """The contact of two species, or of a species and a wall.

    Parameters
    ----------
    between : two names: of species; "wall" for all walls, or a wall's own name; "*" for every species and wall that no other
        contact names
    restitution, friction, tangential_restitution : as of :class:`carom.gas.GasSurface`
    """

    between: Annotated[tuple[str, str], BeforeValidator(Components("two names, such as ['a', 'wall']", (2,)))]


# --- energy input --------------------------------------------------------------------------------------------------


class GasDrive(Drive):
    """The wall of a name that moves or is heated, with the parameters of :class:`carom.gas.Drive`."""

    wall: str


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
    equilibrate : collisions before the measurement; default: 40 per ball
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
    container : GasContainer: shape and size; two lengths: discs in a plane
    species : GasSpecies, at least one
    contacts : GasContact for every pair of species, and for every species and the walls
    drives : GasDrive, walls that move or are heated
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
            for field, expected, got in drive_faults(drive, drive.wall, container):
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
    narrow = container.widest_radius
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
