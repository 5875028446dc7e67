"""The integration of contacts that overlap in time: forces of balls and walls, in small steps, until all contacts have opened.

Steps are those of the five-stage method of order four of M. H. Carpenter & C. A. Kennedy, NASA TM-109112 (1994), which keeps one
change beside the state. It writes to fields of the balls' records, so that nothing is allocated.
"""

from __future__ import annotations

import functools
import math
import operator
from typing import Any

from carom.core.contact import friction_at_slip
from carom.core.jit.kernel import Vec, cross, dot, kernel, vector
from carom.core.motion.restitution import CONSTANT, restitution
from carom.laws.hertz import contact_time, damping, stiffness
from carom.simulation.cluster_walls import push_of_wall, scales_of_wall, wall_of
from carom.simulation.motion import write_vector

__all__ = ["LAST_BIT", "LEAST_DEPTH", "NO_BALL", "add", "apart", "follow"]

STEPS, LADDER = 20, 0.875  # steps in a contact's duration, at least; the ratio of one possible step to the next
LEAST_DEPTH = 1e-7  # of the radii: balls that overlap by less, as by the digits of a file, touch
LEAST_SPEED = 1e-9  # of the largest in the cluster: a slower contact does not count
RETURNS = 1e-3  # of that speed: slower balls do not come back from a wall
LAST_BIT = 62  # of a whole number: for all members from the 62nd on
NO_BALL, AT_WALL = -1, -3
SHARES = (
    0.0,
    -567301805773 / 1357537059087,
    -2404267990393 / 2016746695238,
    -3550918686646 / 2091501179385,
    -1275806237668 / 842570457699,
)
WEIGHTS = (
    1432997174477 / 9575080441755,
    5161836677717 / 13612068292357,
    1720146321549 / 2090206949498,
    3134564353537 / 4481467310338,
    2277821191437 / 14882151754819,
)
# The share of each stage's rates in a whole step. (The built-in sum adds floats in another way from Python 3.12 on: other bits.)
PARTS = tuple(
    functools.reduce(operator.add, (WEIGHTS[k] * math.prod(SHARES[stage + 1 : k + 1]) for k in range(stage, 5)))
    for stage in range(5)
)


@kernel
def apart(one: Any, other: Any) -> Vec:
    """Return where a ball is from another one in the cluster's own time."""
    x, y = one.cx, other.cx
    return (y[0] - x[0], y[1] - x[1], y[2] - x[2])


@kernel
def _scales(world: Any, features: Any, balls: Any, count: int) -> tuple[float, float, float]:
    """Return the largest relative speed of members, the time of a step, and how long a contact with a wall lasts."""
    fastest, least = 0.0, math.inf
    for p in range(1, count):
        one = balls[balls[p].member]
        for q in range(p):
            other = balls[balls[q].member]
            v, u = one.cv, other.cv
            v = (v[0] - u[0], v[1] - u[1], v[2] - u[2])
            fastest = max(fastest, dot(v, v))
            m = one.mass * other.mass / (one.mass + other.mass)
            least = min(least, m / stiffness(world.pair_modulus, one.radius, other.radius))
    fastest = math.sqrt(fastest)
    walls, longest = math.inf + 0 * fastest, 0 * fastest
    for p in range(count):
        one = balls[balls[p].member]
        for s in range(one.walls):
            speed, time = scales_of_wall(features, one, s)
            fastest, walls = max(fastest, speed), min(walls, time)
            longest = max(longest, features[wall_of(one, s)].contact_time)
    # (a damping beyond the critical one wants shorter steps)
    form, numbers = world.pair_form, vector(world.pair_p)
    stiff = max(damping(restitution(form, numbers, fastest)), damping(restitution(form, numbers, 0 * fastest)))
    time, step = walls / STEPS, 1.0
    if count > 1:
        time = min(contact_time(least, 1, fastest) / (STEPS * max(1 + 0 * stiff, stiff / 2)), time)
    # (one of a ladder: where it changed with speeds and masses, the places of the steps would add noise to derivatives)
    while step > time:
        step *= LADDER
    return fastest, step, longest


@kernel
def _touch(balls: Any, i: int, k: int, touched: int) -> int:
    """Note that ball k pushes ball i; return how many balls have been touched."""
    ball = balls[i]
    ball.pushes += 1
    if ball.met == NO_BALL:
        balls[touched].touched = i
        touched += 1
    if ball.met < 0:
        ball.met = k
    return touched


@kernel
def _push(
    world: Any, balls: Any, i: int, k: int, touched: int, h: float, alpha: float, least: float
) -> tuple[int, bool]:
    """Add the forces of balls i and k on each other; return how many balls have been touched, and whether the contact goes on."""
    one, other = balls[i], balls[k]
    r = apart(other, one)
    reach = (1 - LEAST_DEPTH) * (one.radius + other.radius)
    square = dot(r, r)
    if not square < reach * reach:
        return touched, False
    far = math.sqrt(square)
    depth = reach - far
    n = (r[0] / far, r[1] / far, r[2] / far)
    v, v2 = one.cv, other.cv
    u = (v[0] - v2[0], v[1] - v2[1], v[2] - v2[2])
    un = dot(u, n)
    m = one.mass * other.mass / (one.mass + other.mass)
    stiff = stiffness(world.pair_modulus, one.radius, other.radius)
    root = math.sqrt(depth)
    # the speed at which the balls would meet without damping
    speed = math.sqrt(un * un + 4 * stiff * depth * depth * root / (5 * m))
    if not speed > least:
        return touched, False
    if world.pair_form != CONSTANT:
        # (damping takes it from u to e u meanwhile: read as it was at first, on an average)
        numbers = vector(world.pair_p)
        e = restitution(world.pair_form, numbers, speed)
        alpha = damping(restitution(world.pair_form, numbers, 2 * speed / (1 + e)))
    push = stiff * depth * root - alpha * math.sqrt(m * stiff) * math.sqrt(root) * un
    if not push > 0:
        return touched, un < 0
    touched = _touch(balls, k, i, touched)
    touched = _touch(balls, i, k, touched)
    f = (push * n[0], push * n[1], push * n[2])
    if world.pair_mu > 0 or world.pair_drop > 0:
        w, w2 = one.cw, other.cw
        a, a2 = one.radius, other.radius
        s = cross((a * w[0] + a2 * w2[0], a * w[1] + a2 * w2[1], a * w[2] + a2 * w2[2]), n)
        t = (u[0] - un * n[0] - s[0], u[1] - un * n[1] - s[1], u[2] - un * n[2] - s[2])
        slip = math.sqrt(dot(t, t))
        mt = 1 / ((1 + 1 / one.kappa) / one.mass + (1 + 1 / other.kappa) / other.mass)
        # (what would end the slip within a step, if that is less: so also where there is none, for its derivatives)
        mu = friction_at_slip(world.pair_mu, world.pair_drop, world.pair_rate, slip)
        c = mt / h if mt * slip <= mu * push * h else mu * push / slip
        f = (f[0] - c * t[0], f[1] - c * t[1], f[2] - c * t[2])
        twist = cross(n, f)
        add(one.twist, twist, 1)
        add(other.twist, twist, 1)
    add(one.push, f, 1)
    add(other.push, f, -1)
    return touched, True


@kernel
def add(row: Any, value: Vec, c: float) -> None:
    """Add c times a vector to three numbers of an array."""
    row[0] += c * value[0]
    row[1] += c * value[1]
    row[2] += c * value[2]


@kernel
def _forces(
    world: Any, features: Any, balls: Any, count: int, touched: int, h: float, share: float, alpha: float, least: float
) -> tuple[int, bool]:
    """Set the forces and torques on all members; return how many balls have been touched, and whether any contact goes on."""
    none = (0.0, 0.0, 0.0)
    closed = False
    for p in range(count):
        one = balls[balls[p].member]
        write_vector(one.push, none)
        write_vector(one.twist, none)
        one.pushes = 0
    for p in range(1, count):
        near = balls[p].near
        for q in range(p):
            if (near >> min(q, LAST_BIT)) & 1 != 0:
                touched, on = _push(world, balls, balls[p].member, balls[q].member, touched, h, alpha, least)
                closed = closed or on
    for p in range(count):
        one = balls[balls[p].member]
        for s in range(one.walls):
            on = push_of_wall(features, one, s, h, share, least)
            closed = closed or on
    return touched, closed


@kernel
def _step(
    world: Any, features: Any, balls: Any, count: int, touched: int, h: float, alpha: float, least: float
) -> tuple[int, bool]:
    """Follow the members for a step; return how many balls have been touched, and whether any contact went on within it."""
    closed = False
    for stage in range(5):
        touched, on = _forces(world, features, balls, count, touched, h, PARTS[stage], alpha, least)
        closed = closed or on
        share, weight = SHARES[stage], WEIGHTS[stage]
        for p in range(count):
            one = balls[balls[p].member]
            push, turn = h / one.mass, -h / (one.kappa * one.mass * one.radius)
            for c in range(3):
                one.dx[c] = share * one.dx[c] + h * one.cv[c]
                one.dv[c] = share * one.dv[c] + push * one.push[c]
                one.dw[c] = share * one.dw[c] + turn * one.twist[c]
            for c in range(3):
                one.cx[c] += weight * one.dx[c]
                one.cv[c] += weight * one.dv[c]
                one.cw[c] += weight * one.dw[c]
    return touched, closed


@kernel
def _any_hit(balls: Any, count: int) -> bool:
    """Return whether a wall has pushed one of the members that have touched something else."""
    hits = 0
    for p in range(count):
        one = balls[balls[p].member]
        hits |= one.hits if one.met != NO_BALL else 0
    return bool(hits != 0)


@kernel
def _meet_again(balls: Any, count: int, time: float, slow: float) -> bool:
    """Return whether two balls will touch within a time that have touched something, after a wall has sent one of them back."""
    if not _any_hit(balls, count):
        return False
    for p in range(1, count):
        one = balls[balls[p].member]
        for q in range(p):
            other = balls[balls[q].member]
            near = (balls[p].near >> min(q, LAST_BIT)) & 1 != 0
            if near and one.met >= 0 and other.met >= 0:
                r, v, u = apart(one, other), one.cv, other.cv
                far = math.sqrt(dot(r, r))
                c = dot(r, (v[0] - u[0], v[1] - u[1], v[2] - u[2])) / far
                if c > slow and far - one.radius - other.radius <= c * time:
                    return True
    return False


@kernel
def follow(world: Any, features: Any, balls: Any, count: int, i: int, alone: bool) -> tuple[int, float]:
    """Integrate the contacts of members until all have opened; return how many balls were touched, and the largest speed.

    ``alone``: it is a wall that ball i meets, not another ball.
    """
    fastest, h, longest = _scales(world, features, balls, count)
    none = (0.0, 0.0, 0.0)
    for p in range(count):
        one = balls[balls[p].member]
        write_vector(one.dx, none)
        write_vector(one.dv, none)
        write_vector(one.dw, none)
    alpha = damping(world.pair_p[0]) if world.pair_form == CONSTANT else 0 * h
    touched, on, left, lasts = 0, True, STEPS * (10 + 4 * count), 0.0
    if alone:
        balls[i].met, balls[0].touched = AT_WALL, i
        touched = 1
    # (balls that touch but for their last digits begin to push a little later)
    while (on or balls[i].met == NO_BALL or (alone and balls[i].hits == 0)) and (left > 0 or lasts < 10 * longest):
        touched, on = _step(world, features, balls, count, touched, h, alpha, LEAST_SPEED * fastest)
        left -= 1
        lasts += h
        on = on or _meet_again(balls, count, 5 * longest, RETURNS * fastest)
    return touched, fastest
