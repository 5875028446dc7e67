"""Spin of a ball from the marks on it: the rotation that carries the pattern of a frame into those of the next frames.

The disc is seen as the half of a sphere. What the light does is taken out by a polynomial through the median of all frames; one
angular velocity per flight then has to carry the pattern of each frame into the pattern 1, 2, 4 and 8 frames later.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.errors import CaromError, Fault
from carom.tracks.video.reading import Array, TrackedFilm, crops
from carom.tracks.video.scale import FIELD, flights_of

MOST_TURN = 1.2  # rad from frame to frame: more leaves too little in view of both
LIMIT, GRID = 0.92, (25, 97)  # radii of the disc that are used; rows of its picture
POINTS, LEAST_OVERLAP = 500, 0.3  # of the visible cap, and the share of them that both frames have to show
COARSE = 0.22  # rad, step of the search
PAIRS = 5  # of frames, in the search
LAGS = (1, 2, 4, 8)
SURE, AHEAD = 0.7, 0.08  # correlation of the rotation that fits, and how far behind others have to be
PEAKS = 4  # of the search, that are compared in detail
APART = 0.5  # rad, of another rotation
BLUR = 0.6  # radii of way in an exposure, from which marks are smeared
FAINT, STILL = 0.06, 0.3  # contrast of marks; rad by which a pattern has to turn in a flight, to be none of the light
DEGREE = 4  # of the polynomial of the light
STANDING = 0.85  # correlation of a pattern with itself half a flight later
H = 0.02  # rad, of slopes
Pairs = list[tuple[int, int, float]]  # frame, later frame, seconds between
Terms = list[tuple[int, int, Array, Array]]  # frame, later frame; score and information of the spin


class FlightSpin(NamedTuple):
    """The spin of a ball between two contacts: x to the right, y up in the picture, z to the viewer (counter-clockwise)."""

    first: int
    """Frames from ``first`` to ``last``, both within."""
    last: int
    spin: Array
    """(3,) rad/s; NaN where it is not known."""
    error: Array
    """(3,) rad/s, standard errors."""
    candidates: tuple[Array, ...] = ()
    """Spins (3,) rad/s that the marks leave open, where the ball turns too far from frame to frame."""
    why: str = ""
    """Why there is no number."""


def flight_spins(film: TrackedFilm, ball: str) -> list[FlightSpin]:
    """Return the spin of each flight of a ball.

    That a ball is seen from other sides as it passes is part of the errors of x and y; z, about the line of sight, has none of it.
    """
    place = film.places[ball]
    way = np.hypot(*np.nan_to_num(film.velocity_px[ball]).T) * film.exposure
    good = np.isfinite(place).all(axis=1) & ~film.flagged
    pattern = _Pattern(film, ball, np.flatnonzero(good & (way < BLUR * film.radius_px)))
    return [_of_flight(film, pattern, ball, first, last) for first, *_rest, last in flights_of(film.times, place, good)]


def with_spins(film: TrackedFilm) -> TrackedFilm:
    """Return a film whose tracks have the spin about the line of sight, where marks on the balls show it; notes say more."""
    tracks, notes = [], list(film.notes)
    for track in film.tracks:
        assert track.frame is not None
        spin, sigma = np.full((2, len(film.times)), np.nan)
        for one in flight_spins(film, track.name):
            said = one.why
            if not said:
                rows = slice(one.first, one.last + 1)
                spin[rows], sigma[rows] = one.spin[2], one.error[2]
                x, y = (f"{w:.3g} ± {e:.2g}" for w, e in zip(one.spin[:2], one.error[:2], strict=True))
                said = f"about the axes of the picture {x} (right) and {y} (up) rad/s"
            notes.append(f"{track.name}, spin from {film.times[one.first]:.3f} to {film.times[one.last]:.3f} s: {said}")
        seen = track.frame.astype(int)
        tracks.append(replace(track, spin=spin[seen], sigma_spin=sigma[seen]))
    return replace(film, tracks=tuple(tracks), notes=tuple(notes))


class _Pattern:
    """What is painted on the ball: of each frame a picture of the disc without the light, and its values at points of the cap."""

    def __init__(self, film: TrackedFilm, ball: str, frames: NDArray[np.intp]) -> None:
        from scipy.ndimage import gaussian_filter, map_coordinates

        self.map = map_coordinates
        size = int(np.clip(2 * math.ceil(1.2 * film.radius_px) + 1, *GRID))
        axis = np.linspace(-LIMIT, LIMIT, size)
        u, v = np.meshgrid(axis, -axis)
        inside = np.hypot(u, v) < LIMIT
        parts: dict[int, Array] = {}
        for crop in crops(film, ball, frames.tolist()):
            x, y = film.places[ball][crop.frame] - crop.corner
            at = np.stack([y - film.radius_px * v, x + film.radius_px * u])
            if (at.min(axis=(1, 2)) > 0).all() and (at.max(axis=(1, 2)) < np.array(crop.pixels.shape[:2]) - 1).all():
                parts[crop.frame] = np.stack(
                    [map_coordinates(one, at, order=1) for one in crop.pixels.astype(float).T.swapaxes(1, 2)]
                )
        if len(parts) < 2:
            raise CaromError(Fault("spin", ball, "two frames in which the ball is whole", f"{len(parts)}"))
        raw = np.stack(list(parts.values()))  # (n, 3, size, size)
        light, shine = _light(np.median(raw, axis=0), u, v, inside)
        self.mask = inside & ~shine
        painted = np.where(self.mask, raw / light - 1, 0.0)
        # (the direction in the space of colours along which the marks differ most)
        flat = painted[:, :, self.mask].swapaxes(0, 1).reshape(3, -1)
        flat = flat - flat.mean(axis=1, keepdims=True)
        colour = np.linalg.eigh(flat @ flat.T)[1][:, -1]
        self.contrast = float(np.sqrt(np.square(colour @ flat).mean()))
        pictures = np.einsum("c,nchw->nhw", colour, painted)
        pictures -= pictures[:, self.mask].mean(axis=1)[:, None, None] * self.mask
        self.pictures = dict(zip(parts, pictures, strict=True))
        smooth = 0.5 * COARSE * size / (2 * LIMIT)
        weight = np.maximum(gaussian_filter(self.mask.astype(float), smooth), 1e-6)
        self.smooth = {k: gaussian_filter(one, smooth) / weight for k, one in self.pictures.items()}
        k = np.arange(POINTS) + 0.5
        z = 1 - (1 - math.sqrt(1 - LIMIT**2)) * k / POINTS
        turn = math.pi * (1 + math.sqrt(5)) * k
        self.points = np.stack([np.sqrt(1 - z**2) * np.cos(turn), np.sqrt(1 - z**2) * np.sin(turn), z], axis=1)
        self.size, self.least = size, math.sqrt(1 - LIMIT**2)
        self.whole = self.mask.astype(float)
        self.seen = self._at(self.whole, self.points) > 0.99

    def _at(self, picture: Array, directions: Array) -> Array:
        half = (self.size - 1) / 2
        return np.asarray(
            self.map(picture, np.stack([half - directions[:, 1] / LIMIT * half, half + directions[:, 0] / LIMIT * half]), order=1)
        )  # fmt: skip

    def compare(self, i: int, j: int, turn: Array) -> tuple[Array, Array, Array] | None:
        """Return the values (n,) of the points that frames i and j both show, and where j has them (n, 3); None if they are few."""
        moved = self.points @ turn.T
        both = self.seen & (moved[:, 2] > self.least)
        both[both] = self._at(self.whole, moved[both]) > 0.99
        if both.sum() < LEAST_OVERLAP * POINTS:
            return None
        a, b = self._at(self.pictures[i], self.points[both]), self._at(self.pictures[j], moved[both])
        return a - a.mean(), b - b.mean(), moved[both]

    def correlation(self, pairs: Pairs, spin: Array) -> float:
        """Return the correlation of the patterns over pairs, turned by a spin; 0 where none shows enough."""
        found = [one for i, j, dt in pairs if (one := self.compare(i, j, rotation(spin * dt))) is not None]
        if not found:
            return 0.0
        a, b = (np.concatenate([one[side] for one in found]) for side in (0, 1))
        return float(a @ b / max(math.sqrt(a @ a * (b @ b)), 1e-12))

    def correlations(self, pairs: Pairs, turns: Array) -> Array:
        """Return the correlations (m,) of the smoothed patterns over pairs, turned by each of the rotations (m, 3, 3)."""
        points = self.points[self.seen][::3]
        moved = turns @ points.T  # (m, 3, n)
        half = (self.size - 1) / 2
        column, row = (np.rint(half + side * half / LIMIT).astype(int) for side in (moved[:, 0], -moved[:, 1]))
        inside = (moved[:, 2] > self.least) & (row >= 0) & (row < self.size) & (column >= 0) & (column < self.size)
        row, column = np.where(inside, row, 0), np.where(inside, column, 0)
        inside &= self.mask[row, column]
        count = inside.sum(axis=1)
        sums = np.zeros((3, len(turns)))
        for i, j, _dt in pairs:
            sides = np.broadcast_arrays(self._at(self.smooth[i], points), self.smooth[j][row, column])
            both = np.where(inside, np.stack(sides), 0.0)
            a, b = np.where(inside, both - both.sum(axis=2, keepdims=True) / np.maximum(count, 1)[:, None], 0.0)
            sums += (a * b).sum(axis=1), (a * a).sum(axis=1), (b * b).sum(axis=1)
        found = sums[0] / np.sqrt(np.maximum(sums[1] * sums[2], 1e-12))
        return np.where(count < LEAST_OVERLAP * len(points), -1.0, found)


def _light(median: Array, u: Array, v: Array, inside: NDArray[np.bool_]) -> tuple[Array, NDArray[np.bool_]]:
    """Return the light (3, h, w), a polynomial through the median picture, and where there is a highlight."""
    basis = np.stack([u**a * v**b for a in range(DEGREE + 1) for b in range(DEGREE + 1 - a)], axis=-1)
    light, keep = np.ones_like(median), inside.copy()
    for _ in range(4):
        for c in range(3):
            light[c] = basis @ np.linalg.lstsq(basis[keep], median[c][keep], rcond=None)[0]
        light = np.maximum(light, 4.0)
        off = (median / light - 1).mean(axis=0)
        keep = inside & (np.abs(off) < 2.5 * 1.48 * max(float(np.median(np.abs(off[inside]))), 0.01))
    return light, off > 0.15


def rotation(turn: Array) -> Array:
    """Return the matrices (..., 3, 3) of rotation vectors (..., 3), rad.

    Examples
    --------
    >>> import numpy as np
    >>> rotation(np.array([0, 0, np.pi / 2])).round(12) @ [1, 0, 0]
    array([0., 1., 0.])
    """
    from scipy.spatial.transform import Rotation

    return np.asarray(Rotation.from_rotvec(turn).as_matrix())


@functools.cache
def _rotations() -> tuple[Array, Array]:
    """Return rotation vectors (m, 3) of up to half a turn, and their matrices (m, 3, 3)."""
    axis = np.arange(-math.pi, math.pi + COARSE, COARSE)
    grid = np.stack(np.meshgrid(axis, axis, axis), axis=-1).reshape(-1, 3)
    grid = grid[np.linalg.norm(grid, axis=1) <= math.pi]
    return grid, rotation(grid)


def _searched(pattern: _Pattern, pairs: Pairs) -> Array | None:
    """Return the spin (3,) of up to half a turn from the first to the second frames that fits best; None if others fit as well."""
    if len(pairs) < 2:
        return None
    pairs = [pairs[k] for k in np.unique(np.linspace(0, len(pairs) - 1, PAIRS).astype(int))]
    grid, turns = _rotations()
    scores, left, found = pattern.correlations(pairs, turns), np.ones(len(grid), bool), []
    usual = float(np.median([dt for _i, _j, dt in pairs]))
    for _ in range(PEAKS):
        top = int(np.argmax(np.where(left, scores, -2.0)))
        spin = _refined(pattern, grid[top] / usual, pairs)[0]
        found.append((pattern.correlation(pairs, spin), spin))
        # (the angle of the rotation from one to the other, as half a turn has two vectors)
        left &= np.einsum("mij,ij->m", turns, turns[top]) < 1 + 2 * math.cos(APART)
    (best, spin), (second, other), *_rest = sorted(found, key=lambda one: -one[0])
    same = np.trace(rotation(spin * usual) @ rotation(other * usual).T) > 1 + 2 * math.cos(APART)
    return spin if best > max(SURE, 0.0 if same else second + AHEAD) else None


def _of_flight(film: TrackedFilm, pattern: _Pattern, ball: str, first: int, last: int) -> FlightSpin:
    """Return the spin of a flight, or why it is not known, with the spins that remain."""
    t, frames = film.times, [k for k in pattern.pictures if first <= k <= last]

    def pairs(lag: int) -> Pairs:
        return [
            (i, i + lag, float(t[i + lag] - t[i])) for i in frames if i + lag in pattern.pictures and i + lag <= last
        ]

    def unknown(why: str, candidates: Sequence[Array] = ()) -> FlightSpin:
        return FlightSpin(first, last, np.full(3, np.nan), np.full(3, np.nan), tuple(candidates), why)

    if len(frames) < 4 or len(pairs(1)) < 2:
        return unknown("too few frames show the ball sharp and whole")
    if pattern.contrast < FAINT:
        return unknown("no mark is seen on the ball")
    spin, error = np.zeros(3), np.zeros(3)
    if not all(pattern.correlation(pairs(lag), spin) > STANDING for lag in (2, len(frames) // 2)):
        found = _searched(pattern, pairs(1))
        step = float(np.median([dt for _i, _j, dt in pairs(1)]))
        if found is not None and np.linalg.norm(found) * step <= MOST_TURN:
            spin = found
            for most in LAGS:
                spin, terms = _refined(pattern, spin, [pair for lag in LAGS if lag <= most for pair in pairs(lag)])
            error = _error(spin, terms, frames)
        if not (np.linalg.norm(spin) > 0 and pattern.correlation(pairs(1) + pairs(2), spin) > SURE):
            return unknown(*_too_fast(pattern, [pairs(lag) for lag in range(1, 9)], step))
    if not np.linalg.norm(spin) * (t[frames[-1]] - t[frames[0]]) > STILL:
        return unknown("what is seen on the ball does not turn with it: it hardly spins, or has no mark")
    speed = float(np.nanmean(np.hypot(*film.velocity_px[ball][first : last + 1].T)))
    apparent = np.array([1.0, 1.0, 0.0]) * speed / (FIELD * max(film.background.shape[:2]))
    return FlightSpin(first, last, spin, np.hypot(error, apparent))


def _refined(pattern: _Pattern, spin: Array, pairs: Pairs) -> tuple[Array, Terms]:
    """Return the spin of least squares of the differences of the patterns (Gauss-Newton), and score and information by pair."""
    terms: Terms = []
    sides = [(rotation(H * axis), rotation(-H * axis)) for axis in np.eye(3)]
    most = 0.3 / max(dt for _i, _j, dt in pairs)
    for _ in range(10):
        terms = []
        for i, j, dt in pairs:
            found = pattern.compare(i, j, rotation(spin * dt))
            if found is None:
                continue
            a, b, moved = found
            there = [[pattern._at(pattern.pictures[j], moved @ one.T) for one in both] for both in sides]
            slope = np.stack([(more - less) / (2 * H) * dt for more, less in there], axis=1)
            slope -= slope.mean(axis=0)
            size = max(math.sqrt(a @ a * (b @ b)), 1e-12)
            terms.append((i, j, slope.T @ (a - b) / size, slope.T @ slope / size))
        if not terms:
            break
        change = _step(terms)
        change *= min(1.0, most / max(float(np.linalg.norm(change)), 1e-12))
        spin = spin + change
        if np.linalg.norm(change) < 1e-3 * most:
            break
    return spin, terms


def _step(terms: Terms) -> Array:
    return np.asarray(np.linalg.lstsq(sum(one[3] for one in terms), sum(one[2] for one in terms), rcond=1e-6)[0])


def _error(spin: Array, terms: Terms, frames: list[int]) -> Array:
    """Return the standard errors (3,): by leaving out one frame after the other, and 1.5 % for radius, centre and light."""
    left = ([term for term in terms if frame not in term[:2]] for frame in frames)
    moves = [_step(rest) for rest in left if len(rest) > 1]
    if len(moves) < 3:
        return np.full(3, np.nan)
    gap = np.array(moves) - np.mean(moves, axis=0)
    return np.asarray(
        np.hypot(np.sqrt((len(moves) - 1) / len(moves) * np.square(gap).sum(axis=0)), 0.015 * np.linalg.norm(spin))
    )


def _too_fast(pattern: _Pattern, later: Sequence[Pairs], step: float) -> tuple[str, list[Array]]:
    """Return why there is no number, and the spins that carry a pattern into one some frames later, with whole turns between."""
    for pairs in later:
        spin = _searched(pattern, pairs)
        if spin is None or not spin.any():
            continue
        dt = float(np.median([one[2] for one in pairs]))
        more = 2 * math.pi / (float(np.linalg.norm(spin)) * dt)
        spins = [spin * (1 + more * k) for k in range(-len(later), len(later) + 1)]
        found = [one for one in spins if MOST_TURN < np.linalg.norm(one) * step < 2 * math.pi]
        found.sort(key=lambda one: float(np.linalg.norm(one)))
        rates = " or ".join(f"{np.linalg.norm(one):.4g}" for one in found)
        need = math.ceil(float(np.linalg.norm(found[-1])) / MOST_TURN / 10) * 10
        return (
            f"the ball turns by more than {MOST_TURN} rad from frame to frame: its spin is {rates} rad/s; film at {need} frames"
            " per second or more"
        ), found
    return (
        "marks of neighbouring frames do not match: they are smeared or turn out of view; film at more frames per second",
        [],
    )
