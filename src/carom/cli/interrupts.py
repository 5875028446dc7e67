"""Ctrl-C while the command runs, wherever Python is when it comes."""

from __future__ import annotations

import _thread
import contextlib
import signal
import sys
import threading
from collections.abc import Callable, Iterator
from typing import Any

import typer

from carom.public.interrupts import LINE

__all__ = ["noticed_interrupts", "say_interrupted", "stop_requests"]

SWALLOWED = 0.01  # s, after which an interrupt that was swallowed is raised again
# What was said of an interrupt: once is enough, by the command that knows what it leaves, or at the end.
_said: list[str] = []


def say_interrupted(line: str = LINE) -> None:
    """Say on standard error that the command was interrupted, unless that was said."""
    from carom.cli.streams import note

    if not _said:
        _said.append(line)
        note(line.rstrip())


@contextlib.contextmanager
def noticed_interrupts(always: bool = False) -> Iterator[list[bool]]:
    """While inside, have Ctrl-C raise KeyboardInterrupt, and record it in a list: it may never arrive.

    Python swallows what is raised while objects are finalised (those of LLVM, locks of imports), C code that imports prints it and
    raises an error of its own. A process that is to ignore the signal, in the background of a script, does so, but ``always``.
    """
    asked: list[bool] = []
    inside: list[bool] = []
    _said.clear()

    def note(_signal: int, _frame: Any) -> None:
        asked.append(True)
        raise KeyboardInterrupt

    def again(fault: Any) -> None:
        if not issubclass(fault.exc_type, KeyboardInterrupt):
            unraisable(fault)
        elif inside:  # (a moment later: here it would be swallowed again)
            later = threading.Timer(SWALLOWED, lambda: _thread.interrupt_main() if inside else None)
            later.daemon = True
            later.start()

    def show(kind: type[BaseException], *rest: Any) -> None:
        if not issubclass(kind, KeyboardInterrupt):
            excepthook(kind, *rest)

    if not always and signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
        yield asked
        return
    unraisable, excepthook = sys.unraisablehook, sys.excepthook
    with _received_by(note, signal.SIGINT) as received:
        if received:
            sys.unraisablehook, sys.excepthook = again, show
            inside.append(True)
        try:
            yield asked
        finally:
            inside.clear()
            sys.unraisablehook, sys.excepthook = unraisable, excepthook


@contextlib.contextmanager
def stop_requests() -> Iterator[list[int]]:
    """While inside, collect the signals that ask a run to end (Ctrl-C, SIGTERM) in a list; the second ends the command at once."""
    asked: list[int] = []

    def note(which: int, _frame: Any) -> None:
        if asked:
            say_interrupted("carom: interrupted; nothing was saved")
            raise typer.Exit(128 + which)
        asked.append(which)

    with _received_by(note, signal.SIGINT, signal.SIGTERM):
        yield asked


@contextlib.contextmanager
def _received_by(receive: Callable[[int, Any], None], *signals: signal.Signals) -> Iterator[bool]:
    """While inside, have a function receive signals; yield whether it does, which is so in the main thread alone."""
    try:
        before = {which: signal.signal(which, receive) for which in signals}
    except ValueError:
        yield False
        return
    try:
        yield True
    finally:
        for which, handler in before.items():
            signal.signal(which, handler)
