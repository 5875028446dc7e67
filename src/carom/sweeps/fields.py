"""Sweeps over a model whose numbers are all of one level, or lie in its parts: paths, units, values made whole."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.errors import CaromError, Fault, FaultList, did_you_mean, shown
from carom.scene.schema import Model
from carom.scene.toml import PathMatch, overlapping_paths, path_match, replaced
from carom.sweeps.axes import Axis, Design, Draw, Polar, Values
from carom.sweeps.draws import polar_rows

UNITS = {
    "velocity": "m/s", "speed": "m/s", "spin": "rad/s", "spin_x": "rad/s", "spin_y": "rad/s", "spin_z": "rad/s", "position": "m",
    "radius": "m", "ball_radius": "m", "mass": "kg", "azimuth": "degree", "elevation": "degree", "angle": "degree",
    "gravity": "m/s^2", "acceleration": "m/s^2", "duration": "s", "length": "m", "width": "m", "nose_height": "m", "height": "m",
    "depth": "m", "distance": "m", "period": "m", "side": "m", "straight": "m", "half_axes": "m", "points": "m", "point": "m",
    "size": "m", "vertical_speed": "m/s", "temperature": "J",
}  # fmt: skip


def unit_of(path: str) -> str:
    """Return the unit of a number by the last name of its path; "1" where it has none."""
    names = [name for name in path.split(".") if name not in ("x", "y", "z", "*") and not name.isdecimal()]
    return UNITS.get(names[-1], "1") if names else "1"


def check_paths(model: Model, parameters: Mapping[str, Axis]) -> None:
    """Raise CaromError for paths that lead nowhere or overlap, and for values that the model refuses wherever they stand."""
    found = FaultList("Space")
    matches = []
    for path, axis in parameters.items():
        try:
            match = path_match(model, path, "Space")
            matches.append(match)
            for value in ends_of(axis):
                replaced(model, {path: value})
            _require_kind(model, match, axis)
        except CaromError as error:
            fault = error.records[0]
            found.append(fault if fault.where == "Space" else Fault("Space", path, advice=str(fault)))
    for one, two in overlapping_paths(matches):
        found.add(f"{one} and {two}", "parameters of different numbers", "two of the same", "leave one out")
    found.raise_if_any()


def ends_of(axis: Axis) -> list[Any]:
    """Return the values of an axis that a model has to take: the ends of numbers, all names."""
    if not isinstance(axis, Values) or axis.values.ndim > 1:
        return []
    if axis.values.dtype.kind == "U":
        return [axis.named(text) for text in dict.fromkeys(axis.values.tolist())]
    return [plain_value(axis.values.min()), plain_value(axis.values.max())]


def _require_kind(model: Model, match: PathMatch, axis: Axis) -> None:
    """Raise CaromError for numbers where a vector stands, vectors where a number stands, and other things that no point can have.

    A model may refuse some of the points (a ball in a wall), which then have no outcome: a value of the right kind is asked about
    only if it may be the only one.
    """
    vectors = isinstance(axis, Polar) or (isinstance(axis, Values) and axis.values.ndim > 1)
    if isinstance(axis, Values) and not vectors:
        return  # (its ends were taken)
    stands, fault = match.values[0], None
    same = isinstance(stands, tuple) and _is_number(stands[:1]) if vectors else _is_number((stands,))
    for value in _some_of(axis):
        try:
            replaced(model, {match.path: value})
        except CaromError as error:
            fault = fault or error
        else:
            return
    if fault is not None and not same:
        raise fault


def _is_number(values: tuple[Any, ...]) -> bool:
    return any(isinstance(one, int | float) and not isinstance(one, bool) for one in values)


def _some_of(axis: Axis) -> list[Any]:
    """Return a few of the values of an axis, of draws the middle and the ends."""
    match axis:
        case Polar():
            sizes, angles = (np.array(_some_of(part), dtype=float) for part in (axis.speed, axis.angle_deg))
            return [row.tolist() for angle in angles for row in polar_rows(sizes, np.full(len(sizes), angle))]
        case Draw("normal"):
            return [axis.first, axis.first - axis.second, axis.first + axis.second]
        case Draw():
            return [(axis.first + axis.second) / 2, axis.first, axis.second]
        case Design():
            return [(axis.low + axis.high) / 2, axis.low, axis.high]
    places = np.unique(np.linspace(0, len(axis.values) - 1, 3).astype(int))
    return [plain_value(axis.values[k]) for k in places]


def plain_value(value: Any) -> Any:
    """Return one value as Python's own."""
    return value.tolist() if isinstance(value, np.generic | np.ndarray) else value  # (a text in a column is Python's)


# ----------------------------------------------------------------------------------------------------
# Outcomes of a point of a sweep: names, shapes, types, units; and why a point has no outcome.


AXES = ("x", "y", "z")
FAILED = "failed"
# Codes of the variable ``failed``.
FAILURES = (
    "no", "law_needs_a_rolling_ball", "law_undefined_for_pressed_ball", "ball_locked", "refused", "lost_in_air", "endless_in_air",
)  # fmt: skip
NOT_DONE = -1  # of a point that was not computed yet


@dataclass(frozen=True)
class Outcome:
    """One variable of a sweep's result.

    ``dims`` are its dimensions in addition to the space's, with the labels of their places.
    """

    name: str
    dtype: str = "f8"
    dims: dict[str, tuple[Any, ...]] = field(default_factory=dict)
    units: str = "1"
    meanings: tuple[str, ...] = ()
    """Meanings of its whole numbers, from 0 on; -1 stands for a point without an outcome."""

    @property
    def shape(self) -> tuple[int, ...]:
        """Sizes of its own dimensions."""
        return tuple(len(labels) for labels in self.dims.values())

    @property
    def fill(self) -> float:
        """Value of a point that has no outcome."""
        return float("nan") if self.dtype.startswith("f") else -1

    @property
    def bounds(self) -> tuple[float, float]:
        """Least and greatest value that it can have; NaN stands for none."""
        if self.dtype.startswith("f"):
            return (0.0, np.finfo(float).max) if self.units == "s" else (-np.inf, np.inf)
        return -1, len(self.meanings) - 1 if self.meanings else np.inf

    def impossible(self, values: NDArray[Any]) -> NDArray[np.bool_]:
        """Return which values it cannot have."""
        low, high = self.bounds
        return np.asarray((values < low) | (values > high))


WHY = Outcome(FAILED, "i1", meanings=FAILURES)


def blank(outcome: Outcome, count: int) -> NDArray[Any]:
    """Return an array of ``count`` points without an outcome."""
    return np.full((count, *outcome.shape), outcome.fill, dtype=outcome.dtype)


def require_outcomes(names: tuple[str, ...], known: list[str]) -> None:
    """Raise CaromError, with the nearest name, for names that are not known."""
    for name in names:
        if name not in known:
            hint = did_you_mean(str(name), known)
            raise CaromError(Fault("sweep", "keep", f"names among {', '.join(known)}", shown(name, 60), hint))
