"""The first run of a new installation, with an empty cache of machine code, and the next one.

    python benchmarks/first.py [--numba]

Every repeat is a process of its own. With ``--numba`` the loops of the package are not used: Numba compiles.
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
GAS = SCENE.with_name("rough_gas.toml")
CAROM = [sys.executable, "-m", "carom"]
MANY = f"""
import carom, numpy as np
scene = carom.load_scene({str(SCENE)!r})
v = np.array(scene.balls[0].velocity) * np.linspace(0.5, 1, 200)[:, None]
carom.simulate_many(scene, velocity=np.stack([v] + [0 * v] * (len(scene.balls) - 1), axis=1))
"""
ARRAYS = """
import carom, numpy as np
ball, surface = carom.Ball(), carom.Surface(0.8, 0.2)
carom.two_step(ball, carom.rolling(ball, np.tile([-1.0, 0.5, 0.0], (5000, 1))), wall=surface, floor=surface)
"""
# What is run, and what the first and the next of it may take, s.
WORKS = {
    "carom simulate": ([*CAROM, "simulate", str(SCENE), "--quiet"], 8.0, 1.5),
    "many runs": ([sys.executable, "-c", MANY], 1.5, 0.8),
    "arrays of states": ([sys.executable, "-c", ARRAYS], 1.5, 0.8),
    "carom orbit, with exponents": ([*CAROM, "orbit", "stadium", "--bounces", "1000", "--lyapunov"], 1.5, 1.5),
    "carom gas": ([*CAROM, "gas", str(GAS), "--max-events", "2000", "--quiet"], 2.0, 1.5),
}


def main() -> None:
    """Two rows for each work."""
    numba = "--numba" in sys.argv[1:]
    for name, (words, *wanted) in WORKS.items():
        times: list[list[float]] = [[], []]
        for _ in range(REPEATS):
            with tempfile.TemporaryDirectory() as folder:
                environment = {**os.environ, "CAROM_CACHE": folder, "CAROM_NATIVE": "0" if numba else "1"}
                for found in times:
                    begin = time.perf_counter()
                    subprocess.run(words, env=environment, check=True, stdout=subprocess.DEVNULL)
                    found.append(time.perf_counter() - begin)
        for which, found, limit in zip(("first", "next"), times, wanted, strict=True):
            work = f"{name}, the {which} of an installation{', by Numba' if numba else ''}"
            report(Row(work, min(found) * 1e9, "call", high=max(found) / min(found), low=1.0, wanted=limit * 1e9))


if __name__ == "__main__":
    main()
