"""The tracks in films of one table, without a measurement of their contacts: for fits of whole shots."""

from __future__ import annotations

from typing import Any

from carom.data.where import Where
from carom.errors import noting
from carom.tracks.film_files import MeasuredFilms, chosen_tracks, read_films
from carom.tracks.formats.text_table import Calibration
from carom.tracks.read import film_of
from carom.tracks.track import Track

__all__ = ["films_of"]


def films_of(
    files: Any, *, scale: float | None = None, rate: float | None = None, where: Where = ()
) -> tuple[list[Track], list[str]]:
    """Return the tracks in films of one table, as :func:`measure_tracks` takes them, and notes of reading: each film is a shot."""
    calibration = Calibration(scale, rate)
    several = isinstance(files, list | tuple) and not all(isinstance(one, Track) for one in files)
    each: Any = files if several else [files]
    found = read_films([film_of(one, number + 1, calibration) for number, one in enumerate(each)], calibration)
    films = MeasuredFilms(found, ())
    with noting(films.reading_notes):
        return chosen_tracks(films, where)
