"""Contacts that persist: infinitely many bounces on the floor, and balls that a force keeps in contact with a wall or a ball.

On the floor the bounces of a ball get ever lower (Zeno). Once they are too low to see and nothing else can come near, the rest
of the geometric series is summed (:mod:`carom.core.motion.phases`).

In contact with a wall or another ball, a ball that rests there with its weight is held: an event that ends its run. Otherwise the
force ends sooner or later (the friction of topspin does, the normal force of a curved wall does). There is no closed form for the
motion meanwhile, so the ball goes on in bounces too low to see. These are elastic, so that they do not end before the force does
(as in Luding & McNamara, Granular Matter 1, 113 (1998), where contacts that follow each other too soon are elastic); their mean
momentum transfer is the normal force, with the friction that it causes. A bounce that starts from rest in contact takes its energy
from the motion of the ball, so that none is created.

On a tilted floor no ball is held: one that leans on a straight wall stays in contact with it (carom.core.motion.tilt.along_wall),
and one that lies still between walls, or has hardly moved through many contacts with others, is at rest until something strikes it,
or what it touches sets off.
"""

from __future__ import annotations

import math
from typing import Any

from carom.core.geometry.features import (
    FACE,
    FALLS,
    LINE,
    OVER,
    contact_normal,
    gap_derivatives,
    gap_to_feature,
    pocket_distance,
)
from carom.core.jit.kernel import Vec, cross, dot, kernel, vector, without_slopes
from carom.core.motion.air import air_rates, bounces_in_air, hop_in_air
from carom.core.motion.phases import (
    BOUNCING,
    FLIGHT,
    HELD,
    PIVOTING,
    REST,
    ROUNDING,
    acts,
    bounces,
    rolls_at_last,
    series_lasts,
)
from carom.core.motion.tilt import MOST_FRICTION, is_tilted
from carom.laws.law import CONTACT_WALL, MIRROR_WALL, TWO_STEP_WALL
from carom.simulation.motion import (
    ELASTIC_HEIGHT,
    accelerations_of,
    air_acts,
    is_in_air,
    is_slow,
    motion_along_wall,
    set_on_floor,
    write_vector,
)

# Bounces lower than this share of the radius are no longer events of their own where they can be summed ...
MAX_SUMMED_HEIGHT = 1e-6
# ... and where they cannot (the ball moves in contact with a wall, say), there are none below this: it stays on the floor.
MIN_HEIGHT = 1e-12


@kernel
def stays_clear(world: Any, features: Any, balls: Any, i: int, time: float) -> bool:
    """Return whether ball i can touch nothing but the floor for a time, wherever its bounces send it."""
    ball = balls[i]
    a, x, v, w = ball.radius, vector(ball.x), vector(ball.v), vector(ball.w)
    # a rubbing floor cannot make it faster than this
    # (nor air, but for twice the wind)
    force, wind = vector(world.force), vector(world.wind)
    pull, wind = without_slopes(math.sqrt(dot(force, force))), 2 * without_slopes(math.sqrt(dot(wind, wind)))
    reach = (math.sqrt(dot(v, v)) + a * math.sqrt(dot(w, w)) + wind) * time
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
            if is_in_air(other):
                far = far + (wind + pull * s) * s
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
    g, flies = world.g, air_acts(ball)
    if flies:
        _hop, acc, _jerk, _turn, _rate = hop_in_air(world, ball, vector(ball.v), vector(ball.w))
        if not acc[2] < 0:
            return False
        g = min(g, -acc[2]) / 2  # (a bound: they are too short for air to change)
    time = series_lasts(ball.v[2], g, world.floor_form, vector(world.floor_p))
    if time < math.inf and not is_tilted(vector(world.force)) and stays_clear(world, features, balls, i, time):
        if flies:
            _x, _v, _w, ball.lasts = bounces_in_air(world, ball, math.inf)
        else:
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


# Heights of bounces under a lasting force, as shares of the radius: below ELASTIC_HEIGHT they are elastic; below the last a new
# one begins, which has the first height and takes no more than so large a share of the kinetic energy.
LOW_HEIGHT, LEAST_HEIGHT = 2.5e-7, 1e-9
MAX_ENERGY_SHARE, SHARE_ON_SLOPE = 1e-6, 1e-2
IN_TOUCH = 1e-6  # of the radius: a wall with such a gap to a ball touches it
CALM = (
    1000  # contacts through which a ball has hardly moved, or ten without any motion (carom.simulation.motion.move_by)
)


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
def _speed_of_bounce(world: Any, bend: float, a: float, energy: float, ease: float) -> float:
    """Return the speed at which a low bounce begins, which takes a small share of the energy.

    On a slope a ball that comes to a stop and goes back bounces on: there the share is as large as it has to be.
    """
    most = MAX_ENERGY_SHARE * energy * ease
    if is_tilted(vector(world.force)):
        most = max(SHARE_ON_SLOPE * energy * ease, min(-2 * bend * LEAST_HEIGHT * a, energy * ease / 2))
    return math.sqrt(min(-2 * bend * LOW_HEIGHT * a, most))


@kernel
def _change_velocity(world: Any, ball: Any, p: Vec, lies: bool, c: float, keeps_rolling: bool) -> None:
    """Scale the motion of a ball by c, then change its velocity by p (along the floor, if it is there)."""
    v, w, a = vector(ball.v), vector(ball.w), ball.radius
    up = 0 * p[2] if lies else p[2]
    v, w = (c * v[0] + p[0], c * v[1] + p[1], c * v[2] + up), (c * w[0], c * w[1], c * w[2])
    if keeps_rolling:
        w = (-v[1] / a, v[0] / a, w[2])
    write_vector(ball.v, v)
    write_vector(ball.w, w)
    if ball.phase != FLIGHT:
        set_on_floor(world, ball, v, w)


@kernel
def _leans(world: Any, ball: Any, n: Vec) -> bool:
    """Return whether a ball on a tilted floor leans with its weight on what has the normal n, and is not lifted by that."""
    push = -(world.force[0] * n[0] + world.force[1] * n[1])
    if world.floor == 0 or not is_tilted(vector(world.force)) or not _on_floor(world, ball):
        return False
    return bool(push > 1e-12 * world.g and n[2] * push < world.g * (n[0] * n[0] + n[1] * n[1]))


@kernel
def _low_square(world: Any, ball: Any, n: Vec) -> float:
    """Return the square of the speed at which a slope brings a ball back along n from a bounce too low to see."""
    return 2 * ELASTIC_HEIGHT * ball.radius * abs(world.force[0] * n[0] + world.force[1] * n[1])  # type: ignore[no-any-return]


@kernel
def _is_still(world: Any, ball: Any) -> bool:
    """Return whether a ball on a tilted floor neither moves nor rolls; it may spin on the spot."""
    return is_slow(world, vector(ball.v), (ball.w[0], ball.w[1], 0 * ball.w[2]), ball.radius)


@kernel
def _moves_along(world: Any, f: Any, ball: Any, n: Vec) -> bool:
    """Return whether a ball that leans on feature f, of normal n, can move along it in contact.

    The wall is straight, its law tells the friction under a load, nothing fades with the speed, and the ball has hardly a spin that
    rubs floor and wall across its way: else the floor drives it into the wall, or from it, and it goes on in low bounces.
    """
    straight = (f.kind == FACE and not f.R > 0) or (f.kind == LINE and abs(f.d[2]) <= ROUNDING)
    fades = acts(world.rolling_drag) or acts(world.spin_damping) or acts(world.spin_drag)
    rubs = ball.radius * (n[0] * ball.w[1] - n[1] * ball.w[0])
    has_law = f.law in (CONTACT_WALL, TWO_STEP_WALL, MIRROR_WALL)
    return bool(straight and has_law and not fades and rubs * rubs <= _low_square(world, ball, n))


@kernel
def is_low_on_slope(world: Any, ball: Any, n: Vec, approach: float) -> bool:
    """Return whether a ball comes back to a wall of normal n, on which a tilted floor presses it, from a bounce too low to see."""
    return bool(_leans(world, ball, n) and approach * approach <= _low_square(world, ball, n))


@kernel
def _bears_weight(world: Any, f: Any, ball: Any, n: Vec) -> bool:
    """Return whether feature f, of normal n, bears the weight of a ball, or of one on a tilted floor the part along that."""
    force = vector(world.force)
    if _on_floor(world, ball):
        return _leans(world, ball, n) and (_moves_along(world, f, ball, n) or _is_still(world, ball))
    hops = world.floor != 0 and is_tilted(force)
    return bool(not hops and dot(force, n) < -1e-12 * math.sqrt(dot(force, force)))


@kernel
def _is_blown(world: Any, ball: Any, n: Vec, bend: float) -> bool:
    """Return whether it is wind that presses a ball on the floor on a wall of normal n, with the acceleration ``bend``."""
    wind, none = vector(world.wind), 0 * bend
    if dot(wind, wind) == 0 or not air_acts(ball) or world.floor == 0 or ball.x[2] > ball.radius:
        return False
    pull, _turn = air_rates(world, ball, (none, none, none), (none, none, ball.w[2]), -1.0)
    push = (pull[0] * n[0] + pull[1] * n[1]) / (1 + ball.kappa)
    return bool(push < 0 and push < bend / 2)


@kernel
def is_driven_into_wall(world: Any, f: Any, ball: Any, n: Vec, approach: float) -> bool:
    """Return whether a ball meets a feature again only because topspin, or the curvature of the wall, drives it there."""
    _rate, bend = gap_derivatives(f, vector(ball.x), vector(ball.v), accelerations_of(world, ball)[0])
    low = bool(approach * approach < -2 * bend * ELASTIC_HEIGHT * ball.radius)
    return low and not (_bears_weight(world, f, ball, n) or _is_blown(world, ball, n, bend))


@kernel
def _friction_of(f: Any) -> float:
    """Return the friction of a wall under a load."""
    return float(f.mu if f.law in (CONTACT_WALL, TWO_STEP_WALL) else 0 * f.mu)


@kernel
def _rub_at_rest(world: Any, features: Any, ball: Any, who: int, n: Vec) -> float:
    """Return the friction, per mass, of a ball's spin where it lies between feature ``who``, of normal n, and another, or infinity.

    Pushes N, N' >= 0 and the friction are in balance along the floor: F + N (n + mu t) + N' (n' + mu' t') = 0 with t = z x n, or
    the other way.
    """
    x, y, w = world.force[0], world.force[1], ball.w[2]
    turns = 1 if w > 0 else -1 if w < 0 else 0
    mu = min(_friction_of(features[who]), MOST_FRICTION)
    p, q = n[0] - turns * mu * n[1], n[1] + turns * mu * n[0]
    for k in range(features.shape[0]):
        f = features[k]
        if f.kind != OVER and abs(gap_to_feature(f, ball.radius, vector(ball.x))) <= IN_TOUCH * ball.radius:
            o, other_mu = contact_normal(f, vector(ball.x), vector(ball.v)), min(_friction_of(f), MOST_FRICTION)
            r, s = o[0] - turns * other_mu * o[1], o[1] + turns * other_mu * o[0]
            d = p * s - q * r
            if abs(d) > IN_TOUCH and (r * y - s * x) / d >= 0 and (q * x - p * y) / d >= 0:
                return float((mu * (r * y - s * x) + other_mu * (q * x - p * y)) / d)
    return math.inf + 0 * mu


@kernel
def _bear(world: Any, ball: Any, who: int, n: Vec, mu: float) -> None:
    """Let feature ``who`` (-2: several things) bear a ball on a tilted floor (carom.core.motion.tilt.along_wall)."""
    if world.floor_mu == math.inf:
        v, w = rolls_at_last(vector(ball.v), vector(ball.w), ball.radius, ball.kappa)
        write_vector(ball.v, v)
        write_vector(ball.w, w)
    ball.borne_by = who + 1
    ball.borne[0], ball.borne[1], ball.borne[2], ball.borne[3] = n[0], n[1], n[2], mu
    settle_along_wall(world, ball)


@kernel
def settle_along_wall(world: Any, ball: Any) -> None:
    """Give a ball that a wall bears its phase, and velocity and spin without rounding; one at rest needs no more."""
    ball.phase, v, w, _acc, _turn, _lasts = motion_along_wall(world, ball)
    write_vector(ball.v, v)
    write_vector(ball.w, w)
    if ball.phase == REST:
        ball.borne_by = 0


@kernel
def is_lying(world: Any, ball: Any) -> bool:
    """Return whether a ball on a tilted floor lies still, or spins on the spot."""
    lies = ball.phase == REST or (ball.borne_by != 0 and ball.phase == PIVOTING)
    return bool(lies and is_tilted(vector(world.force)))


@kernel
def is_calm(world: Any, ball: Any) -> bool:
    """Return whether a ball on a tilted floor has hardly moved through so many contacts that it lies still."""
    return bool(ball.repeats > CALM and ball.phase != FLIGHT and is_tilted(vector(world.force)))


@kernel
def _stays_at_wall(world: Any, features: Any, who: int, ball: Any, n: Vec) -> bool:
    """Let a ball on a tilted floor stay in contact with feature ``who``, of normal n, if it can.

    It moves along a straight wall; it lies, or spins on the spot, between two walls, or where rolling resistance holds it.
    """
    v, w, phase, none = vector(ball.v), vector(ball.w), ball.phase, (0 * n[0], 0 * n[0], 0 * n[0])
    still, moves = _is_still(world, ball), _moves_along(world, features[who], ball, n)
    rub = _rub_at_rest(world, features, ball, who, n) if still else math.inf + none[0]
    if rub < math.inf:
        _bear(world, ball, -2, none, rub)
    else:
        _bear(world, ball, who, n, _friction_of(features[who]))
    if rub < math.inf or moves or (still and ball.phase in (PIVOTING, REST)):
        return True
    ball.phase, ball.borne_by = phase, 0
    write_vector(ball.v, v)
    write_vector(ball.w, w)
    return False


@kernel
def continue_wall_contact(
    world: Any, features: Any, who: int, ball: Any, n: Vec, approach: float, keeps_rolling: bool
) -> Vec:
    """Continue the contact of a ball with feature ``who``, if a force lasts: the ball stays there, or bounces low.

    On a tilted floor it leans on the wall, at rest or along it; a ball that rests without a floor is held. Return the impulse that
    begins a bounce: as far as it moves the ball, if the floor takes the rest.
    """
    f = features[who]
    none = (0 * approach, 0 * approach, 0 * approach)
    rate, bend = gap_derivatives(f, vector(ball.x), vector(ball.v), accelerations_of(world, ball)[0])
    if not (bend < 0 and rate * rate <= -2 * bend * LEAST_HEIGHT * ball.radius):
        return none
    # (one that comes back with all its speed goes on hopping, however low; one that does not come in lies there)
    settles = rate <= 0.999999 * approach
    if settles and _leans(world, ball, n) and _stays_at_wall(world, features, who, ball, n):
        return none
    blown = _is_blown(world, ball, n, bend)
    if blown or (_bears_weight(world, f, ball, n) and not (_on_floor(world, ball) and settles)):
        if settles:
            ball.phase = HELD
        return none
    # (the floor lets a ball that comes down on it be lifted: held to the floor, it would be given what it is yet to lose there)
    lies = _on_floor(world, ball) and not (ball.phase == FLIGHT and ball.v[2] < 0 and n[2] > 0)
    ease = _free_share(n, lies) / ball.mass
    energy = _energy(ball) / (1 + ball.kappa if keeps_rolling else 1.0)
    speed = _speed_of_bounce(world, bend, ball.radius, energy, ease)
    if ease > 0 and energy > 0:
        c = math.sqrt(1 - speed * speed / (ease * energy))
        p = (speed - c * rate) / (ease * ball.mass)
        _change_velocity(world, ball, (p * n[0], p * n[1], p * n[2]), lies, c, keeps_rolling)
        j = ball.mass * p
        return (j * n[0], j * n[1], none[2] if lies else j * n[2])
    return none


@kernel
def _motion_on_floor(world: Any, ball: Any) -> tuple[Vec, Vec, Vec]:
    """Return velocity and acceleration of a ball as far as the floor admits them, and the acceleration without friction.

    One that lies still at the foot of a slope is borne there by what it touches.
    """
    v, (b, _turn, _lasts) = vector(ball.v), accelerations_of(world, ball)
    if _on_floor(world, ball):
        zero = 0 * b[2]
        c = zero if is_lying(world, ball) else 1 / (1 + ball.kappa)
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
def is_pressed_on_ball(world: Any, ball: Any, other: Any, n: Vec, approach: float) -> tuple[bool, bool, float]:
    """Return whether two balls meet again only because a force presses them together; whether, besides, neither rests on the other
    (it is the floor's friction, or weight, that drives one against the other); and their acceleration apart.
    """
    _rate, bend, lies = _pair_contact(world, ball, other, n)
    pressed = approach * approach < -2 * bend * ELASTIC_HEIGHT * min(ball.radius, other.radius)
    return bool(pressed), bool(pressed and not lies), bend


@kernel
def _separate(world: Any, ball: Any, other: Any, n: Vec, rate: float, bend: float) -> float:
    """Separate two balls that are pressed together in a low bounce, whose energy is taken from their motion; return its impulse."""
    m, k = ball.mass, other.mass
    one_lies, other_lies = _on_floor(world, ball), _on_floor(world, other)
    ease = _free_share(n, one_lies) / m + _free_share(n, other_lies) / k
    energy = _energy(ball) + _energy(other)
    speed = _speed_of_bounce(world, bend, min(ball.radius, other.radius), energy, ease)
    if ease > 0 and energy > 0:
        c = math.sqrt(1 - speed * speed / (ease * energy))
        p = (speed - c * rate) / ease
        _change_velocity(world, ball, (p * n[0] / m, p * n[1] / m, p * n[2] / m), one_lies, c, False)
        _change_velocity(world, other, (-p * n[0] / k, -p * n[1] / k, -p * n[2] / k), other_lies, c, False)
        return float(p)
    return 0 * rate


@kernel
def continue_ball_contact(world: Any, ball: Any, other: Any, n: Vec, approach: float, before: float) -> float:
    """Continue the contact of two balls, if a force presses them together: they are held, or bounce low.

    n points to the first; ``before``: their acceleration apart before the impact, borne by walls of a slope as they were. There
    they can be struck, elsewhere balls that rest on each other are held. Return the impulse along n that begins a bounce.
    """
    rate, bend, lies = _pair_contact(world, ball, other, n)
    slope = world.floor != 0 and is_tilted(vector(world.force))
    bend = before if slope else bend
    if bend < 0 and rate * rate <= -2 * bend * LEAST_HEIGHT * min(ball.radius, other.radius):
        if not lies or slope:
            return _separate(world, ball, other, n, rate, bend)
        if rate <= 0.999999 * approach:
            ball.phase = other.phase = HELD
    return 0 * rate
