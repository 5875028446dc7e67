"""The content of a run that its readers are handed: for tables, files, figures and words."""

from __future__ import annotations

from typing import Any, Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.bodies import Numbers, State
from carom.scene.scene import Scene

__all__ = ["EventSource", "RunRecord"]


class EventSource(Protocol):
    """Source of a table of events: :class:`carom.Trajectory` and :class:`carom.ManyRuns` are such sources."""

    @property
    def scene(self) -> Scene:
        """Return the scene."""
        ...

    def kinetic_energy(self, ball: Any, velocity: NDArray[np.float64], spin: NDArray[np.float64]) -> Numbers:
        """Return kinetic energies (N,), J, of balls given by number (N,) at velocities and spins (N, 3)."""
        ...


class RunRecord(EventSource, Protocol):
    """Content of a run for tables and files; :class:`carom.Trajectory` offers it."""

    log: NDArray[np.void]
    end: float
    ended: str

    @property
    def final(self) -> State:
        """Return the final states (B, 3)."""
        ...

    def at(self, t: ArrayLike) -> State:
        """Return states (..., B, 3) at times (...)."""
        ...

    def phase(self, t: ArrayLike) -> NDArray[np.str_]:
        """Return the names of phases (..., B)."""
        ...

    def orientation(self, t: ArrayLike) -> NDArray[np.float64]:
        """Return unit quaternions (..., B, 4)."""
        ...

    def energy(self, t: ArrayLike, *, each: bool = False) -> Numbers:
        """Return energies (...), or (..., B) of each ball, J."""
        ...
