"""How a ball moves: velocity and spin, and on a table its position."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.ball import Ball
from carom.checks import LARGEST, Faults, expect, first_index, float_array, require_shapes
from carom.errors import CaromError

__all__ = ["State", "kinetic_energy", "rolling", "slip"]

Array = NDArray[np.float64]


@dataclass(frozen=True, init=False, eq=False)
class State:
    """Velocity and spin of a ball, or of many.

    Parameters
    ----------
    velocity : array (..., 3)
        Velocity of the centre, m/s.
    spin : array (..., 3)
        Angular velocity in the fixed frame, rad/s. The two broadcast.
    position : array (..., 3), optional
        Centre of the ball, m (a ball at rest on the floor has its centre at z = a).
    """

    velocity: Array
    spin: Array
    position: Array | None

    def __init__(
        self, velocity: ArrayLike, spin: ArrayLike = (0.0, 0.0, 0.0), position: ArrayLike | None = None
    ) -> None:
        faults = Faults("State")
        v = vectors(faults, "velocity", velocity, "m/s")
        w = vectors(faults, "spin", spin, "rad/s")
        x = None if position is None else vectors(faults, "position", position, "m")
        faults.done()
        if v.shape != w.shape:
            try:
                v, w = (np.ascontiguousarray(u) for u in np.broadcast_arrays(v, w))
            except ValueError:
                message = f"State: velocity and spin: expected shapes that broadcast, got {v.shape} and {w.shape}"
                raise CaromError(message) from None
        _set(self, v, w, x)

    @classmethod
    def of(cls, velocity: Array, spin: Array, position: Array | None = None) -> State:
        """A state from arrays that need no check (a law's results; NaN where there is no answer)."""
        state = object.__new__(cls)
        _set(state, velocity, spin, position)
        return state

    @property
    def shape(self) -> tuple[int, ...]:
        """Shape without the last axis: () for one state."""
        return self.velocity.shape[:-1]

    def __getitem__(self, index: Any) -> State:
        """The state, or states, at an index of the leading axes."""
        x = None if self.position is None else self.position[index]
        return State.of(self.velocity[index], self.spin[index], x)

    def __eq__(self, other: object) -> bool:
        """The same numbers (NaN equals NaN)."""
        return (
            isinstance(other, State)
            and np.array_equal(self.velocity, other.velocity, equal_nan=True)
            and np.array_equal(self.spin, other.spin, equal_nan=True)
        )

    __hash__ = None  # type: ignore[assignment]


def _set(state: State, velocity: Array, spin: Array, position: Array | None) -> None:
    object.__setattr__(state, "velocity", velocity)
    object.__setattr__(state, "spin", spin)
    object.__setattr__(state, "position", position)


def vectors(faults: Faults, field: str, value: ArrayLike, unit: str, length: int = 3) -> Array:
    """A float array (..., length) of finite numbers; anything else is a fault."""
    try:
        array = float_array(value)
    except (TypeError, ValueError):
        faults.add(field, f"{length} numbers in {unit}, or an array (..., {length}) of them", f"{value!r}")
        return np.zeros(length)
    if array.ndim == 0 or array.shape[-1] != length:
        faults.add(field, f"{length} numbers in {unit}, or an array (..., {length}) of them", f"shape {array.shape}")
        return np.zeros(length)
    bad = ~(np.abs(array) <= LARGEST)  # NaN compares false
    if bad.any():
        where = first_index(bad.any(axis=-1))
        faults.add(field, f"finite numbers in {unit}", f"{float(array[bad].flat[0])!r}{where}")
    return array


def rolling(ball: Ball, velocity: ArrayLike = (-1.0, 1.0), spin_z: ArrayLike = 0.0) -> State:
    """State of a ball that rolls on the floor without sliding.

    Parameters
    ----------
    ball : Ball
    velocity : array (..., 2) or (..., 3)
        Velocity of the centre along the floor, m/s; a third component must be zero.
    spin_z : float or array (...)
        Spin about the vertical, rad/s.

    Returns
    -------
    State, by (27): omega_x = -v_y/a, omega_y = v_x/a.
    """
    expect("rolling", "ball", ball, Ball)
    faults = Faults("rolling")
    try:
        length = np.shape(velocity)[-1]
    except (ValueError, IndexError):
        length = 0
    v = vectors(faults, "velocity", velocity, "m/s", 3 if length == 3 else 2)
    if length == 3 and np.any(v[..., 2] != 0):
        faults.add("velocity", "no vertical component: the ball is on the floor", f"v_z = {v[..., 2].flat[0]!r}")
    wz = vectors(faults, "spin_z", np.asarray(spin_z)[..., None], "rad/s", 1)[..., 0]
    if ball.planar:
        faults.add("ball", "a ball: a disc in the plane has no floor to roll on", "a disc")
    faults.done()
    shape = require_shapes(v.shape[:-1], wz.shape, np.shape(ball.radius))
    velocities, spins = np.zeros((*shape, 3)), np.zeros((*shape, 3))
    velocities[..., :2] = v[..., :2]
    # (27)
    spins[..., 0] = -v[..., 1] / ball.radius
    spins[..., 1] = v[..., 0] / ball.radius
    spins[..., 2] = wz
    return State.of(velocities, spins)


def kinetic_energy(ball: Ball, state: State) -> Any:
    """Kinetic energy (20), J: m v^2/2 + I omega^2/2; a float for one state, an array (...) for many."""
    expect("kinetic_energy", "ball", ball, Ball)
    expect("kinetic_energy", "state", state, State)
    require_shapes(state.shape, np.shape(ball.mass), np.shape(ball.moment))
    v, w = state.velocity, state.spin
    # (20)
    energy = ball.mass * (v * v).sum(axis=-1) / 2 + ball.moment * (w * w).sum(axis=-1) / 2
    return float(energy) if np.ndim(energy) == 0 else energy


def slip(ball: Ball, state: State, normal: ArrayLike = (0.0, 0.0, 1.0)) -> Array:
    """Tangential velocity (..., 3) of the contact point -a n of the ball, m/s; for the floor by default."""
    n = np.asarray(normal, dtype=float)
    require_shapes(state.shape, n.shape[:-1], np.shape(ball.radius))
    a = np.asarray(ball.radius)[..., None]
    v, w = state.velocity, state.spin
    # (24), less its normal part; the product w x n written out, five times as fast as np.cross for one state
    i, k = [1, 2, 0], [2, 0, 1]
    turn = w[..., i] * n[..., k] - w[..., k] * n[..., i]
    result: Array = v - (v * n).sum(axis=-1, keepdims=True) * n - a * turn
    return result
