"""Sixteen example films of one ball at one cushion, as the program Tracker exports them; the true law and surface are known.

A pool ball rolls into one cushion, without sidespin, at two speeds and eight angles, and is filmed from above at 60 frames
per second; each coordinate in each frame is off by 0.4 mm (standard deviation). `carom tracks example` writes them.
"""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np

from carom.errors import CaromError
from carom.files import as_path, cannot_write, write_text
from carom.scene.scene import Scene
from carom.simulation.simulate import simulate

__all__ = ["TRUTH", "write_example_films"]

RADIUS, NOSE = 0.0286, 0.036  # m: of the ball; height of the cushion's nose
TRUTH = {"restitution": 0.85, "friction": 0.17}
SPEEDS, ANGLES = (0.9, 1.7), (12, 18, 24, 30, 36, 42, 48, 54)  # m/s; degrees from the cushion's normal


def write_example_films(folder: str | Path) -> list[Path]:
    """Write the films to a folder, which is made if it is not there, and return their paths: shot01.txt to shot16.txt.

    Raises CaromError where they cannot be written, and where a file has such a name already.
    """
    folder = as_path("example films", folder)
    try:
        folder.mkdir(exist_ok=True)
    except OSError as error:
        raise cannot_write(folder, error) from None
    shots = [(speed, angle) for speed in SPEEDS for angle in ANGLES]
    paths = [folder / f"shot{number:02d}.txt" for number in range(1, len(shots) + 1)]
    for path in paths:
        if path.exists():
            raise CaromError(f"{path}: expected no file of that name, got one; name another folder")
    rng = np.random.default_rng(7)
    for path, (speed, angle) in zip(paths, shots, strict=True):
        v, a = speed * rng.uniform(0.95, 1.05), math.radians(angle + rng.uniform(-2, 2))
        velocity = (-v * math.cos(a), v * math.sin(a), 0.0)
        ball = {"radius": RADIUS, "mass": 0.17, "position": (0.45, 0.25), "velocity": velocity, "rolling": True}
        table = {"shape": "table", "length": 2.54, "width": 1.27, "center": (1.27, 0.635), "nose_height": NOSE, **TRUTH}
        floor = {"friction": 0.2, "rolling_resistance": 0.01, "spin_friction": 0.02}
        scene: dict[str, Any] = {"floor": floor, "walls": [table], "balls": [ball], "run": {"duration": 1.2}}
        run = simulate(Scene(**scene))
        meets = [event.t for event in run.events.of("wall")]
        time = np.arange(0, min([run.end, *(t - 0.02 for t in meets[1:])]), 1 / 60)  # until it meets another cushion
        place = np.asarray(run.at(time).position)[:, 0, :2] + rng.normal(0, 4e-4, (len(time), 2))
        rows = [f"{t:.6E}\t{x:.6E}\t{y:.6E}\t" for t, (x, y) in zip(time, place, strict=True)]
        write_text(path, "\n".join(["ball A\t\t", "t\tx\ty\t", *rows, ""]))
    return paths
