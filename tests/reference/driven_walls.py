"""Walls that move and yield, apart from the engine: distances in small steps, impulses from a matrix of inverse masses."""

from __future__ import annotations

import math

import numpy as np
from reference.brute_force_gas import Room


class Plane:
    """A plane through m with the normal n: it moves by ``at(t)``, its surface along itself; a mass makes it a piston."""

    def __init__(self, m, n, speed=0.0, travel=math.inf, along=(0.0, 0.0, 0.0), mass=math.inf, force=0.0):
        self.m, self.n, self.along = np.array(m, dtype=float), np.array(n, dtype=float), np.array(along, dtype=float)
        self.speed, self.travel, self.mass, self.force = speed, travel, mass, force
        self.place, self.since = 0.0, 0.0

    def at(self, t):
        s = np.asarray(t) - self.since
        if self.mass < math.inf:
            return self.place + self.speed * s + self.force / self.mass * s * s / 2
        return np.clip(self.speed * s, -self.travel, self.travel)

    def rate(self, t):
        if self.mass < math.inf:
            return self.speed + self.force / self.mass * (t - self.since)
        return self.speed if abs(self.speed) * t < self.travel else 0.0

    def distance(self, x, radius, t):
        return (x - self.m) @ self.n - self.at(t) - radius

    def normal(self, _x):
        return self.n

    def velocity(self, _n, t):
        return self.rate(t) * self.n + self.along

    def inverse(self, n):
        return np.outer(n, n) / self.mass

    def take(self, impulse, n, t):
        if self.mass < math.inf:
            self.place, self.speed, self.since = float(self.at(t)), self.rate(t) + impulse @ n / self.mass, t


class Plate:
    """A thin wall from one place to another, with balls on both sides."""

    def __init__(self, one, two):
        self.one, self.two = np.array([*one, 0.0]), np.array([*two, 0.0])

    def _nearest(self, x):
        along = self.two - self.one
        share = np.clip((x - self.one) @ along / (along @ along), 0.0, 1.0)
        return self.one + np.multiply.outer(share, along)

    def distance(self, x, radius, _t):
        return np.linalg.norm(x - self._nearest(x), axis=1) - radius

    def normal(self, x):
        r = x - self._nearest(x)
        return r / np.linalg.norm(r)

    def velocity(self, _n, _t):
        return np.zeros(3)

    def inverse(self, _n):
        return np.zeros((3, 3))

    def take(self, impulse, n, t):
        pass


class DrivenRoom(Room):
    """A room whose walls move."""

    def __init__(self, *given, walls):
        super().__init__(*given, walls=[(one.distance, one.normal, lambda _t: 0.0) for one in walls])
        self.bodies = walls

    def meet_wall(self, i, k):
        one = self.bodies[k]
        n = one.normal(self.x[i])
        e, mu, beta = self.wall(i, k)
        arm = -self.radius[i] * n
        u = self.v[i] + np.cross(self.w[i], arm) - one.velocity(n, self.t)
        across = np.eye(3) - np.outer(n, n)
        inverse = np.eye(3) / self.mass[i] + across / (self.kappa[i] * self.mass[i]) + one.inverse(n)
        un = u @ n
        p = np.linalg.solve(inverse, -(1 + e) * un * n - (1 + beta) * (u - un * n))
        push = p @ n
        rub = p - push * n
        if np.linalg.norm(rub) > mu * push:
            rub *= mu * push / np.linalg.norm(rub)
        p = push * n + rub
        self.v[i] += p / self.mass[i]
        self.w[i] += np.cross(arm, p) / (self.kappa[i] * self.mass[i] * self.radius[i] ** 2)
        one.take(-p, n, self.t)
