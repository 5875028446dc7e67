"""Run jobs in several processes at once: for compiling, which Numba does in one thread of a process."""

from __future__ import annotations

import contextlib
import importlib
import subprocess
import sys
import threading
from collections.abc import Callable, Iterator, Sequence

from carom.core.jit.background import core_count

__all__ = ["do_job", "run_in_workers", "serve_jobs"]

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
