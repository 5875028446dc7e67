"""A track: the position of one ball in each frame of a film."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
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
