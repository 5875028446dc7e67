"""The modules of a package by their files: each shape of a wall, and each figure, is found by its file."""

from __future__ import annotations

import importlib
import pkgutil
from collections.abc import Iterable
from types import ModuleType


def modules_of(package: str, folders: Iterable[str]) -> list[ModuleType]:
    """Return all modules in the files of a package, in the order of their names; they are imported."""
    names = sorted(one.name for one in pkgutil.iter_modules(folders))
    return [importlib.import_module(f"{package}.{name}") for name in names]
