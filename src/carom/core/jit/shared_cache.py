"""The cache of compiled loops, shared by installations of the same code and by processes that run at the same time.

Numba keeps compiled code under the path and the time of the source file, so that each clone and each virtual environment
compiles everything again, and processes that start together all compile the same loop. Here compiled code is found by the name
of its module (the cache folder's own name is a hash of what carom's code does), and a loop is compiled by one process at a time:
the others wait, and load it.
"""

from __future__ import annotations

import contextlib
import pickle
from collections.abc import Callable
from pathlib import Path
from typing import Any

from carom.core.jit.cache import cache_folder
from carom.core.jit.file_locks import locked

__all__ = ["LOCATOR", "Locator", "compile_in_one_process", "go_on_without_disk"]

LOCATOR = f"{__name__}.Locator"


class Locator:
    """Where Numba keeps the compiled code of carom's functions (see ``NUMBA_CACHE_LOCATOR_CLASSES`` in Numba's manual)."""

    def __init__(self, module: str, source_file: str = "") -> None:
        self._module = module
        self._py_file = (
            source_file  # (which Numba names where it warns that a function cannot be cached, as with NUMBA_OPT=0)
        )

    @classmethod
    def from_function(cls, function: Callable[..., Any], source_file: str) -> Any:
        """Return a locator for a function of carom's; for any other, Numba's own in the same folder."""
        if function.__module__.startswith("carom."):
            return cls(function.__module__, source_file)
        from numba.core.caching import UserProvidedCacheLocator

        return UserProvidedCacheLocator.from_function(function, source_file)

    def get_cache_path(self) -> str:
        """Return the folder, one for each package."""
        parents, _, package = self._module.rpartition(".")[0].rpartition(".")
        return str(cache_folder() / f"{package}_{parents}")

    def ensure_cache_path(self) -> None:
        """Make the folder."""
        Path(self.get_cache_path()).mkdir(parents=True, exist_ok=True)

    def get_source_stamp(self) -> str:
        """Return a constant: the folder's name already tells the code."""
        return ""

    def get_disambiguator(self) -> str:
        """Return the module's name, part of the file's name."""
        return self._module


def compile_in_one_process(dispatcher: Any, folder: Path) -> None:
    """Have a dispatcher of Numba's, with a cache, wait while another process compiles the same function.

    The lock is a file beside the compiled code; it ends with the process that holds it. Without such locks (on Windows, on some
    network drives) every process compiles for itself.
    """
    function = dispatcher.py_func
    path = folder / "locks" / f"{function.__module__}.{function.__qualname__}".replace("<", "").replace(">", "")
    go_on_without_disk(dispatcher)
    load, compile_now = dispatcher._cache.load_overload, dispatcher.compile
    held = contextlib.ExitStack()

    def load_or_wait(signature: Any, context: Any) -> Any:
        found = load(signature, context)
        if found is None:
            held.enter_context(locked(path))
            found = load(signature, context)
        return found

    def compile_alone(signature: Any) -> Any:
        try:
            return compile_now(signature)
        finally:
            held.close()

    dispatcher._cache.load_overload = load_or_wait
    dispatcher.compile = compile_alone


def go_on_without_disk(dispatcher: Any) -> None:
    """Have a dispatcher compile anew where the cache cannot be read, and keep nothing where it cannot be written.

    On a full disk, say, or a cache folder that is none. What was half written is never read: Numba renames whole files.
    """
    load, save = dispatcher._cache.load_overload, dispatcher._cache.save_overload

    def load_if_possible(signature: Any, context: Any) -> Any:
        try:
            return load(signature, context)
        except (OSError, EOFError, pickle.UnpicklingError):
            return None

    def save_if_possible(signature: Any, compiled: Any) -> None:
        with contextlib.suppress(OSError):
            save(signature, compiled)

    dispatcher._cache.load_overload, dispatcher._cache.save_overload = load_if_possible, save_if_possible
