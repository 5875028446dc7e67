"""From a scene to what the event loop works on."""

from __future__ import annotations

import weakref
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.engine.arrays import BALLS, WORLD
from carom.engine.users import user_address
from carom.scene.features import RIM
from carom.scene.model import Scene
from carom.scene.rims import rim_address

__all__ = ["Setup", "set_up"]


class Setup(NamedTuple):
    """A scene as arrays."""

    world: NDArray[np.void]
    """(1,) of WORLD."""
    features: NDArray[np.void]
    """(F,) of FEATURES."""
    balls: NDArray[np.void]
    """(B,) of BALLS, at the start."""
    users: NDArray[np.int64]
    """Addresses of laws that are not compiled in, in the order of ``scene.own_laws``."""


# The arrays of scenes that are alive: a run of a shot takes less time than making them. (Not kept in the scene itself, whose
# copies with other walls would take them along.)
_kept: dict[int, tuple[weakref.ref[Scene], Setup, bytes]] = {}


def set_up(scene: Scene) -> Setup:
    """The arrays of a scene; those of the balls are made anew, for a run changes them."""
    key = id(scene)
    found = _kept.get(key)
    if found is None or found[0]() is not scene:
        made = _set_up(scene)
        found = weakref.ref(scene, lambda _gone: _kept.pop(key, None)), made, made.balls.tobytes()
        _kept[key] = found
    world, features, _balls, users = found[1]
    # (from bytes: NumPy copies the fields of records one by one)
    return Setup(world, features, np.frombuffer(bytearray(found[2]), BALLS), users)


def _set_up(scene: Scene) -> Setup:
    world = np.zeros(1, WORLD)
    world["force"] = scene.gravity
    floor = scene.floor
    if floor is not None:
        world["floor"], world["g"] = 1, -scene.gravity[2]
        _surface(world, "floor", floor.contact)
        world["resistance"], world["spin_friction"] = floor.rolling_resistance, floor.spin_friction
    _surface(world, "pair", scene.ball_contact.contact)
    world["together"] = scene.run.floor_contact == "with"
    balls = np.zeros(len(scene.balls), BALLS)
    for row, ball in zip(balls, scene.balls, strict=True):
        state = ball.state
        row["radius"], row["mass"], row["kappa"] = ball.radius, ball.mass, ball.ball.kappa
        row["x"], row["v"], row["w"] = ball.center, state.velocity, state.spin
    kernels = [law.compliant or law.kernel for law in scene.own_laws]
    users = [user_address(kernel) for kernel in kernels if kernel is not None]
    features = scene.features()
    rims = features["kind"] == RIM
    if rims.any():
        features["at"][rims] = rim_address()
    return Setup(world, features, balls, np.array(users, dtype=np.int64))


def _surface(world: Any, name: str, contact: Any) -> None:
    for field, value in zip(("form", "p", "mu", "beta"), contact, strict=True):
        world[f"{name}_{field}"] = value
