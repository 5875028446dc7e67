"""Schema of the parts of a gas scene: container, species, contacts, drives, thermostat, run settings.

The same from Python and from TOML, with the same names. :mod:`carom.gas.scene` puts them together.
"""

from __future__ import annotations

import functools
import math
from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, model_validator

from carom.bodies import DISC_INERTIAS, INERTIAS, Ball, Disc, Surface
from carom.errors import Fault, shown, suggestion
from carom.formatting import format_number
from carom.gas.containers import SHAPES, WALLS, Container, container
from carom.gas.species import Drive, Species, Thermostat
from carom.scene.schema import (
    Components,
    Count,
    CountOrZero,
    Friction,
    Length,
    Mass,
    Model,
    Number,
    Share,
    Size,
    Spring,
    Time,
    raise_faults,
    refused,
    with_faults_of_part,
)

__all__ = ["GasContact", "GasContainer", "GasDrive", "GasSettings", "GasSpecies", "GasThermostat"]

_OBSTACLE = Components("x, y, radius; or x, y, z, radius", (3, 4))
_SIZE = Components("2 or 3 lengths > 0: along x, y (discs), and z (balls)", (2, 3))
_KAPPA = Number("kappa = I/(m a^2) in (0, 1], or one of 'solid', 'hollow', 'disc', 'ring'", least=0, most=1, above=True)
_TEMPERATURE = Number("a temperature k_B T >= 0", "J", least=0)
_FREQUENCY = Number("a frequency > 0", "1/s", least=0, above=True)
_RATE = Number("a rate > 0: kicks per ball per unit time", "1/s", least=0, above=True)
_AMPLITUDE = Number("an amplitude >= 0", "m", least=0)
_ENDINGS = (".csv", ".npz", ".gsd")


# --- the container -------------------------------------------------------------------------------------------------


def _shape(value: Any) -> str:
    if not isinstance(value, str) or value not in SHAPES:
        advice = suggestion(value, list(SHAPES)) if isinstance(value, str) else ""
        raise refused(f"one of {', '.join(SHAPES)}", shown(value), advice if advice.startswith("did") else "")
    return value


class GasContainer(Model):
    """The container, with the parameters of :func:`carom.gas.container`.

    Parameters
    ----------
    shape : one of carom.gas.SHAPES
    size : of the box around the shape, along x, y and z; two lengths: discs in a plane
    periodic : axes without walls, such as ["x", "y"]; default: none, or all for "periodic"
    points : corners of a polygon in order, rows of x, y
    scatterers : round obstacles, rows of x, y, radius or x, y, z, radius
    bounds : "surface" or "centre" of the balls: what the walls bound
    """

    shape: Annotated[str, BeforeValidator(_shape)]
    size: Annotated[tuple[Size, ...], BeforeValidator(_SIZE)] | None = None
    periodic: tuple[Literal["x", "y", "z"], ...] = ()
    points: tuple[tuple[Length, Length], ...] | None = None
    scatterers: tuple[Annotated[tuple[Length, ...], BeforeValidator(_OBSTACLE)], ...] = ()
    bounds: Literal["surface", "centre"] = "surface"

    @model_validator(mode="after")
    def _check(self) -> GasContainer:
        if self.size is None and self.shape != "polygon":
            raise_faults([Fault("", "size", _SIZE.what, "nothing")])
        with_faults_of_part(lambda: self.geometry)
        return self

    @functools.cached_property
    def geometry(self) -> Container:
        """The container of :class:`carom.gas.Gas`."""
        closed = (
            None if self.shape == "periodic" else [axis in self.periodic for axis in "xyz"[: len(self.size or (0, 0))]]
        )
        return container(
            self.shape, self.size, periodic=closed, points=self.points, scatterers=self.scatterers, bounds=self.bounds
        )

    @property
    def dimensions(self) -> int:
        """3, or 2: discs."""
        return len(self.geometry.size)

    def describe(self) -> str:
        """Return one phrase."""
        sides = " x ".join(format_number(x, 6) for x in self.geometry.size)
        what = {"periodic": "periodic"}.get(self.shape, f"{'an' if self.shape == 'ellipse' else 'a'} {self.shape}")
        if self.shape == "wedge":
            what += f" of {format_number(math.degrees(2 * math.asin(self.geometry.size[0] / self.geometry.size[1] / 2)), 4)}°,"
        along = f", periodic along {' and '.join(self.periodic)}" if self.periodic else ""
        count = len(self.scatterers)
        obstacles = f" with {count} obstacle{'s' if count > 1 else ''}" if count else ""
        return f"{what} {sides}{along}{obstacles}"


# --- species and contacts ------------------------------------------------------------------------------------------


def _inertia(value: Any) -> str | float:
    if not isinstance(value, str):
        return _KAPPA(value)
    names = {**INERTIAS, **DISC_INERTIAS}
    if value not in names:
        raise refused(_KAPPA.what, shown(value), suggestion(value, list(names)))
    return value


def _name(value: Any) -> str:
    reserved = ("wall", *WALLS)
    if not isinstance(value, str) or not value or value in reserved:
        raise refused(f"a name other than {', '.join(reserved)}", shown(value))
    return value


class GasSpecies(Model):
    """Balls of one kind.

    Parameters
    ----------
    name : what contacts and tables call it
    count : number of balls
    radius, mass
    inertia : kappa = I/(m a^2), or "solid", "hollow" (balls), "disc", "ring" (discs); default: solid, disc
    temperature : k_B T at the start, the mean of m v^2 along an axis; default: 1
    temperature_rotational : mean of I w^2 about an axis; default: the same
    """

    name: Annotated[str, BeforeValidator(_name)] = "a"
    count: Count
    radius: Size
    mass: Mass = 1.0
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
        ball = kind(self.radius, self.mass, self.kappa(dimensions))
        return Species(ball, self.count, self.name, self.temperature, self.temperature_rotational)


class GasContact(Model):
    """The contact of two species, or of a species and a wall.

    Parameters
    ----------
    between : two names: of species; "wall" for all walls, or a wall's own name
    restitution : 0 to 1
    friction : >= 0, or inf
    tangential_restitution : -1 (smooth) to 1; default: 0
    """

    between: Annotated[tuple[str, str], BeforeValidator(Components("two names, such as ['a', 'wall']", (2,)))]
    restitution: Share
    friction: Friction
    tangential_restitution: Spring = 0.0

    @property
    def surface(self) -> Surface:
        """The surface of :class:`carom.gas.Gas`."""
        return Surface(self.restitution, self.friction, self.tangential_restitution)


# --- energy input --------------------------------------------------------------------------------------------------


class GasDrive(Model):
    """A wall that oscillates, or is heated, or both, with the parameters of :class:`carom.gas.Drive`."""

    wall: str
    amplitude: Annotated[float, BeforeValidator(_AMPLITUDE)] = 0.0
    frequency: Annotated[float, BeforeValidator(_FREQUENCY)] | None = None
    phase: Share = 0.0
    temperature: Annotated[float, BeforeValidator(_TEMPERATURE)] | None = None
    temperature_rotational: Annotated[float, BeforeValidator(_TEMPERATURE)] | None = None

    @model_validator(mode="after")
    def _check(self) -> GasDrive:
        with_faults_of_part(lambda: self.drive)
        return self

    @property
    def drive(self) -> Drive:
        """The drive of :class:`carom.gas.Gas`."""
        return Drive(self.amplitude, self.frequency or 0.0, self.phase, self.temperature, self.temperature_rotational)


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
    max_events : collisions to measure, with walls included
    duration : simulated time to measure; one of the two, or both
    seed : of all random numbers
    """

    start: Annotated[str, BeforeValidator(_start)] = "lattice"
    equilibrate: CountOrZero | None = None
    max_events: Count | None = None
    duration: Time | None = None
    seed: CountOrZero = 0

    @model_validator(mode="after")
    def _ends(self) -> GasSettings:
        if self.max_events is None and self.duration is None:
            raise_faults([Fault("", "", "max_events or duration", "neither", "give one of them, or both")])
        return self
