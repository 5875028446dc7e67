"""The queue of many balls: a calendar, whose bins are lists of the balls with an event in a short stretch of time.

A binary heap costs log N steps through memory an event; a bin holds one or two balls, so the earliest event is found by
looking at them (G. Paul, J. Comput. Phys. 221, 615 (2007), has the idea). One turn of the calendar is a few events a ball; with
each turn all clocks start anew (:func:`turn_over`), so times stay small and keep their digits however long the run.

Only the bins of this page of the calendar and of the next are there: a few cache lines. What comes later is noted on its
page, in no order, and goes into bins when that page is next; what comes after the turn, on one last page. To note a ball is to
write its number behind the last one, and to take it out is to leave the note, which tells nothing once the ball's plan says
otherwise. So nothing that lies far away in memory has to be read before an event is planned.

A page's notes are on leaves of a cache line each, the first number of which is where the leaf before ends. ``tails`` is
where the notes of each page end (0: there are none), then the first of the free leaves, and how many are free.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from carom.engine.swarm_arrays import NOBODY
from carom.kernel import hot_kernel, kernel
from carom.motion.polynomial import two_sum

__all__ = [
    "LEAF", "PAGE", "RING", "S", "U", "calendar", "enqueue", "fill", "full", "is_noted", "open_page", "page_of", "take_out",
    "turn_over",
]  # fmt: skip

# An unsigned index needs no look whether it counts from the end; sums are done with signed ones (a signed and an unsigned
# number together become a float).
U: Any = np.uint64
S: Any = np.int64

PAGE_BITS = 5
PAGE = 1 << PAGE_BITS  # bins of a page
RING = 2 * PAGE  # bins that are there
LEAF = 16  # numbers of a leaf
NOTED = 1 << 31  # of a plan's bin: the ball is not in it yet, only on its page
SPARE = 4  # leaves: no more than are begun in one event


def calendar(count: int, bins: int) -> tuple[int, int, int]:
    """How many numbers ``heads``, ``tails`` and ``leaves`` have: room for twice as many notes as balls."""
    pages = -(-bins // PAGE) + 1
    return RING, pages + 2, LEAF * (pages + 2 * count // (LEAF - 1) + 2 + SPARE)


@hot_kernel
def page_of(bin_: int) -> int:
    """The page on which a bin is."""
    return bin_ >> PAGE_BITS


@hot_kernel
def is_noted(plan: Any, page: int) -> bool:
    """Whether a ball's note on a page holds still, and it is not in its bin yet."""
    return S(plan.bin) >> PAGE_BITS == (page | NOTED >> PAGE_BITS)  # type: ignore[no-any-return]


@hot_kernel
def _into_bin(plans: Any, heads: Any, i: int, b: int) -> None:
    plan = plans[U(i)]
    k = b & (RING - 1)
    after = heads[U(k)]
    plan.bin, plan.next, plan.previous = b, after, NOBODY
    if after != NOBODY:
        plans[U(after)].previous = i
    heads[U(k)] = i


@hot_kernel
def _note(tails: Any, leaves: Any, i: int, page: int) -> None:
    """Write ball i on a page."""
    tail = S(tails[U(page)]) + 1
    if tail & (LEAF - 1) <= 1:  # its leaf is full, or it has none
        first = tails.shape[0] - 2
        leaf = S(tails[U(first)])
        tails[U(first)] = leaves[U(leaf)]
        tails[U(first + 1)] -= np.uint32(1)
        leaves[U(leaf)] = tail - 1
        tail = leaf + 1
    leaves[U(tail)] = i
    tails[U(page)] = tail


@hot_kernel
def enqueue(plans: Any, heads: Any, tails: Any, leaves: Any, i: int, width: float, bins: int, current: int) -> None:
    """Put ball i into the bin of its next event, or on its page."""
    place = plans[U(i)].at / width
    # (what comes after the turn, and at no time, is on the last page)
    last = (tails.shape[0] - 3) * PAGE
    b = last if not place < bins else max(S(place), current)
    page = page_of(b)
    if page <= page_of(current) + 1:
        _into_bin(plans, heads, i, b)
    else:
        plans[U(i)].bin = b | NOTED
        _note(tails, leaves, i, page)


@hot_kernel
def take_out(plans: Any, heads: Any, i: int) -> None:
    """Take ball i out of its bin; a note of it stays where it is, and is void once the ball is planned anew."""
    plan = plans[U(i)]
    if plan.bin >= NOTED:
        return
    after, before = plan.next, plan.previous
    if after != NOBODY:
        plans[U(after)].previous = before
    if before != NOBODY:
        plans[U(before)].next = after
    else:
        heads[U(plan.bin & (RING - 1))] = after


@kernel
def open_page(plans: Any, heads: Any, tails: Any, leaves: Any, page: int) -> None:
    """Put the balls that are noted on a page into their bins, and free its leaves."""
    free = tails.shape[0] - 2
    tail = S(tails[U(page)])
    tails[U(page)] = 0
    while tail != 0:
        while tail & (LEAF - 1) != 0:
            i = leaves[U(tail)]
            if is_noted(plans[U(i)], page):
                _into_bin(plans, heads, S(i), S(plans[U(i)].bin) - NOTED)
            tail -= 1
        before = S(leaves[U(tail)])
        leaves[U(tail)] = tails[U(free)]
        tails[U(free)] = tail
        tails[U(free + 1)] += np.uint32(1)
        tail = before


@hot_kernel
def full(tails: Any) -> bool:
    """Whether so few leaves are free that the void notes have to go: :func:`fill`."""
    return tails[U(tails.shape[0] - 1)] < SPARE  # type: ignore[no-any-return]


@kernel
def fill(plans: Any, heads: Any, tails: Any, leaves: Any, width: float, bins: int, current: int) -> None:
    """Put all balls, and the thermostat, into their bins or on their pages, of which the current bin is the first."""
    pages = tails.shape[0] - 2
    for k in range(RING):
        heads[U(k)] = NOBODY
    for k in range(pages):
        tails[U(k)] = 0
    # (leaf 0 is none: a page that ends there has no notes)
    whole = leaves.shape[0] // LEAF
    for k in range(whole):
        leaves[U(k * LEAF)] = (k + 1) * LEAF
    tails[U(pages)] = LEAF
    tails[U(pages + 1)] = whole - 1
    for i in range(plans.shape[0]):
        enqueue(plans, heads, tails, leaves, i, width, bins, current)


@kernel
def turn_over(swarm: Any, motions: Any, plans: Any, bodies: Any, faces: Any) -> None:
    """Begin a new turn: shift every clock, set the width of the bins by the events of the last turn."""
    start = swarm.width * swarm.bins
    base, rest = two_sum(swarm.base, start)
    swarm.base, swarm.rest = two_sum(base, swarm.rest + rest)
    swarm.now -= start
    swarm.turns += 1
    swarm.bin = 0
    for i in range(motions.shape[0]):
        motions[i].clock -= start
        plans[i].at -= start
        plans[i].hit_at -= start
        bodies[i].met -= start
    plans[motions.shape[0]].at -= start
    swarm.scale += swarm.growth * start
    for k in range(faces.shape[0]):
        face = faces[k]
        face.start -= start
        if face.swing != 0.0:
            # the swing that now belongs to
            face.start += math.floor((swarm.now - face.start) / (2.0 * face.half)) * 2.0 * face.half
    # one event a bin; no more than twice or half as long at once
    ratio = swarm.bins / max(swarm.popped, 1)
    swarm.width *= min(max(ratio, 0.5), 2.0)
    swarm.popped = 0
