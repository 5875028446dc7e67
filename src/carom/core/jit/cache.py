"""The folder in which compiled code is cached, named after a hash of what carom's code does."""

from __future__ import annotations

import contextlib
import functools
import hashlib
import importlib.util
import json
import os
import sys
import time
from pathlib import Path
from types import CodeType

from carom.core.jit.generations import MARK_SECONDS, use_generation

__all__ = ["cache_base", "cache_folder", "source_hash"]

# Rooms that hold no compiled code: what changes there leaves compiled loops as they are.
PLAIN_ROOMS = {"cli", "data", "derive", "explorer", "plot", "public"}


@functools.cache
def source_hash() -> str:
    """Hash of the code of all modules that may hold kernels (no comments, no docstrings), and of Python's and Numba's versions."""
    return hash_of(Path(__file__).parents[2], cache_base())


def hash_of(root: Path, base: Path) -> str:
    """Return the hash of the modules below ``root``.

    Compiling a module to bytecode takes milliseconds: each one's hash is kept in the folder ``base``, under its time and size, in a
    file for this installation alone.
    """
    place = hashlib.sha256(f"{root} {sys.version}".encode()).hexdigest()[:16]
    store = base / f"sources-{place}.json"
    try:
        known = json.loads(store.read_text(encoding="utf-8"))
        aged = time.time() - store.stat().st_mtime > MARK_SECONDS
    except (OSError, ValueError):
        known, aged = {}, False
    digest, found = hashlib.sha256(sys.version.encode() + _numba_version()), {}
    for path in sorted(root.rglob("*.py")):
        name = path.relative_to(root)
        if name.parts[0] in PLAIN_ROOMS:
            continue
        about = path.stat()
        key = f"{name.as_posix()} {about.st_mtime_ns} {about.st_size}"
        found[key] = known.get(key) or _code_hash(path)
        digest.update(f"{name.as_posix()} {found[key]}".encode())
    with contextlib.suppress(OSError):
        if found != known:
            store.parent.mkdir(parents=True, exist_ok=True)
            part = store.with_name(f"{store.stem}.{os.getpid()}.json")
            part.write_text(json.dumps(found), encoding="utf-8")
            part.replace(store)
        elif aged:  # (what is not used for long is removed)
            store.touch()
    return digest.hexdigest()[:16]


def _numba_version() -> bytes:
    """Contents of the file that says Numba's version: Numba itself takes half a second to import."""
    try:
        spec = importlib.util.find_spec("numba")
        return (Path(spec.origin or "").parent / "_version.py").read_bytes() if spec is not None else b""
    except (OSError, ImportError, ValueError):
        return b""


def _code_hash(path: Path) -> str:
    """Hash of what a module does: its bytecode and constants, no docstrings, no line numbers."""
    digest = hashlib.sha256()

    def feed(code: CodeType) -> None:
        names = (code.co_name, code.co_names, code.co_varnames, code.co_freevars, code.co_argcount, code.co_flags)
        digest.update(code.co_code + repr(names).encode())
        for constant in code.co_consts:
            if isinstance(constant, CodeType):
                feed(constant)
            else:  # (a set has no order of its own)
                digest.update(
                    repr(sorted(map(repr, constant)) if isinstance(constant, frozenset) else constant).encode()
                )

    feed(compile(path.read_bytes(), path.name, "exec", dont_inherit=True, optimize=2))
    return digest.hexdigest()[:16]


def cache_base() -> Path:
    """Return CAROM_CACHE, else ``carom`` in the user's ordinary cache folder."""
    own = os.environ.get("CAROM_CACHE")
    return Path(own) if own else Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "carom"


@functools.cache
def cache_folder() -> Path:
    """Return where the compiled loops of this version of carom are kept: a folder in :func:`cache_base`, in use from now on."""
    here = cache_base() / source_hash()
    use_generation(here)
    return here
