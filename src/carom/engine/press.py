"""Contact that does not end with the impact: something presses a ball on a wall, or two balls on each other.

Where a ball has come to lie on anything but the floor, it is held: an event that ends its run. Else the push ends sooner or
later (the slip of topspin does, the bend of a round wall does), and no closed form leads through it: the ball goes on in hops
too low to see. They lose nothing, so that they never come to an end within the push (the rule of Luding & McNamara, Granular
Matter 1, 113 (1998): contacts that follow on each other too soon are elastic); in their mean they are the pressure, with the
friction that it makes. A hop from rest in touch is paid for with a share of the motion, so that no energy is made.
"""

from __future__ import annotations

import math
from typing import Any

from carom.engine.predict import pace_of, put
from carom.kernel import Vec, cross, dot, kernel, vector
from carom.motion.phases import FLIGHT, HELD, grounded
from carom.scene.features import way_in

__all__ = ["press_on_ball", "press_on_wall", "pushed_by_ball", "pushed_on_wall"]

# Heights of hops under a push, as shares of the radius: below the first they lose nothing; below the last a new one begins,
# which has the second and costs no more than so much of the energy.
ELASTIC, HOP, LOW = 1e-6, 2.5e-7, 1e-9
PAID = 1e-6


@kernel
def _lies(world: Any, ball: Any) -> bool:
    """Whether the floor keeps a ball from moving down: one that it is about to strike, too."""
    return bool(ball.phase != FLIGHT or (world.floor != 0 and ball.x[2] <= ball.radius and ball.v[2] <= 0))


@kernel
def _energy(ball: Any) -> float:
    """Kinetic energy of a ball, twice."""
    v, w, a = vector(ball.v), vector(ball.w), ball.radius
    return float(ball.mass * (dot(v, v) + ball.kappa * (a * a) * dot(w, w)))


@kernel
def _share(n: Vec, lies: bool) -> float:
    """How much of a push along n moves a ball: what it has along the floor, if it lies there."""
    return n[0] * n[0] + n[1] * n[1] if lies else 1.0


@kernel
def _nudge(world: Any, ball: Any, p: Vec, lies: bool, c: float, keeps_rolling: bool) -> None:
    """Change the velocity of a ball by p, along the floor if it lies there, after all its motion was slowed by the factor c."""
    v, w, a = vector(ball.v), vector(ball.w), ball.radius
    up = 0 * p[2] if lies else p[2]
    v, w = (c * v[0] + p[0], c * v[1] + p[1], c * v[2] + up), (c * w[0], c * w[1], c * w[2])
    if keeps_rolling:
        w = (-v[1] / a, v[0] / a, w[2])
    if ball.phase != FLIGHT:
        ball.phase, v, w = grounded(v, w, a, ball.kappa, world.g, world.floor_mu)
    put(ball.v, v)
    put(ball.w, w)


@kernel
def _carries(world: Any, ball: Any, n: Vec) -> bool:
    """Whether a ball has its weight on a feature of normal n; if it lies on the floor, it has it there."""
    force = vector(world.force)
    return bool(not _lies(world, ball) and dot(force, n) < -1e-12 * math.sqrt(dot(force, force)))


@kernel
def pushed_on_wall(world: Any, f: Any, ball: Any, n: Vec, approach: float) -> bool:
    """Whether a ball meets a feature again only because its topspin, or the bend of the wall, pushes it on."""
    _rate, bend = way_in(f, vector(ball.x), vector(ball.v), pace_of(world, ball)[0])
    return bool(approach * approach < -2 * bend * ELASTIC * ball.radius and not _carries(world, ball, n))


@kernel
def press_on_wall(world: Any, f: Any, ball: Any, n: Vec, approach: float, keeps_rolling: bool) -> None:
    """A ball that is pressed on feature f: one that has its weight there is held, any other is pushed on."""
    rate, bend = way_in(f, vector(ball.x), vector(ball.v), pace_of(world, ball)[0])
    if not (bend < 0 and rate * rate <= -2 * bend * LOW * ball.radius):
        return
    if _carries(world, ball, n):
        # (one that comes back with all its speed goes on hopping, however low; one that does not come in lies there)
        if rate <= 0.999999 * approach:
            ball.phase = HELD
        return
    # (the floor lets a ball that comes down on it be lifted: held to the floor, it would be given what it is yet to lose there)
    lies = _lies(world, ball) and not (ball.phase == FLIGHT and ball.v[2] < 0 and n[2] > 0)
    ease = _share(n, lies) / ball.mass
    energy = _energy(ball) / (1 + ball.kappa if keeps_rolling else 1.0)
    speed = math.sqrt(min(-2 * bend * HOP * ball.radius, PAID * energy * ease))
    if ease > 0 and energy > 0:
        c = math.sqrt(1 - speed * speed / (ease * energy))
        p = (speed - c * rate) / (ease * ball.mass)
        _nudge(world, ball, (p * n[0], p * n[1], p * n[2]), lies, c, keeps_rolling)


@kernel
def _borne(world: Any, ball: Any) -> tuple[Vec, Vec, Vec]:
    """Velocity and acceleration of a ball, of one on the floor what the floor leaves of them; and the latter without friction."""
    v, (b, _turn, _lasts) = vector(ball.v), pace_of(world, ball)
    if _lies(world, ball):
        zero = 0 * b[2]
        free = (b[0], b[1], zero) if ball.phase == FLIGHT else (zero, zero, zero)
        return (v[0], v[1], 0 * v[2]), (b[0], b[1], zero), free
    return v, b, b


@kernel
def _pressed(world: Any, ball: Any, other: Any, n: Vec) -> tuple[float, float, bool]:
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
    still = -2 * bend * LOW * min(a, k)
    by_itself = dot((free_b[0] - free_c[0], free_b[1] - free_c[1], free_b[2] - free_c[2]), n) + bow < 0
    return rate, bend, bool(by_itself and dot(t, t) <= still and dot(slip, slip) <= still)


@kernel
def pushed_by_ball(world: Any, ball: Any, other: Any, n: Vec, approach: float) -> bool:
    """Whether two balls only meet again because something pushes one against the other: the floor's friction, or weight."""
    _rate, bend, lies = _pressed(world, ball, other, n)
    return bool(not lies and approach * approach < -2 * bend * ELASTIC * min(ball.radius, other.radius))


@kernel
def _push_on(world: Any, ball: Any, other: Any, n: Vec, rate: float, bend: float) -> None:
    """Let two balls that are pressed on each other part in a low hop; both pay for it with their motion."""
    m, k = ball.mass, other.mass
    one_lies, other_lies = _lies(world, ball), _lies(world, other)
    ease = _share(n, one_lies) / m + _share(n, other_lies) / k
    energy = _energy(ball) + _energy(other)
    # the speed of parting: 2 b h its square, but not all that they have
    speed = math.sqrt(min(-2 * bend * HOP * min(ball.radius, other.radius), PAID * energy * ease))
    if ease > 0 and energy > 0:
        c = math.sqrt(1 - speed * speed / (ease * energy))
        p = (speed - c * rate) / ease
        _nudge(world, ball, (p * n[0] / m, p * n[1] / m, p * n[2] / m), one_lies, c, False)
        _nudge(world, other, (-p * n[0] / k, -p * n[1] / k, -p * n[2] / k), other_lies, c, False)


@kernel
def press_on_ball(world: Any, ball: Any, other: Any, n: Vec, approach: float) -> None:
    """Two balls that a force presses on each other: one that lies on the other is held, others are pushed on."""
    rate, bend, lies = _pressed(world, ball, other, n)
    if bend < 0 and rate * rate <= -2 * bend * LOW * min(ball.radius, other.radius):
        if not lies:
            _push_on(world, ball, other, n, rate, bend)
        elif rate <= 0.999999 * approach:
            ball.phase = other.phase = HELD
