"""Whole tracks of real three-cushion shots beside the laws: the picture and the tables of docs/validation/filmed_shots.md.

    python docs/dev/real_whole.py carom_tracks_50hz.csv [--cushions 1] [--laws NAME,NAME] [--picture FILE]

The file is your own copy. The same numbers come from ``carom fit FILE --whole --radius 0.03075 --contact-height 1.2033``.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np
from rich.console import Console
from rich.progress import Progress
from scipy.stats import wilcoxon

from carom.fitting.result import with_error_bar
from carom.fitting.rows import Setting
from carom.fitting.tracks import TrackFit, fit_tracks
from carom.plot.fit import plot_tracks
from carom.plot.style import save
from carom.tracks import Settings, measure, read_tracks

RADIUS, NOSE = 0.03075, 0.037
LAWS = "two-step-after,two-step,contact,maw,no-slip,two-step-paper,mirror,conventional"


def by_shot(fit: TrackFit) -> np.ndarray:
    """RMS distance of each shot, m."""
    groups = [one.group for one in fit.frames.segments]
    return np.array([fit.rms([n for n, g in enumerate(groups) if g == group]) for group in dict.fromkeys(groups)])


def main() -> None:
    """Tables on standard output, the picture to a file."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("tracks", type=Path)
    parser.add_argument("--cushions", type=int, default=1)
    parser.add_argument("--laws", default=LAWS)
    parser.add_argument("--picture", type=Path)
    given = parser.parse_args()
    with Progress(console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task("", total=1.0)
        measured = measure(read_tracks(given.tracks).tracks, Settings(radius=RADIUS, view="above"))
        ranking = fit_tracks(
            measured, Setting(radius=RADIUS, contact_height=NOSE / RADIUS, contacts=given.cushions), given.laws.split(","),
            progress=lambda done, _total, what: bar.update(task, completed=done, description=what),
        )  # fmt: skip
    if given.picture:
        save(plot_tracks(ranking), given.picture)
    best = ranking.best
    print(ranking.verdict, *ranking.notes, sep="\n")
    print(
        "\n| law | numbers | median RMS of a shot, mm | quartiles | AICc above the best | nearer than the best in | chance |"
    )
    print("|---|---|---|---|---|---|---|")
    for fit in ranking.fits:
        size, first = by_shot(fit), by_shot(best)
        numbers = ", ".join(f"{n} {with_error_bar(e)}" for n, e in fit.estimates.items() if not n.startswith("wall"))
        low, middle, high = 1e3 * np.percentile(size, [25, 50, 75])
        nearer = "–" if fit is best else f"{(size < first).sum()} of {len(size)}"
        chance = "–" if fit is best else f"{wilcoxon(np.log(size / first)).pvalue:.2g}"
        spread = f"{low:.1f} to {high:.1f}"
        cells = [fit.law.name, numbers, f"{middle:.2f}", spread, f"{fit.aicc - best.aicc:.0f}", nearer, chance]
        print("| " + " | ".join(cells) + " |")
    groups = [one.group for one in best.frames.segments]
    shots = list(dict.fromkeys(groups))
    each = np.array([by_shot(fit) for fit in ranking.fits])
    print("\n| shot | stretches | contacts | frames | " + " | ".join(fit.law.name for fit in ranking.fits) + " |")
    print("|---" * (4 + len(ranking.fits)) + "|")
    for shot, sizes in zip(shots, each.T, strict=True):
        which = [n for n, group in enumerate(groups) if group == shot]
        contacts = sum(len(best.frames.segments[n].contacts) for n in which)
        cells = [
            shot,
            len(which),
            contacts,
            int(best.frames.count[which].sum()),
            *(f"{1e3 * size:.1f}" for size in sizes),
        ]
        print("| " + " | ".join(map(str, cells)) + " |")


if __name__ == "__main__":
    main()
