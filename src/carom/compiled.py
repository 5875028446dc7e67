"""Kernels compiled: the only place where carom speaks to Numba.

``register_jitable`` makes a kernel callable from compiled code while it stays a plain function for Python. Compiled loops
are cached in the user's cache folder, under a hash of carom's sources: Numba looks only at the file of the function that
it caches, and would go on using a loop whose kernels, in other files, have changed.
"""

from __future__ import annotations

import functools
import hashlib
import os
import shutil
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from carom.kernel import HOT, KERNELS

__all__ = ["KERNEL_OPTIONS", "cache_folder", "cfunc", "njit", "source_hash"]

_registered: set[Callable[..., Any]] = set()

# Called from compiled code only: the wrappers for Python would take a sixth of the compiling. And no kernel of ours makes an
# array: counting who holds those that it is handed (_nrt, a private option of Numba's) takes time.
KERNEL_OPTIONS = {"error_model": "numpy", "no_cpython_wrapper": True, "no_cfunc_wrapper": True, "_nrt": False}


def source_hash() -> str:
    """Hash of all of carom's Python sources, and of the interpreter's version."""
    digest = hashlib.sha256(sys.version.encode())
    for path in sorted(Path(__file__).parent.rglob("*.py")):
        digest.update(path.read_bytes())
    return digest.hexdigest()[:16]


@functools.cache
def cache_folder() -> Path:
    """Where compiled loops are kept: CAROM_CACHE, else ``carom`` in the user's ordinary cache folder."""
    own = os.environ.get("CAROM_CACHE")
    base = Path(own) if own else Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "carom"
    here = base / source_hash()
    if not here.exists():
        # one generation is enough: what older sources left is never read again
        for old in base.glob("*/") if base.is_dir() else ():
            if len(old.name) == 16:
                shutil.rmtree(old, ignore_errors=True)
    return here


@contextmanager
def _numba_cache() -> Iterator[None]:
    """Point Numba's cache at ours while a function is decorated, and back: a user's own functions keep theirs."""
    import numba

    before = numba.config.CACHE_DIR
    numba.config.CACHE_DIR = str(cache_folder())
    try:
        yield
    finally:
        numba.config.CACHE_DIR = before


def register_kernels() -> None:
    """Make every kernel marked so far callable from compiled code."""
    from numba.extending import register_jitable

    from carom.linked import linked_only

    for function in KERNELS:
        if function not in _registered:
            # (a law of a user's own may do whatever Numba can)
            own = str(function.__module__).startswith("carom.")
            options = {**KERNEL_OPTIONS, **linked_only(cache_folder())} if own else {**KERNEL_OPTIONS, "_nrt": True}
            register_jitable(forceinline=function in HOT, **options)(function)
            _registered.add(function)


_told: list[Callable[[bool], None]] = []


@contextmanager
def telling(say: Callable[[bool], None]) -> Iterator[None]:
    """While inside, ``say`` is told (True) when something has begun to be compiled, and not only loaded, and when it is done."""
    _told.append(say)
    try:
        yield
    finally:
        _told.remove(say)


@functools.cache
def _listen() -> None:
    """Have Numba say when it compiles. (Its import is slow: this waits until there is something to compile or to load.)"""
    from numba.core import event

    class Compiling(event.Listener):  # type: ignore[misc]
        depth = 0

        def on_start(self, event: Any) -> None:
            self.depth += 1
            if self.depth == 1:
                self.say(True)

        def on_end(self, event: Any) -> None:
            self.depth -= 1
            if self.depth == 0:
                self.say(False)

        def say(self, begun: bool) -> None:
            for say in _told:
                say(begun)

    event.register("numba:compile", Compiling())


def njit(function: Callable[..., Any], signature: Any = None, **options: Any) -> Callable[..., Any]:
    """Compile a loop over kernels; fastmath stays off, so that it gives the same bits as Python.

    With a signature it is compiled, or loaded, at once and for nothing else.
    """
    import numba

    register_kernels()
    _listen()
    options = {"error_model": "numpy", "cache": True, **options}
    with _numba_cache():
        return numba.njit(signature, **options)(function)  # type: ignore[no-any-return]


def cfunc(function: Callable[..., Any], numbers: int, keep: bool = False) -> Any:
    """Compile a function of so many floats and of a place to write floats to, for calls by its address; ``keep`` it."""
    import numba
    from numba import types

    register_kernels()
    signature = types.void(*[types.float64] * numbers, types.CPointer(types.float64))
    with _numba_cache():
        return numba.cfunc(signature, error_model="numpy", cache=keep)(function)
