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
from carom.core.geometry.features import FACE, OVER, contact_normal, gap_to_feature, is_out_of_reach, least_gap
from carom.core.jit.kernel import Vec, cross, dot, kernel, vector
from carom.core.motion.phases import CONSTANT, restitution
from carom.laws.law import CONTACT_WALL, MIRROR_WALL, NO_SLIP_WALL, ROLLING_WALL, TWO_STEP_WALL
from carom.laws.pair import contact_time, damping, stiffness
from carom.simulation.motion import accelerations_of, is_on_floor, write_vector

SPRINGS = (
    2  # bit of a ball that has touched a wall whose own law is that of a spring: what it touches after that counts
)
MOST_WALLS = 3  # that one ball can touch at once
BITS = 20  # of a feature's number
LEAST_TIME = 1e-6  # s: a shorter contact takes no time
NEAR = 0.15  # of the radius: a wall with such a gap to a ball can act on it
SLACK = 1e-7  # of the radius: a ball that overlaps by less, as by the digits of a file, touches
CLOSES = 1e-9  # of the speed of approach: a slower ball does not approach
SQUARE = 1e-6  # cosine of two normals: smooth walls at right angles do not act on each other
FLAT = 1 - 1e-4  # cosine of the normals of two faces, 0.8 degrees: flatter corners are one wall
FRONT = 1e-2  # of the radius: a point so little before a plane is of the same wall
ROOT_5 = math.sqrt(5)


@kernel
def wall_of(ball: Any, s: int) -> int:
    """Return the number of the feature that is wall s of a ball in a cluster."""
    return (ball.wall >> (BITS * s)) & ((1 << BITS) - 1)  # type: ignore[no-any-return]


@kernel
def has_hit(ball: Any, s: int) -> bool:
    """Return whether a ball of a cluster has touched its wall s."""
    return bool((ball.hits >> s) & 1 != 0)


@kernel
def wall_impulse(ball: Any, s: int) -> Vec:
    """Return the impulse of wall s on a ball of a cluster."""
    j = ball.wall_push
    return (j[3 * s], j[3 * s + 1], j[3 * s + 2])


@kernel
def acts_in_time(f: Any) -> bool:
    """Return whether a contact with feature f takes time."""
    return bool(f.kind != OVER and f.contact_time > LEAST_TIME and f.law not in (NO_SLIP_WALL, ROLLING_WALL))


@kernel
def _can_touch(f: Any, ball: Any) -> bool:
    """Return whether feature f acts in time and can be near a ball: a quick test."""
    return acts_in_time(f) and not is_out_of_reach(f, ball.radius, vector(ball.cx), NEAR * ball.radius)


@kernel
def _time_to_wall(f: Any, ball: Any, v: Vec, u: float) -> tuple[float, float, Vec]:
    """Return when a ball touches a wall nearby with its velocity before an impact of speed u, or with v, its gap, and the normal.

    The time is infinite where it does not approach.
    """
    x, a, zero = vector(ball.cx), ball.radius, 0 * u
    gap = gap_to_feature(f, a, x) + zero
    if least_gap(f, a) <= gap <= NEAR * a:
        n = contact_normal(f, x, vector(ball.cv))
        c = -min(dot(vector(ball.cv), n), dot(v, n))
        if c > CLOSES * u:
            return max(gap, zero) / c, gap, n
    return math.inf + zero, zero, (zero, zero, zero)


@kernel
def _is_apart(f: Any, g: Any, a: float, n: Vec, gap: float, other: Vec, other_gap: float) -> bool:
    """Return whether the points of two walls that are nearest to a ball of radius a lie before each other's planes.

    Else they are of one wall, such as a face and its edge, and only the nearer one can touch the ball. The ball lies over two
    faces only in a corner, where it can touch both.
    """
    c, one, two = dot(n, other), a + gap, a + other_gap
    if f.kind == FACE and g.kind == FACE:
        return bool(c < FLAT)
    return bool(one - two * c > FRONT * a and two - one * c > FRONT * a)


@kernel
def _is_ideal(f: Any) -> bool:
    """Return whether a wall is of mathematical billiards: a mirror, or with a tangential restitution, which springs lack."""
    return bool(f.law == MIRROR_WALL or (f.law in (CONTACT_WALL, TWO_STEP_WALL) and f.beta > 0))


@kernel
def wall_in_time(features: Any, ball: Any, v: Vec, u: float) -> float:
    """Return how soon a ball that meets another with the speed u touches a wall, before that contact or after it (with v)."""
    soonest = math.inf + 0 * u
    for k in range(features.shape[0]):
        if _can_touch(features[k], ball):
            time, _gap, _n = _time_to_wall(features[k], ball, v, u)
            soonest = min(soonest, time)
    return soonest


@kernel
def walls_in_time(world: Any, features: Any, ball: Any, f: Any, n: Vec, v: Vec, u: float) -> bool:
    """Return whether a ball that meets feature f with the speed u touches another wall, which acts on it too, before this ends.

    At right angles only friction does: each wall rubs along the normal of the other. A ball alone meets the walls of mathematical
    billiards, mirrors and those with a tangential restitution, one after the other: so it keeps the energy that they return.
    """
    rests = world.together != 0 and is_on_floor(world, ball)
    if _is_ideal(f):
        return False
    for k in range(features.shape[0]):
        g = features[k]
        if not _is_ideal(g) and _can_touch(g, ball):
            time, gap, other = _time_to_wall(g, ball, v, u)
            if time <= f.contact_time and _is_apart(f, g, ball.radius, n, 0 * u, other, gap):
                c = n[0] * other[0] + n[1] * other[1]
                if not (rests and n[2] < 0 and other[2] < 0):
                    c += n[2] * other[2]
                if abs(c) > SQUARE or _mu(f) + _mu(g) > 0:
                    return True
    return False


@kernel
def is_lasting(world: Any, ball: Any, f: Any, u: float) -> bool:
    """Return whether a force acts on a ball that changes its speed of approach u while it touches feature f."""
    acc = accelerations_of(world, ball)[0]
    return not u * u > f.contact_time * f.contact_time * dot(acc, acc)


@kernel
def find_walls(world: Any, features: Any, balls: Any, count: int, i: int, own: int) -> None:
    """Write the walls near each member of a cluster to its record, as planes; feature ``own`` >= 0 is the first one of ball i."""
    for p in range(count):
        ball = balls[balls[p].member]
        ball.wall = ball.walls = ball.hits = ball.coupled = 0
        ball.rests = 1 if world.together != 0 and is_on_floor(world, ball) else 0
        if own >= 0 and balls[p].member == i:
            _add_wall(features, ball, own)
        for k in range(features.shape[0]):
            if k != own and _can_touch(features[k], ball):
                _add_wall(features, ball, k)


@kernel
def _add_wall(features: Any, ball: Any, k: int) -> None:
    """Write feature k to a ball's record, if it is near; of features of one wall only the nearest."""
    x, a = vector(ball.cx), ball.radius
    gap = gap_to_feature(features[k], a, x)
    if not least_gap(features[k], a) <= gap <= NEAR * a:
        return
    n = contact_normal(features[k], x, vector(ball.cv))
    gap = max(gap, 0 * gap)
    at = ball.walls
    for s in range(ball.walls):
        other = _normal(ball, s)
        other_gap = dot(other, x) - ball.wall_at[s]
        if not _is_apart(features[k], features[wall_of(ball, s)], a, n, gap, other, other_gap):
            if gap >= other_gap or at < ball.walls:
                return
            at = s
    if at == MOST_WALLS:
        return
    ball.wall = (ball.wall & ~(((1 << BITS) - 1) << (BITS * at))) | (k << (BITS * at))
    ball.wall_at[at] = dot(n, x) - gap
    for c in range(3):
        ball.wall_n[3 * at + c] = n[c]
        ball.wall_push[3 * at + c] = 0 * n[c]
    ball.walls = max(ball.walls, at + 1)


@kernel
def _normal(ball: Any, s: int) -> Vec:
    n = ball.wall_n
    return (n[3 * s], n[3 * s + 1], n[3 * s + 2])


@kernel
def _mu(f: Any) -> float:
    return f.mu if f.law != MIRROR_WALL else 0 * f.contact_time  # type: ignore[no-any-return]


@kernel
def scales_of_wall(features: Any, ball: Any, s: int) -> tuple[float, float]:
    """Return the speed at which a ball moves along the normal of its wall s, and the time in which that contact changes."""
    f, un = features[wall_of(ball, s)], abs(dot(vector(ball.cv), _normal(ball, s)))
    numbers = vector(f.e)
    stiff = max(damping(restitution(f.form, numbers, un)), damping(restitution(f.form, numbers, 0 * un)))
    return un, f.contact_time / max(1 + 0 * stiff, stiff / 2)


@kernel
def has_friction(world: Any, features: Any, balls: Any, count: int) -> bool:
    """Return whether the balls of a cluster, or one of the walls near them, have friction."""
    rubs = world.pair_mu > 0 or world.pair_drop > 0
    for p in range(count):
        ball = balls[balls[p].member]
        for s in range(ball.walls):
            rubs = rubs or _mu(features[wall_of(ball, s)]) > 0
    return bool(rubs)


@kernel
def until_wall(ball: Any, s: int) -> tuple[float, float]:
    """Return when a ball comes to its wall s, at the soonest, and how fast; the time is infinite where it does not come."""
    n = _normal(ball, s)
    rate = -dot(vector(ball.cv), n)
    if not rate > 0:
        return math.inf + 0 * rate, rate
    return max(dot(vector(ball.cx), n) - ball.wall_at[s], 0 * rate) / rate, rate


@kernel
def until_clear_of_wall(ball: Any, s: int) -> float:
    """Return when a ball that leaves its wall s comes clear of it, less than 0 where it has; else minus infinity."""
    n = _normal(ball, s)
    rate = dot(vector(ball.cv), n)
    return (ball.wall_at[s] - dot(vector(ball.cx), n)) / rate if rate > 0 else -math.inf + 0 * rate


@kernel
def since_wall(ball: Any, s: int) -> float:
    """Return for how long a ball of a cluster, which is at dx, has been on its way from its wall s; infinity if it is not."""
    n = _normal(ball, s)
    rate = dot(vector(ball.cv), n)
    if not rate > 0:
        return math.inf + 0 * rate
    return max(dot(vector(ball.dx), n) - ball.wall_at[s], 0 * rate) / rate  # type: ignore[no-any-return]


@kernel
def push_of_wall(features: Any, ball: Any, s: int, h: float, share: float, least: float) -> bool:
    """Add the force of wall s on a ball, and its share of a step h to the impulse; return whether the contact goes on."""
    f, n = features[wall_of(ball, s)], _normal(ball, s)
    depth = ball.wall_at[s] - SLACK * ball.radius - dot(vector(ball.cx), n)
    if not depth > 0:
        return False
    v, m = vector(ball.cv), ball.mass
    un = dot(v, n)
    borne = _is_borne(ball, n)
    if borne:
        # the floor bears it: it can move along the floor alone
        un -= v[2] * n[2]
        m = m / (1 - n[2] * n[2])
    rate = math.pi / f.contact_time
    # the speed at which the ball would meet the wall without damping
    speed = math.sqrt(un * un + rate * rate * depth * depth)
    if not speed > least:
        return False
    e = restitution(f.form, vector(f.e), speed)
    if f.form != CONSTANT:
        e = restitution(f.form, vector(f.e), 2 * speed / (1 + e))
    push = m * rate * (rate * depth - 2 * damping(e) / ROOT_5 * un)
    if not push > 0:
        return bool(un < 0)
    ball.hits |= 1 << s
    ball.pushes += 1
    if ball.pushes > 1:
        ball.coupled |= 1
    if f.law == CONTACT_WALL and not f.beta > 0:
        ball.coupled |= SPRINGS
    force = (push * n[0], push * n[1], push * n[2])
    if _mu(f) > 0:
        if begins(ball.wall_rub, s):
            write_slip(ball.wall_rub, s, _slip_at_wall(ball, n))
        g = friction_before(ball.wall_rub, s, share, push)
        force = (force[0] + g[0], force[1] + g[1], force[2] + g[2])
        twist = cross(n, g)
        for k in range(3):
            ball.twist[k] += twist[k]
    _give(ball, s, force, share * h, borne)
    return True


@kernel
def _is_borne(ball: Any, n: Vec) -> bool:
    """Return whether the floor bears a ball that a wall pushes down."""
    return bool(ball.rests != 0 and n[2] < 0 and not ball.cv[2] > 0)


@kernel
def _give(ball: Any, s: int, force: Vec, time: float, borne: bool) -> None:
    """Add a force of wall s, and its impulse in a time."""
    if borne and force[2] < 0:
        force = (force[0], force[1], 0 * force[2])
    for k in range(3):
        ball.push[k] += force[k]
        ball.wall_push[3 * s + k] += time * force[k]


@kernel
def _slip_at_wall(ball: Any, n: Vec) -> Vec:
    """Return the slip of a ball at a wall of normal n."""
    v, a, w = ball.cv, ball.radius, ball.cw
    turn = cross((a * w[0], a * w[1], a * w[2]), n)
    return across((v[0] - turn[0], v[1] - turn[1], v[2] - turn[2]), n)


@kernel
def rub_wall(features: Any, ball: Any, s: int, h: float, last: bool) -> None:
    """Add the change of the impulse of friction of wall s at the end of a step h."""
    if not rubbed(ball.wall_rub, s):
        return
    n = _normal(ball, s)
    t = _slip_at_wall(ball, n)
    mt = ball.mass / (ball.parts * (1 + 1 / ball.kappa))
    mean, mu = mean_slip(ball.wall_rub, s, t), _mu(features[wall_of(ball, s)])
    f = friction_of_step(ball.wall_rub, s, n, t, mean, mt, mu, h, last)
    twist = cross(n, f)
    for k in range(3):
        ball.twist[k] += twist[k]
    _give(ball, s, f, 1.0, _is_borne(ball, n))


@kernel
def closing_rate(ball: Any, s: int) -> float:
    """Return the speed at which a ball approaches wall s, if it touches it and has touched it before; else 0."""
    n = _normal(ball, s)
    rate = -dot(vector(ball.cv), n)
    touches = dot(vector(ball.cx), n) <= ball.wall_at[s] + SLACK * ball.radius
    if not has_hit(ball, s) or not touches or not rate > 0 or (ball.rests != 0 and n[2] < 0):
        return 0 * rate
    return rate


@kernel
def settle_wall(ball: Any, s: int, share: float) -> float:
    """Take a share of the speed at which a ball still approaches wall s, which it touches, to its change; return that speed."""
    n, rate = _normal(ball, s), closing_rate(ball, s)
    c = share * rate * ball.mass
    for k in range(3):
        ball.push[k] += c * n[k]
    return rate


@kernel
def loses_nothing_at_walls(features: Any, ball: Any) -> bool:
    """Return whether no wall that a ball has touched takes energy."""
    for s in range(ball.walls):
        f = features[wall_of(ball, s)]
        if has_hit(ball, s) and not (f.form == CONSTANT and f.e[0] == 1 and _mu(f) == 0):
            return False
    return True


@kernel
def share_momentum(balls: Any, count: int) -> None:
    """Give the walls the rest of the momentum that the balls have gained: the error of the steps, and what has been corrected."""
    hits = 0.0
    x, y, z = 0.0, 0.0, 0.0
    for p in range(count):
        ball = balls[balls[p].touched]
        m, v, u = ball.mass, ball.cv, ball.dv
        x, y, z = x + m * (v[0] - u[0]), y + m * (v[1] - u[1]), z + m * (v[2] - u[2])
        for s in range(ball.walls):
            if has_hit(ball, s):
                j = wall_impulse(ball, s)
                hits += 1.0
                x, y, z = x - j[0], y - j[1], z - j[2]
    for p in range(count):
        ball = balls[balls[p].touched]
        for s in range(ball.walls):
            if has_hit(ball, s):
                rest = (x / hits, y / hits, z / hits)
                for c in range(3):
                    ball.wall_push[3 * s + c] += rest[c]


# ----------------------------------------------------------------------------------------------------
# The integration of contacts that overlap in time: forces of balls and walls, in small steps, until all contacts have opened.


STEPS, LADDER = 20, 0.875  # steps in a contact's duration, at least; the ratio of one possible step to the next
LEAST_DEPTH = 1e-7  # of the radii: balls that overlap by less, as by the digits of a file, touch
LEAST_SPEED = 1e-9  # of the largest in the cluster: a slower contact does not count
SWEEPS = 3
RETURNS = 1e-3  # of that speed: slower balls do not come back
# In durations of a contact: balls that touch again so soon are followed; the longest that all are, and four more for each of them
AHEAD, MOST = 5, 40
AHEAD_AT_WALL = 3  # in durations of a wall's contact: a ball that is sent back by it is followed so long
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
    if ball.coupled & SPRINGS != 0:
        ball.coupled |= 1
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
        if begins(one.work, slot):
            write_slip(one.work, slot, _slip(one, other, n))
        g = friction_before(one.work, slot, share, push)
        f = (f[0] + g[0], f[1] + g[1], f[2] + g[2])
        twist = cross(n, g)
        add(one.twist, twist, 1)
        add(other.twist, twist, 1)
    add(one.push, f, 1)
    add(other.push, f, -1)
    return touched, True


@kernel
def _slip(one: Any, other: Any, n: Vec) -> Vec:
    """Return the slip of a ball on another one, along whose line of centres n is."""
    v, v2, w, w2, a, a2 = one.cv, other.cv, one.cw, other.cw, one.radius, other.radius
    s = cross((a * w[0] + a2 * w2[0], a * w[1] + a2 * w2[1], a * w[2] + a2 * w2[2]), n)
    return across((v[0] - v2[0] - s[0], v[1] - v2[1] - s[1], v[2] - v2[2] - s[2]), n)


@kernel
def _rub(world: Any, one: Any, other: Any, slot: int, h: float, last: bool) -> None:
    """Add the changes of the impulse of friction between two balls at the end of a step h."""
    if not rubbed(one.work, slot):
        return
    r = apart(other, one)
    far = math.sqrt(dot(r, r))
    n = (r[0] / far, r[1] / far, r[2] / far)
    t = _slip(one, other, n)
    mean = mean_slip(one.work, slot, t)
    mt = 1 / (one.parts * (1 + 1 / one.kappa) / one.mass + other.parts * (1 + 1 / other.kappa) / other.mass)
    mu = friction_at_slip(world.pair_mu, world.pair_drop, world.pair_rate, math.sqrt(dot(mean, mean)))
    f = friction_of_step(one.work, slot, n, t, mean, mt, mu, h, last)
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
def _until_contact(balls: Any, count: int, lasts: float, ahead: float, slow: float) -> float:
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
            goes_on = goes_on or (one.met != NO_BALL and rate > slow and time <= ahead)
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
                    known, unknown = one.met != NO_BALL, other.met != NO_BALL
                    if (known and unknown) or one.hits != 0 or other.hits != 0:
                        goes_on = goes_on or (c > slow and time <= ahead)
                    elif known or unknown:
                        goes_on = goes_on or (c > slow and time <= lasts)
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
def follow(world: Any, features: Any, balls: Any, count: int, i: int, alone: bool) -> tuple[int, float, float, bool]:
    """Integrate the contacts of members until all have opened; return how many balls were touched, the largest speed, the time, and
    whether others were touched only after the first two had parted.

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
            write_friction(one.work, s, none)
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
    ahead, waits, later = max(AHEAD_AT_WALL * longest, AHEAD * STEPS * h), 0 * h, False
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
            wait = _until_contact(balls, count, STEPS * h, ahead, RETURNS * fastest)
            if wait < math.inf:
                on = True
                open_for += wait
                waits += wait
                later = later or touched <= 2
                _move(balls, count, wait)
    clear = _until_clear(balls, count, open_for, STEPS * h)
    _move(balls, count, clear)
    return touched, fastest, lasts + waits + clear, later


# ----------------------------------------------------------------------------------------------------
# Coulomb's friction of contacts that overlap in time.
#
# A slip that has ended stays 0 as long as less than the most of friction does that. So the friction of each contact is carried
# from step to step: in a step it is that of the step before, and at its end the impulse is changed by what ends the slip that
# is left, to at most the coefficient of friction times the normal impulse in the step. A force in proportion to the slip would
# lag behind.
#
# Where less than the slip ends, friction is along the slip of mid-step (the implicit midpoint rule): of second
# order.
#
# Eight numbers a contact are kept in a slot: the friction; of the step the mean normal force, the time in which it acted, and the
# slip with which it began.


WIDTH = 8  # of a slot
SLOTS = 12  # of a ball, for those near it that have a lower number: so many of its size can touch it


@kernel
def across(u: Vec, n: Vec) -> Vec:
    """Return the part of a velocity along the plane of normal n."""
    un = dot(u, n)
    return (u[0] - un * n[0], u[1] - un * n[1], u[2] - un * n[2])


@kernel
def friction_before(rub: Any, slot: int, share: float, push: float) -> Vec:
    """Return the friction of the step before, and note that the contact pushes in a share of this one; none beyond the slots."""
    if slot >= SLOTS:
        return (0 * push, 0 * push, 0 * push)
    at = WIDTH * slot
    rub[at + 3] += share * push
    rub[at + 4] += share
    return (rub[at], rub[at + 1], rub[at + 2])


@kernel
def begins(rub: Any, slot: int) -> bool:
    """Return whether a contact has not pushed in this step yet: its slip is to be noted (:func:`write_slip`)."""
    return bool(slot < SLOTS and rub[WIDTH * slot + 4] == 0)


@kernel
def write_slip(rub: Any, slot: int, t: Vec) -> None:
    """Note the slip with which a contact begins a step."""
    at = WIDTH * slot + 5
    rub[at], rub[at + 1], rub[at + 2] = t


@kernel
def mean_slip(rub: Any, slot: int, t: Vec) -> Vec:
    """Return the mean of the slip with which a contact began a step, and of t, that at the end."""
    at = WIDTH * slot + 5
    return ((rub[at] + t[0]) / 2, (rub[at + 1] + t[1]) / 2, (rub[at + 2] + t[2]) / 2)


@kernel
def rubbed(rub: Any, slot: int) -> bool:
    """Return whether a contact has pushed in this step, or in the one before."""
    at = WIDTH * slot
    return bool(slot < SLOTS and (rub[at + 4] != 0 or rub[at] != 0 or rub[at + 1] != 0 or rub[at + 2] != 0))


@kernel
def write_friction(rub: Any, slot: int, f: Vec) -> None:
    """Keep a contact's friction for the next step."""
    at = WIDTH * slot
    rub[at], rub[at + 1], rub[at + 2] = f
    rub[at + 3] = rub[at + 4] = 0.0


@kernel
def friction_of_step(
    rub: Any, slot: int, n: Vec, t: Vec, mean: Vec, mt: float, mu: float, h: float, last: bool
) -> Vec:  # fmt: skip
    """Return the impulse that friction lacks at the end of a step h, where a slip t is left; keep the friction for the next one.

    mean: the slip of mid-step; mt: the mass that the slip has.
    """
    at = WIDTH * slot
    part = rub[at + 4]
    push = rub[at + 3]
    most = mu * push if push > 0 else 0 * push
    old = (rub[at], rub[at + 1], rub[at + 2])
    g = across(old, n)
    c = mt / h
    f = (part * g[0] - c * t[0], part * g[1] - c * t[1], part * g[2] - c * t[2])
    if not dot(f, f) <= most * most:
        # f with the slip of mid-step after it, (mean + (f - part g) / 2 c), along -f
        f = (part * g[0] - 2 * c * mean[0], part * g[1] - 2 * c * mean[1], part * g[2] - 2 * c * mean[2])
        square = dot(f, f)
        less = most / math.sqrt(square) if square > 0 else 0 * most
        f = (less * f[0], less * f[1], less * f[2])
    write_friction(rub, slot, f)
    if not last:
        rub[at + 3], rub[at + 4] = push, 1.0
    return (h * (f[0] - part * old[0]), h * (f[1] - part * old[1]), h * (f[2] - part * old[2]))
