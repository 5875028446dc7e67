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
from carom.engine.swarm_arrays import CODES, ROOM
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
def cell_of(swarm: Any, axis: int, x: float) -> int:
    """The cell that holds x along an axis."""
    return S(max(0, min(S(x / swarm.size[axis]), swarm.cells[axis] - 1)))  # type: ignore[no-any-return]


@kernel
def put_in_cell(swarm: Any, cells: Any, body: Any, i: int) -> bool:
    """Ball i enters its cell; False if the cell is full."""
    cell, stride = body.cell, swarm.stride
    first = cell[0] * stride[0] + cell[1] * stride[1] + cell[2] * stride[2]
    count = S(cells[U(first)])
    if count + 1 >= stride[0]:
        return False
    cells[U(first + count + 1)] = i
    cells[U(first)] = count + 1
    return True


@kernel
def leave_cell(swarm: Any, cells: Any, body: Any, i: int) -> None:
    """Ball i leaves its cell; the last one takes its slot."""
    cell, stride = body.cell, swarm.stride
    first = cell[0] * stride[0] + cell[1] * stride[1] + cell[2] * stride[2]
    count = S(cells[U(first)])
    last = cells[U(first + count)]
    for k in range(1, count):
        if cells[U(first + k)] == i:
            cells[U(first + k)] = last
    cells[U(first)] = count - 1


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
    for c in range(z0, z1):
        third = offsets[U(2), U(cz), U(c)]
        for b in range(y0, y1):
            second = third + offsets[U(1), U(cy), U(b)]
            for a in range(x0, x1):
                first = second + offsets[U(0), U(cx), U(a)]
                code = np.uint32((a | (b << 2) | (c << 4)) << CODES)
                count = S(cells[U(first)])
                for k in range(ROOM):
                    found[U(n + k)] = cells[U(first + 1 + k)] | code
                for k in range(ROOM, count):
                    found[U(n + k)] = cells[U(first + 1 + k)] | code
                n += count
    return n


@hot_kernel
def around(shifts: Any, near: Any, cx: int, cy: int, cz: int, x: float, y: float, z: float) -> None:
    """Where a ball at (x, y, z) is, seen from the three places along each axis: near (12,), axis by axis."""
    for k in range(3):
        near[U(k)] = x + shifts[U(0), U(cx), U(k)]
        near[U(4 + k)] = y + shifts[U(1), U(cy), U(k)]
        near[U(8 + k)] = z + shifts[U(2), U(cz), U(k)]
