"""The arrays of a law's scene as functions of its parameters, and their derivatives.

Every parameter ends in the event loop's records as it is, or linearly, and no two in a product. So the arrays are affine in the
parameters, and while a fit runs no scene is made: that took a third of its time.
"""

from __future__ import annotations

import functools
from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.core.jit.dual.dual_records import float_count
from carom.core.jit.dual.numbers import LANES
from carom.fitting.parameters import Parameter
from carom.scene.scene import Scene
from carom.simulation.sensitivity.compiled import dual_users
from carom.simulation.sensitivity.parameters import packed
from carom.simulation.sensitivity.seeds import Tangents, linear_slopes
from carom.simulation.setup import SceneArrays, set_up

__all__ = ["AffineArrays", "Table"]

Array = NDArray[np.float64]
MOVED = ("world", "features")
STEP = 2.0**-10  # of a parameter's range, for differences that are exact but for rounding


class Table(NamedTuple):
    """The arrays of a table with a ball at values of the parameters, and the family that they belong to."""

    setup: SceneArrays
    family: AffineArrays


class AffineArrays:
    """Arrays of records as affine functions of P parameters."""

    def __init__(self, scene: Callable[[Mapping[str, float]], Scene], free: Mapping[str, Parameter]) -> None:
        self._scene = scene
        self.start = {name: one.value for name, one in free.items()}
        self.setup = set_up(scene(self.start))
        self.slopes: dict[str, Tangents] = {}
        here = set_up(scene(self.start), compiled=False)
        for name, one in free.items():

            def shifted(by: float, name: str = name) -> SceneArrays:
                return set_up(scene({**self.start, name: self.start[name] + by}), compiled=False)

            slopes = linear_slopes(here, shifted, one.value, STEP * min(one.high - one.low, 1.0))
            assert slopes is not None, f"{name}: the arrays of a scene are not linear in it"
            self.slopes[name] = slopes
        # value = offset + sum of slope times parameter: where the arrays hold a parameter itself, that is it, to the last bit
        self._fields = [
            (array, field, getattr(self.setup, array)[field] - self._sum(array, field, self.start))
            for array in MOVED
            for field in getattr(self.setup, array).dtype.names
            if any(slopes[array].get(field, np.zeros(1)).any() for slopes in self.slopes.values())
        ]

    def _sum(self, array: str, field: str, numbers: Mapping[str, float]) -> Any:
        return sum(slopes[array][field] * numbers[name] for name, slopes in self.slopes.items())

    def at(self, numbers: Mapping[str, float]) -> Table:
        """Return the arrays at values of all parameters."""
        made = self.setup._replace(world=self.setup.world.copy(), features=self.setup.features.copy())
        for array, field, offset in self._fields:
            getattr(made, array)[field] = offset + self._sum(array, field, numbers)
        return Table(made, self)

    @property
    def _moved(self) -> dict[str, NDArray[np.void]]:
        return {name: getattr(self.setup, name) for name in MOVED}

    @functools.cached_property
    def duals(self) -> NDArray[np.int64]:
        """Addresses of laws that are called by address, of dual numbers."""
        return dual_users(self._scene(self.start).called_laws)

    def packed(self, names: Sequence[str]) -> dict[str, Array]:
        """Return the derivatives of world and features with respect to some parameters, as compiled code takes them."""
        if not names:
            empty = {name: (1, len(rows), float_count(rows.dtype), LANES) for name, rows in self._moved.items()}
            return {name: np.zeros(shape) for name, shape in empty.items()}
        return packed([self.slopes[name] for name in names], {name: rows.dtype for name, rows in self._moved.items()})
