"""How often the error bars of whole-track fits hold the truth: shots made by the engine, filmed, fitted whole.

    python campaigns/whole_coverage.py [N] [--noise-unknown] [--plot FILE] [--rows FILE]

Of N tables (300) with numbers drawn at random, each with two shots of up to three cushions at 60 frames a second: the share of fits
whose true number lies within 1 and 1.96 standard errors, 68.3 % and 95 % if the error bars are right. The tracks room finds walls,
contacts and noise in each film alone.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from campaign import campaign, counting_errors, held
from reference.synthetic_runs import RADIUS, film

from carom.errors import CaromError
from carom.fitting.rows import Setting
from carom.fitting.tracks import fit_tracks
from carom.tracks import Settings, measure

NUMBERS = ("restitution", "friction", "floor_friction", "rolling_resistance")
NOISE, HEIGHT = 3e-4, 1.2
FAR = 4.0  # error bars


def one(seed: int, known: bool) -> dict[str, Any]:
    """(Fitted less true) / error of each number, and how well the law follows."""
    rng = np.random.default_rng(seed)
    truth = {
        "restitution": rng.uniform(0.7, 0.95), "friction": rng.uniform(0.1, 0.3), "floor_friction": rng.uniform(0.15, 0.25),
        "rolling_resistance": rng.uniform(0.004, 0.012),
    }  # fmt: skip
    tracks = film(rng, 2, noise=NOISE, height=HEIGHT, sliding=bool(seed % 2), **truth)
    try:
        measured = measure(tracks, Settings(radius=0.0, view="above", noise=NOISE if known else None))
        setting = Setting(radius=RADIUS, contact_height=HEIGHT, noise=NOISE if known else None)
        best = fit_tracks(measured, setting, ["two-step"]).best
    except CaromError as error:
        return {"seed": seed, "why": error.faults[0]}
    found: dict[str, Any] = {"seed": seed, "follows": best.follows, "chi2": best.chi2, "dof": best.dof, "pulls": {}}
    for name in NUMBERS:
        estimate = best.estimates[name]
        if estimate.value is not None and estimate.stderr:
            found["pulls"][name] = (estimate.value - truth[name]) / estimate.stderr
            found.setdefault("relative", {})[name] = estimate.stderr / truth[name]
    return found


def plot(rows: list[dict[str, Any]], path: Path) -> None:
    """Histograms of (fitted - true) / error, beside the normal curve."""
    from carom.plot.style import GREY, INK, new_figure, save, style

    with style():
        figure = new_figure(9.6, 2.7)
        z = np.linspace(-4, 4, 200)
        for axes, name in zip(figure.subplots(1, len(NUMBERS), sharey=True), NUMBERS, strict=True):
            pulls = np.array([row["pulls"][name] for row in rows if name in row.get("pulls", {})])
            axes.hist(
                np.clip(pulls, -4, 4), bins=np.linspace(-4, 4, 25), density=True, color="#56B4E9", ec="white", lw=0.4
            )
            axes.plot(z, np.exp(-z * z / 2) / np.sqrt(2 * np.pi), color=INK, lw=1)
            axes.axvline(0, color=GREY, lw=0.6)
            within = [100 * (np.abs(pulls) < limit).mean() for limit in (1, 1.96)]
            axes.set_title(f"{name.replace('_', ' ')}\n{within[0]:.1f} / {within[1]:.1f} % of {len(pulls)}", fontsize=8)
            axes.set_xlabel("(fitted - true) / error")
        figure.tight_layout()
        save(figure, path)


def main(words: Sequence[str] | None = None) -> None:
    """A line a number."""
    options = {"noise_unknown": {"action": "store_true"}, "plot": {"type": Path}}
    with campaign("whole_coverage", __doc__, words, count=300, small=1, **options) as run:
        known = not run.given.noise_unknown
        rows = run.rows.fill(
            "noise known" if known else "noise unknown", range(run.count), lambda seed: one(seed, known)
        )
        good = [row for row in rows if "pulls" in row]
        run.say(f"{len(rows)} tables, {len(good)} fitted, {sum(row['follows'] for row in good)} followed to the noise")
        for name in NUMBERS:
            z = np.abs([row["pulls"][name] for row in good if name in row["pulls"]])
            size = np.median([row["relative"][name] for row in good if name in row["pulls"]] or [np.nan])
            within, error = held(z.tolist()), counting_errors(len(z))[0]
            run.say(f"{name:20} {within[0]:5.1f} / {within[1]:5.1f} % of {len(z)} (68.3 / 95.0 ± {error:.1f});"
                    f" median error {100 * size:.3f} %; {int((z > 5).sum())} beyond 5")  # fmt: skip
        astray = [row["seed"] for row in good if not row["follows"]]
        off = [row["seed"] for row in good if row["follows"] and max(map(abs, row["pulls"].values()), default=0) > FAR]
        run.say(
            f"seeds that do not follow: {astray}; seeds that follow with a number more than {FAR:g} error bars off: {off}"
        )
        if run.given.plot:
            plot(good, run.given.plot)


if __name__ == "__main__":
    main()
