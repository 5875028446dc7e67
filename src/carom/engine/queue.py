"""The queue of many balls: a calendar, whose bins are lists of the balls with an event in a short stretch of time.

A binary heap costs log N steps through memory an event; a bin holds one or two balls, so the earliest event is found by
looking at them (G. Paul, J. Comput. Phys. 221, 615 (2007), has the idea). One turn of the calendar is a few events a ball.
What comes after the turn waits in one list, the bin ``bins``; with each turn all clocks start anew (:func:`turn_over`), so
times stay small and keep their digits however long the run.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from carom.engine.swarm_arrays import NOBODY
from carom.kernel import hot_kernel, kernel
from carom.motion.polynomial import two_sum

__all__ = ["S", "U", "enqueue", "fill", "take_out", "turn_over"]

# An unsigned index needs no look whether it counts from the end; sums are done with signed ones (a signed and an unsigned
# number together become a float).
U: Any = np.uint64
S: Any = np.int64


@hot_kernel
def enqueue(plans: Any, heads: Any, i: int, width: float, bins: int, current: int) -> None:
    """Put ball i into the bin of its next event."""
    place = plans[U(i)].at / width
    b = bins if not place < bins else max(S(place), current)
    after = heads[U(b)]
    plan = plans[U(i)]
    plan.bin, plan.next, plan.previous = b, after, NOBODY
    if after != NOBODY:
        plans[U(after)].previous = i
    heads[U(b)] = i


@hot_kernel
def take_out(plans: Any, heads: Any, i: int) -> None:
    """Take ball i out of its bin."""
    plan = plans[U(i)]
    after, before = plan.next, plan.previous
    if after != NOBODY:
        plans[U(after)].previous = before
    if before != NOBODY:
        plans[U(before)].next = after
    else:
        heads[U(plan.bin)] = after


@kernel
def fill(swarm: Any, plans: Any, heads: Any) -> None:
    """Put all balls, and the thermostat, into their bins."""
    for b in range(heads.shape[0]):
        heads[b] = NOBODY
    width, bins = swarm.width, swarm.bins
    for i in range(plans.shape[0]):
        enqueue(plans, heads, i, width, bins, 0)


@kernel
def turn_over(swarm: Any, motions: Any, plans: Any, bodies: Any, faces: Any, heads: Any) -> None:
    """Begin a new turn: shift every clock, set the width of the bins by the events of the last turn, fill them."""
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
    fill(swarm, plans, heads)
