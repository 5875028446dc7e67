"""The table of filmed shots: a scene, the numbers of it that all shots share, and its arrays at values of these."""

from __future__ import annotations

import contextlib
import functools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.core.motion.phases import REST
from carom.errors import CaromError
from carom.fitting.shots.film import Films
from carom.fitting.table_numbers import MOVED, SharedNumber, TableNumbers, cushions_between, reach_of
from carom.scene.floor import Floor
from carom.scene.scene import Run, Scene
from carom.scene.shapes import Table
from carom.scene.toml import path_match, replaced
from carom.simulation.sensitivity.seeds import Parameters, parameters_of
from carom.simulation.setup import SceneArrays, set_up

Array = NDArray[np.float64]
SIDES = {"left": "right", "right": "left", "bottom": "top", "top": "bottom"}  # and the one across
NOSE, MASS = 0.037, 0.21  # m, of a carom cushion; kg, of a ball
SPIN_LOSS, GRAVITY = 2.0, 9.80665  # rad/s^2 of spin about the vertical, where the search begins
ROUNDING = 1e-13  # of the largest number of a field
AFFINE_AT = 4  # places within the bounds
TERMS = {"walls.0.yield_time": 2.5e-3, "floor.rolling_drag": 2e-3, "floor.spin_drag": 3.0}
"""Numbers that most scenes leave at zero, and where a search for them begins."""
FREE = (
    "walls.0.restitution", "walls.0.friction", "floor.friction", "floor.rolling_resistance", "floor.spin_friction",
    "ball_contact.restitution", "ball_contact.friction", "walls.0.length", "walls.0.width", "walls.0.center", *TERMS,
)  # fmt: skip
"""The numbers of a scene that are fitted where nothing else is said."""
# By the end of a path: least and greatest value, and usual change; of lengths about their value.
LENGTHS = ("length", "width", "x", "y")
KNOWN = {
    "restitution": (0.3, 1.0, 0.02), "coefficients.0": (0.3, 1.2, 0.02), "coefficients.1": (-0.3, 0.3, 0.01),
    "coefficients.2": (-0.1, 0.1, 0.003), "yield_time": (0.0, 0.02, 5e-4), "rolling_drag": (0.0, 0.02, 5e-4),
    "spin_damping": (0.0, 2.0, 0.03), "spin_drag": (0.0, 20.0, 0.3), "slope.x": (-0.01, 0.01, 1e-4), "slope.y": (-0.01, 0.01, 1e-4),
}  # fmt: skip


@dataclass(frozen=True, eq=False)
class TableModel:
    """A scene with as many balls as the shots have, and the paths that are fitted."""

    scene: Scene
    paths: tuple[str, ...]
    bounds: Mapping[str, tuple[float, float]]

    def __getstate__(self) -> dict[str, Any]:
        """Without what is made of the scene: its arrays have addresses of this process."""
        return {one.name: getattr(self, one.name) for one in fields(self)}

    @functools.cached_property
    def _parameters(self) -> Any:
        arrays = set_up(self.scene)
        return parameters_of(self.scene, arrays, self.paths, [REST] * len(self.scene.balls)) if self.paths else None

    @functools.cached_property
    def shared(self) -> list[SharedNumber]:
        """The numbers that are fitted."""
        return (
            [] if self._parameters is None else [self._number(one.name, one.value) for one in self._parameters.columns]
        )

    def _number(self, name: str, value: float) -> SharedNumber:
        last = name.rpartition(".")[2]
        known = next((end for end in KNOWN if name.endswith(f".{end}")), None)
        if known is not None:
            low, high, scale = KNOWN[known]
            low, high = min(low, value), max(high, value)
        elif last in LENGTHS and "coefficients" not in name:
            low, high, scale = value - 0.05, value + 0.05, 0.005
        else:
            size = max(abs(value), 1e-3)
            low, high, scale = (0.0 if value >= 0 else -10 * size), max(10 * size, 0.02), 0.1 * size
        low, high = self.bounds.get(name, (low, high))
        return SharedNumber(name, value, low, high, scale)

    def scene_at(self, values: Array) -> Scene:
        """Return the scene at values (P,) of the shared numbers."""
        scene, wanted = self.scene, dict(zip((one.name for one in self.shared), values.tolist(), strict=True))
        changes: dict[str, Any] = {}
        for column in self._parameters.columns if self.paths else ():
            for place in path_match(scene, column.path).places:
                path = ".".join(map(str, place))
                if column.component is None:
                    changes[path] = wanted[column.name]
                else:
                    old = changes.get(path, path_match(scene, path).values[0])
                    changes[path] = tuple(
                        wanted[column.name] if k == column.component else x for k, x in enumerate(old)
                    )
        return replaced(scene, changes) if changes else scene

    def values_in(self, scene: Scene) -> Array:
        """Return the values (P,) that the shared numbers have in another scene; NaN where it has no such number."""
        found = np.full(len(self.shared), np.nan)
        for k, column in enumerate(self._parameters.columns if self.paths else ()):
            with contextlib.suppress(CaromError):
                value = path_match(scene, column.path).values[0]
                value = value if column.component is None else value[column.component]
                value = getattr(value, "value", value)
                found[k] = value if isinstance(value, int | float) else np.nan
        return found

    def at(self, values: Array) -> TableNumbers:
        """Return the table at values (P,) of the shared numbers, with derivatives; CaromError where no scene has these."""
        if self._start is not None:
            return self._start.at(values)
        scene = self.scene_at(values)
        arrays = set_up(scene)
        found = parameters_of(scene, arrays, self.paths, [REST] * len(scene.balls)) if self.paths else None
        return TableNumbers(tuple(self.shared), values, scene, arrays, found)

    @functools.cached_property
    def _start(self) -> TableNumbers | None:
        """The table as it is, where the arrays are affine in the numbers: a scene takes five milliseconds, its derivatives a
        hundred. That they are affine shows at the bounds and at some values within, where there are scenes and these follow."""
        if not self.shared:
            return None
        value, low, high = (np.array([getattr(one, name) for one in self.shared]) for name in ("value", "low", "high"))
        inside = low + (high - low) * np.random.default_rng(0).random((AFFINE_AT, len(low)))
        # (numbers that must not be larger than another stand beside it)
        odd = np.arange(len(low)) % 2 == 1
        for values in (np.where(odd, low, high), np.where(odd, high, low), low, high, *inside):
            try:
                arrays = set_up(self.scene_at(values), compiled=False)
            except CaromError:
                return None
            if not _follow(self._parameters, arrays, values - value):
                return None
        return TableNumbers(tuple(self.shared), value, self.scene, self._parameters.arrays, self._parameters)

    def with_law(self, law: str) -> TableModel:
        """Return the model with another law of the cushions."""
        return TableModel(replaced(self.scene, {"run.law": law}), self.paths, self.bounds)


def _follow(known: Parameters, arrays: SceneArrays, by: Array) -> bool:
    """Return whether arrays follow from those of parameters that differ by (P,), and their derivatives, to rounding."""
    for array in MOVED:
        there, here = getattr(known.arrays, array), getattr(arrays, array)
        if len(there) != len(here):
            return False
        for field in here.dtype.names:
            x, then, size = here[field], there[field], np.abs(there[field])
            if field in known.slopes[0][array]:
                changes = [d * one[array][field] for d, one in zip(by.tolist(), known.slopes, strict=True)]
                then, size = then + sum(changes), np.maximum(size, np.abs(changes).max(axis=0))
            rounding = ROUNDING * size[np.isfinite(size)].max(initial=0.0)  # (also of a number that becomes 0)
            if not np.allclose(x, then, rtol=0.0, atol=rounding, equal_nan=True):
                return False
    return True


def scene_of_films(
    table: Scene | None, films: Films, radius: float | None, count: int, duration: float, where: str
) -> Scene:
    """Return the scene with ``count`` balls: the one given, or a carom table between the lines of the films."""
    if table is None:
        if radius is None:
            raise CaromError(f"{where}: `radius`: expected the balls' radius in m, got none; a carom ball has 30.75 mm")
        a, ball = radius, dict[str, Any](radius=radius, mass=MASS)
        shape = _table_between(films, a, where)
        given: dict[str, Any] = {
            "floor": Floor(friction=0.2, rolling_resistance=0.006, spin_friction=0.4 * a * SPIN_LOSS / GRAVITY),
            "walls": (shape,), "ball_contact": {"restitution": 0.95, "friction": 0.06}, "run": Run(),
        }  # fmt: skip
    else:
        first = table.balls[0]
        a, ball = (
            radius or first.radius,
            {"radius": radius or first.radius, "mass": first.mass, "inertia": first.inertia},
        )
        found = next((wall for wall in table.walls if isinstance(wall, Table)), None)
        if found is None or table.floor is None:
            raise CaromError(f"{where}: table: expected a scene with a floor and a wall of the shape table, got none")
        shape, given = found, _fields(table)
    places = [(shape.center[0] + 3 * a * (k - (count - 1) / 2), shape.center[1]) for k in range(count)]
    given["balls"] = [ball | {"position": at} for at in places]
    given["run"] = given["run"].model_copy(update={"duration": duration, "max_events": None})
    return Scene(**given)


def begun(scene: Scene, free: Sequence[str]) -> tuple[Scene, tuple[str, ...]]:
    """Return the scene from which a search begins, and the paths of ``free``: of a term at zero a usual value (there it has no
    derivative on one side), of a cushion's number that it has from the table the table's, of the two laws of the loss of spin the
    one that the scene has.
    """
    paths = list(dict.fromkeys(free))
    other = {"floor.spin_damping": "floor.spin_drag", "floor.spin_drag": "floor.spin_damping"}
    for path, against in other.items():
        taken = path_match(scene, against).values[0] > 0 or (path in TERMS and against in paths)
        if path in paths and taken:
            paths.remove(path)
    starts = TERMS | {"floor.spin_damping": 0.1}
    zero = {path: x for path, x in starts.items() if path in paths and path_match(scene, path).values[0] == 0}
    own = {path: path_match(scene, of_table(path)).values[0] for path in paths if _taken_from_table(scene, path)}
    return (replaced(scene, zero | own) if zero or own else scene), tuple(paths)


def of_table(path: str) -> str:
    """Return the path of the table's number in the place of that of one of its cushions; other paths as they are."""
    wall, found, rest = path.partition(".sides.")
    return f"{wall}.{rest.partition('.')[2]}" if found else path


def _taken_from_table(scene: Scene, path: str) -> bool:
    return of_table(path) != path and path_match(scene, path).values[0] is None


def _fields(scene: Scene) -> dict[str, Any]:
    return {name: getattr(scene, name) for name in type(scene).model_fields if name != "rack"}


def table_of(scene: Scene) -> Table:
    """Return the table of a scene of :func:`scene_of_films`."""
    return next(wall for wall in scene.walls if isinstance(wall, Table))


def with_balls(scene: Scene, balls: Sequence[dict[str, Any]]) -> Scene:
    """Return a scene with other balls; they are moved apart, and off the cushions, by as little as it takes.

    (Fitted first places overlap by less than the error of a frame.)
    """
    try:
        return Scene(**(_fields(scene) | {"balls": balls}))
    except CaromError:
        return Scene(**(_fields(scene) | {"balls": _apart(balls, table_of(scene))}))


def _apart(balls: Sequence[dict[str, Any]], wall: Table) -> list[dict[str, Any]]:
    a = balls[0]["radius"]
    reach = reach_of(a, wall.nose_height)
    half, middle = np.array([wall.length, wall.width]) / 2 - reach * (1 + 1e-9), np.array(wall.center)
    places = np.array([one["position"] for one in balls])
    for _ in range(3):
        places = np.clip(places, middle - half, middle + half)
        for i in range(len(places)):
            for j in range(i):
                gap = places[i] - places[j]
                size = float(np.hypot(*gap))
                if size < 2 * a * (1 + 1e-9):
                    places[i] += gap / max(size, 1e-9) * (2 * a * (1 + 2e-9) - size)
    return [one | {"position": tuple(at)} for one, at in zip(balls, places.tolist(), strict=True)]


def _table_between(films: Films, a: float, where: str) -> Table:
    """Return a carom table whose cushions reflect centres at the lines of the films; a field is twice as long as wide."""
    at = {wall.name: wall.point[int(abs(wall.normal[1]) > 0.5)] for wall in films.walls}
    nose = NOSE if a < NOSE < 2 * a else None
    missing = [side for side in SIDES if side not in at]
    if len(missing) == 1:
        side, other = missing[0], SIDES[missing[0]]
        axis = int(side in ("bottom", "top"))
        low, high = ("left", "right") if axis else ("bottom", "top")
        reach = reach_of(a, nose)
        across = at[high] - at[low] + 2 * reach
        far = max(float(np.abs(shot.position[shot.known][:, axis] - at[other]).max()) for shot in films.shots)
        size = across * (2 if far > across / 2 else 0.5)
        at[side] = at[other] + (1 if side in ("right", "top") else -1) * (size - 2 * reach)
        taken = f"taken to be {size:.2f} m from the {other} one, as a field is twice as long as wide"
        films.notes.append(f"no ball reaches the {side} cushion: {taken}")
    elif missing:
        names = ", ".join(missing)
        raise CaromError(
            f"{where}: expected shots that reach three cushions at least, got none at {names}: give the table as a scene"
        )
    return cushions_between(at, a, nose, restitution=0.83, friction=0.22)
