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
    contact_gap,
    contact_gap_rate,
    feature_gap,
    feature_gap_rate,
    feature_hit,
    gap_derivatives,
    gap_to_feature,
    is_out_of_reach,
    least_gap,
    never_closes,
    time_to_end,
)
from carom.core.jit.kernel import Vec, dot, hot_kernel, kernel, vector
from carom.core.motion.air import PHASE_ENDS, fall_in_piece, way_of_piece
from carom.core.motion.phases import BOUNCING, FLIGHT, HELD, REST, decay_integrals, time_of_path
from carom.core.roots import hit2, hit4
from carom.simulation.motion import (
    acceleration_in,
    error_ahead,
    error_from,
    has_no_parabola,
    is_in_air,
    is_turned_downhill,
    motion_in,
    slows_down,
    state_at,
)
from carom.simulation.records import BALL, FLOOR, LEFT_EVENT, NOTHING, PHASE, PIECE, POCKETED_EVENT, SETTLED, WALL

# Two balls so near, as a share of their distance, touch; the shortest step of the search for that, s, the longest but for the time
# that has passed, how many, and the latest touch that is looked for, s.
TOUCH, SHORTEST, LONGEST, MOST_STEPS, LATEST = 4e-16, 1e-7, 1e6, 10_000, 1e12
MOST_ROUNDS = 60  # of Newton's steps
ROUNDING = 1e-12  # of the radius: a distance that is none


@kernel
def _turning_touch_time(f: Any, ball: Any, a: float, until: float, slow: float) -> float:
    """:func:`_touch_time` on a path that a slope, or the air, turns: no contact is passed, as in :func:`_slowing_pair_hit`."""
    t = 0 * a
    for _ in range(MOST_STEPS):
        left = until - t
        y, v, w = state_at(ball, t)
        acc = acceleration_in(ball, v, w, t)
        first = feature_hit(f, a, y, v, acc, left, slow)
        if first == 0 or t + first == t:
            return t
        # the error of the parabola stays below half of the gap, or the rounding of places
        ahead = min(left, 2 * first, LONGEST + t)
        allowed = max(abs(feature_gap(f, a, y)) / 2, ROUNDING * ball.radius)
        while error_from(ball, v, w, t, ahead) > allowed:
            ahead = ahead / 2
        error = error_from(ball, v, w, t, ahead)
        step = feature_hit(f, a, y, v, acc, ahead, slow, error)
        if step == 0:
            step = min(first, ahead)
        t = t + min(step, ahead)
        if not t < min(until, LATEST):
            break
    return math.inf


@kernel
def _landing_time(ball: Any, until: float, slow: float) -> float:
    """Return the time in [0, until] at which a ball in air touches the floor, or infinity: as :func:`_turning_touch_time`."""
    t = 0 * until
    for _ in range(MOST_STEPS):
        z, v, acc = fall_in_piece(ball, t)
        gap, ahead, first = z - ball.radius, until - t, math.inf
        error, allowed = error_ahead(ball, t, ahead), max(abs(gap) / 2, ROUNDING * ball.radius)
        if error > allowed or gap <= allowed:
            first = hit2(gap, v, acc / 2, ahead, slow)
            if first == 0 or t + first == t:
                return t
            ahead = min(ahead, 1.25 * first)
            error = error_ahead(ball, t, ahead)
            while error > allowed:
                ahead = ahead / 2
                error = error_ahead(ball, t, ahead)
        step = hit2(gap - error, v, acc / 2, ahead, slow)
        if step == 0:
            step = min(first, ahead)
        t = t + min(step, ahead)
        if not t < until:
            break
    return math.inf


@kernel
def _touch_time(f: Any, ball: Any, a: float, x: Vec, v: Vec, acc: Vec, until: float, slow: float) -> float:
    """Return the time in [0, until] at which a ball, as if its radius were a, touches feature f, or infinity."""
    if is_turned_downhill(ball) or is_in_air(ball):
        return _turning_touch_time(f, ball, a, until, slow)
    if not slows_down(ball):
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
        # (where it has passed the deepest place, over a nose, say, it has turned before)
        if gap > 0 and rate < 0:
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
def _slowing_pair_hit(ball: Any, other: Any, now: float, until: float, slow: float) -> float:
    """:func:`pair_hit` where the acceleration of a ball decays, or a tilted floor or the air turns it.

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
        p, q = ball.fade if slows_down(ball) else 0 * t, other.fade if slows_down(other) else 0 * t
        j = (p * b[0] - q * c[0], p * b[1] - q * c[1], p * b[2] - q * c[2])
        jerk = math.sqrt(dot(j, j)) / 6
        mine, yours = now - ball.clock + t, now - other.clock + t
        b = (b[0] - c[0], b[1] - c[1], b[2] - c[2])
        c0, c1, c2, c3, c4 = _pair_polynomial(r, v, b, reach)
        if c0 <= (seam if t == 0 else 2 * reach * TOUCH * reach):
            if c1 < -tol and (t > 0 or c0 <= 0):
                return t
            if c1 >= -tol:
                # in touch and not closing: on for a time in which the error stays below what they part by
                later = hit4(c0, c1, c2, c3, c4, left, tol) / 2
                if 0 < later <= 1e-16 * t:
                    return t
                step = max(math.sqrt(max(c1, 0 * c1) / (2 * reach * jerk)) / 2 if jerk > 0 else left, SHORTEST)
                parts = max(c1, 0 * c1) / (2 * reach) / 2
                while (
                    error_ahead(ball, mine, step) + error_ahead(other, yours, step) > parts * step and step > SHORTEST
                ):
                    step = step / 2
                t = t + min(later if later > 0 else SHORTEST, step, left)
                if not t < until:
                    break
                continue
        ahead = min(left, 2 * hit4(c0, c1, c2, c3, c4, left, tol), LONGEST + t)
        gap = c0 / (math.sqrt(dot(r, r)) + reach)
        error = jerk * ahead * ahead * ahead + error_ahead(ball, mine, ahead) + error_ahead(other, yours, ahead)
        while error > gap / 2 and ahead > SHORTEST * SHORTEST:
            ahead = ahead / 2
            error = jerk * ahead * ahead * ahead + error_ahead(ball, mine, ahead) + error_ahead(other, yours, ahead)
        d0, d1, d2, d3, d4 = _pair_polynomial(r, v, b, reach + error)
        step = hit4(d0, d1, d2, d3, d4, ahead, 0 * tol)
        if step < math.inf and step <= 1e-16 * t:
            return t
        t = t + min(step, ahead)
        if not t < min(until, LATEST):
            break
    return math.inf


@kernel
def pair_hit(ball: Any, other: Any, now: float, until: float, slow: float) -> float:
    """Return the time from ``now``, in [0, until], at which two balls touch, or infinity."""
    if has_no_parabola(ball) or has_no_parabola(other):
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
    if ball.phase != FLIGHT or world.floor == 0 or is_in_air(ball):
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
def _first_on_parabola(features: Any, ball: Any, until: float, slow: float) -> int:
    """Return what a ball that a slope turns would meet first on its parabola, or -1: it bounds the searches on its path."""
    best, first = until, -1
    for k in range(features.shape[0] if is_turned_downhill(ball) else 0):
        s = feature_hit(features[k], ball.radius, vector(ball.x), vector(ball.v), vector(ball.acc), best, slow)
        best, first = (s, k) if s < best else (best, first)
    return first


@kernel
def _misses(f: Any, ball: Any, until: float, slow: float) -> bool:
    """Return whether a ball in air cannot meet feature f: it is too far, or one larger by the error of its parabola misses it."""
    a, x = ball.radius, vector(ball.x)
    if is_out_of_reach(f, a, x, way_of_piece(ball)):
        return True
    error, v, acc = error_ahead(ball, 0 * until, until), vector(ball.v), vector(ball.acc)
    if not error <= abs(feature_gap(f, a, x)) / 2 or (f.yield_time > 0 and gap_to_feature(f, a, x) < 0):
        return False
    return bool(feature_hit(f, a, x, v, acc, until, slow, error) == math.inf)


@kernel
def _are_apart(ball: Any, other: Any) -> bool:
    """Return whether two balls, each in air or at rest, are too far from each other to meet in their pieces."""
    if not is_in_air(ball) or not (is_in_air(other) or other.phase == REST):
        return False
    reach = ball.radius + other.radius + way_of_piece(ball) + (way_of_piece(other) if is_in_air(other) else 0.0)
    r = (ball.x[0] - other.x[0], ball.x[1] - other.x[1], ball.x[2] - other.x[2])
    return bool(dot(r, r) > reach * reach)


@kernel
def _kind_of(f: Any) -> int:
    """Return the kind of event at a feature: a wall is met; at a gate a ball falls into a pocket, or clears a wall."""
    if f.kind != OVER:
        return WALL
    return POCKETED_EVENT if f.ends == FALLS else LEFT_EVENT


@kernel
def predict(world: Any, features: Any, balls: Any, i: int, slow: float) -> None:  # noqa: PLR0915
    """Predict the next event of ball i and store it, for the other ball too where two will meet."""
    ball = balls[i]
    phase, a = ball.phase, ball.radius
    best, kind, who = math.inf, NOTHING, -1
    if phase < REST or phase == BOUNCING:
        best = ball.lasts
    if phase < REST:
        x, v, acc = vector(ball.x), vector(ball.v), vector(ball.acc)
        bends, flies = has_no_parabola(ball), is_in_air(ball)
        guess = _first_on_parabola(features, ball, best, slow)
        for k in range(-1, 0 if _lands_first(world, features, ball, slow) else features.shape[0]):
            f = k if k >= 0 else guess
            if f < 0 or k == guess:
                continue
            if flies and _misses(features[f], ball, best, slow):
                continue
            if ball.borne_by == f + 1:  # it moves along it, up to its end
                s = time_to_end(features[f], a, x, v, acc, best)
                if s < best:
                    best, kind, who = s, NOTHING, -1
                continue
            if bends or features[f].yield_time > 0:
                s = _feature_time(features, f, ball, x, v, acc, best, slow)
            else:
                s = feature_hit(features[f], a, x, v, acc, best, slow)
            if s < best or (s == best and kind == NOTHING and s < math.inf):
                best, kind, who = s, _kind_of(features[f]), f
        if phase == FLIGHT and world.floor != 0:
            s = _landing_time(ball, best, slow) if flies else hit2(x[2] - a, v[2], acc[2] / 2, best, slow)
            if s < best or (s == best and kind == NOTHING and s < math.inf):
                best, kind, who = s, FLOOR, -1
    if phase < HELD:
        for k in range(balls.shape[0]):
            other = balls[k]
            if k == i or other.phase >= HELD or (phase == REST and other.phase == REST):
                continue
            if BOUNCING in (phase, other.phase):  # clear of each other, or it would not be bouncing (resting_contact)
                continue
            if _are_apart(ball, other):
                continue
            # the other ball stays on its path up to its next event, after which the pair is predicted anew
            now = max(ball.clock, other.clock)
            until = min(best - (now - ball.clock), other.next_at - now)
            if is_in_air(other):
                until = min(until, other.clock + other.lasts - now)
            if until >= 0:
                s = pair_hit(ball, other, now, until, slow) + (now - ball.clock)
                if s < best or (s == best and kind == NOTHING and s < math.inf):
                    best, kind, who = s, BALL, k
    if kind == NOTHING and best < math.inf:
        kind = SETTLED if phase == BOUNCING else PIECE if is_in_air(ball) and ball.ends != PHASE_ENDS else PHASE
    ball.next_in, ball.next_at, ball.next_kind, ball.next_who = best, ball.clock + best, kind, who
    if kind == BALL:
        other = balls[who]
        ball.next_at = max(ball.next_at, other.clock)  # not before the other's last event, by rounding
        other.next_kind, other.next_who, other.next_at = BALL, i, ball.next_at
        other.next_in = ball.next_at - other.clock
