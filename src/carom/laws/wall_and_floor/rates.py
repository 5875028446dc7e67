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

from carom.core.contact import SLIDE, STICK, wall_contact
from carom.core.jit.kernel import Vec, dot, hot_kernel, kernel, root_of, without_slopes

Pair = tuple[float, float]
# The slips u_t, u_y, f_x, f_y, and the energy stored in the wall's normal spring.
Slips = tuple[float, float, float, float, float]
# c, m, B, K, D, E; the drive (1, or 0 at constant normal impulse of the wall), the frictions of wall and floor, and the
# weight of the wall's energy (1 or 0).
Couplings = tuple[float, float, float, float, float, float, float, float, float, float]

LEVEL = 1e-10  # a floor impulse below this fraction of the wall's impulse is regarded as zero
SINGULAR = 1e-9  # a sticking wall locks with a slipping floor where its equations are this close to singular
ENDLESS = 1e15  # stands for infinite friction of contacts at rest
# Where a gap closes: the rounding of a gap, as a share of what is added up to it; the share of the wall's energy that has to be
# left there; steps until the place is known to that.
DECIDED, SPENT, NEWTON_STEPS, TINIEST = 16 * 2.0**-52, 1e-6, 12, 1e-300

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


# ----------------------------------------------------------------------------------------------------
# Wall and floor at once: the transformation of a state to slips of both contacts, and back.
#
# Units: mass 1, and s = a omega in place of the spin. The frame has x along the horizontal part of the wall's normal; slips
# and law are defined in :mod:`carom.laws.wall_and_floor.rates`.


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


# ----------------------------------------------------------------------------------------------------
# The wall's spring: impulse remaining until compression or restitution ends, and the gap under a lifted ball.
#
# Stronge's restitution depends on the energy stored in the wall, not on time. Only the gap under a lifted ball depends on time:
# the wall is a linear spring that unloads with 1/e^2 times its stiffness (Walton & Braun), and the stiffness cancels.


@kernel
def remaining_impulse(un: float, rate: float, stored: float, peak: float, compressing: bool) -> float:
    """Return the impulse until compression or restitution ends at the present rate of u_n; infinite if it does not.

    Restitution also ends if the ball approaches again and has given back to the wall all the energy that it had returned
    (``peak``): the compression then exceeds its previous maximum.
    """
    if compressing:
        return -un / rate if rate > 0 else math.inf
    if un < 0 and stored < peak:
        left = un * un - 2 * rate * (peak - stored)
        if left > 0:
            return 2 * (peak - stored) / (math.sqrt(left) - un)
    left = un * un + 2 * rate * stored
    if left < 0:
        return math.inf
    left = un + math.sqrt(left)
    return 2 * stored / left if left > 0 else math.inf


@kernel
def gap_growth(un: float, vz: float, c: float, stored: float, p: float, e: float, compressing: bool) -> float:
    """Return the growth of the gap under a lifted ball (v_z changes at the rate c) during the wall's impulse p."""
    # The wall's spring in its own time: q' = -u_n/k, u_n' = q/k with q^2/2 the stored energy, k = 1 or, unloading, e;
    # (u_n, q) moves on a circle. Differences of nearly equal numbers are expanded: c may be a large friction.
    k = 1 + 0 * e if compressing else e
    q0 = math.sqrt(2 * stored)
    left = stored - un * p - p * p / 2
    q1 = math.sqrt(2 * left) if left > 0 else 0 * e
    if not q0 + q1 > 0:
        return 0 * e
    fall = p * (2 * un + p) / (q0 + q1)  # q0 - q1
    turn = math.atan2(p * q0 + un * fall, q0 * q1 + un * (un + p))
    return k * (vz * turn + c * (fall - un * turn))


@kernel
def _touch_down_bracket(
    un: float, vz: float, c: float, stored: float, low: float, p: float, e: float, compressing: bool, gap: float
) -> tuple[float, float]:
    """Return impulses between which the gap closes, near each other and yet so far apart that rounding does not decide.

    From ``low``, the gap's maximum, to p, where it is negative, it only falls. Newton's steps begin where it closes if the wall's
    spring keeps its force.
    """
    k, near, far, far_off = (1 + 0 * e if compressing else e), low, p, p
    first = math.sqrt(2 * stored) + TINIEST
    x = (vz + math.sqrt(vz * vz - 2 * c * gap * first / k)) / -c if c < 0 and k > 0 else low
    x = x if low < x < p else (low + p) / 2
    for _ in range(NEWTON_STEPS):
        grown = gap + gap_growth(un, vz, c, stored, x, e, compressing)
        near, far = (x, far) if grown > 0 else (near, x)
        left, rate = stored - un * x - x * x / 2, k * (vz + c * x)
        if not (left > SPENT * (stored + abs(un) * x) and rate < 0):
            return low, p
        root = math.sqrt(2 * left)
        noise = DECIDED * (gap + k * (abs(vz) + abs(c) * (abs(un) + x)) * min(math.pi, x / min(root, first)))
        then, far_off = x - grown * root / rate, -noise * root / rate
        if abs(then - x) <= far_off:
            break
        x = then if near < then < far else (near + far) / 2
    near, far = x - 2 * far_off, x + 2 * far_off
    if not (
        low < near
        and far < p
        and gap + gap_growth(un, vz, c, stored, near, e, compressing) > noise / 2
        and gap + gap_growth(un, vz, c, stored, far, e, compressing) < -noise / 2
    ):
        return low, p
    return near, far


@kernel
def touch_down_impulse(
    un: float, vz: float, c: float, stored: float, p: float, e: float, compressing: bool, gap: float
) -> float:
    """Return the impulse in (0, p] at which the gap closes, by bisection between its maximum and p, where it is negative."""
    low = -vz / c if vz > 0 else 0 * p
    high = p
    near, far = _touch_down_bracket(
        without_slopes(un), without_slopes(vz), without_slopes(c), without_slopes(stored), without_slopes(low),
        without_slopes(p), without_slopes(e), compressing, without_slopes(gap),
    )  # fmt: skip
    for _ in range(200):
        middle = (low + high) / 2
        if middle in (low, high):
            break
        # (what lies beyond the bracket is known without the gap)
        if middle <= near or (middle < far and gap + gap_growth(un, vz, c, stored, middle, e, compressing) > 0):
            low = middle
        else:
            high = middle
    left = stored - un * high - high * high / 2
    rate = (1 + 0 * e if compressing else e) * (vz + c * high) / math.sqrt(2 * left) if left > 0 else -1 + 0 * e
    return root_of(high, gap + gap_growth(un, vz, c, stored, high, e, compressing), rate)
