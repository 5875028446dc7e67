"""Compile in another process while this one compiles or computes something else: with two cores, half the waiting.

The other process leaves its work in the cache of compiled code, from where this one loads it. Nothing depends on it: where it
cannot be started, fails, or takes too long, the part is compiled here. It ends with the process that started it.
"""

from __future__ import annotations

import contextlib
import importlib
import os
import subprocess
import sys
import threading
from collections.abc import Iterator

from carom.core.jit.progress import announce, watch_compiling

__all__ = ["compile_in_background", "core_count", "serve", "wait_for"]

LONGEST_WAIT = 300.0  # s: more than the part takes on a slow machine
_processes: dict[str, subprocess.Popen[bytes]] = {}


@contextlib.contextmanager
def compile_in_background(work: str) -> Iterator[None]:
    """While inside, another process does ``work``, ``module:function``; :func:`wait_for` it before its result is needed."""
    process = _start(work)
    if process is None:
        yield
        return
    _processes[work] = process
    relay = threading.Thread(target=_relay, args=[process], daemon=True)
    relay.start()
    try:
        yield
    finally:
        del _processes[work]
        assert process.stdin is not None
        process.stdin.close()  # at which it ends, if it is still there
        process.kill()
        process.wait()
        relay.join()


def _relay(process: subprocess.Popen[bytes]) -> None:
    """Announce what the other process compiles, which writes a line for each beginning and end."""
    assert process.stdout is not None
    with process.stdout:
        for line in process.stdout:
            name, _, finished = line.decode().strip().rpartition(" ")
            announce(name, finished == "1")


def wait_for(work: str) -> None:
    """Wait until the other process has done its work, or has failed; at once, where there is none."""
    process = _processes.get(work)
    if process is not None:
        with contextlib.suppress(subprocess.TimeoutExpired):
            process.wait(LONGEST_WAIT)


def _start(work: str) -> subprocess.Popen[bytes] | None:
    # (in a program that was packed with its Python, sys.executable is that program)
    if core_count() < 2 or not sys.executable or getattr(sys, "frozen", False):
        return None
    order = f"import sys; sys.path[:] = {sys.path!r}; from carom.core.jit.background import serve; serve({work!r})"
    pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "stderr": subprocess.DEVNULL}
    try:
        return subprocess.Popen([sys.executable, "-c", order], **pipes)  # type: ignore[call-overload, no-any-return]
    except (OSError, ValueError):
        return None


def core_count() -> int:
    """Return how many cores this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def serve(work: str) -> None:
    """Do the work; end at once when the parent process does."""
    threading.Thread(target=_end_with_parent, daemon=True).start()
    module, _, name = work.partition(":")
    with watch_compiling(lambda function, finished: _write_line(f"{function} {finished:d}\n")):
        getattr(importlib.import_module(module), name)()


def _write_line(text: str) -> None:
    with contextlib.suppress(OSError):  # nobody listens any more
        os.write(1, text.encode())


def _end_with_parent() -> None:
    os.read(0, 1)  # nothing is ever sent: the pipe ends with the parent
    os._exit(1)
