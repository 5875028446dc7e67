"""The folder in which compiled code is cached, named after a hash of what carom's code does."""

from __future__ import annotations

import contextlib
import functools
import hashlib
import importlib.util
import json
import os
import pickle
import re
import shutil
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from types import CodeType
from typing import IO, Any, NamedTuple

LONGEST_WAIT = 300.0  # s; longer than any loop takes to compile, after which a process compiles it itself
POLL_INTERVAL = 0.05  # s


def try_lock(file: IO[str] | int, shared: bool = False) -> bool | None:
    """Lock an open file (or its descriptor) until it is closed, without waiting.

    False where another process has it, None where there are no locks.
    """
    try:
        import fcntl

        fcntl.flock(file, (fcntl.LOCK_SH if shared else fcntl.LOCK_EX) | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    except (ImportError, OSError):
        return None
    return True


@contextmanager
def locked(path: Path) -> Iterator[None]:
    """Hold the lock of a file, after waiting for it; where there is none to be had, go on without it."""
    with contextlib.ExitStack() as stack:
        with contextlib.suppress(OSError):
            path.parent.mkdir(parents=True, exist_ok=True)
            file = stack.enter_context(path.open("w"))
            give_up = time.monotonic() + LONGEST_WAIT
            while try_lock(file) is False and time.monotonic() < give_up:
                time.sleep(POLL_INTERVAL)
        yield


# ----------------------------------------------------------------------------------------------------
# Generations of compiled code in one cache folder: one for each version of carom's code, of Python and of Numba.
#
# Several versions are used in turn (another clone, another virtual environment, a branch), and compiling takes minutes: what was
# used in the last 30 days is kept, up to 2 GB. A generation that a process uses is never removed: each process holds a shared
# lock of it, which ends with the process. Without such locks (on Windows, on some network drives) a generation that was used in
# the last two days counts as in use.


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


# ----------------------------------------------------------------------------------------------------
# The folder in which compiled code is cached, named after a hash of what carom's code does.


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


# ----------------------------------------------------------------------------------------------------
# The cache of compiled loops, shared by installations of the same code and by processes that run at the same time.
#
# Numba keeps compiled code under the path and the time of the source file, so that each clone and each virtual environment
# compiles everything again, and processes that start together all compile the same loop. Here compiled code is found by the name
# of its module (the cache folder's own name is a hash of what carom's code does), and a loop is compiled by one process at a
# time: the others wait, and load it.


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
