"""Snapshots of ``carom gas``: how large they may become, and the file that is written frame by frame."""

from __future__ import annotations

import contextlib
import sys
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

import typer

from carom.cli.common import of_option
from carom.errors import CaromError, FaultList
from carom.formatting import format_bytes

if TYPE_CHECKING:
    from carom.cli.gas_output import Progress
    from carom.gas.sampling import Every
    from carom.gas.scene import GasScene
    from carom.gas.session import Session
    from carom.gas.snapshots import Snapshots

__all__ = ["Frames", "open_frames", "size_limit"]

UNITS = {"": 1.0, "B": 1.0, "KB": 1e3, "MB": 1e6, "GB": 1e9, "TB": 1e12}
SAID_FROM = 1e8  # bytes: smaller files need no word


def size_limit(text: str | None) -> float | None:
    """Return a size in bytes, such as "20 GB", as a number."""
    if text is None:
        return None
    words = text.strip().upper()
    number = words.rstrip("BKMGT ")
    with contextlib.suppress(ValueError, KeyError):
        if (size := float(number) * UNITS[words[len(number) :].strip()]) > 0:
            return size
    raise CaromError(f"--max-size: expected a size > 0, such as '20 GB' or '500 MB', got {text!r}")


def _allowed_size(path: Path, scene: GasScene, every: Every, most: float | None, progress: Progress) -> float:
    """Return how many bytes of snapshots may be written. CaromError where more are expected, and nobody can be asked or agrees."""
    from carom.gas.snapshot_sizes import MAX_BYTES, expected_snapshots, require_size

    size = expected_snapshots(scene, every)
    limit = MAX_BYTES if most is None else most
    if size.total >= SAID_FROM:
        progress.say(f"snapshots: {size.describe(scene.count)}")
    try:
        require_size(path, size, scene.count, limit)
    except CaromError as error:
        asked = most is None and size.total > limit and progress.console.is_terminal and sys.stdin.isatty()
        if not asked or not typer.confirm(f"Write {format_bytes(size.total)} of snapshots to {path}?", err=True):
            raise CaromError(*(of_option("--snapshots", fault) for fault in error.records)) from None
        require_size(path, size, scene.count, size.total)  # (the disk still needs room)
        return float("inf")
    return limit


class Frames:
    """Writes snapshots; where that fails, the run continues without them, and the fault is printed again at its end."""

    def __init__(
        self, path: Path, session: Session, resumed: bool, found: FaultList, progress: Progress, most: float
    ) -> None:
        from carom.gas.snapshots import Snapshots

        self.taken = session.snapshots_taken if resumed else 0
        self.file: Snapshots | None = Snapshots(path, session.names, self.taken or None, max_bytes=most)
        self.found, self.progress, self.failed = found, progress, False

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
            self.found += error.records
            self.progress.say(f"carom: {'; '.join(error.faults)}; the run continues without snapshots")
            return False
        return True


def open_frames(
    path: Path,
    session: Session,
    resumed: bool,
    every: Every,
    most: float | None,
    found: FaultList,
    progress: Progress,
) -> Frames:
    """Return the file of a session's snapshots, unless they would be larger than is wanted or than the disk has room for."""
    limit = _allowed_size(path, session.scene, every, most, progress)
    return Frames(path, session, resumed, found, progress, limit)
