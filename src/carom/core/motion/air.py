"""Motion of a ball in air: drag, Magnus force, decay of the spin, wind; as pieces, each a polynomial of the time.

With u = v - wind, s = |u|, S = a |w| / s and n = w / |w|

    v' = F + s K (-C_D u + C_L n x u),    w' = -(d s / a) w,    K = rho pi a^2 / (2 m),

C_D and C_L functions of s (of the Reynolds number) and S, d the decay of the spin. On the floor, with the load N = -v'_z of these,
a slip q is slowed by the friction mu N, against it; a ball that rolls moves as force and torque of the air turn it about the point
of contact, less (resistance + rolling_drag |v|) N. There is no closed form. A piece of the path is
the polynomial whose accelerations are those at the eight nodes of Gauss and Radau, found by iteration (E. Everhart, in Dynamics of
Comets, eds A. Carusi & G. B. Valsecchi (1985), p. 185; H. Rein & D. S. Spiegel, MNRAS 446, 1424 (2015)): order 15 at its end, and
within it as long as its coefficients say it is right to FINEST. All is + - * / and sqrt. The end of a piece is no event.

The kernels take the record of a ball. Its ``work`` holds, for the piece, the coefficients of the powers 1 to 7 of the accelerations
of place and spin over the piece's span, six for each power; then work memory, and bounds of their sizes.
"""

from __future__ import annotations

import functools
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


def _powers(k: int) -> tuple[float, ...]:
    """Return the coefficients of the powers 0 to 7 of t (t - t_1) ... (t - t_(k-1))."""
    found = [0.0, 1.0]
    for node in NODES[1:k]:
        found = [low - node * high for low, high in zip([0.0, *found], [*found, 0.0], strict=True)]
    return tuple(found + [0.0] * (8 - len(found)))


# Newton's polynomials in powers, 8 a row
POWERS: tuple[float, ...] = functools.reduce(lambda all_of, k: all_of + _powers(k), range(1, 8), (0.0,) * 8)

INVERSE: tuple[float, ...] = tuple(1 / (a - b) if a > b else 0.0 for a in NODES for b in NODES)
CHOOSE: tuple[float, ...] = tuple(float(math.comb(p, k)) for p in range(8) for k in range(8))
ONCE, TWICE = tuple(1 / (p + 1) for p in range(8)), tuple(1 / ((p + 1) * (p + 2)) for p in range(8))

FINEST = 3e-14  # m: how far a place may be from the polynomial of one degree more
OFF = 1.4e-7  # the largest value of the second integral of t (t - t_1) ... (t - t_7)
SHORTEST = 1e-15  # s
SETTLED, MOST_ROUNDS = 1e-8, 20  # of the accelerations: a change that is rounding; of finding them
# Drag has a corner where a ball turns round in the air: pieces that begin below this speed, m/s, have the laws of where they begin.
# As shares of the time in which that speed changes by itself: the longest piece while it falls, and the first one.
SLOW, SLOW_ON_FLOOR, CORNER, FIRST = 5e-4, 5e-6, 0.35, 0.25
LONGEST = 100.0  # s
LAWS = 24  # segments of all laws of drag and lift
CLOSE = 1e-6  # s: within that time a law is left at no knot
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
    lift = laws[8 * k + 6] * a
    if size > 0:
        lift = lift + _without_spin(laws, k, s) / size
    lift = ball.air * lift * _share(laws, k, s, a * size)
    side, fade = cross(w, u), -ball.spin_decay * s / a
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
        x, y = (x / size, y / size) if size > 0 else (none, none)
    loss = world.spin_friction * load / (kappa * a)
    if acts(world.spin_damping):
        loss = loss + world.spin_damping * abs(w[2])
    if ball.phase == ROLLING and acts(world.spin_drag):
        loss = loss + world.spin_drag * _root(v[0] * v[0] + v[1] * v[1])
    turn = spun[2] - ball.sense * loss
    f = -_friction_of(world, ball) * load
    x, y = f * x, f * y
    if ball.phase == SLIDING:
        c = 1 / (kappa * a)
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
def _integral(c: Any, i: int, t: float) -> float:
    """Return the integral of the powers 1 to 7 of component i up to t, over t."""
    high = ((c[36 + i] * ONCE[7] * t + c[30 + i] * ONCE[6]) * t + c[24 + i] * ONCE[5]) * t + c[18 + i] * ONCE[4]
    return (((high * t + c[12 + i] * ONCE[3]) * t + c[6 + i] * ONCE[2]) * t + c[i] * ONCE[1]) * t  # type: ignore[no-any-return]


@kernel
def _double(c: Any, i: int, t: float) -> float:
    """Return the integral of that integral times t, over t^2."""
    high = ((c[36 + i] * TWICE[7] * t + c[30 + i] * TWICE[6]) * t + c[24 + i] * TWICE[5]) * t + c[18 + i] * TWICE[4]
    return (((high * t + c[12 + i] * TWICE[3]) * t + c[6 + i] * TWICE[2]) * t + c[i] * TWICE[1]) * t  # type: ignore[no-any-return]


@kernel
def _motion(ball: Any, t: float) -> tuple[Vec, Vec]:
    """Return velocity and spin at a share t of the span, from the coefficients so far."""
    c, h, v, b, w = ball.work, ball.span * t, ball.v, ball.acc, ball.w
    velocity = (
        v[0] + h * (b[0] + _integral(c, 0, t)),
        v[1] + h * (b[1] + _integral(c, 1, t)),
        v[2] + h * (b[2] + _integral(c, 2, t)),
    )
    if ball.phase == FLIGHT and not acts(ball.spin_decay):
        return velocity, (w[0] + 0 * h, w[1] + 0 * h, w[2] + 0 * h)
    b = ball.turn
    return velocity, (
        w[0] + h * (b[0] + _integral(c, 3, t)),
        w[1] + h * (b[1] + _integral(c, 4, t)),
        w[2] + h * (b[2] + _integral(c, 5, t)),
    )


@kernel
def _size(ball: Any, p: int) -> float:
    """Return the size of the coefficients of a power, of places and of a point of the surface."""
    k, a = 6 * (p - 1), ball.radius
    c = ball.work
    turn = c[k + 3] * c[k + 3] + c[k + 4] * c[k + 4] + c[k + 5] * c[k + 5]
    return _root(c[k] * c[k] + c[k + 1] * c[k + 1] + c[k + 2] * c[k + 2] + a * a * turn)


@kernel
def _guess(ball: Any, shift: float, ratio: float) -> None:
    """Begin with the polynomial there is, from the share ``shift`` of its span on, over ``ratio`` of its span; 0: with none."""
    c, none = ball.work, 0 * ball.span
    for i in range(6):
        scale = 1.0
        for k in range(1, 8):
            scale = scale * ratio
            found = none
            for p in range(7, k - 1, -1):
                found = found * shift + CHOOSE[8 * p + k] * c[6 * (p - 1) + i]
            c[6 * (k - 1) + i] = found * scale if ratio > 0 else none
        for n in range(7, 0, -1):
            g = c[6 * (n - 1) + i]
            for p in range(n + 1, 8):
                g = g - c[42 + 6 * (p - 1) + i] * POWERS[8 * p + n]
            c[42 + 6 * (n - 1) + i] = g


@kernel
def _collocate(world: Any, ball: Any, fixed: float) -> float:
    """Find the coefficients over the ball's span; return the error of a place within it, m (infinity: there are none)."""
    c, acc, turn = ball.work, vector(ball.acc), vector(ball.turn)
    scale = without_slopes(_root(dot(acc, acc)) + ball.radius * _root(dot(turn, turn)))
    settled, many = False, 6 if ball.phase != FLIGHT or acts(ball.spin_decay) else 3
    least = 0
    if carries_slopes(acc[0] + acc[1] + acc[2]):  # (those of a slip that ends follow it slowly)
        least = 10 if ball.phase == FLIGHT else MOST_ROUNDS
    for count in range(MOST_ROUNDS):
        if settled and count >= least:
            break
        last = 0 * ball.span
        for n in range(1, 8):
            v, w = _motion(ball, NODES[n])
            new, spun = piece_rates(world, ball, v, w, fixed)
            rates = (
                new[0] - acc[0], new[1] - acc[1], new[2] - acc[2], spun[0] - turn[0], spun[1] - turn[1], spun[2] - turn[2],
            )  # fmt: skip
            for i in range(many):
                # Newton's coefficient of the n-th power, and the powers that it changes
                g = rates[i] * INVERSE[8 * n]
                for m in range(1, n):
                    g = (g - c[42 + 6 * (m - 1) + i]) * INVERSE[8 * n + m]
                change = g - c[42 + 6 * (n - 1) + i]
                c[42 + 6 * (n - 1) + i] = g
                for p in range(1, n + 1):
                    c[6 * (p - 1) + i] = c[6 * (p - 1) + i] + change * POWERS[8 * n + p]
                last = max(last, abs(change) * (1 if i < 3 else ball.radius))
        settled = without_slopes(last) <= SETTLED * scale
    high, higher = without_slopes(_size(ball, 6)), without_slopes(_size(ball, 7))
    if not settled and not higher <= 10 * SETTLED * scale:
        return math.inf
    ratio = min(1.0, higher / high) if high > 0 else 1.0
    span = without_slopes(ball.span)
    return float(OFF * span * span * higher * ratio)


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
    v, w = _motion(ball, t)
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
    if without_slopes(size) > LEAST_SLIP:
        return CORNER * without_slopes(size) / max(without_slopes(_root(p * p + q * q)), without_slopes(m)) + 0 * load  # type: ignore[no-any-return]
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
    for n in range(1, 9):
        t = NODES[n] if n < 8 else 1.0
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
    v, w = _motion(ball, t)
    if ball.sense != 0 and not ball.sense * without_slopes(w[2]) > 0:
        return PHASE_ENDS if ball.phase == PIVOTING else SPIN_ENDS
    return GOES_ON if _hold(world, ball, v, w) > 0 or ball.course[2] != 0 else LOST


@kernel
def begin_piece(world: Any, ball: Any, guess: float, horizon: float) -> None:  # noqa: PLR0915
    """Find the piece of a ball's path that begins now: no longer than ``horizon``, and about as long as ``guess`` (0: none)."""
    v, w = vector(ball.v), vector(ball.w)
    u = (v[0] - world.wind[0], v[1] - world.wind[1], v[2] - world.wind[2])
    s = enter_segments(world, ball, v, w, True)
    slow = SLOW if ball.phase == FLIGHT else SLOW_ON_FLOOR
    fixed = s if s < slow else -1.0
    ball.ends, ball.course[2] = GOES_ON, 0 * s
    if ball.phase != FLIGHT:
        ball.sense = 1 if w[2] > 0 else -1 if w[2] < 0 else 0
    acc, turn = piece_rates(world, ball, v, w, fixed)
    speeds_up = bool(without_slopes(dot(u, acc)) > 0)
    if ball.drag_last > ball.drag or ball.lift_last > ball.lift:
        enter_segments(world, ball, v, w, speeds_up)
        acc, turn = piece_rates(world, ball, v, w, fixed)
    closes = LONGEST + 0 * ball.radius
    air = acc
    if ball.phase != FLIGHT:
        air, _spun = air_rates(world, ball, v, w, fixed)
        closes = _approach(world, ball, acc, turn, -air[2])
        if ball.course[2] != 0:
            acc, turn = piece_rates(world, ball, v, w, fixed)
    for k in range(3):
        ball.acc[k], ball.turn[k] = acc[k], turn[k]
    borne, force = 1 - ball.buoyancy, world.force
    pull = (air[0] - borne * force[0], air[1] - borne * force[1], air[2] - borne * force[2])
    size, push = without_slopes(_root(dot(acc, acc))), without_slopes(_root(dot(pull, pull)))
    longest = LONGEST
    if fixed >= 0:
        longest = slow / size if size > 0 else LONGEST
    elif not speeds_up and size > 0:
        longest = CORNER * s / size
    longest = min(longest, without_slopes(closes))
    # the times in which the speed, the air's force and the spin change by themselves
    own = min(LONGEST, s / size if size > 0 and fixed < 0 else longest, s / push if push > 0 else LONGEST)
    fade = without_slopes(ball.spin_decay) * s / without_slopes(ball.radius)
    own = min(own, 1 / fade) if fade > 0 else own
    before, span = without_slopes(ball.span), min(guess if guess > 0 else FIRST * own, 2 * own, longest, horizon)
    if not span > 0:  # (a slip that is none)
        span = SHORTEST
    ball.span = span
    _guess(ball, without_slopes(ball.lasts) / before if guess > 0 else 0.0, span / before if guess > 0 else 0.0)
    error = _collocate(world, ball, fixed)
    for _ in range(100):
        if error <= FINEST:
            break
        shorter = max(0.9 * _eighth_root(FINEST / error), 0.1) if error < math.inf else 0.25
        ball.span = without_slopes(ball.span) * shorter
        _guess(ball, 0.0, shorter if error < math.inf else 0.0)
        error = _collocate(world, ball, fixed)
    lasts = without_slopes(ball.span)
    if ball.drag_last > ball.drag:
        lasts = min(lasts, _cut(world, ball, ball.drag_now, ball.drag))
    if ball.lift_last > ball.lift:
        lasts = min(lasts, _cut(world, ball, ball.lift_now, ball.lift))
    if ball.phase != FLIGHT and ball.ends == GOES_ON:
        left = _left_on_floor(world, ball)
        ball.ends, lasts = (ball.ends, left) if left <= lasts else (GOES_ON, lasts)
    elif ball.phase != FLIGHT and lasts < without_slopes(closes):
        ball.ends = GOES_ON
    ball.lasts = lasts
    if ball.ends == PHASE_ENDS and ball.phase != PIVOTING:
        ball.lasts = closes
    more = 0.9 * _eighth_root(FINEST / error) if error > 0 else 4.0
    ball.guess = without_slopes(ball.span) * min(max(more, 0.5), 4.0)
    sizes = 0 * ball.span
    for p in range(1, 8):
        k = 6 * (p - 1)
        c = ball.work
        one = _root(c[k] * c[k] + c[k + 1] * c[k + 1] + c[k + 2] * c[k + 2])
        c[41 + p] = one
        sizes = sizes + one
    way = _root(dot(v, v)) + (_root(dot(acc, acc)) + sizes) * ball.span / 2
    ball.work[49] = way * ball.span


@kernel
def place_in_piece(ball: Any, s: float) -> tuple[Vec, Vec, Vec]:
    """Return position, velocity and spin a time s after the beginning of the piece."""
    t = s / ball.span
    v, w = _motion(ball, t)
    c, h, x, u, b = ball.work, s * s, ball.x, ball.v, ball.acc
    place = (
        x[0] + u[0] * s + h * (b[0] / 2 + _double(c, 0, t)),
        x[1] + u[1] * s + h * (b[1] / 2 + _double(c, 1, t)),
        x[2] + u[2] * s + h * (b[2] / 2 + _double(c, 2, t)),
    )
    return place, v, w


@kernel
def acceleration_in_piece(ball: Any, s: float) -> Vec:
    """Return the acceleration a time s after the beginning of the piece."""
    t, c, b = s / ball.span, ball.work, ball.acc
    none = 0 * (t + c[0])
    x, y, z = none, none, none
    for p in range(7):
        k = 6 * (6 - p)
        x, y, z = (x + c[k]) * t, (y + c[k + 1]) * t, (z + c[k + 2]) * t
    return (b[0] + x, b[1] + y, b[2] + z)


@kernel
def error_in_piece(ball: Any, s: float, ahead: float) -> float:
    """Return how far a ball is at most from the parabola that its path has at s, within the time ``ahead`` after that."""
    t, c, jerk = (s + ahead) / ball.span, ball.work, 0 * s
    for p in range(7):
        jerk = jerk * t + (7 - p) * c[48 - p]
    return jerk / ball.span * ahead * ahead * ahead / 6  # type: ignore[no-any-return]


@kernel
def way_of_piece(ball: Any) -> float:
    """Return how far a ball comes at most from where it is, in the piece."""
    return ball.work[49]  # type: ignore[no-any-return]


@kernel
def turn_in_piece(ball: Any, s: float) -> Vec:
    """Return the integral of the spin over the time s."""
    t, c, h, w, b = s / ball.span, ball.work, s * s, ball.w, ball.turn
    return (
        w[0] * s + h * (b[0] / 2 + _double(c, 3, t)),
        w[1] * s + h * (b[1] / 2 + _double(c, 4, t)),
        w[2] * s + h * (b[2] / 2 + _double(c, 5, t)),
    )


@kernel
def spin_in_piece(ball: Any, s: float) -> Vec:
    """Return the spin a time s after the beginning of the piece."""
    return _motion(ball, s / ball.span)[1]
