"""Motion of a ball in air: drag, Magnus force, decay of the spin, wind; as pieces, each a polynomial of the time.

With u = v - wind, s = |u|, S = a |w| / s and n = w / |w|

    v' = F + s K (-C_D u + C_L n x u),    w' = -(d s / a) w,    K = rho pi a^2 / (2 m),

C_D and C_L functions of s (of the Reynolds number) and S, d the decay of the spin. On the floor, with the load N = -v'_z of these,
a slip q is slowed by the friction mu N, against it; a ball that rolls moves as force and torque of the air turn it about the point
of contact, less (resistance + rolling_drag |v|) N. There is no closed form. A piece of the path is a polynomial. In flight it is
the Taylor series of the velocity, of an order up to MOST_ORDERS, found coefficient by coefficient, as long as its last terms are
small. On the floor, where friction has a corner at a slip of zero, its accelerations are those of the ball at the eight nodes of
Gauss and Radau, found by iteration (E. Everhart, in Dynamics of Comets, eds A. Carusi & G. B. Valsecchi (1985), p. 185; H. Rein &
D. S. Spiegel, MNRAS 446, 1424 (2015)). All is + - * / and sqrt. The end of a piece is no event.

The kernels take the record of a ball. Its ``work`` holds seven numbers for each power of the time (as a share of the span, but for
the first two): velocity (relative to the air while the series is found); in flight the speed in the air, s C_D, s C_L / |w| and the
share of the spin that is left, on the floor the spin. Then work memory.
"""

from __future__ import annotations

import math
from typing import Any

from carom.core.contact import one_contact, slip_velocity
from carom.core.jit.kernel import Vec, carries_slopes, cross, dot, kernel, vector, without_slopes
from carom.core.motion.phases import (
    FLIGHT,
    LAST_HOP,
    MOST_HOPS,
    PIVOTING,
    REST,
    ROLLING,
    SLIDING,
    UP,
    acts,
    restitution,
    rolls_at_last,
)

IN_AIR = 2  # of ``decays``: the ball feels the air, and its path is the piece that its record holds

NODES = (
    0.0, 0.05626256053692215, 0.18024069173689236, 0.35262471711316964, 0.5471536263305554, 0.7342101772154105,
    0.8853209468390958, 0.9775206135612875,
)  # fmt: skip


def _through(k: int) -> tuple[float, ...]:
    """Return the coefficients of the powers 0 to 7 of t of the polynomial that is 1 at node k, and 0 at the others."""
    found = [1.0]
    for m, node in enumerate(NODES):
        if m != k:
            c = 1 / (NODES[k] - node)
            found = [c * (low - node * high) for low, high in zip([0.0, *found], [*found, 0.0], strict=True)]
    return tuple(found)


def _integral(k: int, node: float) -> float:
    """Return the integral from 0 to a node of the polynomial that is 1 at node k."""
    powers, found = _through(k), 0.0
    for p in range(7, 0, -1):
        found += powers[p] * node ** (p + 1) / (p + 1)
    return found


# Of values at the nodes 1 to 7, 7 a row: the integrals from 0 to each node; the coefficients of the powers 1 to 7
MATRIX: tuple[float, ...] = (
    *(_integral(k, node) for node in NODES[1:] for k in range(1, 8)),
    *(_through(k)[p] for p in range(1, 8) for k in range(1, 8)),
)
MOST_ORDERS = 16
SHARES = tuple(1 / (k + 1) for k in range(MOST_ORDERS + 1))
SPEED, DRAG, FADE, LIFT = 3, 4, 5, 6  # columns in flight
# Of ``work``: accelerations at the nodes 1 to 7; a sixth of how fast the acceleration changes at most, and how far the ball comes
RATES, ERROR, WAY = 70, 120, 121

FINEST, FINEST_SPEED = 3e-14, 2e-12  # m, m/s: how far place and velocity may be from the polynomial of one degree more
LAST_TERM = 5e-13  # m/s: of a series
OFF, OFF_SPEED = 1.4e-7, 2.25e-6  # the largest values of the second and the first integral of t (t - t_1) ... (t - t_7)
SHORTEST = 1e-15  # s
# A change of a velocity that is rounding, as shares of the piece's and of the ball's own; rounds of finding
# accelerations
SETTLED, ROUNDING, MOST_ROUNDS = 2e-12, 4e-16, 20
# Drag has a corner where a ball turns round in the air: pieces that begin below this speed, m/s, have the laws of where they begin.
# As shares of the time in which that speed changes by itself: the longest piece while it falls, and while it grows (rounding grows
# with its powers), and the first one on the floor.
SLOW, SLOW_ON_FLOOR, CORNER, NOISE, CORNER_OF_SLIP, FIRST = 5e-4, 5e-6, 0.5, 4.0, 0.45, 0.25
LONGEST = 100.0  # s
LAWS = 24  # segments of all laws of drag and lift
CLOSE = 1e-6  # s: within that time a law is left at no knot
STRAIGHT = 2.0  # of ``course``: the direction is that to the end; 1: in the piece that ends the slip
# What ends with a piece: nothing, the phase, the spin about the vertical, or what is followed
GOES_ON, PHASE_ENDS, SPIN_ENDS, LOST = range(4)
# m/s: friction has a corner where a slip, and rolling resistance where a velocity, is zero; below this all but the slip is constant
LEAST_SLIP = 1e-7


@kernel
def _root(x: float) -> float:
    """Return the square root; of zero one without derivatives."""
    return math.sqrt(x) if x > 0 else 0 * x


@kernel
def _without_spin(laws: Any, k: int, s: float) -> float:
    """Return s C by segment k of a law, of a speed s, C = (p0 + p1 s + p2/s + p3/s^2 + q S)/(1 + r S), without the spin's part."""
    c = laws[8 * k + 2] * s + laws[8 * k + 3] * s * s + laws[8 * k + 4]
    return c + laws[8 * k + 5] / s if laws[8 * k + 5] != 0 and s > 0 else c  # type: ignore[no-any-return]


@kernel
def _share(laws: Any, k: int, s: float, spin: float) -> float:
    """Return 1 / (1 + r S) of segment k, with ``spin`` = a |w|."""
    r = laws[8 * k + 7] * spin
    return s / (s + r) if r > 0 else 1 + 0 * s


@kernel
def air_rates(world: Any, ball: Any, v: Vec, w: Vec, fixed: float) -> tuple[Vec, Vec]:
    """Return acceleration and angular acceleration in flight; a speed ``fixed`` >= 0 stands in the place of that in the laws."""
    a, force, c = ball.radius, world.force, 1 - ball.buoyancy
    u = (v[0] - world.wind[0], v[1] - world.wind[1], v[2] - world.wind[2])
    s = _root(dot(u, u)) if fixed < 0 else fixed + 0 * v[0]
    size, laws, d, k = _root(dot(w, w)), world.laws, ball.drag_now, ball.lift_now
    drag = _without_spin(laws, d, s) + laws[8 * d + 6] * a * size
    drag = ball.air * drag * _share(laws, d, s, a * size)
    # s C_L / |w|
    lift, rest, fade = laws[8 * k + 6] * a, _without_spin(laws, k, s), 0 * s
    if size > 0 and acts(abs(rest)):
        lift = lift + rest / size
    lift = ball.air * lift * _share(laws, k, s, a * size)
    side = cross(w, u)
    if acts(ball.spin_decay):
        fade = -ball.spin_decay * s / a
    acc = (
        c * force[0] - drag * u[0] + lift * side[0],
        c * force[1] - drag * u[1] + lift * side[1],
        c * force[2] - drag * u[2] + lift * side[2],
    )
    return acc, (fade * w[0], fade * w[1], fade * w[2])


@kernel
def _friction_of(world: Any, ball: Any) -> float:
    """Return the friction of the floor that slows the ball's slip, or its rolling: mu, or the rolling resistance."""
    if ball.phase == SLIDING:
        return world.floor_mu  # type: ignore[no-any-return]
    return world.resistance if ball.phase == ROLLING else 0 * world.resistance  # type: ignore[no-any-return]


@kernel
def _slip(ball: Any, v: Vec, w: Vec) -> tuple[float, float]:
    """Return what the friction acts against: the slip, or the velocity of a ball that rolls."""
    if ball.phase != SLIDING:
        return v[0], v[1]
    _un, u = slip_velocity(v, w, UP, ball.radius)
    return u[0], u[1]


@kernel
def piece_rates(world: Any, ball: Any, v: Vec, w: Vec, fixed: float) -> tuple[Vec, Vec]:
    """Return acceleration and angular acceleration of a ball in its phase."""
    air, spun = air_rates(world, ball, v, w, fixed)
    if ball.phase == FLIGHT:
        return air, spun
    a, kappa, load, none = ball.radius, ball.kappa, -air[2], 0 * air[2]
    x, y = ball.course[0], ball.course[1]
    if ball.course[2] == 0:
        x, y = _slip(ball, v, w)
        size = _root(x * x + y * y)
        c = 1 / size if size > 0 else none
        x, y = c * x, c * y
    c = 1 / (kappa * a)
    loss = c * world.spin_friction * load
    if acts(world.spin_damping):
        loss = loss + world.spin_damping * abs(w[2])
    if ball.phase == ROLLING and acts(world.spin_drag):
        loss = loss + world.spin_drag * _root(v[0] * v[0] + v[1] * v[1])
    turn = spun[2] - ball.sense * loss
    f = -_friction_of(world, ball) * load
    x, y = f * x, f * y
    if ball.phase == SLIDING:
        return (air[0] + x, air[1] + y, none), (spun[0] + y * c, spun[1] - x * c, turn)
    if ball.phase != ROLLING:
        return (none, none, none), (none, none, turn)
    # (39), of accelerations
    b, _turn = rolls_at_last(air, spun, a, kappa)
    f = world.rolling_drag * load
    x, y = b[0] + x - f * v[0], b[1] + y - f * v[1]
    return (x, y, none), (-y / a, x / a, turn)


@kernel
def _hold(world: Any, ball: Any, v: Vec, w: Vec) -> float:
    """Return how far the air is from what ends a phase on the floor, m/s^2: that it lifts the ball, or breaks its hold."""
    air, spun = air_rates(world, ball, v, w, -1.0)
    load = without_slopes(-air[2])
    if ball.phase == SLIDING or not load > 0:
        return float(load)
    b, _turn = rolls_at_last(air, spun, ball.radius, ball.kappa)
    x, y = without_slopes(b[0]), without_slopes(b[1])
    if ball.phase != ROLLING:
        return float(without_slopes(world.resistance) * load - math.sqrt(x * x + y * y))
    x, y = x - without_slopes(air[0]), y - without_slopes(air[1])
    return float(min(load, without_slopes(world.floor_mu) * load - math.sqrt(x * x + y * y)))


@kernel
def phase_in_air(world: Any, ball: Any, phase: int, v: Vec, w: Vec) -> int:
    """Return the phase of a ball that would be in ``phase`` on the floor of a vacuum: air lifts it, or sets it going."""
    enter_segments(world, ball, v, w, True)
    air, spun = air_rates(world, ball, v, w, -1.0)
    load = without_slopes(-air[2])
    if not load > 0:
        return FLIGHT
    b, _turn = rolls_at_last(air, spun, ball.radius, ball.kappa)
    x, y = without_slopes(b[0]), without_slopes(b[1])
    f, g = x - without_slopes(air[0]), y - without_slopes(air[1])
    if phase != SLIDING and f * f + g * g > 0 and math.sqrt(f * f + g * g) > without_slopes(world.floor_mu) * load:
        return SLIDING
    still = PIVOTING <= phase <= REST
    return ROLLING if still and math.sqrt(x * x + y * y) > without_slopes(world.resistance) * load else phase


@kernel
def hop_in_air(world: Any, ball: Any, v: Vec, w: Vec) -> tuple[float, Vec, Vec, Vec, Vec]:
    """Return the duration of a low hop, in which the accelerations change at a constant rate; they, each with its rate.

    It is infinite where the air lifts the ball.
    """
    enter_segments(world, ball, v, w, True)
    acc, turn = air_rates(world, ball, v, w, -1.0)
    none = (0 * v[2], 0 * v[2], 0 * v[2])
    if not acc[2] < 0:
        return math.inf + none[0], acc, none, turn, none
    t = -2 * v[2] / acc[2]
    end = (v[0] + acc[0] * t, v[1] + acc[1] * t, v[2] + acc[2] * t)
    later, spun = air_rates(world, ball, end, (w[0] + turn[0] * t, w[1] + turn[1] * t, w[2] + turn[2] * t), -1.0)
    jerk, rate = none, none
    if t > 0:
        jerk = ((later[0] - acc[0]) / t, (later[1] - acc[1]) / t, (later[2] - acc[2]) / t)
        rate = ((spun[0] - turn[0]) / t, (spun[1] - turn[1]) / t, (spun[2] - turn[2]) / t)
    # v - half t + jerk t^2/6 = 0
    half = -acc[2] / 2
    square = half * half - 2 * jerk[2] * v[2] / 3
    return (2 * v[2] / (half + math.sqrt(square)) if square > 0 else t), acc, jerk, turn, rate


@kernel
def bounces_in_air(world: Any, ball: Any, until: float) -> tuple[Vec, Vec, Vec, float]:
    """:func:`carom.core.motion.phases.bounces` in air."""
    x, v, w, t = vector(ball.x), vector(ball.v), vector(ball.w), 0 * ball.radius
    first, form, p = v[2], world.floor_form, vector(world.floor_p)
    for _ in range(MOST_HOPS):
        hop, acc, jerk, turn, rate = hop_in_air(world, ball, v, w)
        inside = t + hop > until
        if not inside and v[2] <= LAST_HOP * first:
            if v[2] > 0:
                hop = hop / (1 - restitution(form, p, v[2]))
                t = t + hop
                x = (x[0] + v[0] * hop, x[1] + v[1] * hop, x[2])
            break
        s = until - t if inside else hop
        h, k = s * s / 2, s * s * s / 6
        x = (
            x[0] + v[0] * s + acc[0] * h + jerk[0] * k,
            x[1] + v[1] * s + acc[1] * h + jerk[1] * k,
            x[2] + v[2] * s + acc[2] * h + jerk[2] * k if inside else x[2],
        )
        v = (v[0] + acc[0] * s + jerk[0] * h, v[1] + acc[1] * s + jerk[1] * h, v[2] + acc[2] * s + jerk[2] * h)
        w = (w[0] + turn[0] * s + rate[0] * h, w[1] + turn[1] * s + rate[1] * h, w[2] + turn[2] * s + rate[2] * h)
        if inside:
            return x, v, w, until
        t = t + hop
        e = restitution(form, p, -v[2])
        v, w, _j, _required, _regime = one_contact(
            v, w, UP, ball.radius, ball.kappa, e, world.floor_mu, world.floor_beta
        )
    return x, (v[0], v[1], 0 * t), w, t


@kernel
def _series(ball: Any, i: int, t: float) -> tuple[Vec, Vec]:
    """Return columns i to i + 2 of the piece's polynomials, from the second power on, at a share t of the span; and their integrals
    over the time, over its square.
    """
    c, h, none = ball.work, ball.span, 0 * t
    x, y, z, p, q, r = none, none, none, none, none, none
    for n in range(ball.order - 1):
        k = ball.order - n
        share, k = SHARES[k], 7 * k + i
        x, y, z = (x + c[k]) * t, (y + c[k + 1]) * t, (z + c[k + 2]) * t
        p, q, r = (p + share * c[k]) * t, (q + share * c[k + 1]) * t, (r + share * c[k + 2]) * t
    return (x * t, y * t, z * t), (p / h, q / h, r / h)


@kernel
def place_in_piece(ball: Any, s: float) -> tuple[Vec, Vec, Vec]:
    """Return position, velocity and spin a time s after the beginning of the piece."""
    t, h, x, v, b = s / ball.span, s * s, ball.x, ball.v, ball.acc
    e, d = _series(ball, 0, t)
    place = (
        x[0] + v[0] * s + h * (b[0] / 2 + d[0]), x[1] + v[1] * s + h * (b[1] / 2 + d[1]), x[2] + v[2] * s + h * (b[2] / 2 + d[2]),
    )  # fmt: skip
    return place, (v[0] + s * b[0] + e[0], v[1] + s * b[1] + e[1], v[2] + s * b[2] + e[2]), spin_in_piece(ball, s)


@kernel
def spin_in_piece(ball: Any, s: float) -> Vec:
    """Return the spin a time s after the beginning of the piece."""
    w, b = ball.w, ball.turn
    if ball.phase == FLIGHT and not acts(ball.spin_decay):
        return (w[0] + 0 * s, w[1] + 0 * s, w[2] + 0 * s)
    e, _d = _series(ball, SPEED, s / ball.span)
    if ball.phase == FLIGHT:
        f = 1 + e[2]
        return (w[0] * f + s * b[0], w[1] * f + s * b[1], w[2] * f + s * b[2])
    z = w[2] + s * b[2] + e[2]
    # (the spin about the vertical ends, and does not turn round)
    return (w[0] + s * b[0] + e[0], w[1] + s * b[1] + e[1], z if ball.sense * without_slopes(z) > 0 else 0 * z)


@kernel
def fall_in_piece(ball: Any, s: float) -> Vec:
    """Return height, and its first two derivatives, a time s after the beginning of the piece."""
    c, t, h, x, v, b = ball.work, s / ball.span, ball.span, ball.x[2], ball.v[2], ball.acc[2]
    e, d, a = 0 * t, 0 * t, 0 * t
    for n in range(ball.order - 1):
        k = ball.order - n
        g = c[7 * k + 2]
        e, d, a = (e + g) * t, (d + SHARES[k] * g) * t, (a + k * g) * t
    return (x + v * s + s * s * (b / 2 + d / h), v + s * b + e * t, b + a / h)


@kernel
def _size(ball: Any, k: int) -> float:
    """Return the size of the coefficients of a power, of a point of the surface of a ball on the floor."""
    c, i, a = ball.work, 7 * k, ball.radius
    turn = c[i + 3] * c[i + 3] + c[i + 4] * c[i + 4] + c[i + 5] * c[i + 5]
    return _root(c[i] * c[i] + c[i + 1] * c[i + 1] + c[i + 2] * c[i + 2] + a * a * turn)


@kernel
def _coefficient(laws: Any, k: int, ball: Any, n: int, column: int, square: float, spin: float, size: float) -> float:
    """Return coefficient n of s C by segment k of a law, over ``size``; ``square``: that of s^2, ``spin`` = a |w| at the beginning.

    The former ones are in a column of ``work``, from which the quotients of (1 + r S) and of p3 / s follow.
    """
    c, i, r, q = ball.work, 7 * n, laws[8 * k + 7] * spin, laws[8 * k + 6] * ball.radius
    s, fades, p0 = c[SPEED], acts(ball.spin_decay), laws[8 * k + 2]
    if column == DRAG:
        q = laws[8 * k + 6] * spin
    if n == 0:
        found = q + _without_spin(laws, k, s) / size if size > 0 else q
        return found * _share(laws, k, s, spin)  # type: ignore[no-any-return]
    found = q * c[i + FADE] if fades else 0 * q
    if size > 0:
        found = found + (p0 * c[i + SPEED] + laws[8 * k + 3] * square) / size
    if r > 0:
        # X (s + r f) = N s, of N without quotients
        found = found * s
        for m in range(n):
            j, o = 7 * m, 7 * (n - m)
            before, below = q * c[j + FADE] if fades or m == 0 else 0 * q, c[o + SPEED]
            if size > 0:
                before = before + p0 * c[j + SPEED] / size
            if fades:
                below = below + r * c[o + FADE]
            found = found + before * c[o + SPEED] - c[j + column] * below
        found = found / (s + r)
    if laws[8 * k + 5] != 0 and size > 0 and s > 0:
        # X = p0 s + p2 + p3/s
        rest = 0 * found
        for m in range(n):
            j = 7 * m
            one = c[j + column] - (p0 * c[j + SPEED] + (laws[8 * k + 4] + 0 * s if m == 0 else 0 * s)) / size
            rest = rest + one * c[7 * (n - m) + SPEED]
        found = found - rest / s
    return found  # type: ignore[no-any-return]


@kernel
def _speed_terms(c: Any, n: int) -> tuple[float, float]:
    """Return coefficient n of the square of the speed in the air, and of the speed."""
    square, known, i = 0 * c[0], 0 * c[0], 7 * n
    for m in range(n + 1):
        j, o = 7 * m, i - 7 * m
        square = square + (c[j] * c[o] + c[j + 1] * c[o + 1] + c[j + 2] * c[o + 2])
        if 0 < m < n:
            known = known + c[j + SPEED] * c[o + SPEED]
    return square, _root(square) if n == 0 else (square - known) / (2 * c[SPEED])


@kernel
def _times_velocity(c: Any, column: int, n: int, first: int) -> Vec:
    """Return coefficient n of a column's product with the velocity, without the column's coefficients before the first."""
    x, y, z = 0 * c[0], 0 * c[0], 0 * c[0]
    for m in range(first, n + 1):
        g, o = c[7 * m + column], 7 * (n - m)
        x, y, z = x + g * c[o], y + g * c[o + 1], z + g * c[o + 2]
    return x, y, z


@kernel
def _expand(world: Any, ball: Any, fixed: float, horizon: float) -> float:
    """Find the series of a flight, to an order that is enough up to ``horizon``; return how long it is right."""
    c, laws, a, w = ball.work, world.laws, ball.radius, vector(ball.w)
    size, fade, fades = _root(dot(w, w)), -ball.spin_decay / ball.radius, acts(ball.spin_decay)
    # (a lift along the spin ratio alone is that spin's, which stays)
    k = 8 * ball.lift_now
    varies = (
        fades or acts(laws[k + 2]) or acts(laws[k + 3]) or acts(laws[k + 4]) or acts(laws[k + 5]) or acts(laws[k + 7])
    )
    for i in range(3):
        c[i], c[i + 7] = ball.v[i] - world.wind[i], ball.acc[i]
    c[FADE], ball.order = 1 + 0 * a, MOST_ORDERS
    here, last, reach, small = 0.0, 0.0, horizon, LAST_TERM * LAST_TERM
    for n in range(MOST_ORDERS):
        i, square = 7 * n, 0 * a
        if fixed >= 0:
            c[i + SPEED] = fixed + 0 * a if n == 0 else 0 * a
        else:
            square, c[i + SPEED] = _speed_terms(c, n)
        c[i + DRAG] = _coefficient(laws, ball.drag_now, ball, n, DRAG, square, a * size, 1.0)
        if varies or n == 0:
            c[i + LIFT] = _coefficient(laws, ball.lift_now, ball, n, LIFT, square, a * size, size)
        if fades:
            f = 0 * a
            for m in range(n + 1):
                f = f + c[7 * m + SPEED] * c[i - 7 * m + FADE]
            c[i + 7 + FADE] = fade * f * SHARES[n]
        if n == 0:
            continue
        back, (x, y, z) = _times_velocity(c, DRAG, n, 0), _times_velocity(c, LIFT, n, 1 if varies else n + 1)
        side = cross(w, (c[LIFT] * c[i] + x, c[LIFT] * c[i + 1] + y, c[LIFT] * c[i + 2] + z))
        g, i, before = ball.air * SHARES[n], i + 7, here
        c[i], c[i + 1], c[i + 2] = g * (side[0] - back[0]), g * (side[1] - back[1]), g * (side[2] - back[2])
        f = a * size * c[i + FADE] if fades else 0 * a
        here, reach = without_slopes(c[i] * c[i] + c[i + 1] * c[i + 1] + c[i + 2] * c[i + 2] + f * f), reach * horizon
        far = here * (reach * reach)
        if n > 3 and far <= small and last <= small:
            ball.order = n + 1
            break
        last = far
    h = horizon
    if ball.order == MOST_ORDERS and max(here, before) > 0:
        # the 32nd root
        h = min(h, 0.9 * math.sqrt(math.sqrt(_eighth_root(small / max(here, before)))))
    reach = h
    for n in range(2, ball.order + 1):
        reach, i = reach * h, 7 * n
        c[i], c[i + 1], c[i + 2] = reach * c[i], reach * c[i + 1], reach * c[i + 2]
        if fades:
            c[i + FADE] = reach * c[i + FADE]
    return float(h)


@kernel
def _guess(ball: Any, shift: float, ratio: float) -> None:
    """Begin with accelerations of the polynomial there is, from the share ``shift`` of its span on, over ``ratio`` of its span."""
    c, h = ball.work, ball.span
    for o in range(5):
        first, i = 0 * h, o + 1 if o > 1 else o  # (not the vertical velocity)
        for n in range(8):
            t, value = shift + ratio * NODES[n], 0 * h
            for k in range(7 if ratio > 0 else 0):
                value = (value + (8 - k) * c[56 - 7 * k + i]) * t
            first = value if n == 0 else first
            c[RATES + 5 * (n - 1) + o] = (value - first) / h if ratio > 0 else value


@kernel
def _at_nodes(c: Any, row: int) -> tuple[float, float, float, float, float]:
    """Return the product of seven numbers of MATRIX with the accelerations at the nodes: two of the ball, three of its spin."""
    x, y, p, q, r = 0 * c[RATES], 0 * c[RATES], 0 * c[RATES], 0 * c[RATES], 0 * c[RATES]
    for k in range(7):
        g, o = MATRIX[row + k], RATES + 5 * k
        x, y, p, q, r = x + g * c[o], y + g * c[o + 1], p + g * c[o + 2], q + g * c[o + 3], r + g * c[o + 4]
    return x, y, p, q, r


@kernel
def _collocate(world: Any, ball: Any, fixed: float) -> float:
    """Find the polynomial over the ball's span; return the error within it, in m, which is to be FINEST (infinity: there is none).

    Rounds from node to node: the velocity there by the integral of the accelerations, and the acceleration by the velocity, until
    the next round would change rounding only: as much less than this one as this one changed less than the one before.
    """
    c, acc, turn = ball.work, vector(ball.acc), vector(ball.turn)
    v, w, h, a = vector(ball.v), vector(ball.w), ball.span, ball.radius
    scale = without_slopes(h * (_root(dot(acc, acc)) + a * _root(dot(turn, turn))))
    rounding = SETTLED * scale + ROUNDING * without_slopes(_root(dot(v, v)) + a * _root(dot(w, w)))
    # (slopes of a slip that ends follow it slowly)
    least = MOST_ROUNDS - 1 if carries_slopes(acc[0] + acc[1] + acc[2]) else 1
    before, settled, ball.order = math.inf, False, 8
    for n in range(1, 8):
        i, (x, y, p, q, r) = 7 * n + 7, _at_nodes(c, 7 * n - 7)
        c[i], c[i + 1], c[i + 2], c[i + 3], c[i + 4], c[i + 5] = x, y, 0 * x, p, q, r
    for count in range(MOST_ROUNDS):
        last = 0.0
        for n in range(1, 8):
            t, i, o = NODES[n], 7 * n + 7, RATES + 5 * (n - 1)
            x, y, p, q, r = _at_nodes(c, 7 * n - 7)
            turned = a * (abs(p - c[i + 3]) + abs(q - c[i + 4]) + abs(r - c[i + 5]))
            last = max(last, without_slopes(h * (abs(x - c[i]) + abs(y - c[i + 1]) + turned)))
            c[i], c[i + 1], c[i + 3], c[i + 4], c[i + 5] = x, y, p, q, r
            b, spun = piece_rates(
                world, ball, (v[0] + h * (t * acc[0] + x), v[1] + h * (t * acc[1] + y), v[2] + h * (t * acc[2])),
                (w[0] + h * (t * turn[0] + p), w[1] + h * (t * turn[1] + q), w[2] + h * (t * turn[2] + r)), fixed,
            )  # fmt: skip
            c[o], c[o + 1] = b[0] - acc[0], b[1] - acc[1]
            c[o + 2], c[o + 3], c[o + 4] = spun[0] - turn[0], spun[1] - turn[1], spun[2] - turn[2]
        settled = last <= rounding or (2 * last <= before and last * last <= rounding * before)
        if settled and count >= least:
            break
        before = last
    for n in range(1, 8):
        i, t, (x, y, p, q, r) = 7 * n + 7, h * SHARES[n], _at_nodes(c, 7 * n + 42)
        c[i], c[i + 1], c[i + 3], c[i + 4], c[i + 5] = t * x, t * y, t * p, t * q, t * r
    # (a spin that turns round has a corner within: there one of them may be small by chance)
    low, high, higher = (
        6 * without_slopes(_size(ball, 6)),
        7 * without_slopes(_size(ball, 7)),
        8 * without_slopes(_size(ball, 8)),
    )
    ratio = min(1.0, max(higher / high, high / low)) if high > 0 and low > 0 else 1.0
    off = max(OFF * without_slopes(h), OFF_SPEED * FINEST / FINEST_SPEED)
    return float(off * ratio * max(higher, ratio * high)) if settled else math.inf


@kernel
def _eighth_root(x: float) -> float:
    return math.sqrt(math.sqrt(math.sqrt(x)))


@kernel
def _segment(laws: Any, first: int, last: int, s: float, share: float, rises: bool, grows: bool) -> int:
    """Return which segment of a law holds at a speed s, which rises or falls, and a spin ratio that does."""
    for k in range(first, last):
        x, up = (share, grows) if laws[8 * k] != 0 else (s, rises)
        high = without_slopes(laws[8 * k + 1])
        near = abs(x - high) <= 1e-9 * high
        if (near and not up) or (x < high and not near):
            return k
    return last


@kernel
def _ratio(ball: Any, s: float, w: Vec) -> float:
    """Return S, or a large number where the ball is at rest in the air."""
    return ball.radius * _root(dot(w, w)) / s if s > 0 else 1e300 + 0 * s


@kernel
def _cut(world: Any, ball: Any, now: int, first: int) -> float:
    """Return the first time in the piece at which it leaves a segment of a law, or its span."""
    low = 0.0 if now == first else without_slopes(world.laws[8 * now - 7])
    high, over = without_slopes(world.laws[8 * now + 1]), world.laws[8 * now]
    span = without_slopes(ball.span)
    before = 0.0
    for n in range(1, 9):
        t = NODES[n] if n < 8 else 1.0
        x = without_slopes(_argument(world, ball, over, t))
        if not low <= x <= high and t * span > CLOSE:
            edge, after = low if x < low else high, t
            for _ in range(60):
                middle = (before + after) / 2
                x = without_slopes(_argument(world, ball, over, middle))
                inside = x > low if edge == low else x < high
                before, after = (middle, after) if inside else (before, middle)
            return float(max(after * span, CLOSE))
        before = t
    return float(span)


@kernel
def _argument(world: Any, ball: Any, over: float, t: float) -> float:
    """Return the speed relative to the air, or the spin ratio, at a share t of the span."""
    _x, v, w = place_in_piece(ball, t * ball.span)
    u = (v[0] - world.wind[0], v[1] - world.wind[1], v[2] - world.wind[2])
    s = _root(dot(u, u))
    return _ratio(ball, s, w) if over != 0 else s


@kernel
def enter_segments(world: Any, ball: Any, v: Vec, w: Vec, speeds_up: bool) -> float:
    """Let the laws be as they are on the segments in which a ball is, or which it enters; return its speed in the air."""
    u = (v[0] - world.wind[0], v[1] - world.wind[1], v[2] - world.wind[2])
    s = without_slopes(_root(dot(u, u)))
    share = without_slopes(_ratio(ball, s, w))
    # (a spin ratio grows where the speed falls)
    ball.drag_now = _segment(world.laws, ball.drag, ball.drag_last, s, share, speeds_up, not speeds_up)
    ball.lift_now = _segment(world.laws, ball.lift, ball.lift_last, s, share, speeds_up, not speeds_up)
    return float(s)


@kernel
def _is_straight(world: Any, ball: Any, x: float, y: float, size: float) -> bool:
    """Return whether all that moves a ball with a slip (x, y) is along that and up: then friction keeps its course to the end."""
    v, w, wind = ball.v, ball.w, world.wind
    if carries_slopes(x) or not size > LEAST_SLIP or w[2] != 0:
        return False
    x, y = x / size, y / size
    across, turns, blows = abs(v[0] * y - v[1] * x), abs(w[0] * x + w[1] * y), abs(wind[0] * y - wind[1] * x)
    return bool(across + ball.radius * turns + blows <= 1e-15 * (abs(v[0]) + abs(v[1])))


@kernel
def _approach(world: Any, ball: Any, acc: Vec, turn: Vec, load: float) -> float:
    """Return how long the piece may last for the corner of friction at a slip of zero; near that the friction keeps its course.

    A piece in which the slip ends lasts so long, and ends the phase.
    """
    f = _friction_of(world, ball)
    ball.course[2] = 0 * load
    if not without_slopes(f) > 0:
        return LONGEST + 0 * load
    x, y = _slip(ball, vector(ball.v), vector(ball.w))
    size, m = _root(x * x + y * y), f * load
    p, q = acc[0], acc[1]
    if ball.phase == SLIDING:
        p, q, m = acc[0] - ball.radius * turn[1], acc[1] + ball.radius * turn[0], m * (1 + 1 / ball.kappa)
    if _is_straight(world, ball, x, y, size):
        ball.course[0], ball.course[1], ball.course[2] = x / size, y / size, STRAIGHT + 0 * load
        rate = p * x + q * y
        return -size * size / rate if rate < 0 else LONGEST + 0 * load
    if without_slopes(size) > LEAST_SLIP:
        falls = max(without_slopes(_root(p * p + q * q)), without_slopes(m))
        return CORNER_OF_SLIP * without_slopes(size) / falls + 0 * load  # type: ignore[no-any-return]
    # (at rest it sets off where it is driven; ``acc`` has no friction then)
    if not size > 0:
        size, drive = 0 * load, _root(p * p + q * q)
        x, y, rate = (p / drive, q / drive, drive - m) if drive > 0 else (size, size, -m)
    else:
        x, y = x / size, y / size
        rate = p * x + q * y
        # q' = D - m q/|q|: m |q| + D.q falls at the constant rate m^2 - |D|^2; the friction's mean direction is (q/t + D)/m
        p, q = p + m * x, q + m * y
        closes = m * m - p * p - q * q
        if m > 0 and closes > 0:
            closes = size * (m + p * x + q * y) / closes
            x, y, rate = (x * size / closes + p) / m, (y * size / closes + q) / m, -size / closes
    ball.course[0], ball.course[1], ball.course[2] = x, y, 1 + 0 * load
    if not rate > 0:
        ball.ends = PHASE_ENDS
        return -size / rate if rate < 0 else size
    return min(LEAST_SLIP / without_slopes(rate), LONGEST) + 0 * load  # type: ignore[no-any-return]


@kernel
def _left_on_floor(world: Any, ball: Any) -> float:
    """Return the first time in the piece at which the spin about the vertical has ended, or the air breaks a hold; or its span."""
    span, before = without_slopes(ball.span), 0.0
    for n in range(1, 3):
        t = n / 2
        if _stays(world, ball, t) != GOES_ON:
            for _ in range(60):
                middle = (before + t) / 2
                before, t = (middle, t) if _stays(world, ball, middle) == GOES_ON else (before, middle)
            ball.ends = _stays(world, ball, t)
            return float(t * span)
        before = t
    return float(span)


@kernel
def _stays(world: Any, ball: Any, t: float) -> int:
    """Return what has ended at a share t of the span."""
    _x, v, w = place_in_piece(ball, t * ball.span)
    if without_slopes(ball.course[2]) == STRAIGHT:
        x, y = _slip(ball, v, w)
        if not x * ball.course[0] + y * ball.course[1] > 0:
            return PHASE_ENDS
    if ball.sense != 0 and not ball.sense * without_slopes(w[2]) > 0:
        return PHASE_ENDS if ball.phase == PIVOTING else SPIN_ENDS
    return GOES_ON if without_slopes(ball.course[2]) == 1 or _hold(world, ball, v, w) > 0 else LOST


@kernel
def begin_piece(world: Any, ball: Any, guess: float, horizon: float) -> None:
    """Find the piece of a ball's path that begins now, no longer than ``horizon``; on the floor as ``guess`` has it (0: none)."""
    v, w, flies = vector(ball.v), vector(ball.w), ball.phase == FLIGHT
    u = (v[0] - world.wind[0], v[1] - world.wind[1], v[2] - world.wind[2])
    s = enter_segments(world, ball, v, w, True)
    slow = SLOW if flies else SLOW_ON_FLOOR
    fixed = s if s < slow else -1.0
    ball.ends, ball.course[2] = GOES_ON, 0 * s
    ball.sense = 0 if flies else 1 if w[2] > 0 else -1 if w[2] < 0 else 0
    acc, turn = piece_rates(world, ball, v, w, fixed)
    speeds_up = bool(without_slopes(dot(u, acc)) > 0)
    if ball.drag_last > ball.drag or ball.lift_last > ball.lift:
        enter_segments(world, ball, v, w, speeds_up)
        acc, turn = piece_rates(world, ball, v, w, fixed)
    closes, air = LONGEST + 0 * ball.radius, acc
    if not flies:
        air, _spun = air_rates(world, ball, v, w, fixed)
        closes = _approach(world, ball, acc, turn, -air[2])
        if ball.course[2] != 0:
            acc, turn = piece_rates(world, ball, v, w, fixed)
    for k in range(3):
        ball.acc[k], ball.turn[k] = acc[k], turn[k]
    size, longest = without_slopes(_root(dot(acc, acc))), min(without_slopes(closes), LONGEST)
    straight = without_slopes(ball.course[2]) == STRAIGHT
    if fixed >= 0:
        longest = min(longest, slow / size if size > 0 else LONGEST)
    elif size > 0 and not (straight and ball.phase == ROLLING and without_slopes(dot(world.wind, world.wind)) == 0):
        longest = min(longest, (NOISE if speeds_up else CORNER) * s / size)
    longest = min(longest, horizon)
    if flies:
        ball.span = _expand(world, ball, fixed, longest)
    else:
        _relax(world, ball, fixed, guess, longest, s, air)
    lasts = without_slopes(ball.span)
    if ball.drag_last > ball.drag:
        lasts = min(lasts, _cut(world, ball, ball.drag_now, ball.drag))
    if ball.lift_last > ball.lift:
        lasts = min(lasts, _cut(world, ball, ball.lift_now, ball.lift))
    ball.lasts = lasts
    if not flies and ball.ends == GOES_ON:
        left = _left_on_floor(world, ball)
        ball.ends, ball.lasts = (ball.ends, left) if without_slopes(left) <= lasts else (GOES_ON, lasts)
    elif ball.ends == PHASE_ENDS and lasts < without_slopes(closes):
        ball.ends = GOES_ON
    elif ball.ends == PHASE_ENDS:
        ball.lasts = closes
    bends, way = 0 * ball.span, _root(dot(v, v)) + size * ball.span / 2
    for k in range(2, ball.order + 1):
        c, i = ball.work, 7 * k
        one = _root(c[i] * c[i] + c[i + 1] * c[i + 1] + c[i + 2] * c[i + 2])
        bends, way = bends + k * (k - 1) * one, way + SHARES[k] * one
    ball.work[ERROR], ball.work[WAY] = bends / (6 * ball.span * ball.span), way * ball.span


@kernel
def _relax(world: Any, ball: Any, fixed: float, guess: float, longest: float, s: float, air: Vec) -> None:
    """Find span and path of a piece on the floor, of a ball with a speed s in the air, which accelerates it by ``air``."""
    borne, force, acc = 1 - ball.buoyancy, world.force, ball.acc
    pull = (air[0] - borne * force[0], air[1] - borne * force[1], air[2] - borne * force[2])
    size, push = without_slopes(_root(dot(acc, acc))), without_slopes(_root(dot(pull, pull)))
    # the times in which the speed, the air's force and the spin change by themselves
    own = min(LONGEST, s / size if size > 0 and fixed < 0 else longest, s / push if push > 0 else LONGEST)
    fade = without_slopes(ball.spin_decay) * s / without_slopes(ball.radius)
    own = min(own, 1 / fade) if fade > 0 else own
    span = min(guess if guess > 0 else FIRST * own, 2 * own, longest)
    if not span > 0:  # (a slip that is none)
        span = SHORTEST
    shift, ratio = (ball.lasts / ball.span, span / ball.span) if guess > 0 else (0 * ball.span, 0 * ball.span)
    _guess(ball, without_slopes(shift), without_slopes(ratio))
    ball.span = span
    error = _collocate(world, ball, fixed)
    for _ in range(100):
        if error <= FINEST:
            break
        shorter = max(0.9 * _eighth_root(FINEST / error), 0.1) if error < math.inf else 0.25
        _guess(ball, 0.0, shorter if error < math.inf else 0.0)
        ball.span = without_slopes(ball.span) * shorter
        error = _collocate(world, ball, fixed)
    more = 0.9 * _eighth_root(FINEST / error) if error > 0 else 4.0
    ball.guess = without_slopes(ball.span) * min(max(more, 0.5), 4.0)


@kernel
def acceleration_in_piece(ball: Any, s: float) -> Vec:
    """Return the acceleration a time s after the beginning of the piece."""
    t, c, b, h = s / ball.span, ball.work, ball.acc, ball.span
    x, y, z = 0 * t, 0 * t, 0 * t
    for n in range(ball.order - 1):
        k = ball.order - n
        i = 7 * k
        x, y, z = (x + k * c[i]) * t, (y + k * c[i + 1]) * t, (z + k * c[i + 2]) * t
    return (b[0] + x / h, b[1] + y / h, b[2] + z / h)


@kernel
def error_in_piece(ball: Any, ahead: float) -> float:
    """Return how far a ball is at most from the parabola that its path has at a time of the piece, ``ahead`` after that."""
    return ball.work[ERROR] * ahead * ahead * ahead  # type: ignore[no-any-return]


@kernel
def way_of_piece(ball: Any) -> float:
    """Return how far a ball comes at most from where it is, in the piece."""
    return ball.work[WAY]  # type: ignore[no-any-return]


@kernel
def turn_in_flight(ball: Any, s: float) -> Vec:
    """Return the integral of the spin over the time s of a piece of a flight."""
    w, b, h, f = ball.w, ball.turn, s * s / 2, s + 0 * ball.span
    if acts(ball.spin_decay):
        f = f + s * s * _series(ball, SPEED, s / ball.span)[1][2]
    return (w[0] * f + h * b[0], w[1] * f + h * b[1], w[2] * f + h * b[2])
