"""Does `carom judge` blame carom's own runs? Drawn runs on slopes, among cushions, frozen to one, in the air and from racks.

    python campaigns/runs_judged.py [N] [--only NAME] [--rows FILE]

N runs (100) a kind, by tests/reference/judged_runs.py, at 60 to 480 frames a second: no violation is right. Then N films of balls
that bounce, of each kind, by the laws without units; and how many of N are blamed whose ball hangs in the air, or trembles.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from campaign import Row, campaign
from reference.judged_runs import FILM_KINDS, KINDS, film_of, judged

from carom.tracks.verdicts import by_film_laws

WRONG = (("hang", 0.1), ("hang", 0.2), ("hang", 0.4), ("jitter", 0.1), ("jitter", 0.2))  # radii


def look(kind: str, seed: int) -> Row:
    """How often laws were checked, and the laws of violations."""
    found = judged(kind, seed)
    return {"checked": found.checked, "violated": Counter(one.law for one in found.violations)}


def main(words: Sequence[str] | None = None) -> int:
    """A line a kind; 1 if a run is blamed."""
    blamed = 0
    with campaign("runs_judged", __doc__, words, count=100, small=1) as run:
        for kind in KINDS:
            if not run.wants(kind, KINDS):
                continue
            rows = run.rows.fill(kind, range(run.count), lambda seed, kind=kind: look(kind, seed))
            bad = [(seed, row["violated"]) for seed, row in enumerate(rows) if row["violated"]]
            blamed += len(bad)
            count = sum(sum(row["checked"].values()) for row in rows)
            run.say(f"{kind:7} {len(rows)} runs, {count:,} checks, {len(bad)} runs blamed {bad[:9] or ''}")
        for kind in FILM_KINDS if run.wants("film", ("film",)) or not (run.small or run.given.only) else ():
            films = [by_film_laws(film_of(kind, seed), "") for seed in range(run.count)]
            bad = [seed for seed, one in enumerate(films) if one.violations]
            blamed += len(bad)
            flights = sum(one.checked["flight"] > 0 for one in films)
            run.say(
                f"film {kind:7} {len(films)} films, {flights} with a flight that is checked, {len(bad)} blamed {bad[:9] or ''}"
            )
        for wrong, size in WRONG if run.given.only == "film" or not (run.small or run.given.only) else ():
            found = [by_film_laws(film_of("clean", seed, wrong, size), "") for seed in range(run.count)]
            flights = [one for one in found if one.checked["flight"]]
            said = f"{sum(bool(one.violations) for one in flights)} of {len(flights)} films with a flight blamed"
            run.say(f"film {wrong} {size} radii: {said}")
    return int(blamed > 0)


if __name__ == "__main__":
    raise SystemExit(main())
