"""The first run of a new installation, with an empty cache of machine code, and the next one: time and memory.

    python benchmarks/first.py [--numba]

Every repeat is a process of its own. With ``--numba`` the loops of the package are not used: Numba compiles.
"""

from __future__ import annotations

import os
import sys
import tempfile
from pathlib import Path

from rows import REPEATS, SMALL, Row, process, repeated, report, run_script

DOCS = Path(__file__).parents[1] / "docs"
SCENE, GAS, REBOUNDS = (
    DOCS / "scenes" / "three_balls.toml", DOCS / "scenes" / "rough_gas.toml", DOCS / "data" / "carom_tracks_rebounds.csv",
)  # fmt: skip
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
AIM = f"""
import sys
sys.path.insert(0, {str(Path(__file__).parent)!r})
import carom
from aim import REACH, position
carom.aim(position(), ["balls.0.velocity"], REACH)
"""
FIT = f"fit {REBOUNDS} --where use=yes --radius 0.03075 --contact-height 1.2033 --scatter share"
# What is run, and what the first and the next of it may take, s; what is loaded for the next, bytes.
WORKS = {
    "arrays of states": ([sys.executable, "-c", ARRAYS], 1.5, 0.8),
    "many runs": ([sys.executable, "-c", MANY], 1.5, 0.8),
    "carom simulate": ([*CAROM, "simulate", str(SCENE), "--quiet"], 1.5, 0.8),
    "carom orbit, with exponents": ([*CAROM, "orbit", "stadium", "--bounces", "1000", "--lyapunov"], 1.5, 0.8),
    "carom gas": ([*CAROM, "gas", str(GAS), "--max-events", "2000", "--quiet"], 2.0, 0.8),
    "a three-cushion shot aimed": ([sys.executable, "-c", AIM], 4.0, 2.0),
    "carom fit of README's 89 rows": ([*CAROM, *FIT.split()], 10.0, 5.0),
}
MEMORY = 100e6  # bytes wanted of the next


def main() -> None:
    """Two rows for each work, and the memory of many runs."""
    numba = "--numba" in sys.argv[1:]
    if SMALL:
        process(WORKS["arrays of states"][0], os.environ)
        print("not measured: a process ran")
        return
    for name, (words, *wanted) in WORKS.items():
        times, most = [list[float](), list[float]()], 0.0
        for _ in range(1 if "fit" in words else REPEATS):  # (which takes ten seconds)
            with tempfile.TemporaryDirectory() as folder:
                environment = {**os.environ, "CAROM_CACHE": folder, "CAROM_NATIVE": "0" if numba else "1"}
                for found in times:
                    took, most = process(words, environment)
                    found.append(took)
        for which, found, limit in zip(("first", "next"), times, wanted, strict=True):
            work = f"{name}, the {which} of an installation{', by Numba' if numba else ''}"
            report(repeated(work, found, wanted=limit * 1e9))
        if name == "many runs":
            report(
                Row(f"{name}, the memory of the next", most, "process", low=1.0, high=1.0, wanted=MEMORY, memory=True)
            )


if __name__ == "__main__":
    run_script(main)
