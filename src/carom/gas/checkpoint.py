"""Checkpoints: a gas on its way, in one file, whole or as it was before.

An NPZ file: NumPy's arrays, bit by bit, in a ZIP archive, whose checksums tell of every change. It is written beside, brought
to the disk, and then takes the place of the one before; so a full disk, or a run that is killed while it writes, leaves that
one as it is.
"""

from __future__ import annotations

import json
import os
import zipfile
from collections.abc import Callable
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np
from pydantic import ValidationError

from carom.errors import CaromError
from carom.files import path_of
from carom.gas.model import GasScene
from carom.gas.session import Session
from carom.scene.faults import told

__all__ = ["FORMAT", "load_checkpoint", "require_checkpoint", "save_checkpoint"]

FORMAT = 4
# How long it is measured may change: the run then goes on for longer.
FREE = ("max_events", "duration")


def save_checkpoint(session: Session, path: str | Path) -> None:
    """Write where a session is. CaromError where the file cannot be written; the one before then stays as it is."""
    path = path_of("save_checkpoint", path)
    about = {"format": FORMAT, "carom": version("carom"), "scene": session.scene.model_dump(mode="json")}
    part = path.with_name(f".{path.name}.part")
    try:
        with part.open("wb") as file:
            np.savez(file, allow_pickle=False, carom_checkpoint=np.array(json.dumps(about)), **session.state())
            file.flush()
            os.fsync(file.fileno())
        os.replace(part, path)
    except OSError as error:
        part.unlink(missing_ok=True)
        raise CaromError(f"{path}: expected room for a checkpoint, got: {error.strerror or error}") from None


def require_checkpoint(path: Path) -> None:
    """CaromError where a checkpoint would take the place of a file that is none."""
    try:
        is_none = path.exists() and not zipfile.is_zipfile(path)
    except OSError as error:
        raise CaromError(f"{path}: expected a checkpoint to write over, got: {error.strerror}") from None
    if is_none:
        raise CaromError(f"{path}: expected a checkpoint or a new file, got another file that is there; name a new one")


def load_checkpoint(
    path: str | Path, scene: GasScene | None = None, *, compiling: Callable[[], None] | None = None
) -> Session:
    """The session of a checkpoint, to go on with the same bits.

    ``scene`` has to be the one of the checkpoint, but for ``max_events`` and ``duration``: with larger ones the run goes on
    for longer; left out, it is the checkpoint's own. ``compiling`` is called when the file is known to be right, before
    the loop that goes on with it is compiled. Raises CaromError, one line, for a file that is missing, not whole, no
    checkpoint, of a newer carom, or of another scene.
    """
    path = path_of("load_checkpoint", path)
    about, state = _read(path)
    if about["format"] != FORMAT:
        raise CaromError(
            f"{path}: expected a checkpoint of format {FORMAT}, got format {about['format']} of carom {about['carom']};"
            " go on with that one"
        )
    try:
        own = GasScene.model_validate(about["scene"])
    except ValidationError as error:
        raise CaromError(*told(f"{path}: scene", error, GasScene)) from None
    if scene is not None and (other := _difference(_fixed(own), _fixed(scene))) is not None:
        field, was, now = other
        raise CaromError(
            f"{path}: expected a checkpoint of this scene, got one of another: its {field} is {was}, here it is {now};"
            " only run.max_events and run.duration may change"
        )
    try:
        return Session.restore(own if scene is None else scene, state, compiling)
    except (KeyError, ValueError, IndexError, TypeError) as error:
        raise CaromError(
            f"{path}: expected a checkpoint of this carom, got one of carom {about['carom']} that it cannot go on with"
            f" ({error}); begin anew, or go on with that one"
        ) from None


def _read(path: Path) -> tuple[dict[str, Any], dict[str, Any]]:
    try:
        raw = path.open("rb")
    except OSError as error:
        raise CaromError(f"{path}: expected a checkpoint, got: {error.strerror}") from None
    try:
        with raw:
            file = np.load(raw, allow_pickle=False)
            if not isinstance(file, np.lib.npyio.NpzFile) or "carom_checkpoint" not in file:
                raise CaromError(f"{path}: expected a checkpoint of carom gas, got another file")
            arrays = dict(file)
        about = json.loads(str(arrays.pop("carom_checkpoint")))
        if not isinstance(about["format"], int):
            raise ValueError("no format")
    except CaromError:
        raise
    except Exception as error:  # what is not whole shows in many classes: zipfile's, zlib's, NumPy's, JSON's
        said = str(error).splitlines()[0] if str(error) else type(error).__name__
        if "pickle" in said:  # NumPy's word for what is none of its files, with a remedy that would be unsafe
            said = "not a file of NumPy"
        raise CaromError(
            f"{path}: expected a whole checkpoint of carom gas, got a file that cannot be read ({said})"
        ) from None
    return about, arrays


def _fixed(scene: GasScene) -> dict[str, Any]:
    """What of a scene a checkpoint holds to, as plain values. A start's file counts by its name."""
    table = scene.model_dump(mode="json")
    table["run"] = {name: value for name, value in table["run"].items() if name not in FREE}
    table["run"]["start"] = Path(table["run"]["start"]).name
    table["run"]["equilibrate"] = scene.equilibrate
    return table


def _difference(one: Any, two: Any, at: str = "") -> tuple[str, Any, Any] | None:
    """The first place where two tables differ: its name, and both values."""
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
    return None if one == two else (at, _told(one), _told(two))


def _told(value: Any) -> str:
    if isinstance(value, list):
        return f"{len(value)} of them" if value and isinstance(value[0], dict) else str(value)
    return "left out" if value is None else str(value)
