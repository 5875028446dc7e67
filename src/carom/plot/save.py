"""Writing pictures: whole or not at all, and the same bytes from the same picture."""

from __future__ import annotations

import importlib.util
import os
import tempfile
from pathlib import Path
from typing import Any

from carom.checks import nearest
from carom.errors import CaromError
from carom.files import path_of, try_place

__all__ = ["require_matplotlib", "require_writable", "save", "style"]

# What a file says of its making, by kind: nothing that changes from one run to the next.
METADATA: dict[str, dict[str, str | None]] = {
    "svg": {"Date": None},
    "pdf": {"CreationDate": None, "Creator": "carom", "Producer": None},
    "png": {"Software": None},
}


def require_matplotlib() -> None:
    """CaromError where Matplotlib is not installed."""
    if importlib.util.find_spec("matplotlib") is None:
        raise CaromError("plot: needs Matplotlib, which is not installed; run: pip install matplotlib")


def require_writable(path: str | os.PathLike[str]) -> None:
    """CaromError where a picture cannot be written: an unknown kind, no such folder, no leave to write there."""
    path = path_of("plot", path)
    kind = path.suffix.lower().removeprefix(".")
    if kind not in METADATA:
        kinds = [f".{name}" for name in METADATA]
        raise CaromError(
            f"plot: {path}: expected a name that ends with one of {', '.join(kinds)}, got {path.suffix or 'none'!r};"
            f" {nearest(path.suffix.lower(), kinds)}"
        )
    if not path.absolute().parent.is_dir():
        raise CaromError(f"plot: {path}: expected a folder that exists, got {str(path.parent)!r}; make it first")
    if path.is_dir():
        raise CaromError(f"plot: {path}: expected a file to write, got a folder")
    if not os.access(path.absolute().parent, os.W_OK) or (path.exists() and not os.access(path, os.W_OK)):
        raise CaromError(f"plot: {path}: expected leave to write there, got none; choose another place")
    try:
        try_place(path)
    except CaromError as error:
        raise CaromError(f"plot: {error}") from None


def style() -> Any:
    """Context in which a picture is made and written: carom's own settings over Matplotlib's defaults, not the user's."""
    require_matplotlib()
    import matplotlib.style

    return matplotlib.style.context(["default", str(Path(__file__).with_name("carom.mplstyle"))])


def save(figure: Any, path: str | os.PathLike[str]) -> None:
    """Write a Figure as .svg, .pdf or .png, by the name's ending.

    The file appears whole or not at all, and the same picture gives the same bytes. Raises CaromError where it cannot be
    written.
    """
    require_writable(path)
    path = Path(path)
    kind = path.suffix.lower().removeprefix(".")
    handle = temporary = None
    try:
        handle, temporary = tempfile.mkstemp(dir=path.absolute().parent, prefix=f".{path.stem}-", suffix=path.suffix)
        os.close(handle)
        with style():
            figure.savefig(temporary, format=kind, metadata=METADATA[kind])
        mask = os.umask(0)
        os.umask(mask)
        os.chmod(temporary, 0o666 & ~mask)
        os.replace(temporary, path)
        temporary = None
    except OSError as error:
        raise CaromError(f"plot: {path}: cannot be written ({error.strerror})") from error
    finally:
        if temporary is not None:
            Path(temporary).unlink(missing_ok=True)
