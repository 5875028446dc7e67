"""Motion of a ball in air: drag, Magnus force, decay of the spin, wind; as pieces, each a polynomial of the time.

With u = v - wind, s = |u|, S = a |w| / s and n = w / |w|

    v' = F + s K (-C_D u + C_L n x u),    w' = -(d s / a) w,    K = rho pi a^2 / (2 m),

C_D and C_L functions of s (of the Reynolds number) and S, d the decay of the spin. There is no closed form. A piece of the path is
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

from carom.core.jit.kernel import Vec, carries_slopes, cross, dot, kernel, vector, without_slopes
from carom.core.motion.phases import acts

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
SETTLED, MOST_ROUNDS = 1e-8, 20  # of the accelerations: a change that is rounding; of finding them
# Drag has a corner where a ball turns round in the air: pieces that begin below this speed, m/s, have the laws of where they begin.
# As shares of the time in which that speed changes by itself: the longest piece while it falls, and the first one.
SLOW, CORNER, FIRST = 5e-4, 0.7, 0.25
LONGEST = 100.0  # s
LAWS = 24  # segments of all laws of drag and lift
CLOSE = 1e-6  # s: within that time a law is left at no knot


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
    if not acts(ball.spin_decay):
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
    settled, many = False, 6 if acts(ball.spin_decay) else 3
    least = 10 if carries_slopes(acc[0] + acc[1] + acc[2]) else 0
    for count in range(MOST_ROUNDS):
        if settled and count >= least:
            break
        last = 0 * ball.span
        for n in range(1, 8):
            v, w = _motion(ball, NODES[n])
            new, spun = air_rates(world, ball, v, w, fixed)
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
def begin_piece(world: Any, ball: Any, guess: float, horizon: float) -> None:  # noqa: PLR0915
    """Find the piece of a ball's path that begins now: no longer than ``horizon``, and about as long as ``guess`` (0: none)."""
    v, w = vector(ball.v), vector(ball.w)
    u = (v[0] - world.wind[0], v[1] - world.wind[1], v[2] - world.wind[2])
    s = without_slopes(_root(dot(u, u)))
    share = without_slopes(_ratio(ball, s, w))
    # by the laws as they are on the segments in which the ball is, or which it enters
    ball.drag_now = _segment(world.laws, ball.drag, ball.drag_last, s, share, True, True)
    ball.lift_now = _segment(world.laws, ball.lift, ball.lift_last, s, share, True, True)
    fixed = s if s < SLOW else -1.0
    acc, turn = air_rates(world, ball, v, w, fixed)
    speeds_up = bool(without_slopes(dot(u, acc)) > 0)
    if ball.drag_last > ball.drag or ball.lift_last > ball.lift:
        ball.drag_now = _segment(world.laws, ball.drag, ball.drag_last, s, share, speeds_up, not speeds_up)
        ball.lift_now = _segment(world.laws, ball.lift, ball.lift_last, s, share, speeds_up, not speeds_up)
        acc, turn = air_rates(world, ball, v, w, fixed)
    for k in range(3):
        ball.acc[k], ball.turn[k] = acc[k], turn[k]
    borne, force = 1 - ball.buoyancy, world.force
    pull = (acc[0] - borne * force[0], acc[1] - borne * force[1], acc[2] - borne * force[2])
    size, push = without_slopes(_root(dot(acc, acc))), without_slopes(_root(dot(pull, pull)))
    longest = LONGEST
    if fixed >= 0:
        longest = SLOW / size if size > 0 else LONGEST
    elif not speeds_up and size > 0:
        longest = CORNER * s / size
    # the times in which the speed, the air's force and the spin change by themselves
    own = min(LONGEST, s / size if size > 0 and fixed < 0 else longest, s / push if push > 0 else LONGEST)
    fade = without_slopes(ball.spin_decay) * s / without_slopes(ball.radius)
    own = min(own, 1 / fade) if fade > 0 else own
    before, span = without_slopes(ball.span), min(guess if guess > 0 else FIRST * own, 2 * own, longest, horizon)
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
    ball.lasts = lasts
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
