"""Two balls that meet with tangential compliance, integrated in time: an independent checker of the laws of the pair.

Both balls move by themselves in the plane, each with its own mass, radius and moment of inertia: nothing is reduced to one ball,
and nothing of carom is used. With Hertz's normal force there is a row of independent springs along the contact (Popov & Hess,
Method of Dimensionality Reduction, 2015), which is the contact of Cattaneo and Mindlin. Lumped, there is one linear normal spring,
which unloads with 1/e^2 times its stiffness, and a tangential one (Stronge, Impact Mechanics, 2000). Coulomb friction, leapfrog.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np


class Disc(NamedTuple):
    """A ball seen from above: radius, mass, kappa, velocity (2), spin about the vertical."""

    radius: float
    mass: float
    kappa: float
    velocity: tuple[float, float]
    spin: float


def collide(
    one: Disc, other: Disc, friction: float, ratio: float, restitution: float | None = None, steps: int = 3000
) -> Any:
    """Return (vx, vy, spin) of both after they met; the second is at +x of the first. ``ratio``: tangential over normal stiffness.

    Without a restitution the contact is Hertz's (elastic); with one it is lumped.
    """
    m, a, inertia = (
        np.array(x)
        for x in zip(*((d.mass, d.radius, d.kappa * d.mass * d.radius**2) for d in (one, other)), strict=True)
    )
    v, w = np.array([one.velocity, other.velocity], dtype=float), np.array([one.spin, other.spin], dtype=float)
    reduced, curved = m.prod() / m.sum(), a.prod() / a.sum()
    approach = v[0, 0] - v[1, 0]
    hertz = restitution is None
    stiff = 1e9 if hertz else 1e6  # (E*, or N/m: the impulses do not depend on it)
    if hertz:
        deepest = (15 * reduced * approach**2 / (16 * stiff * math.sqrt(curved))) ** 0.4
        step = 2.9433 * deepest / approach / steps
        springs = 400
        width = math.sqrt(curved * deepest) / springs
        rim = ((np.arange(springs) + 0.5) * width) ** 2 / curved
        stretch = np.zeros(springs)
    else:
        step = math.pi * math.sqrt(reduced / stiff) / steps
        stretch = np.zeros(1)
    depth, most = 0.0, 0.0

    def forces(depth: float, most: float, slip_step: float) -> tuple[float, float]:
        """Return the normal and the tangential force on the second ball (N), after the surfaces have slipped a little further."""
        if hertz:
            pressed = stiff * np.maximum(depth - rim, 0) * 2 * width
            each = ratio * stiff * 2 * width
        else:
            # (it unloads from ``most``, where the force is the same, to zero at a depth > 0)
            back = stiff / restitution**2
            pressed = np.array([stiff * depth if depth >= most else max(stiff * most - back * (most - depth), 0.0)])
            each = ratio * stiff
        stretch[:] = np.clip(stretch + slip_step, -friction * pressed / each, friction * pressed / each)
        return float(pressed.sum()), float(each * stretch.sum())

    normal, along = 0.0, 0.0
    while True:
        for half in (0, 1):
            # the first ball pushes the second along x, and drags it along y; both are turned by the drag at their rims
            v[1] += np.array([normal, along]) / m[1] * step / 2
            v[0] -= np.array([normal, along]) / m[0] * step / 2
            w -= a * along / inertia * step / 2
            if half == 0:
                depth += (v[0, 0] - v[1, 0]) * step
                most = max(most, depth)
                # the point of the first ball that touches, less that of the second
                slip = v[0, 1] + a[0] * w[0] - (v[1, 1] - a[1] * w[1])
                normal, along = forces(depth, most, slip * step)
        if normal <= 0:
            return np.column_stack([v, w])
