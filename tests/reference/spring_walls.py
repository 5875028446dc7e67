"""A body with constraints against a stiff spring in the place of a wall: its equations of motion with multipliers, integrated.

Apart from carom.derive: no momentum that jumps, no restitution. The force of the spring acts along the gradient of the gap; the
constraints A(q) u = 0 hold throughout, their forces from the multipliers of M du/dt = force + A^T mu with A du/dt = -(dA/dt) u.
The stiffer the spring, the nearer the speeds afterwards are to the limit; their error falls as 1/sqrt(stiffness).
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from scipy.integrate import solve_ivp

Array = np.ndarray


def after_spring(
    mass: Array,
    rates: Callable[[Array, Array], Array],
    constraints: Callable[[Array], Array],
    gap: Callable[[Array], tuple[float, Array]],
    start: tuple[Array, Array],
    stiffness: float,
) -> Array:
    """Return the speeds after the contact with a spring of a stiffness, N/m.

    ``rates(q, u)`` is dq/dt; ``constraints(q)`` the rows (C, n) of A; ``gap(q)`` the distance and its derivatives (n) by the
    displacements that belong to the speeds. The start (q, u) touches the spring and approaches.
    """
    q0, u0 = start
    count, step = len(q0), 1e-6

    def slope(_t: float, y: Array) -> Array:
        q, u = y[:count], y[count:]
        a = constraints(q)
        speed = rates(q, u)
        da = (constraints(q + step * speed) - constraints(q - step * speed)) / (2 * step)
        distance, along = gap(q)
        force = stiffness * max(0.0, -distance) * along
        table = np.block([[mass, -a.T], [a, np.zeros((len(a), len(a)))]])
        return np.concatenate([speed, np.linalg.solve(table, np.concatenate([force, -da @ u]))[: len(u)]])

    def leaves(_t: float, y: Array) -> float:
        return gap(y[:count])[0]

    leaves.terminal, leaves.direction = True, 1
    longest = 20 / np.sqrt(stiffness / mass.diagonal().max())
    run = solve_ivp(slope, (0, longest), np.concatenate([q0, u0]), "DOP853", events=leaves, rtol=1e-10, atol=1e-12)
    assert len(run.t_events[0]) == 1, "the body does not leave the spring"
    return run.y_events[0][0, count:]
