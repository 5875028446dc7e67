"""Wrong arguments of public functions and methods: a CaromError that names function, argument, expectation and what came.

What is right is not looked at, so that a call costs nothing more than one of Python's. Only where a call raises something other
than a CaromError are its arguments compared with the annotations of its signature. An exception of the caller's own (of a callback,
a law) goes on as it is, and so does a warning that was made an error.
"""

from __future__ import annotations

import collections.abc
import functools
import inspect
import os
import sys
import traceback
import types
import typing
import warnings
from collections.abc import Callable
from numbers import Integral, Real
from types import FrameType
from typing import Any

import lazy_loader
import numpy as np
from numpy.typing import ArrayLike

from carom.core.jit.kernel import KERNELS
from carom.errors import CaromError, did_you_mean, float_array, near_name
from carom.public.own_laws import with_own_laws

PACKAGE = __name__.partition(".")[0]
BORDER = f"{PACKAGE}.public.guard"  # whose wrappers stand between a caller and each public function
LIBRARIES = frozenset({
    "av", "carom", "dask", "distributed", "gsd", "h5netcdf", "h5py", "imageio_ffmpeg", "lazy_loader", "llvmlite", "matplotlib",
    "mpl_toolkits", "numba", "numpy", "pandas", "pint", "pyarrow", "pydantic", "pydantic_core", "rich", "scipy", "sympy",
    "typer", "xarray", "zarr",
})  # fmt: skip


def is_the_users(frame: FrameType) -> bool:
    """Return whether a frame is neither carom's nor a library's: a program of the user's, or a function that it handed over."""
    room = _name(frame).partition(".")[0]
    return room not in LIBRARIES and (room == "__main__" or room not in sys.stdlib_module_names)


def called_from_outside() -> bool:
    """Return whether the function that asks was called by code outside carom: directly, through a public name, or by a library."""
    for frame, _line in traceback.walk_stack(sys._getframe(2)):
        if is_the_users(frame):
            return True
        if _name(frame).partition(".")[0] == PACKAGE and _name(frame) != BORDER:
            return False
    return True


def _name(frame: FrameType) -> str:
    return str(frame.f_globals.get("__name__", ""))


# ----------------------------------------------------------------------------------------------------
# Wrong arguments of public functions and methods: a CaromError that names function, argument, expectation and what came.


LAWS = frozenset(
    {"law", "laws", "changes", "parameters", "values"}
)  # parameters of functions in which a law may be named
CALLBACK = "run = carom.simulate(scene); for event in run.events: ... has each event, its time, ball and state"
SEQUENCES = (collections.abc.Sequence, collections.abc.Iterable)
_done: dict[Any, Any] = {}


def guarded(public: Any) -> Any:
    """Return a public function that explains its misuse; of a class make the methods such, and return the class."""
    if inspect.isclass(public):
        for cls in reversed(public.__mro__):
            if cls.__module__.startswith("carom.") and cls not in _done:
                _done[cls] = cls
                _guard_methods(cls)
        return public
    if not inspect.isfunction(public):
        return public
    if public not in _done:
        name = public.__name__
        wrapper = _done[public] = _guard(public, name)
        _done[wrapper] = wrapper
        room = vars(sys.modules[public.__module__])
        if room.get(name) is public:  # (pickle looks for it there)
            room[name] = wrapper
    return _done[public]


def _guard_methods(cls: type) -> None:
    for name, member in list(vars(cls).items()):
        if name.startswith("_") and name not in ("__init__", "__call__"):
            continue
        where = cls.__name__ if name == "__init__" else f"{cls.__name__}.{name}"
        if name == "__init__" and hasattr(cls, "_unlikely"):
            member = _noting(member)  # noqa: PLW2901
        if isinstance(member, classmethod | staticmethod):
            setattr(cls, name, type(member)(_guard(member.__func__, where)))
        elif (
            inspect.isfunction(member) and member not in KERNELS
        ):  # (what a class names as its kernel is compiled as it is)
            setattr(cls, name, _guard(member, where))


def _noting(made: Callable[..., None]) -> Callable[..., None]:
    """Return an ``__init__`` that warns a caller outside carom of numbers hardly in SI units, by the class's ``_unlikely``."""

    @functools.wraps(made)
    def noting(self: Any, *args: Any, **options: Any) -> None:
        made(self, *args, **options)
        if (said := self._unlikely()) and called_from_outside():
            warnings.warn(f"{type(self).__name__}: {said}", stacklevel=3)

    return noting


def _guard(function: Callable[..., Any], where: str) -> Callable[..., Any]:
    if inspect.isgeneratorfunction(function):
        return function

    places = [
        i for i, name in enumerate(function.__code__.co_varnames[: function.__code__.co_argcount]) if name in LAWS
    ]
    first = min(places, default=sys.maxsize)

    @functools.wraps(function)
    def call(*args: Any, **options: Any) -> Any:
        if (len(args) > first or (options and not LAWS.isdisjoint(options))) and called_from_outside():
            args = tuple(with_own_laws(one) if i in places else one for i, one in enumerate(args))
            options = {name: with_own_laws(one) if name in LAWS else one for name, one in options.items()}
        try:
            return function(*args, **options)
        except CaromError:
            raise
        except Exception as error:
            explained = _explained(function, where, args, options, error)
            if explained is None:
                raise
            raise explained from error

    return call


# --- what was wrong ------------------------------------------------------------------------------------------------


def _explained(
    function: Callable[..., Any], where: str, args: Any, options: Any, error: Exception
) -> CaromError | None:
    """Return the error of a call as a CaromError; None for what is not about its arguments."""
    if isinstance(error, Warning | MemoryError | ImportError) or _is_the_callers(error):
        return None
    signature = inspect.signature(function)
    try:
        given = signature.bind(*args, **options).arguments
    except TypeError:  # too few arguments, too many, or another name: Python says it well, but not which there are
        known = [name for name in signature.parameters if name not in ("self", "cls")]
        strange = [name for name in options if name not in known]
        hints = [CALLBACK] if any(name.startswith("on_") for name in strange) and where == "simulate" else []
        hints += filter(None, (did_you_mean(name, known) for name in strange))
        said = str(error).partition(". Did you mean")[0]  # (from 3.14 on Python has a hint of its own)
        error.args = ("; ".join((said, *hints[:1])),)
        error.add_note(f"{where} takes {', '.join(known) or 'no arguments'}")
        return None
    first = next(iter(signature.parameters), "")
    if first in ("self", "cls"):
        if "self" in given and "." not in where:
            where = type(given["self"]).__name__
        given = {name: value for name, value in given.items() if name != first}
    faults = []
    for name, value in given.items():
        parameter = signature.parameters[name]
        values = {name: value}
        if parameter.kind is inspect.Parameter.VAR_KEYWORD:
            values = dict(value)
        elif parameter.kind is inspect.Parameter.VAR_POSITIONAL:
            values = {f"{name}[{i}]": one for i, one in enumerate(value)}
        annotation = _annotation(function, parameter)
        for label, one in values.items():
            if (one is not parameter.default) and not _fits(one, annotation):
                faults.append(f"{where}: {label}: expected {_phrase(annotation)}, got {_shown(one)}")
    if faults:
        return CaromError(*faults)
    said = " ".join(str(error).split())[:200] or type(error).__name__
    got = ", ".join(f"{name} = {_shown(value)}" for name, value in given.items()) or "none"
    return CaromError(
        f"{where}: expected arguments that fit its documentation, got {got} ({type(error).__name__}: {said});"
        " check their order, types and shapes"
    )


def _is_the_callers(error: Exception) -> bool:
    """Return whether an exception comes from code that is neither carom's nor a library's: a callback, a law of the user's own."""
    return any(is_the_users(frame) for frame, _line in traceback.walk_tb(error.__traceback__))


def _shown(value: Any) -> str:
    """Return a value for a message: its type, and its beginning."""
    if isinstance(value, np.ndarray):
        return f"an array of shape {value.shape}, {value.dtype}"
    try:
        text = " ".join(repr(value).split())
    except Exception:  # a value whose own repr fails
        text = ""
    return f"{type(value).__name__} {text:.60}".strip()


# --- annotations ---------------------------------------------------------------------------------------------------


def _annotation(function: Any, parameter: inspect.Parameter) -> Any:
    """Return the type that a parameter is annotated with; Any if it has none, or one that is only there for type checkers."""
    text = parameter.annotation
    if text is inspect.Parameter.empty:
        return Any
    if not isinstance(text, str):
        return text
    try:
        return eval(text, vars(sys.modules[function.__module__]))
    except Exception:  # imported under TYPE_CHECKING
        return Any


def _fits(value: Any, annotation: Any) -> bool:  # noqa: PLR0911
    """Return whether a value may be what an annotation says; of what it does not know it says yes."""
    origin, inside = typing.get_origin(annotation), typing.get_args(annotation)
    if isinstance(value, np.ndarray) and value.ndim == 0 and origin in (tuple, list, *SEQUENCES):
        return False  # (it says that it can be iterated over)
    if annotation is Any or isinstance(annotation, typing.TypeVar):
        return True
    if annotation is None or annotation is type(None):
        return value is None
    if _is_array_like(annotation):
        return _is_numbers(value)
    if origin is typing.Annotated:
        return _fits(value, inside[0])
    if origin is typing.Literal:
        return any(value is one or (isinstance(value, str) and value == one) for one in inside)
    if origin in (typing.Union, types.UnionType):
        return any(_fits(value, one) for one in inside)
    if annotation is float:
        return isinstance(value, Real) and not isinstance(value, bool)
    if annotation is int:
        return isinstance(value, Integral) and not isinstance(value, bool)
    if annotation is bool:
        return isinstance(value, bool | np.bool_)
    if origin is collections.abc.Callable:
        return callable(value)
    if origin is tuple and isinstance(value, tuple | list | np.ndarray):
        kinds = [inside[0]] * len(value) if inside[-1:] == (Ellipsis,) else list(inside)
        return len(kinds) == len(value) and all(map(_fits, value, kinds))
    if origin in (list, *SEQUENCES):
        several = isinstance(value, (origin, np.ndarray, tuple, list))
        return several and not isinstance(value, str) and all(_fits(one, inside[0]) for one in value)
    kind = origin if inspect.isclass(origin) else annotation
    return isinstance(value, kind) if inspect.isclass(kind) else True


def _is_array_like(annotation: Any) -> bool:
    return annotation == ArrayLike or annotation is np.ndarray or typing.get_origin(annotation) is np.ndarray


def _is_numbers(value: Any) -> bool:
    try:
        float_array(value)
    except (TypeError, ValueError):
        return False
    return True


_PHRASES = {float: "a number", int: "a whole number", bool: "True or False", str: "text", os.PathLike: "a path"}


def _phrase(annotation: Any) -> str:  # noqa: PLR0911
    """Return the expectation of an annotation, in words."""
    origin, inside = typing.get_origin(annotation), typing.get_args(annotation)
    if annotation is None or annotation is type(None):
        return "None"
    if _is_array_like(annotation):
        return "numbers, or an array of them"
    if origin is typing.Annotated:
        return _phrase(inside[0])
    if origin is typing.Literal:
        return "one of " + ", ".join(map(repr, inside))
    if origin in (typing.Union, types.UnionType):
        return " or ".join(dict.fromkeys(_phrase(one) for one in inside))
    if origin is collections.abc.Callable:
        return "a function"
    if origin in (tuple, list, *SEQUENCES):
        return f"a sequence, each {' or '.join(dict.fromkeys(_phrase(one) for one in inside if one is not Ellipsis))}"
    kind = origin if inspect.isclass(origin) else annotation
    name = str(getattr(kind, "__name__", kind))
    return _PHRASES.get(kind, f"{'an' if name[0] in 'AEIOU' else 'a'} {name}")


# ----------------------------------------------------------------------------------------------------
# Public names of a package, from its stub: each is imported, and guarded, when it is first used.


def attach_public(package: str, file: str) -> tuple[Callable[[str], Any], Callable[[], list[str]], list[str]]:
    """Return ``__getattr__``, ``__dir__`` and ``__all__`` of a package whose names stand in the stub beside ``file``.

    Functions and classes are guarded (:func:`carom.public.guard.guarded`). That is here, and not at each function, so that carom's
    own rooms, which import from modules, call the bare functions.
    """
    load, list_names, names = lazy_loader.attach_stub(package, file)

    def load_guarded(name: str) -> Any:
        try:
            found = load(name)
        except AttributeError as error:
            if package == "carom" and (law := next((one for one in load("LAWS") if one.replace("-", "_") == name), "")):
                called = f"carom.LAWS[{law!r}](ball, state, wall)"
                raise AttributeError(f"carom has no function {name}; the law itself is called: {called}") from error
            if package == "carom.billiards" and name in sys.modules["carom"].scene.FIGURES:
                called = f"carom.billiards.table({name!r}, ...)"
                raise AttributeError(f"{package} has no function {name}; the table is {called}") from error
            if not name.startswith("_") and (
                near := near_name(name, [one for one in names if one.islower() or not name.islower()])
            ):
                raise AttributeError(f"{package} has no {name}; did you mean {near}?") from error
            raise
        if getattr(found, "__module__", "").startswith("carom."):  # (not a module, nor a table of numbers)
            found = guarded(found)
            vars(sys.modules[package])[name] = found
        return found

    return load_guarded, list_names, names
