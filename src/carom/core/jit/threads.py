"""Threads for compiled loops that leave Python's lock (``nogil``): how many, and pools for all of them."""

from __future__ import annotations

import functools
import importlib
import multiprocessing
import os
import sys
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor, as_completed, wait
from contextlib import contextmanager
from typing import Any, TypeVar

import numpy as np


def core_count() -> int:
    """Return how many cores this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def run_in_workers(
    jobs: Sequence[str], workers: int | None = None, report: Callable[[str, str], None] | None = None
) -> None:
    """Call every job, ``module:function``, in one of so many processes (default: one for each core), in about the given order.

    ``report(job, error)`` is called as each is done; ``error`` is empty if it succeeded.
    """
    with ProcessPoolExecutor(workers or core_count(), multiprocessing.get_context("spawn")) as pool:
        running = {pool.submit(do_job, job): job for job in jobs}
        for done in as_completed(running):
            error = done.exception()
            if report is not None:
                report(running[done], "" if error is None else " ".join(f"{type(error).__name__}: {error}".split()))


def do_job(job: str) -> None:
    """Call a job, ``module:function``."""
    module, _, name = job.partition(":")
    getattr(importlib.import_module(module), name)()


# ----------------------------------------------------------------------------------------------------
# Threads for compiled loops that leave Python's lock (``nogil``): how many, and pools for all of them.


Part = TypeVar("Part")
Answer = TypeVar("Answer")
_limits = threading.local()


@functools.cache
def _most_threads() -> int:
    """Return the number of threads that were asked for by NUMBA_NUM_THREADS, else of cores."""
    asked = os.environ.get("NUMBA_NUM_THREADS", "")
    return int(asked) if asked.isdigit() and int(asked) > 0 else core_count()


def thread_count() -> int:
    """Return how many threads a parallel loop uses."""
    return getattr(_limits, "count", None) or _most_threads()


def limit_threads(count: int) -> None:
    """Let the parallel loops that this thread calls use at most so many threads."""
    _limits.count = max(min(count, _most_threads()), 1)
    if "numba" in sys.modules:  # (else it is told when it compiles such a loop)
        import numba

        numba.set_num_threads(_limits.count)


@functools.cache
def _pool(_name: str) -> ThreadPoolExecutor:
    return ThreadPoolExecutor(_most_threads(), thread_name_prefix="carom")


if hasattr(os, "register_at_fork"):  # (threads do not survive a fork: a child would wait for them for ever)
    os.register_at_fork(after_in_child=_pool.cache_clear)


def call_in_threads(work: Callable[[Part], Answer], parts: Sequence[Part]) -> list[Answer]:
    """Return ``work(part)`` of every part, in their order. No work may call this itself.

    The first part is done by this thread; in the main thread by another one, too, once Numba is loaded: its loops run Python code
    where they look up the types of arguments, and Ctrl-C, which Python raises in the main thread, would be lost there or end as an
    error of Numba's. The package's own loops run none.
    """
    if not parts or ("numba" in sys.modules and threading.current_thread() is threading.main_thread()):
        return list(_pool("work").map(work, parts))
    return _this_thread_too("work", work, parts)


def call_in_parts(work: Callable[[int], Answer], count: int) -> list[Answer]:
    """Return ``work(part)`` of so many parts of one loop, the first of them done by this thread. No work may call this itself.

    The pool is another than that of :func:`call_in_threads`, whose work may have such loops.
    """
    return _this_thread_too("parts", work, range(count))


def _this_thread_too(pool: str, work: Callable[[Part], Answer], parts: Sequence[Part]) -> list[Answer]:
    """Return the work of every part, the first of them done by this thread."""
    others = [_pool(pool).submit(work, part) for part in parts[1:]]
    try:
        return [work(parts[0]), *(one.result() for one in others)]
    except BaseException:  # (Ctrl-C: the others still write to arrays that are free once this call has ended)
        wait(others)
        raise


# ----------------------------------------------------------------------------------------------------
# Long compiled loops in slices: Ctrl-C is heard between two of them, since Python runs no handler while compiled code does.


SLICE_SECONDS = 0.2  # what a slice is to take
GROWTH = 8  # a slice is at most so many times as long as the one before


class Pace:
    """How much to do at once, so that a slice takes about a fifth of a second.

    Parameters
    ----------
    first : int
        Of the first slice: so little that it is short at any speed, so much that calling the loop takes no time beside it.
    """

    def __init__(self, first: int) -> None:
        self.amount = first
        self._begin = time.perf_counter()

    def begin(self) -> int:
        """Return how much to do in the slice that begins now."""
        self._begin = time.perf_counter()
        return self.amount

    def done(self, amount: int) -> None:
        """Set the amount of the next slice from what was done in this one."""
        took = time.perf_counter() - self._begin
        share = GROWTH if took * GROWTH <= SLICE_SECONDS else SLICE_SECONDS / took
        self.amount = max(int(amount * share), 1)


def block_slices(count: int, length: int) -> Iterator[slice]:
    """Yield slices of ``length`` rows, the last one shorter, that cover ``count`` rows."""
    for start in range(0, count, length):
        yield slice(start, min(start + length, count))


def row_slices(count: int, first: int = 1 << 12) -> Iterator[slice]:
    """Yield slices that cover ``count`` rows; how long they are follows from how long the caller takes with each."""
    pace, start = Pace(first), 0
    while start < count:
        rows = slice(start, min(start + pace.begin(), count))
        yield rows
        pace.done(rows.stop - start)
        start = rows.stop


def sliced(loop: Callable[..., Any], count: int, first: int = 1 << 12) -> Callable[..., None]:
    """Return a loop over ``count`` rows that is run slice by slice: of arrays with so many rows, or flat ones of vectors, a part.

    What has another length is the same for all rows and is passed on whole.
    """
    if count <= first:
        return loop

    def run(*arguments: Any) -> None:
        widths = [
            {count: 1, 3 * count: 3}.get(len(x), 0) if isinstance(x, np.ndarray) and x.ndim else 0 for x in arguments
        ]
        for rows in row_slices(count, first):
            loop(
                *(
                    x[width * rows.start : width * rows.stop] if width else x
                    for x, width in zip(arguments, widths, strict=True)
                )
            )

    return run


# ----------------------------------------------------------------------------------------------------
# Progress of compiling: which function is being compiled at this moment.


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
