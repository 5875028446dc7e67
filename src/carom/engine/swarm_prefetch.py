"""Asking for memory before it is needed: a million balls lie far from the processor, and what comes next is known."""

from __future__ import annotations

import functools
from typing import Any

from carom.engine.cells import NUMBERS
from carom.engine.queue import S, U
from carom.engine.swarm_arrays import NOBODY
from carom.kernel import hot_kernel

__all__ = ["look_ahead", "prefetch", "register_prefetch"]

# So many bins, of one event each, before their time the balls are asked for, then the cells around them, then who is there;
# last who is around their partners.
FAR, MIDDLE, NEAR, CLOSE = 20, 12, 6, 3
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
            # for reading, to be kept, data
            builder.call(function, [address, *(ir.Constant(word, number) for number in (0, 3, 1))])
            return context.get_dummy_value()

        return types.void(array, index), build

    @overload(prefetch)  # type: ignore[untyped-decorator]
    def _prefetch(array: Any, index: Any) -> Any:
        def call(array: Any, index: Any) -> Any:
            ask(array, index)

        return call


@hot_kernel
def _around(plan: Any) -> tuple[int, int, int, int, int, int, int, int, int]:
    """All the cells around that of a ball."""
    return S(plan.cx), S(plan.cy), S(plan.cz), 0, 3, 0, 3, 0, 3


@hot_kernel
def _searched(grid: Any, plan: Any) -> tuple[int, int, int, int, int, int, int, int, int]:
    """The cell around which a ball will look at its next event, and which of the three places along each axis."""
    x, y, z = S(plan.cx), S(plan.cy), S(plan.cz)
    which = S(plan.turn)
    if plan.hit_at == plan.at or which >= FACES:
        return _around(plan)
    # it goes over to the next cell, and looks at those beyond
    up = which & 1
    step, first = 2 * up - 1, 2 * up
    if which < 2:
        return (x + step) % grid[U(0)], y, z, first, first + 1, 0, 3, 0, 3
    if which < 4:
        return x, (y + step) % grid[U(1)], z, 0, 3, first, first + 1, 0, 3
    return x, y, (z + step) % grid[U(2)], 0, 3, 0, 3, first, first + 1


@hot_kernel
def _ask_cells(cells: Any, offsets: Any, there: Any) -> None:
    """Ask for cells: for the first and the last of each row."""
    x, y, z, x0, x1, y0, y1, z0, z1 = there
    left, right = offsets[U(0), U(x), U(x0)], offsets[U(0), U(x), U(x1 - 1)] + 1
    for c in range(z0, z1):
        third = offsets[U(2), U(z), U(c)]
        for b in range(y0, y1):
            first = third + offsets[U(1), U(y), U(b)]
            prefetch(cells, U(first + left))
            prefetch(cells, U(first + right))


@hot_kernel
def _ask_balls(motions: Any, cells: Any, offsets: Any, there: Any) -> None:
    """Ask for the first two balls of each cell."""
    x, y, z, x0, x1, y0, y1, z0, z1 = there
    for c in range(z0, z1):
        third = offsets[U(2), U(z), U(c)]
        for b in range(y0, y1):
            second = third + offsets[U(1), U(y), U(b)]
            for a in range(x0, x1):
                first = second + offsets[U(0), U(x), U(a)]
                prefetch(motions, U(cells[U(first)] & NUMBERS))
                prefetch(motions, U(cells[U(first + 1)] & NUMBERS))


@hot_kernel
def look_ahead(
    plans: Any, motions: Any, bodies: Any, cells: Any, offsets: Any, grid: Any, heads: Any, bin_: int, bins: int
) -> None:
    """Ask for what the balls of the bins ahead of bin_ will need: the first of each bin, and the next ones as they show."""
    i = heads[U(min(bin_ + FAR, bins - 1))]
    if i != NOBODY:
        prefetch(plans, U(i))
        prefetch(motions, U(i))
    i = heads[U(min(bin_ + MIDDLE, bins - 1))]
    while i != NOBODY:
        plan = plans[U(i)]
        if plan.hit_at == plan.at:
            j = plan.hit_who
            prefetch(plans, U(j))
            prefetch(motions, U(j))
            prefetch(bodies, U(i))
            prefetch(bodies, U(j))
        _ask_cells(cells, offsets, _searched(grid, plan))
        i = plan.next
        if i != NOBODY:
            prefetch(motions, U(i))
    i = heads[U(min(bin_ + NEAR, bins - 1))]
    while i != NOBODY:
        plan = plans[U(i)]
        _ask_balls(motions, cells, offsets, _searched(grid, plan))
        if plan.hit_at == plan.at:
            _ask_cells(cells, offsets, _around(plans[U(plan.hit_who)]))
        i = plan.next
    i = heads[U(min(bin_ + CLOSE, bins - 1))]
    while i != NOBODY:
        plan = plans[U(i)]
        if plan.hit_at == plan.at:
            other = plans[U(plan.hit_who)]
            if other.cx != plan.cx or other.cy != plan.cy or other.cz != plan.cz:
                _ask_balls(motions, cells, offsets, _around(other))
        i = plan.next
