"""Checks of the arguments that tables are made from: lengths, accelerations, bounds, room for the ball."""

from __future__ import annotations

import math
from typing import Any, Literal

import numpy as np

from carom.errors import CaromError, Fault, FaultList, checked_number, float_array, suggestion

Bounds = Literal["centre", "surface"]
BOUNDS = ("centre", "surface")


def positive_number(faults: FaultList, field: str, value: Any, most: float = math.inf) -> float:
    """Return a length > 0 (or a number > 0 and < ``most``); add a fault for anything else."""
    what = "a length > 0" if most == math.inf else f"a number > 0 and < {most:.6g}"
    found = checked_number(faults, field, value, what, lambda x: (x > 0) & (x < most))
    if isinstance(found, float):
        return found
    faults.add(field, "one number", repr(value))
    return 1.0


def checked_acceleration(faults: FaultList, value: Any, count: int = 1) -> tuple[float, ...]:
    """Return ``count`` components of an acceleration; add a fault for anything else."""
    try:
        array = np.atleast_1d(float_array(value))
    except (TypeError, ValueError):
        array = np.full(1, np.nan)
    if array.shape != (count,) or not np.isfinite(array).all():
        faults.add("acceleration", "a number" if count == 1 else f"{count} numbers", repr(value))
        return (0.0,) * count
    return tuple(float(x) for x in array)


def require_bounds(faults: FaultList, bounds: str) -> None:
    """Add a fault where ``bounds`` is neither "centre" nor "surface"."""
    if bounds not in BOUNDS:
        faults.add("bounds", "'centre' or 'surface'", f"{bounds!r}; {suggestion(str(bounds), list(BOUNDS))}")


def require_room(name: str, left: float, what: str, inset: float) -> None:
    """Raise CaromError where a ball does not fit."""
    if not left > 0:
        raise CaromError(
            Fault(f"{name}", "radius of the ball", f"one that fits {what}", repr(inset), "take a smaller ball")
        )


def ball_too_large(name: str, inset: float) -> CaromError:
    """Return the refusal of a ball that does not touch all of a wall."""
    expected = (
        "one that touches all of the wall, smaller than its necks and radii of curvature, and without corners in curves"
    )
    return CaromError(
        Fault(name, "radius of the ball", expected, repr(inset), "take a smaller ball, or bounds = 'centre'")
    )
