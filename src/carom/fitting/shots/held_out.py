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
from carom.fitting.shots.result import ShotsFit
from carom.fitting.shots.search import SearchSettings, ShotStart, error_of_frames, refined, search_start, soft
from carom.fitting.shots.start import distances, places_of, residuals
from carom.fitting.shots.table import TableNumbers

__all__ = ["HeldOut", "PredictedShot", "predict_rest"]

Array = NDArray[np.float64]
LEVELS = (0.68, 0.95)
FEWEST_DRAWS = 20
KEPT = 0.999  # of the draws' own probability: draws that the first part excludes are left out


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
    fit: ShotsFit, share: float = 1 / 3, films: Sequence[FilmedShot] | None = None, *, draws: int = 200, seed: int = 0
) -> HeldOut:
    """Predict the rest of shots from their first parts, with the numbers of the table of a fit.

    The start of each shot, and by how much its table differs, are searched for in the first part alone. The region is that of
    draws from what this part leaves open: its frames count by how far their residuals are correlated.

    Parameters
    ----------
    fit : ShotsFit
    share : float
        Of a shot's time, 0 to 1: the part that is fitted.
    films : sequence of FilmedShot, optional
        Shots of the same table; default: those of the fit. Others, that were not fitted, test the table's numbers as well.
    draws, seed : int

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
    table = fit.table
    every = [one.film for one in fit.shots] if films is None else list(films)
    found = [_predicted(fit, table, one, share, draws, np.random.default_rng([seed, i])) for i, one in enumerate(every)]
    return HeldOut(share, tuple(one for one in found if one is not None))


def _predicted(
    fit: ShotsFit, table: TableNumbers, shot: FilmedShot, share: float, draws: int, rng: np.random.Generator
) -> PredictedShot | None:
    first = until_time(shot, share)
    n = len(first.time)
    if n >= len(shot.time):
        return None
    start = search_start(table, first, fit.noise, rng, SearchSettings(), widths=fit.widths)
    best = refined(table, start, n, 30, 3)
    # a frame says less than its residual: it is correlated with its neighbours, and a start bends to whatever the laws lack
    sigma = error_of_frames(table, start, best.start, n, _follows_to(fit))
    best = refined(table, start, n, 30, 3, sigma, best.start)
    tried = np.concatenate([best.start[None], _drawn(table, start, best.start, sigma, n, draws, rng)])
    places = places_of(table, shot, tried)
    places = (
        places[np.isfinite(places).all(axis=(1, 2, 3))] if np.isfinite(places).all(axis=(1, 2, 3)).any() else places
    )
    rest = slice(n, None)
    x = shot.position[rest]
    middle = np.nanmedian(places[:, rest], axis=0)
    away = places[:, rest] - middle
    cover = np.einsum("ntbi,ntbj->tbij", away, away) / len(away) + fit.noise**2 * np.eye(2)
    inverse = np.linalg.inv(cover)
    film = x - middle
    of_draws = np.einsum("ntbi,tbij,ntbj->ntb", away, inverse, away)
    of_film = np.einsum("tbi,tbij,tbj->tb", film, inverse, film)
    with np.errstate(invalid="ignore"):
        inside = np.array([of_film <= np.quantile(of_draws, level, axis=0) for level in LEVELS])
    far = np.where(shot.measured[rest], np.sqrt(np.square(film).sum(axis=-1)), np.nan)
    expected = np.sqrt(np.trace(cover, axis1=2, axis2=3))
    fitted = float(np.sqrt(distances(table, first, best.start[None], n).mean()))
    name, time = shot.name or "film", shot.time[rest] - shot.time[n - 1]
    return PredictedShot(name, time, middle, far, expected, inside, fitted)


def _follows_to(fit: ShotsFit) -> float:
    """Return the distance (m) to which the laws follow shots through one cushion."""
    found = fit.median("cushion 1")
    return found if np.isfinite(found) else 0.0


def _drawn(
    table: TableNumbers, start: ShotStart, best: Array, sigma: float, frames: int, count: int, rng: np.random.Generator
) -> Array:
    """Return draws (N, K) of starts from what the first frames leave open."""
    from scipy.stats import chi2

    at = residuals(table, start.shot, best, frames)
    _gap, (jac,) = soft(at.gap, [at.by_start], sigma)
    rows = start.prior.rows
    information = jac.T @ jac + rows.T @ rows
    unit = 1 / np.sqrt(np.diag(information))
    value, vector = np.linalg.eigh(information * unit[:, None] * unit)
    root = (unit[:, None] * vector) / np.sqrt(np.maximum(value, 1e-12))
    tried = best + rng.normal(size=(count, len(best))) @ root.T

    def cost(some: Array) -> Array:
        z = distances(table, start.shot, some, frames) / (3 * sigma) ** 2
        unlikely = np.square((some - start.prior.center) @ rows.T).sum(axis=1)
        return np.asarray(18 * (np.sqrt(1 + z) - 1).sum(axis=1) + unlikely)

    rise = cost(tried) - cost(best[None])[0]
    good = rise < chi2.ppf(KEPT, len(best))
    return np.asarray(tried[good] if good.sum() >= FEWEST_DRAWS else tried[np.argsort(rise)[:FEWEST_DRAWS]])
