"""How often the error bars of contacts hold the truth: tracks made by the engine, seen by many cameras, measured again.

    python campaigns/track_coverage.py [N] [--only NAME]

Of N runs (1,000) a camera, the share of contacts whose true velocity lies within 1 and 1.96 standard deviations of the
measured one: 68.3 % and 95 % if the error bars are right, within sqrt(p (1 - p) / N), which stands beside. The whole way is
tested: clock, walls, contacts, noise and floor are found in each track alone.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from campaign import campaign, counting_errors
from reference.synthetic_tracks import Camera, bounce, seen, shot, truth
from rich.console import Console
from rich.progress import track as progress

from carom.errors import CaromError
from carom.tracks import Settings, measure, usable_stages

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
        flies, sliding = kind.startswith("flight"), kind.endswith("(--keep-sliding)")
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
            stages = usable_stages(one, "both", sliding)[0]
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


def kinds() -> dict[str, Camera]:
    """Cameras above a table and beside a floor, and balls that slide at first."""
    found = dict(CAMERAS)
    for name in ("sliding at first, 120 fps", "sliding at first, 50 fps", "sliding at first, 120 fps (--keep-sliding)"):
        found[name] = Camera(120 if "120" in name else 50, 3e-4)
    return found | {
        "flight, 30 fps": Camera(30, 1e-3),
        "flight, 120 fps": Camera(120, 3e-4),
        "flight, 1000 fps": Camera(1000, 3e-4),
    }


def main(words: Sequence[str] | None = None) -> None:
    """A line a camera."""
    with campaign("track_coverage", __doc__, words, count=1000, small=5) as run:
        heads = ("contacts", "fitted", "leaving", "rolling", *NAMES)
        run.say(f"{'within 1 / 1.96 sigma, %':36}", *(f"{head:>13}" for head in heads))
        for kind, camera in kinds().items():
            if not run.wants(kind, kinds()):
                continue
            found, counts = pulls(kind, camera, run.count)
            cells = []
            for name in NAMES:
                z = np.abs(np.array(found[name]))
                one, two = (100 * (z < 1).mean(), 100 * (z < 1.96).mean()) if len(z) else (np.nan, np.nan)
                errors = counting_errors(len(z))
                off = max(abs(one - 68.27) / errors[0], abs(two - 95.0) / errors[1])
                cells.append(f"{one:.1f} / {two:.1f}{' !' if off > 3 else ''}" if len(z) else "-")
            run.say(f"{kind:36}", *(f"{cell:>13}" for cell in (*counts.values(), *cells)))
        one, two = counting_errors(run.count)
        run.say(
            f"counting error with {run.count} runs: {one:.1f} and {two:.1f} points; ! where off by more than three times that"
        )


if __name__ == "__main__":
    main()
