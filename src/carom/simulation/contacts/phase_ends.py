"""The end of a phase: of sliding, rolling, spinning on the spot; and of infinitely many bounces, after which a ball has settled."""

from __future__ import annotations

from typing import Any

from carom.core.jit.kernel import kernel, vector
from carom.core.motion.phases import next_phase
from carom.simulation.contacts.contact import ContactKind, Outcome, without_impulse
from carom.simulation.motion import on_floor_with, phase_on_floor, write_vector
from carom.simulation.records import PHASE, SETTLED

__all__ = ["PHASE_END", "SETTLING", "end_phase", "settle_on_floor"]


@kernel
def end_phase(world: Any, features: Any, balls: Any, i: int, who: int, users: Any) -> Outcome:
    """Begin the phase that follows the one of ball i."""
    ball = balls[i]
    phase, v, w = next_phase(ball.phase, vector(ball.v), vector(ball.w), ball.radius, ball.kappa)
    ball.phase = phase_on_floor(world, ball, phase)
    write_vector(ball.v, v)
    write_vector(ball.w, w)
    return without_impulse()


@kernel
def settle_on_floor(world: Any, features: Any, balls: Any, i: int, who: int, users: Any) -> Outcome:
    """Let ball i, whose bounces have ended, slide, roll or rest on the floor."""
    ball = balls[i]
    ball.phase, v, w = on_floor_with(world, ball, vector(ball.v), vector(ball.w))
    write_vector(ball.v, v)
    write_vector(ball.w, w)
    return without_impulse()


PHASE_END, SETTLING = ContactKind(PHASE, end_phase), ContactKind(SETTLED, settle_on_floor)
