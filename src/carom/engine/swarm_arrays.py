"""What the loop of many balls works on: arrays of records, which can be saved and restored bit by bit.

A ball is split over three records by how often it is looked at: MOTION (every neighbour's prediction reads it), PLAN (what
comes next, its place in the queue and among the cells), BODY (the rest). The first two are a cache line each. What the
loop reads of them at every event are plain numbers: an array within a record costs a call each time (twice as long a run).
"""

from __future__ import annotations

import numpy as np

__all__ = [
    "BODY", "CALM", "CHANNEL", "CODES", "DONE", "FACE", "FAINT", "INSIDE", "LIMIT", "MOST_BALLS", "MOTION",
    "NOBODY", "OUTSIDE", "OVAL", "PAIR", "PERIODIC", "PLAN", "PLANE", "PULL", "SIZE", "SPECIES", "STUCK", "SWARM", "WALL",
]  # fmt: skip

# How a call of the loop ends: at its time, or because nothing will ever happen; after its collisions or steps; because time
# stands still; because speeds are too small for their numbers.
DONE, LIMIT, STUCK, FAINT = range(4)
NOBODY = 0xFFFFFFFF  # no ball: the end of a list, no collision in sight
# In the list of neighbours a ball's number has 26 bits, the image that is near the other 6.
CODES = 26
# What the loop is told of the box, as plain arrays: lengths (9,), three each of the sides, a cell's sizes (from SIZE) and
# gravity (PULL); whole numbers (12,): cells, whether periodic (PERIODIC), and the first and last places of the block of cells
# that no wall is near (CALM).
SIZE, PULL = PERIODIC, CALM = 3, 6
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
        (
            "turn",
            _INDEX,
        ),  # which face of its cell the ball reaches next: 2 axis + (1 upwards); or which wall, see swarm_walls
        # the queue: a list of balls a bin
        ("bin", _INDEX),
        ("next", _INDEX),
        ("previous", _INDEX),
        *((name, "i4") for name in ("cx", "cy", "cz")),  # the cell
        ("image", "i4", (3,)),  # how often the ball has gone round a periodic box
    ]
)

BODY = np.dtype(
    [
        *((name, _NUMBER) for name in ("wx", "wy", "wz")),  # spin
        ("met", _NUMBER),  # time of the last contact
    ]
)

SPECIES = np.dtype([("radius", _NUMBER), ("mass", _NUMBER), ("kappa", _NUMBER)])

# What the contacts of one kind have done: how many, the energy that normal and tangential restitution and friction took,
# and that which went from the motion of centres to spin.
CHANNEL = [("hits", "i8"), ("normal", _NUMBER), ("tangential", _NUMBER), ("spun", _NUMBER)]

# Two species, at [first * species + second]; ``first`` is that of the ball whose event it was.
PAIR = np.dtype(
    [
        ("reach", _NUMBER),  # distance of the centres in contact
        ("reach2", _NUMBER),
        ("e", _NUMBER),
        ("mu", _NUMBER),
        ("beta", _NUMBER),
        ("smooth", "i8"),  # spins neither matter nor change
        *CHANNEL,
    ]
)

# A wall: where it keeps balls, how it moves, how warm it is, what it has done.
# The gap of a ball at x is n.(x - m) - d before a plane (PLANE), d^2 - |q (x - m)|^2 within a round wall (INSIDE) and
# |q (x - m)|^2 - d^2 around one (OUTSIDE): q is 0 along the axis of a cylinder, 1 across it; d depends on the species. Within an
# ellipse that bounds surfaces (OVAL) it is the distance from it, less d.
PLANE, INSIDE, OUTSIDE, OVAL = range(4)
FACE = np.dtype(
    [
        ("form", "i8"),
        *((name, _NUMBER) for name in ("nx", "ny", "nz")),  # a plane's normal, or q; of an OVAL its half axes
        *((name, _NUMBER) for name in ("mx", "my", "mz")),
        # only where the centre is from low to high along this direction is there a wall
        ("bounded", "i8"),
        *((name, _NUMBER) for name in ("ax", "ay", "az", "low", "high")),
        # behind such a plane by more than this and its radius a ball is in another part of the room
        ("deep", _NUMBER),
        # A plane that swings: parabolas up and down the normal, of this height, half a period each; ``start`` is when one up
        # the normal began.
        ("swing", _NUMBER),
        ("half", _NUMBER),
        ("start", _NUMBER),
        # k_B T of balls that leave a heated wall, and of their spins; below 0: not heated
        ("warm", _NUMBER),
        ("warm_spin", _NUMBER),
        ("area", _NUMBER),
        # measures
        ("hits", "i8"),
        ("push", _NUMBER),  # impulse against the normal
        ("fed", _NUMBER),  # energy that its motion and its heat gave
    ]
)

# A wall and a species, at [wall * species + kind].
WALL = np.dtype(
    [
        ("keep", _NUMBER),  # d
        ("thick", _NUMBER),  # how d changes with the radius, times the radius
        ("e", _NUMBER),
        ("mu", _NUMBER),
        ("beta", _NUMBER),
        *CHANNEL,
    ]
)

SWARM = np.dtype(
    [
        ("count", "i8"),  # balls
        ("kinds", "i8"),  # species
        ("side", *_VECTOR),  # the box is [0, side]
        ("periodic", "i8", (3,)),
        ("cells", "i8", (3,)),
        ("size", *_VECTOR),  # of a cell
        ("axes", "i8"),  # 3, or 2: discs
        ("pull", *_VECTOR),  # gravity
        ("soft", _NUMBER),  # TC: a contact within this time after a ball's last one gives all back
        # The clock: time is base + rest + now, where now starts anew with every turn of the calendar.
        ("base", _NUMBER),
        ("rest", _NUMBER),
        ("now", _NUMBER),
        ("width", _NUMBER),  # of a bin
        ("bins", "i8"),
        ("bin", "i8"),  # the current one
        ("popped", "i8"),  # events of this turn so far
        ("planned", "i8"),  # balls that have their first event
        ("status", "i8"),  # how the last call ended
        # since when, in collisions, time has stood still
        ("mark", _NUMBER),
        ("since", "i8"),
        # Along free axes nothing holds the gas: all is seen at the velocity that its centre of mass had at first.
        ("free", "i8", (3,)),
        ("frame", *_VECTOR),
        ("slow", _NUMBER),  # below this speed of approach times distance, balls in touch are not coming in
        ("volume", _NUMBER),
        # All radii are multiplied by scale + growth now.
        ("scale", _NUMBER),
        ("growth", _NUMBER),
        # random numbers: the key, and how many were drawn
        ("key", "i8", (2,)),
        ("drawn", "i8"),
        # The thermostat: kicks in all per time (0: none), k_B T and that of spins.
        ("rate", _NUMBER),
        ("warm", _NUMBER),
        ("warm_spin", _NUMBER),
        ("kicks", "i8"),
        ("fed", _NUMBER),  # energy that it gave
        # measures
        ("pair_hits", "i8"),
        ("wall_hits", "i8"),
        ("crossings", "i8"),
        ("overtaken", "i8"),
        ("turns", "i8"),
        ("virial", _NUMBER),  # sum of impulse times distance along the line of centres
        ("overlap", _NUMBER),  # largest at a contact, in units of the distance
        ("sampled", _NUMBER),  # time over which the sums below go, one sample a turn of the calendar
        ("translational", _NUMBER),  # twice the energy times time
        ("rotational", _NUMBER),
    ]
)
