"""pooltool 0.6's files as plain values, JSON or MessagePack; and their fields, each validated where it is taken."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.errors import CaromError, did_you_mean
from carom.files import MOST_TABLE, import_optional, parse_json, read_regular
from carom.tracks.formats.tables import Calibration
from carom.tracks.track import Track

Array = NDArray[np.float64]
ENDINGS = (".json", ".msgpack")
REMEDY = "save the shot again with pooltool 0.6"
# What arrays in MessagePack may be made of; anything else (objects, which would be unpickled) is refused.
NUMBERS = ("<f8", "<f4", "<i8", "<i4", "|b1")


class Field:
    """A value in a file, and where it stands, for messages such as ``shot.json: cue.V0: expected ...``."""

    def __init__(self, value: Any, file: str, place: str = "") -> None:
        self.value, self.file, self.place = value, file, place

    def fault(self, expected: str, got: str | None = None, remedy: str = REMEDY) -> CaromError:
        """Return the error of this field."""
        shown = repr(self.value) if got is None else got
        shown = " ".join(shown.split())
        shown = shown if len(shown) <= 60 else shown[:57] + "..."
        where = f"{self.file}: {self.place}" if self.place else self.file
        return CaromError(f"{where}: expected {expected}, got {shown}; {remedy}")

    def __getitem__(self, key: str | int) -> Field:
        """Return a field of this one; CaromError if it has none of that name."""
        place = f"{self.place}.{key}" if self.place else str(key)
        if isinstance(key, str):
            fields = self.fields()
            if key not in fields:
                remedy = did_you_mean(key, fields)
                raise Field(None, self.file, place).fault(
                    "a field of this name, as in files of pooltool 0.6", "none", remedy or REMEDY
                )
            return Field(fields[key], self.file, place)
        return Field(self.items()[key], self.file, place)

    def __contains__(self, key: str) -> bool:
        """Return whether a table has a field of that name."""
        return key in self.fields()

    def fields(self) -> dict[str, Any]:
        """Return a table of fields."""
        if not isinstance(self.value, dict):
            raise self.fault("a table of fields")
        return self.value

    def parts(self) -> dict[str, Field]:
        """Return the fields of a table, by name."""
        return {str(key): self[key] for key in self.fields()}

    def items(self) -> list[Any]:
        """Return a list."""
        if not isinstance(self.value, list | tuple):
            raise self.fault("a list")
        return list(self.value)

    def each(self) -> list[Field]:
        """Return the items of a list."""
        return [self[i] for i in range(len(self.items()))]

    def text(self) -> str:
        """Return a text."""
        if not isinstance(self.value, str):
            raise self.fault("text")
        return self.value

    def number(self) -> float:
        """Return a finite number."""
        x = self.value
        if isinstance(x, bool) or not isinstance(x, int | float | np.number) or not math.isfinite(x):
            raise self.fault("a finite number")
        return float(x)

    def array(self, *shape: int) -> Array:
        """Return an array of finite numbers; -1 in the shape is any length."""
        try:
            found = np.array(self.value, dtype=float)
        except (TypeError, ValueError):
            found = np.array(np.nan)
        same = found.ndim == len(shape) and all(n in (-1, m) for n, m in zip(shape, found.shape, strict=True))
        if not (same and np.isfinite(found).all()):
            size = " by ".join("n" if n < 0 else str(n) for n in shape)
            raise self.fault(f"{size} finite numbers")
        return found


def open_file(path: Path) -> Field:
    """Return the content of a file. CaromError, one line, for what is no file of pooltool's, and for damage."""
    if path.suffix.lower() not in ENDINGS:
        raise CaromError(
            f"{path}: expected a file of pooltool's, with a name that ends with .json or .msgpack, got"
            f" {path.suffix or 'none'!r}; save the shot with system.save('shot.json')"
        )
    data = read_regular(path, "a file of pooltool's", MOST_TABLE, "check the name")
    if path.suffix.lower() == ".msgpack":
        return Field(_unpacked(path, data), str(path))
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        got = f"byte {error.object[error.start]:#04x}"
        raise CaromError(f"{path}: expected JSON, text in UTF-8, got {got}; a binary file ends with .msgpack") from None
    return Field(parse_json(path, text), str(path))


def _unpacked(path: Path, data: bytes) -> Any:
    msgpack = import_optional("msgpack", str(path))
    try:
        return msgpack.unpackb(data, object_hook=_decoded)
    except Exception as error:  # msgpack's errors have no common class
        got = " ".join(str(error).split())[:60] or type(error).__name__
        raise CaromError(
            f"{path}: expected a whole MessagePack file, got one that ends or errs: {got}; {REMEDY}"
        ) from None


def _decoded(table: dict[Any, Any]) -> Any:
    """Return the array or number that msgpack-numpy has written as a table; any other table as it is."""
    if b"nd" not in table:
        return table
    kind = table[b"type"]
    if kind not in NUMBERS:
        raise ValueError(f"an array of {kind!r}")
    found = np.frombuffer(table[b"data"], dtype=np.dtype(kind))
    return found.reshape(table[b"shape"]) if table[b"nd"] else found[0].item()


# ----------------------------------------------------------------------------------------------------
# pooltool's recorded shots, a System or a MultiSystem as JSON or MessagePack: the path of each ball in steps of time, m.


POCKETED = 4  # pooltool's number of that motion
CONTINUOUS, EVENTS = "history_cts", "history"
CONTINUIZE = "call pooltool.continuize(system, dt=0.01, inplace=True) before system.save('shot.json')"


def matches(text: str) -> bool:
    """Return whether the text is JSON in which balls have histories of pooltool's."""
    return text.lstrip()[:1] == "{" and f'"{CONTINUOUS}"' in text


def read(name: str, text: str, calibration: Calibration) -> list[Track]:
    """Read the tracks of a file in JSON."""
    return tracks_of(Field(parse_json(f"{name}: pooltool", text), name), calibration)


def tracks_of(file: Field, calibration: Calibration) -> list[Track]:
    """Return one track per ball; each shot of a MultiSystem is a group. A ball in a pocket is seen no more."""
    several = "multisystem" in file
    shots = file["multisystem"].each() if several else [file]
    tracks = []
    for number, shot in enumerate(shots):
        for ball, field in shot["balls"].parts().items():
            found = recorded(field[CONTINUOUS])
            if found is None:
                raise field[CONTINUOUS].fault(
                    "the path of a ball in steps of time", "none, but events alone", CONTINUIZE
                )
            path, motion = found
            position = np.where((motion == POCKETED)[:, None], np.nan, path[:, 1:3] * (calibration.scale or 1.0))
            tracks.append(Track(f"ball {ball}", path[:, 0], position, group=f"shot {number}" if several else ""))
    return tracks


def recorded(history: Field) -> tuple[Array, Array] | None:
    """Return the times and places (n, 4), s and m, of a history, and pooltool's numbers of motions (n,); None if it is empty."""
    if history.value is None:  # (an empty one in MessagePack)
        return None
    if isinstance(history.value, list | tuple):  # arrays of all states, motions and times
        rvw, motion, t = history.each()[:3]
        times = t.array(-1)
        return np.column_stack([times, rvw.array(len(times), 3, 3)[:, 0]]), motion.array(len(times))
    states = history["states"].each()
    if not states:
        return None
    path = np.array([[state["t"].number(), *state["rvw"].array(3, 3)[0]] for state in states])
    return path, np.array([state["s"].number() for state in states])
