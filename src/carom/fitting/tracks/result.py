"""Result of one law fitted to whole tracks."""

from __future__ import annotations

import functools
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.fitting.evidence import UNLIKELY, akaike
from carom.fitting.laws import FittedLaw
from carom.fitting.result import Estimate, common_dict
from carom.fitting.tracks.model import TrackModel
from carom.fitting.tracks.objective import SIDESPIN, SegmentArrays, Starts, spin_loss
from carom.formatting import json_value
from carom.scene.scene import Scene
from carom.simulation.simulate import simulate
from carom.simulation.trajectory import Trajectory

__all__ = ["TrackFit"]

Array = NDArray[np.float64]
MAX_SCATTER = (
    1.3  # largest ratio of scatter to estimated noise, in the median segment, for a law that follows the frames
)


@dataclass(frozen=True, eq=False)
class TrackFit:
    """A law fitted to whole tracks; made by :func:`carom.fitting.tracks.fit_tracks`, with an example there."""

    model: TrackModel
    frames: SegmentArrays
    starts: Starts
    q: Array
    """(N, 7): the starts (carom.fitting.tracks.objective.START), but with the sidespin at the first contact."""
    numbers: dict[str, float]
    """The shared parameters that were fitted."""
    estimates: dict[str, Estimate]
    covariance: Array
    """(P, P) of those parameters; NaN where they are not identifiable."""
    gap: Array
    """(N, T, 2) m: simulated less tracked, NaN where there is no frame."""
    chi2: float
    """chi^2 of all frames, and of the prior of the starts."""
    k: float
    """Effective number of fitted parameters; of a start's parameter with a prior, the share determined by the frames."""
    dof: float
    noise: float
    """Standard deviation of one coordinate, m: as given, or as estimated by :mod:`carom.tracks` away from contacts."""
    known: bool
    """Whether the noise was given."""
    degenerate: tuple[str, ...] = ()
    """Sentences on parameters that are not identifiable from these tracks."""
    untold: tuple[str, ...] = ()
    """The parameters concerned."""
    design_effect: float = 1.0
    """Variance of the parameters over that for independent frames, by the scatter of shots; 1 where the law follows the frames."""

    @property
    def law(self) -> FittedLaw:
        """The law."""
        return self.model.law

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the fitted parameters."""
        return tuple(self.model.free)

    @property
    def count(self) -> int:
        """Measured numbers."""
        return int(2 * self.frames.count.sum())

    @property
    def scatter(self) -> Array:
        """(N,) m, of one coordinate: root mean square residual of each segment."""
        return np.asarray(np.sqrt(np.nanmean(self.gap**2, axis=(1, 2))))

    @property
    def deviance(self) -> float:
        """-2 log likelihood, up to a constant that is the same for all laws."""
        return self.chi2 if self.known else self.chi2 + 4 * float((self.frames.count * np.log(self.frames.sigma)).sum())

    @property
    def aicc(self) -> float:
        """chi^2 + 2 k with known noise; else Akaike's criterion for few data (Hurvich & Tsai 1989), with the scatters counted."""
        if self.known:
            return self.deviance + 2 * self.k
        return akaike(self.deviance, self.k + len(self.q), self.count)

    @property
    def follows(self) -> bool:
        """Whether the law follows the frames to within their noise."""
        if self.known:
            from scipy.stats import chi2 as distribution

            return bool(distribution.sf(self.chi2, max(self.dof, 1)) > UNLIKELY)
        return bool(np.median(self.scatter) < MAX_SCATTER * self.noise)

    def rms(self, which: Sequence[int] | NDArray[np.int64] | None = None) -> float:
        """Return the root mean square distance between tracked and simulated positions, m; of some segments."""
        gap = self.gap if which is None else self.gap[np.asarray(which)]
        return float(np.sqrt(np.nansum(gap * gap) / max(int(np.isfinite(gap[:, :, 0]).sum()), 1)))

    @property
    def median_rms(self) -> float:
        """Median over the segments of the root mean square distance, m."""
        return float(np.median([self.rms([n]) for n in range(len(self.q))]))

    def start(self, n: int) -> Array:
        """Return the start (7,) of a segment (carom.fitting.tracks.objective.START)."""
        start: Array = self.q[n].copy()
        loss = spin_loss(self.model.table(self.numbers).arrays) * self.frames.segments[n].contacts[0]
        start[SIDESPIN] += np.sign(start[SIDESPIN]) * loss
        return start

    def simulate(self, n: int) -> Trajectory:
        """Return the simulated run of a segment."""
        x, y, vx, vy, ux, uy, spin_z = self.start(n).tolist()
        a = self.model.setting.radius
        scene = self._table
        run = scene.run.model_copy(update={"duration": float(self.frames.time[n, self.frames.count[n] - 1])})
        moved = {"position": (x, y, a), "velocity": (vx, vy, 0.0), "spin": ((uy - vy) / a, (vx - ux) / a, spin_z)}
        return simulate(scene.model_copy(update={"run": run, "balls": (scene.balls[0].model_copy(update=moved),)}))

    @functools.cached_property
    def _table(self) -> Scene:
        """The scene of all segments, without its end."""
        return self.model.scene(self.numbers)

    def as_dict(self) -> dict[str, Any]:
        """Return the fit for JSON."""
        return common_dict(self) | {
            "numbers_adjusted": self.k,
            "rms": self.rms(),
            "median_rms": self.median_rms,
            "held": json_value(self.model.held),
        }
