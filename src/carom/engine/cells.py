"""Cells: which balls are near. A cell is at least one diameter wide, so a ball can only touch those in the cells around it.

A cell has two slots for balls' numbers, the first with a code in its upper bits: how many there are, 3 for more than two. Those
hang on a chain that begins at the second ball, a link a ball; there are few of them. Both slots are copied whether they are
filled or not, and only the code decides what of it stays: no branch that a processor would have to guess. Beyond a wall lies
a layer of cells that stays empty. Neighbours over a periodic border are noted with the image that is near, so a box need be only
three cells wide.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.engine.queue import S, U
from carom.engine.swarm_arrays import CODES, NOBODY, SIZE
from carom.kernel import hot_kernel, kernel

__all__ = ["NUMBERS", "SLOTS", "along_curve", "around", "cell_of", "gather", "leave_cell", "put_in_cell", "tables"]

SLOTS = 2  # of a cell
NUMBERS = (1 << CODES) - 1
# Cells lie in memory along Morton's curve: those near each other in the room are near there too. By axes: that along which the
# curve steps with each bit of a cell's place, within a tile of 8 x 8 x 8 cells, 4 kB, of discs 16 x 16; tiles follow row by row.
# So a cache line is a block of 2 x 2 x 2 cells, of discs 4 x 2, and of the cells around one there are eight lines, and four.
CURVE = {3: (0, 1, 2) * 3, 2: (0, 0, 1, 1, 0, 1, 0, 1)}
MORE = 3  # the code of a cell with more balls than slots


def along_curve(swarm: Any) -> tuple[list[NDArray[np.int64]], int]:
    """By axis, what each place along it adds to where a cell's slots begin; and how many slots there are in all."""
    # (beyond a wall lies a layer of cells without balls)
    rooms = [int(n) + (0 if periodic else 1) for n, periodic in zip(swarm["cells"], swarm["periodic"], strict=True)]
    found = [np.zeros(room, np.int64) for room in rooms]
    bits, slots = [0, 0, 0], SLOTS
    for axis in CURVE[int(swarm["axes"])]:
        if 1 << bits[axis] < rooms[axis]:
            found[axis] += (np.arange(rooms[axis]) >> bits[axis] & 1) * slots
            bits[axis] += 1
            slots *= 2
    for axis, room in enumerate(rooms):
        found[axis] += (np.arange(room) >> bits[axis]) * slots
        slots *= (room - 1 >> bits[axis]) + 1
    return found, slots


def tables(swarm: Any) -> Any:
    """For each axis and place along it the three slots' offsets, and the shifts of the three images: two arrays."""
    most, places = int(swarm["cells"].max()), along_curve(swarm)[0]
    offsets = np.zeros((3, most, 3), np.int64)
    shifts = np.zeros((3, most, 3))
    for axis in range(3):
        n, side = int(swarm["cells"][axis]), float(swarm["side"][axis])
        for place in range(n):
            for k in range(3):
                there = place + k - 1
                if swarm["periodic"][axis]:
                    # the ball is moved instead of its neighbours
                    shifts[axis, place, k] = side if there < 0 else (-side if there >= n else 0.0)
                    there %= n
                elif there < 0:
                    there = n  # the empty layer
                offsets[axis, place, k] = places[axis][there]
    return offsets, shifts


@hot_kernel
def cell_of(box: Any, grid: Any, axis: int, x: float) -> Any:
    """The cell that holds x along an axis."""
    return max(S(0), min(S(x / box[U(SIZE + axis)]), grid[U(axis)] - 1))


@hot_kernel
def _slot(offsets: Any, plan: Any) -> int:
    """The first slot of a ball's cell."""
    x, y, z = U(plan.cx), U(plan.cy), U(plan.cz)
    return S(offsets[U(0), x, U(1)] + offsets[U(1), y, U(1)] + offsets[U(2), z, U(1)])  # type: ignore[no-any-return]


@kernel
def put_in_cell(offsets: Any, cells: Any, links: Any, plan: Any, i: int) -> None:
    """Ball i enters its cell."""
    first = _slot(offsets, plan)
    front, second = S(cells[U(first)]), S(cells[U(first + 1)])
    code = front >> CODES
    if code == 0:
        front = S(i)
    if code <= 1:
        cells[U(first + 1)] = i
    else:
        links[U(i)] = NOBODY if code == 2 else links[U(second)]
        links[U(second)] = i
    cells[U(first)] = (front & NUMBERS) | (min(code + 1, MORE) << CODES)


@kernel
def leave_cell(offsets: Any, cells: Any, links: Any, plan: Any, i: int) -> None:
    """Ball i leaves its cell; the first one of the chain takes its place, or the second of two."""
    first = _slot(offsets, plan)
    front, second = S(cells[U(first)]), S(cells[U(first + 1)])
    code, one = front >> CODES, front & NUMBERS
    if code < MORE:
        # (an empty slot names a ball that is near, or the first of all: they may be asked for in vain)
        one = 0 if code == 1 else (second if one == i else one)
        cells[U(first)], cells[U(first + 1)] = one | ((code - 1) << CODES), one
        return
    third = S(links[U(second)])
    rest = S(links[U(third)])
    code = 2 if rest == NOBODY else MORE
    # it is unhooked; whom it replaces is i, unless it is i
    links[U(second)] = rest
    if one == i:
        one = third
    elif second == i:
        links[U(third)] = rest
        cells[U(first + 1)] = third
    elif third != i:
        before = second
        while S(links[U(before)]) != i:
            before = S(links[U(before)])
        links[U(third)] = links[U(i)]
        links[U(before)] = third
    cells[U(first)] = one | (code << CODES)


@kernel
def _rest(links: Any, found: Any, second: int, n: int, image: Any) -> int:
    """Add the balls of a cell's chain to those found; seldom there are any."""
    k = links[U(second)]
    while k != NOBODY:
        found[U(n)] = k | image
        n += 1
        k = links[U(k)]
    return n


@hot_kernel
def _copy(cells: Any, links: Any, found: Any, first: int, n: int, code: int) -> int:
    """Add the balls of a cell to those found; how many there are now."""
    image = np.uint32(code << CODES)
    # (both read before the first is written, so that they are one load and one store)
    front, second = cells[U(first)], cells[U(first + 1)]
    found[U(n)], found[U(n + 1)] = (front & np.uint32(NUMBERS)) | image, second | image
    count = S(front >> np.uint32(CODES))
    if count == MORE:
        return _rest(links, found, second, n + 2, image)
    return n + count  # type: ignore[no-any-return]


@hot_kernel
def gather(
    cells: Any,
    links: Any,
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
                n = _copy(cells, links, found, first + left, n, code)
                n = _copy(cells, links, found, first + middle, n, code | 1)
                n = _copy(cells, links, found, first + right, n, code | 2)
            else:
                n = _copy(cells, links, found, first + ahead, n, code | x0)
    return n


@hot_kernel
def around(shifts: Any, near: Any, cx: int, cy: int, cz: int, x: float, y: float, z: float) -> None:
    """Where a ball at (x, y, z) is, seen from the three places along each axis: near (12,), axis by axis."""
    for k in range(3):
        near[U(k)] = x + shifts[U(0), U(cx), U(k)]
        near[U(4 + k)] = y + shifts[U(1), U(cy), U(k)]
        near[U(8 + k)] = z + shifts[U(2), U(cz), U(k)]
