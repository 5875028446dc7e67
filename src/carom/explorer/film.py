"""Films beside runs in the page: where a film saw each ball, on the clock of the scene; the shots of a fit."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any, Protocol

import numpy as np

from carom.errors import CaromError, Fault, shortened_list, suggestion
from carom.scene.scene import Scene
from carom.simulation.simulate import simulate
from carom.tracks import Calibration, read_tracks
from carom.tracks.read import film_of
from carom.tracks.track import Track

__all__ = ["FilmedRun", "PageFilm", "fitted_shots", "places_in_film", "places_of_shot"]

PageFilm = list[list[list[float]]]
"""Of each ball of a scene the rows of a film: s after the start of the scene, x and y in m."""
BEFORE_FILM_S = 0.2  # that a scene may begin before the film does
STARTS, FRAMES = 400, 60  # starts of the scene that are tried, and frames at which they are compared
STEP_S, MOST_PLACES = 0.002, 20_000  # of the run, between which a ball is taken to go straight
FAR = 0.3  # m: a frame that is farther from the run counts as this far


class FilmedRun(Protocol):
    """A run beside its film: a shot of a fit (:class:`carom.fitting.shots.FittedShot`; fits stand above the page's room)."""

    @property
    def name(self) -> str:
        """Its title."""
        ...

    @property
    def scene(self) -> Scene:
        """The table with the balls as they start."""
        ...

    @property
    def film(self) -> Any:
        """Its ``balls``, ``time`` (T,), ``position`` (T, B, 2) and ``measured`` (T, B)."""
        ...

    @property
    def time(self) -> float:
        """Time of the film at which the scene begins, s."""
        ...

    @property
    def rms(self) -> float:
        """Root mean square distance from the film, m."""
        ...


def fitted_shots(given: Any) -> tuple[FilmedRun, ...]:
    """Return the shots of a fit to whole shots, of a ranking of such fits, or one shot; none of anything else."""
    fit = getattr(given, "best", given)
    shots = getattr(fit, "shots", (given,))
    return (
        tuple(shots)
        if all(isinstance(getattr(one, "scene", None), Scene) and hasattr(one, "film") for one in shots)
        else ()
    )


def places_of_shot(shot: FilmedRun) -> PageFilm:
    """Return where the film of a fitted shot saw its balls."""
    film = shot.film
    return [
        _rows(film.time[seen] - shot.time, film.position[seen, k])
        for k, seen in enumerate(film.measured[:, : len(film.balls)].T)
    ]


def places_in_film(film: Any, shot: str | None, scene: Scene) -> PageFilm:
    """Return where a film saw the balls of a scene, which begins when its run is nearest to the film."""
    found = film_of(film, 0, Calibration())
    tracks = (read_tracks(found) if isinstance(found, Path) else found).tracks
    shots = list(dict.fromkeys(track.group for track in tracks))
    if len(shots) > 1 and shot is None:
        got = f"{len(shots)}: {shortened_list(shots, 6)}"
        raise CaromError(Fault("explore", "film", "one shot", got, "name one with `shot`"))
    if shot is not None and shot not in shots:
        raise CaromError(
            Fault("explore", "shot", f"one of {shortened_list(shots, 6)}", repr(shot), suggestion(shot, shots))
        )
    tracks = tuple(track for track in tracks if shot is None or track.group == shot)
    names = scene.ball_names
    if len(tracks) > len(names):
        raise CaromError(Fault("explore", "film", f"at most the {len(names)} balls of the scene", f"{len(tracks)}"))
    if all(track.name in names for track in tracks):
        order = [names.index(track.name) for track in tracks]
    else:
        order = list(range(len(tracks)))
    start = _start_of_scene(scene, order, tracks)
    places: PageFilm = [[] for _ in names]
    for k, track in zip(order, tracks, strict=True):
        places[k] = _rows(track.time[track.seen] - start, track.position[track.seen][:, :2])
    return places


def _rows(time: Any, position: Any) -> list[list[float]]:
    rows: list[list[float]] = np.column_stack([time, position]).round(5).tolist()
    return rows


def _start_of_scene(scene: Scene, order: Sequence[int], tracks: Sequence[Track]) -> float:
    """Return the time of a film, s, at which the run of a scene begins that is nearest to it."""
    run = simulate(scene)
    seen = [
        (k, *_some(track.time[track.seen], track.position[track.seen])) for k, track in zip(order, tracks, strict=True)
    ]
    first, last = min(t[0] for _k, t, _x in seen), max(t[-1] for _k, t, _x in seen)
    until = min(run.end, last - first + BEFORE_FILM_S)
    grid = np.linspace(0.0, until, max(2, min(MOST_PLACES, int(until / STEP_S))))
    path = np.nan_to_num(np.asarray(run.at(grid).position)[:, :, :2], nan=np.inf)

    def distance(start: float) -> float:
        """Mean distance of the frames from the run, m."""
        far = [
            np.hypot(
                np.interp(t - start, grid, path[:, k, 0]) - x[:, 0], np.interp(t - start, grid, path[:, k, 1]) - x[:, 1]
            )
            for k, t, x in seen
        ]
        return float(np.mean(np.fmin(np.concatenate(far), FAR)))

    tried = np.linspace(first - BEFORE_FILM_S, last, STARTS)
    best = min(tried, key=distance)
    step = tried[1] - tried[0]
    return float(min(np.linspace(best - step, best + step, 41), key=distance))


def _some(time: Any, position: Any) -> tuple[Any, Any]:
    """Return as many frames as are compared."""
    rows = np.unique(np.linspace(0, len(time) - 1, FRAMES).astype(int))
    return time[rows], position[rows]
