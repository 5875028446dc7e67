"""A gas as a scene: container, species, contacts, how it is run. The same from Python and from TOML, with the same words."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import BeforeValidator, model_validator

from carom.ball import DISCS, INERTIAS, Ball, Disc
from carom.checks import nearest
from carom.errors import CaromError
from carom.gas.check import gas_faults
from carom.gas.container import SHAPES, WALLS, Container, container
from carom.gas.drive import Drive, Thermostat
from carom.gas.setup import Species
from carom.scene.faults import Fault, Model, Words, refuse
from carom.scene.quantities import Components, Friction, Length, Mass, Number, Share, Size, Spring, Time
from carom.surface import Surface
from carom.units import number

__all__ = ["GasContact", "GasContainer", "GasDrive", "GasScene", "GasSettings", "GasSpecies", "GasThermostat"]

_OBSTACLE = Components("x, y, radius; or x, y, z, radius", (3, 4))
_SIZE = Components("2 or 3 lengths > 0: along x, y (discs), and z (balls)", (2, 3))
_KAPPA = Number("kappa = I/(m a^2) in (0, 1], or one of 'solid', 'hollow', 'disc', 'ring'", least=0, most=1, above=True)
_TEMPERATURE = Number("a temperature k_B T >= 0", "J", least=0)
_TC = Number("a time >= 0", "s", least=0)
_ENDINGS = (".csv", ".npz", ".gsd")


def handed_on(make: Callable[[], Any], where: tuple[int | str, ...] = ()) -> Any:
    """What a checked part of a gas is made of; its faults as those of the scene."""
    try:
        return make()
    except CaromError as error:
        found = []
        for line in error.faults:
            _name, field, said = line.split(": ", 2)
            expected, got = said.removeprefix("expected ").split(", got ", 1)
            part = field if field.isidentifier() else field.partition("[")[0]
            found.append(Fault(expected, Words(got), at=(*where, part)))
        refuse(found)


# --- the container -------------------------------------------------------------------------------------------------


def _shape(value: Any) -> str:
    if not isinstance(value, str) or value not in SHAPES:
        advice = nearest(value, list(SHAPES)) if isinstance(value, str) else ""
        raise Fault(f"one of {', '.join(SHAPES)}", value, advice if advice.startswith("did") else "").error()
    return value


class GasContainer(Model):
    """What holds the gas: the words of :func:`carom.gas.container`.

    Parameters
    ----------
    shape : one of carom.gas.SHAPES
    size : of the box around it, along x, y and z; two lengths: discs in a plane
    periodic : axes without walls, such as ["x", "y"]; left out: none, or all for "periodic"
    points : corners of a polygon in order, rows of x, y
    scatterers : round obstacles, rows of x, y, radius or x, y, z, radius
    bounds : "surface" or "centre": what the walls bound of the balls
    """

    shape: Annotated[str, BeforeValidator(_shape)]
    size: Annotated[tuple[Size, ...], BeforeValidator(_SIZE)] | None = None
    periodic: tuple[Literal["x", "y", "z"], ...] = ()
    points: tuple[tuple[Length, Length], ...] | None = None
    scatterers: tuple[Annotated[tuple[Length, ...], BeforeValidator(_OBSTACLE)], ...] = ()
    bounds: Literal["surface", "centre"] = "surface"

    @model_validator(mode="after")
    def _made(self) -> GasContainer:
        if self.size is None and self.shape != "polygon":
            refuse([Fault(_SIZE.what, Words("nothing"), at=("size",))])
        handed_on(lambda: self.room)
        return self

    @functools.cached_property
    def room(self) -> Container:
        """As the gas takes it."""
        closed = (
            None if self.shape == "periodic" else [axis in self.periodic for axis in "xyz"[: len(self.size or (0, 0))]]
        )
        return container(
            self.shape, self.size, periodic=closed, points=self.points, scatterers=self.scatterers, bounds=self.bounds
        )

    @property
    def axes(self) -> int:
        """3, or 2: discs."""
        return len(self.room.size)

    def describe(self) -> str:
        """One phrase."""
        sides = " x ".join(number(x, 6) for x in self.room.size)
        what = {"periodic": "periodic"}.get(self.shape, f"{'an' if self.shape == 'ellipse' else 'a'} {self.shape}")
        if self.shape == "wedge":
            what += f" of {number(math.degrees(2 * math.asin(self.room.size[0] / self.room.size[1] / 2)), 4)}°,"
        along = f", periodic along {' and '.join(self.periodic)}" if self.periodic else ""
        count = len(self.scatterers)
        obstacles = f" with {count} obstacle{'s' if count > 1 else ''}" if count else ""
        return f"{what} {sides}{along}{obstacles}"


# --- what is in it -------------------------------------------------------------------------------------------------


MOST = 2**63  # what counts have room for


def _count(value: Any) -> int:
    if isinstance(value, bool) or not isinstance(value, (int, np.integer)) or value < 1:
        raise Fault("a whole number >= 1", value).error()
    if value >= MOST:
        raise Fault("a whole number < 2^63", value).error()
    return int(value)


def _whole(value: Any) -> int:
    if isinstance(value, bool) or not isinstance(value, (int, np.integer)) or value < 0:
        raise Fault("a whole number >= 0", value).error()
    if value >= MOST:
        raise Fault("a whole number < 2^63", value).error()
    return int(value)


def _inertia(value: Any) -> str | float:
    if not isinstance(value, str):
        return _KAPPA(value)
    names = {**INERTIAS, **DISCS}
    if value not in names:
        raise Fault(_KAPPA.what, value, nearest(value, list(names))).error()
    return value


def _name(value: Any) -> str:
    reserved = ("wall", *WALLS)
    if not isinstance(value, str) or not value or value in reserved:
        raise Fault(f"a name, none of {', '.join(reserved)}", value).error()
    return value


class GasSpecies(Model):
    """Balls of one kind.

    Parameters
    ----------
    name : what contacts and tables call it
    count : how many
    radius, mass
    inertia : kappa = I/(m a^2), or "solid", "hollow" (balls), "disc", "ring" (discs); left out: solid, disc
    temperature : k_B T of the start, the mean of m v^2 along an axis; left out: 1
    temperature_rotational : mean of I w^2 about an axis; left out: the same
    """

    name: Annotated[str, BeforeValidator(_name)] = "a"
    count: Annotated[int, BeforeValidator(_count)]
    radius: Size
    mass: Mass = 1.0
    inertia: Annotated[str | float, BeforeValidator(_inertia)] | None = None
    temperature: Annotated[float, BeforeValidator(_TEMPERATURE)] = 1.0
    temperature_rotational: Annotated[float, BeforeValidator(_TEMPERATURE)] | None = None

    def kappa(self, axes: int) -> float:
        """I/(m a^2)."""
        if self.inertia is None:
            return DISCS["disc"] if axes == 2 else INERTIAS["solid"]
        return {**INERTIAS, **DISCS}[self.inertia] if isinstance(self.inertia, str) else self.inertia

    def species(self, axes: int) -> Species:
        """As the gas takes it."""
        kind: Any = Disc if axes == 2 else Ball
        ball = kind(self.radius, self.mass, self.kappa(axes))
        return Species(ball, self.count, self.name, self.temperature, self.temperature_rotational)


class GasContact(Model):
    """What two species do that meet, or a species and a wall.

    Parameters
    ----------
    between : two names: of species; "wall" for all walls, or a wall's own name
    restitution : 0 to 1
    friction : >= 0, or inf
    tangential_restitution : -1 (smooth) to 1; left out: 0
    """

    between: Annotated[tuple[str, str], BeforeValidator(Components("two names, such as ['a', 'wall']", (2,)))]
    restitution: Share
    friction: Friction
    tangential_restitution: Spring = 0.0

    @property
    def surface(self) -> Surface:
        """As the gas takes it."""
        return Surface(self.restitution, self.friction, self.tangential_restitution)


# --- what gives it energy ------------------------------------------------------------------------------------------

_FREQUENCY = Number("a frequency > 0", "1/s", least=0, above=True)
_RATE = Number("a rate > 0: kicks a ball and time", "1/s", least=0, above=True)
_AMPLITUDE = Number("an amplitude >= 0", "m", least=0)


class GasDrive(Model):
    """A wall that swings, or is warm, or both: the words of :class:`carom.gas.Drive`."""

    wall: str
    amplitude: Annotated[float, BeforeValidator(_AMPLITUDE)] = 0.0
    frequency: Annotated[float, BeforeValidator(_FREQUENCY)] | None = None
    phase: Share = 0.0
    temperature: Annotated[float, BeforeValidator(_TEMPERATURE)] | None = None
    temperature_rotational: Annotated[float, BeforeValidator(_TEMPERATURE)] | None = None

    @model_validator(mode="after")
    def _made(self) -> GasDrive:
        handed_on(lambda: self.drive)
        return self

    @property
    def drive(self) -> Drive:
        """As the gas takes it."""
        return Drive(self.amplitude, self.frequency or 0.0, self.phase, self.temperature, self.temperature_rotational)


class GasThermostat(Model):
    """Andersen's: the words of :class:`carom.gas.Thermostat`."""

    temperature: Annotated[float, BeforeValidator(_TEMPERATURE)]
    rate: Annotated[float, BeforeValidator(_RATE)]
    temperature_rotational: Annotated[float, BeforeValidator(_TEMPERATURE)] | None = None

    @property
    def thermostat(self) -> Thermostat:
        """As the gas takes it."""
        return Thermostat(self.temperature, self.rate, self.temperature_rotational)


# --- how it is run -------------------------------------------------------------------------------------------------


def _start(value: Any) -> str:
    known = ["lattice", "random"]
    if isinstance(value, str) and (value in known or value.lower().endswith(_ENDINGS)):
        return value
    advice = nearest(value, known) if isinstance(value, str) else ""
    raise Fault(f"'lattice', 'random', or a file ({', '.join(_ENDINGS)})", value, advice).error()


class GasSettings(Model):
    """How it is run.

    Parameters
    ----------
    start : "lattice", "random", or a file with positions (and velocities, spins): .csv, .npz, .gsd
    equilibrate : collisions before anything is measured; left out: 40 a ball
    max_events : collisions that are measured, with balls and walls
    duration : time that is measured; one of the two, or both
    seed : of all that is random
    """

    start: Annotated[str, BeforeValidator(_start)] = "lattice"
    equilibrate: Annotated[int, BeforeValidator(_whole)] | None = None
    max_events: Annotated[int, BeforeValidator(_count)] | None = None
    duration: Time | None = None
    seed: Annotated[int, BeforeValidator(_whole)] = 0

    @model_validator(mode="after")
    def _ends(self) -> GasSettings:
        if self.max_events is None and self.duration is None:
            refuse([Fault("max_events or duration", Words("neither"), "give one of them, or both")])
        return self


_GRAVITY = Number("an acceleration downwards, or one number an axis", "m/s^2")


def _gravity(value: Any) -> Any:
    several = isinstance(value, (list, tuple)) or (isinstance(value, np.ndarray) and value.ndim > 0)
    return tuple(map(_GRAVITY, Components(_GRAVITY.what, (2, 3))(value))) if several else _GRAVITY(value)


class GasScene(Model):
    """A gas of balls or discs: container, species, contacts, and how it is run.

    Parameters
    ----------
    gravity : a number, downwards (balls: along -z, discs: along -y), or a vector; left out: none
    contact_time : the TC model: a contact within this time after a ball's last one loses nothing; left out: 0, off
    container : its shape and size; two numbers: discs in a plane
    species : at least one
    contacts : one for every pair of species, and for every species and the walls
    drives : walls that swing or are warm
    thermostat : optional
    run : GasSettings

    Numbers are in SI units, or in any others that fit each other. Raises CaromError, one line a fault, all at once.
    """

    gravity: Annotated[float | tuple[float, ...], BeforeValidator(_gravity)] = 0.0
    contact_time: Annotated[float, BeforeValidator(_TC)] = 0.0
    container: GasContainer
    species: tuple[GasSpecies, ...]
    contacts: tuple[GasContact, ...] = ()
    drives: tuple[GasDrive, ...] = ()
    thermostat: GasThermostat | None = None
    run: GasSettings

    @model_validator(mode="after")
    def _sound(self) -> GasScene:
        refuse(gas_faults(self))
        return self

    @property
    def pull(self) -> tuple[float, ...]:
        """Gravity as a vector."""
        if isinstance(self.gravity, tuple):
            return self.gravity
        return (*(0.0,) * (self.container.axes - 1), -self.gravity)

    @property
    def count(self) -> int:
        """Balls in all."""
        return sum(one.count for one in self.species)

    @property
    def fraction(self) -> float:
        """The share of the volume (discs: of the area) that the balls fill."""
        unit = math.pi if self.container.axes == 2 else 4 / 3 * math.pi
        balls = sum(one.count * unit * one.radius**self.container.axes for one in self.species)
        return balls / self.container.room.volume

    @property
    def surfaces(self) -> dict[tuple[str, str], Surface]:
        """The contacts as the gas takes them."""
        return {contact.between: contact.surface for contact in self.contacts}

    @property
    def equilibrate(self) -> int:
        """Collisions before anything is measured."""
        return 40 * self.count if self.run.equilibrate is None else self.run.equilibrate

    def describe(self) -> str:
        """One line: balls, container, how dense, how long."""
        kind = "disc" if self.container.axes == 2 else "ball"
        what = f"{self.count:,} {kind}{'s' if self.count > 1 else ''}"
        what += f" of {len(self.species)} species" if len(self.species) > 1 else ""
        share = f"{'area' if kind == 'disc' else 'volume'} share {self.fraction:.4g}"
        run = [] if self.run.max_events is None else [f"{self.run.max_events:,} events"]
        run += [] if self.run.duration is None else [f"a time of {number(self.run.duration)}"]
        return f"{what}, {self.container.describe()}, {share}, {' or '.join(run)} after {self.equilibrate:,} events"
