"""How large a container may be beside its balls, and into how many cells or lattice steps it is divided."""

from __future__ import annotations

from collections.abc import Sequence

__all__ = ["BYTES_PER_BALL", "LONGEST_SIDE", "cells_at_most", "lattice_steps"]

LONGEST_SIDE = 1e9  # of the smallest radius: beyond it rounding of a position is no longer small beside a ball
BYTES_PER_BALL = 220.0  # of memory: all arrays of a gas, and those of its start
CELLS_PER_BALL = 8  # at most: empty cells cost memory, and save nothing


def cells_at_most(numbers: Sequence[float], balls: int) -> list[int]:
    """Return numbers of cells along each axis, the largest ones reduced so that there are not many more cells than balls.

    >>> cells_at_most([4.7, 3.2, 3.0], 20), cells_at_most([1e16, 3.0, 3.0], 20)
    ([4, 3, 3], [20, 3, 3])
    """
    left, found = float(27 + CELLS_PER_BALL * balls), [1] * len(numbers)
    order = sorted(range(len(numbers)), key=numbers.__getitem__)
    for rank, axis in enumerate(order):
        share = left ** (1 / (len(numbers) - rank))
        found[axis] = max(int(min(numbers[axis], share * (1 + 1e-12))), 1)
        left /= found[axis]
    return found


def lattice_steps(sides: Sequence[float], count: int, sites: int) -> list[float]:
    """Return numbers of steps, not rounded, that divide a box into nearly cubic cells with so many sites each, ``count`` in all.

    Along a side that is too short for a step it is 1.

    >>> lattice_steps([4.0, 4.0, 2.0], 128, 4), lattice_steps([1e6, 1.0, 1.0], 40, 4)
    ([4.0, 4.0, 2.0], [10.0, 1.0, 1.0])
    """
    found, free = [1.0] * len(sides), list(range(len(sides)))
    while free:
        volume = 1.0
        for axis in free:
            volume *= sides[axis]
        step = (volume * sites / count) ** (1 / len(free))
        short = [axis for axis in free if sides[axis] / step < 0.5]
        if not short:
            for axis in free:
                found[axis] = sides[axis] / step
            break
        free = [axis for axis in free if axis not in short]
    return found
