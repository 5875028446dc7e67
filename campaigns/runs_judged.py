"""Does `carom judge` blame carom's own runs? Drawn runs on slopes, among cushions, frozen to one, in the air and from racks.

    python campaigns/runs_judged.py [N] [--only NAME] [--first SEED] [--rows FILE]

N runs (100) a kind, by tests/reference/judged_runs.py, at 60 to 480 frames a second: no violation is right. Then the same runs with
noise of 0.1 and 1 mm (``--only noise``). Then N balls that
bounce, with a fault or without, and with noise (``--only power``), and N films of balls that bounce, of each kind, by the laws
without units; and how many of N films are blamed whose ball hangs in the air, trembles, is struck there, or is no ball, and so on
(``--only film``). And N films that are rendered as a phone would film a ball (``--only rendered``), judged as a person does, by
their files, without and with the ball's radius: as they are, and with bounces that add to the energy.
"""

from __future__ import annotations

import tempfile
from collections import Counter
from collections.abc import Sequence
from pathlib import Path

from campaign import Row, campaign
from reference.judged_runs import FAULTS, FILM_KINDS, KINDS, NOISES, faulty, film_of, judged
from rendered_films import drawn_film

from carom.errors import CaromError
from carom.tracks import judge
from carom.tracks.verdicts import by_film_laws

WRONG = (
    ("hang", 0.1), ("hang", 0.2), ("hang", 0.4), ("jitter", 0.1), ("jitter", 0.2), ("kink", 0.1), ("long", 0.1), ("long", 0.2),
    ("gain", 1.05), ("gain", 1.15), ("softer", 0.1), ("softer", 0.2), ("faster", 0.3), ("faster", 0.5), ("swell", 0.3),
    ("swell", 0.5),
)  # fmt: skip
RENDERED = (("as it is", {}), ("restitution 1.4", {"restitution": 1.4}))
SHOWS = {"gain": "bounce", "hang": "flight", "kink": "flight", "jitter": "steady", "long": "shape", "softer": "restitution",
         "faster": "size", "swell": "size"}  # fmt: skip


def look(kind: str, seed: int) -> Row:
    """How often laws were checked, and the laws of violations."""
    found = judged(kind, seed)
    return {"checked": found.checked, "violated": Counter(one.law for one in found.violations)}


def look_at_film(seed: int, **other: float) -> Row:
    """The laws that a rendered film violates, and how often laws were checked, without and with the ball's radius."""
    row: Row = {}
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "film.mp4"
        radius = drawn_film(path, seed, **other).radius
        for name, given in (("without a radius", None), ("with it", radius)):
            try:
                found = judge(path, radius=given)
                row[name] = {
                    "checked": sum(found.checked.values()),
                    "violated": sorted({one.law for one in found.violations}),
                }
            except CaromError:
                row[name] = {"checked": 0, "violated": []}
    return row


def main(words: Sequence[str] | None = None) -> int:
    """A line a kind; 1 if a run is blamed."""
    blamed = 0
    first = {"type": int, "default": 0, "help": "first seed of the rendered films"}
    with campaign("runs_judged", __doc__, words, count=100, small=1, first=first) as run:
        for kind in KINDS:
            if not run.wants(kind, KINDS):
                continue
            rows = run.rows.fill(kind, range(run.count), lambda seed, kind=kind: look(kind, seed))
            bad = [(seed, row["violated"]) for seed, row in enumerate(rows) if row["violated"]]
            blamed += len(bad)
            count = sum(sum(row["checked"].values()) for row in rows)
            run.say(f"{kind:7} {len(rows)} runs, {count:,} checks, {len(bad)} runs blamed {bad[:9] or ''}")
        for kind in KINDS if run.given.only == "noise" or not (run.small or run.given.only) else ():
            found = [[bool(judged(kind, seed, noise).violations) for seed in range(run.count)] for noise in NOISES[1:]]
            blamed += sum(map(sum, found))
            said = ", ".join(f"{sum(one)} at {1e3 * noise:g} mm" for one, noise in zip(found, NOISES[1:], strict=True))
            run.say(f"noise {kind:7} of {run.count} runs blamed {said}")
        for fault, size in FAULTS if run.given.only == "power" or not (run.small or run.given.only) else ():
            found = [
                [bool(faulty(fault, size, seed, noise).violations) for seed in range(run.count)] for noise in NOISES
            ]
            blamed += sum(map(sum, found)) if fault == "none" else 0
            said = ", ".join(f"{sum(one)} at {1e3 * noise:g} mm" for one, noise in zip(found, NOISES, strict=True))
            run.say(f"fault {fault} {size}: of {run.count} blamed {said}")
        for kind in FILM_KINDS if run.wants("film", ("film",)) or not (run.small or run.given.only) else ():
            films = [by_film_laws(film_of(kind, seed), "") for seed in range(run.count)]
            bad = [seed for seed, one in enumerate(films) if one.violations]
            blamed += len(bad)
            flights = sum(one.checked["flight"] > 0 for one in films)
            shapes = sum(one.checked["shape"] > 0 for one in films)
            said = f"{len(films)} films, {flights} with a flight and {shapes} with a shape that is checked"
            run.say(f"film {kind:7} {said}, {len(bad)} blamed {bad[:9] or ''}")
        for wrong, size in WRONG if run.given.only == "film" or not (run.small or run.given.only) else ():
            found = [by_film_laws(film_of("clean", seed, wrong, size), "") for seed in range(run.count)]
            shown = [one for one in found if one.checked[SHOWS[wrong]]]
            said = f"{sum(bool(one.violations) for one in shown)} of {len(shown)} films in which it may show blamed"
            run.say(f"film {wrong} {size}: {said}")
        for label, other in RENDERED if run.given.only == "rendered" or not (run.small or run.given.only) else ():
            seeds = range(run.given.first, run.given.first + run.count)
            rows = run.rows.fill(label, seeds, lambda seed, other=other: look_at_film(seed, **other))
            for name in ("without a radius", "with it"):
                bad = [
                    (seed, row[name]["violated"])
                    for seed, row in zip(seeds, rows, strict=True)
                    if row[name]["violated"]
                ]
                blamed += len(bad) if not other else 0
                films = sum(row[name]["checked"] > 0 for row in rows)
                run.say(
                    f"rendered, {label}, {name}: of {len(rows)} films {films} judged, {len(bad)} blamed {bad[:9] or ''}"
                )
    return int(blamed > 0)


if __name__ == "__main__":
    raise SystemExit(main())
