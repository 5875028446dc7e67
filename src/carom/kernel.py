"""What a kernel is: a plain function of numbers and 3-tuples, the same in Python, compiled, and on a GPU.

A kernel takes and returns numbers and 3-tuples; it has no arrays, no objects, no ``assert``, no keyword arguments. It
uses + - * / and ``math.sqrt`` with integer literals, so that the very same function gives the same bits as Python and
compiled by Numba, and exact rationals when it is handed ``fractions.Fraction``.

``@kernel`` only remembers the function: Numba is imported when something is compiled (:mod:`carom.compiled`).
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar

__all__ = ["HOT", "KERNELS", "Vec", "cross", "dot", "hot_kernel", "kernel", "vector"]

Vec = tuple[float, float, float]
Function = TypeVar("Function", bound=Callable[..., Any])

KERNELS: list[Callable[..., Any]] = []
HOT: set[Callable[..., Any]] = set()


def kernel(function: Function) -> Function:
    """Mark a function as a kernel: callable as it is, and from compiled code."""
    KERNELS.append(function)
    return function


def hot_kernel(function: Function) -> Function:
    """Mark a kernel that every ball passes through: compiled into its caller, which halves the time of a short loop."""
    HOT.add(function)
    return kernel(function)


@hot_kernel
def dot(p: Vec, q: Vec) -> float:
    """Scalar product."""
    return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]


@hot_kernel
def cross(p: Vec, q: Vec) -> Vec:
    """Vector product."""
    return (p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0])


@hot_kernel
def vector(row: Any) -> Vec:
    """Three numbers of an array as a 3-tuple."""
    return (row[0], row[1], row[2])
