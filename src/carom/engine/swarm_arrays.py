"""What the loop of many balls works on: arrays of records, which can be saved and restored bit by bit.

A ball is split over three records by how often it is looked at: MOTION (one cache line: every neighbour's prediction reads
it), PLAN (what comes next, and the ball's place in the queue), BODY (the rest).
"""

from __future__ import annotations

import numpy as np

__all__ = [
    "BODY", "CODES", "DONE", "FULL", "LIMIT", "MOST_BALLS", "MOTION", "NOBODY", "PAIR", "PLAN", "ROOM", "SPECIES", "SWARM",
    "WALL",
]  # fmt: skip

# How a call of the loop ends: at its time, after its collisions or steps, or because a cell has no room for one more ball
# (then all cells get more slots and the balls are put in anew: nothing else has changed).
DONE, LIMIT, FULL = range(3)
NOBODY = 0xFFFFFFFF  # no ball: the end of a list, no collision in sight
ROOM = 4  # slots of a cell that are read without looking whether they are filled
# In the list of neighbours a ball's number has 26 bits, the image that is near the other 6.
CODES = 26
MOST_BALLS = (1 << CODES) - 1

_NUMBER, _INDEX, _VECTOR = "f8", "u4", ("f8", (3,))

# Position and velocity at the ball's own clock, the time of its last event.
MOTION = np.dtype(
    [
        *((name, _NUMBER) for name in ("x", "y", "z", "vx", "vy", "vz")),
        ("clock", _NUMBER),
        ("kind", _INDEX),  # species
        ("count", _INDEX),  # collisions so far (modulo 2^32): tells whether a planned collision still stands
    ]
)

PLAN = np.dtype(
    [
        ("at", _NUMBER),  # the ball's next event
        ("hit_at", _NUMBER),  # the earliest collision found, with ``hit_who`` after its ``hit_count`` collisions
        ("hit_who", _INDEX),
        ("hit_count", _INDEX),
        ("turn", _INDEX),  # which face of its cell the ball reaches next: 2 axis + (1 upwards)
        # the queue: a list of balls a bin
        ("bin", _INDEX),
        ("next", _INDEX),
        ("previous", _INDEX),
    ]
)

BODY = np.dtype(
    [
        ("w", *_VECTOR),  # spin
        ("met", _NUMBER),  # time of the last contact
        ("cell", "i4", (3,)),
        ("image", "i4", (3,)),  # how often the ball has gone round a periodic box
    ]
)

SPECIES = np.dtype([("radius", _NUMBER), ("mass", _NUMBER), ("kappa", _NUMBER)])

# Two species, at [first * species + second].
PAIR = np.dtype(
    [
        ("reach", _NUMBER),  # distance of the centres in contact
        ("reach2", _NUMBER),
        ("e", _NUMBER),
        ("mu", _NUMBER),
        ("beta", _NUMBER),
        ("smooth", "i8"),  # spins neither matter nor change
    ]
)

# A wall (2 axis + (1: the upper one)) and a species, at [wall * species + kind].
WALL = np.dtype([("e", _NUMBER), ("mu", _NUMBER), ("beta", _NUMBER)])

SWARM = np.dtype(
    [
        ("count", "i8"),  # balls
        ("kinds", "i8"),  # species
        ("side", *_VECTOR),  # the box is [0, side]
        ("periodic", "i8", (3,)),
        ("cells", "i8", (3,)),
        ("size", *_VECTOR),  # of a cell
        ("stride", "i8", (3,)),  # from a cell to the next along an axis, in slots
        ("axes", "i8"),  # 3, or 2: discs
        ("pull", *_VECTOR),  # gravity
        ("pulled", "i8"),  # whether there is any
        ("soft", _NUMBER),  # TC: a contact within this time after a ball's last one gives all back
        # The clock: time is base + rest + now, where now starts anew with every turn of the calendar.
        ("base", _NUMBER),
        ("rest", _NUMBER),
        ("now", _NUMBER),
        ("width", _NUMBER),  # of a bin
        ("bins", "i8"),
        ("bin", "i8"),  # the current one
        ("popped", "i8"),  # events of this turn so far
        ("status", "i8"),  # how the last call ended
        # measures
        ("pair_hits", "i8"),
        ("wall_hits", "i8"),
        ("crossings", "i8"),
        ("overtaken", "i8"),
        ("turns", "i8"),
        ("virial", _NUMBER),  # sum of impulse times distance along the line of centres
        ("push", "f8", (6,)),  # impulse on each wall
        ("overlap", _NUMBER),  # largest at a contact, in units of the distance
        ("samples", "i8"),  # sums below, one sample a turn of the calendar
        ("translational", _NUMBER),  # sum of twice the energy
        ("rotational", _NUMBER),
    ]
)
