"""Threads for compiled loops that leave Python's lock (``nogil``): how many, and pools for all of them."""

from __future__ import annotations

import functools
import os
import sys
import threading
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor, wait
from typing import TypeVar

from carom.core.jit.background import core_count

__all__ = ["call_in_parts", "call_in_threads", "limit_threads", "thread_count"]

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
