"""The landing of a ball on the floor: an impact, after which it flies, stays there, or bounces to the end."""

from __future__ import annotations

from typing import Any

from carom.core.contact import one_contact
from carom.core.jit.kernel import kernel, vector
from carom.core.motion.phases import FLIGHT
from carom.core.motion.restitution import restitution
from carom.core.motion.rolling import UP
from carom.simulation.contacts.contact import DONE, NO_IMPULSE, ContactKind, Outcome, leave
from carom.simulation.records import FLOOR
from carom.simulation.resting_contact import sum_bounces

__all__ = ["LANDING", "meet_floor"]


@kernel
def meet_floor(world: Any, features: Any, balls: Any, i: int, who: int, users: Any) -> Outcome:
    """Resolve the landing of ball i."""
    ball = balls[i]
    v, w = vector(ball.v), vector(ball.w)
    e = restitution(world.floor_form, vector(world.floor_p), max(-v[2], 0.0))
    v1, w1, j, required, regime = one_contact(v, w, UP, ball.radius, ball.kappa, e, world.floor_mu, world.floor_beta)
    ball.x[2] = ball.radius
    leave(world, ball, v1, w1, True)
    if ball.phase == FLIGHT and world.g > 0 and e < 1 and sum_bounces(world, features, balls, i):
        leave(world, ball, (v1[0], v1[1], 0.0), w1, True)
    m = ball.mass
    return (m * j[0], m * j[1], m * j[2]), NO_IMPULSE, required, regime, DONE, 0


LANDING = ContactKind(FLOOR, meet_floor)
