"""Carom tables as an environment for learning, in the shape of Gymnasium's vector environments: many tables, a shot each a step.

An action is the cue's speed (m/s), where it points (radians from x, counterclockwise), and side and top (radii of the ball). A shot
in which the white ball touches both other balls is a point, and the game goes on from where the balls come to rest; any other shot
ends the episode, and this table begins anew. Gymnasium itself is not needed; with it, ``gymnasium.spaces.Box(*CaromTables.BOUNDS)``
is the space of actions, and places are within ``Box(-1.5, 1.5, (3, 2))``.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

import carom

Array = NDArray[Any]
WALL, BALL = 1, 3  # kinds of events


class CaromTables:
    """``count`` carom tables at once: all shots of a step are one call of ``carom.simulate_many``."""

    BOUNDS = (np.array([0.5, -np.pi, -0.4, -0.4]), np.array([6.0, np.pi, 0.4, 0.4]))

    def __init__(self, count: int, table: str = "carom") -> None:
        self.scene = carom.load_scene(table)
        self.ball = self.scene.balls[0].ball
        self.places = np.zeros((count, len(self.scene.balls), 3))
        self.rng = np.random.default_rng()

    def reset(self, seed: int | None = None) -> tuple[Array, dict[str, Any]]:
        """Begin anew on all tables; return the places (count, 3, 2) and an empty dict."""
        self.rng = np.random.default_rng(seed)
        return self._begin(np.ones(len(self.places), bool)), {}

    def step(self, actions: Array) -> tuple[Array, Array, Array, Array, dict[str, Any]]:
        """Play a shot on each table, actions (count, 4).

        Return the places after it (first ones where a table begins anew), points, which tables began anew, which were cut off
        (none), and how many cushions the white ball touched before its second ball.
        """
        speed, azimuth, side, top = np.clip(actions, *self.BOUNDS).T
        offset = np.stack([side, top], axis=-1)
        struck = carom.strike(self.ball, speed=speed, azimuth_deg=np.degrees(azimuth), offset=offset).state
        velocity, spin = np.zeros((2, *self.places.shape))
        velocity[:, 0], spin[:, 0] = struck.velocity, struck.spin
        shots = carom.simulate_many(self.scene, velocity, spin, self.places, events=60, kinds=("wall", "ball"))
        white = shots.events["ball"] == 0
        at = [
            np.where(white & (shots.events["kind"] == BALL) & (shots.events["other"] == k), shots.events["t"], np.inf)
            for k in (1, 2)
        ]
        both = np.maximum(*(times.min(axis=1) for times in at))  # when the second of them was touched, or never
        cushions = (white & (shots.events["kind"] == WALL) & (shots.events["t"] < both[:, None])).sum(axis=1)
        points = np.isfinite(both)
        self.places = shots.final.position.copy()
        return self._begin(~points), points.astype(float), ~points, np.zeros_like(points), {"cushions": cushions}

    def _begin(self, anew: Array) -> Array:
        """Put the balls of some tables at random places that do not overlap; return all places."""
        a, wall = self.ball.radius, self.scene.walls[0]
        reach = np.array([wall.length, wall.width]) / 2 - 1.5 * a
        self.places[anew, :, 2] = a
        while anew.any():
            self.places[anew, :, :2] = self.rng.uniform(-reach, reach, (anew.sum(), self.places.shape[1], 2))
            gaps = [np.linalg.norm(self.places[:, i] - self.places[:, j], axis=-1) for i, j in ((0, 1), (0, 2), (1, 2))]
            anew = anew & (np.min(gaps, axis=0) < 2.2 * a)
        return self.places[..., :2].copy()
