"""A ball on a tilted floor at a straight wall, in small steps: both push as damped springs and rub by Coulomb's law.

Nothing rigid, no impact, no contact that stays by decree: forces at two points of a body with six degrees of freedom, whose
friction turns round over a speed ``creep``. The stiffer the springs and the smaller that speed, the nearer the limit.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy.integrate import solve_ivp

Array = np.ndarray
UP = np.array([0.0, 0.0, 1.0])


@dataclass(frozen=True)
class Leaning:
    """The ball, the floor and the wall; accelerations instead of forces."""

    radius: float
    kappa: float
    force: Array
    """Acceleration in flight (3,), the floor's normal upwards."""
    floor: tuple[float, float]
    """Restitution and friction."""
    wall: tuple[float, float]
    point: Array
    normal: Array
    resistance: float = 0.0
    """Deceleration of a ball that rolls, over g."""
    spin_friction: float = 0.0
    frequency: float = 2e4
    """1/s: root of stiffness over mass, of both springs."""
    creep: float = 2e-5

    def _push(self, depth: float, rate: float, restitution: float) -> float:
        """Return the force of a spring that returns the share e of the speed: e = exp(-pi z / sqrt(1 - z^2))."""
        if depth <= 0:
            return 0.0
        log = math.log(max(restitution, 1e-3))
        z = -log / math.hypot(math.pi, log)
        return max(0.0, self.frequency**2 * depth + 2 * z * self.frequency * rate)

    def slope(self, _t: float, y: Array) -> Array:
        """Return the derivatives of place, velocity and spin."""
        x, v, w = y[:3], y[3:6], y[6:]
        acc, turn = self.force.copy(), np.zeros(3)
        for n, p, (e, mu) in ((UP, np.zeros(3), self.floor), (self.normal, self.point, self.wall)):
            push = self._push(self.radius - (x - p) @ n, -v @ n, e)
            u = v + np.cross(w, -self.radius * n)
            u -= (u @ n) * n
            rub = -mu * push * u / math.sqrt(u @ u + self.creep**2)
            acc += push * n + rub
            turn += np.cross(-self.radius * n, rub)
            if n is UP:
                level = np.array([w[0], w[1], 0.0])
                # (what slides has no resistance to rolling)
                slow = self.resistance * push * (1 + self.kappa) * math.exp(-(u @ u) / (10 * self.creep) ** 2)
                turn -= self.radius * slow * level / math.sqrt(level @ level + (self.creep / self.radius) ** 2)
                turn[2] -= self.radius * self.spin_friction * push * w[2] / math.hypot(w[2], self.creep / self.radius)
        return np.concatenate([v, acc, turn / (self.kappa * self.radius**2)])

    def states(self, start: Array, times: Array) -> Array:
        """Return place, velocity and spin (T, 9) at times from a start (9,)."""
        run = solve_ivp(
            self.slope, (times[0], times[-1]), start, "LSODA", t_eval=times, rtol=1e-7, atol=1e-10, max_step=2e-3
        )
        assert run.success
        return run.y.T
