"""All pairs, all walls, after every event: the slow way, written apart from the engine, with its own roots and impulses."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
import pytest


class Event(NamedTuple):
    t: float
    i: int
    j: int  # -1 - wall


def first_root(c0, c1, c2):
    """Smallest s > 0 where c0 + c1 s + c2 s^2 comes down through zero; 0 for what is there and coming in."""
    if c0 <= 1e-12 and c1 < -1e-12:
        return 0.0
    if c2 == 0:
        return -c0 / c1 if c1 < 0 else math.inf
    inside = c1 * c1 - 4 * c2 * c0
    if inside <= 0:
        return math.inf
    # the root where the slope is -sqrt(inside)
    s = (-c1 - math.sqrt(inside)) / (2 * c2)
    return s if s > 1e-12 else math.inf


def first_roots(c0, c1, c2):
    """`first_root` of many, infinite where the distance does not become less: c1 >= 0."""
    with np.errstate(divide="ignore", invalid="ignore"):
        inside = c1 * c1 - 4 * c2 * c0
        s = (-c1 - np.sqrt(np.maximum(inside, 0))) / (2 * c2)
        s = np.where(c2 == 0, -c0 / c1, np.where((inside > 0) & (s > 1e-12), s, math.inf))
        return np.where(c1 < 0, np.where((c0 <= 1e-12) & (c1 < -1e-12), 0.0, s), math.inf)


class Brute:
    def __init__(self, x, v, w, radius, mass, kappa, side, periodic, gravity, pair, wall, axes):
        self.x, self.v, self.w = (np.array(a, dtype=float) for a in (x, v, w))
        self.radius, self.mass, self.kappa = radius, mass, kappa
        self.side, self.periodic, self.g = np.array(side), np.array(periodic), np.array(gravity, dtype=float)
        self.pair, self.wall, self.axes, self.t = pair, wall, axes, 0.0
        self.events: list[Event] = []
        steps = [(-1, 0, 1) if periodic and axis < axes else (0,) for axis, periodic in enumerate(self.periodic)]
        self.shifts = np.stack(np.meshgrid(*steps, indexing="ij"), axis=-1).reshape(-1, 3) * self.side

    def images(self, r):
        """All images of a difference, the nearest and those around it: (M, 3)."""
        return r + self.shifts

    def next(self):
        found = self.first_pair()
        for i in range(len(self.x)):
            for axis in range(self.axes):
                if self.periodic[axis]:
                    continue
                x, v, g, a = self.x[i, axis], self.v[i, axis], self.g[axis], self.radius[i]
                low, high = first_root(x - a, v, g / 2), first_root(self.side[axis] - a - x, -v, -g / 2)
                for k, s in ((2 * axis, low), (2 * axis + 1, high)):
                    if s < found.t:
                        found = Event(s, i, -1 - k)
        return found

    def first_pair(self):
        i, j = np.tril_indices(len(self.x), -1)
        u = self.v[j] - self.v[i]
        rows = (self.x[j] - self.x[i])[:, None] + self.shifts
        gaps = (rows * rows).sum(axis=2) - ((self.radius[i] + self.radius[j]) ** 2)[:, None]
        times = first_roots(gaps, 2 * (rows * u[:, None]).sum(axis=2), (u * u).sum(axis=1)[:, None]).min(axis=1)
        k = times.argmin()
        return Event(float(times[k]), j[k], i[k]) if times[k] < math.inf else Event(math.inf, -1, -1)

    def step(self):
        s, i, j = self.next()
        self.x += self.v * s + self.g * s * s / 2
        self.v += self.g * s
        self.t += s
        self.events.append(Event(self.t, i, j))
        if j < 0:
            self.meet_wall(i, -1 - j)
        else:
            r = min(self.images(self.x[i] - self.x[j]), key=lambda r: r @ r)
            self._hit(i, j, r / np.linalg.norm(r), self.pair(i, j))
        # (a long way is watched: no image beyond the nearest ones is looked at)
        self.x -= np.where(self.periodic, np.floor(self.x / self.side) * self.side, 0)

    def meet_wall(self, i, k):
        axis, upper = divmod(k, 2)
        n = np.zeros(3)
        n[axis] = -1.0 if upper else 1.0
        self._hit(i, None, n, self.wall(i, k))

    def _hit(self, i, j, n, surface):
        """The impulse, from the matrix that takes an impulse at the contact to the change of its velocity."""
        e, mu, beta = surface
        u, inverse = np.zeros(3), np.zeros((3, 3))
        across = np.eye(3) - np.outer(n, n)
        for k, way in ((i, 1), (j, -1)):
            if k is not None:
                u += way * self.v[k] + np.cross(self.w[k], -self.radius[k] * n)
                inverse += np.eye(3) / self.mass[k] + across / (self.kappa[k] * self.mass[k])
        un = u @ n
        ut = u - un * n
        p = np.linalg.solve(inverse, -(1 + e) * un * n - (1 + beta) * ut)
        push = p @ n
        rub = p - push * n
        if np.linalg.norm(rub) > mu * push:
            rub *= mu * push / np.linalg.norm(rub)
        p = push * n + rub
        for k, way in ((i, 1), (j, -1)):
            if k is not None:
                self.v[k] += way * p / self.mass[k]
                self.w[k] += np.cross(-self.radius[k] * n, p) / (self.kappa[k] * self.mass[k] * self.radius[k] ** 2)


class Room(Brute):
    """Walls of any form: distances from them as geometry has them, looked at in small steps and halved where they close."""

    STEPS = 1500
    wall_speed = 4.0  # no wall of the tests moves faster

    def __init__(self, *given, walls):
        super().__init__(*given)
        self.walls = walls  # (distance(x, radius, t), normal(x), speed(t)) of each

    def next(self):
        found = self.first_pair()
        most = min(found.t, 3.0)
        # close steps at first, for what comes back soon
        t = np.concatenate((np.geomspace(1e-9, 1e-3, 200) * most, np.linspace(1e-3, 1, self.STEPS)[1:] * most))
        for i in range(len(self.x)):
            speed = np.linalg.norm(self.v[i]) + self.wall_speed
            for k, (distance, _normal, _speed) in enumerate(self.walls):
                # (a ball that is farther away than it and the wall come is not followed; no distance grows faster than the place)
                if (
                    distance(self.x[i : i + 1], self.radius[i], self.t)[0]
                    > (speed + np.linalg.norm(self.g) * t[-1]) * t[-1]
                ):
                    continue
                d = distance(self._at(i, t), self.radius[i], self.t + t)
                down = np.flatnonzero((d[:-1] > 0) & (d[1:] <= 0))
                if len(down) and t[down[0]] < found.t:
                    low, high = t[down[0]], t[down[0] + 1]
                    for _ in range(60):
                        middle = (low + high) / 2
                        at = distance(self._at(i, np.array([middle])), self.radius[i], np.array([self.t + middle]))[0]
                        low, high = (middle, high) if at > 0 else (low, middle)
                    if high < found.t:
                        found = Event(high, i, -1 - k)
                        t = t[: np.searchsorted(t, high) + 1]  # (what comes later is not looked at)
        assert found.t < 3.0
        return found

    def _at(self, i, t):
        return self.x[i] + self.v[i] * t[:, None] + self.g * (t * t / 2)[:, None]

    def meet_wall(self, i, k):
        _distance, normal, speed = self.walls[k]
        n = normal(self.x[i])
        moving = speed(self.t) * n
        self.v[i] -= moving
        self._hit(i, None, n, self.wall(i, k))
        self.v[i] += moving


def follow(gas, brute):
    """One event of both, compared; then brute force goes on from the other's state, for what differs grows tenfold a hit."""
    brute.step()
    event = brute.events[-1]
    done = gas.run(1)
    assert gas.time == pytest.approx(event.t, abs=1e-9)
    assert done.wall_collisions == (event.j < 0)
    now = gas.balls()
    r = now.position - brute.x
    assert np.abs(r - np.where(brute.periodic, np.round(r / brute.side), 0) * brute.side).max() < 1e-9
    assert np.abs(now.velocity - brute.v).max() < 1e-9
    assert np.abs(now.spin - brute.w).max() < 1e-9
    assert done.max_overlap < 1e-13
    brute.x, brute.v, brute.w, brute.t = now.position, now.velocity, now.spin, gas.time
    return event.j < 0
