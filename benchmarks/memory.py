"""What memory alone costs: a cache line read somewhere in 0.25 to 64 MiB, when the next place is known ahead and when it is not.

    python benchmarks/memory.py [--mebibytes 0.25,2,20,64]

Nanoseconds of CPU time a line, the best of several stretches. Beside `gas.py`: a gas takes 200 bytes a ball, and a collision reads
some fifty lines of it. How far the third cache reaches changes from one minute to the next where other programs share it.
"""

from __future__ import annotations

import argparse
import time
from typing import Any

import numpy as np
from rows import REPEATS, SMALL, run_script, usually

from carom.core.jit.compile import njit

LINE = 8  # numbers of a cache line
READS = usually(2_000_000, 5_000)


def chased(lines: Any, start: int, reads: int) -> int:
    """Each line says which is next."""
    k = start
    for _ in range(reads):
        k = lines[k, 0]
    return k


def known(lines: Any, order: Any, reads: int) -> int:
    """A list says which lines are to be read."""
    total = 0
    for _ in range(reads // len(order)):
        for k in order:
            total += lines[k, 0]
    return total


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--mebibytes", default="0.25" if SMALL else "0.25,2,20,64")
    parser.add_argument("--repeats", type=int, default=REPEATS)
    given = parser.parse_args()
    one_by_one, ahead = njit(chased), njit(known)
    rng = np.random.default_rng(1)
    for size in map(float, given.mebibytes.split(",")):
        count = int(size * 2**20) // (8 * LINE)
        lines = np.zeros((count, LINE), np.int64)
        order = rng.permutation(count)
        lines[order, 0] = np.roll(order, -1)
        reads = READS // count * count or count
        best = [np.inf, np.inf]
        for _ in range(given.repeats):
            for n, (read, where) in enumerate(((one_by_one, order[0]), (ahead, order))):
                begin = time.process_time()
                read(lines, where, reads)
                best[n] = min(best[n], (time.process_time() - begin) / reads * 1e9)
        print(f"{size:7.2f} MiB  next place unknown {best[0]:6.1f} ns  known {best[1]:5.1f} ns a line", flush=True)


if __name__ == "__main__":
    run_script(main)
