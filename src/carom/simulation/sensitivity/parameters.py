"""The parameters of a sensitivity: names, and the derivatives of the scene's arrays; kept while the scene is alive."""

from __future__ import annotations

import functools
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.core.jit.dual.dual_records import float_count, float_places
from carom.core.jit.dual.numbers import LANES
from carom.scene.scene import Scene
from carom.simulation.sensitivity.seeds import Column, Tangents, tangents_of
from carom.simulation.setup import SceneArrays

__all__ = ["ARRAYS", "Parameters", "packed", "parameters_of", "unpacked"]

Array = NDArray[np.float64]
ARRAYS = ("world", "features", "balls")


class Parameters:
    """Columns, and the derivatives of the arrays of a scene with respect to each."""

    def __init__(
        self, arrays: SceneArrays, wrt: tuple[str, ...], columns: list[Column], slopes: list[Tangents]
    ) -> None:
        self.arrays, self.wrt, self.columns, self.slopes = arrays, wrt, columns, slopes

    def __len__(self) -> int:
        """How many there are."""
        return len(self.columns)

    @functools.cached_property
    def packed(self) -> dict[str, Array]:
        """By array, as compiled code takes them: (C, N, numbers, LANES)."""
        return packed(self.slopes, {name: getattr(self.arrays, name).dtype for name in ARRAYS})


def packed(slopes: Sequence[Tangents], dtypes: Mapping[str, Any]) -> dict[str, Array]:
    """Return the derivatives of arrays of those types as compiled code takes them, by array: (C, N, numbers, LANES)."""
    found = {}
    for name, dtype in dtypes.items():
        rows = len(next(iter(slopes[0][name].values())))
        found[name] = np.zeros((-(-len(slopes) // LANES), rows, float_count(dtype), LANES))
        for j, one in enumerate(slopes):
            lanes = found[name][j // LANES, ..., j % LANES]
            for field, place in float_places(dtype).items():
                lanes[:, place] = one[name][field].reshape(rows, place.stop - place.start)
    return found


def unpacked(found: Array, p: int) -> Array:
    """Return derivatives (N, numbers, p) from the compiled code's, (C, N, numbers, LANES)."""
    return np.moveaxis(found, 0, 2).reshape(*found.shape[1:3], -1)[..., :p]


MOST_KEPT = 8


def parameters_of(scene: Scene, arrays: SceneArrays, wrt: Any, phases: list[int]) -> Parameters:
    """Return the parameters that paths name; CaromError for a path that leads nowhere, or to what is no real number.

    The scene keeps the last of them: a shot takes less time than finding what its paths name.
    """
    kept = scene.kept.setdefault("parameters", {})
    paths = (wrt,) if isinstance(wrt, str) else tuple(wrt)
    if not all(isinstance(path, str) for path in paths):
        return _made(scene, arrays, paths, phases)
    asked = paths, tuple(phases)
    if asked not in kept:
        made = _made(scene, arrays, paths, phases)
        while len(kept) >= MOST_KEPT:
            kept.pop(next(iter(kept)))
        kept[asked] = made
    found: Parameters = kept[asked]
    return found


def _made(scene: Scene, arrays: SceneArrays, wrt: Any, phases: list[int]) -> Parameters:
    return Parameters(arrays, wrt, *tangents_of(scene, wrt, phases, arrays))
