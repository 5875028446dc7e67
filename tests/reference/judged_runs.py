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


def judged(kind, seed, noise=0.0):
    """Return the judgement of a drawn run; noise in m; up to 0.1 mm its spins are known."""
    run = carom.simulate(scene_of(kind, seed))
    columns = frames(run, RATES[seed % len(RATES)])
    rng = np.random.default_rng([91, KINDS.index(kind), seed])
    for axis in "xyz" if noise else "":
        columns[axis] = columns[axis] + rng.normal(scale=noise, size=len(columns[axis]))
    unknown = ("wx", "wy", "wz") if noise > 1e-4 else ()
    return judge({k: v for k, v in columns.items() if k not in unknown}, slope=tuple(run.scene.floor.slope))


FAULTS = (
    ("none", 0.0), ("gravity", 0.02), ("gravity", 0.05), ("gravity", 0.1), ("restitution", 1.05), ("energy", 0.05),
    ("energy", 0.1), ("kink", 0.05), ("kink", 0.2),
)  # fmt: skip
NOISES = (0.0, 1e-4, 1e-3)  # m


def faulty(fault, size, seed, noise):
    """Return the judgement of a ball that falls and bounces, with a fault; noise in m; up to 0.1 mm its spin is known.

    "gravity" wrong by a share, "restitution", "energy" that a bounce adds, as a share, and a "kink": a turn of the velocity
    in the second flight, in rad.
    """
    rng = np.random.default_rng([90, seed])
    g = 9.80665 * (1 + size * rng.choice([-1, 1]) * (fault == "gravity"))
    e = size if fault == "restitution" else rng.uniform(0.6, 0.9)
    x, v, rate = (
        np.array([0.0, 0.0, rng.uniform(0.3, 1.0)]),
        np.array([*rng.normal(0, 0.7, 2), 0.0]),
        int(rng.choice(RATES)),
    )
    begins, flights = [0.0], [(x, v)]
    for part in range(5 if fault == "kink" else 4):
        gone, kinks = (v[2] + math.sqrt(v[2] ** 2 + 2 * g * (x[2] - R))) / g, fault == "kink" and part == 1
        gone *= 0.4 if kinks else 1.0
        x, v = x + gone * v - np.array([0, 0, g / 2 * gone**2]), v - np.array([0, 0, g * gone])
        if kinks:
            v = v @ np.array([[1, 0, 0], [0, math.cos(size), math.sin(size)], [0, -math.sin(size), math.cos(size)]])
        else:
            left = v * [1, 1, -e]
            v = left * (math.sqrt((1 + size) * (v @ v) / (left @ left)) if fault == "energy" else 1.0)
        begins.append(begins[-1] + gone)
        flights.append((x, v))
    t = np.arange(0, begins[-2], 1 / rate)
    which = np.searchsorted(begins, t, side="right") - 1
    tau = (t - np.array(begins)[which])[:, None]
    places = (
        np.array([x for x, _v in flights])[which]
        + tau * np.array([v for _x, v in flights])[which]
        - [0, 0, g / 2] * tau**2
    )
    places += rng.normal(scale=noise, size=places.shape) if noise else 0.0
    columns = {"t": t, **dict(zip("xyz", places.T, strict=True))}
    spins = {} if noise > 1e-4 else dict.fromkeys(("wx", "wy", "wz"), np.zeros(len(t)))
    return judge(columns | spins, radius=R)


# --- films ----------------------------------------------------------------------------------------------------------------

FILM_KINDS = ("clean", "noisy", "gaps", "rounded", "fast", "few")


def film_of(kind, seed, wrong=None, size=0.0):
    """Return a ball that bounces before a camera, px: with drag, perspective, a rolled and tilted camera, shadows near the floor.

    ``wrong``: "hang": a wave of ``size`` radii on the height in the air; "jitter": places off by ``size`` radii; "long": an outline
    longer than wide by a share; "gain": a restitution; "kink": a blow at the top, by a share of the speed at the floor; "softer":
    each bounce gives back less, by a share; "faster", "swell": gravity, or the ball, grows by a share at each bounce.
    """
    rng = np.random.default_rng([40 + FILM_KINDS.index(kind), seed])
    rate = rng.uniform(60, 240) * {"fast": 0.5, "few": 0.25}.get(kind, 1)
    focal, depth, radius = rng.uniform(800, 2000), rng.uniform(1.0, 4.0), rng.uniform(0.02, 0.06)
    if focal * radius / depth < 12:
        depth = focal * radius / 12
    tilt, roll, drag, e = rng.normal(0, 0.15), rng.normal(0, 0.03), rng.uniform(0, 0.15), rng.uniform(0.5, 0.9)
    x, v = np.array([rng.normal(0, 0.3), rng.uniform(0.3, 1.2), 0.0]), rng.normal(0, 0.3, 3)
    e = 0.95 if wrong == "softer" else e
    places, step, kinks, met, wide = [], 1 / rate / 20, False, 0, []
    for k in range(20 * round((rng.uniform(0.6, 1.8) + 1.5 * (wrong == "softer")) * rate)):
        if k % 20 == 0:
            places.append(x.copy())
            wide.append((1 + size * (wrong == "swell")) ** met)
        v = v + step * (
            np.array([0.0, -9.81 * (1 + size * (wrong == "faster")) ** met, 0.0]) - drag * np.linalg.norm(v) * v
        )
        x = x + step * v
        if x[1] < radius and v[1] < 0:
            v[1] *= -(size if wrong == "gain" else e * (1 - size * (wrong == "softer")) ** met)
            met = min(met + 1, 5)
            kinks = wrong == "kink"
        if kinks and v[1] < 0:  # (at the top after a bounce)
            v, kinks = np.append(v[:2] - size * np.array([0, 2 * np.sqrt(9.81 * x[1])]), v[2]), False
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
    # of the outline: longer away from the middle of the picture, and along its way, by the exposure
    n = len(px)
    way, out = np.gradient(px, axis=0) * rng.uniform(0.1, 1), px / focal
    moments = a**2 / 4 * (np.eye(2) + out[:, :, None] * out[:, None, :]) + way[:, :, None] * way[:, None, :] / 12
    moments[:, 1, 1] *= (1 + size * (wrong == "long")) ** 2
    xx, xy, yy = moments[:, 0, 0], moments[:, 0, 1], moments[:, 1, 1]
    stretch = np.column_stack([xx - yy, 2 * xy]) / (xx + yy)[:, None]
    outlines = np.column_stack([focal * radius / away * wide, stretch]) + rng.normal(
        scale=0.01 + 2 * scatter / a, size=(n, 3)
    ) * [a, 1, 1]
    half = np.array([1.0, 0.75]) * min(0.8 * focal, 1100)
    px[(np.abs(px) > half).any(axis=1)] = np.nan
    return FilmPath(np.arange(n) / 30, px + half, float(a), 1.0, outlines, tuple(half))
