"""The first run of a new installation: ``carom simulate`` with an empty cache, and the next one.

    python benchmarks/first.py

Every repeat is a process of its own with an empty folder of compiled code.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from rows import REPEATS, Row, report

SCENE = Path(__file__).parents[1] / "docs" / "scenes" / "three_balls.toml"
WANTED = {"first": 8e9, "next": 1.5e9}  # ns


def main() -> None:
    """Two rows."""
    times: dict[str, list[float]] = {which: [] for which in WANTED}
    for _ in range(REPEATS):
        with tempfile.TemporaryDirectory() as folder:
            for which in WANTED:
                begin = time.perf_counter()
                words = [sys.executable, "-m", "carom", "simulate", str(SCENE), "--quiet"]
                subprocess.run(words, env={**os.environ, "CAROM_CACHE": folder}, check=True, stdout=subprocess.DEVNULL)
                times[which].append(time.perf_counter() - begin)
    for which, found in times.items():
        work = f"carom simulate, the {which} of an installation"
        report(Row(work, min(found) * 1e9, "call", high=max(found) / min(found), low=1.0, wanted=WANTED[which]))


if __name__ == "__main__":
    main()
