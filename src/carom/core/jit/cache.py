"""The folder in which compiled code is cached, named after a hash of what carom's code does."""

from __future__ import annotations

import contextlib
import functools
import hashlib
import json
import os
import shutil
import sys
from pathlib import Path
from types import CodeType

__all__ = ["cache_folder", "source_hash"]

# Rooms that hold no compiled code: what changes there leaves compiled loops as they are.
PLAIN_ROOMS = {"cli", "data", "derive", "explorer", "plot", "public"}


@functools.cache
def source_hash() -> str:
    """Hash of the code of all modules that may hold kernels, without comments and docstrings, and of the interpreter's version.

    Compiling a module to bytecode takes milliseconds: each one's hash is kept beside the cache, under its time and size.
    """
    root = Path(__file__).parents[2]
    store = _cache_base() / "sources.json"
    try:
        known = json.loads(store.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        known = {}
    digest, changed = hashlib.sha256(sys.version.encode()), False
    for path in sorted(root.rglob("*.py")):
        name = path.relative_to(root)
        if name.parts[0] in PLAIN_ROOMS:
            continue
        about = path.stat()
        key = f"{path} {about.st_mtime_ns} {about.st_size}"
        if key not in known:
            known = {k: v for k, v in known.items() if not k.startswith(f"{path} ")}
            known[key], changed = _code_hash(path), True
        digest.update(f"{name.as_posix()} {known[key]}".encode())
    if changed:
        with contextlib.suppress(OSError):
            store.parent.mkdir(parents=True, exist_ok=True)
            part = store.with_name(f"sources.{os.getpid()}.json")
            part.write_text(json.dumps(known), encoding="utf-8")
            part.replace(store)
    return digest.hexdigest()[:16]


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


def _cache_base() -> Path:
    """CAROM_CACHE, else ``carom`` in the user's ordinary cache folder."""
    own = os.environ.get("CAROM_CACHE")
    return Path(own) if own else Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "carom"


@functools.cache
def cache_folder() -> Path:
    """Where compiled loops are kept: CAROM_CACHE, else ``carom`` in the user's ordinary cache folder."""
    base = _cache_base()
    here = base / source_hash()
    if not here.exists():
        # one generation is enough: what older sources left is never read again
        for old in base.glob("*/") if base.is_dir() else ():
            if len(old.name) == 16:
                shutil.rmtree(old, ignore_errors=True)
    return here
