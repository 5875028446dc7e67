"""The functions of ``math``, and Python's of numbers, for dual numbers in compiled code.

The rules are the same as in :mod:`carom.simulation.sensitivity.dual`, with the same bits.
"""

from __future__ import annotations

import functools
import inspect
import math
import operator
from collections.abc import Callable
from typing import Any

from carom.core.jit.dual.numbers import LANES, as_dual, dual_type, lane_of, scaled, value_of, with_value
from carom.core.jit.kernel import DERIVED, carries_slopes, only_slopes, root_of, steepest, without_slopes

__all__ = ["overload_for_duals", "register_functions"]


def _half_over_root(x: float) -> float:
    # (the size of a vector that is zero has no derivative: carom.simulation.sensitivity.dual)
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
    from carom.core.jit.compile import plain_numbers

    names = ", ".join(inspect.signature(function).parameters)
    space: dict[str, Any] = {"instead": instead, "plain": plain_numbers}
    exec(
        f"def typed({names}):\n    if plain({names}):\n        return None\n"
        f"    def call({names}):\n        return instead({names})\n    return call\n",
        space,
    )
    _overload(function, space["typed"])
