"""A ball in air by SciPy's DOP853: the equation of motion written down anew, without a line of carom's."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

Coefficient = Callable[[float, float], float]


def air_path(
    times: Any, x: Any, v: Any, w: Any, *, radius: float, mass: float, density: float, wind: Any = (0, 0, 0),
    gravity: Any = (0, 0, -9.80665), drag: Coefficient = lambda s, ratio: 0.0, lift: Coefficient = lambda s, ratio: 0.0,
    spin_decay: float = 0.0, buoyancy: bool = False, tolerance: float = 1e-12, events: Any = None,
) -> Any:  # fmt: skip
    """Return the solution of SciPy (rows of ``y``: position, velocity, spin) at times; ``drag`` and ``lift`` of speed and ratio."""
    force = air_force(
        radius=radius, mass=mass, density=density, wind=wind, gravity=gravity, drag=drag, lift=lift, spin_decay=spin_decay,
        buoyancy=buoyancy,
    )  # fmt: skip

    def rates(_t: float, y: NDArray[np.float64]) -> NDArray[np.float64]:
        return np.concatenate([y[3:6], *force(y[3:6], y[6:])])

    start = np.concatenate([np.asarray(one, float) for one in (x, v, w)])
    times = np.atleast_1d(np.asarray(times, float))
    return solve_ivp(
        rates, (0.0, float(times[-1])), start, "DOP853", times, rtol=max(tolerance, 3e-14), atol=tolerance * 1e-2, events=events
    )  # fmt: skip


def air_force(
    *, radius: float, mass: float, density: float, wind: Any = (0, 0, 0), gravity: Any = (0, 0, -9.80665),
    drag: Coefficient = lambda s, ratio: 0.0, lift: Coefficient = lambda s, ratio: 0.0, spin_decay: float = 0.0,
    buoyancy: bool = False,
) -> Any:  # fmt: skip
    """Return a function of velocity and spin: acceleration and angular acceleration in flight."""
    blown, pull = np.array(wind, float), np.array(gravity, float)
    area, volume = math.pi * radius**2, 4 / 3 * math.pi * radius**3
    weight = 1 - density * volume / mass if buoyancy else 1.0

    def rates(v: Any, spin: Any) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        u = v - blown
        s, size = float(np.linalg.norm(u)), float(np.linalg.norm(spin))
        force = np.zeros(3)
        if s > 0:
            ratio = radius * size / s
            force = -0.5 * density * area * drag(s, ratio) * s * u
            if size > 0:
                force = force + 0.5 * density * area * lift(s, ratio) * s * np.cross(spin / size, u)
        return weight * pull + force / mass, -spin_decay * s / radius * spin

    return rates
