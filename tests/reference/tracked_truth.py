"""The record of a film as if its balls had been tracked: the truth of a rendered film, with noise."""

from __future__ import annotations

import av
import numpy as np
from reference.rendered_films import RenderedFilm

from carom.tracks.video.reading import TrackedFilm


def as_tracked(film: RenderedFilm, noise: float = 0.05, flagged: tuple[int, ...] = (), seed: int = 0) -> TrackedFilm:
    """Places with noise (px), all frames in which the balls are seen whole, some of them ``flagged`` and 2 px off."""
    rng = np.random.default_rng(seed)
    bad = np.isin(np.arange(len(film.times)), flagged)
    places, speeds = {}, {}
    for name, place in film.places.items():
        x = place + rng.normal(0, noise, place.shape) + 2.0 * bad[:, None]
        places[name] = np.where(film.seen(name)[:, None], x, np.nan)
        v = film.motions[name].velocity_at(film.row_times[name])[:, :2] * film.camera.scale
        speeds[name] = v * [1, -1]
    with av.open(str(film.path)) as container:
        background = next(container.decode(video=0)).to_ndarray(format="rgb24")
        background = np.rot90(background, 0)
    return TrackedFilm(
        film.path, film.times, places, float(np.mean([r.mean() for r in film.radius_px.values()])), np.where(bad, 12.0, 1.0), bad,
        film.camera.exposure, film.camera.psf, background, speeds,
    )  # fmt: skip
