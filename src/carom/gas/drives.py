"""Drives of a gas: walls that oscillate, are moved by the gas, drag or are heated; and a thermostat."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Annotated, Any, Self, cast

import numpy as np
from numpy.typing import NDArray
from pydantic import BeforeValidator, model_validator

from carom.errors import FaultList
from carom.gas.containers import Container
from carom.gas.edmd.gas_records import CURVE, WALL_FACE
from carom.gas.edmd.walls import oscillation, place
from carom.scene.schema import Components, Mass, Model, Number, Share, Speed, raise_faults

# Of the largest radius: a ball whose centre is further behind a wall that bounds centres overlaps it (snapshots are in single
# precision).
CENTRE_DEPTH = 1e-4
_TEMPERATURE = Annotated[float, BeforeValidator(Number("a temperature k_B T >= 0", "J", least=0))]
_AMPLITUDE = Number("an amplitude >= 0", "m", least=0)
_FREQUENCY = Number("a frequency > 0", "1/s", least=0, above=True)
_RATE = Number("a rate > 0: kicks per ball per unit time", "1/s", least=0, above=True)
_FORCE = Number("a force", "N")
_ALONG = Components("2 or 3 speeds along x, y (and z)", (2, 3))


class Drive(Model):
    """A wall that moves, or is heated, or both: it oscillates, is a piston, or drags.

    Parameters
    ----------
    amplitude : float
        Of a plane wall's oscillation along its normal (m). Its position consists of parabolas, ``amplitude`` up and then down,
        half a period each: position and velocity are continuous, and the instants of contact are roots of parabolas, exact. It
        differs from a sine of this amplitude and frequency by at most 6 % of the amplitude; its greatest speed is
        8 amplitude frequency (a sine's: 2 pi), its acceleration 32 amplitude frequency^2 (4 pi^2, at most).
    frequency : float
        Oscillations per unit time (1/s).
    phase : float
        Where in the period it starts, 0 to 1: at 0 in the middle, moving into the gas; at 1/4 furthest into it.
    temperature : float, optional
        k_B T of balls that leave a heated wall (J): their velocities are Maxwellian, weighted by the normal component (complete
        thermalization).
    temperature_rotational : float, optional
        k_B T of their spins; default: the same, and 0 in a gas of smooth balls and walls, whose spins matter to nothing.
    mass : float, optional
        Of a piston (kg), a plane wall that balls push: it moves along its normal under ``force`` and their impulses.
    speed : float, optional
        Of a piston at the start, into the gas (m/s). Default: it rests.
    force : float, optional
        On a piston, into the gas (N): its weight, a spring of constant force. Default: none.
    surface_velocity : vector, optional
        Of a plane wall's surface along itself (m/s), as of a conveyor belt: it drags balls by friction.

    Raises CaromError, one line per problem.

    Examples
    --------
    >>> from carom.gas import Drive
    >>> Drive(amplitude=0.2, frequency=10.0).phase
    0.0
    >>> Drive(amplitude=0.2)
    Traceback (most recent call last):
    carom.errors.CaromError: Drive: frequency: expected a number > 0 for an oscillating wall, got none
    """

    amplitude: Annotated[float, BeforeValidator(_AMPLITUDE)] = 0.0
    frequency: Annotated[float, BeforeValidator(_FREQUENCY)] | None = None
    phase: Share = 0.0
    temperature: _TEMPERATURE | None = None
    temperature_rotational: _TEMPERATURE | None = None
    mass: Mass | None = None
    speed: Speed | None = None
    force: Annotated[float, BeforeValidator(_FORCE)] | None = None
    surface_velocity: Annotated[tuple[Speed, ...], BeforeValidator(_ALONG)] | None = None

    @model_validator(mode="after")
    def _check(self) -> Self:
        faults = FaultList()
        if self.amplitude > 0 and self.frequency is None:
            faults.add("frequency", "a number > 0 for an oscillating wall", "none")
        if not self.moves and self.temperature is None:
            expected = "an amplitude > 0, a temperature, a mass or a surface_velocity"
            faults.add("amplitude", expected, "none of them")
        self._add_conflicts(faults)
        raise_faults(faults)
        return self

    def _add_conflicts(self, faults: FaultList) -> None:
        """Add the faults of fields that another one needs, or excludes."""
        ways = {
            "amplitude": self.amplitude > 0,
            "mass": self.mass is not None,
            "surface_velocity": self.surface_velocity is not None,
        }
        if len(given := [name for name, there in ways.items() if there]) > 1:
            faults.add(given[1], "one way to move", " and ".join(given), "omit one of them")
        for name in ("speed", "force"):
            if getattr(self, name) is not None and self.mass is None:
                faults.add("mass", f"a mass with a {name}", "none")
        if self.temperature is not None and self.mass is not None:
            faults.add("temperature", "none for a wall that balls move", f"{self.temperature:g}", "omit it")

    @property
    def moves(self) -> bool:
        """Whether the wall or its surface moves."""
        return self.amplitude > 0 or self.mass is not None or self.surface_velocity is not None

    @property
    def greatest_speed(self) -> float:
        """A speed that the wall's motion gives to balls (m/s), about."""
        drag = 0.0 if self.surface_velocity is None else math.hypot(*self.surface_velocity)
        return self.amplitude * (self.frequency or 0.0) + abs(self.speed or 0.0) + drag


class GasDrive(Drive):
    """The wall of a name that moves or is heated, with the parameters of :class:`carom.gas.Drive`."""

    wall: str


def _each(value: Any) -> Any:
    """Return drives by the names of their walls as a list."""
    if not isinstance(value, Mapping) or not all(isinstance(one, Drive) for one in value.values()):
        return value
    return [{"wall": wall} | {name: getattr(one, name) for name in Drive.model_fields} for wall, one in value.items()]


AnyDrives = Annotated[tuple[GasDrive, ...], BeforeValidator(_each)]


class Thermostat(Model):
    """Andersen's thermostat: each ball, at random instants, gets a new velocity and spin from a Maxwellian.

    The instants form a Poisson process, and are events like all others. Where contacts conserve energy, the gas
    approaches the canonical distribution, positions included; momentum is not conserved (H. C. Andersen,
    J. Chem. Phys. 72, 2384 (1980)).

    Parameters
    ----------
    temperature : float
        k_B T (J).
    rate : float
        Kicks per ball per unit time (1/s).
    temperature_rotational : float, optional
        k_B T of the spins; default: the same.

    Raises CaromError, one line per problem.

    Examples
    --------
    >>> from carom.gas import Thermostat
    >>> Thermostat(temperature=1.0, rate=0.1).rate
    0.1
    """

    temperature: _TEMPERATURE
    rate: Annotated[float, BeforeValidator(_RATE)]
    temperature_rotational: _TEMPERATURE | None = None


@dataclass(frozen=True)
class WallMotion:
    """The motion of a wall at one time."""

    displacement: float
    """Along its normal since the start, into the gas (m)."""
    speed: float
    """Along its normal, into the gas (m/s)."""

    def to_dict(self) -> dict[str, float]:
        """Return the motion as plain numbers."""
        return {"displacement": self.displacement, "speed": self.speed}


def motion_of_walls(faces: Any, names: Sequence[str], now: float, oscillating: bool = False) -> dict[str, WallMotion]:
    """Return the motion of the walls that move, by their names, from the engine's records at a time of its clock.

    Walls that oscillate, whose motion is known, are among them only if asked for.
    """
    found = {}
    for name in dict.fromkeys(names):
        those = [k for k, one in enumerate(names) if one == name and (faces[k]["mass"] > 0 or faces[k]["is_belt"])]
        if those:
            displacement, speed, _half = place(faces.view(np.recarray)[those[0]], now)
            found[name] = WallMotion(float(displacement), float(speed))
        shaken = [k for k, one in enumerate(names) if one == name and faces[k]["amplitude"] != 0]
        if oscillating and shaken:
            displacement, speed, _half, _left = oscillation(faces.view(np.recarray)[shaken[0]], now)
            found[name] = WallMotion(float(displacement), float(speed))
    return found


def drive_faults(drive: Drive, name: str, container: Container) -> list[tuple[str, str, str]]:
    """Return the faults of a drive on a wall of a container: the field, what is expected, and what is found."""
    faces = [face for face in container.faces if face.name == name]
    fixed = next((face.fixed_because for face in faces if face.fixed_because), "")
    found = [
        (field, "a plane wall to oscillate" if field == "amplitude" else "a plane wall", f"{name!r}, {fixed}")
        for field in ("amplitude", "mass", "surface_velocity")
        if getattr(drive, field) and fixed
    ]
    axes, along = len(container.size), drive.surface_velocity
    if along is not None and np.size(along) != axes:
        found.append(("surface_velocity", f"{axes} numbers", f"{np.size(along)}"))
    elif along is not None and any(abs(np.array(face.vector)[:axes] @ np.array(along)) > 0 for face in faces):
        found.append(("surface_velocity", "a velocity along the wall", f"{tuple(along)}"))
    return found


def face_records(container: Container, drives: Mapping[str, Drive], widest: float) -> NDArray[np.void]:
    """Return the records of the faces, with the drives of their walls; ``widest`` is the largest radius."""
    faces, rows = np.zeros(len(container.faces), WALL_FACE), 0  # (of the tables of curves so far)
    for record, face in zip(faces, container.faces, strict=True):
        record["form"], record["area"], record["temperature"] = face.form, face.area, -1.0
        for part, numbers in (("n", face.vector), ("m", face.centre), ("a", face.along)):
            for axis, component in zip("xyz", numbers, strict=True):
                record[part + axis] = component
        record["bounded"], record["low"], record["high"] = face.bounded, face.low, face.high
        if face.form == CURVE:
            record["depth"], rows = rows, rows + len(face.table)
        elif not face.bounds_surfaces:
            record["depth"] = CENTRE_DEPTH * widest
        if (drive := drives.get(face.name)) is not None:
            _set_drive(record, drive)
    return faces


def _set_drive(record: Any, drive: Drive) -> None:
    """Set the motion and the heat of a face."""
    if drive.amplitude > 0:
        frequency = cast(float, drive.frequency)
        record["amplitude"], record["half_period"] = drive.amplitude, 0.5 / frequency
        record["start"] = -drive.phase / frequency
    if drive.temperature is not None:
        record["temperature"] = drive.temperature
        record["spin_temperature"] = (
            drive.temperature if drive.temperature_rotational is None else drive.temperature_rotational
        )
    if drive.mass is not None:
        record["mass"], record["speed"], record["pull"] = (
            drive.mass,
            drive.speed or 0.0,
            (drive.force or 0.0) / drive.mass,
        )
    if drive.surface_velocity is not None:
        record["is_belt"] = 1
        for axis, speed in zip("xyz", drive.surface_velocity, strict=False):
            record["u" + axis] = speed
