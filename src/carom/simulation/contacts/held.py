"""A ball that is caught between things that send it to and fro without end is held there."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from carom.core.jit.kernel import kernel
from carom.core.motion.phases import HELD
from carom.simulation.contacts.contact import ContactKind, Outcome, without_impulse
from carom.simulation.phrases import at
from carom.simulation.records import BALL, HELD_EVENT

if TYPE_CHECKING:
    from carom.simulation.run_record import RunRecord

__all__ = ["HOLDING", "hold"]


@kernel
def hold(world: Any, features: Any, balls: Any, i: int, who: int, users: Any) -> Outcome:
    """Hold ball i where it is, and the ball that it was to meet, if that has not moved either."""
    if balls[i].next_kind == BALL and balls[who].repeats > 0:
        balls[who].phase = HELD
    balls[i].phase = HELD
    return without_impulse()


def _is_held(run: RunRecord, features: Any, row: Any) -> str:
    return f"{at(row)} it is held where it is, pressed between what it touches, and is followed no further."


HOLDING = ContactKind(HELD_EVENT, hold, sentence=_is_held, last=True)
