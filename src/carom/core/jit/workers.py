"""Run jobs in several processes at once: for compiling, which Numba does in one thread of a process."""

from __future__ import annotations

import contextlib
import importlib
import os
import subprocess
import sys
import threading
from collections.abc import Callable, Iterator, Sequence

from carom.core.jit.progress import announce, watch_compiling

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
    order = f"import sys; sys.path[:] = {sys.path!r}; from carom.core.jit.workers import serve; serve({work!r})"
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


# ----------------------------------------------------------------------------------------------------
# Run jobs in several processes at once: for compiling, which Numba does in one thread of a process.


_lines = threading.Lock()


def run_in_workers(
    jobs: Sequence[str], workers: int | None = None, report: Callable[[str, str], None] | None = None
) -> None:
    """Call every job, ``module:function``, in one of so many processes (default: one for each core), in about the given order.

    ``report(job, error)`` is called as each is done; ``error`` is empty if it succeeded.
    Jobs of a process that fails or cannot be started are left undone.
    """
    remaining = iter(jobs)

    def drive() -> None:
        order = f"import sys; sys.path[:] = {sys.path!r}; from carom.core.jit.workers import serve_jobs; serve_jobs()"
        with contextlib.suppress(OSError), subprocess.Popen(
            [sys.executable, "-c", order], stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True
        ) as process:  # fmt: skip
            assert process.stdin is not None
            assert process.stdout is not None
            for job in _shared(remaining):
                print(job, file=process.stdin, flush=True)
                answer = process.stdout.readline()
                if report is not None:
                    report(job, answer.strip() if answer else "the process ended")
                if not answer:
                    return
            process.stdin.close()

    threads = [threading.Thread(target=drive) for _ in range(workers or core_count())]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()


def _shared(jobs: Iterator[str]) -> Iterator[str]:
    """The next job, as often as there is one that no other thread took."""
    while True:
        with _lines:
            job = next(jobs, None)
        if job is None:
            return
        yield job


def do_job(job: str) -> None:
    """Call a job, ``module:function``."""
    module, _, name = job.partition(":")
    getattr(importlib.import_module(module), name)()


def serve_jobs() -> None:
    """Do the jobs that standard input names, answering each with a line on standard output, its error; end when the input does."""
    answers = sys.stdout
    sys.stdout = sys.stderr
    for line in sys.stdin:
        try:
            do_job(line.strip())
        except Exception as error:
            message = " ".join(f"{type(error).__name__}: {error}".split())
            print(message, file=answers, flush=True)
        else:
            print(file=answers, flush=True)
