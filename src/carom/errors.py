"""The error that carom raises for bad input, and the checks of arguments that raise it.

A check names where, what was expected, what came, and where possible what to do. Functions that check several arguments
collect their faults in a :class:`FaultList`, so that a user sees all of them at once.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from difflib import get_close_matches
from numbers import Real
from typing import Any

import numpy as np

__all__ = [
    "MAX_MAGNITUDE",
    "MIN_MAGNITUDE",
    "CaromError",
    "FaultList",
    "MissingLibraryError",
    "attempt",
    "broadcast_shape",
    "checked_number",
    "did_you_mean",
    "first_bad_index",
    "float_array",
    "float_or_nan",
    "noting",
    "require_type",
    "shortened_list",
    "suggestion",
    "with_size_limit",
]

# Squares of all inputs must be finite and not zero: no ball is faster, heavier or larger than the one, or moves more slowly
# without being at rest, is lighter or smaller than the other.
MAX_MAGNITUDE = 1e100
MIN_MAGNITUDE = 1e-100
MAX_SHOWN_CHARACTERS = 200  # of a bad value in a message


class CaromError(ValueError):
    """Raised for input that has no answer: where, what was expected, what was given, what to do.

    Attributes
    ----------
    faults : tuple of str
        One line per problem, so that a file with three problems reports all three at once. The command line prints them
        on standard error and ends with exit code 2.

    Examples
    --------
    >>> import carom
    >>> try:
    ...     carom.Ball(radius=-1, mass=0)
    ... except carom.CaromError as error:
    ...     for line in error.faults:
    ...         print(line)
    Ball: radius: expected a length in m, > 0, got -1
    Ball: mass: expected a mass in kg, > 0, got 0
    """

    def __init__(self, *faults: str) -> None:
        super().__init__("\n".join(faults))
        self.faults: tuple[str, ...] = faults


class MissingLibraryError(CaromError, ImportError):
    """Raised where an optional library is needed and not installed; the message names the extra that installs it."""


def attempt(found: list[str], action: Callable[..., Any], *args: Any) -> Any:
    """Return the result of an action; if it raises CaromError, append its faults to ``found`` and return None."""
    try:
        return action(*args)
    except CaromError as error:
        found += error.faults
        return None


@contextmanager
def noting(notes: Iterable[str]) -> Iterator[None]:
    """Attach notes to a CaromError raised in the block: notes made while reading a file often explain a later failure."""
    try:
        yield
    except CaromError as error:
        for note in notes:
            error.add_note(note)
        raise


class FaultList:
    """Collect the faults of one input, to raise them together.

    Parameters
    ----------
    where : str
        What is checked, such as ``"Ball"``; every message starts with it.
    """

    def __init__(self, where: str) -> None:
        self.where = where
        self.found: dict[str, str] = {}

    def add(self, field: str, expected: str, got: str) -> None:
        """Add the fault of a field; it replaces an earlier one of the same field."""
        self.found[field] = f"{self.where}: {field}: expected {expected}, got {_on_one_line(got)}"

    def add_another(self, field: str, expected: str, got: str) -> None:
        """Add one more fault of a field that may have several."""
        self.found[f"{field} {len(self.found)}"] = (
            f"{self.where}: {field}: expected {expected}, got {_on_one_line(got)}"
        )

    def add_remedy(self, field: str, remedy: str) -> None:
        """Append what to do to the fault of a field."""
        self.found[field] += f"; {remedy}"

    def has(self, field: str) -> bool:
        """Return whether a field has a fault."""
        return field in self.found

    def raise_if_any(self) -> None:
        """Raise CaromError with all faults, if there are any."""
        if self.found:
            raise CaromError(*self.found.values())


def _on_one_line(got: str) -> str:
    text = " ".join(got.split())
    return text if len(text) <= MAX_SHOWN_CHARACTERS else text[: MAX_SHOWN_CHARACTERS - 3] + "..."


# --- numbers and arrays --------------------------------------------------------------------------------------------


def checked_number(
    faults: FaultList, field: str, value: Any, expected: str, holds: Callable[[Any], Any], *, infinite: bool = False
) -> Any:
    """Return a float, or an array of floats, for which ``holds`` is true; else add a fault and return 1.0."""
    least = 0.0 if holds(0.0) else MIN_MAGNITUDE
    if type(value) is float or type(value) is int:  # the common case, without arrays
        if holds(value) and (least <= abs(value) <= MAX_MAGNITUDE or (infinite and value == np.inf)):
            return float(value)
        faults.add(field, with_size_limit(expected, value), f"{value!r}")
        return 1.0
    try:
        array = float_array(value)
    except (TypeError, ValueError):
        faults.add(field, expected, repr(value))
        return 1.0
    in_range = (np.abs(array) >= least) & (np.abs(array) <= MAX_MAGNITUDE)
    good = holds(array) & (in_range | (infinite & (array == np.inf)))
    bad = ~np.asarray(good)
    if bad.any():
        first = float(array[bad].flat[0])
        faults.add(field, with_size_limit(expected, first), f"{first!r}{first_bad_index(bad)}")
        return 1.0
    return float(array) if array.ndim == 0 else array


def with_size_limit(expected: str, value: float) -> str:
    """Return what is expected, with the largest or least size allowed if ``value`` is finite and beyond it."""
    if MAX_MAGNITUDE < abs(value) < np.inf:
        return f"{expected}, at most {MAX_MAGNITUDE:g} in size"
    return f"{expected}, at least {MIN_MAGNITUDE:g} in size" if 0 < abs(value) < MIN_MAGNITUDE else expected


def float_array(value: Any) -> np.ndarray[Any, np.dtype[np.float64]]:
    """Return a copy as an array of floats; TypeError or ValueError for text, None, masked and ragged input."""
    if isinstance(value, np.ma.MaskedArray) and np.ma.getmaskarray(value).any():
        raise TypeError("masked values are not numbers")
    array = np.asarray(value)
    if array.dtype.kind not in "biuf":
        raise TypeError("not numbers")
    return np.array(array, dtype=float)


def float_or_nan(value: Any) -> float:
    """Return a number as a float; NaN for what is not a number or is larger than a float can be."""
    try:
        return float(value) if isinstance(value, Real) else math.nan
    except OverflowError:
        return math.nan


def first_bad_index(bad: np.ndarray[Any, Any]) -> str:
    """Return where a boolean array is first true, as ``" at index (3,) (2 in all)"``; empty for a scalar."""
    return "" if bad.ndim == 0 else f" at index {tuple(int(i) for i in np.argwhere(bad)[0])} ({int(bad.sum())} in all)"


def broadcast_shape(*shapes: tuple[int, ...]) -> tuple[int, ...]:
    """Return the shape that all shapes broadcast to; CaromError if they do not."""
    try:
        return np.broadcast_shapes(*shapes)
    except ValueError:
        got = ", ".join(str(shape) for shape in shapes if shape)
        raise CaromError(f"shapes: expected states, normals and numbers that broadcast, got {got}") from None


def require_type(where: str, field: str, value: Any, kind: type, remedy: str = "") -> None:
    """Raise CaromError if an argument has another type: most often two are in the wrong order. ``where`` may be empty."""
    if not isinstance(value, kind):
        article = "an" if kind.__name__[0] in "AEIOU" else "a"
        got = " ".join(f"{value!r}".split())
        raise CaromError(
            f"{f'{where}: ' if where else ''}{field}: expected {article} {kind.__name__}, got {type(value).__name__} {got:.60};"
            f" {remedy or 'check the order of the arguments, or name them'}"
        )


# --- names ---------------------------------------------------------------------------------------------------------


def suggestion(name: str, known: Sequence[str]) -> str:
    """Return ``"did you mean 'X'?"`` for a name close to a known one, else the list of known names."""
    return did_you_mean(name, known).removeprefix("; ") or f"known are {', '.join(known)}"


def did_you_mean(name: str, known: Sequence[str]) -> str:
    """Return ``"; did you mean 'X'?"`` for a name close to a known one, else nothing: for messages that list the names."""
    close = get_close_matches(str(name), known, n=1, cutoff=0.5)
    return f"; did you mean {close[0]!r}?" if close else ""


def shortened_list(names: Sequence[str], most: int = 8) -> str:
    """Return names separated by commas, only the first of them if there are many: ``"a, b and 22 more"``."""
    rest = f" and {len(names) - most} more" if len(names) > most else ""
    return ", ".join(names[:most]) + rest
