"""Names of the release before: they answer as they did, with a DeprecationWarning that says the new name."""

from __future__ import annotations

import functools
import warnings
from collections.abc import Callable
from typing import Any, TypeVar

from carom.errors import CaromError

__all__ = [
    "GOES",
    "dropped_argument",
    "renamed_arguments",
    "renamed_attribute",
    "warn_of_rename",
    "with_new_names",
    "with_old_keys",
]

Function = TypeVar("Function", bound=Callable[..., Any])
GOES = (
    "the old name goes with the next release"  # (so ends the text of each warning, which the command shows as a note)
)


def renamed_attribute(old: str, new: str) -> property:
    """Return a property that answers with the attribute ``new``, and warns that ``old`` goes with the next release."""

    def read(self: Any) -> Any:
        warn_of_rename(f"{type(self).__name__}.{old}", new, 3)
        return getattr(self, new)

    return property(read, doc=f"Deprecated name of ``{new}``.")


def renamed_arguments(**names: str) -> Callable[[Function], Function]:
    """Return a decorator with which a function still takes keywords by their old names: ``renamed_arguments(old="new")``."""

    def decorate(function: Function) -> Function:
        @functools.wraps(function)
        def call(*args: Any, **given: Any) -> Any:
            return function(*args, **with_new_names(function.__name__, given, names))

        return call  # type: ignore[return-value]

    return decorate


def dropped_argument(name: str, why: str, position: int | None = None) -> Callable[[Function], Function]:
    """Return a decorator with which a function still takes an argument that it no longer has, with a warning that says why.

    ``position``: where the argument stood among those without a keyword; a text there is taken for it.
    """

    def decorate(function: Function) -> Function:
        @functools.wraps(function)
        def call(*args: Any, **given: Any) -> Any:
            old = position is not None and len(args) > position and isinstance(args[position], str)
            if old or name in given:
                called = function.__qualname__.removesuffix(".__init__")
                warnings.warn(f"{called}: {name} has no effect: {why}; {GOES}", DeprecationWarning, stacklevel=3)
                given.pop(name, None)
                args = args[:position] + args[(position or 0) + 1 :] if old else args
            return function(*args, **given)

        return call  # type: ignore[return-value]

    return decorate


def with_new_names(where: str, given: dict[str, Any], names: dict[str, str]) -> dict[str, Any]:
    """Return arguments by their new names, with a warning for each old one; CaromError where both are given."""
    if names.keys().isdisjoint(given):
        return given
    found = dict(given)
    for old, new in names.items():
        if old not in found:
            continue
        if new in found:
            raise CaromError(f"{where}: {old}: expected {new} alone, got both; {old} is its old name")
        warn_of_rename(f"{where}: {old}", new, 5)
        found[new] = found.pop(old)
    return found


def with_old_keys(found: dict[str, Any], names: dict[str, str]) -> dict[str, Any]:
    """Return data for a file with the keys of the release before, too; ``names``: old -> new."""
    return found | {old: found[new] for old, new in names.items() if new in found}


def warn_of_rename(old: str, new: str, level: int) -> None:
    """Warn that a name goes with the next release. ``level``: how many calls above the code stands that uses it."""
    warnings.warn(f"{old} is called {new} now; {GOES}", DeprecationWarning, stacklevel=level)
