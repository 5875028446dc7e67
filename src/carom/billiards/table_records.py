"""The records that the compiled loops over one ball's bounces read and write: boundary pieces, the system, the state."""

from __future__ import annotations

import numpy as np

# A piece of the boundary of the region open to the ball's CENTRE. What the fields mean depends on the kind of piece:
#
#          face                                circle                    ellipse                               sphere
#   n      normal, towards the ball            centre                    outward normal at the arc's corners   zeros
#   c      distance: n.x = c on the face       1/radius                  half axis in x                        1/radius
#   r      of a window: distance to its twin   radius                    half axis in y                        radius
#   begin  where the face begins               -1, 1: only the half      side of the long axis (1, -1;         0
#                                              left, right of the        0: the whole curve)
#                                              centre; 0: all of it
#   end    where it ends                       0                         distance of the corners from the      0
#                                                                        middle, along the long axis
#
# Of an arc of a smooth curve: n, a direction along which it runs; c and r, the rows of its first and last nodes in the table of
# panels (:mod:`carom.core.geometry.curve`); begin and end, whether it begins and ends in a corner.
#
# Positions along a face are measured along the tangent (ny, -nx): the ball is on its left. ``low`` and ``high`` are the ends
# that are corners, infinite where the boundary goes on smoothly.
PIECES = np.dtype(
    [
        ("n", "f8", (3,)),
        ("c", "f8"),
        ("r", "f8"),
        ("begin", "f8"),
        ("end", "f8"),
        ("low", "f8"),
        ("high", "f8"),
    ]
)

# The table, the ball and the law. The pieces are sorted by kind: faces, windows (through which a ball passes into the next
# periodic cell), circles seen from inside, circles seen from outside, ellipses, smooth curves, spheres; each of the first seven
# fields is the index at which its kind ends.
WORLD = np.dtype(
    [
        ("faces", "i8"),
        ("windows", "i8"),
        ("inside", "i8"),
        ("outside", "i8"),
        ("ellipses", "i8"),
        ("curves", "i8"),
        ("spheres", "i8"),
        ("finite_faces", "i8"),  # 1: hits beyond the ends of a face are ignored (a stadium, a table that is not convex)
        ("arc_corners", "i8"),  # 1: the centre's curve in an ellipse or a smooth curve has corners
        ("planar", "i8"),  # 1: the table lies in the plane
        ("corners", "i8"),  # 1: an orbit ends at a corner
        ("conservative", "i8"),  # 1: the law conserves the energy
        ("law", "i8"),
        ("user", "i8"),
        ("flight", "i8"),  # as which flights meet the walls: STRAIGHT, PARABOLA or ARC
        ("acceleration", "f8", (3,)),  # m/s^2
        ("magnetic_field", "f8"),  # angular velocity at which the velocity turns, rad/s
        ("a", "f8"),  # radius, m
        ("kappa", "f8"),  # I/(m a^2)
        ("e", "f8"),  # restitution
        ("mu", "f8"),  # friction
        ("beta", "f8"),  # tangential restitution
        ("corner_tolerance", "f8"),  # m: nearer than this to a corner, the corner is hit
        ("inset", "f8"),  # m: distance of the centre's curve from the ellipse or the smooth curve
        ("extent", "f8"),  # m: of the table
    ]
)

# A force along all walls leaves them the straight flights: it changes where they lead, not when they meet a wall.
STRAIGHT, PARABOLA, ARC = 0, 1, 2

# Why an orbit ended: an index into ENDS.
DONE, ESCAPED, CORNER, GRAZED, FREE = 0, 1, 2, 3, 4
# Why and where an orbit ended; ``piece`` (of the tangent map only) is the last one met, -1 for none.
ENDING = np.dtype([("reason", "i8"), ("bounces", "i8"), ("piece", "i8")])
# A ball whose numbers have derivatives.
BODY = np.dtype([(name, "f8", (3,)) for name in ("x", "v", "w")])
# Columns of a row of ten numbers that holds the time and the state of a ball.
TIME, POSITION, VELOCITY, SPIN = 0, slice(1, 4), slice(4, 7), slice(7, 10)
ENDS = (
    "bounces",
    "escaped",
    "corner",
    "grazed",
    "free",
)  # free: no bounce ahead in a periodic cell, or on a closed circle
MAX_EMPTY_CELLS = 1_000_000  # a flight through this many periodic cells counts as free
