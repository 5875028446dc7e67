"""Many balls: what a collision does. The one contact kernel, with the measures that it feeds."""

from __future__ import annotations

import math
from typing import Any

from carom.engine.queue import S, U
from carom.engine.swarm_arrays import PERIODIC
from carom.kernel import Vec, hot_kernel
from carom.laws.contact import contact
from carom.laws.pair import pair_contact

__all__ = ["book", "meet", "put_velocity", "square"]


@hot_kernel
def put_velocity(ball: Any, v: Vec) -> None:
    """Write a velocity."""
    ball.vx, ball.vy, ball.vz = v[0], v[1], v[2]


@hot_kernel
def _nearest(x: float, side: float, periodic: int) -> float:
    """A difference along an axis, of the nearest images if it is periodic."""
    if periodic == 0:
        return x
    if x > side / 2:
        return x - side
    return x + side if x < -side / 2 else x


@hot_kernel
def square(w: Vec) -> float:
    """The square of a vector."""
    return w[0] * w[0] + w[1] * w[1] + w[2] * w[2]


@hot_kernel
def book(channel: Any, normal: float, moved: float, spun: float) -> None:
    """A contact's energies: that lost along the normal, the change of the centres' and of the spins'."""
    channel.hits += 1
    channel.normal += normal
    channel.tangential -= moved + spun + normal
    channel.spun += spun


@hot_kernel
def meet(
    swarm: Any, box: Any, grid: Any, motions: Any, bodies: Any, species: Any, pairs: Any, i: int, j: int, now: float
) -> float:
    """Balls i and j touch: new velocities and spins; the impulse along the line of centres times their distance."""
    a, b = motions[U(i)], motions[U(j)]
    kind1, kind2 = S(a.kind), S(b.kind)
    pair = pairs[U(kind1 * swarm.kinds + kind2)]
    one, two = species[U(kind1)], species[U(kind2)]
    rx = _nearest(a.x - b.x, box[U(0)], grid[U(PERIODIC)])
    ry = _nearest(a.y - b.y, box[U(1)], grid[U(PERIODIC + 1)])
    rz = _nearest(a.z - b.z, box[U(2)], grid[U(PERIODIC + 2)])
    far = math.sqrt(rx * rx + ry * ry + rz * rz)
    n = (rx / far, ry / far, rz / far)
    e = pair.e
    if swarm.soft > 0:
        first, second = bodies[U(i)], bodies[U(j)]
        if now - max(first.met, second.met) < swarm.soft:
            e = 1.0
        first.met = second.met = now
    ux, uy, uz = a.vx - b.vx, a.vy - b.vy, a.vz - b.vz
    # (the surfaces of balls that grow come towards each other by themselves)
    un = ux * n[0] + uy * n[1] + uz * n[2] - pair.reach * swarm.growth
    if pair.smooth:
        m1, m2 = one.mass, two.mass
        pn, _f, _required, _regime = contact(un, (0.0, 0.0, 0.0), m1 * m2 / (m1 + m2), 1.0, e, 0.0, 0.0)
        c = pn / m1
        put_velocity(a, (a.vx + c * n[0], a.vy + c * n[1], a.vz + c * n[2]))
        c = pn / m2
        put_velocity(b, (b.vx - c * n[0], b.vy - c * n[1], b.vz - c * n[2]))
        pair.hits += 1
        pair.normal -= (1 - e) / 2 * pn * un
    else:
        first, second = bodies[U(i)], bodies[U(j)]
        v1, w1, v2, w2, p, _required, _regime = pair_contact(
            (a.vx, a.vy, a.vz), (first.wx, first.wy, first.wz), (b.vx, b.vy, b.vz), (second.wx, second.wy, second.wz), n,
            one.radius, one.mass, one.kappa, two.radius, two.mass, two.kappa, e, pair.mu, pair.beta,
        )  # fmt: skip
        pn = p[0] * n[0] + p[1] * n[1] + p[2] * n[2]
        # an impulse changes the energy of the centres by itself times the mean of the velocities before and after
        sx, sy, sz = ux + (v1[0] - v2[0]), uy + (v1[1] - v2[1]), uz + (v1[2] - v2[2])
        i1, i2 = one.kappa * one.mass * one.radius * one.radius, two.kappa * two.mass * two.radius * two.radius
        spun = i1 * (square(w1) - square((first.wx, first.wy, first.wz)))
        spun = (spun + i2 * (square(w2) - square((second.wx, second.wy, second.wz)))) / 2
        book(pair, (e - 1) / 2 * pn * un, (p[0] * sx + p[1] * sy + p[2] * sz) / 2, spun)
        put_velocity(a, v1)
        put_velocity(b, v2)
        first.wx, first.wy, first.wz = w1[0], w1[1], w1[2]
        second.wx, second.wy, second.wz = w2[0], w2[1], w2[2]
    reach = pair.reach * (swarm.scale + swarm.growth * now)
    swarm.overlap = max(swarm.overlap, (reach - far) / reach)
    a.count += 1
    b.count += 1
    return pn * far
