"""Generations of compiled code in one cache folder: one for each version of carom's code, of Python and of Numba.

Several versions are used in turn (another clone, another virtual environment, a branch), and compiling takes minutes: what was used
in the last 30 days is kept, up to 2 GB. A generation that a process uses is never removed: each process holds a shared lock of it,
which ends with the process. Without such locks (on Windows, on some network drives) a generation that was used in the last two
days counts as in use.
"""

from __future__ import annotations

import contextlib
import os
import re
import shutil
import time
from pathlib import Path
from typing import NamedTuple

from carom.core.jit.file_locks import locked, try_lock

__all__ = ["Generation", "generations", "use_generation"]

KEPT_SECONDS = 30 * 86_400.0
KEPT_BYTES = 2_000_000_000
MARK_SECONDS = 86_400.0  # a use is marked at most once a day, and that often is looked for what is no longer used
NAME = re.compile(r"[0-9a-f]{16}")  # of a generation's folder: no other folder is touched
SET_ASIDE = re.compile(r"removed-\d+-[0-9a-f]{16}")
MARK = (
    "used"  # the file in a generation whose time is the time of its last use; each process that uses it holds its lock
)
LOCK = "lock"  # held for a moment, while a process begins to use a generation or sets one aside
SOURCES = "sources*.json"  # hashes of modules, one file for each place from which carom was run


class Generation(NamedTuple):
    """One generation of compiled code."""

    folder: Path
    used: float
    """s since 1970: the last time that a process began to use it, to a day."""
    size: int
    """Bytes."""


def generations(base: Path) -> list[Generation]:
    """Return all generations in a cache folder, the one that was used last first; none where it cannot be read."""
    found = []
    with contextlib.suppress(OSError):
        for folder in base.iterdir():
            if NAME.fullmatch(folder.name) and folder.is_dir():
                with contextlib.suppress(OSError):  # (another process removes it at this moment)
                    found.append(Generation(folder, _last_use(folder), _size(folder)))
    return sorted(found, key=lambda one: -one.used)


def use_generation(folder: Path) -> None:
    """Begin to use a generation: hold its lock, mark the day, and then, or if it is new, remove what is no longer used."""
    base, mark, due = folder.parent, folder / MARK, False
    with contextlib.suppress(OSError), locked(base / LOCK):
        folder.mkdir(parents=True, exist_ok=True)
        # (never closed: the lock lasts as long as the process)
        file = os.open(mark, os.O_RDWR | os.O_CREAT, 0o666)
        try_lock(file, shared=True)
        about = os.fstat(file)
        if due := about.st_size == 0 or time.time() - about.st_mtime > MARK_SECONDS:
            mark.write_text(
                "the time of this file is the time of the last use of this compiled code\n", encoding="utf-8"
            )
    if due:
        with contextlib.suppress(OSError):
            _remove_unused(base, folder)


def _remove_unused(base: Path, own: Path) -> None:
    """Remove generations that were not used for long, and those used least recently beyond the size that is kept."""
    now, found = time.time(), generations(base)
    size = sum(one.size for one in found)
    for one in reversed(found):
        if one.folder != own and (now - one.used > KEPT_SECONDS or size > KEPT_BYTES) and _set_aside(one, now):
            size -= one.size
    for path in base.iterdir():  # (what a process that was killed has left, too)
        if SET_ASIDE.fullmatch(path.name):
            shutil.rmtree(path, ignore_errors=True)
    for path in base.glob(SOURCES):
        with contextlib.suppress(OSError):
            if now - path.stat().st_mtime > KEPT_SECONDS:
                path.unlink()


def _set_aside(one: Generation, now: float) -> bool:
    """Give a generation another name, under which nobody looks for it, unless a process uses it; return whether that was done."""
    mark = one.folder / MARK
    with contextlib.suppress(OSError), locked(one.folder.parent / LOCK):
        free = None
        if mark.exists():
            with mark.open("a") as file:
                free = try_lock(file)
        if free is False or (free is None and now - one.used < 2 * MARK_SECONDS):
            return False
        one.folder.rename(one.folder.with_name(f"removed-{os.getpid()}-{one.folder.name}"))
        return True
    return False


def _last_use(folder: Path) -> float:
    """Return the time of the last use; of a generation without a mark, made by an older carom, the time of its newest folder."""
    mark = folder / MARK
    if mark.exists():
        return mark.stat().st_mtime
    return max(path.stat().st_mtime for path in (folder, *folder.iterdir()))


def _size(folder: Path) -> int:
    return sum(path.stat().st_size for path in folder.rglob("*") if path.is_file())
