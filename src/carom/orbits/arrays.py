"""What the loop over one ball's bounces reads: a table's pieces and what goes with them, as records of numbers."""

from __future__ import annotations

import numpy as np

__all__ = [
    "CELLS",
    "CONTACT",
    "CORNER",
    "DONE",
    "ENDS",
    "ESCAPED",
    "FREE",
    "GRAZED",
    "NO_SLIP",
    "PIECES",
    "ROLLING",
    "USER",
    "WORLD",
]

# A piece of the curve (or surface) that bounds the ball's CENTRE. ``n`` is a face's normal, towards the ball, or the centre
# of a circle, or of an arc in an ellipse the outward normal at its corners; ``c`` is the face's distance n.x = c, a circle's 1/r,
# an ellipse's first half axis; ``r`` is a radius, an ellipse's second half axis, or how far two windows lie apart. Along a face the
# tangent is (ny, -nx): the ball on its left.
PIECES = np.dtype(
    [
        ("n", "f8", (3,)),
        ("c", "f8"),
        ("r", "f8"),
        # where a face begins and ends; of an arc, begin = -1 or 1: only where x is left or right of the centre; of one in an
        # ellipse, on which side of the long axis it lies (0: all of it), and how far from the middle its corners are
        ("begin", "f8"),
        ("end", "f8"),
        # where it begins and ends with a corner; infinite where it does not
        ("low", "f8"),
        ("high", "f8"),
    ]
)

# The table, the ball and the law. The pieces lie in this order: faces, windows (through which a ball goes on in the next
# cell), circles seen from inside, circles seen from outside, ellipses, spheres; each field is where its kind ends.
WORLD = np.dtype(
    [
        ("faces", "i8"),
        ("windows", "i8"),
        ("inside", "i8"),
        ("outside", "i8"),
        ("ellipses", "i8"),
        ("spheres", "i8"),
        ("limited", "i8"),  # 1: faces have ends that count (the table is not convex)
        ("arcs", "i8"),  # 1: the centre's curve in the ellipse has corners
        ("planar", "i8"),
        ("corners", "i8"),  # 1: the orbit ends at a corner
        ("keeps", "i8"),  # 1: the law conserves the energy
        ("law", "i8"),
        ("user", "i8"),
        ("falls", "i8"),  # 1: it has a part across a wall
        ("pull", "f8", (3,)),  # acceleration
        ("a", "f8"),
        ("kappa", "f8"),
        ("e", "f8"),
        ("mu", "f8"),
        ("beta", "f8"),
        ("near", "f8"),  # a corner is met within this length
        ("inset", "f8"),  # of the centre's curve, within an ellipse
    ]
)

NO_SLIP, CONTACT, ROLLING, USER = 0, 1, 2, 3
# How an orbit ended.
DONE, ESCAPED, CORNER, GRAZED, FREE = 0, 1, 2, 3, 4
ENDS = ("bounces", "escaped", "corner", "grazed", "free")
CELLS = 1_000_000  # a flight through so many cells meets nothing
