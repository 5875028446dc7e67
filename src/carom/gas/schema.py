"""Schema of the parts of a gas scene: container, species, contacts, drives, thermostat, run settings.

The same from Python and from TOML, with the same names. :mod:`carom.gas.scene` puts them together.
"""

from __future__ import annotations

import functools
import math
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Literal, Union, cast

import numpy as np
from pydantic import BeforeValidator, Field, model_validator

from carom.bodies import DISC_INERTIAS, INERTIAS, Ball, Disc
from carom.errors import Fault, shown, suggestion
from carom.formatting import counted, format_number
from carom.gas.contact_forms import ANY, GasSurface
from carom.gas.containers import WALLS, Container, container, container_figures, in_figure
from carom.gas.drives import Drive, Thermostat
from carom.gas.size_distributions import LognormalRadii, SpeciesRadius, in_classes, size_moments
from carom.gas.species import Species
from carom.scene.figures import FIGURES, Figure, PlaneFigure
from carom.scene.figures.sector import SectorFigure
from carom.scene.figures.solids import CylinderFigure, SphereFigure
from carom.scene.schema import (
    Components,
    Count,
    CountOrZero,
    Length,
    Mass,
    Model,
    Number,
    Share,
    Size,
    Speed,
    Time,
    raise_faults,
    refused,
    with_faults_of_part,
)

__all__ = ["AnyContainer", "GasContact", "GasContainer", "GasDrive", "GasSettings", "GasSpecies", "GasThermostat"]

_OBSTACLE = Components("x, y, radius; or x, y, z, radius", (3, 4))
_PLATE = Components("x1, y1, x2, y2 of two places", (4,))
_SIZE = Components("2 or 3 lengths > 0: along x, y (discs), and z (balls)", (2, 3))
_KAPPA = Number("kappa = I/(m a^2) in (0, 1], or one of 'solid', 'hollow', 'disc', 'ring'", least=0, most=1, above=True)
_TEMPERATURE = Number("a temperature k_B T >= 0", "J", least=0)
_FREQUENCY = Number("a frequency > 0", "1/s", least=0, above=True)
_DENSITY = Number("a density > 0 in kg/m^3 (discs: kg/m^2)", "", least=0, above=True)
_RATE = Number("a rate > 0: kicks per ball per unit time", "1/s", least=0, above=True)
_AMPLITUDE = Number("an amplitude >= 0", "m", least=0)
_FORCE = Number("a force", "N")
_ALONG = Components("2 or 3 speeds along x, y (and z)", (2, 3))
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


class GasDrive(Model):
    """A wall that moves or is heated, with the parameters of :class:`carom.gas.Drive`."""

    wall: str
    amplitude: Annotated[float, BeforeValidator(_AMPLITUDE)] = 0.0
    frequency: Annotated[float, BeforeValidator(_FREQUENCY)] | None = None
    phase: Share = 0.0
    temperature: Annotated[float, BeforeValidator(_TEMPERATURE)] | None = None
    temperature_rotational: Annotated[float, BeforeValidator(_TEMPERATURE)] | None = None
    mass: Mass | None = None
    speed: Speed | None = None
    force: Annotated[float, BeforeValidator(_FORCE)] | None = None
    surface_velocity: Annotated[tuple[Speed, ...], BeforeValidator(_ALONG)] | None = None

    @model_validator(mode="after")
    def _check(self) -> GasDrive:
        with_faults_of_part(lambda: self.drive)
        return self

    @property
    def drive(self) -> Drive:
        """The drive of :class:`carom.gas.Gas`."""
        given = {name: getattr(self, name) for name in type(self).model_fields if name != "wall"}
        return Drive(**given | {"frequency": self.frequency or 0.0})


class GasThermostat(Model):
    """Andersen's thermostat, with the parameters of :class:`carom.gas.Thermostat`."""

    temperature: Annotated[float, BeforeValidator(_TEMPERATURE)]
    rate: Annotated[float, BeforeValidator(_RATE)]
    temperature_rotational: Annotated[float, BeforeValidator(_TEMPERATURE)] | None = None

    @property
    def thermostat(self) -> Thermostat:
        """The thermostat of :class:`carom.gas.Gas`."""
        return Thermostat(self.temperature, self.rate, self.temperature_rotational)


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
