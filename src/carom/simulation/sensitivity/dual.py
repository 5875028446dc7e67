"""Dual numbers: a value and its derivatives with respect to p parameters, (p,); and the functions of ``math`` that kernels use.

Comparisons look at the values: a kernel takes the branch that the run has taken, and what it returns is that branch's derivative.
Compiled code has the same numbers, with the same bits (:mod:`carom.core.jit.dual`).
(Clifford 1873; Griewank & Walther, Evaluating Derivatives, 2nd ed. 2008, chapter 3.)
"""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any

import numpy as np

__all__ = ["DUAL_MATH", "Dual", "derivative", "value"]


class Dual:
    """A number x + d eps."""

    __slots__ = ("d", "x")
    __array_ufunc__ = None  # (a number of NumPy's on the left leaves the operation to us)

    def __init__(self, x: float, d: Any) -> None:
        self.x, self.d = x, d

    def __add__(self, o: Any) -> Dual:
        """Sum."""
        return Dual(self.x + o.x, self.d + o.d) if isinstance(o, Dual) else Dual(self.x + o, self.d)

    __radd__ = __add__

    def __sub__(self, o: Any) -> Dual:
        """Difference."""
        return Dual(self.x - o.x, self.d - o.d) if isinstance(o, Dual) else Dual(self.x - o, self.d)

    def __rsub__(self, o: Any) -> Dual:
        """Difference."""
        return Dual(o - self.x, -self.d)

    def __mul__(self, o: Any) -> Dual:
        """Product."""
        return Dual(self.x * o.x, self.d * o.x + o.d * self.x) if isinstance(o, Dual) else Dual(self.x * o, self.d * o)

    __rmul__ = __mul__

    def __truediv__(self, o: Any) -> Dual:
        """Quotient."""
        if isinstance(o, Dual):
            q = self.x / o.x
            return Dual(q, (self.d - o.d * q) * (1 / o.x))
        return Dual(self.x / o, self.d * (1 / o))

    def __rtruediv__(self, o: Any) -> Dual:
        """Quotient."""
        q = o / self.x
        return Dual(q, -(self.d * q) * (1 / self.x))

    def __pow__(self, n: Any) -> Dual:
        """Power with a constant exponent."""
        return Dual(self.x**n, self.d * (n * self.x ** (n - 1))) if n else Dual(1.0, 0 * self.d)

    def __neg__(self) -> Dual:
        """Minus."""
        return Dual(-self.x, -self.d)

    def __pos__(self) -> Dual:
        """Plus."""
        return self

    def __abs__(self) -> Dual:
        """Size."""
        return -self if self.x < 0 else self

    def __lt__(self, o: Any) -> bool:
        """Compare values."""
        return bool(self.x < value(o))

    def __le__(self, o: Any) -> bool:
        """Compare values."""
        return bool(self.x <= value(o))

    def __gt__(self, o: Any) -> bool:
        """Compare values."""
        return bool(self.x > value(o))

    def __ge__(self, o: Any) -> bool:
        """Compare values."""
        return bool(self.x >= value(o))

    def __eq__(self, o: object) -> bool:
        """Compare values."""
        return bool(self.x == value(o))

    __hash__ = None  # type: ignore[assignment]

    def __bool__(self) -> bool:
        """Whether the value is not zero."""
        return self.x != 0

    def __int__(self) -> int:
        """Whole part of the value, whose derivative is zero wherever it has one."""
        return int(self.x)

    def __float__(self) -> float:
        """Refuse: a derivative would be lost without a word."""
        raise TypeError(
            "a function that is neither carom's nor in Python's math was called with a number that has a derivative"
        )

    def __repr__(self) -> str:
        """Value and derivatives."""
        return f"Dual({self.x!r}, {self.d!r})"


def value(number: Any) -> Any:
    """Return the value of a dual number, or the number."""
    return number.x if isinstance(number, Dual) else number


def derivative(number: Any, p: int) -> Any:
    """Return the derivatives (p,) of a number."""
    return number.d if isinstance(number, Dual) else np.zeros(p)


def _chain(function: Any, slope: Any) -> Any:
    def lifted(x: Any) -> Any:
        return Dual(function(x.x), x.d * slope(x.x)) if isinstance(x, Dual) else function(x)

    return lifted


def _sqrt(x: Any) -> Any:
    if not isinstance(x, Dual):
        return math.sqrt(x)
    root = math.sqrt(x.x)
    # (the size of a vector that is zero has no derivative; nothing that is returned depends on it then: a kernel multiplies it by
    # the vector, or compares it)
    return Dual(root, x.d * (1 / (2 * root) if root > 0 else 0.0))


def _hypot(x: Any, y: Any) -> Any:
    return _sqrt(x * x + y * y)


def _atan2(y: Any, x: Any) -> Any:
    y0, x0 = value(y), value(x)
    size = x0 * x0 + y0 * y0
    slope = (x0 / size) * getattr(y, "d", 0.0) - (y0 / size) * getattr(x, "d", 0.0)
    return Dual(math.atan2(y0, x0), slope) if isinstance(y, Dual) or isinstance(x, Dual) else math.atan2(y, x)


def _test(function: Any) -> Any:
    return lambda x: function(value(x))


DUAL_MATH = SimpleNamespace(
    inf=math.inf, nan=math.nan, pi=math.pi, tau=math.tau, e=math.e,
    isnan=_test(math.isnan), isfinite=_test(math.isfinite), isinf=_test(math.isinf),
    floor=_test(math.floor), ceil=_test(math.ceil), trunc=_test(math.trunc),
    fabs=abs, sqrt=_sqrt, hypot=_hypot, atan2=_atan2,
    exp=_chain(math.exp, math.exp), log=_chain(math.log, lambda x: 1 / x), log1p=_chain(math.log1p, lambda x: 1 / (1 + x)),
    expm1=_chain(math.expm1, math.exp), sin=_chain(math.sin, math.cos), cos=_chain(math.cos, lambda x: -math.sin(x)),
    tan=_chain(math.tan, lambda x: 1 + math.tan(x) * math.tan(x)),
    tanh=_chain(math.tanh, lambda x: 1 - math.tanh(x) * math.tanh(x)),
    sinh=_chain(math.sinh, math.cosh), cosh=_chain(math.cosh, math.sinh),
    atan=_chain(math.atan, lambda x: 1 / (1 + x * x)), asin=_chain(math.asin, lambda x: 1 / math.sqrt(1 - x * x)),
    acos=_chain(math.acos, lambda x: -1 / math.sqrt(1 - x * x)), pow=lambda x, n: x**n,
    copysign=lambda x, y: abs(x) if math.copysign(1.0, value(y)) > 0 else -abs(x),
)  # fmt: skip
