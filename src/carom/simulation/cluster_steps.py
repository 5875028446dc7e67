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
from carom.simulation.cluster_friction import SLOTS, across, friction_before, friction_of_step, rubbed, write_friction
from carom.simulation.cluster_walls import (
    has_friction,
    has_hit,
    push_of_wall,
    rub_wall,
    scales_of_wall,
    until_clear_of_wall,
    until_wall,
    wall_of,
)
from carom.simulation.motion import write_vector

__all__ = ["LAST_BIT", "LEAST_DEPTH", "NO_BALL", "add", "apart", "follow"]

STEPS, LADDER = 20, 0.875  # steps in a contact's duration, at least; the ratio of one possible step to the next
LEAST_DEPTH = 1e-7  # of the radii: balls that overlap by less, as by the digits of a file, touch
LEAST_SPEED = 1e-9  # of the largest in the cluster: a slower contact does not count
SWEEPS = 3
RETURNS = 1e-3  # of that speed: slower balls do not come back
# In durations of a contact: balls that touch again so soon are followed; the longest that all are, and four more for each of them
AHEAD, MOST = 5, 40
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
    world: Any, balls: Any, i: int, k: int, slot: int, touched: int, share: float, alpha: float, least: float
) -> tuple[int, bool]:
    """Add the forces of balls i and k on each other in a share of a step; return how many balls have been touched, and whether
    the contact goes on.

    Its friction is that of the step before, which is kept in a slot of ball i, and is changed at the step's end (:func:`_rub`).
    """
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
    un = dot((v[0] - v2[0], v[1] - v2[1], v[2] - v2[2]), n)
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
        g = friction_before(one.rub, slot, share, push)
        f = (f[0] + g[0], f[1] + g[1], f[2] + g[2])
        twist = cross(n, g)
        add(one.twist, twist, 1)
        add(other.twist, twist, 1)
    add(one.push, f, 1)
    add(other.push, f, -1)
    return touched, True


@kernel
def _rub(world: Any, one: Any, other: Any, slot: int, h: float, last: bool) -> None:
    """Add the changes of the impulse of friction between two balls at the end of a step h."""
    if not rubbed(one.rub, slot):
        return
    r, v, v2, w, w2 = apart(other, one), one.cv, other.cv, one.cw, other.cw
    far, a, a2 = math.sqrt(dot(r, r)), one.radius, other.radius
    n = (r[0] / far, r[1] / far, r[2] / far)
    s = cross((a * w[0] + a2 * w2[0], a * w[1] + a2 * w2[1], a * w[2] + a2 * w2[2]), n)
    t = across((v[0] - v2[0] - s[0], v[1] - v2[1] - s[1], v[2] - v2[2] - s[2]), n)
    mt = 1 / (one.parts * (1 + 1 / one.kappa) / one.mass + other.parts * (1 + 1 / other.kappa) / other.mass)
    mu = friction_at_slip(world.pair_mu, world.pair_drop, world.pair_rate, math.sqrt(dot(t, t)))
    f = friction_of_step(one.rub, slot, n, t, mt, mu, h, last)
    twist = cross(n, f)
    add(one.push, f, 1)
    add(other.push, f, -1)
    add(one.twist, twist, 1)
    add(other.twist, twist, 1)


@kernel
def add(row: Any, value: Vec, c: float) -> None:
    """Add c times a vector to three numbers of an array."""
    row[0] += c * value[0]
    row[1] += c * value[1]
    row[2] += c * value[2]


@kernel
def _clear(balls: Any, count: int) -> None:
    """Set what acts on the members to nothing."""
    none = (0.0, 0.0, 0.0)
    for p in range(count):
        one = balls[balls[p].member]
        write_vector(one.push, none)
        write_vector(one.twist, none)


@kernel
def _forces(
    world: Any, features: Any, balls: Any, count: int, touched: int, h: float, share: float, alpha: float, least: float
) -> tuple[int, bool]:
    """Set the forces and torques on all members; return how many balls have been touched, and whether any contact goes on."""
    _clear(balls, count)
    for p in range(count):
        balls[balls[p].member].pushes = 0
    closed = False
    for p in range(1, count):
        near, slot = balls[p].near, 0
        for q in range(p):
            if (near >> min(q, LAST_BIT)) & 1 != 0:
                i, k = balls[p].member, balls[q].member
                touched, on = _push(world, balls, i, k, slot, touched, share, alpha, least)
                closed = closed or on
                slot += 1
    for p in range(count):
        one = balls[balls[p].member]
        for s in range(one.walls):
            on = push_of_wall(features, one, s, h, share, least)
            closed = closed or on
    return touched, closed


@kernel
def _rub_all(world: Any, features: Any, balls: Any, count: int, h: float, last: bool) -> None:
    """Change the impulses of friction of a step to what they have to be, at all contacts at once: their order does not matter.

    A ball that rubs at several contacts has a part of its mass at each, so that together they take no more slip than there is.
    """
    for p in range(count):
        one = balls[balls[p].member]
        one.parts = max((1.0 + one.pushes) / 2, 1.0)
    _clear(balls, count)
    for p in range(1, count if world.pair_mu > 0 or world.pair_drop > 0 else 1):
        near, slot = balls[p].near, 0
        for q in range(p):
            if (near >> min(q, LAST_BIT)) & 1 != 0:
                _rub(world, balls[balls[p].member], balls[balls[q].member], slot, h, last)
                slot += 1
    for p in range(count):
        one = balls[balls[p].member]
        for s in range(one.walls):
            rub_wall(features, one, s, h, last)
    for p in range(count):
        one = balls[balls[p].member]
        add(one.cv, vector(one.push), 1 / one.mass)
        add(one.cw, vector(one.twist), -1 / (one.kappa * one.mass * one.radius))


@kernel
def _step(
    world: Any, features: Any, balls: Any, count: int, touched: int, h: float, alpha: float, least: float, rubs: bool
) -> tuple[int, bool]:
    """Follow the members for a step, with friction where something ``rubs``.

    Returns how many balls have been touched, and whether any contact went on within the step.
    """
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
    if closed and rubs:
        for sweep in range(SWEEPS):
            _rub_all(world, features, balls, count, h, sweep == SWEEPS - 1)
    return touched, closed


@kernel
def _until_contact(balls: Any, count: int, touched: int, lasts: float, ahead: float, slow: float) -> float:
    """Return how soon at the soonest anything touches again, now that all contacts are open; infinity where the cluster is over.

    It goes on where balls that have touched something will touch within the time ``ahead``, or a ball and a wall that it has
    touched; and where one of three or more comes to a ball that nothing has touched yet while a contact ``lasts``. Slower balls
    than ``slow`` do not count.
    """
    never = math.inf + 0 * ahead
    soonest, goes_on = never, False
    for p in range(count):
        one = balls[balls[p].member]
        for s in range(one.walls):
            time, rate = until_wall(one, s)
            again = one.met != NO_BALL and has_hit(one, s) and rate > slow
            goes_on = goes_on or (again and time <= ahead)
            soonest = min(soonest, time)
        for q in range(p):
            other = balls[balls[q].member]
            if (balls[p].near >> min(q, LAST_BIT)) & 1 != 0:
                r, v, u = apart(one, other), one.cv, other.cv
                far = math.sqrt(dot(r, r))
                c = dot(r, (v[0] - u[0], v[1] - u[1], v[2] - u[2])) / far
                if c > 0:
                    time = max(far - one.radius - other.radius, 0 * far) / c
                    soonest = min(soonest, time)
                    if one.met >= 0 and other.met >= 0:
                        goes_on = goes_on or (c > slow and time <= ahead)
                    elif one.met >= 0 or other.met >= 0:
                        goes_on = goes_on or (c > slow and time <= lasts and touched > 2)
    return soonest if goes_on else never


@kernel
def _until_clear(balls: Any, count: int, ago: float, lasts: float) -> float:
    """Return when, on straight ways, the last of what has touched comes clear: contacts push no more a little before.

    It is less than 0 where that was before now, and not longer than ``ago``; and not later than a contact ``lasts``.
    """
    last = -ago
    for p in range(count):
        one = balls[balls[p].member]
        for s in range(one.walls):
            time = until_clear_of_wall(one, s)
            last = max(last, time) if time <= lasts else last
        for q in range(p):
            other = balls[balls[q].member]
            if (balls[p].near >> min(q, LAST_BIT)) & 1 != 0:
                r, v, u, reach = apart(other, one), one.cv, other.cv, one.radius + other.radius
                v = (v[0] - u[0], v[1] - u[1], v[2] - u[2])
                b, c, square = dot(r, v), dot(r, r) - reach * reach, dot(v, v)
                if (b > 0 or c < 0) and b * b > square * c and square > 0:
                    time = (math.sqrt(b * b - square * c) - b) / square
                    last = max(last, time) if time <= lasts else last
    return last


@kernel
def _move(balls: Any, count: int, time: float) -> None:
    """Move the members along their ways for a time."""
    for p in range(count):
        add(balls[balls[p].member].cx, vector(balls[balls[p].member].cv), time)


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
        for s in range(SLOTS):
            write_friction(one.rub, s, none)
        for s in range(one.walls):
            write_friction(one.wall_rub, s, none)
    alpha = damping(world.pair_p[0]) if world.pair_form == CONSTANT else 0 * h
    touched, on, left, lasts, rubs = (
        0,
        True,
        STEPS * (MOST + 4 * count),
        0.0,
        has_friction(world, features, balls, count),
    )
    open_for = 0 * h
    ahead = max(longest, AHEAD * STEPS * h)
    if alone:
        balls[i].met, balls[0].touched = AT_WALL, i
        touched = 1
    # (balls that touch but for their last digits begin to push a little later)
    while (on or balls[i].met == NO_BALL or (alone and balls[i].hits == 0)) and (left > 0 or lasts < 10 * longest):
        touched, on = _step(world, features, balls, count, touched, h, alpha, LEAST_SPEED * fastest, rubs)
        left -= 1
        lasts += h
        open_for = 0 * h if on else open_for + h
        if not on:
            wait = _until_contact(balls, count, touched, STEPS * h, ahead, RETURNS * fastest)
            if wait < math.inf:
                on = True
                open_for += wait
                _move(balls, count, wait)
    _move(balls, count, _until_clear(balls, count, open_for, STEPS * h))
    return touched, fastest
