"""Mark kernels: plain functions of numbers and 3-tuples, the same in Python, and compiled.

A kernel takes and returns numbers and 3-tuples; it has no arrays, no objects, no ``assert``, no keyword arguments. It
uses + - * / and ``math.sqrt`` with integer literals, so that the very same function gives the same bits as Python and
compiled by Numba, and exact rationals when it is given ``fractions.Fraction``.

``@kernel`` only remembers the function: Numba is imported when something is compiled (:mod:`carom.core.jit.compile`).
"""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

Vec = tuple[float, float, float]
Function = TypeVar("Function", bound=Callable[..., Any])
Number = TypeVar("Number")

# A range whose steps do not depend on each other: in a loop that is compiled to run in parallel, it is Numba's.
prange: Any = range

KERNELS: list[Callable[..., Any]] = []
HOT: set[Callable[..., Any]] = set()


def kernel(function: Function) -> Function:
    """Mark a function as a kernel: callable as it is, and from compiled code."""
    KERNELS.append(function)
    return function


def kept_kernel(function: Function) -> Function:
    """Mark a kernel of hashable arguments whose last answers Python keeps: one that takes long, and is asked the same again."""
    return kernel(functools.lru_cache(4096)(function))  # type: ignore[return-value]


def hot_kernel(function: Function) -> Function:
    """Mark a kernel that runs for every ball: it is inlined into its caller, which halves the time of a short loop."""
    HOT.add(function)
    return kernel(function)


# Kernels whose derivatives differ from the derivatives of their steps, with the kernels that have them.
DERIVED: dict[Callable[..., Any], Callable[..., Any]] = {}


def derived_by(of_duals: Callable[..., Any]) -> Callable[[Function], Function]:
    """Mark a kernel in whose place another one takes dual numbers: what is integrated needs other steps for its derivatives."""

    def mark(function: Function) -> Function:
        DERIVED[function] = of_duals
        return kernel(function)

    return mark


@hot_kernel
def dot(p: Vec, q: Vec) -> float:
    """Return the scalar product."""
    return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]


@hot_kernel
def cross(p: Vec, q: Vec) -> Vec:
    """Return the vector product."""
    return (p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0])


@hot_kernel
def vector(row: Any) -> Vec:
    """Return three numbers of an array as a 3-tuple."""
    return (row[0], row[1], row[2])


def root_of(x: Number, gap: Any, rate: Any) -> Number:
    """Return x, a root that was found by trial: of a function with the value ``gap`` and the derivative ``rate`` there.

    Trial and error carry no derivatives. A dual root is x - gap / rate, by the implicit function theorem.
    """
    if not hasattr(gap, "d"):
        return x
    moved: Any = x - gap / getattr(rate, "x", rate)
    return type(moved)(getattr(x, "x", x), moved.d)  # type: ignore[no-any-return]


def carries_slopes(x: Any) -> bool:
    """Return whether x is a dual number, whose derivatives have to be followed as accurately as its value."""
    return hasattr(x, "d")


def steepest(x: Any) -> float:
    """Return the largest size of the derivatives of x; 0 for a plain number."""
    return float(abs(x.d).max()) if hasattr(x, "d") else 0.0


def without_slopes(x: Any) -> Any:
    """Return the value of x, a number whose derivatives have no meaning, such as the length of a step."""
    return getattr(x, "x", x)


def only_slopes(x: Any) -> Any:
    """Return zero with the derivatives of x (whose value may be infinite)."""
    return type(x)(0.0, x.d) if hasattr(x, "d") else 0.0


def _found_root(x: Any, gap: Any, rate: Any) -> Any:
    return x


def _no_slopes(x: Any) -> bool:
    return False


def _no_slope(x: Any) -> float:
    return 0.0


def _itself(x: Any) -> Any:
    return x


# The functions above of plain numbers, as they are compiled.
PLAIN: dict[Callable[..., Any], Callable[..., Any]] = {
    root_of: _found_root,
    carries_slopes: _no_slopes,
    steepest: _no_slope,
    only_slopes: _no_slope,
    without_slopes: _itself,
}


# ----------------------------------------------------------------------------------------------------
# Plain Python objects in place of NumPy records: kernels that Python runs are ten times as fast on them, with the same bits.


class ObjectArray(list[Any]):
    """Objects with the fields of records as attributes: numbers, and lists of numbers."""

    @property
    def shape(self) -> tuple[int]:
        """As an array of one axis has it."""
        return (len(self),)


@functools.cache
def _class_for(fields: tuple[str, ...]) -> type:
    return type("Record", (), {"__slots__": fields})


def as_objects(records: NDArray[np.void]) -> ObjectArray:
    """Return an object for each of the records (N,), with copies of its fields."""
    names = records.dtype.names or ()
    kind, objects = _class_for(names), ObjectArray()
    for values in zip(*(records[name].tolist() for name in names), strict=True):
        one = kind()
        for name, value in zip(names, values, strict=True):
            setattr(one, name, value)
        objects.append(one)
    return objects


def write_back(objects: ObjectArray, records: NDArray[np.void], count: int | None = None) -> None:
    """Write the objects, or the first ``count`` of them, into the records that they were made of."""
    some = objects[:count]
    for name in (records.dtype.names or ()) if some else ():
        records[name][: len(some)] = [getattr(one, name) for one in some]
