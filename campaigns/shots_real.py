"""Whole shots of a film of your own: distances by horizon, numbers of the table, shots that are not followed.

    python campaigns/shots_real.py [N] --films FILE [--radius METRES]

Without a film, N shots (2) that carom draws are fitted, whose numbers are known.
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from pathlib import Path

from campaign import campaign

import carom
from carom.fitting.result import with_error_bar
from carom.fitting.shots import drawn_films
from carom.fitting.shots.result import HORIZONS


def main(words: Sequence[str] | None = None) -> None:
    """A line a horizon, a line a number."""
    options = {"films": {"type": Path}, "radius": {"type": float, "default": 0.03075}}
    with campaign("shots_real", __doc__, words, count=2, small=1, **options) as run:
        begin = time.process_time()
        if run.given.films:
            ranking = carom.fit_shots(run.given.films, radius=run.given.radius)
        else:
            tracks, scenes = drawn_films(run.count, seed=5, until=1.5 if run.small else 6.0)
            ranking = carom.fit_shots(tracks, scenes[0], free=[] if run.small else None)
        best = ranking.best
        run.say(f"{len(best.shots)} shots, {time.process_time() - begin:.0f} s of processors")
        for name in (one for one in HORIZONS if len(best.horizon(one))):
            run.say(f"{name:10} {1e3 * best.median(name):7.1f} mm, median of {len(best.horizon(name))}")
        for name, estimate in best.estimates.items():
            run.say(f"{name:28} {with_error_bar(estimate)}")
        lost = [one.name for one in best.shots if not one.followed]
        run.say(f"not followed: {', '.join(lost) or 'none'}")


if __name__ == "__main__":
    main()
