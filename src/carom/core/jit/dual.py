"""The type of dual numbers: a value with LANES derivatives, held in vector registers, with + - * / and comparisons.

So every kernel can be compiled with dual numbers in the place of floats (:func:`register_numbers` tells the compiler). Comparisons
look at the values. Python has the same numbers, with the same bits (:mod:`carom.simulation.sensitivity.passages`): a quotient is a
product with the reciprocal in both.
"""

from __future__ import annotations

import functools
import inspect
import math
import operator
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from carom.core.jit.calls import SIZE, answer_at
from carom.core.jit.kernel import DERIVED, carries_slopes, only_slopes, root_of, steepest, without_slopes

# Derivatives in one number: one register of AVX-512, two of AVX2, four of NEON. More parameters are more passes.
# Measured with 4: 29 us instead of 34 for one parameter, 57 instead of 33 for six, 83 instead of 67 for twelve.
LANES = 8


# --- what kernels call beside operators and math; Python has them for any number with a value x and derivatives d --------


def value_of(x: Any) -> Any:
    """Return the value of a dual number, or the number."""
    return getattr(x, "x", x)


def with_value(x: Any, value: float) -> Any:
    """Return a dual number of a value with the derivatives of x."""
    return type(x)(value, x.d) if hasattr(x, "d") else value


def scaled(x: Any, value: float, slope: float) -> Any:
    """Return a dual number of a value, with ``slope`` times the derivatives of x."""
    return type(x)(value, x.d * slope) if hasattr(x, "d") else value


def as_dual(value: Any) -> Any:
    """Return a number as compiled code wants it where a dual number may stand: as one without derivatives."""
    return value


def depends(x: Any) -> bool:
    """Return whether any derivative of x differs from zero."""
    return bool(x.d.any()) if hasattr(x, "d") else False


def compiled_only(described: Callable[..., Any]) -> Callable[..., Any]:
    """Make a function a name for what :func:`declare` has compiled code do: Python has no such memory, and no body for it."""

    @functools.wraps(described)
    def refuse(*_given: Any) -> Any:
        raise TypeError(f"{described.__name__}: expected a call from compiled code, got one from Python")

    return refuse


def lane_of(x: Any, k: int) -> Any:
    """Return derivative k of a dual number."""
    return float(x.d[k])


@compiled_only
def seeded(value: float, k: int, slope: float) -> Any:
    """Return a dual number with one derivative, number k. (Python's are made by :mod:`carom.simulation.sensitivity.follow`.)"""


@compiled_only
def with_lane(x: Any, k: int, slope: float) -> Any:
    """Return a dual number with another derivative k."""


# --- types -------------------------------------------------------------------------------------------------------------


def lanes_type() -> Any:
    """Return LLVM's type of the derivatives."""
    from llvmlite import ir

    return ir.VectorType(ir.DoubleType(), LANES)


@functools.cache
def dual_type() -> Any:
    """Return Numba's type of dual numbers."""
    from numba import types
    from numba.core import typeconv
    from numba.extending import models, register_model

    class Lanes(types.Type):  # type: ignore[misc]
        """The derivatives."""

    class DualType(types.Type):  # type: ignore[misc]
        """A value and its derivatives."""

        def unify(self, typingctx: Any, other: Any) -> Any:
            """A float in one branch and a dual number in the other are a dual number."""
            return self if isinstance(other, types.Number | types.Boolean) else None

        def can_convert_from(self, typingctx: Any, other: Any) -> Any:
            """Any number is a dual number without derivatives."""
            return typeconv.Conversion.safe if isinstance(other, types.Number) else None

    lanes = Lanes(f"Lanes({LANES})")
    register_model(Lanes)(lambda manager, kind: models.PrimitiveModel(manager, kind, lanes_type()))
    members = [("x", types.float64), ("d", lanes)]
    register_model(DualType)(lambda manager, kind: models.StructModel(manager, kind, members))
    return DualType(f"Dual({LANES})")


# --- LLVM's code ---------------------------------------------------------------------------------------------------------


def make_dual(context: Any, builder: Any, x: Any, d: Any) -> Any:
    """Return the dual number of a value and derivatives, as LLVM's values."""
    from numba.core import cgutils

    made = cgutils.create_struct_proxy(dual_type())(context, builder)
    made.x, made.d = x, d
    return made._getvalue()


def parts_of(context: Any, builder: Any, number: Any) -> tuple[Any, Any]:
    """Return value and derivatives of a dual number, as LLVM's values."""
    from numba.core import cgutils

    one = cgutils.create_struct_proxy(dual_type())(context, builder, value=number)
    return one.x, one.d


def _splat(builder: Any, x: Any) -> Any:
    """Return the derivatives that are all x."""
    from llvmlite import ir

    index, none = ir.IntType(32), ir.Constant(lanes_type(), ir.Undefined)
    first = builder.insert_element(none, x, ir.Constant(index, 0))
    return builder.shuffle_vector(first, none, ir.Constant(ir.VectorType(index, LANES), [0] * LANES))


def _zeros() -> Any:
    from llvmlite import ir

    return ir.Constant(lanes_type(), [0.0] * LANES)


# Each takes two values and their derivatives, None for a float's.


def _sum(builder: Any, x: Any, dx: Any, y: Any, dy: Any) -> tuple[Any, Any]:
    return builder.fadd(x, y), builder.fadd(dx, dy) if dx is not None and dy is not None else dx or dy


def _difference(builder: Any, x: Any, dx: Any, y: Any, dy: Any) -> tuple[Any, Any]:
    d = dx if dy is None else builder.fneg(dy) if dx is None else builder.fsub(dx, dy)
    return builder.fsub(x, y), d


def _product(builder: Any, x: Any, dx: Any, y: Any, dy: Any) -> tuple[Any, Any]:
    one = None if dx is None else builder.fmul(dx, _splat(builder, y))
    two = None if dy is None else builder.fmul(dy, _splat(builder, x))
    return builder.fmul(x, y), builder.fadd(one, two) if one is not None and two is not None else one or two


def _quotient(builder: Any, x: Any, dx: Any, y: Any, dy: Any) -> tuple[Any, Any]:
    from llvmlite import ir

    q = builder.fdiv(x, y)
    over = _splat(builder, builder.fdiv(ir.Constant(ir.DoubleType(), 1.0), y))
    if dy is None:
        return q, builder.fmul(dx, over)
    turned = builder.fmul(dy, _splat(builder, q))
    return q, builder.fmul(builder.fneg(turned) if dx is None else builder.fsub(dx, turned), over)


OPERATIONS = {"add": _sum, "sub": _difference, "mul": _product, "truediv": _quotient}
COMPARISONS = {"lt": "<", "le": "<=", "gt": ">", "ge": ">=", "eq": "==", "ne": "!="}

# --- what the compiler is told -----------------------------------------------------------------------------------------


def declare(
    function: Any, typing: Callable[[Any], Any], build: Callable[..., Any], kinds: tuple[tuple[Any, ...], ...] = ()
) -> None:
    """Have compiled code do ``build`` for a call of a function; ``typing`` returns its signature for types, or None.

    ``kinds``: the classes of types of the arguments, for each combination; default: any.
    """
    from numba import types
    from numba.core.typing.templates import AbstractTemplate, infer_global
    from numba.extending import lower_builtin

    class Call(AbstractTemplate):  # type: ignore[misc]
        """How a call is typed."""

        key = function

        def generic(self, args: Any, kws: Any) -> Any:
            """Return the signature of a call."""
            return typing(args)

    infer_global(function)(Call)
    for one in kinds or ((types.VarArg(types.Any),),):
        lower_builtin(function, *one)(build)


@functools.cache
def register_numbers() -> None:
    """Tell the compiler what dual numbers are."""
    from numba import types
    from numba.extending import lower_cast

    kind = type(dual_type())

    def from_number(context: Any, builder: Any, fromty: Any, toty: Any, number: Any) -> Any:
        return make_dual(context, builder, context.cast(builder, number, fromty, types.float64), _zeros())

    for other in (types.Float, types.Integer, types.Boolean):
        lower_cast(other, kind)(from_number)
    for name, build in OPERATIONS.items():
        _operation(getattr(operator, name), build)
        _operation(getattr(operator, f"i{name}"), build)
    for name, sign in COMPARISONS.items():
        _comparison(getattr(operator, name), sign)
    _negation()
    _parts()


def _of_two(returns: Any) -> Callable[[Any], Any]:
    """Return the typing of an operation of two numbers, one of them dual at least."""
    from numba import types
    from numba.core.typing.templates import signature

    kind = dual_type()

    def typing(args: Any) -> Any:
        known = all(one is kind or isinstance(one, types.Number | types.Boolean) for one in args)
        if len(args) != 2 or kind not in args or not known:
            return None
        return signature(returns, *(kind if one is kind else types.float64 for one in args))

    return typing


def _pairs() -> Any:
    from numba import types

    kind = type(dual_type())
    return (kind, kind), (kind, types.Float), (types.Float, kind)


def _opened_numbers(context: Any, builder: Any, sig: Any, args: Any) -> list[tuple[Any, Any]]:
    """Return values and derivatives of arguments, None for floats."""
    kind = dual_type()
    return [
        parts_of(context, builder, one) if of is kind else (one, None) for of, one in zip(sig.args, args, strict=True)
    ]


def _operation(function: Any, build: Callable[..., tuple[Any, Any]]) -> None:
    def lower(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        (x, dx), (y, dy) = _opened_numbers(context, builder, sig, args)
        return make_dual(context, builder, *build(builder, x, dx, y, dy))

    declare(function, _of_two(dual_type()), lower, _pairs())


def _comparison(function: Any, sign: str) -> None:
    from numba import types

    def lower(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        (x, _dx), (y, _dy) = _opened_numbers(context, builder, sig, args)
        # (unordered only for !=: nothing equals a NaN)
        return (builder.fcmp_unordered if sign == "!=" else builder.fcmp_ordered)(sign, x, y)

    declare(function, _of_two(types.boolean), lower, _pairs())


def _negation() -> None:
    from numba.core.typing.templates import signature

    kind = dual_type()

    def lower(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        x, d = parts_of(context, builder, args[0])
        return make_dual(context, builder, builder.fneg(x), builder.fneg(d))

    declare(operator.neg, lambda args: signature(kind, kind) if args == (kind,) else None, lower, ((type(kind),),))


def _parts() -> None:
    """The functions at the top of this module."""
    from llvmlite import ir
    from numba import types
    from numba.core.typing.templates import signature

    kind, index = dual_type(), ir.IntType(32)

    def function(one: Any, returns: Any, others: tuple[Any, ...], build: Callable[..., Any]) -> None:
        def lower(context: Any, builder: Any, sig: Any, args: Any) -> Any:
            x, d = parts_of(context, builder, args[0])
            found = build(builder, x, d, *args[1:])
            return make_dual(context, builder, *found) if isinstance(found, tuple) else found

        declare(one, lambda _args: signature(returns, kind, *others), lower)

    def differs(builder: Any, x: Any, d: Any) -> Any:
        bits = builder.bitcast(builder.fcmp_unordered("!=", d, _zeros()), ir.IntType(LANES))
        return builder.icmp_unsigned("!=", bits, ir.Constant(ir.IntType(LANES), 0))

    function(value_of, types.float64, (), lambda builder, x, d: x)
    function(with_value, kind, (types.float64,), lambda builder, x, d, value: (value, d))

    def seed(builder: Any, x: Any, d: Any, k: Any, slope: Any) -> Any:
        return x, builder.insert_element(_zeros(), slope, builder.trunc(k, index))

    function(seeded, kind, (types.int64, types.float64), seed)
    function(as_dual, kind, (), lambda builder, x, d: (x, d))
    function(depends, types.boolean, (), differs)
    function(
        scaled, kind, (types.float64,) * 2,
        lambda builder, x, d, value, slope: (value, builder.fmul(d, _splat(builder, slope))),
    )  # fmt: skip
    function(
        lane_of,
        types.float64,
        (types.int64,),
        lambda builder, x, d, k: builder.extract_element(d, builder.trunc(k, index)),
    )
    function(
        with_lane, kind, (types.int64, types.float64),
        lambda builder, x, d, k, slope: (x, builder.insert_element(d, slope, builder.trunc(k, index))),
    )  # fmt: skip


# ----------------------------------------------------------------------------------------------------
# The functions of ``math``, and Python's of numbers, for dual numbers in compiled code.
#
# The rules are the same as in :mod:`carom.simulation.sensitivity.passages`, with the same bits.


def _half_over_root(x: float) -> float:
    # (the size of a vector that is zero has no derivative: carom.simulation.sensitivity.passages)
    return 1 / (2 * math.sqrt(x)) if x > 0 else 0.0


SLOPES: dict[Callable[..., float], Callable[[float], float]] = {
    math.sqrt: _half_over_root, math.exp: math.exp, math.log: lambda x: 1 / x, math.log1p: lambda x: 1 / (1 + x),
    math.expm1: math.exp, math.sin: math.cos, math.cos: lambda x: -math.sin(x), math.tan: lambda x: 1 + math.tan(x) * math.tan(x),
    math.sinh: math.cosh, math.cosh: math.sinh, math.tanh: lambda x: 1 - math.tanh(x) * math.tanh(x),
    math.atan: lambda x: 1 / (1 + x * x), math.asin: lambda x: 1 / math.sqrt(1 - x * x),
    math.acos: lambda x: -1 / math.sqrt(1 - x * x),
}  # fmt: skip
TESTS = (math.isnan, math.isfinite, math.isinf, math.floor, math.ceil, math.trunc, int)


@functools.cache
def register_functions() -> None:
    """Tell the compiler what these functions are of dual numbers."""
    for function, slope in SLOPES.items():
        _chain(function, slope)
    for function in TESTS:
        _of_value(function)
    _choice(max, lambda x, y: y if y > x else x)
    _choice(min, lambda x, y: y if y < x else x)
    for size in (abs, math.fabs):
        _instead(size, 1, lambda x: -x if x < 0 else x)
    _instead(float, 1, lambda x: x)
    _instead(math.hypot, 2, lambda x, y: math.sqrt(x * x + y * y))
    _instead(math.atan2, 2, _angle)
    _instead(math.copysign, 2, lambda x, y: abs(x) if math.copysign(1.0, value_of(y)) > 0 else -abs(x))
    _power()
    kind = dual_type()
    _overload(root_of, lambda x, gap, rate: _implicit if kind in (x, gap, rate) else None)
    _instead(carries_slopes, 1, lambda x: True)
    _instead(steepest, 1, _steepest)
    _instead(only_slopes, 1, _only_slopes)
    _instead(without_slopes, 1, _value)
    for function, of_duals in DERIVED.items():
        overload_for_duals(function, of_duals)


def _overload(function: Any, typed: Any) -> None:
    from numba.extending import overload

    overload(function, strict=False)(typed)  # (strict: Numba would compare the annotations as well)


def _instead(function: Any, arguments: int, work: Callable[..., Any]) -> None:
    """Have compiled code call ``work`` where one of the arguments is dual."""
    kind = dual_type()
    if arguments == 1:
        _overload(function, lambda x: work if x is kind else None)
    else:
        _overload(function, lambda x, y: work if kind in (x, y) else None)


def _chain(function: Any, slope: Any) -> None:
    """A function of one number, with its derivative."""
    from numba.extending import register_jitable

    if inspect.isfunction(slope):
        slope = register_jitable(slope)
    kind = dual_type()

    def work(x: Any) -> Any:
        return scaled(x, function(value_of(x)), slope(value_of(x)))

    _overload(function, lambda x: work if x is kind else None)


def _of_value(function: Any) -> None:
    """A function that is constant, or tests."""
    kind = dual_type()

    def work(x: Any) -> Any:
        return function(value_of(x))

    _overload(function, lambda x: work if x is kind else None)


def _choice(function: Any, of_two: Callable[..., Any]) -> None:
    """max and min, as Python has them: the first of two that are equal."""
    kind = dual_type()

    def of_three(x: Any, y: Any, z: Any) -> Any:
        return function(function(x, y), z)

    _instead(function, 2, of_two)
    _overload(function, lambda x, y, z: of_three if kind in (x, y, z) else None)


def _angle(y: Any, x: Any) -> Any:
    y0, x0 = value_of(y), value_of(x)
    size = x0 * x0 + y0 * y0
    # (y - y0 and x - x0 are the derivatives alone)
    return math.atan2(y0, x0) + ((y - y0) * (x0 / size) - (x - x0) * (y0 / size))


def _implicit(x: Any, gap: Any, rate: Any) -> Any:
    return with_value(as_dual(x) - gap / value_of(rate), value_of(x))


def _only_slopes(x: Any) -> Any:
    return with_value(x, 0.0)


def _value(x: Any) -> Any:
    return value_of(x)


def _steepest(x: Any) -> Any:
    # (a NaN is the largest, as NumPy has it)
    most = 0.0
    for k in range(LANES):
        slope = abs(lane_of(x, k))
        if not slope <= most and not math.isnan(most):
            most = slope
    return most


def _power() -> None:
    from numba import types

    kind = dual_type()

    def whole(x: Any, n: Any) -> Any:
        return scaled(x, value_of(x) ** n, n * value_of(x) ** (n - 1) if n != 0 else 0.0)

    def real(x: Any, n: Any) -> Any:
        return scaled(x, value_of(x) ** n, n * value_of(x) ** (n - 1))

    def typed(x: Any, n: Any) -> Any:
        if x is not kind or not isinstance(n, types.Integer | types.Float):
            return None
        return whole if isinstance(n, types.Integer) else real

    for function in (operator.pow, math.pow, pow):
        _overload(function, typed)


def overload_for_duals(function: Callable[..., Any], instead: Callable[..., Any]) -> None:
    """Have compiled code call another kernel where ``function`` is given dual numbers."""
    from carom.core.jit.compile import call_of

    _overload(function, call_of(function, lambda: instead, False))


# ----------------------------------------------------------------------------------------------------
# Records whose numbers are dual: NumPy's records hold the values, an array beside them the derivatives.
#
# Kernels read and write ``ball.v[0]`` and ``balls[k]`` as they do with plain records. The derivatives of record k are row k of an
# array (N, numbers in a record, LANES); :func:`float_places` says where the derivatives of each field are.


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


def _opened_records(context: Any, builder: Any, kind: Any, value: Any) -> tuple[Any, Any]:
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
        values, slopes = _opened_records(context, builder, kind, value)
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
        values, slopes = _opened_records(context, builder, sig.args[0], args[0])
        lanes = builder.mul(args[1], ir.Constant(word, LANES))
        return _step(builder, values, _double(), args[1]), _step(builder, slopes, _double(), lanes)

    def component(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        values, slopes = place(context, builder, sig, args)
        return load_dual(context, builder, values, slopes)

    def row(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        kind = sig.args[0]
        values, slopes = _opened_records(context, builder, kind, args[0])
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
