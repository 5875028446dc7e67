"""Scenes and spaces for the tests of sweeps, and what their stores hold."""

from __future__ import annotations

import hashlib
from pathlib import Path

import numpy as np

import carom

CAROM_TABLE = {
    "shape": "table",
    "length": 2.84,
    "width": 1.42,
    "nose_height": 0.037,
    "restitution": 0.85,
    "friction": 0.2,
}


def table_scene(**run: object) -> carom.Scene:
    """Three balls on a carom table, the first one rolling."""
    places = {"white": (-0.71, -0.3), "yellow": (0.3, 0.2), "red": (0.71, 0.0)}
    balls = [carom.SceneBall(radius=0.03075, mass=0.21, position=place, name=name) for name, place in places.items()]
    balls[0] = balls[0].model_copy(update={"rolling": True, "velocity": (1.0, 0.0, 0.0)})
    floor = carom.Floor(restitution=0.5, friction=0.2, rolling_resistance=0.01, spin_friction=0.0127)
    return carom.Scene(
        floor=floor,
        walls=[CAROM_TABLE],
        balls=balls,
        ball_contact=carom.BallContact(restitution=0.95, friction=0.06),
        run=carom.Run(**{"duration": 6.0, **run}),
    )


KEEP = ["final.position", "final.phase", "events.wall.count", "events.wall.0.position"]


def space(**more: object) -> carom.Space:
    """320 shots of one ball, which leaves in 8 speeds and 20 directions, on two cloths."""
    velocity = carom.polar(np.linspace(0.5, 3, 8), np.linspace(0, 90, 20))
    return carom.Space(
        table_scene(duration=2.0), {"balls.0.velocity": velocity, "floor.friction": [0.15, 0.2], **more}, seed=5
    )


def files_of(store: Path) -> dict[str, str]:
    """Hash of every file of a store."""
    files = sorted(path for path in store.rglob("*") if path.is_file())
    return {str(path.relative_to(store)): hashlib.sha256(path.read_bytes()).hexdigest() for path in files}
