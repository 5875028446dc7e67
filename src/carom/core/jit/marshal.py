"""Arguments of Python as a C function takes them, and its value back: for the entries of the package's loops."""

from __future__ import annotations

import ctypes
import json
import operator
import struct
from collections.abc import Callable, Iterator, Sequence
from typing import Any, NamedTuple

import numpy as np

__all__ = [
    "ArgumentWriter",
    "MismatchError",
    "ValueReader",
    "argument_writers",
    "dtype_of",
    "dtype_text",
    "kinds_text",
    "value_reader",
]

# Where NumPy keeps an array's address and shape: after what all objects of Python begin with (16 bytes, or 32 without a lock).
HEAD = object.__basicsize__
CODES = {"float64": "d", "int64": "q", "bool": "?"}
C_KINDS = {"float64": ctypes.c_double, "int64": ctypes.c_int64, "bool": ctypes.c_int64}


class MismatchError(Exception):
    """An argument is not of the kind that a loop was built for."""


class ArgumentWriter(NamedTuple):
    """How one argument is handed over."""

    kinds: list[Any]
    """Of C."""
    write: Callable[[Any, list[Any]], None]
    """Add the description of a value to a list; MismatchError where it is of another kind."""


def argument_writers(kinds: Sequence[Any], dtypes: Sequence[Any], fixed: bool) -> list[ArgumentWriter]:
    """Return a writer for each argument.

    A kind is a name of CODES, "none", a list of kinds (a tuple), ``{"array": dtype, "axes": n, "readonly": bool}`` or
    ``{"record": dtype}`` with indices of ``dtypes``. ``fixed``: the loop takes nothing else, and a whole number stands for a
    float.
    """
    return [_writer(kind, dtypes, fixed) for kind in kinds]


def _writer(kind: Any, dtypes: Sequence[Any], fixed: bool) -> ArgumentWriter:
    if isinstance(kind, list):
        return _tuple_writer([_writer(one, dtypes, fixed) for one in kind])
    if isinstance(kind, dict):
        if "record" in kind:
            return _record_writer(dtypes[kind["record"]])
        return _array_writer(dtypes[kind["array"]], kind["axes"], kind["readonly"])
    if kind == "none":
        return ArgumentWriter([], _write_none)
    numbers: dict[str, tuple[Any, Any]] = {
        "float64": ((float, int, np.floating, np.integer) if fixed else float, float),
        "int64": ((int, np.integer), operator.index),
        "bool": ((bool, np.bool_, int) if fixed else (bool, np.bool_), bool),
    }
    taken, convert = numbers[kind]
    whole = kind == "int64"

    def write(value: Any, given: list[Any]) -> None:
        if not isinstance(value, taken) or (whole and isinstance(value, bool)):
            raise MismatchError
        given.append(convert(value))

    return ArgumentWriter([C_KINDS[kind]], write)


def _write_none(value: Any, given: list[Any]) -> None:
    if value is not None:
        raise MismatchError


def _tuple_writer(items: list[ArgumentWriter]) -> ArgumentWriter:
    def write(value: Any, given: list[Any]) -> None:
        if not isinstance(value, tuple) or len(value) != len(items):
            raise MismatchError
        for item, one in zip(items, value, strict=True):
            item.write(one, given)

    return ArgumentWriter([kind for item in items for kind in item.kinds], write)


def _array_writer(dtype: Any, axes: int, readonly: bool) -> ArgumentWriter:
    seen = dtype  # the same type is mostly the same object; comparing two takes a microsecond

    def write(value: Any, given: list[Any]) -> None:
        nonlocal seen
        if not isinstance(value, np.ndarray) or value.ndim != axes:
            raise MismatchError
        if value.dtype is not seen:
            if value.dtype != dtype:
                raise MismatchError
            seen = value.dtype
        flags = value.flags
        if not (flags.c_contiguous and flags.aligned if readonly else flags.carray):
            raise MismatchError
        given.append(id(value) + HEAD)

    return ArgumentWriter([ctypes.c_void_p], write)


def _record_writer(dtype: Any) -> ArgumentWriter:
    def write(value: Any, given: list[Any]) -> None:
        if not isinstance(value, np.void) or value.dtype != dtype:
            raise MismatchError
        given.append(value.__array_interface__["data"][0])

    return ArgumentWriter([ctypes.c_void_p], write)


class ValueReader:
    """Result of a loop, in a buffer of ``size`` bytes."""

    def __init__(self, kind: Any) -> None:
        self._kind = kind
        self._struct = struct.Struct("@" + "".join(_codes(kind)))
        self._flat = isinstance(kind, list) and not any(isinstance(one, list) for one in kind)
        self.size = self._struct.size + 8  # (a tuple in a tuple may end later)

    def read(self, buffer: Any) -> Any:
        """Return the value."""
        if self._flat:
            return self._struct.unpack_from(buffer)
        return _value(self._kind, iter(self._struct.unpack_from(buffer)))


def value_reader(kind: Any) -> ValueReader | None:
    """Return the reader of a value of a kind (:func:`argument_writers`), None for no value."""
    return None if kind == "none" else ValueReader(kind)


def _codes(kind: Any) -> list[str]:
    return [code for one in kind for code in _codes(one)] if isinstance(kind, list) else [CODES[kind]]


def _value(kind: Any, numbers: Iterator[Any]) -> Any:
    return tuple(_value(one, numbers) for one in kind) if isinstance(kind, list) else next(numbers)


def kinds_text(takes: Sequence[Any], returns: Any) -> str:
    """Return the text of what a loop takes and returns: kinds with dtypes in place of their indices."""

    def whole(kind: Any) -> Any:
        if isinstance(kind, list):
            return [whole(one) for one in kind]
        if isinstance(kind, dict):
            return {key: dtype_text(x) if key in ("array", "record") else x for key, x in kind.items()}
        return kind

    return json.dumps([whole(list(takes)), whole(returns)])


def dtype_text(dtype: Any) -> Any:
    """Return a dtype as JSON has it: of records with the places of their fields."""
    if dtype.names is None:
        return dtype.str
    fields = [dtype.fields[name] for name in dtype.names]
    return {
        "names": list(dtype.names),
        "formats": [
            kind.str if kind.subdtype is None else [kind.subdtype[0].str, list(kind.shape)] for kind, *_ in fields
        ],
        "offsets": [offset for _kind, offset, *_ in fields],
        "itemsize": dtype.itemsize,
    }


def dtype_of(text: Any) -> Any:
    """Return the dtype of a :func:`dtype_text`."""
    if isinstance(text, str):
        return np.dtype(text)
    layout: Any = {
        **text,
        "formats": [one if isinstance(one, str) else (one[0], tuple(one[1])) for one in text["formats"]],
    }
    return np.dtype(layout)
