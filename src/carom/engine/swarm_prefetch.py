"""Asking for memory before it is needed: a million balls lie far from the processor, and what comes next is known."""

from __future__ import annotations

import functools
from typing import Any

from carom.engine.queue import U
from carom.engine.swarm_arrays import NOBODY
from carom.kernel import hot_kernel

__all__ = ["look_ahead", "prefetch", "register_prefetch"]

# So many bins, of one event each, before their time the balls are asked for, then the cells around them, then who is there.
FAR, MIDDLE, NEAR = 20, 12, 6


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
def look_ahead(
    plans: Any, motions: Any, bodies: Any, cells: Any, offsets: Any, heads: Any, bin_: int, bins: int
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
        middle = offsets[U(0), U(plan.cx), U(1)]
        for c in range(3):
            third = offsets[U(2), U(plan.cz), U(c)] + middle
            for b in range(3):
                first = third + offsets[U(1), U(plan.cy), U(b)]
                prefetch(cells, U(first - 8))
                prefetch(cells, U(first + 8))
        i = plan.next
        if i != NOBODY:
            prefetch(motions, U(i))
    i = heads[U(min(bin_ + NEAR, bins - 1))]
    while i != NOBODY:
        plan = plans[U(i)]
        for c in range(3):
            third = offsets[U(2), U(plan.cz), U(c)]
            for b in range(3):
                second = third + offsets[U(1), U(plan.cy), U(b)]
                for a in range(3):
                    first = second + offsets[U(0), U(plan.cx), U(a)]
                    prefetch(motions, U(cells[U(first + 1)]))
                    prefetch(motions, U(cells[U(first + 2)]))
        i = plan.next
