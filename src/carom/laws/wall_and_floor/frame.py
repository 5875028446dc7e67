"""Wall and floor at once: the transformation of a state to slips of both contacts, and back.

Units: mass 1, and s = a omega in place of the spin. The frame has x along the horizontal part of the wall's normal; slips
and law are defined in :mod:`carom.laws.wall_and_floor.rates`.
"""

from __future__ import annotations

import math

from carom.core.contact import wall_contact
from carom.core.jit.kernel import Vec, dot, kernel
from carom.laws.wall_and_floor.rates import ENDLESS, Couplings, Pair, Slips, norm

__all__ = ["Met", "from_wall_frame", "to_wall_frame"]

# Velocity, a times spin, the floor's impulse so far; the frame; law and slips; the speed of approach, and the total speed
Met = tuple[Vec, Vec, Vec, Pair, Couplings, Slips, float, float]
UP: Vec = (0.0, 0.0, 1.0)


@kernel
def to_wall_frame(
    v: Vec, w: Vec, n: Vec, a: float, kappa: float, muw: float, ef: float, muf: float, betaf: float
) -> Met:
    """Transform a ball's state, after the first impulse of the floor, to the frame of the wall, with a = m = 1."""
    zero = 0 * a
    s = (a * w[0], a * w[1], a * w[2])
    v1, s1, j = v, s, (zero, zero, zero)
    if v[2] < 0:  # a rigid floor acts first, and may turn the ball away from the wall
        v1, s1, j, _required, _regime = wall_contact(v, s, UP, 1, kappa, ef, muf, betaf)
    # the frame: x along the horizontal part of the normal
    m, c = n[2], norm(n[0], n[1])
    x, y = (n[0] / c, n[1] / c) if c > 0 else (1 + zero, zero)
    vx, vy, vz = x * v1[0] + y * v1[1], x * v1[1] - y * v1[0], v1[2]
    sx, sy, sz = x * s1[0] + y * s1[1], x * s1[1] - y * s1[0], s1[2]
    i = 1 / kappa
    q = (c, m, m * m + i, 1 + i, 1 + m * i, m + i, 1 + zero, min(muw, ENDLESS), min(muf, ENDLESS), 1 + zero)
    slips = (sy - m * vx + c * vz, vy - c * sz + m * sx, vx - sy, vy + sx, zero)
    return v1, s1, j, (x, y), q, slips, -dot(v1, n), math.sqrt(dot(v1, v1)) + math.sqrt(dot(s1, s1))


@kernel
def from_wall_frame(
    v: Vec, w: Vec, a: float, kappa: float, met: Met, after: Slips, up: float, p: float
) -> tuple[Vec, Vec, Vec, Vec]:
    """Velocity, spin and impulses of wall and floor, from the final slips, v_z and normal impulse of the wall."""
    v1, s1, _j, (x, y), q, before, _speed, _scale = met
    # Impulses, from the changes that they caused: wall friction f along (t, y), floor friction g along (x, y).
    c, m, b, k, d, ee, _drive, _muw, _muf, _heed = q
    i = 1 / kappa
    rise = up - v1[2]
    r1, r2 = after[0] - before[0] + m * c * p - c * rise, after[2] - before[2] - c * p
    ft, gx = (k * r1 + ee * r2) / (b * k - ee * ee), (ee * r1 + b * r2) / (b * k - ee * ee)
    r1, r2 = after[1] - before[1], after[3] - before[3]
    fy, gy = (k * r1 - d * r2) / (k * k - d * d), (k * r2 - d * r1) / (k * k - d * d)
    wx, wz = c * p - m * ft, m * p + c * ft
    wall = (x * wx - y * fy, x * fy + y * wx, wz)
    v2 = (v1[0] + wall[0] + x * gx - y * gy, v1[1] + wall[1] + x * gy + y * gx, up)
    tx, ty = (m * fy + gy) * i, (ft - gx) * i
    s2 = (s1[0] + x * tx - y * ty, s1[1] + x * ty + y * tx, s1[2] - c * fy * i)
    # Without dissipation, integration errors may increase the energy slightly; no law of impact may create energy.
    had, has = dot(v, v) + kappa * (a * a) * dot(w, w), dot(v2, v2) + kappa * dot(s2, s2)
    if has > had:
        k = math.sqrt(had / has)
        v2, s2 = (k * v2[0], k * v2[1], k * v2[2]), (k * s2[0], k * s2[1], k * s2[2])
    floor = (v2[0] - v[0] - wall[0], v2[1] - v[1] - wall[1], v2[2] - v[2] - wall[2])
    return v2, (s2[0] / a, s2[1] / a, s2[2] / a), wall, floor
