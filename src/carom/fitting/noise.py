"""Distributions of errors: normal, Student's t, exponential on two sides."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

__all__ = ["ERRORS", "NORMAL", "Noise"]

Array = NDArray[np.float64]
ERRORS = ("normal", "student", "two-sided")
LEAST_C = 1e-6  # of c where the two-sided exponential has its peak


@dataclass(frozen=True)
class Noise:
    """The distribution of errors and scatter.

    Examples
    --------
    >>> Noise("student", grows=True).shapes
    1
    """

    errors: str = "normal"
    """One of ERRORS. "two-sided": exponential on both sides, with sizes of v_n's that may differ."""
    grows: bool = False
    """Whether the scatter grows with a fitted power of the speed."""

    @property
    def shapes(self) -> int:
        """Number of fitted numbers of the distribution's shape."""
        return int(self.errors != "normal")

    def rho(self, c: Array, first: Array, d: Array, shape: Array) -> tuple[Array, Array]:
        """Return the deviance (N,) of d numbers beside log det S, and its slope in c = r' S^-1 r; ``first``: v_n's residual."""
        if self.errors == "normal":
            return c, np.ones(len(c))
        if self.errors == "student":
            nu = math.exp(float(shape[0]))
            lgamma = np.vectorize(math.lgamma)
            constant = -2 * (lgamma((nu + d) / 2) - math.lgamma(nu / 2)) + d * math.log(nu / 2)
            return (nu + d) * np.log1p(c / nu) + constant, (nu + d) / (nu + c)
        # a multivariate exponential, exp(-sqrt((d + 1) c)); on the two sides of v_n = 0 its sizes are exp(+-a)
        a = float(shape[0])
        side = np.exp(-2 * a * np.sign(first))
        lgamma = np.vectorize(math.lgamma)
        constant = 2 * (lgamma(d + 1.0) + (1 + d) * math.log(2) - np.log(d) - lgamma(d / 2.0)) - d * np.log(
            4.0 * (d + 1)
        )
        constant = constant - d * math.log(2) + 2 * np.log(np.cosh(a * d))
        root = np.sqrt((d + 1) * np.maximum(c * side, LEAST_C))
        return 2 * root + constant, (d + 1) * side / root


NORMAL = Noise()
