"""Many balls: what a collision does. The one contact kernel, with the measures that it feeds."""

from __future__ import annotations

import math
from typing import Any

from carom.engine.queue import S, U
from carom.engine.swarm_arrays import PERIODIC
from carom.kernel import Vec, hot_kernel, kernel
from carom.laws.contact import contact, one_contact
from carom.laws.pair import pair_contact

__all__ = ["meet", "meet_wall", "put_velocity"]


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
def _square(w: Vec) -> float:
    return w[0] * w[0] + w[1] * w[1] + w[2] * w[2]


@hot_kernel
def _book(channel: Any, normal: float, moved: float, spun: float) -> None:
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
    un = ux * n[0] + uy * n[1] + uz * n[2]
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
        spun = i1 * (_square(w1) - _square((first.wx, first.wy, first.wz)))
        spun = (spun + i2 * (_square(w2) - _square((second.wx, second.wy, second.wz)))) / 2
        _book(pair, (e - 1) / 2 * pn * un, (p[0] * sx + p[1] * sy + p[2] * sz) / 2, spun)
        put_velocity(a, v1)
        put_velocity(b, v2)
        first.wx, first.wy, first.wz = w1[0], w1[1], w1[2]
        second.wx, second.wy, second.wz = w2[0], w2[1], w2[2]
    swarm.overlap = max(swarm.overlap, (pair.reach - far) / pair.reach)
    a.count += 1
    b.count += 1
    return pn * far


@kernel
def meet_wall(swarm: Any, ball: Any, body: Any, one: Any, walls: Any, which: int, now: float) -> None:
    """A ball meets wall ``which`` (2 axis + (1: the upper one)) of the box."""
    wall = walls[which * swarm.kinds + S(ball.kind)]
    side = -1.0 if which & 1 else 1.0
    axis = which >> 1
    n = (side if axis == 0 else 0.0, side if axis == 1 else 0.0, side if axis == 2 else 0.0)
    e = wall.e
    if swarm.soft > 0:
        if now - body.met < swarm.soft:
            e = 1.0
        body.met = now
    v, w, j, _required, _regime = one_contact(
        (ball.vx, ball.vy, ball.vz), (body.wx, body.wy, body.wz), n, one.radius, one.kappa, e, wall.mu, wall.beta
    )
    pn, un = j[0] * n[0] + j[1] * n[1] + j[2] * n[2], ball.vx * n[0] + ball.vy * n[1] + ball.vz * n[2]
    moved = j[0] * (ball.vx + v[0]) + j[1] * (ball.vy + v[1]) + j[2] * (ball.vz + v[2])
    spun = one.kappa * one.radius * one.radius * (_square(w) - _square((body.wx, body.wy, body.wz)))
    half = one.mass / 2
    _book(wall, half * (e - 1) * pn * un, half * moved, half * spun)
    put_velocity(ball, v)
    body.wx, body.wy, body.wz = w[0], w[1], w[2]
    swarm.push[which] += one.mass * side * j[axis]
    swarm.wall_hits += 1
    ball.count += 1
