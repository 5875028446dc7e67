"""Checks of what people hand in: every fault of a thing at once, each one line."""

from __future__ import annotations

import math
from collections.abc import Callable
from difflib import get_close_matches
from numbers import Real
from typing import Any

import numpy as np

from carom.errors import CaromError

__all__ = [
    "LARGEST",
    "Faults",
    "expect",
    "few",
    "first_index",
    "float_array",
    "meant",
    "nearest",
    "number",
    "real",
    "require_shapes",
    "within",
]

# Squares of what a kernel takes must be finite: no ball is faster, heavier or larger than this.
LARGEST = 1e100
LONGEST = 200  # signs of what came that a fault shows


class Faults:
    """The faults of one thing, gathered so that all are told at once."""

    def __init__(self, where: str) -> None:
        self.where = where
        self.found: dict[str, str] = {}

    def add(self, field: str, expected: str, got: str) -> None:
        """One fault: which field, what was expected, what came."""
        self.found[field] = f"{self.where}: {field}: expected {expected}, got {_line(got)}"

    def also(self, field: str, expected: str, got: str) -> None:
        """One fault more of a field that may have several."""
        self.found[f"{field} {len(self.found)}"] = f"{self.where}: {field}: expected {expected}, got {_line(got)}"

    def advise(self, field: str, remedy: str) -> None:
        """What to do about a fault that was added."""
        self.found[field] += f"; {remedy}"

    def of(self, field: str) -> bool:
        """Whether a field is at fault."""
        return field in self.found

    def done(self) -> None:
        """Raise all that was found, if anything was."""
        if self.found:
            raise CaromError(*self.found.values())


def _line(got: str) -> str:
    """What came, on one line, however many an array is written in."""
    text = " ".join(got.split())
    return text if len(text) <= LONGEST else text[: LONGEST - 3] + "..."


def first_index(bad: np.ndarray[Any, Any]) -> str:
    """Where an array is first at fault: ``" at index (3,)"``; empty for a scalar."""
    return "" if bad.ndim == 0 else f" at index {tuple(int(i) for i in np.argwhere(bad)[0])} ({int(bad.sum())} in all)"


def float_array(value: Any) -> np.ndarray[Any, np.dtype[np.float64]]:
    """An array of floats, a copy; TypeError or ValueError for what is not made of numbers, text and None among it."""
    if isinstance(value, np.ma.MaskedArray) and np.ma.getmaskarray(value).any():
        raise TypeError("numbers that are masked are none")
    array = np.asarray(value)
    if array.dtype.kind not in "biuf":
        raise TypeError("not numbers")
    return np.array(array, dtype=float)


def number(
    faults: Faults, field: str, value: Any, expected: str, holds: Callable[[Any], Any], *, infinite: bool = False
) -> Any:
    """A float, or an array of floats, for which ``holds``; anything else is a fault and comes back as 1.0."""
    if type(value) is float or type(value) is int:  # the common case, without arrays
        if holds(value) and (value <= LARGEST or (infinite and value == np.inf)):
            return float(value)
        faults.add(field, within(expected, value), f"{value!r}")
        return 1.0
    try:
        array = float_array(value)
    except (TypeError, ValueError):
        faults.add(field, expected, repr(value))
        return 1.0
    good = holds(array) & ((array <= LARGEST) | (infinite & (array == np.inf)))
    bad = ~np.asarray(good)
    if bad.any():
        first = float(array[bad].flat[0])
        faults.add(field, within(expected, first), f"{first!r}{first_index(bad)}")
        return 1.0
    return float(array) if array.ndim == 0 else array


def real(value: Any) -> float:
    """A single number as a float; NaN, which holds for nothing, for what is none, or larger than a float can be."""
    try:
        return float(value) if isinstance(value, Real) else math.nan
    except OverflowError:
        return math.nan


def within(expected: str, value: float) -> str:
    """What is expected; for a number that is only too large, how large it may be."""
    return f"{expected}, at most {LARGEST:g} in size" if LARGEST < abs(value) < np.inf else expected


def require_shapes(*shapes: tuple[int, ...]) -> tuple[int, ...]:
    """The shape that all broadcast to; CaromError where they do not."""
    try:
        return np.broadcast_shapes(*shapes)
    except ValueError:
        got = ", ".join(str(shape) for shape in shapes if shape)
        raise CaromError(f"shapes: expected states, normals and numbers that broadcast, got {got}") from None


def expect(where: str, field: str, value: Any, kind: type) -> None:
    """CaromError where an argument is not of its kind: most often two are in the wrong order."""
    if not isinstance(value, kind):
        article = "an" if kind.__name__[0] in "AEIOU" else "a"
        raise CaromError(
            f"{where}: {field}: expected {article} {kind.__name__}, got {type(value).__name__} {value!r:.60};"
            " check the order of the arguments, or name them"
        )


def nearest(name: str, names: list[str]) -> str:
    """``"did you mean 'X'?"`` for a name that is close to a known one, else the list of them."""
    return meant(name, names).removeprefix("; ") or f"known are {', '.join(names)}"


def meant(name: str, names: list[str]) -> str:
    """``"; did you mean 'X'?"`` for a name that is close to a known one, else nothing: for a line that has listed them."""
    close = get_close_matches(str(name), names, n=1, cutoff=0.5)
    return f"; did you mean {close[0]!r}?" if close else ""


def few(names: list[str], most: int = 8) -> str:
    """Names in a line, the first of them where they are many: ``"a, b and 22 more"``."""
    rest = f" and {len(names) - most} more" if len(names) > most else ""
    return ", ".join(names[:most]) + rest
