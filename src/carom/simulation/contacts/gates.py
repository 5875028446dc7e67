"""A ball passes a gate: it falls into a pocket, or clears a low wall, behind which it is followed no further or goes on."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from carom.core.geometry.features import GOES_ON
from carom.core.jit.kernel import kernel
from carom.core.motion.phases import LEFT, POCKETED
from carom.formatting import format_number
from carom.simulation.contacts.contact import ContactKind, Outcome, without_impulse
from carom.simulation.phrases import at, speed
from carom.simulation.records import LEFT_EVENT, POCKETED_EVENT, WALL

if TYPE_CHECKING:
    from carom.simulation.run_record import RunRecord

__all__ = ["CLEARANCE", "POCKET", "clear_wall", "fall_into_pocket"]


@kernel
def fall_into_pocket(world: Any, features: Any, balls: Any, i: int, who: int, users: Any) -> Outcome:
    """Catch ball i in the pocket whose edge is feature ``who``: its centre has passed the edge."""
    balls[i].phase = POCKETED
    return without_impulse()


@kernel
def clear_wall(world: Any, features: Any, balls: Any, i: int, who: int, users: Any) -> Outcome:
    """Let ball i pass over the wall that feature ``who`` continues upwards."""
    if features[who].ends != GOES_ON:
        balls[i].phase = LEFT
    return without_impulse()


def _falls(run: RunRecord, features: Any, row: Any) -> str:
    pocket = run.scene.pocket_names[row["other"]]
    return f"{at(row)} it falls into the {pocket} at {format_number(speed(row['v']))} m/s."


def _clears(run: RunRecord, features: Any, row: Any) -> str:
    return f"{at(row)} it clears {run.scene.wall_names[row['other']]}"


POCKET = ContactKind(POCKETED_EVENT, fall_into_pocket, POCKETED_EVENT, sentence=_falls, last=True)
CLEARANCE = ContactKind(LEFT_EVENT, clear_wall, WALL, "wall", " that it clears", _clears)
