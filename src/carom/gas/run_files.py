"""The run of a session with its files: snapshots and checkpoints, written while it runs.

Where a file cannot be written, the run continues without it, and the fault is in the result.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from carom.errors import CaromError, FaultList, collected
from carom.gas.checkpoint import save_checkpoint
from carom.gas.sampling import Every
from carom.gas.session import Session
from carom.gas.snapshot_sizes import MAX_BYTES
from carom.gas.snapshots import Snapshots
from carom.scene.toml import stored_model

__all__ = ["RunFiles", "SessionEnd", "run_with_files"]

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

    def between(*_progress: Any) -> None:
        progress(session)
        checkpoints.save_if_due()

    try:
        finished, early = session.run_until_early(
            stop=stop, progress=between, every=files.every, snapshot=None if frames is None else frames.write
        )
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
