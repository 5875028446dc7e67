"""Two contacts at once, wall and floor: how both answer, per unit of the wall's normal impulse.

Units: mass 1, and s = a omega in place of the spin, so that every state is a velocity and every impulse too. A *mode* says
how each contact goes on: the wall's sticks or slides, the floor's sticks, slides or is off. In a mode the rates of
velocity and spin follow from Coulomb's law at what slides, no slip at what sticks, and z' = 0 where the floor pushes.
"""

from __future__ import annotations

import math

from carom.kernel import Vec, cross, dot, kernel
from carom.laws.contact import SLIDE, STICK, slip_velocity

__all__ = [
    "AT_REST",
    "FLOOR_SLIP",
    "FLOOR_STICK",
    "LEVEL",
    "OFF",
    "STARTING",
    "TINY",
    "UP",
    "Flow",
    "add",
    "decide_mode",
    "rates",
    "start_direction",
    "step",
    "unit",
]

UP: Vec = (0.0, 0.0, 1.0)
TINY = 1e-12
AT_REST = 3e-9  # of the speeds: a slip below this has ended
STARTING = 1e-5  # of the speeds: a slip below this that grows has the direction in which it grows
SINGULAR = 1e-6  # a stick whose equations are nearer than this to having no solution does not hold
LEVEL = 1e-10  # a floor's push below this share of the wall's impulse counts as none

# Whether the floor takes part, and how.
OFF, FLOOR_SLIP, FLOOR_STICK = 0, 1, 2

# Velocity, spin s, wall friction F so far, energy stored in the wall's normal spring.
Flow = tuple[Vec, Vec, Vec, float]


@kernel
def add(y: Flow, h: float, k: Flow) -> Flow:
    """y + h k."""
    v, s, f, c = y
    dv, ds, df, dc = k
    return (
        (v[0] + h * dv[0], v[1] + h * dv[1], v[2] + h * dv[2]),
        (s[0] + h * ds[0], s[1] + h * ds[1], s[2] + h * ds[2]),
        (f[0] + h * df[0], f[1] + h * df[1], f[2] + h * df[2]),
        c + h * dc,
    )


@kernel
def unit(u: Vec, otherwise: Vec, tiny: float) -> tuple[Vec, float]:
    """Direction and size of a slip; a slip below ``tiny`` has the direction ``otherwise``."""
    size = math.sqrt(dot(u, u))
    if size <= tiny:
        return otherwise, size
    return (u[0] / size, u[1] / size, u[2] / size), size


@kernel
def _wall_slip_rate(n: Vec, f: Vec, g: Vec, push: float, kappa: float) -> Vec:
    """Rate of the slip at the wall under wall friction f, floor friction g and floor push."""
    # impulses on the velocity, tangential part; then the spin: (n x f + k x g) x n / kappa
    j = (f[0] + g[0], f[1] + g[1], f[2] + push)
    jn, gn = dot(j, n), dot(g, n)
    return (
        j[0] - jn * n[0] + (f[0] + n[2] * g[0]) / kappa,
        j[1] - jn * n[1] + (f[1] + n[2] * g[1]) / kappa,
        j[2] - jn * n[2] + (f[2] + n[2] * g[2] - gn) / kappa,
    )


@kernel
def _floor_slip_rate(n: Vec, f: Vec, g: Vec, kappa: float) -> Vec:
    """Rate of the slip at the floor, per unit of the wall's normal impulse."""
    return (
        n[0] + f[0] + g[0] + (f[0] * n[2] - n[0] * f[2] + g[0]) / kappa,
        n[1] + f[1] + g[1] + (f[1] * n[2] - n[1] * f[2] + g[1]) / kappa,
        0 * kappa,
    )


@kernel
def _floor_answer(n: Vec, f: Vec, kappa: float, mu: float, floor: int, d: Vec) -> tuple[float, Vec]:
    """Push N' and friction G' of the floor while the wall gives n + f."""
    zero = 0 * kappa
    if floor == OFF:
        return zero, (zero, zero, zero)
    push = -(n[2] + f[2])  # holds z' = 0
    if floor == FLOOR_STICK:
        r = _floor_slip_rate(n, f, (zero, zero, zero), kappa)
        c = -kappa / (1 + kappa)
        return push, (c * r[0], c * r[1], zero)
    return push, (-mu * push * d[0], -mu * push * d[1], zero)


@kernel
def _holding_friction(n: Vec, kappa: float, mu: float, floor: int, d: Vec) -> tuple[Vec, float]:
    """The wall friction that keeps a wall contact without slip, and how far its two linear equations are from singular.

    They are singular, or change sign, where wall and floor lock each other: friction at the floor large enough to turn the
    wall's hold into a push of its own.
    """
    zero = 0 * kappa
    if floor == OFF:
        return (zero, zero, zero), 1 + zero
    level = math.sqrt(n[0] * n[0] + n[1] * n[1])
    p = (-n[1] / level, n[0] / level, zero)
    q = cross(n, p)
    push, g = _floor_answer(n, (zero, zero, zero), kappa, mu, floor, d)
    r0 = _wall_slip_rate(n, (zero, zero, zero), g, push, kappa)
    push, g = _floor_answer(n, p, kappa, mu, floor, d)
    rp = _wall_slip_rate(n, p, g, push, kappa)
    push, g = _floor_answer(n, q, kappa, mu, floor, d)
    rq = _wall_slip_rate(n, q, g, push, kappa)
    b1, b2 = dot(r0, p), dot(r0, q)
    a11, a21 = dot(rp, p) - b1, dot(rp, q) - b2
    a12, a22 = dot(rq, p) - b1, dot(rq, q) - b2
    det = a11 * a22 - a12 * a21
    far = det / (abs(a11 * a22) + abs(a12 * a21) + TINY) - SINGULAR
    if det == 0:
        return (zero, zero, zero), far
    x = (a12 * b2 - a22 * b1) / det
    y = (a21 * b1 - a11 * b2) / det
    return (x * p[0] + y * q[0], x * p[1] + y * q[1], x * p[2] + y * q[2]), far


@kernel
def rates(
    y: Flow, n: Vec, kappa: float, muw: float, muf: float, wall: int, floor: int, dw: Vec, df: Vec, tiny: float
) -> tuple[Flow, float]:
    """Rates of the flow per unit of the wall's normal impulse, and the margin by which the mode is admissible.

    The margin is the smallest of: the floor's push, and what the cone of each sticking contact has to spare; each as a
    share of what it is made of, so that it lies between -1 and 1.
    """
    v, s, _f, _work = y
    un, uw = slip_velocity(v, s, n, 1)
    _vz, uf = slip_velocity(v, s, UP, 1)
    df, _size = unit(uf, df, tiny)
    if wall == STICK:
        f, spare = _holding_friction(n, kappa, muf, floor, df)
        load = math.sqrt(dot(f, f))
        if load > TINY:
            spare = min(spare, (muw - load) / (muw + load))
    else:
        dw, _size = unit(uw, dw, tiny)
        f = (-muw * dw[0], -muw * dw[1], -muw * dw[2])
        spare = 1 + 0 * kappa
    push, g = _floor_answer(n, f, kappa, muf, floor, df)
    if floor != OFF:
        spare = min(spare, push / (1 + math.sqrt(dot(f, f))))
        if floor == FLOOR_STICK:
            load = math.sqrt(dot(g, g))
            if load > TINY:
                spare = min(spare, (muf * push - load) / (abs(muf * push) + load))
    t = cross(n, f)
    # k x g
    dv = (n[0] + f[0] + g[0], n[1] + f[1] + g[1], n[2] + f[2] + push)
    ds = (-(t[0] - g[1]) / kappa, -(t[1] + g[0]) / kappa, -t[2] / kappa)
    return (dv, ds, f, -un), spare


@kernel
def start_direction(
    y: Flow, n: Vec, kappa: float, muw: float, muf: float, wall: int, floor: int, dw: Vec, df: Vec, at_wall: bool
) -> tuple[Vec, bool]:
    """Direction in which a contact at rest starts to slip: where the slip's rate r points along the slip itself."""
    # First guess: against the friction that would hold it; the two agree where holding just fails.
    if at_wall:
        k, _spare = rates(y, n, kappa, muw, muf, STICK, floor, dw, df, math.inf)
        d, size = unit((-k[2][0], -k[2][1], -k[2][2]), dw, 0 * kappa)
    else:
        k, _spare = rates(y, n, kappa, muw, 0 * muf, wall, FLOOR_SLIP, dw, df, math.inf)
        d, size = unit(slip_velocity(k[0], k[1], UP, 1)[1], df, 0 * kappa)
    if not size > 0:
        return d, False
    share = kappa / (1 + kappa)  # of a rate in the friction that makes it
    mu = muw if at_wall else muf
    r = d
    for _ in range(60):
        if at_wall:
            k, _spare = rates(y, n, kappa, muw, muf, wall, floor, d, df, math.inf)
            r = slip_velocity(k[0], k[1], n, 1)[1]
        else:
            k, _spare = rates(y, n, kappa, muw, muf, wall, floor, dw, d, math.inf)
            r = slip_velocity(k[0], k[1], UP, 1)[1]
        c = share / (1 + mu)
        new, _size = unit((d[0] + c * r[0], d[1] + c * r[1], d[2] + c * r[2]), d, 0 * kappa)
        change = abs(new[0] - d[0]) + abs(new[1] - d[1]) + abs(new[2] - d[2])
        d = new
        if change < 1e-15:
            break
    return d, dot(r, d) > -1e-6 * (1 + mu)


@kernel
def step(
    y: Flow, k1: Flow, h: float, n: Vec, kappa: float, muw: float, muf: float, wall: int, floor: int,
    dw: Vec, df: Vec, tiny: float,
) -> tuple[Flow, float, float]:  # fmt: skip
    """One step of Dormand & Prince 5(4), J. Comput. Appl. Math. 6, 19 (1980), from y with rates k1.

    The new flow, its error (none on straight lines), and the margin of the mode there.
    """
    x = add(y, h / 5, k1)
    k2, _s = rates(x, n, kappa, muw, muf, wall, floor, dw, df, tiny)
    x = add(add(y, h * 3 / 40, k1), h * 9 / 40, k2)
    k3, _s = rates(x, n, kappa, muw, muf, wall, floor, dw, df, tiny)
    x = add(add(add(y, h * 44 / 45, k1), -h * 56 / 15, k2), h * 32 / 9, k3)
    k4, _s = rates(x, n, kappa, muw, muf, wall, floor, dw, df, tiny)
    x = add(add(y, h * 19372 / 6561, k1), -h * 25360 / 2187, k2)
    x = add(add(x, h * 64448 / 6561, k3), -h * 212 / 729, k4)
    k5, _s = rates(x, n, kappa, muw, muf, wall, floor, dw, df, tiny)
    x = add(add(y, h * 9017 / 3168, k1), -h * 355 / 33, k2)
    x = add(add(add(x, h * 46732 / 5247, k3), h * 49 / 176, k4), -h * 5103 / 18656, k5)
    k6, _s = rates(x, n, kappa, muw, muf, wall, floor, dw, df, tiny)
    x = add(add(y, h * 35 / 384, k1), h * 500 / 1113, k3)
    x = add(add(add(x, h * 125 / 192, k4), -h * 2187 / 6784, k5), h * 11 / 84, k6)
    k7, spare = rates(x, n, kappa, muw, muf, wall, floor, dw, df, tiny)
    zero = 0 * h
    nought = (zero, zero, zero)
    d = add(add((nought, nought, nought, zero), h * 71 / 57600, k1), -h * 71 / 16695, k3)
    d = add(add(add(d, h * 71 / 1920, k4), -h * 17253 / 339200, k5), h * 22 / 525, k6)
    d = add(d, -h / 40, k7)
    return x, math.sqrt(dot(d[0], d[0]) + dot(d[1], d[1])), spare


@kernel
def decide_mode(
    y: Flow, n: Vec, kappa: float, muw: float, muf: float, touching: bool, dw: Vec, df: Vec, tiny: float
) -> tuple[int, int, Vec, Vec]:
    """How each contact goes on: the first admissible of, at the wall, stick before slip, then floor before none.

    With large friction several can be admissible; a contact at rest then stays so rather than start to slip.
    """
    v, s, _f, _stored = y
    dw, slip = unit(slip_velocity(v, s, n, 1)[1], dw, tiny)
    wall_rests = slip <= tiny
    best, choice = -math.inf, (STICK, FLOOR_STICK if touching else OFF, dw, df)
    df, slip = unit(slip_velocity(v, s, UP, 1)[1], df, tiny)
    floor_rests = slip <= tiny
    for wall in (STICK, SLIDE):
        for i in range(3):
            floor = FLOOR_STICK - i
            if (wall == STICK and not wall_rests) or (floor == FLOOR_STICK and not floor_rests):
                continue
            if floor != OFF and not touching:
                continue
            begin, start, starts = dw, df, True
            if wall == SLIDE and wall_rests:
                begin, starts = start_direction(y, n, kappa, muw, muf, wall, floor, begin, start, True)
            if starts and floor == FLOOR_SLIP and floor_rests:
                start, starts = start_direction(y, n, kappa, muw, muf, wall, floor, begin, start, False)
                if starts and wall == SLIDE and wall_rests:
                    begin, starts = start_direction(y, n, kappa, muw, muf, wall, floor, begin, start, True)
            if not starts:
                continue
            k, spare = rates(y, n, kappa, muw, muf, wall, floor, begin, start, tiny)
            leaves = not touching or k[0][2] >= -LEVEL * (1 + math.sqrt(dot(k[2], k[2])))
            if spare > LEVEL and (floor != OFF or leaves):
                return wall, floor, begin, start
            if spare > best and floor != OFF:
                best, choice = spare, (wall, floor, begin, start)
    return choice  # nothing is clearly admissible: what is least against it
