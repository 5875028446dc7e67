"""Progress of compiling: which function is being compiled at this moment."""

from __future__ import annotations

import functools
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

Report = Callable[[str, bool], None]
_reports: list[Report] = []


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
    """Report to all watchers."""
    for report in tuple(_reports):
        report(name, finished)


@functools.cache
def listen() -> None:
    """Have Numba announce what it compiles. (Its import is slow: call this only where something is compiled or loaded.)"""
    from numba.core import event

    def name_of(event: Any) -> str:
        function = event.data["dispatcher"].py_func
        return f"{function.__module__}:{function.__name__}"

    class Compiling(event.Listener):  # type: ignore[misc]
        def on_start(self, event: Any) -> None:
            announce(name_of(event), False)

        def on_end(self, event: Any) -> None:
            announce(name_of(event), True)

    event.register("numba:compile", Compiling())
