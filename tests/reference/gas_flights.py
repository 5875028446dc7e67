"""Means over time of a gas by another way: flight by flight between two collisions, from positions and velocities alone."""

from __future__ import annotations

import itertools
import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.gas import Gas

Array = NDArray[np.float64]
# Simpson's rule, which is exact for energies of a ball that falls: parabolas.
SIMPSON = ((1 / 6, 0.0), (2 / 3, 0.5), (1 / 6, 1.0))


class Flights:
    """Advances a gas by so many collisions, and integrates meanwhile; layers (edges across an axis) if there are edges."""

    def __init__(self, gas: Gas, collisions: int, axis: int = 0, edges: Array | None = None) -> None:
        one, kinds = gas.arrays.system[0], gas.arrays.materials.species
        self.side, self.g = one["side"].copy(), one["gravity"].copy()
        self.around = bool(one["periodic"][axis])
        self.axis, self.edges = axis, np.array([]) if edges is None else edges
        bins = max(len(self.edges) - 1, 0)
        self.flux, self.spins, self.height = np.zeros((len(kinds), 3, 3)), np.zeros(len(kinds)), 0.0
        self.number, self.momentum, self.square = np.zeros(bins), np.zeros((bins, 3)), np.zeros(bins)
        start, now = gas.time, gas.balls()
        mass, kind = kinds["mass"][now.species], now.species
        moment = mass * kinds["kappa"][kind] * kinds["radius"][kind] ** 2
        for _ in range(collisions):
            gas.advance(1)
            s = gas.time - now.time
            for weight, share in SIMPSON:
                x, v = self._at(now, share * s)
                each = weight * s * mass[:, None, None] * v[:, :, None] * v[:, None, :]
                np.add.at(self.flux, kind, each)
                self.height -= weight * s * float(mass @ (x @ self.g))
            np.add.at(self.spins, kind, s * moment * (now.spin**2).sum(axis=1))
            for i in range(len(mass) if bins else 0):
                self._through_layers(now.position[i], now.velocity[i], s, float(mass[i]))
            now = gas.balls()
        self.time = gas.time - start
        for name in ("flux", "spins", "number", "momentum", "square"):
            setattr(self, name, getattr(self, name) / self.time)
        self.height /= self.time

    def _at(self, balls: Any, s: float) -> tuple[Array, Array]:
        unwrapped = balls.position + balls.images * self.side
        return unwrapped + balls.velocity * s + self.g * s**2 / 2, balls.velocity + self.g * s

    def _through_layers(self, x: Array, v: Array, s: float, mass: float) -> None:
        """Add one flight, cut where it crosses an edge."""
        z, vz, g, side = x[self.axis], v[self.axis], self.g[self.axis], self.side[self.axis]
        edges = [e + k * side for e in self.edges for k in ((-1, 0, 1) if self.around else (0,))]
        cuts = {0.0, s}
        for edge in edges:
            if g == 0:
                cuts |= {(edge - z) / vz} if vz != 0 else set()
            elif (inside := vz * vz - 2 * g * (z - edge)) > 0:
                cuts |= {(-vz + math.sqrt(inside)) / g, (-vz - math.sqrt(inside)) / g}
        ordered = sorted(t for t in cuts if 0 <= t <= s)
        for a, b in itertools.pairwise(ordered):
            middle = (a + b) / 2
            at = z + vz * middle + g * middle**2 / 2
            k = int(np.searchsorted(self.edges, at % side if self.around else at)) - 1
            self.number[k] += b - a
            for weight, share in SIMPSON:
                u = v + self.g * (a + share * (b - a))
                self.momentum[k] += weight * (b - a) * mass * u
                self.square[k] += weight * (b - a) * mass * float(u @ u)
