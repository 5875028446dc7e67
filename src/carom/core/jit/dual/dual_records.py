"""Records whose numbers are dual: NumPy's records hold the values, an array beside them the derivatives.

Kernels read and write ``ball.v[0]`` and ``balls[k]`` as they do with plain records. The derivatives of record k are row k of an
array (N, numbers in a record, LANES); :func:`float_places` says where the derivatives of each field are.
"""

from __future__ import annotations

import functools
import operator
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from carom.core.jit.calls import SIZE, answer_at
from carom.core.jit.dual.numbers import LANES, compiled_only, declare, dual_type, lanes_type, make_dual, parts_of


@functools.cache
def float_places(dtype: Any) -> dict[str, slice]:
    """Return where the derivatives of each field with floating-point numbers are."""
    places: dict[str, slice] = {}
    at = 0
    for name in dtype.names or ():
        if dtype[name].base.kind == "f":
            size = int(np.prod(dtype[name].shape, dtype=int))
            places[name] = slice(at, at + size)
            at += size
    return places


@functools.cache
def float_count(dtype: Any) -> int:
    """Return how many floating-point numbers a record has."""
    return max((place.stop for place in float_places(dtype).values()), default=0)


@compiled_only
def dual_records(records: Any, derivatives: Any, c: int) -> Any:
    """Return records (N,) with the derivatives number c of (C, N, float_count, LANES)."""


# --- LLVM's code: a number is a place of its value, and one of its derivatives -----------------------------------------


def load_dual(context: Any, builder: Any, values: Any, slopes: Any) -> Any:
    """Return the number at two places."""
    # (they lie where NumPy has put them: no more than 8 bytes are promised)
    x = builder.load(builder.bitcast(values, _double().as_pointer()), align=8)
    return make_dual(context, builder, x, builder.load(builder.bitcast(slopes, lanes_type().as_pointer()), align=8))


def store_dual(context: Any, builder: Any, values: Any, slopes: Any, number: Any) -> None:
    """Write a number to two places."""
    x, d = parts_of(context, builder, number)
    builder.store(x, builder.bitcast(values, _double().as_pointer()), align=8)
    builder.store(d, builder.bitcast(slopes, lanes_type().as_pointer()), align=8)


def _double() -> Any:
    from llvmlite import ir

    return ir.DoubleType()


def _step(builder: Any, pointer: Any, kind: Any, by: Any) -> Any:
    """Return the place so many items of a kind further on."""
    from llvmlite import ir

    at = builder.bitcast(pointer, kind.as_pointer())
    return builder.gep(at, [by if isinstance(by, ir.Value) else ir.Constant(ir.IntType(64), by)])


def _view(context: Any, builder: Any, kind: Any, values: Any, slopes: Any, count: Any = None) -> Any:
    from numba.core import cgutils

    made = cgutils.create_struct_proxy(kind)(context, builder)
    made.values, made.slopes = values, slopes
    if count is not None:
        made.count = count
    return made._getvalue()


def _opened(context: Any, builder: Any, kind: Any, value: Any) -> tuple[Any, Any]:
    from numba.core import cgutils

    one = cgutils.create_struct_proxy(kind)(context, builder, value=value)
    return one.values, one.slopes


# --- types -------------------------------------------------------------------------------------------------------------


@functools.cache
def _kinds() -> tuple[Any, Any, Any]:
    """Return the classes of types: numbers in a row, a record, an array of records."""
    from numba import types
    from numba.extending import models, register_model
    from numba.np.numpy_support import as_dtype

    class DualVector(types.Type):  # type: ignore[misc]
        """Numbers of a record that stand one after the other."""

        def __init__(self) -> None:
            super().__init__(name=f"DualVector({LANES})")

    class DualRecord(types.Type):  # type: ignore[misc]
        """One record."""

        def __init__(self, record: Any) -> None:
            self.record, self.places = record, float_places(as_dtype(record))
            super().__init__(name=f"DualRecord({LANES}, {record})")

    class DualRecords(types.Type):  # type: ignore[misc]
        """An array of records."""

        def __init__(self, record: Any) -> None:
            self.record, self.numbers = record, float_count(as_dtype(record))
            super().__init__(name=f"DualRecords({LANES}, {record})")

    pointers = [("values", types.CPointer(types.uint8)), ("slopes", types.CPointer(types.float64))]
    for kind in (DualVector, DualRecord):
        register_model(kind)(lambda manager, one: models.StructModel(manager, one, pointers))
    counted = [*pointers, ("count", types.int64)]
    register_model(DualRecords)(lambda manager, one: models.StructModel(manager, one, counted))
    return DualVector, DualRecord, DualRecords


# --- what the compiler is told -----------------------------------------------------------------------------------------


@functools.cache
def register_records() -> None:
    """Tell the compiler what records of dual numbers are."""
    _fields()
    _items()
    _shape()
    _joined()


def _fields() -> None:
    """Read and write the fields of a record."""
    from llvmlite import ir
    from numba import types
    from numba.core.imputils import lower_getattr_generic, lower_setattr_generic
    from numba.core.typing.templates import AttributeTemplate, infer_getattr

    vector, record, _records = _kinds()
    byte = ir.IntType(8)

    class Fields(AttributeTemplate):  # type: ignore[misc]
        """The types of fields."""

        key = record

        def generic_resolve(self, one: Any, name: str) -> Any:
            """Return the type of a field."""
            of = one.record.fields[name].type
            if name not in one.places:
                return of
            return dual_type() if of is types.float64 else vector()

    infer_getattr(Fields)

    def place(context: Any, builder: Any, kind: Any, value: Any, name: str) -> tuple[Any, Any]:
        values, slopes = _opened(context, builder, kind, value)
        at = _step(builder, values, byte, kind.record.offset(name))
        if name in kind.places:
            slopes = _step(builder, slopes, _double(), kind.places[name].start * LANES)
        return at, slopes

    def read(context: Any, builder: Any, kind: Any, value: Any, name: str) -> Any:
        at, slopes = place(context, builder, kind, value, name)
        of = kind.record.fields[name].type
        if name not in kind.places:
            return builder.load(builder.bitcast(at, context.get_data_type(of).as_pointer()), align=8)
        if of is types.float64:
            return load_dual(context, builder, at, slopes)
        return _view(context, builder, vector(), at, slopes)

    def write(context: Any, builder: Any, sig: Any, args: Any, name: str) -> None:
        at, slopes = place(context, builder, sig.args[0], args[0], name)
        if name in sig.args[0].places:
            store_dual(context, builder, at, slopes, args[1])
        else:
            builder.store(args[1], builder.bitcast(at, args[1].type.as_pointer()), align=8)

    lower_getattr_generic(record)(read)
    lower_setattr_generic(record)(write)


def _items() -> None:
    """Read the items of vectors and arrays, and write the items of vectors."""
    from llvmlite import ir
    from numba import types
    from numba.core.typing.templates import signature

    vector, record, records = _kinds()
    dual, word = dual_type(), ir.IntType(64)

    def typed_read(args: Any) -> Any:
        row, index = args
        if not isinstance(index, types.Integer) or not isinstance(row, vector | records):
            return None
        return signature(dual if isinstance(row, vector) else record(row.record), row, types.int64)

    def typed_write(args: Any) -> Any:
        if not isinstance(args[0], vector) or not isinstance(args[1], types.Integer):
            return None
        return signature(types.none, args[0], types.int64, dual)

    def place(context: Any, builder: Any, sig: Any, args: Any) -> tuple[Any, Any]:
        values, slopes = _opened(context, builder, sig.args[0], args[0])
        lanes = builder.mul(args[1], ir.Constant(word, LANES))
        return _step(builder, values, _double(), args[1]), _step(builder, slopes, _double(), lanes)

    def component(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        values, slopes = place(context, builder, sig, args)
        return load_dual(context, builder, values, slopes)

    def row(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        kind = sig.args[0]
        values, slopes = _opened(context, builder, kind, args[0])
        values = _step(builder, values, ir.IntType(8), builder.mul(args[1], ir.Constant(word, kind.record.size)))
        lanes = builder.mul(args[1], ir.Constant(word, LANES * kind.numbers))
        return _view(context, builder, sig.return_type, values, _step(builder, slopes, _double(), lanes))

    def write(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        values, slopes = place(context, builder, sig, args)
        store_dual(context, builder, values, slopes, args[2])
        return context.get_dummy_value()

    declare(operator.getitem, lambda args: typed_read(args) if isinstance(args[0], vector) else None, component,
            ((vector, types.Integer),))  # fmt: skip
    declare(operator.getitem, lambda args: typed_read(args) if isinstance(args[0], records) else None, row,
            ((records, types.Integer),))  # fmt: skip
    declare(operator.setitem, typed_write, write, ((vector, types.Integer, type(dual)),))


def _shape() -> None:
    from numba import types
    from numba.core import cgutils
    from numba.core.imputils import lower_getattr
    from numba.core.typing.templates import AttributeTemplate, infer_getattr

    _vector, _record, records = _kinds()
    one_axis = types.UniTuple(types.int64, 1)

    class Shape(AttributeTemplate):  # type: ignore[misc]
        """How many records there are."""

        key = records

        def resolve_shape(self, rows: Any) -> Any:
            """Return the type of a shape."""
            return one_axis

    infer_getattr(Shape)

    def shape(context: Any, builder: Any, kind: Any, value: Any) -> Any:
        one = cgutils.create_struct_proxy(kind)(context, builder, value=value)
        return context.make_tuple(builder, one_axis, [one.count])

    lower_getattr(records, "shape")(shape)


def _joined() -> None:
    """Records with their derivatives."""
    from llvmlite import ir
    from numba import types
    from numba.core import cgutils
    from numba.core.typing.templates import signature

    _vector, _record, records = _kinds()
    byte = ir.IntType(8)

    def typed(args: Any) -> Any:
        rows, derivatives, _c = args
        return signature(records(rows.dtype), rows, derivatives, types.int64)

    def join(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        rows, slopes = (
            context.make_array(of)(context, builder, one) for of, one in zip(sig.args[:2], args[:2], strict=True)
        )
        stride = cgutils.unpack_tuple(builder, slopes.strides)[0]
        first = _step(builder, slopes.data, byte, builder.mul(args[2], stride))
        return _view(
            context, builder, sig.return_type, builder.bitcast(rows.data, byte.as_pointer()),
            builder.bitcast(first, _double().as_pointer()), cgutils.unpack_tuple(builder, rows.shape)[0],
        )  # fmt: skip

    declare(dual_records, typed, join)


# ----------------------------------------------------------------------------------------------------
# Call functions of dual numbers through their addresses (functions of floats: :mod:`carom.core.jit.calls`).


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
