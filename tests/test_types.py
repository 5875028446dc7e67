"""Every public attribute, result and figure has a type; those that have none are listed, each with its reason."""

from __future__ import annotations

import functools
import inspect
from collections.abc import Callable, Iterator
from typing import Any

from reference.public_names import public_classes, public_functions

UNTYPED: dict[str, str] = {}


def _function(member: object) -> Callable[..., Any] | None:
    if isinstance(member, property):
        return member.fget
    if isinstance(member, functools.cached_property):
        return member.func
    found = getattr(member, "__func__", member)
    return found if inspect.isfunction(found) else None


def _annotations() -> Iterator[tuple[str, Any]]:
    """Yield each field, property, method and function with the type of its value."""
    for cls in public_classes():
        for base in cls.__mro__:
            if not base.__module__.startswith("carom"):
                continue
            for name, member in vars(base).items():
                if not name.startswith("_") and (function := _function(member)) is not None:
                    yield f"{base.__name__}.{name}", inspect.unwrap(function).__annotations__.get("return")
            for name, kind in inspect.get_annotations(base).items():
                if not name.startswith("_"):
                    yield f"{base.__name__}.{name}", kind
    for name, function in public_functions():
        yield name, inspect.unwrap(function).__annotations__.get("return")


def test_what_has_no_type_is_listed_with_its_reason() -> None:
    found = dict(_annotations())
    assert len(found) > 1000
    untyped = {name for name, kind in found.items() if kind in ("Any", Any, None)}
    assert untyped == set(UNTYPED)
