"""How small displacements of the balls grow along a run: finite-time Lyapunov exponents, and how far a run can be predicted."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.core.motion.phases import FLIGHT
from carom.errors import CaromError
from carom.formatting import format_number
from carom.simulation.sensitivity.follow import follow_to_graze
from carom.simulation.sensitivity.parameters import ARRAYS, Parameters
from carom.simulation.sensitivity.seeds import Column
from carom.simulation.setup import SceneArrays

__all__ = ["DisplacementGrowth", "lyapunov"]

Array = NDArray[np.float64]
TIMES = 401  # besides the instants after events


@dataclass(frozen=True, eq=False)
class DisplacementGrowth:
    """Growth of small displacements; made by :meth:`carom.Trajectory.lyapunov`."""

    t: Array
    """Times (N,), s: to the end of the run, or to the first event at which no derivative exists."""
    stretch: Array
    """(N,): length of the displacements of all balls at t, over that at the start, for the displacement that grows most."""

    @property
    def exponent(self) -> float:
        """Finite-time Lyapunov exponent, 1/s: ln(stretch) / t at the end."""
        return math.log(self.stretch[-1]) / float(self.t[-1]) if self.t[-1] > 0 else 0.0

    def horizon(self, error: float, size: float) -> float:
        """Return the time at which an error of the places at the start (m) may have grown to a size (m); infinite if it does not.

        To first order: as long as the sequence of events stays the same.
        """
        for name, value in (("error", error), ("size", size)):
            if not (isinstance(value, int | float | np.number) and 0 < value < math.inf):
                raise CaromError(f"horizon: {name}: expected a length > 0 in m, got {value!r:.60}")
        beyond = np.flatnonzero(error * self.stretch >= size)
        return float(self.t[beyond[0]]) if len(beyond) else math.inf

    def __repr__(self) -> str:
        """One line."""
        grown, end = format_number(float(self.stretch[-1])), format_number(float(self.t[-1]))
        return f"<DisplacementGrowth: displacements grow {grown} times in {end} s, exponent {format_number(self.exponent)}/s>"


class _Displacements(Parameters):
    """The places of all balls, each by itself, without regard to whether a scene lets them be there."""

    def __init__(self, arrays: SceneArrays, phases: list[int]) -> None:
        columns, slopes = [], []
        for i, phase in enumerate(phases):
            for k in range(3 if phase == FLIGHT else 2):
                made = {
                    name: {
                        field: np.zeros(getattr(arrays, name)[field].shape)
                        for field in getattr(arrays, name).dtype.names
                        if getattr(arrays, name).dtype[field].base.kind == "f"
                    }
                    for name in ARRAYS
                }
                made["balls"]["x"][i, k] = 1.0
                columns.append(
                    Column(f"balls.{i}.position.{'xyz'[k]}", f"balls.{i}.position", k, (tuple(arrays.balls["x"][i]),))
                )
                slopes.append(made)
        super().__init__(arrays, tuple(f"balls.{i}.position" for i in range(len(phases))), columns, slopes)


def lyapunov(run: Any) -> DisplacementGrowth:
    """Compute the growth of small displacements of all balls along a run (:meth:`carom.Trajectory.lyapunov`).

    It ends before the first event at which no derivative exists, a graze, if there is one.
    """
    scene, log = run.scene, run.log
    displacements, end = _Displacements(run.arrays, log["phase"][: len(scene.balls)].tolist()), run.end
    passages, graze = follow_to_graze(scene, displacements, log, end)
    if graze >= 0:
        end = float(np.nextafter(log["t"][graze], 0.0))
        log = log[:graze]
        passages, _none = follow_to_graze(scene, displacements, log, end)
    events = np.unique(log["t"])
    t = np.unique(np.concatenate([np.linspace(0.0, end, TIMES), events[events <= end]]))
    stretch = np.array([float(np.linalg.norm(_matrix(passages.at(float(one))[0]), 2)) for one in t])
    return DisplacementGrowth(t, stretch)


def _matrix(positions: Array) -> Array:
    """Return derivatives (B, 3, p) as a matrix (3 B, p)."""
    return positions.reshape(-1, positions.shape[-1])
