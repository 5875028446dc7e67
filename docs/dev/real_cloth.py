"""Which laws of the cloth and the cushion filmed shots ask for: rolling segments and contacts, without a simulation.

    python docs/dev/real_cloth.py carom_tracks_50hz.csv

Prints the tables of docs/validation/filmed_shots.md. A ball rolls from 0.5 s after a contact on; from there to the next one a
parabola in time is fitted to its track: deceleration, curvature and mean speed are the data of a linear regression. Where the
motions before and after a cushion meet tells how deep the ball turned.
"""

from __future__ import annotations

import argparse
import math
from itertools import pairwise
from pathlib import Path
from typing import NamedTuple

import numpy as np
from real_shots import GRAVITY, HIGH, LOW, TOUCH, closest, cushions, frames, onset, read_tracks

ROLLS, SHORTEST, LONGEST, MARGIN = 0.5, 0.4, 1.5, 0.03  # s
FEWEST, NOISE, KAPPA = 12, 0.0006, 0.4


class Segment(NamedTuple):
    """A ball that rolls: its shot, mean speed, direction, deceleration and sideways acceleration over g with their errors."""

    shot: str
    speed: float
    way: np.ndarray
    slower: float
    across: float
    error: float


def contacts(balls: dict[str, np.ndarray], ball: str) -> np.ndarray:
    """Times at which a ball is at a cushion or at another ball."""
    found = list(cushions(balls[ball]))
    for other, rows in balls.items():
        if other != ball:
            t, gap = closest(balls[ball], rows)
            found += list(t[gap < TOUCH])
    return np.array(sorted(found))


def segments(shots: dict[str, dict[str, np.ndarray]]) -> list[Segment]:
    """All stretches on which a ball rolls."""
    found = []
    for shot, balls in shots.items():
        for ball, all_rows in balls.items():
            rows, first = frames(all_rows), onset(all_rows)
            if first is None or len(rows) < FEWEST:
                continue
            ends = np.append(np.append(all_rows[first, 0], contacts(balls, ball)), rows[-1, 0])
            for begin, end in pairwise(ends):
                low = begin + ROLLS
                while low + SHORTEST < end - MARGIN:
                    high = min(low + LONGEST, end - MARGIN)
                    one = _segment(shot, rows[(rows[:, 0] >= low) & (rows[:, 0] <= high)])
                    if one is not None:
                        found.append(one)
                    low = high
    return found


def _segment(shot: str, rows: np.ndarray) -> Segment | None:
    if len(rows) < FEWEST or rows[-1, 0] - rows[0, 0] < SHORTEST or np.diff(rows[:, 0]).max() > 0.1:
        return None
    t = rows[:, 0] - rows[:, 0].mean()
    v = np.polynomial.polynomial.polyfit(t, rows[:, 1:], 1)[1]
    speed = float(np.hypot(*v))
    if speed < 0.1:
        return None
    way = v / speed
    along, side = rows[:, 1:] @ way, rows[:, 1:] @ np.array([-way[1], way[0]])
    design = np.stack([np.ones_like(t), t, t * t / 2], axis=1)
    cover = np.linalg.inv(design.T @ design)
    fits = [cover @ design.T @ y for y in (along, side)]
    rms = [
        math.sqrt(float(((y - design @ f) ** 2).sum()) / (len(t) - 3)) for y, f in zip((along, side), fits, strict=True)
    ]
    error = max(NOISE, *rms) * math.sqrt(cover[2, 2]) / GRAVITY
    if max(rms) > 0.0015 or error > 0.004:
        return None
    return Segment(shot, speed, way, -float(fits[0][2]) / GRAVITY, float(fits[1][2]) / GRAVITY, error)


def fit(y: np.ndarray, design: np.ndarray, error: np.ndarray) -> tuple[np.ndarray, np.ndarray, float]:
    """Weighted least squares: numbers, errors (scaled by chi), chi^2 over the unscaled errors."""
    a, b = design / error[:, None], y / error
    cover = np.linalg.inv(a.T @ a)
    x = cover @ a.T @ b
    chi = float(((b - a @ x) ** 2).sum())
    return x, np.sqrt(np.diag(cover) * max(chi / (len(y) - len(x)), 1)), chi


def rolling_table(found: list[Segment]) -> None:
    """Compare laws of the resistance, with and without a tilt."""
    error = np.array([one.error for one in found])
    speed = np.array([one.speed for one in found])
    ways = np.array([one.way for one in found])
    y = np.concatenate([[one.slower for one in found], [one.across for one in found]])
    n, zero = len(found), np.zeros(len(found))
    # downhill acceleration of a rolling ball: slope / (1 + kappa)
    columns = {
        "a": np.concatenate([np.ones(n), zero]),
        "b": np.concatenate([speed, zero]),
        "slope x": np.concatenate([-ways[:, 0], -ways[:, 1]]) / (1 + KAPPA),
        "slope y": np.concatenate([-ways[:, 1], ways[:, 0]]) / (1 + KAPPA),
    }
    shots = np.tile([one.shot for one in found], 2)
    # what the errors lack: a scatter from segment to segment, of the largest model
    errors = np.tile(error, 2)
    largest = np.stack(list(columns.values()), axis=1)
    scatter = 0.0
    for _ in range(60):
        chi = fit(y, largest, np.hypot(errors, scatter))[2] / (2 * n - 4)
        scatter = math.sqrt(max(0.0, scatter**2 + 1e-7 * (chi - 1))) if abs(chi - 1) > 1e-3 else scatter
    total = np.hypot(errors, scatter)
    print(
        f"{n} rolling segments of {len(set(shots))} shots, {speed.min():.2f} to {speed.max():.2f} m/s; scatter {scatter:.2g} g"
    )
    best = None
    for names in (("a",), ("a", "b"), ("a", "slope x", "slope y"), ("a", "b", "slope x", "slope y")):
        design = np.stack([columns[name] for name in names], axis=1)
        x, sigma, chi = fit(y, design, total)
        k = len(names) + 1
        aicc = chi + 2 * k + 2 * k * (k + 1) / (2 * n - k - 1)
        held = 0.0
        for shot in set(shots):
            other = shots != shot
            guess = fit(y[other], design[other], total[other])[0]
            held += float((((y - design @ guess)[~other] / total[~other]) ** 2).sum())
        best = aicc if best is None else best
        numbers = ", ".join(f"{name} = {v:.5f} +- {s:.5f}" for name, v, s in zip(names, x, sigma, strict=True))
        print(f"  {numbers}: AICc {aicc - best:+.1f}, chi^2 {chi:.1f}, held out, shot by shot {held:.1f}")


def depth_table(shots: dict[str, dict[str, np.ndarray]]) -> None:
    """Tell where the motions before and after each cushion meet, beyond the line."""
    speeds, depths = [], []
    for balls in shots.values():
        for ball, all_rows in balls.items():
            rows, events = frames(all_rows), contacts(balls, ball)
            for at in cushions(all_rows):
                near = events[(np.abs(events - at) > 0.03)]
                low = max([at - 0.14, *near[near < at]])
                high = min([at + 0.14, *near[near > at]])
                before = rows[(rows[:, 0] > low) & (rows[:, 0] < at - 0.021)]
                after = rows[(rows[:, 0] > at + 0.021) & (rows[:, 0] < high)]
                if len(before) < 4 or len(after) < 4:
                    continue
                x = all_rows[np.argmin(np.abs(all_rows[:, 0] - at)), 1:]
                gaps = np.concatenate([x - LOW, HIGH - x])
                axis, sign = int(np.argmin(gaps)) % 2, 1 if int(np.argmin(gaps)) < 2 else -1
                line = LOW[axis] if sign > 0 else HIGH[axis]
                one = np.polynomial.polynomial.polyfit(before[:, 0] - at, sign * (before[:, 1 + axis] - line), 1)
                two = np.polynomial.polynomial.polyfit(after[:, 0] - at, sign * (after[:, 1 + axis] - line), 1)
                if one[1] > -0.2 or two[1] < 0.1:
                    continue
                t = (two[0] - one[0]) / (one[1] - two[1])
                if abs(t) < 0.04:
                    speeds.append(-one[1])
                    depths.append(-(one[0] + one[1] * t))
    v, d = np.array(speeds), np.array(depths)
    print(f"{len(v)} contacts with a cushion: beyond the line, median")
    for low, high in ((0.2, 0.5), (0.5, 1.0), (1.0, 1.5), (1.5, 2.5), (2.5, 5.0)):
        own = d[(v >= low) & (v < high)]
        if len(own):
            print(f"  {low} to {high} m/s along the normal: {1e3 * np.median(own):.1f} mm ({len(own)})")
    draw = np.random.default_rng(1)
    for name, columns in (
        ("c v", v[:, None]),
        ("line + c v", np.stack([np.ones_like(v), v], axis=1)),
        ("line", np.ones((len(v), 1))),
    ):

        def robust(k: np.ndarray, columns: np.ndarray = columns) -> np.ndarray:
            x = np.linalg.lstsq(columns[k], d[k], rcond=None)[0]
            for _ in range(50):
                w = 1 / np.maximum(np.abs(d[k] - columns[k] @ x), 1e-4)
                x = np.linalg.solve((columns[k] * w[:, None]).T @ columns[k], (columns[k] * w[:, None]).T @ d[k])
            return np.asarray(x)

        x = robust(np.arange(len(v)))
        spread = np.std([robust(draw.integers(0, len(v), len(v))) for _ in range(200)], axis=0)
        rest = d - columns @ x
        laplace = 2 * len(v) * math.log(np.abs(rest).mean()) + 2 * (len(x) + 1)
        numbers = ", ".join(f"{1e3 * p:.2f} +- {1e3 * s:.2f}" for p, s in zip(x, spread, strict=True))
        print(f"  depth = {name}: {numbers} (mm, ms); mean error {1e3 * np.abs(rest).mean():.2f} mm, AIC {laplace:.1f}")


def main() -> None:
    """Print both tables."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("tracks", type=Path)
    shots = read_tracks(parser.parse_args().tracks)
    rolling_table(segments(shots))
    depth_table(shots)


if __name__ == "__main__":
    main()
