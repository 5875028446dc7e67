"""Species of a gas, contacts and cells: checked, and written as the records of the event engine."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.bodies import Ball
from carom.errors import Fault, FaultList, require_type
from carom.gas.contact_forms import Contacts, contact_records, contacts_by_names
from carom.gas.containers import Container
from carom.gas.drives import Drive, Thermostat, face_records
from carom.gas.edmd.driver import SystemRecords
from carom.gas.edmd.gas_records import (
    ELLIPSE,
    FLOW,
    LAYER,
    MAX_BALLS,
    SHEAR,
    SPECIES,
    SYSTEM,
    WHOLE,
)  # fmt: skip
from carom.gas.faces import JOINT_OVERLAP
from carom.gas.sizes import LONGEST_SIDE, cells_at_most
from carom.gas.spatial_profiles import layer_axis

__all__ = ["Species", "shear_faults", "system_records"]

FASTEST_FLOW = (
    1e6  # thermal speeds, of a shear flow across the box: faster, images go by so fast that hardly a ball meets another
)
MOST_KICKS = 1e6  # of a thermostat, on a ball's way of one radius
BALLS_PER_CELL = 0.5  # where the balls are small compared with their distances


@dataclass(frozen=True)
class Species:
    """Balls of one kind.

    Parameters
    ----------
    ball : Ball or Disc
        Radius, mass and moment of inertia.
    count : int
        Number of balls.
    name : str
        What contacts and tables call it.
    temperature : float
        k_B T at the start (J, if masses and speeds are in SI units): the mean of m v^2 along each axis.
    temperature_rotational : float, optional
        Mean of I w^2 about each axis of spin; default: the same; 0 starts without spin.
    radii : (count,) array, optional
        Radius of each ball (m), where they differ; ``ball`` then gives the material: mass grows with the volume (of discs the
        area). More than 48 different radii are divided into 48 classes of equal numbers of balls, each with their mean radius.

    Examples
    --------
    >>> from carom import Ball
    >>> from carom.gas import Species
    >>> Species(Ball(0.5, 1.0), 1000, "steel", temperature=2.0).count
    1000
    """

    ball: Ball
    count: int
    name: str = "a"
    temperature: float = 1.0
    temperature_rotational: float | None = None
    radii: ArrayLike | None = field(default=None, compare=False)


def _set_cells(faults: FaultList, one: Any, container: Container, widest: float, longest: float, count: int) -> None:
    """Divide the box into cells of at least a diameter, not many more of them than balls."""
    if max(container.size) > longest:
        expected = f"at most {LONGEST_SIDE:g} radii of the smallest ball ({longest:g})"
        faults.add("side", expected, f"{max(container.size):g}")
    size, axes = np.array(container.size), len(container.size)
    width = max(widest, (BALLS_PER_CELL * size.prod() / count) ** (1 / axes))
    wanted = [max(int(length / width), min(3, int(length / widest))) for length in size.tolist()]
    for axis, n in enumerate(cells_at_most(wanted, count)):
        if wanted[axis] < (3 if container.periodic[axis] else 1):
            least = "three diameters" if container.periodic[axis] else "one diameter"
            faults.add(
                "side", f"at least {least} of the largest ball ({widest:g})", f"{size[axis]:g} along axis {axis}"
            )
        one["cells"][axis], one["cell_size"][axis] = n, size[axis] / max(n, 1)


def _check_discs(faults: FaultList, species: Sequence[Species], axes: int) -> None:
    discs = [one for one in species if one.ball.planar]
    if discs and axes == 3:
        flat = ", ".join(one.name for one in discs)
        faults.add("species", "carom.Ball in three dimensions", f"a Disc, which spins about z only: {flat}")
    if wide := [one.name for one in discs if one.ball.kappa > 1]:
        faults.add(
            "species",
            "kappa of at most 1 for discs that meet each other, as weights beyond the rims would meet first",
            f"more: {', '.join(wide)}",
        )


def system_records(
    species: Sequence[Species],
    container: Container,
    contacts: Contacts,
    gravity: Any,
    contact_time: float,
    drives: Mapping[str, Drive],
    thermostat: Thermostat | None,
    seed: int,
    groups: Sequence[int] | None = None,
    shear_rate: float = 0.0,
) -> SystemRecords:
    """Return the records of a gas without its balls; CaromError with every fault.

    ``groups`` numbers the species of which the given ones are classes of radii, which may then have one name.
    """
    faults, axes = FaultList("Gas"), len(container.size)
    for one in species:
        require_type("Gas", "species", one, Species)
    names = [one.name for one in species]
    count = sum(one.count for one in species)
    if not names or min(one.count for one in species) < 0 or not 0 < count <= MAX_BALLS:
        faults.add("species", f"1 to {MAX_BALLS} balls in total", f"{[one.count for one in species]}")
    if len(set(names)) < (len(names) if groups is None else len(set(groups))):
        faults.add("species", "a different name for each", f"{names}")
    _check_discs(faults, species, axes)
    pull = np.array(gravity, dtype=float)
    if pull.shape not in {(3,), (axes,)} or not np.isfinite(pull).all():
        faults.add("gravity", f"{axes} numbers", f"{gravity!r}")
    elif axes == 2 and pull[2:].any():
        faults.add("gravity", "no component along z for discs", f"{gravity!r}")
    if not 0 <= contact_time < math.inf:
        faults.add("contact_time", "a time >= 0", f"{contact_time!r}")
    by_names = contacts_by_names(faults, contacts, names, container)
    faults.raise_if_any()
    system = np.zeros(1, SYSTEM)
    one = system[0]
    one["dimensions"], one["side"], one["periodic"], one["cells"], one["cell_size"] = axes, 1.0, 1, 1, 1.0
    one["side"][:axes], one["periodic"][:axes], one["volume"] = container.size, container.periodic, container.volume
    one["gravity"][: len(pull)] = pull
    one["contact_time"], one["scale"] = contact_time, 1.0
    # the engine's random numbers are a stream of their own; consecutive seeds give independent streams
    one["key"] = np.random.SeedSequence(seed).generate_state(2).astype(np.int64)
    _set_thermostat(faults, one, thermostat, species)
    widest = max(float(one.ball.radius) for one in species)
    longest = LONGEST_SIDE * min(float(one.ball.radius) for one in species)
    _set_cells(faults, system[0], container, 2 * widest, longest, count)
    for face in container.faces:
        if face.form == ELLIPSE and not widest < min(face.vector[:2]) * (1 - JOINT_OVERLAP):
            faults.add(
                "species", f"radii below {min(face.vector[:2]):g}, the ellipse's smaller half axis", f"{widest:g}"
            )
    faces = face_records(faults, container, drives, widest)
    fastest = max(math.sqrt(one.temperature / one.ball.mass) for one in species)
    shear = _shear_record(faults, container, pull, shear_rate, fastest)
    kinds = np.array([(kind.ball.radius, kind.ball.mass, kind.ball.kappa) for kind in species], SPECIES)
    radii = [(kind.name, float(kind.ball.radius)) for kind in species]
    pairs, pair_forms, with_walls, wall_forms = contact_records(faults, radii, container.faces, by_names)
    faults.raise_if_any()
    if pairs["smooth"].all() and not ((with_walls["mu"] != 0) & (with_walls["beta"] != -1)).any():
        # nothing couples to the spins: energy that a wall gives to them would only be carried from wall to wall
        for record, face in zip(faces, container.faces, strict=True):
            if face.name in drives and drives[face.name].temperature_rotational is None:
                record["spin_temperature"] = 0.0
    whole, axis = np.zeros(1, WHOLE), layer_axis(container, one["gravity"].tolist(), drives, shear_rate != 0)
    whole["axis"] = axis
    layers = np.zeros(0 if axis < 0 else int(one["cells"][axis]) * len(species), LAYER)
    curves, flows = container.curves, np.zeros(len(species), FLOW)
    return SystemRecords(
        system, kinds, pairs, pair_forms, with_walls, wall_forms, faces, curves, shear, whole, flows, layers
    )


def _set_thermostat(faults: FaultList, one: Any, thermostat: Thermostat | None, species: Sequence[Species]) -> None:
    """Set the thermostat's rate and temperatures; add the fault of a rate with which balls hardly move."""
    if thermostat is None:
        return
    radius = min(float(kind.ball.radius) for kind in species)
    most = MOST_KICKS * max(math.sqrt(thermostat.temperature / kind.ball.mass) for kind in species) / radius
    if thermostat.rate > most > 0:
        expected = f"at most {MOST_KICKS:g} thermal speeds per radius of the smallest ball, {most:.3g}"
        faults.add(
            "thermostat.rate",
            expected,
            f"{thermostat.rate:g}",
            "lower it: kicked so often, hardly a ball meets another",
        )
    rotational = thermostat.temperature_rotational
    one["rate"], one["temperature"] = thermostat.rate * sum(kind.count for kind in species), thermostat.temperature
    one["spin_temperature"] = thermostat.temperature if rotational is None else rotational


def _shear_record(
    faults: FaultList, container: Container, gravity: Any, rate: float, thermal_speed: float
) -> NDArray[np.void]:
    """Return the record of a shear rate, or none."""
    if not math.isfinite(rate):
        faults.add("shear_rate", "a finite rate", f"{rate!r}")
    elif rate != 0:
        faults += [
            replace(fault, where=faults.where) for fault in shear_faults(container, gravity, rate, thermal_speed)
        ]
        return np.array([(rate, rate * container.size[1], 0.0)], SHEAR)
    return np.zeros(0, SHEAR)


def shear_faults(container: Container, gravity: Any, rate: float, thermal_speed: float) -> list[Fault]:
    """Return the faults of a shear rate in a container, of a gas with a thermal speed along an axis (0: at rest)."""
    found = FaultList()
    if container.faces or not all(container.periodic):
        got = f"walls {', '.join(container.names)}"
        found.add(
            "shear_rate", "a box that is periodic along all axes, without walls", got, "omit the rate or the walls"
        )
    if any(gravity):
        found.add(
            "shear_rate", "no gravity, under which a gas without walls falls for ever", "gravity", "omit one of them"
        )
    most = FASTEST_FLOW * thermal_speed / container.size[1]
    if not found and abs(rate) > most > 0:
        expected = f"at most {FASTEST_FLOW:g} thermal speeds across the box, {most:.3g}"
        found.add("shear_rate", expected, f"{rate:g}", "lower the rate, or raise the temperature")
    return found
