"""Predict the next event of a ball: the earliest of the end of its phase, a wall, the floor, another ball.

Of events at the same time the first in this order is taken: walls in the scene's order, the floor, balls by number, the end of
the phase.
"""

from __future__ import annotations

import math
from typing import Any

from carom.core.geometry.features import (
    FALLS,
    OVER,
    SEAM,
    feature_hit,
    gap_derivatives,
    gap_to_feature,
    is_out_of_reach,
    never_closes,
)
from carom.core.geometry.gaps import contact_gap, contact_gap_rate, feature_gap, feature_gap_rate, least_gap
from carom.core.jit.kernel import Vec, dot, hot_kernel, kernel, vector
from carom.core.motion.bounces import bounces
from carom.core.motion.decay import decay_integrals, time_of_path
from carom.core.motion.phases import (
    BOUNCING,
    FLIGHT,
    HELD,
    REST,
    SLIDING,
    accelerations,
    acts,
    advance,
    advance_decaying,
    decays,
)
from carom.core.roots.first_root import hit2, hit4
from carom.simulation.records import BALL, FLOOR, LEFT_EVENT, NOTHING, PHASE, POCKETED_EVENT, SETTLED, WALL

__all__ = [
    "accelerations_of",
    "begin_phase",
    "is_on_floor",
    "motion_in",
    "move_by",
    "pair_hit",
    "predict",
    "state_after",
    "state_at",
    "write_vector",
]

# Two balls so near, as a share of their distance, touch; the shortest and the longest step of the search for that, s, and how many.
TOUCH, SHORTEST, LONGEST, MOST_STEPS = 4e-16, 1e-7, 1e6, 10_000
MOST_ROUNDS = 60  # of Newton's steps
STILL = 1e-12  # of the radius: a ball that moved by less is where it was


@hot_kernel
def write_vector(row: Any, value: Vec) -> None:
    """Write three numbers into an array."""
    row[0], row[1], row[2] = value[0], value[1], value[2]


@kernel
def state_at(ball: Any, s: float) -> tuple[Vec, Vec, Vec]:
    """Return position, velocity and spin of a ball a time s after its clock, in its present phase."""
    if ball.decays != 0:
        return advance_decaying(
            vector(ball.x), vector(ball.v), vector(ball.w), vector(ball.acc), vector(ball.turn),
            ball.fade, ball.spin_fade, ball.spin_gain, s,
        )  # fmt: skip
    return advance(vector(ball.x), vector(ball.v), vector(ball.w), vector(ball.acc), vector(ball.turn), s)


@kernel
def state_after(world: Any, ball: Any, s: float) -> tuple[Vec, Vec, Vec]:
    """Return position, velocity and spin of a ball a time s after its clock, also of one that bounces infinitely often."""
    if ball.phase == BOUNCING:
        x, v, w, _time = bounces(
            vector(ball.x), vector(ball.v), vector(ball.w), ball.radius, ball.kappa,
            world.g, world.floor_form, vector(world.floor_p), world.floor_mu, world.floor_beta, s,
        )  # fmt: skip
    else:
        x, v, w = state_at(ball, s)
    return x, v, w


@kernel
def move_by(world: Any, ball: Any, s: float, t: float) -> None:
    """Advance a ball by s, to the time t."""
    v = vector(ball.v)
    x, v1, w = state_after(world, ball, s)
    write_vector(ball.x, x)
    write_vector(ball.v, v1)
    write_vector(ball.w, w)
    ball.repeats = ball.repeats + 1 if s * math.sqrt(dot(v, v)) <= STILL * ball.radius else 0
    ball.clock = t


@kernel
def accelerations_of(world: Any, ball: Any) -> tuple[Vec, Vec, float]:
    """Return acceleration, angular acceleration and duration of the phase that a ball is in."""
    return accelerations(
        ball.phase, vector(ball.v), vector(ball.w), ball.radius, ball.kappa,
        vector(world.force), world.g, world.floor_mu, world.resistance, world.spin_friction,
        world.rolling_drag, world.spin_damping, world.spin_drag,
    )  # fmt: skip


@kernel
def is_on_floor(world: Any, ball: Any) -> bool:
    """Return whether a ball is on the floor: by its phase, or, where nothing presses it, by its position and velocity."""
    if ball.phase == FLIGHT:
        return bool(world.floor != 0 and not world.g > 0 and ball.v[2] == 0 and ball.x[2] == ball.radius)
    return bool(SLIDING <= ball.phase <= REST)


@kernel
def begin_phase(world: Any, ball: Any) -> None:
    """Set the accelerations and the duration of the phase that a ball has entered."""
    acc, turn, lasts = accelerations_of(world, ball)
    write_vector(ball.acc, acc)
    write_vector(ball.turn, turn)
    ball.decays = 0
    if acts(world.rolling_drag) or acts(world.spin_damping) or acts(world.spin_drag):
        ball.decays = 1
        ball.fade, ball.spin_fade, ball.spin_gain = decays(
            ball.phase, vector(ball.v), vector(ball.w), acc,
            world.g, world.rolling_drag, world.spin_damping, world.spin_drag,
        )  # fmt: skip
    if ball.phase != BOUNCING:  # whose end was set when its bounces were found to be clear of everything else
        ball.lasts = lasts


@hot_kernel
def _slows_down(ball: Any) -> bool:
    """Return whether the acceleration of a ball's centre decays: it rolls on a straight line."""
    return bool(ball.decays != 0 and ball.fade > 0)


@kernel
def _touch_time(f: Any, ball: Any, a: float, x: Vec, v: Vec, acc: Vec, until: float, slow: float) -> float:
    """Return the time in [0, until] at which a ball, as if its radius were a, touches feature f, or infinity."""
    if not _slows_down(ball):
        return feature_hit(f, a, x, v, acc, until, slow)
    # its path is straight: what it meets does not depend on how fast it goes along, and the way there is found first, as the
    # time that the ball would take at its first speed
    c, k = math.sqrt(dot(acc, acc) / dot(v, v)), ball.fade
    way = until - c * decay_integrals(k, until)[2] if until < math.inf else 1 / k
    path = feature_hit(f, a, x, v, (0 * c, 0 * c, 0 * c), way, slow)
    return time_of_path(k, c, path, until) if path < math.inf else path


@kernel
def _time_when_deep(f: Any, ball: Any, begin: float, until: float) -> float:
    """Return the time at which a ball that has touched feature f, which yields, at the time ``begin`` is so deep that it turns."""
    a, low, high = ball.radius, begin, math.inf + 0 * begin
    s = begin + f.yield_time
    for _ in range(MOST_ROUNDS):
        x, v, acc = motion_in(ball, s)
        rate, bend = gap_derivatives(f, x, v, acc)
        gap = contact_gap(f, a, feature_gap(f, a, x), rate)
        if gap > 0:
            low = s
        else:
            high = s
        slope = contact_gap_rate(f, a, rate, bend)
        after = s - gap / slope if slope < 0 else low
        if not low <= after <= high or (after == low and gap > 0):
            after = (low + high) / 2 if high < math.inf else s + f.yield_time
        if abs(after - s) <= 2e-16 * s or gap == 0:
            break
        s = after
    return float(s if s <= until else math.inf + 0 * s)


@kernel
def _feature_time(
    features: Any, k: int, ball: Any, x: Vec, v: Vec, acc: Vec, until: float, slow: float
) -> float:  # fmt: skip
    """Return the time in [0, until] at which a ball meets feature k, or infinity: where it touches it, or deeper if that yields."""
    f, a = features[k], ball.radius
    if not f.yield_time > 0 or f.kind == OVER:
        return _touch_time(f, ball, a, x, v, acc, until, slow)
    gap, begin = gap_to_feature(f, a, x), 0 * until
    if least_gap(f, a) <= gap < 0:
        rate = feature_gap_rate(f, x, v)
        if contact_gap(f, a, gap, rate) > 0:
            return _time_when_deep(f, ball, begin, until)
        # it has turned: it comes out, or something drives it back to the depth at which it is
        if ball.turned_in == k + 1:
            gap = min(gap, ball.turned_at)
        back = _touch_time(f, ball, a + gap, x, v, acc, until, slow)
        if not 0 < back < math.inf:
            return back
        begin = back / 2
        y, u, b = motion_in(ball, begin)
        if not feature_gap(f, a, y) > 0:
            return back
        touch = begin + _touch_time(f, ball, a, y, u, b, until - begin, slow)
    else:
        touch = _touch_time(f, ball, a, x, v, acc, until, slow)
    return _time_when_deep(f, ball, touch, until) if touch < math.inf else touch


@hot_kernel
def _pair_polynomial(r: Vec, v: Vec, b: Vec, reach: float) -> tuple[float, float, float, float, float]:
    """Return the coefficients of |r + v s + b s^2/2|^2 - reach^2."""
    far = math.sqrt(dot(r, r))
    return (
        (far - reach) * (far + reach),
        2 * dot(r, v),
        dot(v, v) + dot(r, b),
        dot(v, b),
        dot(b, b) / 4,
    )


@kernel
def motion_in(ball: Any, s: float) -> tuple[Vec, Vec, Vec]:
    """Return position, velocity and acceleration of a ball a time s after its clock."""
    x, v, _w = state_at(ball, s)
    c = decay_integrals(ball.fade, s)[0] if _slows_down(ball) else 1 + 0 * s
    return x, v, (c * ball.acc[0], c * ball.acc[1], c * ball.acc[2])


@kernel
def _slowing_pair_hit(ball: Any, other: Any, now: float, until: float, slow: float) -> float:
    """:func:`pair_hit` where the acceleration of a ball decays.

    From any time on the relative motion is a parabola, but for J s^3/6 at most: J is how fast its acceleration changes, which
    decays. Balls that are larger by what that is for a time ahead do not meet on the parabola before the balls do, so that no
    contact is passed; and as what is ahead gets shorter, the error gets less, to rounding.
    """
    reach, t = ball.radius + other.radius, 0 * now
    seam = 2 * reach * SEAM * min(ball.radius, other.radius)
    tol = 2 * reach * slow
    for _ in range(MOST_STEPS):
        left = until - t
        if not left >= 0:
            break
        x, v, b = motion_in(ball, now - ball.clock + t)
        y, u, c = motion_in(other, now - other.clock + t)
        r, v = (x[0] - y[0], x[1] - y[1], x[2] - y[2]), (v[0] - u[0], v[1] - u[1], v[2] - u[2])
        p, q = ball.fade if _slows_down(ball) else 0 * t, other.fade if _slows_down(other) else 0 * t
        j = (p * b[0] - q * c[0], p * b[1] - q * c[1], p * b[2] - q * c[2])
        jerk = math.sqrt(dot(j, j)) / 6
        b = (b[0] - c[0], b[1] - c[1], b[2] - c[2])
        c0, c1, c2, c3, c4 = _pair_polynomial(r, v, b, reach)
        if c0 <= (seam if t == 0 else 2 * reach * TOUCH * reach):
            if c1 < -tol and (t > 0 or c0 <= 0):
                return t
            if c1 >= -tol:
                # in touch and not closing: on for a time in which the error stays below what they part by
                later = hit4(c0, c1, c2, c3, c4, left, tol) / 2
                step = max(math.sqrt(max(c1, 0 * c1) / (2 * reach * jerk)) / 2 if jerk > 0 else left, SHORTEST)
                t = t + min(later if later > 0 else SHORTEST, step, left)
                if not t < until:
                    break
                continue
        ahead = min(left, 2 * hit4(c0, c1, c2, c3, c4, left, tol), LONGEST)
        gap = c0 / (math.sqrt(dot(r, r)) + reach)
        while jerk * ahead * ahead * ahead > gap / 2 and ahead > SHORTEST * SHORTEST:
            ahead = ahead / 2
        d0, d1, d2, d3, d4 = _pair_polynomial(r, v, b, reach + jerk * ahead * ahead * ahead)
        step = hit4(d0, d1, d2, d3, d4, ahead, 0 * tol)
        if step < math.inf and step <= 1e-16 * t:
            return t
        t = t + min(step, ahead)
        if not t < until:
            break
    return math.inf


@kernel
def pair_hit(ball: Any, other: Any, now: float, until: float, slow: float) -> float:
    """Return the time from ``now``, in [0, until], at which two balls touch, or infinity."""
    if _slows_down(ball) or _slows_down(other):
        return _slowing_pair_hit(ball, other, now, until, slow)
    x, v, _w = state_at(ball, now - ball.clock)
    y, u, _w = state_at(other, now - other.clock)
    r = (x[0] - y[0], x[1] - y[1], x[2] - y[2])
    v = (v[0] - u[0], v[1] - u[1], v[2] - u[2])
    b = (ball.acc[0] - other.acc[0], ball.acc[1] - other.acc[1], ball.acc[2] - other.acc[2])
    reach = ball.radius + other.radius
    c0, c1, c2, c3, c4 = _pair_polynomial(r, v, b, reach)
    tol = 2 * reach * slow
    if c0 <= 2 * reach * SEAM * min(ball.radius, other.radius) and never_closes(c1, c2, c3, c4, until, tol):
        return math.inf
    return hit4(c0, c1, c2, c3, c4, until, tol)


@kernel
def _lands_first(world: Any, features: Any, ball: Any, slow: float) -> bool:
    """Return whether a ball in flight comes down on the floor before it has come as far as any wall; most hops do."""
    if ball.phase != FLIGHT or world.floor == 0:
        return False
    x, v, acc, a = vector(ball.x), vector(ball.v), vector(ball.acc), ball.radius
    s = hit2(x[2] - a, v[2], acc[2] / 2, math.inf, slow)
    way = (math.sqrt(dot(v, v)) + math.sqrt(dot(acc, acc)) * s / 2) * s
    if not way < math.inf:
        return False
    for f in range(features.shape[0]):  # noqa: SIM110  (a kernel makes no generator)
        if not is_out_of_reach(features[f], a, x, way):
            return False
    return True


@kernel
def _kind_of(f: Any) -> int:
    """Return the kind of event at a feature: a wall is met; at a gate a ball falls into a pocket, or clears a wall."""
    if f.kind != OVER:
        return WALL
    return POCKETED_EVENT if f.ends == FALLS else LEFT_EVENT


@kernel
def predict(world: Any, features: Any, balls: Any, i: int, slow: float) -> None:
    """Predict the next event of ball i and store it, for the other ball too where two will meet."""
    ball = balls[i]
    phase, a = ball.phase, ball.radius
    best, kind, who = math.inf, NOTHING, -1
    if phase < REST or phase == BOUNCING:
        best = ball.lasts
    if phase < REST:
        x, v, acc = vector(ball.x), vector(ball.v), vector(ball.acc)
        slows_down = _slows_down(ball)
        for f in range(0 if _lands_first(world, features, ball, slow) else features.shape[0]):
            if slows_down or features[f].yield_time > 0:
                s = _feature_time(features, f, ball, x, v, acc, best, slow)
            else:
                s = feature_hit(features[f], a, x, v, acc, best, slow)
            if s < best or (s == best and kind == NOTHING and s < math.inf):
                best, kind, who = s, _kind_of(features[f]), f
        if phase == FLIGHT and world.floor != 0:
            s = hit2(x[2] - a, v[2], acc[2] / 2, best, slow)
            if s < best or (s == best and kind == NOTHING and s < math.inf):
                best, kind, who = s, FLOOR, -1
    if phase < HELD:
        for k in range(balls.shape[0]):
            other = balls[k]
            if k == i or other.phase >= HELD or (phase == REST and other.phase == REST):
                continue
            if BOUNCING in (phase, other.phase):  # clear of each other, or it would not be bouncing (resting_contact)
                continue
            # the other ball stays on its path up to its next event, after which the pair is predicted anew
            now = max(ball.clock, other.clock)
            until = min(best - (now - ball.clock), other.next_at - now)
            if until >= 0:
                s = pair_hit(ball, other, now, until, slow) + (now - ball.clock)
                if s < best or (s == best and kind == NOTHING and s < math.inf):
                    best, kind, who = s, BALL, k
    if kind == NOTHING and best < math.inf:
        kind = SETTLED if phase == BOUNCING else PHASE
    ball.next_in, ball.next_at, ball.next_kind, ball.next_who = best, ball.clock + best, kind, who
    if kind == BALL:
        other = balls[who]
        ball.next_at = max(ball.next_at, other.clock)  # not before the other's last event, by rounding
        other.next_kind, other.next_who, other.next_at = BALL, i, ball.next_at
        other.next_in = ball.next_at - other.clock
