"""Checkpoints: the state of a session in one file, from which it continues with the same bits.

An NPZ file: NumPy's arrays, bit by bit, in a ZIP archive, whose checksums reveal every change. Arrays of all balls are written
block by block and read one at a time, so that a large gas is never in memory twice. The file is written under a temporary
name, synchronised to disk, and then replaces the previous one; so a full disk, or a run killed while it writes, leaves the
previous one as it is.
"""

from __future__ import annotations

import json
import os
import time
import zipfile
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np
from numpy.typing import NDArray

from carom.errors import CaromError, FaultList, collected
from carom.files import as_path, atomic_file, open_regular
from carom.gas.results import EndedEarlyError, Every
from carom.gas.scene import GasScene
from carom.gas.session import Session, course_as_arrays
from carom.gas.snapshots import MAX_BYTES, Snapshots, npz_headers, require_npz_size
from carom.scene.schema import from_file
from carom.scene.toml import stored_model

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


# ----------------------------------------------------------------------------------------------------
# The run of a session with its files: snapshots and checkpoints, written while it runs.
#
# Where a file cannot be written, the run continues without it, and the fault is in the result.


Say = Callable[[str], None]


@dataclass(frozen=True)
class RunFiles:
    """Files that a run writes while it goes on."""

    snapshots: Path | None = None
    every: Every | None = None
    """Between two snapshots."""
    max_bytes: float = MAX_BYTES
    """Largest size of the snapshots."""
    checkpoint: Path | None = None
    checkpoint_every: int | float = 600.0
    """Between two checkpoints: a number of collisions, or a time of the clock on the wall (s)."""
    when_stopped: Path | None = None
    """A checkpoint for a run that is stopped and has none."""


@dataclass(frozen=True)
class SessionEnd:
    """How a run ended."""

    finished: bool
    """Or stopped."""
    faults: FaultList
    """Why the gas ended early, and files that could not be written."""
    checkpoint: Path | None
    """If it was written."""
    snapshots: Path | None
    """If all of them were written."""


def run_with_files(
    session: Session, files: RunFiles, *, stop: Callable[[], bool], progress: Callable[[Session], Any], say: Say
) -> SessionEnd:
    """Continue a session to its end, or to where ``stop`` returns True, and write its files meanwhile.

    Raises EndedEarlyError for a gas that ends while it equilibrates; CaromError where a file cannot be begun.
    """
    faults = FaultList()
    frames = None if files.snapshots is None else _Frames(files, session, faults, say)
    checkpoints = _Checkpoints(files, session, frames, say)

    early = None
    try:
        try:
            for due in session.pieces(None if frames is None else files.every, stop=stop):
                if due and frames is not None:
                    frames.write(session)
                progress(session)
                checkpoints.save_if_due()
        except EndedEarlyError as error:
            if not session.measuring:
                raise
            early = error
        finished = session.finished or early is not None
        path, saved = files.checkpoint or (None if finished else files.when_stopped), None
        if path is not None:
            with collected(faults):
                checkpoints.save(path)
                saved = path
    finally:
        if frames is not None:
            frames.close()
    if early is not None:
        faults[:0] = early.records
    return SessionEnd(finished, faults, saved, None if frames is None or frames.failed else files.snapshots)


class _Frames:
    """Writes snapshots; where that fails, the run continues without them."""

    def __init__(self, files: RunFiles, session: Session, faults: FaultList, say: Say) -> None:
        assert files.snapshots is not None
        self.taken = session.snapshots_taken
        self.file: Snapshots | None = Snapshots(
            files.snapshots, session.names, self.taken or None, max_bytes=files.max_bytes
        )
        self.faults, self.say, self.failed = faults, say, False
        if files.every is not None and (gap := session.snapshot_gap(files.every)) is not None:
            say(f"snapshots from t = {gap[0]:.6g} to {gap[1]:.6g} are missing: the run went on without them")

    def write(self, session: Session) -> None:
        """Write a frame."""
        if self._attempted(lambda file: file.write(session.gas)):
            self.taken += 1
        session.snapshots_taken = self.taken  # as many as a run that resumes finds

    def flush(self) -> None:
        """Write all frames to disk."""
        self._attempted(lambda file: file.flush())

    def close(self) -> None:
        """Write all frames to disk, and close the file."""
        self._attempted(lambda file: file.close())

    def _attempted(self, action: Callable[[Snapshots], None]) -> bool:
        if self.file is None:
            return False
        try:
            action(self.file)
        except CaromError as error:
            self.file.close()
            self.file, self.failed = None, True
            self.faults += error.records
            self.say(f"carom: {'; '.join(error.faults)}; the run continues without snapshots")
            return False
        return True


class _Checkpoints:
    """Writes checkpoints at intervals."""

    def __init__(self, files: RunFiles, session: Session, frames: _Frames | None, say: Say) -> None:
        self.files, self.session, self.frames, self.say = files, session, frames, say
        self.last: float | None = None
        if files.checkpoint is not None:  # (what cannot be resumed is refused before the run)
            stored_model("checkpoint", session.scene)

    def save_if_due(self) -> None:
        """Write a checkpoint if one is due. If that fails, the run continues and the previous checkpoint stays."""
        every, path = self.files.checkpoint_every, self.files.checkpoint
        now = self.session.gas.collisions if isinstance(every, int) else time.monotonic()
        if path is None or self.last is None:
            self.last = now if self.last is None else self.last
        elif now - self.last >= every:
            self.last = now
            try:
                self.save(path)
            except CaromError as error:
                self.say(f"carom: {error}; the previous checkpoint stays, and the run continues")

    def save(self, path: Path) -> None:
        """Write a checkpoint now, after all frames that it counts."""
        if self.frames is not None:
            self.frames.flush()
        save_checkpoint(self.session, path)
