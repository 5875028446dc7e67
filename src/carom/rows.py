"""From what people hand in to rows for the loops: balls, states, normals and surfaces broadcast against each other."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.ball import Ball
from carom.checks import LARGEST, expect, first_index, float_array, require_shapes
from carom.errors import CaromError
from carom.laws.landing import ROUNDING
from carom.state import State

__all__ = ["Rows", "approaching", "require_approach", "rows_of", "unit_normal"]

Array = NDArray[np.float64]


def unit_normal(normal: ArrayLike) -> Array:
    """Unit normals (..., 3) of surfaces, from vectors of any length; CaromError where one has none."""
    try:
        n = float_array(normal)
    except (TypeError, ValueError):
        raise CaromError(f"normal: expected 3 numbers, or an array (..., 3) of them, got {normal!r}") from None
    if n.ndim == 0 or n.shape[-1] != 3:
        raise CaromError(f"normal: expected 3 numbers, or an array (..., 3) of them, got shape {n.shape}")
    if n.ndim == 1:  # one normal, without arrays
        x, y, z = n.tolist()
        length = math.sqrt(x * x + y * y + z * z)
        if length == 1:
            return n
        if 0 < length <= LARGEST:
            return n / length
    with np.errstate(over="ignore", invalid="ignore"):
        lengths = np.sqrt((n * n).sum(axis=-1, keepdims=True))
    bad = ~((lengths > 0) & (lengths <= LARGEST))[..., 0]
    if bad.any():
        got = n[bad][0] if n.ndim > 1 else n
        raise CaromError(
            f"normal: expected a vector that points from the wall to the ball, got {got.tolist()}{first_index(bad)};"
            " for the wall x = 0 with the ball at x > 0 it is (1, 0, 0)"
        )
    unit: Array = n / lengths
    return unit


@dataclass(frozen=True)
class Rows:
    """N rows: velocities and spins (N, 3), normals (N or 1, 3), parameters (N or 1, K), and the shape they came in."""

    shape: tuple[int, ...]
    velocity: Array
    spin: Array
    normal: Array
    parameters: Array

    @property
    def count(self) -> int:
        """N."""
        return len(self.velocity)

    @property
    def uniform(self) -> bool:
        """Whether one normal and one set of parameters serve all rows."""
        return len(self.normal) == 1 and len(self.parameters) == 1


def rows_of(state: State, normal: Array, *parameters: Any) -> Rows:
    """Broadcast a state, unit normals and numbers; numbers that are the same for all stay a single row."""
    v, w = state.velocity, state.spin
    if v.ndim == 1 and normal.ndim == 1 and all(type(x) is float for x in parameters):
        return Rows((), v[None], w[None], normal[None], np.array([parameters]))
    shape = require_shapes(state.shape, normal.shape[:-1], *(np.shape(x) for x in parameters))
    count = math.prod(shape)

    def spread(array: Array) -> Array:
        return np.ascontiguousarray(np.broadcast_to(array, (*shape, 3))).reshape(count, 3)

    if all(np.ndim(x) == 0 for x in parameters):
        p = np.array([[float(x) for x in parameters]])
    else:
        p = np.ascontiguousarray(np.stack([np.broadcast_to(x, shape).reshape(count) for x in parameters], axis=-1))
    return Rows(shape, spread(v), spread(w), normal[None] if normal.ndim == 1 else spread(normal), p)


def approaching(state: State, normal: Array) -> Any:
    """Mask (...): where a ball does not move away from the wall, u_n <= 0, by more than the rounding of a turned normal."""
    require_shapes(state.shape, normal.shape[:-1])
    v = state.velocity
    return np.asarray((v * normal).sum(axis=-1) <= ROUNDING * np.abs(v).sum(axis=-1))


def require_approach(ball: Ball, state: State, normal: Array) -> None:
    """CaromError where a ball moves away from the wall, or a disc leaves its plane, or one is not the other."""
    expect("law", "ball", ball, Ball)
    expect("law", "state", state, State)
    if state.velocity.ndim == 1 and normal.ndim == 1:
        x, y, z = state.velocity.tolist()
        nx, ny, nz = normal.tolist()
        away = np.asarray(not x * nx + y * ny + z * nz <= ROUNDING * (abs(x) + abs(y) + abs(z)))
    else:
        away = ~approaching(state, normal)
    if away.any():
        speed = float(np.broadcast_to((state.velocity * normal).sum(axis=-1), away.shape)[away].flat[0])
        raise CaromError(
            f"state: expected a ball that moves towards the wall, got {speed:.6g} m/s away from it{first_index(away)};"
            " the normal points from the wall to the ball"
        )
    if ball.planar:
        out = (state.velocity[..., 2] != 0) | (state.spin[..., :2] != 0).any(axis=-1)
        if np.any(out) or np.any(normal[..., 2] != 0):
            raise CaromError(
                "state: expected a disc in the plane z = 0 (v_z = 0, spin along z, a wall that stands on the plane),"
                f" got something else{first_index(np.asarray(out)) if np.any(out) else ' for the normal'}; use carom.Ball in space"
            )
