"""Sums of floats from left to right, with the same bits in every Python: from 3.12 on the built-in sum corrects its rounding."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any


def added(numbers: Iterable[Any]) -> Any:
    """Return the sum of numbers, each added to those before it."""
    total: Any = 0
    for one in numbers:
        total += one
    return total
