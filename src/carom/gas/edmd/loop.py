"""Event loop of a gas: event-driven molecular dynamics with a cell list and a calendar queue.

One event per ball is planned: its earliest collision, or the crossing of its cell's border. A collision is stored with the ball
that predicted it; that is enough, for of two balls one was the last to be updated. A ball whose partner has collided with another
meanwhile predicts again when the planned time comes. Ties go to the ball with the lowest index, so the same start gives the same
bits.
"""

from __future__ import annotations

import math
from typing import Any

from carom.core.jit.calls import prefetch
from carom.core.jit.kernel import hot_kernel, kernel
from carom.gas.edmd.averages import close_cycle, note_carried_heat, note_crossing, note_flight, note_turning
from carom.gas.edmd.calendar import (
    BLOCK_LENGTH,
    I64,
    INDEX_MASK,
    PAGE,
    RING,
    SLOTS,
    U64,
    Block,
    block_around,
    cell_index,
    gather_neighbours,
    insert_ball,
    is_pending,
    load_page,
    nearly_full,
    page_of,
    rebuild,
    remove_ball,
    schedule,
    set_images,
    start_cycle,
    unschedule,
)
from carom.gas.edmd.collisions import (
    PATIENCE,
    QUICK,
    collide_balls,
    cross_sheared_border,
    earliest_across,
    earliest_collision,
    free_flight,
    next_cell_crossing,
    rows_after_border,
    slide_images,
    within_border,
)
from carom.gas.edmd.gas_records import COLLAPSED, DONE, INDEX_BITS, LIMIT, NO_BALL, UNDERFLOW
from carom.gas.edmd.walls import (
    FIRST_WALL,
    PREDICT_AGAIN,
    collide_wall,
    draw_ball,
    next_kick_time,
    next_wall_collision,
    thermostat_kick,
)

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


# ----------------------------------------------------------------------------------------------------
# Prefetching: the records of a million balls lie far from the processor, and what comes next is known.
#
# Memory is fetched page by page of the calendar, some hundred events ahead, an entry or two at a time: first the balls entered on
# a page; a page later, when these have arrived, the cells around them and their partners; another page later, the balls in those
# cells. It goes into the second-level cache; the first is too small for all that.


PLANS, CELLS, BALLS = range(3)  # the stages
ENTRIES = 2  # per call
CELL_FACES = 6  # the least ``boundary`` that is no cell crossing


@hot_kernel
def _wrapped_index(index: int, n: int) -> int:
    return index - n if index >= n else (index + n if index < 0 else index)


@hot_kernel
def _searched_block(flat: bool, grid: Any, plan: Any) -> Block:
    """Return the cells that will be searched at a ball's next event."""
    block = block_around(flat, plan)
    which = I64(plan.boundary)
    if plan.collision_time == plan.event_time or which >= CELL_FACES:
        return block
    # the ball crosses over to the next cell, and the cells beyond are searched
    x, y, z, x0, x1, y0, y1, z0, z1 = block
    up = which & 1
    step, first = 2 * up - 1, 2 * up
    if which < 2:
        return Block(_wrapped_index(x + step, grid.cells[U64(0)]), y, z, first, first + 1, y0, y1, z0, z1)
    if which < 4:
        return Block(x, _wrapped_index(y + step, grid.cells[U64(1)]), z, x0, x1, first, first + 1, z0, z1)
    return Block(x, y, _wrapped_index(z + step, grid.cells[U64(2)]), x0, x1, y0, y1, first, first + 1)


@hot_kernel
def _prefetch_cells(slots: Any, offsets: Any, block: Block) -> None:
    """Prefetch cells: those in the corners are on all the cache lines that there are."""
    x, y, z, x0, x1, y0, y1, z0, z1 = block
    left, right = offsets[U64(0), U64(x), U64(x0)], offsets[U64(0), U64(x), U64(x1 - 1)]
    front, back = offsets[U64(1), U64(y), U64(y0)], offsets[U64(1), U64(y), U64(y1 - 1)]
    for c in range(2):
        third = offsets[U64(2), U64(z), U64(z1 - 1 if c else z0)]
        prefetch(slots, U64(third + front + left))
        prefetch(slots, U64(third + front + right))
        prefetch(slots, U64(third + back + left))
        prefetch(slots, U64(third + back + right))


@hot_kernel
def _prefetch_cell_balls(motions: Any, slots: Any, first: int) -> None:
    """Prefetch the first two balls of a cell."""
    prefetch(motions, U64(slots[U64(first)] & INDEX_MASK))
    prefetch(motions, U64(slots[U64(first + 1)] & INDEX_MASK))


@hot_kernel
def _prefetch_balls(motions: Any, slots: Any, offsets: Any, block: Block) -> None:
    """Prefetch the first two balls of each cell."""
    x, y, z, x0, x1, y0, y1, z0, z1 = block
    left, middle, right = (
        offsets[U64(0), U64(x), U64(0)],
        offsets[U64(0), U64(x), U64(1)],
        offsets[U64(0), U64(x), U64(2)],
    )
    ahead = right if x0 == 2 else left
    for c in range(z0, z1):
        third = offsets[U64(2), U64(z), U64(c)]
        for b in range(y0, y1):
            second = third + offsets[U64(1), U64(y), U64(b)]
            if x1 - x0 == 3:
                _prefetch_cell_balls(motions, slots, second + left)
                _prefetch_cell_balls(motions, slots, second + middle)
                _prefetch_cell_balls(motions, slots, second + right)
            else:
                _prefetch_cell_balls(motions, slots, second + ahead)


@hot_kernel
def _prefetch_entries(
    stage: int, flat: bool, spins: bool, grid: Any, balls: Any, cells: Any, blocks: Any, page: int, end: int
) -> int:
    """Prefetch for the next entries of a page, of which those up to ``end`` are left; return the new end."""
    motions, plans, bodies, slots, offsets = balls.motions, balls.plans, balls.bodies, cells.slots, cells.offsets
    for _ in range(ENTRIES):
        if end & (BLOCK_LENGTH - 1) == 0:
            end = I64(blocks[U64(end)]) if end != 0 else 0
            if end == 0:
                return 0
        i = blocks[U64(end)]
        end -= 1
        if stage == PLANS:
            prefetch(plans, U64(i))
            prefetch(motions, U64(i))
            continue
        plan = plans[U64(i)]
        if not is_pending(plan, page):
            continue
        j, collides = plan.partner, plan.collision_time == plan.event_time
        if stage == BALLS:
            _prefetch_balls(motions, slots, offsets, _searched_block(flat, grid, plan))
            if collides and motions[U64(j)].collisions == plan.partner_collisions:
                _prefetch_balls(motions, slots, offsets, block_around(flat, plans[U64(j)]))
            continue
        _prefetch_cells(slots, offsets, _searched_block(flat, grid, plan))
        if collides:
            prefetch(plans, U64(j))
            prefetch(motions, U64(j))
            if spins:
                prefetch(bodies, U64(i))
                prefetch(bodies, U64(j))
    return end


@hot_kernel
def page_ends_ahead(page_ends: Any, page: int, bins: int) -> tuple[int, int, int]:
    """Return where the entries of the three pages end that are prefetched during this one; 0 where the cycle has no more pages.

    (Events that never happen are on the last page of all, which is not prefetched.)
    """
    if (page + 4) * PAGE >= bins:
        return 0, 0, 0
    return I64(page_ends[U64(page + 2)]), I64(page_ends[U64(page + 3)]), I64(page_ends[U64(page + 4)])


@hot_kernel
def prefetch_ahead(
    flat: bool, spins: bool, grid: Any, balls: Any, cells: Any, blocks: Any, page: int, ends: tuple[int, int, int]
) -> tuple[int, int, int]:
    """Prefetch for some balls of the next pages; return where the entries end that are left. Called once per bin."""
    third = _prefetch_entries(PLANS, flat, spins, grid, balls, cells, blocks, page + 4, ends[2])
    second = _prefetch_entries(CELLS, flat, spins, grid, balls, cells, blocks, page + 3, ends[1])
    return _prefetch_entries(BALLS, flat, spins, grid, balls, cells, blocks, page + 2, ends[0]), second, third


# ----------------------------------------------------------------------------------------------------
# Event loop of a gas: event-driven molecular dynamics with a cell list and a calendar queue.


CACHED_BALLS = 10_000  # so many fit the processor's caches; of more, the next ones are prefetched
# Time stands still when so many collisions, per ball and in addition, happen within this share of a bin of the calendar.
STILL_SHARE, STILL_PER_BALL, STILL_COLLISIONS = 1e-9, 100, 100_000


@kernel
def fill_cells(system: Any, grid: Any, balls: Any, materials: Any, cells: Any) -> None:
    """Enter every ball of a new system in its cell."""
    motions, plans, species = balls.motions, balls.plans, materials.species
    remove_momentum_drift(system, grid, motions, species)
    energy = 0.0
    for i in range(motions.shape[0]):
        plan, ball = plans[i], motions[i]
        energy += species[ball.species].mass * (ball.vx * ball.vx + ball.vy * ball.vy + ball.vz * ball.vz)
        plan.cx = cell_index(grid, 0, ball.x)
        plan.cy = cell_index(grid, 1, ball.y)
        plan.cz = cell_index(grid, 2, ball.z)
        insert_ball(cells, plan, i)
    set_threshold(system, species, energy)


@kernel
def restore_lists(system: Any, balls: Any, calendar: Any, cells: Any) -> None:
    """Enter every ball in its cell and its bin, which are empty in a restored system."""
    plans = balls.plans
    for i in range(balls.motions.shape[0]):
        insert_ball(cells, plans[i], i)
    if system.planned == system.balls:
        rebuild(plans, calendar, system.bin_width, system.bins, system.bin)


@kernel
def synchronize(system: Any, grid: Any, motions: Any) -> None:
    """Move every ball to the time of the system (in a copy: a run that goes on needs the balls as they are)."""
    for i in range(motions.shape[0]):
        free_flight(grid, motions[i], system.now)


@hot_kernel
def _cross_border(
    features: Any, grid: Any, cells: Any, averages: Any, species: Any, ball: Any, plan: Any, i: int, which: int, cell: int,
    now: float,
) -> None:  # fmt: skip
    """Move ball i on to the next cell."""
    axis, up = which >> 1, which & 1
    remove_ball(cells, plan, i)
    index = cell + (1 if up else -1)
    n = grid.cells[U64(axis)]
    turns = 1 if index >= n else (-1 if index < 0 else 0)
    index -= turns * n
    shift = turns * grid.side[U64(axis)]
    if axis == 0:
        plan.cx = index
        ball.x -= shift
    elif axis == 1:
        if features is not None:
            cross_sheared_border(features.shear, grid, averages, species, ball, plan, turns, now)
        plan.cy = index
        ball.y -= shift
    else:
        plan.cz = index
        ball.z -= shift
    if turns != 0:
        plan.image[axis] += turns
    insert_ball(cells, plan, i)


@kernel
def _start_calendar(features: Any, system: Any, plans: Any, calendar: Any) -> None:
    """Set the width of the bins by the first events of all balls, and fill the calendar."""
    total, count = 0.0, 0
    plans[system.balls].event_time = next_kick_time(features, system, system.now)
    for i in range(system.balls):
        if plans[i].event_time < math.inf:
            total += plans[i].event_time - system.now
            count += 1
    # one event per bin, if the waiting times stay as they are
    system.bin_width = total / count / system.balls if total > 0 else 1.0
    rebuild(plans, calendar, system.bin_width, system.bins, 0)


@hot_kernel
def _is_interior(grid: Any, cx: int, cy: int, cz: int) -> bool:
    """Return whether a cell is in the block that no wall reaches."""
    interior = grid.interior
    x = (cx >= interior[U64(0)]) & (cx <= interior[U64(1)])
    y = (cy >= interior[U64(2)]) & (cy <= interior[U64(3)])
    return bool(x & y & (cz >= interior[U64(4)]) & (cz <= interior[U64(5)]))


@hot_kernel
def _next_border_or_wall(
    features: Any, system: Any, grid: Any, walls: Any, flat: bool, ball: Any, plan: Any, now: float
) -> tuple[float, int]:
    """Return when a ball at its position of now leaves its cell or reaches a wall, and which of its cell's faces or wall it is."""
    crossing, which = next_cell_crossing(grid, flat, ball, plan, now)
    if not _is_interior(grid, I64(plan.cx), I64(plan.cy), I64(plan.cz)):
        crossing, which = next_wall_collision(features, system, grid.gravity, walls, ball, plan, now, crossing, which)
    return crossing, which


@kernel
def _predict_piston_again(
    features: Any, system: Any, grid: Any, walls: Any, balls: Any, calendar: Any, flat: bool, w: int, now: float, width: float,
    bins: int, current: int,
) -> None:  # fmt: skip
    """Predict the collisions of all balls with walls again, after one has changed the motion of piston w."""
    motions, plans, cells = balls.motions, balls.plans, walls.cell_sets
    for k in range(system.balls):
        plan = plans[U64(k)]
        first = I64(cells[U64((plan.cz * system.cells[1] + plan.cy) * system.cells[0] + plan.cx)])
        touches = False
        for m in range(1, I64(walls.sets[U64(first)]) + 1):
            touches = touches or I64(walls.sets[U64(first + m)]) == w
        if not touches:
            continue
        if nearly_full(calendar):
            rebuild(plans, calendar, width, bins, current)
        unschedule(plans, calendar, k)
        free_flight(grid, motions[U64(k)], now)
        crossing, which = _next_border_or_wall(features, system, grid, walls, flat, motions[U64(k)], plan, now)
        plan.boundary = which
        plan.event_time = min(plan.collision_time, crossing)
        schedule(plans, calendar, k, width, bins, current)


@kernel
def _reads_bodies(system: Any, pairs: Any) -> bool:
    """Return whether collisions of balls read their spins or last contacts."""
    rough = system.contact_time > 0.0
    for k in range(pairs.shape[0]):
        rough = rough or pairs[k].smooth == 0 or pairs[k].e < 1.0
    return rough  # type: ignore[no-any-return]


@hot_kernel
def _has_collapsed(system: Any, body: Any, now: float) -> bool:
    """Return whether a ball has had so many feeble contacts in quick succession that they will never end."""
    ahead = body.last_contact - now
    return system.contact_time == 0.0 and ahead > PATIENCE * QUICK * system.bin_width * system.balls  # type: ignore[no-any-return]


@kernel
def run(  # noqa: PLR0915  (the loop)
    system: Any, balls: Any, materials: Any, walls: Any, averages: Any, calendar: Any, cells: Any, grid: Any, near: Any,
    scratch: Any, until: float, max_collisions: int, max_steps: int, features: Any,
) -> int:  # fmt: skip
    """Process events until a time (later ones stay planned), or until so many more collisions, with walls included, or steps.

    A step is any event, or the first prediction for a ball: most of a dilute gas's events are borders of cells.

    The first ten arguments are :class:`carom.gas.edmd.driver.GasArrays`. Returns why it ended, one of the codes in
    :mod:`carom.gas.edmd.gas_records`.
    """
    motions, plans, species, pairs, heads = (
        balls.motions,
        balls.plans,
        materials.species,
        materials.pairs,
        calendar.heads,
    )
    count, bins, width, now = system.balls, system.bins, system.bin_width, system.now
    current, events, planned = system.bin, system.events, system.planned
    end = (until - system.base) - system.rest
    last = system.pair_collisions + system.wall_collisions + max_collisions
    flat, threshold, scale, growth = system.dimensions == 2, system.threshold, system.scale, system.growth
    far, spins = count > CACHED_BALLS, _reads_bodies(system, pairs)
    bodies, layered = balls.bodies, averages.whole[0].axis
    status, steps = LIMIT, 0
    ahead, moved = (0, 0, 0), -1
    while system.pair_collisions + system.wall_collisions < last and status == LIMIT and steps < max_steps:
        steps += 1
        # the balls to predict for, and which of the cells around are searched: all, or the cells that come within reach
        i, j = planned, NO_BALL
        x0, x1, y0, y1, z0, z1 = 0, 3, 0, 3, 0, 3
        if flat:
            z0, z1 = 1, 2
        crossed = False
        if planned == count:
            if nearly_full(calendar):
                ahead = (0, 0, 0)
                rebuild(plans, calendar, width, bins, current)
            while current < bins and heads[U64(current & (RING - 1))] == NO_BALL:
                current += 1
                page = page_of(current)
                if current & (PAGE - 1) == 0 and (page + 1) * PAGE < bins:
                    load_page(plans, calendar, page + 1)
                    ahead = page_ends_ahead(calendar.page_ends, page, bins)
                if far:
                    ahead = prefetch_ahead(flat, spins, grid, balls, cells, calendar.blocks, page, ahead)
            if current == bins:
                if width * bins > end:
                    status = DONE
                    break
                now = max(now, width * bins)
                system.now, system.events = now, events
                if features is None:
                    energy = close_cycle(grid, balls, species, averages, width * bins, None, True)
                else:
                    energy = close_cycle(grid, balls, species, averages, width * bins, features.shear, True)
                    slide_images(features.shear, grid, width * bins)
                set_threshold(system, species, energy)
                start_cycle(system, balls, walls.faces)
                if far and system.cycles % SORT_INTERVAL == 0:
                    sort_by_cell(balls, scratch, cells, calendar)
                rebuild(plans, calendar, system.bin_width, bins, 0)
                ahead = (0, 0, 0)
                status = check_progress(motions, plans, species, events)
                if remove_momentum_drift(system, grid, motions, species):
                    planned = 0
                current, events, width, now = 0, 0, system.bin_width, system.now
                threshold, scale = system.threshold, system.scale
                system.progress_time = now
                system.progress_collisions = system.pair_collisions + system.wall_collisions
                end = (until - system.base) - system.rest
                continue
            i = I64(heads[U64(current & (RING - 1))])
            at = plans[U64(i)].event_time
            k = plans[U64(i)].next
            while k != NO_BALL:
                t = plans[U64(k)].event_time
                if t < at or (t == at and k < i):
                    i, at = I64(k), t
                k = plans[U64(k)].next
            if at > end:
                status = DONE
                break
            events += 1
            now = max(now, at)
            unschedule(plans, calendar, i)
            kicked = i == count
            if features is not None and kicked:
                plans[U64(i)].event_time = next_kick_time(features, system, now)
                schedule(plans, calendar, i, width, bins, current)
                i = I64(draw_ball(system))
                unschedule(plans, calendar, i)
            ball, plan = motions[U64(i)], plans[U64(i)]
            if features is not None:
                note_flight(features.shear, grid, averages, species, ball, now)
                note_carried_heat(features.heat, species, ball, bodies[U64(i)], now)
                note_turning(features.turned, I64(balls.numbers[U64(i)]), ball, bodies[U64(i)], now)
            free_flight(grid, ball, now)
            if features is not None and kicked:
                thermostat_kick(features, system, grid, averages, species, ball, bodies[U64(i)], plan, now)
            elif plan.collision_time == at:
                k = plan.partner
                if motions[U64(k)].collisions == plan.partner_collisions:
                    j = I64(k)
                    if features is not None:
                        note_flight(features.shear, grid, averages, species, motions[U64(j)], now)
                        note_carried_heat(features.heat, species, motions[U64(j)], bodies[U64(j)], now)
                        note_turning(features.turned, I64(balls.numbers[U64(j)]), motions[U64(j)], bodies[U64(j)], now)
                    free_flight(grid, motions[U64(j)], now)
                    collide_balls(features, system, grid, balls, materials, averages, i, j, now)
                    system.pair_collisions += 1
                    unschedule(plans, calendar, j)
                    if spins and (
                        _has_collapsed(system, bodies[U64(i)], now) or _has_collapsed(system, bodies[U64(j)], now)
                    ):
                        status = COLLAPSED
                else:
                    system.invalidated += 1
            else:
                which = I64(plan.boundary)
                if which < FIRST_WALL:
                    crossed = True
                    system.crossings += 1
                    axis, up = which >> 1, which & 1
                    cell = plan.cx if axis == 0 else (plan.cy if axis == 1 else plan.cz)
                    _cross_border(features, grid, cells, averages, species, ball, plan, i, which, I64(cell), now)
                    if layered == axis:
                        after = plan.cx if axis == 0 else (plan.cy if axis == 1 else plan.cz)
                        note_crossing(averages, grid, species, ball, bodies[U64(i)], I64(cell), I64(after), now)
                    if axis == 0:
                        x0, x1 = 2 * up, 2 * up + 1
                    elif axis == 1:
                        y0, y1 = 2 * up, 2 * up + 1
                        if features is not None:
                            y0, y1 = rows_after_border(features.shear, grid, I64(cell), I64(plan.cy), y0, y1)
                    else:
                        z0, z1 = 2 * up, 2 * up + 1
                elif which != PREDICT_AGAIN:
                    collide_wall(
                        features,
                        system,
                        grid,
                        walls,
                        averages,
                        species,
                        ball,
                        bodies[U64(i)],
                        plan,
                        which - FIRST_WALL,
                        now,
                    )
                    if features is not None and walls.faces[U64(which - FIRST_WALL)].mass > 0.0:
                        moved = which - FIRST_WALL
                    if _has_collapsed(system, bodies[U64(i)], now):
                        status = COLLAPSED
            collisions = system.pair_collisions + system.wall_collisions
            if now - system.progress_time > STILL_SHARE * width:
                system.progress_time, system.progress_collisions = now, collisions
            elif collisions - system.progress_collisions > STILL_PER_BALL * count + STILL_COLLISIONS:
                status = COLLAPSED
        while True:
            ball, plan = motions[U64(i)], plans[U64(i)]
            block = Block(I64(plan.cx), I64(plan.cy), I64(plan.cz), x0, x1, y0, y1, z0, z1)
            within = block
            if features is not None:
                within = within_border(features.shear, grid, block)
            n = gather_neighbours(cells, near.found, within)
            set_images(cells.shifts, near.images, block, ball.x, ball.y, ball.z)
            hit, partner = earliest_collision(
                grid, system, motions, pairs, near, n, i, now, threshold, scale + growth * now, growth, features
            )
            if features is not None:
                hit, partner = earliest_across(
                    features.shear, grid, system, motions, pairs, cells, near, block, i, now, hit, partner
                )
            # an earlier prediction stands where the ball has only crossed a border
            if not crossed or hit < plan.collision_time:
                plan.collision_time, plan.partner = hit, partner
                if partner != NO_BALL:
                    plan.partner_collisions = motions[U64(partner)].collisions
            crossing, which = _next_border_or_wall(features, system, grid, walls, flat, ball, plan, now)
            plan.boundary = which
            plan.event_time = min(plan.collision_time, crossing)
            if planned < count:
                planned += 1
                if planned == count:
                    _start_calendar(features, system, plans, calendar)
                    width = system.bin_width
                break
            schedule(plans, calendar, i, width, bins, current)
            if j == NO_BALL:
                break
            i, j = j, NO_BALL
        if features is not None and moved >= 0:
            _predict_piston_again(
                features, system, grid, walls, balls, calendar, flat, moved, now, width, bins, current
            )
            moved, ahead = -1, (0, 0, 0)
    system.bin, system.now, system.events, system.planned, system.status = current, now, events, planned, status
    return status
