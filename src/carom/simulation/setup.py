"""Convert a scene to the arrays that the event loop works on."""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.bodies import vectors
from carom.core.geometry.circles import rim_address
from carom.core.geometry.curve_arcs import arc_address
from carom.core.geometry.features import CURVE, OVER, RIM, gap_to_feature
from carom.core.jit.kernel import vector
from carom.core.jit.threads import row_slices
from carom.errors import CaromError, FaultList
from carom.laws.callbacks import user_address
from carom.laws.law import CALLED_WALL, CONTACT_WALL
from carom.scene.air import balls_in_air
from carom.scene.scene import Scene
from carom.scene.scene_rules import BALLS_TOUCH, TOUCH
from carom.simulation.records import BALLS, WORLD


class SceneArrays(NamedTuple):
    """A scene as arrays of records."""

    world: NDArray[np.void]
    """(1,) of WORLD."""
    features: NDArray[np.void]
    """(F,) of FEATURES."""
    balls: NDArray[np.void]
    """(B,) of BALLS, at the start; read-only where they belong to a scene."""
    users: NDArray[np.int64]
    """Addresses of laws that are not compiled in, in the order of ``scene.called_laws``."""

    def balls_to_move(self) -> NDArray[np.void]:
        """Return a copy of the balls, which a run changes."""
        # (from bytes: NumPy copies the fields of records one by one)
        return np.frombuffer(bytearray(self.balls.tobytes()), BALLS)

    def for_runs(self, count: int) -> SceneArrays:
        """Return the same world and features, and the balls of ``count`` runs, (count, B)."""
        return self._replace(balls=np.tile(self.balls, (count, 1)))


def set_up(scene: Scene, compiled: bool = True) -> SceneArrays:
    """Return the arrays of a scene. The scene keeps them: a run of a shot takes less time than making them.

    With ``compiled`` false nothing is compiled but laws of the user's, and only Python can run the event loop on these arrays.
    """
    key = "compiled arrays" if compiled else "arrays"
    if key not in scene.kept:
        scene.kept[key] = _set_up(scene, compiled)
    found: SceneArrays = scene.kept[key]
    return found


def _set_up(scene: Scene, compiled: bool) -> SceneArrays:
    world = np.zeros(1, WORLD)
    world["force"] = scene.pull
    floor = scene.floor
    if floor is not None:
        world["floor"], world["g"] = 1, -scene.pull[2]
        _surface(world, "floor", floor.contact)
        world["resistance"], world["spin_friction"] = floor.rolling_resistance, floor.spin_friction
        for name in ("rolling_drag", "spin_damping", "spin_drag"):
            world[name] = getattr(floor, name)
    in_air, rows = balls_in_air(scene) if scene.air is not None else ([], [])
    if scene.air is not None:
        world["wind"], world["laws"][0, : 8 * len(rows)] = scene.air.wind, np.ravel(rows)
    law = scene.pair_law
    _surface(world, "pair", scene.ball_contact.contact_of(law))
    world["pair_law"] = CONTACT_WALL if law.one_contact else CALLED_WALL + scene.called_laws.index(law)
    world["pair_mu"], world["pair_drop"], world["pair_rate"] = scene.ball_contact.friction_of(law)
    world["pair_modulus"] = scene.ball_contact.modulus
    world["together"] = scene.run.floor_contact == "with"
    balls = np.zeros(len(scene.balls), BALLS)
    for row, ball in zip(balls, scene.balls, strict=True):
        state = ball.state
        row["radius"], row["mass"], row["kappa"] = ball.radius, ball.mass, ball.ball.kappa
        row["x"], row["v"], row["w"] = ball.center, state.velocity, state.spin
    for row, ball, own in zip(balls if in_air else (), scene.balls, in_air, strict=False):
        row["air"], row["buoyancy"], row["spin_decay"] = own.strength, own.buoyancy, ball.spin_decay
        for name in ("drag", "lift"):
            row[name], row[f"{name}_last"] = getattr(own, name)
        if not any(any(one[2:]) for k in (own.drag, own.lift) for one in rows[k[0] : k[1] + 1]):
            row["air"] = 0
    kernels = [law.kernel for law in scene.called_laws]
    users = [user_address(kernel, compiled) for kernel in kernels if kernel is not None]
    features = scene.features()
    rims = features["kind"] == RIM
    if rims.any():
        features["at"][rims] = rim_address(compiled)
    curves = features["kind"] == CURVE
    if curves.any():
        features["at"][curves] = arc_address(compiled)
    balls.flags.writeable = False
    return SceneArrays(world, features, balls, np.array(users, dtype=np.int64))


def _surface(world: Any, name: str, contact: Any) -> None:
    for field, value in zip(("form", "p", "mu", "beta"), contact, strict=True):
        world[f"{name}_{field}"] = value


# ----------------------------------------------------------------------------------------------------
# Find which of many initial states overlap a wall, the floor, or each other.


def _overlaps(worlds: Any, features: Any, balls: Any, bad: Any) -> None:
    for n in range(balls.shape[0]):
        for i in range(balls.shape[1]):
            ball = balls[n, i]
            x, a = vector(ball.x), ball.radius
            if worlds[0].floor != 0 and x[2] < a * (1 - TOUCH):
                bad[n] = True
            for f in range(features.shape[0]):
                # (a gap below -a: the ball is behind a face, which may be the back of another)
                if features[f].kind != OVER and -a < gap_to_feature(features[f], a, x) < -TOUCH * a:
                    bad[n] = True
            for k in range(i):
                other = balls[n, k]
                reach = a + other.radius - BALLS_TOUCH * min(a, other.radius)
                r = (x[0] - other.x[0], x[1] - other.x[1], x[2] - other.x[2])
                if r[0] * r[0] + r[1] * r[1] + r[2] * r[2] < reach * reach:
                    bad[n] = True


@functools.cache
def _compiled() -> Callable[..., None]:
    from carom.core.jit.compile import njit

    return njit(_overlaps)


def overlapping(setup: SceneArrays, balls: NDArray[np.void]) -> NDArray[np.bool_]:
    """Return (N,) which of the initial states ``balls`` (N, B) overlap a wall, the floor, or each other, by more than touches."""
    bad = np.zeros(len(balls), dtype=bool)
    check = _compiled()
    for rows in row_slices(len(balls), 1024):
        check(setup.world, setup.features, balls[rows], bad[rows])
    return bad


# ----------------------------------------------------------------------------------------------------
# Initial states of many runs of a scene: the scene's balls with the states that are given, checked.


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
    shape: tuple[int, ...] = (1, count := len(arrays.balls))
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
    walls = [(wall.kernels.blocked, wall.numbers) for wall in scene.walls]
    blocked = np.array([any(check(numbers, x) for check, numbers in walls) for x in map(tuple, places.tolist())])
    bad |= blocked[which.reshape(balls.shape)].any(axis=1)
    if bad.any():
        n = int(np.flatnonzero(bad)[0])
        raise CaromError(
            f"{where}: position: expected places where the balls touch nothing, got {balls['x'][n].tolist()}"
            f" at index {n} ({int(bad.sum())} in all)"
        )
