"""Threads for compiled loops that leave Python's lock (``nogil``): one pool for all of them."""

from __future__ import annotations

import functools
import os
import threading
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import TypeVar

from carom.core.jit.compile import thread_count

__all__ = ["call_in_threads"]

Part = TypeVar("Part")
Answer = TypeVar("Answer")


@functools.cache
def _pool() -> ThreadPoolExecutor:
    return ThreadPoolExecutor(thread_count(), thread_name_prefix="carom")


if hasattr(os, "register_at_fork"):
    # (threads do not survive a fork: a child would wait for them for ever)
    os.register_at_fork(after_in_child=_pool.cache_clear)


def call_in_threads(work: Callable[[Part], Answer], parts: Sequence[Part]) -> list[Answer]:
    """Return ``work(part)`` of every part, in their order. No work may call this itself.

    From the main thread a single part is done in another thread, too: Numba runs Python code where a function is passed to a
    loop, and Ctrl-C, which Python raises in the main thread, would be lost there or end as an error of Numba's.
    """
    if len(parts) == 1 and threading.current_thread() is not threading.main_thread():
        return [work(parts[0])]
    return list(_pool().map(work, parts))
