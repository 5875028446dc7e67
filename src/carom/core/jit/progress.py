"""Progress of compiling: which function is being compiled, and how many of the functions that a loop calls are done."""

from __future__ import annotations

import functools
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import CodeType, FunctionType
from typing import Any, NamedTuple

Report = Callable[[str, bool], None]
_reports: list[Report] = []

# What the modules of each package compute, in plain words.
PARTS = {
    "carom.core.jit": "vectors",
    "carom.core.contact": "contacts",
    "carom.core.geometry": "shapes",
    "carom.core.motion": "motion",
    "carom.core.roots": "roots of polynomials",
    "carom.laws.wall_and_floor": "wall and floor at once",
    "carom.laws": "impact laws",
    "carom.simulation": "event loop",
    "carom.billiards": "orbits",
    "carom.gas": "event loop of gases",
    "carom.fitting": "fits",
    "carom.tracks": "tracks",
    "carom.sweeps": "sweeps",
}
# The loop itself, which LLVM optimises with all that it calls, takes as long as so large a share of its functions.
OPTIMISING = 0.25


class CompileProgress(NamedTuple):
    """How far a compilation is."""

    part: str
    """Description of the code that is being compiled."""
    done: int
    """Functions that are compiled."""
    expected: int
    """Functions that are expected."""
    share: float
    """Share of the work that is done, 0 to 1."""


def name_of(function: Any) -> str:
    """Return ``module:name`` of a function."""
    return f"{getattr(function, '__module__', '?')}:{getattr(function, '__name__', '?')}"


@contextmanager
def watch_compiling(report: Report) -> Iterator[None]:
    """While inside, call ``report(name, finished)`` when a function begins to be compiled (not loaded), and when it is done.

    ``name`` is ``module:name``. Functions that a function calls are compiled while it is.
    """
    _reports.append(report)
    try:
        yield
    finally:
        _reports.remove(report)


def announce(name: str, finished: bool) -> None:
    """Report to all watchers; also what another process compiles (:mod:`carom.core.jit.workers`)."""
    for report in tuple(_reports):
        report(name, finished)


@functools.cache
def listen() -> None:
    """Have Numba announce what it compiles. (Its import is slow: call this only where something is compiled or loaded.)"""
    from numba.core import event

    class Compiling(event.Listener):  # type: ignore[misc]
        def on_start(self, event: Any) -> None:
            announce(name_of(event.data["dispatcher"].py_func), False)

        def on_end(self, event: Any) -> None:
            announce(name_of(event.data["dispatcher"].py_func), True)

    event.register("numba:compile", Compiling())


def called_kernels(*loops: Callable[..., Any]) -> frozenset[str]:
    """Return the names (:func:`name_of`) of loops and of all functions of carom that they call, directly or not."""
    found: set[FunctionType] = {loop for loop in loops if isinstance(loop, FunctionType)}
    todo = list(found)
    while todo:
        function = todo.pop()
        for name in _names(function.__code__):
            called = function.__globals__.get(name)
            if isinstance(called, FunctionType) and called.__module__.startswith("carom.") and called not in found:
                found.add(called)
                todo.append(called)
    return frozenset(name_of(function) for function in found)


def _names(code: CodeType) -> set[str]:
    inner = (constant for constant in code.co_consts if isinstance(constant, CodeType))
    return set(code.co_names).union(*(_names(one) for one in inner))


@contextmanager
def compile_progress(report: Callable[[CompileProgress], None], *loops: Callable[..., Any]) -> Iterator[None]:
    """While inside, report how far the compilation of ``loops`` is, whenever a function begins to be compiled or is done."""
    expected, done, roots = called_kernels(*loops), set[str](), {name_of(loop) for loop in loops}
    part = ""

    def step(name: str, finished: bool) -> None:
        nonlocal part
        if name not in expected:  # Numba's own, or a law of the user's
            return
        if finished:
            done.add(name)
        ready = not expected - done - roots  # what is left is to be optimised
        part = "machine code" if ready else next(word for of, word in PARTS.items() if name.startswith(of))
        share = (1 - OPTIMISING) * len(done - roots) / max(len(expected - roots), 1)
        share += OPTIMISING * len(done & roots) / len(roots)
        report(CompileProgress(part, len(done), len(expected), share))

    with watch_compiling(step):
        yield
