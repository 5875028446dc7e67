"""The pass over a log as plain Python, with nothing compiled: for the first few, and for what compiled code does not take."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.core.jit.dual.dual_records import float_count, float_places
from carom.core.jit.objects import ObjectArray, as_objects
from carom.errors import CaromError
from carom.simulation.sensitivity.dual import Dual, derivative, value
from carom.simulation.sensitivity.lift import lifted
from carom.simulation.sensitivity.parameters import ARRAYS, Parameters
from carom.simulation.sensitivity.pass_kernels import PASSAGES, follow_log, state_at_time
from carom.simulation.sensitivity.passages import Motion, Passages, rows_at

__all__ = ["follow_interpreted", "seeded"]

Array = NDArray[np.float64]


class _Values:
    """A ball whose numbers are values."""

    def __init__(self, ball: Any) -> None:
        self._ball = ball

    def __getattr__(self, name: str) -> Any:
        """Return the value of a field."""
        one = getattr(self._ball, name)
        return [value(x) for x in one] if isinstance(one, list) else value(one)


def seeded(records: NDArray[np.void], slopes: list[dict[str, Any]]) -> Any:
    """Return objects for records, whose numbers have their derivatives: one dict of fields for each parameter."""
    objects = as_objects(np.array(records))
    for field in slopes[0]:
        all_of = np.stack([one[field] for one in slopes], axis=-1)
        for row, d in zip(objects, all_of, strict=True):
            if not d.any():
                continue
            old = getattr(row, field)
            new = (
                [Dual(x, g) if g.any() else x for x, g in zip(old, d, strict=True)]
                if isinstance(old, list)
                else Dual(old, d)
            )
            setattr(row, field, new)
    return objects


def _arrays(objects: Any, p: int) -> tuple[NDArray[np.void], Array]:
    """Return the values of passages (M,), and their derivatives (M, numbers, p)."""
    values, d = np.empty(len(objects), PASSAGES), np.zeros((len(objects), float_count(PASSAGES), p))
    for name, place in float_places(PASSAGES).items():
        for n, one in enumerate(objects):
            numbers = getattr(one, name)
            many = numbers if isinstance(numbers, list) else [numbers]
            values[name][n] = [value(x) for x in many] if isinstance(numbers, list) else value(numbers)
            d[n, place] = [derivative(x, p) for x in many]
    return values, d


def follow_interpreted(scene: Any, parameters: Parameters, log: NDArray[np.void]) -> tuple[Passages, int]:
    """Follow a log; return its passages, and -1 or the row of a graze.

    Raises CaromError for a law that calls what takes no dual numbers.
    """
    p, slopes, arrays = len(parameters), parameters.slopes, parameters.arrays
    world, features, balls = (seeded(getattr(arrays, name), [one[name] for one in slopes]) for name in ARRAYS)
    first = seeded(arrays.balls, [one["balls"] for one in slopes])
    walls, plain, rows = as_objects(arrays.features), ObjectArray(map(_Values, balls)), as_objects(log)
    out = as_objects(np.full(len(log), np.nan, PASSAGES))
    users = [law.kernel for law in scene.called_laws]
    with np.errstate(all="ignore"):
        try:
            graze = lifted(follow_log)(world[0], features, walls, balls, plain, rows, users, out)
        except TypeError as error:
            number = next(n for n, one in enumerate(out) if value(one.time) != value(one.time)) - len(balls)
            raise CaromError(
                f"sensitivity: events[{number}]: expected a wall's law made of + - * / and functions of math, got: {error}"
            ) from error

    def at(times: Array) -> Array:
        here, found = as_objects(np.array(arrays.balls)), np.zeros((len(times), len(arrays.balls), 9, p))
        for k, ball in enumerate(here):
            for i, row in enumerate(rows_at(log, k, times).tolist()):
                with np.errstate(all="ignore"):
                    lifted(state_at_time)(world[0], ball, first[k], out[row], rows[row].phase, float(times[i]))
                numbers = [x for name in Motion._fields for x in getattr(ball, name)]
                found[i, k] = [derivative(x, p) for x in numbers]
        return found

    values, derivatives = _arrays(out, p)
    return Passages(values, lambda: derivatives, at), int(graze)
