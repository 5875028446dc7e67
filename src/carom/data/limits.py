"""Admissible ranges of the numbers of a table of incoming states, and of the options that stand in for its columns."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from carom.errors import MAX_MAGNITUDE, MIN_MAGNITUDE, FaultList


def _within(low: float, high: float) -> Callable[[Any], Any]:
    return lambda x: (x >= low) & (x <= high)


def _positive(x: Any) -> Any:
    return (x >= MIN_MAGNITUDE) & (x <= MAX_MAGNITUDE)


def _friction(x: Any) -> Any:
    return (x >= 0) & ((x <= MAX_MAGNITUDE) | (x == math.inf))


FINITE = (_within(-MAX_MAGNITUDE, MAX_MAGNITUDE), "a finite number")
# In SI; any other column may hold any finite number.
CHECKS: dict[str, tuple[Callable[[Any], Any], str]] = {
    "radius": (_positive, "a length above 0"),
    "mass": (_positive, "a mass above 0"),
    "kappa": (lambda x: (x > 0) & (x <= 2 / 3 * (1 + 1e-12)), "kappa = I/(m a^2) in (0, 2/3]"),
    "restitution": (_within(0, 1), "a number from 0 to 1"),
    "friction": (_friction, "a number >= 0, or inf"),
    "tangential_restitution": (_within(-1, 1), "a number from -1 to 1"),
    "floor_restitution": (_within(0, 1), "a number from 0 to 1"),
    "floor_friction": (_friction, "a number >= 0, or inf"),
    "floor_tangential_restitution": (_within(-1, 1), "a number from -1 to 1"),
    "height": (_within(0, MAX_MAGNITUDE), "a length >= 0"),
    "stiffness_ratio": (_positive, "a number above 0"),
    "speed": (_within(0, MAX_MAGNITUDE), "a speed >= 0"),
    "incidence": (_within(-math.pi / 2, math.pi / 2), "an angle from the normal, -90 to 90 degrees"),
}


def bad_numbers(
    numbers: dict[str, float], normal: tuple[float, float, float] | None, contact_height: float, gravity: float
) -> FaultList:
    """Return a fault for each argument whose number (SI) is out of range."""
    faults = FaultList()
    for name, value in numbers.items():
        holds, expected = CHECKS.get(name, FINITE)
        if not holds(np.asarray(value)):
            faults.add(f"`{'inertia' if name == 'kappa' else name}`", expected, f"{value!r}")
    if normal is not None and not 0 < math.sqrt(sum(x * x for x in normal)) < math.inf:
        faults.add("`normal`", "a vector from the wall to the ball, such as 1,0,0", f"{normal}")
    if not 0 < contact_height < 2:
        faults.add("`contact_height`", "a height in radii, above 0 and below 2", f"{contact_height!r}")
    if not 0 <= gravity < math.inf:
        faults.add("`gravity`", "a number >= 0 in m/s^2", f"{gravity!r}")
    return faults
