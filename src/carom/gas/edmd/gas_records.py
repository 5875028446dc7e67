"""Record types of the event-driven engine: balls, plans, species, contacts, walls and the state of the whole system.

Arrays of these records are the state of a gas; they can be saved and restored bit by bit. The loop takes them in groups
(:class:`Balls`, :class:`Calendar`, :class:`Cells`, ...).

A ball is split over three records by how often it is read: MOTION (read by every neighbour's prediction), PLAN (next event,
position in the calendar and in the cell list), BODY (the rest). The first two are one cache line each. What the loop reads at every
event are plain numbers: an array within a record costs a call each time, which doubles the run time.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

# Why a call of the loop ended: the end time was reached (or no event is left); the number of collisions was reached; time no
# longer advances (inelastic collapse); speeds are too small for double precision.
DONE, LIMIT, COLLAPSED, UNDERFLOW = range(4)
NO_BALL = 0xFFFFFFFF  # end of a list; no collision predicted
# An entry of the list of neighbours: the ball's index in the lower bits, the code of its periodic image in the other 6.
INDEX_BITS = 26
MAX_BALLS = (1 << INDEX_BITS) - 1

_FLOAT, _INDEX, _VECTOR = "f8", "u4", ("f8", (3,))

MOTION = np.dtype(
    [
        *((name, _FLOAT) for name in ("x", "y", "z", "vx", "vy", "vz")),
        ("time", _FLOAT),  # of this position and velocity: the ball's last event
        ("species", _INDEX),
        ("collisions", _INDEX),  # so far, modulo 2^32: tells whether a prediction is still valid
    ]
)

PLAN = np.dtype(
    [
        ("event_time", _FLOAT),  # of the ball's next event
        # the earliest predicted collision: its time, the other ball, and how many collisions that one had had
        ("collision_time", _FLOAT),
        ("partner", _INDEX),
        ("partner_collisions", _INDEX),
        # the face of its cell that the ball reaches next, 2 axis + (1 upwards); or a wall (see edmd.walls)
        ("boundary", _INDEX),
        # the calendar: each bin is a doubly linked list
        ("bin", _INDEX),
        ("next", _INDEX),
        ("previous", _INDEX),
        *((name, "i4") for name in ("cx", "cy", "cz")),  # the cell
        ("image", "i4", (3,)),  # net number of periods crossed along each axis
    ]
)

BODY = np.dtype(
    [
        *((name, _FLOAT) for name in ("wx", "wy", "wz")),  # spin
        ("last_contact", _FLOAT),  # time
    ]
)

SPECIES = np.dtype([("radius", _FLOAT), ("mass", _FLOAT), ("kappa", _FLOAT)])

# Totals over the contacts of one kind: their number, the energy dissipated by normal restitution and by friction and tangential
# restitution, and the energy transferred from translation to spin.
_TOTALS = [("collisions", "i8"), ("lost_normal", _FLOAT), ("lost_tangential", _FLOAT), ("to_spin", _FLOAT)]

# The contact of two species, at [first * number of species + second]; ``first`` is the species of the ball whose event it was.
PAIR = np.dtype(
    [
        ("distance", _FLOAT),  # of the centres in contact
        ("distance_squared", _FLOAT),
        ("e", _FLOAT),  # (of a CONTACT_FORM a number below 1 that stands for it)
        ("mu", _FLOAT),
        ("beta", _FLOAT),
        ("smooth", "i8"),  # spins neither matter nor change
        *_TOTALS,
    ]
)

# A contact whose restitution or friction is no number, beside a PAIR or WALL_CONTACT: the form of the restitution (0: a number) and
# its three numbers (core.motion.restitution, or a random one); what friction falls by with the slip, and how fast.
RANDOM_UNIFORM, RANDOM_NORMAL = 100, 101
CONTACT_FORM = np.dtype([("form", "i8"), *((name, _FLOAT) for name in ("p0", "p1", "p2", "drop", "rate"))])

# A face of a wall: geometry, motion, temperature, totals.
# The gap of a ball at x is n.(x - m) - d for a plane, d^2 - |q (x - m)|^2 inside a round wall and |q (x - m)|^2 - d^2 outside
# one: q is 0 along the axis of a cylinder, 1 across it; d depends on the species. At an arc of a smooth
# CURVE, whose table begins at the row ``depth`` of the curves, it is the distance from it, less d.
PLANE, INSIDE, OUTSIDE, CURVE = range(4)
WALL_FACE = np.dtype(
    [
        ("form", "i8"),
        *((name, _FLOAT) for name in ("nx", "ny", "nz")),  # a plane's normal, or q
        *((name, _FLOAT) for name in ("mx", "my", "mz")),
        # a bounded face exists only where low <= a . x <= high
        ("bounded", "i8"),
        *((name, _FLOAT) for name in ("ax", "ay", "az", "low", "high")),
        # a ball further behind a bounded plane than this and its radius is in another part of the container
        ("depth", _FLOAT),
        # An oscillating plane moves along parabolas up and down the normal, of this height, half a period each; ``start`` is
        # the time at which an upward one began.
        ("amplitude", _FLOAT),
        ("half_period", _FLOAT),
        ("start", _FLOAT),
        # k_B T of balls that leave a heated wall, and of their spins; below 0: not heated
        ("temperature", _FLOAT),
        ("spin_temperature", _FLOAT),
        ("area", _FLOAT),
        # A piston: its mass (0: none), its acceleration, its displacement and speed along the normal since the last contact.
        *((name, _FLOAT) for name in ("mass", "pull", "offset", "speed", "since")),
        # a belt, whose surface moves along itself with this velocity
        ("is_belt", "i8"),
        *((name, _FLOAT) for name in ("ux", "uy", "uz")),
        # totals
        ("collisions", "i8"),
        ("impulse", _FLOAT),  # against the normal
        ("energy", _FLOAT),  # given to the gas by motion and heat
    ]
)

# The contact of a face and a species, at [face * number of species + species].
WALL_CONTACT = np.dtype(
    [
        ("distance", _FLOAT),  # d
        ("radius_part", _FLOAT),  # how much of d grows with the ball's radius
        ("e", _FLOAT),
        ("mu", _FLOAT),
        ("beta", _FLOAT),
        *_TOTALS,
    ]
)

SYSTEM = np.dtype(
    [
        ("balls", "i8"),
        ("species", "i8"),
        ("side", *_VECTOR),  # the box is [0, side]
        ("periodic", "i8", (3,)),
        ("cells", "i8", (3,)),
        ("cell_size", *_VECTOR),
        ("dimensions", "i8"),  # 3, or 2: discs
        ("gravity", *_VECTOR),
        ("contact_time", _FLOAT),  # TC model: a contact within this time after a ball's last one is elastic
        # The clock: time is base + rest + now, and now starts at 0 in every cycle of the calendar.
        ("base", _FLOAT),
        ("rest", _FLOAT),
        ("now", _FLOAT),
        ("bin_width", _FLOAT),
        ("bins", "i8"),
        ("bin", "i8"),  # the current one
        ("events", "i8"),  # in this cycle so far
        ("planned", "i8"),  # balls that have their first event
        ("status", "i8"),  # why the last call ended
        # the time, and the collisions until then, at which time was last seen to advance
        ("progress_time", _FLOAT),
        ("progress_collisions", "i8"),
        # Axes along which momentum is conserved. The gas is simulated in the frame of its centre of mass along these.
        ("free", "i8", (3,)),
        ("frame", *_VECTOR),
        ("threshold", _FLOAT),  # approach speed times distance below which touching balls do not collide
        ("volume", _FLOAT),
        # All radii are multiplied by scale + growth now.
        ("scale", _FLOAT),
        ("growth", _FLOAT),
        # random numbers: the key, and how many were drawn
        ("key", "i8", (2,)),
        ("drawn", "i8"),
        # The thermostat: kicks of all balls per unit time (0: none), k_B T of velocities and of spins.
        ("rate", _FLOAT),
        ("temperature", _FLOAT),
        ("spin_temperature", _FLOAT),
        ("kicks", "i8"),
        ("thermostat_energy", _FLOAT),  # given to the gas
        # totals
        ("pair_collisions", "i8"),
        ("wall_collisions", "i8"),
        ("crossings", "i8"),  # of cell borders
        ("invalidated", "i8"),  # predictions whose partner had collided with another ball
        ("cycles", "i8"),  # of the calendar
        ("overlap", _FLOAT),  # largest at a contact, relative to the distance of the centres
    ]
)

# Of a gas that is sheared: the shear rate; the speed of the images across y, rate times side; how far those above are
# displaced along x at the start of the cycle.
SHEAR = np.dtype([("rate", _FLOAT), ("speed", _FLOAT), ("offset", _FLOAT)])

# Of a gas whose heat current is measured: the sums over flights of a ball's energy times its way, and over collisions of two balls
# of the distance of their centres times the energy that the first one gains, both by components. ``spins`` is 0 where
# collisions change no spin, whose energy is then no heat, else 1.
HEAT = np.dtype([("spins", _FLOAT), *((part + axis, _FLOAT) for part in ("carried_", "passed_") for axis in "xyz")])

# What means over time are made of (edmd.averages). Of a species: sums over the jumps of a cycle, times the time (x2, y2, z2: of
# impulses, times its square); sums over the balls at its end (names with t); integrals over the earlier cycles (time_...). xx to
# yz is the flux of momentum, ww twice the energy of the spins, h the potential energy, p the momentum, n the number of balls.
FLUX = ("xx", "yy", "zz", "xy", "xz", "yz")
FLOW = np.dtype(
    [
        (name, _FLOAT)
        for name in (
            *FLUX, "ww", "x2", "y2", "z2", *(f"{name}t" for name in FLUX), "wwt", "pxt", "pyt", "pzt", "ht", "n",
            *(f"time_{name}" for name in (*FLUX, "ww", "h")),
        )
    ]
)  # fmt: skip
# Of a species in a layer, at [layer * number of species + species]; vv is twice the translational energy. What went up through the
# layer's upper edge, by balls that cross it and by collisions of balls on either side: up_e is twice the energy without that of the
# spins which balls carry, up_w the latter, up_x to up_z the momentum.
LAYER = np.dtype(
    [
        (name, _FLOAT)
        for name in (
            "n1", "n2", "n3", "px", "py", "pz", "p2", "vv", "ww", "n", "pxt", "pyt", "pzt", "vvt", "wwt",
            *(f"time_{name}" for name in ("n", "px", "py", "pz", "vv", "ww")), "up_e", "up_w", "up_x", "up_y", "up_z",
        )
    ]
)  # fmt: skip
# Of the whole gas: across which axis the layers lie (-1: there are none), and the sums over all collisions of two balls of the
# distance of their centres times the impulse, by components.
WHOLE = np.dtype([("axis", "i8"), *((a + b, _FLOAT) for a in "xyz" for b in "xyz")])


class Balls(NamedTuple):
    """The balls, by their place in memory; a place's ball is ``numbers`` of it."""

    motions: NDArray[np.void]
    plans: NDArray[np.void]
    """One more than balls: the last one is the thermostat's."""
    bodies: NDArray[np.void]
    numbers: NDArray[np.uint32]


class Materials(NamedTuple):
    """Species, and the contacts of two of them."""

    species: NDArray[np.void]
    pairs: NDArray[np.void]
    pair_forms: NDArray[np.void]


class Averages(NamedTuple):
    """Sums for means over time: of the whole gas, of each species, of each in each layer."""

    whole: NDArray[np.void]
    flows: NDArray[np.void]
    layers: NDArray[np.void]


class WallRecords(NamedTuple):
    """The faces, their contacts with each species, and which faces a ball in a cell can touch."""

    faces: NDArray[np.void]
    contacts: NDArray[np.void]
    contact_forms: NDArray[np.void]
    cell_sets: NDArray[np.int32]
    """Place in ``sets`` at which the set of each cell begins."""
    sets: NDArray[np.int32]
    """One set after the other: the number of faces, then their indices."""
    curves: NDArray[np.float64]
    """Tables (R, columns) of the arcs of smooth curves (:mod:`carom.core.geometry.curve_arcs`), one after the other."""


class Calendar(NamedTuple):
    """The event queue (:mod:`carom.gas.edmd.calendar`)."""

    heads: NDArray[np.uint32]
    page_ends: NDArray[np.uint32]
    blocks: NDArray[np.uint32]


class Cells(NamedTuple):
    """The cell list (:mod:`carom.gas.edmd.calendar`)."""

    slots: NDArray[np.uint32]
    links: NDArray[np.uint32]
    offsets: NDArray[np.int64]
    """(axis, cell, 3): of the cell before, the cell, and the cell after."""
    shifts: NDArray[np.float64]
    """(axis, cell, 3): periodic shift of the ball when it is compared with each of these."""


class Grid(NamedTuple):
    """The box and its division into cells, by axis."""

    side: NDArray[np.float64]
    cell_size: NDArray[np.float64]
    gravity: NDArray[np.float64]
    cells: NDArray[np.int64]
    periodic: NDArray[np.int64]
    interior: NDArray[np.int64]
    """First and last cells, along x, y and z, of a block of cells that no wall reaches: (6,)."""


class Neighbours(NamedTuple):
    """Working arrays of the prediction: the balls near one, and the collision with each of them.

    With the relative position r and velocity u, a collision is at c + 2 b t + u^2 t^2 = 0.
    """

    found: NDArray[np.uint32]
    images: NDArray[np.float64]
    """The ball's position as seen from the three cells along each axis: (12,), four places per axis."""
    b: NDArray[np.float64]
    """r . u"""
    u2: NDArray[np.float64]
    c: NDArray[np.float64]
    """r^2 less the squared distance in contact."""
    times: NDArray[np.float64]
    time_bits: NDArray[np.int64]
    """The same memory as ``times``."""


class Scratch(NamedTuple):
    """Room for one more motion, plan, body and number."""

    motion: NDArray[np.void]
    plan: NDArray[np.void]
    body: NDArray[np.void]
    number: NDArray[np.uint32]


class Features(NamedTuple):
    """Compile-time switch: what a gas needs beyond fixed planes. None in its place compiles the short loop."""

    curve: NDArray[np.float64] | None
    """The curves of the walls, where there are any."""
    shear: NDArray[np.void] | None
    """The SHEAR of a gas that is sheared."""
    heat: NDArray[np.void] | None
    """The HEAT of a gas whose heat current is measured."""
    turned: NDArray[np.float64] | None
    """Of such a gas the integrals of the spins over time until each ball's last event, by its number, (N, 3)."""
