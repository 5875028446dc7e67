"""Public names of a package, from its stub: each is imported, and guarded, when it is first used."""

from __future__ import annotations

import sys
from collections.abc import Callable
from typing import Any

import lazy_loader

from carom.errors import near_name

__all__ = ["attach_public"]


def attach_public(package: str, file: str) -> tuple[Callable[[str], Any], Callable[[], list[str]], list[str]]:
    """Return ``__getattr__``, ``__dir__`` and ``__all__`` of a package whose names stand in the stub beside ``file``.

    Functions and classes are guarded (:func:`carom.public.guard.guarded`). That is here, and not at each function, so that carom's
    own rooms, which import from modules, call the bare functions.
    """
    load, list_names, names = lazy_loader.attach_stub(package, file)

    def load_guarded(name: str) -> Any:
        try:
            found = load(name)
        except AttributeError as error:
            if package == "carom" and (law := next((one for one in load("LAWS") if one.replace("-", "_") == name), "")):
                called = f"carom.LAWS[{law!r}](ball, state, wall)"
                raise AttributeError(f"carom has no function {name}; the law itself is called: {called}") from error
            if package == "carom.billiards" and name in sys.modules["carom"].scene.FIGURES:
                called = f"carom.billiards.table({name!r}, ...)"
                raise AttributeError(f"{package} has no function {name}; the table is {called}") from error
            if not name.startswith("_") and (
                near := near_name(name, [one for one in names if one.islower() or not name.islower()])
            ):
                raise AttributeError(f"{package} has no {name}; did you mean {near}?") from error
            raise
        if getattr(found, "__module__", "").startswith("carom."):  # (not a module, nor a table of numbers)
            from carom.public.guard import guarded

            found = guarded(found)
            vars(sys.modules[package])[name] = found
        return found

    return load_guarded, list_names, names
