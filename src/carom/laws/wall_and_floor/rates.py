"""Two contacts at once, wall and floor: how both answer, per unit of the wall's normal impulse.

Units: mass 1, and s = a omega in place of the spin, so that every state is a velocity and every impulse too. The frame has
x along the level part of the wall's normal, n = (c, 0, m), and the wall's tangents t = (-m, 0, c), upwards, and y. While
the floor keeps z' = 0 two slips say everything: u at the wall along t and y, f at the floor along x and y. With wall
friction F, floor friction G and floor push N they change by

    u_t' = -m c + B F_t - E G_x     f_x' = c - E F_t + K G_x     N = -(m + c F_t)
    u_y' = K F_y + D G_y            f_y' = D F_y + K G_y

K = 1 + 1/kappa, B = m^2 + 1/kappa, D = 1 + m/kappa, E = m + 1/kappa. A *mode* says how each contact goes on: the wall's
sticks or slides, the floor's sticks, slides, is off, or takes the slip away in a jump. All that a mode depends on is the
directions of the slips, so whatever is at rest is decided in closed form: :func:`decide_mode`.

**Infinite friction** is not a large number here but the limit, which has a clock of its own: the slip of a contact that
pushes is gone before the other impulses have grown. At the wall the flow is followed per unit of wall friction instead
(level 1: no normal impulse passes); at the floor per unit of floor friction (a jump: nothing else passes). What then is at
rest has no cone.
"""

from __future__ import annotations

import math

from carom.core.contact import SLIDE, STICK
from carom.core.jit.kernel import hot_kernel, kernel

__all__ = [
    "FLOOR_JUMP",
    "FLOOR_SLIP",
    "FLOOR_STICK",
    "LEVEL",
    "OFF",
    "Couplings",
    "Pair",
    "Slips",
    "decide_mode",
    "rates",
    "size",
]

Pair = tuple[float, float]
# The slips u_t, u_y, f_x, f_y, and the energy stored in the wall's normal spring.
Slips = tuple[float, float, float, float, float]
# c, m, B, K, D, E; the drive (1, or 0 where the wall's normal impulse waits), the frictions of wall and floor, and the
# share in which the wall's energy counts (1 or 0).
Couplings = tuple[float, float, float, float, float, float, float, float, float, float]

LEVEL = 1e-10  # a floor's push below this share of the wall's impulse counts as none
SINGULAR = 1e-9  # a wall that sticks locks with a slipping floor where its equations are as near to singular as this
ENDLESS = 1e15  # a friction that no load exceeds, for contacts at rest

# Whether the floor takes part, and how.
OFF, FLOOR_SLIP, FLOOR_STICK, FLOOR_JUMP = 0, 1, 2, 3


@hot_kernel
def size(p: float, q: float) -> float:
    """Length of a slip."""
    return math.sqrt(p * p + q * q)


@kernel
def rates(y: Slips, q: Couplings, wall: int, floor: int, dw: Pair, df: Pair, tiny: float) -> tuple[Slips, float]:
    """Rates of slips and energy in a pressed mode, and the margin by which the mode is admissible.

    The margin is the smallest of: the floor's push, and what the cone of each sticking contact has to spare; each as a
    share of what it is made of, so that it lies between -1 and 1. Slips below ``tiny`` have the directions dw and df.
    """
    c, m, b, k, d, e, drive, muw, muf, heed = q
    zero = 0 * c
    un = c / (1 - m) * (y[0] + y[2])
    dx, dy = df
    if floor != FLOOR_STICK:
        slip = size(y[2], y[3])
        if slip > tiny:
            dx, dy = y[2] / slip, y[3] / slip
    spare = 1 + zero
    if wall == STICK:
        gain = e * muf * c * dx
        spare = (b - gain) / (b + abs(gain)) - SINGULAR
        push = -m * drive * k / (b - gain)
        ft, fy = m * drive * (c + e * muf * dx) / (b - gain), d / k * muf * push * dy
        if muf >= ENDLESS:
            spare = min(spare, -dx - SINGULAR)
        load = size(ft, fy)
        if muw < ENDLESS and load > 0:
            spare = min(spare, (muw - load) / (muw + load))
    else:
        px, py = dw
        slip = size(y[0], y[1])
        if slip > tiny:
            px, py = y[0] / slip, y[1] / slip
        ft, fy = -muw * px, -muw * py
        push = -(m * drive + c * ft)
        spare = push / (1 + muw) - LEVEL
    if floor == FLOOR_JUMP:
        return (e * dx, -d * dy, -k * dx, -k * dy, -heed * un / push), spare
    if floor == FLOOR_STICK:
        gx, gy = (e * ft - c * drive) / k, -d / k * fy
        load = size(gx, gy)
        if muf < ENDLESS and load > 0:
            spare = min(spare, (muf * push - load) / (abs(muf * push) + load))
        return (b * ft - e * gx - m * c * drive, k * fy + d * gy, zero, zero, -heed * un), spare
    gx, gy = -muf * push * dx, -muf * push * dy
    fx1, fy1 = c * drive - e * ft + k * gx, d * fy + k * gy
    if wall == STICK:
        return (zero, zero, fx1, fy1, -heed * un), spare
    return (b * ft - e * gx - m * c * drive, k * fy + d * gy, fx1, fy1, -heed * un), spare


@kernel
def _start_at_wall(q: Couplings, df: Pair) -> Pair:
    """Direction in which a wall contact at rest starts to slip while the floor slips along df, n_z < 0.

    The slip's rate M F + r has to point along the slip itself, (mu M + x) d = r with |d| = 1 and a growth x >= 0. M is
    triangular, |d| falls from above 1 (the wall does not stick) to 0: there is a solution, and with it the floor pushes.
    """
    c, m, b, k, d, e, drive, muw, muf, _heed = q
    gain = e * muf * c * df[0]
    cross = d * c * muf * df[1]
    if drive == 0:  # nothing but the lock itself drives it
        x = max(gain - b, 0 * c)
        length = size(1, cross / (k + x))
        return 1 / length, -cross / (k + x) / length
    rt, ry = -m * (c + e * muf * df[0]), d * m * muf * df[1]
    low = max(0 * c, muw * (gain - b))
    high = low + abs(rt) + abs(ry) + muw * (b + k + abs(gain) + abs(cross))
    dt, dy = 0 * c, 0 * c
    for i in range(200):
        x = (low + high) / 2 if i else high
        below = muw * (b - gain) + x
        dt = rt / below if below > 0 else math.inf
        dy = (ry - muw * cross * dt) / (muw * k + x) if below > 0 else 0 * c
        if below > 0 and dt * dt + dy * dy < 1:
            if i and x in (low, high):
                break
            high = x
        elif i == 0:
            low, high = high, 2 * high
        else:
            if x in (low, high):
                break
            low = x
    x = high
    dt = rt / (muw * (b - gain) + x)
    dy = (ry - muw * cross * dt) / (muw * k + x)
    length = size(dt, dy)
    return dt / length, dy / length


@kernel
def decide_mode(  # noqa: PLR0911  (one return a mode)
    y: Slips, q: Couplings, rough_wall: bool, rough_floor: bool, touching: bool, tiny: float
) -> tuple[int, int, int, Pair, Pair]:
    """How each contact goes on: wall, floor, level (1: an infinitely rough wall takes its slip away), directions.

    ``rough_wall`` and ``rough_floor`` say that a friction is infinite; q holds ENDLESS in its place. Where the wall slips
    there is one answer. Where it rests several can be admissible: then both contacts stay at rest if the cones hold
    them; a wall that does not press down (n_z >= 0) lets the ball go; a contact at rest stays so rather than start to
    slip.
    """
    c, m, b, k, d, e, _drive, muw, muf, heed = q
    one = 1 + 0 * c
    zero = 0 * c
    level = 1 if rough_wall else 0
    fast = (c, m, b, k, d, e, zero, one, muf, heed) if rough_wall else q
    slip = size(y[0], y[1])
    dw = (y[0] / slip, y[1] / slip) if slip > 0 else (one, zero)
    wall_rests = slip <= tiny and muw > 0
    slip = size(y[2], y[3])
    df = (y[2] / slip, y[3] / slip) if slip > 0 else (one, zero)
    floor_rests = slip <= tiny and muf > 0
    if not wall_rests:
        if not touching:
            return SLIDE, OFF, level, dw, df
        ft, fy = -fast[7] * dw[0], -fast[7] * dw[1]
        push = -(m * fast[6] + c * ft)
        if not push / (1 + fast[7]) >= LEVEL:
            return SLIDE, OFF, level, dw, df
        if not floor_rests:
            return SLIDE, FLOOR_JUMP if rough_floor else FLOOR_SLIP, level, dw, df
        _k, spare = rates(y, fast, SLIDE, FLOOR_STICK, dw, df, zero)
        if spare >= 0:
            return SLIDE, FLOOR_STICK, level, dw, df
        gx, gy = c * fast[6] - e * ft, d * fy
        slip = size(gx, gy)
        return SLIDE, FLOOR_SLIP, level, dw, (gx / slip, gy / slip) if slip > 0 else df
    if not touching:
        return STICK, OFF, 0, dw, df
    if floor_rests:
        # At rest on both: all that follows lies in the plane of n and the vertical, and slips away from the wall.
        dw = df = (one, zero)
        edge = c / (1 - m)
        # (on the very edge of the cones a ball that can leave does, and one that cannot is held)
        if min(muw, muf) > edge * (1 + (LEVEL if m >= 0 else -LEVEL)):
            return STICK, FLOOR_STICK, 0, dw, df
        if m >= 0:
            return STICK, OFF, 0, dw, df
        _k, spare = rates(y, q, STICK, FLOOR_SLIP, dw, df, tiny)
        if spare >= 0 and muf < edge:
            return STICK, FLOOR_SLIP, 0, dw, df
        _k, spare = rates(y, q, SLIDE, FLOOR_STICK, dw, df, tiny)
        if spare >= 0 and muw < edge:
            return SLIDE, FLOOR_STICK, 0, dw, df
        return SLIDE, FLOOR_SLIP, 0, dw, df
    if m >= 0:
        return STICK, OFF, 0, dw, df
    _k, spare = rates(y, q, STICK, FLOOR_SLIP, dw, df, tiny)
    if spare >= 0:  # on an infinitely rough floor its push is zero, and its friction what keeps it so
        return STICK, FLOOR_SLIP, 0, dw, df
    if rough_floor:  # its slip jumps, and takes the wall's contact with it
        slip = size(e * df[0], d * df[1])
        return SLIDE, FLOOR_JUMP, level, (e * df[0] / slip, -d * df[1] / slip) if slip > 0 else dw, df
    return SLIDE, FLOOR_SLIP, level, _start_at_wall(fast, df), df
