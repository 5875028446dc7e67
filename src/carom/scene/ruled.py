"""Rules about the numbers of a part of a scene: kernels that report codes, and the texts of the faults as data.

Python runs the kernels, and so does the explorer's module; both fill the same texts, so that they say the same.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Mapping, Sequence
from types import UnionType
from typing import Annotated, Any, ClassVar, NamedTuple, Union, get_args, get_origin

import numpy as np
from pydantic import model_validator

from carom.core.jit.kernel import kernel
from carom.errors import Fault, shown
from carom.formatting import format_length
from carom.scene.schema import Components, Model, raise_faults

MOST_FAULTS, FAULT_COLUMNS = 64, 4
Report = Callable[[Any, Any], int]


class FaultText(NamedTuple):
    """The text of a fault that a kernel reports.

    Names in braces are fields of the part that is checked, and a, b, c the fault's numbers: ``{low}`` as in files, ``{low:g}`` as
    a number, ``{low:m}`` as a length, ``{point:v}`` as a vector, ``{name:s}`` as a text, ``{a:pocket}`` as the name of the pocket
    at a place.
    """

    field: str
    expected: str
    got: str
    advice: str = ""


def format_vector(v: Sequence[float]) -> str:
    """Format a point or a direction; rounding errors are shown as zero."""
    return f"({', '.join(f'{x if abs(x) > 1e-12 else 0:.6g}' for x in v)})"


class _Shown:
    """A value of a fault's text, by the specifications of :class:`FaultText`."""

    def __init__(self, value: Any, places: Sequence[str]) -> None:
        self._value, self._places = value, places

    def __getattr__(self, name: str) -> _Shown:
        return _Shown(getattr(self._value, name), self._places)

    def __format__(self, how: str) -> str:
        value: Any = list(self._value) if isinstance(self._value, tuple) else self._value
        if how == "pocket":
            return self._places[int(value)]
        own: dict[str, Callable[[Any], str]] = {"": shown, "m": format_length, "v": format_vector, "s": str}
        return own[how](value) if how in own else format(value, how)


def filled(text: FaultText, values: Mapping[str, Any], places: Sequence[str] = ()) -> Fault:
    """Return the fault of a text with the values in their places."""
    asked = {name: _Shown(value, places) for name, value in values.items()}
    return Fault("", *(one.format_map(asked) for one in text))


@kernel
def no_faults(p: Sequence[float], out: Any) -> int:
    """Report no fault."""
    return 0


@kernel
def put_fault(code: int, a: float, b: float, c: float, i: int, out: Any) -> int:
    """Write fault number i, its code and three numbers that its text may show; return the number of the next one."""
    if i < out.shape[0]:
        out[i, 0], out[i, 1], out[i, 2], out[i, 3] = code, a, b, c
    return i + 1


# --- numbers of a part --------------------------------------------------------------------------------------------


@functools.cache
def number_fields(model: type[Ruled]) -> dict[str, int | tuple[str, ...]]:
    """Return how many numbers each field that a part's rules read takes in its ``numbers``; 0: a list, which its length precedes.

    Of a part, such as the pockets of a table, the names of its fields, a number each. Texts and choices are no numbers.
    """
    own = {name: model.model_fields[name] for name in model.ruled_fields()}
    counts = {name: _count(info.annotation, list(info.metadata)) for name, info in own.items()}
    return {name: count for name, count in counts.items() if count is not None}


def _count(annotation: Any, metadata: list[Any]) -> int | tuple[str, ...] | None:
    """Return how many numbers a field takes, by its type, or their names; None for a text."""
    while get_origin(annotation) is Annotated:
        annotation, *more = get_args(annotation)
        metadata = [*metadata, *more]
    if get_origin(annotation) in (Union, UnionType):
        return _count(next(one for one in get_args(annotation) if one is not type(None)), metadata)
    for one in metadata:
        if isinstance(one := getattr(one, "func", None), Components):
            return one.counts[0] if len(one.counts) == 1 else 0
    if isinstance(annotation, type) and issubclass(annotation, Model):
        return tuple(annotation.model_fields)
    return 1 if annotation in (float, int, bool) else None


def _flattened(value: Any, count: int | tuple[str, ...]) -> list[float]:
    if value is None:
        return [math.nan] * (len(count) if isinstance(count, tuple) else count)
    if isinstance(value, Model):
        return [x for _name, x in value]
    if not isinstance(value, tuple):
        return [float(value)]
    items = [x for one in value for x in (one if isinstance(one, tuple) else (one,))]
    return items if count else [float(len(value)), *items]


# A scene is made again with another friction or ball, and its walls stay as they are: answers about some walls are kept, unless
# their outlines are long.
KEPT, LONG = 1024, 200


@functools.lru_cache(KEPT)
def fault_rows(report: Report, numbers: tuple[float, ...]) -> list[list[float]]:
    """Return the rows of faults, code and numbers, that a kernel reports about numbers."""
    rows = np.empty((MOST_FAULTS, FAULT_COLUMNS))
    found: list[list[float]] = rows[: report(numbers, rows)].tolist()
    return found


def about(asked: Any, function: Any, numbers: tuple[float, ...]) -> Any:
    """Return the value of a cached function for a kernel and numbers; for many numbers it is computed anew."""
    return asked(function, numbers) if len(numbers) < LONG else asked.__wrapped__(function, numbers)


class Ruled(Model):
    """A part of a scene whose numbers are checked against each other by a kernel."""

    rules: ClassVar[Report] = no_faults
    """(p, rows): write codes of faults with three numbers each; return their number. p are the part's ``numbers``."""
    fault_texts: ClassVar[tuple[FaultText, ...]] = ()
    """Texts of the faults that the rules report, by their codes."""
    ruled: ClassVar[tuple[str, ...]] = ()
    """Names of the fields that the rules read."""
    pocket_places: ClassVar[tuple[str, ...]] = ()

    @classmethod
    def ruled_fields(cls) -> tuple[str, ...]:
        """Return the names of the fields that the rules read."""
        return cls.ruled

    @classmethod
    def fault_rules(cls) -> Report:
        """Return the kernel of its rules."""
        return cls.rules

    @property
    def numbers(self) -> tuple[float, ...]:
        """Return the fields that its rules read as numbers, in their order: what its kernels take.

        A flag is 0 or 1; of what is not given, NaN; a list of any length is preceded by its length.
        """
        fields = number_fields(type(self)).items()
        return tuple(x for name, count in fields for x in _flattened(getattr(self, name), count))

    @model_validator(mode="after")
    def _keeps_its_rules(self) -> Ruled:
        rows = about(fault_rows, self.fault_rules(), self.numbers)
        if rows:
            own = {name: getattr(self, name) for name in type(self).model_fields}
            raise_faults(
                filled(
                    self.fault_texts[int(code)], {**own, **dict(zip("abc", numbers, strict=True))}, self.pocket_places
                )
                for code, *numbers in rows
            )
        return self
