"""Public classes and functions, as the stubs of the packages name them."""

from __future__ import annotations

import ast
import importlib
import inspect
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import carom

SOURCE = Path(carom.__file__).parent


def public_names() -> Iterator[tuple[str, Any]]:
    """Yield each public name of a package, with what it names."""
    for stub in sorted(SOURCE.rglob("__init__.pyi")):
        package = ".".join(("carom", *stub.parent.relative_to(SOURCE).parts))
        for node in ast.parse(stub.read_text(encoding="utf-8")).body:
            for alias in node.names if isinstance(node, ast.ImportFrom) and node.module is not None else ():
                yield f"{package}.{alias.name}", getattr(importlib.import_module(package), alias.name)


def public_classes() -> Iterator[type]:
    """Yield all public classes, but exceptions."""
    for _name, found in public_names():
        if inspect.isclass(found) and not issubclass(found, BaseException):
            yield found


def public_functions() -> Iterator[tuple[str, Callable[..., Any]]]:
    """Yield all public functions, with their names."""
    for name, found in public_names():
        if inspect.isfunction(found):
            yield name, found
