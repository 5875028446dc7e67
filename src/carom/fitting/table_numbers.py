"""A table at values of the numbers that a fit adjusts: its arrays, and their derivatives by these numbers.

Fits to whole tracks and to whole shots move it. A search of starts runs no scene again: the arrays of a table nearby follow from
the derivatives, which is exact for all numbers that end in the event loop's records linearly, and no two in a product.
"""

from __future__ import annotations

import functools
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.scene.scene import Scene
from carom.simulation.sensitivity.compiled import dual_users
from carom.simulation.sensitivity.parameters import Parameters
from carom.simulation.sensitivity.seeds import Column, linear_slopes
from carom.simulation.setup import SceneArrays, set_up

__all__ = ["MOVED", "SharedNumber", "TableNumbers", "affine_table"]

Array = NDArray[np.float64]
MOVED = ("world", "features")
STEP = 2.0**-10  # of a number's range, for differences that are exact but for rounding


class SharedNumber(NamedTuple):
    """A number of the table that all shots share: a column of a sensitivity."""

    name: str
    value: float
    low: float
    high: float
    scale: float
    """Of a usual change, for a search."""


@dataclass(frozen=True, eq=False)
class TableNumbers:
    """The table at values of its shared numbers."""

    shared: tuple[SharedNumber, ...]
    values: Array
    """(P,)"""
    scene: Scene
    """At the values at which the derivatives were taken."""
    arrays: SceneArrays
    parameters: Parameters | None
    """Of a sensitivity: columns, and their derivatives; None where no number is fitted."""

    @functools.cached_property
    def duals(self) -> NDArray[np.int64]:
        """Addresses of laws that are called by address, of dual numbers."""
        return dual_users(self.scene.called_laws)

    @property
    def slopes(self) -> dict[str, Array]:
        """Derivatives of world and features, packed for compiled code: (C, rows, numbers, LANES)."""
        return {} if self.parameters is None else self.parameters.packed

    @functools.cached_property
    def _moved(self) -> tuple[list[tuple[str, str, slice]], Array]:
        """Arrays and fields that the numbers change, each with its columns in the derivatives (P, M) of all."""
        fields: list[tuple[str, str, slice]] = []
        parts, first = [], 0
        slopes = [] if self.parameters is None else self.parameters.slopes
        for array in MOVED if slopes else ():
            for field, some in slopes[0][array].items():
                every = np.array([one[array].get(field, 0.0 * some) for one in slopes])
                if every.any():
                    flat = every.reshape(len(slopes), -1)
                    fields.append((array, field, slice(first, first + flat.shape[1])))
                    parts.append(flat)
                    first += flat.shape[1]
        return fields, np.concatenate(parts, axis=1) if parts else np.zeros((len(slopes), 0))

    @functools.cached_property
    def ends(self) -> tuple[Array, Array]:
        """Bounds (P,) of the numbers."""
        low, high = (np.array([getattr(one, end) for one in self.shared]) for end in ("low", "high"))
        return low, high

    def at_deviations(self, by: Array) -> Array:
        """Return the numbers (..., P) of shots for which they differ by so much, within their bounds."""
        return np.asarray(np.clip(self.values + by, *self.ends))

    def moved(self, by: Array) -> SceneArrays:
        """Return the arrays of a shot for which the numbers differ by so much (P,), or of N shots (N, P), the features of one after
        the other's; none at all: the table of all shots."""
        if not np.any(by):
            return self.arrays
        many = by.size // by.shape[-1]
        made = self.arrays._replace(
            world=np.tile(self.arrays.world, many), features=np.tile(self.arrays.features, many)
        )
        fields, slopes = self._moved
        change = (self.at_deviations(by) - self.values).reshape(many, -1) @ slopes
        for array, field, columns in fields:
            into = getattr(made, array)[field]
            into += change[:, columns].reshape(into.shape)
        return made

    def at(self, values: Array) -> TableNumbers:
        """Return the table at other values (P,), of arrays that are affine in the numbers (:func:`affine_table`)."""
        return replace(self, values=values, arrays=self.moved(values - self.values))


def affine_table(scene: Callable[[dict[str, float]], Scene], shared: tuple[SharedNumber, ...]) -> TableNumbers:
    """Return the table of a scene whose arrays are affine functions of numbers, at their values."""
    start = {one.name: one.value for one in shared}
    made = scene(start)
    arrays, slopes = set_up(made), []
    for one in shared:

        def shifted(by: float, name: str = one.name) -> SceneArrays:
            return set_up(scene({**start, name: start[name] + by}), compiled=False)

        found = linear_slopes(arrays, shifted, one.value, STEP * min(one.high - one.low, 1.0))
        assert found is not None, f"{one.name}: the arrays of a scene are not linear in it"
        slopes.append(found)
    columns = [Column(name, name, None, (value,)) for name, value in start.items()]
    parameters = Parameters(arrays, tuple(start), columns, slopes) if shared else None
    return TableNumbers(shared, np.array([*start.values()]), made, arrays, parameters)
