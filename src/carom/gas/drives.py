"""Drives of a gas: walls that oscillate, slide, are moved by the gas, rotate or are heated; and a thermostat."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.errors import FaultList, checked_number, suggestion
from carom.gas.containers import Container
from carom.gas.edmd.gas_records import CURVE, FACE, OUTSIDE, PLANE
from carom.gas.edmd.moving_walls import oscillation, place
from carom.gas.faces import ContainerFace

__all__ = ["Drive", "Thermostat", "WallMotion", "drive_faults", "face_records", "motion_of_walls"]

# Of the largest radius: a ball whose centre is further behind a wall that bounds centres overlaps it (snapshots are in single
# precision).
CENTRE_DEPTH = 1e-4
_WARM = ("a number >= 0", lambda x: x >= 0)
_POSITIVE = ("a number > 0", lambda x: (x > 0) & (x < math.inf))
_NUMBER = ("a number", lambda x: abs(x) < math.inf)


def _check(faults: FaultList, of: Any, **fields: tuple[str, Any]) -> None:
    """Add a fault for every given field that is not a finite number with the property asked of it."""
    for name, (expected, holds) in fields.items():
        if getattr(of, name) is not None:
            checked_number(faults, name, getattr(of, name), expected, holds)


@dataclass(frozen=True)
class Drive:
    """A wall that moves, or is heated, or both: it oscillates, slides at a constant speed, is a piston, drags, or rotates.

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
        k_B T of their spins; default: the same.
    gradient : vector, optional
        Of a heated wall's temperature along itself (J/m); ``temperature`` is then that at the corner of the box, x = y = z = 0.
    speed : float, optional
        Of a plane wall along its normal (m/s), into the gas; below 0 out of it. Of a piston: at the start.
    travel : float, optional
        Distance after which a wall of constant speed rests (m).
    mass : float, optional
        Of a piston (kg), a plane wall that balls push: it moves along its normal under ``force`` and their impulses.
    force : float, optional
        On a piston, into the gas (N): its weight, a spring of constant force. Default: none.
    surface_velocity : vector, optional
        Of a plane wall's surface along itself (m/s), as of a conveyor belt: it drags balls by friction.
    spin : float or vector, optional
        Of obstacles that rotate about their centres (rad/s): about z for discs, and for obstacles of x, y, radius.
    moment : float, optional
        Moment of inertia of each such obstacle (kg m^2), which balls turn by friction, from ``spin`` (default: 0) on. Without
        one the spin is kept.

    Raises CaromError, one line per problem.

    Examples
    --------
    >>> from carom.gas import Drive
    >>> Drive(amplitude=0.2, frequency=10.0).phase
    0.0
    >>> Drive(speed=0.5, travel=2.0).mass is None
    True
    >>> Drive(amplitude=0.2)
    Traceback (most recent call last):
    carom.errors.CaromError: Drive: frequency: expected a number > 0 for an oscillating wall, got 0.0
    """

    amplitude: float = 0.0
    frequency: float = 0.0
    phase: float = 0.0
    temperature: float | None = None
    temperature_rotational: float | None = None
    gradient: Sequence[float] | None = None
    speed: float | None = None
    travel: float | None = None
    mass: float | None = None
    force: float | None = None
    surface_velocity: Sequence[float] | None = None
    spin: float | Sequence[float] | None = None
    moment: float | None = None

    def __post_init__(self) -> None:  # noqa: D105
        faults = FaultList("Drive")
        _check(
            faults, self, amplitude=_WARM, frequency=_WARM, temperature=_WARM, temperature_rotational=_WARM,
            phase=("a number from 0 to 1", lambda x: (x >= 0) & (x <= 1)), speed=_NUMBER, travel=_POSITIVE, mass=_POSITIVE,
            force=_NUMBER, moment=_POSITIVE,
        )  # fmt: skip
        for name in ("gradient", "surface_velocity", "spin"):
            given = getattr(self, name)
            if given is not None and not (np.ndim(given) <= 1 and np.size(given) <= 3 and np.isfinite(given).all()):
                faults.add(name, "up to three numbers", f"{given!r:.60}")
        if self.amplitude > 0 and not self.frequency > 0:
            faults.add("frequency", "a number > 0 for an oscillating wall", f"{self.frequency!r}")
        if not self.moves and self.temperature is None:
            expected = "an amplitude > 0, a temperature, a speed, a mass, a surface_velocity, a spin or a moment"
            faults.add("amplitude", expected, "none of them")
        self._add_conflicts(faults)
        faults.raise_if_any()

    def _add_conflicts(self, faults: FaultList) -> None:
        """Add the faults of fields that another one needs, or excludes."""
        slides = self.speed is not None or self.mass is not None
        ways = {
            "amplitude": self.amplitude > 0,
            "mass" if self.mass is not None else "speed": slides,
            "surface_velocity": self.surface_velocity is not None,
            "moment" if self.moment is not None else "spin": self.turns,
        }
        if len(given := [name for name, there in ways.items() if there]) > 1:
            faults.add(given[1], "one way to move", " and ".join(given), "omit one of them")
        if self.speed is not None and self.mass is None and self.travel is None:
            faults.add("travel", "the distance after which a wall of constant speed rests", "none")
        if self.mass is not None and self.travel is not None:
            faults.add("travel", "none for a piston", f"{self.travel:g}", "omit it")
        for name, needed in (("force", "mass"), ("gradient", "temperature")):
            if getattr(self, name) is not None and getattr(self, needed) is None:
                faults.add(needed, f"a {needed} with a {name}", "none")
        if self.temperature is not None and (self.mass is not None or self.moment is not None):
            faults.add("temperature", "none for a wall that balls move", f"{self.temperature:g}", "omit it")

    @property
    def turns(self) -> bool:
        """Whether it is a rotor."""
        return self.spin is not None or self.moment is not None

    @property
    def moves(self) -> bool:
        """Whether the wall or its surface moves."""
        given = (self.speed, self.mass, self.surface_velocity, self.spin, self.moment)
        return self.amplitude > 0 or any(one is not None for one in given)

    @property
    def greatest_speed(self) -> float:
        """A speed that the wall's motion gives to balls (m/s), about."""
        drag = 0.0 if self.surface_velocity is None else math.hypot(*self.surface_velocity)
        return self.amplitude * self.frequency + abs(self.speed or 0.0) + drag


@dataclass(frozen=True)
class Thermostat:
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

    temperature: float
    rate: float
    temperature_rotational: float | None = None

    def __post_init__(self) -> None:  # noqa: D105
        faults = FaultList("Thermostat")
        _check(faults, self, temperature=_WARM, temperature_rotational=_WARM, rate=_POSITIVE)
        faults.raise_if_any()


@dataclass(frozen=True)
class WallMotion:
    """The motion of a wall at one time."""

    displacement: float
    """Along its normal since the start, into the gas (m)."""
    speed: float
    """Along its normal, into the gas (m/s)."""
    spins: tuple[float, ...]
    """Of obstacles that rotate, about z (rad/s): one for each, in their order."""

    def to_dict(self) -> dict[str, float | list[float]]:
        """Return the motion as plain numbers: displacement and speed of a plane, spins of obstacles."""
        return {"spins": list(self.spins)} if self.spins else {"displacement": self.displacement, "speed": self.speed}


def motion_of_walls(faces: Any, names: Sequence[str], now: float, oscillating: bool = False) -> dict[str, WallMotion]:
    """Return the motion of the walls that move, by their names, from the engine's records at a time of its clock.

    Walls that oscillate, whose motion is known, are among them only if asked for.
    """
    found = {}
    for name in dict.fromkeys(names):
        those = [k for k, one in enumerate(names) if one == name and faces[k]["moving"] != 0]
        if those:
            face, rotors = faces.view(np.recarray)[those[0]], [k for k in those if faces[k]["rotor"] == k]
            displacement, speed, _half = place(face, now)
            found[name] = WallMotion(float(displacement), float(speed), tuple(float(faces[k]["wz"]) for k in rotors))
        shaken = [k for k, one in enumerate(names) if one == name and faces[k]["amplitude"] != 0]
        if oscillating and shaken:
            displacement, speed, _half, _left = oscillation(faces.view(np.recarray)[shaken[0]], now)
            found[name] = WallMotion(float(displacement), float(speed), ())
    return found


def drive_faults(drive: Drive, name: str, container: Container) -> list[tuple[str, str, str]]:
    """Return the faults of a drive on a wall of a container: the field, what is expected, and what is found."""
    faces = [face for face in container.faces if face.name == name]
    fixed = next((face.fixed_because for face in faces if face.fixed_because), "")
    found = [
        (field, "a plane wall to oscillate" if field == "amplitude" else "a plane wall", f"{name!r}, {fixed}")
        for field in ("amplitude", "speed", "mass", "surface_velocity")
        if getattr(drive, field) and fixed
    ]
    if drive.turns and not all(_can_turn(face, container) for face in faces):
        field = "moment" if drive.moment is not None else "spin"
        found.append((field, "round obstacles, of discs or of spheres (x, y, z, radius)", f"{name!r}"))
    axes = len(container.size)
    for field in ("gradient", "surface_velocity", "spin"):
        given = getattr(drive, field)
        wanted = {1, 3} if field == "spin" and axes == 3 else {1} if field == "spin" else {axes}
        if given is not None and np.size(given) not in wanted:
            found.append((field, f"{max(wanted)} number{'s' * (max(wanted) > 1)}", f"{np.size(given)}"))
    if drive.surface_velocity is not None and len(drive.surface_velocity) == axes:
        along = np.array(drive.surface_velocity)
        if any(abs(np.array(face.vector)[:axes] @ along) > 0 for face in faces):
            found.append(("surface_velocity", "a velocity along the wall", f"{tuple(drive.surface_velocity)}"))
    if drive.gradient is not None and drive.temperature is not None and len(drive.gradient) == axes:
        steepest = sum(min(g * length, 0.0) for g, length in zip(drive.gradient, container.size, strict=True))
        if drive.temperature + steepest < 0 and not _is_warm(drive, faces, container):
            found.append(("gradient", "temperatures >= 0 all over the wall", f"{tuple(drive.gradient)}"))
    return found


def _can_turn(face: ContainerFace, container: Container) -> bool:
    """Return whether a face is a whole disc in the plane, or a sphere in space."""
    return face.form == OUTSIDE and face.radius > 0 and (len(container.size) == 2 or face.vector[2] == 1.0)


def _is_warm(drive: Drive, faces: Sequence[ContainerFace], container: Container) -> bool:
    """Return whether plane walls of a box have temperatures >= 0 at all of their corners."""
    assert drive.gradient is not None
    assert drive.temperature is not None
    for face in faces:
        if face.form != PLANE:
            return False
        least = drive.temperature
        for axis, slope in enumerate(drive.gradient):
            ends = (0.0, container.size[axis])
            if abs(face.vector[axis]) == 1:
                ends = (face.centre[axis],) * 2
            least += min(slope * end for end in ends)
        if least < 0:
            return False
    return True


def face_records(
    faults: FaultList, container: Container, drives: Mapping[str, Drive], widest: float
) -> NDArray[np.void]:
    """Return the records of the faces, with the drives of their walls; ``widest`` is the largest radius."""
    faces, rows = np.zeros(len(container.faces), FACE), 0  # (of the tables of curves so far)
    for name in sorted(set(drives) - set(container.names)):
        faults.add("drives", "names of walls", f"{name!r}; {suggestion(name, list(container.names))}")
    for name in sorted(set(drives) & set(container.names)):
        for field, expected, got in drive_faults(drives[name], name, container):
            faults.add(f"drives[{name!r}].{field}", expected, got)
    faults.raise_if_any()
    for k, (record, face) in enumerate(zip(faces, container.faces, strict=True)):
        record["form"], record["area"], record["temperature"] = face.form, face.area, -1.0
        record["stop"], record["rotor"] = math.inf, -1
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
            if drive.turns:
                record["rotor"] = _rotor(k, container)
    return faces


def _set_drive(record: Any, drive: Drive) -> None:
    """Set the motion and the heat of a face."""
    if drive.amplitude > 0:
        record["amplitude"], record["half_period"] = drive.amplitude, 0.5 / drive.frequency
        record["start"] = -drive.phase / drive.frequency
    if drive.temperature is not None:
        record["temperature"] = drive.temperature
        record["spin_temperature"] = (
            drive.temperature if drive.temperature_rotational is None else drive.temperature_rotational
        )
        for axis, slope in zip("xyz", drive.gradient or (), strict=False):
            record["t" + axis] = slope
    if drive.mass is not None or drive.speed:
        record["moving"], record["speed"], record["mass"] = 1, drive.speed or 0.0, drive.mass or 0.0
        record["reach"] = (
            math.inf if drive.mass is not None else max(math.copysign(drive.travel or 0.0, drive.speed or 0.0), 0.0)
        )
        if drive.mass is not None:
            record["pull"] = (drive.force or 0.0) / drive.mass
        else:
            record["stop"] = (drive.travel or 0.0) / abs(drive.speed or math.inf)
    if drive.surface_velocity is not None or drive.turns:
        record["moving"], record["moment"] = 2, drive.moment or 0.0
        for axis, speed in zip("xyz", drive.surface_velocity or (), strict=False):
            record["u" + axis] = speed
        spin = np.atleast_1d(0.0 if drive.spin is None else drive.spin)
        for axis, component in zip("z" if len(spin) == 1 else "xyz", spin.tolist(), strict=True):
            record["w" + axis] = component


def _rotor(k: int, container: Container) -> int:
    """Return the face that has the motion of an obstacle: itself, or the one of which it is a periodic image."""
    face, size = container.faces[k], np.ones(3)
    size[: len(container.size)] = container.size
    for number, other in enumerate(container.faces):
        apart = (np.array(other.centre) - np.array(face.centre)) / size
        if (other.name, other.radius) == (face.name, face.radius) and np.abs(apart - np.round(apart)).max() < 1e-9:
            return number
    return k
