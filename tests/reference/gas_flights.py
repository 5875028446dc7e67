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
        # energy and momentum that go upwards through the edges
        self.energy_up, self.momentum_up = np.zeros(bins + 1), np.zeros((bins + 1, 3))
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
                turning = float(moment[i] * (now.spin[i] ** 2).sum()) / 2
                self._through_layers(now.position[i], now.velocity[i], s, float(mass[i]), turning)
            before, now = now, gas.balls()
            self._passed_on(before.velocity + self.g * s, before.spin, now, mass, moment)
        self.time = gas.time - start
        for name in ("flux", "spins", "number", "momentum", "square", "energy_up", "momentum_up"):
            setattr(self, name, getattr(self, name) / self.time)
        self.height /= self.time

    def _at(self, balls: Any, s: float) -> tuple[Array, Array]:
        unwrapped = balls.position + balls.images * self.side
        return unwrapped + balls.velocity * s + self.g * s**2 / 2, balls.velocity + self.g * s

    def _passed_on(self, v: Array, w: Array, after: Any, mass: Array, moment: Array) -> None:
        """Add what one of two balls that have collided passes on to the other, through the edges between them."""
        hit = np.flatnonzero(np.abs(after.velocity - v).max(axis=1) > 1e-12)
        if len(hit) != 2:
            return  # (at a wall)
        low, high = sorted(hit, key=lambda i: after.position[i][self.axis])
        gain = [
            mass[i] / 2 * ((after.velocity[i] ** 2).sum() - (v[i] ** 2).sum())
            + moment[i] / 2 * ((after.spin[i] ** 2).sum() - (w[i] ** 2).sum())
            for i in (low, high)
        ]
        z = after.position[:, self.axis]
        between = (self.edges > z[low]) & (self.edges < z[high])
        self.energy_up[between] += (gain[1] - gain[0]) / 2
        self.momentum_up[between] += mass[high] * (after.velocity[high] - v[high])

    def _through_layers(self, x: Array, v: Array, s: float, mass: float, turning: float) -> None:
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
        for t in ordered[1:-1]:
            u, k = v + self.g * t, int(np.argmin(np.abs(self.edges - (z + vz * t + g * t**2 / 2))))
            sign = math.copysign(1.0, u[self.axis])
            self.energy_up[k] += sign * (mass / 2 * float(u @ u) + turning)
            self.momentum_up[k] += sign * mass * u
        for a, b in itertools.pairwise(ordered):
            middle = (a + b) / 2
            at = z + vz * middle + g * middle**2 / 2
            k = int(np.searchsorted(self.edges, at % side if self.around else at)) - 1
            self.number[k] += b - a
            for weight, share in SIMPSON:
                u = v + self.g * (a + share * (b - a))
                self.momentum[k] += weight * (b - a) * mass * u
                self.square[k] += weight * (b - a) * mass * float(u @ u)
