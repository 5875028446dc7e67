"""Track files that a command reads together: all of their faults at once, and notes that say whose they are."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from carom.cli.common import attempt
from carom.errors import CaromError

if TYPE_CHECKING:
    from carom.tracks.formats.text_table import Calibration
    from carom.tracks.read import TrackFile

__all__ = ["notes_by_film", "read_files"]


def read_files(files: Sequence[Path], calibration: Calibration, format_: str | None = None) -> list[TrackFile]:
    """Return what the files hold. CaromError with the faults of all."""
    from carom.tracks.read import read_tracks

    faults: list[str] = []
    found = [attempt(faults, read_tracks, file, format_, calibration) for file in files]
    if faults:
        raise CaromError(*faults)
    return found


def notes_by_film(files: Sequence[Path], notes: Sequence[Sequence[str]]) -> list[str]:
    """Return the notes of each file, beginning with its name where there are several files."""
    from carom.tracks.films import film_names

    names = [f"{name}: " if len(files) > 1 else "" for name in film_names(files)]
    return [start + note for start, own in zip(names, notes, strict=True) for note in own]
