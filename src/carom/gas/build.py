"""From the scene of a gas to the gas: where its balls start, and the faults that only this tells."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from carom.checks import nearest
from carom.errors import CaromError
from carom.gas.model import GasScene
from carom.gas.read import Start, read_start
from carom.gas.run import Gas
from carom.gas.start import scattered

__all__ = ["build"]

SINGLE = 1e-5  # of a radius: what rounding to single precision may bring about
# The densest that balls put in one after the other come to, with some room, as a share of the volume or area.
BY_CHANCE = {2: 0.50, 3: 0.34}


def build(scene: GasScene, where: str = "gas") -> Gas:
    """The gas of a scene, at its start. CaromError, naming ``where``, for starts that overlap, or that a file does not give."""
    axes, run, room = scene.container.axes, scene.run, scene.container.room
    options: dict[str, Any] = {}
    if run.start == "random":
        if scene.fraction > BY_CHANCE[axes]:
            raise CaromError(
                f"{where}: run.start: expected balls that fill at most {BY_CHANCE[axes]:g} of the container, if they are put in"
                f" at random, got {scene.fraction:.4g}; start = 'lattice' reaches further"
            )
        radii = np.repeat([one.radius for one in scene.species], [one.count for one in scene.species])
        rng = np.random.default_rng([run.seed, 1])
        options["position"] = scattered(radii, room.size, room.periodic, rng)
    elif run.start != "lattice":
        options = _from_file(scene, where)
    try:
        return Gas(
            [one.species(axes) for one in scene.species],
            room,
            contacts=scene.surfaces,
            gravity=scene.pull,
            contact_time=scene.contact_time,
            drives={one.wall: one.drive for one in scene.drives},
            thermostat=None if scene.thermostat is None else scene.thermostat.thermostat,
            seed=run.seed,
            **options,
        )
    except CaromError as error:
        raise CaromError(*(_retold(scene, where, fault) for fault in error.faults)) from None


def _from_file(scene: GasScene, where: str) -> dict[str, Any]:
    axes, path = scene.container.axes, Path(scene.run.start)
    start = read_start(path, axes, scene.container.room.size)
    order = _order(scene, where, start, path)
    found: dict[str, Any] = {"position": start.position[order]}
    for name, values in (("velocity", start.velocity), ("spin", start.spin)):
        if values is not None:
            found[name] = values[order]
    if path.suffix.lower() == ".gsd":  # single precision: balls that had just met overlap; the first event parts them
        found["touch"] = SINGLE
    return found


def _order(scene: GasScene, where: str, start: Start, path: Path) -> Any:
    """The rows of a file by species, in the scene's order."""
    names = [one.name for one in scene.species]
    if start.species is None:
        if len(start.position) != scene.count:
            got = f"{len(start.position)} in {path.name}"
            raise CaromError(f"{where}: run.start: expected {scene.count} balls, as the species say, got {got}")
        return slice(None)
    for name in start.species:
        if name not in names:
            raise CaromError(f"{path}: species: expected {', '.join(names)}, got {name!r}; {nearest(name, names)}")
    for one in scene.species:
        if (count := start.species.count(one.name)) != one.count:
            raise CaromError(
                f"{where}: run.start: expected {one.count} balls of species {one.name!r}, got {count} in {path.name}"
            )
    return np.argsort([names.index(name) for name in start.species], kind="stable")


def _retold(scene: GasScene, where: str, fault: str) -> str:
    """A fault of the gas, as one of the scene."""
    said = fault.removeprefix("Gas: ")
    if not said.startswith("position"):
        return f"{where}: {said}"
    said = said.removeprefix("position: ")
    if scene.run.start == "lattice":
        share = f"they fill {scene.fraction:.4g} of the container"
        return f"{where}: run.start: {said}: the lattice has no room for such balls, as {share}; fewer or smaller ones"
    return f"{where}: run.start: {said}, in {Path(scene.run.start).name}"
