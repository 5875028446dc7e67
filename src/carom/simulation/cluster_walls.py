"""Walls in contacts that overlap in time: a ball between a ball and a wall, or between the jaws of a pocket.

In a cluster (carom.simulation.cluster) a wall pushes a ball of mass m as a linear spring with a dashpot, k = m (pi / T)^2, which
a ball alone touches for the wall's contact time T, whatever its speed: F = k d + 2 zeta sqrt(m k) d', never below 0. The
restitution is the same function of zeta as with Tsuji's damping of two balls (carom.laws.hertz), so that one polynomial serves
both; a restitution of the speed is read at the contact's own. Friction is Coulomb's. The wall is the plane that the ball would
touch, or touches, when the event begins. A ball that lies on the floor, and that a wall pushes down, is borne by the floor, where
wall and floor act at once.

Walls are springs in clusters only: a ball that meets one wall, and nothing else before that contact ends, has the law of the wall.
Walls of the laws no-slip and rolling are never springs: these laws are of bodies whose contacts take no time.
"""

from __future__ import annotations

import math
from typing import Any

from carom.core.geometry.features import FACE, OVER, contact_normal, gap_to_feature, is_out_of_reach
from carom.core.geometry.gaps import least_gap
from carom.core.jit.kernel import Vec, cross, dot, kernel, vector
from carom.core.motion.restitution import CONSTANT, restitution
from carom.laws.hertz import damping
from carom.laws.law import CONTACT_WALL, MIRROR_WALL, NO_SLIP_WALL, ROLLING_WALL, TWO_STEP_WALL
from carom.simulation.cluster_friction import across, friction_before, friction_of_step, rubbed
from carom.simulation.motion import accelerations_of, is_on_floor

__all__ = [
    "MOST_WALLS", "acts_in_time", "closing_rate", "find_walls", "has_friction", "has_hit", "is_lasting",
    "loses_nothing_at_walls", "push_of_wall", "rub_wall", "scales_of_wall", "settle_wall", "share_momentum", "until_wall",
    "wall_impulse", "wall_in_time", "wall_of", "walls_in_time",
]  # fmt: skip

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
        ball.coupled = 1
    force = (push * n[0], push * n[1], push * n[2])
    if _mu(f) > 0:
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
def rub_wall(features: Any, ball: Any, s: int, h: float, last: bool) -> None:
    """Add the change of the impulse of friction of wall s at the end of a step h."""
    if not rubbed(ball.wall_rub, s):
        return
    n, v, a, w = _normal(ball, s), ball.cv, ball.radius, ball.cw
    turn = cross((a * w[0], a * w[1], a * w[2]), n)
    t = across((v[0] - turn[0], v[1] - turn[1], v[2] - turn[2]), n)
    mt = ball.mass / (ball.parts * (1 + 1 / ball.kappa))
    f = friction_of_step(ball.wall_rub, s, n, t, mt, _mu(features[wall_of(ball, s)]), h, last)
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
