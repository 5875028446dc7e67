"""The table of filmed shots: a scene, the numbers of it that all shots share, and its arrays at values of these."""

from __future__ import annotations

import functools
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.core.motion.phases import REST
from carom.errors import CaromError
from carom.scene.floor import Floor
from carom.scene.paths import path_match, replaced
from carom.scene.scene import Run, Scene
from carom.scene.shapes import Table
from carom.simulation.sensitivity.compiled import dual_users
from carom.simulation.sensitivity.parameters import parameters_of
from carom.simulation.setup import SceneArrays, set_up
from carom.tracks.events import WallLine

__all__ = ["FREE", "SharedNumber", "TableModel", "TableNumbers", "scene_of_films", "table_of", "with_balls"]

Array = NDArray[np.float64]
NOSE, MASS = 0.037, 0.21  # m, of a carom cushion; kg, of a ball
SPIN_LOSS, GRAVITY = 6.0, 9.80665  # rad/s^2 of spin about the vertical, where the search begins
FREE = (
    "walls.0.restitution", "walls.0.friction", "floor.friction", "floor.rolling_resistance", "floor.spin_friction",
    "ball_contact.restitution", "ball_contact.friction", "walls.0.length", "walls.0.width", "walls.0.center",
)  # fmt: skip
"""The numbers of a scene that are fitted where nothing else is said."""
# By the end of a path: how far a number may go (share of its value, or absolute), and its usual change.
LENGTHS = ("length", "width", "x", "y")


class SharedNumber(NamedTuple):
    """A number of the table that all shots share: a column of a sensitivity."""

    name: str
    value: float
    low: float
    high: float
    scale: float
    """Of a usual change, for a search."""


class TableNumbers(NamedTuple):
    """The table at values of its shared numbers."""

    scene: Scene
    arrays: SceneArrays
    slopes: dict[str, Array]
    """Derivatives of world and features, packed for compiled code: (C, rows, numbers, LANES)."""
    duals: NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class TableModel:
    """A scene with as many balls as the shots have, and the paths that are fitted."""

    scene: Scene
    paths: tuple[str, ...]
    bounds: Mapping[str, tuple[float, float]]

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
        if last in LENGTHS:
            low, high, scale = value - 0.05, value + 0.05, 0.005
        elif last == "restitution":
            low, high, scale = 0.3, 1.0, 0.02
        else:
            size = max(abs(value), 1e-3)
            low, high, scale = (0.0 if value >= 0 else -10 * size), max(10 * size, 0.02), 0.1 * size
        low, high = self.bounds.get(name, (low, high))
        return SharedNumber(name, value, low, high, scale)

    def at(self, values: Array) -> TableNumbers:
        """Return the scene and its arrays, with derivatives, at values (P,) of the shared numbers."""
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
        scene = replaced(scene, changes) if changes else scene
        arrays = set_up(scene)
        slopes = {}
        if self.paths:
            slopes = parameters_of(scene, arrays, self.paths, [REST] * len(scene.balls)).packed
        return TableNumbers(scene, arrays, slopes, dual_users(scene.called_laws))

    def with_law(self, law: str) -> TableModel:
        """Return the model with another law of the cushions."""
        return TableModel(replaced(self.scene, {"run.law": law}), self.paths, self.bounds)


def scene_of_films(
    table: Scene | None, walls: Sequence[WallLine], radius: float | None, count: int, duration: float, where: str
) -> Scene:
    """Return the scene with ``count`` balls: the one given, or a carom table between the lines of the films."""
    if table is None:
        if radius is None:
            raise CaromError(f"{where}: `radius`: expected the balls' radius in m, got none; a carom ball has 30.75 mm")
        a, ball = radius, dict[str, Any](radius=radius, mass=MASS)
        shape = _table_between(walls, a, where)
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
    a, nose = balls[0]["radius"], wall.nose_height
    reach = a if nose is None or nose <= a else math.sqrt(a * a - (nose - a) ** 2)
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


def _table_between(walls: Sequence[WallLine], a: float, where: str) -> Table:
    """Return a carom table whose cushions reflect centres at the lines of the films."""
    at = {}
    for wall in walls:
        axis = int(abs(wall.normal[1]) > 0.5)
        at[wall.name] = wall.point[axis]
    missing = [side for side in ("left", "right", "bottom", "top") if side not in at]
    if missing:
        raise CaromError(
            f"{where}: expected shots that reach all four cushions, got none at {', '.join(missing)}: give the table as a scene"
        )
    reach = math.sqrt(a * a - (NOSE - a) ** 2) if a < NOSE < 2 * a else a
    nose = NOSE if a < NOSE < 2 * a else None
    number: dict[str, Any] = {"restitution": 0.83, "friction": 0.22, "nose_height": nose}
    return Table(
        length=at["right"] - at["left"] + 2 * reach, width=at["top"] - at["bottom"] + 2 * reach,
        center=((at["left"] + at["right"]) / 2, (at["bottom"] + at["top"]) / 2), **number,
    )  # fmt: skip
