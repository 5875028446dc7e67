"""Rebounds of real three-cushion shots: every cushion contact of every ball that can be measured, with error bars.

    python docs/dev/real_rebounds.py carom_tracks_50hz.csv --out rebounds.csv [--stage both] [--keep-sliding]

The tracks are your own copy: rows shot, ball, t_s, x_long_m, y_short_m, three balls from above, no spin. Prints how many
contacts there are, how many are measured and why others are not, what the cloth does, how the rebounds scatter, and what a
straight line through the points after the contact would have given.
"""

from __future__ import annotations

import argparse
import re
from collections import Counter
from pathlib import Path

import numpy as np
from rich.console import Console
from rich.progress import Progress

from carom.tracks import Measured, Settings, measure, read_tracks, to_rebounds, usable_stages

RADIUS = 0.03075
FAST = 0.8  # m/s: slower balls slide for a few frames only


def measured_of(path: Path, **settings: object) -> Measured:
    """The contacts of a file."""
    tracks = read_tracks(path).tracks
    with Progress(console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task("contacts", total=None)
        return measure(
            tracks,
            Settings(radius=RADIUS, view="above", **settings),  # type: ignore[arg-type]
            lambda done, total: bar.update(task, completed=done, total=total),
        )


def straight_line(measured: Measured, first: float = 0.02, last: float = 0.16) -> dict[int, float]:
    """Restitution by a straight line through the places 20 to 160 ms after the contact, by number of a contact."""
    tracks = {(track.group, track.name): track for track in measured.tracks}
    found = {}
    for number, one in enumerate(measured.contacts):
        if one.fit is None:
            continue
        track = tracks[one.group, one.track]
        since = track.time - one.fit["t"]
        rows = (since > first) & (since < min(last, one.last - one.fit["t"]))
        if rows.sum() >= 4:
            away = one.wall.frame(track.position[rows])[:, 0]
            found[number] = float(np.polyfit(since[rows], away, 1)[0]) / -one.fit["vn_in"]
    return found


def quartiles(x: np.ndarray | list[float], digits: int = 2) -> str:
    """Median and quartiles."""
    low, middle, high = np.percentile(x, [25, 50, 75])
    return f"{middle:.{digits}f} ({low:.{digits}f} to {high:.{digits}f}, {len(x)})"


def report(measured: Measured, sliding: bool) -> None:
    """What was found, in words and numbers."""
    for note in measured.notes:
        print(note)
    print(
        f"noise {1e3 * measured.noise:.2f} mm; places rounded to {1e3 * measured.step[0]:.2f}, {1e3 * measured.step[1]:.2f} mm"
    )
    for name, (value, error) in measured.floor.items():
        print(f"{name}: {value:.4f} +- {error:.4f}")
    whys = Counter(re.sub(r"\d[\d.]*", "#", usable_stages(one, "best", sliding)[1]) for one in measured.contacts)
    print(f"{len(measured.contacts)} contacts, {len(measured.measured)} fitted, {whys['']} in the table")
    for why, count in whys.most_common():
        if why:
            print(f"  {count} {why}")
    lines = straight_line(measured)
    fast = {
        number: one for number, one in enumerate(measured.contacts)
        if one.fit is not None and not one.why_not("after_wall") and -one.fit["vn_in"] > FAST
    }  # fmt: skip
    print(f"normal speed out / in, faster than {FAST} m/s: median (quartiles, number)")
    for wall in measured.walls:
        fits = [one.fit for one in fast.values() if one.wall.name == wall.name and one.fit is not None]
        print(f"  {wall.name}: {quartiles([-fit['vn_out'] / fit['vn_in'] for fit in fits])}")
    both = [number for number in fast if number in lines]
    slid = [-measured.contacts[i].fit["vn_out"] / measured.contacts[i].fit["vn_in"] for i in both]  # type: ignore[index]
    print(
        f"the same contacts, sliding then rolling: {quartiles(slid)}; straight line: {quartiles([lines[i] for i in both])}"
    )


def main() -> None:
    """From tracks to a table."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("tracks", type=Path)
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--stage", choices=("best", "after_wall", "rolling", "both"), default="both")
    parser.add_argument(
        "--keep-sliding", action="store_true", help="also balls that still slide when they meet the wall"
    )
    given = parser.parse_args()
    measured = measured_of(given.tracks)
    report(measured, given.keep_sliding)
    table = to_rebounds(measured, given.stage, keep_sliding=given.keep_sliding)
    table.save(given.out)
    counts = Counter([] if table.stage is None else table.stage.tolist())
    print(f"{given.out}: {len(table)} rows ({', '.join(f'{count} {stage}' for stage, count in counts.items())})")


if __name__ == "__main__":
    main()
