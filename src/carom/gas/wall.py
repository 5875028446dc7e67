"""A wall of what holds a gas."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.engine.swarm_arrays import INSIDE, OVAL, PLANE
from carom.outlines import ellipse_depth

__all__ = ["Numbers", "Wall"]

Array = NDArray[np.float64]
Numbers = tuple[float, ...]


@dataclass(frozen=True)
class Wall:
    """A plane through ``centre`` with normal ``across`` into the gas, or a round wall with ``across`` 1 where it curves.

    A round wall is the surface |across (x - centre)| = reach, held within or (a scatterer) kept outside; an OVAL one the
    ellipse with half axes ``across``. ``along``, ``low``, ``high``: it is there only where low <= along . x <= high.
    ``thick``: it bounds the balls' surfaces, not their centres. ``part``: of an outline that only the whole of it tells from
    what lies behind it (:attr:`carom.gas.Container.outline`).
    """

    name: str
    form: int
    across: Numbers
    centre: Numbers
    area: float
    reach: float = 0.0
    thick: bool = True
    along: Numbers = (0.0, 0.0, 0.0)
    low: float = -math.inf
    high: float = math.inf
    part: bool = False

    @property
    def ends(self) -> bool:
        """Whether it is there only in part."""
        return any(self.along)

    @property
    def still(self) -> str:
        """Why it cannot swing, or nothing."""
        if self.form != PLANE and self.reach == 0 and self.form != OVAL:
            return "which ends at a re-entrant corner"
        if self.form != PLANE:
            return "which is round"
        return "which ends where the room goes on behind it" if self.ends else ""

    def keep(self, radius: Any) -> tuple[Any, Any]:
        """The engine's d, and how much of it is the ball's radius."""
        part = radius * (float(self.thick) * (-1.0 if self.form == INSIDE else 1.0))
        return self.reach + part, part

    def clearance(self, radius: Any, x: Array) -> Array:
        """How far balls (N,) at x (N, 3) are from touching it, less than 0 if they overlap; infinite where it is not."""
        keep = self.keep(radius)[0]
        if self.form == OVAL:
            gap: Array = ellipse_depth(self.across[0], self.across[1], x - self.centre) - keep
            return gap
        r = np.asarray(self.across) * (x - self.centre)
        if self.form == PLANE:
            gap = r.sum(axis=1) - keep
        else:
            far = np.sqrt((r * r).sum(axis=1))
            gap = (keep - far if self.form == INSIDE else far - keep) / max(self.across)
        along = x @ np.asarray(self.along)
        return np.where((along >= self.low) & (along <= self.high), gap, math.inf)
