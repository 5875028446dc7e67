"""The parameters of a sensitivity: names, and the derivatives of the scene's arrays; kept while the scene is alive."""

from __future__ import annotations

import functools
import weakref
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.core.jit.dual.dual_records import float_count, float_places
from carom.core.jit.dual.numbers import LANES
from carom.scene.scene import Scene
from carom.simulation.sensitivity.seeds import Column, Tangents, tangents_of
from carom.simulation.setup import set_up

__all__ = ["ARRAYS", "Parameters", "packed", "parameters_of", "unpacked"]

Array = NDArray[np.float64]
ARRAYS = ("world", "features", "balls")


class Parameters:
    """Columns, and the derivatives of the arrays of a scene with respect to each."""

    def __init__(self, scene: Scene, wrt: tuple[str, ...], columns: list[Column], slopes: list[Tangents]) -> None:
        setup = set_up(scene, compiled=False)
        self.wrt, self.columns, self.slopes = wrt, columns, slopes
        self._dtypes = {name: getattr(setup, name).dtype for name in ARRAYS}

    def __len__(self) -> int:
        """How many there are."""
        return len(self.columns)

    @functools.cached_property
    def packed(self) -> dict[str, Array]:
        """By array, as compiled code takes them: (C, N, numbers, LANES)."""
        return packed(self.slopes, self._dtypes)


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
    """Return derivatives (N, numbers, p) of those of compiled code, (C, N, numbers, LANES)."""
    return np.moveaxis(found, 0, 2).reshape(*found.shape[1:3], -1)[..., :p]


# (a shot takes less time than finding what its paths name)
_kept: dict[int, tuple[weakref.ref[Scene], dict[Any, Parameters]]] = {}
MOST_KEPT = 8


def parameters_of(scene: Scene, wrt: Any, phases: list[int]) -> Parameters:
    """Return the parameters that paths name; CaromError for a path that leads nowhere, or to what is no real number."""
    key = id(scene)
    found = _kept.get(key)
    if found is None or found[0]() is not scene:
        found = weakref.ref(scene, lambda _gone: _kept.pop(key, None)), {}
        _kept[key] = found
    paths = (wrt,) if isinstance(wrt, str) else tuple(wrt)
    if not all(isinstance(path, str) for path in paths):
        return _made(scene, paths, phases)
    asked = paths, tuple(phases)
    if asked not in found[1]:
        made = _made(scene, paths, phases)
        while len(found[1]) >= MOST_KEPT:
            found[1].pop(next(iter(found[1])))
        found[1][asked] = made
    return found[1][asked]


def _made(scene: Scene, wrt: Any, phases: list[int]) -> Parameters:
    return Parameters(scene, wrt, *tangents_of(scene, wrt, phases, set_up(scene, compiled=False)))
