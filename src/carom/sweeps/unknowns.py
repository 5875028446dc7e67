"""The unknowns of a shot that is to reach a target: speed and direction of a ball, or how it is struck."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.core.geometry.angles import direction
from carom.errors import MAX_MAGNITUDE, FaultList, float_or_nan, shortened_list
from carom.scene.paths import path_match
from carom.scene.scene import Scene

__all__ = ["ERRORS", "Unknown", "columns_at", "slopes_at", "unknowns_of", "values_at"]

Array = NDArray[np.float64]
# Range in which a start is looked for, and a player's error (one standard deviation; of speeds, a share of them).
SPEED, ANGLE = (0.5, 6.0), (0.0, 360.0)
RANGES = {"speed": SPEED, "angle": ANGLE, "azimuth": ANGLE, "elevation": (0.0, 30.0), "side": (-0.5, 0.5), "top": (-0.5, 0.5),
          "spin_z": (-100.0, 100.0)}  # fmt: skip
ERRORS = {"speed": 0.03, "angle": 0.2, "azimuth": 0.2, "elevation": 0.5, "side": 0.02, "top": 0.02, "spin_z": 2.0}
UNITS = {
    "speed": "m/s",
    "angle": "°",
    "azimuth": "°",
    "elevation": "°",
    "side": "radii",
    "top": "radii",
    "spin_z": "rad/s",
}
# What each kind of path has for unknowns.
PARTS = {
    "velocity": ("speed", "angle"),
    "strike": ("speed", "azimuth"),
    "offset": ("side", "top"),
    **{name: (name,) for name in ("azimuth", "elevation", "spin_z")},
}
# Within what a range may lie.
LIMITS = {"speed": (0.0, MAX_MAGNITUDE), "elevation": (0.0, 90.0), "side": (-1.0, 1.0), "top": (-1.0, 1.0)}
WHERE = "aim: free"
EXPECTED = (
    "one ball's velocity, spin_z, strike, or strike.offset, .azimuth, .elevation, .speed, such as 'balls.0.velocity'"
)


class Unknown(NamedTuple):
    """One number of the start."""

    name: str
    path: str
    """Path of the number in the scene, or of the vector that contains it."""
    low: float
    high: float
    error: float
    """The player's: one standard deviation; of a speed, as a share of it."""

    @property
    def circular(self) -> bool:
        """Whether it is an angle that goes round."""
        return self.name in ("angle", "azimuth") and self.high - self.low >= 360

    @property
    def unit(self) -> str:
        """Its unit."""
        return UNITS[self.name]

    def sigma(self, x: Any) -> Any:
        """Return the player's error at a value."""
        return self.error * x if self.name == "speed" else self.error + 0 * x


def unknowns_of(
    scene: Scene, free: Sequence[str] | Mapping[str, tuple[float, float]], errors: Mapping[str, float]
) -> list[Unknown]:
    """Return the unknowns that paths stand for. CaromError for paths that are no part of a ball's start, all at once."""
    ranges = dict(free) if isinstance(free, Mapping) else {}
    found: list[Unknown] = []
    faults = FaultList("aim")
    _check_errors(faults, errors)
    if isinstance(free, bytes) or not isinstance(free, Iterable):
        faults.add("free", EXPECTED, f"{free!r:.60}")
        free = ()
    freed: dict[tuple[Any, str], str] = {}  # which path frees a number of a ball
    for path in [free] if isinstance(free, str) else free:
        if (match := faults.attempt(path_match, scene, path, WHERE)) is None:
            continue
        (keys, *others) = match.places
        last = keys[-1]
        whole = len(keys) == (4 if keys[2:3] == ("strike",) and last != "strike" else 3)
        speed = keys[2:] == ("strike", "speed")
        parts = ("speed",) if speed else PARTS.get(str(last), ()) if keys[0] == "balls" and whole and not others else ()
        if last == "strike" and getattr(scene.balls[int(keys[1])], "strike", None) is None:
            parts = ()
        if not parts:
            faults.add("free", EXPECTED, f"{path!r:.60}")
        if not scene.floor and "velocity" in keys:
            faults.add(f"free: {path}", "a scene with a floor", "one without", "free the ball's strike there")
        for part in parts:
            if (keys[1], part) in freed:
                faults.add("free", "each number once", f"{part} by {freed[keys[1], part]} and {path}")
                break
            freed[keys[1], part] = path
            given = ranges.get(path, RANGES[part]) if part not in ("angle", "azimuth") or len(parts) == 1 else ANGLE
            own = path if last != "strike" else f"{path}.{part}"
            least, most = LIMITS.get(part, (-math.inf, math.inf))
            low, high = _range(given)
            if not (low < high and least <= low and high <= most and (part != "speed" or low > 0)):
                span = "" if part not in LIMITS else " > 0" if part == "speed" else f" from {least:g} to {most:g}"
                faults.add(f"free: {path}", f"a range (low, high) of {part}{span}", f"{given!r:.60}")
                continue
            found.append(Unknown(part, own, low, high, errors.get(part, ERRORS[part]) if not faults else 0.0))
    if not found and not faults:
        faults.add("free", "paths such as ['balls.0.velocity']", "none")
    faults.raise_if_any()
    return found


def _check_errors(faults: FaultList, errors: Any) -> None:
    """Add the faults of the player's errors."""
    known = shortened_list(list(ERRORS))
    if not isinstance(errors, Mapping):
        faults.add("errors", f"a mapping of {known} to numbers", f"{errors!r:.60}")
        return
    for name, value in errors.items():
        if name not in ERRORS:
            faults.add("errors", f"names of {known}", f"{name!r:.60}")
        elif isinstance(value, bool) or not 0 <= float_or_nan(value) <= MAX_MAGNITUDE:
            faults.add(f"errors: {name}", "a number >= 0", f"{value!r:.60}")


def _range(given: Any) -> tuple[float, float]:
    """Return low and high of a range; NaN where it is not one."""
    pair = tuple(given) if isinstance(given, Iterable) and not isinstance(given, str) else ()
    low, high = (
        (math.nan if isinstance(x, bool) else float_or_nan(x) for x in pair) if len(pair) == 2 else (math.nan,) * 2
    )
    return (low, high) if max(abs(low), abs(high)) <= MAX_MAGNITUDE else (math.nan, math.nan)


def _polar(unknowns: Sequence[Unknown]) -> list[tuple[int, int]]:
    """Return where speed and angle of velocities stand."""
    return [
        (k, k + 1)
        for k, one in enumerate(unknowns)
        if one.name == "speed" and k + 1 < len(unknowns) and unknowns[k + 1].name == "angle"
    ]


def columns_at(unknowns: Sequence[Unknown], x: Array) -> dict[str, Array]:
    """Return the columns (N,) or (N, k) of the paths, for unknowns (N, U)."""
    found: dict[str, Array] = {}
    for s, a in _polar(unknowns):
        turned = np.array([direction(float(angle)) for angle in x[:, a]])
        found[unknowns[s].path] = np.stack([x[:, s] * turned[:, 0], x[:, s] * turned[:, 1], 0 * x[:, s]], axis=1)
    for k, one in enumerate(unknowns):
        if one.path in found:
            continue
        if one.name == "side":
            found[one.path] = x[:, k : k + 2]
        else:
            found[one.path] = x[:, k]
    return found


def values_at(unknowns: Sequence[Unknown], x: Array) -> dict[str, Any]:
    """Return the scene's numbers by path, for one point (U,)."""
    return {
        path: tuple(column[0].tolist()) if column.ndim > 1 else float(column[0])
        for path, column in columns_at(unknowns, x[None, :]).items()
    }


def slopes_at(unknowns: Sequence[Unknown], x: Array, columns: Sequence[str]) -> Array:
    """Return the derivatives (p, U) of the parameters of a sensitivity, by their names, with respect to the unknowns."""
    place = {name: i for i, name in enumerate(columns)}
    found = np.zeros((len(columns), len(unknowns)))
    for s, a in _polar(unknowns):
        c, d = direction(float(x[a]))
        path = unknowns[s].path
        found[place[f"{path}.x"], [s, a]] = c, -x[s] * d * math.pi / 180
        found[place[f"{path}.y"], [s, a]] = d, x[s] * c * math.pi / 180
    for k, one in enumerate(unknowns):
        name = {"side": f"{one.path}.x", "top": f"{one.path}.y"}.get(one.name, one.path)
        if name in place:
            found[place[name], k] = 1.0
    return found
