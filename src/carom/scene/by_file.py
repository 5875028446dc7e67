"""Models that are found by their files: shapes of walls, figures."""

from __future__ import annotations

import importlib
import pkgutil
from collections.abc import Callable, Iterable
from typing import Any, TypeVar

from carom.scene.schema import Model

__all__ = ["models_by_shape"]

Found = TypeVar("Found", bound=Model)


def models_by_shape(package: str, folders: Iterable[str], base: Callable[..., Found]) -> dict[str, type[Found]]:
    """Return the classes of a base in the files of a package that have a ``shape``, by its name, in the order of the files."""
    names = sorted(one.name for one in pkgutil.iter_modules(folders))
    modules = [importlib.import_module(f"{package}.{name}") for name in names]
    classes: list[Any] = [x for module in modules for x in vars(module).values() if isinstance(x, type)]
    found = [one for one in classes if base in one.__mro__ and "shape" in one.model_fields]
    return {str(one.model_fields["shape"].default): one for one in dict.fromkeys(found)}
