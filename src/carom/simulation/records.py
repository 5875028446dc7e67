"""Record types of the event loop: the world, the balls, and the log of events; and names of what a log holds.

A scene becomes one record of the world, an array of features (F,), and an array of balls (B,); a run writes a log (M,). Compiled
code reads and writes these records in place. They are all that the event loop, the scene and the trajectory share.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.core.motion.phases import PHASES

__all__ = [
    "BALL", "BALLS", "FLOOR", "HELD_EVENT", "KINDS", "LEFT_EVENT", "LOG", "NOTHING", "NO_REGIME",
    "PHASE", "POCKETED_EVENT", "SETTLED", "START", "WALL", "WORLD", "kind_names",
]  # fmt: skip

# What can come next for a ball, and what a log says of it.
START, WALL, FLOOR, BALL, PHASE, SETTLED, LEFT_EVENT, HELD_EVENT, NOTHING, POCKETED_EVENT = range(10)
# What people see; the end of a phase is called after the phase that begins.
KINDS = ("start", "wall", "floor", "ball", "phase", "settled", "left", "held", "nothing", "pocketed")

NO_REGIME = -1

_NUMBER, _WHOLE, _VECTOR = "f8", "i8", ("f8", (3,))

# A surface: a form of restitution and its three numbers (carom.core.motion.restitution), friction, tangential restitution.
_SURFACE = [("form", _WHOLE), ("p", *_VECTOR), ("mu", _NUMBER), ("beta", _NUMBER)]

WORLD = np.dtype(
    [
        ("force", *_VECTOR),  # acceleration in flight
        ("floor", _WHOLE),  # whether there is one
        ("g", _NUMBER),  # how strongly it is pressed; 0 where nothing presses
        *((f"floor_{name}", *kind) for name, *kind in _SURFACE),
        ("resistance", _NUMBER),
        ("spin_friction", _NUMBER),
        *((f"pair_{name}", *kind) for name, *kind in _SURFACE),
        ("together", _WHOLE),  # wall and floor act at once on a ball that the wall pushes down
    ]
)

BALLS = np.dtype(
    [
        ("radius", _NUMBER),
        ("mass", _NUMBER),
        ("kappa", _NUMBER),
        # position, velocity, spin and phase at the ball's own clock: the time of its last event
        ("x", *_VECTOR),
        ("v", *_VECTOR),
        ("w", *_VECTOR),
        ("phase", _WHOLE),
        ("clock", _NUMBER),
        ("acc", *_VECTOR),
        ("turn", *_VECTOR),  # angular acceleration
        ("lasts", _NUMBER),  # how long the phase lasts from the clock on
        ("next_in", _NUMBER),  # time from the clock to the next event; the absolute time is next_at
        ("next_at", _NUMBER),
        ("next_kind", _WHOLE),
        ("next_who", _WHOLE),  # the feature, or the other ball
        ("repeats", _WHOLE),  # events in a row at one place
        ("energy", _NUMBER),  # a unit of mass, since nothing takes any: what rounding must not change; else NaN
    ]
)

LOG = np.dtype(
    [
        ("t", _NUMBER),
        ("kind", _WHOLE),
        ("ball", _WHOLE),
        ("met", _WHOLE),  # WALL, BALL, POCKETED_EVENT, or NOTHING: what ``other`` is the number of
        ("other", _WHOLE),  # -1 for none
        ("x", *_VECTOR),
        ("v_before", *_VECTOR),
        ("w_before", *_VECTOR),
        ("v", *_VECTOR),
        ("w", *_VECTOR),
        ("phase_before", _WHOLE),
        ("phase", _WHOLE),
        ("impulse", *_VECTOR),  # N s, on the ball
        ("floor_impulse", *_VECTOR),  # N s: what the floor gave while the wall acted
        ("required", _NUMBER),  # friction
        ("regime", _WHOLE),  # what the contact did (carom.core.contact.REGIMES); NO_REGIME where a law does not say
    ]
)


def kind_names(rows: NDArray[np.void]) -> NDArray[Any]:
    """Return the kinds of a log's rows by name; the end of a phase has the name of the phase that begins."""
    kinds = np.array(KINDS, dtype=object)[rows["kind"]]
    phases = np.array(PHASES, dtype=object)[rows["phase"]]
    names: NDArray[Any] = np.where(rows["kind"] == PHASE, phases, kinds)
    return names
