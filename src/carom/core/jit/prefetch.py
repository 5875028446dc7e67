"""Prefetch an element of an array into the processor's cache, from compiled code."""

from __future__ import annotations

import functools
from typing import Any

__all__ = ["prefetch", "register_prefetch"]

SECOND = 2  # cache, as LLVM counts: 3 is the first


def prefetch(array: Any, index: int) -> None:
    """Prefetch element ``index`` of an array into the second cache; as Python it does nothing."""


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
