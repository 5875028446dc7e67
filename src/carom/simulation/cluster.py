"""Contacts of balls that overlap in time: racks, rows, a ball between others. They are resolved together, in one event.

A contact of two balls takes time, 0.2 to 0.4 ms for balls of pool. Where a third ball comes to touch one of the two before that
time is over, one pair at a time is not right, in whatever order. So at a meeting of i and k with the speed of approach u the
contact's duration tau is compared with the gaps to all other balls: where a gap is at most tau times the larger speed at which it
closes, before the contact or after it, all balls nearby are taken together. Their contacts (carom.laws.hertz, with Coulomb's
friction) are integrated in the event's own time until all have opened. Velocities and spins are kept and the places are put
back, so that the event takes no time, as any other.

Neglected are the floor's and the walls' forces meanwhile (they come after, as for a pair), the time itself and the places that
change with it (some 0.1 mm; the loop's balls are rigid wherever they meet), and the spring of the tangent: whatever the law of the
pair, friction is Coulomb's here (with the coefficient of the contact's slip), and a contact whose slip ends stays without slip.

Steps are those of the five-stage method of order four of M. H. Carpenter & C. A. Kennedy, NASA TM-109112 (1994), which keeps one
change beside the state. It writes to fields of the balls' records, so that nothing is allocated.
"""

from __future__ import annotations

import math
from typing import Any

from carom.core.contact import friction_at_slip
from carom.core.jit.kernel import Vec, cross, dot, kernel, vector
from carom.core.motion.phases import HELD
from carom.core.motion.restitution import CONSTANT, restitution
from carom.laws.hertz import LEAST_RESTITUTION, contact_time, damping, lasts_longer, stiffness
from carom.simulation.predict import move_by, state_after, write_vector

__all__ = ["collide_cluster", "overlaps_in_time", "place_all"]

STEPS, LADDER = 20, 0.875  # steps in a contact's duration, at least; the ratio of one possible step to the next
NEAR = 0.15  # of the mean radius: a ball with such a gap to a member is a member too
LEAST_DEPTH = 1e-7  # of the radii: balls that overlap by less, as by the digits of a file, touch
LEAST_SPEED = 1e-9  # of the largest in the cluster: a slower contact does not count
CLOSES = 1e-9  # of the speed of approach: slower balls do not approach a third one
LAST_BIT = 62  # of a whole number: for all members from the 62nd on
NO_BALL, OUTSIDE = -1, -2
# What is left between balls that touch is stopped by this share at a time, down to this share of the largest speed
SHARE, LEAST_CHANGE, MOST_SWEEPS = 0.25, 1e-14, 10_000
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


@kernel
def place_all(world: Any, balls: Any, i: int, k: int) -> None:
    """Write where all other balls are when i and k meet, and how they move, to their fields of the cluster."""
    t = balls[i].clock
    for m in range(balls.shape[0]):
        ball = balls[m]
        if m in (i, k):
            x, v, w = vector(ball.x), vector(ball.v), vector(ball.w)
        elif ball.phase < HELD:
            x, v, w = state_after(world, ball, t - ball.clock)
        else:
            continue
        write_vector(ball.cx, x)
        write_vector(ball.cv, v)
        write_vector(ball.cw, w)


@kernel
def _closes_in_time(one: Any, v: Vec, other: Any, m: float, stiff: float, u: float) -> bool:
    """Return whether a third ball touches ``one``, which has its velocity before the contact or v, before the contact ends."""
    x, y = vector(other.cx), vector(one.cx)
    r = (x[0] - y[0], x[1] - y[1], x[2] - y[2])
    far = math.sqrt(dot(r, r))
    c = max(dot(vector(one.cv), r), dot(v, r)) - dot(vector(other.cv), r)
    gap = max(far - one.radius - other.radius, 0 * far)
    return bool(c > CLOSES * u * far and lasts_longer(m, stiff, u, gap * far / c))


@kernel
def overlaps_in_time(world: Any, balls: Any, i: int, k: int, v: Vec, v2: Vec, u: float) -> bool:
    """Return whether a third ball touches i or k before their contact ends; v, v2: their velocities after it (place_all first)."""
    ball, other = balls[i], balls[k]
    m = ball.mass * other.mass / (ball.mass + other.mass)
    stiff = stiffness(world.pair_modulus, ball.radius, other.radius)
    if not u > 0:
        return False
    for j in range(balls.shape[0]):
        third = balls[j]
        if (
            third.phase < HELD
            and j not in (i, k)
            and (_closes_in_time(ball, v, third, m, stiff, u) or _closes_in_time(other, v2, third, m, stiff, u))
        ):
            return True
    return _others_meet(balls, i, k)


@kernel
def _others_meet(balls: Any, i: int, k: int) -> bool:
    """Return whether another two of the balls that touch meet at this instant: of two meetings none would know of the other."""
    count = _gather(balls, i, k, 1 + LEAST_DEPTH)
    for p in range(2, count):
        one = balls[balls[p].member]
        for q in range(p):
            if (balls[p].near >> min(q, LAST_BIT)) & 1 != 0:
                other = balls[balls[q].member]
                r, v, u = _apart(one, other), one.cv, other.cv
                c = dot(r, (v[0] - u[0], v[1] - u[1], v[2] - u[2]))
                if c > 0 and c * c > CLOSES * CLOSES * dot(r, r) * (dot(v, v) + dot(u, u)):
                    return True
    return False


@kernel
def _gather(balls: Any, i: int, k: int, share: float) -> int:
    """Find the members, by chains of balls within a share of the radii from i and k on; return how many there are."""
    for m in range(balls.shape[0]):
        balls[m].met = OUTSIDE
    balls[0].member, balls[1].member = i, k
    balls[i].met = balls[k].met = NO_BALL
    count = 2
    p = 0
    while p < count:
        one = balls[balls[p].member]
        for m in range(balls.shape[0]):
            other = balls[m]
            if other.met == OUTSIDE and other.phase < HELD and _are_near(one, other, share):
                other.met = NO_BALL
                balls[count].member = m
                count += 1
        p += 1
    for p in range(count):
        near = 0
        for q in range(p):
            if _are_near(balls[balls[p].member], balls[balls[q].member], share):
                near |= 1 << min(q, LAST_BIT)
        balls[p].near = near
    return count


@kernel
def _are_near(one: Any, other: Any, share: float) -> bool:
    r, reach = _apart(one, other), share * (one.radius + other.radius)
    return bool(dot(r, r) <= reach * reach)


@kernel
def _apart(one: Any, other: Any) -> Vec:
    x, y = one.cx, other.cx
    return (y[0] - x[0], y[1] - x[1], y[2] - x[2])


@kernel
def _scales(world: Any, balls: Any, count: int) -> tuple[float, float]:
    """Return the largest relative speed of members, and the time of a step."""
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
    # (a damping beyond the critical one wants shorter steps)
    form, numbers = world.pair_form, vector(world.pair_p)
    stiff = max(damping(restitution(form, numbers, fastest)), damping(restitution(form, numbers, 0 * fastest)))
    time, step = contact_time(least, 1, fastest) / (STEPS * max(1 + 0 * stiff, stiff / 2)), 1.0
    # (one of a ladder: where it changed with speeds and masses, the places of the steps would add noise to derivatives)
    while step > time:
        step *= LADDER
    return fastest, step


@kernel
def _push(
    world: Any, balls: Any, i: int, k: int, touched: int, h: float, alpha: float, least: float
) -> tuple[int, bool]:
    """Add the forces of balls i and k on each other; return how many balls have been touched, and whether the contact goes on."""
    one, other = balls[i], balls[k]
    r = _apart(other, one)
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
    if other.met == NO_BALL:
        other.met, balls[touched].touched = i, k
        touched += 1
    if one.met == NO_BALL:
        one.met, balls[touched].touched = k, i
        touched += 1
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
        _add(one.twist, twist, 1)
        _add(other.twist, twist, 1)
    _add(one.push, f, 1)
    _add(other.push, f, -1)
    return touched, True


@kernel
def _add(row: Any, value: Vec, c: float) -> None:
    row[0] += c * value[0]
    row[1] += c * value[1]
    row[2] += c * value[2]


@kernel
def _forces(world: Any, balls: Any, count: int, touched: int, h: float, alpha: float, least: float) -> tuple[int, bool]:
    """Set the forces and torques on all members; return how many balls have been touched, and whether any contact goes on."""
    none = (0.0, 0.0, 0.0)
    closed = False
    for p in range(count):
        one = balls[balls[p].member]
        write_vector(one.push, none)
        write_vector(one.twist, none)
    for p in range(1, count):
        near = balls[p].near
        for q in range(p):
            if (near >> min(q, LAST_BIT)) & 1 != 0:
                touched, on = _push(world, balls, balls[p].member, balls[q].member, touched, h, alpha, least)
                closed = closed or on
    return touched, closed


@kernel
def _step(world: Any, balls: Any, count: int, touched: int, h: float, alpha: float, least: float) -> tuple[int, bool]:
    """Follow the members for a step; return how many balls have been touched, and whether any contact went on within it."""
    closed = False
    for stage in range(5):
        touched, on = _forces(world, balls, count, touched, h, alpha, least)
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
def _join(balls: Any, count: int, slow: float) -> None:
    """Keep the bits for near members of balls that were touched, and set those of contacts that open no faster than ``slow``."""
    for p in range(1, count):
        one = balls[balls[p].member]
        near = joined = 0
        for q in range(p):
            other, bit = balls[balls[q].member], 1 << min(q, LAST_BIT)
            if balls[p].near & bit != 0 and NO_BALL not in (one.met, other.met):
                r, reach = _apart(other, one), one.radius + other.radius
                v, u = one.cv, other.cv
                rate = dot(r, (v[0] - u[0], v[1] - u[1], v[2] - u[2])) / reach
                near |= bit
                if dot(r, r) < reach * reach and abs(rate) <= slow:
                    joined |= bit
        balls[p].near, balls[p].joined = near, joined


@kernel
def _settle(balls: Any, count: int, fastest: float) -> None:
    """Stop what still approaches between balls that touch, where they are now that the places are put back.

    A contact has turned a little while it was integrated, by some thousandths, and so the balls that it left have such a part of
    their speed towards each other. Joined ones (:func:`_join`) do not part either. All contacts are changed at once, so that
    their order does not matter.
    """
    none = (0.0, 0.0, 0.0)
    most, left = fastest, MOST_SWEEPS
    while most > LEAST_CHANGE * fastest and left > 0:
        most, left = 0 * fastest, left - 1
        for p in range(count):
            write_vector(balls[balls[p].member].push, none)
        for p in range(1, count):
            one = balls[balls[p].member]
            for q in range(p):
                other, bit = balls[balls[q].member], 1 << min(q, LAST_BIT)
                if balls[p].near & bit != 0:
                    r = _apart(other, one)
                    square, reach = dot(r, r), (1 + LEAST_DEPTH) * (one.radius + other.radius)
                    v, u = one.cv, other.cv
                    rate = dot(r, (v[0] - u[0], v[1] - u[1], v[2] - u[2]))
                    if balls[p].joined & bit != 0 or (rate < 0 and square <= reach * reach):
                        c = -SHARE * rate / (square * (1 / one.mass + 1 / other.mass))
                        _add(one.push, r, c)
                        _add(other.push, r, -c)
                        most = max(most, abs(rate) / math.sqrt(square))
        for p in range(count):
            one = balls[balls[p].member]
            _add(one.cv, vector(one.push), 1 / one.mass)


@kernel
def _mean_velocity(balls: Any, count: int) -> Vec:
    """Return the velocity of the centre of mass of the balls that were touched."""
    mass, x, y, z = 0.0, 0.0, 0.0, 0.0
    for p in range(count):
        one = balls[balls[p].touched]
        m, v = one.mass, one.cv
        mass, x, y, z = mass + m, x + m * v[0], y + m * v[1], z + m * v[2]
    return (x / mass, y / mass, z / mass)


@kernel
def _energies(balls: Any, count: int, mean: Vec) -> tuple[float, float, float]:
    """Return twice the energy of the balls that were touched, less that of their centre of mass: before, after, of spins after."""
    before, after, spins = 0.0, 0.0, 0.0
    for p in range(count):
        one = balls[balls[p].touched]
        m, turn = one.mass, one.mass * one.kappa * (one.radius * one.radius)
        u, v, w = vector(one.dv), vector(one.cv), vector(one.cw)
        u, v = (u[0] - mean[0], u[1] - mean[1], u[2] - mean[2]), (v[0] - mean[0], v[1] - mean[1], v[2] - mean[2])
        before += m * dot(u, u) + turn * dot(vector(one.dw), vector(one.dw))
        spins += turn * dot(w, w)
        after += m * dot(v, v) + turn * dot(w, w)
    return before, after, spins


@kernel
def _restore(world: Any, balls: Any, count: int) -> None:
    """Scale the velocities to the energy before, where none is lost, or where the error of the steps has added some."""
    elastic = world.pair_form == CONSTANT and world.pair_p[0] == 1 and world.pair_mu == 0 and world.pair_drop == 0
    mean = _mean_velocity(balls, count)
    before, after, spins = _energies(balls, count, mean)
    if (elastic or after > before) and after > spins and before > spins:
        c = math.sqrt((before - spins) / (after - spins))
        for p in range(count):
            one = balls[balls[p].touched]
            v = one.cv
            write_vector(
                one.cv, (mean[0] + c * (v[0] - mean[0]), mean[1] + c * (v[1] - mean[1]), mean[2] + c * (v[2] - mean[2]))
            )


@kernel
def _first(balls: Any, i: int, p: int, count: int) -> None:
    """Make ball i number p of those that were touched."""
    for q in range(p + 1, count):
        if balls[q].touched == i:
            balls[q].touched, balls[p].touched = balls[p].touched, i


@kernel
def collide_cluster(world: Any, balls: Any, i: int, k: int) -> int:
    """Integrate the contacts of a meeting of balls i and k with those around (place_all first); return how many were touched.

    Ball number p of these, of which i and k are the first, is balls[p].touched. It is moved to the event; its velocity and spin
    after it are cv and cw, those before it dv and dw, and it touched the ball ``met`` first. Returns 0 and changes nothing where i
    and k are a pair: no third ball was touched in time, or they are too slow beside the others to count.
    """
    count = _gather(balls, i, k, 1 + NEAR / 2)
    fastest, h = _scales(world, balls, count)
    none = (0.0, 0.0, 0.0)
    for p in range(count):
        one = balls[balls[p].member]
        write_vector(one.dx, none)
        write_vector(one.dv, none)
        write_vector(one.dw, none)
    alpha = damping(world.pair_p[0]) if world.pair_form == CONSTANT else 0 * h
    touched, on, left = 0, True, STEPS * (10 + 4 * count)
    # (balls that touch but for their last digits begin to push a little later)
    while (on or balls[i].met == NO_BALL) and left > 0:
        touched, on = _step(world, balls, count, touched, h, alpha, LEAST_SPEED * fastest)
        left -= 1
    if touched <= 2 or balls[i].met == NO_BALL or balls[k].met == NO_BALL:
        return 0
    plastic = world.pair_form == CONSTANT and world.pair_p[0] < LEAST_RESTITUTION
    _join(balls, count, 2 * LEAST_RESTITUTION * fastest if plastic else -1)
    _first(balls, i, 0, touched)
    _first(balls, k, 1, touched)
    balls[i].met, balls[k].met = k, i
    t = balls[i].clock
    for p in range(touched):
        j = balls[p].touched
        one = balls[j]
        if j not in (i, k):
            move_by(world, one, t - one.clock, t)
        write_vector(one.dv, vector(one.v))
        write_vector(one.dw, vector(one.w))
        one.was = one.phase
        write_vector(one.cx, vector(one.x))
    _settle(balls, count, fastest)
    _restore(world, balls, touched)
    return touched
