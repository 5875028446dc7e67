"""Films of balls that strike balls at rest, with a known truth: do the error bars hold it, of each contact and of the fitted law?

    python campaigns/known_collisions.py [N]

N films (20) of 20 shots each, made without the engine (`tests/reference/pair_films.py`): 50 frames a second, noise of 0.3 mm,
balls that roll, slide, follow or draw, with sidespin. Printed are the shares within 1 and 1.96 error bars of the truth of each
contact's restitution, impulses and time, and of restitution and friction of the law fitted to each film.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from campaign import Campaign, Row, campaign, shares
from reference.pair_films import drawn_shots

from carom.fitting import Setting, fit_laws
from carom.tracks import Settings, Track, measure, measure_pairs, pair_rebounds

RADIUS, NOISE, RESTITUTION, FRICTION = 0.03075, 3e-4, 0.93, 0.06
OF_CONTACT = ("restitution", "impulse along the line", "impulse upwards", "time")
OF_FILM = ("restitution of the law", "friction of the law")


def film(seed: int, shots: int) -> Row:
    """(Measured less true value) / error of one film: of each of its contacts, and of the fitted law."""
    rng = np.random.default_rng(seed)
    made = drawn_shots(rng, shots)
    tracks = [
        Track(name, made.time, x[:, k] + NOISE * rng.normal(size=x[:, k].shape), group=str(k))
        for k in range(shots) for name, x in (("cue", made.striking), ("red", made.struck))
    ]  # fmt: skip
    about = Settings(radius=RADIUS, view="above", noise=NOISE, floor_friction=0.2, rolling_resistance=0.008)
    met = measure_pairs(measure(tracks, about))
    found: dict[str, Any] = {name: [] for name in (*OF_CONTACT, *OF_FILM)}
    for one in met:
        if one.fit is None:
            continue
        k, e = int(one.group), one.restitution
        pulls = (
            (e.value - RESTITUTION) / e.error, (one.fit["jn"] - made.normal[k]) / one.fit.error("jn"),
            (one.fit["jz"] - made.across[k, 2]) / one.fit.error("jz"), (one.fit["t"] - made.contact[k]) / one.fit.error("t"),
        )  # fmt: skip
        for name, pull in zip(OF_CONTACT, pulls, strict=True):
            found[name].append(float(pull))
    best = fit_laws(pair_rebounds(met, RADIUS), Setting(radius=RADIUS), ["sliding"], bootstrap=0).best
    for name, given, truth in zip(OF_FILM, ("restitution", "friction"), (RESTITUTION, FRICTION), strict=True):
        one = best.estimates[given]
        if one.value is not None and one.stderr:
            found[name].append(float((one.value - truth) / one.stderr))
    return {**found, "lost": int(np.isfinite(made.contact).sum()) - len(found["time"])}


def report(run: Campaign, rows: Sequence[Row]) -> None:
    """Print a line of each quantity."""
    for name in (*OF_CONTACT, *OF_FILM):
        pulls = [pull for row in rows for pull in row[name]]
        run.say(f"{name}: {shares(pulls)}")
    run.say(f"{sum(row['lost'] for row in rows)} contacts not measured")


def main(words: Sequence[str] | None = None) -> None:
    """A line a quantity."""
    with campaign("known_collisions", __doc__, words, count=20, small=1) as run:
        shots = 4 if run.small else 20
        report(
            run, run.go_through([("film", seed) for seed in range(run.count)], lambda _kind, seed: film(seed, shots))
        )


if __name__ == "__main__":
    main()
