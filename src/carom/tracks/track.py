"""A track: the position of one ball in each frame of a film."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.polynomial import polynomial
from numpy.typing import NDArray

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

    def at(self, t: float) -> Array:
        """Return the place (3,) in the last frame until a time."""
        return np.asarray(self.x[max(int(np.searchsorted(self.t, t, side="right")) - 1, 0)])

    @property
    def fastest(self) -> float:
        """The largest speed in the middle of a piece, m/s."""
        return max((float(np.linalg.norm(piece.numbers[1])) for piece in self.pieces), default=0.0)
