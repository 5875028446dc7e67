"""Many flying balls: the event loop, with cells and a calendar. Exact, as :mod:`carom.engine.loop` is.

One event a ball is planned: its earliest collision, or its way out of its cell. A collision stands with the ball that found
it; that is enough, for of two balls one was the last to look. A ball whose partner has met another meanwhile looks again
when the planned time comes. Ties go to the ball with the lower number, so the same start gives the same bits.
"""

from __future__ import annotations

import math
from typing import Any

from carom.engine.cells import around, cell_of, gather, leave_cell, put_in_cell
from carom.engine.queue import S, U, enqueue, fill, take_out, turn_over
from carom.engine.swarm_arrays import DONE, FULL, LIMIT, NOBODY
from carom.engine.swarm_predict import drift, next_turn, soonest
from carom.engine.swarm_resolve import meet, meet_wall
from carom.kernel import hot_kernel, kernel

__all__ = ["bring_to_now", "place", "refill", "run", "start"]


@kernel
def place(swarm: Any, motions: Any, bodies: Any, cells: Any) -> int:
    """Put every ball into its cell. DONE, or FULL: the cells need more slots."""
    for k in range(cells.shape[0]):
        cells[k] = 0
    for i in range(motions.shape[0]):
        body, ball = bodies[i], motions[i]
        body.cell[0] = cell_of(swarm, 0, ball.x)
        body.cell[1] = cell_of(swarm, 1, ball.y)
        body.cell[2] = cell_of(swarm, 2, ball.z)
        if not put_in_cell(swarm, cells, body, i):
            return FULL
    return DONE


@kernel
def refill(swarm: Any, bodies: Any, cells: Any) -> int:
    """Put every ball into the cell that it is in, after the cells got more slots."""
    for k in range(cells.shape[0]):
        cells[k] = 0
    for i in range(bodies.shape[0]):
        if not put_in_cell(swarm, cells, bodies[i], i):
            return FULL
    return DONE


@hot_kernel
def _plan_all(
    swarm: Any, motions: Any, plans: Any, bodies: Any, species: Any, pairs: Any, cells: Any, offsets: Any, shifts: Any,
    found: Any, times: Any, near: Any, i: int, now: float,
) -> None:  # fmt: skip
    """Plan the next event of ball i, brought forward to now: look at all cells around it."""
    ball, body, plan = motions[U(i)], bodies[U(i)], plans[U(i)]
    cx, cy, cz = body.cell[0], body.cell[1], body.cell[2]
    z0, z1 = (0, 3) if swarm.axes == 3 else (1, 2)
    n = gather(cells, offsets, found, cx, cy, cz, 0, 3, 0, 3, z0, z1)
    around(shifts, near, cx, cy, cz, ball.x, ball.y, ball.z)
    hit, who = soonest(swarm, motions, pairs, found, times, near, n, i, swarm.kinds, now)
    plan.hit_at, plan.hit_who = hit, who
    if who != NOBODY:
        plan.hit_count = motions[U(who)].count
    turn, which = next_turn(swarm, ball, body, species[U(ball.kind)].radius, now)
    plan.turn = which
    plan.at = min(hit, turn)


@hot_kernel
def _cross(swarm: Any, ball: Any, body: Any, cells: Any, i: int, which: int) -> bool:
    """Ball i goes on to the next cell; False if that is full, and then nothing has changed but the cell it is in."""
    axis, up = which >> 1, which & 1
    leave_cell(swarm, cells, body, i)
    there = body.cell[axis] + (1 if up else -1)
    n = swarm.cells[axis]
    round_ = 1 if there >= n else (-1 if there < 0 else 0)
    body.cell[axis] = there - round_ * n
    if round_ != 0:
        body.image[axis] += round_
        shift = round_ * swarm.side[axis]
        if axis == 0:
            ball.x -= shift
        elif axis == 1:
            ball.y -= shift
        else:
            ball.z -= shift
    return put_in_cell(swarm, cells, body, i)


@hot_kernel
def _plan_face(
    swarm: Any, motions: Any, plans: Any, bodies: Any, species: Any, pairs: Any, cells: Any, offsets: Any, shifts: Any,
    found: Any, times: Any, near: Any, i: int, which: int, now: float,
) -> None:  # fmt: skip
    """Plan the next event of ball i, which has just come into its cell: only what lies ahead is new to it."""
    ball, body, plan = motions[U(i)], bodies[U(i)], plans[U(i)]
    cx, cy, cz = body.cell[0], body.cell[1], body.cell[2]
    x0, x1, y0, y1, z0, z1 = 0, 3, 0, 3, 0, 3
    if swarm.axes != 3:
        z0, z1 = 1, 2
    axis, ahead = which >> 1, 2 * (which & 1)
    if axis == 0:
        x0, x1 = ahead, ahead + 1
    elif axis == 1:
        y0, y1 = ahead, ahead + 1
    else:
        z0, z1 = ahead, ahead + 1
    n = gather(cells, offsets, found, cx, cy, cz, x0, x1, y0, y1, z0, z1)
    around(shifts, near, cx, cy, cz, ball.x, ball.y, ball.z)
    hit, who = soonest(swarm, motions, pairs, found, times, near, n, i, swarm.kinds, now)
    if hit < plan.hit_at:
        plan.hit_at, plan.hit_who = hit, who
        plan.hit_count = motions[U(who)].count
    turn, which = next_turn(swarm, ball, body, species[U(ball.kind)].radius, now)
    plan.turn = which
    plan.at = min(plan.hit_at, turn)


@kernel
def start(
    swarm: Any, motions: Any, plans: Any, bodies: Any, species: Any, pairs: Any, cells: Any, offsets: Any, shifts: Any,
    heads: Any, found: Any, times: Any, near: Any,
) -> None:  # fmt: skip
    """Plan the first event of every ball, and set the calendar's width by them."""
    now = swarm.now
    total, count = 0.0, 0
    for i in range(motions.shape[0]):
        _plan_all(swarm, motions, plans, bodies, species, pairs, cells, offsets, shifts, found, times, near, i, now)
        wait = plans[i].at - now
        if wait < math.inf:
            total += wait
            count += 1
    # one event a bin, if the balls' waits go on as they begin
    swarm.width = max(total, 1e-300) / max(count, 1) / swarm.count if total > 0 else 1.0
    fill(swarm, plans, heads)


@kernel
def bring_to_now(swarm: Any, motions: Any) -> None:
    """Bring every ball forward to the swarm's time (for a look at it: a run that goes on is given the balls as they are)."""
    for i in range(motions.shape[0]):
        drift(swarm, motions[i], swarm.now)


@hot_kernel
def _sample(swarm: Any, motions: Any, bodies: Any, species: Any, now: float) -> None:
    """Add twice the translational and the rotational energy of now to the sums."""
    translational, rotational = 0.0, 0.0
    for i in range(motions.shape[0]):
        ball, body = motions[i], bodies[i]
        one = species[ball.kind]
        s = now - ball.clock
        vx, vy, vz = ball.vx + swarm.pull[0] * s, ball.vy + swarm.pull[1] * s, ball.vz + swarm.pull[2] * s
        w = body.w
        translational += one.mass * (vx * vx + vy * vy + vz * vz)
        rotational += one.mass * one.kappa * one.radius * one.radius * (w[0] * w[0] + w[1] * w[1] + w[2] * w[2])
    swarm.translational += translational
    swarm.rotational += rotational
    swarm.samples += 1


@kernel
def run(  # noqa: PLR0915  (the loop)
    swarm: Any, motions: Any, plans: Any, bodies: Any, species: Any, pairs: Any, walls: Any, cells: Any, offsets: Any,
    shifts: Any, heads: Any, found: Any, times: Any, near: Any, until: float, most: int,
) -> int:  # fmt: skip
    """Let things happen until a time (events after it stay planned), or until so many collisions more, walls included."""
    bins, width, now = swarm.bins, swarm.width, swarm.now
    current = swarm.bin
    popped = swarm.popped
    end = (until - swarm.base) - swarm.rest
    last = swarm.pair_hits + swarm.wall_hits + most
    virial = 0.0
    status = LIMIT
    while swarm.pair_hits + swarm.wall_hits < last:
        while current < bins and heads[U(current)] == NOBODY:
            current += 1
        if current == bins:
            if width * bins > end:
                status = DONE
                break
            swarm.now = max(now, width * bins)
            swarm.popped = popped
            _sample(swarm, motions, bodies, species, swarm.now)
            turn_over(swarm, motions, plans, bodies, heads)
            popped = 0
            current, width, now = 0, swarm.width, swarm.now
            end = (until - swarm.base) - swarm.rest
            continue
        i = S(heads[U(current)])
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
        ball, plan = motions[U(i)], plans[U(i)]
        drift(swarm, ball, now)
        take_out(plans, heads, i)
        if plan.hit_at == at:
            j = S(plan.hit_who)
            if motions[U(j)].count == plan.hit_count:
                drift(swarm, motions[U(j)], now)
                virial += meet(swarm, motions, bodies, species, pairs, i, j, now)
                swarm.pair_hits += 1
                take_out(plans, heads, j)
                _plan_all(
                    swarm, motions, plans, bodies, species, pairs, cells, offsets, shifts, found, times, near, j, now
                )
                enqueue(plans, heads, j, width, bins, current)
            else:
                swarm.overtaken += 1
            _plan_all(swarm, motions, plans, bodies, species, pairs, cells, offsets, shifts, found, times, near, i, now)
        else:
            body = bodies[U(i)]
            which = S(plan.turn)
            axis = which >> 1
            edge = swarm.cells[axis] - 1 if which & 1 else 0
            if not swarm.periodic[axis] and body.cell[axis] == edge:
                meet_wall(swarm, ball, body, species[U(ball.kind)], walls, which, now)
                _plan_all(
                    swarm, motions, plans, bodies, species, pairs, cells, offsets, shifts, found, times, near, i, now
                )
            else:
                swarm.crossings += 1
                if not _cross(swarm, ball, body, cells, i, which):
                    status = FULL
                _plan_face(
                    swarm,
                    motions,
                    plans,
                    bodies,
                    species,
                    pairs,
                    cells,
                    offsets,
                    shifts,
                    found,
                    times,
                    near,
                    i,
                    which,
                    now,
                )
        enqueue(plans, heads, i, width, bins, current)
        if status == FULL:
            break
    swarm.virial += virial
    swarm.bin, swarm.now, swarm.popped, swarm.status = current, now, popped, status
    return status
