"""Initial states of many runs of a scene: the scene's balls with the states that are given, checked."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.bodies import vectors
from carom.errors import CaromError, FaultList
from carom.scene.scene import Scene
from carom.simulation.overlaps import overlapping
from carom.simulation.setup import SceneArrays

__all__ = ["starts_of"]


def starts_of(
    where: str, scene: Scene, arrays: SceneArrays, velocity: Any, spin: Any, position: Any
) -> NDArray[np.void]:
    """Return the balls (N, B) at their starts: the scene's, with the states that are given; CaromError for those it refuses."""
    faults = FaultList(where)
    given = {}
    for field, unit, value in (("v", "m/s", velocity), ("w", "rad/s", spin), ("x", "m", position)):
        if value is not None:
            given[field] = vectors(faults, {"v": "velocity", "w": "spin", "x": "position"}[field], value, unit)
    faults.raise_if_any()
    count = len(arrays.balls)
    shape: tuple[int, ...] = (1, count)
    if count == 1:
        given = {field: array[:, None, :] if array.ndim == 2 else array for field, array in given.items()}
    for array in given.values():
        # (broadcast, one row a run would set all balls alike, and one row a ball would be one run)
        if count > 1 and (array.ndim != 3 or array.shape[1] != count):
            raise CaromError(
                f"{where}: expected states (N, {count}, 3), runs by balls by axes, got shape {array.shape}"
            )
        try:
            shape = np.broadcast_shapes(shape, array.shape[:-1])
        except ValueError:
            shape = ()
        if len(shape) != 2 or shape[1] != count:
            raise CaromError(f"{where}: expected states (N, {count}, 3), got shape {array.shape}")
    balls = arrays.for_runs(shape[0]).balls
    for field, array in given.items():
        balls[field] = array
    if "x" in given:
        _check_places(where, scene, arrays, balls)
    return balls


def _check_places(where: str, scene: Scene, arrays: SceneArrays, balls: NDArray[np.void]) -> None:
    """Raise CaromError for the first initial state that overlaps something, or lies where no ball can be."""
    bad = overlapping(arrays, balls)
    places, which = np.unique(balls["x"].reshape(-1, 3), axis=0, return_inverse=True)
    blocked = np.array([any(wall.blocked(tuple(x)) for wall in scene.walls) for x in places.tolist()])
    bad |= blocked[which.reshape(balls.shape)].any(axis=1)
    if bad.any():
        n = int(np.flatnonzero(bad)[0])
        raise CaromError(
            f"{where}: position: expected places where the balls touch nothing, got {balls['x'][n].tolist()}"
            f" at index {n} ({int(bad.sum())} in all)"
        )
