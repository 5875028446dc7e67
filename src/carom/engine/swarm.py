"""Many flying balls: the event loop, with cells and a calendar. Exact, as :mod:`carom.engine.loop` is.

One event a ball is planned: its earliest collision, or its way out of its cell. A collision stands with the ball that found
it; that is enough, for of two balls one was the last to look. A ball whose partner has met another meanwhile looks again
when the planned time comes. Ties go to the ball that lies first, so the same start gives the same bits.
"""

from __future__ import annotations

import math
from typing import Any

from carom.engine.cells import around, cell_of, gather, leave_cell, put_in_cell
from carom.engine.queue import PAGE, RING, S, U, enqueue, fill, full, open_page, page_of, take_out, turn_over
from carom.engine.swarm_arrays import CALM, DONE, LIMIT, NOBODY, STUCK
from carom.engine.swarm_order import EVERY, put_in_order
from carom.engine.swarm_predict import drift, next_turn, soonest
from carom.engine.swarm_prefetch import look_ahead, next_pages
from carom.engine.swarm_resolve import meet
from carom.engine.swarm_turn import left_to_come, sample, set_slow, settle
from carom.engine.swarm_walls import FIRST_WALL, LOOK, kick, meet_wall, next_wall, wait_for_kick, whom_to_kick
from carom.kernel import hot_kernel, kernel

__all__ = ["bring_to_now", "place", "refill", "run"]


# So many balls are near enough in the processor's caches; of more, the next ones are asked for ahead.
NEAR_BALLS = 10_000
# Collisions within a share of a bin of the calendar, a ball and beyond that, after which time is said to stand still.
STILL, STILL_HITS, STILL_MORE = 1e-9, 100, 100_000


@kernel
def place(
    swarm: Any, box: Any, grid: Any, motions: Any, plans: Any, species: Any, cells: Any, links: Any, offsets: Any
) -> None:
    """Put every ball into its cell."""
    settle(swarm, box, motions, species)
    energy = 0.0
    for i in range(motions.shape[0]):
        plan, ball = plans[i], motions[i]
        energy += species[ball.kind].mass * (ball.vx * ball.vx + ball.vy * ball.vy + ball.vz * ball.vz)
        plan.cx = cell_of(box, grid, 0, ball.x)
        plan.cy = cell_of(box, grid, 1, ball.y)
        plan.cz = cell_of(box, grid, 2, ball.z)
        put_in_cell(offsets, cells, links, plan, i)
    set_slow(swarm, species, energy)


@kernel
def refill(
    swarm: Any, motions: Any, plans: Any, heads: Any, tails: Any, leaves: Any, cells: Any, links: Any, offsets: Any
) -> None:
    """Put every ball into the cell and the bin that it is in: those of a swarm that is restored are empty."""
    for i in range(motions.shape[0]):
        put_in_cell(offsets, cells, links, plans[i], i)
    if swarm.planned == swarm.count:
        fill(plans, heads, tails, leaves, swarm.width, swarm.bins, swarm.bin)


@hot_kernel
def _cross(
    box: Any, grid: Any, ball: Any, plan: Any, cells: Any, links: Any, offsets: Any, i: int, which: int, place: int
) -> None:
    """Ball i goes on to the next cell."""
    axis, up = which >> 1, which & 1
    leave_cell(offsets, cells, links, plan, i)
    there = place + (1 if up else -1)
    n = grid[U(axis)]
    rounds = 1 if there >= n else (-1 if there < 0 else 0)
    there -= rounds * n
    shift = rounds * box[U(axis)]
    if axis == 0:
        plan.cx = there
        ball.x -= shift
    elif axis == 1:
        plan.cy = there
        ball.y -= shift
    else:
        plan.cz = there
        ball.z -= shift
    if rounds != 0:
        plan.image[axis] += rounds
    put_in_cell(offsets, cells, links, plan, i)


@kernel
def _begin(more: Any, swarm: Any, plans: Any, heads: Any, tails: Any, leaves: Any) -> None:
    """All balls have their first event: set the calendar's width by them, and fill it."""
    total, count = 0.0, 0
    plans[swarm.count].at = wait_for_kick(more, swarm, swarm.now)
    for i in range(swarm.count):
        if plans[i].at < math.inf:
            total += plans[i].at - swarm.now
            count += 1
    # one event a bin, if the waits go on as they begin
    swarm.width = total / count / swarm.count if total > 0 else 1.0
    fill(plans, heads, tails, leaves, swarm.width, swarm.bins, 0)


@kernel
def bring_to_now(swarm: Any, box: Any, motions: Any) -> None:
    """Bring every ball forward to the swarm's time (for a look at it: a run that goes on is given the balls as they are)."""
    for i in range(motions.shape[0]):
        drift(box, motions[i], swarm.now)


@hot_kernel
def _calm(grid: Any, cx: int, cy: int, cz: int) -> bool:
    """Whether a cell is in the block that no wall is near."""
    x = (cx >= grid[U(CALM)]) & (cx <= grid[U(CALM + 1)])
    y = (cy >= grid[U(CALM + 2)]) & (cy <= grid[U(CALM + 3)])
    return bool(x & y & (cz >= grid[U(CALM + 4)]) & (cz <= grid[U(CALM + 5)]))


@kernel
def _turns(swarm: Any, pairs: Any) -> bool:
    """Whether collisions read more of a ball than its motion."""
    rough = swarm.soft > 0.0
    for k in range(pairs.shape[0]):
        rough = rough or pairs[k].smooth == 0
    return rough  # type: ignore[no-any-return]


@kernel
def run(  # noqa: PLR0915  (the loop)
    swarm: Any, motions: Any, plans: Any, bodies: Any, numbers: Any, species: Any, pairs: Any, walls: Any, faces: Any, heads: Any,
    tails: Any, leaves: Any, spare: Any,
    box: Any, grid: Any, lists: Any, sets: Any, cells: Any, links: Any, offsets: Any, shifts: Any, found: Any, near: Any, work: Any,
    whole: Any, until: float, most: int, more: Any,
) -> int:  # fmt: skip
    """Let things happen until a time (events after it stay planned), or until so many collisions more, walls included."""
    count, bins, width, now = swarm.count, swarm.bins, swarm.width, swarm.now
    current, popped, planned = swarm.bin, swarm.popped, swarm.planned
    end = (until - swarm.base) - swarm.rest
    last = swarm.pair_hits + swarm.wall_hits + most
    flat, kinds, slow, scale, growth = swarm.axes == 2, swarm.kinds, swarm.slow, swarm.scale, swarm.growth
    rb, ru, rc, times = work[0], work[1], work[2], work[3]
    bits = whole[3]
    far, spins = count > NEAR_BALLS, _turns(swarm, pairs)
    virial = swarm.virial  # (summed on, so that the sum is the same in one piece or in many)
    status = LIMIT
    ahead = (0, 0, 0)
    while swarm.pair_hits + swarm.wall_hits < last and status == LIMIT:
        # whose next event is to be planned, and which cells around are to be searched: all, or those that come into reach
        i, j = planned, NOBODY
        x0, x1, y0, y1, z0, z1 = 0, 3, 0, 3, 0, 3
        if flat:
            z0, z1 = 1, 2
        again = False
        if planned == count:
            if full(tails):
                ahead = (0, 0, 0)
                fill(plans, heads, tails, leaves, width, bins, current)
            while current < bins and heads[U(current & (RING - 1))] == NOBODY:
                current += 1
                page = page_of(current)
                if current & (PAGE - 1) == 0 and (page + 1) * PAGE < bins:
                    open_page(plans, heads, tails, leaves, page + 1)
                    ahead = next_pages(tails, page, bins)
                if far:
                    ahead = look_ahead(flat, spins, grid, motions, plans, bodies, cells, offsets, leaves, page, ahead)
            if current == bins:
                if width * bins > end:
                    status = DONE
                    break
                now = max(now, width * bins)
                swarm.now, swarm.popped = now, popped
                sample(swarm, box, motions, bodies, species, now)
                turn_over(swarm, motions, plans, bodies, faces)
                if far and swarm.turns % EVERY == 0:
                    put_in_order(motions, plans, bodies, numbers, spare, cells, links, offsets, leaves)
                fill(plans, heads, tails, leaves, swarm.width, bins, 0)
                ahead = (0, 0, 0)
                status = left_to_come(swarm, motions, plans, species, popped)
                if settle(swarm, box, motions, species):
                    planned = 0
                current, popped, width, now, slow, scale = 0, 0, swarm.width, swarm.now, swarm.slow, swarm.scale
                swarm.mark, swarm.since = now, swarm.pair_hits + swarm.wall_hits
                end = (until - swarm.base) - swarm.rest
                continue
            i = S(heads[U(current & (RING - 1))])
            at = plans[U(i)].at
            k = plans[U(i)].next
            while k != NOBODY:
                t = plans[U(k)].at
                if t < at or (t == at and k < i):
                    i, at = S(k), t
                k = plans[U(k)].next
            if at > end:
                status = DONE
                break
            popped += 1
            now = max(now, at)
            take_out(plans, heads, i)
            kicked = i == count
            # (what ``more`` is: see swarm_walls)
            if more is not None and kicked:
                plans[U(i)].at = wait_for_kick(more, swarm, now)
                enqueue(plans, heads, tails, leaves, i, width, bins, current)
                i = S(whom_to_kick(swarm))
                take_out(plans, heads, i)
            ball, plan = motions[U(i)], plans[U(i)]
            drift(box, ball, now)
            if more is not None and kicked:
                kick(swarm, species, ball, bodies[U(i)])
            elif plan.hit_at == at:
                k = plan.hit_who
                if motions[U(k)].count == plan.hit_count:
                    j = S(k)
                    drift(box, motions[U(j)], now)
                    virial += meet(swarm, box, grid, motions, bodies, species, pairs, i, j, now)
                    swarm.pair_hits += 1
                    take_out(plans, heads, j)
                else:
                    swarm.overtaken += 1
            else:
                which = S(plan.turn)
                if which < FIRST_WALL:
                    again = True
                    swarm.crossings += 1
                    axis, up = which >> 1, which & 1
                    place = plan.cx if axis == 0 else (plan.cy if axis == 1 else plan.cz)
                    _cross(box, grid, ball, plan, cells, links, offsets, i, which, S(place))
                    if axis == 0:
                        x0, x1 = 2 * up, 2 * up + 1
                    elif axis == 1:
                        y0, y1 = 2 * up, 2 * up + 1
                    else:
                        z0, z1 = 2 * up, 2 * up + 1
                elif which != LOOK:
                    meet_wall(more, swarm, box, faces, walls, species, ball, bodies[U(i)], which - FIRST_WALL, now)
            if now - swarm.mark > STILL * width:
                swarm.mark, swarm.since = now, swarm.pair_hits + swarm.wall_hits
            elif swarm.pair_hits + swarm.wall_hits - swarm.since > STILL_HITS * count + STILL_MORE:
                status = STUCK
        while True:
            ball, plan = motions[U(i)], plans[U(i)]
            cx, cy, cz = plan.cx, plan.cy, plan.cz
            n = gather(cells, links, offsets, found, cx, cy, cz, x0, x1, y0, y1, z0, z1)
            around(shifts, near, cx, cy, cz, ball.x, ball.y, ball.z)
            hit, who = soonest(
                box,
                kinds,
                slow,
                motions,
                pairs,
                found,
                near,
                rb,
                ru,
                rc,
                times,
                bits,
                n,
                i,
                now,
                scale + growth * now,
                growth,
                more,
            )
            # what was found before stands, where the ball only goes on
            if not again or hit < plan.hit_at:
                plan.hit_at, plan.hit_who = hit, who
                if who != NOBODY:
                    plan.hit_count = motions[U(who)].count
            turn, which = next_turn(box, grid, flat, ball, plan, now)
            if not _calm(grid, cx, cy, cz):
                turn, which = next_wall(more, swarm, box, faces, walls, lists, sets, ball, plan, now, turn, which)
            plan.turn = which
            plan.at = min(plan.hit_at, turn)
            if planned < count:
                planned += 1
                if planned == count:
                    _begin(more, swarm, plans, heads, tails, leaves)
                    width = swarm.width
                break
            enqueue(plans, heads, tails, leaves, i, width, bins, current)
            if j == NOBODY:
                break
            i, j = j, NOBODY
    swarm.virial = virial
    swarm.bin, swarm.now, swarm.popped, swarm.planned, swarm.status = current, now, popped, planned, status
    return status
