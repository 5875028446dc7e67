"""Starts of a gas: given vectors checked, positions found, velocities and spins drawn, overlaps refused."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.errors import CaromError, FaultList
from carom.gas.containers import Container
from carom.gas.edmd.driver import SystemRecords
from carom.gas.initial import dense, lattice, thermal
from carom.gas.overlaps import first_overlap
from carom.gas.species import Species

__all__ = ["TOUCH", "draw_thermal", "require_no_overlap", "start_positions", "vectors"]

Array = NDArray[np.float64]
TOUCH = 1e-9  # of a radius: balls that overlap by less count as touching


def vectors(faults: FaultList, name: str, given: Any, count: int, axes: int) -> Array:
    """Return given vectors as (count, 3): two components are along x and y, one is about z. Zeros if nothing was given."""
    rows = np.zeros((count, 3))
    if given is None:
        return rows
    array = np.array(given, dtype=float)
    if axes == 1 and array.shape == (count,):
        array = np.column_stack((np.zeros((count, 2)), array))
    if array.shape not in {(count, 3), (count, axes)} or not np.isfinite(array).all():
        faults.add(name, f"finite numbers of shape ({count}, {axes})", f"shape {array.shape}")
        return rows
    rows[:, : array.shape[1]] = array
    if (axes == 2 and rows[:, 2].any()) or (axes == 1 and rows[:, :2].any()):
        faults.add(name, "vectors in the plane of the discs (spins: normal to it)", "other components")
    return rows


def start_positions(container: Container, records: SystemRecords, radius: Array, seed: int) -> Array:
    """Return positions on a lattice if the balls fit, else a dense random packing."""
    try:
        x = lattice(len(radius), container, float(radius.max()))
    except CaromError:
        return dense(radius, container, seed=seed)
    # (the margin of a box may be more than it has)
    bad = (container.clearance(radius, x) < 0).any() or first_overlap(records.system[0], radius, x, TOUCH) is not None
    return dense(radius, container, seed=seed) if bad else x


def require_no_overlap(container: Container, records: SystemRecords, radius: Array, x: Array, touch: float) -> None:
    """Raise CaromError where balls overlap each other, or a wall, by more than rounding."""
    faults = FaultList("Gas")
    out = container.clearance(radius, x) < -touch * radius
    if out.any():
        i = int(np.argmax(out))
        faults.add(
            "position", "balls inside the container", f"ball {i} at {x[i]} overlaps a wall ({out.sum()} of {len(x)} do)"
        )
    faults.raise_if_any()
    pair = first_overlap(records.system[0], radius, x, touch)
    if pair is not None:
        i, j = pair
        faults.add("position", "balls that do not overlap", f"balls {i} and {j}, at {x[i]} and {x[j]}")
    faults.raise_if_any()


def draw_thermal(
    memory: Mapping[str, NDArray[Any]], species: Sequence[Species], kinds: Any, which: Any, axes: int, rng: Any,
    velocities: bool, spins: bool,
) -> None:  # fmt: skip
    """Draw what is asked for, velocities or spins or both, species by species, into the records of a gas."""
    about = (0, 1, 2) if axes == 3 else (2,)
    for k, one in enumerate(species):
        those: Any = slice(None) if len(species) == 1 else which == k
        kind = kinds[k]
        moment = kind["kappa"] * kind["mass"] * kind["radius"] ** 2
        rotational = one.temperature if one.temperature_rotational is None else one.temperature_rotational
        if velocities:
            v = thermal(np.full(one.count, kind["mass"]), tuple(range(axes)), one.temperature, rng)
            for axis, name in enumerate(("vx", "vy", "vz")):
                memory["motions"][name][those] = v[:, axis]
            del v  # (of many balls it is large)
        if spins:
            w = thermal(np.full(one.count, moment), about, rotational, rng)
            for axis, name in enumerate(("wx", "wy", "wz")):
                memory["bodies"][name][those] = w[:, axis]
            del w
