"""Real tables by name: sizes, cushions, pockets, balls, cloth, each number with its source (``tables.toml``)."""

from __future__ import annotations

import functools
import importlib
import pkgutil
import re
import tomllib
from collections.abc import Iterable
from dataclasses import dataclass, field
from importlib.resources import files
from pathlib import Path
from types import ModuleType
from typing import Any

from carom.errors import CaromError, Fault, did_you_mean, shortened_list, shown
from carom.files import read_regular

PARTS = ("ball", "floor", "ball_contact", "corner_pockets", "side_pockets")
POCKETS = ("corner_pockets", "side_pockets")


@dataclass(frozen=True)
class Sourced:
    """A value, where it comes from, and the short name of that source."""

    value: Any
    source: str
    key: str


@dataclass(frozen=True)
class Preset:
    """A table by name: numbers of its cushions, and by part of pockets, balls and floor."""

    name: str
    title: str
    cushions: dict[str, Sourced]
    parts: dict[str, dict[str, Sourced]] = field(default_factory=dict)


@functools.cache
def presets() -> dict[str, Preset]:
    """Return all tables by name."""
    tables = tomllib.loads(files("carom.scene").joinpath("tables.toml").read_text(encoding="utf-8"))
    sources = tables.pop("sources")

    def numbers(found: dict[str, Any]) -> dict[str, Sourced]:
        return {name: Sourced(value, sources[key], key) for name, (value, key) in found.items()}

    made: dict[str, Preset] = {}
    for name, own in tables.items():
        parent = made[own.pop("like")] if "like" in own else Preset(name, "", {})
        title, own_parts = own.pop("title"), {part: numbers(own.pop(part)) for part in PARTS if part in own}
        made[name] = Preset(name, title, {**parent.cushions, **numbers(own)}, {**parent.parts, **own_parts})
    return made


def preset_fault(name: Any) -> list[Fault]:
    """Return the problem with a name that no table has, with the nearest one; nothing for a known one."""
    if isinstance(name, str) and name in presets():
        return []
    advice = did_you_mean(name, presets()) if isinstance(name, str) else ""
    return [Fault("", "preset", f"one of {', '.join(presets())}", shown(name), advice)]


def wall_fields(preset: Preset) -> dict[str, Any]:
    """Return the fields of a ``table`` that a preset fills, as a scene file has them."""
    pockets = {
        part: {name: one.value for name, one in preset.parts[part].items()} for part in POCKETS if part in preset.parts
    }
    return {**{name: one.value for name, one in preset.cushions.items()}, **pockets}


# ----------------------------------------------------------------------------------------------------
# Read TOML: tables of files and texts, with one line for a fault.


DEEP_NAME = re.compile(
    r"(?<![\w-])(?:[\w-]++[ \t]*+\.[ \t]*+){100}"
)  # "a.a.a...", whose time grows as the square of its length


def read_toml(path: Path, remedy: str, what: str = "a scene file") -> dict[str, Any]:
    """Return the table in a TOML file. CaromError, one line, if it has none; ``remedy`` helps where there is no file."""
    if path.is_dir():
        raise CaromError(Fault(f"{path}", "", what, "a folder", _scenes_in(path)))
    try:
        text = read_regular(path, what, advice=remedy).decode("utf-8-sig")  # with or without a byte-order mark
    except UnicodeDecodeError as error:
        raise CaromError(Fault(f"{path}", "", "text in UTF-8", f"byte {error.object[error.start]:#04x}")) from None
    return parse_toml(str(path), text)


def _scenes_in(folder: Path) -> str:
    """Return advice where a folder is given in the place of a file: the files that may be meant."""
    names = sorted(str(file) for file in folder.glob("*.toml"))
    return (
        f"name a file in it: {shortened_list(names, 4)}" if names else "name a file; it has none that ends with .toml"
    )


def parse_toml(name: str, text: str) -> dict[str, Any]:
    """Return the table in a text. CaromError, one line that begins with ``name``, where it is not TOML."""
    deep = CaromError(f"{name}: expected TOML, got brackets or names nested too deep to read")
    if DEEP_NAME.search(text):
        raise deep
    try:
        return tomllib.loads(text)
    except RecursionError:
        raise deep from None
    except tomllib.TOMLDecodeError as error:
        raise CaromError(_syntax(name, text, str(error))) from None


def _syntax(path: str, text: str, message: str) -> str:
    found = re.fullmatch(r"(.*) \(at (?:line (\d+), column (\d+)|end of document)\)", message, re.DOTALL)
    if found is None:
        return f"{path}: expected TOML, got: {message}"
    lines = text.splitlines() or [""]
    number = int(found[2]) if found[2] else len(lines)
    return f"{path}: line {number}: expected TOML, got {lines[number - 1].strip()[:60]!r}; {found[1]}"


# ----------------------------------------------------------------------------------------------------
# The modules of a package by their files: each shape of a wall, and each figure, is found by its file.


def modules_of(package: str, folders: Iterable[str]) -> list[ModuleType]:
    """Return all modules in the files of a package, in the order of their names; they are imported."""
    names = sorted(one.name for one in pkgutil.iter_modules(folders))
    return [importlib.import_module(f"{package}.{name}") for name in names]
