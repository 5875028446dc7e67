"""Walls and thermostat: when a ball reaches a wall, what that does, and the thermostat's kicks.

All walls but one have one mechanism: a gap that is a polynomial of time, of degree 2 for a plane or where no force acts across a
round wall, of degree 4 where one does. Arcs of smooth curves have their own (:mod:`carom.core.geometry.curve_arcs`). Each cell has
a set of the walls that a ball in it can touch; for most cells it is empty, and a block of those, the interior of the grid, skips
the walls altogether.

What only round, oscillating or heated walls, growing balls and a thermostat need is compiled only for a gas that has some of them:
it takes as long as all the rest. ``features`` says so: None where all walls are fixed planes, else :class:`.records.Features`.
"""

from __future__ import annotations

import math
from typing import Any

from carom.core.contact import contact, friction_at_slip, one_contact, slip_velocity
from carom.core.geometry.curve_arcs import arc_contact, arc_hit
from carom.core.jit.kernel import Vec, cross, dot, hot_kernel, kernel
from carom.core.random import exponential, normals, uniform
from carom.core.roots import hit2, hit4, next_hit4
from carom.gas.edmd.averages import note_change
from carom.gas.edmd.calendar import I64, U64
from carom.gas.edmd.collisions import (
    add_energies,
    count_if_feeble,
    restitution_of,
    set_velocity,
    squared_length,
    with_flow,
)
from carom.gas.edmd.gas_records import CURVE, OUTSIDE, PLANE

MAX_ARCS = 16  # of an oscillating wall that are searched at once
LEAST_STEP = 4e-16  # of a time, by which it grows when it is added, whatever rounding does


@kernel
def oscillation(face: Any, now: float) -> tuple[float, float, float, float]:
    """Return an oscillating plane's position along its normal, as a parabola of the time from now, and how long it holds."""
    k = math.floor((now - face.start) / face.half_period)
    t = (now - face.start) - k * face.half_period
    if face.half_period - t <= LEAST_STEP * now:
        # rounding hides the rest of this parabola: without the next one, time would stand still
        k, t = k + 1, t - face.half_period
    c = 4.0 * face.amplitude / (face.half_period * face.half_period)
    if k % 2.0 != 0.0:
        c = -c
    return c * t * (face.half_period - t), c * (face.half_period - 2.0 * t), -c, face.half_period - t


@kernel
def oscillating_collision_time(
    face: Any, c: tuple[float, ...], now: float, most: float, slow: float
) -> tuple[float, bool]:
    """Return when a gap c to an oscillating plane closes, and True; or a time until which it does not, and False."""
    c0, c1, c2 = c[0], c[1], c[2]
    s = 0.0
    if c0 > face.amplitude:
        # nothing can happen before the ball comes within the amplitude
        s = hit2(c0 - face.amplitude, c1, c2, most, 0.0)
        if s == math.inf:
            return s, True
    for _ in range(MAX_ARCS):
        d0, d1, d2, left = oscillation(face, now + s)
        t = hit2(c0 + (c1 + c2 * s) * s - d0, c1 + 2.0 * c2 * s - d1, c2 - d2, left, slow)
        if t <= left:
            return s + t, True
        s += left
        if s > most:
            return math.inf, True
    return s, False


@kernel
def place(face: Any, now: float) -> tuple[float, float, float]:
    """Return a piston's displacement along its normal, its speed, and half its acceleration."""
    t, h = now - face.since, face.pull / 2.0
    return face.offset + (face.speed + h * t) * t, face.speed + face.pull * t, h


@kernel
def piston_impact(
    system: Any, face: Any, record: Any, form: Any, body: Any, one: Any, n: Vec, v0: Vec, w0: Vec, now: float
) -> tuple[Vec, Vec, float]:
    """Return velocity, spin and normal impulse per mass of a ball after a contact with a piston, whose speed it changes."""
    arm = abs(record.radius_part)  # (walls that bound centres touch the centre of the ball)
    offset, speed, _half = place(face, now)
    un, ut = slip_velocity((v0[0] - speed * n[0], v0[1] - speed * n[1], v0[2] - speed * n[2]), w0, n, arm)
    e, mu = restitution_of(system, record.e, form, -un), record.mu
    if form.drop > 0.0:
        mu = friction_at_slip(mu, form.drop, form.rate, math.sqrt(squared_length(ut)))
    if system.contact_time > 0.0:
        if now - body.last_contact < system.contact_time:
            e = 1.0
        body.last_contact = now
    m, moment = one.mass, one.kappa * one.radius * one.radius
    along, across = 1.0 + m / face.mass, 1.0 + arm * arm / moment
    pn, f, _required, _regime = contact(un, ut, 1.0 / along, 1.0 / across, e, mu, record.beta)
    j = (pn * n[0] + f[0], pn * n[1] + f[1], pn * n[2] + f[2])
    v = (v0[0] + j[0], v0[1] + j[1], v0[2] + j[2])
    turn, c = cross(n, f), arm / moment
    w = (w0[0] - c * turn[0], w0[1] - c * turn[1], w0[2] - c * turn[2])
    half = m / 2.0
    moved = half * (j[0] * (v0[0] + v[0]) + j[1] * (v0[1] + v[1]) + j[2] * (v0[2] + v[2]))
    turned = half * moment * (squared_length(w) - squared_length(w0))
    # the reaction on the piston, which begins a new flight, and what its energy gains
    change = -m * pn / face.mass
    face.offset, face.speed, face.since = offset, speed + change, now
    given = face.mass * change * (speed + change / 2.0)
    face.energy -= given
    add_energies(record, half * (e - 1.0) * pn * un, moved + given, turned)
    return v, w, pn


# What a plan's ``boundary`` may be: a face of the cell (below FIRST_WALL), FIRST_WALL + a wall, or a new prediction only.
FIRST_WALL, PREDICT_AGAIN = 6, 0xFFFF
# An approach slower than this share of the speed is the rounding of a ball that moves along a wall, and no collision. A ball
# released from a wall by the TC model leaves at least at the second share.
APPROACH_ROUNDING, LEAST_RELEASE = 1e-14, 1e-9


@kernel
def _gap_polynomial(
    features: Any, face: Any, contact: Any, gravity: Any, ball: Any, scale: float, growth: float
) -> tuple[float, ...]:
    """Return the gap as a polynomial of the time since the ball's last event, when all radii are multiplied by ``scale``."""
    d, dd = contact.distance + contact.radius_part * (scale - 1.0), contact.radius_part * growth
    rx, ry, rz = ball.x - face.mx, ball.y - face.my, ball.z - face.mz
    qx, qy, qz = face.nx, face.ny, face.nz
    vx, vy, vz = ball.vx, ball.vy, ball.vz
    gx, gy, gz = gravity[U64(0)], gravity[U64(1)], gravity[U64(2)]
    speed, pull = qx * vx + qy * vy + qz * vz, qx * gx + qy * gy + qz * gz
    flat = (qx * rx + qy * ry + qz * rz - d, speed - dd, pull / 2.0, 0.0, 0.0)
    if features is None:
        return flat
    if face.form == PLANE:
        return flat
    rx, ry, rz, vx, vy, vz = qx * rx, qy * ry, qz * rz, qx * vx, qy * vy, qz * vz
    gx, gy, gz = qx * gx, qy * gy, qz * gz
    r = math.sqrt(rx * rx + ry * ry + rz * rz)
    sign = 1.0 if face.form == OUTSIDE else -1.0
    return (
        sign * (r - d) * (r + d),
        sign * 2.0 * (rx * vx + ry * vy + rz * vz - d * dd),
        sign * (vx * vx + vy * vy + vz * vz + rx * gx + ry * gy + rz * gz - dd * dd),
        sign * (vx * gx + vy * gy + vz * gz),
        sign * (gx * gx + gy * gy + gz * gz) / 4.0,
    )


@kernel
def _is_present(face: Any, gravity: Any, ball: Any, s: float) -> bool:
    """Return whether a bounded face exists where the ball is at a time s after its last event."""
    h = s / 2.0
    x = ball.x + (ball.vx + gravity[U64(0)] * h) * s
    y = ball.y + (ball.vy + gravity[U64(1)] * h) * s
    z = ball.z + (ball.vz + gravity[U64(2)] * h) * s
    along = face.ax * x + face.ay * y + face.az * z
    return bool(face.low <= along <= face.high)


@kernel
def _curve_collision_time(
    curves: Any, face: Any, contact: Any, gravity: Any, ball: Any, scale: float, growth: float, most: float, slow: float
) -> float:  # fmt: skip
    """Return when a ball reaches an arc of a smooth curve. ``curves`` is None where the gas has none."""
    if curves is None:
        return math.inf
    return arc_hit(
        curves, I64(face.depth), contact.distance + contact.radius_part * (scale - 1.0), contact.radius_part * growth,
        ball.x - face.mx, ball.y - face.my, ball.vx, ball.vy, gravity[U64(0)], gravity[U64(1)], most, slow,
    )  # fmt: skip


@kernel
def _curve_normal(curves: Any, face: Any, ball: Any) -> Vec:
    """Return the normal of an arc at a ball in touch with it."""
    if curves is None:
        return (1.0, 0.0, 0.0)
    found = arc_contact(curves, I64(face.depth), ball.x - face.mx, ball.y - face.my)
    return (found[0], found[1], 0.0)


@kernel
def _curve_pressing(curves: Any, face: Any, gravity: Any, ball: Any) -> float:
    """Return the acceleration of a ball towards an arc: by gravity, and by its motion along the curve."""
    if curves is None:
        return 0.0
    nx, ny, kappa, depth = arc_contact(curves, I64(face.depth), ball.x - face.mx, ball.y - face.my)
    along = ball.vx * ny - ball.vy * nx
    return along * along * (kappa / max(1.0 - kappa * depth, 1e-9)) - (  # type: ignore[no-any-return]
        nx * gravity[U64(0)] + ny * gravity[U64(1)]
    )


@kernel
def wall_collision_time(
    features: Any,
    face: Any,
    contact: Any,
    gravity: Any,
    ball: Any,
    scale: float,
    growth: float,
    now: float,
    most: float,
) -> Any:
    """Return the time from now until a ball at its position of now reaches a face, at most ``most`` (else infinity), and True.

    Or a time until which it does not, and False: the collision has to be predicted again then.
    """
    slow = APPROACH_ROUNDING * math.sqrt(squared_length((ball.vx, ball.vy, ball.vz)))
    if features is not None and face.form == CURVE:
        return _curve_collision_time(features.curve, face, contact, gravity, ball, scale, growth, most, slow), True
    c = _gap_polynomial(features, face, contact, gravity, ball, scale, growth)
    if features is None:
        return hit2(c[0], c[1], c[2], most, slow), True
    if face.form != PLANE:
        # (|q| is at most this on a round wall, and the gap's units are a distance times twice |q (x - m)|)
        slow = 2.0 * slow * max(face.nx, face.ny, face.nz) * (contact.distance + abs(contact.radius_part))
    if face.amplitude != 0.0:
        return oscillating_collision_time(face, c, now, most, slow)
    if face.mass > 0.0:
        d0, d1, d2 = place(face, now)
        return hit2(c[0] - d0, c[1] - d1, c[2] - d2, most, slow), True
    if face.bounded != 0 and face.form == PLANE and c[0] < -(face.depth + contact.radius_part * scale):
        # the ball is behind it, in another part of the container, and can touch it only after coming to the front
        s = next_hit4(c[0], c[1], c[2], 0.0, 0.0, 0.0, most) if c[1] > 0.0 and c[2] < 0.0 else math.inf
    else:
        s = hit4(c[0], c[1], c[2], c[3], c[4], most, slow)
    if face.bounded != 0:
        while s < math.inf and not _is_present(face, gravity, ball, s):
            s = next_hit4(c[0], c[1], c[2], c[3], c[4], s, most)
    return s, True


@kernel
def next_wall_collision(
    features: Any,
    system: Any,
    gravity: Any,
    walls: Any,
    ball: Any,
    plan: Any,
    now: float,
    crossing: float,
    boundary: int,
) -> tuple[float, int]:
    """Return the earliest of a ball's cell crossing and its collisions with the walls of its cell: time and ``boundary``."""
    cell = (plan.cz * system.cells[1] + plan.cy) * system.cells[0] + plan.cx
    first = I64(walls.cell_sets[U64(cell)])
    scale = system.scale + system.growth * now
    s = crossing - now
    for k in range(1, I64(walls.sets[U64(first)]) + 1):
        w = I64(walls.sets[U64(first + k)])
        contact = walls.contacts[U64(w * system.species + I64(ball.species))]
        t, collides = wall_collision_time(
            features, walls.faces[U64(w)], contact, gravity, ball, scale, system.growth, now, s
        )
        if t < s:
            s, boundary = t, (FIRST_WALL + w if collides else PREDICT_AGAIN)
    return now + s if boundary >= FIRST_WALL else crossing, boundary


@kernel
def _normal(features: Any, face: Any, ball: Any) -> Vec:
    """Return the normal of a wall where a ball touches it, towards the ball."""
    if face.form == PLANE:
        return (face.nx, face.ny, face.nz)
    if face.form == CURVE:
        return _curve_normal(features.curve, face, ball)
    # (the gradient of the gap: q twice)
    x, y, z = (
        face.nx * face.nx * (ball.x - face.mx),
        face.ny * face.ny * (ball.y - face.my),
        face.nz * face.nz * (ball.z - face.mz),
    )
    r = math.sqrt(x * x + y * y + z * z)
    if face.form != OUTSIDE:
        r = -r
    return (x / r, y / r, z / r)


@kernel
def _draw_maxwellian(system: Any, flat: bool, body: Any, one: Any, temperature: float, spin_temperature: float) -> Vec:
    """Draw a Maxwellian velocity, and set the ball's spin to a Maxwellian one. ``one``: the ball's species."""
    x = y = z = p = q = r = 0.0
    for _ in range(3):
        x, y, z, p = z, p, q, r
        q, r, system.drawn = normals(system.key[0], system.key[1], system.drawn)
    speed = math.sqrt(temperature / one.mass)
    spin = math.sqrt(spin_temperature / (one.kappa * one.mass * one.radius * one.radius))
    if flat:
        body.wz = spin * r
        return (speed * x, speed * y, 0.0)
    body.wx, body.wy, body.wz = spin * p, spin * q, spin * r
    return (speed * x, speed * y, speed * z)


@kernel
def _leave_heated_wall(system: Any, face: Any, body: Any, one: Any, n: Vec, v0: Vec, w0: Vec) -> tuple[Vec, Vec, float]:
    """Return velocity, spin and normal impulse per mass of a ball that leaves a heated wall: Maxwellian, weighted by v_n."""
    v = _draw_maxwellian(system, system.dimensions == 2, body, one, face.temperature, face.spin_temperature)
    vn = math.sqrt(2.0 * face.temperature / one.mass * exponential(system.key[0], system.key[1], system.drawn))
    system.drawn += 1
    c = vn - dot(v, n)
    v, spin = (v[0] + c * n[0], v[1] + c * n[1], v[2] + c * n[2]), (body.wx, body.wy, body.wz)
    moment = one.kappa * one.radius * one.radius
    face.energy += (
        one.mass / 2.0 * (squared_length(v) - squared_length(v0) + moment * (squared_length(spin) - squared_length(w0)))
    )
    return v, spin, dot(v, n) - dot(v0, n)


@kernel
def _release_speed(
    features: Any, face: Any, contact: Any, gravity: Any, ball: Any, n: Vec, contact_time: float
) -> float:
    """Return the speed at which a ball pressed on a wall, by a force or its curvature, returns after the contact time."""
    if features is not None and face.form == CURVE:
        return max(_curve_pressing(features.curve, face, gravity, ball), 0.0) * contact_time / 2.0
    c = _gap_polynomial(features, face, contact, gravity, ball, 1.0, 0.0)
    press = -2.0 * c[2]
    if features is None:
        return max(press, 0.0) * contact_time / 2.0
    if face.form != PLANE:
        # from the gap's units to those of a distance: by its gradient
        x, y, z = face.nx * (ball.x - face.mx), face.ny * (ball.y - face.my), face.nz * (ball.z - face.mz)
        press = press / (2.0 * abs(face.nx * x * n[0] + face.ny * y * n[1] + face.nz * z * n[2]))
    return max(press, 0.0) * contact_time / 2.0


@kernel
def _wall_impact(
    features: Any, system: Any, gravity: Any, face: Any, contact: Any, form: Any, ball: Any, body: Any, one: Any, n: Vec, v0: Vec,
    w0: Vec, now: float,
) -> tuple[Vec, Vec, float]:  # fmt: skip
    """Return velocity, spin and normal impulse per mass of a ball after a contact, in the frame of the wall."""
    e, least, mu = restitution_of(system, contact.e, form, -dot(v0, n)), 0.0, contact.mu
    if form.drop > 0.0:
        slip = slip_velocity(v0, w0, n, one.radius)[1]
        mu = friction_at_slip(mu, form.drop, form.rate, math.sqrt(squared_length(slip)))
    if system.contact_time > 0.0:
        if now - body.last_contact < system.contact_time:
            e, least = 1.0, _release_speed(features, face, contact, gravity, ball, n, system.contact_time)
            least += LEAST_RELEASE * math.sqrt(squared_length(v0))
        body.last_contact = now
    elif e < 1.0:
        count_if_feeble(system, body, now, e, -dot(v0, n), one.radius)
    v, spin, j, _required, _regime = one_contact(v0, w0, n, one.radius, one.kappa, e, mu, contact.beta)
    un, pn, half = dot(v0, n), dot(j, n), one.mass / 2.0
    translational = half * (j[0] * (v0[0] + v[0]) + j[1] * (v0[1] + v[1]) + j[2] * (v0[2] + v[2]))
    rotational = half * one.kappa * one.radius * one.radius * (squared_length(spin) - squared_length(w0))
    add_energies(contact, half * (e - 1.0) * pn * un, translational, rotational)
    if un + pn < least:
        lift = least - (un + pn)
        v = (v[0] + lift * n[0], v[1] + lift * n[1], v[2] + lift * n[2])
        face.energy += half * lift * (least + un + pn)
        pn += lift
    return v, spin, pn


@hot_kernel
def _set_motion(
    averages: Any, grid: Any, ball: Any, body: Any, plan: Any, one: Any, v: Vec, w: Vec, v0: Vec, w0: Vec, now: float
) -> None:
    """Give a ball, which had v0 and w0, a velocity and a spin; note the jumps for means over time."""
    set_velocity(ball, v)
    body.wx, body.wy, body.wz = w[0], w[1], w[2]
    m = one.mass
    j = (m * (v[0] - v0[0]), m * (v[1] - v0[1]), m * (v[2] - v0[2]))
    s = ((v[0] + v0[0]) / 2.0, (v[1] + v0[1]) / 2.0, (v[2] + v0[2]) / 2.0)
    spin = one.kappa * m * one.radius * one.radius * (squared_length(w) - squared_length(w0))
    note_change(averages, grid, plan, I64(ball.species), j, s, spin, now)


@kernel
def collide_wall(
    features: Any, system: Any, grid: Any, walls: Any, averages: Any, species: Any, ball: Any, body: Any, plan: Any, w: int,
    now: float,
) -> None:  # fmt: skip
    """Collide a ball with face ``w``."""
    face, one, gravity = walls.faces[U64(w)], species[U64(ball.species)], grid.gravity
    contact = walls.contacts[U64(w * system.species + I64(ball.species))]
    form = walls.contact_forms[U64(w * system.species + I64(ball.species))]
    v0, w0 = (ball.vx, ball.vy, ball.vz), (body.wx, body.wy, body.wz)
    before = v0
    if features is None:
        n = (face.nx, face.ny, face.nz)
        v, spin, pn = _wall_impact(features, system, gravity, face, contact, form, ball, body, one, n, v0, w0, now)
    else:
        n = _normal(features, face, ball)
        if face.mass > 0.0:
            v, spin, pn = piston_impact(system, face, contact, form, body, one, n, v0, w0, now)
            _note_collision(system, grid, averages, face, ball, body, plan, one, v, spin, before, w0, pn, now)
            return
        # the surface drags the ball along
        speed, u = 0.0, (face.ux, face.uy, face.uz)
        if face.is_belt != 0:
            v0 = (v0[0] - u[0], v0[1] - u[1], v0[2] - u[2])
        if face.amplitude != 0.0:
            speed = oscillation(face, now)[1]
        if system.growth != 0.0:
            # the surface of a growing ball approaches the wall by itself
            speed = abs(contact.radius_part) * system.growth
        v0 = (v0[0] - speed * n[0], v0[1] - speed * n[1], v0[2] - speed * n[2])
        if face.temperature >= 0.0:
            v, spin, pn = _leave_heated_wall(system, face, body, one, n, v0, w0)
            contact.collisions += 1  # (what it gives or takes is the wall's energy)
        else:
            v, spin, pn = _wall_impact(features, system, gravity, face, contact, form, ball, body, one, n, v0, w0, now)
        v = (v[0] + speed * n[0], v[1] + speed * n[1], v[2] + speed * n[2])
        face.energy += one.mass * pn * speed
        if face.is_belt != 0:
            v = (v[0] + u[0], v[1] + u[1], v[2] + u[2])
            face.energy += one.mass * dot(u, (v[0] - before[0], v[1] - before[1], v[2] - before[2]))
    _note_collision(system, grid, averages, face, ball, body, plan, one, v, spin, before, w0, pn, now)


@kernel
def _note_collision(
    system: Any, grid: Any, averages: Any, face: Any, ball: Any, body: Any, plan: Any, one: Any, v: Vec, spin: Vec, v0: Vec,
    w0: Vec, pn: float, now: float,
) -> None:  # fmt: skip
    """Give a ball its velocity and spin after a contact with a face, and count the contact."""
    _set_motion(averages, grid, ball, body, plan, one, v, spin, v0, w0, now)
    face.impulse += one.mass * pn
    face.collisions += 1
    system.wall_collisions += 1
    ball.collisions += 1


@kernel
def next_kick_time(features: Any, system: Any, now: float) -> float:
    """Draw the time of the next kick: the wait of a Poisson process after now."""
    if features is None:
        return math.inf
    if system.rate == 0.0:
        return math.inf
    system.drawn += 1
    return now + exponential(system.key[0], system.key[1], system.drawn - 1) / system.rate  # type: ignore[no-any-return]


@kernel
def draw_ball(system: Any) -> int:
    """Draw a ball, uniformly."""
    system.drawn += 1
    n = I64(uniform(system.key[0], system.key[1], system.drawn - 1) * system.balls)
    return min(n, system.balls - 1)  # type: ignore[no-any-return]


@kernel
def thermostat_kick(
    features: Any, system: Any, grid: Any, averages: Any, species: Any, ball: Any, body: Any, plan: Any, now: float
) -> None:
    """Give a ball a new Maxwellian velocity and spin (Andersen's thermostat)."""
    one, v0, w0 = species[U64(ball.species)], (ball.vx, ball.vy, ball.vz), (body.wx, body.wy, body.wz)
    moment = one.kappa * one.radius * one.radius
    before = squared_length(v0) + moment * squared_length(w0)
    v = _draw_maxwellian(system, system.dimensions == 2, body, one, system.temperature, system.spin_temperature)
    if features is not None:
        v = with_flow(features.shear, grid, ball.y, v)
    _set_motion(averages, grid, ball, body, plan, one, v, (body.wx, body.wy, body.wz), v0, w0, now)
    system.thermostat_energy += (
        one.mass / 2.0 * (squared_length(v) + moment * squared_length((body.wx, body.wy, body.wz)) - before)
    )
    system.kicks += 1
    ball.collisions += 1
