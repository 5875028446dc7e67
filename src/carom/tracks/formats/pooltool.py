"""pooltool's recorded shots, a System or a MultiSystem as JSON or MessagePack: the path of each ball in steps of time, m."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from carom.files import parse_json
from carom.tracks.formats.pooltool_fields import Field
from carom.tracks.formats.tables import Calibration
from carom.tracks.track import Track

Array = NDArray[np.float64]
POCKETED = 4  # pooltool's number of that motion
CONTINUOUS, EVENTS = "history_cts", "history"
REMEDY = "call pooltool.continuize(system, dt=0.01, inplace=True) before system.save('shot.json')"


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
                raise field[CONTINUOUS].fault("the path of a ball in steps of time", "none, but events alone", REMEDY)
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
