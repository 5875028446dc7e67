"""What the coverage benchmarks share: runs that are written down as they are done, and how often error bars held the truth."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from rich.console import Console
from rich.progress import track

Row = dict[str, Any]
SHARES = (0.6827, 0.95)


class Kept:
    """Runs by kind and seed, in a file of a JSON line a run where there is one; a run that was broken off goes on from there."""

    def __init__(self, path: Path | None) -> None:
        self.path = path
        self.known: dict[tuple[str, int], Row] = {}
        if path and path.exists():
            for line in path.read_text().splitlines():
                if line.endswith("}"):  # not one that was broken off
                    row = json.loads(line)
                    self.known[row["kind"], row["seed"]] = row

    def fill(self, kind: str, seeds: Iterable[int], run: Callable[[int], Row]) -> list[Row]:
        """One row a seed; ``run`` is asked for those that are not known yet."""
        seeds = list(seeds)
        missing = [seed for seed in seeds if (kind, seed) not in self.known]
        for seed in track(missing, kind, console=Console(stderr=True), transient=True):
            row = {"kind": kind, "seed": seed, **run(seed)}
            self.known[kind, seed] = row
            if self.path:
                with self.path.open("a") as file:
                    file.write(json.dumps(row) + "\n")
        return [self.known[kind, seed] for seed in seeds]


def counting_errors(count: int) -> tuple[float, float]:
    """Of shares of 68.3 and 95 % among so many, in points."""
    one, two = (100 * float(np.sqrt(p * (1 - p) / max(count, 1))) for p in SHARES)
    return one, two


def held(pulls: Sequence[float | Sequence[bool]]) -> tuple[float, float]:
    """Shares (%) within one error bar and within 1.96: of (fitted - true) / error, or of intervals that held or did not."""
    each = [one if isinstance(one, (list, tuple)) else (abs(one) < 1, abs(one) < 1.96) for one in pulls]
    one, two = (100 * np.mean(each, axis=0)).tolist() if each else (np.nan, np.nan)
    return one, two


def shares(pulls: Sequence[float | Sequence[bool] | None]) -> str:
    """Shares with their counting errors; an exclamation mark where one is off by more than two of them."""
    good = [one for one in pulls if one is not None]
    one, two = held(good)
    errors = counting_errors(len(good))
    mark = "!" if any(abs(s - 100 * p) > 2 * e for s, p, e in zip((one, two), SHARES, errors, strict=True)) else " "
    said = (
        f"{one:5.1f} / {two:4.1f} {mark} (68.3 ± {errors[0]:.1f}, 95.0 ± {errors[1]:.1f}; {len(good)} of {len(pulls)})"
    )
    z = np.array([pull for pull in good if isinstance(pull, float)])
    return said + (f"; off by {z.mean():+.2f}, scatter {z.std():.2f}" if len(z) else "")
