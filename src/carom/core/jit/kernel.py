"""Mark kernels: plain functions of numbers and 3-tuples, the same in Python, compiled, and on a GPU.

A kernel takes and returns numbers and 3-tuples; it has no arrays, no objects, no ``assert``, no keyword arguments. It
uses + - * / and ``math.sqrt`` with integer literals, so that the very same function gives the same bits as Python and
compiled by Numba, and exact rationals when it is given ``fractions.Fraction``.

``@kernel`` only remembers the function: Numba is imported when something is compiled (:mod:`carom.core.jit.compile`).
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar

__all__ = [
    "HOT",
    "KERNELS",
    "ON_GPU",
    "Vec",
    "cross",
    "dot",
    "found_root",
    "hot_kernel",
    "kernel",
    "prange",
    "root_of",
    "vector",
]

Vec = tuple[float, float, float]
Function = TypeVar("Function", bound=Callable[..., Any])
Number = TypeVar("Number")

# A range whose steps do not depend on each other: in a loop that is compiled to run in parallel, it is Numba's.
prange: Any = range

KERNELS: list[Callable[..., Any]] = []
HOT: set[Callable[..., Any]] = set()
# What the cores call in a way of its own (by an address, or linked in), with the function that a GPU compiles in its place.
ON_GPU: dict[Callable[..., Any], Callable[..., Any]] = {}


def kernel(function: Function) -> Function:
    """Mark a function as a kernel: callable as it is, and from compiled code."""
    KERNELS.append(function)
    return function


def hot_kernel(function: Function) -> Function:
    """Mark a kernel that runs for every ball: it is inlined into its caller, which halves the time of a short loop."""
    HOT.add(function)
    return kernel(function)


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

    Trial and error carry no derivatives. Of dual numbers the root has that of the implicit function theorem, x - gap / rate.
    """
    if not hasattr(gap, "d"):
        return x
    moved: Any = x - gap / getattr(rate, "x", rate)
    return type(moved)(getattr(x, "x", x), moved.d)  # type: ignore[no-any-return]


def found_root(x: Any, gap: Any, rate: Any) -> Any:
    """Return x: :func:`root_of` plain numbers, as it is compiled."""
    return x


ON_GPU[root_of] = found_root
