"""A gas of spheres at number density 0.5 beside other programs: thousand pair collisions a CPU second of one thread.

    python benchmarks/gas_peers.py [--balls 864,10976,108000] [--edmd COMMAND] [--dynamo FOLDER] [--rounds 3]

COMMAND is Smallenburg's EDMD for one size, built to be called with the number of balls and to print its thousand collisions a CPU
second last, after 20 a ball. FOLDER has DynamO's ``dynamod`` and ``dynarun``; left out, they are looked for on the path, and left
out where they are not there. DynamO's figure is the difference of two runs of unlike length, so that reading its file does not
count. The programs take turns; each one's best counts. Numbers of balls are those of a face-centred lattice, as both peers have.
"""

from __future__ import annotations

import argparse
import resource
import shutil
import subprocess
import tempfile
from collections.abc import Callable
from pathlib import Path

from gas import SURFACES, beside, gas

WARM = 20  # collisions a ball before anything is measured


def carom_rate(balls: int, kind: str) -> Callable[[], float]:
    one = gas(balls, SURFACES[kind])
    one.run(WARM * balls)
    collisions = max(300_000, balls)
    return lambda: collisions / one.run(collisions).cpu_seconds / 1000


def cpu_seconds(*command: str) -> float:
    """User time of a command."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    subprocess.run(
        command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, cwd=Path(command[-1]).parent
    )
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before


def dynamo_rate(folder: str | None, cells: int, kind: str, at: str) -> Callable[[], float] | None:
    pack, run = (shutil.which(name, path=folder) for name in ("dynamod", "dynarun"))
    if pack is None or run is None:
        return None
    balls = 4 * cells**3
    start, warm = str(Path(at) / f"start-{kind}.xml"), str(Path(at) / f"warm-{kind}.xml")
    # (its tangential elasticity is 1 where nothing is passed on, -1 where the surfaces' velocity is turned around)
    rough = "-1" if kind == "rough" else "1"
    cpu_seconds(pack, "-m", "0", "-C", str(cells), "-d", "0.5", "--f2", rough, "-r", "1", "-o", start)
    cpu_seconds(run, "-E", "-c", str(WARM * balls), "-o", warm, start)
    few, many = 1000, 1000 + max(100_000, balls)

    def rate() -> float:
        took = [
            cpu_seconds(run, "-E", "-c", str(events), "-o", str(Path(at) / "end.xml"), warm) for events in (few, many)
        ]
        return (many - few) / (took[1] - took[0]) / 1000

    return rate


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--balls", default="864,10976,108000")
    parser.add_argument("--edmd", default="")
    parser.add_argument("--dynamo", default=None)
    parser.add_argument("--kinds", default="smooth,rough")
    parser.add_argument("--rounds", type=int, default=3)
    given = parser.parse_args()
    for wanted in map(int, given.balls.split(",")):
        cells = round((wanted / 4) ** (1 / 3))
        balls = 4 * cells**3
        for kind in given.kinds.split(","):
            with tempfile.TemporaryDirectory() as at:
                programs = {"carom": carom_rate(balls, kind)}
                if given.edmd and kind == "smooth":
                    programs["EDMD"] = lambda n=balls: beside(given.edmd, n)
                if (dynamo := dynamo_rate(given.dynamo, cells, kind, at)) is not None:
                    programs["DynamO"] = dynamo
                best = dict.fromkeys(programs, 0.0)
                for _ in range(given.rounds):
                    for name, rate in programs.items():
                        best[name] = max(best[name], rate())
            ratios = "".join(
                f"  {name} {rate:.0f}: {best['carom'] / rate:.2f}" for name, rate in best.items() if name != "carom"
            )
            print(f"{balls:9,} balls  {kind:6}  carom {best['carom']:5.0f}{ratios}", flush=True)


if __name__ == "__main__":
    main()
