"""A GPU beside the cores: impacts against the GPU's memory, shots against this machine's cores, and how many results differ.

    python benchmarks/gpu.py [SHOTS]

Impacts: the one-contact law on arrays that lie on the GPU, against copying as many bytes as it reads and writes from one place of
its memory to another, each the median of ten; the arrays of the benchmark are far larger than its caches. Shots: those of
benchmarks/sweeps.py, with and without what is compiled once. Without a GPU it says so, and measures nothing.
"""

from __future__ import annotations

import statistics
import sys
import time
from collections.abc import Callable
from typing import Any

import numpy as np
from rows import run_script, usually
from sweeps import KEEP, table

import carom
from carom.core.jit import cuda as gpu
from carom.core.jit.threads import thread_count
from carom.laws.contact import contact_rows

IMPACTS = usually(10_000_000, 1_000)
BLOCKS = {"cores": 65_536, "cuda": 1_000_000}  # points of a block
SHOTS = int(sys.argv[1]) if len(sys.argv) > 1 else usually(1_000_000, 100)


def seconds(cuda: Any, work: Callable[[], Any]) -> float:
    """Return the median time of ten calls on the GPU, by its own clock; the first call, which compiles, is not counted."""
    work()
    times = []
    for _repeat in range(10):
        begin, end = cuda.event(), cuda.event()
        begin.record()
        work()
        end.record()
        end.synchronize()
        times.append(cuda.event_elapsed_time(begin, end) / 1e3)
    return statistics.median(times)


def impacts(cuda: Any) -> None:
    """Print what an impact takes, and which share of the memory's speed that is."""
    random = np.random.default_rng(1)
    v = random.normal(size=(IMPACTS, 3))
    v[:, 0] = -abs(v[:, 0])
    w = random.normal(size=(IMPACTS, 3))
    given = [v, w, np.array([[1.0, 0.0, 0.0]]), np.array([[0.026, 0.4, 0.85, 0.2, 0.0]])]
    vectors, numbers = (IMPACTS, 3), IMPACTS
    answers = [np.empty(vectors), np.empty(vectors), np.empty(vectors), np.empty(numbers), np.empty(numbers, np.int8)]
    loop = gpu.CudaLoop(contact_rows)
    there = [cuda.to_device(one) for one in given]
    found = [cuda.device_array(one.shape, one.dtype) for one in answers]
    took = seconds(cuda, lambda: loop.on(IMPACTS, *there, *found))
    moved = sum(one.nbytes for one in (v, w, *answers))
    source, target = (cuda.device_array(moved // 2, np.int8) for _ in range(2))
    copy = seconds(cuda, lambda: target.copy_to_device(source))
    from carom.laws.arrays import loop_for

    loop_for(contact_rows, IMPACTS)(*given, *answers)
    on_gpu = [one.copy_to_host() for one in found]
    differ = sum(
        int((a != b).any(axis=-1).sum() if a.ndim > 1 else (a != b).sum()) for a, b in zip(answers, on_gpu, strict=True)
    )
    print(f"impacts: {IMPACTS / took:.3g}/s on the GPU, {copy / took:.0%} of its memory's speed (goal: over 70 %)")
    print(f"impacts: {differ:,} of {IMPACTS * len(answers):,} results differ from those of the cores")


def shots() -> None:
    """Print what shots take on GPU and cores, and how far their ends are apart."""
    side = max(int(np.sqrt(SHOTS)), 1)
    space = carom.Space(table(), {"balls.0.velocity": carom.polar(np.linspace(0.5, 5, side), np.linspace(0, 90, side))})
    times, results = {}, {}
    for place, block in BLOCKS.items():
        for run in ("first", "again"):
            begin = time.perf_counter()
            results[place] = carom.sweep(space, KEEP, block=block).run(on=place)
            times[place, run] = time.perf_counter() - begin
    for place, name in (("cores", f"{thread_count()} cores"), ("cuda", "the GPU")):
        print(f"shots: {space.size / times[place, 'again']:,.0f}/s on {name} (first run {times[place, 'first']:.1f} s)")
    print(f"shots: the GPU's time is 1/{times['cores', 'again'] / times['cuda', 'again']:.3g} of the cores'")
    apart = np.abs(results["cores"][KEEP[0]].values - results["cuda"][KEEP[0]].values).max(axis=-1).ravel()
    print(f"shots: {(apart > 0).sum():,} of {space.size:,} ends differ; by more than 1 um {(apart > 1e-6).sum():,}")


def main() -> None:
    """Print all figures."""
    reason = gpu.why_no_gpu()
    if reason:
        print(f"no GPU: {reason}; nothing measured")
        return
    name = gpu.cuda.get_current_device().name
    print(name.decode() if isinstance(name, bytes) else name)
    impacts(gpu.cuda)
    shots()


if __name__ == "__main__":
    run_script(main)
