"""Event loop of a gas: event-driven molecular dynamics with a cell list and a calendar queue.

One event per ball is planned: its earliest collision, or the crossing of its cell's border. A collision is stored with the ball
that predicted it; that is enough, for of two balls one was the last to be updated. A ball whose partner has collided with another
meanwhile predicts again when the planned time comes. Ties go to the ball with the lowest index, so the same start gives the same
bits.
"""

from __future__ import annotations

import math
from typing import Any

from carom.core.jit.kernel import hot_kernel, kernel
from carom.gas.edmd.averages import close_cycle, note_carried_heat, note_crossing, note_flight, note_turning
from carom.gas.edmd.calendar import (
    I64,
    PAGE,
    RING,
    U64,
    load_page,
    nearly_full,
    page_of,
    rebuild,
    schedule,
    start_cycle,
    unschedule,
)
from carom.gas.edmd.cell_lists import Block, cell_index, gather_neighbours, insert_ball, remove_ball, set_images
from carom.gas.edmd.collisions import (
    PATIENCE,
    QUICK,
    collide_balls,
    earliest_collision,
    free_flight,
    next_cell_crossing,
)
from carom.gas.edmd.gas_records import COLLAPSED, DONE, LIMIT, NO_BALL
from carom.gas.edmd.housekeeping import (
    SORT_INTERVAL,
    check_progress,
    remove_momentum_drift,
    set_threshold,
    sort_by_cell,
)
from carom.gas.edmd.prefetch import page_ends_ahead, prefetch_ahead
from carom.gas.edmd.shear import cross_sheared_border, earliest_across, slide_images, within_border
from carom.gas.edmd.walls import (
    FIRST_WALL,
    PREDICT_AGAIN,
    collide_wall,
    draw_ball,
    next_kick_time,
    next_wall_collision,
    thermostat_kick,
)

__all__ = ["fill_cells", "restore_lists", "run", "synchronize"]


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
