"""From the scene of a gas to the gas: where its balls start, and the faults that only this tells."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from carom.checks import nearest
from carom.errors import CaromError
from carom.gas.dense import dense
from carom.gas.model import GasScene
from carom.gas.read import Start, read_start
from carom.gas.run import Gas

__all__ = ["build"]

SINGLE = 1e-5  # of a radius: what rounding to single precision may bring about


def build(scene: GasScene, where: str = "gas", progress: Callable[[float], None] | None = None) -> Gas:
    """The gas of a scene, at its start. CaromError, naming ``where``, for starts that overlap, or that a file does not give.

    ``progress`` is called while a dense random start grows, with the share of the final radii.
    """
    axes, run, room = scene.container.axes, scene.run, scene.container.room
    options: dict[str, Any] = {}
    if run.start == "random":
        radii = np.repeat([one.radius for one in scene.species], [one.count for one in scene.species])
        # (velocities are drawn from the seed itself)
        seed = int(np.random.SeedSequence([run.seed, 1]).generate_state(1)[0])
        try:
            options["position"] = dense(radii, room, seed=seed, progress=progress)
        except CaromError as error:
            raise CaromError(*(_retold(scene, where, fault) for fault in error.faults)) from None
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
    for part in ("position: ", "dense: ", "lattice: "):
        if said.startswith(part):
            file = f", in {Path(scene.run.start).name}" if Path(scene.run.start).suffix else ""
            return f"{where}: run.start: {said.removeprefix(part)}{file}"
    return f"{where}: {said}"
