"""Gases in TOML files: read one, all faults at once; a gas to begin with."""

from __future__ import annotations

from importlib.resources import files
from pathlib import Path

from pydantic import ValidationError

from carom.errors import CaromError
from carom.files import path_of
from carom.gas.model import GasScene
from carom.scene.faults import told
from carom.scene.toml import read_toml

__all__ = ["is_gas", "load_gas", "new_gas"]


def load_gas(path: str | Path) -> GasScene:
    """The gas of a TOML file; a start from a file is looked for beside it.

    Raises CaromError with one line a fault, all at once: where, what was expected, what came, what to do.
    """
    path = path_of("load_gas", path)
    table = read_toml(path, f"carom scene new --gas {path}")
    if strange := sorted({"balls", "walls", "floor"} & set(table)):
        got = " and ".join(strange)
        raise CaromError(f"{path}: expected a gas, got a scene of single balls, with {got}; carom simulate {path}")
    run = table.get("run")
    if isinstance(run, dict) and isinstance(start := run.get("start"), str) and Path(start).suffix:
        run["start"] = str(path.parent / start)
    try:
        return GasScene.model_validate(table)
    except ValidationError as error:
        raise CaromError(*told(str(path), error, GasScene)) from None


def is_gas(path: str | Path) -> bool:
    """Whether a file looks like that of a gas: TOML with a container or species."""
    try:
        table = read_toml(Path(path), "")
    except CaromError:
        return False
    return bool({"container", "species"} & set(table))


def new_gas() -> str:
    """The text of a commented gas that runs as it stands: rough spheres in a periodic box."""
    return files("carom.gas").joinpath("new.toml").read_text(encoding="utf-8")
