"""Call functions through their addresses from compiled code, so that a loop is compiled once for all that it will ever call.

A function called by :func:`answer_at` takes numbers and writes at most six; :func:`caller_of` makes a caller for any signature.
Such a function is compiled by itself; its address may stand in an array.
"""

from __future__ import annotations

import ctypes
import functools
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.core.jit.native import NativeLoop

Answer = tuple[float, float, float, float, float, float]
SIZE = 6
_functions: dict[int, Callable[[tuple[float, ...]], list[float]]] = {}
_alive: list[Any] = []


def answer_at(address: int, numbers: tuple[float, ...]) -> Answer:
    """Return the numbers that the function at an address writes, given so many numbers; compiled code jumps to it."""
    out = _functions[address](numbers)
    return (out[0], out[1], out[2], out[3], out[4], out[5])


def address_of(
    entry: Callable[..., None], numbers: int, keep: bool = False, needs: Sequence[Callable[[], Any]] = ()
) -> int:
    """Compile a function of so many numbers and of an array to write to; return its address, valid while the process lives.

    ``keep``: it is shipped with the package, or else what is compiled is cached; ``needs`` are called before it is compiled.
    """
    from carom.core.jit.compile import cfunc

    compiled = cfunc(entry, numbers, keep, needs=needs)
    call = ctypes.CFUNCTYPE(None, *[ctypes.c_double] * numbers, ctypes.c_void_p)(compiled.address)

    def answer(values: tuple[float, ...]) -> list[float]:
        out = (ctypes.c_double * SIZE)()
        call(*values, ctypes.byref(out))
        return list(out)

    _functions[compiled.address] = answer
    _alive.append(compiled)
    return int(compiled.address)


@functools.cache
def python_address(entry: Callable[..., None]) -> int:
    """Return a number by which :func:`answer_at` finds a function without compiling it; in Python only."""

    def answer(values: tuple[float, ...]) -> list[float]:
        out = [0.0] * SIZE
        entry(*values, out)
        return out

    number = -1 - len(_functions)  # no address is negative
    _functions[number] = answer
    return number


@functools.cache
def register_answers() -> None:
    """Tell the compiler what :func:`answer_at` is."""
    from llvmlite import ir
    from numba import types
    from numba.core import cgutils
    from numba.extending import intrinsic, overload

    from carom.core.jit.compile import plain_numbers

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
        if not plain_numbers(numbers):
            return None

        def call(address: Any, numbers: Any) -> Any:
            return jump(address, numbers)

        return call


# --- tables -------------------------------------------------------------------------------------------------------------------

_tables: dict[int, NDArray[np.float64]] = {}
_addresses: dict[bytes, int] = {}


def address_of_table(table: NDArray[np.float64]) -> int:
    """Return the address of a copy of a table, which is kept while the process lives; of equal tables it is the same."""
    content = np.ascontiguousarray(table, dtype=np.float64).tobytes()
    if content not in _addresses:
        kept = np.frombuffer(bytearray(content)).reshape(table.shape)
        _addresses[content] = int(kept.ctypes.data)
        _tables[_addresses[content]] = kept
    return _addresses[content]


def table_at(address: int, rows: int, columns: int) -> NDArray[np.float64]:
    """Return the table at an address; compiled code takes it to have so many rows, and does not look."""
    return _tables[address]


@functools.cache
def register_tables() -> None:
    """Tell the compiler what :func:`table_at` is."""
    from llvmlite import ir
    from numba import types
    from numba.core import cgutils
    from numba.extending import lower_builtin, type_callable
    from numba.np import arrayobj

    table = types.Array(types.float64, 2, "C")

    # (no overload: where references are not counted, a function returns no array)
    @type_callable(table_at)  # type: ignore[untyped-decorator]
    def _typed(_context: Any) -> Any:
        return lambda address, rows, columns: table

    @lower_builtin(table_at, types.Integer, types.Integer, types.Integer)  # type: ignore[untyped-decorator]
    def _view(context: Any, builder: Any, _signature: Any, args: Any) -> Any:
        made = arrayobj.make_array(table)(context, builder)
        size = context.get_constant(types.intp, 8)
        arrayobj.populate_array(
            made, data=builder.inttoptr(args[0], ir.DoubleType().as_pointer()), shape=cgutils.pack_array(builder, args[1:]),
            strides=cgutils.pack_array(builder, [builder.mul(args[2], size), size]), itemsize=size, meminfo=None,
        )  # fmt: skip
        return made._getvalue()


def compiled_address(compiled: Any) -> int:
    """Return the address of a function that is compiled for one signature (:func:`carom.core.jit.compile.njit`)."""
    if isinstance(compiled, NativeLoop):
        address = compiled.numba_address
        if address is not None:
            return address
        compiled = compiled.numbas()
    (found,) = compiled.overloads.values()
    return int(found.library.get_pointer_to_function(found.fndesc.llvm_func_name))


@functools.cache
def caller_of(returns: Any, *arguments: Any) -> Any:
    """Return the caller of a compiled function from compiled code, as ``caller(address, (arguments, ...))``.

    A loop that names such a function is compiled together with it, once more; and a function that is passed as an argument takes
    80 us to hand over.
    """
    from numba.core import cgutils
    from numba.extending import intrinsic

    from carom.core.jit.compile import numba_signature, signature

    kind = numba_signature(signature(returns, *arguments))

    @intrinsic  # type: ignore[untyped-decorator]
    def call(_context: Any, address: Any, given: Any) -> Any:
        def build(context: Any, builder: Any, typed: Any, args: Any) -> Any:
            values = [
                context.cast(builder, value, have, want)
                for value, have, want in zip(
                    cgutils.unpack_tuple(builder, args[1]), typed.args[1], kind.args, strict=True
                )
            ]
            of = context.call_conv.get_function_type(kind.return_type, kind.args)
            function = builder.inttoptr(args[0], of.as_pointer())
            status, found = context.call_conv.call_function(builder, function, kind.return_type, kind.args, values)
            with cgutils.if_unlikely(builder, status.is_error):
                context.call_conv.return_status_propagate(builder, status)
            return found

        return kind.return_type(address, given), build

    return call


def call_at(function: Callable[[Any, tuple[Any, ...]], Any], returns: Any, *arguments: Any) -> None:
    """Have compiled code that calls ``function(address, (arguments, ...))`` call what is compiled at that address.

    Python goes on calling ``function``.
    """
    from numba.extending import overload

    caller = caller_of(returns, *arguments)

    # (Numba wants the names that the function has)
    def typed(called: Any, given: Any) -> Any:
        def call(called: Any, given: Any) -> Any:
            return caller(called, given)

        return call

    overload(function)(typed)


# ----------------------------------------------------------------------------------------------------
# Prefetch an element of an array into the processor's cache, from compiled code.


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
