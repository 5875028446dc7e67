"""Balls in the order in which their cells lie in memory, renewed now and then.

Those that are near each other in the room are near in memory then, and what is fetched for one is there for the next. ``numbers``
says which ball it is that lies at each place: whoever looks at balls from outside sees them by number.
"""

from __future__ import annotations

from typing import Any

from carom.engine.cells import NUMBERS, SLOTS, put_in_cell
from carom.engine.queue import S, U
from carom.engine.swarm_arrays import CODES, NOBODY
from carom.kernel import kernel

__all__ = ["EVERY", "put_in_order"]

EVERY = 8  # turns of the calendar: some 30 collisions a ball, in which it goes as far as it is wide


@kernel
def _along_the_cells(cells: Any, links: Any, order: Any) -> None:
    """The places of all balls, cell by cell; in a cell the lowest first, whatever came into it first."""
    n = 0
    for first in range(0, cells.shape[0], SLOTS):
        count = S(cells[U(first)]) >> CODES
        if count == 0:
            continue
        begin = n
        order[U(n)] = cells[U(first)] & NUMBERS
        n += 1
        k = S(cells[U(first + 1)]) if count > 1 else NOBODY
        while k != NOBODY:
            order[U(n)] = k
            n += 1
            k = S(links[U(k)]) if count > SLOTS else NOBODY
        for a in range(begin + 1, n):
            one, b = order[U(a)], a
            while b > begin and order[U(b - 1)] > one:
                order[U(b)] = order[U(b - 1)]
                b -= 1
            order[U(b)] = one


@kernel
def _move(motions: Any, plans: Any, bodies: Any, numbers: Any, spare: Any, order: Any) -> None:
    """Put what lies at place ``order[k]`` at k, for all k, round by round; then order[k] is k. ``spare`` holds a ball meanwhile."""
    motion, plan, body, number = spare
    for start in range(order.shape[0]):
        if order[U(start)] == start:
            continue
        motion[0], plan[0], body[0], number[0] = motions[start], plans[start], bodies[start], numbers[start]
        k, source = S(start), S(order[U(start)])
        while source != start:
            motions[k], plans[k], bodies[k], numbers[k] = (
                motions[source],
                plans[source],
                bodies[source],
                numbers[source],
            )
            order[U(k)] = k
            k, source = source, S(order[U(source)])
        motions[k], plans[k], bodies[k], numbers[k] = motion[0], plan[0], body[0], number[0]
        order[U(k)] = k


@kernel
def put_in_order(
    motions: Any, plans: Any, bodies: Any, numbers: Any, spare: Any, cells: Any, links: Any, offsets: Any, leaves: Any
) -> None:
    """Put the balls in order. Notes in the calendar are void then: it has to be filled anew."""
    count = numbers.shape[0]
    order = leaves[:count]
    _along_the_cells(cells, links, order)
    for k in range(count):
        links[U(order[U(k)])] = k  # where it will be
    for k in range(count):
        plan = plans[U(k)]
        if plan.hit_who != NOBODY:
            plan.hit_who = links[U(plan.hit_who)]
    _move(motions, plans, bodies, numbers, spare, order)
    cells[:] = 0
    for k in range(count):
        put_in_cell(offsets, cells, links, plans[U(k)], k)
