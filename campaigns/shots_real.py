"""Whole shots of a film of your own: distances by horizon, numbers of the table, halves, what first parts predict.

    python campaigns/shots_real.py [N] --films FILE [--radius METRES] [--only fit|rest|halves|alone]

Without a film, N shots (2) that carom draws are fitted, whose numbers are known. Halves: the shots with even and odd numbers are
fitted by themselves, from scratch; their numbers are compared in error bars, and each half predicts the shots of the other from
their first third and first half. Alone: each shot is fitted by itself, on a table that is given and with all numbers free.
"""

from __future__ import annotations

import math
import statistics
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from campaign import Campaign, campaign
from held_out_shots import HeldOut, predict_rest

import carom
from carom.fitting.result import with_error_bar
from carom.fitting.shots import ShotsFit, drawn_films
from carom.fitting.shots.result import HORIZONS
from carom.tracks.films import tracks_of_films

KINDS = ("fit", "rest", "halves", "alone")
PARTS = ((1 / 3, "first third"), (1 / 2, "first half"))


def fitted(run: Campaign, tracks: Any, table: Any) -> ShotsFit:
    """Fit shots, and say how far they are followed."""
    begin = time.process_time()
    given: dict[str, Any] = {"free": []} if run.small else {}
    best = carom.fit_shots(tracks, table, run.given.radius if table is None else None, **given).best
    run.say(f"{len(best.shots)} shots, {time.process_time() - begin:.0f} s of processors")
    for name in (one for one in HORIZONS if len(best.horizon(one))):
        run.say(f"{name:10} {1e3 * best.median(name):7.1f} mm, median of {len(best.horizon(name))}")
    for name, estimate in best.estimates.items():
        more = f", scatter between shots {best.scatter[name]:.2g}" if best.scatter else ""
        run.say(f"{name:28} {with_error_bar(estimate)}{more}")
    lost = [one.name for one in best.shots if not one.followed]
    run.say(f"not followed: {', '.join(lost) or 'none'}")
    return best


def said_of(run: Campaign, found: Sequence[HeldOut], what: str) -> None:
    """Say how far the rest of the shots was predicted, against time."""
    every = HeldOut(found[0].share, tuple(shot for one in found for shot in one.shots))
    one, two = every.coverage
    run.say(
        f"{what}: the rest {1e3 * every.median:.0f} mm; inside the regions of 68 and 95 %: {100 * one:.0f}, {100 * two:.0f} %"
    )
    for until, far, thought, count in every.against_time():
        run.say(f"  up to {until:3g} s later {1e3 * far:5.0f} mm, expected {1e3 * thought:5.0f} ({count} shots)")


def halves(run: Campaign, tracks: Any) -> None:
    """Fit the shots with even and with odd numbers apart, each from scratch: their numbers beside each other, and what the table
    of one half predicts of the shots of the other."""
    names = list(dict.fromkeys(one.group for one in tracks))
    some = [[one for one in tracks if one.group in names[k::2]] for k in range(2)]
    fits = [carom.fit_shots(one, None, run.given.radius).best for one in some]
    squares = []
    for name in fits[0].names:
        first, second = (fit.estimates[name] for fit in fits)
        if first.stderr and second.stderr:
            apart = (first.value - second.value) / math.hypot(first.stderr, second.stderr)
            squares.append(apart**2)
            run.say(f"{name:28} {with_error_bar(first)} and {with_error_bar(second)}: {apart:+.1f} error bars apart")
    run.say(f"sum of squares {sum(squares):.3g} of {len(squares)}")
    for share, what in PARTS:
        found = [predict_rest(fits[k], share, [one.film for one in fits[1 - k].shots]) for k in range(2)]
        said_of(run, found, f"{what}, by the table of the other half")


def alone(run: Campaign, tracks: Any, table: Any) -> None:
    """Fit each shot by itself, and say how long that takes and how far it is followed."""
    for free, what in (([], "table given"), (None, "all numbers free"))[: 1 if run.small else 2]:
        seconds, distances = [], []
        for name in dict.fromkeys(one.group for one in tracks):
            own, begin = [one for one in tracks if one.group == name], time.perf_counter()
            best = carom.fit_shots(own, table, run.given.radius if table is None else None, free=free).best
            seconds.append(time.perf_counter() - begin)
            distances.append(1e3 * best.median())
        fast = f"{sum(one < 2 for one in seconds)} of {len(seconds)} below 2 s"
        run.say(f"{what}: {statistics.median(seconds):.2f} s in the median, {fast}, at most {max(seconds):.1f} s")
        run.say(f"  followed to {statistics.median(distances):.1f} mm in the median, at most {max(distances):.1f} mm")


def main(words: Sequence[str] | None = None) -> None:
    """A line a horizon, a line a number."""
    options = {"films": {"type": Path}, "radius": {"type": float, "default": 0.03075}}
    with campaign("shots_real", __doc__, words, count=2, small=1, **options) as run:
        if run.given.films:
            tracks, table = tracks_of_films(run.given.films)[0], None
        else:
            tracks, scenes = drawn_films(run.count, seed=5, until=1.5 if run.small else 6.0)
            table = scenes[0]
        if run.wants("alone", KINDS):
            alone(run, tracks, table)
        if run.wants("halves", KINDS) and run.given.films:
            halves(run, tracks)
        if run.given.only in ("alone", "halves"):
            return
        best = fitted(run, tracks, table)
        for share, what in PARTS if run.wants("rest", KINDS) and run.given.films else ():
            said_of(run, [predict_rest(best, share)], what)


if __name__ == "__main__":
    main()
