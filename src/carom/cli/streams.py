"""Standard output and standard error of the command: full, closed or read no further, they lose nothing and end in one line."""

from __future__ import annotations

import _thread
import contextlib
import errno
import io
import json
import os
import signal
import sys
import threading
import warnings
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager, suppress
from typing import Any

import typer

from carom.cli.verbs import in_options, with_options
from carom.files import cannot_write
from carom.formatting import escape_controls, json_value
from carom.public.interrupts import LINE


def say(line: str) -> None:
    """Print a line on standard output, with control characters escaped."""
    sys.stdout.write(escape_controls(line) + "\n")


def note(line: str) -> None:
    """Print a line on standard error, with control characters escaped and parameters named as options."""
    sys.stderr.write(escape_controls(in_options(line)) + "\n")


def json_text(value: Any, indent: int | None = 2, **layout: Any) -> str:
    """Return a value as JSON, with null for undefined and infinite numbers, and the command's options in its texts."""
    return json.dumps(with_options(json_value(value)), indent=indent, allow_nan=False, **layout) + "\n"


def say_json(value: Any, indent: int | None = 2, **layout: Any) -> None:
    """Print a value as JSON on standard output."""
    sys.stdout.write(json_text(value, indent, **layout))


def say_notes(lines: Iterable[str]) -> None:
    """Print each line as a note."""
    for line in lines:
        note(f"note: {line}")


@contextmanager
def guarded_streams() -> Iterator[None]:
    """While inside, what cannot be written to standard output is a CaromError, and what standard error cannot take is dropped.

    Warnings of libraries, which may quote names, have their control characters escaped.

    A reader that closes the pipe early, such as `head`, is not an error: the rest of the output is dropped, and files are written.
    """
    before = sys.stdout, sys.stderr
    said = warnings.formatwarning
    _fill_closed_descriptors()
    warnings.formatwarning = lambda *about, **more: escape_controls(said(*about, **more))
    sys.stdout, sys.stderr = _Stream(before[0], _unless_closed_early), _Stream(before[1], lambda _error: None)
    try:
        yield
    finally:
        sys.stdout, sys.stderr = before
        warnings.formatwarning = said


def _fill_closed_descriptors() -> None:
    """Open the null device for closed standard streams, so that no file of the run becomes standard output."""
    if None in (sys.stdin, sys.stdout, sys.stderr):
        while (descriptor := os.open(os.devnull, os.O_RDWR)) <= 2:
            pass
        os.close(descriptor)


class _Stream:
    """A text stream whose errors go to ``failed``; everything else is the stream's own."""

    def __init__(self, stream: Any, failed: Callable[[OSError], None]) -> None:
        self._failed = failed
        self._stream = _nowhere() if stream is None else stream
        self._closed = stream is None
        self.buffer = _Bytes(self)

    def __getattr__(self, name: str) -> Any:
        return getattr(self._stream, name)

    def write(self, text: str) -> int:
        """Write a text."""
        self.attempt(lambda stream: stream.write(text))
        return len(text)

    def flush(self) -> None:
        """Write what is held back."""
        self.attempt(lambda stream: stream.flush(), empty=True)

    def attempt(self, action: Callable[[Any], Any], *, empty: bool = False) -> None:
        """Do something with the stream; an error sends what is held back, and all that is still to come, nowhere."""
        try:
            if self._closed and not empty:
                raise OSError(errno.EBADF, "a closed one")
            action(self._stream)
        except OSError as error:
            with suppress(OSError, ValueError):
                null = os.open(os.devnull, os.O_WRONLY)
                os.dup2(null, self._stream.fileno())
                os.close(null)
            self._stream, self._closed = _nowhere(), False
            self._failed(error)


class _Bytes:
    """The bytes of a stream."""

    def __init__(self, stream: _Stream) -> None:
        self._stream = stream

    def write(self, data: bytes) -> int:
        """Write bytes."""
        self._stream.attempt(lambda stream: stream.buffer.write(data))
        return len(data)

    def flush(self) -> None:
        """Write what is held back."""
        self._stream.flush()


def _nowhere() -> io.TextIOWrapper:
    return io.TextIOWrapper(io.BytesIO(), encoding="utf-8")


def _unless_closed_early(error: OSError) -> None:
    """Raise CaromError for an error of standard output, unless its reader has closed the pipe."""
    if error.errno != errno.EPIPE:
        raise cannot_write("standard output", error) from None


# ----------------------------------------------------------------------------------------------------
# Ctrl-C while the command runs, wherever Python is when it comes.


SWALLOWED = 0.01  # s, after which an interrupt that was swallowed is raised again
# What was said of an interrupt: once is enough, by the command that knows what it leaves, or at the end.
_said: list[str] = []


def say_interrupted(line: str = LINE) -> None:
    """Say on standard error that the command was interrupted, unless that was said."""

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
