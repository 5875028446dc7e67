"""How often the error bars of contacts hold the truth: tracks made by the engine, seen by many cameras, measured again.

    python benchmarks/track_coverage.py [N] [--only NAME]

Of N runs (1,000) a camera, the share of contacts whose true velocity lies within 1 and 1.96 standard deviations of the
measured one: 68.3 % and 95 % if the error bars are right, within sqrt(p (1 - p) / N), which stands beside. The whole way is
tested: clock, walls, contacts, noise and floor are found in each track alone.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import numpy as np
from rich.console import Console
from rich.progress import track as progress

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))
from track_truth import Camera, bounce, seen, shot, truth

from carom.errors import CaromError
from carom.tracks.measure import Settings, measure
from carom.tracks.table import chosen

CAMERAS = {
    "30 fps": Camera(30, 3e-4),
    "50 fps": Camera(50, 3e-4),
    "120 fps": Camera(120, 3e-4),
    "240 fps": Camera(240, 3e-4),
    "1000 fps": Camera(1000, 3e-4),
    "120 fps, noise 1 mm": Camera(120, 1e-3),
    "120 fps, pixels of 1 mm": Camera(120, 3e-4, pixel=1e-3),
    "120 fps, pixels of 1 mm, no noise": Camera(120, 0.0, pixel=1e-3),
    "1000 fps, pixels of 1 mm, no noise": Camera(1000, 0.0, pixel=1e-3),
    "50 fps, pixels of 3 mm": Camera(50, 3e-4, pixel=3e-3),
    "120 fps, 20 % missing": Camera(120, 3e-4, missing=0.2),
    "50 fps, clamped at the wall": Camera(50, 3e-4, clamp=True),
    "240 fps, clamped at the wall": Camera(240, 3e-4, clamp=True),
}
BEFORE = ("vn_in", "vt_in")
NAMES = ("t", "vn_in", "vt_in", "vn_out", "vt_out", "vn_roll", "vt_roll")


def pulls(
    kind: str, camera: Camera, count: int, seed: int = 0, show: bool = True
) -> tuple[dict[str, list[float]], dict[str, int]]:
    """(Measured less true) / error of each value, and how many contacts there were, and were measured."""
    found: dict[str, list[float]] = {name: [] for name in NAMES}
    counts = {"contacts": 0, "seen": 0, "after_wall": 0, "rolling": 0}
    numbers = range(seed, seed + count)
    for number in progress(numbers, kind, console=Console(stderr=True), transient=True) if show else numbers:
        rng = np.random.default_rng(number)
        flies, sliding = kind.startswith("flight"), kind.endswith("(--sliding)")
        run = bounce(rng) if flies else shot(rng, "sliding" in kind)
        axes = (0, 2) if flies else (0, 1)
        told = truth(run, axes)
        track = seen(run, camera, rng, axes)
        counts["contacts"] += len(told)
        try:
            measured = measure([track], Settings(view="side" if flies else "above", gravity=9.80665))
        except CaromError:
            continue
        for one in measured.measured:
            near = min(told, key=lambda row: abs(row["t"] - one.time))
            if abs(near["t"] - one.time) > 3 / camera.rate:
                continue
            counts["seen"] += 1
            stages = chosen(one, "both", sliding)[0]
            for stage in stages:
                counts[stage] += 1
            for name in NAMES:
                wanted = (
                    stages
                    if name in BEFORE
                    else [stage for stage in stages if (stage == "rolling") == ("roll" in name)]
                )
                if wanted and name in near:
                    found[name].append((one.fit[name] - near[name]) / one.fit.error(name))
    return found, counts


def main() -> None:
    """A line a camera on standard output."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("count", nargs="?", type=int, default=1000)
    parser.add_argument("--only", default="")
    given = parser.parse_args()
    heads = ("contacts", "fitted", "leaving", "rolling", *NAMES)
    print(f"{'within 1 / 1.96 sigma, %':36}", *(f"{head:>13}" for head in heads))
    kinds = dict(CAMERAS)
    for name in ("sliding at first, 120 fps", "sliding at first, 50 fps", "sliding at first, 120 fps (--sliding)"):
        kinds[name] = Camera(120 if "120" in name else 50, 3e-4)
    kinds |= {
        "flight, 30 fps": Camera(30, 1e-3),
        "flight, 120 fps": Camera(120, 3e-4),
        "flight, 1000 fps": Camera(1000, 3e-4),
    }
    for kind, camera in kinds.items():
        if given.only not in kind:
            continue
        found, counts = pulls(kind, camera, given.count)
        cells = []
        for name in NAMES:
            z = np.abs(np.array(found[name]))
            n = max(len(z), 1)
            one, two = (z < 1).mean() if len(z) else np.nan, (z < 1.96).mean() if len(z) else np.nan
            off = [(one - 0.6827) / np.sqrt(0.6827 * 0.3173 / n), (two - 0.95) / np.sqrt(0.95 * 0.05 / n)]
            mark = " !" if max(map(abs, off)) > 3 else ""
            cells.append(f"{100 * one:.1f} / {100 * two:.1f}{mark}" if len(z) else "-")
        print(f"{kind:36}", *(f"{cell:>13}" for cell in (*counts.values(), *cells)), flush=True)
    one, two = (100 * np.sqrt(p * (1 - p) / given.count) for p in (0.6827, 0.95))
    print(
        f"counting error with {given.count} runs: {one:.1f} and {two:.1f} points; ! where off by more than three times that"
    )


if __name__ == "__main__":
    main()
