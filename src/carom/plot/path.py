"""The way of a ball from the wall until it rolls: flights, bounces, sliding, each as the points of a curve."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from carom.kernel import Vec
from carom.law import Answer, Meeting
from carom.laws.contact import slip_velocity, wall_contact
from carom.laws.landing import UP, fall

__all__ = ["Path", "path_after_wall"]

Array = NDArray[np.float64]
MOST_BOUNCES = 2000
POINTS = 41


@dataclass(frozen=True, eq=False)
class Path:
    """Where the centre goes after the wall. Positions from the centre's place at the wall; z from the floor's level."""

    pieces: tuple[tuple[str, Array], ...]
    """("flight" | "slide", points (N, 3), m), one after the other."""
    velocity: Vec
    """With which it goes on at the end of the last piece, m/s: straight, if it rolls."""
    spin: Vec

    @property
    def end(self) -> Array:
        """The last point (3,), m."""
        return self.pieces[-1][1][-1] if self.pieces else np.zeros(3)

    @property
    def points(self) -> Array:
        """All points (N, 3), m."""
        return np.concatenate([points for _name, points in self.pieces]) if self.pieces else np.zeros((1, 3))


def path_after_wall(meeting: Meeting, answer: Answer) -> Path:
    """Follow one ball that leaves the wall as a law says: to where it rolls, or as far as this can be followed.

    Where the law has nothing to say after the wall (``answer.steps`` is None) there are no pieces. A floor that returns
    nearly everything is left after 2000 bounces. Source: Newton's parabola, Coulomb's friction.
    """
    m = meeting
    v, w = _vec(answer.after_wall.velocity), _vec(answer.after_wall.spin)
    place = (0.0, 0.0, float(m.height))
    if answer.steps is None:
        return Path((), v, w)
    pieces: list[tuple[str, Array]] = []
    a, kappa, g = float(m.ball.radius), float(m.ball.kappa), float(m.gravity)
    floor = (float(m.floor.restitution), float(m.floor.friction), float(m.floor.tangential_restitution))
    speed = math.sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2])
    for _ in range(MOST_BOUNCES):
        if place[2] > 0 or v[2] > 1e-9 * speed:
            if not g > 0:
                return Path(tuple(pieces), v, w)
            t = fall(place[2], v[2], g)
            flat = v[2] * v[2] < 2e-3 * g * a  # a hop of less than a thousandth of the radius: its ends will do
            points = _curve(place, v, (0.0, 0.0, -g), t, 2 if flat and pieces else POINTS)
            points[-1, 2] = 0.0
            pieces.append(("flight", points))
            place, v = _vec(points[-1]), (v[0], v[1], v[2] - g * t)
        if v[2] < 0:
            v, w, _j, _required, _regime = wall_contact(v, w, UP, a, kappa, *floor)
        if not v[2] > 1e-9 * speed:
            break
    else:
        return Path(tuple(pieces), v, w)
    v = (v[0], v[1], 0.0)
    _un, s = slip_velocity(v, w, UP, a)
    slip = math.hypot(s[0], s[1])
    if slip > 1e-12 * (speed + a * math.sqrt(w[0] * w[0] + w[1] * w[1])) and floor[1] > 0 and g > 0:
        # Coulomb: constant deceleration against the slip, which dies at the rate mu g (1 + 1/kappa)
        t = 0.0 if math.isinf(floor[1]) else slip / (floor[1] * g * (1 + 1 / kappa))
        change = slip / (1 + 1 / kappa)
        cx, cy = s[0] / slip, s[1] / slip
        if t > 0:
            pieces.append(("slide", _curve(place, v, (-change / t * cx, -change / t * cy, 0.0), t)))
        v = (v[0] - change * cx, v[1] - change * cy, 0.0)
        w = (-v[1] / a, v[0] / a, w[2])
    return Path(tuple(pieces), v, w)


def _vec(x: Array) -> Vec:
    return float(x[0]), float(x[1]), float(x[2])


def _curve(place: Vec, v: Vec, acceleration: Vec, duration: float, count: int = POINTS) -> Array:
    t = np.linspace(0.0, duration, count)[:, None]
    return np.asarray(np.array(place) + np.array(v) * t + np.array(acceleration) * t * t / 2)
