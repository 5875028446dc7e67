"""tailuge/billiards: filmed shots as JSON, a list of shots with t, x, y of each ball, or one with the samples that it is fitted to.

Lengths are in units of that game's table, 92.36 by 46.18 ball radii of 0.03275, from its centre; here that table is 2.84 m long.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.errors import FaultList
from carom.files import parse_json
from carom.tracks.formats.tables import Calibration, require_sizes
from carom.tracks.track import Track

PROGRAM = "tailuge/billiards"
UNIT = 2.84 / (92.36 * 0.03275)  # m
BEGINNING = 4000  # characters in which the names of the first shot stand
UNREADABLE = (KeyError, TypeError, ValueError, AttributeError, OverflowError)
NOTE = "lengths of tailuge's table, with balls of radius 0.03275, are read as those of a table of 2.84 m; `scale` overrides it"
Samples = dict[str, list[tuple[Any, Any, Any]]]


def matches(text: str) -> bool:
    """Return whether the text is JSON of shots with ``balls`` that have ``t``, or of one with ``truth`` beside ``sim``."""
    start = text.lstrip()[:BEGINNING]
    if start[:1] not in ("[", "{"):
        return False
    packed = "".join(start[:400].split())
    return ('"balls":{' in packed and '"t":[' in packed) or ('"sim"' in start and '"truth"' in text)


def read(name: str, text: str, calibration: Calibration) -> list[Track]:
    """Read one track per ball; each shot of a list is a group. Frames in which a ball rests are missing."""
    found = parse_json(f"{name}: {PROGRAM}", text)
    faults, tracks = FaultList(name), []
    scale = calibration.scale or UNIT
    notes = () if calibration.scale else (NOTE,)
    shots = found if isinstance(found, list) else [found]
    for number, shot in enumerate(shots):
        where = f"{PROGRAM}: shot {number}"
        try:
            samples = _samples(shot)
            names = {f"ball {key}": np.array(rows, dtype=float).reshape(-1, 3) for key, rows in samples.items()}
        except UNREADABLE as error:
            faults.add(
                where, f"balls, each with t, x and y, or truth with ball, t, x and y; missing or no number: {error}"
            )
            continue
        group = f"shot {shot.get('id', number)}" if len(shots) > 1 else ""
        for ball, rows in names.items():
            for axis, values in zip("txy", rows.T, strict=True):
                require_sizes(values, f"{where}: {ball}: {axis}", faults)
            place: NDArray[np.float64] = rows[:, 1:] * scale
            if calibration.down:
                place[:, 1] *= -1
            tracks.append(Track(ball, rows[:, 0], place, group=group, moving_only=True, notes=notes))
    faults.raise_if_any()
    return tracks


def _samples(shot: Any) -> Samples:
    """Return the rows t, x, y of each ball of a shot."""
    if "truth" in shot:
        found: Samples = {}
        for row in shot["truth"]:
            found.setdefault(str(row["ball"]), []).append((row["t"], row["x"], row["y"]))
        return found
    return {
        str(key): list(zip(one["t"], one["x"], one["y"], strict=True)) for key, one in shot["balls"].items()
    }  # fmt: skip
