"""One no-slip orbit in a circle and in polygons, against a loop written by hand in C and compiled with cc -O3, in one run.

    python benchmarks/orbits.py [--bounces 1000000] [--repeats 5] [--cc cc]

Both follow the same orbit on one thread and write time, position, velocity, spin and the side met, bounce by bounce, into
arrays that exist. Printed are the best CPU times and their ratio, and how far the two orbits part: they do the same
arithmetic in another order, so they agree to rounding, which a circle and a polygon multiply slowly.
"""

from __future__ import annotations

import argparse
import ctypes
import os
import subprocess
import tempfile
import time
from pathlib import Path

import numpy as np
from rows import CPU, REPEATS, alone, paired, report, run_script, usually

import carom
from carom import billiards
from carom.billiards.loop import MEMORY, compiled_iterate
from carom.billiards.setup import orbit_setup

BY_HAND = r"""
#include <math.h>

/* no-slip: the slip u_t = v.t - a w (t = (-ny, nx)) comes back, the normal velocity turns round */
#define BOUNCE(nx, ny) \
    { double un = u * (nx) + v * (ny), ut = v * (nx) - u * (ny) - a * w, j = hold * ut; \
      u += -2 * un * (nx) - j * (ny); v += -2 * un * (ny) + j * (nx); w -= j * per; }
#define WRITE(which) \
    { double *row = rows + 6 * k; row[0] = t; row[1] = x; row[2] = y; row[3] = u; row[4] = v; row[5] = w; met[k] = (which); }

void circle(long bounces, const double *s, double radius, double kappa, double a, double *rows, int *met) {
    double x = s[0], y = s[1], u = s[2], v = s[3], w = s[4], t = 0;
    const double hold = -2 * kappa / (1 + kappa), per = 1 / (kappa * a), inverse = 1 / radius;
    for (long k = 0; k < bounces; k++) {
        double b = x * u + y * v, speed = u * u + v * v;
        double dt = (-b + sqrt(b * b - speed * (x * x + y * y - radius * radius))) / speed;
        x += u * dt; y += v * dt; t += dt;
        double nx = -x * inverse, ny = -y * inverse;
        BOUNCE(nx, ny)
        WRITE(0)
    }
}

void polygon(long bounces, const double *s, int sides, const double *nx, const double *ny, const double *c, double kappa,
             double a, double *rows, int *met) {
    double x = s[0], y = s[1], u = s[2], v = s[3], w = s[4], t = 0;
    const double hold = -2 * kappa / (1 + kappa), per = 1 / (kappa * a);
    for (long k = 0; k < bounces; k++) {
        double dt = 1e300;
        int which = -1;
        for (int m = 0; m < sides; m++) {
            double un = u * nx[m] + v * ny[m];
            if (un < 0) {
                double after = (c[m] - x * nx[m] - y * ny[m]) / un;
                if (after < dt) { dt = after; which = m; }
            }
        }
        x += u * dt; y += v * dt; t += dt;
        BOUNCE(nx[which], ny[which])
        WRITE(which)
    }
}
"""


def by_hand(cc: str, folder: Path) -> ctypes.CDLL:
    source, made = folder / "by_hand.c", folder / "by_hand.so"
    source.write_text(BY_HAND)
    subprocess.run([cc, "-O3", "-shared", "-fPIC", "-o", str(made), str(source), "-lm"], check=True)
    return ctypes.CDLL(str(made))


def pointer(array: np.ndarray) -> ctypes.c_void_p:
    return array.ctypes.data_as(ctypes.c_void_p)


def measure(name: str, table: billiards.Table, library: ctypes.CDLL, peer: str, bounces: int, repeats: int) -> float:
    kappa, a = 0.5, 1.0
    setup = orbit_setup(table, carom.Disc(a, 1.0, kappa), "no-slip", None, "end")
    start = np.array([0.1, 0.2, 0.7, 0.4, 0.9])
    x, v, w = (0.1, 0.2, 0.0), (0.7, 0.4, 0.0), (0.0, 0.0, 0.9)
    ours, theirs = np.zeros((bounces, 6)), np.zeros((bounces, 6))
    met, side, last = np.zeros(bounces, np.int32), np.zeros(bounces, np.int32), np.zeros(10)
    nx, ny, c = (
        np.ascontiguousarray(p) for p in (setup.pieces["n"][:, 0], setup.pieces["n"][:, 1], setup.pieces["offset"])
    )
    follow, world = compiled_iterate(), setup.world[0]
    number = ctypes.c_double
    pairs = []
    for _ in range(repeats):
        begin = time.process_time()
        follow(world, setup.pieces, setup.panels, x, v, w, bounces, bounces, ours, met, last, np.zeros(MEMORY))
        own = time.process_time() - begin
        begin = time.process_time()
        rest = (number(kappa), number(a), pointer(theirs), pointer(side))
        if table.name == "circle":
            library.circle(ctypes.c_long(bounces), pointer(start), number(table.sizes["radius"]), *rest)
        else:
            library.polygon(ctypes.c_long(bounces), pointer(start), len(c), pointer(nx), pointer(ny), pointer(c), *rest)
        pairs.append((own, time.process_time() - begin))
    parted = np.abs(ours[:, 1:] - theirs[:, 1:]).max(axis=1)
    assert parted[: min(1000, bounces)].max() < 1e-9, "the two do not follow the same orbit"
    assert (met[:1000] == side[:1000]).all()
    row = paired(f"one no-slip orbit, {name}", pairs, peer, count=bounces, unit="bounce", wanted=1.2)
    report(row)
    energy = [(r[-1, 3:5] ** 2).sum() + kappa * (a * r[-1, 5]) ** 2 for r in (ours, theirs)]
    true = 0.7**2 + 0.4**2 + kappa * 0.9**2
    print(
        f"{name:12} carom {row.nanoseconds:6.1f} ns a bounce, ratio {row.ratio:.2f};"
        f"  apart by {parted[9]:.0e} after 10, {parted[min(999, bounces - 1)]:.0e} after 1000 bounces;"
        f"  energy off by {abs(energy[0] / true - 1):.0e}, C {abs(energy[1] / true - 1):.0e}"
    )
    return row.ratio


def many(name: str, table: billiards.Table) -> None:
    """Report many orbits at once, on all cores."""
    orbits, bounces = usually(20_000, 100), usually(1000, 10)
    begin = billiards.starts(table, orbits, 1)
    billiards.final(table, begin, 10)
    # (the processor's time is of all cores together)
    count = orbits * bounces / (1 if CPU else os.cpu_count() or 1)
    work = f"many no-slip orbits, {name}"
    report(alone(work, lambda: billiards.final(table, begin, bounces), count=count, unit="bounce and core", wanted=12))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--bounces", type=int, default=usually(1_000_000, 1_000))
    parser.add_argument("--repeats", type=int, default=REPEATS)
    parser.add_argument("--cc", default="cc")
    given = parser.parse_args()
    tables = {"circle": billiards.circle(), "triangle": billiards.regular(3), "square": billiards.regular(4)}
    tables |= {"pentagon": billiards.regular(5), "dodecagon": billiards.regular(12)}
    with tempfile.TemporaryDirectory() as folder:
        library = by_hand(given.cc, Path(folder))
        version = subprocess.run(
            [given.cc, "-dumpfullversion"], check=True, capture_output=True, text=True
        ).stdout.strip()
        peer = f"C, {given.cc} {version} -O3"
        worst = max(measure(name, table, library, peer, given.bounces, given.repeats) for name, table in tables.items())
    print(f"worst ratio {worst:.2f} (at most 1.5 is wanted)")
    for name, table in tables.items():
        many(name, table)


if __name__ == "__main__":
    run_script(main)
