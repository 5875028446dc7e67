"""Functions with two derivatives, against mpmath's Taylor series."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import mpmath
import numpy as np
import pytest

from carom.scene.figures.figure import FUNCTIONS, call, variable

CASES: list[tuple[Callable[[Any], Any], Callable[[Any], Any]]] = [
    (lambda t: 1 + 0.3 * np.cos(2 * t) / (2 - t), lambda t: 1 + 0.3 * mpmath.cos(2 * t) / (2 - t)),
    (lambda t: (t**3 - 2 * t) ** 2 - t**1.5, lambda t: (t**3 - 2 * t) ** 2 - t**1.5),
    (lambda t: np.exp(-t * t) * abs(t - 3) + 2**t, lambda t: mpmath.exp(-t * t) * abs(t - 3) + 2**t),
    (lambda t: t**t + 1 / t - (-t), lambda t: t**t + 1 / t + t),
    (lambda t: t**0 + t**1 + np.sqrt(t), lambda t: 1 + t + mpmath.sqrt(t)),
]


@pytest.mark.parametrize("case", range(len(CASES)))
def test_derivatives_are_those_of_the_series(case: int) -> None:
    ours, theirs = CASES[case]
    t = np.array([0.3, 0.9, 1.7])
    found = ours(variable(t))
    for k in range(3):
        x, d, half = (float(one) for one in mpmath.taylor(theirs, t[k], 2))
        assert (found.x[k], found.d[k], found.dd[k]) == pytest.approx((x, d, 2 * half), rel=1e-12)


@pytest.mark.parametrize("name", FUNCTIONS)
def test_each_function(name: str) -> None:
    theirs = {"arctan": mpmath.atan, "absolute": abs}.get(name) or getattr(mpmath, name)
    found = call(name, variable(np.array([0.7])) * 1.3)
    x, d, half = (float(one) for one in mpmath.taylor(lambda t: theirs(1.3 * t), 0.7, 2))
    assert (found.x[0], found.d[0], found.dd[0]) == pytest.approx((x, d, 2 * half), rel=1e-12)
