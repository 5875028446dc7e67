"""Shots whose truth is known, made by the engine, as a camera above the table sees them."""

from __future__ import annotations

from pathlib import Path

import numpy as np

import carom
from carom.scene.shapes import Table
from carom.tracks import Track

RADIUS, LENGTH, WIDTH = 0.03075, 2.84, 1.42
TRUTH = {"restitution": 0.85, "friction": 0.18, "floor_friction": 0.2, "rolling_resistance": 0.008}


def film(
    rng: np.random.Generator, shots: int, *, rate: float = 60.0, noise: float = 3e-4, law: str = "two-step", height: float = 1.0,
    floor_contact: str = "with", seconds: float = 2.0, sliding: bool = False, **truth: float,
) -> list[Track]:  # fmt: skip
    """Tracks of one ball a shot, struck from about the middle of the table; ``height`` of the noses in radii."""
    at = TRUTH | truth
    nose = None if height == 1.0 else height * RADIUS
    names = () if law == "conventional" else ("restitution", "friction", "stiffness_ratio")
    surface = {name: at[name] for name in names if name in at}
    wall = Table(length=LENGTH, width=WIDTH, center=(LENGTH / 2, WIDTH / 2), nose_height=nose, **surface)
    floor = carom.Floor(
        friction=at["floor_friction"],
        rolling_resistance=at["rolling_resistance"],
        spin_friction=0.4 * RADIUS * 10 / 9.80665,
    )
    found = []
    for k in range(shots):
        angle, speed = rng.uniform(0, 2 * np.pi), rng.uniform(1.5, 4)
        v = speed * np.array([np.cos(angle), np.sin(angle)])
        roll = rng.uniform(0.3, 1.0) if sliding else 1.0
        spin = (-roll * v[1] / RADIUS, roll * v[0] / RADIUS, rng.normal(0, 0.4) * speed / RADIUS)
        ball = carom.SceneBall(
            radius=RADIUS,
            mass=0.2,
            position=(rng.uniform(0.5, 2.3), rng.uniform(0.4, 1.0)),
            velocity=(*v, 0.0),
            spin=spin,
        )
        scene = carom.Scene(
            floor=floor,
            walls=[wall],
            balls=[ball],
            run=carom.Run(duration=seconds, law=law, floor_contact=floor_contact),
        )
        run = carom.simulate(scene)
        t = np.arange(rng.uniform(0, 1 / rate), run.end, 1 / rate)
        x = np.asarray(run.at(t).position)[:, 0, :2]
        found.append(Track("1", t, x + rng.normal(0, noise, x.shape), group=f"shot {k}"))
    return found


def write(tracks: list[Track], path: Path) -> Path:
    """As a table with named columns."""
    rows = ["shot,ball,t [s],x [mm],y [mm]"]
    for one in tracks:
        rows += [
            f"{one.group},{one.name},{t:.5f},{1e3 * x:.3f},{1e3 * y:.3f}"
            for t, (x, y) in zip(one.time, one.position, strict=True)
        ]
    path.write_text("\n".join(rows) + "\n")
    return path
