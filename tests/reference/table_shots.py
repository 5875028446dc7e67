"""Random shots on real tables."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

import carom
from carom.scene import Table
from carom.scene.presets import presets

__all__ = ["shot"]


def shot(preset: str, seed: int, count: int = 2, **more: Any) -> carom.Scene:
    """A scene of a few balls at random places of a table, with its own ball and cloth; the first one is fast."""
    rng = np.random.default_rng(seed)
    parts = {part: {name: one.value for name, one in found.items()} for part, found in presets()[preset].parts.items()}
    wall = Table(preset=preset, **more.pop("wall", {}))
    a = parts["ball"]["radius"]
    inside = np.array((wall.length, wall.width)) / 2 - 1.5 * a
    places: list[Any] = []
    while len(places) < count:
        at = rng.uniform(-inside, inside) + wall.center
        if all(np.linalg.norm(at - other) > 2.1 * a for other in places):
            places.append(at)
    speed, angle = rng.uniform(0.5, 6), rng.uniform(0, 2 * math.pi)
    balls: list[dict[str, Any]] = [{**parts["ball"], "position": at.tolist()} for at in places]
    balls[0] |= {"velocity": (speed * math.cos(angle), speed * math.sin(angle))}
    balls[0] |= {"rolling": True} if rng.random() < 0.5 else {"spin": tuple(rng.normal(size=3) * speed / a)}
    scene = {"floor": parts["floor"], "walls": [wall], "balls": balls, "ball_contact": parts["ball_contact"]}
    return carom.Scene(**(scene | more))
