"""A ball that rolls without slipping on a surface, leaves it, flies, and lands on it again.

With the ball's angular velocity as an antisymmetric matrix W (W y = omega x y), the
normal n from the contact point to the centre x, and the ball's radius r:

    v = r W n                                            no slip at the contact point                            (R1)
    T = W - (v n' - n v')/r                              the spin about the normal: T n = 0                       (R2)
    (1 + kappa) dv/dt = a + kappa r T dn/dt              along the surface, a the force's acceleration there      (R3)
    kappa r dW/dt = -(f n' - n f'),  f = dv/dt - a       the torque of the friction, f its acceleration           (R4)
    N/m = -v . dn/dt - g . n                             the surface's force; the ball leaves where it is 0       (R5)

(R3) is (R4) applied to n, with (R1) and (R2); Borisov, Mamaev & Kilin, Regul. Chaotic Dyn. 7, 201 (2002) and Cox, Feres & Zhao,
arXiv 2009.05890, have the same equations. SciPy's DOP853 integrates x and W.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.billiards.surfaces import SmoothPiece
from carom.bodies import Ball

__all__ = ["Rolling", "RollingMotion", "spin_matrix", "spin_vector"]

Array = NDArray[np.float64]


class Rolling(NamedTuple):
    """The state of a ball on a surface and the forces on it, from :meth:`RollingMotion.forces`."""

    normal: Array
    velocity: Array
    """m/s."""
    turn: Array
    """dn/dt (1/s)."""
    acceleration: Array
    """Of the centre, along the surface (m/s^2)."""
    friction: Array
    """Friction over the mass (m/s^2)."""
    pressure: float
    """The surface's force over the mass (m/s^2)."""


class RollingMotion:
    """Equations (R1) to (R5) for one ball on one smooth piece of a surface; the state is x and W in one vector."""

    def __init__(self, piece: SmoothPiece, ball: Ball, gravity: Array) -> None:
        self.piece, self.gravity = piece, gravity
        self.radius, self.kappa = float(ball.radius), float(ball.kappa)

    def forces(self, state: Array) -> Rolling:
        """Return the velocity, the acceleration and the forces of a state."""
        x, w = self.place_and_spin(state)
        n = self.piece.normal(x)
        # (R1)
        v = self.radius * (w @ n)
        turn = self.piece.turn(x, n, v)
        # (R2)
        products = v[:, None] * n
        about = w - (products - products.T) / self.radius
        along = self.gravity - n * (n @ self.gravity)
        # (R3)
        acceleration = (along + self.kappa * self.radius * (about @ turn)) / (1.0 + self.kappa)
        # (R5)
        pressure = float(-(v @ turn) - self.gravity @ n)
        return Rolling(n, v, turn, acceleration, acceleration - along, pressure)

    def rates(self, _: float, state: Array) -> Array:
        """Return the time derivative of a state."""
        now = self.forces(state)
        # (R4)
        turning = now.normal[:, None] * now.friction
        return np.concatenate([now.velocity, ((turning - turning.T) / (self.kappa * self.radius)).ravel()])

    def energy(self, state: Array) -> float:
        """Return the energy over the mass (m^2/s^2); heights count from the origin."""
        x, w = self.place_and_spin(state)
        v = self.radius * (w @ self.piece.normal(x))
        return float(0.5 * (v @ v) + 0.25 * self.kappa * self.radius**2 * np.sum(w * w) - self.gravity @ x)

    def corrected(self, state: Array, energy: float) -> Array:
        """Return a state with the centre at the ball's radius from the surface and with the given energy: no drift."""
        x, w = self.place_and_spin(state)
        x = x - (self.piece.distance(x) - self.radius) * self.piece.normal(x)
        state = np.concatenate([x, w.ravel()])
        has, wanted = self.energy(state) + self.gravity @ x, energy + self.gravity @ x
        return np.concatenate([x, (math.sqrt(wanted / has) * w).ravel()]) if has > 0 and wanted > 0 else state

    def place_and_spin(self, state: Array) -> tuple[Array, Array]:
        """Split a state into the place of the centre and the matrix of the spin."""
        return state[:3], state[3:12].reshape(3, 3)


def spin_matrix(spin: ArrayLike) -> Array:
    """Return the matrix of an angular velocity in space: W y = spin x y."""
    x, y, z = np.asarray(spin, dtype=float)
    return np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])


def spin_vector(matrix: Array) -> Array:
    """Return the angular velocity of a matrix, of shape (..., 3, 3)."""
    return np.stack([matrix[..., 2, 1], matrix[..., 0, 2], matrix[..., 1, 0]], axis=-1)
