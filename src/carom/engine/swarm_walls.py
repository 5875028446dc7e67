"""Many balls and what holds them: planes, swinging planes, round walls; when a ball reaches one, and what that does.

All walls but one are one mechanism: a gap that is a polynomial of time, of degree 2 before a plane or where nothing pulls across
a round wall, of degree 4 where something does; an ellipse that bounds surfaces has its own (:mod:`carom.engine.swarm_oval`). Each
cell has a list of the walls that a ball in it can touch; in most cells it is empty, and a block of those is left out altogether.
What only round walls, walls that swing or are warm, balls that grow and a thermostat need is compiled only for a gas that has some
of them (``more``): it takes as long as all the rest.
"""

from __future__ import annotations

import math
from typing import Any

from carom.engine.queue import S, U
from carom.engine.random import exponential, normals, uniform
from carom.engine.swarm_arrays import OUTSIDE, OVAL, PLANE, PULL
from carom.engine.swarm_oval import oval_depth, oval_hit
from carom.engine.swarm_resolve import book, put_velocity, square
from carom.kernel import Vec, dot, kernel
from carom.laws.contact import one_contact
from carom.motion.roots import hit2, hit4, next_hit4

__all__ = ["FIRST_WALL", "LOOK", "kick", "meet_wall", "next_wall", "wait_for_kick", "wall_hit", "whom_to_kick"]

# What a ball's ``turn`` may be: a face of its cell (below FIRST_WALL), a wall, or only that it has to look again.
FIRST_WALL, LOOK = 6, 0xFFFF
ARCS = 16  # of a swinging wall are looked through at once
# An approach slower than this share of the speed is none: it is the rounding of a ball that moves along a wall. And a ball
# that a wall sends off does not leave more slowly than this.
SLOW, HOP = 1e-14, 1e-9


@kernel
def _gap(more: Any, face: Any, wall: Any, box: Any, ball: Any, scale: float, growth: float) -> tuple[float, ...]:
    """The gap as a polynomial of the time from the ball's clock on, at which the radii are multiplied by scale."""
    d, dd = wall.keep + wall.thick * (scale - 1.0), wall.thick * growth
    rx, ry, rz = ball.x - face.mx, ball.y - face.my, ball.z - face.mz
    qx, qy, qz = face.nx, face.ny, face.nz
    vx, vy, vz = ball.vx, ball.vy, ball.vz
    gx, gy, gz = box[U(PULL)], box[U(PULL + 1)], box[U(PULL + 2)]
    flat = (
        qx * rx + qy * ry + qz * rz - d,
        qx * vx + qy * vy + qz * vz - dd,
        (qx * gx + qy * gy + qz * gz) / 2.0,
        0.0,
        0.0,
    )
    if more is None:
        return flat
    if face.form == PLANE:
        return flat
    rx, ry, rz, vx, vy, vz = qx * rx, qy * ry, qz * rz, qx * vx, qy * vy, qz * vz
    gx, gy, gz = qx * gx, qy * gy, qz * gz
    r = math.sqrt(rx * rx + ry * ry + rz * rz)
    way = 1.0 if face.form == OUTSIDE else -1.0
    return (
        way * (r - d) * (r + d),
        way * 2.0 * (rx * vx + ry * vy + rz * vz - d * dd),
        way * (vx * vx + vy * vy + vz * vz + rx * gx + ry * gy + rz * gz - dd * dd),
        way * (vx * gx + vy * gy + vz * gz),
        way * (gx * gx + gy * gy + gz * gz) / 4.0,
    )


@kernel
def _there(face: Any, box: Any, ball: Any, s: float) -> bool:
    """Whether a bounded wall reaches to where the ball is at a time s from its clock on."""
    h = s / 2.0
    x = ball.x + (ball.vx + box[U(PULL)] * h) * s
    y = ball.y + (ball.vy + box[U(PULL + 1)] * h) * s
    z = ball.z + (ball.vz + box[U(PULL + 2)] * h) * s
    along = face.ax * x + face.ay * y + face.az * z
    return bool(face.low <= along <= face.high)


@kernel
def _swung(face: Any, now: float) -> tuple[float, float, float, float]:
    """A swinging plane's place along its normal as a parabola from now on, and until when that one lasts."""
    k = math.floor((now - face.start) / face.half)
    t = (now - face.start) - k * face.half
    c = 4.0 * face.swing / (face.half * face.half)
    if k % 2.0 != 0.0:
        c = -c
    return c * t * (face.half - t), c * (face.half - 2.0 * t), -c, face.half - t


@kernel
def _swing_hit(face: Any, c: tuple[float, ...], now: float, most: float, slow: float) -> tuple[float, bool]:
    """When a gap c closes before a swinging plane, up to a time; or the time up to which it does not, and False."""
    c0, c1, c2 = c[0], c[1], c[2]
    s = 0.0
    if c0 > face.swing:
        # nothing can happen before the ball comes into reach
        s = hit2(c0 - face.swing, c1, c2, most, 0.0)
        if s == math.inf:
            return s, True
    for _ in range(ARCS):
        d0, d1, d2, left = _swung(face, now + s)
        t = hit2(c0 + (c1 + c2 * s) * s - d0, c1 + 2.0 * c2 * s - d1, c2 - d2, left, slow)
        if t <= left:
            return s + t, True
        s += left
        if s > most:
            return math.inf, True
    return s, False


@kernel
def _oval_hit(
    ovals: Any, face: Any, wall: Any, box: Any, ball: Any, scale: float, growth: float, most: float, slow: float
) -> float:
    """When a ball reaches an ellipse that bounds its surface. ``ovals`` is None where there is none."""
    if ovals is None:
        return math.inf
    return oval_hit(
        face.nx, face.ny, wall.keep + wall.thick * (scale - 1.0), wall.thick * growth, wall.keep, ball.x - face.mx,
        ball.y - face.my, ball.vx, ball.vy, box[U(PULL)], box[U(PULL + 1)], most, slow,
    )  # fmt: skip


@kernel
def _oval_normal(ovals: Any, face: Any, ball: Any) -> Vec:
    """The normal of an ellipse at the point that is nearest to a ball, towards it."""
    if ovals is None:
        return (1.0, 0.0, 0.0)
    found = oval_depth(face.nx, face.ny, ball.x - face.mx, ball.y - face.my)
    return (found[1], found[2], 0.0)


@kernel
def _oval_press(ovals: Any, face: Any, box: Any, ball: Any) -> float:
    """How fast the approach of a ball to an ellipse grows: by the force, and by its way along the curve."""
    if ovals is None:
        return 0.0
    depth, nx, ny, rho = oval_depth(face.nx, face.ny, ball.x - face.mx, ball.y - face.my)
    along = ball.vx * ny - ball.vy * nx
    # (at the end of a long axis a ball can be as large as the circle of curvature: it is held there by both sides)
    return along * along / max(rho - depth, 1e-9 * rho) - (  # type: ignore[no-any-return]
        nx * box[U(PULL)] + ny * box[U(PULL + 1)]
    )


@kernel
def wall_hit(
    more: Any, face: Any, wall: Any, box: Any, ball: Any, scale: float, growth: float, now: float, most: float
) -> Any:
    """When a ball, brought forward to now, reaches a wall, within ``most`` from now; or until when it does not, and False.

    ``more`` is None where all walls are planes at rest: the rest is left out, then, when this is compiled. Else it is a pair whose
    second is None where no wall is an OVAL.
    """
    slow = SLOW * math.sqrt(square((ball.vx, ball.vy, ball.vz)))
    if more is not None and face.form == OVAL:
        return _oval_hit(more[1], face, wall, box, ball, scale, growth, most, slow), True
    c = _gap(more, face, wall, box, ball, scale, growth)
    if more is None:
        return hit2(c[0], c[1], c[2], most, slow), True
    if face.form != PLANE:
        # (|q| is at most this on a round wall, and the gap's units are a distance times twice |q (x - m)|)
        slow = 2.0 * slow * max(face.nx, face.ny, face.nz) * (wall.keep + abs(wall.thick))
    if face.swing != 0.0:
        return _swing_hit(face, c, now, most, slow)
    if face.bounded != 0 and face.form == PLANE and c[0] < -(face.deep + wall.thick * scale):
        # it is behind, in another part of the room: only from before it does it come to touch it
        s = next_hit4(c[0], c[1], c[2], 0.0, 0.0, 0.0, most) if c[1] > 0.0 and c[2] < 0.0 else math.inf
    else:
        s = hit4(c[0], c[1], c[2], c[3], c[4], most, slow)
    if face.bounded != 0:
        while s < math.inf and not _there(face, box, ball, s):
            s = next_hit4(c[0], c[1], c[2], c[3], c[4], s, most)
    return s, True


@kernel
def next_wall(
    more: Any,
    swarm: Any,
    box: Any,
    faces: Any,
    walls: Any,
    lists: Any,
    sets: Any,
    ball: Any,
    plan: Any,
    now: float,
    turn: float,
    which: int,
) -> tuple[float, int]:
    """The earliest of a ball's turn (its time and kind) and its contacts with the walls of its cell."""
    cell = (plan.cz * swarm.cells[1] + plan.cy) * swarm.cells[0] + plan.cx
    first = S(lists[U(cell)])
    scale = swarm.scale + swarm.growth * now
    s = turn - now
    for k in range(1, S(sets[U(first)]) + 1):
        w = S(sets[U(first + k)])
        t, hits = wall_hit(
            more, faces[U(w)], walls[U(w * swarm.kinds + S(ball.kind))], box, ball, scale, swarm.growth, now, s
        )
        if t < s:
            s, which = t, (FIRST_WALL + w if hits else LOOK)
    return now + s if which >= FIRST_WALL else turn, which


@kernel
def _normal(more: Any, face: Any, ball: Any) -> Vec:
    """The normal of a wall where a ball touches it, towards the ball."""
    if face.form == PLANE:
        return (face.nx, face.ny, face.nz)
    if face.form == OVAL:
        return _oval_normal(more[1], face, ball)
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
def _draw(swarm: Any, flat: bool, body: Any, one: Any, warm: float, warm_spin: float) -> Vec:
    """A Maxwellian velocity; the ball gets a Maxwellian spin."""
    x = y = z = p = q = r = 0.0
    for _ in range(3):
        x, y, z, p = z, p, q, r
        q, r, swarm.drawn = normals(swarm.key[0], swarm.key[1], swarm.drawn)
    speed = math.sqrt(warm / one.mass)
    spin = math.sqrt(warm_spin / (one.kappa * one.mass * one.radius * one.radius))
    if flat:
        body.wz = spin * r
        return (speed * x, speed * y, 0.0)
    body.wx, body.wy, body.wz = spin * p, spin * q, spin * r
    return (speed * x, speed * y, speed * z)


@kernel
def _leave_warm(swarm: Any, face: Any, body: Any, one: Any, n: Vec, v0: Vec, w0: Vec) -> tuple[Vec, Vec, float]:
    """Velocity, spin and normal impulse per mass of a ball at a heated wall: Maxwellian in flux, v_n is weighted by v_n."""
    v = _draw(swarm, swarm.axes == 2, body, one, face.warm, face.warm_spin)
    out = math.sqrt(2.0 * face.warm / one.mass * exponential(swarm.key[0], swarm.key[1], swarm.drawn))
    swarm.drawn += 1
    c = out - dot(v, n)
    v, spin = (v[0] + c * n[0], v[1] + c * n[1], v[2] + c * n[2]), (body.wx, body.wy, body.wz)
    moment = one.kappa * one.radius * one.radius
    face.fed += one.mass / 2.0 * (square(v) - square(v0) + moment * (square(spin) - square(w0)))
    return v, spin, dot(v, n) - dot(v0, n)


@kernel
def _least(more: Any, face: Any, wall: Any, box: Any, ball: Any, n: Vec, soft: float) -> float:
    """The speed at which a ball that is pressed on a wall, by a force or its curvature, comes back after a time ``soft``."""
    if more is not None and face.form == OVAL:
        return max(_oval_press(more[1], face, box, ball), 0.0) * soft / 2.0
    c = _gap(more, face, wall, box, ball, 1.0, 0.0)
    press = -2.0 * c[2]
    if more is None:
        return max(press, 0.0) * soft / 2.0
    if face.form != PLANE:
        # of the gap's units to those of a distance: by its gradient
        x, y, z = face.nx * (ball.x - face.mx), face.ny * (ball.y - face.my), face.nz * (ball.z - face.mz)
        press = press / (2.0 * abs(face.nx * x * n[0] + face.ny * y * n[1] + face.nz * z * n[2]))
    return max(press, 0.0) * soft / 2.0


@kernel
def _bounce(
    more: Any,
    swarm: Any,
    box: Any,
    face: Any,
    wall: Any,
    ball: Any,
    body: Any,
    one: Any,
    n: Vec,
    v0: Vec,
    w0: Vec,
    now: float,
) -> tuple[Vec, Vec, float]:
    """Velocity, spin and normal impulse per mass of a ball after one contact, as the wall sees it."""
    e, least = wall.e, 0.0
    if swarm.soft > 0.0:
        if now - body.met < swarm.soft:
            e, least = 1.0, _least(more, face, wall, box, ball, n, swarm.soft) + HOP * math.sqrt(square(v0))
        body.met = now
    v, spin, j, _required, _regime = one_contact(v0, w0, n, one.radius, one.kappa, e, wall.mu, wall.beta)
    un, pn, half = dot(v0, n), dot(j, n), one.mass / 2.0
    moved = half * (j[0] * (v0[0] + v[0]) + j[1] * (v0[1] + v[1]) + j[2] * (v0[2] + v[2]))
    spun = half * one.kappa * one.radius * one.radius * (square(spin) - square(w0))
    book(wall, half * (e - 1.0) * pn * un, moved, spun)
    if un + pn < least:
        lift = least - (un + pn)
        v = (v[0] + lift * n[0], v[1] + lift * n[1], v[2] + lift * n[2])
        face.fed += half * lift * (least + un + pn)
        pn += lift
    return v, spin, pn


@kernel
def meet_wall(
    more: Any, swarm: Any, box: Any, faces: Any, walls: Any, species: Any, ball: Any, body: Any, w: int, now: float
) -> None:
    """A ball meets wall ``w``. ``more``: see :func:`wall_hit`."""
    face, wall, one = faces[U(w)], walls[U(w * swarm.kinds + S(ball.kind))], species[U(ball.kind)]
    v0, w0 = (ball.vx, ball.vy, ball.vz), (body.wx, body.wy, body.wz)
    if more is None:
        n = (face.nx, face.ny, face.nz)
        v, spin, pn = _bounce(more, swarm, box, face, wall, ball, body, one, n, v0, w0, now)
    else:
        n = _normal(more, face, ball)
        speed = 0.0
        if face.swing != 0.0:
            speed = _swung(face, now)[1]
        if swarm.growth != 0.0:
            # the surface of a ball that grows comes towards the wall by itself
            speed = abs(wall.thick) * swarm.growth
        v0 = (v0[0] - speed * n[0], v0[1] - speed * n[1], v0[2] - speed * n[2])
        if face.warm >= 0.0:
            v, spin, pn = _leave_warm(swarm, face, body, one, n, v0, w0)
        else:
            v, spin, pn = _bounce(more, swarm, box, face, wall, ball, body, one, n, v0, w0, now)
        v = (v[0] + speed * n[0], v[1] + speed * n[1], v[2] + speed * n[2])
        face.fed += one.mass * pn * speed
    put_velocity(ball, v)
    body.wx, body.wy, body.wz = spin[0], spin[1], spin[2]
    face.push += one.mass * pn
    face.hits += 1
    swarm.wall_hits += 1
    ball.count += 1


@kernel
def wait_for_kick(more: Any, swarm: Any, now: float) -> float:
    """When the thermostat kicks next: as long after now as one waits for what happens at random."""
    if more is None:
        return math.inf
    if swarm.rate == 0.0:
        return math.inf
    swarm.drawn += 1
    return now + exponential(swarm.key[0], swarm.key[1], swarm.drawn - 1) / swarm.rate  # type: ignore[no-any-return]


@kernel
def whom_to_kick(swarm: Any) -> int:
    """One of the balls, drawn evenly."""
    swarm.drawn += 1
    n = S(uniform(swarm.key[0], swarm.key[1], swarm.drawn - 1) * swarm.count)
    return min(n, swarm.count - 1)  # type: ignore[no-any-return]


@kernel
def kick(swarm: Any, species: Any, ball: Any, body: Any) -> None:
    """The thermostat gives a ball a Maxwellian velocity and spin of its own (Andersen)."""
    one = species[U(ball.kind)]
    moment = one.kappa * one.radius * one.radius
    before = square((ball.vx, ball.vy, ball.vz)) + moment * square((body.wx, body.wy, body.wz))
    v = _draw(swarm, swarm.axes == 2, body, one, swarm.warm, swarm.warm_spin)
    put_velocity(ball, v)
    swarm.fed += one.mass / 2.0 * (square(v) + moment * square((body.wx, body.wy, body.wz)) - before)
    swarm.kicks += 1
    ball.count += 1
