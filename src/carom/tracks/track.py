"""A track: where one ball was, frame by frame."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

__all__ = ["Track"]

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Track:
    """One ball's places in time, SI. A sample that is missing is NaN."""

    name: str
    time: Array
    """(n,) s."""
    position: Array
    """(n, 2) or (n, 3) m; the second axis points up (seen from the side) or to the left of the first (from above)."""
    angle: Array | None = None
    """(n,) rad, counter-clockwise, of a mark on the ball; whole turns are not told apart."""
    spin: Array | None = None
    """(n,) rad/s, counter-clockwise, where the program measured it."""
    group: str = ""
    """Tracks of one group were filmed together: their balls can meet."""
    notes: tuple[str, ...] = ()
    """What was assumed and left out, for people."""
    moving_only: bool = field(default=False)
    """Whether frames in which the ball lay still may be left out."""

    def __len__(self) -> int:
        """The number of samples."""
        return len(self.time)

    @property
    def seen(self) -> NDArray[np.bool_]:
        """(n,): where the ball was found."""
        return np.isfinite(self.time) & np.isfinite(self.position).all(axis=1)

    def pick(self, which: NDArray[np.bool_] | NDArray[np.intp]) -> Track:
        """Only those samples."""
        return replace(
            self,
            time=self.time[which],
            position=self.position[which],
            angle=None if self.angle is None else self.angle[which],
            spin=None if self.spin is None else self.spin[which],
        )
