"""What an orbit is: its bounces, and their coordinates on the boundary and in the velocity's phase disc."""

from __future__ import annotations

import functools
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.orbits.arrays import ENDS
from carom.orbits.setup import Setup, Start

__all__ = ["Orbit"]

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Orbit:
    """One orbit or many: arrays (..., B) of its bounces, each with the state just after it.

    Where an orbit ended before B bounces (``count`` says after how many, ``ended`` why) the rest is NaN. In a periodic cell
    positions go on through the cells; ``folded`` has them in the first.
    """

    setup: Setup
    start: Start
    t: Array
    """(..., B): time of each bounce, s."""
    position: Array
    """(..., B, d): the centre, m."""
    velocity: Array
    """(..., B, d): m/s."""
    spin: Array
    """(..., B) in the plane, (..., B, 3) in space: rad/s."""
    piece: NDArray[np.int32]
    """(..., B): which piece of the table was met; -1 where none was."""
    count: Any
    """(...): how many bounces there were."""
    ending: Any
    """(...): how it ended, as a number: an index into :data:`carom.orbits.ENDS`."""
    last: Array
    """(..., 10): time, position, velocity and spin at the end, each with three components."""

    def __repr__(self) -> str:
        """One line: the table, the law, how many bounces."""
        many = f"{np.size(self.count):,} orbits, " if np.ndim(self.count) else ""
        return f"<Orbit: {self.setup.table}: {self.setup.law}, {many}{int(np.sum(self.count)):,} bounces>"

    @property
    def ended(self) -> Any:
        """(...): "bounces" (it made all), "escaped" (nothing lies ahead), "corner", "grazed" (it moves along the wall),

        or "free" (it flew through a million cells and met nothing).
        """
        return np.array(ENDS)[self.ending]

    @functools.cached_property
    def folded(self) -> Array:
        """(..., B, d): positions within the periodic cell."""
        return self.setup.shape.folded(self.position)

    @functools.cached_property
    def normal(self) -> Array:
        """(..., B, d): the wall's normal, towards the ball."""
        d = self.setup.table.dimension
        return self.setup.shape.normals(self.piece, self.position)[..., :d]

    @functools.cached_property
    def arc(self) -> Array:
        """(..., B): arc length s along the curve that bounds the centre, the table on its left, piece after piece."""
        return self.setup.shape.coordinate(self.piece, self.position)

    @functools.cached_property
    def across(self) -> Array:
        """(..., B): velocity away from the wall, m/s."""
        found: Array = np.einsum("...i,...i", self.velocity, self.normal)
        return found

    @functools.cached_property
    def along(self) -> Array:
        """(..., B): velocity along the wall, in the sense in which s grows, m/s; in a sphere, along its circles of latitude."""
        n, v = self.normal, self.velocity
        found: Array = n[..., 1] * v[..., 0] - n[..., 0] * v[..., 1]
        if self.setup.shape.sphere is not None:
            found = found / np.hypot(n[..., 0], n[..., 1])
        return found

    @functools.cached_property
    def angle(self) -> Array:
        """(..., B): from the normal to the velocity, rad; positive where s grows (of a cylinder: of its cross-section)."""
        return np.arctan2(self.along, self.across)

    @functools.cached_property
    def speed(self) -> Array:
        """(..., B): sqrt(2 energy / m), the kinetic energy with that of the spin."""
        spin = self.spin if self.setup.planar else np.linalg.norm(self.spin, axis=-1)
        ball = self.setup.ball
        found: Array = np.sqrt(self._rolls * (self.velocity**2).sum(-1) + ball.kappa * (ball.radius * spin) ** 2)
        return found

    @property
    def _rolls(self) -> float:
        """What a rolling ball's velocity counts for in its energy: its horizontal spin goes with it."""
        return 1.0 + self.setup.ball.kappa if self.setup.law == "rolling" else 1.0

    @functools.cached_property
    def phase(self) -> Array:
        """(..., B, 2): spin and velocity along the wall, both by energy: sqrt(kappa) a omega_z and v_t over ``speed``.

        The velocity phase portrait (after Cox & Feres): a point of the unit disc, which the invariant measure fills evenly.
        """
        ball = self.setup.ball
        spin = self.spin if self.setup.planar else self.spin[..., 2]
        parts = [np.sqrt(ball.kappa) * ball.radius * spin, np.sqrt(self._rolls) * self.along]
        return np.stack(parts, axis=-1) / self.speed[..., None]

    def path(self, which: Any = (), points: int = 1) -> Array:
        """The way of one orbit, (M, d): from the start through its bounces, with so many points a flight."""
        d = self.setup.table.dimension
        k = int(self.count[which])
        first = np.broadcast_to(np.asarray(self.start.position, float), (*self.count.shape, d))[which]
        v0 = np.broadcast_to(np.asarray(self.start.velocity, float), (*self.count.shape, d))[which]
        x = np.concatenate([first[None], self.position[which][:k]])
        v = np.concatenate([v0[None], self.velocity[which][:k]])
        t = np.diff(np.concatenate([[0.0], self.t[which][:k]]))
        if points == 1:
            return x
        g = np.array(self.setup.table.pull[:d])
        u = np.arange(points) / points * t[:, None]
        inner = x[:-1, None] + v[:-1, None] * u[..., None] + g * (u * u / 2)[..., None]
        return np.concatenate([inner.reshape(-1, d), x[-1:]])
