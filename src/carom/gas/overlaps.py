"""Which balls of a start overlap: a list of the balls in each cell, and a compiled loop over pairs in neighbouring cells."""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.core.jit.kernel import kernel
from carom.core.jit.threads import row_slices

Array = NDArray[np.float64]
NONE = 0xFFFFFFFF  # end of a chain


def first_overlap(one: Any, radius: Array, x: Array, touch: float) -> tuple[int, int] | None:
    """Return the first pair (i < j) of balls that overlap by more than ``touch`` of the smaller radius, or None.

    ``one`` is the record of the system; its cells are at least as wide as the largest diameter.
    """
    n, side, periodic = one["cells"], one["side"], one["periodic"] == 1
    first, after = np.full(int(n.prod()), NONE, np.uint32), np.empty(len(x), np.uint32)
    place = np.zeros(3, np.int64)
    for rows in row_slices(len(x)):
        _, enter = compiled_loops()
        enter(x, rows.start, rows.stop, n, side, periodic, first, after, place)
    touch = float(touch)  # (an int, or an array of no axes, would have the search compiled again)
    for rows in row_slices(len(x)):
        search, _ = compiled_loops()
        # (the first ball has the pair that is asked for: its partner is the least)
        i, j = search(x, radius, rows.start, rows.stop, n, side, periodic, first, after, touch, place)
        if i >= 0:
            return int(i), int(j)
    return None


@functools.cache
def compiled_loops() -> tuple[Callable[..., Any], Callable[..., Any]]:
    """Return the compiled search, and what fills its cells."""
    from carom.core.jit.compile import njit

    return njit(_search, nogil=True), njit(_enter, nogil=True)


@kernel
def neighbour_cell(place: Any, step: int, n: Any, periodic: Any, axes: int) -> int:
    """Return the number of a cell's neighbour ``step`` (0 to 3^axes - 1, itself among them), or -1 beyond a side of the box."""
    cell, stride = 0, 1
    for axis in range(3):
        there = place[axis] + (step % 3 - 1 if axis < axes else 0)
        step //= 3
        if periodic[axis]:
            there %= n[axis]
        elif there < 0 or there >= n[axis]:
            return -1
        cell += stride * there
        stride *= n[axis]
    return cell


def _enter(x: Any, start: int, stop: int, n: Any, side: Any, periodic: Any, first: Any, after: Any, place: Any) -> None:
    """Put balls ``start`` to ``stop`` at the heads of their cells' chains; ``place`` (3,) is room for a cell's numbers."""
    for i in range(start, stop):
        for axis in range(3):
            r = x[i, axis] % side[axis] if periodic[axis] else x[i, axis]
            place[axis] = min(max(int(r / side[axis] * n[axis]), 0), n[axis] - 1)
        cell = (place[2] * n[1] + place[1]) * n[0] + place[0]
        after[i] = first[cell]
        first[cell] = i


def _search(
    x: Any, radius: Any, start: int, stop: int, n: Any, side: Any, periodic: Any, first: Any, after: Any, touch: float,
    place: Any,
) -> tuple[int, int]:  # fmt: skip
    """Return the first of the balls ``start`` to ``stop`` that overlaps a later one, and the first of those; or (-1, -1)."""
    for i in range(start, stop):
        for axis in range(3):
            r = x[i, axis] % side[axis] if periodic[axis] else x[i, axis]
            place[axis] = min(max(int(r / side[axis] * n[axis]), 0), n[axis] - 1)
        least: Any = -1
        for step in range(27):
            cell = neighbour_cell(place, step, n, periodic, 3)
            j: Any = np.int64(first[cell]) if cell >= 0 else np.int64(NONE)
            while j != NONE:
                if i < j and (least < 0 or j < least):
                    square = 0.0
                    for axis in range(3):
                        r = x[i, axis] - x[j, axis]
                        if periodic[axis]:
                            r -= side[axis] * np.round(r / side[axis])
                        square += r * r
                    reach = radius[i] + radius[j] - touch * min(radius[i], radius[j])
                    if square < reach * reach:
                        least = j
                j = np.int64(after[j])
        if least >= 0:
            return i, least
    return -1, -1
