"""The cue's stroke that sets a ball off with a fitted velocity and spin."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from carom.bodies import Ball
from carom.laws.strike import DEFAULT_CUE, Cue, strike
from carom.scene.ball import CueStrike, SceneCue

__all__ = ["stroke_of"]

MOST = 0.7  # radii of an offset along each axis: a tip slips before
STEEPEST = 60.0  # degrees
FASTEST = 2.0  # times the speed of the ball


def stroke_of(ball: Ball, velocity: ArrayLike, spin: ArrayLike, cue: Cue = DEFAULT_CUE) -> CueStrike:
    """Return the stroke after which a ball has a velocity (2,), m/s, along the table and a spin (3,), rad/s, or comes nearest.

    Five numbers of the ball give five of the stroke: speed, azimuth, elevation, and the offset to the right and up. (A film tells
    little of the spin about the way of the ball, on which the elevation depends most.)

    Examples
    --------
    >>> import carom
    >>> from carom.fitting.shots import stroke_of
    >>> ball = carom.Ball(0.03075, 0.21)
    >>> after = carom.strike(ball, speed=3.0, azimuth_deg=30.0, elevation_deg=5.0, offset=(0.3, 0.2)).state
    >>> found = stroke_of(ball, after.velocity[:2], after.spin)
    >>> round(found.speed, 3), round(found.azimuth, 2), round(found.elevation, 2), [round(x, 3) for x in found.offset]
    (3.0, 30.0, 5.0, [0.3, 0.2])
    """
    from scipy.optimize import least_squares

    v, w, a = np.asarray(velocity, dtype=float), np.asarray(spin, dtype=float), float(ball.radius)
    size = max(float(np.hypot(*v)), 1e-9)
    wanted = np.concatenate([v, a * w]) / size

    def gap(p: np.ndarray) -> np.ndarray:
        after = strike(ball, cue, size * p[0], np.degrees(p[1]), p[2], p[3:]).state
        return np.concatenate([after.velocity[:2], a * after.spin]) / size - wanted

    along = float(np.arctan2(v[1], v[0]))
    low, high = [1e-3, along - 1.0, 0.0, -MOST, -MOST], [FASTEST, along + 1.0, STEEPEST, MOST, MOST]
    best = min(
        (
            least_squares(gap, [0.8, along, 5.0, side * 0.2, up], bounds=(low, high), x_scale=[1, 0.1, 10, 0.3, 0.3])
            for side in (-1, 1)
            for up in (-0.2, 0.2)
        ),
        key=lambda found: float(found.cost),
    )
    speed, turn, raised, right, up = best.x.tolist()
    numbers = {name: float(getattr(cue, name)) for name in SceneCue.model_fields}
    return CueStrike(
        speed=size * speed,
        azimuth=float(np.degrees(turn)),
        elevation=raised,
        offset=(right, up),
        cue=SceneCue(**numbers),
    )
