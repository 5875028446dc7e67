"""What lies outside: files that are whole or not there, libraries that the base install does not have."""

from __future__ import annotations

import importlib
import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from carom.errors import CaromError

__all__ = ["library", "path_of", "require_place", "try_place", "whole"]


def library(name: str, extra: str, what: str) -> Any:
    """A library that the base install does not have."""
    try:
        return importlib.import_module(name)
    except ImportError:
        raise CaromError(
            f"{what}: needs {name}, which is not installed; run: pip install {name} (or install carom's extra {extra!r})"
        ) from None


def path_of(where: str, value: Any) -> Path:
    """The Path of a file's name; CaromError, naming the function that was asked, where it is none."""
    if not isinstance(value, str | os.PathLike):
        got = f"{type(value).__name__} {value!r:.60}"
        raise CaromError(f"{where}: path: expected a file's name, as str or Path, got {got}; give the file's name")
    if "\0" in os.fsdecode(value):
        raise CaromError(f"{where}: path: expected a file's name, got {value!r:.60}, with a zero byte; leave that out")
    return Path(os.fsdecode(value))


def require_place(path: Path, kinds: tuple[str, ...]) -> None:
    """CaromError where no file can be written: another ending, no such folder, no leave to write there."""
    folder = path.absolute().parent
    if path.suffix.lower() not in kinds:
        got = repr(path.suffix) if path.suffix else "none"
        raise CaromError(f"{path}: expected a name that ends with {' or '.join(kinds)}, got {got}")
    if not folder.is_dir():
        raise CaromError(f"{path}: expected a folder that exists, got {str(path.parent)!r}; make it first")
    if path.is_dir():
        raise CaromError(f"{path}: expected a file to write, got a folder; name a file in it")
    if not os.access(folder, os.W_OK):
        raise CaromError(f"{path}: expected leave to write there, got none; choose another place")
    try_place(path)


def try_place(path: Path) -> None:
    """CaromError where no file can be made beside ``path``: one is, and is taken away. Leave alone does not tell all."""
    try:
        with tempfile.NamedTemporaryFile(prefix=f".{path.name}-", dir=path.absolute().parent):
            pass
    except OSError as error:
        raise CaromError(f"{path}: expected a place to write to, got: {error.strerror or error}") from None


@contextmanager
def whole(path: Path) -> Iterator[Path]:
    """A place beside ``path`` to write to, with its name; what is there when the block ends without an error becomes it."""
    try:
        with tempfile.TemporaryDirectory(prefix=".carom-", dir=path.absolute().parent) as folder:
            part = Path(folder) / path.name
            yield part
            part.replace(path)
    except OSError as error:
        raise CaromError(f"{path}: expected a place to write to, got: {error.strerror or error}") from None
