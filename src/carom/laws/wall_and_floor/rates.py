"""Wall and floor at once: rates of change of both slips per unit of the wall's normal impulse.

Units: mass 1, and s = a omega in place of the spin, so that states and impulses are velocities. The frame has x along the
horizontal part of the wall's normal, n = (c, 0, m), and the wall's tangents t = (-m, 0, c), upwards, and y. While the floor
keeps z' = 0 the state is given by two slips: u at the wall along t and y, f at the floor along x and y. With wall friction
F, floor friction G and normal force N of the floor they change by

    u_t' = -m c + B F_t - E G_x     f_x' = c - E F_t + K G_x     N = -(m + c F_t)
    u_y' = K F_y + D G_y            f_y' = D F_y + K G_y

K = 1 + 1/kappa, B = m^2 + 1/kappa, D = 1 + m/kappa, E = m + 1/kappa. The *mode* is the state of each contact: the wall's
sticks or slides, the floor's sticks, slides, is off, or loses its slip in a jump. A mode depends only on the directions of
the slips, so for contacts at rest it is determined in closed form: :func:`decide_mode`.

**Infinite friction** is not treated as a large number but as the limit, with a separate independent variable: the slip of a
loaded contact vanishes before the other impulses have grown. At the wall the flow is integrated per unit of wall friction
instead (level 1, at constant normal impulse); at the floor per unit of floor friction (a jump, at constant other impulses).
A contact then at rest has no friction cone.
"""

from __future__ import annotations

import math

from carom.core.contact import SLIDE, STICK
from carom.core.jit.kernel import hot_kernel, kernel, root_of

__all__ = [
    "FLOOR_JUMP", "FLOOR_SLIP", "FLOOR_STICK", "LEVEL", "OFF", "Couplings", "Pair", "Slips", "decide_mode", "norm",
    "pressed_rates",
]  # fmt: skip

Pair = tuple[float, float]
# The slips u_t, u_y, f_x, f_y, and the energy stored in the wall's normal spring.
Slips = tuple[float, float, float, float, float]
# c, m, B, K, D, E; the drive (1, or 0 at constant normal impulse of the wall), the frictions of wall and floor, and the
# weight of the wall's energy (1 or 0).
Couplings = tuple[float, float, float, float, float, float, float, float, float, float]

LEVEL = 1e-10  # a floor impulse below this fraction of the wall's impulse is regarded as zero
SINGULAR = 1e-9  # a sticking wall locks with a slipping floor where its equations are this close to singular
ENDLESS = 1e15  # stands for infinite friction of contacts at rest

# Whether the floor takes part, and how.
OFF, FLOOR_SLIP, FLOOR_STICK, FLOOR_JUMP = 0, 1, 2, 3


@hot_kernel
def norm(p: float, q: float) -> float:
    """Length of a slip."""
    return math.sqrt(p * p + q * q)


@kernel
def pressed_rates(
    y: Slips, q: Couplings, wall: int, floor: int, dw: Pair, df: Pair, tiny: float
) -> tuple[Slips, float]:
    """Rates of slips and energy in a pressed mode, and the margin by which the mode is admissible.

    The margin is the smallest of the floor's normal force and the margins of the friction cones of sticking contacts, each
    relative to the sum of its terms, so between -1 and 1. Slips below ``tiny`` have the directions dw and df.
    """
    c, m, b, k, d, e, drive, muw, muf, heed = q
    zero = 0 * c
    un = c / (1 - m) * (y[0] + y[2])
    dx, dy = df
    if floor != FLOOR_STICK:
        slip = norm(y[2], y[3])
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
        load = norm(ft, fy)
        if muw < ENDLESS and load > 0:
            spare = min(spare, (muw - load) / (muw + load))
    else:
        px, py = dw
        slip = norm(y[0], y[1])
        if slip > tiny:
            px, py = y[0] / slip, y[1] / slip
        ft, fy = -muw * px, -muw * py
        push = -(m * drive + c * ft)
        spare = push / (1 + muw) - LEVEL
    if floor == FLOOR_JUMP:
        return (e * dx, -d * dy, -k * dx, -k * dy, -heed * un / push), spare
    if floor == FLOOR_STICK:
        gx, gy = (e * ft - c * drive) / k, -d / k * fy
        load = norm(gx, gy)
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

    The slip's rate M F + r must be parallel to the slip, (mu M + x) d = r with |d| = 1 and a growth rate x >= 0. M is
    triangular, and |d| decreases from above 1 (the wall does not stick) to 0: so a solution exists, and the floor is loaded.
    """
    c, m, b, k, d, e, drive, muw, muf, _heed = q
    gain = e * muf * c * df[0]
    cross = d * c * muf * df[1]
    if drive == 0:  # driven only by the locking of the contacts
        x = max(gain - b, 0 * c)
        length = norm(1, cross / (k + x))
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
    below, beside = muw * (b - gain) + high, muw * k + high
    dt = rt / below
    dy = (ry - muw * cross * dt) / beside
    rate = -2 * (dt * dt / below + dy * (dy - muw * cross * dt / below) / beside)
    x = root_of(high, dt * dt + dy * dy - 1, rate)
    dt = rt / (muw * (b - gain) + x)
    dy = (ry - muw * cross * dt) / (muw * k + x)
    length = norm(dt, dy)
    return dt / length, dy / length


@kernel
def decide_mode(  # noqa: PLR0911  (one return a mode)
    y: Slips, q: Couplings, rough_wall: bool, rough_floor: bool, touching: bool, tiny: float
) -> tuple[int, int, int, Pair, Pair]:
    """Return the modes of wall and floor, the level (1: an infinitely rough wall removes its slip), and the directions.

    ``rough_wall`` and ``rough_floor`` mark infinite friction; q then holds ENDLESS. If the wall slips, the mode is unique.
    If it is at rest, several modes can be admissible. Then both contacts stay at rest if their cones permit; a wall that
    does not press down (n_z >= 0) releases the ball; and a contact at rest is preferred to one that starts to slip.
    """
    c, m, b, k, d, e, _drive, muw, muf, heed = q
    one = 1 + 0 * c
    zero = 0 * c
    level = 1 if rough_wall else 0
    fast = (c, m, b, k, d, e, zero, one, muf, heed) if rough_wall else q
    slip = norm(y[0], y[1])
    dw = (y[0] / slip, y[1] / slip) if slip > 0 else (one, zero)
    wall_rests = slip <= tiny and muw > 0
    slip = norm(y[2], y[3])
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
        _k, spare = pressed_rates(y, fast, SLIDE, FLOOR_STICK, dw, df, zero)
        if spare >= 0:
            return SLIDE, FLOOR_STICK, level, dw, df
        gx, gy = c * fast[6] - e * ft, d * fy
        slip = norm(gx, gy)
        return SLIDE, FLOOR_SLIP, level, dw, (gx / slip, gy / slip) if slip > 0 else df
    if not touching:
        return STICK, OFF, 0, dw, df
    if floor_rests:
        # Both contacts at rest: the motion stays in the plane of n and the vertical, with slip away from the wall.
        dw = df = (one, zero)
        edge = c / (1 - m)
        # (exactly on the edge of the cones a ball that can leave does so, and one that cannot is held)
        if min(muw, muf) > edge * (1 + (LEVEL if m >= 0 else -LEVEL)):
            return STICK, FLOOR_STICK, 0, dw, df
        if m >= 0:
            return STICK, OFF, 0, dw, df
        _k, spare = pressed_rates(y, q, STICK, FLOOR_SLIP, dw, df, tiny)
        if spare >= 0 and muf < edge:
            return STICK, FLOOR_SLIP, 0, dw, df
        _k, spare = pressed_rates(y, q, SLIDE, FLOOR_STICK, dw, df, tiny)
        if spare >= 0 and muw < edge:
            return SLIDE, FLOOR_STICK, 0, dw, df
        return SLIDE, FLOOR_SLIP, 0, dw, df
    if m >= 0:
        return STICK, OFF, 0, dw, df
    _k, spare = pressed_rates(y, q, STICK, FLOOR_SLIP, dw, df, tiny)
    if spare >= 0:  # on an infinitely rough floor the normal force is zero, and friction keeps it at zero
        return STICK, FLOOR_SLIP, 0, dw, df
    if rough_floor:  # its slip jumps, and changes the wall's
        slip = norm(e * df[0], d * df[1])
        return SLIDE, FLOOR_JUMP, level, (e * df[0] / slip, -d * df[1] / slip) if slip > 0 else dw, df
    return SLIDE, FLOOR_SLIP, level, _start_at_wall(fast, df), df
