"""The error that carom raises for bad input, and the checks of arguments that raise it.

A check names where, what was expected, what came, and where possible what to do. Functions that check several arguments
collect their faults in a :class:`FaultList`, so that a user sees all of them at once.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from difflib import get_close_matches
from numbers import Integral, Real
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import numpy as np
else:

    class _Numpy:
        """NumPy, from its first use on: the command's help needs none."""

        def __getattr__(self, name: str) -> Any:
            import numpy

            globals()["np"] = numpy
            return getattr(numpy, name)

    np = _Numpy()

# Squares of all inputs must be finite and not zero: no ball is faster, heavier or larger than the one, or moves more slowly
# without being at rest, is lighter or smaller than the other.
MAX_MAGNITUDE = 1e100
MIN_MAGNITUDE = 1e-100
MAX_COUNT = 2**60  # of what is counted, and of seeds: below the largest whole number of 64 bits
MAX_SHOWN_CHARACTERS = 200  # of a bad value in a message
# Shares of letters that a mistyped name and the name meant have in common, in order (difflib's ratio), at least.
NEAR = 0.7
NEAR_OF_ONE_LENGTH = 0.65  # one letter of three may be wrong


@dataclass(frozen=True)
class Fault:
    """One problem of an input, as a record; its text is made by ``str``, where it is shown.

    In all texts of the library the name of a parameter stands in backquotes, alone or with a value (as ``rate``, or
    ``view='side'``, in one pair of them): the command shows its own option in that place.

    Attributes
    ----------
    where : str
        The function, class or file in which the problem is.
    field : str
        The argument, or the path to the number, such as ``"balls[0].radius"``.
    expected, got : str
        Texts of both; without ``got`` nothing came. The words of another program, or of the system, begin with a colon.
    advice : str
        A remedy; alone it is a whole sentence that says what is wrong.

    Examples
    --------
    >>> str(Fault("Ball", "radius", "a length in m, > 0", "-1"))
    'Ball: radius: expected a length in m, > 0, got -1'
    """

    where: str = ""
    field: str = ""
    expected: str = ""
    got: str = ""
    advice: str = ""

    def __str__(self) -> str:
        """Return the line that is shown: ``where: field: expected ..., got ...; advice``."""
        got, said = _cut(" ".join(self.got.split()), MAX_SHOWN_CHARACTERS), ""
        said += f"expected {self.expected}" if self.expected else ""
        said += f", got{'' if got.startswith(':') else ' '}{got}" if got else ""
        said = "; ".join(filter(None, (said, self.advice)))
        return ": ".join(filter(None, map(str, (self.where, self.field, said))))

    def within(self, where: str) -> Fault:
        """Return the fault with a place in front of its own."""
        return replace(self, where=f"{where}: {self.where}" if self.where else where)


class CaromError(ValueError):
    """Raised for input that has no answer: where, what was expected, what was given, what to do.

    Parameters
    ----------
    *faults : Fault or str
        The problems, all at once.

    Attributes
    ----------
    faults : tuple of str
        One line per problem, so that a file with three problems reports all three at once. The command line prints them
        on standard error and ends with exit code 2.
    records : tuple of Fault
        The same as records; a problem that is given as a text is the ``advice`` of its record.

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

    def __init__(self, *faults: Fault | str) -> None:
        super().__init__(*faults)
        self.records = tuple(Fault(advice=fault) if isinstance(fault, str) else fault for fault in faults)

    @property
    def faults(self) -> tuple[str, ...]:
        """One line per problem."""
        return tuple(map(str, self.records))

    def records_at(self, where: str, *instead_of: str) -> list[Fault]:
        """Return the records with another place: all of them, or those with a place in ``instead_of``."""
        return [
            replace(fault, where=where) if fault.where in instead_of or not instead_of else fault
            for fault in self.records
        ]

    def __str__(self) -> str:
        """Return the lines of all problems."""
        return "\n".join(self.faults)


class MissingLibraryError(CaromError, ImportError):
    """Raised where an optional library is needed and not installed; the message names the extra that installs it."""


@contextmanager
def collected(found: FaultList) -> Iterator[None]:
    """Append the faults of a CaromError raised in the block to ``found``, in place of raising it."""
    try:
        yield
    except CaromError as error:
        found += error.records


@contextmanager
def noting(notes: Iterable[str]) -> Iterator[None]:
    """Attach notes to a CaromError raised in the block: notes made while reading a file often explain a later failure."""
    try:
        yield
    except CaromError as error:
        for note in notes:
            error.add_note(note)
        raise


class FaultList(list[Fault]):
    """The faults of one input, collected so that they are raised together.

    Parameters
    ----------
    where : str
        What is checked, such as ``"Ball"``: the place of all faults that :meth:`add` makes. A command leaves it empty and
        gives options as fields.
    """

    def __init__(self, where: str = "") -> None:
        super().__init__()
        self.where = where

    def add(self, field: str, expected: str, got: str = "", advice: str = "") -> None:
        """Add the fault of a field; a field may have several."""
        self.append(Fault(self.where, field, expected, got, advice))

    def attempt(self, action: Callable[..., Any], *args: Any, **options: Any) -> Any:
        """Return the result of an action; if it raises CaromError, take its faults and return None."""
        with collected(self):
            return action(*args, **options)
        return None

    def add_remedy(self, field: str, advice: str) -> None:
        """Set the remedy of a field's fault."""
        self[:] = [replace(fault, advice=advice) if fault.field == field else fault for fault in self]

    def has(self, field: str) -> bool:
        """Return whether a field has a fault."""
        return any(fault.field == field for fault in self)

    def raise_if_any(self) -> None:
        """Raise CaromError with all faults, each once, if there are any."""
        if self:
            raise CaromError(*dict.fromkeys(self))


def _cut(text: str, most: int) -> str:
    return text if len(text) <= most else f"{text[: most - 3]}..."


# --- numbers and arrays --------------------------------------------------------------------------------------------


def checked_number(
    faults: FaultList, field: str, value: Any, expected: str, holds: Callable[[Any], Any], *, infinite: bool = False
) -> Any:
    """Return a float, or an array of floats, for which ``holds`` is true; else add a fault and return 1.0."""
    if type(value) is float or type(value) is int:  # the common case, without arrays
        size = abs(value)
        in_range = MIN_MAGNITUDE <= size <= MAX_MAGNITUDE or (size < MIN_MAGNITUDE and holds(0.0))
        if holds(value) and (in_range or (infinite and value == np.inf)):
            return float(value)
        faults.add(field, with_size_limit(expected, value), f"{value!r}")
        return 1.0
    try:
        array = float_array(value)
    except (TypeError, ValueError):
        faults.add(field, expected, repr(value))
        return 1.0
    least = 0.0 if holds(0.0) else MIN_MAGNITUDE
    in_range = (np.abs(array) >= least) & (np.abs(array) <= MAX_MAGNITUDE)
    good = holds(array) & (in_range | (infinite & (array == np.inf)))
    bad = ~np.asarray(good)
    if bad.any():
        first = float(array[bad].flat[0])
        faults.add(field, with_size_limit(expected, first), f"{first!r}{first_bad_index(bad)}")
        return 1.0
    return float(array) if array.ndim == 0 else array


def require_count(where: str, field: str, value: Any, least: int = 1, most: int = MAX_COUNT, advice: str = "") -> int:
    """Return a whole number from ``least`` to ``most``; CaromError for anything else. For several: ``FaultList.attempt``."""
    if isinstance(value, Integral) and not isinstance(value, bool) and least <= int(value) <= most:
        return int(value)
    span = f">= {least}" if most == MAX_COUNT else f"from {least} to {most:,}"
    raise CaromError(Fault(where, field, f"a whole number {span}", shown(value, 60), advice))


def with_size_limit(expected: str, value: float) -> str:
    """Return the expectation, with the largest or least size allowed if ``value`` is finite and beyond it."""
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


def shown(value: Any, most: int = 80) -> str:
    """Return a value as it stands in a message: quoted if it is a text, and cut if it is long."""
    return _cut(repr(value), most)


def first_bad_index(bad: np.ndarray[Any, Any], go_on: str = "") -> str:
    """Return where a boolean array is first true, as ``" at index (3,) (2 in all)"``; empty for a scalar.

    ``go_on`` is how to go on where the other rows are good.
    """
    if bad.ndim == 0:
        return ""
    count, first = int(bad.sum()), tuple(int(i) for i in np.argwhere(bad)[0])
    return (
        f" at index {first} ({f'{count} of {bad.size}; {go_on}' if go_on and count < bad.size else f'{count} in all'})"
    )


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
        remedy = remedy or "check the order of the arguments, or name them"
        expected = f"{'an' if kind.__name__[0] in 'AEIOU' else 'a'} {kind.__name__}"
        raise CaromError(Fault(where, field, expected, f"{type(value).__name__} {shown(value, 60)}", remedy))


# --- names ---------------------------------------------------------------------------------------------------------


def near_name(name: object, known: Iterable[object]) -> str:
    """Return the known name that a mistyped one is meant to be, if one is near; else an empty text.

    Upper and lower case, hyphens, underscores and spaces are the same here. A beginning of only one known name is near, with its
    letters in any order, and so are a name that begins with only one, and one of the same letters.
    """
    plain = {_plain(one): str(one) for one in reversed(list(known))}
    said = _plain(name)
    alike = [
        one
        for one in plain
        if one.startswith(said)
        or (len(one) > 2 and said.startswith(one))
        or sorted(one) == sorted(said)
        or (len(said) > 3 and sorted(one[: len(said)]) == sorted(said))
    ]
    near = (
        (alike if len(alike) == 1 else [])
        or get_close_matches(said, plain, n=1, cutoff=NEAR)
        or get_close_matches(said, [one for one in plain if len(one) == len(said)], n=1, cutoff=NEAR_OF_ONE_LENGTH)
    )
    return plain[near[0]] if near and len(said) > 1 else ""


def _plain(name: object) -> str:
    """Return a name without what is often mistyped: "box" is "boks", too."""
    return str(name).lower().strip("-_. ").replace("-", "_").replace(" ", "_").replace("ks", "x")


def suggestion(name: object, known: Sequence[str]) -> str:
    """Return ``"did you mean 'X'?"`` for a name close to a known one, else the list of known names."""
    return did_you_mean(name, known) or (f"known are {', '.join(known)}" if known else "")


def did_you_mean(name: object, known: Iterable[object]) -> str:
    """Return ``"did you mean 'X'?"`` for a name close to a known one, else nothing: for messages that list the names."""
    near = near_name(name, known)
    return f"did you mean {near!r}?" if near else ""


def shortened_list(names: Sequence[str], most: int = 8) -> str:
    """Return names separated by commas, only the first of them if there are many: ``"a, b and 22 more"``."""
    rest = f" and {len(names) - most} more" if len(names) > most else ""
    return ", ".join(names[:most]) + rest
