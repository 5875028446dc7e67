"""Tracks whose truth is known: made by the engine, then seen as a camera sees: frames, noise, pixels, gaps, clamping."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

import carom
from carom.data import Rebounds
from carom.scene.shapes import Plane, Table
from carom.tracks import Measured, Settings, Track, measure, to_rebounds

RADIUS, MASS = 0.03075, 0.21
LENGTH, WIDTH, NOSE = 2.84, 1.42, 0.037
REACH = float(np.sqrt(RADIUS**2 - (NOSE - RADIUS) ** 2))
LOW, HIGH = np.array([REACH, REACH]), np.array([LENGTH - REACH, WIDTH - REACH])


@dataclass(frozen=True)
class Camera:
    """How a run is seen."""

    rate: float = 120.0
    noise: float = 3e-4
    pixel: float = 0.0
    missing: float = 0.0
    """Share of frames in which the ball is not found."""
    clamp: bool = False
    """Whether places are put inside a line 2 mm within the one on which the balls turn."""


@dataclass(frozen=True)
class Surfaces:
    """Of a table on which many shots are played, and the sidespin that its balls have when they come to the cushion."""

    restitution: float
    friction: float
    cloth: float
    rolling: float
    floor_contact: str = "with"
    """While the cushion presses the ball on the cloth: both at once, or "after"."""
    spin_mean: float = 0.0
    """v_t/a"""
    spin_width: float = 0.3
    """v/a; normal"""


def surfaces(rng: np.random.Generator, floor_contact: str = "with") -> Surfaces:
    """Some table."""
    return Surfaces(
        rng.uniform(0.7, 0.95), rng.uniform(0.1, 0.25), rng.uniform(0.12, 0.28), rng.uniform(0.004, 0.015), floor_contact,
        rng.uniform(0.0, 0.6), rng.uniform(0.2, 0.5),
    )  # fmt: skip


def shot(rng: np.random.Generator, sliding: bool = False, on: Surfaces | None = None) -> Any:
    """A ball that meets a cushion with a nose about half a second after the film begins; ``on`` a table, or any."""
    speed, angle = rng.uniform(0.6, 3.0), np.radians(rng.uniform(-60, 60))
    wall = rng.integers(4)
    n = np.array([(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)][wall])
    velocity = speed * (-np.cos(angle) * n + np.sin(angle) * np.array([-n[1], n[0]]))
    middle = (LOW + HIGH) / 2
    at = np.where(n > 0, LOW, np.where(n < 0, HIGH, middle))
    reach = min(0.45 * speed * np.cos(angle), 0.6 if n[1] else 1.2)
    start = at + n * reach - np.array([-n[1], n[0]]) * rng.uniform(-0.1, 0.1)
    spin = rng.uniform(-0.5, 0.5) * speed / RADIUS
    # (in the order in which these were always drawn)
    restitution, friction = (
        (rng.uniform(0.7, 0.95), rng.uniform(0.1, 0.25)) if on is None else (on.restitution, on.friction)
    )
    cloth, rolling = (rng.uniform(0.12, 0.28), rng.uniform(0.004, 0.015)) if on is None else (on.cloth, on.rolling)
    if on is not None:
        # running side is that of the cushion which is met first: of one ball in twelve another than it was sent to
        ways = (np.where(velocity > 0, HIGH, LOW) - start) / velocity
        first = int(np.argmin(ways))
        n = -np.sign(velocity[first]) * np.eye(2)[first]
        along = (n[0] * velocity[1] - n[1] * velocity[0]) / speed
        slowed = np.sqrt(speed**2 - 2 * rolling * 9.80665 * speed * ways[first])
        spin = (on.spin_mean * along + on.spin_width * rng.normal()) * slowed / RADIUS
    cushion = Table(
        length=LENGTH, width=WIDTH, center=(LENGTH / 2, WIDTH / 2), nose_height=NOSE, restitution=restitution, friction=friction
    )  # fmt: skip
    floor = carom.Floor(
        friction=cloth, restitution=0.0, rolling_resistance=rolling, spin_friction=0.01 if on is None else 0.0
    )
    roll = {"spin": (0.0, 0.0, spin)} if sliding else {"spin": (-velocity[1] / RADIUS, velocity[0] / RADIUS, spin)}
    ball = carom.SceneBall(radius=RADIUS, mass=MASS, position=tuple(start), velocity=(*velocity, 0.0), **roll)
    asked = carom.Run(duration=1.1, floor_contact="with" if on is None else on.floor_contact)
    return carom.simulate(carom.Scene(floor=floor, walls=[cushion], balls=[ball], run=asked))


def bounce(rng: np.random.Generator) -> Any:
    """A ball that falls on a floor, seen from the side: x along, z up; two or three bounces."""
    floor = Plane(
        point=(0, 0, 0), normal=(0, 0, 1), restitution=rng.uniform(0.6, 0.95), friction=rng.uniform(0.05, 0.4)
    )
    ball = carom.SceneBall(
        radius=0.02, mass=0.0027, inertia="hollow", position=(0.0, 0.0, rng.uniform(0.25, 0.6)),
        velocity=(rng.uniform(-1.5, 1.5), 0.0, rng.uniform(-1, 0.5)), spin=(0.0, rng.uniform(-60, 60), 0.0),
    )  # fmt: skip
    return carom.simulate(carom.Scene(walls=[floor], balls=[ball], run=carom.Run(duration=1.0)))


def seen(run: Any, camera: Camera, rng: np.random.Generator, axes: tuple[int, int] = (0, 1), ball: int = 0) -> Track:
    """What the camera has of one ball."""
    time = np.arange(rng.uniform(0, 1 / camera.rate), run.end, 1 / camera.rate)
    if camera.missing:
        time = time[rng.random(len(time)) >= camera.missing]
    x = np.asarray(run.at(time).position)[:, ball][:, list(axes)]
    x = x + rng.normal(0, camera.noise, x.shape) if camera.noise else x
    if camera.pixel:
        x = np.round((x - rng.uniform(0, camera.pixel, 2)) / camera.pixel) * camera.pixel
    if camera.clamp:
        x = np.clip(x, LOW + 0.002, HIGH - 0.002)
    return Track(f"ball {ball + 1}", time, x)


def truth(run: Any, axes: tuple[int, int] = (0, 1), ball: int = 0) -> list[dict[str, float]]:
    """Every contact with a wall: time, and velocities in the wall's frame; those once it rolls again where it does.

    A cushion with a nose presses the ball on the cloth: what the cloth gives back in the same instant belongs to the contact.
    """
    found = []
    events = list(run.events)
    for i, event in enumerate(events):
        if event.kind != "wall" or event.ball != ball:
            continue
        last = [later for later in events[i:] if later.t - event.t < 1e-9][-1]
        before, after = (np.asarray(state.velocity)[list(axes)] for state in (event.before, last.after))
        n = np.asarray(event.impulse)[list(axes)]
        n = np.array([np.sign(n[0]), 0.0]) if abs(n[0]) > abs(n[1]) else np.array([0.0, np.sign(n[1])])
        t = np.array([-n[1], n[0]])
        row = {"t": event.t, "vn_in": before @ n, "vt_in": before @ t, "vn_out": after @ n, "vt_out": after @ t}
        for later in events[i + 1 :]:
            if later.kind == "wall":
                break
            if later.kind == "rolling":
                rolls = np.asarray(later.after.velocity)[list(axes)]
                # the velocity with which it began to roll
                row |= {"vn_roll": rolls @ n, "vt_roll": rolls @ t, "slides": later.t - event.t}
                break
        found.append(row)
    return found


def filmed(floor_contact: str, camera: Camera, seed: int, shots: int) -> tuple[Surfaces, Measured, Rebounds]:
    """A table, what its films show, and of each shot the first contact: the sidespins after it are another population."""
    rng = np.random.default_rng(seed)
    on = surfaces(rng, floor_contact)
    films = [replace(seen(shot(rng, on=on), camera, rng), group=f"shot {k}") for k in range(shots)]
    measured = measure(films, Settings(radius=0.0, view="above"))
    rebounds = to_rebounds(measured)
    names = rebounds.extra["shot"].tolist()
    return on, measured, rebounds.select(np.array([names.index(name) for name in dict.fromkeys(names)]))
