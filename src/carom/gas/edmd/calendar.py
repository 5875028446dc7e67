"""Calendar queue: the event queue of the engine, a doubly linked list of balls per bin of time.

A binary heap costs log N steps through memory per event; a bin holds one or two balls, so the earliest event is found by
comparing them (G. Paul, J. Comput. Phys. 221, 615 (2007), has the idea). One cycle of the calendar is a
few events per ball; with each cycle all times are shifted to start at zero (:func:`start_cycle`), so they stay small and keep their
digits however long the run.

Only the bins of the current page and of the next exist: a few cache lines. A later event is entered in its page's unsorted
list, which is moved into bins when that page is next; events after the cycle are on one last page. To enter a ball is to append its
index, and to remove it is to leave the entry, which is stale once the ball's plan says otherwise. So nothing far away in
memory is read before an event is due.

A page's entries are in blocks of one cache line each; the first number of a block is where the block before ends. ``page_ends``
holds where the entries of each page end (0: it has none), then the first free block, then how many are free.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from carom.core.jit.kernel import hot_kernel, kernel
from carom.core.roots.polynomial import two_sum
from carom.gas.edmd.gas_records import NO_BALL

__all__ = [
    "BLOCK_LENGTH", "I64", "PAGE", "RING", "U64", "calendar_sizes", "is_pending", "load_page", "nearly_full", "page_of", "rebuild",
    "schedule", "start_cycle", "unschedule",
]  # fmt: skip

# An unsigned index needs no test whether it counts from the end; sums are done with signed integers (a signed and an unsigned
# one together become a float).
U64: Any = np.uint64
I64: Any = np.int64

PAGE_BITS = 5
PAGE = 1 << PAGE_BITS  # bins of a page
RING = 2 * PAGE  # bins that exist
BLOCK_LENGTH = 16  # numbers of a block
PENDING = 1 << 31  # flag of a plan's bin: the ball is not in the bin yet, only on its page
SPARE_BLOCKS = 4  # no more blocks than this are begun in one event


def calendar_sizes(balls: int, bins: int) -> tuple[int, int, int]:
    """Return the lengths of the three arrays of a Calendar: room for twice as many entries as balls."""
    pages = -(-bins // PAGE) + 1
    return RING, pages + 2, BLOCK_LENGTH * (pages + 2 * balls // (BLOCK_LENGTH - 1) + 2 + SPARE_BLOCKS)


@hot_kernel
def page_of(bin_: int) -> int:
    """Return the page of a bin."""
    return bin_ >> PAGE_BITS


@hot_kernel
def is_pending(plan: Any, page: int) -> bool:
    """Return whether a ball's entry on a page is valid and the ball is not in its bin yet."""
    return I64(plan.bin) >> PAGE_BITS == (page | PENDING >> PAGE_BITS)  # type: ignore[no-any-return]


@hot_kernel
def _push_to_bin(plans: Any, heads: Any, i: int, b: int) -> None:
    """Put ball i at the head of a bin's list."""
    plan = plans[U64(i)]
    k = b & (RING - 1)
    after = heads[U64(k)]
    plan.bin, plan.next, plan.previous = b, after, NO_BALL
    if after != NO_BALL:
        plans[U64(after)].previous = i
    heads[U64(k)] = i


@hot_kernel
def _append(calendar: Any, i: int, page: int) -> None:
    """Enter ball i on a page."""
    page_ends, blocks = calendar.page_ends, calendar.blocks
    end = I64(page_ends[U64(page)]) + 1
    if end & (BLOCK_LENGTH - 1) <= 1:  # its block is full, or it has none
        first = page_ends.shape[0] - 2
        block = I64(page_ends[U64(first)])
        page_ends[U64(first)] = blocks[U64(block)]
        page_ends[U64(first + 1)] -= np.uint32(1)
        blocks[U64(block)] = end - 1
        end = block + 1
    blocks[U64(end)] = i
    page_ends[U64(page)] = end


@hot_kernel
def schedule(plans: Any, calendar: Any, i: int, width: float, bins: int, current: int) -> None:
    """Put ball i into the bin of its next event, or on its page."""
    place = plans[U64(i)].event_time / width
    # (events after the cycle, and those that never happen, are on the last page)
    last = (calendar.page_ends.shape[0] - 3) * PAGE
    b = last if not place < bins else max(I64(place), current)
    page = page_of(b)
    if page <= page_of(current) + 1:
        _push_to_bin(plans, calendar.heads, i, b)
    else:
        plans[U64(i)].bin = b | PENDING
        _append(calendar, i, page)


@hot_kernel
def unschedule(plans: Any, calendar: Any, i: int) -> None:
    """Take ball i out of its bin; an entry on a page stays, and is stale once the ball is planned anew."""
    plan = plans[U64(i)]
    if plan.bin >= PENDING:
        return
    after, before = plan.next, plan.previous
    if after != NO_BALL:
        plans[U64(after)].previous = before
    if before != NO_BALL:
        plans[U64(before)].next = after
    else:
        calendar.heads[U64(plan.bin & (RING - 1))] = after


@kernel
def load_page(plans: Any, calendar: Any, page: int) -> None:
    """Move the balls entered on a page into their bins, and free its blocks."""
    page_ends, blocks = calendar.page_ends, calendar.blocks
    free = page_ends.shape[0] - 2
    end = I64(page_ends[U64(page)])
    page_ends[U64(page)] = 0
    while end != 0:
        while end & (BLOCK_LENGTH - 1) != 0:
            i = blocks[U64(end)]
            if is_pending(plans[U64(i)], page):
                _push_to_bin(plans, calendar.heads, I64(i), I64(plans[U64(i)].bin) - PENDING)
            end -= 1
        before = I64(blocks[U64(end)])
        blocks[U64(end)] = page_ends[U64(free)]
        page_ends[U64(free)] = end
        page_ends[U64(free + 1)] += np.uint32(1)
        end = before


@hot_kernel
def nearly_full(calendar: Any) -> bool:
    """Return whether so few blocks are free that stale entries have to go: :func:`rebuild`."""
    return calendar.page_ends[U64(calendar.page_ends.shape[0] - 1)] < SPARE_BLOCKS  # type: ignore[no-any-return]


@kernel
def rebuild(plans: Any, calendar: Any, width: float, bins: int, current: int) -> None:
    """Put all balls, and the thermostat, into their bins or on their pages; the current bin is the first."""
    heads, page_ends, blocks = calendar.heads, calendar.page_ends, calendar.blocks
    pages = page_ends.shape[0] - 2
    for k in range(RING):
        heads[U64(k)] = NO_BALL
    for k in range(pages):
        page_ends[U64(k)] = 0
    # (block 0 is unused: a page that ends there has no entries)
    count = blocks.shape[0] // BLOCK_LENGTH
    for k in range(count):
        blocks[U64(k * BLOCK_LENGTH)] = (k + 1) * BLOCK_LENGTH
    page_ends[U64(pages)] = BLOCK_LENGTH
    page_ends[U64(pages + 1)] = count - 1
    for i in range(plans.shape[0]):
        schedule(plans, calendar, i, width, bins, current)


@kernel
def start_cycle(system: Any, balls: Any, faces: Any) -> None:
    """Begin a new cycle: shift every time, and set the width of the bins by the number of events of the last cycle."""
    motions, plans, bodies = balls.motions, balls.plans, balls.bodies
    start = system.bin_width * system.bins
    base, rest = two_sum(system.base, start)
    system.base, system.rest = two_sum(base, system.rest + rest)
    system.now -= start
    system.cycles += 1
    system.bin = 0
    for i in range(motions.shape[0]):
        motions[i].time -= start
        plans[i].event_time -= start
        plans[i].collision_time -= start
        bodies[i].last_contact -= start
    plans[motions.shape[0]].event_time -= start
    system.scale += system.growth * start
    for k in range(faces.shape[0]):
        face = faces[k]
        face.start -= start
        face.since -= start
        face.stop -= start
        if face.amplitude != 0.0:
            # the oscillation that now belongs to
            face.start += math.floor((system.now - face.start) / (2.0 * face.half_period)) * 2.0 * face.half_period
    # one event per bin; at most a factor of two at once
    ratio = system.bins / max(system.events, 1)
    system.bin_width *= min(max(ratio, 0.5), 2.0)
    system.events = 0
