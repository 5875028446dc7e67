"""Asking for memory before it is needed: a million balls lie far from the processor, and what comes next is known.

It is asked for page by page of the calendar, some hundred events ahead, a note or two at a time: the balls that are noted there;
a page later, when these have come, the cells around them and whom they will meet; another page later, who is in those cells. It
goes into the second cache; the first is too small for all that.
"""

from __future__ import annotations

import functools
from typing import Any

from carom.engine.cells import NUMBERS
from carom.engine.queue import LEAF, PAGE, S, U, is_noted
from carom.kernel import hot_kernel

__all__ = ["look_ahead", "next_pages", "prefetch", "register_prefetch"]

Region = tuple[int, int, int, int, int, int, int, int, int]
PLANS, CELLS, BALLS = range(3)  # what is asked for, in turn
NOTES = 2  # so many at once
SECOND = 2  # cache, as LLVM counts: 3 is the first
FACES = 6  # of a cell: the least ``turn`` that is no way out of it


def prefetch(array: Any, index: int) -> None:
    """Ask for element ``index`` of an array; as Python it does nothing."""


@functools.cache
def register_prefetch() -> None:
    """Tell the compiler what :func:`prefetch` is."""
    from llvmlite import ir
    from numba import types
    from numba.core import cgutils
    from numba.extending import intrinsic, overload

    @intrinsic  # type: ignore[untyped-decorator]
    def ask(_context: Any, array: Any, index: Any) -> Any:
        def build(context: Any, builder: Any, signature: Any, args: Any) -> Any:
            kind = signature.args[0]
            data = context.make_array(kind)(context, builder, args[0]).data
            byte, word = ir.IntType(8), ir.IntType(32)
            step = context.get_abi_sizeof(context.get_data_type(kind.dtype))
            place = builder.mul(args[1], ir.Constant(args[1].type, step))
            address = builder.gep(builder.bitcast(data, byte.as_pointer()), [place])
            function = cgutils.get_or_insert_function(
                builder.module,
                ir.FunctionType(ir.VoidType(), [byte.as_pointer(), word, word, word]),
                "llvm.prefetch.p0",
            )
            # for reading, into which cache, data
            builder.call(function, [address, *(ir.Constant(word, number) for number in (0, SECOND, 1))])
            return context.get_dummy_value()

        return types.void(array, index), build

    @overload(prefetch)  # type: ignore[untyped-decorator]
    def _prefetch(array: Any, index: Any) -> Any:
        def call(array: Any, index: Any) -> Any:
            ask(array, index)

        return call


@hot_kernel
def _around(flat: bool, plan: Any) -> Region:
    """All the cells around that of a ball."""
    return S(plan.cx), S(plan.cy), S(plan.cz), 0, 3, 0, 3, 1 if flat else 0, 2 if flat else 3


@hot_kernel
def _round(place: int, n: int) -> int:
    return place - n if place >= n else (place + n if place < 0 else place)


@hot_kernel
def _searched(flat: bool, grid: Any, plan: Any) -> Region:
    """The cell around which a ball will look at its next event, and which of the three places along each axis."""
    x, y, z, x0, x1, y0, y1, z0, z1 = _around(flat, plan)
    which = S(plan.turn)
    if plan.hit_at == plan.at or which >= FACES:
        return x, y, z, x0, x1, y0, y1, z0, z1
    # it goes over to the next cell, and looks at those beyond
    up = which & 1
    step, first = 2 * up - 1, 2 * up
    if which < 2:
        return _round(x + step, grid[U(0)]), y, z, first, first + 1, y0, y1, z0, z1
    if which < 4:
        return x, _round(y + step, grid[U(1)]), z, x0, x1, first, first + 1, z0, z1
    return x, y, _round(z + step, grid[U(2)]), x0, x1, y0, y1, first, first + 1


@hot_kernel
def _ask_cells(cells: Any, offsets: Any, there: Region) -> None:
    """Ask for cells: those in the corners are in all the blocks that there are."""
    x, y, z, x0, x1, y0, y1, z0, z1 = there
    left, right = offsets[U(0), U(x), U(x0)], offsets[U(0), U(x), U(x1 - 1)]
    front, back = offsets[U(1), U(y), U(y0)], offsets[U(1), U(y), U(y1 - 1)]
    for c in range(2):
        third = offsets[U(2), U(z), U(z1 - 1 if c else z0)]
        prefetch(cells, U(third + front + left))
        prefetch(cells, U(third + front + right))
        prefetch(cells, U(third + back + left))
        prefetch(cells, U(third + back + right))


@hot_kernel
def _ask_two(motions: Any, cells: Any, first: int) -> None:
    """Ask for the first two balls of a cell."""
    prefetch(motions, U(cells[U(first)] & NUMBERS))
    prefetch(motions, U(cells[U(first + 1)] & NUMBERS))


@hot_kernel
def _ask_balls(motions: Any, cells: Any, offsets: Any, there: Region) -> None:
    """Ask for the first two balls of each cell."""
    x, y, z, x0, x1, y0, y1, z0, z1 = there
    left, middle, right = offsets[U(0), U(x), U(0)], offsets[U(0), U(x), U(1)], offsets[U(0), U(x), U(2)]
    ahead = right if x0 == 2 else left
    for c in range(z0, z1):
        third = offsets[U(2), U(z), U(c)]
        for b in range(y0, y1):
            second = third + offsets[U(1), U(y), U(b)]
            if x1 - x0 == 3:
                _ask_two(motions, cells, second + left)
                _ask_two(motions, cells, second + middle)
                _ask_two(motions, cells, second + right)
            else:
                _ask_two(motions, cells, second + ahead)


@hot_kernel
def _ask(
    stage: int, flat: bool, spins: bool, grid: Any, motions: Any, plans: Any, bodies: Any, cells: Any, offsets: Any, leaves: Any,
    page: int, tail: int,
) -> int:  # fmt: skip
    """Ask for a part of what the next balls noted on a page will need; ``tail``: where its notes end that are not done yet."""
    for _ in range(NOTES):
        if tail & (LEAF - 1) == 0:
            tail = S(leaves[U(tail)]) if tail != 0 else 0
            if tail == 0:
                return 0
        i = leaves[U(tail)]
        tail -= 1
        if stage == PLANS:
            prefetch(plans, U(i))
            prefetch(motions, U(i))
            continue
        plan = plans[U(i)]
        if not is_noted(plan, page):
            continue
        j, meets = plan.hit_who, plan.hit_at == plan.at
        if stage == BALLS:
            _ask_balls(motions, cells, offsets, _searched(flat, grid, plan))
            if meets and motions[U(j)].count == plan.hit_count:
                _ask_balls(motions, cells, offsets, _around(flat, plans[U(j)]))
            continue
        _ask_cells(cells, offsets, _searched(flat, grid, plan))
        if meets:
            prefetch(plans, U(j))
            prefetch(motions, U(j))
            if spins:
                prefetch(bodies, U(i))
                prefetch(bodies, U(j))
    return tail


@hot_kernel
def next_pages(tails: Any, page: int, bins: int) -> tuple[int, int, int]:
    """Where the notes end of the three pages that are asked for while this one lasts; 0 where the turn has no more pages.

    (What never happens is on the last page of all, which is not asked for.)
    """
    if (page + 4) * PAGE >= bins:
        return 0, 0, 0
    return S(tails[U(page + 2)]), S(tails[U(page + 3)]), S(tails[U(page + 4)])


@hot_kernel
def look_ahead(
    flat: bool, spins: bool, grid: Any, motions: Any, plans: Any, bodies: Any, cells: Any, offsets: Any, leaves: Any, page: int,
    tails: tuple[int, int, int],
) -> tuple[int, int, int]:  # fmt: skip
    """Ask for what some balls of the next pages will need; where their notes end that are not done yet. Once a bin."""
    plain = _ask(PLANS, flat, spins, grid, motions, plans, bodies, cells, offsets, leaves, page + 4, tails[2])
    known = _ask(CELLS, flat, spins, grid, motions, plans, bodies, cells, offsets, leaves, page + 3, tails[1])
    return (
        _ask(BALLS, flat, spins, grid, motions, plans, bodies, cells, offsets, leaves, page + 2, tails[0]),
        known,
        plain,
    )
