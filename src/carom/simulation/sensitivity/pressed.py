"""The derivative of an impact of wall and floor at once, whose kernel is an integrator with iterations.

Its steps and the ends of its slips are found by iteration, through which a derivative would not pass (the last steps of an
iteration do not know on what the answer depends). So the kernel is differenced as a whole, with order 8, along each parameter. The
integrator keeps 1e-9 of the speeds; the steps are some 1 %, so that some 1e-7 is left.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from carom.laws.wall_and_floor.solver import pressed_down
from carom.simulation.sensitivity.dual import Dual, value
from carom.simulation.wall_and_floor import joint_impact

__all__ = ["differenced_joint_impact"]

CENTRAL = ((1, 4 / 5), (2, -1 / 5), (3, 4 / 105), (4, -1 / 280))
# Share of the motion by which a stencil reaches to both sides; where the regime changes within, a quarter, and so on.
REACH, SMALLEST = 0.02, 1e-7


def _flat(arguments: Any) -> list[Any]:
    return [one for part in arguments for one in (part if isinstance(part, tuple) else (part,))]


def _call(z: Any, together: bool) -> Any:
    v, w, n = ((z[i], z[i + 1], z[i + 2]) for i in (0, 3, 6))
    a, kappa, e, mu, beta, floor_e, floor_mu, floor_beta = z[9:]
    return joint_impact(v, w, n, a, kappa, e, mu, beta, floor_e, floor_mu, floor_beta, together)


def _slope(z: list[float], d: Any, base: Any, together: bool) -> Any:
    """Return the derivative of velocity, spin, impulses and required friction (13,) in the direction d."""
    a = z[9]
    speed = math.sqrt(sum(x * x for x in z[:3])) + a * math.sqrt(sum(x * x for x in z[3:6]))
    sizes = [speed] * 3 + [speed / a] * 3 + [1.0] * 3 + [abs(x) if 0 < abs(x) < math.inf else 1.0 for x in z[9:]]
    share = float(np.max(np.abs(d) / np.array(sizes)))
    if share == 0:
        return np.zeros(13)
    reach = REACH
    while reach > SMALLEST:
        h, slope = reach / (4 * share), np.zeros(13)
        for k, c in CENTRAL:
            ends = []
            for step in (k * h, -k * h):
                found = _call([x + step * float(dx) if dx else x for x, dx in zip(z, d, strict=True)], together)
                if found[5] != base[5]:
                    break
                ends.append(np.array(_flat(found[:5])))
            if len(ends) < 2:
                break
            slope += c / h * (ends[0] - ends[1])
        else:
            return slope
        reach /= 4
    return np.full(13, np.nan)


def differenced_joint_impact(plain: Any, *arguments: Any) -> Any:
    """Return :func:`carom.simulation.wall_and_floor.joint_impact` of dual numbers; ``plain`` is what duals pass through."""
    together = bool(arguments[-1])
    numbers = _flat(arguments[:-1])
    z = [float(value(x)) for x in numbers]
    p = max((len(x.d) for x in numbers if isinstance(x, Dual)), default=0)
    v, w, n = ((z[i], z[i + 1], z[i + 2]) for i in (0, 3, 6))
    if p == 0 or not (together and pressed_down(v, w, n, z[9], z[12], 0.0)):
        return plain(*arguments)
    base = _call(z, together)
    d = np.array([x.d if isinstance(x, Dual) else np.zeros(p) for x in numbers])
    slopes = np.stack([_slope(z, d[:, k], base, together) for k in range(p)], axis=-1)
    out = [Dual(float(x), slope) for x, slope in zip(_flat(base[:5]), slopes, strict=True)]
    return tuple(out[0:3]), tuple(out[3:6]), tuple(out[6:9]), tuple(out[9:12]), out[12], base[5]
