"""Work done once per cycle of the calendar: removal of drift, tests of progress, memory order of the balls.

Sorted by cell, balls that are near each other in space are near in memory, and what is fetched for one is there for the next.
``Balls.numbers`` says which ball lies at each place; outside the engine, balls are addressed by number.
"""

from __future__ import annotations

import math
from typing import Any

from carom.core.jit.kernel import hot_kernel, kernel
from carom.gas.edmd.calendar import I64, U64
from carom.gas.edmd.cell_lists import INDEX_MASK, SLOTS, insert_ball
from carom.gas.edmd.collisions import free_flight
from carom.gas.edmd.gas_records import DONE, INDEX_BITS, LIMIT, NO_BALL, UNDERFLOW

__all__ = [
    "SORT_INTERVAL", "check_progress", "remove_momentum_drift", "set_threshold", "sort_by_cell",
]  # fmt: skip

# An approach slower than this share of the speeds is the rounding of two balls that move along each other or, after an impact
# without rebound, together; it is no collision.
APPROACH_ROUNDING = 1e-14
MAX_DRIFT = 1e-12  # share of the energy that a drift may have before it is removed
# Of a mean square speed: below, squares of what is small beside it leave the range of double precision.
LEAST_SQUARE_SPEED = 1e-280
SORT_INTERVAL = 8  # cycles: some 30 collisions per ball, in which it moves about its own diameter


@hot_kernel
def set_threshold(system: Any, species: Any, energy: float) -> None:
    """Set the threshold of approach from twice the translational energy."""
    lightest, widest = math.inf, 0.0
    for k in range(species.shape[0]):
        lightest, widest = min(lightest, species[k].mass), max(widest, species[k].radius)
    system.threshold = APPROACH_ROUNDING * widest * math.sqrt(energy / (lightest * system.balls))


@kernel
def remove_momentum_drift(system: Any, grid: Any, motions: Any, species: Any) -> bool:
    """Subtract the velocity of the centre of mass along the free axes; return whether it was worth it (then plan all anew).

    Momentum along these axes is conserved: what is found at the start is the given one, and is kept as the velocity of the
    ``frame``; what is found later is accumulated rounding, and is discarded.
    """
    mass, p, energy = 0.0, (0.0, 0.0, 0.0), 0.0
    fx, fy, fz = system.free[0], system.free[1], system.free[2]
    gx, gy, gz = grid.gravity[0], grid.gravity[1], grid.gravity[2]
    for i in range(motions.shape[0]):
        ball = motions[i]
        m, s = species[ball.species].mass, system.now - ball.time
        x, y, z = ball.vx + gx * s, ball.vy + gy * s, ball.vz + gz * s
        mass += m
        p = (p[0] + m * x, p[1] + m * y, p[2] + m * z)
        energy += m * (x * x + y * y + z * z)
    x, y, z = p[0] / mass * fx, p[1] / mass * fy, p[2] / mass * fz
    if not mass * (x * x + y * y + z * z) > MAX_DRIFT * energy:
        return False
    for i in range(motions.shape[0]):
        ball = motions[i]
        free_flight(grid, ball, system.now)
        ball.vx, ball.vy, ball.vz = ball.vx - x, ball.vy - y, ball.vz - z
    if system.cycles == 0:
        system.frame[0] += x
        system.frame[1] += y
        system.frame[2] += z
    return True


@kernel
def check_progress(motions: Any, plans: Any, species: Any, events: int) -> int:
    """Return LIMIT if the run may go on, DONE if nothing will ever happen, UNDERFLOW if speeds are too small to compute with."""
    if events == 0:
        waits = False
        for i in range(plans.shape[0]):
            waits = waits or plans[i].event_time < math.inf
        if not waits:
            return DONE
    mass, energy = 0.0, 0.0
    for i in range(motions.shape[0]):
        ball = motions[i]
        m = species[ball.species].mass
        mass += m
        energy += m * (ball.vx * ball.vx + ball.vy * ball.vy + ball.vz * ball.vz)
    return UNDERFLOW if 0.0 < energy < LEAST_SQUARE_SPEED * mass else LIMIT


@kernel
def _order_by_cell(cells: Any, order: Any) -> None:
    """Write the places of all balls, cell by cell, to ``order``; within a cell in increasing order."""
    slots, links, n = cells.slots, cells.links, 0
    for first in range(0, slots.shape[0], SLOTS):
        count = I64(slots[U64(first)]) >> INDEX_BITS
        if count == 0:
            continue
        begin = n
        order[U64(n)] = slots[U64(first)] & INDEX_MASK
        n += 1
        k = I64(slots[U64(first + 1)]) if count > 1 else NO_BALL
        while k != NO_BALL:
            order[U64(n)] = k
            n += 1
            k = I64(links[U64(k)]) if count > SLOTS else NO_BALL
        for a in range(begin + 1, n):
            one, b = order[U64(a)], a
            while b > begin and order[U64(b - 1)] > one:
                order[U64(b)] = order[U64(b - 1)]
                b -= 1
            order[U64(b)] = one


@kernel
def _permute(balls: Any, scratch: Any, order: Any) -> None:
    """Move the ball at place ``order[k]`` to k, for all k, in place, cycle by cycle; afterwards order[k] is k."""
    motions, plans, bodies, numbers = balls.motions, balls.plans, balls.bodies, balls.numbers
    motion, plan, body, number = scratch.motion, scratch.plan, scratch.body, scratch.number
    for start in range(order.shape[0]):
        if order[U64(start)] == start:
            continue
        motion[0], plan[0], body[0], number[0] = motions[start], plans[start], bodies[start], numbers[start]
        k, source = I64(start), I64(order[U64(start)])
        while source != start:
            motions[k], plans[k], bodies[k], numbers[k] = (
                motions[source],
                plans[source],
                bodies[source],
                numbers[source],
            )
            order[U64(k)] = k
            k, source = source, I64(order[U64(source)])
        motions[k], plans[k], bodies[k], numbers[k] = motion[0], plan[0], body[0], number[0]
        order[U64(k)] = k


@kernel
def sort_by_cell(balls: Any, scratch: Any, cells: Any, calendar: Any) -> None:
    """Sort the balls by cell. The calendar, whose blocks serve as working space, has to be rebuilt afterwards."""
    plans, links = balls.plans, cells.links
    count = balls.numbers.shape[0]
    order = calendar.blocks[:count]
    _order_by_cell(cells, order)
    for k in range(count):
        links[U64(order[U64(k)])] = k  # the new place
    for k in range(count):
        plan = plans[U64(k)]
        if plan.partner != NO_BALL:
            plan.partner = links[U64(plan.partner)]
    _permute(balls, scratch, order)
    cells.slots[:] = 0
    for k in range(count):
        insert_ball(cells, plans[U64(k)], k)
