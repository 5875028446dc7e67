"""Initial states of many points at once, as :class:`carom.SceneBall` makes one."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.errors import MAX_MAGNITUDE, MIN_MAGNITUDE
from carom.laws.strike import Cue, strike
from carom.scene.ball import SceneBall
from carom.scene.paths import PathMatch
from carom.scene.scene import Scene
from carom.simulation.overlaps import overlapping
from carom.simulation.setup import SceneArrays

__all__ = ["START_FIELDS", "start_states"]

Array = NDArray[Any]
# Fields of a ball that its initial state is made from.
START_FIELDS = ("position", "velocity", "spin", "spin_z", "strike")


def start_states(scene: Scene, columns: dict[PathMatch, Array], arrays: SceneArrays) -> NDArray[np.bool_]:
    """Write the initial states of N points into ``arrays.balls`` (N, B); return (N,) which of them a scene may refuse."""
    balls = arrays.balls
    count = len(balls)
    doubtful = np.zeros(count, bool)
    by_ball: dict[int, dict[tuple[str | int, ...], Array]] = {}
    for match, column in columns.items():
        doubtful |= _out_of_range(column)
        for _balls, i, *rest in match.places:
            by_ball.setdefault(int(i), {})[tuple(rest)] = column
    moved = False
    for i, given in by_ball.items():
        ball = scene.balls[i]
        moved |= any(keys[0] == "position" for keys in given)
        _place(ball, given, balls[:, i], doubtful)
        with np.errstate(over="ignore", invalid="ignore"):  # (of numbers out of range, which are doubtful already)
            _set_motion(ball, given, balls[:, i], doubtful)
    if moved:
        doubtful |= overlapping(SceneArrays(arrays.world[:1], arrays.features[0], balls[0], arrays.users), balls)
        places, which = np.unique(balls["x"].reshape(-1, 3), axis=0, return_inverse=True)
        blocked = np.array([any(wall.blocked(tuple(x)) for wall in scene.walls) for x in places.tolist()])
        doubtful |= blocked[which.reshape(balls.shape)].any(axis=1)
    return doubtful


def _out_of_range(column: Array) -> NDArray[np.bool_]:
    size = np.abs(column)
    good = (size == 0) | ((size >= MIN_MAGNITUDE) & (size <= MAX_MAGNITUDE))
    bad: NDArray[np.bool_] = ~good.reshape(len(column), -1).all(axis=1)
    return bad


def _vector(
    given: dict[tuple[str | int, ...], Array], name: tuple[str, ...], base: tuple[float, ...], count: int
) -> Array:
    """Return a vector (N, 3) of the points: as the ball has it, or its columns, whole or by component."""
    found = np.tile(np.array(base, dtype=float), (count, 1))
    for keys, column in given.items():
        if keys == name:
            found[:, : column.shape[1]] = column
        elif keys[:-1] == name and isinstance(keys[-1], int):
            found[:, keys[-1]] = column
    return found


def _place(ball: SceneBall, given: dict[tuple[str | int, ...], Array], rows: Array, doubtful: Array) -> None:
    if not any(keys[0] == "position" for keys in given):
        return
    x, y, *z = ball.position
    # (a scene has given z to a ball with two numbers; two numbers of a column leave it there)
    rows["x"] = _vector(given, ("position",), (x, y, *z), len(rows))
    doubtful |= rows["x"][:, 2] != ball.center[2]  # (off the floor, where not every ball can be)


def _set_motion(ball: SceneBall, given: dict[tuple[str | int, ...], Array], rows: Array, doubtful: Array) -> None:
    count = len(rows)
    names = {str(keys[0]) for keys in given}
    if "strike" in names:
        assert ball.strike is not None
        shot = ball.strike

        def number(name: str, base: float) -> Array:
            return given.get(("strike", name), np.full(count, base))

        offset = _vector(given, ("strike", "offset"), shot.offset, count)
        speed, azimuth = number("speed", shot.speed), number("azimuth", shot.azimuth)
        elevation = number("elevation", shot.elevation)
        bad = ~(speed > 0) | ~((elevation >= 0) & (elevation <= 90)) | ~(np.hypot(offset[:, 0], offset[:, 1]) < 1)
        doubtful |= bad
        good = ~bad
        if good.any():
            state = strike(
                ball.ball, Cue(**dict(shot.cue)), speed[good], azimuth[good], elevation[good], offset[good]
            ).state
            v, w = rows["v"], rows["w"]
            v[good], w[good] = state.velocity, state.spin
        return
    if not names & {"velocity", "spin", "spin_z"}:
        return
    v = _vector(given, ("velocity",), ball.velocity, count)
    if ball.rolling:  # (27)
        spin_z = given.get(("spin_z",), np.full(count, ball.spin_z or 0.0))
        w = np.stack([-v[:, 1] / ball.radius, v[:, 0] / ball.radius, spin_z], axis=1)
        doubtful |= v[:, 2] != 0
    else:
        w = _vector(given, ("spin",), ball.spin or (0.0, 0.0, 0.0), count)
        doubtful |= "spin_z" in names
    rows["v"], rows["w"] = v, w
