"""Held-out prediction: the first part of a shot predicts the rest, with the region in which the balls are expected."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.errors import CaromError
from carom.fitting.shots.film import FilmedShot, until_time
from carom.fitting.shots.followed import LawErrors, belief_of_start, drawn_rests, followed
from carom.fitting.shots.result import ShotsFit
from carom.fitting.shots.search import SearchSettings, ShotStart, horizons, refined, search_start
from carom.fitting.shots.table import table_of
from carom.fitting.table_numbers import TableNumbers

__all__ = ["HeldOut", "PredictedShot", "errors_of_laws", "predict_rest"]

Array = NDArray[np.float64]
LEVELS = (0.68, 0.95)
FEWEST_DRAWS = 20
FEWEST = 6  # frames of a shot, before it is followed in steps
SHOTS, DRAWS = 12, 40  # of a fit, and of each: for the errors of the laws
FACTORS, HALVINGS = (0.1, 6.0), 4  # on the errors of the laws: where a search looks, and for how long


@dataclass(frozen=True, eq=False)
class PredictedShot:
    """The rest of a shot as its first part predicts it."""

    name: str
    time: Array
    """(T,) s since the end of the part that was fitted."""
    place: Array
    """(T, B, 2) m: median of the draws."""
    distance: Array
    """(T, B) m: from there to the film; NaN where the film has no row."""
    expected: Array
    """(T, B) m: the distance that is expected (root mean square of the draws)."""
    inside: NDArray[np.bool_]
    """(2, T, B): whether the film lies within the regions of 68 and 95 %."""
    fitted: float
    """m: distance (rms) in the part that was fitted."""

    @property
    def rms(self) -> float:
        """Root mean square distance over the rest, m."""
        return float(np.sqrt(np.nanmean(np.square(self.distance))))


class HeldOut(NamedTuple):
    """What first parts of shots predict of the rest; made by :func:`predict_rest`."""

    share: float
    """Of a shot's time: the part that was fitted."""
    shots: tuple[PredictedShot, ...]

    @property
    def median(self) -> float:
        """Median over the shots of the distance (rms) over the rest, m."""
        return float(np.median([one.rms for one in self.shots]))

    @property
    def coverage(self) -> tuple[float, float]:
        """Shares of the film's rows within the regions of 68 and 95 %: means over the shots, which count alike."""
        found = [one.inside[:, np.isfinite(one.distance)].mean(axis=1) for one in self.shots]
        return float(np.mean([x[0] for x in found])), float(np.mean([x[1] for x in found]))

    def against_time(self, edges: Sequence[float] = (0, 0.5, 1, 2, 3, 4, 6)) -> list[tuple[float, float, float, int]]:
        """Return rows (until so many s after the first part, median distance in m, expected one, number of shots)."""
        rows = []
        for low, high in itertools.pairwise(edges):
            far, thought = [], []
            for one in self.shots:
                which = (one.time > low) & (one.time <= high)
                if np.isfinite(one.distance[which]).any():
                    seen = np.isfinite(one.distance[which])
                    far.append(np.sqrt(np.mean(np.square(one.distance[which][seen]))))
                    thought.append(np.sqrt(np.mean(np.square(one.expected[which][seen]))))
            if far:
                rows.append((float(high), float(np.median(far)), float(np.median(thought)), len(far)))
        return rows


def predict_rest(
    fit: ShotsFit, share: float = 1 / 3, films: Sequence[FilmedShot] | None = None, *, draws: int = 200, seed: int = 0,
    errors: LawErrors | None = None,
) -> HeldOut:  # fmt: skip
    """Predict the rest of shots from their first parts, with the numbers of the table of a fit.

    The start of each shot is fitted up to its second event. From there the shot is followed in steps, in which
    the laws have errors at each change of a velocity, to the end of the first part. The rest is drawn from what is known then,
    with such errors in each later step; its middle is the median of the draws.

    Parameters
    ----------
    fit : ShotsFit
    share : float
        Of a shot's time, 0 to 1: the part that is fitted.
    films : sequence of FilmedShot, optional
        Shots of the same table; default: those of the fit. Others, that were not fitted, test the table's numbers as well.
    draws, seed : int
    errors : LawErrors, optional
        Default: :func:`errors_of_laws` of the fit.

    Examples
    --------
    >>> import carom
    >>> from carom.fitting.shots import drawn_films, predict_rest
    >>> tracks, scenes = drawn_films(1, seed=5, until=3.0)
    >>> fit = carom.fit_shots(tracks, scenes[0], free=[]).best
    >>> predict_rest(fit, 0.6).median < 0.05
    True
    """
    if not 0 < share < 1:
        raise CaromError(f"predict_rest: share: expected a number between 0 and 1, got {share!r:.60}")
    begun = _begun(fit, films or [one.film for one in fit.shots], share, seed)
    if errors is None:
        errors = errors_of_laws(fit, share, seed=seed) if films else _errors(fit, begun, seed)
    return _held_out(fit, share, begun, errors, draws, seed)


def errors_of_laws(fit: ShotsFit, share: float = 1 / 3, *, seed: int = 0) -> LawErrors:
    """Return the errors of the laws with which the regions of 68 % hold so many of the film's rows, counted on a fit's own shots:
    those of :class:`LawErrors` times a factor."""
    return _errors(fit, _begun(fit, [one.film for one in fit.shots], share, seed), seed)


def _errors(fit: ShotsFit, begun: Sequence[_Begun], seed: int) -> LawErrors:
    """Return the errors of the laws by bisection of their factor, on some of the shots."""
    some = begun[:: max(len(begun) // SHOTS, 1)]
    low, high = np.log(FACTORS)
    for _ in range(HALVINGS if some else 0):
        middle = (low + high) / 2
        errors = LawErrors().times(float(np.exp(middle)))
        held = _held_out(fit, 0.0, some, errors, DRAWS, seed).coverage[0]
        low, high = (middle, high) if held < LEVELS[0] else (low, middle)
    return LawErrors().times(float(np.exp((low + high) / 2)))


def _held_out(
    fit: ShotsFit, share: float, begun: Sequence[_Begun], errors: LawErrors, draws: int, seed: int
) -> HeldOut:
    """Return all predictions with given errors of the laws."""
    table = fit.table
    return HeldOut(share, tuple(_predicted(fit, table, one, errors, draws, seed) for one in begun))


def _first_frames(shot: FilmedShot) -> int:
    """Return how many frames there are up to the second event: those from which a start is known."""
    later = [shot.frames_until(one.low) for one in shot.events[1:]]
    return min(max(later[0], FEWEST) if later else horizons(shot)[0], len(shot.time))


class _Begun(NamedTuple):
    """A shot whose first part is to be followed."""

    shot: FilmedShot
    first: FilmedShot
    start: ShotStart
    best: Array
    frames: int
    """Up to which the start is the best."""


def _begun(fit: ShotsFit, films: Sequence[FilmedShot], share: float, seed: int) -> list[_Begun]:
    """Return the shots that go on after their first part, with the start that fits the frames up to the first ball."""
    table, found = fit.table, []
    for i, shot in enumerate(films):
        first = until_time(shot, share)
        if len(first.time) < len(shot.time):
            rng, frames = np.random.default_rng([seed, i]), _first_frames(first)
            start = search_start(table, first, fit.noise, rng, SearchSettings(), widths=fit.widths)
            found.append(_Begun(shot, first, start, refined(table, start, frames, 9, 3).start, frames))
    return found


def _predicted(
    fit: ShotsFit, table: TableNumbers, begun: _Begun, errors: LawErrors, draws: int, seed: int
) -> PredictedShot:
    """Return the rest of a shot by draws of what its first part tells, and of the laws' errors after it."""
    shot, first, n, rng = begun.shot, begun.first, len(begun.first.time), np.random.default_rng([seed, 1])
    belief, distance = belief_of_start(table, begun.start, begun.best, begun.frames, errors), float("nan")
    until = followed(table, first, belief, errors)
    if until is not None:
        belief, distance = until.belief, until.distance
    rest = slice(n, None)
    x = shot.position[rest]
    places = drawn_rests(table, belief, len(shot.balls), shot.time[rest], errors, draws, rng)
    wall = table_of(fit.scene)
    inside = np.abs(places - np.array(wall.center)) < np.array([wall.length, wall.width]) / 2
    on_table = inside.all(axis=(1, 2, 3))  # (a ball that is drawn behind a cushion leaves it; NaN: no state)
    places = places[on_table] if on_table.sum() >= FEWEST_DRAWS else np.nan_to_num(places)
    middle = np.median(places, axis=0)
    # (a place of the film has the error with which the laws follow the frames up to the first ball, at least that of a frame)
    near = fit.median("ball") / np.sqrt(2)
    noise = max(fit.noise, near if np.isfinite(near) else 0.0)
    away = places - middle + rng.normal(0.0, noise, places.shape)
    cover = np.einsum("ntbi,ntbj->tbij", away, away) / len(away)
    inverse = np.linalg.inv(cover)
    film = x - middle
    of_draws = np.einsum("ntbi,tbij,ntbj->ntb", away, inverse, away)
    of_film = np.einsum("tbi,tbij,tbj->tb", film, inverse, film)
    with np.errstate(invalid="ignore"):
        inside = np.array([of_film <= np.quantile(of_draws, level, axis=0) for level in LEVELS])
    far = np.where(shot.measured[rest], np.sqrt(np.square(film).sum(axis=-1)), np.nan)
    expected = np.sqrt(np.trace(cover, axis1=2, axis2=3))
    name, time = shot.name or "film", shot.time[rest] - shot.time[n - 1]
    return PredictedShot(name, time, middle, far, expected, inside, distance)
