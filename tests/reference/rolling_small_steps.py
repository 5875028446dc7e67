"""Rolling by small steps of Newton's and Euler's equations with the contact force solved for, apart from carom's own equations.

The surface is a level set of a function, its normal a central difference; the contact force F follows from the rate of the no-slip
condition v = r omega x n, three linear equations in F. Runge-Kutta of order 4 with a fixed step.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

Array = np.ndarray
STEP = 1e-5


def normal(level: Callable[[Array], float], x: Array) -> Array:
    """The unit gradient of a function by central differences of order 4."""
    gradient = np.empty(3)
    for i in range(3):
        h = np.eye(3)[i] * STEP
        gradient[i] = (8 * (level(x + h) - level(x - h)) - (level(x + 2 * h) - level(x - 2 * h))) / (12 * STEP)
    return gradient / np.linalg.norm(gradient)


def rates(level: Callable[[Array], float], state: Array, r: float, kappa: float, gravity: Array) -> Array:
    """The time derivative of (centre, velocity, angular velocity), all forces for a mass of 1."""
    x, v, omega = state[:3], state[3:6], state[6:]
    n = normal(level, x)
    forward, back = normal(level, x + 1e-4 * v), normal(level, x - 1e-4 * v)
    dn = (forward - back) / 2e-4

    def violation(force: Array) -> Array:
        dv = gravity + force
        domega = np.cross(-r * n, force) / (kappa * r * r)
        return dv - r * np.cross(domega, n) - r * np.cross(omega, dn)

    at_rest = violation(np.zeros(3))
    matrix = np.stack([violation(e) - at_rest for e in np.eye(3)], axis=1)
    force = np.linalg.solve(matrix, -at_rest)
    return np.concatenate([v, gravity + force, np.cross(-r * n, force) / (kappa * r * r)])


def follow(
    level: Callable[[Array], float], state: Array, r: float, kappa: float, gravity: Array, duration: float, steps: int
) -> Array:
    """Return the state after some steps; ``level`` is the distance of the centre from the surface or any function of it."""
    h = duration / steps
    for _ in range(steps):
        k1 = rates(level, state, r, kappa, gravity)
        k2 = rates(level, state + h / 2 * k1, r, kappa, gravity)
        k3 = rates(level, state + h / 2 * k2, r, kappa, gravity)
        k4 = rates(level, state + h * k3, r, kappa, gravity)
        state = state + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
    return state
