"""Contacts that persist: infinitely many bounces on the floor, and balls that a force keeps in contact with a wall or a ball.

On the floor the bounces of a ball get ever lower (Zeno). Once they are too low to see and nothing else can come near, the rest
of the geometric series is summed (:mod:`carom.core.motion.phases`).

In contact with a wall or another ball, a ball that rests there with its weight is held: an event that ends its run. Otherwise the
force ends sooner or later (the friction of topspin does, the normal force of a curved wall does). There is no closed form for the
motion meanwhile, so the ball goes on in bounces too low to see. These are elastic, so that they do not end before the force does
(as in Luding & McNamara, Granular Matter 1, 113 (1998), where contacts that follow each other too soon are elastic); their mean
momentum transfer is the normal force, with the friction that it causes. A bounce that starts from rest in contact takes its energy
from the motion of the ball, so that none is created.
"""

from __future__ import annotations

import math
from typing import Any

from carom.core.geometry.features import FALLS, OVER, gap_derivatives, gap_to_feature, pocket_distance
from carom.core.jit.kernel import Vec, cross, dot, kernel, vector
from carom.core.motion.phases import BOUNCING, FLIGHT, HELD, bounces, series_lasts
from carom.core.motion.tilt import is_tilted
from carom.simulation.motion import accelerations_of, on_floor_with, write_vector

# Bounces lower than this share of the radius are no longer events of their own where they can be summed ...
MAX_SUMMED_HEIGHT = 1e-6
# ... and where they cannot (the ball moves in contact with a wall, say), there are none below this: it stays on the floor.
MIN_HEIGHT = 1e-12


@kernel
def stays_clear(features: Any, balls: Any, i: int, time: float) -> bool:
    """Return whether ball i can touch nothing but the floor for a time, wherever its bounces send it."""
    ball = balls[i]
    a, x, v, w = ball.radius, vector(ball.x), vector(ball.v), vector(ball.w)
    # a rubbing floor cannot make it faster than this
    reach = (math.sqrt(dot(v, v)) + a * math.sqrt(dot(w, w))) * time
    for f in range(features.shape[0]):
        one = features[f]
        # (a gap below -a: the ball is behind a face, or outside of a hollow, and comes in over another feature)
        if one.kind != OVER and -a <= gap_to_feature(one, a, x) <= reach:
            return False
        if one.kind == OVER and one.ends == FALLS and pocket_distance(one, x) <= reach:
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
def sum_bounces(world: Any, features: Any, balls: Any, i: int) -> bool:
    """Sum the bounces of a ball that has just left the floor, if they are low; True if it is to stay on the floor instead.

    (On a tilted floor they are no geometric series along the floor, and are followed one by one.)
    """
    ball = balls[i]
    height = ball.v[2] * ball.v[2] / (2 * world.g)
    if height >= MAX_SUMMED_HEIGHT * ball.radius:
        return False
    time = series_lasts(ball.v[2], world.g, world.floor_form, vector(world.floor_p))
    if time < math.inf and not is_tilted(vector(world.force)) and stays_clear(features, balls, i, time):
        _x, _v, _w, ball.lasts = bounces(
            vector(ball.x), vector(ball.v), vector(ball.w), ball.radius, ball.kappa, world.g,
            world.floor_form, vector(world.floor_p), world.floor_mu, world.floor_beta, math.inf,
        )  # fmt: skip
        ball.phase = BOUNCING
        return False
    return bool(height < MIN_HEIGHT * ball.radius)


@kernel
def keep_on_floor(world: Any, ball: Any, v: Vec, on_floor: bool) -> Vec:
    """Return the velocity v of a ball without its upward part, if the ball lies on the floor and would not leave it visibly.

    The friction of a ball pressed against it, whose low bounces have hardly an impulse, lifts it by some 1e-9 to 1e-5 m/s: it
    would hop and land after each of them.
    """
    low = on_floor and v[2] * v[2] < 2 * world.g * MAX_SUMMED_HEIGHT * ball.radius
    return (v[0], v[1], 0 * v[2]) if low else v


# Heights of bounces under a lasting force, as shares of the radius: below the first they are elastic; below the last a new one
# begins, which has the second height and takes no more than so large a share of the kinetic energy.
ELASTIC_HEIGHT, LOW_HEIGHT, LEAST_HEIGHT = 1e-6, 2.5e-7, 1e-9
MAX_ENERGY_SHARE = 1e-6


@kernel
def _on_floor(world: Any, ball: Any) -> bool:
    """Return whether the floor keeps a ball from moving down; also one that is about to strike it."""
    return bool(ball.phase != FLIGHT or (world.floor != 0 and ball.x[2] <= ball.radius and ball.v[2] <= 0))


@kernel
def _energy(ball: Any) -> float:
    """Return twice the kinetic energy of a ball."""
    v, w, a = vector(ball.v), vector(ball.w), ball.radius
    return float(ball.mass * (dot(v, v) + ball.kappa * (a * a) * dot(w, w)))


@kernel
def _free_share(n: Vec, lies: bool) -> float:
    """Return the share of an impulse along n that moves a ball: of one on the floor, its part along the floor."""
    return n[0] * n[0] + n[1] * n[1] if lies else 1.0


@kernel
def _change_velocity(world: Any, ball: Any, p: Vec, lies: bool, c: float, keeps_rolling: bool) -> None:
    """Scale the motion of a ball by c, then change its velocity by p (along the floor, if it is there)."""
    v, w, a = vector(ball.v), vector(ball.w), ball.radius
    up = 0 * p[2] if lies else p[2]
    v, w = (c * v[0] + p[0], c * v[1] + p[1], c * v[2] + up), (c * w[0], c * w[1], c * w[2])
    if keeps_rolling:
        w = (-v[1] / a, v[0] / a, w[2])
    if ball.phase != FLIGHT:
        ball.phase, v, w = on_floor_with(world, ball, v, w)
    write_vector(ball.v, v)
    write_vector(ball.w, w)


@kernel
def _bears_weight(world: Any, ball: Any, n: Vec) -> bool:
    """Return whether a feature of normal n bears the weight of a ball, or of one that lies still on the floor, its part along that.

    A ball that moves along a wall at the foot of a tilted floor goes on in low bounces, as one that topspin drives there.
    """
    force = vector(world.force)
    if _on_floor(world, ball):
        v, down = ball.v, (force[0], force[1], 0 * force[2])
        still = 2 * ELASTIC_HEIGHT * ball.radius * math.sqrt(dot(down, down))
        return bool(dot(down, n) < -1e-12 * math.sqrt(dot(force, force)) and dot(v, v) <= still)
    return bool(dot(force, n) < -1e-12 * math.sqrt(dot(force, force)))


@kernel
def is_driven_into_wall(world: Any, f: Any, ball: Any, n: Vec, approach: float) -> bool:
    """Return whether a ball meets a feature again only because topspin, or the curvature of the wall, drives it there."""
    _rate, bend = gap_derivatives(f, vector(ball.x), vector(ball.v), accelerations_of(world, ball)[0])
    return bool(approach * approach < -2 * bend * ELASTIC_HEIGHT * ball.radius and not _bears_weight(world, ball, n))


@kernel
def continue_wall_contact(world: Any, f: Any, ball: Any, n: Vec, approach: float, keeps_rolling: bool) -> Vec:
    """Continue the contact of a ball with feature f, if a force lasts: hold a ball that rests there, let any other bounce low.

    Return the impulse that begins a bounce: as far as it moves the ball, if the floor takes the rest.
    """
    none = (0 * approach, 0 * approach, 0 * approach)
    rate, bend = gap_derivatives(f, vector(ball.x), vector(ball.v), accelerations_of(world, ball)[0])
    if not (bend < 0 and rate * rate <= -2 * bend * LEAST_HEIGHT * ball.radius):
        return none
    if _bears_weight(world, ball, n):
        # (one that comes back with all its speed goes on hopping, however low; one that does not come in lies there)
        if rate <= 0.999999 * approach:
            ball.phase = HELD
        return none
    # (the floor lets a ball that comes down on it be lifted: held to the floor, it would be given what it is yet to lose there)
    lies = _on_floor(world, ball) and not (ball.phase == FLIGHT and ball.v[2] < 0 and n[2] > 0)
    ease = _free_share(n, lies) / ball.mass
    energy = _energy(ball) / (1 + ball.kappa if keeps_rolling else 1.0)
    speed = math.sqrt(min(-2 * bend * LOW_HEIGHT * ball.radius, MAX_ENERGY_SHARE * energy * ease))
    if ease > 0 and energy > 0:
        c = math.sqrt(1 - speed * speed / (ease * energy))
        p = (speed - c * rate) / (ease * ball.mass)
        _change_velocity(world, ball, (p * n[0], p * n[1], p * n[2]), lies, c, keeps_rolling)
        j = ball.mass * p
        return (j * n[0], j * n[1], none[2] if lies else j * n[2])
    return none


@kernel
def _motion_on_floor(world: Any, ball: Any) -> tuple[Vec, Vec, Vec]:
    """Return velocity and acceleration of a ball as far as the floor admits them, and the acceleration without friction."""
    v, (b, _turn, _lasts) = vector(ball.v), accelerations_of(world, ball)
    if _on_floor(world, ball):
        zero = 0 * b[2]
        c = 1 / (1 + ball.kappa)
        free = (b[0], b[1], zero) if ball.phase == FLIGHT else (c * world.force[0], c * world.force[1], zero)
        return (v[0], v[1], 0 * v[2]), (b[0], b[1], zero), free
    return v, b, b


@kernel
def _pair_contact(world: Any, ball: Any, other: Any, n: Vec) -> tuple[float, float, bool]:
    """Return the speed at which two balls in contact separate, its rate of change (negative: a force presses them together), and
    whether one rests on the other: pressed together without the floor's friction too, and neither moving along the other.
    """
    v, b, free_b = _motion_on_floor(world, ball)
    u, c, free_c = _motion_on_floor(world, other)
    v, b = (v[0] - u[0], v[1] - u[1], v[2] - u[2]), (b[0] - c[0], b[1] - c[1], b[2] - c[2])
    rate = dot(v, n)
    t = (v[0] - rate * n[0], v[1] - rate * n[1], v[2] - rate * n[2])
    a, k = ball.radius, other.radius
    bow = dot(t, t) / (a + k)
    bend = dot(b, n) + bow
    w, r = vector(ball.w), vector(other.w)
    turn = cross((a * w[0] + k * r[0], a * w[1] + k * r[1], a * w[2] + k * r[2]), n)
    slip = (t[0] - turn[0], t[1] - turn[1], t[2] - turn[2])
    still = -2 * bend * LEAST_HEIGHT * min(a, k)
    by_itself = dot((free_b[0] - free_c[0], free_b[1] - free_c[1], free_b[2] - free_c[2]), n) + bow < 0
    return rate, bend, bool(by_itself and dot(t, t) <= still and dot(slip, slip) <= still)


@kernel
def is_pressed_on_ball(world: Any, ball: Any, other: Any, n: Vec, approach: float) -> tuple[bool, bool]:
    """Return whether two balls meet again only because a force presses them together, and whether neither rests on the other.

    Then it is the floor's friction, or weight, that drives one against the other.
    """
    _rate, bend, lies = _pair_contact(world, ball, other, n)
    pressed = bool(approach * approach < -2 * bend * ELASTIC_HEIGHT * min(ball.radius, other.radius))
    return pressed, pressed and not lies


@kernel
def _separate(world: Any, ball: Any, other: Any, n: Vec, rate: float, bend: float) -> float:
    """Separate two balls that are pressed together in a low bounce, whose energy is taken from their motion; return its impulse."""
    m, k = ball.mass, other.mass
    one_lies, other_lies = _on_floor(world, ball), _on_floor(world, other)
    ease = _free_share(n, one_lies) / m + _free_share(n, other_lies) / k
    energy = _energy(ball) + _energy(other)
    # the speed of parting: 2 b h its square, but not all that they have
    speed = math.sqrt(min(-2 * bend * LOW_HEIGHT * min(ball.radius, other.radius), MAX_ENERGY_SHARE * energy * ease))
    if ease > 0 and energy > 0:
        c = math.sqrt(1 - speed * speed / (ease * energy))
        p = (speed - c * rate) / ease
        _change_velocity(world, ball, (p * n[0] / m, p * n[1] / m, p * n[2] / m), one_lies, c, False)
        _change_velocity(world, other, (-p * n[0] / k, -p * n[1] / k, -p * n[2] / k), other_lies, c, False)
        return float(p)
    return 0 * rate


@kernel
def continue_ball_contact(world: Any, ball: Any, other: Any, n: Vec, approach: float) -> float:
    """Continue the contact of two balls, if a force presses them together: hold one that rests on the other, else separate them.

    Return the impulse along n that begins a bounce.
    """
    rate, bend, lies = _pair_contact(world, ball, other, n)
    if bend < 0 and rate * rate <= -2 * bend * LEAST_HEIGHT * min(ball.radius, other.radius):
        if not lies:
            return _separate(world, ball, other, n, rate, bend)
        if rate <= 0.999999 * approach:
            ball.phase = other.phase = HELD
    return 0 * rate
