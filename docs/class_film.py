"""Sixteen films as a class would make them, one shot each, as the program Tracker exports them; the truth is known.

    python docs/class_film.py films

A pool ball is rolled by hand into one cushion, without sidespin, at two speeds and eight angles, and filmed from above at 60
frames per second; each coordinate in each frame is off by 0.4 mm (standard deviation).
"""

from __future__ import annotations

import math
import sys
from pathlib import Path

import numpy as np

import carom
from carom.scene.shapes import Table

RADIUS, NOSE = 0.0286, 0.036  # m: of the ball; height of the cushion's nose
TRUTH = {"restitution": 0.85, "friction": 0.17}
SPEEDS, ANGLES = (0.9, 1.7), (12, 18, 24, 30, 36, 42, 48, 54)  # m/s; degrees from the cushion's normal


def write_films(folder: str | Path) -> list[Path]:
    """Write the films; return their paths."""
    rng = np.random.default_rng(7)
    Path(folder).mkdir(exist_ok=True)
    paths = []
    for number, (speed, angle) in enumerate(((speed, angle) for speed in SPEEDS for angle in ANGLES), 1):
        v, a = speed * rng.uniform(0.95, 1.05), math.radians(angle + rng.uniform(-2, 2))
        velocity = (-v * math.cos(a), v * math.sin(a), 0.0)
        run = carom.simulate(
            carom.Scene(
                floor=carom.Floor(friction=0.2, rolling_resistance=0.01, spin_friction=0.02),
                walls=[Table(length=2.54, width=1.27, center=(1.27, 0.635), nose_height=NOSE, **TRUTH)],
                balls=[
                    carom.SceneBall(
                        radius=RADIUS,
                        mass=0.17,
                        position=(0.45, 0.25),
                        velocity=velocity,
                        spin=(-velocity[1] / RADIUS, velocity[0] / RADIUS, 0.0),  # it rolls
                    )
                ],
                run=carom.Run(duration=1.2),
            )
        )
        meets = [event.t for event in run.events.of("wall")]
        time = np.arange(0, min([run.end, *(t - 0.02 for t in meets[1:])]), 1 / 60)  # until it meets another cushion
        place = np.asarray(run.at(time).position)[:, 0, :2] + rng.normal(0, 4e-4, (len(time), 2))
        rows = [f"{t:.6E}\t{x:.6E}\t{y:.6E}\t" for t, (x, y) in zip(time, place, strict=True)]
        paths.append(Path(folder) / f"shot{number:02d}.txt")
        paths[-1].write_text("\n".join(["ball A\t\t", "t\tx\ty\t", *rows, ""]))
    return paths


if __name__ == "__main__":
    for path in write_films(sys.argv[1] if len(sys.argv) > 1 else "films"):
        sys.stdout.write(f"{path}\n")
