"""Runs of carom of every kind, drawn: on level and tilted floors, among cushions on either, in the air, from racks, frozen."""

from __future__ import annotations

import math

import numpy as np

import carom
from carom.tracks import judge
from carom.tracks.verdicts import FilmPath

RATES = (60, 120, 240, 480)
R = 0.0286
BALL = {"radius": R, "mass": 0.17}
KINDS = ("slope", "table", "frozen", "air", "rack", "leaning")


def scene_of(kind: str, seed: int) -> carom.Scene:
    """Return a scene; the same for the same kind and seed."""
    rng = np.random.default_rng([KINDS.index(kind), seed])
    slope = tuple(rng.normal(scale=0.03, size=2)) if kind in ("slope", "leaning") else (0.0, 0.0)
    floor = {
        "friction": rng.uniform(0.05, 0.6), "rolling_resistance": float(rng.choice([0.0, 0.01, 0.03])), "slope": slope,
        "restitution": float(rng.choice([0.0, 0.5, 0.9])), "spin_friction": float(rng.choice([0.0, 0.0127])),
    }  # fmt: skip
    table = {
        "shape": "table",
        "length": 1.2,
        "width": 0.7,
        "restitution": rng.uniform(0.6, 1),
        "friction": rng.uniform(0, 0.4),
    }
    if rng.random() < 0.5:
        table["nose_height"] = rng.uniform(1.0, 1.4) * R
    moving = {"velocity": rng.normal(scale=1.2, size=2), "spin": rng.normal(scale=40, size=3)}
    first = {**BALL, **moving, "position": rng.uniform((-0.5, -0.3), (-0.1, 0.3))}
    others = [{**BALL, "position": (0.1 + 0.08 * k, rng.uniform(-0.3, 0.3))} for k in range(rng.integers(0, 5))]
    if kind == "frozen":  # to the long cushion, and struck
        away = rng.uniform(0.3, 2.8)
        frozen = np.array([rng.uniform(-0.2, 0.4), 0.35 - R])
        direction = np.array([math.cos(away), -math.sin(away)])
        first["position"] = frozen + direction * rng.uniform(0.12, 0.2)
        first["velocity"] = -direction * rng.uniform(0.5, 3)
        others = [{**BALL, "position": frozen}]
    if kind == "air":
        first |= {"position": (*first["position"], rng.uniform(0.05, 0.4)), "velocity": rng.normal(scale=1.2, size=3)}
    if kind == "rack":
        step = 2 * R + float(rng.choice([0.0, 1e-5, 1e-3]))
        others = [{**BALL, "position": (0.1 + row * step * math.sqrt(0.75), (k - row / 2) * step)}
                  for row in range(4) for k in range(row + 1)]  # fmt: skip
        first |= {"position": (-0.3, rng.normal(scale=0.01)), "velocity": (rng.uniform(1, 6), 0.0)}
    walls = [] if kind == "slope" or (kind == "air" and rng.random() < 0.5) else [table]
    contact = {"restitution": rng.uniform(0.8, 1.0), "friction": rng.uniform(0, 0.2)}
    return carom.Scene(
        floor=floor,
        balls=[first, *others],
        walls=walls,
        ball_contact=contact,
        run={"duration": 1.5, "max_events": 3000},
    )


def frames(run, rate):
    """Return the columns of a run's frames, with spins, radii and masses."""
    times = np.arange(0, run.end, 1 / rate)
    state, count = run.at(times), len(run.scene.balls)
    columns = {"t": np.repeat(times, count), "ball": np.tile(np.arange(count), len(times))}
    for prefix, vectors in (("", state.position), ("w", state.spin)):
        columns |= {prefix + axis: part for axis, part in zip("xyz", vectors.reshape(-1, 3).T, strict=True)}
    return columns | {"radius": np.full(len(columns["t"]), R), "mass": np.full(len(columns["t"]), BALL["mass"])}


def judged(kind, seed):
    """Return the judgement of a drawn run."""
    run = carom.simulate(scene_of(kind, seed))
    return judge(frames(run, RATES[seed % len(RATES)]), slope=tuple(run.scene.floor.slope))


# --- films ----------------------------------------------------------------------------------------------------------------

FILM_KINDS = ("clean", "noisy", "gaps", "rounded", "fast")


def film_of(kind, seed, wrong=None, size=0.0):
    """Return a ball that bounces before a camera, px: with drag, perspective, a rolled and tilted camera, shadows near the floor.

    ``wrong``: "hang": a wave of ``size`` radii on the height in the air; "jitter": places off by ``size`` radii.
    """
    rng = np.random.default_rng([40 + FILM_KINDS.index(kind), seed])
    rate = rng.uniform(60, 240) * (0.5 if kind == "fast" else 1)
    focal, depth, radius = rng.uniform(800, 2000), rng.uniform(1.0, 4.0), rng.uniform(0.02, 0.06)
    if focal * radius / depth < 12:
        depth = focal * radius / 12
    tilt, roll, drag, e = rng.normal(0, 0.15), rng.normal(0, 0.03), rng.uniform(0, 0.15), rng.uniform(0.5, 0.9)
    x, v = (
        np.array([rng.normal(0, 0.3), rng.uniform(0.3, 1.2), 0.0]),
        np.array([*rng.normal(0, 0.3, 2), rng.normal(0, 0.3)]),
    )
    places, step = [], 1 / rate / 20
    for k in range(20 * round(min(rng.uniform(0.6, 1.8), 1.8) * rate)):
        if k % 20 == 0:
            places.append(x.copy())
        v = v + step * (np.array([0.0, -9.81, 0.0]) - drag * np.linalg.norm(v) * v)
        x = x + step * v
        if x[1] < radius and v[1] < 0:
            v[1] *= -e
    seen = np.array(places)
    c, s = math.cos(tilt), math.sin(tilt)
    up, away = c * seen[:, 1] - s * seen[:, 2], depth + s * seen[:, 1] + c * seen[:, 2]
    px = focal * np.column_stack([seen[:, 0], -up]) / away[:, None]
    px = px @ np.array([[math.cos(roll), math.sin(roll)], [-math.sin(roll), math.cos(roll)]])
    a = focal * radius / float(np.median(away))
    near = np.exp(-((seen[:, 1] - radius) / radius))  # (a shadow pulls the outline down)
    px[:, 1] += 0.05 * a * near * rng.random()
    if wrong == "hang":
        px[:, 1] += size * a * np.sin(2 * np.pi * np.arange(len(px)) / rng.uniform(16, 26))
    scatter = {"noisy": 0.02}.get(kind, 0.005) * a
    px += rng.normal(scale=scatter + (size * a if wrong == "jitter" else 0.0), size=px.shape)
    if kind == "rounded":
        px = np.round(px, 1)
    if kind == "gaps":
        px[rng.random(len(px)) < 0.1] = np.nan
    return FilmPath(np.arange(len(px)) / 30, px, float(a), 1.0)
