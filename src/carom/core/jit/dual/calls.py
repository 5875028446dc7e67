"""Call functions of dual numbers through their addresses (functions of floats: :mod:`carom.core.jit.pointers`)."""

from __future__ import annotations

import functools
from collections.abc import Callable, Sequence
from typing import Any

from carom.core.jit.dual.dual_records import load_dual, store_dual
from carom.core.jit.dual.numbers import LANES, compiled_only, declare, dual_type
from carom.core.jit.pointers import SIZE, answer_at

__all__ = ["dual_address", "read_duals", "register_calls_of_duals", "write_duals"]

_alive: list[Any] = []


@compiled_only
def read_duals(given: Any) -> Any:
    """Return the dual numbers at a place, as many as are registered."""


@compiled_only
def write_duals(out: Any, first: Any, second: Any) -> None:
    """Write two vectors of dual numbers to a place."""


def dual_address(entry: Callable[..., None], needs: Sequence[Callable[[], Any]] = (), keep: bool = False) -> int:
    """Compile a function of a place to read from and one to write to; return its address, valid while the process lives.

    ``needs`` are called before anything is compiled.
    """
    from carom.core.jit.compile import cfunc

    compiled = cfunc(entry, 0, keep, 2, needs)
    _alive.append(compiled)
    return int(compiled.address)


def _place(builder: Any, pointer: Any, k: int) -> tuple[Any, Any]:
    from llvmlite import ir

    at = [builder.gep(pointer, [ir.Constant(ir.IntType(64), k * (LANES + 1) + one)]) for one in (0, 1)]
    return at[0], at[1]


@functools.cache
def register_calls_of_duals(count: int) -> None:
    """Tell the compiler how functions of so many numbers are called."""
    from llvmlite import ir
    from numba import types
    from numba.core import cgutils
    from numba.core.typing.templates import signature

    from carom.core.jit.compile import plain_numbers

    dual, double = dual_type(), ir.DoubleType()
    many, three, six = types.UniTuple(dual, count), types.UniTuple(dual, 3), types.UniTuple(dual, SIZE)

    def load(context: Any, builder: Any, pointer: Any, kind: Any) -> Any:
        numbers = [load_dual(context, builder, *_place(builder, pointer, k)) for k in range(kind.count)]
        return context.make_tuple(builder, kind, numbers)

    def store(context: Any, builder: Any, pointer: Any, numbers: list[Any]) -> None:
        for k, number in enumerate(numbers):
            values, slopes = _place(builder, pointer, k)
            store_dual(context, builder, values, slopes, number)

    def read(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        return load(context, builder, args[0], many)

    def write(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        store(context, builder, args[0], [one for part in args[1:] for one in cgutils.unpack_tuple(builder, part)])
        return context.get_dummy_value()

    def jump(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        pointer = double.as_pointer()
        function = builder.inttoptr(args[0], ir.FunctionType(ir.VoidType(), [pointer, pointer]).as_pointer())
        given, out = (cgutils.alloca_once(builder, double, size=size * (LANES + 1)) for size in (count, SIZE))
        store(context, builder, given, cgutils.unpack_tuple(builder, args[1]))
        builder.call(function, [given, out])
        return load(context, builder, out, six)

    def typed_jump(args: Any) -> Any:
        if len(args) != 2 or plain_numbers(args[1]) or len(args[1]) != count:
            return None
        return signature(six, types.int64, many)

    # (a law may return floats where nothing depends on anything: they become dual numbers)
    declare(read_duals, lambda args: signature(many, *args), read)
    declare(write_duals, lambda args: signature(types.none, args[0], three, three), write)
    declare(answer_at, typed_jump, jump)
