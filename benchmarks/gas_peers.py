"""Gases of spheres beside other programs: thousand collisions a CPU second of one thread.

    python benchmarks/gas_peers.py [--balls 864,10976,108000] [--gases one,mixed,walls] [--kinds smooth,rough] [--rounds 3]
                                   [--edmd COMMAND] [--dynamo FOLDER]

Three gases: ``one`` species in a periodic box at number density 0.5; ``mixed``, half of the balls smaller (0.7 of the diameter,
0.343 of the mass), filling the same share of the volume; ``walls``, the same two between six walls, whose collisions count as those
of pairs do. Each is brought to equilibrium here, and handed over as it is then, ball by ball. DynamO's ``dynarun`` is looked for
in FOLDER, or on the path, and left out where it is not; its figure is the difference of two runs of unlike length, so that reading
its file does not count. A last run of both says whether the gases are alike: of DynamO's, the time for so many collisions and how
many of them are walls', over what is found here; and its temperature at the end, over that at the beginning. COMMAND is
Smallenburg's EDMD for balls of one size, built to be called with the number of balls and to print its thousand collisions a CPU
second last, after 20 a ball. The programs take turns; each one's best counts. Numbers of balls are those of a face-centred lattice,
as EDMD has.
"""

from __future__ import annotations

import argparse
import bz2
import resource
import shutil
import subprocess
import tempfile
from collections.abc import Callable
from pathlib import Path
from xml.etree import ElementTree as ET

from gas import DENSITY, SURFACES, beside
from gas_dynamo import write_dynamo
from rows import SMALL, paired, report, run_script, usually

import carom
from carom.gas import Gas, Species

WARM = 20  # collisions a ball before anything is measured
LESS = 0.7  # the diameter of the smaller balls


def species_of(name: str, balls: int) -> list[Species]:
    """Large balls, and as many small ones of the same stuff unless there is one species."""
    large = carom.Ball(0.5, 1.0, 0.4)
    if name == "one":
        return [Species(large, balls)]
    small = carom.Ball(0.5 * LESS, LESS**3, 0.4)
    return [Species(large, balls // 2, "large"), Species(small, balls - balls // 2, "small")]


class Programs:
    """One gas, ready to go on here and in DynamO."""

    def __init__(self, name: str, balls: int, kind: str, folder: str | None, at: Path) -> None:
        """Make the gas, bring it to equilibrium, and hand it over."""
        species = species_of(name, balls)
        filled = sum(one.count * float(2 * one.nominal) ** 3 for one in species)
        size = ((filled / DENSITY) ** (1 / 3),) * 3
        self.gas = Gas(species, size, periodic=name != "walls", contacts=SURFACES[kind])
        self.gas.run(WARM * balls)
        self.collisions = max(usually(300_000, 300), balls)
        self.at, self.run = at, shutil.which("dynarun", path=folder)
        self.start = at / "start.xml"
        self.balls, self.state = balls, self.gas.state()
        if self.run is not None:
            write_dynamo(self.start, self.gas, species, size, rough=kind == "rough", walls=name == "walls")

    def here(self) -> float:
        """Thousand collisions a CPU second."""
        found = self.gas.run(self.collisions)
        done = found.pair_collisions + found.wall_collisions
        return done / found.cpu_seconds / 1000

    def dynamo(self) -> float:
        """The same of DynamO."""
        few, many = 1000, 1000 + max(100_000, self.balls)
        return (many - few) / (self._dynamo(many) - self._dynamo(few)) / 1000

    def _dynamo(self, events: int, *more: str) -> float:
        """CPU seconds of a run of so many collisions."""
        assert self.run is not None
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        subprocess.run(
            [self.run, "-E", *more, "-c", str(events), "-o", str(self.at / "end.xml"), str(self.start)],
            check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, cwd=self.at,
        )  # fmt: skip
        return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before

    def alike(self) -> str:
        """What DynamO finds over what is found here, from the same start on: time, collisions with walls; its temperatures."""
        events = 2 * max(100_000, self.balls)
        self._dynamo(events, "-L", "Misc")
        with bz2.open(self.at / "output.xml.bz2") as file:
            misc = ET.parse(file).getroot().find("Misc")
        assert misc is not None
        time, warm = (misc.find(name) for name in ("Duration", "Temperature"))
        assert time is not None
        assert warm is not None
        here = Gas.restore(self.state).run(events)
        ratios = [float(time.attrib["Time"]) / here.simulated_time]
        if here.wall_collisions:
            ratios.append(float(time.attrib["OneParticleEvents"]) / here.wall_collisions)
        ratios.append(float(warm.attrib["Current"]) / float(warm.attrib["Min"]))
        return ", ".join(f"{ratio:.4f}" for ratio in ratios)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--balls", default="108" if SMALL else "864,10976,108000")
    parser.add_argument("--gases", default="one,mixed,walls")
    parser.add_argument("--kinds", default="smooth,rough")
    parser.add_argument("--edmd", default="")
    parser.add_argument("--dynamo", default=None)
    parser.add_argument("--rounds", type=int, default=usually(3, 1))
    given = parser.parse_args()
    asked = [
        (4 * round((wanted / 4) ** (1 / 3)) ** 3, name, kind)
        for wanted in map(int, given.balls.split(","))
        for name in given.gases.split(",")
        for kind in given.kinds.split(",")
    ]
    for balls, name, kind in asked:
        with tempfile.TemporaryDirectory() as at:
            made = Programs(name, balls, kind, given.dynamo, Path(at))
            programs: dict[str, Callable[[], float]] = {"carom": made.here}
            if given.edmd and (name, kind) == ("one", "smooth"):
                programs["EDMD"] = lambda n=balls: beside(given.edmd, n)
            if made.run is not None:
                programs["DynamO"] = made.dynamo
            found: dict[str, list[float]] = {program: [] for program in programs}
            for _ in range(given.rounds):
                for program, rate in programs.items():
                    found[program].append(rate())
            best = {program: max(rates) for program, rates in found.items()}
            alike = f"  (alike: {made.alike()})" if made.run is not None else ""
        line = f"{balls:9,} balls  {name:5}  {kind:6}  carom {best['carom']:5.0f}"
        line += "".join(f"  {other} {rate:.0f}: {best['carom'] / rate:.2f}" for other, rate in list(best.items())[1:])
        print(line + alike, flush=True)
        if "EDMD" in found:
            pairs = [(1e-3 / here, 1e-3 / there) for here, there in zip(found["carom"], found["EDMD"], strict=True)]
            report(paired(f"a gas of {balls:,} smooth spheres", pairs, "EDMD", count=1, unit="collision", wanted=1 / 3))


if __name__ == "__main__":
    run_script(main)
