"""Balls on a cloth, by small steps: SciPy's Runge-Kutta of order 8 on Newton's equations, with the events as roots of its output.

An independent check of the closed forms: nothing of carom is used. Walls are planes that turn the normal velocity into -e times
itself, without friction, and may yield: contact is at a gap of -c v_n. Balls meet elastically, without friction.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np
from scipy.integrate import solve_ivp

G = 9.80665
SLIDING, ROLLING, STILL = "sliding", "rolling", "still"
LEAST = 1e-9  # m/s: a slip or a speed that is none
TURNED = 1e-11  # m/s: a slip or a speed that turns on its way is at its end


@dataclass
class Ball:
    """A ball on the cloth: place (2,), velocity (2,), spin (3,)."""

    x: Any
    v: Any
    w: Any
    radius: float = 0.03075
    kappa: float = 0.4
    phase: str = ""

    def slip(self) -> Any:
        """Return the velocity of the point that touches the cloth (2,)."""
        return np.array([self.v[0] - self.radius * self.w[1], self.v[1] + self.radius * self.w[0]])


class Wall(NamedTuple):
    """A plane x . n = at, n (2,) towards the balls."""

    n: Any
    at: float
    e: float = 0.8
    yield_time: float = 0.0
    deepest: float = np.inf


@dataclass
class Cloth:
    """The numbers of the cloth, as in a scene."""

    friction: float = 0.2
    rolling_resistance: float = 0.0
    spin_friction: float = 0.0
    rolling_drag: float = 0.0
    spin_damping: float = 0.0
    spin_drag: float = 0.0
    slope: Any = (0.0, 0.0)

    @property
    def down(self) -> Any:
        """Return gravity's part along the cloth (2,)."""
        return G * np.array(self.slope)

    @property
    def g(self) -> float:
        """Return gravity's part that presses the balls on the cloth."""
        return float(G * np.sqrt(1 - np.dot(self.slope, self.slope)))

    def holds(self, kappa: float) -> bool:
        """Whether a ball that is put down on the cloth stays there."""
        return float(np.linalg.norm(self.down)) <= self.rolling_resistance * self.g * (1 + kappa)


@dataclass
class Shot:
    """Balls, walls and cloth, followed up to a time; ``events``: (t, kind, ball, other)."""

    balls: list[Ball]
    walls: list[Wall]
    cloth: Cloth
    events: list[tuple[float, str, int, int]] = field(default_factory=list)
    step: float = 0.02

    def run(self, until: float) -> None:
        """Follow the balls up to a time."""
        t = 0.0
        for ball in self.balls:
            self._find_phase(ball)
        while t < until:
            t = self._leg(t, until)

    def _find_phase(self, ball: Ball) -> None:
        if np.linalg.norm(ball.slip()) > LEAST:
            ball.phase = SLIDING
        elif np.linalg.norm(ball.v) > LEAST or not self.cloth.holds(ball.kappa):
            ball.phase = ROLLING
        else:
            ball.phase, ball.v = STILL, np.zeros(2)
            ball.w = np.array([0.0, 0.0, ball.w[2]])

    def _rates(self, ball: Ball, y: Any) -> Any:
        v, w = y[2:4], y[4:7]
        c, a = self.cloth, ball.radius
        force = np.zeros(2)
        if ball.phase == SLIDING:
            slip = np.array([v[0] - a * w[1], v[1] + a * w[0]])
            force = -c.friction * c.g * slip / np.linalg.norm(slip)
            turn = np.array([force[1], -force[0]]) / (ball.kappa * a)
            force = force + c.down
        elif ball.phase == ROLLING:
            speed = np.linalg.norm(v)
            way = v if speed > 0 else c.down
            size = np.linalg.norm(way)
            # gravity turns the ball too: its inertia is (1 + kappa) m
            force = c.down / (1 + ball.kappa)
            force = force - (c.rolling_resistance + c.rolling_drag * speed) * c.g * way / size if size > 0 else force
            turn = np.array([-force[1], force[0]]) / a
        else:
            turn = np.zeros(2)
        loss = c.spin_friction * c.g / (ball.kappa * a) + c.spin_damping * abs(w[2])
        loss += c.spin_drag * np.linalg.norm(v) if ball.phase == ROLLING else 0
        moving = v if ball.phase != STILL else np.zeros(2)
        # (the direction is that at the begin of a leg, which ends where this spin does)
        return np.concatenate([moving, force, turn, [-loss * ball.way]])  # type: ignore[attr-defined]

    def _leg(self, t: float, until: float) -> float:
        """Integrate up to the next event and resolve it; return its time."""
        n = len(self.balls)
        for ball in self.balls:
            ball.way = np.sign(ball.w[2]) if abs(ball.w[2]) > 1e-12 else 0.0  # type: ignore[attr-defined]
        start = np.concatenate([np.concatenate([one.x, one.v, one.w]) for one in self.balls])

        def rates(_t: float, y: Any) -> Any:
            return np.concatenate([self._rates(one, y[7 * i : 7 * i + 7]) for i, one in enumerate(self.balls)])

        checks = self._checks(start)
        answer = solve_ivp(
            rates,
            (t, until),
            start,
            method="DOP853",
            rtol=1e-13,
            atol=1e-15,
            max_step=self.step,
            events=[one[-1] for one in checks],
        )
        for i, ball in enumerate(self.balls):
            y = answer.y[7 * i : 7 * i + 7, -1]
            ball.x, ball.v, ball.w = y[:2], y[2:4], y[4:7]
        end = float(answer.t[-1])
        for (kind, i, k, _f), times in zip(checks, answer.t_events, strict=True):
            if len(times):
                self._resolve(kind, i, k)
                if kind != "spin":
                    self.events.append((end, kind, i, k))
                for j in range(n):
                    was = self.balls[j].phase
                    self._find_phase(self.balls[j])
                    if (was, self.balls[j].phase) == (SLIDING, ROLLING) and (kind, i) != (ROLLING, j):
                        self.events.append((end, ROLLING, j, -1))  # (at the same time)
        return end

    def _end(self, now: Any, vector: Any) -> Any:
        """Return the function that falls to zero where a slip or a speed ends: along its way, which a slope turns."""
        if any(self.cloth.slope):
            return lambda t, y: np.linalg.norm(vector(y)) - TURNED
        way = now / np.linalg.norm(now)
        return lambda t, y: way @ vector(y)

    def _checks(self, start: Any) -> list[tuple[str, int, int, Any]]:
        found: list[tuple[str, int, int, Any]] = []

        def add(kind: str, i: int, k: int, f: Any) -> None:
            f.terminal, f.direction = True, -1
            found.append((kind, i, k, f))

        for i, ball in enumerate(self.balls):
            a, at = ball.radius, 7 * i
            if ball.phase == SLIDING:
                add(ROLLING, i, -1, self._end(ball.slip(), lambda y, a=a, at=at:
                    np.array([y[at + 2] - a * y[at + 5], y[at + 3] + a * y[at + 4]])))  # fmt: skip
            if ball.phase == ROLLING and np.any(ball.v):
                add(STILL, i, -1, self._end(ball.v, lambda y, at=at: y[at + 2 : at + 4]))
            if ball.w[2] != 0:
                sign = np.sign(ball.w[2])
                add("spin", i, -1, lambda t, y, at=at, sign=sign: sign * y[at + 6])
            for k, wall in enumerate(self.walls):

                def gap(t: float, y: Any, a: float = a, at: int = at, wall: Wall = wall) -> float:
                    rate = float(wall.n @ y[at + 2 : at + 4])
                    depth = min(wall.yield_time * max(-rate, 0.0), wall.deepest * a)
                    return float(wall.n @ y[at : at + 2]) - wall.at - a + depth

                add("wall", i, k, gap)
            for k in range(i):
                other, to = self.balls[k], 7 * k
                if STILL not in (ball.phase, other.phase) or ball.phase != other.phase:
                    add("ball", k, i, lambda t, y, at=at, to=to, reach=a + other.radius:
                        np.linalg.norm(y[at : at + 2] - y[to : to + 2]) - reach)  # fmt: skip
        return found

    def _resolve(self, kind: str, i: int, k: int) -> None:
        ball = self.balls[i]
        if kind == "spin":
            ball.w = np.array([*ball.w[:2], 0.0])
        elif kind == ROLLING:
            # the angular momentum about the point that touches the cloth is kept
            a, c = ball.radius, ball.kappa
            ball.v = (ball.v + c * a * np.array([ball.w[1], -ball.w[0]])) / (1 + c)
            ball.w = np.array([-ball.v[1] / a, ball.v[0] / a, ball.w[2]])
        elif kind == STILL:
            ball.v, ball.w = np.zeros(2), np.array([0.0, 0.0, ball.w[2]])
        elif kind == "wall":
            wall = self.walls[k]
            ball.v = ball.v - (1 + wall.e) * (wall.n @ ball.v) * wall.n
        else:
            other = self.balls[k]
            n = (ball.x - other.x) / np.linalg.norm(ball.x - other.x)
            u = (ball.v - other.v) @ n
            ball.v, other.v = ball.v - u * n, other.v + u * n
