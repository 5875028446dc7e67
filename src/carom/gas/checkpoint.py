"""Checkpoints: the state of a session in one file, from which it continues with the same bits.

An NPZ file: NumPy's arrays, bit by bit, in a ZIP archive, whose checksums reveal every change. Arrays of all balls are written
block by block and read one at a time, so that a large gas is never in memory twice. The file is written under a temporary
name, synchronised to disk, and then replaces the previous one; so a full disk, or a run killed while it writes, leaves the
previous one as it is.
"""

from __future__ import annotations

import json
import os
import zipfile
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from importlib.metadata import version
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np
from numpy.typing import NDArray

from carom.errors import CaromError
from carom.files import as_path, atomic_file, open_regular
from carom.gas.npz import npz_headers, require_npz_size
from carom.gas.scene import GasScene
from carom.gas.session import Session
from carom.gas.state import course_as_arrays
from carom.scene.schema import from_file
from carom.scene.toml import stored_model

__all__ = ["FORMAT", "load_checkpoint", "require_checkpoint", "save_checkpoint"]

FORMAT = 7
# Fields of [run] that may change: the run then continues for longer.
CHANGEABLE = ("max_events", "duration")


def save_checkpoint(session: Session, path: str | Path) -> None:
    """Write the state of a session to a file.

    Parameters
    ----------
    session : Session
        With its gas and measurements.
    path : str or Path
        An existing file is replaced atomically.

    Returns
    -------
    None

    Raises
    ------
    CaromError
        If the file cannot be written; a previous one is then left unchanged.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> from carom.gas import GasScene, Session, load_checkpoint, save_checkpoint
    >>> species = {"count": 64, "radius": 0.5}
    >>> contact = {"between": ("a", "a"), "restitution": 1, "friction": 0}
    >>> scene = GasScene(
    ...     container={"shape": "periodic", "size": (6, 6, 6)}, species=[species], contacts=[contact], run={"max_events": 2000}
    ... )
    >>> session = Session(scene)
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     save_checkpoint(session, Path(folder) / "gas.npz")
    ...     again = load_checkpoint(Path(folder) / "gas.npz")
    >>> again.run() and session.run()
    True
    >>> again.gas.time == session.gas.time
    True
    """
    path = as_path("save_checkpoint", path)
    about = {"format": FORMAT, "carom": version("carom"), "scene": stored_model("save_checkpoint", session.scene)}
    about["outputs"] = session.outputs
    with atomic_file(path) as file:
        with zipfile.ZipFile(file, "w", allowZip64=True) as archive:
            _write_array(archive, "carom_checkpoint", np.array(json.dumps(about)))
            for name, array in course_as_arrays(session).items():
                _write_array(archive, name, array)
            for name, blocks in session.gas.saved().items():
                _write_blocks(archive, f"gas.{name}", *blocks)
        file.flush()
        os.fsync(file.fileno())


def _write_array(archive: zipfile.ZipFile, name: str, array: NDArray[Any]) -> None:
    with archive.open(f"{name}.npy", "w", force_zip64=True) as part:
        np.lib.format.write_array(part, array, allow_pickle=False)


def _write_blocks(archive: zipfile.ZipFile, name: str, length: int, blocks: Iterator[NDArray[Any]]) -> None:
    """Write an array that is made block by block: no copy of the whole is in memory."""
    with archive.open(f"{name}.npy", "w", force_zip64=True) as part:
        for k, block in enumerate(blocks):
            if k == 0:
                head = {"descr": np.lib.format.dtype_to_descr(block.dtype), "fortran_order": False, "shape": (length,)}
                np.lib.format.write_array_header_1_0(part, head)
            part.write(block.tobytes())


def require_checkpoint(path: Path) -> None:
    """Raise CaromError where a checkpoint would replace a file that is not a checkpoint."""
    if not path.exists():
        return
    with open_regular(path, "a checkpoint to replace") as file:
        is_other = not zipfile.is_zipfile(file)
    if is_other:
        raise CaromError(
            f"{path}: expected a checkpoint or a new file, got an existing file of another kind; choose a new name"
        )


def load_checkpoint(
    path: str | Path, scene: GasScene | None = None, *, compiling: Callable[[], None] | None = None
) -> Session:
    """Return the session of a checkpoint; its continuation is bitwise identical to the saved session's.

    Parameters
    ----------
    path : str or Path
    scene : GasScene, optional
        It has to be the checkpoint's, except for ``max_events`` and ``duration``: with larger ones the run continues for longer.
        Default: the checkpoint's own.
    compiling : callable, optional
        Called when the file is known to be valid, before the event loop is compiled.

    Returns
    -------
    Session

    Raises
    ------
    CaromError
        For a file that is missing, damaged, not a checkpoint, of another format, or of another scene.

    Examples
    --------
    See :func:`save_checkpoint`.

    >>> from carom.gas import load_checkpoint
    >>> load_checkpoint("missing.npz")
    Traceback (most recent call last):
    carom.errors.CaromError: missing.npz: expected a checkpoint, got: No such file or directory
    """
    path = as_path("load_checkpoint", path)
    with open_regular(path, "a checkpoint") as raw:
        state = _Arrays(path, raw)
        about = state.about
        if about["format"] != FORMAT:
            raise CaromError(
                f"{path}: expected a checkpoint of format {FORMAT}, got format {about['format']} of carom {about['carom']};"
                " continue with that version"
            )
        own = from_file(f"{path}: scene", GasScene, about["scene"])
        if scene is not None and (other := _difference(_fixed(own), _fixed(scene))) is not None:
            field, was, now = other
            raise CaromError(
                f"{path}: expected a checkpoint of this scene, got one of another scene: its {field} is {was}, not {now};"
                " only run.max_events and run.duration may change"
            )
        if scene is not None:
            _require_no_shorter(path, own, scene)
        try:
            session = Session.restore(own if scene is None else scene, state, compiling)
            session.outputs = {str(option): str(name) for option, name in about["outputs"].items()}
            return session
        except _DamagedFileError:
            raise
        except (KeyError, ValueError, IndexError, TypeError) as error:
            raise CaromError(
                f"{path}: expected a checkpoint that this carom can continue, got one of carom {about['carom']} with other"
                f" contents ({error}); start anew, or continue with that version"
            ) from None


class _DamagedFileError(CaromError):
    """A file that cannot be read as a checkpoint."""


class _Arrays(Mapping[str, NDArray[Any]]):
    """The arrays of a checkpoint, each read from the file, and its checksum compared, whenever it is asked for."""

    def __init__(self, path: Path, raw: BinaryIO) -> None:
        self.path = path
        with self._reading():
            if zipfile.is_zipfile(raw):
                require_npz_size(path, npz_headers(path, raw))
            raw.seek(0)
            file = np.load(raw, allow_pickle=False)
            if not isinstance(file, np.lib.npyio.NpzFile) or "carom_checkpoint" not in file:
                raise CaromError(f"{path}: expected a checkpoint of carom gas, got another file")
            self._file = file
            self.about = _description(json.loads(str(file["carom_checkpoint"])))

    def __getitem__(self, name: str) -> NDArray[Any]:
        if name not in self._file:
            raise KeyError(name)
        with self._reading():
            return self._file[name]

    def __iter__(self) -> Iterator[str]:
        return (name for name in self._file if name != "carom_checkpoint")

    def __contains__(self, name: object) -> bool:
        return name in self._file

    def __len__(self) -> int:
        return len(self._file) - 1

    @contextmanager
    def _reading(self) -> Iterator[None]:
        try:
            yield
        except CaromError:
            raise
        except Exception as error:  # damage shows in exceptions of zipfile, zlib, NumPy and JSON
            said = str(error).splitlines()[0] if str(error) else type(error).__name__
            if "pickle" in said:  # NumPy's message for a file of another kind, with an unsafe remedy
                said = "not a file of NumPy"
            raise _DamagedFileError(
                f"{self.path}: expected an intact checkpoint of carom gas, got a file that cannot be read ({said})"
            ) from None


def _description(about: Any) -> dict[str, Any]:
    """Return the description in a checkpoint: format, carom's version, scene, and names of files; ValueError for what is none."""
    if not isinstance(about, dict) or type(about.get("format")) is not int:
        raise ValueError("it does not say its format")
    # (one of another format may hold anything else)
    found: dict[str, Any] = {"carom": "of an unknown version", "outputs": {}} | about
    if found["format"] == FORMAT and not all(isinstance(found.get(name), dict) for name in ("scene", "outputs")):
        raise ValueError("it holds no scene")
    return found


def _fixed(scene: GasScene) -> dict[str, Any]:
    """Return the fields of a scene that have to be the checkpoint's, as plain values; of a start's file the name."""
    table = stored_model("load_checkpoint", scene)
    table["run"] = {name: value for name, value in table["run"].items() if name not in CHANGEABLE}
    table["run"]["start"] = Path(table["run"]["start"]).name
    table["run"]["equilibrate"] = scene.equilibrate
    return table


def _require_no_shorter(path: Path, own: GasScene, scene: GasScene) -> None:
    """Raise CaromError where a run is to be shorter than the checkpoint's: what lies after its end would still be in it."""
    for name in CHANGEABLE:
        was, now = getattr(own.run, name), getattr(scene.run, name)
        if now is not None and (was is None or now < was):
            expected = f"no run.{name}" if was is None else f"a run.{name} of at least {_counted(was)}"
            raise CaromError(
                f"{path}: expected {expected}, as in the checkpoint, got {_counted(now)}; a run can only be continued for longer"
            )


def _counted(value: float) -> str:
    return f"{value:,}" if isinstance(value, int) else f"{value:g}"


def _difference(one: Any, two: Any, at: str = "") -> tuple[str, Any, Any] | None:
    """Return the first field in which two tables differ: its name, and both values."""
    if isinstance(one, dict) and isinstance(two, dict):
        for name in dict.fromkeys([*one, *two]):
            found = _difference(one.get(name), two.get(name), f"{at}.{name}" if at else name)
            if found is not None:
                return found
        return None
    if isinstance(one, list) and isinstance(two, list) and len(one) == len(two):
        for k, (a, b) in enumerate(zip(one, two, strict=True)):
            if (found := _difference(a, b, f"{at}[{k}]")) is not None:
                return found
        return None
    return None if one == two else (at, _shown(one), _shown(two))


def _shown(value: Any) -> str:
    """Return a value as a message shows it."""
    if isinstance(value, list):
        return f"{len(value)} of them" if value and isinstance(value[0], dict) else str(value)
    return "not given" if value is None else str(value)
