"""A track: the position of one ball in each frame of a film."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.polynomial import polynomial
from numpy.typing import NDArray

from carom.tracks.verdicts import SIGMAS

Array = NDArray[np.float64]
SAMPLED = ("time", "position", "angle", "spin", "sigma_spin", "frame", "sigma_time")  # what a track has for each sample


@dataclass(frozen=True, eq=False)
class Track:
    """Positions of one ball in time, SI; missing samples are NaN.

    Examples
    --------
    >>> import numpy as np
    >>> from carom.tracks import Track
    >>> track = Track("ball", time=np.array([0.0, 0.01, 0.02]), position=np.array([[0, 0], [0.01, 0], [np.nan, np.nan]]))
    >>> len(track), track.seen
    (3, array([ True,  True, False]))
    """

    name: str
    time: Array
    """(n,) s."""
    position: Array
    """(n, 2) or (n, 3) m; the second axis points up (seen from the side) or to the left of the first (from above)."""
    angle: Array | None = None
    """(n,) rad, counter-clockwise, of a mark on the ball; whole turns are not distinguished."""
    spin: Array | None = None
    """(n,) rad/s, counter-clockwise, if the program measured it; the same value in several samples is one measurement."""
    sigma_spin: Array | None = None
    """(n,) rad/s, standard errors of the spin."""
    group: str = ""
    """Tracks of one group were filmed together, so that their balls can meet."""
    notes: tuple[str, ...] = ()
    """Assumptions and omissions made in reading the track."""
    moving_only: bool = field(default=False)
    """Whether frames in which the ball rested may be missing."""
    frame: Array | None = None
    """(n,) frame numbers, if the program wrote them."""
    sigma_time: Array | None = None
    """(n,) s: by how much the times are off if an error that they have in common, as of a camera's readout, is one standard
    deviation; with its sign."""
    stamped: bool = False
    """Whether the times are the frames' own, as a film's container has them: no clock is sought behind them."""

    def __len__(self) -> int:
        """The number of samples."""
        return len(self.time)

    @property
    def seen(self) -> NDArray[np.bool_]:
        """(n,): whether the ball was found."""
        return np.isfinite(self.time) & np.isfinite(self.position).all(axis=1)

    def select(self, which: NDArray[np.bool_] | NDArray[np.intp]) -> Track:
        """Return the track with only these samples, from a mask or indices."""
        parts = {name: getattr(self, name) for name in SAMPLED}
        chosen: dict[str, Any] = {name: None if part is None else part[which] for name, part in parts.items()}
        return replace(self, **chosen)


def position_noise(time: Array, position: Array, interval: float) -> float:
    """Estimate the noise of one coordinate of one frame, m, from fourth differences of the positions (n, 2).

    Contacts affect few of them, so their median is used; frames in which the ball rests are left out.
    """
    parts = []
    span = 4.5 * interval if np.isfinite(interval) else np.inf
    for x in position.T:
        if not np.nanmax(x) > np.nanmin(x):  # (a coordinate that was not measured: it is 0 throughout)
            continue
        difference = x[4:] - 4 * x[3:-1] + 6 * x[2:-2] - 4 * x[1:-3] + x[:-4]
        moves = np.abs(position[4:] - position[:-4]).max(axis=1) > 0
        good = moves & (time[4:] - time[:-4] < span) & np.isfinite(difference)
        parts.append(np.abs(difference[good]))
    sizes = np.concatenate(parts or [np.zeros(0)])
    if len(sizes) < 4:
        return 0.0
    # the median of |N(0, 1)| is 0.6745; 1 + 16 + 36 + 16 + 1 = 70
    return float(np.median(sizes) / 0.6745 / np.sqrt(70.0))


# --- a ball's rows in a table, and their smooth pieces ------------------------------------------------------------------


@dataclass(frozen=True)
class PathPiece:
    """Frames of one ball with one acceleration, beside that by the air: a parabola about the middle, and its covariance."""

    first: int
    last: int
    middle: float
    numbers: Array  # (3, 3): place, velocity, half the acceleration; by coordinate
    covariance: Array  # (3, 3)
    spins: Array | None  # (2, 3): spin, and its rate of change
    spin_error: float = 0.0  # of a component at the ends, at most
    air: Array | None = None  # (k, 3): the acceleration by the air, as a polynomial of the time after the middle
    even: bool = True  # whether what is left beside the path is noise
    hides: float = 1.0  # times the variance: more, where a weak event may be in it

    def _by_air(self, tau: float, times: int) -> Any:
        """Return what the air's acceleration gives, integrated so many times."""
        return 0.0 if self.air is None else polynomial.polyval(tau, polynomial.polyint(self.air, times))

    def place(self, t: float) -> tuple[Array, float]:
        """Return the place (3,) at a time, and the standard error of a coordinate."""
        tau = t - self.middle
        return self._part(np.array([1.0, tau, tau * tau]), tau, 2)

    def velocity(self, t: float) -> tuple[Array, float]:
        """Return the velocity (3,) at a time, and the standard error of a component."""
        tau = t - self.middle
        return self._part(np.array([0.0, 1.0, 2 * tau]), tau, 1)

    def _part(self, g: Array, tau: float, times: int) -> tuple[Array, float]:
        return g @ self.numbers + self._by_air(tau, times), math.sqrt(g @ self.covariance @ g)

    def parabola(self, t: float) -> Array:
        """Return the parabola that touches the path at a time: place, velocity, half the acceleration, by coordinate (3, 3)."""
        return np.stack([self.place(t)[0], self.velocity(t)[0], self.numbers[2] + self._by_air(t - self.middle, 0) / 2])

    def spin(self, t: float) -> Array:
        """Return the spin (3,) at a time."""
        assert self.spins is not None
        return np.array([1.0, t - self.middle]) @ self.spins

    @property
    def acceleration(self) -> tuple[Array, float]:
        """Return the acceleration (3,) beside that by the air, and the standard error of a component."""
        return 2 * self.numbers[2], 2 * math.sqrt(self.covariance[2, 2])


@dataclass(frozen=True, eq=False)
class BallRows:
    """A ball with its rows, sorted by time."""

    name: str
    t: Array  # (n,) s
    x: Array  # (n, 3) m
    w: Array | None  # (n, 3): its spins, if they are known
    radius: float
    mass: float
    air: Array | None = None  # (n, 3): what the air does to it, if it is known
    kappa: float = 0.0  # 0: not known
    pieces: tuple[PathPiece, ...] = ()
    clock: float = 0.0  # relative standard error of the interval of its frames, where times are rounded
    smooth: float = 0.0  # m: standard error of places that changes slowly, beside the noise

    def at(self, t: float) -> Array:
        """Return the place (3,) in the last frame until a time."""
        return np.asarray(self.x[max(int(np.searchsorted(self.t, t, side="right")) - 1, 0)])

    @property
    def fastest(self) -> float:
        """The largest speed in the middle of a piece, m/s."""
        return max((float(np.linalg.norm(piece.numbers[1])) for piece in self.pieces), default=0.0)


# ----------------------------------------------------------------------------------------------------
# Pieces of constant acceleration of a path, and its noise.


FEW = 4  # frames: three numbers of a parabola, and one to spare
UNEVEN = 10.0  # times the noise, squared: more is no noise
CUBIC = 5.25  # times: (12 sqrt(7))^2 / 192, by which a cubic is worse than noise at the ends
SHORT, LOOKED_AT = 6, 24  # frames of a part of a run, and ends of one that are looked at, at once
EXACT = 1e-12  # m: with less noise the numbers are a program's
SMOOTH = 5  # degree of that acceleration over a piece


def third_differences(row: BallRows) -> Array:
    """Return third differences (n - 3, 3) of places (n, 3) at any times: a parabola has none, noise as many as at even times.

    What the air's acceleration makes of them, where it is known, is taken off.
    """
    x, dt, by_air = row.x, np.diff(row.t), row.air
    a, b, c = dt[:-2], dt[1:-1], dt[2:]
    weights = np.array(
        [1 / (a * (a + b) * (a + b + c)), 1 / (a * b * (b + c)), 1 / ((a + b) * b * c), 1 / ((a + b + c) * (b + c) * c)]
    )
    # (of even times 1, 3, 3, 1)
    weights *= np.array([-1, 1, -1, 1])[:, None] * math.sqrt(20) / np.linalg.norm(weights, axis=0)
    # (relative to the first place, so that a coordinate at rest has none at all)
    found: Array = sum(weights[k][:, None] * (x[k : len(x) - 3 + k] - x[:-3]) for k in (1, 2, 3))
    if by_air is not None:  # (as Numerov has its second differences, of even times)
        found -= (b * b)[:, None] * (by_air[3:] - by_air[:-3] + 9 * (by_air[2:-1] - by_air[1:-2])) / 12
    return found


def noise_of_rows(rows: Sequence[BallRows]) -> float:
    """Estimate the noise of a coordinate from third differences, which events affect in few frames: their median is taken."""
    sizes = np.concatenate(
        [
            np.abs(third_differences(row))[np.abs(row.x[3:] - row.x[:-3]).max(axis=1) > 0].ravel()
            for row in rows
            if len(row.t) > 3
        ]
    )
    # the median of |N(0, 1)| is 0.6745; 1 + 9 + 9 + 1 = 20
    return float(np.median(sizes[sizes > 0]) / 0.6745 / math.sqrt(20)) if (sizes > 0).any() else 0.0


def hidden_by_noise(sigma: float) -> float:
    """Return how far an event may move a place, m, so that noise hides it."""
    return 6 * math.sqrt(20) * sigma + 1e-9


def path_pieces(row: BallRows, sigma: float, drag: float) -> Iterator[PathPiece]:
    """Yield pieces of constant acceleration beside that by the air: runs of frames in which third differences are noise."""
    t = row.t
    if len(t) < FEW:
        return
    calm = (np.abs(third_differences(row)) < hidden_by_noise(sigma)).all(axis=1)
    edges, runs = np.flatnonzero(np.diff(np.concatenate([[False], calm, [False]]))), list[tuple[int, int]]()
    for low, high in zip(edges[::2].tolist(), edges[1::2].tolist(), strict=True):
        first, last = low, high + 2  # window i has the frames i to i + 3
        if sigma > EXACT:  # (noise may hide an event within the last of them)
            first, last = first + 1, last - 1
        # (a bounce in the middle of four frames has no third difference, either)
        if last - first >= FEW - 1:
            runs += _parts(t, row.x, first, last, sigma, 3 * row.radius) if sigma > EXACT else [(first, last)]
    for first, last in runs:
        yield fitted_piece(row, first, last, sigma, drag)


def fitted_piece(row: BallRows, first: int, last: int, sigma: float, drag: float) -> PathPiece:
    """Return the path through some frames."""
    t, w = row.t, row.w
    middle = (t[first] + t[last]) / 2
    tau = t[first : last + 1] - middle
    design = np.stack([np.ones_like(tau), tau, tau * tau], axis=-1)
    x, by_air = row.x[first : last + 1], None if row.air is None else row.air[first : last + 1]
    numbers = np.linalg.lstsq(design, x, rcond=None)[0]
    if by_air is None and drag > 0:
        v = numbers[1] + 2 * np.multiply.outer(tau, numbers[2])
        by_air = -drag * np.linalg.norm(v, axis=1)[:, None] * v
    air = None if by_air is None else polynomial.polyfit(tau, by_air, min(SMOOTH, len(tau) - 1))
    if air is not None:
        x = x - polynomial.polyval(tau, polynomial.polyint(air, 2)).T
        numbers = np.linalg.lstsq(design, x, rcond=None)[0]
    free = 3 * max(len(tau) - 3, 1)
    misfit = float(np.square(design @ numbers - x).sum()) / free
    # (more than noise is a path that is no parabola: it does not average out, and the slope at the ends of a cubic is off by
    # 12 sqrt(7) r/T, r the rest and T the time, where noise of that size would make sqrt(192) r/T)
    uneven, even = misfit > UNEVEN * sigma**2, misfit <= sigma**2 * (1 + SIGMAS * math.sqrt(2 / free))
    even = even if sigma > EXACT else not uneven
    misfit *= CUBIC * len(tau) if uneven else 1
    # (an arc of height h makes the acceleration 8 h / T^2, noise of sigma sqrt(720 / n) sigma / T^2)
    covariance = np.linalg.inv(design.T @ design) * max(sigma**2, misfit, row.smooth**2 * len(tau) * 64 / 720)
    turns = w is not None and bool(np.isfinite(w[first : last + 1]).all())
    spins = None if w is None or not turns else np.linalg.lstsq(design[:, :2], w[first : last + 1], rcond=None)[0]
    error = 0.0
    if spins is not None and w is not None:
        left = float(np.square(design[:, :2] @ spins - w[first : last + 1]).sum(axis=0).max())
        # (noise averages out, a spin that changes unevenly does not: the ends of its line are off by twice the rest)
        error = 2 * math.sqrt(left / max(len(tau) - 2, 1))
    hides = 1.0 if even or uneven else CUBIC * len(tau)
    return PathPiece(first, last, float(middle), numbers, covariance, spins, error, air, even, hides)


def _parts(t: Array, x: Array, first: int, last: int, sigma: float, high: float) -> list[tuple[int, int]]:
    """Return the first and last frames of flights in a run, at events that are too weak for third differences.

    Two parabolas are nearer than one, and than a smooth path of as many numbers; both rise to a height.
    """
    if last - first < 3 * SHORT:
        return [(first, last)]

    def left(begin: int, end: int, degree: int = 2) -> float:
        tau = (t[begin:end] - t[begin]) / (t[end - 1] - t[begin])
        powers, places = np.vander(tau, degree + 1), x[begin:end] - x[begin]
        return float(np.square(powers @ np.linalg.lstsq(powers, places, rcond=None)[0] - places).sum())

    one, smooth = (left(first, last + 1, degree) for degree in (2, 5))
    two, at, low, most = math.inf, first, first + SHORT, last - SHORT
    while most > low and min(one, smooth) > 3 * (last - first) * sigma**2:
        step = max((most - low) // LOOKED_AT, 1)
        found = [(left(first, k) + left(k, last + 1), k) for k in range(low, most + 1, step)]
        two, at = min(found)
        if step == 1:
            break
        low, most = max(at - step, low), min(at + step, most)
    weak = min(one, smooth) - two < SIGMAS**2 * max(sigma**2, two / (3 * (last - first)))
    if weak or min(x[first:at, 2].max(), x[at : last + 1, 2].max()) < high:
        return [(first, last)]
    return _parts(t, x, first, at - 2, sigma, high) + _parts(t, x, at + 1, last, sigma, high)
