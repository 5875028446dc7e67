"""The derivatives of a scene's arrays with respect to the numbers that paths name: where the tangents of a run begin.

The arrays are made by the scene's own construction, whatever the shape; their derivatives are differences of order 8 in steps so
large that a number on which they depend linearly (velocities, frictions, a wall's point) has its derivative to the last digits.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.core.geometry.features import CURVE
from carom.core.jit.dual.dual_records import float_count, float_places
from carom.core.jit.dual.numbers import LANES
from carom.core.motion.phases import FLIGHT, PIVOTING, REST
from carom.errors import CaromError
from carom.scene.air import FOLLOWS
from carom.scene.scene import Scene
from carom.scene.toml import path_match, replaced
from carom.simulation.setup import SceneArrays, set_up

Array = NDArray[np.float64]
Tangents = dict[str, dict[str, Array]]
Shifted = Callable[[float], SceneArrays]

# More parameters than this are refused: each event costs a time, and each row of the log memory, in proportion.
MOST_COLUMNS = 2000
WHERE = "sensitivity"
# f'(0) = sum of c_k (f(k h) - f(-k h)) / h, of order 8 (Fornberg, Math. Comp. 51, 699 (1988), table 1); and on one side, of order 4
CENTRAL = ((1, 4 / 5), (2, -1 / 5), (3, 4 / 105), (4, -1 / 280))
ONE_SIDED = ((0, -25 / 12), (1, 4.0), (2, -3.0), (3, 4 / 3), (4, -1 / 4))
STEP = 2.0**-7


class Column(NamedTuple):
    """One parameter: its name, and the paths and components that change together."""

    name: str
    path: str
    component: int | None
    values: tuple[Any, ...]

    @property
    def value(self) -> float:
        """Its value in the scene (of several places, the first one's)."""
        first = self.values[0]
        return float(first if self.component is None else first[self.component])


def _columns_of(scene: Scene, wrt: Any, phases: Any) -> list[Column]:
    """Return the parameters that paths name; CaromError for a path that leads nowhere, or to what is no real number."""
    paths = [wrt] if isinstance(wrt, str) else list(wrt)
    found: list[Column] = []
    if not paths:
        raise CaromError(f"{WHERE}: wrt: expected one or more paths such as 'balls.0.velocity', got none")
    for path in paths:
        match = path_match(scene, path, f"{WHERE}: wrt")
        # (a constant restitution is its number)
        match = match._replace(
            values=tuple(one.value if getattr(one, "form", "") == "constant" else one for one in match.values)
        )
        first = match.values[0]
        if isinstance(first, tuple) and first and all(isinstance(one, int | float) for one in first):
            # (position and velocity of a ball on the floor have two components, a spin has three everywhere)
            turns = all(keys[0] == "balls" and keys[-1] == "spin" for keys in match.places)
            whole = len(first) < 3 or turns or _flies(match.places, phases)
            names = ("x", "y", "z")[: len(first) if whole else 2]
            if len(first) > 3:
                raise CaromError(f"{WHERE}: wrt: {path}: expected a number or a vector, got {len(first)} numbers")
            found += [Column(f"{path}.{name}", path, k, match.values) for k, name in enumerate(names)]
        else:
            found.append(Column(path, path, None, match.values))
        for keys in match.places:
            number = keys[2] if keys[0] == "balls" and len(keys) > 2 else ""
            if number in ("velocity", "spin", "spin_z") and scene.balls[int(keys[1])].strike is not None:
                ball = path.rpartition(f".{number}")[0]
                others = ", ".join(f"{ball}.strike.{name}" for name in ("speed", "azimuth", "offset"))
                expected = "expected a number that can change a little, got one which the cue's strike fixes"
                raise CaromError(f"{WHERE}: wrt: {path}: {expected}; take {others}")
            if number in ("velocity", "spin") and phases[keys[1]] in (PIVOTING, REST):
                raise CaromError(
                    f"{WHERE}: wrt: {path}: expected a ball that moves, got ball {keys[1]} at rest on the floor, where the "
                    "derivative depends on the direction; give it a small velocity"
                )
    for one in found:
        for number in one.values:
            x = number if one.component is None else number[one.component]
            if isinstance(x, bool) or not isinstance(x, int | float) or not math.isfinite(x):
                got = (
                    f"nothing: it follows from {FOLLOWS[one.path]}; take these" if one.path in FOLLOWS else f"{x!r:.60}"
                )
                raise CaromError(f"{WHERE}: wrt: {one.path}: expected a finite real number, got {got}")
    if len(found) > MOST_COLUMNS:
        raise CaromError(
            f"{WHERE}: wrt: expected at most {MOST_COLUMNS} parameters, got {len(found)}; time and memory grow in proportion"
        )
    return found


def _flies(places: Any, phases: Any) -> bool:
    return all(keys[0] != "balls" or phases[keys[1]] == FLIGHT for keys in places)


def tangents_of(scene: Scene, wrt: Any, phases: Any, setup: SceneArrays) -> tuple[list[Column], list[Tangents]]:
    """Return the parameters that paths name, and the derivatives of the scene's arrays with respect to each.

    A component that the scene does not let change (gravity along a floor, the height of a ball on it) is left out of its vector;
    CaromError for a number, or a whole vector, that cannot change.
    """
    columns = _columns_of(scene, wrt, phases)
    try:
        slopes = [_slopes(scene, one, setup) for one in columns]
    except CurveChangesError as error:
        expected = "expected a number that leaves the curve of a wall as it is, such as its center or its angle"
        raise CaromError(f"{WHERE}: wrt: {expected}, got {error}, on which the curve depends") from None
    for one, slope in zip(columns, slopes, strict=True):
        whole = [found for other, found in zip(columns, slopes, strict=True) if other.path == one.path]
        if slope is None and all(found is None for found in whole):
            raise CaromError(
                f"{WHERE}: wrt: {one.name}: expected a number that can change a little, got {one.value!r}, which"
                " the scene fixes"
            )
    kept = [(one, slope) for one, slope in zip(columns, slopes, strict=True) if slope is not None]
    return [one for one, _slope in kept], [slope for _one, slope in kept]


def _slopes(scene: Scene, column: Column, setup: SceneArrays) -> Tangents | None:
    """Return the derivatives of the arrays with respect to one parameter; None where the scene fixes it."""
    h = _step_of(column)

    # (three searches for the derivatives ask for the same scenes)
    @functools.cache
    def shifted(by: float) -> SceneArrays:
        made = set_up(shifted_scene(scene, column, by), compiled=False)
        if _curves_of(made) != curves:
            raise CurveChangesError(column.name)
        return made

    curves = _curves_of(setup)

    # (of several places with different values the arrays hold no one number)
    x = column.value if len(set(column.values)) == 1 else math.nan
    return linear_slopes(setup, shifted, x, h) or _differences(setup, shifted, h)


class CurveChangesError(Exception):
    """A parameter changes the curve of a wall."""


def _curves_of(setup: SceneArrays) -> list[float]:
    """Return the addresses of the tables of curves."""
    found: list[float] = setup.features["lo1"][setup.features["kind"] == CURVE].tolist()
    return found


def linear_slopes(setup: SceneArrays, shifted: Shifted, x: float, h: float) -> Tangents | None:
    """Return the derivatives of arrays that are linear in a parameter x, else None; ``shifted(dx)`` are those at x + dx."""
    return _of_itself(setup, shifted, x, h) or _linear(setup, shifted, h)


def _of_itself(setup: SceneArrays, shifted: Shifted, x: float, h: float) -> Tangents | None:
    """Return the derivatives where the arrays hold the parameter itself, and nothing else changes with it; else None.

    (As :mod:`carom.sweeps` finds parameters. One scene is made for it, where differences make eight.)
    """
    try:
        made = shifted(h)
    except CaromError:
        return None
    found: Tangents = {}
    for name in ("world", "features", "balls"):
        old, new = getattr(setup, name), getattr(made, name)
        if len(old) != len(new):
            return None
        found[name] = {}
        for field in old.dtype.names:
            changed = old[field] != new[field]
            if old.dtype[field].base.kind == "f":
                changed &= ~(np.isnan(old[field]) & np.isnan(new[field]))
                found[name][field] = changed.astype(float)
            if changed.any() and not ((old[field][changed] == x) & (new[field][changed] == x + h)).all():
                return None
    return found


def _linear(setup: SceneArrays, shifted: Shifted, h: float) -> Tangents | None:
    """Return the derivatives where the arrays are linear in the parameter: two differences agree to their rounding; else None."""
    try:
        far, back, near, behind = (shifted(k * h) for k in (4, -4, 1, -1))
    except CaromError:
        return None
    found: Tangents = {}
    for name in ("world", "features", "balls"):
        ends = [getattr(one, name) for one in (setup, far, back, near, behind)]
        if len({len(one) for one in ends}) > 1:
            return None
        found[name] = {}
        for field in ends[0].dtype.names:
            x, x4, y4, x1, y1 = (one[field] for one in ends)
            if ends[0].dtype[field].base.kind != "f":
                if not all((one == x).all() for one in (x4, y4, x1, y1)):
                    return None
                continue
            with np.errstate(invalid="ignore"):
                slope, bend = (x4 - y4) / (8 * h), (x4 - y4) / 4 - (x1 - y1)
            # (infinite extents and frictions do not change)
            # (a small number may be the difference of two large ones: the field's largest is the measure of rounding)
            rounding = (
                16 * np.finfo(float).eps * np.abs(x4, where=np.isfinite(x4), out=np.zeros_like(x4)).max(initial=0.0)
            )
            if not (np.isinf(x) | (np.abs(bend) <= rounding)).all():
                return None
            found[name][field] = np.where(np.isinf(x), 0.0, slope)
    return found


def _differences(setup: SceneArrays, shifted: Shifted, h: float) -> Tangents | None:
    """Return the derivatives of the arrays' floating-point fields, by array and field; None where the scene fixes the number."""
    for stencil in _stencils():
        try:
            made = [(c, shifted(k * h)) for k, c in stencil]
        except CaromError:
            continue
        found: dict[str, dict[str, Array]] = {}
        for name in ("world", "features", "balls"):
            base = getattr(setup, name)
            fields = [field for field in base.dtype.names if base.dtype[field].base.kind == "f"]
            if any(len(getattr(one, name)) != len(base) for _c, one in made):
                break
            with np.errstate(invalid="ignore"):
                slopes = {field: sum(c * getattr(one, name)[field] for c, one in made) / h for field in fields}
            # (infinite extents and frictions do not change)
            found[name] = {field: np.nan_to_num(np.asarray(d, dtype=float), nan=0.0) for field, d in slopes.items()}
        else:
            return found
    return None


def _step_of(column: Column) -> float:
    """Return the smallest step of the differences, a power of two."""
    scale = max((abs(x if column.component is None else x[column.component]) for x in column.values), default=0.0)
    return STEP * (2.0 ** round(math.log2(scale)) if scale > 0 else 1.0)


def _stencils() -> Any:
    yield [(sign * k, sign * c) for k, c in CENTRAL for sign in (1, -1)]
    for sign in (1, -1):
        yield [(sign * k, sign * c) for k, c in ONE_SIDED]


def shifted_scene(scene: Scene, column: Column, by: float) -> Scene:
    """Return the scene with the parameter changed by ``by`` at every place."""
    changes: dict[str, Any] = {}
    for place, x in zip(path_match(scene, column.path).places, column.values, strict=True):
        path = ".".join(map(str, place))
        changes[path] = (
            x + by
            if column.component is None
            else tuple(one + by if k == column.component else one for k, one in enumerate(x))
        )
    return replaced(scene, changes)


# ----------------------------------------------------------------------------------------------------
# The parameters of a sensitivity: names, and the derivatives of the scene's arrays; kept while the scene is alive.


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
