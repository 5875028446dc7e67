"""Convert a scene to the arrays that the event loop works on."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.core.geometry.circles import rim_address
from carom.core.geometry.curve_features import arc_address
from carom.core.geometry.features import CURVE, RIM
from carom.laws.callbacks import user_address
from carom.laws.law import CALLED_WALL, CONTACT_WALL
from carom.scene.scene import Scene
from carom.simulation.records import BALLS, WORLD

__all__ = ["SceneArrays", "set_up"]


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
