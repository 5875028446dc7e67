"""Functions that compiled code calls through their addresses: loops are compiled once, whatever they will call.

Such a function takes numbers and writes at most six. It is compiled by itself; the address may come from an array.
"""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import Any

__all__ = ["Answer", "address_of", "answer_at", "register_answers"]

Answer = tuple[float, float, float, float, float, float]
_entries: dict[int, Callable[..., None]] = {}
_alive: list[Any] = []


def answer_at(address: int, numbers: tuple[float, ...]) -> Answer:
    """What the function at an address writes for so many numbers; compiled code jumps there (:func:`register_answers`)."""
    out = [0.0] * 6
    _entries[address](*numbers, out)
    return (out[0], out[1], out[2], out[3], out[4], out[5])


def address_of(entry: Callable[..., None], numbers: int, keep: bool = False) -> int:
    """Compile a function of so many numbers, and of a place to write to; where it lies, as long as the process lives.

    ``keep``: it is loaded from the second time on.
    """
    from carom.compiled import cfunc

    compiled = cfunc(entry, numbers, keep)
    _entries[compiled.address] = entry
    _alive.append(compiled)
    return int(compiled.address)


@functools.cache
def register_answers() -> None:
    """Tell the compiler what :func:`answer_at` is."""
    from llvmlite import ir
    from numba import types
    from numba.core import cgutils
    from numba.extending import intrinsic, overload

    @intrinsic  # type: ignore[untyped-decorator]
    def jump(_context: Any, address: Any, numbers: Any) -> Any:
        def build(context: Any, builder: Any, signature: Any, args: Any) -> Any:
            double, index = ir.DoubleType(), ir.IntType(32)
            kind = ir.FunctionType(ir.VoidType(), [double] * numbers.count + [double.as_pointer()])
            function = builder.inttoptr(args[0], kind.as_pointer())
            out = cgutils.alloca_once(builder, double, size=6)
            builder.call(function, [*cgutils.unpack_tuple(builder, args[1]), out])
            found = [builder.load(builder.gep(out, [ir.Constant(index, k)])) for k in range(6)]
            return context.make_tuple(builder, signature.return_type, found)

        return types.UniTuple(types.float64, 6)(address, numbers), build

    # (Numba compares the annotations of the two signatures as well)
    @overload(answer_at)  # type: ignore[untyped-decorator]
    def _answer_at(address: Any, numbers: Any) -> Any:
        def call(address: Any, numbers: Any) -> Any:
            return jump(address, numbers)

        return call
