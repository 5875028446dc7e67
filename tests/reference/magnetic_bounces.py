"""Bounces of a disc in a magnetic field by small steps: SciPy's DOP853 on the equation of motion, walls as events of the solver.

Independent of carom: tables by functions that are zero on a wall and positive inside, their gradients as normals, and the laws'
own statements. The velocity turns counterclockwise at the angular velocity ``field``.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp

__all__ = ["WALLS", "bounces"]

Array = Any
TOL = 1e-13


def circle(x: float, y: float, r: float = 1.0, cx: float = 0.0, cy: float = 0.0, side: float = 1.0) -> float:
    return side * (r - math.hypot(x - cx, y - cy))


def ellipse(x: float, y: float, p: float, q: float) -> float:
    return 1.0 - (x / p) ** 2 - (y / q) ** 2


def inset_ellipse(x: float, y: float, p: float, q: float, a: float) -> float:
    """Distance from an ellipse by the nearest of its points, less a: Newton's method for the angle from several."""
    best = math.inf
    for start in np.linspace(0, math.tau, 9)[:-1]:
        u = start
        for _ in range(50):
            c, s = math.cos(u), math.sin(u)
            f = (p * c - x) * -p * s + (q * s - y) * q * c
            d = p * p * s * s + q * q * c * c - (p * c - x) * p * c - (q * s - y) * q * s
            u -= max(-0.5, min(0.5, f / d if d > 0 else math.copysign(0.5, f)))
        best = min(best, math.hypot(p * math.cos(u) - x, q * math.sin(u) - y))
    return (best if (x / p) ** 2 + (y / q) ** 2 < 1 else -best) - a


def stadium(x: float, y: float) -> float:
    return 1.0 - math.hypot(max(abs(x) - 1.0, 0.0), y)


def polar(x: float, y: float) -> float:
    """r = 1 + 0.2 cos 3 theta, which has inflections."""
    return 1.0 + 0.2 * math.cos(3 * math.atan2(y, x)) - math.hypot(x, y)


def triangle(k: int) -> Callable[[float, float], float]:
    """Side k of the equilateral triangle in the unit circle."""
    angle = math.radians(-90.0 + 120.0 * k)
    return lambda x, y: 0.5 - x * math.cos(angle) - y * math.sin(angle)


# Walls as functions of the place, and the cell whose sides are passed (none: math.inf).
WALLS: dict[str, tuple[Sequence[Callable[[float, float], float]], float]] = {
    "circle": ([circle], math.inf),
    "ellipse": ([lambda x, y: ellipse(x, y, 1.0, 0.8)], math.inf),
    "inset ellipse": ([lambda x, y: inset_ellipse(x, y, 1.0, 0.8, 0.3)], math.inf),
    "triangle": ([triangle(0), triangle(1), triangle(2)], math.inf),
    "stadium": ([stadium], math.inf),
    "curve": ([polar], math.inf),
    "sinai": ([lambda x, y: circle(x, y, 0.3, side=-1.0)], 1.0),
}


def normal(wall: Callable[[float, float], float], x: float, y: float, h: float = 3e-4) -> Array:
    """Return the unit normal towards the inside, by differences of fourth order."""
    found = [
        8 * (wall(x + h * a, y + h * b) - wall(x - h * a, y - h * b)) - wall(x + 2 * h * a, y + 2 * h * b)
        + wall(x - 2 * h * a, y - 2 * h * b) for a, b in ((1, 0), (0, 1))
    ]  # fmt: skip
    return np.array(found) / math.hypot(*found)


def bounces(name: str, state: Sequence[float], field: float, count: int, kappa: float, law: str) -> Array:
    """Return (count, 6): time, place, velocity and a omega just after each bounce of a disc; places go on through cells."""
    walls, cell = WALLS[name]
    x, y, u, v, w = state
    t, found = 0.0, []

    def folded(z: float) -> float:
        return z if cell == math.inf else z - cell * round(z / cell)

    def event(wall: Callable[[float, float], float]) -> Callable[[float, Array], float]:
        def gap(_t: float, z: Array) -> float:
            return wall(folded(z[0]), folded(z[1]))

        gap.terminal, gap.direction = True, -1.0  # type: ignore[attr-defined]
        return gap

    for _ in range(count):
        speed = math.hypot(u, v)
        run = solve_ivp(
            lambda _t, z: (z[2], z[3], -field * z[3], field * z[2]), (0.0, math.tau / abs(field)), (x, y, u, v), "DOP853",
            rtol=TOL, atol=TOL, max_step=0.02 / speed, events=[event(one) for one in walls],
        )  # fmt: skip
        when, k = min((hit[0], k) for k, hit in enumerate(run.t_events) if len(hit))
        x, y, u, v = run.y_events[k][0]
        t += when
        nx, ny = normal(walls[k], folded(x), folded(y))
        # the tangent (ny, -nx): the contact point at -a n moves along it with v_t + a omega
        across, along = u * nx + v * ny, u * ny - v * nx
        impulse = -2 * kappa / (1 + kappa) * (along + w) if law == "no-slip" else 0.0
        along, w, across = along + impulse, w + impulse / kappa, -across
        u, v = across * nx + along * ny, across * ny - along * nx
        found.append((t, x, y, u, v, w))
    return np.array(found)
