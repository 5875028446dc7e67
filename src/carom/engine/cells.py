"""Cells: which balls are near. A cell is at least one diameter wide, so a ball can only touch those in the cells around it.

A cell is a row of slots: how many balls, then their numbers. The first few are copied whether they are filled or not, and
only the count decides what of it stays: no branch that a processor would have to guess. Beyond a wall lies a layer of
cells that stays empty. Neighbours over a periodic border are noted with the image that is near, so a box need be only
three cells wide.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from carom.engine.queue import S, U
from carom.engine.swarm_arrays import CODES, ROOM, SIZE, STRIDE
from carom.kernel import hot_kernel, kernel

__all__ = ["around", "cell_of", "gather", "leave_cell", "put_in_cell", "tables"]


def tables(swarm: Any) -> Any:
    """For each axis and place along it the three slots' offsets, and the shifts of the three images: two arrays."""
    most = int(swarm["cells"].max())
    offsets = np.zeros((3, most, 3), np.int64)
    shifts = np.zeros((3, most, 3))
    for axis in range(3):
        n, stride, side = int(swarm["cells"][axis]), int(swarm["stride"][axis]), float(swarm["side"][axis])
        for place in range(n):
            for k in range(3):
                there = place + k - 1
                if swarm["periodic"][axis]:
                    # the ball is moved instead of its neighbours
                    shifts[axis, place, k] = side if there < 0 else (-side if there >= n else 0.0)
                    there %= n
                elif there < 0:
                    there = n  # the empty layer
                offsets[axis, place, k] = there * stride
    return offsets, shifts


@hot_kernel
def cell_of(box: Any, grid: Any, axis: int, x: float) -> Any:
    """The cell that holds x along an axis."""
    return max(S(0), min(S(x / box[U(SIZE + axis)]), grid[U(axis)] - 1))


@kernel
def put_in_cell(grid: Any, cells: Any, plan: Any, i: int) -> bool:
    """Ball i enters its cell; False if the cell is full."""
    slots = grid[U(STRIDE)]
    first = plan.cx * slots + plan.cy * grid[U(STRIDE + 1)] + plan.cz * grid[U(STRIDE + 2)]
    count = S(cells[U(first)])
    if count + 1 >= slots:
        return False
    cells[U(first + count + 1)] = i
    cells[U(first)] = count + 1
    return True


@kernel
def leave_cell(grid: Any, cells: Any, plan: Any, i: int) -> None:
    """Ball i leaves its cell; the last one takes its slot."""
    first = plan.cx * grid[U(STRIDE)] + plan.cy * grid[U(STRIDE + 1)] + plan.cz * grid[U(STRIDE + 2)]
    count = S(cells[U(first)])
    last = cells[U(first + count)]
    for k in range(1, count):
        if cells[U(first + k)] == i:
            cells[U(first + k)] = last
    cells[U(first)] = count - 1


@kernel
def _rest(cells: Any, found: Any, first: int, n: int, count: int, code: Any) -> None:
    """The balls of a cell after the first few; seldom there are any."""
    for k in range(ROOM, count):
        found[U(n + k)] = cells[U(first + 1 + k)] | code


@hot_kernel
def _copy(cells: Any, found: Any, first: int, n: int, code: int) -> int:
    """Add the balls of a cell to those found; how many there are now."""
    image = np.uint32(code << CODES)
    count = S(cells[U(first)])
    # (ROOM of them, all read before the first is written, so that they are one load and one store)
    p, q = cells[U(first + 1)] | image, cells[U(first + 2)] | image
    r, s = cells[U(first + 3)] | image, cells[U(first + 4)] | image
    found[U(n)], found[U(n + 1)], found[U(n + 2)], found[U(n + 3)] = p, q, r, s
    if count > ROOM:
        _rest(cells, found, first, n, count, image)
    return n + count  # type: ignore[no-any-return]


@hot_kernel
def gather(
    cells: Any,
    offsets: Any,
    found: Any,
    cx: int,
    cy: int,
    cz: int,
    x0: int,
    x1: int,
    y0: int,
    y1: int,
    z0: int,
    z1: int,
) -> int:
    """Numbers of the balls in the cells around (cx, cy, cz), with the code of their image: how many."""
    n = 0
    left, middle, right = offsets[U(0), U(cx), U(0)], offsets[U(0), U(cx), U(1)], offsets[U(0), U(cx), U(2)]
    ahead = right if x0 == 2 else left
    for c in range(z0, z1):
        third = offsets[U(2), U(cz), U(c)]
        for b in range(y0, y1):
            first = third + offsets[U(1), U(cy), U(b)]
            code = (b << 2) | (c << 4)
            if x1 - x0 == 3:
                n = _copy(cells, found, first + left, n, code)
                n = _copy(cells, found, first + middle, n, code | 1)
                n = _copy(cells, found, first + right, n, code | 2)
            else:
                n = _copy(cells, found, first + ahead, n, code | x0)
    return n


@hot_kernel
def around(shifts: Any, near: Any, cx: int, cy: int, cz: int, x: float, y: float, z: float) -> None:
    """Where a ball at (x, y, z) is, seen from the three places along each axis: near (12,), axis by axis."""
    for k in range(3):
        near[U(k)] = x + shifts[U(0), U(cx), U(k)]
        near[U(4 + k)] = y + shifts[U(1), U(cy), U(k)]
        near[U(8 + k)] = z + shifts[U(2), U(cz), U(k)]
