"""A part of what has to be compiled, compiled beside the rest by another process: where there are two cores, half the waiting.

The process leaves its work in the cache of compiled code, from where this one loads it. Nothing depends on it: where it cannot
be started, fails, or takes too long, the part is compiled here. It ends with the one that started it.
"""

from __future__ import annotations

import contextlib
import importlib
import os
import subprocess
import sys
import threading
from collections.abc import Iterator

__all__ = ["beside", "serve", "wait_for"]

PATIENCE = 300.0  # s: more than the part takes on a slow machine
_at_work: dict[str, subprocess.Popen[bytes]] = {}


@contextlib.contextmanager
def beside(work: str) -> Iterator[None]:
    """While inside, another process does ``work``, ``module:function``: :func:`wait_for` it before what it does is needed."""
    process = _start(work)
    if process is None:
        yield
        return
    _at_work[work] = process
    try:
        yield
    finally:
        del _at_work[work]
        assert process.stdin is not None
        process.stdin.close()  # at which it ends, if it is still there
        process.kill()
        process.wait()


def wait_for(work: str) -> None:
    """Wait until the other process has done its work, or has failed; at once, where there is none."""
    process = _at_work.get(work)
    if process is not None:
        with contextlib.suppress(subprocess.TimeoutExpired):
            process.wait(PATIENCE)


def _start(work: str) -> subprocess.Popen[bytes] | None:
    # (in a program that was packed with its Python, sys.executable is that program)
    if _cores() < 2 or not sys.executable or getattr(sys, "frozen", False):
        return None
    order = f"import sys; sys.path[:] = {sys.path!r}; from carom.beside import serve; serve({work!r})"
    pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    try:
        return subprocess.Popen([sys.executable, "-c", order], **pipes)  # type: ignore[call-overload, no-any-return]
    except (OSError, ValueError):
        return None


def _cores() -> int:
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def serve(work: str) -> None:
    """Do the work; end at once if the process that asked for it does."""
    threading.Thread(target=_follow_the_other, daemon=True).start()
    module, _, name = work.partition(":")
    getattr(importlib.import_module(module), name)()


def _follow_the_other() -> None:
    os.read(0, 1)  # nothing is ever sent: this ends with the other
    os._exit(1)
