"""Rendered films of balls whose truth is known, tracked by carom: places, outlines, restitution, names of balls, spin.

    python campaigns/rendered_films.py [N] [--only NAME] [--rows FILE]

Films are made by `tests/reference/rendered_films.py` (no code of carom). "drawn": N films (200) of 320 x 240 px with drawn light,
exposure, rate, pattern, background and bit rate: how many restitutions lie within two error bars of the truth. The other kinds are
films of 1280 x 720 px, with a ball of 20 px at 60/s, 1/500 s and 12 Mbit/s unless they say otherwise: scatter of a coordinate about
a constant offset, what 95 % of the frames keep, the farthest frame that is not flagged, radius, exposure and restitution, each with
the number that was to be reached.
"""

from __future__ import annotations

import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from campaign import Campaign, Row, campaign, shares
from reference.rendered_films import (
    GREEN_AS_RED,
    ORANGE,
    RED,
    WHITE,
    YELLOW,
    Look,
    RenderedFilm,
    big,
    bouncing_film,
    three_balls_film,
)

from carom import track_film
from carom.errors import CaromError
from carom.tracks import usable_stages
from carom.tracks.films import measure_tracks
from carom.tracks.video import spin as spins
from carom.tracks.video.reading import TrackedFilm

DRAWN, NAMES, SPIN = "drawn", "three balls", "spin of 60 rad/s, 60/s"
# What is given of a film, and the scatter to reach, px
KINDS: dict[str, tuple[dict[str, Any], float]] = {
    "sharp": ({}, 0.08),
    "lossless": ({"bit_rate": None}, 0.08),
    "240/s, 1/1000 s": ({"rate": 240.0, "exposure": 1e-3, "frames": 300}, 0.08),
    "1.5 Mbit/s": ({"bit_rate": 1.5e6}, 0.15),
    "dim (500 electrons)": ({"electrons": 500.0}, 0.15),
    "radius 10 px": ({"radius": 0.01}, 0.15),
    "1/125 s": ({"exposure": 1 / 125}, 0.25),
    "1/60 s": ({"exposure": 1 / 60}, 0.25),
    "1/60 s at 30/s": ({"exposure": 1 / 60, "rate": 30.0, "frames": 60}, 0.35),
    "white on a white wall": ({"look": Look(WHITE, "plain"), "texture": "wall"}, 0.15),
    "red on green of the same luma": (
        {
            "look": Look(RED, "plain", ambient=1.0, highlight=0.0), "texture": "flat", "colour": GREEN_AS_RED, "floor": False,
            "shadow": "",
        },
        0.15,
    ),
    "shadow that touches": ({"shadow": "wall", "depth": 0.6, "texture": "wall"}, 0.15),
    "strong pattern, 60 rad/s": ({"look": Look(WHITE, "soccer"), "spin": (5.0, -8.0, -60.0)}, 0.2),
    "smoothed by 1 px": ({"smooth": 1.0}, 0.15),
    "6 % dropped, 20 % late": ({"dropped": 0.06, "late": 0.2}, 0.08),
    "rolling shutter 15 ms, found": ({"readout": 0.015}, 0.25),
    "rolling shutter 15 ms, given": ({"readout": 0.015}, 0.25),
    "rolling shutter 30 ms at 30/s, found": ({"readout": 0.03, "rate": 30.0, "frames": 60}, 0.25),
    "rolling shutter 15 ms, upside down": ({"readout": 0.015, "rotation": 180}, 0.25),
}  # fmt: skip
FILMS = 3  # of each kind but the drawn ones
NAMED_FILMS = 20


def drawn_film(path: Path, seed: int, **other: float) -> RenderedFilm:
    """A film of anything that a person may film with a phone on a stand; ``other``: in place of what is drawn."""
    rng = np.random.default_rng(seed)
    rate = float(rng.choice([30.0, 60.0, 60.0, 120.0, 240.0]))
    colour = [YELLOW, RED, WHITE, ORANGE, (0.15, 0.25, 0.6)][rng.integers(5)]
    pattern = str(rng.choice(["plain", "plain", "spots", "mark", "soccer"]))
    texture = str(rng.choice(["bricks", "wall", "cloth", "flat"]))
    spin = tuple(rng.normal(0, 15, 3)) if pattern != "plain" else (0.0, 0.0, 0.0)
    seconds = rng.uniform(0.7, 1.0)
    one = {name: float(value) for name, value in {
        "restitution": rng.uniform(0.5, 0.92), "radius": rng.uniform(0.018, 0.04), "scale": rng.uniform(420, 520), "rate": rate,
        "exposure": min(10 ** rng.uniform(-3.3, -1.9), 0.9 / rate), "psf": rng.uniform(0.5, 1.1),
        "electrons": 10 ** rng.uniform(2.9, 4.3), "bit_rate": 10 ** rng.uniform(5.9, 6.8), "depth": rng.uniform(0, 0.7),
        "dropped": rng.choice([0.0, 0.0, 0.05]), "late": rng.choice([0.0, 0.2]), "readout": rng.choice([0.0, 0.0, 0.006]),
        "smooth": rng.choice([0.0, 0.0, 0.7]), "drop": rng.uniform(-0.5, 0.5),
    }.items()}  # fmt: skip
    look = Look(colour, pattern, ambient=float(rng.uniform(0.3, 0.8)), highlight=float(rng.uniform(0, 0.5)))
    return bouncing_film(
        path, look=look, spin=spin, texture=texture, colour=tuple(rng.uniform(0.1, 0.6, 3)), frames=int(seconds * rate), seed=seed,
        shadow=str(rng.choice(["floor", "floor", ""])), **one | other,
    )  # fmt: skip


def bounces_of(found: TrackedFilm, truth: RenderedFilm) -> tuple[list[float], list[float]]:
    """Restitutions less the truth, and their error bars, of the contacts that can be used."""
    off, bars = [], []
    for one in measure_tracks(found, view="side", radius=truth.radius).measured[0].contacts:
        fit = one.fit
        if fit is None or not usable_stages(one, "both")[0]:
            continue
        before, after = -fit["vn_in"], fit["vn_out"]
        shared = 2 * fit.covariance_of("vn_in", "vn_out") / (before * after)
        e = after / before
        off.append(float(e - (truth.restitution or 0.0)))
        bars.append(
            float(e * np.sqrt((fit.error("vn_in") / before) ** 2 + (fit.error("vn_out") / after) ** 2 + shared))
        )
    return off, bars


def compared(found: TrackedFilm, truth: RenderedFilm) -> Row:
    """How far a tracked film is from its truth."""
    true, seen = truth.places["ball"], truth.seen("ball")
    place = found.places["ball"]
    if len(place) != len(true):
        return {"frames": len(place) - len(true)}
    used = found.used["ball"] & seen
    gap = place[used] - true[used]
    offset = np.median(gap, axis=0)
    about = gap - offset
    row: Row = {
        "offset": offset.tolist(), "scatter": about.std(axis=0).tolist(),
        "most": float(np.quantile(np.abs(about), 0.95)), "worst": float(np.abs(about).max()),
        "flagged": float(found.flagged[seen].mean()), "lost": float((~np.isfinite(place).all(axis=1))[seen].mean()),
        "radius": found.radius_px / float(truth.radius_px["ball"][seen].mean()) - 1,
        "exposure": found.exposure / truth.camera.exposure,
    }  # fmt: skip
    row["off"], row["bars"] = bounces_of(found, truth)
    return row


def one_film(kind: str, seed: int) -> Row:
    """Render a film, and track it."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "film.mp4"
        options: dict[str, Any] = {}
        if kind == NAMES:
            return _named(three_balls_film(path, seed=seed))
        if kind == DRAWN:
            truth = drawn_film(path, seed)
        else:
            given = {"look": Look(WHITE, "soccer"), "spin": (5.0, -8.0, -60.0)} if kind == SPIN else KINDS[kind][0]
            truth = bouncing_film(path, seed=seed, **big(**{"restitution": 0.78 + 0.01 * seed, **given}))
            if "given" in kind:
                options["readout"] = truth.camera.readout
        try:
            found = track_film(path, scale=1 / truth.camera.scale, **options)
            if kind == SPIN:
                return _spins(found, truth)
            return compared(found, truth)
        except CaromError as error:
            return {"refused": str(error)}


def _named(truth: RenderedFilm) -> Row:
    try:
        found = track_film(truth.path, balls=3, scale=1 / truth.camera.scale)
    except CaromError as error:
        return {"refused": str(error)}
    names = list(truth.places)
    true = np.stack([truth.places[name] for name in names])
    nearest, off, frames = [], [], 0
    for name, place in found.places.items():
        used = found.used[name]
        away = np.hypot(*np.moveaxis(true[:, used] - place[used], -1, 0))
        nearest.append(np.argmin(away, axis=0))
        off.append(away.min(axis=0))
        frames += int(used.sum())
    own = [int(np.bincount(one).argmax()) for one in nearest]
    wrong = sum(int((one != mine).sum()) for one, mine in zip(nearest, own, strict=True))
    # (two that follow one ball, or a frame that shows another ball than the others)
    return {
        "exchanged": wrong + len(own) - len(set(own)), "most": float(np.quantile(np.concatenate(off), 0.95)),
        "worst": float(np.concatenate(off).max()), "used": frames / true.shape[0] / true.shape[1],
    }  # fmt: skip


def pair_spins(found: TrackedFilm, flight: spins.FlightSpin) -> list[tuple[int, np.ndarray]]:
    """Return frames of a flight, and the spin (3,), rad/s, of each and the next one alone."""
    frames = range(flight.first, flight.last + 1)
    pattern = spins._Pattern(found, "ball", np.array(frames))
    both = [k for k in frames if {k, k + 1} <= pattern.pictures.keys()]
    return [
        (k, spins._refined(pattern, flight.spin, [(k, k + 1, found.times[k + 1] - found.times[k])])[0]) for k in both
    ]


def _spins(found: TrackedFilm, truth: RenderedFilm) -> Row:
    off, pulls, pairs = list[float](), list[float](), list[float]()
    flights = spins.flight_spins(found, "ball")
    for one in flights:
        if one.why:
            continue
        gap = one.spin - truth.spin["ball"][(one.first + one.last) // 2]
        off.append(float(np.abs(gap).max()))
        pulls += (gap / one.error).tolist()
        pairs += [float(np.abs(spin - truth.spin["ball"][k]).max()) for k, spin in pair_spins(found, one)]
    return {"off": off, "pulls": pulls, "pairs": pairs, "flights": len(flights)}


def middle(values: Sequence[float], form: str = ".2g") -> str:
    return f"{np.median(values):{form}}" if len(values) else "none"


def report(run: Campaign, kind: str) -> None:
    """Print a line of a kind."""
    count = {DRAWN: run.count, NAMES: NAMED_FILMS}.get(kind, FILMS)
    first = run.given.first
    rows = run.go_through([(kind, first + k) for k in range(1 if run.small else count)], one_film)
    refused = [row["refused"] for row in rows if "refused" in row]
    good = [row for row in rows if "refused" not in row and "frames" not in row]
    said = f"; refused: {len(refused)}" if refused else ""
    if strange := len(rows) - len(good) - len(refused):
        said += f"; other frames than the film has: {strange}"
    if kind == NAMES:
        names = sum(row["exchanged"] > 0 for row in good)
        run.say(f"{kind}: names exchanged in {names} of {len(good)} films; 95 % of the places within"
                f" {middle([row['most'] for row in good])} px, the worst {max((row['worst'] for row in good), default=0):.2g} px;"
                f" {middle([100 * row['used'] for row in good])} % of the frames used{said}")  # fmt: skip
        return
    if kind == SPIN:
        off, pairs = ([x for row in good for x in row[name]] for name in ("off", "pairs"))
        run.say(f"{kind}: off by {middle(off)} rad/s a flight (median of the worst component, to reach 0.5), {middle(pairs)} a pair"
                f" of frames (to reach 2); {len(off)} of {sum(row['flights'] for row in good)} flights;"
                f" {shares([x for row in good for x in row['pulls']])}{said}")  # fmt: skip
        return
    pulls = [off / bar for row in good for off, bar in zip(row["off"], row["bars"], strict=True)]
    if kind == DRAWN:
        within = sum(all(abs(x) < 2 * bar for x, bar in zip(row["off"], row["bars"], strict=True)) for row in good)
        run.say(
            f"{kind}: all restitutions within two error bars in {within} of {len(good)} films; {shares(pulls)}{said}"
        )
        for text in sorted(set(refused)):
            run.say(f"  refused: {text}")
        return
    scatter, percent = (
        [max(row["scatter"]) for row in good],
        [[100 * row[name] for row in good] for name in ("flagged", "lost")],
    )
    run.say(
        f"{kind}: scatter {middle(scatter)} px (to reach {KINDS[kind][1]:g}), 95 % {middle([row['most'] for row in good])}, worst"
        f" {middle([row['worst'] for row in good])}, offset {middle([np.hypot(*row['offset']) for row in good])} px; flagged"
        f" {middle(percent[0])} %, lost {middle(percent[1])} %; radius {middle([100 * row['radius'] for row in good], '+.2g')} %,"
        f" exposure x {middle([row['exposure'] for row in good], '.3g')}; e off by"
        f" {middle([x for row in good for x in row['off']], '+.2g')}, bar {middle([b for row in good for b in row['bars']])},"
        f" {sum(abs(z) < 2 for z in pulls)} of {len(pulls)} within two{said}"
    )


def main(words: Sequence[str] | None = None) -> None:
    """A line a kind."""
    kinds = [DRAWN, NAMES, SPIN, *KINDS]
    first = {"type": int, "default": 0, "help": "the first seed (default: 0)"}
    with campaign("rendered_films", __doc__, words, count=200, small=1, first=first) as run:
        for kind in kinds:
            if run.wants(kind, kinds):
                report(run, kind)


if __name__ == "__main__":
    main()
