"""A ball that slides, rolls or hops on the floor in air, by SciPy's DOP853: written down anew, without a line of carom's.

Where a slip, or a velocity, falls to zero, its size is what the motion is integrated over, in its logarithm: so the corner of the
friction, where its direction turns ever faster, is smooth, and the end of a phase is found from the equations themselves.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp

NEAR, LAST = 1e-3, 1e-15  # m/s: sizes from which their logarithm counts, and at which nothing is left


class OnFloor:
    """Rates of a ball in air on a floor: ``air(v, w)`` returns the air's force per mass with gravity, and w' by the air."""

    def __init__(self, air: Any, radius: float, kappa: float, floor: Any, slides: bool, spins: float) -> None:
        self.air, self.a, self.kappa, self.floor, self.slides, self.spins = air, radius, kappa, floor, slides, spins

    def vector(self, v: Any, w: Any) -> Any:
        """What friction acts against."""
        return v[:2] + self.a * np.array([-w[1], w[0]]) if self.slides else v[:2]

    def rates(self, v: Any, w: Any, along: Any) -> Any:
        """Acceleration and angular acceleration; the friction acts against the direction ``along``."""
        force, fade = self.air(v, w)
        a, kappa, load = self.a, self.kappa, -force[2]
        spin = -self.spins * self.floor.spin_friction * load / (kappa * a) + fade[2]
        if self.slides:
            rub = -self.floor.friction * load * along
            turn = [fade[0] + rub[1] / (kappa * a), fade[1] - rub[0] / (kappa * a), spin]
            return np.array([*(force[:2] + rub), 0.0]), np.array(turn)
        # torque about the point of contact, over its moment of inertia
        drive = (force[:2] + kappa * a * np.array([fade[1], -fade[0]])) / (1 + kappa)
        b = drive - self.floor.rolling_resistance * load * along
        return np.array([*b, 0.0]), np.array([-b[1] / a, b[0] / a, spin])


def floor_path(law: OnFloor, x: Any, v: Any, w: Any, times: Any) -> tuple[Any, Any]:
    """Return the states (rows of position, velocity, spin) at times before the phase ends, and as it ends, with the time."""
    start = np.concatenate([np.asarray(one, float) for one in (x, v, w)])

    def straight(_t: float, y: Any) -> Any:
        q = law.vector(y[3:6], y[6:])
        b, turn = law.rates(y[3:6], y[6:], q / np.linalg.norm(q))
        return np.concatenate([y[3:6], b, turn])

    def near(_t: float, y: Any) -> float:
        return float(np.linalg.norm(law.vector(y[3:6], y[6:]))) - NEAR

    near.terminal, near.direction = True, -1  # type: ignore[attr-defined]

    def gone(_t: float, y: Any) -> float:
        return float(law.spins * y[8]) if law.spins else 1.0

    gone.terminal, gone.direction = True, -1  # type: ignore[attr-defined]
    until, t0, last = 2 * float(times[-1]), 0.0, start
    states = np.full((9, len(times)), np.nan)  # (nor are there any of a ball that is NEAR)
    while near(0, last) > 0 and t0 < until:
        found = solve_ivp(
            straight, (t0, until), last, "DOP853", rtol=3e-14, atol=1e-16, events=(near, gone), dense_output=True
        )  # fmt: skip
        inside = (times >= t0) & (times <= found.t[-1])
        if inside.any():
            states[:, inside] = found.sol(times[inside])
        last, t0 = found.y[:, -1], float(found.t[-1])
        if found.status == 0:
            return states, None
        if len(found.t_events[0]):
            break
        last[8], law.spins = 0.0, 0.0
    q = law.vector(last[3:6], last[6:])

    def state(size: float, y: Any) -> tuple[Any, Any, Any]:
        along = np.array([math.cos(y[3]), math.sin(y[3])])
        if law.slides:
            v = np.array([y[4], y[5], 0.0])
            slip = size * along
            w = np.array([(slip[1] - v[1]) / law.a, (v[0] - slip[0]) / law.a, y[6]])
        else:
            v = np.array([*(size * along), 0.0])
            w = np.array([-v[1] / law.a, v[0] / law.a, y[6]])
        return v, w, along

    def spiral(log: float, y: Any) -> Any:
        size = NEAR * math.exp(-log)
        v, w, along = state(size, y)
        b, turn = law.rates(v, w, along)
        change = law.vector(b, turn)
        falls = -float(change @ along)
        per = size / falls
        bend = float(change @ (-along[1], along[0])) / size
        return np.array([per * v[0], per * v[1], per, per * bend, per * b[0], per * b[1], per * turn[2]])

    def over(_log: float, y: Any) -> float:
        return float(law.spins * y[6]) if law.spins else 1.0

    over.terminal, over.direction = True, -1  # type: ignore[attr-defined]
    log, end = math.log(NEAR / float(np.linalg.norm(q))), math.log(NEAR / LAST)
    y = np.array([last[0], last[1], t0, math.atan2(q[1], q[0]), last[3], last[4], last[8]])
    while log < end:
        found = solve_ivp(spiral, (log, end), y, "DOP853", rtol=3e-14, atol=1e-17, events=over)
        y, log = found.y[:, -1], float(found.t[-1])
        if found.status == 1:
            y[6], law.spins = 0.0, 0.0
    v, w, _along = state(0.0, y)
    return states, (float(y[2]), np.array([y[0], y[1], last[2]]), v, w)


def struck(v: Any, w: Any, a: float, kappa: float, e: float, mu: float) -> tuple[Any, Any]:
    """Velocity and spin after an impact on the floor, which sticks or slides."""
    slip = v[:2] + a * np.array([-w[1], w[0]])
    size, normal = float(np.linalg.norm(slip)), -(1 + e) * v[2]
    j = -min(kappa / (1 + kappa), mu * normal / size if size > 0 else 0.0) * slip
    return np.array([*(v[:2] + j), -e * v[2]]), w + np.array([j[1], -j[0], 0.0]) / (kappa * a)


def hops(air: Any, radius: float, kappa: float, floor: Any, x: Any, v: Any, w: Any) -> tuple[float, Any, Any, Any]:
    """Return time, position, velocity and spin after infinitely many hops; the later ones, of 1e-9 m, are parabolas."""
    e, t = float(floor.contact[1][0]), 0.0
    x, v, w = (np.array(one, float) for one in (x, v, w))

    def rates(_t: float, y: Any) -> Any:
        b, turn = air(y[3:6], y[6:])
        return np.concatenate([y[3:6], b, turn])

    for count in range(5000):
        if v[2] < 1e-17:
            break
        b, turn = air(v, w)
        s = -2 * v[2] / b[2]
        if count < 12:  # to the landing by Newton's steps
            for _ in range(3):
                y = solve_ivp(rates, (0, s), np.concatenate([[0, 0, 0], v, w]), "DOP853", rtol=3e-14, atol=1e-20).y[
                    :, -1
                ]
                s -= y[2] / y[5]
            y = solve_ivp(rates, (0, s), np.concatenate([[0, 0, 0], v, w]), "DOP853", rtol=3e-14, atol=1e-20).y[:, -1]
            x[:2] += y[:2]
            v, w = y[3:6], y[6:]
        else:
            x[:2] += v[:2] * s + b[:2] * s * s / 2
            v, w = v + b * s, w + turn * s
        t += s
        v, w = struck(v, w, radius, kappa, e, floor.friction)
    return t, x, np.array([v[0], v[1], 0.0]), w
