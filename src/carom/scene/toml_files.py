"""Read TOML: tables of files and texts, with one line for a fault."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path
from typing import Any

from carom.errors import CaromError, Fault, shortened_list
from carom.files import read_regular

__all__ = ["parse_toml", "read_toml"]

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
