"""Balls: free flight, prediction of the next cell crossing and the next collision, and the collision of two balls.

Collision times follow Bannerman, Strobl, Formella & Poeschel, arXiv:1211.6718: balls that touch, or overlap by rounding, collide
now if they approach, and not at all if they separate. The contact is :mod:`carom.core.contact`; its energies are added to totals.
"""

from __future__ import annotations

import math
from typing import Any

from carom.core.contact import contact, friction_at_slip
from carom.core.jit.kernel import Vec, hot_kernel, kernel
from carom.core.motion.phases import restitution
from carom.core.random import normals, uniform
from carom.core.roots import hit2
from carom.gas.edmd.averages import note_change, note_pair, note_passed_heat
from carom.gas.edmd.calendar import I64, INDEX_MASK, U64, Block, cell_index, copy_cell
from carom.gas.edmd.gas_records import INDEX_BITS, NO_BALL, RANDOM_NORMAL, RANDOM_UNIFORM
from carom.laws.pair import pair_contact, pair_slip

MOST_IMAGES = 256  # of one ball along x that come by before another event


@kernel
def slide_images(shear: Any, grid: Any, t: float) -> None:
    """Let the images slide on, as a cycle of the calendar of this length ends."""
    if shear is None:
        return
    one, side = shear[0], grid.side[U64(0)]
    offset = one.offset + one.speed * t
    one.offset = offset - math.floor(offset / side) * side


@kernel
def with_flow(shear: Any, grid: Any, y: float, v: Vec) -> Vec:
    """Return a velocity relative to the flow as one in the frame at rest."""
    if shear is None:
        return v
    return (v[0] + shear[0].rate * (y - grid.side[U64(1)] / 2.0), v[1], v[2])


@kernel
def within_border(shear: Any, grid: Any, block: Block) -> Block:
    """Return a block of cells without those beyond the border across y."""
    if shear is None:
        return block
    low = 1 if block.y == 0 and block.y0 == 0 else block.y0
    high = 2 if block.y + 1 == grid.cells[U64(1)] and block.y1 == 3 else block.y1
    return Block(block.x, block.y, block.z, block.x0, block.x1, low, high, block.z0, block.z1)


@kernel
def cross_sheared_border(
    shear: Any, grid: Any, averages: Any, species: Any, ball: Any, plan: Any, turns: int, now: float
) -> None:
    """Give a ball that crosses the border across y, upwards (turns 1) or downwards (-1), its image's place and velocity along x."""
    if shear is None or turns == 0:
        return
    one, side = shear[0], grid.side[U64(0)]
    m, faster = species[U64(ball.species)].mass, -turns * one.speed
    s = (ball.vx + faster / 2.0, ball.vy, ball.vz)
    note_change(averages, grid, plan, I64(ball.species), (m * faster, 0.0, 0.0), s, 0.0, now)
    ball.vx += faster
    x = ball.x - turns * (one.offset + one.speed * now)
    around = math.floor(x / side)
    ball.x = x - around * side
    plan.image[0] += I64(around)
    plan.cx = cell_index(grid, 0, ball.x)


@kernel
def rows_after_border(shear: Any, grid: Any, before: int, after: int, y0: int, y1: int) -> tuple[int, int]:
    """Return which rows of cells around a ball are searched that has crossed a border across y, from a cell to another.

    Of a row that slides past a ball has to know all balls. Behind the border of a sheared gas it knows those near it only: the row
    was its own.
    """
    if shear is None or abs(after - before) == 1:
        return y0, y1
    return 0, 3


@kernel
def sheared_image(shear: Any, grid: Any, x: float, y: float, rx: float, now: float) -> tuple[float, float]:
    """Return how far a ball is from the nearest image of another along x, and how much faster the image is than that ball.

    (x, y) is the difference of their places, ``rx`` what it is along x where nothing is sheared.
    """
    if shear is None:
        return rx, 0.0
    one, side, half = shear[0], grid.side[U64(0)], grid.side[U64(1)] / 2.0
    m = 1.0 if y > half else (-1.0 if y < -half else 0.0)
    x -= m * (one.offset + one.speed * now)
    return x - math.floor(x / side + 0.5) * side, m * one.speed


@kernel
def _time_to_image(r: Vec, u: Vec, distance_squared: float, side: float, threshold: float, most: float) -> float:
    """Return when a ball at r, with the velocity u, both relative to another, hits the first of its images along x, up to a time.

    ``r`` is from the nearest image.
    """
    reach = math.sqrt(distance_squared)
    ry, rz, uy, uz = r[1], r[2], u[1], u[2]
    u2, square = u[0] * u[0] + uy * uy + uz * uz, ry * ry + rz * rz
    x, step = r[0], (-side if u[0] > 0.0 else side)
    for _ in range(MOST_IMAGES):
        b, c = x * u[0] + ry * uy + rz * uz, x * x + square - distance_squared
        inside = b * b - u2 * c
        if b < -threshold and inside > 0.0:
            return max(c, 0.0) / (math.sqrt(inside) - b)
        x += step
        if u[0] == 0.0:
            return math.inf
        # the next image comes within reach along x: it is too late if it is then out of reach across, for ever
        s = (abs(x) - reach) / abs(u[0])
        y, z = ry + uy * s, rz + uz * s
        if s > most or (abs(y) > reach and y * uy >= 0.0) or (abs(z) > reach and z * uz >= 0.0):
            return math.inf
    return math.inf


@kernel
def earliest_across(
    shear: Any, grid: Any, system: Any, motions: Any, pairs: Any, cells: Any, near: Any, block: Block, i: int, now: float,
    hit: float, partner: int,
) -> tuple[float, int]:  # fmt: skip
    """Return the earliest collision of ball i, given that with the balls within the border: also with those across it."""
    if shear is None:
        return hit, partner
    last = block.y + 1 == grid.cells[U64(1)]
    # (a ball that crosses a border of a cell along x has looked at the whole row before)
    if block.x1 - block.x0 < 3 or not ((block.y == 0 and block.y0 == 0) or (last and block.y1 == 3)):
        return hit, partner
    k, up = (2, 1.0) if last else (0, -1.0)
    one, side, ball, found = shear[0], grid.side[U64(0)], motions[U64(i)], near.found
    far, speed = ball.x - up * (one.offset + one.speed * now), up * one.speed
    y, row = near.images[U64(4 + k)], I64(ball.species) * system.species
    for c in range(block.z0, block.z1):
        z = near.images[U64(8 + c)]
        beyond = cells.offsets[U64(1), U64(block.y), U64(k)] + cells.offsets[U64(2), U64(block.z), U64(c)]
        for a in range(grid.cells[U64(0)]):
            n = copy_cell(cells.slots, cells.links, found, beyond + cells.offsets[U64(0), U64(a), U64(1)], 0, 0)
            for index in range(n):
                j = I64(found[U64(index)]) & INDEX_MASK
                other = motions[U64(j)]
                s = now - other.time
                x = far - (other.x + other.vx * s)
                r = (x - math.floor(x / side + 0.5) * side, y - (other.y + other.vy * s), z - (other.z + other.vz * s))
                u = (ball.vx - (other.vx + speed), ball.vy - other.vy, ball.vz - other.vz)
                pair = pairs[U64(row + other.species)]
                t = now + _time_to_image(r, u, pair.distance_squared, side, system.threshold, hit - now)
                if t < hit or (t == hit and t < math.inf and (partner == NO_BALL or j < partner)):
                    hit, partner = t, j
    return hit, partner


# ----------------------------------------------------------------------------------------------------
# Balls: free flight, prediction of the next cell crossing and the next collision, and the collision of two balls.


LANES = 4  # collision times computed at once
# A ball's contacts are those of an inelastic collapse when PATIENCE of them in a row follow each other within QUICK of the mean
# time between a ball's events, at approach speeds below FEEBLE times the threshold of rounding: 1e-9 of the balls' speeds. Balls
# in contact from the start, whose contacts at one instant are many but finite, reach 29 (restitution 0.7 and above). At small
# restitution speeds fall from there to rounding in few contacts (three balls on a line: 9 at 0.07), so each counts more.
PATIENCE, QUICK, FEEBLE = 50, 1e-9, 1e5
INFINITY_BITS = 0x7FF0000000000000  # of the double


@hot_kernel
def squared_length(w: Vec) -> float:
    """Return the square of a vector."""
    return w[0] * w[0] + w[1] * w[1] + w[2] * w[2]


@hot_kernel
def set_velocity(ball: Any, v: Vec) -> None:
    """Set a ball's velocity."""
    ball.vx, ball.vy, ball.vz = v[0], v[1], v[2]


@hot_kernel
def free_flight(grid: Any, ball: Any, now: float) -> None:
    """Move a ball in free flight to the time now."""
    s = now - ball.time
    h = s / 2
    gx, gy, gz = grid.gravity[U64(0)], grid.gravity[U64(1)], grid.gravity[U64(2)]
    vx, vy, vz = ball.vx, ball.vy, ball.vz
    ball.x += (vx + gx * h) * s
    ball.y += (vy + gy * h) * s
    ball.z += (vz + gz * h) * s
    ball.vx, ball.vy, ball.vz = vx + gx * s, vy + gy * s, vz + gz * s
    ball.time = now


# --- cell crossings ------------------------------------------------------------------------------------------------


@hot_kernel
def _axis_crossing(grid: Any, axis: int, cell: int, x: float, v: float) -> tuple[float, bool]:
    """Return the time until a ball leaves its cell along an axis, and whether upwards. Outermost cells have no outer face."""
    size = grid.cell_size[U64(axis)]
    low, high = cell * size, (cell + 1) * size
    if grid.periodic[U64(axis)] == 0:
        if cell == 0:
            low = -math.inf
        if cell + 1 == grid.cells[U64(axis)]:
            high = math.inf
    g = grid.gravity[U64(axis)]
    if g != 0:
        up, down = hit2(high - x, -v, -g / 2, math.inf, 0.0), hit2(x - low, v, g / 2, math.inf, 0.0)
        return (up, True) if up < down else (down, False)
    upwards = v > 0
    gap = high - x if upwards else low - x
    s = gap / v if v != 0 else math.inf
    return max(s, 0.0), upwards


@hot_kernel
def next_cell_crossing(grid: Any, flat: bool, ball: Any, plan: Any, now: float) -> tuple[float, int]:
    """Return when a ball that is at its position of now reaches a face of its cell, and which: 2 axis + (1 upwards)."""
    s, up = _axis_crossing(grid, 0, plan.cx, ball.x, ball.vx)
    which = 1 if up else 0
    t, up = _axis_crossing(grid, 1, plan.cy, ball.y, ball.vy)
    if t < s:
        s, which = t, 3 if up else 2
    if not flat:
        t, up = _axis_crossing(grid, 2, plan.cz, ball.z, ball.vz)
        if t < s:
            s, which = t, 5 if up else 4
    return now + s, which


# --- collisions of two balls: when ---------------------------------------------------------------------------------


@kernel
def _growing_collisions(
    motions: Any,
    pairs: Any,
    near: Any,
    row: int,
    threshold: float,
    n: int,
    padded: int,
    i: int,
    scale: float,
    growth: float,
) -> None:
    """Compute the collision times of growing balls, whose distance in contact at s is scale + growth s times the final one."""
    found, times = near.found, near.times
    for k in range(padded):
        times[U64(k)] = math.inf
    for k in range(n):
        if I64(found[U64(k)]) & INDEX_MASK == i:
            continue  # (a ball does not grow into itself)
        final2 = pairs[U64(row + motions[U64(found[U64(k)] & INDEX_MASK)].species)].distance_squared
        b, u2, c = near.b[U64(k)] - final2 * scale * growth, near.u2[U64(k)] - final2 * growth * growth, near.c[U64(k)]
        c += final2 * (1.0 - scale * scale)
        inside = b * b - u2 * c
        if b < -threshold:
            if inside > 0.0:
                times[U64(k)] = max(c, 0.0) / (math.sqrt(inside) - b)
        elif u2 < 0.0:
            # they separate, more slowly than they grow
            times[U64(k)] = max((b + math.sqrt(max(inside, 0.0))) / -u2, 0.0)


@hot_kernel
def earliest_collision(
    grid: Any, system: Any, motions: Any, pairs: Any, near: Any, n: int, i: int, now: float, threshold: float, scale: float,
    growth: float, features: Any,
) -> tuple[float, int]:  # fmt: skip
    """Return the earliest collision of ball i, at its position of now, with one of the n balls found: its time, and the ball.

    First the coefficients for every ball, then all times, then the least of them, without branches and, where the processor
    can, eight at once. ``near.time_bits`` is ``near.times`` read as integers, which have the same order as positive floats and
    whose minimum needs no rule for NaN.
    """
    found, images, times, bits = near.found, near.images, near.times, near.time_bits
    ball = motions[U64(i)]
    vx, vy, vz = ball.vx, ball.vy, ball.vz
    row = I64(ball.species) * system.species
    gx, gy, gz = grid.gravity[U64(0)], grid.gravity[U64(1)], grid.gravity[U64(2)]
    falls = (gx != 0.0) | (gy != 0.0) | (gz != 0.0)
    for k in range(n):
        entry = found[U64(k)]
        other = motions[U64(entry & INDEX_MASK)]
        code = entry >> INDEX_BITS
        s = now - other.time
        ox, oy, oz = other.vx, other.vy, other.vz
        dx, dy, dz = ox * s, oy * s, oz * s
        if falls:
            # all fall together, so relative motion is straight; but each ball's position has its own time
            dx, dy, dz = dx + gx * (s * s / 2), dy + gy * (s * s / 2), dz + gz * (s * s / 2)
            ox, oy, oz = ox + gx * s, oy + gy * s, oz + gz * s
        rx = images[U64(code & 3)] - (other.x + dx)
        ry = images[U64(4 + ((code >> 2) & 3))] - (other.y + dy)
        rz = images[U64(8 + (code >> 4))] - (other.z + dz)
        ux, uy, uz = vx - ox, vy - oy, vz - oz
        near.b[U64(k)] = rx * ux + ry * uy + rz * uz
        near.u2[U64(k)] = ux * ux + uy * uy + uz * uz
        near.c[U64(k)] = rx * rx + ry * ry + rz * rz - pairs[U64(row + other.species)].distance_squared
    padded = (n + LANES - 1) & -LANES
    for k in range(n, padded):
        near.b[U64(k)] = 0.0
        found[U64(k)] = NO_BALL
    fixed_size = padded
    if features is not None and growth != 0.0:
        _growing_collisions(motions, pairs, near, row, threshold, n, padded, i, scale, growth)
        fixed_size = 0
    for k in range(fixed_size):
        b, u2, c = near.b[U64(k)], near.u2[U64(k)], near.c[U64(k)]
        # c + 2 b s + u2 s^2 = 0, for b < 0; overlapping and approaching is now
        inside = b * b - u2 * c
        t = (c if c > 0.0 else 0.0) / (math.sqrt(inside if inside > 0.0 else 0.0) - b)
        times[U64(k)] = t if (b < -threshold) & (inside > 0.0) else math.inf
    best = INFINITY_BITS
    for k in range(padded):
        best = min(best, bits[U64(k)])
    partner = NO_BALL
    if best >= INFINITY_BITS:
        return math.inf, partner
    for k in range(padded):
        partner = min(partner, I64(found[U64(k)]) & INDEX_MASK if bits[U64(k)] == best else NO_BALL)
    bits[U64(0)] = best
    return now + times[U64(0)], partner


# --- collisions of two balls: what they do -------------------------------------------------------------------------


@hot_kernel
def _nearest_image(x: float, side: float, periodic: int) -> float:
    """Return a coordinate difference, between nearest images if the axis is periodic."""
    if periodic == 0:
        return x
    if x > side / 2:
        return x - side
    return x + side if x < -side / 2 else x


@hot_kernel
def add_energies(totals: Any, normal: float, translational: float, rotational: float) -> None:
    """Add a contact to its totals: the energy lost along the normal, the changes of translational and rotational energy."""
    totals.collisions += 1
    totals.lost_normal += normal
    totals.lost_tangential -= translational + rotational + normal
    totals.to_spin += rotational


@hot_kernel
def count_if_feeble(system: Any, body: Any, now: float, e: float, approach: float, distance: float) -> None:
    """Without the TC model: let a ball's ``last_contact`` run ahead of the clock by one more pause, if a contact is feeble.

    The clock catches up between contacts that are further apart than a pause, so ``last_contact`` is PATIENCE pauses ahead only
    after as many feeble contacts in quick succession.
    """
    between = system.bin_width * system.balls
    # (a gas that starts at rest has no threshold yet)
    least = FEEBLE * system.threshold / distance if system.threshold > 0.0 else QUICK * distance / between
    if approach < least:
        body.last_contact = max(body.last_contact, now) + QUICK * between * max(1.0, 8.0 - 16.0 * e)


@kernel
def _form_restitution(system: Any, form: Any, speed: float) -> float:
    """Return the restitution of a form, at a normal speed of approach or by chance."""
    code = I64(form.form)
    if code == RANDOM_UNIFORM:
        system.drawn += 1
        return form.p0 + form.p1 * uniform(system.key[0], system.key[1], system.drawn - 1)  # type: ignore[no-any-return]
    if code == RANDOM_NORMAL:
        x, _y, system.drawn = normals(system.key[0], system.key[1], system.drawn)
        return min(max(form.p0 + form.p1 * x, 0.0), 1.0)  # type: ignore[no-any-return]
    return restitution(code, (form.p0, form.p1, form.p2), max(speed, 0.0))


@hot_kernel
def restitution_of(system: Any, e: float, form: Any, speed: float) -> float:
    """Return the restitution of a contact at a normal speed of approach: the number e, unless it has a form."""
    return e if form.form == 0 else _form_restitution(system, form, speed)


@hot_kernel
def _pair_restitution(system: Any, pair: Any, form: Any, first: Any, second: Any, speed: float, now: float) -> float:
    """Return the restitution of a contact of two balls: 1 soon after an earlier contact of the TC model."""
    e = restitution_of(system, pair.e, form, speed)
    if system.contact_time > 0:
        if now - max(first.last_contact, second.last_contact) < system.contact_time:
            e = 1.0
        first.last_contact = second.last_contact = now
    return e


@hot_kernel
def _pair_friction(
    pair: Any, form: Any, v1: Vec, first: Any, v2: Vec, second: Any, n: Vec, a1: float, a2: float
) -> float:
    """Return the friction of a contact of two balls: its number, unless it falls with the slip."""
    mu = pair.mu
    if form.drop > 0.0:
        w1, w2 = (first.wx, first.wy, first.wz), (second.wx, second.wy, second.wz)
        slip = pair_slip(v1, w1, v2, w2, n, a1, a2)[1]
        mu = friction_at_slip(mu, form.drop, form.rate, math.sqrt(squared_length(slip)))
    return mu  # type: ignore[no-any-return]


@hot_kernel
def collide_balls(  # noqa: PLR0915  (one contact, three forms)
    features: Any, system: Any, grid: Any, balls: Any, materials: Any, averages: Any, i: int, j: int, now: float
) -> None:
    """Collide balls i and j."""
    motions, bodies = balls.motions, balls.bodies
    a, b = motions[U64(i)], motions[U64(j)]
    species1, species2 = I64(a.species), I64(b.species)
    pair = materials.pairs[U64(species1 * system.species + species2)]
    one, two = materials.species[U64(species1)], materials.species[U64(species2)]
    rx = _nearest_image(a.x - b.x, grid.side[U64(0)], grid.periodic[U64(0)])
    ry = _nearest_image(a.y - b.y, grid.side[U64(1)], grid.periodic[U64(1)])
    rz = _nearest_image(a.z - b.z, grid.side[U64(2)], grid.periodic[U64(2)])
    faster = 0.0  # the image of j that i meets, along x
    if features is not None:
        rx, faster = sheared_image(features.shear, grid, a.x - b.x, a.y - b.y, rx, now)
    slower = 0.0 - faster  # (0 as well: a velocity less 0 keeps its bits)
    distance = math.sqrt(rx * rx + ry * ry + rz * rz)
    n = (rx / distance, ry / distance, rz / distance)
    form = materials.pair_forms[U64(species1 * system.species + species2)]
    ux, uy, uz = a.vx - (b.vx - slower), a.vy - b.vy, a.vz - b.vz
    # (the surfaces of growing balls approach by themselves)
    un = ux * n[0] + uy * n[1] + uz * n[2] - pair.distance * system.growth
    e = _pair_restitution(system, pair, form, bodies[U64(i)], bodies[U64(j)], -un, now)
    if pair.e < 1.0 and system.contact_time == 0.0:
        count_if_feeble(system, bodies[U64(i)], now, e, -un, distance)
        count_if_feeble(system, bodies[U64(j)], now, e, -un, distance)
    v1, v2 = (a.vx, a.vy, a.vz), (b.vx, b.vy, b.vz)
    turned1, turned2 = 0.0, 0.0  # changes of twice the energies of the spins
    if pair.smooth:
        m1, m2 = one.mass, two.mass
        pn, _f, _required, _regime = contact(un, (0.0, 0.0, 0.0), m1 * m2 / (m1 + m2), 1.0, e, 0.0, 0.0)
        c = pn / m1
        set_velocity(a, (a.vx + c * n[0], a.vy + c * n[1], a.vz + c * n[2]))
        c = pn / m2
        set_velocity(b, (b.vx - c * n[0], b.vy - c * n[1], b.vz - c * n[2]))
        p = (pn * n[0], pn * n[1], pn * n[2])
        pair.collisions += 1
        pair.lost_normal -= (1 - e) / 2 * pn * un
    else:
        first, second = bodies[U64(i)], bodies[U64(j)]
        seen = (b.vx - slower, b.vy, b.vz)
        mu = _pair_friction(pair, form, v1, first, seen, second, n, one.radius, two.radius)
        u1, w1, u2, w2, p, _required, _regime = pair_contact(
            v1, (first.wx, first.wy, first.wz), seen, (second.wx, second.wy, second.wz), n,
            one.radius, one.mass, one.kappa, two.radius, two.mass, two.kappa, e, mu, pair.beta,
        )  # fmt: skip
        pn = p[0] * n[0] + p[1] * n[1] + p[2] * n[2]
        # an impulse changes the energy of the centres by itself times the mean of the velocities before and after
        sx, sy, sz = ux + (u1[0] - u2[0]), uy + (u1[1] - u2[1]), uz + (u1[2] - u2[2])
        i1, i2 = one.kappa * one.mass * one.radius * one.radius, two.kappa * two.mass * two.radius * two.radius
        turned1 = i1 * (squared_length(w1) - squared_length((first.wx, first.wy, first.wz)))
        turned2 = i2 * (squared_length(w2) - squared_length((second.wx, second.wy, second.wz)))
        rotational = (turned1 + turned2) / 2
        add_energies(pair, (e - 1) / 2 * pn * un, (p[0] * sx + p[1] * sy + p[2] * sz) / 2, rotational)
        set_velocity(a, u1)
        set_velocity(b, (u2[0] - faster, u2[1], u2[2]))
        first.wx, first.wy, first.wz = w1[0], w1[1], w1[2]
        second.wx, second.wy, second.wz = w2[0], w2[1], w2[2]
    note_pair(
        averages, grid, balls.plans[U64(i)], balls.plans[U64(j)], a, b, p, v1, v2, turned1, turned2, n, distance, now
    )
    if features is not None:
        note_passed_heat(features.heat, a, b, p, v1, v2, turned1, turned2, n, distance)
    contact_distance = pair.distance * (system.scale + system.growth * now)
    system.overlap = max(system.overlap, (contact_distance - distance) / contact_distance)
    a.collisions += 1
    b.collisions += 1
