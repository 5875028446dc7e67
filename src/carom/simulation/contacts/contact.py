"""The descriptor of a kind of contact, and what several kinds share: how a ball moves on after an impact."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from carom.core.jit.kernel import Vec, dot, kernel, vector
from carom.core.motion.phases import FLIGHT, ROUNDING
from carom.simulation.motion import is_on_floor, on_floor_with, write_vector
from carom.simulation.records import NO_REGIME, NOTHING

if TYPE_CHECKING:
    from carom.simulation.run_record import RunRecord

__all__ = ["DONE", "NO_IMPULSE", "ContactKind", "Outcome", "leave", "leave_cluster", "without_impulse"]

# How a contact may end: DONE, or as one of its refusals, where the law has no answer.
DONE = 0

# Impulses of what was met and of the floor, N s, required friction, regime, how it ended (DONE), and how many balls were touched
# where contacts overlap in time, else 0.
Outcome = tuple[Vec, Vec, float, int, int, int]
NO_IMPULSE = (0.0, 0.0, 0.0)


@dataclass(frozen=True)
class ContactKind:
    """A kind of contact: the kernel that resolves it, its place in the log, and its words."""

    code: int
    """As the loop and the log have it (carom.simulation.records)."""
    meet: Callable[..., Outcome]
    """``meet(world, features, balls, i, who, users)``: ball i, which is at the event, meets number ``who``: a feature or a ball."""
    met: int = NOTHING
    """Kind of the body whose number is the log's ``other``: WALL, BALL, POCKETED_EVENT, or NOTHING."""
    noun: str = ""
    """Name under which contacts are counted; empty where they are not."""
    clause: str = ""
    """Text that follows the noun."""
    sentence: Callable[[RunRecord, Any, Any], str] | None = None
    """``sentence(run, features, row)``: the words for a row of the log; None where it is part of another sentence."""
    last: bool = False
    """Whether nothing follows the sentence: the ball is followed no further."""
    refusals: Mapping[int, str] = field(default_factory=dict)
    """Codes of the events for which the law has no answer, with the reasons."""


@kernel
def without_impulse() -> Outcome:
    """Return the outcome of an event without an impulse."""
    return NO_IMPULSE, NO_IMPULSE, 0.0, NO_REGIME, DONE, 0


@kernel
def leave(world: Any, ball: Any, v: Vec, w: Vec, from_floor: bool) -> None:
    """Set velocity and spin after an impact, and the phase that follows: on the floor, or in flight."""
    phase = FLIGHT
    if from_floor:
        speed = math.sqrt(dot(v, v)) + ball.radius * math.sqrt(dot(w, w))
        if abs(v[2]) <= ROUNDING * speed:
            ball.x[2] = ball.radius
            phase, v, w = on_floor_with(world, ball, v, w)
    ball.phase = phase
    write_vector(ball.v, v)
    write_vector(ball.w, w)


@kernel
def leave_cluster(world: Any, balls: Any, count: int) -> None:
    """Set velocities, spins and phases of the balls of a cluster (carom.simulation.cluster) after it."""
    for p in range(count):
        one = balls[balls[p].touched]
        leave(world, one, vector(one.cv), vector(one.cw), is_on_floor(world, one))
