"""Snapshots of ``carom gas``: how large they may become."""

from __future__ import annotations

import contextlib
import sys
from pathlib import Path
from typing import TYPE_CHECKING

import typer

from carom.cli.common import of_option
from carom.errors import CaromError
from carom.formatting import format_bytes

if TYPE_CHECKING:
    from carom.cli.gas_output import Progress
    from carom.gas.sampling import Every
    from carom.gas.scene import GasScene

__all__ = ["allowed_size", "size_limit"]

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


def allowed_size(path: Path, scene: GasScene, every: Every | None, most: float | None, progress: Progress) -> float:
    """Return how many bytes of snapshots may be written. CaromError where more are expected, and nobody can be asked or agrees."""
    from carom.gas.snapshot_sizes import MAX_BYTES, expected_snapshots, require_size

    assert every is not None
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
