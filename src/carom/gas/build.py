"""Build gases from scenes and TOML files."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from importlib.resources import files
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.errors import CaromError, Fault, require_type, suggestion
from carom.files import as_path
from carom.gas.gas import Gas
from carom.gas.initial import dense
from carom.gas.scene import GasScene
from carom.gas.snapshots import InitialState, read_initial_state
from carom.public.progress import Progress
from carom.scene.presets import parse_toml, read_toml
from carom.scene.schema import from_file
from carom.scene.toml import toml_text

Array = NDArray[Any]

SINGLE_PRECISION = 1e-5  # of a radius: an overlap that rounding to single precision may cause


def build(scene: GasScene, progress: Progress | None = None) -> Gas:
    """Return the gas of a scene, at its start.

    ``progress`` is called while a dense random start grows, as by :func:`carom.gas.dense`. Raises CaromError for initial positions
    that overlap, or that a file does not have.
    """
    run, container = scene.run, scene.container.geometry
    options: dict[str, Any] = {}
    if run.start == "random":
        radii = np.concatenate([one.all_radii for one in scene.species])
        # (velocities are drawn from the seed itself)
        seed = int(np.random.SeedSequence([run.seed, 1]).generate_state(1)[0])
        with _faults_of(scene):
            options["position"] = dense(radii, container, seed=seed, progress=progress)
    elif run.start != "lattice":
        options = _from_file(scene)
    with _faults_of(scene):
        return Gas.of_scene(scene, **options)


def _from_file(scene: GasScene) -> dict[str, Any]:
    """Return the content of the start's file, as options of Gas."""
    axes, path = scene.container.dimensions, Path(scene.run.start)
    try:
        start = read_initial_state(path, axes, scene.container.geometry.size, scene.count)
    except CaromError as error:
        raise CaromError(
            *(f"{scene.where}: {one}" if one.startswith("run.start: ") else one for one in error.faults)
        ) from None
    order = _order_by_species(scene, start, path)
    found: dict[str, Any] = {"position": start.position[order]}
    for name, values in (("velocity", start.velocity), ("spin", start.spin)):
        if values is not None:
            found[name] = values[order]
    if (
        path.suffix.lower() == ".gsd"
    ):  # single precision: balls that have just collided overlap; the first event separates them
        found["touch"] = SINGLE_PRECISION
    return found


def _order_by_species(scene: GasScene, start: InitialState, path: Path) -> Any:
    """Return the order of a file's rows by species, as the scene has them."""
    names = [one.name for one in scene.species]
    if start.species is None:
        if len(start.position) != scene.count:
            got = f"{len(start.position)} in {path.name}"
            raise CaromError(
                f"{scene.where}: run.start: expected {scene.count} balls, the sum over the species, got {got}"
            )
        return slice(None)
    for name in start.species:
        if name not in names:
            raise CaromError(Fault(f"{path}", "species", ", ".join(names), repr(name), suggestion(name, names)))
    for one in scene.species:
        if (count := start.species.count(one.name)) != one.count:
            raise CaromError(
                f"{scene.where}: run.start: expected {one.count} balls of species {one.name!r}, got {count} in {path.name}"
            )
    return np.argsort([names.index(name) for name in start.species], kind="stable")


@contextmanager
def _faults_of(scene: GasScene) -> Iterator[None]:
    """Raise the faults of a gas as faults of its scene."""
    try:
        yield
    except CaromError as error:
        raise CaromError(*(_in_scene(scene, fault) for fault in error.faults)) from None


def _in_scene(scene: GasScene, fault: str) -> str:
    """Return a fault of the gas as one of the scene."""
    said = fault.removeprefix("Gas: ")
    for part in ("position: ", "dense: ", "lattice: "):
        if said.startswith(part):
            file = f", in {Path(scene.run.start).name}" if Path(scene.run.start).suffix else ""
            return f"{scene.where}: run.start: {said.removeprefix(part)}{file}"
    return f"{scene.where}: {said}"


def load_gas(path: str | Path) -> GasScene:
    """Read the scene of a gas from a TOML file.

    Parameters
    ----------
    path : str or Path
        The file, in whose folder a start from a file is looked for; or the text of such a file, with its line breaks.

    Returns
    -------
    GasScene. Raises CaromError, one line per problem: where, what was expected, what was found, what to do.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> from carom.gas import gas_text, load_gas
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = Path(folder) / "gas.toml"
    ...     _ = path.write_text(gas_text(), encoding="utf-8")
    ...     scene = load_gas(path)
    >>> scene.count, scene.container.shape
    (1000, 'periodic')
    """
    if isinstance(path, str) and "\n" in path:
        name, folder, table = "gas", Path(), parse_toml("gas", path)
    else:
        path = as_path("load_gas", path)
        name, folder = str(path), path.parent
        table = read_toml(path, f"carom scene new `gas` {path} writes one", "the scene file of a gas")
    if strange := sorted({"balls", "walls", "floor"} & set(table)):
        got = " and ".join(strange)
        raise CaromError(f"{name}: expected a gas, got a scene of single balls, with {got}; run carom simulate {name}")
    run = table.get("run")
    if isinstance(run, dict) and isinstance(start := run.get("start"), str) and Path(start).suffix:
        run["start"] = str(folder / start)
    scene = from_file(name, GasScene, table)
    object.__setattr__(scene, "where", name)
    return scene


def is_gas(path: str | Path) -> bool:
    """Return whether a file looks like the scene of a gas: TOML with a container or species."""
    try:
        table = read_toml(Path(path), "")
    except CaromError:
        return False
    return bool({"container", "species"} & set(table))


def new_gas() -> GasScene:
    """Return a gas that can be run as it is: rough spheres in a periodic box.

    Returns
    -------
    GasScene
        :func:`gas_text` returns the commented text of its file.

    Examples
    --------
    >>> from carom.gas import new_gas
    >>> new_gas().count
    1000
    """
    return load_gas(gas_text())


def gas_text(scene: GasScene | None = None) -> str:
    """Return the text of the scene file of a gas.

    Parameters
    ----------
    scene : GasScene, optional
        Default: a commented first gas, :func:`new_gas`.

    Returns
    -------
    str
        TOML, from which :func:`load_gas` makes a scene.

    Examples
    --------
    >>> from carom.gas import gas_text, load_gas, new_gas
    >>> print(gas_text().splitlines()[0])
    # A gas for carom: `carom gas FILE` runs it, `carom scene check FILE` validates it.
    >>> load_gas(gas_text(new_gas())) == new_gas()
    True
    """
    if scene is None:
        return files("carom.gas").joinpath("new.toml").read_text(encoding="utf-8")
    require_type("gas_text", "scene", scene, GasScene)
    return toml_text("gas_text", scene)
