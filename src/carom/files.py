"""Write files atomically, check beforehand that they can be written, read text, and import optional libraries.

A file that carom writes is complete or not there: :func:`atomic_path`, :func:`atomic_file` and :func:`write_text` write beside
the target and rename at the end. :func:`require_writable` finds what would fail before a long run starts.
"""

from __future__ import annotations

import codecs
import contextlib
import errno
import functools
import glob
import importlib
import importlib.util
import io
import math
import os
import platform
import shlex
import shutil
import stat
import sys
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any, BinaryIO, NamedTuple

from carom.errors import CaromError, Fault, MissingLibraryError, did_you_mean
from carom.formatting import escape_controls, format_bytes

# --- optional libraries --------------------------------------------------------------------------------------------

# Each optional library: its name in prose, and carom's extra that installs it.
OPTIONAL = {
    "av": ("PyAV", "video"),
    "gsd": ("gsd", "gsd"),
    "gymnasium": ("Gymnasium", "env"),
    "imageio_ffmpeg": ("imageio-ffmpeg", "film"),
    "jax": ("JAX", "jax"),
    "matplotlib": ("Matplotlib", "plot"),
    "msgpack": ("msgpack", "msgpack"),
    "pandas": ("pandas", "pandas"),
    "pettingzoo": ("PettingZoo", "env"),
    "pyarrow": ("pyarrow", "parquet"),
    "scipy": ("SciPy", "fit"),
    "distributed": ("Dask's distributed", "cluster"),
    "sympy": ("SymPy", "derive"),
    "torch": ("PyTorch", "torch"),
    "xarray": ("xarray", "xarray"),
    "zarr": ("Zarr", "sweeps"),
}


def import_optional(module: str, needed_by: str) -> Any:
    """Import a module of an optional library.

    Parameters
    ----------
    module : str
        Such as ``"gsd.hoomd"``; its top level is one of :data:`OPTIONAL`.
    needed_by : str
        What needs it, for the message: an option, a file's name, a function.

    Raises MissingLibraryError, naming the extra to install, where the library is not installed.
    """
    require_library(module.partition(".")[0], needed_by)
    try:
        return importlib.import_module(module)
    except ImportError as error:  # installed, but broken or too old
        raise MissingLibraryError(f"{needed_by}: cannot import {module}: {error}") from error


def require_library(name: str, needed_by: str) -> None:
    """Raise MissingLibraryError where an optional library is not installed; it is looked for, not imported."""
    if sys.modules.get(name) is None and not _is_installed(name):
        prose, extra = OPTIONAL[name]
        raise MissingLibraryError(f"{needed_by}: needs {prose}, which is not installed; run: {install_command(extra)}")


def install_command(extra: str) -> str:
    """Return the command that installs an extra of carom here, to be copied to a shell.

    It names this interpreter, since a shell's own may be another one, and installs from where carom was installed from:
    a folder, an archive, a repository, or the package index.

    Examples
    --------
    >>> install_command("plot")  # doctest: +SKIP
    "python -m pip install 'carom[plot]'"
    """
    return f"{_installer()} {_requirement(extra)}"


def _installer() -> str:
    """Return the command's first words: pip of this interpreter, else of the one that made the environment, or uv."""
    if _is_installed("pip"):
        return f"{_program(sys.executable)} -m pip install"
    prefix = _quoted(sys.prefix)
    if _metadata("INSTALLER").strip() == "uv":
        return f"uv pip install --python {prefix}"
    return f"{_program(getattr(sys, '_base_executable', sys.executable))} -m pip --python {prefix} install"


def _program(executable: str) -> str:
    """Return how a shell calls an interpreter: by its bare name where that finds the same one, else by its path."""
    for name in ("python", "python3"):
        found = shutil.which(name)
        if found is not None and os.path.abspath(found) == os.path.abspath(executable):
            return name
    return _quoted(executable)


def _requirement(extra: str) -> str:
    """Return the requirement for pip: carom with an extra, from where it was installed from (PEP 610)."""
    import json
    from urllib.parse import urlsplit
    from urllib.request import url2pathname

    clone = Path(__file__).parents[2]
    if (clone / "pyproject.toml").is_file() and (clone / "src" / "carom").is_dir():  # run from a clone
        return _quoted(f"{clone}[{extra}]")
    about = json.loads(_metadata("direct_url.json") or "{}")
    url = str(about.get("url", ""))
    if "vcs_info" in about:
        return _quoted(f"carom[{extra}] @ {about['vcs_info']['vcs']}+{url}@{about['vcs_info']['commit_id']}")
    if url.startswith("file:"):
        path = Path(url2pathname(urlsplit(url).path))
        return _quoted(f"{path}[{extra}]") if path.exists() else f"{_quoted(f'.[{extra}]')}  # in a clone of carom"
    return _quoted(f"carom[{extra}] @ {url}" if url else f"carom[{extra}]")


def _metadata(name: str) -> str:
    """Return a file of carom's installation record; empty if there is none."""
    from importlib import metadata

    try:
        return metadata.distribution("carom").read_text(name) or ""
    except metadata.PackageNotFoundError:
        return ""


def _quoted(word: str) -> str:
    return f'"{word}"' if os.name == "nt" else shlex.quote(word)


def _is_installed(name: str) -> bool:
    try:
        return importlib.util.find_spec(name) is not None
    except (ImportError, ValueError):  # (what keeps a library from being imported may say so in its own way)
        return False


# --- where a file can be written -----------------------------------------------------------------------------------


def as_path(where: str, value: Any) -> Path:
    """Return the Path of a file's name; CaromError, starting with ``where``, if it is not a name."""
    if not isinstance(value, str | os.PathLike):
        got = f"{type(value).__name__} {value!r:.60}"
        raise CaromError(f"{where}: path: expected a file's name, as str or Path, got {got}; give the file's name")
    if "\0" in os.fsdecode(value):
        raise CaromError(f"{where}: path: expected a file's name, got {value!r:.60}, with a zero byte; remove it")
    return Path(os.fsdecode(value))


def require_writable(path: Path, endings: Sequence[str] = (), *, source: Path | None = None) -> None:
    """Raise CaromError where a file cannot be written.

    Parameters
    ----------
    path : Path
    endings : sequence of str, optional
        The endings that the name may have, such as ``(".svg", ".pdf")``; any by default.
    source : Path, optional
        A file that is read at the same time and must not be written over.

    A file is made beside ``path`` and removed again: permissions alone do not tell of a full or read-only disk.
    """
    if endings and path.suffix.lower() not in endings:
        names = f"{', '.join(endings[:-1])} or {endings[-1]}" if len(endings) > 1 else endings[0]
        got = repr(path.suffix) if path.suffix else "none"
        hint = did_you_mean(path.suffix.lower(), endings)
        raise CaromError(Fault(f"{path}", "", f"a name that ends with {names}", got, hint))
    _require_other_file(path, source)
    if _is_device(path):
        if not os.access(path, os.W_OK):
            raise cannot_write(path, PermissionError(errno.EACCES, os.strerror(errno.EACCES)))
        return
    folder = path.absolute().parent
    if not folder.is_dir():
        raise CaromError(f"{path}: expected a folder that exists, got {str(path.parent)!r}; make it first")
    if not os.access(folder, os.W_OK) or (path.exists() and not os.access(path, os.W_OK)):
        raise CaromError(f"{path}: expected permission to write there, got none; choose another place")
    try:
        with tempfile.NamedTemporaryFile(prefix=".carom-", dir=folder):
            pass
    except OSError as error:
        raise cannot_write(path, error) from None


def _require_other_file(path: Path, source: Path | None) -> None:
    if source is not None and path.exists() and source.exists() and path.samefile(source):
        raise CaromError(f"{path}: expected another file than the one that is read, got the same; name a new one")
    if path.is_dir():
        raise CaromError(f"{path}: expected a file to write, got a folder; name a file in it")


def _is_device(path: Path) -> bool:
    """Return whether a path is a device or a pipe, which is written to and cannot be replaced."""
    return path.exists() and not path.is_file() and not path.is_dir()


def cannot_write(where: Path | str, error: OSError) -> CaromError:
    """Return the error, in one line, of a file that could not be written."""
    expected, remedy = "a place to write to", "choose another one"
    if error.errno in (errno.ENOSPC, errno.EDQUOT, errno.EFBIG):
        expected, remedy = "room to write", "free some space, or choose another place"
        error = OSError(error.errno, os.strerror(error.errno or 0))  # (a library may say it at more length)
    elif error.errno in (errno.EACCES, errno.EPERM, errno.EROFS):
        expected, remedy = "permission to write there", "choose another place"
    elif error.errno == errno.ENOENT:
        expected, remedy = "a folder that exists", "make it first"
    got = error.strerror or (str(error).splitlines() or [type(error).__name__])[0]
    return CaromError(f"{where}: expected {expected}, got: {got}; {remedy}")


# --- files that are complete or not there --------------------------------------------------------------------------


def _temporary(process: int | str = "") -> str:
    """Return how the names of temporary folders begin: by machine and process."""
    return f".carom-{platform.node()}-{process or os.getpid()}-"


@functools.cache
def _remove_abandoned(folder: Path) -> None:
    """Remove temporary folders of this machine's processes that were killed while they wrote here; looked for once."""
    if os.name != "posix":  # (where there is no question without a signal)
        return
    begin = _temporary("*").partition("*")[0]
    for path in folder.glob(f"{glob.escape(begin)}*"):
        process = path.name.removeprefix(begin).partition("-")[0]
        try:
            os.kill(int(process), 0)
        except ProcessLookupError:
            shutil.rmtree(path, ignore_errors=True)
        except (ValueError, OverflowError, OSError):  # (of another user: it is there)
            continue


@contextmanager
def atomic_path(target: Path | None, *, source: Path | None = None) -> Iterator[Path]:
    """Yield a path to write to; what is there when the block ends without an error becomes the target.

    Parameters
    ----------
    target : Path or None
        The file, of which a link is followed; a device or a pipe, which is written to at the end; None: standard output.
    source : Path, optional
        A file that is read at the same time; the target has to be another one.

    The path has the target's name, in a new folder beside it. If the block fails, an existing target stays as it is.
    Raises CaromError, one line, where the target cannot be written: no folder, no permission, no room on the disk.

    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     with atomic_path(Path(folder) / "a.txt") as part:
    ...         _ = part.write_text("all of it")
    ...     [path.name for path in Path(folder).iterdir()]
    ['a.txt']
    """
    where = "standard output" if target is None else target
    if target is not None:
        _require_other_file(target, source)
    in_place = target is not None and not _is_device(target)
    try:
        place = Path("output") if target is None else target.resolve()
        if in_place:
            _remove_abandoned(place.parent)
        folder = tempfile.mkdtemp(prefix=_temporary(), dir=place.parent if in_place else None)
    except OSError as error:
        raise cannot_write(where, error) from None
    try:
        part = Path(folder) / place.name
        yield part
        if in_place:
            part.replace(place)
        else:
            _copy(part, None if target is None else place)
    except OSError as error:
        # the block may also read files, whose errors name them
        if error.filename is not None and not str(error.filename).startswith((folder, str(place))):
            raise
        raise cannot_write(where, error) from None
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def _copy(part: Path, device: Path | None) -> None:
    """Copy a finished file to a device, a pipe or standard output (None)."""
    with part.open("rb") as file:
        if device is not None:
            with device.open("wb") as opened:
                shutil.copyfileobj(file, opened)
            return
        # a reader that closes the pipe early, such as `head`, is not an error
        with contextlib.suppress(BrokenPipeError):
            # a pipe gets the bytes as they are; a terminal is not steered by cells of a table
            if sys.stdout.isatty():
                for line in io.TextIOWrapper(file, "utf-8", "replace", newline=""):
                    sys.stdout.write(escape_controls(line.replace("\r\n", "\n")))
                return
            shutil.copyfileobj(file, sys.stdout.buffer)
            sys.stdout.buffer.flush()


@contextmanager
def atomic_file(target: Path | None, *, source: Path | None = None) -> Iterator[BinaryIO]:
    """Yield a binary file to write to, which becomes the target as with :func:`atomic_path`."""
    with atomic_path(target, source=source) as part, part.open("wb") as file:
        yield file


def write_text(target: Path | None, text: str) -> None:
    """Write text in UTF-8, with line ends as they are, as with :func:`atomic_path`."""
    with atomic_file(target) as file:
        file.write(text.encode())


# --- opening what may be anything --------------------------------------------------------------------------------------

MOST_TEXT = 1 << 26  # bytes of a scene, or of another file that a person writes,
MOST_TABLE = 1 << 30  # and of a table that is in memory as a whole
READABLE = "a file that can be read"


def open_regular(path: Path, what: str = READABLE, most: float = math.inf, advice: str = "") -> BinaryIO:
    """Open a file that a user, or another file, names; what every reader begins with.

    A device or a pipe has no end, or waits for ever. Raises CaromError, one line, for what is no regular file, is larger than
    ``most`` bytes, or cannot be opened; ``what`` is what was expected, ``advice`` helps where there is no file.
    """
    try:
        about = path.stat()
        if stat.S_ISREG(about.st_mode) and about.st_size <= most:
            return path.open("rb")
    except OSError as error:
        missing = isinstance(error, FileNotFoundError)
        raise CaromError(Fault(f"{path}", "", what, f": {error.strerror}", advice if missing else "")) from None
    except ValueError:  # (a zero byte)
        raise CaromError(Fault(f"{path}", "", what, "no name of a file")) from None
    if stat.S_ISREG(about.st_mode):
        raise CaromError(
            Fault(f"{path}", "", f"{what} of at most {format_bytes(most)}", format_bytes(about.st_size), "divide it")
        )
    if stat.S_ISDIR(about.st_mode):
        raise CaromError(Fault(f"{path}", "", what, "a folder"))
    raise CaromError(Fault(f"{path}", "", what, "a device or a pipe", "write what it gives to a file first"))


def read_regular(path: Path, what: str = READABLE, most: int = MOST_TEXT, advice: str = "") -> bytes:
    """Return the bytes of a file that is opened as by :func:`open_regular`."""
    with open_regular(path, what, most, advice) as file:
        raw = file.read(most + 1)  # (a file of the system may say that it is empty)
    if len(raw) > most:
        raise CaromError(Fault(f"{path}", "", f"{what} of at most {format_bytes(most)}", "more"))
    return raw


def parse_json(where: Path | str, text: str | bytes, expected: str = "JSON") -> Any:
    """Return what a text in JSON holds. Raises CaromError, one line that begins with ``where``, for any other text.

    Examples
    --------
    >>> parse_json("a.json", "[1, 2]")
    [1, 2]
    """
    import json

    try:
        return json.loads(text)
    except RecursionError:
        got = "brackets nested too deep to read"
    except json.JSONDecodeError as error:
        got = f"text that is no JSON in line {error.lineno}: {error.msg}"
    except ValueError as error:  # (bytes that are no text, a number of too many digits)
        got = str(error)
    raise CaromError(f"{where}: expected {expected}, got {got}") from None


# --- how much memory there is ------------------------------------------------------------------------------------------


SMALL = 1e8  # bytes, for which no machine is asked


def memory_left() -> float:
    """Return how many bytes this process may still take, by what the machine has free and by its limits; inf where none is known.

    What would take more is refused before it is made.
    """
    found = [math.inf]
    with contextlib.suppress(OSError, ValueError):
        lines = Path("/proc/meminfo").read_text(encoding="ascii").splitlines()
        found += [1024.0 * int(line.split()[1]) for line in lines if line.startswith("MemAvailable:")]
    with contextlib.suppress(OSError, ValueError):  # (of a container; "max" is none)
        found.append(float(Path("/sys/fs/cgroup/memory.max").read_text(encoding="ascii")))
    with contextlib.suppress(ImportError, OSError):
        import resource

        limit = resource.getrlimit(resource.RLIMIT_AS)[0]
        found += [float(limit)] if limit != resource.RLIM_INFINITY else []
    return min(found)


def require_memory(where: str, field: str, count: float, each: float, advice: str, most: float = math.inf) -> None:
    """Raise CaromError where so many things of so many bytes each would take more than :func:`memory_left`, or than ``most``."""
    if count * each <= SMALL:
        return
    room = min(memory_left(), most)
    if count * each > room:
        got = f"{count:,.15g}, which take {format_bytes(count * each)}"
        raise CaromError(
            Fault(where, field, f"no more than {int(room / each):,}, which fill {format_bytes(room)}", got, advice)
        )


# --- how large a file becomes --------------------------------------------------------------------------------------

MOST_UNPACKED = 1 << 28  # bytes in memory that the arrays of any file may take,
MOST_TIMES = 100  # and how many times the bytes of the file itself: measured data and checkpoints stay far below


def require_unpacked_size(path: Path, declared: float) -> None:
    """Raise CaromError where the arrays that a file declares, in bytes, would be far larger in memory than the file.

    A few megabytes can unpack to terabytes. What is asked is what a header says, before anything is unpacked.
    """
    packed = path.stat().st_size
    if declared > max(MOST_UNPACKED, MOST_TIMES * packed):
        raise CaromError(
            f"{path}: expected arrays of at most {MOST_TIMES} times the size of their file, got {format_bytes(declared)} in"
            f" {format_bytes(packed)}: it is damaged, or meant to fill the memory; if it is yours, save it without compression"
        )


# --- reading text --------------------------------------------------------------------------------------------------


class TextEncoding(NamedTuple):
    """How the characters of a text file are encoded."""

    codec: str
    mark: bytes
    """The byte-order mark with which the file begins; empty if it has none."""


def text_encoding(start: bytes) -> TextEncoding:
    """Return the encoding of a text file from its first bytes: UTF-16 if it begins with that mark, else UTF-8.

    Examples
    --------
    >>> text_encoding("t,x,y".encode("utf-16")).codec
    'utf-16-le'
    """
    for mark, codec in (
        (codecs.BOM_UTF16_LE, "utf-16-le"),
        (codecs.BOM_UTF16_BE, "utf-16-be"),
        (codecs.BOM_UTF8, "utf-8"),
    ):
        if start.startswith(mark):
            return TextEncoding(codec, mark)
    return TextEncoding("utf-8", b"")


def read_text(path: Path) -> str:
    """Read a text file: UTF-8, or UTF-16 with its byte-order mark; Latin-1 if the bytes are not valid UTF-8.

    Raises CaromError for a file that cannot be read, for a binary one, and for UTF-16 that is damaged.
    """
    raw = read_regular(path, most=MOST_TABLE)
    encoding = text_encoding(raw)
    raw = raw[len(encoding.mark) :]
    try:
        text = raw.decode(encoding.codec)
    except UnicodeDecodeError as error:
        if encoding.codec != "utf-8":
            raise CaromError(
                f"{path}: expected text in UTF-16, as its first two bytes say, got {error.reason} at byte {error.start + 2}: is the"
                " file cut short? save it again, as UTF-8 if possible"
            ) from None
        text = raw.decode("latin-1")  # the degree sign of an old program, say
    if "\0" in text[:1000]:
        raise CaromError(f"{path}: expected a text file, got a binary one; export it as CSV")
    return text
