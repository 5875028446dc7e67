"""What is wrong with a polygon: every fault one line, with the corners, the same for an orbit's table and a gas's container."""

import math
from itertools import pairwise

import numpy as np
import pytest

import carom
from carom import billiards
from carom.gas import container
from carom.scene.figures.polygons import MOST, outline_faults

RUNS, LIES, CROSS, ONCE, TOUCH = (
    "run back",
    "lie on each other",
    "do not cross",
    "each corner once",
    "does not touch itself",
)
# Of each the corners; of each fault a word of what was expected, and one of what came.
WRONG = {
    "a slit": ([(0, 0), (4, 0), (4, 4), (2, 4), (2, 2), (2, 4), (0, 4)], [(RUNS, "corner 5 to 6 back along that from 4 to 5")]),
    "a slit with a corner more": (
        [(0, 0), (4, 0), (4, 4), (2, 4), (2, 3), (2, 2), (2, 4), (0, 4)],
        [(RUNS, "corner 6 to 7"), (LIES, "corner 4 to 5 and from corner 6 to 7")],
    ),
    "a slit as wide as rounding": (
        [(0, 0), (4, 0), (4, 4), (2 + 1e-12, 4), (2 + 1e-12, 2), (2, 2), (2, 4), (0, 4)],
        [(ONCE, "corners 5 and 6 both at (2, 2)"), (RUNS, "5 to 7")],
    ),
    "a spike": ([(0, 0), (6, 0), (4, 0), (4, 4), (0, 4)], [(RUNS, "corner 2 to 3 back along that from 1 to 2")]),
    "closed twice": ([(0, 0), (4, 0), (4, 4), (0, 4), (0, 0)], [(ONCE, "1 and 5 both at (0, 0); the last side closes by itself")]),
    "a corner thrice": ([(0, 0), (4, 0), (4, 0), (4, 0), (0, 4)], [(ONCE, "2 and 3"), (ONCE, "3 and 4")]),
    "a bow": ([(0, 0), (4, 4), (4, 0), (0, 4)], [(CROSS, "corner 1 to 2 and from corner 3 to 4, which meet at (2, 2)")]),
    "two rooms": ([(0, 0), (2, 2), (4, 0), (4, 4), (2, 2), (0, 4)], [(TOUCH, "corners 2 and 5 both at (2, 2)")]),
    "a corner on a side": ([(0, 0), (4, 0), (4, 4), (2, 0), (0, 4)], [(TOUCH, "corner 4, (2, 0), on the side from corner 1 to 2")]),
    "a side on a side": ([(0, 0), (5, 0), (5, 1), (4, 0), (1, 0), (1, 3), (0, 3)], [(LIES, "1 to 2 and from corner 4 to 5")]),
    "on a line": ([(0, 0), (1, 0), (3, 0), (2, 0)], [("some area", "on one line")]),
    "a point": ([(1, 1)] * 3, [(ONCE, "1 and 2"), (ONCE, "2 and 3"), (ONCE, "1 and 3"), ("some area", "on one line")]),
    "several": (
        [(0, 0), (4, 0), (4, 0), (4, 4), (2, 4), (2, 2), (2, 4), (0, 4), (3, 1), (-1, 1)],
        [(ONCE, "2 and 3"), (RUNS, "6 to 7"), (TOUCH, "corner 6, (2, 2), on the side from corner 8 to 9")],
    ),
}  # fmt: skip
RIGHT = {
    "a slit with a width": [(0, 0), (4, 0), (4, 4), (2 + 1e-6, 4), (2 + 1e-6, 2), (2, 2), (2, 4), (0, 4)],
    "a side in two parts": [(0, 0), (2, 0), (4, 0), (4, 4), (0, 4)],
    "far away": [(1e6, 1e6), (1e6 + 1, 1e6), (1e6 + 1, 1e6 + 1), (1e6, 1e6 + 1)],
    "a star": [
        ((2 + k % 2) * math.cos(k * math.pi / 7) + 4, (2 + k % 2) * math.sin(k * math.pi / 7) + 4) for k in range(14)
    ],
}


@pytest.mark.parametrize("turned", [0.0, 1.0])
@pytest.mark.parametrize("name", WRONG)
def test_every_fault_is_told_once(name, turned):
    """As it is given, and turned about: what lies on what does not depend on the axes."""
    corners, said = WRONG[name]
    cos, sin = math.cos(turned), math.sin(turned)
    found = outline_faults(np.array(corners, float) @ [[cos, sin], [-sin, cos]])
    assert len(found) == len(said), found
    for (expected, came), (one, other) in zip(said, found, strict=True):
        assert expected in one
        assert turned or came in other


@pytest.mark.parametrize("name", WRONG)
def test_orbits_and_gases_say_it(name):
    corners, said = WRONG[name]
    x = np.array(corners, float) + 2.0
    for make, where in ((billiards.polygon, "polygon"), (lambda x: container("polygon", points=x), "container")):
        with pytest.raises(carom.CaromError) as caught:
            make(x)
        assert len(caught.value.faults) == len(said)
        assert all(
            fault.startswith(f"{where}: points: expected ") and len(fault.splitlines()) == 1
            for fault in caught.value.faults
        )


@pytest.mark.parametrize("name", RIGHT)
def test_what_is_right_is_left_alone(name):
    for corners in (RIGHT[name], RIGHT[name][::-1]):
        assert outline_faults(np.array(corners, float)) == []
        assert billiards.polygon(corners).shape(0.0).lengths.sum() > 0
        assert container("polygon", points=corners).volume > 0


def test_a_knot_is_told_in_part():
    """Against every pair of sides asked one by one; of many faults some are told, and how many more there are."""
    rng = np.random.default_rng(5)
    for count in (5, 9, 30):
        corners = rng.uniform(0, 1, (count, 2))
        sides = list(pairwise([*corners, corners[0]]))

        def left(a, b, c):
            return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) > 0

        crossings = sum(
            left(*one, two[0]) != left(*one, two[1]) and left(*two, one[0]) != left(*two, one[1])
            for i, one in enumerate(sides)
            for j, two in enumerate(sides)
            if i < j and j - i not in (1, count - 1)
        )
        found = outline_faults(corners)
        if crossings <= MOST:
            assert len(found) == crossings
        else:
            assert found[-1][1] == f"{crossings - MOST} more of these"
