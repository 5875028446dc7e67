"""A gas of spheres at number density 0.5: collisions a CPU second, smooth and rough, against the number of balls.

    python benchmarks/gas.py [--balls 1000,10000,100000,1000000] [--beside COMMAND]

Thousand pair collisions a CPU second of one thread, the best of several stretches, interleaved. COMMAND is a program to be
measured in the same run: it is called with the number of balls and has to print its thousand collisions a second, last.
"""

from __future__ import annotations

import argparse
import math
import subprocess
import time

from rows import REPEATS, SMALL, paired, report, run_script, usually

import carom
from carom.gas import Gas, Species

DENSITY = 0.5
FEW, MANY = (
    usually(1_000, 100),
    usually(100_000, 300),
)  # of the rows: what a collision costs among many balls, over that among few
GROWTH = 1.4  # wanted
SURFACES = {"smooth": carom.Surface(1, 0, -1), "rough": carom.Surface(1, math.inf, 1)}


def gas(balls: int, surface: carom.Surface) -> Gas:
    side = (balls / DENSITY) ** (1 / 3)
    return Gas([Species(carom.Ball(0.5, 1.0, 0.4), balls)], (side,) * 3, contacts=surface)


def beside(command: str, balls: int) -> float:
    said = subprocess.run([*command.split(), str(balls)], capture_output=True, text=True, check=True).stdout
    return float(said.split()[-1])


def growth(name: str, surface: carom.Surface, repeats: int = REPEATS) -> None:
    """Report what a collision of MANY balls costs over one of FEW, measured in turn."""
    few, many = gas(FEW, surface), gas(MANY, surface)
    for one in (few, many):
        one.run(20 * len(one.balls().species))
    pairs = [(many.run(3 * MANY).cpu_seconds, few.run(3 * MANY).cpu_seconds) for _ in range(repeats)]
    peer = f"the same gas of {FEW:,}"
    report(paired(f"a gas of {MANY:,} {name} spheres", pairs, peer, count=3 * MANY, unit="collision", wanted=GROWTH))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--balls", default="100" if SMALL else "1000,10000,100000,1000000")
    parser.add_argument("--beside", default="")
    parser.add_argument("--repeats", type=int, default=usually(4, 1))
    given = parser.parse_args()
    begin = time.process_time()
    gas(100, SURFACES["rough"]).run(10)
    print(f"compiled, or loaded, in {time.process_time() - begin:.1f} s of CPU time")
    for name, surface in SURFACES.items():
        growth(name, surface)
    first: dict[str, float] = {}
    for balls in map(int, given.balls.split(",")):
        found = dict.fromkeys(SURFACES, 0.0)
        made = {name: gas(balls, surface) for name, surface in SURFACES.items()}
        for one in made.values():
            one.run(min(20 * balls, 10_000_000))
        collisions = max(usually(300_000, 300), balls)
        other = 0.0
        for _ in range(given.repeats):
            for name, one in made.items():
                found[name] = max(found[name], collisions / one.run(collisions).cpu_seconds / 1000)
            if given.beside:
                other = max(other, beside(given.beside, balls))
        for name in SURFACES:
            first.setdefault(name, found[name])
        line = "  ".join(f"{name} {rate:7.0f} k/s (x {first[name] / rate:.2f})" for name, rate in found.items())
        size = made["rough"].bytes_per_ball
        print(f"{balls:9,} balls  {line}  {size:4.0f} bytes a ball", end="")
        print(f"  beside {other:.0f} k/s: {found['smooth'] / other:.2f}, {found['rough'] / other:.2f}" if other else "")


if __name__ == "__main__":
    run_script(main)
