"""Read scenes from TOML files, and write a first one."""

from __future__ import annotations

import re
import tomllib
from importlib.resources import files
from pathlib import Path
from typing import Any

from carom.errors import CaromError
from carom.files import as_path
from carom.scene.openings import table_scene
from carom.scene.scene import Scene
from carom.scene.schema import from_file

__all__ = ["load_scene", "new_scene", "read_toml"]


def load_scene(path: str | Path, *, allow_own_laws: bool = False) -> Scene:
    """Read a scene from a TOML file.

    Parameters
    ----------
    path : str or Path
        The file.
    allow_own_laws : bool, optional
        Whether a custom law in it, ``law = "file.py:name"``, is looked up in the file's folder and run. Default: it is refused, so
        that opening a file runs no code.

    Returns
    -------
    Scene

    Raises CaromError with one line for each problem: where, what was expected, what was found, how to fix it.

    Examples
    --------
    >>> import carom, pathlib, tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = pathlib.Path(folder) / "scene.toml"
    ...     _ = file.write_text(carom.new_scene(), encoding="utf-8")
    ...     scene = carom.load_scene(file)
    >>> len(scene.balls)
    1
    """
    path = as_path("load_scene", path)
    table = read_toml(path, f"carom scene new {path}")
    if strange := sorted({"container", "species"} & set(table)):
        raise CaromError(
            f"{path}: expected a scene of single balls, got a gas, with {' and '.join(strange)}; carom gas {path}"
        )
    _beside(table, path.parent)
    return from_file(str(path), Scene, table, allow_own_laws=allow_own_laws)


def read_toml(path: Path, remedy: str) -> dict[str, Any]:
    """Return the table in a TOML file. CaromError, one line, if it has none; ``remedy`` is the command that writes one."""
    try:
        text = path.read_bytes().decode("utf-8-sig")  # with or without a byte-order mark
    except OSError as error:
        advice = f"; {remedy} writes one" if isinstance(error, FileNotFoundError) else ""
        raise CaromError(f"{path}: expected a scene file, got: {error.strerror}{advice}") from None
    except UnicodeDecodeError as error:
        raise CaromError(f"{path}: expected text in UTF-8, got byte {error.object[error.start]:#04x}") from None
    try:
        return tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise CaromError(_syntax(path, text, str(error))) from None


def _syntax(path: Path, text: str, message: str) -> str:
    found = re.fullmatch(r"(.*) \(at (?:line (\d+), column (\d+)|end of document)\)", message, re.DOTALL)
    if found is None:
        return f"{path}: expected TOML, got: {message}"
    lines = text.splitlines() or [""]
    number = int(found[2]) if found[2] else len(lines)
    return f"{path}: line {number}: expected TOML, got {lines[number - 1].strip()[:60]!r}; {found[1]}"


def _beside(table: dict[str, Any], folder: Path) -> None:
    """Make the paths of custom laws relative to the scene's folder."""
    walls = table.get("walls")
    for part in [table.get("run"), *(walls if isinstance(walls, list) else [])]:
        law = part.get("law") if isinstance(part, dict) else None
        if isinstance(part, dict) and isinstance(law, str) and ".py:" in law:
            part["law"] = str(folder / law)


def new_scene(table: str | None = None) -> str:
    """Return the text of a commented scene file that can be run unchanged: one ball on a carom table.

    Parameters
    ----------
    table : str, optional
        A real table by name, such as "snooker" (:class:`carom.Table`): its balls as they lie when a game begins, its cushions and
        cloth, each number with its source.

    Returns
    -------
    str
        TOML.

    Raises CaromError, one line, for a name that no table has.

    Examples
    --------
    >>> import carom
    >>> carom.new_scene().splitlines()[0].startswith("#")
    True
    >>> print(carom.new_scene("pool-9ft").splitlines()[0])
    # A pool table of 9 feet. The break: white meets the rack from the head string.
    """
    if table is not None:
        return table_scene(table)
    return files("carom.scene").joinpath("new.toml").read_text(encoding="utf-8")
