"""Threads for compiled loops that leave Python's lock (``nogil``): one pool for all of them."""

from __future__ import annotations

import functools
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


def call_in_threads(work: Callable[[Part], Answer], parts: Sequence[Part]) -> list[Answer]:
    """Return ``work(part)`` of every part, in their order; a single part is done at once. No work may call this itself."""
    return [work(part) for part in parts] if len(parts) == 1 else list(_pool().map(work, parts))
