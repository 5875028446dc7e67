"""From film to numbers: how often the error bars of fitted restitution and friction hold the truth, the whole way.

    python campaigns/film_coverage.py [N] [--only NAME] [--rows FILE] [--shots 20] [--small]

N tables (200) a camera, with surfaces drawn at random. On each, 20 balls are rolled against cushions with noses by the engine,
and filmed: 30 to 1000 frames a second, noise, pixels, missing frames, places clamped at the cushion. ``carom.tracks`` finds and
measures the contacts in the films alone; nobody measured a sidespin; ``carom.fitting`` fits the law by which the balls were played.
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from typing import Any

import numpy as np
from campaign import Campaign, film_campaign, shares
from reference.synthetic_tracks import NOSE, RADIUS, Camera, filmed

from carom.errors import CaromError
from carom.fitting import Setting, fit_law, make_problem, with_profiles
from carom.fitting.laws import laws_named

NUMBERS = ("restitution", "friction", "spin_mean", "spin_width")
INTERVALS = ("restitution", "friction")  # those that `carom fit` gives by profile likelihood too
CAMERAS = {
    "30 fps": Camera(30, 3e-4),
    "50 fps": Camera(50, 3e-4),
    "240 fps": Camera(240, 3e-4),
    "1000 fps": Camera(1000, 3e-4),
    "50 fps, pixels of 3 mm": Camera(50, 3e-4, pixel=3e-3),
    "120 fps, 20 % missing": Camera(120, 3e-4, missing=0.2),
    "50 fps, clamped at the wall": Camera(50, 3e-4, clamp=True),
}
# The law that is played and fitted, and what the engine calls it
LAWS = {"two-step-after": "after", "two-step": "with"}
SETTING = Setting(radius=RADIUS, contact_height=NOSE / RADIUS)  # the floor is as the film says
KINDS = {f"{law}, {name}": (law, camera) for law in LAWS for name, camera in CAMERAS.items()}


def one(law: str, camera: Camera, seed: int, shots: int) -> dict[str, Any]:
    """A table: (fitted - true) / error of each number, None where there is none; whether intervals hold the truth; the cloth."""
    took = time.process_time()
    try:
        on, measured, rebounds = filmed(LAWS[law], camera, seed, shots)
    except CaromError as error:
        return {"why": error.faults[0]}
    cloth = measured.floor.get("floor friction", (0.2, 0.0))
    fit = fit_law(laws_named([law], "table", False)[0][0], make_problem(rebounds, SETTING)[0])
    fit = with_profiles(fit, INTERVALS)
    truth = {
        "restitution": on.restitution,
        "friction": on.friction,
        "spin_mean": on.spin_mean,
        "spin_width": on.spin_width,
    }
    found: dict[str, Any] = {
        "rows": len(rebounds["v_n_in"]), "chi2": fit.chi2, "dof": fit.dof,
        "cloth": (cloth[0] - on.cloth) / cloth[1] if cloth[1] else None,
        "seconds": time.process_time() - took, "errors": {}, "values": {},
    }  # fmt: skip
    for name in NUMBERS:
        estimate = fit.estimates[name]
        told = estimate.value is not None and bool(estimate.stderr)
        found[name] = (estimate.value - truth[name]) / estimate.stderr if told else None
        found["errors"][name], found["values"][name] = estimate.stderr, estimate.value
    for name in INTERVALS:
        ends = fit.estimates[name].interval_68, fit.estimates[name].interval_95
        # (of a number of which only the least is told, too, the interval says where it is)
        found[f"{name} (profile)"] = [end is not None and end[0] <= truth[name] <= end[1] for end in ends]
    return found


def main(words: Sequence[str] | None = None) -> None:
    """A line a number."""
    film_campaign("film_coverage", __doc__, words, KINDS, report, count=200)


def report(run: Campaign, name: str) -> None:
    """Fit the tables of a law and camera, and print the shares."""
    law, camera = KINDS[name]
    shots: int = run.given.shots
    rows = run.rows.fill(name, range(run.count), lambda seed: one(law, camera, seed, shots))
    good = [row for row in rows if "why" not in row]
    run.say(f"{name}: {len(good)} of {len(rows)} tables fitted, {np.mean([row['rows'] for row in good]):.1f} contacts each,"
          f" {np.mean([row['seconds'] for row in good]):.2f} s")  # fmt: skip
    for number in INTERVALS:
        profile = f"{number} (profile)"
        told = [row[profile] for row in good if row["values"][number] is not None and profile in row]
        run.say(f"    {profile:21} {shares(told)}")
    for number in (*NUMBERS, "cloth"):
        sizes = [size for row in good if (size := row["errors"].get(number))]
        middle = f"{np.median(sizes):.4f}" if sizes else "none given"
        run.say(f"    {number:21} {shares([row[number] for row in good])}; median error {middle}")


if __name__ == "__main__":
    main()
