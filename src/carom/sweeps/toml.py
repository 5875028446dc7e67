"""Sweeps in files: what is swept, its parameters, what is kept."""

from __future__ import annotations

from collections.abc import Mapping
from importlib.resources import files
from pathlib import Path
from typing import Any

from carom.errors import CaromError, Fault, FaultList, did_you_mean, shown
from carom.files import as_path
from carom.gas.build import load_gas
from carom.gas.scene import GasScene
from carom.public.own_laws import with_own_laws
from carom.scene.presets import read_toml
from carom.scene.toml import load_scene
from carom.sweeps.axes import Axis, axis_from_data
from carom.sweeps.space import Space
from carom.sweeps.subjects import subject_from_data
from carom.sweeps.sweep import BLOCK_POINTS, Sweep, sweep_over

SUBJECTS = ("scene", "gas", "impact", "orbit")
FIELDS = ("keep", "repeats", "seed", "block", "parameters", *SUBJECTS)


def new_sweep() -> str:
    """Return the text of a commented sweep file that runs as it stands.

    Examples
    --------
    >>> from carom import sweeps
    >>> sweeps.new_sweep().splitlines()[0].startswith("# A sweep for carom")
    True
    """
    return files("carom.sweeps").joinpath("new.toml").read_text(encoding="utf-8")


def load_sweep(path: str | Path, store: Any = None, *, allow_own_laws: bool = False) -> Sweep:
    """Read a sweep from a TOML file; ``carom sweep new`` writes one.

    Parameters
    ----------
    path : str or Path
    store : str or Path, optional
        Where results go; default: memory.
    allow_own_laws : bool, optional
        Whether laws of one's own, "file.py:name", may be run. Default: they are refused.

    Returns
    -------
    Sweep. Raises CaromError, one line per problem.

    Examples
    --------
    >>> import pathlib, tempfile
    >>> from carom import sweeps
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = pathlib.Path(folder) / "sweep.toml"
    ...     _ = file.write_text(sweeps.new_sweep(), encoding="utf-8")
    ...     sweeps.load_sweep(file)
    <Sweep: 1,488 points of a scene, 1 block>
    """
    path = as_path("load_sweep", path)
    table = read_toml(path, f"carom sweep new {path} writes one", "a sweep file")
    if allow_own_laws:
        table = with_own_laws(table)
    if not set(FIELDS) & set(table) and (
        strange := sorted({"balls", "container", "floor", "species", "walls"} & set(table))
    ):
        scene = f"the scene itself, with {' and '.join(strange)}"
        raise CaromError(
            Fault(f"{path}", "", "a sweep of a scene", scene, f"in a sweep file it is named: scene = '{path.name}'")
        )
    found = FaultList(str(path))
    for name in table:
        if name not in FIELDS:
            found.add(name, f"one of {', '.join(FIELDS)}", repr(name), did_you_mean(name, FIELDS))
    given = [name for name in SUBJECTS if name in table]
    if len(given) != 1:
        expected, got = f"one of {', '.join(SUBJECTS)}, which is swept", " and ".join(given) or "none"
        found.add("", expected, got, "scene = 'scene.toml', or a table [scene]")
    subject = None
    if len(given) == 1:
        subject = found.attempt(_subject, path, given[0], table[given[0]], allow_own_laws)
    parameters: dict[str, Axis] = {}
    if not isinstance(table.get("parameters"), Mapping):
        found.add("parameters", "a table [parameters] of paths", shown(table.get("parameters"), 60))
    else:
        for name, data in table["parameters"].items():
            axis = found.attempt(axis_from_data, data, f"{path}: {name}")
            parameters |= {} if axis is None else {name: axis}
    made = None
    if subject is not None and parameters:  # (what is sound is looked at even where something is not)
        try:
            space = Space(subject, parameters, table.get("repeats", 1), table.get("seed", 0))
            made = sweep_over(space, table.get("keep", ()), store, table.get("block", BLOCK_POINTS))
        except CaromError as error:
            found += error.records_at(found.where)
    if found or made is None:
        raise CaromError(*found)
    return made


def _subject(path: Path, kind: str, given: Any, allow_own_laws: bool) -> Any:
    if isinstance(given, str) and kind in ("scene", "gas"):
        file = path.parent / given
        if kind == "scene":
            return load_scene(file, allow_own_laws=allow_own_laws)
        gas = load_gas(file)
        if not isinstance(gas, GasScene):
            raise CaromError(
                f"{file}: expected a gas of balls in a container, got another kind; sweep one of {GasScene.__name__}"
            )
        return gas
    if not isinstance(given, Mapping):
        raise CaromError(f"{path}: {kind}: expected a table [{kind}], got {given!r:.60}")
    return subject_from_data({kind: given}, f"{path}: {kind}", allow_own_laws=allow_own_laws)
