"""The folder in which compiled code is cached: one for each state of carom's code, removed a month after its last use."""

from __future__ import annotations

import contextlib
import functools
import hashlib
import importlib.util
import os
import re
import shutil
import sys
import time
from pathlib import Path

KEPT_SECONDS = 30 * 86_400.0
MARK_SECONDS = 86_400.0  # a use is marked at most once a day, and that often is looked for what is no longer used
NAME = re.compile(r"[0-9a-f]{16}")  # of a version's folder: no other folder is touched
SOURCES = "sources-*.json"  # hashes of loops, one file for each state of the sources
# Rooms that hold no compiled code: what changes there leaves compiled loops as they are.
PLAIN_ROOMS = {"cli", "data", "derive", "explorer", "plot", "public"}


def cache_base() -> Path:
    """Return CAROM_CACHE, else ``carom`` in the user's ordinary cache folder."""
    own = os.environ.get("CAROM_CACHE")
    return Path(own) if own else Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "carom"


@functools.cache
def cache_folder() -> Path:
    """Return where the compiled loops of this version of carom are kept: a folder in :func:`cache_base`, in use from now on."""
    here = cache_base() / source_hash()
    use_folder(here)
    return here


def use_folder(folder: Path) -> None:
    """Begin to use a version's folder; once a day mark its use, and remove those that were not used for a month.

    (A process has its machine code in memory: one that outlives its folder goes on.)
    """
    now = time.time()
    with contextlib.suppress(OSError):
        if folder.exists() and now - folder.stat().st_mtime < MARK_SECONDS:
            return
        folder.mkdir(parents=True, exist_ok=True)
        os.utime(folder)
        for path in (*version_folders(folder.parent), *folder.parent.glob(SOURCES)):
            with contextlib.suppress(OSError):  # (another process removes it at this moment)
                if now - path.stat().st_mtime > KEPT_SECONDS:
                    shutil.rmtree(path) if path.is_dir() else path.unlink()


def version_folders(base: Path) -> list[Path]:
    """Return the folders of all versions in a cache folder; none where it cannot be read."""
    with contextlib.suppress(OSError):
        return [path for path in base.iterdir() if NAME.fullmatch(path.name) and path.is_dir()]
    return []


@functools.cache
def source_hash() -> str:
    """Hash of the code of all modules that may hold kernels, and of Python's and Numba's versions."""
    root = Path(__file__).parents[2]
    return hashlib.sha256(f"{hash_of_files(root)} {sys.version}".encode() + _numba_version()).hexdigest()[:16]


def hash_of_files(root: Path) -> str:
    """Return the hash of the modules that may hold kernels, as they lie on the disk: quick, and another for any edit."""
    digest = hashlib.sha256()
    for path in sorted(root.rglob("*.py")):
        name = path.relative_to(root)
        if name.parts[0] not in PLAIN_ROOMS:
            digest.update(name.as_posix().encode() + b"\0" + path.read_bytes())
    return digest.hexdigest()[:16]


def _numba_version() -> bytes:
    """Contents of the file that says Numba's version: Numba itself takes half a second to import."""
    try:
        spec = importlib.util.find_spec("numba")
        return (Path(spec.origin or "").parent / "_version.py").read_bytes() if spec is not None else b""
    except (OSError, ImportError, ValueError):
        return b""
