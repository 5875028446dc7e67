"""Motion on a tilted floor: slip, or the velocity of rolling, turns downhill; a closed form in a clock of its own.

With the downhill acceleration f along the floor, w' = F - m w/|w|: of a sliding ball w is the slip, F = f, m = mu g (1 + 1/kappa);
of a rolling one w is its velocity, F = f/(1 + kappa) and m = c g. In the clock dtau = dt/|w|, w and |w| obey linear equations,

    dw/dtau = F |w| - m w,   d|w|/dtau = F . w - m |w|,

so that w, |w|, the time and the path are sums of exponentials. The ball's centre has v' = F - q m w/|w|, with q = kappa/(1 + kappa)
where it slides and 1 where it rolls, and so x = x0 + (v0 - q w0) t + (1 - q) F t^2/2 + q (path of w).

The phases are Coriolis's (:mod:`carom.core.motion.phases`), with gravity's part along the floor. Derivation: docs/theory/motion.md.
"""

from __future__ import annotations

import math

from carom.core.contact import slip_velocity
from carom.core.jit.kernel import Vec, carries_slopes, hot_kernel, kernel, root_of, steepest, without_slopes
from carom.core.motion.phases import (
    PIVOTING,
    REST,
    ROLLING,
    ROUNDING,
    SLIDING,
    UP,
    acts,
    decay_integrals,
    time_of_integral,
)

# F (x, y), m, and q; q is 0 for a ball whose acceleration is constant
Lean = tuple[float, float, float, float]
LEVEL: Lean = (0.0, 0.0, 0.0, 0.0)

MOST_STEPS = 200
LONGEST = 3.0  # step of Newton's, in e-foldings of a growing speed
STILL = 1e-12  # of the radius: a way that is none
FOUND = 1e-9  # a step of Newton's so small leaves an error of its square
# of the time to the end: tau has no derivatives where it is infinite, and what is nearer to it, by the rounding of
# times, is the end for duals (for them alone: a pile of balls comes to rest by what is left of the slips)
AT_END = 1e-13


@hot_kernel
def _time_of_end(x: float) -> float:
    """Return the part of the time to the end of a slip from which on x, a number of it, is taken at the end."""
    return 1 - AT_END if carries_slopes(x) else 1.0


@hot_kernel
def is_tilted(force: Vec) -> bool:
    """Return whether a floor on which free balls have the acceleration ``force`` is tilted, or its slope has derivatives."""
    return bool(force[0] != 0 or force[1] != 0 or acts(force[0]) or acts(force[1]))


@kernel
def _size(x: float, y: float) -> float:
    return math.sqrt(x * x + y * y)


@kernel
def phase_on_slope(phase: int, force: Vec, kappa: float, g: float, mu: float, resistance: float) -> int:
    """Return the phase of a ball on a tilted floor that would be in ``phase`` on a level one: a slope sets it going."""
    if ROLLING <= phase <= REST:
        down = _size(without_slopes(force[0]), without_slopes(force[1]))
        if down > mu * g * (1 + 1 / kappa):
            return SLIDING
        if phase != ROLLING and down > resistance * g * (1 + kappa):
            return ROLLING
    return phase


@kernel
def _turns(x: float, y: float, fx: float, fy: float, m: float, a: float) -> bool:
    """Return whether w = (x, y) turns: not where it is zero, or so small that a slope has turned it within 1e-12 of the radius."""
    square, pull = x * x + y * y, _size(without_slopes(fx), without_slopes(fy))
    return bool(square > 0 and (square > 2 * STILL * a * pull or not pull > m))


@kernel
def lean_of(
    phase: int, v: Vec, w: Vec, a: float, kappa: float, force: Vec, g: float, mu: float, resistance: float
) -> Lean:
    """Return F, m and q of a ball on a tilted floor; q = 0 where it goes straight, from rest, with a constant acceleration."""
    if phase == SLIDING:
        _un, u = slip_velocity(v, w, UP, a)
        m = mu * g * (1 + 1 / kappa)
        turns = _turns(u[0], u[1], force[0], force[1], m, a)
        return force[0], force[1], m, (kappa / (1 + kappa) if turns else 0 * m)
    c = 1 / (1 + kappa)
    m = resistance * g + 0 * c
    turns = _turns(v[0], v[1], force[0] * c, force[1] * c, m, a)
    return force[0] * c, force[1] * c, m, (1 + 0 * c if turns else 0 * c)


@kernel
def slope_acceleration(
    phase: int, v: Vec, w: Vec, a: float, kappa: float, force: Vec, g: float, mu: float, resistance: float
) -> tuple[Vec, Vec, float]:
    """Return acceleration, angular acceleration (of the spin along the floor) and duration of sliding or rolling on a slope."""
    fx, fy, m, q = lean_of(phase, v, w, a, kappa, force, g, mu, resistance)
    zero = 0 * m
    _un, u = slip_velocity(v, w, UP, a)
    x, y = (u[0], u[1]) if phase == SLIDING else (v[0], v[1])
    share = kappa / (1 + kappa) if phase == SLIDING else 1 + zero
    pull, size = _size(fx, fy), zero
    lasts = math.inf + zero
    if q > 0:
        size = _size(x, y)
        x, y = x / size, y / size
        up = fx * x + fy * y
        if m > pull:
            lasts = size * (m + up) / (m * m - pull * pull)
        elif fx * y == fy * x and up < 0:  # straight uphill: it stops, and comes back
            lasts = size / (m + pull)
    else:  # from rest: straight downhill
        x, y = (fx / pull, fy / pull) if pull > 0 else (zero, zero)
        m = min(m, pull)
    ax, ay = fx - share * m * x, fy - share * m * y
    if phase == SLIDING:
        # friction alone turns the ball: I dw/dt = (-a z) x F
        px, py = (ax - fx) / (kappa * a), (ay - fy) / (kappa * a)
        return (ax, ay, zero), (py, -px, zero), lasts
    return (ax, ay, zero), (-ay / a, ax / a, zero), lasts


@kernel
def _integral(k: float, tau: float) -> tuple[float, float]:
    """Return exp(-k tau) and its integral from 0 to tau, also for k < 0."""
    if k < 0:
        rest, once, _twice = decay_integrals(-k, tau)
        return 1 / rest, once / rest
    rest, once, _twice = decay_integrals(k, tau)
    return rest, once


@kernel
def _time_and_speed(p: float, n: float, k: float, c: float, tau: float) -> tuple[float, float]:
    """Return the time after tau, and |w|, a sum of p exp(-k tau) and n exp(-c tau)."""
    rest, once = _integral(c, tau)
    t, speed = n * once, n * rest
    if p > 0:
        rest, once = _integral(k, tau)
        t, speed = t + p * once, speed + p * rest
    return t, speed


@kernel
def _clock(p: float, n: float, k: float, c: float, s: float) -> float:
    """Return tau at the time s; infinity at the end."""
    p0, n0, k0, c0, s0 = without_slopes(p), without_slopes(n), without_slopes(k), without_slopes(c), without_slopes(s)
    none = 0 * (s + p + n + k + c)
    if k0 > 0 or not p0 > 0:
        ends = n0 / c0 if n0 > 0 and c0 > 0 else 0 * n0
        if n0 > 0 and not c0 > 0:
            ends = math.inf
        ends = ends + (p0 / k0 if p0 > 0 else 0 * p0)
        if s0 >= ends * _time_of_end(none):
            return math.inf + none
    longest = LONGEST / -k0 if k0 < 0 else math.inf
    low, high = 0 * s0, math.inf + 0 * s0
    tau = min(s0 / (p0 + n0), longest)
    for _ in range(MOST_STEPS):
        t, speed = _time_and_speed(p0, n0, k0, c0, tau)
        if t < s0:
            low = tau
        else:
            high = tau
        if not speed > 0:
            break
        after = min(tau + (s0 - t) / speed, tau + longest)
        if not low <= after <= high:
            after = (low + high) / 2 if high < math.inf else 2 * low
        step = abs(after - tau)
        tau = after
        if step <= FOUND * tau:
            break
    t, speed = _time_and_speed(p, n, k, c, tau + none)
    found: float = root_of(tau + none, t - s, speed)
    return found


@kernel
def _moment(k: float, tau: float) -> tuple[float, float, float]:
    """Return exp(-k tau) and the integrals from 0 to tau of it and of tau exp(-k tau)."""
    rest, once, twice = decay_integrals(k, tau)
    if not tau < math.inf:
        return rest, once, once * once
    return rest, once, tau * once - twice


@kernel
def _on_level(x: float, y: float, fx: float, fy: float, m: float, s: float) -> tuple[float, float, float, float]:
    """:func:`_course` where F is zero and has derivatives: to first order in F."""
    size = _size(x, y)
    f = fx * x + fy * y
    tau = math.inf + 0 * (s + m + size + f)
    if not m * s >= size * _time_of_end(tau):
        tau = time_of_integral(m, s / size)
        rest, once, moment = _moment(m, tau)
        tau = root_of(tau, size * once + f * moment - s, (size + f * tau) * rest)
    rest, once, _moment_of_one = _moment(m, tau)
    grows = tau * rest if tau < math.inf else 0 * rest
    _rest, twice, moment = _moment(2 * m, tau)
    return (
        x * rest + fx * size * grows,
        y * rest + fy * size * grows,
        x * size * twice + (fx * size * size + x * f) * moment,
        y * size * twice + (fy * size * size + y * f) * moment,
    )


@kernel
def _course(x: float, y: float, fx: float, fy: float, m: float, s: float) -> tuple[float, float, float, float]:
    """Return w at the time s, and its integral, from w = (x, y) on."""
    pull = _size(fx, fy) if fx != 0 or fy != 0 else 0 * fx
    if not pull > 0:
        return _on_level(x, y, fx, fy, m, s)
    ex, ey = fx / pull, fy / pull
    along, across, size = ex * x + ey * y, ex * y - ey * x, _size(x, y)
    # |w| = p exp(-(m - F) tau) + n exp(-(m + F) tau), w along F their difference: p n = across^2/4
    if along >= 0:
        p = (size + along) / 2
        n = across * across / (4 * p)
    else:
        n = (size - along) / 2
        p = across * across / (4 * n)
    k, c = m - pull, m + pull
    tau = _clock(p, n, k, c, s)
    # (1 - exp(-2 k tau))/(2 k) = (1 + exp(-k tau)) (1 - exp(-k tau))/(2 k)
    rest, once = _integral(c, tau)
    here, way = -n * rest, -n * n * (once * (1 + rest) / 2)
    side, side_way = 0 * n, 0 * n
    if p > 0:
        rest, once = _integral(k, tau)
        here, way = here + p * rest, way + p * p * (once * (1 + rest) / 2)
        rest, once = _integral(m + k, tau)
        side_way = side_way + p * once
    if across != 0 or steepest(across) > 0:
        rest, once = _integral(m + c, tau)
        side_way = across * (side_way + n * once)
        rest, once = _integral(m, tau)
        side = across * rest
    else:
        side_way = 0 * side_way
    return ex * here - ey * side, ey * here + ex * side, ex * way - ey * side_way, ey * way + ex * side_way


@kernel
def advance_on_slope(
    phase: int, x: Vec, v: Vec, w: Vec, a: float, kappa: float, lean: Lean, s: float
) -> tuple[Vec, Vec, Vec]:
    """Return position, velocity and spin a time s later in the same phase; the spin about the vertical as it was."""
    fx, fy, m, q = lean
    _un, u = slip_velocity(v, w, UP, a)
    rolls = phase == ROLLING
    ux, uy = (v[0], v[1]) if rolls else (u[0], u[1])
    now_x, now_y, way_x, way_y = _course(ux, uy, fx, fy, m, s)
    if rolls:
        return (x[0] + way_x, x[1] + way_y, x[2]), (now_x, now_y, v[2]), (-now_y / a, now_x / a, w[2])
    bx, by, h = (1 - q) * fx, (1 - q) * fy, s * s / 2
    cx, cy = v[0] - q * ux, v[1] - q * uy
    vx, vy = cx + bx * s + q * now_x, cy + by * s + q * now_y
    # what friction has given to the velocity turns the ball
    px, py = (vx - v[0] - fx * s) / (kappa * a), (vy - v[1] - fy * s) / (kappa * a)
    return (
        (x[0] + cx * s + bx * h + q * way_x, x[1] + cy * s + by * h + q * way_y, x[2]),
        (vx, vy, v[2]),
        (w[0] + py, w[1] - px, w[2]),
    )


@kernel
def course_error(phase: int, v: Vec, w: Vec, a: float, lean: Lean, ahead: float) -> float:
    """Return the largest distance of a ball within the time ``ahead`` from the parabola of its present acceleration.

    The acceleration is F - q m w/|w|, and changes by 2 q m at most; its rate of change is q m F |w_across|/|w|^2, in which w_across
    only decreases, and |w| stays above its tangent, for it is a convex function of the time.
    """
    fx, fy, m, q = lean
    _un, u = slip_velocity(v, w, UP, a)
    x, y = (v[0], v[1]) if phase == ROLLING else (u[0], u[1])
    most = q * m * ahead * ahead
    size = _size(x, y)
    if not size > 0:
        return most
    least = size + min((fx * x + fy * y) / size - m, 0 * m) * ahead
    if not least > 0:
        return most
    return min(most, q * m * abs(fx * y - fy * x) * ahead * ahead * ahead / (6 * least * least))


# ----------------------------------------------------------------------------------------------------
# Along a wall that bears the ball, with the normal n = c m + s z, m and t = z x m level. Slips, along t, at the floor u = v + a w_m
# and at the wall u' = v - a (c w_z - s w_m). With f and h the friction there, per mass, r and b what resists rolling and spin, and
# N = -F_m/c the push of the wall,
#
#     v' = F_t + f + h,   kappa a w_m' = f + s h + r,   kappa a w_z' = b - c h.
#
# Each of the four is against its slip (u, u', w_m, w_z) and has a largest size (mu (g - s N), mu' N, ...), or holds what does not
# slip: all accelerations are constant. The four are found in turn, over and over, each with the others as they are.


MOST_FRICTION, ROUNDS = 1e9, 200  # slips at a rougher wall end at once; of finding the four


@kernel
def _whole(x: float, least: float) -> float:
    """Return a number without what is rounding."""
    return x if abs(x) > least else 0 * x


@kernel
def _against(slip: float, hold: float, most: float) -> float:
    """Return the friction of at most ``most`` against a slip, or what holds where there is none."""
    return -most if slip > 0 else most if slip < 0 else min(max(hold, -most), most)


@kernel
def _until_zero(x: float, rate: float) -> float:
    """Return when a number that changes at a constant rate is zero, or infinity."""
    return -x / rate if (x > 0 and rate < 0) or (x < 0 and rate > 0) else math.inf + 0 * x


@kernel
def along_wall(
    v: Vec, w: Vec, a: float, kappa: float, force: Vec, g: float, mu: float, resistance: float, spin_friction: float,
    n: Vec, wall_mu: float,
) -> tuple[int, Vec, Vec, Vec, Vec, float]:  # fmt: skip
    """Return the phase of a ball that leans on a wall, its velocity and spin without rounding, acceleration, turn, and duration.

    No normal: it lies between several things, which rub with ``wall_mu``, a deceleration of its spin.
    """
    zero = 0 * (v[0] + w[0])
    c, s = _size(n[0], n[1]), n[2]
    least, tiny = ROUNDING * (_size(v[0], v[1]) + a * (_size(w[0], w[1]) + abs(w[2])) + math.sqrt(g * a)), ROUNDING * g
    mx, my = (n[0] / c, n[1] / c) if c > 0 else (zero, zero)
    speed, y, z = v[1] * mx - v[0] * my, a * (w[0] * mx + w[1] * my), _whole(a * w[2], least)
    push = -(force[0] * mx + force[1] * my) / c if c > 0 else zero
    weight, drive = g - s * push, force[1] * mx - force[0] * my
    most, rubs = mu * weight, min(wall_mu, MOST_FRICTION) * push
    speed, grips, holds = _whole(speed, least), mu > 0, rubs > 0
    slip = _whole(speed + y, least) if grips else zero
    y = -speed if grips and slip == 0 else y
    rub = _whole(speed - c * z + s * y, least) if holds else zero
    z = (speed + s * y) / c if holds and rub == 0 else z
    drag = resistance * weight * (1 + kappa) if grips and slip == 0 else zero
    brake = spin_friction * weight + (wall_mu if not c > 0 else zero)
    f = h = r = b = zero
    for _ in range(ROUNDS):
        f = _against(slip, -(kappa * (drive + h) + s * h + r) / (1 + kappa), most)
        h = _against(rub, -(kappa * (drive + f) + s * (f + r) - c * b) / (1 + kappa), rubs)
        r = _against(y, -f - s * h, drag)
        b = _against(z, c * h, brake)
    up, fall, spin = (
        _whole(drive + f + h, tiny),
        _whole((f + s * h + r) / kappa, tiny),
        _whole((b - c * h) / kappa, tiny),
    )
    rolls = slip == 0 and abs(f) < most
    lasts = min(_until_zero(slip, up + fall), _until_zero(z, spin), _until_zero(rub, up - c * spin + s * fall))
    if rolls:
        lasts = min(lasts, _until_zero(speed, up))
    phase = SLIDING if not rolls else ROLLING if speed != 0 or up != 0 else PIVOTING if z != 0 or spin != 0 else REST
    velocity, spins = (-my * speed, mx * speed, zero), (mx * y / a, my * y / a, z / a)
    return phase, velocity, spins, (-my * up, mx * up, zero), (mx * fall / a, my * fall / a, spin / a), lasts
