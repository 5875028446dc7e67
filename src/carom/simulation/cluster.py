"""Contacts of balls that overlap in time: racks, rows, a ball between others. They are resolved together, in one event.

A contact of two balls takes time, 0.2 to 0.4 ms for balls of pool. Where a third ball comes to touch one of the two before that
time is over, one pair at a time is not right, in whatever order. So at a meeting of i and k with the speed of approach u the
contact's duration tau is compared with the gaps to all other balls: where a gap is at most tau times the larger speed at which it
closes, before the contact or after it, all balls nearby are taken together. Their contacts (carom.laws.pair, with Coulomb's
friction) are integrated in the event's own time until all have opened (carom.simulation.cluster_steps). Velocities and spins
are kept, and the balls are put back on the ways on which they leave, so that the event takes no time, as any other: as far back as
it has lasted, or less where they would be in each other's way or in a wall. So it is where one of the two comes to touch a wall,
and at a meeting of a ball and a wall where another ball, or another wall, touches the ball before the wall's contact time is over;
or where the ball is sent back to another one, if the wall's law is the contact's, so that nothing of the law is lost.

Neglected are the floor's forces meanwhile (they come after, as for a pair), the time itself and the places that change with it
(some 0.1 mm; the loop's balls are rigid wherever they meet), and the spring of the tangent: whatever the law of the pair, friction
is Coulomb's here (with the coefficient of the contact's slip), and a contact whose slip ends stays without slip.
"""

from __future__ import annotations

import math
from typing import Any

from carom.core.geometry.features import OVER, contact_normal, gap_to_feature, is_out_of_reach
from carom.core.jit.kernel import Vec, dot, kernel, vector
from carom.core.motion.phases import CONSTANT, HELD
from carom.laws.law import CONTACT_WALL
from carom.laws.pair import LEAST_RESTITUTION, lasts_longer, stiffness
from carom.simulation.cluster_steps import (
    AHEAD_AT_WALL,
    LAST_BIT,
    LEAST_DEPTH,
    NO_BALL,
    SLACK,
    acts_in_time,
    add,
    apart,
    find_walls,
    follow,
    has_hit,
    is_lasting,
    loses_nothing_at_walls,
    settle_wall,
    share_momentum,
    since_wall,
    wall_in_time,
    walls_in_time,
)
from carom.simulation.motion import move_by, state_after, write_vector

NEAR = 0.15  # of the mean radius: a ball with such a gap to a member is a member too
CLOSES = 1e-9  # of the speed of approach: slower balls do not approach a third one
# how far balls are moved at most, of the radius, so that none overlap; and at all
HOP, LEAP = 0.1, 0.5
COMPRESSED = 1e-3  # of the distance: by so much balls that leave each other may overlap (those of pool do at 0.4 m/s)
DELAY = 4.0  # times gravity, a speed over the time of a cluster: balls that leave each other more slowly never overlap
OUTSIDE = -2
# What is left between balls that touch is stopped by this share at a time, down to this share of the largest speed
SHARE, LEAST_CHANGE, MOST_SWEEPS = 0.25, 1e-14, 10_000


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
def _time_to_touch(one: Any, v: Vec, other: Any, u: float) -> float:
    """Return when a third ball touches ``one``, which has its velocity before an impact of speed u or v after it; else infinity."""
    x, y = vector(other.cx), vector(one.cx)
    r = (x[0] - y[0], x[1] - y[1], x[2] - y[2])
    far = math.sqrt(dot(r, r))
    c = max(dot(vector(one.cv), r), dot(v, r)) - dot(vector(other.cv), r)
    gap = max(far - one.radius - other.radius, 0 * far)
    return gap * far / c if c > CLOSES * u * far else math.inf + 0 * far


@kernel
def overlaps_in_time(world: Any, features: Any, balls: Any, i: int, k: int, v: Vec, v2: Vec, u: float) -> bool:
    """Return whether a third ball, or a wall, touches i or k before their contact ends; v, v2: their velocities after it (place_all
    first).
    """
    ball, other = balls[i], balls[k]
    m = ball.mass * other.mass / (ball.mass + other.mass)
    stiff = stiffness(world.pair_modulus, ball.radius, other.radius)
    if not u > 0:
        return False
    for j in range(balls.shape[0]):
        third = balls[j]
        if third.phase < HELD and j not in (i, k):
            time = min(_time_to_touch(ball, v, third, u), _time_to_touch(other, v2, third, u))
            if lasts_longer(m, stiff, u, time):
                return True
    time = min(wall_in_time(features, ball, v, u), wall_in_time(features, other, v2, u))
    return lasts_longer(m, stiff, u, time) or _others_meet(balls, i, k)


@kernel
def overlaps_at_wall(world: Any, features: Any, balls: Any, i: int, k: int, n: Vec, v: Vec, u: float) -> bool:
    """Return whether ball i touches a ball or a wall while it touches feature k, of normal n, which it meets with the speed u.

    v: the velocity with which it leaves.
    """
    f, ball = features[k], balls[i]
    if not acts_in_time(f) or is_lasting(world, ball, f, u):
        return False
    place_all(world, balls, i, i)
    for j in range(balls.shape[0]):
        third = balls[j]
        if third.phase < HELD and j != i and _are_near(ball, third, 1 + NEAR / 2):
            time = _time_to_touch(ball, v, third, u)
            if time <= AHEAD_AT_WALL * f.contact_time:
                return True
    return walls_in_time(world, features, ball, f, n, v, u)


@kernel
def _others_meet(balls: Any, i: int, k: int) -> bool:
    """Return whether another two of the balls that touch meet at this instant: of two meetings none would know of the other."""
    count = _gather(balls, i, k, 1 + LEAST_DEPTH)
    for p in range(2, count):
        one = balls[balls[p].member]
        for q in range(p):
            if (balls[p].near >> min(q, LAST_BIT)) & 1 != 0:
                other = balls[balls[q].member]
                r, v, u = apart(one, other), one.cv, other.cv
                c = dot(r, (v[0] - u[0], v[1] - u[1], v[2] - u[2]))
                if c > 0 and c * c > CLOSES * CLOSES * dot(r, r) * (dot(v, v) + dot(u, u)):
                    return True
    return False


@kernel
def _gather(balls: Any, i: int, k: int, share: float) -> int:
    """Find the members, by chains of balls within a share of the radii from i and k on; return how many there are."""
    for m in range(balls.shape[0]):
        balls[m].met = OUTSIDE
    balls[0].member = i
    balls[i].met = balls[k].met = NO_BALL
    count = 1
    if k != i:
        balls[1].member = k
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
    r, reach = apart(one, other), share * (one.radius + other.radius)
    return bool(dot(r, r) <= reach * reach)


@kernel
def _join(balls: Any, count: int, slow: float) -> None:
    """Keep the bits for near members of balls that were touched, and set those of contacts that open no faster than ``slow``."""
    for p in range(1, count):
        one = balls[balls[p].member]
        near = joined = 0
        for q in range(p):
            other, bit = balls[balls[q].member], 1 << min(q, LAST_BIT)
            if balls[p].near & bit != 0 and NO_BALL not in (one.met, other.met):
                r, reach = apart(other, one), one.radius + other.radius
                v, u = one.cv, other.cv
                rate = dot(r, (v[0] - u[0], v[1] - u[1], v[2] - u[2])) / reach
                near |= bit
                if dot(r, r) < reach * reach and abs(rate) <= slow:
                    joined |= bit
        balls[p].near, balls[p].joined = near, joined


@kernel
def _since_walls(one: Any, time: float) -> float:
    """Return the time, or less: for how long a ball, which is at dx, has been on its way from the walls that it has touched."""
    for s in range(one.walls):
        time = min(time, since_wall(one, s)) if has_hit(one, s) else time
    return time


@kernel
def _across(pull: Vec, d: Vec) -> Vec:
    """Return a vector without its component along the pull."""
    square = dot(pull, pull)
    c = dot(d, pull) / square if square > 0 else 0 * square
    return d[0] - c * pull[0], d[1] - c * pull[1], d[2] - c * pull[2]


@kernel
def _share(pull: Vec, one: Any, other: Any, overlap: bool, slow: float) -> bool:
    """Put two balls less far back, where they would be in each other's way or will meet; return whether this changes anything.

    They may ``overlap`` a little while they leave each other faster than ``slow``.
    """
    x, y, a, b, reach = one.dx, other.dx, one.ago, other.ago, one.radius + other.radius
    v, u = _across(pull, vector(one.cv)), _across(pull, vector(other.cv))
    r, c = (x[0] - y[0], x[1] - y[1], x[2] - y[2]), (v[0] - u[0], v[1] - u[1], v[2] - u[2])
    far = (r[0] - a * v[0] + b * u[0], r[1] - a * v[1] + b * u[1], r[2] - a * v[2] + b * u[2])
    time, rate, square = max(a, b), dot(r, c), dot(c, c)
    overlap = overlap and square > slow * slow
    if overlap and dot(far, c) > 0:
        reach = reach * (1 - COMPRESSED)
    root = rate * rate - square * (dot(r, r) - reach * reach)
    if rate > 0 and root > 0:
        time = min(time, max((rate - math.sqrt(root)) / square, 0 * rate))
    in_way = dot(far, far) < reach * reach
    if in_way or (rate < 0 and root > 0) or time < max(a, b):
        one.ago = other.ago = min(time, a, b)
    return bool(one.ago != a or other.ago != b)


@kernel
def _go_back(world: Any, balls: Any, touched: int, time: float, overlap: bool) -> None:
    """Write to all balls that a cluster has moved, which are at dx, how far back they can be put on their ways after it.

    It is the time that the cluster has lasted, so that they are on their true ways, or less where they would be in a wall that they
    have touched or in each other's way; they may ``overlap`` while they leave each other. Balls that will meet are put back by
    the same time.
    """
    pull = vector(world.force)
    for p in range(touched):
        one = balls[balls[p].touched]
        one.ago = _since_walls(one, time)
    # (friction and the pull of a slope stop slower balls before they have left each other)
    slow = DELAY * math.sqrt(dot(pull, pull)) * time
    changes = True
    while changes:
        changes = False
        for p in range(touched):
            for q in range(p):
                changes = _share(pull, balls[balls[p].touched], balls[balls[q].touched], overlap, slow) or changes


@kernel
def _is_room(world: Any, features: Any, balls: Any, touched: int, leap: float) -> bool:
    """Return whether the balls that were touched can be put back on their ways (:func:`_go_back`), across the pull, on the floor.

    They can go a little way, where nothing else is; near a pocket they stay.
    """
    for p in range(touched):
        one = balls[balls[p].touched]
        v, a, ago, far = _across(vector(world.force), vector(one.cv)), one.radius, one.ago, one.dx
        x = (far[0] - ago * v[0], far[1] - ago * v[1], far[2] - ago * v[2] if world.floor == 0 else one.x[2])
        d = (x[0] - one.x[0], x[1] - one.x[1], x[2] - one.x[2])
        if dot(d, d) > leap * leap * a * a:
            return False
        for k in range(features.shape[0]):
            f = features[k]
            if not is_out_of_reach(f, a, vector(one.x), leap * a):
                gap = gap_to_feature(f, a, x)
                if f.kind == OVER or -a < gap < -2 * SLACK * a:
                    return False
                if -a < gap < 0:
                    n = contact_normal(f, x, vector(v))
                    x = (x[0] - gap * n[0], x[1] - gap * n[1], x[2] - gap * n[2])
        write_vector(one.cx, x)
    t = balls[balls[0].touched].clock
    for p in range(touched):
        i = balls[p].touched
        one, x = balls[i], vector(balls[i].cx)
        for j in range(balls.shape[0]):
            other = balls[j]
            if other.phase < HELD and j != i:
                is_beside = other.met in (NO_BALL, OUTSIDE)
                y = state_after(world, other, t - other.clock)[0] if is_beside else vector(other.cx)
                r, v, u = (x[0] - y[0], x[1] - y[1], x[2] - y[2]), one.cv, other.cv
                leaves = not is_beside and dot(r, (v[0] - u[0], v[1] - u[1], v[2] - u[2])) > 0
                reach = (1 - LEAST_DEPTH - (COMPRESSED if leaves else 0.0)) * (one.radius + other.radius)
                if dot(r, r) < reach * reach:
                    return False
    return True


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
                    r = apart(other, one)
                    square, reach = dot(r, r), (1 + LEAST_DEPTH) * (one.radius + other.radius)
                    v, u = one.cv, other.cv
                    rate = dot(r, (v[0] - u[0], v[1] - u[1], v[2] - u[2]))
                    if balls[p].joined & bit != 0 or (rate < 0 and square <= reach * reach):
                        c = -SHARE * rate / (square * (1 / one.mass + 1 / other.mass))
                        add(one.push, r, c)
                        add(other.push, r, -c)
                        most = max(most, abs(rate) / math.sqrt(square))
        for p in range(count):
            one = balls[balls[p].member]
            for s in range(one.walls):
                most = max(most, settle_wall(one, s, SHARE))
        for p in range(count):
            one = balls[balls[p].member]
            add(one.cv, vector(one.push), 1 / one.mass)


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
    """Return twice the energy of the balls that were touched, less the centre of mass's: before, after, of spins after."""
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
def _restore(world: Any, features: Any, balls: Any, count: int) -> None:
    """Scale the velocities to the energy before, where none is lost, or where the error of the steps has added some.

    They are the velocities beside the centre of mass, or, where walls push, beside the walls.
    """
    elastic = world.pair_form == CONSTANT and world.pair_p[0] == 1 and world.pair_mu == 0 and world.pair_drop == 0
    free = True
    for p in range(count):
        one = balls[balls[p].touched]
        free = free and one.hits == 0
        elastic = elastic and loses_nothing_at_walls(features, one)
    mean = _mean_velocity(balls, count)
    if not free:
        mean = (0 * mean[0], 0 * mean[1], 0 * mean[2])
    before, after, spins = _energies(balls, count, mean)
    if (elastic or after > before) and after > spins and before > spins:
        c = math.sqrt((before - spins) / (after - spins))
        for p in range(count):
            one = balls[balls[p].touched]
            v = one.cv
            write_vector(
                one.cv, (mean[0] + c * (v[0] - mean[0]), mean[1] + c * (v[1] - mean[1]), mean[2] + c * (v[2] - mean[2]))
            )
    if not free:
        share_momentum(balls, count)


@kernel
def _first(balls: Any, i: int, p: int, count: int) -> None:
    """Make ball i number p of those that were touched."""
    for q in range(p + 1, count):
        if balls[q].touched == i:
            balls[q].touched, balls[p].touched = balls[p].touched, i


@kernel
def collide_cluster(world: Any, features: Any, balls: Any, i: int, k: int, f: int) -> int:
    """Integrate the contacts of a meeting with those around (place_all first); return how many balls were touched.

    The meeting is that of balls i and k, or of ball i (and k = i) and feature f >= 0. Ball number p of those that were touched, of
    which i and k are the first, is balls[p].touched. It is moved to the event; its velocity and spin after it are cv and cw, those
    before it dv and dw, and it touched the ball ``met`` first. Returns 0 and changes nothing where nothing else was touched,
    or i and k are too slow beside the others to count.
    """
    count = _gather(balls, i, k, 1 + NEAR / 2)
    find_walls(world, features, balls, count, i, f)
    touched, fastest, time, later = follow(world, features, balls, count, i, f >= 0)
    hits = coupled = 0
    for p in range(touched):
        one = balls[balls[p].touched]
        hits |= one.hits
        coupled |= one.coupled & 1
    if f >= 0:
        if balls[i].coupled & 1 == 0 or not has_hit(balls[i], 0):
            return 0
    else:
        # (two balls alone are left to the law of the pair, unless it is that of the integration, which moves them truly)
        alone = world.pair_law != CONTACT_WALL or world.pair_beta > 0
        if ((touched <= 2 or later) and alone and coupled == 0) or balls[i].met == NO_BALL or balls[k].met == NO_BALL:
            return 0
        if hits != 0 and coupled == 0:
            hits = 0
            # (walls that are touched once the others have parted come after the event, with their own laws)
            place_all(world, balls, i, k)
            count = _gather(balls, i, k, 1 + NEAR / 2)
            for p in range(count):
                balls[balls[p].member].walls = balls[balls[p].member].hits = 0
            touched, fastest, time, later = follow(world, features, balls, count, i, False)
            if ((touched <= 2 or later) and alone) or balls[i].met == NO_BALL or balls[k].met == NO_BALL:
                return 0
    plastic = world.pair_form == CONSTANT and world.pair_p[0] < LEAST_RESTITUTION
    _join(balls, count, 2 * LEAST_RESTITUTION * fastest if plastic else -1)
    _first(balls, i, 0, touched)
    if k != i:
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
        x, y = one.x, one.cx
        d = _across(vector(world.force), (y[0] - x[0], y[1] - x[1], y[2] - x[2]))
        write_vector(one.dx, (x[0] + d[0], x[1] + d[1], x[2] + d[2]))
        write_vector(one.cx, vector(x))
    # (balls that stay in contact are still compressed at the end: they stay where they met)
    room, tries = False, 3 if plastic else 0
    while not room and tries < 3:
        _go_back(world, balls, touched, time, tries == 1)
        room = _is_room(world, features, balls, touched, HOP if tries == 0 else LEAP)
        tries += 1
    if room:
        for p in range(touched):
            write_vector(balls[balls[p].touched].x, vector(balls[balls[p].touched].cx))
    for p in range(touched):
        write_vector(balls[balls[p].touched].cx, vector(balls[balls[p].touched].x))
    _settle(balls, count, fastest)
    _restore(world, features, balls, touched)
    return touched
