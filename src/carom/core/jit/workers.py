"""Run jobs in several processes at once: for compiling, which Numba does in one thread of a process."""

from __future__ import annotations

import importlib
import multiprocessing
import os
from collections.abc import Callable, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed


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
