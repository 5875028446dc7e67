"""Numbers with two derivatives: a function of one variable, in arithmetic and NumPy's functions, is differentiated exactly.

A jet holds arrays of values, first and second derivatives by the variable; each operation has its chain rule.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
# The value of each function, and its first and second derivative.
FUNCTIONS: dict[str, Callable[[Array], tuple[Array, Array, Array]]] = {
    "sin": lambda x: (np.sin(x), np.cos(x), -np.sin(x)),
    "cos": lambda x: (np.cos(x), -np.sin(x), -np.cos(x)),
    "tan": lambda x: (np.tan(x), 1 / np.cos(x) ** 2, 2 * np.tan(x) / np.cos(x) ** 2),
    "sinh": lambda x: (np.sinh(x), np.cosh(x), np.sinh(x)),
    "cosh": lambda x: (np.cosh(x), np.sinh(x), np.cosh(x)),
    "tanh": lambda x: (np.tanh(x), 1 / np.cosh(x) ** 2, -2 * np.tanh(x) / np.cosh(x) ** 2),
    "exp": lambda x: (np.exp(x), np.exp(x), np.exp(x)),
    "log": lambda x: (np.log(x), 1 / x, -1 / x**2),
    "sqrt": lambda x: (np.sqrt(x), 0.5 / np.sqrt(x), -0.25 / (x * np.sqrt(x))),
    "arctan": lambda x: (np.arctan(x), 1 / (1 + x * x), -2 * x / (1 + x * x) ** 2),
    "absolute": lambda x: (np.abs(x), np.sign(x), np.zeros_like(x)),
}
OPERATORS = {
    "add": "+",
    "subtract": "-",
    "multiply": "*",
    "divide": "/",
    "power": "**",
    "negative": "neg",
    "positive": "pos",
}


class Jet:
    """Values (N) with their first and second derivatives."""

    def __init__(self, x: Any, d: Any, dd: Any) -> None:
        self.x, self.d, self.dd = np.asarray(x, float), np.asarray(d, float), np.asarray(dd, float)

    def like(self, x: Any) -> Jet:
        """Return a number as a jet of the same kind without derivatives; a jet as it is."""
        return x if isinstance(x, Jet) else Jet(x, 0.0, 0.0)

    def of(self, x: Any, first: Any, second: Any) -> Jet:
        """Return a function of it that has the value x and these derivatives by it."""
        return Jet(x, first * self.d, second * self.d**2 + first * self.dd)

    def function(self, name: str) -> Jet:
        """Return one of FUNCTIONS of it."""
        return self.of(*FUNCTIONS[name](self.x))

    def __add__(self, other: Any) -> Jet:
        """Return the sum."""
        q = self.like(other)
        return Jet(self.x + q.x, self.d + q.d, self.dd + q.dd)

    def __neg__(self) -> Jet:
        """Return the negative."""
        return Jet(-self.x, -self.d, -self.dd)

    def __pos__(self) -> Jet:
        """Return itself."""
        return self

    def __sub__(self, other: Any) -> Jet:
        """Return the difference."""
        return self + -self.like(other)

    def __rsub__(self, other: Any) -> Jet:
        """Return the difference from a number."""
        found: Jet = -self + other
        return found

    def __mul__(self, other: Any) -> Jet:
        """Return the product."""
        q = self.like(other)
        return Jet(self.x * q.x, self.d * q.x + self.x * q.d, self.dd * q.x + 2 * self.d * q.d + self.x * q.dd)

    def __truediv__(self, other: Any) -> Jet:
        """Return the quotient."""
        q = self.like(other)
        return self * q.of(1 / q.x, -1 / q.x**2, 2 / q.x**3)

    def __rtruediv__(self, other: Any) -> Jet:
        """Return the quotient of a number by it."""
        return self.like(other) / self

    def __pow__(self, other: Any) -> Jet:
        """Return a power; with an exponent that varies, of a positive number."""
        if not isinstance(other, Jet) or not (other.d.any() or other.dd.any()):
            n = other.x if isinstance(other, Jet) else np.asarray(other, float)
            low = [np.where(n == k, 0.0, self.x ** np.where(n == k, 1.0, n - k - 1)) for k in (0, 1)]
            first = n * low[0]
            second = n * (n - 1) * np.where(n == 0, 0.0, low[1])
            return self.of(self.x**n, first, second)
        return call("exp", self.like(other) * call("log", self))

    def __rpow__(self, other: Any) -> Jet:
        """Return a number to the power of it."""
        found: Jet = self.like(other).__pow__(self)
        return found

    def __abs__(self) -> Jet:
        """Return the absolute value."""
        return call("absolute", self)

    __radd__ = __add__
    __rmul__ = __mul__

    def __array_ufunc__(self, ufunc: Any, method: str, *inputs: Any, **_options: Any) -> Any:
        """Apply NumPy's function."""
        name = ufunc.__name__
        if method != "__call__":
            return NotImplemented
        if name in FUNCTIONS and len(inputs) == 1:
            return call(name, inputs[0])
        if name in OPERATORS:
            first = self.like(inputs[0])
            work: dict[str, Callable[..., Jet]] = {
                "+": first.__add__, "-": first.__sub__, "*": first.__mul__, "/": first.__truediv__, "**": first.__pow__,
                "neg": lambda: -first, "pos": lambda: first,
            }  # fmt: skip
            return work[OPERATORS[name]](*inputs[1:])
        return NotImplemented


def as_jet(x: Any) -> Jet:
    """Return a number as a jet without derivatives; a jet as it is."""
    return x if isinstance(x, Jet) else Jet(x, 0.0, 0.0)


def call(name: str, x: Any) -> Jet:
    """Return one of FUNCTIONS of a jet."""
    return as_jet(x).function(name)


def variable(t: Array) -> Jet:
    """Return the variable itself at values (N)."""
    return Jet(t, np.ones_like(t), np.zeros_like(t))
