"""Synthetic films of pages: places of balls from simulations, with noise."""

from __future__ import annotations

from typing import Any

import numpy as np

import carom
from carom.scene.shapes import Table
from carom.tracks import Track


def one_shot(path: str) -> Any:
    """Write a film of a ball on a table as CSV, and return the run."""
    rng = np.random.default_rng(4)
    a, v = 0.03075, np.array([-1.5, -1.1])
    run = carom.simulate(carom.Scene(
        floor=carom.Floor(friction=0.2, restitution=0.0, rolling_resistance=0.007, spin_friction=0.01),
        walls=[Table(length=2.84, width=1.42, center=(1.42, 0.71), nose_height=0.037, restitution=0.85, friction=0.15)],
        balls=[carom.SceneBall(radius=a, mass=0.21, position=(0.75, 0.9), velocity=(*v, 0), spin=(-v[1] / a, v[0] / a, 10))],
        run=carom.Run(duration=1.5),
    ))  # fmt: skip
    time = np.arange(0, run.end, 1 / 60)
    place = 1e3 * (np.asarray(run.at(time).position)[:, 0, :2] + rng.normal(0, 3e-4, (len(time), 2)))
    rows = np.column_stack([time, place])
    np.savetxt(path, rows, fmt="%.4f", delimiter=",", header="t [s],x [mm],y [mm]", comments="")
    return run


def three_shots() -> list[Track]:
    """Return tracks of three balls on one table."""
    rng = np.random.default_rng(1)
    a, tracks = 0.03075, []
    for k in range(3):
        angle, speed = rng.uniform(0, 2 * np.pi), rng.uniform(1.5, 4)
        v = speed * np.array([np.cos(angle), np.sin(angle)])
        spin = (-v[1] / a, v[0] / a, rng.normal(0, 0.4) * speed / a)
        place = (rng.uniform(0.5, 2.3), rng.uniform(0.4, 1.0))
        run = carom.simulate(carom.Scene(
            floor=carom.Floor(friction=0.2, rolling_resistance=0.008, spin_friction=0.4 * a * 10 / 9.80665),
            walls=[Table(length=2.84, width=1.42, center=(1.42, 0.71), restitution=0.85, friction=0.18)],
            balls=[carom.SceneBall(radius=a, mass=0.2, position=place, velocity=(*v, 0.0), spin=spin)],
            run=carom.Run(duration=2.0),
        ))  # fmt: skip
        t = np.arange(rng.uniform(0, 1 / 60), run.end, 1 / 60)
        x = np.asarray(run.at(t).position)[:, 0, :2]
        tracks.append(Track("1", t, x + rng.normal(0, 3e-4, x.shape), group=f"shot {k}"))
    return tracks
