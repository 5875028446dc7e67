"""Sheared gases the slow way: no ball crosses a border, all images of all balls are looked at after every event."""

from __future__ import annotations

import math

import numpy as np
from reference.brute_force_gas import Brute, Event, first_roots

# Gauss's three points of an interval of length 1: exact for what is of degree 5.
POINTS = ((0.5 - math.sqrt(0.15), 5 / 18), (0.5, 4 / 9), (0.5 + math.sqrt(0.15), 5 / 18))


class Sheared(Brute):
    """Image (k, m) of a ball is at x + k L_x + m U t, y + m L_y, and is faster than the ball by m U along x: U = rate L_y."""

    REACH = 12  # images along x to both sides, two along y

    def __init__(self, x, v, w, radius, mass, kappa, side, rate, pair, axes):
        super().__init__(x, v, w, radius, mass, kappa, side, (True,) * 3, (0, 0, 0), pair, None, axes)
        self.rate, self.speed = rate, rate * side[1]
        steps = [
            np.arange(-self.REACH, self.REACH + 1),
            np.arange(-2, 3),
            np.arange(-1, 2) if axes == 3 else np.zeros(1),
        ]
        self.steps = np.stack(np.meshgrid(*steps, indexing="ij"), axis=-1).reshape(-1, 3)
        self.flux, self.transfer, self.measured = np.zeros((3, 3)), np.zeros((3, 3)), 0.0

    def first_pair(self):
        """The pair that meets first, with where the image of one is seen from the other then, and how much faster it is."""
        i, j = np.tril_indices(len(self.x), -1)
        at = (self.x[j] - self.x[i])[:, None] + self.steps * self.side
        at[..., 0] += self.steps[:, 1] * ((self.speed * self.t) % self.side[0])
        u = np.repeat((self.v[j] - self.v[i])[:, None], len(self.steps), axis=1)
        u[..., 0] += self.steps[:, 1] * self.speed
        gaps = (at * at).sum(axis=2) - ((self.radius[i] + self.radius[j]) ** 2)[:, None]
        times = first_roots(gaps, 2 * (at * u).sum(axis=2), (u * u).sum(axis=2))
        pair, k = np.unravel_index(times.argmin(), times.shape)
        s = float(times[pair, k])
        self.image = at[pair, k] + u[pair, k] * s, float(self.steps[k, 1]) * self.speed
        return Event(s, j[pair], i[pair])

    def step(self):
        s, j, i = self.first_pair()
        for share, weight in POINTS:
            peculiar = self.v.copy()
            peculiar[:, 0] -= self.rate * ((self.x + self.v * s * share)[:, 1] - self.side[1] / 2)
            self.flux += weight * s * np.einsum("i,ia,ib->ab", self.mass, peculiar, peculiar)
        self.x += self.v * s
        self.t += s
        self.measured += s
        r, faster = self.image
        self.events.append(Event(self.t, i, j))
        self.v[j, 0] += faster
        before = self.v[i].copy()
        self._hit(i, j, -r / np.linalg.norm(r), self.pair(i, j))
        self.transfer += np.outer(-r, self.mass[i] * (self.v[i] - before))
        self.v[j, 0] -= faster
