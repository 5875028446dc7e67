"""Walls that move, yield or turn: oscillating and sliding planes, pistons that the gas moves, scatterers that rotate.

A plane moves along its normal n: on parabolas where it oscillates, else by ``offset + speed t + pull t^2 / 2`` for a time t since
``since``, until ``stop``. A contact changes the motion of a piston, which has a mass M, and of a rotor, which has a moment of
inertia Theta and the radius R. It is that of :mod:`carom.core.contact` with the inverse masses that both sides have together:
along the normal 1/m + 1/M, along the tangent 1/m (1 + 1/kappa) + R^2/Theta.

Rotors: C. Mejia-Monasterio, H. Larralde & F. Leyvraz, Phys. Rev. Lett. 86, 5417 (2001), doi:10.1103/PhysRevLett.86.5417. Their
particles are points, without spins: walls that bound centres, restitution 1, friction inf, tangential restitution 1.
"""

from __future__ import annotations

import math
from typing import Any

from carom.core.contact import contact, friction_at_slip, slip_velocity
from carom.core.jit.kernel import Vec, cross, kernel
from carom.core.roots.first_root import hit2
from carom.gas.edmd.calendar import U64
from carom.gas.edmd.collisions import add_energies, restitution_of, squared_length

__all__ = [
    "heat_at", "is_yielding", "move_on", "moving_collision_time", "oscillating_collision_time", "oscillation", "place",
    "surface_velocity",
    "yielding_impact",
]  # fmt: skip

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
    """Return a moving plane's displacement along its normal, its speed, and half its acceleration."""
    t = min(now, face.stop) - face.since
    if now >= face.stop:
        return face.offset + face.speed * t, 0.0, 0.0
    h = face.pull / 2.0
    return face.offset + (face.speed + h * t) * t, face.speed + face.pull * t, h


@kernel
def moving_collision_time(face: Any, c: tuple[float, ...], now: float, most: float, slow: float) -> float:
    """Return when a gap c to a plane that moves steadily closes, at most ``most``; or infinity."""
    d0, d1, d2 = place(face, now)
    if now < face.stop:
        left = face.stop - now
        s = hit2(c[0] - d0, c[1] - d1, c[2] - d2, min(left, most), slow)
        if s <= min(left, most) or left > most:
            return s
        # the gap once it rests
        c0, c1 = c[0] + (c[1] + c[2] * left) * left, c[1] + 2.0 * c[2] * left
        rests: float = left + hit2(c0 - place(face, face.stop)[0], c1, c[2], most - left, slow)
        return rests
    return hit2(c[0] - d0, c[1], c[2], most, slow)


@kernel
def move_on(face: Any, now: float, change: float) -> None:
    """Begin a new flight of a piston, whose speed changes now."""
    offset, speed, _half = place(face, now)
    face.offset, face.speed = offset, speed + change
    face.since = now


@kernel
def is_yielding(faces: Any, face: Any) -> bool:
    """Return whether a contact changes the motion of a wall: of a piston, or of a rotor with a moment of inertia."""
    return face.mass > 0.0 or (face.rotor >= 0 and faces[U64(face.rotor)].moment > 0.0)  # type: ignore[no-any-return]


@kernel
def surface_velocity(faces: Any, face: Any, n: Vec, reach: float, now: float) -> Vec:
    """Return the velocity of a wall's surface where a ball touches it; ``reach``: the radius of a rotor."""
    u = (face.ux, face.uy, face.uz)
    if face.rotor >= 0:
        one = faces[U64(face.rotor)]
        w = cross((one.wx, one.wy, one.wz), n)
        return (u[0] + reach * w[0], u[1] + reach * w[1], u[2] + reach * w[2])
    speed = place(face, now)[1]
    return (u[0] + speed * n[0], u[1] + speed * n[1], u[2] + speed * n[2])


@kernel
def heat_at(face: Any, ball: Any) -> float:
    """Return the temperature of a heated wall where a ball touches it, relative to the one at the corner of the box."""
    return face.temperature + face.tx * ball.x + face.ty * ball.y + face.tz * ball.z  # type: ignore[no-any-return]


@kernel
def yielding_impact(
    system: Any, faces: Any, face: Any, record: Any, form: Any, body: Any, one: Any, n: Vec, v0: Vec, w0: Vec, now: float
) -> tuple[Vec, Vec, float]:  # fmt: skip
    """Return velocity, spin and normal impulse per mass of a ball after a contact with a piston or a rotor, which it changes."""
    arm = abs(record.radius_part)  # (walls that bound centres touch the centre of the ball)
    reach = record.distance - record.radius_part
    u = surface_velocity(faces, face, n, reach, now)
    un, ut = slip_velocity((v0[0] - u[0], v0[1] - u[1], v0[2] - u[2]), w0, n, arm)
    e, mu = restitution_of(system, record.e, form, -un), record.mu
    if form.drop > 0.0:
        mu = friction_at_slip(mu, form.drop, form.rate, math.sqrt(squared_length(ut)))
    if system.contact_time > 0.0:
        if now - body.last_contact < system.contact_time:
            e = 1.0
        body.last_contact = now
    m, moment = one.mass, one.kappa * one.radius * one.radius
    along, across, theta = 1.0, 1.0 + arm * arm / moment, 0.0
    if face.mass > 0.0:
        along += m / face.mass
    if face.rotor >= 0:
        theta = faces[U64(face.rotor)].moment
        across += m * reach * reach / theta
    pn, f, _required, _regime = contact(un, ut, 1.0 / along, 1.0 / across, e, mu, record.beta)
    j = (pn * n[0] + f[0], pn * n[1] + f[1], pn * n[2] + f[2])
    v = (v0[0] + j[0], v0[1] + j[1], v0[2] + j[2])
    turn = cross(n, f)
    c = arm / moment
    w = (w0[0] - c * turn[0], w0[1] - c * turn[1], w0[2] - c * turn[2])
    half = m / 2.0
    moved = half * (j[0] * (v0[0] + v[0]) + j[1] * (v0[1] + v[1]) + j[2] * (v0[2] + v[2]))
    turned = half * moment * (squared_length(w) - squared_length(w0))
    # the reaction on the wall, and what its energy gains
    given = 0.0
    if face.mass > 0.0:
        speed, change = place(face, now)[1], -m * pn / face.mass
        given = face.mass * change * (speed + change / 2.0)
        move_on(face, now, change)
    if face.rotor >= 0:
        rotor = faces[U64(face.rotor)]
        c = -m * reach / theta
        before = (rotor.wx, rotor.wy, rotor.wz)
        rotor.wx, rotor.wy, rotor.wz = before[0] + c * turn[0], before[1] + c * turn[1], before[2] + c * turn[2]
        given = theta / 2.0 * (squared_length((rotor.wx, rotor.wy, rotor.wz)) - squared_length(before))
    face.energy -= given
    add_energies(record, half * (e - 1.0) * pn * un, moved + given, turned)
    return v, w, pn
