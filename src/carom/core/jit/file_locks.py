"""Locks of files between processes; they end with the process that holds them.

There are none on Windows and on some network drives: what needs a lock goes on without it.
"""

from __future__ import annotations

import contextlib
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import IO

__all__ = ["locked", "try_lock"]

LONGEST_WAIT = 300.0  # s; longer than any loop takes to compile, after which a process compiles it itself
POLL_INTERVAL = 0.05  # s


def try_lock(file: IO[str] | int, shared: bool = False) -> bool | None:
    """Lock an open file (or its descriptor) until it is closed, without waiting.

    False where another process has it, None where there are no locks.
    """
    try:
        import fcntl

        fcntl.flock(file, (fcntl.LOCK_SH if shared else fcntl.LOCK_EX) | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    except (ImportError, OSError):
        return None
    return True


@contextmanager
def locked(path: Path) -> Iterator[None]:
    """Hold the lock of a file, after waiting for it; where there is none to be had, go on without it."""
    with contextlib.ExitStack() as stack:
        with contextlib.suppress(OSError):
            path.parent.mkdir(parents=True, exist_ok=True)
            file = stack.enter_context(path.open("w"))
            give_up = time.monotonic() + LONGEST_WAIT
            while try_lock(file) is False and time.monotonic() < give_up:
                time.sleep(POLL_INTERVAL)
        yield
