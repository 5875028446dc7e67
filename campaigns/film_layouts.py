"""Films with a known truth in the layouts of all readers: does each give the film's restitution, within its error bar?"""

from __future__ import annotations

import sys
import tempfile
from collections.abc import Sequence
from functools import partial
from pathlib import Path

import numpy as np
from campaign import campaign, shares
from reference.film_layouts import DRAWN, LAYOUTS, RATE, RESTITUTION, drawn, film

from carom.errors import CaromError
from carom.tracks import Calibration, Settings, measure, read_tracks
from carom.tracks.least_squares import ContactFit

PER_KIND = 15  # times as many films of each drawn kind
MOST_OFF = 0.01  # of the restitution: more is a misread file


def restitutions(name: str, seed: int, folder: Path) -> list[list[float]]:
    """Return restitution and error bar of each ball of a film in a layout."""
    layout = LAYOUTS[name]
    path = folder / "film.txt"
    path.write_bytes(
        layout.write(film(seed=100 * seed + list(LAYOUTS).index(name), along=0.5 + seed % 5 / 4)).encode(
            layout.encoding
        )
    )
    found = read_tracks(path, calibration=Calibration(layout.scale, layout.rate, layout.down))
    fits = [one.fit for one in measure(found.tracks, Settings(view="side", radius=0.0)).contacts]
    return [with_error(fit) for fit in fits if fit is not None]


def case(name: str, folder: Path, seed: int) -> dict[str, object]:
    """Return the restitutions of a film in a layout, or why it was refused."""
    try:
        return {"found": restitutions(name, seed, folder), "fault": ""}
    except CaromError as error:
        return {"found": [], "fault": str(error)}


def drawn_case(kind: str, folder: Path, seed: int) -> dict[str, object]:
    """Return the restitutions of a drawn film, and how many frames the worst row's time is off; or why it was refused."""
    one = drawn(kind, seed)
    path = folder / "film.csv"
    path.write_text(one.text, encoding="utf-8")
    try:
        found = read_tracks(path, calibration=Calibration(one.scale, one.rate, one.down))
        made = measure(found.tracks, Settings(view="side", radius=0.0))
    except CaromError as error:
        return {"found": [], "off": 0.0, "fault": f"{one.about}: {error}"}
    (track,) = made.tracks
    fits = [contact.fit for contact in made.contacts if contact.fit is not None]
    off = (
        len(one.frame)
        if len(track) != len(one.frame)
        else np.abs((track.time - track.time[0]) * RATE - one.frame + one.frame[0]).max()
    )
    return {
        "found": [with_error(fit) for fit in fits],
        "off": float(off),
        "coarse": one.coarse,
        "fault": "",
        "about": one.about,
    }


def with_error(fit: ContactFit) -> list[float]:
    """Return the ratio of the normal speeds after and before a contact, and its error bar."""
    before, after = -fit["vn_in"], fit["vn_out"]
    variance = (fit.error("vn_in") / before) ** 2 + (fit.error("vn_out") / after) ** 2
    shared = (
        2 * fit.covariance_of("vn_in", "vn_out") / (before * after)
    )  # (the fit's v_n before the contact is negative)
    return [after / before, after / before * float(np.sqrt(variance + shared))]


def main(words: Sequence[str] | None = None) -> None:
    """Run the campaign."""
    with (
        campaign("film_layouts", __doc__ or "", words, count=10, small=1) as run,
        tempfile.TemporaryDirectory() as place,
    ):
        pulls: list[float] = []
        wrong = films = 0
        for name in LAYOUTS:
            if not run.wants(name, LAYOUTS):
                continue

            for row in run.rows.fill(name, range(run.count), partial(case, name, Path(place))):
                films += 1
                off = [value - RESTITUTION for value, _error in row["found"]]
                pulls += [(value - RESTITUTION) / error for value, error in row["found"]]
                if len(off) != LAYOUTS[name].tracks or max(map(abs, off)) > MOST_OFF:
                    wrong += 1
                    run.say(f"{name}, film {row['seed']}: {row['fault'] or row['found']}")
        run.say(f"{films} films in {len(LAYOUTS)} layouts, {len(pulls)} contacts: {wrong} films misread or refused")
        run.say(f"restitution within 1 / 1.96 error bars: {shares(pulls)}")
        for kind in DRAWN:
            if not run.wants(kind, DRAWN):
                continue
            pulls, wrong, rows = (
                [],
                0,
                run.rows.fill(kind, range(PER_KIND * run.count), partial(drawn_case, kind, Path(place))),
            )
            for row in rows:
                pulls += [(value - RESTITUTION) / error for value, error in row["found"]]
                far = [value for value, error in row["found"] if abs(value - RESTITUTION) > max(MOST_OFF, 4 * error)]
                if row["fault"] or len(row["found"]) != 1 or far or row["off"] > max(0.1, row["coarse"]):
                    wrong += 1
                    run.say(f"{kind}, film {row['seed']}: {row['fault'] or (row['about'], row['found'], row['off'])}")
            run.say(f"{kind}: {len(rows)} films: {wrong} misread or refused; within {shares(pulls)}")


if __name__ == "__main__":
    main(sys.argv[1:])
