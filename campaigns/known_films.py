"""Films with a known truth: falls with drag, bounces too low to be found, noise that is correlated, and paths without any contact.

    python campaigns/known_films.py [N] [--only NAME]

N films (200) of each kind, made without the engine (`tests/reference/known_films.py`): the share of restitutions within 1 and
1.96 error bars of the truth, and how many films have one that is more than three off; of smooth paths (pendulums, valleys, rails),
how many have a contact with a result.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from campaign import Campaign, campaign, shares
from reference.known_films import drawn_curve, drawn_fall, fallen

from carom.errors import CaromError
from carom.fitting import Setting, fit_laws
from carom.tracks import Settings, measure, usable_stages
from carom.tracks.films import measure_films
from carom.tracks.read import TrackFile

# What is given of the falls, and whether the air slows them
FALLS: dict[str, dict[str, float]] = {
    "falls": {},
    "falls in air, k 0 to 0.05 per metre": {"drag": 0.05},
    "falls in air, camera rolled by 1 degree (rms)": {"drag": 0.05, "roll": 1.0},
    "noise correlated by 0.5": {"correlation": 0.5},
    "noise correlated by 0.9": {"correlation": 0.9},
}
TOGETHER = "films of one ball in air, five at a time, k 0 to 0.05 per metre: their restitution"
EACH = 5
CURVES = "smooth paths without a contact"


def pulls(seed: int, kind: str) -> list[tuple[float, float]]:
    """(Measured less true) / error of each bounce of a film: of the restitution, and of the change of v_t."""
    rng = np.random.default_rng(seed)
    given = dict(FALLS[kind])
    if "drag" in given:
        given |= {"drag": rng.uniform(0, given["drag"]), "height": rng.uniform(0.5, 2.0), "last": rng.uniform(1.0, 3.0)}
    if "roll" in given:
        given["roll"] *= rng.normal()
    fall = drawn_fall(rng, **given)
    track, bounces = fallen(fall, seed)
    found = []
    for one in measure([track], Settings(view="side", drag_per_metre=None if "drag" in given else 0.0)).contacts:
        fit = one.fit
        if fit is None or not usable_stages(one, "both")[0]:
            continue
        before, after = -fit["vn_in"], fit["vn_out"]
        shared = 2 * fit.covariance_of("vn_in", "vn_out") / (before * after)
        error = (fit.error("vn_in") / before) ** 2 + (fit.error("vn_out") / after) ** 2 + shared
        e = after / before
        # (the wall's second axis is to the left)
        lost = min(bounces, key=lambda bounce: abs(bounce.t - one.time)).v_t_lost + fit["vt_out"] - fit["vt_in"]
        spread = fit.error("vt_in") ** 2 + fit.error("vt_out") ** 2 - 2 * fit.covariance_of("vt_in", "vt_out")
        found.append((float((e - fall.restitution) / (e * np.sqrt(error))), float(lost / np.sqrt(spread))))
    return found


def pull_together(seed: int) -> float:
    """(Fitted less true restitution) / error of a basketball filmed several times, at 60 frames per second with 2 mm noise."""
    rng = np.random.default_rng(seed)
    drag, films = rng.uniform(0, 0.05), []
    for i in range(EACH):
        given = {"height": rng.uniform(1, 2), "last": rng.uniform(1.5, 2.5), "speed": rng.uniform(0, 0.5), "first": 0.0}
        fall = drawn_fall(rng, drag, restitution=0.78, rate=60.0, noise=2e-3, **given)
        films.append(TrackFile(Path(f"film{i}.csv"), "made", (fallen(fall, 1000 * seed + i)[0],), ()))
    rows = measure_films(films, settings=Settings(view="side")).rebounds()
    found = fit_laws(rows, Setting(0.12, 2 / 3), ["mirror"], profiles=False, bootstrap=0).best.estimates["restitution"]
    return ((found.value or 0.0) - 0.78) / (found.stderr or 1.0)


def has_contact(seed: int) -> bool:
    """Whether a smooth path has a contact with a result."""
    _kind, track = drawn_curve(np.random.default_rng(seed))
    return any(usable_stages(one, "both", True)[0] for one in measure([track]).contacts)


def report(run: Campaign, kind: str) -> None:
    """Print a line of a kind."""
    if kind == CURVES:
        run.say(f"{kind}: {sum(map(has_contact, range(run.count)))} of {run.count} films have a contact with a result")
        return
    if kind == TOGETHER:
        run.say(f"{kind}: {shares([pull_together(seed) for seed in range(max(run.count // EACH, 1))])}")
        return
    films, refused = [], 0
    for seed in range(run.count):
        try:
            films.append(pulls(seed, kind))
        except CaromError:
            refused += 1
    for which, name in enumerate(("", "; change of v_t") if "roll" in FALLS[kind] else ("",)):
        off = sum(any(abs(z[which]) > 3 for z in film) for film in films)
        run.say(f"{kind}{name}: {shares([z[which] for film in films for z in film])}; {off} of {len(films)} films more than 3"
              f" error bars off" + (f", {refused} refused" if refused else ""))  # fmt: skip


def main(words: Sequence[str] | None = None) -> None:
    """A line a kind."""
    kinds = [*FALLS, TOGETHER, CURVES]
    with campaign("known_films", __doc__, words, count=200, small=3) as run:
        for kind in kinds:
            if run.wants(kind, kinds):
                report(run, kind)


if __name__ == "__main__":
    main()
