"""Where contact does not end with the impact: hops without number, a push that goes on.

A ball on the floor hops ever lower; the rest of the series is summed (carom.motion.bounces) once the hops are too low to
see and nothing else can come near. A ball that a force presses on a wall, on an edge or on another ball comes to lie
there: it is held, an event that ends its run, for a ball that slides along a wall under pressure is another problem.
"""

from __future__ import annotations

import math
from typing import Any

from carom.engine.predict import pace_of, put
from carom.kernel import Vec, cross, dot, kernel, vector
from carom.laws.contact import slip_velocity
from carom.laws.landing import UP
from carom.motion.bounces import bounces, series_lasts
from carom.motion.phases import BOUNCING, FLIGHT, HELD, SLIDING, grounded
from carom.scene.features import OVER, distance, feature_normal, way_in

__all__ = ["free_for", "hold_on_wall", "hop", "press_on_ball", "pressed"]

# Hops lower than this share of the radius are no longer events of their own where they can be summed ...
SUMMED = 1e-6
# ... and where they cannot (the ball moves in touch with a wall, say), those below this are not made any more: it lies.
NO_HOP = 1e-12
# A ball that a force presses on a wall or a ball, and that hops lower than this share of the radius, is held there.
HOLDS = 1e-9
# Balls that a force pushes on against each other go on in hops, the first of this share of the radius, which costs
# no more than this share of their energy.
HOP, PAID = 2.5e-7, 1e-6
# A push that the floor's friction ends within this share of the radius is none: the ball goes on along the wall.
SHORT_PUSH = 1e-7


@kernel
def free_for(features: Any, balls: Any, i: int, time: float) -> bool:
    """Whether ball i can touch nothing but the floor for a time, wherever its bounces send it."""
    ball = balls[i]
    a, x, v, w = ball.radius, vector(ball.x), vector(ball.v), vector(ball.w)
    # a rubbing floor cannot make it faster than this
    reach = (math.sqrt(dot(v, v)) + a * math.sqrt(dot(w, w))) * time
    for f in range(features.shape[0]):
        # (a gap below -a: the ball is behind a face, or outside of a hollow, and comes in over another feature)
        if features[f].kind != OVER and -a <= distance(features[f], a, x) <= reach:
            return False
    for k in range(balls.shape[0]):
        other = balls[k]
        if k != i and other.phase < HELD:
            s = ball.clock - other.clock + time
            u, b, w = vector(other.v), vector(other.acc), vector(other.w)
            # how far it has come since its own clock, and can come while this one bounces
            far = (math.sqrt(dot(u, u)) + other.radius * math.sqrt(dot(w, w))) * s + math.sqrt(dot(b, b)) * s * s / 2
            r = (x[0] - other.x[0], x[1] - other.x[1], x[2] - other.x[2])
            if math.sqrt(dot(r, r)) - a - other.radius <= reach + far:
                return False
    return True


@kernel
def hop(world: Any, features: Any, balls: Any, i: int) -> bool:
    """Sum the hops of a ball that has just left the floor, where they are low; True where it is simply to lie there."""
    ball = balls[i]
    height = ball.v[2] * ball.v[2] / (2 * world.g)
    if height >= SUMMED * ball.radius:
        return False
    time = series_lasts(ball.v[2], world.g, world.floor_form, vector(world.floor_p))
    if time < math.inf and free_for(features, balls, i, time):
        _x, _v, _w, ball.lasts = bounces(
            vector(ball.x), vector(ball.v), vector(ball.w), ball.radius, ball.kappa, world.g,
            world.floor_form, vector(world.floor_p), world.floor_mu, world.floor_beta, math.inf,
        )  # fmt: skip
        ball.phase = BOUNCING
        return False
    return bool(height < NO_HOP * ball.radius)


@kernel
def hold_on_wall(world: Any, f: Any, ball: Any, approach: float) -> None:
    """Hold a ball that a force presses on feature f; let it go along where the push is all but over."""
    acc, _turn, _lasts = pace_of(world, ball)
    x, v, w, a = vector(ball.x), vector(ball.v), vector(ball.w), ball.radius
    rate, bend = way_in(f, x, v, acc)
    # (one that comes back with all its speed goes on hopping, however low; one that does not come in lies there)
    if not (bend < 0 and rate * rate <= -2 * bend * HOLDS * a and rate <= 0.999999 * approach):
        return
    n = feature_normal(f, x)
    if ball.phase == SLIDING and n[2] == 0:
        _un, u = slip_velocity(v, w, UP, a)
        push = dot(u, n)
        if push * push < 2 * world.floor_mu * world.g * (1 + 1 / ball.kappa) * SHORT_PUSH * a:
            t = (-n[1], n[0], 0.0)  # w . t makes the slip along n
            c = dot(w, t)
            v = (v[0] - rate * n[0], v[1] - rate * n[1], v[2])
            w = (w[0] - c * t[0], w[1] - c * t[1], w[2])
            ball.phase, v, w = grounded(v, w, a, ball.kappa, world.g, world.floor_mu)
            put(ball.v, v)
            put(ball.w, w)
            return
    ball.phase = HELD


@kernel
def _borne(world: Any, ball: Any) -> tuple[Vec, Vec, Vec]:
    """Velocity and acceleration of a ball, of one on the floor what the floor leaves of them; and the latter without friction."""
    v, (b, _turn, _lasts) = vector(ball.v), pace_of(world, ball)
    if world.floor != 0 and ball.x[2] <= ball.radius and v[2] <= 0:
        zero = 0 * b[2]
        free = (b[0], b[1], zero) if ball.phase == FLIGHT else (zero, zero, zero)
        return (v[0], v[1], 0 * v[2]), (b[0], b[1], zero), free
    return v, b, b


@kernel
def pressed(world: Any, ball: Any, other: Any, n: Vec) -> tuple[float, float, bool]:
    """How fast two balls in touch part, at what rate that grows (negative: they are pressed), and whether one lies on the other.

    It lies there if they would be pressed without the floor's friction too, and neither moves along the other.
    """
    v, b, free_b = _borne(world, ball)
    u, c, free_c = _borne(world, other)
    v, b = (v[0] - u[0], v[1] - u[1], v[2] - u[2]), (b[0] - c[0], b[1] - c[1], b[2] - c[2])
    rate = dot(v, n)
    t = (v[0] - rate * n[0], v[1] - rate * n[1], v[2] - rate * n[2])
    a, k = ball.radius, other.radius
    bow = dot(t, t) / (a + k)
    bend = dot(b, n) + bow
    w, r = vector(ball.w), vector(other.w)
    turn = cross((a * w[0] + k * r[0], a * w[1] + k * r[1], a * w[2] + k * r[2]), n)
    slip = (t[0] - turn[0], t[1] - turn[1], t[2] - turn[2])
    still = -2 * bend * HOLDS * min(a, k)
    by_itself = dot((free_b[0] - free_c[0], free_b[1] - free_c[1], free_b[2] - free_c[2]), n) + bow < 0
    return rate, bend, bool(by_itself and dot(t, t) <= still and dot(slip, slip) <= still)


@kernel
def _energy(ball: Any) -> float:
    """Kinetic energy of a ball, twice."""
    v, w, a = vector(ball.v), vector(ball.w), ball.radius
    return float(ball.mass * (dot(v, v) + ball.kappa * (a * a) * dot(w, w)))


@kernel
def _nudge(world: Any, ball: Any, x: float, y: float, c: float) -> None:
    """Change the velocity of a ball by (x, y), after all its motion has been slowed by the factor c."""
    v, w = vector(ball.v), vector(ball.w)
    v, w = (c * v[0] + x, c * v[1] + y, c * v[2]), (c * w[0], c * w[1], c * w[2])
    if ball.phase != FLIGHT:
        ball.phase, v, w = grounded(v, w, ball.radius, ball.kappa, world.g, world.floor_mu)
    put(ball.v, v)
    put(ball.w, w)


@kernel
def _push_on(world: Any, ball: Any, other: Any, n: Vec, rate: float, bend: float) -> None:
    """Let two balls that are pressed on each other part in a low hop, along the floor; both pay for it with their motion."""
    m, k = ball.mass, other.mass
    reduced = m * k / (m + k)
    energy = _energy(ball) + _energy(other)
    level = n[0] * n[0] + n[1] * n[1]
    # the speed of parting: 2 b h its square, but not all that they have
    speed = math.sqrt(min(-2 * bend * HOP * min(ball.radius, other.radius), PAID * energy * level / reduced))
    c = math.sqrt(1 - reduced * speed * speed / (level * energy)) if energy * level > 0 else 1.0
    p = reduced * (speed - c * rate) / level if level > 0 else 0.0
    _nudge(world, ball, p * n[0] / m, p * n[1] / m, c)
    _nudge(world, other, -p * n[0] / k, -p * n[1] / k, c)


@kernel
def press_on_ball(world: Any, ball: Any, other: Any, n: Vec, approach: float) -> None:
    """Two balls that a force presses on each other: one that lies on the other is held, others are pushed on."""
    rate, bend, lies = pressed(world, ball, other, n)
    if bend < 0 and rate * rate <= -2 * bend * HOLDS * min(ball.radius, other.radius):
        if not lies:
            _push_on(world, ball, other, n, rate, bend)
        elif rate <= 0.999999 * approach:
            ball.phase = other.phase = HELD
