"""Resolve an event: apply the law of the wall, of the floor, or of two balls.

Each function changes the ball and its phase, and returns what is logged: impulses, required friction, regime.
"""

from __future__ import annotations

import math
from typing import Any

from carom.core.contact import STICK, friction_at_slip, one_contact, slip_velocity
from carom.core.geometry.features import contact_normal
from carom.core.jit.kernel import Vec, dot, kernel, vector
from carom.core.motion.phases import FLIGHT, REST, ROLLING, ROUNDING, SLIDING, grounded
from carom.core.motion.restitution import restitution
from carom.core.motion.rolling import UP
from carom.laws.callbacks import call_user
from carom.laws.conventional import conventional_reflection
from carom.laws.law import CALLED_WALL, CONTACT_WALL, MIRROR_WALL, NO_SLIP_WALL, ROLLING_WALL, TWO_STEP_WALL
from carom.laws.pair import pair_as_wall, pair_contact, pair_slip, struck_as_wall
from carom.laws.two_step import UNDEFINED
from carom.laws.wall_and_floor.solver import STALL
from carom.simulation.cluster import collide_cluster, overlaps_in_time, place_all
from carom.simulation.predict import write_vector
from carom.simulation.records import NO_REGIME
from carom.simulation.resting_contact import (
    continue_ball_contact,
    continue_wall_contact,
    is_driven_into_wall,
    is_pressed_on_ball,
    sum_bounces,
)
from carom.simulation.wall_and_floor import joint_impact

__all__ = [
    "DONE", "REFUSED_ROLLING", "REFUSED_STALL", "REFUSED_UNDEFINED", "line_of_centres", "meet_ball", "meet_floor", "meet_wall",
    "pair_friction",
]  # fmt: skip

# How a run may end: DONE, or with an event for which the law has no answer.
DONE, REFUSED_ROLLING, REFUSED_UNDEFINED, REFUSED_STALL = 0, 1, 2, 3

# Relative errors of a speed that are rounding: below the first it has no digits left, above the second it is not rounding.
LEAST_ROUNDING, MOST_ROUNDING = 3e-16, 1e-11

Impulse = tuple[Vec, Vec, float, int, int]


@kernel
def leave(world: Any, ball: Any, v: Vec, w: Vec, from_floor: bool) -> None:
    """Set velocity and spin after an impact, and the phase that follows: on the floor, or in flight."""
    phase = FLIGHT
    if from_floor:
        speed = math.sqrt(dot(v, v)) + ball.radius * math.sqrt(dot(w, w))
        if abs(v[2]) <= ROUNDING * speed:
            ball.x[2] = ball.radius
            phase, v, w = grounded(v, w, ball.radius, ball.kappa, world.g, world.floor_mu)
    ball.phase = phase
    write_vector(ball.v, v)
    write_vector(ball.w, w)


@kernel
def _kinetic(ball: Any) -> float:
    """Return twice the kinetic energy per mass: v^2 + kappa a^2 w^2."""
    v, w, a = vector(ball.v), vector(ball.w), ball.radius
    return float(dot(v, v) + ball.kappa * (a * a) * dot(w, w))


@kernel
def keeps_energy(world: Any, ball: Any) -> bool:
    """Return whether a ball moves on without a loss of energy: in flight, or rolling without resistance."""
    rolls = ball.phase == ROLLING and not world.resistance > 0 and not world.spin_friction > 0
    return bool(ball.phase == FLIGHT or rolls)


@kernel
def _restore(world: Any, ball: Any, energy: float) -> None:
    """Correct the rounding of the energy of a ball that has lost none: otherwise it adds up, impact by impact.

    ``energy`` is twice the energy per mass that it has had since its last loss, kinetic and potential.
    """
    now = _kinetic(ball)
    rest = energy + 2 * dot(vector(world.force), vector(ball.x))
    ball.energy = energy
    c = (rest - now) / (2 * now) if now > 0 else 0 * now
    # (more is not rounding)
    if LEAST_ROUNDING < abs(c) < MOST_ROUNDING:
        v, w = vector(ball.v), vector(ball.w)
        write_vector(ball.v, (v[0] + c * v[0], v[1] + c * v[1], v[2] + c * v[2]))
        write_vector(ball.w, (w[0] + c * w[0], w[1] + c * w[1], w[2] + c * w[2]))


@kernel
def _on_floor(world: Any, ball: Any) -> bool:
    """Return whether a ball is on the floor: by its phase, or, where nothing presses it, by its position and velocity."""
    if ball.phase == FLIGHT:
        return bool(world.floor != 0 and not world.g > 0 and ball.v[2] == 0 and ball.x[2] == ball.radius)
    return bool(SLIDING <= ball.phase <= REST)


@kernel
def meet_wall(world: Any, f: Any, ball: Any, users: Any) -> Impulse:
    """Resolve the impact of a ball on feature f: impulses of wall and floor, required friction, regime, error code."""
    a, kappa = ball.radius, ball.kappa
    v, w = vector(ball.v), vector(ball.w)
    n = contact_normal(f, vector(ball.x), v)
    approach = -dot(v, n)
    pushed = is_driven_into_wall(world, f, ball, n, approach)
    e = 1.0 if pushed else restitution(f.form, vector(f.e), max(approach, 0.0))
    mu, beta, law = f.mu, f.beta, f.law
    on_floor = _on_floor(world, ball)
    energy = ball.energy
    if math.isnan(energy) or not keeps_energy(world, ball):
        energy = _kinetic(ball) - 2 * dot(vector(world.force), vector(ball.x))
    ball.energy = math.nan
    none = (0.0, 0.0, 0.0)
    jf, required, regime, refusal = none, 0.0, NO_REGIME, DONE
    if law == CONTACT_WALL or (law == TWO_STEP_WALL and not on_floor):
        v1, w1, j, required, regime = one_contact(v, w, n, a, kappa, e, mu, beta)
    elif law == ROLLING_WALL:
        _un, u = slip_velocity(v, w, UP, a)
        speed = math.sqrt(dot(v, v)) + a * math.sqrt(dot(w, w))
        if not on_floor or abs(n[2]) > ROUNDING or math.sqrt(dot(u, u)) > 1e-9 * speed:
            refusal = REFUSED_ROLLING
        v1, w1 = conventional_reflection(v, w, n, a, kappa)
        j = (v1[0] - v[0], v1[1] - v[1], v1[2] - v[2])
    elif law == NO_SLIP_WALL:
        # as carom.laws.no_slip and carom.laws.mirror have them: members of the one contact's family
        v1, w1, j, required, _regime = one_contact(v, w, n, a, kappa, 1.0, math.inf, 1.0)
    elif law == MIRROR_WALL:
        v1, w1, j, _required, _regime = one_contact(v, w, n, a, kappa, e, 0.0, 0.0)
    elif law >= CALLED_WALL:
        v1, w1 = call_user(users[law - CALLED_WALL], v, w, n, a, kappa, e, mu, beta)
        j = (v1[0] - v[0], v1[1] - v[1], v1[2] - v[2])
    else:  # (last, as the compiler takes them in this order, and another process is at work on this one)
        ef = restitution(world.floor_form, vector(world.floor_p), 0.0)
        v1, w1, j, jf, required, regime, _way = joint_impact(
            v, w, n, a, kappa, e, mu, beta, ef, world.floor_mu, world.floor_beta, world.together != 0
        )
        if regime == STALL:
            refusal = REFUSED_STALL
        elif regime == UNDEFINED:
            refusal = REFUSED_UNDEFINED
    if refusal == DONE:
        leave(world, ball, v1, w1, on_floor)
        continue_wall_contact(world, f, ball, n, approach, law == ROLLING_WALL)
        # two-step keeps it where friction does not act, or turns all of the slip round
        one = law == CONTACT_WALL or (law == TWO_STEP_WALL and not on_floor)
        elastic = e == 1 and (law == MIRROR_WALL or (one and (mu == 0 or beta == -1)))
        rough = one and e == 1 and beta == 1 and regime == STICK
        if (elastic or rough or law in (NO_SLIP_WALL, ROLLING_WALL)) and keeps_energy(world, ball):
            _restore(world, ball, energy)
    m = ball.mass
    return (m * j[0], m * j[1], m * j[2]), (m * jf[0], m * jf[1], m * jf[2]), required, regime, refusal


@kernel
def meet_floor(world: Any, features: Any, balls: Any, i: int) -> tuple[Vec, float, int]:
    """Resolve a landing of ball i: impulse, required friction, regime. Then it flies, stays on the floor, or bounces to the end."""
    ball = balls[i]
    v, w = vector(ball.v), vector(ball.w)
    e = restitution(world.floor_form, vector(world.floor_p), max(-v[2], 0.0))
    v1, w1, j, required, regime = one_contact(v, w, UP, ball.radius, ball.kappa, e, world.floor_mu, world.floor_beta)
    ball.x[2] = ball.radius
    leave(world, ball, v1, w1, True)
    if ball.phase == FLIGHT and world.g > 0 and e < 1 and sum_bounces(world, features, balls, i):
        leave(world, ball, (v1[0], v1[1], 0.0), w1, True)
    m = ball.mass
    return (m * j[0], m * j[1], m * j[2]), required, regime


@kernel
def line_of_centres(ball: Any, other: Any) -> Vec:
    """Return the unit vector from the centre of the other ball to the centre of the first."""
    x, y = vector(ball.x), vector(other.x)
    r = (x[0] - y[0], x[1] - y[1], x[2] - y[2])
    far = math.sqrt(dot(r, r))
    return (r[0] / far, r[1] / far, r[2] / far)


@kernel
def pair_friction(world: Any, ball: Any, other: Any, n: Vec) -> float:
    """Return the friction coefficient of two balls that meet: at the slip that they have, where it depends on it."""
    if not world.pair_drop > 0:
        return float(world.pair_mu)
    v, w, v2, w2 = vector(ball.v), vector(ball.w), vector(other.v), vector(other.w)
    _un, ut = pair_slip(v, w, v2, w2, n, ball.radius, other.radius)
    return friction_at_slip(world.pair_mu, world.pair_drop, world.pair_rate, math.sqrt(dot(ut, ut)))


@kernel
def meet_ball(world: Any, balls: Any, i: int, k: int, users: Any) -> tuple[Vec, float, int, int]:
    """Resolve the impact of balls i and k: impulse on the first, required friction, regime.

    And how many balls were touched where contacts overlap in time (:func:`carom.simulation.cluster.collide_cluster`), else 0.
    """
    ball, other = balls[i], balls[k]
    n = line_of_centres(ball, other)
    v, w, v2, w2 = vector(ball.v), vector(ball.w), vector(other.v), vector(other.w)
    approach = dot((v2[0] - v[0], v2[1] - v[1], v2[2] - v[2]), n)
    pressed, driven = is_pressed_on_ball(world, ball, other, n, approach)
    e = 1.0 if driven else restitution(world.pair_form, vector(world.pair_p), max(approach, 0.0))
    a, m, kappa, a2, m2, kappa2 = ball.radius, ball.mass, ball.kappa, other.radius, other.mass, other.kappa
    mu, last, law = pair_friction(world, ball, other, n), world.pair_beta, world.pair_law
    if law >= CALLED_WALL:
        before, spin, radius, inertia, mass = pair_as_wall(v, w, v2, w2, a, m, kappa, a2, m2, kappa2)
        after, _spin = call_user(users[law - CALLED_WALL], before, spin, n, radius, inertia, e, mu, last)
        v, w, v2, w2, j = struck_as_wall(v, w, v2, w2, n, before, after, mass, a, m, kappa, a2, m2, kappa2)
        required, regime = 0 * mass, NO_REGIME
    else:
        v, w, v2, w2, j, required, regime = pair_contact(v, w, v2, w2, n, a, m, kappa, a2, m2, kappa2, e, mu, last)
    if world.pair_modulus > 0 and balls.shape[0] > 2 and not pressed:
        place_all(world, balls, i, k)
        if overlaps_in_time(world, balls, i, k, v, v2, approach):
            count = collide_cluster(world, balls, i, k)
            if count > 0:
                for p in range(count):
                    one = balls[balls[p].touched]
                    leave(world, one, vector(one.cv), vector(one.cw), _on_floor(world, one))
                c, m = vector(ball.dv), ball.mass
                v = vector(ball.v)
                return (m * (v[0] - c[0]), m * (v[1] - c[1]), m * (v[2] - c[2])), 0 * required, NO_REGIME, count
    leave(world, ball, v, w, _on_floor(world, ball))
    leave(world, other, v2, w2, _on_floor(world, other))
    continue_ball_contact(world, ball, other, n, approach)
    return j, required, regime, 0
