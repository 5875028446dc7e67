"""The table of the kinds of contact, and what is made from it: the resolution of an event, and the names of what is met."""

from __future__ import annotations

from typing import Any

from carom.core.jit.kernel import kernel
from carom.scene.scene import Scene
from carom.simulation.contacts.contact import Outcome
from carom.simulation.contacts.gates import CLEARANCE, POCKET, clear_wall, fall_into_pocket
from carom.simulation.contacts.held import HOLDING, hold
from carom.simulation.contacts.landing import LANDING, meet_floor
from carom.simulation.contacts.pair import PAIR, meet_ball
from carom.simulation.contacts.phase_ends import PHASE_END, SETTLING, end_phase, settle_on_floor
from carom.simulation.contacts.wall import WALL_CONTACT, meet_wall
from carom.simulation.records import BALL, FLOOR, LEFT_EVENT, NOTHING, PHASE, POCKETED_EVENT, SETTLED, WALL

__all__ = ["CONTACTS", "PARTNERS", "REFUSALS", "met_at", "partner_names", "resolve_event"]

CONTACTS = {one.code: one for one in (WALL_CONTACT, LANDING, PAIR, PHASE_END, SETTLING, CLEARANCE, POCKET, HOLDING)}
REFUSALS = {code: text for one in CONTACTS.values() for code, text in one.refusals.items()}
# The names of all that ``other`` can be the number of, as a scene has them.
PARTNERS = {WALL: "wall_names", BALL: "ball_names", POCKETED_EVENT: "pocket_names"}


def partner_names(scene: Scene, met: int) -> tuple[str, ...] | None:
    """Return the names among which ``other`` of a row of the log is a number; None where ball and floor are alone."""
    return getattr(scene, PARTNERS[met]) if met in PARTNERS else None


@kernel
def met_at(kind: int) -> int:
    """Return the body that a ball meets at an event of a kind: ``met`` of its kind of contact."""
    if kind in (WALL, LEFT_EVENT):
        return WALL
    return kind if kind in (BALL, POCKETED_EVENT) else NOTHING


@kernel
def resolve_event(  # noqa: PLR0911
    kind: int, world: Any, features: Any, balls: Any, i: int, who: int, users: Any
) -> Outcome:
    """Resolve the event of ball i, which is at its place, with number ``who``: by ``meet`` of its kind of contact.

    (Compiled code cannot look a function up by a number; a test compares this, and ``met_at``, with the table.)
    """
    if kind == WALL:
        return meet_wall(world, features, balls, i, who, users)
    if kind == FLOOR:
        return meet_floor(world, features, balls, i, who, users)
    if kind == BALL:
        return meet_ball(world, features, balls, i, who, users)
    if kind == PHASE:
        return end_phase(world, features, balls, i, who, users)
    if kind == SETTLED:
        return settle_on_floor(world, features, balls, i, who, users)
    if kind == LEFT_EVENT:
        return clear_wall(world, features, balls, i, who, users)
    if kind == POCKETED_EVENT:
        return fall_into_pocket(world, features, balls, i, who, users)
    return hold(world, features, balls, i, who, users)
